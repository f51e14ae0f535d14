(** Minimal indices of a polynomial matrix M, after Forney (1975). Its right kernel has a basis of polynomial columns which generates all
    polynomial columns of the kernel and whose leading coefficients are independent (a minimal basis); their degrees are the indices. Here
    they are determined by the dimensions, over K, of the polynomial columns of degree < s in the kernel: sum of max(0, s - e).

        kernel_basis M s B == the columns of B are a basis, over K, of the polynomial columns y of degree < s with M y = 0
    kernel_dimension M s d == there is one of d columns *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly matrix mxalgebra zify.
From faultspace Require Import Vocabulary PolynomialKernel.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions *)
Section Definitions.
Variables (K : fieldType) (a b : nat) (M : 'M[{poly K}]_(a, b)).

(** The columns of B are a basis, over K, of the polynomial columns y of degree < s with M y = 0. *)
Definition kernel_basis s d (B : 'M[{poly K}]_(b, d)) := [/\ M *m B = 0, (sizem B <= s)%N &
  forall y : 'cV_b, M *m y = 0 -> (sizem y <= s)%N -> exists! u : 'cV[K]_d, y = B *m map_mx polyC u].
Definition kernel_dimension s d := exists B : 'M_(b, d), kernel_basis s B.

End Definitions.

(** The dimensions determine the indices. *)
Lemma sums_determine (t t' : seq nat) :
  (forall s, \sum_(e <- t) (s - e) = \sum_(e <- t') (s - e))%N -> perm_eq t t'.
Proof.
move=> same; have le_count s : count (fun e => e <= s)%N t = count (fun e => e <= s)%N t'.
  have step l : (\sum_(e <- l) (s.+1 - e) = count (fun e => e <= s) l + \sum_(e <- l) (s - e))%N.
    by elim: l => [|e l IH]; rewrite ?big_nil // !big_cons IH /=; move: (count _ l) (bigop _ _ _) => c f; case: (leqP e s); lia.
  by have := same s.+1; rewrite !step same => /addIn.
have mem_le e l : (count_mem e l + (if e is i.+1 then count (fun j => j <= i) l else 0) = count (fun j => j <= e) l)%N.
  by elim: l => [|j l IH]; [case: e | move: IH => /= <-; case: e => [|e]; move: (count _ l) => c; case: eqP; lia].
apply/allP => e _ /=; apply/eqP.
have := mem_le e t; rewrite le_count -(mem_le e t'); case: e => [|e]; last rewrite le_count; exact: addIn.
Qed.

Section Dimension.
Variables (K : fieldType) (a b : nat) (M : 'M[{poly K}]_(a, b)).
Notation const := (map_mx (@polyC K)).

Lemma sizem_col d (N : 'M[{poly K}]_(b, d)) j : (sizem (col j N) <= sizem N)%N.
Proof. by apply/bigmax_leqP => -[i i'] _; rewrite mxE; apply: (leq_bigmax (i, j)). Qed.

Lemma kernel_basis_expand s d d' (B : 'M_(b, d)) (B' : 'M_(b, d')) : kernel_basis M s B -> kernel_basis M s B' ->
  exists U, B' = B *m const U.
Proof.
move=> [_ _ all_y] [ker' size' _].
have /fin_all_exists[u hu] : forall j, exists u : 'cV[K]_d, col j B' = B *m const u.
  move=> j; have [||u [e _]] := all_y (col j B'); last by exists u.
    by rewrite colE mulmxA ker' mul0mx.
  exact: leq_trans (sizem_col _ _) size'.
exists (\matrix_(i, j) u j i 0); apply/matrixP => i j.
have /matrixP/(_ i 0) := hu j; rewrite !mxE => ->.
by apply: eq_bigr => k _; rewrite !mxE.
Qed.

Lemma kernel_basis_inj s d e (B : 'M_(b, d)) (U U' : 'M_(d, e)) : kernel_basis M s B ->
  B *m const U = B *m const U' -> U = U'.
Proof.
move=> [ker size_B all_y] same; apply/matrixP => i j; suff /matrixP/(_ i 0) : col j U = col j U' by rewrite !mxE.
have colB (V : 'M_(d, e)) : col j (B *m const V) = B *m const (col j V) by rewrite map_col !colE mulmxA.
have [||u [_ uniq]] := all_y (col j (B *m const U)).
- by rewrite colE !mulmxA ker !mul0mx.
- apply: leq_trans (sizem_col _ _) _; move/sizem_leP: size_B => B0; apply/sizem_leP => k sk.
  by rewrite coefm_mulr B0 // mul0mx.
by rewrite -(uniq _ (colB U)) -[RHS]uniq // same colB.
Qed.

Lemma kernel_dimension_unique s d d' : kernel_dimension M s d -> kernel_dimension M s d' -> d = d'.
Proof.
suff le e e' : kernel_dimension M s e -> kernel_dimension M s e' -> (e <= e')%N.
  by move=> h h'; apply/eqP; rewrite eqn_leq !le.
move=> [B hB] [B' hB']; have [U eB'] := kernel_basis_expand hB hB'; have [U' eB] := kernel_basis_expand hB' hB.
by apply: (@mulmx1_min _ _ _ U U'); apply: (kernel_basis_inj hB); rewrite map_mxM mulmxA -eB' -eB map_mx1 mulmx1.
Qed.

End Dimension.

(** Columns with independent leading coefficients: no degree is lost in their combinations (predictable degree). *)
Section MinimalBasis.
Variables (K : fieldType) (a b d : nat) (M : 'M[{poly K}]_(a, b)) (Y : 'M[{poly K}]_(b, d)).
Hypothesis leading_free : \rank (leading Y) = d.
Notation const := (map_mx (@polyC K)).

Lemma coef_top (f g : {poly K}) i j : (size f <= i.+1)%N -> (size g <= j.+1)%N -> (f * g)`_(i + j) = f`_i * g`_j.
Proof.
move=> fi gj; rewrite coefM (bigD1 (inord i)) //= inordK ?ltnS ?leq_addr // addKn big1 ?addr0 // => k.
rewrite -val_eqE /= inordK ?ltnS ?leq_addr // => ki; have [lt_ki|le_ik] := ltnP k i.
  by rewrite [g`__]nth_default ?mulr0 //; apply: leq_trans gj _; lia.
by rewrite nth_default ?mul0r //; apply: leq_trans fi _; lia.
Qed.

Lemma size_column i j : (size (Y i j) <= (degree Y j).+1)%N.
Proof.
apply: leq_trans (leqSpred _); have := leq_bigmax (i, 0%R : 'I_1) (F := fun ij => size (col j Y ij.1 ij.2)).
by rewrite !mxE.
Qed.

Lemma predictable_degree (u : 'cV_d) s : (sizem (Y *m u) <= s)%N -> forall j, u j 0 != 0 -> (size (u j 0%R) + degree Y j <= s)%N.
Proof.
move=> size_Yu j0 uj0; apply: contraT; rewrite -ltnNge => large.
case: (@arg_maxnP _ j0 (fun j => u j 0 != 0) (fun j => size (u j 0%R) + degree Y j)%N uj0) => j uj top.
pose t := ((size (u j 0%R)).-1 + degree Y j)%N.
have uj_pos : (0 < size (u j 0%R))%N by rewrite size_poly_gt0.
have le_t i : u i 0 != 0 -> ((size (u i 0%R)).-1 + degree Y i <= t)%N.
  move=> ui; have := top i ui; move: uj_pos ui; rewrite /= -size_poly_gt0 /t.
  move: (size (u i 0%R)) (size (u j 0%R)) => f g; lia.
pose w := \col_i (if (degree Y i <= t)%N then (u i 0)`_(t - degree Y i) else 0).
have top_coef : coefm t (Y *m u) = leading Y *m w.
  apply/matrixP => i k; rewrite ord1 !mxE /= coef_sum; apply: eq_bigr => l _; rewrite !mxE.
  have [->|ul] := eqVneq (u l 0) 0; first by rewrite mulr0 !coef0 if_same mulr0.
  have le := le_t l ul; have dl : (degree Y l <= t)%N by apply: leq_trans le; apply: leq_addl.
  by rewrite dl -{1}(subnKC dl) coef_top ?size_column //; apply: leq_trans (leqSpred _) _; rewrite ltnS leq_subRL // addnC.
have w0 : w = 0.
  have /row_fullP[D DY] : row_full (leading Y) by rewrite /row_full leading_free.
  rewrite -[w]mul1mx -DY -mulmxA -top_coef; suff -> : coefm t (Y *m u) = 0 by rewrite mulmx0.
  apply: (sizem_leP _ _ size_Yu); have := leq_trans large (top _ uj0); rewrite -(prednK uj_pos) addSn ltnS.
  exact.
move/matrixP/(_ j 0): w0; rewrite !mxE /t leq_addl addnK -/(lead_coef _) => /eqP.
by rewrite lead_coef_eq0 (negPf uj).
Qed.

(** So the shifts of the columns, as far as their degree stays below s, are a basis of what the columns generate. *)
Variable s : nat.
Hypotheses (in_kernel : M *m Y = 0) (generates : forall y : 'cV_b, M *m y = 0 -> (sizem y <= s)%N -> exists u, y = Y *m u).
Notation shift := {j : 'I_d & 'I_(s - degree Y j)}.
Let shifted : 'M[{poly K}]_(b, #|{: shift}|) := \matrix_(i, l) (let x : shift := enum_val l in 'X^(tagged x) * Y i (tag x)).
Let collect (u : 'cV[K]_#|{: shift}|) : 'cV[{poly K}]_d :=
  \col_j \sum_(k < s - degree Y j) (u (enum_rank (Tagged (fun j => 'I_(s - degree Y j)) k)) 0)%:P * 'X^k.

Lemma shifted_collect u : shifted *m const u = Y *m collect u.
Proof.
apply/matrixP => i j; rewrite ord1 !mxE {j}.
rewrite (reindex enum_rank) /=; last by apply: onW_bij; apply: enum_rank_bij.
transitivity (\sum_(x : shift) 'X^(tagged x) * Y i (tag x) * (u (enum_rank x) 0)%:P).
  by apply: eq_bigr => x _; rewrite !mxE enum_rankK.
transitivity (\sum_j \sum_(k < s - degree Y j)
    'X^k * Y i j * (u (enum_rank (Tagged (fun j => 'I_(s - degree Y j)) k)) 0)%:P).
  rewrite sig_big_dep /=; apply: eq_bigr => -[j k] _.
  by [].
apply: eq_bigr => j _; rewrite mxE mulr_sumr; apply: eq_bigr => k _.
by rewrite mulrAC [RHS]mulrA [_ * 'X^k]mulrC [in RHS]mulrA mulrAC.
Qed.

Lemma coef_collect u j (k : 'I_(s - degree Y j)) :
  (collect u j 0)`_k = u (enum_rank (Tagged (fun j => 'I_(s - degree Y j)) k)) 0.
Proof.
rewrite mxE coef_sum (bigD1 k) //= big1 => [|l lk]; first by rewrite addr0 coefCM coefXn eqxx mulr1.
by move: lk; rewrite coefCM coefXn -val_eqE eq_sym => /negPf ->; rewrite mulr0.
Qed.

Lemma generated_dimension : kernel_dimension M s (\sum_(j < d) (s - degree Y j)).
Proof.
have card : (#|{: shift}| = \sum_(j < d) (s - degree Y j))%N.
  by rewrite card_tagged sumnE big_map big_enum; apply: eq_bigr => j _; rewrite card_ord.
rewrite -card; exists shifted; split=> [||y ker size_y].
- apply/matrixP => i l; rewrite !mxE; set x := enum_val l.
  transitivity ('X^(tagged x) * (M *m Y) i (tag x)); last by rewrite in_kernel mxE mulr0.
  by rewrite mxE mulr_sumr; apply: eq_bigr => k _; rewrite mxE mulrCA.
- apply/bigmax_leqP => -[i l] _ /=; rewrite mxE; set x := enum_val l.
  apply: leq_trans (size_mul_leq _ _) _; rewrite size_polyXn /=.
  by apply: leq_trans (leq_add (leqnn _) (size_column _ _)) _; rewrite addnS addnC -ltn_subRL.
have [w yw] := generates ker size_y; rewrite yw in size_y.
have size_w j : (size (w j 0%R) <= s - degree Y j)%N.
  have [->|wj] := eqVneq (w j 0) 0; first by rewrite size_poly0.
  have le := predictable_degree size_y wj; rewrite -(leq_add2r (degree Y j)) subnK //.
  exact: leq_trans (leq_addl _ _) le.
have collectE u : y = shifted *m const u <-> collect u = w.
  rewrite shifted_collect yw; split=> [same | -> //].
  apply/eqP; rewrite -subr_eq0; apply/eqP/matrixP => j k; rewrite ord1 [RHS]mxE {k}.
  apply/eqP; apply: contraT => nz; have flat : (sizem (Y *m (collect u - w)) <= 0)%N.
    by rewrite mulmxBr same subrr; apply/sizem_leP => k _; apply: coefm0.
  by have := predictable_degree flat nz; rewrite leqn0 addn_eq0 size_poly_eq0 (negPf nz).
exists (\col_l (w (tag (enum_val l : shift)) 0)`_(tagged (enum_val l : shift))); split=> [|u /collectE uw].
  apply/collectE/matrixP => j i; rewrite ord1 {i}; apply/polyP => k.
  have [ks|sk] := ltnP k (s - degree Y j); first by rewrite -[k]/(val (Ordinal ks)) coef_collect mxE enum_rankK.
  rewrite [RHS]nth_default; last exact: leq_trans (size_w j) sk.
  rewrite mxE coef_sum big1 // => l _; rewrite coefCM coefXn; case: eqP => [e|]; last by rewrite mulr0.
  by move: (ltn_ord l); rewrite -e ltnNge sk.
apply/matrixP => l j; rewrite ord1 {j} mxE -uw; case: (enum_val l : shift) (enum_valK l) => j k /= {1}<-.
by rewrite -coef_collect.
Qed.

End MinimalBasis.

(** Minimal bases of M have these degrees, whichever basis. *)
Theorem minimal_indices_unique (K : fieldType) a b (M : 'M[{poly K}]_(a, b)) d (Y : 'M_(b, d)) (t : seq nat) :
  (forall s, kernel_dimension M s (\sum_(e <- t) (s - e))) -> minimal_basis M Y ->
  perm_eq [seq degree Y j | j <- enum 'I_d] t.
Proof.
move=> dims [ker gen free]; apply: sums_determine => s; apply: kernel_dimension_unique (dims s).
by rewrite big_map big_enum; apply: generated_dimension => // y h _; apply: gen.
Qed.
