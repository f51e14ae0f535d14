(** Every stable system, with any number of inputs and faults, driven by white signals: its covariances exist as limits of time averages. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary MeansVocabulary ExampleVocabulary Means WhiteMeans NoisyMeans.
From faultspace Require Import TimeAverages Responses OddPeriods.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Driven.
Variables (K : realFieldType) (nu m n p : nat).
Hypothesis arch : archimedean K.
Let E := @time_average K.
Let isE : mean E := time_average_mean arch.
Let w := @white_source K (nu + m).
Let u t : 'rV[K]_nu := lsubmx (w t).
Let v t : 'rV[K]_m := rsubmx (w t).
Let w_white : white_noise E w := @source_white K (nu + m) arch.

Lemma left_part t : u t = w t *m col_mx 1%:M 0.
Proof. by rewrite -[w t in RHS]hsubmxK mul_row_col mulmx1 mulmx0 addr0. Qed.
Lemma right_part t : v t = w t *m col_mx 0 1%:M.
Proof. by rewrite -[w t in RHS]hsubmxK mul_row_col mulmx1 mulmx0 add0r. Qed.

Theorem sources_white : [/\ white_noise E u, white_noise E v & uncorrelated E u v].
Proof.
split.
- by apply: (white_image isE w_white _ left_part); rewrite tr_col_mx mul_row_col trmx1 trmx0 mulmx1 mul0mx addr0.
- by apply: (white_image isE w_white _ right_part); rewrite tr_col_mx mul_row_col trmx1 trmx0 mulmx1 mul0mx add0r.
by apply: (white_parts isE w_white _ left_part right_part); rewrite tr_col_mx mul_row_col trmx1 trmx0 mulmx0 mul0mx addr0.
Qed.

Variables (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) (x0 : 'rV[K]_n).
Hypothesis st : stable (sysA S).
Let x := state (with_faults S (col_mx B (sysF S)) (0 : 'M_(nu + m, p))) x0 w.
Let x_step t : x t.+1 = x t *m sysA S + w t *m col_mx B (sysF S). Proof. by []. Qed.
Let w_quasi : quasi_stationary E w. Proof. by move=> l; eexists; exact: w_white. Qed.
Let w_short l : (1 <= l)%N -> covariance E w (later l w) 0. Proof. by case: l => // l _; exact: w_white. Qed.

Theorem driven_exist : exists x y, [/\ process S B D u v x y /\ x 0%N = x0,
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), [/\ white_noise E u, white_noise E v & uncorrelated E u v],
  [/\ autoregressive_input E 0 (fun=> 0) u u, knows_nothing_before E u x, knows_nothing_before E (later 1 v) v
    & knows_nothing_before E v x]
  & forall s, excites E s u].
Proof.
have [hu hv unc] := sources_white; exists x, (fun t => x t *m sysC S + u t *m D + v t *m sysG S).
have knows l : covariance E x (later l w) 0 by apply: (state_knows_nothing arch st x_step (source_bounded K (nu + m)) w_short).
have before c (z : nat -> 'rV[K]_c) (M : 'M[K]_(nu + m, c)) : (forall t, z t = w t *m M) -> knows_nothing_before E z x.
  move=> wz l; have := covariance_transpose isE (covariance_mul isE M (knows l)); rewrite mul0mx trmx0.
  by apply: (covariance_ext isE) => // t; rewrite /later wz.
split.
- by split=> // t; split=> //; rewrite x_step -[w t]hsubmxK mul_row_col addrA.
- move=> l; have [R hR] := responses_quasi arch st x_step (source_bounded K (nu + m)) w_quasi w_short l; exists R.
  by apply: (covariance_ext isE) hR => t; rewrite /later /u /v hsubmxK.
- by [].
- split; [exact: white_autoregressive|exact: before left_part|exact: white_before|exact: before right_part].
by move=> s; apply: white_excites.
Qed.

End Driven.

(** With noise of the states and of the outputs. *)
Theorem noisy_exist (K : realFieldType) n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) x0 : archimedean K ->
  stable (sysA S) -> let E := @time_average K in exists u v e w x y,
  [/\ noisy_process S B D u v e w x y /\ x 0%N = x0, quasi_stationary E (fun t => row_mx (row_mx (u t) (disturbances v e w t)) (x t)),
    [/\ white_noise E u, white_noise E v, white_noise E e & white_noise E w],
    [/\ uncorrelated E u v, uncorrelated E u e, uncorrelated E u w
      & knows_nothing_before E (later 1 (disturbances v e w)) (disturbances v e w)]
  & autoregressive_input E 0 (fun=> 0) u u /\ forall s, excites E s u].
Proof.
move=> arch st E; have isE : mean E := time_average_mean arch.
have [x [y [[model start] quasi [uw fw uf] [ar _ ff _] exciting]]] := driven_exist arch B D x0 (st : stable (sysA (noisy S))).
move: model quasi fw uf ff; set u := fun t => lsubmx _; set f := fun t => rsubmx _ => model quasi fw uf ff.
pose v t := lsubmx (lsubmx (f t)); pose e t := rsubmx (lsubmx (f t)); pose w t := rsubmx (f t).
have parts t : f t = disturbances v e w t by rewrite /disturbances !hsubmxK.
have vP t : v t = f t *m col_mx (col_mx 1%:M 0) 0 by rewrite parts !mul_row_col !mulmx0 mulmx1 !addr0.
have eP t : e t = f t *m col_mx (col_mx 0 1%:M) 0 by rewrite parts !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
have wP t : w t = f t *m col_mx 0 1%:M by rewrite parts !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
have seen a (g : nat -> 'rV_a) M : (forall t, g t = f t *m M) -> uncorrelated E u g.
  move=> eg l; have [h1 h2] := uf l; split.
    have := covariance_mul isE M h1; rewrite mul0mx; apply: (covariance_ext isE) => // t; by rewrite /later eg.
  have := covariance_mul isE M h2; rewrite mul0mx; apply: (covariance_ext isE) => // t; by rewrite eg.
exists u, v, e, w, x, y; split.
- split=> // k; have [-> ->] := model k; rewrite parts /= !mul_row_col !mulmx1 !mulmx0 !addr0 !addrA; by split.
- by move=> l; have [R hR] := quasi l; exists R; apply: (covariance_ext isE) hR => t; rewrite /later -!parts.
- split; [exact: uw|apply: (white_image isE fw _ vP)|apply: (white_image isE fw _ eP)|apply: (white_image isE fw _ wP)];
    by rewrite !tr_col_mx !mul_row_col ?trmx1 ?trmx0 ?mulmx1 ?mul0mx ?mulmx0 ?addr0 ?add0r.
- split; [exact: seen vP|exact: seen eP|exact: seen wP|].
  by move=> l; apply: (covariance_ext isE) (ff l) => t; rewrite /later -parts.
by [].
Qed.
