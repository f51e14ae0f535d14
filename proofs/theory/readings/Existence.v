(** What statements about zeros, minimal indices and limits speak of is there: the greatest common divisors of the minors, the orders
    of the zero at infinity, minimal bases on both sides, and the projected limit under a white input. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary InfiniteZeros SystemInfiniteZeros Leads.
From faultspace Require Indices RightIndices SystemZeroPolynomial Readings.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Theorem zeros_exist (K : fieldType) n m p (S : system K n m p) :
  [/\ left_invertible S -> exists g d, gcd_of_minors (pencil S) g /\ infinite_zeros S d,
      exists g d, gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g /\ system_infinite_zeros S d,
      exists c (X : 'M_(n + p, c)), minimal_basis (pencil S) X &
      exists k (Y : 'M_(n + m, k)), minimal_basis (pencil S)^T Y].
Proof.
split.
- move=> inv; have [g [hg _]] := number_of_finite_zeros inv; exists g; eexists; split; first exact: hg.
  exact: number_of_infinite_zeros.
- have [g [hg _]] := SystemZeroPolynomial.number_of_system_zeros S; rewrite Readings.normal_rank; exists g; eexists; split; first exact: hg.
  exact: number_of_system_infinite_zeros.
- by have [X h] := Indices.pencil_minimal_basis S; eexists; exists X.
- by have [X h] := RightIndices.right_minimal_basis S; eexists; exists X.
Qed.

Theorem limit_exists (K : fieldType) N nu p (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) (y : nat -> 'M_(N, p)) H t s z (Z : 'M_(N, z)) :
  white Q u H -> (t + s <= H)%N -> exists L, projected_limit Q Z (future t s u) (future t s y) L.
Proof.
move=> w tH; exists (cov Q Z (future t s y) - cov Q Z (future t s u) *m cov Q (future t s u) (future t s y)), (cov Q Z (future t s u)).
by rewrite (cov_future_white w tH) mulmx1.
Qed.
