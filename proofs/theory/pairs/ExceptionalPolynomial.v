(** The exceptional polynomial, for every system: with r the normal rank, Z a basis of the solutions of problem (11), U a basis of the zero
    states (ClosedForm.v), b and a the coordinates in Z of the solutions (u, 0) and (u A, u C),
        D(q; P) = det [q b - a; P]
    is the greatest common divisor of the maximal minors of the pencil of the pair P Z: its zero polynomial. So P is bad iff D(q; P) = 0;
    its roots, in any extension of K, are the finite zeros of the pair; and its degree is at most zeta. For the zero states of any pair are
    zero states of S: the rows U of its pencil are (q b - a) Z, and a constant column that U annihilates is reached by the pencil.

         coordinates S s Z U a b == Z is a basis of the solutions at s, U of the zero states, and a and b are as above
        exceptional_matrix a b P == [q b - a; P]
    exceptional_polynomial a b P == D(q; P), its determinant *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset order
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv ssrnum ssrint rat matrix mxalgebra mxpoly vector fraction interval zify.
From faultspace Require Import Vocabulary Windows Lag PolynomialKernel Inversion.
From faultspace Require Import TransferRank NormalRank SharpWindows Solutions Theorem3 CanonicalForm ZeroFeedthrough ClosedForm.
From faultspace Require Import SolutionCount Minors FiniteZeros InfiniteZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions *)
Section Definitions.
Variables (K : fieldType) (n m p r e : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).

(** Z is a basis of the solutions at s, U of the zero states; a and b are coordinates in Z. *)
Definition coordinates s (Z : 'M[K]_(e + r, n + p)) (U : 'M[K]_(e, n)) (a b : 'M[K]_(e, e + r)) := [/\ spans_solutions S s Z /\ row_free Z,
  row_free U, (U :=: zero_states S)%MS, a *m Z = row_mx (U *m sysA S) (U *m sysC S) & b *m Z = row_mx U 0].

