(** Behaviours of two concrete systems over the rational numbers: that one lies in the other, that both are equal, on one window or for
    ever, by kernel rows which both obey and which are all there are; or that they differ, by a word of one that a kernel row of the other
    denies. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum ssrint
  rat matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Basics Infinite.
From faultspace Require Import CertificatesVocabulary Lists KernelRows ListedSystems CheckRows CheckRanks.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section TwoSystems.
Variables (n m n' m' p : nat) (L L' : listed).
Let S := meant n m p L.
Let S' := meant n' m' p L'.

(** `behaviour-inclusion`. *)
Theorem inclusion_sound l rows lower : check_inclusion n m n' m' p l L L' rows lower ->
  (forall s r, word S s r -> word S' s r) /\ (forall r, behavior S r -> behavior S' r).
Proof.
case/and3P=> /meets_sound[_ ind ann' e] wf k; have ann := rows_annihilate wf k.
have sub s r : word S s r -> word S' s r.
  by move=> h; apply/(word_iff_satisfies ind ann'); [apply: meets_for_ever|apply: word_satisfies h].
by split=> //; apply/behavior_subP.
Qed.

(** `behaviour-equality`. *)
Theorem equality_sound l rows lower lower' : check_equality n m n' m' p l L L' rows lower lower' ->
  (forall s r, word S s r <-> word S' s r) /\ (forall r, behavior S r <-> behavior S' r).
Proof.
case/andP=> /meets_sound[_ ind ann e] /meets_sound[_ _ ann' e'].
have eq s r : word S s r <-> word S' s r.
  have h := word_iff_satisfies ind ann r (meets_for_ever ind ann s e).
  have h' := word_iff_satisfies ind ann' r (meets_for_ever ind ann' s e').
  by split=> [/h/h'|/h'/h].
by split=> //; apply/behavior_eqP.
Qed.

(** `window-equality`. *)
Theorem window_equality_sound s l rows ws ws' : check_window_equality n m n' m' p s l L L' rows ws ws' ->
  forall r, word S s r <-> word S' s r.
Proof.
case/and3P=> _ /meets_sound[_ ind ann e] /meets_sound[_ _ ann' e'] r.
have h := word_iff_satisfies ind ann r e; have h' := word_iff_satisfies ind ann' r e'.
by split=> [/h/h'|/h'/h].
Qed.

(** `behaviour-difference`. *)
Lemma pairing_meaning c outputs : all (fun r => size r <= p)%N outputs -> (size c <= size outputs)%N ->
  relation (columns p (weighted (den L) c).2) (fun k => vec ratF p (nth [::] outputs k)) = (ratn (pairing (den L) c outputs))%:M.
Proof.
rewrite /pairing -(weighted_size L c); elim: (weighted _ c).2 outputs => [|c0 cs IH] outputs.
  have z : (ratn Z0)%:M = 0 :> 'M[rat]_1 by rewrite [ratn _](rmorph0 (number_rmorphism _)) raddf0.
  by rewrite /relation big_ord0; case: outputs => [|r outputs] _ _ /=; rewrite z.
case: outputs => // r outputs /= /andP[r_p h] few; rewrite relation_cons /= (number_dot _ _ r_p) IH //.
by rewrite -raddfD -rmorphD.
Qed.

Theorem difference_sound s x vs c : check_difference n m n' m' p s L L' x vs c -> exists2 r, word S s r & ~ word S' s r.
Proof.
case/andP=> /and5P[wf wf' ann /andP[_ cs] /eqP sv] /andP[short different].
exists (output S (vec ratF n x) (fun j => ratn (den L) ^- j *: vec ratF m (nth [::] vs j))); first exact: output_word.
move=> [y [w e]]; move/eqP: different; apply; apply/eqP; rewrite -number_eq0; apply/eqP.
have sizes : size (simulate L x vs) = size vs by elim: (vs) (x) => //= v vs0 IH x0; rewrite IH.
have := pairing_meaning short (_ : (size c <= _)%N); rewrite sizes sv => /(_ cs)/matrixP/(_ 0 0); rewrite [in RHS]mxE mulr1n => <-.
transitivity ((relation (columns p (weighted (den L) c).2)
  (output (integral n m p L) (vec ratF n x) (fun j => vec ratF m (nth [::] vs j)))) 0 0).
  congr (fun_of_matrix _ 0 0); apply: eq_bigr => k _; rewrite (simulate_output wf) //.
  by rewrite sv; apply: leq_trans (ltn_ord k) _; rewrite size_map weighted_size.
rewrite (relation_scaled wf) (_ : relation _ _ = relation (columns p c) (output S' y w)).
  by rewrite (annihilated_sound wf' ann) scaler0 mxE.
by apply: eq_bigr => k _; rewrite -e //; apply: leq_trans (ltn_ord k) _; rewrite size_map.
Qed.

End TwoSystems.
