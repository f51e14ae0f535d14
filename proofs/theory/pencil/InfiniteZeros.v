(** Infinite zeros of a left-invertible system, with their multiplicities, and zeta as the number of all zeros. The pencil at infinity is
    the pencil at 1/q with its first n columns times q; its zeros in 0 are the infinite zeros. On the subspace S of the states reached
    silently from rest the last step is unique, and its state before is given by a nilpotent matrix N: so q^dim S is the power of q in the
    maximal minors. With the dim V finite zeros, zeta = n - sum eta counts all zeros of the pencil.

    infinite_dynamics S Z L N == the rows of Z are a basis of S*, and a Z is reached from a N Z by the faults a L, silently *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly polydiv matrix mxalgebra
  mxpoly.
From faultspace Require Import Vocabulary Basics Chain Minors FiniteZeros SilentSubspaces MorphismNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions *)
Section Definitions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
(** The rows of Z are a basis of S; the state a Z is reached from a N Z with the faults a L, with zero output. *)
Definition infinite_dynamics d (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (N : 'M[K]_d) := [/\ row_free Z,
  forall x, (x <= Z)%MS <-> exists k, silent_from_rest_at S k x,
  N *m Z *m sysA S + L *m sysF S = Z & N *m Z *m sysC S + L *m sysG S = 0].

End Definitions.

(** The characteristic polynomial of a nilpotent matrix. *)
Section Nilpotent.
Variables (K : fieldType) (d : nat) (N : 'M[K]_d).
Notation const := (map_mx (@polyC K)).
Let power k : 'M[K]_d := iter k (mulmx N) 1%:M.

Lemma char_poly_nilpotent k : power k = 0 -> char_poly N = 'X^d.
Proof.
pose G := fix G k : 'M[{poly K}]_d := if k is j.+1 then 'X *: G j + const (power j) else 0.
have geometric j : char_poly_mx N *m G j = 'X^j *: 1%:M - const (power j).
  elim: j => [|j IH]; first by rewrite mulmx0 expr0 scale1r map_mx1 subrr.
  rewrite mulmxDr -scalemxAr IH scalerBr scalerA -exprS -addrA; congr (_ + _).
  by rewrite mulmxBl mul_scalar_mx addrA addNr add0r [power _]/= map_mxM.
have all_X (t : seq nat) : \prod_(i <- t) ('X - (0 : K)%:P) = 'X^(size t).
  by rewrite polyC0 subr0 big_const_seq count_predT iter_mulr_1.
move=> nil; have : char_poly N %| \prod_(i <- iota 0 (k * d)) ('X - (0 : K)%:P).
  have := congr1 determinant (geometric k); rewrite nil map_mx0 subr0 det_mulmx detZ det1 mulr1 -exprM all_X size_iota => <-.
  exact: dvdp_mulr.
case/dvdp_prod_XsubC => t; rewrite all_X; move: (size _) => j eqX.
have e : char_poly N = 'X^j by apply/eqP; rewrite -eqp_monic ?monicXn ?char_poly_monic.
have := congr1 (fun g : {poly K} => size g) e; rewrite /= size_char_poly size_polyXn => -[dj].
by rewrite e dj.
Qed.

End Nilpotent.

Section InfiniteZeros.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).

Theorem infinite_dynamics_exists : exists (L : 'M_(\rank (silent_from_rest S n), m)) N,
  infinite_dynamics S (row_base (silent_from_rest S n)) L N.
Proof.
have := row_base_free (silent_from_rest S n); set Z := row_base _ => free.
have inZ (x : 'rV_n) : (x <= Z)%MS <-> (x <= silent_from_rest S n)%MS by rewrite eq_row_base.
clearbody Z.
have /fin_all_exists[a ha] : forall i, exists a : 'rV_(\rank (silent_from_rest S n)) * 'rV_m,
    a.1 *m Z *m sysC S + a.2 *m sysG S = 0 /\ a.1 *m Z *m sysA S + a.2 *m sysF S = row i Z.
  move=> i; have /inZ h := row_sub i Z.
  have /silent_stepP[x [w [/inZ/submxP[b ->] e f]]] : (row i Z <= silent_step S (silent_from_rest S n))%MS.
    apply: submx_trans h _; exact: (increasing (@silent_step_mono _ _ _ _ S) (leqnSn n)).
  by exists (b, w).
exists (\matrix_i (a i).2), (\matrix_i (a i).1); split=> //.
- by move=> x; rewrite inZ reachable_silently.
- by apply/row_matrixP => i; rewrite linearD /= !row_mul !rowK (ha i).2.
by apply/row_matrixP => i; rewrite linearD /= !row_mul !rowK (ha i).1 row0.
Qed.

Section Dynamics.
Variables (d : nat) (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (N : 'M[K]_d).
Hypotheses (inv : left_invertible S) (dynamics : infinite_dynamics S Z L N).

Lemma rank_infinite_dynamics : d = \rank (silent_from_rest S n).
Proof.
have [/eqP full inZ _ _] := dynamics; rewrite -[LHS]full; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  by apply/reachable_silently/inZ/row_sub.
by apply/inZ/reachable_silently/row_sub.
Qed.

(** No silent step leads from S to 0. *)
Lemma no_step_to_0 y (w : 'rV_m) : (y <= Z)%MS -> y *m sysA S + w *m sysF S = 0 -> y *m sysC S + w *m sysG S = 0 -> y = 0 /\ w = 0.
Proof.
have [_ inZ _ _] := dynamics; move=> /inZ[k [v [h e]]] next quiet.
pose u := follow k v (fun i => if i is 0%N then w else 0).
have u0 : forall j, u j = 0.
  apply: inv => j; have [jk|kj] := ltnP j k; first by rewrite output_follow_before ?h.
  rewrite -(subnKC kj) output_follow_after e; case: (j - k)%N => [|i]; first exact: quiet.
  by rewrite output_step next output_zero.
split; last by have := u0 k; rewrite /u /follow ltnn subnn.
by rewrite -e; apply: state_zero => j jk; have := u0 j; rewrite /u /follow jk.
Qed.

Lemma step_unique a x (w : 'rV_m) : (x <= Z)%MS -> x *m sysA S + w *m sysF S = a *m Z -> x *m sysC S + w *m sysG S = 0 ->
  x = a *m N *m Z /\ w = a *m L.
Proof.
have [_ _ next quiet] := dynamics; move=> xZ e f.
have [|||/eqP] := @no_step_to_0 (x - a *m N *m Z) (w - a *m L).
- by apply: addmx_sub => //; rewrite eqmx_opp submxMl.
- have back : a *m N *m Z *m sysA S + a *m L *m sysF S = a *m Z by rewrite -[in RHS]next mulmxDr !mulmxA.
  by rewrite !mulmxBl addrACA -opprD e back subrr.
- have back : a *m N *m Z *m sysC S + a *m L *m sysG S = 0 by rewrite -[RHS](mulmx0 _ a) -quiet mulmxDr !mulmxA.
  by rewrite !mulmxBl addrACA -opprD f back subrr.
by rewrite subr_eq0 => /eqP -> /eqP; rewrite subr_eq0 => /eqP ->.
Qed.

Lemma nilpotent : iter n (mulmx N) 1%:M = 0.
Proof.
have [free inZ _ _] := dynamics.
have back k (a : 'rV_d) : (a *m Z <= silent_from_rest S k)%MS -> a *m iter k (mulmx N) 1%:M = 0.
  elim: k a => [|k IH] a; first by rewrite submx0 mulmx_free_eq0 // => /eqP ->; apply: mul0mx.
  rewrite [silent_from_rest _ _]/= => /silent_stepP[x [w [xk e f]]].
  have xZ : (x <= Z)%MS by apply/inZ; exists k; apply/silent_from_restP.
  by have [xE _] := step_unique xZ f e; rewrite /= mulmxA IH // -xE.
apply/row_matrixP => i; rewrite row0 rowE; apply: back; apply/reachable_silently/inZ; exact: submxMl.
Qed.

Let E := row_mx (N *m Z) L.

Lemma silent_rows_at_infinity : const E *m pencil_at_infinity S = (- char_poly_mx N) *m const (row_mx Z 0).
Proof.
have [_ _ next quiet] := dynamics.
rewrite !map_row_mx map_mx0 mul_row_block mul_mx_row mulmx0 mulmxBr mulmx1 mulmxN -!scalemxAr -!map_mxM -addrA -opprD -scalerDr -map_mxD.
rewrite next -map_mxD quiet map_mx0 mulNmx mulmxBl mul_scalar_mx opprB -map_mxM.
by [].
Qed.

Lemma minors_at_infinity : divides_minors (pencil_at_infinity S) 'X^d /\
  exists2 g : {poly K}, ~~ root g 0 & exists C, \det (pencil_at_infinity S *m C) = g * 'X^d.
Proof.
have [free _ next quiet] := dynamics.
have freeE : row_free E.
  apply: inj_row_free => u; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[uNZ uL].
  apply/eqP; rewrite -(mulmx_free_eq0 _ free).
  have -> : u *m Z = u *m (N *m Z) *m sysA S + u *m L *m sysF S by rewrite -[in LHS]next mulmxDr !mulmxA.
  by rewrite uNZ uL !mul0mx addr0.
have freeZ : row_free (row_mx Z (0 : 'M_(d, p))).
  by apply: inj_row_free => u; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[/eqP]; rewrite mulmx_free_eq0 // => /eqP ->.
have [|divides [g g0 [C e]]] := det_attained_in_0 freeE freeZ silent_rows_at_infinity.
  move=> y; have -> : map_mx (coefp 0) (pencil_at_infinity S) = block_mx 1%:M (sysC S) 0 (sysG S).
    rewrite map_block_mx; congr block_mx; apply/matrixP => i j; rewrite !mxE /= ?coefC ?eqxx // ?coefB ?coefN coefXM ?subr0 ?oppr0 //.
    by case: (i == j); rewrite ?coef1 ?coef0.
  rewrite -[y]hsubmxK mul_row_block mulmx1 mulmx0 addr0 => /submxP[a]; rewrite mul_mx_row mulmx0 => /eq_row_mx[xE f].
  have xZ : (lsubmx y <= Z)%MS by rewrite xE submxMl.
  have [_ inZ _ _] := dynamics.
  have /submxP[b bE] : ((lsubmx y *m sysA S + rsubmx y *m sysF S)%R <= Z)%MS.
    have /inZ[k /silent_from_restP hk] := xZ; apply/inZ; exists k.+1; apply/silent_from_restP/silent_stepP.
    by exists (lsubmx y), (rsubmx y).
  by have [-> ->] := step_unique xZ bE f; rewrite -mulmxA -mul_mx_row submxMl.
have detE : \det (- char_poly_mx N) = (-1) ^+ d *: 'X^d.
  by rewrite -scaleN1r detZ -/(char_poly N) (char_poly_nilpotent nilpotent) -mul_polyC rmorphXn rmorphN1.
have sign0 : (-1) ^+ d != 0 :> K by rewrite signr_eq0.
split; first by move=> f; have := divides f; rewrite detE dvdpZl.
by exists ((-1) ^+ d *: g); [rewrite rootZ | exists C; rewrite e detE -scalerAr scalerAl].
Qed.

Theorem infinite_zeros_count : infinite_zeros S d.
Proof.
have [divides [g g0 [C e]]] := minors_at_infinity => k; split=> [/divides_minors_det/(_ C) | kd f].
  rewrite e Gauss_dvdpr; last by rewrite coprimep_expl // coprimep_sym -['X]subr0 -polyC0 coprimep_XsubC.
  by rewrite dvdp_Pexp2l // size_polyX.
by apply: dvdp_trans (divides f); rewrite dvdp_exp2l.
Qed.

End Dynamics.

(** The two counts do not depend on bases. *)
Lemma infinite_zeros_unique d d' : infinite_zeros S d -> infinite_zeros S d' -> d = d'.
Proof. by move=> h h'; apply/eqP; rewrite eqn_leq; apply/andP; split; [apply/h'/h | apply/h/h']. Qed.

Theorem number_of_infinite_zeros : left_invertible S -> infinite_zeros S (\rank (silent_from_rest S n)).
Proof. by move=> inv; have [L [N dynamics]] := infinite_dynamics_exists; apply: infinite_zeros_count dynamics. Qed.

Theorem number_of_finite_zeros : left_invertible S ->
  exists g, gcd_of_minors (pencil S) g /\ size g = (\rank (zero_holding S)).+1.
Proof.
move=> inv; have [L [M dynamics]] := zero_dynamics_exists S; exists (char_poly M).
by split; [apply: zero_polynomial dynamics | apply: size_char_poly].
Qed.

(** zeta is the number of zeros, finite and infinite, with multiplicities. *)
Theorem zeta_counts_zeros g d : left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d -> zeta S = ((size g).-1 + d)%N.
Proof.
move=> inv [div_g max_g] infinite; rewrite zeta_silent_subspaces //.
have [h [[div_h max_h] size_h]] := number_of_finite_zeros inv.
have /eqp_size -> : g %= h by rewrite /eqp max_h // max_g.
by rewrite size_h (infinite_zeros_unique infinite (number_of_infinite_zeros inv)).
Qed.

End InfiniteZeros.
