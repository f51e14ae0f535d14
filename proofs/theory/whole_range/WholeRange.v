(** When the limit of PI-MOESP has all of the range of O_s, the faults being uncorrelated with the inputs. It has no more than what the
    inputs reach, if x(0) shares with the inputs only what they reach. It has all that they reach if the input is autoregressive of order a
    and there are n + a past inputs: a state direction w that the limit does not see makes x(t) w a combination of the future inputs, up to
    something that the past and future inputs know nothing of; the innovation of each of these times, the last one first, then tells that
    its input has no part in that. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Places Signals Consistency Leads Persistency Controllable LimitsVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Windows.
Variables (K : fieldType) (N p : nat).

Lemma sample_of_future t s (r : nat -> 'M[K]_(N, p)) (k : 'I_s) : r (t + k)%N = future t s r *m (place K p k)^T.
Proof. by apply/row_matrixP=> i; rewrite row_mul mul_place_transposed rowK mxvecK rowK. Qed.

Lemma cov_future_zero Q a t s (r : nat -> 'M[K]_(N, p)) (z : 'M_(N, a)) : cov Q (future t s r) z = 0 ->
  forall i, (t <= i < t + s)%N -> cov Q (r i) z = 0.
Proof.
move=> h i /andP[ti its]; have lt : (i - t < s)%N by rewrite ltn_subLR.
by rewrite -(subnKC ti) (sample_of_future t r (Ordinal lt)) cov_mul_left h mulmx0.
Qed.

End Windows.

(** Everything that inputs steer to, as a row space. *)
Section Steered.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)).

Lemma steered_in_space z : steered S B z -> (z <= steered_space S B n)%MS.
Proof. by case=> k [w <-]; rewrite steered_space_more //; apply: state_steered. Qed.

