(** The eighth part of Headlines.v, which includes it: consistency as a statement about signals and their means, without probability. A
    signal is a sequence of row vectors; E f a says that the sequence f has the mean a, E being any shift-invariant linear functional
    (MeansVocabulary.v). Each assumption has its own name: quasi_stationary, that covariances exist; uncorrelated, at lags of both signs;
    excites, that successive inputs have a regular covariance; steered, that (A, B) is controllable; stable, of A. Positivity of the mean is
    asked where it is used. Time starts at 0 and goes on: the q samples before the present are successive 0 q, the s samples from then on
    successive q s. Then the example of section V, over every field that holds its eigenvalue. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  matrix mxalgebra.
From faultspace Require Import Vocabulary LimitsVocabulary StructureVocabulary MeansVocabulary ExampleVocabulary.
From faultspace Require MeanLimits FilteredInputs ExogenousMeans PeriodicMeans PeriodicSignals PulseMeans SectionFive.
From faultspace Require NoisyMeans PastStates PastOutputMeans FollowingMeans ErrorsReach TwoStates.
From faultspace Require TimeAverages RudinShapiro PartOfTheRange WhiteSources ColouredFaults FollowingSources.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** Means exist *)

(** The average over a period is a mean, it is positive, and every periodic sequence has it: 1 has the average 1. *)
Theorem means_exist (K : realFieldType) : [/\ mean (@period_average K), positive (@period_average K), period_average (fun=> 1 : K) 1
  & forall (f : nat -> K) d, (0 < d)%N -> (forall t, f (t + d)%N = f t) -> exists a, period_average f a].
Proof. exact: PeriodicMeans.period_averages. Qed.

(** ** proposition-1, two-sided *)

