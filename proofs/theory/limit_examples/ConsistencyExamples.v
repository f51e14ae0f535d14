(** Where the exogeneity of u is one-sided only, cov (u(i), v(k)) = 0 for i <= k, consistency fails. With A = a, F = 1, B = -a, C = [1 0],
    G = [0 1] in rows, u white and v(k) = u(k+1), the stationary state is u itself, and the limit of PI-MOESP is zero although (A, B) is
    controllable and (A, C) observable; any field, a = 1/2 among it. With u = e(k) + e(k-1)/2, v = e(k+1), A = 1/2, B = 1 the limit has
    rank 2 for n = 1: computed over rat.

           dot a b == the covariance of two signals that are told by lists of coefficients
    square a b c d == the matrix of two rows a, b and c, d
              pick == the places of two samples, as two columns *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum ssrint
  rat matrix mxalgebra.
From faultspace Require Import Vocabulary Places Signals Consistency Leads.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** White inputs exist for every horizon. *)
Lemma white_exists (K : fieldType) nu H : exists u : nat -> 'M[K]_(H * nu, nu), white 1%:M u H.
Proof.
exists (fun k => if insub k is Some j then (place K nu (j : 'I_H))^T else 0) => i k iH kH.
by rewrite !insubT /= /cov trmxK mulmx1 place_orthonormal.
Qed.

Section ZeroLimit.
Variables (K : fieldType) (a : K) (N H : nat) (Q : 'M[K]_N) (u : nat -> 'cV[K]_N).
Hypothesis u_white : white Q u H.

Notation leading_fault := (leading_fault a).
Let B : 'M[K]_1 := (- a)%:M.
Let v k := u k.+1.
Let y k : 'M[K]_(N, 1 + 1) := row_mx (u k) (u k.+1).

Theorem zero_limit :
  [/\ process leading_fault B (0 : 'M_(1, 1 + 1)) u v u y,
      forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov Q (u i) (v k) = 0,
      a != 0 -> row_full B,
      forall s, row_free (O leading_fault s.+1) &
      forall t q s L, (q <= t)%N -> (t + s < H)%N ->
        projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> L = 0].
Proof.
split=> [k|i k ik kH|a0|s|t q s L qt tH [X []]].
- rewrite !mulmx0 mulmx1 addr0 !mul_mx_row !mulmx1 !mulmx0 add_row_mx addr0 add0r; split=> //.
  by rewrite !mul_mx_scalar scaleNr subrr add0r.
- by rewrite u_white ?ltn_eqF // (leq_ltn_trans ik) // ltnW.
- by apply/row_fullP; exists (- a)^-1%:M; rewrite -scalar_mxM mulVf ?oppr_eq0.
- apply/row_freeP; exists ((place K (1 + 1) (ord0 : 'I_s.+1))^T *m col_mx 1%:M 0).
  rewrite mulmxA; apply/row_matrixP=> i; rewrite !row_mul rowK mul_place_transposed mxvecK rowK /output /= mul0mx addr0 -mulmxA.
  by rewrite mul_row_col mulmx0 addr0 mulmx1 mulmx1.
have zy : cov Q (future (t - q) q u) (future t s y) = 0.
  apply: uncorrelated_futures => i k; rewrite subnK // => /andP[_ it] /andP[tk ks].
  have far l : (k <= l)%N -> (l <= k.+1)%N -> cov Q (u i) (u l) = 0.
    move=> kl lk; have il : (i < l)%N by apply: leq_trans it (leq_trans tk kl).
    have lH : (l < H)%N by apply: leq_ltn_trans lk (leq_ltn_trans ks tH).
    by rewrite u_white ?ltn_eqF // (ltn_trans il).
  by rewrite /cov mul_mx_row -/(cov Q (u i) (u k)) -/(cov Q (u i) (u k.+1)) !far ?leqnn ?leqnSn // row_mx0.
rewrite (cov_future_white u_white (ltnW tH)) (cov_past_future u_white qt (ltnW tH)) mulmx1 => -> ->.
by rewrite zy mul0mx subr0.
Qed.

End ZeroLimit.

(** So for a = 1/2, with an input that is white on any horizon H: the claim that one-sided exogeneity is enough for A and C is false. *)
Corollary one_sided_is_not_enough H : let a : rat := 1 / 2%:R in exists u : nat -> 'cV[rat]_(H * 1), let v k := u k.+1 in
  white 1%:M u H /\ exists y,
  [/\ process (leading_fault a) (- a)%:M (0 : 'M_(1, 1 + 1)) u v u y,
      forall i k, (i <= k)%N -> (k.+1 < H)%N -> cov 1%:M (u i) (v k) = 0,
      row_full ((- a)%:M : 'M_1),
      forall s, row_free (O (leading_fault a) s.+1) &
      forall t q s L, (q <= t)%N -> (t + s < H)%N ->
        projected_limit 1%:M (future (t - q) q u) (future t s u) (future t s y) L -> L = 0].
Proof.
move=> a; have [u u_white] := white_exists (field_of rat) 1 H; exists u => v; split=> //.
exists (fun k => row_mx (u k) (u k.+1)); have [model one controllable observable limit] := zero_limit a u_white.
by split=> //; apply: controllable.
Qed.

(** Covariances of signals that are lists of their coefficients at seven uncorrelated variables. *)
Section Signals.
Variables (K : fieldType) (variance : K).
Notation variances := (variances variance).
Notation signals := (@signals K).
Definition dot (a b : seq K) : K :=
  nth 0 a 0 * variance * nth 0 b 0 + nth 0 a 1 * nth 0 b 1 + nth 0 a 2 * nth 0 b 2 + nth 0 a 3 * nth 0 b 3
  + nth 0 a 4 * nth 0 b 4 + nth 0 a 5 * nth 0 b 5 + nth 0 a 6 * nth 0 b 6.
Definition square a b c d : 'M[K]_2 := \matrix_(i, j) nth 0 [:: a; b; c; d] (i.*2 + j).

Lemma square_mul a b c d a' b' c' d' : square a b c d *m square a' b' c' d' =
  square (a * a' + b * c') (a * b' + b * d') (c * a' + d * c') (c * b' + d * d').
Proof.
by apply/matrixP=> i j; rewrite !mxE big_ord_recl big_ord1 !mxE; case: i => [[|[|//]] i2]; case: j => [[|[|//]] j2].
Qed.

Lemma square_sub a b c d a' b' c' d' : square a b c d - square a' b' c' d' = square (a - a') (b - b') (c - c') (d - d').
Proof. by apply/matrixP=> i j; rewrite !mxE; case: i => [[|[|//]] i2]; case: j => [[|[|//]] j2]. Qed.

Lemma square_one : 1%:M = square 1 0 0 1.
Proof. by apply/matrixP=> i j; rewrite !mxE; case: i => [[|[|//]] i2]; case: j => [[|[|//]] j2]. Qed.

Lemma square_lower_rank a c d : a != 0 -> d != 0 -> \rank (square a 0 c d) = 2%N.
Proof.
move=> a0 d0; have e : square a 0 c d *m square a^-1 0 (- (c / a / d)) d^-1 = 1%:M.
  rewrite square_mul square_one; congr square; rewrite ?mul0r ?mulr0 ?addr0 ?add0r ?divff //.
  by rewrite mulrN [d * _]mulrC divfK // subrr.
apply/eqP; rewrite eqn_leq rank_leq_row /= -[X in (X <= _)%N](mxrank1 K 2) -e; exact: mxrankM_maxl.
Qed.

Lemma cov_entry k l a b (i : 'I_k) (j : 'I_l) : cov variances (signals k a) (signals l b) i j = dot (nth [::] a i) (nth [::] b j).
Proof. by rewrite /cov mul_mx_diag mxE !big_ord_recl big_ord0 /dot !mxE /= !mulr1 addr0 !addrA. Qed.

Lemma cov_signals a b c d : cov variances (signals 2 [:: a; b]) (signals 2 [:: c; d]) =
  square (dot a c) (dot a d) (dot b c) (dot b d).
Proof. by apply/matrixP=> i j; rewrite cov_entry mxE; case: i => [[|[|//]] i2]; case: j => [[|[|//]] j2]. Qed.

End Signals.

Module MovingAverage.
Import Vocabulary.MovingAverage.

Lemma signals_process : process S 1%:M 0 u v x y.
Proof.
move=> k; rewrite !mulmx0 !mulmx1 addr0 !mul_mx_row !mulmx1 !mulmx0 add_row_mx addr0 add0r; split=> //.
by apply/matrixP=> i j; rewrite !ord1 mul_mx_scalar !mxE /= nth_mkseq // [half * _]mulrC.
Qed.

Lemma signals_one_sided i k : (i <= k < 4)%N -> cov Q (u i) (v k) = 0.
Proof.
case/andP=> ik k4; apply/matrixP=> j l; rewrite !ord1 cov_entry mxE /=; apply/eqP.
by move: k i k4 ik => [|[|[|[|k]]]] [|[|[|[|i]]]] // _ _; vm_compute.
Qed.

(** Two samples of a scalar signal as a matrix of two columns. *)
Definition pick : 'M[rat]_(2, 2 * 1) := \matrix_(j < 2) row 0 (place (field_of rat) 1 j).

Lemma mul_pick a (M : 'M_(a, 2 * 1)) i (j : 'I_2) : (M *m pick^T) i j = vec_mx (row i M) j 0.
Proof.
transitivity ((row i M *m (place (field_of rat) 1 j)^T) 0 0); last by rewrite mul_place_transposed mxE.
by rewrite !mxE; apply: eq_bigr => l _; rewrite !mxE.
Qed.

Lemma pick_future t (w : nat -> 'M[rat]_(7, 1)) l : (forall k, w k = signals 1 [:: nth [::] l k]) ->
  future t 2 w *m pick^T = signals 2 [:: nth [::] l t; nth [::] l t.+1].
Proof.
move=> e; apply/matrixP=> i; case=> -[|[|//]] j2; rewrite mul_pick rowK mxvecK !mxE e !mxE /= ?addn0 ?addn1 //.

Qed.

Lemma pickK : pick^T *m pick = 1%:M.
Proof.
rewrite -sum_places; apply/matrixP=> i j; rewrite mxE summxE; apply: eq_bigr => l _.
by rewrite [RHS]mxE big_ord1 !mxE.
Qed.

Lemma cov_pick (x1 x2 : 'M[rat]_(7, 2 * 1)) : pick *m cov Q x1 x2 *m pick^T = cov Q (x1 *m pick^T) (x2 *m pick^T).
Proof. by rewrite cov_mul cov_mul_left trmxK. Qed.

(** The limit exists, and whichever way to project is chosen it has rank 2, while O_s has n = 1 rows. *)
Theorem limit_of_rank_2 L : projected_limit Q (future 0 2 u) (future 2 2 u) (future 2 2 y) L -> \rank L = 2%N.
Proof.
move=> [X [hX ->]]; set U := future 2 2 u in hX *; set Z := future 0 2 u in hX *; set Y := future 2 2 y.
pose first := (place (field_of rat) (1 + 1) (ord0 : 'I_2))^T.
have eZ : Z *m pick^T = signals 2 [:: nth [::] us 0; nth [::] us 1] by apply: pick_future.
have eU : U *m pick^T = signals 2 [:: nth [::] us 2; nth [::] us 3] by apply: pick_future.
have eY : Y *m first = signals 2 [:: xs 2; nth [::] vs 2].
  apply/row_matrixP=> i; rewrite row_mul mul_place_transposed rowK mxvecK rowK.
  by apply/rowP=> j; rewrite !mxE; case: splitP => j0; rewrite !ord1 !mxE /= => ->.
pose X' := pick *m X *m pick^T.
have eX : X' *m cov Q (U *m pick^T) (U *m pick^T) = cov Q (Z *m pick^T) (U *m pick^T).
  by rewrite -!cov_pick -hX /X' !mulmxA -(mulmxA _ pick^T) pickK mulmx1.
have : pick *m (cov Q Z Y - X *m cov Q U Y) *m first = cov Q (Z *m pick^T) (Y *m first) - X' *m cov Q (U *m pick^T) (Y *m first).
  rewrite !cov_mul !cov_mul_left trmxK mulmxBr mulmxBl /X' !mulmxA; congr (_ - _).
  by rewrite -(mulmxA _ pick^T) pickK mulmx1.
rewrite eY eZ eU; move: eX; rewrite eZ eU !cov_signals => eX.
(* the covariances of the future inputs and their inverse, then X, then the first two columns of the limit and their inverse *)
pose Uinv := square (20%:R / 21%:R) (- (8%:R / 21%:R)) (- (8%:R / 21%:R)) (20%:R / 21%:R : rat).
have number (a b : rat) : a == b -> a = b by move/eqP.
have {eX} -> : X' = square 0 0 (10%:R / 21%:R) (- (4%:R / 21%:R)).
  rewrite -[X']mulmx1; transitivity (X' *m (square (5%:R / 4%:R) half half (5%:R / 4%:R) *m Uinv)).
    by congr (_ *m _); rewrite square_one square_mul; congr square; apply: number; vm_compute.
  rewrite mulmxA; have -> : square (5%:R / 4%:R) half half (5%:R / 4%:R) = square (dot (4%:R / 3%:R) (nth [::] us 2) (nth [::] us 2))
      (dot (4%:R / 3%:R) (nth [::] us 2) (nth [::] us 3)) (dot (4%:R / 3%:R) (nth [::] us 3) (nth [::] us 2))
      (dot (4%:R / 3%:R) (nth [::] us 3) (nth [::] us 3)) by congr square; apply: number; vm_compute.
  by rewrite eX square_mul; congr square; apply: number; vm_compute.
set M := cov Q Z Y - _ => e.
have {}e : pick *m M *m first = square (25%:R / 16%:R) 0 (233%:R / 168%:R) (4%:R / 21%:R).
  by rewrite e square_mul square_sub; congr square; apply: number; vm_compute.
have := @square_lower_rank (field_of rat) (25%:R / 16%:R) (233%:R / 168%:R) (4%:R / 21%:R).
rewrite -e => rank2; apply/eqP; rewrite eqn_leq; apply/andP; split; first exact: rank_leq_row.
rewrite -[X in (X <= _)%N]rank2; [|by vm_compute|by vm_compute].
by rewrite (leq_trans (mxrankM_maxl _ _)) // mxrankM_maxr.
Qed.

Theorem limit_exists : exists L, projected_limit Q (future 0 2 u) (future 2 2 u) (future 2 2 y) L.
Proof.
set U := future 2 2 u; set Z := future 0 2 u; set Y := future 2 2 y.
have eZ : Z *m pick^T = signals 2 [:: nth [::] us 0; nth [::] us 1] by apply: pick_future.
have eU : U *m pick^T = signals 2 [:: nth [::] us 2; nth [::] us 3] by apply: pick_future.
pose X' : 'M[rat]_2 := square 0 0 (10%:R / 21%:R) (- (4%:R / 21%:R)).
have number (a b : rat) : a == b -> a = b by move/eqP.
have e : X' *m (pick *m cov Q U U *m pick^T) = pick *m cov Q Z U *m pick^T.
  by rewrite !cov_pick eZ eU !cov_signals square_mul; congr square; apply: number; vm_compute.
exists (cov Q Z Y - pick^T *m X' *m pick *m cov Q U Y), (pick^T *m X' *m pick); split=> //.
rewrite -[LHS]mulmx1 -[RHS]mul1mx -[RHS]mulmx1 -pickK; have := congr1 (fun M => pick^T *m M *m pick) e.
by rewrite /= !mulmxA.
Qed.

End MovingAverage.
