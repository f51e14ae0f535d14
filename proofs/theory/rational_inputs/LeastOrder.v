(** The difference equation of least order that the covariances of an input satisfy: for every stable A the reciprocal polynomial of its
    coefficients is regular at A. Where it is not, that polynomial and the minimal polynomial of A have a divisor g in common. The rest h of
    the first makes of the covariances a bounded sequence that g annihilates backwards in time; A is stable, so the sequence is zero, and
    h tells an equation of lower order. That there is a least order, and which, linear algebra decides. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly polydiv
  ssrnum matrix mxalgebra mxpoly zify.
From faultspace Require Import LimitsVocabulary MeansVocabulary Means Forgetting FilteredInputs RationalMeans OrderNames MorphismNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma coef_product (K : fieldType) (h rho : {poly K}) s i : (size h <= s)%N ->
  (h * rho)`_i = \sum_(j < s) h`_j * (if (i < j)%N then 0 else rho`_(i - j)).
Proof.
move=> hs; have {1}-> : h = \sum_(j < s) h`_j *: 'X^j.
  by rewrite -poly_def; apply/polyP=> j; rewrite coef_poly; case: ltnP => // sj; rewrite nth_default // (leq_trans hs).
by rewrite mulr_suml coef_sum; apply: eq_bigr => j _; rewrite -scalerAl coefZ coefXnM.
Qed.

Section Polynomials.
Variables (K : realFieldType) (n : nat) (A : 'M[K]_n.+1).
Hypothesis st : stable A.

Lemma power_iter k : iter k (mulmxr A) 1%:M = A ^+ k.
Proof. by elim: k => //= k ->; rewrite exprSr. Qed.

Lemma small_powers eps : 0 < eps -> exists k, forall j, `|('X^k %% mxminpoly A)`_j| <= eps.
Proof.
move=> eps0; set P := pinvmx (powers_mx A (degree_mxminpoly A)).
pose c := \sum_j \sum_i `|P i j|; have c0 : 0 <= c by apply: sumr_ge0 => j _; apply: sumr_ge0.
have c1 : 0 < c + 1 by rewrite ltr_pwDr ?ltr01.
have [k small] := st (divr_gt0 eps0 c1); exists k => j.
rewrite -horner_mxK rmorphXn /= horner_mx_X -power_iter /mx_inv_horner coef_rVpoly -/P; case: insubP => [o _ _|_]; last first.
  by rewrite normr0 ltW.
rewrite mxE; apply: le_trans (ler_norm_sum _ _ _) _; apply: le_trans (_ : \sum_i eps / (c + 1) * `|P i o| <= _).
  apply: ler_sum => i _; rewrite normrM; apply: ler_wpM2r => //; case/mxvec_indexP: i => i i'; rewrite mxvecE; exact: ltW.
rewrite -mulr_sumr; apply: le_trans (_ : eps / (c + 1) * c <= _).
  apply: ler_wpM2l; first by rewrite ltW ?divr_gt0.
  by rewrite /c (bigD1 o) //= lerDl; apply: sumr_ge0 => i _; apply: sumr_ge0.
by rewrite mulrAC ler_pdivrMr // ler_pM2l // lerDl ler01.
Qed.

Lemma forgotten_lags (f h g : {poly K}) m T b z : f = h * g -> g %| mxminpoly A -> (1 < size g)%N -> (m <= T.+1)%N ->
  (forall M, (T < M)%N -> exists rho : {poly K},
    [/\ forall i, `|rho`_i| <= b, forall i, (m <= i < M)%N -> (f * rho)`_i = 0 & (h * rho)`_T = z]) -> z = 0.
Proof.
move=> fhg gp g1 mT lags; apply/eqP; apply: contraT; rewrite -normr_gt0 => z0; pose p : {poly K} := mxminpoly A; rewrite -/p in gp.
have p0 : p != 0 by apply: monic_neq0 (mxminpoly_monic A).
have [rho0 [b_bound _ _]] := lags T.+1 (leqnn _); have b0 : 0 <= b by apply: le_trans (b_bound 0%N).
pose bound := b * \sum_(j < size h) `|h`_j|; have bound0 : 0 <= bound by rewrite mulr_ge0 // sumr_ge0.
pose c := bound *+ size p + 1; have c0 : 0 < c by rewrite ltr_pwDr ?ltr01 // mulrn_wge0.
have [k small] := small_powers (divr_gt0 z0 c0).
have lt : (T < (T + k).+1)%N by rewrite ltnS leq_addr.
have [rho [rho_bound zero ez]] := lags _ lt; pose q : {poly K} := 'X^k %/ p; pose r : {poly K} := 'X^k %% p; rewrite -/p -/r in small.
pose p' : {poly K} := p %/ g; have ep : p = g * p' by rewrite mulrC divpK.
have eX : 'X^k = p * q + r by rewrite [p * q]mulrC; apply: divp_eq.
have short : (size (p' * q)%R <= k)%N.
  have [->|q0] := eqVneq q 0; first by rewrite mulr0 size_poly0.
  have g0 : g != 0 by rewrite -size_poly_gt0 ltnW.
  have p'0 : p' != 0 by apply: contraNneq p0 => e; rewrite ep e mulr0.
  have := size_divp 'X^k p0; rewrite -/q size_polyXn => sq; rewrite size_mul //; have := size_mul g0 p'0; rewrite -ep => sp.
  move: q0 p'0; rewrite -!size_poly_gt0; move: g1 sp sq; move: (size p) (size q) (size p') (size g) => *; lia.
have split_z : z = (p' * q * (f * rho))`_(T + k) + (r * (h * rho))`_(T + k).
  have -> : z = ('X^k * (h * rho))`_(T + k) by rewrite coefXnM ltnNge leq_addl /= addnK.
  rewrite eX mulrDl coefD fhg ep; congr (_`_ _ + _).
  by rewrite -!mulrA [h * (g * _)]mulrCA [q * (g * _)]mulrCA [p' * (g * _)]mulrCA.
have far i : `|(h * rho)`_i| <= bound.
  rewrite (coef_product _ _ (leqnn _)); apply: le_trans (ler_norm_sum _ _ _) _; rewrite /bound mulr_sumr; apply: ler_sum => j _.
  by rewrite normrM mulrC; apply: ler_wpM2r => //; case: ifP => _; rewrite ?normr0.
have size_r : (size r <= size p)%N by rewrite ltnW // ltn_modp.
have : `|z| <= \sum_(j < size p) `|z| / c * bound.
  rewrite {1}split_z (coef_product _ _ short) big1 => [|j _]; last by rewrite ifF ?zero ?mulr0 //; have := ltn_ord j; lia.
  rewrite add0r (coef_product _ _ size_r); apply: le_trans (ler_norm_sum _ _ _) _; apply: ler_sum => j _.
  by rewrite normrM; apply: ler_pM => //; case: ifP => _; rewrite ?normr0.
rewrite sumr_const card_ord -mulrnAr mulrAC ler_pdivlMr // ler_pM2l // /c => le.
by have := ltr_pwDr (@ltr01 K) le; rewrite ltxx.
Qed.

End Polynomials.

Section Order.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (nu : nat) (u : nat -> 'rV[K]_nu).
Hypotheses (isE : mean E) (pos : positive E) (quasi : quasi_stationary E u).

Lemma equation_of_lags r (a : nat -> K) l R : spectrum_equation E r a u ->
  (forall i, (i < r.+1)%N -> covariance E u (later (l.+1 + i) u) (R i)) -> \sum_(i < r.+1) a i *: R i = 0.
Proof. by move=> [_ eqn] hR; exact: (covariance_unique isE (covariance_sum isE a hR) (eqn l)). Qed.

Lemma regular_at r (a : nat -> K) n (A : 'M[K]_n) : spectrum_equation E r a u ->
  (forall r' b, (r' < r)%N -> ~ spectrum_equation E r' b u) -> stable A -> reciprocal_at r a A \in unitmx.
Proof.
case: n A => [|n] A eqn least st; first by rewrite unitmxE det_mx00 unitr1.
pose f := \poly_(j < r.+1) a (r - j)%N; have [ar _] := eqn.
have -> : reciprocal_at r a A = horner_mx A f.
  rewrite /f poly_def rmorph_sum /reciprocal_at (reindex_inj rev_ord_inj); apply: eq_bigr => j _ /=.
  by rewrite linearZ rmorphXn /= horner_mx_X -power_iter subSS subKn // -ltnS.
apply: contraT => singular; pose p : {poly K} := mxminpoly A; pose g : {poly K} := gcdp f p.
have size_f : (size f <= r.+1)%N by apply: size_poly.
have coef_f j : (j < r.+1)%N -> f`_j = a (r - j)%N by move=> jr; rewrite coef_poly jr.
have f0 : f`_0 = 1 by rewrite coef_f // subn0.
have f_neq0 : f != 0 by apply: contraTneq (oner_neq0 K) => e; rewrite -f0 e coef0 eqxx.
have g1 : (1 < size g)%N.
  have : size g != 0%N by rewrite size_poly_eq0 gcdp_eq0 negb_and f_neq0.
  suff : size g != 1%N by case: (size g) => [|[]].
  apply: contra singular => /eqP e; have /Bezout_eq1_coprimepP[[b c] /= bezout] : coprimep f p by rewrite coprimep_def -/g e.
  have := congr1 (horner_mx A) bezout; rewrite rmorphD !rmorphM /= mx_root_minpoly mulr0 addr0 rmorph1 => unit.
  by have [] := mulmx1_unit unit.
pose h : {poly K} := f %/ g; have fhg : f = h * g by rewrite divpK // dvdp_gcdl.
have size_h : (size h <= r)%N.
  have g0 : g != 0 by rewrite -size_poly_gt0 ltnW.
  rewrite /h size_divp //; move: size_f g1; move: (size f) (size g) => *; lia.
have h0 : h`_0 != 0 by apply: contraTneq (oner_neq0 K) => e; rewrite -f0 fhg coefM big_ord1 /= e mul0r eqxx.
have r0 : (0 < r)%N.
  by apply: leq_trans size_h; rewrite size_poly_gt0; apply: contraNneq h0 => ->; rewrite coef0.
have lt : (r.-1 < r)%N by rewrite prednK.
pose b i := h`_(r.-1 - i) / h`_0; case: (least r.-1 b lt); split=> [|l]; first by rewrite /b subnn divff.
pose T := (l + r.-1)%N; have [R hR] := covariances_of_lags quasi 1 T.+1.
have each i : (i < r.-1.+1)%N -> covariance E u (later (l.+1 + i) u) (R (l + i)%N).
  by move=> ir; have := hR (l + i)%N; rewrite addnA add1n; apply; rewrite /T; lia.
have := covariance_sum isE b each; congr (covariance _ _ _ _).
pose z := \sum_(j < r) h`_j *: R (T - j)%N.
have -> : \sum_(i < r.-1.+1) b i *: R (l + i)%N = (h`_0)^-1 *: z.
  rewrite scaler_sumr prednK // [RHS](reindex_inj rev_ord_inj); apply: eq_bigr => i _ /=.
  by rewrite scalerA mulrC /b; congr (h`_ _ / _ *: R _); rewrite /T; have := ltn_ord i; lia.
suff -> : z = 0 by rewrite scaler0.
have [R0 uu] := quasi 0%N; have {}uu : covariance E u u R0 by apply: (covariance_ext isE) uu => // t; rewrite /later addn0.
apply/matrixP=> i j; rewrite [RHS]mxE.
apply: (forgotten_lags st (f := f) (h := h) (g := g) (m := r) (T := T) (b := \tr R0 + \tr R0)) => //; rewrite ?dvdp_gcdr //.
  by rewrite /T; lia.
move=> M TM; have [R' hR'] := covariances_of_lags quasi 1 M; exists (\poly_(k < M) R' k i j); split.
- move=> k; rewrite coef_poly; case: ltnP => kM; last first.
    by rewrite normr0; apply: addr_ge0; apply: sumr_ge0 => o _; apply: (square_positive isE pos o uu).
  apply: (covariance_bound isE pos (k := 0) (l := (1 + k)%N) i j uu uu).
  by apply: (covariance_ext isE) (hR' k kM) => // t; rewrite /later addn0.
- move=> k /andP[rk kM]; rewrite (coef_product _ _ size_f).
  have lags o : (o < r.+1)%N -> covariance E u (later ((k - r).+1 + o) u) (R' (k - r + o)%N).
    by move=> or; have := hR' (k - r + o)%N; rewrite addnA add1n; apply; lia.
  have /matrixP/(_ i j) := equation_of_lags eqn lags; rewrite [X in _ = X]mxE => e; rewrite -[RHS]e.
  rewrite summxE (reindex_inj rev_ord_inj) /=; apply: eq_bigr => o _.
  have ro : (o <= r)%N by rewrite -ltnS.
  rewrite subSS coef_f ?subKn // ?ltnS ?leq_subr // ltnNge (leq_trans (leq_subr _ _) rk) /= mxE; congr (_ * _).
  by rewrite coef_poly ifT; [congr (R' _ i j)|]; lia.
rewrite (coef_product _ _ size_h) /z summxE; apply: eq_bigr => o _; rewrite mxE; have or := ltn_ord o.
rewrite ltnNge (_ : o <= T)%N /=; last by rewrite /T; lia.
have TT : (T - o < T.+1)%N by lia.
rewrite coef_poly ifT; last by lia.
by congr (_ * (_ : 'M_nu) i j); apply: (covariance_unique isE (hR' _ _) (hR _ TT)); lia.
Qed.

(** Equations hold at all lags where they hold at the first. *)
Lemma equation_for_ever r a r' b : spectrum_equation E r a u -> b r' = 1 ->
  (forall l, (l < r)%N -> covariance E u (fun t => \sum_(i < r'.+1) b i *: later (l.+1 + i) u t) 0) -> spectrum_equation E r' b u.
Proof.
move=> [ar eqn] br first; split=> //; pose f l t := \sum_(i < r'.+1) b i *: later (l.+1 + i) u t.
have cu : combination u u by apply: combination_ext (combination_part u 1%:M) => t; rewrite mulmx1.
have cf l : combination u (f l).
  apply: (combination_sum _ (f := fun i t => b i *: later (l.+1 + i) u t)) => i.
  by apply: combination_ext (combination_mul (b i)%:M (combination_later (l.+1 + i) cu)) => t; rewrite mul_mx_scalar.
elim/ltn_ind => l IH; have [|rl] := ltnP l r; first exact: first.
have [C hC] := combination_covariance isE quasi cu (cf l).
have each i : (i < r.+1)%N -> covariance E u (f (l - r + i)%N) (if i == r then C else 0).
  rewrite ltnS leq_eqVlt; case: eqP => [-> _|_ /= ir]; first by rewrite subnK.
  by apply: IH; lia.
have := covariance_sum isE a each; rewrite big_ord_recr /= ar eqxx scale1r big1 ?add0r => [sum|i _]; last first.
  by rewrite ifF ?scaler0 // ltn_eqF.
have := covariance_sum isE b (fun i (_ : (i < r'.+1)%N) => eqn (l - r + i)%N); rewrite big1 => [zero|i _]; last exact: scaler0.
suff e : C = 0 by rewrite e in hC.
apply: (covariance_unique isE sum); apply: (covariance_ext isE) zero => // t; rewrite /f.
under eq_bigr => i _ do rewrite scaler_sumr.
rewrite exchange_big; apply: eq_bigr => i _ /=; rewrite scaler_sumr; apply: eq_bigr => k _.
by rewrite !scalerA mulrC; congr (_ *: later _ u t); lia.
Qed.

(** There is an equation of least order. *)
Theorem least_order r : order_of_spectrum E r u -> exists r' a, [/\ (r' <= r)%N, spectrum_equation E r' a u
  & forall n (A : 'M[K]_n), stable A -> reciprocal_at r' a A \in unitmx].
Proof.
move=> [a0 [/monicP lead size_a] eqn0]; pose a i := a0`_i.
have eqn : spectrum_equation E r a u by split=> //; rewrite /a -lead /lead_coef size_a.
have [R hR] := covariances_of_lags quasi 1 (r + r.+1).
have lags l i : (l < r)%N -> (i < r.+1)%N -> covariance E u (later (l.+1 + i) u) (R (l + i)%N).
  by move=> lr ir; have := hR (l + i)%N; rewrite addnA add1n; apply; lia.
pose V i := \matrix_(l < r) mxvec (R (l + i)%N); pose p k := (k <= r)%N && (mxvec (V k) <= \matrix_(i < k) mxvec (V i))%MS.
have row_sum k b (l : 'I_r) : row l (\sum_(i < k) b i *: V i) = mxvec (\sum_(i < k) b i *: R (l + i)%N).
  by rewrite !linear_sum; apply: eq_bigr => i _; rewrite !linearZ /= rowK.
have spectral k b : (k <= r)%N -> b k = 1 -> \sum_(i < k.+1) b i *: V i = 0 <-> spectrum_equation E k b u.
  move=> kr bk; split=> [zero|eqb].
    apply: (equation_for_ever eqn bk) => l lr; have := row_sum k.+1 b (Ordinal lr); rewrite zero row0 => /eqP.
    rewrite eq_sym mxvec_eq0 => /eqP e; have each i : (i < k.+1)%N -> covariance E u (later (l.+1 + i) u) (R (l + i)%N).
      by move=> ik; apply: lags => //; lia.
    by have := covariance_sum isE b each; rewrite e.
  apply/row_matrixP=> l; rewrite row_sum row0; apply/eqP; rewrite mxvec_eq0; apply/eqP.
  have each i : (i < k.+1)%N -> covariance E u (later (l.+1 + i) u) (R (l + i)%N) by move=> ik; apply: lags => //; lia.
  exact: (equation_of_lags (R := fun i => R (l + i)%N) eqb each).
have found k : p k -> exists b, spectrum_equation E k b u.
  case/andP=> kr /submxP[c ec]; pose b i := if i == k then 1 else if insub i is Some j then - c 0 (j : 'I_k) else 0.
  have bk : b k = 1 by rewrite /b eqxx.
  exists b; apply/(spectral k b kr bk); rewrite big_ord_recr /= bk scale1r; apply: (can_inj mxvecK).
  rewrite linearD /= ec linear_sum mulmx_sum_row -big_split linear0 big1 // => i _ /=.
  by rewrite rowK linearZ /= /b ltn_eqF // valK scaleNr addNr.
have tells k b : (k <= r)%N -> spectrum_equation E k b u -> p k.
  move=> kr eqb; have bk : b k = 1 by case: eqb.
  rewrite /p kr; have /(spectral k b kr bk) := eqb; rewrite big_ord_recr /= bk scale1r => /eqP; rewrite addr_eq0 => /eqP/esym e.
  have -> : V k = - - V k by rewrite opprK.
  rewrite e -sumrN linear_sum; apply: summx_sub => i _; rewrite -scaleNr linearZ /=; apply: scalemx_sub.
  by rewrite -(rowK (fun i : 'I_k => mxvec (V i))) row_sub.
have some : exists k, p k by exists r; apply: tells eqn.
case: (ex_minnP some) => k pk least; have [b eqb] := found k pk; have /andP[kr _] := pk.
exists k, b; split=> // n A; apply: regular_at eqb _ => k' b' lt eqb'.
have k'r : (k' <= r)%N by apply: leq_trans kr; apply: ltnW.
by have := least k' (tells k' b' k'r eqb'); rewrite leqNgt lt.
Qed.

End Order.
