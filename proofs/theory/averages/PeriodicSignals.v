(** Signals of period 3 that meet every hypothesis of the theorems on inputs of a given order of the spectrum and on output error: the input
    2, -1, -1, 2, -1, -1, ... of order 2, a fault that is 1 for ever, and a state that is the input and the fault of a sample before. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop order zmodp ssralg finalg poly
  ssrnum matrix mxalgebra zify.
From faultspace Require Import Vocabulary Places Consistency LimitsVocabulary WholeRange MeansVocabulary Means PeriodicMeans.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Signals.
Variable K : realFieldType.
Let E := @period_average K.
Let isE : mean E := period_average_mean K.

(** Where no combination of s successive samples is zero at all times, they have a regular covariance. *)
Lemma periodic_excites nu s (u : nat -> 'rV[K]_nu) d : (0 < d)%N -> (forall t, u (t + d)%N = u t) ->
  (forall w : 'cV_(s * nu), (forall t, successive 0 s u t *m w = 0) -> w = 0) -> excites E s u.
Proof.
move=> d0 per free; pose U := successive 0 s u.
have perU t : U (t + d)%N = U t.
  by rewrite /U /successive !future_sum; apply: eq_bigr => i _; rewrite !addn0 addnAC per.
have [R hR] := periodic_quasi d0 perU 0%N; have {}hR : covariance E U U R.
  by apply: (covariance_ext isE) hR => // t; rewrite /later addn0.
exists R => //; rewrite -row_full_unit; apply: row_full_seen => w Rw; apply: free => t.
have /(_ 0 0) := covariance_images isE w w hR; rewrite -mulmxA Rw mulmx0 mxE => -[c c0 [perc sum]].
have zero k : (k < c)%N -> (U k *m w) 0 0 = 0.
  move=> kc; move/eqP: sum; rewrite mulr0 psumr_eq0 => [/allP/(_ (Ordinal kc) (mem_index_enum _))|i _]; last by rewrite -expr2 sqr_ge0.
  by rewrite /= mulf_eq0 orbb => /eqP.
apply/matrixP=> i j; rewrite !ord1 [RHS]mxE; apply/eqP; rewrite -sqrf_eq0 expr2; apply/eqP.
have := divn_eq t c; set q := (t %/ c)%N; set r := (t %% c)%N => ->; rewrite addnC.
have := period_many q perc r => ->.
by rewrite zero ?mulr0 // /r ltn_mod.
Qed.

Let u t : 'rV[K]_1 := (nth 0 [:: 2%:R; -1; -1] (t %% 3))%:M.
Let v (_ : nat) : 'rV[K]_1 := 1%:M.

Lemma input_period t : u (t + 3)%N = u t. Proof. by rewrite /u modnDr. Qed.

Lemma input_sum t : u t + u t.+1 + u t.+2 = 0.
Proof.
rewrite /u -[t.+2]addn2 -[t.+1]addn1 -(modnDml t 1) -(modnDml t 2); have : (t %% 3 < 3)%N by rewrite ltn_mod.
move: (t %% 3)%N => [|[|[|//]]] _; apply/matrixP => i j; rewrite !ord1 !mxE /= !mulr1n -[1 *+ 2]/(1 + 1).
- by rewrite addrK subrr.
- by rewrite addrACA !addNr addr0.
by rewrite addKr subrr.
Qed.

Lemma input_places s t (w : 'cV[K]_(s * 1)) : successive 0 s u t *m w = \sum_(i < s) u (t + i)%N *m (place K 1 i *m w).
Proof. by rewrite /successive addn0 future_sum mulmx_suml; apply: eq_bigr => i _; rewrite mulmxA. Qed.

Lemma input_free s (w : 'cV[K]_(s * 1)) : (0 < s)%N -> (s <= 2)%N -> (forall t, successive 0 s u t *m w = 0) -> w = 0.
Proof.
move=> s0 s2 h; suff zero i : place K 1 i *m w = 0.
  rewrite -[w]mul1mx -(sum_places K 1 s) mulmx_suml big1 // => i _.
  by rewrite -mulmxA zero mulmx0.
have three : (3%:R : K) != 0 by rewrite pnatr_eq0.
have scalar (c : K) (M : 'cV[K]_1) : (c%:M : 'rV_1) *m M = c *: M by rewrite mul_scalar_mx.
have two : (2%:R : K) != 0 by rewrite pnatr_eq0.
case: s s0 s2 w h i => [//|[|[|//]]] _ _ w h i.
  have := h 0%N; rewrite input_places big_ord1 /u /= scalar => /eqP; rewrite scaler_eq0 (negbTE two) /= => /eqP e.
  by rewrite ord1 -[RHS]e; congr (place K 1 _ *m w); apply: val_inj.
have := h 0%N; have := h 1%N; rewrite !input_places !big_ord_recl !big_ord0 /u /= !scalar !addr0 !scaleN1r.
set p := place K 1 ord0 *m w; set q := place K 1 _ *m w => e1 e0.
have p0 : p = 0.
  have /eqP := e0; move/eqP: e1; rewrite addr_eq0 opprK => /eqP; rewrite -[- p = q]/(- p = q) => <-.
  by rewrite opprK -{2}[p]scale1r -scalerDl -[2%:R + 1]/(2%:R + 1%:R) -natrD scaler_eq0 (negbTE three) => /eqP.
have q0 : q = 0 by move: e1; rewrite p0 oppr0 add0r => /eqP; rewrite oppr_eq0 => /eqP.
by case: i => -[|[|//]] lt; [rewrite -[RHS]p0|rewrite -[RHS]q0]; congr (place K 1 _ *m w); apply: val_inj.
Qed.

Theorem periodic_signals : let S : system K 1 1 1 := System 0 1%:M 1%:M 0 in exists u v x z y : nat -> 'rV[K]_1,
  [/\ process S (1%:M : 'M_1) 0 u v x y /\ (forall t, z t.+1 = z t *m sysA S + u t *m 1%:M), uncorrelated E u v,
    stable (sysA S) /\ (forall x0, steered S (1%:M : 'M_1) x0),
    [/\ order_of_spectrum E 2 u, excites E 1 u & excites E 2 u]
  & forall B' : 'M_1, exists2 z', (forall t, z' t.+1 = z' t *m sysA S + u t *m B') &
      quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (row_mx (z t) (z' t)))) /\
      quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (row_mx (x t) (z t)))].
Proof.
move=> S; pose z t := u (t + 2)%N; exists u, v, (fun t => z t + v t), z, (fun t => z t + v t).
have zS t : z t.+1 = u t by rewrite /z addSnnS input_period.
have v1 t : v t 0 0 = 1 by rewrite /v mxE.
have mean_u : E (fun t => u t 0 0) 0.
  exists 3%N => //; split=> [t|]; first by rewrite input_period.
  rewrite mulr0 !big_ord_recr big_ord0 /= add0r; have := congr1 (fun M : 'rV[K]_1 => M 0 0) (input_sum 0).
  by rewrite [X in _ = X -> _]mxE => <-; rewrite [RHS]mxE [X in _ = X + _]mxE.
split.
- split=> [t|t]; last by rewrite mulmx0 add0r mulmx1 zS.
  by split; rewrite /= ?mulmx0 ?add0r !mulmx1 ?mulmx0 ?addr0 ?zS.
- have z0 i j : (0 : 'M[K]_1) i j = 0 by rewrite mxE.
  move=> l; split=> i j; rewrite z0.
    by apply: (mean_ext isE) mean_u => t; rewrite /later !ord1 v1 mulr1.
  by apply: (mean_ext isE) (mean_later isE l mean_u) => t; rewrite /later !ord1 v1 mulr1.
- split=> [eps eps0|x0]; first by exists 1%N => i j; rewrite /= mulmx0 mxE normr0.
  by exists 1%N, (fun=> x0); rewrite /= mulmx0 add0r mulmx1.
- split.
  + exists (\poly_(i < 3) 1) => [|l i j].
      have size3 : size (\poly_(i < 3) (1 : K)) = 3%N by apply: size_poly_eq; rewrite oner_eq0.
      by split=> //; rewrite monicE lead_coefE size3 coef_poly.
    rewrite mxE; apply: (mean_ext isE) (mean_zero isE) => t; pose c := (t + l.+1)%N.
    rewrite !big_ord_recr big_ord0 /= !coef_poly /= !scale1r add0r.
    have -> : later (l.+1 + 0) u t + later (l.+1 + 1) u t + later (l.+1 + 2) u t = u c + u c.+1 + u c.+2.
      by rewrite /later; congr (u _ + u _ + u _); rewrite /c; lia.
    by rewrite input_sum [X in _ = _ * X]mxE mulr0.
  + by apply: (periodic_excites (d := 3)) => // [|w]; [exact: input_period|exact: input_free].
  + by apply: (periodic_excites (d := 3)) => // [|w]; [exact: input_period|exact: input_free].
move=> B'; exists (fun t => z t *m B') => [t|]; first by rewrite mulmx0 add0r zS.
have perz t : z (t + 3)%N = z t by rewrite /z addnAC input_period.
by split; apply: (periodic_quasi (d := 3)) => // t; rewrite perz input_period.
Qed.

End Signals.
