(** A minimal basis of the right kernel of a polynomial matrix M with b columns, seen by two determinants and one rank. Let k columns Y lie
    in the kernel, with independent leading coefficients; let det (J Y) and det (W Y) be coprime, J and W constant; and let M have a rank of
    at least b - k at one point. Then no more than k columns of the kernel are independent over the rational functions, so that any y in it
    is Y c with rational c; by Cramer, denominators of c divide both determinants, so that c is polynomial. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset perm zmodp
  ssralg poly polydiv matrix mxalgebra fraction zify.
From faultspace Require Import Vocabulary PolynomialKernel.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A square part with full rank; so what maps entries to a field cannot have a larger rank than what embeds them in one. *)
Lemma rank_minor (K : fieldType) a b (M : 'M[K]_(a, b)) :
  exists (f : 'I_(\rank M) -> 'I_a) (g : 'I_(\rank M) -> 'I_b), \det (mxsub f g M) != 0.
Proof.
have free : row_free (rowsub (maxrankfun M) M) by apply: maxrowsub_free.
have full : row_full (rowsub (maxrankfun M) M)^T by rewrite /row_full mxrank_tr.
exists (maxrankfun M), (fullrankfun full); have := fullrowsub_unit full.
rewrite unitmxE unitfE -det_tr; congr (\det _ != 0); by apply/matrixP => i j; rewrite !mxE.
Qed.

Lemma minor_rank (K : fieldType) a b r (M : 'M[K]_(a, b)) (f : 'I_r -> 'I_a) (g : 'I_r -> 'I_b) :
  \det (mxsub f g M) != 0 -> (r <= \rank M)%N.
Proof.
move=> d0; have u : mxsub f g M \in unitmx by rewrite unitmxE unitfE.
have <- : \rank (mxsub f g M) = r by apply: mxrank_unit.
have -> : mxsub f g M = rowsub f 1%:M *m M *m colsub g 1%:M.
  by rewrite mul_rowsub_mx mul1mx mulmx_colsub mulmx1; apply/matrixP => i j; rewrite !mxE.
by apply: leq_trans (mxrankM_maxl _ _) _; apply: mxrankM_maxr.
Qed.

Lemma rank_image (R : comRingType) (K K' : fieldType) (phi : {rmorphism R -> K}) (psi : {rmorphism R -> K'}) a b (M : 'M[R]_(a, b)) :
  injective psi -> (\rank (map_mx phi M) <= \rank (map_mx psi M))%N.
Proof.
move=> inj; have [f [g]] := rank_minor (map_mx phi M); rewrite -map_mxsub det_map_mx => d0.
apply: (@minor_rank _ _ _ _ _ f g); rewrite -map_mxsub det_map_mx -(rmorph0 psi) (inj_eq inj).
by apply: contraNneq d0 => ->; rewrite rmorph0.
Qed.

Section Seen.
Variables (K : fieldType) (a b k : nat) (M : 'M[{poly K}]_(a, b)) (Y : 'M[{poly K}]_(b, k)).
Notation over := (@over_fractions K _ _).

Lemma rank_at_point q : (\rank (map_mx (horner_eval q) M) <= \rank (over M))%N.
Proof. by apply: rank_image => x y /eqP; rewrite tofrac_eq => /eqP. Qed.

Hypothesis kernel : M *m Y = 0.

(** With a left inverse, and no room for more columns. *)
Section LeftInverse.
Variable B : 'M[{poly K}]_(k, b).
Hypotheses (inverse : B *m Y = 1%:M) (few : (b <= \rank (over M) + k)%N).

Lemma inverse_generates (y : 'cV_b) : M *m y = 0 -> exists u, y = Y *m u.
Proof.
move=> My; exists (B *m y).
have rank_Y : \rank (over Y) = k.
  have BY' : over B *m over Y = 1%:M by rewrite /over_fractions -map_mxM inverse map_mx1.
  by apply/eqP; rewrite eqn_leq rank_leq_col -[X in (X <= _)%N](mxrank1 (field_of {fraction {poly K}})) -BY' mxrankM_maxr.
have kernel_is : ((over y)^T <= (over Y)^T)%MS.
  have sub : ((over Y)^T <= kermx (over M)^T)%MS by apply/sub_kermxP; rewrite -trmx_mul -map_mxM kernel map_mx0 trmx0.
  have := mxrank_leqif_sup sub; rewrite !mxrank_tr rank_Y mxrank_ker mxrank_tr => eq.
  apply: submx_trans (_ : (kermx (over M)^T <= _)%MS).
    by apply/sub_kermxP; rewrite -trmx_mul -map_mxM My map_mx0 trmx0.
  by rewrite -eq eqn_leq eq; move: few; lia.
have /submxP[D /(congr1 trmx)] := kernel_is; rewrite trmxK trmx_mul trmxK => yD.
apply/eqP; rewrite -subr_eq0; apply/eqP/over_eq0.
rewrite map_mxB !map_mxM [map_mx _ y]yD (mulmxA (map_mx _ B)) -[map_mx _ B *m _]map_mxM inverse map_mx1 mul1mx.
exact: subrr.
Qed.

Theorem minimal_basis_by_inverse : \rank (leading Y) = k -> minimal_basis M Y.
Proof. by split=> //; apply: inverse_generates. Qed.

End LeftInverse.

(** Two determinants without a common factor give a left inverse. *)
Variables (J W : 'M[{poly K}]_(k, b)).
Hypothesis seen : coprimep (\det (J *m Y)) (\det (W *m Y)).
Variable q : K.
Hypothesis few : (b <= \rank (map_mx (horner_eval q) M) + k)%N.

Lemma bezout : exists B : 'M_(k, b), B *m Y = 1%:M.
Proof.
have /Bezout_eq1_coprimepP[[u v] /= e] := seen.
exists (u *: (\adj (J *m Y) *m J) + v *: (\adj (W *m Y) *m W)).
by rewrite mulmxDl -!scalemxAl -!mulmxA !mul_adj_mx !scale_scalar_mx -raddfD e.
Qed.

Theorem minimal_basis_seen : \rank (leading Y) = k -> minimal_basis M Y.
Proof.
have [B BY] := bezout; apply: minimal_basis_by_inverse BY _.
by apply: leq_trans few _; rewrite leq_add2r rank_at_point.
Qed.

End Seen.
