(** Further instances for headlines on limits: assumption-2, when the limit has all of the range, and settle-1. The input is white. The
    system is the plain one, x(k+1) = u(k) + v(k), y = x, with a fault that is uncorrelated with the input. For settle-1 the fault is
    u(k-1); where both are right only if it is never seen, it is the first of two faults, of which the second alone leads to the state.

         unled_limit == the limit of one past and one future sample, which has all of the range
              unseen == x(k+1) = u(k) + v_2(k), y = x
        first_of_two == Phi, u(k-1) being the first of the two faults
    unseen_following == the process with that fault is one without a fault
        unseen_limit == what that theorem supposes, u being white for three samples
    scalar_following == x(k+1) = a x(k) + u(k) + f u(k-1), y = x, with its limit *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary LimitsVocabulary Windows Signals Consistency Leads InstancesOfLimits OrderNames.
From faultspace Require Existence ConsistencyExamples WholeRange AlmostEvery FollowingExamples OutputError.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** assumption-2 *)

Theorem assumption_2_one_sided_instance (K : realFieldType) : exists (a : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N), Q^T = Q /\
  white Q u H /\ a != 0 /\ let B := (- a)%:M in (exists i k, (i <= k)%N /\ (k.+1 < H)%N) /\
  exists t k (B' : 'M[K]_1) (D' : 'M[K]_(1, 1 + 1)), (1 < t)%N /\ (0 < k)%N /\ (t + k + 2 < H)%N /\ (B' = B \/ D' = 0).
Proof.
have [u wu] := ConsistencyExamples.white_exists K 1 6; exists 1, (6 * 1)%N, 6%N, 1%:M, u.
split; first exact: trmx1; split; first exact: wu; split; first exact: oner_neq0.
by move=> B; split; [exists 0%N, 0%N|exists 2%N, 1%N, B, (row_mx 1%:M 0); do !split=> //; left].
Qed.

Theorem assumption_2_one_sided_windows_instance (K : realFieldType) : exists N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) t s,
  white Q u H /\ (1 < s)%N /\ (t + s < H)%N.
Proof. by have [u wu] := ConsistencyExamples.white_exists K 1 4; exists (4 * 1)%N, 4%N, 1%:M, u, 1%N, 2%N. Qed.

Theorem assumption_2_without_lag_zero_instance (K : realFieldType) : exists N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N), Q^T = Q /\
  white Q u H /\ let B : 'M[K]_1 := - 1%:M in (exists i k, i != k /\ (i < H)%N /\ (k < H)%N) /\
  exists t k B' (D' : 'M[K]_(1, 1 + 1)), (0 < t)%N /\ (0 < k)%N /\ (t + k + 1 < H)%N /\ (B' = B \/ D' = 0).
Proof.
have [u wu] := ConsistencyExamples.white_exists K 1 4; exists (4 * 1)%N, 4%N, 1%:M, u.
split; first exact: trmx1; split; first exact: wu.
by move=> B; split; [exists 0%N, 1%N|exists 1%N, 1%N, B, (row_mx 0 1%:M); do !split=> //; left].
Qed.

(** ** proposition-1, all of the range *)

Lemma unled_limit (K : fieldType) : exists N (Q : 'M[K]_N) (u v : nat -> 'cV_N) x y L, [/\ white Q u 2 /\
    cov Q (future 1 1 u) (future 1 1 u) \in unitmx, process (plain K) (1%:M : 'M_1) 0 u v x y /\ x 0%N = 0,
  forall i k, (i < 1 + 1)%N -> (k < 1 + 1)%N -> cov Q (u i) (v k) = 0, autoregressive Q 0 (fun=> 0) u u (1 + 1) &
  projected_limit Q (future (1 - 1) 1 u) (future 1 1 u) (future 1 1 y) L /\ (L == O (plain K) 1)%MS].
Proof.
have [N [Q [u [v [x [y [_ wu uv model x0]]]]]]] := unled K 2.
have [L lim] := Existence.limit_exists y (future (1 - 1) 1 u) wu (leqnn (1 + 1)%N).
have unit : cov Q (future 1 1 u) (future 1 1 u) \in unitmx by rewrite (cov_future_white wu) ?unitmx1.
have ar : autoregressive Q 0 (fun=> 0) u u (1 + 1).
  move=> k /andP[_ kH]; rewrite big_ord0 add0r wu // eqxx unitmx1; split=> // i ik.
  by rewrite wu ?(ltn_trans ik) // gtn_eqF.
have later k : (0 <= k < 1 + 1)%N -> cov Q (u k) (x 0%N) = 0 by rewrite x0 cov_zero.
have full := WholeRange.autoregressive_whole_range model (leqnn 1%N) uv ar later unit (leqnn 1%N) (@plain_steered K) lim.
by exists N, Q, u, v, x, y, L.
Qed.

Theorem whole_range_autoregressive_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t q s a (Au : nat -> 'M_nu) e L,
  process S B D u v x y /\ (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) /\
  autoregressive Q a Au u e (t + s) /\ (forall k, (a <= k < t + s)%N -> cov Q (e k) (x 0%N) = 0) /\ (n + a <= q <= t)%N /\
  cov Q (future t s u) (future t s u) \in unitmx /\ (forall z, steered S B z) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [v [x [y [L [[wu unit] [model x0] uv ar [lim _]]]]]]]]] := unled_limit K.
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, v, x, y, 1%N, 1%N, 1%N, 0%N, (fun=> 0), u, L.
by do !split=> //; [move=> k _; rewrite x0 cov_zero|exact: plain_steered].
Qed.

