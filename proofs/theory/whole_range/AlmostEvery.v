(** An input of any colour, fixed, and the state at time 0 uncorrelated with the inputs that the limit of PI-MOESP is made of: it has all of
    the range of O_s for almost every (A, B). On every line through a good (A, B) all but at most n t are good, since the state enters by
    polynomials of degree t; and a chain of n delays behind the first input is good.

    degree_le d M == the entries of M have degree d at most *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Windows Places Signals Consistency Leads ExceptionalPolynomial.
From faultspace Require Import Controllable LimitsVocabulary WholeRange.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Meaning.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Variables t q s : nat.
Hypotheses (model : process S B D u v x y) (uncorrelated : forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0).
Hypotheses (start : forall i, (t - q <= i < t + s)%N -> cov Q (u i) (x 0%N) = 0) (qt : (q <= t)%N).
Hypothesis unit : cov Q (future t s u) (future t s u) \in unitmx.

Theorem limit_seen_state L : projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  L = seen_state Q u t q s (sysA S) B *m O S s.
Proof.
move=> /(two_sided_product model qt uncorrelated)[M [[X [hX eM]] ->]]; congr (_ *m _); rewrite eM.
have {hX} -> : X = cov Q (future (t - q) q u) (future t s u) *m invmx (cov Q (future t s u) (future t s u)) by rewrite -hX mulmxK.
have window t' s' a (r : 'M_(N, a)) : (forall i, (t - q <= i < t + s)%N -> cov Q (u i) r = 0) ->
    (t - q <= t')%N -> (t' + s' <= t + s)%N -> cov Q (future t' s' u) r = 0.
  move=> zero tt ts; rewrite cov_future_left big1 // => k _; rewrite zero ?mulmx0 //; have := ltn_ord k; lia.
have state t' s' : (t - q <= t')%N -> (t' + s' <= t + s)%N -> cov Q (future t' s' u) (x t) =
    \sum_(j < t) cov Q (future t' s' u) (u j) *m iter (t.-1 - j) (mulmxr (sysA S)) B.
  move=> tt ts; rewrite (cov_state_inputs model) // => [j jt|]; apply: window => // i /andP[_ its]; apply: uncorrelated => //; lia.
rewrite !state ?subnK //; try lia.
by rewrite mulmx_sumr -sumrB; apply: eq_bigr => k _; rewrite mulmxA -mulmxBl.
Qed.

Theorem whole_range_seen L : row_free (O S s) -> projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  (L == O S s)%MS = row_full (seen_state Q u t q s (sysA S) B).
Proof. by move=> obs /limit_seen_state ->; rewrite product_right. Qed.

End Meaning.

Section Degrees.
Variable K : fieldType.
Definition degree_le d a b (M : 'M[{poly K}]_(a, b)) := forall i j, (size (M i j) <= d.+1)%N.

Lemma degree_const a b (M : 'M[K]_(a, b)) : degree_le 0 (map_mx polyC M).
Proof. by move=> i j; rewrite mxE size_polyC_leq1. Qed.

Lemma degree_more d d' a b (M : 'M_(a, b)) : (d <= d')%N -> degree_le d M -> degree_le d' M.
Proof. by move=> dd h i j; apply: leq_trans (h i j) _. Qed.

Lemma degree_sum d a b (I : finType) (M : I -> 'M_(a, b)) : (forall i, degree_le d (M i)) -> degree_le d (\sum_i M i).
Proof.
move=> h i j; rewrite summxE; apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => k _; exact: h.
Qed.

Lemma degree_line a b (M M1 : 'M[K]_(a, b)) : degree_le 1 (map_mx polyC M + 'X *: map_mx polyC M1).
Proof.
move=> i j; rewrite !mxE; apply: leq_trans (size_add _ _) _; rewrite geq_max (leq_trans (size_polyC_leq1 _)) //=.
apply: leq_trans (size_mul_leq _ _) _; rewrite size_polyX addSn /= addnC.
by rewrite -[X in (_ <= X)%N]/(1 + 1)%N leq_add2r size_polyC_leq1.
Qed.

Lemma degree_mul d d' a b c (M : 'M_(a, b)) (M' : 'M_(b, c)) : degree_le d M -> degree_le d' M' -> degree_le (d + d') (M *m M').
Proof.
move=> h h' i j; rewrite mxE; apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => k _.
by apply: leq_trans (size_mul_leq _ _) _; rewrite -[(d + d').+1]/(d + d').+2.-1 -!subn1 leq_sub2r // -[_.+2]/(d.+1 + d').+1 -addnS leq_add.
Qed.

End Degrees.

Section Lines.
Variables (K : fieldType) (N n nu : nat) (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)) (t q s : nat).
Notation seen := (seen_state Q u t q s).

Theorem whole_range_almost_every (A A1 : 'M_n) (B B1 : 'M_(nu, n)) (ts : seq K) : row_full (seen A B) -> uniq ts ->
  (forall c, c \in ts -> ~~ row_full (seen (A + c *: A1) (B + c *: B1))) -> (size ts <= n * t)%N.
Proof.
case/row_fullP => P PM ts_uniq bad.
pose const a b (M : 'M[K]_(a, b)) := map_mx polyC M.
pose line a b (M M1 : 'M[K]_(a, b)) := const _ _ M + 'X *: const _ _ M1.
pose coef (k : nat) := let Z := future (t - q) q u in let Uf := future t s u in
  cov Q Z (u k) - cov Q Z Uf *m invmx (cov Q Uf Uf) *m cov Q Uf (u k).
pose L := \sum_(k < t) const _ _ (coef k) *m iter (t.-1 - k) (mulmxr (line _ _ A A1)) (line _ _ B B1).
pose D := \det (const _ _ P *m L).
have eval_line c a b (M M1 : 'M[K]_(a, b)) : map_mx (horner_eval c) (line _ _ M M1) = M + c *: M1.
  by apply/matrixP=> i j; rewrite !mxE /horner_eval !hornerE.
have eval_const c a b (M : 'M[K]_(a, b)) : map_mx (horner_eval c) (const _ _ M) = M.
  by apply/matrixP=> i j; rewrite !mxE /horner_eval hornerC.
have eval c : D.[c] = \det (P *m seen (A + c *: A1) (B + c *: B1)).
  rewrite -[D.[c]]/(horner_eval c D) -det_map_mx map_mxM eval_const; congr (\det (_ *m _)).
  rewrite /L raddf_sum; apply: eq_bigr => k _ /=; rewrite map_mxM eval_const; congr (_ *m _).
  by elim: (_ - _)%N => [|l IH] /=; rewrite ?eval_line // map_mxM IH eval_line.
have D0 : D != 0.
  apply/eqP => D0; have := eval 0; rewrite D0 horner0 !scale0r !addr0 PM det1 => /esym/eqP.
  by rewrite oner_eq0.
have size_D : (size D <= (n * t).+1)%N.
  have := @size_det K n (const _ _ P *m L) (fun=> t); rewrite sum_nat_const card_ord; apply.
  rewrite -[t]/(0 + t)%N; apply: degree_mul; first exact: degree_const.
  apply: degree_sum => k; rewrite -[t]/(0 + t)%N; apply: degree_mul; first exact: degree_const.
  apply: (@degree_more _ (t.-1 - k).+1); first by have := ltn_ord k; lia.
  elim: (_ - _)%N => [|l IH] /=; first exact: degree_line.
  by rewrite -addn1; apply: degree_mul; [exact: IH|exact: degree_line].
rewrite -ltnS; apply: leq_trans size_D; apply: max_poly_roots => //.
apply/allP=> c /bad not_full; rewrite rootE eval; apply/eqP; apply: contraNeq not_full => /= unit.
have : P *m seen (A + c *: A1) (B + c *: B1) \in unitmx by rewrite unitmxE unitfE.
by rewrite -row_full_unit => full; rewrite /row_full eqn_leq rank_leq_col -[X in (X <= _)%N](eqP full) mxrankM_maxr.
Qed.

End Lines.

(** Inputs are forgotten after q steps: what the limit does not see, they do not reach. *)
Section Forgotten.
Variables (K : fieldType) (N n nu : nat) (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)) (t q s : nat).
Hypotheses (qt : (q <= t)%N) (unit : cov Q (future t s u) (future t s u) \in unitmx).
Hypothesis excites : cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx.

Lemma independent_inputs (beta : nat -> 'cV[K]_nu) :
  (forall i, (t - q <= i < t + s)%N -> cov Q (u i) (\sum_(j < q + s) u (t - q + j)%N *m beta j) = 0) ->
  forall j, (j < q + s)%N -> beta j = 0.
Proof.
move=> zero; have : cov Q (future (t - q) (q + s) u) (\sum_(j < q + s) u (t - q + j)%N *m beta j) = 0.
  rewrite cov_future_left big1 // => k _; rewrite zero ?mulmx0 //; have := ltn_ord k; lia.
have -> : \sum_(j < q + s) u (t - q + j)%N *m beta j = future (t - q) (q + s) u *m \sum_(j < q + s) (place K nu j)^T *m beta j.
  by rewrite mulmx_sumr; apply: eq_bigr => j _; rewrite (sample_of_future (t - q) u j) mulmxA.
rewrite cov_mul; move: excites; move: (cov Q _ _) => R R_unit /(congr1 (mulmx (invmx R))); rewrite mulKmx // mulmx0 => e j js.
have := congr1 (mulmx (place K nu (Ordinal js))) e; rewrite mulmx0 mulmx_sumr (bigD1 (Ordinal js)) //= big1 => [|i].
  by rewrite addr0 mulmxA place_orthonormal eqxx mul1mx.
by rewrite -val_eqE eq_sym mulmxA place_orthonormal => /negbTE ->; rewrite mul0mx.
Qed.

Variables (A : 'M[K]_n) (B : 'M[K]_(nu, n)).
Hypothesis forgets : forall k, (q <= k)%N -> iter k (mulmxr A) B = 0.

Theorem seen_unless_unreached (w : 'cV_n) : seen_state Q u t q s A B *m w = 0 -> forall l, (l < q)%N -> iter l (mulmxr A) B *m w = 0.
Proof.
pose beta k := iter (t.-1 - k) (mulmxr A) B *m w.
pose r := \sum_(k < t) u k *m beta k; have Uu := unit; set Uf := future t s u in Uu *; set Z := future (t - q) q u.
pose c := invmx (cov Q Uf Uf) *m cov Q Uf r.
have -> : seen_state Q u t q s A B *m w = cov Q Z (r - Uf *m c).
  rewrite cov_sub cov_mul /c /r !cov_sum mulmxA mulmx_sumr -sumrB mulmx_suml; apply: eq_bigr => k _.
  by rewrite -mulmxA -/(beta k) mulmxBl !cov_mul !mulmxA.
move=> Zr; have Ur : cov Q Uf (r - Uf *m c) = 0 by rewrite cov_sub cov_mul /c mulKVmx // subrr.
have late k : (k < t - q)%N -> beta k = 0.
  by move=> kt; rewrite /beta forgets ?mul0mx //; lia.
pose gamma j : 'cV_nu := if (j < q)%N then beta (t - q + j)%N else if insub (j - q)%N is Some i then - (place K nu (i : 'I_s) *m c) else 0.
have e : r - Uf *m c = \sum_(j < q + s) u (t - q + j)%N *m gamma j.
  rewrite big_split_ord /=; congr (_ + _).
    rewrite /r -(big_mkord xpredT (fun k => u k *m beta k)) (big_cat_nat _ _ _ (leq0n (t - q)) (leq_subr _ _)) /=.
    rewrite big_nat_cond big1 ?add0r => [|k]; last by rewrite andbT => /andP[_ kt]; rewrite late // mulmx0.
    rewrite -{1}[(t - q)%N]add0n big_addn subKn // big_mkord; apply: eq_bigr => j _.
    by rewrite /gamma ltn_ord addnC.
  rewrite /Uf (future_sum t s u) mulmx_suml -sumrN; apply: eq_bigr => j _.
  by rewrite /gamma ltnNge leq_addr /= addKn valK addnA subnK // mulmxN; congr (- _); exact: esym (mulmxA _ _ _).
have zero : forall j, (j < q + s)%N -> gamma j = 0.
  apply: independent_inputs => i /andP[qi its]; rewrite -e; have [it|ti] := ltnP i t.
    by apply: (cov_future_zero Zr); rewrite subnK // qi.
  by apply: (cov_future_zero Ur); rewrite ti.
move=> l lq; have := zero (q.-1 - l)%N; rewrite /gamma; have -> : (q.-1 - l < q)%N by lia.
have lqs : (q.-1 - l < q + s)%N by lia.
by move=> /(_ lqs); rewrite /beta; have -> : (t.-1 - (t - q + (q.-1 - l)) = l)%N by lia.
Qed.

End Forgotten.

(** A chain of n delays behind the first input. *)
Section Delays.
Variables (K : fieldType) (N n nu : nat) (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)) (t q s : nat).
Hypotheses (nu0 : (0 < nu)%N) (nq : (n <= q)%N) (qt : (q <= t)%N).
Hypotheses (unit : cov Q (future t s u) (future t s u) \in unitmx).
Hypothesis excites : cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx.

Let A : 'M[K]_n := \matrix_(i, j) (j == i.+1 :> nat)%:R.
Let B : 'M[K]_(nu, n) := \matrix_(i, j) ((i == 0%N :> nat) && (j == 0%N :> nat))%:R.

Lemma delayed l : iter l (mulmxr A) B = \matrix_(i, j) ((i == 0%N :> nat) && (j == l :> nat))%:R.
Proof.
elim: l => //= l ->; apply/matrixP=> i j; rewrite !mxE; have [i0|/negPf i0] := eqVneq (i : nat) 0%N; last first.
  by rewrite big1 // => k _; rewrite mxE i0 mul0r.
have [jl|/negPf jl] := eqVneq (j : nat) l.+1.
  have ln : (l < n)%N by rewrite ltnW // -jl.
  rewrite (bigD1 (Ordinal ln)) //= big1 => [|k ne]; first by rewrite !mxE i0 /= eqxx mul1r jl eqxx addr0.
  by rewrite !mxE (_ : (k == l :> nat) = false) ?andbF ?mul0r //; apply: contraNF ne => /eqP e; apply/eqP/val_inj.
by rewrite big1 // => k _; rewrite !mxE; have [->|/negPf kl] := eqVneq (k : nat) l; rewrite ?jl ?kl ?andbF ?mul0r ?mulr0.
Qed.

Theorem whole_range_somewhere : exists (A' : 'M[K]_n) (B' : 'M[K]_(nu, n)), row_full (seen_state Q u t q s A' B').
Proof.
exists A, B; apply: row_full_seen => w unseen.
have forgets k : (q <= k)%N -> iter k (mulmxr A) B = 0.
  move=> qk; rewrite delayed; apply/matrixP=> i j; rewrite !mxE (_ : (j == k :> nat) = false) ?andbF //.
  by apply/eqP; have := ltn_ord j; lia.
have zero := seen_unless_unreached qt unit excites forgets unseen.
apply/matrixP=> l j; rewrite ord1 [RHS]mxE; have lq := leq_trans (ltn_ord l) nq.
have := zero l lq; rewrite delayed => /matrixP/(_ (Ordinal nu0) 0); rewrite mxE [X in _ = X]mxE (bigD1 l) //= big1 => [|k ne].
  by rewrite addr0 mxE /= eqxx mul1r.
by rewrite mxE /= (_ : (k == l :> nat) = false) ?mul0r //; apply/eqP; move: ne; rewrite -val_eqE /=; lia.
Qed.

End Delays.

(** So a nilpotent A loses nothing, whatever the colour of u. *)
Theorem whole_range_nilpotent (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y t q s L :
  process S B D u v x y -> (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) -> (q <= t)%N ->
  cov Q (future t s u) (future t s u) \in unitmx -> cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx ->
  iter q (mulmxr (sysA S)) 1%:M = 0 -> (forall z, steered S B z) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS.
Proof.
move=> model uv qt unit excites nilpotent all limit.
have forgets a (M : 'M_(a, n)) k : (q <= k)%N -> iter k (mulmxr (sysA S)) M = 0.
  move=> qk; rewrite -(subnK qk) iterD; have -> : iter q (mulmxr (sysA S)) M = 0; last by rewrite -[LHS]/(times_power S 0 _) times_power0.
  have -> : iter q (mulmxr (sysA S)) M = M *m iter q (mulmxr (sysA S)) 1%:M by rewrite -[RHS]times_power_mul mulmx1.
  by rewrite nilpotent mulmx0.
pose x' k := x k - times_power S (x 0%N) k; pose y' k := y k - times_power S (x 0%N) k *m sysC S.
have model' : process S B D u v x' y'.
  move=> k; have [ex ey] := model k; rewrite /x' /y' ex ey !mulmxBl -!addrA.
  by split; congr (_ + _); rewrite [RHS]addrC addrA.
have ey : future t s y' = future t s y.
  apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k _; rewrite /y' /times_power forgets ?mul0mx ?subr0 //.
  exact: leq_trans qt (leq_addr _ _).
rewrite -ey in limit.
have start i : (t - q <= i < t + s)%N -> cov Q (u i) (x' 0%N) = 0 by rewrite /x' /= subrr cov_zero.
rewrite (limit_seen_state model' uv start qt unit limit); apply/eqmxP; apply: eqmxMfull; apply: row_full_seen => w unseen.
have zero := seen_unless_unreached qt unit excites (forgets _ B) unseen.
have {}zero : steered_space S B n *m w = 0.
  apply: unseen_by_steered => l _; have [lq|ql] := ltnP l q; first exact: zero.
  by rewrite /times_power forgets ?mul0mx.
have : row_full (steered_space S B n) by apply/controllable_steered_space.
by case/row_fullP => P PR; rewrite -[w]mul1mx -PR -mulmxA zero mulmx0.
Qed.
