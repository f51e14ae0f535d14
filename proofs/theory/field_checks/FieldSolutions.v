(** The solutions (f, g) of problem (11) for a system told by lists of numbers, at one window or at all windows beyond the degrees of the
    kernel rows: the common zeros of the conditions of these rows, of which a basis leaves no room for more.

    first_column_alone == the conditions at time 0 accept the column (f, g), and some other one does not *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Basics Windows.
From faultspace Require Import NumbersVocabulary NumberLists KernelRows ListedSystems CheckRanks CheckSolutions FieldRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The column (f, g): the conditions at time 0 accept it, some other one does not. *)
Definition first_column_alone (R : arithmetic) n m p s (L : listing R) rows Q ws (f g : seq (numeral R)) : bool :=
  let z := side_by_side n (f, g) in
  [&& all_there_are n m p s L rows Q ws, within s rows, size z == (n + p)%N,
    all (fun row => vanishes (inner z (side_by_side n (head ([::], [::]) (costates L row.2).2)))) rows
    & has (fun c => invertible (inner z c)) (conditions n L rows)].

Section Sound.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Variables (n m p : nat) (L : listing R).
Let S := system_of value n m p L.
Notation vec := (vector_of value).
Notation mat := (matrix_of value).
Notation column := (column_of value).

Lemma column_side_by_side d : column (n + p) (side_by_side n d) = col_mx (column n d.1) (column p d.2).
Proof.
apply/colP => i; rewrite !mxE; case: (split_ordP i) => j ->; rewrite !mxE /at_place /side_by_side nth_cat size_mkseq /=.
  by rewrite ltn_ord nth_mkseq.
by rewrite ltnNge leq_addr addKn.
Qed.

(** Solutions are the zeros of the conditions. *)
Lemma responses_by_conditions rows s (f : 'rV[K]_n) (g : 'rV[K]_p) : sized n m p L ->
  annihilates (rows_of value p rows) S -> within s rows ->
  (forall v, satisfies (rows_of value p rows) s (output (with_faults S f g) 0 v)) <->
  (forall d, d \in conditions n L rows -> row_mx f g *m column (n + p) d = 0).
Proof.
move=> wf ann /allP short; set Z := with_faults S f g.
have vanish row : row \in rows -> (forall v, relation (columns_of value p row.2) (output Z 0 v) = 0) <->
    (forall d, d \in (costates L row.2).2 -> f *m column n d.1 + g *m column p d.2 = 0).
  move=> row_in; rewrite vanishes_from_rest size_map; split=> [h d /(nthP ([::], [::]))[k]|h k kc].
    rewrite costates_size => kc <-; have := h k kc; rewrite (condition_meaning (Z := Z) meaning wf erefl erefl kc).
    exact.
  rewrite (condition_meaning (Z := Z) meaning wf erefl erefl kc); apply: h; apply: mem_nth.
  by rewrite costates_size.
split=> [h d /flattenP[ds /mapP[row row_in ->] /mapP[d0 d0_in ->]]|h v c j /mapP[row row_in ->] size_c].
  rewrite column_side_by_side mul_row_col; apply: (vanish row row_in).1 d0_in => v.
  rewrite -[RHS](h v (columns_of value p row.2) 0%N) ?add0n ?size_map ?short //; exact: map_f.
apply: (@vanishes_later _ _ _ _ _ S Z) => // [x w|]; first by apply: ann; apply: map_f.
apply/vanishes_from_rest; apply/(vanish row row_in) => d d_in; rewrite -mul_row_col -column_side_by_side; apply: h.
by apply/flattenP; exists (map (side_by_side n) (costates L row.2).2); apply: map_f.
Qed.

