(** Instances for further headlines on means of signals, and for those on the example of section V. What is said of past outputs is met over
    every field, or every ordered one, in the mean of blocks (block_sum): the plain system, x(k+1) = u(k) + v(k), y = x, has a white input
    u and a white fault v, or also noise. The fault that follows the input is that of the system unseen. Time averages are over some field
    without infinite numbers, and the eigenvector of the example is over the residues modulo 23.

    past_outputs_averaged == the plain system so, with a limit of one past and two future samples, past outputs being instruments
          covariance_zero == of signals whose products are zero
          example_excited == faults and an initial state for which the data of the example excite *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary MeansVocabulary ExampleVocabulary Persistency Means InstancesOfLimits InstancesOfMeans.
From faultspace Require Import InstancesOfWindows InstancesOfInputs.
From faultspace Require Existence SectionFive MeanLimits Forgetting PulseMeans WhiteMeans NoisyMeans PeriodicMeans.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** Means exist *)

(** 1, -1, 1, -1, ... has the period 2. *)
Theorem means_exist_instance (K : realFieldType) : exists (f : nat -> K) d, (0 < d)%N /\ (forall t, f (t + d)%N = f t).
Proof. by exists (fun t => (-1) ^+ t), 2%N; split=> // t; rewrite exprD sqrrN expr1n mulr1. Qed.

(** ** past-outputs *)

