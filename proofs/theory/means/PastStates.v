(** A stable system forgets, so its state is made of what drove it before: a signal that knows nothing of earlier inputs and faults knows
    nothing of the state. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary MeansVocabulary Means Forgetting LongPast.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Past.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n a b N : nat) (A : 'M[K]_n) (F : 'M[K]_(b, n)) (h : nat -> 'rV[K]_N).
Variables (w : nat -> 'rV[K]_a) (f : nat -> 'rV[K]_b) (d : nat -> 'rV[K]_n).
Hypotheses (isE : mean E) (pos : positive E) (quasi : quasi_stationary E h) (st : stable A).
Hypotheses (cw : combination h w) (cd : combination h d) (step : forall t, d t.+1 = d t *m A + f t *m F).

Theorem past_state : knows_nothing_before E (later 1 w) f -> knows_nothing_before E w d.
Proof.
move=> before l; have [R hR] := combination_covariance isE quasi (combination_later l cw) cd.
suff <- : R = 0 by [].
have [Rw ww] := combination_covariance isE quasi cw cw; have [Rd dd] := combination_covariance isE quasi cd cd.
apply: (forgotten st (bound := \tr Rw + \tr Rd)) => J.
have [C hC] := combination_covariance isE quasi (combination_later (l + J) cw) cd; exists C; last first.
  move=> i j; apply: (covariance_bound isE pos (k := (l + J)%N) (l := 0) i j ww dd).
  by apply: (covariance_ext isE) hC => // t; rewrite /later addn0.
have zero j : (j < J)%N -> covariance E (later (l + J) w) (later j f) 0.
  move=> jJ; have := covariance_later isE j (before (l + J - j.+1)%N); apply: (covariance_ext isE) => // t.
  by rewrite /later; congr w; lia.
apply: (covariance_unique isE _ (free_response isE step zero hC)).
by apply: (covariance_ext isE) (covariance_later isE J hR) => // t; rewrite /later addnA addnAC.
Qed.

End Past.

Section Process.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (pos : positive E) (model : process S B D u v x y) (st : stable (sysA S)).

Let driven t : x t.+1 = x t *m sysA S + row_mx (u t) (v t) *m col_mx B (sysF S).
Proof. by have [-> _] := model t; rewrite mul_row_col addrA. Qed.

Lemma before_row a b c (w : nat -> 'rV[K]_a) (f : nat -> 'rV[K]_b) (g : nat -> 'rV[K]_c) : knows_nothing_before E w f ->
  knows_nothing_before E w g -> knows_nothing_before E w (fun t => row_mx (f t) (g t)).
Proof.
move=> wf wg l i j; case: (split_ordP j) => k ->; rewrite mxE.
  by have := wf l i k; rewrite mxE; apply: (mean_ext isE) => t; rewrite row_mxEl.
by have := wg l i k; rewrite mxE; apply: (mean_ext isE) => t; rewrite row_mxEr.
Qed.

Theorem state_of_past a (w : nat -> 'rV[K]_a) : quasi_stationary E (fun t => row_mx (row_mx (row_mx (u t) (v t)) (x t)) (w t)) ->
  knows_nothing_before E (later 1 w) u -> knows_nothing_before E (later 1 w) v -> knows_nothing_before E w x.
Proof.
move=> quasi wu wv; set h := fun t => _ in quasi; apply: (past_state isE pos quasi st _ _ driven (before_row wu wv)).
  apply: combination_ext (combination_part h (col_mx 0 1%:M)) => t; by rewrite mul_row_col mulmx0 mulmx1 add0r.
apply: combination_ext (combination_part h (col_mx (col_mx 0 1%:M) 0)) => t; by rewrite !mul_row_col !mulmx0 mulmx1 addr0 add0r.
Qed.

Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)).
Let h t := row_mx (row_mx (u t) (v t)) (x t).
Let cu : combination h u.
Proof. by apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !addr0. Qed.
Let cv : combination h v.
Proof.
by apply: combination_ext (combination_part h (col_mx (col_mx 0 1%:M) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
Qed.
Let cx : combination h x.
Proof. by apply: combination_ext (combination_part h (col_mx 0 1%:M)) => t; rewrite !mul_row_col mulmx0 mulmx1 add0r. Qed.

(** The innovations of an input that is uncorrelated with the faults. *)
Theorem innovations_before a Au e : uncorrelated E u v -> autoregressive_input E a Au u e -> knows_nothing_before E (later a e) x.
Proof.
move=> uv [ar _ before].
have ce : combination h (later a e).
  have cs := combination_sum a (f := fun i t => u (t + (a - i.+1))%N *m (if insub i is Some j then Au (j : 'I_a) else 0))
    (fun i => combination_mul _ (combination_later (a - i.+1) cu)).
  apply: combination_ext (combination_add (combination_later a cu) (combination_mul (- 1%:M) cs)) => t.
  rewrite /later ar mulmxN mulmx1 addrAC [X in X + _](_ : _ = 0) ?add0r //; apply/eqP; rewrite subr_eq0; apply/eqP.
  by apply: eq_bigr => i _; rewrite valK.
pose M (i : nat) : 'M[K]_nu := if insub i is Some j then Au (j : 'I_a) else 0.
have eM t : later a e t = u (t + a)%N - \sum_(i < a) 1 *: (u (t + (a - i.+1))%N *m M i).
  rewrite /later ar addrAC [X in X + _](_ : _ = 0) ?add0r //; apply/eqP; rewrite subr_eq0; apply/eqP.
  by apply: eq_bigr => i _; rewrite scale1r /M valK.
have ev : knows_nothing_before E (later 1 (later a e)) v.
  move=> l; have vu k : covariance E v (later k u) 0.
    by have [_ c] := uv k; have := covariance_transpose isE c; rewrite trmx0.
  have each i : (i < a)%N -> covariance E v (fun t => later (l + 1 + (a - i.+1)) u t *m M i) 0.
    by move=> _; rewrite -(mul0mx _ (M i)); apply: covariance_mul.
  have := covariance_zero_sum (f := fun i t => later (l + 1 + (a - i.+1)) u t *m M i) (fun=> 1) isE each.
  move/(covariance_mul isE (- 1%:M))/(covariance_add isE (vu (l + 1 + a)%N)); rewrite mul0mx addr0 => /(covariance_transpose isE).
  rewrite trmx0; apply: (covariance_ext isE) => // t.
  rewrite -[RHS]/(later a e (t + l + 1)%N) eM mulmxN mulmx1 /later !addnA; congr (_ - _).
  by apply: eq_bigr => i _; rewrite !addnA.
apply: (past_state isE pos quasi st ce cx driven); apply: before_row ev => l.
by apply: (covariance_ext isE) (before (l + a)%N) => // t; rewrite /later; congr e; lia.
Qed.

(** Faults that are uncorrelated with themselves more than k samples later; in particular where k = 0. *)
Theorem later_faults k : uncorrelated E u v -> (forall l, covariance E (later (l + k.+1) v) v 0) -> knows_nothing_before E (later k v) x.
Proof.
move=> uv vv; apply: (past_state isE pos quasi st (combination_later k cv) cx driven); apply: before_row => l.
  have [c _] := uv (l + k.+1)%N; have := covariance_transpose isE c; rewrite trmx0; apply: (covariance_ext isE) => // t.
  by rewrite /later; congr v; lia.
by apply: (covariance_ext isE) (vv l) => // t; rewrite /later; congr v; lia.
Qed.

Theorem faults_before : uncorrelated E u v -> knows_nothing_before E (later 1 v) v -> knows_nothing_before E v x.
Proof.
move=> uv vv l; have := later_faults (k := 0) uv _ l; have e j : covariance E (later (j + 1) v) v 0.
  by apply: (covariance_ext isE) (vv j) => // t; rewrite /later addnA.
by move=> /(_ e); apply: (covariance_ext isE) => // t; rewrite /later addn0.
Qed.

End Process.
