(** Data that do not excite. A periodic or geometric output has Hankel matrices of bounded rank, so its rank gap vanishes though the
    system is left-invertible: full rank of [X V_s] at the same s is not enough for rank R_(s+1) - rank R_s = m, and a fault v constant
    or v = 2^k breaks the gap. All on the system r(k) = (v(k-1), v(k)) of Problem11.v, over any field.

    alternating == the faults 1, 0, 1, 0, ...
    geometric c == the faults c, c^2, c^3, ...
     pulse_at t == the fault that is 1 at time t and else 0
      idle_mode == a state with A = 1 that no fault moves, seen beside the fault *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Places Balance Proposition3.
From faultspace Require Import Problem11 Excitation WeakExcitation.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section BoundedRank.
Variables (K : fieldType) (p : nat) (r : nat -> 'rV[K]_p).

(** All later parts of r are combinations of its first t ones. *)
Lemma rank_of_repetition t N s (a : nat -> nat -> K) :
  (forall i k, r (i + k)%N = \sum_(j < t) a i j *: r (j + k)%N) -> (\rank (hankel N s r) <= t)%N.
Proof.
move=> e; have -> : hankel N s r = (\matrix_(i, j) a i j) *m hankel t s r.
  apply/row_matrixP=> i; rewrite row_mul mulmx_sum_row rowK (samples_ext (fun k _ => e i k)).
  rewrite samples_sum; apply: eq_bigr => j _; rewrite samples_scale rowK.
  by rewrite mxE mxE.
by apply: leq_trans (mxrankM_maxr _ _) (rank_leq_row _).
Qed.

Lemma rank_of_geometric (c : K) N s : (forall i k, r (i + k)%N = c ^+ i *: r k) -> (\rank (hankel N s r) <= 1)%N.
Proof. by move=> e; apply: (@rank_of_repetition 1 N s (fun i _ => c ^+ i)) => i k; rewrite big_ord1 e. Qed.

Lemma rank_of_period_2 N s : (forall k, r k.+2 = r k) -> (\rank (hankel N s r) <= 2)%N.
Proof.
move=> e; apply: (@rank_of_repetition 2 N s (fun i j => (odd i == odd j)%:R)) => i k.
have -> : r (i + k)%N = r (odd i + k)%N.
  elim/ltn_ind: i => -[|[|i]] IH //; rewrite !addSn e IH ?leqnSn //.
  by rewrite /= negbK.
by rewrite big_ord_recl big_ord1 /=; case: (odd i) => /=; rewrite scale1r scale0r ?addr0 ?add0r.
Qed.

End BoundedRank.

Section Examples.
Variable K : fieldType.
Notation S := (delayed_fault K).

Lemma delayed_fault_left_invertible : left_invertible S.
Proof. by move=> v z k; have := z k; rewrite delayed_fault_output -[X in _ = X]row_mx0 => /eq_row_mx[]. Qed.

Lemma rank_window_1 : \rank (window S 1) = 2%N.
Proof.
apply/eqP/row_fullP; suff : (1%:M <= window S 1)%MS by move/submxP => [D ->]; exists D.
apply/row_subP=> i; apply/sub_windowP; set z := row i _.
exists (lsubmx (unsamples z 0)), (fun=> rsubmx (unsamples z 0)) => -[|//] _.
by rewrite delayed_fault_output hsubmxK.
Qed.

(** v = 1, 0, 1, 0, ... from x = 0: r has period 2, and [X V_1] full rank. *)
Definition alternating k : 'rV[K]_1 := (~~ odd k)%:R%:M.

Theorem excitation_at_s_is_not_enough N N' : let r := output S 0 alternating in
  row_full (excitation S 0 alternating N.+2 1) /\ \rank (hankel N' 2 r) <> (\rank (hankel N.+2 1 r) + 1)%N.
Proof.
move=> r.
have full : row_full (excitation S 0 alternating N.+2 1).
  rewrite -sub1mx; apply/row_subP=> i; move: (row i 1%:M) => z {i}; rewrite -[z]hsubmxK -[rsubmx z]unsamplesK; apply/excitationP.
  exists (fun i : 'I_N.+2 => if i == 0%N :> nat then unsamples (rsubmx z) 0 0 0 else if i == 1%N :> nat then lsubmx z 0 0 else 0).
  rewrite !big_ord_recl !big1 /= => [|j _]; last by rewrite scale0r.
  split=> [|[|//] _]; first by rewrite scaler0 mulmx0 mulmx1 !add0r addr0 scale_scalar_mx mulr1 -mx11_scalar.
  rewrite !big_ord_recl !big1 /= => [|j _]; last by rewrite scale0r.
  by rewrite /alternating /= scale_scalar_mx mulr1 -mx11_scalar -scalemx1 scale0r scaler0 !addr0.
split=> //; rewrite (rank_hankel full) rank_window_1 => e.
have : (\rank (hankel N' 2 r) <= 2)%N; last by rewrite e.
apply: rank_of_period_2 => k; rewrite /r !delayed_fault_output /alternating /= negbK; congr row_mx.
by case: k => [|k] /=; rewrite ?raddf0 ?negbK.
Qed.

(** v(k) = c^(k+1) from x = 1, so r(k) = c^k (1, c): constant for c = 1, and powers of two for c = 2. *)
Definition geometric (c : K) k : 'rV[K]_1 := (c ^+ k.+1)%:M.

Theorem geometric_fault_breaks_gap c N N' s : let r := output S 1%:M (geometric c) in
  \rank (hankel N'.+1 s.+2 r) = \rank (hankel N.+1 s.+1 r) /\ \rank (window S s.+2) = (\rank (window S s.+1) + 1)%N.
Proof.
move=> r; split; last by apply/(proposition_3 S (ltn0Sn s))/delayed_fault_left_invertible.
have rE k : r k = c ^+ k *: row_mx 1%:M c%:M.
  rewrite /r delayed_fault_output /geometric scale_row_mx !scale_scalar_mx -exprSr mulr1.
  by case: k => // k; congr row_mx; rewrite ?expr0.
have rank1 M t : \rank (hankel M.+1 t.+1 r) = 1%N.
  apply/eqP; rewrite eqn_leq; apply/andP; split.
    by apply: (@rank_of_geometric _ _ _ c) => i k; rewrite !rE scalerA exprD.
  rewrite lt0n mxrank_eq0; apply/eqP => /(congr1 (row 0)); rewrite rowK row0 => /samples_eq0/(_ 0%N isT).
  rewrite rE expr0 scale1r -[X in _ = X]row_mx0 => /eq_row_mx[/(congr1 (fun M : 'M_1 => M 0 0))/eqP].
  by rewrite !mxE oner_eq0.
by rewrite !rank1.
Qed.

Corollary constant_fault_breaks_gap N N' s : let r := output S 1%:M (fun=> 1%:M) in
  \rank (hankel N'.+1 s.+2 r) = \rank (hankel N.+1 s.+1 r) /\ \rank (window S s.+2) = (\rank (window S s.+1) + 1)%N.
Proof.
move=> r; have [same step] := geometric_fault_breaks_gap 1 N N' s; split=> //.
have e k : r k = output S 1%:M (geometric 1) k by apply: output_ext => j _; rewrite /geometric expr1n.
have he M t : hankel M t r = hankel M t (output S 1%:M (geometric 1)).
  by apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k _.
by rewrite !he.
Qed.

(** A single pulse is persistently exciting of every order. *)
Definition pulse_at (t k : nat) : 'rV[K]_1 := if k == t then 1%:M else 0.

Lemma pulse_at_persistent t : persistently_exciting t.+1 t.+1 (pulse_at t).
Proof.
rewrite /persistently_exciting -sub1mx -sum_places; apply: summx_sub => k _; apply: submx_trans (submxMl _ _) _.
have tk : (t - k < t.+1)%N by rewrite ltnS leq_subr.
suff -> : place K 1 k = row (Ordinal tk) (hankel t.+1 t.+1 (pulse_at t)) by apply: row_sub.
rewrite -[LHS]mul1mx mul_place rowK; apply: samples_ext => j jt; rewrite /pulse_at /=.
by have -> : (t - k + j == t)%N = (j == k)%N; first by rewrite -[X in _ == X](subnK (ltn_ord k : (k <= t)%N)) eqn_add2l.
Qed.

(** A mode that no fault reaches and that x(0) = 0 does not excite: [X V_s] never has full rank, and the gap is right all the same. *)
Definition idle_mode : system K 1 1 1 := System 1%:M 0 1%:M 1%:M.

Theorem excitation_is_not_necessary s : (0 < s)%N -> let v := pulse_at s.+1 in let r := output idle_mode 0 v in
  (forall N, ~~ row_full (excitation idle_mode 0 v N s.+1)) /\
  \rank (hankel (1 + s.+2) s.+1 r) = (\rank (hankel (1 + s.+2).+1 s r) + 1)%N.
Proof.
move=> s0 v r; have idle w k : state idle_mode 0 w k = 0 by elim: k => //= k ->; rewrite mul0mx mulmx0 addr0.
split=> [N|].
  apply/negP => /row_fullP[D full]; have : excitation idle_mode 0 v N s.+1 *m col_mx 1%:M 0 = 0 :> 'cV_N.
    by apply/row_matrixP=> i; rewrite row_mul rowK mul_row_col idle mul0mx mulmx0 addr0 row0.
  move=> /(congr1 (mulmx D)); rewrite mulmxA full mul1mx mulmx0 -[X in _ = X]col_mx0 => /eq_col_mx[/matrixP/(_ 0 0)/eqP].
  by rewrite !mxE oner_eq0.
have linv : left_invertible idle_mode by move=> w z k; have := z k; rewrite /output idle mul0mx add0r mulmx1.
apply: persistency_gap => //; first exact: pulse_at_persistent.
by apply/gap_left_invertible.
Qed.

End Examples.

(** Faults that are combinations w P of fewer ones, as two equal faults are: the data show no more than these. *)
Theorem dependent_faults_break_gap (K : fieldType) n m m' p (S : system K n m p) (P : 'M_(m', m)) x w N N' s :
  let S' := with_faults S (P *m sysF S) (P *m sysG S) in let r := output S x (fun k => w k *m P) in
  (m' < m)%N -> (n <= s)%N -> (N' <= N)%N -> row_full (excitation S' x w N' s.+1) ->
  (\rank (hankel N' s.+1 r) < \rank (hankel N s r) + m)%N.
Proof.
move=> S' r m'm ns N'N full; have he M t : hankel M t r = hankel M t (output S' x w).
  by apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k _; rewrite output_combined_faults.
by rewrite !he (gap_of_data N'N full) ltn_add2l (leq_ltn_trans _ m'm) // gap_le_faults.
Qed.
