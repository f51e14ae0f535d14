(** The algebra of proposition 1. Where past and future inputs are uncorrelated with the future faults, the matrix that subspace
    identification takes the observability matrix from is a cross-covariance times O_s, exactly (transposed here: the row space of O_s
    holds the rows of the limit). Without that the error is known exactly as well: the same projection of the faults, times T_s. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Windows Places Signals.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Futures.
Variables (K : fieldType) (N : nat).

Lemma future_sum p t s (r : nat -> 'M[K]_(N, p)) : future t s r = \sum_(k < s) r (t + k)%N *m place K p k.
Proof.
apply/row_matrixP=> i; rewrite rowK samples_places linear_sum.
by apply: eq_bigr => k _; rewrite /= row_mul.
Qed.

Lemma cov_future Q a p t s (z : 'M[K]_(N, a)) (r : nat -> 'M[K]_(N, p)) :
  cov Q z (future t s r) = \sum_(k < s) cov Q z (r (t + k)%N) *m place K p k.
Proof. by rewrite future_sum cov_sum; apply: eq_bigr => k _; rewrite cov_mul. Qed.

Lemma cov_future_left Q a p t s (z : 'M[K]_(N, a)) (r : nat -> 'M[K]_(N, p)) :
  cov Q (future t s r) z = \sum_(k < s) (place K p k)^T *m cov Q (r (t + k)%N) z.
Proof. by rewrite future_sum cov_sum_left; apply: eq_bigr => k _; rewrite cov_mul_left. Qed.

(** Sequences that are uncorrelated at all times of two windows: so are the windows. *)
Lemma uncorrelated_futures Q p q t t' s s' (a : nat -> 'M[K]_(N, p)) (b : nat -> 'M[K]_(N, q)) :
  (forall i k, (t <= i < t + s)%N -> (t' <= k < t' + s')%N -> cov Q (a i) (b k) = 0) -> cov Q (future t s a) (future t' s' b) = 0.
Proof.
move=> h; rewrite cov_future big1 // => k _; rewrite cov_future_left big1 ?mul0mx // => j _.
by rewrite h ?mulmx0 // leq_addr ltn_add2l ltn_ord.
Qed.

End Futures.

Section Consistency.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Hypothesis model : process S B D u v x y.

(** Y_f = X O_s + U_f T_s(B, D) + V_f T_s(F, G). *)
Lemma future_outputs t s :
  future t s y = x t *m O S s + future t s u *m T (with_faults S B D) s + future t s v *m T S s.
Proof.
apply/row_matrixP=> i; rewrite rowK !linearD /= !row_mul !rowK.
rewrite (samples_ext (q := fun k => output S (row i (x t)) (fun j => row i (v (t + j)%N)) k +
  output (with_faults S B D) 0 (fun j => row i (u (t + j)%N)) k)); last by move=> k _; apply: (process_output model).
by rewrite samples_add -!window_response !mul_row_col mul0mx add0r addrAC.
Qed.

Lemma same_middle (V : zmodType) (a b c a' c' : V) : a + b + c - (a' + b + c') = a - a' + (c - c').
Proof. by rewrite [in X in - X]addrAC [a + b + c]addrAC opprD addrACA subrr addr0 opprD addrACA. Qed.

(** The limit, for each way X to project: a cross-covariance times O_s plus what the projection leaves of the faults, times T_s. *)
Lemma projected_outputs t s z (Z : 'M_(N, z)) X : let Uf := future t s u in X *m cov Q Uf Uf = cov Q Z Uf ->
  cov Q Z (future t s y) - X *m cov Q Uf (future t s y) =
  (cov Q Z (x t) - X *m cov Q Uf (x t)) *m O S s +
  (cov Q Z (future t s v) - X *m cov Q Uf (future t s v)) *m T S s.
Proof.
move=> Uf hX; rewrite future_outputs !cov_add !cov_mul -/Uf !mulmxDr !mulmxBl.
rewrite [X *m (cov _ Uf Uf *m _)]mulmxA hX [X *m (cov _ Uf (x t) *m _)]mulmxA [X *m (cov _ Uf (future t s v) *m _)]mulmxA.
exact: same_middle.
Qed.

(** Two-sided: instruments and future inputs both uncorrelated with the future faults. *)
Theorem two_sided_limit t s z (Z : 'M_(N, z)) L :
  cov Q Z (future t s v) = 0 -> cov Q (future t s u) (future t s v) = 0 -> projected_limit Q Z (future t s u) (future t s y) L ->
  exists M, projected_limit Q Z (future t s u) (x t) M /\ L = M *m O S s.
Proof.
move=> zv uv [X [hX ->]]; exists (cov Q Z (x t) - X *m cov Q (future t s u) (x t)); split; first by exists X.
by rewrite projected_outputs // zv uv mulmx0 subr0 mul0mx addr0.
Qed.

(** In terms of the sequences: u and v uncorrelated at lags of both signs, the q past inputs as instruments. *)
Corollary two_sided_past_inputs t q s L : (q <= t)%N ->
  (forall i k, (t - q <= i < t + s)%N -> (t <= k < t + s)%N -> cov Q (u i) (v k) = 0) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  exists M, projected_limit Q (future (t - q) q u) (future t s u) (x t) M /\ L = M *m O S s.
Proof.
move=> qt h; apply: two_sided_limit; apply: uncorrelated_futures => i k.
  by rewrite subnK // => /andP[ti it]; apply: h; rewrite ti (leq_trans it) ?leq_addr.
by move=> /andP[ti it]; apply: h; rewrite it (leq_trans (leq_subr _ _) ti).
Qed.

(** It has all rows of O_s iff the cross-covariance has rank n, (A, C) observable on s samples. *)
Lemma product_right s z (M : 'M_(z, n)) : row_free (O S s) -> (M *m O S s == O S s)%MS = row_full M.
Proof.
move=> obs; rewrite submxMl /= -(mxrank_leqif_sup (submxMl M (O S s))) mxrankMfree //.
by rewrite (eqP obs).
Qed.

(** B and D by MOESP's regression, the true A and C given: Cov(Uf, Uf)^-1 Cov(Uf, Yf), seen modulo the rows of O_s, is T_s(B, D). *)
Theorem regression t s W : let Uf := future t s u in
  W *m cov Q Uf Uf = 1%:M -> cov Q Uf (future t s v) = 0 ->
  W *m cov Q Uf (future t s y) *m cokermx (O S s) = T (with_faults S B D) s *m cokermx (O S s).
Proof.
move=> Uf hW uv; rewrite future_outputs !cov_add !cov_mul uv mul0mx addr0 mulmxDr mulmxDl.
rewrite [W *m (cov Q Uf Uf *m _)]mulmxA hW mul1mx [W *m (cov Q Uf (x t) *m _)]mulmxA -(mulmxA _ (O S s)) mulmx_coker.
by rewrite mulmx0 add0r.
Qed.

End Consistency.
