(** Instances for the headlines on means of signals with noise where z, what the inputs make of the state, is a signal of its own: the plain
    system with noise of the state and of the output, x(k+1) = u(k) + v(k) + e(k), y(k) = x(k) + w(k), so that z(k+1) = u(k), all of u, v,
    e and w being white signals over the rational numbers.

    noisy_averaged == time averages of these signals *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary LimitsVocabulary MeansVocabulary ExampleVocabulary Means InstancesOfLimits InstancesOfMeans.
From faultspace Require MeanLimits TimeAverages WhiteSources NoisyMeans.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma noisy_averaged (K : realFieldType) : archimedean K -> let E := @time_average K in exists u v e w x z y : nat -> 'rV[K]_1,
  [/\ noisy_process (plain K) (1%:M : 'M_1) 0 u v e w x y, forall t, z t.+1 = z t *m sysA (plain K) + u t *m 1%:M,
    quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (row_mx (x t) (z t))),
    [/\ uncorrelated E u v, uncorrelated E u e & uncorrelated E u w]
  & [/\ white_noise E u, autoregressive_input E 0 (fun=> 0) u u & forall s, excites E s u]].
Proof.
move=> arch E; have isE : mean E := TimeAverages.time_average_mean arch.
pose F : 'M[K]_(1 + 1 + 1, 1 + 1) := col_mx (col_mx (row_mx 1%:M 0) (row_mx 1%:M 0)) 0.
pose S : system K (1 + 1) (1 + 1 + 1) 1 := System 0 F 0 0.
have [xz [y' [[model _] quasi [wu _ ud] [ar _ _ _] exc]]] :=
  WhiteSources.driven_exist arch (row_mx 1%:M 1%:M : 'M_(1, 1 + 1)) (0 : 'M_(1, 1)) 0 (@plain_stable K _ : stable (sysA S)).
set u := fun t => lsubmx (white_source K (1 + (1 + 1 + 1)) t); set d := fun t => rsubmx (white_source K (1 + (1 + 1 + 1)) t).
pose v t := lsubmx (lsubmx (d t)); pose e t := rsubmx (lsubmx (d t)); pose w t := rsubmx (d t).
pose x t := lsubmx (xz t); pose z t := rsubmx (xz t).
have parts t : disturbances v e w t = d t by rewrite /disturbances /v /e /w !hsubmxK.
have next t : xz t.+1 = row_mx (u t + v t + e t) (u t).
  have [-> _] := model t; rewrite -/(u t) -/(d t) -parts /disturbances /= mulmx0 add0r mul_mx_row !mulmx1 !mul_row_col.
  by rewrite !mul_mx_row !mulmx1 !mulmx0 addr0 !add_row_mx addr0 !addrA addr0.
have part b (M : 'M_(1 + 1 + 1, b)) g : (forall t, g t = d t *m M) -> uncorrelated E u g.
  move=> eg l; have [h1 h2] := ud l.
  have := covariance_images isE 1%:M M h1; have := covariance_images isE 1%:M M h2; rewrite !mulmx0 !mul0mx => h2' h1'.
  by split; [apply: (covariance_ext isE) h1'|apply: (covariance_ext isE) h2'] => t; rewrite ?mulmx1 // /later -eg.
exists u, v, e, w, x, z, (fun t => x t + w t); split.
- move=> t; split; last by rewrite /= mulmx1 !mulmx0 !addr0.
  by rewrite /x next row_mxKl /= mulmx0 add0r !mulmx1.
- by move=> t; rewrite /z next row_mxKr /= mulmx0 add0r mulmx1.
- apply: (quasi_part (M := 1%:M) isE) quasi => t; by rewrite mulmx1 parts -[xz t]hsubmxK.
- split.
  + by apply: (part _ (col_mx (col_mx 1%:M 0) 0)) => t; rewrite -parts !mul_row_col mulmx1 !mulmx0 !addr0.
  + by apply: (part _ (col_mx (col_mx 0 1%:M) 0)) => t; rewrite -parts !mul_row_col mulmx1 !mulmx0 add0r addr0.
  by apply: (part _ (col_mx 0 1%:M)) => t; rewrite -parts mul_row_col mulmx1 mulmx0 add0r.
by split.
Qed.

(** ** proposition-1, all of the range: both parts of the theorem at once, u being white *)

Theorem mean_noise_range_instance : exists (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v e w x z y q s L,
  mean E /\ positive E /\ noisy_process S B D u v e w x y /\ stable (sysA S) /\
  uncorrelated E u v /\ uncorrelated E u e /\ uncorrelated E u w /\ excites E s u /\ (forall z, steered S B z) /\
  limit E (successive 0 q u) (successive q s u) (successive q s y) L /\
  (exists a Au i, quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)) /\ autoregressive_input E a Au u i /\
    (0 < s)%N /\ (a <= s)%N /\ (n <= q)%N) /\
  exists r, (forall t, z t.+1 = z t *m sysA S + u t *m B) /\
    quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (row_mx (x t) (z t))) /\
    order_of_spectrum E r u /\ (n + r <= q)%N /\ excites E (n + s) u.
Proof.
have [K arch] := archimedean_field; have isE := TimeAverages.time_average_mean arch.
have [u [v [e [w [x [z [y [model driven quasi [uv ue uw] [wu ar exc]]]]]]]]] := noisy_averaged arch.
have quasi' : quasi_stationary (@time_average K) (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)).
  apply: (quasi_part (M := block_mx 1%:M 0 0 (col_mx 1%:M 0)) isE) quasi => t.
  by rewrite mul_row_block mul_row_col !mulmx1 !mulmx0 !addr0 add0r.
have [L lim] := MeanLimits.limit_exists 1 isE (NoisyMeans.noise_is_fault model) quasi' (exc 1%N).
exists K, (@time_average K), 1%N, 1%N, 1%N, 1%N, (plain _), 1%:M, 0, u, v, e, w, x, z, y, 1%N, 1%N, L.
split; first exact: isE; split; first exact: TimeAverages.time_average_positive; split; first exact: model.
split; first exact: plain_stable; do 3 (split; first by []); split; first exact: exc; split; first exact: plain_steered.
split; first exact: lim; split; first by exists 0%N, (fun=> 0), u.
exists 0%N; do 2 (split; first by []); split; last by split; [|exact: exc].
exists 1 => [|l]; first by rewrite monic1 size_poly1.
by apply: (covariance_ext isE) (wu l.+1) => t //; rewrite big_ord1 coefC eqxx scale1r addn0.
Qed.

(** ** proposition-1, two-sided-output-error: a model of the same B and D, as in mean_output_error_instance *)

Theorem mean_noise_output_error_instance : exists (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p)
    (B B' : 'M_(nu, n)) (D D' : 'M_(nu, p)) u v e w x z z' y R R',
  mean E /\ positive E /\ noisy_process S B D u v e w x y /\ stable (sysA S) /\
  uncorrelated E u v /\ uncorrelated E u e /\ uncorrelated E u w /\
  (forall t, z t.+1 = z t *m sysA S + u t *m B) /\ (forall t, z' t.+1 = z' t *m sysA S + u t *m B') /\
  quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (row_mx (x t) (row_mx (z t) (z' t)))) /\
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R /\
  covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' /\
  excites E n.+1 u /\ observable S /\ \tr R' = \tr R.
