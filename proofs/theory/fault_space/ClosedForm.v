(** The solutions of problem (11) in closed form, for every system and every window s >= n + 1: with U = W + V, W the limit of the states
    that can be reached silently, V the states that can hold the output at zero, they are the (f, g) with f = v F + x A + u and
    g = v G + x C, x and u in U. Those with g = 0 are exactly U. Neither left-invertibility nor observability is needed.

    closed_form S == the rows (F, G), (U A, U C) and (U, 0), U being the zero states *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Chain Problem11 Kick CanonicalForm Trajectory ZeroFeedthrough.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section ClosedForm.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (f x : 'rV[K]_n) (g : 'rV[K]_p) (v : nat -> 'rV[K]_m) (u : nat -> 'rV[K]_1).
Notation alone f := (with_faults S f (0 : 'rV_p)).
Notation W := (silent S n).
Notation zero_states := (zero_states S).

Definition closed_form : 'M[K]_(m + (n + n), n + p) :=
  col_mx (row_mx (sysF S) (sysG S)) (col_mx (row_mx (zero_states *m sysA S) (zero_states *m sysC S)) (row_mx zero_states 0)).

Lemma solves_add s f g f' g' : solves S s f g -> solves S s f' g' -> solves S s (f + f') (g + g').
Proof. by rewrite !(solution_spaceP S s) -add_row_mx; apply: addmx_sub. Qed.

Lemma own_fault_solves s (w : 'rV_m) : solves S s (w *m sysF S) (w *m sysG S).
Proof. by apply/solvesP => u; exists 0, (fun k => u k *m w) => k _; rewrite output_combined_faults. Qed.

(** To be kicked by f is to be kicked by (f A, f C) one step later. *)
Lemma shift_solves s f : solves S s f 0 <-> solves S s (f *m sysA S) (f *m sysC S).
Proof.
split=> [/solves_words sub | /solvesP sol]; apply/solvesP => u.
  apply: sub; exists (u 0%N *m f), (fun k => u k.+1) => k _.
  have states : state (alone f) (u 0%N *m f) (fun k => u k.+1) k =
      state (with_faults S (f *m sysA S) (f *m sysC S)) 0 u k + u k *m f.
    by elim: k => [|k IH] /=; rewrite ?add0r // IH mulmxDl mulmxA.
  by rewrite /output states mulmx0 addr0 mulmxDl /= mulmxA.
apply: word_ext (sol (fun k => if k is j.+1 then u j else 0)) => k _.
have states : state (alone f) 0 u k =
    state (with_faults S (f *m sysA S) (f *m sysC S)) 0 (fun k => if k is j.+1 then u j else 0) k + (if k is j.+1 then u j else 0) *m f.
  by elim: k => [|k IH] /=; rewrite ?mul0mx ?addr0 // IH mulmxDl /= mulmxA.
by rewrite /output states mulmx0 addr0 mulmxDl /= mulmxA.
Qed.

(** A state reached silently may be kicked in, as the trajectory on the silent way to it shows. *)
Lemma silent_reached_solves s f : (f <= W)%MS -> solves S s f 0.
Proof.
move=> /silentP/(chain_constant _ _ (leq_addr s n)) reach; apply: (shift_solves s f).2.
apply: (@solves_shorter _ _ _ _ _ _ (n + s).+1); first by apply: leqW; apply: leq_addl.
by have := kick_solves 0 reach; rewrite /kick_f /kick_g !mul0mx !addr0.
Qed.

Lemma zero_state_solves s f : (f <= zero_states)%MS -> solves S s f 0.
Proof.
case/sub_addsmxP => -[a b] ->; rewrite -[0](addr0 0); apply: solves_add.
  by apply: silent_reached_solves; apply: submxMl.
by apply: silent_state_solves; apply/zero_holdingP; apply: submxMl.
Qed.

(** What a fault at time n tells: the state that produces its output before it strikes, and the difference of the states afterwards. *)
Lemma solution_decomposes s f g : (n < s)%N -> solves S s f g -> exists x (w : 'rV_m) y,
  [/\ (x <= W)%MS, (y <= zero_holding S)%MS, f = x *m sysA S + w *m sysF S + y & g = x *m sysC S + w *m sysG S].
Proof.
move=> ns sol; pose u k : 'rV[K]_1 := (k == n)%:R%:M.
have [x [v e]] := (problem_11 S f g ns).1 sol _ (output_behavior _ 0 u).
have before k : (k <= n)%N -> state (with_faults S f g) 0 u k = 0.
  by move=> kn; apply: state_zero => j jk; rewrite /u ltn_eqF ?raddf0 // (leq_trans jk).
exists (state S x v n), (v n), (f - state S x v n.+1); split.
- apply/silentP; exists x, v; split=> // j jn.
  by rewrite -e /output before ?(ltnW jn) // /u ltn_eqF // raddf0 !mul0mx addr0.
- apply/zero_holdingP; exists (fun k => 0 - v (n.+1 + k)%N) => k _; rewrite output_sub -output_shift -e output_shift /=.
  rewrite before // mul0mx add0r /u eqxx mul1mx -(output_free S f g).
  apply/eqP; rewrite subr_eq0; apply/eqP/output_ext => j _.
  by rewrite gtn_eqF ?raddf0 // addSn ltnS leq_addr.
- by rewrite addrC subrK.
- by have := e n; rewrite /output before // /u eqxx mul0mx add0r mul1mx.
Qed.

Theorem zero_state_solutions s f : (n < s)%N -> solves S s f 0 <-> (f <= zero_states)%MS.
Proof.
move=> ns; split=> [/(solution_decomposes ns)[x [w [y [xW yV -> /esym quiet]]]] | ]; last exact: zero_state_solves.
apply: addmx_sub_adds yV; apply: submx_trans (silent_decreasing S (leqnSn n)).
by apply/silent_stepP; exists x, w.
Qed.

Theorem solutions_closed_form s : (n < s)%N -> spans_solutions S s closed_form.
Proof.
move=> ns f g; split=> [/(solution_decomposes ns)[x [w [y [xW yV -> ->]]]] | /submxP[c]].
  have /submxP[a xE] : (x <= zero_states)%MS by apply: submx_trans xW (addsmxSl _ _).
  have /submxP[b yE] : (y <= zero_states)%MS by apply: submx_trans yV (addsmxSr _ _).
  apply/submxP; exists (row_mx w (row_mx a b)).
  by rewrite !mul_row_col !mul_mx_row !mulmxA -xE -yE mulmx0 !add_row_mx addr0 addrA [X in row_mx (X + _) _]addrC [X in row_mx _ X]addrC.
rewrite -(hsubmxK c) -(hsubmxK (rsubmx c)) !mul_row_col !mul_mx_row mulmx0 !add_row_mx addr0 => /eq_row_mx[-> ->].
apply: solves_add; first exact: own_fault_solves.
rewrite -[X in solves _ _ _ X]addr0; apply: solves_add; last by apply: zero_state_solves; apply: submxMl.
rewrite (mulmxA _ _ (sysA S)) (mulmxA _ _ (sysC S)).
by apply: (shift_solves _ _).1; apply: zero_state_solves; apply: submxMl.
Qed.

(** Without feedthrough: im F + U + A (U n ker C), in columns. *)
Theorem zero_feedthrough_solutions s f : (n < s)%N -> sysG S = 0 ->
  solves S s f 0 <-> exists (w : 'rV_m) x y,
    [/\ (x <= zero_states)%MS, x *m sysC S = 0, (y <= zero_states)%MS & f = w *m sysF S + x *m sysA S + y].
Proof.
move=> ns G0; split=> [/(solution_decomposes ns)[x [w [y [xW yV -> e]]]] | [w [x [y [xU xC yU ->]]]]].
  exists w, x, y; split; first exact: submx_trans xW (addsmxSl _ _); last by rewrite [w *m _ + _]addrC.
    by rewrite [RHS]e G0 mulmx0 addr0.
  exact: submx_trans yV (addsmxSr _ _).
have -> : (0 : 'rV[K]_p) = w *m sysG S + x *m sysC S + 0 by rewrite G0 xC mulmx0 !addr0.
apply: solves_add (zero_state_solves s yU); apply: solves_add (own_fault_solves s w) _.
by apply: (shift_solves _ _).1; apply: zero_state_solves.
Qed.

End ClosedForm.
