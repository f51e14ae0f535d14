(** bad-set, codimension-two: with (A, C) observable and zeta >= 1 the bad P meet a plane in 0 alone: there are P and Q with which x P + y Q
    is bad for no (x, y) but (0, 0), in every extension of the field. By PencilPlane.v; over an extension the good P are told by the same
    coordinates a and b (FieldExtension.v). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq fintype ssralg poly matrix mxalgebra fraction.
From faultspace Require Import Vocabulary Lag SettledSolutions FieldExtension ExceptionalPolynomial PencilAssignment PencilPlane.
From faultspace Require Import ZeroAssignment.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Coordinates.
Variables (K : fieldType) (n m p r e : nat) (S : system K n m p) (s : nat).
Variables (Z : 'M[K]_(e + r, n + p)) (U : 'M[K]_(e, n)) (a b : 'M[K]_(e, e + r)).
Hypotheses (long : (n < s)%N) (coords : coordinates S s Z U a b).

Lemma extension_coordinates (L : fieldType) (f : {rmorphism K -> L}) :
  coordinates (extension f S) s (map_mx f Z) (map_mx f U) (map_mx f a) (map_mx f b).
Proof.
have [[span free] freeU UE aE bE] := coords; split.
- by rewrite row_free_map; split=> //; apply: extension_solutions span; apply: leq_ltn_trans (lag_le_n S) long.
- by rewrite row_free_map.
- by apply: eqmx_trans (extension_zero_states f S); apply/eqmxP; rewrite !map_submx; apply/eqmxP.
- by rewrite -map_mxM aE map_row_mx !map_mxM.
by rewrite -map_mxM bE map_row_mx map_mx0.
Qed.

End Coordinates.

Lemma plane_of_coordinates (K : fieldType) n m p r e (S : system K n m p) s (Z : 'M_(e + r, n + p)) (U : 'M_(e, n)) (a b : 'M_(e, e + r)) :
  coordinates S s Z U a b -> row_free (O S n) -> (0 < e)%N -> exists P Q, completing_plane a b P Q.
Proof.
move=> coords obs; case: e Z U a b coords => // e Z U a b coords _; have right := pencil_right_inverse coords obs.
case: r Z a b coords right => [|r] Z a b coords right; last first.
  by have [c free] := @pencil_and_row_free K n m p r _ S s Z U a b coords; apply: plane_of_pencil free right.
have [h [bh ah]] := kernel_column right; case/eqP: ah; suff -> : h = 0 by apply: mulmx0.
have free : row_free b^T by rewrite /row_free mxrank_tr (eqP (pencil_rows_free coords)) addn0.
by apply: trmx_inj; rewrite trmx0; apply: (row_free_inj free); rewrite -trmx_mul bh trmx0 mul0mx.
Qed.

Theorem bad_plane (K : fieldType) n m p (S : system K n m p) s (Z : 'M_(zeta S + \rank (transfer S), n + p)) :
  (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> row_free (O S n) -> (0 < zeta S)%N ->
  exists (a b : 'M[K]_(zeta S, zeta S + \rank (transfer S))) (P Q : 'M[K]_(\rank (transfer S), zeta S + \rank (transfer S))),
  forall (L : fieldType) (f : {rmorphism K -> L}),
  let S_L := System (map_mx f (sysA S)) (map_mx f (sysF S)) (map_mx f (sysC S)) (map_mx f (sysG S)) in
  let D R := \det (col_mx ('X *: map_mx polyC (map_mx f b) - map_mx polyC (map_mx f a)) (map_mx polyC R)) in
  (forall R, same_behavior (faults_of S_L (R *m map_mx f Z)) S_L <-> D R != 0) /\
  forall x y, (x != 0) || (y != 0) -> D (x *: map_mx f P + y *: map_mx f Q) != 0.
Proof.
case: s => // s long span free; have span_n : spans_solutions S n.+1 Z.
  by move=> f g; rewrite -(span f g) !problem_11_from_lag // lag_le_n.
move=> obs pos; have [U [a [b coords]]] := coordinates_in_basis (ltnSn n) span_n free (erefl (zeta S)).
have [P [Q plane]] := plane_of_coordinates coords obs pos; exists a, b, P, Q => L f S_L D; split; last exact: plane.
by move=> R; apply: (good_exceptional (ltnSn n) (extension_coordinates (ltnSn n) coords f)).
Qed.
