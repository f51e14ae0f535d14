(** Instances for the headlines on certificates of integers (HeadlinesChecks.v): small certificates that the checks accept, of systems with
    one state. What is seen to be a minimal basis is written down over every field.

       accumulator, fed == x(k+1) = x(k) + v(k), r = (x, v); and x(k+1) = v(k), r = (x, v - x), with the same behaviour
             memoryless == x(k+1) = v(k), r = (x, v)
                delayed == x(k+1) = x(k) + v(k), r = x
             two_in_one == two faults, whose sum alone is seen
             two_faults == x(k+1) = x(k) + v_1(k), r = (x, v_1, v_2)
             both_alike == the same, one fault being v_1 and v_2
                  seven == a modulus
               relation == r_1(k+1) = r_1(k) + r_2(k), of the accumulator
              relation3 == the same with a third output
             other_step == r_1(k+1) = r_2(k)
    one_hint, two_hints == hints that there are no other relations
               words_of == words of two samples, which show that, too; `first` are the faults of the one that begins at 1
           one_and_none == the faults 1 and 0
          degree_column == the degree of a column, and the rank of its leading coefficients
           signed_delay == x(k+1) = v(k), r = (-x, v)
              its_basis == a minimal basis of its pencil
          shorter_basis == a minimal basis of [q, -1] *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg poly polydiv
  matrix mxalgebra.
From faultspace Require Import Vocabulary CertificatesVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Local Open Scope Z_scope.
Definition accumulator := Listed 1 [:: [:: 1]] [:: [:: 1]] [:: [:: 1; 0]] [:: [:: 0; 1]].
Definition fed := Listed 1 [:: [:: 0]] [:: [:: 1]] [:: [:: 1; -1]] [:: [:: 0; 1]].
Definition two_faults := Listed 1 [:: [:: 1]] [:: [:: 1]; [:: 0]] [:: [:: 1; 0; 0]] [:: [:: 0; 1; 0]; [:: 0; 0; 1]].
Definition both_alike := Listed 1 [:: [:: 1]] [:: [:: 1]] [:: [:: 1; 0; 0]] [:: [:: 0; 1; 1]].
Definition memoryless := Listed 1 [:: [:: 0]] [:: [:: 1]] [:: [:: 1; 0]] [:: [:: 0; 1]].
Definition delayed := Listed 1 [:: [:: 1]] [:: [:: 1]] [:: [:: 1]] [:: [:: 0]].
Definition two_in_one := Listed 1 [:: [:: 1]] [:: [:: 1]; [:: 1]] [:: [:: 1; 0]] [:: [:: 0; 1]; [:: 0; 1]].
Definition seven := 7.
Definition relation : seq kernel_row := [:: (0%N, [:: [:: -1; -1]; [:: 1; 0]])].
Definition relation3 : seq kernel_row := [:: (0%N, [:: [:: -1; -1; 0]; [:: 1; 0; 0]])].
Definition other_step : seq (seq Z) := [:: [:: 0; -1]; [:: 1; 0]].
Definition one_hint := Hints None [:: 0%N] [:: 1%N] 1 1 [:: 0%N] 1.
Definition two_hints := Hints None [:: 0%N; 1%N] [:: 1%N; 2%N] 1 1 [:: 0%N] 1.
Definition words_of (first : seq (seq Z)) : seq sampled_word :=
  [:: ([:: 1], first, (0, 0)%N); ([:: 0], [:: [:: 1]; last [::] first], (0, 1)%N); ([:: 0], [:: [:: 0]; [:: 1]], (1, 1)%N)].
Definition one_and_none : seq (seq Z) := [:: [:: 1]; [:: 0]].
Local Close Scope Z_scope.

(** ** Minimal bases *)

Section Bases.
Variable K : fieldType.

Lemma degree_column b (Y : 'M[{poly K}]_(b, 1)) d i : (forall j, (size (Y j 0%R) <= d.+1)%N) -> size (Y i 0%R) = d.+1 ->
  degree Y 0 = d /\ \rank (Vocabulary.leading Y) = 1%N.
Proof.
move=> low at_i; have e : degree Y 0 = d.
  rewrite /degree (_ : sizem _ = d.+1) //; apply/eqP; rewrite eqn_leq; apply/andP; split.
    by apply/bigmax_leqP => -[j k] _; rewrite !mxE /= low.
  by rewrite -at_i; have := @leq_bigmax _ (fun ij : 'I_b * 'I_1 => size (col 0 Y ij.1 ij.2)) (i, 0); rewrite /= mxE.
split=> //; apply/eqP; rewrite eqn_leq rank_leq_col lt0n mxrank_eq0; apply/eqP => /matrixP/(_ i 0); rewrite !mxE e.
by move/eqP; apply/negP; rewrite -[d]/(d.+1.-1) -at_i -/(lead_coef _) lead_coef_eq0 -size_poly_eq0 at_i.
Qed.

(** r = (-x, v) with x(k+1) = v(k) *)
Definition signed_delay : system K 1 1 (1 + 1) := System 0 1%:M (row_mx (- 1%:M) 0) (row_mx 0 1%:M).
Definition its_basis : 'M[{poly K}]_(1 + (1 + 1), 1) := col_mx 1%:M (col_mx 'X%:M 1%:M).
Definition shorter_basis : 'M[{poly K}]_(1 + 1, 1) := col_mx 1%:M 'X%:M.

Lemma its_degree : degree its_basis 0 = 1%N /\ \rank (Vocabulary.leading its_basis) = 1%N.
Proof.
apply: (@degree_column _ _ _ (rshift 1 (lshift 1 0))); last by rewrite col_mxEd col_mxEu mxE size_polyX.
move=> j; rewrite !mxE; case: (split j) => k; rewrite !mxE ?ord1 ?size_poly1 //.
by case: (split k) => i; rewrite !mxE ?ord1 ?size_polyX ?size_poly1.
Qed.

Lemma shorter_degree : degree shorter_basis 0 = 1%N /\ \rank (Vocabulary.leading shorter_basis) = 1%N.
Proof.
apply: (@degree_column _ _ _ (rshift 1 0)); last by rewrite col_mxEd mxE size_polyX.
by move=> j; rewrite !mxE; case: (split j) => k; rewrite !mxE ?ord1 ?size_polyX ?size_poly1.
Qed.

End Bases.

Theorem minimal_basis_by_states_instance (K : fieldType) : exists n m p k (S : system K n m p) (Y : 'M_(n + p, k)) q,
  pencil S *m Y = 0 /\ \rank (Vocabulary.leading Y) = k /\
  (forall w : 'I_k -> nat -> K, \sum_a \sum_(j < degree Y a) w a j *: map_mx (coefp j) (col a (usubmx Y)) = 0 ->
    forall a j, (j < degree Y a)%N -> w a j = 0) /\
  ((n + p <= \rank (map_mx (horner_eval q) (pencil S)) + k)%N \/ (p <= \rank (sysG S) + k)%N).
Proof.
have [d r] := its_degree K; exists 1%N, 1%N, (1 + 1)%N, 1%N, (signed_delay K), (its_basis K), 0; split.
  rewrite /pencil /= mul_block_col !map_row_mx !mul_row_col !map_mx0 map_mxN !map_mx1 subr0 !mul0mx !mulNmx !mul1mx mulmx1.
  by rewrite addr0 add0r subrr addNr col_mx0.
split=> //; split; last first.
  right; rewrite leq_add2r lt0n mxrank_eq0; apply/eqP => /(congr1 rsubmx)/matrixP/(_ 0 0)/eqP.
  by rewrite row_mxKr !mxE oner_eq0.
move=> w; rewrite big_ord1 d big_ord1 => /matrixP/(_ 0 0) e a j; rewrite ord1 d; case: j => // _.
by move: e; rewrite col_mxKu !mxE /coefp /= coef1 mulr1.
Qed.

Theorem minimal_basis_seen_instance (K : fieldType) : exists a b k (M : 'M[{poly K}]_(a, b)) (Y : 'M_(b, k)) (J W : 'M_(k, b)) q,
  M *m Y = 0 /\ \rank (Vocabulary.leading Y) = k /\ coprimep (\det (J *m Y)) (\det (W *m Y)) /\
  (b <= \rank (map_mx (horner_eval q) M) + k)%N.
Proof.
have [d r] := shorter_degree K.
exists 1%N, (1 + 1)%N, 1%N, (row_mx 'X%:M (- 1%:M)), (shorter_basis K), (row_mx 0 1%:M), (row_mx 1%:M 0), 0.
rewrite !mul_row_col !mulNmx !mul0mx !mul1mx mulmx1 subrr add0r addr0 det1 coprimep1; split=> //; do 2 split=> //.
rewrite leq_add2r lt0n mxrank_eq0; apply/eqP => /(congr1 rsubmx)/matrixP/(_ 0 0)/eqP.
by rewrite map_row_mx row_mxKr !mxE /horner_eval hornerN hornerE oppr_eq0 oner_eq0.
Qed.

(** ** Ranks of windows, left-invertibility, solutions *)

Theorem check_window_ranks_instance : exists (n m p : nat) L l r etas ranks rows lower,
  check_window_ranks n m p r etas ranks l L rows lower.
Proof.
by exists 1%N, 1%N, 2%N, accumulator, seven, 1%N, [:: 1%N], [:: 2; 3; 4]%N, relation, (inl (words_of [:: [:: Z0]; [:: Z0]])); vm_compute.
Qed.

Theorem check_window_ranks_modulo_instance : exists (n m p : nat) L l r etas ranks rows h,
  check_window_ranks_modulo n m p r etas ranks l L rows h.
Proof. by exists 1%N, 1%N, 2%N, accumulator, seven, 1%N, [:: 1%N], [:: 2; 3; 4]%N, relation, one_hint; vm_compute. Qed.

Theorem check_left_invertible_instance : exists (n m p : nat) L l ws, check_left_invertible n m p l L ws.
Proof. by exists 1%N, 1%N, 2%N, accumulator, seven, (words_of [:: [:: Z0]; [:: Z0]]); vm_compute. Qed.

Theorem check_left_invertible_at_instance : exists (n m p : nat) L l q rows columns d,
  check_left_invertible_at n m p l L q rows columns d.
Proof. by exists 1%N, 1%N, 2%N, accumulator, seven, None, [:: 0%N], [:: 1%N], (Zpos xH); vm_compute. Qed.

Theorem check_solutions_instance : exists (n m p : nat) L s l rows lower d basis pivots combinations,
  check_solutions n m p s l L rows lower d basis pivots combinations.
Proof.
exists 1%N, 1%N, 2%N, accumulator, 2%N, seven, relation, (inr one_hint), (Zpos xH), [:: [:: Zpos xH; Z0; Zpos xH]], [:: 0%N].
by exists [:: (0%N, [:: Zpos xH; Zpos xH]); (1%N, [:: Z0; Zpos xH])]; vm_compute.
Qed.

Theorem check_limit_instance : exists (n m p : nat) L beyond l rows lower d basis pivots combinations,
  check_limit n m p beyond l L rows lower d basis pivots combinations /\ exists s, (beyond < s)%N.
Proof.
exists 1%N, 1%N, 2%N, accumulator, 1%N, seven, relation, (inr one_hint), (Zpos xH), [:: [:: Zpos xH; Z0; Zpos xH]], [:: 0%N].
by exists [:: (0%N, [:: Zpos xH; Zpos xH]); (1%N, [:: Z0; Zpos xH])]; split; [vm_compute|exists 2%N].
Qed.

(** ** Two behaviours *)

Theorem check_inclusion_instance : exists (n m n' m' p : nat) L L' l rows lower,
  check_inclusion n m n' m' p l L L' rows lower /\ let S := meant n m p L in (exists s r, word S s r) /\ exists r, behavior S r.
Proof.
exists 1%N, 1%N, 1%N, 2%N, 3%N, both_alike, two_faults, seven, relation3, (inr two_hints); split; first by vm_compute.
by split; [exists 2%N|]; exists (output (meant 1 1 3 both_alike) (const_mx 1) (fun=> const_mx 1)), (const_mx 1), (fun=> const_mx 1).
Qed.

Theorem check_equality_instance : exists (n m n' m' p : nat) L L' l rows lower lower',
  check_equality n m n' m' p l L L' rows lower lower'.
Proof.
exists 1%N, 1%N, 1%N, 1%N, 2%N, accumulator, fed, seven, relation, (inl (words_of [:: [:: Z0]; [:: Z0]])), (inr one_hint).
by vm_compute.
Qed.

Theorem check_window_equality_instance : exists (n m n' m' p : nat) L L' s l rows ws ws',
  check_window_equality n m n' m' p s l L L' rows ws ws'.
Proof.
exists 1%N, 1%N, 1%N, 1%N, 2%N, accumulator, fed, 2%N, seven, relation, (words_of [:: [:: Z0]; [:: Z0]]).
by exists (words_of [:: [:: Zpos xH]; [:: Zpos xH]]); vm_compute.
Qed.

Theorem check_difference_instance : exists (n m n' m' p : nat) L L' s x vs c, check_difference n m n' m' p s L L' x vs c.
Proof. by exists 1%N, 1%N, 1%N, 1%N, 2%N, accumulator, memoryless, 2%N, [:: Zpos xH], one_and_none, other_step; vm_compute. Qed.

(** ** Inversion *)

Theorem check_not_left_invertible_instance : exists (n m p : nat) L xs vs, check_not_left_invertible n m p L xs vs.
Proof. by exists 1%N, 2%N, 2%N, two_in_one, [:: [:: Z0]; [:: Z0]], [:: [:: Zneg xH; Zpos xH]]; vm_compute. Qed.

Theorem check_delay_instance : exists (n m p : nat) L (known : bool) l rows x vs,
  check_delay n m p known l L rows x vs /\ exists j, (j < l)%N.
Proof.
exists 1%N, 1%N, 1%N, delayed, true, 1%N, [:: (Zpos xH, [:: [:: Zneg xH]; [:: Zpos xH]])], [:: Z0], [:: [:: Zpos xH]].
by split; [vm_compute|exists 0%N].
Qed.

Theorem check_no_delay_instance : exists (n m p : nat) L (known : bool) x vs,
  check_no_delay n m p known L x vs /\ exists j, (j <= n)%N.
Proof.
exists 1%N, 2%N, 2%N, two_in_one, true, [:: Z0], [:: [:: Zneg xH; Zpos xH]; [::]].
by split; [vm_compute|exists 1%N].
Qed.

(** ** Ranks of named matrices *)

Theorem check_observability_instance : exists (n m p : nat) L l r nulls combinations, check_observability n m p r l L nulls combinations.
Proof. by exists 1%N, 1%N, 2%N, accumulator, seven, 1%N, [:: (1%N, [:: Z0; Zpos xH])], [:: (0%N, [:: Zpos xH])]; vm_compute. Qed.

Theorem check_reachability_instance : exists (n m p : nat) L l r nulls combinations, check_reachability n m p r l L nulls combinations.
Proof. by exists 1%N, 1%N, 2%N, accumulator, seven, 1%N, [::], [:: (0%N, [:: Zpos xH])]; vm_compute. Qed.

(** x(0) = 1/2, v = 1/2, 0 *)
Theorem check_hankel_instance : exists (n m p : nat) L l r nulls combinations N s d x vs,
  check_hankel n m p N s r l L d x vs nulls combinations.
Proof.
exists 1%N, 1%N, 2%N, accumulator, seven, 2%N, [::], [:: (0%N, [:: 0; 4]%Z); (1%N, [:: 1; 3]%Z)], 2%N, 1%N, (Zpos (xO xH)), [:: Zpos xH].
by exists one_and_none; vm_compute.
Qed.

Theorem check_excitation_instance : exists (n m p : nat) L l r nulls combinations N s d x vs,
  check_excitation n m p N s r l L d x vs nulls combinations.
Proof.
exists 1%N, 1%N, 2%N, accumulator, seven, 2%N, [::], [:: (0%N, [:: 0; 4]%Z); (1%N, [:: 1; 3]%Z)], 2%N, 1%N, (Zpos (xO xH)), [:: Zpos xH].
by exists one_and_none; vm_compute.
Qed.
