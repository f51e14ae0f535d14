(** Past outputs among the instruments, and faults that are uncorrelated with the inputs but coloured. Where all states are measured, the
    limit, with a past sample and two future ones or more, leaves the range of O_s as soon as F shows a fault that is correlated with
    itself two samples later and not from three samples on, G = 0 and A being stable: the fault is seen in past outputs, and acts in the
    future ones as no state does. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary Places Consistency WholeRange MeansVocabulary Means LongPast PastStates.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Measured.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (n m nu : nat) (S : system K n m n) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, n)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x y : nat -> 'rV[K]_n).
Hypotheses (isE : mean E) (model : process S B D u v x y).
Hypotheses (uv : uncorrelated E u v) (all_states : sysC S = 1%:M) (no_feedthrough : sysG S = 0).

(** y(1) - y(0) A, which no state changes. *)
Let c s : 'M[K]_(s.+2 * n, n) := (place K n (1 : 'I_s.+2))^T - (place K n (0 : 'I_s.+2))^T *m sysA S.

Lemma no_state s : O S s.+2 *m c s = 0.
Proof.
have at_place (k : 'I_s.+2) i : row i (O S s.+2) *m (place K n k)^T = output S (row i 1%:M) (fun=> 0) k.
  by rewrite mul_place_transposed rowK mxvecK rowK.
apply/row_matrixP=> i; rewrite row0 row_mul mulmxBr mulmxA !at_place /output /= all_states !mulmx1 !mul0mx !addr0.
by rewrite subrr.
Qed.

Lemma future_step q s t : successive q s.+2 y t *m c s =
  successive q s.+2 u t *m ((place K nu (0 : 'I_s.+2))^T *m (B - D *m sysA S) + (place K nu (1 : 'I_s.+2))^T *m D) + v (t + q)%N *m sysF S.
Proof.
have sample a (f : nat -> 'rV[K]_a) (i : 'I_s.+2) : successive q s.+2 f t *m (place K a i)^T = f (t + q + i)%N :=
  esym (sample_of_future _ _ _).
rewrite mulmxBr mulmxDr !mulmxA !sample /= addn0 addn1.
have [_ ->] := model (t + q).+1; have [_ ->] := model (t + q)%N; have [-> _] := model (t + q)%N.
rewrite all_states no_feedthrough !mulmx0 !mulmx1 !addr0 mulmxDl mulmxBr !mulmxA.
set a := x _ *m _; set b := u _ *m B; set f := v _ *m _; set g := _ *m D; set e := _ *m D *m _.
have -> : a + b + f + g = a + (b + f + g) by rewrite !addrA.
by rewrite opprD addrACA subrr add0r [b + f + g]addrAC [b + g + f - e]addrAC [b + g - e]addrAC.
Qed.

Theorem seen_fault q s R L : limit E (fun t => row_mx (successive 0 q.+1 u t) (successive 0 q.+1 y t)) (successive q.+1 s.+2 u)
  (successive q.+1 s.+2 y) L -> (L <= O S s.+2)%MS -> covariance E x (later 1 v) R -> R *m sysF S = 0.
Proof.
move=> [Rzu [Ruu [Rzy [Ruy [X [zu uu zy uy [hX ->]]]]]]] /submxP[M eL] xv.
have Lc : (Rzy - X *m Ruy) *m c s = 0 by rewrite eL -mulmxA no_state mulmx0.
set e := (place K nu (0 : 'I_s.+2))^T *m (B - D *m sysA S) + (place K nu (1 : 'I_s.+2))^T *m D.
have ufv : covariance E (successive q.+1 s.+2 u) (fun t => later q.+1 v t *m sysF S) 0.
  pose P i : 'M[K]_(nu, s.+2 * nu) := if insub i is Some j then place K nu (j : 'I_s.+2) else 0.
  have each i : (i < s.+2)%N -> covariance E (later q.+1 v) (fun t => later (q.+1 + i) u t *m P i) 0.
    move=> _; have := covariance_mul isE (P i) (covariance_transpose isE (uncorrelated_at (q.+1 + i) q.+1 isE uv)).
    by rewrite trmx0 mul0mx.
  have := covariance_transpose isE (covariance_zero_sum (f := fun i t => later (q.+1 + i) u t *m P i) (fun=> 1) isE each).
  move/(covariance_mul isE (sysF S)); rewrite trmx0 mul0mx; apply: (covariance_ext isE) => // t.
  by rewrite /successive future_sum; apply: eq_bigr => i _; rewrite scale1r /P valK /later -addnA.
have uyc := covariance_mul isE (c s) uy; have zyc := covariance_mul isE (c s) zy.
have eu : Ruy *m c s = Ruu *m e.
  apply: (covariance_unique isE uyc); have := covariance_add isE (covariance_mul isE e uu) ufv; rewrite addr0.
  by apply: (covariance_ext isE) => // t; rewrite future_step.
have [Rzv zv] : exists Rzv, covariance E (fun t => row_mx (successive 0 q.+1 u t) (successive 0 q.+1 y t))
    (fun t => later q.+1 v t *m sysF S) Rzv.
  exists (Rzy *m c s - Rzu *m e).
  have := covariance_add isE zyc (covariance_mul isE (- e) zu); rewrite mulmxN.
  by apply: (covariance_ext isE) => // t; rewrite future_step mulmxN addrAC subrr add0r.
have ez : Rzy *m c s = Rzu *m e + Rzv.
  apply: (covariance_unique isE zyc); have := covariance_add isE (covariance_mul isE e zu) zv.
  by apply: (covariance_ext isE) => // t; rewrite future_step.
have {ez eu}zv0 : Rzv = 0.
  have := Lc; rewrite mulmxBl -mulmxA eu ez mulmxA hX addrAC subrr add0r //.
rewrite zv0 in zv.
have yv : covariance E (later q y) (fun t => later q.+1 v t *m sysF S) 0.
  have := covariance_mul_left isE (col_mx 0 (place K n (ord_max : 'I_q.+1))^T) zv; rewrite mulmx0; apply: (covariance_ext isE) => // t.
  rewrite mul_row_col mulmx0 add0r /successive -sample_of_future /later /=; congr y; lia.
have uvq : covariance E (later q u) (fun t => later q.+1 v t *m sysF S) 0.
  by rewrite -(mul0mx _ (sysF S)); apply: (covariance_mul isE); apply: uncorrelated_at.
have xvq : covariance E (later q x) (fun t => later q.+1 v t *m sysF S) 0.
  have := covariance_add isE (covariance_transpose isE yv) (covariance_mul isE (- D) (covariance_transpose isE uvq)).
  rewrite !trmx0 mul0mx addr0 => /(covariance_transpose isE); rewrite trmx0; apply: (covariance_ext isE) => // t.
  by rewrite /later; have [_ ->] := model (t + q)%N; rewrite all_states no_feedthrough mulmx1 mulmx0 addr0 mulmxN addrK.
have := covariance_later isE q (covariance_mul isE (sysF S) xv) => e1.
apply: (covariance_unique isE e1); apply: (covariance_ext isE) xvq => // t.
by rewrite /later; congr (v _ *m _); lia.
Qed.

End Measured.

(** A fault that is correlated with itself two samples later, and not with what comes after that. *)
Section Coloured.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n m nu : nat) (S : system K n m n) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, n)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x y : nat -> 'rV[K]_n) (R : 'M[K]_m).
Hypotheses (isE : mean E) (pos : positive E) (model : process S B D u v x y) (st : stable (sysA S)) (uv : uncorrelated E u v).
Hypothesis quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)).
Hypotheses (short : forall l, (2 < l)%N -> covariance E (later l v) v 0) (two : covariance E v (later 2 v) R).

