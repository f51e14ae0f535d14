(** B and D under two-sided exogeneity, u of any colour: with the true A and C, MOESP's regression for B and D has residual zero, and it is
    zero for no other B and D, if the window has n + 1 samples and observes (A, C). Uniqueness is problem (11) for a system without faults:
    what is possible without faults at all has f = 0 and g = 0. *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary Basics Windows Consistency Problem11.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section WithoutFaults.
Variables (K : fieldType) (n p : nat) (S : system K n 0 p).

Lemma solves_without_faults s (f : 'rV_n) (g : 'rV_p) : (n < s)%N -> row_free (O S s) -> solves S s f g -> f = 0 /\ g = 0.
Proof.
move=> ns obs /(problem_11_from_rest S f g ns) sol; set Z := with_faults S f g in sol.
have [x [v e]] := sol (fun k => if k == s then 1%:M else 0).
have v0 k : v k = 0 by apply/rowP=> -[].
have quiet k : (k < s)%N -> output Z 0 (fun k => if k == s then 1%:M else 0) k = 0.
  by move=> ks; apply: output_zero => j jk; rewrite ltn_eqF // (leq_ltn_trans jk).
have x0 : x = 0.
  apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0 => k ks.
  by rewrite -[RHS](quiet k ks) e; apply: output_ext => j _; rewrite v0.
have zero k : output Z 0 (fun k => if k == s then 1%:M else 0) k = 0 by rewrite e x0 output_zero.
have g0 : g = 0.
  by rewrite -[RHS](zero s) /output state_zero => [|j js]; rewrite ?mul0mx ?add0r ?eqxx ?mul1mx // ltn_eqF.
split=> //; apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0 => k _.
rewrite -[RHS](zero (s.+1 + k)%N) output_shift /= eqxx mul1mx state_zero ?mul0mx ?add0r => [|j js]; last by rewrite ltn_eqF.
rewrite -(output_free S f g); apply: output_ext => j _.
by rewrite gtn_eqF // addSn ltnS leq_addr.
Qed.

End WithoutFaults.

Section Regression.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p).
Implicit Types (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).

Lemma output_faults_sub B B' D D' w k : output (with_faults S (B - B') (D - D')) 0 w k =
  output (with_faults S B D) 0 w k - output (with_faults S B' D') 0 w k.
Proof.
have states : state (with_faults S (B - B') (D - D')) 0 w k = state (with_faults S B D) 0 w k - state (with_faults S B' D') 0 w k.
  by elim: k => [|k IH]; rewrite ?subr0 //= IH mulmxBr mulmxBl addrACA -opprD.
by rewrite /output states /= mulmxBr mulmxBl addrACA -opprD.
Qed.

Theorem regression_unique s B B' D D' : (n < s)%N -> row_free (O S s) ->
  T (with_faults S B D) s *m cokermx (O S s) = T (with_faults S B' D') s *m cokermx (O S s) -> B = B' /\ D = D'.
Proof.
move=> ns obs e; pose S0 := with_faults S (0 : 'M_(0, n)) 0.
have O0 : O S0 s = O S s by apply/row_matrixP=> i; rewrite !rowK; apply: samples_ext => k _; apply: output_free.
have sol i : solves S0 s (row i (B - B')) (row i (D - D')).
  apply/T_subP => w; pose v j := w j *m delta_mx 0 i.
  apply: (word_ext (r := output (with_faults S (B - B') (D - D')) 0 v)) => [k _|].
    rewrite -[LHS](output_combined_faults (with_faults S (B - B') (D - D')) (delta_mx 0 i)).
    by rewrite /= -!rowE.
  apply/windowP; apply: submx_trans (_ : _ <= O S0 s)%MS _; last by rewrite -addsmxE addsmxSl.
  rewrite O0 submxE (samples_ext (fun k _ => output_faults_sub B B' D D' v k)).
  rewrite (samples_add s (output (with_faults S B D) 0 v) (fun k => - output (with_faults S B' D') 0 v k)) samples_opp.
  rewrite -!window_response !mul_row_col !mul0mx !add0r mulmxBl -!mulmxA e subrr //.
have zero i : row i (B - B') = 0 /\ row i (D - D') = 0 by apply: solves_without_faults ns _ (sol i); rewrite O0.
by split; apply/eqP; rewrite -subr_eq0; apply/eqP/row_matrixP=> i; rewrite row0; have [? ?] := zero i.
Qed.

End Regression.

Section Exogenous.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Hypothesis model : process S B D u v x y.

Theorem two_sided_regression t s W B' D' : let Uf := future t s u in (n < s)%N -> row_free (O S s) ->
  W *m cov Q Uf Uf = 1%:M -> cov Q Uf (future t s v) = 0 ->
  (W *m cov Q Uf (future t s y) - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D.
Proof.
move=> Uf ns obs hW uv; rewrite mulmxBl (regression model hW uv); split=> [/eqP|[-> ->]]; last by rewrite subrr.
by rewrite subr_eq0 => /eqP/(regression_unique ns obs)[-> ->].
Qed.

End Exogenous.
