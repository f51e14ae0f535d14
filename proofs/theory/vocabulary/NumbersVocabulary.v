(** What the headlines on certificates over other fields (HeadlinesFields.v) speak of, beside the words of Vocabulary.v: systems told by
    lists of numbers of a kind that can be computed with, what these mean in a field, and the checks that the kernel of Rocq computes.

    To know what is claimed it takes the first two parts alone, of finite zeros polynomial_of too, and number of CertificatesVocabulary.v:
    which numbers there are and which system a list means. The checks are functions to true or false, of which nobody needs to believe
    anything.

                                            arithmetic, means, residues == numbers to compute with, what they mean, integers modulo l
    fraction_in, lowest, fraction_plus, fraction_mult, fraction_inverse == rational numbers as pairs of integers
                                 rational_polynomial, value_at, trimmed == rational polynomials by their coefficients
                 polynomial_plus, polynomial_multiple, polynomial_minus == their sums and multiples
              times_root, polynomial_mult, polynomial_euclid, algebraic == the same in a root of f
                                         at_place, vector_of, matrix_of == what lists of numbers mean
                                          listing, system_of, signal_of == a system by its tables, what it means, and a signal
      num, vector, table, sum, multiple, inner, row_times, times_column == arithmetic of vectors and tables
           is_one, invertible, blank, formed, sized, same, seen_nonzero == one, zero, of the sizes told, equal or not
                                                    outputs, trajectory == the outputs and the states from x under faults
                                         costates, effect, annihilating == Horner's rule on a row, and whether it annihilates
                    side_by_side, places_at, is_triangular, is_diagonal == vectors and tables at places
                               led_by, square_at, combination, has_rank == the rank of a table
            kernel_rows, words, leading_at, ascend, leading_independent == kernel rows and words as lists
                   outputs_at, possible, allowed, all_there_are, within == which rows and words a system has, and what they bound
                                   has_window_ranks, is_left_invertible == the ranks of windows, left-invertibility
          conditions, in_echelon_form, solve_conditions, are_solutions,
                                                   are_solutions_beyond == the solutions of problem (11)
                                   is_included, are_equal, are_equal_on == two behaviours, for ever and on one window
                                                         paired, differ == a word that a row of the other denies
                                         is_not_left_invertible, unseen == faults that nobody sees
                                gives, inverts, has_delay, has_no_delay == an inverse with a delay, and that there is none
      in_line, unit_row, unit_pulse, reached_by, free_rows, forced_rows == the rows of named matrices
            observability_has_rank, toeplitz_has_rank, window_has_rank,
            reachability_has_rank, hankel_has_rank, excitation_has_rank == their ranks
                                  convolved, polynomials, polynomial_of == polynomials as numbers, and what they mean
               equal_tables, table_product, diagonal_table, pencil_rows == tables of polynomials
      is_diagonalized, nonzero_places, has_finite_zeros, infinity_rows,
                                          valuation, has_infinite_zeros == its diagonal form, and that at infinity
              states_at, faults_along, constants, line_point, shown_at,
                                                is_left_invertible_line == a line of faults, point by point *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype bigop zmodp ssralg poly matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary CertificatesVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** Numbers *)

(** Numbers that can be computed with. Nothing is asked of the inverse: where it is used, it is looked at. *)
Record arithmetic := Arithmetic { numeral : eqType; zero : numeral; one : numeral; plus : numeral -> numeral -> numeral;
  minus : numeral -> numeral -> numeral; mult : numeral -> numeral -> numeral; inverse_of : numeral -> numeral;
  vanishes : numeral -> bool }.

(** What they mean in a field: sums are sums, products are products, and what vanishes is zero. *)
Record means (R : arithmetic) (K : fieldType) (value : numeral R -> K) : Prop := Means {
  value_zero : value (zero R) = 0; value_one : value (one R) = 1;
  value_plus : forall a b, value (plus a b) = value a + value b; value_minus : forall a b, value (minus a b) = value a - value b;
  value_mult : forall a b, value (mult a b) = value a * value b; value_vanishes : forall a, vanishes a -> value a = 0 }.

