(** Time averages of what a stable system makes of bounded signals. A state that is driven by a bounded signal w is bounded; and where w has
    averages at all lags, and none beyond some lag, so have w and the state together.

       size_of x == the sum of the sizes of the entries of x
    averages f a == entry by entry, f has the mean a *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import MeansVocabulary Means TimeAverages OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Norms.
Variable K : realFieldType.

(** Section: definitions. *)
Definition size_of n (x : 'rV[K]_n) := \sum_i `|x 0 i|.

Lemma size_positive n (x : 'rV[K]_n) : 0 <= size_of x.
Proof. by apply: sumr_ge0 => i _. Qed.

Lemma size_entry n (x : 'rV[K]_n) i : `|x 0 i| <= size_of x.
Proof. by rewrite /size_of (bigD1 i) //= lerDl; apply: sumr_ge0. Qed.

Lemma size_add n (x y : 'rV[K]_n) : size_of (x + y) <= size_of x + size_of y.
Proof. by rewrite /size_of -big_split; apply: ler_sum => i _ /=; rewrite mxE ler_normD. Qed.

Lemma size_mul n n' (x : 'rV[K]_n) (M : 'M_(n, n')) c : (forall i j, `|M i j| <= c) -> size_of (x *m M) <= size_of x * (c *+ n').
Proof.
move=> h; rewrite /size_of mulr_suml; apply: le_trans (_ : \sum_j \sum_i `|x 0 i| * `|M i j| <= _).
  by apply: ler_sum => j _; rewrite mxE; apply: le_trans (ler_norm_sum _ _ _) _; apply: ler_sum => i _; rewrite normrM.
rewrite exchange_big; apply: ler_sum => i _ /=; rewrite -mulr_sumr ler_wpM2l //.
by rewrite -[X in _ *+ X]card_ord -sumr_const; apply: ler_sum => j _.
Qed.

Lemma matrix_bound a b (M : 'M[K]_(a, b)) : exists2 c, 0 <= c & forall i j, `|M i j| <= c.
Proof.
exists (\sum_i \sum_j `|M i j|) => [|i j]; first by do 2!apply: sumr_ge0 => ? _.
rewrite (bigD1 i) //= (bigD1 j) //= -addrA lerDl addr_ge0 ?sumr_ge0 // => i' _; by rewrite sumr_ge0.
Qed.

(** A power of a stable matrix that shrinks by any factor. *)
Lemma shrinks n (A : 'M[K]_n) eps : stable A -> 0 < eps -> exists k, forall x : 'rV_n, size_of (iter k (mulmxr A) x) <= size_of x * eps.
Proof.
move=> st e0; have h : 0 < eps / n.+1%:R by rewrite divr_gt0 ?ltr0n.
have [k hk] := st _ h; exists k => x; have -> : iter k (mulmxr A) x = x *m iter k (mulmxr A) 1%:M.
  by elim: (k) => [|l IH] /=; rewrite ?mulmx1 // IH mulmxA.
apply: le_trans (size_mul (c := eps / n.+1%:R) x _) _ => [i j|]; first by rewrite ltW.
apply: ler_wpM2l; first exact: size_positive.
rewrite -[_ / _ *+ n]mulr_natr mulrAC ler_pdivrMr ?ltr0n // ler_pM2l // ler_nat; exact: leqnSn.
Qed.

Lemma iterD_mul n (A : 'M[K]_n) k (x y : 'rV_n) : iter k (mulmxr A) (x + y) = iter k (mulmxr A) x + iter k (mulmxr A) y.
Proof. by elim: k => //= k ->; rewrite mulmxDl. Qed.

(** A state driven by what is bounded is bounded. *)
Lemma response_bounded n (A : 'M[K]_n) (x g : nat -> 'rV[K]_n) b : stable A -> (forall t, x t.+1 = x t *m A + g t) ->
  (forall t, size_of (g t) <= b) -> exists c, forall t, size_of (x t) <= c.
Proof.
case: n A x g => [|n] A x g st step gb; first by exists 0 => t; rewrite /size_of big_ord0.
have half : 0 < 2%:R^-1 :> K by rewrite invr_gt0 ltr0n.
have [k hk] := shrinks st half.
have k0 : (0 < k)%N.
  case: k hk => // /(_ (delta_mx 0 0)) /=; rewrite /size_of (bigD1 ord0) //= big1 => [|j /negbTE j0]; last by rewrite mxE j0 andbF normr0.
  by rewrite addr0 mxE eqxx normr1 mul1r invf_ge1 ?ltr0n // lern1.
have [m m0 hm] : exists2 m, 0 <= m & forall t, exists2 e, x (t + k)%N = iter k (mulmxr A) (x t) + e & size_of e <= m.
  have [a a0 ha] := matrix_bound A; elim: (k) => [|l [m m0 IH]].
    by exists 0 => // t; exists 0; rewrite ?addn0 ?addr0 // /size_of big1 // => i _; rewrite mxE normr0.
  exists (m * (a *+ n.+1) + b).
    by rewrite addr_ge0 ?mulr_ge0 ?mulrn_wge0 //; apply: le_trans (gb 0%N); apply: size_positive.
  move=> t; have [e ee le] := IH t; exists (e *m A + g (t + l)%N); first by rewrite addnS step ee mulmxDl addrA.
  apply: le_trans (size_add _ _) (lerD _ (gb _)); apply: le_trans (size_mul _ ha) _.
  by rewrite ler_wpM2r ?mulrn_wge0.
pose B0 := \sum_(t < k) size_of (x t); have B00 : 0 <= B0 by apply: sumr_ge0 => i _; apply: size_positive.
exists (B0 + (m + m)) => t; elim/ltn_ind: t => t IH; have [tk|kt] := ltnP t k.
  apply: le_trans (_ : B0 <= _); last by rewrite lerDl addr_ge0.
  rewrite /B0 (bigD1 (Ordinal tk)) //= lerDl; apply: sumr_ge0 => i _; apply: size_positive.
have [e ee le] := hm (t - k)%N; rewrite subnK // in ee; rewrite ee; apply: le_trans (size_add _ _) _.
apply: le_trans (lerD (le_trans (hk _) (ler_wpM2r _ (IH _ _))) le) _; first by rewrite invr_ge0 ler0n.
  by lia.
rewrite [X in _ <= X]splitr lerD2l ler_pdivlMr ?ltr0n // mulr_natr mulr2n; by rewrite lerDr.
Qed.

End Norms.

Section Averages.
Variable K : realFieldType.
Hypothesis arch : archimedean K.
Let E := @time_average K.
Let isE : mean E := time_average_mean arch.

Lemma average_earlier f a : E (fun t => f t.+1) a -> E f a.
Proof.
move=> fa eps e0; have h2 : 0 < eps / 2%:R by rewrite divr_gt0 ?ltr0n.
have [M hM] := fa _ h2; have [k hk] := arch (`|f 0%N - a| / (eps / 2%:R)); rewrite ltr_pdivrMr // in hk.
exists (maxn M k).+1 => -[//|N]; rewrite ltnS geq_max => /andP[NM Nk].
have -> : \sum_(t < N.+1) f t - N.+1%:R * a = (\sum_(t < N) f t.+1 - N%:R * a) + (f 0%N - a).
  by rewrite big_ord_recl mulrSr mulrDl mul1r opprD [f _ + _]addrC addrACA.
apply: le_trans (ler_normD _ _) _; apply: le_trans (lerD (hM N NM) (ltW hk)) _.
apply: le_trans (_ : N%:R * (eps / 2%:R) + N%:R * (eps / 2%:R) <= _).
  by rewrite lerD2l; apply: ler_wpM2r; rewrite ?(ltW h2) // ler_nat.
by rewrite -mulrDr -splitr; apply: ler_wpM2r; rewrite ?(ltW e0) // ler_nat.
Qed.

(** What is arbitrarily near to signals of average zero has the average zero. *)
Lemma average_near f : (forall eps, 0 < eps -> exists2 g, E g 0 & forall t, `|f t - g t| <= eps) -> E f 0.
Proof.
move=> h eps e0; have e2 : 0 < eps / 2%:R by rewrite divr_gt0 ?ltr0n.
have [g g0 near] := h _ e2; have [M hM] := g0 _ e2; exists M => N MN; rewrite mulr0 subr0.
have -> : \sum_(t < N) f t = \sum_(t < N) (f t - g t) + \sum_(t < N) g t by rewrite -big_split; apply: eq_bigr => t _; rewrite /= subrK.
apply: le_trans (ler_normD _ _) _; rewrite [eps]splitr mulrDr; apply: lerD; last by have := hM N MN; rewrite mulr0 subr0.
apply: le_trans (ler_norm_sum _ _ _) _; apply: le_trans (_ : \sum_(t < N) eps / 2%:R <= _).
  by apply: ler_sum => t _; apply: near.
by rewrite sumr_const card_ord mulr_natl.
Qed.

(** Entrywise. *)
Definition averages n (f : nat -> 'rV[K]_n) (a : 'rV_n) := forall i, E (fun t => f t 0 i) (a 0 i).

Lemma averages_add n (f g : nat -> 'rV[K]_n) a b : averages f a -> averages g b -> averages (fun t => f t + g t) (a + b).
Proof. by move=> h h' i; rewrite mxE; apply: (mean_ext isE) (mean_add isE (h i) (h' i)) => t; rewrite mxE. Qed.

Lemma averages_mul n n' (f : nat -> 'rV[K]_n) a (M : 'M_(n, n')) : averages f a -> averages (fun t => f t *m M) (a *m M).
Proof.
move=> h i; have e := mean_sum isE (index_enum _) (P := xpredT) (fun j _ => mean_scale isE (M j i) (h j)).
rewrite mxE (eq_bigr (fun j => M j i * a 0 j)) => [|j _]; last by rewrite mulrC.
by apply: (mean_ext isE) e => t; rewrite mxE; apply: eq_bigr => j _; rewrite mulrC.
Qed.

Lemma averages_zero n : averages (fun=> 0 : 'rV[K]_n) 0.
Proof. by move=> i; rewrite mxE; exact: (mean_zero isE). Qed.

(** A family of bounded signals, each of which makes the one before it through a stable matrix, but for what has the average zero. *)
Lemma driven_null n (M : 'M[K]_n) (f g : nat -> nat -> 'rV[K]_n) c : stable M -> (forall j t, f j t.+1 = f j.+1 t *m M + g j t) ->
  (forall j, averages (g j) 0) -> (forall j t, size_of (f j t) <= c) -> forall j, averages (f j) 0.
Proof.
move=> st step g0 fc; have c0 : 0 <= c by exact: le_trans (size_positive _) (fc 0%N 0%N).
have unroll k : exists2 e, forall j, averages (e j) 0 & forall j t, f j (t + k)%N = iter k (mulmxr M) (f (j + k)%N t) + e j t.
  elim: k => [|k [e e0 IH]].
    by exists (fun _ _ => 0) => [j|j t]; [exact: averages_zero|rewrite !addn0 addr0].
  exists (fun j t => e j.+1 t *m M + g j (t + k)%N) => [j|j t].
    have := averages_add (averages_mul M (e0 j.+1)) (_ : averages (fun t => g j (t + k)%N) 0); rewrite mul0mx addr0; apply.
    by move=> i; apply: (mean_later isE k (g0 j i)).
  by rewrite addnS step IH mulmxDl addrA addSnnS.
have back k (h : nat -> K) : E (fun t => h (t + k)%N) 0 -> E h 0.
  elim: k h => [|k IH] h e; first by apply: (mean_ext isE) e => t; rewrite addn0.
  by apply: average_earlier; apply: IH; apply: (mean_ext isE) e => t; rewrite addnS.
move=> j i; rewrite mxE; apply: average_near => eps eps0.
have h : 0 < eps / (c + 1) by rewrite divr_gt0 // ltr_pwDr ?ltr01.
have [k hk] := shrinks st h; have [e e0 he] := unroll k.
exists (fun t => if (t < k)%N then f j t 0 i else e j (t - k)%N 0 i) => [|t].
  apply: (back k); have := e0 j i; rewrite mxE; apply: (mean_ext isE) => t; by rewrite ltnNge leq_addl addnK.
case: ltnP => tk; first by rewrite subrr normr0 ltW.
rewrite -{1}(subnK tk) he mxE addrK; apply: le_trans (size_entry _ i) _; apply: le_trans (hk _) _.
apply: le_trans (ler_wpM2r (ltW h) (fc _ _)) _; rewrite mulrA ler_pdivrMr ?ltr_pwDr ?ltr01 // mulrC.
by rewrite ler_wpM2l ?(ltW eps0) // lerDl ler01.
Qed.

Lemma averages_earlier n (f : nat -> 'rV[K]_n) a : averages (fun t => f t.+1) a -> averages f a.
Proof. by move=> h i; apply: average_earlier; apply: h. Qed.

Lemma averages_ext n (f g : nat -> 'rV[K]_n) a : f =1 g -> averages f a -> averages g a.
Proof. by move=> e h i; apply: (mean_ext isE) (h i) => t; rewrite e. Qed.

Lemma size_scale n (a : K) (x : 'rV[K]_n) : size_of (a *: x) = `|a| * size_of x.
Proof. by rewrite /size_of mulr_sumr; apply: eq_bigr => i _; rewrite mxE normrM. Qed.

Lemma covariance_rows a b c d (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) (z : nat -> 'rV[K]_c) (w : nat -> 'rV[K]_d) R1 R2 R3 R4 :
  covariance E x z R1 -> covariance E x w R2 -> covariance E y z R3 -> covariance E y w R4 ->
  covariance E (fun t => row_mx (x t) (y t)) (fun t => row_mx (z t) (w t)) (block_mx R1 R2 R3 R4).
Proof.
move=> h1 h2 h3 h4 i j; case: (split_ordP i) => i' ->; case: (split_ordP j) => j' ->.
- by rewrite block_mxEul; apply: (mean_ext isE) (h1 i' j') => t; rewrite !row_mxEl.
- by rewrite block_mxEur; apply: (mean_ext isE) (h2 i' j') => t; rewrite row_mxEl row_mxEr.
- by rewrite block_mxEdl; apply: (mean_ext isE) (h3 i' j') => t; rewrite row_mxEl row_mxEr.
by rewrite block_mxEdr; apply: (mean_ext isE) (h4 i' j') => t; rewrite !row_mxEr.
Qed.

(** Stein's equation. *)
Section Stein.
Variables (n : nat) (A : 'M[K]_n).
Hypothesis st : stable A.
Let M : 'M_(n * n) := lin_mx (mulmxr A \o mulmx A^T).

Lemma stein_powers k (X : 'M_n) : iter k (mulmxr M) (mxvec X) = mxvec ((iter k (mulmxr A) 1%:M)^T *m X *m iter k (mulmxr A) 1%:M).
Proof.
elim: k => [|k IH]; first by rewrite /= trmx1 mul1mx mulmx1.
by rewrite iterS IH /= mul_vec_lin /= trmx_mul !mulmxA.
Qed.

Lemma stein_stable : stable M.
Proof.
move=> eps eps0; pose d := Num.min eps 1; have d0 : 0 < d by rewrite lt_min eps0 ltr01.
have [k hk] := st d0; exists k => i j; case/mxvec_indexP: i => i1 i2; case/mxvec_indexP: j => j1 j2; set P := iter k (mulmxr A) 1%:M.
have rows (X : 'M_(n * n)) i : row i (iter k (mulmxr M) X) = iter k (mulmxr M) (row i X).
  by elim: (k) => //= l IH; rewrite row_mul IH.
have -> : iter k (mulmxr M) 1%:M (mxvec_index i1 i2) (mxvec_index j1 j2) = P i1 j1 * P i2 j2.
  have := congr1 (fun v : 'rV_(n * n) => v 0 (mxvec_index j1 j2)) (rows 1%:M (mxvec_index i1 i2)); rewrite mxE => ->.
  rewrite row1 -mxvec_delta stein_powers mxvecE -/P.
  by rewrite -(mul_delta_mx (0 : 'I_1)) !mulmxA -colE -mulmxA -rowE !mxE big_ord1 !mxE.
rewrite normrM; apply: le_lt_trans (_ : d * `|P i2 j2| < eps); first by rewrite ler_wpM2r // ltW.
apply: lt_le_trans (_ : d * d <= _); first by rewrite ltr_pM2l.
apply: le_trans (_ : eps * 1 <= _); last by rewrite mulr1.
by apply: ler_pM; rewrite ?(ltW d0) // /d ge_min lexx ?orbT.
Qed.

Lemma stein_unit : 1%:M - M \in unitmx.
Proof.
rewrite -row_free_unit -kermx_eq0; apply/eqP/row_matrixP => i; rewrite row0; set y := row i _.
have : y *m (1%:M - M) = 0 by rewrite /y -row_mul mulmx_ker row0.
rewrite mulmxBr mulmx1 => /eqP; rewrite subr_eq0 => /eqP fix_y.
have half : 0 < 2%:R^-1 :> K by rewrite invr_gt0 ltr0n.
have [k hk] := shrinks stein_stable half; have same : iter k (mulmxr M) y = y by elim: (k) => //= l ->.
have := hk y; rewrite same ler_pdivlMr ?ltr0n // mulr_natr mulr2n gerDl => le0.
apply/rowP => j; rewrite [RHS]mxE; apply/eqP; rewrite -normr_eq0 eq_le normr_ge0 andbT.
exact: le_trans (size_entry y j) le0.
Qed.

End Stein.

Section Responses.
Variables (N n h : nat) (A : 'M[K]_n) (B : 'M[K]_(N, n)) (w : nat -> 'rV[K]_N) (x : nat -> 'rV[K]_n) (bw : K).
Hypotheses (st : stable A) (step : forall t, x t.+1 = x t *m A + w t *m B) (wb : forall t, size_of (w t) <= bw).
Hypotheses (quasi : quasi_stationary E w) (short : forall l, (h <= l)%N -> covariance E w (later l w) 0).

Lemma state_bounded : exists2 c, 0 <= c & forall t, size_of (x t) <= c.
Proof.
have [b b0 hb] := matrix_bound B.
have [t|c hc] := response_bounded st step (b := bw * (b *+ n)).
  by apply: le_trans (size_mul _ hb) _; rewrite ler_wpM2r ?mulrn_wge0.
by exists c => //; apply: le_trans (size_positive _) (hc 0%N).
Qed.

Let f j l t : 'rV[K]_n := w (t + l)%N 0 j *: x t.
Let f_step j l t : f j l t.+1 = f j l.+1 t *m A + (w (t + l.+1)%N 0 j *: w t) *m B.
Proof. by rewrite /f step scalerDr -!scalemxAl addSnnS. Qed.

Lemma far j l : (h <= l.+1)%N -> averages (f j l) 0.
Proof.
move=> hl; have [c c0 hc] := state_bounded.
have bounded k t : size_of (f j (l + k)%N t) <= bw * c.
  rewrite size_scale; apply: ler_pM; rewrite ?normr_ge0 ?size_positive ?hc //; exact: le_trans (size_entry _ _) (wb _).
have := driven_null st (f := fun k => f j (l + k)%N) (g := fun k t => (w (t + (l + k).+1)%N 0 j *: w t) *m B) _ _ bounded 0%N.
rewrite addn0; apply=> [k t|k]; first by rewrite f_step (addnS l k).
rewrite -(mul0mx _ B); apply: averages_mul => i; have := @short (l + k).+1 _ i j; rewrite !mxE => e.
by apply: (mean_ext isE) (e _) => [t|]; [rewrite mxE mulrC|apply: leq_trans hl _; rewrite ltnS leq_addr].
Qed.

Lemma near d j l : (h <= l.+1 + d)%N -> exists a, averages (f j l) a.
Proof.
elim: d l => [|d IH] l hl; first by exists 0; apply: far; rewrite addn0 in hl.
have [|a ha] := IH l.+1; first by rewrite addSnnS.
have [R hR] := quasi l.+1; exists (a *m A + (\row_i R i j) *m B); apply: averages_earlier.
apply: (averages_ext (fun t => esym (f_step j l t))); apply: averages_add; apply: averages_mul => // i.
by rewrite mxE; apply: (mean_ext isE) (hR i j) => t; rewrite mxE mulrC.
Qed.

Lemma state_input l : exists C, covariance E x (later l w) C.
Proof.
have [a ha] := fin_all_exists (fun j => @near h j l (leq_addl _ _)).
by exists (\matrix_(i, j) a j 0 i) => i j; rewrite mxE; apply: (mean_ext isE) (ha j i) => t; rewrite mxE mulrC.
Qed.

Lemma state_knows_nothing l : (h <= l.+1)%N -> covariance E x (later l w) 0.
Proof. by move=> hl i j; have := far j hl i; rewrite !mxE; apply: (mean_ext isE) => t; rewrite mxE mulrC. Qed.

Lemma state_state : exists P, covariance E x x P.
Proof.
have [c c0 hc] := state_bounded; have [C hC] := state_input 0; have [R hR] := quasi 0%N.
pose F t := (x t)^T *m x t; pose H t := (x t *m A)^T *m (w t *m B) + (w t *m B)^T *m (x t *m A) + (w t *m B)^T *m (w t *m B).
pose M : 'M_(n * n) := lin_mx (mulmxr A \o mulmx A^T).
have F_step t : mxvec (F t.+1) = mxvec (F t) *m M + mxvec (H t).
  rewrite /F /H step mul_vec_lin /=; set a := x t *m A; set b := w t *m B.
  have -> : (a + b)^T *m (a + b) = a^T *m a + (a^T *m b + b^T *m a + b^T *m b).
    by rewrite [(a + b)^T]linearD /= mulmxDl !mulmxDr !addrA.
  by rewrite linearD /a /= trmx_mul !mulmxA.
have now (z : nat -> 'rV[K]_N) : later 0 z =1 z by move=> t; rewrite /later addn0.
have {}hC : covariance E x w C by apply: (covariance_ext isE) hC.
have {}hR : covariance E w w R by apply: (covariance_ext isE) hR.
pose Hbar := A^T *m C *m B + B^T *m C^T *m A + B^T *m R *m B.
have H_average : averages (fun t => mxvec (H t)) (mxvec Hbar).
  move=> k; case/mxvec_indexP: k => i j; rewrite mxvecE [Hbar i j]mxE [X in X + _]mxE.
  have xw := covariance_images isE A B hC; have wx := covariance_images isE B A (covariance_transpose isE hC).
  have ww := covariance_images isE B B hR.
  apply: (mean_ext isE) (mean_add isE (mean_add isE (xw i j) (wx i j)) (ww i j)) => t.
  by rewrite mxvecE /H [RHS]mxE [X in _ = X + _]mxE; congr (_ + _ + _); rewrite [RHS]mxE big_ord1 [X in _ = X * _]mxE.
pose P := mxvec Hbar *m invmx (1%:M - M).
have PM : mxvec Hbar = P - P *m M by rewrite -{1}[P]mulmx1 -mulmxBr mulmxKV // stein_unit.
have size_F t : size_of (mxvec (F t) - P) <= c * c + size_of P.
  apply: le_trans (size_add _ _) _; apply: lerD; last first.
    by rewrite /size_of; apply: ler_sum => i _; rewrite mxE normrN.
  rewrite /size_of (reindex _ (curry_mxvec_bij n n)) /=.
  apply: le_trans (_ : \sum_i \sum_j `|x t 0 i| * `|x t 0 j| <= _).
    rewrite pair_big /=; apply: ler_sum => -[i j] _; by rewrite mxvecE mxE big_ord1 mxE normrM.
  rewrite -big_distrlr; apply: ler_pM; rewrite ?hc ?size_positive //; exact: size_positive.
have F_average : averages (fun t => mxvec (F t) - P) 0.
  apply: (driven_null (stein_stable st) (f := fun _ t => mxvec (F t) - P) (g := fun _ t => mxvec (H t) - mxvec Hbar) _ _ (fun _ => size_F)
    0%N).
    move=> _ t; rewrite F_step mulmxBl PM; have e (a b p q : 'rV[K]_(n * n)) : a + b - p = a - q + (b - (p - q)).
      by rewrite opprB [b + _]addrC addrA subrKA addrAC.
    exact: e.
  move=> _; rewrite -(subrr (mxvec Hbar)); apply: averages_add H_average _ => i; exact: average_constant.
exists (vec_mx P) => i j; have := F_average (mxvec_index i j); rewrite mxE => e.
have := mean_add isE e (average_constant arch (P 0 (mxvec_index i j))); rewrite add0r.
have -> : vec_mx P i j = P 0 (mxvec_index i j) by rewrite mxE.
apply: (mean_ext isE) => t; rewrite mxE [X in _ + X + _]mxE subrK mxvecE /F mxE big_ord1; by rewrite mxE.
Qed.

(** Covariances at all lags. *)
Lemma responses_quasi : quasi_stationary E (fun t => row_mx (w t) (x t)).
Proof.
have grow a (z : nat -> 'rV[K]_a) : (forall l, exists C, covariance E z (later l w) C) -> (exists C, covariance E z x C) ->
    forall l, exists C, covariance E z (later l x) C.
  move=> zw [C0 zx]; elim=> [|l [C IH]]; first by exists C0; apply: (covariance_ext isE) zx => // t; rewrite /later addn0.
  have [C' hC'] := zw l; exists (C *m A + C' *m B).
  apply: (covariance_ext isE) (covariance_add isE (covariance_mul isE A IH) (covariance_mul isE B hC')) => // t.
  by rewrite /later addnS step.
have wx : exists C, covariance E w x C.
  have [C hC] := state_input 0; exists C^T; have := covariance_transpose isE hC.
  by apply: (covariance_ext isE) => // t; rewrite /later addn0.
move=> l; have [R1 h1] := quasi l; have [R2 h2] := grow _ w quasi wx l.
have [R3 h3] := state_input l; have [R4 h4] := grow _ x state_input state_state l.
by exists (block_mx R1 R2 R3 R4); exact: (covariance_rows h1 h2 h3 h4).
Qed.

End Responses.
End Averages.
