(** Kernel rows c_0, ..., c_mu of a system over a field, here columns, with the costates of Horner's rule: polynomial columns in the kernel
    of the pencil. Where they are seen to be a minimal basis by their states (BasisByStates.v), they give the ranks of all windows.

           passes S c == the row c vanishes on all trajectories of S, by Horner's rule
    coefficient S c k == [- X_k; N_k], the coefficient of the row's column at q^k
        column_of S c == that column, [- X; N], of polynomials
       columns_of S c == the matrix of the columns of the rows c *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary PolynomialKernel Annihilator SeenBasis BasisByStates ListedSystems.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section OneSystem.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types c : seq 'cV[K]_p.
Notation hstate := (horner_state (sysA S) (sysC S)).

(** The row vanishes on all trajectories, by Horner's rule. *)
Definition passes c := hstate c = 0 /\ forall k, (k < size c)%N -> fault_action S c k = 0.

(** The polynomial column [- X; N] of a row. *)
Definition coefficient c k : 'cV[K]_(n + p) := col_mx (- hstate (drop k.+1 c)) c`_k.
Definition column_of c : 'cV[{poly K}]_(n + p) := polym (size c) (coefficient c).

Lemma horner_step c k : hstate (drop k c) = sysC S *m c`_k + sysA S *m hstate (drop k.+1 c).
Proof.
have [kc|ck] := ltnP k (size c); first by rewrite (drop_nth 0 kc).
by rewrite !drop_oversize ?(leqW ck) // nth_default //= !mulmx0 addr0.
Qed.

Lemma passes_kernel c : passes c -> pencil S *m column_of c = 0.
Proof.
move=> [X0 demands]; rewrite -[column_of c]vsubmxK; apply/right_kernel => k.
have coef_all j : coefm j (column_of c) = coefficient c j.
  rewrite coefm_polym; case: ltnP => // cj; rewrite /coefficient drop_oversize ?(leqW cj) // nth_default //= oppr0.
  by rewrite col_mx0.
have up j : coefm j (usubmx (column_of c)) = - hstate (drop j.+1 c).
  by rewrite -[RHS](col_mxKu _ c`_j) -/(coefficient c j) -coef_all; apply/matrixP => i l; rewrite !mxE.
have down j : coefm j (dsubmx (column_of c)) = c`_j.
  by rewrite -[RHS](col_mxKd (- hstate (drop j.+1 c))) -/(coefficient c j) -coef_all; apply/matrixP => i l; rewrite !mxE.
have late_is j : late (usubmx (column_of c)) j = - hstate (drop j c).
  by case: j => [|j]; rewrite /= ?up // drop0 X0 oppr0.
rewrite !late_is down !mulmxN; split; first by rewrite horner_step opprD addrC.
have [kc|ck] := ltnP k (size c).
  by have /eqP := demands k kc; rewrite /fault_action addrC addr_eq0 => /eqP.
by rewrite nth_default // drop_oversize ?(leqW ck) //= !mulmx0 oppr0.
Qed.

Variables (k : nat) (c : 'I_k -> seq 'cV[K]_p).
Hypotheses (kernel : forall a, passes (c a)) (nonempty : forall a, (0 < size (c a))%N).
Definition columns_of : 'M[{poly K}]_(n + p, k) := \matrix_(i, a) column_of (c a) i 0.

Lemma col_columns a : col a columns_of = column_of (c a).
Proof. by apply/colP => i; rewrite !mxE. Qed.

Variable pivot : 'I_k -> 'I_p.
Hypothesis regular : \det (\matrix_(a, b) last 0 (c a) (pivot b) 0) != 0.

Lemma last_coefficient a : coefficient (c a) (size (c a)).-1 = col_mx 0 (last 0 (c a)).
Proof. by rewrite /coefficient prednK ?nonempty // drop_size /= oppr0 nth_last. Qed.

Lemma lead_neq0 a : last 0 (c a) != 0.
Proof.
apply: contraNneq regular => e; rewrite (expand_det_row _ a) big1 // => b _.
by rewrite !mxE e mxE mul0r.
Qed.

Lemma degree_columns a : degree columns_of a = (size (c a)).-1.
Proof.
rewrite /degree col_columns; congr _.-1; apply/eqP; rewrite eqn_leq; apply/andP; split.
  by apply/sizem_leP => j cj; rewrite coefm_polym ltnNge cj.
rewrite leqNgt; apply/negP => short; have := lead_neq0 a.
have /sizem_leP/(_ (size (c a)).-1 (leqnn _)) : (sizem (column_of (c a)) <= (size (c a)).-1)%N by rewrite -ltnS prednK ?nonempty.
rewrite coefm_polym ltn_predL nonempty last_coefficient -[0 in RHS]col_mx0 => /eq_col_mx[_ ->].
by rewrite eqxx.
Qed.

Lemma leading_columns : \rank (leading columns_of) = k.
Proof.
apply/eqP; rewrite eqn_leq rank_leq_col /=; apply: (@minor_rank _ _ _ _ _ (fun b => rshift n (pivot b)) id).
rewrite -det_tr; congr (\det _ != 0): regular; apply/matrixP => a b; rewrite [LHS]mxE.
have /matrixP/(_ (rshift n (pivot b)) 0) := last_coefficient a; rewrite [RHS]col_mxEd => <-.
by rewrite [RHS]mxE [RHS]mxE [RHS]mxE degree_columns [columns_of _ _]mxE [column_of _ _ _]mxE coef_poly ltn_predL nonempty.
Qed.

Hypothesis states : forall w : 'I_k -> nat -> K,
  \sum_a \sum_(j < (size (c a)).-1) w a j *: hstate (drop j.+1 (c a)) = 0 -> forall a j, (j < (size (c a)).-1)%N -> w a j = 0.
Hypothesis few : (n + p <= \rank (over_fractions (pencil S)) + k)%N.

Lemma states_columns a j : (j < (size (c a)).-1)%N -> coefm j (col a (usubmx columns_of)) = - hstate (drop j.+1 (c a)).
Proof.
move=> ja; have -> : col a (usubmx columns_of) = usubmx (column_of (c a)) by rewrite -col_columns; apply/colP => i; rewrite !mxE.
apply/colP => i; have /matrixP/(_ (lshift p i) 0) := coefm_polym (size (c a)) (coefficient (c a)) j.
by rewrite (leq_trans ja) ?leq_pred // col_mxEu => e; rewrite -e !mxE.
Qed.

Theorem rows_minimal : minimal_basis (pencil S) columns_of.
Proof.
apply: minimal_basis_by_states leading_columns few.
  apply/matrixP => i a; transitivity ((pencil S *m col a columns_of) i 0); last by rewrite col_columns passes_kernel // !mxE.
  by rewrite colE mulmxA -colE [RHS]mxE.
move=> w zero a j; rewrite degree_columns; apply: (@states w); apply/eqP; rewrite -oppr_eq0 -[X in _ == X]zero -sumrN.
apply/eqP/eq_bigr => b _; rewrite -sumrN degree_columns; apply: eq_bigr => i _.
by rewrite states_columns // scalerN.
Qed.

(** The ranks of all windows. *)
Theorem seen_rank s : (k <= p)%N /\ \rank (window S s) = (s * (p - k) + \sum_(a < k) minn s (size (c a)).-1)%N.
Proof.
have [kp ranks] := basis_windows rows_minimal; split=> //; rewrite ranks; congr (_ + _)%N.
by apply: eq_bigr => a _; rewrite degree_columns.
Qed.

End OneSystem.
