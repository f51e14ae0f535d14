(** When problem (11) has reached its limit: exactly from lag + 1 samples on, for every system. With as many independent outputs as faults,
    normal rank p, that is every window of at least one sample, and everything is a solution. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  vector.
From faultspace Require Import Vocabulary Lag Problem11 CanonicalForm SolutionCount.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section SettledSolutions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (f : 'rV[K]_n) (g : 'rV[K]_p).

Theorem problem_11_from_lag s f g : (lag S <= s)%N ->
  solves S s.+1 f g <-> (forall r, behavior (with_faults S f g) r -> behavior S r).
Proof.
move=> ls; apply: problem_11_settled_gap => t st.
by rewrite (gap_from_lag ls) gap_from_lag // (leq_trans ls st).
Qed.

Theorem solutions_settle_at_lag s :
  (forall f g, solves S s.+1 f g <-> (forall r, behavior (with_faults S f g) r -> behavior S r)) <-> (lag S <= s)%N.
Proof.
split=> [same|ls f g]; last exact: problem_11_from_lag.
have limit := (solution_count_zeta (solution_spaceP S n.+1)).2 (lag_le_n S).
suff span : spans_solutions S s.+1 (solution_space S n.+1) by apply/(solution_count_zeta span).
by move=> f g; rewrite same -(problem_11 S f g (ltnSn n)); apply: solution_spaceP.
Qed.

Theorem all_columns_solve s f g : gap S n = p -> solves S s f g.
Proof.
move=> full; apply: (@solves_shorter _ _ _ _ S s s.+1) => //; apply/(solution_spaceP S).
have := solution_count (solution_spaceP S s.+1); have /size0nil-> : size (etas S) = 0%N by rewrite size_etas full subnn.
by rewrite big_nil addn0 => r; apply: submx_full; rewrite /row_full r.
Qed.

End SettledSolutions.
