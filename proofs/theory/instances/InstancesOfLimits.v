(** Instances for the headlines on limits: all premises of a headline hold together. For each headline NAME the theorem NAME_instance says
    that there is something that meets them, in the words of the headline; premises.py makes that statement of the headline's, and tests
    compare the two. All systems are small, and none of these theorems is a headline.

         plain == x(k+1) = u(k) + v(k), y = x: one state, one fault, one input, one output
    white_pair == two white signals that are uncorrelated
           led == the plain system with u white and v(k) = u(k+1)
        second == what tells that fault: v(k) = sum_j u(k+j) second j
         unled == the plain system with u white, and v uncorrelated with it *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary LimitsVocabulary Windows Signals Consistency Leads ConsistencyExamples.
From faultspace Require Existence Controllable ColouredInputs OneSided.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Plain.
Variable K : fieldType.

Definition plain : system K 1 1 1 := System 0 1%:M 1%:M 0.

Lemma plain_observed k : (0 < k)%N -> row_free (O plain k).
Proof.
move=> k0; apply: inj_row_free => x; rewrite mul_O => /samples_eq0/(_ 0%N k0).
by rewrite /output /= mulmx1 mul0mx addr0.
Qed.

Lemma plain_steered z : steered plain (1%:M : 'M_1) z.
Proof. by exists 1%N, (fun=> z); rewrite /= mul0mx add0r mulmx1. Qed.

Lemma from_rest N n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) (u : nat -> 'M_(N, nu)) (v : nat -> 'M_(N, m)) x0 :
  exists x y, process S B D u v x y /\ x 0%N = x0.
Proof.
pose x := fix x k := if k is j.+1 then x j *m sysA S + u j *m B + v j *m sysF S else x0.
by exists x, (fun k => x k *m sysC S + u k *m D + v k *m sysG S); split.
Qed.

Lemma white_pair H : exists u v : nat -> 'cV[K]_(H * (1 + 1)), [/\ white 1%:M u H, white 1%:M v H &
  forall i k, (i < H)%N -> (k < H)%N -> cov 1%:M (u i) (v k) = 0].