(** The limit of PI-MOESP is a matrix times O_s, that which the limit would be if the state were measured. *)
Theorem mean_two_sided (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y q s L :
  mean E -> process S B D u v x y -> quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
  exists M, limit E (successive 0 q u) (successive q s u) (later q x) M /\ L = M *m O S s.
Proof. move=> isE model quasi; exact: (MeanLimits.mean_containment isE model quasi). Qed.

(** The regression of MOESP with the true A and C gives the true B and D alone, where s - 1 samples show all states and s successive inputs
    have a regular covariance. *)
Theorem mean_two_sided_b_d (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y s Ruu Ruy W B' D' :
  mean E -> process S B D u v x y -> quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v ->
  (0 < s)%N -> row_free (O S s.-1) ->
  covariance E (successive 0 s u) (successive 0 s u) Ruu -> covariance E (successive 0 s u) (successive 0 s y) Ruy -> W *m Ruu = 1%:M ->
  (W *m Ruy - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D.
Proof. move=> isE model quasi uv s0 obs; exact: (MeanLimits.mean_regression isE model quasi). Qed.

(** ** proposition-1, all of the range *)

(** two-sided-autoregressive: u of order a at most s, and n past inputs. The innovations from the time a on know nothing of the states
    before, as is so where A is stable and the mean positive (mean_past_states). *)
Theorem mean_autoregressive (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y q s a Au e L :
  mean E -> process S B D u v x y -> quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v ->
  autoregressive_input E a Au u e -> knows_nothing_before E (later a e) x -> excites E s u -> (0 < s)%N -> (a <= s)%N -> (n <= q)%N ->
  (forall z, steered S B z) -> limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof. move=> isE model quasi; exact: (MeanLimits.mean_autoregressive isE model quasi). Qed.

(** Where the mean is positive, A stable, and faults and inputs are uncorrelated at all lags: faults that are uncorrelated at different
    times know nothing of the states before, and innovations of order a nothing of those a samples before and earlier. *)
Theorem mean_past_states (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y :
  mean E -> positive E -> process S B D u v x y -> stable (sysA S) ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v ->
  (forall a Au e, autoregressive_input E a Au u e -> knows_nothing_before E (later a e) x) /\
  (knows_nothing_before E (later 1 v) v -> knows_nothing_before E v x).
Proof.
move=> isE pos model st quasi uv; split=> [a Au e ar|]; [exact: (PastStates.innovations_before isE pos model st quasi uv ar)|
  exact: (PastStates.faults_before isE pos model st quasi uv)].
Qed.

(** two-sided-long-past: u of any spectrum of order r, and n + r past inputs. z is what the inputs make of the state. *)
Theorem mean_long_past (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x z y q s r L :
  mean E -> positive E -> process S B D u v x y -> stable (sysA S) -> uncorrelated E u v -> (forall t, z t.+1 = z t *m sysA S + u t *m B) ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t))) ->
  order_of_spectrum E r u -> (n + r <= q)%N -> excites E s u -> excites E (n + s) u ->
  (forall z, steered S B z) -> limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof.
move=> isE pos model st uv driven quasi; exact: (ExogenousMeans.mean_long_past isE pos model st uv driven quasi).
Qed.

(** Where a filter of r states makes u of e, and e knows nothing of earlier inputs, as white noise does not where the filter is stable and
    the mean positive, the spectrum is of order r. *)
Theorem filtered_inputs (K : fieldType) (E : (nat -> K) -> K -> Prop) r nu ne (A : 'M_r) (B : 'M_(ne, r)) (C : 'M_(r, nu)) (D : 'M_(ne, nu))
    u e xi : mean E -> (forall t, xi t.+1 = xi t *m A + e t *m B /\ u t = xi t *m C + e t *m D) -> knows_nothing_before E (later 1 e) u ->
  quasi_stationary E (fun t => row_mx (u t) (xi t)) -> order_of_spectrum E r u.
Proof. move=> isE model; exact: (FilteredInputs.filtered_inputs isE model). Qed.

(** two-sided-two-states: two states, one input, two past inputs and s future ones; A is stable, (A, B) controllable, (A, C) observable on
    s samples, and s + 3 successive inputs have a regular covariance; z is what the inputs make of the state. b and f are the backward and
    the forward error of order s + 1, and c_s, the weight of u(t+s+1) in the prediction of u(t), is the reflection coefficient of that
    order. Exactly one matrix F commutes with A and takes the covariance of b(t) and x(t+1) to that of f(t) and x(t). The limit has all of
    the range of O_s unless A is regular and A^-1 + c_s F is a multiple of the identity. *)
Theorem mean_two_states (K : realFieldType) (E : (nat -> K) -> K -> Prop) m p (S : system K 2 m p) (B : 'M_(1, 2)) (D : 'M_(1, p))
    u v x z y s c b d f H L :
  mean E -> positive E -> process S B D u v x y -> stable (sysA S) -> uncorrelated E u v -> (forall t, z t.+1 = z t *m sysA S + u t *m B) ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t))) -> excites E s.+3 u ->
  (forall z, steered S B z) -> row_free (O S s) -> backward_error E s.+1 u c b -> forward_error E s.+1 u d f ->
  covariance E b (later 1 x) H -> limit E (successive 0 2 u) (successive 2 s u) (successive 2 s y) L ->
  exists2 F, forall F', F' *m sysA S = sysA S *m F' /\ covariance E f x (H *m F') <-> F' = F
    & (L == O S s)%MS = ~~ ((sysA S \in unitmx) && is_scalar_mx (invmx (sysA S) + c s 0 0 *: F)).
Proof.
move=> isE pos model st uv driven quasi exciting all obs back forw bx hL;
exact: (TwoStates.two_states isE pos model st uv driven quasi all back forw exciting obs hL bx).
Qed.

