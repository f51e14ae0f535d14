(** One sample more than the lag is necessary, for every system with lag >= 1: there is another one, with one more state, as many faults, no
    larger lag and the same last gap, left-invertible if the given one is, that has the same words of lag samples, but more words of
    lag + 1. It is the given system with kicks (Kick.v) that a window of lag samples cannot tell, as strong as a functional of the previous
    output says; the new state remembers that functional.

             fed_back == S with one state more, to which the outputs are fed back through mu, and which acts as the fault (f, g)
    strength mu z r k == that state: z first, then r(k-1) mu *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Chain Gap Lag Kick.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The feedback from the previous output to one more fault (f, g). *)
Section Feedback.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (f : 'rV[K]_n) (g : 'rV[K]_p) (mu : 'cV[K]_p).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (r : nat -> 'rV[K]_p) (z : 'rV[K]_1) (s k : nat).

Definition fed_back : system K (n + 1) m p :=
  System (block_mx (sysA S) (sysC S *m mu) f (g *m mu)) (row_mx (sysF S) (sysG S *m mu)) (col_mx (sysC S) g) (sysG S).

(** The strength of the new fault, when z is remembered first and the outputs are r. *)
Definition strength z r k : 'rV[K]_1 := if k is j.+1 then r j *m mu else z.
Notation response kappa k := (output (with_faults S f g) 0 kappa k).

Lemma output_fed_back x z v k : let r := output fed_back (row_mx x z) v in
  r k = output S x v k + response (strength z r) k.
Proof.
move=> r; rewrite -output_add_faults.
suff state_eq : state fed_back (row_mx x z) v k =
    row_mx (state (add_faults S f g) x (fun j => row_mx (v j) (strength z r j)) k) (strength z r k).
  by rewrite /r /output state_eq !mul_row_col addrAC addrA.
elim: k => //= k IH; rewrite IH mul_row_block mul_mx_row add_row_mx !mul_row_col; congr row_mx; first by rewrite addrAC addrA.
by rewrite /r /output IH mul_row_col !mulmxDl !mulmxA.
Qed.

(** Closing the loop: outputs that agree with the strengths they cause. *)
Lemma close_loop x z v r s : (forall k, (k < s)%N -> r k = output S x v k + response (strength z r) k) ->
  forall k, (k < s)%N -> r k = output fed_back (row_mx x z) v k.
Proof.
move=> h; elim/ltn_ind=> k IH ks; rewrite h // output_fed_back; congr (_ + _).
by apply: output_ext => -[|j] //= jk; rewrite IH // (ltn_trans jk ks).
Qed.

Lemma fed_back_left_invertible : left_invertible S -> left_invertible fed_back.
Proof.
move=> linv v out0; apply: linv => k; rewrite -[RHS](out0 k) -row_mx0 output_fed_back.
by rewrite [X in _ + X]output_zero ?addr0 // => -[|j] _ //=; rewrite row_mx0 out0 mul0mx.
Qed.

(** Words stay words after zeros: the new fault does nothing then. *)
Lemma after_zeros_fed_back s : (after_zeros S s <= after_zeros fed_back s)%MS.
Proof.
apply/row_subP=> i; set d := row i _; have /after_zerosP[x [v h]] : (d <= after_zeros S s)%MS by apply: row_sub.
apply/after_zerosP; exists (row_mx x 0), v; apply: close_loop => k ks.
rewrite h // [X in _ + X]output_zero ?addr0 // => -[|j] //= jk.
by rewrite /only_at ltn_eqF ?mul0mx // (leq_trans jk ks).
Qed.

(** A fault that solves problem (11) on s samples changes nothing there. *)
Lemma fed_back_words s r : solves S s f g -> word S s r <-> word fed_back s r.
Proof.
move=> /solvesP silent; split=> [r_word|[x [v h]]].
  have [x [v h]] := word_sub r_word (silent (strength 0 r)).
  by exists (row_mx x 0), v; apply: close_loop => k ks; rewrite -h // subrK.
rewrite -(hsubmxK x) in h.
apply: word_ext (word_add (output_word S s (lsubmx x) v) (silent (strength (rsubmx x) (output fed_back (row_mx (lsubmx x) (rsubmx x)) v)))).
by move=> k ks; rewrite h // [RHS]output_fed_back.
Qed.

End Feedback.

Section Necessity.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (M : nat).
Hypothesis lag_S : lag S = M.+1.

(** What may follow M zeros, but not M + 1. *)
Lemma last_value : exists2 d : 'rV[K]_p, (d <= after_zeros S M)%MS & ~~ (d <= after_zeros S M.+1)%MS.
Proof.
have /row_subPn[i out] : ~~ (after_zeros S M <= after_zeros S M.+1)%MS.
  apply/negP=> /mxrankS; rewrite -/(gap S M) -/(gap S M.+1) => le.
  suff: (lag S <= M)%N by rewrite lag_S ltnn.
  apply/lagP/eqP; rewrite eqn_leq gap_at_least_last andbT; apply: leq_trans le _.
  by rewrite (lagP S M.+1).2 // lag_S.
by exists (row i (after_zeros S M)); first exact: row_sub.
Qed.

Theorem lag_plus_1_samples_are_necessary : exists S' : system K (n + 1) m p,
  [/\ left_invertible S -> left_invertible S', (lag S' <= lag S)%N, gap S' (n + 1) = gap S n,
      forall r, word S (lag S) r <-> word S' (lag S) r & exists r, word S' (lag S).+1 r /\ ~ word S (lag S).+1 r].
