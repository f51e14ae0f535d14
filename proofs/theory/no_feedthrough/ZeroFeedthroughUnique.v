(** zero-feedthrough, as a recovery: when G = 0, the system is left-invertible, C F has full rank m and no state but zero can hold the
    output at zero, then every equivalent F' (with G' = 0 and as many faults) has the row space of F, so F is known up to a basis, and
    the output determines the initial state and the faults. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Basics Infinite TransferRank NormalRank Theorem3.
From faultspace Require Import Trajectory ZeroFeedthrough.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Recovery.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Hypotheses (G0 : sysG S = 0) (inv : left_invertible S) (full : \rank (sysF S *m sysC S) = m).
Hypothesis none : forall x, holds_zero S n x -> x = 0.

Theorem faults_known_up_to_basis (F' : 'M_(m, n)) :
  (forall r, behavior (with_faults S F' 0) r <-> behavior S r) <-> (F' :=: sysF S)%MS.
Proof.
have inside := (zero_feedthrough (ltnSn n) G0 inv).2 (conj full none).
split=> [same | eqF r].
  have sub : (F' <= sysF S)%MS.
    apply/row_subP => i; apply: inside; have := (theorem_3_part_i n.+1 (0 : 'M_(0, _)) same).1 i.
    by rewrite row0.
  have inv' : left_invertible (with_faults S F' 0).
    move/behavior_eqP/equal_behaviors_equal_normal_rank: same => same_rank.
    by apply/left_invertible_transfer_rank; rewrite same_rank; apply/left_invertible_transfer_rank.
  apply/eqmxP; rewrite sub -(geq_leqif (mxrank_leqif_sup sub)).
  have /eqP -> : row_free F' by apply: (faults_independent (S := with_faults S F' 0)).
  exact: rank_leq_row.
have [T FT] : exists T, F' = T *m sysF S by apply/submxP; rewrite eqF.
have [T' FT'] : exists T', sysF S = T' *m F' by apply/submxP; rewrite eqF.
split=> -[x [v e]]; [exists x, (fun k => v k *m T) | exists x, (fun k => v k *m T')] => k; rewrite e.
  by rewrite -output_combined_faults G0 mulmx0 -FT.
rewrite -(output_combined_faults (with_faults S F' 0)) /= mulmx0 -FT' -[in RHS]G0.
by rewrite -[with_faults (with_faults _ _ _) _ _]/(with_faults S _ _) with_own_faults.
Qed.

Theorem trajectory_known x y v w : (forall k, output S x v k = output S y w k) -> x = y /\ forall k, v k = w k.
Proof.
move=> same; have rec : faults_recovered_blindly S.
  apply/faults_recovered_blindly_states; split=> // z /none -> k; exact: output_zero.
split; last exact: (rec x y).
apply/eqP; rewrite -subr_eq0; apply/eqP/none/silent_for_ever; exists (fun k => v k - w k) => k.
by rewrite output_sub same subrr.
Qed.

End Recovery.
