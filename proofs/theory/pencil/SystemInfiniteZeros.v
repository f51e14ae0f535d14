(** Infinite zeros of every system, with their multiplicities: dim S - dim (V n S), as the power of q in the minors of order n + gap n of
    the pencil at infinity. The last silent step to a state of S comes from a state that is given, modulo V n S, by a nilpotent matrix N.
    So, for every system, n = left indices + right indices + finite zeros + infinite zeros, and zeta is the sum of the last three.

    dynamics_at_infinity S Z X L N == the rows of Z are a basis of S* modulo R, reached silently from X by L, and X is N Z modulo R *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra mxpoly vector zify.
From faultspace Require Import Vocabulary Chain Indices SilentSubspaces RightIndices.
From faultspace Require Import InfiniteZeros MinorsOfOrder SystemZeros SystemZeroPolynomial MorphismNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions *)
Section Definitions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Definition dynamics_at_infinity d (Z X : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (N : 'M[K]_d) := [/\ row_free Z, (Z :&: both S)%MS = 0,
  (Z + both S :=: silent_from_rest S n)%MS, (X - N *m Z <= both S)%MS & X *m sysA S + L *m sysF S = Z /\ X *m sysC S + L *m sysG S = 0].

End Definitions.

Section SystemInfiniteZeros.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).
Notation at0 := (map_mx (horner_eval 0)).
Notation R := (both S).
Notation Q := (row_base (both S)).

Lemma dynamics_at_infinity_exists : exists d (Z X : 'M_(d, n)) L N, dynamics_at_infinity S Z X L N.
Proof.
pose V := silent_from_rest S n; pose Z := row_base (V :\: R)%MS; have free : row_free Z := row_base_free _.
have sum : (Z + R :=: V)%MS.
  apply: eqmx_trans (adds_eqmx (eq_row_base _) (eqmx_refl _)) _; apply: eqmx_trans _ (addsmx_diff_cap_eq V R).
  by apply: adds_eqmx => //; apply/eqmx_sym/capmx_idPr/capmxSr.
have cap : (Z :&: R)%MS = 0.
  by apply/eqP; rewrite -submx0 -(capmx_diff V R) capmxS ?submx_refl // eq_row_base.
clearbody Z; have ZV i : (row i Z <= V)%MS by rewrite -sum; apply: submx_trans (row_sub i Z) (addsmxSl _ _).
have /fin_all_exists[a ha] : forall i, exists a : 'rV_n * 'rV_m * 'rV_(\rank (V :\: R)), [/\ ((a.1.1 - a.2 *m Z)%R <= R)%MS,
    a.1.1 *m sysA S + a.1.2 *m sysF S = row i Z & a.1.1 *m sysC S + a.1.2 *m sysG S = 0].
  move=> i; have /silent_stepP[x [w [xV e f]]] : (row i Z <= silent_step S V)%MS.
    exact: submx_trans (ZV i) (increasing (@silent_step_mono _ _ _ _ S) (leqnSn n)).
  have /sub_addsmxP[[b c] /= h] : (x <= Z + R)%MS by rewrite sum.
  by exists (x, w, b); split=> //=; rewrite h addrAC subrr add0r submxMl.
exists _, Z, (\matrix_i (a i).1.1), (\matrix_i (a i).1.2), (\matrix_i (a i).2); split=> //.
  by apply/row_subP => i; rewrite linearB /= !row_mul !rowK; have [] := ha i.
by split; apply/row_matrixP => i; rewrite linearD /= !row_mul !rowK ?row0; have [] := ha i.
Qed.

