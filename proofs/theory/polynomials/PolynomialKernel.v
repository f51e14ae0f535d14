(** Kernels of polynomial matrices over the field of fractions are spanned by polynomial vectors: multiply by a common denominator. So a
    rank over the fractions can be decided with polynomial vectors alone, whose coefficients are trajectories (Inversion.v) or
    annihilators of outputs (Annihilator.v).

                        tofrac == a polynomial as a rational function
    numerator x, denominator x == of a fraction
                     coefm k M == the matrix of the coefficients k of M
                     polym s f == the polynomial matrix with the coefficients f(0), ..., f(s-1) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop generic_quotient zmodp ssralg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.
Local Open Scope quotient_scope.
Notation tofrac := (@FracField.tofrac _).

Section CommonDenominator.
Variable R : idomainType.
Notation over := (map_mx (@FracField.tofrac _)).

Definition numerator (x : {fraction R}) : R := (frac (repr x)).1.
Definition denominator (x : {fraction R}) : R := (frac (repr x)).2.

Lemma denominator_neq0 x : denominator x != 0.
Proof. exact: denom_ratioP. Qed.

Lemma denominatorK x : tofrac (denominator x) * x = tofrac (numerator x).
Proof.
rewrite /denominator /numerator -{2}[x]reprK; move: (repr x) => r.
unlock tofrac.
rewrite -[LHS]FracField.pi_mul; apply/eqmodP; rewrite /= FracField.equivfE /FracField.mulf.
by rewrite !numden_Ratio ?(oner_neq0, mulf_neq0, denom_ratioP, mul1r, mulr1) // mulrC.
Qed.

Lemma common_denominator a b (M : 'M[{fraction R}]_(a, b)) : exists2 d, d != 0 & exists N, tofrac d *: M = over N.
Proof.
pose d (ij : 'I_a * 'I_b) := denominator (M ij.1 ij.2).
exists (\prod_ij d ij); first by apply/prodf_neq0 => ij _; apply: denominator_neq0.
exists (\matrix_(i, j) ((\prod_(kl | kl != (i, j)) d kl) * numerator (M i j))); apply/matrixP => i j.
by rewrite !mxE (bigD1 (i, j)) //= [d _ * _]mulrC 2!tofracM -mulrA denominatorK.
Qed.

Lemma over_eq0 a b (M : 'M[R]_(a, b)) : over M = 0 -> M = 0.
Proof. by move=> M0; apply/matrixP => i j; move/matrixP/(_ i j)/eqP: M0; rewrite !mxE tofrac_eq0 => /eqP. Qed.

(** The rows are independent over the fractions iff no polynomial row relates them. *)
Lemma full_rank_over_fractions a b (M : 'M[R]_(a, b)) :
  \rank (over M) = a <-> (forall u : 'rV_a, u *m M = 0 -> u = 0).
Proof.
split=> [full u uM | inj].
  have/row_free_inj free : row_free (over M) by rewrite /row_free full.
  by apply: over_eq0; apply: free; rewrite -map_mxM uM map_mx0 mul0mx.
apply/eqP; rewrite -/(row_free _); apply: inj_row_free => x xM.
have [d d0 [u xu]] := common_denominator x.
have /inj u0 : u *m M = 0 by apply: over_eq0; rewrite map_mxM -xu -scalemxAl xM scaler0.
by move/eqP: xu; rewrite u0 map_mx0 scaler_eq0 tofrac_eq0 (negPf d0) => /eqP.
Qed.

(** Row spaces over the fractions are compared by the polynomial columns that they annihilate. *)
Lemma row_space_over_fractions a1 a2 b (M1 : 'M[R]_(a1, b)) (M2 : 'M[R]_(a2, b)) :
  (over M2 <= over M1)%MS <-> (forall y : 'cV_b, M1 *m y = 0 -> M2 *m y = 0).
Proof.
split=> [/submxP[D M2D] y M1y | sub].
  by apply: over_eq0; rewrite map_mxM M2D -mulmxA -map_mxM M1y map_mx0 mulmx0.
rewrite submxE; have [d d0 [N dN]] := common_denominator (cokermx (over M1)).
have MN : M1 *m N = 0 by apply: over_eq0; rewrite map_mxM -dN -scalemxAr mulmx_coker scaler0.
have {}MN : M2 *m N = 0.
  apply/matrixP => i j; have /matrixP/(_ i 0) : col j (M2 *m N) = 0; last by rewrite !mxE.
  by rewrite colE -mulmxA -colE; apply: sub; rewrite colE mulmxA MN mul0mx.
have /eqP: over M2 *m (tofrac d *: cokermx (over M1)) = 0 by rewrite dN -map_mxM MN map_mx0.
by rewrite -scalemxAr scaler_eq0 tofrac_eq0 (negPf d0).
Qed.

End CommonDenominator.

(** Coefficients of polynomial matrices. *)
Section Coefficients.
Variable K : fieldType.
Notation const := (map_mx (@polyC K)).

Definition coefm a b k (M : 'M[{poly K}]_(a, b)) : 'M[K]_(a, b) := map_mx (coefp k) M.

Lemma coefmP a b (M N : 'M[{poly K}]_(a, b)) : (forall k, coefm k M = coefm k N) <-> M = N.
Proof.
split=> [eqMN | -> //]; apply/matrixP => i j; apply/polyP => k.
by have /matrixP/(_ i j) := eqMN k; rewrite !mxE.
Qed.

Lemma coefm0 a b k : coefm k (0 : 'M_(a, b)) = 0. Proof. exact: raddf0. Qed.
Lemma coefmD a b k (M N : 'M_(a, b)) : coefm k (M + N) = coefm k M + coefm k N. Proof. exact: raddfD. Qed.
Lemma coefmB a b k (M N : 'M_(a, b)) : coefm k (M - N) = coefm k M - coefm k N. Proof. exact: raddfB. Qed.
Lemma coefmN a b k (M : 'M_(a, b)) : coefm k (- M) = - coefm k M. Proof. exact: raddfN. Qed.

Lemma coefm_sum a b k I (t : seq I) (P : pred I) (M : I -> 'M_(a, b)) :
  coefm k (\sum_(i <- t | P i) M i) = \sum_(i <- t | P i) coefm k (M i).
Proof. exact: raddf_sum. Qed.
Lemma coefmZ a b k c (M : 'M_(a, b)) : coefm k (c%:P *: M) = c *: coefm k M.
Proof. by apply/matrixP => i j; rewrite !mxE /= coefCM. Qed.

Lemma coefm_const a b k (M : 'M[K]_(a, b)) : coefm k (const M) = if k == 0%N then M else 0.
Proof. by apply/matrixP => i j; rewrite !mxE /= coefC; case: (k == 0%N); rewrite ?mxE. Qed.

Lemma coefm_mulr a b c k (M : 'M_(a, b)) (N : 'M[K]_(b, c)) : coefm k (M *m const N) = coefm k M *m N.
Proof. by apply/matrixP => i j; rewrite !mxE /= coef_sum; apply: eq_bigr => l _; rewrite !mxE coefMC. Qed.

Lemma coefm_mull a b c k (M : 'M[K]_(a, b)) (N : 'M_(b, c)) : coefm k (const M *m N) = M *m coefm k N.
Proof. by apply/matrixP => i j; rewrite !mxE /= coef_sum; apply: eq_bigr => l _; rewrite !mxE coefCM. Qed.

Lemma coefmX a b k (M : 'M_(a, b)) : coefm k ('X *: M) = if k is j.+1 then coefm j M else 0.
Proof. by apply/matrixP => i j; rewrite !mxE /= coefXM; case: k => [|k]; rewrite !mxE. Qed.

(** Beyond some degree all coefficients vanish. *)

Lemma sizem_leP a b s (M : 'M[{poly K}]_(a, b)) : reflect (forall k, (s <= k)%N -> coefm k M = 0) (sizem M <= s)%N.
Proof.
apply: (iffP idP) => [le_s k sk | zero].
  apply/matrixP => i j; rewrite !mxE /=; apply: nth_default.
  by apply: leq_trans (leq_trans le_s sk); apply: (leq_bigmax (i, j)).
apply/bigmax_leqP => -[i j] _; apply/leq_sizeP => k sk.
by have /matrixP/(_ i j) := zero k sk; rewrite !mxE.
Qed.

(** The matrix with given coefficients. *)
Definition polym a b s (f : nat -> 'M[K]_(a, b)) : 'M[{poly K}]_(a, b) := \matrix_(i, j) \poly_(k < s) f k i j.

Lemma coefm_polym a b s (f : nat -> 'M[K]_(a, b)) k : coefm k (polym s f) = if (k < s)%N then f k else 0.
Proof. by apply/matrixP => i j; rewrite !mxE /= coef_poly; case: ifP; rewrite ?mxE. Qed.

End Coefficients.
