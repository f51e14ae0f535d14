(** Polynomial columns in the kernel of the pencil of a system, seen to be a minimal basis by the independence of their states: the
    coefficients of the upper part X of all columns [X; N], of the degrees below that of the column. With independent leading coefficients
    and a pencil that leaves room for no more columns, that is all it takes; and then the columns tell the ranks of all windows. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Gap Lag PolynomialKernel MinimalIndices NormalRank Annihilator Indices.
From faultspace Require Import SeenBasis IndependentStates.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section OneSystem.
Variables (K : fieldType) (n m p k : nat) (S : system K n m p) (Y : 'M[{poly K}]_(n + p, k)).
Hypothesis kernel : pencil S *m Y = 0.

(** The degree of the states is below that of the row. *)
Lemma costate_shorter s (b : 'cV_n) (c : 'cV_p) : pencil S *m col_mx b c = 0 -> (sizem c <= s.+1)%N -> (sizem b <= s)%N.
Proof.
move=> ker cs; have /sizem_leP b0 := costate_size ker cs; have /sizem_leP c0 := cs; apply/sizem_leP => j sj.
by have [+ _] := (right_kernel _ _ _).1 ker j.+1; rewrite /= [coefm j.+1 b]b0 // c0 // !mulmx0 subrr.
Qed.

Lemma states_low i a : (size (usubmx Y i a) <= degree Y a)%N.
Proof.
have ker : pencil S *m col_mx (usubmx (col a Y)) (dsubmx (col a Y)) = 0 by rewrite vsubmxK colE mulmxA kernel mul0mx.
have short : (sizem (dsubmx (col a Y)) <= (degree Y a).+1)%N.
  by apply/bigmax_leqP => -[j j'] _; rewrite !mxE; apply: size_column.
have /bigmax_leqP/(_ (i, 0) isT) := costate_shorter ker short; by rewrite !mxE.
Qed.

Lemma leading_rows : \rank (leading Y) = k -> \rank (\matrix_(i < p, a < k) (dsubmx Y i a)`_(degree Y a)) = k.
Proof.
move=> full; apply/eqP; rewrite eqn_leq rank_leq_col -[X in (X <= _)%N]full; apply: mxrankS.
rewrite -[leading Y]vsubmxK col_mx_sub; apply/andP; split; last first.
  by rewrite (_ : dsubmx _ = \matrix_(i, a) (dsubmx Y i a)`_(degree Y a)) //; apply/matrixP => i a; rewrite !mxE.
rewrite (_ : usubmx _ = 0) ?sub0mx //; apply/matrixP => i a; rewrite !mxE nth_default //.
by have := states_low i a; rewrite mxE.
Qed.

Hypothesis states : forall w : 'I_k -> nat -> K, \sum_a \sum_(j < degree Y a) w a j *: coefm j (col a (usubmx Y)) = 0 ->
  forall a j, (j < degree Y a)%N -> w a j = 0.
Hypothesis regular : \rank (leading Y) = k.

Theorem minimal_basis_by_states : (n + p <= \rank (over_fractions (pencil S)) + k)%N -> minimal_basis (pencil S) Y.
Proof.
have [|B] := inverse_by_states states_low states _ (leading_rows regular).
  by move=> i a a0; rewrite mxE -a0 size_column.
by rewrite vsubmxK => BY few; apply: minimal_basis_by_inverse BY few regular.
Qed.

End OneSystem.

Section Ranks.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** The rank of the pencil at a point, and at infinity, is no more than the rank. *)
Lemma rank_at_infinity : (n + \rank (sysG S) <= \rank (over_fractions (pencil S)))%N.
Proof. by rewrite pencil_rank_gap leq_add2l /gap mxrankS // -addsmxE addsmxSr. Qed.

(** A minimal basis tells the ranks of all windows. *)
Theorem basis_windows k (Y : 'M[{poly K}]_(n + p, k)) : minimal_basis (pencil S) Y -> (k <= p)%N /\
  forall s, \rank (window S s) = (s * (p - k) + \sum_(a < k) minn s (degree Y a))%N.
Proof.
move=> basis; have perm := etas_are_minimal_indices basis; have sizes := perm_size perm.
have kp : (k = p - gap S n)%N by move: sizes; rewrite size_map size_enum_ord size_etas.
split=> [|s]; first by rewrite kp leq_subr.
rewrite rank_window_etas -(perm_big _ perm) big_map big_enum /=; congr (s * _ + _)%N.
by rewrite kp subKn ?gap_le_outputs.
Qed.

(** In sum, with the rank of the pencil at one point, or at infinity. *)
Theorem seen_by_states k (Y : 'M[{poly K}]_(n + p, k)) q : pencil S *m Y = 0 -> \rank (leading Y) = k ->
  (forall w : 'I_k -> nat -> K, \sum_a \sum_(j < degree Y a) w a j *: coefm j (col a (usubmx Y)) = 0 ->
    forall a j, (j < degree Y a)%N -> w a j = 0) ->
  (n + p <= \rank (map_mx (horner_eval q) (pencil S)) + k)%N \/ (p <= \rank (sysG S) + k)%N ->
  minimal_basis (pencil S) Y /\ forall s, \rank (window S s) = (s * (p - k) + \sum_(a < k) minn s (degree Y a))%N.
Proof.
move=> kernel regular states few; have basis : minimal_basis (pencil S) Y; last by have [_] := basis_windows basis.
apply: minimal_basis_by_states kernel states regular _; case: few => [at_q|at_infinity].
  by apply: leq_trans at_q _; rewrite leq_add2r rank_at_point.
by apply: leq_trans (leq_add rank_at_infinity (leqnn k)); rewrite -addnA leq_add2l.
Qed.

End Ranks.