Proof.
rewrite lag_S; have [g g_in g_out] := last_value.
have /submxP[c g_eq] := g_in; pose u := rsubmx c; pose y := lsubmx c *m silent S M.
have gE : g = kick_g S y u by rewrite g_eq -{1}(hsubmxK c) mul_row_col mulmxA.
have reach : silently_reaches S M y by apply/silentP/submxMl.
have [mu g_mu] : exists mu : 'cV[K]_p, g *m mu = 1%:M.
  apply/row_freeP; rewrite -row_leq_rank rank_rV lt0b; apply: contraNneq g_out => ->; exact: sub0mx.
pose S' := fed_back S (kick_f S y u) g mu; exists S'.
have solved : solves S M.+1 (kick_f S y u) g by rewrite gE; apply: kick_solves.
have once_g w k : output (with_faults S (kick_f S y u) g) 0 (once w) k = output S (w *m y) (once (w *m u)) k.
  by rewrite gE; apply: output_kick_once.
(* after M + 1 zeros, the new system can do no more than the given one *)
have below : (after_zeros S' M.+1 <= after_zeros S M.+1)%MS.
  apply/row_subP=> i; set d := row i _; have /after_zerosP[x [v h]] : (d <= after_zeros S' M.+1)%MS by apply: row_sub.
  rewrite -(hsubmxK x) in h; apply/after_zerosP.
  apply: word_ext (word_add (output_word S M.+2 (lsubmx x) v) (output_word S M.+2 (rsubmx x *m y) (once (rsubmx x *m u)))).
  move=> k kM; rewrite h // [RHS]output_fed_back -once_g; congr (_ + _); apply: output_ext => -[|j] //= jk.
  have jM : (j < M.+1)%N by apply: leq_trans jk _.
  by rewrite -(h j (ltnW jM)) /only_at ltn_eqF // mul0mx.
have settled s : (M < s)%N -> gap S s = gap S n by move=> Ms; apply/lagP; rewrite lag_S.
have above s : (gap S s <= gap S' s)%N by apply/mxrankS/after_zeros_fed_back.
have gap_S' s : (M < s)%N -> gap S' s = gap S n.
  move=> Ms; apply/eqP; rewrite eqn_leq -{2}(settled s Ms) above andbT -(settled M.+1 (ltnSn M)).
  exact: leq_trans (gap_decreasing S' Ms) (mxrankS below).
have Mn : (M < n + 1)%N by rewrite addn1 ltnS -ltnS -lag_S (leq_trans (lag_le_n S)).
split; [exact: fed_back_left_invertible|by apply/lagP; rewrite !gap_S'|exact: gap_S'|by move=> r; apply: fed_back_words|].
(* g after M zeros, and the kick that it causes *)
have /after_zerosP[x [v h]] := g_in.
pose r k := output S x v k + only_at M.+1 g k; exists r; split; last first.
  move=> r_word; case/negP: g_out; apply/after_zerosP.
  by apply: word_ext (word_sub r_word (output_word S M.+2 x v)) => k _; rewrite /r addrC addKr.
exists (row_mx x 0), v; apply: close_loop => k; rewrite [in LHS]/r ltnS leq_eqVlt => k_le; congr (_ + _).
have rM : r M = g by rewrite /r -(h M (ltnSn M)) /only_at eqxx (ltn_eqF (ltnSn M)) addr0.
have early j : (j <= M)%N -> strength mu 0 r j = 0.
  case: j => //= j jM; have jM1 : (j < M.+1)%N by apply: ltnW.
  by rewrite /r -(h j jM1) /only_at (ltn_eqF jM) (ltn_eqF jM1) addr0 mul0mx.
case/orP: k_le => [/eqP->|kM].
  rewrite /only_at eqxx /output state_zero => [|j]; last by rewrite ltnS; apply: early.
  by rewrite mul0mx add0r [strength _ _ _ _]/= rM g_mu mul1mx.
by rewrite /only_at ltn_eqF // output_zero // => j jk; apply: early; rewrite (leq_trans jk).
Qed.

End Necessity.
