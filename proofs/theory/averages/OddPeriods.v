(** White signals that are uncorrelated with each other at all lags, as many as one likes: the sequence of Rudin and Shapiro times sequences
    of one odd period that are orthogonal. Sums of products over the times before 2 N are made of such sums over those before N, the even
    and the odd times of a sequence of odd period being of that period again. Walsh functions in their place do not do: their period is a
    power of two, and the sequence of Rudin and Shapiro has the same value at the times 4 t and 4 t + 1.

    periodic d M f == f has the period d, and no value is larger than M in size *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import MeansVocabulary ExampleVocabulary Means TimeAverages RudinShapiro Responses OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Sequence.
Variables (K : realFieldType) (d : nat).
Hypothesis d_odd : odd d.
Notation r := (@rudin_shapiro K).

Lemma shapiro_neighbours t : r (4 * t) = r (4 * t).+1.
Proof.
have -> : (4 * t = t.*2.*2)%N by lia.
by rewrite (shapiro_odd K) (sign_double K) mul1r (shapiro_even K).
Qed.

(** Of period d, and at most M in size. *)
Definition periodic M (f : nat -> K) := (forall t, f (t + d)%N = f t) /\ forall t, `|f t| <= M%:R.
Let evens (f : nat -> K) t := f t.*2.
Let odds (f : nat -> K) t := f t.*2.+1.

Lemma periodic_evens M f : periodic M f -> periodic M (evens f).
Proof. by case=> per le; split=> [t|t]; rewrite /evens // doubleD -(addnn d) addnA !per. Qed.
Lemma periodic_odds M f : periodic M f -> periodic M (odds f).
Proof. by case=> per le; split=> [t|t]; rewrite /odds // doubleD -(addnn d) addnA -!addSn !per. Qed.

Let c f (b : bool) l t := f t * ((-1) ^+ (b * t) * (r t * r (t + l)%N)).
Let sum_of f b l N := \sum_(t < N) c f b l t.

Lemma sum_even f b l N : sum_of f b l.*2 N.*2 = sum_of (evens f) false l N + (-1) ^+ (b + l) * sum_of (odds f) false l N.
Proof.
rewrite /sum_of (sum_double (c f b l.*2)) big_split mulr_sumr; congr (_ + _); apply: eq_bigr => t _; rewrite /c mul0n expr0 mul1r.
  by rewrite (sign_even K) mul1r -doubleD !(shapiro_even K).
rewrite addSn -doubleD !(shapiro_odd K) mulnS exprD (sign_even K) mulr1 -/(odds f t) [RHS]mulrCA; congr (_ * _).
rewrite [in RHS]exprD -[RHS]mulrA; congr (_ * _); by rewrite mulrACA -exprD addnA addnn exprD (sign_double K) mul1r.
Qed.

Lemma sum_odd f b l N : sum_of f b l.*2.+1 N.*2 = (-1) ^+ l * sum_of (evens f) true l N + (-1) ^+ b * sum_of (odds f) true l.+1 N.
Proof.
rewrite /sum_of (sum_double (c f b l.*2.+1)) big_split !mulr_sumr; congr (_ + _); apply: eq_bigr => t _; rewrite /c mul1n.
  rewrite (sign_even K) mul1r addnS -doubleD (shapiro_even K) (shapiro_odd K) exprD [RHS]mulrCA; congr (_ * _).
  by rewrite [_ * (-1) ^+ l]mulrC -!mulrA mulrCA; congr (_ * _); rewrite mulrCA.
have -> : (t.*2.+1 + l.*2.+1 = (t + l.+1).*2)%N by lia.
rewrite mulnS exprD (sign_even K) mulr1 (shapiro_even K) (shapiro_odd K) [LHS]mulrCA; congr (_ * _).
by rewrite -[in LHS]mulrA.
Qed.

Lemma term_bound M f b l t : periodic M f -> `|c f b l t| <= M%:R.
Proof. by case=> _ le; rewrite /c !normrM !(shapiro_norm K) normr_sign !mulr1. Qed.

Lemma sum_half M f b l N : periodic M f -> `|sum_of f b l N| <= `|sum_of f b l N./2.*2| + M%:R.
Proof.
move=> per; rewrite -{1}(odd_double_half N) addnC; case: (odd N); rewrite ?addn0 ?lerDl ?ler0n // addn1.
rewrite {1}/sum_of big_ord_recr /=; apply: le_trans (ler_normD _ _) _; rewrite lerD2l; exact: term_bound.
Qed.

Lemma by_halves M f b l C : periodic M f -> (forall k N, (N < 2 ^ k)%N -> `|sum_of f b l N.*2| <= (C * M * k)%:R + (2 * d * M)%:R) ->
  forall k N, (N < 2 ^ k)%N -> `|sum_of f b l N| <= ((C + 2 * d + 1) * M * k)%:R.
Proof.
move=> per h [[|//] _|k N Nk]; first by rewrite /sum_of big_ord0 normr0 muln0.
have {}Nk : (N./2 < 2 ^ k)%N by move: Nk; rewrite expnS; lia.
apply: le_trans (sum_half _ _ _ per) _; apply: le_trans (lerD (h k _ Nk) (lexx _)) _.
rewrite -!natrD ler_nat; have le : (0 <= M * k * (2 * d + 1))%N by []; nia.
Qed.

(** Signs that turn at each time, over an odd period. *)
Lemma sum_turned M f N : periodic M f -> `|sum_of f true 0 N| <= (2 * d * M)%:R.
Proof.
move=> [per le]; pose g t : K := f t * (-1) ^+ t.
have eg n : sum_of f true 0 n = \sum_(t < n) g t.
  by apply: eq_bigr => t _; rewrite /c /g mul1n addn0 (shapiro_square K) mulr1.
have turn t : g (t + d)%N = - g t.
  by rewrite /g per exprD -[(-1) ^+ d]signr_odd d_odd expr1 mulrN1 mulrN.
have twice t : g (t + (d + d))%N = g t by rewrite addnA !turn opprK.
rewrite eg; elim/ltn_ind: N => N IH; have [Nd|dN] := leqP (d + d) N; last first.
  apply: le_trans (ler_norm_sum _ _ _) _; apply: le_trans (_ : \sum_(t < N) M%:R <= _).
    by apply: ler_sum => t _; rewrite /g normrM normr_sign mulr1.
  by rewrite sumr_const card_ord -[_ *+ N]mulr_natr -natrM ler_nat; nia.
have e n : \sum_(t < d + d + n) g t = \sum_(t < n) g t.
  rewrite big_split_ord big_split_ord /= [X in _ + X + _](_ : _ = - \sum_(t < d) g t).
    by rewrite subrr add0r; apply: eq_bigr => t _; rewrite addnC twice.
  by rewrite -sumrN; apply: eq_bigr => t _; rewrite addnC turn.
rewrite -(subnKC Nd) e; apply: IH; have := d_odd; case: (d) Nd => // d' Nd _; lia.
Qed.

Lemma sum_turned_next k M f N : periodic M f -> (N < 2 ^ k)%N -> `|sum_of f true 1 N| <= ((2 * d + 1) * M * k)%:R.
Proof.
elim: k f N => [|k IH] f N per Nk.
  by have -> : N = 0%N by [lia]; rewrite /sum_of big_ord0 normr0 muln0.
have {}Nk : (N./2 < 2 ^ k)%N by move: Nk; rewrite expnS; lia.
apply: le_trans (sum_half _ _ _ per) _; rewrite (sum_odd f true 0) expr0 mul1r expr1 mulN1r.
apply: le_trans (lerD (ler_normB _ _) (lexx _)) _.
apply: le_trans (lerD (lerD (sum_turned _ (periodic_evens per)) (IH _ _ (periodic_odds per) Nk)) (lexx _)) _.
by rewrite -!natrD ler_nat; nia.
Qed.

Lemma log_bound l : (0 < l)%N -> forall b, exists C, forall M f, periodic M f -> forall k N, (N < 2 ^ k)%N ->
  `|sum_of f b l N| <= (C * M * k)%:R.
Proof.
elim/ltn_ind: l => l IH l0 b; have [l1|l2] := leqP l 1.
  have -> : l = 1%N by lia.
  exists (2 * d + 1 + 2 * d + 1)%N => M f per; apply: by_halves => // k N Nk; rewrite (sum_odd f b 0) expr0 mul1r.
  apply: le_trans (ler_normD _ _) _; rewrite normrM normr_sign mul1r addrC.
  exact: lerD (sum_turned_next (periodic_odds per) Nk) (sum_turned _ (periodic_evens per)).
have eh := odd_double_half l; have [lo|le] := boolP (odd l).
  have {}eh : l = l./2.*2.+1 by rewrite -{1}eh lo.
  have [C hC] := IH l./2 ltac:(lia) ltac:(lia) true; have [C' hC'] := IH l./2.+1 ltac:(lia) ltac:(lia) true.
  exists (C + C' + 2 * d + 1)%N => M f per; rewrite eh; apply: by_halves => // k N Nk; rewrite sum_odd.
  apply: le_trans (ler_normD _ _) _; rewrite !normrM !normr_sign !mul1r !mulnDl natrD.
  apply: le_trans (lerD (hC _ _ (periodic_evens per) _ _ Nk) (hC' _ _ (periodic_odds per) _ _ Nk)) _.
  by rewrite lerDl ler0n.
have {}eh : l = l./2.*2 by rewrite -{1}eh (negbTE le).
have [C hC] := IH l./2 ltac:(lia) ltac:(lia) false.
exists (C + C + 2 * d + 1)%N => M f per; rewrite eh; apply: by_halves => // k N Nk; rewrite sum_even.
apply: le_trans (ler_normD _ _) _; rewrite !normrM !normr_sign !mul1r !mulnDl natrD.
apply: le_trans (lerD (hC _ _ (periodic_evens per) _ _ Nk) (hC _ _ (periodic_odds per) _ _ Nk)) _.
by rewrite lerDl ler0n.
Qed.

Theorem average_of_period M f l : archimedean K -> periodic M f -> (0 < l)%N -> time_average (fun t => f t * (r t * r (t + l)%N)) 0.
Proof.
move=> arch per l0; have [C hC] := log_bound l0 false; apply: (average_log arch (C := (C * M)%N)) => k N Nk.
have := hC _ _ per _ _ Nk; rewrite /sum_of; congr (`|_| <= _); apply: eq_bigr => t _; by rewrite /c mul0n expr0 mul1r.
Qed.

End Sequence.

Section Source.
Variables (K : realFieldType) (N : nat).
Hypothesis arch : archimedean K.
Let E := @time_average K.
Let isE : mean E := time_average_mean arch.
Let a := N.*2.+1.
Let d := (a * a)%N.
Let turn (i : 'I_N) t : K := if (t %% d)%N == i then a%:R else 0.

Let turn_period (i : 'I_N) t : turn i (t + d)%N = turn i t. Proof. by rewrite /turn modnDr. Qed.
Let turn_bound (i : 'I_N) t : `|turn i t| <= a%:R. Proof. by rewrite /turn; case: ifP; rewrite ?normr0 ?normr_nat ?ler0n. Qed.
Let below (i : 'I_N) : (i < d)%N. Proof. by have := ltn_ord i; rewrite /d /a; nia. Qed.

Lemma source_turn t i : white_source K N t 0 i = turn i t * rudin_shapiro K t.
Proof. by rewrite mxE /turn; case: ifP => // _; rewrite mul0r. Qed.

Theorem source_white : white_noise E (@white_source K N).
Proof.
move=> l i j; case: l => [|l]; last first.
  rewrite mxE; have per : periodic d (a * a) (fun t => turn i t * turn j (t + l.+1)%N).
    split=> t; first by rewrite turn_period addnAC turn_period.
    by rewrite normrM natrM; apply: ler_pM; rewrite ?normr_ge0.
  have := @average_of_period K d _ _ _ l.+1 arch per isT => /(_ ltac:(by rewrite /d oddM /a /= odd_double)).
  apply: (mean_ext isE) => t; rewrite /later !source_turn -!mulrA; congr (_ * _).
  by rewrite mulrCA.
rewrite mxE; have square i' j' t : white_source K N t 0 i' * later 0 (white_source K N) t 0 j' = turn i' t * turn j' t.
  by rewrite /later addn0 !source_turn mulrACA (shapiro_square K) mulr1.
have [->|ij] := eqVneq i j; last first.
  apply: (mean_ext isE) (mean_zero isE) => t; rewrite square /turn; case: eqP => [->|]; rewrite ?mul0r //.
  by rewrite (inj_eq val_inj) (negbTE ij) mulr0.
apply: (mean_ext isE (f := fun t => turn j t * turn j t)) => [t|]; first by rewrite -square.
apply: (period_average_in_time arch); exists d; first by rewrite /d /a.
split=> [t|]; first by rewrite !turn_period.
rewrite (bigD1 (Ordinal (below j))) //= big1 => [|t]; last first.
  by rewrite -val_eqE /turn modn_small ?ltn_ord //= => /negbTE ->; rewrite mul0r.
by rewrite addr0 mulr1 /turn modn_small ?below // eqxx /d natrM.
Qed.

Lemma source_bounded t : size_of (white_source K N t) <= a%:R *+ N.
Proof.
rewrite /size_of -[X in _ *+ X]card_ord -sumr_const; apply: ler_sum => i _.
by rewrite source_turn normrM (shapiro_norm K) mulr1.
Qed.

End Source.
