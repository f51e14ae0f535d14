(** A system over an extension of its field has the same ranks of windows, so the same gaps, lag and zeta; and what spans the solutions of
    problem (11), or the zero states, spans them over the extension.

    extension f S == the system over the extension f *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq fintype ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Gap Lag CanonicalForm ClosedForm SolutionCount.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Definition extension (K L : fieldType) (f : {rmorphism K -> L}) n m p (S : system K n m p) : system L n m p :=
  System (map_mx f (sysA S)) (map_mx f (sysF S)) (map_mx f (sysC S)) (map_mx f (sysG S)).

Section Extension.
Variables (K L : fieldType) (f : {rmorphism K -> L}) (n p : nat).
Notation mapped := (map_mx f).

Section Windows.
Variables (m : nat) (S : system K n m p).

Lemma extension_output x v k : mapped (output S x v k) = output (extension f S) (mapped x) (fun j => mapped (v j)) k.
Proof.
have state_ext : mapped (state S x v k) = state (extension f S) (mapped x) (fun j => mapped (v j)) k.
  by elim: k => //= k <-; rewrite map_mxD !map_mxM.
by rewrite /output -state_ext map_mxD !map_mxM.
Qed.

Lemma extension_samples s (r : nat -> 'rV[K]_p) : mapped (samples s r) = samples s (fun k => mapped (r k)).
Proof. by rewrite map_mxvec; congr mxvec; apply/matrixP => i j; rewrite !mxE. Qed.

Lemma extension_O s : mapped (O S s) = O (extension f S) s.
Proof.
apply/row_matrixP => i; rewrite -map_row !rowK extension_samples; apply: samples_ext => k _; rewrite extension_output map_row map_mx1.
by apply: output_ext => j _; rewrite map_mx0.
Qed.

Lemma extension_T s : mapped (T S s) = T (extension f S) s.
Proof.
apply/row_matrixP => i; rewrite -map_row !rowK extension_samples; apply: samples_ext => k _; rewrite extension_output map_mx0.
apply: output_ext => j _; rewrite /pulse; case: insub => [l|] /=; last by rewrite map_mx0.
by rewrite map_row map_vec_mx map_delta_mx.
Qed.

Lemma extension_window s : mapped (window S s) = window (extension f S) s.
Proof. by rewrite map_col_mx extension_O extension_T. Qed.

Lemma extension_gap s : gap (extension f S) s = gap S s.
Proof.
by have := rank_window_step (extension f S) s; rewrite -!extension_window !mxrank_map rank_window_step => /addnI ->.
Qed.

Lemma extension_lag : lag (extension f S) = lag S.
Proof.
by apply/eqP; rewrite eqn_leq; apply/andP; split; apply/lagP; [rewrite !extension_gap|rewrite -!extension_gap]; exact: gap_lag.
Qed.

Lemma extension_zeta : zeta (extension f S) = zeta S.
Proof.
have := (rank_window_zeta S _).2 (leqnn (lag S)); have := (rank_window_zeta (extension f S) _).2 (leqnn _).
by rewrite extension_lag extension_gap -extension_window mxrank_map => <- /addnI.
Qed.

End Windows.

Variables (m : nat) (S : system K n m p) (s : nat).

Lemma extension_solves g h : solves S s g h -> solves (extension f S) s (mapped g) (mapped h).
Proof. by rewrite /solves -extension_window -(map_submx f) extension_T. Qed.

Theorem extension_solutions k (Z : 'M_(k, n + p)) : (lag S < s)%N -> spans_solutions S s Z -> spans_solutions (extension f S) s (mapped Z).
Proof.
case: s extension_solves => // t sol long span.
have spanL := spans_Z (extension f S) t.+1; have rankL := (solution_count_zeta spanL).2.
rewrite extension_lag extension_gap extension_zeta -((solution_count_zeta span).2 long) in rankL.
have sub : (mapped Z <= row_base (solution_space (extension f S) t.+1))%MS.
  apply/row_subP => i; rewrite -map_row -[row i Z]hsubmxK map_row_mx; apply/spanL/sol/span.
  by rewrite hsubmxK row_sub.
move=> g h; rewrite spanL; suff : (row_base (solution_space (extension f S) t.+1) <= mapped Z)%MS.
  by move=> sup; split=> /submx_trans; apply.
by rewrite -(mxrank_leqif_sup sub).2 mxrank_map rankL.
Qed.

Theorem extension_zero_states : (mapped (zero_states S) :=: zero_states (extension f S))%MS.
Proof.
have sub : (mapped (zero_states S) <= zero_states (extension f S))%MS.
  apply/row_subP => i; rewrite -map_row; apply/(zero_state_solutions _ _ (ltnSn n)).
  rewrite -[0](map_mx0 f) /solves -extension_window -[with_faults _ _ _]/(extension f (with_faults S (row i (zero_states S)) 0)).
  by rewrite -extension_T map_submx; apply/(zero_state_solutions _ _ (ltnSn n))/row_sub.
by apply/eqmxP; rewrite sub -(mxrank_leqif_sup sub).2 mxrank_map -!zeta_zero_states extension_zeta eqxx.
Qed.

End Extension.