(** With rho = 0 in the field with two elements, and so in every one. *)
Theorem autoregressive_signals_exist_instance (K : fieldType) : exists (alpha rho : K), rho ^+ 2 != 1 /\ alpha * rho != 1.
Proof. by exists 1, 0; rewrite expr0n mulr0 eq_sym oner_neq0. Qed.

Theorem whole_range_controllable_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t q s L,
  process S B D u v x y /\ (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) /\
  (forall i j, (i < t + s)%N -> steered S B (row j (cov Q (u i) (x 0%N)))) /\ (q <= t)%N /\ row_free (O S s) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L /\ (L == O S s)%MS.
Proof.
have [N [Q [u [v [x [y [L [_ [model x0] uv _ [lim full]]]]]]]]] := unled_limit K.
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, v, x, y, 1%N, 1%N, 1%N, L.
by do 2 (split; first by []); split; [move=> i j _; exact: plain_steered|do !split=> //; exact: plain_observed].
Qed.

Theorem whole_range_seen_instance (K : fieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t q s L,
  process S B D u v x y /\ (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) /\
  (forall i, (t - q <= i < t + s)%N -> cov Q (u i) (x 0%N) = 0) /\ (q <= t)%N /\ cov Q (future t s u) (future t s u) \in unitmx /\
  row_free (O S s) /\ projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [v [x [y [L [[wu unit] [model x0] uv ar [lim _]]]]]]]]] := unled_limit K.
exists N, 1%N, 1%N, 1%N, 1%N, Q, (plain K), 1%:M, 0, u, v, x, y, 1%N, 1%N, 1%N, L.
by do !split=> //; [move=> k _; rewrite x0 cov_zero|exact: plain_observed].
Qed.

Theorem whole_range_somewhere_instance (K : fieldType) : exists N n nu (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) t q s,
  (0 < nu)%N /\ (n <= q)%N /\ (q <= t)%N /\ cov Q (future t s u) (future t s u) \in unitmx /\
  cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx.
Proof.
have [u wu] := ConsistencyExamples.white_exists K 1 3; exists (3 * 1)%N, 2%N, 1%N, 1%:M, u, 2%N, 2%N, 1%N.
by rewrite !(cov_future_white wu) ?unitmx1.
Qed.

