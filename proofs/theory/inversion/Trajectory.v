(** When the output determines the faults. With a known initial state: iff left-invertible. With an unknown one: iff moreover every
    state from which some fault keeps the output zero keeps it zero without faults (no finite zeros but the unobservable modes); then n
    + 1 samples give v(0).

            faults_recovered S == from the same initial state no two faults give the same output
    faults_recovered_blindly S == nor from any two initial states *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Chain.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Trajectory.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x y : 'rV[K]_n) (v w : nat -> 'rV[K]_m).

(** Section: definitions. No two faults give the same output: from the same initial state, or from any two. *)
Definition faults_recovered := forall x v w, (forall k, output S x v k = output S x w k) -> forall k, v k = w k.
Definition faults_recovered_blindly := forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k.

Theorem faults_recovered_left_invertible : faults_recovered <-> left_invertible S.
Proof.
split=> [rec v silent | inv x v w same k].
  by apply: (rec 0) => k; rewrite silent output_zero.
apply/eqP; rewrite -subr_eq0; apply/eqP; apply: (inv (fun j => v j - w j)) => j.
by rewrite -[X in output S X](subrr x) output_sub same subrr.
Qed.

Notation zero_holding := (zero_holding S).

Lemma zero_holdingP x : (x <= zero_holding)%MS <-> holds_zero S n x.
Proof. exact: holdP. Qed.

(** From there a linear feedback keeps the output zero for ever. *)
Lemma zero_feedback : exists (M : 'M_n) (L : 'M_(n, m)),
  zero_holding *m sysA S + L *m sysF S = M *m zero_holding /\ zero_holding *m sysC S + L *m sysG S = 0.
Proof.
have sub : (zero_holding <= hold_step S zero_holding)%MS by apply: (iter_constant (@hold_step_mono _ _ _ _ S) (leqnSn n)).
have /fin_all_exists[w hw] : forall i, exists w : 'rV_m, row i zero_holding *m sysC S + w *m sysG S = 0 /\
    ((row i zero_holding *m sysA S + w *m sysF S)%R <= zero_holding)%MS.
  by move=> i; apply/hold_stepP; apply: submx_trans (row_sub _ _) sub.
pose L := \matrix_i w i; have /submxP[M MZ] : ((zero_holding *m sysA S + L *m sysF S)%R <= zero_holding)%MS.
  by apply/row_subP => i; rewrite linearD /= !row_mul rowK (hw i).2.
exists M, L; split=> //; apply/row_matrixP => i.
by rewrite linearD /= !row_mul rowK (hw i).1 row0.
Qed.

Lemma silent_for_ever x : holds_zero S n x <-> exists v, forall k, output S x v k = 0.
Proof.
split=> [/zero_holdingP/submxP[a ->] | [v silent]]; last by exists v.
have [M [L [next quiet]]] := zero_feedback.
pose b k := iter k (mulmx^~ M) a; exists (fun k => b k *m L) => k.
have states : state S (a *m zero_holding) (fun k => b k *m L) k = b k *m zero_holding.
  by elim: k => //= k ->; rewrite -!mulmxA -mulmxDr next mulmxA.
by rewrite /output states -!mulmxA -mulmxDr quiet mulmx0.
Qed.

Lemma unobservable x : x *m O S n = 0 <-> forall k, output S x (fun=> 0) k = 0.
Proof.
rewrite mul_O samples_eq0; split=> [zero k | zero k _ //].
pose free := with_faults S (0 : 'M_(0, n)) 0.
have free_output (u : nat -> 'rV_0) j : output free x u j = output S x (fun=> 0) j.
  by rewrite -(output_free S (0 : 'M_(0, n)) 0); apply: output_ext => i _; rewrite [u i]thinmx0.
have [|v /(_ k (leq_addl n k.+1))] := holds_zero_constant (leq_addr k.+1 n) (_ : holds_zero free n x).
  by exists (fun=> 0) => j jn; rewrite free_output zero.
by rewrite free_output.
Qed.

Theorem faults_recovered_blindly_states :
  faults_recovered_blindly <-> left_invertible S /\ forall x, holds_zero S n x -> forall k, output S x (fun=> 0) k = 0.
Proof.
split=> [rec | [inv quiet] x y v w same k].
  split=> [v silent | x /silent_for_ever[v silent] k]; first by apply: (rec 0 0 v (fun=> 0)) => k; rewrite silent output_zero.
  rewrite -[RHS](silent k); apply: output_ext => j _; apply: (rec 0 x (fun=> 0) v) => i.
  by rewrite silent output_zero.
have silent j : output S (x - y) (fun i => v i - w i) j = 0 by rewrite output_sub same subrr.
apply/eqP; rewrite -subr_eq0; apply/eqP; apply: (inv (fun i => v i - w i)) => j.
rewrite -[RHS](silent j) [RHS]output_split quiet ?add0r //.
by apply/silent_for_ever; exists (fun i => v i - w i).
Qed.

(** In dimensions: n_f, the number of finite zeros of a left-invertible system, is the dimension of the states that can hold zero. *)
Theorem faults_recovered_blindly_rank :
  faults_recovered_blindly <-> left_invertible S /\ \rank zero_holding = (n - \rank (O S n))%N.
Proof.
rewrite faults_recovered_blindly_states -mxrank_ker.
have sub : (kermx (O S n) <= zero_holding)%MS.
  by apply/row_subP => i; apply/zero_holdingP/silent_for_ever; exists (fun=> 0); apply/unobservable/sub_kermxP/row_sub.
split=> -[inv h]; split=> //.
  apply/eqP; rewrite eqn_leq (mxrankS sub) andbT; apply: mxrankS; apply/row_subP => i.
  by apply/sub_kermxP/unobservable/h/zero_holdingP/row_sub.
move=> x /zero_holdingP hx; apply/unobservable/sub_kermxP; apply: submx_trans hx _.
by rewrite -(geq_leqif (mxrank_leqif_sup sub)) h.
Qed.

(** Then n + 1 samples are enough for the first fault, hence s + n samples for s faults. *)
Theorem faults_recovered_blindly_delay : faults_recovered_blindly <->
  (forall x v, (forall k, (k <= n)%N -> output S x v k = 0) -> v 0%N = 0).
Proof.
split=> [rec x v silent | first x y v w same k].
  have : holds_zero S n (x *m sysA S + v 0%N *m sysF S).
    by exists (fun i => v i.+1) => j jn; rewrite -output_step silent.
  case/silent_for_ever => w quiet.
  apply: (rec x 0 (fun k => if k is j.+1 then w j else v 0%N) (fun=> 0) _ 0%N) => k.
  rewrite output_zero //; case: k => [|k]; first exact: (silent 0%N).
  by rewrite output_step quiet.
have silent j : output S (state S (x - y) (fun i => v i - w i) k) (fun i => v (k + i)%N - w (k + i)%N) j = 0.
  by rewrite -output_shift output_sub same subrr.
by have := first _ _ (fun j _ => silent j); rewrite addn0 => /eqP; rewrite subr_eq0 => /eqP.
Qed.

End Trajectory.