Lemma step_back x (w : 'rV_m) : (x <= silent_from_rest S n)%MS -> ((x *m sysA S + w *m sysF S)%R <= zero_holding S)%MS ->
  x *m sysC S + w *m sysG S = 0 -> (x <= R)%MS.
Proof.
move=> xS nV e; rewrite sub_capmx xS andbT; apply: submx_trans (_ : (_ <= hold_step S (zero_holding S))%MS) _.
  by apply/hold_stepP; exists w.
exact: (iter_decreasing (@hold_step_mono _ _ _ _ S) (leqnSn n)).
Qed.

Section Dynamics.
Variables (d : nat) (Z X : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (N : 'M[K]_d).
Hypothesis dynamics : dynamics_at_infinity S Z X L N.
Let E := col_mx (within S) (row_mx X L).

Lemma X_from_rest : (X <= silent_from_rest S n)%MS.
Proof.
have [_ _ sum XN _] := dynamics; rewrite -sum -[X](subrK (N *m Z)) addrC; apply: addmx_sub_adds XN; exact: submxMl.
Qed.

Lemma back a x (w : 'rV_m) y : (x <= silent_from_rest S n)%MS -> x *m sysC S + w *m sysG S = 0 -> x *m sysA S + w *m sysF S = a *m Z + y ->
  (y <= R)%MS -> ((x - a *m X)%R <= R)%MS /\ (row_mx (x - a *m X) (w - a *m L) <= within S)%MS.
Proof.
have [_ _ _ _ [next quiet]] := dynamics; move=> xS e f yR.
have nextE : (x - a *m X) *m sysA S + (w - a *m L) *m sysF S = y.
  by rewrite !mulmxBl addrACA -opprD f -!mulmxA -mulmxDr next addrC addKr.
have quietE : (x - a *m X) *m sysC S + (w - a *m L) *m sysG S = 0.
  by rewrite !mulmxBl addrACA -opprD e -!mulmxA -mulmxDr quiet mulmx0 subr0.
have yV : (y <= zero_holding S)%MS := submx_trans yR (capmxSl _ _).
have inR : ((x - a *m X)%R <= R)%MS.
  apply: step_back quietE; last by rewrite nextE.
  by apply: addmx_sub => //; rewrite eqmx_opp; apply: submx_trans (submxMl _ _) X_from_rest.
by split=> //; apply/pairsR; split=> //; rewrite nextE.
Qed.

Lemma nilpotent_at_infinity : iter n (mulmx N) 1%:M = 0.
Proof.
have [free cap sum XN _] := dynamics.
have vanish k (a : 'rV_d) y : (y <= R)%MS -> ((a *m Z + y)%R <= silent_from_rest S k)%MS -> a *m iter k (mulmx N) 1%:M = 0.
  elim: k a y => [|k IH] a y yR.
    rewrite submx0 addr_eq0 => /eqP aZ; rewrite mulmx1; apply/eqP; rewrite -(mulmx_free_eq0 _ free) -submx0 -cap sub_capmx submxMl.
    by rewrite aZ eqmx_opp.
  rewrite [silent_from_rest _ _]/= => /silent_stepP[x [w [xk e f]]].
  have xS := submx_trans xk (increasing_constant (@silent_step_mono _ _ _ _ S) k).
  have [inR _] := back xS e f yR; rewrite /= mulmxA; apply: (IH _ (x - a *m X + a *m (X - N *m Z))).
    by apply: addmx_sub => //; apply: submx_trans (submxMl _ _) XN.
  by rewrite mulmxBr mulmxA [x - _ + _]addrA subrK addrC subrK.
apply/row_matrixP => i; rewrite row0 rowE; apply: (vanish _ _ 0); rewrite ?sub0mx // addr0.
by rewrite -sum; apply: submx_trans (submxMl _ _) (addsmxSl _ _).
Qed.

Lemma E_free_at_infinity : row_free E.
Proof.
have [free cap _ _ [next _]] := dynamics; apply: inj_row_free => c; rewrite -[c]hsubmxK mul_row_col.
move: (lsubmx c) (rsubmx c) => a b e.
have step u : u *m (lsubmx (within S) *m sysA S + rsubmx (within S) *m sysF S) = u *m within S *m col_mx (sysA S) (sysF S).
  by rewrite -{3}[within S]hsubmxK -mulmxA mul_row_col.
have b0 : b = 0.
  apply/eqP; rewrite -(mulmx_free_eq0 _ free) -submx0 -cap sub_capmx submxMl /= -next -mul_row_col mulmxA.
  move/eqP: e; rewrite addrC addr_eq0 => /eqP ->; rewrite mulNmx eqmx_opp -step.
  by apply: submx_trans (submxMl _ _) (NR_sub S).
by move/eqP: e; rewrite b0 mul0mx addr0 mulmx_free_eq0 ?row_base_free // => /eqP ->; rewrite row_mx0.
Qed.

(** The rows at infinity. *)
Lemma rows_at_infinity k (Y : 'M_(k, n)) (W : 'M_(k, m)) : const (row_mx Y W) *m pencil_at_infinity S =
  row_mx (const Y - 'X *: const (Y *m sysA S + W *m sysF S)) (const (Y *m sysC S + W *m sysG S)).
Proof.
rewrite map_row_mx mul_row_block mulmxBr mulmx1 mulmxN -!scalemxAr -!map_mxM -addrA -opprD -scalerDr -!map_mxD.
by [].
Qed.

Lemma pencil_at_infinity_0 : at0 (pencil_at_infinity S) = block_mx 1%:M (sysC S) 0 (sysG S).
Proof.
rewrite map_block_mx; congr block_mx; apply/matrixP => i j; rewrite !mxE /horner_eval ?hornerC //.
  by rewrite hornerD hornerN hornerM hornerX mul0r subr0; case: (i == j); rewrite ?hornerC // horner0.
by rewrite hornerN hornerM hornerX mul0r oppr0.
Qed.

Lemma minors_of_order_at_infinity : exists B Xc Nc,
  [/\ const E *m pencil_at_infinity S =
        block_mx (const Xc - 'X *: const Nc) 0 (const B) (- char_poly_mx N) *m const (row_mx (col_mx Q Z) 0),
      row_free (row_mx (col_mx Q Z) (0 : 'M_(_, p))) & exists J, J *m Xc = 1%:M].
Proof.
have [free cap _ XN [next quiet]] := dynamics; have QR : (Q :=: R)%MS := eq_row_base R; have freeQ := row_base_free R.
move: Q QR freeQ => Q0 QR freeQ.
have /submxP[Xc XQ] : (states_within S <= Q0)%MS by rewrite QR XR_sub.
have /submxP[Nc NQ] : (next_within S <= Q0)%MS by rewrite QR NR_sub.
have /submxP[B BQ] : ((X - N *m Z)%R <= Q0)%MS by rewrite QR.
exists B, Xc, Nc; split.
- rewrite map_col_mx mul_col_mx -[within S]hsubmxK !rows_at_infinity -/(next_within S) quiet_within quiet !map_mx0.
  rewrite -block_mxEv block_mxEh col_mx0 map_row_mx map_col_mx map_mx0 mul_mx_row mulmx0 mul_block_col mul0mx addr0.
  congr (row_mx (col_mx _ _) _); first by rewrite -/(states_within S) XQ NQ !map_mxM mulmxBl -scalemxAl.
  by rewrite next -map_mxM -BQ opprB mulmxBl mul_scalar_mx -map_mxM map_mxB addrA subrK.
- apply: inj_row_free => c; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[].
  rewrite -[c]hsubmxK mul_row_col; move: (lsubmx c) (rsubmx c) => a b e _.
  have b0 : b = 0.
    apply/eqP; rewrite -(mulmx_free_eq0 _ free) -submx0 -cap sub_capmx submxMl /=.
    by move/eqP: e; rewrite addrC addr_eq0 => /eqP ->; rewrite eqmx_opp -QR submxMl.
  by move/eqP: e; rewrite b0 mul0mx addr0 mulmx_free_eq0 // => /eqP ->; rewrite row_mx0.
have /submxP[J JX] : (Q0 <= states_within S)%MS.
  rewrite QR; apply/row_subP => i; have iR := row_sub i R.
  have [w [e h]] := hold_next (submx_trans iR (capmxSl _ _)).
  have /submxP[c] : (row_mx (row i R) w <= within S)%MS by apply/pairsR.
  by rewrite -[within S]hsubmxK mul_mx_row => /eq_row_mx[-> _]; apply: submxMl.
by exists J; apply: (row_free_inj freeQ); rewrite mul1mx -mulmxA -XQ.
Qed.

Theorem system_infinite_zeros_count : system_infinite_zeros S d.
Proof.
have [B [Xc [Nc [rows freeZ [J JX]]]]] := minors_of_order_at_infinity.
have order : (\rank R + d + (n + m - (\rank (kermx (within_conditions S)) + d)) = n + gap S n)%N.
  have [d' [Z' [L' [M' dyn]]]] := quotient_dynamics_exists S; have := rank_pairs dyn.
  have := rank_leq_col (pair_rows S Z' L'); rewrite (eqP (E_free dyn)).
  have := rank_leq_col E; rewrite (eqP E_free_at_infinity); lia.
have left : J *m at0 (const Xc - 'X *: const Nc) = 1%:M.
  rewrite -JX; congr (_ *m _); apply/matrixP => i j.
  by rewrite !mxE /horner_eval hornerD hornerN hornerM hornerX mul0r subr0 hornerC.
have in_0 (y : 'rV_(n + m)) : (y *m at0 (pencil_at_infinity S) <= row_mx (col_mx Q Z) (0 : 'M_(_, p)))%MS -> (y <= E)%MS.
  rewrite pencil_at_infinity_0 -[y]hsubmxK mul_row_block mulmx1 mulmx0 addr0 => /submxP[c]; rewrite mul_mx_row mulmx0.
  case/eq_row_mx; move: (lsubmx y) (rsubmx y) => x w xE f.
  have [_ _ sum _ _] := dynamics.
  have xS : (x <= silent_from_rest S n)%MS.
    rewrite xE -[c]hsubmxK mul_row_col -sum addrC; apply: addmx_sub_adds; first exact: submxMl.
    by apply: submx_trans (submxMl _ _) _; rewrite eq_row_base.
  have : ((x *m sysA S + w *m sysF S)%R <= Z + R)%MS by rewrite sum; apply: silent_step_from_rest.
  case/sub_addsmxP => -[a b] /= e; have [_ inE] := back xS f e (submxMl _ _).
  have -> : row_mx x w = row_mx (x - a *m X) (w - a *m L) + a *m row_mx X L by rewrite mul_mx_row add_row_mx !subrK.
  by rewrite -addsmxE addmx_sub_adds ?submxMl.
have divides := det_divides_highest_minors E_free_at_infinity rows.
have := highest_minor_in_0 E_free_at_infinity freeZ rows left in_0; rewrite order in divides *.
have detE : \det (- char_poly_mx N) = (-1) ^+ d *: 'X^d.
  by rewrite -scaleN1r detZ -/(char_poly N) (char_poly_nilpotent nilpotent_at_infinity) -mul_polyC rmorphXn rmorphN1.
have sign0 : (-1) ^+ d != 0 :> K by rewrite signr_eq0.
rewrite detE in divides *; move=> [g g0 [B0 [C0 e]]] k; split=> [/divides_minors_of_order_det/(_ B0 C0) | kd h f].
  rewrite e -scalerAr dvdpZr // Gauss_dvdpr; last by rewrite coprimep_expl // coprimep_sym -['X]subr0 -polyC0 coprimep_XsubC.
  by rewrite dvdp_Pexp2l // size_polyX.
by have := divides h f; rewrite dvdpZl //; apply: dvdp_trans; rewrite dvdp_exp2l.
Qed.

Lemma rank_dynamics_at_infinity : d = (\rank (silent_from_rest S n) - \rank R)%N.
Proof.
have [/eqP free cap sum _ _] := dynamics; have := mxrank_sum_cap Z R; rewrite cap mxrank0 addn0 free sum => ->.
by rewrite addnK.
Qed.

End Dynamics.

Theorem number_of_system_infinite_zeros : system_infinite_zeros S (\rank (silent_from_rest S n) - \rank R).
Proof.
have [d [Z [X [L [N dyn]]]]] := dynamics_at_infinity_exists; rewrite -(rank_dynamics_at_infinity dyn).
exact: system_infinite_zeros_count dyn.
Qed.

(** L1, second half: for every system, n is the sum of the left and the right indices and the numbers of finite and infinite zeros. *)
Theorem order_of_system c k (U : 'M_(n + p, c)) (Y : 'M_(n + m, k)) g d :
  minimal_basis (pencil S) U -> minimal_basis (pencil S)^T Y ->
  gcd_of_minors_of_order (n + gap S n) (pencil S) g -> system_infinite_zeros S d ->
  n = (\sum_(j < c) degree U j + \sum_(j < k) degree Y j + (size g).-1 + d)%N.
Proof.
move=> basis_U basis_Y [div_g max_g] infinite; rewrite {1}(dimension_balance basis_U basis_Y).
have [h [[div_h max_h] size_h]] := number_of_system_zeros S; have /eqp_size -> : g %= h by rewrite /eqp max_h // max_g.
rewrite size_h; congr (_ + _ + _)%N; have count := number_of_system_infinite_zeros.
by apply/eqP; rewrite eqn_leq; apply/andP; split; [apply/infinite/count | apply/count/infinite].
Qed.

(** And zeta = n - sum eta is the sum of the last three. *)
Theorem zeta_system k (Y : 'M_(n + m, k)) g d : minimal_basis (pencil S)^T Y ->
  gcd_of_minors_of_order (n + gap S n) (pencil S) g -> system_infinite_zeros S d ->
  zeta S = (\sum_(j < k) degree Y j + (size g).-1 + d)%N.
Proof.
move=> basis_Y gcd_g infinite; have [U basis_U] := pencil_minimal_basis S; rewrite /zeta.
rewrite {1}(order_of_system basis_U basis_Y gcd_g infinite) -(perm_sumn (etas_are_minimal_indices basis_U)).
by rewrite sumnE big_map big_enum -!addnA addKn.
Qed.

End SystemInfiniteZeros.
