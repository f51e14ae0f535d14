(** The lag and the left indices, read off the gap: as a window gets longer the gap falls from p (before the first sample) to its last value
    gap n, and each time it falls by one there is an index eta equal to the length reached. That is, here the etas are defined by ranks.
    L1: the rank of every window is s * gap n + sum of min (s, eta), for every system; the lag is the largest eta, and sum eta <= n. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg mxalgebra zify.
From faultspace Require Import Vocabulary Gap Balance.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Lag.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (s t e : nat).

Theorem lagP s : gap S s = gap S n <-> (lag S <= s)%N.
Proof.
rewrite /lag; case: ex_minnP => l /eqP settled least; split=> [e|ls]; first by apply: least; apply/eqP.
have [sn|ns] := leqP s n; last by rewrite gap_constant // ltnW.
by apply/eqP; rewrite eqn_leq [X in _ && X](gap_decreasing S sn) -settled gap_decreasing.
Qed.

Lemma gap_lag : gap S (lag S) = gap S n. Proof. exact/lagP. Qed.
Lemma lag_le_n : (lag S <= n)%N. Proof. exact/lagP. Qed.

Lemma gap_from_lag s : (lag S <= s)%N -> gap S s = gap S (lag S).
Proof. by move=> /lagP->; rewrite gap_lag. Qed.

Lemma gap_at_least_last s : (gap S n <= gap S s)%N.
Proof. by have [sn|ns] := leqP s n; [apply: gap_decreasing|rewrite (gap_constant S (ltnW ns))]. Qed.

(** How many indices exceed s: counted in the first N lengths. *)
Lemma count_drops N s :
  count (fun e => s < e)%N (flatten [seq nseq (gap_drop S t) t | t <- iota 0 N.+1]) = (gap S s - gap S (maxn s N))%N.
Proof.
elim: N => [|N IH]; first by rewrite /= cats0 count_nseq ltn0 mul0n maxn0 subnn.
rewrite -(addn1 N.+1) iotaD map_cat flatten_cat count_cat IH /= cats0 count_nseq add0n.
have [sN|Ns] := leqP s N.
  rewrite (maxn_idPr (leqW sN)) ltnS sN mul1n.
  by rewrite addnBA ?subnK ?gap_decreasing.
by rewrite (maxn_idPl Ns) ltnS leqNgt Ns mul0n addn0.
Qed.

(** The gap counts the indices that exceed s. *)
Theorem gap_etas s : gap S s = (gap S n + count (fun e => s < e)%N (etas S))%N.
Proof.
rewrite count_drops; have -> : gap S (maxn s n) = gap S n.
  by rewrite gap_constant // leq_maxr.
by rewrite subnKC // gap_at_least_last.
Qed.

Theorem size_etas : size (etas S) = (p - gap S n)%N.
Proof.
have /= e0 := count_drops n 0; rewrite max0n in e0.
rewrite -(count_predC (fun e => 0 < e)%N) [in LHS]e0.
have -> : count (predC (fun e => 0 < e)%N) (etas S) = (p - gap S 0)%N.
  rewrite /etas [iota _ _]/= [flatten _]/= count_cat count_nseq /= mul1n -[RHS]addn0; congr (_ + _)%N.
  apply/eqP; rewrite -leqn0 leqNgt -has_count; apply/hasPn=> e /flatten_mapP[t].
  by rewrite mem_iota => /andP[t1 _] /nseqP[-> _] /=; rewrite t1.
by rewrite addnC addnBA ?gap_decreasing // subnK // gap_le_outputs.
Qed.

Theorem lag_is_largest_eta : lag S = \max_(e <- etas S) e.
Proof.
suff bound s : (lag S <= s)%N = (\max_(e <- etas S) e <= s)%N.
  by apply/eqP; rewrite eqn_leq bound leqnn -bound leqnn.
have -> : (lag S <= s)%N = ~~ has (fun e => s < e)%N (etas S).
  rewrite has_count -leqNgt leqn0; apply/idP/eqP=> [/lagP e|e]; last by apply/lagP; rewrite gap_etas e addn0.
  by apply: (@addnI (gap S n)); rewrite -gap_etas e addn0.
apply/hasPn/bigmax_leqP_seq=> [h e he _|h e he]; first by rewrite leqNgt h.
by rewrite -leqNgt h.
Qed.

(** L1. *)
Theorem rank_window_etas s : \rank (window S s) = (s * gap S n + \sum_(e <- etas S) minn s e)%N.
Proof.
rewrite rank_window; elim: s => [|s IH].
  by rewrite big_ord0 mul0n big1 // => e _; rewrite min0n.
rewrite big_ord_recr /= IH [gap S s]gap_etas addnACA [(_ + gap S n)%N]addnC -mulSn; congr (_ + _)%N.
rewrite -sum1_count [X in (_ + X)%N = _]big_mkcond -big_split; apply: eq_bigr => e _ /=.
by case: leqP => [es|se]; [rewrite addn0 !(minn_idPr _) // leqW|rewrite addn1 !(minn_idPl _) // ltnW].
Qed.

Lemma sum_min_etas s : (\sum_(e <- etas S) minn s e == sumn (etas S)) = (lag S <= s)%N.
Proof.
rewrite lag_is_largest_eta sumnE; elim: (etas S) => [|e t IH]; first by rewrite !big_nil.
rewrite !big_cons geq_max -IH; have mt : (\sum_(i <- t) minn s i <= \sum_(i <- t) i)%N by apply: leq_sum => i _; apply: geq_minr.
apply/eqP/andP=> [eq|[/minn_idPr-> /eqP->] //].
have := geq_minr s e; rewrite leq_eqVlt => /orP[/eqP me|me].
  by split; [apply/minn_idPr|apply/eqP/(@addnI e); rewrite -{1}me].
by move: (leq_add me mt); rewrite addSn eq ltnn.
Qed.

(** What remains of n: by the balance of each silent step. *)
Lemma rank_window_bound s : (\rank (window S s) + \rank (silent S s) <= s * gap S n + n)%N.
Proof.
rewrite rank_window; elim: s => [|s IH]; first by rewrite big_ord0 mxrank1.
have step : (gap S s + \rank (silent S s.+1) <= \rank (silent S s) + gap S n)%N.
  have [ns|/ltnW sn] := leqP n s; first by rewrite (gap_constant S ns) addnC leq_add2r !rank_silent_constant // leqW.
  have := faults_balance S (leqnn n); have := null_decreasing S sn; have := rank_balance S s; lia.
move: step; move: (\rank (silent S s.+1)) => w step; rewrite big_ord_recr /= mulSn -addnA.
by apply: leq_trans (leq_add (leqnn _) step) _; rewrite addnA addnC -addnA leq_add2l.
Qed.

Theorem sum_etas_le_n : (sumn (etas S) <= n)%N.
Proof.
have := rank_window_bound n; rewrite rank_window_etas -addnA leq_add2l; apply: leq_trans.
have /eqP-> : \sum_(e <- etas S) minn n e == sumn (etas S) by rewrite sum_min_etas lag_le_n.
exact: leq_addr.
Qed.

(** theorem-2 for every system: exact from the lag on, and never before. *)
Theorem rank_window_zeta s : (\rank (window S s) + zeta S = n + s * gap S n)%N <-> (lag S <= s)%N.
Proof.
rewrite -sum_min_etas rank_window_etas /zeta; split=> [e|/eqP->]; last by rewrite -addnA subnKC ?sum_etas_le_n // addnC.
apply/eqP/(@addIn (n - sumn (etas S))); rewrite subnKC ?sum_etas_le_n //.
by apply: (@addnI (s * gap S n)); rewrite addnA e addnC.
Qed.

End Lag.
