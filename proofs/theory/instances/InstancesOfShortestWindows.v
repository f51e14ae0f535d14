(** Instances for headlines on windows that are long enough, theorem-1, proposition-3 and problem-11, as InstancesOfLimits.v has them for
    those on limits. Two systems are compared that are left-invertible and have one state, the plain one and the integrator.

    plain_square, integrator_square == their transfer matrices have the rank 1, as many as there are outputs *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary InstancesOfLimits InstancesOfMeans InstancesOfStructure InstancesOfWindows.
From faultspace Require TransferRank EchelonExists Readings Existence.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma plain_square (K : fieldType) : \rank (transfer (plain K)) = 1%N.
Proof. exact/TransferRank.left_invertible_transfer_rank/plain_left_invertible. Qed.

Lemma integrator_square (K : fieldType) : \rank (transfer (integrator K)) = 1%N.
Proof. exact/TransferRank.left_invertible_transfer_rank/integrator_left_invertible. Qed.

(** ** theorem-1 *)

(** In a field of more than two elements. *)
Theorem theorem_1_n_samples_instance : exists (K : fieldType) (c c' : K), c != 0 /\ c' != 0 /\ c != c'.
Proof.
have [K _] := archimedean_field; exists K, 1, 2%:R; rewrite oner_neq0 pnatr_eq0; split=> //; split=> //.
by rewrite (eqr_nat K 1 2).
Qed.

Theorem theorem_1_lag_instance (K : fieldType) : exists n m n' m' p (S : system K n m p) (S' : system K n' m' p) N,
  (lag S <= N)%N /\ (lag S' <= N)%N.
Proof.
exists 1%N, 1%N, 1%N, 1%N, 1%N, (plain K), (integrator K), 0%N; rewrite plain_lag.
by rewrite (Readings.lag_full_rank (integrator_square K)).
Qed.

Theorem theorem_1_either_lag_instance (K : fieldType) : exists n m n' m' p (S : system K n m p) (S' : system K n' m' p) N,
  \rank (transfer S) = \rank (transfer S') /\ (lag S <= N)%N.
Proof.
exists 1%N, 1%N, 1%N, 1%N, 1%N, (plain K), (integrator K), 0%N.
split; last by rewrite plain_lag.
exact: etrans (plain_square K) (esym (integrator_square K)).
Qed.

Theorem theorem_1_sharp_instance (K : fieldType) : exists n, (0 < n)%N.
Proof. by exists 1%N. Qed.

Theorem theorem_1_inclusion_instance (K : fieldType) : exists n N, (n <= N)%N.
Proof. by exists 1%N, 1%N. Qed.

(** ** assumption-4, proposition-3 *)

Theorem assumption_4_excitation_necessary_instance (K : fieldType) : exists s, (1 <= s)%N.
Proof. by exists 1%N. Qed.

Theorem proposition_3_instance (K : fieldType) : exists n s, (n <= s)%N.
Proof. by exists 1%N, 1%N. Qed.

Theorem proposition_3_lag_instance (K : fieldType) : exists n m p (S : system K n m p), left_invertible S.
Proof. by exists 1%N, 1%N, 1%N, (plain K); exact: plain_left_invertible. Qed.

Theorem lag_of_square_system_instance (K : fieldType) : exists n m p (S : system K n m p), \rank (transfer S) = p.
Proof. by exists 1%N, 1%N, 1%N, (integrator K); exact: integrator_square. Qed.

Theorem proposition_3_normal_rank_instance (K : fieldType) : exists n s, (n <= s)%N.
Proof. by exists 1%N, 1%N. Qed.

(** ** problem-11 *)

Theorem problem_11_instance (K : fieldType) : exists n s, (n < s)%N.
Proof. by exists 1%N, 2%N. Qed.

Theorem problem_11_full_rank_instance (K : fieldType) : exists n m p (S : system K n m p), \rank (transfer S) = p.
Proof. by exists 1%N, 1%N, 1%N, (integrator K); exact: integrator_square. Qed.

Theorem problem_11_dimension_instance (K : fieldType) : exists n m p (S : system K n m p) g d s k (Z : 'M_(k, n + p)),
  left_invertible S /\ gcd_of_minors (pencil S) g /\ infinite_zeros S d /\ spans_solutions S s.+1 Z.
Proof.
have [exist _ _ _] := Existence.zeros_exist (plain K); have [g [d [minors infinite]]] := exist (@plain_left_invertible K).
have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists (plain K) 2.
by exists 1%N, 1%N, 1%N, (plain K), g, d, 1%N, k, Z; split; first exact: plain_left_invertible.
Qed.