Theorem zeros_of_conditions rows basis pivots combinations (z : 'rV[K]_(n + p)) :
  solve_conditions n p L rows basis pivots combinations ->
  (forall c, c \in conditions n L rows -> z *m column (n + p) c = 0) <-> (z <= mat (size basis) (n + p) basis)%MS.
Proof.
rewrite /solve_conditions; set table := conditions _ _ _; set w := (n + p)%N; set B := mat _ _ _.
case/and5P=> /and5P[/allP wide /eqP sp _ /allP pw /allP echelon] /allP vanish /eqP sizes cw one.
pose D : 'M[K]_(w, size table) := (mat (size table) w table)^T.
have zD a (Y : 'M[K]_(a, w)) : Y *m D = 0 <-> (forall c, c \in table -> Y *m column w c = 0).
  have eD i (j : 'I_(size table)) : (Y *m D) i j = (Y *m column w (nth [::] table j)) i 0.
    by rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE.
  split=> [h c /(nthP [::])[j jt <-]|h]; apply/matrixP => i j'; last by rewrite eD h ?mem_nth // !mxE.
  by rewrite ord1 -(eD i (Ordinal jt)) h !mxE.
have BD : B *m D = 0.
  apply/zD => c c_in; apply/row_matrixP => i; rewrite row_mul (row_mat value) row0.
  have b_in : nth [::] basis i \in basis by apply: mem_nth.
  rewrite (inner_product meaning) ?(eqP (wide _ b_in)) // (value_vanishes meaning (allP (vanish _ b_in) _ c_in)).
  by rewrite raddf0.
have rank_B : \rank B = size basis.
  apply/eqP; rewrite eqn_leq rank_leq_row /=.
  have pivot_w (i : 'I_(size basis)) : (nth 0%N pivots i < w)%N by apply: pw; apply: mem_nth; rewrite sp.
  pose P : 'M[K]_(w, size basis) := \matrix_(j, i) (j == nth 0%N pivots i :> nat)%:R.
  rewrite -[X in (X <= _)%N](mxrank1 K) (_ : 1%:M = B *m P) ?mxrankM_maxl //; apply/matrixP => a i.
  rewrite !mxE (bigD1 (Ordinal (pivot_w i))) //= big1 => [|j ji]; last first.
    by rewrite !mxE (_ : (_ == _) = false) ?mulr0 //; apply: contraNF ji => /eqP ji; apply/eqP/val_inj.
  have mem (k : 'I_(size basis)) : nat_of_ord k \in iota 0 (size basis) by rewrite mem_iota /=.
  have /andP[_ /allP/(_ _ (mem a))] := echelon _ (mem i); rewrite !mxE /= eqxx addr0 mulr1 -val_eqE /=.
  by case: (val a == val i) => [/(value_is_one meaning)|/(value_vanishes meaning)].
have rank_D : (size combinations <= \rank D)%N by rewrite mxrank_tr; apply: (rank_of_combinations meaning) cw one.
have kernel_B : (kermx D <= B)%MS.
  have sub : (B <= kermx D)%MS by apply/sub_kermxP.
  rewrite -(mxrank_leqif_sup sub) eqn_leq mxrankS //= rank_B mxrank_ker; move: sizes rank_D; lia.
rewrite -(zD _ z); split=> [zero|/submxP[u ->]]; first by apply: submx_trans kernel_B; apply/sub_kermxP.
by rewrite -mulmxA BD mulmx0.
Qed.

Theorem are_solutions_sound s rows Q ws basis pivots combinations : are_solutions n m p s L rows Q ws basis pivots combinations ->
  spans_solutions S s (mat (size basis) (n + p) basis).
Proof.
case/and3P=> ok short space f g; have [wf _ ann _] := all_there_are_sound meaning ok.
rewrite -(zeros_of_conditions _ space) -(responses_by_conditions _ _ wf ann short) solvesP.
by split=> h v; have := h v; rewrite (word_iff_rows meaning ok).
Qed.

Theorem are_solutions_beyond_sound beyond rows Q ws basis pivots combinations :
  are_solutions_beyond n m p beyond L rows Q ws basis pivots combinations ->
  forall s, (beyond < s)%N -> spans_solutions S s (mat (size basis) (n + p) basis).
Proof.
case/and3P=> /(all_there_are_sound meaning)[wf ind ann e] /allP short space s beyond_s f g.
have short_s : within s rows by apply/allP => row /short h; apply: leq_trans h beyond_s.
rewrite -(zeros_of_conditions _ space) -(responses_by_conditions _ _ wf ann short_s) solvesP.
by split=> h v; have := h v; rewrite (word_iff_satisfies ind ann _ (meets_for_ever ind ann s e)).
Qed.

Lemma impulse_by_conditions rows s (f : 'rV[K]_n) (g : 'rV[K]_p) : sized n m p L -> annihilates (rows_of value p rows) S ->
  (forall row, row \in rows -> (0 < size row.2)%N ->
    f *m column n (head ([::], [::]) (costates L row.2).2).1 + g *m column p (head ([::], [::]) (costates L row.2).2).2 = 0) ->
  satisfies (rows_of value p rows) s (output (with_faults S f g) 0 (unit_fault _)).
Proof.
move=> wf ann h c [|j] c_in _; last first.
  rewrite (_ : relation c _ = relation c (output S (state (with_faults S f g) 0 (unit_fault _) j.+1) (fun=> 0))); first exact: ann.
  by apply: eq_bigr => k _; rewrite output_shift -(output_free S f g); congr (_ *m _); apply: output_ext.
case/mapP: c_in => row row_in ->; set Z := with_faults S f g.
rewrite (_ : relation _ _ = relation (columns_of value p row.2) (output Z 0 (unit_fault _))) //.
rewrite relation_horner mul0mx add0r size_map; case: (posnP (size row.2)) => [->|nonempty]; first by rewrite big_ord0.
rewrite (bigD1 (Ordinal nonempty)) //= big1 => [|[[|k] lt] //]; last by rewrite mul0mx.
by rewrite mul1mx addr0 (condition_meaning (Z := Z) meaning wf erefl erefl) // nth0 h.
Qed.

Theorem first_column_alone_sound s rows Q ws f g : first_column_alone n m p s L rows Q ws f g ->
  let Z := with_faults S (vec n f) (vec p g) in word S s (output Z 0 (unit_fault _)) /\ ~ solves S s (vec n f) (vec p g).
Proof.
case/and5P=> ok short /eqP sz /allP first /hasP[c c_in seen] /=.
have [wf _ ann _] := all_there_are_sound meaning ok.
set z := side_by_side n (f, g) in sz first seen.
have z_meaning : row_mx (vec n f) (vec p g) = vec (n + p) z.
  by apply: trmx_inj; rewrite tr_row_mx -/(column (n + p) z) column_side_by_side.
split.
  apply/(word_iff_rows meaning ok)/impulse_by_conditions => // row row_in _; rewrite -mul_row_col -column_side_by_side z_meaning.
  by rewrite (inner_product meaning) ?sz // (value_vanishes meaning (first _ row_in)) raddf0.
move=> /solvesP h; have zeros := (responses_by_conditions _ _ wf ann short).1 (fun v => (word_iff_rows meaning ok _).1 (h v)).
have := zeros _ c_in; rewrite z_meaning (inner_product meaning) ?sz // => /matrixP/(_ 0 0)/eqP.
by rewrite !mxE eqxx mulr1n (negPf (value_invertible meaning seen)).
Qed.

End Sound.
