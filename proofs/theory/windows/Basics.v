(** What is used everywhere: states and outputs are linear in (x, v), depend on the past only, and may be restarted at any time; so the
    words and the behavior form linear spaces that are closed under prefixes and suffixes. Equality of sequences is pointwise throughout,
    so functional extensionality is never needed.

    follow j v w k == v up to time j, and w from then on *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The matrix of a linear function. MathComp's mul_rV_lin1 asks for a packed linear function,
    which its versions 1 and 2 pack differently. *)
Lemma mul_lin1 (K : fieldType) a b (f : 'rV[K]_a -> 'rV[K]_b) (u : 'rV[K]_a) : linear f -> u *m lin1_mx f = f u.
Proof.
move=> lin; have f0 : f 0 = 0 by have := lin (-1) 0 0; rewrite scaler0 addr0 scaleN1r addNr.
have sum (I : Type) (s : seq I) (c : I -> K) (v : I -> 'rV[K]_a) : f (\sum_(i <- s) c i *: v i) = \sum_(i <- s) c i *: f (v i).
  by elim: s => [|i s IH]; rewrite ?big_nil // !big_cons lin IH.
by rewrite {2}[u]row_sum_delta sum; apply/rowP=> j; rewrite mxE summxE; apply: eq_bigr => i _; rewrite !mxE.
Qed.

Section Basics.
Variables (K : fieldType) (n m p : nat).
Implicit Types (S : system K n m p) (x y : 'rV[K]_n) (v w : nat -> 'rV[K]_m) (r q : nat -> 'rV[K]_p).

(** Dependence on the past only. *)
Lemma state_ext S x v w k : (forall j, (j < k)%N -> v j = w j) -> state S x v k = state S x w k.
Proof. by elim: k => //= k IH e; rewrite IH ?e // => j jk; apply: e; apply: ltnW. Qed.

Lemma output_ext S x v w k : (forall j, (j <= k)%N -> v j = w j) -> output S x v k = output S x w k.
Proof. by move=> e; rewrite /output e // (state_ext _ _ (w := w)) // => j /ltnW; apply: e. Qed.

(** Linearity. *)
Lemma state_add S x y v w k : state S (x + y) (fun j => v j + w j) k = state S x v k + state S y w k.
Proof. by elim: k => //= k ->; rewrite !mulmxDl addrACA. Qed.

Lemma output_add S x y v w k : output S (x + y) (fun j => v j + w j) k = output S x v k + output S y w k.
Proof. by rewrite /output state_add !mulmxDl addrACA. Qed.

Lemma state_scale S (a : K) x v k : state S (a *: x) (fun j => a *: v j) k = a *: state S x v k.
Proof. by elim: k => //= k ->; rewrite -!scalemxAl scalerDr. Qed.

Lemma output_scale S (a : K) x v k : output S (a *: x) (fun j => a *: v j) k = a *: output S x v k.
Proof. by rewrite /output state_scale -!scalemxAl scalerDr. Qed.

Lemma state_opp S x v k : state S (- x) (fun j => - v j) k = - state S x v k.
Proof. by elim: k => //= k ->; rewrite !mulNmx opprD. Qed.

Lemma output_opp S x v k : output S (- x) (fun j => - v j) k = - output S x v k.
Proof. by rewrite /output state_opp !mulNmx opprD. Qed.

Lemma state_sub S x y v w k : state S (x - y) (fun j => v j - w j) k = state S x v k - state S y w k.
Proof. by rewrite (state_add S x (- y) v (fun j => - w j)) state_opp. Qed.

Lemma output_sub S x y v w k : output S (x - y) (fun j => v j - w j) k = output S x v k - output S y w k.
Proof. by rewrite (output_add S x (- y) v (fun j => - w j)) output_opp. Qed.

Lemma state_zero S v k : (forall j, (j < k)%N -> v j = 0) -> state S 0 v k = 0.
Proof. by elim: k => //= k IH e; rewrite IH ?e ?mul0mx ?addr0 // => j jk; apply: e; apply: ltnW. Qed.

Lemma output_zero S v k : (forall j, (j <= k)%N -> v j = 0) -> output S 0 v k = 0.
Proof. by move=> e; rewrite /output e // state_zero ?mul0mx ?addr0 // => j /ltnW; apply: e. Qed.

Lemma state_sum S (I : Type) (s : seq I) (P : pred I) (x : I -> 'rV[K]_n) (v : I -> nat -> 'rV[K]_m) k :
  state S (\sum_(i <- s | P i) x i) (fun j => \sum_(i <- s | P i) v i j) k = \sum_(i <- s | P i) state S (x i) (v i) k.
Proof. by elim: k => //= k ->; rewrite !mulmx_suml -big_split. Qed.

Lemma output_sum S (I : Type) (s : seq I) (P : pred I) (x : I -> 'rV[K]_n) (v : I -> nat -> 'rV[K]_m) k :
  output S (\sum_(i <- s | P i) x i) (fun j => \sum_(i <- s | P i) v i j) k = \sum_(i <- s | P i) output S (x i) (v i) k.
Proof. by rewrite /output state_sum !mulmx_suml -big_split. Qed.

(** Superposition: free response plus response from rest. *)
Lemma state_split S x v k : state S x v k = state S x (fun=> 0) k + state S 0 v k.
Proof. by rewrite -state_add addr0; apply: state_ext => j _; rewrite add0r. Qed.

Lemma output_split S x v k : output S x v k = output S x (fun=> 0) k + output S 0 v k.
Proof. by rewrite -output_add addr0; apply: output_ext => j _; rewrite add0r. Qed.

(** Restarting at time j. *)
Lemma state_shift S x v j k : state S x v (j + k) = state S (state S x v j) (fun i => v (j + i)%N) k.
Proof. by elim: k => [|k IH]; rewrite ?addn0 // addnS /= IH. Qed.

Lemma output_shift S x v j k : output S x v (j + k) = output S (state S x v j) (fun i => v (j + i)%N) k.
Proof. by rewrite /output state_shift. Qed.

Lemma state_step S x v k : state S x v k.+1 = state S (x *m sysA S + v 0%N *m sysF S) (fun i => v i.+1) k.
Proof. exact: (state_shift S x v 1 k). Qed.

Lemma output_step S x v k : output S x v k.+1 = output S (x *m sysA S + v 0%N *m sysF S) (fun i => v i.+1) k.
Proof. exact: (output_shift S x v 1 k). Qed.

(** Following v up to time j and w from then on. *)
Definition follow j v w k := if (k < j)%N then v k else w (k - j)%N.

Lemma state_follow_before S x v w j k : (k <= j)%N -> state S x (follow j v w) k = state S x v k.
Proof. by move=> kj; apply: state_ext => i ik; rewrite /follow (leq_trans ik kj). Qed.

Lemma output_follow_before S x v w j k : (k < j)%N -> output S x (follow j v w) k = output S x v k.
Proof. by move=> kj; apply: output_ext => i ik; rewrite /follow (leq_ltn_trans ik kj). Qed.

Lemma state_follow_after S x v w j k : state S x (follow j v w) (j + k) = state S (state S x v j) w k.
Proof. by rewrite state_shift state_follow_before //; apply: state_ext => i _; rewrite /follow ltnNge leq_addr addKn. Qed.

Lemma output_follow_after S x v w j k : output S x (follow j v w) (j + k) = output S (state S x v j) w k.
Proof. by rewrite output_shift state_follow_before //; apply: output_ext => i _; rewrite /follow ltnNge leq_addr addKn. Qed.

(** Words. *)
Lemma output_word S s x v : word S s (output S x v). Proof. by exists x, v. Qed.
Lemma output_behavior S x v : behavior S (output S x v). Proof. by exists x, v. Qed.

Lemma word_ext S s r q : (forall k, (k < s)%N -> r k = q k) -> word S s r -> word S s q.
Proof. by move=> e [x [v h]]; exists x, v => k ks; rewrite -e ?h. Qed.

Lemma word_prefix S s t r : (s <= t)%N -> word S t r -> word S s r.
Proof. by move=> st [x [v h]]; exists x, v => k ks; apply: h; apply: leq_trans st. Qed.

Lemma word_suffix S j s r : word S (j + s) r -> word S s (fun k => r (j + k)%N).
Proof.
by move=> [x [v h]]; exists (state S x v j), (fun i => v (j + i)%N) => k ks; rewrite h ?ltn_add2l // output_shift.
Qed.

Lemma word_zero S s : word S s (fun=> 0).
Proof. by exists 0, (fun=> 0) => k _; rewrite output_zero. Qed.

Lemma word_add S s r q : word S s r -> word S s q -> word S s (fun k => r k + q k).
Proof. by move=> [x [v h]] [y [w g]]; exists (x + y), (fun j => v j + w j) => k ks; rewrite output_add h ?g. Qed.

Lemma word_scale S s (a : K) r : word S s r -> word S s (fun k => a *: r k).
Proof. by move=> [x [v h]]; exists (a *: x), (fun j => a *: v j) => k ks; rewrite output_scale h. Qed.

Lemma word_sub S s r q : word S s r -> word S s q -> word S s (fun k => r k - q k).
Proof. by move=> [x [v h]] [y [w g]]; exists (x - y), (fun j => v j - w j) => k ks; rewrite output_sub h ?g. Qed.

Lemma word_sum S s (I : Type) (t : seq I) (P : pred I) (r : I -> nat -> 'rV[K]_p) :
  (forall i, P i -> word S s (r i)) -> word S s (fun k => \sum_(i <- t | P i) r i k).
Proof.
move=> h; elim: t => [|i t IH]; first by apply: word_ext (word_zero S s) => k _; rewrite big_nil.
case Pi: (P i); last by apply: word_ext IH => k _; rewrite big_cons Pi.
by apply: word_ext (word_add (h i Pi) IH) => k _; rewrite big_cons Pi.
Qed.

(** A word goes on for ever: a word is the beginning of a member of the behavior. *)
Lemma word_extends S s r : word S s r <-> exists q, behavior S q /\ forall k, (k < s)%N -> r k = q k.
Proof.
split=> [[x [v h]]|[q [[x [v h]] e]]]; first by exists (output S x v); split; [exists x, v|].
by exists x, v => k ks; rewrite e.
Qed.

(** Behaviors. *)
Lemma behavior_word S s r : behavior S r -> word S s r.
Proof. by move=> [x [v h]]; exists x, v. Qed.

Lemma behavior_ext S r q : (forall k, r k = q k) -> behavior S r -> behavior S q.
Proof. by move=> e [x [v h]]; exists x, v => k; rewrite -e. Qed.

Lemma behavior_suffix S j r : behavior S r -> behavior S (fun k => r (j + k)%N).
Proof. by move=> [x [v h]]; exists (state S x v j), (fun i => v (j + i)%N) => k; rewrite h output_shift. Qed.

Lemma behavior_zero S : behavior S (fun=> 0).
Proof. by exists 0, (fun=> 0) => k; rewrite output_zero. Qed.

Lemma behavior_add S r q : behavior S r -> behavior S q -> behavior S (fun k => r k + q k).
Proof. by move=> [x [v h]] [y [w g]]; exists (x + y), (fun j => v j + w j) => k; rewrite output_add h g. Qed.

Lemma behavior_scale S (a : K) r : behavior S r -> behavior S (fun k => a *: r k).
Proof. by move=> [x [v h]]; exists (a *: x), (fun j => a *: v j) => k; rewrite output_scale h. Qed.

Lemma behavior_sub S r q : behavior S r -> behavior S q -> behavior S (fun k => r k - q k).
Proof. by move=> [x [v h]] [y [w g]]; exists (x - y), (fun j => v j - w j) => k; rewrite output_sub h g. Qed.

Lemma behavior_sum S (I : Type) (t : seq I) (P : pred I) (r : I -> nat -> 'rV[K]_p) :
  (forall i, P i -> behavior S (r i)) -> behavior S (fun k => \sum_(i <- t | P i) r i k).
Proof.
move=> h; elim: t => [|i t IH]; first by apply: behavior_ext (behavior_zero S) => k; rewrite big_nil.
case Pi: (P i); last by apply: behavior_ext IH => k; rewrite big_cons Pi.
by apply: behavior_ext (behavior_add (h i Pi) IH) => k; rewrite big_cons Pi.
Qed.

End Basics.

(** Other faults, same (A, C). *)
Section WithFaults.
Variables (K : fieldType) (n m p m' : nat) (S : system K n m p).

Lemma with_own_faults : with_faults S (sysF S) (sysG S) = S. Proof. by case: S. Qed.

(** Without faults the fault matrices do not matter, so free responses are shared. *)
Lemma state_free (F : 'M[K]_(m', n)) G x k : state (with_faults S F G) x (fun=> 0) k = state S x (fun=> 0) k.
Proof. by elim: k => //= k ->; rewrite !mul0mx. Qed.

Lemma output_free (F : 'M[K]_(m', n)) G x k : output (with_faults S F G) x (fun=> 0) k = output S x (fun=> 0) k.
Proof. by rewrite /output state_free !mul0mx. Qed.

(** Faults (P F, P G) act as the faults v P of S. *)
Lemma state_combined_faults (P : 'M[K]_(m', m)) x v k :
  state (with_faults S (P *m sysF S) (P *m sysG S)) x v k = state S x (fun j => v j *m P) k.
Proof. by elim: k => //= k ->; rewrite mulmxA. Qed.

Lemma output_combined_faults (P : 'M[K]_(m', m)) x v k :
  output (with_faults S (P *m sysF S) (P *m sysG S)) x v k = output S x (fun j => v j *m P) k.
Proof. by rewrite /output state_combined_faults /= mulmxA. Qed.

(** With the same (A, C), a word lies in the other system as soon as its response from rest does. *)
Lemma word_from_rest (F : 'M[K]_(m', n)) G s :
  (forall v, word S s (output (with_faults S F G) 0 v)) <-> (forall r, word (with_faults S F G) s r -> word S s r).
Proof.
split=> [h r [x [v e]]|h v]; last by apply: h; apply: output_word.
apply: word_ext (word_add (output_word S s x (fun=> 0)) (h v)) => k ks.
by rewrite e // (output_split (with_faults S F G) x v) output_free.
Qed.

Lemma behavior_from_rest (F : 'M[K]_(m', n)) G :
  (forall v, behavior S (output (with_faults S F G) 0 v)) <-> (forall r, behavior (with_faults S F G) r -> behavior S r).
Proof.
split=> [h r [x [v e]]|h v]; last by apply: h; apply: output_behavior.
apply: behavior_ext (behavior_add (output_behavior S x (fun=> 0)) (h v)) => k.
by rewrite e (output_split (with_faults S F G) x v) output_free.
Qed.

End WithFaults.