(** With one bad point on the line, at which B is zero. *)
Theorem whole_range_almost_every_instance (K : fieldType) : exists N n nu (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) t q s (A A1 : 'M_n)
    (B B1 : 'M_(nu, n)) (ts : seq K),
  row_full (seen_state Q u t q s A B) /\ uniq ts /\
  (forall c, c \in ts -> ~~ row_full (seen_state Q u t q s (A + c *: A1) (B + c *: B1))).
Proof.
have [u wu] := ConsistencyExamples.white_exists K 1 2.
have unit t s : (t + s <= 2)%N -> cov 1%:M (future t s u) (future t s u) \in unitmx.
  by move=> h; rewrite (cov_future_white wu) ?unitmx1.
have [A [B full]] := AlmostEvery.whole_range_somewhere (isT : (0 < 1)%N) (leqnn 1%N) (leqnn 1%N) (unit 1%N 1%N isT)
  (unit 0%N 2%N isT).
exists (2 * 1)%N, 1%N, 1%N, 1%:M, u, 1%N, 1%N, 1%N, A, 0, B, (- B), [:: 1]; split; first exact: full.
split=> // c; rewrite inE => /eqP->; rewrite !scale1r subrr /seen_state big1 => [|k _]; first by rewrite /row_full mxrank0.
by rewrite (_ : iter _ _ _ = 0) ?mulmx0 //; elim: (_ - _)%N => //= j ->; rewrite mul0mx.
Qed.

(** ** proposition-1, white-a-c-seen and coloured-a-c *)

Theorem range_determines_a_c_instance (K : fieldType) : exists n m p (S : system K n m p) s, row_free (O S s.-1).
Proof. by exists 1%N, 1%N, 1%N, (plain K), 2%N; exact: plain_observed. Qed.

Theorem coloured_a_c_stationary_instance : exists i k, (i < 3)%N /\ (k < 3)%N.
Proof. by exists 0%N, 1%N. Qed.

(** ** settle-1 *)

Section Unseen.
Variable K : fieldType.

Definition unseen : system K 1 (1 + 1) 1 := System 0 (col_mx 0 1%:M) 1%:M 0.
Definition first_of_two : 'M[K]_(1, 1 + 1) := row_mx 1%:M 0.

Lemma unseen_observed k : (0 < k)%N -> row_free (O unseen k).
Proof.
move=> k0; apply: inj_row_free => x; rewrite mul_O => /samples_eq0/(_ 0%N k0).
by rewrite /output /= mulmx1 mul0mx addr0.
Qed.

(** The process with that fault, and without a fault. *)
Lemma unseen_following N (Q : 'M[K]_N) (u : nat -> 'cV_N) : exists w x y,
  [/\ process unseen (1%:M : 'M_1) 0 u (fun k => w k *m first_of_two) x y, process unseen (1%:M : 'M_1) 0 u (fun=> 0) x y,
    forall k, w k.+1 = u k & forall i, cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0].
Proof.
have [w [x [y [model wu start]]]] := FollowingExamples.following_exists Q unseen (1%:M : 'M_1) 0 first_of_two u.
exists w, x, y; split=> // k.
have [-> ->] := model k; rewrite -!mulmxA /= mul_row_col !mulmx0 mul0mx addr0 mulmx0; by split; rewrite // mul0mx.
Qed.

End Unseen.

(** All that both theorems suppose but for the best fit; t' = 1 and k at most 1. *)
Lemma unseen_limit (K : realFieldType) : exists N (Q : 'M[K]_N) u w x y L,
  [/\ process (unseen K) (1%:M : 'M_1) 0 u (fun k => w k *m first_of_two K) x y /\ (forall k, w k.+1 = u k), white Q u 3 /\ Q^T = Q,
    forall i, (i < 3)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0,
    projected_limit Q (future (1 - 1) 1 u) (future 1 2 u) (future 1 2 y) L /\ (L <= O (unseen K) 2)%MS &
    forall k B' D', (k <= 1)%N -> mean_square Q (unseen K) u y 1 k 1%:M 0 <= mean_square Q (unseen K) u y 1 k B' D'].
Proof.
have [u wu] := ConsistencyExamples.white_exists K 1 3; have [w [x [y [model quiet next start]]]] := unseen_following 1%:M u.
have [L lim] := Existence.limit_exists y (future (1 - 1) 1 u) wu (leqnn (1 + 2)%N).
exists (3 * 1)%N, 1%:M, u, w, x, y, L; split=> //; first by split=> //; exact: trmx1.
- split=> //; have [|M [_ ->]] := two_sided_past_inputs quiet (leqnn 1%N) _ lim; last exact: submxMl.
  by move=> i k _ _; exact: cov_zero.
move=> k B' D' k1; have none : leads 0 (fun=> 0) 1%:M 3 u (fun=> 0 : 'M_(3 * 1, 1 + 1)).
  by move=> i j _ _; rewrite cov_zero; case: ifP => // /andP[].
have past i : (0 <= i < 3)%N -> cov 1%:M (u i) (x 0%N) = 0 by move=> _; case: (start i).
have late : (1 + k + 0 < 3)%N by rewrite addn0.
have [] := OutputError.least_squares quiet wu none past B' D' (@trmx1 K _) (isT : (0 <= 1)%N) late.
by rewrite /seen_B /seen_D !big_ord0 !addr0.
Qed.

Theorem settle_1_not_both_instance (K : realFieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) (Phi : 'M_(nu, m)) u w x y H t q s L t' k,
  process S B D u (fun k => w k *m Phi) x y /\ (forall k, w k.+1 = u k) /\ white Q u H /\ Q^T = Q /\
  (forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0) /\ (0 < q <= t)%N /\ (t + s <= H)%N /\ (0 < s)%N /\
  row_free (O S s.-1) /\ (t' + k < H)%N /\ row_free (O S k) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L /\ (L <= O S s)%MS /\
  (forall B' D', mean_square Q S u y t' k B D <= mean_square Q S u y t' k B' D').
Proof.
have [N [Q [u [w [x [y [L [[model next] [wu sym] start [lim inside] best]]]]]]]] := unseen_limit K.
exists N, 1%N, (1 + 1)%N, 1%N, 1%N, Q, (unseen K), 1%:M, 0, (first_of_two K), u, w, x, y, 3%N, 1%N, 1%N, 2%N, L, 1%N, 1%N.
do 8 (split; first by []); split; first exact: unseen_observed; split; first by []; split; first exact: unseen_observed.
by do 2 (split; first by []); move=> B' D'; exact: best.
Qed.

Theorem settle_1_not_both_in_sum_instance (K : realFieldType) : exists N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) (Phi : 'M_(nu, m)) u w x y H t q s L t' ks k,
  process S B D u (fun k => w k *m Phi) x y /\ (forall k, w k.+1 = u k) /\ white Q u H /\ Q^T = Q /\
  (forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0) /\ (0 < q <= t)%N /\ (t + s <= H)%N /\ (0 < s)%N /\
  row_free (O S s.-1) /\ (forall j, j \in ks -> (t' + j < H)%N) /\ k \in ks /\ row_free (O S k) /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L /\ (L <= O S s)%MS /\
  (forall B' D', \sum_(j <- ks) mean_square Q S u y t' j B D <= \sum_(j <- ks) mean_square Q S u y t' j B' D').
Proof.
have [N [Q [u [w [x [y [L [[model next] [wu sym] start [lim inside] best]]]]]]]] := unseen_limit K.
exists N, 1%N, (1 + 1)%N, 1%N, 1%N, Q, (unseen K), 1%:M, 0, (first_of_two K), u, w, x, y, 3%N, 1%N, 1%N, 2%N, L, 1%N, [:: 0%N; 1%N], 1%N.
do 8 (split; first by []); split; first exact: unseen_observed; split; first by move=> j; rewrite !inE => /orP[] /eqP->.
split; first by []; split; first exact: unseen_observed; do 2 (split; first by []).
by move=> B' D'; rewrite !big_cons !big_nil !addr0; apply: lerD; exact: best.
Qed.

(** One state, a and f, and four samples. *)
Lemma scalar_following (K : realFieldType) (a f : K) t q s H (tH : (t + s <= H)%N) : exists N (Q : 'M[K]_N) (u w : nat -> 'cV[K]_N) x y L,
  white Q u H /\ [/\ process (System a%:M f%:M 1%:M 0 : system K 1 1 1) (1%:M : 'M_1) 0 u w x y, forall k, w k.+1 = u k &
    forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0] /\
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [u wu] := ConsistencyExamples.white_exists K 1 H; have [w [x [y follows]]] := @FollowingExamples.one_follows K a f _ H 1%:M u.
have [L lim] := Existence.limit_exists y (future (t - q) q u) wu tH.
by exists (H * 1)%N, 1%:M, u, w, x, y, L.
Qed.

Theorem settle_1_biased_instance (K : realFieldType) : exists (a f : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N),
  white Q u H /\ 0 < a /\ 0 < f /\ let S : system K 1 1 1 := System a%:M f%:M 1%:M 0 in
  let follows w x y := [/\ process S (1%:M : 'M_1) 0 u w x y, forall k, w k.+1 = u k &
    forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0] in
  exists w x y t q s L, follows w x y /\ (0 < q <= t)%N /\ (1 < s)%N /\ (t + s <= H)%N /\
    projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L.
Proof.
have [N [Q [u [w [x [y [L [wu [follows lim]]]]]]]]] := scalar_following (1 : K) 1 1 (leqnn (1 + 2)%N).
exists 1, 1, N, 3%N, Q, u; split; first by []; do 2 (split; first exact: ltr01).
by move=> S follow; exists w, x, y, 1%N, 1%N, 2%N, L.
Qed.

(** a = 1 and f = -2. *)
Theorem settle_1_all_right_instance (K : realFieldType) : exists (a f : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N),
  white Q u H /\ a != 0 /\ a * f = - (1 + a ^+ 2) /\ let S : system K 1 1 1 := System a%:M f%:M 1%:M 0 in
  let follows w x y := [/\ process S (1%:M : 'M_1) 0 u w x y, forall k, w k.+1 = u k &
    forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0] in
  exists w x y t, follows w x y /\ (t + 2 <= H)%N /\
    (exists q L, (2 < q <= t)%N /\ projected_limit Q (future (t - q) q u) (future t 2 u) (future t 2 y) L) /\
    exists W, let Uf := future t 2 u in W *m cov Q Uf Uf = 1%:M.
Proof.
have [N [Q [u [w [x [y [L [wu [follows lim]]]]]]]]] := scalar_following (1 : K) (- (1 + 1 ^+ 2)) 3 (leqnn (3 + 2)%N).
exists 1, (- (1 + 1 ^+ 2)), N, 5%N, Q, u; split; first by []; rewrite oner_neq0 mul1r; do 2 (split; first by []).
move=> S follow; exists w, x, y, 3%N; split; first exact: follows; split; first by []; split; first by exists 3%N, L.
by exists 1%:M; rewrite /= (cov_future_white wu) ?mulmx1.
Qed.
