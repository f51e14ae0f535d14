(** What the headlines on certificates (HeadlinesChecks.v) speak of, beside the words of Vocabulary.v: systems over the rational numbers
    told by lists of integers, and the checks that the kernel of Rocq computes on such lists.

    To know what is claimed it takes the first part alone: which system, which vector a list means. The checks are functions to true
    or false, and the headlines say what follows where they give true, whatever else their arguments, the witnesses, may be; that they are
    the right checks is proved and need not be believed. They stand here because the statements name them.

                                                       vector, table, entry == lists of integers, and their entries
                                                number, vec, ratn, fraction == what these mean in a field, and over a denominator
                                                    listed, meant, recorded == a system by its tables, what it means, and a recorded
                                                                               vector
                                              add, scale, dot, times, apply == arithmetic of vectors and tables
                       null, shaped, well_formed, agree, all_agree, nonzero == zero, of the sizes told, equal or not
                                     simulate, simulate_modulo, states, run == the outputs and the states of the integer system
                                                          reduced, weighted == modulo l; a row times powers of the denominator
                                         horner, acts, demands, annihilated == Horner's rule on a row, and whether it annihilates the
                                                                               system
                             joined, at_pivots, triangular, identity_modulo == vectors and tables at places
                                         pivoted, led, combined, check_rank == the rank of a table
                  euclid, inverse_modulo, inverts_modulo, invertible_modulo == inverses modulo l
                                                      ready, is_determinant == determinants modulo l
                     kernel_row, sampled_word, degrees, leading, admissible == kernel rows and words as lists
                                   kernel, shorter, seen_at, words, ceiling == which rows and words a system has, and what they bound
                          horner_modulo, demands_modulo, annihilated_modulo == the same modulo l
                              states_of_rows, hints, pencil_table, is_minor == the states of rows, hints, and minors of the pencil
                                          pencil_minor, rank_shown, minimal == rows that are seen to be a minimal basis
                                          evidence, meets, follows, generic == what shows a lower bound, and what follows from rows
                              check_window_ranks, check_window_ranks_modulo == the ranks of windows
                            check_left_invertible, check_left_invertible_at == left-invertibility
                         all_demands, reduced_echelon, solution_space, kept == the solutions of problem (11)
                                               check_solutions, check_limit == at one window, and at all later ones
                     check_inclusion, check_equality, check_window_equality == two behaviours, for ever and on one window
                                                  pairing, check_difference == a word that a row of the other denies
                                       check_not_left_invertible, ambiguous == faults that nobody sees
                          gives_entry, inverse, check_delay, check_no_delay == an inverse with a delay, and that there is none
        flat, basis_vector, powered, reachability_rows, visited, free_table == the rows of named matrices
    check_observability, check_reachability, check_hankel, check_excitation == their ranks *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path fintype bigop zmodp ssralg ssrint rat matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** What lists of integers mean *)

(** A vector, and a matrix by its rows. A list stands for a vector of any length, zero where the list ends. *)
Definition vector := seq Z.
Definition table := seq vector.
Definition entry (u : vector) (j : nat) : Z := nth Z0 u j.

(** An integer in a field, and a list as a row vector of k entries. *)
Definition number (K : fieldType) (z : Z) : K := (int_of_Z z)%:~R.
Definition vec (K : fieldType) k (u : vector) : 'rV[K]_k := \row_j number K (entry u j).
Notation ratn := (number (field_of rat)) (only parsing).

(** A table over the denominator e, as a matrix. *)
Definition fraction (e : Z) a b (M : table) : 'M[rat]_(a, b) := \matrix_(i, j) (ratn (entry (nth [::] M i) j) / ratn e).

(** The tables of A, F, C, G over one denominator, and the system with n states, m faults and p outputs that they mean. *)
Record listed := Listed { den : Z; lA : table; lF : table; lC : table; lG : table }.
Definition meant n m p (L : listed) : system (field_of rat) n m p :=
  System (fraction (den L) n n (lA L)) (fraction (den L) m n (lF L)) (fraction (den L) n p (lC L)) (fraction (den L) m p (lG L)).

