(** The errors b(t) of u(t) given the r inputs after it, with a stable state z that the inputs drive: the covariances of b(t) with z(t+1),
    z(t+1) A, ... reach whatever the inputs reach. Let e(t) be the error of z(t) given u(t), ..., u(t+r-1). If b(t) is uncorrelated with
    z(t+1) w, then e(t+1) w is that of z(t) A w given one input more, so e w has no larger mean square than e A w. Where that holds of all
    A^k w, stability makes it zero, and inputs that excite leave no such w, but where the inputs do not reach.

    weights c i == the rows of c that belong to the i-th of r samples *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Places Consistency WholeRange MeansVocabulary Means Forgetting LongPast OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma combination_itself (K : fieldType) a (f : nat -> 'rV[K]_a) : combination f f.
Proof. by apply: combination_ext (combination_part f 1%:M) => t; rewrite mulmx1. Qed.

Lemma power_mul (K : fieldType) a n (A : 'M[K]_n) (C : 'M_(a, n)) k : iter k (mulmxr A) C = C *m iter k (mulmxr A) 1%:M.
Proof. by elim: k => [|k IH] /=; rewrite ?mulmx1 // IH mulmxA. Qed.

(** A quadratic form of ever higher powers of a stable matrix. *)
Lemma forgotten_form (K : realFieldType) n (A P : 'M[K]_n) (w : 'cV_n) p : stable A ->
  (forall k, p <= ((iter k (mulmxr A) 1%:M *m w)^T *m P *m (iter k (mulmxr A) 1%:M *m w)) 0 0) -> p <= 0.
Proof.
move=> st h; case: leP => // p0; pose S := \sum_j `|w j 0|; pose T := \sum_i \sum_j `|P i j|; pose q := S * S * T.
have S0 : 0 <= S by apply: sumr_ge0.
have T0 : 0 <= T by do 2!apply: sumr_ge0 => ? _.
have q1 : 0 <= 1 + q by rewrite addr_ge0 ?ler01 // !mulr_ge0.
have d0 : 0 < p + (1 + q) by apply: ltr_pwDl.
pose eps := p / (p + (1 + q)); have eps0 : 0 < eps by rewrite divr_gt0.
have [k small] := st _ eps0; pose y := iter k (mulmxr A) 1%:M *m w.
have yS i : `|y i 0| <= eps * S.
  rewrite mxE mulr_sumr; apply: le_trans (ler_norm_sum _ _ _) _; apply: ler_sum => j _.
  by rewrite normrM; apply: ler_wpM2r => //; rewrite ltW.
have S'0 : 0 <= eps * S by rewrite mulr_ge0 // ltW.
have : p <= eps * S * (eps * S) * T.
  move: (eps * S) S'0 yS => c c0 yS.
  apply: le_trans (h k) _; rewrite -/y; apply: le_trans (ler_norm _) _; rewrite mxE /T exchange_big mulr_sumr.
  apply: le_trans (ler_norm_sum _ _ _) _; apply: ler_sum => j _; rewrite normrM [(y^T *m P) 0 j]mxE.
  apply: le_trans (_ : _ <= (\sum_i `|y^T 0 i * P i j|) * c) _; first by apply: ler_pM; rewrite ?normr_ge0 //; apply: ler_norm_sum.
  rewrite mulr_suml mulr_sumr; apply: ler_sum => i _; rewrite normrM mxE mulrAC; apply: ler_wpM2r => //.
  by apply: ler_pM.
have e1 : eps <= 1 by rewrite /eps ler_pdivrMr // mul1r lerDl.
have shuffle a b c : a * b * (a * b) * c = b * b * c * a * a :> K.
  by rewrite mulrACA -[LHS]mulrA [LHS]mulrC !mulrA.
rewrite shuffle -/q; have q0 : 0 <= q * eps by rewrite mulr_ge0 ?(ltW eps0) // !mulr_ge0.
move=> le; have : p <= q * eps by apply: le_trans le _; apply: ler_piMr.
rewrite /eps mulrA ler_pdivlMr // [q * p]mulrC ler_pM2l // addrA addrC gerDl => /(lt_le_trans (ltr_pwDl p0 ler01)).
by rewrite ltxx.
Qed.

Section Windows.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (nu N : nat) (h : nat -> 'rV[K]_N) (u : nat -> 'rV[K]_nu).
Hypotheses (isE : mean E) (quasi : quasi_stationary E h) (cu : combination h u).

