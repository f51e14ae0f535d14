(** The delay of inversion with known initial state, told by ranks: T_(l+1) has m more than T_l just when l + 1 samples tell the first
    fault. #{orders of infinite zeros <= k} = rank T_(k+1) - rank T_k is how these orders are counted, so the delay is the largest of
    them; in sum they are the infinite zeros of the pencil, as rank T_s = s m - d from s = n on.

    first s == the first of s faults side by side *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Basics Windows Chain SilentSubspaces InfiniteZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Delay.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation rest s := (kermx (T S s)).

Fact first_linear s : linear (fun w : 'rV[K]_(s * m) => unsamples w 0).
Proof. by move=> a u w; rewrite unsamples_linear. Qed.
Definition first s := lin1_mx (fun w : 'rV[K]_(s * m) => unsamples w 0).

Lemma mul_first s (w : 'rV[K]_(s * m)) : w *m first s = unsamples w 0.
Proof. exact: mul_lin1 (@first_linear s). Qed.

(** Silent faults that begin with zero are silent faults one sample later. *)
Lemma rank_rest_later l : \rank (rest l.+1 :&: kermx (first l.+1))%MS = \rank (rest l).
Proof.
rewrite -[RHS](mxrankMfree _ (later_free K m 1 l)); apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  have := row_sub i (rest l.+1 :&: kermx (first l.+1))%MS; move: (row i _) => w; rewrite sub_capmx => /andP[/restP h /sub_kermxP].
  rewrite mul_first => w0; have -> : w = samples l (fun k => unsamples w k.+1) *m later_faults K m 1 l.
    rewrite (@mul_later_faults K m 1 l) -[LHS]unsamplesK; apply: samples_ext => -[|k] kl; rewrite /follow ?w0 //=.
    by rewrite subn1 samplesK.
  apply/submxMr/rest_samples => k kl; rewrite -[RHS](h k.+1) // output_step /= w0 mul0mx mul0mx addr0.
  by [].
rewrite row_mul; have := row_sub i (rest l); move: (row i _) => u /restP h.
rewrite (@mul_later_faults K m 1 l) sub_capmx; apply/andP; split.
  apply/(rest_samples S l.+1) => -[|k] kl; first by rewrite output_zero // => -[].
  rewrite output_step /= {1}/follow /= mul0mx mul0mx addr0 -[RHS](h k) //; apply: output_ext => j _.
  by rewrite /follow /= subn1.
by apply/sub_kermxP; rewrite mul_first samplesK.
Qed.

Theorem delay_by_ranks l : inverts_with_delay S l <-> \rank (T S l.+1) = (\rank (T S l) + m)%N.
Proof.
have kernel s : (\rank (T S s) + \rank (rest s) = s * m)%N by rewrite mxrank_ker subnKC ?rank_leq_row.
have split_rank := mxrank_mul_ker (rest l.+1) (first l.+1); rewrite rank_rest_later in split_rank.
have step : (l.+1 * m = m + l * m)%N by rewrite mulSn.
have -> : (\rank (T S l.+1) = \rank (T S l) + m)%N <-> \rank (rest l.+1 *m first l.+1) = 0%N.
  have arith (q q' a b c d e : nat) : (a + b = q -> c + d = q' -> q' = m + q -> e + b = d -> (c = a + m <-> e = 0))%N by lia.
  exact: arith (kernel l) (kernel l.+1) step split_rank.
split=> [delay | /eqP]; last first.
  rewrite mxrank_eq0 => /eqP z v silent; have /submxP[c cE] := (rest_samples S l.+1 v).2 (fun k kl => silent k kl).
  by rewrite -(samplesK v (ltn0Sn l)) -[LHS]mul_first cE -mulmxA z mulmx0.
apply/eqP; rewrite mxrank_eq0; apply/eqP/row_matrixP => i; rewrite row0 row_mul mul_first.
by apply: delay => k kl; have /restP := row_sub i (rest l.+1); apply.
Qed.

Theorem infinite_zeros_by_ranks d s : left_invertible S -> infinite_zeros S d -> (n <= s)%N -> (\rank (T S s) + d)%N = (s * m)%N.
Proof.
move=> inv infinite ns; have kernel : (\rank (T S s) + \rank (rest s) = s * m)%N by rewrite mxrank_ker subnKC ?rank_leq_row.
apply: etrans kernel; rewrite (infinite_zeros_unique infinite (number_of_infinite_zeros inv)) rank_rest; congr (_ + _)%N.
have -> : \rank (rest s :&: kermx (state_at S s s))%MS = 0%N.
  apply/eqP; rewrite mxrank_eq0; apply/eqP/row_matrixP => i; rewrite row0; have := row_sub i (rest s :&: kermx (state_at S s s))%MS.
  move: (row i _) => w; rewrite sub_capmx => /andP[/restP h /sub_kermxP]; rewrite mul_state_at => back.
  rewrite -[w]unsamplesK; apply/samples_eq0 => k ks; apply: inv => j; have [js|sj] := ltnP j s; first exact: h.
  rewrite -(subnKC sj) output_shift back output_zero // => i' _; exact: unsamples_ge (leq_addr _ _).
rewrite addn0; apply: eqmx_rank; apply/andP; split; first exact: (increasing (@silent_step_mono _ _ _ _ S) ns).
exact: (increasing_constant (@silent_step_mono _ _ _ _ S) s).
Qed.

End Delay.