(** A vector of integers over the denominator d: of a recorded trajectory. *)
Definition recorded (d : Z) k (u : vector) : 'rV[rat]_k := (ratn d)^-1 *: vec (field_of rat) k u.

(** ** The checks: arithmetic on lists *)

(** u + v, a u and the inner product. *)
Fixpoint add (u v : vector) : vector :=
  match u, v with [::], _ => v | _, [::] => u | a :: u', b :: v' => Z.add a b :: add u' v' end.
Definition scale (a : Z) (u : vector) : vector := map (Z.mul a) u.
Fixpoint dot (u v : vector) : Z := if u is a :: u' then if v is b :: v' then Z.add (Z.mul a b) (dot u' v') else Z0 else Z0.

(** A row times a matrix, a matrix times a column. *)
Fixpoint times (x : vector) (M : table) : vector :=
  if x is a :: x' then if M is r :: M' then add (scale a r) (times x' M') else [::] else [::].
Definition apply (M : table) (x : vector) : vector := map (dot^~ x) M.

(** Whether u is zero, M has a rows of b entries, the tables of L have the sizes told, two vectors agree, v has m entries that are not
    all zero. *)
Definition null (u : vector) : bool := all (pred1 Z0) u.
Definition shaped (a b : nat) (M : table) : bool := (size M == a) && all (fun r => size r == b) M.
Definition well_formed n m p (L : listed) : bool :=
  [&& den L != Z0, shaped n n (lA L), shaped m n (lF L), shaped n p (lC L) & shaped m p (lG L)].
Definition agree (u v : vector) : bool := null (add u (scale (Zneg xH) v)).
Fixpoint all_agree (us vs : seq vector) : bool :=
  match us, vs with [::], [::] => true | u :: us', v :: vs' => agree u v && all_agree us' vs' | _, _ => false end.
Definition nonzero m (v : vector) : bool := (size v == m) && ~~ null v.

(** The outputs from x under the faults vs, of the integer system; the same modulo l, to keep the numbers small; its states; the last
    of them. *)
Fixpoint simulate (L : listed) (x : vector) (vs : seq vector) : seq vector :=
  if vs is v :: vs' then add (times x (lC L)) (times v (lG L)) :: simulate L (add (times x (lA L)) (times v (lF L))) vs' else [::].
Definition reduced (l : Z) (u : vector) : vector := [seq Z.modulo a l | a <- u].
Fixpoint simulate_modulo (l : Z) (L : listed) (x : vector) (vs : seq vector) : seq vector :=
  if vs is v :: vs' then reduced l (add (times x (lC L)) (times v (lG L)))
    :: simulate_modulo l L (reduced l (add (times x (lA L)) (times v (lF L)))) vs' else [::].
Fixpoint states (L : listed) (x : vector) (vs : seq vector) : seq vector :=
  if vs is v :: vs' then x :: states L (add (times x (lA L)) (times v (lF L))) vs' else [:: x].
Fixpoint run (L : listed) (x : vector) (vs : seq vector) : vector :=
  if vs is v :: vs' then run L (add (times x (lA L)) (times v (lF L))) vs' else x.

(** A row c_0, ..., c_mu becomes e^mu c_0, ..., e c_(mu-1), c_mu; then Horner's rule: X_k = C c_k + A X_(k+1) and the demands (X_(k+1),
    c_k), on which a fault acts by F X_(k+1) + G c_k. The row annihilates L where all of this is zero. *)
Fixpoint weighted (e : Z) (c : seq vector) : Z * seq vector :=
  if c is c0 :: c' then let (w, cs) := weighted e c' in (Z.mul w e, scale w c0 :: cs) else (Zpos xH, [::]).
Fixpoint horner (L : listed) (c : seq vector) : vector * seq (vector * vector) :=
  if c is c0 :: c' then let (X, ds) := horner L c' in (add (apply (lC L) c0) (apply (lA L) X), (X, c0) :: ds) else ([::], [::]).
