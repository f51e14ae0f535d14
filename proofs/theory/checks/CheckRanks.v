(** Ranks of all windows of a concrete system over the rational numbers: kernel rows bound them from above, words of n + 1 samples from
    below; where these meet at s = n + 1, they meet at every s. And left-invertibility from words alone. *)
From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Gap Balance Proposition3.
From faultspace Require Import CertificatesVocabulary KernelRows CheckRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma ceiling_bound p rows s : ceiling p rows s = bound (meant_rows p rows) s.
Proof.
rewrite /ceiling /bound sumnE big_map -{1}[s]subn0 big_mkord; apply: eq_bigr => k _; congr (_ - _)%N.
rewrite /active size_filter /meant_rows count_map; apply: eq_count => row /=; by rewrite size_map.
Qed.

Section RoomPastTheStates.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (rows : seq (seq 'cV[K]_p)).
Hypotheses (ind : independent_leads rows) (ann : annihilates rows S).

Lemma room_decreasing j k : (j <= k)%N -> (room rows k <= room rows j)%N.
Proof.
move=> jk; apply: leq_sub2l; rewrite !size_filter; apply: sub_count => c /= h; exact: leq_trans h _.
Qed.

Theorem meets_for_ever s : \rank (window S n.+1) = bound rows n.+1 -> \rank (window S s) = bound rows s.
Proof.
move=> e; have [sn|ns] := leqP s n.+1; first by have := meets_before ind ann sn e.
have en := meets_before ind ann (leqnSn n) e.
have gap_n : gap S n = room rows n by move: e; rewrite rank_window_step /bound big_ord_recr /= -/(bound rows n) en => /addnI.
suff h d : \rank (window S (d + n)) = bound rows (d + n) by have := h (s - n)%N; rewrite subnK // ltnW // ltnW.
elim: d => // d IH; apply/eqP; rewrite eqn_leq window_bound //= addSn rank_window_step IH gap_constant ?leq_addl // gap_n.
by rewrite /bound big_ord_recr leq_add2l room_decreasing ?leq_addl.
Qed.

End RoomPastTheStates.

Section Sound.
Variables (n m p : nat) (L : listed) (l : Z).
Let S := meant n m p L.

Lemma meets_sound s rows ws : meets n m p s l L rows ws ->
  [/\ well_formed n m p L, independent_leads (meant_rows p rows), annihilates (meant_rows p rows) S
    & \rank (window S s) = bound (meant_rows p rows) s].
Proof.
case/and4P=> wf k w /eqP e; have ind := admissible_independent (andP k).1; have ann := kernel_annihilates wf k; split=> //.
by apply/eqP; rewrite eqn_leq window_bound //= -ceiling_bound -e; apply: words_rank w.
Qed.

Lemma rows_at_most p' rows : independent_leads (meant_rows p' rows) -> (size rows <= p')%N.
Proof.
move=> ind; pose k := sumn [seq size row.2 | row <- rows].
have all_active : count (fun c => size c <= k.+1)%N (meant_rows p' rows) = size (meant_rows p' rows).
  apply/eqP; rewrite -all_count; apply/allP => c /mapP[row row_in ->].
  rewrite size_map; apply: leqW; rewrite /k sumnE big_map (big_rem row) //=; exact: leq_addr.
by have := rank_leq_row (leads (meant_rows p' rows) k); rewrite ind size_filter all_active size_map.
Qed.

Lemma bound_formula rows s : independent_leads (meant_rows p rows) -> all (fun row => 0 < size row.2)%N rows ->
  bound (meant_rows p rows) s = (s * (p - size rows) + \sum_(eta <- degrees rows) minn s eta)%N.
Proof.
move=> /rows_at_most few nonempty; rewrite -ceiling_bound /ceiling; elim: s => [|s IH].
  by rewrite big1 // => eta _; rewrite min0n.
rewrite -[in iota _ _]addn1 iotaD map_cat sumn_cat IH /= addn0 add0n mulSn -!addnA [RHS]addnCA; congr (_ + _)%N.
suff -> : (\sum_(eta <- degrees rows) minn s.+1 eta = \sum_(eta <- degrees rows) minn s eta
    + (size rows - count (fun row => size row.2 <= s.+1) rows))%N.
  have := count_size (fun row : kernel_row => size row.2 <= s.+1)%N rows; set c := count _ _; move: (c) few => d; lia.
rewrite /degrees !big_map -[size rows](count_predC (fun row : kernel_row => size row.2 <= s.+1)%N) addKn.
rewrite -sum1_count [X in _ = (_ + X)%N]big_mkcond -big_split /=.
apply: eq_big_seq => row /(allP nonempty) h; case e: (size row.2 <= s.+1)%N => /=; move: h e; case: (size row.2) => [|d] /=; lia.
Qed.

(** `window-ranks`. *)
Theorem window_ranks_sound r etas ranks rows ws : check_window_ranks n m p r etas ranks l L rows ws ->
  (forall s, \rank (window S s) = s * r + \sum_(eta <- etas) minn s eta)%N /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof.
case/and4P=> ok /eqP er /eqP <- /eqP eranks; have [wf ind ann e] := meets_sound ok.
have nonempty : all (fun row => 0 < size row.2)%N rows.
  by case/and4P: ok => _ /andP[/and3P[/allP h _ _] _] _ _; apply/allP => row /h/andP[].
have h s : (\rank (window S s) = s * r + \sum_(eta <- degrees rows) minn s eta)%N.
  by rewrite (meets_for_ever ind ann s e) bound_formula //; have -> : (p - size rows = r)%N by lia.
split=> //; rewrite [RHS]eranks; apply: eq_map => s; by rewrite h sumnE big_map.
Qed.

Corollary window_ranks_gap r etas ranks rows ws : check_window_ranks n m p r etas ranks l L rows ws ->
  forall s, gap S s = (r + count (fun eta => s < eta) etas)%N.
Proof.
move=> /window_ranks_sound[h _] s; have := rank_window_step S s; rewrite !h mulSn -addnA => e.
have : (\sum_(eta <- etas) minn s.+1 eta = \sum_(eta <- etas) minn s eta + count (fun eta => s < eta) etas)%N; last by lia.
rewrite -sum1_count [X in _ = (_ + X)%N]big_mkcond -big_split /=; apply: eq_bigr => eta _; case: ifP; lia.
Qed.

(** `left-invertible`. *)
Lemma rank_at_most (K : fieldType) (R : system K n m p) s :
  (\rank (window R s) + \rank (silent R s) + s * Balance.null R s <= n + s * m)%N.
Proof.
elim: s => [|s IH]; first by have := rank_leq_col (window R 0); have := rank_leq_row (silent R 0); lia.
have := rank_balance R s; have := null_decreasing R (leqnSn s); move: IH; rewrite rank_window_step !mulSn => IH mono.
have : (s * Balance.null R s.+1 <= s * Balance.null R s)%N by rewrite leq_mul2l mono orbT.
lia.
Qed.

Theorem left_invertible_sound ws : check_left_invertible n m p l L ws -> left_invertible S.
Proof.
case/and3P=> wf w enough; apply/left_invertibleP; have := words_rank wf w; rewrite -/S; have := rank_at_most S n.+1.
have := null_constant S (leqnSn n); case: (Balance.null S n) => // d ->.
have : (n.+1 <= n.+1 * d.+1)%N by rewrite leq_pmulr.
lia.
Qed.

End Sound.
