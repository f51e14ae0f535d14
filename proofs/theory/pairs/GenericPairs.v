(** theorem-3 (ii): almost every P is good. On every line P + t P1 through a good P, all but at most m values of t are good. Idea: the
    transfer matrix is H + t H1, linear in the pair; with a right inverse R of H, a bad t makes - 1 / t an eigenvalue of H1 R, an m x
    m matrix over the rational functions. (Good P exist for every system: GoodPairs.v.) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra mxpoly fraction.
From faultspace Require Import Vocabulary TransferRank Theorem3.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Matrices over a field: few points of a line have smaller rank. *)
Lemma few_rank_drops (F : fieldType) m p (H H1 : 'M[F]_(m, p)) (ts : seq F) : row_free H -> uniq ts ->
  all (fun t => ~~ row_free (H + t *: H1)) ts -> (size ts <= m)%N.
Proof.
case/row_freeP => R HR ts_uniq bad.
have nonzero : 0 \notin ts by apply/negP => /(allP bad); rewrite scale0r addr0 => /negP[]; apply/row_freeP; exists R.
have inv_uniq : uniq [seq - t^-1 | t <- ts] by rewrite map_inj_uniq // => t u /oppr_inj/invr_inj.
rewrite -(size_map (fun t => - t^-1)) -ltnS -(size_char_poly (H1 *m R)); apply: max_poly_roots inv_uniq.
  by apply: monic_neq0; apply: char_poly_monic.
apply/allP => _ /mapP[t t_in ->]; rewrite -eigenvalue_root_char; have t0 : t != 0 by apply: contraNneq nonzero => <-.
have := allP bad t t_in; rewrite -kermx_eq0 => /rowV0Pn[v /sub_kermxP vH v0].
apply/eigenvalueP; exists v => //; apply: (scalerI t0); rewrite scalerA mulrN divff // scaleN1r.
by apply/eqP; rewrite -subr_eq0 opprK addrC -{1}[v]mulmx1 -HR !mulmxA scalemxAl -mulmxDl scalemxAr -mulmxDr vH mul0mx.
Qed.

Section GenericPairs.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s k : nat) (Z : 'M[K]_(k, n + p)).
Notation pair P := (faults_of S (P *m Z)).

Lemma transfer_line m' (P P1 : 'M[K]_(m', k)) t :
  transfer (pair (P + t *: P1)) = transfer (pair P) + (FracField.tofrac t%:P) *: transfer (pair P1).
Proof.
have line a (M M1 : 'M[K]_(m', a)) : over_fractions (map_mx polyC (M + t *: M1)) =
    over_fractions (map_mx polyC M) + (FracField.tofrac t%:P) *: over_fractions (map_mx polyC M1).
  by rewrite /over_fractions map_mxD map_mxZ map_mxD map_mxZ.
rewrite /transfer /= mulmxDl -scalemxAl !linearD !linearZ /= !line !mulmxDl -!scalemxAl.
exact: addrACA.
Qed.

Theorem theorem_3_part_ii (P P1 : 'M_(m, k)) (ts : seq K) : (n < s)%N -> spans_solutions S s Z -> left_invertible S ->
  (forall r, behavior (pair P) r <-> behavior S r) -> uniq ts ->
  (forall t, t \in ts -> ~ (forall r, behavior (pair (P + t *: P1)) r <-> behavior S r)) -> (size ts <= m)%N.
Proof.
move=> ns span inv good ts_uniq bad.
have embed_inj : injective (fun t : K => FracField.tofrac t%:P).
  by move=> t u /eqP; rewrite tofrac_eq => /eqP/polyC_inj.
rewrite -(size_map (fun t : K => FracField.tofrac t%:P)).
apply: (few_rank_drops (H := transfer (pair P)) (H1 := transfer (pair P1))).
- by apply/eqP/left_invertible_transfer_rank/(theorem_3_criterion ns span).
- by rewrite map_inj_uniq.
apply/allP => _ /mapP[t /bad not_equal ->]; apply/negP => free; apply: not_equal.
by apply/(theorem_3_criterion ns span) => //; apply/left_invertible_transfer_rank/eqP; rewrite transfer_line.
Qed.

End GenericPairs.