Definition acts (F G : table) (d : vector * vector) : vector := add (apply F d.1) (apply G d.2).
Definition demands (L : listed) (c : seq vector) := horner L (weighted (den L) c).2.
Definition annihilated (L : listed) (c : seq vector) : bool :=
  let (X, ds) := demands L c in null X && all (fun d => null (acts (lF L) (lG L) d)) ds.

(** A demand as one vector of n + p integers. *)
Definition joined n (d : vector * vector) : vector := mkseq (entry d.1) n ++ d.2.

(** Entries at the pivots; a table is triangular without a zero on its diagonal; it is the identity modulo l. *)
Definition at_pivots (pivots : seq nat) (u : vector) : vector := map (entry u) pivots.
Definition triangular (M : table) : bool :=
  all (fun i => (entry (nth [::] M i) i != Z0) && all (fun j => entry (nth [::] M i) j == Z0) (iota 0 i)) (iota 0 (size M)).
Definition identity_modulo (l : Z) (M : table) : bool :=
  Z.ltb 1 l && all (fun i => all (fun j => Z.modulo (Z.sub (entry (nth [::] M i) j) (if i == j then Zpos xH else Z0)) l == Z0 :> Z)
    (iota 0 (size M))) (iota 0 (size M)).

(** The rank of a table: vectors that it sends to zero bound it from above, combinations of its rows that are the identity at some
    columns modulo l from below. *)
Notation pivoted := (seq (nat * vector)).
Definition led (us : pivoted) : table := [seq at_pivots [seq other.1 | other <- us] u.2 | u <- us].
Definition combined (T : table) (us : pivoted) : pivoted := [seq (u.1, times u.2 T) | u <- us].
Definition check_rank a b (r : nat) (l : Z) (T : table) (nulls combinations : pivoted) : bool :=
  [&& shaped a b T, all (fun c => c.1 < b)%N nulls, all (fun u => u.1 < b)%N combinations, (size nulls + r == b)%N
    & size combinations == r]
  && [&& all (fun row => all (fun c => dot row c.2 == Z0) nulls) T, triangular (led nulls)
    & identity_modulo l (led (combined T combinations))].

(** ** The checks: determinants modulo l *)

(** An inverse of a modulo l where there is one, by Euclid: x a_0 = a and y a_0 = b throughout. It is looked at before it is used. *)
Fixpoint euclid (fuel : nat) (a b x y : Z) : Z :=
  if fuel is fuel'.+1 then if Z.eqb b Z0 then x else
    let q := Z.div a b in euclid fuel' b (Z.sub a (Z.mul q b)) y (Z.sub x (Z.mul q y)) else x.
Definition inverse_modulo (l a : Z) : Z := Z.modulo (euclid 128 l (Z.modulo a l) Z0 (Zpos xH)) l.
Definition inverts_modulo (l a b : Z) : bool := Z.eqb (Z.modulo (Z.sub (Z.mul a b) (Zpos xH)) l) Z0.
Definition invertible_modulo (l a : Z) : bool := inverts_modulo l a (inverse_modulo l a).

(** The row r, with another one added where its own first entry is not invertible; whether the determinant of k rows is d modulo l. Where l
    is not a prime the answer may be false without need. *)
Definition ready (l : Z) (r : vector) (rows : table) : vector :=
  if invertible_modulo l (entry r 0) then r else add r (head [::] [seq other <- rows | invertible_modulo l (entry other 0)]).
Fixpoint is_determinant (l : Z) (k : nat) (rows : table) (d : Z) : bool :=
  if k is k'.+1 then if rows is r :: others then
    let lead := ready l r others in let b := inverse_modulo l (entry lead 0) in
    (size others == k') && if inverts_modulo l (entry lead 0) b then
      is_determinant l k' [seq reduced l (add (behead other) (scale (Z.modulo (Z.opp (Z.mul (entry other 0) b)) l) (behead lead)))
        | other <- others] (Z.modulo (Z.mul d b) l)
    else all (fun other => Z.eqb (Z.modulo (entry other 0) l) Z0) rows && Z.eqb (Z.modulo d l) Z0
  else false else Z.eqb (Z.modulo (Z.sub d (Zpos xH)) l) Z0.

