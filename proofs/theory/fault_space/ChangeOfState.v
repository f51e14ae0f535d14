(** Columns of equivalent pairs, whatever their (A, C). If S' has the behaviour of S and as many states, then after a change of the state
    of S' its fault columns (F', G') solve problem (11) for S, on every window. For a linear map T0 takes a state of S' to one of S with
    the same free response, up to faults of S from rest, and this is all that problem (11) asks. T0 may be changed by zero states of S;
    a state goes to a zero state only if it is one; and both systems have zeta of them, so T0 can be made invertible. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Chain Trajectory ClosedForm.
From faultspace Require Import SolutionCount.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A square matrix whose kernel, modulo U, is no larger than U is invertible up to rows in U. *)
Lemma unit_modulo (K : fieldType) n (T0 U : 'M[K]_n) : (\rank (kermx (T0 *m cokermx U)) <= \rank U)%N ->
  exists2 T, T \in unitmx & (T - T0 <= U)%MS.
Proof.
move=> small; pose C := (U^C)%MS; pose Q := proj_mx C U; pose N := kermx (T0 *m Q).
have cap : (C :&: U = 0)%MS by rewrite capmxC capmx_compl.
have all_rows k (X : 'M_(k, n)) : (X <= C + U)%MS by rewrite addsmxC; apply: submx_full; apply: addsmx_compl_full.
have NE : (N <= kermx (T0 *m cokermx U))%MS.
  apply/sub_kermxP; have := mulmx_ker (T0 *m Q); rewrite -/N mulmxA => e.
  have := proj_mx_compl_sub (all_rows _ (N *m T0)); rewrite e subr0 submxE -mulmxA => /eqP //.
pose M := invmx (row_ebase N) *m row_ebase U; have unitM : M \in unitmx by rewrite unitmx_mul unitmx_inv !row_ebase_unit.
have NM : (N *m M <= U)%MS.
  have NU : (\rank N <= \rank U)%N := leq_trans (mxrankS NE) small.
  have pid : pid_mx (\rank N) = (pid_mx (\rank N) : 'M_n) *m (pid_mx (\rank U) : 'M_n) :> 'M[K]_n.
    by rewrite mul_pid_mx (minn_idPl NU) (minn_idPr (rank_leq_row N)).
  have {1}-> : N *m M = col_ebase N *m pid_mx (\rank N) *m row_ebase U.
    by rewrite -[X in X *m M]mulmx_ebase /M !mulmxA mulmxK ?row_ebase_unit.
  rewrite pid -mulmxA -(mulmxA (pid_mx _)) mulmxA; apply: submx_trans (submxMl _ _) _.
  rewrite -[X in (_ <= X)%MS]mulmx_ebase -[X in (_ <= X)%MS]mulmxA.
  by rewrite (eqmxMfull _ (_ : row_full (col_ebase U))) // row_full_unit col_ebase_unit.
pose P := proj_mx N (N^C)%MS; exists (T0 *m Q + P *m M).
  rewrite -row_free_unit; apply: inj_row_free => x; rewrite mulmxDr => /eqP; rewrite addr_eq0 => /eqP e.
  have inC : (x *m (T0 *m Q) <= C)%MS by rewrite mulmxA proj_mx_sub.
  have inU : (x *m (P *m M) <= U)%MS by rewrite mulmxA; apply: submx_trans (submxMr _ (proj_mx_sub _ _ _)) NM.
  have z : x *m (T0 *m Q) = 0.
    by apply/eqP; rewrite -submx0 -cap sub_capmx inC e eqmx_opp inU.
  have xN : (x <= N)%MS by apply/sub_kermxP.
  move: e; rewrite z => /esym/eqP; rewrite oppr_eq0 mulmxA proj_mx_id ?capmx_compl // => /eqP xM.
  by rewrite -[x](mulmxK unitM) xM mul0mx.
rewrite addrAC; apply: addmx_sub; last by apply: submx_trans (submxMr _ _) NM; rewrite -[P]mul1mx proj_mx_sub.
by rewrite -eqmx_opp opprB; apply: proj_mx_compl_sub.
Qed.

Section Delayed.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** The zero states, told by the behaviour: their outputs are possible after n zeros. *)
Lemma zero_state_delayed x v : behavior S (fun k => if (k < n)%N then 0 else output S x v (k - n)) <-> (x <= zero_states S)%MS.
Proof.
split=> [[y [w e]] | /sub_addsmxP[[a b] /= xE]].
  have reach : (state S y w n <= silent S n)%MS by apply/silentP; exists y, w; split=> // j jn; rewrite -e jn.
  rewrite -[x](subrK (state S y w n)) addrC; apply: addmx_sub_adds reach _; apply/zero_holdingP.
  exists (fun k => v k - w (n + k)%N) => k _; rewrite output_sub -output_shift -e ltnNge leq_addr /= addKn; exact: subrr.
have /silentP[y [w [silent yE]]] : (a *m silent S n <= silent S n)%MS by apply: submxMl.
have /zero_holdingP/silent_for_ever[u quiet] : (b *m zero_holding S <= zero_holding S)%MS by apply: submxMl.
exists y, (follow n w (fun k => v k - u k)) => k; case: ltnP => [kn|nk]; first by rewrite output_follow_before ?silent.
rewrite -{2}(subnKC nk) output_follow_after yE; apply/esym/eqP; rewrite -subr_eq0 -output_sub.
rewrite [X in output S X](_ : _ = - (b *m zero_holding S)); last by rewrite xE opprD addrA subrr add0r.
rewrite -oppr_eq0 -output_opp opprK -[X in _ == X](quiet (k - n)%N); apply/eqP/output_ext => j _.
by rewrite !opprB addrC subrK.
Qed.

End Delayed.

Section Change.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Hypothesis same : forall r, behavior S r <-> behavior S' r.

(** States of S' and S with the same free response, up to faults of S. *)
Lemma matching_states : exists T0 : 'M[K]_(n', n), forall x, exists v, forall k, output S' x (fun=> 0) k = output S (x *m T0) v k.
Proof.
have /fin_all_exists[a ha] : forall i : 'I_n', exists a : 'rV[K]_n * (nat -> 'rV[K]_m),
    forall k, output S' (row i 1%:M) (fun=> 0) k = output S a.1 a.2 k.
  by move=> i; have /same[x [v e]] := output_behavior S' (row i 1%:M) (fun=> 0); exists (x, v).
