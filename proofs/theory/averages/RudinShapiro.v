(** White signals for the mean of time averages: the sequence of Rudin and Shapiro and the same with every second sign turned have values 1
    and -1, are white and are uncorrelated at all lags. Sums of products over the times before 2 N are made of such sums over those before
    N, so that they grow like the logarithm of N. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop prime order zmodp ssralg finalg
  ssrnum matrix zify.
From faultspace Require Import MeansVocabulary ExampleVocabulary Means TimeAverages OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Sequence.
Variable K : realFieldType.
Let r := @rudin_shapiro K.

Lemma shapiro_enough t M : (t <= M)%N -> r t = (-1) ^+ \sum_(i < M) (odd (t %/ 2 ^ i) && odd (t %/ 2 ^ i.+1)).
Proof.
move=> tM; rewrite -(subnKC tM) big_split_ord /= [X in (_ + X)%N]big1 ?addn0 // => i _.
by rewrite divn_small //; apply: leq_trans (ltn_expl t (leqnn 2)) _; rewrite leq_exp2l ?leq_addr.
Qed.

Let digit t i := odd (t %/ 2 ^ i) && odd (t %/ 2 ^ i.+1).

Lemma digit_even t i : digit t.*2 i.+1 = digit t i.
Proof. by rewrite /digit !expnS !divnMA -muln2 mulnK. Qed.

Lemma digit_odd t i : digit t.*2.+1 i.+1 = digit t i.
Proof. by rewrite /digit !expnS !divnMA [(t.*2.+1 %/ 2)%N]divn2 -[t.*2.+1]/(true + t.*2)%N half_bit_double. Qed.

Lemma shapiro_even t : r t.*2 = r t.
Proof.
rewrite (shapiro_enough (leqnSn t.*2)) (shapiro_enough (_ : (t <= t.*2)%N)); last by rewrite -addnn leq_addr.
rewrite big_ord_recl expn0 divn1 odd_double add0n; congr (_ ^+ _); apply: eq_bigr => i _.
exact: (congr1 nat_of_bool (digit_even t i)).
Qed.

Lemma shapiro_odd t : r t.*2.+1 = (-1) ^+ t * r t.
Proof.
have half : (t.*2.+1 %/ 2 = t)%N by rewrite divn2 -[t.*2.+1]/(true + t.*2)%N half_bit_double.
rewrite (shapiro_enough (leqnn t.*2.+1)) (shapiro_enough (_ : (t <= t.*2)%N)); last by rewrite -addnn leq_addr.
rewrite big_ord_recl expn0 divn1 expn1 half /= odd_double /= exprD signr_odd; congr (_ * (_ ^+ _)); apply: eq_bigr => i _.
exact: (congr1 nat_of_bool (digit_odd t i)).
Qed.

Lemma shapiro_square t : r t * r t = 1.
Proof. by rewrite /r /rudin_shapiro -expr2 sqrr_sign. Qed.

Lemma shapiro_norm t : `|r t| = 1.
Proof. by rewrite /r /rudin_shapiro normr_sign. Qed.

(** The sums of products at the lag l, with turned signs where b. *)
Let c (b : bool) l t := (-1) ^+ (b * t) * (r t * r (t + l)%N).
Let sum_of b l N := \sum_(t < N) c b l t.

Lemma sum_double (f : nat -> K) N : \sum_(t < N.*2) f t = \sum_(t < N) (f t.*2 + f t.*2.+1).
Proof. by elim: N => [|N IH]; rewrite ?big_ord0 // doubleS !big_ord_recr /= IH addrA. Qed.

Lemma sign_even (b : bool) t : (-1) ^+ (b * t.*2) = 1 :> K.
Proof. by rewrite -doubleMr -signr_odd odd_double. Qed.
Lemma sign_double t : (-1) ^+ t.*2 = 1 :> K.
Proof. by rewrite -signr_odd odd_double. Qed.

Lemma sum_even b l N : sum_of b l.*2 N.*2 = (1 + (-1) ^+ (b + l)) * sum_of false l N.
Proof.
rewrite /sum_of sum_double mulr_sumr; apply: eq_bigr => t _; rewrite /c mul0n expr0 mul1r sign_even mulnS exprD sign_even mulr1.
rewrite -doubleD addSn -doubleD !shapiro_even !shapiro_odd mulrDl !mul1r; congr (_ + _).
have e (x y z a b' : K) : x * ((y * z) * (a * b')) = x * (y * a) * (z * b') by rewrite -[RHS]mulrA; congr (_ * _); apply: mulrACA.
rewrite e; congr (_ * _); by rewrite -exprD addnA addnn exprD sign_double mul1r -exprD.
Qed.

Lemma sum_odd b l N : sum_of b l.*2.+1 N.*2 = (-1) ^+ l * sum_of true l N + (-1) ^+ b * sum_of true l.+1 N.
Proof.
rewrite /sum_of sum_double big_split !mulr_sumr; congr (_ + _); apply: eq_bigr => t _; rewrite /c mul1n.
  by rewrite sign_even mul1r addnS -doubleD shapiro_even shapiro_odd exprD; set x := r t; set y := r _;
    rewrite mulrCA [_ ^+ t * _]mulrC -!mulrA.
have -> : (t.*2.+1 + l.*2.+1 = (t + l.+1).*2)%N by lia.
by rewrite mulnS exprD sign_even mulr1 shapiro_even shapiro_odd !mulrA.
Qed.

Lemma sum_half b l N : `|sum_of b l N| <= `|sum_of b l N./2.*2| + 1.
Proof.
rewrite -{1}(odd_double_half N) addnC; case: (odd N); rewrite ?addn0 ?lerDl ?ler01 // addn1.
rewrite {1}/sum_of big_ord_recr /=; apply: le_trans (ler_normD _ _) _; rewrite lerD2l.
by rewrite /c !normrM !shapiro_norm normr_sign !mulr1.
Qed.

Lemma by_halves b l C : (forall k M, (M < 2 ^ k)%N -> `|sum_of b l M.*2| <= (C * k)%:R + 1) ->
  forall k N, (N < 2 ^ k)%N -> `|sum_of b l N| <= ((C + 2) * k)%:R.
Proof.
move=> h [[|//] _|k N Nk]; first by rewrite /sum_of big_ord0 normr0 muln0.
have {}Nk : (N./2 < 2 ^ k)%N by move: Nk; rewrite expnS; lia.
apply: le_trans (sum_half _ _ _) _; apply: le_trans (lerD (h k _ Nk) (lexx 1)) _.
by rewrite -[1]/(1%:R) -!natrD ler_nat mulnS; nia.
Qed.

Lemma sum_turned N : `|sum_of true 0 N| <= 1.
Proof. by apply: le_trans (sum_half _ _ _) _; rewrite (sum_even true 0) addn0 expr1 subrr mul0r normr0 add0r. Qed.

