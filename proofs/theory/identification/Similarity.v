(** The range of O_s determines (A, C) up to the basis of the state, if (A, C) is observable on s - 1 samples. So what is read from a limit
    of subspace identification is right up to a basis just when the limit has all of the range of O_s. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Controllable LimitsVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Similarity.
Variables (K : fieldType) (n m m' p : nat) (S : system K n m p) (S' : system K n m' p).

Lemma similar_state P k x : P \in unitmx -> sysA S' = P *m sysA S *m invmx P ->
  state S' x (fun=> 0) k *m P = state S (x *m P) (fun=> 0) k.
Proof.
by move=> unit eA; elim: k => //= k IH; rewrite !mul0mx !addr0 eA !mulmxA IH mulmxKV.
Qed.

Lemma similar_observability s : similar S S' -> (O S' s :=: O S s)%MS.
Proof.
case=> P unit [eA eC]; have -> : O S' s = P *m O S s.
  apply/row_matrixP=> i; rewrite row_mul mul_O !rowK; apply: samples_ext => k _.
  by rewrite /output !mul0mx !addr0 eC mulmxA similar_state // [row i 1%:M]rowE mulmx1 [row i P]rowE.
by apply: eqmxMfull; rewrite row_full_unit.
Qed.

Lemma row_free_shorter s t : (s <= t)%N -> row_free (O S s) -> row_free (O S t).
Proof.
move=> st obs; apply: inj_row_free => x; rewrite mul_O => /samples_eq0 z.
apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0 => k ks; apply: z; exact: leq_trans st.
Qed.

(** observable on s - 1 samples is needed to read A: the last block of O_s alone tells C A^(s-1). *)
Theorem same_range_similar s : row_free (O S s.-1) -> (O S s == O S' s)%MS <-> similar S S'.
Proof.
move=> obs; split=> [|sim]; last by apply/eqmxP/eqmx_sym; apply: similar_observability.
have obs_s : row_free (O S s) by apply: row_free_shorter obs; apply: leq_pred.
move=> /andP[sub /submxP[P eP]].
have unit : P \in unitmx.
  rewrite -row_free_unit /row_free eqn_leq rank_leq_row /= -{1}(eqP obs_s).
  by apply: leq_trans (mxrankS sub) _; rewrite eP; apply: mxrankM_maxl.
have out x k : (k < s)%N -> output S' x (fun=> 0) k = output S (x *m P) (fun=> 0) k.
  by move: k; apply: samples_inj; rewrite -!mul_O -mulmxA -eP.
exists P => //; case: s => [|s] in obs obs_s sub eP out *.
  have n0 : n = 0%N by apply/eqP; rewrite -leqn0 -(eqP obs); apply: leq_trans (rank_leq_col _) _; rewrite mul0n.
  by split; apply/matrixP=> i; have := ltn_ord i; rewrite {2}n0.
split; last first.
  apply/row_matrixP=> i; rewrite !rowE mulmxA; have := out (delta_mx 0 i) 0%N isT.
  by rewrite /output /= !mul0mx !addr0.
apply: (canRL (mulmxK unit)); apply/row_matrixP=> i; rewrite [LHS]rowE [RHS]rowE !mulmxA; apply: (row_free_inj obs).
rewrite !mul_O; apply: samples_ext => k ks.
have step T (x : 'rV_n) (R : system K n T p) : output R x (fun=> 0) k.+1 = output R (x *m sysA R) (fun=> 0) k.
  by rewrite output_step mul0mx addr0.
have ks' : (k < s.+1)%N by apply: ltnW.
by rewrite -out // -(step _ _ S') out // (step _ _ S).
Qed.

End Similarity.

(** A and C, read from the limit with a white input, are right up to the basis of the state iff B seen controls A. *)
Theorem white_limit_similar (K : fieldType) (N n m m' p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (S' : system K n m' p)
    (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n))
    (y : nat -> 'M[K]_(N, p)) H J (Phi : nat -> 'M[K]_(nu, m)) q t s L :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
  (n <= q)%N -> (J + q <= t)%N -> (t + s + J <= H)%N -> row_free (O S s.-1) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  ((L == O S s)%MS <-> (forall z, steered S (seen_B S J Phi B) z)) /\
  ((L == O S' s)%MS -> similar S S' <-> (forall z, steered S (seen_B S J Phi B) z)).
Proof.
move=> model u_white v_leads past nq Jqt tH obs limit.
have whole : (L == O S s)%MS <-> forall z, steered S (seen_B S J Phi B) z.
  apply: (white_limit_controllable model u_white v_leads past nq Jqt tH _ limit).
  by apply: row_free_shorter obs; apply: leq_pred.
split=> // /eqmxP eL; rewrite -whole -(same_range_similar S' obs); split=> [/eqmxP eO|/eqmxP eO].
  by apply/eqmxP; apply: eqmx_trans eL (eqmx_sym eO).
by apply/eqmxP; apply: eqmx_trans (eqmx_sym eO) eL.
Qed.