(** Integers modulo l. They mean what integers mean in a field where l is zero: the field with l elements, where l is a prime, and those
    that contain it. *)
Definition residues (l : Z) : arithmetic :=
  @Arithmetic _ Z0 (Zpos xH) (fun a b => Z.modulo (Z.add a b) l) (fun a b => Z.modulo (Z.sub a b) l)
    (fun a b => Z.modulo (Z.mul a b) l) (inverse_modulo l) (fun a => Z.eqb (Z.modulo a l) Z0).

(** Rational numbers as pairs of integers, numerator and denominator, in lowest terms; a pair whose denominator is zero stands for zero. *)
Definition fraction_in (K : fieldType) (c : Z * Z) : K := number K c.1 / number K c.2.
Definition lowest (c : Z * Z) : Z * Z := if Z.eqb c.2 (Zpos xH) then c else let g := Z.gcd c.1 c.2 in (Z.div c.1 g, Z.div c.2 g).
Definition fraction_plus (b c : Z * Z) : Z * Z :=
  if Z.eqb b.2 Z0 then c else if Z.eqb c.2 Z0 then b else lowest (Z.add (Z.mul b.1 c.2) (Z.mul c.1 b.2), Z.mul b.2 c.2).
Definition fraction_mult (b c : Z * Z) : Z * Z := lowest (Z.mul b.1 c.1, Z.mul b.2 c.2).
Definition fraction_inverse (c : Z * Z) : Z * Z := if Z.ltb c.1 Z0 then (Z.opp c.2, Z.opp c.1) else (c.2, c.1).

(** Polynomials in a by their coefficients, zeros at the end left out: values, sums, multiples, and a times one where f(a) = 0. *)
Notation rational_polynomial := (seq (Z * Z)).
Fixpoint value_at (K : fieldType) (a : K) (u : rational_polynomial) : K := if u is c :: u' then fraction_in K c + a * value_at a u' else 0.
Definition trimmed (u : rational_polynomial) : rational_polynomial :=
  foldr (fun c rest => if nilp rest && Z.eqb c.1 Z0 then [::] else c :: rest) [::] u.
Fixpoint polynomial_plus (u v : rational_polynomial) : rational_polynomial :=
  match u, v with [::], _ => v | _, [::] => u | b :: u', c :: v' => fraction_plus b c :: polynomial_plus u' v' end.
Definition polynomial_multiple (c : Z * Z) (u : rational_polynomial) : rational_polynomial := map (fraction_mult c) u.
Definition polynomial_minus (u v : rational_polynomial) := trimmed (polynomial_plus u (polynomial_multiple (Zneg xH, Zpos xH) v)).
Definition times_root (f u : rational_polynomial) : rational_polynomial :=
  let v := (Z0, Zpos xH) :: u in polynomial_minus v (polynomial_multiple (nth (Z0, Zpos xH) v (size f).-1) f).
Fixpoint polynomial_mult (f u v : rational_polynomial) : rational_polynomial :=
  if u is c :: u' then trimmed (polynomial_plus (polynomial_multiple c v) (times_root f (polynomial_mult f u' v))) else [::].

(** An inverse, by Euclid: u and v times a number are b and c up to multiples of f. *)
Fixpoint polynomial_euclid (fuel : nat) (f b u c v : rational_polynomial) : rational_polynomial :=
  if fuel is fuel'.+1 then if b is [:: b0] then polynomial_multiple (fraction_inverse b0) u else
    if (size b < size c)%N then polynomial_euclid fuel' f c v b u else
    let q := fraction_mult (last (Z0, Zpos xH) b) (fraction_inverse (last (Z0, Zpos xH) c)) in let k := (size b - size c)%N in
    polynomial_euclid fuel' f (polynomial_minus b (polynomial_multiple q (ncons k (Z0, Zpos xH) c)))
      (polynomial_minus u (polynomial_multiple q (iter k (times_root f) v))) c v
  else [::].

(** Rational polynomials in a root of f, which has the leading coefficient 1. They mean their values at a root of f in any field of
    characteristic 0; where f is irreducible, the field that the root generates is Q(a). *)
