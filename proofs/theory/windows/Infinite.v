(** Infinite time costs nothing: a sequence all of whose beginnings are words is in the behavior. The initial states that explain s samples
    shrink with s, but no more from s = n on, since their differences are the second chain of Chain.v. So an initial state that explains n
    samples explains all, and faults can be picked sample by sample (with a generalised inverse, so that no choice is needed).

     explains S s r x == some faults give r(0), ..., r(s-1) from x
     faults_for S r x == n + 1 faults that do so for n + 1 samples, where there are any
    first_fault S r x == the first of them *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Chain.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Infinite.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (r : nat -> 'rV[K]_p).

Definition explains s r x := exists v, forall k, (k < s)%N -> r k = output S x v k.

Lemma explains_more s r x : (n <= s)%N -> word S s r -> explains n r x -> explains s r x.
Proof.
move=> ns [y [w h]] [v e].
have diff : holds_zero S n (x - y).
  by exists (fun j => v j - w j) => j jn; rewrite output_sub -e // -h ?subrr // (leq_trans jn ns).
have [u hu] := holds_zero_constant ns diff.
exists (fun j => u j + w j) => k ks; rewrite -[x](subrK y) output_add hu // add0r; exact: h.
Qed.

(** A fault that explains the first of n + 1 samples, together with n later faults. *)
Definition faults_for r x : 'rV[K]_(n.+1 * m) := (samples n.+1 r - x *m O S n.+1) *m pinvmx (T S n.+1).
Definition first_fault r x := unsamples (faults_for r x) 0.

Lemma faults_forP r x : explains n.+1 r x -> forall k, (k < n.+1)%N -> r k = output S x (unsamples (faults_for r x)) k.
Proof.
move=> [v e].
suff eq_samples : samples n.+1 r = samples n.+1 (output S x (unsamples (faults_for r x))) by exact: samples_inj eq_samples.
rewrite -mul_window /window mul_row_col /faults_for mulmxKpV; first by rewrite addrC subrK.
have -> : samples n.+1 r - x *m O S n.+1 = samples n.+1 v *m T S n.+1; last exact: submxMl.
by rewrite (samples_ext e) -window_response /window mul_row_col addrC addKr.
Qed.

Lemma explains_next r x : explains n.+1 r x ->
  r 0%N = x *m sysC S + first_fault r x *m sysG S /\ explains n (fun k => r k.+1) (x *m sysA S + first_fault r x *m sysF S).
Proof.
move=> /faults_forP e; split; first exact: (e 0%N).
by exists (fun k => unsamples (faults_for r x) k.+1) => k kn; rewrite -output_step -e.
Qed.

Theorem behaviorP r : behavior S r <-> forall s, word S s r.
Proof.
split=> [h s|h]; first exact: behavior_word.
have words j s : word S s (fun k => r (j + k)%N) by apply: word_suffix.
have [x [v e]] := h n.
pose run := fix run k := if k is j.+1 then let y := run j in
  y *m sysA S + first_fault (fun i => r (j + i)%N) y *m sysF S else x.
have good k : explains n.+1 (fun i => r (k + i)%N) (run k).
  apply: explains_more (leqnSn n) (words k _) _; elim: k => [|k IH]; first by exists v.
  have [_ [w hw]] := explains_next (explains_more (leqnSn n) (words k _) IH).
  by exists w => i ik; rewrite -hw // addSnnS.
exists x, (fun k => first_fault (fun i => r (k + i)%N) (run k)) => k.
have -> : output S x (fun k => first_fault (fun i => r (k + i)%N) (run k)) k
          = run k *m sysC S + first_fault (fun i => r (k + i)%N) (run k) *m sysG S.
  by rewrite /output; congr (_ *m _ + _); elim: k => //= k ->.
by have [<- _] := explains_next (good k); rewrite addn0.
Qed.

End Infinite.

(** So comparing behaviors means comparing all words. *)
Section Comparison.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Implicit Types (r : nat -> 'rV[K]_p).

Theorem behavior_subP : (forall r, behavior S' r -> behavior S r) <-> (forall s r, word S' s r -> word S s r).
Proof.
split=> [h s r /word_extends[q [/h hq e]]|h r /behaviorP hr]; first by apply/word_extends; exists q.
by apply/behaviorP=> s; apply: h.
Qed.

End Comparison.

Section Equality.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Implicit Types (r : nat -> 'rV[K]_p).

Theorem behavior_eqP : (forall r, behavior S r <-> behavior S' r) <-> (forall s r, word S s r <-> word S' s r).
Proof.
split=> [h s r|h r]; last by split=> /behaviorP hr; apply/behaviorP=> s; apply/h.
by split=> hr; [apply: (behavior_subP _ _).1 hr|apply: (behavior_subP _ _).1 hr] => q /h.
Qed.

End Equality.
