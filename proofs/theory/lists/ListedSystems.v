(** Systems over the rational numbers given by integers: A, F, C, G are lists of rows, to be divided by one common denominator. Trajectories
    and Horner's rule are computed on the integers, that is for the system (eA, eF, eC, eG), whose outputs are those of (A, F, C, G) times
    e^(k+1) once v(k) is multiplied by e^k.

                       ratF == the field of the rational numbers
    column k u, columns p c == a list as a column, and a list of lists as columns
                 scaled e S == S with all its matrices times e
         horner_state A C c == C c_0 + A (C c_1 + A ( ... ))
         fault_action S c k == F X_(k+1) + G c_k, X_(k+1) being that of the rest of c
                 integral L == the system that L means, times its denominator *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  ssrint rat matrix fraction.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Basics CertificatesVocabulary Lists KernelRows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma simulate_size L x vs : size (simulate L x vs) = size vs.
Proof. by elim: vs x => //= v vs IH x; rewrite IH. Qed.

Notation ratF := (field_of rat) (only parsing).
Definition column k (u : vector) : 'cV[rat]_k := (vec ratF k u)^T.
Definition columns p (c : seq vector) : seq 'cV[rat]_p := map (column p) c.

(** Multiplying A, F, C, G by e. *)
Section Scaling.
Variables (K : fieldType) (n m p : nat) (e : K) (S : system K n m p).
Definition scaled : system K n m p := System (e *: sysA S) (e *: sysF S) (e *: sysC S) (e *: sysG S).

Lemma scaled_state x v k : state scaled x (fun j => e ^+ j *: v j) k = e ^+ k *: state S x v k.
Proof.
elim: k => [|k IH] /=; first by rewrite scale1r.
by rewrite IH -!scalemxAl -!scalemxAr !scalerA scalerDr -!exprSr.
Qed.

Lemma scaled_output x v k : output scaled x (fun j => e ^+ j *: v j) k = e ^+ k.+1 *: output S x v k.
Proof. by rewrite /output scaled_state /= -!scalemxAl -!scalemxAr !scalerA scalerDr -!exprSr. Qed.

Lemma scaled_state_back x v k : e != 0 -> state scaled x v k = e ^+ k *: state S x (fun j => e ^- j *: v j) k.
Proof.
by move=> e0; rewrite -scaled_state; apply: state_ext => j _; rewrite scalerA mulfV ?scale1r ?expf_neq0.
Qed.

Lemma scaled_output_back x v k : e != 0 -> output scaled x v k = e ^+ k.+1 *: output S x (fun j => e ^- j *: v j) k.
Proof.
by move=> e0; rewrite -scaled_output; apply: output_ext => j _; rewrite scalerA mulfV ?scale1r ?expf_neq0.
Qed.

End Scaling.

(** Horner's rule, over any field. *)
Section Horner.
Variables (K : fieldType) (n p : nat).
Implicit Types (c : seq 'cV[K]_p).
Fixpoint horner_state (A : 'M[K]_n) (C : 'M[K]_(n, p)) c : 'cV[K]_n := if c is c0 :: c' then C *m c0 + A *m horner_state A C c' else 0.
Definition fault_action m (S : system K n m p) c k : 'cV[K]_m :=
  sysF S *m horner_state (sysA S) (sysC S) (drop k.+1 c) + sysG S *m c`_k.

Lemma relation_cons (a : nat) (c0 : 'cV[K]_p) c (r : nat -> 'M[K]_(a, p)) :
  relation (c0 :: c) r = r 0%N *m c0 + relation c (fun k => r k.+1).
Proof. by rewrite /relation [size _]/= big_ord_recl. Qed.

Lemma relation_horner m (S : system K n m p) c x v :
  relation c (output S x v) = x *m horner_state (sysA S) (sysC S) c + \sum_(k < size c) v k *m fault_action S c k.
Proof.
elim: c x v => [|c0 c IH] x v; first by rewrite /relation !big_ord0 mulmx0 addr0.
rewrite relation_cons [size _]/= big_ord_recl (_ : relation c _ = relation c (output S (x *m sysA S + v 0%N *m sysF S) (fun i => v i.+1))).
  rewrite IH /output /= /fault_action /= drop0 !mulmxDr !mulmxDl !mulmxA addrA addrACA -!addrA.
  by congr (_ + (_ + _)); rewrite addrCA.
by apply: eq_bigr => k _; rewrite output_step.
Qed.

(** What a row that vanishes on all trajectories, or on those from rest, says about states and faults. *)
Lemma annihilating_state m (S : system K n m p) c : (forall x v, relation c (output S x v) = 0) -> horner_state (sysA S) (sysC S) c = 0.
Proof.
move=> h; apply/row_matrixP => i; rewrite rowE row0 -[RHS](h (delta_mx 0 i) (fun=> 0)) relation_horner big1 ?addr0 // => k _.
exact: mul0mx.
Qed.

Lemma vanishes_from_rest m (S : system K n m p) c :
  (forall v, relation c (output S 0 v) = 0) <-> (forall k, (k < size c)%N -> fault_action S c k = 0).
Proof.
split=> [h k kc|h v]; last by rewrite relation_horner mul0mx add0r big1 // => k _; rewrite h ?mulmx0.
apply/row_matrixP => i; rewrite rowE row0 -[RHS](h (fun j => if j == k then delta_mx 0 i else 0)) relation_horner mul0mx add0r.
rewrite (bigD1 (Ordinal kc)) //= eqxx big1 ?addr0 // => j jk; case: eqP => [e|]; last by rewrite mul0mx.
by case/eqP: jk; apply: val_inj.
Qed.

(** A row of a system holds for the responses of other columns (f, g) from rest at all times if it does at time 0. *)
Lemma vanishes_later m m' (S : system K n m p) (Z : system K n m' p) c x v j :
  sysA Z = sysA S -> sysC Z = sysC S -> (forall x v, relation c (output S x v) = 0) ->
  (forall k, (k < size c)%N -> fault_action Z c k = 0) ->
  relation c (fun k => output Z x v (j + k)) = 0.
Proof.
move=> eA eC hS hZ; rewrite (_ : relation c _ = relation c (output Z (state Z x v j) (fun i => v (j + i)%N))).
  by rewrite relation_horner eA eC (annihilating_state hS) mulmx0 add0r big1 // => k _; rewrite hZ ?mulmx0.
by apply: eq_bigr => k _; rewrite output_shift.
Qed.

End Horner.

(** What is computed on the lists is what is meant. *)
Section Meaning.
Variables (n m p : nat) (L : listed) (wf : well_formed n m p L).
Let S := meant n m p L.
Let e : rat := ratn (den L).
Definition integral := scaled e S.

Lemma den_neq0 : e != 0. Proof. by rewrite /e number_eq0; case/and5P: wf. Qed.

Lemma times_fraction a b (M : table) : e *: fraction (den L) a b M = mat ratF a b M.
Proof. by apply/matrixP => i j; rewrite !mxE mulrC divfK ?den_neq0. Qed.

Lemma integralE : integral = System (mat ratF n n (lA L)) (mat ratF m n (lF L)) (mat ratF n p (lC L)) (mat ratF m p (lG L)).
Proof. by rewrite /integral /scaled /= !times_fraction. Qed.

Lemma simulate_output x vs k : (k < size vs)%N ->
  vec ratF p (nth [::] (simulate L x vs) k) = output integral (vec ratF n x) (fun j => vec ratF m (nth [::] vs j)) k.
Proof.
case/and5P: wf => _ /andP[/eqP sA _] /andP[/eqP sF _] /andP[/eqP sC _] /andP[/eqP sG _].
elim: vs x k => // v vs IH x [|k] kv; first by rewrite /= vec_add (@vec_times _ n) ?sC // (@vec_times _ m) ?sG // /output integralE.
by rewrite output_step [LHS]IH // vec_add (@vec_times _ n) ?sA // (@vec_times _ m) ?sF // integralE.
Qed.

Lemma horner_meaning c : column n (horner L c).1 = horner_state (sysA integral) (sysC integral) (columns p c).
Proof.
case/and5P: wf => _ /andP[_ rA] _ /andP[_ rC] _.
elim: c => [|c0 c /=]; first by rewrite /column vec_nil trmx0.
case: (horner L c) => X ds /= IH; rewrite /column vec_add linearD /= (vec_apply _ _ _ rC) (vec_apply _ _ _ rA) -/(column n X) IH.
by rewrite -!times_fraction.
Qed.

Lemma horner_size c : size (horner L c).2 = size c.
Proof. by elim: c => //= c0 c; case: (horner L c) => X ds /= ->. Qed.

Lemma horner_nth c k : (k < size c)%N -> nth ([::], [::]) (horner L c).2 k = ((horner L (drop k.+1 c)).1, nth [::] c k).
Proof.
elim: c k => //= c0 c IH k; case e1: (horner L c) IH => [X ds] /= IH; case: k => [|k] kc /=; first by rewrite drop0 e1.
exact: IH.
Qed.

(** The demand k of a row acts on a fault f, g as the Horner coefficient does. *)
Lemma demand_meaning m' (Z : system ratF n m' p) c k : sysA Z = sysA integral -> sysC Z = sysC integral -> (k < size c)%N ->
  let d := nth ([::], [::]) (horner L c).2 k in fault_action Z (columns p c) k = sysF Z *m column n d.1 + sysG Z *m column p d.2.
Proof.
move=> eA eC kc; rewrite /= horner_nth //= horner_meaning /fault_action eA eC /columns map_drop; congr (_ + _ *m _).
by rewrite (nth_map [::]).
Qed.

(** Weights undo the powers of the denominator. *)
Lemma weighted_size c : size (weighted (den L) c).2 = size c.
Proof. by elim: c => //= c0 c; case: (weighted _ c) => w cs /= ->. Qed.

Lemma weighted_power c : ratn (weighted (den L) c).1 = e ^+ size c.
Proof.
elim: c => [|c0 c /=]; first exact: rmorph1.
by case: (weighted _ c) => w cs /= IH; rewrite [LHS](rmorphM (number_rmorphism _)) /= IH exprSr.
Qed.

Lemma relation_weighted a c (r : nat -> 'M[rat]_(a, p)) :
  relation (columns p (weighted (den L) c).2) (fun k => e ^+ k.+1 *: r k) = e ^+ size c *: relation (columns p c) r.
Proof.
elim: c r => [|c0 c IH] r; first by rewrite /relation !big_ord0 scaler0.
have := weighted_power c; move: IH; rewrite /=; case: (weighted _ c) => w cs /= IH ew.
rewrite !relation_cons scalerDr; congr (_ + _).
  by rewrite /column vec_scale linearZ /= -scalemxAr -scalemxAl scalerA ew expr1 exprSr.
rewrite exprS -scalerA -IH /relation scaler_sumr; apply: eq_bigr => k _.
by rewrite [in RHS]scalemxAl scalerA -exprS.
Qed.

Lemma relation_scaled m' (R : system ratF n m' p) c x v : relation (columns p (weighted (den L) c).2) (output (scaled e R) x v)
  = e ^+ size c *: relation (columns p c) (output R x (fun j => e ^- j *: v j)).
Proof. by rewrite -relation_weighted; apply: eq_bigr => k _; rewrite scaled_output_back ?den_neq0. Qed.

Lemma relation_meant c x v : relation (columns p c) (output S x v)
  = e ^- size c *: relation (columns p (weighted (den L) c).2) (output integral x (fun j => e ^+ j *: v j)).
Proof.
rewrite relation_scaled scalerA mulVf ?expf_neq0 ?den_neq0 // scale1r; apply: eq_bigr => k _; congr (_ *m _).
by apply: output_ext => j _; rewrite scalerA mulVf ?scale1r ?expf_neq0 ?den_neq0.
Qed.

End Meaning.
