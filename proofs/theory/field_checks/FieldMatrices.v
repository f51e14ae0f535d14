(** Ranks of named matrices of a system told by lists of numbers: O_n, T_s, [O_s T_s], reachability, and of a trajectory the Hankel matrix
    of its outputs and the excitation. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Basics.
From faultspace Require Import Stacks NumbersVocabulary NumberLists CheckMatrices FieldRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Sound.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Variables (n m p : nat) (L : listing R) (r : nat) (nulls combinations : seq (nat * seq (numeral R))).
Let S := system_of value n m p L.
Notation vec := (vector_of value).
Notation mat := (matrix_of value).
Notation table := (seq (seq (numeral R))).

(** A table is the matrix, with rows and columns in another order. *)
Lemma rank_in_order a b a' b' (T : table) (M : 'M[K]_(a', b')) (f : 'I_a -> 'I_a') (g : 'I_b -> 'I_b') :
  has_rank a b r T nulls combinations -> (forall i, exists j, f j == i) -> (forall i, exists j, g j == i) ->
  (forall (i : 'I_a) (j : 'I_b), value (at_place (nth [::] T i) j) = M (f i) (g j)) -> \rank M = r.
Proof.
move=> /(rank_of_table meaning) <- f_onto g_onto e.
have part c d c' d' (X : 'M[K]_(c, d)) (Y : 'M[K]_(c', d')) (h : 'I_c -> 'I_c') (k : 'I_d -> 'I_d') :
    (forall i j, X i j = Y (h i) (k j)) -> (\rank X <= \rank Y)%N.
  move=> eq; pose P : 'M[K]_(c, c') := \matrix_(i, j) (j == h i)%:R; pose Q : 'M[K]_(d', d) := \matrix_(i, j) (i == k j)%:R.
  have -> : X = P *m Y *m Q.
    apply/matrixP => i j; rewrite eq [RHS]mxE (bigD1 (k j)) //= big1 => [|j' /negPf jk]; last by rewrite [X in _ * X]mxE jk mulr0.
    rewrite [X in _ = _ * X + _]mxE eqxx mulr1 addr0 mxE (bigD1 (h i)) //= big1 => [|i' /negPf ih].
      by rewrite [X in _ = X * _ + _]mxE eqxx mul1r addr0.
    by rewrite [X in X * _]mxE ih mul0r.
  by apply: leq_trans (mxrankM_maxl _ _) _; apply: mxrankM_maxr.
apply/eqP; rewrite eqn_leq (part _ _ _ _ (mat a b T) M f g) ?andbT => [|i j]; last by rewrite mxE e.
apply: (part _ _ _ _ M _ (fun i => xchoose (f_onto i)) (fun j => xchoose (g_onto j))) => i j.
by rewrite mxE e (eqP (xchooseP (f_onto i))) (eqP (xchooseP (g_onto j))).
Qed.

Lemma place_in_line q (us : table) (j : nat) : (j < size us * q)%N -> at_place (in_line q us) j = at_place (nth [::] us (j %/ q)) (j %% q).
Proof.
elim: us j => [|u us IH] j /=; first by rewrite mul0n.
rewrite mulSn /at_place nth_cat size_mkseq => lt; case: ltnP => jp; first by rewrite nth_mkseq // divn_small // modn_small.
have q0 : (0 < q)%N by move: lt jp; case: (q) => // ; lia.
rewrite -[nth _ (flatten _) _]/(at_place (in_line q us) (j - q)) IH; last by lia.
have -> : j = (1 * q + (j - q))%N by lia.
by rewrite divnMDl // modnMDl add1n mul1n addKn.
Qed.

Lemma free_places s (i : 'I_n) (j : 'I_(s * p)) : sized n m p L ->
  value (at_place (nth [::] (free_rows n p s L) i) j) = O S s i (position j).
