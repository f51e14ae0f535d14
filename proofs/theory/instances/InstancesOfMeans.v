(** Instances for the headlines on means of signals, as InstancesOfLimits.v has them for those on covariances. Those of filtered inputs
    apart they are of the plain system, x(k+1) = u(k) + v(k), y = x, or of it with noise: time averages with white signals over the
    rational numbers, and averages over a period of 3 over every ordered field.

    archimedean_field == an ordered field without infinite numbers
         plain_stable == A = 0 is stable
           quasi_part == a linear image of a quasi-stationary signal is quasi-stationary
             averaged == the plain system with these white signals *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary LimitsVocabulary MeansVocabulary ExampleVocabulary Means InstancesOfLimits OrderNames.
From faultspace Require MeanLimits TimeAverages WhiteSources NoisyMeans PeriodicSignals PeriodicMeans.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** The field is kept abstract, so that nothing is computed with rational numbers. *)
Lemma archimedean_field : exists K : realFieldType, archimedean K.
Proof.
exists [the realFieldType of rat : Type] => a; exists `|numq a|.+1%N; apply: le_lt_trans (ler_norm a) _.
apply: le_lt_trans (_ : `|(numq a)%:~R| < _); last by rewrite -intr_norm -natr_absz ltr_nat ltnSn.
by rewrite numqE normrM ler_peMr ?normr_ge0 // -intr_norm normr_denq -[1]/(1%:~R) ler_int -gtz0_ge1 denq_gt0.
Qed.

Lemma plain_stable (K : realFieldType) n : stable (0 : 'M[K]_n).
Proof. by move=> eps eps0; exists 1%N => i j; rewrite /= mulmx0 mxE normr0. Qed.

Lemma quasi_part (K : fieldType) (E : (nat -> K) -> K -> Prop) a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) M : mean E ->
  (forall t, g t = f t *m M) -> quasi_stationary E f -> quasi_stationary E g.
Proof.
move=> isE e quasi l; have [R h] := quasi l; exists (M^T *m R *m M).
by apply: (covariance_ext isE) (covariance_images isE M M h) => t; rewrite /later e.
Qed.

Lemma averaged (K : realFieldType) : archimedean K -> exists (E : (nat -> K) -> K -> Prop) (u v x y : nat -> 'rV[K]_1),
  [/\ mean E /\ process (plain K) (1%:M : 'M_1) 0 u v x y, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)),
    uncorrelated E u v, autoregressive_input E 0 (fun=> 0) u u /\ knows_nothing_before E u x & forall s, excites E s u].
Proof.
move=> arch; have isE := TimeAverages.time_average_mean arch.
have [x [y [[model _] quasi [_ _ uv] [ar ux _ _] exc]]] :=
  WhiteSources.driven_exist arch (1%:M : 'M_(1, 1)) (0 : 'M_(1, 1)) 0 (@plain_stable K 1 : stable (sysA (plain K))).
exists (@time_average K), (fun t => lsubmx (white_source K (1 + 1) t)), (fun t => rsubmx (white_source K (1 + 1) t)), x, y.
by split; [split; [exact: isE|exact: model]|exact: quasi|exact: uv|split; [exact: ar|exact: ux]|exact: exc].
Qed.

(** ** proposition-1, two-sided *)

Theorem mean_two_sided_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y q s L,
  mean E /\ process S B D u v x y /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\ uncorrelated E u v /\
  limit E (successive 0 q u) (successive q s u) (successive q s y) L.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE model] quasi uv _ exc]]]]]] := averaged arch.
have [L lim] := MeanLimits.limit_exists 1 isE model quasi (exc 1%N).
by exists K, E, 1%N, 1%N, 1%N, 1%N, (plain _), 1%:M, 0, u, v, x, y, 1%N, 1%N, L.
Qed.

Theorem mean_two_sided_b_d_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y s Ruu Ruy W,
  mean E /\ process S B D u v x y /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\ uncorrelated E u v /\
  (0 < s)%N /\ row_free (O S s.-1) /\ covariance E (successive 0 s u) (successive 0 s u) Ruu /\
  covariance E (successive 0 s u) (successive 0 s y) Ruy /\ W *m Ruu = 1%:M.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE model] quasi uv _ exc]]]]]] := averaged arch.
