(** Small systems that refute readings of the claims, with all the hypotheses these readings make: observable, controllable, left-
    invertible. The shift register of Theorem1Sharp.v shows that windows of n samples are too short, the delayed fault of Problem11.v
    that problem (11) is not exact at s = n, and the others are told where they come. Any field, unless a number other than 0 and 1 is
    needed.

           rescaled c == one system, its one state in another unit: (A, C) and the solutions differ, the behaviour does not
         double_delay == a fault that is seen two samples later
         hidden_fault == one state, A = 0, F = C = G = 1
    with_feedback S L == the system S whose faults are v + x L *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Proposition3 Inversion Lag SharpWindows Theorem1Sharp.
From faultspace Require Import Problem11 Counterexamples Trajectory ClosedForm.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Facts.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma at_once_left_invertible : inverts_at_once S -> left_invertible S.
Proof. by move=> h; apply: (@delay_left_invertible _ _ _ _ _ 0%N) => v /(_ 0%N isT)/h. Qed.

Lemma observable_from_zeros : (forall x, (forall k, (k < n)%N -> output S x (fun=> 0) k = 0) -> x = 0) -> observable S.
Proof. by move=> h; apply: inj_row_free => x; rewrite mul_O => /samples_eq0/h. Qed.

(** Where everything is possible the window has full rank. *)
Lemma full_window s : (forall r, word S s r) -> \rank (window S s) = (s * p)%N.
Proof. by move=> all_words; apply/eqP; rewrite -/(row_full _) -sub1mx; apply/row_subP => i; apply/sub_windowP. Qed.
End Facts.

Section Register.
Variables (K : fieldType) (n : nat).
Implicit Types (c : K).

Lemma register_observable c : observable (register n c).
Proof.
apply: observable_from_zeros => x zeros; apply/rowP => j; rewrite mxE; have := zeros j (ltn_ord j).
by rewrite output_register state_register => /rowP/(_ 0); rewrite !mxE eqxx add0n -ltnS ltn_ord inord_val.
Qed.

Lemma register_controllable c : c != 0 -> fault_controllable (register n c).
Proof.
move=> c0 y; exists n.+1, (fun k => (y 0 (inord k) / c)%:M); apply/rowP => j.
by rewrite state_register addnS ltnNge leq_addl /= subSS addnK mxE eqxx mulr1n divfK // inord_val.
Qed.

Lemma register_at_once c : inverts_at_once (register n c).
Proof.
move=> x v out0; apply/rowP => j; rewrite ord1 mxE.
by move/rowP/(_ 1): out0; rewrite output_register !mxE.
Qed.

Lemma register_words c s r : (s <= n.+1)%N -> word (register n c) s r.
Proof.
move=> sn; exists (\row_(j < n.+1) r j 0 0), (fun k => (r k 0 1)%:M) => k ks; have kn : (k < n.+1)%N by apply: leq_trans ks sn.
rewrite output_register state_register; apply/rowP => i; rewrite !mxE add0n -ltnS kn inordK //.
by case: eqVneq => [-> //|]; case: i => -[|[|//]] i2 //= _; congr (r k 0 _); apply: val_inj.
Qed.

Lemma register_windows_differ c c' : c != c' -> exists r, word (register n c) n.+2 r /\ ~ word (register n c') n.+2 r.
Proof.
move=> cc; exists (output (register n c) 0 (fun k => (k == 0%N)%:R%:M)); split; first exact: output_word.
case=> x [v e]; have /rowP/(_ 1) := e 0%N isT; have /rowP/(_ 0) := e n.+1 (ltnSn _).
rewrite !output_register !state_register /= add0n ltnn subnn !mxE /= mulr1n mul1r => e0 e1.
by move: cc; rewrite e0 -e1 mulr1n mul1r eqxx.
Qed.

(** theorem-1 at n samples, between two minimal left-invertible systems with the same A, C and G. *)
Theorem equal_on_n_samples_only c c' : c != 0 -> c' != 0 -> c != c' ->
  exists (S : system K n.+1 1 2) F, let S' := with_faults S F (sysG S) in
  [/\ observable S /\ observable S', fault_controllable S /\ fault_controllable S', inverts_at_once S /\ inverts_at_once S',
      forall r, word S n.+1 r <-> word S' n.+1 r & exists r, word S n.+2 r /\ ~ word S' n.+2 r].
Proof.
move=> c0 c'0 cc; exists (register n c), (sysF (register n c')) => S'; split; try split.
1,2: exact: register_observable.
1,2: exact: register_controllable.
1,2: exact: register_at_once.
1,2: by move=> _; apply: register_words.
exact: register_windows_differ.
Qed.

(** The windows s = n - 1 of assumption 4: the rank grows by 2 and not by m = 1, and the formula of theorem-2 fails. *)
Theorem window_n_minus_1 : exists S : system K n.+1 1 2, [/\ observable S, fault_controllable S, inverts_at_once S,
  \rank (window S n.+1) = (\rank (window S n) + 2)%N & (\rank (window S n) + zeta S)%N <> (n.+1 + n * 1)%N].
Proof.
exists (register n 1); have ranks s : (s <= n.+1)%N -> \rank (window (register n (1 : K)) s) = (s * 2)%N.
  by move=> sn; apply: full_window => r; apply: register_words.
have inv := at_once_left_invertible (@register_at_once 1).
split; [exact: register_observable|exact: (register_controllable (oner_neq0 K))|exact: register_at_once| |].
  by rewrite !ranks // mulSn addnC.
by move=> /(theorem_2 n inv)/(proposition_3_sharp n inv)/eqP; rewrite !ranks // mulSn addnC eqn_add2l.
Qed.

End Register.

Section DelayedFault.
Variable K : fieldType.
Notation S := (delayed_fault K : system K 1 1 (1 + 1)).

Lemma delayed_fault_observable : observable S.
Proof.
apply: observable_from_zeros => x /(_ 0%N isT); rewrite delayed_fault_output -row_mx0 => /eq_row_mx[] //.
Qed.

Lemma delayed_fault_controllable : fault_controllable S.
Proof. by move=> y; exists 1%N, (fun=> y); rewrite /= mulmx0 add0r mulmx1. Qed.

Lemma delayed_fault_at_once : inverts_at_once S.
Proof. by move=> x v; rewrite delayed_fault_output -row_mx0 => /eq_row_mx[]. Qed.

Lemma delayed_fault_left_invertible : left_invertible S.
Proof. exact: (at_once_left_invertible delayed_fault_at_once). Qed.

Lemma delayed_fault_lag : lag S = 1%N.
Proof.
apply/eqP; rewrite eqn_leq (lag_le_n S) ltnNge; apply/negP => /(proposition_3_sharp 0 delayed_fault_left_invertible).
rewrite full_window => [|r]; first by have := rank_leq_col (window S 0); rewrite leqn0 => /eqP ->.
exists (lsubmx (r 0%N)), (fun=> rsubmx (r 0%N)) => k; rewrite ltnS leqn0 => /eqP ->; by rewrite delayed_fault_output hsubmxK.
Qed.

(** At s = n = 1 every column solves problem (11); so does z = (0; 1, 0), and its behaviour, left-invertible too, is not in B. *)
Theorem window_n_accepts_wrong_pair :
  [/\ observable S, fault_controllable S, inverts_at_once S, forall f g, solves S 1 f g & exists (f : 'rV_1) (g : 'rV_(1 + 1)),
    left_invertible (with_faults S f g) /\ ~ (forall r, behavior (with_faults S f g) r -> behavior S r)].
Proof.
split; [exact: delayed_fault_observable|exact: delayed_fault_controllable|exact: delayed_fault_at_once| |].
  by case: (wrong_columns_at_n K).
exists 0, (row_mx 1%:M 0); split=> [v silent k|].
  rewrite -[v k]mulmx1; have := silent k; have state0 : state (with_faults S 0 (row_mx 1%:M 0)) 0 v k = 0.
    by case: k => //= k; rewrite !mulmx0 addr0.
  by rewrite /output state0 mul0mx add0r /= mul_mx_row -row_mx0 => /eq_row_mx[].
by move/(problem_11 S _ _ (ltnSn 1)) => /(delayed_fault_words)[/eqP]; rewrite oner_eq0.
Qed.

(** The first block column of T_s(z) is possible for ever, for z = (0; 1, 0); the second is not. *)
Theorem first_block_column_at_lag_plus_1 : let z := with_faults S (0 : 'rV_1) (row_mx 1%:M 0) in
  [/\ observable S, inverts_at_once S, lag S = 1%N,
      behavior S (output z 0 (fun k => if k == 0%N then 1%:M else 0)) & ~ solves S (lag S).+1 0 (row_mx 1%:M 0)].
Proof.
have [first bad] := first_block_column_is_not_enough K.
by move=> z; rewrite delayed_fault_lag; split=> //; [exact: delayed_fault_observable|exact: delayed_fault_at_once].
Qed.

(** Another basis of the state changes (A, C) and the form of the solutions, not the behaviour. *)
Definition rescaled (c : K) : system K 1 1 (1 + 1) := System 0 c%:M (row_mx c^-1%:M 0) (row_mx 0 1%:M).

Theorem equal_behaviors_other_solutions (c : K) s : c != 0 -> c != 1 -> (1 < s)%N -> exists S1 S2 : system K 1 1 (1 + 1),
  (forall r, behavior S1 r <-> behavior S2 r) /\ exists f g, solves S1 s f g /\ ~ solves S2 s f g.
Proof.
move=> c0 c1 s1; have out x v k : output (rescaled c) x v k = output S (c^-1 *: x) v k.
  have e : state S (c^-1 *: x) v k = c^-1 *: state (rescaled c) x v k.
    by case: k => //= k; rewrite !mulmx0 !add0r mulmx1 mul_mx_scalar scalerA mulVf ?scale1r.
  by rewrite /output e /= !mul_mx_row !mulmx0 !mulmx1 mul_mx_scalar.
exists (rescaled c), S; split=> [r|].
  split=> -[x [v e]]; first by exists (c^-1 *: x), v => k; rewrite e out.
  by exists (c *: x), v => k; rewrite e out scalerA mulVf ?scale1r.
exists c%:M, (row_mx 0 1%:M); split; first by have := own_fault_solves (rescaled c) s 1%:M; rewrite !mul1mx.
by case: s s1 => [|[|s]] // _ => /delayed_fault_words[_ /matrixP/(_ 0 0)/eqP]; rewrite !mxE !mulr1n (negPf c1).
Qed.

End DelayedFault.

(** x1(k+1) = x2(k), x2(k+1) = v(k), r = x1: the fault comes two samples late, so that one sample late is possible too. *)
Section DoubleDelay.
Variable K : fieldType.
Definition double_delay : system K (1 + 1) 1 1 := System (block_mx 0 0 1%:M 0) (row_mx 0 1%:M) (col_mx 1%:M 0) 0.
Notation S := double_delay.

Lemma double_delay_step x v k : state S x v k.+1 = row_mx (rsubmx (state S x v k)) (v k).
Proof.
rewrite /= -{1}[state _ _ _ _]hsubmxK mul_row_block mul_mx_row !mulmx0 !mulmx1 !addr0 add0r add_row_mx.
by rewrite addr0 add0r.
Qed.

Lemma double_delay_output x v k : output S x v k = if k is i.+1 then if i is j.+1 then v j else rsubmx x else lsubmx x.
Proof.
have -> : output S x v k = lsubmx (state S x v k).
  by rewrite /output mulmx0 addr0 -{1}[state _ _ _ _]hsubmxK mul_row_col mulmx1 mulmx0 addr0.
by case: k => [|[|k]] //; rewrite !double_delay_step row_mxKl // row_mxKr.
Qed.

Lemma double_delay_left_invertible : left_invertible S.
Proof. by move=> v silent k; rewrite -[RHS](silent k.+2) double_delay_output. Qed.

Theorem fault_matrices_beyond : [/\ observable S, fault_controllable S, left_invertible S, sysG S = 0 &
  exists f, (forall s, solves S s f 0) /\ ~ (f <= sysF S)%MS].
Proof.
split.
- apply: observable_from_zeros => x zeros; have := zeros 0%N isT; have := zeros 1%N isT; rewrite !double_delay_output => x2 x1.
  by rewrite -[x]hsubmxK x1 x2 row_mx0.
- move=> y; exists 2%N, (fun k => if k is 0%N then lsubmx y else rsubmx y).
  by rewrite !double_delay_step row_mxKr hsubmxK.
- exact: double_delay_left_invertible.
- by [].
exists (row_mx 1%:M 0); split=> [s|/submxP[c]].
  apply/solves_words => r _; exists (row_mx (r 0%N) (r 1%N)), (fun k => r k.+2) => k _.
  by rewrite double_delay_output; case: k => [|[|k]]; rewrite ?row_mxKl ?row_mxKr.
by rewrite mul_mx_row mulmx0 => /eq_row_mx[/eqP]; rewrite oner_eq0.
Qed.
End DoubleDelay.

(** x(k+1) = v(k), r = x + v: the zero q = -1, as v(k) = -x(k) keeps the output zero. *)
Section HiddenFault.
Variable K : fieldType.
Definition hidden_fault : system K 1 1 1 := System 0 1%:M 1%:M 1%:M.
Notation S := hidden_fault.

Theorem hidden_fault_not_recovered : [/\ observable S, fault_controllable S, left_invertible S & ~ faults_recovered_blindly S].
Proof.
split.
- by apply: observable_from_zeros => x /(_ 0%N isT); rewrite /output /= mul0mx addr0 mulmx1.
- by move=> y; exists 1%N, (fun=> y); rewrite /= mulmx0 add0r mulmx1.
- apply: (@delay_left_invertible _ _ _ _ _ 0%N) => v /(_ 0%N isT).
  by rewrite /output /= mul0mx add0r mulmx1.
move=> /(_ 1%:M 0 (fun k => ((-1) ^+ k.+1)%:M) (fun=> 0)) blind.
have states k : state S 1%:M (fun k => ((-1) ^+ k.+1)%:M) k = ((-1) ^+ k)%:M.
  by case: k => //= k; rewrite mulmx0 add0r mulmx1.
have same k : output S 1%:M (fun k => ((-1) ^+ k.+1)%:M) k = output S 0 (fun=> 0) k.
  by rewrite output_zero // /output states !mulmx1 exprS mulN1r raddfN /= subrr.
by have /matrixP/(_ 0 0)/eqP := blind same 0%N; rewrite !mxE expr1 mulr1n oppr_eq0 oner_eq0.
Qed.
End HiddenFault.

(** State feedback of the faults, (A + L F, C + L G) in rows, makes the same outputs. So (A, C) cannot be read off the behaviour: here
    A = 0 and A = 1, with F = C = 1 and G = 0. *)
Section Feedback.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (L : 'M[K]_(n, m)).
Definition with_feedback : system K n m p := System (sysA S + L *m sysF S) (sysF S) (sysC S + L *m sysG S) (sysG S).

Lemma feedback_output x v k : output with_feedback x v k = output S x (fun j => v j + state with_feedback x v j *m L) k.
Proof.
have e : state with_feedback x v k = state S x (fun j => v j + state with_feedback x v j *m L) k.
  by elim: k => //= k <-; rewrite mulmxDr mulmxDl mulmxA -!addrA; congr (_ + _); rewrite addrC.
by rewrite /output -e /= mulmxDr mulmxDl mulmxA -!addrA; congr (_ + _); rewrite addrC.
Qed.

End Feedback.

Theorem feedback_behavior (K : fieldType) n m p (S : system K n m p) L r : behavior (with_feedback S L) r <-> behavior S r.
Proof.
split=> -[x [v e]]; first by exists x, (fun j => v j + state (with_feedback S L) x v j *m L) => k; rewrite e feedback_output.
pose S' := with_feedback S L; have back : with_feedback S' (- L) = S.
  by rewrite /with_feedback /= !mulNmx !addrK; case: (S).
rewrite -back in e; exists x, (fun j => v j + state (with_feedback S' (- L)) x v j *m (- L)) => k.
by rewrite e feedback_output.
Qed.

Theorem behavior_does_not_fix_A (K : fieldType) : exists S S' : system K 1 1 1,
  [/\ observable S /\ observable S', fault_controllable S /\ fault_controllable S', left_invertible S /\ left_invertible S',
      forall r, behavior S r <-> behavior S' r & ~ exists B, B \in unitmx /\ sysA S' = invmx B *m sysA S *m B].
Proof.
pose S a : system K 1 1 1 := System a%:M 1%:M 1%:M 0.
have obs a : observable (S a) by apply: observable_from_zeros => x /(_ 0%N isT); rewrite /output /= mulmx1 mulmx0 addr0.
have ctrl a : fault_controllable (S a) by move=> y; exists 1%N, (fun=> y); rewrite /= mul0mx add0r mulmx1.
have inv a : left_invertible (S a).
  apply: (@delay_left_invertible _ _ _ _ _ 1%N) => v /(_ 1%N isT).
  by rewrite /output /= mul0mx add0r !mulmx1 mulmx0 addr0.
exists (S 0), (S 1); split=> // [r|[B [_ /eqP]]]; last by rewrite /= [0%:M]raddf0 mulmx0 mul0mx oner_eq0.
rewrite -(feedback_behavior (S 0) 1%:M); suff -> : with_feedback (S 0) 1%:M = S 1 by [].
by rewrite /with_feedback /= mulmx1 mulmx0 addr0 raddf0 add0r.
Qed.

(** x(k+1) = 0, r = x: observable, but the fault does nothing. *)
Theorem gap_needs_left_invertibility (K : fieldType) : exists S : system K 1 1 1,
  observable S /\ forall s, (1 <= s)%N -> \rank (window S s.+1) <> (\rank (window S s) + 1)%N.
Proof.
pose S : system K 1 1 1 := System 0 0 1%:M 0; exists S; split=> [|s s1 /(proposition_3 _ s1) inv].
  by apply: observable_from_zeros => x /(_ 0%N isT); rewrite /output /= mulmx1 mulmx0 addr0.
have silent k : output S 0 (fun=> 1%:M) k = 0.
  by rewrite /output mulmx0 addr0 mulmx1; elim: k => //= k ->; rewrite !mulmx0 addr0.
by have /matrixP/(_ 0 0)/eqP := inv _ silent 0%N; rewrite !mxE oner_eq0.
Qed.

(** The two columns of Counterexamples.v, of full rank: with as many outputs as faults the lag is 0, and every window accepts them. *)
Theorem full_rank_pair_not_equivalent (K : fieldType) : exists (S : system K 1 (1 + 1) (1 + 1)) k
    (Z : 'M_(k, 1 + (1 + 1))) (P : 'M_(1 + 1, k)),
  [/\ observable S, left_invertible S, forall s, spans_solutions S s Z, row_free P
    & ~ (forall r, behavior (faults_of S (P *m Z)) r <-> behavior S r)].
Proof.
have [inv span free differ] := full_rank_is_not_enough K.
exists (delay_and_direct K), (1 + (1 + 1))%N, 1%:M, (two_columns K); split=> //.
apply: observable_from_zeros => x /(_ 0%N isT); rewrite /output /= mul0mx addr0 mul_mx_row mulmx1 mulmx0 -row_mx0.
by case/eq_row_mx.
Qed.
