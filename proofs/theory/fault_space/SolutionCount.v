(** L2, for every system and every window s >= 1: the solutions of problem (11) have dimension
        n_z = n + (s + 1) gap (s - 1) - rank [O_s T_s] = n + p - sum of (eta + 1) over the left indices eta < s.
    Idea: the system with all solutions at s as faults has the same words of s samples, hence the same gaps before s. In it, a state u that
    solves the problem without feedthrough is reached silently at all times; W_(s-1) consists of these; and of the silent pairs (x, v)
    just those with such an x can be brought to zero. So the balance of dimensions of one silent step says it all.

              saturated == S with the rows of Z, which span the solutions at s, as its faults
    without_feedthrough == the f with which (f, 0) is a solution *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  vector zify.
From faultspace Require Import Vocabulary Basics Windows Chain Infinite Gap Balance Lag Problem11 Kick Solutions.
From faultspace Require Import CanonicalForm ZeroFeedthrough ClosedForm.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section SolutionCount.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s : nat).
Notation Z := (row_base (solution_space S s)).
Notation k := (\rank (solution_space S s)).

(** The largest system with these words, and the solutions without feedthrough. *)
Definition saturated : system K n k p := faults_of S Z.
Notation Q := saturated.
Definition without_feedthrough := kermx (rsubmx Z) *m lsubmx Z.
Notation U := without_feedthrough.

