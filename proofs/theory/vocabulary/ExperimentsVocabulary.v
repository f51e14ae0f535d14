(** What the headlines on certificates of stability and of limits (HeadlinesExperiments.v) speak of, beside the words of Vocabulary.v and of
    the first two parts of NumbersVocabulary.v. To know what is claimed it takes the first part alone; the checks are functions to true or
    false, of which nobody needs to believe anything.

                                                 schur_stable A == every eigenvalue of A lies inside the unit circle
              experiment, driving, input_of, fault_of, noise_of == a system with a filter of white noise, and what that makes
                          follow, output_of, stationary_process == how its states go on, its outputs, and a process of it
                                            stable_experiment E == where there is no noise, everything dies out
            squares, regression_rest, model_states, model_error == the two regressions for B and D
                                 experiment_list, experiment_of == an experiment by its tables, and what they mean
                   num, positive_in, integer_in, row_polynomial == numbers, integers among them, and x f(M)
                                       inside_circle, is_stable == the recursion of Schur and Cohn, and the check of stability
                table, basic, plus_tables, minus_table, columns == signals by their coefficients
                                   beside, windowed, transposed == side by side, as windows, transposed
                                       weighted_by, covariances == their covariances
                           driving_table, next_states, channels == what an experiment does in one step
              recorded_channels, joint_states, sized_experiment == what it does in several; tables of the sizes told
                                                shown, is_limit == the check of the limit of identification
    with_inputs, unit_table, orthogonal_to_units, is_regression == the check of MOESP's regression
                                     errors_of, is_output_error == the check of output error *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg ssrnum matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary NumbersVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** Stability, and the process of an experiment *)

(** Every eigenvalue of A lies inside the unit circle. C has the roots of all polynomials and a norm, as the complex numbers have. *)
Definition schur_stable (C : numClosedFieldType) n (A : 'M[C]_n) := forall (z : C) (x : 'rV_n), x != 0 -> x *m A = z *: x -> `|z| < 1.

(** An experiment: a system with the inputs u, B and D, and a filter of the memory l that makes f = (u, v, w) of white noise e with c
    entries, v being the fault and w the noise of the outputs. *)
Record experiment (K : fieldType) n m p nu c := Experiment { plant : system K n m p; inputB : 'M[K]_(nu, n); inputD : 'M[K]_(nu, p);
  memory : nat; forward : nat -> 'M[K]_(c, nu + (m + p)); back : nat -> 'M[K]_(nu + (m + p)) }.

Section Process.
Variables (K : fieldType) (n m p nu c : nat) (E : experiment K n m p nu c) (N : nat).
Notation signal q := ('M[K]_(N, q)).

(** The states of an experiment are x and s_0, ..., s_(l-1), with s_l = 0. Now f = s_0 + e N_0, and at the next time
    x' = x A + u B + v F and s_i' = s_(i+1) + e N_(i+1) - f d_(i+1). So f(k) = sum_j e(k-j) N_j - sum_j f(k-j) d_j. Here N_j is `forward j`
    and d_(i+1) is `back i`. *)
Definition driving (e : signal c) (s : nat -> signal (nu + (m + p))) := s 0%N + e *m forward E 0.
Definition input_of (f : signal (nu + (m + p))) : signal nu := lsubmx f.
Definition fault_of (f : signal (nu + (m + p))) : signal m := lsubmx (rsubmx f).
Definition noise_of (f : signal (nu + (m + p))) : signal p := rsubmx (rsubmx f).
Definition follow (e : signal c) (x : signal n) (s : nat -> signal (nu + (m + p))) (x' : signal n) (s' : nat -> signal (nu + (m + p))) :=
  let f := driving e s in [/\ s (memory E) = 0, x' = x *m sysA (plant E) + input_of f *m inputB E + fault_of f *m sysF (plant E) &
    forall i, (i < memory E)%N -> s' i = s i.+1 + e *m forward E i.+1 - f *m back E i].
Definition output_of (e : signal c) (x : signal n) (s : nat -> signal (nu + (m + p))) : signal p :=
  let f := driving e s in x *m sysC (plant E) + input_of f *m inputD E + fault_of f *m sysG (plant E) + noise_of f.

(** A process on the times 0, ..., H - 1: e is white there and knows nothing of the states at time 0, and the covariances of the states are
    at time 1 what they are at time 0. *)
Definition stationary_process (Q : 'M[K]_N) (H : nat) (e : nat -> signal c) (x : nat -> signal n)
    (s : nat -> nat -> signal (nu + (m + p))) (u : nat -> signal nu) (y : nat -> signal p) :=
  [/\ Q^T = Q, white Q e H, forall k, follow (e k) (x k) (s k) (x k.+1) (s k.+1),
    forall k, u k = input_of (driving (e k) (s k)) /\ y k = output_of (e k) (x k) (s k)
    & [/\ forall k, (k < H)%N -> cov Q (x 0%N) (e k) = 0 /\ forall i, (i < memory E)%N -> cov Q (s 0%N i) (e k) = 0,
      cov Q (x 1%N) (x 1%N) = cov Q (x 0%N) (x 0%N),
      forall i, (i < memory E)%N -> cov Q (x 1%N) (s 1%N i) = cov Q (x 0%N) (s 0%N i)
      & forall i j, (i < memory E)%N -> (j < memory E)%N -> cov Q (s 1%N i) (s 1%N j) = cov Q (s 0%N i) (s 0%N j)]].
End Process.

(** The experiment is stable: where without noise the states are z times what they were, not all zero, z lies inside the unit circle. So are
    the eigenvalues of A, and the roots of the denominators of the filter, as far as they are poles of it. *)
Definition stable_experiment (C : numClosedFieldType) n m p nu c (E : experiment C n m p nu c) :=
  forall (z : C) (x : 'rV_n) (s : nat -> 'rV_(nu + (m + p))), follow E 0 x s (z *: x) (fun i => z *: s i) ->
  x != 0 \/ (exists2 i, (i < memory E)%N & s i != 0) -> `|z| < 1.

