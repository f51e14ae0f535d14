(** The process of an experiment told by lists of numbers: its signals as combinations of the states at time 0 and the noise from then on,
    told by tables of their coefficients.

    holds xs x s == xs are the tables of the states x and s at one time *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop finset zmodp ssralg finalg matrix.
From faultspace Require Import Vocabulary NumbersVocabulary ExperimentsVocabulary NumberLists CheckMatrices FieldMatrices.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Where entry (i, j) of a matrix stands in its row vector. *)
Lemma index_pairs (T U : eqType) (x : T) (y : U) (xs : seq T) (ys : seq U) : x \in xs -> y \in ys ->
  index (x, y) [seq (a, b) | a <- xs, b <- ys] = (index x xs * size ys + index y ys)%N.
Proof.
move=> + y_in; elim: xs => // a xs IH; rewrite allpairs_cons index_cat size_map /= inE.
case: (eqVneq a x) => [->|ax].
  by rewrite map_f // index_map ?mul0n // => b b' [].
move=> /= /IH ->; rewrite ifF ?mulSn ?addnA //.
by apply/negP => /mapP[b _ [e _]]; rewrite e eqxx in ax.
Qed.

Lemma mxvec_index_val s q (i : 'I_s) (j : 'I_q) : mxvec_index i j = (i * q + j)%N :> nat.
Proof.
have -> : mxvec_index i j = index (i, j) (enum {: 'I_s * 'I_q}) :> nat.
  by rewrite /mxvec_index /= -[in RHS](nth_enum_rank (i, j) (i, j)) index_uniq ?enum_uniq // -cardE ltn_ord.
rewrite enumT unlock /= /prod_enum index_pairs ?mem_enum //.
by rewrite !index_enum_ord size_enum_ord.
Qed.

Lemma position_val s q (j : 'I_(s * q)) : position j = j.
Proof. by apply: ord_inj; rewrite mxvec_index_val /= -divn_eq. Qed.

Lemma future_entry (K : fieldType) N q t s (r : nat -> 'M[K]_(N, q)) i (j : 'I_(s * q)) :
  future t s r i j = r (t + j %/ q)%N i (Ordinal (output_lt j)).
Proof. by rewrite -[j in LHS]position_val /future /position mxE mxvecE !mxE. Qed.

(** What tables of coefficients mean. *)
Section Meaning.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).
Notation table := (seq (seq (numeral R))).
Implicit Types (T : table) (Ts : seq table).

Lemma mat_entry a b T (i : 'I_a) (j : 'I_b) : mat a b T i j = value (at_place (nth [::] T i) j).
Proof. by rewrite mxE. Qed.

Lemma mat_plus b q T T' : mat b q (plus_tables b T T') = mat b q T + mat b q T'.
Proof. by apply/matrixP => i j; rewrite !mxE nth_mkseq // (place_sum meaning). Qed.

Lemma mat_minus b q T : mat b q (minus_table T) = - mat b q T.
Proof.
apply/matrixP => i j; rewrite !mxE; have [iT|Ti] := ltnP i (size T).
  by rewrite (nth_map [::]) // (place_multiple meaning) (value_minus_one meaning) mulN1r.
by rewrite ![nth _ _ i]nth_default ?size_map // (place_nil meaning) oppr0.
Qed.

