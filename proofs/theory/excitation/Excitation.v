(** From the model to data. The Hankel matrix R_s of a measured output is the window times [X V_s], the states and fault windows behind
    it. So where [X V_s] has full rank, R_s has the row space of [O_s T_s], and ranks, gap and problem (11) may be computed from the
    data. The exact condition is weaker: the rows of [X V_s] together with the kernel of the window must span everything. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Gap Proposition3.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Data.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (N s : nat).

(** R_s = [X V_s] [O_s T_s], in rows. *)
Theorem hankel_output x v N s : hankel N s (output S x v) = excitation S x v N s *m window S s.
Proof.
apply/row_matrixP=> i; rewrite row_mul !rowK window_response; apply: samples_ext => k _.
exact: output_shift.
Qed.

Lemma samples_sum q s (I : finType) (f : I -> nat -> 'rV[K]_q) : samples s (fun k => \sum_i f i k) = \sum_i samples s (f i).
Proof. by apply/rowP=> l; case/mxvec_indexP: l => k j; rewrite mxvecE mxE !summxE; apply: eq_bigr => i _; rewrite mxvecE mxE. Qed.

Lemma hankel_sub_window x v N s : (hankel N s (output S x v) <= window S s)%MS.
Proof. by rewrite hankel_output submxMl. Qed.

(** The combinations of rows of [X V_s]. *)
Lemma excitationP x v N s y w : (row_mx y (samples s w) <= excitation S x v N s)%MS <->
  exists c : 'I_N -> K, y = \sum_i c i *: state S x v i /\ forall k, (k < s)%N -> w k = \sum_i c i *: v (i + k)%N.
Proof.
have combine (c : 'I_N -> K) : \sum_i c i *: row i (excitation S x v N s) =
    row_mx (\sum_i c i *: state S x v i) (samples s (fun k => \sum_i c i *: v (i + k)%N)).
  rewrite -[LHS]hsubmxK !linear_sum /= samples_sum; congr row_mx; apply: eq_bigr => i _.
    by rewrite rowK scale_row_mx row_mxKl.
  by rewrite rowK scale_row_mx row_mxKr samples_scale.
split=> [/submxP[c]|[c [-> e]]].
  by rewrite mulmx_sum_row combine => /eq_row_mx[-> /samples_inj]; exists (fun i => c 0 i).
by rewrite (samples_ext e) -combine summx_sub // => i _; rewrite scalemx_sub ?row_sub.
Qed.

(** More windows, or shorter ones, are excited as well. *)
Lemma excitation_more x v N N' s : (N' <= N)%N -> (excitation S x v N' s <= excitation S x v N s)%MS.
Proof.
move=> N'N; apply/row_subP=> i; rewrite rowK.
by rewrite -(rowK (fun i : 'I_N => row_mx (state S x v i) (samples s (fun k => v (i + k)%N))) (widen_ord N'N i)) row_sub.
Qed.

Lemma excitation_shorter x v N s : row_full (excitation S x v N s.+1) -> row_full (excitation S x v N s).
Proof.
rewrite -!sub1mx => full; apply/row_subP=> i; rewrite -[row i _]hsubmxK -[rsubmx _]unsamplesK; apply/excitationP.
have /excitationP[c [e h]] := submx_trans (submx1 (row_mx (lsubmx (row i 1%:M)) (samples s.+1 (unsamples (rsubmx (row i 1%:M)))))) full.
by exists c; split=> // k ks; apply: h; apply: leqW.
Qed.

(** Full rank: everything is as in the model. *)
Theorem full_excitation x v N s : row_full (excitation S x v N s) -> (hankel N s (output S x v) :=: window S s)%MS.
Proof. by move=> full; rewrite hankel_output; apply: eqmxMfull. Qed.

Theorem rank_hankel x v N s : row_full (excitation S x v N s) -> \rank (hankel N s (output S x v)) = \rank (window S s).
Proof. by move/full_excitation->. Qed.

(** The rank gap of the data, N windows of s samples and N' of s + 1. Full rank at s + 1 is what it takes. *)
Theorem gap_of_data x v N N' s : (N' <= N)%N -> row_full (excitation S x v N' s.+1) ->
  \rank (hankel N' s.+1 (output S x v)) = (\rank (hankel N s (output S x v)) + gap S s)%N.
Proof.
move=> N'N full; rewrite !rank_hankel ?rank_window_step //.
have := excitation_shorter full; rewrite -!sub1mx => h.
exact: submx_trans h (excitation_more _ _ _ N'N).
Qed.

Corollary proposition_3_of_data x v N N' s : (N' <= N)%N -> row_full (excitation S x v N' s.+1) -> (n <= s)%N ->
  \rank (hankel N' s.+1 (output S x v)) = (\rank (hankel N s (output S x v)) + m)%N <-> left_invertible S.
Proof. by move=> N'N full ns; rewrite (gap_of_data N'N full) -(gap_left_invertible S ns); split=> [/addnI|->]. Qed.

(** Problem (11) from the data. *)
Theorem data_solvesP x v N s f g : (window S s <= hankel N s (output S x v))%MS ->
  data_solves S N s (output S x v) f g <-> solves S s f g.
Proof. by move=> sub; split=> h; apply: submx_trans h _ => //; apply: hankel_sub_window. Qed.

Corollary full_excitation_solves x v N s f g : row_full (excitation S x v N s) ->
  data_solves S N s (output S x v) f g <-> solves S s f g.
Proof. by move=> full; apply: data_solvesP; rewrite full_excitation. Qed.

(** The exact condition for the data to have the row space of the model. *)
Theorem exact_excitation x v N s : (hankel N s (output S x v) == window S s)%MS =
  row_full (col_mx (excitation S x v N s) (kermx (window S s))).
Proof.
rewrite hankel_sub_window /= hankel_output -sub1mx -addsmxE; apply/idP/idP=> [/submxP[D e]|].
  rewrite -[1%:M](addrNK (D *m excitation S x v N s)) addrC addmx_sub_adds ?submxMl //.
  by apply/sub_kermxP; rewrite mulmxBl mul1mx -mulmxA -e subrr.
case/sub_addsmxP=> -[D E] /= /(congr1 (mulmx^~ (window S s))).
rewrite mul1mx mulmxDl -(mulmxA E) mulmx_ker mulmx0 addr0 -mulmxA => e; rewrite {1}e; apply: submxMl.
Qed.

End Data.
