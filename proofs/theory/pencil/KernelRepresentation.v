(** The behaviour as a kernel, {r : N(q) r = 0}: the last p rows of a basis of the right kernel of the pencil are such an N, and every
    column that annihilates the behaviour is a combination of theirs. By duality: words are what their annihilators annihilate
    (Annihilator.v), and these are the last parts of the polynomial columns in the kernel of the pencil. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary StructureVocabulary Basics Infinite PolynomialKernel Annihilator MinimalIndices.
From faultspace Require Import Lag Indices.
From faultspace Require NormalRank.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Shifted.
Variables (K : fieldType) (p : nat).
Implicit Types (r : nat -> 'rV[K]_p).

Lemma shifted_wide c (N : 'M[{poly K}]_(p, c)) s r t : (sizem N <= s)%N -> shifted N r t = \sum_(k < s) r (t + k)%N *m coefm k N.
Proof.
move=> le_s; rewrite /shifted (big_ord_widen s (fun k => r (t + k)%N *m coefm k N) le_s) big_mkcond /=; apply: eq_bigr => k _.
by case: ltnP => // kN; rewrite (sizem_leP _ _ (leqnn _)) // mulmx0.
Qed.

Lemma shifted_col c (N : 'M[{poly K}]_(p, c)) r t j : shifted (col j N) r t = col j (shifted N r t).
Proof.
rewrite (shifted_wide r t (sizem_col N j)) /shifted; apply/matrixP => a b; rewrite [in RHS]mxE !summxE; apply: eq_bigr => k _.
by rewrite !mxE; apply: eq_bigr => l _; rewrite !mxE.
Qed.

Lemma shifted_cols c (N : 'M[{poly K}]_(p, c)) r t : shifted N r t = 0 <-> forall j, shifted (col j N) r t = 0.
Proof.
split=> [e j | e]; first by rewrite shifted_col e; apply/matrixP => a b; rewrite !mxE.
by apply/rowP => j; have := e j; rewrite shifted_col => /matrixP/(_ 0 0); rewrite !mxE.
Qed.

Lemma shifted_add c (M N : 'M[{poly K}]_(p, c)) r t : shifted (M + N) r t = shifted M r t + shifted N r t.
Proof.
have [s Ms Ns] : exists2 s, (sizem M <= s)%N & (sizem N <= s)%N by exists (maxn (sizem M) (sizem N)); rewrite ?leq_maxl ?leq_maxr.
have le : (sizem (M + N) <= s)%N.
  by apply/sizem_leP => k sk; rewrite coefmD (sizem_leP _ _ Ms) // (sizem_leP _ _ Ns) // addr0.
rewrite (shifted_wide r t le) (shifted_wide r t Ms) (shifted_wide r t Ns) -big_split.
by apply: eq_bigr => k _; rewrite coefmD mulmxDr.
Qed.

Lemma shifted0 c r t : shifted (0 : 'M[{poly K}]_(p, c)) r t = 0.
Proof. by rewrite /shifted big1 // => k _; rewrite -/(coefm k _) coefm0 mulmx0. Qed.

Lemma shifted_const c d (N : 'M[{poly K}]_(p, c)) (C : 'M_(c, d)) r t : shifted (N *m map_mx polyC C) r t = shifted N r t *m C.
Proof.
rewrite (@shifted_wide _ _ (sizem N)); last by apply/sizem_leP => k Nk; rewrite coefm_mulr (sizem_leP _ _ (leqnn _)) ?mul0mx.
by rewrite mulmx_suml; apply: eq_bigr => k _; rewrite coefm_mulr mulmxA.
Qed.

Lemma shifted_X c (N : 'M[{poly K}]_(p, c)) r t : shifted ('X *: N) r t = shifted N r t.+1.
Proof.
rewrite (@shifted_wide _ _ (sizem N).+1); last by apply/sizem_leP => -[|k] // Nk; rewrite coefmX (sizem_leP _ _ (leqnn _)).
rewrite big_ord_recl coefmX mulmx0 add0r /shifted; apply: eq_bigr => k _.
by rewrite coefmX /= addnS addSn.
Qed.

(** Combinations of rows that vanish at all times vanish. *)
Lemma shifted_mul c d (N : 'M[{poly K}]_(p, c)) (U : 'M_(c, d)) r : (forall t, shifted N r t = 0) -> forall t, shifted (N *m U) r t = 0.
Proof.
move=> zero; have [s] := ubnP (sizem U); elim: s U => // s IH U Us t.
pose V := polym (sizem U) (fun k => coefm k.+1 U).
have coefV k : coefm k V = coefm k.+1 U.
  by rewrite coefm_polym; case: ltnP => // Uk; rewrite (sizem_leP _ _ (leqnn _)) // ltnW.
have UV : U = 'X *: V + map_mx polyC (coefm 0 U).
  by apply/coefmP => -[|k]; rewrite coefmD coefmX coefm_const ?add0r ?addr0 // coefV.
rewrite UV mulmxDr shifted_add shifted_const zero mul0mx addr0 -scalemxAr shifted_X.
have [U0|U0] := posnP (sizem U).
  suff -> : V = 0 by rewrite mulmx0 shifted0.
  by apply/coefmP => k; rewrite coefV coefm0 (sizem_leP _ _ (leqnn _)) ?U0.
apply: IH; apply: leq_trans (_ : (sizem U <= s)%N) => //; rewrite -(prednK U0) ltnS; apply/sizem_leP => k Uk.
by rewrite coefV (sizem_leP _ _ (leqnn _)) // -(prednK U0).
Qed.
End Shifted.

Section Kernel.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma pairing_shifted s r (c : 'cV[{poly K}]_p) t : (sizem c <= s)%N ->
  pairing s (fun k => r (t + k)%N) (fun k => coefm k c) = shifted c r t.
Proof. by move=> cs; rewrite (shifted_wide r t cs). Qed.

(** A column annihilates the behaviour iff some costate completes it to the kernel of the pencil. *)
Theorem annihilating_columns (c : 'cV[{poly K}]_p) :
  (forall r, behavior S r -> forall t, shifted c r t = 0) <-> exists b : 'cV_n, pencil S *m col_mx b c = 0.
Proof.
split=> [ann | [b ker] r rB t].
  have [b] : exists b : 'cV_n, pencil S *m col_mx b (polym (sizem c) (fun k => coefm k c)) = 0.
    apply: annihilates_kernel => r [x [v e]]; rewrite -[RHS](ann _ (output_behavior S x v) 0%N).
    by rewrite -(@pairing_shifted (sizem c)) //; apply: eq_bigr => k _; rewrite e.
  by rewrite polym_coefm //; exists b.
rewrite -(@pairing_shifted (sizem c)) //; apply: (kernel_annihilates ker (leqnn _)).
exact/behavior_word/behavior_suffix.
Qed.

Variables (d : nat) (Y : 'M[{poly K}]_(n + p, d)).
Hypotheses (kernel : pencil S *m Y = 0) (generates : forall y : 'cV_(n + p), pencil S *m y = 0 -> exists u, y = Y *m u).
Notation N := (dsubmx Y).

Theorem kernel_representation r : behavior S r <-> forall t, shifted N r t = 0.
Proof.
split=> [rB t | zero].
  apply/shifted_cols => j; apply: (annihilating_columns (col j N)).2 rB t; exists (col j (usubmx Y)).
  by rewrite -col_col_mx vsubmxK colE mulmxA kernel mul0mx.
apply/behaviorP => s; apply/word_annihilators => c /annihilates_kernel[b /generates[u]].
rewrite -{1}[Y]vsubmxK mul_col_mx => /eq_col_mx[_ cE].
have cs : (sizem (polym s c) <= s)%N by apply/sizem_leP => k sk; rewrite coefm_polym ltnNge sk.
have := shifted_mul u zero 0; rewrite -cE => <-; rewrite -(pairing_shifted _ _ cs).
by apply: eq_bigr => k _; rewrite coefm_polym ltn_ord.
Qed.

Theorem kernel_rows (c : 'cV[{poly K}]_p) : (forall r, behavior S r -> forall t, shifted c r t = 0) <-> exists u, c = N *m u.
Proof.
rewrite annihilating_columns; split=> [[b /generates[u]]|[u ->]].
  by rewrite -{1}[Y]vsubmxK mul_col_mx => /eq_col_mx[_ cE]; exists u.
by exists (usubmx Y *m u); rewrite -mul_col_mx vsubmxK mulmxA kernel mul0mx.
Qed.

End Kernel.

(** Ledger: the behaviour as a kernel. *)
Theorem minimal_kernel_representation (K : fieldType) n m p (S : system K n m p) d (Y : 'M_(n + p, d)) : minimal_basis (pencil S) Y ->
  [/\ d = (p - \rank (transfer S))%N, forall r, behavior S r <-> forall t, shifted (dsubmx Y) r t = 0
    & forall c : 'cV_p, (forall r, behavior S r -> forall t, shifted c r t = 0) <-> exists u, c = dsubmx Y *m u].
Proof.
move=> basis; have [ker gen _] := basis; split; last 2 first.
- exact: kernel_representation.
- exact: kernel_rows.
have := perm_size (etas_are_minimal_indices basis); rewrite size_map -cardE card_ord size_etas => ->.
by rewrite -(NormalRank.gap_normal_rank S (leqnn n)).
Qed.
