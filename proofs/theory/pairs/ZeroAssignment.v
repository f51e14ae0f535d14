(** zero-assignment: with (A, C) observable and a normal rank of 1 at least, every polynomial of degree at most zeta is the exceptional
    polynomial of some P: pairs place their finite zeros at will, and one has none. By PencilAssignment.v; the pencil q b - a has a right
    inverse, as that of (A, C) alone has. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Trajectory Minors FiniteZeros ExceptionalPolynomial.
From faultspace Require Import PencilAssignment.
From faultspace Require InfiniteZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Pencil.
Variables (K : fieldType) (n m p r e : nat) (S : system K n m p) (s : nat).
Variables (Z : 'M[K]_(e + r, n + p)) (U : 'M[K]_(e, n)) (a b : 'M[K]_(e, e + r)).
Hypotheses (coords : coordinates S s Z U a b) (obs : row_free (O S n)).
Notation const := (map_mx (@polyC K)).

Lemma observable_right_inverse : exists Y : 'M_(n + p, n),
  row_mx ('X%:M - const (sysA S)) (const (sysC S)) *m Y = 1%:M.
Proof.
pose S0 := with_faults S (0 : 'M[K]_(0, n)) (0 : 'M_(0, p)).
have /fin_all_exists[y hy] : forall j : 'I_n, exists y, pencil S0 *m y = const (col_mx (col j 1%:M) (0 : 'cV_0)).
  move=> j; apply: column_attained => x v silent; suff -> : x = 0 by rewrite mul0mx mulmx0 addr0.
  apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0 => k kn.
  rewrite -[RHS](silent k (ltnW kn)) -(output_free S (0 : 'M_(0, n)) 0); apply: output_ext => i _.
  by rewrite [v i]thinmx0.
exists (\matrix_(i, j) y j i 0); apply/trmx_inj/row_matrixP => j; rewrite -!tr_col; congr trmx.
have -> : col j (row_mx ('X%:M - const (sysA S)) (const (sysC S)) *m (\matrix_(i, k) y k i 0)) =
    row_mx ('X%:M - const (sysA S)) (const (sysC S)) *m y j.
  rewrite colE -mulmxA -colE; congr (_ *m _); apply/matrixP => i k; by rewrite ord1 !mxE.
have := hy j; rewrite /pencil block_mxEv mul_col_mx map_col_mx => /eq_col_mx[-> _].
by rewrite map_col map_mx1.
Qed.

Lemma pencil_rows_free : row_free b.
Proof.
have [_ freeU _ _ bZ] := coords; apply: inj_row_free => u ub; apply: (row_free_inj freeU); have := congr1 (mulmx u) bZ.
by rewrite mulmxA ub mul0mx mul_mx_row => /(congr1 lsubmx); rewrite row_mxKl linear0 => <-; rewrite mul0mx.
Qed.

Lemma pencil_right_inverse : exists X, ('X *: const b - const a) *m X = 1%:M.
Proof.
have [_ freeU _ aZ bZ] := coords; have [W UW] := row_freeP freeU; have [Y YE] := observable_right_inverse.
move: aZ bZ; rewrite -{1 2}[Z]hsubmxK !mul_mx_row => /eq_row_mx[aA aC] /eq_row_mx[bA bC].
exists (const (row_mx (lsubmx Z) (- rsubmx Z)) *m Y *m const W).
have -> : ('X *: const b - const a) *m (const (row_mx (lsubmx Z) (- rsubmx Z)) *m Y *m const W) =
    const U *m (row_mx ('X%:M - const (sysA S)) (const (sysC S)) *m Y) *m const W.
  rewrite !mulmxA; congr (_ *m _ *m _); rewrite map_row_mx !mul_mx_row !mulmxBl -!scalemxAl map_mxN !mulmxN -!map_mxM aA aC bA bC.
  by rewrite map_mx0 oppr0 scaler0 sub0r opprK mulmxBr mul_mx_scalar !map_mxM.
by rewrite YE mulmx1 -map_mxM UW map_mx1.
Qed.

End Pencil.

(** The rows of b and one row more. *)
Lemma pencil_and_row_free (K : fieldType) n m p r e (S : system K n m p) s (Z : 'M_(e + (1 + r), n + p)) U a b :
  coordinates S s Z U a b -> exists c : 'rV_(e + (1 + r)), row_free (col_mx b c).
Proof.
move=> coords; have freeb := pencil_rows_free coords.
have [E' unitE] := complete_rows freeb.
exists (usubmx E').
apply: inj_row_free => u u0; have : row_mx (lsubmx u) (row_mx (rsubmx u) (0 : 'rV[K]_r)) = 0.
  have free : row_free (col_mx b E') by rewrite row_free_unit.
  apply: (row_free_inj free); rewrite mul0mx -[E']vsubmxK !mul_row_col mul0mx addr0 -mul_row_col hsubmxK.
  exact: u0.
move=> z; have := congr1 lsubmx z; rewrite row_mxKl linear0 => l0.
have := congr1 (lsubmx \o rsubmx) z; rewrite /= row_mxKr row_mxKl !linear0 => r0.
by rewrite -[u]hsubmxK l0 r0 row_mx0.
Qed.

Section ZeroAssignment.
Variables (K : fieldType) (n m p r e : nat) (S : system K n m p) (s : nat).
Variables (Z : 'M[K]_(e + (1 + r), n + p)) (U : 'M[K]_(e, n)) (a b : 'M[K]_(e, e + (1 + r))).
Hypotheses (long : (n < s)%N) (coords : coordinates S s Z U a b) (obs : row_free (O S n)).

Theorem every_exceptional_polynomial (g : {poly K}) : (size g <= e.+1)%N -> exists P, exceptional_polynomial a b P = g.
Proof.
move=> sg; have [c freec] := pencil_and_row_free coords.
have [Q [_ assign]] := every_determinant freec (pencil_right_inverse coords obs).
by have [rho <-] := assign g sg; exists (col_mx rho Q).
Qed.

(** zeros-of-pairs, split: equivalent pairs can have any number of finite zeros up to zeta. *)
Theorem any_number_of_finite_zeros d : (d <= e)%N -> exists P : 'M_(1 + r, e + (1 + r)), let S' := faults_of S (P *m Z) in
  [/\ forall w, behavior S' w <-> behavior S w, gcd_of_minors (pencil S') 'X^d & \rank (zero_holding S') = d].
Proof.
move=> de; have [|P PE] := @every_exceptional_polynomial 'X^d; first by rewrite size_polyXn ltnS.
have D0 : exceptional_polynomial a b P != 0 by rewrite PE -size_poly_eq0 size_polyXn.
have zeros := exceptional_zero_polynomial long coords P; rewrite PE in zeros.
have inv := (exceptional_left_invertible long coords P).2 D0.
exists P; split; [exact: (good_exceptional long coords P).2 D0 | exact: zeros | ].
have [g [[g_div g_max] g_size]] := InfiniteZeros.number_of_finite_zeros inv; have [x_div x_max] := zeros.
have /eqp_size : g %= 'X^d by rewrite /eqp x_max // g_max.
by rewrite g_size size_polyXn => -[].
Qed.

(** zero-assignment, recoverable. *)
Theorem recoverable_pair : exists P : 'M_(1 + r, e + (1 + r)), let S' := faults_of S (P *m Z) in
  (forall w, behavior S' w <-> behavior S w) /\ faults_recovered_blindly S'.
Proof.
have [P [good [div _] /eqP rank0]] := any_number_of_finite_zeros (leq0n e); exists P; split=> //.
apply/faults_recovered_blindly_states; split.
  by apply/(exceptional_left_invertible long coords P)/(good_exceptional long coords P).
move=> x /zero_holdingP; rewrite mxrank_eq0 in rank0; rewrite (eqP rank0) submx0 => /eqP -> k; exact: output_zero.
Qed.

End ZeroAssignment.
