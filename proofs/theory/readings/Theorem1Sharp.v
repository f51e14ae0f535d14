(** theorem-1 needs its n + 1 samples for every n >= 1: a shift register of n states whose end is fed by the fault, or not. The first output
    shows the other end, the second one the fault itself, so both systems are left-invertible, and A, C, G are the same. They agree on n
    samples; at time n the fed register shows the fault of time 0.

    register n c == a shift register of n + 1 states, fed by c v, that shows its other end, and v beside it *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv matrix mxpoly fraction.
From faultspace Require Import Vocabulary Basics.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Register.
Variables (K : fieldType) (n : nat).
Implicit Types (c : K) (x : 'rV[K]_n.+1) (v : nat -> 'rV[K]_1).

Definition register c : system K n.+1 1 2 :=
  System (\matrix_(i, j) (i == j.+1 :> nat)%:R) (c *: delta_mx 0 ord_max) (delta_mx 0 0) (delta_mx 0 1).

Lemma state_register c x v k (j : 'I_n.+1) :
  state (register c) x v k 0 j = if (j + k <= n)%N then x 0 (inord (j + k)) else v (j + k - n.+1)%N 0 0 * c.
Proof.
elim: k j => [|k IH] j; first by rewrite addn0 -ltnS ltn_ord inord_val.
rewrite /= !mxE big_ord1 !mxE eqxx /=; have [j_end|j_end] := eqVneq j ord_max.
  rewrite big1 => [|i _]; last by rewrite !mxE j_end /= ltn_eqF ?mulr0 // ltn_ord.
  by rewrite j_end /= leqNgt addnS ltnS leq_addr /= subSS addKn mulr1 add0r.
have jn : (j.+1 < n.+1)%N by rewrite ltn_neqAle ltn_ord andbT -(inj_eq val_inj) in j_end *.
rewrite !mulr0 addr0 (bigD1 (Ordinal jn)) //= big1 => [|i]; last first.
  by rewrite -(inj_eq val_inj) !mxE /= => /negbTE->; rewrite mulr0.
by rewrite addr0 mxE eqxx mulr1 IH /= addSnnS.
Qed.

Lemma output_register c x v k : output (register c) x v k = \row_i (if i == 0 then state (register c) x v k 0 0 else v k 0 0).
Proof.
apply/rowP=> i; rewrite !mxE big_ord1 !mxE eqxx (bigD1 0) //= big1 => [|j /negbTE j0]; last by rewrite !mxE j0 mulr0.
rewrite !mxE eqxx addr0 /=; have [->|i0] := eqVneq i 0; first by rewrite mulr1 mulr0 addr0.
have -> : i = 1 by apply: val_inj; case: i i0 => -[|[|[]]].
by rewrite mulr0 mulr1 add0r.
Qed.

Lemma register_left_invertible c : left_invertible (register c).
Proof.
move=> v out0 k; apply/rowP=> j; rewrite ord1 mxE.
by move/rowP/(_ 1): (out0 k); rewrite output_register !mxE.
Qed.

Lemma register_same_word c c' s r : (s <= n.+1)%N -> word (register c) s r -> word (register c') s r.
Proof.
move=> sn [x [v h]]; exists x, v => k ks; rewrite h // !output_register.
by apply/rowP=> i; rewrite !mxE !state_register /= -ltnS (leq_trans ks sn).
Qed.

Lemma register_differs : exists r, word (register 1) n.+2 r /\ ~ word (register 0) n.+2 r.
Proof.
exists (output (register 1) 0 (fun k => (k == 0%N)%:R%:M)); split; first exact: output_word.
case=> x [v /(_ n.+1 (ltnSn _))]; rewrite !output_register => /rowP/(_ 0); rewrite [LHS]mxE [RHS]mxE !eqxx !state_register /=.
by rewrite add0n ltnn subnn mulr0 mulr1 eqxx mxE => /eqP; rewrite oner_eq0.
Qed.

End Register.

(** n samples are not enough, for every n >= 1, even with the same A, C, G and both systems left-invertible. *)
Theorem n_samples_are_not_enough (K : fieldType) n : (0 < n)%N ->
  exists (S : system K n 1 2) (F : 'M[K]_(1, n)), let S' := with_faults S F (sysG S) in
  [/\ left_invertible S, left_invertible S', forall r, word S n r <-> word S' n r & exists r, word S' n.+1 r /\ ~ word S n.+1 r].
Proof.
case: n => // n _; exists (register n (0 : K)), (1 *: delta_mx 0 ord_max) => S'.
split; [exact: register_left_invertible|exact: register_left_invertible| |exact: register_differs].
by move=> r; split; apply: register_same_word.
Qed.

Corollary behaviors_differ (K : fieldType) n : (0 < n)%N ->
  exists (S S' : system K n 1 2), (forall r, word S n r <-> word S' n r) /\ ~ (forall r, behavior S r <-> behavior S' r).
Proof.
move=> /(n_samples_are_not_enough K)[S [F [_ _ same [r [r_in r_out]]]]]; exists S, (with_faults S F (sysG S)); split=> // h.
case/word_extends: r_in => q [/h/behavior_word q_word e]; apply: r_out; apply: word_ext (q_word _) => k ks; exact/esym/e.
Qed.
