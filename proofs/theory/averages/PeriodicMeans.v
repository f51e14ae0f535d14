(** The average over a period is a mean, over every field of characteristic 0, and over an ordered one no square has a negative average.
    Signals of period 3 meet the hypotheses of the theorems on inputs of a given order of the spectrum. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg ssrnum matrix.
From faultspace Require Import MeansVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Periods.
Variable K : numFieldType.
Implicit Types (f g : nat -> K).

Lemma period_many f d k : (forall t, f (t + d)%N = f t) -> forall t, f (t + k * d)%N = f t.
Proof. by move=> per; elim: k => [|k IH] t; rewrite ?mul0n ?addn0 // mulSn addnA IH. Qed.

Lemma sum_periods f d k : (forall t, f (t + d)%N = f t) -> \sum_(t < k * d) f t = (\sum_(t < d) f t) *+ k.
Proof.
move=> per; elim: k => [|k IH]; first by rewrite mul0n big_ord0.
rewrite mulSn big_split_ord /= mulrS; congr (_ + _); rewrite -IH; apply: eq_bigr => t _.
by rewrite addnC per.
Qed.

Lemma period_multiple f a d k : (0 < k)%N -> (0 < d)%N -> (forall t, f (t + d)%N = f t) -> \sum_(t < d) f t = d%:R * a ->
  [/\ (0 < k * d)%N, forall t, f (t + k * d)%N = f t & \sum_(t < k * d) f t = (k * d)%:R * a].
Proof.
move=> k0 d0 per sum; split; [by rewrite muln_gt0 k0|exact: (period_many k per)|].
by rewrite (sum_periods k per) sum natrM -mulrA [RHS]mulr_natl.
Qed.

Lemma common_period f g a b : period_average f a -> period_average g b -> exists d, [/\ (0 < d)%N, forall t, f (t + d)%N = f t,
  forall t, g (t + d)%N = g t, \sum_(t < d) f t = d%:R * a & \sum_(t < d) g t = d%:R * b].
Proof.
move=> [d d0 [perf sumf]] [d' d0' [perg sumg]]; have [_ pf sf] := period_multiple d0' d0 perf sumf.
have [_ pg sg] := period_multiple d0 d0' perg sumg; exists (d' * d)%N.
by split; rewrite ?muln_gt0 ?d0 ?d0' // mulnC.
Qed.

Theorem period_average_mean : mean (@period_average K).
Proof.
split=> [f a b fa fb|f g a fg [d d0 [per sum]]||f g a b c fa gb|f a [d d0 [per sum]]].
- have [d [d0 _ _ sa sb]] := common_period fa fb; apply: (mulfI (_ : d%:R != 0)); first by rewrite pnatr_eq0 -lt0n.
  by rewrite -sa -sb.
- by exists d => //; split=> [t|]; [rewrite -!fg|rewrite -sum; apply: eq_bigr => t _].
- by exists 1%N => //; split=> //; rewrite big_ord1 mulr0.
- have [d [d0 pf pg sa sb]] := common_period fa gb; exists d => //; split=> [t|]; first by rewrite pf pg.
  by rewrite big_split -mulr_sumr sa sb mulrDr mulrCA.
exists d => //; split=> [t|]; first by rewrite -addSn per.
rewrite -sum; case: d d0 per {sum} => // d _ per.
by rewrite big_ord_recr [RHS]big_ord_recl addrC /= -(per 0%N).
Qed.

(** Every periodic sequence has an average. *)
Lemma periodic_average f d : (0 < d)%N -> (forall t, f (t + d)%N = f t) -> exists a, period_average f a.
Proof.
move=> d0 per; exists ((\sum_(t < d) f t) / d%:R); exists d => //; split=> //.
by rewrite mulrC divfK // pnatr_eq0 -lt0n.
Qed.

Lemma periodic_quasi a (x : nat -> 'rV[K]_a) d : (0 < d)%N -> (forall t, x (t + d)%N = x t) -> quasi_stationary (@period_average K) x.
Proof.
move=> d0 per l; have one i j : exists r, period_average (fun t => x t 0 i * later l x t 0 j) r.
  by apply: (periodic_average d0) => t; rewrite /later per addnAC per.
have rows i : exists r : 'I_a -> K, forall j, period_average (fun t => x t 0 i * later l x t 0 j) (r j).
  by have [r hr] := fin_all_exists (one i); exists r.
by have [r hr] := fin_all_exists rows; exists (\matrix_(i, j) r i j) => i j; rewrite mxE.
Qed.

End Periods.

Theorem period_average_positive (K : realFieldType) : positive (@period_average K).
Proof.
move=> f a [d d0 [_ sum]]; rewrite -(pmulr_rge0 a (_ : 0 < d%:R :> K)) ?ltr0n // -sum; apply: sumr_ge0 => t _; exact: sqr_ge0.
Qed.

Theorem period_averages (K : realFieldType) : [/\ mean (@period_average K), positive (@period_average K), period_average (fun=> 1 : K) 1
  & forall (f : nat -> K) d, (0 < d)%N -> (forall t, f (t + d)%N = f t) -> exists a, period_average f a].
Proof.
split; [exact: period_average_mean|exact: period_average_positive| |exact: periodic_average].
by exists 1%N => //; split=> //; rewrite big_ord1 mulr1.
Qed.
