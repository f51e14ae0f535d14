(** theorem-3, repaired: with the same (A, C), inclusion of the behaviours and equal normal rank force equality. So an included system
    with as many faults is equal as soon as it, the smaller one, is left-invertible. Proof by duality: the annihilators of the larger
    behaviour are among those of the smaller; both are kernels of pencils, of one dimension over the rational functions, hence the same;
    and the behaviours are what their annihilators annihilate. One sample more than the lag of the larger system is enough, so n + 1 are.
    And one fault on an observable (A, C): every nonzero solution of problem (11) is an equivalent fault. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra vector fraction.
From faultspace Require Import Vocabulary Basics Windows Infinite Lag SharpWindows
  PolynomialKernel Inversion TransferRank Annihilator Solutions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section SameAC.
Variables (K : fieldType) (n m m' p : nat) (S : system K n m p) (S' : system K n m' p).
Hypotheses (sameA : sysA S' = sysA S) (sameC : sysC S' = sysC S).

(** The costate is determined by c. *)
Lemma costate_unique (b b' : 'cV_n) (c : 'cV_p) : pencil S *m col_mx b c = 0 -> pencil S' *m col_mx b' c = 0 -> b' = b.
Proof.
rewrite !col_pencil sameA sameC -[X in _ = X]col_mx0 => /eq_col_mx[e _]; rewrite -[X in _ = X]col_mx0 => /eq_col_mx[e' _].
have : ('X%:M - map_mx polyC (sysA S)) *m (b' - b) = 0.
  rewrite mulmxBr !mulmxBl !mul_scalar_mx; apply/eqP; rewrite subr_eq0.
  by apply/eqP/(addIr (map_mx polyC (sysC S) *m c)); rewrite e e'.
move/(congr1 (@over_fractions K _ _)); rewrite /over_fractions map_mxM map_mx0.
move/(congr1 (mulmx (invmx (over_fractions ('X%:M - map_mx polyC (sysA S)))))).
by rewrite mulmx0 mulKmx ?resolvent_unit // => /over_eq0/eqP; rewrite subr_eq0 => /eqP.
Qed.

Lemma included_words_pencil : (forall s r, word S' s r -> word S s r) ->
  (over_fractions (pencil S') <= over_fractions (pencil S))%MS.
Proof.
move=> sub; apply/row_space_over_fractions => y; rewrite -[y]vsubmxK; move: (usubmx y) (dsubmx y) => b c {y} ker.
have [b' ker'] : exists b' : 'cV_n, pencil S' *m col_mx b' (polym (sizem c) (fun k => coefm k c)) = 0.
  by apply: annihilates_kernel => r /sub; apply: (kernel_annihilates ker).
have c_eq : polym (sizem c) (fun k => coefm k c) = c.
  by apply/coefmP => k; rewrite coefm_polym; case: ltnP => // sk; apply/esym; apply: (sizem_leP _ _ (leqnn _)).
by rewrite c_eq in ker'; rewrite -(costate_unique ker ker').
Qed.

Lemma pencil_included_words : (over_fractions (pencil S') <= over_fractions (pencil S))%MS ->
  forall s r, word S' s r -> word S s r.
Proof.
move/row_space_over_fractions => sub s r wr; apply/word_annihilators => c /annihilates_kernel[b /sub ker].
have := kernel_annihilates ker; rewrite /annihilates => ann.
transitivity (pairing s r (fun k => coefm k (polym s c))).
  by apply: eq_bigr => k _; rewrite coefm_polym ltn_ord.
by apply: ann wr; apply/sizem_leP => k sk; rewrite coefm_polym ltnNge sk.
Qed.

End SameAC.

Section Equality.
Variables (K : fieldType) (n m m' p : nat) (S : system K n m p) (S' : system K n m' p).
Hypotheses (sameA : sysA S' = sysA S) (sameC : sysC S' = sysC S).

(** Inclusion of behaviours is inclusion of row spaces of pencils; equality is then equality of normal ranks. *)
Theorem included_words_iff_pencil :
  (forall s r, word S' s r -> word S s r) <-> (over_fractions (pencil S') <= over_fractions (pencil S))%MS.
Proof. by split; [apply: included_words_pencil | apply: pencil_included_words]. Qed.

Theorem equal_words_iff_normal_rank : (forall s r, word S' s r -> word S s r) ->
  (forall s r, word S s r <-> word S' s r) <-> \rank (transfer S') = \rank (transfer S).
Proof.
move=> sub; have sub_pencil := included_words_pencil sameA sameC sub; split=> [eq_words | eq_rank].
  have := included_words_pencil (esym sameA) (esym sameC) (fun s r => (eq_words s r).1).
  move=> sup; have /eqmx_rank : (over_fractions (pencil S') == over_fractions (pencil S))%MS by rewrite sub_pencil sup.
  by rewrite !pencil_rank_transfer => /addnI.
have sup : (over_fractions (pencil S) <= over_fractions (pencil S'))%MS.
  by rewrite -(geq_leqif (mxrank_leqif_sup sub_pencil)) !pencil_rank_transfer eq_rank.
by move=> s r; split; [apply: pencil_included_words sup s r | apply: sub].
Qed.

(** The smaller system has as many faults and is left-invertible. *)
Theorem equal_words_of_left_invertible : (m <= m')%N -> left_invertible S' -> (forall s r, word S' s r -> word S s r) ->
  forall s r, word S s r <-> word S' s r.
Proof.
move=> mm' /left_invertible_transfer_rank full sub; apply/(equal_words_iff_normal_rank sub).
have := mxrankS (included_words_pencil sameA sameC sub); rewrite !pencil_rank_transfer leq_add2l => le.
by apply/eqP; rewrite eqn_leq le full (leq_trans (rank_leq_row _)).
Qed.

(** theorem-3: lag + 1 samples, or more, are enough; equality holds on all windows and in infinite time. *)
Theorem theorem_3_sharp N : (lag S <= N)%N -> (m <= m')%N -> left_invertible S' -> (forall r, word S' N.+1 r -> word S N.+1 r) ->
  (forall s r, word S s r <-> word S' s r) /\ (forall r, behavior S r <-> behavior S' r).
Proof.
move=> lagN mm' invertible /(words_on_lag_plus_1_samples _ lagN) sub.
have eq_words := equal_words_of_left_invertible mm' invertible sub.
by split=> //; apply/behavior_eqP.
Qed.

Theorem theorem_3 N : (n <= N)%N -> (m <= m')%N -> left_invertible S' -> (forall r, word S' N.+1 r -> word S N.+1 r) ->
  (forall s r, word S s r <-> word S' s r) /\ (forall r, behavior S r <-> behavior S' r).
Proof. by move=> nN; apply: theorem_3_sharp; apply: leq_trans (lag_le_n S) nN. Qed.

Theorem equal_behaviors_normal_rank :
  (forall r, behavior S r <-> behavior S' r) -> \rank (transfer S') = \rank (transfer S).
Proof. by move/behavior_eqP => e; apply/equal_words_iff_normal_rank => // s r /e. Qed.

End Equality.

(** Pairs (F, G) = P Z made of the solutions of problem (11), for one window s >= lag + 1. *)
Section Pairs.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s k : nat) (Z : 'M[K]_(k, n + p)).

(** Part (i), for any window: the columns (rows here) of every equivalent pair are solutions, so the pair is P Z for some P. *)
Theorem theorem_3_part_i m' (F : 'M_(m', n)) (G : 'M_(m', p)) : (forall r, behavior (with_faults S F G) r <-> behavior S r) ->
  (forall i, solves S s (row i F) (row i G)) /\ (spans_solutions S s Z -> exists P, row_mx F G = P *m Z).
Proof.
move=> /behavior_eqP e; split; first by apply/solution_rows => r /e.
by move=> span; apply/submxP/(included_rows F G span) => r /e.
Qed.

End Pairs.

Section Criterion.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s k : nat) (Z : 'M[K]_(k, n + p)).
Hypotheses (long : (lag S < s)%N) (span : spans_solutions S s Z).

(** The exact criterion: the pair P Z, with any number of faults, is equivalent iff it has the normal rank of S. *)
Theorem theorem_3_normal_rank_sharp m' (P : 'M_(m', k)) :
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> \rank (transfer (faults_of S (P *m Z))) = \rank (transfer S).
Proof.
have sub : forall t r, word (faults_of S (P *m Z)) t r -> word S t r.
  case: s long span => // N lagN spanN.
  have := (words_on_lag_plus_1_samples (faults_of S (P *m Z)) lagN).1; apply; apply/(included_rows _ _ spanN).
  by rewrite hsubmxK submxMl.
have eq_rank := @equal_words_iff_normal_rank K n m m' p S (faults_of S (P *m Z)) erefl erefl sub.
by rewrite -eq_rank behavior_eqP; split=> e t r; split=> /e.
Qed.

Theorem theorem_3_criterion_sharp (P : 'M_(m, k)) : left_invertible S ->
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> left_invertible (faults_of S (P *m Z)).
Proof. by rewrite theorem_3_normal_rank_sharp !left_invertible_transfer_rank => ->. Qed.

End Criterion.

(** The same with n in the place of the lag. *)
Section WithN.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s k : nat) (Z : 'M[K]_(k, n + p)).
Hypotheses (long : (n < s)%N) (span : spans_solutions S s Z).
Let longer : (lag S < s)%N. Proof. exact: leq_ltn_trans (lag_le_n S) long. Qed.

Theorem theorem_3_normal_rank m' (P : 'M_(m', k)) :
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> \rank (transfer (faults_of S (P *m Z))) = \rank (transfer S).
Proof. exact: (theorem_3_normal_rank_sharp longer span P). Qed.

Theorem theorem_3_criterion (P : 'M_(m, k)) : left_invertible S ->
  (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> left_invertible (faults_of S (P *m Z)).
Proof. exact: (theorem_3_criterion_sharp longer span P). Qed.

End WithN.

(** One fault. *)
Section SingleFault.
Variables (K : fieldType) (n p : nat).

Lemma observable_single_left_invertible (S : system K n 1 p) : row_free (O S n) -> row_mx (sysF S) (sysG S) != 0 -> left_invertible S.
Proof.
move=> obs nonzero; apply: (delay_left_invertible (l := n)) => v silent; rewrite [v 0%N]mx11_scalar.
suff -> : v 0%N 0 0 = 0 by exact: raddf0.
apply: contraNeq nonzero => v0; apply/eqP.
have cancel a (M : 'M_(1, a)) : v 0%N *m M = 0 -> M = 0.
  by rewrite [v 0%N]mx11_scalar mul_scalar_mx => /eqP; rewrite scaler_eq0 (negPf v0) => /eqP.
have G0 : sysG S = 0 by apply: cancel; have := silent 0%N isT; rewrite /output /= mul0mx add0r.
suff F0 : sysF S = 0 by rewrite F0 G0 row_mx0.
have free_zero k : (k < n)%N -> output S (sysF S) (fun=> 0) k = 0.
  move: k; suff prefix j : (j <= n)%N -> forall k, (k < j)%N -> output S (sysF S) (fun=> 0) k = 0 by apply: (prefix n).
  elim: j => // j IH jn k; rewrite ltnS leq_eqVlt => /orP[/eqP ->|]; last exact: IH (ltnW jn) k.
  have before := IH (ltnW jn).
  have scaled (w : 'rV_1) i : output S (w *m sysF S) (fun=> 0) i = w *m output S (sysF S) (fun=> 0) i.
    rewrite [w]mx11_scalar !mul_scalar_mx -output_scale; apply: output_ext => l _; by rewrite scaler0.
  have quiet (w : nat -> 'rV_1) i : (i <= j)%N -> output S 0 w i = 0.
    elim: i w => [|i IHi] w ij; first by rewrite /output mul0mx G0 mulmx0 addr0.
    by rewrite output_step mul0mx add0r output_split IHi ?(ltnW ij) // scaled before // mulmx0 addr0.
  apply: cancel; rewrite -scaled; have := silent j.+1 jn.
  by rewrite output_step mul0mx add0r output_split quiet // addr0.
by apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0.
Qed.

Theorem single_fault (S : system K n 1 p) s k (Z : 'M[K]_(k, n + p)) (P : 'rV_k) : (lag S < s)%N -> spans_solutions S s Z ->
  left_invertible S -> row_free (O S n) -> P *m Z != 0 -> forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r.
Proof.
move=> long span inv obs nonzero; apply/(theorem_3_criterion_sharp long span P inv).
apply: observable_single_left_invertible; last by rewrite hsubmxK.
suff -> : O (faults_of S (P *m Z)) n = O S n by [].
by apply/row_matrixP => i; rewrite !rowK; apply: samples_ext => j _; rewrite output_free.
Qed.

End SingleFault.
