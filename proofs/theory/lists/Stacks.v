(** Finitely many sequences side by side: r k holds their samples k as rows. The rank of the first s + 1 samples exceeds that of the first
    s by the rank of what sample s shows of the combinations that have been silent so far. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra zify.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Stacks.
Variables (K : fieldType) (a p : nat).
Implicit Types (r : nat -> 'M[K]_(a, p)).

Lemma stackE s r i (k : 'I_s) l : stack s r i (mxvec_index k l) = r k i l.
Proof. by rewrite mxE mxvecE !mxE. Qed.

Lemma mul_stack_eq0 b (B : 'M[K]_(b, a)) s r : B *m stack s r = 0 <-> forall k, (k < s)%N -> B *m r k = 0.
Proof.
have e i (k : 'I_s) l : (B *m stack s r) i (mxvec_index k l) = (B *m r k) i l.
  by rewrite !mxE; apply: eq_bigr => j _; rewrite stackE.
split=> [h k ks|h]; apply/matrixP => i t.
  by rewrite -(e i (Ordinal ks)) h !mxE.
by case/mxvec_indexP: t => k l; rewrite e h // !mxE.
Qed.

Lemma rank_stack_step s r : \rank (stack s.+1 r) = (\rank (stack s r) + \rank (kermx (stack s r) *m r s))%N.
Proof.
have e : (kermx (stack s.+1 r) == kermx (stack s r) :&: kermx (r s))%MS.
  apply/andP; split.
    have h := (mul_stack_eq0 _ _ r).1 (mulmx_ker (stack s.+1 r)).
    rewrite sub_capmx; apply/andP; split; apply/sub_kermxP; last exact: h.
    by apply/mul_stack_eq0 => k ks; apply: h; apply: ltnW.
  apply/sub_kermxP/mul_stack_eq0 => k; rewrite ltnS leq_eqVlt => /predU1P[->|ks].
    by apply/sub_kermxP; apply: capmxSr.
  by have /sub_kermxP/mul_stack_eq0 := capmxSl (kermx (stack s r)) (kermx (r s)); apply.
have := mxrank_mul_ker (kermx (stack s r)) (r s).
rewrite -(eqmx_rank e) !mxrank_ker => h.
have := rank_leq_row (stack s.+1 r); have := rank_leq_row (stack s r); have := rank_leq_row (kermx (stack s r) *m r s).
by move: h; lia.
Qed.

Lemma row_free_stack s r : (forall B : 'rV_a, (forall k, (k < s)%N -> B *m r k = 0) -> B = 0) -> \rank (stack s r) = a.
Proof.
move=> h; apply/eqP; rewrite -[_ == _]/(row_free _) -kermx_eq0; apply/eqP/row_matrixP => i.
by rewrite row0; apply: h => k ks; apply: (mul_stack_eq0 _ _ r).1 ks; rewrite -row_mul mulmx_ker row0.
Qed.

End Stacks.
