(** theorem-1, repaired: restricted behaviours that are equal on n + 1 samples, n the larger number of states, are equal on every window,
    and so are the behaviors, in infinite time. (As the paper states it, on n samples, it is false: see Theorem1Sharp.v.) For an inclusion
    the number of states of the larger behaviour is enough. Nothing else is assumed; the systems may have different numbers of faults. *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Basics Windows Infinite Gap.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

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

Theorem inclusion_on_n_plus_1_samples N : (n <= N)%N ->
  (forall r, word S' N.+1 r -> word S N.+1 r) <-> (forall s r, word S' s r -> word S s r).
Proof.
move=> nN; split=> [|h r]; last exact: h.
by apply: inclusion_past_settled_gap => s Ns; rewrite !gap_constant // (leq_trans nN Ns).
Qed.

Theorem theorem_1_inclusion N : (n <= N)%N ->
  (forall r, word S' N.+1 r -> word S N.+1 r) <-> (forall r, behavior S' r -> behavior S r).
Proof. by move=> nN; rewrite behavior_subP; apply: inclusion_on_n_plus_1_samples. Qed.

End Inclusion.

Section Equality.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Implicit Types (s N : nat) (r : nat -> 'rV[K]_p).

Theorem equal_on_n_plus_1_samples N : (n <= N)%N -> (n' <= N)%N ->
  (forall r, word S N.+1 r <-> word S' N.+1 r) <-> (forall s r, word S s r <-> word S' s r).
Proof.
move=> nN nN'; split=> [h s r|h r]; last exact: h.
by split; [apply: (inclusion_on_n_plus_1_samples S' S nN').1|apply: (inclusion_on_n_plus_1_samples S S' nN).1] => q /h.
Qed.

Theorem theorem_1 : (forall r, word S (maxn n n').+1 r <-> word S' (maxn n n').+1 r) <-> (forall r, behavior S r <-> behavior S' r).
Proof. by rewrite behavior_eqP; apply: equal_on_n_plus_1_samples; rewrite ?leq_maxl ?leq_maxr. Qed.

(** So equality of behaviors is decided by row spaces. *)
Theorem theorem_1_window : (window S (maxn n n').+1 == window S' (maxn n n').+1)%MS <-> (forall r, behavior S r <-> behavior S' r).
Proof. by rewrite -theorem_1; apply: window_eqP. Qed.

End Equality.
