(** B and D of the two regressions, with the true A and C, in the stationary process of an experiment told by lists of numbers. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop order zmodp ssralg finalg ssrnum
  matrix mxalgebra.
From faultspace Require Import Vocabulary NumbersVocabulary ExperimentsVocabulary NumberLists FieldRows CheckMatrices FieldMatrices Signals.
From faultspace Require Import Stability FieldProcesses FieldLimits Regression RegressionFit.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Tables.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).
Notation table := (seq (seq (numeral R))).

Lemma mat_nil a b : mat a b [::] = 0.
Proof. by apply/matrixP => i j; rewrite mat_entry nth_nil (place_nil meaning) mxE. Qed.

Lemma mat_blank a b : mat a b (nseq a (nseq b (zero R))) = 0.
Proof. by apply/matrixP => i j; rewrite mat_entry mxE /at_place nth_nseq ltn_ord nth_nseq ltn_ord (value_zero meaning). Qed.

Lemma mat_unit a b (i : 'I_a) (j : 'I_b) : mat a b (unit_table R a b i j) = delta_mx i j.
Proof.
apply/matrixP => k l; rewrite mat_entry mxE nth_mkseq // -!val_eqE /=; case: (k == i :> nat); last first.
  by rewrite /at_place nth_nseq ltn_ord (value_zero meaning).
by rewrite /at_place nth_mkseq //=; case: (l == j :> nat); rewrite ?(value_one meaning) ?(value_zero meaning).
Qed.

Lemma value_paired b (rest T : table) : all (fun r => size r <= b)%N T ->
  value (paired rest T) = \tr (mat (size T) b T *m (mat (size T) b rest)^T).
Proof.
move=> fits; transitivity (\sum_(i < size T) (vector_of value b (nth [::] T i) *m (vector_of value b (nth [::] rest i))^T) 0 0).
  elim: T rest fits => [|r T IH] [|c rest] /=; rewrite /paired ?big_ord0 ?(value_zero meaning) // => /andP[fit fits].
    by rewrite big1 // => i _; rewrite nth_nil (vec_nil meaning) trmx0 mulmx0 mxE.
  rewrite big_ord_recl /= (value_plus meaning) (inner_entry meaning) //; congr (_ + _); exact: IH.
by apply: eq_bigr => i _; rewrite -!row_mat !mxE; apply: eq_bigr => j _; rewrite !mxE.
Qed.

Variables (n m p nu s : nat) (L : listing R).
Hypothesis wf : sized n m p L.
Let S := system_of value n m p L.

Lemma forced_table B D : formed nu n B -> formed nu p D ->
  mat (s * nu) (s * p) (forced_rows nu p s (with_inputs L B D)) = T (with_faults S (mat nu n B) (mat nu p D)) s.
