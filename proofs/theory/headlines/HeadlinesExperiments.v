(** The seventh part of Headlines.v, which includes it: what the checks of certificates of stability and of limits of identification prove
    once the kernel of Rocq has computed true. Numbers of an arithmetic R mean elements of a field K, by `value`, as in HeadlinesFields.v;
    the checks are functions on lists of them (ExperimentsVocabulary.v), and f, P and the last four arguments are witnesses that nobody
    has to believe. Stability is said of every field C with a norm and all roots, as the complex numbers, that holds K. *)
From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary NumbersVocabulary ExperimentsVocabulary.
From faultspace Require Stability FieldLimits.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** All eigenvalues inside the unit circle, wherever the field lies in one with a norm and all roots *)
Theorem field_schur_stable (R : arithmetic) (K : fieldType) (value : numeral R -> K) n M f : means value -> is_stable n M f ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}), schur_stable (map_mx embed (matrix_of value n n M)).
Proof. exact: Stability.system_stable. Qed.
Print Assumptions field_schur_stable.

(** The experiment is stable; and in every stationary process of it the covariance of the future inputs is invertible, and the limits of
    identification, by the past inputs and q past outputs, have the rank told, together with O_s too *)
Theorem field_moesp_limit (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 :
  means value -> is_limit n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : [fieldType of C]) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q (past + s) e x st u y ->
  let Z := row_mx (future 0 past u) (future 0 q y) in let Uf := future past s u in let Yf := future past s y in
  let seen := O (system_of value n m p (tplant E)) s in
  [/\ cov Q Uf Uf \in unitmx, \rank seen = ro &
    forall L, projected_limit Q Z Uf Yf L -> \rank L = rl /\ \rank (col_mx L seen) = rj].
Proof. move=> meaning; exact: (FieldLimits.is_limit_sound meaning). Qed.
Print Assumptions field_moesp_limit.
