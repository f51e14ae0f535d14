(** zeros-of-pairs: every equivalent pair has the same zeta, but not the same number of finite zeros. The split is refuted by A = 0, C = 1,
    F = 0, G = 1, over every field: one equivalent pair has no finite zero, another has one (ZeroAssignment.v).

    one_zero == x(k+1) = 0, r = x + v: the zero 0 *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Lag Trajectory SolutionCount ExceptionalPolynomial ZeroAssignment.
From faultspace Require Import TransferRank NormalRank.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Split.
Variable K : fieldType.
Definition one_zero : system K 1 1 1 := System 0 0 1%:M 1%:M.
Lemma one_zero_dims : zeta one_zero = 1%N /\ \rank (transfer one_zero) = 1%N /\ row_free (O one_zero 1).
Proof.
have inv : left_invertible one_zero.
  move=> v q k; have := q k; rewrite /output /= mulmx1 mulmx1; case: k => [|k] /=; last by rewrite mulmx0 mulmx0 addr0 add0r.
  by rewrite add0r.
have rk := (left_invertible_transfer_rank one_zero).1 inv.
have e0 : etas one_zero = [::] by apply: size0nil; rewrite size_etas (gap_normal_rank one_zero (leqnn 1)) rk.
split; [by rewrite /zeta e0 | split=> //].
apply: inj_row_free => x /unobservable/(_ 0%N); by rewrite /output /= mulmx1 mul0mx addr0.
Qed.
Theorem different_numbers : let S := one_zero in exists F G F' G',
  [/\ forall w, behavior (with_faults S F G) w <-> behavior S w, forall w, behavior (with_faults S F' G') w <-> behavior S w,
      gcd_of_minors (pencil (with_faults S F G : system _ 1 1 1)) 1
    & gcd_of_minors (pencil (with_faults S F' G' : system _ 1 1 1)) 'X].
Proof.
have [z1 [r1 obs]] := one_zero_dims; have := coordinates_exist one_zero (ltnSn 1); rewrite z1 r1 => -[Z [U [a [b co]]]].
have [P [g n0 _]] := any_number_of_finite_zeros (r := 0) (ltnSn 1) co obs (leq0n 1).
have [P' [g' n1 _]] := any_number_of_finite_zeros (r := 0) (ltnSn 1) co obs (leqnn 1).
by exists (lsubmx (P *m Z)), (rsubmx (P *m Z)), (lsubmx (P' *m Z)), (rsubmx (P' *m Z)).
Qed.
End Split.

(** zero-assignment, recoverable, for observable systems. *)
Theorem recoverable_pair_exists (K : fieldType) n m p (S : system K n m p) : let r := \rank (transfer S) in
  row_free (O S n) -> (0 < r)%N -> exists (F : 'M_(r, n)) (G : 'M_(r, p)), let S' := with_faults S F G in
  (forall w, behavior S' w <-> behavior S w) /\
  (forall x y v w, (forall k, output S' x v k = output S' y w k) -> forall k, v k = w k).
Proof.
move=> r obs; have := coordinates_exist S (ltnSn n); rewrite -/r; case: r => // r [Z [U [a [b co]]]] _.
have [P good] := recoverable_pair (r := r) (ltnSn n) co obs.
by exists (lsubmx (P *m Z)), (rsubmx (P *m Z)).
Qed.

(** zeros-of-pairs, number. *)
Theorem same_zeta_of_pairs (K : fieldType) n m p k m' (S : system K n m p) (Z : 'M_(k, n + p)) (P : 'M_(m', k)) :
  (forall w, behavior (faults_of S (P *m Z)) w <-> behavior S w) -> zeta (faults_of S (P *m Z)) = zeta S.
Proof. by case/equal_behaviors_equal_zeta. Qed.
