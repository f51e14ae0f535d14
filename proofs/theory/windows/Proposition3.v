(** proposition-3, repaired: the window rank grows by m from s to s + 1 samples iff the system is left-invertible, for every s >= n, and so
    for any single one. Neither controllability nor observability is needed. A pair (x, v) with x in W_n, zero output and next state zero is
    all that can spoil it: of the n + 1 last states of a silent trajectory that ends in zero with this pair, one depends on the later ones,
    and the difference of the trajectories started from there begins at rest, is silent, and still has this pair in it. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Chain Gap Balance.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Of n + 1 vectors, one depends on those before it. *)
Lemma one_depends (K : fieldType) n (f : nat -> 'rV[K]_n) :
  exists k (c : nat -> K), (k <= n)%N /\ f k = \sum_(i < k) c i *: f i.
Proof.
have [/existsP[k dep]|indep] := boolP [exists k : 'I_n.+1, (f k <= \matrix_(i < k) f i)%MS].
  have /submxP[c fk] := dep; exists k, (fun i => oapp (c 0) 0 (insub i)); split; first by rewrite -ltnS.
  by rewrite fk mulmx_sum_row; apply: eq_bigr => i _; rewrite rowK valK.
suff /(_ n.+1 (leqnn _)) : forall k, (k <= n.+1)%N -> (k <= \rank (\matrix_(i < k) f i))%N.
  by rewrite leqNgt ltnS rank_leq_col.
elim=> // k IH kn; apply: leq_ltn_trans (IH (ltnW kn)) (rank_ltmx _); rewrite /ltmx; apply/andP; split.
  by apply/row_subP=> i; rewrite rowK -[f i](rowK (fun j : 'I_k.+1 => f j) (widen_ord (leqnSn k) i)) row_sub.
move: indep; rewrite negb_exists => /forallP/(_ (Ordinal kn)); apply: contra; apply: submx_trans.
by rewrite -[f (Ordinal kn)](rowK (fun j : 'I_k.+1 => f j) ord_max) row_sub.
Qed.

Section Proposition3.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (w : 'rV[K]_m) (v : nat -> 'rV[K]_m).

(** States on a silent trajectory from rest are in W_n: one may wait first. *)
Lemma state_when_silent v k : (forall j, output S 0 v j = 0) -> (state S 0 v k <= silent S n)%MS.
Proof.
move=> out0; apply/silentP/(@chain_decreasing _ _ _ _ S n (n + k)%N); first exact: leq_addr.
exists 0, (follow n (fun=> 0) v); split=> [j _|]; last by rewrite state_follow_after state_zero.
have [jn|nj] := ltnP j n; first by rewrite output_follow_before // output_zero.
by rewrite -(subnKC nj) output_follow_after state_zero.
Qed.

Lemma first_fault_zero v : null S n = 0%N -> (forall k, output S 0 v k = 0) -> v 0%N = 0.
Proof.
move=> /null0P null0 out0.
suff x1 : state S 0 v 1 = 0.
  by have [_ //] := null0 _ (v 0%N) (state_when_silent 0 out0) (out0 0%N) x1.
have [k [c [_]]] := one_depends (fun i => state S 0 v i.+1).
elim: k c => [|k IH] c dep; first by rewrite dep big_ord0.
pose x := state S 0 v k.+1 - \sum_(i < k.+1) c i *: state S 0 v i.
pose w := v k.+1 - \sum_(i < k.+1) c i *: v i.
have [|||x0 _] := null0 x w.
- apply: addmx_sub; first exact: state_when_silent.
  by rewrite eqmx_opp; apply: summx_sub => i _; apply: scalemx_sub; apply: state_when_silent.
- rewrite !mulmxBl !mulmx_suml addrACA -opprD -big_split /= [X in X - _](out0 k.+1) big1 ?subr0 // => i _.
  by rewrite -!scalemxAl -scalerDr [X in _ *: X](out0 i) scaler0.
- rewrite !mulmxBl !mulmx_suml addrACA -opprD -big_split /= -[X in X - _]/(state S 0 v k.+2) dep.
  by apply/eqP; rewrite subr_eq0; apply/eqP/eq_bigr=> i _; rewrite -!scalemxAl -scalerDr.
apply: (IH (fun i => c i.+1)); move/eqP: x0; rewrite subr_eq0 => /eqP->.
by rewrite big_ord_recl /= scaler0 add0r.
Qed.

Lemma null0_left_invertible : null S n = 0%N -> left_invertible S.
Proof.
move=> null0 v out0 k; elim: k v out0 => [|k IH] v out0; first exact: first_fault_zero.
apply: (IH (fun i => v i.+1)) => j; rewrite -[RHS](out0 j.+1) output_step.
by rewrite (first_fault_zero null0 out0) !mul0mx addr0.
Qed.

Lemma left_invertible_null0 : left_invertible S -> null S n = 0%N.
Proof.
move=> linv; apply/null0P=> x w /silentP[y [v [out0 ey]]] e f.
(* the trajectory that ends with this pair, and rests in zero from then on *)
pose u := follow n v (fun i => if i is 0 then w else 0).
have un : u n = w by rewrite /u /follow ltnn subnn.
have xn : state S y u n = x by rewrite state_follow_before.
have rest k : (n < k)%N -> state S y u k = 0 /\ u k = 0.
  move=> nk; rewrite -(subnKC (ltnW nk)); have: (0 < k - n)%N by rewrite subn_gt0.
  case: (k - n)%N => // i _; split; last by rewrite /u /follow ltnNge leq_addr addKn.
  by rewrite state_follow_after ey state_step f state_zero.
have silent_u k : output S y u k = 0.
  have [kn|nk|->] := ltngtP k n; first by rewrite output_follow_before // out0.
    by rewrite /output; have [-> ->] := rest _ nk; rewrite !mul0mx addr0.
  by rewrite /output xn un.
have [k [c [kn dep]]] := one_depends (fun i => state S y u (n - i)).
pose z j := u (n - k + j)%N - \sum_(i < k) c i *: u (n - i + j)%N.
have z_traj j : state S 0 z j = state S y u (n - k + j) - \sum_(i < k) c i *: state S y u (n - i + j)%N.
  rewrite -[in LHS](subrr (state S y u (n - k)%N)) {2}dep state_sub -state_shift; congr (_ - _).
  by rewrite state_sum; apply: eq_bigr => i _; rewrite state_scale -state_shift.
have z0 : forall j, z j = 0.
  apply: linv => j; rewrite /output z_traj mulmxBl mulmx_suml mulmxBl mulmx_suml addrACA -opprD -big_split /=.
  rewrite [X in X - _](silent_u (n - k + j)%N) big1 ?subr0 // => i _.
  by rewrite -!scalemxAl -scalerDr [X in _ *: X](silent_u (n - i + j)%N) scaler0.
have later (i : 'I_k) : (n < n - i + k)%N.
  by rewrite -{1}(subnK (leq_trans (ltnW (ltn_ord i)) kn)) ltn_add2l.
split.
  move: (z_traj k); rewrite (state_zero S (fun j _ => z0 j)) subnK // xn big1 ?subr0 // => i _.
  by rewrite (rest _ (later i)).1 scaler0.
by move: (z0 k); rewrite /z subnK // un big1 ?subr0 // => i _; rewrite (rest _ (later i)).2 scaler0.
Qed.

Theorem left_invertibleP : left_invertible S <-> null S n = 0%N.
Proof. split; [exact: left_invertible_null0|exact: null0_left_invertible]. Qed.

Theorem gap_left_invertible s : (n <= s)%N -> gap S s = m <-> left_invertible S.
Proof.
move=> ns; rewrite left_invertibleP -(null_constant S ns); have e := faults_balance S ns; split=> h.
  by apply: (@addnI (gap S s)); rewrite -e addn0.
by rewrite [RHS]e h addn0.
Qed.

(** For any one s >= n, hence for all. *)
Theorem proposition_3 s : (n <= s)%N -> \rank (window S s.+1) = (\rank (window S s) + m)%N <-> left_invertible S.
Proof. by move=> ns; rewrite -(gap_left_invertible ns) rank_window_step; split=> [/addnI|->]. Qed.

(** In any case the rank grows by the same number, at most m, from n on. *)
Theorem proposition_3_general s : (n <= s)%N -> \rank (window S s.+1) = (\rank (window S s) + gap S n)%N /\ (gap S n <= m)%N.
Proof. by move=> ns; rewrite rank_window_step (gap_constant S ns) (gap_le_faults S (leqnn n)). Qed.

End Proposition3.