Definition algebraic (f : rational_polynomial) : arithmetic :=
  @Arithmetic _ ([::] : rational_polynomial) [:: (Zpos xH, Zpos xH)] (fun u v => trimmed (polynomial_plus u v)) polynomial_minus
    (polynomial_mult f) (fun u => polynomial_euclid (6 * size f) f f [::] u [:: (Zpos xH, Zpos xH)]) (all (fun c => Z.eqb c.1 Z0)).

(** ** What lists of numbers mean *)

Section Meaning.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).

(** A list stands for a vector of any length, zero where the list ends; a matrix is told by its rows. *)
Definition at_place (u : seq (numeral R)) (j : nat) : numeral R := nth (zero R) u j.
Definition vector_of k (u : seq (numeral R)) : 'rV[K]_k := \row_j value (at_place u j).
Definition matrix_of a b (M : seq (seq (numeral R))) : 'M[K]_(a, b) := \matrix_(i, j) value (at_place (nth [::] M i) j).

(** The tables of A, F, C, G, and the system with n states, m faults and p outputs that they mean. *)
Record listing := Listing { tA : seq (seq (numeral R)); tF : seq (seq (numeral R)); tC : seq (seq (numeral R));
  tG : seq (seq (numeral R)) }.
Definition system_of n m p (L : listing) : system K n m p :=
  System (matrix_of n n (tA L)) (matrix_of m n (tF L)) (matrix_of n p (tC L)) (matrix_of m p (tG L)).

(** A signal, told by its first samples, and zero afterwards. *)
Definition signal_of k (vs : seq (seq (numeral R))) (j : nat) : 'rV[K]_k := vector_of k (nth [::] vs j).

End Meaning.

(** ** The checks: arithmetic on lists *)

Section Checks.
Variable R : arithmetic.
Notation num := (numeral R).
Notation vector := (seq num).
Notation table := (seq vector).

Implicit Types (u v x : vector) (M T : table) (L : listing R).

(** u + v, a u, the inner product, a row times a matrix, a matrix times a column. *)
Fixpoint sum u v : vector := match u, v with [::], _ => v | _, [::] => u | a :: u', b :: v' => plus a b :: sum u' v' end.
Definition multiple (a : num) u : vector := map (mult a) u.
Fixpoint inner u v : num := if u is a :: u' then if v is b :: v' then plus (mult a b) (inner u' v') else zero R else zero R.
Fixpoint row_times x M : vector := if x is a :: x' then if M is r :: M' then sum (multiple a r) (row_times x' M') else [::] else [::].
Definition times_column M x : vector := map (inner^~ x) M.

(** Whether a number is one, or has an inverse; whether u is zero, M has a rows of b entries, the tables of L have the sizes told. *)
Definition is_one (a : num) : bool := vanishes (minus a (one R)).
Definition invertible (a : num) : bool := is_one (mult a (inverse_of a)).
Definition blank u : bool := all (@vanishes R) u.
Definition formed (a b : nat) M : bool := (size M == a) && all (fun r => size r == b) M.
Definition sized n m p L : bool := [&& formed n n (tA L), formed m n (tF L), formed n p (tC L) & formed m p (tG L)].

(** Whether two vectors of the same length are equal; whether v has m entries, some of which is invertible. *)
Fixpoint same u v : bool := match u, v with [::], [::] => true | a :: u', b :: v' => vanishes (minus a b) && same u' v' | _, _ => false end.
Definition seen_nonzero m v : bool := (size v == m) && has invertible v.

(** The outputs from x under the faults vs; the states; the last of them. *)
Fixpoint outputs L x (vs : table) : table :=
  if vs is v :: vs' then sum (row_times x (tC L)) (row_times v (tG L)) :: outputs L (sum (row_times x (tA L)) (row_times v (tF L))) vs'
  else [::].
Fixpoint trajectory L x (vs : table) : table :=
  if vs is v :: vs' then x :: trajectory L (sum (row_times x (tA L)) (row_times v (tF L))) vs' else [:: x].

(** Horner's rule, X_k = C c_k + A X_(k+1), and the conditions (X_(k+1), c_k), on which a fault acts by F X_(k+1) + G c_k. The row c_0, ...,
    c_mu annihilates L where X_0 and what acts are zero. *)
