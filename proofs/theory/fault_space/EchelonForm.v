(** The reduced row echelon form is unique, so it names the class of equivalent fault matrices: for fixed (A, C), two systems have the
    same behaviour iff the reduced echelon forms of their solution spaces of problem (11), at any window s >= n + 1, are the same
    matrix. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  vector.
From faultspace Require Import Vocabulary CanonicalForm.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Uniqueness.
Variables (K : fieldType) (N : nat).

(** A nonzero combination of the rows has its first entry that is not zero at a pivot. *)
Lemma leading_pivot k (R : 'M[K]_(k, N)) (pivot : 'I_k -> 'I_N) (c : 'rV_k) (l : 'I_N) :
  (forall i j, R i (pivot j) = (i == j)%:R) -> (forall i (l : 'I_N), (l < pivot i)%N -> R i l = 0) ->
  (forall i j : 'I_k, (i < j)%N -> (pivot i < pivot j)%N) ->
  (c *m R) 0 l != 0 -> (forall l' : 'I_N, (l' < l)%N -> (c *m R) 0 l' = 0) -> exists j, pivot j = l.
Proof.
move=> ones zeros ascend cl lead.
have at_pivot j : (c *m R) 0 (pivot j) = c 0 j.
  rewrite mxE (bigD1 j) //= ones eqxx mulr1 big1 ?addr0 // => i ij.
  by rewrite ones (negPf ij) mulr0.
have [j0 cj0|c0] := pickP (fun j => c 0 j != 0); last first.
  by move: cl; rewrite mxE big1 ?eqxx // => j _; have /negbFE/eqP-> := c0 j; rewrite mul0r.
case: (@arg_minnP _ j0 (fun j => c 0 j != 0) val cj0) => j cj least; exists j; apply/val_inj/eqP; rewrite eqn_leq.
apply/andP; split; rewrite leqNgt; apply/negP => lt.
  move: cl; rewrite mxE big1 ?eqxx // => i _.
  have [->|ci] := eqVneq (c 0 i) 0; first exact: mul0r.
  rewrite zeros ?mulr0 //; apply: leq_trans lt _; have := least i ci; rewrite leq_eqVlt.
  by case/orP=> [/eqP/val_inj -> //|/ascend/ltnW].
by move: cj; rewrite -at_pivot lead ?eqxx.
Qed.

Theorem reduced_echelon_free k (R : 'M[K]_(k, N)) : reduced_echelon R -> row_free R.
Proof.
case=> pivot [ones _ _]; apply: inj_row_free => c cR; apply/rowP => j; rewrite mxE.
have := congr1 (fun y : 'rV_N => y 0 (pivot j)) cR; rewrite !mxE (bigD1 j) //= ones eqxx mulr1 big1 ?addr0 // => i ij.
by rewrite ones (negPf ij) mulr0.
Qed.

Theorem reduced_echelon_unique k (R R' : 'M[K]_(k, N)) : reduced_echelon R -> reduced_echelon R' -> (R :=: R')%MS -> R = R'.
Proof.
move=> [pivot [ones zeros ascend]] [pivot' [ones' zeros' ascend']] eqR.
have some_pivot (Q Q' : 'M[K]_(k, N)) (f f' : 'I_k -> 'I_N) : (forall i j, Q i (f j) = (i == j)%:R) ->
    (forall i (l : 'I_N), (l < f i)%N -> Q i l = 0) -> (forall i j : 'I_k, (i < j)%N -> (f i < f j)%N) ->
    (forall i j, Q' i (f' j) = (i == j)%:R) -> (forall i (l : 'I_N), (l < f' i)%N -> Q' i l = 0) ->
    (Q' <= Q)%MS -> forall i, exists j, f j = f' i.
  move=> fo fz fa fo' fz' /row_subP sub i; have /submxP[c rowE] := sub i.
  apply: (leading_pivot (c := c) fo fz fa); rewrite -rowE ?mxE ?fo' ?eqxx ?oner_eq0 // => l li.
  by rewrite mxE fz'.
have to_R := some_pivot _ _ _ _ ones zeros ascend ones' zeros'.
have to_R' := some_pivot _ _ _ _ ones' zeros' ascend' ones zeros.
rewrite -{1}eqR submx_refl in to_R; rewrite eqR submx_refl in to_R'.
have below (f f' : 'I_k -> 'I_N) i : (forall i j : 'I_k, (i < j)%N -> (f i < f j)%N) ->
    (forall i j : 'I_k, (i < j)%N -> (f' i < f' j)%N) -> (exists j, f j = f' i) ->
    (forall j : 'I_k, (j < i)%N -> f j = f' j) -> (f i <= f' i)%N.
  move=> fa fa' [j e] same; rewrite -e; case: (ltngtP i j) => [/fa/ltnW //|ji|/val_inj -> //].
  by have := fa' _ _ ji; rewrite -e -same // ltnn.
have same d (i : 'I_k) : (i < d)%N -> pivot i = pivot' i.
  elim: d i => // d IH i id; have IHi (j : 'I_k) : (j < i)%N -> pivot j = pivot' j by move=> ji; apply: IH; apply: leq_trans ji _.
  apply/val_inj/eqP; rewrite eqn_leq !below //; first exact: to_R'; last exact: to_R.
  by move=> j /IHi.
have /submxP[D RD] : (R <= R')%MS by rewrite eqR.
rewrite RD -[RHS]mul1mx; congr (_ *m _); apply/matrixP => i j; rewrite [RHS]mxE -(ones i j) (same _ j (ltn_ord j)) RD mxE.
by rewrite (bigD1 j) //= ones' eqxx mulr1 big1 ?addr0 // => l lj; rewrite ones' (negPf lj) mulr0.
Qed.

End Uniqueness.

Section CanonicalForm.
Variables (K : fieldType) (n m m' p : nat) (S : system K n m p) (S' : system K n m' p).
Hypotheses (sameA : sysA S' = sysA S) (sameC : sysC S' = sysC S).

Theorem canonical_echelon_form s k k' (R : 'M_(k, n + p)) (R' : 'M_(k', n + p)) : (n < s)%N ->
  spans_solutions S s R -> spans_solutions S' s R' -> reduced_echelon R -> reduced_echelon R' ->
  (exists e : k = k', castmx (e, erefl) R = R') <-> (forall r, behavior S r <-> behavior S' r).
Proof.
move=> ns span span' echelon echelon'; rewrite -(canonical_form sameA sameC ns span span'); split=> [[e <-] | eqR].
  by case: _ / e; rewrite castmx_id.
have e : k = k' by rewrite -(eqP (reduced_echelon_free echelon)) -(eqP (reduced_echelon_free echelon')) eqR.
by exists e; case: _ / e R' {span'} echelon' eqR => R' echelon' eqR; rewrite castmx_id; apply: reduced_echelon_unique eqR.
Qed.

End CanonicalForm.