(** ** The checks: kernel rows and words *)

(** A kernel row: pivot and coefficients; a word: initial state, faults, and the sample and output where it has a one. *)
Definition kernel_row := (nat * seq vector)%type.
Definition sampled_word := ((vector * seq vector) * (nat * nat))%type.

(** The degrees of kernel rows, their leading coefficients, whether they bound the ranks of windows of a system, and are short. *)
Definition degrees (rows : seq kernel_row) : seq nat := [seq (size row.2).-1 | row <- rows].
Definition leading (rows : seq kernel_row) : table := [seq at_pivots [seq other.1 | other <- rows] (last [::] row.2) | row <- rows].
Definition admissible p (rows : seq kernel_row) : bool :=
  [&& all (fun row => (row.1 < p) && (0 < size row.2))%N rows, sorted leq [seq size row.2 | row <- rows] & triangular (leading rows)].
Definition kernel p (L : listed) (rows : seq kernel_row) : bool := admissible p rows && all (fun row => annihilated L row.2) rows.
Definition shorter s (rows : seq kernel_row) : bool := all (fun row => size row.2 <= s)%N rows.

(** Words of s samples that are independent modulo l; and that are as many as kernel rows allow. *)
Definition seen_at (pivots : seq (nat * nat)) (outputs : seq vector) : vector := [seq entry (nth [::] outputs k.1) k.2 | k <- pivots].
Definition words p s (l : Z) (L : listed) (ws : seq sampled_word) : bool :=
  [&& Z.eqb (Z.gcd (den L) l) (Zpos xH), all (fun w => [&& size w.1.2 == s, w.2.1 < s & w.2.2 < p])%N ws
    & identity_modulo l [seq seen_at [seq other.2 | other <- ws] (simulate_modulo l L w.1.1 w.1.2) | w <- ws]].
Definition ceiling p (rows : seq kernel_row) s : nat := sumn [seq p - count (fun row => size row.2 <= k.+1) rows | k <- iota 0 s]%N.

(** ** The checks: kernel rows seen to be a minimal basis modulo l *)

