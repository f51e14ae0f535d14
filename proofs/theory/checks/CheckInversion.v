(** Faults of a concrete system over the rational numbers that cannot be seen, by a trajectory with zero output for ever; and the delay with
    which the first fault is determined, by a left inverse and by a trajectory with zero output on one sample less.

    determines S known l == r(0), ..., r(l) determine v(0), from rest where the state is known, and from any state
           fault_of vs j == v(j), the faults being told by the list vs *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  ssrint rat matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Basics.
From faultspace Require Import CertificatesVocabulary Lists KernelRows ListedSystems CheckRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** r(0), ..., r(l) determine v(0), from rest (known) or from any state; known, this is inverts_with_delay. *)
Definition determines (K : fieldType) n m p (S : system K n m p) (known : bool) l :=
  forall x v, (known -> x = 0) -> (forall k, (k <= l)%N -> output S x v k = 0) -> v 0%N = 0.

Lemma determines_known (K : fieldType) n m p (S : system K n m p) l : determines S true l <-> inverts_with_delay S l.
Proof. by split=> [h v|h x v /(_ isT)->]; [apply: h|apply: h]. Qed.

Section Sound.
Variables (n m p : nat) (L : listed).
Let S := meant n m p L.
Let e := ratn (den L).
Let I := integral n m p L.
Definition fault_of (vs : seq vector) j : 'rV[rat]_m := vec ratF m (nth [::] vs j).

Lemma nonzero_vec v : nonzero m v -> vec ratF m v != 0.
Proof.
case/andP=> /eqP sv; apply: contraNN => /eqP v0; apply/allP => a /(nthP Z0)[j jv <-].
have jm : (j < m)%N by rewrite -sv.
by rewrite /= -number_eq0; move: v0 => /rowP/(_ (Ordinal jm)); rewrite !mxE => ->.
Qed.

Lemma agree_vec k u v : agree u v -> vec ratF k u = vec ratF k v.
Proof.
move=> /(vec_null ratF k); rewrite vec_add vec_scale => /eqP; rewrite addr_eq0 => /eqP ->.
by rewrite (_ : ratn (Zneg xH) = -1) ?scaleN1r ?opprK // [ratn _](rmorphN1 (number_rmorphism _)).
Qed.

Lemma run_state x vs : well_formed n m p L -> vec ratF n (run L x vs) = state I (vec ratF n x) (fault_of vs) (size vs).
Proof.
move=> wf; case/and5P: (wf) => _ /andP[/eqP sA _] /andP[/eqP sF _] _ _; elim: vs x => [|v vs IH] x //.
rewrite [size _]/= state_step [run _ _ _]/= IH vec_add (@vec_times _ n) ?sA // (@vec_times _ m) ?sF //.
by rewrite /I (integralE wf).
Qed.

Lemma silent_output x vs k : well_formed n m p L -> all null (simulate L x vs) -> (k < size vs)%N ->
  output I (vec ratF n x) (fault_of vs) k = 0.
Proof.
move=> wf /allP zero kv; rewrite /fault_of -(simulate_output wf) // vec_null //; apply/zero/mem_nth; by rewrite simulate_size.
Qed.

(** Trajectories of the integer system and of the rational one. *)
Lemma back_to_rational x v k : well_formed n m p L -> output I x v k = 0 -> output S x (fun j => e ^- j *: v j) k = 0.
Proof.
move=> wf; rewrite /I /integral (scaled_output_back _ _ _ _ (den_neq0 wf)) => /eqP.
by rewrite scaler_eq0 expf_eq0 (negPf (den_neq0 wf)) andbF => /eqP.
Qed.

(** `not-left-invertible`. *)
Theorem not_left_invertible_sound xs vs : check_not_left_invertible n m p L xs vs -> ~ left_invertible S.
Proof.
case/and5P=> wf zero /(vec_null ratF n) stops /hasP[v v_in v0] _ inv.
have at_rest : state I 0 (fault_of vs) (size vs) = 0 by have := run_state [::] vs wf; rewrite stops vec_nil.
have silent k : output I 0 (fault_of vs) k = 0.
  have [kv|vk] := ltnP k (size vs); first by rewrite -(vec_nil ratF n); apply: silent_output.
  rewrite -(subnKC vk) output_shift at_rest output_zero // => j _; rewrite /fault_of nth_default ?vec_nil //; exact: leq_addr.
have := inv _ (fun k => back_to_rational wf (silent k)) (index v vs); move/eqP.
rewrite scaler_eq0 invr_eq0 expf_eq0 (negPf (den_neq0 wf)) andbF /= /fault_of nth_index // => /eqP; exact/eqP/nonzero_vec.
Qed.