(** Inputs of which r successive ones excite have such errors of order r. *)
Theorem prediction_errors_exist (K : fieldType) (E : (nat -> K) -> K -> Prop) nu (u : nat -> 'rV[K]_nu) r :
  mean E -> quasi_stationary E u -> excites E r u -> (exists c b, backward_error E r u c b) /\ exists d f, forward_error E r u d f.
Proof. move=> isE quasi; exact: (ErrorsReach.errors_exist isE quasi (ErrorsReach.combination_itself u)). Qed.

(** ** proposition-1, two-sided-output-error *)

(** z is the state of the model with B and D, z' that with any other: the true ones have the least mean square error R, and they alone
    where n + 1 successive inputs have a regular covariance and (A, C) is observable. *)
Theorem mean_output_error (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B B' : 'M_(nu, n))
    (D D' : 'M_(nu, p)) u v x z z' y R R' :
  mean E -> positive E -> process S B D u v x y -> stable (sysA S) -> uncorrelated E u v ->
  (forall t, z t.+1 = z t *m sysA S + u t *m B) -> (forall t, z' t.+1 = z' t *m sysA S + u t *m B') ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t)))) ->
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R ->
  covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' ->
  \tr R <= \tr R' /\ (excites E n.+1 u -> observable S -> \tr R' = \tr R -> B' = B /\ D' = D).
Proof.
move=> isE pos model st uv driven driven' quasi; exact: (ExogenousMeans.mean_output_error isE pos model st uv driven driven' quasi).
Qed.

(** There are such signals, with an input of order 2 and averages over 3 samples, for x(k+1) = u(k) + v(k), y = x. *)
Theorem mean_signals_exist (K : realFieldType) : let E := @period_average K in let S : system K 1 1 1 := System 0 1%:M 1%:M 0 in
  exists u v x z y : nat -> 'rV[K]_1,
  [/\ process S (1%:M : 'M_1) 0 u v x y /\ (forall t, z t.+1 = z t *m sysA S + u t *m 1%:M), uncorrelated E u v,
    stable (sysA S) /\ (forall x0, steered S (1%:M : 'M_1) x0),
    [/\ order_of_spectrum E 2 u, excites E 1 u & excites E 2 u]
  & forall B' : 'M_1, exists2 z', (forall t, z' t.+1 = z' t *m sysA S + u t *m B') &
      quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t)))) /\
      quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t)))].
Proof. exact: PeriodicSignals.periodic_signals. Qed.

(** ** proposition-1, with noise *)

(** Noise e of the states and w of the outputs, of any colour, correlated with each other and with the faults or not, and uncorrelated with
    the inputs at all lags, as the faults are; the covariances of all of these and of x exist. The limit of PI-MOESP is a matrix times O_s;
    the regression gives the true B and D alone, where s - 1 samples show all states and s successive inputs have a regular covariance. *)
Theorem mean_noise (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v e w x y :
  mean E -> noisy_process S B D u v e w x y -> quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)) ->
  uncorrelated E u v -> uncorrelated E u e -> uncorrelated E u w ->
  (forall q s L, limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
    exists M, limit E (successive 0 q u) (successive q s u) (later q x) M /\ L = M *m O S s) /\
  (forall s Ruu Ruy W B' D', (0 < s)%N -> row_free (O S s.-1) ->
    covariance E (successive 0 s u) (successive 0 s u) Ruu -> covariance E (successive 0 s u) (successive 0 s y) Ruy -> W *m Ruu = 1%:M ->
    (W *m Ruy - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D).
Proof.
move=> isE model quasi uv ue uw; split=> [q s L|s Ruu Ruy W B' D' ns obs];
  [exact: (NoisyMeans.noisy_containment isE model uv ue uw quasi)|
   exact: (NoisyMeans.noisy_regression isE model uv ue uw quasi B' D' ns obs)].
Qed.

(** A stable, the mean positive, (A, B) controllable, and s successive inputs of regular covariance. All of the range for u autoregressive
    of order at most s, s >= 1, and n past inputs, and for u of any spectrum of order r and n + r past inputs where n + s successive inputs
    have a regular covariance, too; z is what the inputs make of the state. *)
Theorem mean_noise_range (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v e w x z y q s L :
  mean E -> positive E -> noisy_process S B D u v e w x y -> stable (sysA S) ->
  uncorrelated E u v -> uncorrelated E u e -> uncorrelated E u w -> excites E s u -> (forall z, steered S B z) ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
  (forall a Au i, quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)) -> autoregressive_input E a Au u i ->
    (0 < s)%N -> (a <= s)%N -> (n <= q)%N -> (L == O S s)%MS) /\
  (forall r, (forall t, z t.+1 = z t *m sysA S + u t *m B) ->
    quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (row_mx (x t) (z t))) ->
    order_of_spectrum E r u -> (n + r <= q)%N -> excites E (n + s) u -> (L == O S s)%MS).
