(** The two checks on lists that everything rests on. Kernel rows ascend in degree, have independent leading coefficients (triangular at
    distinct pivots, say) and annihilate a system: the bound from above on the ranks of all windows. Words whose outputs are the identity at
    some samples, modulo some l > 1: the bound from below on the rank of one window.

    meant_rows p rows == the kernel rows as lists of columns over the rational numbers
      congruent l u v == the lists are as long as each other, and their entries equal modulo l *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path fintype finfun bigop order zmodp ssralg finalg poly
  ssrnum ssrint rat matrix mxalgebra.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Windows Stacks CertificatesVocabulary Lists Independence KernelRows ListedSystems IntegralWindows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Definition meant_rows p (rows : seq kernel_row) : seq (seq 'cV[rat]_p) := [seq columns p row.2 | row <- rows].

Lemma filter_sorted (T : Type) (size_of : T -> nat) (b : nat) (s : seq T) : sorted leq (map size_of s) ->
  [seq c <- s | (size_of c <= b)%N] = take (size [seq c <- s | (size_of c <= b)%N]) s.
Proof.
elim: s => //= c s IH h; case: ltnP => [bc|_]; last by rewrite /= -IH ?(path_sorted h).
have := order_path_min leq_trans h; rewrite all_map => below.
rewrite (_ : filter _ s = [::]) //; elim: s below {IH h} => //= d s IH /andP[cd /IH ->].
by rewrite leqNgt (leq_trans bc cd).
Qed.

Section Rows.
Variables (p : nat) (rows : seq kernel_row).

Lemma last_columns c : last 0 (columns p c) = column p (last [::] c).
Proof. by rewrite -(last_map (column p)) /column vec_nil trmx0. Qed.

(** Where the leading coefficients at the pivots are an invertible matrix, those of the rows up to any degree are independent. *)
Lemma ascending_independent : all (fun row => row.1 < p)%N rows -> sorted leq [seq size row.2 | row <- rows] ->
  mat ratF (size rows) (size rows) (leading rows) \in unitmx -> independent_leading (meant_rows p rows).
Proof.
move=> /allP inside ascending unit_Q k; set Q := mat ratF _ _ _ in unit_Q.
have takes := filter_sorted k.+1 ascending; set t := size [seq c <- rows | _] in takes.
have eA : active (meant_rows p rows) k = meant_rows p (take t rows).
  rewrite /active /meant_rows filter_map -takes; congr map; apply: eq_filter => row /=; by rewrite size_map.
have tr : (t <= size rows)%N by rewrite /t size_filter count_size.
have st : size (active (meant_rows p rows) k) = t by rewrite eA size_map size_takel.
apply/eqP; rewrite eqn_leq rank_leq_col /=.
pose row_of (b : nat) := nth (0%N, [::]) rows b.
pose P : 'M[rat]_(size rows, p) := \matrix_(b, i) (i == (row_of b).1 :> nat)%:R.
pose E : 'M[rat]_(size rows, size (active (meant_rows p rows) k)) := \matrix_(b, a) (b == a :> nat)%:R.
have nth_lead a : (a < t)%N -> last 0 (nth [::] (active (meant_rows p rows) k) a) = column p (last [::] (row_of a).2).
  by move=> a_t; rewrite eA (nth_map (0%N, [::])) ?last_columns ?nth_take // size_takel.
have eP : P *m leading_active (meant_rows p rows) k = Q^T *m E.
  apply/matrixP => b a; have a_t : (a < t)%N by rewrite -st.
  have pb : ((row_of b).1 < p)%N by apply/inside/mem_nth.
  rewrite [LHS]mxE (bigD1 (Ordinal pb)) //= big1 => [|i ib]; last first.
    by rewrite [P _ _]mxE (_ : (_ == _) = false) ?mul0r //; apply: contraNF ib => /eqP ib; apply/eqP/val_inj.
  rewrite [P _ _]mxE eqxx mul1r addr0 mxE nth_lead //.
  rewrite [RHS]mxE (bigD1 (Ordinal (leq_trans a_t tr))) //= big1 => [|i ia]; last first.
    by rewrite [E _ _]mxE (_ : (_ == _) = false) ?mulr0 //; apply: contraNF ia => /eqP ia; apply/eqP/val_inj.
  rewrite [E _ _]mxE eqxx mulr1 addr0 !mxE (nth_map (0%N, [::])) ?(leq_trans a_t) // /entry (nth_map 0%N) ?size_map //.
  by rewrite (nth_map (0%N, [::])).
have rank_E : \rank E = size (active (meant_rows p rows) k).
  apply/eqP; rewrite eqn_leq rank_leq_col /= -[X in (X <= _)%N](mxrank1 ratF) (_ : 1%:M = E^T *m E) ?mxrankM_maxr //.
  apply/matrixP => a b; have a_in : (a < size rows)%N by apply: leq_trans tr; rewrite -st.
  rewrite [RHS]mxE (bigD1 (Ordinal a_in)) //= big1 => [|i ia]; last first.
    by rewrite !mxE (_ : (_ == _) = false) ?mul0r //; apply: contraNF ia => /eqP ia; apply/eqP/val_inj.
  by rewrite !mxE eqxx mul1r addr0.
rewrite -[X in (X <= _)%N]rank_E -(mulKmx (_ : Q^T \in unitmx) E) ?unitmx_tr // -eP.
by apply: leq_trans (mxrankM_maxr _ _) _; apply: mxrankM_maxr.
Qed.

Theorem admissible_independent : admissible p rows -> independent_leading (meant_rows p rows).
Proof.
case/and3P=> /allP shapes ascending tri; apply: ascending_independent => //; first by apply/allP => row /shapes/andP[].
rewrite (_ : mat _ _ _ _ = map_mx ratn (table_matrix (size rows) (size rows) (leading rows))); last exact: mat_image.
by apply: triangular_entries tri _ _ => [|i j]; rewrite ?size_map // mxE.
Qed.

End Rows.

(** Reducing states and outputs modulo l changes them by multiples of l only. *)
Section Congruence.
Variable l : Z.
Definition congruent (u v : vector) := size u = size v /\ forall j, exists q, entry u j = entry v j + l * q.

Lemma congruent_refl u : congruent u u.
Proof. by split=> // j; exists 0; rewrite mulr0 addr0. Qed.

Lemma reduced_congruent u v : l != 0 -> congruent u v -> congruent (reduced l u) v.
Proof.
move=> l0 [s e]; split=> [|j]; first by rewrite size_map.
have [q ->] : exists q, entry (reduced l u) j = entry u j + l * q; last by have [q' ->] := e j; exists (q' + q); rewrite mulrDr addrA.
rewrite /entry /reduced; have [ju|uj] := ltnP j (size u); last by exists 0; rewrite mulr0 addr0 !nth_default ?size_map.
rewrite (nth_map Z0) //; exists (- Z.div (nth Z0 u j) l); have h := Z_div_mod_eq_full (nth Z0 u j) l.
by rewrite mulrN {2}h addrAC subrr add0r.
Qed.

Lemma add_congruent u v u' v' : congruent u u' -> congruent v v' -> congruent (add u v) (add u' v').
Proof.
move=> [su eu] [sv ev]; split=> [|j]; last first.
  by have [q qu] := eu j; have [q' qv] := ev j; exists (q + q'); rewrite !entry_add qu qv addrACA mulrDr.
have size_add a b : size (add a b) = maxn (size a) (size b) by elim: a b => [|a0 a IH] [|b0 b] //=; rewrite ?max0n ?maxn0 // IH maxnSS.
by rewrite !size_add su sv.
Qed.

Lemma times_congruent x y M : congruent x y -> congruent (times x M) (times y M).
Proof.
elim: M x y => [|r M IH] [|a x] [|b y] [] //= [s e]; try exact: congruent_refl.
apply: add_congruent.
  split=> [|j]; first by rewrite !size_map.
  by have [q h] := e 0%N; exists (q * entry r j); rewrite !entry_scale [a]h mulrDl mulrA.
by apply: IH; split=> // j; have [q h] := e j.+1; exists q.
Qed.

Lemma simulate_congruent L x y vs k : l != 0 -> congruent x y ->
  congruent (nth [::] (simulate_modulo l L x vs) k) (nth [::] (simulate L y vs) k).
Proof.
move=> l0; elim: vs x y k => [|v vs IH] x y [|k] e; try exact: congruent_refl.
  by apply: reduced_congruent => //; apply: add_congruent; [apply: times_congruent|apply: congruent_refl].
by apply: IH; apply: reduced_congruent => //; apply: add_congruent; [apply: times_congruent|apply: congruent_refl].
Qed.

End Congruence.

Section OneSystem.
Variables (n m p : nat) (L : listed) (wf : well_formed n m p L).
Let S := meant n m p L.

Lemma column_acts b F G d : all (fun r => size r == n) F -> all (fun r => size r == p) G ->
  column b (acts F G d) = mat ratF b n F *m column n d.1 + mat ratF b p G *m column p d.2.
Proof. by move=> hF hG; rewrite /column /acts vec_add linearD /= (vec_apply _ _ _ hF) (vec_apply _ _ _ hG). Qed.

Theorem annihilated_sound c : annihilated L c -> forall x v, relation (columns p c) (output S x v) = 0.
Proof.
rewrite /annihilated /demands; set cw := (weighted _ _).2; case e: (horner L cw) => [X ds] /andP[X0 /allP ds0] x v.
rewrite (relation_meant wf) -/cw relation_horner -(horner_meaning wf) e /column vec_null // trmx0 mulmx0 add0r.
rewrite big1 ?scaler0 // => k _; have kc : (k < size cw)%N by rewrite -(size_map (column p)).
rewrite (demand_meaning wf erefl erefl kc) e (integralE wf) /=.
case/and5P: (wf) => _ _ /andP[_ rF] _ /andP[_ rG]; rewrite -(column_acts _ _ rF rG) /column vec_null ?trmx0 ?mulmx0 //.
by apply: ds0; apply: mem_nth; have := horner_size L cw; rewrite e /= => ->.
Qed.

Theorem rows_annihilate rows : all (fun row => annihilated L row.2) rows -> annihilates (meant_rows p rows) S.
Proof. by move=> /allP h c x v /mapP[row /h ann ->]; apply: annihilated_sound. Qed.

Theorem words_rank s l ws : words p s l L ws -> (size ws <= \rank (window S s))%N.
Proof.
case/and3P=> _ /allP shapes one; pose w0 : sampled_word := (([::], [::]), (0%N, 0%N)).
pose x i := vec ratF n (nth w0 ws i).1.1; pose v i j := ratn (den L) ^- j *: vec ratF m (nth [::] (nth w0 ws i).1.2 j).
pose R k : 'M[rat]_(size ws, p) := \matrix_(i < size ws) output S (x i) (v i) k.
have sub : (stack s R <= window S s)%MS.
  apply/row_subP => i; rewrite rowK windowP; exists (x i), (v i) => k _; exact: rowK.
apply: leq_trans (mxrankS sub); rewrite row_free_stack // => B h.
pose Q : 'M[Z]_(size ws) := \matrix_(i, j)
  entry (nth [::] (simulate L (nth w0 ws i).1.1 (nth w0 ws i).1.2) (nth w0 ws j).2.1) (nth w0 ws j).2.2.
have unit_Q : map_mx ratn Q \in unitmx.
  have l0 : l != 0 by case/andP: one => /Z.ltb_lt l1 _; apply/eqP => e; move: l1; rewrite e.
  apply: identity_modulo_congruent one _ _ => [|i j]; first by rewrite size_map.
  have [_ e] := simulate_congruent L (nth w0 ws i).1.2 (nth w0 ws j).2.1 l0 (congruent_refl l (nth w0 ws i).1.1).
  have [q eq_q] := e (nth w0 ws j).2.2; exists q; rewrite mxE -eq_q.
  by rewrite (nth_map w0) // /seen_at {1}/entry (nth_map (0%N, 0%N)) ?size_map // (nth_map w0).
suff BQ : B *m map_mx ratn Q = 0 by rewrite -(mulmxK unit_Q B) BQ mul0mx.
apply/rowP => j; have /and3P[_ ks lp] := shapes _ (mem_nth w0 (ltn_ord j)); have := h _ ks; set k := (nth w0 ws j).2.1 in ks *.
move=> zero; transitivity (ratn (den L) ^+ k.+1 * (B *m R k) 0 (Ordinal lp)); last by rewrite zero !mxE mulr0.
rewrite [LHS]mxE [in RHS]mxE mulr_sumr.
apply: eq_bigr => i _; have /and3P[/eqP sv _ _] := shapes _ (mem_nth w0 (ltn_ord i)); rewrite [RHS]mulrCA; congr (_ * _).
rewrite [LHS]mxE [Q _ _]mxE [R _ _ _]mxE.
transitivity (vec ratF p (nth [::] (simulate L (nth w0 ws i).1.1 (nth w0 ws i).1.2) k) 0 (Ordinal lp)); first by rewrite mxE.
by rewrite (simulate_output wf) ?sv // /integral scaled_output_back ?(den_neq0 wf) // [LHS]mxE.
Qed.
End OneSystem.