Fixpoint costates L (c : table) : vector * seq (vector * vector) :=
  if c is c0 :: c' then let (X, ds) := costates L c' in (sum (times_column (tC L) c0) (times_column (tA L) X), (X, c0) :: ds)
  else ([::], [::]).
Definition effect F G (d : vector * vector) : vector := sum (times_column F d.1) (times_column G d.2).
Definition annihilating L (c : table) : bool :=
  let (X, ds) := costates L c in blank X && all (fun d => blank (effect (tF L) (tG L) d)) ds.

(** A condition as one vector of n + p numbers; entries at pivots; a table is triangular, or diagonal, with an invertible diagonal. *)
Definition side_by_side n (d : vector * vector) : vector := mkseq (at_place d.1) n ++ d.2.
Definition places_at (pivots : seq nat) u : vector := map (at_place u) pivots.
Definition is_triangular M : bool := all (fun i =>
  invertible (at_place (nth [::] M i) i) && all (fun j => vanishes (at_place (nth [::] M i) j)) (iota 0 i)) (iota 0 (size M)).
Definition is_diagonal M : bool := all (fun i => all (fun j =>
  if i == j then invertible (at_place (nth [::] M i) j) else vanishes (at_place (nth [::] M i) j)) (iota 0 (size M))) (iota 0 (size M)).

(** The rank of a table: vectors that it sends to zero bound it from above, combinations of its rows that are diagonal at some
    columns from below. *)
Notation led_by := (seq (nat * vector)).
Definition square_at (us : led_by) : table := [seq places_at [seq other.1 | other <- us] one.2 | one <- us].
Definition combination T (us : led_by) : led_by := [seq (one.1, row_times one.2 T) | one <- us].
Definition has_rank a b (r : nat) T (nulls combinations : led_by) : bool :=
  [&& formed a b T, all (fun c => c.1 < b)%N nulls, all (fun c => c.1 < b)%N combinations, (size nulls + r == b)%N
    & size combinations == r]
  && [&& all (fun row => all (fun c => vanishes (inner row c.2)) nulls) T, is_triangular (square_at nulls)
    & is_diagonal (square_at (combination T combinations))].

(** ** The checks: kernel rows and words *)

(** Kernel rows, each a pivot and coefficients, ascend in degree, and their leading coefficients are independent by the pivots: with zeros
    below the diagonal, or with a table that makes that of leading coefficients at the pivots diagonal. *)
Notation kernel_rows := (seq (nat * table)).
Notation words := (seq ((vector * table) * (nat * nat))).
Definition leading_at (rows : kernel_rows) : table := [seq places_at [seq other.1 | other <- rows] (last [::] row.2) | row <- rows].
Definition ascend p (rows : kernel_rows) : bool :=
  all (fun row => (row.1 < p) && (0 < size row.2))%N rows && sorted leq [seq size row.2 | row <- rows].
