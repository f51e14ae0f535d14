(** What the data must excite. It is enough that the rows of [X V_s] contain, or are, the pairs of a state in U and of s faults, where A
    leaves U in place and U contains the rows of F: then problem (11) computed from the data is right from s = n + 1 on (or from one past
    the last change of the gap), and so, with s + 1 for s, is the gap of a left-invertible system from lag on. So a mode that the faults
    never reach and that x(0) does not excite changes neither. Persistency of excitation of v is enough, of order n + s for problem (11),
    of order n + s + 1 for the gap.

    pairs_from U s == all pairs of a state in U and of s faults *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Gap Proposition3 Lag SharpWindows.
From faultspace Require Import Problem11 Excitation Reachable Persistency.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section WeakExcitation.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (N s : nat) (U : 'M[K]_n).

(** All pairs of a state in U and of s faults. *)
Definition pairs_from U s : 'M[K]_(n + s * m) := block_mx U 0 0 1%:M.

Lemma pairs_fromP U s y (w : 'rV_(s * m)) : (row_mx y w <= pairs_from U s)%MS = (y <= U)%MS.
Proof.
apply/submxP/submxP=> [[c]|[c ->]].
  by rewrite -(hsubmxK c) mul_row_block !mulmx0 mulmx1 addr0 => /eq_row_mx[-> _]; exists (lsubmx c).
by exists (row_mx c w); rewrite mul_row_block !mulmx0 mulmx1 addr0 add0r.
Qed.

(** They give the words of S restricted to U. *)
Lemma pairs_window U s : holds_reachable S U -> (pairs_from U s *m window S s :=: window (restricted S U) s)%MS.
Proof.
move=> hU; apply/eqmxP/andP; split.
  apply/matrix_sub_window=> u; apply/restricted_word => //; rewrite mulmxA; set y := u *m _.
  exists (lsubmx y), (unsamples (rsubmx y)); split; first by rewrite -(pairs_fromP U (lsubmx y) (rsubmx y)) hsubmxK submxMl.
  by move=> k ks; rewrite -[y in unsamples (y *m _)]hsubmxK mul_window samplesK.
apply/row_subP=> i; have /sub_windowP/(restricted_word hU)[x [v [xU e]]] := row_sub i (window (restricted S U) s).
rewrite -[row i _]unsamplesK (samples_ext e) -window_response; apply: submxMr; by rewrite pairs_fromP.
Qed.

Section Data.
Variables (U : 'M[K]_n) (x : 'rV[K]_n) (v : nat -> 'rV[K]_m).
Hypothesis U_reachable : holds_reachable S U.
Let r := output S x v.

(** Problem (11). *)
Theorem weak_excitation_solves_settled_gap N s f g : (forall t, (s <= t)%N -> gap S t = gap S s) ->
  (pairs_from U s.+1 <= excitation S x v N s.+1)%MS -> data_solves S N s.+1 r f g <-> solves S s.+1 f g.
Proof.
move=> settled excited; split=> [h|]; first by apply: submx_trans h (hankel_sub_window _ _ _ _ _).
move/(problem_11_settled_gap f g settled)/behavior_from_rest/(from_rest_in_restricted U_reachable) => h.
rewrite /data_solves hankel_output; apply: submx_trans (submxMr _ excited); rewrite pairs_window //; apply/T_subP => w; exact: h.
Qed.

Theorem weak_excitation_solves N s f g : (n < s)%N -> (pairs_from U s <= excitation S x v N s)%MS ->
  data_solves S N s r f g <-> solves S s f g.
Proof.
case: s => // s ns; apply: weak_excitation_solves_settled_gap => t st.
by rewrite !gap_constant // (leq_trans _ st).
Qed.

(** Ranks and gap. *)
Lemma rank_hankel_restricted N s : (excitation S x v N s :=: pairs_from U s)%MS ->
  \rank (hankel N s r) = \rank (window (restricted S U) s).
Proof. by move=> e; rewrite hankel_output (eqmxMr _ e) pairs_window. Qed.

Theorem weak_excitation_gap N N' s : left_invertible S -> gap S s = m ->
  (excitation S x v N s :=: pairs_from U s)%MS -> (excitation S x v N' s.+1 :=: pairs_from U s.+1)%MS ->
  \rank (hankel N' s.+1 r) = (\rank (hankel N s r) + m)%N.
Proof. by move=> linv g e e'; rewrite !rank_hankel_restricted // rank_window_step (gap_restricted_left_invertible U_reachable linv g). Qed.

Theorem weak_excitation_proposition_3 N N' s : (n <= s)%N ->
  (excitation S x v N s :=: pairs_from U s)%MS -> (excitation S x v N' s.+1 :=: pairs_from U s.+1)%MS ->
  \rank (hankel N' s.+1 r) = (\rank (hankel N s r) + m)%N <-> left_invertible S.
Proof.
move=> ns e e'; rewrite !rank_hankel_restricted // -(restricted_left_invertible U_reachable).
by apply: proposition_3; apply: leq_trans (rank_leq_row U) ns.
Qed.

End Data.

(** Full rank at s + 1: the gap of the data is m from the lag on, and never before. *)
Theorem excitation_at_s_plus_1 x v N N' s : left_invertible S -> (N' <= N)%N -> row_full (excitation S x v N' s.+1) ->
  \rank (hankel N' s.+1 (output S x v)) = (\rank (hankel N s (output S x v)) + m)%N <-> (lag S <= s)%N.
Proof.
move=> linv N'N full; rewrite (gap_of_data N'N full) -(lagP S) last_gap_is_m //.
by split=> [/addnI|->].
Qed.

(** Persistency of excitation: of order n + s for problem (11), of order n + s + 1 for the gap. *)
Section Persistent.
Variables (x : 'rV[K]_n) (v : nat -> 'rV[K]_m).
Let r := output S x v.

Lemma persistency_shorter M s : persistently_exciting M s.+1 v -> persistently_exciting M s v.
Proof.
rewrite /persistently_exciting -!sub1mx => full; apply/row_subP=> i; rewrite -[row i _]unsamplesK.
have /submxP[c] := submx_trans (submx1 (samples s.+1 (unsamples (row i (1%:M : 'M_(s * m)))))) full.
rewrite mulmx_sum_row => e; apply/submxP; exists c; rewrite mulmx_sum_row; move: e.
under eq_bigr => j _ do rewrite rowK -samples_scale; rewrite -samples_sum => /samples_inj e.
by under [in RHS]eq_bigr => j _ do rewrite rowK -samples_scale; rewrite -samples_sum; apply: samples_ext => k ks; rewrite e // leqW.
Qed.

Theorem persistency_solves M s f g : persistently_exciting M (n + s) v -> (n < s)%N ->
  data_solves S (n + M) s r f g <-> solves S s f g.
Proof.
move=> pe ns; apply: (weak_excitation_solves (excitable_reachable S x)) => //.
by rewrite (persistency_excites S x pe).
Qed.

Theorem persistency_solves_settled_gap M s f g : persistently_exciting M (n + s.+1) v -> (forall t, (s <= t)%N -> gap S t = gap S s) ->
  data_solves S (n + M) s.+1 r f g <-> solves S s.+1 f g.
Proof.
move=> pe settled; apply: (weak_excitation_solves_settled_gap (excitable_reachable S x)) => //.
by rewrite (persistency_excites S x pe).
Qed.

Lemma persistency_more M M' s : (M <= M')%N -> persistently_exciting M s v -> persistently_exciting M' s v.
Proof.
rewrite /persistently_exciting -!sub1mx => MM' /submx_trans; apply; apply/row_subP=> i.
by rewrite rowK -(rowK (fun i : 'I_M' => samples s (fun k => v (i + k)%N)) (widen_ord MM' i)) row_sub.
Qed.

(** R_s with one window more than R_(s+1), as the same samples give. *)
Theorem persistency_gap M s : persistently_exciting M (n + s.+1) v -> left_invertible S -> gap S s = m ->
  \rank (hankel (n + M) s.+1 r) = (\rank (hankel (n + M).+1 s r) + m)%N.
Proof.
move=> pe linv g; apply: (weak_excitation_gap (excitable_reachable S x)) => //; last exact: persistency_excites.
rewrite -addnS; apply: persistency_excites; apply: persistency_more (leqnSn M) _.
by apply: persistency_shorter; rewrite -addnS.
Qed.

Theorem persistency_proposition_3 M s : persistently_exciting M (n + s.+1) v -> (n <= s)%N ->
  \rank (hankel (n + M) s.+1 r) = (\rank (hankel (n + M).+1 s r) + m)%N <-> left_invertible S.
Proof.
move=> pe ns; apply: (weak_excitation_proposition_3 (excitable_reachable S x)) => //; last exact: persistency_excites.
rewrite -addnS; apply: persistency_excites; apply: persistency_more (leqnSn M) _.
by apply: persistency_shorter; rewrite -addnS.
Qed.

(** From the lag on. *)
Theorem persistency_solves_from_lag M s f g : persistently_exciting M (n + s.+1) v -> (lag S <= s)%N ->
  data_solves S (n + M) s.+1 r f g <-> solves S s.+1 f g.
Proof.
move=> pe ls; apply: persistency_solves_settled_gap pe _ => t st.
by rewrite (gap_from_lag ls) gap_from_lag // (leq_trans ls).
Qed.

Theorem persistency_gap_from_lag M s : persistently_exciting M (n + s.+1) v -> left_invertible S -> (lag S <= s)%N ->
  \rank (hankel (n + M) s.+1 r) = (\rank (hankel (n + M).+1 s r) + m)%N.
Proof. by move=> pe linv /(lagP S) e; apply: persistency_gap => //; rewrite e last_gap_is_m. Qed.

End Persistent.
End WeakExcitation.