Lemma sum_turned_next k N : (N < 2 ^ k)%N -> `|sum_of true 1 N| <= (3 * k)%:R.
Proof.
elim: k N => [[|//] _|k IH N Nk]; first by rewrite /sum_of big_ord0 normr0 muln0.
have {}Nk : (N./2 < 2 ^ k)%N by move: Nk; rewrite expnS; lia.
apply: le_trans (sum_half _ _ _) _; rewrite (sum_odd true 0) expr0 mul1r expr1 mulN1r.
apply: le_trans (lerD (ler_normB _ _) (lexx 1)) _.
apply: le_trans (lerD (lerD (sum_turned _) (IH _ Nk)) (lexx 1)) _.
by rewrite -[1]/(1%:R) -!natrD ler_nat mulnS; lia.
Qed.

Lemma log_bound l : (0 < l)%N -> forall b, exists C, forall k N, (N < 2 ^ k)%N -> `|sum_of b l N| <= (C * k)%:R.
Proof.
elim/ltn_ind: l => l IH l0 b; have [l1|l2] := leqP l 1.
  have -> : l = 1%N by lia.
  exists (3 + 2)%N; apply: by_halves => k M Mk; rewrite (sum_odd b 0) expr0 mul1r.
  apply: le_trans (ler_normD _ _) _; rewrite normrM normr_sign mul1r addrC.
  exact: lerD (sum_turned_next Mk) (sum_turned _).