(** The two regressions for B and D with the true A and C. That of MOESP: of R, the response to the future inputs, T_s(B, D) and states X
    leave this rest. Output error: the states z that a model (A, B) has under the inputs, in a process that has gone on as long as that of
    the experiment, and the error of what it predicts. *)
Definition squares (K : fieldType) a b (M : 'M[K]_(a, b)) := \tr (M^T *m M).
Definition regression_rest (K : fieldType) n m p nu (S : system K n m p) s (R : 'M[K]_(s * nu, s * p)) (B : 'M_(nu, n)) (D : 'M_(nu, p))
  (X : 'M_(s * nu, n)) := R - T (with_faults S B D) s - X *m O S s.
Section OutputError.
Variables (K : fieldType) (n m p nu c : nat) (E : experiment K n m p nu c) (N : nat) (Q : 'M[K]_N) (e : nat -> 'M[K]_(N, c))
  (x : nat -> 'M[K]_(N, n)) (s : nat -> nat -> 'M[K]_(N, nu + (m + p))) (u : nat -> 'M[K]_(N, nu)) (y : nat -> 'M[K]_(N, p)).
Definition model_states (B : 'M_(nu, n)) (z : nat -> 'M[K]_(N, n)) := [/\ forall k, z k.+1 = z k *m sysA (plant E) + u k *m B,
  cov Q (z 0%N) (e 0%N) = 0, cov Q (z 1%N) (x 1%N) = cov Q (z 0%N) (x 0%N)
  & forall i, (i < memory E)%N -> cov Q (z 1%N) (s 1%N i) = cov Q (z 0%N) (s 0%N i)].
Definition model_error (D : 'M_(nu, p)) (z : nat -> 'M[K]_(N, n)) k := y k - (z k *m sysC (plant E) + u k *m D).
End OutputError.

(** The tables of an experiment, and what they mean; numbers of one field in another one. *)
Record experiment_list (R : arithmetic) := ExperimentList { tplant : listing R; tB : seq (seq (numeral R)); tD : seq (seq (numeral R));
  tforward : seq (seq (seq (numeral R))); tback : seq (seq (seq (numeral R))) }.
Definition experiment_of (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p nu c (E : experiment_list R) :=
  @Experiment K n m p nu c (system_of value n m p (tplant E)) (matrix_of value nu n (tB E)) (matrix_of value nu p (tD E))
    (size (tback E)) (fun j => matrix_of value c (nu + (m + p)) (nth [::] (tforward E) j))
    (fun i => matrix_of value (nu + (m + p)) (nu + (m + p)) (nth [::] (tback E) i)).

(** ** The checks: stability *)

(** The recursion of Schur and Cohn for a polynomial with integer coefficients, descending, of degree k: f becomes (a f - b f* ) / q over
    the greatest common divisor of its coefficients, where a is the first coefficient of f, b the last, and f* is f reversed. *)
Fixpoint inside_circle (k : nat) (f : seq Z) : bool :=
  if k is k'.+1 then if f is a :: r then
    let b := last a r in let g := [seq Z.sub (Z.mul a c.1) (Z.mul b c.2) | c <- zip (belast a r) (rev r)] in
    let d := foldr Z.gcd Z0 g in let h := [seq Z.div c d | c <- g] in
    [&& ~~ nilp r, Z.ltb (Z.abs b) (Z.abs a), d != Z0, [seq Z.mul d c | c <- h] == g & inside_circle k' h]
  else false else if f is [:: a] then a != Z0 else false.

Section StabilityChecks.
Variable R : arithmetic.
Notation num := (numeral R).

(** Integers among the numbers; x f(M) by Horner's rule. *)
Fixpoint positive_in (a : positive) : num := match a with xH => one R | xO b => let y := positive_in b in plus y y
  | xI b => let y := positive_in b in plus (plus y y) (one R) end.
Definition integer_in (a : Z) : num :=
  match a with Z0 => zero R | Zpos b => positive_in b | Zneg b => minus (zero R) (positive_in b) end.
Definition row_polynomial (f : seq Z) (M : seq (seq num)) (x : seq num) : seq num :=
  foldl (fun y c => sum (row_times y M) (multiple (integer_in c) x)) [::] f.

(** f vanishes at M, and all its roots lie inside the unit circle. *)
Definition is_stable n (M : seq (seq num)) (f : seq Z) : bool :=
  [&& (size M <= n)%N, inside_circle (size f).-1 f & all (fun i => blank (row_polynomial f M (unit_row R n i))) (iota 0 n)].
End StabilityChecks.

(** ** The checks: limits *)

Section LimitChecks.
Variable R : arithmetic.
Notation table := (seq (seq (numeral R))).

(** Signals by their coefficients at b basic ones, a row each: the basic ones from place o on; sums, negatives, columns; tables side by
    side, windows of samples; the transpose. *)
Definition basic b o q : table := mkseq (fun i => mkseq (fun j => if i == (o + j)%N then one R else zero R) q) b.
Definition plus_tables b (T T' : table) : table := mkseq (fun i => sum (nth [::] T i) (nth [::] T' i)) b.
Definition minus_table (T : table) : table := [seq multiple (minus (zero R) (one R)) r | r <- T].
Definition columns o q (T : table) : table := [seq mkseq (fun j => at_place r (o + j)) q | r <- T].
Definition beside b a (T T' : table) : table := mkseq (fun i => mkseq (at_place (nth [::] T i)) a ++ nth [::] T' i) b.
Definition windowed b q (Ts : seq table) : table := mkseq (fun i => in_line q [seq nth [::] T i | T <- Ts]) b.
Definition transposed q (T : table) : table := mkseq (fun j => [seq at_place r j | r <- T]) q.

(** The covariances of signals, those of the first a basic ones being P, and the others white. *)
Definition weighted_by a (P T : table) : table := table_product P (take a T) ++ drop a T.
Definition covariances a (P : table) q (T T' : table) : table := table_product (transposed q T) (weighted_by a P T').

(** The process of an experiment, followed in these coefficients. *)
Section Following.
Variables (m nu b : nat) (E : experiment_list R).
Definition driving_table (e : table) (s : seq table) := plus_tables b (nth [::] s 0) (table_product e (nth [::] (tforward E) 0)).
Definition next_states (e : table) (xs : table * seq table) : table * seq table :=
  let f := driving_table e xs.2 in
  (plus_tables b (plus_tables b (table_product xs.1 (tA (tplant E))) (table_product (columns 0 nu f) (tB E)))
      (table_product (columns nu m f) (tF (tplant E))),
   [seq plus_tables b (plus_tables b (nth [::] xs.2 i.+1) (table_product e (nth [::] (tforward E) i.+1)))
      (minus_table (table_product f (nth [::] (tback E) i))) | i <- iota 0 (size (tback E))]).
Definition channels p (e : table) (xs : table * seq table) : table * table :=
  let f := driving_table e xs.2 in
  (columns 0 nu f, plus_tables b (plus_tables b (plus_tables b (table_product xs.1 (tC (tplant E))) (table_product (columns 0 nu f) (tD E)))
      (table_product (columns nu m f) (tG (tplant E)))) (columns (nu + m) p f)).
Fixpoint recorded_channels p (xs : table * seq table) (es : seq table) : seq (table * table) :=
  if es is e :: es' then channels p e xs :: recorded_channels p (next_states e xs) es' else [::].
Definition joint_states n h (xs : table * seq table) : table := beside b n xs.1 (windowed b h xs.2).
End Following.

(** Tables of the sizes told, or smaller ones, which are zero where they end. *)
Definition sized_experiment n m p nu c (E : experiment_list R) : bool :=
  [&& sized n m p (tplant E), (size (tB E) <= nu)%N, (size (tD E) <= nu)%N, all (fun T => size T <= c)%N (tforward E)
    & all (fun T => size T <= nu + (m + p))%N (tback E)].

(** What shows a rank, as in `has_rank`. *)
Notation shown := (seq (nat * seq (numeral R)) * seq (nat * seq (numeral R)))%type.

(** P is the stationary covariance, f vanishes at the matrix of the states; with the covariance of the future inputs eliminated, the ranks
    of the limit for `past` inputs and `q` outputs before, of O_s and of both. *)
Definition is_limit n m p nu c past q s (rl ro rj : nat) (E : experiment_list R) (P : table) (f : seq Z)
    (of_inputs of_limit of_states of_both : shown) : bool :=
  let h := (nu + (m + p))%N in let l := size (tback E) in let a := (n + l * h)%N in let b := (a + (past + s) * c)%N in
  let start := (basic b 0 n, [seq basic b (n + i * h) h | i <- iota 0 l]) in
  let next := joint_states b n h (next_states m nu b E (basic b a c) start) in
  let zs := recorded_channels m nu b E p start [seq basic b (a + k * c) c | k <- iota 0 (past + s)] in
  let us := [seq z.1 | z <- zs] in let ys := [seq z.2 | z <- zs] in
  let U := windowed b nu (drop past us) in let UY := beside b (s * nu) U (windowed b p (drop past ys)) in
  let Z := beside b (past * nu) (windowed b nu (take past us)) (windowed b p (take q ys)) in
  let seen := [seq nseq (s * nu) (zero R) ++ r | r <- free_rows n p s (tplant E)] in
  let upper := covariances a P (s * nu) U UY in let lower := covariances a P (past * nu + q * p) Z UY in
  [&& (0 < past)%N, (q <= past)%N & sized_experiment n m p nu c E]
  && [&& size P == a, is_stable a (take a next) f & @equal_tables R a a (covariances a P a next next) P]
  && [&& has_rank (s * nu) (s * nu) (s * nu) (covariances a P (s * nu) U U) of_inputs.1 of_inputs.2,
    has_rank (s * nu + (past * nu + q * p)) (s * nu + s * p) (s * nu + rl) (upper ++ lower) of_limit.1 of_limit.2,
    has_rank (s * nu + n) (s * nu + s * p) (s * nu + ro) (upper ++ seen) of_states.1 of_states.2
    & has_rank (s * nu + (past * nu + q * p + n)) (s * nu + s * p) (s * nu + rj) (upper ++ (lower ++ seen)) of_both.1 of_both.2].

(** R' is the response to s inputs, B, D and X solve the normal equations of MOESP's regression: what they leave is orthogonal to O_s and to
    T_s of every unit; the covariance of the inputs and O_(s-1) have full rank. *)
Definition with_inputs (L : listing R) (B D : table) : listing R := Listing (tA L) B (tC L) D.
Definition unit_table a b i j : table := mkseq (fun k => if k == i then unit_row R b j else nseq b (zero R)) a.
Definition orthogonal_to_units n p nu s (L : listing R) (rest : table) : bool :=
  let traceless B D := vanishes (paired rest (forced_rows nu p s (with_inputs L B D))) in
  all (fun i => all (fun j => traceless (unit_table nu n i j) (nseq nu (nseq p (zero R)))) (iota 0 n)
    && all (fun j => traceless (nseq nu (nseq n (zero R))) (unit_table nu p i j)) (iota 0 p)) (iota 0 nu).
Definition is_regression n m p nu c s (E : experiment_list R) (B D P : table) (f : seq Z) (R' X : table)
    (of_inputs of_states : shown) : bool :=
  let h := (nu + (m + p))%N in let l := size (tback E) in let a := (n + l * h)%N in let b := (a + s * c)%N in
  let start := (basic b 0 n, [seq basic b (n + i * h) h | i <- iota 0 l]) in
  let next := joint_states b n h (next_states m nu b E (basic b a c) start) in
  let zs := recorded_channels m nu b E p start [seq basic b (a + k * c) c | k <- iota 0 s] in
  let U := windowed b nu [seq z.1 | z <- zs] in let Y := windowed b p [seq z.2 | z <- zs] in
  let C := covariances a P (s * nu) U U in let seen := free_rows n p s (tplant E) in
  let rest := plus_tables (s * nu) R' (minus_table
    (plus_tables (s * nu) (forced_rows nu p s (with_inputs (tplant E) B D)) (table_product X seen))) in
  [&& (0 < s)%N, sized_experiment n m p nu c E, formed nu n B & formed nu p D]
  && [&& size P == a, is_stable a (take a next) f & @equal_tables R a a (covariances a P a next next) P]
  && [&& has_rank (s * nu) (s * nu) (s * nu) C of_inputs.1 of_inputs.2,
    has_rank n (s.-1 * p) n (free_rows n p s.-1 (tplant E)) of_states.1 of_states.2, formed (s * nu) (s * p) R'
    & @equal_tables R (s * nu) (s * p) (table_product C R') (covariances a P (s * nu) U Y)]
  && (@equal_tables R n (s * nu) (table_product seen (transposed (s * p) rest)) [::] && orthogonal_to_units n p nu s (tplant E) rest).

(** E', with B' = tB - B and D' = tD - D, is the experiment whose outputs are the errors of the model with B and D, P its covariance; the
    sum S of Phi^k H C' A'^k solves its equation, and what u knows of the next states vanishes on it; the error is uncorrelated with the
    input now. *)
Definition errors_of (E : experiment_list R) (B D : table) := ExperimentList (tplant E) B D (tforward E) (tback E).
Definition is_output_error n m p nu c (E : experiment_list R) (B D B' D' P : table) (f : seq Z) (S : table) : bool :=
  let E' := errors_of E B' D' in
  let h := (nu + (m + p))%N in let l := size (tback E) in let a := (n + l * h)%N in let b := (a + 1 * c)%N in
  let start := (basic b 0 n, [seq basic b (n + i * h) h | i <- iota 0 l]) in
  let follow E := joint_states b n h (next_states m nu b E (basic b a c) start) in let next := follow E' in
  let z := channels m nu b E' p (basic b a c) start in
  [&& sized_experiment n m p nu c E, is_stable a (take a (follow E)) f, sized_experiment n m p nu c E',
    @equal_tables R nu n (tB E) (plus_tables nu B B') & @equal_tables R nu p (tD E) (plus_tables nu D D')]
  && [&& size P == a, is_stable a (take a next) f, @equal_tables R a a (covariances a P a next next) P & size S == a]
  && [&& @equal_tables R a n S (plus_tables a (table_product (table_product (take a next) S) (transposed n (tA (tplant E))))
      (table_product (take a z.2) (transposed p (tC (tplant E))))),
    @equal_tables R nu n (table_product (covariances a P nu z.1 next) S) [::] & @equal_tables R nu p (covariances a P nu z.1 z.2) [::]].
End LimitChecks.
