(** The window of equality cannot be shortened, within the same (A, C) and with as many faults. Let y be reached silently at time M, the lag
    being M + 1, such that (y A, y C) solves problem (11) on M + 1 samples and not on more. The partner adds y to the state where one
    combination of the faults acts, so F' = F + phi y A and G' = G + phi y C: its words of M + 1 samples are the same, since the states W_t
    are the same up to t = M; it has other words of M + 2 samples; and it is left-invertible with the given system, since (y A, y C) has no
    part in the rows of the pencil. Its lag may have to be larger: of two outputs, one that delays the fault and one that the fault does not
    reach, no partner keeps the lag.

    partner S y phi == S with F + phi y A and G + phi y C in the place of F and G
       beside_delay == x1(k+1) = x2(k), x2(k+1) = v(k), x3(k+1) = 0, r = (x1, x3) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Basics Windows Chain Gap Lag Kick LagNecessary PolynomialKernel Inversion Theorem3.
From faultspace Require Import ClosedForm SharpWindows Solutions CanonicalForm Proposition3 SmallSystems.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Partner.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (y : 'rV[K]_n) (phi : 'cV[K]_m).

Definition partner : system K n m p := with_faults S (sysF S + phi *m (y *m sysA S)) (sysG S + phi *m (y *m sysC S)).

Lemma partner_step_sub (U : 'M[K]_n) : (y <= U)%MS -> (silent_step partner U :=: silent_step S U)%MS.
Proof.
move=> yU; apply/eqmxP/andP; split; apply/row_subP => i.
  have /silent_stepP[x [w [xU e f]]] := row_sub i (silent_step partner U); apply/silent_stepP; exists (x + w *m phi *m y), w; split.
  - by apply: addmx_sub => //; apply: submx_trans (submxMl _ _) yU.
  - by rewrite -[RHS]e /= mulmxDl mulmxDr !mulmxA addrAC addrA.
  - by rewrite -f /= mulmxDl mulmxDr !mulmxA addrAC addrA.
have /silent_stepP[x [w [xU e f]]] := row_sub i (silent_step S U); apply/silent_stepP; exists (x - w *m phi *m y), w; split.
- by apply: addmx_sub => //; rewrite eqmx_opp; apply: submx_trans (submxMl _ _) yU.
- by rewrite -[RHS]e /= mulmxBl mulmxDr !mulmxA addrA addrAC subrK.
- by rewrite -f /= mulmxBl mulmxDr !mulmxA addrA addrAC subrK.
Qed.

Variable M : nat.
Hypothesis reach : silently_reaches S M y.

Lemma reached_before t : (t <= M)%N -> (y <= silent S t)%MS.
Proof. by move=> tM; apply/silentP; apply: chain_decreasing reach. Qed.

Lemma partner_silent t : (t <= M)%N -> (silent partner t :=: silent S t)%MS.
Proof.
elim: t => // t IH tM; have e := IH (ltnW tM); rewrite [silent _ t.+1]/= [silent S t.+1]/=.
apply/eqmxP/andP; split.
  apply: submx_trans (silent_step_mono partner (_ : (_ <= silent S t)%MS)) _; first by rewrite e.
  by rewrite partner_step_sub // reached_before // ltnW.
apply: submx_trans (_ : (_ <= silent_step partner (silent S t))%MS) _; first by rewrite partner_step_sub // reached_before // ltnW.
by apply: silent_step_mono; rewrite e.
Qed.

Lemma partner_gap t : (t <= M)%N -> gap partner t = gap S t.
Proof.
move=> tM; have yW := reached_before tM; have e := partner_silent tM; apply: eqmx_rank.
have yC : (y *m sysC S <= after_zeros S t)%MS.
  by apply: submx_trans (submxMr _ yW) _; rewrite /after_zeros -addsmxE addsmxSl.
have yC' : (y *m sysC S <= after_zeros partner t)%MS.
  by apply: submx_trans (submxMr _ (_ : (_ <= silent partner t)%MS)) _; [rewrite e | rewrite /after_zeros -addsmxE addsmxSl].
apply/andP; split; rewrite col_mx_sub; apply/andP; split.
- by apply: submx_trans (submxMr _ (_ : (_ <= silent S t)%MS)) _; [rewrite e | rewrite /after_zeros -addsmxE addsmxSl].
- apply: addmx_sub; first by rewrite /after_zeros -addsmxE addsmxSr.
  by apply: submx_trans (submxMl _ _) yC.
- by apply: submx_trans (submxMr _ (_ : (_ <= silent partner t)%MS)) _; [rewrite e | rewrite /after_zeros -addsmxE addsmxSl].
rewrite -[sysG S](addrK (phi *m (y *m sysC S))); apply: addmx_sub; first by rewrite /after_zeros -addsmxE addsmxSr.
by rewrite eqmx_opp; apply: submx_trans (submxMl _ _) yC'.
Qed.

Lemma partner_solves : (row_mx (sysF partner) (sysG partner) <= row_mx (sysF S) (sysG S) + row_mx (y *m sysA S) (y *m sysC S))%MS.
Proof.
by rewrite /= -add_row_mx -mul_mx_row; apply: addmx_sub_adds; [exact: submx_refl | exact: submxMl].
Qed.

Lemma own_rows s : (row_mx (sysF S) (sysG S) <= solution_space S s)%MS.
Proof. by apply/row_subP => i; rewrite row_row_mx !rowE; apply/solution_spaceP/own_fault_solves. Qed.

Theorem partner_words r : word partner M.+1 r <-> word S M.+1 r.
Proof.
have sub : forall r, word partner M.+1 r -> word S M.+1 r.
  apply/(included_rows _ _ (solution_spaceP S M.+1)); apply: submx_trans partner_solves _; rewrite addsmx_sub own_rows /=.
  by apply/(solution_spaceP S M.+1); have := kick_solves 0 reach; rewrite /kick_f /kick_g !mul0mx !addr0.
move: r; apply/window_eqP; rewrite -(mxrank_leqif_eq ((window_subP _ _ _).2 sub)) !rank_window; apply/eqP.
by apply: eq_bigr => j _; rewrite partner_gap // -ltnS.
Qed.

Theorem partner_differs s : phi != 0 -> ~ solves S s (y *m sysA S) (y *m sysC S) -> exists r, word partner s r /\ ~ word S s r.
Proof.
move=> phi0 out; have [sub|/row_subPn[i ri]] := boolP (window partner s <= window S s)%MS; last first.
  exists (unsamples (row i (window partner s))); split; first by apply/sub_windowP; apply: row_sub.
  by move/sub_windowP; rewrite (negPf ri).
case: out; move/window_subP/(included_rows _ _ (solution_spaceP S s)): sub; rewrite -add_row_mx -mul_mx_row => sub.
have {}sub : (phi *m row_mx (y *m sysA S) (y *m sysC S) <= solution_space S s)%MS.
  rewrite -[X in (X <= _)%MS](addKr (row_mx (sysF S) (sysG S))); apply: addmx_sub sub; rewrite eqmx_opp; exact: own_rows.
have [psi e] : exists psi : 'rV_m, psi *m phi = 1%:M.
  by apply/row_fullP; rewrite /row_full -mxrank_tr; apply/eqP/eqP; rewrite rank_rV trmx_eq0 phi0.
apply/(solution_spaceP S s); rewrite -[X in (X <= _)%MS]mul1mx -e -mulmxA; exact: submx_trans (submxMl _ _) sub.
Qed.

Theorem partner_left_invertible : ~ (forall s, solves S s (y *m sysA S) (y *m sysC S)) -> left_invertible S -> left_invertible partner.
Proof.
move=> out inv; apply/left_invertible_pencil_rank/full_rank_over_fractions => u.
have /full_rank_over_fractions none := (left_invertible_pencil_rank S).1 inv.
rewrite -[u]hsubmxK row_pencil; move: (lsubmx u) (rsubmx u) => a w {u} /= e.
pose h := row_mx (- map_mx polyC (y *m sysA S)) (map_mx polyC (y *m sysC S)); pose c := w *m map_mx polyC phi.
have {}e : row_mx a w *m pencil S = - (c *m h).
  apply/eqP; rewrite -addr_eq0 -[X in _ == X]e row_pencil /h mul_mx_row add_row_mx /c !map_mxD !map_mxM !mulmxDr !mulmxA mulmxN.
  by rewrite !mulmxA opprD !addrA.
have [c0|c0] := eqVneq c 0; first by apply: none; rewrite e c0 mul0mx oppr0.
case: out => s; apply/solves_words => r; move: s r; apply/(included_words_iff_pencil (S' := with_faults S _ _)) => //.
apply/row_space_over_fractions => z Sz; have top : row_mx ('X%:M - map_mx polyC (sysA S)) (map_mx polyC (sysC S)) *m z = 0.
  by move: Sz; rewrite /pencil block_mxEv mul_col_mx -[X in _ = X]col_mx0 => /eq_col_mx[].
rewrite /pencil /= block_mxEv mul_col_mx top -/h; suff -> : h *m z = 0 by rewrite col_mx0.
have : c *m (h *m z) = 0 by rewrite mulmxA -[_ *m h]opprK -e mulNmx -mulmxA Sz mulmx0 oppr0.
rewrite [h *m z]mx11_scalar [c]mx11_scalar -scalar_mxM => /matrixP/(_ 0 0)/eqP; rewrite [X in X == _]mxE eqxx mulr1n [X in _ == X]mxE.
rewrite mulf_eq0; case/orP=> /eqP e0; last by rewrite e0 raddf0.
by case/negP: c0; rewrite [c]mx11_scalar e0 raddf0.
Qed.
End Partner.

Section Sharp.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

Lemma kick_after_lag M : lag S = M.+1 -> exists2 y : 'rV[K]_n, silently_reaches S M y & ~ solves S M.+2 (y *m sysA S) (y *m sysC S).
Proof.
move=> lag_S; have [g g_in g_out] := last_value lag_S.
have /submxP[c g_eq] := g_in; pose u := rsubmx c; pose y := lsubmx c *m silent S M.
have gE : g = y *m sysC S + u *m sysG S by rewrite g_eq -{1}(hsubmxK c) mul_row_col mulmxA.
exists y; first by apply/silentP/submxMl.
move=> sol; case/negP: g_out; have := solves_add sol (own_fault_solves S M.+2 u); rewrite -gE => /solvesP/(_ (only_at M.+1 1%:M)) w.
apply/after_zerosP; apply: word_ext w => k; rewrite ltnS => kM; rewrite /output state_zero => [|j jk]; last first.
  by rewrite /only_at ltn_eqF //; apply: leq_trans jk kM.
by rewrite mul0mx add0r /only_at; case: (k == M.+1); rewrite ?mul1mx ?mul0mx.
Qed.

(** Ledger: sharp-windows, equality. *)
Theorem partner_with_as_many_faults_same_A_C : (0 < m)%N -> (0 < lag S)%N -> exists (F : 'M_(m, n)) G, let S' := with_faults S F G in
  [/\ left_invertible S -> left_invertible S' /\ (lag S <= lag S')%N, forall r, word S (lag S) r <-> word S' (lag S) r
    & exists r, word S' (lag S).+1 r /\ ~ word S (lag S).+1 r].
Proof.
case lag_S : (lag S) => [//|M] m0 _; have [y reach out] := kick_after_lag lag_S.
pose phi : 'cV[K]_m := delta_mx (Ordinal m0) 0; have phi0 : phi != 0.
  by apply/matrix0Pn; exists (Ordinal m0), 0; rewrite mxE !eqxx oner_neq0.
exists (sysF (partner S y phi)), (sysG (partner S y phi)); split=> [inv|r|].
- have inv' : left_invertible (partner S y phi) by apply: partner_left_invertible inv => /(_ M.+2).
  split=> //; rewrite ltnNge; apply/negP => /lagP; rewrite -/(partner S y phi) (partner_gap phi reach) //.
  have -> : gap (partner S y phi) n = gap S n.
    by have := (gap_left_invertible S (leqnn n)).2 inv; have := (gap_left_invertible (partner S y phi) (leqnn n)).2 inv'; move=> -> ->.
  by move/lagP; rewrite lag_S ltnn.
- by have := partner_words phi reach r; tauto.
exact: partner_differs phi0 out.
Qed.
End Sharp.

(** x1(k+1) = x2(k), x2(k+1) = v(k), x3(k+1) = 0, r = (x1, x3). *)
Section BesideDelay.
Variable K : fieldType.
Definition beside_delay : system K (1 + 1 + 1) 1 (1 + 1) :=
  System (block_mx (block_mx 0 0 1%:M 0) 0 0 0) (row_mx (row_mx 0 1%:M) 0) (block_mx (col_mx 1%:M 0) 0 0 1%:M) 0.
Notation S := beside_delay.

Lemma beside_delay_output x v k :
  output S x v k = row_mx (output (double_delay K) (lsubmx x) v k) (if k is 0%N then rsubmx x else 0).
Proof.
have st : state S x v k = row_mx (state (double_delay K) (lsubmx x) v k) (if k is 0%N then rsubmx x else 0).
  elim: k => [|k IH]; first by rewrite hsubmxK.
  by rewrite [LHS]/= IH mul_row_block mul_mx_row !mulmx0 !addr0 add_row_mx addr0.
by rewrite /output st /= !mulmx0 !addr0 mul_row_block !mulmx0 mulmx1 addr0 add0r.
Qed.

Lemma beside_delay_left_invertible : left_invertible S.
Proof.
move=> v silent; apply: (double_delay_left_invertible (K := K)) => k.
by have := silent k; rewrite beside_delay_output linear0 => /eqP; rewrite row_mx_eq0 => /andP[/eqP].
Qed.

(** On two samples, only the initial state is seen: three dimensions. *)
Lemma beside_delay_free v x k : (k < 2)%N -> output S x v k = output S x (fun=> 0) k.
Proof. by case: k => [|[|k]] // _; rewrite !beside_delay_output !double_delay_output. Qed.

Lemma beside_delay_O : \rank (O S 2) = 3%N.
Proof.
apply/eqP; rewrite -/(row_free _); apply: inj_row_free => x; rewrite mul_O => /samples_eq0 z.
have := z 1%N isT; have := z 0%N isT; rewrite !beside_delay_output !double_delay_output -row_mx0 => /eq_row_mx[e1 e3] /eq_row_mx[e2 _].
by rewrite -[x]hsubmxK e3 -[lsubmx x]hsubmxK e1 e2 !row_mx0.
Qed.

Lemma beside_delay_words r : word S 2 r <-> (samples 2 r <= O S 2)%MS.
Proof.
split=> [[x [v e]]|/submxP[x]].
  by apply/submxP; exists x; rewrite mul_O; apply: samples_ext => k k2; rewrite e ?beside_delay_free.
by rewrite mul_O => /samples_inj h; exists x, (fun=> 0).
Qed.

Lemma one_sample_rank m (S' : system K (1 + 1 + 1) m (1 + 1)) : (\rank (window S' 1) <= 2)%N.
Proof. by apply: leq_trans (rank_leq_col _) _. Qed.

Theorem no_partner_keeps_the_lag : [/\ left_invertible S, lag S = 1%N &
  forall F G, let S' := with_faults S F G : system K (1 + 1 + 1) 1 (1 + 1) in left_invertible S' -> (lag S' <= lag S)%N ->
  forall r, behavior S' r <-> behavior S r].
Proof.
have rank2 : \rank (window S 2) = 3%N.
  rewrite -beside_delay_O; apply: eqmx_rank; apply/andP; split; last by rewrite -addsmxE addsmxSl.
  by apply/row_subP => i; rewrite -[row i _]unsamplesK; apply/beside_delay_words/sub_windowP/row_sub.
have rank1 : \rank (window S 1) = 2%N.
  apply: full_window => r; exists (row_mx (row_mx (lsubmx (r 0%N)) 0) (rsubmx (r 0%N))), (fun=> 0) => -[|k] // _.
  by rewrite beside_delay_output double_delay_output !row_mxKl !row_mxKr hsubmxK.
have inv := beside_delay_left_invertible.
have lag1 : lag S = 1%N.
  apply/eqP; rewrite eqn_leq; apply/andP; split; first by apply/(proposition_3_sharp 1 inv); rewrite rank2 rank1.
  rewrite ltnNge; apply/negP => /(proposition_3_sharp 0 inv); rewrite rank1.
  by have := rank_leq_col (window S 0); rewrite leqn0 => /eqP ->.
split=> // F G; cbv zeta; set S' := with_faults _ _ _; rewrite lag1 => inv' lag'.
apply/(theorem_1_sharp lag' (_ : (lag S <= 1)%N)); first by rewrite lag1.
apply/window_eqP; have sub : (window S 2 <= window S' 2)%MS.
  apply/window_subP => r /beside_delay_words; rewrite -windowP => sub; apply: submx_trans sub _.
  have -> : O S 2 = O S' 2 by apply/row_matrixP => i; rewrite !rowK; apply: samples_ext => k _; rewrite output_free.
  by rewrite -addsmxE addsmxSl.
have le : (\rank (window S' 2) <= \rank (window S 2))%N.
  by rewrite rank2 ((proposition_3_sharp 1 inv').2 lag') addn1 ltnS; apply: one_sample_rank.
by rewrite sub andbT -(geq_leqif (mxrank_leqif_sup sub)).
Qed.
End BesideDelay.