Definition leading_independent (rows : kernel_rows) (Q : option table) : bool :=
  if Q is Some Q' then (size Q' == size rows) && is_diagonal [seq row_times q (leading_at rows) | q <- Q']
  else is_triangular (leading_at rows).

(** Words of s samples, each an initial state, faults, and the sample and output where it alone is not zero; that are as many
    as the kernel rows allow. *)
Definition outputs_at (pivots : seq (nat * nat)) (rs : table) : vector := [seq at_place (nth [::] rs k.1) k.2 | k <- pivots].
Definition possible p s L (ws : words) : bool := all (fun w => [&& size w.1.2 == s, w.2.1 < s & w.2.2 < p])%N ws
  && is_diagonal [seq outputs_at [seq other.2 | other <- ws] (outputs L w.1.1 w.1.2) | w <- ws].
Definition allowed p (rows : kernel_rows) s : nat := sumn [seq p - count (fun row => size row.2 <= k.+1) rows | k <- iota 0 s]%N.

(** What is said of the rows of one system at one window: they are all there are. *)
Definition all_there_are n m p s L (rows : kernel_rows) (Q : option table) (ws : words) : bool :=
  [&& sized n m p L, ascend p rows, leading_independent rows Q, all (fun row => annihilating L row.2) rows
    & possible p s L ws && (size ws == allowed p rows s)].
Definition within s (rows : kernel_rows) : bool := all (fun row => size row.2 <= s)%N rows.

(** ** The checks: ranks of windows, left-invertibility *)

(** The ranks of all windows by kernel rows and words of n + 1 samples; words enough to see that the system is left-invertible. *)
Definition has_window_ranks n m p r (etas ranks : seq nat) L rows Q ws : bool := all_there_are n m p n.+1 L rows Q ws &&
  [&& (r + size rows == p)%N, [seq (size row.2).-1 | row <- rows] == etas
    & ranks == [seq (s * r + sumn [seq minn s eta | eta <- etas])%N | s <- iota 1 (size ranks)]].
Definition is_left_invertible n m p L ws : bool := [&& sized n m p L, possible p n.+1 L ws & (n.+1 * m <= size ws)%N].

(** ** The checks: solutions of problem (11) *)

(** The conditions of all rows. The basis is in reduced row echelon form and vanishes on them; combinations of them are diagonal at
    some entries. *)
Definition conditions n L (rows : kernel_rows) : table := flatten [seq map (side_by_side n) (costates L row.2).2 | row <- rows].
Definition in_echelon_form (width : nat) T (pivots : seq nat) : bool :=
  [&& all (fun r => size r == width) T, size pivots == size T, sorted ltn pivots, all (fun j => j < width)%N pivots
    & all (fun i => [&& all (fun j => vanishes (at_place (nth [::] T i) j)) (iota 0 (nth 0%N pivots i))
      & all (fun a => let x := at_place (nth [::] T a) (nth 0%N pivots i) in if a == i then is_one x else vanishes x) (iota 0 (size T))])
      (iota 0 (size T))].
Definition solve_conditions n p L rows (basis : table) pivots (combinations : led_by) : bool :=
  let cs := conditions n L rows in
  [&& in_echelon_form (n + p) basis pivots, all (fun b => all (fun c => vanishes (inner b c)) cs) basis,
    (size basis + size combinations == n + p)%N, all (fun c => c.1 < n + p)%N combinations
    & is_diagonal (square_at (combination cs combinations))].
Definition are_solutions n m p s L rows Q ws basis pivots combinations : bool :=
  [&& all_there_are n m p s L rows Q ws, within s rows & solve_conditions n p L rows basis pivots combinations].
Definition are_solutions_beyond n m p beyond L rows Q ws basis pivots combinations : bool :=
  [&& all_there_are n m p n.+1 L rows Q ws, within beyond.+1 rows & solve_conditions n p L rows basis pivots combinations].

(** ** The checks: two behaviours *)

(** Inclusion and equality for ever, equality on one window. *)
Definition is_included n m n' m' p L L' rows Q ws : bool :=
  [&& all_there_are n' m' p n'.+1 L' rows Q ws, sized n m p L & all (fun row => annihilating L row.2) rows].
Definition are_equal n m n' m' p L L' rows Q ws ws' : bool :=
  all_there_are n m p n.+1 L rows Q ws && all_there_are n' m' p n'.+1 L' rows Q ws'.
Definition are_equal_on n m n' m' p s L L' rows Q ws ws' : bool :=
  [&& within s rows, all_there_are n m p s L rows Q ws & all_there_are n' m' p s L' rows Q ws'].

(** The row c over the outputs of a word: a word of the first that a row of the second denies. *)
Definition paired (c rs : table) : num := foldr (@plus R) (zero R) [seq inner uv.1 uv.2 | uv <- zip rs c].
Definition differ n m n' m' p s L L' x vs c : bool :=
  [&& sized n m p L, sized n' m' p L', annihilating L' c, (0 < size c <= s)%N & size vs == s]
  && [&& all (fun r => size r <= p)%N (outputs L x vs) & invertible (paired c (outputs L x vs))].

(** ** The checks: inversion *)

(** Faults from rest that nobody sees, back to rest, and the states meanwhile; faults that s samples do not show. *)
Definition is_not_left_invertible n m p L (xs vs : table) : bool :=
  [&& sized n m p L, all blank (outputs L [::] vs), blank (last [::] (trajectory L [::] vs)), has (seen_nonzero m) vs
    & all2 (fun x y => blank (sum x (multiple (minus (zero R) (one R)) y))) (trajectory L [::] vs) xs].
Definition unseen n m p known s L x (vs : table) : bool :=
  [&& sized n m p L, size vs == s, all blank (outputs L x vs), seen_nonzero m (head [::] vs) & known ==> blank x].

(** Row i of the inverse gives v_i(0). *)
Definition gives m (known : bool) l L i (row : table) : bool :=
  let (X, ds) := costates L row in
  [&& size row == l.+1, known || blank X, all (fun d => blank (effect (tF L) (tG L) d)) (behead ds)
    & same (effect (tF L) (tG L) (head ([::], [::]) ds)) (mkseq (fun j => if j == i then one R else zero R) m)].
Definition inverts n m p known l L (rows : seq table) : bool :=
  [&& sized n m p L, size rows == m & all (fun i => gives m known l L i (nth [::] rows i)) (iota 0 m)].
Definition has_delay n m p known l L rows x vs : bool :=
  [&& (l <= n)%N, inverts n m p known l L rows & (l == 0%N) || unseen n m p known l L x vs].
Definition has_no_delay n m p known L x vs : bool := unseen n m p known n.+1 L x vs.

(** ** The checks: ranks of named matrices *)

(** Samples one after the other; unit vectors and pulses; the rows F, F A, ... *)
Definition in_line p (us : table) : vector := flatten [seq mkseq (at_place u) p | u <- us].
Definition unit_row n i : vector := mkseq (fun j => if j == i then one R else zero R) n.
Definition unit_pulse m s (i : nat) : table := [seq if k == (i %/ m)%N then unit_row m (i %% m)%N else [::] | k <- iota 0 s].
Fixpoint reached_by (k : nat) L M : table := if k is k'.+1 then M ++ reached_by k' L [seq row_times r (tA L) | r <- M] else [::].
Definition free_rows n p s L : table := [seq in_line p (outputs L (unit_row n i) (nseq s [::])) | i <- iota 0 n].
Definition forced_rows m p s L : table := [seq in_line p (outputs L [::] (unit_pulse m s i)) | i <- iota 0 (s * m)].

(** The ranks of O_n, T_s, [O_s T_s] and reachability, and of a trajectory those of R_s and [X V_s]. *)
Definition observability_has_rank n m p r L nulls combinations : bool :=
  sized n m p L && has_rank n (n * p) r (free_rows n p n L) nulls combinations.
Definition toeplitz_has_rank n m p s r L nulls combinations : bool :=
  sized n m p L && has_rank (s * m) (s * p) r (forced_rows m p s L) nulls combinations.
Definition window_has_rank n m p s r L nulls combinations : bool :=
  sized n m p L && has_rank (n + s * m) (s * p) r (free_rows n p s L ++ forced_rows m p s L) nulls combinations.
Definition reachability_has_rank n m p r L nulls combinations : bool :=
  sized n m p L && has_rank (n * m) n r (reached_by n L (tF L)) nulls combinations.
Definition hankel_has_rank n m p N s r L x vs nulls combinations : bool :=
  [&& sized n m p L, (N + s == (size vs).+1)%N & has_rank N (s * p) r
    [seq in_line p (take s (drop i (outputs L x vs))) | i <- iota 0 N] nulls combinations].
Definition excitation_has_rank n m p N s r L x vs nulls combinations : bool :=
  [&& sized n m p L, (N + s == (size vs).+1)%N & has_rank N (n + s * m) r
    [seq mkseq (at_place (nth [::] (trajectory L x vs) i)) n ++ in_line m (take s (drop i vs)) | i <- iota 0 N] nulls combinations].

End Checks.

(** ** Polynomials, and the checks of finite and infinite zeros *)

(** Polynomials by their coefficients are numbers themselves: they mean elements of the field of rational functions. *)
Fixpoint convolved (R : arithmetic) (u v : seq (numeral R)) : seq (numeral R) :=
  if u is a :: u' then sum (multiple a v) (zero R :: convolved u' v) else [::].
