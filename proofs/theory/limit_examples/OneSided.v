(** What one-sided exogeneity allows, in one statement for each reading. u is white, as white_exists says there is for every horizon H,
    and all systems are A = a, F = 1, C = [1 0], G = [0 1] in rows, with B such that the fault hides the state: v(k) = u(k+1), B = -a,
    where x = u; or v(k) = u(k), B = -1, where x = 0. The best fit of B and D, given the true A and C, is not the true one. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset order
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv ssrnum ssrint rat matrix mxalgebra mxpoly vector fraction interval.
From faultspace Require Import Vocabulary Windows Places Consistency ConsistencyExamples OutputError SmallSystems.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma leading_fault_observable (K : fieldType) (a : K) : observable (leading_fault a).
Proof.
apply: observable_from_zeros => x /(_ 0%N isT); rewrite /output /= mul0mx addr0 mul_mx_row mulmx1 mulmx0 -row_mx0.
by case/eq_row_mx.
Qed.

Lemma worse_fit (K : realFieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B B' : 'M_(nu, n)) (D D' : 'M_(nu, p))
    u v x y H J Phi t k :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) -> Q^T = Q ->
  (J <= t)%N -> (t + k + J < H)%N -> row_free (O S k) -> B' <> seen_B S J Phi B \/ D' <> seen_D S J Phi D ->
  mean_square Q S u y t k (seen_B S J Phi B) (seen_D S J Phi D) < mean_square Q S u y t k B' D'.
Proof.
move=> model u_white v_leads past symmetric Jt tH free differ.
have /= [least unique] := least_squares model u_white v_leads past B' D' symmetric Jt tH.
rewrite lt_neqAle least andbT; apply/eqP => e; have [eB eD] := unique free (esym e).
by case: differ => [/(_ eB)|/(_ eD)].
Qed.

Section OneSided.
Variables (K : realFieldType) (a : K) (N H : nat) (Q : 'M[K]_N) (u : nat -> 'cV[K]_N).
Hypotheses (symmetric : Q^T = Q) (u_white : white Q u H).
Notation S := (leading_fault a).

Lemma observed k : (0 < k)%N -> row_free (O S k).
Proof.
move=> k0; apply: inj_row_free => x; rewrite mul_O => /samples_eq0/(_ 0%N k0).
by rewrite /output /= mul0mx addr0 mul_mx_row mulmx1 mulmx0 -row_mx0 => /eq_row_mx[].
Qed.

Theorem one_sided_moves_B_and_D : a != 0 -> let v k := u k.+1 in let y k := row_mx (u k) (u k.+1) in let B := (- a)%:M in
  [/\ process S B 0 u v u y, forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov Q (u i) (v k) = 0,
      fault_controllable (with_faults S B 0), observable S
    & forall t k B' D', (1 < t)%N -> (0 < k)%N -> (t + k + 2 < H)%N -> B' = B \/ D' = 0 ->
      mean_square Q S u y t k 0 (row_mx 1%:M 0) < mean_square Q S u y t k B' D'].
Proof.
move=> a0 v y B; have [model one_sided _ _ _] := zero_limit a u_white.
split; [exact: model|exact: one_sided| |exact: leading_fault_observable|].
  move=> z; exists 1%N, (fun=> - (z *m (a^-1)%:M)); rewrite /= mul0mx add0r mulNmx -mulmxA -scalar_mxM mulrN mulVf //.
  by rewrite raddfN mulmxN opprK mulmx1.
move=> t k B' D' t1 k0 tkH wrong; pose Phi j : 'M[K]_1 := if j is 1%N then 1%:M else 0.
have v_leads : leads 2 Phi Q H u v.
  move=> i j iH; rewrite addn2 => jH; rewrite /v u_white //.
  have [-> | ij] := eqVneq i j.+1; first by rewrite leqnSn ltnSn /Phi subSnn.
  case: ifP => // /andP[ji]; rewrite ltnS leq_eqVlt (negPf ij) /= ltnS => le_ij.
  have -> : i = j by apply/eqP; rewrite eqn_leq le_ij.
  by rewrite /Phi subnn.
have eB : seen_B S 2 Phi B = 0.
  rewrite /seen_B !big_ord_recl big_ord0 addr0 /= /Phi /= mul0mx mul1mx add0r mul1mx.
  by rewrite /B raddfN addNr.
