(** Finite zeros of a left-invertible system, with their multiplicities. On the subspace V of the states that can be silent for ever, the
    silent fault is unique, and moves the state by a square matrix M, the zero dynamics. The characteristic polynomial of M is the greatest
    common divisor of the maximal minors of the pencil; its roots, in any extension of K, are where the pencil loses rank; so there are
    dim V finite zeros. For a constant column that annihilates the silent pairs (x, v(0)) is a combination of columns of the pencil.

    zero_dynamics S Z L M == the rows of Z are a basis of V, and M moves them by the faults L, silently
          pencil_at S f z == the pencil at a point z of an extension of K by f *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly matrix mxalgebra mxpoly.
From faultspace Require Import Vocabulary Basics Windows Trajectory PolynomialKernel Annihilator Minors.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions *)
Section Definitions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** The rows of Z are a basis of V; with the faults a L the state a Z moves to a M Z, with zero output. *)
Definition zero_dynamics d (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (M : 'M[K]_d) := [/\ row_free Z,
  forall x, (x <= Z)%MS <-> exists v, forall k, output S x v k = 0,
  Z *m sysA S + L *m sysF S = M *m Z & Z *m sysC S + L *m sysG S = 0].

(** The pencil at a point z of an extension of K. *)
Definition pencil_at (L : fieldType) (f : {rmorphism K -> L}) (z : L) : 'M[L]_(n + m, n + p) :=
  block_mx (z%:M - map_mx f (sysA S)) (map_mx f (sysC S)) (- map_mx f (sysF S)) (map_mx f (sysG S)).

End Definitions.

Section FiniteZeros.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).