Definition polynomials (R : arithmetic) : arithmetic :=
  @Arithmetic _ ([::] : seq (numeral R)) [:: one R] (@sum R) (fun u v => sum u (multiple (minus (zero R) (one R)) v)) (@convolved R)
    id (@blank R).
Definition polynomial_of (R : arithmetic) (K : fieldType) (value : numeral R -> K) (u : seq (numeral R)) : {poly K} :=
  \poly_(i < size u) value (at_place u i).

Section PolynomialChecks.
Variable R : arithmetic.

(** Equal entries; a product; a table with d on its diagonal; the pencil [q - A, C; -F, G]. *)
Definition equal_tables (Q : arithmetic) (a b : nat) (X T : seq (seq (numeral Q))) : bool := all (fun i => all (fun j =>
  vanishes (minus (at_place (nth [::] X i) j) (at_place (nth [::] T i) j))) (iota 0 b)) (iota 0 a).
Definition table_product (Q : arithmetic) (X T : seq (seq (numeral Q))) : seq (seq (numeral Q)) := [seq row_times x T | x <- X].
Definition diagonal_table (a b : nat) (d : seq (seq (numeral R))) : seq (seq (seq (numeral R))) :=
  [seq mkseq (fun j => if j == i then nth [::] d i else [::]) b | i <- iota 0 a].
