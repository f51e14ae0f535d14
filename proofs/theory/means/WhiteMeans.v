(** White noise in means: its samples at different times, and its parts, are uncorrelated. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import MeansVocabulary Means.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section White.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop).
Hypothesis isE : mean E.

Lemma white_later nu (u : nat -> 'rV[K]_nu) k l : white_noise E u -> covariance E (later k u) (later l u) (k == l)%:R%:M.
Proof.
move=> hu; have up k' l' : (k' <= l')%N -> covariance E (later k' u) (later l' u) (k' == l')%:R%:M.
  move=> kl; have := covariance_later isE k' (hu (l' - k')%N); have -> : (k' == l') = (l' - k' == 0)%N by rewrite subn_eq0 eqn_leq kl.
  by case: eqP => _; rewrite ?raddf0; apply: (covariance_ext isE) => // t; rewrite /later -addnA subnKC.
case/orP: (leq_total k l) => kl; first exact: up.
by have := covariance_transpose isE (up _ _ kl); rewrite tr_scalar_mx eq_sym.
Qed.

(** Successive samples of white noise are uncorrelated. *)
Lemma white_excites nu (u : nat -> 'rV[K]_nu) s : white_noise E u -> excites E s u.
Proof.
move=> hu; exists 1%:M; last exact: unitmx1.
move=> i j; case/mxvec_indexP: i => k i; case/mxvec_indexP: j => l j.
have -> : (1%:M : 'M[K]_(s * nu)) (mxvec_index k i) (mxvec_index l j) = ((k == l :> nat)%:R%:M : 'M[K]_nu) i j.
  rewrite !mxE; have -> : (mxvec_index k i == mxvec_index l j) = (k == l :> nat) && (i == j).
    by rewrite [in RHS](inj_eq val_inj); apply/eqP/andP => [/cast_ord_inj/enum_rank_inj[-> ->]|[/eqP-> /eqP->]].
  by case: (_ == _ :> nat); rewrite ?mul0rn ?andbF.
by apply: (mean_ext isE) (white_later k l hu i j) => t; rewrite /successive /later addn0 !mxE !mxvecE !mxE.
Qed.

Lemma white_before nu (u : nat -> 'rV[K]_nu) : white_noise E u -> knows_nothing_before E (later 1 u) u.
Proof.
move=> hu l; have := covariance_transpose isE (hu l.+1); rewrite trmx0; apply: (covariance_ext isE) => // t.
by rewrite /later addn1 addnS.
Qed.

Lemma white_autoregressive nu (u : nat -> 'rV[K]_nu) : white_noise E u -> autoregressive_input E 0 (fun=> 0) u u.
Proof.
move=> hu; split=> [t||]; [by rewrite big_ord0 add0r addn0|exists 1%:M; last exact: unitmx1|exact: white_before].
by apply: (covariance_ext isE) (hu 0%N) => // t; rewrite /later addn0.
Qed.

(** The parts of white noise are white, and uncorrelated with each other. *)
Lemma white_image a b (w : nat -> 'rV[K]_a) (u : nat -> 'rV[K]_b) (M : 'M_(a, b)) : white_noise E w -> M^T *m M = 1%:M ->
  (forall t, u t = w t *m M) -> white_noise E u.
Proof.
move=> hw MM e l; have := covariance_images isE M M (hw l); case: eqP => _; rewrite ?mulmx1 ?MM ?mulmx0 ?mul0mx.
  by apply: (covariance_ext isE) => t; rewrite /later e.
by apply: (covariance_ext isE) => t; rewrite /later e.
Qed.

Lemma white_parts a b c (w : nat -> 'rV[K]_a) (u : nat -> 'rV[K]_b) (v : nat -> 'rV[K]_c) (M : 'M_(a, b)) (M' : 'M_(a, c)) :
  white_noise E w -> M^T *m M' = 0 -> (forall t, u t = w t *m M) -> (forall t, v t = w t *m M') -> uncorrelated E u v.
Proof.
move=> hw MM eu ev l.
have zero k l' : covariance E (later k u) (later l' v) 0.
  have := covariance_images isE M M' (white_later k l' hw); rewrite mul_mx_scalar -scalemxAl MM scaler0.
  by apply: (covariance_ext isE) => t; rewrite /later ?eu ?ev.
by split; [apply: (covariance_ext isE) (zero 0%N l)|apply: (covariance_ext isE) (zero l 0%N)] => t; rewrite /later ?addn0.
Qed.

End White.
