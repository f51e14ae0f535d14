(** The left indices etas of Lag.v, defined by ranks of windows, are the left minimal (Kronecker) indices of the pencil: in this convention
    the minimal indices of its right kernel. For the polynomial columns (b; c) of degree < s in the kernel are given by c, and these c are
    the annihilators of the words of s samples, a space of dimension s p - rank window s = sum of max(0, s - eta).

       coefficients s c == the coefficients of c, one after the other
    from_coefficients u == the column of polynomials with these *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Windows Gap Lag.
From faultspace Require Import PolynomialKernel Annihilator Theorem3 MinimalIndices MinimalBasis.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Indices.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).
Implicit Types (b : 'cV[{poly K}]_n) (c : 'cV[{poly K}]_p) (s : nat).

(** The dimension of the annihilators of s samples. *)
Lemma rank_annihilators s : \rank (kermx (window S s)^T) = (\sum_(e <- etas S) (s - e))%N.
Proof.
rewrite mxrank_ker mxrank_tr rank_window_etas; apply: (@addIn (s * gap S n + \sum_(e <- etas S) minn s e)%N).
rewrite subnK; last by rewrite -rank_window_etas rank_leq_col.
rewrite addnCA -big_split /= (eq_bigr (fun=> s)) => [|e _]; last by rewrite addnC minnE subnK // leq_subr.
by rewrite big_const_seq count_predT iter_addn_0 size_etas -mulnDr subnKC ?gap_le_outputs.
Qed.