Definition pencil_rows n m p (L : listing R) : seq (seq (seq (numeral R))) :=
  [seq mkseq (fun j => [:: minus (zero R) (at_place (nth [::] (tA L) i) j); if j == i then one R else zero R]) n
    ++ mkseq (fun j => [:: at_place (nth [::] (tC L) i) j]) p | i <- iota 0 n]
  ++ [seq mkseq (fun j => [:: minus (zero R) (at_place (nth [::] (tF L) i) j)]) n ++ mkseq (fun j => [:: at_place (nth [::] (tG L) i) j]) p
    | i <- iota 0 m].

(** U T V is diagonal, and U and V have inverses; the places of the diagonal that are not zero. *)
Definition is_diagonalized (a b : nat) (T : seq (seq (seq (numeral R)))) (d : seq (seq (numeral R)))
    (U U' V V' : seq (seq (seq (numeral R)))) : bool :=
  let P := polynomials R in
  [&& @formed P a a U, @formed P a a U', @formed P b b V & @formed P b b V']
  && [&& @equal_tables P a a (@table_product P U U') (diagonal_table a a (nseq a [:: one R])),
      @equal_tables P b b (@table_product P V V') (diagonal_table b b (nseq b [:: one R]))
    & @equal_tables P a b (@table_product P (@table_product P U T) V) (diagonal_table a b d)].
Definition nonzero_places (a b : nat) (d : seq (seq (numeral R))) : seq nat := [seq i <- iota 0 (minn a b) | ~~ blank (nth [::] d i)].

(** The diagonal form of the pencil has n + r entries that are not zero, with the product c g, g being monic. *)
Definition has_finite_zeros n m p r (L : listing R) (g : seq (numeral R)) (c : numeral R) (d : seq (seq (numeral R)))
    (U U' V V' : seq (seq (seq (numeral R)))) : bool :=
  let places := nonzero_places (n + m) (n + p) d in
  [&& is_diagonalized (n + m) (n + p) (pencil_rows n m p L) d U U' V V', all (fun i => has (@invertible R) (nth [::] d i)) places,
    size places == (n + r)%N, invertible c & is_one (last (zero R) g)]
  && blank (sum (multiple c g) (multiple (minus (zero R) (one R)) (foldr (@convolved R) [:: one R] [seq nth [::] d i | i <- places]))).

(** The pencil at infinity, [1 - q A, C; -q F, G]; the place of the first coefficient that is not zero. In the diagonal form of that pencil
    these places, ascending, are n zeros and the orders. *)
Definition infinity_rows n m p (L : listing R) : seq (seq (seq (numeral R))) :=
  [seq mkseq (fun j => [:: if j == i then one R else zero R; minus (zero R) (at_place (nth [::] (tA L) i) j)]) n
    ++ mkseq (fun j => [:: at_place (nth [::] (tC L) i) j]) p | i <- iota 0 n]
  ++ [seq mkseq (fun j => [:: zero R; minus (zero R) (at_place (nth [::] (tF L) i) j)]) n
    ++ mkseq (fun j => [:: at_place (nth [::] (tG L) i) j]) p | i <- iota 0 m].
Definition valuation (u : seq (numeral R)) : nat := find (fun x => ~~ vanishes x) u.
Definition has_infinite_zeros n m p (orders : seq nat) (L : listing R) (d : seq (seq (numeral R)))
    (U U' V V' : seq (seq (seq (numeral R)))) : bool :=
  let places := nonzero_places (n + m) (n + p) d in
  [&& is_diagonalized (n + m) (n + p) (infinity_rows n m p L) d U U' V V',
    all (fun i => invertible (at_place (nth [::] d i) (valuation (nth [::] d i)))) places
    & sort leq [seq valuation (nth [::] d i) | i <- places] == nseq n 0%N ++ orders].
End PolynomialChecks.

(** ** The check of lines of faults *)

Section LineChecks.
Variable R : arithmetic.

(** [c - A, C] at a point c; [-(F + t F'), G + t G'] as polynomials in t; numbers as polynomials. *)
Definition states_at n p (L : listing R) (c : numeral R) : seq (seq (numeral R)) :=
  [seq mkseq (fun j => minus (if j == i then c else zero R) (at_place (nth [::] (tA L) i) j)) n
    ++ mkseq (at_place (nth [::] (tC L) i)) p | i <- iota 0 n].
Definition faults_along n m p (L L' : listing R) : seq (seq (seq (numeral R))) :=
  [seq mkseq (fun j => [:: minus (zero R) (at_place (nth [::] (tF L) i) j); minus (zero R) (at_place (nth [::] (tF L') i) j)]) n
    ++ mkseq (fun j => [:: at_place (nth [::] (tG L) i) j; at_place (nth [::] (tG L') i) j]) p | i <- iota 0 m].
Definition constants (T : seq (seq (numeral R))) : seq (seq (seq (numeral R))) := [seq [seq [:: x] | x <- r] | r <- T].

(** What is told at a point c: W and Y with [c - A, C] W = 1 and [c - A, C] Y = 0, and polynomials Z and e in t with
    [-(F + t F'), G + t G'] Y Z = e. Where e is not zero the rows of the pencil at c are independent. *)
Record line_point := LinePoint { point : numeral R; undoing : seq (seq (numeral R)); unseen_by_states : seq (seq (numeral R));
  adjoint : seq (seq (seq (numeral R))); determinant_part : seq (numeral R) }.
Definition shown_at n m p (L L' : listing R) (x : line_point) : bool :=
  let N := states_at n p L (point x) in let P := polynomials R in
  [&& size (undoing x) == (n + p)%N, size (unseen_by_states x) == (n + p)%N & size (adjoint x) == m]
  && [&& equal_tables n n (table_product N (undoing x)) [seq unit_row R n i | i <- iota 0 n],
      equal_tables n m (table_product N (unseen_by_states x)) [::]
    & @equal_tables P m m (@table_product P (@table_product P (faults_along n m p L L') (constants (unseen_by_states x))) (adjoint x))
      (diagonal_table m m (nseq m (determinant_part x)))].

(** The faults F + t F', G + t G' for every t, because the parts e of all points have the sum 1; and F', G', because a part for F' + t F,
    G' + t G is not zero at t = 0. *)
Definition is_left_invertible_line n m p (L L' : listing R) (points others : seq line_point) : bool :=
  [&& sized n m p L, sized n m p L', tA L == tA L' & tC L == tC L']
  && ((m == 0%N) || [&& all (shown_at n m p L L') points,
    @is_one (polynomials R) (foldr (@sum R) [::] [seq determinant_part x | x <- points])
    & has (fun x => shown_at n m p L' L x && invertible (at_place (determinant_part x) 0)) others]).

End LineChecks.
