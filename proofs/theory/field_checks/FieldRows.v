(** Kernel rows and words of a system told by lists of numbers: where as many words are independent as the rows allow, the words of the
    system are just what satisfies the rows.

     column_of k u == the list u as a column
    columns_of p c == a list of such lists as a list of columns
    rows_of p rows == the kernel rows as lists of columns *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Stacks NumbersVocabulary NumberLists KernelRows ListedSystems CheckRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Meaning.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation vec := (vector_of value).
Notation mat := (matrix_of value).
Notation table := (seq (seq (numeral R))).
Notation kernel_rows := (seq (nat * table)).
Definition column_of k (u : seq (numeral R)) : 'cV[K]_k := (vec k u)^T.
Definition columns_of p (c : table) : seq 'cV[K]_p := map (column_of p) c.
Definition rows_of p (rows : kernel_rows) : seq (seq 'cV[K]_p) := [seq columns_of p row.2 | row <- rows].

Lemma last_columns_of p c : last 0 (columns_of p c) = column_of p (last [::] c).
Proof. by rewrite -(last_map (column_of p)) /column_of (vec_nil meaning) trmx0. Qed.

Lemma outputs_size L x vs : size (@outputs R L x vs) = size vs.
Proof. by elim: vs x => //= v vs IH x; rewrite IH. Qed.

Lemma trajectory_size L x vs : size (@trajectory R L x vs) = (size vs).+1.
Proof. by elim: vs x => //= v vs IH x; rewrite IH. Qed.

Section OneSystem.
Variables (n m p : nat) (L : listing R) (wf : sized n m p L).
Let S := system_of value n m p L.

Lemma outputs_output x vs k : (k < size vs)%N ->
  vec p (nth [::] (outputs L x vs) k) = output S (vec n x) (signal_of value m vs) k.
Proof.
case/and4P: wf => /andP[/eqP sA _] /andP[/eqP sF _] /andP[/eqP sC _] /andP[/eqP sG _].
elim: vs x k => // v vs IH x [|k] kv.
  by rewrite /= (vec_sum meaning) (vec_row_times meaning _ _ (_ : (_ <= n)%N)) ?sC // (vec_row_times meaning _ _ (_ : (_ <= m)%N)) ?sG.
rewrite output_step [LHS]IH // (vec_sum meaning) (vec_row_times meaning _ _ (_ : (_ <= n)%N)) ?sA //.
by rewrite (vec_row_times meaning _ _ (_ : (_ <= m)%N)) ?sF.
Qed.

Lemma trajectory_state x vs k : (k <= size vs)%N ->
  vec n (nth [::] (trajectory L x vs) k) = state S (vec n x) (signal_of value m vs) k.
Proof.
case/and4P: wf => /andP[/eqP sA _] /andP[/eqP sF _] _ _.
elim: vs x k => [|v vs IH] x [|k] kv //; rewrite state_step [LHS]IH // (vec_sum meaning).
by rewrite (vec_row_times meaning _ _ (_ : (_ <= n)%N)) ?sA // (vec_row_times meaning _ _ (_ : (_ <= m)%N)) ?sF.
Qed.

Lemma costates_meaning c : column_of n (costates L c).1 = horner_state (sysA S) (sysC S) (columns_of p c).
Proof.
case/and4P: wf => /andP[_ rA] _ /andP[_ rC] _.
elim: c => [|c0 c /=]; first by rewrite /column_of (vec_nil meaning) trmx0.
case: (costates L c) => X ds /= IH; rewrite /column_of (vec_sum meaning) linearD /= (vec_times_column meaning _ _ rC).
by rewrite (vec_times_column meaning _ _ rA) -/(column_of n X) IH.
Qed.

Lemma costates_size c : size (costates L c).2 = size c.
Proof. by elim: c => //= c0 c; case: (costates L c) => X ds /= ->. Qed.

Lemma costates_nth c k : (k < size c)%N -> nth ([::], [::]) (costates L c).2 k = ((costates L (drop k.+1 c)).1, nth [::] c k).
Proof.
elim: c k => //= c0 c IH k; case e1: (costates L c) IH => [X ds] /= IH; case: k => [|k] kc /=; first by rewrite drop0 e1.
exact: IH.
Qed.

Lemma condition_meaning m' (Z : system K n m' p) c k : sysA Z = sysA S -> sysC Z = sysC S -> (k < size c)%N ->
  let d := nth ([::], [::]) (costates L c).2 k in fault_action Z (columns_of p c) k = sysF Z *m column_of n d.1 + sysG Z *m column_of p d.2.
Proof.
move=> eA eC kc; rewrite /= costates_nth //= costates_meaning /fault_action eA eC /columns_of map_drop; congr (_ + _ *m _).
by rewrite (nth_map [::]).
Qed.

Lemma effect_meaning d : column_of m (effect (tF L) (tG L) d) = sysF S *m column_of n d.1 + sysG S *m column_of p d.2.
Proof.
case/and4P: wf => _ /andP[_ rF] _ /andP[_ rG].
by rewrite /column_of /effect (vec_sum meaning) linearD /= (vec_times_column meaning _ _ rF) (vec_times_column meaning _ _ rG).
Qed.

Theorem annihilating_sound c : annihilating L c -> forall x v, relation (columns_of p c) (output S x v) = 0.
Proof.
rewrite /annihilating; case e: (costates L c) => [X ds] /andP[X0 /allP ds0] x v.
rewrite relation_horner -costates_meaning e /column_of (vec_blank meaning) // trmx0 mulmx0 add0r.
rewrite big1 // => k _; have kc : (k < size c)%N by rewrite -(size_map (column_of p)).
rewrite (condition_meaning erefl erefl kc) e -effect_meaning /column_of (vec_blank meaning) ?trmx0 ?mulmx0 //.
by apply: ds0; apply: mem_nth; have := costates_size c; rewrite e /= => ->.
Qed.

Theorem rows_annihilating rows : all (fun row => annihilating L row.2) rows -> annihilates (rows_of p rows) S.
Proof. by move=> /allP h c x v /mapP[row /h ann ->]; apply: annihilating_sound. Qed.

Theorem possible_rank s ws : possible p s L ws -> (size ws <= \rank (window S s))%N.
Proof.
pose w0 : seq (numeral R) * table * (nat * nat) := (([::], [::]), (0%N, 0%N)).
case/andP=> /(all_nthP w0) shapes one.
pose x i := vec n (nth w0 ws i).1.1; pose v i := signal_of value m (nth w0 ws i).1.2.
pose r k : 'M[K]_(size ws, p) := \matrix_(i < size ws) output S (x i) (v i) k.
have sub : (stack s r <= window S s)%MS.
  apply/row_subP => i; rewrite rowK windowP; exists (x i), (v i) => k _; exact: rowK.
apply: leq_trans (mxrankS sub); rewrite row_free_stack // => B h.
pose T : table := [seq outputs_at [seq other.2 | other <- ws] (outputs L w.1.1 w.1.2) | w <- ws].
pose Q : 'M[K]_(size ws) := \matrix_(i, j) value (at_place (nth [::] T i) j).
have unit_Q : Q \in unitmx by apply: (diagonal_unit meaning one) => [|i j]; rewrite ?size_map // mxE.
suff BQ : B *m Q = 0 by rewrite -(mulmxK unit_Q B) BQ mul0mx.
apply/rowP => j; have /and3P[_ ks lp] := shapes _ (ltn_ord j); have := h _ ks; set k := (nth w0 ws j).2.1 in ks *.
move=> zero; transitivity ((B *m r k) 0 (Ordinal lp)); last by rewrite zero !mxE.
rewrite [LHS]mxE [RHS]mxE; apply: eq_bigr => i _; congr (_ * _).
have /and3P[/eqP sv _ _] := shapes _ (ltn_ord i).
rewrite [r k _ _]mxE [Q _ _]mxE (nth_map w0) // /outputs_at {1}/at_place (nth_map (0%N, 0%N)) ?size_map // (nth_map w0) //.
transitivity (vec p (nth [::] (outputs L (nth w0 ws i).1.1 (nth w0 ws i).1.2) k) 0 (Ordinal lp)); first by rewrite mxE.
by rewrite outputs_output ?sv.
Qed.

End OneSystem.

(** Rows that ascend, with independent leading coefficients. *)
Lemma leading_unit rows Q : leading_independent rows Q -> mat (size rows) (size rows) (leading_at rows) \in unitmx.
Proof.
have sl : size (leading_at rows) = size rows by apply: size_map.
case: Q => [Q /andP[/eqP sQ one]|tri]; last by apply: (triangular_unit meaning tri) => // i j; rewrite mxE.
suff : mat (size rows) (size rows) Q *m mat (size rows) (size rows) (leading_at rows) \in unitmx.
  by rewrite unitmx_mul => /andP[].
apply: (diagonal_unit meaning one); first by rewrite size_map sQ.
move=> i j; rewrite (nth_map [::]) ?sQ //.
transitivity (vec (size rows) (row_times (nth [::] Q i) (leading_at rows)) 0 j); last by rewrite mxE.
rewrite (vec_row_times meaning _ _ (_ : (_ <= size rows)%N)) ?sl // -row_mat -row_mul; by rewrite [RHS]mxE.
Qed.

Lemma ascend_independent p rows : ascend p rows -> mat (size rows) (size rows) (leading_at rows) \in unitmx ->
  independent_leading (rows_of p rows).
Proof.
case/andP=> /allP shapes ascending unit_Q k; set Q := mat _ _ _ in unit_Q.
have inside row : row \in rows -> (row.1 < p)%N by move=> /shapes/andP[].
have takes := filter_sorted k.+1 ascending; set t := size [seq c <- rows | _] in takes.
have eA : active (rows_of p rows) k = rows_of p (take t rows).
  rewrite /active /rows_of filter_map -takes; congr map; apply: eq_filter => row /=; by rewrite size_map.
have tr : (t <= size rows)%N by rewrite /t size_filter count_size.
have st : size (active (rows_of p rows) k) = t by rewrite eA size_map size_takel.
apply/eqP; rewrite eqn_leq rank_leq_col /=.
pose row_number (b : nat) := nth (0%N, [::]) rows b.
pose P : 'M[K]_(size rows, p) := \matrix_(b, i) (i == (row_number b).1 :> nat)%:R.
pose E : 'M[K]_(size rows, size (active (rows_of p rows) k)) := \matrix_(b, a) (b == a :> nat)%:R.
have nth_lead a : (a < t)%N -> last 0 (nth [::] (active (rows_of p rows) k) a) = column_of p (last [::] (row_number a).2).
  by move=> a_t; rewrite eA (nth_map (0%N, [::])) ?last_columns_of ?nth_take // size_takel.
have eP : P *m leading_active (rows_of p rows) k = Q^T *m E.
  apply/matrixP => b a; have a_t : (a < t)%N by rewrite -st.
  have pb : ((row_number b).1 < p)%N by apply/inside/mem_nth.
  rewrite [LHS]mxE (bigD1 (Ordinal pb)) //= big1 => [|i ib]; last first.
    by rewrite [P _ _]mxE (_ : (_ == _) = false) ?mul0r //; apply: contraNF ib => /eqP ib; apply/eqP/val_inj.
  rewrite [P _ _]mxE eqxx mul1r addr0 mxE nth_lead //.
  rewrite [RHS]mxE (bigD1 (Ordinal (leq_trans a_t tr))) //= big1 => [|i ia]; last first.
    by rewrite [E _ _]mxE (_ : (_ == _) = false) ?mulr0 //; apply: contraNF ia => /eqP ia; apply/eqP/val_inj.
  rewrite [E _ _]mxE eqxx mulr1 addr0 !mxE (nth_map (0%N, [::])) ?(leq_trans a_t) // /places_at /at_place (nth_map 0%N) ?size_map //.
  by rewrite (nth_map (0%N, [::])).
have rank_E : \rank E = size (active (rows_of p rows) k).
  apply/eqP; rewrite eqn_leq rank_leq_col /= -[X in (X <= _)%N](mxrank1 K) (_ : 1%:M = E^T *m E) ?mxrankM_maxr //.
  apply/matrixP => a b; have a_in : (a < size rows)%N by apply: leq_trans tr; rewrite -st.
  rewrite [RHS]mxE (bigD1 (Ordinal a_in)) //= big1 => [|i ia]; last first.
    by rewrite !mxE (_ : (_ == _) = false) ?mul0r //; apply: contraNF ia => /eqP ia; apply/eqP/val_inj.
  by rewrite !mxE eqxx mul1r addr0.
rewrite -[X in (X <= _)%N]rank_E -(mulKmx (_ : Q^T \in unitmx) E) ?unitmx_tr // -eP.
by apply: leq_trans (mxrankM_maxr _ _) _; apply: mxrankM_maxr.
Qed.

(** In sum. *)
Lemma allowed_bound p rows s : allowed p rows s = bound (rows_of p rows) s.
Proof.
rewrite /allowed /bound sumnE big_map -{1}[s]subn0 big_mkord; apply: eq_bigr => k _; congr (_ - _)%N.
rewrite /active size_filter /rows_of count_map; apply: eq_count => row /=; by rewrite size_map.
Qed.

Section AllThereAre.
Variables (n m p s : nat) (L : listing R) (rows : kernel_rows) (Q : option table).
Variables (ws : seq ((seq (numeral R) * table) * (nat * nat))) (ok : all_there_are n m p s L rows Q ws).
Let S := system_of value n m p L.

Theorem all_there_are_sound : [/\ sized n m p L, independent_leading (rows_of p rows), annihilates (rows_of p rows) S
  & \rank (window S s) = bound (rows_of p rows) s].
Proof.
case/and5P: ok => wf asc lead ann /andP[/(possible_rank wf) low /eqP sizes].
have ind := ascend_independent asc (leading_unit lead); have annihilated := rows_annihilating wf ann; split=> //.
by apply/eqP; rewrite eqn_leq window_bound //= -allowed_bound -sizes.
Qed.

Lemma word_iff_rows r : word S s r <-> satisfies (rows_of p rows) s r.
Proof. by have [_ ind ann e] := all_there_are_sound; exact: (word_iff_satisfies ind ann r e). Qed.

Lemma nonempty_rows : all (fun row => 0 < size row.2)%N rows.
Proof. by case/and5P: ok => _ /andP[/allP h _] _ _ _; apply/allP => row /h/andP[]. Qed.

End AllThereAre.
End Meaning.
