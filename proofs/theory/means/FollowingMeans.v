(** A fault that follows a white input, v(k+1) = u(k) Phi, in means: with a past input, s >= 1 and all states shown by s - 1 samples, never
    both are right, the range and output error, unless the fault is never seen. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary FollowingFault Regression.
From faultspace Require Import MeansVocabulary Means MeanLimits Forgetting LongPast PastStates WhiteMeans OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Following.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (Phi : 'M[K]_(nu, m)) (u w : nat -> 'rV[K]_nu) (x z : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (pos : positive E) (model : process S B D u (fun t => w t *m Phi) x y) (wu : forall t, w t.+1 = u t).
Hypotheses (st : stable (sysA S)) (u_white : white_noise E u) (driven : forall t, z t.+1 = z t *m sysA S + u t *m B).
Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))).
Let h t := row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t)).
Let cu : combination h u.
Proof. by apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !addr0. Qed.
Let cw : combination h w.
Proof.
by apply: combination_ext (combination_part h (col_mx (col_mx 0 1%:M) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.
Let cx : combination h x.
Proof.
by apply: combination_ext (combination_part h (col_mx 0 (col_mx 1%:M 0))) => t; rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.
Let cz : combination h z.
Proof.
by apply: combination_ext (combination_part h (col_mx 0 (col_mx 0 1%:M))) => t; rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.

Let uu l : covariance E (later l.+1 u) u 0.
Proof. by have := covariance_transpose isE (u_white l.+1); rewrite trmx0. Qed.
Lemma memory_before : knows_nothing_before E u w.
Proof.
move=> l; apply: (covariance_earlier isE quasi (k := 1) (combination_later l cu) cw).
by apply: (covariance_ext isE) (uu l) => t; rewrite /later ?addn1 ?wu //; congr u; lia.
Qed.
Lemma following_before : knows_nothing_before E u x.
Proof.
have step t : x t.+1 = x t *m sysA S + row_mx (u t) (w t) *m col_mx B (Phi *m sysF S).
  by have [-> _] := model t; rewrite mul_row_col !mulmxA addrA.
apply: (past_state isE pos quasi st cu cx step); apply: (before_row isE) => l.
  by apply: (covariance_ext isE) (uu l) => // t; rewrite /later addn1 addnS.
by apply: (covariance_ext isE) (memory_before l.+1) => // t; rewrite /later addn1 addnS.
Qed.

(** The basic variables of a stretch of samples, the memory w being a part of the state. *)
Lemma following_lifted H : exists N (Q : 'M[K]_N) (g : nat -> 'rV[K]_N) U W X Y, [/\ covariance E g g Q,
  process S B D U (fun k => W k *m Phi) X Y /\ (forall k, W k.+1 = U k), white Q U H,
  forall i, (i < H)%N -> cov Q (U i) (X 0%N) = 0 /\ cov Q (U i) (W 0%N) = 0
  & forall k s, (k + s <= H)%N -> forall t, successive k s u t = g t *m future k s U /\ successive k s y t = g t *m future k s Y].
Proof.
pose Sw : system K (n + nu) 0 p := System (block_mx (sysA S) 0 (Phi *m sysF S) 0) 0 (col_mx (sysC S) (Phi *m sysG S)) 0.
pose zero (t : nat) : 'rV[K]_0 := 0; pose xw t := row_mx (x t) (w t).
have model_w : process Sw (row_mx B 1%:M) D u zero xw y.
  move=> t; have [ex ey] := model t; rewrite /xw ex ey wu /= mul_row_block mul_mx_row mul_row_col !mulmx0 mulmx1 !addr0 !mulmxA.
  by split; [rewrite add_row_mx add0r addrAC|rewrite addrAC].
have quasi_w : quasi_stationary E (fun t => row_mx (row_mx (u t) (zero t)) (xw t)).
  have c : combination h (fun t => row_mx (row_mx (u t) (zero t)) (xw t)).
    apply: combination_ext (combination_part h (col_mx (col_mx (row_mx (row_mx 1%:M 0) 0) (row_mx 0 (row_mx 0 1%:M)))
      (col_mx (row_mx 0 (row_mx 1%:M 0)) 0))) => t.
    rewrite !mul_row_col !mul_mx_row !mulmx0 !mulmx1 ?add_row_mx ?addr0 ?add0r ?add_row_mx ?addr0 ?add0r ?add_row_mx ?addr0 ?add0r.
    by rewrite /xw ?row_mx0; congr (row_mx (row_mx _ _) _).
  by move=> l; apply: (combination_covariance isE quasi c (combination_later l c)).
have [N [Q [g [U [V [X [Y [[sym gQ] model' inputs [states _] windows]]]]]]]] := lifted_windows isE model_w quasi_w H.
pose W k := rsubmx (X k); pose X1 k := lsubmx (X k).
have parts k : X k = row_mx (X1 k) (W k) by rewrite hsubmxK.
have next k : X1 k.+1 = X1 k *m sysA S + U k *m B + W k *m Phi *m sysF S /\ W k.+1 = U k.
  have [e _] := model' k; move: e; rewrite !parts /= mul_row_block mul_mx_row !mulmx0 mulmx1 !addr0 add_row_mx add0r => /eq_row_mx[-> ->].
  by rewrite mulmxA addrAC.
have Uu k (kH : (k < H)%N) t : later k u t = g t *m U k by have [] := inputs k kH t.
have starts a (f : nat -> 'rV[K]_a) (F : 'M_(N, a)) i : (i < H)%N -> knows_nothing_before E u f -> (forall t, f t = g t *m F) ->
    cov Q (U i) F = 0.
  move=> iH uf ef; exact: (image_cov isE gQ (Uu i iH) ef (uf i)).
have x0 t : x t = g t *m X1 0%N /\ w t = g t *m W 0%N.
  by have := states 0%N (leq0n H) t; rewrite addn0 parts mul_mx_row => /eq_row_mx.
exists N, Q, g, U, W, X1, Y; split=> //.
- split=> k; last by have [] := next k.
  split; first by have [] := next k.
  by have [_ ->] := model' k; rewrite parts /= mul_row_col mulmx0 addr0 mulmxA addrAC.
- move=> i k iH kH; apply: (image_cov isE gQ (Uu i iH) (Uu k kH)).
  by have := white_later isE i k u_white; case: eqP => _; rewrite ?raddf0.
- move=> i iH; split; first by apply: (starts _ x _ _ iH following_before) => t; have [] := x0 t.
  by apply: (starts _ w _ _ iH memory_before) => t; have [] := x0 t.
by move=> k s ksH t; have [-> _ ->] := windows k s ksH t.
Qed.

Lemma following_hidden q s L : (0 < q)%N -> (0 < s)%N -> row_free (O S s.-1) ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L <= O S s)%MS ->
  exists2 d : 'M_(nu, n), d *m sysA S = Phi *m sysF S & d *m sysC S = Phi *m sysG S.
Proof.
move=> q0 s0 obs hL le; have [N [Q [g [U [W [X [Y [gQ [model' WU] white' start windows]]]]]]]] := following_lifted (q + s).
have Zu t : successive 0 q u t = g t *m future (q - q) q U by rewrite subnn; have [] := windows 0%N q (leq_addr s q) t.
have Uf t : successive q s u t = g t *m future q s U by have [] := windows q s (leqnn _) t.
have Yf t : successive q s y t = g t *m future q s Y by have [] := windows q s (leqnn _) t.
have qq : (0 < q <= q)%N by rewrite q0 leqnn.
have [d [dA dC _]] := following_fault_hidden model' WU white' start qq (leqnn _) s0 obs ((image_limit isE gQ L Zu Uf Yf).1 hL) le.
by exists d.
Qed.

Theorem mean_not_both q s L R : (0 < q)%N -> (0 < s)%N -> row_free (O S s.-1) -> row_free (O S n) ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L <= O S s)%MS ->
  covariance E (fun t => y t - (z t *m sysC S + u t *m D)) (fun t => y t - (z t *m sysC S + u t *m D)) R ->
  (forall (B' : 'M_(nu, n)) (D' : 'M_(nu, p)) z' R', (forall t, z' t.+1 = z' t *m sysA S + u t *m B') ->
    covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' -> \tr R <= \tr R') ->
  Phi *m sysF S = 0 /\ Phi *m sysG S = 0.
Proof.
move=> q0 s0 obs' obs hL le hR least; have [d dA dC] := following_hidden q0 s0 obs' hL le.
pose x' t := x t + w t *m d.
have driven' t : x' t.+1 = x' t *m sysA S + u t *m (B + d).
  rewrite /x' wu; have [-> _] := model t; rewrite mulmxDl mulmxDr -!mulmxA dA [RHS]addrA; congr (_ + _); exact: addrAC.
have out t : y t = x' t *m sysC S + u t *m D.
  rewrite /x'; have [_ ->] := model t; rewrite mulmxDl -!mulmxA dC; exact: addrAC.
have tr0 : \tr R <= 0.
  rewrite -(mxtrace0 K p); apply: (least _ D _ 0 driven') => i j; rewrite mxE; apply: (mean_ext isE) (mean_zero isE) => t.
  by rewrite -out subrr mxE mul0r.
have R0 i : R i i = 0.
  have ge j : 0 <= R j j := square_positive isE pos j hR.
  apply/eqP; rewrite eq_le ge andbT; apply: le_trans tr0; rewrite /mxtrace (bigD1 i) //= lerDl; by apply: sumr_ge0.
pose e t := x' t - z t.
have step_e t : e t.+1 = e t *m sysA S + u t *m d
  by rewrite /e driven' driven mulmxDr opprD addrACA mulmxBl; congr (_ + _); rewrite addrAC subrr add0r.
have ce : combination h e.
  apply: combination_ext (combination_add (combination_add cx (combination_mul d cw)) (combination_mul (- 1%:M) cz)) => t.
  by rewrite mulmxN mulmx1.
have null j : covariance E (fun t => e t *m col j (sysC S)) (fun t => e t *m col j (sysC S)) 0.
  have := covariance_images isE (delta_mx j 0 : 'cV_p) (delta_mx j 0 : 'cV_p) hR; rewrite (_ : _ *m _ = 0); last first.
    by apply/matrixP=> k l; rewrite !ord1 trmx_delta -rowE -colE !mxE; apply: R0.
  by apply: (covariance_ext isE) => t; rewrite out opprD addrACA subrr addr0 -mulmxBl -mulmxA -colE.
have [d0 _] : d = 0 /\ (0 : 'M[K]_(nu, p)) = 0.
  apply: (no_impulse obs) => -[|l] ln //=.
  apply/matrixP => i j; rewrite [RHS]mxE.
  have null' : covariance E (fun t => e t *m col j (sysC S) + \sum_(i < 0) u (t + i)%N *m (0 : 'cV[K]_nu))
      (fun t => e t *m col j (sysC S) + \sum_(i < 0) u (t + i)%N *m (0 : 'cV[K]_nu)) 0.
    by apply: (covariance_ext isE) (null j) => t; rewrite big_ord0 addr0.
  have [zB _] := zeta_unreached isE pos quasi cu ce step_e (d := fun=> 0) null' (white_excites isE (n + 0) u_white) (fun _ _ => erefl).
  have := congr1 (fun M : 'cV_nu => M i 0) (zB l ln); rewrite [X in _ = X -> _]mxE => <- /=.
  by rewrite !mxE; apply: eq_bigr => k _; rewrite [col _ _ _ _]mxE.
by rewrite -dA -dC d0 !mul0mx.
Qed.

End Following.
