(** seen_rational, which tells whether the limit of PI-MOESP has all of the range for an input of rational spectrum: along a line in the
    space of (A, B) it is a polynomial of degree q + r; at a nilpotent A it is seen_state times a regular matrix, so it has full rank for a
    chain of n delays behind the first input; and it is the same for whatever covariances of random variables the inputs are made of.

      seen_sum Q u r a q s A B == seen_rational where the inputs are u, as random variables *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Windows Consistency LimitsVocabulary AlmostEvery WholeRange.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Powers.
Variables (K : fieldType) (n : nat) (A : 'M[K]_n).

Lemma iter_mul a b (P : 'M_(b, a)) (M : 'M_(a, n)) e : iter e (mulmxr A) (P *m M) = P *m iter e (mulmxr A) M.
Proof. by elim: e => //= e ->; rewrite mulmxA. Qed.

Lemma iter_power a (M : 'M_(a, n)) e : iter e (mulmxr A) M = M *m iter e (mulmxr A) 1%:M.
Proof. by rewrite -iter_mul mulmx1. Qed.

Lemma iter_sum a k (M : 'I_k -> 'M_(a, n)) e : iter e (mulmxr A) (\sum_i M i) = \sum_i iter e (mulmxr A) (M i).
Proof. by rewrite iter_power mulmx_suml; apply: eq_bigr => i _; rewrite -iter_power. Qed.

Lemma iter_add a (M M' : 'M_(a, n)) e : iter e (mulmxr A) (M + M') = iter e (mulmxr A) M + iter e (mulmxr A) M'.
Proof. by elim: e => //= e ->; rewrite mulmxDl. Qed.

Lemma iter_scale a c (M : 'M_(a, n)) e : iter e (mulmxr A) (c *: M) = c *: iter e (mulmxr A) M.
Proof. by elim: e => //= e ->; rewrite -scalemxAl. Qed.

Lemma reciprocal_mul a r (c : nat -> K) (M : 'M_(a, n)) : M *m reciprocal_at r c A = \sum_(k < r.+1) c k *: iter (r - k) (mulmxr A) M.
Proof. by rewrite mulmx_sumr; apply: eq_bigr => k _; rewrite -scalemxAr -iter_power. Qed.

Lemma reciprocal_nilpotent r (c : nat -> K) : c r = 1 -> iter n (mulmxr A) 1%:M = 0 -> reciprocal_at r c A \in unitmx.
Proof.
move=> cr nil; rewrite -row_free_unit; apply: inj_row_free => v; rewrite reciprocal_mul => zero.
suff down d j : (n <= j + d)%N -> iter j (mulmxr A) v = 0 by exact: (down n 0%N).
elim: d j => [|d IH] j jd.
  by rewrite iter_power -(subnK (_ : n <= j)%N) ?iterD ?nil; [rewrite (iter_power 0) mul0mx mulmx0|lia].
have := congr1 (iter j (mulmxr A)) zero; rewrite iter_sum iter_power mul0mx big_ord_recr /= subnn cr scale1r.
rewrite big1 ?add0r // => k _; rewrite iter_scale -iterD IH ?scaler0 //; have := ltn_ord k; lia.
Qed.

End Powers.

Section Seen.
Variables (K : fieldType) (N n nu : nat) (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)).

Definition seen_sum r (a : nat -> K) q s (A : 'M_n) (B : 'M_(nu, n)) :=
  \sum_(k < r.+1) a k *: iter (r - k) (mulmxr A) (seen_state Q (fun i => u (r - k + i)%N) (q + k) q s A B).

Lemma polynomial_seen_sum r a q s (A A1 : 'M_n) (B B1 : 'M_(nu, n)) :
  polynomial_in (q + r) (fun c => seen_sum r a q s (A + c *: A1) (B + c *: B1)).
Proof.
apply: polynomial_sum => k; apply: polynomial_scale.
have -> : (q + r = q + k + (r - k))%N by have := ltn_ord k; lia.
by apply: (@polynomial_iter K (q + k) (r - k) _ _ (fun c => seen_state _ _ _ _ _ (A + c *: A1) (B + c *: B1))); apply: polynomial_seen.
Qed.

Lemma future_ext p t s t' (x y : nat -> 'M[K]_(N, p)) : (forall i, (i < s)%N -> x (t + i)%N = y (t' + i)%N) -> future t s x = future t' s y.
Proof. by move=> e; apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k ks; rewrite e. Qed.

Lemma seen_forgotten r k q s (A : 'M_n) (B : 'M_(nu, n)) : (k <= r)%N -> (forall j, (q <= j)%N -> iter j (mulmxr A) B = 0) ->
  seen_state Q (fun i => u (r - k + i)%N) (q + k) q s A B = seen_state Q (fun i => u (r + i)%N) q q s A B.
Proof.
move=> kr forgets; rewrite /seen_state.
have -> : future (q + k - q) q (fun i => u (r - k + i)%N) = future (q - q) q (fun i => u (r + i)%N).
  by apply: future_ext => i _; congr u; lia.
have -> : future (q + k) s (fun i => u (r - k + i)%N) = future q s (fun i => u (r + i)%N) by apply: future_ext => i _; congr u; lia.
rewrite addnC big_split_ord /= big1 ?add0r => [|i _]; last by rewrite forgets ?mulmx0 //; have := ltn_ord i; lia.
by apply: eq_bigr => i _; have ik := ltn_ord i; rewrite (_ : (r - k + (k + i) = r + i)%N); [congr (_ *m iter _ _ _)|]; lia.
Qed.

Lemma seen_sum_forgotten r a q s (A : 'M_n) (B : 'M_(nu, n)) : (forall j, (q <= j)%N -> iter j (mulmxr A) B = 0) ->
  seen_sum r a q s A B = seen_state Q (fun i => u (r + i)%N) q q s A B *m reciprocal_at r a A.
Proof.
move=> forgets; rewrite reciprocal_mul; apply: eq_bigr => k _; congr (_ *: iter _ _ _).
by apply: seen_forgotten => //; rewrite -ltnS.
Qed.

Theorem seen_sum_somewhere r a q s : a r = 1 -> (0 < nu)%N -> (n <= q)%N ->
  cov Q (future (r + q) s u) (future (r + q) s u) \in unitmx -> cov Q (future r (q + s) u) (future r (q + s) u) \in unitmx ->
  exists A B, iter n (mulmxr A) 1%:M = 0 /\ row_full (seen_sum r a q s A B).
Proof.
move=> ar nu0 nq unit excites; pose u' i := u (r + i)%N.
have e t s' : future t s' u' = future (r + t) s' u by apply: future_ext => i _; rewrite /u' addnA.
have [||A [B [nil full]]] := @whole_range_delays K N n nu Q u' q q s nu0 nq (leqnn q); rewrite ?subnn ?e ?addn0 //.
exists A, B; split=> //; rewrite seen_sum_forgotten => [|j qj]; last first.
  by rewrite iter_power -(subnK (leq_trans nq qj)) iterD nil iter_power mul0mx mulmx0.
by rewrite /row_full mxrankMfree // row_free_unit reciprocal_nilpotent.
Qed.

End Seen.

(** Of whatever random variables the inputs are made. *)
Section Images.
Variables (K : fieldType) (N N' n nu : nat) (Q : 'M[K]_N) (W : 'M[K]_(N, N')).

Lemma cov_image a b (X : 'M_(N', a)) (Y : 'M_(N', b)) : cov (cov Q W W) X Y = cov Q (W *m X) (W *m Y).
Proof. by rewrite /cov trmx_mul !mulmxA. Qed.

Lemma seen_state_image (u : nat -> 'M_(N', nu)) t q s (A : 'M_n) B :
  seen_state (cov Q W W) u t q s A B = seen_state Q (fun k => W *m u k) t q s A B.
Proof.
have e t' s' : W *m future t' s' u = future t' s' (fun k => W *m u k).
  by rewrite !future_sum mulmx_sumr; apply: eq_bigr => k _; rewrite mulmxA.
by apply: eq_bigr => k _; rewrite !cov_image !e.
Qed.

Lemma seen_state_ext (u u' : nat -> 'M_(N, nu)) t q s (A : 'M_n) B : (q <= t)%N -> (forall k, (k < t + s)%N -> u k = u' k) ->
  seen_state Q u t q s A B = seen_state Q u' t q s A B.
Proof.
move=> qt e; rewrite /seen_state; have -> : future (t - q) q u = future (t - q) q u' by apply: future_ext => i iq; apply: e; lia.
have -> : future t s u = future t s u' by apply: future_ext => i iq; apply: e; lia.
by apply: eq_bigr => k _; rewrite e //; have := ltn_ord k; lia.
Qed.

End Images.

Theorem seen_rational_image (K : fieldType) N n nu (Q : 'M[K]_N) (u : nat -> 'M_(N, nu)) r a q s (A : 'M_n) B :
  let W := future 0 (r + q + s) u in seen_rational a (cov Q W W) A B = seen_sum Q u r a q s A B.
Proof.
move=> W; apply: eq_bigr => k _; congr (_ *: iter _ _ _); rewrite seen_state_image; have kr : (k <= r)%N by rewrite -ltnS.
apply: seen_state_ext => [|i iq]; first exact: leq_addr.
have lt : (r - k + i < r + q + s)%N by lia.
by rewrite insubT -sample_of_future add0n.
Qed.

Theorem seen_rational_almost_every (K : fieldType) n nu r (a : nat -> K) q s (R : 'M_((r + q + s) * nu)) (A A1 : 'M_n) (B B1 : 'M_(nu, n))
    (ts : seq K) : row_full (seen_rational a R A B) -> uniq ts ->
  (forall c, c \in ts -> ~~ row_full (seen_rational a R (A + c *: A1) (B + c *: B1))) -> (size ts <= n * (q + r))%N.
Proof. by move=> full; apply: full_on_lines (polynomial_seen_sum _ _ _ _ _ _ _ _ _ _) _; rewrite !scale0r !addr0. Qed.
