(** The gap is the normal rank, without left-invertibility: rank window (s + 1) - rank window s = rank of the transfer matrix for every
    s >= n, and the pencil has rank n + gap n. For a polynomial row in the kernel of the pencil has all its coefficients among the
    silent pairs (x, v) of the limit W of the chain W_k; on these the pencil is q X - N with X, N inside W and N onto W, of rank dim W.
    *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction zify.
From faultspace Require Import Vocabulary Windows Chain Gap Balance PolynomialKernel Inversion TransferRank.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Constants.
Variable K : fieldType.
Notation over := (@over_fractions K _ _).
Notation const := (map_mx (@polyC K)).
Let embed := [the {rmorphism _ -> _} of @FracField.tofrac _ \o @polyC K].

Lemma over_constE a b (M : 'M[K]_(a, b)) : over (const M) = map_mx embed M.
Proof. by rewrite /over_fractions -map_mx_comp. Qed.

Lemma rank_over_const a b (M : 'M[K]_(a, b)) : \rank (over (const M)) = \rank M.
Proof. by rewrite over_constE mxrank_map. Qed.

(** A polynomial matrix lies in a constant row space when its coefficients do. *)
Lemma sub_over_const a b c (M : 'M[{poly K}]_(a, b)) (E : 'M[K]_(c, b)) :
  (forall k, (coefm k M <= E)%MS) -> (over M <= over (const E))%MS.
Proof.
move=> sub; rewrite submxE over_constE -map_cokermx -over_constE /over_fractions -map_mxM.
suff -> : M *m const (cokermx E) = 0 by rewrite map_mx0.
by apply/coefmP => k; rewrite coefm0 coefm_mulr; apply/eqP; rewrite -submxE.
Qed.

(** q X - N has rank at least that of N. *)
Lemma rank_linear_pencil e b (X N : 'M[K]_(e, b)) : (\rank N <= \rank (over ('X *: const X - const N)))%N.
Proof.
have [R NR] : exists R, row_base N = R *m N by apply/submxP; rewrite eq_row_base.
apply: leq_trans (mxrankM_maxr (over (const R)) _); rewrite /over_fractions -map_mxM.
rewrite (full_rank_over_fractions _).2 // => u uD; apply/coefmP => k; rewrite coefm0.
have step j : coefm j u *m row_base N = if j is i.+1 then coefm i u *m (R *m X) else 0.
  have := congr1 (coefm j) uD. rewrite mulmxBr mulmxBr -scalemxAr -scalemxAr -!map_mxM coefmB coefmX coefm0 coefm_mulr -NR.
  by move/eqP; rewrite subr_eq0 => /eqP <-; case: j => // j; rewrite coefm_mulr.
have /row_free_inj free := row_base_free N.
by elim: k => [|k IH]; apply: free; rewrite mul0mx step // IH mul0mx.
Qed.

End Constants.

Section NormalRank.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation over := (@over_fractions K _ _).
Notation const := (map_mx (@polyC K)).
Notation E := (silent_pairs S n).
Let X := lsubmx E.
Let N := X *m sysA S + rsubmx E *m sysF S.

Lemma row_pairs i : row i E = row_mx (row i X) (row i (rsubmx E)).
Proof. by rewrite -row_row_mx hsubmxK. Qed.

Lemma silent_pairs_pencil : const E *m pencil S = row_mx ('X *: const X - const N) 0.
Proof.
rewrite -{1}[E]hsubmxK map_row_mx mul_row_block mulmxBr mul_mx_scalar mulmxN -!map_mxM -map_mxD -addrA -opprD -map_mxD -/X -/N.
congr row_mx; rewrite -[RHS](map_mx0 [the {additive _ -> _} of @polyC K]); congr map_mx.
apply/row_matrixP => i; have := row_sub i E; rewrite row_pairs => /silent_pairsP[_ e].
by rewrite linearD /= !row_mul row0 -[RHS]e.
Qed.

Lemma X_silent : (X <= silent S n)%MS.
Proof. by apply/row_subP => i; have := row_sub i E; rewrite row_pairs => /silent_pairsP[]. Qed.

Lemma N_silent : (N :=: silent S n)%MS.
Proof.
apply/eqmxP/andP; split.
  apply: submx_trans (_ : silent S n.+1 <= _)%MS; last exact: silent_decreasing.
  apply/row_subP => i; have := row_sub i E; rewrite row_pairs => /silent_pairsP[h e].
  by apply/silent_stepP; exists (row i X), (row i (rsubmx E)); split=> //; rewrite linearD /= !row_mul.
apply: submx_trans (silent_constant S (leqnSn n)) _; apply/row_subP => i.
have /silent_stepP[x [w [h e <-]]] := row_sub i (silent S n.+1).
have /submxP[c] : (row_mx x w <= E)%MS by apply/silent_pairsP.
rewrite -[E]hsubmxK mul_mx_row => /eq_row_mx[-> ->].
by rewrite -!mulmxA -mulmxDr submxMl.
Qed.

Lemma rank_silent_pencil : \rank (over ('X *: const X - const N)) = \rank (silent S n).
Proof.
apply/eqP; rewrite eqn_leq -{2}N_silent rank_linear_pencil andbT -(rank_over_const (silent S n)).
apply/mxrankS/sub_over_const => k; rewrite coefmB coefmX coefm_const.
apply: addmx_sub; first by case: k => [|k]; rewrite ?sub0mx // coefm_const; case: eqP; rewrite ?sub0mx // X_silent.
by rewrite eqmx_opp; case: eqP; rewrite ?sub0mx // N_silent.
Qed.

(** Coefficients of the kernel of the pencil are silent pairs. *)
Lemma kernel_silent (y : 'rV_(n + m)) : y *m pencil S = 0 -> forall k, (coefm k y <= E)%MS.
Proof.
rewrite -[y]hsubmxK; move: (lsubmx y) (rsubmx y) => x w {y} ker k.
have -> : coefm k (row_mx x w) = row_mx (coefm k x) (coefm k w) by apply: map_row_mx.
pose d := (maxn (sizem x) (sizem w) + n + k)%N.
have xd : (sizem x <= d)%N by rewrite /d -!addnA (leq_trans (leq_maxl _ (sizem w))) ?leq_addr.
have wd : (sizem w <= d)%N by rewrite /d -!addnA (leq_trans (leq_maxr (sizem x) _)) ?leq_addr.
have trajectory := kernel_trajectory ker xd wd.
have at_k a (M : 'M[{poly K}]_(1, a)) : reversed d M (d - k) = coefm k M.
  by rewrite /reversed leq_subr subKn // /d leq_addl.
apply/silent_pairsP; split.
  apply/silentP; apply: (chain_decreasing (k := (d - k)%N)); first by rewrite /d addnK leq_addl.
  exists 0, (reversed d w); split=> [j _|]; first exact: (trajectory j).2.
  by rewrite (trajectory _).1 at_k.
by have [e] := trajectory (d - k)%N; rewrite /output e !at_k.
Qed.

Lemma kernel_sub_silent_pairs : (kermx (over (pencil S)) <= over (const E))%MS.
Proof.
have [d d0 [M dM]] := common_denominator (kermx (over (pencil S))).
have -> : (kermx (over (pencil S)) <= over (const E))%MS = (over M <= over (const E))%MS.
  by rewrite -[over M]dM eqmx_scale // tofrac_eq0.
apply: sub_over_const => k; apply/row_subP => i.
have -> : row i (coefm k M) = coefm k (row i M) by rewrite /coefm map_row.
apply: kernel_silent; apply: over_eq0; rewrite map_mxM map_row -[map_mx _ M]dM -row_mul -scalemxAl mulmx_ker scaler0.
exact: row0.
Qed.

Theorem pencil_rank_gap : \rank (over (pencil S)) = (n + gap S n)%N.
Proof.
have := mxrank_mul_ker (over (const E)) (over (pencil S)).
rewrite {1}/over_fractions -map_mxM silent_pairs_pencil map_row_mx map_mx0 rank_row_mx0 rank_silent_pencil.
have /eqmxP/eqmx_rank -> := capmx_idPr kernel_sub_silent_pairs.
rewrite rank_over_const mxrank_ker.
have := mxrank_mul_ker E (col_mx (sysA S) (sysF S)); rewrite -/(null_pairs S n) -/(null S n).
have -> : E *m col_mx (sysA S) (sysF S) = N by rewrite -{1}[E]hsubmxK mul_row_col.
rewrite N_silent => <- /addnI; have := rank_leq_row (over (pencil S)); have := faults_balance S (leqnn n); lia.
Qed.

Theorem gap_normal_rank s : (n <= s)%N -> gap S s = \rank (transfer S).
Proof. by move=> ns; rewrite gap_constant //; apply: (@addnI n); rewrite -pencil_rank_gap pencil_rank_transfer. Qed.

Theorem window_growth_normal_rank s : (n <= s)%N -> \rank (window S s.+1) = (\rank (window S s) + \rank (transfer S))%N.
Proof. by move=> ns; rewrite rank_window_step gap_normal_rank. Qed.

End NormalRank.

(** So the normal rank is a property of the behaviour, of whichever system. *)
Theorem equal_behaviors_equal_normal_rank (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) :
  (forall s r, word S s r <-> word S' s r) -> \rank (transfer S) = \rank (transfer S').
Proof.
move=> same; have rank_eq s : \rank (window S s) = \rank (window S' s) by apply/eqmx_rank/window_eqP.
apply: (@addnI (\rank (window S (maxn n n')))).
by rewrite -window_growth_normal_rank ?leq_maxl // !rank_eq window_growth_normal_rank ?leq_maxr.
Qed.

