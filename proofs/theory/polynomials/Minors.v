(** Greatest common divisors of the maximal minors of a polynomial matrix P: the product of its invariant polynomials, whose roots, with
    their multiplicities, are the zeros of P. If the constant rows E satisfy E P = D Z for constant independent rows Z, then det D divides
    all maximal minors; and it can be reached where the rows that complete E can be inverted. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop perm zmodp ssralg poly polydiv matrix
  mxalgebra.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Any square matrix made of the columns of P: its determinant is a combination of maximal minors. *)
Lemma det_mulmx_minors (R : comRingType) a b (P : 'M[R]_(a, b)) (C : 'M[R]_(b, a)) :
  \det (P *m C) = \sum_(f : {ffun 'I_a -> 'I_b}) (\prod_i C (f i) i) * \det (colsub f P).
Proof.
rewrite -[LHS]det_tr [LHS]/determinant.
transitivity (\sum_(s : 'S_a) \sum_(f : {ffun 'I_a -> 'I_b}) (-1) ^+ s * \prod_i (P (s i) (f i) * C (f i) i)).
  apply: eq_bigr => s _; rewrite -mulr_sumr; congr (_ * _).
  by rewrite -(bigA_distr_bigA (fun i k => P (s i) k * C k i)); apply: eq_bigr => i _; rewrite !mxE.
rewrite exchange_big; apply: eq_bigr => f _; rewrite -[\det (colsub _ _)]det_tr /determinant mulr_sumr; apply: eq_bigr => s _.
rewrite big_split [RHS]mulrCA; congr (_ * _); rewrite mulrC; congr (_ * _).
by apply: eq_bigr => i _; rewrite !mxE.
Qed.

Lemma divides_minors_det (K : fieldType) a b (P : 'M[{poly K}]_(a, b)) (g : {poly K}) :
  divides_minors P g <-> forall C, g %| \det (P *m C).
Proof.
split=> [h C | h f].
  by rewrite det_mulmx_minors; apply: (big_ind (fun x => g %| x)) => [|x y|i _]; [exact: dvdp0 | exact: dvdp_add | exact: dvdp_mull].
have := h (colsub f 1%:M); rewrite (_ : P *m _ = colsub f P) //.
by apply/matrixP => i j; rewrite -[in RHS](mulmx1 P) !mxE; apply: eq_bigr => k _; rewrite !mxE.
Qed.

(** Independent rows are completed to an invertible matrix. *)
Lemma complete_rows (K : fieldType) d e (E : 'M[K]_(d, d + e)) : row_free E -> exists E', col_mx E E' \in unitmx.
Proof.
move=> free; exists (dsubmx (row_ebase E)).
suff -> : col_mx E (dsubmx (row_ebase E)) = block_mx (col_ebase E) 0 0 1%:M *m row_ebase E.
  by rewrite unitmx_mul row_ebase_unit andbT unitmxE det_lblock det1 mulr1 -unitmxE col_ebase_unit.
rewrite -[X in _ = _ *m X]vsubmxK mul_block_col mul0mx mul0mx mul1mx addr0 add0r; congr col_mx.
rewrite -[LHS]mulmx_ebase (eqP free) pid_mx_row -[X in _ *m X = _]vsubmxK -mulmxA mul_row_col mul0mx addr0 mul1mx.
by [].
Qed.

Section Divisor.
Variables (K : fieldType) (d e b : nat) (P : 'M[{poly K}]_(d + e, b)).
Variables (E : 'M[K]_(d, d + e)) (E' : 'M[K]_(e, d + e)) (Z : 'M[K]_(d, b)) (D : 'M[{poly K}]_d).
Notation const := (map_mx (@polyC K)).
Hypotheses (unitE : col_mx E E' \in unitmx) (rows : const E *m P = D *m const Z).

Let scaled (x : {poly K}) : \det (const (col_mx E E')) * x = \det (col_mx E E') *: x.
Proof. by rewrite det_map_mx mul_polyC. Qed.

Let det_neq0 : \det (col_mx E E') != 0.
Proof. by rewrite -unitfE -unitmxE. Qed.

Lemma det_divides_minors : divides_minors P (\det D).
Proof.
apply/divides_minors_det => C; rewrite -(dvdpZr _ _ det_neq0) -scaled -det_mulmx map_col_mx mul_col_mx.
rewrite mulmxA rows -mulmxA.
have -> : col_mx (D *m (const Z *m C)) (const E' *m (P *m C)) = block_mx D 0 0 1%:M *m col_mx (const Z *m C) (const E' *m (P *m C)).
  by rewrite mul_block_col !mul0mx mul1mx addr0 add0r.
by rewrite det_mulmx det_lblock det1 mulr1 dvdp_mulr.
Qed.

Lemma minor_value (Z' : 'M[K]_(b, d)) (X : 'M[{poly K}]_(b, e)) : Z *m Z' = 1%:M -> const E *m P *m X = 0 ->
  \det (col_mx E E') *: \det (P *m row_mx (const Z') X) = \det D * \det (const E' *m P *m X).
Proof.
move=> ZZ' EPX; rewrite -scaled -det_mulmx map_col_mx mulmxA mul_col_mx mul_col_row EPX.
rewrite rows -[D *m _ *m _]mulmxA -map_mxM ZZ' map_mx1 mulmx1.
exact: det_lblock.
Qed.

End Divisor.

(** The divisor is reached, up to a constant, when every constant column that E annihilates is a combination of columns of P. *)
Section Reached.
Variables (K : fieldType) (a b d : nat) (P : 'M[{poly K}]_(a, b)) (E : 'M[K]_(d, a)) (Z : 'M[K]_(d, b)) (D : 'M[{poly K}]_d).
Notation const := (map_mx (@polyC K)).
Hypotheses (freeE : row_free E) (freeZ : row_free Z) (rows : const E *m P = D *m const Z).

Theorem det_attained : (forall y : 'cV[K]_a, E *m y = 0 -> exists x, P *m x = const y) ->
  divides_minors P (\det D) /\ exists2 c, c != 0 & exists C, \det (P *m C) = c *: \det D.
Proof.
have := subnKC (_ : (d <= a)%N); rewrite -{1}(eqP freeE) rank_leq_col => /(_ isT); move: (a - d)%N => e ade.
case: a / ade P E freeE rows => P1 E1 free1 rows1 solve; have [E' unitE] := complete_rows free1.
split; first exact: det_divides_minors unitE rows1.
pose inv := invmx (col_mx E1 E'); have := mulmxV unitE; rewrite -/inv -[inv]hsubmxK mul_col_row scalar_mx_block.
move/eq_block_mx => [_ e12 _ e22]; have /fin_all_exists[x hx] : forall j, exists x, P1 *m x = const (col j (rsubmx inv)).
  by move=> j; apply: solve; rewrite colE mulmxA e12 mul0mx.
pose X := \matrix_(i, j) x j i 0; have PX : P1 *m X = const (rsubmx inv).
  have colX j : col j X = x j by apply/matrixP => i k; rewrite ord1 !mxE.
  by apply/trmx_inj/row_matrixP => j; rewrite -!tr_col; congr trmx; rewrite colE -mulmxA -colE colX hx map_col.
have /row_freeP[Z' ZZ'] := freeZ; exists (\det (col_mx E1 E'))^-1.
  by rewrite invr_eq0 -unitfE -unitmxE.
exists (row_mx (const Z') X); have := minor_value E' rows1 ZZ' (_ : _ *m X = 0).
rewrite -!mulmxA PX -!map_mxM e12 map_mx0 => /(_ erefl); rewrite e22 map_mx1 det1 mulr1 => <-.
by rewrite scalerA mulVf ?scale1r // -unitfE -unitmxE.
Qed.

(** Or up to a factor without root in 0, when it is so in 0. *)
Theorem det_attained_in_0 : (forall y : 'rV[K]_a, (y *m map_mx (coefp 0) P <= Z)%MS -> (y <= E)%MS) ->
  divides_minors P (\det D) /\ exists2 g : {poly K}, ~~ root g 0 & exists C, \det (P *m C) = g * \det D.
Proof.
have := subnKC (_ : (d <= a)%N); rewrite -{1}(eqP freeE) rank_leq_col => /(_ isT); move: (a - d)%N => e ade.
case: a / ade P E freeE rows => P1 E1 free1 rows1 inE; have [E' unitE] := complete_rows free1.
split; first exact: det_divides_minors unitE rows1.
set P0 := map_mx (coefp 0) P1 in inE; have /row_freeP[Y ZPY] : row_free (col_mx Z (E' *m P0)).
  apply: inj_row_free => u; rewrite -[u]hsubmxK mul_row_col => u0.
  have /inE/submxP[al e1] : (rsubmx u *m E' *m P0 <= Z)%MS.
    by rewrite -mulmxA -(addKr (lsubmx u *m Z) (_ *m _)) u0 addr0 -mulNmx submxMl.
  have : row_mx (- al) (rsubmx u) *m col_mx E1 E' = 0 by rewrite mul_row_col e1 mulNmx addNr.
  move/(congr1 (mulmx^~ (invmx (col_mx E1 E')))); rewrite mulmxK // mul0mx -[0]row_mx0 => /eq_row_mx[_ u2].
  by move: u0; rewrite u2 mul0mx addr0 => /eqP; rewrite (mulmx_free_eq0 _ freeZ) => /eqP ->.
move: ZPY; rewrite -[Y]hsubmxK mul_col_row scalar_mx_block => /eq_block_mx[ZY1 ZX _ PX].
pose X := const (rsubmx Y); have EPX : const E1 *m P1 *m X = 0 by rewrite rows1 -mulmxA -map_mxM ZX map_mx0 mulmx0.
pose c := \det (col_mx E1 E'); have c0 : c != 0 by rewrite -unitfE -unitmxE.
exists (c^-1 *: \det (const E' *m P1 *m X)).
  rewrite rootZ ?invr_eq0 // /root -/(horner_eval 0 _) -det_map_mx.
  suff -> : map_mx (horner_eval 0) (const E' *m P1 *m X) = 1%:M by rewrite det1 oner_neq0.
  have const0 i j (N : 'M[K]_(i, j)) : map_mx (horner_eval 0) (const N) = N.
    by apply/matrixP => k l; rewrite !mxE /horner_eval hornerC.
  rewrite !map_mxM !const0 -PX; congr (_ *m _ *m _); apply/matrixP => k l; rewrite !mxE /horner_eval.
  exact: horner_coef0.
exists (row_mx (const (lsubmx Y)) X); have := minor_value E' rows1 ZY1 EPX; rewrite -/c => e1.
by rewrite -scalerAl mulrC -e1 scalerA mulVf ?scale1r.
Qed.

End Reached.

(** With the divisor reached, it is the greatest, and its roots are where the rank of P drops, in any extension of K. *)
Section Roots.
Variables (K : fieldType) (a b : nat) (P : 'M[{poly K}]_(a, b)) (g : {poly K}).
Hypotheses (divides : divides_minors P g) (attained : exists2 c, c != 0 & exists C, \det (P *m C) = c *: g).

Lemma attained_gcd : gcd_of_minors P g.
Proof.
split=> // h /divides_minors_det h_divides; case: attained => c c0 [C e].
by rewrite -(dvdpZr _ _ c0) -e.
Qed.

Lemma attained_rank (L : fieldType) (f : {rmorphism K -> L}) (z : L) :
  (\rank (map_mx (horner_eval z \o map_poly f) P) < a)%N = root (map_poly f g) z.
Proof.
set ev := (horner_eval z \o _); have ev_g (C : 'M_a) : ev (\det C) = \det (map_mx ev C) by rewrite det_map_mx.
apply/idP/idP => [drop | /eqP rt].
  case: attained => c c0 [C e]; have : ev (\det (P *m C)) = 0.
    apply/eqP; rewrite ev_g; apply: contraTT drop => nz; rewrite -leqNgt.
    apply: leq_trans (mxrankM_maxl _ (map_mx ev C)); rewrite -map_mxM mxrank_unit //.
    by rewrite unitmxE unitfE.
  by rewrite e /ev /= map_polyZ /horner_eval hornerZ => /eqP; rewrite mulf_eq0 fmorph_eq0 (negPf c0).
rewrite ltn_neqAle rank_leq_row andbT; apply/negP => /row_freeP[C PC].
have := det1 L a; rewrite -PC det_mulmx_minors big1 => [/esym/eqP|i _]; first by rewrite oner_eq0.
suff -> : \det (colsub i (map_mx ev P)) = 0 by rewrite mulr0.
have -> : colsub i (map_mx ev P) = map_mx ev (colsub i P) by apply/matrixP => k l; rewrite !mxE.
by rewrite -ev_g; have /dvdpP[q ->] := divides i; rewrite /ev /= rmorphM /horner_eval hornerM rt mulr0.
Qed.

End Roots.
