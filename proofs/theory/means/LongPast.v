(** All of the range of O_s where (A, B) is controllable, an input of rational spectrum of any order r, with n + r past inputs.
    A direction w of the state that the limit does not see makes zeta, which is z w less a combination of the s future inputs,
    uncorrelated with the q past inputs and the future ones; z is what the inputs make of the state. The covariances of zeta with inputs
    satisfy a difference equation of order n + r, so it is uncorrelated with all past inputs, hence with z and with itself: zeta is zero
    in mean square. The characteristic polynomial of A then leaves a relation among n + s successive inputs, which are independent. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  matrix zify.
From faultspace Require Import Vocabulary Places Consistency Reachable WholeRange.
From faultspace Require Import MeansVocabulary Means Forgetting.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma uncorrelated_at (K : fieldType) (E : (nat -> K) -> K -> Prop) a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) i k :
  mean E -> uncorrelated E x y -> covariance E (later i x) (later k y) 0.
Proof.
move=> isE xy; have [ik|ki] := leqP i k.
  have [/(covariance_later isE i) e _] := xy (k - i)%N; apply: (covariance_ext isE) e => t //.
  by rewrite /later -addnA subnKC.
have [_ /(covariance_later isE k) e] := xy (i - k)%N; apply: (covariance_ext isE) e => t //.
by rewrite /later -addnA subnKC // ltnW.
Qed.

