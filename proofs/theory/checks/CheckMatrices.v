(** Ranks of named matrices of a concrete system over the rational numbers: O_n, T_s, [O_s T_s], reachability, and of a recorded trajectory
    the Hankel matrix of its outputs and the excitation [X V_s]. Each is computed on integers up to nonzero factors of rows and columns.

                    pulses m s i == the i-th unit fault signal of s samples, as a list
            forced_table m p s L == T_s as a table: the outputs from rest of these signals
    check_toeplitz, check_window == the checks of the ranks of T_s and of [O_s T_s], which no headline speaks of
                      position j == which column of T_s entry j of a flat list of outputs or faults is
                 behind_states j == the same behind n states *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop order zmodp ssralg finalg poly
  ssrnum ssrint rat matrix mxalgebra fraction.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Basics.
From faultspace Require Import Stacks CertificatesVocabulary Lists ListedSystems TableRank.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The same for T_s and [O_s T_s], which no headline speaks of. *)
Definition pulses m s (i : nat) : seq vector := [seq if k == (i %/ m)%N then basis_vector m (i %% m)%N else [::] | k <- iota 0 s].
Definition forced_table m p s (L : listed) : table := [seq flat p (simulate L [::] (pulses m s i)) | i <- iota 0 (s * m)].

Definition check_toeplitz n m p s r l (L : listed) nulls combinations : bool :=
  well_formed n m p L && check_rank (s * m) (s * p) r l (forced_table m p s L) nulls combinations.
Definition check_window n m p s r l (L : listed) nulls combinations : bool :=
  well_formed n m p L && check_rank (n + s * m) (s * p) r l (free_table n p s L ++ forced_table m p s L) nulls combinations.

(** Positions k p + l in a list, and (k, l) in a row vector. *)
Section Positions.
Variables s p : nat.