(** `inversion-delay`. *)
Lemma ambiguous_sound known s x vs : ambiguous n m p known s L x vs -> forall j, (j < s)%N -> ~ determines S known j.
Proof.
case/and5P=> wf /eqP sv zero nz /implyP rest j js h; move: (nonzero_vec nz); rewrite -nth0 => /negP; apply; apply/eqP.
have := h (vec ratF n x) (fun k => e ^- k *: fault_of vs k); rewrite expr0 invr1 scale1r; apply=> [/rest|k kj].
  exact: vec_null.
by apply: (back_to_rational wf); apply: silent_output => //; rewrite sv (leq_ltn_trans kj js).
Qed.

Lemma gives_entry_sound known l i row x v : well_formed n m p L -> gives_entry m known l L i row -> (i < m)%N -> (known -> x = 0) ->
  (forall k, (k <= l)%N -> output S x v k = 0) -> forall im : (i < m)%N, v 0%N 0 (Ordinal im) = 0.
Proof.
rewrite /gives_entry /demands => wf; set cw := (weighted _ _).2; case eh: (horner L cw) => [X ds].
case/and5P=> /eqP sl row1 initial /allP later first im rest zero im'.
have w0 : ratn (weighted (den L) row.2).1 != 0 by rewrite (weighted_power) expf_neq0 // (den_neq0 wf).
have : relation (columns p row.2) (output S x v) = 0.
  by rewrite /relation big1 // => k _; rewrite zero ?mul0mx //; rewrite -ltnS -sl -(size_map (column p)).
rewrite (relation_meant wf) -/cw => /eqP; rewrite scaler_eq0 invr_eq0 expf_eq0 (negPf (den_neq0 wf)) andbF /= relation_horner.
have state0 : x *m horner_state (sysA I) (sysC I) (columns p cw) = 0.
  case/orP: initial => [/rest ->|X0]; first by rewrite mul0mx.
  by rewrite /I -(horner_meaning wf) eh /column vec_null // trmx0 mulmx0.
have scw : size cw = l.+1 by rewrite weighted_size.
have sds : size ds = l.+1 by have := horner_size L cw; rewrite eh scw.
have action k : (k < l.+1)%N -> fault_action I (columns p cw) k = column m (acts (lF L) (lG L) (nth ([::], [::]) ds k)).
  move=> kl; rewrite /I (demand_meaning wf erefl erefl) ?scw // eh (integralE wf) /=.
  by case/and5P: (wf) => _ _ /andP[_ rF] _ /andP[_ rG]; rewrite -(column_acts _ _ rF rG).
rewrite -/I state0 add0r size_map scw big_ord_recl big1 => [|k _]; last first.
  rewrite lift0 action ?ltnS //.
  rewrite /column vec_null ?trmx0 ?mulmx0 //; apply: later; rewrite -nth_behead; apply: mem_nth.
  by rewrite size_behead sds.
rewrite addr0 expr0 scale1r action // nth0 (_ : column m _ = (ratn (weighted (den L) row.2).1 * ratn row.1) *: delta_mx (Ordinal im') 0).
  rewrite -scalemxAr scaler_eq0 mulf_eq0 (negPf w0) number_eq0 (negPf row1) /= -colE => /eqP/matrixP/(_ 0 0); by rewrite !mxE.
rewrite /column (agree_vec m first); apply/colP => j; rewrite !mxE /entry nth_mkseq // -val_eqE /= andbT.
case: (val j == i); rewrite ?mulr1 ?mulr0; last exact: (rmorph0 (number_rmorphism _)).
exact: (rmorphM (number_rmorphism _)).
Qed.

Lemma inverse_sound known l rows : inverse n m p known l L rows -> determines S known l.
Proof.
case/and3P=> wf /eqP sr /allP h x v rest zero; apply/rowP => i; rewrite mxE.
have i_in : nat_of_ord i \in iota 0 m by rewrite mem_iota /=.
have := gives_entry_sound wf (h _ i_in) (ltn_ord i) rest zero (ltn_ord i); by congr (v _ _ _ = _); apply: val_inj.
Qed.

Theorem delay_sound known l rows x vs : check_delay n m p known l L rows x vs ->
  [/\ (l <= n)%N, determines S known l & forall j, (j < l)%N -> ~ determines S known j].
Proof.
case/and3P=> ln /inverse_sound d; case/orP=> [/eqP l0|a]; first by split=> // j; rewrite l0.
by split=> //; apply: ambiguous_sound a.
Qed.

Theorem no_delay_sound known x vs : check_no_delay n m p known L x vs -> forall j, (j <= n)%N -> ~ determines S known j.
Proof. by move=> a j jn; apply: ambiguous_sound a _ jn. Qed.

End Sound.
