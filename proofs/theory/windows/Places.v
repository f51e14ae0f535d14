(** The samples of one time, put in their place among s: so that a row vector of samples is a sum over times. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp ssralg matrix.
From faultspace Require Import Vocabulary Basics Windows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Places.
Variable K : fieldType.
Notation place := (place K).

Lemma mul_place p s (k : 'I_s) (w : 'rV[K]_p) : w *m place p k = samples s (fun j => if j == k then w else 0).
Proof.
have lin : linear (fun y : 'rV[K]_p => samples s (fun j => if j == k then y else 0)).
  move=> a y z; rewrite -samples_scale -samples_add; apply: samples_ext => j _.
  by case: eqP => // _; rewrite scaler0 addr0.
rewrite -[RHS](mul_lin1 w lin); congr (w *m _).
by apply/row_matrixP=> i; rewrite rowK [RHS]rowE (mul_lin1 _ lin) [row i _]rowE mulmx1.
Qed.

Lemma samples_places p s (r : nat -> 'rV[K]_p) : samples s r = \sum_(k < s) r k *m place p k.
Proof.
under eq_bigr => k _ do rewrite mul_place.
apply/rowP=> l; case/mxvec_indexP: l => j c; rewrite summxE mxvecE mxE (bigD1 j) //= mxvecE mxE eqxx big1 ?addr0 // => k.
by rewrite eq_sym mxvecE mxE -val_eqE => /negbTE->; rewrite mxE.
Qed.

Lemma placeE p s (k : 'I_s) i a : place p k i a = (a == mxvec_index k i)%:R.
Proof.
have e : row i (place p k) = delta_mx 0 (mxvec_index k i).
  rewrite rowK -mxvec_delta; congr mxvec; apply/row_matrixP=> j; rewrite rowK; apply/rowP=> c.
  by case: ifP => e; rewrite !mxE -[j == k]val_eqE /= e //= eq_sym.
by have := congr1 (fun M : 'rV_ _ => M 0 a) e; rewrite /= !mxE /= => ->.
Qed.

Lemma mul_place_transposed p s (k : 'I_s) (w : 'rV[K]_(s * p)) : w *m (place p k)^T = row k (vec_mx w).
Proof.
apply/rowP=> c; rewrite !mxE (bigD1 (mxvec_index k c)) //= big1 => [|a /negbTE ne]; last by rewrite mxE placeE ne mulr0.
by rewrite mxE placeE eqxx mulr1 addr0.
Qed.

Lemma sum_places p s : \sum_k (place p k)^T *m place p k = 1%:M :> 'M_(s * p).
Proof.
apply/row_matrixP=> i; rewrite !rowE; move: (delta_mx 0 i) => w; rewrite mulmx1 mulmx_sumr.
under eq_bigr => k _ do rewrite mulmxA mul_place_transposed mul_place.
rewrite -[RHS]vec_mxK; apply/rowP=> l; case/mxvec_indexP: l => j c; rewrite summxE (bigD1 j) //= big1 => [|k].
  by rewrite !mxvecE !mxE eqxx !mxE addr0.
by rewrite -val_eqE => /negbTE ne; rewrite mxvecE mxE eq_sym ne mxE.
Qed.

Lemma place_orthonormal p s (j k : 'I_s) : place p j *m (place p k)^T = if (j == k :> nat) then 1%:M else 0.
Proof.
apply/row_matrixP=> i; rewrite row_mul mul_place_transposed rowK mxvecK rowK eq_sym.
by case: eqP => // _; apply/rowP=> c; rewrite !mxE.
Qed.

End Places.
