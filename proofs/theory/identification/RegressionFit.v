(** The regression of MOESP for B and D, with the true A and C, as a least squares problem: where what is left is orthogonal to O_s and to
    every T_s(B, D), any other B, D and states leave more, by the squares of their own distance; and where (A, C) is observable on s - 1
    samples that distance is zero for the same B and D alone. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary ExperimentsVocabulary OutputError Regression OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Fit.
Variables (K : realFieldType) (n m p nu : nat) (S : system K n m p) (s : nat) (R : 'M[K]_(s * nu, s * p)).
Implicit Types (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Notation rest := (regression_rest S R).

Lemma rest_of_another B D X B' D' X' :
  rest B' D' X' = rest B D X + (T (with_faults S (B - B') (D - D')) s + (X - X') *m O S s).
Proof.
have -> : T (with_faults S (B - B') (D - D')) s = T (with_faults S B D) s - T (with_faults S B' D') s.
  by have := T_linear S s (-1) B' B D' D; rewrite !scaleN1r ![- _ + _]addrC.
by rewrite /regression_rest mulmxBl [RHS]addrACA addKr [X in _ = X + _]addrA subrK.
Qed.

Lemma squares_add a b (E M : 'M[K]_(a, b)) : \tr (E^T *m M) = 0 -> squares (E + M) = squares E + squares M.
Proof.
move=> EM; have ME : \tr (M^T *m E) = 0 by rewrite -mxtrace_tr trmx_mul trmxK.
by rewrite /squares [(E + M)^T]linearD /= mulmxDl !mulmxDr !mxtraceD EM ME addr0 add0r.
Qed.

Theorem regression_least B D X : O S s *m (rest B D X)^T = 0 -> (forall B' D', \tr (T (with_faults S B' D') s *m (rest B D X)^T) = 0) ->
  (0 < s)%N -> row_free (O S s.-1) -> forall B' D' X', squares (rest B D X) <= squares (rest B' D' X') /\
  (squares (rest B' D' X') <= squares (rest B D X) -> B' = B /\ D' = D).
Proof.
move=> states inputs s0 obs B' D' X'; rewrite (rest_of_another B D X B' D' X'); set E := rest B D X; set M := T _ s + _.
have EM : \tr (E^T *m M) = 0.
  by rewrite mxtrace_mulC /M (mulmxDl (T _ s)) mxtraceD inputs -mulmxA states mulmx0 mxtrace0 addr0.
rewrite (squares_add EM).
have [pos zero] := trace_square M; split; first by rewrite lerDl.
rewrite gerDl => le; have {le}/zero/eqP : squares M = 0 by apply/eqP; rewrite Order.POrderTheory.eq_le le pos.
rewrite addr_eq0 -mulNmx => /eqP/(no_response s0 obs)[/eqP + /eqP]; rewrite !subr_eq0 => /eqP-> /eqP->; by split.
Qed.
End Fit.
