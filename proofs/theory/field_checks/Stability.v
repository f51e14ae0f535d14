(** The recursion of Schur and Cohn: a polynomial that passes has all its roots inside the unit circle, and a matrix at which it vanishes is
    stable. With a stable matrix Stein's equation X = M' X M has one solution.

     up f z, down f z == the value at z of the polynomial f with its coefficients ascending, and descending
    polynomial_at f M == f(M), the coefficients descending *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  ssrint matrix mxalgebra mxpoly.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import CertificatesVocabulary NumbersVocabulary ExperimentsVocabulary Lists NumberLists OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma difference_of_squares (K : comRingType) (x y G H G' H' : K) :
  (x * G + y * H) * (x * G' + y * H') - (y * G + x * H) * (y * G' + x * H') = (x * x - y * y) * (G * G' - H * H').
Proof.
have e (a b c d : K) : a * b * (c * d) = a * c * (b * d) by apply: mulrACA.
have expanded (a b : K) : (a * G + b * H) * (a * G' + b * H') = a * a * (G * G') + b * b * (H * H') + a * b * (G * H' + H * G').
  rewrite mulrDl !mulrDr (e a G a) (e a G b) (e b H a) (e b H b) [b * a]mulrC -!addrA; congr (_ + _).
  by rewrite addrA addrC.
have turned (a b c d : K) : a + b - (c + d) = a - d - (c - b) by rewrite opprD opprB [- c - d]addrC addrACA.
by rewrite !expanded [y * x]mulrC opprD addrACA subrr addr0 turned mulrBl !mulrBr.
Qed.

(** Values of a list of coefficients, ascending and descending. *)
Section Values.
Variable C : numClosedFieldType.
Implicit Types (f g : seq Z) (z : C).
Notation number := (number C).

Definition up f z : C := foldr (fun c y => y * z + number c) 0 f.
Definition down f z : C := foldl (fun y c => y * z + number c) 0 f.

Lemma numberM a b : number (Z.mul a b) = number a * number b.
Proof. exact: (rmorphM (number_rmorphism _)). Qed.

Lemma numberB a b : number (Z.sub a b) = number a - number b.
Proof. exact: (rmorphB (number_rmorphism _)). Qed.

Lemma down_rev f z : down (rev f) z = up f z.
Proof. by rewrite /down foldl_rev. Qed.

Lemma down_rcons f c z : down (rcons f c) z = down f z * z + number c.
Proof. by rewrite /down foldl_rcons. Qed.

Lemma up_rcons f c z : up (rcons f c) z = up f z + z ^+ size f * number c.
Proof.
elim: f => [|b f IH] /=; first by rewrite mul0r expr0 mul1r addrC addr0.
by rewrite IH mulrDl exprS -!addrA; congr (_ + _); rewrite addrC; congr (_ + _); rewrite mulrC mulrA.
Qed.

Lemma down_cons c f z : down (c :: f) z = down f z + z ^+ size f * number c.
Proof. by rewrite -[c :: f]revK down_rev rev_cons up_rcons size_rev -(down_rev (rev f)) revK. Qed.

Lemma up_scale d f z : up [seq Z.mul d c | c <- f] z = number d * up f z.
Proof. by elim: f => [|c f IH] /=; rewrite ?mulr0 // IH numberM mulrDr mulrA. Qed.

Lemma down_scale d f z : down [seq Z.mul d c | c <- f] z = number d * down f z.
Proof. by rewrite -(revK (map _ f)) down_rev -map_rev up_scale -(down_rev (rev f)) revK. Qed.

Lemma up_combined a b (us vs : seq Z) z : size us = size vs ->
  up [seq Z.sub (Z.mul a c.1) (Z.mul b c.2) | c <- zip us vs] z = number a * up us z - number b * up vs z.
Proof.
elim: us vs => [|u us IH] [|v vs] //=; first by rewrite !mulr0 subr0.
case=> /IH ->; rewrite numberB !numberM mulrBl !mulrDr !mulrA opprD addrACA.
by [].
Qed.

Lemma down_combined a b (us vs : seq Z) z : size us = size vs ->
  down [seq Z.sub (Z.mul a c.1) (Z.mul b c.2) | c <- zip us vs] z = number a * down us z - number b * down vs z.
Proof.
move=> e; rewrite -(revK (map _ _)) down_rev -map_rev rev_zip // up_combined ?size_rev //.
by rewrite -!down_rev !revK.
Qed.

Lemma number_conj a : (number a)^* = number a.
Proof. by rewrite /number rmorph_int. Qed.

Lemma number_norm a : `|number a| = number (Z.abs a).
Proof. by rewrite /number -intr_norm; congr (_%:~R); case: a => // p /=; lia. Qed.

Lemma number_lt a b : Z.ltb (Z.abs b) (Z.abs a) -> `|number b| < `|number a|.
Proof. by move=> h; rewrite !number_norm /number ltr_int; lia. Qed.

Lemma number_neq0 a : a != Z0 -> number a != 0.
Proof. by move=> h; rewrite /number intr_eq0; case: a h => // p _ /=; lia. Qed.

(** One step: with G and H smaller than G, a G + b H is larger than a H + b G. *)
Lemma larger (a b : Z) (G H : C) : `|number b| < `|number a| -> G != 0 -> `|H| <= `|G| ->
  number a * G + number b * H != 0 /\ `|number a * H + number b * G| <= `|number a * G + number b * H|.
Proof.
move=> ba G0 HG; split.
  apply/negP => /eqP e; have : `|number a * G| = `|number b * H| by move/eqP: e; rewrite addr_eq0 => /eqP ->; rewrite normrN.
  rewrite !normrM; apply/eqP; rewrite gt_eqF //; apply: le_lt_trans (_ : `|number b| * `|G| < _); first exact: ler_wpM2l.
  by rewrite ltr_pM2r // normr_gt0.
have square u v : `|number u * G + number v * H| ^+ 2 = (number u * G + number v * H) * (number u * G^* + number v * H^*).
  by rewrite normCK; congr (_ * _); rewrite rmorphD !rmorphM /= !number_conj.
have squares (u v : C) : `|u| <= `|v| -> u * u^* <= v * v^* by move=> uv; rewrite -!normCK !expr2 ler_pM ?normr_ge0.
rewrite -ler_sqr ?nnegrE ?normr_ge0 // [number a * H + _]addrC !square -subr_ge0.
have := squares _ _ (ltW ba); rewrite !number_conj -subr_ge0 => /mulr_ge0 h.
have := squares _ _ HG; rewrite -subr_ge0 => /h; set x := number a; set y := number b.
by rewrite -(difference_of_squares x y G H G^* H^*).
Qed.

(** The step turned round. *)
Lemma backward (a b : Z) (D U : C) : `|number b| < `|number a| -> number a * D - number b * U != 0 ->
  `|number a * U - number b * D| <= `|number a * D - number b * U| -> D != 0 /\ `|U| <= `|D|.
Proof.
move=> ba G0 HG; have [] := larger ba G0 HG; set x := number a; set y := number b.
have solved (u v : C) : x * (x * u - y * v) + y * (x * v - y * u) = (x * x - y * y) * u.
  by rewrite !mulrBr !mulrA [y * x]mulrC addrA subrK mulrBl.
rewrite !solved => DU; have xy : x * x - y * y != 0 by apply: contraNneq DU => ->; rewrite mul0r.
rewrite !normrM ler_pM2l ?normr_gt0 // => le_UD; split=> //.
by apply: contraNneq DU => ->; rewrite mulr0.
Qed.

Lemma outside_circle k f z : inside_circle k f -> 1 <= `|z| -> down f z != 0 /\ `|up f z| <= `|down f z|.
Proof.
move=> + z1; elim: k f => [|k IH] f /=.
  by case: f => [|a []] //= a0; rewrite /down /up /= mul0r add0r lexx; split=> //; apply: number_neq0.
case: f => [|a r] //=; case/and5P=> r0 ba d0 /eqP dh /IH {IH}; case/lastP: r r0 ba d0 dh => // r b _.
rewrite last_rcons belast_rcons rev_rcons; set g := [seq _ | _ <- _]; set d := foldr _ _ g; set h := [seq Z.div c d | c <- g].
move=> ba /number_neq0 d0 dh [down_h le_h]; have sizes : size (a :: r) = size (b :: rev r) by rewrite /= size_rev.
have z0 : z != 0 by rewrite -normr_gt0 (lt_le_trans ltr01).
have eD : number a * down (a :: rcons r b) z - number b * up (a :: rcons r b) z = down g z * z.
  rewrite /g (down_combined _ _ _ sizes) -rev_rcons down_rev -rcons_cons down_rcons rcons_cons /=.
  by rewrite mulrBl !mulrDr !mulrA opprD addrACA [number b * number a]mulrC subrr addr0.
have eU : number a * up (a :: rcons r b) z - number b * down (a :: rcons r b) z = up g z.
  rewrite /g (up_combined _ _ _ sizes) -rev_rcons -(down_rev (rev _)) revK -rcons_cons up_rcons rcons_cons down_cons size_rcons /=.
  by rewrite !mulrDr opprD addrACA !(mulrCA _ (z ^+ _)) [number b * number a]mulrC subrr addr0.
have G0 : down g z * z != 0 by rewrite -dh down_scale !mulf_neq0.
have HG : `|up g z| <= `|down g z * z|.
  rewrite -dh down_scale up_scale !normrM -mulrA ler_wpM2l ?normr_ge0 //; apply: le_trans le_h _.
  by rewrite ler_peMr ?normr_ge0.
by apply: (backward (number_lt ba)); rewrite ?eD ?eU.
Qed.

End Values.

(** A polynomial at a matrix. *)
Section Matrices.
Variables (C : numClosedFieldType) (n : nat).
Implicit Types (f : seq Z) (M : 'M[C]_n).
Notation number := (number C).
Definition polynomial_at f M : 'M[C]_n := foldl (fun Y c => Y *m M + (number c)%:M) 0 f.

Lemma polynomial_at_eigenvector f M z (x : 'rV[C]_n) : x *m M = z *: x -> x *m polynomial_at f M = down f z *: x.
Proof.
move=> e; elim/last_ind: f => [|f c IH]; first by rewrite mulmx0 scale0r.
by rewrite /polynomial_at foldl_rcons -/(polynomial_at f M) mulmxDr mulmxA IH -scalemxAl e down_rcons scalerDl scalerA mul_mx_scalar.
Qed.

Theorem vanishing_is_stable f M : inside_circle (size f).-1 f -> polynomial_at f M = 0 -> schur_stable M.
Proof.
move=> ok vanishing z x x0 e; rewrite real_ltNge ?normr_real ?real1 //; apply/negP => /(outside_circle ok)[f0 _].
by have /eqP := polynomial_at_eigenvector f e; rewrite vanishing mulmx0 eq_sym scaler_eq0 (negPf f0) (negPf x0).
Qed.

(** Stein's equation X = M' X M has no solution but 0 where M is stable: on the row space of such an X the matrix M would be invertible,
    and an eigenvalue of M there would be one over an eigenvalue of M'. *)
Lemma eigenvector_exists r (M : 'M[C]_r) : (0 < r)%N -> exists z, exists2 x : 'rV_r, x != 0 & x *m M = z *: x.
Proof.
case: r M => // r M _; have : size (char_poly M) != 1%N by rewrite size_char_poly.
by case/closed_rootP=> z; rewrite -eigenvalue_root_char => /eigenvalueP[x e x0]; exists z, x.
Qed.

Lemma stein_factors M r (L : 'M[C]_(n, r)) (B : 'M_(r, n)) : (0 < r)%N -> row_free B -> row_full L -> schur_stable M ->
  M^T *m (L *m B) *m M = L *m B -> False.
Proof.
move=> r0 B_free L_full stable eX; have /row_fullP[L' LL] := L_full.
have eB : L' *m M^T *m L *m (B *m M) = B by rewrite -[RHS]mul1mx -LL -[RHS]mulmxA -eX !mulmxA.
have B_inside : (B <= B *m M)%MS by rewrite -{1}eB submxMl.
have rank_BM : \rank (B *m M) = r.
  by apply/eqP; rewrite eqn_leq rank_leq_row /= -{1}(eqP B_free) mxrankS.
have /submxP[W eW] : (B *m M <= B)%MS by rewrite -(geq_leqif (mxrank_leqif_sup B_inside)) rank_BM (eqP B_free).
have [z [t t0 et]] := eigenvector_exists W^T r0.
have eL : M^T *m L *m W = L.
  apply/(row_free_inj B_free); rewrite /= -[M^T *m L *m W *m B]mulmxA -eW -[in RHS]eX !mulmxA; done.
have eWt : W *m t^T = z *: t^T by rewrite -[W]trmxK -trmx_mul et linearZ.
pose y := t *m L^T; have y0 : y != 0.
  apply: contraNneq t0 => e; apply/eqP/trmx_inj; rewrite trmx0 -[t^T]mul1mx -LL -mulmxA.
  by rewrite -[L *m _]trmxK trmx_mul trmxK -/y e trmx0 mulmx0.
have ey : z *: (y *m M) = y.
  by apply: trmx_inj; rewrite linearZ /= !trmx_mul !trmxK -{2}eL -!mulmxA eWt -!scalemxAr.
have z0 : z != 0 by apply: contraNneq y0 => z0; rewrite -ey z0 scale0r.
have : `|z^-1| < 1 by apply: (stable _ y) => //; rewrite -{2}ey scalerA mulVf ?scale1r.
have W_free : row_free W.
  by rewrite -row_leq_rank -{1}rank_BM eW mxrankM_maxl.
have : ~~ row_free (W - z%:M).
  apply/negP; rewrite row_free_unit => U; have : t^T = 0.
    by rewrite -[t^T]mul1mx -(mulVmx U) -mulmxA mulmxBl eWt mul_scalar_mx subrr mulmx0.
  by move/(congr1 trmx); rewrite trmxK trmx0 => /eqP; rewrite (negPf t0).
rewrite -kermx_eq0 => /rowV0Pn[x /sub_kermxP ex x0] small_inverse.
have exW : x *m W = z *: x by apply/eqP; rewrite -subr_eq0 -mul_mx_scalar -mulmxBr ex.
have : `|z| < 1.
  apply: (stable _ (x *m B)); last by rewrite -mulmxA eW mulmxA exW scalemxAl.
  by apply: contraNneq x0 => e; apply/eqP/(row_free_inj B_free); rewrite /= e mul0mx.
move=> small; have := mulr_ilt1 (normr_ge0 z) (normr_ge0 z^-1) small small_inverse.
by rewrite -normrM mulfV // normr1 ltxx.
Qed.

Lemma stein_unique M (X : 'M[C]_n) : schur_stable M -> M^T *m X *m M = X -> X = 0.
Proof.
move=> stable; rewrite -[in X in X -> _](mulmx_base X) => eX; apply/eqP; rewrite -mxrank_eq0; apply: contraT; rewrite -lt0n => r0.
by case: (stein_factors r0 (row_base_free X) (col_base_full X) stable eX).
Qed.
End Matrices.

(** The check of stability, for numbers that mean complex ones. *)
Section Meaning.
Variables (R : arithmetic) (C : numClosedFieldType) (value : numeral R -> C).
Hypothesis meaning : means value.

Lemma integer_in_value a : value (integer_in R a) = number C a.
Proof.
have positive b : value (positive_in R b) = (Pos.to_nat b)%:R.
  elim: b => [b IH|b IH|] /=; rewrite ?(value_plus meaning) ?(value_one meaning) ?IH //.
    by rewrite (_ : Pos.to_nat b~1 = (Pos.to_nat b + Pos.to_nat b + 1)%N) ?natrD //; lia.
  by rewrite (_ : Pos.to_nat b~0 = (Pos.to_nat b + Pos.to_nat b)%N) ?natrD //; lia.
case: a => [|b|b] /=; rewrite ?(value_zero meaning) ?(value_minus meaning) ?positive //.
rewrite (value_zero meaning) sub0r /number /=; have : (0 < Pos.to_nat b)%N by lia.
by case: (Pos.to_nat b).
Qed.

Lemma row_polynomial_value n f M x : (size M <= n)%N ->
  vector_of value n (row_polynomial f M x) = vector_of value n x *m polynomial_at f (matrix_of value n n M).
Proof.
move=> sM; rewrite /row_polynomial /polynomial_at.
elim/last_ind: f => [|f c IH]; first by rewrite mulmx0 (vec_nil meaning).
rewrite !foldl_rcons (vec_sum meaning) (vec_row_times meaning _ _ sM) IH (vec_multiple meaning) integer_in_value mulmxDr mulmxA.
by rewrite mul_mx_scalar.
Qed.

Theorem is_stable_sound n M f : is_stable n M f -> schur_stable (matrix_of value n n M : 'M[C]_n).
Proof.
case/and3P=> sM ok /allP zero; apply: (vanishing_is_stable ok); apply/row_matrixP => i; rewrite row0.
rewrite -[polynomial_at _ _]mul1mx row_mul -(unit_row_vec meaning) -(row_polynomial_value _ _ sM) (vec_blank meaning) //.
by apply: zero; rewrite mem_iota /=.
Qed.
End Meaning.

(** Numbers of a field, seen in a larger one. *)
Lemma means_in (R : arithmetic) (K L : fieldType) (value : numeral R -> K) (embed : {rmorphism K -> L}) :
  means value -> means (fun a => embed (value a) : L).
Proof.
case=> v0 v1 vp vm vt vz; split=> [||a b|a b|a b|a /vz ->].
- by rewrite v0 rmorph0.
- by rewrite v1 rmorph1.
- by rewrite vp rmorphD.
- by rewrite vm rmorphB.
- by rewrite vt rmorphM.
by rewrite rmorph0.
Qed.

Lemma matrix_in (R : arithmetic) (K L : fieldType) (value : numeral R -> K) (embed : {rmorphism K -> L}) a b M :
  map_mx embed (matrix_of value a b M) = matrix_of (fun x => embed (value x)) a b M.
Proof. by apply/matrixP => i j; rewrite !mxE. Qed.

Theorem system_stable (R : arithmetic) (K : fieldType) (value : numeral R -> K) n M f : means value -> is_stable n M f ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}), schur_stable (map_mx embed (matrix_of value n n M) : 'M[C]_n).
Proof.
move=> meaning ok C embed.
have meaning' : means (fun a => embed (value a) : C) := @means_in R K C value embed meaning.
by rewrite (@matrix_in R K C value embed); exact: (is_stable_sound meaning' ok).
Qed.