Lemma saturated_pair (w : 'rV_k) : row_mx (w *m sysF Q) (w *m sysG Q) = w *m Z.
Proof. by rewrite -mul_mx_row hsubmxK. Qed.

Lemma spans_Z : spans_solutions S s Z.
Proof. by move=> f g; rewrite (solution_spaceP S s) eq_row_base. Qed.

Lemma without_feedthroughP f : (f <= U)%MS <-> solves S s f 0.
Proof.
rewrite spans_Z; split=> [/submxP[c ->] | /submxP[c]].
  apply/submxP; exists (c *m kermx (rsubmx Z)); rewrite -[X in _ = _ *m X]hsubmxK mul_mx_row.
  by rewrite -!(mulmxA c) mulmx_ker mulmx0.
rewrite -[X in _ *m X]hsubmxK mul_mx_row => /eq_row_mx[-> /esym/sub_kermxP/submxP[d ->]].
by rewrite -mulmxA submxMl.
Qed.

Lemma saturated_words t r : (t <= s)%N -> word Q t r <-> word S t r.
Proof.
move=> ts; have to_S q : word Q s q -> word S s q by move: q; apply/(included_rows _ _ spans_Z); rewrite hsubmxK.
have to_Q q : word S s q -> word Q s q.
  have /submxP[P PZ] : (row_mx (sysF S) (sysG S) <= Z)%MS.
    apply/row_subP => i; rewrite row_row_mx !rowE; apply/spans_Z; exact: own_fault_solves.
  have [FE GE] : sysF S = P *m sysF Q /\ sysG S = P *m sysG Q by apply: eq_row_mx; rewrite PZ -mul_mx_row hsubmxK.
  move=> [x [v e]]; exists x, (fun j => v j *m P) => j js.
  by rewrite e // -(output_combined_faults Q P) -FE -GE -[with_faults Q _ _]/(with_faults S _ _) with_own_faults.
split=> /word_extends[q [/behavior_word h e]]; apply: (word_ext (r := q)) => [j jt|]; rewrite ?e //; apply: word_prefix ts _.
  exact: to_S.
exact: to_Q.
Qed.

Lemma saturated_gap t : (t < s)%N -> gap Q t = gap S t.
Proof.
move=> ts; have rank_eq j : (j <= s)%N -> \rank (window Q j) = \rank (window S j).
  by move=> js; apply/eqmx_rank/window_eqP => r; apply: saturated_words.
by apply: (@addnI (\rank (window S t))); rewrite -{1}rank_eq ?(ltnW ts) // -!rank_window_step rank_eq.
Qed.

Lemma without_feedthrough_reached t : (U <= silent Q t)%MS.
Proof.
elim: t => [|t IH]; first exact: submx1.
apply/row_subP => i; apply/silent_stepP.
have /submxP[w wZ] : (row_mx (row i U) 0 <= Z)%MS by apply/spans_Z/without_feedthroughP/row_sub.
exists 0, w; split; first exact: sub0mx.
  by move: wZ; rewrite -saturated_pair => /eq_row_mx[_ <-]; rewrite mul0mx addr0.
by move: wZ; rewrite -saturated_pair => /eq_row_mx[<- _]; rewrite mul0mx add0r.
Qed.

(** What is reached silently at s - 1, kicked in, solves the problem. *)
Lemma saturated_silent t : (s <= t.+1)%N -> (silent Q t :=: U)%MS.
Proof.
move=> st; apply/eqmxP; rewrite without_feedthrough_reached andbT; apply/row_subP => i.
apply/without_feedthroughP/solves_words => r.
have /solves_words sol : solves Q s (row i (silent Q t)) 0.
  apply/shift_solves; have /silentP/(kick_solves 0)/(solves_shorter st) := row_sub i (silent Q t).
  by rewrite /kick_f /kick_g !mul0mx !addr0.
by move/sol/(saturated_words _ (leqnn s)).
Qed.

Lemma saturated_null t : null Q t = \rank U.
Proof.
pose pick : 'M[K]_(n + k, n) := col_mx 1%:M 0.
have pickE x (w : 'rV_k) : row_mx x w *m pick = x by rewrite mul_row_col mulmx1 mulmx0 addr0.
rewrite /null -(mxrank_mul_ker (null_pairs Q t) pick).
have -> : (null_pairs Q t :&: kermx pick)%MS = 0.
  apply/row_matrixP => i; rewrite row0; have := row_sub i (null_pairs Q t :&: kermx pick)%MS.
  move: (row i _) => y; rewrite -[y]hsubmxK sub_capmx => /andP[/null_pairsP[_ yG yF] /sub_kermxP]; rewrite pickE => x0.
  have : rsubmx y *m Z = 0 by move: yG yF; rewrite -saturated_pair x0 !mul0mx !add0r => -> ->; rewrite row_mx0.
  by rewrite -[RHS](mul0mx _ Z) => /(row_free_inj (row_base_free _)) ->; rewrite x0 row_mx0.
rewrite mxrank0 addn0; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  have := row_sub i (null_pairs Q t); rewrite row_mul; move: (row i _) => y; rewrite -[y]hsubmxK pickE => /null_pairsP[_ yC yA].
  rewrite -(eqmx_opp (lsubmx y)); apply/without_feedthroughP/shift_solves/spans_Z.
  apply/submxP; exists (rsubmx y); rewrite -saturated_pair !mulNmx; congr row_mx; apply/eqP; rewrite eq_sym -addr_eq0.
    by rewrite addrC yA.
  by rewrite addrC yC.
have := row_sub i U; move: (row i U) => x xU.
have : (row_mx (- (x *m sysA S)) (- (x *m sysC S)) <= Z)%MS.
  by apply/spans_Z; rewrite -!mulNmx; apply: (shift_solves S _ _).1; apply/without_feedthroughP; rewrite eqmx_opp.
case/submxP => w; rewrite -saturated_pair => /eq_row_mx[eF eG]; rewrite -(pickE x w); apply/submxMr/null_pairsP.
by split; [exact: submx_trans xU (without_feedthrough_reached t) | rewrite -eG subrr | rewrite -eF subrr].
Qed.

Lemma saturated_balance t : (t <= s)%N -> (\rank (window S t) + \rank (silent Q t) + t * \rank U = n + t * k)%N.
Proof.
elim: t => [|t IH] ts; first by rewrite rank_window big_ord0 mxrank1 !mul0n !addn0.
by have := rank_balance Q t; have := IH (ltnW ts); rewrite saturated_null saturated_gap // rank_window_step; lia.
Qed.

(** n_z against the states without feedthrough, and their number. *)
Theorem solution_space_rank : (0 < s)%N -> k = (gap S s.-1 + \rank U)%N.
Proof.
move=> s0; have := rank_balance Q s.-1; rewrite prednK // saturated_null saturated_gap ?prednK //.
by rewrite !saturated_silent ?prednK //; lia.
Qed.

Theorem without_feedthrough_rank : (0 < s)%N -> (\rank (window S s) + \rank U = n + s * gap S s.-1)%N.
Proof.
move=> s0; have := saturated_balance (leqnn s); rewrite saturated_silent //.
by move: (\rank U) (solution_space_rank s0) => u ->; lia.
Qed.

Theorem solution_space_window : (0 < s)%N -> (k + \rank (window S s) = n + s.+1 * gap S s.-1)%N.
Proof. by move=> s0; have := without_feedthrough_rank s0; move: (\rank U) (solution_space_rank s0) => u ->; lia. Qed.

End SolutionCount.

(** The same in terms of the left indices; and for any matrix that spans the solutions. *)
Section Count.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma rank_of_solutions s k (M : 'M[K]_(k, n + p)) : spans_solutions S s M -> \rank M = \rank (solution_space S s).
Proof.
move=> span; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  by rewrite -[row i M]hsubmxK; apply/solution_spaceP/span; rewrite hsubmxK row_sub.
by rewrite -[row i _]hsubmxK; apply/span/solution_spaceP; rewrite hsubmxK row_sub.
Qed.

Theorem solution_count_window s k (M : 'M[K]_(k, n + p)) : spans_solutions S s.+1 M ->
  (\rank M + \rank (window S s.+1) = n + s.+2 * gap S s)%N.
Proof. by move=> span; rewrite (rank_of_solutions span) solution_space_window. Qed.

(** L2. *)
Theorem solution_count s k (M : 'M[K]_(k, n + p)) : spans_solutions S s.+1 M ->
  (\rank M + \sum_(e <- etas S | (e <= s)%N) e.+1 = n + p)%N.
Proof.
move=> /solution_count_window; rewrite rank_window_etas (gap_etas S s).
have := size_etas S; have := gap_le_outputs S n.
have : (\sum_(e <- etas S) minn s.+1 e + size (etas S) =
  \sum_(e <- etas S | (e <= s)%N) e.+1 + s.+2 * count (fun e => s < e)%N (etas S))%N.
  elim: (etas S) => [|e t IH]; first by rewrite !big_nil /= muln0.
  by rewrite !big_cons /=; case: (leqP e s) => es; lia.
lia.
Qed.

(** The states that solve the problem without feedthrough: for ever, these are U = W + V of ClosedForm.v, and their number is zeta. *)
Theorem zeta_zero_states : zeta S = \rank (zero_states S).
Proof.
have <- : \rank (without_feedthrough S n.+1) = \rank (zero_states S).
  apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
    by apply/(zero_state_solutions S _ (ltnSn n))/without_feedthroughP/row_sub.
  by apply/without_feedthroughP/(zero_state_solutions S _ (ltnSn n))/row_sub.
have := (rank_window_zeta S n.+1).2 (leqW (lag_le_n S)); have := without_feedthrough_rank S (ltn0Sn n); rewrite [n.+1.-1]/=; lia.
Qed.

Lemma combined_behavior a b (F : 'M_(a, n)) (G : 'M_(a, p)) (F' : 'M_(b, n)) (G' : 'M_(b, p)) : (row_mx F G <= row_mx F' G')%MS ->
  forall r, behavior (with_faults S F G) r -> behavior (with_faults S F' G') r.
Proof.
case/submxP => P; rewrite mul_mx_row => /eq_row_mx[-> ->] r [x [v e]]; exists x, (fun k => v k *m P) => k.
by rewrite e -(output_combined_faults (with_faults S F' G') P).
Qed.

(** Without such states, every basis of the solutions is an equivalent pair. *)
Theorem every_basis_of_solutions s m' (F : 'M_(m', n)) (G : 'M_(m', p)) : (n < s)%N -> zeta S = 0%N -> (m <= m')%N ->
  (forall i, solves S s (row i F) (row i G)) -> row_free (row_mx F G) ->
  forall r, behavior (with_faults S F G) r <-> behavior S r.
Proof.
move=> ns zeta0 mm' sol free r; rewrite -{2}[S]with_own_faults.
have U0 : zero_states S = 0 by apply/eqP; rewrite -mxrank_eq0 -zeta_zero_states zeta0.
have sub : (row_mx F G <= row_mx (sysF S) (sysG S))%MS.
  apply/row_subP => i; rewrite row_row_mx; have /(solutions_closed_form S ns)/submxP[c ->] := sol i.
  rewrite /closed_form U0 !mul0mx row_mx0 -[c]hsubmxK mul_row_col -[rsubmx c]hsubmxK mul_row_col !mulmx0 !addr0.
  exact: submxMl.
split; apply: combined_behavior => //.
rewrite -(geq_leqif (mxrank_leqif_sup sub)) (eqP free); apply: leq_trans mm'; exact: rank_leq_row.
Qed.

(** Equivalent systems have the same left indices, lag and zeta. *)
Theorem equal_behaviors_equal_zeta m' (S' : system K n m' p) : (forall r, behavior S r <-> behavior S' r) ->
  [/\ forall s, gap S s = gap S' s, etas S = etas S' & zeta S = zeta S'].
Proof.
move=> /behavior_eqP same; have rank_eq s : \rank (window S s) = \rank (window S' s) by apply/eqmx_rank/window_eqP.
have gap_eq s : gap S s = gap S' s by apply: (@addnI (\rank (window S s))); rewrite -rank_window_step !rank_eq -rank_window_step.
have etas_eq : etas S = etas S'.
  by congr flatten; apply: eq_map => -[|s]; rewrite /gap_drop !gap_eq.
by rewrite /zeta etas_eq.
Qed.

(** zero-feedthrough: F is fixed up to a basis iff zeta is the number of faults. *)
Theorem zero_feedthrough_zeta s : (n < s)%N -> sysG S = 0 -> left_invertible S ->
  (forall f : 'rV_n, solves S s f 0 -> (f <= sysF S)%MS) <-> zeta S = m.
Proof.
move=> ns G0 inv; have FU : (sysF S <= zero_states S)%MS.
  apply/row_subP => i; apply/(zero_state_solutions S _ ns); rewrite rowE.
  by have := own_fault_solves S s (delta_mx 0 i); rewrite G0 mulmx0.
have rankF : \rank (sysF S) = m by apply/eqP/(faults_independent G0 inv).
rewrite zeta_zero_states; split=> [inside | eq_rank f /(zero_state_solutions S f ns) fU].
  rewrite -[RHS]rankF; apply: eqmx_rank; rewrite FU andbT; apply/row_subP => i.
  by apply/inside/(zero_state_solutions S _ ns)/row_sub.
by apply: submx_trans fU _; rewrite -(geq_leqif (mxrank_leqif_sup FU)) eq_rank rankF.
Qed.

(** n_z = r + zeta, reached exactly from one sample past the lag on. *)
Theorem solution_count_zeta s k (M : 'M[K]_(k, n + p)) : spans_solutions S s.+1 M ->
  \rank M = (gap S n + zeta S)%N <-> (lag S <= s)%N.
Proof.
move=> /solution_count; have := size_etas S; have := gap_le_outputs S n; have := sum_etas_le_n S.
rewrite -lagP (gap_etas S s) /zeta sumnE.
have : (\sum_(e <- etas S) e + size (etas S) = \sum_(e <- etas S | (e <= s)%N) e.+1 + \sum_(e <- etas S | (s < e)%N) e.+1)%N.
  elim: (etas S) => [|e t IH]; first by rewrite !big_nil.
  by rewrite !big_cons /=; case: (leqP e s) => es; lia.
have : (count (fun e => s < e)%N (etas S) <= \sum_(e <- etas S | (s < e)%N) e.+1)%N.
  by elim: (etas S) => [|e t IH]; rewrite ?big_nil // big_cons /=; case: (ltnP s e) => es; lia.
have : (0 < \sum_(e <- etas S | (s < e)%N) e.+1 -> 0 < count (fun e => s < e)%N (etas S))%N.
  by elim: (etas S) => [|e t IH]; rewrite ?big_nil // big_cons /=; case: (ltnP s e) => es; lia.
lia.
Qed.

End Count.