Lemma unseen_by_steered q (w : 'cV_n) : (forall l, (l < q)%N -> times_power S B l *m w = 0) -> (steered_space S B q *m w = 0)%MS.
Proof.
move=> h; apply/sub_kermxP/sumsmx_subP=> l _; rewrite genmxE; apply/sub_kermxP; exact: h.
Qed.

End Steered.

Lemma row_full_seen (K : fieldType) a n (M : 'M[K]_(a, n)) : (forall w : 'cV_n, M *m w = 0 -> w = 0) -> row_full M.
Proof.
move=> h; rewrite /row_full -mxrank_tr -/(row_free _); apply: inj_row_free => v e.
by apply: trmx_inj; rewrite trmx0; apply: h; apply: trmx_inj; rewrite trmx_mul trmxK e trmx0.
Qed.

Section Exogenous.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Hypothesis model : process S B D u v x y.
Variables t q s : nat.
Hypotheses (qt : (q <= t)%N) (uncorrelated : forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0).
Let Z := future (t - q) q u.
Let Uf := future t s u.

(** What a signal that knows nothing of the faults and of the first state shares with the state at t. *)
Lemma cov_state_inputs a (z : 'M_(N, a)) k : (forall j, (j < k)%N -> cov Q z (v j) = 0) -> cov Q z (x 0%N) = 0 ->
  cov Q z (x k) = \sum_(j < k) cov Q z (u j) *m times_power S B (k.-1 - j).
Proof.
move=> zv z0; elim: k zv => [|k IH] zv; first by rewrite big_ord0.
have [-> _] := model k; rewrite !cov_add !cov_mul zv // mul0mx addr0 IH => [|j jk]; last by apply: zv; apply: ltnW.
rewrite big_ord_recr /= subnn mulmx_suml; congr (_ + _); apply: eq_bigr => j _; rewrite -mulmxA.
by case: k j {IH zv} => [[]//|k] j; rewrite subSn // -ltnS.
Qed.

Lemma two_sided_product L : projected_limit Q Z Uf (future t s y) L ->
  exists M, projected_limit Q Z Uf (x t) M /\ L = M *m O S s.
Proof.
apply: (two_sided_past_inputs model qt) => i k /andP[_ it] /andP[_ kt]; exact: uncorrelated.
Qed.

(** Necessity, u of any colour: what the inputs share with the state they have through B, if so it is at time 0. *)
Lemma cov_state_steered i k : (i < t + s)%N -> (k <= t + s)%N -> (cov Q (u i) (x 0%N) <= steered_space S B n)%MS ->
  (cov Q (u i) (x k) <= steered_space S B n)%MS.
Proof.
move=> its; elim: k => // k IH kts h; have [-> _] := model k; rewrite !cov_add !cov_mul uncorrelated // mul0mx addr0.
rewrite steered_space_more // in IH h *; apply: addmx_sub.
  by apply: submx_trans (orbit_stays _ _); apply: submxMr; apply: IH => //; apply: ltnW.
by apply: submx_trans (submxMl _ _) (orbit_contains _ _).
Qed.

Theorem whole_range_needs_controllability L : (forall i j, (i < t + s)%N -> steered S B (row j (cov Q (u i) (x 0%N)))) ->
  row_free (O S s) -> projected_limit Q Z Uf (future t s y) L -> (L == O S s)%MS -> forall z, steered S B z.
Proof.
move=> start obs /two_sided_product[M [[X [_ eM]] ->]]; rewrite product_right // => full.
apply/(controllable_steered_space S B (leqnn n)); rewrite -sub1mx; apply: submx_trans (_ : M <= _)%MS; first by rewrite sub1mx.
have reach i : (i < t + s)%N -> (cov Q (u i) (x t) <= steered_space S B n)%MS.
  by move=> its; apply: cov_state_steered; rewrite ?leq_addr //; apply/row_subP=> j; apply: steered_in_space; apply: start.
rewrite eM; apply: addmx_sub; last rewrite eqmx_opp.
  rewrite /Z cov_future_left; apply: summx_sub => k _; apply: submx_trans (submxMl _ _) (reach _ _).
  by have := ltn_ord k; lia.
rewrite /Uf cov_future_left mulmx_sumr; apply: summx_sub => k _; rewrite mulmxA; apply: submx_trans (submxMl _ _) (reach _ _).
by rewrite ltn_add2l.
Qed.

(** What the limit does not see. *)
Lemma unseen_by_limit (w : 'cV_n) M : cov Q Uf Uf \in unitmx -> projected_limit Q Z Uf (x t) M -> M *m w = 0 ->
  let c := invmx (cov Q Uf Uf) *m cov Q Uf (x t) *m w in
  forall i, (t - q <= i < t + s)%N -> cov Q (u i) (x t *m w - Uf *m c) = 0.
Proof.
move=> unit [X [hX eM]] Mw c; pose xi := x t *m w - Uf *m c.
have Uxi : cov Q Uf xi = 0.
  have -> : cov Q Uf xi = cov Q Uf (x t) *m w - cov Q Uf Uf *m c by rewrite cov_sub !cov_mul.
  by rewrite /c -[invmx _ *m _ *m w]mulmxA mulKVmx // subrr.
have Zxi : cov Q Z xi = 0.
  have -> : cov Q Z xi = cov Q Z (x t) *m w - cov Q Z Uf *m c by rewrite cov_sub !cov_mul.
  by rewrite -hX /c -[X *m _ *m _]mulmxA -[invmx _ *m _ *m w]mulmxA mulKVmx // -Mw eM mulmxBl (mulmxA X).
move=> i /andP[qi its]; have [it|ti] := ltnP i t.
  by apply: (cov_future_zero Zxi); rewrite subnK // qi.
by apply: (cov_future_zero Uxi); rewrite ti.
Qed.

(** Sufficiency, u autoregressive. *)
Section Autoregressive.
Variables (a : nat) (Au : nat -> 'M[K]_nu) (e : nat -> 'M[K]_(N, nu)).
Hypotheses (ar : autoregressive Q a Au u e (t + s)) (later : forall k, (a <= k < t + s)%N -> cov Q (e k) (x 0%N) = 0).

Lemma innovation_fault k j : (a <= k < t + s)%N -> (j < t)%N -> cov Q (e k) (v j) = 0.
Proof.
move=> ak jt; have [eu _ _] := ar ak; have -> : e k = u k - \sum_(i < a) u (k - i.+1)%N *m Au i by rewrite eu addrC addKr.
have jts : (j < t + s)%N by apply: leq_trans (leq_addr _ _).
rewrite cov_sub_left uncorrelated //; last by case/andP: ak.
rewrite sub0r cov_sum_left big1 ?oppr0 // => i _; rewrite cov_mul_left uncorrelated ?mulmx0 //; lia.
Qed.

Lemma innovation_input k : (a <= k < t + s)%N -> cov Q (e k) (u k) = cov Q (e k) (e k).
Proof.
move=> ak; have [eu _ past] := ar ak; rewrite [in LHS]eu cov_add cov_sum big1 ?add0r // => i _.
by rewrite cov_mul past ?mul0mx //; have := ltn_ord i; lia.
Qed.

(** A direction w of the state that is a combination of the future inputs, up to an error uncorrelated with the inputs from t - q on, is one
    that the inputs do not reach in q - a steps. *)
Theorem unseen_is_unreached (w : 'cV_n) c : (forall i, (t - q <= i < t + s)%N -> cov Q (u i) (x t *m w - Uf *m c) = 0) ->
  forall l, (l < q - a)%N -> times_power S B l *m w = 0.
Proof.
set xi := x t *m w - Uf *m c => inputs.
have innovations k : (t - q + a <= k < t + s)%N -> cov Q (e k) xi = 0.
  move=> qk; have ak : (a <= k < t + s)%N by lia.
  have [eu _ _] := ar ak; have -> : e k = u k - \sum_(i < a) u (k - i.+1)%N *m Au i by rewrite eu addrC addKr.
  rewrite cov_sub_left inputs; last lia.
  rewrite sub0r cov_sum_left big1 ?oppr0 // => i _; rewrite cov_mul_left inputs ?mulmx0 //; have := ltn_ord i; lia.
pose beta k : 'cV_nu := if (k < t)%N then times_power S B (t.-1 - k) *m w else
  if insub (k - t)%N is Some j then - (place K nu (j : 'I_s) *m c) else 0.
have parts k : (a <= k < t + s)%N -> cov Q (e k) xi = \sum_(j < t + s) cov Q (e k) (u j) *m beta j.
  move=> ak; rewrite big_split_ord /= cov_sub !cov_mul; congr (_ + _).
    rewrite (cov_state_inputs (z := e k)) => [|j jt|]; [|exact: innovation_fault|exact: later].
    by rewrite mulmx_suml; apply: eq_bigr => j _; rewrite /beta ltn_ord mulmxA.
  rewrite /Uf cov_future mulmx_suml -sumrN; apply: eq_bigr => j _.
  by rewrite /beta ltnNge leq_addr /= addKn valK mulmxN mulmxA.
have down d : forall k, (t - q + a <= k < t + s)%N -> (t + s <= k + d)%N -> beta k = 0.
  elim: d => [|d IH] k qk kd; first by lia.
  have ak : (a <= k < t + s)%N by lia.
  have [_ inv past] := ar ak; have kts : (k < t + s)%N by lia.
  have := parts k ak; rewrite innovations // (bigD1 (Ordinal kts)) //= big1 => [|j]; last first.
    rewrite -val_eqE /= neq_ltn => /orP[jk|kj]; first by rewrite past ?mul0mx.
    by rewrite IH ?mulmx0 //; have := ltn_ord j; lia.
  by rewrite addr0 innovation_input // => /esym/(congr1 (mulmx (invmx (cov Q (e k) (e k))))); rewrite mulKmx // mulmx0.
move=> l lq; have := down (t + s)%N (t.-1 - l)%N; rewrite /beta.
have -> : (t.-1 - l < t)%N by lia.
have -> : (t.-1 - (t.-1 - l) = l)%N by lia.
by apply; lia.
Qed.

Theorem autoregressive_whole_range L : cov Q Uf Uf \in unitmx -> (n + a <= q)%N -> (forall z, steered S B z) ->
  projected_limit Q Z Uf (future t s y) L -> (L == O S s)%MS.
Proof.
move=> unit naq all /two_sided_product[M [limit ->]]; apply/eqmxP; apply: eqmxMfull; apply: row_full_seen => w Mw.
have unreached := unseen_is_unreached (unseen_by_limit unit limit Mw).
have {unreached} zero : steered_space S B (q - a) *m w = 0 by apply: unseen_by_steered.
have : row_full (steered_space S B (q - a)) by apply/controllable_steered_space => //; lia.
by case/row_fullP => P PR; rewrite -[w]mul1mx -PR -mulmxA zero mulmx0.
Qed.

End Autoregressive.

End Exogenous.