Lemma past_outputs_averaged (K : fieldType) : let E := @block_sum K in exists (u v x y : nat -> 'rV[K]_1) L,
  [/\ process (plain K) (1%:M : 'M_1) 0 u v x y, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v,
    [/\ white_noise E u, white_noise E v & knows_nothing_before E v x]
  & limit E (fun t => row_mx (successive 0 1 u t) (successive 0 1 y t)) (successive 1 2 u) (successive 1 2 y) L].
Proof.
move=> E; have [u [v [x [y [model quasi uv [wu wv _ vx] _]]]]] := PulseMeans.white_pulses K; have isE := PulseMeans.block_mean K.
have [L lim] := MeanLimits.past_outputs_limit_exists 1 isE model quasi (WhiteMeans.white_excites isE 2 wu).
by exists u, v, x, y, L.
Qed.

Theorem mean_past_outputs_instance (K : fieldType) : exists (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y q s L,
  mean E /\ process S B D u v x y /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\ uncorrelated E u v /\
  knows_nothing_before E (later 1 v) v /\ knows_nothing_before E v x /\
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L.
Proof.
have [u [v [x [y [L [model quasi uv [wu wv vx] lim]]]]]] := past_outputs_averaged K; have isE := PulseMeans.block_mean K.
exists (@block_sum K), 1%N, 1%N, 1%N, 1%N, (plain K), 1%:M, 0, u, v, x, y, 1%N, 2%N, L.
do 4 (split; first by []); split; first exact: WhiteMeans.white_before.
by split.
Qed.

(** R is 0: the fault is white. *)
Theorem mean_coloured_fault_instance (K : realFieldType) : exists (E : (nat -> K) -> K -> Prop) n m nu (S : system K n m n)
    (B : 'M_(nu, n)) (D : 'M_(nu, n)) u v x y q s R L,
  mean E /\ positive E /\ process S B D u v x y /\ stable (sysA S) /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\
  uncorrelated E u v /\ (forall l, (2 < l)%N -> covariance E (later l v) v 0) /\ covariance E v (later 2 v) R /\ sysC S = 1%:M /\
  sysG S = 0 /\ (0 < q)%N /\ (1 < s)%N /\
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L /\ (L <= O S s)%MS.
Proof.
have [u [v [x [y [L [model quasi uv [wu wv vx] lim]]]]]] := past_outputs_averaged K; have isE := PulseMeans.block_mean K.
have before := WhiteMeans.white_before isE wv.
exists (@block_sum K), 1%N, 1%N, 1%N, (plain K), 1%:M, 0, u, v, x, y, 1%N, 2%N, 0, L.
split; first exact: isE; split; first exact: PulseMeans.block_positive; split; first exact: model; split; first exact: plain_stable.
do 2 (split; first by []); split.
  by case=> // l _; apply: (covariance_ext isE) (before l) => t //; rewrite /later addn1 addnS.
split; first exact: (wv 2%N); do 4 (split; first by []); split; first exact: lim.
by have [M ->] := MeanLimits.mean_past_outputs isE model quasi uv before vx lim; exact: submxMl.
Qed.

(** One half of a white signal is the fault and the other the noise of the state; so is that of the output. *)
Theorem mean_noise_past_outputs_instance (K : realFieldType) : exists (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v e w x y q s L,
  mean E /\ positive E /\ noisy_process S B D u v e w x y /\ stable (sysA S) /\ uncorrelated E u v /\ uncorrelated E u e /\
  uncorrelated E u w /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)) /\
  knows_nothing_before E (later 1 (disturbances v e w)) (disturbances v e w) /\
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L.
Proof.
have [u [f [x [y [L' [model quasi uf [wu wf _] _]]]]]] := past_outputs_averaged K; have isE := PulseMeans.block_mean K.
pose c : 'M[K]_1 := 2%:R^-1%:M; pose v t := f t *m c; pose d := disturbances v v v.
have halves t : v t + v t = f t by rewrite /v -mulmxDr -raddfD (_ : _ + _ = 1) ?mulmx1 // [RHS]splitr !mul1r.
have parts t : d t = f t *m row_mx (row_mx c c) c by rewrite !mul_mx_row.
have noisy : noisy_process (plain K) (1%:M : 'M_1) 0 u v v v x (fun t => x t + v t).
  move=> t; split; last by rewrite /= mulmx1 !mulmx0 !addr0.
  by have [-> _] := model t; rewrite /= !mulmx1 !mulmx0 !add0r -addrA halves.
have quasi' : quasi_stationary (@block_sum K) (fun t => row_mx (row_mx (u t) (d t)) (x t)).
  apply: (quasi_part (M := block_mx (block_mx 1%:M 0 0 (row_mx (row_mx c c) c)) 0 0 1%:M) isE) quasi => t.
  by rewrite !mul_row_block !mulmx0 !mulmx1 !addr0 !add0r parts.
have uv : uncorrelated (@block_sum K) u v.
  move=> l; have [h1 h2] := uf l; have := covariance_mul isE c h1; have := covariance_mul isE c h2; rewrite mul0mx => h2' h1'.
  by split; [apply: (covariance_ext isE) h1'|apply: (covariance_ext isE) h2'].
have [L lim] := MeanLimits.past_outputs_limit_exists 1 isE (NoisyMeans.noise_is_fault noisy) quasi' (WhiteMeans.white_excites isE 2 wu).
exists (@block_sum K), 1%N, 1%N, 1%N, 1%N, (plain K), 1%:M, 0, u, v, v, v, x, (fun t => x t + v t), 1%N, 2%N, L.
split; first exact: isE; split; first exact: PulseMeans.block_positive; split; first exact: noisy; split; first exact: plain_stable.
do 4 (split; first by []); split; last exact: lim.
move=> l; have := covariance_images isE (row_mx (row_mx c c) c) (row_mx (row_mx c c) c) (WhiteMeans.white_before isE wf l).
by rewrite mulmx0 mul0mx; apply: (covariance_ext isE) => t; rewrite -/d ?parts // /later -parts.
Qed.

(** ** settle-1, not-both, as means *)

Lemma covariance_zero (K : fieldType) (E : (nat -> K) -> K -> Prop) a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) : mean E ->
  (forall t i j, f t 0 i * g t 0 j = 0) -> covariance E f g 0.
Proof.
by move=> isE zero i j; rewrite [X in E _ X]mxE; apply: (mean_ext isE) (mean_zero isE) => t; rewrite zero.
Qed.

(** u is w a sample later, and so is what it makes of the state. *)
Theorem mean_settle_1_not_both_instance (K : realFieldType) : exists (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) (Phi : 'M_(nu, m)) u w x z y q s L R,
  mean E /\ positive E /\ process S B D u (fun t => w t *m Phi) x y /\ (forall t, w t.+1 = u t) /\ stable (sysA S) /\ white_noise E u /\
  (forall t, z t.+1 = z t *m sysA S + u t *m B) /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))) /\
  (0 < q)%N /\ (0 < s)%N /\ row_free (O S s.-1) /\ observable S /\
  limit E (successive 0 q u) (successive q s u) (successive q s y) L /\ (L <= O S s)%MS /\
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R /\
  (forall (B' : 'M_(nu, n)) (D' : 'M_(nu, p)) z' R', (forall t, z' t.+1 = z' t *m sysA S + u t *m B') ->
    covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' -> \tr R <= \tr R').
Proof.
have [w [_ [_ [_ [_ _ _ [ww _ _ _] _]]]]] := PulseMeans.white_pulses K; have isE := PulseMeans.block_mean K.
have pos := @PulseMeans.block_positive K; set E := @block_sum K in isE pos ww; pose u := later 1 w; pose S := unseen K.
have wu : white_noise E u by move=> l; apply: (covariance_ext isE) (covariance_later isE 1 (ww l)) => // t; rewrite /later addnAC.
have next t : w t.+1 = u t by rewrite /u /later addn1.
have still t : w t.+1 = w t *m sysA S + u t *m 1%:M by rewrite /= mulmx0 add0r mulmx1.
have model : process S (1%:M : 'M_1) 0 u (fun t => w t *m first_of_two K) w w.
  by move=> t; rewrite -!mulmxA /= mul_row_col !mulmx0 mul0mx addr0 !mulmx0 !mulmx1 !addr0 add0r.
have quiet : process S (1%:M : 'M_1) 0 u (fun=> 0) w w by move=> t; rewrite /= !mulmx0 !mul0mx !mulmx1 !addr0 add0r.
have made a (f : nat -> 'rV[K]_a) M M' : (forall t, f t = u t *m M + w t *m M') -> quasi_stationary E f.
  move=> ef l; have cw : Forgetting.combination w f.
    have cw := Forgetting.combination_part w 1%:M; have cu := Forgetting.combination_later 1 cw.
    apply: Forgetting.combination_ext (Forgetting.combination_add (Forgetting.combination_mul M cu) (Forgetting.combination_mul M' cw)).
    by move=> t; rewrite ef /later !mulmx1.
  have quasi k : exists R, covariance E w (later k w) R by eexists; exact: ww.
  exact: (Forgetting.combination_covariance isE quasi cw (Forgetting.combination_later l cw)).
have quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (0 : 'rV_(1 + 1))) (w t)).
  apply: (made _ _ (row_mx (row_mx 1%:M 0) 0) (row_mx (row_mx 0 0) 1%:M)) => t.
  by rewrite !mul_mx_row !mulmx1 !mulmx0 !add_row_mx !addr0 add0r.
have [L lim] := MeanLimits.limit_exists 1 isE quiet quasi (WhiteMeans.white_excites isE 2 wu).
have inside : (L <= O S 2)%MS.
  have [l|M [_ ->]] := MeanLimits.mean_containment isE quiet quasi _ lim; last exact: submxMl.
  by split; apply: covariance_zero => // t i j; rewrite !mxE ?mulr0 ?mul0r.
exists E, 1%N, (1 + 1)%N, 1%N, 1%N, S, 1%:M, 0, (first_of_two K), u, w, w, w, w, 1%N, 2%N, L, 0.
do 4 (split; first by []); split; first exact: plain_stable; do 2 (split; first by []); split.
  apply: (made _ _ (row_mx (row_mx 1%:M 0) 0) (row_mx (row_mx 0 1%:M) (row_mx 1%:M 1%:M))) => t.
  by rewrite !mul_mx_row !mulmx1 !mulmx0 !add_row_mx !addr0 !add0r.
do 2 (split; first by []); do 2 (split; first exact: unseen_observed); do 2 (split; first by []); split.
  by apply: covariance_zero => // t i j; rewrite /= mulmx1 mulmx0 addr0 subrr !mxE mulr0.
move=> B' D' z' R' _ hR'; rewrite mxtrace0; apply: sumr_ge0 => i _; apply: (pos _ _ _).
by apply: (mean_ext isE) (hR' i i) => t; rewrite expr2.
Qed.

Theorem mean_settle_1_signals_exist_instance : exists (K : realFieldType) n m p (S : system K n m p), archimedean K /\ stable (sysA S).
Proof.
by have [K arch] := archimedean_field; exists K, 1%N, 1%N, 1%N, (plain K); split; [|exact: plain_stable].
Qed.

(** ** Time averages *)

Theorem coloured_fault_exists_instance : exists (K : realFieldType) n (S : system K n 1 n),
  archimedean K /\ stable (sysA S) /\ sysC S = 1%:M /\ sysG S = 0 /\ sysF S != 0.
Proof.
have [K arch] := archimedean_field; exists K, 1%N, (plain K); split; first exact: arch; split; first exact: plain_stable.
by do 2 (split; first by []); exact: oner_neq0.
Qed.

Theorem time_averages_instance : exists (K : realFieldType), archimedean K /\ exists (f : nat -> K) a, period_average f a.
Proof.
have [K arch] := archimedean_field; exists K; split; first exact: arch.
by exists (fun=> 1), 1; have [] := PeriodicMeans.period_averages K.
Qed.

Theorem time_averages_white_instance : exists (K : realFieldType), archimedean K.
Proof. exact: archimedean_field. Qed.

(** ** example-v *)

Theorem example_v_controllability_instance : exists (K : fieldType) (a : K), example_root a.
Proof. by have [root _] := SectionFive.example_roots; exists (field_of 'F_23), 2%:R. Qed.

Theorem example_v_zeros_instance (K : fieldType) : exists (a : K) g d, let S := example_v a in
  gcd_of_minors (pencil S) g /\ infinite_zeros S d.
Proof.
have [exist _ _ _] := Existence.zeros_exist (example_v (1 : K)); have [g [d zeros]] := exist (@SectionFive.example_left_invertible K 1).
by exists 1, g, d.
Qed.

(** One fault at a late time, and the third state, from which the others follow: x, x A and x A^2 are independent. *)
Lemma example_excited (K : fieldType) (a : K) s : exists x v N, row_full (excitation (example_v a) x v N s).
Proof.
pose S := example_v a; pose e i : 'rV[K]_3 := \row_j (i == j :> nat)%:R.
do 3 eexists; apply: (@persistency_full _ _ _ _ S (e 2%N) _ (3 + s)); first exact: (impulse_excites K (2 + s)).
set U := excitable S (e 2%N); have stays (x : 'rV_3) : (x <= U)%MS -> (x *m sysA S <= U)%MS.
  by move=> xU; apply: submx_trans (submxMr _ xU) (orbit_stays _ _).
have e2 : (e 2%N <= U)%MS by exact: excitable_initial.
have next i c : (i < 2)%N -> e i.+1 *m sysA S = e i + c *: e 2%N -> (e i.+1 <= U)%MS -> (e i <= U)%MS.
  move=> i2 /(congr1 (fun M => M - c *: e 2%N)); rewrite addrK => <- /stays iU.
  by apply: addmx_sub => //; rewrite eqmx_opp scalemx_sub.
have e1 : (e 1%N <= U)%MS.
  by apply: (next _ (1 / 4%:R)) e2 => //; apply: SectionFive.row3; rewrite !mxE !big_ord_recl big_ord0 !mxE /=
    ?(mul0r, mulr0, mul1r, mulr1, add0r, addr0).
have e0 : (e 0%N <= U)%MS.
  by apply: (next _ (3%:R / 4%:R)) e1 => //; apply: SectionFive.row3; rewrite !mxE !big_ord_recl big_ord0 !mxE /=
    ?(mul0r, mulr0, mul1r, mulr1, add0r, addr0).
rewrite -sub1mx; apply/row_subP => i; have -> : row i 1%:M = e i by apply/rowP => j; rewrite !mxE -val_eqE.
by case: i => -[|[|[|//]]] lt.
Qed.

Theorem example_v_data_instance (K : fieldType) : exists (a : K) x v N, let S := example_v a in row_full (excitation S x v N 6).
Proof. by have [x [v [N full]]] := example_excited (1 : K) 6; exists 1, x, v, N. Qed.