exists (\matrix_i (a i).1) => x; exists (fun k => \sum_i x 0 i *: (a i).2 k) => k.
rewrite [x *m _]mulmx_sum_row output_sum -[x in LHS]mulmx1 [X in output S' X]mulmx_sum_row.
transitivity (output S' (\sum_i x 0 i *: row i 1%:M) (fun j => \sum_(i < n') (0 : 'rV_m')) k).
  by apply: output_ext => j _; rewrite big1.
rewrite (output_sum S') ; apply: eq_bigr => i _; rewrite rowK output_scale -ha -output_scale.
by apply: output_ext => j _; rewrite scaler0.
Qed.

Variables (T0 : 'M[K]_(n', n)).
Hypothesis match_states : forall x, exists v, forall k, output S' x (fun=> 0) k = output S (x *m T0) v k.

Lemma matched_faults (f : 'rV_n') (g : 'rV_p) s : (forall u, word S s (output (with_faults S' f g) 0 u)) -> solves S s (f *m T0) g.
Proof.
move=> inB; apply/solvesP => u; have [v vE] := match_states f.
suff [w wE] : exists w, forall k, (k < s)%N ->
    output (with_faults S' f g) 0 u k - output (with_faults S (f *m T0) g) 0 u k = output S 0 w k.
  apply: word_ext (word_sub (inB u) (output_word S s 0 w)) => k ks.
  by rewrite -wE // opprB addrCA subrr addr0.
elim: s u {inB} => [|s IH] u; first by exists (fun=> 0).
have [w wE] := IH (fun k => u k.+1); exists (fun k => if k is j.+1 then u 0%N 0 0 *: v j + w j else 0) => -[_|k ks].
  by rewrite /output /= !mul0mx !add0r subrr.
rewrite !output_step /= !mul0mx !add0r [u 0%N]mx11_scalar !mul_scalar_mx !mxE /= mulr1n.
rewrite (output_split (with_faults S' f g)) (output_split (with_faults S (f *m T0) g)) !output_free opprD addrACA wE //.
have free (n1 m1 : nat) (Q : system K n1 m1 p) (c : K) x : output Q (c *: x) (fun=> 0) k = c *: output Q x (fun=> 0) k.
  by rewrite -output_scale; apply: output_ext => j _; rewrite scaler0.
rewrite !free vE -scalerBr [output S (f *m T0) v k]output_split addrAC subrr add0r -output_scale -output_add scaler0.
by rewrite addr0.
Qed.

End Change.

(** Whatever the numbers of states: some linear map of the states. *)
Theorem columns_after_map_of_state (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) :
  (forall r, behavior S r <-> behavior S' r) -> exists T : 'M_(n', n), forall s i, solves S s (row i (sysF S' *m T)) (row i (sysG S')).
Proof.
move=> same; have [T TE] := matching_states same; exists T => s i; rewrite row_mul; apply: (matched_faults TE) => u.
have /same := output_behavior S' 0 (fun k => u k *m delta_mx 0 i); move/(@behavior_word _ _ _ _ S s).
by apply: word_ext => k _; rewrite !rowE output_combined_faults.
Qed.

(** The state in the coordinates x T. *)
Lemma change_of_state_behavior (K : fieldType) n m p (S : system K n m p) T : T \in unitmx ->
  forall r, behavior (System (invmx T *m sysA S *m T) (sysF S *m T) (invmx T *m sysC S) (sysG S)) r <-> behavior S r.
Proof.
move=> unitT r; set Q := System _ _ _ _.
have out x v k : output Q (x *m T) v k = output S x v k.
  have st : state Q (x *m T) v k = state S x v k *m T.
    by elim: k => //= k ->; rewrite !mulmxA mulmxK // mulmxDl -!mulmxA.
  by rewrite /output st /= mulmxA mulmxK.
split=> -[x [v e]]; first by exists (x *m invmx T), v => k; rewrite e -out mulmxKV.
by exists (x *m T), v => k; rewrite e out.
Qed.

(** Ledger: theorem-3-i, without the same (A, C). *)
Theorem columns_after_change_of_state (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) :
  (forall r, behavior S r <-> behavior S' r) -> exists T, [/\ T \in unitmx,
    forall r, behavior (System (invmx T *m sysA S' *m T) (sysF S' *m T) (invmx T *m sysC S') (sysG S')) r <-> behavior S r
  & forall s i, solves S s (row i (sysF S' *m T)) (row i (sysG S'))].
Proof.
move=> same; have [T0 T0E] := matching_states same.
have [|T unitT TU] := @unit_modulo K n T0 (zero_states S).
  rewrite -zeta_zero_states; have [_ _ ->] := equal_behaviors_equal_zeta same; rewrite zeta_zero_states.
  apply: mxrankS; apply/row_subP => i; set x := row i _.
  have xU : (x *m T0 <= zero_states S)%MS.
    by rewrite submxE -mulmxA; apply/eqP/sub_kermxP; apply: row_sub.
  have [v vE] := T0E x; apply/(zero_state_delayed S' x (fun=> 0))/same.
  apply: behavior_ext ((zero_state_delayed S (x *m T0) v).2 xU) => k; case: ltnP => // _; by rewrite vE.
exists T; split=> // [r | s i]; first by rewrite same; apply: change_of_state_behavior.
rewrite row_mul -[T](subrK T0) mulmxDr -[row i (sysG S')]add0r; apply: solves_add.
  by apply: zero_state_solves; apply: submx_trans (submxMl _ _) TU.
apply: (matched_faults T0E) => u; have /same := output_behavior S' 0 (fun k => u k *m delta_mx 0 i); move/(@behavior_word _ _ _ _ S s).
by apply: word_ext => k _; rewrite !rowE output_combined_faults.
Qed.
