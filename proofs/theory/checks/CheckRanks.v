(** Ranks of all windows of a concrete system over the rational numbers: kernel rows bound them from above, words of n + 1 samples from
    below; where these meet at s = n + 1, they meet at every s. And left-invertibility from words alone. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset order
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv ssrnum ssrint rat matrix mxalgebra mxpoly vector fraction interval.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Gap Balance Lag Proposition3 NormalRank.
From faultspace Require Import CertificatesVocabulary Independence KernelRows Elimination IntegralWindows CheckRows CheckMinimal.
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
Hypotheses (ind : independent_leading rows) (ann : annihilates rows S).

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

(** The rows of hints: their leading coefficients, and all windows. *)
Lemma minimal_independent rows h : minimal n m p l L rows h -> sorted leq [seq size row.2 | row <- rows] ->
  independent_leading (meant_rows p rows).
Proof.
case/andP=> /and4P[l1 _ /allP shapes _] /and4P[/andP[lead_unit lead_ok] _ _ _] ascending.
apply: ascending_independent => //; first by apply/allP => row /shapes/andP[].
have [K vanishing] := field_modulo l1; rewrite mat_image; apply: unit_by_determinant.
move: (invertible_neq0 vanishing lead_unit); rewrite -(is_determinant_sound vanishing lead_ok) mat_image det_map_mx.
by apply: contraNneq => ->; rewrite rmorph0.
Qed.

Lemma rows_at_most p' rows : independent_leading (meant_rows p' rows) -> (size rows <= p')%N.
Proof.
move=> ind; pose k := sumn [seq size row.2 | row <- rows].
have all_active : count (fun c => size c <= k.+1)%N (meant_rows p' rows) = size (meant_rows p' rows).
  apply/eqP; rewrite -all_count; apply/allP => c /mapP[row row_in ->].
  rewrite size_map; apply: leqW; rewrite /k sumnE big_map (big_rem row) //=; exact: leq_addr.
by have := rank_leq_row (leading_active (meant_rows p' rows) k); rewrite ind size_filter all_active size_map.
Qed.

Lemma bound_formula rows s : independent_leading (meant_rows p rows) -> all (fun row => 0 < size row.2)%N rows ->
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

Lemma seen_meets s rows h : well_formed n m p L -> minimal n m p l L rows h -> sorted leq [seq size row.2 | row <- rows] ->
  annihilates (meant_rows p rows) S -> \rank (window S s) = bound (meant_rows p rows) s.
Proof.
move=> wf ok ascending ann; have ind := minimal_independent ok ascending; have [_ from_below] := minimal_sound wf ok.
apply/eqP; rewrite eqn_leq window_bound //= bound_formula ?from_below //.
by case/andP: ok => /and4P[_ _ /allP shapes _] _; apply/allP => row /shapes/andP[].
Qed.

Lemma meets_sound s rows lower : meets n m p s l L rows lower ->
  [/\ well_formed n m p L, independent_leading (meant_rows p rows), annihilates (meant_rows p rows) S
    & \rank (window S s) = bound (meant_rows p rows) s].
Proof.
case/andP=> wf; case: lower => [ws /and3P[/andP[ok ann] w /eqP e]|h /and3P[ascending ann ok]]; have {}ann := rows_annihilate wf ann.
  have ind := admissible_independent ok; split=> //.
  by apply/eqP; rewrite eqn_leq window_bound //= -ceiling_bound -e; apply: words_rank w.
by split=> //; [apply: minimal_independent ok ascending|apply: seen_meets ok ascending ann].
Qed.

Lemma meets_nonempty s rows lower : meets n m p s l L rows lower -> all (fun row => 0 < size row.2)%N rows.
Proof.
case/andP=> _; case: lower => [ws /and3P[/andP[/and3P[/allP shapes _ _] _] _ _]|h /and3P[_ _ /andP[/and4P[_ _ /allP shapes _] _]]].
  by apply/allP => row /shapes/andP[].
by apply/allP => row /shapes/andP[].
Qed.

(** `window-ranks`. *)
Lemma follows_sound r etas ranks rows : follows p r etas ranks rows ->
  (forall s, \rank (window S s) = s * (p - size rows) + \sum_(eta <- degrees rows) minn s eta)%N ->
  (forall s, \rank (window S s) = s * r + \sum_(eta <- etas) minn s eta)%N /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof.
case/and3P=> /eqP er /eqP <- /eqP eranks h.
have {}h s : (\rank (window S s) = s * r + \sum_(eta <- degrees rows) minn s eta)%N by rewrite h; have -> : (p - size rows = r)%N by lia.
split=> //; rewrite [RHS]eranks; apply: eq_map => s; by rewrite h sumnE big_map.
Qed.

Theorem window_ranks_sound r etas ranks rows lower : check_window_ranks n m p r etas ranks l L rows lower ->
  (forall s, \rank (window S s) = s * r + \sum_(eta <- etas) minn s eta)%N /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof.
case/andP=> ok follow; apply: follows_sound follow _ => s; have [wf ind ann e] := meets_sound ok.
by rewrite (meets_for_ever ind ann s e) bound_formula ?(meets_nonempty ok).
Qed.

(** The same with rows modulo l alone, where a window has all the rank that its shape allows. *)
Lemma generic_bound rows s : generic n m p rows -> (size rows <= p)%N ->
  (minn (s * p) (n + s * m) <= s * (p - size rows) + \sum_(mu <- degrees rows) minn s mu)%N.
Proof.
case/orP=> [|/and3P[/eqP sizes /eqP sum /allP close] few].
  by case: rows => // _ _; rewrite subn0 big_nil addn0 geq_minl.
have [low|/allPn[mu mu_in]] := boolP (all (fun mu => s <= mu)%N (degrees rows)).
  have -> : (\sum_(mu <- degrees rows) minn s mu = s * size rows)%N.
    rewrite (eq_big_seq (fun=> s)) => [|mu /(allP low)/minn_idPl //].
    by rewrite big_const_seq count_predT iter_addn_0 size_map mulnC.
  by rewrite -mulnDr subnK // geq_minl.
rewrite -ltnNge => short; have high mu' : mu' \in degrees rows -> (mu' <= s)%N.
  by move=> /(allP (close _ mu_in)) h; apply: leq_trans h short.
have -> : (\sum_(mu <- degrees rows) minn s mu = n)%N.
  by rewrite -sum sumnE; apply: eq_big_seq => mu' /high/minn_idPr.
by have -> : (p - size rows = m)%N by [lia]; rewrite addnC geq_minr.
Qed.

Theorem window_ranks_modulo_sound r etas ranks rows h : check_window_ranks_modulo n m p r etas ranks l L rows h ->
  (forall s, \rank (window S s) = s * r + \sum_(eta <- etas) minn s eta)%N /\ [seq \rank (window S s) | s <- iota 1 (size ranks)] = ranks.
Proof.
case/and5P=> wf _ shape ok follow; apply: follows_sound follow _ => s; have [few from_below] := minimal_sound wf ok.
apply/eqP; rewrite eqn_leq from_below andbT; apply: leq_trans (generic_bound s shape few).
by rewrite leq_min rank_leq_col rank_leq_row.
Qed.

Corollary window_ranks_gap r etas ranks rows lower : check_window_ranks n m p r etas ranks l L rows lower ->
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

Lemma rank_left_invertible : (n.+1 * m <= \rank (window S n.+1))%N -> left_invertible S.
Proof.
move=> enough; apply/left_invertibleP; have := rank_at_most S n.+1.
have := null_constant S (leqnSn n); case: (Balance.null S n) => // d ->.
have : (n.+1 <= n.+1 * d.+1)%N by rewrite leq_pmulr.
lia.
Qed.

Theorem left_invertible_sound ws : check_left_invertible n m p l L ws -> left_invertible S.
Proof. by case/and3P=> wf w enough; apply: rank_left_invertible; apply: leq_trans enough _; apply: words_rank w. Qed.

(** The pencil has full row rank at a point, or at infinity, modulo l. *)
Theorem left_invertible_at_sound q rows columns d : check_left_invertible_at n m p l L q rows columns d -> left_invertible S.
Proof.
case/and5P=> wf /field_modulo[K vanishing] _ /eqP full /(pencil_minor_sound vanishing wf); rewrite full pencil_rank_gap leq_add2l => gap_m.
apply: rank_left_invertible; apply: leq_trans (rank_from_below K _ wf).
suff h s : (s <= n.+1)%N -> (s * m <= \rank (window (over_field K n m p L) s))%N by apply: h.
elim: s => // s IH sn; rewrite rank_window_step mulSn addnC leq_add ?IH ?(ltnW sn) //.
by apply: leq_trans gap_m _; apply: gap_at_least_last.
Qed.

End Sound.
