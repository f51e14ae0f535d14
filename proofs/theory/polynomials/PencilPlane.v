(** A plane of constant rows that complete q b - a to nonsingular matrices: when the e >= 1 rows of q b - a, in e + 1 + r columns, have a
    right inverse over the polynomials and those of b are independent, there are P and Q such that det [q b - a; x P + y Q] is zero for no
    (x, y) but (0, 0), in whatever extension of the field. The reduction of PencilAssignment.v leads to one row q beta - alpha, and there
    the matrix can be made cyclic, of determinant x^(r+1) q + y^(r+1), up to the sign of the second term and a constant.

                    turned == 0, 1, ..., r moved by one, around: r, 0, ..., r - 1
         cyclic_matrix x y == diag(x q, x, ..., x) + y times the matrix of turned
              lifted H t R == [(t, 0, ..., 0)^T, R] H^-1
  completing_plane a b P Q == det [q b - a; x P + y Q] is zero for no (x, y) but (0, 0), over every extension *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop perm zmodp ssralg poly matrix mxalgebra mxpoly.
From faultspace Require Import Minors PencilAssignment.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Cyclic.
Variables (L : fieldType) (r : nat).

Definition turned (i : 'I_(1 + r)) : 'I_(1 + r) := if val i is j.+1 then inord j else ord_max.

Definition cyclic_matrix (x y : L) : 'M[{poly L}]_(1 + r) :=
  block_mx (x *: 'X)%:M 0 0 (x%:P)%:M + y%:P *: rowsub turned 1%:M.

Lemma turned_lift (i : 'I_r) : val (turned (lift ord0 i)) = val i.
Proof. by rewrite /turned /= inordK // ltnS ltnW. Qed.

Lemma cyclic_first x y j : cyclic_matrix x y 0 j = (x *: 'X) *+ (j == 0) + y%:P *+ (j == ord_max).
Proof.
rewrite !mxE; case: splitP => // i i0; rewrite !mxE.
have -> : turned 0 = ord_max by [].
rewrite [ord_max == j]eq_sym mulr_natr; congr (_ + _).
case: splitP => k ek; rewrite !mxE; first by rewrite [i]ord1 [k]ord1 eqxx; have -> : j = 0 by apply: val_inj; rewrite /= ek [k]ord1.
by have -> : (j == 0) = false by [rewrite -val_eqE /= ek]; rewrite mulr0n.
Qed.

Lemma cyclic_other x y (i : 'I_r) j : cyclic_matrix x y (lift ord0 i) j = x%:P *+ (val j == i.+1) + y%:P *+ (val j == i).
Proof.
rewrite !mxE; case: splitP => i' ei; first by rewrite [i']ord1 in ei.
have {ei} ei : i = i' by apply: val_inj; move: ei => /= [].
rewrite -ei !mxE -[turned _ == j]val_eqE turned_lift mulr_natr [val i == _]eq_sym; congr (_ + _).
case: splitP => k ek; rewrite /= ek !mxE; first by rewrite [k]ord1.
by rewrite -val_eqE eqSS /= [val k == _]eq_sym.
Qed.

Lemma cyclic_cofactor_first x y : cofactor (cyclic_matrix x y) 0 0 = (x ^+ r)%:P.
Proof.
rewrite /cofactor expr0 mul1r det_trig.
  rewrite (eq_bigr (fun=> x%:P)) => [|i _]; first by rewrite prodr_const card_ord polyC_exp.
  by rewrite 2!mxE cyclic_other /= /bump /= add1n eqxx gtn_eqF // addr0.
apply/is_trig_mxP => i j ij; rewrite 2!mxE cyclic_other /= /bump /= !add1n eqSS gtn_eqF // gtn_eqF ?addr0 //.
exact: leqW.
Qed.

Lemma cyclic_cofactor_last x y : cofactor (cyclic_matrix x y) 0 ord_max = ((-1) ^+ r * y ^+ r)%:P.
Proof.
rewrite /cofactor add0n -det_tr det_trig; last first.
  apply/is_trig_mxP => i j ij; rewrite 3!mxE cyclic_other ![val (lift ord_max _)]lift_max !ltn_eqF ?addr0 //.
  exact: ltnW.
rewrite polyCM !polyC_exp polyCN; congr (_ * _).
rewrite (eq_bigr (fun=> y%:P)) => [|i _]; first by rewrite prodr_const card_ord.
by rewrite 3!mxE cyclic_other ![val (lift ord_max _)]lift_max eqxx ltn_eqF // add0r.
Qed.

Lemma det_cyclic x y : \det (cyclic_matrix x y) = (x ^+ r.+1) *: 'X + ((-1) ^+ r * y ^+ r.+1)%:P.
Proof.
rewrite (expand_det_row _ 0); under eq_bigr do rewrite cyclic_first mulrDl.
rewrite big_split /= (bigD1 (0 : 'I_(1 + r))) //= big1 => [|j /negPf ->]; last by rewrite mulr0n mul0r.
rewrite (bigD1 ord_max) //= big1 => [|j /negPf ->]; last by rewrite mulr0n mul0r.
rewrite !addr0 ?eqxx !mulr1n cyclic_cofactor_first cyclic_cofactor_last
  [X in X + _]mulrC mul_polyC scalerA -exprSr -polyCM; congr (_ + _%:P).
by rewrite mulrCA -exprS.
Qed.

Lemma det_cyclic_neq0 x y : (x != 0) || (y != 0) -> \det (cyclic_matrix x y) != 0.
Proof.
rewrite det_cyclic; have [-> /= y0|x0 _] := eqVneq x 0.
  by rewrite expr0n scale0r add0r polyC_eq0 mulf_neq0 ?expf_neq0 // oppr_eq0 oner_eq0.
apply: contraNneq x0 => /(congr1 (fun g : {poly L} => g`_1)); rewrite coefD coefZ coefX coefC coef0 mulr1 addr0 => /eqP.
by rewrite expf_eq0.
Qed.

End Cyclic.

Local Notation const := (map_mx (@polyC _)).
Local Notation linear_rows b a := ('X *: const b - const a).

Lemma cyclic_rows (L : fieldType) r (alpha beta : 'rV[L]_(1 + r)) (W : 'M_(r, 1 + r)) x y :
  let R := x *: col_mx alpha W + y *: rowsub (@turned r) (col_mx beta W) in
  col_mx (const (usubmx R) - (- x)%:P *: linear_rows beta alpha) (const (dsubmx R)) = cyclic_matrix r x y *m const (col_mx beta W).
Proof.
move=> R; rewrite {}/R /cyclic_matrix mulmxDl -scalemxAl mul_rowsub_mx mul1mx map_col_mx mul_block_col !mul0mx addr0 add0r !mul_scalar_mx.
set T := rowsub _ (col_mx beta W).
have -> : rowsub (@turned r) (col_mx (const beta) (const W)) = const T by rewrite -map_col_mx map_mxsub.
rewrite -[T]vsubmxK !scale_col_mx add_col_mx col_mxKu col_mxKd map_col_mx scale_col_mx add_col_mx !map_mxD !map_mxZ.
congr col_mx; rewrite [LHS]addrAC; congr (_ + _).
by rewrite polyCN scaleNr opprK scalerBr addrC subrK scalerA mul_polyC.
Qed.

(** A matrix with one column less, as PencilAssignment.v lifts it. *)
Definition lifted (K : fieldType) k N (H : 'M[K]_(1 + N)) t (R : 'M_(1 + k, N)) : 'M_(1 + k, 1 + N) := row_mx (col_mx t%:M 0) R *m invmx H.

Lemma lifted_plane (K L : fieldType) (f : {rmorphism K -> L}) k N (H : 'M[K]_(1 + N)) x y t t' (R R' : 'M_(1 + k, N)) :
  x *: map_mx f (lifted H t R) + y *: map_mx f (lifted H t' R') =
  lifted (map_mx f H) (x * f t + y * f t') (x *: map_mx f R + y *: map_mx f R').
Proof.
rewrite /lifted !map_mxM !map_row_mx !map_col_mx !map_scalar_mx !map_mx0 map_invmx !scalemxAl -mulmxDl !scale_row_mx add_row_mx.
by rewrite !scale_col_mx add_col_mx !scaler0 addr0 !scale_scalar_mx raddfD.
Qed.

Section Reduced.
Variables (K : fieldType) (e r : nat) (a b : 'M[K]_(1 + e, 1 + (e + (1 + r)))) (h : 'cV[K]_(1 + (e + (1 + r)))).
Variables (H : 'M[K]_(1 + (e + (1 + r)))) (H' : 'M[K]_(1 + (e + (1 + r)), e + (1 + r))) (L1 : 'M[K]_(1 + e)) (L1' : 'M[K]_(1 + e, e)).
Hypotheses (bh : b *m h = 0) (unitH : H \in unitmx) (HE : H = row_mx h H') (unitL1 : L1 \in unitmx) (LE : L1 = row_mx (- (a *m h)) L1').
Notation reduced M := (invmx L1 *m M *m H').

Lemma det_lifted t (R : 'M[K]_(1 + r, e + (1 + r))) :
  (\det (invmx L1) * \det H) *: \det (col_mx (linear_rows b a) (const (lifted H t R))) =
  \det (col_mx (linear_rows (dsubmx (reduced b)) (dsubmx (reduced a)))
    (col_mx (const (usubmx R) - t%:P *: linear_rows (usubmx (reduced b)) (usubmx (reduced a))) (const (dsubmx R)))).
Proof.
rewrite det_row_linear mul_polyC -map_col_mx -(lifted_determinant bh unitH HE unitL1 LE); congr (_ *: \det (col_mx _ (const _))).
by rewrite /lifted -[in LHS](vsubmxK R) -block_mxEh block_mxEv mul_col_mx.
Qed.

End Reduced.

(** What is to be shown is so after the reduction, over an extension too. *)
Lemma lifted_neq0 (K L : fieldType) (f : {rmorphism K -> L}) e r (a b : 'M[K]_(1 + e, 1 + (e + (1 + r)))) h
    (H : 'M_(1 + (e + (1 + r)))) (H' : 'M_(1 + (e + (1 + r)), e + (1 + r))) (L1 : 'M_(1 + e)) (L1' : 'M_(1 + e, e)) t R :
  let reduced M := invmx L1 *m M *m H' in
  b *m h = 0 -> H \in unitmx -> H = row_mx h H' -> L1 \in unitmx -> L1 = row_mx (- (a *m h)) L1' ->
  \det (col_mx (linear_rows (map_mx f (dsubmx (reduced b))) (map_mx f (dsubmx (reduced a))))
    (col_mx (const (usubmx R) - t%:P *: linear_rows (map_mx f (usubmx (reduced b))) (map_mx f (usubmx (reduced a))))
      (const (dsubmx R)))) != 0 ->
  \det (col_mx (linear_rows (map_mx f b) (map_mx f a)) (const (lifted (map_mx f H) t R))) != 0.
Proof.
move=> reduced bh unitH HE unitL1 LE; apply: contraNneq => d0.
have mapped M : map_mx f (reduced M) = invmx (map_mx f L1) *m map_mx f M *m map_mx f H' by rewrite !map_mxM map_invmx.
rewrite ![map_mx f (dsubmx _)]map_dsubmx ![map_mx f (usubmx _)]map_usubmx !mapped.
rewrite -(@det_lifted _ e r _ _ (map_mx f h) (map_mx f H) _ _ (map_mx f L1')).
- by rewrite d0 scaler0.
- by rewrite -map_mxM bh map_mx0.
- by rewrite map_unitmx.
- by rewrite HE map_row_mx.
- by rewrite map_unitmx.
by rewrite {1}LE map_row_mx map_mxN map_mxM.
Qed.

Section Plane.
Variable K : fieldType.

Definition completing_plane e r (a b : 'M[K]_(e, e + r)) (P Q : 'M[K]_(r, e + r)) :=
  forall (L : fieldType) (f : {rmorphism K -> L}) x y, (x != 0) || (y != 0) ->
  \det (col_mx (linear_rows (map_mx f b) (map_mx f a)) (const (x *: map_mx f P + y *: map_mx f Q))) != 0.

Theorem plane_of_pencil e : forall r (a b : 'M[K]_(1 + e, 1 + (e + (1 + r)))) (c : 'rV_(1 + (e + (1 + r)))), row_free (col_mx b c) ->
  (exists X, linear_rows b a *m X = 1%:M) -> exists P Q, @completing_plane (1 + e) (1 + r) a b P Q.
Proof.
elim: e => [|e IH] r a b c free right.
all: have [h [bh ch ah]] := reducing_column free right.
all: have [H [unitH [H' HE]]] := unit_column (ltac:(by apply: contraNneq ch => ->; rewrite mulmx0) : h != 0).
all: have [L1 [unitL1 [L1' LE]]] := unit_column (ltac:(by rewrite oppr_eq0) : - (a *m h) != 0).
all: pose reduced (M : 'M[K]_(_, _)) := invmx L1 *m M *m H'.
- have {}free := reduced_free free bh unitH HE unitL1.
  have {}free : row_free (usubmx (reduced b)).
    apply: inj_row_free => u u0; have : row_mx (0 : 'rV_0) u = 0.
      by apply: (row_free_inj free); rewrite mul_row_col !mul0mx add0r; exact: u0.
    by move/(congr1 rsubmx); rewrite row_mxKr linear0.
  have [W unitW] := @complete_rows K 1 r _ free.
  pose R : 'M[K]_(1 + r, 0 + (1 + r)) := col_mx (usubmx (reduced a)) W.
  pose T : 'M[K]_(1 + r, 0 + (1 + r)) := rowsub (@turned r) (col_mx (usubmx (reduced b)) W).
  exists (lifted H (- 1) R), (lifted H 0 T) => L f x y xy.
  rewrite (@lifted_plane _ _ _ r (0 + (1 + r))) rmorphN1 rmorph0 mulrN1 mulr0 addr0.
  apply: (@lifted_neq0 _ _ _ 0 r _ _ h _ H' L1 L1') => //.
  set M := (X in \det X != 0); have -> : M = cyclic_matrix r x y *m const (map_mx f (col_mx (usubmx (reduced b)) W)).
    rewrite [map_mx f (col_mx _ W)]map_col_mx -(@cyclic_rows L r (map_mx f (usubmx (reduced a)))) -!map_col_mx -map_mxsub.
    exact: no_rows_above.
  by rewrite det_mulmx mulf_neq0 ?det_cyclic_neq0 // !det_map_mx polyC_eq0 fmorph_eq0 -unitfE -unitmxE.
have [P [Q plane]] := IH r _ _ _ (reduced_free free bh unitH HE unitL1) (reduced_right bh unitH HE unitL1 LE right).
exists (lifted H 0 P), (lifted H 0 Q) => L f x y /plane; rewrite lifted_plane rmorph0 !mulr0 addr0 => D0.
apply: (@lifted_neq0 _ _ _ e.+1 r _ _ h _ H' L1 L1') => //.
by rewrite scale0r subr0 -map_col_mx vsubmxK.
Qed.

End Plane.
