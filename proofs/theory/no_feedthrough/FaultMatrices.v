(** zero-feedthrough, for fault matrices of the same behaviour: two faults tell of the double delay all that one does, though the row
    space of their F' is larger; and which F' there are with G' = 0 is told by problem (11), so the rows of all of them are in the row
    space of F just when those of its solutions (f, 0) are. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Infinite SmallSystems Solutions Problem11.
From faultspace Require ClosedForm.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Theorem fault_matrices_equal (K : fieldType) : exists (S : system K (1 + 1) 1 1) (F' : 'M_(1, 1 + 1)),
  [/\ observable S, fault_controllable S, left_invertible S, sysG S = 0 &
      (forall r, behavior (with_faults S F' 0) r <-> behavior S r) /\ ~ (F' <= sysF S)%MS].
Proof.
have [o c l g [f [_ nf]]] := SmallSystems.fault_matrices_beyond K.
exists (double_delay K), (row_mx 1%:M 0); split=> //; split; last first.
  case/submxP => d; by rewrite mul_mx_row mulmx0 => /eq_row_mx[/eqP]; rewrite oner_eq0.
move=> r; split=> _.
  exists (row_mx (r 0%N) (r 1%N)), (fun k => r k.+2) => k.
  by rewrite double_delay_output; case: k => [|[|k]]; rewrite ?row_mxKl ?row_mxKr.
exists (row_mx (r 0%N) 0), (fun k => r k.+1) => k; set S' := with_faults _ _ _; set v := fun _ => _.
have -> : output S' (row_mx (r 0%N) 0) v k = r k; last by [].
have st : state S' (row_mx (r 0%N) 0) v k = row_mx (r k) 0.
  elim: k => //= k ->; rewrite mul_row_block mul_mx_row !mulmx0 !mul0mx mulmx1 !addr0 add_row_mx.
  by rewrite addr0 add0r.
by rewrite /output st /= mul_row_col mulmx1 mul0mx mulmx0 !addr0.
Qed.

Theorem zero_feedthrough_any (K : fieldType) n m p (S : system K n m p) s : (n < s)%N -> sysG S = 0 ->
  (forall m' (F' : 'M_(m', n)), (forall r, behavior (with_faults S F' 0) r <-> behavior S r) -> (F' <= sysF S)%MS) <->
  (forall f, solves S s f 0 -> (f <= sysF S)%MS).
Proof.
move=> ns G0; split=> h.
  move=> f sol; suff : (col_mx (sysF S) f <= sysF S)%MS by rewrite col_mx_sub => /andP[].
  apply: h => r; split; last first.
    move=> [x [v e]]; exists x, (fun k => row_mx (v k) 0) => k; rewrite e.
    set w := fun k => row_mx (v k) 0.
    have st : state (with_faults S (col_mx (sysF S) f) 0) x w k = state S x v k.
      by elim: k {e} => //= k ->; rewrite mul_row_col mul0mx addr0.
    by rewrite /output st /= G0 !mulmx0.
  move: r; apply/behavior_subP => s' r; move: r; apply/solution_rows => i.
  suff sol' : forall l, (n < l)%N -> solves S l (row i (col_mx (sysF S) f)) (row i (0 : 'M_(m+1, p))).
    apply: (@solves_shorter _ _ _ _ S s' (maxn n.+1 s')); first exact: leq_maxr.
    by apply: sol'; apply: leq_maxl.
  move=> l nl; rewrite row0; case: (split_ordP i) => j ->; last first.
    rewrite rowKd (_ : row j f = f); last by apply/rowP => q; rewrite !mxE ord1.
    exact/(problem_11_same_solutions _ _ _ ns nl).
  rewrite rowKu; have := ClosedForm.own_fault_solves S l (row j 1%:M).
  by rewrite G0 mulmx0 -row_mul mul1mx.
move=> m' F' same; apply/row_subP => i; apply: h.
apply/(problem_11 S _ _ ns) => r [x [v e]]; apply/same; exists x, (fun k => v k *m delta_mx 0 i) => k.
rewrite e; set w := fun k => _ *m _.
have st : state (with_faults S F' 0) x w k = state (with_faults S (row i F') (0 : 'rV_p)) x v k.
  by elim: k {e} => //= k ->; rewrite -mulmxA -rowE.
by rewrite /output st /= !mulmx0.
Qed.
