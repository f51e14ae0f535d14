(** Solutions of problem (11) are superposed: the behaviour of a pair (F, G) is included in that of S iff all its rows are solutions,
    iff it is a combination P Z of a matrix Z whose rows span the solutions. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Solutions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Notation faults_of := (faults_of S).
Notation spans_solutions := (spans_solutions S).

Section Rows.
Variables (m' : nat) (F : 'M[K]_(m', n)) (G : 'M[K]_(m', p)).
Notation S' := (with_faults S F G).
Notation row_system i := (with_faults S (row i F) (row i G)).

Lemma output_rows v k : output S' 0 v k = \sum_(i < m') output (row_system i) 0 (fun j => (v j 0 i)%:M) k.
Proof.
have states : state S' 0 v k = \sum_(i < m') state (row_system i) 0 (fun j => (v j 0 i)%:M) k.
  elim: k => [|k IH] /=; first by rewrite big1.
  by rewrite IH mulmx_suml [v k *m F]mulmx_sum_row -big_split; apply: eq_bigr => i _; rewrite mul_scalar_mx.
by rewrite /output states mulmx_suml [v k *m _]mulmx_sum_row -big_split; apply: eq_bigr => i _; rewrite mul_scalar_mx.
Qed.

Theorem solution_rows s : (forall i, solves S s (row i F) (row i G)) <-> (forall r, word S' s r -> word S s r).
Proof.
split=> [sol | sub i].
  apply/word_from_rest => v; apply: (word_ext (fun k _ => esym (output_rows v k))).
  by apply: word_sum => i _; have /solvesP := sol i; apply.
apply/solvesP => v; apply/sub; exists 0, (fun j => v j *m delta_mx 0 i) => k _.
by rewrite -[RHS](output_combined_faults S') !rowE.
Qed.

End Rows.

(** Solutions form a linear space, here as the row space of a matrix. *)
Lemma included_rows s k (Z : 'M[K]_(k, n + p)) l (F : 'M_(l, n)) (G : 'M_(l, p)) : spans_solutions s Z ->
  (forall r, word (with_faults S F G) s r -> word S s r) <-> (row_mx F G <= Z)%MS.
Proof.
move=> span; rewrite -solution_rows; split=> [sol | /row_subP sub i].
  by apply/row_subP => i; rewrite row_row_mx; apply/span.
by apply/span; rewrite -row_row_mx.
Qed.

End Solutions.
