(** Two decreasing chains of subspaces of K^n: W_k, the states reachable at time k with zero output before (silently_reaches), and the
    states from which k zero outputs are possible. Both are row spaces, shrink, stay once they stop, and have stopped at k = n. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Any monotone map of subspaces, iterated on the whole space. *)
Section DecreasingChains.
Variables (K : fieldType) (n : nat) (f : 'M[K]_n -> 'M[K]_n).
Hypothesis f_mono : forall U V : 'M[K]_n, (U <= V)%MS -> (f U <= f V)%MS.
Let W k := iter k f 1%:M.

Lemma iter_decreasing_step k : (W k.+1 <= W k)%MS.
Proof. by elim: k => [|k IH]; [apply: submx1|apply: f_mono]. Qed.

Lemma iter_decreasing j k : (j <= k)%N -> (W k <= W j)%MS.
Proof.
move=> /subnK <-; elim: (k - j)%N => [|d IH]; first exact: submx_refl.
exact: submx_trans (iter_decreasing_step _) IH.
Qed.

Lemma iter_stays k : (W k <= W k.+1)%MS -> forall j, (W k <= W (j + k)%N)%MS.
Proof.
move=> h; elim=> [|j IH]; first exact: submx_refl.
by apply: submx_trans h _; apply: f_mono.
Qed.

(** Each step before the first stop loses a dimension. *)
Lemma iter_stops k : (exists2 j, (j < k)%N & (W j <= W j.+1)%MS) \/ (\rank (W k) + k <= n)%N.
Proof.
elim: k => [|k [[j jk h]|IH]]; first by right; rewrite addn0 rank_leq_row.
  by left; exists j => //; apply: leqW.
have [h|h] := boolP (W k <= W k.+1)%MS; first by left; exists k.
right; rewrite addnS; apply: leq_trans IH; rewrite ltn_add2r; apply: rank_ltmx.
by rewrite /ltmx iter_decreasing_step.
Qed.

