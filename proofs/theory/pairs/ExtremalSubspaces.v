(** The zero states U of the closed form (ClosedForm.v) in the words of geometric control: V* + S*, V* the largest output-nulling and S*
    the smallest input-containing subspace. V* is the set of states that can be silent for ever, S* of those reached silently from rest
    (SilentSubspaces.v); so V* + S* has dimension zeta, for every system; and where the system is left-invertible the sum is direct, with as
    many finite zeros as dim V* and as many infinite ones as dim S*. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra.
From faultspace Require Import Vocabulary Chain SilentSubspaces ZeroStates StructureVocabulary.
From faultspace Require Import InfiniteZeros SystemZeros Readings SolutionCount.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Extremal.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma zero_holding_largest : largest_output_nulling S (zero_holding S).
Proof.
split=> [x xV | j X nulling]; first exact: hold_next.
suff sub k : (X <= iter k (hold_step S) 1%:M)%MS by apply: sub.
elim: k => [|k IH]; first exact: submx1.
apply/row_subP => i; apply/hold_stepP; have [w [e h]] := nulling _ (row_sub i X).
by exists w; split=> //; apply: submx_trans h IH.
Qed.

Lemma silent_from_rest_smallest : smallest_input_containing S (silent_from_rest S n).
Proof.
split=> [x v xW e | j X containing].
  apply: submx_trans (increasing_constant (@silent_step_mono _ _ _ _ S) n.+1).
  by apply/silent_stepP; exists x, v.
suff sub k : (silent_from_rest S k <= X)%MS by apply: sub.
elim: k => [|k IH]; first exact: sub0mx.
apply/row_subP => i; have /silent_stepP[x [w [xW e <-]]] := row_sub i (silent_from_rest S k.+1).
by apply: containing => //; apply: submx_trans xW IH.
Qed.

Variables (a b : nat) (V : 'M[K]_(a, n)) (W : 'M[K]_(b, n)).
Hypotheses (largest : largest_output_nulling S V) (smallest : smallest_input_containing S W).

Lemma largestE : (V :=: zero_holding S)%MS.
Proof.
have [nulling max] := largest; have [nulling' max'] := zero_holding_largest.
by apply/eqmxP; rewrite max' // max.
Qed.

Lemma smallestE : (W :=: silent_from_rest S n)%MS.
Proof.
have [containing min] := smallest; have [containing' min'] := silent_from_rest_smallest.
by apply/eqmxP; rewrite min' // min.
Qed.

Theorem zero_states_extremal : (zero_states S :=: V + W)%MS /\ zeta S = \rank (V + W)%MS.
Proof.
have e : (zero_states S :=: V + W)%MS.
  by apply: eqmx_trans (zero_states_silent S) (eqmx_sym (adds_eqmx largestE smallestE)).
by split; rewrite // zeta_zero_states e.
Qed.

Theorem zero_states_direct g d : left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d ->
  [/\ (V :&: W)%MS = 0, zeta S = (\rank V + \rank W)%N, (size g).-1 = \rank V & d = \rank W].
Proof.
move=> inv finite infinite; rewrite largestE smallestE; split.
- apply/row_matrixP => i; rewrite row0; have := row_sub i (V :&: W)%MS; rewrite sub_capmx largestE smallestE => /andP[].
  exact: silent_subspaces_independent.
- exact: zeta_silent_subspaces.
- exact: finite_zero_count.
exact: infinite_zeros_unique infinite (number_of_infinite_zeros inv).
Qed.

End Extremal.

Theorem extremal_subspaces_exist (K : fieldType) n m p (S : system K n m p) :
  exists V W : 'M_n, largest_output_nulling S V /\ smallest_input_containing S W.
Proof. by exists (zero_holding S), (silent_from_rest S n); split; [exact: zero_holding_largest | exact: silent_from_rest_smallest]. Qed.
