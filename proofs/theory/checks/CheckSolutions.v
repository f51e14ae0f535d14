(** The solutions (f, g) of problem (11) for a concrete system over the rational numbers, at one window or at all windows beyond the
    degrees of the kernel rows: where the rows are all there are, they are the common zeros of the demands of these rows, and a basis is
    right once it vanishes on the demands and has as many vectors as their rank leaves.

          unit_fault k == the signal of one fault that is 1 at time 0, and 0 afterwards
    check_first_column == the demands at time 0 accept the column (f, g), and some other one does not *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  ssrint rat matrix mxalgebra fraction.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Basics Windows.
From faultspace Require Import CertificatesVocabulary Lists KernelRows ListedSystems TableRank.
From faultspace Require Import CheckRows CheckRanks.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The column z = (f, g), integers over d: the demands at time 0 accept it, some other one does not. *)
Definition unit_fault (K : fieldType) k : 'rV[K]_1 := if k is 0%N then 1%:M else 0.
Definition check_first_column n m p s l (L : listed) rows lower (d : Z) (f g : vector) : bool :=
  let z := joined n (f, g) in
  [&& meets n m p s l L rows lower, shorter s (kept s rows lower), d != Z0, size z == (n + p)%N,
    all (fun row => dot z (joined n (head ([::], [::]) (demands L row.2).2)) == Z0) (kept s rows lower)
    & has (fun dem => dot z dem != Z0) (all_demands n L (kept s rows lower))].

Section Sound.
Variables (n m p : nat) (L : listed).
Let S := meant n m p L.

Lemma column_joined d : column (n + p) (joined n d) = col_mx (column n d.1) (column p d.2).
Proof.
apply/colP => i; rewrite !mxE; case: (split_ordP i) => j ->; rewrite !mxE /entry /joined nth_cat size_mkseq /=.
  by rewrite ltn_ord nth_mkseq.
by rewrite ltnNge leq_addr addKn.
Qed.

(** Solutions are the zeros of the demands. *)
Lemma responses_satisfy rows s (f : 'rV[rat]_n) (g : 'rV[rat]_p) : well_formed n m p L ->
  annihilates (meant_rows p rows) S -> shorter s rows ->
  (forall v, satisfies (meant_rows p rows) s (output (with_faults S f g) 0 v)) <->
  (forall d, d \in all_demands n L rows -> row_mx f g *m column (n + p) d = 0).
Proof.
move=> wf ann /allP short; set Z := with_faults S f g; have e0 := den_neq0 wf.
have vanish row : row \in rows -> (forall v, relation (columns p row.2) (output Z 0 v) = 0) <->
    (forall d, d \in (demands L row.2).2 -> f *m column n d.1 + g *m column p d.2 = 0).
  move=> row_in; set cw := (weighted (den L) row.2).2.
  have scale v : relation (columns p cw) (output (scaled (ratn (den L)) Z) 0 v) = 0 <->
      relation (columns p row.2) (output Z 0 (fun j => ratn (den L) ^- j *: v j)) = 0.
    rewrite (relation_scaled wf); split=> [/eqP|->]; last by rewrite scaler0.
    by rewrite scaler_eq0 expf_eq0 (negPf e0) andbF => /eqP.
  have action k : (k < size cw)%N -> fault_action (scaled (ratn (den L)) Z) (columns p cw) k =
      ratn (den L) *: (let d := nth ([::], [::]) (horner L cw).2 k in f *m column n d.1 + g *m column p d.2).
    by move=> kc; rewrite (demand_meaning wf (Z := scaled (ratn (den L)) Z) erefl erefl kc) /= -!scalemxAl -scalerDr.
  transitivity (forall k, (k < size (columns p cw))%N -> fault_action (scaled (ratn (den L)) Z) (columns p cw) k = 0).
    rewrite -vanishes_from_rest; split=> [h v|h v]; first by apply/scale/h.
    have /scale := h (fun j => ratn (den L) ^+ j *: v j) => <-; apply: eq_bigr => k _; congr (_ *m _).
    by apply: output_ext => j _; rewrite scalerA mulVf ?scale1r ?expf_neq0.
  rewrite size_map; split=> [h d /(nthP ([::], [::]))[k]|h k kc].
    rewrite horner_size => kc <-; have /eqP := h k kc; rewrite action // scaler_eq0 (negPf e0); exact: eqP.
  by rewrite action // [X in _ *: X]h ?scaler0 //; apply: mem_nth; rewrite horner_size.
split=> [h d /flattenP[ds /mapP[row row_in ->] /mapP[d0 d0_in ->]]|h v c j /mapP[row row_in ->] size_c].
  rewrite column_joined mul_row_col; apply: (vanish row row_in).1 d0_in => v.
  rewrite -[RHS](h v (columns p row.2) 0%N) ?add0n ?size_map ?short //; exact: map_f.
apply: (@vanishes_later _ _ _ _ _ S Z) => // [x w|]; first by apply: ann; apply: map_f.
apply/vanishes_from_rest; apply/(vanish row row_in) => d d_in; rewrite -mul_row_col -column_joined; apply: h.
by apply/flattenP; exists (map (joined n) (demands L row.2).2); apply: map_f.
Qed.

