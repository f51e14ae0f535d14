(** Lines of faults told by lists of numbers: the system with the faults a F + b F', a G + b G' is left-invertible for every (a : b) but
    (0, 0). As a factor other than 0 does not matter, (a : b) is (1 : t) or (0 : 1). For (1 : t) the pencil is seen at some points to have
    full rank where a polynomial in t is not zero; the sum of these polynomials is 1, so at no t of any field are all of them zero.

    value_in t u == what the polynomial u means, at t *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra.
From faultspace Require Import Vocabulary Inversion SeenBasis.
From faultspace Require Import NumbersVocabulary NumberLists FieldZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Faults times a number other than 0. *)
Lemma left_invertible_scaled (K : fieldType) n m p (S : system K n m p) (a : K) F (G : 'M_(m, p)) : a != 0 ->
  left_invertible (with_faults S F G) -> left_invertible (with_faults S (a *: F) (a *: G)).
Proof.
move=> a0 invertible v quiet k.
have states j : state (with_faults S F G) 0 (fun i => a *: v i) j = state (with_faults S (a *: F) (a *: G)) 0 v j.
  by elim: j => //= j ->; rewrite -scalemxAl scalemxAr.
have /invertible/(_ k)/eqP : forall j, output (with_faults S F G) 0 (fun i => a *: v i) j = 0.
  by move=> j; rewrite -[RHS](quiet j) /output states /= -scalemxAl scalemxAr.
by rewrite scaler_eq0 (negPf a0) => /eqP.
Qed.

(** Rows N, M with N W = 1, N Y = 0 and M Y Z = e, not zero, are independent. *)
Lemma independent_rows (K : fieldType) a b c (N : 'M[K]_(a, c)) (M : 'M_(b, c)) (W : 'M_(c, a)) (Y : 'M_(c, b)) (Z : 'M_b) e :
  N *m W = 1%:M -> N *m Y = 0 -> M *m Y *m Z = e%:M -> e != 0 -> \rank (col_mx N M) = (a + b)%N.
Proof.
move=> NW NY MYZ e0; apply/eqP; rewrite -[_ == _]/(row_free _) -kermx_eq0; apply/eqP/row_matrixP => i; rewrite row0.
move: (row i _) (row_sub i (kermx (col_mx N M))) => u {i} /sub_kermxP; rewrite -[u]hsubmxK mul_row_col.
move: (lsubmx u) (rsubmx u) => x w {u} zero.
have w0 : w = 0.
  have /eqP : (x *m N + w *m M) *m (Y *m Z) = 0 by rewrite zero mul0mx.
  rewrite mulmxDl !mulmxA -[x *m N *m Y]mulmxA NY mulmx0 mul0mx add0r -!mulmxA [M *m _]mulmxA MYZ mul_mx_scalar.
  by rewrite scaler_eq0 (negPf e0) => /eqP.
move: zero; rewrite w0 mul0mx addr0 => /(congr1 (mulmx^~ W)); rewrite -mulmxA NW mulmx1 mul0mx => ->.
by rewrite row_mx0.
Qed.

Section Sound.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation pol := (polynomial_of value).
Notation table := (seq (seq (numeral R))).

(** Polynomials mean their values at any t of the field. *)
Definition value_in (t : K) (u : numeral (polynomials R)) : K := (pol u).[t].

Lemma values_mean t : means (value_in t).
Proof.
split; rewrite /value_in /=.
- by rewrite (pol_nil meaning) horner0.
- by rewrite (pol_one meaning) hornerC.
- by move=> u v; rewrite (pol_sum meaning) hornerD.
- by move=> u v; rewrite (pol_sum meaning) (pol_multiple meaning) (value_minus_one meaning) polyCN mulN1r hornerD hornerN.
- by move=> u v; rewrite (pol_convolved meaning) hornerM.
by move=> u /(pol_blank meaning) ->; rewrite horner0.
Qed.

Lemma value_constant t x : value_in t [:: x] = value x.
Proof. by rewrite /value_in (pol_cons meaning) (pol_nil meaning) mulr0 addr0 hornerC. Qed.

Lemma value_linear t x y : value_in t [:: x; y] = value x + t * value y.
Proof. by rewrite /value_in !(pol_cons meaning) (pol_nil meaning) mulr0 addr0 !hornerE. Qed.

Lemma mat_constants t a b (M : table) : matrix_of (value_in t) a b (constants M) = matrix_of value a b M.
Proof.
apply/matrixP => i j; rewrite !mxE /at_place /constants; have [iM|Mi] := ltnP i (size M).
  rewrite (nth_map [::]) //; have [jr|rj] := ltnP j (size (nth [::] M i)); first by rewrite (nth_map (zero R)) // value_constant.
  by rewrite [X in value_in t X]nth_default ?size_map // [X in value X]nth_default // (value_zero meaning) (value_zero (values_mean t)).
rewrite [X in value_in t (nth _ X _)]nth_default ?size_map // [X in value (nth _ X _)]nth_default //.
by rewrite [X in value_in t X]nth_nil [X in value X]nth_nil (value_zero meaning) (value_zero (values_mean t)).
Qed.

Section Tables.
Variables (Q : arithmetic) (val : numeral Q -> K).
Hypothesis mean : means val.

Lemma mat_product a b c X T : size X = a -> size T = b ->
  matrix_of val a c (table_product X T) = matrix_of val a b X *m matrix_of val b c T.
Proof.
by move=> sX sT; apply/row_matrixP => i; rewrite row_mul !row_mat (nth_map [::]) ?sX // (vec_row_times mean c (a := b)) // sT.
Qed.

Lemma mat_equal a b X T : equal_tables a b X T -> matrix_of val a b X = matrix_of val a b T.
Proof.
move=> /allP h; apply/matrixP => i j; rewrite !mxE; apply/eqP; rewrite -subr_eq0 -(value_minus mean) (value_vanishes mean) //.
by apply: (allP (h i _)); rewrite mem_iota /=.
Qed.

Lemma mat_nil a b : matrix_of val a b [::] = 0.
Proof. by apply/matrixP => i j; rewrite !mxE nth_nil (place_nil mean). Qed.

Lemma mat_unit k : matrix_of val k k [seq unit_row Q k i | i <- iota 0 k] = 1%:M.
Proof.
apply/row_matrixP => i; rewrite row_mat (nth_map 0%N) ?size_iota // nth_iota // add0n; exact: unit_row_vec.
Qed.

End Tables.

Variables n m p : nat.
Implicit Types L : listing R.
Notation sys := (system_of value n m p).

Lemma states_at_meaning L c : matrix_of value n (n + p) (states_at n p L c) = row_mx ((value c)%:M - sysA (sys L)) (sysC (sys L)).
Proof.
apply/matrixP => i j; rewrite mxE /states_at (nth_map 0%N) ?size_iota // nth_iota // add0n /at_place nth_cat size_mkseq.
case: (split_ordP j) => s ->; rewrite ?row_mxEl ?row_mxEr /=.
  rewrite nth_mkseq // (value_minus meaning) !mxE -val_eqE /= eq_sym; congr (_ - _).
  by case: (_ == _); rewrite ?mulr1n ?mulr0n ?(value_zero meaning).
by rewrite addKn nth_mkseq // !mxE.
Qed.

Lemma faults_along_meaning L L' t : matrix_of (value_in t) m (n + p) (faults_along n m p L L') =
  row_mx (- (sysF (sys L) + t *: sysF (sys L'))) (sysG (sys L) + t *: sysG (sys L')).
Proof.
apply/matrixP => i j; rewrite mxE /faults_along (nth_map 0%N) ?size_iota // nth_iota // add0n /at_place nth_cat size_mkseq.
case: (split_ordP j) => s ->; rewrite ?row_mxEl ?row_mxEr /=.
  by rewrite nth_mkseq // value_linear !(value_minus meaning) (value_zero meaning) !sub0r mulrN -opprD !mxE.
by rewrite addKn nth_mkseq // value_linear !mxE.
Qed.

Lemma multiple_meaning t e : matrix_of (value_in t) m m (diagonal_table m m (nseq m e)) = (value_in t e)%:M.
Proof.
apply/matrixP => i j; rewrite !mxE (nth_map 0%N) ?size_iota // nth_iota // add0n /at_place nth_mkseq // nth_nseq ltn_ord -val_eqE /= eq_sym.
by case: (_ == _); rewrite ?mulr1n ?mulr0n // /value_in (pol_nil meaning) horner0.
Qed.

(** Where the part of a point is not zero the pencil there has full rank. *)
Lemma shown_at_sound L L' t x : shown_at n m p L L' x -> value_in t (determinant_part x) != 0 ->
  left_invertible (with_faults (sys L) (sysF (sys L) + t *: sysF (sys L')) (sysG (sys L) + t *: sysG (sys L'))).
Proof.
case/andP=> /and3P[/eqP sW /eqP sY /eqP sZ] /and3P[/(mat_equal meaning) NW /(mat_equal meaning) NY].
move=> /(mat_equal (values_mean t)) MYZ e0.
have sN : size (states_at n p L (point x)) = n by rewrite size_map size_iota.
have sM : size (faults_along n m p L L') = m by rewrite size_map size_iota.
have sC : size (constants (unseen_by_states x)) = (n + p)%N by rewrite size_map.
move: NW NY MYZ; rewrite !(mat_product meaning _ (b := n + p)) // (mat_unit meaning) (mat_nil meaning) states_at_meaning.
rewrite (mat_product (values_mean t) _ (b := m)) ?size_map ?size_iota //.
rewrite (mat_product (values_mean t) _ (b := n + p)) // faults_along_meaning mat_constants multiple_meaning => NW NY MYZ.
have full := independent_rows NW NY MYZ e0; apply/left_invertible_pencil_rank; apply/eqP.
rewrite eqn_leq rank_leq_row -[X in (X <= _)%N]full.
set S1 := with_faults _ _ _; rewrite (_ : col_mx _ _ = map_mx (horner_eval (value (point x))) (pencil S1)) ?rank_at_point //.
rewrite /pencil map_block_mx /block_mx; congr (col_mx (row_mx _ _) (row_mx _ _)); apply/matrixP => i j.
all: rewrite !mxE /horner_eval ?hornerE //.
by case: (_ == _); rewrite ?mulr1n ?mulr0n ?hornerE.
Qed.

Theorem is_left_invertible_line_sound L L' points others : is_left_invertible_line n m p L L' points others ->
  let S := sys L in let S' := sys L' in
  forall a b : K, (a != 0) || (b != 0) -> left_invertible (with_faults S (a *: sysF S + b *: sysF S') (a *: sysG S + b *: sysG S')).
Proof.
case/andP=> /and4P[_ _ /eqP eA /eqP eC] shown S S' a b.
case/orP: shown => [/eqP m0 _ v _ k|/and3P[shown one second]]; first by apply/rowP => i; have := ltn_ord i; rewrite {2}m0.
case: (eqVneq a 0) => [-> /= b0|a0 _].
  rewrite !scale0r !add0r; apply: left_invertible_scaled b0 _.
  have [x ok e0] : exists2 x, shown_at n m p L' L x & value_in 0 (determinant_part x) != 0.
    elim: others second => //= x others IH /orP[/andP[ok /(value_invertible meaning) e0]|/IH //]; exists x => //.
    by rewrite /value_in horner_coef0 (coef_pol_of meaning).
  have := shown_at_sound ok e0; rewrite !scale0r !addr0 /S /S' /system_of /with_faults /= eA eC.
  by [].
have [t eb] : exists t, b = a * t by exists (a^-1 * b); rewrite mulrA mulfV // mul1r.
rewrite eb -!scalerA -!scalerDr; apply: left_invertible_scaled a0 _.
have : value_in t (foldr (@sum R) [::] [seq determinant_part x | x <- points]) != 0.
  by rewrite (value_is_one (values_mean t) one) oner_neq0.
elim: points shown {one} => [|x points IH] /=; first by rewrite /value_in (pol_nil meaning) horner0 eqxx.
case/andP=> shown /IH{}IH; rewrite (value_plus (values_mean t)); have [e0|e0 _] := eqVneq (value_in t (determinant_part x)) 0.
  by rewrite e0 add0r.
exact: shown_at_sound shown e0.
Qed.

End Sound.