have [L [_ [Ruu [_ [Ruy [_ [_ uu _ uy _]]]]]]] := MeanLimits.limit_exists 0 isE model quasi (exc 2%N).
have [R uu' unit] := exc 2%N; have e := covariance_unique isE uu uu'.
exists K, E, 1%N, 1%N, 1%N, 1%N, (plain _), 1%:M, 0, u, v, x, y, 2%N, Ruu, Ruy, (invmx Ruu).
do 5 (split; first by []); split; first exact: plain_observed.
by do 2 (split; first by []); rewrite e mulVmx.
Qed.

(** With white noise of the state and of the output. *)
Theorem mean_noise_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v e w x y,
  mean E /\ noisy_process S B D u v e w x y /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)) /\
  uncorrelated E u v /\ uncorrelated E u e /\ uncorrelated E u w /\
  (exists q s L, limit E (successive 0 q u) (successive q s u) (successive q s y) L) /\
  exists s Ruu Ruy W, (0 < s)%N /\ row_free (O S s.-1) /\ covariance E (successive 0 s u) (successive 0 s u) Ruu /\
    covariance E (successive 0 s u) (successive 0 s y) Ruy /\ W *m Ruu = 1%:M.
Proof.
have [K arch] := archimedean_field; have isE := TimeAverages.time_average_mean arch.
have [u [v [e [w [x [y [[model _] quasi _ [uv ue uw _] [_ exc]]]]]]]] :=
  WhiteSources.noisy_exist (1%:M : 'M_(1, 1)) (0 : 'M_(1, 1)) 0 arch (@plain_stable K 1 : stable (sysA (plain K))).
have fault := NoisyMeans.noise_is_fault model.
have [L [X [Ruu [X' [Ruy [M [zu uu zy uy left]]]]]]] := MeanLimits.limit_exists 0 isE fault quasi (exc 2%N).
have [R uu' unit] := exc 2%N; have same := covariance_unique isE uu uu'.
exists K, (@time_average K), 1%N, 1%N, 1%N, 1%N, (plain _), 1%:M, 0, u, v, e, w, x, y.
do 6 (split; first by []); split; first by exists 0%N, 2%N, L; exists X, Ruu, X', Ruy, M.
exists 2%N, Ruu, Ruy, (invmx Ruu); split; first by []; split; first exact: plain_observed.
by do 2 (split; first by []); rewrite same mulVmx.
Qed.

(** ** proposition-1, all of the range *)

Theorem mean_autoregressive_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y q s a Au e L,
  mean E /\ process S B D u v x y /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\ uncorrelated E u v /\
  autoregressive_input E a Au u e /\ knows_nothing_before E (later a e) x /\ excites E s u /\ (0 < s)%N /\ (a <= s)%N /\ (n <= q)%N /\
  (forall z, steered S B z) /\ limit E (successive 0 q u) (successive q s u) (successive q s y) L.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE model] quasi uv [ar ux] exc]]]]]] := averaged arch.
have [L lim] := MeanLimits.limit_exists 1 isE model quasi (exc 1%N).
exists K, E, 1%N, 1%N, 1%N, 1%N, (plain _), 1%:M, 0, u, v, x, y, 1%N, 1%N, 0%N, (fun=> 0), u, L.
do 5 (split; first by []); split; first by move=> l; apply: (covariance_ext isE) (ux l) => t //; rewrite /later addn0.
by do 4 (split; first by []); split; first exact: plain_steered.
Qed.

Theorem mean_long_past_instance (K : realFieldType) : exists (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x z y q s r L,
  mean E /\ positive E /\ process S B D u v x y /\ stable (sysA S) /\ uncorrelated E u v /\
  (forall t, z t.+1 = z t *m sysA S + u t *m B) /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t))) /\
  order_of_spectrum E r u /\ (n + r <= q)%N /\ excites E s u /\ excites E (n + s) u /\ (forall z, steered S B z) /\
  limit E (successive 0 q u) (successive q s u) (successive q s y) L.
