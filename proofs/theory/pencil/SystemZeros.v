(** Finite zeros of every system. With V and S of SilentSubspaces.v and R = V n S, the silent motions on V move V / R
    by one square matrix M, of dim V - dim R rows, and at every point z of every extension of K
        rank of the pencil at z = n + gap n - dim V / R + rank (z I - M),
    so the rank is less than the normal rank exactly at the eigenvalues of M, by the dimension of the eigenspace. For constant columns that
    annihilate the silent pairs (x, v(0)) are combinations of columns of the pencil, and R can be reached within R (Hautus' test).

                       both S == R, the states of V (silent for ever) that are reached silently from rest
    quotient_dynamics S Z L M == the rows of Z are a basis of V modulo R, and M moves them by the faults L, silently, modulo R
          within_conditions S == what vanishes on the pairs (x, v) with x in R that lead into V with zero output
                     within S == rows (x, v): a basis of the silent pairs that lead from R into R
              states_within S == their states x
                next_within S == the states into which they lead
              pair_rows S Z L == these pairs, and the rows (Z, L): a basis of the silent pairs on V *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra mxpoly vector fraction zify.
From faultspace Require Import Vocabulary Basics Chain NormalRank Trajectory TransferRank.
From faultspace Require Import FiniteZeros SilentSubspaces.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions *)
Section Definitions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** The states of V that are reached silently from rest, and a silent motion on V, modulo them. *)
Definition both : 'M[K]_n := (zero_holding S :&: silent_from_rest S n)%MS.
Definition quotient_dynamics d (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (M : 'M[K]_d) := [/\ row_free Z,
  (Z :&: both)%MS = 0, (Z + both :=: zero_holding S)%MS,
  (Z *m sysA S + L *m sysF S - M *m Z <= both)%MS & Z *m sysC S + L *m sysG S = 0].

End Definitions.

Section SystemZeros.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).
Notation V := (zero_holding S).
Notation R := (both S).

Lemma hold_next x : (x <= V)%MS -> exists w : 'rV_m, x *m sysC S + w *m sysG S = 0 /\ ((x *m sysA S + w *m sysF S)%R <= V)%MS.
Proof.
move=> xV; apply/hold_stepP; apply: submx_trans xV _.
exact: (iter_constant (@hold_step_mono _ _ _ _ S) (leqnSn n)).
Qed.

