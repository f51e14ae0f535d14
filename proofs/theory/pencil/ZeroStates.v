(** The subspace U of the closed form (ClosedForm.v), there written with W, the limit of the states that are reached silently from anywhere,
    is V + S: the states that can be silent for ever together with those reached silently from rest. Both have dimension zeta. *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Chain SolutionCount SilentSubspaces.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section ZeroStates.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma silent_from_rest_silent k : (silent_from_rest S k <= silent S k)%MS.
Proof. by apply/row_subP => i; have /silent_from_restP[v h] := row_sub i (silent_from_rest S k); apply/silentP; exists 0%R, v. Qed.

Theorem zero_states_silent : (zero_states S :=: zero_holding S + silent_from_rest S n)%MS.
Proof.
apply/eqmxP; have sub : (zero_holding S + silent_from_rest S n <= zero_states S)%MS.
  by rewrite addsmx_sub addsmxSr; apply: submx_trans (silent_from_rest_silent n) (addsmxSl _ _).
by rewrite sub -(geq_leqif (mxrank_leqif_sup sub)) rank_silent_subspaces -zeta_zero_states leqnn.
Qed.

End ZeroStates.