Lemma mat_product a b q T T' : (size T' <= b)%N -> mat a q (table_product T T') = mat a b T *m mat b q T'.
Proof.
move=> sT'; apply/row_matrixP => i; rewrite row_mul !(row_mat value); have [iT|Ti] := ltnP i (size T).
  by rewrite (nth_map [::]) // (vec_row_times meaning _ _ sT').
by rewrite ![nth _ _ i]nth_default ?size_map // !(vec_nil meaning) mul0mx.
Qed.

Lemma mat_columns b o q w T (le : (o + q <= w)%N) : mat b q (columns o q T) = colsub (fun j => widen_ord le (rshift o j)) (mat b w T).
Proof.
apply/matrixP => i j; rewrite !mxE /=; have [iT|Ti] := ltnP i (size T).
  by rewrite (nth_map [::]) // {1}/at_place nth_mkseq.
by rewrite ![nth _ _ i]nth_default ?size_map // !(place_nil meaning).
Qed.

Lemma mat_beside b a a' T T' : mat b (a + a') (beside b a T T') = row_mx (mat b a T) (mat b a' T').
Proof.
apply/matrixP => i j; rewrite mxE nth_mkseq //; case: (split_ordP j) => k ->.
  by rewrite row_mxEl mxE /at_place nth_cat size_mkseq /= ltn_ord nth_mkseq.
by rewrite row_mxEr mxE /at_place nth_cat size_mkseq /= ltnNge leq_addr addKn.
Qed.

Lemma mat_windowed b q Ts i (j : 'I_(size Ts * q)) :
  mat b (size Ts * q) (windowed b q Ts) i j = mat b q (nth [::] Ts (j %/ q)) i (Ordinal (output_lt j)).
Proof.
rewrite !mxE nth_mkseq // place_in_line ?size_map // (nth_map [::]) //; exact: sample_lt.
Qed.

Lemma mat_transposed q b T : mat q b (transposed q T) = (mat b q T)^T.
Proof.
apply/matrixP => i j; rewrite !mxE nth_mkseq //; have [jT|Tj] := ltnP j (size T).
  by rewrite {1}/at_place (nth_map [::]).
by rewrite {1}/at_place nth_default ?size_map // [nth _ T j]nth_default // (place_nil meaning) (value_zero meaning).
Qed.

Lemma mat_rows a e q T : mat (a + e) q T = col_mx (mat a q (take a T)) (mat e q (drop a T)).
Proof.
apply/matrixP => i j; case: (split_ordP i) => k ->; first by rewrite col_mxEu !mxE nth_take.
by rewrite col_mxEd !mxE nth_drop.
Qed.

Lemma mat_cat a e q T T' : size T = a -> mat (a + e) q (T ++ T') = col_mx (mat a q T) (mat e q T').
Proof. by move=> sT; rewrite mat_rows take_size_cat // drop_size_cat. Qed.

Lemma mat_weighted a e q (P T : table) : size P = a -> size T = (a + e)%N ->
  mat (a + e) q (weighted_by a P T) = block_mx (mat a a P) 0 0 1%:M *m mat (a + e) q T.
Proof.
move=> sP sT; rewrite mat_cat ?size_map // (@mat_product a a q); last by rewrite size_takel // sT leq_addr.
by rewrite [mat (a + e) q T]mat_rows mul_block_col !mul0mx mul1mx addr0 add0r.
Qed.

Lemma mat_covariances a e q q' (P T T' : table) : size P = a -> size T' = (a + e)%N ->
  mat q q' (covariances a P q T T') = (mat (a + e) q T)^T *m block_mx (mat a a P) 0 0 1%:M *m mat (a + e) q' T'.
