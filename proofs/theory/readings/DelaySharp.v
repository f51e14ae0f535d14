(** The bounds on the delay with unknown initial state are attained for every number of states: a shift register that is fed by the fault
    and shows its other end.

    shown n == a shift register of n + 1 states, fed by the fault, that shows its other end *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv matrix mxalgebra mxpoly fraction.
From faultspace Require Import Vocabulary StructureVocabulary Theorem1Sharp.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Register.
Variables (K : fieldType) (n : nat).

(** Section: definitions. *)
Definition shown : system K n.+1 1 1 := System (sysA (register n (1 : K))) (sysF (register n (1 : K))) (delta_mx 0 0) 0.

Lemma state_shown x v k : state shown x v k = state (register n (1 : K)) x v k.
Proof. by elim: k => //= k ->. Qed.

Lemma output_shown x v k : output shown x v k 0 0 = if (k <= n)%N then x 0 (inord k) else v (k - n.+1)%N 0 0.
Proof.
rewrite /output mulmx0 addr0 state_shown !mxE (bigD1 0) //= big1 => [|j /negbTE j0]; last by rewrite !mxE j0 mulr0.
by rewrite addr0 !mxE !eqxx mulr1 state_register add0n mulr1.
Qed.

Lemma range_of_shown : \rank (col_mx (sysA shown) (sysF shown)) = n.+1.
Proof.
apply/eqP; rewrite -[_ == _]/(row_full _) -sub1mx; apply/row_subP => j; rewrite -addsmxE.
have [->|j_end] := eqVneq j ord_max.
  have -> : row ord_max 1%:M = sysF shown by rewrite rowE mulmx1 [RHS]scale1r.
  exact: addsmxSr.
have jn : (j.+1 < n.+1)%N by rewrite ltn_neqAle ltn_ord andbT -(inj_eq val_inj) in j_end *.
apply: submx_trans (addsmxSl _ _); apply: eq_row_sub (Ordinal jn) _.
by apply/rowP => i; rewrite !mxE -(inj_eq val_inj) /= eqSS.
Qed.

Lemma outputs_of_shown : \rank (sysC shown) = 1%N.
Proof. exact: mxrank_delta. Qed.

Theorem shown_delay : inverts_from_any_state shown n.+1 /\ ~ inverts_from_any_state shown n.
Proof.
split=> [x v zero | /(_ 0 (fun k => (k == 0%N)%:R%:M)) early].
  apply/rowP => i; rewrite ord1 mxE; have := output_shown x v n.+1.
  by rewrite (zero _ (leqnn _)) ltnn subnn mxE.
have /rowP/(_ 0) : ((0%N == 0%N)%:R%:M : 'rV[K]_1) = 0.
  by apply: early => k kn; apply/rowP => i; rewrite ord1 output_shown kn !mxE.
by rewrite !mxE eqxx => /eqP; rewrite oner_eq0.
Qed.

End Register.

Theorem delay_bounds_attained (K : fieldType) n : exists S : system K n.+1 1 1,
  [/\ \rank (col_mx (sysA S) (sysF S)) = n.+1, (1 + n.+1 - \rank (sysC S))%N = n.+1, inverts_from_any_state S n.+1
    & ~ inverts_from_any_state S n].
Proof.
exists (shown K n); have [inverted missed] := shown_delay K n.
by split=> //; [apply: range_of_shown | rewrite outputs_of_shown addKn].
Qed.
