(** The calculus of means, and how the theorems about finitely many random variables become theorems about means. The samples of the signals
    over finitely many times are combinations of finitely many sequences: the state, and each input and fault at each of these times. The
    covariances of those, as means, are a matrix Q; in the terms of Signals.v they are the basic random variables. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix.
From faultspace Require Import Vocabulary Consistency LimitsVocabulary WholeRange MeansVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Calculus.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop).
Hypothesis isE : mean E.

Lemma mean_unique f a b : E f a -> E f b -> a = b. Proof. by case: isE => h _ _ _ _; apply: h. Qed.
Lemma mean_ext f g a : f =1 g -> E f a -> E g a. Proof. by case: isE => _ h _ _ _; apply: h. Qed.
Lemma mean_zero : E (fun=> 0) 0. Proof. by case: isE. Qed.
Lemma mean_linear f g a b c : E f a -> E g b -> E (fun t => c * f t + g t) (c * a + b).
Proof. by case: isE => _ _ _ h _; apply: h. Qed.
Lemma mean_add f g a b : E f a -> E g b -> E (fun t => f t + g t) (a + b).
Proof. by move=> ef eg; have := mean_linear 1 ef eg; rewrite mul1r; apply: mean_ext => t; rewrite mul1r. Qed.
Lemma mean_scale f a c : E f a -> E (fun t => c * f t) (c * a).
Proof. by move=> ef; have := mean_linear c ef mean_zero; rewrite addr0; apply: mean_ext => t; rewrite addr0. Qed.
Lemma mean_sum (I : Type) (r : seq I) (P : pred I) (f : I -> nat -> K) (a : I -> K) : (forall i, P i -> E (f i) (a i)) ->
  E (fun t => \sum_(i <- r | P i) f i t) (\sum_(i <- r | P i) a i).
Proof.
move=> h; elim: r => [|i r IH]; first by rewrite big_nil; apply: mean_ext mean_zero => t; rewrite big_nil.
rewrite big_cons; case Pi: (P i); last by apply: mean_ext IH => t; rewrite big_cons Pi.
by apply: mean_ext (mean_add (h i Pi) IH) => t; rewrite big_cons Pi.
Qed.
Lemma mean_later f a d : E f a -> E (fun t => f (t + d)%N) a.
Proof.
move=> ef; elim: d => [|d IH]; first by apply: mean_ext ef => t; rewrite addn0.
have := let: And5 _ _ _ _ h := isE in h _ _ IH; by apply: mean_ext => t; rewrite addSnnS.
Qed.

Section Covariances.
Variables (a b : nat) (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b).

Lemma covariance_unique R R' : covariance E x y R -> covariance E x y R' -> R = R'.
Proof. by move=> h h'; apply/matrixP=> i j; apply: mean_unique (h i j) (h' i j). Qed.

Lemma covariance_ext x' y' R : x =1 x' -> y =1 y' -> covariance E x y R -> covariance E x' y' R.
Proof. by move=> ex ey h i j; apply: mean_ext (h i j) => t; rewrite ex ey. Qed.

Lemma covariance_later d R : covariance E x y R -> covariance E (later d x) (later d y) R.
Proof. by move=> h i j; exact: (mean_later d (h i j)). Qed.

Lemma covariance_transpose R : covariance E x y R -> covariance E y x R^T.
Proof. by move=> h i j; rewrite mxE; apply: mean_ext (h j i) => t; rewrite mulrC. Qed.

Lemma covariance_images c d (M : 'M_(a, c)) (M' : 'M_(b, d)) R : covariance E x y R ->
  covariance E (fun t => x t *m M) (fun t => y t *m M') (M^T *m R *m M').
Proof.
move=> h i j; have e := mean_sum (index_enum _) (fun l _ => mean_scale (M' l j) (mean_sum (index_enum _) (fun k _ => mean_scale (M k i) (h
  k l)))).