(** The coefficients of c, one after the other. *)
Definition coefficients s c : 'rV[K]_(s * p) := samples s (fun k => (coefm k c)^T).
Definition from_coefficients s (u : 'rV[K]_(s * p)) : 'cV[{poly K}]_p := polym s (fun k => (unsamples u k)^T).

Lemma sizem_from s u : (sizem (@from_coefficients s u) <= s)%N.
Proof. by apply/sizem_leP => k sk; rewrite coefm_polym ltnNge sk. Qed.

Lemma coefficientsK s c : (sizem c <= s)%N -> from_coefficients (coefficients s c) = c.
Proof.
move=> size_c; apply/coefmP => k; rewrite coefm_polym; case: ltnP => ks; first by rewrite samplesK // trmxK.
by rewrite (sizem_leP _ _ size_c).
Qed.

Lemma from_coefficientsK s u : coefficients s (@from_coefficients s u) = u.
Proof. by rewrite -[RHS]unsamplesK; apply: samples_ext => k ks; rewrite coefm_polym ks trmxK. Qed.

Lemma coefficientsE s c (k : 'I_s) (i : 'I_p) : coefficients s c 0 (mxvec_index k i) = (c i 0)`_k.
Proof. by rewrite mxvecE !mxE. Qed.

Lemma polym_coefm s c : (sizem c <= s)%N -> polym s (fun k => coefm k c) = c.
Proof.
move=> /sizem_leP c0; apply/coefmP => k; rewrite coefm_polym; case: ltnP => // sk.
by rewrite c0.
Qed.

Lemma annihilates_coefficients s c : annihilates S s (fun k => coefm k c) <-> (coefficients s c <= kermx (window S s)^T)%MS.
Proof.
rewrite (sameP sub_kermxP eqP) -trmx_eq0 trmx_mul trmxK; split=> [ann | /eqP ker r /windowP/submxP[a ra]].
  apply/eqP/row_matrixP => i; rewrite row0 row_mul -[row i _]unsamplesK -pairing_samples.
  by apply: ann; apply/sub_windowP/row_sub.
by rewrite pairing_samples ra -mulmxA ker mulmx0.
Qed.

(** The costate is shorter than c. *)
Lemma costate_size s b c : pencil S *m col_mx b c = 0 -> (sizem c <= s)%N -> (sizem b <= s)%N.
Proof.
move/right_kernel => step /sizem_leP c0; apply/sizem_leP => k sk.
suff late0 d j : (s <= j)%N -> (sizem b < j + d)%N -> late b j = 0.
  by apply: (late0 (sizem b).+1 k.+1); [apply: leqW | rewrite addSn addnS ltnS ltnW // ltnS leq_addl].
elim: d j => [|d IH] j sj; first by rewrite addn0; case: j sj => //= j _ bj; apply: (sizem_leP _ _ (leqnn _)).
by rewrite addnS -addSn => /IH e; rewrite (step j).1 c0 // e ?mulmx0 ?subrr // leqW.
Qed.

Lemma sizem_col_mx b c s : (sizem (col_mx b c) <= s)%N <-> (sizem b <= s)%N /\ (sizem c <= s)%N.
Proof.
have coefm_col k : coefm k (col_mx b c) = col_mx (coefm k b) (coefm k c) by apply: map_col_mx.
split=> [/sizem_leP zero | [/sizem_leP b0 /sizem_leP c0]].
  by split; apply/sizem_leP => k sk; have := zero k sk; rewrite coefm_col -[0]col_mx0 => /eq_col_mx[].
by apply/sizem_leP => k sk; rewrite coefm_col b0 // c0 // col_mx0.
Qed.

(** The polynomial columns c of degree < s that some costate completes are the annihilators. *)
Lemma kernel_coefficients s c : (sizem c <= s)%N ->
  (exists b, pencil S *m col_mx b c = 0) <-> (coefficients s c <= kermx (window S s)^T)%MS.
Proof.
move=> size_c; rewrite -annihilates_coefficients; split=> [[b ker] | ann]; first exact: kernel_annihilates ker size_c.
by have [b] := annihilates_kernel ann; rewrite polym_coefm //; exists b.
Qed.

(** The kernel of the pencil: polynomial columns of degree < s form a space of dimension sum of max (0, s - eta), for every s. *)
Theorem pencil_kernel_dimension s : kernel_dimension (pencil S) s (\sum_(e <- etas S) (s - e)).
Proof.
rewrite -rank_annihilators; set N := kermx _; pose U := row_base N.
have inN u : (u *m U <= N)%MS by apply: submx_trans (submxMl _ _) _; rewrite eq_row_base.
pose C : 'M_(p, _) := \matrix_(i, j) from_coefficients (row j U) i 0.
have col_C j : col j C = from_coefficients (row j U) by apply/matrixP => i k; rewrite ord1 !mxE.
have size_C : (sizem C <= s)%N.
  by apply/bigmax_leqP => -[i j] _; have := sizem_from (row j U); rewrite -col_C => /bigmax_leqP/(_ (i, 0) isT); rewrite mxE.
have /fin_all_exists[b hb] : forall j, exists b, pencil S *m col_mx b (col j C) = 0.
  move=> j; apply/(@kernel_coefficients s); first by rewrite col_C sizem_from.
  by rewrite col_C from_coefficientsK rowE inN.
pose B : 'M_(n, _) := \matrix_(i, j) b j i 0.
have col_B j : col j B = b j by apply/matrixP => i k; rewrite ord1 !mxE.
have ker : pencil S *m col_mx B C = 0.
  apply/matrixP => i j; have : col j (pencil S *m col_mx B C) = 0 by rewrite colE -mulmxA -colE col_col_mx col_B hb.
  by move/matrixP/(_ i 0); rewrite mxE => ->; rewrite !mxE.
have combine u : coefficients s (C *m const u) = u^T *m U.
  apply/rowP => i; case/mxvec_indexP: i => k l; rewrite coefficientsE [RHS]mxE mxE coef_sum; apply: eq_bigr => j _.
  by rewrite [const u j 0]mxE coefMC mulrC [u^T 0 j]mxE mxE -coefficientsE from_coefficientsK [row j U 0 _]mxE.
exists (col_mx B C); split=> // [|y].
  apply/bigmax_leqP => -[i j] _; have := costate_size (hb j) (leq_trans (sizem_col _ _) size_C) => size_b.
  have : (sizem (col_mx (b j) (col j C)) <= s)%N by apply/sizem_col_mx; split=> //; apply: leq_trans (sizem_col _ _) _.
  by rewrite -col_B -col_col_mx => /bigmax_leqP/(_ (i, 0) isT); rewrite mxE.
rewrite -[y]vsubmxK; move: (usubmx y) (dsubmx y) => b0 c0 {y} ker0 /sizem_col_mx[_ size_c].
have [u uE] : exists u, coefficients s c0 = u *m U.
  by apply/submxP; rewrite eq_row_base; apply/kernel_coefficients => //; exists b0.
have same w : col_mx b0 c0 = col_mx B C *m const w <-> u = w^T.
  split=> [|uw].
    rewrite mul_col_mx => /eq_col_mx[_ cw]; apply: (row_free_inj (row_base_free N)).
    by rewrite -uE cw combine.
  have cw : c0 = C *m const w.
    rewrite -[LHS](coefficientsK size_c) uE uw -combine coefficientsK //; apply/sizem_leP => k sk.
    by rewrite coefm_mulr (sizem_leP _ _ size_C) // mul0mx.
  rewrite mul_col_mx cw (_ : b0 = B *m const w) //; apply: (costate_unique (S := S) (S' := S) _ _ _ ker0) => //.
  by rewrite cw -mul_col_mx mulmxA ker mul0mx.
by exists u^T; split=> [|w /same ->]; rewrite ?trmxK //; apply/same; rewrite trmxK.
Qed.

(** There is a minimal basis. *)
Theorem pencil_minimal_basis : exists Y : 'M_(n + p, p - gap S n), minimal_basis (pencil S) Y.
Proof.
have dims s : kernel_dimension (pencil S) s (\rank (kermx (window S s)^T)) by rewrite rank_annihilators; apply: pencil_kernel_dimension.
apply: (minimal_basis_exists dims (N := n)) => s ns; rewrite !mxrank_ker !mxrank_tr rank_window_step (gap_constant S ns) mulSn.
by have := rank_leq_col (window S s); have := gap_le_outputs S n; lia.
Qed.

(** So the etas are the degrees of any minimal basis of the kernel of the pencil. *)
Theorem etas_are_minimal_indices d (Y : 'M_(n + p, d)) : minimal_basis (pencil S) Y ->
  perm_eq [seq degree Y j | j <- enum 'I_d] (etas S).
Proof. exact: minimal_indices_unique pencil_kernel_dimension. Qed.

(** No other list of indices has these dimensions. *)
Theorem etas_unique (t : seq nat) : (forall s, kernel_dimension (pencil S) s (\sum_(e <- t) (s - e))) -> perm_eq t (etas S).
Proof. by move=> dims; apply: sums_determine => s; apply: kernel_dimension_unique (dims s) (pencil_kernel_dimension s). Qed.

End Indices.
