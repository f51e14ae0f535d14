(** Which P of full rank are bad, for a left-invertible system, observable or not: there is one iff there is a fault and (A, C) is not
    observable, or there are two faults and zeta >= 1. For an unobservable state u is a solution (u, 0) that no output shows; the rest is
    FullRankPairs.v. And with zeta = 0 the bad P are those with determinant zero. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary Basics Lag Trajectory Solutions Theorem3 ZeroFeedthrough.
From faultspace Require Import SolutionCount FullRankPairs.
From faultspace Require NormalRank TransferRank.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

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
    have := (solution_count_zeta spanN).2 (leq_trans (lag_le_n S) nN); rewrite (eqP freeZ) (NormalRank.gap_normal_rank S (leqnn n)).
    by rewrite (TransferRank.left_invertible_transfer_rank S).1 //; lia.
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