Proof.
have [K arch] := archimedean_field; have isE := TimeAverages.time_average_mean arch.
have [u [v [e [w [x [z [y [model driven quasi [uv ue uw] [wu ar exc]]]]]]]]] := noisy_averaged arch.
have [P hP] := quasi 0%N; pose s t := row_mx (row_mx (u t) (disturbances v e w t)) (row_mx (x t) (z t)).
pose N : 'M[K]_(1 + (1 + 1 + 1) + (1 + 1), 1) := col_mx (col_mx 0 (col_mx 0 1%:M)) (col_mx 1%:M (- 1%:M)).
have hR : covariance (@time_average K) (fun t => y t - (z t *m 1%:M + u t *m 0)) (fun t => y t - (z t *m 1%:M + u t *m 0)) (N^T *m P *m N).
  have error t : s t *m N = y t - (z t *m 1%:M + u t *m 0).
    have [_ ->] := model t; rewrite /s /disturbances /= !mul_row_col mulmxN !mulmx1 !mulmx0 !add0r !addr0.
    by rewrite addrCA addrA.
  by apply: (covariance_ext isE) (covariance_images isE N N hP) => t; rewrite /later ?addn0 error.
exists K, (@time_average K), 1%N, 1%N, 1%N, 1%N, (plain _), 1%:M, 1%:M, 0, 0, u, v, e, w, x, z, z, y; do 2 exists (N^T *m P *m N).
split; first exact: isE; split; first exact: TimeAverages.time_average_positive; split; first exact: model.
split; first exact: plain_stable; do 5 (split; first by []); split.
  apply: (quasi_part (M := block_mx 1%:M 0 0 (row_mx (col_mx 1%:M 0) (row_mx (col_mx 0 1%:M) (col_mx 0 1%:M)))) isE) quasi => t.
  by rewrite mul_row_block !mul_mx_row !mul_row_col !mulmx1 !mulmx0 !addr0 !add0r.
by do 3 (split; first by []); split; first exact: (plain_observed K (k := 1)).
Qed.
