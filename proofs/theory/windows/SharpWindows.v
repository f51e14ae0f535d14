(** The theorems with the shortest window they hold for, and with n. proposition-3 holds exactly from s = lag on, so does theorem-2 with
    zeta = n - sum of the left indices. theorem-1, repaired: restricted behaviours that are equal on one sample more than both lags are
    equal on every window, and so are the behaviors, in infinite time. The lag is at most n, and often far less, so n + 1 samples are
    enough, n the larger number of states. (On n samples, as the paper states it, it is false: see Theorem1Sharp.v.) For an inclusion the
    lag of the larger behaviour is enough. Nothing else is assumed; the systems may have different numbers of faults. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Infinite Gap Proposition3 Lag.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section OneSystem.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (s : nat).

Lemma last_gap_is_m : left_invertible S -> gap S n = m.
Proof. by move=> /(gap_left_invertible S (leqnn n)). Qed.

(** Exact from the lag on, and never before. *)
Theorem proposition_3_sharp s : left_invertible S -> \rank (window S s.+1) = (\rank (window S s) + m)%N <-> (lag S <= s)%N.
Proof. by move=> linv; rewrite rank_window_step -(lagP S) last_gap_is_m //; split=> [/addnI|->]. Qed.

Theorem theorem_2 s : left_invertible S -> (\rank (window S s) + zeta S = n + s * m)%N <-> (lag S <= s)%N.
Proof. by move=> linv; rewrite -rank_window_zeta last_gap_is_m. Qed.

(** In general the gap is at least its last value, and larger before the lag. *)
Theorem gap_sharp s : \rank (window S s.+1) = (\rank (window S s) + gap S n)%N <-> (lag S <= s)%N.
Proof. by rewrite rank_window_step -(lagP S); split=> [/addnI|->]. Qed.

(** With as many independent outputs as faults there is no left index, and every window is right. *)
Theorem lag_square : gap S n = p -> lag S = 0%N.
Proof.
move=> full; apply/eqP; rewrite -leqn0; apply/lagP/eqP; rewrite eqn_leq; apply/andP; split; last exact: gap_decreasing.
by rewrite full gap_le_outputs.
Qed.

End OneSystem.

Section Inclusion.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Implicit Types (s N : nat) (r : nat -> 'rV[K]_p).

(** A window longer by one than where the gap of S has settled shows inclusion in S. *)
Lemma inclusion_past_settled_gap N : (forall s, (N <= s)%N -> gap S s = gap S N) ->
  (forall r, word S' N.+1 r -> word S N.+1 r) -> forall s r, word S' s r -> word S s r.
Proof.
move=> settled incl s r /word_extends[q [q_beh e]].
apply: (word_ext (r := q)) => [k ks|]; first by rewrite e.
apply: (glue settled) => j; apply/incl/behavior_word; exact: behavior_suffix.
Qed.

(** For an inclusion, the lag of the larger behavior plus one; on all windows, and in infinite time. *)
Theorem words_on_lag_plus_1_samples N : (lag S <= N)%N ->
  (forall r, word S' N.+1 r -> word S N.+1 r) <-> (forall s r, word S' s r -> word S s r).
Proof.
move=> lN; split=> [|h r]; last exact: h.
apply: inclusion_past_settled_gap => s Ns; rewrite (gap_from_lag lN) gap_from_lag //; exact: leq_trans Ns.
Qed.

Theorem inclusion_on_lag_plus_1_samples N : (lag S <= N)%N ->
  (forall r, word S' N.+1 r -> word S N.+1 r) <-> (forall r, behavior S' r -> behavior S r).
Proof. by move=> lN; rewrite behavior_subP; apply: words_on_lag_plus_1_samples. Qed.

Theorem inclusion_on_n_plus_1_samples N : (n <= N)%N ->
  (forall r, word S' N.+1 r -> word S N.+1 r) <-> (forall s r, word S' s r -> word S s r).
Proof. by move=> nN; apply: words_on_lag_plus_1_samples; apply: leq_trans (lag_le_n S) nN. Qed.

End Inclusion.

Section Equality.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Implicit Types (s N : nat) (r : nat -> 'rV[K]_p).

Theorem theorem_1_sharp N : (lag S <= N)%N -> (lag S' <= N)%N ->
  (forall r, word S N.+1 r <-> word S' N.+1 r) <-> (forall r, behavior S r <-> behavior S' r).
Proof.
move=> lN lN'; split=> h r.
  by split; [apply: (inclusion_on_lag_plus_1_samples S lN').1|apply: (inclusion_on_lag_plus_1_samples S' lN).1] => q /h.
by split=> /word_extends[q [/h q_beh e]]; apply/word_extends; exists q.
Qed.

Theorem equal_on_n_plus_1_samples N : (n <= N)%N -> (n' <= N)%N ->
  (forall r, word S N.+1 r <-> word S' N.+1 r) <-> (forall s r, word S s r <-> word S' s r).
Proof.
move=> nN nN'; split=> [h s r|h r]; last exact: h.
by split; [apply: (inclusion_on_n_plus_1_samples S' S nN').1|apply: (inclusion_on_n_plus_1_samples S S' nN).1] => q /h.
Qed.

Theorem theorem_1 : (forall r, word S (maxn n n').+1 r <-> word S' (maxn n n').+1 r) <-> (forall r, behavior S r <-> behavior S' r).
Proof. by apply: theorem_1_sharp; apply: leq_trans (lag_le_n _) _; rewrite ?leq_maxl ?leq_maxr. Qed.

(** So equality of behaviors is decided by row spaces. *)
Theorem theorem_1_window : (window S (maxn n n').+1 == window S' (maxn n n').+1)%MS <-> (forall r, behavior S r <-> behavior S' r).
Proof. by rewrite -theorem_1; apply: window_eqP. Qed.

Lemma equal_words_equal_ranks s : (forall r, word S s r <-> word S' s r) -> \rank (window S s) = \rank (window S' s).
Proof. by move=> h; apply: eqmx_rank; apply/window_eqP. Qed.

Lemma equal_words_shorter s t : (s <= t)%N ->
  (forall r, word S t r <-> word S' t r) -> forall r, word S s r <-> word S' s r.
Proof.
move=> st h r; split=> /word_extends[q [q_beh e]].
  by apply: (word_ext (r := q)) => [k ks|]; [rewrite e|apply/(word_prefix st)/h/behavior_word].
by apply: (word_ext (r := q)) => [k ks|]; [rewrite e|apply/(word_prefix st)/h/behavior_word].
Qed.

(** With equal last gaps (normal ranks), the lag of either system plus one. *)
Theorem theorem_1_either_lag N : gap S n = gap S' n' -> (lag S <= N)%N ->
  (forall r, word S N.+1 r <-> word S' N.+1 r) <-> (forall r, behavior S r <-> behavior S' r).
Proof.
move=> same_gap lN; split=> h.
  suff lN' : (lag S' <= N)%N by apply/(theorem_1_sharp lN lN').
  apply/lagP; rewrite -same_gap -(lagP S N).2 //; apply: (@addnI (\rank (window S' N))).
  by rewrite -rank_window_step -(equal_words_equal_ranks h) -(equal_words_equal_ranks (equal_words_shorter (leqnSn N) h)) rank_window_step.
by move=> r; split=> /word_extends[q [/h q_beh e]]; apply/word_extends; exists q.
Qed.

End Equality.
