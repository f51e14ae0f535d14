(** A pair of full rank that is not equivalent, in a system with more outputs than faults: the direct and the delayed fault of
    Counterexamples.v beside an output that is always zero. *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Basics Windows SmallSystems Solutions Counterexamples Proposition3 Inversion.
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
Theorem every_p_wide : exists (S : system K 1 (1 + 1) (1 + 1 + 1)) k (Z : 'M_(k, 1 + (1 + 1 + 1))) (P : 'M_(1 + 1, k)),
  [/\ observable S, left_invertible S, forall s, (0 < s)%N -> spans_solutions S s Z, row_free P
    & ~ (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r)].
Proof.
have [inv span free differ] := full_rank_is_not_enough K; pose S0 := delay_and_direct K.
exists (wide S0), (1 + (1 + 1))%N, (block_mx 1%:M 0 0 (row_mx 1%:M 0)), (two_columns K); split=> //.
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
