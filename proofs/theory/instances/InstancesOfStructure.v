(** Instances for headlines on data, pairs and zeros, as InstancesOfLimits.v has them for those on limits.

       plain_lag == the plain system has lag 0
    zero_at_zero == a state that gives no output and goes to 0 makes 0 a zero
        sum_rows == the Popov rows of r1(t+1) = r1(t) + r2(t) *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary StructureVocabulary ExampleVocabulary PolynomialKernel Windows InstancesOfLimits.
From faultspace Require TransferRank UnobservableZeros EchelonExists Readings FollowingExamples Theorem3 ExceptionalPolynomial Existence.
From faultspace Require KernelRepresentation.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** assumption-4 *)

Section Excitation.
Variable K : fieldType.

Lemma plain_left_invertible : left_invertible (plain K).
Proof. by move=> v h k; have := h k.+1; rewrite /output /= !mulmx0 add0r addr0 !mulmx1. Qed.

Lemma plain_lag : lag (plain K) = 0%N.
Proof. exact/Readings.lag_full_rank/TransferRank.left_invertible_transfer_rank/plain_left_invertible. Qed.

(** v = 1, 0, 1, 0, ... *)
Let v k : 'rV[K]_1 := (~~ odd k)%:R%:M.

Lemma alternating_excites : persistently_exciting 2 2 v.
Proof.
rewrite /persistently_exciting /row_full -mxrank_tr -/(row_free _); apply: inj_row_free => z e.
have at_ (i : 'I_2) : \sum_(k < 2) v (i + k)%N *m (unsamples z k)^T = 0.
  have := congr1 (row i) (congr1 trmx e); rewrite trmx_mul trmxK trmx0 row_mul rowK row0.
  by rewrite -{1}[z]unsamplesK FollowingExamples.samples_dot.
have := at_ 0; have := at_ 1; rewrite !big_ord_recl !big_ord0 /v /= !raddf0 !mul0mx !mul1mx !addr0 add0r => z1 z0.
rewrite -[z]unsamplesK; apply/samples_eq0 => -[|[|//]] _; apply: trmx_inj; rewrite trmx0 //.
Qed.

Lemma alternating_excites_states : row_full (excitation (plain K) 0 v 2 1).
Proof.
rewrite /row_full -mxrank_tr -/(row_free _); apply: inj_row_free => z e.
have at_ (i : 'I_2) : state (plain K) 0 v i *m (lsubmx z)^T + v i *m (unsamples (rsubmx z) 0)^T = 0.
  have := congr1 (row i) (congr1 trmx e); rewrite trmx_mul trmxK trmx0 row_mul rowK row0 -{1}[z]hsubmxK tr_row_mx mul_row_col.
  by rewrite -{1}[rsubmx z]unsamplesK FollowingExamples.samples_dot big_ord1 addn0.
have b0 : rsubmx z = 0.
  rewrite -[rsubmx z]unsamplesK; apply/samples_eq0 => -[|//] _; apply: trmx_inj.
  by have := at_ 0; rewrite /v /= mul0mx add0r mul1mx trmx0.
have a0 : lsubmx z = 0.
  by apply: trmx_inj; have := at_ 1; rewrite /v /= mul0mx add0r !mul1mx raddf0 mul0mx addr0 trmx0.
by rewrite -[z]hsubmxK a0 b0 row_mx0.
Qed.

End Excitation.

Theorem assumption_4_excitation_at_s_plus_1_instance (K : fieldType) : exists n m p (S : system K n m p) x v N N' s,
  left_invertible S /\ (lag S <= s)%N /\ (N' <= N)%N /\ row_full (excitation S x v N' s.+1).
Proof.
exists 1%N, 1%N, 1%N, (plain K), 0; eexists; exists 2%N, 2%N, 0%N; rewrite plain_lag.
by do !split=> //; [exact: plain_left_invertible|exact: alternating_excites_states].
Qed.

Theorem assumption_4_persistency_suffices_instance (K : fieldType) : exists n m p (S : system K n m p) (v : nat -> 'rV[K]_m) M s,
  persistently_exciting M (n + s.+1) v /\ left_invertible S /\ (lag S <= s)%N.
Proof.
exists 1%N, 1%N, 1%N, (plain K); eexists; exists 2%N, 0%N; rewrite plain_lag.
by split; [exact: alternating_excites|split=> //; exact: plain_left_invertible].
Qed.

(** ** theorem-3-i *)

Theorem theorem_3_part_i_instance (K : fieldType) : exists n m m' p (S : system K n m p) (F : 'M_(m', n)) (G : 'M_(m', p)) s k
    (Z : 'M_(k, n + p)),
  same_behavior (with_faults S F G) S /\ spans_solutions S s Z.
Proof.
have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists (plain K) 2.
by exists 1%N, 1%N, 1%N, 1%N, (plain K), 1%:M, 0, 2%N, k, Z.
Qed.

(** ** theorem-3-ii *)

Theorem theorem_3_almost_every_instance (K : fieldType) : exists n m p (S : system K n m p) s
    (Z : 'M_(zeta S + \rank (transfer S), n + p)),
  (lag S < s)%N /\ spans_solutions S s Z /\ row_free Z.
Proof.
have [Z [_ [_ [_ [[span free] _ _ _ _]]]]] := ExceptionalPolynomial.coordinates_exist (plain K) (isT : (1 < 2)%N).
by exists 1%N, 1%N, 1%N, (plain K), 2%N, Z; rewrite plain_lag.
Qed.

(** No point of a line needs to be bad. *)
Theorem theorem_3_on_lines_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) (P P1 : 'M_(m, k))
    (ts : seq K),
  (n < s)%N /\ spans_solutions S s Z /\ left_invertible S /\ same_behavior (faults_of S (P *m Z)) S /\ uniq ts /\
  (forall t, t \in ts -> ~ same_behavior (faults_of S ((P + t *: P1) *m Z)) S).
Proof.
have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists (plain K) 2.
have [_ /(_ span)[P eP]] := Theorem3.theorem_3_part_i (S := plain K) (F := 1%:M) (G := 0) 2 Z (fun r => iff_refl _).
exists 1%N, 1%N, 1%N, (plain K), 2%N, k, Z, P, 0, [::]; split=> //; split=> //; split; first exact: plain_left_invertible.
by split=> // r; rewrite -eP /faults_of row_mxKl row_mxKr.
Qed.

(** ** theorem-2, window-ranks *)

Theorem zeros_exist_instance (K : fieldType) : exists n m p (S : system K n m p), left_invertible S.
Proof. by exists 1%N, 1%N, 1%N, (plain K); exact: plain_left_invertible. Qed.

Theorem window_ranks_zeros_instance (K : fieldType) : exists n m p (S : system K n m p) g d,
  left_invertible S /\ gcd_of_minors (pencil S) g /\ infinite_zeros S d.
Proof.
have [exist _ _ _] := Existence.zeros_exist (plain K); have [g [d [minors infinite]]] := exist (@plain_left_invertible K).
by exists 1%N, 1%N, 1%N, (plain K), g, d; split; first exact: plain_left_invertible.
Qed.

Theorem theorem_2_instance (K : fieldType) : exists n m p (S : system K n m p) g d,
  left_invertible S /\ gcd_of_minors (pencil S) g /\ infinite_zeros S d.
Proof. exact: window_ranks_zeros_instance. Qed.

(** ** zero-feedthrough, trajectory-recovered *)

Theorem zero_feedthrough_matrices_instance (K : fieldType) : exists n m p (S : system K n m p) s, (n < s)%N /\ sysG S = 0.
Proof. by exists 1%N, 1%N, 1%N, (plain K), 2%N. Qed.

Theorem zero_feedthrough_instance (K : fieldType) : exists n m p (S : system K n m p) s g,
  (n < s)%N /\ sysG S = 0 /\ left_invertible S /\ gcd_of_minors (pencil S) g.
Proof.
have [exist _ _ _] := Existence.zeros_exist (plain K); have [g [d [minors _]]] := exist (@plain_left_invertible K).
by exists 1%N, 1%N, 1%N, (plain K), 2%N, g; split=> //; split=> //; split; first exact: plain_left_invertible.
Qed.

Theorem zero_feedthrough_signal_instance (K : fieldType) : exists n m p (S : system K n m p) g,
  sysG S = 0 /\ left_invertible S /\ gcd_of_minors (pencil S) g.
Proof. by have [n [m [p [S [s [g [_ [G0 [inv minors]]]]]]]]] := zero_feedthrough_instance K; exists n, m, p, S, g. Qed.

Lemma zero_at_zero (K : fieldType) n p (S : system K n 1 p) (x : 'rV_n) :
  left_invertible S -> x != 0 -> x *m sysA S = 0 -> x *m sysC S = 0 -> zero_of S [the {rmorphism _ -> _} of idfun] 0.
Proof.
move=> /TransferRank.left_invertible_transfer_rank inv x0 xA xC; rewrite /zero_of inv ltn_neqAle rank_leq_row andbT.
apply/negP => free; have := mulmx_free_eq0 (row_mx x 0) free.
rewrite mul_row_block !mul0mx !addr0 !map_mx_id // raddf0 sub0r mulmxN xA oppr0 xC row_mx0 eqxx => /esym.
by rewrite row_mx_eq0 (negbTE x0).
Qed.

Theorem trajectory_multiplicity_instance (K : fieldType) :
  let S : system K (1 + 1) 1 1 := System (block_mx 0 0 0 1%:M) (row_mx 0 1%:M) (col_mx 0 1%:M) 1%:M in
  exists (L : fieldType) (f : {rmorphism K -> L}) z, zero_of S f z.
Proof.
have [inv _ _] := UnobservableZeros.twice_zero_not_recovered K.
move=> S; exists K, [the {rmorphism _ -> _} of idfun], 0; apply: (zero_at_zero (x := row_mx 1%:M 0)) => //.
- by rewrite row_mx_eq0 oner_eq0.
- by rewrite mul_row_block !mulmx0 !mul0mx !addr0 row_mx0.
by rewrite mul_row_col mulmx0 mul0mx addr0.
Qed.

Theorem trajectory_multiplicity_delayed_instance (K : fieldType) :
  let S : system K (1 + (1 + 1)) 1 1 :=
    System (block_mx 0 0 0 (block_mx 0 1%:M 0 0)) (row_mx 0 (row_mx 0 1%:M)) (col_mx 0 (col_mx 0 1%:M)) 0 in
  exists (L : fieldType) (f : {rmorphism K -> L}) z, zero_of S f z.
Proof.
have [inv _ _] := UnobservableZeros.twice_zero_delayed_not_recovered K.
move=> S; exists K, [the {rmorphism _ -> _} of idfun], 0; apply: (zero_at_zero (x := row_mx 1%:M 0)) => //.
- by rewrite row_mx_eq0 oner_eq0.
- by rewrite mul_row_block !mulmx0 !mul0mx !addr0 row_mx0.
by rewrite mul_row_col mulmx0 mul0mx addr0.
Qed.

(** ** canonical-form *)

(** r1(t+1) = r1(t) + r2(t), the sum of a fault; with as many further states as one likes. *)
Section Sums.
Variables (K : fieldType) (n : nat) (A : 'M[K]_n) (F : 'M[K]_(1, n)) (c : 'cV[K]_n).
Hypotheses (Ac : A *m c = c) (Fc : F *m c = 1%:M).
Let S : system K n 1 (1 + 1) := System A F (row_mx c 0) (row_mx 0 1%:M).

Definition sum_rows : 'M[{poly K}]_(1 + 1, 1) := col_mx ('X - 1%:P)%:M (- 1%:P)%:M.

Lemma sum_rows_popov : popov_form sum_rows.
Proof.
have top : sum_rows (lshift 1 0) 0 = 'X - 1%:P by rewrite col_mxEu mxE.
have low : sum_rows (rshift 1 0) 0 = - 1%:P by rewrite col_mxEd mxE.
exists (fun=> lshift 1 0); split=> [j|i j|j k|j k]; rewrite ?ord1 //; first by rewrite top monicXsubC.
by case: (split_ordP i) => k ->; rewrite !ord1 top ?low size_XsubC // size_opp size_poly1.
Qed.

Lemma sum_rows_equation r t : shifted sum_rows r t = lsubmx (r t.+1) - (lsubmx (r t) + rsubmx (r t)).
Proof.
have wide : (sizem sum_rows <= 2)%N.
  apply/bigmax_leqP => -[i j] _ /=; case: (split_ordP i) => k ->; rewrite !ord1 ?col_mxEu ?col_mxEd mxE.
    by rewrite size_XsubC.
  by rewrite size_opp size_poly1.
have low : coefm 0 sum_rows = col_mx (- 1%:M) (- 1%:M).
  by rewrite /coefm map_col_mx; congr col_mx; apply/matrixP => i j; rewrite !mxE !ord1 /= ?coefB ?coefN ?coefX ?coefC ?sub0r.
have high : coefm 1 sum_rows = col_mx 1%:M 0.
  rewrite /coefm map_col_mx; congr col_mx; apply/matrixP => i j; rewrite !mxE !ord1 /= ?coefB ?coefN ?coefX ?coefC ?subr0 //.
  by rewrite oppr0.
rewrite (KernelRepresentation.shifted_wide r t wide) big_ord_recr big_ord1 /= low high addn0 (addn1 t).
rewrite -{1}[r t]hsubmxK -[r t.+1]hsubmxK !mul_row_col row_mxKl !mulmxN !mulmx1 mulmx0 addr0.
by rewrite addrC opprD.
Qed.

Lemma sum_rows_of : popov_rows S sum_rows.
Proof.
split=> [|r]; first exact: sum_rows_popov.
have out x v k : output S x v k = row_mx (state S x v k *m c) (v k).
  by rewrite /output /= !mul_mx_row !mulmx0 mulmx1 add_row_mx addr0 add0r.
have next x v k : state S x v k.+1 *m c = state S x v k *m c + v k by rewrite /= mulmxDl -!mulmxA Ac Fc mulmx1.
split=> [[x [v e]] t|zero]; first by rewrite sum_rows_equation !e !out !row_mxKl row_mxKr next subrr.
pose v k := rsubmx (r k); exists (lsubmx (r 0%N) *m F), v => k; rewrite out -[LHS]hsubmxK; congr row_mx.
elim: k => [|k IH]; first by rewrite /= -mulmxA Fc mulmx1.
by rewrite next -IH; apply/eqP; rewrite -subr_eq0 -sum_rows_equation zero.
Qed.

End Sums.

Theorem canonical_form_popov_rows_instance (K : fieldType) : exists n m n' m' p (S : system K n m p) (S' : system K n' m' p) d d'
    (N : 'M_(p, d)) (N' : 'M_(p, d')),
  popov_rows S N /\ popov_rows S' N'.
Proof.
have one := @sum_rows_of K 1 1%:M 1%:M 1%:M (mul1mx _) (mul1mx _).
have two := @sum_rows_of K (1 + 1) 1%:M (row_mx 1%:M 1%:M) (col_mx 1%:M 0) (mul1mx _).
exists 1%N, 1%N, (1 + 1)%N, 1%N, (1 + 1)%N; do 2![eexists]; exists 1%N, 1%N, (sum_rows K), (sum_rows K); split; first exact: one.
by apply: two; rewrite mul_row_col mulmx0 addr0 mul1mx.
Qed.

Theorem canonical_form_popov_rows_minimal_instance (K : fieldType) : exists n m p (S : system K n m p) d (N : 'M_(p, d)), popov_rows S N.
Proof. by have [n [m [_ [_ [p [S [_ [d [_ [N [_ [rows _]]]]]]]]]]]] := canonical_form_popov_rows_instance K; exists n, m, p, S, d, N. Qed.

(** ** example-v *)

Theorem example_v_columns_instance (K : fieldType) :
  (exists (a : K) s k (Z : 'M_(k, 3 + 2)), spans_solutions (example_v a) s Z /\ (2 < s)%N) /\
  (exists (a : K) s k (Z : 'M_(k, 3 + 2)), spans_solutions (example_v a) s Z /\ s = 2%N).
Proof.
have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists (example_v (1 : K)) 3.
have [k' [Z' [_ span']]] := EchelonExists.solutions_echelon_exists (example_v (1 : K)) 2.
by split; [exists 1, 3%N, k, Z|exists 1, 2%N, k', Z'].
Qed.
