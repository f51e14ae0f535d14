(** Ranks of all windows, left-invertibility and behaviours of systems told by lists of numbers. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Basics Infinite Balance Proposition3.
From faultspace Require Import NumbersVocabulary NumberLists KernelRows ListedSystems CheckRanks FieldRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Sound.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation table := (seq (seq (numeral R))).
Notation kernel_rows := (seq (nat * table)).
Notation rows_of := (rows_of value).
Variables (n m n' m' p : nat) (L L' : listing R).
Let S := system_of value n m p L.
Let S' := system_of value n' m' p L'.

Lemma rows_few rows : independent_leading (rows_of p rows) -> (size rows <= p)%N.
Proof.
move=> ind; pose k := sumn [seq size row.2 | row <- rows].
have all_active : count (fun c => size c <= k.+1)%N (rows_of p rows) = size (rows_of p rows).
  apply/eqP; rewrite -all_count; apply/allP => c /mapP[row row_in ->].
  rewrite size_map; apply: leqW; rewrite /k sumnE big_map (big_rem row) //=; exact: leq_addr.
by have := rank_leq_row (leading_active (rows_of p rows) k); rewrite ind size_filter all_active size_map.
Qed.

Lemma bound_by_degrees rows s : independent_leading (rows_of p rows) -> all (fun row => 0 < size row.2)%N rows ->
  bound (rows_of p rows) s = (s * (p - size rows) + \sum_(eta <- [seq (size row.2).-1 | row <- rows]) minn s eta)%N.
Proof.
move=> /rows_few few nonempty; rewrite -allowed_bound /allowed; elim: s => [|s IH].
  by rewrite big1 // => eta _; rewrite min0n.
rewrite -[in iota _ _]addn1 iotaD map_cat sumn_cat IH /= addn0 add0n mulSn -!addnA [RHS]addnCA; congr (_ + _)%N.
suff -> : (\sum_(eta <- [seq (size row.2).-1 | row <- rows]) minn s.+1 eta = \sum_(eta <- [seq (size row.2).-1 | row <- rows]) minn s eta
    + (size rows - count (fun row => size row.2 <= s.+1) rows))%N.
  have := count_size (fun row : nat * table => size row.2 <= s.+1)%N rows; set c := count _ _; move: (c) few => d; lia.
rewrite !big_map -[size rows](count_predC (fun row : nat * table => size row.2 <= s.+1)%N) addKn.
rewrite -sum1_count [X in _ = (_ + X)%N]big_mkcond -big_split /=.
apply: eq_big_seq => row /(allP nonempty) h; case e: (size row.2 <= s.+1)%N => /=; move: h e; case: (size row.2) => [|d] /=; lia.
Qed.

Theorem has_window_ranks_sound r etas ranks rows Q ws : has_window_ranks n m p r etas ranks L rows Q ws ->
  (forall s, \rank (window S s) = s * r + \sum_(eta <- etas) minn s eta)%N /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof.
case/and4P=> ok /eqP er /eqP <- /eqP eranks; have [wf ind ann e] := all_there_are_sound meaning ok.
have h s : (\rank (window S s) = s * r + \sum_(eta <- [seq (size row.2).-1 | row <- rows]) minn s eta)%N.
  rewrite (meets_for_ever ind ann s e) bound_by_degrees ?(nonempty_rows ok) //.
  by have -> : (p - size rows = r)%N by lia.
by split=> //; rewrite [RHS]eranks; apply: eq_map => s; rewrite h sumnE !big_map.
Qed.

Theorem is_left_invertible_sound ws : is_left_invertible n m p L ws -> left_invertible S.
Proof.
case/and3P=> wf /(possible_rank meaning wf) low enough; have {low enough} := leq_trans enough low.
move=> enough; apply/left_invertibleP; have := rank_at_most S n.+1.
have := null_constant S (leqnSn n); case: (Balance.null S n) => // d ->.
have : (n.+1 <= n.+1 * d.+1)%N by rewrite leq_pmulr.
move: enough; rewrite -/S; lia.
Qed.

Theorem is_included_sound rows Q ws : is_included n m n' m' p L L' rows Q ws ->
  (forall s r, word S s r -> word S' s r) /\ (forall r, behavior S r -> behavior S' r).
Proof.
case/and3P=> /(all_there_are_sound meaning)[_ ind ann' e] wf k; have ann := rows_annihilating meaning wf k.
have sub s r : word S s r -> word S' s r.
  by move=> h; apply/(word_iff_satisfies ind ann'); [apply: meets_for_ever|apply: word_satisfies h].
by split=> //; apply/behavior_subP.
Qed.

Theorem are_equal_sound rows Q ws ws' : are_equal n m n' m' p L L' rows Q ws ws' ->
  (forall s r, word S s r <-> word S' s r) /\ (forall r, behavior S r <-> behavior S' r).
Proof.
case/andP=> /(all_there_are_sound meaning)[_ ind ann e] /(all_there_are_sound meaning)[_ _ ann' e'].
have eq s r : word S s r <-> word S' s r.
  have h := word_iff_satisfies ind ann r (meets_for_ever ind ann s e).
  have h' := word_iff_satisfies ind ann' r (meets_for_ever ind ann' s e').
  by split=> [/h/h'|/h'/h].
by split=> //; apply/behavior_eqP.
Qed.

Theorem are_equal_on_sound s rows Q ws ws' : are_equal_on n m n' m' p s L L' rows Q ws ws' -> forall r, word S s r <-> word S' s r.
Proof.
case/and3P=> _ /(word_iff_rows meaning) h /(word_iff_rows meaning) h' r.
by split=> [/h/h'|/h'/h].
Qed.

Lemma paired_meaning c rs : all (fun r => size r <= p)%N rs -> (size c <= size rs)%N ->
  relation (columns_of value p c) (fun k => vector_of value p (nth [::] rs k)) = (value (paired c rs))%:M.
Proof.
rewrite /paired; elim: c rs => [|c0 c IH] rs.
  by move=> _ _; rewrite /relation big_ord0; case: rs => [|r rs] /=; rewrite (value_zero meaning) raddf0.
case: rs => // r rs /= /andP[r_p h] few; rewrite relation_cons /= (inner_product meaning _ r_p) IH //.
by rewrite -raddfD -(value_plus meaning).
Qed.

Theorem differ_sound s x vs c : differ n m n' m' p s L L' x vs c -> exists2 r, word S s r & ~ word S' s r.
Proof.
case/andP=> /and5P[wf wf' ann /andP[_ cs] /eqP sv] /andP[short different].
exists (output S (vector_of value n x) (signal_of value m vs)); first exact: output_word.
move=> [y [w e]]; have /eqP[] := value_invertible meaning different.
have so : size (outputs L x vs) = s by rewrite outputs_size.
have := paired_meaning short (_ : (size c <= _)%N); rewrite so => /(_ cs)/matrixP/(_ 0 0); rewrite [in RHS]mxE mulr1n => <-.
have -> : relation (columns_of value p c) (fun k => vector_of value p (nth [::] (outputs L x vs) k)) =
    relation (columns_of value p c) (output S' y w).
  apply: eq_bigr => k _; have ks : (k < s)%N by apply: leq_trans (ltn_ord k) _; rewrite size_map.
  by rewrite (outputs_output meaning wf) ?sv // e.
by rewrite (annihilating_sound meaning wf' ann) mxE.
Qed.

End Sound.
