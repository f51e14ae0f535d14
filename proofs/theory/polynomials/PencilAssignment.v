(** Every polynomial is a determinant: when the e rows of q b - a, in e + 1 + r columns, have a right inverse over the polynomials and
    those of b are independent, constant rows can be found that complete q b - a to a square matrix of any determinant of degree at most e,
    and only one of them has to follow the polynomial. By induction on e: a constant column h with b h = 0, on which a is not zero, reduces
    one row and one column. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop perm zmodp ssralg poly matrix mxalgebra mxpoly
  zify.
From faultspace Require Import Minors.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The leading coefficient of a determinant. *)
Lemma det_lead (K : fieldType) k (M : 'M[{poly K}]_k) (d : 'I_k -> nat) : (forall i j, size (M i j) <= (d i).+1)%N ->
  (size (\det M) <= (\sum_i d i).+1)%N /\ (\det M)`_(\sum_i d i) = \det (\matrix_(i, j) (M i j)`_(d i)).
Proof.
move=> le; have top (t : 'S_k) : (size (\prod_i M i (t i))%R <= (\sum_i d i).+1)%N /\
    (\prod_i M i (t i))`_(\sum_i d i) = \prod_i (M i (t i))`_(d i).
  apply: (@big_rec3 _ _ _ (fun (x : {poly K}) (y : nat) (c : K) => (size x <= y.+1)%N /\ x`_y = c)) => [|i x y c _ [sx ex]].
    by rewrite size_poly1 coef1.
  have si := le i (t i); split; first by apply: leq_trans (size_mul_leq _ _) _; lia.
  have le_d : (d i < (d i + y).+1)%N by rewrite ltnS leq_addr.
  rewrite coefM (bigD1 (Ordinal le_d)) //= addKn ex big1 ?addr0 // => j /negPf jd.
  have [ji|ij|e] := ltngtP j (d i); last by rewrite -val_eqE /= e eqxx in jd.
    by rewrite [x`_ _]nth_default ?mulr0 //; apply: leq_trans sx _; rewrite -addnBAC ?(ltnW ji) // -[y.+1]add1n leq_add2r subn_gt0.
  by rewrite [(M i (t i))`_j]nth_default ?mul0r //; exact: leq_trans si ij.
split.
  apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => t _; have [s _] := top t.
  by rewrite -signr_odd; case: (odd _); rewrite ?mulN1r ?size_opp ?mul1r.
rewrite /determinant coef_sum; apply: eq_bigr => t _; have [_ c] := top t.
under [in RHS]eq_bigr do rewrite mxE.
by case: (odd_perm t); rewrite ?expr1 ?expr0 ?mulN1r ?coefN ?mul1r c.
Qed.

(** Blocks. *)
Lemma regroup_rows (R : Type) e f k (A : 'M[R]_(1, k)) (B : 'M_(e, k)) (C : 'M_(f, k)) :
  col_mx (col_mx A B) C = col_mx A (col_mx B C) :> 'M_(1 + e + f, k).
Proof. by rewrite [RHS]col_mxA; apply/matrixP => i j; rewrite castmxE /= !cast_ord_id. Qed.

Lemma no_rows_above (R : Type) k l (B : 'M[R]_(0, l)) (M : 'M[R]_(k, l)) : col_mx B M = M :> 'M_(k, l).
Proof.
apply/matrixP => i j; rewrite mxE; case: splitP => [[]//|l' e].
by congr (M _ j); apply/esym/val_inj.
Qed.

(** Linear in one row. *)
Lemma det_row_linear (R : comRingType) e r (A : 'M[R]_(e, e + (1 + r))) (x y : 'rV_(e + (1 + r))) (Q : 'M_(r, e + (1 + r))) t :
  \det (col_mx A (col_mx (x - t *: y) Q)) = \det (col_mx A (col_mx x Q)) - t * \det (col_mx A (col_mx y Q)).
Proof.
pose i0 : 'I_(e + (1 + r)) := rshift e (lshift r ord0).
have other u w : row' i0 (col_mx A (col_mx u Q)) = row' i0 (col_mx A (col_mx w Q)).
  apply/matrixP => i j; rewrite !mxE; case: splitP => // k ek; rewrite !mxE; case: splitP => // l el.
  case/negP: (neq_lift i0 i); apply/eqP/val_inj; apply: etrans _ (esym ek).
  by rewrite el [l]ord1.
rewrite (@determinant_multilinear _ _ _ (col_mx A (col_mx x Q)) (col_mx A (col_mx y Q)) i0 1 (- t)) //; first by rewrite mul1r mulNr.
by apply/rowP => j; rewrite !mxE !(unsplitK (inr _)) !mxE !(unsplitK (inl _)) !mxE mul1r mulNr.
Qed.

Lemma det_eliminate (R : comRingType) k (y : 'rV[R]_k) (l : 'cV_k) (A : 'M_k) :
  \det (block_mx 1%:M 0 l 1%:M *m block_mx 1%:M y 0 A) = \det A.
Proof. by rewrite det_mulmx det_lblock det_ublock !det1 !mul1r. Qed.

Section PencilAssignment.
Variable K : fieldType.
Notation const := (map_mx (@polyC K)).
Notation linear_rows b a := ('X *: const b - const a).

(** Two conditions, each met by some column of the kernel of b, are met by one. *)
Lemma common_column N e (b : 'M[K]_(e, N)) (c : 'rV_N) e' (a : 'M[K]_(e', N)) :
  (exists h : 'cV_N, b *m h = 0 /\ c *m h != 0) -> (exists h : 'cV_N, b *m h = 0 /\ a *m h != 0) ->
  exists h : 'cV_N, [/\ b *m h = 0, c *m h != 0 & a *m h != 0].
Proof.
move=> [h1 [bh1 ch1]] [h2 [bh2 ah2]].
have [ah1|] := eqVneq (a *m h1) 0; last by move=> ?; exists h1.
have [ch2|] := eqVneq (c *m h2) 0; last by move=> ?; exists h2.
by exists (h1 + h2); rewrite !mulmxDr bh1 bh2 ch2 ah1 !addr0 add0r; split.
Qed.

(** A right-invertible pencil of e >= 1 rows: a does not vanish on the kernel of b. *)
Lemma kernel_column N e (a b : 'M[K]_(e.+1, N)) : (exists X, linear_rows b a *m X = 1%:M) -> exists h : 'cV_N, b *m h = 0 /\ a *m h != 0.
Proof.
move=> [X right]; have [/eqP a0|a0] := boolP (a *m cokermx b == 0); last first.
  have [j hj] : exists j, a *m col j (cokermx b) != 0.
    apply/existsP; apply: contraNT a0; rewrite negb_exists => /forallP h0; apply/eqP/matrixP => i j.
    have /eqP/matrixP/(_ i 0) : a *m col j (cokermx b) == 0 by have := h0 j; rewrite negbK.
    by rewrite colE mulmxA -colE !mxE.
  by exists (col j (cokermx b)); split=> //; rewrite colE mulmxA mulmx_coker mul0mx.
have /submxP[c ac] : (a <= b)%MS by rewrite submxE a0.
have : char_poly_mx c *m (const b *m X) = 1%:M.
  by rewrite -right mulmxA; congr (_ *m X); rewrite /char_poly_mx mulmxBl mul_scalar_mx ac map_mxM.
move/(congr1 determinant); rewrite det_mulmx det1 -/(char_poly c) => /(congr1 (fun g : {poly K} => size g)).
have cp0 : char_poly c != 0 by apply/monic_neq0/char_poly_monic.
have [->|d0] := eqVneq (\det (const b *m X)) 0; first by rewrite mulr0 size_poly0 size_poly1.
by rewrite size_mul // size_char_poly size_poly1 !addSn /= => -[/eqP]; rewrite addn_eq0 size_poly_eq0 (negPf d0) andbF.
Qed.

Lemma size_linear (x y : K) : (size ('X * x%:P - y%:P)%R <= 2)%N /\ ('X * x%:P - y%:P)`_1 = x.
Proof.
split; last by rewrite coefB coefXM !coefC /= subr0.
apply/leq_sizeP => k; case: k => [|[|k]] // _; rewrite coefB coefXM !coefC /=; exact: subr0.
Qed.

Lemma leading_row e r (b a : 'M[K]_(e, e + (1 + r))) (beta alpha : 'rV_(e + (1 + r))) (Q : 'M_(r, e + (1 + r))) :
  let T := \det (col_mx (linear_rows b a) (col_mx (linear_rows beta alpha) (const Q))) in
  (size T <= e.+2)%N /\ T`_e.+1 = \det (col_mx b (col_mx beta Q)).
Proof.
pose M := col_mx (linear_rows b a) (col_mx (linear_rows beta alpha) (const Q)).
pose d (i : 'I_(e + (1 + r))) := if split i is inr j then (if split j is inl _ then 1 else 0)%N else 1%N.
have sum_d : (\sum_i d i = e.+1)%N.
  have sl k l (i : 'I_k) : split (lshift l i) = inl i := unsplitK (inl i).
  have sr k l (i : 'I_l) : split (rshift k i) = inr i := unsplitK (inr i).
  rewrite big_split_ord big_split_ord /= big_ord1 /d sr sl [(\sum_(i < r) _)%N]big1 => [|i _]; last by rewrite !sr.
  rewrite (eq_bigr (fun=> 1%N)) => [|i _]; last by rewrite sl.
  by rewrite sum1_card card_ord addn0 addn1.
have sizes i j : (size (M i j) <= (d i).+1)%N.
  rewrite /M /d mxE; case: splitP => k _; rewrite !mxE; first by case: (size_linear (b k j) (a k j)).
  by case: splitP => l _; rewrite !mxE ?size_polyC ?leq_b1 //; case: (size_linear (beta l j) (alpha l j)).
have [s1 c1] := det_lead sizes; rewrite sum_d in s1 c1; split=> //; rewrite c1; congr determinant; apply/matrixP => i j.
rewrite /M /d !mxE; case: splitP => k _; rewrite !mxE; first by case: (size_linear (b k j) (a k j)).
by case: splitP => l _; rewrite !mxE ?coefC //; case: (size_linear (beta l j) (alpha l j)).
Qed.

Lemma unit_column N (h : 'cV[K]_(1 + N)) : h != 0 -> exists H : 'M_(1 + N), H \in unitmx /\ exists H', H = row_mx h H'.
Proof.
move=> h0; have free : row_free h^T.
  apply: inj_row_free => u; rewrite [u]mx11_scalar mul_scalar_mx => /eqP; rewrite scaler_eq0 trmx_eq0 (negPf h0) orbF => /eqP ->.
  exact: raddf0.
have [E' unitE] := complete_rows free; exists (col_mx h^T E')^T; rewrite unitmx_tr unitE; split=> //.
by exists E'^T; rewrite tr_col_mx trmxK.
Qed.

(** No row: what is to follow is the row c, times any constant. *)
Lemma assign_constant r (a b : 'M[K]_(0, 0 + (1 + r))) (c : 'rV_(0 + (1 + r))) : row_free (col_mx b c) ->
  exists Q : 'M_(r, 0 + (1 + r)), row_free (col_mx b (col_mx c Q)) /\
  forall g : {poly K}, (size g <= 1)%N -> exists rho, \det (col_mx (linear_rows b a) (const (col_mx rho Q))) = g.
Proof.
move=> free; have {}free : row_free c.
  apply: inj_row_free => u u0; have : row_mx (0 : 'rV_0) u = 0
  by apply: (row_free_inj free); rewrite mul_row_col !mul0mx add0r u0.
  by move/(congr1 rsubmx); rewrite row_mxKr linear0.
have [Q unitQ] := @complete_rows K 1 r c free; exists Q; split; first by rewrite no_rows_above row_free_unit.
move=> g /size1_polyC ->; exists ((g`_0 / \det (col_mx c Q)) *: c); rewrite no_rows_above det_map_mx; congr polyC.
have -> : col_mx ((g`_0 / \det (col_mx c Q)) *: c) Q = block_mx (g`_0 / \det (col_mx c Q))%:M 0 0 1%:M *m col_mx c Q.
  by rewrite mul_block_col !mul0mx mul1mx addr0 add0r mul_scalar_mx.
have dd t : \det (block_mx (t%:M : 'M[K]_1) 0 0 (1%:M : 'M_r)) = t by rewrite det_ublock det1 mulr1 det_scalar expr1.
rewrite det_mulmx; apply: etrans (congr1 (fun x => x * _) (dd _)) _; rewrite divfK // -unitfE -unitmxE.
exact: unitQ.
Qed.

(** A constant column by which one row and one column are reduced. *)
Lemma reducing_column N e (a b : 'M[K]_(e.+1, N)) (c : 'rV_N) : row_free (col_mx b c) -> (exists X, linear_rows b a *m X = 1%:M) ->
  exists h : 'cV_N, [/\ b *m h = 0, c *m h != 0 & a *m h != 0].
Proof.
move=> free right; apply: common_column; last exact: kernel_column right.
have : ~~ (c <= b)%MS.
  apply/negP => /submxP[u cu]; have : row_mx u (- 1%:M) = 0.
    by apply: (row_free_inj free); rewrite mul_row_col mulNmx mul1mx -cu subrr mul0mx.
  move/(congr1 rsubmx); rewrite row_mxKr linear0 => /matrixP/(_ 0 0)/eqP.
  by rewrite !mxE oppr_eq0 oner_eq0.
rewrite submxE => /matrix0Pn[i [j cij]]; exists (col j (cokermx b)); split; first by rewrite colE mulmxA mulmx_coker mul0mx.
apply: contraNneq cij; rewrite colE mulmxA -colE => /matrixP/(_ i 0); rewrite !mxE => ->.
exact: eqxx.
Qed.

Section Reduction.
Variables (e r : nat) (a b : 'M[K]_(1 + e, 1 + (e + (1 + r)))) (c : 'rV[K]_(1 + (e + (1 + r)))) (h : 'cV[K]_(1 + (e + (1 + r)))).
Hypotheses (free : row_free (col_mx b c)) (bh : b *m h = 0) (ch : c *m h != 0).

(** H begins with h, and L takes -a h to the first row of the identity. *)
Variables (H : 'M[K]_(1 + (e + (1 + r)))) (H' : 'M[K]_(1 + (e + (1 + r)), e + (1 + r))) (L1 : 'M[K]_(1 + e)) (L1' : 'M[K]_(1 + e, e)).
Hypotheses (unitH : H \in unitmx) (HE : H = row_mx h H') (unitL1 : L1 \in unitmx) (LE : L1 = row_mx (- (a *m h)) L1').
Let L := invmx L1.
Let beta : 'rV_(e + (1 + r)) := usubmx (L *m b *m H').
Let b' : 'M_(e, e + (1 + r)) := dsubmx (L *m b *m H').
Let alpha : 'rV_(e + (1 + r)) := usubmx (L *m a *m H').
Let a' : 'M_(e, e + (1 + r)) := dsubmx (L *m a *m H').

Lemma reduced_b : L *m b *m H = block_mx 0 beta 0 b'.
Proof. by rewrite HE mul_mx_row -mulmxA bh mulmx0 block_mxEh col_mx0 vsubmxK. Qed.

Lemma reduced_a : L *m a *m H = block_mx (- 1%:M) alpha 0 a'.
Proof.
have Lah : L *m (a *m h) = - col_mx 1%:M 0.
  have : L *m L1 = 1%:M by rewrite mulVmx.
  rewrite LE mul_mx_row scalar_mx_block block_mxEh => /eq_row_mx[].
  by rewrite mulmxN => /eqP; rewrite eqr_oppLR => /eqP.
by rewrite HE mul_mx_row -mulmxA Lah opp_col_mx oppr0 block_mxEh vsubmxK.
Qed.

Lemma reduced_rows : const L *m linear_rows b a *m const H = block_mx 1%:M (linear_rows beta alpha) 0 (linear_rows b' a').
Proof.
have -> : const L *m linear_rows b a *m const H = linear_rows (L *m b *m H) (L *m a *m H).
  by rewrite !map_mxM mulmxBr mulmxBl -!scalemxAr -!scalemxAl.
rewrite reduced_b reduced_a !map_block_mx scale_block_mx opp_block_mx add_block_mx !map_mx0 !scaler0 !map_mxN map_mx1 opprK oppr0.
by rewrite !addr0 add0r.
Qed.

(** What is left after the reduction has the same two properties. *)
Lemma reduced_free : row_free (col_mx b' beta).
Proof.
apply: inj_row_free => u; rewrite -[u]hsubmxK mul_row_col => u0.
have : row_mx (row_mx (rsubmx u) (lsubmx u) *m L) (0 : 'rV_1) = 0.
  apply: (row_free_inj free); rewrite mul_row_col !mul0mx addr0; apply: (can_inj (mulmxK unitH)).
  by rewrite mul0mx -!mulmxA [L *m _]mulmxA reduced_b mul_row_block !mulmx0 addr0 addrC u0 row_mx0.
move/(congr1 lsubmx); rewrite row_mxKl linear0 => /(congr1 (mulmx^~ L1)).
rewrite -mulmxA mulVmx // mulmx1 mul0mx => e0.
by have := congr1 lsubmx e0; have := congr1 rsubmx e0; rewrite row_mxKl row_mxKr !linear0 => -> ->; rewrite row_mx0.
Qed.

Lemma reduced_right : (exists X, linear_rows b a *m X = 1%:M) -> exists X, linear_rows b' a' *m X = 1%:M.
Proof.
move=> [X XE]; pose Y := const (invmx H) *m X *m const L1.
have : const L *m linear_rows b a *m const H *m Y = 1%:M.
  rewrite /Y -!mulmxA [const H *m _]mulmxA -map_mxM mulmxV // map_mx1 mul1mx [linear_rows b a *m _]mulmxA XE mul1mx.
  by rewrite -map_mxM mulVmx // map_mx1.
rewrite reduced_rows -[Y]submxK mulmx_block scalar_mx_block => /eq_block_mx[_ _ _ e1].
by exists (drsubmx Y); rewrite -[RHS]e1 mul0mx add0r.
Qed.

(** Rows found for it are rows for q b - a. *)
Lemma lifted_free (Q' : 'M_(r, e + (1 + r))) : row_free (col_mx b' (col_mx beta Q')) ->
  row_free (col_mx b (col_mx c (row_mx 0 Q' *m invmx H))).
Proof.
move=> freeQ'; have bH : b *m H = L1 *m (L *m b *m H) by rewrite !mulmxA mulmxV ?mul1mx.
have cH : c *m H = row_mx (c *m h) (c *m H') by rewrite HE mul_mx_row.
apply: inj_row_free => u; rewrite -[u]hsubmxK -[rsubmx u]hsubmxK !mul_row_col.
move: (lsubmx u) (lsubmx (rsubmx u)) (rsubmx (rsubmx u)) => u0 u2 u3 /(congr1 (mulmx^~ H)).
rewrite !mulmxDl mul0mx -!mulmxA mulVmx // mulmx1 bH mulmxA reduced_b cH -[u0 *m L1]hsubmxK mul_row_block !mul_mx_row !mulmx0.
rewrite !add_row_mx !addr0 add0r -[X in _ = X]row_mx0 => /eq_row_mx[e1 e2].
have u20 : u2 = 0.
  move: e1 ch; rewrite [u2]mx11_scalar [c *m h]mx11_scalar mul_scalar_mx => /eqP; rewrite scaler_eq0 => /orP[/eqP -> _|/eqP -> /eqP//].
  exact: raddf0.
have : row_mx (rsubmx (u0 *m L1)) (row_mx (lsubmx (u0 *m L1)) u3) = 0.
  apply: (row_free_inj freeQ'); rewrite !mul_row_col mul0mx -[RHS]e2 u20 mul0mx add0r addrA; congr (_ + _); exact: addrC.
move=> z; have := congr1 lsubmx z; rewrite row_mxKl linear0 => w1.
have := congr1 rsubmx z; rewrite row_mxKr linear0 => z'; have := congr1 lsubmx z'; rewrite row_mxKl linear0 => w0.
have := congr1 rsubmx z'; rewrite row_mxKr linear0 => ->.
have : u0 *m L1 = 0 by rewrite -[LHS]hsubmxK w0 w1 row_mx0.
by move/(congr1 (mulmx^~ L)); rewrite mulmxK // mul0mx => ->; rewrite u20 !row_mx0.
Qed.

Lemma lifted_determinant t rho' (Q' : 'M_(r, e + (1 + r))) :
  (\det L * \det H) *: \det (col_mx (linear_rows b a) (const (col_mx (row_mx t%:M rho' *m invmx H) (row_mx 0 Q' *m invmx H)))) =
  \det (col_mx (linear_rows b' a') (const (col_mx rho' Q'))) -
    t *: \det (col_mx (linear_rows b' a') (col_mx (linear_rows beta alpha) (const Q'))).
Proof.
set M0 := col_mx _ _.
have M1E : const (block_mx L 0 0 1%:M) *m M0 *m const H = col_mx (block_mx 1%:M (linear_rows beta alpha) 0 (linear_rows b' a'))
    (col_mx (row_mx t%:P%:M (const rho')) (row_mx 0 (const Q'))).
  rewrite map_block_mx !map_mx0 map_mx1 mul_block_col !mul0mx mul1mx addr0 add0r mul_col_mx reduced_rows -map_mxM mul_col_mx.
  by rewrite !mulmxKV // map_col_mx !map_row_mx map_mx0 map_scalar_mx.
transitivity (\det (const (block_mx L 0 0 (1%:M : 'M_(1 + r))) *m M0 *m const H)).
  by rewrite !det_mulmx !det_map_mx det_ublock det1 mulr1 -mul_polyC rmorphM [LHS]mulrAC.
rewrite M1E block_mxEv regroup_rows.
pose l : 'M[{poly K}]_(e + (1 + r), 1) := col_mx 0 (col_mx t%:P%:M 0).
have -> : col_mx (row_mx 1%:M (linear_rows beta alpha)) (col_mx (row_mx 0 (linear_rows b' a'))
    (col_mx (row_mx t%:P%:M (const rho')) (row_mx 0 (const Q')))) =
    block_mx 1%:M 0 l 1%:M *m block_mx 1%:M (linear_rows beta alpha) 0 (col_mx (linear_rows b' a')
      (col_mx (const rho' - t%:P *: linear_rows beta alpha) (const Q'))).
  rewrite mulmx_block !mul1mx !mul0mx ?mulmx0 !mulmx1 !addr0 /l !mul_col_mx !mul0mx mul_scalar_mx !add_col_mx !add0r.
  by rewrite [_ + (_ - _)]addrC subrK block_mxEv -[row_mx (col_mx _ _) _]block_mxEh block_mxEv
    -[row_mx (col_mx _ _) _]block_mxEh block_mxEv.
apply: etrans (det_eliminate _ _ _) _; rewrite det_row_linear -map_col_mx -mul_polyC.
by [].
Qed.

End Reduction.

Theorem every_determinant e : forall r (a b : 'M[K]_(e, e + (1 + r))) (c : 'rV_(e + (1 + r))), row_free (col_mx b c) ->
  (exists X, linear_rows b a *m X = 1%:M) -> exists Q : 'M_(r, e + (1 + r)), row_free (col_mx b (col_mx c Q)) /\
  forall g : {poly K}, (size g <= e.+1)%N -> exists rho, \det (col_mx (linear_rows b a) (const (col_mx rho Q))) = g.
Proof.
elim: e => [|e IH] r a b c free right; first exact: assign_constant.
have [h [bh ch ah]] := reducing_column free right.
have [H [unitH [H' HE]]] := unit_column (ltac:(by apply: contraNneq ch => ->; rewrite mulmx0) : h != 0).
have [L1 [unitL1 [L1' LE]]] := unit_column (ltac:(by rewrite oppr_eq0) : - (a *m h) != 0).
have [Q' [freeQ' assign]] := IH r _ _ _ (reduced_free free bh unitH HE unitL1) (reduced_right bh unitH HE unitL1 LE right).
exists (row_mx 0 Q' *m invmx H); split; first exact: (lifted_free bh ch unitH HE unitL1 freeQ').
move=> g sg; have := lifted_determinant bh unitH HE unitL1 LE _ _ Q'.
pose La := invmx L1 *m a *m H'; pose Lb := invmx L1 *m b *m H'.
have [] := leading_row (dsubmx Lb) (dsubmx La) (usubmx Lb) (usubmx La) Q'; set T := \det _ => sT eT lifted.
have lam0 : T`_e.+1 != 0 by rewrite eT -unitfE -unitmxE -row_free_unit; exact: freeQ'.
pose u := \det (invmx L1) * \det H; have u0 : u != 0 by rewrite mulf_neq0 // -unitfE -unitmxE // unitmx_inv.
pose g1 := u *: g; pose t := - (g1`_e.+1 / T`_e.+1).
have sg1 : (size g1 <= e.+2)%N by rewrite size_scale.
have [|rho' erho] := assign (g1 + t *: T).
  apply/leq_sizeP => k; rewrite leq_eqVlt => /orP[/eqP <-|ek].
    by rewrite coefD [(t *: T)`_ _]coefZ /t mulNr divfK // subrr.
  rewrite coefD [(t *: T)`_ _]coefZ (nth_default 0 (leq_trans sg1 ek)) (nth_default 0 (leq_trans sT ek)) mulr0.
  exact: addr0.
exists (row_mx t%:M rho' *m invmx H); apply: (scalerI u0); rewrite -/g1.
by apply: etrans (lifted t rho') _; rewrite erho addrK.
Qed.

End PencilAssignment.
