(** The rank of a matrix of integers: no less than the number of combinations of its rows that are the identity at some columns modulo l, no
    more than its width less the number of triangular vectors that it sends to zero. And of a matrix that differs from it by nonzero factors
    of its rows and columns. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum ssrint
  rat matrix mxalgebra.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary CertificatesVocabulary Lists Independence.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Ranks.
Variable b : nat.
Let ratF := field_of rat.

Lemma rank_by_pivots (us : pivoted) : all (fun u => u.1 < b)%N us ->
  map_mx ratn (\matrix_(i < size us, j < size us) entry (nth [::] (led us) i) j) \in unitmx ->
  \rank (mat ratF (size us) b [seq u.2 | u <- us]) = size us.
Proof.
move=> /allP inside; set Q := \matrix_(i, j) _ => unit_Q; pose u0 : nat * vector := (0%N, [::]).
pose P : 'M[rat]_(b, size us) := \matrix_(j, i) (j == (nth u0 us i).1 :> nat)%:R.
apply/eqP; rewrite eqn_leq rank_leq_row /= -[X in (X <= _)%N](mxrank_unit unit_Q).
suff -> : map_mx ratn Q = mat ratF (size us) b [seq u.2 | u <- us] *m P by apply: mxrankM_maxl.
apply/matrixP => i j; have jb := inside _ (mem_nth u0 (ltn_ord j)); rewrite [RHS]mxE (bigD1 (Ordinal jb)) //= big1 => [|k kj]; last first.
  by rewrite [P _ _]mxE (_ : (_ == _) = false) ?mulr0 //; apply: contraNF kj => /eqP kj; apply/eqP/val_inj.
rewrite [P _ _]mxE /= eqxx mulr1 addr0 [LHS]mxE [Q _ _]mxE [RHS]mxE [RHS]mxE (nth_map u0) // (nth_map u0) //.
by rewrite /at_pivots {1}/entry (nth_map 0%N) ?size_map // (nth_map u0).
Qed.

Lemma rank_by_triangle us : all (fun u => u.1 < b)%N us -> triangular (led us) ->
  \rank (mat ratF (size us) b [seq u.2 | u <- us]) = size us.
Proof.
move=> inside tri; apply: rank_by_pivots => //; apply: triangular_entries tri _ _ => [|i j]; rewrite ?size_map //; exact: mxE.
Qed.

Lemma rank_by_combinations T us l : all (fun u => u.1 < b)%N us -> identity_modulo l (led (combined T us)) ->
  (size us <= \rank (mat ratF (size T) b T))%N.
Proof.
move=> inside one; have sizes : size (combined T us) = size us by apply: size_map.
have inside' : all (fun u => u.1 < b)%N (combined T us) by rewrite /combined all_map.
rewrite -sizes -(rank_by_pivots inside'); last first.
  by apply: identity_modulo_entries one _ _ => [|i j]; rewrite ?size_map //; exact: mxE.
apply: mxrankS; apply/row_subP => i; rewrite rowK; pose u0 : nat * vector := (0%N, [::]).
have i_us : (i < size us)%N by rewrite -sizes.
rewrite (nth_map u0) // (nth_map u0) //= (@vec_times _ (size T)) //; exact: submxMl.
Qed.

Lemma rank_of_table a r l T nulls combinations : check_rank a b r l T nulls combinations -> \rank (mat ratF a b T) = r.
Proof.
case/andP=> /and5P[/andP[/eqP sT /allP rows] in_n in_c /eqP sizes /eqP sc] /and3P[/allP zero tri one].
have := rank_by_combinations in_c one; rewrite sT sc => low; apply/eqP; rewrite eqn_leq low andbT.
have := rank_by_triangle in_n tri; set N := mat _ _ _ _ => rank_N.
suff /mulmx0_rank_max : mat ratF a b T *m N^T = 0 by rewrite mxrank_tr rank_N -sizes; lia.
apply/matrixP => i j; have iT : (i < size T)%N by rewrite sT.
have row_in : nth [::] T i \in T by apply: mem_nth.
transitivity ((vec ratF b (nth [::] T i) *m (vec ratF b (nth [::] [seq c.2 | c <- nulls] j))^T) 0 0).
  by rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE.
rewrite number_dot ?(eqP (rows _ row_in)) // (nth_map (0%N, [::])) //.
have /allP/(_ _ (mem_nth (0%N, [::]) (ltn_ord j)))/eqP -> := zero _ row_in.
by rewrite !mxE eqxx mulr1n [LHS](rmorph0 (number_rmorphism _)).
Qed.

Theorem rank_up_to_factors a r l T nulls combinations (M : 'M[rat]_(a, b)) (alpha : 'I_a -> rat) (beta : 'I_b -> rat) :
  check_rank a b r l T nulls combinations -> (forall (i : 'I_a) (j : 'I_b), ratn (entry (nth [::] T i) j) = alpha i * M i j * beta j) ->
  (forall i, alpha i != 0) -> (forall j, beta j != 0) -> \rank M = r.
Proof.
move=> ok e alpha0 beta0; rewrite -(rank_of_table ok).
pose A := diag_mx (\row_i alpha i); pose B := diag_mx (\row_j beta j).
have unit_A : A \in unitmx by rewrite unitmxE det_diag unitfE; apply/prodf_neq0 => i _; rewrite mxE.
have unit_B : B \in unitmx by rewrite unitmxE det_diag unitfE; apply/prodf_neq0 => i _; rewrite mxE.
have -> : mat ratF a b T = A *m M *m B.
  by apply/matrixP => i j; rewrite mul_mx_diag mul_diag_mx !mxE e.
rewrite mxrankMfree ?row_free_unit // -(eqmx_rank (_ : A *m M == M)%MS) //.
by apply/eqmxP/eqmxMfull; rewrite row_full_unit.
Qed.

End Ranks.
