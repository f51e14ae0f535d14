(** Instances for headlines on windows, data and delays, as InstancesOfLimits.v has them for those on limits; and two systems with what
    is known of them, for the instances of other files.

    integrator == x(k+1) = x(k) + v(k), r = x: every sequence is possible, the fault comes one sample late
         noted == x(k+1) = x(k) + v(k), r = (x, v): lag 1, and no zeros *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary StructureVocabulary Windows Lag.
From faultspace Require Inversion SharpWindows SmallSystems SharpPartner DelaySharp EchelonExists FollowingExamples.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Integrator.
Variable K : fieldType.

Definition integrator : system K 1 1 1 := System 1%:M 1%:M 1%:M 0.

Lemma integrator_output x v k : output integrator x v k = x + \sum_(j < k) v j.
Proof.
rewrite /output /= mulmx0 addr0 mulmx1; elim: k => [|k IH] /=; first by rewrite big_ord0 addr0.
by rewrite big_ord_recr /= !mulmx1 IH addrA.
Qed.

Lemma integrator_behavior r : behavior integrator r.
Proof.
exists (r 0%N), (fun k => r k.+1 - r k) => k; rewrite integrator_output; elim: k => [|k IH]; first by rewrite big_ord0 addr0.
by rewrite big_ord_recr /= addrA -IH addrC subrK.
Qed.

Lemma integrator_word s r : word integrator s r.
Proof. by have [x [v e]] := integrator_behavior r; exists x, v. Qed.

Lemma integrator_with_delay : inverts_with_delay integrator 1.
Proof. by move=> v /(_ 1%N isT); rewrite integrator_output add0r big_ord1. Qed.

Lemma integrator_left_invertible : left_invertible integrator.
Proof. exact: Inversion.delay_left_invertible integrator_with_delay. Qed.

Lemma integrator_observable : observable integrator.
Proof. by apply: SmallSystems.observable_from_zeros => x /(_ 0%N isT); rewrite integrator_output big_ord0 addr0. Qed.

Lemma integrator_reaches k (y : 'rV_1) : silently_reaches integrator k.+1 y.
Proof.
pose v j := if j == k then y else 0; exists 0, v.
have zero j : (j <= k)%N -> state integrator 0 v j = 0.
  elim: j => //= j IH jk; rewrite IH ?(ltnW jk) // mul0mx add0r mulmx1 /v; by case: eqP jk => // ->; rewrite ltnn.
split=> [j jk|/=]; first by rewrite /output zero //= mul0mx mulmx0 addr0.
by rewrite zero // mul0mx add0r mulmx1 /v eqxx.
Qed.

Definition noted : system K 1 1 (1 + 1) := leading_fault 1.

Lemma noted_output x v k : output noted x v k = row_mx (state noted x v k) (v k).
Proof. by rewrite /output /= !mul_mx_row !mulmx0 !mulmx1 add_row_mx addr0 add0r. Qed.

Lemma noted_at_once : inverts_from_any_state noted 0.
Proof. by move=> x v /(_ 0%N isT); rewrite noted_output -row_mx0 => /eq_row_mx[]. Qed.

Lemma noted_left_invertible : left_invertible noted.
Proof. by apply: (@Inversion.delay_left_invertible _ _ _ _ _ 0%N) => v; apply: noted_at_once. Qed.

Lemma noted_window : \rank (window noted 1) = 2%N.
Proof.
apply: (SmallSystems.full_window (s := 1)) => r; exists (lsubmx (r 0%N)), (fun=> rsubmx (r 0%N)) => -[|//] _.
by rewrite noted_output hsubmxK.
Qed.

Lemma noted_lag : lag noted = 1%N.
Proof.
apply/eqP; rewrite eqn_leq (lag_le_n noted) ltnNge; apply/negP => /(SharpWindows.proposition_3_sharp 0 noted_left_invertible).
by rewrite noted_window; have := rank_leq_col (window noted 0); rewrite leqn0 => /eqP ->.
Qed.

Lemma noted_zeta : zeta noted = 0%N.
Proof.
have /(SharpWindows.theorem_2 1 noted_left_invertible) : (lag noted <= 1)%N by rewrite noted_lag.
by rewrite noted_window => -[].
Qed.

End Integrator.

(** ** window-ranks, solutions *)

Theorem window_ranks_solutions_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)),
  spans_solutions S s.+1 Z.
Proof.
have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists (noted K) 2.
by exists 1%N, 1%N, (1 + 1)%N, (noted K), 1%N, k, Z.
Qed.

Theorem solutions_closed_form_instance (K : fieldType) : exists n s, (n < s)%N.
Proof. by exists 1%N, 2%N. Qed.

(** ** sharp-windows *)

Theorem sharp_equality_instance (K : fieldType) : exists n m p (S : system K n m p),
  (0 < m)%N /\ (0 < lag S)%N /\ left_invertible S.
Proof. by exists 1%N, 1%N, (1 + 1)%N, (noted K); rewrite noted_lag; do 2!split=> //; exact: noted_left_invertible. Qed.

Theorem sharp_equality_left_invertible_instance (K : fieldType) : exists n m p (S : system K n m p),
  (0 < lag S)%N /\ left_invertible S.
Proof. by exists 1%N, 1%N, (1 + 1)%N, (noted K); rewrite noted_lag; split=> //; exact: noted_left_invertible. Qed.

Theorem sharp_equality_lag_instance (K : fieldType) : let S : system K (1 + 1 + 1) 1 (1 + 1) :=
    System (block_mx (block_mx 0 0 1%:M 0) 0 0 0) (row_mx (row_mx 0 1%:M) 0) (block_mx (col_mx 1%:M 0) 0 0 1%:M) 0 in
  exists F G, let S' := with_faults S F G : system K (1 + 1 + 1) 1 (1 + 1) in left_invertible S' /\ (lag S' <= lag S)%N.
Proof. by move=> S; have [inv _ _] := SharpPartner.no_partner_keeps_the_lag K; exists (sysF S), (sysG S). Qed.

(** ** The chain W_k *)

Theorem chain_decreases_instance (K : fieldType) : exists n m p (S : system K n m p) j k y, (j <= k)%N /\ silently_reaches S k y.
Proof. by exists 1%N, 1%N, 1%N, (integrator K), 1%N, 2%N, 1%:M; split=> //; exact: integrator_reaches. Qed.

Theorem chain_stays_instance (K : fieldType) : exists n m p (S : system K n m p) k,
  (forall y, silently_reaches S k y -> silently_reaches S k.+1 y) /\ exists j, (k <= j)%N.
Proof.
by exists 1%N, 1%N, 1%N, (integrator K), 1%N; split=> [y _|]; [exact: integrator_reaches|exists 3%N].
Qed.

Theorem chain_constant_instance (K : fieldType) : exists n k, (n <= k)%N.
Proof. by exists 1%N, 2%N. Qed.

(** ** Data *)

(** v = 0, ..., 0, 1, 0, 0, ... *)
Lemma impulse_excites (K : fieldType) M : persistently_exciting M.+1 M.+1 (fun k => (k == M)%:R%:M : 'rV[K]_1).
Proof.
rewrite /persistently_exciting /row_full -mxrank_tr -/(row_free _); apply: inj_row_free => z e.
have at_ (i : 'I_M.+1) : \sum_(k < M.+1) ((i + k)%N == M)%:R%:M *m (unsamples z k)^T = 0.
  have := congr1 (row i) (congr1 trmx e); rewrite trmx_mul trmxK trmx0 row_mul rowK row0.
  by rewrite -{1}[z]unsamplesK FollowingExamples.samples_dot.
rewrite -[z]unsamplesK; apply/samples_eq0 => j jM; apply: trmx_inj; have := at_ (rev_ord (Ordinal jM)).
rewrite (bigD1 (Ordinal jM)) //= subSS subnK // eqxx mul1mx trmx0 big1 ?addr0 // => k kj.
rewrite -[X in _ == X](subnK (jM : (j <= M)%N)) eqn_add2l; move: kj; rewrite -(inj_eq val_inj) /= => /negbTE ->.
by rewrite raddf0 mul0mx.
Qed.

Theorem data_problem_11_instance (K : fieldType) : exists n m p (S : system K n m p) (v : nat -> 'rV[K]_m) M s,
  persistently_exciting M (n + s.+1) v /\ (lag S <= s)%N.
Proof.
exists 1%N, 1%N, (1 + 1)%N, (noted K); eexists; exists 3%N, 1%N; rewrite noted_lag; split=> //.
exact: impulse_excites.
Qed.

(** ** trajectory-recovered: a fault that is seen two samples later, whatever the state was *)

Theorem delay_any_state_longer_instance (K : fieldType) : exists n m p (S : system K n m p) l k,
  (l <= k)%N /\ inverts_from_any_state S l.
Proof.
have [S [_ _ two _]] := DelaySharp.delay_bounds_attained K 1.
by exists 2%N, 1%N, 1%N, S, 2%N, 3%N.
Qed.

Theorem delay_by_the_range_instance (K : fieldType) : exists n m p (S : system K n m p), (exists l, inverts_from_any_state S l).
Proof.
have [S [_ _ two _]] := DelaySharp.delay_bounds_attained K 1.
by exists 2%N, 1%N, 1%N, S, 2%N.
Qed.

Theorem delay_by_outputs_instance (K : fieldType) : exists n m p (S : system K n m p), (exists l, inverts_from_any_state S l).
Proof. exact: delay_by_the_range_instance. Qed.