Proof.
have [w ww] := white_exists K (1 + 1) H.
have e a b (M : 'M_(1 + 1, a)) (M' : 'M_(1 + 1, b)) i k : (i < H)%N -> (k < H)%N ->
    cov 1%:M (w i *m M) (w k *m M') = if i == k then M^T *m M' else 0.
  by move=> iH kH; rewrite cov_mul cov_mul_left ww //; case: eqP => _; rewrite ?mulmx1 // mulmx0 mul0mx.
exists (fun k => w k *m col_mx 1%:M 0), (fun k => w k *m col_mx 0 1%:M).
split=> i k iH kH; rewrite e // tr_col_mx mul_row_col !(trmx0, trmx1) !(mulmx1, mul1mx, mulmx0, mul0mx) ?(addr0, add0r) //.
by case: eqP.
Qed.

(** u is white, then zero; v(k) = u(k+1), which the input sees through two of its samples. *)
Definition second j : 'M[K]_1 := if j is 1%N then 1%:M else 0.

Lemma led H : exists N (Q : 'M[K]_N) (u : nat -> 'cV_N) x y, [/\ Q^T = Q, white Q u H /\ (forall k, (H <= k)%N -> u k = 0),
  process plain (1%:M : 'M_1) 0 u (fun k => u k.+1) x y, x 0%N = 0 & leads 2 second Q H u (fun k => u k.+1)].
Proof.
have [w ww] := white_exists K 1 H; pose u k := if (k < H)%N then w k else 0.
have wu : white 1%:M u H by move=> i k iH kH; rewrite /u iH kH ww.
have [x [y [model x0]]] := from_rest plain (1%:M : 'M_1) 0 u (fun k => u k.+1) 0.
exists (H * 1)%N, 1%:M, u, x, y; split=> //; first by rewrite trmx1.
  by split=> // k; rewrite leqNgt /u; case: ifP.
apply: sum_leads => // k; rewrite !big_ord_recl big_ord0 /= mulmx0 add0r addr0 mulmx1 addn1 //.
Qed.

Lemma unled H : exists N (Q : 'M[K]_N) (u v : nat -> 'cV_N) x y, [/\ Q^T = Q, white Q u H,
  forall i k, (i < H)%N -> (k < H)%N -> cov Q (u i) (v k) = 0, process plain (1%:M : 'M_1) 0 u v x y & x 0%N = 0].
Proof.
have [u [v [wu _ uv]]] := white_pair H; have [x [y [model x0]]] := from_rest plain (1%:M : 'M_1) 0 u v 0.
by exists (H * (1 + 1))%N, 1%:M, u, v, x, y; split=> //; rewrite trmx1.
Qed.

End Plain.

(** ** assumption-2, proposition-1 *)

Theorem projected_limits_exist_instance (K : fieldType) : exists N nu (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) H t s,
  white Q u H /\ (t + s <= H)%N.
Proof. by have [u wu] := white_exists K 1 2; exists (2 * 1)%N, 1%N, 1%:M, u, 2%N, 1%N, 1%N. Qed.

Theorem assumption_2_two_sided_instance (K : fieldType) : exists N nu m (Q : 'M[K]_N) t s (u : nat -> 'M[K]_(N, nu))
    (v : nat -> 'M[K]_(N, m)),
  (forall i k, (t <= i < t + s)%N -> (t <= k < t + s)%N -> cov Q (u i) (v k) = 0).
Proof.
have [u [v [_ _ uv]]] := white_pair K 2; exists (2 * (1 + 1))%N, 1%N, 1%N, 1%:M, 0%N, 2%N, u, v => i k iH kH.
exact: uv.
Qed.

Theorem proposition_1_two_sided_b_d_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y t s W, let Uf := future t s u in
  process S B D u v x y /\ (0 < s)%N /\ row_free (O S s.-1) /\ W *m cov Q Uf Uf = 1%:M /\ cov Q Uf (future t s v) = 0.
Proof.
have [N [Q [u [v [x [y [_ wu uv model _]]]]]]] := unled K 2.
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, v, x, y, 0%N, 2%N, 1%:M => Uf.
split; first exact: model.
split; first by [].
split; first exact: plain_observed.
split; first by rewrite (cov_future_white wu) // mulmx1.
by apply: uncorrelated_futures => i k /andP[_ iH] /andP[_ kH]; apply: uv.
Qed.

Theorem proposition_1_two_sided_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t q s L,
  process S B D u v x y /\ (q <= t)%N /\ (forall i k, (t - q <= i < t + s)%N -> (t <= k < t + s)%N -> cov Q (u i) (v k) = 0) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [v [x [y [_ wu uv model _]]]]]]] := unled K 2.
have [L lim] := Existence.limit_exists y (future (1 - 1) 1 u) wu (leqnn (1 + 1)%N).
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, v, x, y, 1%N, 1%N, 1%N, L; do !split=> //.
by move=> i k /andP[_ iH] /andP[_ kH]; apply: uv.
Qed.

Theorem proposition_1_white_a_c_instance (K : fieldType) : exists (a : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N), white Q u H /\
  let y k := row_mx (u k) (u k.+1) in
  (exists i k, (i <= k)%N /\ (k.+1 < H)%N) /\ a != 0 /\ exists t q s L, (q <= t)%N /\ (t + s < H)%N /\
    projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [u wu] := white_exists K 1 3; exists 1, (3 * 1)%N, 3%N, 1%:M, u; split=> // y.
split; first by exists 0%N, 0%N.
split; first exact: oner_neq0.
have [L lim] := Existence.limit_exists y (future (1 - 1) 1 u) wu (isT : (1 + 1 <= 3)%N).
by exists 1%N, 1%N, 1%N, L.
Qed.

Theorem white_b_d_wrong_a_c_right_instance (K : realFieldType) : exists (a b : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N), Q^T = Q /\
  white Q u H /\ a != 0 /\ b != 0 /\ a + b != 0 /\ let v k := u k.+1 in let B := b%:M in
  let S : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  (exists i k, (i <= k)%N /\ (k.+1 < H)%N) /\ exists x y, process S B 0 u v x y /\
    (forall i, (1 < i < H)%N -> cov Q (u i) (x 0%N) = 0) /\
    (exists t q s L, (0 < q)%N /\ (2 + q <= t)%N /\ (t + s + 2 <= H)%N /\
      projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L) /\
    exists t k B' (D' : 'M[K]_(1, 1 + 1)), (1 < t)%N /\ (0 < k)%N /\ (t + k + 2 < H)%N /\ (B' = B \/ D' = 0).
Proof.
have [u wu] := white_exists K 1 6; exists 1, 1, (6 * 1)%N, 6%N, 1%:M, u; split; first exact: trmx1.
do 3 (split; first by rewrite // oner_neq0); split; first by rewrite (_ : 1 + 1 = 2%:R) // pnatr_eq0.
move=> v B S; split; first by exists 0%N, 0%N.
have [x [y [model x0]]] := from_rest S B 0 u v 0; exists x, y; split=> //; split; first by move=> i _; rewrite x0 cov_zero.
split; last by exists 2%N, 1%N, B, 0; do !split=> //; left.
have [L lim] := Existence.limit_exists y (future (3 - 1) 1 u) wu (isT : (3 + 1 <= 6)%N).
by exists 3%N, 1%N, 1%N, L.
Qed.

Theorem proposition_1_coloured_a_c_instance : let Q := MovingAverage.Q in let u := MovingAverage.u in let y := MovingAverage.y in
  (exists i k, (i <= k < 4)%N) /\ exists L, projected_limit Q (future 0 2 u) (future 2 2 u) (future 2 2 y) L.
Proof. by split; [exists 0%N, 0%N|have [_ _ _ _ []] := OneSided.coloured_limit_outside]. Qed.

Theorem proposition_1_white_a_c_seen_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y H J Phi q t s L,
  process S B D u v x y /\ white Q u H /\ leads J Phi Q H u v /\ (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) /\
  (n <= q)%N /\ (J + q <= t)%N /\ (t + s + J <= H)%N /\ row_free (O S s) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [x [y [_ [wu _] model x0 lead]]]]]] := led K 6.
have [L lim] := Existence.limit_exists y (future (3 - 1) 1 u) wu (isT : (3 + 1 <= 6)%N).
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, (fun k => u k.+1), x, y, 6%N, 2%N, (second K), 1%N, 3%N, 1%N, L.
by do !split=> //; [move=> i _; rewrite x0 cov_zero|exact: plain_observed].
Qed.

Theorem white_a_c_up_to_basis_instance (K : fieldType) : exists N n m m' p nu (Q : 'M[K]_N) (S : system K n m p) (S' : system K n m' p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y H J Phi q t s L,
  process S B D u v x y /\ white Q u H /\ leads J Phi Q H u v /\ (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) /\
  (n <= q)%N /\ (J + q <= t)%N /\ (t + s + J <= H)%N /\ row_free (O S s.-1) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L /\ (L == O S' s)%MS.
Proof.
have [N [Q [u [x [y [_ [wu _] model x0 lead]]]]]] := led K 7.
have [L lim] := Existence.limit_exists y (future (3 - 1) 1 u) wu (isT : (3 + 2 <= 7)%N).
have start i : (2 <= i < 7)%N -> cov Q (u i) (x 0%N) = 0 by move=> _; rewrite x0 cov_zero.
exists N, 1%N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), (plain K), 1%:M, 0, u, (fun k => u k.+1), x, y, 7%N, 2%N, (second K), 1%N, 3%N, 2%N, L.
do !split=> //; first exact: plain_observed.
have [//|//|//||_ ->//] := Controllable.white_limit_controllable model wu lead start _ _ _ _ lim; first exact: plain_observed.
have -> : seen_B (plain K) 2 (second K) 1%:M = 1%:M.
  by rewrite /seen_B !big_ord_recl big_ord0 /times_power /= mul0mx mulmx0 !addr0.
by move=> z; have [k [w e]] := plain_steered z; exists k, w.
Qed.

Theorem proposition_1_white_b_d_seen_instance (K : realFieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p)
    (B B' : 'M_(nu, n)) (D D' : 'M_(nu, p)) u v x y H J Phi t k,
  process S B D u v x y /\ white Q u H /\ leads J Phi Q H u v /\ (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) /\
  Q^T = Q /\ (J <= t)%N /\ (t + k + J < H)%N /\ let Bs := seen_B S J Phi B in let Ds := seen_D S J Phi D in
  row_free (O S k) /\ mean_square Q S u y t k B' D' = mean_square Q S u y t k Bs Ds.
Proof.
have [N [Q [u [x [y [sym [wu _] model x0 lead]]]]]] := led K 6; pose S := plain K.
exists N, 1%N, 1%N, 1%N, 1%N, Q, S, 1%:M, (seen_B S 2 (second K) 1%:M), 0, (seen_D S 2 (second K) 0), u, (fun k => u k.+1), x, y.
exists 6%N, 2%N, (second K), 2%N, 1%N.
by do !split=> //; [move=> i _; rewrite x0 cov_zero|exact: plain_observed].
Qed.

Theorem proposition_1_parametric_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y H J Phi q t s L,
  process S B D u v x y /\ white Q u H /\ leads J Phi Q H u v /\ (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) /\
  (J + q <= t)%N /\ (t + s + J <= H)%N /\ projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [x [y [_ [wu _] model x0 lead]]]]]] := led K 6.
have [L lim] := Existence.limit_exists y (future (3 - 1) 1 u) wu (isT : (3 + 1 <= 6)%N).
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, (fun k => u k.+1), x, y, 6%N, 2%N, (second K), 1%N, 3%N, 1%N, L.
by do !split=> //; move=> i _; rewrite x0 cov_zero.
Qed.

(** Order 0: u is its own innovation. *)
Theorem proposition_1_autoregressive_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t s z (Z : 'M_(N, z)) a (A : nat -> 'M[K]_nu) e J (Phi : nat -> 'M_(nu, m)) L,
  process S B D u v x y /\ (a <= s)%N /\ (forall k, (t + s <= k)%N -> u k = \sum_(i < a) u (k - i.+1)%N *m A i + e k) /\
  (forall k, (t + s <= k)%N -> cov Q Z (e k) = 0 /\ cov Q (future t s u) (e k) = 0) /\
  (forall k, v k = \sum_(j < J) u (k + j)%N *m Phi j) /\ projected_limit Q Z (future t s u) (future t s y) L.
Proof.
have [N [Q [u [x [y [_ [wu end_u] model x0 lead]]]]]] := led K 2.
have [L lim] := Existence.limit_exists y (future 0 1 u) wu (leqnn (1 + 1)%N).
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, (fun k => u k.+1), x, y, 1%N, 1%N, (1 * 1)%N, (future 0 1 u), 0%N, (fun=> 0), u.
exists 2%N, (second K), L; do !split=> //.
- by move=> k _; rewrite big_ord0 add0r.
- by rewrite end_u // cov_zero.
- by rewrite end_u // cov_zero.
by move=> k; rewrite !big_ord_recl big_ord0 /= mulmx0 add0r addr0 mulmx1 addn1.
Qed.

Theorem proposition_1_lead_one_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) (Phi : 'M_(nu, m)) u x y t s z (Z : 'M_(N, z)) L,
  sysG S = 0 /\ process S B D u (fun k => u k.+1 *m Phi) x y /\ projected_limit Q Z (future t s u) (future t s y) L.
Proof.
have [N [Q [u [x [y [_ [wu end_u] model x0 lead]]]]]] := led K 2.
have [L lim] := Existence.limit_exists y (future 0 1 u) wu (leqnn (1 + 1)%N).
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, 1%:M, u, x, y, 1%N, 1%N, (1 * 1)%N, (future 0 1 u), L; do !split=> //.
by have [-> _] := model k; rewrite !mulmx1.
by have [_ ->] := model k; rewrite !mulmx1.
Qed.

(** ** proposition-1, all of the range *)

Theorem whole_range_nilpotent_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t q s L,
  process S B D u v x y /\ (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) /\ (q <= t)%N /\
  cov Q (future t s u) (future t s u) \in unitmx /\ cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx /\
  iter q (mulmxr (sysA S)) 1%:M = 0 /\ (forall z, steered S B z) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [v [x [y [_ wu uv model _]]]]]]] := unled K 2.
