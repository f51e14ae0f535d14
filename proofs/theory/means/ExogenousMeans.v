(** Faults that are uncorrelated with the inputs at all lags, A stable: what is left of the state without its inputs is uncorrelated with
    the inputs. So the limit of PI-MOESP has all of the range of O_s where (A, B) is controllable, the spectrum of u has order r, n + r
    past inputs are taken and n + s successive ones excite (LongPast.v); and output error gives the true B and D, and no others where (A,
    C) is observable and n + 1 successive inputs have a regular covariance. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Consistency Leads LimitsVocabulary WholeRange Controllable Regression.
From faultspace Require Import MeansVocabulary Means MeanLimits Forgetting LongPast OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Unseen.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n a b N : nat) (A : 'M[K]_n) (F : 'M[K]_(b, n)) (h : nat -> 'rV[K]_N).
Variables (w : nat -> 'rV[K]_a) (v : nat -> 'rV[K]_b) (d : nat -> 'rV[K]_n).
Hypotheses (isE : mean E) (pos : positive E) (quasi : quasi_stationary E h) (st : stable A) (wv : uncorrelated E w v).
Hypotheses (cw : combination h w) (cd : combination h d) (step : forall t, d t.+1 = d t *m A + v t *m F).

Lemma unseen_state i k : covariance E (later i w) (later k d) 0.
Proof.
have [R hR] := combination_covariance isE quasi (combination_later i cw) (combination_later k cd).
suff -> : 0 = R by []; apply/esym.
have [Rw ww] := combination_covariance isE quasi cw cw; have [Rd dd] := combination_covariance isE quasi cd cd.
apply: (forgotten st (bound := \tr Rw + \tr Rd)) => J.
have [C hC] := combination_covariance isE quasi (combination_later (i + J) cw) (combination_later k cd); exists C; last first.
  by move=> ? ?; apply: (covariance_bound isE pos) ww dd hC.
have step' t : later k d t.+1 = later k d t *m A + later k v t *m F by rewrite /later addSn step.
have zero j : (j < J)%N -> covariance E (later (i + J) w) (later j (later k v)) 0.
  by move=> _; apply: (covariance_ext isE) (uncorrelated_at (i + J) (j + k) isE wv) => // t; rewrite /later addnA.
have e := free_response isE step' zero hC; apply: (covariance_unique isE _ e).
by apply: (covariance_ext isE) (covariance_later isE J hR) => // t; rewrite /later addnA addnAC.
Qed.

End Unseen.

(** What stands side by side with the state that the inputs make of it. *)
Section Parts.
Variables (K : fieldType) (a b n : nat) (u : nat -> 'rV[K]_a) (v : nat -> 'rV[K]_b) (x z : nat -> 'rV[K]_n).
Let h t := row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t)).

Lemma inputs_part : combination h u.
Proof.
apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 !addr0.
Qed.
Lemma states_part : combination h x.
Proof.
apply: combination_ext (combination_part h (col_mx 0 (col_mx 1%:M 0))) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 addr0 add0r.
Qed.
Lemma driven_part : combination h z.
Proof.
apply: combination_ext (combination_part h (col_mx 0 (col_mx 0 1%:M))) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 !add0r.
Qed.
Lemma undriven_part : combination h (fun t => x t - z t).
Proof.
apply: combination_ext (combination_add states_part (combination_mul (- 1%:M) driven_part)) => t.
by rewrite mulmxN mulmx1.
Qed.
Lemma quasi_without_driven (E : (nat -> K) -> K -> Prop) : mean E -> quasi_stationary E h ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)).
Proof.
move=> isE quasi; have c : combination h (fun t => row_mx (row_mx (u t) (v t)) (x t)).
  apply: combination_ext (combination_part h (block_mx 1%:M 0 0 (col_mx 1%:M 0))) => t.
  by rewrite mul_row_block mul_row_col !mulmx0 !mulmx1 !addr0 add0r.
by move=> l; apply: (combination_covariance isE quasi c (combination_later l c)).
Qed.

End Parts.

Section Exogenous.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x z : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (pos : positive E) (model : process S B D u v x y) (st : stable (sysA S)) (uv : uncorrelated E u v).
Hypotheses (driven : forall t, z t.+1 = z t *m sysA S + u t *m B).

Section LongPast.
Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t))).
Let h t := row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t)).

