(** Instances for headlines on theorem-3 and pairs, their zeros and the canonical form, as InstancesOfLimits.v has them for those on limits.

    integrator_ahead == the integrator that shows its next state: x(k+1) = x(k) + v(k), r = x + v *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Lag InstancesOfWindows.
From faultspace Require Inversion TransferRank SmallSystems WidePairs EchelonExists ExceptionalPolynomial Existence.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Ahead.
Variable K : fieldType.

Definition integrator_ahead : system K 1 1 1 := with_faults (integrator K) 1%:M 1%:M.

Lemma ahead_output x v k : output integrator_ahead x v k = state integrator_ahead x v k.+1.
Proof. by rewrite /output /= !mulmx1. Qed.

Lemma ahead_left_invertible : left_invertible integrator_ahead.
Proof.
by apply: (@Inversion.delay_left_invertible _ _ _ _ _ 0%N) => v /(_ 0%N isT); rewrite ahead_output /= mul0mx add0r mulmx1.
Qed.

Lemma ahead_behavior r : behavior integrator_ahead r.
Proof.
pose v k := if k is j.+1 then r k - r j else r 0%N; exists 0, v => k; rewrite ahead_output.
have step j : state integrator_ahead 0 v j.+1 = state integrator_ahead 0 v j + v j by rewrite /= !mulmx1.
by elim: k => [|k IH]; rewrite step ?add0r // -IH addrC subrK.
Qed.

(** Two faults, normal rank 2 and one zero, with a basis of all solutions of problem (11). *)
Lemma two_faults_one_zero : exists (S : system K 1 (1 + 1) (1 + 1 + 1)) (Z : 'M_(1 + (1 + 1), 1 + (1 + 1 + 1))),
  [/\ observable S, \rank (transfer S) = 2%N, zeta S = 1%N, row_free Z & forall s, (0 < s)%N -> spans_solutions S s Z].
Proof. by have [[obs _] [rank2 zeta1] span [free _] _] := WidePairs.every_p_wide K; eexists; eexists; split; eauto. Qed.

Lemma their_coordinates : exists (S : system K 1 (1 + 1) (1 + 1 + 1)) (Z : 'M_(1 + (1 + 1), 1 + (1 + 1 + 1))) U a b,
  [/\ spans_solutions S 2 Z /\ row_free Z, row_free U /\ (U :=: zero_states S)%MS, a *m Z = row_mx (U *m sysA S) (U *m sysC S),
      b *m Z = row_mx U (0 : 'M_(1, 1 + 1 + 1)) & observable S].
Proof.
have [S [Z [obs _ zeta1 free span]]] := two_faults_one_zero.
have [U [a [b [basis freeU zeros ea eb]]]] :=
  ExceptionalPolynomial.coordinates_in_basis (isT : (1 < 2)%N) (span 2%N isT) free (esym zeta1).
by exists S, Z, U, a, b.
Qed.

End Ahead.

(** ** theorem-3-ii *)

Theorem theorem_3_every_p_instance (K : fieldType) : exists s, (0 < s)%N.
Proof. by exists 1%N. Qed.

Theorem theorem_3_left_invertible_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)),
  (lag S < s)%N /\ spans_solutions S s Z /\ left_invertible S.
Proof.
have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists (noted K) 2.
by exists 1%N, 1%N, (1 + 1)%N, (noted K), 2%N, k, Z; rewrite noted_lag; do !split=> //; exact: noted_left_invertible.
Qed.

Theorem theorem_3_criterion_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)),
  (lag S < s)%N /\ spans_solutions S s Z.
Proof. by have [n [m [p [S [s [k [Z [long [span _]]]]]]]]] := theorem_3_left_invertible_instance K; exists n, m, p, S, s, k, Z. Qed.

Theorem theorem_3_instance (K : fieldType) : exists n m m' p (S : system K n m p) (S' : system K n m' p) N,
  sysA S' = sysA S /\ sysC S' = sysC S /\ (lag S <= N)%N /\ (m <= m')%N /\ left_invertible S' /\
  (forall r, word S' N.+1 r -> word S N.+1 r).
Proof.
exists 1%N, 1%N, 1%N, 1%N, (integrator K), (integrator_ahead K), 1%N; do 2!split=> //; split; first exact: lag_le_n.
by split=> //; split=> [|r _]; [exact: ahead_left_invertible|exact: integrator_word].
Qed.

(** ** theorem-3-i, whatever (A, C) *)

Theorem columns_after_change_of_state_instance (K : fieldType) : exists n m m' p (S : system K n m p) (S' : system K n m' p),
  same_behavior S S'.
Proof.
exists 1%N, 1%N, 1%N, (1 + 1)%N, (SmallSystems.with_feedback (noted K) 1%:M), (noted K) => r.
exact: SmallSystems.feedback_behavior.
Qed.

Theorem columns_after_map_of_state_instance (K : fieldType) : exists n m n' m' p (S : system K n m p) (S' : system K n' m' p),
  same_behavior S S'.
Proof.
exists 1%N, 1%N, (1 + 1)%N, 1%N, 1%N, (integrator K), (SmallSystems.double_delay K) => r; split=> _; last exact: integrator_behavior.
exists (row_mx (r 0%N) (r 1%N)), (fun k => r k.+2) => k; rewrite SmallSystems.double_delay_output.
by case: k => [|[|k]]; rewrite ?row_mxKl ?row_mxKr.
Qed.

(** ** zero-feedthrough *)

Theorem zero_feedthrough_recovery_instance (K : fieldType) : exists n m p (S : system K n m p),
  sysG S = 0 /\ left_invertible S /\ \rank (sysF S *m sysC S) = m /\ (forall x, holds_zero S n x -> x = 0).
Proof.
exists 1%N, 1%N, 1%N, (integrator K); split=> //; split; first exact: integrator_left_invertible.
split=> [|x [v /(_ 0%N isT)]]; first by rewrite /= mulmx1 mxrank1.
by rewrite integrator_output big_ord0 addr0.
Qed.

(** ** one-determinant *)

Theorem one_determinant_instance (K : fieldType) : exists n m p (S : system K n m p) s r e (Z : 'M_(e + r, n + p)) U a b,
  (n < s)%N /\ (spans_solutions S s Z /\ row_free Z) /\ row_free U /\ (U :=: zero_states S)%MS /\
  a *m Z = row_mx (U *m sysA S) (U *m sysC S) /\ b *m Z = row_mx U (0 : 'M_(e, p)).
Proof.
have [S [Z [U [a [b [basis [free zeros] ea eb _]]]]]] := their_coordinates K.
by exists 1%N, (1 + 1)%N, (1 + 1 + 1)%N, S, 2%N, (1 + 1)%N, 1%N, Z, U, a, b.
Qed.

Theorem one_determinant_exists_instance (K : fieldType) : exists n s, (n < s)%N.
Proof. by exists 1%N, 2%N. Qed.

(** ** zeros-of-pairs *)

Theorem zeros_of_pairs_instance (K : fieldType) : exists n m m' p (S : system K n m p) (S' : system K n m' p) g d,
  same_behavior S S' /\ left_invertible S' /\ gcd_of_minors (pencil S') g /\ infinite_zeros S' d.
Proof.
have [/(_ (@ahead_left_invertible K))[g [d [minors infinite]]] _ _ _] := Existence.zeros_exist (integrator_ahead K).
exists 1%N, 1%N, 1%N, 1%N, (integrator K), (integrator_ahead K), g, d; split; last by split; first exact: ahead_left_invertible.
by move=> r; split=> _; [exact: ahead_behavior|exact: integrator_behavior].
Qed.

(** ** bad-set *)

Theorem bad_set_one_fault_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)),
  (lag S < s)%N /\ spans_solutions S s Z /\ row_free Z /\ row_free (O S n) /\ \rank (transfer S) = 1%N.
Proof.
have [Z [_ [_ [_ [[span free] _ _ _ _]]]]] := ExceptionalPolynomial.coordinates_exist (integrator K) (isT : (1 < 2)%N).
exists 1%N, 1%N, 1%N, (integrator K), 2%N; eexists; exists Z; split; first exact: (lag_le_n (integrator K)).
do 2!split=> //; split; first exact: integrator_observable.
exact/TransferRank.left_invertible_transfer_rank/integrator_left_invertible.
Qed.

Theorem bad_set_no_zeros_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)),
  (lag S < s)%N /\ spans_solutions S s Z /\ row_free Z /\ zeta S = 0%N.
Proof.
have [Z [_ [_ [_ [[span free] _ _ _ _]]]]] := ExceptionalPolynomial.coordinates_exist (noted K) (isT : (1 < 2)%N).
exists 1%N, 1%N, (1 + 1)%N, (noted K), 2%N; eexists; exists Z; rewrite noted_lag; do !split=> //; exact: noted_zeta.
Qed.

Theorem bad_set_full_rank_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)),
  (n < s)%N /\ spans_solutions S s Z /\ row_free Z.
Proof.
have [S [Z [_ _ _ free span]]] := two_faults_one_zero K.
by exists 1%N, (1 + 1)%N, (1 + 1 + 1)%N, S, 2%N, (1 + (1 + 1))%N, Z; split=> //; split=> //; exact: span.
Qed.

Theorem bad_set_plane_instance (K : fieldType) : exists n m p (S : system K n m p) s (Z : 'M_(zeta S + \rank (transfer S), n + p)),
  (lag S < s)%N /\ spans_solutions S s Z /\ row_free Z /\ row_free (O S n) /\ (0 < zeta S)%N.
Proof.
have [S [_ [obs _ zeta1 _ _]]] := two_faults_one_zero K.
have [Z [_ [_ [_ [[span free] _ _ _ _]]]]] := ExceptionalPolynomial.coordinates_exist S (isT : (1 < 2)%N).
exists 1%N, (1 + 1)%N, (1 + 1 + 1)%N, S, 2%N, Z; split; first exact: (lag_le_n S).
by do !split=> //; rewrite zeta1.
Qed.

(** ** zero-assignment *)

Theorem zero_assignment_instance (K : fieldType) : exists n m p (S : system K n m p) s r e (Z : 'M_(e + (1 + r), n + p)) U a b
    (g : {poly K}),
  (n < s)%N /\ (spans_solutions S s Z /\ row_free Z) /\ row_free U /\ (U :=: zero_states S)%MS /\
  a *m Z = row_mx (U *m sysA S) (U *m sysC S) /\ b *m Z = row_mx U (0 : 'M_(e, p)) /\ row_free (O S n) /\ (size g <= e.+1)%N.
Proof.
have [S [Z [U [a [b [basis [free zeros] ea eb obs]]]]]] := their_coordinates K.
by exists 1%N, (1 + 1)%N, (1 + 1 + 1)%N, S, 2%N, 1%N, 1%N, Z, U, a, b, 'X; rewrite size_polyX.
Qed.

Theorem zero_assignment_observable_instance (K : fieldType) : exists n m p (S : system K n m p) (g : {poly K}),
  let r := \rank (transfer S) in observable S /\ (0 < r)%N /\ g != 0.
Proof.
have [S [_ [obs rank2 _ _ _]]] := two_faults_one_zero K.
by exists 1%N, (1 + 1)%N, (1 + 1 + 1)%N, S, 'X; rewrite rank2 polyX_eq0.
Qed.

(** ** canonical-form *)

Theorem canonical_form_same_a_c_instance (K : fieldType) : exists n m m' p (S : system K n m p) (S' : system K n m' p) s k k'
    (R : 'M_(k, n + p)) (R' : 'M_(k', n + p)),
  sysA S' = sysA S /\ sysC S' = sysC S /\ (n < s)%N /\ spans_solutions S s R /\ spans_solutions S' s R' /\
  reduced_echelon R /\ reduced_echelon R'.
Proof.
have [k [R [reduced span]]] := EchelonExists.solutions_echelon_exists (integrator K) 2.
have [k' [R' [reduced' span']]] := EchelonExists.solutions_echelon_exists (integrator_ahead K) 2.
by exists 1%N, 1%N, 1%N, 1%N, (integrator K), (integrator_ahead K), 2%N, k, k', R, R'.
Qed.

(** The field with two elements has no such number. *)
Theorem canonical_form_any_a_c_instance : exists (K : fieldType) (c : K) s, c != 0 /\ c != 1 /\ (1 < s)%N.
Proof. by exists [the fieldType of rat : Type], 2%:R, 2%N. Qed.
