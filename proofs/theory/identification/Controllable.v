(** What n samples of the input reach, more do not: so with n past inputs as instruments or more, the limit of PI-MOESP with a white input
    is right, where s samples show all states, iff (A, B seen) is controllable in the usual sense: inputs lead from rest to every state.

    controllable S B == inputs through B lead from rest to every state *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Leads Persistency.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions. *)
Definition controllable (K : fieldType) n m p nu (S : system K n m p) (B : 'M[K]_(nu, n)) :=
  forall x, exists k u, state (with_faults S B (0 : 'M_(nu, p))) 0 u k = x.

Section Controllable.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)).

Lemma steered_space_more q : (n <= q)%N -> (steered_space S B q :=: orbit (sysA S) B)%MS.
Proof.
move=> nq; apply/eqmxP/andP; split; apply/sumsmx_subP=> k _; rewrite genmxE.
  elim: (k : nat) => [|j IH]; first exact: orbit_contains.
  by apply: submx_trans (orbit_stays (sysA S) B); apply: submxMr IH.
by apply: (sumsmx_sup (widen_ord nq k)) => //; rewrite genmxE.
Qed.

Lemma state_steered (u : nat -> 'rV_nu) k : (state (with_faults S B (0 : 'M_(nu, p))) 0 u k <= orbit (sysA S) B)%MS.
Proof.
elim: k => [|k IH] /=; first exact: sub0mx.
apply: addmx_sub; first by apply: submx_trans (submxMr _ IH) (orbit_stays _ _).
exact: submx_trans (submxMl _ _) (orbit_contains _ _).
Qed.

Lemma steered_space_state q x : (x <= steered_space S B q)%MS -> exists u, state (with_faults S B (0 : 'M_(nu, p))) 0 u q = x.
Proof.
case/sub_sumsmxP=> c ->.
have /fin_all_exists[d hd] (k : 'I_q) : exists d : 'rV_nu, c k *m <<times_power S B k>>%MS = d *m times_power S B k.
  by apply/submxP; rewrite -(genmxE (times_power S B k)) submxMl.
exists (fun j => if insub (q.-1 - j)%N is Some k then d k else 0); under eq_bigr => k _ do rewrite hd.
have sum u l : state (with_faults S B (0 : 'M_(nu, p))) 0 u l = \sum_(k < l) u (l.-1 - k)%N *m times_power S B k.
  elim: l u => [|l IH] u; first by rewrite big_ord0.
  rewrite [state _ _ _ _]/= IH big_ord_recl subn0 addrC mulmx_suml; congr (_ + _); apply: eq_bigr => k _.
  by rewrite -mulmxA /= subnS -[(_ - _).-1]subn1 subnAC subn1.
rewrite sum; apply: eq_bigr => k _; have kq : (k <= q.-1)%N by rewrite -ltnS (ltn_predK (ltn_ord k)).
by rewrite subKn // valK.
Qed.

Theorem controllable_steered_space q : (n <= q)%N -> controllable S B <-> row_full (steered_space S B q).
Proof.
move=> nq; rewrite -sub1mx; split=> [all_x|full x].
  by apply/row_subP=> i; have [k [u <-]] := all_x (row i 1%:M); rewrite steered_space_more // state_steered.
by exists q; apply: steered_space_state; apply: submx_trans full; apply: submx1.
Qed.

End Controllable.

(** A and C are right iff B seen controls A. *)
Theorem white_limit_controllable (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n))
    (D : 'M[K]_(nu, p)) (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p))
    H J (Phi : nat -> 'M[K]_(nu, m)) q t s L :
  process S B D u v x y -> white Q u H -> leads J Phi Q H u v -> (forall i, (J <= i < H)%N -> cov Q (u i) (x 0%N) = 0) ->
  (n <= q)%N -> (J + q <= t)%N -> (t + s + J <= H)%N -> row_free (O S s) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L == O S s)%MS <-> controllable S (seen_B S J Phi B).
Proof.
move=> model u_white v_leads past nq Jqt tH obs limit.
by rewrite (white_limit_right model u_white v_leads past Jqt tH obs limit) (controllable_steered_space _ _ nq).
Qed.
