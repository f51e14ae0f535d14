(** Signals that satisfy what the theorems on autoregressive inputs ask: u of order 1 with covariances rho^|i-k|, and the stationary
    state of x(k+1) = alpha x(k) + u(k), which is rho / (1 - alpha rho) u(0) at time 0 as far as the inputs tell. And what the theorem on
    one state asks: the coloured input u(k) = e(k) + e(k-1)/2 and z(k+1) = z(k)/2 + u(k). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum ssrint
  rat matrix mxalgebra zify.
From faultspace Require Import Vocabulary Places Signals Consistency ConsistencyExamples LimitsVocabulary WholeRange.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section FirstOrder.
Variables (K : fieldType) (alpha rho : K) (H : nat).
Hypotheses (regular : rho ^+ 2 != 1) (pole : alpha * rho != 1).
Let r i k := rho ^+ ((i - k) + (k - i)).
Let Q : 'M[K]_H := \matrix_(i, k) r i k.
Let u k : 'cV[K]_H := \col_i (i == k :> nat)%:R.
Let e k := u k - rho *: u k.-1.
Let x := fix x k : 'cV[K]_H := if k is j.+1 then alpha *: x j + u j else (rho / (1 - alpha * rho)) *: u 0%N.

Lemma Q_symmetric : Q^T = Q.
Proof. by apply/matrixP=> i k; rewrite !mxE /r addnC. Qed.

Lemma cov_inputs i k : (i < H)%N -> (k < H)%N -> cov Q (u i) (u k) = (r i k)%:M.
Proof.
move=> iH kH; have pick (j : 'I_H) (w : 'cV_H) : (u j)^T *m w = (w j 0)%:M.
  apply/matrixP=> a b; rewrite !ord1 mxE (bigD1 j) //= !mxE eqxx mul1r big1 ?addr0 // => l ne.
  by rewrite !mxE -[l == j :> nat]/(l == j) (negPf ne) mul0r.
rewrite /cov -mulmxA (pick (Ordinal iH)); congr (_%:M); rewrite mxE (bigD1 (Ordinal kH)) //= !mxE eqxx mulr1 big1 ?addr0 // => l ne.
by rewrite !mxE -[l == k :> nat]/(l == Ordinal kH) (negPf ne) mulr0.
Qed.

Lemma cov_scale_left a (f : 'cV[K]_H) (g : 'M_(H, a)) c : cov Q (c *: f) g = c *: cov Q f g.
Proof. by rewrite /cov linearZ -!scalemxAl. Qed.

Lemma cov_scale_right a (f : 'M_(H, a)) (g : 'cV[K]_H) c : cov Q f (c *: g) = c *: cov Q f g.
Proof. by rewrite /cov -scalemxAr. Qed.

Lemma innovation_past i k : (i < k < H)%N -> cov Q (e k) (u i) = 0.
Proof.
case/andP=> ik kH; have iH := ltn_trans ik kH; rewrite cov_sub_left cov_scale_left !cov_inputs //; last lia.
case: k ik kH => // k ik kH; rewrite scale_scalar_mx /r -exprS -!raddfB /=; apply/eqP; rewrite raddfB /= subr_eq0.
by apply/eqP; congr (_ ^+ _)%:M; lia.
Qed.

Lemma innovation_now k : (0 < k < H)%N -> cov Q (e k) (u k) = (1 - rho ^+ 2)%:M.
Proof.
case/andP=> k0 kH; rewrite cov_sub_left cov_scale_left !cov_inputs //; last lia.
rewrite scale_scalar_mx /r -exprS -raddfB /=; congr (_ - _)%:M; first by rewrite subnn.
by congr (_ ^+ _); lia.
Qed.

Lemma first_order : autoregressive Q 1 (fun=> rho%:M) u e H.
Proof.
move=> k /andP[k0 kH]; split=> [||i ik].
- by rewrite big_ord1 mul_mx_scalar subn1 addrC subrK.
- have -> : cov Q (e k) (e k) = cov Q (e k) (u k).
    rewrite [X in cov Q _ X]/e cov_sub cov_scale_right [cov Q (e k) (u k.-1)]innovation_past ?scaler0 ?subr0 //; lia.
  by rewrite innovation_now ?k0 // unitmxE det_scalar1 unitfE subr_eq0 eq_sym.
by rewrite innovation_past ?ik.
Qed.

Lemma cov_first_state i : (i < H)%N -> cov Q (u i) (x 0%N) = (rho / (1 - alpha * rho) * rho ^+ i)%:M.
Proof. by move=> iH; rewrite cov_scale_right cov_inputs ?scale_scalar_mx ?(leq_trans _ iH) // /r subn0 sub0n addn0. Qed.

Lemma inputs_stationary : stationary Q u u H.
Proof. by move=> i k iH kH; rewrite !cov_inputs ?(ltnW iH) ?(ltnW kH) // /r !subSS. Qed.

Lemma state_stationary : stationary Q u x H.
Proof.
have beta : rho / (1 - alpha * rho) = (alpha * (rho / (1 - alpha * rho)) + 1) * rho.
  have pole' : 1 - alpha * rho != 0 by rewrite subr_eq0 eq_sym.
  have := divfK pole' rho; set beta := rho / _ => h; rewrite mulrDl mul1r -{2}h mulrBr mulr1 [alpha * _]mulrC -mulrA.
  by rewrite addrCA subrr addr0.
move=> i k iH kH; elim: k kH => [|k IH] kH.
  rewrite cov_first_state; last exact: ltnW.
  rewrite [x 1]/(alpha *: x 0%N + u 0%N) cov_add cov_scale_right cov_first_state // cov_inputs //; last exact: leq_trans kH.
  rewrite scale_scalar_mx -raddfD; congr (_%:M); rewrite /r subn0 sub0n addn0.
  by rewrite mulrA -{2}[rho ^+ i.+1]mul1r -mulrDl exprS mulrA -beta.
rewrite [x k.+2]/(alpha *: x k.+1 + u k.+1) [x k.+1 in RHS]/(alpha *: x k + u k) !cov_add !cov_scale_right IH ?inputs_stationary //.
  exact: ltnW.
exact: ltnW.
Qed.

Lemma inputs_excite t s : (t + s <= H)%N -> cov Q (future t s u) (future t s u) \in unitmx.
Proof.
move=> tH; rewrite -row_full_unit; apply: row_full_seen => c; rewrite -cov_mul => seen.
have inputs := cov_future_zero seen.
have expand a (f : 'M_(H, a)) : cov Q f (future t s u *m c) = \sum_(j < s) cov Q f (u (t + j)%N) *m (place K 1 j *m c).
  by rewrite cov_mul cov_future mulmx_suml; apply: eq_bigr => j _; rewrite mulmxA.
have down d : forall j : 'I_s, (s <= j + d)%N -> place K 1 j *m c = 0.
  elim: d => [|d IH] j jd; first by have := ltn_ord j; lia.
  have js := ltn_ord j; have tjH : (t + j < H)%N by lia.
  have [j0|j0] := posnP j.
    have := expand 1%N (u (t + j)%N); rewrite inputs ?leq_addr ?ltn_add2l // (bigD1 j) //= big1 => [|l ne].
      by rewrite addr0 cov_inputs // /r subnn mul1mx.
    by rewrite IH ?mulmx0 //; move: ne; rewrite -val_eqE /=; lia.
  have := expand 1%N (e (t + j)%N); rewrite cov_sub_left cov_scale_left !inputs; [|lia|lia].
  rewrite scaler0 subr0 (bigD1 j) //= big1 => [|l ne].
    rewrite addr0 innovation_now; last lia.
    by rewrite mul_scalar_mx => /esym/eqP; rewrite scaler_eq0 subr_eq0 eq_sym (negPf regular) => /eqP.
  have [lj|jl] := ltnP l j; first by rewrite innovation_past ?mul0mx // ltn_add2l lj tjH.
  by rewrite IH ?mulmx0 //; move: ne; rewrite -val_eqE /=; lia.
by rewrite -[c]mul1mx -sum_places mulmx_suml big1 // => j _; rewrite -mulmxA (down s) ?mulmx0 ?leq_addl.
Qed.

Theorem first_order_signals : let S : system K 1 0 1 := System alpha%:M 0 1%:M 0 in exists (Q' : 'M_H) (u' e' x' y' : nat -> 'cV_H),
  [/\ Q'^T = Q', process S (1%:M : 'M_1) 0 u' (fun=> 0) x' y',
      autoregressive Q' 1 (fun=> rho%:M) u' e' H /\ (forall k, (1 <= k < H)%N -> cov Q' (e' k) (x' 0%N) = 0),
      stationary Q' u' u' H /\ stationary Q' u' x' H
    & forall t s, (t + s <= H)%N -> cov Q' (future t s u') (future t s u') \in unitmx].
Proof.
exists Q, u, e, x, x; split; [exact: Q_symmetric| | |by split; [exact: inputs_stationary|exact: state_stationary]|exact: inputs_excite].
  by move=> k; rewrite /= !mul0mx !mulmx0 !addr0 !mulmx1 mul_mx_scalar.
split=> [|k /andP[k0 kH]]; first exact: first_order.
by rewrite cov_scale_right innovation_past ?scaler0 // k0.
Qed.

End FirstOrder.

Section MovingAverage.
Import Vocabulary.MovingAverage ConsistencyExamples.MovingAverage.
Let zs := fix zs k : seq rat := if k is j.+1 then mkseq (fun i => nth 0 (zs j) i * half + nth 0 (nth [::] us j) i) 7 else [:: 1; 1].
Let z k := signals 1 [:: zs k].

Lemma moving_average_driven k : z k.+1 = z k *m half%:M + u k *m 1%:M.
Proof. by rewrite mulmx1; apply/matrixP=> i j; rewrite !ord1 mul_mx_scalar !mxE /= nth_mkseq // [half * _]mulrC. Qed.

Lemma moving_average_positive (g : 'cV_7) : 0 <= cov Q g g 0 0.
Proof.
rewrite /cov mul_mx_diag mxE sumr_ge0 // => i _; rewrite !mxE mulrAC -expr2 mulr_ge0 ?sqr_ge0 //.
by case: i => [[|[|[|[|[|[|[|//]]]]]]] i7]; vm_compute.
Qed.

Lemma moving_average_stationary : [/\ stationary Q u u 3, stationary Q u z 3 & stationary Q z z 3].
Proof.
split=> i k i3 k3; apply/matrixP=> c d; rewrite !ord1 !cov_entry; apply/eqP.
all: by move: i i3 k k3 => [|[|//]] _ [|[|//]] _; vm_compute.
Qed.

Lemma moving_average_excites : cov Q (future 1 2 u) (future 1 2 u) \in unitmx.
Proof.
have e : future 1 2 u *m pick^T = signals 2 [:: nth [::] us 1; nth [::] us 2] by apply: pick_future.
have := cov_pick (future 1 2 u) (future 1 2 u); rewrite e cov_signals.
move: (cov Q _ _) => M; set W := square _ _ _ _ => eW.
have number (a b : rat) : a == b -> a = b by move/eqP.
pose V := square (20%:R / 21%:R) (- (8%:R / 21%:R)) (- (8%:R / 21%:R)) (20%:R / 21%:R : rat).
have VW : V *m W = 1%:M by rewrite square_mul square_one; congr square; apply: number; vm_compute.
rewrite -row_full_unit; apply: row_full_seen => c Mc; have picked : pick *m c = 0.
  rewrite -[pick *m c]mul1mx -VW -eW -!mulmxA (mulmxA pick^T) pickK mul1mx Mc !mulmx0 //.
by rewrite -[c]mul1mx -pickK -mulmxA picked mulmx0.
Qed.

Theorem moving_average_signals : let S : system (field_of rat) 1 0 1 := System half%:M 0 1%:M 0 in
  exists (u' z' : nat -> 'cV[rat]_7), [/\ Q^T = Q /\ (forall g : 'cV_7, 0 <= cov Q g g 0 0),
    process S (1%:M : 'M_1) 0 u' (fun=> 0) z' z' /\ (forall k, z' k.+1 = z' k *m sysA S + u' k *m 1%:M),
    [/\ stationary Q u' u' 3, stationary Q u' z' 3 & stationary Q z' z' 3], cov Q (future 1 2 u') (future 1 2 u') \in unitmx
  & cov Q (u' 0%N) (u' 1%N) != 0].
Proof.
exists u, z; split; [split; last exact: moving_average_positive| |exact: moving_average_stationary|exact: moving_average_excites|].
- by rewrite /Q /variances tr_diag_mx.
- split=> k; last exact: moving_average_driven.
  by rewrite moving_average_driven /= !mulmx0 !addr0 !mulmx1.
by apply/eqP => /matrixP/(_ 0 0); rewrite cov_entry mxE => /eqP; vm_compute.
Qed.

End MovingAverage.
