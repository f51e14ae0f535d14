(** The theorems put together as the claims are read: with the normal rank (the rank of the transfer matrix) for gap n, with zeros
    counted on the pencil, and on data. New is only that full excitation is not necessary. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra vector fraction.
From faultspace Require Import Vocabulary Basics Windows Proposition3 Lag SharpWindows.
From faultspace Require Import Problem11 Solutions NormalRank TransferRank Theorem3 Excitation.
From faultspace Require Import ExcitationExamples WeakExcitation SmallSystems LagNecessary SettledSolutions SolutionCount.
From faultspace Require Import ZeroFeedthrough Trajectory ClosedForm SilentSubspaces InfiniteZeros.
From faultspace Require Import SystemInfiniteZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section OneSystem.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (s : nat) (f : 'rV[K]_n) (g : 'rV[K]_p).

Lemma normal_rank : \rank (transfer S) = gap S n.
Proof. by rewrite -(gap_normal_rank S (leqnn n)). Qed.

Theorem growth_is_normal_rank_from_lag s : \rank (window S s.+1) = (\rank (window S s) + \rank (transfer S))%N <-> (lag S <= s)%N.
Proof. by rewrite normal_rank; apply: gap_sharp. Qed.

Theorem window_rank_by_indices s : \rank (window S s) = (s * \rank (transfer S) + \sum_(e <- etas S) minn s e)%N.
Proof. by rewrite normal_rank; apply: rank_window_etas. Qed.

Theorem theorem_2_general s : (\rank (window S s) + zeta S = n + s * \rank (transfer S))%N <-> (lag S <= s)%N.
Proof. by rewrite normal_rank; apply: rank_window_zeta. Qed.

Theorem gap_on_data x v N N' s : left_invertible S -> (lag S <= s)%N -> (N' <= N)%N -> row_full (excitation S x v N' s.+1) ->
  \rank (hankel N' s.+1 (output S x v)) = (\rank (hankel N s (output S x v)) + m)%N.
Proof. by move=> inv ls NN full; rewrite (gap_of_data NN full) ((lagP S s).2 ls) (gap_left_invertible S (leqnn n)).2. Qed.

(** With normal rank p: no left index, and everything solves problem (11). *)
Theorem lag_full_rank : \rank (transfer S) = p -> lag S = 0%N.
Proof. by rewrite normal_rank; apply: lag_square. Qed.

Theorem all_columns_solve_full_rank s f g : \rank (transfer S) = p -> solves S s f g.
Proof. by rewrite normal_rank; apply: all_columns_solve. Qed.

Theorem solution_dimension s k (Z : 'M[K]_(k, n + p)) : spans_solutions S s.+1 Z ->
  \rank Z = (\rank (transfer S) + zeta S)%N <-> (lag S <= s)%N.
Proof. by rewrite normal_rank; apply: solution_count_zeta. Qed.

(** Zeros counted on the pencil: the degree of the greatest common divisor g of its maximal minors, and the order d of its zero at
    infinity. *)
Section Zeros.
Variables (g : {poly K}) (d : nat).
Hypotheses (inv : left_invertible S) (finite : gcd_of_minors (pencil S) g) (infinite : infinite_zeros S d).

Theorem window_rank_by_zeros s : (\rank (window S s) + ((size g).-1 + d) = n + s * m)%N <-> (lag S <= s)%N.
Proof. by rewrite -(zeta_counts_zeros inv finite infinite); apply: theorem_2. Qed.

Theorem solution_dimension_by_zeros s k (Z : 'M[K]_(k, n + p)) : spans_solutions S s.+1 Z ->
  \rank Z = (m + ((size g).-1 + d))%N <-> (lag S <= s)%N.
Proof.
move=> /solution_dimension; rewrite (zeta_counts_zeros inv finite infinite).
by rewrite ((left_invertible_transfer_rank S).1 inv).
Qed.

Lemma finite_zero_count : (size g).-1 = \rank (zero_holding S).
Proof.
have [h [[div_h max_h] size_h]] := number_of_finite_zeros inv; have [div_g max_g] := finite.
by have /eqp_size -> : g %= h; [rewrite /eqp max_h // max_g | rewrite size_h].
Qed.
End Zeros.

(** Left-invertible or not: zeros in the minors of order n + r, the normal rank of the pencil, and right indices beside them. *)
Theorem limit_dimension s k (Z : 'M[K]_(k, n + p)) c (Y : 'M_(n + m, c)) (g : {poly K}) d :
  spans_solutions S s.+1 Z -> minimal_basis (pencil S)^T Y ->
  gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g -> system_infinite_zeros S d ->
  \rank Z = (\rank (transfer S) + (\sum_(j < c) degree Y j + (size g).-1 + d))%N <-> (lag S <= s)%N.
Proof.
move=> span basis; rewrite normal_rank => finite infinite; rewrite -(zeta_system basis finite infinite).
exact: solution_count_zeta.
Qed.

(** v from an unknown initial state: all finite zeros, as many as g has roots, are the unobservable modes, n - rank O_n of them. *)
Theorem recovered_blindly_by_zeros (g : {poly K}) : gcd_of_minors (pencil S) g ->
  faults_recovered_blindly S <-> left_invertible S /\ (size g).-1 = (n - \rank (O S n))%N.
Proof.
move=> finite; rewrite faults_recovered_blindly_rank.
by split=> -[inv e]; split=> //; move: e; rewrite (finite_zero_count inv finite).
Qed.

Theorem zero_feedthrough_by_zeros s (g : {poly K}) : (n < s)%N -> sysG S = 0 -> left_invertible S -> gcd_of_minors (pencil S) g ->
  ((forall f, solves S s f 0 -> (f <= sysF S)%MS) <-> zeta S = m) /\
  ((forall f, solves S s f 0 -> (f <= sysF S)%MS) <-> \rank (sysF S *m sysC S) = m /\ (size g).-1 = 0%N).
Proof.
move=> ns G0 inv finite; split; first exact: zero_feedthrough_zeta.
rewrite (zero_feedthrough ns G0 inv) (finite_zero_count inv finite); split=> -[e h]; split=> //.
  by apply/eqP; rewrite mxrank_eq0; apply/eqP/row_matrixP => i; rewrite row0; apply/h/zero_holdingP/row_sub.
by move=> x /zero_holdingP; move/eqP: h; rewrite mxrank_eq0 => /eqP ->; rewrite submx0 => /eqP.
Qed.

Theorem dimension_by_zeros (g : {poly K}) d : left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d ->
  n = (sumn (etas S) + ((size g).-1 + d))%N.
Proof. by move=> inv finite infinite; rewrite -(zeta_counts_zeros inv finite infinite) subnKC ?sum_etas_le_n. Qed.

Theorem criterion_left_invertible s k (Z : 'M[K]_(k, n + p)) (P : 'M_(m, k)) :
  (lag S < s)%N -> spans_solutions S s Z -> left_invertible S ->
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> \rank (transfer (faults_of S (P *m Z))) = m.
Proof. by move=> long span inv; rewrite -left_invertible_transfer_rank; exact: (theorem_3_criterion_sharp long span P inv). Qed.

(** The partner of LagNecessary.v has one state more and as many faults. *)
Theorem partner_with_as_many_faults : (0 < lag S)%N -> exists S' : system K (n + 1) m p,
  [/\ left_invertible S -> left_invertible S', (lag S' <= lag S)%N, gap S' (n + 1) = gap S n,
      forall r, word S (lag S) r <-> word S' (lag S) r & exists r, word S' (lag S).+1 r /\ ~ word S (lag S).+1 r].
Proof. by case lag_S: (lag S) => [//|M] _; have := lag_plus_1_samples_are_necessary lag_S; rewrite lag_S. Qed.

(** No zeros: P is square, and good iff it is invertible. *)
Theorem no_zeros s k (Z : 'M[K]_(k, n + p)) (P : 'M_k) : (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> zeta S = 0%N ->
  k = \rank (transfer S) /\ ((forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> \det P != 0).
Proof.
case: s => // s long span free none; have dim : k = \rank (transfer S).
  by rewrite -[LHS](eqP free) ((solution_dimension span).2 long) none addn0.
split=> //; rewrite (theorem_3_normal_rank_sharp long span) -dim.
have same : \rank (transfer (faults_of S Z)) = k.
  transitivity (\rank (transfer S)); last by [].
  have [+ _] := theorem_3_normal_rank_sharp long span 1%:M; rewrite mul1mx; apply=> r.
  split; first move: r.
    by apply/(inclusion_on_lag_plus_1_samples (faults_of S Z) (long : (lag S <= s)%N)); apply/(included_rows _ _ span); rewrite hsubmxK.
  have /submxP[P0 own] : (row_mx (sysF S) (sysG S) <= Z)%MS.
    by apply/row_subP => i; rewrite row_row_mx !rowE; apply/span/own_fault_solves.
  have [eF eG] : sysF S = P0 *m lsubmx Z /\ sysG S = P0 *m rsubmx Z by apply: eq_row_mx; rewrite own -mul_mx_row hsubmxK.
  move=> [x [v e]]; exists x, (fun j => v j *m P0) => i.
  rewrite e -(output_combined_faults (faults_of S Z)) /= -eF -eG; congr output; exact/esym/with_own_faults.
pose PP := over_fractions (map_mx polyC P).
have -> : transfer (faults_of S (P *m Z)) = PP *m transfer (faults_of S Z).
  rewrite /transfer /= -mulmx_lsub -mulmx_rsub /over_fractions !map_mxM mulmxDr !mulmxA. by [].
rewrite -unitfE -unitmxE -row_full_unit; split=> [full|full].
  have := mxrankM_maxl PP (transfer (faults_of S Z)); rewrite full /PP rank_over_const => h.
  by rewrite /row_full eqn_leq h rank_leq_row.
by rewrite (eqmxMfull _ _) // /row_full rank_over_const.
Qed.

(** One fault: every nonzero P is good; normal rank 1, not only m = 1. *)
Theorem one_fault s k (Z : 'M[K]_(k, n + p)) (P : 'rV_k) : (lag S < s)%N -> spans_solutions S s Z -> row_free Z ->
  row_free (O S n) -> \rank (transfer S) = 1%N -> (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> P != 0.
Proof.
move=> long span free obs one; rewrite (theorem_3_normal_rank_sharp long span) one; split=> [full|nonzero].
  apply: contra_eq_neq full => ->; rewrite mul0mx /transfer /over_fractions /= linear0 [rsubmx 0]linear0 !map_mx0.
  by rewrite !mul0mx addr0 mxrank0.
apply/left_invertible_transfer_rank/observable_single_left_invertible; last first.
  by rewrite hsubmxK mulmx_free_eq0.
suff -> : O (faults_of S (P *m Z)) n = O S n by [].
by apply/row_matrixP => i; rewrite !rowK; apply: samples_ext => j _; rewrite output_free.
Qed.

End OneSystem.

Section TwoSystems.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).

Theorem equal_on_lag_plus_1_of_either N : \rank (transfer S) = \rank (transfer S') -> (lag S <= N)%N ->
  (forall r, word S N.+1 r <-> word S' N.+1 r) <-> (forall r, behavior S r <-> behavior S' r).
Proof. by rewrite !normal_rank; apply: theorem_1_either_lag. Qed.

End TwoSystems.

(** All pairs that make the same behaviour have the same number of zeros. *)
Theorem zeros_of_equivalent_pairs (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) g d :
  (forall r, behavior S r <-> behavior S' r) -> left_invertible S' -> gcd_of_minors (pencil S') g -> infinite_zeros S' d ->
  ((size g).-1 + d)%N = zeta S.
Proof. by move=> /equal_behaviors_equal_zeta[_ _ ->] inv finite infinite; rewrite (zeta_counts_zeros inv finite infinite). Qed.

(** Counting finite zeros only: x(k+1) = v(k), r = x has no finite zero and one infinite one. *)
Theorem finite_zeros_are_not_all (K : fieldType) : exists S : system K 1 1 1,
  [/\ observable S, fault_controllable S, left_invertible S & exists2 g, gcd_of_minors (pencil S) g &
    forall s, (1 <= s)%N -> (\rank (window S s) + (size g).-1)%N <> (1 + s * 1)%N].
Proof.
pose S : system K 1 1 1 := System 0 1%:M 1%:M 0; have out v k : output S 0 v k = if k is j.+1 then v j else 0.
  by rewrite /output mulmx0 addr0 mulmx1; case: k => //= k; rewrite mulmx0 add0r mulmx1.
have inv : left_invertible S by move=> v silent k; rewrite -[RHS](silent k.+1) out.
have [g [finite size_g]] := number_of_finite_zeros inv; have e := zeta_counts_zeros inv finite (number_of_infinite_zeros inv).
exists S; split=> //.
- by apply: observable_from_zeros => x /(_ 0%N isT); rewrite /output /= mulmx1 mulmx0 addr0.
- by move=> y; exists 1%N, (fun=> y); rewrite /= mul0mx add0r mulmx1.
have full : \rank (silent_from_rest S 1) = 1%N.
  apply/eqP; rewrite -/(row_full _) -sub1mx; apply/row_subP => i; apply/(reachable_silently S); exists 1%N, (fun=> row i 1%:M).
  by split=> [[|//] _|]; [rewrite out | rewrite /= mul0mx add0r mulmx1].
exists g => // s s1 short; have := (theorem_2 s inv).2 (leq_trans (lag_le_n S) s1).
by rewrite e full addnA short addn1 => /eqP; rewrite eqn_leq ltnn.
Qed.

Lemma pulse_excites (K : fieldType) q : persistently_exciting q.+1 q.+1 (fun k => (k == q)%:R%:M : 'rV[K]_1).
Proof.
apply/row_fullP; exists (\matrix_(i, j) vec_mx (row i 1%:M : 'rV[K]_(q.+1 * 1)) (rev_ord j) 0).
apply/row_matrixP => i; rewrite row_mul; set u := row i 1%:M.
apply/rowP => l; case/mxvec_indexP: l => k j; rewrite ord1 mxE (bigD1 (rev_ord k)) //= big1 ?addr0 => [|a ak].
  by rewrite !mxE mxvecE !mxE /= rev_ordK subSS subnK ?eqxx ?mulr1 ?mulr1n // -ltnS ltn_ord.
have /negbTE late : (a + k != q)%N by apply: contra ak => /eqP e; apply/eqP/val_inj; rewrite /= subSS -[X in (X - _)%N]e addnK.
by rewrite [X in _ * X]mxE mxvecE mxE late [X in _ * X]mxE mul0rn mulr0.
Qed.

Theorem excitation_is_not_necessary (K : fieldType) s : (1 <= s)%N -> exists (S : system K 1 1 (1 + 1)) x v N,
  [/\ observable S, inverts_at_once S, forall N', ~ row_full (excitation S x v N' s.+1)
    & \rank (hankel N s.+1 (output S x v)) = (\rank (hankel N.+1 s (output S x v)) + 1)%N].
Proof.
move=> s0; pose S : system K 1 1 (1 + 1) := System 0 0 (row_mx 1%:M 0) (row_mx 0 1%:M).
pose v k : 'rV[K]_1 := (k == s.+1)%:R%:M.
have once : inverts_at_once S.
  by move=> x w; rewrite /output !mul_mx_row !mulmx0 !mulmx1 add_row_mx add0r addr0 -row_mx0 => /eq_row_mx[].
have inv := at_once_left_invertible once.
exists S, 0, v, (1 + s.+2)%N; split=> // [|N' /row_fullP[B]|].
- apply: observable_from_zeros => x /(_ 0%N isT).
  by rewrite /output /= mul0mx addr0 mul_mx_row mulmx1 mulmx0 -row_mx0 => /eq_row_mx[].
- move/(congr1 (fun M => M *m col_mx (1%:M : 'M_1) 0)); rewrite mul1mx -mulmxA.
  have -> : excitation S 0 v N' s.+1 *m col_mx (1%:M : 'M_1) 0 = 0.
    apply/row_matrixP => i; rewrite row_mul rowK mul_row_col mulmx0 addr0 mulmx1 row0.
    by elim: (i : nat) => //= k ->; rewrite !mulmx0 addr0.
  by rewrite mulmx0 -col_mx0 => /eq_col_mx[/matrixP/(_ 0 0)/eqP]; rewrite !mxE eq_sym oner_eq0.
have pe : persistently_exciting s.+2 (1 + s.+1) v := pulse_excites K s.+1.
exact: (persistency_gap_from_lag 0 pe inv (leq_trans (lag_le_n S) s0)).
Qed.

(** Full excitation of [X V_s] at the same s is not enough. *)
Theorem excitation_at_s (K : fieldType) N N' : let S := delayed_fault K in
  let v k : 'rV[K]_1 := (~~ odd k)%:R%:M in let r := output S 0 v in
  [/\ observable S, inverts_at_once S, row_full (excitation S 0 v N.+2 1) & \rank (hankel N' 2 r) <> (\rank (hankel N.+2 1 r) + 1)%N].
Proof.
move=> S v r; have [full differ] := excitation_at_s_is_not_enough K N N'.
by split=> //; [exact: delayed_fault_observable | exact: delayed_fault_at_once].
Qed.
