(** zeta = n - sum eta of Lag.v is the dimension of V + S, for every system. V: the states from which the output can be zero for ever (the
    largest output-nulling subspace). S: the states reachable from rest with zero output (the smallest input-containing subspace). Both are
    counted in kernels of windows; of a silent fault from rest on 2 n samples, the state after n is any state of V and S.

    silent_from_rest_at S k y == y is the state at time k after faults from rest with zero output at all times before
         silent_from_rest S k == these states, as a row space; all of S* for k = n
               state_at S s k == the state at time k from rest, linear in s faults side by side
             first_faults s t == the first s of s + t faults
             later_faults s t == t faults after s times without *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra zify.
From faultspace Require Import Vocabulary Basics Windows Chain Lag Trajectory.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions. The second subspace; the first is zero_holding of Trajectory.v, with silent_for_ever. *)
Definition silent_from_rest_at K n m p (S : system K n m p) k y :=
  exists v, (forall j, (j < k)%N -> output S 0 v j = 0) /\ state S 0 v k = y.

(** Increasing chains of subspaces. *)
Section IncreasingChains.
Variables (K : fieldType) (n : nat) (f : 'M[K]_n -> 'M[K]_n).
Hypothesis f_mono : forall U V : 'M[K]_n, (U <= V)%MS -> (f U <= f V)%MS.
Let R k := iter k f 0.

Lemma increasing j k : (j <= k)%N -> (R j <= R k)%MS.
Proof.
move=> /subnK <-; elim: (k - j)%N => [|d IH]; first exact: submx_refl.
apply: submx_trans IH _; rewrite addSn; elim: (d + j)%N => [|i IH]; [exact: sub0mx | exact: f_mono].
Qed.

Lemma increasing_stops k : (exists2 j, (j < k)%N & (R j.+1 <= R j)%MS) \/ (k <= \rank (R k))%N.
Proof.
elim: k => [|k [[j jk h]|IH]]; [by right | by left; exists j => //; apply: leqW | ].
have [h|h] := boolP (R k.+1 <= R k)%MS; first by left; exists k.
by right; apply: leq_ltn_trans IH (rank_ltmx _); rewrite /ltmx h increasing.
Qed.

Lemma increasing_constant k : (R k <= R n)%MS.
Proof.
have [kn|/ltnW nk] := leqP k n; first exact: increasing.
have [[j jn h]|] := increasing_stops n.+1; last by rewrite ltnNge rank_leq_row.
have stays d : (R (d + j)%N <= R j)%MS.
  elim: d => [|d IH]; first exact: submx_refl.
  by apply: submx_trans h; apply: f_mono.
apply: submx_trans (increasing (jn : (j <= n)%N)).
by have := stays (k - j)%N; rewrite subnK // (leq_trans _ nk).
Qed.

End IncreasingChains.

Section SilentSubspaces.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x y : 'rV[K]_n) (v : nat -> 'rV[K]_m) (s t k : nat).

Definition silent_from_rest k : 'M[K]_n := iter k (silent_step S) 0.

Lemma silent_from_restP k y : (y <= silent_from_rest k)%MS <-> silent_from_rest_at S k y.
Proof.
elim: k y => [|k IH] y.
  rewrite submx0; split=> [/eqP -> | [v [_ <-]]]; last exact: eqxx.
  by exists (fun=> 0).
rewrite [silent_from_rest _]/= silent_stepP; split=> [[x [w [/IH[v [h ex] e <-]]]] | [v [h <-]]].
  exists (follow k v (fun=> w)); split=> [j|]; last by rewrite -[k.+1 in LHS]addn1 state_follow_after /= ex.
  rewrite ltnS leq_eqVlt => /orP[/eqP->|jk]; last by rewrite output_follow_before ?h.
  by rewrite -[k in output _ _ _ k]addn0 output_follow_after /output /= ex.
exists (state S 0 v k), (v k); split=> //; last exact: (h k).
by apply/IH; exists v; split=> // j jk; apply/h/leqW.
Qed.