have -> : (M^T *m R *m M') i j = \sum_l M' l j * \sum_k M k i * R k l.
  by rewrite mxE; apply: eq_bigr => l _; rewrite [LHS]mulrC mxE; congr (_ * _); apply: eq_bigr => k _; rewrite mxE.
apply: mean_ext (e _ _) => t; rewrite !mxE mulr_sumr; apply: eq_bigr => l _.
rewrite [RHS]mulrA [RHS]mulrC; congr (_ * _); rewrite mulr_suml; apply: eq_bigr => k _; by rewrite mulrCA mulrA.
Qed.

End Covariances.

Lemma covariance_add a b (x : nat -> 'rV[K]_a) (y z : nat -> 'rV[K]_b) R R' : covariance E x y R -> covariance E x z R' ->
  covariance E x (fun t => y t + z t) (R + R').
Proof. by move=> h h' i j; rewrite mxE; apply: mean_ext (mean_add (h i j) (h' i j)) => t; rewrite mxE mulrDr. Qed.

Lemma covariance_mul a b c (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) (M : 'M_(b, c)) R : covariance E x y R ->
  covariance E x (fun t => y t *m M) (R *m M).
Proof.
move=> h; have := covariance_images 1%:M M h; rewrite trmx1 mul1mx; apply: covariance_ext => // t; exact: mulmx1.
Qed.

Lemma covariance_mul_left a b c (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) (M : 'M_(a, c)) R : covariance E x y R ->
  covariance E (fun t => x t *m M) y (M^T *m R).
Proof.
move=> h; have := covariance_images M 1%:M h; rewrite mulmx1; apply: covariance_ext => // t; exact: mulmx1.
Qed.

(** The limit does not depend on when it is taken. *)
Lemma limit_later d z f g (Z : nat -> 'rV[K]_z) (Uf : nat -> 'rV[K]_f) (Yf : nat -> 'rV[K]_g) L :
  limit E Z Uf Yf L -> limit E (later d Z) (later d Uf) (later d Yf) L.
Proof. by case=> Rzu [Ruu [Rzy [Ruy [X [zu uu zy uy hL]]]]]; exists Rzu, Ruu, Rzy, Ruy, X; split=> //; apply: covariance_later. Qed.

Lemma limit_ext z f g (Z Z' : nat -> 'rV[K]_z) (Uf Uf' : nat -> 'rV[K]_f) (Yf Yf' : nat -> 'rV[K]_g) L :
  Z =1 Z' -> Uf =1 Uf' -> Yf =1 Yf' -> limit E Z Uf Yf L -> limit E Z' Uf' Yf' L.
Proof.
move=> eZ eU eY [Rzu [Ruu [Rzy [Ruy [X [zu uu zy uy hL]]]]]]; exists Rzu, Ruu, Rzy, Ruy, X.
by split=> //; [exact: covariance_ext zu|exact: covariance_ext uu|exact: covariance_ext zy|exact: covariance_ext uy].
Qed.

Lemma successive_later p d k s (r : nat -> 'rV[K]_p) : later d (successive k s r) =1 successive (d + k) s r.
Proof. by move=> t; rewrite /later /successive addnA. Qed.

(** Matrices that say how signals are made of g: means of products are covariances in the sense of Signals.v. *)
Section Images.
Variables (d : nat) (g : nat -> 'rV[K]_d) (Q : 'M[K]_d).
Hypothesis gQ : covariance E g g Q.

Lemma image_covariance a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) X Y : (forall t, x t = g t *m X) -> (forall t, y t = g t *m Y) ->
  covariance E x y (cov Q X Y).
Proof. by move=> hx hy; apply: covariance_ext (covariance_images X Y gQ) => t; rewrite ?hx ?hy. Qed.

Lemma image_cov a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) X Y R : (forall t, x t = g t *m X) -> (forall t, y t = g t *m Y) ->
  covariance E x y R -> cov Q X Y = R.
Proof. by move=> hx hy; apply: covariance_unique; apply: image_covariance. Qed.

Lemma image_window p k s (r : nat -> 'rV[K]_p) Y : (forall j t, (k <= j < k + s)%N -> r (t + j)%N = g t *m Y j) ->
  forall t, successive k s r t = g t *m future k s Y.
Proof.
move=> h t; rewrite /successive !future_sum mulmx_sumr; apply: eq_bigr => j _.
by rewrite -addnA h ?mulmxA // leq_addr ltn_add2l ltn_ord.
Qed.

Lemma image_limit z f h (Z : nat -> 'rV[K]_z) (Uf : nat -> 'rV[K]_f) (Yf : nat -> 'rV[K]_h) MZ MU MY L :
  (forall t, Z t = g t *m MZ) -> (forall t, Uf t = g t *m MU) -> (forall t, Yf t = g t *m MY) ->
  limit E Z Uf Yf L <-> projected_limit Q MZ MU MY L.
Proof.
move=> hZ hU hY; split=> [[Rzu [Ruu [Rzy [Ruy [X [zu uu zy uy [hX ->]]]]]]]|[X [hX ->]]].
  by exists X; rewrite (image_cov hZ hU zu) (image_cov hU hU uu) (image_cov hZ hY zy) (image_cov hU hY uy).
by do 4!eexists; exists X; split; [exact: (image_covariance hZ hU)|exact: (image_covariance hU hU)|exact: (image_covariance hZ hY)|
  exact: (image_covariance hU hY)|].
Qed.

End Images.

(** The basic variables of a stretch of H samples. *)
Section Lift.
Variables (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypothesis model : process S B D u v x y.
Let h t := row_mx (row_mx (u t) (v t)) (x t).
Hypothesis quasi : quasi_stationary E h.
Variable H : nat.
Let N := (n + (H * nu + H * m))%N.
Let g t : 'rV[K]_N := row_mx (x t) (row_mx (future t H u) (future t H v)).

Let entry (i : 'I_N) : exists k j, forall t, g t 0 i = h (t + k)%N 0 j.
Proof.
case: (split_ordP i) => [j ->|{}i ->].
  by exists 0%N, (rshift _ j) => t; rewrite /g /h row_mxEl row_mxEr addn0.
case: (split_ordP i) => [j ->|j ->].
  by case/mxvec_indexP: j => k j; exists k, (lshift _ (lshift _ j)) => t; rewrite /g /h row_mxEr !row_mxEl !mxE mxvecE !mxE.
by case/mxvec_indexP: j => k j; exists k, (lshift _ (rshift _ j)) => t; rewrite /g /h !row_mxEr row_mxEl row_mxEr !mxE mxvecE !mxE.
Qed.

Let product k l i j : exists r, E (fun t => h (t + k)%N 0 i * h (t + l)%N 0 j) r.
Proof.
have one k' l' i' j' : (k' <= l')%N -> exists r, E (fun t => h (t + k')%N 0 i' * h (t + l')%N 0 j') r.
  move=> kl; have [R /(_ i' j') e] := quasi (l' - k')%N; exists (R i' j'); apply: mean_ext (mean_later k' e) => t.
  by rewrite /later; congr (_ * h _ 0 j'); rewrite -addnA subnKC.
case/orP: (leq_total k l) => le; first exact: one.
by have [r e] := one _ _ j i le; exists r; apply: mean_ext e => t; rewrite mulrC.
Qed.

Lemma lift_covariance : exists2 Q : 'M[K]_N, Q^T = Q & covariance E g g Q.
Proof.
have one i j : exists r, E (fun t => g t 0 i * g t 0 j) r.
  have [k [i' ei]] := entry i; have [l [j' ej]] := entry j.
  by have [r e] := product k l i' j'; exists r; apply: mean_ext e => t; rewrite ei ej.
have entries i : exists r : 'I_N -> K, forall j, E (fun t => g t 0 i * g t 0 j) (r j).
  by have [r hr] := fin_all_exists (one i); exists r.
have [r hr] := fin_all_exists entries; exists (\matrix_(i, j) r i j); last by move=> i j; rewrite mxE.
by apply/matrixP=> i j; rewrite !mxE; apply: mean_unique (hr j i) (mean_ext _ (hr i j)) => t; rewrite mulrC.
Qed.

Let U k : 'M[K]_(N, nu) := if insub k is Some k then col_mx 0 (col_mx (place K nu (k : 'I_H))^T 0) else 0.
Let V k : 'M[K]_(N, m) := if insub k is Some k then col_mx 0 (col_mx 0 (place K m (k : 'I_H))^T) else 0.
Let X := fix X k : 'M[K]_(N, n) := if k is k'.+1 then X k' *m sysA S + U k' *m B + V k' *m sysF S else col_mx 1%:M 0.
Let Y k := X k *m sysC S + U k *m D + V k *m sysG S.

Theorem lifted : exists N (Q : 'M[K]_N) (g : nat -> 'rV[K]_N) U V X Y, [/\ Q^T = Q /\ covariance E g g Q, process S B D U V X Y,
  forall k, (k < H)%N -> forall t, u (t + k)%N = g t *m U k /\ v (t + k)%N = g t *m V k,
  forall k, (k <= H)%N -> forall t, x (t + k)%N = g t *m X k & forall k, (k < H)%N -> forall t, y (t + k)%N = g t *m Y k].
Proof.
have [Q sym gQ] := lift_covariance; exists N, Q, g, U, V, X, Y.
have inputs k : (k < H)%N -> forall t, u (t + k)%N = g t *m U k /\ v (t + k)%N = g t *m V k.
  move=> kH t; rewrite /U /V (insubT (fun k => k < H)%N kH) /g !mul_row_col !mulmx0 !(addr0, add0r).
  by rewrite -!sample_of_future.
have states k : (k <= H)%N -> forall t, x (t + k)%N = g t *m X k.
  elim: k => [_ t|k IH kH t]; first by rewrite /g addn0 mul_row_col mulmx1 mulmx0 addr0.
  have [eu ev] := inputs k kH t; have [e _] := model (t + k)%N.
  by rewrite addnS e eu ev IH 1?ltnW //= !mulmxDr !mulmxA.
split=> // k kH t; have [eu ev] := inputs k kH t; have [_ e] := model (t + k)%N.
by rewrite e eu ev states 1?ltnW // /Y !mulmxDr !mulmxA.
Qed.

End Lift.

(** Shift-invariance makes what is lifted stationary. *)
Section Stationary.
Variables (d : nat) (g : nat -> 'rV[K]_d) (Q : 'M[K]_d).
Hypothesis gQ : covariance E g g Q.

Lemma image_stationary a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) X Y H : (forall k, (k < H)%N -> forall t,
  x (t + k)%N = g t *m X k) ->
  (forall k, (k < H)%N -> forall t, y (t + k)%N = g t *m Y k) -> stationary Q X Y H.
Proof.
move=> hx hy i k iH kH; apply: (image_cov gQ (x := later i.+1 x) (y := later k.+1 y)); [exact: hx|exact: hy|].
have := covariance_later 1 (image_covariance gQ (hx i (ltnW iH)) (hy k (ltnW kH))).
by apply: covariance_ext => t; rewrite /later -addnA add1n.
Qed.

Lemma image_uncorrelated a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) X Y i k : uncorrelated E x y ->
  (forall t, x (t + i)%N = g t *m X) -> (forall t, y (t + k)%N = g t *m Y) -> cov Q X Y = 0.
Proof.
move=> xy hx hy; apply: (image_cov gQ hx hy); have [ik|ki] := leqP i k.
  have [/(covariance_later i) e _] := xy (k - i)%N; apply: covariance_ext e => t //.
  by rewrite /later -addnA subnKC.
have [_ /(covariance_later k) e] := xy (i - k)%N; apply: covariance_ext e => t //.
by rewrite /later -addnA subnKC // ltnW.
Qed.

Lemma image_before a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) X Y i k : knows_nothing_before E x y -> (k <= i)%N ->
  (forall t, x (t + i)%N = g t *m X) -> (forall t, y (t + k)%N = g t *m Y) -> cov Q X Y = 0.
Proof.
move=> xy ki hx hy; apply: (image_cov gQ hx hy); have /(covariance_later k) e := xy (i - k)%N.
by apply: covariance_ext e => t //; rewrite /later -addnA subnKC.
Qed.

End Stationary.
End Calculus.