Lemma iter_constant k : (n <= k)%N -> (W n <= W k)%MS.
Proof.
move=> nk; have [[j jn h]|] := iter_stops n.+1; last by rewrite addnS ltnNge leq_addl.
apply: submx_trans (iter_decreasing (jn : (j <= n)%N)) _.
by have -> : k = (k - j + j)%N; [rewrite subnK // (leq_trans _ nk)|apply: iter_stays].
Qed.

End DecreasingChains.

Section Chain.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (U V : 'M[K]_n) (x y : 'rV[K]_n) (v : nat -> 'rV[K]_m).

Notation silent_step := (silent_step S).
Notation silent := (silent S).
Notation holds_zero := (holds_zero S).
Notation hold_step := (hold_step S).

Lemma silent_stepP U y : (y <= silent_step U)%MS <->
  exists x (w : 'rV[K]_m), [/\ (x <= U)%MS, x *m sysC S + w *m sysG S = 0 & x *m sysA S + w *m sysF S = y].
Proof.
rewrite genmxE; split=> [/submxP[c]|[x [w [/submxP[a ->] e <-]]]].
  rewrite mulmxA; set z := c *m _ => ->; exists (lsubmx z *m U), (rsubmx z); split; first exact: submxMl.
    by rewrite -mulmxA -mul_row_col hsubmxK -mulmxA mulmx_ker mulmx0.
  by rewrite -mulmxA -mul_row_col hsubmxK.
by rewrite -[a *m U *m _]mulmxA -mul_row_col; apply: submxMr; apply/sub_kermxP; rewrite mul_row_col mulmxA.
Qed.

Lemma silent_step_mono U V : (U <= V)%MS -> (silent_step U <= silent_step V)%MS.
Proof.
move=> UV; apply/row_subP=> i; apply/silent_stepP.
have /silent_stepP[x [w [xU e ey]]] := row_sub i (silent_step U).
by exists x, w; split=> //; apply: submx_trans UV.
Qed.

Lemma silently_reaches_step k y : silently_reaches S k.+1 y <->
  exists x (w : 'rV[K]_m), [/\ silently_reaches S k x, x *m sysC S + w *m sysG S = 0 & x *m sysA S + w *m sysF S = y].
Proof.
split=> [[x [v [h e]]]|[x [w [[x0 [v [h e]]] ew <-]]]].
  exists (state S x v k), (v k); split=> //; last exact: (h k).
  by exists x, v; split=> // j jk; apply/h/leqW.
exists x0, (follow k v (fun=> w)); split=> [j|].
  rewrite ltnS leq_eqVlt => /orP[/eqP->|jk]; last by rewrite output_follow_before ?h.
  by rewrite -[k in output _ _ _ k]addn0 output_follow_after /output /= e.
by rewrite -[k.+1 in LHS]addn1 state_follow_after /= e.
Qed.

Theorem silentP k y : (y <= silent k)%MS <-> silently_reaches S k y.
Proof.
elim: k y => [|k IH] y; first by split=> [_|_]; [exists y, (fun=> 0)|apply: submx1].
rewrite silently_reaches_step [silent _.+1]/= silent_stepP.
by split=> -[x [w [/IH hx e ey]]]; exists x, w.
Qed.

Lemma silent_decreasing j k : (j <= k)%N -> (silent k <= silent j)%MS.
Proof. exact/iter_decreasing/silent_step_mono. Qed.

Lemma silent_constant k : (n <= k)%N -> (silent n <= silent k)%MS.
Proof. exact/iter_constant/silent_step_mono. Qed.

(** The chain W_k, in words. *)
Theorem chain_decreasing j k y : (j <= k)%N -> silently_reaches S k y -> silently_reaches S j y.
Proof. by move=> jk /silentP h; apply/silentP; apply: submx_trans h (silent_decreasing jk). Qed.

Theorem chain_stays k : (forall y, silently_reaches S k y -> silently_reaches S k.+1 y) ->
  forall j y, (k <= j)%N -> silently_reaches S k y <-> silently_reaches S j y.
Proof.
move=> h j y kj; split; last exact: chain_decreasing.
have hk : (silent k <= silent k.+1)%MS by apply/row_subP=> i; apply/silentP/h/silentP; apply: row_sub.
by move/silentP=> hy; apply/silentP; apply: submx_trans hy _; rewrite -(subnK kj); apply: iter_stays hk _ => U V; apply: silent_step_mono.
Qed.

Theorem chain_constant k y : (n <= k)%N -> silently_reaches S n y <-> silently_reaches S k y.
Proof.
move=> nk; split; last exact: chain_decreasing.
by move/silentP=> h; apply/silentP; apply: submx_trans h (silent_constant nk).
Qed.

Lemma hold_stepP U x : (x <= hold_step U)%MS <->
  exists w : 'rV[K]_m, x *m sysC S + w *m sysG S = 0 /\ ((x *m sysA S + w *m sysF S)%R <= U)%MS.
Proof.
rewrite genmxE; set M := block_mx _ _ _ _; split=> [/submxP[c ->]|[w [e h]]].
  exists (c *m rsubmx (kermx M)); rewrite -!mulmxA -!mulmxDr.
  have := mulmx_ker M; rewrite -{1}(hsubmxK (kermx M)) mul_row_block -[0]row_mx0 => /eq_row_mx[e1 e2].
  by rewrite e2 mulmx0; split=> //; rewrite submxE -mulmxA mulmxDl -!mulmxA e1 mulmx0.
have : (row_mx x w <= kermx M)%MS.
  by apply/sub_kermxP; rewrite mul_row_block e (mulmxA x) (mulmxA w) -mulmxDl; move: h; rewrite submxE => /eqP->; rewrite row_mx0.
case/submxP=> c /(congr1 lsubmx); rewrite row_mxKl => ->.
by rewrite -{1}(hsubmxK (kermx M)) mul_mx_row row_mxKl; apply: submxMl.
Qed.

Lemma hold_step_mono U V : (U <= V)%MS -> (hold_step U <= hold_step V)%MS.
Proof.
move=> UV; apply/row_subP=> i; apply/hold_stepP.
have /hold_stepP[w [e h]] := row_sub i (hold_step U).
by exists w; split=> //; apply: submx_trans UV.
Qed.

Lemma holds_zero_step k x : holds_zero k.+1 x <->
  exists w : 'rV[K]_m, x *m sysC S + w *m sysG S = 0 /\ holds_zero k (x *m sysA S + w *m sysF S).
Proof.
split=> [[v h]|[w [e [v h]]]].
  exists (v 0%N); split; first exact: (h 0%N).
  by exists (fun i => v i.+1) => j jk; rewrite -output_step h.
exists (fun j => if j is i.+1 then v i else w) => -[|j] jk; first exact: e.
by rewrite output_step h.
Qed.

Lemma holdP k x : (x <= iter k hold_step 1%:M)%MS <-> holds_zero k x.
Proof.
elim: k x => [|k IH] x; first by split=> [_|_]; [exists (fun=> 0)|apply: submx1].
by rewrite holds_zero_step hold_stepP; split=> -[w [e /IH h]]; exists w.
Qed.

Theorem holds_zero_constant k x : (n <= k)%N -> holds_zero n x -> holds_zero k x.
Proof. by move=> nk /holdP h; apply/holdP; apply: submx_trans h (iter_constant hold_step_mono nk). Qed.

End Chain.
