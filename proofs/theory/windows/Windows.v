(** The row space of window S s = [O_s T_s] is the set of words of length s. So inclusions and equalities of restricted behaviours, and
    problem (11), may be decided by row spaces; and its kernel is the set of all (x, v(0), ..., v(s-1)) with zero output.

    unsamples u k == sample k of the row u, and 0 from s on *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Sequences and their first s values in one row vector. *)
Section Samples.
Variables (K : fieldType) (p s : nat).
Implicit Types (r q : nat -> 'rV[K]_p) (u : 'rV[K]_(s * p)).

(** The sequence with the samples u, zero from s on. *)
Definition unsamples u k : 'rV[K]_p := oapp (fun j => row j (vec_mx u)) 0 (insub k : option 'I_s).

Lemma unsamples_lt u (k : 'I_s) : unsamples u k = row k (vec_mx u).
Proof. by rewrite /unsamples valK. Qed.

Lemma unsamples_ge u k : (s <= k)%N -> unsamples u k = 0.
Proof. by move=> sk; rewrite /unsamples insubF // ltnNge sk. Qed.

Lemma samples_ext r q : (forall k, (k < s)%N -> r k = q k) -> samples s r = samples s q.
Proof. by move=> e; congr mxvec; apply/row_matrixP=> k; rewrite !rowK e. Qed.

Lemma samplesK r k : (k < s)%N -> unsamples (samples s r) k = r k.
Proof. by move=> ks; rewrite (unsamples_lt _ (Ordinal ks)) mxvecK rowK. Qed.

Lemma unsamplesK u : samples s (unsamples u) = u.
Proof. by rewrite -[RHS]vec_mxK; congr mxvec; apply/row_matrixP=> k; rewrite rowK unsamples_lt. Qed.

Lemma samples_inj r q : samples s r = samples s q -> forall k, (k < s)%N -> r k = q k.
Proof. by move=> e k ks; rewrite -samplesK // e samplesK. Qed.

Lemma samples_add r q : samples s (fun k => r k + q k) = samples s r + samples s q.
Proof. by apply/rowP=> i; case/mxvec_indexP: i => k j; rewrite !(mxvecE, mxE). Qed.

Lemma samples_scale (a : K) r : samples s (fun k => a *: r k) = a *: samples s r.
Proof. by apply/rowP=> i; case/mxvec_indexP: i => k j; rewrite !(mxvecE, mxE). Qed.

Lemma samples_opp r : samples s (fun k => - r k) = - samples s r.
Proof. by rewrite -scaleN1r -samples_scale; apply: samples_ext => k _; rewrite scaleN1r. Qed.

Lemma samples_zero : samples s (fun=> 0 : 'rV[K]_p) = 0.
Proof. by apply/rowP=> i; case/mxvec_indexP: i => k j; rewrite !(mxvecE, mxE). Qed.

Lemma samples_eq0 r : samples s r = 0 <-> forall k, (k < s)%N -> r k = 0.
Proof.
rewrite -samples_zero; split=> [e k ks|e]; first exact: (samples_inj e).
exact: samples_ext.
Qed.

Lemma unsamples_linear (a : K) u w k : unsamples (a *: u + w) k = a *: unsamples u k + unsamples w k.
Proof.
have [ks|sk] := ltnP k s; last by rewrite !unsamples_ge // scaler0 addr0.
by rewrite !(unsamples_lt _ (Ordinal ks)); apply/rowP=> j; rewrite !mxE.
Qed.

Lemma unsamples_zero k : unsamples 0 k = 0.
Proof. by have := unsamples_linear (-1) 0 0 k; rewrite !scaleN1r oppr0 addr0 addNr. Qed.

End Samples.

Section Windows.
Variables (K : fieldType) (n m p : nat).
Implicit Types (S : system K n m p) (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (r : nat -> 'rV[K]_p) (s : nat).

(** What the two parts of the window do to an initial state and to faults. *)
Lemma mul_O S s x : x *m O S s = samples s (output S x (fun=> 0)).
Proof.
have lin : linear (fun y : 'rV[K]_n => samples s (output S y (fun=> 0))).
  move=> a y z; rewrite -samples_scale -samples_add; apply: samples_ext => k _.
  by rewrite -output_scale -output_add; apply: output_ext => j _; rewrite scaler0 addr0.
rewrite -[RHS](mul_lin1 x lin); congr (x *m _).
by apply/row_matrixP=> i; rewrite rowK [RHS]rowE (mul_lin1 _ lin) rowE mulmx1.
Qed.

Lemma mul_T S s (w : 'rV[K]_(s * m)) : w *m T S s = samples s (output S 0 (unsamples w)).
Proof.
have lin : linear (fun u : 'rV[K]_(s * m) => samples s (output S 0 (unsamples u))).
  move=> a y z; rewrite -samples_scale -samples_add; apply: samples_ext => k _.
  by rewrite -output_scale -output_add scaler0 addr0; apply: output_ext => j _; rewrite unsamples_linear.
rewrite -[RHS](mul_lin1 w lin); congr (w *m _).
by apply/row_matrixP=> i; rewrite rowK [RHS]rowE (mul_lin1 _ lin).
Qed.

Lemma mul_window S s x (w : 'rV[K]_(s * m)) : row_mx x w *m window S s = samples s (output S x (unsamples w)).
Proof.
by rewrite mul_row_col mul_O mul_T -samples_add; apply: samples_ext => k _; rewrite (output_split S x (unsamples w)).
Qed.

(** The kernel of the window: initial states and faults with zero output. *)
Lemma window_kernel S s x (w : 'rV[K]_(s * m)) :
  row_mx x w *m window S s = 0 <-> forall k, (k < s)%N -> output S x (unsamples w) k = 0.
Proof. by rewrite mul_window; apply: samples_eq0. Qed.

Lemma window_response S s x v : row_mx x (samples s v) *m window S s = samples s (output S x v).
Proof.
rewrite mul_window; apply: samples_ext => k ks; apply: output_ext => j jk.
by rewrite samplesK // (leq_ltn_trans jk ks).
Qed.

Theorem windowP S s r : (samples s r <= window S s)%MS <-> word S s r.
Proof.
split=> [/submxP[u]|[x [v h]]]; last by apply/submxP; exists (row_mx x (samples s v)); rewrite window_response; apply: samples_ext.
by rewrite -(hsubmxK u) mul_window => /samples_inj h; exists (lsubmx u), (unsamples (rsubmx u)).
Qed.

Lemma sub_windowP S s (u : 'rV[K]_(s * p)) : (u <= window S s)%MS <-> word S s (unsamples u).
Proof. by rewrite -windowP unsamplesK. Qed.

(** A matrix lies in the window as soon as all its combinations of rows are words. *)
Lemma matrix_sub_window S s a (M : 'M[K]_(a, s * p)) :
  (M <= window S s)%MS <-> forall u : 'rV[K]_a, word S s (unsamples (u *m M)).
Proof.
split=> [h u|h]; first by apply/sub_windowP; apply: submx_trans (submxMl _ _) h.
by apply/row_subP=> i; apply/sub_windowP; rewrite rowE.
Qed.

End Windows.

Section TwoSystems.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).
Implicit Types (s : nat) (r : nat -> 'rV[K]_p).

(** Inclusion and equality of restricted behaviours. *)
Theorem window_subP s : (window S' s <= window S s)%MS <-> (forall r, word S' s r -> word S s r).
Proof.
split=> [h r /windowP r_word|h]; first by apply/windowP; apply: submx_trans h.
apply/matrix_sub_window=> u; apply: h; apply/sub_windowP; exact: submxMl.
Qed.

(** Responses from rest, and free responses. *)
Theorem T_subP s : (T S' s <= window S s)%MS <-> (forall v, word S s (output S' 0 v)).
Proof.
rewrite matrix_sub_window; split=> h w.
  apply: word_ext (h (samples s w)) => k ks; rewrite mul_T samplesK //.
  by apply: output_ext => j jk; rewrite samplesK // (leq_ltn_trans jk ks).
by apply: word_ext (h (unsamples w)) => k ks; rewrite mul_T samplesK.
Qed.

Theorem O_subP s : (O S' s <= window S s)%MS <-> (forall x, word S s (output S' x (fun=> 0))).
Proof.
rewrite matrix_sub_window; split=> h x.
  by apply: word_ext (h x) => k ks; rewrite mul_O samplesK.
by apply: word_ext (h x) => k ks; rewrite mul_O samplesK.
Qed.

End TwoSystems.

Section Equality.
Variables (K : fieldType) (n m n' m' p : nat) (S : system K n m p) (S' : system K n' m' p).

Theorem window_eqP s : (window S s == window S' s)%MS <-> (forall r, word S s r <-> word S' s r).
Proof.
split=> [/andP[/window_subP h /window_subP h'] r|h]; first by split; [apply: h|apply: h'].
by apply/andP; split; apply/window_subP => r /h.
Qed.

End Equality.

(** Problem (11) in words: all responses of the candidate columns from rest are words. *)
Section Problem11.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Theorem solvesP s (f : 'rV[K]_n) (g : 'rV[K]_p) : solves S s f g <-> (forall v, word S s (output (with_faults S f g) 0 v)).
Proof. exact: T_subP. Qed.

Theorem solves_words s (f : 'rV[K]_n) (g : 'rV[K]_p) : solves S s f g <-> (forall r, word (with_faults S f g) s r -> word S s r).
Proof. by rewrite solvesP; apply: word_from_rest. Qed.

End Problem11.
