(** Which P of full rank are bad, for a left-invertible system: there is one iff there is a fault and (A, C) is not observable, or there are
    two faults and zeta >= 1. For an unobservable state u is a solution (u, 0) that no output shows. For a state u in U (ClosedForm.v) both
    (u, 0) and (u A, u C) are solutions, and the first fault, undone one step later by the second, is never seen; so with zeta >= 1 and two
    faults there is a bad P of full rank, and with observable (A, C) full rank is enough iff there is at most one fault or zeta = 0. And
    with zeta = 0 the bad P are those with determinant zero. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction zify.
From faultspace Require Import Vocabulary Basics Lag TransferRank NormalRank Trajectory Solutions Theorem3.
From faultspace Require Import ClosedForm SolutionCount ZeroFeedthrough.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A fault that the next one undoes. *)
Lemma undone_fault (K : fieldType) n p a (S : system K n (1 + 1 + a) p) (u : 'rV_n) (F : 'M_(a, n)) (G : 'M_(a, p)) :
  sysF S = col_mx (col_mx (u *m sysA S) u) F -> sysG S = col_mx (col_mx (u *m sysC S) 0) G -> ~ left_invertible S.
Proof.
move=> FE GE inv.
pose v k : 'rV[K]_(1 + 1 + a) := match k with 0 => row_mx (row_mx 0 1%:M) 0 | 1 => row_mx (row_mx (- 1%:M) 0) 0 | _ => 0 end.
have x1 : state S 0 v 1 = u by rewrite /= FE mul0mx !mul_row_col !mul0mx mul1mx !add0r addr0.
have x2 : state S 0 v 2 = 0.
  by rewrite -[LHS]/(state S 0 v 1 *m sysA S + v 1%N *m sysF S) x1 FE !mul_row_col !mul0mx mulNmx mul1mx !addr0 subrr.
have /inv/(_ 0%N) : forall k, output S 0 v k = 0.
  case=> [|[|k]]; first by rewrite /output /= GE mul0mx !mul_row_col !mul0mx mulmx0 !addr0.
    by rewrite /output x1 GE !mul_row_col !mul0mx mulNmx mul1mx !addr0 subrr.
  by rewrite (output_shift S 0 v 2) x2 output_zero.
by rewrite -!row_mx0 => /eq_row_mx[/eq_row_mx[_ /matrixP/(_ 0 0)/eqP]]; rewrite !mxE oner_eq0.
Qed.

Section BadPair.
Variables (K : fieldType) (n a p : nat) (S : system K n (1 + 1 + a) p) (s k : nat) (Z : 'M[K]_(k, n + p)).

Theorem bad_pair_of_full_rank : (n < s)%N -> spans_solutions S s Z -> left_invertible S -> row_free (O S n) -> (0 < zeta S)%N ->
  exists P : 'M_(1 + 1 + a, k), row_free (P *m Z) /\ ~ left_invertible (faults_of S (P *m Z)).
Proof.
move=> ns span inv obs; rewrite zeta_zero_states lt0n mxrank_eq0 => /rowV0Pn[u uU u0].
pose Y := col_mx (row_mx (u *m sysA S) (u *m sysC S)) (row_mx u 0).
have YZ : (Y <= Z)%MS.
  rewrite col_mx_sub; apply/andP; split; apply/span; last exact: zero_state_solves.
  by apply: (shift_solves S s u).1; apply: zero_state_solves.
have Y_free : row_free Y.
  apply: inj_row_free => c; rewrite -[c]hsubmxK mul_row_col !mul_mx_row add_row_mx -row_mx0 => /eq_row_mx[].
  rewrite [lsubmx c]mx11_scalar [rsubmx c]mx11_scalar !mul_scalar_mx.
  move: (lsubmx c 0 0) (rsubmx c 0 0) => c1 c2; rewrite scaler0 addr0 => eA /eqP.
  have [c10 _|c10] := eqVneq c1 0.
    move/eqP: eA; rewrite c10 scale0r add0r scaler_eq0 (negPf u0) orbF => /eqP ->.
    by rewrite raddf0 row_mx0.
  rewrite scaler_eq0 (negPf c10) => /eqP uC; case/negP: u0; apply/eqP/(row_free_inj obs); rewrite mul0mx.
  apply/unobservable => j.
  have uA : u *m sysA S = - (c1^-1 * c2) *: u.
    apply: (scalerI c10); rewrite scalerA mulrN mulrA divff // mul1r scaleNr.
    by apply/eqP; rewrite -addr_eq0 eA.
  have states : exists b, state S u (fun=> 0) j = b *: u.
    elim: j => [|j [b IH]]; first by exists 1; rewrite scale1r.
    by exists (b * - (c1^-1 * c2)); rewrite /= IH mul0mx addr0 -scalemxAl uA scalerA.
  by case: states => b e; rewrite /output e mul0mx addr0 -scalemxAl uC scaler0.
pose D := (Z :\: Y)%MS; have rankD : (a <= \rank D)%N.
  have rankZ : \rank Z = (1 + 1 + a + zeta S)%N.
    case: s ns span => // t nt span_t; rewrite ((solution_count_zeta span_t).2 (leq_trans (lag_le_n S) nt)) (gap_normal_rank S (leqnn n)).
    by rewrite (left_invertible_transfer_rank S).1.
  have := mxrank_cap_compl Z Y; have := mxrankS (capmxSr Z Y); rewrite -/D rankZ (eqP Y_free); lia.
pose E : 'M[K]_(a, n + p) := pid_mx a *m row_base D.
have E_free : row_free E by rewrite /row_free mxrankMfree ?row_base_free // rank_pid_mx.
have ED : (E <= D)%MS by apply: submx_trans (submxMl _ _) _; rewrite eq_row_base.
have /submxP[P PZ] : (col_mx Y E <= Z)%MS by rewrite col_mx_sub YZ; apply: submx_trans ED (diffmxSl _ _).
exists P; rewrite -PZ; split.
  rewrite /row_free -addsmxE mxrank_disjoint_sum ?(eqP Y_free) ?(eqP E_free) //.
  by apply/eqP; rewrite -submx0 -(capmx_diff Z Y) capmxC capmxS.
apply: (@undone_fault _ _ _ _ _ u (lsubmx E) (rsubmx E)) => /=.
  by rewrite /Y -block_mxEv block_mxEh -{1}[E]hsubmxK -block_mxEv block_mxEh row_mxKl.
by rewrite /Y -block_mxEv block_mxEh -{1}[E]hsubmxK -block_mxEv block_mxEh row_mxKr.
Qed.

End BadPair.

Theorem full_rank_suffices (K : fieldType) n m p (S : system K n m p) s k (Z : 'M[K]_(k, n + p)) :
  (n < s)%N -> spans_solutions S s Z -> row_free Z -> left_invertible S -> row_free (O S n) ->
  (forall P : 'M_(m, k), row_free P -> forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r) <-> (m <= 1)%N \/ zeta S = 0%N.
Proof.
move=> ns span Z_free inv obs; have lagS : (lag S < s)%N by apply: leq_ltn_trans (lag_le_n S) ns.
have free_pair (P : 'M_(m, k)) : row_free P -> row_free (P *m Z) by rewrite /row_free mxrankMfree.
split=> [full | [m1 | zeta0] P /free_pair P_free].
- have [z0|zpos] := posnP (zeta S); first by right.
  left; case: m S ns span inv obs zpos full {lagS free_pair} => [|[|a]] // S ns span inv obs zpos full.
  have [P [P_free []]] := @bad_pair_of_full_rank K n a p S s k Z ns span inv obs zpos.
  apply/(theorem_3_criterion ns span) => //; apply: full.
  by have := mxrankM_maxl P Z; rewrite (eqP P_free) /row_free eqn_leq rank_leq_row.
- apply/(theorem_3_criterion ns span) => //.
  case: m S P m1 ns span inv obs P_free {lagS free_pair} => [|[|a]] // S P _ ns span inv obs P_free.
    by move=> v _ j; rewrite [v j]thinmx0.
  apply/(theorem_3_criterion ns span) => //; apply: (single_fault _ span inv obs).
    exact: leq_ltn_trans (lag_le_n S) ns.
  by apply: contraTneq P_free => ->; rewrite /row_free mxrank0.
- apply: (every_basis_of_solutions ns zeta0 (leqnn m)); last by rewrite hsubmxK.
  by apply/solution_rows; apply/(included_rows _ _ span); rewrite hsubmxK submxMl.
Qed.

Section BadPairs.
Variables (K : fieldType) (n p : nat).

(** A row is completed to independent rows. *)
Lemma row_completed k a (c : 'rV[K]_k) : c != 0 -> (a < k)%N -> exists P' : 'M_(a, k), row_free (col_mx c P').
Proof.
move=> c0 ak; have freeC : row_free c.
  by apply: inj_row_free => u; rewrite [u]mx11_scalar mul_scalar_mx => /eqP; rewrite scaler_eq0 (negPf c0) orbF => /eqP ->; rewrite raddf0.
exists (pid_mx a *m row_base (c^C)%MS).
have rankC : \rank (c^C)%MS = k.-1 by rewrite mxrank_compl (eqP freeC) subn1.
rewrite /row_free -addsmxE mxrank_disjoint_sum.
  by rewrite (eqP freeC) mxrankMfree ?row_base_free // rank_pid_mx // rankC; lia.
by apply/eqP; rewrite -submx0 -(capmx_compl c) capmxS // (submx_trans (submxMl _ _)) // eq_row_base.
Qed.

Lemma unobservable_fault a (S : system K n (1 + a) p) (u : 'rV_n) (F : 'M_(a, n)) (G : 'M_(a, p)) :
  sysF S = col_mx u F -> sysG S = col_mx 0 G -> (forall k, output S u (fun=> 0) k = 0) ->
  ~ left_invertible S.
Proof.
move=> FE GE quiet inv; pose v k : 'rV[K]_(1 + a) := if k is 0%N then row_mx 1%:M 0 else 0.
have /inv/(_ 0%N) : forall k, output S 0 v k = 0.
  case=> [|k]; first by rewrite /output /= GE mul0mx add0r mul_row_col mulmx0 mul0mx addr0.
  by rewrite output_step /= FE mul_row_col mul1mx !mul0mx add0r addr0 quiet.
by rewrite -row_mx0 => /eq_row_mx[/matrixP/(_ 0 0)/eqP]; rewrite !mxE oner_eq0.
Qed.

Theorem bad_pairs_of_full_rank m (S : system K n m p) s k (Z : 'M[K]_(k, n + p)) :
  (n < s)%N -> spans_solutions S s Z -> row_free Z -> left_invertible S ->
  (exists P : 'M_(m, k), row_free P /\ ~ (forall w, behavior (faults_of S (P *m Z)) w <-> behavior S w)) <->
  ((0 < m)%N /\ ~~ row_free (O S n)) \/ ((1 < m)%N /\ (0 < zeta S)%N).
Proof.
move=> ns span freeZ inv; have criterion (P : 'M_(m, k)) := theorem_3_criterion ns span P inv.
split=> [[P [free bad]] | ].
  have [obs|unobs] := boolP (row_free (O S n)); last first.
    left; split=> //; rewrite lt0n; apply/eqP => m0; apply: bad; apply/criterion => v _ j.
    by apply/matrixP => i l; case: l => l lm; exfalso; rewrite m0 in lm.
  right; have full := full_rank_suffices ns span freeZ inv obs.
  have [m1|m2] := leqP m 1; first by case: bad; apply: full.2; [left | exact: free].
  by split=> //; rewrite lt0n; apply/eqP => z0; case: bad; apply: full.2; [right | exact: free].
have unobservable_bad : (0 < m)%N -> ~~ row_free (O S n) ->
    exists P : 'M_(m, k), row_free P /\ ~ (forall w, behavior (faults_of S (P *m Z)) w <-> behavior S w).
  case: m S inv span criterion => [|a] // S inv span criterion _; rewrite -kermx_eq0 => /rowV0Pn[u /sub_kermxP uO u0].
  have /span/submxP[c cZ] : solves S s u 0.
    by apply: silent_state_solves; exists (fun=> 0) => j _; apply: (unobservable S u).1.
  have c0 : c != 0 by apply: contraNneq u0 => c0; move: cZ; rewrite c0 mul0mx -row_mx0 => /eq_row_mx[->].
  have ak : (a < k)%N.
    case: s ns span {criterion cZ} => // N nN spanN.
    have := (solution_count_zeta spanN).2 (leq_trans (lag_le_n S) nN); rewrite (eqP freeZ) (gap_normal_rank S (leqnn n)).
    by rewrite (left_invertible_transfer_rank S).1 //; lia.
  have [P' free] := row_completed c0 ak; exists (col_mx c P'); split=> // /criterion.
  have quiet j : output (faults_of S (col_mx c P' *m Z)) u (fun=> 0) j = 0 by rewrite output_free; apply: (unobservable S u).1.
  apply: (@unobservable_fault a _ u (lsubmx (P' *m Z)) (rsubmx (P' *m Z))) quiet => /=.
    by rewrite mul_col_mx -cZ -{1}[P' *m Z]hsubmxK -block_mxEv block_mxEh row_mxKl.
  by rewrite mul_col_mx -cZ -{1}[P' *m Z]hsubmxK -block_mxEv block_mxEh row_mxKr.
case=> [[m0 unobs] | [m2 zpos]]; first exact: unobservable_bad.
have [obs|] := boolP (row_free (O S n)); last by apply: unobservable_bad; apply: ltnW.
case: m S inv span criterion m2 zpos obs {unobservable_bad} => [|[|a]] // S inv span criterion _ zpos obs.
have [P [free bad]] := @bad_pair_of_full_rank K n a p S s k Z ns span inv obs zpos.
exists P; split=> [|/criterion //].
by have := mxrankM_maxl P Z; rewrite (eqP free) /row_free eqn_leq rank_leq_row.
Qed.

(** bad-set, no-zeros. *)
Theorem no_zeros_bad m (S : system K n m p) s (Z : 'M[K]_(m, n + p)) (P : 'M_m) :
  (n < s)%N -> spans_solutions S s Z -> row_free Z -> left_invertible S -> zeta S = 0%N ->
  (forall w, behavior (faults_of S (P *m Z)) w <-> behavior S w) <-> \det P != 0.
Proof.
move=> ns span freeZ inv z0; have unitE : (\det P != 0) = row_free P by rewrite row_free_unit unitmxE unitfE.
rewrite unitE; split=> [/(theorem_3_criterion ns span P inv) invP | free].
  apply: inj_row_free => u uP; pose v k : 'rV[K]_m := if k is 0%N then u else 0.
  apply: (invP v _ 0%N) => -[|k].
    by rewrite /output /= mul0mx add0r mulmx_rsub mulmxA uP mul0mx linear0.
  rewrite output_step /= mul0mx add0r mulmx_lsub mulmxA uP mul0mx linear0.
  exact: output_zero.
apply: (every_basis_of_solutions ns z0 (leqnn m)); last by rewrite hsubmxK /row_free mxrankMfree.
by apply/solution_rows; apply/(included_rows _ _ span); rewrite hsubmxK submxMl.
Qed.

End BadPairs.
