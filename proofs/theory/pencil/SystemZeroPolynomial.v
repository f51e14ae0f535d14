(** Finite zeros of every system, with their multiplicities: the characteristic polynomial of the silent dynamics M on V / (V n S)
    (SystemZeros.v) is the greatest common divisor of the minors of order n + gap n, the normal rank, of the pencil; so there are
    dim V - dim (V n S) finite zeros. For a silent way from rest to a state of V n S, read as a polynomial row, inverts q X - N. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra mxpoly.
From faultspace Require Import Vocabulary Chain Inversion.
From faultspace Require Import FiniteZeros SilentSubspaces MinorsOfOrder SystemZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section SystemZeroPolynomial.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).
Notation R := (both S).
Notation Q := (row_base (both S)).

Lemma rows_polynomial k (X : 'M_(k, n)) (W : 'M_(k, m)) : const (row_mx X W) *m pencil S =
  row_mx ('X *: const X - const (X *m sysA S + W *m sysF S)) (const (X *m sysC S + W *m sysG S)).
Proof. by rewrite map_row_mx mul_row_block mulmxBr mul_mx_scalar mulmxN -!map_mxM -addrA -opprD -!map_mxD. Qed.

Lemma horner_mul a b (c : nat -> 'rV[K]_a) (f : nat -> 'rV[K]_b) (E : 'M_(a, b)) l :
  (forall k, (k <= l)%N -> f k = c k *m E) -> horner_states f l = horner_states c l *m const E.
Proof.
elim: l => [|l IH] e /=; first by rewrite e // map_mxM.
by rewrite IH => [|k kl]; [rewrite e // map_mxM mulmxDl -scalemxAl | apply: e; apply: leqW].
Qed.

Lemma horner_row a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) l :
  row_mx (horner_states f l) (horner_states g l) = horner_states (fun k => row_mx (f k) (g k)) l.
Proof. by elim: l => [|l IH] /=; rewrite map_row_mx // -IH scale_row_mx add_row_mx. Qed.

Lemma within_pencil X N : states_within S = X *m Q -> next_within S = N *m Q ->
  const (within S) *m pencil S = row_mx (('X *: const X - const N) *m const Q) 0.
Proof.
move=> XQ NQ; rewrite -[within S]hsubmxK rows_polynomial -/(states_within S) -/(next_within S) quiet_within map_mx0 XQ NQ.
by rewrite !map_mxM mulmxBl -scalemxAl.
Qed.

(** The left inverse. *)
Lemma within_inverse X N : states_within S = X *m Q -> next_within S = N *m Q ->
  exists J, J *m ('X *: const X - const N) = 1%:M.
Proof.
move=> XQ NQ; set D := 'X *: _ - _; have /row_freeP[Q' QQ'] := row_base_free R.
have /fin_all_exists[j hj] : forall i, exists j, j *m D = delta_mx 0 i :> 'rV_(\rank R).
  move=> i; have : (row i Q <= R)%MS by rewrite -(eq_row_base R) row_sub.
  rewrite {1}sub_capmx => /andP[yV yS]; have /silent_from_restP[v [h e]] : (row i Q <= silent_from_rest S n.+1)%MS.
    apply: submx_trans yS _; exact: (increasing (@silent_step_mono _ _ _ _ S) (leqnSn n)).
  rewrite -e in yV; have pairs := silent_way_pairs h yV.
  have /fin_all_exists[c hc] : forall k : 'I_n.+1, exists c, row_mx (state S 0 v k) (v k) = c *m within S.
    by move=> k; apply/submxP/pairs.
  pose c' k := if insub k is Some k' then c k' else 0.
  have pairE k : (k <= n)%N -> row_mx (state S 0 v k) (v k) = c' k *m within S.
    by rewrite -ltnS => kn; rewrite /c' insubT /= -hc.
  exists (- horner_states c' n); have := horner_pencil h; rewrite horner_row (horner_mul pairE) -mulmxA (within_pencil XQ NQ) e.
  rewrite mul_mx_row => /eq_row_mx[/(congr1 (mulmx^~ (const Q'))) + _]; rewrite -/D !mulNmx -!mulmxA -map_mxM QQ' map_mx1 mulmx1.
  move=> ->; rewrite opprK rowE -map_mxM -mulmxA QQ' mulmx1; exact: map_delta_mx.
exists (\matrix_i j i); apply/row_matrixP => i; rewrite row_mul rowK hj row1.
by [].
Qed.

Section Dynamics.
Variables (d : nat) (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (M : 'M[K]_d).
Hypothesis dynamics : quotient_dynamics S Z L M.

Theorem system_zero_polynomial : gcd_of_minors_of_order (n + gap S n) (pencil S) (char_poly M).
Proof.
have [_ _ _ _ quiet] := dynamics; have [X [N [H [XQ NQ HQ]]]] := coordinates dynamics.
have [J JD] := within_inverse XQ NQ.
pose Q0 := row_mx (col_mx Q Z) (0 : 'M[K]_(_, p)).
have rows : const (pair_rows S Z L) *m pencil S =
    block_mx ('X *: const X - const N) 0 (- const H) (char_poly_mx M) *m const Q0.
  rewrite map_col_mx mul_col_mx (within_pencil XQ NQ) rows_polynomial quiet map_mx0 -block_mxEv block_mxEh col_mx0.
  rewrite /Q0 map_row_mx map_col_mx map_mx0 mul_mx_row mulmx0 mul_block_col mul0mx addr0; congr (row_mx (col_mx _ _) _).
  rewrite mulNmx -map_mxM -HQ mulmxBl mul_scalar_mx -map_mxM map_mxB opprB [RHS]addrC addrA subrK.
  by [].
have solve (y : 'cV_(n + m)) : pair_rows S Z L *m y = 0 -> exists x, pencil S *m x = const y.
  rewrite -[y]vsubmxK => Ey; apply: column_attained => x v /(silent_pair_sub dynamics)/submxP[c e].
  by rewrite -mul_row_col e -mulmxA Ey mulmx0.
have := gcd_of_highest_minors (E_free dynamics) (coordinates_free dynamics) rows JD solve.
have -> : (\rank R + d + (n + m - (\rank (kermx (within_conditions S)) + d)) = n + gap S n)%N.
  by rewrite -(rank_pairs dynamics) (eqP (E_free dynamics)).
by [].
Qed.

End Dynamics.

(** The number of finite zeros. *)
Theorem number_of_system_zeros : exists g, gcd_of_minors_of_order (n + gap S n) (pencil S) g /\
  size g = (\rank (zero_holding S) - \rank (zero_holding S :&: silent_from_rest S n)%MS).+1.
Proof.
have [d [Z [L [M dynamics]]]] := quotient_dynamics_exists S; exists (char_poly M).
by split; [apply: system_zero_polynomial dynamics | rewrite size_char_poly (rank_quotient_dynamics dynamics)].
Qed.

End SystemZeroPolynomial.