Proof.
move=> wf; rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n place_in_line; last by rewrite outputs_size size_nseq.
transitivity (vec p (nth [::] (outputs L (unit_row R n i) (nseq s [::])) (j %/ p)) 0 (Ordinal (output_lt j))); first by rewrite mxE.
rewrite (outputs_output meaning wf) ?size_nseq ?sample_lt // (unit_row_vec meaning) [RHS]mxE mxvecE [RHS]mxE.
congr (fun_of_matrix _ 0 _); apply: output_ext => k _; by rewrite /signal_of nth_nseq if_same (vec_nil meaning).
Qed.

Lemma forced_places s (i : 'I_(s * m)) (j : 'I_(s * p)) : sized n m p L ->
  value (at_place (nth [::] (forced_rows m p s L) i) j) = T S s (position i) (position j).
Proof.
move=> wf; have ps : size (unit_pulse R m s i) = s by rewrite size_map size_iota.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n place_in_line; last by rewrite outputs_size ps.
transitivity (vec p (nth [::] (outputs L [::] (unit_pulse R m s i)) (j %/ p)) 0 (Ordinal (output_lt j))); first by rewrite mxE.
have ks := sample_lt j; rewrite (outputs_output meaning wf) ?ps // (vec_nil meaning) [RHS]mxE mxvecE [RHS]mxE.
congr (fun_of_matrix _ 0 _); apply: output_ext => k kj; have k_s : (k < s)%N := leq_ltn_trans kj ks.
rewrite /signal_of (nth_map 0%N) ?size_iota // nth_iota // add0n /pulse insubT /= vec_mx_delta.
case: eqP => [ki|ki].
  apply/rowP => t; rewrite (unit_row_vec meaning (Ordinal (output_lt i))) !mxE.
  by rewrite -[Ordinal k_s == _]val_eqE /= (introT eqP ki) eq_sym.
rewrite (vec_nil meaning); apply/rowP => t; rewrite !mxE.
by rewrite -val_eqE /=; move/eqP/negPf: ki => ->.
Qed.

Theorem observability_rank : observability_has_rank n m p r L nulls combinations -> \rank (O S n) = r.
Proof.
case/andP=> wf ok; apply: (rank_in_order (f := id) (g := @position n p)) ok _ _ _ => [i||i j]; [by exists i|exact: position_onto|].
by rewrite free_places.
Qed.

Theorem toeplitz_rank s : toeplitz_has_rank n m p s r L nulls combinations -> \rank (T S s) = r.
Proof.
case/andP=> wf ok; apply: (rank_in_order (f := @position s m) (g := @position s p)) ok _ _ _ => [||i j]; try exact: position_onto.
by rewrite forced_places.
Qed.

Theorem window_rank s : window_has_rank n m p s r L nulls combinations -> \rank (window S s) = r.
Proof.
case/andP=> wf ok; apply: (rank_in_order (f := @behind_states n m s) (g := @position s p)) ok _ _ _ => [||i j].
- exact: behind_states_onto.
- exact: position_onto.
rewrite nth_cat size_map size_iota /behind_states; case: (split_ordP i) => t -> /=.
  by rewrite /window col_mxEu free_places.
by rewrite addKn /window col_mxEd forced_places.
Qed.

(** Of the trajectory from x under the faults vs. *)
Theorem hankel_rank N s x vs : hankel_has_rank n m p N s r L x vs nulls combinations ->
  \rank (hankel N s (output S (vec n x) (signal_of value m vs))) = r.
Proof.
case/and3P=> wf /eqP sizes ok.
apply: (rank_in_order (f := id) (g := @position s p)) ok _ _ _ => [i||i j]; [by exists i|exact: position_onto|].
have ks := sample_lt j; have iN := ltn_ord i; have so : size (outputs L x vs) = size vs by rewrite outputs_size.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n place_in_line; last by rewrite size_takel ?size_drop ?so //; lia.
rewrite nth_take // nth_drop; set k := (j %/ p)%N in ks *.
transitivity (vec p (nth [::] (outputs L x vs) (i + k)) 0 (Ordinal (output_lt j))); first by rewrite mxE.
rewrite (outputs_output meaning wf); last by lia.
by rewrite [RHS]mxE mxvecE [RHS]mxE.
Qed.

