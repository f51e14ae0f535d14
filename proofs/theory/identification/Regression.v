(** B and D under two-sided exogeneity, u of any colour: with the true A and C, MOESP's regression for B and D has residual zero, and it
    is zero for no other B and D, if u excites, the window is not empty and (A, C) is observable on one sample less than it has. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Basics Windows WindowBlocks Consistency.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Linear.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (s : nat).
Implicit Types (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).

Lemma times_iter q a (M : 'M[K]_(a, n)) (C : 'M_(n, q)) k : M *m iter k (mulmx (sysA S)) C = iter k (mulmxr (sysA S)) M *m C.
Proof. by elim: k M => //= k IH M; rewrite mulmxA IH -iterSr. Qed.

Lemma T_entry B D (i k : 'I_s) a b :
  T (with_faults S B D) s (mxvec_index i a) (mxvec_index k b) = if (i <= k)%N then impulse S B D (k - i) a b else 0.
Proof.
have [_ /matrixP/(_ a b)] := window_blocks (with_faults S B D) i k; rewrite mxE => ->.
rewrite -val_eqE /=; case: ltngtP => [ik|ki|ki] /=; first by rewrite -(subnSK ik) /= /times_power -times_iter.
  by rewrite mxE.
by rewrite ki subnn.
Qed.

Lemma impulse_linear c B B' D D' d : impulse S (c *: B + B') (c *: D + D') d = c *: impulse S B D d + impulse S B' D' d.
Proof.
case: d => //= d; rewrite scalemxAl -mulmxDl; congr (_ *m _); rewrite /times_power.
by elim: d => //= d ->; rewrite mulmxDl scalemxAl.
Qed.

Lemma T_linear c B B' D D' : T (with_faults S (c *: B + B') (c *: D + D')) s = c *: T (with_faults S B D) s + T (with_faults S B' D') s.
Proof.
apply/matrixP => i j; case/mxvec_indexP: i => i a; case/mxvec_indexP: j => k b.
rewrite T_entry mxE [fun_of_matrix (c *: _) _ _]mxE !T_entry; case: ifP => _; last by rewrite mulr0 addr0.
by rewrite impulse_linear mxE [fun_of_matrix (c *: _) _ _]mxE.
Qed.

Lemma T_zero : T (with_faults S (0 : 'M_(nu, n)) 0) s = 0.
Proof. by have := T_linear (-1) 0 0 0 0; rewrite !scaleN1r !oppr0 !addr0 addNr. Qed.

(** Orthogonal to the T_s of units, orthogonal to all. *)
Lemma T_orthogonal (E : 'M_(s * nu, s * p)) :
  (forall i j, \tr (T (with_faults S (delta_mx i j) 0) s *m E^T) = 0) ->
  (forall i j, \tr (T (with_faults S 0 (delta_mx i j)) s *m E^T) = 0) -> forall B D, \tr (T (with_faults S B D) s *m E^T) = 0.
Proof.
move=> onB onD B D; have step c B1 D1 B2 D2 : \tr (T (with_faults S B1 D1) s *m E^T) = 0 -> \tr (T (with_faults S B2 D2) s *m E^T) = 0 ->
    \tr (T (with_faults S (c *: B1 + B2) (c *: D1 + D2)) s *m E^T) = 0.
  by move=> e1 e2; rewrite T_linear mulmxDl -scalemxAl mxtraceD mxtraceZ e1 e2 mulr0 addr0.
have zero : \tr (T (with_faults S 0 0) s *m E^T) = 0 by rewrite T_zero mul0mx mxtrace0.
have allB : \tr (T (with_faults S B 0) s *m E^T) = 0.
  rewrite [B]matrix_sum_delta; elim/big_ind: _ => // [M M' eM eM'|i _].
    by have := step 1 M 0 M' 0 eM eM'; rewrite !scale1r !addr0.
  elim/big_ind: _ => // [M M' eM eM'|j _]; first by have := step 1 M 0 M' 0 eM eM'; rewrite !scale1r !addr0.
  by have := step (B i j) _ _ _ _ (onB i j) zero; rewrite !scaler0 !addr0.
have allD : \tr (T (with_faults S 0 D) s *m E^T) = 0.
  rewrite [D]matrix_sum_delta; elim/big_ind: _ => // [M M' eM eM'|i _]; first by have := step 1 0 M 0 M' eM eM'; rewrite !scale1r !addr0.
  elim/big_ind: _ => // [M M' eM eM'|j _]; first by have := step 1 0 M 0 M' eM eM'; rewrite !scale1r !addr0.
  by have := step (D i j) _ _ _ _ (onD i j) zero; rewrite !scaler0 !addr0.
by have := step 1 B 0 0 D allB allD; rewrite !scale1r addr0 add0r.
Qed.
End Linear.

Section Unique.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (s : nat).

Lemma no_impulse k (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) : row_free (O S k) -> (forall d, (d < k.+1)%N -> impulse S B D d = 0) ->
  B = 0 /\ D = 0.
Proof.
move=> obs h; split; last exact: (h 0%N isT).
apply/row_matrixP=> i; rewrite row0; apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0 => d dk.
have := h d.+1 dk => /(congr1 (row i)); rewrite row0 row_mul /output mul0mx addr0 => e; rewrite -[RHS]e; congr (_ *m _).
by elim: d {dk e} => //= d ->; rewrite mul0mx addr0 row_mul.
Qed.

Lemma no_response (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) X : (0 < s)%N -> row_free (O S s.-1) ->
  T (with_faults S B D) s = X *m O S s -> B = 0 /\ D = 0.
Proof.
move=> s0 obs e; apply: (@no_impulse s.-1) => // d; rewrite prednK //.
have [N] := ubnP d; elim: N d => // N IH d; rewrite ltnS => dN ds.
have js : (s.-1 - d < s)%N by lia.
pose j := Ordinal js; apply/row_matrixP => a; rewrite row0; pose x := row (mxvec_index j a) X.
have response (k : 'I_s) : output S x (fun=> 0) k = if (j <= k)%N then row a (impulse S B D (k - j)) else 0.
  apply/rowP => b; have := congr1 (fun M : 'M_(s * nu, s * p) => M (mxvec_index j a) (mxvec_index k b)) e; rewrite T_entry => h.
  have -> : output S x (fun=> 0) k 0 b = (X *m O S s) (mxvec_index j a) (mxvec_index k b).
    have -> : (X *m O S s) (mxvec_index j a) (mxvec_index k b) = row (mxvec_index j a) (X *m O S s) 0 (mxvec_index k b) by rewrite [RHS]mxE.
    by rewrite row_mul mul_O /samples mxvecE [RHS]mxE.
  by rewrite -h; case: ifP => _; rewrite mxE.
have x0 : x = 0.
  apply: (row_free_inj obs); rewrite mul0mx mul_O; apply/samples_eq0 => k ks; have ks' : (k < s)%N by lia.
  rewrite -[k]/(nat_of_ord (Ordinal ks')) response /=; case: ifP => // jk.
  by rewrite IH ?row0 //; lia.
have last : (s.-1 < s)%N by rewrite prednK.
have := response (Ordinal last); rewrite x0 /= leq_subr (_ : s.-1 - (s.-1 - d) = d)%N; last lia.
by move=> <-; rewrite output_zero.
Qed.
Theorem regression_unique (B B' : 'M[K]_(nu, n)) (D D' : 'M[K]_(nu, p)) : (0 < s)%N -> row_free (O S s.-1) ->
  T (with_faults S B D) s *m cokermx (O S s) = T (with_faults S B' D') s *m cokermx (O S s) -> B = B' /\ D = D'.
Proof.
move=> s0 obs e.
have diff : T (with_faults S (B - B') (D - D')) s = T (with_faults S B D) s - T (with_faults S B' D') s.
  by have := T_linear S s (-1) B' B D' D; rewrite !scaleN1r ![- _ + _]addrC.
have /submxP[X eX] : (T (with_faults S (B - B') (D - D')) s <= O S s)%MS by rewrite submxE diff mulmxBl e subrr.
by have [/eqP + /eqP] := no_response s0 obs eX; rewrite !subr_eq0 => /eqP-> /eqP->.
Qed.
End Unique.

Section Exogenous.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Hypothesis model : process S B D u v x y.

Theorem two_sided_regression t s W B' D' : let Uf := future t s u in (0 < s)%N -> row_free (O S s.-1) ->
  W *m cov Q Uf Uf = 1%:M -> cov Q Uf (future t s v) = 0 ->
  (W *m cov Q Uf (future t s y) - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D.
Proof.
move=> Uf s0 obs hW uv; rewrite mulmxBl (regression model hW uv); split=> [/eqP|[-> ->]]; last by rewrite subrr.
by rewrite subr_eq0 => /eqP/(regression_unique s0 obs)[-> ->].
Qed.

End Exogenous.