Proof.
move=> isE pos model st uv ue uw exciting all hL; split=> [a Au i quasi ar s0 short nq|r driven quasi spectrum long more];
  [exact: (NoisyMeans.noisy_autoregressive_stable isE pos model st uv ue uw quasi ar exciting s0 short nq all hL)|
   exact: (NoisyMeans.noisy_long_past isE pos model st uv ue uw driven quasi spectrum long exciting more all hL)].
Qed.

(** Output error, as in mean_output_error. *)
Theorem mean_noise_output_error (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B B' : 'M_(nu, n))
    (D D' : 'M_(nu, p)) u v e w x z z' y R R' :
  mean E -> positive E -> noisy_process S B D u v e w x y -> stable (sysA S) ->
  uncorrelated E u v -> uncorrelated E u e -> uncorrelated E u w ->
  (forall t, z t.+1 = z t *m sysA S + u t *m B) -> (forall t, z' t.+1 = z' t *m sysA S + u t *m B') ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (row_mx (x t) (row_mx (z t) (z' t)))) ->
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R ->
  covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' ->
  \tr R <= \tr R' /\ (excites E n.+1 u -> observable S -> \tr R' = \tr R -> B' = B /\ D' = D).
Proof.
move=> isE pos model st uv ue uw driven driven' quasi;
exact: (NoisyMeans.noisy_output_error isE pos model st uv ue uw driven driven' quasi).
Qed.

(** Past outputs among the instruments: faults and noise that are uncorrelated with themselves and each other at different times. *)
Theorem mean_noise_past_outputs (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v e w x y q s L :
  mean E -> positive E -> noisy_process S B D u v e w x y -> stable (sysA S) ->
  uncorrelated E u v -> uncorrelated E u e -> uncorrelated E u w ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)) ->
  knows_nothing_before E (later 1 (disturbances v e w)) (disturbances v e w) ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> (L <= O S s)%MS.
Proof.
move=> isE pos model st uv ue uw; exact: (NoisyMeans.noisy_past_outputs_stable isE pos model st uv ue uw).
Qed.

(** ** past-outputs, white-fault *)

(** Past outputs are among the instruments (PO-MOESP). Faults that know nothing of earlier faults and states, and are uncorrelated with the
    inputs, which may have any colour: the limit lies in the range of O_s. *)
