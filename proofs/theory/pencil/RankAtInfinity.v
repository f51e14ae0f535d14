(** The pencil at infinity has the rank of the pencil over the rational functions: at t, the variable of these, its first n columns are t
    times those of the pencil at 1/t. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary PolynomialKernel SilentSubspaces SeenBasis FiniteZeros SystemZeros SystemInfiniteZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Theorem rank_pencil_at_infinity (K : fieldType) n m p (S : system K n m p) :
  \rank (over_fractions (pencil_at_infinity S)) = (n + gap S n)%N.
Proof.
apply/eqP; rewrite eqn_leq; apply/andP; split; last first.
  rewrite leqNgt; apply/negP => few; have count := number_of_system_infinite_zeros S.
  have /count : divides_minors_of_order (n + gap S n) (pencil_at_infinity S) 'X^(\rank (silent_from_rest S n) - \rank (both S)).+1.
    move=> h f; have [->|d0] := eqVneq (\det (mxsub h f (pencil_at_infinity S))) 0; first exact: dvdp0.
    move: few; rewrite ltnNge (@minor_rank _ _ _ _ _ h f) // /over_fractions -map_mxsub det_map_mx tofrac_eq0.
    exact: d0.
  by rewrite ltnn.
pose g := [the {rmorphism _ -> _} of @FracField.tofrac _ \o @polyC K]; pose t : {fraction {poly K}} := tofrac 'X.
have t0 : t != 0 by rewrite tofrac_eq0 polyX_eq0.
have -> : over_fractions (pencil_at_infinity S) = pencil_at S g t^-1 *m block_mx t%:M 0 0 1%:M.
  rewrite /pencil_at mulmx_block !mulmx0 !mulmx1 !addr0 !add0r !mul_mx_scalar scalerBr scale_scalar_mx mulfV // scalerN.
  rewrite /over_fractions /pencil_at_infinity map_block_mx map_mxN map_mxB map_scalar_mx !map_mxZ -!map_mx_comp rmorph1.
  reflexivity.
apply: leq_trans (mxrankM_maxl _ _) _; have [d [Z [L [M dyn]]]] := quotient_dynamics_exists S.
by rewrite -(leq_add2r d) (pencil_rank_at dyn g t^-1) leq_add2l rank_leq_row.
Qed.
