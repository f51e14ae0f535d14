(** How many samples tell the first fault where the initial state is not known, if any number does: the two chains of subspaces that bound
    it. V_k: the states from which k zero outputs are possible. The bound m + n - rank C comes from the dimension of V_1, the bound
    rank [A F] from the part of V_k in the range of [A F], on which alone V_(k+1) depends. Each chain loses a dimension a step until it
    stops.

    held_in_range S k == the states of V_k, which hold the output at zero for k samples, in the range of [A F] *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary StructureVocabulary Basics Chain Trajectory.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A chain that falls from its start on either stops or loses a dimension a step. *)
Lemma falls_or_stops (K : fieldType) n (W : nat -> 'M[K]_n) k : (forall j, (W j.+1 <= W j)%MS) ->
  (exists2 j, (j < k)%N & (W j <= W j.+1)%MS) \/ (\rank (W k) + k <= \rank (W 0%N))%N.
Proof.
move=> falls; elim: k => [|k [[j jk h]|IH]]; [by right; rewrite addn0 | by left; exists j => //; apply: leqW | ].
have [h|h] := boolP (W k <= W k.+1)%MS; first by left; exists k.
by right; rewrite addnS; apply: leq_trans IH; rewrite ltn_add2r; apply: rank_ltmx; rewrite /ltmx h falls.
Qed.

Section InputDelay.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m).
Notation hold_step := (hold_step S).
Notation tells := (inverts_from_any_state S).

Lemma tells_longer l k : (l <= k)%N -> tells l -> tells k.
Proof. by move=> lk h x v zero; apply: (h x) => j jl; apply/zero/(leq_trans jl). Qed.

(** As many samples as it takes for every signal, and n are enough. *)
Lemma tells_some : (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k) <-> exists l, tells l.
Proof.
split=> [/faults_recovered_blindly_delay h | [l h]]; first by exists n.
apply/faults_recovered_blindly_delay => x v zero; have [ln|/ltnW nl] := leqP l n; first exact: tells_longer ln h x v zero.
have next : holds_zero S n (x *m sysA S + v 0%N *m sysF S).
  by exists (fun j => v j.+1) => j jn; rewrite -output_step zero.
have [u quiet] := (silent_for_ever S _).1 next.
apply: (h x (fun j => if j is i.+1 then u i else v 0%N)) => -[|j] _; first exact: (zero 0%N).
by rewrite output_step quiet.
Qed.

(** Told by what is possible after the first sample. *)
Lemma tellsP l : tells l <->
  forall x (w : 'rV_m), x *m sysC S + w *m sysG S = 0 -> ((x *m sysA S + w *m sysF S)%R <= iter l hold_step 1%:M)%MS -> w = 0.
Proof.
split=> h x => [w e /holdP[u quiet] | v zero].
  apply: (h x (fun j => if j is i.+1 then u i else w)) => -[|j] jl; first exact: e.
  by rewrite output_step quiet.
apply: (h x); first exact: (zero 0%N).
by apply/holdP; exists (fun j => v j.+1) => j jl; rewrite -output_step zero.
Qed.

(** ** rank [A F] *)

Notation range := <<col_mx (sysA S) (sysF S)>>%MS.

Lemma next_in_range x (w : 'rV_m) : ((x *m sysA S + w *m sysF S)%R <= range)%MS.
Proof. by rewrite genmxE -mul_row_col submxMl. Qed.

(** V_k in the range of [A F]. *)
Definition held_in_range k : 'M[K]_n := (iter k hold_step 1%:M :&: range)%MS.

Lemma hold_in_range U : (hold_step U <= hold_step (U :&: range)%MS)%MS.
Proof.
apply/row_subP => i; have /hold_stepP[w [e h]] := row_sub i (hold_step U).
by apply/hold_stepP; exists w; split=> //; rewrite sub_capmx h next_in_range.
Qed.

Lemma held_in_range_falls k : (held_in_range k.+1 <= held_in_range k)%MS.
Proof. by apply: capmxS; [apply: (iter_decreasing_step (@hold_step_mono _ _ _ _ S)) | apply: submx_refl]. Qed.

Lemma held_in_range_stays j k : (held_in_range j <= held_in_range j.+1)%MS -> (held_in_range j <= held_in_range (k + j))%MS.
Proof.
move=> stop; elim: k => [|k IH]; first exact: submx_refl.
apply: submx_trans stop _; apply: capmxS; last exact: submx_refl.
apply: submx_trans (hold_in_range _) _; apply: hold_step_mono; apply: submx_trans IH _; exact: capmxSl.
Qed.

Theorem delay_within_range : (exists l, tells l) -> tells (\rank (col_mx (sysA S) (sysF S))).
Proof.
set d := \rank _ => -[l h]; have [[j jd stop]|] := falls_or_stops d.+1 held_in_range_falls.
  apply: tells_longer (jd : (j <= d)%N) _; have [lj|jl] := leqP l j; first exact: tells_longer lj h.
  apply/tellsP => x w e held; apply: ((tellsP l).1 h x w e).
  suff : ((x *m sysA S + w *m sysF S)%R <= held_in_range l)%MS by rewrite sub_capmx => /andP[].
  by rewrite -(subnK (ltnW jl)); apply: submx_trans (held_in_range_stays _ stop); rewrite sub_capmx held next_in_range.
have : (\rank (held_in_range 0) <= d)%N by rewrite /d -(genmxE (col_mx _ _)); apply: mxrankS; apply: capmxSr.
by lia.
Qed.

(** ** m + n - rank C *)

(** V_1: what C takes into the range of G. *)
Lemma rank_held_once : (\rank (hold_step 1%:M) + \rank (sysC S) <= n + \rank (sysG S))%N.
Proof.
have sub : (hold_step 1%:M <= kermx (sysC S *m cokermx (sysG S)))%MS.
  apply/row_subP => i; have /hold_stepP[w [/eqP]] := row_sub i (hold_step 1%:M); rewrite addr_eq0 => /eqP e _.
  by apply/sub_kermxP; rewrite mulmxA e mulNmx -mulmxA mulmx_coker mulmx0 oppr0.
have := mxrankS sub; rewrite mxrank_ker; have := mxrank_mul_ker (sysC S) (cokermx (sysG S)).
have : (\rank (sysC S :&: kermx (cokermx (sysG S))) <= \rank (sysG S))%N.
  apply: leq_trans (mxrankS (capmxSr _ _)) _; rewrite mxrank_ker mxrank_coker subKn // rank_leq_col //.
have := rank_leq_row (sysC S); have := rank_leq_row (sysC S *m cokermx (sysG S)); lia.
Qed.

Theorem delay_within_outputs : (exists l, tells l) -> tells (m + n - \rank (sysC S))%N.
Proof.
have [e eE] : exists e, e = (m + n - \rank (sysC S))%N by exists (m + n - \rank (sysC S))%N.
rewrite -eE => -[l h]; pose V k := iter k.+1 hold_step 1%:M.
have falls k : (V k.+1 <= V k)%MS by apply: (iter_decreasing_step (@hold_step_mono _ _ _ _ S)).
have [[j je stop]|small] := falls_or_stops e falls.
  apply: tells_longer (je : (j.+1 <= e)%N) _; have [lj|jl] := leqP l j.+1; first exact: tells_longer lj h.
  apply/tellsP => x w xw held; apply: ((tellsP l).1 h x w xw); apply: submx_trans held _.
  by rewrite -(subnK (ltnW jl)); apply: (iter_stays (@hold_step_mono _ _ _ _ S)).
have V_0 : (\rank (V 0%N) + \rank (sysC S) <= n + \rank (sysG S))%N := rank_held_once.
have C_n := rank_leq_row (sysC S); have G_m := rank_leq_row (sysG S).
have Ve0 : V e = 0 by apply/eqP; rewrite -mxrank_eq0; lia.
have G_free : row_free (sysG S) by rewrite /row_free; lia.
apply/tellsP => x w xw held; have x0 : x = 0.
  by apply/eqP; rewrite -submx0 -Ve0; apply/hold_stepP; exists w.
by move: xw; rewrite x0 mul0mx add0r => /eqP; rewrite mulmx_free_eq0 // => /eqP.
Qed.

End InputDelay.
