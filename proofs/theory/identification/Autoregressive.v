(** Faults that lead a coloured input. The limit lies in the row space of O_s as soon as the future faults are combinations of the future
    inputs of the window, up to something uncorrelated with them and with the instruments. So it does for every u that is autoregressive of
    order at most s, whatever the lead and with feedthrough: later inputs are combinations of s earlier ones and of innovations.

    hidden Q Z Uf w == w is a combination of Uf up to something that is uncorrelated with Z and Uf *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix zify.
From faultspace Require Import Vocabulary Places Signals Consistency.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions. *)
Section Definitions.
Variables (K : fieldType) (N : nat) (Q : 'M[K]_N) (z f : nat) (Z : 'M[K]_(N, z)) (Uf : 'M[K]_(N, f)).

(** w is a combination of Uf up to something uncorrelated with Z and Uf: what projecting Uf away hides from Z. *)
Definition hidden b (w : 'M[K]_(N, b)) := exists M, cov Q Z (w - Uf *m M) = 0 /\ cov Q Uf (w - Uf *m M) = 0.

End Definitions.

Section Hidden.
Variables (K : fieldType) (N : nat) (Q : 'M[K]_N) (z f : nat) (Z : 'M[K]_(N, z)) (Uf : 'M[K]_(N, f)).
Notation hidden := (hidden Q Z Uf).

Lemma hidden_uncorrelated b (w : 'M_(N, b)) : cov Q Z w = 0 -> cov Q Uf w = 0 -> hidden w.
Proof. by move=> zw uw; exists 0; rewrite mulmx0 subr0. Qed.

Lemma hidden_combination b (M : 'M_(f, b)) : hidden (Uf *m M).
Proof. by exists M; rewrite subrr !cov_zero. Qed.

Lemma hidden_add b (w w' : 'M_(N, b)) : hidden w -> hidden w' -> hidden (w + w').
Proof.
move=> [M [zw uw]] [M' [zw' uw']]; exists (M + M'); rewrite mulmxDr opprD addrACA.
rewrite (cov_add Q Z (w - Uf *m M)) (cov_add Q Uf (w - Uf *m M)).
by rewrite zw uw zw' uw' !addr0.
Qed.

Lemma hidden_mul b c (w : 'M_(N, b)) (P : 'M_(b, c)) : hidden w -> hidden (w *m P).
Proof. by move=> [M [zw uw]]; exists (M *m P); rewrite mulmxA -mulmxBl !cov_mul zw uw !mul0mx. Qed.

Lemma hidden_sum b (I : Type) (l : seq I) (P : pred I) (w : I -> 'M_(N, b)) :
  (forall i, P i -> hidden (w i)) -> hidden (\sum_(i <- l | P i) w i).
Proof.
move=> h; elim/big_ind: _ => // [|w1 w2]; last exact: hidden_add.
by apply: hidden_uncorrelated; apply: cov_zero.
Qed.

Lemma projected_hidden b (w : 'M_(N, b)) X : X *m cov Q Uf Uf = cov Q Z Uf -> hidden w -> cov Q Z w - X *m cov Q Uf w = 0.
Proof.
move=> hX [M [zw uw]]; move: zw uw; rewrite !cov_sub !cov_mul => /eqP; rewrite subr_eq0 => /eqP-> /eqP; rewrite subr_eq0 => /eqP->.
by rewrite [X *m (_ *m _)]mulmxA hX subrr.
Qed.

End Hidden.

Section Limit.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Hypothesis model : process S B D u v x y.
Variables (t s z : nat) (Z : 'M[K]_(N, z)).
Let Uf := future t s u.

Theorem hidden_faults_limit L : (forall k, (k < s)%N -> hidden Q Z Uf (v (t + k)%N)) -> projected_limit Q Z Uf (future t s y) L ->
  exists M, projected_limit Q Z Uf (x t) M /\ L = M *m O S s.
Proof.
move=> hid [X [hX ->]]; exists (cov Q Z (x t) - X *m cov Q Uf (x t)); split; first by exists X.
rewrite (projected_outputs model) // (projected_hidden (w := future t s v) hX) ?mul0mx ?addr0 //.
by rewrite (future_sum t s v); apply: hidden_sum => k _; apply/hidden_mul/hid.
Qed.

Lemma hidden_in_window k : (k < s)%N -> hidden Q Z Uf (u (t + k)%N).
Proof.
move=> ks; suff -> : u (t + k)%N = Uf *m (place K nu (Ordinal ks))^T by apply: hidden_combination.
by apply/row_matrixP=> i; rewrite row_mul mul_place_transposed rowK mxvecK rowK.
Qed.

(** u(k) = sum_(i < a) u(k-1-i) A_i + e(k) with a <= s, from the end of the window on, where Z and Uf know nothing of e(k). *)
Theorem autoregressive_limit a (A : nat -> 'M[K]_nu) (e : nat -> 'M[K]_(N, nu)) J (Phi : nat -> 'M[K]_(nu, m)) L :
  (a <= s)%N -> (forall k, (t + s <= k)%N -> u k = \sum_(i < a) u (k - i.+1)%N *m A i + e k) ->
  (forall k, (t + s <= k)%N -> cov Q Z (e k) = 0 /\ cov Q Uf (e k) = 0) ->
  (forall k, v k = \sum_(j < J) u (k + j)%N *m Phi j) -> projected_limit Q Z Uf (future t s y) L ->
  exists M, projected_limit Q Z Uf (x t) M /\ L = M *m O S s.
Proof.
move=> as_ ar innovation leads; apply: hidden_faults_limit => k ks.
have all_u i : (t <= i)%N -> hidden Q Z Uf (u i).
  elim/ltn_ind: i => i IH ti; have [lt|ge] := ltnP i (t + s).
    by rewrite -(subnKC ti); apply: hidden_in_window; lia.
  rewrite (ar i ge); apply: hidden_add; last by have [? ?] := innovation i ge; apply: hidden_uncorrelated.
  by apply: hidden_sum => j _; have := ltn_ord j => ja; apply/hidden_mul/IH; lia.
by rewrite leads; apply: hidden_sum => j _; apply/hidden_mul/all_u; lia.
Qed.

End Limit.