have eh := odd_double_half l; have [lo|le] := boolP (odd l).
  have {}eh : l = l./2.*2.+1 by rewrite -{1}eh lo.
  have [C hC] := IH l./2 ltac:(lia) ltac:(lia) true; have [C' hC'] := IH l./2.+1 ltac:(lia) ltac:(lia) true.
  exists (C + C' + 2)%N; rewrite eh; apply: by_halves => k M Mk; rewrite sum_odd.
  apply: le_trans (ler_normD _ _) _; rewrite !normrM !normr_sign !mul1r mulnDl natrD.
  by apply: le_trans (lerD (hC _ _ Mk) (hC' _ _ Mk)) _; rewrite lerDl ler01.
have {}eh : l = l./2.*2 by rewrite -{1}eh (negbTE le).
have [C hC] := IH l./2 ltac:(lia) ltac:(lia) false.
exists (C + C + 2)%N; rewrite eh; apply: by_halves => k M Mk; rewrite sum_even.
rewrite mulrDl mul1r; apply: le_trans (ler_normD _ _) _; rewrite !normrM !normr_sign !mul1r mulnDl natrD.
by apply: le_trans (lerD (hC _ _ Mk) (hC _ _ Mk)) _; rewrite lerDl ler01.
Qed.

Lemma square_below_power k : (k * k <= 4 * 2 ^ k.-1)%N.
Proof.
case: k => // k; rewrite /=; elim: k => // k IH; rewrite expnS; case: k IH => [|[|k]] //.
set P := (2 ^ k.+2)%N; nia.
Qed.

Hypothesis arch : archimedean K.

Lemma average_log (f : nat -> K) C : (forall k N, (N < 2 ^ k)%N -> `|\sum_(t < N) f t| <= (C * k)%:R) -> time_average f (0 : K).
Proof.
move=> h eps e0; have [q hq] := arch (C%:R / eps); rewrite ltr_pdivrMr // in hq.
exists (2 ^ (4 * q))%N => N NM; rewrite mulr0 subr0; pose k := (trunc_log 2 N).+1.
have N0 : (0 < N)%N by apply: leq_trans NM; rewrite expn_gt0.
have /andP[le lt] := trunc_log_bounds (leqnn 2) N0.
have kq : (4 * q < k)%N by rewrite -(ltn_exp2l _ _ (leqnn 2)); apply: leq_ltn_trans NM lt.
have qk : (q * k <= N)%N by apply: leq_trans le; have := square_below_power k; rewrite /k /= -/k; nia.
apply: le_trans (h k N lt) _; rewrite natrM; apply: le_trans (ler_wpM2r (ler0n _ k) (ltW hq)) _.
by rewrite mulrAC -natrM ler_wpM2r ?(ltW e0) // ler_nat.
Qed.

Lemma average_products b l : (0 < l)%N -> time_average (c b l) 0.
Proof. by move=> l0; have [C hC] := log_bound l0 b; apply: (average_log (C := C)). Qed.

Lemma average_turned : time_average (c true 0) 0.
Proof.
apply: (average_bounded_error arch (c := 1)) => N; rewrite mulr0 subr0; exact: sum_turned.
Qed.

Let u t : 'rV[K]_1 := (rudin_shapiro K t)%:M.
Let v t : 'rV[K]_1 := (rudin_shapiro_turned K t)%:M.
Let isE := time_average_mean arch.

Let covariance_scalar (x y : nat -> K) a : time_average (fun t => x t * y t) a ->
  covariance (@time_average K) (fun t => (x t)%:M : 'rV_1) (fun t => (y t)%:M : 'rV_1) a%:M.
Proof. by move=> e i j; rewrite !ord1 mxE eqxx mulr1n; apply: (mean_ext isE) e => t; rewrite !mxE eqxx !mulr1n. Qed.

Theorem shapiro_white : [/\ white_noise (@time_average K) u, white_noise (@time_average K) v & uncorrelated (@time_average K) u v].
Proof.
have two l (b : bool) : time_average (c b l) (if (l == 0%N) && ~~ b then 1 else 0 : K).
  case: l => [|l]; last exact: average_products.
  case: b; first exact: average_turned.
  by apply: (mean_ext isE) (average_constant arch 1) => t; rewrite /c addn0 shapiro_square mul0n mul1r.
have unit l : (if l == 0%N then 1%:M else 0) = (if (l == 0%N) && ~~ false then 1 else 0)%:M :> 'M[K]_1.
  by rewrite andbT; case: ifP; rewrite ?raddf0.
have zero l : (if (l == 0%N) && ~~ true then 1 else 0)%:M = 0 :> 'M[K]_1 by rewrite andbF raddf0.
have turn l t : r t * rudin_shapiro_turned K (t + l)%N = (-1) ^+ l * c true l t.
  by rewrite /rudin_shapiro_turned /c mul1n mulrCA exprD [_ ^+ t * _]mulrC -!mulrA.
split=> l.
- by rewrite unit; apply: covariance_scalar; apply: (mean_ext isE) (two l false) => t; rewrite /c mul0n mul1r.
- rewrite unit; apply: covariance_scalar; have := mean_scale isE ((-1) ^+ l) (two l false).
  have -> : (-1) ^+ l * (if (l == 0%N) && ~~ false then 1 else 0) = (if (l == 0%N) && ~~ false then 1 else 0) :> K.
    by rewrite andbT; case: eqP => [->|_]; rewrite ?mulr0 // expr0 mulr1.
  apply: (mean_ext isE) => t; rewrite /later /rudin_shapiro_turned mulrACA -exprD addnA addnn exprD sign_double mul1r.
  by rewrite /c mul0n expr0 mul1r.
split; rewrite -(zero l); apply: covariance_scalar.
  have := mean_scale isE ((-1) ^+ l) (two l true); rewrite {1}andbF mulr0 andbF; apply: (mean_ext isE) => t; by rewrite -turn.
apply: (mean_ext isE) (two l true) => t; rewrite /c mul1n [r t * _]mulrC mulrCA; congr (_ * _).
Qed.

End Sequence.
