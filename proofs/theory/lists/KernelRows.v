(** Kernel rows c_0, ..., c_mu, here columns, with r(j) c_0 + ... + r(j + mu) c_mu = 0 for all words of a system and all j. If those of
    degree at most k always have independent leading coefficients, then sample k adds at most p - #{rows of degree <= k} to the rank of a
    window; and where the rank of the window reaches the sum of these, the words are exactly the solutions of the relations.

                relation c r == r(0) c_0 + ... + r(mu) c_mu
          satisfies rows s r == that is zero for all rows c, wherever they fit into the s samples
          annihilates rows S == it is zero for all rows and all outputs of S
               active rows k == the rows of degree k at most
       leading_active rows k == the matrix of their leading coefficients
    independent_leading rows == these are independent, for every k
                 room rows k == how many of p dimensions they leave
                bound rows s == the sum of that over k < s: a bound of the rank of a window
                 unstack M k == sample k of the stack M *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra zify.
From faultspace Require Import Vocabulary Basics Windows Stacks.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section KernelRows.
Variables (K : fieldType) (p : nat).
Implicit Types (c : seq 'cV[K]_p) (rows : seq (seq 'cV[K]_p)).

Definition relation a c (r : nat -> 'M[K]_(a, p)) : 'M[K]_(a, 1) := \sum_(k < size c) r k *m c`_k.
Definition satisfies rows s a (r : nat -> 'M[K]_(a, p)) :=
  forall c j, c \in rows -> (j + size c <= s)%N -> relation c (fun k => r (j + k)%N) = 0.
Definition annihilates rows n m (S : system K n m p) := forall c x v, c \in rows -> relation c (output S x v) = 0.

(** The rows of degree at most k, the matrix of their leading coefficients, and what they leave. *)
Definition active rows k := [seq c <- rows | (size c <= k.+1)%N].
Definition leading_active rows k : 'M[K]_(p, size (active rows k)) := \matrix_(i, j) (last 0 (nth [::] (active rows k) j)) i 0.
Definition independent_leading rows := forall k, \rank (leading_active rows k) = size (active rows k).
Definition room rows k := (p - size (active rows k))%N.
Definition bound rows s := (\sum_(k < s) room rows k)%N.

Variables (rows : seq (seq 'cV[K]_p)) (leading_independent : independent_leading rows).

Lemma room_step s a (r : nat -> 'M[K]_(a, p)) : satisfies rows s.+1 r -> (\rank (kermx (stack s r) *m r s) <= room rows s)%N.
Proof.
move=> h; set N := kermx _; have silent k : (k < s)%N -> N *m r k = 0 by apply: (mul_stack_eq0 _ _ r).1; apply: mulmx_ker.
suff /mulmx0_rank_max : N *m r s *m leading_active rows s = 0 by rewrite leading_independent /room; lia.
apply/matrixP => i j; set c := nth [::] (active rows s) j.
have -> : (N *m r s *m leading_active rows s) i j = (N *m r s *m last 0 c) i 0 by rewrite !mxE; apply: eq_bigr => l _; rewrite !mxE.
have : c \in active rows s by apply: mem_nth.
rewrite mem_filter => /andP[cs c_in]; move: (h c (s.+1 - size c)%N c_in); rewrite subnK // => /(_ (leqnn _)).
case: c cs {c_in} => [|c0 c] cs; first by rewrite mulmx0 !mxE.
move=> /(congr1 (mulmx N)); rewrite mulmx0 /relation [size (c0 :: c)]/= mulmx_sumr big_ord_recr /= big1 => [|k _]; last first.
  rewrite mulmxA silent ?mul0mx //; move: cs (ltn_ord k) => /=. lia.
rewrite add0r mulmxA nth_last /= (_ : (s.+1 - _ + _)%N = s) => [->|]; last by move: cs => /=; lia.
by rewrite !mxE.
Qed.

Lemma satisfies_prefix s t a (r : nat -> 'M[K]_(a, p)) : (s <= t)%N -> satisfies rows t r -> satisfies rows s r.
Proof. by move=> st h c j c_in e; apply: h => //; apply: leq_trans st. Qed.

Theorem rank_bound s a (r : nat -> 'M[K]_(a, p)) : satisfies rows s r -> (\rank (stack s r) <= bound rows s)%N.
Proof.
elim: s => [|s IH] h; first by apply: leq_trans (rank_leq_col _) _.
rewrite rank_stack_step /bound big_ord_recr /=; apply: leq_add (room_step h); apply: IH; exact: satisfies_prefix (leqnSn s) h.
Qed.

(** Any matrix as a stack. *)
Definition unstack s a (M : 'M[K]_(a, s * p)) k : 'M[K]_(a, p) := \matrix_i unsamples (row i M) k.

Lemma unstackK s a (M : 'M[K]_(a, s * p)) : stack s (unstack M) = M.
Proof.
apply/row_matrixP => i; rewrite rowK -[RHS]unsamplesK; apply: samples_ext => k _; exact: rowK.
Qed.

Lemma rows_satisfy s a (r : nat -> 'M[K]_(a, p)) : (forall i, satisfies rows s (fun k => row i (r k))) -> satisfies rows s r.
Proof.
move=> h c j c_in e; apply/row_matrixP => i; rewrite row0 -[RHS](h i c j c_in e) /relation linear_sum.
by apply: eq_bigr => k _; rewrite /= row_mul.
Qed.

Lemma satisfies_ext s a (r q : nat -> 'M[K]_(a, p)) : (forall k, (k < s)%N -> r k = q k) -> satisfies rows s r -> satisfies rows s q.
Proof.
move=> e h c j c_in cs; rewrite -(h c j c_in cs); apply: eq_bigr => k _; rewrite e //.
by apply: leq_trans cs; rewrite ltn_add2l.
Qed.

Section OneSystem.
Variables (n m : nat) (S : system K n m p) (annihilated : annihilates rows S).

Lemma word_satisfies s (r : nat -> 'rV[K]_p) : word S s r -> satisfies rows s r.
Proof.
move=> [x [v h]]; apply: satisfies_ext (fun k ks => esym (h k ks)) _ => c j c_in _.
rewrite -[RHS](annihilated (state S x v j) (fun i => v (j + i)%N) c_in); apply: eq_bigr => k _.
by rewrite output_shift.
Qed.

Lemma window_satisfies s a (M : 'M[K]_(a, s * p)) : (M <= window S s)%MS -> satisfies rows s (unstack M).
Proof.
move=> h; apply: rows_satisfy => i; apply: word_satisfies; have /sub_windowP := submx_trans (row_sub i M) h.
by apply: word_ext => k _; rewrite rowK.
Qed.

Lemma window_bound s : (\rank (window S s) <= bound rows s)%N.
Proof. by rewrite -(unstackK (window S s)); apply: rank_bound; exact: window_satisfies. Qed.

Lemma window_increment s : (\rank (window S s.+1) <= \rank (window S s) + room rows s)%N.
Proof.
rewrite -(unstackK (window S s.+1)) rank_stack_step; apply: leq_add (room_step _); last exact: window_satisfies.
apply/mxrankS/row_subP => i; rewrite rowK windowP; apply: word_prefix (leqnSn s) _.
have /sub_windowP := row_sub i (window S s.+1); by apply: word_ext => k _; rewrite rowK.
Qed.

(** Where the ranks meet, they meet before, and the relations say everything. *)
Lemma meets_before s t : (s <= t)%N -> \rank (window S t) = bound rows t -> \rank (window S s) = bound rows s.
Proof.
move=> /subnK <-; elim: (t - s)%N => // d IH; rewrite addSn /bound big_ord_recr /= -/(bound rows _) => e.
by apply: IH; have := window_increment (d + s); have := window_bound (d + s); rewrite e; lia.
Qed.

Theorem word_iff_satisfies s r : \rank (window S s) = bound rows s -> word S s r <-> satisfies rows s r.
Proof.
move=> e; split=> [|h]; first exact: word_satisfies.
apply/windowP; have le : (window S s <= col_mx (window S s) (samples s r))%MS by rewrite -addsmxE addsmxSl.
apply: submx_trans (_ : (col_mx (window S s) (samples s r) <= _)%MS); first by rewrite -addsmxE addsmxSr.
rewrite -(mxrank_leqif_sup le) eqn_leq mxrankS //= e -(unstackK (col_mx _ _)); apply: rank_bound; apply: rows_satisfy => i.
apply: satisfies_ext (_ : forall k, _ -> unsamples (row i (col_mx (window S s) (samples s r))) k = _) _ => [k _|].
  by rewrite rowK.
case: (split_ordP i) => l ->; rewrite ?rowKu ?rowKd.
  by apply: word_satisfies; apply/sub_windowP/row_sub.
by rewrite row_id; apply: satisfies_ext h => k ks; rewrite samplesK.
Qed.

End OneSystem.
End KernelRows.
