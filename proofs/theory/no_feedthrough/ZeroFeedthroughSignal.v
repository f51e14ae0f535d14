(** Without feedthrough, when do all equivalent pairs (F', 0) of m faults tell the same signal, up to a basis? Just when C F has full
    rank m and the output determines v without the initial state. If v0 F C = 0 for some v0, the fault v0 may act one step earlier for a
    part of the faults, F' = F + phi v0 F A: an equivalent pair with another signal. Conversely the rows of F' are then in those of F and
    the unobservable states.

    same_signal S F' == wherever (F', 0) and S give the same output, their faults are the same up to one basis *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction.
From faultspace Require Import Vocabulary Basics Infinite Trajectory TransferRank NormalRank.
From faultspace Require Import Theorem3 ClosedForm SilentSubspaces ZeroStates Readings UnobservableZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Signal.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Hypotheses (G0 : sysG S = 0) (inv : left_invertible S).
Notation alone F' := (with_faults S F' (0 : 'M_(m, p))).

(** The signals of S that the output of (F', 0) can come from. *)
Definition same_signal (F' : 'M_(m, n)) := exists2 Q, Q \in unitmx &
  forall x v y w, (forall k, output S x v k = output (alone F') y w k) -> forall k, v k = w k *m Q.

Section Early.
Variables (v0 : 'rV[K]_m) (phi : 'cV[K]_m).
Hypothesis quiet : v0 *m sysF S *m sysC S = 0.
Notation F' := (sysF S + phi *m (v0 *m sysF S *m sysA S)).

Lemma early_output y w k :
  output (alone F') y w k = output S (y + w 0%N *m phi *m (v0 *m sysF S)) (fun k => w k + w k.+1 *m phi *m v0) k.
Proof.
have st : state S (y + w 0%N *m phi *m (v0 *m sysF S)) (fun k => w k + w k.+1 *m phi *m v0) k =
    state (alone F') y w k + w k *m phi *m (v0 *m sysF S).
  elim: k => //= k ->; rewrite !mulmxDl mulmxDr !mulmxA -!addrA; congr (_ + _); rewrite addrCA; congr (_ + _).
by rewrite /output st G0 !mulmx0 !addr0 mulmxDl -(mulmxA _ (v0 *m sysF S)) quiet mulmx0 addr0.
Qed.

Lemma early_left_invertible : v0 != 0 -> left_invertible (alone F').
Proof.
move=> v00 w silent; pose u k := if k is j.+1 then w j + w j.+1 *m phi *m v0 else w 0%N *m phi *m v0.
have zero : forall k, u k = 0.
  apply: inv => -[|k]; first by rewrite /output /= G0 mul0mx mulmx0 addr0.
  rewrite output_step mul0mx add0r -[RHS](silent k) early_output add0r /= mulmxA.
  by [].
have cancel (c : 'M_1) : c *m v0 = 0 -> c = 0.
  by rewrite [c]mx11_scalar mul_scalar_mx => /eqP; rewrite scaler_eq0 (negPf v00) orbF => /eqP ->; exact: raddf0.
have wE k : w k = - (w k.+1 *m phi *m v0) by apply/eqP; rewrite -addr_eq0; apply/eqP; exact: zero k.+1.
have b0 : w 0%N *m phi = 0 by apply: cancel; apply: zero 0%N.
have b k : w k *m phi = 0.
  have [z|z] := eqVneq (v0 *m phi) 0; first by rewrite wE mulNmx -(mulmxA (_ *m phi)) z mulmx0 oppr0.
  elim: k => // k /eqP; rewrite wE mulNmx oppr_eq0 -(mulmxA (_ *m phi)) => /eqP e.
  move: e; rewrite [v0 *m phi]mx11_scalar mul_mx_scalar => /eqP; rewrite scaler_eq0 => /orP[/eqP e0|/eqP //].
  by case/negP: z; rewrite [v0 *m phi]mx11_scalar e0 raddf0.
by move=> k; rewrite wE b mul0mx oppr0.
Qed.

Lemma early_equivalent : v0 != 0 -> forall r, behavior (alone F') r <-> behavior S r.
Proof.
move=> v00 r; have sub : forall s r, word (alone F') s r -> word S s r.
  by apply/behavior_subP => q [y [w e]]; eexists; eexists => k; rewrite e early_output.
have := equal_words_of_left_invertible (S := S) (S' := alone F') erefl erefl (leqnn m) (early_left_invertible v00) sub.
by move/behavior_eqP => ->.
Qed.

End Early.

Lemma signal_full_rank : (forall F' : 'M_(m, n), (forall r, behavior (alone F') r <-> behavior S r) -> same_signal F') ->
  \rank (sysF S *m sysC S) = m.
Proof.
move=> same; apply/eqP; rewrite -/(row_free _); apply: inj_row_free => v0; rewrite mulmxA => quiet.
apply/eqP; apply: contraT => v00; have /rV0Pn[i _] := v00.
have [Q _ h] := same _ (early_equivalent (delta_mx i 0) quiet v00).
pose w k : 'rV[K]_m := if k == 1%N then delta_mx 0 i else 0.
have := h _ _ _ w (fun k => esym (early_output (delta_mx i 0) quiet 0 w k)) 0%N.
rewrite /w /= add0r mul0mx mul_delta_mx => e; case/negP: v00; rewrite -[v0]mul1mx.
by rewrite -[X in X *m _](_ : delta_mx 0 0 = _) ?e //; apply/matrixP => a b; rewrite !ord1 !mxE.
Qed.

Lemma own_pair : alone (sysF S) = S.
Proof. by rewrite -G0 with_own_faults. Qed.

Lemma signal_blind : same_signal (sysF S) -> faults_recovered_blindly S.
Proof.
rewrite /same_signal own_pair => -[Q _ h] x y v w e k; rewrite (h _ _ _ _ e); have := h 0 w 0 w (fun _ => erefl) k.
by [].
Qed.

Lemma silent_from_rest_in_F k : \rank (sysF S *m sysC S) = m -> (silent_from_rest S k <= sysF S)%MS.
Proof.
move=> full; apply/row_subP => i; have /silent_from_restP[v [silent <-]] := row_sub i (silent_from_rest S k).
case: k {i} silent => [|k] silent; first exact: sub0mx.
suff rest j : (j <= k)%N -> state S 0 v j = 0 by rewrite /= rest // mul0mx add0r submxMl.
elim: j => // j IH jk; have := silent j.+1 jk; rewrite /output G0 mulmx0 addr0 /= IH ?(ltnW jk) // mul0mx add0r -mulmxA.
move/eqP; rewrite mulmx_free_eq0; last by rewrite /row_free full.
by move/eqP => ->; rewrite mul0mx.
Qed.

Lemma blind_signal (F' : 'M_(m, n)) : \rank (sysF S *m sysC S) = m -> faults_recovered_blindly S ->
  (forall r, behavior (alone F') r <-> behavior S r) -> same_signal F'.
Proof.
move=> full blind same; have /faults_recovered_blindly_states[_ quiet] := blind.
have : (F' <= sysF S + zero_holding S)%MS.
  apply/row_subP => i; have sol : solves S n.+1 (row i F') 0.
    by have := (theorem_3_part_i n.+1 (0 : 'M_(0, _)) same).1 i; rewrite row0.
  have := (zero_state_solutions S _ (ltnSn n)).1 sol; rewrite zero_states_silent addsmxC => h.
  by apply: submx_trans h _; apply: addsmxS (silent_from_rest_in_F n full) (submx_refl _).
case/sub_addsmxP => -[Q D] /= F'E; set N := D *m zero_holding S in F'E.
have hidden (w : 'rV_m) : w *m N *m O S n = 0.
  by apply/unobservable/quiet/zero_holdingP; rewrite /N mulmxA submxMl.
have out y w k : output (alone F') y w k = output S y (fun j => w j *m Q) k.
  have st : exists2 d, state (alone F') y w k = state S y (fun j => w j *m Q) k + d & d *m O S n = 0.
    elim: k => [|k [d e dO]]; first by exists 0; rewrite ?addr0 ?mul0mx.
    exists (d *m sysA S + w k *m N); last by rewrite mulmxDl hidden addr0; apply: (unobservable_step dO).2.
    by rewrite /= e F'E mulmxDl mulmxDr mulmxA addrACA.
  case: st => d e dO; rewrite /output e mulmxDl (unobservable_step dO).1 addr0 G0 !mulmx0.
  by [].
have inv' : left_invertible (alone F').
  apply/left_invertible_transfer_rank; rewrite (equal_behaviors_equal_normal_rank (S' := S)) ?(left_invertible_transfer_rank S).1 //.
  by move/behavior_eqP: same.
exists Q; last by move=> x v y w e k; apply: (blind x y v (fun j => w j *m Q)) => j; rewrite e out.
rewrite -row_free_unit; apply: inj_row_free => u uQ.
apply: (inv' (fun k => if k is 0%N then u else 0) _ 0%N) => k; rewrite out; apply: output_zero => -[|j] _ //; exact: mul0mx.
Qed.

(** Ledger: trajectory-recovered, zero-feedthrough-signal. *)
Theorem zero_feedthrough_signal (g : {poly K}) : gcd_of_minors (pencil S) g ->
  (forall F' : 'M_(m, n), (forall r, behavior (alone F') r <-> behavior S r) -> same_signal F') <->
  \rank (sysF S *m sysC S) = m /\ (size g).-1 = (n - \rank (O S n))%N.
Proof.
move=> finite; split=> [same | [full zeros] F']; last first.
  by apply: blind_signal => //; apply/(recovered_blindly_by_zeros finite).
split; first exact: signal_full_rank.
have : faults_recovered_blindly S by apply/signal_blind/same => r; rewrite own_pair.
by case/(recovered_blindly_by_zeros finite).
Qed.

End Signal.
