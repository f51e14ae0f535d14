(** The sixth part of Headlines.v, which includes it: what the checks of certificates over GF(p) and Q(a) prove once the kernel of Rocq has
    computed true. Numbers of an arithmetic R mean elements of a field, by `value`: residues do in every field where l is zero, polynomials
    in a do in every field of characteristic 0 that has a root of f. A system is told by L, lists of numbers; the checks are functions on
    such lists (NumbersVocabulary.v), and all other arguments are witnesses that nobody has to believe. *)
From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary CertificatesVocabulary NumbersVocabulary.
From faultspace Require FieldArithmetic FieldBehaviors FieldSolutions FieldInversion FieldMatrices FieldZeros FieldInfiniteZeros FieldLines.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** Numbers *)

(** GF(p), and every field that contains it *)
Theorem residues_mean (K : fieldType) l : number K l = 0 -> means (number K : numeral (residues l) -> K).
Proof. exact: FieldArithmetic.residues_mean. Qed.

Theorem residues_exist l : Z.lt (Zpos xH) l -> exists K : fieldType, number K l = 0.
Proof. exact: FieldArithmetic.residues_exist. Qed.

(** Q(a), with any root of f in any field of characteristic 0 as a *)
Theorem algebraic_mean (K : fieldType) f (a : K) : (forall z, number K z = 0 -> z = Z0) -> value_at a f = 0 ->
  means (value_at a : numeral (algebraic f) -> K).
Proof. exact: FieldArithmetic.algebraic_mean. Qed.

(** ** certificates *)

