(** When v is determined without the initial state, in terms of zeros with their multiplicities: the system is left-invertible, and its zero
    polynomial is the characteristic polynomial of the unobservable part. It is not enough that every finite zero is an unobservable mode:
    in both examples the only zero is 0, twice, and the only unobservable mode is 0, once.

            twice_zero == x1(k+1) = 0, x2(k+1) = x2(k) + v(k), r = x2 + v
    twice_zero_delayed == x1(k+1) = 0, x2(k+1) = 0, x3(k+1) = x2(k) + v(k), r = x3 *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra mxpoly vector fraction.
From faultspace Require Import Vocabulary Basics Trajectory TransferRank FiniteZeros InfiniteZeros Readings.
From faultspace Require Import StructureVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Unobservable.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma unobservable_step (x : 'rV_n) : x *m O S n = 0 -> x *m sysC S = 0 /\ x *m sysA S *m O S n = 0.
Proof.
move=> /unobservable z; split; first by have := z 0%N; rewrite /output /= mul0mx addr0.
by apply/unobservable => k; have := z k.+1; rewrite output_step /= mul0mx addr0.
Qed.

Theorem unobservable_dynamics_exist : exists d (N : 'M[K]_(d, n)) M, unobservable_dynamics S N M.
Proof.
pose N := row_base (kermx (O S n)); have NE : (N :=: kermx (O S n))%MS := eq_row_base _.
have free : row_free N := row_base_free _.
have /submxP[M NM] : (N *m sysA S <= N)%MS.
  rewrite NE; apply/row_subP => i; apply/sub_kermxP; rewrite row_mul; apply: (unobservable_step _).2.
  by apply/sub_kermxP; rewrite -NE row_sub.
by exists _, N, M.
Qed.

Theorem recovered_blindly_by_polynomials d (N : 'M[K]_(d, n)) M (g : {poly K}) :
  unobservable_dynamics S N M -> gcd_of_minors (pencil S) g ->
  faults_recovered_blindly S <-> left_invertible S /\ g %= char_poly M.
Proof.
move=> [free NE NM] finite; have dE : d = (n - \rank (O S n))%N by rewrite -mxrank_ker -NE (eqP free).
split=> [blind | [inv eq_g]]; last first.
  by apply/(recovered_blindly_by_zeros finite); split=> //; rewrite (eqp_size eq_g) size_char_poly.
have /faults_recovered_blindly_states[inv quiet] := blind; split=> //.
have dyn : zero_dynamics S N 0 M.
  split=> // [x||].
  - rewrite NE; split=> [/sub_kermxP/unobservable z | /silent_for_ever h]; first by exists (fun=> 0).
    exact/sub_kermxP/unobservable/quiet.
  - by rewrite mul0mx addr0.
  rewrite mul0mx addr0; apply/row_matrixP => i; rewrite row0 row_mul; apply: (unobservable_step _).1.
  by apply/sub_kermxP; rewrite -NE row_sub.
have [div max] := zero_polynomial inv dyn; have [div_g max_g] := finite.
by rewrite /eqp max // max_g.
Qed.

(** A double zero at 0. *)
Lemma double_zero (Z : 'M_(2, n)) L : left_invertible S -> zero_dynamics S Z L 0 ->
  forall (E : fieldType) (f : {rmorphism K -> E}) z, zero_of S f z -> z = 0.
Proof.
move=> inv dyn E f z; rewrite /zero_of ((left_invertible_transfer_rank S).1 inv) -/(pencil_at S f z) (finite_zeros inv dyn).
have -> : char_poly (0 : 'M[K]_2) = 'X^2 by apply: (@char_poly_nilpotent _ _ _ 1); rewrite /= mul0mx.
by rewrite map_polyXn rootE hornerXn expf_eq0 => /eqP.
Qed.

Lemma mode_of_zero_row (i : 'I_n) (E : fieldType) (f : {rmorphism K -> E}) : row i (sysA S) = 0 -> row i (sysC S) = 0 ->
  unobservable_mode S f 0.
Proof.
move=> A0 C0; rewrite /unobservable_mode ltn_neqAle rank_leq_row andbT; apply/negP => free.
set P := row_mx _ _ in free; have /(row_free_inj free) : row i (1%:M : 'M[E]_n) *m P = 0 *m P.
  by rewrite mul0mx -row_mul mul1mx row_row_mx [0%:M]raddf0 sub0r linearN /= -!map_row A0 C0 !map_mx0 oppr0 row_mx0.
by move/rowP/(_ i); rewrite !mxE eqxx => /eqP; rewrite oner_eq0.
Qed.

End Unobservable.

(** x1(k+1) = 0, x2(k+1) = x2(k) + v(k), r = x2 + v; and x1(k+1) = x2(k+1) = 0, x3(k+1) = x2(k) + v(k), r = x3. *)
Section Witnesses.
Variable K : fieldType.
Definition twice_zero : system K (1 + 1) 1 1 := System (block_mx 0 0 0 1%:M) (row_mx 0 1%:M) (col_mx 0 1%:M) 1%:M.
Definition twice_zero_delayed : system K (1 + (1 + 1)) 1 1 :=
  System (block_mx 0 0 0 (block_mx 0 1%:M 0 0)) (row_mx 0 (row_mx 0 1%:M)) (col_mx 0 (col_mx 0 1%:M)) 0.

Lemma twice_zero_step x v k : state twice_zero x v k.+1 = row_mx 0 (output twice_zero x v k).
Proof.
rewrite /output /= -[state _ _ _ _]hsubmxK mul_row_block mul_row_col mul_mx_row !mulmx0 !mulmx1 !addr0 !add0r add_row_mx.
by rewrite addr0.
Qed.

Lemma twice_zero_output x v k : output twice_zero x v k = (if k is j.+1 then output twice_zero x v j else rsubmx x) + v k.
Proof.
case: k => [|k]; first by rewrite /output /= -{1}[x]hsubmxK mul_row_col mulmx0 !mulmx1 add0r.
by rewrite {1}/output twice_zero_step mul_row_col mulmx0 !mulmx1 add0r.
Qed.

Theorem twice_zero_not_recovered : [/\ left_invertible twice_zero,
  forall (E : fieldType) (f : {rmorphism K -> E}) z, zero_of twice_zero f z -> unobservable_mode twice_zero f z
  & ~ faults_recovered_blindly twice_zero].
Proof.
have inv : left_invertible twice_zero.
  move=> v silent k; have := twice_zero_output 0 v k; rewrite silent; case: k => [|k]; rewrite ?silent ?linear0 add0r => <- //.
have quiet x : exists v, forall k, output twice_zero x v k = 0.
  pose v k : 'rV[K]_1 := if k is 0%N then - rsubmx x else 0.
  exists v => k; elim: k => [|k IH]; rewrite twice_zero_output ?IH ?addr0 ?subrr //.
have dyn : zero_dynamics twice_zero (1%:M : 'M_(1 + 1)) (col_mx 0 (- 1%:M) : 'M_(1 + 1, 1)) 0.
  split; first by rewrite row_free_unit unitmx1.
  - by move=> x; rewrite submx1; split=> // _; apply: quiet.
  - rewrite mul1mx mul0mx /= mul_col_mx mul0mx mul_mx_row mulmx0 mulmx1 block_mxEv add_col_mx addr0 add_row_mx !addr0 subrr.
    by rewrite !row_mx0 col_mx0.
  by rewrite mul1mx /= mul_col_mx mul0mx mulmx1 add_col_mx addr0 subrr col_mx0.
split=> // [E f z /(double_zero inv dyn) -> | blind].
  apply: (@mode_of_zero_row _ _ _ _ _ (lshift 1 0)) => /=; last by rewrite rowKu row0.
  by rewrite block_mxEv rowKu row_mx0 row0.
pose x : 'rV[K]_(1 + 1) := row_mx 0 1%:M; pose v k : 'rV[K]_1 := if k is 0%N then - 1%:M else 0.
have same k : output twice_zero x v k = output twice_zero 0 (fun=> 0) k.
  by rewrite [RHS]output_zero //; elim: k => [|k IH]; rewrite twice_zero_output ?IH ?addr0 // row_mxKr subrr.
by have /matrixP/(_ 0 0)/eqP := blind x 0 v (fun=> 0) same 0%N; rewrite !mxE oppr_eq0 oner_eq0.
Qed.

Lemma delayed_step x v k : state twice_zero_delayed x v k.+1 = row_mx 0 (row_mx 0 (lsubmx (rsubmx (state twice_zero_delayed x v k)) + v k)).
Proof.
rewrite /= -{1}[state _ _ _ _]hsubmxK mul_row_block mul_mx_row !mulmx0 !addr0 !add0r add_row_mx addr0; congr row_mx.
by rewrite -{1}[rsubmx _]hsubmxK mul_row_block mul_mx_row !mulmx0 !mulmx1 !addr0 add_row_mx addr0.
Qed.

Lemma delayed_output x v k : output twice_zero_delayed x v k = rsubmx (rsubmx (state twice_zero_delayed x v k)).
Proof.
rewrite /output /= mulmx0 addr0 -{1}[state _ _ _ _]hsubmxK mul_row_col mulmx0 add0r -{1}[rsubmx _]hsubmxK mul_row_col mulmx0 mulmx1.
by rewrite add0r.
Qed.

Theorem twice_zero_delayed_not_recovered : [/\ left_invertible twice_zero_delayed,
  forall (E : fieldType) (f : {rmorphism K -> E}) z, zero_of twice_zero_delayed f z -> unobservable_mode twice_zero_delayed f z
  & ~ faults_recovered_blindly twice_zero_delayed].
Proof.
pose S := twice_zero_delayed.
have next x v k : output S x v k.+1 = (if k is 0%N then lsubmx (rsubmx x) else 0) + v k.
  by rewrite delayed_output delayed_step !row_mxKr; case: k => // k; rewrite delayed_step row_mxKr row_mxKl.
have inv : left_invertible S.
  by move=> v silent k; have := next 0 v k; rewrite silent; case: k => [|k]; rewrite ?linear0 add0r => <-.
pose v (x : 'rV[K]_(1 + (1 + 1))) k : 'rV[K]_1 := if k is 0%N then - lsubmx (rsubmx x) else 0.
have quiet x k : rsubmx (rsubmx x) = 0 -> output S x (v x) k = 0.
  by case: k => [|[|k]]; rewrite ?delayed_output // -/S -delayed_output next ?subrr ?addr0.
pose Z : 'M[K]_(1 + 1, 1 + (1 + 1)) := block_mx 1%:M 0 0 (row_mx 1%:M 0).
have dyn : zero_dynamics S Z (col_mx 0 (- 1%:M) : 'M_(1 + 1, 1)) 0.
  split.
  - by rewrite /row_free rank_diag_block_mx rank_row_mx0 !mxrank1.
  - move=> x; split=> [/submxP[c ->]|[w silent]].
      exists (v (c *m Z)) => k; apply: quiet.
      by rewrite /Z -[c]hsubmxK mul_row_block row_mxKr mulmx0 add0r mul_mx_row mulmx0 row_mxKr.
    have := silent 0%N; rewrite delayed_output /= => x3; apply/submxP; exists (row_mx (lsubmx x) (lsubmx (rsubmx x))).
    by rewrite mul_row_block !mulmx0 !mulmx1 addr0 add0r mul_mx_row mulmx1 mulmx0 -x3 !hsubmxK.
  - have -> : Z *m sysA S = col_mx 0 (sysF S).
      rewrite /Z /= mulmx_block mul_row_block ?(mulmx0, mul0mx, mulmx1, mul1mx, addr0, add0r).
      by rewrite block_mxEv row_mx0.
    by rewrite mul0mx mul_col_mx mul0mx mulNmx mul1mx add_col_mx addr0 subrr col_mx0.
  by rewrite /= /Z mul_block_col mul_row_col ?(mulmx0, mul0mx, addr0, add0r) col_mx0.
split=> // [E f z /(double_zero inv dyn) -> | blind].
  apply: (@mode_of_zero_row _ _ _ _ _ (lshift _ 0)) => /=; last by rewrite rowKu row0.
  by rewrite block_mxEv rowKu row_mx0 row0.
pose x : 'rV[K]_(1 + (1 + 1)) := row_mx 0 (row_mx 1%:M 0).
have same k : output S x (v x) k = output S 0 (fun=> 0) k.
  by rewrite quiet ?row_mxKr // output_zero.
have /matrixP/(_ 0 0)/eqP := blind x 0 (v x) (fun=> 0) same 0%N.
by rewrite /v /x row_mxKr row_mxKl !mxE oppr_eq0 oner_eq0.
Qed.
End Witnesses.