Proof.
move=> sP sT'; rewrite (@mat_product q (a + e) q') ?mat_transposed ?(mat_weighted _ sP sT') ?mulmxA //.
by rewrite size_cat size_map sP size_drop sT' addKn.
Qed.

(** A table at basic signals. *)
Lemma mat_basic N b (X : 'M[K]_(N, b)) o q (le : (o + q <= b)%N) :
  X *m mat b q (basic R b o q) = colsub (fun j => widen_ord le (rshift o j)) X.
Proof.
apply/matrixP => r j; rewrite mxE [RHS]mxE (bigD1 (widen_ord le (rshift o j))) //= big1 => [|i ij].
  by rewrite addr0 mat_entry /basic nth_mkseq ?ltn_ord // /at_place nth_mkseq //= eqxx (value_one meaning) mulr1.
rewrite mat_entry /basic nth_mkseq // /at_place nth_mkseq // ifF ?(value_zero meaning) ?mulr0 //.
by apply: contraNF ij => /eqP ij; apply/eqP/val_inj.
Qed.

(** The process, where every signal is X times its coefficients. *)
Section Following.
Variables (n m p nu c N b : nat) (E : experiment_list R) (X : 'M[K]_(N, b)).
Let h := (nu + (m + p))%N.
Let E' := experiment_of value n m p nu c E.
Let l := size (tback E).
Hypothesis sizes : sized_experiment n m p nu c E.
Notation rep q T M := (X *m mat b q T = M).

Lemma rep_product q q' T T' M : (size T' <= q)%N -> rep q T M -> rep q' (table_product T T') (M *m mat q q' T').
Proof. by move=> sT' <-; rewrite (@mat_product b q q') ?mulmxA. Qed.

Lemma rep_plus q T T' M M' : rep q T M -> rep q T' M' -> rep q (plus_tables b T T') (M + M').
Proof. by move=> <- <-; rewrite mat_plus mulmxDr. Qed.

Lemma rep_columns o q w T M (le : (o + q <= w)%N) : rep w T M -> rep q (columns o q T) (colsub (fun j => widen_ord le (rshift o j)) M).
Proof. by move=> <-; rewrite (@mat_columns b o q w T le); apply/matrixP => i j; rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE. Qed.

Lemma input_columns (f : 'M[K]_(N, h)) T : rep h T f -> rep nu (columns 0 nu T) (input_of f).
Proof.
have le : (0 + nu <= h)%N by rewrite leq_addr.
move/(rep_columns le) ->; apply/matrixP => i j; rewrite !mxE; congr (f i _); exact: val_inj.
Qed.

Lemma fault_columns (f : 'M[K]_(N, h)) T : rep h T f -> rep m (columns nu m T) (fault_of f).
Proof.
have le : (nu + m <= h)%N by rewrite leq_add2l leq_addr.
move/(rep_columns le) ->; apply/matrixP => i j; rewrite !mxE; congr (f i _); exact: val_inj.
Qed.

Lemma noise_columns (f : 'M[K]_(N, h)) T : rep h T f -> rep p (columns (nu + m) p T) (noise_of f).
Proof.
have le : (nu + m + p <= h)%N by rewrite /h addnA.
move/(rep_columns le) ->; apply/matrixP => i j; rewrite !mxE; congr (f i _); apply: val_inj; exact: esym (addnA _ _ _).
Qed.

(** Tables of the states at one time. *)
Definition holds (xs : table * seq table) (x : 'M[K]_(N, n)) (s : nat -> 'M[K]_(N, h)) :=
  rep n xs.1 x /\ forall i, (i <= l)%N -> rep h (nth [::] xs.2 i) (s i).

Lemma forward_size i : (size (nth [::] (tforward E) i) <= c)%N.
Proof.
case/and5P: sizes => _ _ _ + _ => /allP fits; have [lt|ge] := ltnP i (size (tforward E)); last by rewrite nth_default.
by apply: fits; apply: mem_nth.
Qed.

Lemma back_size i : (size (nth [::] (tback E) i) <= h)%N.
Proof.
case/and5P: sizes => _ _ _ _ /allP fits; have [lt|ge] := ltnP i (size (tback E)); last by rewrite nth_default.
by apply: fits; apply: mem_nth.
Qed.

Lemma driving_holds xs x s e T : holds xs x s -> rep c T e -> rep h (driving_table b E T xs.2) (driving E' e s).
Proof. by case=> _ /(_ 0%N (leq0n _)) s0 eT; apply: rep_plus s0 _; apply: rep_product (forward_size 0) eT. Qed.

Lemma next_holds xs x s e T x' s' : holds xs x s -> rep c T e -> follow E' e x s x' s' -> s' l = 0 ->
  holds (next_states m nu b E T xs) x' s'.
Proof.
move=> now eT [s_l ex' es'] s'_l; have f := driving_holds now eT; case: (now) => ex es.
case/and5P: (sizes) => /and4P[/andP[/eqP sA _] /andP[/eqP sF _] _ _] sB sD _ _; split.
  rewrite ex'; apply: rep_plus; first apply: rep_plus.
  - by apply: rep_product ex; rewrite sA.
  - by apply: rep_product (input_columns f).
  - by apply: rep_product (fault_columns f); rewrite sF.
move=> i; rewrite leq_eqVlt => /orP[/eqP ->|il].
  rewrite nth_default ?size_map ?size_iota // s'_l (_ : mat b h [::] = 0) ?mulmx0 //.
  by apply/matrixP => r j; rewrite mat_entry nth_nil (place_nil meaning) mxE.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n es' //; apply: rep_plus.
  by apply: rep_plus; [apply: es|apply: rep_product (forward_size _) eT].
by rewrite mat_minus mulmxN (@rep_product h h _ _ _ (back_size i) f).
Qed.

Lemma channels_hold xs x s e T : holds xs x s -> rep c T e ->
  rep nu (channels m nu b E p T xs).1 (input_of (driving E' e s)) /\ rep p (channels m nu b E p T xs).2 (output_of E' e x s).
Proof.
move=> now eT; have f := driving_holds now eT; case: (now) => ex es.
case/and5P: (sizes) => /and4P[_ _ /andP[/eqP sC _] /andP[/eqP sG _]] sB sD _ _; split; first exact: input_columns f.
apply: rep_plus (noise_columns f); apply: rep_plus; first apply: rep_plus.
- by apply: rep_product ex; rewrite sC.
- by apply: rep_product (input_columns f).
by apply: rep_product (fault_columns f); rewrite sG.
Qed.

Lemma recorded_hold (es : seq table) (xs : table * seq table) (e : nat -> 'M[K]_(N, c)) (x : nat -> 'M[K]_(N, n)) s t :
  holds xs (x t) (s t) -> (forall k, (k < size es)%N -> rep c (nth [::] es k) (e (t + k)%N)) ->
  (forall k, follow E' (e k) (x k) (s k) (x k.+1) (s k.+1)) -> forall k, (k < size es)%N ->
  rep nu (nth ([::], [::]) (recorded_channels m nu b E p xs es) k).1 (input_of (driving E' (e (t + k)%N) (s (t + k)%N))) /\
  rep p (nth ([::], [::]) (recorded_channels m nu b E p xs es) k).2 (output_of E' (e (t + k)%N) (x (t + k)%N) (s (t + k)%N)).
Proof.
move=> now noise steps; elim: es xs t now noise => // T es IH xs t now noise [|k] /=.
  by rewrite addn0 => _; apply: channels_hold now _; have := noise 0%N (ltn0Sn _); rewrite addn0.
rewrite ltnS => lt; rewrite -addSnnS; apply: IH => // [|j js]; last by rewrite addSnnS; apply: (noise j.+1).
have := noise 0%N (ltn0Sn _); rewrite addn0 => eT; apply: next_holds now eT (steps t) _; by case: (steps t.+1).
Qed.

Lemma recorded_size xs es : size (recorded_channels m nu b E p xs es) = size es.
Proof. by elim: es xs => //= e es IH xs; rewrite IH. Qed.

(** A window of samples. *)
Lemma windowed_holds q (Ts : seq table) t w (r : nat -> 'M[K]_(N, q)) : size Ts = w ->
  (forall k, (k < w)%N -> rep q (nth [::] Ts k) (r (t + k)%N)) -> rep (w * q) (windowed b q Ts) (future t w r).
Proof.
move=> <- holding; apply/matrixP => i j; rewrite future_entry -(holding _ (sample_lt j)) !mxE.
by apply: eq_bigr => k _; rewrite mat_windowed.
Qed.

Lemma beside_holds q q' T T' M M' : rep q T M -> rep q' T' M' -> rep (q + q') (beside b q T T') (row_mx M M').
Proof. by move=> <- <-; rewrite mat_beside mul_mx_row. Qed.

Lemma joint_holds xs x s : holds xs x s -> size xs.2 = l -> rep (n + l * h) (joint_states b n h xs) (row_mx x (future 0 l s)).
Proof. by case=> ex es sl; apply: beside_holds ex _; apply: windowed_holds sl _ => k /ltnW; apply: es. Qed.
End Following.
End Meaning.