Proof.
move=> fB fD; have wf' : sized n nu p (with_inputs L B D) by case/and4P: wf => fA _ fC _; apply/and4P.
by apply/matrixP => i j; rewrite mat_entry (forced_places meaning _ _ wf') !position_val.
Qed.

Lemma free_table : mat n (s * p) (free_rows n p s L) = O S s.
Proof. by apply/matrixP => i j; rewrite mat_entry (free_places meaning _ _ wf) position_val. Qed.

Lemma forced_size B D : size (forced_rows nu p s (with_inputs L B D)) = (s * nu)%N.
Proof. by rewrite size_map size_iota. Qed.

Lemma forced_fits B D : all (fun r => size r <= s * p)%N (forced_rows nu p s (with_inputs L B D)).
Proof.
apply/allP => _ /mapP[i _ ->]; set us := outputs _ _ _; have -> : s = size us by rewrite outputs_size size_map size_iota.
by elim: us => //= r us IH; rewrite /in_line /= size_cat size_mkseq mulSn leq_add2l.
Qed.

(** What is orthogonal to units is orthogonal to every T_s. *)
Lemma orthogonal_to_all rest : orthogonal_to_units n p nu s L rest -> forall B D,
  \tr (T (with_faults S B D) s *m (mat (s * nu) (s * p) rest)^T) = 0.
Proof.
move=> /allP units; have traceless B D : formed nu n B -> formed nu p D ->
    vanishes (paired rest (forced_rows nu p s (with_inputs L B D))) ->
    \tr (T (with_faults S (mat nu n B) (mat nu p D)) s *m (mat (s * nu) (s * p) rest)^T) = 0.
  by move=> fB fD /(value_vanishes meaning); rewrite (value_paired _ (forced_fits B D)) forced_size forced_table.
have blank a b : formed a b (nseq a (nseq b (zero R))).
  by rewrite /formed size_nseq eqxx; apply/allP => r; rewrite mem_nseq => /andP[_ /eqP->]; rewrite size_nseq.
have unit a b i j : formed a b (unit_table R a b i j).
  by rewrite /formed size_mkseq eqxx; apply/allP => _ /mapP[k _ ->]; case: ifP; rewrite ?size_nseq ?size_mkseq.
apply: T_orthogonal => i j.
  have /units/andP[/allP onB _] : nat_of_ord i \in iota 0 nu by rewrite mem_iota /=.
  rewrite -[delta_mx i j](@mat_unit nu n) -(mat_blank nu p); apply: traceless => //; apply: onB; by rewrite mem_iota /=.
have /units/andP[_ /allP onD] : nat_of_ord i \in iota 0 nu by rewrite mem_iota /=.
rewrite -[delta_mx i j](@mat_unit nu p) -(mat_blank nu n); apply: traceless => //; apply: onD; by rewrite mem_iota /=.
Qed.
End Tables.

(** `input-limit`: the regression of MOESP. *)
Section Regression.
Variables (R : arithmetic) (K : realFieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).

Theorem is_regression_sound n m p nu c s E B D P f R' X i1 i2 : is_regression n m p nu c s E B D P f R' X i1 i2 ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : C) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q s e x st u y ->
  let Uf := future 0 s u in cov Q Uf Uf \in unitmx /\
  forall M, cov Q Uf Uf *m M = cov Q Uf (future 0 s y) -> let rest := regression_rest (system_of value n m p (tplant E)) M in
  exists X, forall B' D' X', squares (rest (mat nu n B) (mat nu p D) X) <= squares (rest B' D' X') /\
    (squares (rest B' D' X') <= squares (rest (mat nu n B) (mat nu p D) X) -> B' = mat nu n B /\ D' = mat nu p D).
Proof.
case/andP=> /andP[/andP[/and4P[s0 sizes fB fD] /and3P[/eqP sP stable solves]] /and4P[rank_u rank_o fR response]].
case/andP=> states units C embed; split.
  exact: (stable_states s0 sizes (@means_in R K C value embed meaning) stable).
move=> N Q e x st u y running Uf; have know := told s0 sizes embed meaning sP stable solves running.
have hold := recorded_signals s0 sizes meaning running.
move: know hold rank_u rank_o response states units; set a := (n + _ * _)%N; set b := (a + _)%N; set W := row_mx _ (future 0 s e).
set start := (basic R b 0 n, _); set es := [seq basic R b (a + k * c) c | k <- iota 0 s]; set zs := recorded_channels _ _ _ _ _ _ _.
set us := [seq z.1 | z <- zs]; set ys := [seq z.2 | z <- zs] => know hold.
have zs_size : size zs = s by rewrite recorded_size size_map size_iota.
have U_holds : W *m mat b (s * nu) (windowed b nu us) = Uf.
  by apply: windowed_holds => [|k /hold[]//]; rewrite size_map.
have Y_holds : W *m mat b (s * p) (windowed b p ys) = future 0 s y.
  by apply: windowed_holds => [|k /hold[]//]; rewrite size_map.
have wf : sized n m p (tplant E) by case/and5P: sizes.
set T' := forced_rows _ _ _ _; set rest := plus_tables _ _ _ => /(rank_of_table meaning) rank_u /(rank_of_table meaning) rank_o.
move=> /(equal_meaning meaning) response /(equal_meaning meaning) states units.
rewrite (know _ _ _ _ _ _ _ U_holds U_holds) ?size_mkseq // in rank_u.
have unit_u : cov Q Uf Uf \in unitmx by rewrite -row_free_unit /row_free rank_u.
split=> // M eM rest_of; exists (mat (s * nu) n X).
case/andP: (fR) => /eqP sR _.
have eR : mat (s * nu) (s * p) R' = M.
  have := response; rewrite (@mat_product _ _ _ meaning _ (s * nu)) ?sR // (know _ _ _ _ _ _ _ U_holds U_holds) ?size_mkseq //.
  rewrite (know _ _ _ _ _ _ _ U_holds Y_holds) ?size_mkseq // -eM => /(congr1 (mulmx (invmx (cov Q Uf Uf)))).
  by rewrite !mulKmx.
have e_rest : mat (s * nu) (s * p) rest = rest_of (mat nu n B) (mat nu p D) (mat (s * nu) n X).
  rewrite (mat_plus meaning) (mat_minus meaning) (mat_plus meaning) eR /rest_of /regression_rest (forced_table meaning s wf fB fD).
  by rewrite (@mat_product _ _ _ meaning _ n) ?size_map ?size_iota // (free_table meaning _ wf) opprD addrA.
move=> B' D' X'; apply: regression_least => //.
- move: states; rewrite (@mat_product _ _ _ meaning _ (s * p)) ?size_mkseq // (mat_transposed meaning) (free_table meaning _ wf) e_rest.
  by move=> ->; apply: mat_nil.
- by move=> B2 D2; have := orthogonal_to_all meaning wf units B2 D2; rewrite e_rest.
by rewrite /row_free -(free_table meaning _ wf) rank_o.
Qed.
End Regression.

(** `input-limit`: output error. *)
Section OutputError.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).

Lemma cov_beside N (Q : 'M[K]_N) a b d (X : 'M_(N, a)) (Y : 'M_(N, b)) (Z : 'M_(N, d)) :
  cov Q X (row_mx Y Z) = row_mx (cov Q X Y) (cov Q X Z).
Proof. by rewrite /cov mul_mx_row. Qed.

Lemma mean_square_less N q (Q : 'M[K]_N) (a d : 'M[K]_(N, q)) : Q^T = Q -> \tr (cov Q d a) = 0 ->
  \tr (cov Q (a - d) (a - d)) = \tr (cov Q a a) + \tr (cov Q d d).
Proof.
move=> symmetric da; have ad : \tr (cov Q a d) = 0 by rewrite -mxtrace_tr cov_transpose.
by rewrite cov_sub !cov_sub_left !raddfB /= da ad subr0 oppr0 add0r opprK.
Qed.

Lemma without_the_model (V : zmodType) (a b b' v d : V) : a + (b + b') + v - (d + b) = a - d + b' + v.
Proof.
rewrite [d + b]addrC opprD addrA [b + b']addrC [a + _]addrA -[a + b' + b + v]addrA [b + v]addrC addrA addrK.
by rewrite addrAC [a + b' - d]addrAC.
Qed.

Section Errors.
Variables (n m p nu c : nat) (E : experiment_list R) (B D B' D' : seq (seq (numeral R))).
Let E1 := experiment_of value n m p nu c E.
Let E2 := experiment_of value n m p nu c (errors_of E B' D').
Hypotheses (eB : mat nu n (tB E) = mat nu n B + mat nu n B') (eD : mat nu p (tD E) = mat nu p D + mat nu p D').
Variables (N : nat) (Q : 'M[K]_N) (e : nat -> 'M[K]_(N, c)) (x : nat -> 'M[K]_(N, n)) (s : nat -> nat -> 'M[K]_(N, nu + (m + p)))
  (u : nat -> 'M[K]_(N, nu)) (y : nat -> 'M[K]_(N, p)) (z : nat -> 'M[K]_(N, n)).
Hypotheses (running : stationary_process E1 Q 1 e x s u y) (model : model_states E1 Q e x s u (mat nu n B) z).
Hypothesis lasting : cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N).

(** The errors of a model are the outputs of an experiment. *)
Lemma errors_running : stationary_process E2 Q 1 e (fun k => x k - z k) s u (model_error E1 u y (mat nu p D) z).
Proof.
case: running => symmetric unit_e steps reads [fresh cxx cxs css]; case: model => moves ze zx zs.
split=> // [k|k|].
- have [sl ex es] := steps k; split=> //=; have [eu _] := reads k.
  by rewrite ex moves eu /driving /= eB mulmxDr mulmxBl; apply: without_the_model.
- have [eu ey] := reads k; split=> //; rewrite /model_error ey /output_of /driving /= eD mulmxDr mulmxBl eu /driving /=.
  by rewrite -[LHS]/(_ - _) -[X in X - _]addrA without_the_model addrA.
split=> // [k k1||i il].
- have k0 : k = 0%N by case: k k1.
  have [ex es] := fresh k k1; split=> //; by rewrite cov_sub_left ex k0 ze subr0.
- have xz : cov Q (x 1%N) (z 1%N) = cov Q (x 0%N) (z 0%N).
    by rewrite -[LHS](cov_transpose _ _ symmetric) zx (cov_transpose _ _ symmetric).
  by rewrite !cov_sub !cov_sub_left cxx zx xz lasting.
by rewrite !cov_sub_left cxs // zs.
Qed.

(** Another model, whose states last beside them: its error is that error less the difference of what the two predict, which is not
    correlated with it. *)
Variables (B1 : 'M[K]_(nu, n)) (D1 : 'M[K]_(nu, p)) (z1 : nat -> 'M[K]_(N, n)).
Hypotheses (model1 : model_states E1 Q e x s u B1 z1) (lasting1 : cov Q (z1 1%N) (z 1%N) = cov Q (z1 0%N) (z 0%N)).
Let l := size (tback E).
Let h := (nu + (m + p))%N.
Let X0 := row_mx (x 0%N - z 0%N) (future 0 l (s 0%N)).
Let X1 := row_mx (x 1%N - z 1%N) (future 0 l (s 1%N)).
Let y0 := model_error E1 u y (mat nu p D) z 0.

Lemma difference_of_models Phi Hy Gam Jy (Sum : 'M_(n + l * h, n)) :
  X1 = X0 *m Phi + future 0 1 e *m Gam -> y0 = X0 *m Hy + future 0 1 e *m Jy ->
  Sum = Phi *m Sum *m (mat n n (tA (tplant E)))^T + Hy *m (mat n p (tC (tplant E)))^T -> cov Q (u 0%N) X1 *m Sum = 0 ->
  cov Q (u 0%N) y0 = 0 ->
  \tr (cov Q ((z1 0%N - z 0%N) *m mat n p (tC (tplant E)) + u 0%N *m (D1 - mat nu p D)) y0) = 0.
Proof.
move=> eX1 ey0 eSum follows now; case: model => moves ze zx zs; case: model1 => moves1 ze1 zx1 zs1.
case: running => symmetric _ _ _ _; set A := mat n n _ in eSum *; set C := mat n p _ in eSum *; set d := z1 0%N - z 0%N.
have fresh : cov Q d (future 0 1 e) = 0.
  apply/matrixP => i j; rewrite cov_future [RHS]mxE; have := sample_lt j; case: (j %/ c)%N => // _.
  by rewrite cov_sub_left ze ze1 subr0 mxE.
have move0 : cov Q d X1 = cov Q d X0 *m Phi by rewrite eX1 cov_add !cov_mul fresh mul0mx addr0.
have same : cov Q (z1 1%N - z 1%N) X1 = cov Q d X0.
  rewrite /X1 /X0 !cov_beside; congr row_mx.
    by rewrite !cov_sub !cov_sub_left zx1 zx lasting lasting1.
  by apply/matrixP => i j; rewrite !cov_future !add0n !cov_sub_left zs1 ?zs ?sample_lt.
set M := cov Q d X0 in move0 same *.
have eM : M = A^T *m M *m Phi + (B1 - mat nu n B)^T *m cov Q (u 0%N) X1.
  by rewrite -{1}same moves1 moves opprD addrACA -mulmxBl -mulmxBr cov_add_left !cov_mul_left -/d move0 -mulmxA.
rewrite cov_add_left !cov_mul_left now mulmx0 addr0 ey0 cov_add !cov_mul fresh mul0mx addr0 -/M.
have -> : \tr (C^T *m (M *m Hy)) = \tr (M *m (Hy *m C^T)).
  by rewrite (mxtrace_mulC (C^T)) mulmxA.
have -> : Hy *m C^T = Sum - Phi *m Sum *m A^T.
  by apply/eqP; rewrite eq_sym subr_eq addrC {1}eSum.
rewrite mulmxBr linearB /=; apply/eqP; rewrite subr_eq0; apply/eqP.
transitivity (\tr (A^T *m M *m Phi *m Sum)); last by rewrite !mulmxA [RHS]mxtrace_mulC !mulmxA.
by rewrite {1}eM mulmxDl -(mulmxA _ (cov Q (u 0%N) X1)) follows mulmx0 addr0.
Qed.
End Errors.

Theorem is_output_error_sound n m p nu c E B D B' D' P f Sum : is_output_error n m p nu c E B D B' D' P f Sum ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : C) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, let E0 := experiment_of value n m p nu c E in stationary_process E0 Q 1 e x st u y ->
  forall z z1 B1 D1, model_states E0 Q e x st u (mat nu n B) z -> model_states E0 Q e x st u B1 z1 ->
  cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N) -> cov Q (z1 1%N) (z 1%N) = cov Q (z1 0%N) (z 0%N) ->
  let error D z := model_error E0 u y D z 0 in let difference := error (mat nu p D) z - error D1 z1 in
  \tr (cov Q (error D1 z1) (error D1 z1)) =
  \tr (cov Q (error (mat nu p D) z) (error (mat nu p D) z)) + \tr (cov Q difference difference).
Proof.
case/andP=> /andP[/and5P[sizes0 stable0 sizes sB sD] /and4P[/eqP sP stable solves /eqP sS]] /and3P[series follows now] C embed.
have H0 : (0 < 1)%N by []; have meaningC := @means_in R K C value embed meaning.
split; first exact: (stable_states H0 sizes0 meaningC stable0).
move=> N Q e x st u y E0 running z z1 B1 D1 model model1 lasting lasting1 error difference.
have {}sB : mat nu n (tB E) = mat nu n B + mat nu n B' by rewrite (equal_meaning meaning sB) (mat_plus meaning).
have {}sD : mat nu p (tD E) = mat nu p D + mat nu p D' by rewrite (equal_meaning meaning sD) (mat_plus meaning).
have errors := errors_running sB sD running model lasting.
have know := told H0 sizes embed meaning sP stable solves errors.
have [] := recorded_signals H0 sizes meaning errors H0; case: (errors) => symmetric _ steps _ _.
have next_is := next_joint H0 sizes meaning (steps 0%N) _.
move: know next_is series follows now; set a := (n + _ * _)%N; set b := (a + 1 * c)%N; set W := row_mx _ (future 0 1 e).
set start := (basic R b 0 n, _); set next := joint_states _ _ _ _; set zt := channels _ _ _ _ _ _ _.
move=> know next_is /(equal_meaning meaning) series /(equal_meaning meaning) follows /(equal_meaning meaning) now U_raw Y_raw.
have U_holds : W *m mat b nu zt.1 = u 0%N by move: U_raw; rewrite /= mul0n addn0; exact.
have Y_holds : W *m mat b p zt.2 = error (mat nu p D) z by move: Y_raw; rewrite /= mul0n addn0; exact.
have s1 : st 1%N (size (tback E)) = 0 by have [] := steps 1%N.
have {}next_is := next_is s1.
have divided q T M : W *m mat b q T = M ->
  M = row_mx (x 0%N - z 0%N) (future 0 (size (tback E)) (st 0%N)) *m mat a q (take a T) + future 0 1 e *m mat (1 * c) q (drop a T).
  by move=> <-; rewrite mat_rows mul_row_col.
have no_correlation : \tr (cov Q ((z1 0%N - z 0%N) *m mat n p (tC (tplant E)) + u 0%N *m (D1 - mat nu p D)) (error (mat nu p D) z)) = 0.
  have [eX eY] := (divided _ _ _ next_is, divided _ _ _ Y_holds).
  apply: (difference_of_models running model lasting D1 model1 lasting1 eX eY (Sum := mat a n Sum)).
  - rewrite {1}series (mat_plus meaning) (@mat_product _ _ _ meaning _ n) ?size_mkseq // (@mat_product _ _ _ meaning _ a) ?sS //.
    by rewrite (@mat_product _ _ _ meaning _ p) ?size_mkseq // !(mat_transposed meaning).
  - have := follows; rewrite (@mat_product _ _ _ meaning _ a) ?sS // (know _ _ _ _ _ _ _ U_holds next_is) ?size_mkseq // => ->.
    exact: mat_nil.
  by rewrite -(know _ _ _ _ _ _ _ U_holds Y_holds) ?size_mkseq // now mat_nil.
have apart : difference = (z1 0%N - z 0%N) *m mat n p (tC (tplant E)) + u 0%N *m (D1 - mat nu p D).
  rewrite /difference /error /model_error mulmxBl mulmxBr /=; set a1 := z1 0%N *m _; set a0 := z 0%N *m _; set b1 := u 0%N *m D1.
  by rewrite opprB addrC addrA subrK opprD addrACA.
rewrite -apart in no_correlation; have other : error D1 z1 = error (mat nu p D) z - difference by rewrite /difference opprB addrC subrK.
rewrite other; exact: mean_square_less.
Qed.
End OutputError.
