(** Problem (11), exact. From s = n + 1 on, and as soon as s - 1 is past the last change of the gap, its solutions are the columns whose
    behaviour lies in that of S, with free initial states or from rest. At s = n it accepts wrong columns, and of the block columns of
    T_s(z) the first alone is not enough: both on the system with A = 0, F = 1, C = [1 0], G = [0 1] in rows, over any field.

    delayed_fault == x(k+1) = v(k), r = (x, v) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix.
From faultspace Require Import Vocabulary Basics Windows Infinite Gap SharpWindows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Problem11.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (f : 'rV[K]_n) (g : 'rV[K]_p).

Theorem problem_11_settled_gap s f g : (forall t, (s <= t)%N -> gap S t = gap S s) ->
  solves S s.+1 f g <-> (forall r, behavior (with_faults S f g) r -> behavior S r).
Proof.
move=> settled; rewrite solves_words behavior_subP; split=> h; last exact: (h s.+1).
exact: inclusion_past_settled_gap h.
Qed.

Theorem problem_11 s f g : (n < s)%N -> solves S s f g <-> (forall r, behavior (with_faults S f g) r -> behavior S r).
Proof. by case: s => // s ns; apply: problem_11_settled_gap => t st; rewrite !gap_constant // (leq_trans _ st). Qed.

Theorem problem_11_from_rest s f g : (n < s)%N -> solves S s f g <-> (forall v, behavior S (output (with_faults S f g) 0 v)).
Proof. by move=> ns; rewrite problem_11 // behavior_from_rest. Qed.

(** So all windows of n + 1 samples or more have the same solutions. *)
Corollary problem_11_same_solutions s t f g : (n < s)%N -> (n < t)%N -> solves S s f g <-> solves S t f g.
Proof. by move=> ns nt; rewrite !problem_11. Qed.

(** Longer windows have no more solutions than shorter ones. *)
Lemma solves_shorter s t f g : (s <= t)%N -> solves S t f g -> solves S s f g.
Proof. by move=> st /solvesP h; apply/solvesP => v; apply: word_prefix st (h v). Qed.

End Problem11.

(** x(k+1) = v(k), r(k) = (x(k), v(k)). *)
Section WrongColumns.
Variable K : fieldType.
Definition delayed_fault : system K 1 1 (1 + 1) := System 0 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M).

Lemma delayed_fault_output x v k : output delayed_fault x v k = row_mx (if k is j.+1 then v j else x) (v k).
Proof.
rewrite /output !mul_mx_row !mulmx1 !mulmx0 add_row_mx addr0 add0r; congr row_mx.
by case: k => //= k; rewrite mulmx0 mulmx1 add0r.
Qed.

Lemma delayed_fault_words f g h s : solves delayed_fault s.+2 f (row_mx g h) -> g = 0 /\ f = h.
Proof.
move=> /solvesP sol; split.
  have [x [v e]] := sol (fun k => if k == 1%N then 1%:M else 0); have := e 0%N isT; have := e 1%N isT.
  rewrite !delayed_fault_output /output /= !mul0mx !addr0 mul0mx add0r mul1mx -[X in X = row_mx x _]row_mx0.
  by move=> /eq_row_mx[-> _] /eq_row_mx[_ <-].
have [x [v e]] := sol (fun k => if k == 0%N then 1%:M else 0); have := e 0%N isT; have := e 1%N isT.
rewrite !delayed_fault_output /output /= !mulmx0 !mul0mx !addr0 !add0r !mul1mx mul_mx_row mulmx1.
by move=> /eq_row_mx[-> _] /eq_row_mx[_ ->].
Qed.

(** At s = n = 1 everything solves problem (11), (f; g) = (5; 3, -2) among it, which is no solution at s = 2. *)
Theorem wrong_columns_at_n : (forall f g, solves delayed_fault 1 f g) /\
  ~ solves delayed_fault 2 5%:R%:M (row_mx 3%:R%:M (- 2%:R)%:M).
Proof.
split=> [f g|/delayed_fault_words[]].
  apply/solvesP => v; exists (lsubmx (v 0%N *m g)), (fun=> rsubmx (v 0%N *m g)) => -[|//] _.
  by rewrite delayed_fault_output hsubmxK /output mul0mx add0r.
move=> /(congr1 (fun M : 'M_1 => M 0 0)) e3 /(congr1 (fun M : 'M_1 => M 0 0)); rewrite !mxE /= in e3 *.
rewrite !mulr1n in e3 * => /eqP; rewrite -subr_eq0 opprK -natrD -[(5 + 2)%N]/(3 * 2 + 1)%N natrD natrM e3 mul0r add0r.
by rewrite oner_eq0.
Qed.

(** (f; g) = (0; 1, 0): the response to a fault at time 0, the first block column, is possible for ever, but not that to a fault at time
    1. *)
Theorem first_block_column_is_not_enough : let z := with_faults delayed_fault 0 (row_mx 1%:M 0) in
  behavior delayed_fault (output z 0 (fun k => if k == 0%N then 1%:M else 0)) /\ ~ solves delayed_fault 2 0 (row_mx 1%:M 0).
Proof.
move=> z; split=> [|/delayed_fault_words[/eqP]]; last by rewrite -scalemx1 scale1r oner_eq0.
exists 1%:M, (fun=> 0) => k; rewrite delayed_fault_output /output.
have -> : state z 0 (fun j => if j == 0%N then 1%:M else 0) k = 0 by elim: k => //= k ->; rewrite mul0mx mulmx0 addr0.
by case: k => [|k]; rewrite !mul0mx ?add0r ?mul1mx ?row_mx0.
Qed.

End WrongColumns.
