(** Without feedthrough (G = 0) and left-invertible: all solutions of problem (11) without feedthrough lie in the row space of F, which
    is then fixed up to a basis, iff C F has full rank m and no state but zero can hold the output at zero (no finite zeros, (A, C)
    observable). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Problem11 Trajectory.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section ZeroFeedthrough.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (f x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (u : nat -> 'rV[K]_1).
Notation alone f := (with_faults S f (0 : 'rV_p)).

(** A state that holds zero: its free response is the response to a fault. *)
Lemma silent_state_solves f s : holds_zero S n f -> solves S s f 0.
Proof.
case/silent_for_ever => w silent; apply/solvesP => u.
suff [y e] : exists y, forall k, (k < s)%N -> output (alone f) 0 u k = output S 0 y k by exists 0, y.
elim: s u => [|s IH] u; first by exists (fun=> 0).
have [y e] := IH (fun k => u k.+1).
exists (fun k => if k is j.+1 then y j - u 0%N 0 0 *: w j else 0) => -[_|k ks].
  by rewrite /output /= !mul0mx mulmx0 addr0.
rewrite !output_step /= !mul0mx !add0r output_split e //.
have -> : output (alone f) (u 0%N *m f) (fun=> 0) k = - (u 0%N 0 0 *: output S 0 w k).
  have := silent k; rewrite output_split => /eqP; rewrite addr_eq0 => /eqP free.
  rewrite output_free [u 0%N]mx11_scalar mul_scalar_mx !mxE -scalerN -free -output_scale.
  by apply: output_ext => j _; rewrite scaler0.
by rewrite addrC -output_scale scaler0 -output_opp -output_add oppr0 addr0.
Qed.

(** A state of the row space of F with zero output: the fault may act one step earlier. *)
Lemma early_fault_solves f (v0 : 'rV_m) s : sysG S = 0 -> f = v0 *m sysF S -> f *m sysC S = 0 -> solves S s (f *m sysA S) 0.
Proof.
move=> G0 fE fC; apply/solvesP => u; exists (u 0%N *m f), (fun k => u k.+1 *m v0) => k _.
have states : state S (u 0%N *m f) (fun k => u k.+1 *m v0) k = state (alone (f *m sysA S)) 0 u k + u k *m f.
  elim: k => [|k IH] /=; first by rewrite add0r.
  by rewrite IH mulmxDl -!mulmxA -fE.
by rewrite /output states G0 !mulmx0 !addr0 mulmxDl -mulmxA fC mulmx0 addr0.
Qed.

Lemma faults_independent : sysG S = 0 -> left_invertible S -> row_free (sysF S).
Proof.
move=> G0 inv; apply: inj_row_free => v0 v0F; apply: (inv (fun k => if k is 0%N then v0 else 0) _ 0%N) => -[|k].
  by rewrite /output /= mul0mx G0 mulmx0 addr0.
by rewrite output_step mul0mx add0r v0F output_zero.
Qed.

Theorem zero_feedthrough s : (n < s)%N -> sysG S = 0 -> left_invertible S ->
  (forall f, solves S s f 0 -> (f <= sysF S)%MS) <-> \rank (sysF S *m sysC S) = m /\ forall x, holds_zero S n x -> x = 0.
Proof.
move=> ns G0 inv; split=> [inside | [full none] f sol].
  split.
    apply/eqP; rewrite -/(row_free _); apply: inj_row_free => v0; rewrite mulmxA => v0FC.
    have /submxP[v1 e1] := inside _ (early_fault_solves s G0 (erefl (v0 *m sysF S)) v0FC).
    apply: (inv (fun k => if k is j.+1 then if j is 0%N then - v1 else 0 else v0) _ 0%N) => k.
    have silent : forall j, output S 0 (fun=> 0) j = 0 by move=> j; apply: output_zero.
    case: k => [|[|k]]; rewrite ?output_step /= ?mul0mx ?add0r.
    - by rewrite /output /= mul0mx G0 mulmx0 addr0.
    - by rewrite /output /= G0 mulmx0 addr0.
    - by rewrite e1 mulNmx subrr.
  move=> x hx; have /submxP[v0 xE] := inside x (silent_state_solves s hx).
  have [w silent] := (silent_for_ever S x).1 hx.
  suff v00 : v0 = 0 by rewrite xE v00 mul0mx.
  apply: (inv (fun k => if k is j.+1 then w j else v0) _ 0%N) => -[|k].
    by rewrite /output /= mul0mx G0 mulmx0 addr0.
  by rewrite output_step mul0mx add0r -xE silent.
pose u k : 'rV[K]_1 := (k == n)%:R%:M; have [x [v e]] := (problem_11 S f 0 ns).1 sol _ (output_behavior _ 0 u).
have before k : (k <= n)%N -> state (alone f) 0 u k = 0.
  by move=> kn; apply: state_zero => j jk; rewrite /u ltn_eqF ?raddf0 // (leq_trans jk).
have quiet k : (k <= n)%N -> output S x v k = 0 by move=> kn; rewrite -e /output before // mul0mx mulmx0 addr0.
have rest k : (k <= n)%N -> state S x v k = 0.
  elim: k => [|k IH] kn; first by apply: none; exists v => j jn; apply: quiet; apply: ltnW.
  have := quiet _ kn; rewrite /output G0 mulmx0 addr0 /= IH ?(ltnW kn) // mul0mx add0r -mulmxA.
  move/eqP; rewrite -[0](mul0mx _ (sysF S *m sysC S)) (inj_eq (row_free_inj _)) => [/eqP ->|]; last by rewrite /row_free full.
  exact: mul0mx.
suff: v n *m sysF S - f = 0 by move/eqP; rewrite subr_eq0 => /eqP <-; apply: submxMl.
apply: none; exists (fun k => v (n.+1 + k)%N - 0) => k _; rewrite output_sub.
have -> : v n *m sysF S = state S x v n.+1 by rewrite /= rest // mul0mx add0r.
rewrite -output_shift -e output_shift /= before // mul0mx add0r /u eqxx mul1mx -(output_free S f 0).
apply/eqP; rewrite subr_eq0; apply/eqP/output_ext => j _.
by rewrite gtn_eqF ?raddf0 // addSn ltnS leq_addr.
Qed.

End ZeroFeedthrough.