(** Horner's rule modulo l. *)
Fixpoint horner_modulo (l : Z) (L : listed) (c : seq vector) : vector * seq (vector * vector) :=
  if c is c0 :: c' then let (X, ds) := horner_modulo l L c' in
    (reduced l (add (apply (lC L) c0) (apply (lA L) X)), (X, c0) :: ds) else ([::], [::]).
Definition demands_modulo (l : Z) (L : listed) (c : seq vector) := horner_modulo l L [seq reduced l u | u <- (weighted (den L) c).2].
Definition annihilated_modulo (l : Z) (L : listed) (c : seq vector) : bool :=
  let (X, ds) := demands_modulo l L c in null X && all (fun d => null (reduced l (acts (lF L) (lG L) d))) ds.

(** The states X_1, ..., X_mu of all rows: what Horner's rule has before it comes to c_0. *)
Definition states_of_rows (l : Z) (L : listed) (rows : seq kernel_row) : table :=
  flatten [seq take (size row.2).-1 [seq d.1 | d <- (demands_modulo l L row.2).2] | row <- rows].

(** What is hinted at, modulo l: a point, none being infinity; a minor of the pencil there, by its rows, its columns and its value; the
    minor of the leading coefficients at the pivots; as many columns as there are states, and the minor of the states there. *)
Record hints := Hints { at_point : option Z; minor_rows : seq nat; minor_columns : seq nat; minor : Z; leading_minor : Z;
  state_columns : seq nat; state_minor : Z }.

(** The pencil at q, times the denominator; at infinity G is what counts beside the n states. Whether the minor of its rows and columns told
    is d, and not zero; the rank that it shows. *)
Definition pencil_table n (L : listed) (q : Z) : table :=
  [seq mkseq (fun j => Z.sub (if j == i then Z.mul (den L) q else Z0) (entry (nth [::] (lA L) i) j)) n ++ nth [::] (lC L) i
    | i <- iota 0 n]
  ++ [seq mkseq (fun j => Z.opp (entry r.1 j)) n ++ r.2 | r <- zip (lF L) (lG L)].
Definition is_minor a b (l : Z) (T : table) (rows columns : seq nat) (d : Z) : bool :=
  [&& all (fun i => i < a)%N rows, all (fun j => j < b)%N columns, size columns == size rows, invertible_modulo l d
    & is_determinant l (size rows) [seq at_pivots columns (nth [::] T i) | i <- rows] d].
Definition pencil_minor n m p (l : Z) (L : listed) (q : option Z) (rows columns : seq nat) (d : Z) : bool :=
  if q is Some x then is_minor (n + m) (n + p) l (pencil_table n L x) rows columns d else is_minor m p l (lG L) rows columns d.
Definition rank_shown n (q : option Z) (rows : seq nat) : nat := if q is Some _ then size rows else (n + size rows)%N.

(** The rows annihilate the system modulo l, their leading coefficients at the pivots are independent, and so are their states; and the
    pencil leaves room for no more rows. *)
Definition minimal n m p (l : Z) (L : listed) (rows : seq kernel_row) (h : hints) : bool :=
  let states := states_of_rows l L rows in
  [&& Z.ltb 1 l, invertible_modulo l (den L), all (fun row => (row.1 < p) && (0 < size row.2))%N rows
    & all (fun row => annihilated_modulo l L row.2) rows]
  && [&& invertible_modulo l (leading_minor h) && is_determinant l (size rows) (leading rows) (leading_minor h),
    is_minor (size states) n l states (iota 0 (size states)) (state_columns h) (state_minor h),
    (n + p <= rank_shown n (at_point h) (minor_rows h) + size rows)%N
    & pencil_minor n m p l L (at_point h) (minor_rows h) (minor_columns h) (minor h)].

(** ** The checks: ranks of windows *)

(** What shows a lower bound: words of one window, or hints, for every window. Where the rows of a system meet it, all relations between
    samples come from them. *)
Definition evidence : Type := (seq sampled_word + hints)%type.
Definition meets n m p s l (L : listed) (rows : seq kernel_row) (lower : evidence) : bool := well_formed n m p L && match lower with
  | inl ws => [&& kernel p L rows, words p s l L ws & size ws == ceiling p rows s]
  | inr h => [&& sorted leq [seq size row.2 | row <- rows], all (fun row => annihilated L row.2) rows & minimal n m p l L rows h] end.

(** Ranks of all windows, and left-invertibility. *)
Definition follows p r (etas ranks : seq nat) (rows : seq kernel_row) : bool :=
  [&& (r + size rows == p)%N, degrees rows == etas
    & ranks == [seq (s * r + sumn [seq minn s eta | eta <- etas])%N | s <- iota 1 (size ranks)]].
Definition check_window_ranks n m p r (etas ranks : seq nat) l L rows lower : bool :=
  meets n m p n.+1 l L rows lower && follows p r etas ranks rows.
Definition check_left_invertible n m p l L ws : bool := [&& well_formed n m p L, words p n.+1 l L ws & (n.+1 * m <= size ws)%N].
Definition check_left_invertible_at n m p l L q rows columns d : bool :=
  [&& well_formed n m p L, Z.ltb 1 l, invertible_modulo l (den L), rank_shown n q rows == (n + m)%N
    & pencil_minor n m p l L q rows columns d].

(** Ranks of all windows where these have all the rank that their shape allows: rows modulo l are enough. *)
Definition generic n m p (rows : seq kernel_row) : bool := nilp rows ||
  [&& (size rows + m == p)%N, sumn (degrees rows) == n & all (fun d => all (fun d' => d' <= d.+1)%N (degrees rows)) (degrees rows)].
Definition check_window_ranks_modulo n m p r (etas ranks : seq nat) l L rows h : bool :=
  [&& well_formed n m p L, sorted leq [seq size row.2 | row <- rows], generic n m p rows,
    minimal n m p l L rows h & follows p r etas ranks rows].

(** ** The checks: solutions of problem (11) *)

(** All demands of all rows. *)
Definition all_demands n (L : listed) (rows : seq kernel_row) : table := flatten [seq map (joined n) (demands L row.2).2 | row <- rows].

(** The basis, integers over d, is in reduced row echelon form and vanishes on the demands; the combinations of demands are the identity at
    some entries, modulo l. At one window, for which rows that are longer say nothing, and at all beyond some length. *)
Definition reduced_echelon (width : nat) (d : Z) (basis : table) (pivots : seq nat) : bool :=
  [&& d != Z0, all (fun r => size r == width) basis, size pivots == size basis, sorted ltn pivots, all (fun j => j < width)%N pivots
    & all (fun i => [&& all (fun j => entry (nth [::] basis i) j == Z0) (iota 0 (nth 0%N pivots i))
      & all (fun a => entry (nth [::] basis a) (nth 0%N pivots i) == if a == i then d else Z0) (iota 0 (size basis))])
      (iota 0 (size basis))].
Definition solution_space n p (L : listed) rows l d basis pivots (combinations : pivoted) : bool :=
  let table := all_demands n L rows in
  [&& reduced_echelon (n + p) d basis pivots, all (fun b => all (fun demand => dot b demand == Z0) table) basis,
    (size basis + size combinations == n + p)%N, all (fun u => u.1 < n + p)%N combinations,
    all (fun r => size r == n + p)%N table &
    identity_modulo l (led (combined table combinations))].
Definition kept s (rows : seq kernel_row) (lower : evidence) : seq kernel_row :=
  if lower is inr _ then [seq row <- rows | size row.2 <= s]%N else rows.
Definition check_solutions n m p s l (L : listed) rows lower d basis pivots combinations : bool :=
  [&& meets n m p s l L rows lower, shorter s (kept s rows lower)
    & solution_space n p L (kept s rows lower) l d basis pivots combinations].
Definition check_limit n m p beyond l (L : listed) rows lower d basis pivots combinations : bool :=
  [&& meets n m p n.+1 l L rows lower, shorter beyond.+1 rows & solution_space n p L rows l d basis pivots combinations].

(** ** The checks: two behaviours *)

(** Inclusion and equality for ever, equality on one window. *)
Definition check_inclusion n m n' m' p l (inner outer : listed) rows lower : bool :=
  [&& meets n' m' p n'.+1 l outer rows lower, well_formed n m p inner & all (fun row => annihilated inner row.2) rows].
Definition check_equality n m n' m' p l (first second : listed) rows lower lower' : bool :=
  meets n m p n.+1 l first rows lower && meets n' m' p n'.+1 l second rows lower'.
Definition check_window_equality n m n' m' p s l (first second : listed) rows ws ws' : bool :=
  [&& shorter s rows, meets n m p s l first rows (inl ws) & meets n' m' p s l second rows (inl ws')].

(** The row c over the outputs of a word, times a power of the denominator; a word of the first that a row of the second denies. *)
Definition pairing (e : Z) (c outputs : seq vector) : Z := foldr Z.add Z0 [seq dot uv.1 uv.2 | uv <- zip outputs (weighted e c).2].
Definition check_difference n m n' m' p s (first second : listed) x vs c : bool :=
  [&& well_formed n m p first, well_formed n' m' p second, annihilated second c, (0 < size c <= s)%N & size vs == s]
  && [&& all (fun r => size r <= p)%N (simulate first x vs) & pairing (den first) c (simulate first x vs) != Z0].

(** ** The checks: inversion *)

(** Faults from rest that nobody sees, back to rest; faults that s samples do not show. *)
Definition check_not_left_invertible n m p (L : listed) (xs vs : seq vector) : bool :=
  [&& well_formed n m p L, all null (simulate L [::] vs), null (run L [::] vs), has (nonzero m) vs
    & all_agree (states L [::] vs) xs].
Definition ambiguous n m p known s (L : listed) (x : vector) (vs : seq vector) : bool :=
  [&& well_formed n m p L, size vs == s, all null (simulate L x vs), nonzero m (head [::] vs) & known ==> null x].

(** Row i of the inverse, times an integer a, gives a v_i(0). The delay with an inverse; and that there is none. *)
Definition gives_entry m (known : bool) l (L : listed) i (row : Z * seq vector) : bool :=
  let (X, ds) := demands L row.2 in
  [&& size row.2 == l.+1, row.1 != Z0, known || null X, all (fun d => null (acts (lF L) (lG L) d)) (behead ds)
    & agree (acts (lF L) (lG L) (head ([::], [::]) ds)) (mkseq (fun j => if j == i then Z.mul (weighted (den L) row.2).1 row.1 else Z0) m)].
Definition inverse n m p known l (L : listed) (rows : seq (Z * seq vector)) : bool :=
  [&& well_formed n m p L, size rows == m & all (fun i => gives_entry m known l L i (nth (Z0, [::]) rows i)) (iota 0 m)].
Definition check_delay n m p known l (L : listed) rows x vs : bool :=
  [&& (l <= n)%N, inverse n m p known l L rows & (l == 0%N) || ambiguous n m p known l L x vs].
Definition check_no_delay n m p known (L : listed) x vs : bool := ambiguous n m p known n.+1 L x vs.

(** ** The checks: ranks of named matrices *)

(** Outputs one after the other; unit vectors; the k-th fault times the k-th power of the denominator; the rows F, F A, ...; the states. *)
Definition flat p (us : seq vector) : vector := flatten [seq mkseq (entry u) p | u <- us].
Definition basis_vector n i : vector := mkseq (fun j => if j == i then Zpos xH else Z0) n.
Fixpoint powered (w e : Z) (vs : seq vector) : seq vector := if vs is v :: vs' then scale w v :: powered (Z.mul w e) e vs' else [::].
Fixpoint reachability_rows (k : nat) (L : listed) (M : table) : table :=
  if k is k'.+1 then M ++ reachability_rows k' L [seq times r (lA L) | r <- M] else [::].
Fixpoint visited (L : listed) (x : vector) (vs : seq vector) : seq vector :=
  if vs is v :: vs' then x :: visited L (add (times x (lA L)) (times v (lF L))) vs' else [:: x].
Definition free_table n p s (L : listed) : table := [seq flat p (simulate L (basis_vector n i) (nseq s [::])) | i <- iota 0 n].

(** O_n, reachability, and of a recorded trajectory R_s and [X V_s]. *)
Definition check_observability n m p r l (L : listed) nulls combinations : bool :=
  well_formed n m p L && check_rank n (n * p) r l (free_table n p n L) nulls combinations.
Definition check_reachability n m p r l (L : listed) nulls combinations : bool :=
  well_formed n m p L && check_rank (n * m) n r l (reachability_rows n L (lF L)) nulls combinations.
Definition check_hankel n m p N s r l (L : listed) (d : Z) x vs nulls combinations : bool :=
  [&& well_formed n m p L, d != Z0, (N + s == (size vs).+1)%N & check_rank N (s * p) r l
    [seq flat p (take s (drop i (simulate L x (powered (Zpos xH) (den L) vs)))) | i <- iota 0 N] nulls combinations].
Definition check_excitation n m p N s r l (L : listed) (d : Z) x vs nulls combinations : bool :=
  let ws := powered (Zpos xH) (den L) vs in let xs := visited L x ws in
  [&& well_formed n m p L, d != Z0, (N + s == (size vs).+1)%N & check_rank N (n + s * m) r l
    [seq mkseq (entry (nth [::] xs i)) n ++ flat m (take s (drop i ws)) | i <- iota 0 N] nulls combinations].
