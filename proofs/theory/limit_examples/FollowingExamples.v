(** A fault that follows a white input, one state, input, fault and output: x(k+1) = a x(k) + u(k) + f v(k), y = x, v(k) = u(k-1). For a
    and f positive and two samples or more no singular vector of the limit of PI-MOESP spans the range of O_s, so A and C are wrong. For a
    f = -(1 + a^2), two samples and three past inputs or more, the leading one does span it, and the regression gives B and D: all right,
    although the limit is of rank 2. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Windows Places Signals Consistency Leads Regression Undetectable FollowingFault OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma samples_dot (K : fieldType) p s (r r' : nat -> 'rV[K]_p) : samples s r *m (samples s r')^T = \sum_(k < s) r k *m (r' k)^T.
Proof.
rewrite !samples_places linear_sum mulmx_suml; apply: eq_bigr => k _; rewrite mulmx_sumr (bigD1 k) //= big1 => [|j].
  by rewrite addr0 trmx_mul -mulmxA (mulmxA (place K p k)) place_orthonormal eqxx mul1mx.
by rewrite -val_eqE eq_sym trmx_mul -mulmxA (mulmxA (place K p k)) place_orthonormal => /negbTE ->; rewrite mul0mx mulmx0.
Qed.

Lemma places_gram (K : fieldType) nu q c (R : 'I_q -> 'M[K]_(nu, c)) : let L := \sum_(j < q) (place K nu j)^T *m R j in
  L^T *m L = \sum_(j < q) (R j)^T *m R j.
Proof.
move=> L; have -> : L^T = \sum_(j < q) (R j)^T *m place K nu j.
  by rewrite raddf_sum; apply: eq_bigr => j _; rewrite /= trmx_mul trmxK.
rewrite mulmx_suml; apply: eq_bigr => j _; rewrite /L mulmx_sumr (bigD1 j) //= big1 => [|i].
  by rewrite addr0 -mulmxA (mulmxA (place K nu j)) place_orthonormal eqxx mul1mx.
by rewrite -val_eqE eq_sym -mulmxA (mulmxA (place K nu j)) place_orthonormal => /negbTE ->; rewrite mul0mx mulmx0.
Qed.

Section Gram.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (Phi : 'M[K]_(nu, m)) (u w : nat -> 'M[K]_(N, nu)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)) (H : nat).
Hypotheses (model : process S B D u (fun k => w k *m Phi) x y) (wu : forall k, w k.+1 = u k) (u_white : white Q u H).
Hypothesis start : forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0.
Let after := B *m sysA S + Phi *m sysF S.
Let h s := first_response S B Phi s.

Theorem following_gram t q s L : (q < t)%N -> (t + s <= H)%N ->
  projected_limit Q (future (t - q.+1) q.+1 u) (future t s u) (future t s y) L ->
  L^T *m L = (h s)^T *m h s + (O S s)^T *m (\sum_(j < q) (times_power S after j)^T *m times_power S after j) *m O S s.
Proof.
move=> qt tH /(following_limit model wu u_white start qt tH) ->; rewrite places_gram (reindex_inj rev_ord_inj) big_ord_recl /= subn1 subnn.
congr (_ + _); rewrite mulmx_sumr mulmx_suml; apply: eq_bigr => j _; rewrite /bump /= add1n subSS subKn; last exact: ltn_ord.
by rewrite memory_power memory_O trmx_mul !mulmxA.
Qed.

End Gram.