Theorem zeros_of_demands rows l d basis pivots combinations (z : 'rV[rat]_(n + p)) :
  solution_space n p L rows l d basis pivots combinations ->
  (forall dem, dem \in all_demands n L rows -> z *m column (n + p) dem = 0) <-> (z <= fraction d (size basis) (n + p) basis)%MS.
Proof.
rewrite /solution_space; set table := all_demands _ _ _; set w := (n + p)%N; set B := fraction _ _ _ _.
case/and5P=> /and5P[d0 /allP wide /eqP sp _ /andP[/allP pw /allP echelon]] /allP vanish /eqP sizes /allP cw /andP[_ one].
have rd0 : ratn d != 0 by rewrite number_eq0.
pose D : 'M[rat]_(w, size table) := (mat ratF (size table) w table)^T.
have zD a (Y : 'M[rat]_(a, w)) : Y *m D = 0 <-> (forall dem, dem \in table -> Y *m column w dem = 0).
  have eD i (j : 'I_(size table)) : (Y *m D) i j = (Y *m column w (nth [::] table j)) i 0.
    by rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE.
  split=> [h dem /(nthP [::])[j jt <-]|h]; apply/matrixP => i j'; last by rewrite eD h ?mem_nth // !mxE.
  by rewrite ord1 -(eD i (Ordinal jt)) h !mxE.
have BD : B *m D = 0.
  apply/zD => dem dem_in; have -> : B = (ratn d)^-1 *: mat ratF (size basis) w basis by apply/matrixP => i j; rewrite !mxE mulrC.
  rewrite -scalemxAl (_ : _ *m _ = 0) ?scaler0 //; apply/row_matrixP => i; rewrite row_mul rowK row0.
  have b_in : nth [::] basis i \in basis by apply: mem_nth.
  rewrite number_dot ?(eqP (wide _ b_in)) // (eqP (allP (vanish _ b_in) _ dem_in)).
  by rewrite [ratn _](rmorph0 (number_rmorphism _)) raddf0.
have rank_B : \rank B = size basis.
  apply/eqP; rewrite eqn_leq rank_leq_row /=.
  have pivot_w (i : 'I_(size basis)) : (nth 0%N pivots i < w)%N by apply: pw; apply: mem_nth; rewrite sp.
  pose P : 'M[rat]_(w, size basis) := \matrix_(j, i) (j == nth 0%N pivots i :> nat)%:R.
  rewrite -[X in (X <= _)%N](mxrank1 ratF) (_ : 1%:M = B *m P) ?mxrankM_maxl //; apply/matrixP => a i.
  rewrite !mxE (bigD1 (Ordinal (pivot_w i))) //= big1 => [|j ji]; last first.
    by rewrite !mxE (_ : (_ == _) = false) ?mulr0 //; apply: contraNF ji => /eqP ji; apply/eqP/val_inj.
  have mem (k : 'I_(size basis)) : nat_of_ord k \in iota 0 (size basis) by rewrite mem_iota /=.
  have /andP[_ /allP/(_ _ (mem a))/eqP] := echelon _ (mem i); rewrite !mxE /= eqxx addr0 mulr1 => ->.
  by rewrite -val_eqE /=; case: (val a == val i); rewrite ?divff // [ratn _](rmorph0 (number_rmorphism _)) mul0r.
have rank_D : (size combinations <= \rank D)%N by rewrite mxrank_tr; apply: rank_by_combinations one; apply/allP.
have kernel_B : (kermx D <= B)%MS.
  have sub : (B <= kermx D)%MS by apply/sub_kermxP.
  rewrite -(mxrank_leqif_sup sub) eqn_leq mxrankS //= rank_B mxrank_ker; move: sizes rank_D; lia.
rewrite -(zD _ z); split=> [zero|/submxP[u ->]]; first by apply: submx_trans kernel_B; apply/sub_kermxP.
by rewrite -mulmxA BD mulmx0.
Qed.

(** Rows that are longer than the window say nothing about it. *)
Lemma kept_rows s l rows lower : meets n m p s l L rows lower -> annihilates (meant_rows p (kept s rows lower)) S /\
  forall r, word S s r <-> satisfies (meant_rows p (kept s rows lower)) s r.
Proof.
move=> /meets_sound[_ ind ann e]; have whole r := word_iff_satisfies ind ann r e; case: lower => //= _; split=> [c x v|r].
  by case/mapP=> row; rewrite mem_filter => /andP[_ row_in] ->; apply/ann/map_f.
rewrite whole; split=> h c j; first by case/mapP=> row; rewrite mem_filter => /andP[_ row_in] ->; apply/h/map_f.
move=> c_in js; apply: h (js); case/mapP: c_in js => row row_in -> js; apply: map_f; rewrite mem_filter row_in andbT.
by apply: leq_trans js; rewrite size_map leq_addl.
Qed.

(** `fault-space`: at one window, and beyond all degrees. *)
Theorem solutions_sound s l rows lower d basis pivots combinations : check_solutions n m p s l L rows lower d basis pivots combinations ->
  spans_solutions S s (fraction d (size basis) (n + p) basis).
Proof.
case/and3P=> ok short space f g; have [wf _ _ _] := meets_sound ok; have [ann whole] := kept_rows ok.
rewrite -(zeros_of_demands _ space) -(responses_satisfy _ _ wf ann short) solvesP.
by split=> h v; have := h v; rewrite whole.
Qed.

Theorem limit_sound beyond l rows lower d basis pivots combinations : check_limit n m p beyond l L rows lower d basis pivots combinations ->
  forall s, (beyond < s)%N -> spans_solutions S s (fraction d (size basis) (n + p) basis).
Proof.
case/and3P=> /meets_sound[wf ind ann e] /allP short space s beyond_s f g.
have short_s : shorter s rows by apply/allP => row /short h; apply: leq_trans h beyond_s.
rewrite -(zeros_of_demands _ space) -(responses_satisfy _ _ wf ann short_s) solvesP.
by split=> h v; have := h v; rewrite (word_iff_satisfies ind ann _ (meets_for_ever ind ann s e)).
Qed.

(** `first-column-only`. *)
Lemma impulse_satisfies rows s (f : 'rV[rat]_n) (g : 'rV[rat]_p) : well_formed n m p L -> annihilates (meant_rows p rows) S ->
  (forall row, row \in rows -> (0 < size row.2)%N ->
    f *m column n (head ([::], [::]) (demands L row.2).2).1 + g *m column p (head ([::], [::]) (demands L row.2).2).2 = 0) ->
  satisfies (meant_rows p rows) s (output (with_faults S f g) 0 (unit_fault _)).
Proof.
move=> wf ann h c [|j] c_in _; last first.
  rewrite (_ : relation c _ = relation c (output S (state (with_faults S f g) 0 (unit_fault _) j.+1) (fun=> 0))); first exact: ann.
  by apply: eq_bigr => k _; rewrite output_shift -(output_free S f g); congr (_ *m _); apply: output_ext.
case/mapP: c_in => row row_in ->; have e0 := den_neq0 wf; set cw := (weighted (den L) row.2).2; set Z := with_faults S f g.
have scw : size cw = size row.2 := weighted_size L row.2.
have same : relation (columns p row.2) (fun k => output Z 0 (unit_fault _) (0 + k)) =
    relation (columns p row.2) (output Z 0 (fun j => ratn (den L) ^- j *: unit_fault _ j)).
  by apply: eq_bigr => k _; congr (_ *m _); apply: output_ext => -[|i] _ /=; rewrite ?expr0 ?invr1 ?scale1r ?scaler0.
apply/eqP; rewrite same -(inj_eq (scalerI (expf_neq0 (size row.2) e0))) -(relation_scaled wf) -/cw scaler0 relation_horner mul0mx add0r.
rewrite size_map scw; case: (posnP (size row.2)) => [->|nonempty]; first by rewrite big_ord0.
rewrite (bigD1 (Ordinal nonempty)) //= big1 => [|[[|k] lt] //]; last by rewrite mul0mx.
rewrite mul1mx addr0 (demand_meaning wf (Z := scaled (ratn (den L)) Z) erefl erefl) ?scw // nth0 -!scalemxAl -scalerDr.
by rewrite (h row row_in nonempty) scaler0.
Qed.

Theorem first_column_sound s l rows lower d f g : check_first_column n m p s l L rows lower d f g ->
  let Z := with_faults S (recorded d n f) (recorded d p g) in
  word S s (output Z 0 (unit_fault _)) /\ ~ solves S s (recorded d n f) (recorded d p g).
Proof.
case/and5P=> ok short d0 /eqP sz /andP[/allP first /hasP[dem dem_in seen]] /=.
have [wf _ _ _] := meets_sound ok; have [ann whole] := kept_rows ok.
set z := joined n (f, g) in sz first seen.
have z_meaning : row_mx (recorded d n f) (recorded d p g) = (ratn d)^-1 *: vec ratF (n + p) z.
  by rewrite -scale_row_mx; congr (_ *: _); apply: trmx_inj; rewrite tr_row_mx -/(column (n + p) z) column_joined.
have dot_z dem' : row_mx (recorded d n f) (recorded d p g) *m column (n + p) dem' = (ratn d)^-1 *: (ratn (dot z dem'))%:M.
  by rewrite z_meaning -scalemxAl number_dot // sz.
split.
  apply/whole/impulse_satisfies => // row row_in _; rewrite -mul_row_col -column_joined dot_z.
  by rewrite (eqP (first _ row_in)) [ratn Z0](rmorph0 (number_rmorphism _)) raddf0 scaler0.
move=> /solvesP h; have zeros := (responses_satisfy _ _ wf ann short).1 (fun v => (whole _).1 (h v)).
have := zeros _ dem_in; rewrite dot_z => /matrixP/(_ 0 0)/eqP; rewrite !mxE eqxx mulr1n mulf_eq0 invr_eq0 !number_eq0.
by rewrite (negPf d0) (negPf seen).
Qed.

End Sound.