Theorem quotient_dynamics_exists : exists d (Z : 'M_(d, n)) L M, quotient_dynamics S Z L M.
Proof.
pose Z := row_base (V :\: R)%MS; have free : row_free Z := row_base_free _.
have sum : (Z + R :=: V)%MS.
  apply: eqmx_trans (adds_eqmx (eq_row_base _) (eqmx_refl _)) _; apply: eqmx_trans _ (addsmx_diff_cap_eq V R).
  by apply: adds_eqmx => //; apply/eqmx_sym/capmx_idPr/capmxSl.
have cap : (Z :&: R)%MS = 0.
  by apply/eqP; rewrite -submx0 -(capmx_diff V R) capmxS ?submx_refl // eq_row_base.
clearbody Z; have ZV i : (row i Z <= V)%MS by rewrite -sum; apply: submx_trans (row_sub i Z) (addsmxSl _ _).
have /fin_all_exists[a ha] : forall i, exists a : 'rV_m * 'rV_(\rank (V :\: R)), row i Z *m sysC S + a.1 *m sysG S = 0 /\
    ((row i Z *m sysA S + a.1 *m sysF S - a.2 *m Z)%R <= R)%MS.
  move=> i; have [w [e]] := hold_next (ZV i); rewrite -sum => /sub_addsmxP[[b c] /= h].
  by exists (w, b); split=> //=; rewrite h addrAC subrr add0r submxMl.
exists _, Z, (\matrix_i (a i).1), (\matrix_i (a i).2); split=> //.
  by apply/row_subP => i; rewrite !linearD linearN /= !row_mul !rowK (ha i).2.
by apply/row_matrixP => i; rewrite linearD /= !row_mul !rowK (ha i).1 row0.
Qed.

(** The silent pairs within R. *)
Definition within_conditions : 'M[K]_(n + m, n + (n + p)) :=
  col_mx (row_mx (cokermx R) (row_mx (sysA S *m cokermx V) (sysC S))) (row_mx 0 (row_mx (sysF S *m cokermx V) (sysG S))).
Definition within := row_base (kermx within_conditions).
Notation ER := within.

Lemma pairsR x (w : 'rV_m) : (row_mx x w <= ER)%MS <->
  [/\ (x <= R)%MS, ((x *m sysA S + w *m sysF S)%R <= V)%MS & x *m sysC S + w *m sysG S = 0].
Proof.
rewrite eq_row_base (sameP sub_kermxP eqP) /within_conditions !submxE; move: (cokermx R) (cokermx V) => cR cV.
rewrite mul_row_col !mul_mx_row !add_row_mx mulmx0 addr0 !mulmxA -mulmxDl.
split=> [/eqP | [/eqP -> /eqP -> ->]]; last by rewrite !row_mx0.
by rewrite -[X in _ = X -> _]row_mx0 -[X in _ = row_mx _ X -> _]row_mx0 => /eq_row_mx[-> /eq_row_mx[-> ->]]; rewrite eqxx.
Qed.

Definition states_within := lsubmx ER.
Notation XR := states_within.
Definition next_within := XR *m sysA S + rsubmx ER *m sysF S.
Notation NR := next_within.

Lemma row_ER i : row_mx (row i XR) (row i (rsubmx ER)) = row i ER.
Proof. by rewrite -row_row_mx hsubmxK. Qed.

Lemma XR_sub : (XR <= R)%MS.
Proof. by apply/row_subP => i; have := row_sub i ER; rewrite -row_ER => /pairsR[]. Qed.

Lemma silent_step_from_rest x (w : 'rV_m) : (x <= silent_from_rest S n)%MS -> x *m sysC S + w *m sysG S = 0 ->
  ((x *m sysA S + w *m sysF S)%R <= silent_from_rest S n)%MS.
Proof.
move=> xS e; apply: submx_trans (increasing_constant (@silent_step_mono _ _ _ _ S) n.+1).
by apply/silent_stepP; exists x, w.
Qed.

Lemma NR_sub : (NR <= R)%MS.
Proof.
apply/row_subP => i; have := row_sub i ER; rewrite -row_ER => /pairsR[xR nV e].
rewrite linearD /= !row_mul sub_capmx nV /=; apply: silent_step_from_rest e.
by apply: submx_trans xR (capmxSr _ _).
Qed.

(** On a silent way from rest to a state of V all states are in R. *)
Lemma silent_way N v : (forall j, (j < N)%N -> output S 0 v j = 0) -> (state S 0 v N <= V)%MS ->
  forall k, (k <= N)%N -> (state S 0 v k <= R)%MS.
Proof.
move=> h /zero_holdingP/silent_for_ever[u hu] k kN; rewrite sub_capmx; apply/andP; split.
  apply/zero_holdingP/silent_for_ever; exists (fun j => follow N v u (k + j)%N) => j.
  rewrite -(state_follow_before S 0 v u kN) -output_shift.
  have [kj|Nk] := ltnP (k + j) N; first by rewrite output_follow_before ?h.
  by rewrite -(subnKC Nk) output_follow_after hu.
apply: submx_trans (increasing_constant (@silent_step_mono _ _ _ _ S) k); apply/silent_from_restP; exists v; split=> // j jk.
by apply: h; apply: leq_trans kN.
Qed.

Lemma silent_way_pairs N v : (forall j, (j < N)%N -> output S 0 v j = 0) -> (state S 0 v N <= V)%MS ->
  forall k, (k < N)%N -> (row_mx (state S 0 v k) (v k) <= ER)%MS.
Proof.
move=> h hV k kN; have inR := silent_way h hV; apply/pairsR; split; [exact/inR/ltnW | | exact: h].
by apply: submx_trans (inR _ kN) (capmxSl _ _).
Qed.

(** Hautus' test. *)
Lemma reached_within (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  (map_mx f R <= z *: map_mx f XR - map_mx f NR)%MS.
Proof.
rewrite submxE; set lambda := cokermx _.
have eigen : map_mx f NR *m lambda = z *: (map_mx f XR *m lambda).
  by have := mulmx_coker (z *: map_mx f XR - map_mx f NR); rewrite -/lambda mulmxBl -scalemxAl => /eqP; rewrite subr_eq0 => /eqP ->.
apply/eqP/row_matrixP => i; rewrite row0 row_mul -map_row.
have := row_sub i R; move: (row i R) => y; rewrite {1}sub_capmx => /andP[yV /silent_from_restP[v [h e]]].
rewrite -e in yV *; suff : forall k, (k <= n)%N -> map_mx f (state S 0 v k) *m lambda = 0 by apply.
elim=> [|k IH] kn; first by rewrite map_mx0 mul0mx.
have /submxP[c] := silent_way_pairs h yV kn.
rewrite -[ER]hsubmxK mul_mx_row => /eq_row_mx[xE vE].
have -> : state S 0 v k.+1 = c *m NR by rewrite /= xE vE -!mulmxA -mulmxDr.
by rewrite map_mxM -mulmxA eigen -scalemxAr mulmxA -map_mxM -xE IH ?scaler0 // ltnW.
Qed.

Lemma rows_pencil (F : fieldType) (f : {rmorphism K -> F}) (z : F) k (X : 'M_(k, n)) (W : 'M_(k, m)) :
  map_mx f (row_mx X W) *m pencil_at S f z =
  row_mx (z *: map_mx f X - map_mx f (X *m sysA S + W *m sysF S)) (map_mx f (X *m sysC S + W *m sysG S)).
Proof.
by rewrite map_row_mx mul_row_block mulmxBr mul_mx_scalar mulmxN -!map_mxM -addrA -opprD -!map_mxD.
Qed.

Section Dynamics.
Variables (d : nat) (Z : 'M[K]_(d, n)) (L : 'M[K]_(d, m)) (M : 'M[K]_d).
Hypothesis dynamics : quotient_dynamics S Z L M.
Definition pair_rows := col_mx ER (row_mx Z L).
Notation E := pair_rows.

Lemma E_free : row_free E.
Proof.
have [free cap _ _ _] := dynamics; apply: inj_row_free => c; rewrite -[c]hsubmxK mul_row_col.
move: (lsubmx c) (rsubmx c) => a b e.
have b0 : b = 0.
  apply/eqP; rewrite -(mulmx_free_eq0 _ free) -submx0 -cap sub_capmx submxMl /=.
  have := congr1 lsubmx e; rewrite linear0 linearD /= mul_mx_row row_mxKl => /eqP; rewrite addrC addr_eq0 => /eqP ->.
  have -> : lsubmx (a *m ER) = a *m XR by rewrite -{1}[ER]hsubmxK mul_mx_row row_mxKl.
  by rewrite eqmx_opp; apply: submx_trans (submxMl _ _) XR_sub.
move: e; rewrite b0 mul0mx addr0 => /eqP; rewrite mulmx_free_eq0 ?row_base_free // => /eqP ->.
exact: row_mx0.
Qed.

Lemma silent_pair_sub x (v : nat -> 'rV_m) : (forall k, (k < n.+1)%N -> output S x v k = 0) -> (row_mx x (v 0%N) <= E)%MS.
Proof.
have [_ _ sum next quiet] := dynamics; move=> silent.
have nextV : ((x *m sysA S + v 0%N *m sysF S)%R <= V)%MS.
  by apply/zero_holdingP; exists (fun i => v i.+1) => j jn; rewrite -output_step silent.
have : (x <= Z + R)%MS by rewrite sum; apply/zero_holdingP; exists v => j jn; apply/silent/ltnW.
case/sub_addsmxP => -[a b] /= xE; set y := b *m R in xE.
have -> : row_mx x (v 0%N) = row_mx y (v 0%N - a *m L) + a *m row_mx Z L.
  by rewrite mul_mx_row add_row_mx subrK xE addrC.
have yA : y *m sysA S = x *m sysA S - a *m Z *m sysA S by rewrite xE mulmxDl addrC addKr.
have yC : y *m sysC S = x *m sysC S - a *m Z *m sysC S by rewrite xE mulmxDl addrC addKr.
rewrite -addsmxE addmx_sub_adds ?submxMl //; apply/pairsR; split; first exact: submxMl.
  rewrite yA mulmxBl addrACA -opprD; apply: addmx_sub => //; rewrite eqmx_opp -!mulmxA -mulmxDr; apply: submx_trans (submxMl _ _) _.
  rewrite -sum -[_ + _](subrK (M *m Z)) addrC; apply: addmx_sub_adds next; exact: submxMl.
have := silent 0%N isT; rewrite /output /= yC mulmxBl addrACA -opprD => ->.
by rewrite -!mulmxA -mulmxDr quiet mulmx0 subr0.
Qed.

(** The constant columns that E annihilates are columns of the pencil. *)
Lemma kernel_attained (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  (kermx (map_mx f E)^T <= (pencil_at S f z)^T)%MS.
Proof.
have /fin_all_exists[x hx] : forall i, exists x, pencil S *m x = const (row i (kermx E^T))^T.
  move=> i; have : E *m (row i (kermx E^T))^T = 0.
    by apply: trmx_inj; rewrite trmx_mul trmxK trmx0; apply/sub_kermxP/row_sub.
  move: (row i _)^T => y; rewrite -{1}[y]vsubmxK => Ey; rewrite -[y]vsubmxK; apply: column_attained => x v /silent_pair_sub/submxP[c e].
  by rewrite -mul_row_col e -mulmxA Ey mulmx0.
rewrite map_trmx -map_kermx; apply/row_subP => i; rewrite -map_row; pose ev := horner_eval z \o map_poly f.
apply/submxP; exists (map_mx ev (x i))^T; by rewrite -trmx_mul -pencil_eval -map_mxM hx eval_const -map_trmx trmxK.
Qed.

(** The rows of E in the pencil, in coordinates of R and Z. *)
Lemma quiet_within : XR *m sysC S + rsubmx ER *m sysG S = 0.
Proof.
apply/row_matrixP => i; have := row_sub i ER; rewrite -row_ER => /pairsR[_ _ e].
by rewrite linearD /= !row_mul row0.
Qed.

Lemma coordinates : exists X N H, [/\ XR = X *m row_base R, NR = N *m row_base R &
  Z *m sysA S + L *m sysF S - M *m Z = H *m row_base R].
Proof.
have [_ _ _ next _] := dynamics; have QR : (row_base R :=: R)%MS := eq_row_base R; move: (row_base R) QR => Q QR.
have /submxP[X XQ] : (XR <= Q)%MS by rewrite QR XR_sub.
have /submxP[N NQ] : (NR <= Q)%MS by rewrite QR NR_sub.
have /submxP[H HQ] : ((Z *m sysA S + L *m sysF S - M *m Z)%R <= Q)%MS by rewrite QR.
by exists X, N, H.
Qed.

Lemma coordinates_free : row_free (row_mx (col_mx (row_base R) Z) (0 : 'M_(_, p))).
Proof.
have [freeZ cap _ _ _] := dynamics; have QR : (row_base R :=: R)%MS := eq_row_base R; have := row_base_free R.
move: (row_base R) QR => Q QR freeQ.
apply: inj_row_free => c; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[].
rewrite -[c]hsubmxK mul_row_col; move: (lsubmx c) (rsubmx c) => a b e _.
have b0 : b = 0.
  apply/eqP; rewrite -(mulmx_free_eq0 _ freeZ) -submx0 -cap sub_capmx submxMl /=.
  by move/eqP: e; rewrite addrC addr_eq0 => /eqP ->; rewrite eqmx_opp -QR submxMl.
by move/eqP: e; rewrite b0 mul0mx addr0 mulmx_free_eq0 // => /eqP ->; rewrite row_mx0.
Qed.

Lemma rank_E_pencil (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  \rank (map_mx f E *m pencil_at S f z) = (\rank R + \rank (z%:M - map_mx f M)%R)%N.
Proof.
have [_ _ _ _ quiet] := dynamics; have [X [N [H [XQ NQ HQ]]]] := coordinates.
pose Q := row_base R; have QR : (Q :=: R)%MS := eq_row_base R.
have freeQ : row_free Q := row_base_free R; have freeB := coordinates_free; rewrite -/Q in XQ NQ HQ freeB.
pose D := z *: map_mx f X - map_mx f N.
have fullD : row_full D.
  have : (map_mx f Q <= D *m map_mx f Q)%MS.
    have -> : D *m map_mx f Q = z *: map_mx f XR - map_mx f NR by rewrite XQ NQ !map_mxM mulmxBl -scalemxAl.
    apply: submx_trans (reached_within f z); rewrite map_submx; by rewrite QR.
  case/submxP => J JQ; apply/row_fullP; exists J; have /row_free_inj inj : row_free (map_mx f Q) by rewrite row_free_map.
  by apply: inj; rewrite mul1mx -mulmxA -JQ.
have -> : map_mx f E *m pencil_at S f z = block_mx D 0 (- map_mx f H) (z%:M - map_mx f M) *m map_mx f (row_mx (col_mx Q Z) 0).
  rewrite map_col_mx mul_col_mx -{1}[ER]hsubmxK !rows_pencil -/NR quiet_within quiet !map_mx0 -block_mxEv block_mxEh col_mx0.
  rewrite map_row_mx map_col_mx map_mx0 mul_mx_row mulmx0 mul_block_col !mul0mx addr0; congr (row_mx (col_mx _ _) _).
    by rewrite -/XR XQ NQ !map_mxM mulmxBl -scalemxAl.
  rewrite mulNmx -map_mxM -HQ mulmxBl mul_scalar_mx -map_mxM map_mxB opprB [RHS]addrC addrA subrK.
  by [].
rewrite mxrankMfree ?row_free_map //.
have /row_fullP[J JD] := fullD.
have -> : block_mx D 0 (- map_mx f H) (z%:M - map_mx f M) =
    block_mx 1%:M 0 (- map_mx f H *m J) 1%:M *m block_mx D 0 0 (z%:M - map_mx f M).
  by rewrite mulmx_block !mul1mx !mul0mx !mulmx0 !addr0 !add0r -mulmxA JD mulmx1.
rewrite eqmxMfull; last by rewrite row_full_unit unitmxE det_lblock !det1 mulr1 unitr1.
by rewrite rank_diag_block_mx (eqP fullD).
Qed.

Lemma pencil_rank_pairs (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  \rank (pencil_at S f z) = (\rank R + \rank (z%:M - map_mx f M)%R + (n + m - \rank E))%N.
Proof.
rewrite -mxrank_tr -(mxrank_mul_ker _ (map_mx f E)^T) -trmx_mul mxrank_tr rank_E_pencil; congr (_ + _)%N.
have /eqmxP/eqmx_rank -> := capmx_idPr (kernel_attained f z).
by rewrite mxrank_ker mxrank_tr mxrank_map.
Qed.

(** At the generic point. *)
Lemma rank_pairs : (\rank R + d + (n + m - \rank E) = n + gap S n)%N.
Proof.
pose g := [the {rmorphism _ -> _} of @FracField.tofrac _ \o @polyC K].
have := pencil_rank_pairs g (FracField.tofrac 'X).
have -> : pencil_at S g (FracField.tofrac 'X) = over_fractions (pencil S).
  rewrite /over_fractions /pencil map_block_mx map_mxN map_mxB map_scalar_mx -!map_mx_comp; reflexivity.
have -> : \rank ((FracField.tofrac 'X)%:M - map_mx g M) = d.
  have := resolvent_unit (System M (0 : 'M_(0, d)) (0 : 'M_(d, 0)) 0).
  rewrite /over_fractions map_mxB map_scalar_mx -map_mx_comp; exact: mxrank_unit.
by rewrite pencil_rank_gap.
Qed.

Theorem pencil_rank_at (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  (\rank (pencil_at S f z) + d = n + gap S n + \rank (z%:M - map_mx f M)%R)%N.
Proof. by rewrite pencil_rank_pairs -rank_pairs; lia. Qed.

(** The zeros: where the rank is less than the normal rank. *)
Theorem system_zeros (F : fieldType) (f : {rmorphism K -> F}) (z : F) :
  (\rank (pencil_at S f z) < n + gap S n)%N = root (map_poly f (char_poly M)) z.
Proof.
have := pencil_rank_at f z; have := rank_leq_row (z%:M - map_mx f M) => le rank_P.
have -> : (\rank (pencil_at S f z) < n + gap S n)%N = (\rank (z%:M - map_mx f M)%R < d)%N by lia.
rewrite map_char_poly /root -/(horner_eval z _) -det_map_mx.
have -> : map_mx (horner_eval z) (char_poly_mx (map_mx f M)) = z%:M - map_mx f M.
  apply/matrixP => i j; rewrite !mxE /horner_eval hornerD hornerN hornerC; case: (i == j); by rewrite ?hornerX // mulr0n horner0.
by rewrite ltn_neqAle le andbT -/(row_free _) row_free_unit unitmxE unitfE negbK.
Qed.

Lemma rank_quotient_dynamics : d = (\rank (zero_holding S) - \rank R)%N.
Proof.
have [/eqP free cap sum _ _] := dynamics; have := mxrank_sum_cap Z R; rewrite cap mxrank0 addn0 free sum => ->.
by rewrite addnK.
Qed.

End Dynamics.
End SystemZeros.