Section Scalar.
Variables (K : realFieldType) (a f : K) (N H : nat) (Q : 'M[K]_N) (u w x y : nat -> 'cV[K]_N).
Let S : system K 1 1 1 := System a%:M f%:M 1%:M 0.
Hypotheses (model : process S (1%:M : 'M_1) 0 u w x y) (wu : forall k, w k.+1 = u k) (u_white : white Q u H).
Hypothesis start : forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0.

Let model1 : process S (1%:M : 'M_1) 0 u (fun k => w k *m 1%:M) x y.
Proof. by move=> k; rewrite /= [w k *m 1%:M]mulmx1; apply: model. Qed.

Let ov k : 'rV[K]_1 := (a ^+ k)%:M.
Let hv k : 'rV[K]_1 := if k is j.+1 then ((a + f) * a ^+ j)%:M else 1%:M.

Lemma free_output (c : K) k : output S c%:M (fun=> 0) k = (c * a ^+ k)%:M.
Proof.
rewrite /output mul0mx addr0 mulmx1; elim: k => [|k IH]; first by rewrite mulr1.
by rewrite /= IH mul0mx addr0 -scalar_mxM exprSr mulrA.
Qed.

Lemma scalar_O s : O S s = samples s ov.
Proof. by rewrite -[LHS]mul1mx mul_O; apply: samples_ext => k _; rewrite free_output mul1r. Qed.

Lemma scalar_first s : first_response S (1%:M : 'M_1) 1%:M s = samples s hv.
Proof.
rewrite -[LHS](row_id 0) first_responseE; apply: samples_ext => -[|k] _; rewrite row_id.
  by rewrite /= !mulmx0 addr0 mulmx1.
by rewrite /= !mul1mx -raddfD free_output.
Qed.

Lemma scalar_gram t q s L : (q < t)%N -> (t + s <= H)%N ->
  projected_limit Q (future (t - q.+1) q.+1 u) (future t s u) (future t s y) L ->
  L^T *m L = (samples s hv)^T *m samples s hv + (\sum_(j < q) ((a + f) * a ^+ j) ^+ 2) *: ((samples s ov)^T *m samples s ov).
Proof.
move=> qt tH limit; rewrite (following_gram model1 wu u_white start qt tH limit) scalar_first scalar_O; congr (_ + _).
have power j : times_power S (1%:M *m sysA S + 1%:M *m sysF S) j = ((a + f) * a ^+ j)%:M.
  rewrite /= !mul1mx -raddfD; elim: j => [|j IH]; first by rewrite mulr1.
  by rewrite /= IH -scalar_mxM exprSr mulrA.
rewrite (eq_bigr (fun j : 'I_q => (((a + f) * a ^+ j) ^+ 2)%:M)) => [|j _]; last by rewrite power tr_scalar_mx -scalar_mxM expr2.
by rewrite -raddf_sum /= mul_mx_scalar -scalemxAl.
Qed.

(** A positive overlap of O_s with a response that it does not span. *)
Theorem no_singular_vector t q s L : 0 < a -> 0 < f -> (0 < q <= t)%N -> (1 < s)%N -> (t + s <= H)%N ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> ~ (O S s *m (L^T *m L) <= O S s)%MS.
Proof.
case: q L => // q L a0 f0 qt s1 tH limit; rewrite (scalar_gram qt tH limit) scalar_O mulmxDr -scalemxAr !mulmxA.
set o := samples s ov; set h := samples s hv; set c := \sum_(_ < _) _ => sub.
have : (o *m h^T *m h <= o)%MS.
  rewrite -[_ *m h](addrK (c *: (o *m o^T *m o))); apply: addmx_sub => //.
  by rewrite eqmx_opp; apply: scalemx_sub; apply: submxMl.
have -> : o *m h^T = (\sum_(k < s) (a ^+ k * (if nat_of_ord k is j.+1 then (a + f) * a ^+ j else 1)))%:M.
  rewrite samples_dot raddf_sum; apply: eq_bigr => -[[|k] ks] _; rewrite /ov /hv tr_scalar_mx -scalar_mxM //.
rewrite mul_scalar_mx; set pi := \sum_(_ < _) _; have pi0 : 0 < pi.
  rewrite /pi (bigD1 (Ordinal (ltnW s1))) //= expr0 mulr1 ltr_wpDr ?ltr01 //; apply: sumr_ge0 => k _; apply: ltW.
  by case: (nat_of_ord k) => [|j]; rewrite !mulr_gt0 ?addr_gt0 ?exprn_gt0 ?ltr01.
rewrite eqmx_scale ?gt_eqF // => /submxP[g e].
have each k : (k < s)%N -> hv k = g *m ov k.
  move: k; apply: samples_inj; rewrite -/h e /o !samples_places mulmx_sumr.
  by apply: eq_bigr => k _; rewrite mulmxA.
have := each 1%N s1; have := each 0%N (ltnW s1); rewrite /hv /ov !expr0 mulmx1 mulr1 => <-.
rewrite mul1mx expr1 => /matrixP/(_ 0 0)/eqP; rewrite !mxE !mulr1n -subr_eq0 addrC addKr.
by rewrite (gt_eqF f0).
Qed.

(** The response is orthogonal to O_2. *)
Theorem leading_singular_vector t q L : a != 0 -> a * f = - (1 + a ^+ 2) -> (2 < q <= t)%N -> (t + 2 <= H)%N ->
  projected_limit Q (future (t - q) q u) (future t 2 u) (future t 2 y) L -> exists (h : 'rV_(2 * 1)) lambda mu,
  [/\ O S 2 *m (L^T *m L) = lambda *: O S 2, h *m (L^T *m L) = mu *: h, O S 2 *m h^T = 0, 0 < mu < lambda & h != 0].
Proof.
case: q L => // q L a0 af /andP[q2 qt] tH limit; rewrite (scalar_gram qt tH limit) scalar_O.
set o := samples 2 ov; set h := samples 2 hv; set c := \sum_(_ < _) _.
have af' : a + f = - a^-1.
  apply: (mulfI a0); rewrite mulrDr af mulrN mulfV // opprD addrCA -expr2 subrr addr0 //.
have oh : o *m h^T = 0.
  rewrite samples_dot big_ord_recl big_ord1 /ov /hv /= !tr_scalar_mx -!scalar_mxM mulr1 mulr1 expr1 af' mulrN mulfV //.
  by rewrite -raddfD /= subrr raddf0.
have ho : h *m o^T = 0 by apply: trmx_inj; rewrite trmx_mul trmxK oh trmx0.
have oo : o *m o^T = (1 + a ^+ 2)%:M.
  by rewrite samples_dot big_ord_recl big_ord1 /ov !tr_scalar_mx -!scalar_mxM mulr1 -raddfD.
have hh : h *m h^T = (1 + (a ^- 1) ^+ 2)%:M.
  by rewrite samples_dot big_ord_recl big_ord1 /hv /= !tr_scalar_mx -!scalar_mxM !mulr1 af' mulrNN -raddfD expr2.
have one : 0 < 1 + a ^+ 2 by rewrite ltr_wpDr ?sqr_ge0 ?ltr01.
have one' : 0 < 1 + (a ^-1) ^+ 2 by rewrite ltr_wpDr ?sqr_ge0 ?ltr01.
exists h, (c * (1 + a ^+ 2)), (1 + (a ^-1) ^+ 2); split=> //.
- by rewrite mulmxDr -scalemxAr !mulmxA oh oo mul0mx add0r mul_scalar_mx scalerA.
- by rewrite mulmxDr -scalemxAr !mulmxA ho hh mul0mx scaler0 addr0 mul_scalar_mx.
- rewrite one' /=; have -> : 1 + (a ^-1) ^+ 2 = (a ^-1) ^+ 2 * (1 + a ^+ 2).
    by rewrite mulrDr mulr1 -exprMn mulVf // expr1n addrC.
  rewrite ltr_pM2r //; rewrite /c; have -> : q = q.-2.+2 by lia.
  rewrite !big_ord_recl /= expr0 mulr1 af' sqrrN.
  rewrite ltrDl ltr_wpDr //; first by apply: sumr_ge0 => j _; apply: sqr_ge0.
  by rewrite lt_neqAle sqr_ge0 eq_sym sqrf_eq0 mulf_eq0 expf_eq0 (negPf a0) oppr_eq0 invr_eq0 (negPf a0).
apply: contraTneq one' => h0; move: hh; rewrite h0 mul0mx => /matrixP/(_ 0 0); rewrite !mxE mulr1n => <-.
by rewrite ltxx.
Qed.

(** On two samples the response to inputs of the window is the one without a fault. *)
Lemma two_samples_response :
  T (with_faults (with_memory S (1%:M : 'M_1)) (row_mx 1%:M (1%:M : 'M_1)) 0) 2 = T (with_faults S (1%:M : 'M_1) 0) 2.
Proof.
apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => -[|[|//]] _.
  by rewrite /output /= !mul0mx.
by rewrite /output /= !mul0mx !add0r mul_mx_row mul_row_col !mulmx0 addr0.
Qed.

Theorem right_regression t W B' D' : let Uf := future t 2 u in (t + 2 <= H)%N -> W *m cov Q Uf Uf = 1%:M ->
  (W *m cov Q Uf (future t 2 y) - T (with_faults S B' D') 2) *m cokermx (O S 2) = 0 <-> B' = 1%:M /\ D' = 0.
Proof.
move=> Uf tH inv; have quiet : W *m cov Q Uf (future t 2 y) = T (with_faults S (1%:M : 'M_1) 0) 2.
  have model2 := memory_process model1 wu.
  have v_leads : leads 0 (fun=> 0 : 'M[K]_1) Q H u (fun=> 0) by apply: no_leads.
  rewrite (future_outputs model2) !cov_add !cov_mul -/Uf two_samples_response.
  have -> : cov Q Uf (row_mx (x t) (w t)) = 0.
    rewrite /Uf cov_future_left big1 // => k _; have kH := ltn_ord k.
    rewrite (cov_state_before model2 u_white v_leads (memory_start start)) ?addn0 ?leq_addr //; last by lia.
    by rewrite big1 ?mulmx0 // => l _; rewrite /= mul0mx times_power0.
  by rewrite cov_future big1 => [|k _]; rewrite ?cov_zero ?mul0mx // addr0 add0r mulmxA inv mul1mx.
have obs : row_free (O S 1).
  apply: inj_row_free => z; rewrite scalar_O samples_places mulmx_sumr => /(congr1 (fun M => M *m (place K 1 (ord0 : 'I_1))^T)).
  by rewrite mul0mx big_ord1 /ov -!mulmxA !place_orthonormal /= expr0 !mulmx1.
rewrite quiet mulmxBl; split=> [/eqP|[-> ->]]; last by rewrite subrr.
by rewrite subr_eq0 => /eqP/(regression_unique (isT : (0 < 2)%N) obs)[-> ->].
Qed.

End Scalar.

(** Such processes are there for every white input. *)
Lemma following_exists (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p))
  (Phi : 'M_(nu, m)) (u : nat -> 'M[K]_(N, nu)) : exists (w : nat -> 'M_(N, nu)) x y,
  [/\ process S B D u (fun k => w k *m Phi) x y, forall k, w k.+1 = u k & forall i, cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0].
Proof.
pose w k := if k is j.+1 then u j else 0.
pose x := fix x k := if k is j.+1 then x j *m sysA S + u j *m B + w j *m Phi *m sysF S else 0.
exists w, x, (fun k => x k *m sysC S + u k *m D + w k *m Phi *m sysG S); split=> // i.
by rewrite !cov_zero.
Qed.

Section Examples.
Variables (K : realFieldType) (a f : K) (N H : nat) (Q : 'M[K]_N) (u : nat -> 'cV[K]_N).
Hypothesis u_white : white Q u H.
Let S : system K 1 1 1 := System a%:M f%:M 1%:M 0.
Let follows w x y := [/\ process S (1%:M : 'M_1) 0 u w x y, forall k, w k.+1 = u k &
  forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0].

Lemma one_follows : exists w x y, follows w x y.
Proof.
have [w [x [y [model wu start]]]] := following_exists Q S (1%:M : 'M_1) 0 1%:M u; exists w, x, y; split=> // k.
by have := model k; rewrite /= [w k *m 1%:M]mulmx1.
Qed.

Theorem follows_biased : 0 < a -> 0 < f -> (exists w x y, follows w x y) /\
  forall w x y t q s L, follows w x y -> (0 < q <= t)%N -> (1 < s)%N -> (t + s <= H)%N ->
    projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> ~ (O S s *m (L^T *m L) <= O S s)%MS.
Proof.
move=> a0 f0; split=> [|w x y t q s L [model wu start]]; first exact: one_follows.
exact: (no_singular_vector model wu u_white start a0 f0).
Qed.

Theorem follows_all_right : a != 0 -> a * f = - (1 + a ^+ 2) -> (exists w x y, follows w x y) /\
  forall w x y t, follows w x y -> (t + 2 <= H)%N ->
    (forall q L, (2 < q <= t)%N -> projected_limit Q (future (t - q) q u) (future t 2 u) (future t 2 y) L ->
      exists (h : 'rV_(2 * 1)) lambda mu, [/\ O S 2 *m (L^T *m L) = lambda *: O S 2, h *m (L^T *m L) = mu *: h,
        O S 2 *m h^T = 0, 0 < mu < lambda & h != 0]) /\
    (forall W B' D', let Uf := future t 2 u in W *m cov Q Uf Uf = 1%:M ->
      (W *m cov Q Uf (future t 2 y) - T (with_faults S B' D') 2) *m cokermx (O S 2) = 0 <-> B' = 1%:M /\ D' = 0).
Proof.
move=> a0 af; split=> [|w x y t [model wu start] tH]; first exact: one_follows.
split=> [q L qt|W B' D' Uf]; first exact: (leading_singular_vector model wu u_white start a0 af qt tH).
exact: (right_regression model wu u_white start B' D' tH).
Qed.

End Examples.
