(** The second part of Headlines.v, which includes it: the ledger from theorem-3 on, but for what HeadlinesLimits.v, HeadlinesStructure.v
    and HeadlinesMeans.v have, then left-invertibility in all its forms, and what else the claims rest on. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra vector fraction.
From faultspace Require Import Vocabulary.
From faultspace Require Theorem3 GoodPairs GenericPairs WidePairs Readings Counterexamples.
From faultspace Require FaultMatrices ZeroFeedthroughUnique Trajectory SmallSystems Indices.
From faultspace Require SystemInfiniteZeros SolutionCount ClosedForm ExceptionalPolynomial PairZeros.
From faultspace Require ZeroAssignment EchelonForm EchelonExists Inversion TransferRank Gap Lag Chain.
From faultspace Require Excitation WeakExcitation SharpPartner ObservablePart BadPlane.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** theorem-3-i *)

(** part-i; for every window s *)
Theorem theorem_3_part_i (K : fieldType) n m m' p (S : system K n m p) (F : 'M_(m', n)) (G : 'M_(m', p)) s k (Z : 'M_(k, n + p)) :
  same_behavior (with_faults S F G) S ->
  (forall i, solves S s (row i F) (row i G)) /\ (spans_solutions S s Z -> exists P, row_mx F G = P *m Z).
Proof. exact: Theorem3.theorem_3_part_i. Qed.

(** ** theorem-3-ii *)

(** almost-every: the bad P are the common zeros of the coefficients of D, polynomials in the entries of P that do not all vanish; on
    every line through a good P all but at most m are good, the system being left-invertible *)
Theorem theorem_3_almost_every (K : fieldType) n m p (S : system K n m p) s (Z : 'M_(zeta S + \rank (transfer S), n + p)) :
  (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> exists a b : 'M[K]_(zeta S, zeta S + \rank (transfer S)),
  let D (P : 'M[K]_(\rank (transfer S), zeta S + \rank (transfer S))) : {poly K} :=
    \det (col_mx ('X *: map_mx polyC b - map_mx polyC a) (map_mx polyC P)) in
  (forall P, same_behavior (faults_of S (P *m Z)) S <-> D P != 0) /\ exists P, D P != 0.
Proof. exact: GoodPairs.almost_every_pair. Qed.
Theorem theorem_3_on_lines (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) (P P1 : 'M_(m, k)) (ts : seq K) :
  (n < s)%N -> spans_solutions S s Z -> left_invertible S -> same_behavior (faults_of S (P *m Z)) S -> uniq ts ->
  (forall t, t \in ts -> ~ same_behavior (faults_of S ((P + t *: P1) *m Z)) S) -> (size ts <= m)%N.
Proof. exact: GenericPairs.theorem_3_part_ii. Qed.

(** every-p, refuted on every window by x(k+1) = v1(k), r = (x, v2, 0), which has normal rank 2 and one zero; Z a basis, P of full rank *)
Theorem theorem_3_every_p (K : fieldType) :
  let S : system K 1 (1 + 1) (1 + 1 + 1) := System 0 (col_mx 1%:M 0) (row_mx (row_mx 1%:M 0) 0) (row_mx (block_mx 0 0 0 1%:M) 0) in
  let Z : 'M_(1 + (1 + 1), 1 + (1 + 1 + 1)) := block_mx 1%:M 0 0 (row_mx 1%:M 0) in
  let P : 'M_(1 + 1, 1 + (1 + 1)) := block_mx 1%:M 0 0 (row_mx 1%:M 0) in
  [/\ observable S /\ left_invertible S, \rank (transfer S) = 2%N /\ zeta S = 1%N,
      forall s, (0 < s)%N -> spans_solutions S s Z, row_free Z /\ row_free P
    & ~ same_behavior (faults_of S (P *m Z)) S].
Proof. exact: WidePairs.every_p_wide. Qed.

(** criterion-window-n, refuted by problem_11_window_n. criterion-left-invertible: *)
Theorem theorem_3_left_invertible (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) (P : 'M_(m, k)) :
  (lag S < s)%N -> spans_solutions S s Z -> left_invertible S ->
  same_behavior (faults_of S (P *m Z)) S <-> \rank (transfer (faults_of S (P *m Z))) = m.
Proof. exact: Readings.criterion_left_invertible. Qed.

(** criterion, for P of any number m' of columns, rows here *)
Theorem theorem_3_criterion (K : fieldType) n m m' p (S : system K n m p) s k (Z : 'M_(k, n + p)) (P : 'M_(m', k)) :
  (lag S < s)%N -> spans_solutions S s Z ->
  same_behavior (faults_of S (P *m Z)) S <-> \rank (transfer (faults_of S (P *m Z))) = \rank (transfer S).
Proof. move=> long span; exact: (Theorem3.theorem_3_normal_rank_sharp long span). Qed.

(** Without a matrix Z: with the same (A, C) an included behaviour with as many faults is equal once it, the smaller one, is left-
    invertible. And what cannot be left out: the same A, and left-invertibility of the smaller. *)
Theorem theorem_3 (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) N :
  sysA S' = sysA S -> sysC S' = sysC S -> (lag S <= N)%N -> (m <= m')%N -> left_invertible S' ->
  (forall r, word S' N.+1 r -> word S N.+1 r) ->
  (forall s, same_words S S' s) /\ same_behavior S S'.
Proof. by move=> sameA sameC; apply: (Theorem3.theorem_3_sharp sameA sameC). Qed.
Theorem theorem_3_needs_same_A (K : fieldType) : exists S S' : system K (1 + 1) 0 1,
  [/\ left_invertible S, left_invertible S', sysC S = sysC S',
      forall r, behavior S r -> behavior S' r & ~ (forall r, behavior S' r -> behavior S r)].
Proof. exists (Counterexamples.forgets K), (Counterexamples.shifts K); exact: Counterexamples.same_A_is_needed. Qed.
Theorem theorem_3_needs_left_invertibility (K : fieldType) : exists S S' : system K 0 1 1,
  [/\ left_invertible S', ~ left_invertible S, sysA S = sysA S' /\ sysC S = sysC S',
      forall r, behavior S r -> behavior S' r & ~ (forall r, behavior S' r -> behavior S r)].
Proof.
exists (Counterexamples.nothing K), (Counterexamples.everything K); exact: Counterexamples.left_invertibility_of_the_smaller_is_needed.
Qed.

(** ** zero-feedthrough *)

(** fault-matrices, refuted by x1(k+1) = x2(k), x2(k+1) = v(k), r = x1: the rows of F' are not in the row space of F *)
Theorem zero_feedthrough_fault_matrices (K : fieldType) : exists (S : system K (1 + 1) 1 1) (F' : 'M_(1, 1 + 1)),
  [/\ observable S, fault_controllable S, left_invertible S, sysG S = 0 &
      same_behavior (with_faults S F' 0) S /\ ~ (F' <= sysF S)%MS].
Proof. exact: FaultMatrices.fault_matrices_equal. Qed.

(** exactly-when: all F' of the same behaviour are in the row space of F just when all solutions (f, 0) are; and when these are. zeta is
    the number of zeros by window_ranks_zeros *)
Theorem zero_feedthrough_matrices (K : fieldType) n m p (S : system K n m p) s : (n < s)%N -> sysG S = 0 ->
  (forall m' (F' : 'M_(m', n)), same_behavior (with_faults S F' 0) S -> (F' <= sysF S)%MS) <->
  (forall f, solves S s f 0 -> (f <= sysF S)%MS).
Proof. exact: FaultMatrices.zero_feedthrough_any. Qed.
Theorem zero_feedthrough (K : fieldType) n m p (S : system K n m p) s g :
  (n < s)%N -> sysG S = 0 -> left_invertible S -> gcd_of_minors (pencil S) g ->
  ((forall f, solves S s f 0 -> (f <= sysF S)%MS) <-> zeta S = m) /\
  ((forall f, solves S s f 0 -> (f <= sysF S)%MS) <-> \rank (sysF S *m sysC S) = m /\ (size g).-1 = 0%N).
Proof. exact: Readings.zero_feedthrough_by_zeros. Qed.

(** Then F is known up to a basis. *)
Theorem zero_feedthrough_recovery (K : fieldType) n m p (S : system K n m p) (F' : 'M_(m, n)) :
  sysG S = 0 -> left_invertible S -> \rank (sysF S *m sysC S) = m -> (forall x, holds_zero S n x -> x = 0) ->
  same_behavior (with_faults S F' 0) S <-> (F' :=: sysF S)%MS.
Proof. move=> G0 inv full none; exact: (ZeroFeedthroughUnique.faults_known_up_to_basis G0 inv full none). Qed.

(** ** trajectory-recovered *)

(** state-known; the delay, which is at most n, is told by trajectory_delay (HeadlinesStructure.v) *)
Theorem trajectory_state_known (K : fieldType) n m p (S : system K n m p) :
  (forall x v w, (forall k, output S x v k = output S x w k) -> forall k, v k = w k) <-> left_invertible S.
Proof. exact: Trajectory.faults_recovered_left_invertible. Qed.

(** state-unknown, refuted by x(k+1) = v(k), r = x + v *)
Theorem trajectory_state_unknown (K : fieldType) : exists S : system K 1 1 1, [/\ observable S, fault_controllable S, left_invertible S &
  ~ (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k)].
Proof. exists (SmallSystems.hidden_fault K); exact: SmallSystems.hidden_fault_not_recovered. Qed.

(** no-finite-zeros: the unobservable modes, n - rank O_n of them, are finite zeros, and there are no others *)
Theorem trajectory_no_finite_zeros (K : fieldType) n m p (S : system K n m p) g : gcd_of_minors (pencil S) g ->
  (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k) <->
  left_invertible S /\ (size g).-1 = (n - \rank (O S n))%N.
Proof. exact: Readings.recovered_blindly_by_zeros. Qed.

(** ** settle-2, objection-1, objection-2, objection-3: by theorems of other claims, some of them below or in other files. Past the paper:
    window-ranks *)

(** ranks: etas are the left minimal indices *)
Theorem window_ranks (K : fieldType) n m p (S : system K n m p) s :
  \rank (window S s) = (s * \rank (transfer S) + \sum_(e <- etas S) minn s e)%N.
Proof. exact: Readings.window_rank_by_indices. Qed.
Theorem window_ranks_left_indices (K : fieldType) n m p (S : system K n m p) d (Y : 'M_(n + p, d)) : minimal_basis (pencil S) Y ->
  perm_eq [seq degree Y j | j <- enum 'I_d] (etas S).
Proof. exact: Indices.etas_are_minimal_indices. Qed.

(** indices: n = sum eta + sum eps + n_f + n_inf, the zeros told by the minors of order n + r; r is the normal rank *)
Theorem window_ranks_indices (K : fieldType) n m p (S : system K n m p) c k (X : 'M_(n + p, c)) (Y : 'M_(n + m, k)) g d :
  minimal_basis (pencil S) X -> minimal_basis (pencil S)^T Y ->
  gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g -> system_infinite_zeros S d ->
  n = (\sum_(j < c) degree X j + \sum_(j < k) degree Y j + (size g).-1 + d)%N.
Proof. rewrite Readings.normal_rank; exact: SystemInfiniteZeros.order_of_system. Qed.

(** The same where the system is left-invertible: then there are no right indices, and g and d are those of the maximal minors. *)
Theorem window_ranks_zeros (K : fieldType) n m p (S : system K n m p) g d :
  left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d -> n = (sumn (etas S) + ((size g).-1 + d))%N.
Proof. exact: Readings.dimension_by_zeros. Qed.

(** For every system n less the etas, zeta, counts the right minimal indices too. *)
Theorem zeta_of_system (K : fieldType) n m p (S : system K n m p) k (Y : 'M_(n + m, k)) g d : minimal_basis (pencil S)^T Y ->
  gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g -> system_infinite_zeros S d ->
  zeta S = (\sum_(j < k) degree Y j + (size g).-1 + d)%N.
Proof. rewrite Readings.normal_rank; exact: SystemInfiniteZeros.zeta_system. Qed.

(** solutions, at window s + 1 *)
Theorem window_ranks_solutions (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) : spans_solutions S s.+1 Z ->
  (\rank Z + \sum_(e <- etas S | (e <= s)%N) e.+1 = n + p)%N.
Proof. exact: SolutionCount.solution_count. Qed.

(** limit: n_z = r + n_f + n_inf + sum eps, which is r + zeta, at s + 1 = lag + 1 samples and, of the windows of at least one sample, not
    before; where the system is left-invertible, problem_11_dimension *)
Theorem window_ranks_limit (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) c (Y : 'M_(n + m, c)) g d :
  spans_solutions S s.+1 Z -> minimal_basis (pencil S)^T Y ->
  gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g -> system_infinite_zeros S d ->
  \rank Z = (\rank (transfer S) + (\sum_(j < c) degree Y j + (size g).-1 + d))%N <-> (lag S <= s)%N.
Proof. exact: Readings.limit_dimension. Qed.

(** The solutions in closed form: f = v F + x A + u, g = v G + x C with x and u in V + S, here the rows of zero_states (ClosedForm.v). *)
Theorem solutions_closed_form (K : fieldType) n m p (S : system K n m p) s : (n < s)%N -> let U := zero_states S in
  spans_solutions S s (col_mx (row_mx (sysF S) (sysG S)) (col_mx (row_mx (U *m sysA S) (U *m sysC S)) (row_mx U 0))).
Proof. exact: ClosedForm.solutions_closed_form. Qed.

(** ** sharp-windows *)

(** gap *)
Theorem sharp_gap (K : fieldType) n m p (S : system K n m p) s :
  \rank (window S s.+1) = (\rank (window S s) + \rank (transfer S))%N <-> (lag S <= s)%N.
Proof. exact: Readings.growth_is_normal_rank_from_lag. Qed.

(** solutions: problem_11_lag. equality: the partner has the same (A, C) and as many faults, and is left-invertible where the system is, its
    lag then no smaller; that the lag cannot always be kept is sharp_equality_lag. With one state more it can. *)
Theorem sharp_equality (K : fieldType) n m p (S : system K n m p) : (0 < m)%N -> (0 < lag S)%N ->
  exists (F : 'M_(m, n)) G, let S' := with_faults S F G in
  [/\ left_invertible S -> left_invertible S' /\ (lag S <= lag S')%N, same_words S S' (lag S)
    & exists r, word S' (lag S).+1 r /\ ~ word S (lag S).+1 r].
Proof. exact: SharpPartner.partner_with_as_many_faults_same_A_C. Qed.
Theorem sharp_equality_left_invertible (K : fieldType) n m p (S : system K n m p) : (0 < lag S)%N -> exists S' : system K (n + 1) m p,
  [/\ left_invertible S -> left_invertible S', (lag S' <= lag S)%N, gap S' (n + 1) = gap S n,
      same_words S S' (lag S) & exists r, word S' (lag S).+1 r /\ ~ word S (lag S).+1 r].
Proof. exact: Readings.partner_with_as_many_faults. Qed.

(** ** one-determinant *)

(** formula: U is a basis of the zero states, a and b tell (u A, u C) and (u, 0) in the basis Z, and D = det [q b - a; P]. That
    the product of the diagonal form of a pencil is the greatest common divisor of its maximal minors is known, and not proved here. Such
    U, a, b exist. *)
Theorem one_determinant (K : fieldType) n m p (S : system K n m p) s r e (Z : 'M_(e + r, n + p)) U a b (P : 'M_(r, e + r)) :
  (n < s)%N -> spans_solutions S s Z /\ row_free Z -> row_free U -> (U :=: zero_states S)%MS ->
  a *m Z = row_mx (U *m sysA S) (U *m sysC S) -> b *m Z = row_mx U (0 : 'M_(e, p)) ->
  let D := \det (col_mx ('X *: map_mx polyC b - map_mx polyC a) (map_mx polyC P)) in
  gcd_of_minors (pencil (faults_of S (P *m Z))) D /\ (\rank (transfer (faults_of S (P *m Z))) = r <-> D != 0).
Proof. exact: GoodPairs.determinant_of_pair. Qed.
Theorem one_determinant_exists (K : fieldType) n m p (S : system K n m p) s : (n < s)%N ->
  exists (Z : 'M_(zeta S + \rank (transfer S), n + p)) (U : 'M_(zeta S, n)) (a b : 'M_(zeta S, zeta S + \rank (transfer S))),
  [/\ spans_solutions S s Z /\ row_free Z, row_free U, (U :=: zero_states S)%MS,
      a *m Z = row_mx (U *m sysA S) (U *m sysC S) & b *m Z = row_mx U 0].
Proof. exact: ExceptionalPolynomial.coordinates_exist. Qed.

(** ** zeros-of-pairs *)

(** number *)
Theorem zeros_of_pairs (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) g d :
  same_behavior S S' -> left_invertible S' -> gcd_of_minors (pencil S') g -> infinite_zeros S' d ->
  ((size g).-1 + d)%N = zeta S.
Proof. exact: Readings.zeros_of_equivalent_pairs. Qed.

(** split, refuted by r(k) = x(k) + v(k), x(k+1) = 0 *)
Theorem zeros_of_pairs_split (K : fieldType) : let S : system K 1 1 1 := System 0 0 1%:M 1%:M in exists F G F' G',
  [/\ same_behavior (with_faults S F G) S, same_behavior (with_faults S F' G') S,
      gcd_of_minors (pencil (with_faults S F G : system _ 1 1 1)) 1
    & gcd_of_minors (pencil (with_faults S F' G' : system _ 1 1 1)) 'X].
Proof. exact: PairZeros.different_numbers. Qed.

(** ** bad-set *)

(** one-fault *)
Theorem bad_set_one_fault (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) (P : 'rV_k) :
  (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> row_free (O S n) -> \rank (transfer S) = 1%N ->
  same_behavior (faults_of S (P *m Z)) S <-> P != 0.
Proof. exact: Readings.one_fault. Qed.

(** no-zeros, no condition but zeta = 0: P is square, and bad iff singular *)
Theorem bad_set_no_zeros (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) (P : 'M_k) :
  (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> zeta S = 0%N ->
  k = \rank (transfer S) /\ (same_behavior (faults_of S (P *m Z)) S <-> \det P != 0).
Proof. exact: Readings.no_zeros. Qed.

(** full-rank: bad P of full rank exist just then *)
Theorem bad_set_full_rank (K : fieldType) n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) : let r := \rank (transfer S) in
  (n < s)%N -> spans_solutions S s Z -> row_free Z ->
  (exists P : 'M_(r, k), row_free P /\ ~ same_behavior (faults_of S (P *m Z)) S) <->
  ((0 < r)%N /\ ~~ row_free (O S n)) \/ ((1 < r)%N /\ (0 < zeta S)%N).
Proof. exact: GoodPairs.bad_pairs_of_full_rank_general. Qed.

(** codimension-two, (A, C) being observable and zeta >= 1, whatever r is: the bad P, over every extension L of the field, are the common
    zeros of the coefficients in q of D, which are polynomials in the entries of P over the field, homogeneous of degree r; and x P + y Q
    is bad for no (x, y) but (0, 0). So for r >= 1 and L algebraically closed they are a cone that meets a plane in 0 alone; that its
    codimension is then at least two is the projective dimension theorem, which is known, and not proved here. *)
Theorem bad_set_plane (K : fieldType) n m p (S : system K n m p) s (Z : 'M_(zeta S + \rank (transfer S), n + p)) :
  (lag S < s)%N -> spans_solutions S s Z -> row_free Z -> row_free (O S n) -> (0 < zeta S)%N ->
  exists (a b : 'M[K]_(zeta S, zeta S + \rank (transfer S))) (P Q : 'M[K]_(\rank (transfer S), zeta S + \rank (transfer S))),
  forall (L : fieldType) (f : {rmorphism K -> L}),
  let S' := System (map_mx f (sysA S)) (map_mx f (sysF S)) (map_mx f (sysC S)) (map_mx f (sysG S)) in
  let D R := \det (col_mx ('X *: map_mx polyC (map_mx f b) - map_mx polyC (map_mx f a)) (map_mx polyC R)) in
  (forall R, same_behavior (faults_of S' (R *m map_mx f Z)) S' <-> D R != 0) /\
  forall x y, (x != 0) || (y != 0) -> D (x *: map_mx f P + y *: map_mx f Q) != 0.
Proof. exact: BadPlane.bad_plane. Qed.

(** ** zero-assignment *)

(** every-polynomial, of normal rank 1 + r: by one_determinant D is the zero polynomial of the pair *)
Theorem zero_assignment (K : fieldType) n m p (S : system K n m p) s r e (Z : 'M_(e + (1 + r), n + p)) U a b (g : {poly K}) :
  (n < s)%N -> spans_solutions S s Z /\ row_free Z -> row_free U -> (U :=: zero_states S)%MS ->
  a *m Z = row_mx (U *m sysA S) (U *m sysC S) -> b *m Z = row_mx U (0 : 'M_(e, p)) -> row_free (O S n) -> (size g <= e.+1)%N ->
  exists P : 'M_(1 + r, e + (1 + r)), \det (col_mx ('X *: map_mx polyC b - map_mx polyC a) (map_mx polyC P)) = g.
Proof.
move=> _ basis free zeros ea eb obs; exact: (ZeroAssignment.every_exceptional_polynomial (And5 basis free zeros ea eb) obs).
Qed.

(** recoverable, of every system *)
Theorem recoverable_pair (K : fieldType) n m p (S : system K n m p) : let r := \rank (transfer S) in
  exists (F : 'M_(r, n)) (G : 'M_(r, p)), let S' := with_faults S F G in
  same_behavior S' S /\
  (forall x y v w, (forall k, output S' x v k = output S' y w k) -> forall k, v k = w k).
Proof. exact: ObservablePart.recoverable_pair_of_every_system. Qed.

(** ** canonical-form *)

(** same-a-c: reduced_echelon is the reduced row echelon form, unique for a row space; it exists *)
Theorem canonical_form_same_a_c (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) s k k'
    (R : 'M_(k, n + p)) (R' : 'M_(k', n + p)) :
  sysA S' = sysA S -> sysC S' = sysC S -> (n < s)%N ->
  spans_solutions S s R -> spans_solutions S' s R' -> reduced_echelon R -> reduced_echelon R' ->
  (exists e : k = k', castmx (e, erefl) R = R') <-> same_behavior S S'.
Proof. move=> sameA sameC; exact: (EchelonForm.canonical_echelon_form sameA sameC). Qed.
Theorem canonical_form_exists (K : fieldType) n m p (S : system K n m p) s :
  exists k (R : 'M_(k, n + p)), reduced_echelon R /\ spans_solutions S s R.
Proof. exact: EchelonExists.solutions_echelon_exists. Qed.

(** any-a-c, refuted by another basis of the state: r(k) = (v(k-1), v(k)) with the state v(k-1), or c v(k-1) *)
Theorem canonical_form_any_a_c (K : fieldType) (c : K) s : c != 0 -> c != 1 -> (1 < s)%N -> exists S S' : system K 1 1 (1 + 1),
  same_behavior S S' /\ exists f g, solves S s f g /\ ~ solves S' s f g.
Proof. exact: SmallSystems.equal_behaviors_other_solutions. Qed.

(** feedback, refuted: the behaviour stays for every system and every L; and for one system no change of basis undoes it *)
Theorem canonical_form_feedback (K : fieldType) n m p (S : system K n m p) L :
  same_behavior (System (sysA S + L *m sysF S) (sysF S) (sysC S + L *m sysG S) (sysG S)) S.
Proof. exact: SmallSystems.feedback_behavior. Qed.
Theorem canonical_form_feedback_no_basis (K : fieldType) : exists S S' : system K 1 1 1,
  [/\ observable S /\ observable S', fault_controllable S /\ fault_controllable S', left_invertible S /\ left_invertible S',
      same_behavior S S' & ~ exists B, B \in unitmx /\ sysA S' = invmx B *m sysA S *m B].
Proof. exact: SmallSystems.behavior_does_not_fix_A. Qed.

(** ** Left-invertibility in all its forms, and what else the claims rest on *)

Theorem left_invertible_delay (K : fieldType) n m p (S : system K n m p) :
  (left_invertible S <-> inverts_with_delay S n) /\ (left_invertible S <-> exists l, inverts_with_delay S l).
Proof. exact: Inversion.left_inversion_delay. Qed.
Theorem left_invertible_pencil (K : fieldType) n m p (S : system K n m p) :
  left_invertible S <-> \rank (over_fractions (pencil S)) = (n + m)%N.
Proof. exact: Inversion.left_invertible_pencil_rank. Qed.
Theorem left_invertible_transfer (K : fieldType) n m p (S : system K n m p) : left_invertible S <-> \rank (transfer S) = m.
Proof. exact: TransferRank.left_invertible_transfer_rank. Qed.

(** gap and lag, in words of ranks *)
Theorem gap_meaning (K : fieldType) n m p (S : system K n m p) s : \rank (window S s.+1) = (\rank (window S s) + gap S s)%N.
Proof. exact: Gap.rank_window_step. Qed.
Theorem lag_meaning (K : fieldType) n m p (S : system K n m p) s : gap S s = gap S n <-> (lag S <= s)%N.
Proof. exact: Lag.lagP. Qed.

(** The chain W_k decreases, and stays where it is once a step does not change it, so from k = n on. *)
Theorem chain_decreases (K : fieldType) n m p (S : system K n m p) j k y : (j <= k)%N -> silently_reaches S k y -> silently_reaches S j y.
Proof. exact: Chain.chain_decreasing. Qed.
Theorem chain_stays (K : fieldType) n m p (S : system K n m p) k : (forall y, silently_reaches S k y -> silently_reaches S k.+1 y) ->
  forall j y, (k <= j)%N -> silently_reaches S k y <-> silently_reaches S j y.
Proof. exact: Chain.chain_stays. Qed.
Theorem chain_constant (K : fieldType) n m p (S : system K n m p) k y : (n <= k)%N -> silently_reaches S n y <-> silently_reaches S k y.
Proof. exact: Chain.chain_constant. Qed.

(** Data: exactly when R_s has the row space of [O_s T_s], and problem (11) on data that excite no more than the faults reach *)
Theorem data_exact (K : fieldType) n m p (S : system K n m p) x v N s :
  (hankel N s (output S x v) == window S s)%MS = row_full (col_mx (excitation S x v N s) (kermx (window S s))).
Proof. exact: Excitation.exact_excitation. Qed.
Theorem data_problem_11 (K : fieldType) n m p (S : system K n m p) x v M s f g :
  persistently_exciting M (n + s.+1) v -> (lag S <= s)%N -> data_solves S (n + M) s.+1 (output S x v) f g <-> solves S s.+1 f g.
Proof. exact: WeakExcitation.persistency_solves_from_lag. Qed.
