(** Good P exist for every system, also where the normal rank r is less than m: r of its own faults whose rows of the transfer matrix
    are independent. So the coefficients of the exceptional polynomial (ExceptionalPolynomial.v), polynomials in the entries of P whose
    common zeros are the bad P, do not all vanish: almost every P is good. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Basics Lag TransferRank ClosedForm SettledSolutions Theorem3.
From faultspace Require Import Windows Problem11 SolutionCount ExceptionalPolynomial BadPairs.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section GoodPairs.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation r := (\rank (transfer S)).

Lemma transfer_combined k (P : 'M[K]_(k, m)) :
  transfer (with_faults S (P *m sysF S) (P *m sysG S)) = over_fractions (map_mx polyC P) *m transfer S.
Proof. by rewrite /transfer /over_fractions /= !map_mxM mulmxDr !mulmxA. Qed.

Theorem good_pair_exists s k (Z : 'M[K]_(k, n + p)) : (lag S < s)%N -> spans_solutions S s Z ->
  exists P : 'M_(r, k), forall q, behavior (faults_of S (P *m Z)) q <-> behavior S q.
Proof.
move=> long span; pose f := maxrankfun (transfer S); pose C : 'M[K]_(r, m) := rowsub f 1%:M.
have /submxP[P0 own] : (row_mx (sysF S) (sysG S) <= Z)%MS.
  by apply/row_subP => i; rewrite row_row_mx !rowE; apply/span/own_fault_solves.
exists (C *m P0); apply/(theorem_3_normal_rank_sharp long span).
have -> : faults_of S (C *m P0 *m Z) = with_faults S (C *m sysF S) (C *m sysG S).
  by rewrite /faults_of -mulmxA -own mul_mx_row row_mxKl row_mxKr.
rewrite transfer_combined; have -> : over_fractions (map_mx polyC C) = rowsub f 1%:M.
  by rewrite /over_fractions /C !map_mxsub !map_mx1.
by rewrite mul_rowsub_mx mul1mx; apply/eqP/maxrowsub_free.
Qed.

End GoodPairs.

Theorem almost_every_pair (K : fieldType) n m p (S : system K n m p) s (Z : 'M_(zeta S + \rank (transfer S), n + p)) :
  (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> exists a b : 'M[K]_(zeta S, zeta S + \rank (transfer S)),
  let D (P : 'M[K]_(\rank (transfer S), zeta S + \rank (transfer S))) : {poly K} :=
    \det (col_mx ('X *: map_mx polyC b - map_mx polyC a) (map_mx polyC P)) in
  (forall P, (forall q, behavior (faults_of S (P *m Z)) q <-> behavior S q) <-> D P != 0) /\ exists P, D P != 0.
Proof.
case: s => // s long span free; have span_n : spans_solutions S n.+1 Z.
  by move=> f g; rewrite -(span f g) !problem_11_from_lag // lag_le_n.
have [U [a [b coords]]] := coordinates_in_basis (ltnSn n) span_n free (erefl (zeta S)).
exists a, b; have good P := good_exceptional (ltnSn n) coords P; split=> //.
by have [P /good nonzero] := good_pair_exists long span; exists P.
Qed.

Theorem determinant_of_pair (K : fieldType) n m p (S : system K n m p) s r e (Z : 'M_(e + r, n + p)) (U : 'M_(e, n))
    (a b : 'M_(e, e + r)) (P : 'M_(r, e + r)) :
  (n < s)%N -> spans_solutions S s Z /\ row_free Z -> row_free U -> (U :=: zero_states S)%MS ->
  a *m Z = row_mx (U *m sysA S) (U *m sysC S) -> b *m Z = row_mx U (0 : 'M_(e, p)) ->
  let D := exceptional_polynomial a b P in
  gcd_of_minors (pencil (faults_of S (P *m Z))) D /\ (\rank (transfer (faults_of S (P *m Z))) = r <-> D != 0).
Proof.
move=> long basis free zeros ea eb D; have coords : coordinates S s Z U a b by [].
rewrite -left_invertible_transfer_rank; split; first exact: exceptional_zero_polynomial long coords P.
exact: exceptional_left_invertible long coords P.
Qed.

(** BadPairs.v for every system: a good pair has r faults, is left-invertible, and has the same (A, C), solutions and zeta. *)
Theorem bad_pairs_of_full_rank_general (K : fieldType) n m p (S : system K n m p) s k (Z : 'M[K]_(k, n + p)) :
  let r := \rank (transfer S) in (n < s)%N -> spans_solutions S s Z -> row_free Z ->
  (exists P : 'M_(r, k), row_free P /\ ~ (forall w, behavior (faults_of S (P *m Z)) w <-> behavior S w)) <->
  ((0 < r)%N /\ ~~ row_free (O S n)) \/ ((1 < r)%N /\ (0 < zeta S)%N).
Proof.
move=> r long span free; have [P0 same] := good_pair_exists (leq_ltn_trans (lag_le_n S) long) span.
set S0 := faults_of S (P0 *m Z) in same; have inv : left_invertible S0.
  by apply/left_invertible_transfer_rank/(theorem_3_normal_rank_sharp (leq_ltn_trans (lag_le_n S) long) span).
have span0 : spans_solutions S0 s Z.
  move=> f g; rewrite -(span f g) !problem_11 //; split=> h w hw; apply/same; exact: h.
have [_ _ zetas] := equal_behaviors_equal_zeta same.
have obs : O S0 n = O S n by apply/row_matrixP => i; rewrite !rowK; apply: samples_ext => j _; rewrite output_free.
have := bad_pairs_of_full_rank long span0 free inv; rewrite zetas obs => <-.
split=> -[P [freeP bad]]; exists P; split=> // eq0; apply: bad => w; rewrite -?same; last by rewrite eq0 same.
by have := eq0 w; rewrite same.
Qed.
