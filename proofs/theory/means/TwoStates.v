(** Two states, one input and two past inputs: when the limit of PI-MOESP has all of the range of O_s. The covariances of the past inputs
    with the state, the s future ones projected away, are combinations of those of the backward errors of order s and s + 1. By Levinson's
    recursion the first error is a multiple of b + k f, b and f being the backward and the forward error of order s + 1 and k the weight of
    the last input in the prediction whose error b is. Each backward error reaches both states (ErrorsReach.v). So the two covariances are
    H (1 + k A F) and H A, H being that of b(t) and x(t+1), and F the matrix that commutes with A and takes H to that of f(t) and x(t). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Places Leads LimitsVocabulary WholeRange Controllable.
From faultspace Require Import MeansVocabulary Means MeanLimits Forgetting LongPast ExogenousMeans ErrorsReach.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Cyclic.
Variables (K : fieldType) (A : 'M[K]_2).

Lemma cyclic_unique (H : 'rV_2) (X Y : 'M_2) : row_full (col_mx H (H *m A)) -> X *m A = A *m X -> Y *m A = A *m Y ->
  H *m X = H *m Y -> X = Y.
Proof.
move=> /row_fullP[P PM] cX cY e; suff eM : col_mx H (H *m A) *m X = col_mx H (H *m A) *m Y.
  by rewrite -[X]mul1mx -PM -mulmxA eM mulmxA PM mul1mx.
by rewrite !mul_col_mx e -!mulmxA -cX -cY mulmxA e -mulmxA.
Qed.

Lemma cyclic_every (H g : 'rV_2) : row_full (col_mx H (H *m A)) -> exists2 X : 'M_2, X *m A = A *m X & g = H *m X.
Proof.
move=> /row_fullP[P PM]; pose q : 'rV_(1 + 1) := g *m P; exists ((lsubmx q 0 0)%:M + rsubmx q 0 0 *: A).
  by rewrite mulmxDl mulmxDr -scalemxAl -scalemxAr scalar_mxC.
rewrite mulmxDr mul_mx_scalar -scalemxAr -!mul_scalar_mx -!mx11_scalar -mul_row_col hsubmxK /q -mulmxA PM.
by rewrite mulmx1.
Qed.

Lemma singular_square : A \notin unitmx -> exists a, A *m A = a *: A.
Proof.
have thin r (C : 'M[K]_(2, r)) (R : 'M_(r, 2)) : (r <= 1)%N -> exists a, C *m R *m (C *m R) = a *: (C *m R).
  case: r C R => [|[|//]] C R _; first by exists 0; rewrite scale0r [C]thinmx0 !mul0mx.
  have [a e] : exists a, R *m C = a%:M by exists ((R *m C) 0 0); exact: mx11_scalar.
  by exists a; rewrite mulmxA -(mulmxA C) e mul_mx_scalar -scalemxAl.
move=> singular; rewrite -(mulmx_base A); apply: thin; rewrite -ltnS ltn_neqAle rank_leq_row andbT.
by apply: contra singular; rewrite -row_full_unit.
Qed.

(** The two covariances, H0 of the first error and H A of the second, H0 = H + k g. *)
Variables (H0 H g : 'rV[K]_2) (k : K).
Hypotheses (full0 : row_full (col_mx H0 (H0 *m A))) (full : row_full (col_mx H (H *m A))) (sum : H0 = H + k *: g).

Lemma cyclic_zero (H1 : 'rV_2) (w : 'cV_2) : row_full (col_mx H1 (H1 *m A)) -> H1 *m w = 0 -> H1 *m A *m w = 0 -> w = 0.
Proof. by move=> /row_fullP[P PM] z1 z2; rewrite -[w]mul1mx -PM -mulmxA mul_col_mx z1 z2 col_mx0 mulmx0. Qed.

Lemma independent_singular : A \notin unitmx -> row_full (col_mx H0 (H *m A)).
Proof.
move=> /singular_square[a AA]; apply: row_full_seen => w; rewrite mul_col_mx => /eqP; rewrite col_mx_eq0 => /andP[/eqP z0 /eqP z1].
have Aw : A *m w = 0.
  by apply: (cyclic_zero full); rewrite mulmxA // -(mulmxA H) AA -scalemxAr -scalemxAl z1 scaler0.
by apply: (cyclic_zero full0 z0); rewrite -mulmxA Aw mulmx0.
Qed.

Lemma independent_regular F : A \in unitmx -> F *m A = A *m F -> g = H *m A *m F ->
  row_full (col_mx H0 (H *m A)) = ~~ is_scalar_mx (invmx A + k *: F).
Proof.
move=> unit comm eg; set N := invmx A + k *: F.
have fullA : row_full (col_mx (H *m A) (H *m A *m A)) by rewrite -mul_col_mx /row_full mxrankMfree // row_free_unit.
have e0 : H0 = H *m A *m N by rewrite mulmxDr mulmxK // -scalemxAr -eg.
have cN : N *m A = A *m N by rewrite mulmxDl mulmxDr mulVmx // mulmxV // -scalemxAl -scalemxAr comm.
apply/idP/idP => [|scalar].
  apply: contraL => /is_scalar_mxP[a eN]; rewrite /row_full neq_ltn; apply/orP; left.
  apply: leq_ltn_trans (mxrankS (_ : _ <= H *m A)%MS) (leq_ltn_trans (rank_leq_row _) _) => //.
  by rewrite col_mx_sub submx_refl andbT e0 eN mul_mx_scalar scalemx_sub.
apply: contraR scalar => dependent.
have [r r0 rz] : exists2 r : 'rV_(1 + 1), r != 0 & r *m col_mx H0 (H *m A) = 0.
  have : kermx (col_mx H0 (H *m A)) != 0 by rewrite kermx_eq0; exact: dependent.
  by case/rowV0Pn => r /sub_kermxP rz r0; exists r.
pose al := lsubmx r 0 0; pose be := rsubmx r 0 0.
have er : r = row_mx al%:M be%:M by rewrite -[r]hsubmxK -!mx11_scalar.
have rel : al *: N + be%:M = 0.
  apply: (cyclic_unique fullA); rewrite ?mulmx0 ?mul0mx // ?mulmxDl ?mulmxDr.
    by rewrite -scalemxAl -scalemxAr cN scalar_mxC.
  by rewrite -scalemxAr -e0 mul_mx_scalar -rz er mul_row_col !mul_scalar_mx.
have al0 : al != 0.
  apply: contra r0 => /eqP z; rewrite er; move: rel; rewrite z scale0r add0r => /matrixP/(_ 0 0); rewrite !mxE /= mulr1n => ->.
  by rewrite raddf0 row_mx0.
apply/is_scalar_mxP; exists (- be / al); apply: (scalerI al0).
by rewrite scale_scalar_mx mulrC divfK // raddfN; apply/eqP; rewrite -addr_eq0 rel.
Qed.

End Cyclic.

(** An error of the instruments given the future inputs, and the limit. *)
Lemma limit_error (K : fieldType) (E : (nat -> K) -> K -> Prop) n z f (Z : nat -> 'rV[K]_z) (Uf : nat -> 'rV[K]_f) (x : nat -> 'rV[K]_n) R M
    (zeta : nat -> 'rV_1) (rho : 'rV_z) (sigma : 'rV_f) : mean E -> covariance E Uf Uf R -> R \in unitmx -> limit E Z Uf x M ->
  (forall t, zeta t = Z t *m rho^T + Uf t *m sigma^T) -> covariance E zeta Uf 0 -> covariance E zeta x (rho *m M).
Proof.
move=> isE uu unit [Rzu [Ruu [Rzx [Rux [X [zu uu' zx ux [hX ->]]]]]]] ezeta zeta_u.
rewrite (covariance_unique isE uu' uu) in hX.
have image a (w : nat -> 'rV[K]_a) Rz Ru : covariance E Z w Rz -> covariance E Uf w Ru -> covariance E zeta w (rho *m Rz + sigma *m Ru).
  move=> zw uw; have := covariance_transpose isE (covariance_add isE (covariance_transpose isE (covariance_mul_left isE rho^T zw))
    (covariance_transpose isE (covariance_mul_left isE sigma^T uw))).
  by rewrite linearD /= !trmxK; apply: (covariance_ext isE).
have e : rho *m X = - sigma.
  apply: (can_inj (mulmxK unit)); rewrite mulNmx -mulmxA hX; apply/eqP; rewrite -addr_eq0; apply/eqP.
  exact: (covariance_unique isE (image _ _ _ _ zu uu) zeta_u).
by have := image _ _ _ _ zx ux; rewrite mulmxBr mulmxA e mulNmx opprK.
Qed.

Section TwoStates.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (m p : nat) (S : system K 2 m p) (B : 'M[K]_(1, 2)) (D : 'M[K]_(1, p)).
Variables (u : nat -> 'rV[K]_1) (v : nat -> 'rV[K]_m) (x z : nat -> 'rV[K]_2) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (pos : positive E) (model : process S B D u v x y) (st : stable (sysA S)) (uv : uncorrelated E u v).
Hypotheses (driven : forall t, z t.+1 = z t *m sysA S + u t *m B).
Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t))).
Let h t := row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t)).

Let cu : combination h u := inputs_part u v x z.
Let cx : combination h x := states_part u v x z.
Let cz : combination h z := driven_part u v x z.
Let cd : combination h (fun t => x t - z t) := undriven_part u v x z.
Let quasi_x := quasi_without_driven isE quasi.

(** What is a combination of inputs. *)
Section Inputs.
Variables (r : nat) (q : nat -> 'M[K]_1) (w : nat -> 'rV[K]_1).
Hypothesis inputs : forall t, w t = \sum_(i < r) u (t + i)%N *m q i.

Lemma inputs_combination : combination h w.
Proof.
apply: combination_ext (combination_sum r (fun i => combination_mul (q i) (combination_later i cu))) => t.
by rewrite inputs.
Qed.

Lemma inputs_unseen a (f : nat -> 'rV[K]_a) : (forall i, covariance E f (later i u) 0) -> covariance E w f 0.
Proof.
move=> fu; rewrite -trmx0; apply: covariance_transpose => //.
have each i : (i < r)%N -> covariance E f (fun t => later i u t *m q i) 0.
  by move=> _; rewrite -(mul0mx _ (q i)); apply: covariance_mul.
apply: (covariance_ext isE) (covariance_zero_sum (f := fun i t => later i u t *m q i) (fun=> 1) isE each) => // t.
by rewrite inputs; apply: eq_bigr => i _; rewrite scale1r.
Qed.

Lemma inputs_state l R : covariance E w (later l z) R <-> covariance E w (later l x) R.
Proof.
have unseen : covariance E w (later l (fun t => x t - z t)) 0.
  apply: inputs_unseen => i; rewrite -trmx0; apply: covariance_transpose => //.
  apply: (unseen_state isE pos quasi st uv cu cd (F := sysF S)) => t.
  by have [-> _] := model t; rewrite driven mulmxBl [_ + u t *m B + _]addrAC opprD addrACA subrr addr0 addrAC.
split=> [wz|wx].
  by have := covariance_add isE wz unseen; rewrite addr0; apply: (covariance_ext isE) => // t; rewrite addrC subrK.
have := covariance_add isE wx (covariance_mul isE (- 1%:M) unseen); rewrite mul0mx addr0; apply: (covariance_ext isE) => // t.
by rewrite mulmxN mulmx1 /later opprB addrC subrK.
Qed.

Lemma inputs_step l R : covariance E w (later l u) 0 -> covariance E w (later l x) R -> covariance E w (later l.+1 x) (R *m sysA S).
Proof.
move=> wu wx; have wv : covariance E w (later l v) 0.
  apply: inputs_unseen => i; rewrite -trmx0; apply: covariance_transpose => //; exact: uncorrelated_at.
have := covariance_add isE (covariance_add isE (covariance_mul isE (sysA S) wx) (covariance_mul isE B wu)) (covariance_mul isE (sysF S) wv).
by rewrite !mul0mx !addr0; apply: (covariance_ext isE) => // t; rewrite /later addnS; have [-> _] := model (t + l)%N.
Qed.

End Inputs.

Hypothesis steers : forall x0, steered S B x0.

Lemma error_cyclic r b c (H : 'M_(1, 2)) : backward_error E r u c b -> covariance E b (later 1 z) H -> excites E r.+2 u ->
  row_full (col_mx H (H *m sysA S)).
Proof.
move=> error bz more; have exciting := excites_fewer isE pos quasi cu (excites_fewer isE pos quasi cu more).
apply: row_full_seen => w; rewrite mul_col_mx => /eqP; rewrite col_mx_eq0 => /andP[/eqP z0 /eqP z1].
have reached := error_reaches isE pos quasi cu cz st driven error bz exciting (w := w) more.
have zero : steered_space S B 2 *m w = 0 by apply: unseen_by_steered; apply: reached => -[|[|]].
have /row_fullP[P PR] : row_full (steered_space S B 2) by apply/controllable_steered_space.
by rewrite -[w]mul1mx -PR -mulmxA zero mulmx0.
Qed.

Variables (s : nat) (b f : nat -> 'rV[K]_1) (c d : nat -> 'M[K]_1).
Hypotheses (back : backward_error E s.+1 u c b) (forw : forward_error E s.+1 u d f) (exciting : excites E s.+3 u).
Let k := c s 0 0.
Let mu := 1 - k * d 0%N 0 0.
Let g t := b t + k *: f t.

Let qb i : 'M[K]_1 := if i is j.+1 then - c j else 1%:M.
Let qf i : 'M[K]_1 := if (i < s.+1)%N then - d i else 1%:M.
Let b_inputs t : b t = \sum_(i < s.+2) u (t + i)%N *m qb i.
Proof.
have [eb _] := back; rewrite eb [RHS]big_ord_recl /= addn0 mulmx1 -sumrN; congr (_ + _).
by apply: eq_bigr => i _; rewrite mulmxN.
Qed.
Let f_inputs t : f t = \sum_(i < s.+2) u (t + i)%N *m qf i.
Proof.
have [ef _] := forw; rewrite ef [RHS]big_ord_recr /= /qf ltnn mulmx1 addrC -sumrN; congr (_ + _).
by apply: eq_bigr => i _; rewrite ltn_ord mulmxN.
Qed.
Let g_inputs t : g t = \sum_(i < s.+2) u (t + i)%N *m (fun i => qb i + k *: qf i) i.
Proof.
rewrite /g b_inputs f_inputs scaler_sumr -big_split; apply: eq_bigr => i _; by rewrite mulmxDr -scalemxAr.
Qed.
Let cb : combination h b := inputs_combination b_inputs.
Let cf : combination h f := inputs_combination f_inputs.
Let cg : combination h g := inputs_combination g_inputs.

(** Levinson's recursion. *)
Lemma sum_inputs t : g t = mu *: u t - \sum_(i < s) u (t + i.+1)%N *m (c i + k *: d i.+1).
Proof.
have [eb _] := back; have [ef _] := forw; rewrite /g eb ef big_ord_recr [X in k *: (_ - X)]big_ord_recl /= addn0.
have scalar (w : 'rV[K]_1) (a : 'M_1) : w *m a = a 0 0 *: w by rewrite [a]mx11_scalar mul_mx_scalar mxE mulr1n.
have -> : \sum_(i < s) u (t + i.+1)%N *m (c i + k *: d i.+1) =
    \sum_(i < s) u (t + i.+1)%N *m c i + k *: \sum_(i < s) u (t + i.+1)%N *m d i.+1.
  by rewrite scaler_sumr -big_split; apply: eq_bigr => i _; rewrite mulmxDr -scalemxAr.
rewrite [u _ *m c s]scalar [u t *m d 0%N]scalar -/k /mu scalerBl scale1r -scalerA scalerBr scalerDr.
move: (u t) (\sum_(i < s) _) (k *: u _) (k *: (_ *: _)) (k *: \sum_(i < s) _) => a1 a2 a3 a4 a5.
by rewrite [- (a2 + a3)]opprD [a1 + _]addrA [LHS]addrA subrK [- (a4 + a5)]opprD [- (a2 + a5)]opprD addrACA.
Qed.

Lemma sum_seen i : (0 < i <= s)%N -> covariance E g (later i u) 0.
Proof.
move=> /andP[i0 i_s]; have [_ bu] := back; have [_ fu] := forw.
have e1 : covariance E b (later i u) 0 by apply: bu; rewrite i0 ltnW.
have e2 : covariance E f (later i u) 0 by apply: fu.
have := covariance_add isE (covariance_transpose isE e1) (covariance_mul isE k%:M (covariance_transpose isE e2)).
rewrite trmx0 mul0mx addr0 => /(covariance_transpose isE); rewrite trmx0; apply: (covariance_ext isE) => // t.
by rewrite mul_mx_scalar.
Qed.

(** |k| < 1, of which this is all that is used. *)
Lemma contraction : mu != 0.
Proof.
apply/eqP => mu0; have [eb bu] := back; have [ef fu] := forw.
have gg : covariance E g g 0.
  have each i : (i < s)%N -> covariance E g (fun t => later i.+1 u t *m (c i + k *: d i.+1)) 0.
    by move=> i_s; rewrite -(mul0mx _ (c i + k *: d i.+1)); apply: covariance_mul => //; apply: sum_seen.
  have := covariance_zero_sum (f := fun i t => later i.+1 u t *m (c i + k *: d i.+1)) (fun=> -1) isE each.
  by apply: (covariance_ext isE) => // t; rewrite sum_inputs mu0 scale0r sub0r -sumrN; apply: eq_bigr => i _; rewrite scaleN1r.
have [R uu] := combination_covariance isE quasi cu cu; have [Rg ug] := combination_covariance isE quasi cu cg.
have R0 := null_covariance isE pos uu gg ug; rewrite {Rg}R0 in ug.
have ub : covariance E u b 0.
  have uf : covariance E u f 0.
    have := covariance_transpose isE (fu 0%N isT); rewrite trmx0; apply: (covariance_ext isE) => // t; by rewrite /later addn0.
  have := covariance_add isE ug (covariance_mul isE (- k)%:M uf); rewrite mul0mx addr0; apply: (covariance_ext isE) => // t.
  by rewrite mul_mx_scalar scaleNr addrK.
have bb : covariance E b b 0.
  have each i : (i < s.+1)%N -> covariance E b (fun t => later i.+1 u t *m c i) 0.
    by move=> i_s; rewrite -(mul0mx _ (c i)); apply: covariance_mul => //; apply: bu.
  have bu0 := covariance_transpose isE ub; rewrite trmx0 in bu0.
  have := covariance_add isE bu0 (covariance_zero_sum (f := fun i t => later i.+1 u t *m c i) (fun=> -1) isE each); rewrite addr0.
  by apply: (covariance_ext isE) => // t; rewrite eb -sumrN; congr (_ + _); apply: eq_bigr => i _; rewrite scaleN1r.
pose q i : 'M[K]_1 := if (i < s.+2)%N then qb i else 0.
have few : excites E s.+2 u by apply: (excites_fewer isE pos quasi cu).
have : q 0%N = 0.
  apply: (null_inputs isE pos quasi cu few) => [i si|]; first by rewrite /q ltnNge si.
  by apply: (covariance_ext isE) bb => t; rewrite b_inputs; apply: eq_bigr => i _; rewrite /q ltn_ord.
by move/matrixP/(_ 0 0)/eqP; rewrite /q /= !mxE oner_eq0.
Qed.

Lemma sum_error : backward_error E s u (fun i => mu^-1 *: (c i + k *: d i.+1)) (fun t => mu^-1 *: g t).
Proof.
split=> [t|i i_s]; last first.
  have := covariance_transpose isE (covariance_mul isE (mu^-1)%:M (covariance_transpose isE (sum_seen i_s))).
  by rewrite trmx0 mul0mx trmx0; apply: (covariance_ext isE) => // t; rewrite mul_mx_scalar.
rewrite sum_inputs scalerBr scalerA mulVf ?contraction // scale1r scaler_sumr; congr (_ - _).
by apply: eq_bigr => i _; rewrite -scalemxAr.
Qed.

Variables (L : 'M[K]_(2 * 1, s * p)) (H : 'M[K]_(1, 2)).
Hypotheses (observed : row_free (O S s)) (hL : limit E (successive 0 2 u) (successive 2 s u) (successive 2 s y) L).
Hypothesis bx : covariance E b (later 1 x) H.

(** The range of the limit, by the two covariances. *)
Lemma range_by_errors H0 : covariance E g (later 1 x) H0 -> (L == O S s)%MS = row_full (col_mx H0 (H *m sysA S)).
Proof.
move=> gx; have bx2 := inputs_step b_inputs (proj2 back 1%N isT) bx; have [M [hM ->]] := mean_containment isE model quasi_x uv hL.
have fewer r : (r <= 3)%N -> excites E (s + r) u.
  have l3 := exciting; have l2 := excites_fewer isE pos quasi cu l3; have l1 := excites_fewer isE pos quasi cu l2.
  have l0 := excites_fewer isE pos quasi cu l1.
  by case: r => [|[|[|[|//]]]] _; rewrite ?addn0 ?addn1 ?addn2 ?addn3.
have [Ruu uu unit] : excites E s u by rewrite -[s]addn0; apply: fewer.
have {}uu : covariance E (successive 2 s u) (successive 2 s u) Ruu.
  by apply: (covariance_ext isE) (covariance_later isE 2 uu) => t; rewrite (successive_later 2 0).
have sample q r (i : 'I_r) t : successive q r u t *m (place K 1 i)^T = u (t + q + i)%N := esym (sample_of_future _ _ _).
have scalar (w : 'rV[K]_1) (a : 'M_1) : w *m a = a 0 0 *: w by rewrite [a]mx11_scalar mul_mx_scalar mxE mulr1n.
have places (a : nat -> 'M_1) t : successive 2 s u t *m (\sum_(i < s) a i 0 0 *: place K 1 i)^T = \sum_(i < s) u (t + 2 + i)%N *m a i.
  rewrite linear_sum mulmx_sumr; apply: eq_bigr => i _ /=; by rewrite linearZ -scalemxAr sample scalar.
pose rho0 : 'rV[K]_(2 * 1) := mu *: place K 1 (1 : 'I_2).
pose rho1 : 'rV[K]_(2 * 1) := place K 1 (0 : 'I_2) - c 0%N 0 0 *: place K 1 (1 : 'I_2).
have [eb bu] := back.
have first : covariance E (later 1 g) (later 2 x) (rho0 *m M).
  pose a i := - (c i + k *: d i.+1).
  apply: (limit_error isE uu unit hM (sigma := \sum_(i < s) a i 0 0 *: place K 1 i)) => [t|].
    rewrite (places a) /rho0 linearZ -scalemxAr sample /later sum_inputs addn0 -sumrN; congr (_ + _).
    by apply: eq_bigr => i _; rewrite mulmxN -addnA addnS -addnA.
  apply: (covariance_window isE) => i i_s; have := covariance_later isE 1 (sum_seen (i := i.+1) i_s).
  by apply: (covariance_ext isE) => // t; rewrite /later -addnA.
have second : covariance E b (later 2 x) (rho1 *m M).
  pose a i := - c i.+1.
  apply: (limit_error isE uu unit hM (sigma := \sum_(i < s) a i 0 0 *: place K 1 i)) => [t|].
    rewrite (places a) /rho1 linearB linearZ mulmxBr -scalemxAr !sample eb big_ord_recl opprD !addn0 addrA -sumrN -scalar; congr (_ + _).
    by apply: eq_bigr => i _; rewrite mulmxN -addnA.
  by apply: (covariance_window isE) => i i_s; apply: bu; rewrite addSn /= !ltnS.
have e0 : rho0 *m M = H0.
  apply: (covariance_unique isE first); apply: (covariance_ext isE) (covariance_later isE 1 gx) => // t.
  by rewrite /later -addnA.
have e1 : rho1 *m M = H *m sysA S := covariance_unique isE second bx2.
have eM : col_mx H0 (H *m sysA S) = col_mx rho0 rho1 *m M by rewrite mul_col_mx e0 e1.
have same : (M *m O S s == O S s)%MS = row_full M.
  apply/idP/idP => [/andP[_ le]|full]; last by apply/eqmxP; apply: eqmxMfull.
  rewrite /row_full eqn_leq rank_leq_col; apply: leq_trans (mxrankM_maxl M (O S s)); apply: leq_trans (mxrankS le).
  by have /eqP-> := observed.
rewrite same eM; apply/idP/idP => [full|]; last first.
  by rewrite /row_full !eqn_leq !rank_leq_col => /leq_trans; apply; apply: mxrankM_maxr.
suff free : row_free (col_mx rho0 rho1) by rewrite /row_full mxrankMfree.
apply: inj_row_free => r; rewrite -[r]hsubmxK mul_row_col [lsubmx r]mx11_scalar [rsubmx r]mx11_scalar !mul_scalar_mx => e.
move: (lsubmx r 0 0) (rsubmx r 0 0) e => al be e.
have := congr1 (mulmx^~ (place K 1 (0 : 'I_2))^T) e.
rewrite /= mul0mx mulmxDl -!scalemxAl mulmxBl -!scalemxAl !place_orthonormal /= !scaler0 add0r subr0 => /matrixP/(_ 0 0).
rewrite !mxE /= mulr1 => be0; rewrite {}be0 in e *.
have := congr1 (mulmx^~ (place K 1 (1 : 'I_2))^T) e.
rewrite /= mul0mx mulmxDl -!scalemxAl !place_orthonormal /= scale0r addr0 => /matrixP/(_ 0 0).
rewrite !mxE /= mulr1 => /eqP; rewrite mulf_eq0 (negbTE contraction) orbF => /eqP ->.
by rewrite raddf0 row_mx0.
Qed.

Theorem two_states : exists2 F, forall F', F' *m sysA S = sysA S *m F' /\ covariance E f x (H *m F') <-> F' = F &
  (L == O S s)%MS = ~~ ((sysA S \in unitmx) && is_scalar_mx (invmx (sysA S) + k *: F)).
Proof.
have bz := iffRL (inputs_state b_inputs 1 H) bx; have [G fx] := combination_covariance isE quasi cf cx.
have [H0 gx] := combination_covariance isE quasi cg (combination_later 1 cx).
have full : row_full (col_mx H (H *m sysA S)) := error_cyclic back bz exciting.
have full0 : row_full (col_mx H0 (H0 *m sysA S)).
  have gz : covariance E (fun t => mu^-1 *: g t) (later 1 z) (mu^-1 *: H0).
    have := covariance_mul isE (mu^-1)%:M (covariance_transpose isE (iffRL (inputs_state g_inputs 1 H0) gx)).
    move/(covariance_transpose isE); rewrite mul_mx_scalar linearZ /= trmxK; apply: (covariance_ext isE) => // t.
    by rewrite mul_mx_scalar.
  have := error_cyclic sum_error gz (excites_fewer isE pos quasi cu exciting).
  by rewrite -scalemxAl -scale_col_mx /row_full (eqmx_scale _ (invr_neq0 contraction)).
have [F comm eG] := cyclic_every G full; exists F => [F'|].
  split=> [[comm' fx']|->]; last by rewrite -eG.
  by apply: (cyclic_unique full comm' comm); rewrite -eG; apply: (covariance_unique isE fx').
have sum : H0 = H + k *: (G *m sysA S).
  have fx1 : covariance E f (later 1 x) (G *m sysA S).
    apply: (inputs_step f_inputs (proj2 forw 0%N isT)); apply: (covariance_ext isE) fx => // t; by rewrite /later addn0.
  apply: (covariance_unique isE gx); have := covariance_add isE (covariance_transpose isE bx)
    (covariance_mul isE k%:M (covariance_transpose isE fx1)) => /(covariance_transpose isE).
  rewrite mul_mx_scalar linearD linearZ /= !trmxK; apply: (covariance_ext isE) => // t.
  by rewrite mul_mx_scalar.
rewrite (range_by_errors gx); have [unit|singular] := boolP (sysA S \in unitmx).
  by apply: (independent_regular full sum unit comm); rewrite eG -!mulmxA comm.
exact: (independent_singular full0 full singular).
Qed.

End TwoStates.