Proof.
have [isE pos _ _] := PeriodicMeans.period_averages K.
have [u [v [x [z [y [[model driven] uv [st steer] [order exc1 exc2] quasis]]]]]] := PeriodicSignals.periodic_signals K.
have [_ _ [_ quasi]] := quasis 1%:M.
have quasi' : quasi_stationary (@period_average K) (fun t => row_mx (row_mx (u t) (v t)) (x t)).
  apply: (quasi_part (M := block_mx 1%:M 0 0 (col_mx 1%:M 0)) isE) quasi => t.
  by rewrite mul_row_block mul_row_col !mulmx1 !mulmx0 !addr0 add0r.
have [L lim] := MeanLimits.limit_exists 3 isE model quasi' exc1.
exists (@period_average K), 1%N, 1%N, 1%N, 1%N, (System 0 1%:M 1%:M 0), 1%:M, 0, u, v, x, z, y, 3%N, 1%N, 2%N, L.
by do 12 (split; first by []).
Qed.

(** A filter of one state that delays u by a sample. *)
Theorem filtered_inputs_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) r nu ne (A : 'M_r) (B : 'M_(ne, r)) (C : 'M_(r, nu))
    (D : 'M_(ne, nu)) u e xi,
  mean E /\ (forall t, xi t.+1 = xi t *m A + e t *m B /\ u t = xi t *m C + e t *m D) /\ knows_nothing_before E (later 1 e) u /\
  quasi_stationary E (fun t => row_mx (u t) (xi t)).
Proof.
have [K arch] := archimedean_field; have isE := TimeAverages.time_average_mean arch.
have [x [y [[model _] quasi _ [_ ux _ _] _]]] :=
  WhiteSources.driven_exist arch (1%:M : 'M_(1, 1)) (0 : 'M_(1, 1)) 0
    (@plain_stable K 1 : stable (sysA (System 0 0 1%:M 0 : system K 1 1 1))).
exists K, (@time_average K), 1%N, 1%N, 1%N, 0, 1%:M, 1%:M, 0, x; eexists; exists x; split; first exact: isE.
split; first by move=> t; split; [have [-> _] := model t; rewrite [X in _ + X]mulmx0 addr0|rewrite mulmx1 mulmx0 addr0].
split; first by move=> l; apply: (covariance_ext isE) (ux l.+1) => t; rewrite /later // [(t + l + 1)%N]addn1 [(t + l.+1)%N]addnS.
apply: (quasi_part (M := row_mx (col_mx 0 1%:M) (col_mx 0 1%:M)) isE) quasi => t.
by rewrite mul_mx_row mul_row_col mulmx0 add0r mulmx1.
Qed.

(** ** proposition-1, two-sided-output-error *)

(** z' is z but for its start; a model of the same B and D has the same mean square error. *)
Theorem mean_output_error_instance (K : realFieldType) : exists (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p)
    (B B' : 'M_(nu, n)) (D D' : 'M_(nu, p)) u v x z z' y R R',
  mean E /\ positive E /\ process S B D u v x y /\ stable (sysA S) /\ uncorrelated E u v /\
  (forall t, z t.+1 = z t *m sysA S + u t *m B) /\ (forall t, z' t.+1 = z' t *m sysA S + u t *m B') /\
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t)))) /\
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R /\
  covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' /\
  excites E n.+1 u /\ observable S /\ \tr R' = \tr R.
Proof.
have [isE pos _ _] := PeriodicMeans.period_averages K.
have [u [v [x [z [y [[model driven] uv [st steer] [order exc1 exc2] quasis]]]]]] := PeriodicSignals.periodic_signals K.
have [z' driven' [quasi _]] := quasis 1%:M; pose S : system K 1 1 1 := System 0 1%:M 1%:M 0; pose D : 'M[K]_1 := 0.
have [P0 hP] := quasi 0%N; pose w t := row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t))).
have error (s : nat -> 'rV[K]_1) M : (forall t, s t = w t *m M) -> exists R, covariance (@period_average K)
    (fun t => y t - (s t *m sysC S + u t *m D)) (fun t => y t - (s t *m sysC S + u t *m D)) R.
  move=> es; pose N : 'M[K]_(1 + 1 + (1 + (1 + 1)), 1) := col_mx 0 (col_mx 1%:M 0) - M; exists (N^T *m P0 *m N).
  have e t : w t *m N = y t - (s t *m sysC S + u t *m D).
    rewrite mulmxBr -es mul_row_col mulmx0 add0r mul_row_col mulmx0 addr0 mulmx1; have [_ ->] := model t.
    by rewrite /= !mulmx1 !mulmx0 !addr0.
  by apply: (covariance_ext isE) (covariance_images isE N N hP) => t; rewrite /later ?addn0 e.
have [R hR] : exists R, covariance (@period_average K) (fun t => y t - (z t *m sysC S + u t *m D))
    (fun t => y t - (z t *m sysC S + u t *m D)) R.
  apply: (error z (col_mx 0 (col_mx 0 (col_mx 1%:M 0)))) => t.
  by rewrite /w !mul_row_col !mulmx0 !add0r addr0 mulmx1.
have [R' hR'] : exists R, covariance (@period_average K) (fun t => y t - (z' t *m sysC S + u t *m D))
    (fun t => y t - (z' t *m sysC S + u t *m D)) R.
  apply: (error z' (col_mx 0 (col_mx 0 (col_mx 0 1%:M)))) => t.
  by rewrite /w !mul_row_col !mulmx0 !add0r mulmx1.
have same t : z' (t + 1)%N = z (t + 1)%N by rewrite addn1 driven driven' !mulmx0.
have eR : R' = R.
  apply: (covariance_unique isE (covariance_later isE 1 hR')); apply: (covariance_ext isE) (covariance_later isE 1 hR) => t;
  by rewrite /later same.
exists (@period_average K), 1%N, 1%N, 1%N, 1%N, S, 1%:M, 1%:M, D, D, u, v, x, z, z', y, R, R'.
do 11 (split; first by []); split; first by apply: (plain_observed K (k := 1)).
by rewrite eR.
Qed.

(** ** What knows nothing of the states *)

Theorem mean_past_states_instance : exists (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y,
  mean E /\ positive E /\ process S B D u v x y /\ stable (sysA S) /\
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\ uncorrelated E u v /\
  (exists a Au e, autoregressive_input E a Au u e) /\ knows_nothing_before E (later 1 v) v.
Proof.
have [K arch] := archimedean_field; have isE := TimeAverages.time_average_mean arch.
have [x [y [[model _] quasi [_ _ uv] [ar _ vv _] _]]] :=
  WhiteSources.driven_exist arch (1%:M : 'M_(1, 1)) (0 : 'M_(1, 1)) 0 (@plain_stable K 1 : stable (sysA (plain K))).
exists K, (@time_average K), 1%N, 1%N, 1%N, 1%N, (plain K), 1%:M, 0; do 2 eexists; exists x, y.
split; first exact: isE; split; first exact: TimeAverages.time_average_positive; split; first exact: model.
split; first exact: plain_stable; split; first exact: quasi; split; first exact: uv.
by split; [do 3 eexists; exact: ar|exact: vv].
Qed.

(** ** Time averages *)

Theorem time_averages_exist_instance : exists (K : realFieldType) n m p (S : system K n m p),
  archimedean K /\ stable (sysA S).
Proof.
by have [K arch] := archimedean_field; exists K, 1%N, 1%N, 1%N, (plain _); split; [|exact: plain_stable].
Qed.

Theorem noisy_signals_exist_instance : exists (K : realFieldType) n m p (S : system K n m p),
  archimedean K /\ stable (sysA S).
Proof.
by have [K arch] := archimedean_field; exists K, 1%N, 1%N, 1%N, (plain _); split; [|exact: plain_stable].
Qed.
