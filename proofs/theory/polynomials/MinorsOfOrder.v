(** Greatest common divisors of the minors of order N, for polynomial matrices P that need not have full row rank. If constant rows E
    satisfy E P = [D' 0; H D] Z for constant independent rows Z, where D' has a polynomial left inverse, and all constant columns that E
    annihilates are combinations of columns of P, then det D is the greatest common divisor of the minors of the highest order. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly polydiv matrix mxalgebra.
From faultspace Require Import Vocabulary Minors.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma divides_minors_of_order_det (K : fieldType) N a b (P : 'M[{poly K}]_(a, b)) (g : {poly K}) :
  divides_minors_of_order N P g <-> forall (B : 'M_(N, a)) (C : 'M_(b, N)), g %| \det (B *m P *m C).
Proof.
split=> [divides B C | h r f].
  move: C; apply/divides_minors_det => f.
  have -> : colsub f (B *m P) = B *m colsub f P by apply/matrixP => i j; rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE.
  rewrite -det_tr trmx_mul; move: (B^T); apply/divides_minors_det => h.
  have -> : colsub h (colsub f P)^T = (mxsub h f P)^T by apply/matrixP => i j; rewrite !mxE.
  by rewrite det_tr.
have := h (rowsub r 1%:M) (colsub f 1%:M); rewrite (_ : _ *m _ = mxsub r f P) //.
have -> : rowsub r 1%:M *m P = rowsub r P.
  by apply/matrixP => i j; rewrite -[in RHS](mul1mx P) !mxE; apply: eq_bigr => k _; rewrite !mxE.
by apply/matrixP => i j; rewrite -[in RHS](mulmx1 P) !mxE; apply: eq_bigr => k _; rewrite !mxE.
Qed.

Section Reached.
Variables (K : fieldType) (a b k r d : nat) (P : 'M[{poly K}]_(a, b)) (E : 'M[K]_(k + d, a)) (Z : 'M[K]_(r + d, b)).
Variables (D' : 'M[{poly K}]_(k, r)) (J : 'M[{poly K}]_(r, k)) (H : 'M[{poly K}]_(d, r)) (D : 'M[{poly K}]_d).
Notation const := (map_mx (@polyC K)).
Hypotheses (freeE : row_free E) (freeZ : row_free Z) (rows : const E *m P = block_mx D' 0 H D *m const Z).

Lemma det_divides_highest_minors : divides_minors_of_order (r + d + (a - (k + d))) P (\det D).
Proof.
have := subnKC (_ : (k + d <= a)%N); rewrite -{1}(eqP freeE) rank_leq_col => /(_ isT); move: (a - (k + d))%N => e ade.
case: a / ade P E freeE rows => P1 E1 free1 rows1; have [E' unitE] := complete_rows free1.
set T := col_mx E1 E' in unitE.
have TP : const T *m P1 = block_mx (block_mx D' 0 H 1%:M) 0 0 1%:M *m
    (block_mx (block_mx 1%:M 0 0 D) 0 0 1%:M *m col_mx (const Z) (const E' *m P1)).
  rewrite !mul_block_col !mul0mx !addr0 !add0r !mul1mx map_col_mx mul_col_mx rows1 mulmxA; congr (col_mx (_ *m _) _).
  by rewrite mulmx_block !mulmx0 !mul0mx !mulmx1 !mul1mx !addr0 !add0r.
apply/divides_minors_of_order_det => B C.
have -> : B *m P1 = B *m const (invmx T) *m (const T *m P1) by rewrite mulmxA -(mulmxA B) -map_mxM mulVmx // map_mx1 mulmx1.
rewrite TP mulmxA -(mulmxA _ _ C) -(mulmxA _ _ C) !det_mulmx !det_lblock !det1 mulr1 mul1r.
by apply: dvdp_mull; apply: dvdp_mulr.
Qed.

Hypotheses (left : J *m D' = 1%:M) (solve : forall y : 'cV[K]_a, E *m y = 0 -> exists x, P *m x = const y).

Theorem gcd_of_highest_minors : gcd_of_minors_of_order (r + d + (a - (k + d))) P (\det D).
Proof.
split; first exact: det_divides_highest_minors.
have := subnKC (_ : (k + d <= a)%N); rewrite -{1}(eqP freeE) rank_leq_col => /(_ isT); move: (a - (k + d))%N => e ade.
case: a / ade P E freeE rows solve => P1 E1 free1 rows1 solve1; have [E' unitE] := complete_rows free1.
set T := col_mx E1 E' in unitE.
move=> h /divides_minors_of_order_det divides.
have := mulmxV unitE; rewrite -[invmx T]hsubmxK mul_col_row scalar_mx_block.
move/eq_block_mx => [_ e12 _ e22]; have /fin_all_exists[x hx] : forall j, exists x, P1 *m x = const (col j (rsubmx (invmx T))).
  by move=> j; apply: solve1; rewrite colE mulmxA e12 mul0mx.
pose X := \matrix_(i, j) x j i 0; have PX : P1 *m X = const (rsubmx (invmx T)).
  have colX j : col j X = x j by apply/matrixP => i l; rewrite ord1 !mxE.
  by apply/trmx_inj/row_matrixP => j; rewrite -!tr_col; congr trmx; rewrite colE -mulmxA -colE colX hx map_col.
have /row_freeP[Z' ZZ'] := freeZ; pose J1 := block_mx J 0 0 (1%:M : 'M[{poly K}]_d).
have JE : J1 *m (const E1 *m P1) = block_mx 1%:M 0 H D *m const Z.
  by rewrite rows1 mulmxA mulmx_block !mul0mx !mulmx0 !mul1mx !addr0 !add0r left.
have := divides (block_mx J1 0 0 1%:M *m const T) (row_mx (const Z') X).
have -> : block_mx J1 0 0 1%:M *m const T *m P1 *m row_mx (const Z') X =
    block_mx (block_mx 1%:M 0 H D) 0 (const E' *m P1 *m const Z') 1%:M.
  have TP1 : const T *m P1 = col_mx (const E1 *m P1) (const E' *m P1) by rewrite map_col_mx mul_col_mx.
  rewrite -[_ *m const T *m P1]mulmxA TP1 mul_block_col !mul0mx addr0 add0r mul1mx JE mul_col_row.
  congr block_mx.
  - by rewrite -mulmxA -map_mxM ZZ' map_mx1 mulmx1.
  - by rewrite -JE -!mulmxA PX -map_mxM e12 map_mx0 mulmx0.
  - by rewrite -mulmxA PX -map_mxM e22 map_mx1.
by rewrite !det_lblock !det1 mulr1 mul1r.
Qed.

End Reached.

(** The same in 0 only. *)
Section ReachedInZero.
Variables (K : fieldType) (a b k r d : nat) (P : 'M[{poly K}]_(a, b)) (E : 'M[K]_(k + d, a)) (Z : 'M[K]_(r + d, b)).
Variables (D' : 'M[{poly K}]_(k, r)) (J : 'M[K]_(r, k)) (H : 'M[{poly K}]_(d, r)) (D : 'M[{poly K}]_d).
Notation const := (map_mx (@polyC K)).
Notation at0 := (map_mx (horner_eval 0)).
Hypotheses (freeE : row_free E) (freeZ : row_free Z) (rows : const E *m P = block_mx D' 0 H D *m const Z) (left : J *m at0 D' = 1%:M).
Hypothesis in_0 : forall y : 'rV[K]_a, (y *m at0 P <= Z)%MS -> (y <= E)%MS.

Lemma at0_const i j (M : 'M[K]_(i, j)) : at0 (const M) = M.
Proof. by apply/matrixP => u v; rewrite !mxE /horner_eval hornerC. Qed.

Lemma highest_minor_in_0 :
  exists2 g : {poly K}, ~~ root g 0 & exists (B : 'M_(r + d + (a - (k + d)), a)) C, \det (B *m P *m C) = g * \det D.
Proof.
have := subnKC (_ : (k + d <= a)%N); rewrite -{1}(eqP freeE) rank_leq_col => /(_ isT); move: (a - (k + d))%N => e ade.
case: a / ade P E freeE rows in_0 => P1 E1 free1 rows1 inE; have [E' unitE] := complete_rows free1.
have /row_freeP[Y ZPY] : row_free (col_mx Z (E' *m at0 P1)).
  apply: inj_row_free => u; rewrite -[u]hsubmxK mul_row_col => u0.
  have /inE/submxP[al e1] : (rsubmx u *m E' *m at0 P1 <= Z)%MS.
    by rewrite -mulmxA -(addKr (lsubmx u *m Z) (_ *m _)) u0 addr0 -mulNmx submxMl.
  have : row_mx (- al) (rsubmx u) *m col_mx E1 E' = 0 by rewrite mul_row_col e1 mulNmx addNr.
  move/(congr1 (mulmx^~ (invmx (col_mx E1 E')))); rewrite mulmxK // mul0mx -[0]row_mx0 => /eq_row_mx[_ u2].
  by move: u0; rewrite u2 mul0mx addr0 => /eqP; rewrite (mulmx_free_eq0 _ freeZ) => /eqP ->; rewrite row_mx0.
move: ZPY; rewrite -[Y]hsubmxK mul_col_row scalar_mx_block => /eq_block_mx[ZY1 ZX _ PX].
pose J1 := block_mx (const J) 0 0 (1%:M : 'M[{poly K}]_d); pose X := const (rsubmx Y).
exists (\det (const J *m D') * \det (const E' *m P1 *m X)).
  rewrite /root hornerM mulf_eq0 negb_or -!/(horner_eval 0 _) -!det_map_mx.
  by rewrite !map_mxM !at0_const left PX !det1 oner_neq0.
exists (block_mx J1 0 0 1%:M *m const (col_mx E1 E')), (row_mx (const (lsubmx Y)) X).
have TP : const (col_mx E1 E') *m P1 = col_mx (const E1 *m P1) (const E' *m P1) by rewrite map_col_mx mul_col_mx.
have JE : J1 *m (const E1 *m P1) = block_mx (const J *m D') 0 H D *m const Z.
  by rewrite rows1 mulmxA mulmx_block !mul0mx !mulmx0 !mul1mx !addr0 !add0r.
rewrite -[_ *m const _ *m P1]mulmxA TP mul_block_col !mul0mx addr0 add0r mul1mx JE mul_col_row.
rewrite -[block_mx _ _ _ _ *m const Z *m const _]mulmxA -map_mxM ZY1 map_mx1 mulmx1.
rewrite -[block_mx _ _ _ _ *m const Z *m X]mulmxA -map_mxM ZX map_mx0 mulmx0.
by rewrite !det_lblock mulrAC.
Qed.

End ReachedInZero.