(** Reachable from rest with zero output, in any time. *)
Theorem reachable_silently y : (y <= silent_from_rest n)%MS <-> exists k, silent_from_rest_at S k y.
Proof.
split=> [/silent_from_restP h | [k /silent_from_restP h]]; first by exists n.
exact: submx_trans h (increasing_constant (@silent_step_mono _ _ _ _ S) k).
Qed.

(** Faults of s samples that are silent from rest, and their states at time k. *)
Notation rest s := (kermx (T S s)).

Lemma restP s w : (w <= rest s)%MS <-> forall k, (k < s)%N -> output S 0 (unsamples w) k = 0.
Proof. by rewrite (sameP sub_kermxP eqP) mul_T; split=> [/eqP/samples_eq0 | /samples_eq0 ->]. Qed.

Lemma rest_samples s v : (samples s v <= rest s)%MS <-> forall k, (k < s)%N -> output S 0 v k = 0.
Proof.
rewrite restP; split=> h k ks; rewrite -[RHS](h k ks); apply: output_ext => j jk; rewrite samplesK //; exact: leq_ltn_trans jk ks.
Qed.

Fact state_linear s k : linear (fun w : 'rV[K]_(s * m) => state S 0 (unsamples w) k).
Proof.
move=> a u w; rewrite -state_scale -state_add scaler0 addr0.
by apply: state_ext => j _; rewrite unsamples_linear.
Qed.
Definition state_at s k := lin1_mx (fun w : 'rV[K]_(s * m) => state S 0 (unsamples w) k).

Lemma mul_state_at s k (w : 'rV[K]_(s * m)) : w *m state_at s k = state S 0 (unsamples w) k.
Proof. exact: mul_lin1 (@state_linear s k). Qed.

Fact first_faults_linear s t : linear (fun w : 'rV[K]_((s + t) * m) => samples s (unsamples w)).
Proof. by move=> a u w; rewrite -samples_scale -samples_add; apply: samples_ext => k _; rewrite unsamples_linear. Qed.
Definition first_faults s t := lin1_mx (fun w : 'rV[K]_((s + t) * m) => samples s (unsamples w)).

Lemma mul_first_faults s t (w : 'rV[K]_((s + t) * m)) : w *m first_faults s t = samples s (unsamples w).
Proof. exact: mul_lin1 (@first_faults_linear s t). Qed.

Fact later_faults_linear s t : linear (fun w : 'rV[K]_(t * m) => samples (s + t) (follow s (fun=> 0) (unsamples w))).
Proof.
move=> a u w; rewrite -samples_scale -samples_add; apply: samples_ext => k _.
by rewrite /follow; case: ifP => _; rewrite ?scaler0 ?addr0 // unsamples_linear.
Qed.
Definition later_faults s t := lin1_mx (fun w : 'rV[K]_(t * m) => samples (s + t) (follow s (fun=> 0) (unsamples w))).

Lemma mul_later_faults s t (w : 'rV[K]_(t * m)) : w *m later_faults s t = samples (s + t) (follow s (fun=> 0) (unsamples w)).
Proof. exact: mul_lin1 (@later_faults_linear s t). Qed.

Lemma rank_rest s : \rank (rest s) = (\rank (silent_from_rest s) + \rank (rest s :&: kermx (state_at s s)))%N.
Proof.
rewrite -(mxrank_mul_ker (rest s) (state_at s s)); congr (_ + _)%N; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  by rewrite row_mul mul_state_at; apply/silent_from_restP; exists (unsamples (row i (rest s))); split=> //; apply/restP/row_sub.
have /silent_from_restP[v [h <-]] := row_sub i (silent_from_rest s).
apply: submx_trans (_ : (samples s v *m state_at s s <= _)%MS); last first.
  exact/submxMr/rest_samples.
by rewrite mul_state_at (state_ext _ _ (w := v)) // => j js; rewrite samplesK.
Qed.

Lemma later_free s t : row_free (later_faults s t).
Proof.
apply: inj_row_free => w; rewrite mul_later_faults => /samples_eq0 w0; rewrite -[w]unsamplesK; apply/samples_eq0 => k kt.
by have := w0 (s + k)%N; rewrite ltn_add2l kt /follow ltnNge leq_addr addKn; apply.
Qed.

(** Back at rest at time s: two silent faults from rest, the first of which ends at rest. *)
Lemma rank_back_at_rest s t :
  \rank (rest (s + t) :&: kermx (state_at (s + t) s)) = (\rank (rest s :&: kermx (state_at s s)) + \rank (rest t))%N.
Proof.
set D := (_ :&: _)%MS; rewrite -(mxrank_mul_ker D (first_faults s t)) -(mxrankMfree (rest t) (later_free s t)).
have DP w : (w <= D)%MS <-> (forall k, (k < s + t)%N -> output S 0 (unsamples w) k = 0) /\ state S 0 (unsamples w) s = 0.
  rewrite sub_capmx (sameP (sub_kermxP (A := state_at _ _)) eqP) mul_state_at; split=> [/andP[/restP h /eqP] //|[/restP -> ->]].
  by rewrite eqxx.
congr (_ + _)%N; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
- rewrite row_mul mul_first_faults; have /DP[h e] := row_sub i D; move: (row i D) h e => w h e.
  rewrite sub_capmx (sameP (sub_kermxP (A := state_at _ _)) eqP) mul_state_at; apply/andP; split.
    by apply/rest_samples => k ks; apply: h; apply: ltn_addr.
  by apply/eqP; rewrite -[RHS]e; apply: state_ext => j js; rewrite samplesK.
- have := row_sub i (rest s :&: kermx (state_at s s))%MS; move: (row i _) => u; rewrite sub_capmx => /andP[/restP h].
  rewrite (sameP sub_kermxP eqP) mul_state_at => /eqP e.
  pose w : 'rV[K]_((s + t) * m) := samples (s + t) (follow s (unsamples u) (fun=> 0)).
  have wE k : (k < s + t)%N -> unsamples w k = follow s (unsamples u) (fun=> 0) k by apply: samplesK.
  suff Dw : (w <= D)%MS.
    apply: submx_trans (submxMr _ Dw); rewrite mul_first_faults; suff -> : u = samples s (unsamples w) by [].
    by rewrite -[LHS]unsamplesK; apply: samples_ext => k ks; rewrite wE ?ltn_addr // /follow ks.
  apply/DP; split=> [k kst|].
    rewrite (output_ext _ _ (w := follow s (unsamples u) (fun=> 0))) => [|j jk]; last by apply/wE/(leq_ltn_trans jk).
    have [ks|sk] := ltnP k s; first by rewrite output_follow_before ?h.
    by rewrite -(subnKC sk) output_follow_after e output_zero.
  rewrite (state_ext _ _ (w := follow s (unsamples u) (fun=> 0))) => [|j jk]; last by rewrite wE // ltn_addr.
  by rewrite state_follow_before.
- have := row_sub i (D :&: kermx (first_faults s t))%MS; move: (row i _) => w; rewrite sub_capmx => /andP[/DP[h e]].
  rewrite (sameP sub_kermxP eqP) mul_first_faults => /eqP/samples_eq0 w0.
  have wE : w = samples t (fun k => unsamples w (s + k)%N) *m later_faults s t.
    rewrite mul_later_faults -[LHS]unsamplesK; apply: samples_ext => k kst; rewrite /follow.
    by case: ltnP => sk; [rewrite w0 | rewrite samplesK ?subnKC // ltn_subLR].
  rewrite wE; apply/submxMr/rest_samples => k kt; have := h (s + k)%N; rewrite ltn_add2l kt => <- //.
  by rewrite output_shift e.
rewrite row_mul; have := row_sub i (rest t); move: (row i (rest t)) => u /restP h; rewrite mul_later_faults.
set w := samples _ _; have wE k : (k < s + t)%N -> unsamples w k = follow s (fun=> 0) (unsamples u) k by apply: samplesK.
rewrite sub_capmx; apply/andP; split; last first.
  apply/sub_kermxP; rewrite mul_first_faults; apply/samples_eq0 => k ks.
  by rewrite wE ?ltn_addr // /follow ks.
have at_s : state S 0 (follow s (fun=> 0) (unsamples u)) s = 0 by rewrite state_follow_before // state_zero.
apply/DP; split=> [k kst|].
  rewrite (output_ext _ _ (w := follow s (fun=> 0) (unsamples u))) => [|j jk]; last by apply/wE/(leq_ltn_trans jk).
  have [ks|sk] := ltnP k s; first by rewrite output_follow_before ?output_zero.
  by rewrite -(subnKC sk) output_follow_after state_zero // h // ltn_subLR.
by rewrite -[RHS]at_s; apply: state_ext => j js; rewrite wE // ltn_addr.
Qed.

(** At time s on the way: any state reached at s from which t zeros are possible. *)
Lemma rank_on_the_way s t : \rank (rest (s + t)) =
  (\rank (silent_from_rest s :&: iter t (hold_step S) 1%:M) + \rank (rest (s + t) :&: kermx (state_at (s + t) s)))%N.
Proof.
rewrite -(mxrank_mul_ker (rest (s + t)) (state_at (s + t) s)); congr (_ + _)%N; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  rewrite row_mul mul_state_at; have /restP := row_sub i (rest (s + t)); move: (row i _) => w h.
  rewrite sub_capmx; apply/andP; split.
    by apply/silent_from_restP; exists (unsamples w); split=> // j js; apply: h; apply: ltn_addr.
  by apply/holdP; exists (fun k => unsamples w (s + k)%N) => j jt; rewrite -output_shift h // ltn_add2l.
have := row_sub i (silent_from_rest s :&: iter t (hold_step S) 1%:M)%MS; move: (row i _) => x; rewrite sub_capmx.
case/andP => /silent_from_restP[v [h <-]] /holdP[u q].
apply: submx_trans (_ : (samples (s + t) (follow s v u) *m state_at (s + t) s <= _)%MS).
  rewrite mul_state_at (state_ext _ _ (w := v)) // => j js.
  by rewrite samplesK ?ltn_addr // /follow js.
apply/submxMr/rest_samples => k kst; have [ks|sk] := ltnP k s; first by rewrite output_follow_before ?h.
by rewrite -(subnKC sk) output_follow_after q // ltn_subLR.
Qed.

(** The kernel of the window. *)
Lemma rank_silent_window s : \rank (kermx (window S s)) = (\rank (iter s (hold_step S) 1%:M) + \rank (rest s))%N.
Proof.
pose x0 : 'M[K]_(n + s * m, n) := col_mx 1%:M 0.
have mul_x0 x (w : 'rV_(s * m)) : row_mx x w *m x0 = x by rewrite mul_row_col mulmx1 mulmx0 addr0.
rewrite -(mxrank_mul_ker (kermx (window S s)) x0); congr (_ + _)%N.
  apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
    rewrite row_mul; have := row_sub i (kermx (window S s)); rewrite -[row i _]hsubmxK mul_x0 => /sub_kermxP/window_kernel h.
    by apply/holdP; exists (unsamples (rsubmx (row i (kermx (window S s))))).
  have /holdP[v h] := row_sub i (iter s (hold_step S) 1%:M); rewrite -[row i _](mul_x0 _ (samples s v)); apply: submxMr.
  by apply/sub_kermxP; rewrite window_response; apply/samples_eq0.
pose e : 'M[K]_(s * m, n + s * m) := row_mx 0 1%:M.
have e_free : row_free e.
  by apply/row_freeP; exists (col_mx 0 1%:M); rewrite mul_row_col mulmx0 mulmx1 add0r.
rewrite -(mxrankMfree (rest s) e_free); apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  have := row_sub i (kermx (window S s) :&: kermx x0)%MS; move: (row i _) => z; rewrite -[z]hsubmxK sub_capmx.
  case/andP => /sub_kermxP ker /sub_kermxP; rewrite mul_x0 => z0; rewrite z0 in ker *.
  have -> : row_mx 0 (rsubmx z) = rsubmx z *m e by rewrite mul_mx_row mulmx0 mulmx1.
  by apply/submxMr/sub_kermxP; move: ker; rewrite mul_row_col mul0mx add0r.
rewrite row_mul mul_mx_row mulmx0 mulmx1 sub_capmx; apply/andP; split; apply/sub_kermxP; last by rewrite mul_x0.
by rewrite mul_row_col mul0mx add0r; apply/sub_kermxP/row_sub.
Qed.

(** From n samples on: what theorem-2 says of silent faults from rest. *)
Lemma rank_rest_zeta k : (n <= k)%N -> (\rank (zero_holding S) + \rank (rest k) + k * gap S n = zeta S + k * m)%N.
Proof.
move=> nk; have holding : \rank (iter k (hold_step S) 1%:M) = \rank (zero_holding S).
  apply: eqmx_rank; rewrite (iter_decreasing (@hold_step_mono _ _ _ _ S) nk).
  exact: (iter_constant (@hold_step_mono _ _ _ _ S) nk).
have := rank_silent_window k; rewrite mxrank_ker holding // => <-.
have := rank_leq_row (window S k); have := (rank_window_zeta S k).2 (leq_trans (lag_le_n S) nk); lia.
Qed.

(** For every system. *)
Theorem rank_silent_subspaces : \rank (zero_holding S + silent_from_rest n)%MS = zeta S.
Proof.
have twice : (\rank (zero_holding S) + \rank (rest (n + n)) + (n * gap S n + n * gap S n) = zeta S + (n * m + n * m))%N.
  by rewrite -!mulnDl rank_rest_zeta ?leq_addr.
move: twice; have := rank_rest_zeta (leqnn n).
have := rank_on_the_way n n; rewrite rank_back_at_rest -/(zero_holding S).
have := rank_rest n; have := mxrank_sum_cap (zero_holding S) (silent_from_rest n); rewrite capmxC; lia.
Qed.

(** When the system is left-invertible, V and S meet in 0 only: the sum is direct. *)
Lemma silent_subspaces_independent : left_invertible S -> forall x, (x <= zero_holding S)%MS -> (x <= silent_from_rest n)%MS -> x = 0.
Proof.
move=> inv x /zero_holdingP/silent_for_ever[w quiet] /silent_from_restP[v [h e]].
rewrite -e; apply: state_zero => j jn.
suff -> : v j = follow n v w j by apply: inv => k; have [kn|nk] := ltnP k n;
  [rewrite output_follow_before ?h | rewrite -(subnKC nk) output_follow_after e quiet].
by rewrite /follow jn.
Qed.

Theorem zeta_silent_subspaces : left_invertible S -> zeta S = (\rank (zero_holding S) + \rank (silent_from_rest n))%N.
Proof.
move=> inv; rewrite -rank_silent_subspaces -mxrank_sum_cap.
suff -> : (zero_holding S :&: silent_from_rest n)%MS = 0 by rewrite mxrank0 addn0.
apply/row_matrixP => i; rewrite row0; have := row_sub i (zero_holding S :&: silent_from_rest n)%MS; rewrite sub_capmx => /andP[].
exact: silent_subspaces_independent.
Qed.

(** zeta = 0 iff no state but 0 can stay silent for ever, or is reached silently from rest. *)
Theorem zeta0P : zeta S = 0%N <->
  (forall x, (exists v, forall k, output S x v k = 0) \/ (exists k, silent_from_rest_at S k x) -> x = 0).
Proof.
rewrite -rank_silent_subspaces; split=> [/eqP | none].
  rewrite mxrank_eq0 => /eqP sum0 x silent; apply/eqP; rewrite -submx0 -sum0.
  case: silent => [/silent_for_ever/zero_holdingP h | /reachable_silently h]; apply: submx_trans h _; [exact: addsmxSl | exact: addsmxSr].
apply/eqP; rewrite mxrank_eq0 -submx0 addsmx_sub; apply/andP; split; apply/row_subP => i.
  by rewrite (none (row i _)) ?sub0mx //; left; apply/silent_for_ever/zero_holdingP/row_sub.
by rewrite (none (row i _)) ?sub0mx //; right; apply/reachable_silently/row_sub.
Qed.

End SilentSubspaces.
