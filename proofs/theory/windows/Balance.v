(** Where the dimensions go in one silent step. Of all pairs (x, v) with x in W_k, those with zero output are mapped onto W_(k+1); what is
    mapped to zero is counted by null k. So rank W_k + m = gap k + rank W_(k+1) + null k, and m = gap n + null n at the end of the chain.

           pairs S k == the pairs (x, v) with x in W_k
    silent_pairs S k == those with zero output
      null_pairs S k == those that also lead to the state 0
            null S k == their dimension *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix mxalgebra.
From faultspace Require Import Vocabulary Chain Gap.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Balance.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (w : 'rV[K]_m) (k : nat).

Definition pairs k : 'M[K]_(n + m) := block_mx (silent S k) 0 0 1%:M.
Definition silent_pairs k : 'M[K]_(n + m) := (pairs k :&: kermx (col_mx (sysC S) (sysG S)))%MS.
Definition null_pairs k : 'M[K]_(n + m) := (silent_pairs k :&: kermx (col_mx (sysA S) (sysF S)))%MS.
Definition null k := \rank (null_pairs k).

Lemma pairsP k x w : (row_mx x w <= pairs k)%MS = (x <= silent S k)%MS.
Proof.
apply/submxP/submxP=> [[c]|[c ->]].
  rewrite -(hsubmxK c) mul_row_block !mulmx0 mulmx1 addr0 => /eq_row_mx[-> _]; by exists (lsubmx c).
by exists (row_mx c w); rewrite mul_row_block !mulmx0 mulmx1 addr0 add0r.
Qed.

Lemma silent_pairsP k x w : (row_mx x w <= silent_pairs k)%MS <-> (x <= silent S k)%MS /\ x *m sysC S + w *m sysG S = 0.
Proof.
rewrite sub_capmx pairsP; split=> [/andP[-> /sub_kermxP]|[-> e]]; first by rewrite mul_row_col.
by apply/sub_kermxP; rewrite mul_row_col.
Qed.

Lemma null_pairsP k x w : (row_mx x w <= null_pairs k)%MS <->
  [/\ (x <= silent S k)%MS, x *m sysC S + w *m sysG S = 0 & x *m sysA S + w *m sysF S = 0].
Proof.
rewrite sub_capmx; split=> [/andP[/silent_pairsP[h e] /sub_kermxP]|[h e f]]; first by rewrite mul_row_col; split.
by apply/andP; split; [apply/silent_pairsP|apply/sub_kermxP; rewrite mul_row_col].
Qed.

Theorem rank_balance k : (\rank (silent S k) + m = gap S k + \rank (silent S k.+1) + null k)%N.
Proof.
have -> : (\rank (silent S k) + m)%N = \rank (pairs k) by rewrite rank_diag_block_mx mxrank1.
rewrite -(mxrank_mul_ker (pairs k) (col_mx (sysC S) (sysG S))) -/(silent_pairs k).
rewrite -(mxrank_mul_ker (silent_pairs k) (col_mx (sysA S) (sysF S))) -/(null_pairs k) -/(null k) addnA.
congr (_ + _ + _)%N; first by rewrite mul_block_col !mul0mx mul1mx addr0 add0r.
apply: eqmx_rank; apply/andP; split; apply/row_subP=> i.
  have := row_sub i (silent_pairs k); rewrite row_mul -(hsubmxK (row i _)) mul_row_col => /silent_pairsP[h e].
  by apply/silent_stepP; exists (lsubmx (row i (silent_pairs k))), (rsubmx (row i (silent_pairs k))).
have /silent_stepP[x [w [h e <-]]] := row_sub i (silent S k.+1).
by rewrite -mul_row_col; apply/submxMr/silent_pairsP.
Qed.

Lemma null_decreasing j k : (j <= k)%N -> (null k <= null j)%N.
Proof.
move=> jk; apply/mxrankS/row_subP=> i.
have := row_sub i (null_pairs k); rewrite -(hsubmxK (row i _)) => /null_pairsP[h e f].
by apply/null_pairsP; split=> //; apply: submx_trans h (silent_decreasing S jk).
Qed.

Lemma rank_silent_constant k : (n <= k)%N -> \rank (silent S k) = \rank (silent S n).
Proof. by move=> nk; apply: eqmx_rank; rewrite silent_constant // silent_decreasing. Qed.

Theorem faults_balance k : (n <= k)%N -> (m = gap S k + null k)%N.
Proof.
move=> nk; apply: (@addnI (\rank (silent S k))); rewrite {1}rank_balance.
by rewrite (rank_silent_constant (leqW nk)) (rank_silent_constant nk) -addnA addnCA.
Qed.

Lemma null_constant k : (n <= k)%N -> null k = null n.
Proof. by move=> nk; apply: (@addnI (gap S n)); rewrite -(faults_balance (leqnn n)) -{1}(gap_constant S nk) -faults_balance. Qed.

(** Without any hypothesis: m - gap. *)
Theorem gap_le_faults k : (n <= k)%N -> (gap S k <= m)%N.
Proof. by move=> nk; rewrite [X in (_ <= X)%N](faults_balance nk) leq_addr. Qed.

Theorem null0P k : null k = 0%N <->
  (forall x w, (x <= silent S k)%MS -> x *m sysC S + w *m sysG S = 0 -> x *m sysA S + w *m sysF S = 0 -> x = 0 /\ w = 0).
Proof.
split=> [/eqP|h].
  rewrite mxrank_eq0 => /eqP null0 x w hx e f.
  have : (row_mx x w <= null_pairs k)%MS by apply/null_pairsP.
  by rewrite null0 submx0 => /eqP; rewrite -[0]row_mx0 => /eq_row_mx.
apply/eqP; rewrite mxrank_eq0; apply/eqP/row_matrixP=> i; rewrite row0.
have := row_sub i (null_pairs k); rewrite -(hsubmxK (row i _)) => /null_pairsP[hx e f].
by have [-> ->] := h _ _ hx e f; rewrite row_mx0.
Qed.

End Balance.