Theorem mean_past_outputs (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y q s L :
  mean E -> process S B D u v x y -> quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v ->
  knows_nothing_before E (later 1 v) v -> knows_nothing_before E v x ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> (L <= O S s)%MS.
Proof. move=> isE model quasi uv vv vx /(MeanLimits.mean_past_outputs isE model quasi uv vv vx)[M ->]; exact: submxMl. Qed.

(** There is a mean in which signals are white at all lags, and there are signals for the hypotheses of mean_autoregressive, of order 0,
    and of mean_past_outputs, with v and u white: x(k+1) = u(k) + v(k), y = x. *)
Theorem white_signals_exist (K : realFieldType) : [/\ mean (@block_sum K), positive (@block_sum K) &
  let E := @block_sum K in let S : system K 1 1 1 := System 0 1%:M 1%:M 0 in exists u v x y : nat -> 'rV[K]_1,
  [/\ process S (1%:M : 'M_1) 0 u v x y, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v,
    [/\ white_noise E u, white_noise E v, knows_nothing_before E u x & knows_nothing_before E v x]
  & [/\ autoregressive_input E 0 (fun=> 0) u u, excites E 1 u & forall x0, steered S (1%:M : 'M_1) x0]]].
Proof. exact: PulseMeans.white_signals. Qed.

(** ** past-outputs, coloured-fault (refuted) *)

(** A stable, all states measured (C = 1), no feedthrough of the fault (G = 0), and a fault that is uncorrelated with the inputs, and with
    itself from three samples on; at least one past sample and two future ones. The limit of PO-MOESP lies in the range of O_s only if the
    covariance at two samples, taken through F, is zero. *)
Theorem mean_coloured_fault (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m nu (S : system K n m n) (B : 'M_(nu, n)) (D : 'M_(nu, n))
    u v x y q s R L :
  mean E -> positive E -> process S B D u v x y -> stable (sysA S) ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v ->
  (forall l, (2 < l)%N -> covariance E (later l v) v 0) -> covariance E v (later 2 v) R -> sysC S = 1%:M -> sysG S = 0 ->
  (0 < q)%N -> (1 < s)%N ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L ->
  (L <= O S s)%MS -> (sysF S)^T *m R *m sysF S = 0.
Proof.
move=> isE pos model st quasi uv short two all_states direct q0 s1;
exact: (PastOutputMeans.coloured_seen isE pos model st uv quasi short two all_states direct q0 s1).
Qed.

(** There are such signals for every such system with one fault and one input, F not 0, from any initial state: u white,
    v(t) = f(t+2) + f(t) for a white f that is uncorrelated with u at all lags. The limits of PO-MOESP exist and, for a past and two
    samples or more, lie outside the range, whatever B is, and so also where (A, B) is controllable. *)
Theorem coloured_fault_exists (K : realFieldType) n (S : system K n 1 n) (B : 'M_(1, n)) (D : 'M_(1, n)) x0 : archimedean K ->
  stable (sysA S) -> sysC S = 1%:M -> sysG S = 0 -> sysF S != 0 ->
  let E := @time_average K in let u t : 'rV[K]_1 := (rudin_shapiro K t)%:M in
  let v t : 'rV[K]_1 := (rudin_shapiro_turned K (t + 2))%:M + (rudin_shapiro_turned K t)%:M in
  exists x y, [/\ process S B D u v x y /\ x 0%N = x0, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)),
    white_noise E u /\ uncorrelated E u v
  & forall q s, (0 < q)%N -> (1 < s)%N ->
    let converges L := limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L in
    (exists L, converges L) /\ forall L, converges L -> ~ (L <= O S s)%MS].
Proof. move=> arch; exact: (ColouredFaults.coloured_fault arch). Qed.

(** ** past-outputs, past-inputs (refuted) *)

(** The input of mean_part_of_the_range, a system as there (two states, A stable, (A, B) controllable, C invertible), and the coloured
    fault: PI-MOESP misses a part of the range of O_2, and PO-MOESP leaves it. *)
Theorem mean_neither_right (K : rcfType) : archimedean K -> let E := @time_average K in
  let u t : 'rV[K]_1 := (rudin_shapiro K (t + 3))%:M - (rudin_shapiro K t)%:M in
  let v t : 'rV[K]_1 := (rudin_shapiro_turned K (t + 2))%:M + (rudin_shapiro_turned K t)%:M in
  exists (S : system K 2 1 2) (B : 'M_(1, 2)) x y, [/\ process S B 0 u v x y,
    [/\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v & stable (sysA S)],
    [/\ forall z, steered S B z, row_free (sysC S) & forall s, excites E s u],
    (exists L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L) /\
      forall L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L -> ~ (O S 2 <= L)%MS
  & let converges L := limit E (fun t => row_mx (successive 0 2 u t) (successive 0 2 y t)) (successive 2 2 u) (successive 2 2 y) L in
    (exists L, converges L) /\ forall L, converges L -> ~ (L <= O S 2)%MS].
Proof. exact: ColouredFaults.neither_right. Qed.

(** ** settle-1, not-both *)

(** v(t+1) = u(t) Phi, u white; w(t+1) stands for u(t), z is the state of the model with the true B. With a past input, s >= 1 and
    all states shown by s - 1 samples: not both, the limit in the range of O_s, and B, D among the best fits by output error, the models
    being run for ever. Unless the fault is never seen. *)
Theorem mean_settle_1_not_both (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) (Phi : 'M_(nu, m)) u w x z y q s L R :
  mean E -> positive E -> process S B D u (fun t => w t *m Phi) x y -> (forall t, w t.+1 = u t) -> stable (sysA S) -> white_noise E u ->
  (forall t, z t.+1 = z t *m sysA S + u t *m B) -> quasi_stationary E (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))) ->
  (0 < q)%N -> (0 < s)%N -> row_free (O S s.-1) -> observable S ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L <= O S s)%MS ->
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R ->
  (forall (B' : 'M_(nu, n)) (D' : 'M_(nu, p)) z' R', (forall t, z' t.+1 = z' t *m sysA S + u t *m B') ->
    covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' -> \tr R <= \tr R') ->
  Phi *m sysF S = 0 /\ Phi *m sysG S = 0.
Proof.
move=> isE pos model wu st white driven quasi;
exact: (FollowingMeans.mean_not_both isE pos model wu st white driven quasi).
Qed.

(** For every stable system and every Phi there are signals as the first two lines of these premises have them, with limits for all q and s:
    of each of them not both are right, unless the fault is never seen, where q >= 1 and (A, C) is observable on s - 1 samples, s >= 1. *)
Theorem mean_settle_1_signals_exist (K : realFieldType) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    (Phi : 'M_(nu, m)) : archimedean K -> stable (sysA S) ->
  let E := @time_average K in let u := @white_source K nu in let w t := if t is t'.+1 then u t' else 0 in
  exists x z y, [/\ process S B D u (fun t => w t *m Phi) x y, forall t, z t.+1 = z t *m sysA S + u t *m B,
    quasi_stationary E (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))), white_noise E u
  & forall q s, exists L, limit E (successive 0 q u) (successive q s u) (successive q s y) L].
Proof. exact: FollowingSources.following_exist. Qed.

(** ** example-v *)

(** one-fault, two-columns, window-of-assumption-4: the ranks of its windows are 2, 4, 5, 6, 7, 8, ...; problem (11) has two columns from
    s = 3 on, and five at s = 2. *)
Theorem example_v_ranks (K : fieldType) (a : K) s : let S := example_v a in left_invertible S /\ \rank (window S s) = (s + minn s 2)%N.
Proof. split; [exact: SectionFive.example_left_invertible|exact: SectionFive.example_windows]. Qed.
Theorem example_v_columns (K : fieldType) (a : K) s k (Z : 'M_(k, 3 + 2)) : spans_solutions (example_v a) s Z ->
  ((2 < s)%N -> \rank Z = 2%N) /\ (s = 2%N -> \rank Z = 5%N).
Proof. exact: SectionFive.example_solutions. Qed.

(** not-controllable *)
Theorem example_v_controllability (K : fieldType) (a : K) : example_root a ->
  observable (example_v a) /\ ~ fault_controllable (example_v a).
Proof. move=> root; split; [exact: SectionFive.example_observable|exact: SectionFive.example_not_controllable]. Qed.

(** zeros-and-delays: none finite and one infinite; its order is the delay, 1, with the initial state known or not *)
Theorem example_v_zeros (K : fieldType) (a : K) g d : let S := example_v a in gcd_of_minors (pencil S) g -> infinite_zeros S d ->
  [/\ (size g).-1 = 0%N, d = 1%N, lag S = 2%N, inverts_with_delay S 1 /\ inverts_from_any_state S 1 & ~ inverts_with_delay S 0].
Proof. exact: SectionFive.example_zeros_and_delays. Qed.

(** seventh-singular-value, rank-difference: on data that excite, rank R_5 = 7 and rank R_6 = 8 *)
Theorem example_v_data (K : fieldType) (a : K) x v N : let S := example_v a in row_full (excitation S x v N 6) ->
  \rank (hankel N 5 (output S x v)) = 7%N /\ \rank (hankel N 6 (output S x v)) = 8%N.
Proof. exact: SectionFive.example_data. Qed.

(** The eigenvalue: 2 among the residues modulo 23, and a root in every real closed field. *)
Theorem example_roots_exist : example_root (2%:R : 'F_23) /\ forall K : rcfType, exists a : K, example_root a.
Proof. exact: SectionFive.example_roots. Qed.

(** ** Time averages *)

(** The limit of the averages over ever longer times is a mean, and positive, over an ordered field without infinite numbers; it is the
    average over a period where there is one. *)
Theorem time_averages (K : realFieldType) : archimedean K ->
  [/\ mean (@time_average K), positive (@time_average K) & forall (f : nat -> K) a, period_average f a -> time_average f a].
Proof.
by move=> arch; split; [exact: TimeAverages.time_average_mean|exact: TimeAverages.time_average_positive|
  exact: TimeAverages.period_average_in_time].
Qed.

(** In it the sequence of Rudin and Shapiro and the same with every second sign turned are white, and uncorrelated at all lags. *)
Theorem time_averages_white (K : realFieldType) : archimedean K ->
  let E := @time_average K in let u t : 'rV_1 := (rudin_shapiro K t)%:M in let v t : 'rV_1 := (rudin_shapiro_turned K t)%:M in
  [/\ white_noise E u, white_noise E v & uncorrelated E u v].
Proof. exact: RudinShapiro.shapiro_white. Qed.

(** As many white signals as one likes, uncorrelated with each other at all lags; so every stable system with any number of inputs and
    faults, driven by these from any state: all covariances exist as limits of time averages, and u and v know nothing of the states
    before. So the hypotheses about signals of mean_two_sided, mean_two_sided_b_d, mean_autoregressive, with a = 0, and
    mean_past_outputs are met. *)
Theorem time_averages_exist (K : realFieldType) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) x0 : archimedean K ->
  stable (sysA S) -> let E := @time_average K in let source := @white_source K (nu + m) in
  let u t : 'rV_nu := lsubmx (source t) in let v t : 'rV_m := rsubmx (source t) in
  exists x y, [/\ process S B D u v x y /\ x 0%N = x0, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)),
    [/\ white_noise E u, white_noise E v & uncorrelated E u v],
    [/\ autoregressive_input E 0 (fun=> 0) u u, knows_nothing_before E u x, knows_nothing_before E (later 1 v) v
      & knows_nothing_before E v x]
  & forall s, excites E s u].
Proof. move=> arch; exact: (WhiteSources.driven_exist arch). Qed.

(** With white noise of the states and of the outputs: the hypotheses about signals of mean_noise, mean_noise_past_outputs and, with a = 0,
    of the first part of mean_noise_range. Noise of other colours is made of these by a stable filter, whose state is then a part of x. *)
Theorem noisy_signals_exist (K : realFieldType) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) x0 : archimedean K ->
  stable (sysA S) -> let E := @time_average K in exists u v e w x y,
  [/\ noisy_process S B D u v e w x y /\ x 0%N = x0, quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)),
    [/\ white_noise E u, white_noise E v, white_noise E e & white_noise E w],
    [/\ uncorrelated E u v, uncorrelated E u e, uncorrelated E u w
      & knows_nothing_before E (later 1 (disturbances v e w)) (disturbances v e w)]
  & autoregressive_input E 0 (fun=> 0) u u /\ forall s, excites E s u].
