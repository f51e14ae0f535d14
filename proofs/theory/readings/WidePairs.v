(** A pair of full rank that is not equivalent, in a system with more outputs than faults: the direct and the delayed fault of
    Counterexamples.v beside an output that is always zero.

    wide S == S with one more output, zero *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Windows Lag SmallSystems Counterexamples.
From faultspace Require Import TransferRank NormalRank SolutionCount.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Wide.
Variable K : fieldType.

(** S with one more output, zero. *)
Definition wide n m p (S : system K n m p) : system K n m (p + 1) := System (sysA S) (sysF S) (row_mx (sysC S) 0) (row_mx (sysG S) 0).
Lemma wide_output n m p (S : system K n m p) x v k : output (wide S) x v k = row_mx (output S x v k) 0.
Proof.
have st : state (wide S) x v k = state S x v k by elim: k => //= k ->.
by rewrite /output st /= !mul_mx_row !mulmx0 add_row_mx addr0.
Qed.
Lemma wide_behavior n m m' p (S : system K n m p) (S' : system K n m' p) :
  (forall r, behavior (wide S) r <-> behavior (wide S') r) -> forall r, behavior S r <-> behavior S' r.
Proof.
move=> h r; have part (l l' : nat) (S1 : system K n l p) (S2 : system K n l' p) :
    (forall r, behavior (wide S1) r -> behavior (wide S2) r) -> behavior S1 r -> behavior S2 r.
  move=> sub [x [v e]]; have [|y [w e']] := sub (fun k => row_mx (r k) 0); first by exists x, v => k; rewrite wide_output e.
  by exists y, w => k; have := e' k; rewrite wide_output => /eq_row_mx[].
by split; apply: part => q /h.
Qed.
(** x(k+1) = v1(k), r(k) = (x(k), v2(k), 0): normal rank 2 and one zero. *)
Theorem every_p_wide :
  let S : system K 1 (1 + 1) (1 + 1 + 1) := System 0 (col_mx 1%:M 0) (row_mx (row_mx 1%:M 0) 0) (row_mx (block_mx 0 0 0 1%:M) 0) in
  let Z : 'M_(1 + (1 + 1), 1 + (1 + 1 + 1)) := block_mx 1%:M 0 0 (row_mx 1%:M 0) in
  let P : 'M_(1 + 1, 1 + (1 + 1)) := block_mx 1%:M 0 0 (row_mx 1%:M 0) in
  [/\ observable S /\ left_invertible S, \rank (transfer S) = 2%N /\ zeta S = 1%N,
      forall s, (0 < s)%N -> spans_solutions S s Z, row_free Z /\ row_free P
    & ~ (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r)].
Proof.
have [inv span free differ] := full_rank_is_not_enough K; pose S0 := delay_and_direct K.
rewrite -[System _ _ _ _]/(wide S0) -[block_mx 1%:M 0 0 (row_mx 1%:M 0) : 'M_(1 + 1, 1 + (1 + 1))]/(two_columns K); cbv zeta.
suff [obs winv spanZ bad] : [/\ observable (wide S0), left_invertible (wide S0), forall s, (0 < s)%N ->
      spans_solutions (wide S0) s (block_mx 1%:M 0 0 (row_mx 1%:M 0) : 'M_(1 + (1 + 1), 1 + (1 + 1 + 1)))
    & ~ (forall r, behavior (faults_of (wide S0) (two_columns K *m block_mx 1%:M 0 0 (row_mx 1%:M 0))) r <-> behavior (wide S0) r)].
  have freeZ : row_free (block_mx 1%:M 0 0 (row_mx 1%:M 0) : 'M[K]_(1 + (1 + 1), 1 + (1 + 1 + 1))).
    by rewrite /row_free rank_diag_block_mx rank_row_mx0 !mxrank1.
  have rank2 := (left_invertible_transfer_rank _).1 winv; split=> //; split=> //.
  have := (solution_count_zeta (spanZ 2%N isT)).2 (lag_le_n (wide S0)).
  by rewrite (eqP freeZ) (gap_normal_rank _ (leqnn 1)) rank2 => -[<-].
split=> //.
- apply: observable_from_zeros => x /(_ 0%N isT) e0.
  have : row_mx (output S0 x (fun=> 0) 0) 0 = row_mx 0 (0 : 'rV_1) by rewrite -wide_output e0 row_mx0.
  case/eq_row_mx; rewrite /output /= mul0mx addr0 mul_mx_row mulmx1 mulmx0 -(row_mx0 _ 1 1 1).
  by case/eq_row_mx.
- move=> v z; apply: inv => k.
  have : row_mx (output S0 0 v k) 0 = row_mx 0 (0 : 'rV_1) by rewrite -wide_output z row_mx0.
  by case/eq_row_mx.
- move=> s s0 f g; rewrite -[g]hsubmxK; set g1 := lsubmx g; set g2 := rsubmx g.
  have out v k : output (with_faults (wide S0) f (row_mx g1 g2)) 0 v k = row_mx (output (with_faults S0 f g1) 0 v k) (v k *m g2).
    have st : state (with_faults (wide S0) f (row_mx g1 g2)) 0 v k = state (with_faults S0 f g1) 0 v k by elim: k => //= k ->.
    by rewrite /output st /= !mul_mx_row !mulmx0 add_row_mx add0r.
  split=> [/solvesP sol | /submxP[c]].
    have [x [w /(_ 0%N s0)]] := sol (fun=> 1%:M); rewrite out wide_output => /eq_row_mx[_]; rewrite mul1mx => ->.
    apply/submxP; exists (row_mx f g1); rewrite mul_row_block !mulmx0 mulmx1 addr0 add0r mul_mx_row mulmx1 mulmx0. by [].
  rewrite -[c]hsubmxK mul_row_block !mulmx0 mulmx1 addr0 add0r mul_mx_row mulmx1 mulmx0 => /eq_row_mx[_ /eq_row_mx[_ h2]].
  apply/solvesP => v; have /solvesP/(_ v)[x [w e]] : solves S0 s f g1 by apply/span; exact: submx1.
  by exists x, w => k ks; rewrite out wide_output h2 mulmx0 e.
move=> h; apply: differ; apply: wide_behavior => r; rewrite -(h r).
suff -> : wide (faults_of S0 (two_columns K *m 1%:M)) = faults_of (wide S0) (two_columns K *m block_mx 1%:M 0 0 (row_mx 1%:M 0)) by [].
rewrite /wide /faults_of /with_faults /= mulmx1; congr System.
  by rewrite -[two_columns K in RHS]hsubmxK mul_row_block !mulmx0 mulmx1 addr0 add0r row_mxKl.
by rewrite -[two_columns K in RHS]hsubmxK mul_row_block !mulmx0 mulmx1 addr0 add0r row_mxKr mul_mx_row mulmx1 mulmx0.
Qed.
End Wide.