Theorem field_window_ranks (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r etas ranks L rows Q ws : means value ->
  has_window_ranks n m p r etas ranks L rows Q ws -> let S := system_of value n m p L in
  (forall s, \rank (window S s) = (s * r + \sum_(eta <- etas) minn s eta)%N) /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof. move=> meaning; exact: (FieldBehaviors.has_window_ranks_sound meaning). Qed.

Theorem field_left_invertible (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p L ws : means value ->
  is_left_invertible n m p L ws -> left_invertible (system_of value n m p L).
Proof. move=> meaning; exact: (FieldBehaviors.is_left_invertible_sound meaning). Qed.

Theorem field_not_left_invertible (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p L xs vs : means value ->
  is_not_left_invertible n m p L xs vs -> ~ left_invertible (system_of value n m p L).
Proof. move=> meaning; exact: (FieldInversion.is_not_left_invertible_sound meaning). Qed.

(** The first fault from the first l + 1 samples, the initial state known (that is, zero) or not; and from no fewer, or from no number
    up to n. *)
Theorem field_delay (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (known : bool) l L rows x vs : means value ->
  has_delay n m p known l L rows x vs ->
  let determined l := forall x v, (known -> x = 0) -> (forall k, (k <= l)%N -> output (system_of value n m p L) x v k = 0) -> v 0%N = 0 in
  [/\ (l <= n)%N, determined l & forall j, (j < l)%N -> ~ determined j].
Proof. move=> meaning; exact: (FieldInversion.has_delay_sound meaning). Qed.

Theorem field_no_delay (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (known : bool) L x vs : means value ->
  has_no_delay n m p known L x vs ->
  let determined l := forall x v, (known -> x = 0) -> (forall k, (k <= l)%N -> output (system_of value n m p L) x v k = 0) -> v 0%N = 0 in
  forall j, (j <= n)%N -> ~ determined j.
Proof. move=> meaning; exact: (FieldInversion.has_no_delay_sound meaning). Qed.

Theorem field_inclusion (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p L L' rows Q ws : means value ->
  is_included n m n' m' p L L' rows Q ws -> let S := system_of value n m p L in let S' := system_of value n' m' p L' in
  (forall s r, word S s r -> word S' s r) /\ (forall r, behavior S r -> behavior S' r).
Proof. move=> meaning; exact: (FieldBehaviors.is_included_sound meaning). Qed.

Theorem field_equality (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p L L' rows Q ws ws' : means value ->
  are_equal n m n' m' p L L' rows Q ws ws' -> let S := system_of value n m p L in let S' := system_of value n' m' p L' in
  (forall s, same_words S S' s) /\ same_behavior S S'.
Proof. move=> meaning; exact: (FieldBehaviors.are_equal_sound meaning). Qed.

Theorem field_window_equality (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p s L L' rows Q ws ws' : means value ->
  are_equal_on n m n' m' p s L L' rows Q ws ws' -> same_words (system_of value n m p L) (system_of value n' m' p L') s.
Proof. move=> meaning; exact: (FieldBehaviors.are_equal_on_sound meaning). Qed.

Theorem field_difference (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p s L L' x vs c : means value ->
  differ n m n' m' p s L L' x vs c -> exists2 r, word (system_of value n m p L) s r & ~ word (system_of value n' m' p L') s r.
Proof. move=> meaning; exact: (FieldBehaviors.differ_sound meaning). Qed.

Theorem field_solutions (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p s L rows Q ws basis pivots combinations :
  means value -> are_solutions n m p s L rows Q ws basis pivots combinations ->
  spans_solutions (system_of value n m p L) s (matrix_of value (size basis) (n + p) basis).
Proof. move=> meaning; exact: (FieldSolutions.are_solutions_sound meaning). Qed.

Theorem field_limit (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p beyond L rows Q ws basis pivots combinations :
  means value -> are_solutions_beyond n m p beyond L rows Q ws basis pivots combinations ->
  forall s, (beyond < s)%N -> spans_solutions (system_of value n m p L) s (matrix_of value (size basis) (n + p) basis).
Proof. move=> meaning; exact: (FieldSolutions.are_solutions_beyond_sound meaning). Qed.

Theorem field_observability (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r L nulls combinations : means value ->
  observability_has_rank n m p r L nulls combinations -> \rank (O (system_of value n m p L) n) = r.
Proof. move=> meaning; exact: (FieldMatrices.observability_rank meaning). Qed.

Theorem field_window (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p s r L nulls combinations : means value ->
  window_has_rank n m p s r L nulls combinations -> \rank (window (system_of value n m p L) s) = r.
Proof. move=> meaning; exact: (FieldMatrices.window_rank meaning). Qed.

Theorem field_toeplitz (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p s r L nulls combinations : means value ->
  toeplitz_has_rank n m p s r L nulls combinations -> \rank (T (system_of value n m p L) s) = r.
Proof. move=> meaning; exact: (FieldMatrices.toeplitz_rank meaning). Qed.

(** [F; F A; ...; F A^(n-1)], or its transpose *)
Theorem field_reachability (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r L nulls combinations : means value ->
  reachability_has_rank n m p r L nulls combinations -> \rank (reachability (system_of value n m p L)) = r.
Proof. move=> meaning; exact: (FieldMatrices.reachability_rank meaning). Qed.

(** A trajectory, from x under the faults vs *)
Theorem field_hankel (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p N s r L x vs nulls combinations : means value ->
  hankel_has_rank n m p N s r L x vs nulls combinations ->
  \rank (hankel N s (output (system_of value n m p L) (vector_of value n x) (signal_of value m vs))) = r.
Proof. move=> meaning; exact: (FieldMatrices.hankel_rank meaning). Qed.

Theorem field_excitation (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p N s r L x vs nulls combinations : means value ->
  excitation_has_rank n m p N s r L x vs nulls combinations ->
  \rank (excitation (system_of value n m p L) (vector_of value n x) (signal_of value m vs) N s) = r.
Proof. move=> meaning; exact: (FieldMatrices.excitation_rank meaning). Qed.

(** The normal rank, and the zero polynomial: the monic greatest common divisor of the minors of the pencil of that order, n + r *)
Theorem field_finite_zeros (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r L g c d U U' V V' : means value ->
  has_finite_zeros n m p r L g c d U U' V V' -> let S := system_of value n m p L in
  [/\ \rank (transfer S) = r, gcd_of_minors_of_order (n + r) (pencil S) (polynomial_of value g) & polynomial_of value g \is monic].
Proof. move=> meaning; exact: (FieldZeros.has_finite_zeros_sound meaning). Qed.

(** The orders of the infinite zeros, one by one: as many as the normal rank, ascending, and the highest power of q that divides the minors
    of order n + j of the pencil at infinity is the sum of the first j *)
Theorem field_infinite_zeros (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p orders L d U U' V V' : means value ->
  has_infinite_zeros n m p orders L d U U' V V' -> let S := system_of value n m p L in
  \rank (transfer S) = size orders /\
  forall j e, (j <= size orders)%N -> divides_minors_of_order (n + j) (pencil_at_infinity S) 'X^e <-> (e <= sumn (take j orders))%N.
Proof. move=> meaning; exact: (FieldInfiniteZeros.has_infinite_zeros_sound meaning). Qed.

(** A line of faults: left-invertible with a F + b F' and a G + b G' for every (a : b) other than (0, 0), a and b in any field in which the
    numbers mean something, so over every extension of the one that they are from *)
Theorem field_left_invertible_line (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p L L' points others : means value ->
  is_left_invertible_line n m p L L' points others -> let S := system_of value n m p L in let S' := system_of value n m p L' in
  forall a b : K, (a != 0) || (b != 0) -> left_invertible (with_faults S (a *: sysF S + b *: sysF S') (a *: sysG S + b *: sysG S')).
Proof. move=> meaning; exact: (FieldLines.is_left_invertible_line_sound meaning). Qed.