have [L lim] := Existence.limit_exists y (future (1 - 1) 1 u) wu (leqnn (1 + 1)%N).
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, v, x, y, 1%N, 1%N, 1%N, L; do !split=> //.
- by rewrite (cov_future_white wu) ?unitmx1.
- by rewrite (cov_future_white wu) ?unitmx1.
- by rewrite /= mulmx0.
exact: plain_steered.
Qed.

(** A first-order input: u(k) = u(k-1)/2 + e(k), and A = 1/2. *)
Theorem whole_range_autoregressive_stationary_instance : exists (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y t q s a (Au : nat -> 'M_nu) e L,
  Q^T = Q /\ process S B D u v x y /\ (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) /\
  autoregressive Q a Au u e (t + s) /\ (forall k, (a <= k < t + s)%N -> cov Q (e k) (x 0%N) = 0) /\
  stationary Q u u (t + s) /\ stationary Q u x (t + s) /\ cov Q (future t s u) (future t s u) \in unitmx /\
  (0 < s)%N /\ (a <= s)%N /\ (n <= q <= t)%N /\ (n + a <= t)%N /\ (forall z, steered S B z) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
pose c : rat := 2%:R^-1.
have c1 : c ^+ 2 != 1 by [].
have [Q [u [e [x [y [sym model [ar later] [uu ux] unit]]]]]] := @ColouredInputs.first_order_signals (field_of rat) c c 3 c1 c1.
exists (field_of rat), 3%N, 1%N, 0%N, 1%N, 1%N, Q, (System c%:M 0 1%:M 0), 1%:M, 0, u, (fun=> 0), x, y, 2%N, 1%N, 1%N, 1%N.
exists (fun=> c%:M), e; eexists; split; first exact: sym.
split; first exact: model.
split; first by move=> i k _ _; exact: cov_zero.
do 4 (split; first by [exact: ar|exact: later|exact: uu|exact: ux]).
split; first exact: unit.
do 4 (split; first by []).
split; first by move=> z; exists 1%N, (fun=> z); rewrite /= mul0mx add0r mulmx1.
exact: projected_limit_exists (unit 2%N 1%N isT).
Qed.

(** z(k) = w(k) and u(k) = w(k+1) for a white w, A = 0. *)
Theorem whole_range_one_state_instance (K : realFieldType) : exists N m p nu (Q : 'M[K]_N) (S : system K 1 m p) (B : 'M_(nu, 1))
    (D : 'M_(nu, p)) u v x z y t q s L, let H := (t.+1 + s)%N in
  Q^T = Q /\ (forall g : 'cV_N, 0 <= cov Q g g 0 0) /\ process S B D u v x y /\ `|sysA S 0 0| < 1 /\
  (forall i k, (i < H)%N -> (k < H)%N -> cov Q (u i) (v k) = 0) /\
  (forall k, z k.+1 = z k *m sysA S + u k *m B) /\ (forall i, (i < H)%N -> cov Q (u i) (x 0%N - z 0%N) = 0) /\
  stationary Q u u H /\ stationary Q u z H /\ stationary Q z z H /\ (0 < s)%N /\
  cov Q (future t s.+1 u) (future t s.+1 u) \in unitmx /\ B != 0 /\ (0 < q <= t.+1)%N /\
  projected_limit Q (future (t.+1 - q) q u) (future t.+1 s u) (future t.+1 s y) L.
Proof.
have [w [v [ww _ wv]]] := white_pair K 3; pose u k := w k.+1.
have wu : white 1%:M u 2 by move=> i k iH kH; rewrite /u ww.
have [x [y [model x0]]] := from_rest (plain K) (1%:M : 'M_1) 0 u v (w 0%N).
have same (f g : nat -> 'cV[K]_(3 * (1 + 1))) a b : (forall k, f k = w (k + a)%N) -> (forall k, g k = w (k + b)%N) ->
    (a <= 1)%N -> (b <= 1)%N -> stationary 1%:M f g 2.
  move=> ef eg a1 b1 i k iH kH; have ia : (i.+1 + a < 3)%N := leq_add iH a1; have kb : (k.+1 + b < 3)%N := leq_add kH b1.
  have ia' : (i + a < 3)%N := ltnW ia; have kb' : (k + b < 3)%N := ltnW kb.
  by rewrite !ef !eg (ww _ _ ia kb) (ww _ _ ia' kb') !addSn eqSS.
exists (3 * (1 + 1))%N, 1%N, 1%N, 1%N, 1%:M, (plain K), 1%:M, 0, u, v, x, w, y, 0%N, 1%N, 1%N; eexists; do !split=> //.
- exact: trmx1.
- move=> g; rewrite /cov mulmx1 mxE; apply: sumr_ge0 => i _; by rewrite mxE -expr2 sqr_ge0.
- by rewrite mxE normr0 ltr01.
- by move=> i k iH kH; rewrite /u wv // ltnS ltnW.
- by move=> k; rewrite mulmx0 add0r mulmx1.
- by move=> i _; rewrite x0 subrr cov_zero.
- by apply: (same _ _ 1%N 1%N) => // k; rewrite [(k + 1)%N]addn1.
- by apply: (same _ _ 1%N 0%N) => // k; rewrite ?[(k + 1)%N]addn1 ?[(k + 0)%N]addn0.
- by apply: (same _ _ 0%N 0%N) => // k; rewrite [(k + 0)%N]addn0.
- by rewrite (cov_future_white wu) ?unitmx1.
- exact: oner_neq0.
by apply: projected_limit_exists; rewrite (cov_future_white wu) ?unitmx1.
Qed.
