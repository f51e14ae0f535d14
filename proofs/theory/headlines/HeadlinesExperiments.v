(** The seventh part of Headlines.v, which includes it: what the checks of certificates of stability and of limits of identification prove
    once the kernel of Rocq has computed true. Numbers of an arithmetic R mean elements of a field K, by `value`, as in HeadlinesFields.v;
    the checks are functions on lists of them (ExperimentsVocabulary.v), and f, P and what follows them are witnesses that nobody
    has to believe. Stability is said of every field C with a norm and all roots, as the complex numbers, that holds K. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra.
From faultspace Require Import Vocabulary NumbersVocabulary ExperimentsVocabulary.
From faultspace Require Stability FieldLimits FieldInputs.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** All eigenvalues inside the unit circle, wherever the field lies in one with a norm and all roots *)
Theorem field_schur_stable (R : arithmetic) (K : fieldType) (value : numeral R -> K) n M f : means value -> is_stable n M f ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}), schur_stable (map_mx embed (matrix_of value n n M)).
Proof. exact: Stability.system_stable. Qed.

(** The experiment is stable; and in every stationary process of it the covariance of the future inputs is invertible, and the limits of
    identification, by the past inputs and q past outputs, have the rank told, together with O_s too *)
Theorem field_moesp_limit (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 :
  means value -> is_limit n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : C) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q (past + s) e x st u y ->
  let Z := row_mx (future 0 past u) (future 0 q y) in let Uf := future past s u in let Yf := future past s y in
  let seen := O (system_of value n m p (tplant E)) s in
  [/\ cov Q Uf Uf \in unitmx, \rank seen = ro &
    forall L, projected_limit Q Z Uf Yf L -> \rank L = rl /\ \rank (col_mx L seen) = rj].
Proof. move=> meaning; exact: (FieldLimits.is_limit_sound meaning). Qed.

(** The experiment is stable; and in every stationary process of it the covariance of the future inputs is invertible, and the regression
    of MOESP on s samples, with the true A and C, has its least sum of squares at the B and D told, and nowhere else *)
Theorem field_input_limit_moesp (R : arithmetic) (K : realFieldType) (value : numeral R -> K) n m p nu c s E B D P f R' X i1 i2 :
  means value -> is_regression n m p nu c s E B D P f R' X i1 i2 ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : C) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q s e x st u y ->
  let Uf := future 0 s u in let B0 := matrix_of value nu n B in let D0 := matrix_of value nu p D in cov Q Uf Uf \in unitmx /\
  forall M, cov Q Uf Uf *m M = cov Q Uf (future 0 s y) -> let rest := regression_rest (system_of value n m p (tplant E)) M in
  exists X, forall B' D' X', squares (rest B0 D0 X) <= squares (rest B' D' X') /\
    (squares (rest B' D' X') <= squares (rest B0 D0 X) -> B' = B0 /\ D' = D0).
Proof. move=> meaning; exact: (FieldInputs.is_regression_sound meaning). Qed.

(** The experiment is stable; and in every stationary process of it, by output error with the true A and C, the mean square error of any
    other model is that of the one with the B and D told and the mean square of the difference of what the two predict *)
Theorem field_input_limit_true_AC (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p nu c E B D B' D' P f Sum :
  means value -> is_output_error n m p nu c E B D B' D' P f Sum ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : C) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, let E0 := experiment_of value n m p nu c E in stationary_process E0 Q 1 e x st u y ->
  forall z z1 B1 D1, model_states E0 Q e x st u (matrix_of value nu n B) z -> model_states E0 Q e x st u B1 z1 ->
  cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N) -> cov Q (z1 1%N) (z 1%N) = cov Q (z1 0%N) (z 0%N) ->
  let error D z := model_error E0 u y D z 0 in let D0 := matrix_of value nu p D in let difference := error D0 z - error D1 z1 in
  \tr (cov Q (error D1 z1) (error D1 z1)) = \tr (cov Q (error D0 z) (error D0 z)) + \tr (cov Q difference difference).
Proof. move=> meaning; exact: (FieldInputs.is_output_error_sound meaning). Qed.
