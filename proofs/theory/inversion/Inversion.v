(** Left inversion needs at most n + 1 samples, and is full row rank n + m of the pencil over the rational functions. The circle is
    closed by polynomials: a polynomial row in the left kernel of the pencil, read from its leading coefficient on, is a silent
    trajectory from rest to rest; and n + 1 states of a silent trajectory from rest are linearly dependent, which gives a polynomial row
    in the kernel.

       reversed d M k == coefficient d - k of M
    horner_states f l == the polynomial f(0) q^l + ... + f(l) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv matrix mxalgebra mxpoly fraction.
From faultspace Require Import Vocabulary Basics PolynomialKernel.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Inversion.
Variables (K : fieldType) (n m p : nat).
Implicit Types (S : system K n m p) (v : nat -> 'rV[K]_m).
Notation const := (map_mx (@polyC K)).

Lemma delay_left_invertible S l : inverts_with_delay S l -> left_invertible S.
Proof.
move=> delay v silent k; elim: k v silent => [|k IH] v silent; first by apply: delay => k _; apply: silent.
apply: (IH (fun i => v i.+1)) => i; rewrite -[RHS](silent i.+1) output_step.
by rewrite (delay v) // !mul0mx addr0.
Qed.

Lemma row_pencil S (x : 'rV_n) (w : 'rV_m) :
  row_mx x w *m pencil S =
  row_mx ('X *: x - x *m const (sysA S) - w *m const (sysF S)) (x *m const (sysC S) + w *m const (sysG S)).
Proof. by rewrite mul_row_block mulmxBr mul_mx_scalar mulmxN. Qed.

(** A polynomial row of the kernel is a silent trajectory from rest, leading coefficient first. *)
Definition reversed a d (M : 'M[{poly K}]_(1, a)) k := if (k <= d)%N then coefm (d - k) M else 0.

Lemma kernel_trajectory S d (x : 'rV_n) (w : 'rV_m) : row_mx x w *m pencil S = 0 -> (sizem x <= d)%N -> (sizem w <= d)%N ->
  forall k, state S 0 (reversed d w) k = reversed d x k /\ output S 0 (reversed d w) k = 0.
Proof.
rewrite row_pencil -row_mx0 => /eq_row_mx [ex ey] /sizem_leP x0 /sizem_leP w0.
have step k : coefm k x *m sysA S + coefm k w *m sysF S = if k is j.+1 then coefm j x else 0.
  by apply/esym/eqP; rewrite -coefmX -subr_eq0 opprD addrA -!coefm_mulr -!coefmB ex coefm0.
have quiet k : coefm k x *m sysC S + coefm k w *m sysG S = 0 by rewrite -!coefm_mulr -coefmD ey coefm0.
have states k : state S 0 (reversed d w) k = reversed d x k.
  elim: k => [|k IH] /=; first by rewrite /reversed subn0 x0.
  rewrite IH /reversed; case: (ltngtP k d) => kd; last by rewrite kd subnn step.
    by rewrite step -(subnSK kd).
  by rewrite !mul0mx addr0.
by move=> k; rewrite /output states; split=> //; rewrite /reversed; case: ifP => _; rewrite ?quiet ?mul0mx ?addr0.
Qed.

Lemma reversed_eq0 a d (M : 'M_(1, a)) : (sizem M <= d)%N -> (forall k, reversed d M k = 0) -> M = 0.
Proof.
move=> /sizem_leP M0 rev0; apply/coefmP => k; rewrite coefm0; case: (leqP d k) => [|kd]; first exact: M0.
by have := rev0 (d - k)%N; rewrite /reversed leq_subr subKn ?(ltnW kd).
Qed.

Lemma left_invertible_pencil S : left_invertible S -> \rank (over_fractions (pencil S)) = (n + m)%N.
Proof.
move=> invertible; apply/full_rank_over_fractions => u; rewrite -[u]hsubmxK.
move: (lsubmx u) (rsubmx u) => x w {u} ker.
have trajectory := kernel_trajectory ker (leq_maxl _ _) (leq_maxr _ _).
have v0 : forall k, reversed (maxn (sizem x) (sizem w)) w k = 0 by apply: invertible => k; apply: (trajectory k).2.
have -> : w = 0 by apply: reversed_eq0 v0; apply: leq_maxr.
suff -> : x = 0 by rewrite row_mx0.
by apply: (reversed_eq0 (leq_maxl _ (sizem w))) => k; rewrite -(trajectory k).1 state_zero.
Qed.

(** Horner's scheme: the truncations of a sequence as polynomials, its first member leading. *)
Fixpoint horner_states a (f : nat -> 'rV[K]_a) l := if l is k.+1 then 'X *: horner_states f k + const (f l) else const (f 0%N).

Lemma coefm_horner_states a (f : nat -> 'rV[K]_a) l k : (l <= k)%N -> coefm k (horner_states f l) = if k == l then f 0%N else 0.
Proof.
elim: l k => [|l IH] [|k] lk //=; rewrite ?coefm_const // coefmD coefmX IH // coefm_const addr0.
by rewrite eqSS.
Qed.

Lemma horner_pencil S v l : (forall k, (k <= l)%N -> output S 0 v k = 0) ->
  row_mx (horner_states (state S 0 v) l) (horner_states v l) *m pencil S = row_mx (- const (state S 0 v l.+1)) 0.
Proof.
rewrite row_pencil => quiet; congr row_mx.
  elim: l {quiet} => [|l IH] /=; first by rewrite !map_mx0 scaler0 mul0mx subrr sub0r -map_mxM mul0mx add0r.
  rewrite !mulmxDl -!scalemxAl scalerDr !opprD [X in X + _]addrACA [LHS]addrACA.

  rewrite -!scalerBr IH -addrA scalerN addKr.
  by rewrite -opprD -!map_mxM -map_mxD mulmxDl.
have const_quiet k : (k <= l)%N -> const (state S 0 v k) *m const (sysC S) + const (v k) *m const (sysG S) = 0.
  by move/quiet; rewrite /output => q; rewrite -!map_mxM -map_mxD q map_mx0.
elim: l const_quiet {quiet} => [|l IH] quiet; first exact: quiet.
rewrite /= !mulmxDl -!scalemxAl addrACA -scalerDr IH => [|k /leqW]; last exact: quiet.
by rewrite scaler0 add0r; apply: (quiet l.+1).
Qed.

Lemma pencil_inverts S : \rank (over_fractions (pencil S)) = (n + m)%N -> inverts_with_delay S n.
Proof.
move=> /full_rank_over_fractions inj v quiet.
pose M := \matrix_(l < n.+1) state S 0 v l.+1.
have : kermx M != 0 by rewrite -mxrank_eq0 mxrank_ker -lt0n subn_gt0 ltnS rank_leq_col.
case/rowV0Pn => c /sub_kermxP cM c0.
have [j cj top] : exists2 j, c 0 j != 0 & forall i : 'I_n.+1, (j < i)%N -> c 0 i = 0.
  have /rV0Pn[i0 ci0] := c0.
  case: (@arg_maxnP _ i0 (fun i => c 0 i != 0) val ci0) => j cj top; exists j => // i ji.
  by apply: contraTeq ji => /top; rewrite -leqNgt.
pose u l := row_mx (horner_states (state S 0 v) l) (horner_states v l).
have /inj : (\sum_(l < n.+1) (c 0 l)%:P *: u l) *m pencil S = 0.
  transitivity ((\sum_(l < n.+1) const (c 0 l *: row l M)) *m row_mx (- 1%:M) 0 : 'rV[{poly K}]_(n + p)).
    rewrite !mulmx_suml; apply: eq_bigr => l _; rewrite -scalemxAl horner_pencil => [|k kl].
      by rewrite scale_row_mx scaler0 scalerN map_mxZ rowK mul_mx_row mulmx0 mulmxN mulmx1.
    by apply: quiet; apply: leq_trans kl _; rewrite -ltnS.
  have := congr1 const cM; rewrite mulmx_sum_row raddf_sum raddf0 /= => ->; exact: mul0mx.
move/(congr1 (fun u => coefm j (rsubmx u))); rewrite linear_sum coefm_sum linear0 coefm0 (bigD1 j) //= big1 => [|l lj].
  rewrite addr0 linearZ /= coefmZ row_mxKr coefm_horner_states // eqxx.
  by move/eqP; rewrite scaler_eq0 (negPf cj) => /eqP.
rewrite linearZ /= coefmZ row_mxKr; case: (ltngtP j l) => [/top ->||/val_inj/eqP]; rewrite ?scale0r //; last by rewrite eq_sym (negPf lj).
by move=> lj'; rewrite coefm_horner_states ?(ltnW lj') // gtn_eqF // scaler0.
Qed.

(** Two forms of left-invertibility, for any dimensions. *)
Theorem left_inversion_delay S :
  (left_invertible S <-> inverts_with_delay S n) /\ (left_invertible S <-> exists l, inverts_with_delay S l).
Proof.
have to_n : left_invertible S -> inverts_with_delay S n by move/left_invertible_pencil/pencil_inverts.
split; split=> [/to_n //|]; first exact: delay_left_invertible; first by exists n.
by case=> l; apply: delay_left_invertible.
Qed.

Theorem left_invertible_pencil_rank S : left_invertible S <-> \rank (over_fractions (pencil S)) = (n + m)%N.
Proof. by split=> [|/pencil_inverts]; [apply: left_invertible_pencil | apply: delay_left_invertible]. Qed.

End Inversion.