(** Section: definitions. *)
Definition weights r a (c : 'M[K]_(r * nu, a)) i : 'M_(nu, a) := if insub i is Some i then place K nu (i : 'I_r) *m c else 0.

Lemma weights_at r a (c : 'M_(r * nu, a)) (i : 'I_r) : weights c i = place K nu i *m c.
Proof. by rewrite /weights valK. Qed.

Lemma weights_after r a (c : 'M_(r * nu, a)) i : (r <= i)%N -> weights c i = 0.
Proof. by move=> ri; rewrite /weights insubF // ltnNge ri. Qed.

Lemma weights_sum r a (c : 'M_(r * nu, a)) t : successive 0 r u t *m c = \sum_(i < r) u (t + i)%N *m weights c i.
Proof. by rewrite /successive addn0 future_sum mulmx_suml; apply: eq_bigr => i _; rewrite weights_at mulmxA. Qed.

Lemma weights_zero r a (c : 'M_(r * nu, a)) : (forall i, weights c i = 0) -> c = 0.
Proof.
by move=> z; rewrite -[c]mul1mx -(sum_places K nu r) mulmx_suml big1 // => i _; rewrite -mulmxA -weights_at z mulmx0.
Qed.

Lemma combination_window r : combination h (successive 0 r u).
Proof.
have c i := combination_mul (if insub i is Some i then place K nu (i : 'I_r) else 0) (combination_later i cu).
apply: combination_ext (combination_sum r c) => t.
by rewrite /successive addn0 future_sum; apply: eq_bigr => i _; rewrite valK.
Qed.

Lemma covariance_window a k r (f : nat -> 'rV[K]_a) : (forall i, (i < r)%N -> covariance E f (later (k + i) u) 0) ->
  covariance E f (successive k r u) 0.
Proof.
move=> fu; pose p i := if insub i is Some i then place K nu (i : 'I_r) else 0.
have each i : (i < r)%N -> covariance E f (fun t => later (k + i) u t *m p i) 0.
  by move=> ir; rewrite -(mul0mx _ (p i)); apply: covariance_mul => //; apply: fu.
apply: (covariance_ext isE) (covariance_zero_sum (f := fun i t => later (k + i) u t *m p i) (fun=> 1) isE each) => // t.
by rewrite /successive future_sum; apply: eq_bigr => i _; rewrite scale1r /p valK /later addnA.
Qed.

Lemma covariance_sample a k r (f : nat -> 'rV[K]_a) i : covariance E f (successive k r u) 0 -> (i < r)%N ->
  covariance E f (later (k + i) u) 0.
Proof.
move=> fu ir; have := covariance_mul isE (place K nu (Ordinal ir))^T fu; rewrite mul0mx; apply: (covariance_ext isE) => // t.
by rewrite /successive -sample_of_future /later addnA.
Qed.

(** Inputs that excite have errors of prediction. *)
Theorem errors_exist r : excites E r u -> (exists c b, backward_error E r u c b) /\ exists d f, forward_error E r u d f.
Proof.
move=> [R uu unit]; have cw := combination_window r; split.
  have [R1 e1] := combination_covariance isE quasi (combination_later 1 cw) cu; pose W := invmx R *m R1.
  exists (weights W), (fun t => u t - \sum_(i < r) u (t + i.+1)%N *m weights W i); split=> // -[//|i] /= ir.
  apply: (@covariance_sample _ 1 r _ i _ ir).
  have := covariance_add isE e1 (covariance_mul isE (- W) (covariance_later isE 1 uu)); rewrite mulmxN mulKVmx // subrr.
  move/(covariance_transpose isE); rewrite trmx0; apply: (covariance_ext isE) => t; last by rewrite (successive_later 1 0).
  by rewrite mulmxN /later weights_sum; congr (_ - _); apply: eq_bigr => l _; rewrite -addnA.
have [R1 e1] := combination_covariance isE quasi cw (combination_later r cu); pose W := invmx R *m R1.
exists (weights W), (fun t => u (t + r)%N - \sum_(i < r) u (t + i)%N *m weights W i); split=> // i ir.
rewrite -[i]add0n; apply: covariance_sample ir.
have := covariance_add isE e1 (covariance_mul isE (- W) uu); rewrite mulmxN mulKVmx // subrr.
move/(covariance_transpose isE); rewrite trmx0; apply: (covariance_ext isE) => // t.
by rewrite mulmxN weights_sum.
Qed.

End Windows.

Section Inputs.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (nu N : nat) (h : nat -> 'rV[K]_N) (u : nat -> 'rV[K]_nu).
Hypotheses (isE : mean E) (pos : positive E) (quasi : quasi_stationary E h) (cu : combination h u).

(** A combination of inputs that excite is zero in mean square only if nothing is combined. *)
Lemma null_inputs r (d : nat -> 'cV[K]_nu) : let f t := \sum_(i < r) u (t + i)%N *m d i in
  excites E r u -> (forall i, (r <= i)%N -> d i = 0) -> covariance E f f 0 -> forall i, d i = 0.
Proof.
move=> f exciting after ff; pose z (t : nat) : 'rV[K]_0 := 0.
have driven t : z t.+1 = z t *m 0 + u t *m 0 by rewrite !mulmx0 addr0.
have null : covariance E (fun t => z t *m (0 : 'cV_0) + f t) (fun t => z t *m (0 : 'cV_0) + f t) 0.
  by apply: (covariance_ext isE) ff => t; rewrite mulmx0 add0r.
by have [] := zeta_unreached isE pos quasi cu (combination_zero h 0) driven null exciting after.
Qed.

Lemma excites_fewer r : excites E r.+1 u -> excites E r u.
Proof.
move=> exciting; have cw := combination_window cu r; have [R uu] := combination_covariance isE quasi cw cw; exists R => //.
rewrite -row_full_unit; apply: row_full_seen => w Rw; apply: weights_zero; apply: (null_inputs exciting) => [i ri|].
  by apply: weights_after; apply: ltnW.
have := covariance_images isE w w uu; rewrite -mulmxA Rw mulmx0; apply: (covariance_ext isE) => t;
  by rewrite weights_sum big_ord_recr /= weights_after // mulmx0 addr0.
Qed.

(** The state. *)
Section State.
Variables (n : nat) (A : 'M[K]_n) (B : 'M[K]_(nu, n)) (z : nat -> 'rV[K]_n).
Hypotheses (cz : combination h z) (st : stable A) (driven : forall t, z t.+1 = z t *m A + u t *m B).
Variables (r : nat) (b : nat -> 'rV[K]_nu) (c : nat -> 'M[K]_nu) (H : 'M[K]_(nu, n)).
Hypotheses (error : backward_error E r u c b) (bz : covariance E b (later 1 z) H) (exciting : excites E r u).

Lemma state_error : exists (W : 'M_(r * nu, n)) P, let e t := z t - successive 0 r u t *m W in
  [/\ combination h e, covariance E (successive 0 r u) e 0, covariance E e e P
    & forall w : 'cV_n, H *m w = 0 -> (w^T *m P *m w) 0 0 <= ((A *m w)^T *m P *m (A *m w)) 0 0].
Proof.
have [R uu unit] := exciting; have cw := combination_window cu r; have [Ruz uz] := combination_covariance isE quasi cw cz.
have [W RW] : exists W, R *m W = Ruz by exists (invmx R *m Ruz); rewrite mulKVmx.
exists W; pose e t := z t - successive 0 r u t *m W.
have ce : combination h e.
  by apply: combination_ext (combination_add cz (combination_mul (- W) cw)) => t; rewrite mulmxN.
have ue : covariance E (successive 0 r u) e 0.
  have := covariance_add isE uz (covariance_mul isE (- W) uu); rewrite mulmxN RW subrr.
  by apply: (covariance_ext isE) => // t; rewrite mulmxN.
have [P ee] := combination_covariance isE quasi ce ce; exists P; split=> // w Hw.
pose f t : 'rV_1 := later 1 e t *m w; have [eb bu] := error.
have uf : covariance E (later 1 (successive 0 r u)) f 0.
  by have := covariance_mul isE w (covariance_later isE 1 ue); rewrite mul0mx.
have bw : covariance E b (later 1 (successive 0 r u)) 0.
  apply: (covariance_ext isE (x := b) (y := successive 1 r u)) => [//|t|]; first by rewrite (successive_later 1 0).
  by apply: (covariance_window isE) => i ir; apply: bu.
have bf : covariance E b f 0.
  have := covariance_mul isE w (covariance_add isE bz (covariance_mul isE (- W) bw)); rewrite mul0mx addr0 Hw.
  by apply: (covariance_ext isE) => // t; rewrite /f /later /e mulmxN.
have fu i : (i <= r)%N -> covariance E f (later i u) 0.
  have step j : (j < r)%N -> covariance E f (later j.+1 u) 0.
    move=> jr; have := covariance_mul_left isE (place K nu (Ordinal jr))^T uf; rewrite mulmx0 => /(covariance_transpose isE).
    rewrite trmx0; apply: (covariance_ext isE) => // t; rewrite /later /successive addn0 -sample_of_future /=; congr u; lia.
  case: i => [_|i]; last exact: step.
  have each i : (i < r)%N -> covariance E f (fun t => later i.+1 u t *m c i) 0.
    by move=> ir; rewrite -(mul0mx _ (c i)); apply: covariance_mul => //; apply: step.
  have fb := covariance_transpose isE bf; rewrite trmx0 in fb.
  have := covariance_add isE fb (covariance_zero_sum (f := fun i t => later i.+1 u t *m c i) (fun=> 1) isE each); rewrite addr0.
  apply: (covariance_ext isE) => // t; rewrite eb /later addn0 -[RHS](subrK (\sum_(i < r) u (t + i.+1)%N *m c i)).
  by congr (_ + _); apply: eq_bigr => i _; rewrite scale1r.
pose delta t : 'rV_1 := e t *m (A *m w) - f t.
have fd : covariance E f delta 0.
  have fw : covariance E f (successive 0 r u) 0 by apply: (covariance_window isE) => i ir; apply: fu; apply: ltnW.
  have fu1 := covariance_transpose isE uf; rewrite trmx0 in fu1.
  have := covariance_add isE (covariance_mul isE (W *m w) fu1) (covariance_add isE (covariance_mul isE (- (W *m (A *m w))) fw)
    (covariance_mul isE (- (B *m w)) (fu 0%N isT))); rewrite !mul0mx !addr0; apply: (covariance_ext isE) => // t.
  rewrite /delta /f /later addn0 addn1 /e driven !mulmxBl mulmxDl !mulmxN !mulmxA.
  move: (z t *m A *m w) (u t *m B *m w) (successive 0 r u t *m W *m A *m w) (successive 0 r u t.+1 *m W *m w) => a1 a2 a3 a4.
  by rewrite [RHS]addrC opprB -addrA; congr (a4 + _); rewrite opprD addrACA addNr add0r addrC.
have [Pd dd] : exists R, covariance E delta delta R.
  have cf : combination h f by apply: combination_mul; apply: combination_later.
  have cd : combination h delta.
    by apply: combination_ext (combination_add (combination_mul (A *m w) ce) (combination_mul (- 1%:M) cf)) => t; rewrite mulmxN mulmx1.
  by apply: (combination_covariance isE quasi cd cd).
have ff := covariance_images isE w w (covariance_later isE 1 ee).
have df := covariance_transpose isE fd; rewrite trmx0 in df.
have fs : covariance E f (fun t => e t *m (A *m w)) (w^T *m P *m w).
  by have := covariance_add isE ff fd; rewrite addr0; apply: (covariance_ext isE) => // t; rewrite addrC subrK.
have ds : covariance E delta (fun t => e t *m (A *m w)) Pd.
  by have := covariance_add isE df dd; rewrite add0r; apply: (covariance_ext isE) => // t; rewrite addrC subrK.
have := covariance_add isE (covariance_transpose isE fs) (covariance_transpose isE ds) => ss.
have e1 : (A *m w)^T *m P *m (A *m w) = (w^T *m P *m w)^T + Pd^T.
  apply: (covariance_unique isE (covariance_images isE (A *m w) (A *m w) ee)); apply: (covariance_ext isE) ss => // t.
  by rewrite addrC subrK.
by rewrite e1 [X in _ <= X]mxE [(_^T) 0 0]mxE [Pd^T 0 0]mxE lerDl (square_positive isE pos 0 dd).
Qed.

Theorem error_reaches (w : 'cV_n) : excites E (n + r) u -> (forall k, (k < n)%N -> iter k (mulmxr A) H *m w = 0) ->
  forall l, (l < n)%N -> iter l (mulmxr A) B *m w = 0.
Proof.
move=> more /unseen_powers unseen; have [W [P [ce ue ee grows]]] := state_error.
pose X k := iter k (mulmxr A) 1%:M; have step k : X k.+1 = A *m X k by rewrite /X iterSr /= mul1mx power_mul.
have le k : (w^T *m P *m w) 0 0 <= ((X k *m w)^T *m P *m (X k *m w)) 0 0.
  elim: k => [|k IH]; first by rewrite mul1mx.
  by rewrite step -(mulmxA A); apply: le_trans IH _; apply: grows; rewrite mulmxA -power_mul.
pose f t : 'rV_1 := (z t - successive 0 r u t *m W) *m w.
have ff := covariance_images isE w w ee; have zero : w^T *m P *m w = 0.
  apply/matrixP=> i j; rewrite !ord1 [RHS]mxE; apply/eqP; rewrite eq_le (forgotten_form st le).
  exact: (square_positive isE pos 0 ff).
rewrite zero in ff; have ef t : f t = z t *m w + \sum_(i < r) u (t + i)%N *m weights (- (W *m w)) i.
  by rewrite /f -weights_sum mulmxBl mulmxN mulmxA.
have null : covariance E (fun t => z t *m w + \sum_(i < r) u (t + i)%N *m weights (- (W *m w)) i)
    (fun t => z t *m w + \sum_(i < r) u (t + i)%N *m weights (- (W *m w)) i) 0.
  by apply: (covariance_ext isE) ff => t; apply: ef.
by have [] := zeta_unreached isE pos quasi cu cz driven null more (fun i => @weights_after K nu r 1 _ i).
Qed.

End State.
End Inputs.
