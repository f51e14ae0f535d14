(** Vectors and matrices as lists of numbers of any arithmetic, and what they mean in a field. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra zify.
From faultspace Require Import NumbersVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Meaning.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation vec := (vector_of value).
Notation mat := (matrix_of value).
Implicit Types (u v x : seq (numeral R)) (M T : seq (seq (numeral R))).

Lemma place_nil j : value (@at_place R [::] j) = 0.
Proof. by rewrite /at_place nth_nil (value_zero meaning). Qed.

Lemma place_sum u v j : value (at_place (sum u v) j) = value (at_place u j) + value (at_place v j).
Proof.
rewrite /at_place; elim: u v j => [|a u IH] [|b v] [|j] //=;
  by rewrite ?nth_nil ?(value_zero meaning) ?add0r ?addr0 ?(value_plus meaning).
Qed.

Lemma place_multiple a u j : value (at_place (multiple a u) j) = value a * value (at_place u j).
Proof. by rewrite /at_place; elim: u j => [|b u IH] [|j] //=; rewrite ?(value_zero meaning) ?mulr0 ?(value_mult meaning). Qed.

Lemma place_blank u j : blank u -> value (at_place u j) = 0.
Proof.
rewrite /at_place; elim: u j => [|b u IH] [|j] //=; rewrite ?(value_zero meaning) //; case/andP=> b0 // rest.
  exact: (value_vanishes meaning).
exact: IH.
Qed.

Lemma vec_nil k : vec k [::] = 0.
Proof. by apply/rowP => j; rewrite !mxE place_nil. Qed.

Lemma vec_sum k u v : vec k (sum u v) = vec k u + vec k v.
Proof. by apply/rowP => j; rewrite !mxE place_sum. Qed.

Lemma vec_multiple k a u : vec k (multiple a u) = value a *: vec k u.
Proof. by apply/rowP => j; rewrite !mxE place_multiple. Qed.

Lemma vec_blank k u : blank u -> vec k u = 0.
Proof. by move=> h; apply/rowP => j; rewrite !mxE place_blank. Qed.

Lemma row_mat a b M (i : 'I_a) : row i (mat a b M) = vec b (nth [::] M i).
Proof. by apply/rowP => j; rewrite !mxE. Qed.

Lemma vec_row_times a b x M : (size M <= a)%N -> vec b (row_times x M) = vec a x *m mat a b M.
Proof.
elim: M x a => [|r M IH] [|c x] a h /=; rewrite ?vec_nil ?mul0mx //.
- by rewrite (_ : mat a b [::] = 0) ?mulmx0 //; apply/row_matrixP => i; rewrite row_mat row0 nth_nil vec_nil.
case: a h => // a h.
rewrite vec_sum vec_multiple (IH _ a h) !mulmx_sum_row big_ord_recl /= row_mat [vec a.+1 _ 0 0]mxE; congr (_ + _).
by apply: eq_bigr => i _; rewrite !row_mat [vec a _ 0 _]mxE [vec a.+1 _ 0 _]mxE.
Qed.

Lemma inner_product k u v : (size u <= k)%N -> vec k u *m (vec k v)^T = (value (inner u v))%:M.
Proof.
move=> h; apply/matrixP => i j; rewrite !ord1 {i j} !mxE eqxx mulr1n.
elim: u v k h => [|a u IH] v k h /=.
  by rewrite (value_zero meaning) big1 // => i _; rewrite !mxE place_nil mul0r.
case: k h => // k h; case: v => [|b v].
  by rewrite (value_zero meaning) big1 // => i _; rewrite !mxE place_nil mulr0.
rewrite big_ord_recl (value_plus meaning) (value_mult meaning) !mxE /= -(IH v k h); congr (_ + _).
by apply: eq_bigr => i _; rewrite !mxE.
Qed.

Lemma inner_entry k u v : (size u <= k)%N -> (vec k u *m (vec k v)^T) 0 0 = value (inner u v).
Proof. by move=> h; rewrite inner_product // mxE eqxx mulr1n. Qed.

Lemma vec_times_column a b M x : all (fun r => size r == b) M -> (vec a (times_column M x))^T = mat a b M *m (vec b x)^T.
Proof.
move=> h; apply/row_matrixP => i; rewrite row_mul row_mat.
have e : (size (nth [::] M i) <= b)%N.
  by have [l|l] := ltnP i (size M); [rewrite (eqP (all_nthP [::] h _ l))|rewrite nth_default].
rewrite (inner_product _ e); apply/matrixP => k j; rewrite !ord1 !mxE eqxx mulr1n /times_column; congr value.
rewrite /at_place; have [l|l] := ltnP i (size M); first by rewrite (nth_map [::]).
by rewrite !nth_default // size_map.
Qed.

Lemma value_is_one a : is_one a -> value a = 1.
Proof. by move/(value_vanishes meaning); rewrite (value_minus meaning) (value_one meaning) => /eqP; rewrite subr_eq0 => /eqP. Qed.

Lemma value_invertible a : invertible a -> value a != 0.
Proof. by move/value_is_one; rewrite (value_mult meaning) => e; apply/eqP => a0; move/eqP: e; rewrite a0 mul0r eq_sym oner_eq0. Qed.

Lemma value_minus_one : value (minus (zero R) (one R)) = - 1.
Proof. by rewrite (value_minus meaning) (value_zero meaning) (value_one meaning) sub0r. Qed.

Lemma vec_same k u v : same u v -> vec k u = vec k v.
Proof.
move=> h; apply/rowP => j; rewrite !mxE; elim: u v h (nat_of_ord j) => [|a u IH] [|b v] //= /andP[ab /IH e] [|i]; last exact: e.
by rewrite /at_place /=; apply/eqP; rewrite -subr_eq0 -(value_minus meaning) (value_vanishes meaning).
Qed.

Lemma nonzero_vector k v : seen_nonzero k v -> vec k v != 0.
Proof.
case/andP=> /eqP sv /(has_nthP (zero R))[j jv /value_invertible seen]; rewrite sv in jv.
by apply/eqP => /rowP/(_ (Ordinal jv)); rewrite !mxE => v0; move/eqP: seen; apply; exact: v0.
Qed.

Lemma unit_row_vec k (i : 'I_k) : vec k (unit_row R k i) = row i 1%:M.
Proof.
apply/rowP => j; rewrite !mxE /at_place nth_mkseq // eq_sym -val_eqE /=.
by case: (_ == _); rewrite ?(value_one meaning) ?(value_zero meaning).
Qed.

(** Tables that are invertible. *)
Lemma triangular_unit t (Q : 'M[K]_t) M : is_triangular M -> t = size M ->
  (forall i j : 'I_t, Q i j = value (at_place (nth [::] M i) j)) -> Q \in unitmx.
Proof.
move=> /allP tri tM e; have at_row (i : 'I_t) : nat_of_ord i \in iota 0 (size M) by rewrite mem_iota -tM /=.
rewrite -unitmx_tr unitmxE det_trig ?unitfE.
  by apply/prodf_neq0 => i _; rewrite mxE e value_invertible //; case/andP: (tri _ (at_row i)).
apply/is_trig_mxP => i j ij; rewrite mxE e (value_vanishes meaning) //; case/andP: (tri _ (at_row j)) => _ /allP; apply.
by rewrite mem_iota.
Qed.

Lemma diagonal_unit t (Q : 'M[K]_t) M : is_diagonal M -> t = size M ->
  (forall i j : 'I_t, Q i j = value (at_place (nth [::] M i) j)) -> Q \in unitmx.
Proof.
move=> /allP diagonal tM e; have at_row (i : 'I_t) : nat_of_ord i \in iota 0 (size M) by rewrite mem_iota -tM /=.
have entry (i j : 'I_t) := allP (diagonal _ (at_row i)) _ (at_row j); rewrite unitmxE det_trig ?unitfE.
  by apply/prodf_neq0 => i _; rewrite e value_invertible //; have := entry i i; rewrite eqxx.
by apply/is_trig_mxP => i j ij; rewrite e (value_vanishes meaning) //; have := entry i j; rewrite ltn_eqF.
Qed.

(** The rank of a table. *)
Section Rank.
Variables (b : nat).
Notation led_by := (seq (nat * seq (numeral R))).
Let u0 : nat * seq (numeral R) := (0%N, [::]).

Lemma rank_at_pivots (us : led_by) : all (fun c => c.1 < b)%N us ->
  (\matrix_(i < size us, j < size us) value (at_place (nth [::] (square_at us) i) j)) \in unitmx ->
  \rank (mat (size us) b [seq c.2 | c <- us]) = size us.
Proof.
move=> /allP inside; set Q := \matrix_(i, j) _ => unit_Q.
pose P : 'M[K]_(b, size us) := \matrix_(j, i) (j == (nth u0 us i).1 :> nat)%:R.
apply/eqP; rewrite eqn_leq rank_leq_row /= -[X in (X <= _)%N](mxrank_unit unit_Q).
suff -> : Q = mat (size us) b [seq c.2 | c <- us] *m P by apply: mxrankM_maxl.
apply/matrixP => i j; have jb := inside _ (mem_nth u0 (ltn_ord j)); rewrite [RHS]mxE (bigD1 (Ordinal jb)) //= big1 => [|k kj]; last first.
  by rewrite [P _ _]mxE (_ : (_ == _) = false) ?mulr0 //; apply: contraNF kj => /eqP kj; apply/eqP/val_inj.
rewrite [P _ _]mxE /= eqxx mulr1 addr0 [Q _ _]mxE [RHS]mxE (nth_map u0) // (nth_map u0) //.
by rewrite /places_at {1}/at_place (nth_map 0%N) ?size_map // (nth_map u0).
Qed.

Lemma rank_of_triangle us : all (fun c => c.1 < b)%N us -> is_triangular (square_at us) ->
  \rank (mat (size us) b [seq c.2 | c <- us]) = size us.
Proof.
by move=> inside tri; apply: rank_at_pivots => //; apply: triangular_unit tri _ _ => [|i j]; rewrite ?size_map // mxE.
Qed.

Lemma rank_of_combinations T us : all (fun c => c.1 < b)%N us -> is_diagonal (square_at (combination T us)) ->
  (size us <= \rank (mat (size T) b T))%N.
Proof.
move=> inside one; have sizes : size (combination T us) = size us by apply: size_map.
have inside' : all (fun c => c.1 < b)%N (combination T us) by rewrite /combination all_map.
have unit_one : (\matrix_(i < size (combination T us), j < size (combination T us))
    value (at_place (nth [::] (square_at (combination T us)) i) j)) \in unitmx.
  by apply: diagonal_unit one _ _ => [|i j]; rewrite ?size_map // mxE.
rewrite -sizes -(rank_at_pivots inside' unit_one).
apply: mxrankS; apply/row_subP => i; rewrite row_mat.
have i_us : (i < size us)%N by rewrite -sizes.
rewrite (nth_map u0) // (nth_map u0) //= (@vec_row_times (size T)) //; exact: submxMl.
Qed.

Lemma rank_of_table a r T nulls combinations : has_rank a b r T nulls combinations -> \rank (mat a b T) = r.
Proof.
case/andP=> /and5P[/andP[/eqP sT /allP rows] in_n in_c /eqP sizes /eqP sc] /and3P[/allP zero tri one].
have := rank_of_combinations in_c one; rewrite sT sc => low; apply/eqP; rewrite eqn_leq low andbT.
have := rank_of_triangle in_n tri; set N := mat _ _ _ => rank_N.
suff /mulmx0_rank_max : mat a b T *m N^T = 0 by rewrite mxrank_tr rank_N -sizes; lia.
apply/matrixP => i j; have iT : (i < size T)%N by rewrite sT.
have row_in : nth [::] T i \in T by apply: mem_nth.
transitivity ((vec b (nth [::] T i) *m (vec b (nth [::] [seq c.2 | c <- nulls] j))^T) 0 0).
  by rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE.
rewrite inner_entry ?(eqP (rows _ row_in)) // (nth_map u0) // [RHS]mxE (value_vanishes meaning) //.
by have /allP/(_ _ (mem_nth u0 (ltn_ord j))) := zero _ row_in.
Qed.

End Rank.
End Meaning.