Lemma covariance_zero_sum (K : fieldType) (E : (nat -> K) -> K -> Prop) a b (x : nat -> 'rV[K]_a) k (c : nat -> K) (f : nat -> nat ->
  'rV[K]_b) :
  mean E -> (forall i, (i < k)%N -> covariance E x (f i) 0) -> covariance E x (fun t => \sum_(i < k) c i *: f i t) 0.
Proof.
move=> isE; elim: k => [|k IH] h.
  by move=> i j; rewrite mxE; apply: (mean_ext isE) (mean_zero isE) => t; rewrite big_ord0 [X in _ * X]mxE mulr0.
have := covariance_add isE (IH (fun i ik => h i (ltnW ik))) (covariance_mul isE (c k)%:M (h k (leqnn _))).
by rewrite mul0mx addr0; apply: (covariance_ext isE) => // t; rewrite big_ord_recr /= mul_mx_scalar.
Qed.

Lemma unseen_powers (K : fieldType) a n (A : 'M[K]_n) (C : 'M_(a, n)) (w : 'cV_n) :
  (forall k, (k < n)%N -> iter k (mulmxr A) C *m w = 0) -> forall k, iter k (mulmxr A) C *m w = 0.
Proof.
move=> h; have rows i k : row i (iter k (mulmxr A) C) = iter k (mulmxr A) (row i C) by elim: k => //= k <-; rewrite row_mul.
have [c rel] := monic_relation A; elim/ltn_ind => k IH; have [|nk] := ltnP k n; first exact: h.
apply/row_matrixP=> i; rewrite row_mul rows row0 -(subnKC nk) iterD rel mulmx_suml big1 // => j _.
have jk : (j + (k - n) < k)%N by have := ltn_ord j; lia.
by have := congr1 (row i) (IH _ jk); rewrite row_mul rows row0 iterD -scalemxAl => ->; rewrite scaler0.
Qed.

Lemma iter_step (K : fieldType) n nu (A : 'M[K]_n) (B : 'M_(nu, n)) (z : 'rV_n) (u : 'rV_nu) k :
  iter k (mulmxr A) (z *m A + u *m B) = iter k.+1 (mulmxr A) z + u *m iter k (mulmxr A) B.
Proof. by elim: k => //= k ->; rewrite mulmxDl mulmxA. Qed.

Section Inputs.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n nu N : nat) (A : 'M[K]_n) (B : 'M[K]_(nu, n)).
Variables (h : nat -> 'rV[K]_N) (u : nat -> 'rV[K]_nu) (z : nat -> 'rV[K]_n).
Hypotheses (isE : mean E) (pos : positive E) (quasi : quasi_stationary E h) (cu : combination h u) (cz : combination h z).
Hypothesis driven : forall t, z t.+1 = z t *m A + u t *m B.
Variables (w : 'cV[K]_n) (d : nat -> 'cV[K]_nu) (s : nat).
Let zeta t : 'rV_1 := z t *m w + \sum_(i < s) u (t + i)%N *m d i.

Lemma combination_zeta : combination h zeta.
Proof.
apply: combination_add; first exact: combination_mul.
by apply: (combination_sum _ (f := fun i t => u (t + i)%N *m d i)) => i; apply: combination_mul; apply: (combination_later i cu).
Qed.
Let cl k := combination_later k combination_zeta.

(** Zero in mean square. *)
Section Null.
Variables (q r : nat).
Hypotheses (st : stable A) (spectrum : order_of_spectrum E r u) (long : (n + r <= q)%N).
Hypothesis seen : forall i, (i < q + s)%N -> covariance E (later i u) (later q zeta) 0.

Lemma zeta_near j : (j < q)%N -> covariance E u (later j.+1 zeta) 0.
Proof.
move=> jq; apply: (covariance_earlier isE quasi (k := (q - j.+1)%N) cu (cl _)); have iq : (q - j.+1 < q + s)%N by lia.
by apply: (covariance_ext isE) (seen iq) => // t; rewrite /later -addnA subnK.
Qed.

Lemma zeta_future i : (i < s)%N -> covariance E (later i u) zeta 0.
Proof.
move=> iq; apply: (covariance_earlier isE quasi (k := q) (combination_later i cu) combination_zeta).
have qi : (q + i < q + s)%N by rewrite ltn_add2l.
by apply: (covariance_ext isE) (seen qi) => // t; rewrite /later -addnA.
Qed.

Lemma zeta_past j : covariance E u (later j.+1 zeta) 0.
Proof.
have [a [/monicP lead size_a] rec] := spectrum; have ar : a`_r = 1 by rewrite -lead /lead_coef size_a.
pose f b (g : nat -> 'rV[K]_b) t := \sum_(i < r.+1) a`_i *: g (t + i)%N.
have cf b (g : nat -> 'rV_b) : combination h g -> combination h (f b g).
  move=> cg; apply: (combination_sum _ (f := fun i t => a`_i *: g (t + i)%N)) => i.
  by apply: combination_ext (combination_mul (a`_i)%:M (combination_later i cg)) => t; rewrite mul_mx_scalar.
have step t : f n z t.+1 = f n z t *m A + f nu u t *m B.
  rewrite /f !mulmx_suml -big_split; apply: eq_bigr => i _ /=.
  by rewrite addSn driven scalerDr -!scalemxAl.
have fzeta t : f _ zeta t = f n z t *m w + \sum_(j < s) f nu u (t + j)%N *m d j.
  rewrite /f; under [X in _ = _ + X]eq_bigr => i _ do rewrite mulmx_suml.
  rewrite [X in _ = _ + X]exchange_big mulmx_suml -big_split; apply: eq_bigr => i _ /=; rewrite /zeta scalerDr -scalemxAl scaler_sumr;
    congr (_ + _).
  by apply: eq_bigr => l _; rewrite -scalemxAl addnAC.
have zero l : covariance E u (later l.+1 (f nu u)) 0.
  by apply: (covariance_ext isE) (rec l) => // t; rewrite /later /f; apply: eq_bigr => i _; rewrite addnA.
have [C hC] := combination_covariance isE quasi cu (combination_later 1 (cf _ _ cz)).
have powers k : covariance E u (later k.+1 (f n z)) (iter k (mulmxr A) C).
  have step1 t : later 1 (f n z) t.+1 = later 1 (f n z) t *m A + later 1 (f nu u) t *m B by rewrite /later addSn step.
  have zero1 l : (l < k)%N -> covariance E u (later l (later 1 (f nu u))) 0.
    by move=> _; apply: (covariance_ext isE) (zero l) => // t; rewrite /later -addnA addn1.
  by apply: (covariance_ext isE) (free_response isE step1 zero1 hC) => // t; rewrite /later -addnA addn1.
have of_zeta k : covariance E u (later k.+1 (f 1%N zeta)) (iter k (mulmxr A) C *m w).
  have e : covariance E u (fun t => \sum_(j < s) later (k.+1 + j) (f nu u) t *m d j) 0.
    have each l : (l < s)%N -> covariance E u (fun t => later (k + l).+1 (f nu u) t *m d l) 0.
      by move=> _; rewrite -(mul0mx _ (d l)); apply: covariance_mul.
    apply: (covariance_ext isE) (covariance_zero_sum (f := fun j t => later (k + j).+1 (f nu u) t *m d j) (fun=> 1) isE each) => // t.
    by apply: eq_bigr => l _; rewrite scale1r.
  have := covariance_add isE (covariance_mul isE w (powers k)) e; rewrite addr0; apply: (covariance_ext isE) => // t.
  by rewrite /later fzeta; congr (_ + _); apply: eq_bigr => l _; congr (f nu u _ *m _); lia.
have unseen k : iter k (mulmxr A) C *m w = 0.
  apply: unseen_powers => {}k kn; apply: (covariance_unique isE (of_zeta k)).
  have each i : (i < r.+1)%N -> covariance E u (later (k + i).+1 zeta) 0 by move=> ir; apply: zeta_near; lia.
  apply: (covariance_ext isE) (covariance_zero_sum (f := fun i => later (k + i).+1 zeta) (fun i => a`_i) isE each) => // t.
  by rewrite /later /f; apply: eq_bigr => i _; congr (_ *: zeta _); lia.
elim/ltn_ind: j => j IH; have [/zeta_near //|qj] := ltnP j q; pose k := (j - r)%N.
have [R hR] := combination_covariance isE quasi cu (cl j.+1).
have each i : (i < r)%N -> covariance E u (later (k + i).+1 zeta) 0 by move=> ir; apply: IH; rewrite /k; lia.
have := covariance_add isE (covariance_zero_sum (f := fun i => later (k + i).+1 zeta) (fun i => a`_i) isE each) hR; rewrite add0r => e.
suff -> : 0 = R by [].
apply: (covariance_unique isE (x := u) (y := later k.+1 (f 1%N zeta))); first by have := of_zeta k; rewrite unseen.
apply: (covariance_ext isE) e => // t; rewrite /later /f big_ord_recr /= ar scale1r; congr (_ + zeta _); last by rewrite /k; lia.
by apply: eq_bigr => i _; congr (_ *: zeta _); lia.
Qed.

Lemma zeta_null : covariance E zeta zeta 0.
Proof.
have [R hR] := combination_covariance isE quasi combination_zeta cz.
have R0 : R = 0.
  have [Rz zz] := combination_covariance isE quasi cz cz; have [Rt tt] :=
    combination_covariance isE quasi combination_zeta combination_zeta.
  apply: (forgotten st (bound := \tr Rt + \tr Rz)) => k.
  have [C hC] := combination_covariance isE quasi (cl k) cz; exists C; last first.
    move=> i j; apply: (covariance_bound isE pos (k := k) (l := 0) i j tt zz).
    by apply: (covariance_ext isE) hC => // t; rewrite /later addn0.
  have zero j : (j < k)%N -> covariance E (later k zeta) (later j u) 0.
    move=> jk; have := covariance_transpose isE (covariance_later isE j (zeta_past (k - j.+1))); rewrite trmx0.
    by apply: (covariance_ext isE) => // t; rewrite /later -addnA; congr zeta; lia.
  exact: (covariance_unique isE (covariance_later isE k hR) (free_response isE driven zero hC)).
rewrite {}R0 in hR; have e : covariance E zeta (fun t => \sum_(i < s) u (t + i)%N *m d i) 0.
  have each i : (i < s)%N -> covariance E zeta (fun t => later i u t *m d i) 0.
    by move=> js; rewrite -(mul0mx _ (d i)) -trmx0; apply: covariance_mul => //; apply: covariance_transpose => //; apply: zeta_future.
  apply: (covariance_ext isE) (covariance_zero_sum (f := fun i t => later i u t *m d i) (fun=> 1) isE each) => // t.
  by apply: eq_bigr => i _; rewrite scale1r.
by have := covariance_add isE (covariance_mul isE w hR) e; rewrite mul0mx addr0.
Qed.

End Null.

(** Then the inputs, n + s of them independent, do not reach w. *)
Section Independent.
Hypotheses (null : covariance E zeta zeta 0) (exciting : excites E (n + s) u) (after : forall i, (s <= i)%N -> d i = 0).

Let G k : 'cV[K]_nu := if (k < n)%N then iter (n.-1 - k) (mulmxr A) B *m w else d (k - n)%N.

Lemma zeta_shifted k t : (k <= n)%N -> zeta (t + k)%N = iter k (mulmxr A) (z t) *m w + \sum_(i < n + s) u (t + i)%N *m G (i + n - k)%N.
Proof.
elim: k t => [|k IH] t kn.
  rewrite addn0 /zeta; congr (_ + _); rewrite [(n + s)%N]addnC big_split_ord /= [X in _ = _ + X]big1 ?addr0 => [|i _]; last first.
    by rewrite /G ltnNge subn0 leq_addl /= addnK after ?mulmx0 // leq_addr.
  by apply: eq_bigr => i _; rewrite /G subn0 ltnNge leq_addl /= addnK.
rewrite -addSnnS IH 1?ltnW // driven iter_step mulmxDl -addrA; congr (_ + _).
have -> : u t *m iter k (mulmxr A) B *m w = u (t + 0)%N *m G (0 + n - k.+1)%N.
  by rewrite addn0 /G add0n (_ : n - k.+1 < n)%N ?mulmxA; [congr (_ *m iter _ _ _ *m _)|]; lia.
have -> : \sum_(i < n + s) u (t.+1 + i)%N *m G (i + n - k)%N = \sum_(i < n + s) u (t + i.+1)%N *m G (i.+1 + n - k.+1)%N.
  by apply: eq_bigr => i _; rewrite addSnnS addSn subSS.
rewrite -(big_ord_recl (n + s) (fun i : 'I_(n + s).+1 => u (t + i)%N *m G (i + n - k.+1)%N)) big_ord_recr /=.
rewrite [G (n + s + n - _)%N]/G ltnNge (_ : n <= _)%N /= ?after ?mulmx0 ?addr0 //; lia.
Qed.

Theorem zeta_unreached : (forall l, (l < n)%N -> iter l (mulmxr A) B *m w = 0) /\ forall i, d i = 0.
Proof.
have [c rel] := monic_relation A; pose delta i := G i - \sum_(k < n) c k *: G (i + n - k)%N.
pose theta t := zeta (t + n)%N - \sum_(k < n) c k *: zeta (t + k)%N.
have theta_inputs t : theta t = \sum_(i < n + s) u (t + i)%N *m delta i.
  rewrite /theta (zeta_shifted _ (leqnn n)).
  have -> : \sum_(k < n) c k *: zeta (t + k)%N = \sum_(k < n) c k *: (iter k (mulmxr A) (z t) *m w) +
      \sum_(i < n + s) u (t + i)%N *m \sum_(k < n) c k *: G (i + n - k)%N.
    under [X in _ = _ + X]eq_bigr => i _ do rewrite mulmx_sumr.
    rewrite exchange_big -big_split; apply: eq_bigr => k _ /=; rewrite (zeta_shifted _ (ltnW (ltn_ord k))) scalerDr scaler_sumr;
      congr (_ + _).
    by apply: eq_bigr => i _; rewrite -scalemxAr.
  rewrite rel mulmx_suml; under [X in X + _ - _]eq_bigr => k _ do rewrite -scalemxAl.
  rewrite opprD addrACA subrr add0r -sumrB; apply: eq_bigr => i _.
  by rewrite -mulmxBr addnK.
have [R uu unit] := exciting; pose X := \sum_(i < n + s) (place K nu i)^T *m delta i.
have theta_X t : successive 0 (n + s) u t *m X = theta t.
  rewrite theta_inputs mulmx_sumr; apply: eq_bigr => i _; rewrite mulmxA /successive addn0; congr (_ *m _).
  by rewrite -sample_of_future.
have combination_window : combination h (successive 0 (n + s) u).
  have c' := combination_sum (n + s) (f := fun i t => later i u t *m (if insub i is Some i then place K nu (i : 'I_(n + s)) else 0))
    (fun i => combination_mul _ (combination_later i cu)).
  apply: combination_ext c' => t; rewrite /successive addn0 future_sum; apply: eq_bigr => i _; by rewrite valK.
have null_window k : covariance E (successive 0 (n + s) u) (later k zeta) 0.
  have [R' hR] := combination_covariance isE quasi combination_window (cl k).
  by rewrite -(null_covariance isE pos uu (covariance_later isE k null) hR).
have window_theta : covariance E (successive 0 (n + s) u) theta 0.
  have := covariance_zero_sum (fun k => - c k) isE (fun k _ => null_window k); move=> /(_ n)/(covariance_add isE (null_window n)).
  rewrite addr0; apply: (covariance_ext isE) => // t; rewrite /theta -sumrN; congr (_ + _); apply: eq_bigr => k _.
  by rewrite scaleNr.
have X0 : X = 0.
  have e : R *m X = 0.
    by apply: (covariance_unique isE (covariance_mul isE X uu)); apply: (covariance_ext isE) window_theta => // t; rewrite theta_X.
  by rewrite -(mulKmx unit X) e mulmx0.
have delta0 i : (i < n + s)%N -> delta i = 0.
  move=> iH; have := congr1 (mulmx (place K nu (Ordinal iH))) X0; rewrite mulmx0 mulmx_sumr (bigD1 (Ordinal iH)) //= big1 => [|j].
    by rewrite addr0 mulmxA place_orthonormal eqxx mul1mx.
  by rewrite -val_eqE eq_sym mulmxA place_orthonormal => /negbTE ->; rewrite mul0mx.
have G0 e : forall i, (n + s <= i + e)%N -> G i = 0.
  elim: e => [|e IH] i ie.
    by rewrite /G ltnNge (_ : n <= i)%N ?after //; lia.
  have [iH|] := ltnP i (n + s); last by move=> ni; apply: IH; lia.
  have /eqP := delta0 i iH; rewrite subr_eq0 => /eqP->; rewrite big1 // => k _.
  by rewrite IH ?scaler0 //; have := ltn_ord k; lia.
have {}G0 i : G i = 0 by apply: (G0 (n + s)%N); lia.
split=> [l ln|i].
  by have := G0 (n.-1 - l)%N; rewrite /G (_ : n.-1 - l < n)%N ?subKn //; lia.
by have := G0 (n + i)%N; rewrite /G ltnNge leq_addr /= addKn.
Qed.

End Independent.
End Inputs.