Theorem zero_dynamics_exists : exists (L : 'M_(\rank (zero_holding S), m)) M, zero_dynamics S (row_base (zero_holding S)) L M.
Proof.
have [M [L [next quiet]]] := zero_feedback S; set V := zero_holding S in M L next quiet *; set Z := row_base V.
have /submxP[R ZR] : (Z <= V)%MS by rewrite eq_row_base.
have /submxP[B VB] : (V <= Z)%MS by rewrite eq_row_base.
exists (R *m L), (R *m M *m B); split; first exact: row_base_free.
- by move=> x; rewrite eq_row_base zero_holdingP silent_for_ever.
- by rewrite -[R *m M *m B *m Z]mulmxA -VB {1}ZR -!mulmxA -mulmxDr next.
by rewrite {1}ZR -!mulmxA -mulmxDr quiet mulmx0.
Qed.

(** Columns of the pencil: what vanishes on all silent pairs (x, v(0)) of n + 1 samples. *)
Lemma column_attained (beta : 'cV[K]_n) (gamma : 'cV[K]_m) :
  (forall x v, (forall k, (k < n.+1)%N -> output S x v k = 0) -> x *m beta + v 0%N *m gamma = 0) ->
  exists y, pencil S *m y = const (col_mx beta gamma).
Proof.
set s := n.+1 => vanish; pose W := window S s.
have lin : linear (fun w : 'rV[K]_(s * m) => unsamples w 0 *m gamma).
  by move=> a u w; rewrite unsamples_linear mulmxDl -scalemxAl.
pose phi := col_mx beta (lin1_mx (fun w : 'rV[K]_(s * m) => unsamples w 0 *m gamma)).
have mul_phi x v : row_mx x (samples s v) *m phi = x *m beta + v 0%N *m gamma.
  by rewrite mul_row_col (mul_lin1 _ lin) samplesK.
have reach : W *m (pinvmx W *m phi) = phi.
  apply/eqP; rewrite -subr_eq0 mulmxA -{2}[phi]mul1mx -mulmxBl; apply/eqP/row_matrixP => i; rewrite row0 row_mul.
  have : row i (W *m pinvmx W - 1%:M) *m W = 0.
    by rewrite -row_mul mulmxBl mul1mx mulmxKpV ?submx_refl // subrr row0.
  move: (row i _) => z; rewrite -[z]hsubmxK -{1 2}[rsubmx z]unsamplesK mul_phi => /window_kernel h; apply: vanish => k ks.
  by rewrite -[RHS](h k ks); apply: output_ext => j jk; rewrite samplesK // (leq_ltn_trans jk ks).
pose h := pinvmx W *m phi; pose c k : 'cV[K]_p := (unsamples h^T k)^T.
have pair x v : pairing s (output S x v) c = x *m beta + v 0%N *m gamma.
  rewrite pairing_samples -window_response -mulmxA -mul_phi -reach; congr (_ *m (_ *m _)).
  apply: trmx_inj; rewrite trmxK -[RHS]unsamplesK; apply: samples_ext => k _; exact: trmxK.
pose b k := costate S s c (s - k).
have step k : (k < s)%N -> b k = sysA S *m b k.+1 - sysC S *m c k.
  by move=> ks; rewrite /b -(subnSK ks) /= subnSK // subKn // ltnW.
have bs : b s = 0 by rewrite /b subnn.
have value (x : 'rV_n) (v : nat -> 'rV_m) :
    \sum_(k < s) v k *m (sysG S *m c k - sysF S *m b k.+1) - x *m b 0%N = x *m beta + v 0%N *m gamma.
  by rewrite -pair (pairing_output x v step) bs mulmx0 addr0.
have b0 : b 0%N = - beta.
  apply/row_matrixP => i; rewrite !rowE; have := value (- delta_mx 0 i) (fun=> 0).
  rewrite big1 => [|k _]; last exact: mul0mx.
  by rewrite sub0r mul0mx addr0 !mulNmx opprK mulmxN.
have bc k : (k < s)%N -> sysG S *m c k - sysF S *m b k.+1 = if k is 0%N then gamma else 0.
  move=> ks; apply/row_matrixP => i; rewrite !rowE.
  have := value 0 (fun j => if j == k then delta_mx 0 i else 0); rewrite !mul0mx subr0 add0r (bigD1 (Ordinal ks)) //= eqxx.
  rewrite big1 ?addr0 => [->|j /negPf jk]; last by rewrite -[j == k :> nat]/(j == Ordinal ks) jk mul0mx.
  by case: k {ks} => [|k]; rewrite ?mul0mx ?mulmx0.
exists (col_mx (polym s (fun k => b k.+1)) (polym s c)); rewrite col_pencil map_col_mx; congr col_mx; apply/coefmP => k.
  rewrite coefmD coefmB coefmX !coefm_mull !coefm_polym coefm_const.
  have [ks|sk] := ltnP k s.
    rewrite -addrA [- _ + _]addrC -opprB -step //; case: k ks => [|k] ks; first by rewrite b0 opprK add0r.
    by rewrite coefm_polym (ltnW ks) subrr.
  rewrite !mulmx0 subr0 addr0; case: k sk => // k; rewrite ltnS leq_eqVlt coefm_polym => /orP[/eqP <-|sk].
    by rewrite ltnSn bs.
  by rewrite ltnNge sk.
rewrite coefmD coefmN !coefm_mull !coefm_polym coefm_const addrC.
have [ks|sk] := ltnP k s; first by rewrite bc //; case: k {ks}.
by rewrite !mulmx0 subr0; case: k sk.
Qed.

(** The pencil evaluated. *)
Lemma eval_const (F : fieldType) (f : {rmorphism K -> F}) (z : F) i j (N : 'M[K]_(i, j)) :
  map_mx (horner_eval z \o map_poly f) (const N) = map_mx f N.
Proof. by apply/matrixP => k l; rewrite !mxE /= map_polyC /= /horner_eval hornerC. Qed.

Lemma pencil_eval (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  map_mx (horner_eval z \o map_poly f) (pencil S) = pencil_at S f z.
Proof.
by rewrite /pencil map_block_mx map_mxN map_mxB !eval_const map_scalar_mx /= map_polyX /horner_eval hornerX.
Qed.

Section ZeroDynamics.
Variables (d : nat) (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (M : 'M[K]_d).
Hypotheses (inv : left_invertible S) (dynamics : zero_dynamics S Z L M).

Lemma silent_pair x (v : nat -> 'rV_m) : (forall k, (k < n.+1)%N -> output S x v k = 0) -> exists a, x = a *m Z /\ v 0%N = a *m L.
Proof.
have [free inZ next quiet] := dynamics; move=> silent.
have V x' : holds_zero S n x' -> (x' <= Z)%MS by move=> /silent_for_ever h; apply/inZ.
have /submxP[a xa] : (x <= Z)%MS by apply: V; exists v => j jn; apply/silent/ltnW.
have /submxP[a1 xa1] : ((x *m sysA S + v 0%N *m sysF S)%R <= Z)%MS.
  by apply: V; exists (fun i => v i.+1) => j jn; rewrite -output_step silent.
exists a; split=> //; pose w := v 0%N - a *m L.
have /inZ[u hu] : (w *m sysF S <= Z)%MS.
  apply/submxP; exists (a1 - a *m M); rewrite /w !mulmxBl -xa1 -(mulmxA a M) -next mulmxDr !mulmxA -xa.
  by rewrite opprD addrACA subrr add0r.
apply/eqP; rewrite -subr_eq0 -/w; apply/eqP; apply: (inv (v := fun k => if k is j.+1 then u j else w)) 0%N => -[|k].
  rewrite /output /= mul0mx add0r mulmxBl -mulmxA; move/eqP: quiet; rewrite addrC addr_eq0 => /eqP ->.
  by rewrite mulmxN mulmxA -xa opprK addrC; apply: (silent 0%N).
by rewrite output_step mul0mx add0r hu.
Qed.

(** The silent fault is unique. *)
Lemma zero_dynamics_unique L' M' : zero_dynamics S Z L' M' -> L' = L /\ M' = M.
Proof.
have [free inZ next _] := dynamics => -[_ _ next' quiet'].
have L'L : L' = L.
  apply/row_matrixP => i; rewrite !rowE; set a := delta_mx 0 i.
  have /inZ[u hu] : (a *m (M' *m Z) <= Z)%MS by rewrite mulmxA submxMl.
  have [|a' [aZ aL]] := @silent_pair (a *m Z) (fun k => if k is j.+1 then u j else a *m L').
    move=> [|k] _; first by rewrite /output /= -!mulmxA -mulmxDr quiet' mulmx0.
    by rewrite output_step -!mulmxA -mulmxDr next' hu.
  by rewrite aL; congr (_ *m _); apply: (row_free_inj free).
split=> //; apply: (row_free_inj free); by rewrite -next -next' L'L.
Qed.

Let E := row_mx Z L.

Lemma silent_rows : const E *m pencil S = char_poly_mx M *m const (row_mx Z 0).
Proof.
have [_ _ next quiet] := dynamics.
rewrite !map_row_mx map_mx0 mul_row_block mul_mx_row mulmx0 mulmxBr mulmxN -!map_mxM -addrA -opprD -map_mxD next -map_mxD quiet map_mx0.
by rewrite mulmxBl mul_mx_scalar mul_scalar_mx map_mxM.
Qed.

Lemma minors_attained : divides_minors (pencil S) (char_poly M) /\ exists2 c, c != 0 & exists C, \det (pencil S *m C) = c *: char_poly M.
Proof.
have [free _ _ _] := dynamics; have freeE : row_free E.
  by apply: inj_row_free => u; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[/eqP]; rewrite mulmx_free_eq0 // => /eqP ->.
have freeZ : row_free (row_mx Z (0 : 'M_(d, p))).
  by apply: inj_row_free => u; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[/eqP]; rewrite mulmx_free_eq0 // => /eqP ->.
apply: det_attained freeE freeZ silent_rows _ => y; rewrite -[y]vsubmxK mul_row_col => Ey.
apply: column_attained => x v /silent_pair[a [-> ->]].
by rewrite -!mulmxA -mulmxDr Ey mulmx0.
Qed.

(** Headlines. *)
Theorem zero_polynomial : gcd_of_minors (pencil S) (char_poly M).
Proof. have [divides attained] := minors_attained; exact: attained_gcd. Qed.

Theorem finite_zeros (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  (\rank (pencil_at S f z) < n + m)%N = root (map_poly f (char_poly M)) z.
Proof.
by have [divides attained] := minors_attained; rewrite -(attained_rank divides attained) pencil_eval.
Qed.

Lemma rank_zero_dynamics : d = \rank (zero_holding S).
Proof.
have [/eqP full inZ _ _] := dynamics; rewrite -[LHS]full; apply: eqmx_rank; apply/andP; split; apply/row_subP => i.
  by apply/zero_holdingP/silent_for_ever/inZ/row_sub.
by apply/inZ/silent_for_ever/zero_holdingP/row_sub.
Qed.

End ZeroDynamics.
End FiniteZeros.
