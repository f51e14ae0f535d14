(** The limit of averages over ever longer times is a mean, over every ordered field without infinite numbers; no square has a negative one,
    and of a periodic sequence it is the average over a period. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat fintype bigop order ssralg ssrnum zify.
From faultspace Require Import MeansVocabulary OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Averages.
Variable K : realFieldType.
Hypothesis arch : archimedean K.
Implicit Types (f g : nat -> K).

Lemma average_unique f a b : time_average f a -> time_average f b -> a = b.
Proof.
move=> fa fb; apply/eqP; rewrite -subr_eq0; apply: contraT; rewrite -normr_gt0 => pos; set d := `|a - b| in pos.
have [M hM] := fa _ (divr_gt0 pos (ltr0n K 3)); have [M' hM'] := fb _ (divr_gt0 pos (ltr0n K 3)).
pose N := (maxn M M').+1; have NM : (M <= N)%N by rewrite leqW ?leq_maxl.
have NM' : (M' <= N)%N by rewrite leqW ?leq_maxr.
have := le_trans (ler_normB _ _) (lerD (hM' N NM') (hM N NM)).
rewrite opprB [X in `|X|]addrC addrA subrK -mulrBr normrM normr_nat -mulrDr ler_pM2l ?ltr0n // -/d -mulrDl.
rewrite ler_pdivlMr ?ltr0n // -[3%N]/(2 + 1)%N natrD mulrDr mulr1 mulr_natr mulr2n.
by rewrite gerDl leNgt pos.
Qed.

Lemma average_linear f g a b c : time_average f a -> time_average g b -> time_average (fun t => c * f t + g t) (c * a + b).
Proof.
move=> fa gb eps e0; have c0 : 0 < `|c| + 1 by rewrite ltr_pwDr ?ltr01.
have h2 : 0 < eps / 2%:R by rewrite divr_gt0 ?ltr0n.
have [M hM] := fa _ (divr_gt0 h2 c0); have [M' hM'] := gb _ h2.
exists (maxn M M') => N; rewrite geq_max => /andP[NM NM'].
rewrite big_split -mulr_sumr mulrDr opprD addrACA mulrCA -mulrBr.
apply: le_trans (ler_normD _ _) _; rewrite normrM.
have -> : N%:R * eps = N%:R * (eps / 2%:R) + N%:R * (eps / 2%:R).
  by rewrite -mulrDr -mulrDr -[2%:R^-1 + _]mulr2n -[_ *+ 2]mulr_natr mulVf ?mulr1 ?pnatr_eq0.
apply: lerD; last exact: hM'.
apply: le_trans (ler_wpM2l (normr_ge0 c) (hM N NM)) _.
rewrite mulrCA; apply: ler_wpM2l; first exact: ler0n.
rewrite mulrCA ger_pMr // ler_pdivrMr // mul1r; by rewrite lerDl ler01.
Qed.

Lemma average_shift f a : time_average f a -> time_average (fun t => f t.+1) a.
Proof.
move=> fa eps e0; have h4 : 0 < eps / 4%:R by rewrite divr_gt0 ?ltr0n.
have [M hM] := fa _ h4; have [k hk] := arch (`|f 0%N - a| / (eps / 4%:R)).
rewrite ltr_pdivrMr // in hk; exists (maxn M k).+1 => N; rewrite gtn_max => /andP[NM Nk].
have eN : \sum_(t < N) f t.+1 - N%:R * a = (\sum_(t < N.+1) f t - N.+1%:R * a) - (f 0%N - a).
  by rewrite big_ord_recl mulrSr mulrDl mul1r opprD [f _ + _]addrC addrACA addrK.
