(** The first of the theorems that the ledger of claims names, in its order, each for any field K and any dimensions unless it says
    otherwise. To read them takes Vocabulary.v, which tells every word that they use; this file and those that it includes define none. *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary.
From faultspace Require HeadlinesMore HeadlinesLimits HeadlinesStructure HeadlinesChecks HeadlinesFields HeadlinesExperiments.
From faultspace Require HeadlinesMeans HeadlinesSpectra.
From faultspace Require Windows Infinite WindowBlocks Existence ConsistencyExamples OneSided Consistency.
From faultspace Require Regression Controllable Leads OutputError Autoregressive Undetectable SmallSystems.
From faultspace Require SharpWindows Theorem1Sharp Readings Lag WeakExcitation Proposition3.
From faultspace Require NormalRank TransferRank Problem11 SettledSolutions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** What the words say *)

(** The words of length s are the row space of [O_s T_s], and a signal is possible for ever once each of its beginnings is. *)
Theorem words_are_ranks (K : fieldType) n m p (S : system K n m p) s r : (samples s r <= window S s)%MS <-> word S s r.
Proof. exact: Windows.windowP. Qed.
Theorem behaviors_are_words (K : fieldType) n m p (S : system K n m p) r : behavior S r <-> forall s, word S s r.
Proof. exact: Infinite.behaviorP. Qed.

(** The blocks of O_s and T_s: A^k C; G on the diagonal, F A^(k-i-1) C beside it, and zero for a fault at i > k. *)
Theorem blocks_of_window (K : fieldType) n m p (S : system K n m p) s (i k : 'I_s) : let power j := iter j (mulmx (sysA S)) (sysC S) in
  \matrix_(a, b) O S s a (mxvec_index k b) = power k /\
  \matrix_(a, b) T S s (mxvec_index i a) (mxvec_index k b) =
    if (i < k)%N then sysF S *m power (k - i.+1)%N else if i == k then sysG S else 0.
Proof. exact: WindowBlocks.window_blocks. Qed.

(** The greatest common divisors of the minors and the zeros at infinity, where the system is left-invertible, the minimal bases and, for a
    white input, the limits that statements below speak of are there. *)
Theorem zeros_exist (K : fieldType) n m p (S : system K n m p) :
  [/\ left_invertible S -> exists g d, gcd_of_minors (pencil S) g /\ infinite_zeros S d,
      exists g d, gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g /\ system_infinite_zeros S d,
      exists c (X : 'M_(n + p, c)), minimal_basis (pencil S) X & exists k (Y : 'M_(n + m, k)), minimal_basis (pencil S)^T Y].
Proof. exact: Existence.zeros_exist. Qed.
Theorem projected_limits_exist (K : fieldType) N nu p (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) (y : nat -> 'M_(N, p)) H t s z (Z : 'M_(N, z)) :
  white Q u H -> (t + s <= H)%N -> exists L, projected_limit Q Z (future t s u) (future t s y) L.
Proof. exact: Existence.limit_exists. Qed.

(** ** assumption-2 *)

(** White inputs exist, so that the following are not empty. *)
Theorem white_inputs_exist (K : fieldType) nu H : exists u : nat -> 'M[K]_(H * nu, nu), white 1%:M u H.
Proof. exact: ConsistencyExamples.white_exists. Qed.

(** The estimator of B and D that is refuted is the one of output error: the model from rest whose outputs fit best in the mean square.
    one-sided, refuted: with A = a, F = 1, C = [1 0], G = [0 1], B = -a, D = 0 and v(k) = u(k+1), for a other than 0 any fit with the right
    B, or the right D, is worse at every k >= 1 than another one, B' = 0 and D' = [1 0]. *)
Theorem assumption_2_one_sided (K : realFieldType) (a : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) :
  Q^T = Q -> white Q u H -> a != 0 ->
  let v k := u k.+1 in let y k := row_mx (u k) (u k.+1) in let B := (- a)%:M in
  let S : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  [/\ process S B 0 u v u y, forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov Q (u i) (v k) = 0,
      fault_controllable (with_faults S B 0), observable S
    & forall t k B' D', (1 < t)%N -> (0 < k)%N -> (t + k + 2 < H)%N -> B' = B \/ D' = 0 ->
      mean_square Q S u y t k 0 (row_mx 1%:M 0) < mean_square Q S u y t k B' D'].
Proof. exact: OneSided.one_sided_moves_B_and_D. Qed.
Theorem assumption_2_one_sided_windows (K : realFieldType) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) t s :
  white Q u H -> (1 < s)%N -> (t + s < H)%N -> cov Q (future t s u) (future t s (fun k => u k.+1)) <> 0.
