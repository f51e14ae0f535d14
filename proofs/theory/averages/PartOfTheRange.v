(** u(k) = e(k+3) - e(k) and a double pole of two states: signals whose time averages exist, a fault that is uncorrelated with u at all
    lags, and a limit of PI-MOESP of rank 1, where O_s has 2. *)
From Coq Require Import Ring.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  matrix mxalgebra zify.
From faultspace Require Import Vocabulary Consistency LimitsVocabulary MeansVocabulary ExampleVocabulary Places WholeRange Means
  MeanLimits Forgetting.
From faultspace Require Import FilteredInputs TimeAverages RudinShapiro Responses OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** Identities of polynomials, by the tactic ring, which wants the operations bare. *)
Section Identities.
Variables (T : Type) (zero one : T) (add mul sub : T -> T -> T) (opp : T -> T).
Hypothesis laws : ring_theory zero one add mul sub opp eq.
Add Ring laws : laws.
Local Notation "x +' y" := (add x y) (at level 50, left associativity).
Local Notation "x *' y" := (mul x y) (at level 40, left associativity).
Local Notation "1'" := one.

Lemma first_identity a t k : k = 1' +' 1' +' opp t ->
  (k +' k) *' (a +' a +' opp (t *' a)) +' k *' opp a +' opp (a *' (1' +' 1' +' 1' +' opp t +' opp t)) *' k = zero.
Proof. move=> ->; ring. Qed.

Lemma second_identity t k a3 : k = 1' +' 1' +' opp t -> a3 = t -> t *' t +' opp ((1' +' (1' +' (1' +' (1' +' 1')))) *' t) +' (1' +' (1' +'
  1')) = zero ->
  (k +' k) *' (1' +' 1' +' opp (t +' t +' t +' t)) +' k *' opp 1' +' (1' +' 1' +' 1' +' opp t +' opp t) *' (a3 +' a3 +' a3) = zero.
Proof.
move=> -> -> e; transitivity ((1' +' 1') *' (t *' t +' opp ((1' +' (1' +' (1' +' (1' +' 1')))) *' t) +' (1' +' (1' +' 1')))); first by ring.
by rewrite e; ring.
Qed.

End Identities.

Lemma field_laws (R : comRingType) : ring_theory (0 : R) 1 +%R *%R (fun x y => x - y) -%R eq.
Proof.
by split=> *; rewrite ?add0r ?mul1r ?subrr //; [exact: addrC|exact: addrA|exact: mulrC|exact: mulrA|exact: mulrDl].
Qed.

(** The pole. *)
Lemma pole_exists (K : rcfType) : exists a : K, 0 < a < 1 /\ a ^+ 6 - 5%:R * a ^+ 3 + 3%:R = 0.
Proof.
pose P : {poly K} := 'X^6 - 5%:R *: 'X^3 + 3%:R%:P.
have value a : P.[a] = a ^+ 6 - 5%:R * a ^+ 3 + 3%:R by rewrite /P !(hornerE, hornerXn).
have [|a /andP[a0 a1] /rootP] := @poly_ivt K (- P) 0 1 ler01.
  rewrite !hornerN !value !expr1n !expr0n /= mulr0 mulr1 subr0 add0r oppr_le0 ler0n oppr_ge0 /=.
  by rewrite addrAC -[1]/(1%:R) -natrD subr_le0 ler_nat.
move/eqP; rewrite hornerN oppr_eq0 value => /eqP root; exists a; split=> //.
have [a0' a1'] : a != 0 /\ a != 1.
  split; apply/negP => /eqP e; move/eqP: root; rewrite e ?expr0n ?expr1n /= ?mulr0 ?mulr1 ?subr0 ?add0r ?pnatr_eq0 //.
  by rewrite addrAC -[1]/(1%:R) -natrD subr_eq0 eqr_nat.
by rewrite !lt_neqAle a0 a1 a1' eq_sym a0'.
Qed.

(** A double pole inside the unit circle is stable. *)
Lemma double_pole_stable (K : realFieldType) (a : K) (N : 'M[K]_2) : archimedean K -> 0 < a < 1 -> N *m N = 0 -> stable (a%:M + N).
Proof.
move=> arch /andP[a0 a1] NN eps eps0; pose c := a^-1 - 1.
have c0 : 0 < c by rewrite subr_gt0 invf_gt1.
have bernoulli m : a ^+ m * (1 + m%:R * c) <= 1.
  elim: m => [|m IH]; first by rewrite expr0 mul0r addr0 mulr1.
  apply: le_trans IH; rewrite exprSr -mulrA ler_wpM2l ?exprn_ge0 ?(ltW a0) //.
  rewrite mulrSr mulrDl mul1r addrA [_ + c]addrC mulrDr {1}/c mulrBr mulfV ?(lt0r_neq0 a0) // mulr1.
  have : a * (1 + m%:R * c) <= a + m%:R * c.
    by rewrite mulrDr mulr1 lerD2l mulrC ler_piMr ?(ltW a1) // mulr_ge0 ?ler0n ?(ltW c0).
  by rewrite -(lerD2l (1 - a)) [1 - a + (a + _)]addrA subrK.
have powers k : iter k (mulmxr (a%:M + N)) 1%:M = (a ^+ k)%:M + (k%:R * a ^+ k.-1) *: N.
  elim: k => [|k IH]; first by rewrite /= mul0r scale0r addr0 expr0.
  rewrite iterS IH /= mulmxDr !mulmxDl !mul_mx_scalar mul_scalar_mx -[_ *: N *m N]scalemxAl NN scaler0 addr0 scale_scalar_mx -exprS -addrA.
  congr (_ + _); rewrite scalerA -scalerDl; congr (_ *: _); case: k {IH} => [|k] /=; first by rewrite mul0r mulr0 add0r mul1r.
  by rewrite mulrCA -exprS [in RHS]mulrSr mulrDl mul1r.
have [b b0 hb] := matrix_bound N; pose d := eps / (1 + 2%:R * (c * a)^-1 * b).
have ca0 : 0 < c * a by rewrite mulr_gt0.
have den0 : 0 < 1 + 2%:R * (c * a)^-1 * b by rewrite ltr_wpDr ?ltr01 // !mulr_ge0 ?ler0n // invr_ge0 ltW.
have d0 : 0 < d by rewrite divr_gt0.
have [m hm] := arch (d^-1 / c); rewrite ltr_pdivrMr // in hm.
have am : a ^+ m < d.
  have := bernoulli m; rewrite -ler_pdivlMr; last by rewrite ltr_pwDl ?ltr01 // mulr_ge0 ?ler0n ?(ltW c0).
  move/le_lt_trans; apply; rewrite mul1r -[d]invrK ltf_pV2 ?posrE ?invr_gt0 //;
    last by rewrite ltr_pwDl ?ltr01 // mulr_ge0 ?ler0n ?(ltW c0).
  by apply: lt_trans hm _; rewrite ltrDr ltr01.
exists (m + m)%N => i j; rewrite powers mxE; apply: le_lt_trans (ler_normD _ _) _.
have a_le k l : (k <= l)%N -> a ^+ l <= a ^+ k by move=> kl; apply: ler_wiXn2l => //; rewrite ltW.
have am0 : 0 <= a ^+ m by rewrite exprn_ge0 ?ltW.
have first : `|(a ^+ (m + m))%:M i j| <= a ^+ m.
  rewrite mxE; case: (i == j); rewrite ?mulr0n ?normr0 // mulr1n ger0_norm ?exprn_ge0 ?(ltW a0) // a_le ?leq_addr //.
have m_am : m%:R * a ^+ m <= c^-1.
  rewrite -[c^-1]mul1r ler_pdivlMr //; apply: le_trans (bernoulli m).
  by rewrite mulrAC mulrC ler_wpM2l // lerDr ler01.
have second : `|((m + m)%:R * a ^+ (m + m).-1 *: N) i j| <= a ^+ m * (2%:R * (c * a)^-1 * b).
  rewrite mxE normrM mulrA; apply: ler_pM; rewrite ?normr_ge0 ?hb //.
  rewrite ger0_norm ?mulr_ge0 ?ler0n ?exprn_ge0 ?(ltW a0) //; case: (m) m_am am0 => [|k] m_am am0.
    by rewrite !mul0r mulr_ge0 ?mulr_ge0 ?ler0n ?invr_ge0 ?(ltW ca0) // expr0 ler01.
  have -> : (k.+1 + k.+1)%:R * a ^+ (k.+1 + k.+1).-1 = a ^+ k.+1 * (2%:R * (k.+1%:R * a ^+ k.+1 * a^-1)).
    have ek : a ^+ k.+1 * a^-1 = a ^+ k by rewrite exprSr mulfK ?lt0r_neq0.
    have e : ((k.+1 + k.+1).-1 = k.+1 + k)%N by rewrite addnS.
    by rewrite e -[_ * _ / a]mulrA ek exprD addnn -mul2n natrM -!mulrA [RHS]mulrCA; congr (_ * _); rewrite [RHS]mulrCA.
  apply: ler_wpM2l => //; apply: ler_wpM2l; first exact: ler0n.
  by rewrite invfM; apply: ler_wpM2r; rewrite ?invr_ge0 ?(ltW a0).
have : `|(a ^+ (m + m))%:M i j| + `|((m + m)%:R * a ^+ (m + m).-1 *: N) i j| <= a ^+ m * (1 + 2%:R * (c * a)^-1 * b).
  by rewrite mulrDr mulr1 lerD.
by move/le_lt_trans; apply; rewrite -ltr_pdivlMr.
Qed.

(** What a limit of rank less than n means. *)
Lemma rank_lost (K : fieldType) (E : (nat -> K) -> K -> Prop) n z f (Z : nat -> 'rV[K]_z) (Uf : nat -> 'rV[K]_f) (x : nat -> 'rV[K]_n) R M
    (rho : 'rV_z) (sigma : 'rV_f) d : mean E -> covariance E Uf Uf R -> R \in unitmx -> limit E Z Uf x M ->
  let zeta t := Z t *m rho^T + Uf t *m sigma^T in
  covariance E (later d zeta) (later d Uf) 0 -> covariance E (later d zeta) (later d x) 0 -> rho *m M = 0.
Proof.
move=> isE uu unit [Rzu [Ruu [Rzx [Rux [X [zu uu' zx ux [hX ->]]]]]]] zeta zeta_u zeta_x.
rewrite (covariance_unique isE uu' uu) in hX.
have image a (w : nat -> 'rV[K]_a) Rz Ru : covariance E Z w Rz -> covariance E Uf w Ru -> covariance E zeta w (rho *m Rz + sigma *m Ru).
  move=> zw uw; have := covariance_transpose isE (covariance_add isE (covariance_transpose isE (covariance_mul_left isE rho^T zw))
    (covariance_transpose isE (covariance_mul_left isE sigma^T uw))).
  by rewrite linearD /= !trmxK; apply: (covariance_ext isE).
have e1 := covariance_unique isE (covariance_later isE d (image _ _ _ _ zu uu)) zeta_u.
have e2 := covariance_unique isE (covariance_later isE d (image _ _ _ _ zx ux)) zeta_x.
have e3 : rho *m X = - sigma.
  apply: (can_inj (mulmxK unit)); rewrite mulNmx -mulmxA hX; apply/eqP; by rewrite -addr_eq0 e1.
by rewrite mulmxBr mulmxA e3 mulNmx opprK.
Qed.

Section Signals.
Variables (K : rcfType) (a : K).
Hypotheses (arch : archimedean K) (a01 : 0 < a < 1) (root : a ^+ 6 - 5%:R * a ^+ 3 + 3%:R = 0).
Let E := @time_average K.
Let isE : mean E := time_average_mean arch.
(** A fault that is uncorrelated with e, and with itself from four samples on. *)
Variables (v : nat -> 'rV[K]_1) (bv : K).
Hypotheses (ev : uncorrelated E (fun t => (rudin_shapiro K t)%:M : 'rV_1) v) (v_quasi : quasi_stationary E v).
Hypotheses (v_short : forall l, (4 <= l)%N -> covariance E v (later l v) 0) (v_bounded : forall t, size_of (v t) <= bv).
Let e t : 'rV[K]_1 := (rudin_shapiro K t)%:M.
Let u t : 'rV[K]_1 := e (t + 3)%N - e t.
Let N : 'M[K]_2 := delta_mx 0 1.
Let B : 'rV[K]_2 := delta_mx 0 0.
Let n : 'rV[K]_2 := delta_mx 0 1.
Let S : system K 2 1 2 := System (a%:M + N) B 1%:M 0.

Let ee k l : covariance E (later k e) (later l e) (k == l)%:R%:M.
Proof.
have [white _ _] := shapiro_white arch; have one k' l' : (k' <= l')%N -> covariance E (later k' e) (later l' e) (k' == l')%:R%:M.
  move=> kl; have := covariance_later isE k' (white (l' - k')%N); have -> : (k' == l') = (l' - k' == 0)%N by rewrite subn_eq0 eqn_leq kl.
  by case: eqP => _; rewrite ?raddf0; apply: (covariance_ext isE) => // t; rewrite /later -addnA subnKC.
case/orP: (leq_total k l) => kl; first exact: one.
by have := covariance_transpose isE (one _ _ kl); rewrite tr_scalar_mx eq_sym.
Qed.

(** The covariance of u at two times. *)
Let rho k l : K := (k + 3 == l + 3)%N%:R - (k + 3 == l)%N%:R - ((k == l + 3)%N%:R - (k == l)%:R).
Let eu k l : covariance E (later k e) (later l u) ((k == l + 3)%N%:R - (k == l)%:R)%:M.
Proof.
have := covariance_add isE (ee k (l + 3)%N) (covariance_mul isE (-1)%:M (ee k l)); rewrite mul_mx_scalar scaleN1r -raddfB.
by apply: (covariance_ext isE) => // t; rewrite /later /u mul_mx_scalar scaleN1r addnA.
Qed.
Let uu l k : covariance E (later l u) (later k u) (rho k l)%:M.
Proof.
have left := covariance_transpose isE (eu (k + 3) l); have right := covariance_mul isE (-1)%:M (covariance_transpose isE (eu k l)).
have := covariance_add isE left right; rewrite mul_mx_scalar scaleN1r !tr_scalar_mx -raddfB.
by apply: (covariance_ext isE) => // t; rewrite /later /u mul_mx_scalar scaleN1r addnA.
Qed.
Let uv k l : covariance E (later k u) (later l v) 0.
Proof.
have ekl k' : covariance E (later k' e) (later l v) 0.
  have [kl|lk] := leqP k' l.
    have [h _] := ev (l - k')%N; have := covariance_later isE k' h; apply: (covariance_ext isE) => // t; by rewrite /later -addnA subnKC.
  have [_ h] := ev (k' - l)%N; have := covariance_later isE l h; apply: (covariance_ext isE) => // t;
    by rewrite /later -addnA subnKC // ltnW.
have := covariance_add isE (covariance_transpose isE (ekl (k + 3)%N)) (covariance_mul isE (-1)%:M (covariance_transpose isE (ekl k))).
rewrite trmx0 mul0mx addr0 => /(covariance_transpose isE); rewrite trmx0; apply: (covariance_ext isE) => // t.
by rewrite /later /u mul_mx_scalar scaleN1r addnA.
Qed.
Let uu0 l : covariance E u (later l u) (rho l 0)%:M.
Proof. by apply: (covariance_ext isE) (uu 0 l) => // t; rewrite /later addn0. Qed.
Let uv0 l : covariance E u (later l v) 0.
Proof. by apply: (covariance_ext isE) (uv 0 l) => // t; rewrite /later addn0. Qed.
Let vu0 l : covariance E v (later l u) 0.
Proof. by have := covariance_transpose isE (uv l 0); rewrite trmx0; apply: (covariance_ext isE) => // t; rewrite /later addn0. Qed.

Lemma difference_uncorrelated : uncorrelated E u v.
Proof. by move=> l; split=> //; have := uv l 0; apply: (covariance_ext isE) => // t; rewrite /later addn0. Qed.

(** The two parts of the state. *)
Let P c d : 'rV[K]_2 := c *: B + d *: n.
Let PA c d : P c d *m sysA S = P (c * a) (c + d * a).
Proof.
have BA : B *m sysA S = a *: B + n by rewrite mulmxDr mul_mx_scalar mul_delta_mx.
have nA : n *m sysA S = a *: n by rewrite mulmxDr mul_mx_scalar mul_delta_mx_0 ?addr0.
by rewrite /P mulmxDl -!scalemxAl BA nA scalerDr !scalerA -!addrA -scalerDl.
Qed.
Let w t : 'rV[K]_(1 + 1) := row_mx (u t) (v t).
Let x := state (with_faults S (col_mx B B) (0 : 'M_(1 + 1, 2))) 0 w.
Let x_step t : x t.+1 = x t *m sysA S + w t *m col_mx B B. Proof. by []. Qed.
Let w_quasi : quasi_stationary E w.
Proof. by move=> l; have [R hR] := v_quasi l; eexists; exact: (covariance_rows arch (uu0 l) (uv0 l) (vu0 l) hR). Qed.
Let w_short l : (4 <= l)%N -> covariance E w (later l w) 0.
Proof.
move=> l4; have := covariance_rows arch (uu0 l) (uv0 l) (vu0 l) (v_short l4).
have -> : rho l 0 = 0 by rewrite /rho; do !case: eqP; move=> *; rewrite ?subr0 //; lia.
by rewrite raddf0 block_mx0.
Qed.
Let w_bounded t : size_of (w t) <= 1 + 1 + bv.
Proof.
have norm (b : K) : `|b| = 1 -> `|(b%:M : 'M_1) 0 0| <= 1 by rewrite mxE mulr1n => ->.
have -> : size_of (w t) = size_of (u t) + size_of (v t).
  rewrite /size_of big_split_ord; congr (_ + _); apply: eq_bigr => i _; by rewrite ?row_mxEl ?row_mxEr.
apply: lerD => //; rewrite /size_of big_ord1 /u.
have -> : (e (t + 3)%N - e t) 0 0 = e (t + 3)%N 0 0 - e t 0 0 by rewrite mxE [X in _ + X]mxE.
by apply: le_trans (ler_normB _ _) _; apply: lerD; apply: norm; apply: shapiro_norm.
Qed.
Let A_stable : stable (sysA S). Proof. by apply: double_pole_stable => //; rewrite mul_delta_mx_0. Qed.
Let quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)).
Proof. exact: (responses_quasi arch A_stable x_step w_bounded w_quasi w_short). Qed.

(** What successive inputs tell of the state. *)
Let start k m : (m + 3 <= k)%N -> covariance E (later k u) (later m x) (P 0 0).
Proof.
move=> mk; have zero := state_knows_nothing arch A_stable x_step w_bounded w_short (_ : 4 <= (k - m).+1)%N.
have := covariance_mul isE (col_mx 1%:M 0 : 'M_(1 + 1, 1)) (zero (ltac:(lia)));
  rewrite mul0mx => /(covariance_later isE m)/(covariance_transpose isE).
rewrite trmx0 /P !scale0r addr0; apply: (covariance_ext isE) => // t.
rewrite /later /w mul_row_col mulmx1 mulmx0 addr0; congr (u _); lia.
Qed.
Let next k m c d : covariance E (later k u) (later m x) (P c d) -> covariance E (later k u) (later m.+1 x) (P (c * a + rho m k) (c + d *
  a)).
Proof.
move=> h; have h1 := covariance_mul isE (sysA S) h; have h2 := covariance_mul isE B (uu k m); have h3 := covariance_mul isE B (uv k m).
have := covariance_add isE (covariance_add isE h1 h2) h3; rewrite mul0mx addr0 PA mul_scalar_mx /P [_ + _ *: B]addrAC -scalerDl.
by apply: (covariance_ext isE) => // t; rewrite /later addnS x_step mul_row_col addrA.
Qed.

(** From the start to five samples later. *)
Let rho_three m : rho m (m + 3) = -1.
Proof. rewrite /rho; do !case: eqP; move=> *; rewrite ?subr0 ?sub0r //; lia. Qed.
Let rho_same m : rho m m = 1 + 1.
Proof. rewrite /rho; do !case: eqP; move=> *; rewrite ?subr0 ?sub0r ?opprK //; lia. Qed.
Let rho_else m k : m != k -> (m + 3 != k)%N -> (m != k + 3)%N -> rho m k = 0.
Proof. by rewrite /rho; do !case: eqP; move=> *; rewrite ?subr0 //; lia. Qed.
Let chain m : [/\ covariance E (later (m + 3) u) (later (m + 2) x) (P (- a) (- 1)),
  covariance E (later (m + 3) u) (later (m + 4) x) (P (1 + 1 - a * a * a) (- (a * a + a * a + a * a)))
  & covariance E (later (m + 3) u) (later (m + 5) x)
      (P (a + a - a * a * a * a) (1 + 1 - (a * a * a + a * a * a + a * a * a + a * a * a)))].
Proof.
have s0 := start (leqnn (m + 3)); have := next s0; rewrite mul0r !add0r rho_three => s1.
have := next s1; rewrite rho_else ?mulN1r ?addr0 ?mul0r ?addr0; [|lia|lia|lia] => s2.
have := next s2; rewrite rho_else ?mulN1r ?addr0 ?mulNr -?opprD; [|lia|lia|lia] => s3.
have := next s3; rewrite (_ : rho m.+3 (m + 3) = 1 + 1); last by rewrite addn3 rho_same.
rewrite !mulNr [- (a * a * a) + _]addrC mulrDl -opprD addrA => s4.
have := next s4; rewrite rho_else; [|lia|lia|lia]; rewrite addr0 mulrBl mulrDl mul1r mulNr !mulrDl -[1 + 1 - _ - _]addrA -opprD !addrA =>
  s5.
by split; [rewrite addn2|rewrite addn4|rewrite (_ : (m + 5 = m.+4.+1)%N) //; lia].
Qed.
(** A combination of u(t), u(t+1) and u(t+3) that is uncorrelated with u(t+2), u(t+3) and x(t+2). *)
Let t3 := a * a * a.
Let k := 1 + 1 - t3.
Let c2 := - (a * (1 + 1 + 1 - t3 - t3)).
Let zeta t := (k + k) *: u t + c2 *: later 1 u t + k *: later 3 u t.

Let combined b (z : nat -> 'rV[K]_b) R1 R2 R3 : covariance E (later 5 u) z R1 -> covariance E (later 6 u) z R2 -> covariance E (later 8 u)
  z R3 ->
  covariance E (later 5 zeta) z ((k + k) *: R1 + c2 *: R2 + k *: R3).
Proof.
move=> h1 h2 h3; have scale (c : K) l R : covariance E (later l u) z R -> covariance E z (fun t => c *: later l u t) (c *: R)^T.
  move=> h; have := covariance_mul isE c%:M (covariance_transpose isE h); rewrite mul_mx_scalar linearZ /=.
  by apply: (covariance_ext isE) => // t; rewrite mul_mx_scalar.
have := covariance_transpose isE (covariance_add isE (covariance_add isE (scale (k + k) _ _ h1) (scale c2 _ _ h2)) (scale k _ _ h3)).
rewrite -!linearD /= trmxK; apply: (covariance_ext isE) => // t; by rewrite /zeta /later -!addnA.
Qed.
Let zeta_x : covariance E (later 5 zeta) (later 7 x) 0.
Proof.
have [_ _ h1] := chain 2; have [_ h2 _] := chain 3; have [h3 _ _] := chain 5; have := combined h1 h2 h3.
suff -> : (k + k) *: P (a + a - a * a * a * a) (1 + 1 - (a * a * a + a * a * a + a * a * a + a * a * a)) +
  c2 *: P (1 + 1 - a * a * a) (- (a * a + a * a + a * a)) + k *: P (- a) (- 1) = 0 by [].
have e1 : (k + k) * (a + a - t3 * a) + k * - a + c2 * k = 0 := first_identity (field_laws K) a (erefl k).
have root' : t3 * t3 - (1 + (1 + (1 + (1 + 1)))) * t3 + (1 + (1 + 1)) = 0.
  by rewrite -[RHS]root -[(1 + (1 + (1 + (1 + 1))))]/(5%:R) -[1 + (1 + 1)]/(3%:R); rewrite !exprSr expr0 mul1r /t3 !mulrA.
have e2 : (k + k) * (1 + 1 - (t3 + t3 + t3 + t3)) + k * - 1 + (1 + 1 + 1 - t3 - t3) * (t3 + t3 + t3) = 0 :=
  second_identity (field_laws K) (erefl k) (erefl t3) root'.
have scale c d f : c *: P d f = P (c * d) (c * f) by rewrite /P scalerDr !scalerA.
have add c d f g : P c d + P f g = P (c + f) (d + g) by rewrite /P addrACA -!scalerDl.
rewrite !scale !add [X in P X _](_ : _ = 0) 1?[X in P _ X](_ : _ = 0) ?/P ?scale0r ?addr0 //.
  by rewrite -[RHS]e2 [RHS]addrAC; congr (_ + _ + _); rewrite /c2 mulrNN [a * _]mulrC -mulrA !mulrDr /t3 !mulrA.
by rewrite -[RHS]e1 [RHS]addrAC.
Qed.
Let zeta_u : covariance E (later 5 zeta) (later 5 (successive 2 2 u)) 0.
Proof.
have sample l : (l == 7)%N || (l == 8)%N -> covariance E (later 5 zeta) (later l u) 0.
  move=> hl; have := combined (uu 5 l) (uu 6 l) (uu 8 l).
  have -> : (k + k) *: (rho l 5)%:M + c2 *: (rho l 6)%:M + k *: (rho l 8)%:M = 0 :> 'M[K]_1; last by [].
  rewrite !scale_scalar_mx -!raddfD; suff -> : (k + k) * rho l 5 + c2 * rho l 6 + k * rho l 8 = 0 by apply: raddf0.
  case/orP: hl => /eqP ->; first by rewrite !rho_else // !mulr0 !addr0.
  rewrite rho_same (@rho_else 8%N 6%N) // mulr0 addr0 (_ : rho 8 5 = -1); last by rewrite /rho /= !subr0 sub0r.
  by rewrite mulrN1 mulrDr mulr1 addNr.
have h7 := covariance_mul isE (place K 1 (0 : 'I_2)) (sample 7%N isT);
  have h8 := covariance_mul isE (place K 1 (1 : 'I_2)) (sample 8%N isT).
have := covariance_add isE h7 h8; rewrite !mul0mx addr0; apply: (covariance_ext isE) => // t.
by rewrite /later /successive future_sum !big_ord_recl big_ord0 addr0 -!addnA; congr (u _ *m _ + u _ *m place K 1 _); apply: val_inj.
Qed.
Let model : process S B 0 u v x x.
Proof. by move=> t; rewrite x_step mul_row_col addrA /= mulmx1 !mulmx0 !addr0. Qed.

(** Every number of successive inputs has a regular covariance. *)
Let difference_excites s : excites E s u.
Proof.
have [M [Q [g [U [V [X [Y [[_ gQ] _ _ _ windows]]]]]]]] := lifted_windows isE model quasi s.
have Uw t : successive 0 s u t = g t *m future 0 s U by have [] := windows 0%N s (leqnn _) t.
have UU := image_covariance isE gQ Uw Uw; exists (cov Q (future 0 s U) (future 0 s U)) => //.
rewrite -row_full_unit; apply: row_full_seen => z Rz; pose f t : 'rV_1 := successive 0 s u t *m z.
pose c (i : nat) : K := if insub i is Some i then (place K 1 (i : 'I_s) *m z) 0 0 else 0.
have cE (i : 'I_s) : place K 1 i *m z = (c i)%:M by rewrite /c valK [LHS]mx11_scalar.
have fE t : f t = \sum_(i < s) c i *: later i u t.
  rewrite /f /successive addn0 future_sum mulmx_suml; apply: eq_bigr => i _; by rewrite -mulmxA cE mul_mx_scalar.
have ff : covariance E f f 0 by have := covariance_images isE z z UU; rewrite -mulmxA Rz mulmx0.
have ef j : covariance E (later j e) f (\sum_(i < s) c i *: ((j == i + 3)%N%:R - (j == i)%:R)%:M).
  by apply: (covariance_ext isE) (covariance_sum isE c (fun i _ => eu j i)) => // t; rewrite fE.
have zero j := null_covariance isE (@time_average_positive K) (ee j j) ff (ef j).
have c0 j : c j = 0.
  elim/ltn_ind: j => j IH; have [js|sj] := ltnP j s; last by rewrite /c insubN // -leqNgt.
  have /matrixP/(_ 0 0) := zero j; rewrite summxE (bigD1 (Ordinal js)) //= big1 => [|i ij]; last first.
    rewrite 2!mxE eqxx mulr1n; have -> : (j == i) = false by apply/eqP => ji; move/eqP: ij; apply; apply: val_inj.
    by case: eqP => [ji|_]; rewrite ?subrr ?mulr0 // IH ?mul0r // ji; lia.
  rewrite 3!mxE !eqxx mulr1n addr0 (_ : (j == j + 3)%N = false) ?sub0r ?mulrN1; last by apply/eqP; lia.
  by move/eqP; rewrite oppr_eq0 => /eqP.
rewrite -[z]mul1mx -(sum_places K 1 s) mulmx_suml big1 // => i _; by rewrite -mulmxA cE c0 raddf0 mulmx0.
Qed.

Theorem part_of_the_range : exists y, [/\ process S B 0 u v x y, [/\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)),
  uncorrelated E u v
  & stable (sysA S)], [/\ forall z, steered S B z, row_free (sysC S) & forall s, excites E s u] & (exists L, limit E (successive 0 2 u)
    (successive 2 2 u) (successive 2 2 y) L) /\
  forall L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L -> ~ (O S 2 <= L)%MS].
Proof.
exists x.
split=> //; first by split=> //; exact: difference_uncorrelated.
  split=> // [z|]; last by rewrite /row_free mxrank1.
  pose c t : 'rV[K]_1 := (nth 0 [:: z 0 1; z 0 0 - a * z 0 1] t)%:M; exists 2%N, c; rewrite /=.
  have first : c 0%N *m B = P (z 0 1) 0 by rewrite mul_scalar_mx /P scale0r addr0.
  have second : c 1%N *m B = P (z 0 0 - a * z 0 1) 0 by rewrite mul_scalar_mx /P scale0r addr0.
  rewrite mul0mx add0r first second PA /P addrACA -!scalerDl mul0r !addr0 [_ * a]mulrC [a * _ + _]addrC subrK.
  apply/rowP => -[[|[|//]] lt]; rewrite !mxE /= ?mulr1 ?mulr0 ?addr0 ?add0r; congr (z 0 _); exact: val_inj.
split; first by apply: (limit_exists _ isE model quasi); apply: difference_excites.
move=> L hL; have [M [hM ->]] := mean_containment isE model quasi difference_uncorrelated hL.
have [R hR unit] := difference_excites 2; have {}hR : covariance E (successive 2 2 u) (successive 2 2 u) R.
  by apply: (covariance_ext isE) (covariance_later isE 2 hR) => t; rewrite successive_later addn0.
pose r : 'rV[K]_(2 * 1) := (k + k) *: place K 1 (0 : 'I_2) + c2 *: place K 1 (1 : 'I_2).
pose sg : 'rV[K]_(2 * 1) := k *: place K 1 (1 : 'I_2).
have zeta_windows t : successive 0 2 u t *m r^T + successive 2 2 u t *m sg^T = zeta t.
  have sample q (i : 'I_2) : successive q 2 u t *m (place K 1 i)^T = u (t + q + i)%N := esym (sample_of_future _ _ _).
  rewrite /r /sg linearD /= !linearZ /= mulmxDr -!scalemxAr !sample /zeta /later /= !addn0 -addnA; by [].
have rM : r *m M = 0.
  apply: (rank_lost isE hR unit hM (d := 5)); first by apply: (covariance_ext isE) zeta_u => t //; exact: esym (zeta_windows (t + 5)%N).
  by apply: (covariance_ext isE) zeta_x => t; [exact: esym (zeta_windows (t + 5)%N)|rewrite /later -addnA].
have rank_O : \rank (O S 2) = 2%N.
  have first : O S 2 *m (place K 2 (0 : 'I_2))^T = 1%:M.
    apply/row_matrixP => i; rewrite row_mul rowK mul_place_transposed mxvecK rowK /output /= mulmx1 mulmx0 addr0 //.
  by have := mxrankM_maxl (O S 2) (place K 2 (0 : 'I_2))^T; rewrite first mxrank1 => h; apply/eqP; rewrite eqn_leq rank_leq_row h.
move=> le; have le2 : (2 <= \rank M)%N by rewrite -{1}rank_O; apply: leq_trans (mxrankS le) _; exact: mxrankM_maxl.
have full : row_free M by rewrite -row_leq_rank.
have r0 : r = 0 by apply: (row_free_inj full); rewrite rM mul0mx.
have := congr1 (mulmx^~ (place K 1 (0 : 'I_2))^T) r0; rewrite /= mul0mx mulmxDl -!scalemxAl !place_orthonormal /= scaler0 addr0.
move=> /matrixP/(_ 0 0); rewrite !mxE mulr1 => /eqP; rewrite -mulr2n mulrn_eq0 /= /k subr_eq0 => /eqP two.
case/andP: a01 => a0 a1; have : t3 < 1 by rewrite /t3 -!expr2 -exprSr; apply: exprn_ilt1 => //; apply: ltW.
by rewrite -two -subr_gt0 opprD addrA subrr add0r oppr_gt0 ltNge ler01.
Qed.

End Signals.

Theorem part_of_the_range_exists (K : rcfType) : archimedean K -> let E := @time_average K in
  let u t : 'rV[K]_1 := (rudin_shapiro K (t + 3))%:M - (rudin_shapiro K t)%:M in let v t : 'rV[K]_1 := (rudin_shapiro_turned K t)%:M in
  exists (S : system K 2 1 2) (B : 'M_(1, 2)) x y, [/\ process S B 0 u v x y,
    [/\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v & stable (sysA S)],
    [/\ forall z, steered S B z, row_free (sysC S) & forall s, excites E s u]
  & (exists L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L) /\
    forall L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L -> ~ (O S 2 <= L)%MS].
Proof.
move=> arch; have [a [a01 root]] := pole_exists K; have [_ white_v ev] := shapiro_white arch.
have [|l l4|t|y h] := part_of_the_range arch a01 root (bv := 1) ev.
- by move=> l; eexists; exact: white_v.
- by have := white_v l; case: l l4.
- by rewrite /size_of big_ord1 mxE mulr1n /rudin_shapiro_turned normrM normr_sign shapiro_norm mulr1.
exists (System (a%:M + delta_mx 0 1) (delta_mx 0 0) 1%:M 0), (delta_mx 0 0); eexists; exists y; exact: h.
Qed.