Definition exceptional_matrix (a b : 'M[K]_(e, e + r)) (P : 'M[K]_(r, e + r)) : 'M[{poly K}]_(e + r) :=
  col_mx ('X *: const b - const a) (const P).
Definition exceptional_polynomial a b P := \det (exceptional_matrix a b P).
End Definitions.

(** The degree of a determinant. *)
Lemma size_det (K : fieldType) k (M : 'M[{poly K}]_k) (d : 'I_k -> nat) : (forall i j, size (M i j) <= (d i).+1)%N ->
  (size (\det M) <= (\sum_i d i).+1)%N.
Proof.
move=> le; apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => t _.
have -> : size ((-1) ^+ t * \prod_i M i (t i)) = size (\prod_i M i (t i)).
  by rewrite -signr_odd; case: (odd _); rewrite ?mulN1r ?size_opp ?mul1r.
elim/big_rec2: _ => [|i x y _ IH]; first by rewrite size_poly1.
by apply: leq_trans (size_mul_leq _ _) _; have := le i (t i); lia.
Qed.

Lemma exceptional_degree (K : fieldType) r e (a b : 'M[K]_(e, e + r)) P : (size (exceptional_polynomial a b P) <= e.+1)%N.
Proof.
have := @size_det K _ (exceptional_matrix a b P) (fun i => if split i is inl _ then 1 else 0)%N.
rewrite big_split_ord /= [(\sum_(i < r) _)%N]big1 => [|i _]; last by rewrite (unsplitK (inr i)).
rewrite addn0 (eq_bigr (fun=> 1%N)) => [|i _]; last by rewrite (unsplitK (inl i)).
rewrite sum1_card card_ord; apply => i j; rewrite mxE; case: splitP => k _; rewrite !mxE ?size_polyC ?leq_b1 //.
apply: leq_trans (size_add _ _) _; rewrite geq_max size_opp size_polyC mulrC; apply/andP; split; last by case: (_ != 0).
by apply: leq_trans (size_mul_leq _ _) _; rewrite size_polyX size_polyC; case: (_ != 0).
Qed.

Section ExceptionalPolynomial.
Variables (K : fieldType) (n m p r e : nat) (S : system K n m p) (s : nat).
Variables (Z : 'M[K]_(e + r, n + p)) (U : 'M[K]_(e, n)) (a b : 'M[K]_(e, e + r)).
Hypotheses (long : (n < s)%N) (coords : coordinates S s Z U a b).
Notation const := (map_mx (@polyC K)).
Notation pair P := (faults_of S (P *m Z)).
Notation D P := (exceptional_polynomial a b P).

Lemma pair_included (P : 'M_(r, e + r)) t w : word (pair P) t w -> word S t w.
Proof.
have [[span _] _ _ _ _] := coords; case: s long span => // N nN spanN.
have := (inclusion_on_n_plus_1_samples S (pair P) nN).1; apply; apply/(included_rows _ _ spanN).
by rewrite hsubmxK submxMl.
Qed.

(** What can be silent with the faults of a pair is a zero state of S. *)
Lemma pair_zero_states (P : 'M_(r, e + r)) x : holds_zero (pair P) n x -> (x <= U)%MS.
Proof.
have [_ _ spanU _ _] := coords; rewrite spanU => /silent_state_solves sol.
apply/(zero_state_solutions S x (ltnSn n))/solves_words => w h; apply: (@pair_included P).
by have /solves_words := sol n.+1; apply.
Qed.

Let E : 'M[K]_(e + r, n + r) := block_mx (- U) 0 0 1%:M.
Let Z' := row_mx (- lsubmx Z) (rsubmx Z).

Lemma zero_rows (P : 'M_(r, e + r)) : const E *m pencil (pair P) = exceptional_matrix a b P *m const Z'.
Proof.
have [_ _ _] := coords; rewrite -{1 2}[Z]hsubmxK !mul_mx_row => /eq_row_mx[aA aC] /eq_row_mx[bA bC].
rewrite /E /Z' map_block_mx map_row_mx !map_mxN !map_mx0 map_mx1 mulmx_block mul_col_row !mul0mx !mul1mx !add0r !addr0.
rewrite /= -mulmx_lsub -mulmx_rsub !map_mxM !mulmxN !mulmxBl -!scalemxAl -!map_mxM.
rewrite aA aC bA bC map_mx0 scaler0 sub0r; congr block_mx; last by rewrite mulNmx map_mxM.
by rewrite mulNmx mulmxBr mul_mx_scalar map_mxM.
Qed.

Theorem exceptional_attained P : divides_minors (pencil (pair P)) (D P) /\
  exists2 c, c != 0 & exists C, \det (pencil (pair P) *m C) = c *: D P.
Proof.
have [[_ freeZ] freeU _ _ _] := coords.
apply: det_attained (zero_rows P) _; last 1 first.
- move=> y; rewrite -[y]vsubmxK mul_block_col !mul0mx mul1mx add0r addr0 -[X in _ = X]col_mx0 => /eq_col_mx[+ ->].
  rewrite mulNmx => /eqP; rewrite oppr_eq0 => /eqP Uy; apply: column_attained => x v silent.
  have /submxP[c ->] : (x <= U)%MS by apply: (@pair_zero_states P); exists v => k kn; apply/silent/ltnW.
  by rewrite -mulmxA Uy !mulmx0 addr0.
- apply: inj_row_free => c; rewrite -[c]hsubmxK mul_row_block !mulmx0 mulmx1 add0r addr0 -row_mx0 => /eq_row_mx[] /eqP.
  by rewrite mulmxN oppr_eq0 mulmx_free_eq0 // => /eqP -> ->; rewrite row_mx0.
apply: inj_row_free => c; rewrite mul_mx_row -row_mx0 => /eq_row_mx[] /eqP; rewrite mulmxN oppr_eq0 => /eqP l0 r0.
by apply/eqP; rewrite -(mulmx_free_eq0 _ freeZ) -[Z]hsubmxK mul_mx_row l0 r0 row_mx0.
Qed.

(** one-determinant, formula: the product of the diagonal form. *)
Theorem exceptional_zero_polynomial P : gcd_of_minors (pencil (pair P)) (D P).
Proof. by have [divides attained] := exceptional_attained P; apply: attained_gcd. Qed.

(** Its roots are the finite zeros of the pair (unobservable modes among them). *)
Theorem exceptional_roots P (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  (\rank (pencil_at (pair P) f z) < n + r)%N = root (map_poly f (D P)) z.
Proof. by have [divides attained] := exceptional_attained P; rewrite -(attained_rank divides attained) pencil_eval. Qed.

Theorem exceptional_left_invertible P : left_invertible (pair P) <-> D P != 0.
Proof.
have [divides [c c0 [C e1]]] := exceptional_attained P; split=> [inv | D0].
  have [g [[_ g_max] g_size]] := number_of_finite_zeros inv; have := g_max _ divides.
  by apply: contraTneq => ->; rewrite dvd0p -size_poly_eq0 g_size.
apply/left_invertible_pencil_rank/full_rank_over_fractions => u u0.
have : u *m (pencil (pair P) *m C *m \adj (pencil (pair P) *m C)) = 0 by rewrite !mulmxA u0 !mul0mx.
rewrite mul_mx_adj e1 mul_mx_scalar => /matrixP uD; apply/matrixP => i j; have := uD i j.
by rewrite !mxE => /eqP; rewrite mulf_eq0 scaler_eq0 (negPf c0) (negPf D0) => /eqP.
Qed.

Lemma coordinates_size : e = zeta S /\ r = \rank (transfer S).
Proof.
have [[span /eqP freeZ] /eqP freeU spanU _ _] := coords.
have eE : e = zeta S by rewrite zeta_zero_states -freeU spanU.
split=> //; rewrite -(gap_normal_rank S (leqnn n)); case: s long span => // N nN spanN.
have := (solution_count_zeta spanN).2 (leq_trans (lag_le_n S) nN); rewrite freeZ eE addnC; exact: addIn.
Qed.

(** one-determinant: P is good iff D(q; P) is not zero. *)
Theorem good_exceptional P : (forall w, behavior (pair P) w <-> behavior S w) <-> D P != 0.
Proof.
have [[span _] _ _ _ _] := coords; have [_ rE] := coordinates_size.
by rewrite -exceptional_left_invertible (theorem_3_normal_rank long span) left_invertible_transfer_rank -rE.
Qed.

End ExceptionalPolynomial.

(** Such coordinates exist in every basis of the solutions of the size that its rank tells, at every s > n. *)
Theorem coordinates_in_basis (K : fieldType) n m p (S : system K n m p) s r e (Z : 'M_(e + r, n + p)) : (n < s)%N ->
  spans_solutions S s Z -> row_free Z -> e = zeta S -> exists U a b, coordinates S s Z U a b.
Proof.
move=> ns span free; rewrite zeta_zero_states => ee; subst e.
have := eq_row_base (zero_states S); have := row_base_free (zero_states S); move: (row_base _) => U freeU UE.
have sol i : solves S s (row i U) 0 by apply/(zero_state_solutions S _ ns); rewrite -UE row_sub.
have /submxP[b bE] : (row_mx U 0 <= Z)%MS by apply/row_subP => i; rewrite row_row_mx row0; apply/span.
have /submxP[a aE] : (row_mx (U *m sysA S) (U *m sysC S) <= Z)%MS.
  by apply/row_subP => i; rewrite row_row_mx !row_mul; apply/span; exact: (shift_solves S s (row i U)).1 (sol i).
exists U, a, b; exact (And5 (conj span free) freeU UE (esym aE) (esym bE)).
Qed.

Theorem coordinates_exist (K : fieldType) n m p (S : system K n m p) s : (n < s)%N ->
  exists (Z : 'M_(zeta S + \rank (transfer S), n + p)) U a b, coordinates S s Z U a b.
Proof.
case: s => // N nN; have span := spans_Z S N.+1; have := (solution_count_zeta span).2 (leq_trans (lag_le_n S) nN).
rewrite (eqP (row_base_free _)) (gap_normal_rank S (leqnn n)) [(\rank (transfer S) + _)%N]addnC => kE.
have [Z [spanZ freeZ]] : exists Z : 'M_(zeta S + \rank (transfer S), n + p), spans_solutions S N.+1 Z /\ row_free Z.
  by rewrite -kE; exists (row_base (solution_space S N.+1)); split=> //; apply: row_base_free.
by exists Z; apply: coordinates_in_basis.
Qed.
