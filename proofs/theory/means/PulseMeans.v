(** White signals and a mean in which they are white at all lags. The times are cut into blocks, block i from i^2 to (i+1)^2, and the mean
    of f is the sum of f over a block, where that is the same for all late blocks, however they are shifted: the energy of pulses that come
    ever more rarely. One signal has a pulse in the middle of each block and the other a quarter after its beginning: white both, and
    uncorrelated at all lags. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  zify.
From faultspace Require Import Vocabulary Places Consistency LimitsVocabulary MeansVocabulary ExampleVocabulary Means Forgetting.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Pulses.
Variable K : fieldType.

Let block_sum := @block_sum K.

Lemma block_mean : mean block_sum.
Proof.
split=> [f a b fa fb|f g a fg fa J||f g a b c fa gb J|f a fa J].
- have [M hM] := fa 0%N; have [M' hM'] := fb 0%N.
  by rewrite -(hM (maxn M M')) ?leq_maxl // (hM' (maxn M M')) ?leq_maxr.
- by have [M hM] := fa J; exists M => i Mi; rewrite -(hM i Mi); apply: eq_bigr => j _; rewrite fg.
- by exists 0%N => i _; rewrite big1.
- have [M hM] := fa J; have [M' hM'] := gb J; exists (maxn M M') => i; rewrite geq_max => /andP[Mi Mi'].
  by rewrite big_split -mulr_sumr hM // hM'.
have [M hM] := fa J.+1; exists M => i Mi; rewrite -(hM i Mi); apply: eq_bigr => j _.
by rewrite addSn addnS.
Qed.

(** The pulses: in block i at c(i), c = spot (h, d) being i/2 + d or i + d. *)
Let spot (c : bool * nat) i := ((if c.1 then i./2 else i) + c.2)%N.
Let mark c k : K := [exists i : 'I_k.+1, k == i * i + spot c i]%N%:R.

Lemma mark_at c i d : (c.2 <= 1)%N -> (2 <= i)%N -> (d < i.*2.+1 + spot c i.+1)%N -> mark c (i * i + d)%N = (d == spot c i)%:R.
Proof.
move=> c1 i2 dlt; congr (_%:R); apply: (congr1 nat_of_bool); apply/existsP/eqP => [[[i' lt] /= /eqP e]|->]; last first.
  by have lt : (i < (i * i + spot c i).+1)%N; [nia|exists (Ordinal lt)].
have pl k : (spot c k <= k + 1)%N by rewrite /spot; case: ifP => _; lia.
have pl1 := pl i'; have pl2 := pl i.+1; have [ii|ii|ei] := ltngtP i' i; last by move: e; rewrite ei; lia.
  by exfalso; nia.
have [e'|ne] := eqVneq i' i.+1; last by exfalso; nia.
by exfalso; move: dlt e; rewrite e'; set P := spot c i.+1; nia.
Qed.

Lemma mark_next c t : mark (c.1, c.2.+1) t.+1 = mark c t.
Proof.
congr (_%:R); apply: (congr1 nat_of_bool); apply/existsP/existsP => [[[i lt] /= /eqP e]|[[i lt] /= /eqP e]].
  have e' : t = (i * i + spot c i)%N by move: e; rewrite /spot /= addnS addnS => -[].
  have lt' : (i < t.+1)%N by nia.
  by exists (Ordinal lt'); rewrite /= -e'.
by exists (Ordinal (leqW lt : (i < t.+2)%N)); rewrite /= {1}e /spot /= !addnS.
Qed.

(** Whether two pulses that are k and l samples later meet, in all late blocks. *)
Lemma pulses_meet k l c c' : (c.2 <= 1)%N -> (c'.2 <= 1)%N ->
  block_sum (fun t => mark c (t + k)%N * mark c' (t + l)%N) ((c.1 == c'.1) && (c.2 + l == c'.2 + k)%N)%:R.
Proof.
move=> c1 c1' J; exists (4 * (J + k + l + 3))%N => i iM.
have big e : (e.2 <= 1)%N -> [/\ (J + k + l + 2 <= spot e i)%N, (J + k + l + 2 <= spot e i.+1)%N & (spot e i <= i + 1)%N].
  by move=> e1; rewrite /spot; case: e.1; split; lia.
have [b1 b2 b3] := big c c1; have [b1' b2' b3'] := big c' c1'.
have at_c (j : 'I_i.*2.+1) : mark c (i * i + (J + j) + k)%N = (j == spot c i - J - k :> nat)%N%:R.
  rewrite -addnA mark_at //; [congr (_%:R); congr nat_of_bool; apply/eqP/eqP; lia|lia|have := ltn_ord j; lia].
have at_c' (j : 'I_i.*2.+1) : mark c' (i * i + (J + j) + l)%N = (j == spot c' i - J - l :> nat)%N%:R.
  rewrite -addnA mark_at //; [congr (_%:R); congr nat_of_bool; apply/eqP/eqP; lia|lia|have := ltn_ord j; lia].
have lt : (spot c i - J - k < i.*2.+1)%N by lia.
rewrite (bigD1 (Ordinal lt)) //= big1 ?addr0 => [|j]; last first.
  by rewrite at_c -val_eqE /= => /negbTE->; rewrite mul0r.
have := at_c (Ordinal lt); have := at_c' (Ordinal lt); rewrite /= eqxx => -> ->; rewrite mul1r; congr (_%:R); congr nat_of_bool.
rewrite /spot in b1 b1' b2 b2' *; case: c c' c1 c1' b1 b1' b2 b2' b3 b3' lt at_c at_c' big => [[] d] [[] d'] /= c1 c1' b1 b1' b2 b2' _ _ _
  _ _ _.
all: by rewrite ?eqxx /=; apply/eqP/eqP; lia.
Qed.

Let cs : seq (bool * nat) := [:: (false, 0); (true, 0); (false, 1); (true, 1)]%N.
Let g t : 'rV[K]_4 := \row_i mark (nth (false, 0%N) cs i) t.

Lemma pulses_quasi : quasi_stationary block_sum g.
Proof.
move=> l; exists (\matrix_(i, j) let c := nth (false, 0%N) cs i in let c' := nth (false, 0%N) cs j in
  ((c.1 == c'.1) && (c.2 + l == c'.2 + 0)%N)%:R) => i j.
have d1 (k : 'I_4) : ((nth (false, 0%N) cs k).2 <= 1)%N by case: k => -[|[|[|[|//]]]].
have := pulses_meet 0 l (d1 i) (d1 j); rewrite mxE; apply: (mean_ext block_mean) => t.
by rewrite /later /g !mxE addn0.
Qed.

Let P c t : 'rV[K]_1 := (mark c t)%:M.

Lemma pulse_combination (i : 'I_4) : combination g (P (nth (false, 0%N) cs i)).
Proof.
apply: combination_ext (combination_part g (delta_mx i 0)) => t.
by apply/matrixP=> a b; rewrite !ord1 -colE !mxE mulr1n.
Qed.

Lemma pulses_covariance k l c c' : (c.2 <= 1)%N -> (c'.2 <= 1)%N ->
  covariance block_sum (later k (P c)) (later l (P c')) ((c.1 == c'.1) && (c.2 + l == c'.2 + k)%N)%:R%:M.
Proof.
move=> h h' i j; set b := _%:R; have -> : b%:M i j = b by rewrite !ord1 mxE mulr1n.
by apply: (mean_ext block_mean) (pulses_meet k l h h') => t; rewrite /later /P !ord1 ![_%:M _ _]mxE !mulr1n.
Qed.

(** x(k+1) = u(k) + v(k), y = x, u and v being the pulses of g, and x those a sample before. *)
Theorem white_pulses : let S : system K 1 1 1 := System 0 1%:M 1%:M 0 in exists u v x y : nat -> 'rV[K]_1,
  [/\ process S (1%:M : 'M_1) 0 u v x y, quasi_stationary block_sum (fun t => row_mx (row_mx (u t) (v t)) (x t)),
    uncorrelated block_sum u v,
    [/\ white_noise block_sum u, white_noise block_sum v, knows_nothing_before block_sum u x & knows_nothing_before block_sum v x]
  & [/\ autoregressive_input block_sum 0 (fun=> 0) u u, excites block_sum 1 u & forall x0, steered S (1%:M : 'M_1) x0]].
Proof.
move=> S.
pose u := P (false, 0%N); pose v := P (true, 0%N); pose x t := P (false, 1%N) t + P (true, 1%N) t; exists u, v, x, x.
have now (c : bool * nat) t : later 0 (P c) t = P c t by rewrite /later addn0.
have white h : white_noise block_sum (P (h, 0%N)).
  move=> l; have := pulses_covariance 0 l (c := (h, 0%N)) (c' := (h, 0%N)) isT isT; rewrite /= eqxx add0n addn0.
  have -> : (if l == 0%N then 1%:M else 0) = (l == 0%N)%:R%:M :> 'M[K]_1 by case: eqP; rewrite ?raddf0.
  by apply: (covariance_ext block_mean) => // t; rewrite now.
have before h : knows_nothing_before block_sum (P (h, 0%N)) x.
  move=> l; have e1 := pulses_covariance l 0 (c := (h, 0%N)) (c' := (false, 1%N)) isT isT.
  have e2 := pulses_covariance l 0 (c := (h, 0%N)) (c' := (true, 1%N)) isT isT.
  have := covariance_add block_mean e1 e2; rewrite /= !addn0 add1n !andbF raddf0 addr0.
  by apply: (covariance_ext block_mean) => // t; rewrite !now.
have uu : covariance block_sum u u 1%:M by apply: (covariance_ext block_mean) (white false 0%N) => // t; rewrite /later addn0.
split; last split.
- move=> t; split; last by rewrite mulmx1 !mulmx0 !addr0.
  by rewrite /= mulmx0 add0r !mulmx1 /x /P (mark_next (false, 0%N)) (mark_next (true, 0%N)).
- have cx : combination g x by apply: combination_add; [apply: (pulse_combination 2%:R)|apply: (pulse_combination 3%:R)].
  have c : combination g (fun t => row_mx (row_mx (u t) (v t)) (x t)).
    have cu := combination_mul (row_mx (row_mx 1%:M 0) 0 : 'M_(1, 1 + 1 + 1)) (pulse_combination 0).
    have cv := combination_mul (row_mx (row_mx 0 1%:M) 0 : 'M_(1, 1 + 1 + 1)) (pulse_combination 1).
    apply: combination_ext (combination_add (combination_add cu cv) (combination_mul (row_mx 0 1%:M : 'M_(1, 1 + 1 + 1)) cx)) => t.
    by rewrite !mul_mx_row !mulmx1 !mulmx0 !add_row_mx !(addr0, add0r).
  by move=> l; apply: (combination_covariance block_mean pulses_quasi c (combination_later l c)).
- move=> l; split.
    have := pulses_covariance 0 l (c := (false, 0%N)) (c' := (true, 0%N)) isT isT; rewrite /= raddf0.
    by apply: (covariance_ext block_mean) => // t; rewrite now.
  have := pulses_covariance l 0 (c := (false, 0%N)) (c' := (true, 0%N)) isT isT; rewrite /= raddf0.
  by apply: (covariance_ext block_mean) => // t; rewrite now.
- by split; [exact: white|exact: white|exact: before|exact: before].
- split.
  + move=> t; by rewrite big_ord0 add0r.
  + by exists 1%:M => //; apply: unitmx1.
  move=> l; have := pulses_covariance l.+1 0 (c := (false, 0%N)) (c' := (false, 0%N)) isT isT; rewrite /= raddf0.
  by apply: (covariance_ext block_mean) => t; rewrite ?now // /later addn1 addnS.
- exists 1%:M; last exact: unitmx1.
  have := covariance_images block_mean (place K 1 (ord0 : 'I_1)) (place K 1 (ord0 : 'I_1)) uu; rewrite mulmx1.
  have -> : (place K 1 (ord0 : 'I_1))^T *m place K 1 (ord0 : 'I_1) = 1%:M by have := sum_places K 1 1; rewrite big_ord1.
  by apply: (covariance_ext block_mean) => t; rewrite /successive future_sum big_ord1 !addn0.
by move=> x0; exists 1%N, (fun=> x0); rewrite /= mulmx0 add0r mulmx1.
Qed.

End Pulses.

(** In an ordered field the mean is positive. *)
Lemma block_positive (K : realFieldType) : positive (@block_sum K).
Proof. by move=> f a /(_ 0%N)[M hM]; rewrite -(hM M) //; apply: sumr_ge0 => j _; apply: sqr_ge0. Qed.

Theorem white_signals (K : realFieldType) : [/\ mean (@block_sum K), positive (@block_sum K) &
  let E := @block_sum K in let S : system K 1 1 1 := System 0 1%:M 1%:M 0 in exists u v x y : nat -> 'rV[K]_1,
  [/\ process S (1%:M : 'M_1) 0 u v x y, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v,
    [/\ white_noise E u, white_noise E v, knows_nothing_before E u x & knows_nothing_before E v x]
  & [/\ autoregressive_input E 0 (fun=> 0) u u, excites E 1 u & forall x0, steered S (1%:M : 'M_1) x0]]].
Proof. by split; [exact: block_mean|exact: block_positive|exact: white_pulses]. Qed.
