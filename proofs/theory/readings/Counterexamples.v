(** theorem-3 cannot do with less, over any field: a P of full rank may give a pair that is not equivalent; two systems with different
    (A, C) and included behaviours may differ though both are left-invertible; and so may two with the same (A, C) and as many faults
    when only the larger is left-invertible.

       delay_and_direct == x(k+1) = v1(k), r = (x, v2)
            two_columns == the columns (1, 0, 0) and (0, 1, 0), as rows
        forgets, shifts == two states without faults, r = (x1, 0, 0, ...) and r = (x1, x2, 0, ...)
    nothing, everything == no state, r = 0 and r = v
             unobserved == x(k+1) = x(k) + v(k), r = v *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Inversion.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Counterexamples.
Variable K : fieldType.

(** x(k+1) = v1(k), r(k) = (x(k), v2(k)): every sequence is an output, so every column solves problem (11). *)
Definition delay_and_direct : system K 1 (1 + 1) (1 + 1) := System 0 (col_mx 1%:M 0) (row_mx 1%:M 0) (block_mx 0 0 0 1%:M).
(** The columns (1, 0, 0) and (0, 1, 0), rows here. *)
Definition two_columns : 'M[K]_(1 + 1, 1 + (1 + 1)) := block_mx 1%:M 0 0 (row_mx 1%:M 0).

Lemma delay_and_direct_output (r : nat -> 'rV_(1 + 1)) : behavior delay_and_direct r.
Proof.
exists (lsubmx (r 0%N)), (fun k => row_mx (lsubmx (r k.+1)) (rsubmx (r k))) => k.
have -> : output delay_and_direct (lsubmx (r 0%N)) (fun k => row_mx (lsubmx (r k.+1)) (rsubmx (r k))) k =
    row_mx (lsubmx (r k)) (rsubmx (r k)); last by rewrite hsubmxK.
rewrite /output /= mul_row_block mul_mx_row !mulmx0 !mulmx1 !add0r add_row_mx !addr0 add0r; congr (row_mx _ _).
by case: k => //= k; rewrite mulmx0 add0r mul_row_col mulmx1 mulmx0 addr0.
Qed.

Theorem full_rank_is_not_enough :
  [/\ left_invertible delay_and_direct,
      forall s, spans_solutions delay_and_direct s (1%:M : 'M_(1 + (1 + 1))),
      row_free two_columns
    & ~ (forall r, behavior (faults_of delay_and_direct (two_columns *m 1%:M)) r <-> behavior delay_and_direct r)].
Proof.
split.
- apply: (delay_left_invertible (l := 1)) => v silent.
  have := silent 0%N isT; have := silent 1%N isT; rewrite -[v 0%N]hsubmxK /output /= mulmx0 !add0r !mul0mx !add0r.
  rewrite -[v 0%N]hsubmxK -[v 1%N]hsubmxK !mul_row_block mul_row_col mul_mx_row !mulmx0 !mulmx1 !addr0 !add0r add_row_mx addr0 add0r.
  by rewrite hsubmxK -!row_mx0 => /eq_row_mx[-> _] /eq_row_mx[_ ->]; rewrite !row_mx0.
- move=> s f g; rewrite submx1; split=> // _; apply/solves_words => r _.
  exact/behavior_word/delay_and_direct_output.
- by rewrite /row_free /two_columns rank_diag_block_mx rank_row_mx0 !mxrank1.
- move=> same; have /same [x [v e]] := delay_and_direct_output (fun=> row_mx 0 1%:M).
  have := congr1 rsubmx (e 0%N); rewrite row_mxKr /output /= mulmx1 /two_columns block_mxEh row_mxKr -[v 0%N]hsubmxK.
  rewrite mul_row_col mulmx0 add0r !mul_mx_row !mulmx0 !mulmx1 add_row_mx row_mxKr addr0 => /matrixP/(_ 0 0)/eqP.
  by rewrite !mxE oner_eq0.
Qed.

(** r = (x1, 0, 0, ...) against r = (x1, x2, 0, ...), without faults. *)
Definition forgets : system K (1 + 1) 0 1 := System 0 0 (col_mx 1%:M 0) 0.
Definition shifts : system K (1 + 1) 0 1 := System (block_mx 0 0 1%:M 0) 0 (col_mx 1%:M 0) 0.

Theorem same_A_is_needed :
  [/\ left_invertible forgets, left_invertible shifts, sysC forgets = sysC shifts,
      forall r, behavior forgets r -> behavior shifts r & ~ (forall r, behavior shifts r -> behavior forgets r)].
Proof.
have no_faults (S : system K (1 + 1) 0 1) : left_invertible S by move=> v _ k; rewrite [v k]thinmx0 //.
split=> //.
- move=> r [x [v e]]; exists (row_mx (lsubmx x) 0), v => k; rewrite e /output; congr (_ + _).
  rewrite -{1}[x]hsubmxK.
  have -> : state shifts (row_mx (lsubmx x) 0) v k = if k is 0%N then row_mx (lsubmx x) 0 else 0.
    case: k => //; elim=> [|k IH]; last by rewrite /= -/(state _ _ _ k.+1) IH mul0mx mulmx0 addr0.
    by rewrite /= mul_row_block !mulmx0 !mul0mx !addr0 row_mx0.
  case: k => [|k] /=; last by rewrite !mulmx0 addr0.
  by rewrite !mul_row_col !mulmx0.
- move=> sub; have [x [v /(_ 1%N)]] := sub _ (output_behavior shifts (row_mx 0 1%:M) (fun=> 0)).
  rewrite /output /= !mulmx0 !addr0 mul_row_block !mulmx0 !mul0mx mul1mx add0r addr0 mul_row_col mulmx1 mulmx0 addr0.
  by move=> /matrixP/(_ 0 0)/eqP; rewrite !mxE oner_eq0.
Qed.

(** r = 0 against r = v, with no state at all. *)
Definition nothing : system K 0 1 1 := System 0 0 0 0.
Definition everything : system K 0 1 1 := System 0 0 0 1%:M.

Theorem left_invertibility_of_the_smaller_is_needed :
  [/\ left_invertible everything, ~ left_invertible nothing, sysA nothing = sysA everything /\ sysC nothing = sysC everything,
      forall r, behavior nothing r -> behavior everything r & ~ (forall r, behavior everything r -> behavior nothing r)].
Proof.
split=> //.
- by move=> v silent k; rewrite -[RHS](silent k) /output /= mulmx0 add0r mulmx1.
- move=> inv; have silent k : output nothing 0 (fun=> 1%:M) k = 0 by rewrite /output /= !mulmx0 addr0.
  by have /matrixP/(_ 0 0)/eqP := inv _ silent 0%N; rewrite !mxE oner_eq0.
- move=> r [x [v e]]; exists 0, (fun=> 0) => k; by rewrite e /output /= !mulmx0 mul0mx !addr0.
- move=> sub; have [x [v e]] := sub _ (output_behavior everything 0 (fun=> 1%:M)).
  have := e 0%N; rewrite /output /= !mulmx0 ?mul0mx !add0r mulmx1 => /matrixP/(_ 0 0)/eqP.
  by rewrite !mxE /= oner_eq0.
Qed.

(** One fault: without observability a nonzero solution need not be equivalent. x(k+1) = x(k) + v(k), r(k) = v(k). *)
Definition unobserved : system K 1 1 1 := System 1%:M 1%:M 0 1%:M.

Theorem observability_is_needed :
  [/\ left_invertible unobserved, forall s, solves unobserved s 1%:M 0
    & ~ (forall r, behavior (with_faults unobserved (1%:M : 'rV_1) (0 : 'rV_1)) r <-> behavior unobserved r)].
Proof.
split.
- by move=> v silent k; rewrite -[RHS](silent k) /output mulmx0 add0r mulmx1.
- move=> s; apply/solvesP => v; exists 0, (fun=> 0) => k _.
  by rewrite /output !mulmx0 mul0mx addr0.
- move=> same; have /same[x [v /(_ 0%N)]] := output_behavior unobserved 0 (fun=> 1%:M).
  by rewrite /output !mulmx0 !add0r mulmx1 => /matrixP/(_ 0 0)/eqP; rewrite !mxE oner_eq0.
Qed.

End Counterexamples.
