(** With the true A and C, and u white, the least squares fit of B and D to the outputs gives B seen and D seen of a fault that leads u,
    and nothing else: the predictions from (B seen, D seen) leave an error that is uncorrelated with the inputs they are made of, so any
    other B, D adds its own distance. Predictions start from rest at any time t; the fit is the same for each number of samples that
    observes (A, C). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Signals Leads Regression OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Predictions.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (u : nat -> 'M[K]_(N, nu)).
Implicit Types (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).

(** A prediction is what the model (A, B, C, D) gives from rest at time t. *)
Lemma prediction_process B D t (z : nat -> 'M[K]_(N, n)) : z 0%N = 0 ->
  (forall k, z k.+1 = z k *m sysA S + u (t + k)%N *m B) ->
  forall k, prediction S B D u t k = z k *m sysC S + u (t + k)%N *m D.
Proof.
move=> z0 step k; rewrite /prediction big_ord_recr /= subnn; congr (_ + _).
have -> : z k = \sum_(i < k) u (t + i)%N *m times_power S B (k.-1 - i).
  elim: k => [|k IH]; first by rewrite big_ord0.
  rewrite step IH big_ord_recr /= subnn mulmx_suml; congr (_ + _); apply: eq_bigr => i _.
  by case: k i {IH} => [[]//|k] i; rewrite -mulmxA subSn // -ltnS.
rewrite mulmx_suml; apply: eq_bigr => i _; rewrite -mulmxA.
by case: k i => [[]//|k] i; rewrite /= subSn // -ltnS.
Qed.

Lemma impulse_sub B B' D D' d : impulse S (B - B') (D - D') d = impulse S B D d - impulse S B' D' d.
Proof.
by case: d => //= d; rewrite times_power_add times_power_opp mulmxDl mulNmx.
Qed.

Lemma prediction_sub B B' D D' t k :
  prediction S (B - B') (D - D') u t k = prediction S B D u t k - prediction S B' D' u t k.
Proof.
by rewrite -sumrN -big_split; apply: eq_bigr => i _ /=; rewrite impulse_sub mulmxDr mulmxN.
Qed.

Variable H : nat.
Hypothesis u_white : white Q u H.

Lemma cov_prediction B D t k i : (t + k < H)%N -> (i <= k)%N -> cov Q (u (t + i)%N) (prediction S B D u t k) = impulse S B D (k - i).
Proof.
move=> tH ik; have iH (j : nat) : (j <= k)%N -> (t + j < H)%N by lia.
rewrite cov_sum (bigD1 (Ordinal (ik : i < k.+1)%N)) //= big1 => [|j].
  by rewrite addr0 cov_mul u_white ?iH // eqxx mul1mx.
have jk : (j <= k)%N by rewrite -ltnS.
by rewrite -val_eqE cov_mul u_white ?iH //= eqn_add2l eq_sym => /negbTE->; rewrite mul0mx.
Qed.

Lemma cov_predictions B D t k : (t + k < H)%N -> let z := prediction S B D u t k in
  cov Q z z = \sum_(d < k.+1) (impulse S B D d)^T *m impulse S B D d.
Proof.
move=> tH; rewrite /= {1}/prediction cov_sum_left (reindex_inj rev_ord_inj); apply: eq_bigr => d _ /=.
by rewrite cov_mul_left subSS cov_prediction ?leq_subr // subKn // -ltnS.
Qed.

End Predictions.

Section Fit.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Variables (H J : nat) (Phi : nat -> 'M[K]_(nu, m)).
Hypotheses (model : process S B D u v x y) (u_white : white Q u H) (v_leads : leads J Phi Q H u v).
Hypothesis past_state : forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0.
Let Bs := seen_B S J Phi B.
Let Ds := seen_D S J Phi D.
Variables t k : nat.
Hypotheses (Jt : (J <= t)%N) (tH : (t + k + J < H)%N).

(** Normal equations: the error of the prediction from B and D seen is uncorrelated with every prediction. *)
Lemma error_uncorrelated i : (i <= k)%N -> cov Q (u (t + i)%N) (y (t + k)%N - prediction S Bs Ds u t k) = 0.
Proof.
move=> ik; have Ji : (J <= t + i)%N by apply: leq_trans Jt (leq_addr _ _).
rewrite cov_sub (cov_prediction S u_white) //; last lia.
case e : (k - i)%N => [|d].
  have -> : k = i by apply/eqP; rewrite eqn_leq ik -subn_eq0 e.
  rewrite (cov_output_now model u_white v_leads past_state Ji) ?subrr //; lia.
have -> : (t + k)%N = ((t + i).+1 + d)%N by rewrite -(subnKC ik) e addnA addnS.
rewrite (cov_output_after model u_white v_leads past_state Ji) ?subrr //; lia.
Qed.

Theorem normal_equations B' D' : cov Q (prediction S B' D' u t k) (y (t + k)%N - prediction S Bs Ds u t k) = 0.
Proof. by rewrite cov_sum_left big1 // => i _; rewrite cov_mul_left error_uncorrelated ?mulmx0 // -ltnS. Qed.

Theorem error_of_any_fit B' D' : Q^T = Q ->
  let e := y (t + k)%N - prediction S Bs Ds u t k in let e' := y (t + k)%N - prediction S B' D' u t k in
  cov Q e' e' = cov Q e e + \sum_(d < k.+1) (impulse S (Bs - B') (Ds - D') d)^T *m impulse S (Bs - B') (Ds - D') d.
Proof.
move=> symmetric e e'; rewrite -(cov_predictions _ u_white (Bs - B') (Ds - D') (leq_ltn_trans (leq_addr _ _) tH)).
set z := prediction S (Bs - B') _ u t k; have -> : e' = e + z by rewrite /z prediction_sub addrA subrK.
have ze : cov Q z e = 0 by apply: normal_equations.
have ez : cov Q e z = 0 by rewrite -(cov_transpose z e symmetric) ze trmx0.
by rewrite cov_add (cov_add_left _ e z e) (cov_add_left _ e z z) ze ez add0r addr0.
Qed.

End Fit.

(** Over an ordered field: B seen and D seen alone have the least mean square error. *)
Section LeastSquares.
Variables (K : realFieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Variables (H J : nat) (Phi : nat -> 'M[K]_(nu, m)).
Hypotheses (model : process S B D u v x y) (u_white : white Q u H) (v_leads : leads J Phi Q H u v).
Hypothesis past_state : forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0.

Lemma trace_square a b (M : 'M[K]_(a, b)) : 0 <= \tr (M^T *m M) /\ (\tr (M^T *m M) = 0 -> M = 0).
Proof.
have -> : \tr (M^T *m M) = \sum_i \sum_j M j i ^+ 2.
  by apply: eq_bigr => i _; rewrite mxE; apply: eq_bigr => j _; rewrite mxE.
have pos i : 0 <= \sum_j M j i ^+ 2 by apply: sumr_ge0 => j _; apply: sqr_ge0.
split=> [|/eqP]; first by apply: sumr_ge0.
rewrite psumr_eq0 // => /allP z; apply/matrixP=> j i; rewrite mxE; have := z i (mem_index_enum _).
by rewrite /= psumr_eq0 => [/allP/(_ j (mem_index_enum _))|l _]; [rewrite /= sqrf_eq0 => /eqP|apply: sqr_ge0].
Qed.

Theorem least_squares t k B' D' : Q^T = Q -> (J <= t)%N -> (t + k + J < H)%N ->
  let mean_square B D := let e := y (t + k)%N - prediction S B D u t k in \tr (cov Q e e) in
  mean_square (seen_B S J Phi B) (seen_D S J Phi D) <= mean_square B' D' /\
  (row_free (O S k) -> mean_square B' D' = mean_square (seen_B S J Phi B) (seen_D S J Phi D) ->
   B' = seen_B S J Phi B /\ D' = seen_D S J Phi D).
Proof.
move=> symmetric Jt tH mean_square; rewrite /mean_square.
have -> := error_of_any_fit model u_white v_leads past_state Jt tH B' D' symmetric.
have tr_sum (M : 'I_k.+1 -> 'M[K]_p) : \tr (\sum_d M d) = \sum_d \tr (M d) by rewrite raddf_sum.
rewrite mxtraceD tr_sum; set dB := _ - B'; set dD := _ - D'.
have pos (d : 'I_k.+1) : true -> 0 <= \tr ((impulse S dB dD d)^T *m impulse S dB dD d) by case: (trace_square (impulse S dB dD d)).
split; first by rewrite lerDl; apply: sumr_ge0 => d _; apply: pos.
move=> obs /eqP; rewrite -subr_eq0 addrC addKr psumr_eq0 // => /allP z.
have [d dk|b d] := @no_impulse K n m p nu S k dB dD obs.
  by have [_] := trace_square (impulse S dB dD d); apply; apply/eqP; have := z (Ordinal dk) (mem_index_enum _).
by split; apply/eqP; rewrite eq_sym -subr_eq0; apply/eqP.
Qed.

End LeastSquares.

(** A fault that is uncorrelated with a white input, at the lags of both signs: proposition-1 as it should be. *)
Section Exogenous.
Variables (K : realFieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)) (H : nat).
Hypotheses (model : process S B D u v x y) (u_white : white Q u H).
Hypothesis exogenous : forall i k, (i < H)%N -> (k <= H)%N -> cov Q (u i) (v k) = 0.
Hypothesis past_state : forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0.

Theorem proposition_1_white t q s k L B' D' : Q^T = Q -> (q <= t)%N -> (t + s <= H)%N -> (t + k < H)%N ->
  row_free (O S s) -> row_free (O S k) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  let mean_square B D := let e := y (t + k)%N - prediction S B D u t k in \tr (cov Q e e) in
  [/\ (L == O S s)%MS = row_full (steered_space S B q), mean_square B D <= mean_square B' D' &
      mean_square B' D' = mean_square B D -> B' = B /\ D' = D].
Proof.
move=> symmetric qt tH kH obs obs' limit mean_square.
have v_leads : leads 0 (fun=> 0) Q H u v by apply: uncorrelated_leads.
have Bs : seen_B S 0 (fun=> 0) B = B by rewrite /seen_B big_ord0 addr0.
have Ds : seen_D S 0 (fun=> 0) D = D by rewrite /seen_D big_ord0 !addr0.
have past i : (0 <= i < H)%N -> cov Q (u i) (x 0%N) = 0 by move=> /andP[_]; apply: past_state.
have right := white_limit_right model u_white v_leads past qt _ obs limit; rewrite addn0 Bs in right.
have [|le unique] := least_squares model u_white v_leads past (t := t) (k := k) B' D' symmetric (leq0n t); first by rewrite addn0.
by rewrite Bs Ds in le unique; split; [apply: right|apply: le|apply: unique].
Qed.

End Exogenous.