rewrite eN; apply: le_trans (ler_normB _ _) _.
have b1 := hM N.+1 (leqW (ltnW NM)); have N0 : (0 < N)%N by apply: leq_ltn_trans NM.
have b2 : `|f 0%N - a| <= N%:R * (eps / 4%:R).
  apply: le_trans (ltW hk) _; apply: ler_wpM2r; rewrite ?(ltW h4) // ler_nat; exact: ltnW.
have b3 : N.+1%:R * (eps / 4%:R) <= (N + N)%:R * (eps / 4%:R) by apply: ler_wpM2r; rewrite ?(ltW h4) // ler_nat -addn1 leq_add2l.
apply: le_trans (lerD (le_trans b1 b3) b2) _.
rewrite -mulrDl -natrD mulrA ler_pdivrMr ?ltr0n // [X in _ <= X]mulrAC -natrM; apply: ler_wpM2r; rewrite ?(ltW e0) // ler_nat; lia.
Qed.

Theorem time_average_mean : mean (@time_average K).
Proof.
split; [exact: average_unique| | |exact: average_linear|exact: average_shift].
  by move=> f g a fg fa eps e0; have [M hM] := fa eps e0; exists M => N NM; rewrite -(eq_bigr _ (fun (t : 'I_N) _ => fg t)); apply: hM.
by move=> eps e0; exists 0%N => N _; rewrite big1 // mulr0 subr0 normr0 mulr_ge0 ?ler0n ?ltW.
Qed.

Theorem time_average_positive : positive (@time_average K).
Proof.
move=> f a fa; rewrite leNgt; apply/negP => a0; have e0 : 0 < - a / 2%:R by rewrite divr_gt0 ?ltr0n // oppr_gt0.
have [M hM] := fa _ e0; have := hM M.+1 (leqnSn M); rewrite ler_norml => /andP[_].
have s0 : 0 <= \sum_(t < M.+1) f t ^+ 2 by apply: sumr_ge0 => t _; apply: sqr_ge0.
move=> le; have {le} := le_trans (lerD s0 (lexx _)) le.
rewrite add0r -mulrN ler_pM2l ?ltr0n // ler_pdivlMr ?ltr0n // mulr_natr mulr2n gerDl oppr_le0.
by rewrite leNgt a0.
Qed.

(** Where the sums differ from N a by what is bounded. *)
Lemma average_bounded_error f a c : (forall N, `|\sum_(t < N) f t - N%:R * a| <= c) -> time_average f a.
Proof.
move=> h eps e0; have [k hk] := arch (c / eps); exists k => N kN; apply: le_trans (h N) _.
rewrite ltr_pdivrMr // in hk; apply: le_trans (ltW hk) _; by rewrite ler_pM2r // ler_nat.
Qed.

Lemma average_constant (a : K) : time_average (fun=> a) a.
Proof.
by apply: (average_bounded_error (c := 0)) => N; rewrite sumr_const card_ord mulr_natl subrr normr0.
Qed.

Theorem period_average_in_time f a : period_average f a -> time_average f a.
Proof.
move=> [d d0 [per sum]].
pose c := \sum_(t < d) `|f t - a|; apply: (average_bounded_error (c := c)) => N.
have -> : \sum_(t < N) f t - N%:R * a = \sum_(t < N) (f t - a).
  by rewrite sumrB sumr_const card_ord mulr_natl.
pose g t := f t - a; rewrite -[X in `|X|]/(\sum_(t < N) g t).
have perg t : g (t + d)%N = g t by rewrite /g per.
have zero : \sum_(t < d) g t = 0 by rewrite sumrB sumr_const card_ord sum mulr_natl subrr.
elim/ltn_ind: N => N IH; have [Nd|dN] := leqP d N; last first.
  apply: le_trans (ler_norm_sum _ _ _) _; rewrite /c (big_ord_widen d (fun t => `|g t|) (ltnW dN)) big_mkcond.
  by apply: ler_sum => t _; case: ifP.
have e M : \sum_(t < d + M) g t = \sum_(t < M) g t.
  by rewrite big_split_ord /= zero add0r; apply: eq_bigr => t _; rewrite addnC perg.
have := e (N - d)%N; rewrite subnKC // => ->; apply: IH; lia.
Qed.

End Averages.