Lemma some_output (j : 'I_(s * p)) : (0 < p)%N.
Proof. by case: p j => // -[k]; rewrite muln0. Qed.
Lemma sample_lt (j : 'I_(s * p)) : (j %/ p < s)%N.
Proof. by rewrite ltn_divLR ?some_output. Qed.
Lemma output_lt (j : 'I_(s * p)) : (j %% p < p)%N.
Proof. by rewrite ltn_mod some_output. Qed.
Definition position (j : 'I_(s * p)) : 'I_(s * p) := mxvec_index (Ordinal (sample_lt j)) (Ordinal (output_lt j)).

Lemma position_onto (t : 'I_(s * p)) : exists j, position j == t.
Proof.
case/mxvec_indexP: t => k l; have lt : (k * p + l < s * p)%N by have := ltn_ord k; have := ltn_ord l; nia.
exists (Ordinal lt); apply/eqP; congr mxvec_index; apply: val_inj => /=.
  by rewrite divnMDl ?(leq_ltn_trans _ (ltn_ord l)) // divn_small ?addn0.
by rewrite modnMDl modn_small.
Qed.

Lemma entry_flat us (j : nat) : (j < size us * p)%N -> entry (flat p us) j = entry (nth [::] us (j %/ p)) (j %% p).
Proof.
elim: us j => [|u us IH] j /=; first by rewrite mul0n.
rewrite mulSn /entry nth_cat size_mkseq => lt; case: ltnP => jp; first by rewrite nth_mkseq // divn_small // modn_small.
have p0 : (0 < p)%N by move: lt jp; case: p => // ; lia.
rewrite -[nth _ (flatten _) _]/(entry (flat p us) (j - p)) IH; last by lia.
have -> : j = (1 * p + (j - p))%N by lia.
by rewrite divnMDl // modnMDl add1n mul1n addKn.
Qed.
End Positions.

(** The same behind n states. *)
Section BehindStates.
Variables n m s : nat.
Definition behind_states (j : 'I_(n + s * m)) : 'I_(n + s * m) :=
  match split j with inl i => lshift _ i | inr k => rshift _ (position k) end.

Lemma behind_states_onto t : exists j, behind_states j == t.
Proof.
case: (split_ordP t) => [i|k] ->; first by exists (lshift _ i); rewrite /behind_states (unsplitK (inl i)).
by have [j /eqP <-] := position_onto k; exists (rshift _ j); rewrite /behind_states (unsplitK (inr j)).
Qed.
End BehindStates.

(** Rows and columns in another order. *)
Lemma rank_reordered a b a' b' r l T nulls combinations (M : 'M[rat]_(a', b')) (f : 'I_a -> 'I_a') (g : 'I_b -> 'I_b') alpha beta :
  check_rank a b r l T nulls combinations -> (forall i, exists j, f j == i) -> (forall i, exists j, g j == i) ->
  (forall (i : 'I_a) (j : 'I_b), ratn (entry (nth [::] T i) j) = alpha i * M (f i) (g j) * beta j) ->
  (forall i, alpha i != 0) -> (forall j, beta j != 0) -> \rank M = r.
Proof.
move=> ok f_onto g_onto e alpha0 beta0.
have part c d c' d' (X : 'M[rat]_(c, d)) (Y : 'M[rat]_(c', d')) h k : (forall i j, X i j = Y (h i) (k j)) -> (\rank X <= \rank Y)%N.
  move=> eX; have -> : X = (\matrix_(i, i') (h i == i')%:R) *m Y *m (\matrix_(j', j) (j' == k j)%:R).
    apply/matrixP => i j; rewrite eX mxE (bigD1 (k j)) //= big1 => [|j' /negPf jk]; last by rewrite [X in _ * X]mxE jk mulr0.
    rewrite [X in _ = _ * X + _]mxE eqxx mulr1 addr0 mxE (bigD1 (h i)) //= big1 => [|i' /negPf ih].
      by rewrite [X in _ = X * _ + _]mxE eqxx mul1r addr0.
    by rewrite [X in X * _]mxE eq_sym ih mul0r.
  by apply: leq_trans (mxrankM_maxl _ _) _; apply: mxrankM_maxr.
pose X := \matrix_(i, j) M (f i) (g j).
have <- : \rank X = r by apply: rank_up_to_factors ok _ alpha0 beta0 => i j; rewrite mxE e.
apply/eqP; rewrite eqn_leq (part _ _ _ _ X M f g) ?andbT => [|i j]; last by rewrite mxE.
apply: (part _ _ _ _ M X (fun i => xchoose (f_onto i)) (fun j => xchoose (g_onto j))) => i j.
by rewrite mxE (eqP (xchooseP (f_onto i))) (eqP (xchooseP (g_onto j))).
Qed.

Section Sound.
Variables (n m p : nat) (L : listed) (l : Z) (r : nat) (nulls combinations : pivoted).
Let S := meant n m p L.
Let e : rat := ratn (den L).
Notation rV := (vec (field_of rat)) (only parsing).

Lemma vec_basis_at k (i : 'I_k) : rV k (basis_vector k i) = row i 1%:M.
Proof.
apply/rowP => j; rewrite !mxE /entry nth_mkseq // eq_sym -val_eqE /=.
by case: (_ == _); [apply: (rmorph1 (number_rmorphism _))|apply: (rmorph0 (number_rmorphism _))].
Qed.

Lemma powered_nth w vs k j : rV k (nth [::] (powered w (den L) vs) j) = ratn w *: (e ^+ j *: rV k (nth [::] vs j)).
Proof.
elim: vs w j => [|v vs IH] w [|j] /=; rewrite ?nth_nil ?vec_nil ?scaler0 ?expr0 ?scale1r //; first exact: vec_scale.
by rewrite IH !scalerA [ratn _](rmorphM (number_rmorphism _)) /= exprS mulrA.
Qed.

Lemma powered_size w vs : size (powered w (den L) vs) = size vs.
Proof. by elim: vs w => //= v vs IH w; rewrite IH. Qed.

Lemma free_entries s (i : 'I_n) (j : 'I_(s * p)) : well_formed n m p L ->
  ratn (entry (nth [::] (free_table n p s L) i) j) = O S s i (position j) * e ^+ (j %/ p).+1.
Proof.
move=> wf; have e0 : e != 0 := den_neq0 wf.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n entry_flat; last by rewrite simulate_size size_nseq.
transitivity (rV p (nth [::] (simulate L (basis_vector n i) (nseq s [::])) (j %/ p)) 0 (Ordinal (output_lt j))); first by rewrite mxE.
rewrite (simulate_output wf) ?size_nseq ?sample_lt // scaled_output_back // vec_basis_at mxE mulrC; congr (_ * _).
rewrite [RHS]mxE mxvecE [RHS]mxE; congr (fun_of_matrix _ 0 _); apply: output_ext => k _.
by rewrite nth_nseq if_same vec_nil scaler0.
Qed.

Lemma forced_entries s (i : 'I_(s * m)) (j : 'I_(s * p)) : well_formed n m p L ->
  ratn (entry (nth [::] (forced_table m p s L) i) j) = e ^- (i %/ m) * T S s (position i) (position j) * e ^+ (j %/ p).+1.
Proof.
move=> wf; have e0 : e != 0 := den_neq0 wf; have ps : size (pulses m s i) = s by rewrite size_map size_iota.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n entry_flat; last by rewrite simulate_size ps.
transitivity (rV p (nth [::] (simulate L [::] (pulses m s i)) (j %/ p)) 0 (Ordinal (output_lt j))); first by rewrite mxE.
have ks := sample_lt j; rewrite (simulate_output wf) ?ps // scaled_output_back // vec_nil [LHS]mxE mulrC; congr (_ * _).
rewrite [X in _ = _ * X]mxE mxvecE [X in _ = _ * X]mxE -[0 in LHS](scaler0 _ (e ^- (i %/ m))).
transitivity ((e ^- (i %/ m) *: output S 0 (pulse ratF (position i)) (j %/ p)) 0 (Ordinal (output_lt j))); last by rewrite mxE.
rewrite -output_scale; congr (fun_of_matrix _ 0 _); apply: output_ext => k kj; have k_s : (k < s)%N := leq_ltn_trans kj ks.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n /pulse insubT /= vec_mx_delta.
case: eqP => [ki|ki].
  rewrite {1}ki; congr (_ *: _); apply/rowP => t; rewrite (vec_basis_at (Ordinal (output_lt i))) !mxE.
  by rewrite -[Ordinal k_s == _]val_eqE /= (introT eqP ki) eq_sym.
rewrite vec_nil scaler0; apply/esym/eqP; rewrite scaler_eq0; apply/orP; right; apply/eqP/rowP => t; rewrite !mxE.
by rewrite -val_eqE /=; move/eqP/negPf: ki => ->.
Qed.

(** `matrix-rank`, "observability", "toeplitz", "window". *)
Theorem observability_sound : check_observability n m p r l L nulls combinations -> \rank (O S n) = r.
Proof.
case/andP=> wf ok; have e0 : e != 0 := den_neq0 wf.
apply: (rank_reordered (f := id) (g := @position n p) (alpha := fun=> 1) (beta := fun j => e ^+ (j %/ p).+1)) ok _ _ _ _ _.
- by move=> i; exists i.
- exact: position_onto.
- by move=> i j; rewrite mul1r free_entries.
- by move=> i; apply: oner_neq0.
- by move=> j; apply: expf_neq0.
Qed.

Theorem toeplitz_sound s : check_toeplitz n m p s r l L nulls combinations -> \rank (T S s) = r.
Proof.
case/andP=> wf ok; have e0 : e != 0 := den_neq0 wf.
apply: (rank_reordered (f := @position s m) (g := @position s p) (alpha := fun i => e ^- (i %/ m))
  (beta := fun j => e ^+ (j %/ p).+1)) ok _ _ _ _ _.
- exact: position_onto.
- exact: position_onto.
- by move=> i j; rewrite forced_entries.
- by move=> i; rewrite invr_eq0 expf_neq0.
- by move=> j; apply: expf_neq0.
Qed.

Theorem window_sound s : check_window n m p s r l L nulls combinations -> \rank (window S s) = r.
Proof.
case/andP=> wf ok; have e0 : e != 0 := den_neq0 wf.
apply: (rank_reordered (f := @behind_states n m s) (g := @position s p)
  (alpha := fun i => if split i is inr k then e ^- (k %/ m) else 1) (beta := fun j => e ^+ (j %/ p).+1)) ok _ _ _ _ _.
- exact: behind_states_onto.
- exact: position_onto.
- move=> i j; rewrite nth_cat size_map size_iota /behind_states; case: (split_ordP i) => t -> /=.
    by rewrite mul1r /window col_mxEu free_entries.
  by rewrite addKn /window col_mxEd forced_entries.
- by move=> i; case: split => k; rewrite ?oner_neq0 ?invr_eq0 ?expf_neq0.
- by move=> j; apply: expf_neq0.
Qed.

(** "residual-hankel" and "excitation", of the trajectory from x / d under vs / d. *)
Section Trajectory.
Variables (N s : nat) (d : Z) (x : vector) (vs : seq vector).
Let x0 := recorded d n x.
Let v k := recorded d m (nth [::] vs k).
Let ws := powered (Zpos xH) (den L) vs.

Lemma ws_nth j : rV m (nth [::] ws j) = e ^+ j *: rV m (nth [::] vs j).
Proof. by rewrite powered_nth [ratn _](rmorph1 (number_rmorphism _)) scale1r. Qed.

Theorem hankel_sound : check_hankel n m p N s r l L d x vs nulls combinations -> \rank (hankel N s (output S x0 v)) = r.
Proof.
case/and4P=> wf d0 /eqP sizes ok; have e0 : e != 0 := den_neq0 wf; have rd0 : ratn d != 0 by rewrite number_eq0.
apply: (rank_reordered (f := id) (g := @position s p) (alpha := fun i => ratn d * e ^+ i) (beta := fun j => e ^+ (j %/ p).+1)) ok _ _ _ _ _.
- by move=> i; exists i.
- exact: position_onto.
- move=> i j; have ks := sample_lt j; have iN := ltn_ord i.
  have so : size (simulate L x ws) = size vs by rewrite simulate_size powered_size.
  rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n entry_flat; last by rewrite size_takel ?size_drop ?so //; lia.
  rewrite nth_take // nth_drop; set k := (j %/ p)%N in ks *.
  transitivity (rV p (nth [::] (simulate L x ws) (i + k)) 0 (Ordinal (output_lt j))); first by rewrite mxE.
  rewrite (simulate_output wf); last by rewrite powered_size; lia.
  rewrite (@output_ext _ _ _ _ _ _ _ (fun j => e ^+ j *: rV m (nth [::] vs j))); last by move=> *; apply: ws_nth.
  rewrite scaled_output [LHS]mxE [X in _ = _ * X * _]mxE mxvecE [X in _ = _ * X * _]mxE /x0 /v /recorded
    output_scale [X in _ = _ * X * _]mxE.
  by rewrite -addnS exprD !mulrA [ratn d * _]mulrC mulfK // mulrAC.
- by move=> i; rewrite mulf_neq0 ?expf_neq0.
- by move=> j; apply: expf_neq0.
Qed.

Lemma visited_state i : well_formed n m p L -> (i <= size vs)%N ->
  rV n (nth [::] (visited L x ws) i) = e ^+ i *: state S (rV n x) (fun j => rV m (nth [::] vs j)) i.
Proof.
move=> wf; rewrite -(powered_size (Zpos xH)) -/ws => i_vs; rewrite -scaled_state -/(integral n m p L).
rewrite -(@state_ext _ _ _ _ _ _ (fun j => rV m (nth [::] ws j))); last by move=> *; apply: ws_nth.
case/and5P: (wf) => _ /andP[/eqP sA _] /andP[/eqP sF _] _ _.
elim: (ws) (x) i i_vs => [|w ws' IH] y [|i] // i_vs; rewrite state_step [LHS]IH // vec_add (@vec_times _ n) ?sA // (@vec_times _ m) ?sF //.
by rewrite (integralE wf).
Qed.

Theorem excitation_sound : check_excitation n m p N s r l L d x vs nulls combinations -> \rank (excitation S x0 v N s) = r.
Proof.
case/and4P=> wf d0 /eqP sizes ok; have e0 : e != 0 := den_neq0 wf; have rd0 : ratn d != 0 by rewrite number_eq0.
apply: (rank_reordered (f := id) (g := (@behind_states n m s)) (alpha := fun i => ratn d * e ^+ i)
  (beta := fun j => if split j is inr k then e ^+ (k %/ m) else 1)) ok _ _ _ _ _.
- by move=> i; exists i.
- exact: behind_states_onto.
- move=> i j; have iN := ltn_ord i; rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n /behind_states.
  case: (split_ordP j) => t ->.
    rewrite mulr1 mxE row_mxEl /entry nth_cat size_mkseq /= ltn_ord nth_mkseq //.
    transitivity (rV n (nth [::] (visited L x ws) i) 0 t); first by rewrite mxE.
    rewrite visited_state //; last by lia.
    by rewrite /x0 /v /recorded state_scale [LHS]mxE [X in _ = _ * X]mxE !mulrA [ratn d * _]mulrC mulfK.
  have ks := sample_lt t; rewrite mxE row_mxEr /entry nth_cat size_mkseq /= ltnNge leq_addr addKn
    -[nth _ (flat _ _) _]/(entry (flat m (take s (drop i ws))) t).
  rewrite entry_flat; last by rewrite size_takel ?size_drop ?powered_size //; lia.
  rewrite nth_take // nth_drop; set k := (t %/ m)%N in ks *.
  transitivity (rV m (nth [::] ws (i + k)) 0 (Ordinal (output_lt t))); first by rewrite mxE.
  rewrite ws_nth mxvecE [LHS]mxE [X in _ = _ * X * _]mxE /v /recorded [X in _ = _ * X * _]mxE.
  by rewrite exprD !mulrA [ratn d * _]mulrC mulfK // mulrAC.
- by move=> i; rewrite mulf_neq0 ?expf_neq0.
- by move=> j; case: split => k; rewrite ?oner_neq0 ?expf_neq0.
Qed.

End Trajectory.

(** "reachability". *)
Lemma reached_nth k M j : all (fun row => size row == n) (lA L) -> (size (lA L) <= n)%N -> size M = m -> (j < k * m)%N ->
  rV n (nth [::] (reachability_rows k L M) j) = rV n (nth [::] M (j %% m)) *m iter (j %/ m) (mulmx^~ (mat _ n n (lA L))) 1%:M.
Proof.
move=> rA sA; elim: k M j => [|k IH] M j sM /=; first by rewrite mul0n.
have m0 : (j < k.+1 * m)%N -> (0 < m)%N by case: (m) => //; rewrite muln0.
rewrite mulSn nth_cat sM => lt; case: ltnP => jm; first by rewrite divn_small // modn_small // mulmx1.
have {}m0 := m0 lt; rewrite IH ?size_map //; last by lia.
have -> : j = (1 * m + (j - m))%N by lia.
rewrite divnMDl // modnMDl add1n mul1n addKn iterS (nth_map [::]) ?sM ?ltn_mod // (@vec_times _ n) // -!mulmxA; congr (_ *m _).
by elim: (_ %/ _)%N => [|i IHi] /=; rewrite ?mulmx1 ?mul1mx // mulmxA IHi.
Qed.

Theorem reachability_sound : check_reachability n m p r l L nulls combinations -> \rank (reachability S) = r.
Proof.
case/andP=> wf ok; have e0 : e != 0 := den_neq0 wf; rewrite -mxrank_tr.
case/and5P: (wf) => _ /andP[/eqP sA rA] /andP[/eqP sF rF] _ _.
apply: (rank_reordered (f := @position n m) (g := id) (alpha := fun i => e ^+ (i %/ m).+1) (beta := fun=> 1)) ok _ _ _ _ _.
- exact: position_onto.
- by move=> i; exists i.
- move=> i j; transitivity (rV n (nth [::] (reachability_rows n L (lF L)) i) 0 j); first by rewrite mxE.
  rewrite reached_nth ?sA // mulr1 [X in _ = _ * X]mxE /reachability /position stackE [X in _ = _ * X]mxE /=.
  set k := (i %/ m)%N; set t := (i %% m)%N.
  have -> : rV n (nth [::] (lF L) t) = row (Ordinal (output_lt i)) (mat _ m n (lF L)) by rewrite rowK.
  rewrite -row_mul [LHS]mxE -(times_fraction wf) -(times_fraction wf).
  suff -> : e *: fraction (den L) m n (lF L) *m iter k (mulmx^~ (e *: fraction (den L) n n (lA L))) 1%:M
      = e ^+ k.+1 *: iter k (mulmxr (fraction (den L) n n (lA L))) (fraction (den L) m n (lF L)) by rewrite mxE.
  elim: (k) => [|i' IH]; first by rewrite mulmx1 expr1.
  by rewrite !iterS mulmxA IH /= -scalemxAl -scalemxAr scalerA -exprSr.
- by move=> i; apply: expf_neq0.
- by move=> j; apply: oner_neq0.
Qed.

End Sound.
