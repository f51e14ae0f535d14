(** Duality. A polynomial column c with p entries annihilates the words of length s > deg c when sum_k r(k) c_k = 0 for all of them.
    These c are the last parts of the polynomial columns (b; c) in the right kernel of the pencil; b is the costate, which runs backwards:
        b(k-1) = A b(k) - C c(k),     F b(k) = G c(k).
    Words are exactly what all annihilators annihilate, so restricted behaviours may be compared by kernels of pencils.

        pairing s r c == r(0) c_0 + ... + r(s-1) c_(s-1)
    annihilates S s c == that is zero for all words r of s samples
             late b k == the coefficient k - 1 of b, and 0 for k = 0
      costate S s c t == the costate t steps before the end *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows PolynomialKernel.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Words and columns. *)
Definition pairing (K : fieldType) p s (r : nat -> 'rV[K]_p) (c : nat -> 'cV[K]_p) : 'M[K]_1 := \sum_(k < s) r k *m c k.
Definition annihilates (K : fieldType) n m p (S : system K n m p) s c := forall r, word S s r -> pairing s r c = 0.

Section Annihilators.
Variables (K : fieldType) (n m p : nat).
Implicit Types (S : system K n m p) (r : nat -> 'rV[K]_p) (c : nat -> 'cV[K]_p) (b : nat -> 'cV[K]_n).
Notation const := (map_mx (@polyC K)).

Lemma pairing_samples s r c : pairing s r c = samples s r *m (samples s (fun k => (c k)^T))^T.
Proof.
apply/matrixP => i j; rewrite !ord1 !mxE summxE (reindex _ (curry_mxvec_bij s p)) /=.
transitivity (\sum_(k < s) \sum_(l < p) r k 0 l * c k l 0); first by apply: eq_bigr => k _; rewrite mxE.
by rewrite pair_bigA; apply: eq_bigr => -[k l] _ /=; rewrite mxE !mxvecE !mxE.
Qed.

(** Words are what the annihilators annihilate. *)
Lemma word_annihilators S s r : word S s r <-> (forall c, annihilates S s c -> pairing s r c = 0).
Proof.
split=> [wr c ann | ann]; first exact: ann.
apply/windowP; rewrite submxE; apply/eqP/matrixP => i j; rewrite ord1 {i} [RHS]mxE.
pose c k := (unsamples (col j (cokermx (window S s)))^T k)^T.
have pairE q : pairing s q c = samples s q *m col j (cokermx (window S s)).
  rewrite pairing_samples; congr (_ *m _); apply: trmx_inj; rewrite trmxK -[RHS]unsamplesK.
  by apply: samples_ext => k _; rewrite trmxK.
have /ann : annihilates S s c.
  by move=> q /windowP; rewrite submxE pairE => /eqP q0; rewrite colE mulmxA q0 mul0mx.
by rewrite pairE colE mulmxA -colE => /matrixP/(_ 0 0); rewrite mxE [RHS]mxE.
Qed.

(** Summation by parts. *)
Lemma pairing_output S s x v b c : (forall k, (k < s)%N -> b k = sysA S *m b k.+1 - sysC S *m c k) ->
  pairing s (output S x v) c = \sum_(k < s) v k *m (sysG S *m c k - sysF S *m b k.+1) + state S x v s *m b s - x *m b 0%N.
Proof.
rewrite /pairing; elim: s => [|s IH] step; first by rewrite !big_ord0 add0r subrr.
rewrite !big_ord_recr /= IH => [|k ks]; last by apply: step; apply: leqW.
rewrite step //; move: (\sum_(i < s) _) => q; rewrite /output mulmxBr !mulmxDl mulmxBr !mulmxA.
rewrite [LHS]addrAC; congr (_ - _); rewrite -!addrA; congr (q + _).
by rewrite addKr [X in _ = _ + (_ + X)]addrC addKr addrC.
Qed.

Lemma col_pencil S (b : 'cV_n) (c : 'cV_p) :
  pencil S *m col_mx b c =
  col_mx ('X *: b - const (sysA S) *m b + const (sysC S) *m c) (- (const (sysF S) *m b) + const (sysG S) *m c).
Proof. by rewrite mul_block_col mulmxBl mul_scalar_mx mulNmx. Qed.

(** The coefficients of b, one step late: the costate at time k is the coefficient k - 1. *)
Definition late (b : 'cV[{poly K}]_n) k := if k is j.+1 then coefm j b else 0.

Lemma right_kernel S (b : 'cV_n) (c : 'cV_p) :
  pencil S *m col_mx b c = 0 <->
  (forall k, late b k = sysA S *m late b k.+1 - sysC S *m coefm k c /\ sysG S *m coefm k c = sysF S *m late b k.+1).
Proof.
rewrite col_pencil -[X in _ = X]col_mx0; split=> [/eq_col_mx[eb ec] k | step].
  split.
    have := congr1 (coefm k) eb; rewrite coefmD coefmB coefmX !coefm_mull coefm0 -/(late b k).
    by move/eqP; rewrite addr_eq0 subr_eq addrC => /eqP.
  have := congr1 (coefm k) ec; rewrite coefmD coefmN !coefm_mull coefm0 => /eqP.
  by rewrite addrC subr_eq0 => /eqP.
congr col_mx; apply/coefmP => k; rewrite coefm0 coefmD ?coefmB ?coefmN ?coefmX !coefm_mull; have [eb ec] := step k.
  by rewrite -/(late b k) eb addrAC subrK subrr.
by rewrite ec addNr.
Qed.

Lemma kernel_annihilates S s (b : 'cV_n) (c : 'cV_p) :
  pencil S *m col_mx b c = 0 -> (sizem c <= s)%N -> annihilates S s (fun k => coefm k c).
Proof.
move/right_kernel => step /sizem_leP c0 r [x [v rE]].
have late0 d k : (s <= k)%N -> (sizem b < k + d)%N -> late b k = 0.
  elim: d k => [|d IH] k sk; first by rewrite addn0; case: k sk => //= k _ bk; apply: (sizem_leP _ _ (leqnn _)).
  by rewrite addnS -addSn => /IH e; rewrite (step k).1 c0 // e ?mulmx0 ?subrr // leqW.
have -> : pairing s r (fun k => coefm k c) = pairing s (output S x v) (fun k => coefm k c).
  by apply: eq_bigr => k _; rewrite rE.
rewrite (@pairing_output S s x v (late b)) => [|k _]; last exact: (step k).1.
rewrite (late0 (sizem b).+1) ?addnS ?ltnS ?leq_addl // !mulmx0 subr0 addr0 big1 // => k _.
by rewrite (step k).2 subrr mulmx0.
Qed.

(** The costate t steps before the end. *)
Fixpoint costate S s c t := if t is j.+1 then sysA S *m costate S s c j - sysC S *m c (s - t)%N else 0.

Lemma annihilates_kernel S s c : annihilates S s c -> exists b : 'cV_n, pencil S *m col_mx b (polym s c) = 0.
Proof.
move=> ann; pose b k := costate S s c (s - k).
have step k : (k < s)%N -> b k = sysA S *m b k.+1 - sysC S *m c k.
  by move=> ks; rewrite /b -(subnSK ks) /= subnSK // subKn // ltnW.
have bs : b s = 0 by rewrite /b subnn.
have value (x : 'rV_n) (v : nat -> 'rV_m) : \sum_(k < s) v k *m (sysG S *m c k - sysF S *m b k.+1) - x *m b 0%N = 0.
  by rewrite -[RHS](ann _ (output_word S s x v)) (pairing_output x v step) bs mulmx0 addr0.
have b0 : b 0%N = 0.
  apply/row_matrixP => i; rewrite row0 rowE -[RHS](value (- delta_mx 0 i) (fun=> 0)) big1 => [|k _]; last exact: mul0mx.
  by rewrite sub0r mulNmx opprK.
have bc k : (k < s)%N -> sysG S *m c k = sysF S *m b k.+1.
  move=> ks; apply/eqP; rewrite -subr_eq0; apply/eqP/row_matrixP => i; rewrite row0 rowE.
  rewrite -[RHS](value 0 (fun j => if j == k then delta_mx 0 i else 0)) mul0mx subr0 (bigD1 (Ordinal ks)) //= eqxx.
  by rewrite big1 ?addr0 // => j /negPf jk; rewrite -[j == k :> nat]/(j == Ordinal ks) jk mul0mx.
exists (polym s (fun k => b k.+1)); apply/right_kernel => k.
have late_b j : (j <= s)%N -> late (polym s (fun k => b k.+1)) j = b j.
  by case: j => [|j] js //=; rewrite coefm_polym js.
rewrite /= !coefm_polym; case: (ltnP k s) => ks; first by rewrite late_b ?(ltnW ks) // -step // bc.
rewrite !mulmx0 subrr; split=> //; move: ks; rewrite leq_eqVlt => /orP[/eqP <-|]; first by rewrite late_b.
by case: k => //= k sk; rewrite coefm_polym ltnNge -ltnS sk.
Qed.

End Annihilators.
