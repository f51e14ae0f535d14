(** An input of any colour, fixed, and the state at time 0 uncorrelated with the inputs that the limit of PI-MOESP is made of: it has all
    of the range of O_s, with at least one input, n past samples or more, and regular covariances of the s future inputs and of the past
    and future ones together, for almost every (A, B). On every line through a good (A, B) all but at most n t are good, since the state
    enters by polynomials of degree t; and a chain of n delays behind the first input is good.

        degree_le d M == the entries of M have degree d at most
    polynomial_in d F == the entries of F(c) are polynomials in c of degree d at most *)
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
Definition polynomial_in d a b (F : K -> 'M[K]_(a, b)) := exists2 M, degree_le d M & forall c, map_mx (horner_eval c) M = F c.

Lemma polynomial_const a b (M : 'M[K]_(a, b)) : polynomial_in 0 (fun=> M).
Proof.
exists (map_mx polyC M) => [i j|c]; first by rewrite mxE size_polyC_leq1.
by apply/matrixP=> i j; rewrite !mxE /horner_eval hornerC.
Qed.

Lemma polynomial_more d d' a b (F : K -> 'M_(a, b)) : (d <= d')%N -> polynomial_in d F -> polynomial_in d' F.
Proof. by move=> dd [M h e]; exists M => // i j; apply: leq_trans (h i j) _. Qed.

Lemma polynomial_sum d a b k (F : 'I_k -> K -> 'M_(a, b)) : (forall i, polynomial_in d (F i)) -> polynomial_in d (fun c => \sum_i F i c).
Proof.
move=> h; have [M hM] : exists M : 'I_k -> 'M_(a, b), forall i, degree_le d (M i) /\ forall c, map_mx (horner_eval c) (M i) = F i c.
  by apply: (fin_all_exists (P := fun i M => degree_le d M /\ forall c, map_mx (horner_eval c) M = F i c)) => i; have [M] := h i; exists M.
exists (\sum_i M i) => [i j|c]; last by rewrite raddf_sum; apply: eq_bigr => i _; have [_ /= ->] := hM i.
by rewrite summxE; apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => l _; have [] := hM l.
Qed.

Lemma polynomial_line a b (M M1 : 'M[K]_(a, b)) : polynomial_in 1 (fun c => M + c *: M1).
Proof.
exists (map_mx polyC M + 'X *: map_mx polyC M1) => [i j|c]; last by apply/matrixP=> i j; rewrite !mxE /horner_eval !hornerE.
rewrite !mxE; apply: leq_trans (size_add _ _) _; rewrite geq_max (leq_trans (size_polyC_leq1 _)) //=.
apply: leq_trans (size_mul_leq _ _) _; rewrite size_polyX addSn /= addnC.
by rewrite -[X in (_ <= X)%N]/(1 + 1)%N leq_add2r size_polyC_leq1.
Qed.

Lemma polynomial_mul d d' a b e (F : K -> 'M_(a, b)) (F' : K -> 'M_(b, e)) : polynomial_in d F -> polynomial_in d' F' ->
  polynomial_in (d + d') (fun c => F c *m F' c).
Proof.
move=> [M h eM] [M' h' eM']; exists (M *m M') => [i j|c]; last by rewrite map_mxM eM eM'.
rewrite mxE; apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => k _.
by apply: leq_trans (size_mul_leq _ _) _; rewrite -[(d + d').+1]/(d + d').+2.-1 -!subn1 leq_sub2r // -[_.+2]/(d.+1 + d').+1 -addnS leq_add.
Qed.

Lemma polynomial_scale d a b x (F : K -> 'M_(a, b)) : polynomial_in d F -> polynomial_in d (fun c => x *: F c).
Proof.
move=> /(polynomial_mul (polynomial_const x%:M))[M h e]; exists M => // c; by rewrite e mul_scalar_mx.
Qed.

Lemma polynomial_iter d e a n (F : K -> 'M_(a, n)) (A A1 : 'M_n) : polynomial_in d F ->
  polynomial_in (d + e) (fun c => iter e (mulmxr (A + c *: A1)) (F c)).
Proof.
move=> h; elim: e => [|e IH] /=; first by rewrite addn0.
by rewrite -addn1 addnA; apply: (polynomial_mul (F' := fun c => A + c *: A1)) IH (polynomial_line _ _).
Qed.

(** Of full rank at one point, and so at all but few. *)
Theorem full_on_lines d a n (F : K -> 'M_(a, n)) (ts : seq K) : polynomial_in d F -> row_full (F 0) -> uniq ts ->
  (forall c, c \in ts -> ~~ row_full (F c)) -> (size ts <= n * d)%N.
Proof.
move=> hF /row_fullP[P PM] ts_uniq bad; have [M hM eM] := polynomial_mul (polynomial_const P) hF; rewrite add0n in hM.
pose D := \det M; have eval c : D.[c] = \det (P *m F c) by rewrite -eM det_map_mx.
have D0 : D != 0.
  apply/eqP => D0; have := eval 0; rewrite D0 horner0 PM det1 => /esym/eqP.
  by rewrite oner_eq0.
have size_D : (size D <= (n * d).+1)%N by have := @size_det K n M (fun=> d); rewrite sum_nat_const card_ord; apply.
rewrite -ltnS; apply: leq_trans size_D; apply: max_poly_roots => //.
apply/allP=> c /bad not_full; rewrite rootE eval; apply/eqP; apply: contraNeq not_full => /= unit.
have : P *m F c \in unitmx by rewrite unitmxE unitfE.
by rewrite -row_full_unit => full; rewrite /row_full eqn_leq rank_leq_col -[X in (X <= _)%N](eqP full) mxrankM_maxr.
Qed.

End Degrees.

Section Lines.
Variables (K : fieldType) (N n nu : nat) (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)) (t q s : nat).
Notation seen := (seen_state Q u t q s).

Lemma polynomial_seen (A A1 : 'M_n) (B B1 : 'M_(nu, n)) : polynomial_in t (fun c => seen (A + c *: A1) (B + c *: B1)).
Proof.
apply: polynomial_sum => k; rewrite -[t in polynomial_in t]add0n.
apply: (polynomial_mul (F' := fun c => iter (t.-1 - k) (mulmxr (A + c *: A1)) (B + c *: B1))); first exact: polynomial_const.
apply: (polynomial_more (d := (1 + (t.-1 - k)))); first by have := ltn_ord k; lia.
by apply: polynomial_iter; apply: polynomial_line.
Qed.

Theorem whole_range_almost_every (A A1 : 'M_n) (B B1 : 'M_(nu, n)) (ts : seq K) : row_full (seen A B) -> uniq ts ->
  (forall c, c \in ts -> ~~ row_full (seen (A + c *: A1) (B + c *: B1))) -> (size ts <= n * t)%N.
Proof. by move=> full; apply: full_on_lines (polynomial_seen A A1 B B1) _; rewrite !scale0r !addr0. Qed.

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

Lemma delays_nilpotent l : iter l (mulmxr A) 1%:M = \matrix_(i, j) (j == i + l :> nat)%N%:R.
Proof.
elim: l => /= [|l ->]; apply/matrixP=> i j; rewrite !mxE; first by rewrite addn0 eq_sym.
have [jl|/negPf jl] := eqVneq (j : nat) (i + l.+1)%N.
  have ln : (i + l < n)%N by have := ltn_ord j; lia.
  rewrite (bigD1 (Ordinal ln)) //= big1 => [|k ne]; first by rewrite !mxE /= eqxx mul1r jl addnS eqxx addr0.
  by rewrite !mxE (_ : (k == i + l :> nat)%N = false) ?mul0r //; apply: contraNF ne => /eqP e; apply/eqP/val_inj.
by rewrite big1 // => k _; rewrite !mxE; have [->|/negPf kl] := eqVneq (k : nat) (i + l)%N; rewrite ?kl ?mul0r // -addnS jl mulr0.
Qed.

Theorem whole_range_delays : exists (A' : 'M[K]_n) (B' : 'M[K]_(nu, n)),
  iter n (mulmxr A') 1%:M = 0 /\ row_full (seen_state Q u t q s A' B').
Proof.
exists A, B; split.
  by rewrite delays_nilpotent; apply/matrixP=> i j; rewrite !mxE (_ : (_ == _) = false) //; have := ltn_ord j; lia.
apply: row_full_seen => w unseen.
have forgets k : (q <= k)%N -> iter k (mulmxr A) B = 0.
  move=> qk; rewrite delayed; apply/matrixP=> i j; rewrite !mxE (_ : (j == k :> nat) = false) ?andbF //.
  by apply/eqP; have := ltn_ord j; lia.
have zero := seen_unless_unreached qt unit excites forgets unseen.
apply/matrixP=> l j; rewrite ord1 [RHS]mxE; have lq := leq_trans (ltn_ord l) nq.
have := zero l lq; rewrite delayed => /matrixP/(_ (Ordinal nu0) 0); rewrite mxE [X in _ = X]mxE (bigD1 l) //= big1 => [|k ne].
  by rewrite addr0 mxE /= eqxx mul1r.
by rewrite mxE /= (_ : (k == l :> nat) = false) ?mul0r //; apply/eqP; move: ne; rewrite -val_eqE /=; lia.
Qed.


Theorem whole_range_somewhere : exists (A' : 'M[K]_n) (B' : 'M[K]_(nu, n)), row_full (seen_state Q u t q s A' B').
Proof. by have [A' [B' [_ full]]] := whole_range_delays; exists A', B'. Qed.

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
