(** Noise of the states and of the outputs, of any colour and correlated with the faults or not, is a fault: what is said of faults that
    are uncorrelated with the input, and of past inputs, holds with it where the input is uncorrelated with the noise at all lags; with past
    outputs, where faults and noise are uncorrelated with themselves and with each other at different times.

    noisy S == S with the noise of the states and of the outputs as faults beside its own *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Basics Windows LimitsVocabulary MeansVocabulary Means MeanLimits ExogenousMeans PastStates.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Rows.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop).
Hypothesis isE : mean E.

Lemma covariance_row a b c (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) (z : nat -> 'rV[K]_c) R R' : covariance E x y R ->
  covariance E x z R' -> covariance E x (fun t => row_mx (y t) (z t)) (row_mx R R').
Proof.
move=> h h' i j; case: (split_ordP j) => k ->.
  by rewrite row_mxEl; apply: (mean_ext isE) (h i k) => t; rewrite row_mxEl.
by rewrite row_mxEr; apply: (mean_ext isE) (h' i k) => t; rewrite row_mxEr.
Qed.

Lemma uncorrelated_row a b c (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) (z : nat -> 'rV[K]_c) : uncorrelated E x y ->
  uncorrelated E x z -> uncorrelated E x (fun t => row_mx (y t) (z t)).
Proof.
move=> h h' l; have [h1 h2] := h l; have [h1' h2'] := h' l.
by split; [have := covariance_row h1 h1'|have := covariance_row h2 h2']; rewrite row_mx0.
Qed.

End Rows.

Section Noise.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (e : nat -> 'rV[K]_n) (w : nat -> 'rV[K]_p).
Variables (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (model : noisy_process S B D u v e w x y).

(** Section: definitions. *)
Definition noisy : system K n (m + n + p) p :=
  with_faults S (col_mx (col_mx (sysF S) 1%:M) 0) (col_mx (col_mx (sysG S) 0) 1%:M).
Let f := disturbances v e w.

Lemma noise_is_fault : process noisy B D u f x y.
Proof.
move=> k; have [-> ->] := model k; rewrite /f /disturbances /= !mul_row_col !mulmx1 !mulmx0 !addr0 !addrA; by split.
Qed.

Lemma noisy_O s : O noisy s = O S s.
Proof. by apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k _; apply: output_free. Qed.

Hypotheses (uv : uncorrelated E u v) (ue : uncorrelated E u e) (uw : uncorrelated E u w).
Lemma uncorrelated_noise : uncorrelated E u f.
Proof. exact: (uncorrelated_row isE (uncorrelated_row isE uv ue) uw). Qed.

Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (f t)) (x t)).

Theorem noisy_containment q s L : limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
  exists M, limit E (successive 0 q u) (successive q s u) (later q x) M /\ L = M *m O S s.
Proof. rewrite -noisy_O; exact: (mean_containment isE noise_is_fault quasi uncorrelated_noise). Qed.

Theorem noisy_regression s Ruu Ruy W B' D' : (0 < s)%N -> row_free (O S s.-1) ->
  covariance E (successive 0 s u) (successive 0 s u) Ruu -> covariance E (successive 0 s u) (successive 0 s y) Ruy -> W *m Ruu = 1%:M ->
  (W *m Ruy - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D.
Proof.
move=> s0; rewrite -!noisy_O => obs; exact: (mean_regression isE noise_is_fault quasi B' D' s0 obs uncorrelated_noise).
Qed.

Theorem noisy_autoregressive q s a Au i L : autoregressive_input E a Au u i -> knows_nothing_before E (later a i) x -> excites E s u ->
  (0 < s)%N -> (a <= s)%N -> (n <= q)%N -> (forall z, steered S B z) ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof. rewrite -noisy_O; exact: (mean_autoregressive isE noise_is_fault quasi uncorrelated_noise). Qed.

Theorem noisy_past_outputs q s L : knows_nothing_before E (later 1 f) f -> knows_nothing_before E f x ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> (L <= O S s)%MS.
Proof.
move=> ff fx; rewrite -noisy_O => /(mean_past_outputs isE noise_is_fault quasi uncorrelated_noise ff fx)[M ->]; exact: submxMl.
Qed.

End Noise.

Section Ordered.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (e : nat -> 'rV[K]_n) (w : nat -> 'rV[K]_p).
Variables (x z : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (pos : positive E) (model : noisy_process S B D u v e w x y) (st : stable (sysA S)).
Hypotheses (uv : uncorrelated E u v) (ue : uncorrelated E u e) (uw : uncorrelated E u w).
Hypothesis driven : forall t, z t.+1 = z t *m sysA S + u t *m B.
Let f := disturbances v e w.
Let model' := noise_is_fault model.
Let uf : uncorrelated E u f := uncorrelated_noise isE uv ue uw.

Theorem noisy_autoregressive_stable q s a Au i L : quasi_stationary E (fun t => row_mx (row_mx (u t) (f t)) (x t)) ->
  autoregressive_input E a Au u i -> excites E s u -> (0 < s)%N -> (a <= s)%N -> (n <= q)%N -> (forall z, steered S B z) ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof.
move=> quasi ar; apply: (noisy_autoregressive isE model uv ue uw quasi ar).
exact: (innovations_before isE pos model' st quasi uf ar).
Qed.

Theorem noisy_past_outputs_stable q s L : quasi_stationary E (fun t => row_mx (row_mx (u t) (f t)) (x t)) ->
  knows_nothing_before E (later 1 f) f ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> (L <= O S s)%MS.
Proof.
move=> quasi ff; apply: (noisy_past_outputs isE model uv ue uw quasi ff).
exact: (faults_before isE pos model' st quasi uf ff).
Qed.

Theorem noisy_long_past q s r L : quasi_stationary E (fun t => row_mx (row_mx (u t) (f t)) (row_mx (x t) (z t))) ->
  order_of_spectrum E r u -> (n + r <= q)%N -> excites E s u -> excites E (n + s) u ->
  (forall z, steered S B z) -> limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof. move=> quasi; rewrite -noisy_O; exact: (ExogenousMeans.mean_long_past isE pos model' st uf driven quasi). Qed.

Theorem noisy_output_error z' (B' : 'M_(nu, n)) (D' : 'M_(nu, p)) R R' : (forall t, z' t.+1 = z' t *m sysA S + u t *m B') ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (f t)) (row_mx (x t) (row_mx (z t) (z' t)))) ->
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R ->
  covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' ->
  \tr R <= \tr R' /\ (excites E n.+1 u -> observable S -> \tr R' = \tr R -> B' = B /\ D' = D).
Proof.
move=> driven' quasi hR hR'; have := ExogenousMeans.mean_output_error isE pos model' st uf driven driven' quasi hR hR'.
by rewrite noisy_O.
Qed.

End Ordered.