Let cu : combination h u := inputs_part u v x z.
Let cx : combination h x := states_part u v x z.
Let cz : combination h z := driven_part u v x z.
Let cd : combination h (fun t => x t - z t) := undriven_part u v x z.
Let quasi_x := quasi_without_driven isE quasi.

Theorem mean_long_past q s r L : order_of_spectrum E r u -> (n + r <= q)%N -> excites E s u -> excites E (n + s) u ->
  (forall z, steered S B z) -> limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof.
move=> spectrum long [Ru uu unit] exciting all /(mean_containment isE model quasi_x uv)[M [hM ->]].
apply/eqmxP; apply: eqmxMfull; apply: row_full_seen => w Mw.
case: hM => Rzu [Ruu [Rzx [Rux [X [zu uu' zx ux [hX eM]]]]]].
have eR : Ruu = Ru.
  apply: (covariance_unique isE uu'); have := covariance_later isE q uu; by apply: (covariance_ext isE) => t;
    rewrite successive_later addn0.
move: eR hX {uu'} => -> hX; pose c := invmx Ru *m (Rux *m w).
pose d i : 'cV[K]_nu := if insub i is Some i then - (place K nu (i : 'I_s) *m c) else 0.
pose zeta (f : nat -> 'rV[K]_n) t : 'rV_1 := f t *m w + \sum_(i < s) u (t + i)%N *m d i.
have zeta_window f t : later q (zeta f) t = later q f t *m w + successive q s u t *m (- c).
  rewrite /later /zeta /successive future_sum mulmx_suml; congr (_ + _); apply: eq_bigr => i _.
  by rewrite /d valK mulmxN mulmxN mulmxA.
have seen i : (i < q + s)%N -> covariance E (later i u) (later q (zeta x)) 0.
  have window k l : covariance E (successive k l u) (later q (zeta x)) 0 -> forall j, (k <= j < k + l)%N ->
    covariance E (later j u) (later q (zeta x)) 0.
    move=> e j kj; have lt : (j - k < l)%N by lia.
    have := covariance_mul_left isE (place K nu (Ordinal lt))^T e; rewrite mulmx0; apply: (covariance_ext isE) => // t.
    rewrite /successive -sample_of_future /later /=; congr u; lia.
  have e1 : covariance E (successive 0 q u) (later q (zeta x)) 0.
    have := covariance_add isE (covariance_mul isE w zx) (covariance_mul isE (- c) zu).
    rewrite (_ : _ + _ = 0); last first.
      by rewrite mulmxN -hX /c -mulmxA mulKVmx // mulmxA -mulmxBl -eM.
    by apply: (covariance_ext isE) => // t; rewrite zeta_window.
  have e2 : covariance E (successive q s u) (later q (zeta x)) 0.
    have uuq : covariance E (successive q s u) (successive q s u) Ru.
      by apply: (covariance_ext isE) (covariance_later isE q uu) => t; rewrite successive_later addn0.
    have := covariance_add isE (covariance_mul isE w ux) (covariance_mul isE (- c) uuq).
    rewrite (_ : _ + _ = 0); last by rewrite mulmxN /c mulKVmx // subrr.
    by apply: (covariance_ext isE) => // t; rewrite zeta_window.
  by move=> iq; have [iq'|qi] := ltnP i q; [apply: (window _ _ e1)|apply: (window _ _ e2); rewrite qi].
have step t : x t.+1 - z t.+1 = (x t - z t) *m sysA S + v t *m sysF S.
  by have [-> _] := model t; rewrite driven mulmxBl [_ + u t *m B + _]addrAC opprD addrACA subrr addr0 addrAC.
have seen_z i : (i < q + s)%N -> covariance E (later i u) (later q (zeta z)) 0.
  move=> iq; have := covariance_add isE (seen i iq) (covariance_mul isE (- w) (unseen_state isE pos quasi st uv cu cd step i q)).
  rewrite mul0mx addr0; apply: (covariance_ext isE) => // t; rewrite !zeta_window addrAC; congr (_ + _).
  by rewrite /later mulmxN mulmxBl opprB addrC subrK.
have null := zeta_null isE pos quasi cu cz driven st spectrum long seen_z.
have after i : (s <= i)%N -> d i = 0 by move=> si; rewrite /d insubF // ltnNge si.
have zero : steered_space S B n *m w = 0.
  apply: unseen_by_steered => l ln; by have [-> //] := zeta_unreached isE pos quasi cu cz driven null exciting after.
have : row_full (steered_space S B n) by apply/controllable_steered_space.
by case/row_fullP => P PR; rewrite -[w]mul1mx -PR -mulmxA zero mulmx0.
Qed.

End LongPast.

(** Output error with the true A and C: z' is the state of the model with B', as z is that with B. *)
Section OutputError.
Variables (z' : nat -> 'rV[K]_n) (B' : 'M[K]_(nu, n)) (D' : 'M[K]_(nu, p)).
Hypothesis driven' : forall t, z' t.+1 = z' t *m sysA S + u t *m B'.
Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t)))).
Let h t := row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t))).

Let cu : combination h u.
Proof.
apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 !addr0.
Qed.
Let cv : combination h v.
Proof.
apply: combination_ext (combination_part h (col_mx (col_mx 0 1%:M) 0)) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.
Let cx : combination h x.
Proof.
apply: combination_ext (combination_part h (col_mx 0 (col_mx 1%:M 0))) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 addr0 add0r.
Qed.
Let cz : combination h z.
Proof.
apply: combination_ext (combination_part h (col_mx 0 (col_mx 0 (col_mx 1%:M 0)))) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.
Let cz' : combination h z'.
Proof.
apply: combination_ext (combination_part h (col_mx 0 (col_mx 0 (col_mx 0 1%:M)))) => t.
by rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.
Let d t := x t - z t.
Let e t := z t - z' t.
Let cd : combination h d.
Proof. by apply: combination_ext (combination_add cx (combination_mul (- 1%:M) cz)) => t; rewrite mulmxN mulmx1. Qed.
Let ce : combination h e.
Proof. by apply: combination_ext (combination_add cz (combination_mul (- 1%:M) cz')) => t; rewrite mulmxN mulmx1. Qed.
Let step_d t : d t.+1 = d t *m sysA S + v t *m sysF S.
Proof. by rewrite /d; have [-> _] := model t; rewrite driven mulmxBl [_ + u t *m B + _]addrAC opprD addrACA subrr addr0 addrAC. Qed.
Let step_e t : e t.+1 = e t *m sysA S + u t *m (B - B').
Proof. by rewrite /e driven driven' mulmxBl mulmxBr opprD addrACA. Qed.

(** What is left of y by the true model, and by how much the two models differ. *)
Let rest t := y t - (z t *m sysC S + u t *m D).
Let differ t := e t *m sysC S + u t *m (D - D').

Let uncorrelated_parts : covariance E differ rest 0.
Proof.
have ud := unseen_state isE pos quasi st uv cu cd step_d.
have vu : uncorrelated E v u.
  by move=> l; have [h1 h2] := uv l; split; rewrite -trmx0; apply: covariance_transpose.
have ve := unseen_state isE pos quasi st vu cv ce step_e.
have ed0 : covariance E e d 0.
  have [R hR] := combination_covariance isE quasi ce cd.
  have du : uncorrelated E d u.
    move=> l; split; rewrite -trmx0; apply: covariance_transpose => //.
      by apply: (covariance_ext isE) (ud l 0%N) => // t; rewrite /later addn0.
    by apply: (covariance_ext isE) (ud 0%N l) => // t; rewrite /later addn0.
  have de := unseen_state isE pos quasi st du cd ce step_e.
  rewrite -trmx0; apply: covariance_transpose => //.
  by apply: (covariance_ext isE) (de 0%N 0%N) => t; rewrite /later addn0.
have eq t : rest t = d t *m sysC S + v t *m sysG S.
  by rewrite /rest; have [_ ->] := model t; rewrite /d mulmxBl [_ + u t *m D + _]addrAC opprD addrACA subrr addr0 addrAC.
have left c (f : nat -> 'rV[K]_c) : covariance E f d 0 -> covariance E f v 0 -> covariance E f rest 0.
  move=> fd fv; have := covariance_add isE (covariance_mul isE (sysC S) fd) (covariance_mul isE (sysG S) fv).
  by rewrite !mul0mx addr0; apply: (covariance_ext isE) => // t; rewrite eq.
have e_rest : covariance E e rest 0.
  apply: left => //; rewrite -trmx0; apply: covariance_transpose => //.
  by apply: (covariance_ext isE) (ve 0%N 0%N) => t; rewrite /later addn0.
have u_rest : covariance E u rest 0.
  apply: left; first by apply: (covariance_ext isE) (ud 0%N 0%N) => t; rewrite /later addn0.
  by apply: (covariance_ext isE) (uncorrelated_at 0 0 isE uv) => t; rewrite /later addn0.
rewrite -trmx0; apply: covariance_transpose => //; rewrite -[0](addr0).
have := covariance_add isE (covariance_mul isE (sysC S) (covariance_transpose isE e_rest)) (covariance_mul isE (D - D')
  (covariance_transpose isE u_rest)).
by rewrite !trmx0 !mul0mx.
Qed.

Theorem mean_output_error R R' : covariance E rest rest R ->
  covariance E (fun t => y t - (z' t *m sysC S + u t *m D')) (fun t => y t - (z' t *m sysC S + u t *m D')) R' ->
  \tr R <= \tr R' /\ (excites E n.+1 u -> row_free (O S n) -> \tr R' = \tr R -> B' = B /\ D' = D).
Proof.
move=> hR hR'; have cdiff : combination h differ by apply: combination_add; apply: combination_mul.
have [Rd dd] := combination_covariance isE quasi cdiff cdiff.
have eR : R' = R + Rd.
  apply: (covariance_unique isE hR'); have rd := covariance_transpose isE uncorrelated_parts; rewrite trmx0 in rd.
  have l1 := covariance_add isE hR rd; rewrite addr0 in l1.
  have l2 := covariance_add isE uncorrelated_parts dd; rewrite add0r in l2.
  have := covariance_add isE (covariance_transpose isE l1) (covariance_transpose isE l2).
  move/(covariance_transpose isE); rewrite linearD /= !trmxK.
  have eq t : rest t + differ t = y t - (z' t *m sysC S + u t *m D').
    by rewrite /rest /differ /e mulmxBl mulmxBr [X in _ + X]addrACA -opprD addrA subrK.
  by apply: (covariance_ext isE).
have tr0 i : 0 <= Rd i i by apply: square_positive dd.
rewrite eR mxtraceD; split; first by rewrite lerDl; apply: sumr_ge0 => i _; apply: tr0.
move=> exciting obs /eqP; rewrite -subr_eq0 addrC addKr psumr_eq0 // => /allP z0.
have null j : covariance E (fun t => differ t *m (delta_mx j 0 : 'cV_p)) (fun t => differ t *m (delta_mx j 0 : 'cV_p)) 0.
  have := covariance_images isE (delta_mx j 0 : 'cV_p) (delta_mx j 0 : 'cV_p) dd; rewrite (_ : _ *m _ = 0) //.
  apply/matrixP=> k l; rewrite !ord1 trmx_delta -rowE -colE !mxE; apply/eqP; exact: (z0 j (mem_index_enum _)).
pose dj j i : 'cV[K]_nu := if i == 0%N then col j (D - D') else 0.
have seen j : (forall l, (l < n)%N -> iter l (mulmxr (sysA S)) (B - B') *m col j (sysC S) = 0) /\ forall i, dj j i = 0.
  have e0 t : differ t *m (delta_mx j 0 : 'cV_p) = e t *m col j (sysC S) + \sum_(i < 1) u (t + i)%N *m dj j i.
    by rewrite big_ord1 addn0 /dj /= /differ mulmxDl -!mulmxA -!colE.
  have null' : covariance E (fun t => e t *m col j (sysC S) + \sum_(i < 1) u (t + i)%N *m dj j i)
      (fun t => e t *m col j (sysC S) + \sum_(i < 1) u (t + i)%N *m dj j i) 0.
    by apply: (covariance_ext isE) (null j).
  by apply: (zeta_unreached isE pos quasi cu ce step_e null') => [|[]//]; rewrite addn1.
have [|eB eD] := @no_impulse K n m p nu S n (B - B') (D - D') obs.
  case=> [_|l ln]; apply/matrixP=> i j; rewrite [RHS]mxE; have [zB zD] := seen j.
    by have := congr1 (fun M : 'cV_nu => M i 0) (zD 0%N); rewrite /dj /= !mxE.
  have := congr1 (fun M : 'cV_nu => M i 0) (zB l ln); rewrite [X in _ = X -> _]mxE => <- /=.
  by rewrite !mxE; apply: eq_bigr => k _; rewrite [col _ _ _ _]mxE.
by split; apply/esym/eqP; rewrite -subr_eq0; apply/eqP.
Qed.

End OutputError.
End Exogenous.
