(** An input that a filter of r states makes of a signal of which it knows nothing beforehand, white noise for one where the filter is
    stable and the mean positive, has a spectrum of order r: from lag 1 on its covariances are responses of the filter, and the
    characteristic polynomial of the filter annihilates them. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix.
From faultspace Require Import Reachable MeansVocabulary Means Forgetting.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Filters.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop).
Hypothesis isE : mean E.

Lemma covariance_sum a b (x : nat -> 'rV[K]_a) k (c : nat -> K) (f : nat -> nat -> 'rV[K]_b) (R : nat -> 'M_(a, b)) :
  (forall i, (i < k)%N -> covariance E x (f i) (R i)) -> covariance E x (fun t => \sum_(i < k) c i *: f i t) (\sum_(i < k) c i *: R i).
Proof.
elim: k => [|k IH] h.
  by move=> i j; rewrite big_ord0 mxE; apply: (mean_ext isE) (mean_zero isE) => t; rewrite big_ord0 [X in _ = _ * X]mxE mulr0.
have := covariance_add isE (IH (fun i ik => h i (ltnW ik))) (covariance_mul isE (c k)%:M (h k (leqnn _))).
rewrite mul_mx_scalar big_ord_recr; apply: (covariance_ext isE) => // t; by rewrite big_ord_recr /= mul_mx_scalar.
Qed.

Lemma monic_relation_rows a n (A : 'M[K]_n) : exists c : nat -> K,
  forall M : 'M_(a, n), iter n (mulmxr A) M = \sum_(k < n) c k *: iter k (mulmxr A) M.
Proof.
have [c rel] := monic_relation A; exists c => M; apply/row_matrixP=> i.
have rows k : row i (iter k (mulmxr A) M) = iter k (mulmxr A) (row i M) by elim: k => //= k <-; rewrite row_mul.
by rewrite rows rel linear_sum; apply: eq_bigr => k _; rewrite linearZ /= rows.
Qed.

Theorem filtered_inputs r nu ne (A : 'M[K]_r) (B : 'M_(ne, r)) (C : 'M_(r, nu)) (D : 'M_(ne, nu)) u e xi :
  (forall t, xi t.+1 = xi t *m A + e t *m B /\ u t = xi t *m C + e t *m D) -> knows_nothing_before E (later 1 e) u ->
  quasi_stationary E (fun t => row_mx (u t) (xi t)) -> order_of_spectrum E r u.
Proof.
move=> model later_e quasi.
have ue l : covariance E u (later l.+1 e) 0.
  have := covariance_transpose isE (later_e l); rewrite trmx0; apply: (covariance_ext isE) => // t.
  by rewrite /later addn1 addnS.
have [R hR] := quasi 1%N; have [G hG] : exists G, covariance E u (later 1 xi) G.
  have := covariance_images isE (col_mx 1%:M 0) (col_mx 0 1%:M) hR => hG; eexists; apply: (covariance_ext isE) hG => t.
    by rewrite mul_row_col mulmx1 mulmx0 addr0.
  by rewrite /later mul_row_col mulmx1 mulmx0 add0r.
have step t : later 1 xi t.+1 = later 1 xi t *m A + later 1 e t *m B by rewrite /later addSn; have [] := model (t + 1)%N.
have powers l : covariance E u (later l.+1 xi) (iter l (mulmxr A) G).
  have zero j : (j < l)%N -> covariance E u (later j (later 1 e)) 0.
    by move=> _; apply: (covariance_ext isE) (ue j) => // t; rewrite /later -addnA addn1.
  by apply: (covariance_ext isE) (free_response isE step zero hG) => // t; rewrite /later -addnA addn1.
have uu l : covariance E u (later l.+1 u) (iter l (mulmxr A) G *m C).
  have := covariance_add isE (covariance_mul isE C (powers l)) (covariance_mul isE D (ue l)); rewrite mul0mx addr0.
  by apply: (covariance_ext isE) => // t; rewrite /later; have [_ ->] := model (t + l.+1)%N.
have [c rel] := monic_relation_rows nu A; pose a : {poly K} := 'X^r - \poly_(k < r) c k.
have small : (size (- \poly_(k < r) c k)%R < size ('X^r : {poly K}))%N by rewrite size_opp size_polyXn ltnS size_poly.
have size_a : size a = r.+1 by rewrite /a size_addl // size_polyXn.
have coef k : a`_k = (if (k < r)%N then - c k else (k == r)%:R).
  by rewrite /a coefB coefXn coef_poly; case: ltnP => kr; rewrite ?subr0 // ltn_eqF // sub0r.
exists a => [|l]; first by split=> //; rewrite monicE /lead_coef size_a coef ltnn eqxx.
have each i : (i < r.+1)%N -> covariance E u (later (l.+1 + i) u) (iter (i + l) (mulmxr A) G *m C).
  by move=> _; rewrite addSn addnC; apply: uu.
have := covariance_sum (f := fun i => later (l.+1 + i) u) (fun i => a`_i) each; congr (covariance _ _ _ _).
rewrite big_ord_recr /= coef ltnn eqxx scale1r iterD rel mulmx_suml -big_split big1 // => i _ /=.
by rewrite coef ltn_ord iterD -scalemxAl scaleNr addNr.
Qed.

End Filters.