Proof. exact: WhiteSources.noisy_exist. Qed.

(** ** proposition-1, two-sided-range (refuted) *)

(** All of the range is not for every colour: u(t) = e(t+3) - e(t) for a white e, v white and uncorrelated with u at all lags, two states
    and as many past and future samples, A stable, (A, B) controllable, C invertible, and any number of successive inputs of regular
    covariance. There is a limit of PI-MOESP, and it misses a part of the range of O_s. In the proof A has a double pole, a root of
    a^6 - 5 a^3 + 3 between 0 and 1. *)
Theorem mean_part_of_the_range (K : rcfType) : archimedean K -> let E := @time_average K in
  let u t : 'rV[K]_1 := (rudin_shapiro K (t + 3))%:M - (rudin_shapiro K t)%:M in let v t : 'rV[K]_1 := (rudin_shapiro_turned K t)%:M in
  exists (S : system K 2 1 2) (B : 'M_(1, 2)) x y, [/\ process S B 0 u v x y,
    [/\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v & stable (sysA S)],
    [/\ forall z, steered S B z, row_free (sysC S) & forall s, excites E s u]
  & (exists L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L) /\
    forall L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L -> ~ (O S 2 <= L)%MS].
Proof. exact: PartOfTheRange.part_of_the_range_exists. Qed.