Theorem excitation_rank N s x vs : excitation_has_rank n m p N s r L x vs nulls combinations ->
  \rank (excitation S (vec n x) (signal_of value m vs) N s) = r.
Proof.
case/and3P=> wf /eqP sizes ok.
apply: (rank_in_order (f := id) (g := (@behind_states n m s))) ok _ _ _ => [i||i j]; [by exists i|exact: behind_states_onto|].
have iN := ltn_ord i; rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n /behind_states.
case: (split_ordP j) => t ->.
  rewrite mxE row_mxEl /at_place nth_cat size_mkseq /= ltn_ord nth_mkseq //.
  transitivity (vec n (nth [::] (trajectory L x vs) i) 0 t); first by rewrite mxE.
  by rewrite (trajectory_state meaning wf) //; lia.
have ks := sample_lt t; rewrite mxE row_mxEr /at_place nth_cat size_mkseq /= ltnNge leq_addr addKn
  -[nth _ (in_line _ _) _]/(at_place (in_line m (take s (drop i vs))) t).
rewrite place_in_line; last by rewrite size_takel ?size_drop //; lia.
rewrite nth_take // nth_drop; set k := (t %/ m)%N in ks *.
by rewrite mxvecE mxE /signal_of [RHS]mxE.
Qed.

Lemma reached_by_nth k (M : table) j : all (fun row => size row == n) (tA L) -> (size (tA L) <= n)%N -> size M = m -> (j < k * m)%N ->
  vec n (nth [::] (reached_by k L M) j) = vec n (nth [::] M (j %% m)) *m iter (j %/ m) (mulmx^~ (mat n n (tA L))) 1%:M.
Proof.
move=> rA sA; elim: k M j => [|k IH] M j sM /=; first by rewrite mul0n.
have m0 : (j < k.+1 * m)%N -> (0 < m)%N by case: (m) => //; rewrite muln0.
rewrite mulSn nth_cat sM => lt; case: ltnP => jm; first by rewrite divn_small // modn_small // mulmx1.
have {}m0 := m0 lt; rewrite IH ?size_map //; last by lia.
have -> : j = (1 * m + (j - m))%N by lia.
rewrite divnMDl // modnMDl add1n mul1n addKn iterS (nth_map [::]) ?sM ?ltn_mod // (vec_row_times meaning _ _ sA) -!mulmxA; congr (_ *m _).
by elim: (_ %/ _)%N => [|i IHi] /=; rewrite ?mulmx1 ?mul1mx // mulmxA IHi.
Qed.

Theorem reachability_rank : reachability_has_rank n m p r L nulls combinations -> \rank (reachability S) = r.
Proof.
case/andP=> wf ok; rewrite -mxrank_tr; case/and4P: (wf) => /andP[/eqP sA rA] /andP[/eqP sF rF] _ _.
apply: (rank_in_order (f := @position n m) (g := id)) ok _ _ _ => [|i|i j]; [exact: position_onto|by exists i|].
transitivity (vec n (nth [::] (reached_by n L (tF L)) i) 0 j); first by rewrite mxE.
rewrite reached_by_nth ?sA // [RHS]mxE /reachability /position stackE [RHS]mxE /=.
have -> : vec n (nth [::] (tF L) (i %% m)) = row (Ordinal (output_lt i)) (mat m n (tF L)) by rewrite (row_mat value).
rewrite -row_mul [LHS]mxE; congr (fun_of_matrix _ _ j).
by elim: (i %/ m)%N => [|k IH]; rewrite ?mulmx1 // !iterS mulmxA IH.
Qed.

End Sound.
