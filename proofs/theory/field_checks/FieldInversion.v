(** Faults that cannot be seen, and the delay with which the first one is determined, of a system told by lists of numbers. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix.
From faultspace Require Import Vocabulary Basics.
From faultspace Require Import NumbersVocabulary NumberLists KernelRows ListedSystems CheckInversion FieldRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Sound.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Variables (n m p : nat) (L : listing R).
Let S := system_of value n m p L.
Notation vec := (vector_of value).
Notation column := (column_of value).

Lemma blank_outputs x vs k : sized n m p L -> all (@blank R) (outputs L x vs) -> (k < size vs)%N ->
  output S (vec n x) (signal_of value m vs) k = 0.
Proof.
move=> wf /allP zero kv; rewrite -(outputs_output meaning wf) // (vec_blank meaning) //; apply/zero/mem_nth.
by rewrite outputs_size.
Qed.

Theorem is_not_left_invertible_sound xs vs : is_not_left_invertible n m p L xs vs -> ~ left_invertible S.
Proof.
case/and5P=> wf zero /(vec_blank meaning n) stops /hasP[v v_in v0] _ inv.
have at_rest : state S 0 (signal_of value m vs) (size vs) = 0.
  have := trajectory_state meaning wf [::] (leqnn (size vs)); rewrite (vec_nil meaning) => <-.
  by rewrite -stops -nth_last trajectory_size.
have silent k : output S 0 (signal_of value m vs) k = 0.
  have [kv|vk] := ltnP k (size vs); first by rewrite -(vec_nil meaning n); apply: blank_outputs.
  by rewrite -(subnKC vk) output_shift at_rest output_zero // => j _; rewrite /signal_of nth_default ?(vec_nil meaning) ?leq_addr.
have := inv _ silent (index v vs); rewrite /signal_of nth_index //.
by move/eqP; rewrite (negPf (nonzero_vector meaning v0)).
Qed.

Lemma unseen_sound known s x vs : unseen n m p known s L x vs -> forall j, (j < s)%N -> ~ determines S known j.
Proof.
case/and5P=> wf /eqP sv zero nz /implyP rest j js h; have /negP := nonzero_vector meaning nz; rewrite -nth0; apply; apply/eqP.
apply: (h (vec n x) (signal_of value m vs)) => [/rest|k kj]; first exact: (vec_blank meaning).
by apply: blank_outputs => //; rewrite sv (leq_ltn_trans kj js).
Qed.

Lemma gives_sound known l i row x v : sized n m p L -> gives m known l L i row -> (known -> x = 0) ->
  (forall k, (k <= l)%N -> output S x v k = 0) -> forall im : (i < m)%N, v 0%N 0 (Ordinal im) = 0.
Proof.
rewrite /gives => wf; case e: (costates L row) => [X ds].
case/and4P=> /eqP sl initial /allP later first rest zero im.
have : relation (columns_of value p row) (output S x v) = 0.
  by rewrite /relation big1 // => k _; rewrite zero ?mul0mx //; rewrite -ltnS -sl -(size_map (column p)).
rewrite relation_horner.
have state0 : x *m horner_state (sysA S) (sysC S) (columns_of value p row) = 0.
  case/orP: initial => [/rest ->|X0]; first by rewrite mul0mx.
  by rewrite -(costates_meaning meaning wf) e /column_of (vec_blank meaning) // trmx0 mulmx0.
have sds : size ds = l.+1 by have := costates_size L row; rewrite e sl.
have action k : (k < l.+1)%N -> fault_action S (columns_of value p row) k = column m (effect (tF L) (tG L) (nth ([::], [::]) ds k)).
  by move=> kl; rewrite (condition_meaning meaning wf erefl erefl) ?sl // e (effect_meaning meaning wf).
rewrite state0 add0r size_map sl big_ord_recl big1 => [|k _]; last first.
  rewrite lift0 action ?ltnS // /column_of (vec_blank meaning) ?trmx0 ?mulmx0 //; apply: later; rewrite -nth_behead; apply: mem_nth.
  by rewrite size_behead sds.
rewrite addr0 action // nth0 (_ : column m _ = delta_mx (Ordinal im) 0).
  rewrite -colE => /matrixP/(_ 0 0); by rewrite !mxE.
rewrite /column_of (vec_same meaning m first) -[mkseq _ _]/(unit_row R m (Ordinal im)) (unit_row_vec meaning) row1.
by rewrite trmx_delta.
Qed.

Lemma inverts_sound known l rows : inverts n m p known l L rows -> determines S known l.
Proof.
case/and3P=> wf /eqP sr /allP h x v rest zero; apply/rowP => i; rewrite mxE.
have i_in : nat_of_ord i \in iota 0 m by rewrite mem_iota /=.
by have := gives_sound wf (h _ i_in) rest zero (ltn_ord i); congr (v _ _ _ = _); apply: val_inj.
Qed.

Theorem has_delay_sound known l rows x vs : has_delay n m p known l L rows x vs ->
  [/\ (l <= n)%N, determines S known l & forall j, (j < l)%N -> ~ determines S known j].
Proof.
case/and3P=> ln /inverts_sound d; case/orP=> [/eqP l0|a]; first by split=> // j; rewrite l0.
by split=> //; apply: unseen_sound a.
Qed.

Theorem has_no_delay_sound known x vs : has_no_delay n m p known L x vs -> forall j, (j <= n)%N -> ~ determines S known j.
Proof. by move=> a j jn; apply: unseen_sound a _ jn. Qed.

End Sound.
