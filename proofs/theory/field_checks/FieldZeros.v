(** Diagonal forms of polynomial matrices, and the finite zeros of a system told by lists of numbers, by multipliers that make its pencil
    diagonal.

       in_fractions u == what the polynomial u means, as a rational function
    poly_matrix a b M == a table of polynomials as a matrix *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary TransferRank MinorsOfOrder.
From faultspace Require Import NumbersVocabulary NumberLists.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A matrix of polynomials X D Y, where X has a left and Y a right inverse. *)
Lemma gcd_of_factors (K : fieldType) a b N (P : 'M[{poly K}]_(a, b)) (X : 'M_(a, N)) (X' : 'M_(N, a)) (Y : 'M_(N, b)) (Y' : 'M_(b, N)) D :
  X' *m X = 1%:M -> Y *m Y' = 1%:M -> P = X *m D *m Y -> \det D != 0 ->
  gcd_of_minors_of_order N P (\det D) /\ \rank (over_fractions P) = N.
Proof.
move=> XX YY eP D0; have part B C : \det (B *m P *m C) = \det (B *m X) * (\det D * \det (Y *m C)).
  by rewrite eP -!mulmxA mulmxA det_mulmx det_mulmx.
split; first split.
- by apply/divides_minors_of_order_det => B C; rewrite part dvdp_mull // dvdp_mulr.
- by move=> h /divides_minors_of_order_det/(_ X' Y'); rewrite part XX YY !det1 mul1r mulr1.
apply/eqP; rewrite eqn_leq; apply/andP; split.
  by rewrite eP /over_fractions !map_mxM; apply: leq_trans (mxrankM_maxl _ _) _; apply: leq_trans (mxrankM_maxl _ _) _; apply: rank_leq_col.
have e : over_fractions X' *m over_fractions P *m over_fractions Y' = over_fractions D.
  by rewrite /over_fractions -!map_mxM eP !mulmxA XX mul1mx -mulmxA YY mulmx1.
have unit_D : over_fractions D \in unitmx by rewrite unitmxE /over_fractions det_map_mx unitfE tofrac_eq0.
by rewrite -[X in (X <= _)%N](mxrank_unit unit_D) -e; apply: leq_trans (mxrankM_maxl _ _) _; apply: mxrankM_maxr.
Qed.

Section Meaning.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation pol := (polynomial_of value).

Lemma coef_pol_of u i : (pol u)`_i = value (at_place u i).
Proof. by rewrite coef_poly; case: ltnP => // ui; rewrite /at_place nth_default // (value_zero meaning). Qed.

Lemma pol_sum u v : pol (sum u v) = pol u + pol v.
Proof. by apply/polyP => i; rewrite coefD !coef_pol_of (place_sum meaning). Qed.

Lemma pol_multiple a u : pol (multiple a u) = (value a)%:P * pol u.
Proof. by apply/polyP => i; rewrite coefCM !coef_pol_of (place_multiple meaning). Qed.

Lemma pol_cons a u : pol (a :: u) = (value a)%:P + 'X * pol u.
Proof. by apply/polyP => -[|i]; rewrite coefD coefC coefXM !coef_pol_of /= ?addr0 ?add0r. Qed.

Lemma pol_nil : pol [::] = 0.
Proof. by apply/polyP => i; rewrite coef_pol_of coef0 (place_nil meaning). Qed.

Lemma pol_one : pol [:: one R] = 1.
Proof. by rewrite pol_cons pol_nil mulr0 addr0 (value_one meaning). Qed.

Lemma pol_convolved u v : pol (convolved u v) = pol u * pol v.
Proof.
elim: u => [|a u IH] /=; first by rewrite pol_nil mul0r.
by rewrite pol_sum pol_multiple !pol_cons (value_zero meaning) add0r IH mulrDl mulrA.
Qed.

Lemma pol_blank u : blank u -> pol u = 0.
Proof. by move=> h; apply/polyP => i; rewrite coef_pol_of coef0 (place_blank meaning). Qed.

Definition in_fractions (u : numeral (polynomials R)) : {fraction {poly K}} := FracField.tofrac (pol u).

Lemma polynomials_mean : means in_fractions.
Proof.
split; rewrite /in_fractions /=.
- by rewrite pol_nil rmorph0.
- by rewrite pol_one rmorph1.
- by move=> u v; rewrite pol_sum rmorphD.
- by move=> u v; rewrite pol_sum pol_multiple (value_minus_one meaning) polyCN mulN1r rmorphB.
- by move=> u v; rewrite pol_convolved rmorphM.
by move=> u /pol_blank ->; rewrite rmorph0.
Qed.

(** Tables of polynomials as matrices. *)
Definition poly_matrix a b (M : seq (seq (seq (numeral R)))) : 'M[{poly K}]_(a, b) := \matrix_(i, j) pol (nth [::] (nth [::] M i) j).

Lemma poly_matrix_fractions a b M : over_fractions (poly_matrix a b M) = matrix_of in_fractions a b M.
Proof. by apply/matrixP => i j; rewrite !mxE. Qed.

Lemma over_fractions_inj a b : injective (@over_fractions K a b).
Proof. by move=> X Y /matrixP e; apply/matrixP => i j; apply/eqP; rewrite -tofrac_eq; have := e i j; rewrite !mxE => ->. Qed.

Lemma equal_poly_tables a b X T : @equal_tables (polynomials R) a b X T -> poly_matrix a b X = poly_matrix a b T.
Proof.
move=> /allP h; apply/matrixP => i j; rewrite !mxE.
have i_in : nat_of_ord i \in iota 0 a by rewrite mem_iota /=.
have j_in : nat_of_ord j \in iota 0 b by rewrite mem_iota /=.
have /pol_blank := allP (h _ i_in) _ j_in; rewrite /= pol_sum pol_multiple (value_minus_one meaning) polyCN mulN1r => /eqP.
by rewrite subr_eq0 => /eqP.
Qed.

Lemma poly_product a b c X T : size X = a -> (size T <= b)%N ->
  poly_matrix a c (@table_product (polynomials R) X T) = poly_matrix a b X *m poly_matrix b c T.
Proof.
move=> sX sT; apply: over_fractions_inj; rewrite /over_fractions map_mxM -!/(over_fractions _) !poly_matrix_fractions.
apply/row_matrixP => i; rewrite row_mul !row_mat (nth_map [::]) ?sX // (@vec_row_times _ _ _ polynomials_mean b) //.
Qed.

Lemma diagonal_poly a b d : poly_matrix a b (diagonal_table a b d) = \matrix_(i, j) if i == j :> nat then pol (nth [::] d i) else 0.
Proof.
apply/matrixP => i j; rewrite !mxE (nth_map 0%N) ?size_iota // nth_iota // add0n nth_mkseq // eq_sym.
by case: ifP => // _; rewrite pol_nil.
Qed.

Lemma diagonal_one a : poly_matrix a a (diagonal_table a a (nseq a [:: one R])) = 1%:M.
Proof.
rewrite diagonal_poly; apply/matrixP => i j; rewrite !mxE nth_nseq ltn_ord pol_one -val_eqE /=.
by case: (_ == _).
Qed.

Lemma is_diagonalized_sound a b T d U U' V V' : size T = a -> is_diagonalized a b T d U U' V V' ->
  [/\ poly_matrix a a U *m poly_matrix a a U' = 1%:M, poly_matrix b b V *m poly_matrix b b V' = 1%:M
    & poly_matrix a a U *m poly_matrix a b T *m poly_matrix b b V = \matrix_(i, j) if i == j :> nat then pol (nth [::] d i) else 0].
Proof.
move=> sT /andP[/and4P[/andP[/eqP sU _] /andP[/eqP sU' _] /andP[/eqP sV _] /andP[/eqP sV' _]]].
case/and3P=> /equal_poly_tables oneU /equal_poly_tables oneV /equal_poly_tables diag.
have sUT : size (@table_product (polynomials R) U T) = a by rewrite size_map.
move: oneU oneV diag; rewrite !diagonal_one (poly_product (b := a) _ sU) ?sU' // (poly_product (b := b) _ sV) ?sV' //.
by rewrite (poly_product (b := b) _ sUT) ?sV // (poly_product (b := a) _ sU) ?sT // diagonal_poly.
Qed.

Variables (n m p : nat) (L : listing R).
Let S := system_of value n m p L.

Lemma pencil_rows_meaning : poly_matrix (n + m) (n + p) (pencil_rows n m p L) = pencil S.
Proof.
apply/matrixP => i j; rewrite mxE /pencil /pencil_rows nth_cat size_map size_iota.
case: (split_ordP i) => s ->; rewrite ?(block_mxEul, block_mxEur) /=.
  rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n nth_cat size_mkseq.
  case: (split_ordP j) => t ->; rewrite ?block_mxEul ?block_mxEur /=.
    rewrite nth_mkseq // !pol_cons pol_nil mulr0 addr0 !mxE (value_minus meaning) (value_zero meaning) sub0r polyCN addrC.
    by rewrite -val_eqE /= eq_sym; case: (_ == _); rewrite ?(value_one meaning) ?(value_zero meaning) ?polyC0 ?mulr0 ?mulr1 ?mulr1n ?mulr0n.
  by rewrite addKn nth_mkseq // pol_cons pol_nil mulr0 addr0 !mxE.
rewrite addKn (nth_map 0%N) ?size_iota // nth_iota // add0n nth_cat size_mkseq.
case: (split_ordP j) => t ->; rewrite ?block_mxEdl ?block_mxEdr /=.
  by rewrite nth_mkseq // pol_cons pol_nil mulr0 addr0 !mxE (value_minus meaning) (value_zero meaning) sub0r polyCN.
by rewrite addKn nth_mkseq // pol_cons pol_nil mulr0 addr0 !mxE.
Qed.

Theorem has_finite_zeros_sound r g c d U U' V V' : has_finite_zeros n m p r L g c d U U' V V' ->
  [/\ \rank (transfer S) = r, gcd_of_minors_of_order (n + r) (pencil S) (pol g) & pol g \is monic].
Proof.
rewrite /has_finite_zeros; set a := (n + m)%N; set b := (n + p)%N; set places := nonzero_places _ _ _.
case/andP=> /and5P[diagonal /allP nonzero /eqP sizes unit_c monic_g] /pol_blank same_g.
have sP : size (pencil_rows n m p L) = a by rewrite size_cat !size_map !size_iota.
have [] := is_diagonalized_sound sP diagonal; rewrite pencil_rows_meaning.
set MU := poly_matrix a a U; set MU' := poly_matrix a a U'; set MV := poly_matrix b b V; set MV' := poly_matrix b b V' => oneU oneV diag.
have in_places (k : 'I_(size places)) : (nth 0%N places k < minn a b)%N /\ nth 0%N places k \in places.
  by have in_k := mem_nth 0%N (ltn_ord k); split=> //; move: in_k; rewrite mem_filter mem_iota add0n => /andP[].
have row_lt (k : 'I_(size places)) : (nth 0%N places k < a)%N by have [+ _] := in_places k; rewrite leq_min => /andP[].
have col_lt (k : 'I_(size places)) : (nth 0%N places k < b)%N by have [+ _] := in_places k; rewrite leq_min => /andP[].
have unique : uniq places by rewrite filter_uniq ?iota_uniq.
pose E : 'M[{poly K}]_(a, size places) := \matrix_(i, k) (i == Ordinal (row_lt k))%:R.
pose F : 'M[{poly K}]_(size places, b) := \matrix_(k, j) (j == Ordinal (col_lt k))%:R.
pose D : 'M[{poly K}]_(size places) := diag_mx (\row_k pol (nth [::] d (nth 0%N places k))).
have places_eq (k l : 'I_(size places)) : (nth 0%N places k == nth 0%N places l) = (k == l) by rewrite nth_uniq.
have EE : E^T *m E = 1%:M.
  apply/matrixP => k l; rewrite mxE (bigD1 (Ordinal (row_lt k))) //= big1 => [|i ik]; last by rewrite !mxE (negPf ik) mul0r.
  by rewrite !mxE eqxx mul1r addr0 -val_eqE /= places_eq.
have FF : F *m F^T = 1%:M.
  apply/matrixP => k l; rewrite mxE (bigD1 (Ordinal (col_lt k))) //= big1 => [|i ik]; last by rewrite !mxE (negPf ik) mul0r.
  by rewrite !mxE eqxx mul1r addr0 -val_eqE /= places_eq.
have EDF : E *m D *m F = \matrix_(i < a, j < b) if i == j :> nat then pol (nth [::] d i) else 0.
  apply/matrixP => i j; rewrite [RHS]mxE mul_mx_diag mxE.
  have [k ik|none] := pickP (fun k : 'I_(size places) => nth 0%N places k == i :> nat).
    rewrite (bigD1 k) //= big1 => [|l lk]; last first.
      rewrite !mxE -val_eqE /= -(eqP ik) eq_sym places_eq (negPf lk) !mul0r //.
    rewrite !mxE -!val_eqE /= -(eqP ik) eqxx mul1r addr0 eq_sym; case: (_ == _); by rewrite ?mulr1 ?mulr0.
  rewrite big1 => [|k _]; last by rewrite !mxE -val_eqE /= eq_sym none !mul0r.
  case: eqP => // ij; have : nat_of_ord i \notin places.
    by apply/negP => /(nthP 0%N)[k ks ki]; have := none (Ordinal ks); rewrite /= ki eqxx.
  by rewrite mem_filter mem_iota add0n leq_min ltn_ord /= ij ltn_ord andbT negbK => /pol_blank.
have D0 : \det D != 0.
  rewrite det_diag; apply/prodf_neq0 => k _; rewrite mxE; have [_ /nonzero/hasP[x x_in /(value_invertible meaning) x0]] := in_places k.
  by apply: contraNneq x0 => e; rewrite -(nth_index (zero R) x_in) -[nth _ _ _]/(at_place _ _) -coef_pol_of e coef0.
have eP : pencil S = (MU' *m E) *m D *m (F *m MV').
  have : MU' *m (MU *m pencil S *m MV) *m MV' = pencil S by rewrite !mulmxA (mulmx1C oneU) mul1mx -mulmxA oneV mulmx1.
  by rewrite diag -EDF !mulmxA.
have left : (E^T *m MU) *m (MU' *m E) = 1%:M by rewrite -!mulmxA (mulmxA MU) oneU mul1mx.
have right : (F *m MV') *m (MV *m F^T) = 1%:M by rewrite -!mulmxA (mulmxA MV') (mulmx1C oneV) mul1mx.
have [gcd_D rank_P] := gcd_of_factors left right eP D0.
have det_D : (value c)%:P * pol g = \det D.
  move/eqP: same_g; rewrite !pol_sum !pol_multiple (value_minus_one meaning) polyCN mulN1r subr_eq0 => /eqP ->.
  rewrite det_diag; transitivity (\prod_(i <- places) pol (nth [::] d i)).
    by elim: (places) => [|i s IH] /=; rewrite ?big_nil ?pol_one // big_cons pol_convolved IH.
  by rewrite (big_nth 0%N) big_mkord; apply: eq_bigr => k _; rewrite mxE.
have c0 := value_invertible meaning unit_c; split.
- by move: rank_P; rewrite pencil_rank_transfer sizes => /addnI.
- move: gcd_D; rewrite -det_D mul_polyC sizes => -[divides largest].
  split=> [f h|h /largest]; last by rewrite dvdpZr.
  by have := divides f h; rewrite dvdpZl.
have g1 := value_is_one meaning monic_g; rewrite monicE lead_coefE /polynomial_of size_poly_eq.
  by rewrite -/(pol g) coef_pol_of /at_place nth_last g1.
by rewrite /at_place nth_last g1 oner_neq0.
Qed.

End Meaning.
