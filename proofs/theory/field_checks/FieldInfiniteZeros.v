(** The infinite zeros of a system told by lists of numbers, by multipliers that make its pencil at infinity diagonal: the powers of X in
    the minors of every order tell the orders one by one. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary NormalRank DiagonalMinors RankAtInfinity.
From faultspace Require Import NumbersVocabulary NumberLists FieldZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Meaning.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation pol := (polynomial_of value).

Lemma pol_from u k : (k <= valuation u)%N -> pol u = 'X^k * pol (drop k u).
Proof.
move=> low; apply/polyP => i; rewrite coefXnM !(coef_pol_of meaning); case: ltnP => ik; last by rewrite /at_place nth_drop subnKC.
have := before_find (zero R) (leq_trans ik low); rewrite /at_place => /negbFE; exact: value_vanishes.
Qed.

Variables (n m p : nat) (L : listing R).
Let S := system_of value n m p L.

Lemma infinity_rows_meaning : poly_matrix value (n + m) (n + p) (infinity_rows n m p L) = pencil_at_infinity S.
Proof.
apply/matrixP => i j; rewrite mxE /pencil_at_infinity /infinity_rows nth_cat size_map size_iota.
case: (split_ordP i) => s ->; rewrite ?(block_mxEul, block_mxEur) /=.
  rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n nth_cat size_mkseq.
  case: (split_ordP j) => t ->; rewrite ?block_mxEul ?block_mxEur /=.
    rewrite nth_mkseq // !(pol_cons meaning) (pol_nil meaning) mulr0 addr0 !mxE (value_minus meaning) (value_zero meaning).
    by rewrite sub0r polyCN mulrN -val_eqE /= eq_sym; case: (_ == _); rewrite ?(value_one meaning) ?(value_zero meaning) ?polyC0.
  by rewrite addKn nth_mkseq // (pol_cons meaning) (pol_nil meaning) mulr0 addr0 !mxE.
rewrite addKn (nth_map 0%N) ?size_iota // nth_iota // add0n nth_cat size_mkseq.
case: (split_ordP j) => t ->; rewrite ?block_mxEdl ?block_mxEdr /=.
  rewrite nth_mkseq // !(pol_cons meaning) (pol_nil meaning) mulr0 addr0 !mxE (value_minus meaning) (value_zero meaning) sub0r polyCN.
  by rewrite polyC0 add0r mulrN.
by rewrite addKn nth_mkseq // (pol_cons meaning) (pol_nil meaning) mulr0 addr0 !mxE.
Qed.

Theorem has_infinite_zeros_sound orders d U U' V V' : has_infinite_zeros n m p orders L d U U' V V' ->
  \rank (transfer S) = size orders /\
  forall j e, (j <= size orders)%N -> divides_minors_of_order (n + j) (pencil_at_infinity S) 'X^e <-> (e <= sumn (take j orders))%N.
Proof.
rewrite /has_infinite_zeros; set places := nonzero_places _ _ _ => /and3P[diagonal /allP invertibles /eqP sorted_is].
have sP : size (infinity_rows n m p L) = (n + m)%N by rewrite size_cat !size_map !size_iota.
have [UU VV] := is_diagonalized_sound meaning sP diagonal; rewrite infinity_rows_meaning => diag.
have unique : uniq places by rewrite filter_uniq ?iota_uniq.
have inside i : i \in places -> (i < minn (n + m) (n + p))%N by rewrite mem_filter mem_iota => /andP[].
have zero i : (i < minn (n + m) (n + p))%N -> i \notin places -> pol (nth [::] d i) = 0.
  by rewrite mem_filter mem_iota /= add0n => ->; rewrite andbT negbK => /(pol_blank meaning).
have split i : i \in places -> pol (nth [::] d i) = 'X^(valuation (nth [::] d i)) * pol (drop (valuation (nth [::] d i)) (nth [::] d i)).
  by move=> _; apply: pol_from.
have at0 i : i \in places -> (pol (drop (valuation (nth [::] d i)) (nth [::] d i))).[0] != 0.
  by move/invertibles/(value_invertible meaning); rewrite horner_coef0 (coef_pol_of meaning) /at_place nth_drop addn0.
have sizes : size places = (n + size orders)%N.
  by have := congr1 size sorted_is; rewrite size_sort size_map size_cat size_nseq.
split.
  apply: (@addnI n); rewrite -sizes -(rank_diagonal UU VV diag unique inside zero split at0) rank_pencil_at_infinity.
  by rewrite (gap_normal_rank _ (leqnn n)).
move=> j e few; rewrite (powers_in_minors UU VV diag unique inside zero split at0) ?sizes ?leq_add2l // sorted_is.
rewrite take_cat size_nseq ltnNge leq_addr /= addKn sumn_cat sumn_nseq mul0n.
by [].
Qed.

End Meaning.
