(** A fault that leads a white input, v(k) = sum_(j < J) u(k+j) Phi_j, uncorrelated with the input's past when Phi_0 = 0. What u does to y
    is what B + sum_j Phi_j F A^j and D + Phi_0 G + sum_(j >= 1) Phi_j F A^(j-1) C would do without a fault. So the limit of PI-MOESP is a
    product with O_s still, of rank n, where s samples show all states and with n past inputs or more, iff A is controllable from this seen
    B, which is not the true one.

       steered_space S B q == the row space of B, BA, ..., BA^(q-1): the states that q inputs through B lead to
    reach_rows S B J Phi q == B seen A^(q-1), ..., B seen: times O_s, the limit of PI-MOESP with q past inputs *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Places Signals Consistency.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions. *)
Section Definitions.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p).

(** What q samples of an input through B reach. *)
Definition steered_space (B : 'M_(nu, n)) q : 'M[K]_n := (\sum_(j < q) <<times_power S B j>>)%MS.

End Definitions.

Section Powers.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma times_power_add a (M N : 'M_(a, n)) k : times_power S (M + N) k = times_power S M k + times_power S N k.
Proof. by elim: k => //= k ->; rewrite mulmxDl. Qed.

Lemma times_power_opp a (M : 'M_(a, n)) k : times_power S (- M) k = - times_power S M k.
Proof. by elim: k => //= k ->; rewrite mulNmx. Qed.

Lemma times_power0 a k : times_power S (0 : 'M_(a, n)) k = 0.
Proof. by elim: k => //= k ->; rewrite mul0mx. Qed.

Lemma times_power_mul a b (M : 'M_(a, b)) (N : 'M_(b, n)) k : times_power S (M *m N) k = M *m times_power S N k.
Proof. by elim: k => //= k ->; rewrite mulmxA. Qed.

Lemma times_powerD a (M : 'M_(a, n)) j k : times_power S (times_power S M j) k = times_power S M (k + j).
Proof. by rewrite /times_power iterD. Qed.

End Powers.

(** The exact sum, and faults that are uncorrelated with the input. *)
Section LeadingFaults.
Variables (K : fieldType) (N m nu H J : nat) (Phi : nat -> 'M[K]_(nu, m)) (Q : 'M[K]_N).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)).

Lemma sum_leads : white Q u H -> (forall k, v k = \sum_(j < J) u (k + j)%N *m Phi j) -> leads J Phi Q H u v.
Proof.
move=> u_white v_sum i k iH kH; have kj (j : 'I_J) : (k + j < H)%N by have := ltn_ord j; lia.
rewrite v_sum cov_sum; under eq_bigr => j _ do rewrite cov_mul u_white //.
have [ki|ik] := leqP k i; last first.
  by rewrite big1 // => j _; rewrite ltn_eqF ?mul0mx // (leq_trans ik) ?leq_addr.
case: ltnP => [lt|ge] /=.
  have lt' : (i - k < J)%N by lia.
  rewrite (bigD1 (Ordinal lt')) //= subnKC // eqxx mul1mx big1 ?addr0 // => j nj.
  case: eqP => [e|_]; last by rewrite mul0mx.
  by case/eqP: nj; apply: val_inj; rewrite /= e addKn.
rewrite big1 // => j _; rewrite gtn_eqF ?mul0mx //; apply: leq_trans ge.
by rewrite ltn_add2l.
Qed.

Lemma uncorrelated_leads : (forall i k, (i < H)%N -> (k <= H)%N -> cov Q (u i) (v k) = 0) -> leads 0 Phi Q H u v.
Proof. by move=> h i k iH; rewrite !addn0 => kH; rewrite h //; case: leqP => //= ki; rewrite ltnNge ki. Qed.

End LeadingFaults.

Section Leads.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Variables (H J : nat) (Phi : nat -> 'M[K]_(nu, m)).
Hypotheses (model : process S B D u v x y) (u_white : white Q u H) (v_leads : leads J Phi Q H u v).
(** The state at time 0 knows of no input from J on, as if the process had gone on for ever: v(-1) is made of u(-1), ..., u(J-2). *)
Hypothesis past_state : forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0.

Let phi j := if (j < J)%N then Phi j else 0.

Lemma cov_fault i k : (i < H)%N -> (k + J <= H)%N -> cov Q (u i) (v k) = if (k <= i)%N then phi (i - k) else 0.
Proof. by move=> iH kH; rewrite v_leads // /phi; case: (leqP k i) => //= ki; have -> : (i < k + J)%N = (i - k < J)%N by lia.
Qed.

(** Up to time i the input u(i) has acted through the faults alone. *)
Lemma cov_state_before i k : (J <= i)%N -> (i + J < H)%N -> (k <= i)%N ->
  cov Q (u i) (x k) = \sum_(l < k) times_power S (phi (i - l) *m sysF S) (k.-1 - l).
Proof.
move=> Ji iH; elim: k => [_|k IH ki]; first by rewrite past_state ?big_ord0 //; lia.
have [-> _] := model k; rewrite !cov_add !cov_mul IH 1?ltnW // cov_fault ?(ltnW ki) ?u_white; try lia.
rewrite gtn_eqF // mul0mx addr0.
rewrite big_ord_recr /= subnn mulmx_suml; congr (_ + _); apply: eq_bigr => l _.
by case: k l {IH ki} => [[]//|k] l; rewrite subSn // -ltnS.
Qed.

Lemma sum_trimmed a i j (f : nat -> 'M[K]_(nu, a)) : (j <= i)%N -> (forall k, (j <= k)%N -> f k = 0) ->
  \sum_(k < i) f k = \sum_(k < j) f k.
Proof.
move=> ji f0; rewrite -(big_mkord xpredT f) (big_cat_nat _ _ _ (leq0n j) ji) /= big_mkord.
by rewrite [X in _ + X]big_nat_cond [X in _ + X]big1 ?addr0 // => k; rewrite andbT => /andP[jk _]; apply: f0.
Qed.

Lemma seen_B_trimmed i : (J <= i)%N -> seen_B S J Phi B = B + \sum_(j < i) times_power S (phi j *m sysF S) j.
Proof.
move=> Ji; rewrite (@sum_trimmed _ i J (fun j => times_power S (phi j *m sysF S) j)) // => [|k Jk]; last first.
  by rewrite /phi ltnNge Jk mul0mx times_power0.
by congr (_ + _); apply: eq_bigr => j _; rewrite /phi ltn_ord.
Qed.

Lemma seen_D_trimmed i : (J <= i)%N ->
  seen_D S J Phi D = D + phi 0 *m sysG S + \sum_(j < i) times_power S (phi j.+1 *m sysF S) j *m sysC S.
Proof.
move=> Ji; rewrite (@sum_trimmed _ i J.-1 (fun j => times_power S (phi j.+1 *m sysF S) j *m sysC S)) => [||k Jk].
- rewrite /seen_D; congr (_ + _ + _); first by rewrite /phi; case: (J) => //; rewrite mul0mx.
  by apply: eq_bigr => j _; rewrite /phi -ltn_predRL ltn_ord.
- exact: leq_trans (leq_pred _) Ji.
by rewrite /phi ltnNge (leq_trans (leqSpred _)) ?ltnS //= mul0mx times_power0 mul0mx.
Qed.

(** From then on it has acted as through B seen, and only through it. *)
Theorem cov_state_after i d : (J <= i)%N -> (i + d + J < H)%N -> cov Q (u i) (x (i.+1 + d)%N) = times_power S (seen_B S J Phi B) d.
Proof.
move=> Ji; elim: d => [|d IH] dH; last first.
  rewrite addnS; have [-> _] := model (i.+1 + d)%N; rewrite !cov_add !cov_mul IH ?u_white ?cov_fault; try lia.
  by rewrite leqNgt ltn_eqF addSn ltnS leq_addr //= !mul0mx !addr0.
rewrite addn0; have [-> _] := model i; rewrite !cov_add !cov_mul cov_state_before ?cov_fault ?u_white; try lia.
rewrite leqnn eqxx mul1mx subnn addrAC [LHS]addrC (@seen_B_trimmed i.+1) ?leqW //; congr (_ + _).
rewrite [RHS](reindex_inj rev_ord_inj) [RHS]big_ord_recr /= subnn mulmx_suml; congr (_ + _); apply: eq_bigr => l _.
by rewrite subSS; case: i l {Ji dH} => [[]//|i] l; rewrite subSn // -ltnS.
Qed.

(** The response of y to a pulse of u: D seen, then B seen and the powers of A. *)
Theorem cov_output_after i d : (J <= i)%N -> (i.+1 + d + J < H)%N ->
  cov Q (u i) (y (i.+1 + d)%N) = times_power S (seen_B S J Phi B) d *m sysC S.
Proof.
move=> Ji dH; have [_ ->] := model (i.+1 + d)%N; rewrite !cov_add !cov_mul cov_state_after ?u_white ?cov_fault; try lia.
by rewrite leqNgt ltn_eqF addSn ltnS leq_addr //= !mul0mx !addr0.
Qed.

Theorem cov_output_now i : (J <= i)%N -> (i + J < H)%N -> cov Q (u i) (y i) = seen_D S J Phi D.
Proof.
move=> Ji iH; have [_ ->] := model i; rewrite !cov_add !cov_mul cov_state_before ?cov_fault ?u_white; try lia.
rewrite leqnn eqxx mul1mx subnn (@seen_D_trimmed i) // -addrA [LHS]addrC; congr (_ + _).
rewrite mulmx_suml [RHS](reindex_inj rev_ord_inj); apply: eq_bigr => l _ /=.
by case: i l {Ji iH} => [[]//|i] l; rewrite /= subSS subSn // -ltnS.
Qed.

Lemma cov_fault_future i t s : (i < t)%N -> (t + s + J <= H)%N -> cov Q (u i) (future t s v) = 0.
Proof.
move=> it tH; rewrite cov_future big1 // => k _; have := ltn_ord k => ks.
by rewrite cov_fault; try lia; rewrite leqNgt ltn_addr // mul0mx.
Qed.

Lemma countdown j q : (j < q)%N -> (j.+1 + (q.-1 - j))%N = q.
Proof. by case: q => // q jq; rewrite addSn subnKC. Qed.

(** The limit of PI-MOESP with the q inputs before t as instruments, on s samples from t on. *)
Definition reach_rows q := \sum_(j < q) (place K nu j)^T *m times_power S (seen_B S J Phi B) (q.-1 - j) : 'M_(q * nu, n).

Lemma cov_past_future q t s : (q <= t)%N -> (t + s <= H)%N -> cov Q (future (t - q) q u) (future t s u) = 0.
Proof.
move=> qt tH; apply: uncorrelated_futures => i k; rewrite subnK // => /andP[_ it] /andP[tk ks].
by rewrite u_white; [rewrite ltn_eqF // (leq_trans it)|lia|lia].
Qed.

Lemma cov_future_white t s : (t + s <= H)%N -> cov Q (future t s u) (future t s u) = 1%:M.
Proof.
move=> tH; have kH (k : 'I_s) : (t + k < H)%N by have := ltn_ord k; lia.
rewrite -sum_places cov_future_left; apply: eq_bigr => k _; rewrite cov_future (bigD1 k) //= big1 => [|j].
  by rewrite addr0 u_white // eqxx mul1mx.
by rewrite -val_eqE u_white // eqn_add2l eq_sym => /negbTE->; rewrite mul0mx.
Qed.

Theorem white_limit q t s L : (J + q <= t)%N -> (t + s + J <= H)%N ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> L = reach_rows q *m O S s.
Proof.
move=> Jqt tH [X []]; have qt : (q <= t)%N by apply: leq_trans Jqt; apply: leq_addl.
have zu : cov Q (future (t - q) q u) (future t s u) = 0 by apply: cov_past_future => //; lia.
rewrite cov_future_white ?mulmx1 ?zu; last lia.
move=> -> ->; rewrite mul0mx subr0.
have zv : cov Q (future (t - q) q u) (future t s v) = 0.
  by rewrite cov_future_left big1 // => j _; rewrite cov_fault_future ?mulmx0 // -[X in (_ < X)%N](subnK qt) ltn_add2l.
rewrite (future_outputs model) !cov_add !cov_mul zu zv !mul0mx !addr0 cov_future_left; congr (_ *m _); apply: eq_bigr => j _.
have e : t = ((t - q + j).+1 + (q.-1 - j))%N.
  by rewrite -addnS -addnA countdown // subnK.
by have jq := ltn_ord j; rewrite {2}e cov_state_after //; lia.
Qed.

Lemma reach_rows_eq q : (reach_rows q :=: steered_space S (seen_B S J Phi B) q)%MS.
Proof.
apply/eqmxP/andP; split.
  apply: summx_sub => j _; apply: submx_trans (submxMl _ _) _.
  have lt : (q.-1 - j < q)%N by case: (q) j => [[]//|k] j; rewrite ltnS leq_subr.
  by apply: (sumsmx_sup (Ordinal lt)) => //; rewrite genmxE.
apply/sumsmx_subP=> j _; rewrite genmxE.
have e : times_power S (seen_B S J Phi B) j = place K nu (rev_ord j) *m reach_rows q.
  rewrite mulmx_sumr (bigD1 (rev_ord j)) //= big1 ?addr0 => [|k].
    rewrite mulmxA place_orthonormal eqxx mul1mx; congr (times_power _ _ _).
    by case: (q) j => [[]//|k] j; rewrite /= subSS subKn // -ltnS.
  by rewrite -val_eqE eq_sym mulmxA place_orthonormal => /negbTE->; rewrite mul0mx.
by rewrite e submxMl.
Qed.

(** Its rank, for (A, C) observable on s samples; so A and C are right iff A is controllable from B seen in q steps. *)
Theorem white_limit_rank q t s L : (J + q <= t)%N -> (t + s + J <= H)%N -> row_free (O S s) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> \rank L = \rank (steered_space S (seen_B S J Phi B) q).
Proof. by move=> Jqt tH obs /(white_limit Jqt tH)->; rewrite mxrankMfree // reach_rows_eq. Qed.

Theorem white_limit_right q t s L : (J + q <= t)%N -> (t + s + J <= H)%N -> row_free (O S s) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  (L == O S s)%MS = row_full (steered_space S (seen_B S J Phi B) q).
Proof.
move=> Jqt tH obs hL; have := white_limit_rank Jqt tH obs hL; move: hL => /(white_limit Jqt tH) e r.
have sub : (L <= O S s)%MS by rewrite e submxMl.
by rewrite sub /= /row_full -r -(mxrank_leqif_sup sub) (eqP obs).
Qed.

End Leads.
