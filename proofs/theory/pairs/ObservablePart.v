(** The observable part of a system: the states modulo those that give no output. It makes the same outputs, whatever the faults, so what
    is proved for observable (A, C) may be lifted.

    observable_part_maps Pi Psi So == Pi forgets what cannot be seen, Psi is a right inverse, So is S after Pi *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra fraction zify.
From faultspace Require Import Vocabulary Basics Windows Infinite Trajectory Lag NormalRank GoodPairs PairZeros.
From faultspace Require Import CanonicalForm UnobservableZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section ObservablePart.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation no := (\rank (O S n)).

(** Pi forgets what cannot be seen; Psi is a right inverse. *)
Definition observable_part_maps (Pi : 'M[K]_(n, no)) (Psi : 'M[K]_(no, n)) (So : system K no m p) := [/\ Psi *m Pi = 1%:M,
  forall k (X : 'M[K]_(k, n)), X *m Pi = 0 <-> X *m O S n = 0, sysA S *m Pi = Pi *m sysA So, sysC S = Pi *m sysC So
  & sysF So = sysF S *m Pi /\ sysG So = sysG S].

Lemma observable_part_exists : exists Pi Psi So, observable_part_maps Pi Psi So.
Proof.
pose Pi := col_base (O S n); have /row_fullP[Psi PP] : row_full Pi := col_base_full _.
have kerE k (X : 'M[K]_(k, n)) : X *m Pi = 0 <-> X *m O S n = 0.
  have -> : X *m O S n = X *m Pi *m row_base (O S n) by rewrite -mulmxA mulmx_base.
  by split=> [->|/eqP]; [exact: mul0mx | rewrite mulmx_free_eq0 ?row_base_free // => /eqP].
have lost k (X : 'M[K]_(k, n)) : X *m Pi = 0 -> X *m sysC S = 0 /\ X *m sysA S *m Pi = 0.
  move=> /kerE z; split; first apply/row_matrixP => i.
    by rewrite row0 row_mul; apply: (unobservable_step _).1; rewrite -row_mul z row0.
  apply/kerE/row_matrixP => i; rewrite row0 !row_mul; apply: (unobservable_step _).2.
  by rewrite -row_mul z row0.
exists Pi, Psi, (System (Psi *m sysA S *m Pi) (sysF S *m Pi) (Psi *m sysC S) (sysG S)).
have z : (Pi *m Psi - 1%:M) *m Pi = 0 by rewrite mulmxBl mul1mx -mulmxA PP mulmx1 subrr.
have [zC zA] := lost _ _ z; split=> //=; apply/eqP; rewrite eq_sym -subr_eq0; apply/eqP.
  by rewrite !mulmxA -zA !mulmxBl !mul1mx !mulmxA.
by rewrite !mulmxA -zC mulmxBl mul1mx.
Qed.

Variables (Pi : 'M[K]_(n, no)) (Psi : 'M[K]_(no, n)) (So : system K no m p).
Hypothesis maps : observable_part_maps Pi Psi So.

Lemma part_state k (F : 'M_(k, n)) (G : 'M_(k, p)) x v j :
  state (with_faults S F G) x v j *m Pi = state (with_faults So (F *m Pi) G) (x *m Pi) v j.
Proof.
have [_ _ eA _ _] := maps; elim: j => //= j <-.
by rewrite mulmxDl -!mulmxA eA !mulmxA.
Qed.

Lemma part_output k (F : 'M_(k, n)) (G : 'M_(k, p)) x v j :
  output (with_faults S F G) x v j = output (with_faults So (F *m Pi) G) (x *m Pi) v j.
Proof. by have [_ _ _ eC _] := maps; rewrite /output -part_state /= eC mulmxA. Qed.

Lemma part_behavior k (F : 'M_(k, n)) (G : 'M_(k, p)) r :
  behavior (with_faults So (F *m Pi) G) r <-> behavior (with_faults S F G) r.
Proof.
have [PP _ _ _ _] := maps; split=> -[x [v e]]; last by exists (x *m Pi), v => j; rewrite e part_output.
by exists (x *m Psi), v => j; rewrite e part_output -mulmxA PP mulmx1.
Qed.

Lemma own_part_behavior r : behavior So r <-> behavior S r.
Proof.
have [_ _ _ _ [eF eG]] := maps; have := part_behavior (sysF S) (sysG S) r.
by rewrite with_own_faults -eF -eG with_own_faults.
Qed.

Lemma part_observable : row_free (O So no).
Proof.
have [PP kerE _ _ _] := maps; apply: inj_row_free => y /unobservable z.
rewrite -[y]mulmx1 -PP mulmxA; apply/kerE/unobservable => k.
rewrite -(output_free S (sysF S) (sysG S)) part_output -mulmxA PP mulmx1 output_free.
exact: z.
Qed.

Lemma part_lift k (Fo : 'M[K]_(k, no)) : Fo *m Psi *m Pi = Fo.
Proof. by have [PP _ _ _ _] := maps; rewrite -mulmxA PP mulmx1. Qed.

Lemma part_normal_rank : \rank (transfer So) = \rank (transfer S).
Proof. by apply: equal_behaviors_equal_normal_rank; apply/behavior_eqP/own_part_behavior. Qed.

Lemma part_zeta : zeta S = (zeta So + (n - no))%N.
Proof.
have words := (behavior_eqP So S).1 own_part_behavior.
have ranks s : \rank (window So s) = \rank (window S s) by apply/eqmx_rank/window_eqP.
have non : (no <= n)%N by apply: rank_leq_row.
have := (rank_window_zeta So n).2 (leq_trans (lag_le_n So) non); have := (rank_window_zeta S n).2 (lag_le_n S).
rewrite ranks (gap_normal_rank So (leqnn _)) (gap_normal_rank S (leqnn _)) part_normal_rank.
by move: (\rank (window S n)) (n * \rank (transfer S))%N non => a b; lia.
Qed.

End ObservablePart.

(** Ledger: zero-assignment, recoverable. *)
Theorem recoverable_pair_of_every_system (K : fieldType) n m p (S : system K n m p) : let r := \rank (transfer S) in
  exists (F : 'M_(r, n)) (G : 'M_(r, p)), let S' := with_faults S F G in
  (forall w, behavior S' w <-> behavior S w) /\
  (forall x y v w, (forall k, output S' x v k = output S' y w k) -> forall k, v k = w k).
Proof.
move=> r; have [Pi [Psi [So maps]]] := observable_part_exists S.
have [r0|rpos] := posnP r.
  have [P good] := good_pair_exists (leq_ltn_trans (lag_le_n S) (ltnSn n)) (solution_spaceP S n.+1).
  exists (lsubmx (P *m solution_space S n.+1)), (rsubmx (P *m solution_space S n.+1)); split=> // x y v w _ k.
  by apply/rowP => -[i ir]; exfalso; move: ir; rewrite -/r {1}r0.
have := recoverable_pair_exists (part_observable maps); rewrite (part_normal_rank maps) -/r => /(_ rpos)[Fo [G [same blind]]].
exists (Fo *m Psi), G; split=> [w | x y v w e].
  by rewrite -(part_behavior maps) (part_lift maps) same; apply: own_part_behavior maps w.
by apply: (blind (x *m Pi) (y *m Pi)) => k; rewrite -{1 2}(part_lift maps Fo) -!(part_output maps).
Qed.
