(** theorem-3 with the shortest window: one sample more than the lag of the larger system is enough, where Theorem3.v takes n + 1. And
    one fault on an observable (A, C): every nonzero solution of problem (11) is an equivalent fault. *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Basics Windows Infinite SharpWindows TransferRank Inversion Solutions Theorem3.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Sharp.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Theorem theorem_3_sharp m' (S' : system K n m' p) N : sysA S' = sysA S -> sysC S' = sysC S -> (lag S <= N)%N -> (m <= m')%N ->
  left_invertible S' -> (forall r, word S' N.+1 r -> word S N.+1 r) ->
  (forall s r, word S s r <-> word S' s r) /\ (forall r, behavior S r <-> behavior S' r).
Proof.
move=> sameA sameC lagN mm' invertible words.
have sub := (behavior_subP _ _).1 ((inclusion_on_lag_plus_1_samples _ lagN).1 words).
have eq_words := equal_words_of_left_invertible sameA sameC mm' invertible sub.
by split=> //; apply/behavior_eqP.
Qed.

Variables (s k : nat) (Z : 'M[K]_(k, n + p)).
Hypotheses (long : (lag S < s)%N) (span : spans_solutions S s Z).

Theorem theorem_3_normal_rank_sharp m' (P : 'M_(m', k)) :
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> \rank (transfer (faults_of S (P *m Z))) = \rank (transfer S).
Proof.
have sub : forall t r, word (faults_of S (P *m Z)) t r -> word S t r.
  case: s long span => // N lagN spanN.
  apply: (behavior_subP _ _).1; have := (inclusion_on_lag_plus_1_samples (faults_of S (P *m Z)) lagN).1; apply.
  apply/(included_rows _ _ spanN).
  by rewrite hsubmxK submxMl.
have eq_rank := @equal_words_iff_normal_rank K n m m' p S (faults_of S (P *m Z)) erefl erefl sub.
by rewrite -eq_rank behavior_eqP; split=> e t r; split=> /e.
Qed.

Theorem theorem_3_criterion_sharp (P : 'M_(m, k)) : left_invertible S ->
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> left_invertible (faults_of S (P *m Z)).
Proof. by rewrite theorem_3_normal_rank_sharp !left_invertible_transfer_rank => ->. Qed.

End Sharp.

(** One fault. *)
Section SingleFault.
Variables (K : fieldType) (n p : nat).

Lemma observable_single_left_invertible (S : system K n 1 p) : row_free (O S n) -> row_mx (sysF S) (sysG S) != 0 -> left_invertible S.
Proof.
move=> obs nonzero; apply: (delay_left_invertible (l := n)) => v silent; rewrite [v 0%N]mx11_scalar.
suff -> : v 0%N 0 0 = 0 by exact: raddf0.
apply: contraNeq nonzero => v0; apply/eqP.
have cancel a (M : 'M_(1, a)) : v 0%N *m M = 0 -> M = 0.
  by rewrite [v 0%N]mx11_scalar mul_scalar_mx => /eqP; rewrite scaler_eq0 (negPf v0) => /eqP.
have G0 : sysG S = 0 by apply: cancel; have := silent 0%N isT; rewrite /output /= mul0mx add0r.
suff F0 : sysF S = 0 by rewrite F0 G0 row_mx0.
have free_zero k : (k < n)%N -> output S (sysF S) (fun=> 0) k = 0.
  move: k; suff prefix j : (j <= n)%N -> forall k, (k < j)%N -> output S (sysF S) (fun=> 0) k = 0 by apply: (prefix n).
  elim: j => // j IH jn k; rewrite ltnS leq_eqVlt => /orP[/eqP ->|]; last exact: IH (ltnW jn) k.
  have before := IH (ltnW jn).
  have scaled (w : 'rV_1) i : output S (w *m sysF S) (fun=> 0) i = w *m output S (sysF S) (fun=> 0) i.
    rewrite [w]mx11_scalar !mul_scalar_mx -output_scale; apply: output_ext => l _; by rewrite scaler0.
  have quiet (w : nat -> 'rV_1) i : (i <= j)%N -> output S 0 w i = 0.
    elim: i w => [|i IHi] w ij; first by rewrite /output mul0mx G0 mulmx0 addr0.
    by rewrite output_step mul0mx add0r output_split IHi ?(ltnW ij) // scaled before // mulmx0 addr0.
  apply: cancel; rewrite -scaled; have := silent j.+1 jn.
  by rewrite output_step mul0mx add0r output_split quiet // addr0.
by apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0.
Qed.

Theorem single_fault (S : system K n 1 p) s k (Z : 'M[K]_(k, n + p)) (P : 'rV_k) : (lag S < s)%N -> spans_solutions S s Z ->
  left_invertible S -> row_free (O S n) -> P *m Z != 0 -> forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r.
Proof.
move=> long span inv obs nonzero; apply/(theorem_3_criterion_sharp long span P inv).
apply: observable_single_left_invertible; last by rewrite hsubmxK.
suff -> : O (faults_of S (P *m Z)) n = O S n by [].
by apply/row_matrixP => i; rewrite !rowK; apply: samples_ext => j _; rewrite output_free.
Qed.

End SingleFault.
