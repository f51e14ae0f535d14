(** The fifth part of Headlines.v, which includes it: what the checks of certificates prove once the kernel of Rocq has computed true. A
    system is told by L, lists of integers and a common denominator; meant n m p L is the system over the rational numbers. The checks
    check_... are functions on such lists (CertificatesVocabulary.v), and all other arguments are witnesses that nobody has to believe. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv ssrint
  matrix mxalgebra fraction.
From faultspace Require Import Vocabulary CertificatesVocabulary.
From faultspace Require SeenBasis BasisByStates CheckRanks CheckSolutions CheckBehaviors CheckInversion CheckMatrices.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** certificates *)

(** What the hints of a certificate show. The columns of Y lie in the kernel of the pencil, with independent leading coefficients; their
    states, the coefficients of their first n rows at the degrees below that of the column, are independent; and at one point q, or at
    infinity, the pencil leaves room for no more columns. So these are a minimal basis, and tell the ranks of all windows. *)
Theorem minimal_basis_by_states (K : fieldType) n m p k (S : system K n m p) (Y : 'M_(n + p, k)) q :
  pencil S *m Y = 0 -> \rank (Vocabulary.leading Y) = k ->
  (forall w : 'I_k -> nat -> K, \sum_a \sum_(j < degree Y a) w a j *: map_mx (coefp j) (col a (usubmx Y)) = 0 ->
    forall a j, (j < degree Y a)%N -> w a j = 0) ->
  (n + p <= \rank (map_mx (horner_eval q) (pencil S)) + k)%N \/ (p <= \rank (sysG S) + k)%N ->
  minimal_basis (pencil S) Y /\
  forall s, \rank (window S s) = (s * (p - k) + \sum_(a < k) minn s (degree Y a))%N.
Proof. exact: BasisByStates.seen_by_states. Qed.

(** The same for any polynomial matrix M, of b columns, where two determinants of combinations of Y have no common factor in the place of
    the states. *)
Theorem minimal_basis_seen (K : fieldType) a b k (M : 'M[{poly K}]_(a, b)) (Y : 'M_(b, k)) (J W : 'M_(k, b)) q :
  M *m Y = 0 -> \rank (Vocabulary.leading Y) = k -> coprimep (\det (J *m Y)) (\det (W *m Y)) ->
  (b <= \rank (map_mx (horner_eval q) M) + k)%N -> minimal_basis M Y.
Proof. by move=> kernel regular seen few; apply: (SeenBasis.minimal_basis_seen kernel seen few regular). Qed.

(** Ranks of all windows: rows that annihilate the system, and what shows that there are no others, words or hints; or rows modulo l. *)
Theorem check_window_ranks (n m p : nat) L l r etas ranks rows lower : check_window_ranks n m p r etas ranks l L rows lower ->
  let S := meant n m p L in
  (forall s, \rank (window S s) = (s * r + \sum_(eta <- etas) minn s eta)%N) /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof. exact: CheckRanks.window_ranks_sound. Qed.

Theorem check_window_ranks_modulo (n m p : nat) L l r etas ranks rows h : check_window_ranks_modulo n m p r etas ranks l L rows h ->
  let S := meant n m p L in
  (forall s, \rank (window S s) = (s * r + \sum_(eta <- etas) minn s eta)%N) /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof. exact: CheckRanks.window_ranks_modulo_sound. Qed.

Theorem check_left_invertible (n m p : nat) L l ws : check_left_invertible n m p l L ws -> left_invertible (meant n m p L).
Proof. exact: CheckRanks.left_invertible_sound. Qed.

Theorem check_left_invertible_at (n m p : nat) L l q rows columns d :
  check_left_invertible_at n m p l L q rows columns d -> left_invertible (meant n m p L).
Proof. exact: CheckRanks.left_invertible_at_sound. Qed.

Theorem check_solutions (n m p : nat) L s l rows lower d basis pivots combinations :
  check_solutions n m p s l L rows lower d basis pivots combinations ->
  spans_solutions (meant n m p L) s (fraction d (size basis) (n + p) basis).
Proof. exact: CheckSolutions.solutions_sound. Qed.

Theorem check_limit (n m p : nat) L beyond l rows lower d basis pivots combinations :
  check_limit n m p beyond l L rows lower d basis pivots combinations ->
  forall s, (beyond < s)%N -> spans_solutions (meant n m p L) s (fraction d (size basis) (n + p) basis).
Proof. exact: CheckSolutions.limit_sound. Qed.

Theorem check_inclusion (n m n' m' p : nat) L L' l rows lower : check_inclusion n m n' m' p l L L' rows lower ->
  let S := meant n m p L in let S' := meant n' m' p L' in
  (forall s r, word S s r -> word S' s r) /\ (forall r, behavior S r -> behavior S' r).
Proof. exact: CheckBehaviors.inclusion_sound. Qed.

Theorem check_equality (n m n' m' p : nat) L L' l rows lower lower' : check_equality n m n' m' p l L L' rows lower lower' ->
  let S := meant n m p L in let S' := meant n' m' p L' in
  (forall s, same_words S S' s) /\ same_behavior S S'.
Proof. exact: CheckBehaviors.equality_sound. Qed.

Theorem check_window_equality (n m n' m' p : nat) L L' s l rows ws ws' :
  check_window_equality n m n' m' p s l L L' rows ws ws' ->
  same_words (meant n m p L) (meant n' m' p L') s.
Proof. exact: CheckBehaviors.window_equality_sound. Qed.

Theorem check_difference (n m n' m' p : nat) L L' s x vs c : check_difference n m n' m' p s L L' x vs c ->
  exists2 r, word (meant n m p L) s r & ~ word (meant n' m' p L') s r.
Proof. exact: CheckBehaviors.difference_sound. Qed.

Theorem check_not_left_invertible (n m p : nat) L xs vs :
  check_not_left_invertible n m p L xs vs -> ~ left_invertible (meant n m p L).
Proof. exact: CheckInversion.not_left_invertible_sound. Qed.

(** The first fault from the first l + 1 samples, the initial state known (that is, zero) or not; and from no fewer, or from no number
    up to n. *)
Theorem check_delay (n m p : nat) L (known : bool) l rows x vs : check_delay n m p known l L rows x vs ->
  let determined l := forall x v, (known -> x = 0) -> (forall k, (k <= l)%N -> output (meant n m p L) x v k = 0) -> v 0%N = 0 in
  [/\ (l <= n)%N, determined l & forall j, (j < l)%N -> ~ determined j].
Proof. exact: CheckInversion.delay_sound. Qed.

Theorem check_no_delay (n m p : nat) L (known : bool) x vs : check_no_delay n m p known L x vs ->
  let determined l := forall x v, (known -> x = 0) -> (forall k, (k <= l)%N -> output (meant n m p L) x v k = 0) -> v 0%N = 0 in
  forall j, (j <= n)%N -> ~ determined j.
Proof. exact: CheckInversion.no_delay_sound. Qed.

Theorem check_observability (n m p : nat) L l r nulls combinations :
  check_observability n m p r l L nulls combinations -> \rank (O (meant n m p L) n) = r.
Proof. exact: CheckMatrices.observability_sound. Qed.

(** [F; F A; ...; F A^(n-1)], or its transpose *)
Theorem check_reachability (n m p : nat) L l r nulls combinations : check_reachability n m p r l L nulls combinations ->
  \rank (reachability (meant n m p L)) = r.
Proof. exact: CheckMatrices.reachability_sound. Qed.

(** A recorded trajectory: the initial state x and the faults vs, over the denominator d *)
Theorem check_hankel (n m p : nat) L l r nulls combinations N s d x vs :
  check_hankel n m p N s r l L d x vs nulls combinations ->
  \rank (hankel N s (output (meant n m p L) (recorded d n x) (fun k => recorded d m (nth [::] vs k)))) = r.
Proof. exact: CheckMatrices.hankel_sound. Qed.

Theorem check_excitation (n m p : nat) L l r nulls combinations N s d x vs :
  check_excitation n m p N s r l L d x vs nulls combinations ->
  \rank (excitation (meant n m p L) (recorded d n x) (fun k => recorded d m (nth [::] vs k)) N s) = r.
Proof. exact: CheckMatrices.excitation_sound. Qed.
