(** Examples about limits. Measurement noise is a fault with F = 0 and G = 1, so theorems about faults that are uncorrelated with the
    inputs lose nothing by having no noise. A = a, F = 1, C = [1 0], G = [0 1] in rows and v(k) = u(k+1), u white: with B = b the limit has
    all of the range of O_s where b and a + b are not zero, and the best fit of B and D is still wrong. The signals of the example with a
    coloured input are stationary at the times 0..3 that its limit is made of. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset order
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv ssrnum ssrint rat matrix mxalgebra mxpoly vector fraction interval.
From faultspace Require Import Vocabulary Basics Windows Signals Leads Controllable ConsistencyExamples.
From faultspace Require Import OneSided LimitsVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Noise.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (w : nat -> 'M[K]_(N, p)).
Variables (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Let noisy : system K n (m + p) p := with_faults S (col_mx (sysF S) 0) (col_mx (sysG S) 1%:M).

Lemma noise_is_a_fault :
  [/\ process noisy B D u (fun k => row_mx (v k) (w k)) x y <-> (forall k, x k.+1 = x k *m sysA S + u k *m B + v k *m sysF S /\
        y k = x k *m sysC S + u k *m D + v k *m sysG S + w k),
      forall i k, cov Q (u i) (row_mx (v k) (w k)) = 0 <-> cov Q (u i) (v k) = 0 /\ cov Q (u i) (w k) = 0
    & forall s, O noisy s = O S s].
Proof.
split=> [|i k|s].
- by split=> h k; have [ex ey] := h k; rewrite /= ex ey !mul_row_col mulmx0 mulmx1 addr0 ?addrA.
- by rewrite /cov mul_mx_row -(row_mx0 _ _ m p); split=> [/eq_row_mx|[-> ->]].
by apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k _; apply: output_free.
Qed.

End Noise.

Section WholeRangeWrongInput.
Variables (K : realFieldType) (a b : K) (N H : nat) (Q : 'M[K]_N) (u : nat -> 'cV[K]_N).
Hypotheses (symmetric : Q^T = Q) (u_white : white Q u H) (a0 : a != 0) (b0 : b != 0) (ab0 : a + b != 0).
Let S : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M).
Let B : 'M[K]_1 := b%:M.
Let v k := u k.+1.

Lemma scalar_controllable (c : K) : c != 0 -> forall z, steered S (c%:M : 'M_1) z.
Proof.
move=> c0 z; exists 1%N, (fun=> z *m (c^-1)%:M); rewrite /= mul0mx add0r -mulmxA -scalar_mxM mulVf // mulmx1 //.
Qed.

Theorem whole_range_and_wrong_input :
  [/\ forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov Q (u i) (v k) = 0, forall z, steered S B z, observable S,
      exists x y, process S B 0 u v x y /\ (forall i, (1 < i < H)%N -> cov Q (u i) (x 0%N) = 0)
    & forall x y, process S B 0 u v x y -> (forall i, (1 < i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
      (forall t q s L, (0 < q)%N -> (2 + q <= t)%N -> (t + s + 2 <= H)%N ->
        projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS) /\
      (forall t k B' D', (1 < t)%N -> (0 < k)%N -> (t + k + 2 < H)%N -> B' = B \/ D' = 0 ->
        mean_square Q S u y t k (a + b)%:M (row_mx 1%:M 0) < mean_square Q S u y t k B' D')].
Proof.
pose Phi j : 'M[K]_1 := if j is 1%N then 1%:M else 0.
have v_leads : leads 2 Phi Q H u v.
  move=> i j iH; rewrite addn2 => jH; rewrite /v u_white //.
  have [-> | ij] := eqVneq i j.+1; first by rewrite leqnSn ltnSn /Phi subSnn.
  case: ifP => // /andP[ji]; rewrite ltnS leq_eqVlt (negPf ij) /= ltnS => le_ij.
  have -> : i = j by apply/eqP; rewrite eqn_leq le_ij.
  by rewrite /Phi subnn.
have eB : seen_B S 2 Phi B = (a + b)%:M.
  by rewrite /seen_B !big_ord_recl big_ord0 addr0 /= /Phi /= mul0mx mul1mx add0r mul1mx addrC -raddfD.
have eD : seen_D S 2 Phi (0 : 'M_(1, 1 + 1)) = row_mx 1%:M 0.
  by rewrite /seen_D /= big_ord_recl big_ord0 addr0 /= /Phi /= mul0mx !add0r !mul1mx.
split.
- by move=> i k ik kH; rewrite /v u_white ?ltn_eqF // (leq_ltn_trans ik) // ltnW.
- exact: scalar_controllable.
- exact: leading_fault_observable.
- exists (fix x k := if k is j.+1 then x j *m sysA S + u j *m B + v j *m sysF S else 0).
  exists (fun k => (fix x k := if k is j.+1 then x j *m sysA S + u j *m B + v j *m sysF S else 0) k *m sysC S + u k *m 0 + v k *m sysG S).
  by split=> // i _; rewrite cov_zero.
move=> x y model start; split=> [t q s L q0 qt tH limit|t k B' D' t1 k0 tkH wrong].
  have e := white_limit model u_white v_leads start qt tH limit; rewrite e; apply/eqmxP; apply: eqmxMfull.
  rewrite /row_full reach_rows_eq eB; have c0 := scalar_controllable ab0.
  by apply/(controllable_steered_space S _ q0).
rewrite -eB -eD; apply: (worse_fit model u_white v_leads start symmetric t1 tkH).
  exact: observed.
rewrite eB eD; case: wrong => ->; [left|right] => /matrixP/(_ 0 0); rewrite /B !mxE.
  by rewrite !mulr1n => /eqP; rewrite -subr_eq0 opprD addrCA subrr addr0 oppr_eq0 (negPf a0).
by case: splitP => j //= _; rewrite !mxE ord1 => /eqP; rewrite eq_sym oner_eq0.
Qed.

End WholeRangeWrongInput.

Section Stationary.
Import Vocabulary.MovingAverage ConsistencyExamples.MovingAverage.
Let z k := row_mx (row_mx (u k) (v k)) (x k).

Lemma joint_signals k : z k = signals (1 + 1 + 1) [:: nth [::] us k; nth [::] vs k; xs k].
Proof.
apply/matrixP=> i j; rewrite [RHS]mxE !mxE; case: splitP => l el; rewrite !mxE ?ord1 ?el //; last by rewrite ord1.
by case: splitP => l' el'; rewrite !mxE ord1 el' ?ord1.
Qed.

Theorem coloured_signals_stationary i k : (i < 3)%N -> (k < 3)%N -> cov Q (z i.+1) (z k.+1) = cov Q (z i) (z k).
Proof.
move=> i3 k3; rewrite !joint_signals; apply/matrixP=> c d; rewrite !cov_entry.
apply/eqP; move: c d i i3 k k3 => [[|[|[|//]]] c3] [[|[|[|//]]] d3] [|[|[|//]]] _ [|[|[|//]]] _; vm_compute; reflexivity.
Qed.

End Stationary.
