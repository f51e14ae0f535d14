(** The third part of Headlines.v, which includes it: the limits of subspace identification, further. When the limit of PI-MOESP has
    all of the range of O_s, what the range tells of A and C, a fault that follows the input, and examples. LimitsVocabulary.v tells the
    words that are not in Vocabulary.v: steered, similar, autoregressive, stationary, seen_state.

    Measurement noise is nowhere in these theorems, as it is a fault with F = 0 and G = 1 (noise_is_a_fault); those of settle-1, where the
    fault is made of the inputs alone, are without noise. Where a statement speaks of a least mean square error, of a positive variance or
    of singular vectors, it is over an ordered field (realFieldType); two examples are over the rational numbers; the others are over any
    field. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum ssrint
  rat matrix mxalgebra.
From faultspace Require Import Vocabulary LimitsVocabulary.
From faultspace Require WholeRange ShortPast OneState AlmostEvery ColouredInputs Similarity LimitExamples.
From faultspace Require FollowingFault FollowingExamples.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** Noise *)

(** Noise w at the outputs is a fault (v, w) with F = 0 and G = 1 for w; it is uncorrelated with the inputs iff v and w are; O_s is the
    same. So theorems about faults that are uncorrelated with the inputs lose nothing. *)
Theorem noise_is_a_fault (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v w x y :
  let noisy := with_faults S (col_mx (sysF S) 0) (col_mx (sysG S) 1%:M) in
  [/\ process noisy B D u (fun k => row_mx (v k) (w k)) x y <-> (forall k, x k.+1 = x k *m sysA S + u k *m B + v k *m sysF S /\
        y k = x k *m sysC S + u k *m D + v k *m sysG S + w k),
      forall i k, cov Q (u i) (row_mx (v k) (w k)) = 0 <-> cov Q (u i) (v k) = 0 /\ cov Q (u i) (w k) = 0
    & forall s, O noisy s = O S s].
Proof. exact: LimitExamples.noise_is_a_fault. Qed.

(** ** proposition-1, all of the range *)

(** In this section u and v are uncorrelated at all times before t + s. *)

(** u autoregressive of order a, (A, B) controllable, and n + a past inputs: all of the range, where Uf excites. Neither stationarity nor
    observability is asked. What x(0) is made of is before the innovations e(a), e(a+1), ..., and so uncorrelated with them. *)
Theorem whole_range_autoregressive (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y t q s a (Au : nat -> 'M_nu) e L :
  process S B D u v x y -> (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) ->
  autoregressive Q a Au u e (t + s) -> (forall k, (a <= k < t + s)%N -> cov Q (e k) (x 0%N) = 0) ->
  (n + a <= q <= t)%N -> cov Q (future t s u) (future t s u) \in unitmx -> (forall z, steered S B z) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS.
Proof. move=> model uv ar later /andP[nq qt] unit; exact: (WholeRange.autoregressive_whole_range model qt uv ar later unit nq). Qed.

(** Of order at most s, all stationary, and n past inputs: all of the range. The process runs for n + a times before the present. *)
Theorem whole_range_autoregressive_stationary (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y t q s a (Au : nat -> 'M_nu) e L :
  Q^T = Q -> process S B D u v x y -> (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) ->
  autoregressive Q a Au u e (t + s) -> (forall k, (a <= k < t + s)%N -> cov Q (e k) (x 0%N) = 0) ->
  stationary Q u u (t + s) -> stationary Q u x (t + s) -> cov Q (future t s u) (future t s u) \in unitmx ->
  (0 < s)%N -> (a <= s)%N -> (n <= q <= t)%N -> (n + a <= t)%N -> (forall z, steered S B z) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS.
Proof.
move=> sym model uv ar later uu ux unit s0 short /andP[nq qt] past;
exact: (ShortPast.stationary_whole_range sym model uv ar later uu ux unit short nq qt past s0).
Qed.

(** There are such signals, with u of order 1 and the pole alpha. *)
Theorem autoregressive_signals_exist (K : fieldType) (alpha rho : K) H : rho ^+ 2 != 1 -> alpha * rho != 1 ->
  let S : system K 1 0 1 := System alpha%:M 0 1%:M 0 in exists (Q : 'M_H) (u e x y : nat -> 'cV_H),
  [/\ Q^T = Q, process S (1%:M : 'M_1) 0 u (fun=> 0) x y,
      autoregressive Q 1 (fun=> rho%:M) u e H /\ (forall k, (1 <= k < H)%N -> cov Q (e k) (x 0%N) = 0),
      stationary Q u u H /\ stationary Q u x H
    & forall t s, (t + s <= H)%N -> cov Q (future t s u) (future t s u) \in unitmx].
Proof. exact: ColouredInputs.first_order_signals. Qed.

(** Where (A, C) is observable on s samples, controllability is needed whatever the colour of u, if x(0) shares with the inputs only what
    came through B. *)
Theorem whole_range_controllable (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y t q s L :
  process S B D u v x y -> (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) ->
  (forall i j, (i < t + s)%N -> steered S B (row j (cov Q (u i) (x 0%N)))) -> (q <= t)%N -> row_free (O S s) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS -> forall z, steered S B z.
Proof. move=> model uv start qt; exact: (WholeRange.whole_range_needs_controllability model qt uv start). Qed.

(** One state, A stable, a past input, and u of any colour and uncorrelated with v: all of the range as soon as B is not zero. z is what
    the inputs have made of the state, stationary; the present is t + 1, and the inputs from t to t + s excite. *)
Theorem whole_range_one_state (K : realFieldType) N m p nu (Q : 'M[K]_N) (S : system K 1 m p) (B : 'M_(nu, 1)) (D : 'M_(nu, p))
    u v x z y t q s L : let H := (t.+1 + s)%N in
  Q^T = Q -> (forall g : 'cV_N, 0 <= cov Q g g 0 0) -> process S B D u v x y -> `|sysA S 0 0| < 1 ->
  (forall i k, (i < H)%N -> (k < H)%N -> cov Q (u i) (v k) = 0) ->
  (forall k, z k.+1 = z k *m sysA S + u k *m B) -> (forall i, (i < H)%N -> cov Q (u i) (x 0%N - z 0%N) = 0) ->
  stationary Q u u H -> stationary Q u z H -> stationary Q z z H -> (0 < s)%N ->
  cov Q (future t s.+1 u) (future t s.+1 u) \in unitmx -> B != 0 -> (0 < q <= t.+1)%N ->
  projected_limit Q (future (t.+1 - q) q u) (future t.+1 s u) (future t.+1 s y) L -> (L == O S s)%MS.
Proof.
move=> H sym pos model stable uv driven start uu uz zz s0 excites;
exact: (OneState.one_state_whole_range sym pos model stable uv driven start uu uz zz s0 excites).
Qed.

(** There are such signals for a coloured u, with t = s = 1: u(k) = e(k) + e(k-1)/2 and A = 1/2. *)
Theorem one_state_signals_exist : let S : system (field_of rat) 1 0 1 := System (1 / 2%:R)%:M 0 1%:M 0 in
  exists (Q : 'M[rat]_7) (u z : nat -> 'cV[rat]_7), [/\ Q^T = Q /\ (forall g : 'cV_7, 0 <= cov Q g g 0 0),
    process S (1%:M : 'M_1) 0 u (fun=> 0) z z /\ (forall k, z k.+1 = z k *m sysA S + u k *m 1%:M),
    [/\ stationary Q u u 3, stationary Q u z 3 & stationary Q z z 3], cov Q (future 1 2 u) (future 1 2 u) \in unitmx
  & cov Q (u 0%N) (u 1%N) != 0].
Proof. exists MovingAverage.Q; exact: ColouredInputs.moving_average_signals. Qed.

(** u of any colour, fixed, and x(0) uncorrelated with the inputs from t - q on, as it is where the memory of u is no longer than t - q.
    The limit has all of the range iff seen_state, a polynomial in A and B, has full rank, (A, C) being observable on s samples; on every
    line through such a point (A, B) all but at most n t points are such; and with at least one input, n past samples or more, and regular
    covariances of the s future inputs and of the q + s past and future ones together, there is such a point. *)
Theorem whole_range_seen (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y t q s L :
  process S B D u v x y -> (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) ->
  (forall i, (t - q <= i < t + s)%N -> cov Q (u i) (x 0%N) = 0) -> (q <= t)%N -> cov Q (future t s u) (future t s u) \in unitmx ->
  row_free (O S s) -> projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  (L == O S s)%MS = row_full (seen_state Q u t q s (sysA S) B).
Proof. move=> model uv start qt unit; exact: (AlmostEvery.whole_range_seen model uv start qt unit). Qed.
Theorem whole_range_almost_every (K : fieldType) N n nu (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) t q s (A A1 : 'M_n) (B B1 : 'M_(nu, n))
    (ts : seq K) : row_full (seen_state Q u t q s A B) -> uniq ts ->
  (forall c, c \in ts -> ~~ row_full (seen_state Q u t q s (A + c *: A1) (B + c *: B1))) -> (size ts <= n * t)%N.
Proof. exact: AlmostEvery.whole_range_almost_every. Qed.
Theorem whole_range_somewhere (K : fieldType) N n nu (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) t q s : (0 < nu)%N -> (n <= q)%N -> (q <= t)%N ->
  cov Q (future t s u) (future t s u) \in unitmx -> cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx ->
  exists (A : 'M[K]_n) (B : 'M[K]_(nu, n)), row_full (seen_state Q u t q s A B).
Proof. exact: AlmostEvery.whole_range_somewhere. Qed.

(** A nilpotent, A^q = 0, and (A, B) controllable: all of the range, for u of any colour that excites. *)
Theorem whole_range_nilpotent (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y t q s L :
  process S B D u v x y -> (forall i k, (i < t + s)%N -> (k < t + s)%N -> cov Q (u i) (v k) = 0) -> (q <= t)%N ->
  cov Q (future t s u) (future t s u) \in unitmx -> cov Q (future (t - q) (q + s) u) (future (t - q) (q + s) u) \in unitmx ->
  iter q (mulmxr (sysA S)) 1%:M = 0 -> (forall z, steered S B z) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS.
Proof. exact: AlmostEvery.whole_range_nilpotent. Qed.

(** ** proposition-1, white-a-c-seen: what "A and C are right" means *)

(** The range of O_s determines (A, C) up to the basis of the state, (A, C) observable on s - 1 samples. *)
Theorem range_determines_a_c (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) s :
  row_free (O S s.-1) -> (O S s == O S' s)%MS <-> similar S S'.
Proof. exact: Similarity.same_range_similar. Qed.

(** The limit is the range of O_s iff A is controllable from B seen; and then only, the A' and C' that have the limit as the range of their
    O_s are A and C up to the basis of the state. *)
Theorem white_a_c_up_to_basis (K : fieldType) N n m m' p nu (Q : 'M[K]_N) (S : system K n m p) (S' : system K n m' p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y H J Phi q t s L :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
  (n <= q)%N -> (J + q <= t)%N -> (t + s + J <= H)%N -> row_free (O S s.-1) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  ((L == O S s)%MS <-> forall z, steered S (seen_B S J Phi B) z) /\
  ((L == O S' s)%MS -> similar S S' <-> forall z, steered S (seen_B S J Phi B) z).
Proof. exact: Similarity.white_limit_similar. Qed.

(** ** proposition-1, white-b-d: all of the range, and B and D wrong *)

(** A = a, F = 1, B = b, C = [1 0], G = [0 1], D = 0, v(k) = u(k+1): output error gives a + b and [1 0], and any fit with the right B, or
    the right D, is worse at every k >= 1, for a, b and a + b other than 0. *)
Theorem white_b_d_wrong_a_c_right (K : realFieldType) (a b : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) :
  Q^T = Q -> white Q u H -> a != 0 -> b != 0 -> a + b != 0 -> let v k := u k.+1 in let B := b%:M in
  let S : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  [/\ forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov Q (u i) (v k) = 0, forall z, steered S B z, observable S,
      exists x y, process S B 0 u v x y /\ (forall i, (1 < i < H)%N -> cov Q (u i) (x 0%N) = 0)
    & forall x y, process S B 0 u v x y -> (forall i, (1 < i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
      (forall t q s L, (0 < q)%N -> (2 + q <= t)%N -> (t + s + 2 <= H)%N ->
        projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS) /\
      (forall t k B' D', (1 < t)%N -> (0 < k)%N -> (t + k + 2 < H)%N -> B' = B \/ D' = 0 ->
        mean_square Q S u y t k (a + b)%:M (row_mx 1%:M 0) < mean_square Q S u y t k B' D')].
Proof. exact: LimitExamples.whole_range_and_wrong_input. Qed.

(** ** proposition-1, coloured-a-c: u, v and x of proposition_1_coloured_a_c are stationary *)

(** All their covariances at the times 0..3, which are those that the limit is made of, depend on the difference of the times. *)
Theorem coloured_a_c_stationary : let Q := MovingAverage.Q in let u := MovingAverage.u in
  let v := MovingAverage.v in let x := MovingAverage.x in
  let z k := row_mx (row_mx (u k) (v k)) (x k) in
  forall i k, (i < 3)%N -> (k < 3)%N -> cov Q (z i.+1) (z k.+1) = cov Q (z i) (z k).
Proof. exact: LimitExamples.coloured_signals_stationary. Qed.

(** ** settle-1: v(k) = u(k-1) Phi, u white; w(k) stands for u(k-1) *)

(** With a past input, s >= 1, and all states shown by s - 1 samples and by k: not both, the limit in the range of O_s, and B, D among the
    best fits by output error. Unless the fault is never seen. *)
Theorem settle_1_not_both (K : realFieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    (Phi : 'M_(nu, m)) u w x y H t q s L t' k :
  process S B D u (fun k => w k *m Phi) x y -> (forall k, w k.+1 = u k) -> white Q u H -> Q^T = Q ->
  (forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0) ->
  (0 < q <= t)%N -> (t + s <= H)%N -> (0 < s)%N -> row_free (O S s.-1) -> (t' + k < H)%N -> row_free (O S k) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L <= O S s)%MS ->
  (forall B' D', mean_square Q S u y t' k B D <= mean_square Q S u y t' k B' D') -> Phi *m sysF S = 0 /\ Phi *m sysG S = 0.
Proof. exact: FollowingFault.not_both. Qed.

(** Nor where B and D are among the best fits by output error summed over several times, one of which observes (A, C). *)
Theorem settle_1_not_both_in_sum (K : realFieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    (Phi : 'M_(nu, m)) u w x y H t q s L t' ks k :
  process S B D u (fun k => w k *m Phi) x y -> (forall k, w k.+1 = u k) -> white Q u H -> Q^T = Q ->
  (forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0) ->
  (0 < q <= t)%N -> (t + s <= H)%N -> (0 < s)%N -> row_free (O S s.-1) ->
  (forall j, j \in ks -> (t' + j < H)%N) -> k \in ks -> row_free (O S k) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L <= O S s)%MS ->
  (forall B' D', \sum_(j <- ks) mean_square Q S u y t' j B D <= \sum_(j <- ks) mean_square Q S u y t' j B' D') ->
  Phi *m sysF S = 0 /\ Phi *m sysG S = 0.
Proof. exact: FollowingFault.not_both_in_sum. Qed.

(** biased: x(k+1) = a x(k) + u(k) + f v(k), y = x, for all a > 0 and f > 0. If singular vectors of L spanned the range of O_s, O_s L'L
    would lie in it. *)
Theorem settle_1_biased (K : realFieldType) (a f : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) : white Q u H -> 0 < a -> 0 < f ->
  let S : system K 1 1 1 := System a%:M f%:M 1%:M 0 in
  let follows w x y := [/\ process S (1%:M : 'M_1) 0 u w x y, forall k, w k.+1 = u k &
    forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0] in
  (exists w x y, follows w x y) /\ forall w x y t q s L, follows w x y -> (0 < q <= t)%N -> (1 < s)%N -> (t + s <= H)%N ->
    projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> ~ (O S s *m (L^T *m L) <= O S s)%MS.
Proof. exact: FollowingExamples.follows_biased. Qed.

(** not of every system: a f = -(1 + a^2), two samples and three past inputs or more. The leading singular vector of L, of eigenvalue
    lambda, spans the range of O_2, mu is that of the other; and the regression gives B = 1 and D = 0 alone. *)
Theorem settle_1_all_right (K : realFieldType) (a f : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) :
  white Q u H -> a != 0 -> a * f = - (1 + a ^+ 2) -> let S : system K 1 1 1 := System a%:M f%:M 1%:M 0 in
  let follows w x y := [/\ process S (1%:M : 'M_1) 0 u w x y, forall k, w k.+1 = u k &
    forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0] in
  (exists w x y, follows w x y) /\ forall w x y t, follows w x y -> (t + 2 <= H)%N ->
    (forall q L, (2 < q <= t)%N -> projected_limit Q (future (t - q) q u) (future t 2 u) (future t 2 y) L ->
      exists (h : 'rV_(2 * 1)) lambda mu, [/\ O S 2 *m (L^T *m L) = lambda *: O S 2, h *m (L^T *m L) = mu *: h,
        O S 2 *m h^T = 0, 0 < mu < lambda & h != 0]) /\
    (forall W B' D', let Uf := future t 2 u in W *m cov Q Uf Uf = 1%:M ->
      (W *m cov Q Uf (future t 2 y) - T (with_faults S B' D') 2) *m cokermx (O S 2) = 0 <-> B' = 1%:M /\ D' = 0).
Proof. exact: FollowingExamples.follows_all_right. Qed.
