(** A left inverse of polynomial columns [X; N], seen by the independence of the coefficients of X. Let column a of X have a degree below
    mu a, and let its coefficients of degrees 0, ..., mu a - 1, for all a together, be independent. So constant combinations of the rows of
    X are dual to the coefficients of degree 0, and vanish on all others: they are 1 on one column with mu a > 0, and 0 on all others.
    Where mu a = 0 the column of X is zero, and that of N is constant; those of N are independent there, so that other constants serve. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly matrix mxalgebra.
From faultspace Require Import PolynomialKernel.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section States.
Variables (K : fieldType) (n p k : nat) (X : 'M[{poly K}]_(n, k)) (N : 'M[{poly K}]_(p, k)) (mu : 'I_k -> nat).
Notation const := (map_mx (@polyC K)).

Hypothesis low : forall i a, (size (X i a) <= mu a)%N.
Hypothesis states : forall w : 'I_k -> nat -> K, \sum_a \sum_(j < mu a) w a j *: coefm j (col a X) = 0 ->
  forall a j, (j < mu a)%N -> w a j = 0.

(** All coefficients side by side: row i of the table has those of row i of X. *)
Let d := (\max_a mu a).+1.
Let table : 'M[K]_(n, k * d) := \matrix_i mxvec (\matrix_(a < k, j < d) (X i a)`_j).
Let wanted : 'M[K]_(k, k * d) := \matrix_a mxvec (\matrix_(b < k, j < d) ((b == a) && (j == 0%N :> nat) && (0 < mu a)%N)%:R).

Lemma below a (j : 'I_(mu a)) : (j < d)%N.
Proof. by rewrite ltnS; apply: leq_trans (ltnW (ltn_ord j)) _; apply: leq_bigmax. Qed.

Lemma sum_pairs (f : 'I_(k * d) -> K) : \sum_l f l = \sum_a \sum_(j < d) f (mxvec_index a j).
Proof. by rewrite (reindex _ (curry_mxvec_bij k d)) /= pair_bigA /=; apply: eq_bigr => -[]. Qed.

Lemma dual : (wanted <= table)%MS.
Proof.
rewrite submxE; apply/eqP/matrixP => a t; rewrite [RHS]mxE.
pose c := col t (cokermx table); pose at_ b j := if insub j is Some j' then c (mxvec_index b (j' : 'I_d)) 0 else 0.
have at_ord b (j : 'I_d) : at_ b j = c (mxvec_index b j) 0 by rewrite /at_ valK.
have zero : table *m c = 0 by rewrite /c colE mulmxA mulmx_coker mul0mx.
have none b j : (j < mu b)%N -> at_ b j = 0.
  apply: (@states at_); apply/colP => i; have /matrixP/(_ i 0) := zero; rewrite [LHS]mxE => e.
  transitivity (\sum_l table i l * c l 0); last by rewrite e.
  rewrite sum_pairs summxE; apply: eq_bigr => a' _; rewrite summxE.
  rewrite (big_ord_widen d (fun j => (at_ a' j *: coefm j (col a' X)) i 0)); last first.
    by rewrite leqW //; apply: leq_bigmax.
  rewrite big_mkcond; apply: eq_bigr => l _; rewrite [table _ _]mxE mxvecE [in RHS]mxE -at_ord !mxE /=.
  by case: ltnP => [|ml]; rewrite mulrC // nth_default ?mulr0 // ?mul0r //; apply: leq_trans (low i a') ml.
transitivity ((wanted *m c) a 0); first by rewrite /c colE mulmxA -colE [RHS]mxE.
rewrite mxE sum_pairs big1 // => b _; rewrite big1 // => j _; rewrite mxE mxvecE mxE -at_ord.
case: (b =P a) => [->|] /=; last by rewrite mul0r.
case: eqP => [j0|] /=; last by rewrite mul0r.
by case: posnP => [|m0]; rewrite ?mul0r // none ?mulr0 // j0.
Qed.

Lemma dual_states : exists D : 'M[K]_(k, n), const D *m X = \matrix_(a, b) ((b == a) && (0 < mu a)%N)%:R.
Proof.
have /submxP[D e] := dual; exists D; apply/matrixP => a b; apply/polyP => j; rewrite [in RHS]mxE.
have -> : ((const D *m X) a b)`_j = \sum_i D a i * (X i b)`_j.
  by rewrite mxE coef_sum; apply: eq_bigr => i _; rewrite mxE coefCM.
have [jd|dj] := ltnP j d.
  have /matrixP/(_ a (mxvec_index b (Ordinal jd))) := e; rewrite [LHS]mxE mxvecE [LHS]mxE /= => entry.
  transitivity (((b == a) && (j == 0)%N && (0 < mu a)%N)%:R : K); last first.
    by case: (b == a); case: (0 < mu a)%N; rewrite /= ?andbF ?andbT ?coef0 ?coef1 //; case: (j == 0)%N.
  by rewrite entry mxE; apply: eq_bigr => i _; rewrite [table _ _]mxE mxvecE mxE.
rewrite big1 => [|i _].
  by case: (_ && _); rewrite ?coef0 // coef1; case: j dj.
rewrite nth_default ?mulr0 //; apply: leq_trans (low i b) _; apply: leq_trans _ (ltnW dj).
exact: leq_bigmax.
Qed.

Hypothesis flat : forall i a, mu a = 0%N -> (size (N i a) <= 1)%N.
Hypothesis regular : \rank (\matrix_(i, a) (N i a)`_(mu a)) = k.

Theorem inverse_by_states : exists B, B *m col_mx X N = 1%:M.
Proof.
have [D DX] := dual_states; have /row_fullP[E EN] : row_full (\matrix_(i, a) (N i a)`_(mu a)) by rewrite /row_full regular.
pose P : 'M[{poly K}]_k := diag_mx (\row_a (0 < mu a)%N%:R); pose Q : 'M[{poly K}]_k := diag_mx (\row_a (mu a == 0)%N%:R).
have PQ : P + Q = 1%:M.
  apply/matrixP => a b; rewrite !mxE -mulrnDl; congr (_ *+ _); by case: (mu a) => [|l]; rewrite ?add0r ?addr0.
have QQ : Q *m Q = Q.
  by apply/matrixP => a b; rewrite mul_mx_diag !mxE; case: (a =P b) => [->|_]; case: (mu b == 0)%N; rewrite ?mulr1 ?mulr0 ?mul0r.
have DP : const D *m X = P.
  by rewrite DX; apply/matrixP => a b; rewrite !mxE eq_sym; case: (a =P b) => [->|_].
have EQ : const E *m N *m Q = Q.
  apply/matrixP => a b; rewrite mul_mx_diag !mxE.
  have -> : (mu a == 0%N)%:R *+ (a == b) = (mu b == 0%N)%:R *+ (a == b) :> {poly K} by case: (a =P b) => [->|].
  case: eqP => [b0|_]; last by rewrite mulr0 mul0rn.
  rewrite mulr1; have /matrixP/(_ a b) := EN; rewrite !mxE => /(congr1 (@polyC K)).
  rewrite rmorph_sum rmorphMn /= polyC1 => <-; apply: eq_bigr => i _.
  by rewrite !mxE b0 rmorphM /= [N i b in LHS]size1_polyC ?flat.
pose R := Q *m const E *m N.
have RQ : R *m Q = Q by rewrite /R -!mulmxA (mulmxA (const E)) EQ QQ.
have RE : R = R *m P + Q by rewrite -{1}[R]mulmx1 -PQ mulmxDr RQ.
exists (row_mx (const D - R *m const D) (Q *m const E)).
by rewrite mul_row_col -/R mulmxBl -mulmxA DP [X in _ + X]RE addrA subrK PQ.
Qed.

End States.