have eD : seen_D S 2 Phi (0 : 'M_(1, 1 + 1)) = row_mx 1%:M 0.
  by rewrite /seen_D /= big_ord_recl big_ord0 addr0 /= /Phi /= mul0mx !add0r !mul1mx.
rewrite -{1}eB -eD; apply: (worse_fit model u_white v_leads _ symmetric t1 tkH (observed k0)).
  by move=> i /andP[i2 iH]; rewrite u_white ?(leq_ltn_trans _ iH) //; case: i i2 {iH}.
rewrite eB eD; case: wrong => ->; [left|right] => /matrixP/(_ 0 0); rewrite /B !mxE.
  by move/eqP; rewrite mulr1n oppr_eq0 (negPf a0).
by case: splitP => j //= _; rewrite !mxE ord1 => /eqP; rewrite eq_sym oner_eq0.
Qed.

(** The same window of u and v is then correlated. *)
Theorem one_sided_windows_correlated t s : (1 < s)%N -> (t + s < H)%N ->
  cov Q (future t s u) (future t s (fun k => u k.+1)) <> 0.
Proof.
case: s => [|[|s]] // _ tsH /(congr1 (fun M => place K 1 (1 : 'I_s.+2) *m M *m (place K 1 (0 : 'I_s.+2))^T)).
rewrite mulmx0 mul0mx cov_future !mulmx_sumr mulmx_suml (bigD1 ord0) //= big1 ?addr0 => [|k k0]; last first.
  by rewrite -!mulmxA place_orthonormal (negPf (k0 : k != 0 :> nat)%N) !mulmx0.
rewrite cov_future_left !mulmxA mulmx_sumr !mulmx_suml (bigD1 (1 : 'I_s.+2)) //= big1 ?addr0 => [|k k1]; last first.
  by rewrite !mulmxA place_orthonormal eq_sym (negPf (k1 : k != 1 :> nat)%N) !mul0mx.
rewrite !mulmxA place_orthonormal eqxx mul1mx -mulmxA place_orthonormal eqxx mulmx1 addn0 modn_small // addn1.
have tH : (t.+1 < H)%N by apply: leq_ltn_trans tsH; rewrite -addn1 leq_add2l.
by rewrite -/(cov Q _ _) u_white // eqxx => /matrixP/(_ 0 0)/eqP; rewrite !mxE oner_eq0.
Qed.

(** With lag zero left out: v = u. *)
Theorem same_time_moves_B_and_D : let B := - 1%:M in let y k := row_mx 0 (u k) in
  [/\ process S B 0 u u (fun=> 0) y, forall i k, i != k -> (i < H)%N -> (k < H)%N -> cov Q (u i) (u k) = 0,
      fault_controllable (with_faults S B 0), observable S
    & forall t k B' D', (0 < t)%N -> (0 < k)%N -> (t + k + 1 < H)%N -> B' = B \/ D' = 0 ->
      mean_square Q S u y t k 0 (row_mx 0 1%:M) < mean_square Q S u y t k B' D'].
Proof.
move=> B y; have model : process S B 0 u u (fun=> 0) y.
  move=> k; rewrite /= !mul0mx !mulmx0 mulmxN !mulmx1 add0r addNr; split=> //.
  by rewrite mul_mx_row mulmx0 mulmx1 !add0r.
split; [exact: model| | |exact: leading_fault_observable|].
- by move=> i k /negbTE ik iH kH; rewrite u_white ?ik.
- by move=> z; exists 1%N, (fun=> - z); rewrite /= mul0mx add0r mulmxN mulmx1 opprK.
move=> t k B' D' t0 k0 tkH wrong; pose Phi j : 'M[K]_1 := if j is 0%N then 1%:M else 0.
have v_leads : leads 1 Phi Q H u u.
  move=> i j iH; rewrite addn1 => jH; rewrite u_white // ltnS andbC -eqn_leq.
  by case: eqP => // ->; rewrite subnn.
have eB : seen_B S 1 Phi B = 0 by rewrite /seen_B big_ord_recl big_ord0 addr0 /= mul1mx addNr.
have eD : seen_D S 1 Phi (0 : 'M_(1, 1 + 1)) = row_mx 0 1%:M by rewrite /seen_D /= big_ord0 addr0 add0r mul1mx.
rewrite -{1}eB -eD; apply: (worse_fit model u_white v_leads _ symmetric t0 tkH (observed k0)).
  by move=> i _; rewrite /cov mulmx0.
rewrite eB eD; case: wrong => ->; [left|right].
  by move=> /matrixP/(_ 0 0)/eqP; rewrite /B !mxE oppr_eq0 oner_eq0.
by rewrite -row_mx0 => /esym/eq_row_mx[_ /matrixP/(_ 0 0)/eqP]; rewrite !mxE oner_eq0.
Qed.
End OneSided.

(** A coloured input, u = e(k) + e(k-1)/2 and v = e(k+1): the limit exists and is not in the range of O_s. *)
Theorem coloured_limit_outside : [/\ process MovingAverage.S 1%:M 0 MovingAverage.u MovingAverage.v MovingAverage.x MovingAverage.y,
  forall i k, (i <= k < 4)%N -> cov MovingAverage.Q (MovingAverage.u i) (MovingAverage.v k) = 0,
  fault_controllable (with_faults MovingAverage.S 1%:M 0), observable MovingAverage.S
  & let Y := future 2 2 MovingAverage.y in let U := future 2 2 MovingAverage.u in let Z := future 0 2 MovingAverage.u in
    (exists L, projected_limit MovingAverage.Q Z U Y L) /\
    forall L, projected_limit MovingAverage.Q Z U Y L -> ~ (L <= O MovingAverage.S 2)%MS].
Proof.
split; [exact: MovingAverage.signals_process|exact: MovingAverage.signals_one_sided| |exact: leading_fault_observable|split].
- by move=> z; exists 1%N, (fun=> z); rewrite /= mul0mx add0r mulmx1.
- exact: MovingAverage.limit_exists.
by move=> L /MovingAverage.limit_of_rank_2 rank2 /mxrankS; rewrite rank2 ltnNge rank_leq_row.
Qed.
