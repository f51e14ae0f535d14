(** An input that is autoregressive of order at most s, all stationary and (A, B) controllable: n past inputs are enough for all of the
    range of O_s. What the s inputs after it do not tell of an input, eb, is uncorrelated with all later inputs, and so cov (eb(k),
    x(k+1+d)) = Gamma A^d with the same Gamma at all times. A direction that the limit with n past inputs does not see is orthogonal to all
    Gamma A^d, so the limit with any number of past inputs does not see it either. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Signals Consistency Leads Controllable.
From faultspace Require Import LimitsVocabulary WholeRange.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Shifted.
Variables (K : fieldType) (N a b : nat) (Q : 'M[K]_N) (f : nat -> 'M[K]_(N, a)) (g : nat -> 'M[K]_(N, b)) (H : nat).
Hypothesis st : stationary Q f g H.

Lemma stationary_many i k d : (i + d < H)%N -> (k + d < H)%N -> cov Q (f (i + d)%N) (g (k + d)%N) = cov Q (f i) (g k).
Proof. by elim: d => [|d IH]; rewrite ?addn0 // !addnS => iH kH; rewrite st // IH // ltnW. Qed.

Lemma stationary_future_many t s k d : (t + s + d <= H)%N -> (k + d < H)%N ->
  cov Q (future (t + d) s f) (g (k + d)%N) = cov Q (future t s f) (g k).
Proof.
move=> tH kH; rewrite !cov_future_left; apply: eq_bigr => j _; have := ltn_ord j => js.
by rewrite addnAC stationary_many //; lia.
Qed.

Lemma stationary_windows_many t s t' s' d : (t + s + d <= H)%N -> (t' + s' + d <= H)%N ->
  cov Q (future (t + d) s f) (future (t' + d) s' g) = cov Q (future t s f) (future t' s' g).
Proof.
move=> tH kH; rewrite !cov_future; apply: eq_bigr => j _; have := ltn_ord j => js.
by rewrite addnAC stationary_future_many //; lia.
Qed.
End Shifted.

Section ShortPast.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Variables (t q s a : nat) (Au : nat -> 'M[K]_nu) (e : nat -> 'M[K]_(N, nu)).
Let H := (t + s)%N.
Hypotheses (symmetric : Q^T = Q) (model : process S B D u v x y).
Hypothesis uncorrelated : forall i k, (i < H)%N -> (k < H)%N -> cov Q (u i) (v k) = 0.
Hypotheses (ar : autoregressive Q a Au u e H) (later : forall k, (a <= k < H)%N -> cov Q (e k) (x 0%N) = 0).
Hypotheses (uu : stationary Q u u H) (ux : stationary Q u x H) (unit : cov Q (future t s u) (future t s u) \in unitmx).
Hypotheses (short : (a <= s)%N) (nq : (n <= q)%N) (qt : (q <= t)%N) (before : (n + a <= t)%N) (s0 : (0 < s)%N).

(** Prediction backwards by s inputs. *)
Let R := cov Q (future 0 s u) (future 0 s u).
Let Wb := invmx R *m cov Q (future 1 s u) (u 0%N).
Let eb k := u k - future k.+1 s u *m Wb.
Let Gamma := (cov Q (eb 0%N) (x 1%N)).

Lemma window_covariance k : (k + s <= H)%N -> cov Q (future k s u) (future k s u) = R.
Proof. by move=> kH; rewrite -[k]add0n (stationary_windows_many uu) //; lia. Qed.

Lemma R_unit : R \in unitmx.
Proof. by rewrite -(window_covariance (leqnn _)). Qed.

Lemma backward_near k : (k.+1 + s <= H)%N -> cov Q (future k.+1 s u) (eb k) = 0.
Proof.
move=> kH; rewrite /eb cov_sub cov_mul window_covariance // /Wb mulmxA mulmxV ?R_unit // mul1mx.
have := stationary_future_many uu (t := 1) (s := s) (k := 0) (d := k); rewrite add1n add0n => ->; rewrite ?subrr //; lia.
Qed.

Lemma backward_later k l : (k.+1 + s <= H)%N -> (k < l < H)%N -> cov Q (u l) (eb k) = 0.
Proof.
move=> kH; elim/ltn_ind: l => l IH /andP[kl lH]; have [near|far] := ltnP l (k.+1 + s).
  by apply: (cov_future_zero (backward_near kH)); rewrite kl.
have al : (a <= l < H)%N by lia.
have [-> _ past] := ar al; rewrite cov_add_left cov_sum_left big1 ?add0r => [|i _]; last first.
  by rewrite cov_mul_left IH ?mulmx0 //; have := ltn_ord i; lia.
rewrite /eb cov_sub cov_mul past // cov_future big1 ?mul0mx ?subrr // => i _.
by rewrite past ?mul0mx //; have := ltn_ord i; lia.
Qed.

Lemma later_backward k l : (k.+1 + s <= H)%N -> (k < l < H)%N -> cov Q (eb k) (u l) = 0.
Proof. by move=> kH kl; rewrite -(cov_transpose _ _ symmetric) backward_later // trmx0. Qed.

Lemma backward_fault k l : (k.+1 + s <= H)%N -> (l < H)%N -> cov Q (eb k) (v l) = 0.
Proof.
move=> kH lH; rewrite /eb cov_sub_left cov_mul_left uncorrelated //; last lia.
rewrite cov_future_left big1 ?mulmx0 ?subrr // => i _; rewrite uncorrelated ?mulmx0 //; have := ltn_ord i; lia.
Qed.

Lemma backward_state k d : (k.+1 + s <= H)%N -> (k.+1 + d <= t)%N -> cov Q (eb k) (x (k.+1 + d)%N) = times_power S Gamma d.
Proof.
move=> kH; elim: d => [|d IH] dt.
  rewrite addn0 /= /Gamma /eb !cov_sub_left !cov_mul_left.
  have := stationary_future_many ux (t := 1) (s := s) (k := 1) (d := k); rewrite add1n => -> //; try by rewrite /H; lia.
  by have := stationary_many ux (i := 0) (k := 1) (d := k); rewrite add0n add1n => -> //; rewrite /H; lia.
rewrite addnS; have [-> _] := model (k.+1 + d)%N; rewrite !cov_add !cov_mul IH; last lia.
by rewrite later_backward ?backward_fault ?mul0mx ?addr0 //; lia.
Qed.

Theorem stationary_whole_range L : (forall z, steered S B z) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS.
Proof.
move=> all /(two_sided_product model qt uncorrelated)[M [limit ->]]; apply/eqmxP; apply: eqmxMfull; apply: row_full_seen => w Mw.
pose c := invmx (cov Q (future t s u) (future t s u)) *m cov Q (future t s u) (x t) *m w; pose xi := x t *m w - future t s u *m c.
have unseen i : (t - q <= i < t + s)%N -> cov Q (u i) xi = 0 by apply: (unseen_by_limit qt unit limit Mw).
have future_xi l : (t <= l < H)%N -> cov Q (u l) xi = 0 by move=> tl; apply: unseen; lia.
have eb_xi k d : (k.+1 + d)%N = t -> cov Q (eb k) xi = times_power S Gamma d *m w.
  move=> e1; rewrite cov_sub !cov_mul -e1 backward_state ?e1 //; last by rewrite /H; lia.
  rewrite cov_future big1 ?mul0mx ?subr0 // => i _; rewrite later_backward ?mul0mx //; rewrite /H; have := ltn_ord i; lia.
have seen d : (d < q)%N -> times_power S Gamma d *m w = 0.
  move=> dq; rewrite -(eb_xi (t - d.+1)%N) /eb; last lia.
  rewrite cov_sub_left cov_mul_left unseen; last lia.
  rewrite cov_future_left big1 ?mulmx0 ?subrr // => i _; rewrite unseen ?mulmx0 //; have := ltn_ord i; lia.
have {}seen d : times_power S Gamma d *m w = 0.
  have zero := unseen_by_steered seen; apply/sub_kermxP; apply: submx_trans (_ : steered_space S Gamma q <= _)%MS; last exact/sub_kermxP.
  rewrite (steered_space_more S Gamma nq) -(steered_space_more S Gamma (q := maxn n d.+1)) ?leq_maxl //.
  have dq : (d < maxn n d.+1)%N by rewrite leq_max ltnSn orbT.
  by apply: (sumsmx_sup (Ordinal dq)) => //; rewrite genmxE.
have past_xi d : forall l, (t - (n + a) <= l < H)%N -> (H <= l + d)%N -> cov Q (u l) xi = 0.
  elim: d => [|d IH] l tl lH; first lia.
  have [tl'|lt] := leqP t l; first by apply: future_xi; lia.
  have -> : u l = eb l + future l.+1 s u *m Wb by rewrite subrK.
  rewrite cov_add_left cov_mul_left (eb_xi l (t - l.+1)%N) ?seen ?add0r; last lia.
  rewrite cov_future_left big1 ?mulmx0 // => i _; rewrite IH ?mulmx0 //; rewrite /H; have := ltn_ord i; lia.
have unreached := unseen_is_unreached (q := n + a) model before uncorrelated ar later (w := w) (c := c).
have {unreached} zero : steered_space S B n *m w = 0.
  apply: unseen_by_steered => l ln; apply: unreached; last by lia.
  by move=> i ti; apply: (past_xi H); rewrite ?leq_addl.
have : row_full (steered_space S B n) by apply/controllable_steered_space.
by case/row_fullP => P PR; rewrite -[w]mul1mx -PR -mulmxA zero mulmx0.
Qed.

End ShortPast.