Proof. move=> u_white; exact: (OneSided.one_sided_windows_correlated u_white). Qed.

(** without-lag-zero, refuted: the same system with B = -1 and v = u. *)
Theorem assumption_2_without_lag_zero (K : realFieldType) (a : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) :
  Q^T = Q -> white Q u H ->
  let B : 'M[K]_1 := - 1%:M in let y k := row_mx 0 (u k) in
  let S : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  [/\ process S B 0 u u (fun=> 0) y, forall i k, i != k -> (i < H)%N -> (k < H)%N -> cov Q (u i) (u k) = 0,
      fault_controllable (with_faults S B 0), observable S
    & forall t k B' D', (0 < t)%N -> (0 < k)%N -> (t + k + 1 < H)%N -> B' = B \/ D' = 0 ->
      mean_square Q S u y t k 0 (row_mx 0 1%:M) < mean_square Q S u y t k B' D'].
Proof. exact: OneSided.same_time_moves_B_and_D. Qed.

(** two-sided; what the proof of proposition-1 wants is proposition_1_two_sided. *)
Theorem assumption_2_two_sided (K : fieldType) N nu m (Q : 'M[K]_N) t s (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) :
  (forall i k, (t <= i < t + s)%N -> (t <= k < t + s)%N -> cov Q (u i) (v k) = 0) -> cov Q (future t s u) (future t s v) = 0.
Proof. exact: Consistency.uncorrelated_futures. Qed.

(** ** proposition-1 *)

(** white-a-c, refuted: the limit is zero. *)
Theorem proposition_1_white_a_c (K : fieldType) (a : K) N H (Q : 'M[K]_N) (u : nat -> 'cV[K]_N) : white Q u H ->
  let v k := u k.+1 in let y k := row_mx (u k) (u k.+1) in let B := (- a)%:M in
  let S : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  [/\ process S B 0 u v u y, forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov Q (u i) (v k) = 0, a != 0 -> row_full B,
      forall s, row_free (O S s.+1) &
      forall t q s L, (q <= t)%N -> (t + s < H)%N ->
        projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> L = 0].
Proof. exact: ConsistencyExamples.zero_limit. Qed.

(** white-b-d, refuted for the fit of output error by white_b_d_wrong_a_c_right (HeadlinesLimits.v), where the limit has all of the range of
    O_s. In assumption_2_one_sided, where B and D are wrong as well, that limit is zero. *)

(** coloured-a-c, refuted: u = e(k) + e(k-1)/2, v = e(k+1), A = 1/2, B = F = 1, C = [1 0], G = [0 1], written out at the times 0..3 that
    the limit is made of (ConsistencyExamples.v): it exists and is not in the range of O_2. *)
Theorem proposition_1_coloured_a_c : let S := MovingAverage.S in let Q := MovingAverage.Q in
  let u := MovingAverage.u in let v := MovingAverage.v in
  let x := MovingAverage.x in let y := MovingAverage.y in
  [/\ process S 1%:M 0 u v x y, forall i k, (i <= k < 4)%N -> cov Q (u i) (v k) = 0,
      fault_controllable (with_faults S 1%:M 0), observable S &
    (exists L, projected_limit Q (future 0 2 u) (future 2 2 u) (future 2 2 y) L) /\
    forall L, projected_limit Q (future 0 2 u) (future 2 2 u) (future 2 2 y) L -> ~ (L <= O S 2)%MS].
Proof. exact: OneSided.coloured_limit_outside. Qed.

(** two-sided: the limit lies in the range of O_s, and the regression gives B and D. For which inputs and systems the limit has all of the
    range is what the theorems whole_range_... of HeadlinesLimits.v say. For some coloured inputs it has less. *)
Theorem proposition_1_two_sided (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    u v x y t q s L :
  process S B D u v x y -> (q <= t)%N -> (forall i k, (t - q <= i < t + s)%N -> (t <= k < t + s)%N -> cov Q (u i) (v k) = 0) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  exists M, projected_limit Q (future (t - q) q u) (future t s u) (x t) M /\ L = M *m O S s.
Proof. move=> model; exact: (Consistency.two_sided_past_inputs model). Qed.
Theorem proposition_1_two_sided_b_d (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B B' : 'M_(nu, n)) (D D' : 'M_(nu, p))
    u v x y t s W : let Uf := future t s u in process S B D u v x y -> (0 < s)%N -> row_free (O S s.-1) ->
  W *m cov Q Uf Uf = 1%:M -> cov Q Uf (future t s v) = 0 ->
  (W *m cov Q Uf (future t s y) - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D.
Proof. move=> Uf model; exact: (Regression.two_sided_regression model). Qed.

(** white-a-c-seen. Observable on the s samples of the window: the statement is about the range of all of O_s. *)
Theorem proposition_1_white_a_c_seen (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y
    H J Phi q t s L :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
  (n <= q)%N -> (J + q <= t)%N -> (t + s + J <= H)%N -> row_free (O S s) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  (L == O S s)%MS <-> (forall z, exists k w, state (with_faults S (seen_B S J Phi B) (0 : 'M_(nu, p))) 0 w k = z).
Proof. exact: Controllable.white_limit_controllable. Qed.

(** white-b-d-seen *)
Theorem proposition_1_white_b_d_seen (K : realFieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p)
    (B B' : 'M_(nu, n)) (D D' : 'M_(nu, p)) u v x y H J Phi t k :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
  Q^T = Q -> (J <= t)%N -> (t + k + J < H)%N -> let Bs := seen_B S J Phi B in let Ds := seen_D S J Phi D in
  mean_square Q S u y t k Bs Ds <= mean_square Q S u y t k B' D' /\
  (row_free (O S k) -> mean_square Q S u y t k B' D' = mean_square Q S u y t k Bs Ds -> B' = Bs /\ D' = Ds).
Proof. move=> model white leads past; exact: (OutputError.least_squares model white leads past). Qed.

(** parametric, over any field *)
Theorem proposition_1_parametric (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y
    H J Phi q t s L :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
  (J + q <= t)%N -> (t + s + J <= H)%N -> projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  L = (\sum_(j < q) (place K nu j)^T *m times_power S (seen_B S J Phi B) (q.-1 - j)) *m O S s.
Proof. move=> model white leads past; exact: (Leads.white_limit model white leads past). Qed.

(** autoregressive *)
Theorem proposition_1_autoregressive (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y
    t s z (Z : 'M_(N, z)) a (A : nat -> 'M[K]_nu) e J (Phi : nat -> 'M_(nu, m)) L :
  process S B D u v x y -> (a <= s)%N -> (forall k, (t + s <= k)%N -> u k = \sum_(i < a) u (k - i.+1)%N *m A i + e k) ->
  (forall k, (t + s <= k)%N -> cov Q Z (e k) = 0 /\ cov Q (future t s u) (e k) = 0) ->
  (forall k, v k = \sum_(j < J) u (k + j)%N *m Phi j) -> projected_limit Q Z (future t s u) (future t s y) L ->
  exists M, projected_limit Q Z (future t s u) (x t) M /\ L = M *m O S s.
Proof. move=> model; exact: (Autoregressive.autoregressive_limit model). Qed.

(** lead-one *)
Theorem proposition_1_lead_one (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    (Phi : 'M_(nu, m)) u x y t s z (Z : 'M_(N, z)) L :
  sysG S = 0 -> process S B D u (fun k => u k.+1 *m Phi) x y -> projected_limit Q Z (future t s u) (future t s y) L ->
  exists M, projected_limit Q Z (future t s u) (x t - u t *m Phi *m sysF S) M /\ L = M *m O S s.
Proof. exact: Undetectable.next_fault_limit. Qed.

(** ** theorem-1 *)

(** n-samples and n-samples-same-a-c, refuted by one pair, for every n >= 1 *)
Theorem theorem_1_n_samples (K : fieldType) (c c' : K) n : c != 0 -> c' != 0 -> c != c' ->
  exists (S : system K n.+1 1 2) F, let S' := with_faults S F (sysG S) in
  [/\ observable S /\ observable S', fault_controllable S /\ fault_controllable S', inverts_at_once S /\ inverts_at_once S',
      same_words S S' n.+1 & exists r, word S n.+2 r /\ ~ word S' n.+2 r].
Proof. exact: SmallSystems.equal_on_n_samples_only. Qed.

(** n-plus-1-samples *)
Theorem theorem_1 (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) :
  same_words S S' (maxn n n').+1 <-> same_behavior S S'.
Proof. exact: SharpWindows.theorem_1. Qed.

(** lag-plus-1 *)
Theorem theorem_1_lag (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) N : (lag S <= N)%N -> (lag S' <= N)%N ->
  same_words S S' N.+1 <-> same_behavior S S'.
Proof. exact: SharpWindows.theorem_1_sharp. Qed.

(** either-lag *)
Theorem theorem_1_either_lag (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) N :
  \rank (transfer S) = \rank (transfer S') -> (lag S <= N)%N ->
  same_words S S' N.+1 <-> same_behavior S S'.
Proof. exact: Readings.equal_on_lag_plus_1_of_either. Qed.

(** sharp, for every n >= 1 and every field *)
Theorem theorem_1_sharp (K : fieldType) n : (0 < n)%N -> exists (S : system K n 1 2) F, let S' := with_faults S F (sysG S) in
  [/\ left_invertible S, left_invertible S', same_words S S' n & exists r, word S' n.+1 r /\ ~ word S n.+1 r].
Proof. exact: Theorem1Sharp.n_samples_are_not_enough. Qed.

(** parametric, over any field *)
Theorem theorem_1_inclusion (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) N : (n <= N)%N ->
  (forall r, word S' N.+1 r -> word S N.+1 r) <-> (forall s r, word S' s r -> word S s r).
Proof. exact: SharpWindows.inclusion_on_n_plus_1_samples. Qed.

(** ** theorem-2 *)

(** finite-zeros-only, refuted by x(k+1) = v(k), r = x *)
Theorem theorem_2_finite_zeros_only (K : fieldType) : exists S : system K 1 1 1,
  [/\ observable S, fault_controllable S, left_invertible S & exists2 g, gcd_of_minors (pencil S) g &
    forall s, (1 <= s)%N -> (\rank (window S s) + (size g).-1)%N <> (1 + s * 1)%N].
Proof. exact: Readings.finite_zeros_are_not_all. Qed.

(** every-window, refuted at s = n - 1, for every n; for n >= 2 this window is not empty. And what is needed below. *)
Theorem window_n_minus_1 (K : fieldType) n : exists S : system K n.+1 1 2, [/\ observable S, fault_controllable S, inverts_at_once S,
  \rank (window S n.+1) = (\rank (window S n) + 2)%N & (\rank (window S n) + zeta S)%N <> (n.+1 + n * 1)%N].
Proof. exact: SmallSystems.window_n_minus_1. Qed.

(** pencil-zeros, hence pencil-zeros-minimal and parametric *)
Theorem theorem_2 (K : fieldType) n m p (S : system K n m p) g d s :
  left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d ->
  (\rank (window S s) + ((size g).-1 + d) = n + s * m)%N <-> (lag S <= s)%N.
Proof. move=> inv finite infinite; exact: (Readings.window_rank_by_zeros inv finite infinite). Qed.
Theorem lag_at_most_n (K : fieldType) n m p (S : system K n m p) : (lag S <= n)%N.
Proof. exact: Lag.lag_le_n. Qed.

(** ** assumption-4 *)

(** n-minus-1-known and n-minus-1-unknown, refuted by window_n_minus_1. n-known, n-unknown: proposition_3, where no delay is asked for. lag:
    proposition_3_lag. *)

(** excitation-at-s, refuted: n = s = 1 and v = 1, 0, 1, 0, ..., with N + 2 rows, or any other number for s + 1 *)
Theorem assumption_4_excitation_at_s (K : fieldType) N N' :
  let S : system K 1 1 (1 + 1) := System 0 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  let v k : 'rV[K]_1 := (~~ odd k)%:R%:M in let r := output S 0 v in
  [/\ observable S, inverts_at_once S, row_full (excitation S 0 v N.+2 1) & \rank (hankel N' 2 r) <> (\rank (hankel N.+2 1 r) + 1)%N].
Proof. exact: Readings.excitation_at_s. Qed.

(** excitation-at-s-plus-1 *)
Theorem assumption_4_excitation_at_s_plus_1 (K : fieldType) n m p (S : system K n m p) x v N N' s :
  left_invertible S -> (lag S <= s)%N -> (N' <= N)%N -> row_full (excitation S x v N' s.+1) ->
  \rank (hankel N' s.+1 (output S x v)) = (\rank (hankel N s (output S x v)) + m)%N.
Proof. exact: Readings.gap_on_data. Qed.

(** excitation-necessary, refuted for every s >= 1 = n *)
Theorem assumption_4_excitation_necessary (K : fieldType) s : (1 <= s)%N -> exists (S : system K 1 1 (1 + 1)) x v N,
  [/\ observable S, inverts_at_once S, forall N', ~ row_full (excitation S x v N' s.+1)
    & \rank (hankel N s.+1 (output S x v)) = (\rank (hankel N.+1 s (output S x v)) + 1)%N].
Proof. exact: Readings.excitation_is_not_necessary. Qed.

(** persistency-suffices *)
Theorem assumption_4_persistency_suffices (K : fieldType) n m p (S : system K n m p) x v M s :
  persistently_exciting M (n + s.+1) v -> left_invertible S -> (lag S <= s)%N ->
  \rank (hankel (n + M) s.+1 (output S x v)) = (\rank (hankel (n + M).+1 s (output S x v)) + m)%N.
Proof. exact: WeakExcitation.persistency_gap_from_lag. Qed.

(** ** proposition-3 *)

(** as-printed, refuted by window_n_minus_1. without-left-invertibility, refuted by proposition_3, and by x(k+1) = 0, r = x: *)
Theorem proposition_3_without_left_invertibility (K : fieldType) : exists S : system K 1 1 1,
  observable S /\ forall s, (1 <= s)%N -> \rank (window S s.+1) <> (\rank (window S s) + 1)%N.
Proof. exact: SmallSystems.gap_needs_left_invertibility. Qed.

(** n-alone; any one s >= n tells whether the system is left-invertible *)
Theorem proposition_3 (K : fieldType) n m p (S : system K n m p) s :
  (n <= s)%N -> \rank (window S s.+1) = (\rank (window S s) + m)%N <-> left_invertible S.
Proof. exact: Proposition3.proposition_3. Qed.

(** lag-exactly; where p = m the lag is 0 *)
Theorem proposition_3_lag (K : fieldType) n m p (S : system K n m p) s :
  left_invertible S -> \rank (window S s.+1) = (\rank (window S s) + m)%N <-> (lag S <= s)%N.
Proof. exact: SharpWindows.proposition_3_sharp. Qed.
Theorem lag_of_square_system (K : fieldType) n m p (S : system K n m p) : \rank (transfer S) = p -> lag S = 0%N.
Proof. exact: Readings.lag_full_rank. Qed.

(** normal-rank, and parametric: the normal rank is the rank of the transfer matrix, and that of the pencil less n *)
Theorem proposition_3_normal_rank (K : fieldType) n m p (S : system K n m p) s :
  (n <= s)%N -> \rank (window S s.+1) = (\rank (window S s) + \rank (transfer S))%N.
Proof. exact: NormalRank.window_growth_normal_rank. Qed.
Theorem normal_rank_of_pencil (K : fieldType) n m p (S : system K n m p) : \rank (over_fractions (pencil S)) = (n + \rank (transfer S))%N.
Proof. exact: TransferRank.pencil_rank_transfer. Qed.

(** ** problem-11 *)

(** window-n, refuted at s = n = 1 *)
Theorem problem_11_window_n (K : fieldType) :
  let S : system K 1 1 (1 + 1) := System 0 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in
  [/\ observable S, fault_controllable S, inverts_at_once S, forall f g, solves S 1 f g & exists (f : 'rV_1) (g : 'rV_(1 + 1)),
    left_invertible (with_faults S f g) /\ ~ (forall r, behavior (with_faults S f g) r -> behavior S r)].
Proof. exact: SmallSystems.window_n_accepts_wrong_pair. Qed.

(** first-block-column, refuted by z = (0; 1, 0): the response to a fault at time 0 is possible for ever *)
Theorem problem_11_first_block_column (K : fieldType) :
  let S : system K 1 1 (1 + 1) := System 0 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M) in let z := with_faults S (0 : 'rV_1) (row_mx 1%:M 0) in
  [/\ observable S, inverts_at_once S, lag S = 1%N,
      behavior S (output z 0 (fun k => if k == 0%N then 1%:M else 0)) & ~ solves S (lag S).+1 0 (row_mx 1%:M 0)].
Proof. exact: SmallSystems.first_block_column_at_lag_plus_1. Qed.

(** window-n-plus-1: so the solutions are the same for all these s *)
Theorem problem_11 (K : fieldType) n m p (S : system K n m p) s f g :
  (n < s)%N -> solves S s f g <-> (forall r, behavior (with_faults S f g) r -> behavior S r).
Proof. exact: Problem11.problem_11. Qed.

(** lag-plus-1 *)
Theorem problem_11_lag (K : fieldType) n m p (S : system K n m p) s :
  (forall f g, solves S s.+1 f g <-> (forall r, behavior (with_faults S f g) r -> behavior S r)) <-> (lag S <= s)%N.
Proof. exact: SettledSolutions.solutions_settle_at_lag. Qed.
Theorem problem_11_full_rank (K : fieldType) n m p (S : system K n m p) s f g : \rank (transfer S) = p -> solves S s f g.
Proof. exact: Readings.all_columns_solve_full_rank. Qed.

(** dimension, reached at s + 1 = lag + 1 samples and, of the windows of at least one sample, not before *)
Theorem problem_11_dimension (K : fieldType) n m p (S : system K n m p) g d s k (Z : 'M_(k, n + p)) :
  left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d -> spans_solutions S s.+1 Z ->
  \rank Z = (m + ((size g).-1 + d))%N <-> (lag S <= s)%N.
Proof. move=> inv finite infinite; exact: (Readings.solution_dimension_by_zeros inv finite infinite). Qed.

(** More of the ledger is in HeadlinesMore.v, more about limits in HeadlinesLimits.v, more about structure in HeadlinesStructure.v, the
    checks of certificates are in HeadlinesChecks.v, over other fields in HeadlinesFields.v, of limits in
    HeadlinesExperiments.v, consistency as means of signals in HeadlinesMeans.v, for inputs of rational spectrum in
    HeadlinesSpectra.v; from here on all are in Headlines. *)
Include HeadlinesMore.
Include HeadlinesLimits.
Include HeadlinesStructure.
Include HeadlinesChecks.
Include HeadlinesFields.
Include HeadlinesExperiments.
Include HeadlinesMeans.
Include HeadlinesSpectra.
