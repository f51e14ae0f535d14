(** One sample more. The rank of the window grows from s to s + 1 samples by gap s, the dimension of { x C + v G : x in W_s }: the possible
    values of r(s) after s zeros. The gap never grows, and is constant from s = n on. Whenever it no longer changes from M on, a sequence
    is a sequence of words as soon as all its parts of M + 1 samples are words.

    only_at s d k == d at time s, and 0 at all others *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Chain.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Gap.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (d : 'rV[K]_p) (v : nat -> 'rV[K]_m) (r : nat -> 'rV[K]_p) (s : nat).

Notation after_zeros := (after_zeros S).
Notation gap := (gap S).

Definition only_at s d k : 'rV[K]_p := if k == s then d else 0.

Lemma after_zerosP s d : (d <= after_zeros s)%MS <-> word S s.+1 (only_at s d).
Proof.
split=> [/submxP[c ->]|[x [v h]]].
  rewrite -(hsubmxK c) mul_row_col mulmxA.
  have /silentP[x [v [h e]]] : (lsubmx c *m silent S s <= silent S s)%MS by apply: submxMl.
  exists x, (follow s v (fun=> rsubmx c)) => k; rewrite ltnS leq_eqVlt /only_at => /orP[/eqP->|ks].
    by rewrite eqxx -[s in output _ _ _ s]addn0 output_follow_after /output /= e.
  by rewrite ltn_eqF // output_follow_before ?h.
have -> : d = state S x v s *m sysC S + v s *m sysG S by rewrite -[RHS]/(output S x v s) -h // /only_at eqxx.
have /submxP[c ->] : (state S x v s <= silent S s)%MS.
  by apply/silentP; exists x, v; split=> // j js; rewrite -h /only_at ?ltn_eqF // leqW.
by rewrite -mulmxA -mul_row_col; apply: submxMl.
Qed.

Lemma after_zeros_decreasing s t : (s <= t)%N -> (after_zeros t <= after_zeros s)%MS.
Proof.
move=> st; rewrite col_mx_sub; apply/andP; split.
  by apply: submx_trans (submxMr _ (silent_decreasing S st)) _; rewrite -addsmxE addsmxSl.
by rewrite -addsmxE addsmxSr.
Qed.

Theorem gap_decreasing s t : (s <= t)%N -> (gap t <= gap s)%N.
Proof. by move=> st; apply/mxrankS/after_zeros_decreasing. Qed.

Theorem gap_constant s : (n <= s)%N -> gap s = gap n.
Proof.
move=> ns; apply/eqP; rewrite eqn_leq gap_decreasing //; apply: mxrankS.
rewrite col_mx_sub; apply/andP; split.
  by apply: submx_trans (submxMr _ (silent_constant S ns)) _; rewrite -addsmxE addsmxSl.
by rewrite -addsmxE addsmxSr.
Qed.

Lemma gap_le_outputs s : (gap s <= p)%N. Proof. exact: rank_leq_col. Qed.

(** The gap is the growth of the rank: forget the last sample. *)
Theorem rank_window_step s : \rank (window S s.+1) = (\rank (window S s) + gap s)%N.
Proof.
have lin_forget : linear (fun u : 'rV[K]_(s.+1 * p) => samples s (unsamples u)).
  by move=> a u w; rewrite -samples_scale -samples_add; apply: samples_ext => k _; rewrite unsamples_linear.
have lin_last : linear (fun u : 'rV[K]_(s.+1 * p) => unsamples u s) by move=> a u w; rewrite unsamples_linear.
have lin_only : linear (fun d => samples s.+1 (only_at s d)).
  move=> a d e; rewrite -samples_scale -samples_add; apply: samples_ext => k _.
  by rewrite /only_at; case: (k == s); rewrite ?scaler0 ?addr0.
pose R := lin1_mx (fun u : 'rV[K]_(s.+1 * p) => samples s (unsamples u)).
pose L := lin1_mx (fun u : 'rV[K]_(s.+1 * p) => unsamples u s); pose E := lin1_mx (fun d => samples s.+1 (only_at s d)).
have RE u : u *m R = samples s (unsamples u) by apply: mul_lin1 lin_forget.
have LE u : u *m L = unsamples u s by apply: mul_lin1 lin_last.
have EE d : d *m E = samples s.+1 (only_at s d) by apply: mul_lin1 lin_only.
have E_free : row_free E.
  apply/row_freeP; exists L; apply/row_matrixP=> i; rewrite rowE mulmxA EE LE samplesK //.
  by rewrite /only_at eqxx row1.
rewrite -(mxrank_mul_ker (window S s.+1) R) /gap -(mxrankMfree (after_zeros s) E_free); congr (_ + _)%N.
  apply: eqmx_rank; apply/andP; split; apply/row_subP=> i.
    rewrite row_mul RE; apply/windowP/(word_prefix (leqnSn s))/sub_windowP; exact: row_sub.
  have /sub_windowP[x [v h]] := row_sub i (window S s).
  apply/submxP; exists (row_mx x (samples s.+1 v)); rewrite mulmxA window_response RE -[LHS]unsamplesK.
  by apply: samples_ext => k ks; rewrite samplesK ?h // leqW.
apply: eqmx_rank; apply/andP; split; apply/row_subP=> i.
  have := row_sub i (window S s.+1 :&: kermx R)%MS; set u := row _ _; rewrite sub_capmx => /andP[/sub_windowP u_word /sub_kermxP].
  rewrite RE => /samples_eq0 u0.
  have e k : (k < s.+1)%N -> unsamples u k = only_at s (unsamples u s) k.
    by rewrite ltnS leq_eqVlt /only_at => /orP[/eqP->|ks]; [rewrite eqxx|rewrite ltn_eqF ?u0].
  rewrite -[u]unsamplesK (samples_ext e) -EE; apply/submxMr/after_zerosP; exact: word_ext e u_word.
rewrite row_mul EE sub_capmx; apply/andP; split; first by apply/windowP/after_zerosP; apply: row_sub.
apply/sub_kermxP; rewrite RE; apply/samples_eq0=> k ks.
by rewrite samplesK ?leqW // /only_at ltn_eqF.
Qed.

Corollary gap_is_rank_difference s : gap s = (\rank (window S s.+1) - \rank (window S s))%N.
Proof. by rewrite rank_window_step addKn. Qed.

Theorem rank_window s : \rank (window S s) = (\sum_(j < s) gap j)%N.
Proof. by elim: s => [|s IH]; [rewrite big_ord0; apply/eqP; rewrite -leqn0 rank_leq_col|rewrite rank_window_step big_ord_recr IH]. Qed.

(** Gluing: the second word, compared with a continuation of the first, differs in its last sample by a value that may follow zeros. *)
Theorem glue M r : (forall s, (M <= s)%N -> gap s = gap M) ->
  (forall j, word S M.+1 (fun k => r (j + k)%N)) -> forall s, word S s r.
Proof.
move=> const local s.
suff h j : word S s (fun k => r (j + k)%N) by apply: word_ext (h 0%N).
elim: s j => [|s IH] j; first by exists 0, (fun=> 0).
have [sM|Ms] := leqP s M; first exact: word_prefix (local j).
have [x [v h]] := IH j; pose d := r (j + s)%N - output S x v s.
have d_next : (d <= after_zeros s)%MS.
  have eqZ : (after_zeros s == after_zeros s.-1)%MS.
    rewrite -(mxrank_leqif_eq (after_zeros_decreasing (leq_pred s))) -/(gap s) -/(gap s.-1).
    by rewrite !const // ?(ltnW Ms) // -ltnS (ltn_predK Ms).
  have /andP[_ sub] := eqZ; apply: submx_trans sub; apply/after_zerosP; rewrite (ltn_predK Ms).
  have q_word : word S s (fun k => output S x v (1 + k)%N) by apply: (@word_suffix _ _ _ _ S 1 s); apply: output_word.
  apply: word_ext (word_sub (IH j.+1) q_word) => k ks; rewrite /only_at addSnnS add1n.
  case: eqP => [->|/eqP k_last]; first by rewrite (ltn_predK Ms).
  by rewrite h ?subrr // ltn_neqAle -(ltn_predK Ms) eqSS k_last (ltn_predK Ms) ks.
apply: word_ext (word_add (output_word S s.+1 x v) ((after_zerosP s d).1 d_next)) => k.
rewrite ltnS leq_eqVlt /only_at => /orP[/eqP->|ks]; first by rewrite eqxx addrC subrK.
by rewrite ltn_eqF // addr0 h.
Qed.

End Gap.