Lemma state_and_fault : covariance E x (later 1 v) ((sysF S)^T *m R).
Proof.
have [C hC] : exists C, covariance E x (later 1 v) C.
  have [C hC] := quasi 1%N; eexists; have := covariance_images isE (col_mx 0 1%:M) (col_mx (col_mx 0 1%:M) 0) hC.
  apply: (covariance_ext isE) => t; rewrite /later !mul_row_col !mulmx0 !mulmx1 ?addr0 ?add0r //.
suff <- : C = (sysF S)^T *m R by [].
apply: (covariance_unique isE (covariance_later isE 1 hC)).
have x0 : covariance E x (later 2 v) 0.
  have := later_faults isE pos model st quasi uv (k := 2) => /(_ (fun l => short (l := (l + 3)%N) ltac:(lia))) /(_ 0%N) h.
  have := covariance_transpose isE h; rewrite trmx0; apply: (covariance_ext isE) => // t; by rewrite /later addn0.
have h1 := covariance_mul_left isE (sysA S) x0; have h2 := covariance_mul_left isE B (proj1 (uv 2%N)).
have h3 := covariance_mul_left isE (sysF S) two; rewrite mulmx0 in h1; rewrite mulmx0 in h2.
have := covariance_add isE (covariance_add isE (covariance_transpose isE h1) (covariance_transpose isE h2)) (covariance_transpose isE h3).
rewrite !trmx0 !add0r => /(covariance_transpose isE); rewrite trmxK; apply: (covariance_ext isE) => t; rewrite /later; last first.
  by rewrite -addnA.
by rewrite addn1; have [-> _] := model t.
Qed.

Theorem coloured_seen q s L : sysC S = 1%:M -> sysG S = 0 -> (0 < q)%N -> (1 < s)%N ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> (L <= O S s)%MS ->
  (sysF S)^T *m R *m sysF S = 0.
Proof.
case: q L => // q; case: s => [|[|s]] // L all_states no_feedthrough _ _ hL le.
exact: (seen_fault isE model uv all_states no_feedthrough hL le state_and_fault).
Qed.

End Coloured.
