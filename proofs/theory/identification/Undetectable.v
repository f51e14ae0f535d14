(** Faults that no data can tell from another B and D, u of any colour. v(k) = u(k) Phi acts as B + Phi F, D + Phi G. Without feedthrough
    of the fault, v(k) = u(k+1) Phi acts as B + Phi F A, D + Phi F C with the state x(k) - u(k) Phi F. So the limit of subspace
    identification is a product with O_s still, A and C are as right as they would be without a fault and with that B, and the regression
    for B and D gives these.

    with_memory == S without faults, with states more that remember u(k-1) and act as the fault u(k-1) Phi *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Signals Consistency Regression.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Undetectable.
Variables (K : fieldType) (N n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) (Phi : 'M[K]_(nu, m)).
Variables (u : nat -> 'M[K]_(N, nu)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Let none (k : nat) : 'M[K]_(N, m) := 0.

Lemma present_fault : process S B D u (fun k => u k *m Phi) x y ->
  process S (B + Phi *m sysF S) (D + Phi *m sysG S) u none x y.
Proof. by move=> model k; have [-> ->] := model k; rewrite !mulmxDr !mulmxA !mul0mx !addr0 !addrA. Qed.

Lemma next_fault : sysG S = 0 -> process S B D u (fun k => u k.+1 *m Phi) x y ->
  process S (B + Phi *m sysF S *m sysA S) (D + Phi *m sysF S *m sysC S) u none (fun k => x k - u k *m Phi *m sysF S) y.
Proof.
move=> G0 model k; have [-> ->] := model k; rewrite G0 mulmx0 addr0 !mul0mx !addr0 !mulmxDr !mulmxBl !mulmxA.
by rewrite addrK; split; rewrite addrACA addNr addr0.
Qed.

Variable Q : 'M[K]_N.

Lemma uncorrelated_with_nothing a t s (Z : 'M_(N, a)) : cov Q Z (future t s none) = 0.
Proof. by rewrite cov_future big1 // => k _; rewrite cov_zero mul0mx. Qed.

Theorem next_fault_limit t s z (Z : 'M_(N, z)) L : sysG S = 0 -> process S B D u (fun k => u k.+1 *m Phi) x y ->
  projected_limit Q Z (future t s u) (future t s y) L ->
  exists M, projected_limit Q Z (future t s u) (x t - u t *m Phi *m sysF S) M /\ L = M *m O S s.
Proof. by move=> G0 /(next_fault G0) model; apply: (two_sided_limit model); apply: uncorrelated_with_nothing. Qed.

Theorem next_fault_regression t s W B' D' : let Uf := future t s u in
  sysG S = 0 -> process S B D u (fun k => u k.+1 *m Phi) x y -> (0 < s)%N -> row_free (O S s.-1) -> W *m cov Q Uf Uf = 1%:M ->
  (W *m cov Q Uf (future t s y) - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <->
  B' = B + Phi *m sysF S *m sysA S /\ D' = D + Phi *m sysF S *m sysC S.
Proof.
move=> Uf G0 /(next_fault G0) model s0 obs hW; apply: (two_sided_regression model B' D' s0 obs hW).
exact: uncorrelated_with_nothing.
Qed.

Theorem present_fault_limit t s z (Z : 'M_(N, z)) L : process S B D u (fun k => u k *m Phi) x y ->
  projected_limit Q Z (future t s u) (future t s y) L ->
  exists M, projected_limit Q Z (future t s u) (x t) M /\ L = M *m O S s.
Proof. by move=> /present_fault model; apply: (two_sided_limit model); apply: uncorrelated_with_nothing. Qed.

Theorem present_fault_regression t s W B' D' : let Uf := future t s u in
  process S B D u (fun k => u k *m Phi) x y -> (0 < s)%N -> row_free (O S s.-1) -> W *m cov Q Uf Uf = 1%:M ->
  (W *m cov Q Uf (future t s y) - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <->
  B' = B + Phi *m sysF S /\ D' = D + Phi *m sysG S.
Proof.
move=> Uf /present_fault model s0 obs hW; apply: (two_sided_regression model B' D' s0 obs hW).
exact: uncorrelated_with_nothing.
Qed.

(** v(k) = u(k-1) Phi, given as w(k) with w(k+1) = u(k): one more group of states. *)
Definition with_memory : system K (n + nu) m p :=
  System (block_mx (sysA S) 0 (Phi *m sysF S) 0) 0 (col_mx (sysC S) (Phi *m sysG S)) 0.

Lemma past_fault (w : nat -> 'M[K]_(N, nu)) : (forall k, w k.+1 = u k) -> process S B D u (fun k => w k *m Phi) x y ->
  process with_memory (row_mx B 1%:M) D u none (fun k => row_mx (x k) (w k)) y.
Proof.
move=> wu model k; have [-> ->] := model k; rewrite wu mul_row_block mul_row_col mul_mx_row !mulmx0 mulmx1 !addr0 add_row_mx add0r !mulmxA.
by split; [congr row_mx; rewrite addrAC|rewrite addrAC].
Qed.

Theorem past_fault_limit (w : nat -> 'M[K]_(N, nu)) t s z (Z : 'M_(N, z)) L : (forall k, w k.+1 = u k) ->
  process S B D u (fun k => w k *m Phi) x y -> projected_limit Q Z (future t s u) (future t s y) L ->
  exists M, projected_limit Q Z (future t s u) (row_mx (x t) (w t)) M /\ L = M *m O with_memory s.
Proof. by move=> wu /(past_fault wu) model; apply: (two_sided_limit model); apply: uncorrelated_with_nothing. Qed.

End Undetectable.
