(** Instances for the headlines on two states: time averages over an ordered field without infinite numbers. The input and the fault are
    moving averages of white signals, u(t) = e(t+1) + e(t), A has a double pole at 1/2, and both states are measured.

    moving f == f(t+1) + f(t)
     twofold == the system *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary LimitsVocabulary MeansVocabulary Windows Means Forgetting LongPast.
From faultspace Require Import ErrorsReach WholeRange InstancesOfMeans.
From faultspace Require MeanLimits TimeAverages WhiteSources FollowingSources PartOfTheRange.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Definition moving (K : fieldType) a (f : nat -> 'rV[K]_a) t := f t.+1 + f t.

Section Moving.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop).
Hypotheses (isE : mean E) (pos : positive E).

Lemma moving_combination N (h : nat -> 'rV[K]_N) a (f : nat -> 'rV[K]_a) : combination h f -> combination h (moving f).
Proof. by move=> c; apply: combination_ext (combination_add (combination_later 1 c) c) => t; rewrite /later addn1. Qed.

Lemma moving_quasi a (f : nat -> 'rV[K]_a) : quasi_stationary E f -> quasi_stationary E (moving f).
Proof.
move=> quasi l; have c := moving_combination (combination_itself f).
exact: (combination_covariance isE quasi c (combination_later l c)).
Qed.

Lemma moving_uncorrelated a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) : uncorrelated E f g -> uncorrelated E (moving f) (moving g).
Proof.
move=> fg; have one i k : covariance E (later i (moving f)) (later k g) 0.
  have at_ j := covariance_transpose isE (uncorrelated_at j k isE fg).
  have := covariance_transpose isE (covariance_add isE (at_ i.+1) (at_ i)); rewrite trmx0 addr0 trmx0.
  by apply: (covariance_ext isE) => // t; rewrite /later /moving addnS.
have both i k : covariance E (later i (moving f)) (later k (moving g)) 0.
  have := covariance_add isE (one i k.+1) (one i k); rewrite addr0.
  by apply: (covariance_ext isE) => // t; rewrite /later /moving addnS.
by move=> l; split; [apply: (covariance_ext isE) (both 0%N l)|apply: (covariance_ext isE) (both l 0%N)] => t //; rewrite /later addn0.
Qed.

Lemma moving_excites (e : nat -> 'rV[K]_1) r : quasi_stationary E e -> (forall s, excites E s e) -> excites E r (moving e).
Proof.
move=> quasi exciting; have ce := combination_itself e; have cw := combination_window (moving_combination ce) r.
have [R uu] := combination_covariance isE quasi cw cw; exists R => //.
rewrite -row_full_unit; apply: row_full_seen => w Rw; apply: weights_zero; set d := weights w.
have after i : (r <= i)%N -> d i = 0 by apply: weights_after.
pose q i := (if i is j.+1 then d j else 0) + d i.
have eq t : successive 0 r (moving e) t *m w = \sum_(i < r.+1) e (t + i)%N *m q i.
  rewrite weights_sum -/d; under [RHS]eq_bigr do rewrite mulmxDr.
  rewrite big_split big_ord_recl /= mulmx0 add0r [X in _ + X]big_ord_recr /= after // mulmx0 addr0 -big_split.
  by apply: eq_bigr => i _; rewrite /moving addnS mulmxDl.
have q0 : forall i, q i = 0.
  apply: (null_inputs isE pos quasi ce (exciting r.+1)) => [[|i] ri //|].
    by rewrite /q (after i) ?(after i.+1) ?addr0 //; exact: leqW.
  have := covariance_images isE w w uu; rewrite -mulmxA Rw mulmx0; apply: (covariance_ext isE) => t; exact: eq.
suff down k i : (r <= i + k)%N -> d i = 0 by move=> i; apply: (down r); lia.
elim: k i => [|k IH] i ri; first by apply: after; lia.
by have := q0 i.+1; rewrite /q (IH i.+1) ?addr0 //; lia.
Qed.

End Moving.

Definition twofold (K : realFieldType) : system K 2 1 2 := System (2%:R^-1%:M + delta_mx 0 1) (delta_mx 0 1) 1%:M (delta_mx 0 0).

Lemma twofold_steered (K : realFieldType) z : steered (twofold K) (delta_mx 0 0 : 'M_(1, 2)) z.
Proof.
pose c t : 'rV[K]_1 := (nth 0 [:: z 0 1; z 0 0 - 2%:R^-1 * z 0 1] t)%:M; exists 2%N, c; rewrite /=.
rewrite mul0mx add0r mulmxDr !mul_scalar_mx mul_mx_scalar -!scalemxAl mul_delta_mx.
apply/rowP => -[[|[|//]] lt]; rewrite !mxE /= ?mulr1 ?mulr0 ?addr0 ?add0r ?mulr1.
  by rewrite addrC subrK; congr (z 0 _); exact: val_inj.
by congr (z 0 _); exact: val_inj.
Qed.

Lemma twofold_observed (K : realFieldType) : row_free (O (twofold K) 1).
Proof.
apply: inj_row_free => x; rewrite mul_O => /samples_eq0/(_ 0%N isT).
by rewrite /output /= mulmx1 mul0mx addr0.
Qed.

Lemma twofold_stable (K : realFieldType) : archimedean K -> stable (sysA (twofold K)).
Proof.
move=> arch; apply: PartOfTheRange.double_pole_stable => //; last by rewrite mul_delta_mx_0.
by rewrite invr_gt0 ltr0n invf_lt1 ?ltr0n // ltr1n.
Qed.

Theorem mean_two_states_instance : exists (K : realFieldType) (E : (nat -> K) -> K -> Prop) m p (S : system K 2 m p) (B : 'M_(1, 2))
    (D : 'M_(1, p)) u v x z y s c b d f H L,
  mean E /\ positive E /\ process S B D u v x y /\ stable (sysA S) /\ uncorrelated E u v /\
  (forall t, z t.+1 = z t *m sysA S + u t *m B) /\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t))) /\
  excites E s.+3 u /\ (forall z, steered S B z) /\ row_free (O S s) /\ backward_error E s.+1 u c b /\ forward_error E s.+1 u d f /\
  covariance E b (later 1 x) H /\ limit E (successive 0 2 u) (successive 2 s u) (successive 2 s y) L.
Proof.
have [K arch] := archimedean_field; have isE := TimeAverages.time_average_mean arch; have pos := @TimeAverages.time_average_positive K.
have st := twofold_stable arch; pose B : 'M[K]_(1, 2) := delta_mx 0 0; pose S := twofold K.
pose S2 : system K (2 + 2) 1 1 := System (block_mx (sysA S) 0 0 (sysA S)) (row_mx (sysF S) 0) 0 0.
have [X [Y [[model _] quasi [ee _ ew] _ exc]]] :=
  WhiteSources.driven_exist arch (row_mx B B) (0 : 'M_(1, 1)) 0 (FollowingSources.stable_twice st : stable (sysA S2)).
move: model quasi ee ew exc; set e := fun t => lsubmx _; set w := fun t => rsubmx _ => model quasi ee ew exc.
pose x t := lsubmx (X t); pose z t := rsubmx (X t).
have next t : X t.+1 = row_mx (x t *m sysA S + e t *m B + w t *m sysF S) (z t *m sysA S + e t *m B).
  have [-> _] := model t; rewrite -[X t]hsubmxK -/(x t) -/(z t) mul_row_block !mul_mx_row !mulmx0 !addr0 add0r !add_row_mx addr0.
  by [].
have nx t : x t.+1 = x t *m sysA S + e t *m B + w t *m sysF S by have := congr1 lsubmx (next t); rewrite row_mxKl.
have nz t : z t.+1 = z t *m sysA S + e t *m B by have := congr1 rsubmx (next t); rewrite row_mxKr.
pose D : 'M[K]_(1, 2) := delta_mx 0 1; pose u := moving e; pose v := moving w.
pose y t := moving x t *m sysC S + u t *m D + v t *m sysG S.
have driven t : moving z t.+1 = moving z t *m sysA S + u t *m B by rewrite /u /moving (nz t.+1) [X in _ + X = _]nz !mulmxDl addrACA.
have process_xy : process S B D u v (moving x) y.
  by move=> t; split=> //; rewrite /u /v /moving (nx t.+1) [X in _ + X = _]nx !mulmxDl [LHS]addrACA; congr (_ + _); rewrite addrACA.
have uv : uncorrelated (@time_average K) u v by apply: moving_uncorrelated.
have quasi_all : quasi_stationary (@time_average K) (fun t => row_mx (row_mx (u t) (v t)) (row_mx (moving x t) (moving z t))).
  have same t : moving (fun t => row_mx (row_mx (e t) (w t)) (X t)) t = row_mx (row_mx (u t) (v t)) (row_mx (moving x t) (moving z t)).
    by rewrite /moving -[X t]hsubmxK -[X t.+1]hsubmxK !add_row_mx.
  move=> l; have [R hR] := moving_quasi isE quasi l; exists R; apply: (covariance_ext isE) hR => t; rewrite /later; exact: same.
have quasi_x : quasi_stationary (@time_average K) (fun t => row_mx (row_mx (u t) (v t)) (moving x t)).
  apply: (quasi_part (M := block_mx 1%:M 0 0 (col_mx 1%:M 0)) isE) quasi_all => t.
  by rewrite mul_row_block mul_row_col !mulmx1 !mulmx0 !addr0 add0r.
have quasi_e : quasi_stationary (@time_average K) e.
  apply: (quasi_part (M := col_mx (col_mx 1%:M 0) 0) isE) quasi => t; by rewrite !mul_row_col !mulmx1 !mulmx0 !addr0.
have exciting r : excites (@time_average K) r u := moving_excites isE pos r quasi_e exc.
have cu := moving_combination (combination_itself e).
have [[c [b back]] [d [f forw]]] := errors_exist isE quasi_e cu (exciting 2%N).
have [L lim] := MeanLimits.limit_exists 2 isE process_xy quasi_x (exciting 1%N).
exists K, (@time_average K), 1%N, 2%N, S, B, D, u, v, (moving x), (moving z), y, 1%N, c, b, d, f.
have [H hH] : exists H, covariance (@time_average K) b (later 1 (moving x)) H.
  pose h t := row_mx (row_mx (u t) (v t)) (moving x t).
  have cx : combination h (moving x).
    by apply: combination_ext (combination_part h (col_mx 0 1%:M)) => t; rewrite mul_row_col mulmx0 mulmx1 add0r.
  have cu' : combination h u.
    by apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !addr0.
  apply: (combination_covariance isE quasi_x _ (combination_later 1 cx)); have [eb _] := back.
  apply: combination_ext (combination_add cu' (combination_sum 2 (fun i => combination_mul (- c i) (combination_later i.+1 cu')))) => t.
  by rewrite eb -sumrN; congr (_ + _); apply: eq_bigr => i _; rewrite mulmxN.
exists H, L; do 8 (split; first by []); split; first exact: twofold_steered.
by split; first exact: twofold_observed.
Qed.

Theorem prediction_errors_exist_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) nu (u : nat -> 'rV[K]_nu) r,
  mean E /\ quasi_stationary E u /\ excites E r u.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE _] quasi _ _ exc]]]]]] := averaged arch.
exists K, E, 1%N, u, 2%N; split; first by []; split; last exact: exc.
apply: (quasi_part (M := col_mx (col_mx 1%:M 0) 0) isE) quasi => t; by rewrite !mul_row_col !mulmx1 !mulmx0 !addr0.
Qed.
