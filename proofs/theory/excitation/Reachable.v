(** States restricted to a subspace U that A leaves in place and that contains the rows of F, as the states do that faults can reach. A
    monic polynomial of A, applied to sequences, moves every initial state into U; so what a fault pair (f, g) does from rest is
    possible in S as soon as it is possible with initial states in U.

    holds_reachable S U == U holds the rows of F, and A leaves it in place
         restricted S U == S with initial states in U, in coordinates of U *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra mxpoly.
From faultspace Require Import Vocabulary Basics Gap Proposition3 MorphismNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions. *)
Section Definitions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (U : 'M[K]_n).
Definition holds_reachable := (U *m sysA S <= U)%MS && (sysF S <= U)%MS.
(** S with initial states in U, in coordinates of U. *)
Definition restricted : system K (\rank U) m p :=
  System (row_base U *m sysA S *m pinvmx (row_base U)) (sysF S *m pinvmx (row_base U)) (row_base U *m sysC S) (sysG S).
End Definitions.

(** A^n is a combination of lower powers. *)
Lemma monic_relation (K : fieldType) n (A : 'M[K]_n) : exists c : nat -> K,
  forall x : 'rV_n, iter n (mulmxr A) x = \sum_(k < n) c k *: iter k (mulmxr A) x.
Proof.
case: n A => [|n] A; first by exists (fun=> 0) => x; rewrite big_ord0 [iter _ _ _]thinmx0.
exists (fun k => - (char_poly A)`_k) => x.
have power k : iter k (mulmxr A) x = x *m A ^+ k.
  by elim: k => [|k IH] /=; rewrite ?mulmx1 // IH exprSr mulmxA.
have := Cayley_Hamilton A; rewrite -{1}[char_poly A]coefK size_char_poly poly_def big_ord_recr /= -/(lead_coef _).
have -> : (char_poly A)`_n.+1 = 1 by have /monicP := char_poly_monic A; rewrite /lead_coef size_char_poly.
rewrite scale1r rmorphD rmorphXn /= horner_mx_X rmorph_sum /= addrC => /eqP; rewrite addr_eq0 => /eqP e.
rewrite -[LHS]/(iter n.+1 (mulmxr A) x) power e mulmxN mulmx_sumr -sumrN; apply: eq_bigr => k _; rewrite power scaleNr; congr (- _).
by rewrite -mul_polyC rmorphM rmorphXn /= horner_mx_X horner_mx_C -mulmxE mul_scalar_mx -scalemxAr.
Qed.

(** A sequence with given n first terms zero and given values of a monic polynomial of the shift. *)
Lemma monic_onto (K : fieldType) m n (c : nat -> K) (w : nat -> 'rV[K]_m) :
  exists u : nat -> 'rV[K]_m, (forall k, (k < n)%N -> u k = 0) /\ forall k, u (n + k)%N = w k + \sum_(j < n) c j *: u (j + k)%N.
Proof.
pose next k l := if (k < n)%N then 0 else w (k - n)%N + \sum_(j < n) c j *: nth 0 l (j + (k - n))%N.
pose listed := fix listed k := if k is j.+1 then rcons (listed j) (next j (listed j)) else [::].
have size_listed k : size (listed k) = k by elim: k => //= k IH; rewrite size_rcons IH.
have stays d i k : (i < k)%N -> nth 0 (listed (d + k)%N) i = nth 0 (listed k) i.
  move=> ik; elim: d => //= d <-; rewrite nth_rcons size_listed.
  by rewrite (leq_trans ik (leq_addl _ _)).
have nthE i k : (i < k)%N -> nth 0 (listed k) i = next i (listed i).
  by move=> ik; rewrite -(subnK ik) stays //= nth_rcons size_listed ltnn eqxx.
exists (fun k => next k (listed k)); split=> [k kn|k]; first by rewrite /next kn.
rewrite {1}/next ltnNge leq_addr /= addKn; congr (_ + _); apply: eq_bigr => j _; congr (_ *: _).
by rewrite nthE // ltn_add2r.
Qed.

Lemma shift_polynomial (K : fieldType) n m p (S : system K n m p) N (c : nat -> K) (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) k :
  output S x v (N + k) - \sum_(j < N) c j *: output S x v (j + k) =
  output S (state S x v N - \sum_(j < N) c j *: state S x v j) (fun i => v (N + i)%N - \sum_(j < N) c j *: v (j + i)%N) k.
Proof.
rewrite output_sub -output_shift; congr (_ - _).
by rewrite output_sum; apply: eq_bigr => j _; rewrite output_scale -output_shift.
Qed.

Section Reachable.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x y : 'rV[K]_n) (v : nat -> 'rV[K]_m).

Variable U : 'M[K]_n.
Hypothesis U_reachable : holds_reachable S U.

Lemma state_stays x v k : (x <= U)%MS -> (state S x v k <= U)%MS.
Proof.
have /andP[UA FU] := U_reachable; move=> xU; elim: k => //= k IH; apply: addmx_sub.
  by apply: submx_trans (submxMr _ IH) UA.
exact: submx_trans (submxMl _ _) FU.
Qed.

Lemma restricted_state (y : 'rV_(\rank U)) v k : state (restricted S U) y v k *m row_base U = state S (y *m row_base U) v k.
Proof.
have /andP[UA FU] := U_reachable.
have rA : sysA (restricted S U) *m row_base U = row_base U *m sysA S.
  by rewrite mulmxKpV // (eqmxMr _ (eq_row_base U)) eq_row_base.
have rF : sysF (restricted S U) *m row_base U = sysF S by rewrite mulmxKpV // eq_row_base.
elim: k => [|k IH] //; pose R := restricted S U.
rewrite -/R -[state R y v k.+1]/(state R y v k *m sysA R + v k *m sysF R).
by rewrite mulmxDl -(mulmxA _ (sysA R)) -(mulmxA _ (sysF R)) rA rF mulmxA IH.
Qed.

Lemma restricted_output (y : 'rV_(\rank U)) v k : output (restricted S U) y v k = output S (y *m row_base U) v k.
Proof. by rewrite /output /= mulmxA restricted_state. Qed.

Lemma in_row_base x : (x <= U)%MS -> exists y : 'rV_(\rank U), x = y *m row_base U.
Proof. by rewrite -(eq_row_base U) => /submxP. Qed.

Lemma restricted_word s r : word (restricted S U) s r <->
  exists x v, (x <= U)%MS /\ forall k, (k < s)%N -> r k = output S x v k.
Proof.
split=> [[y [v e]]|[x [v [/in_row_base[y ->] e]]]].
  exists (y *m row_base U), v; split=> [|k ks]; last by rewrite e // restricted_output.
  by apply: submx_trans (submxMl _ _) _; rewrite eq_row_base.
by exists y, v => k ks; rewrite e // restricted_output.
Qed.

Lemma restricted_word_sub s r : word (restricted S U) s r -> word S s r.
Proof. by move/restricted_word=> [x [v [_ e]]]; exists x, v. Qed.

(** From rest nothing changes, so neither does left-invertibility. *)
Lemma restricted_from_rest v k : output (restricted S U) 0 v k = output S 0 v k.
Proof. by rewrite restricted_output mul0mx. Qed.

Lemma restricted_left_invertible : left_invertible (restricted S U) <-> left_invertible S.
Proof. by split=> h v z; apply: h => k; have := z k; rewrite restricted_from_rest. Qed.

(** The gap cannot grow; so it is m as soon as it is m for S, if S is left-invertible. *)
Lemma gap_restricted s : (gap (restricted S U) s <= gap S s)%N.
Proof.
apply: mxrankS; apply/row_subP=> i; apply/after_zerosP/restricted_word_sub/after_zerosP; exact: row_sub.
Qed.

Theorem gap_restricted_left_invertible s : left_invertible S -> gap S s = m -> gap (restricted S U) s = m.
Proof.
move=> linv e; apply/eqP; rewrite eqn_leq; apply/andP; split; first by apply: leq_trans (gap_restricted s) _; rewrite e.
have h : gap (restricted S U) (maxn n s) = m.
  by apply/gap_left_invertible; [apply: leq_trans (rank_leq_row U) (leq_maxl _ _)|apply/restricted_left_invertible].
by apply: leq_trans (gap_decreasing _ (leq_maxr n s)); rewrite h.
Qed.

(** What (f, g) does from rest. *)
Theorem from_rest_in_restricted (f : 'rV_n) (g : 'rV_p) : (forall w, behavior S (output (with_faults S f g) 0 w)) ->
  forall w s, word (restricted S U) s (output (with_faults S f g) 0 w).
Proof.
move=> incl w s; have [c relation] := monic_relation (sysA S).
have [u [u0 ue]] := monic_onto n c w; have [x [v e]] := incl u.
apply/restricted_word; exists (state S x v n - \sum_(j < n) c j *: state S x v j), (fun i => v (n + i)%N - \sum_(j < n) c j *: v (j + i)%N).
split=> [|k _].
  have split j : state S x v j = iter j (mulmxr (sysA S)) x + state S 0 v j.
    by rewrite state_split; congr (_ + _); elim: j => //= j ->; rewrite mul0mx addr0.
  have -> : \sum_(j < n) c j *: state S x v j = \sum_(j < n) c j *: iter j (mulmxr (sysA S)) x + \sum_(j < n) c j *: state S 0 v j.
    by rewrite -big_split; apply: eq_bigr => j _ /=; rewrite (split j) scalerDr.
  rewrite (split n) relation opprD addrACA subrr add0r; apply: addmx_sub; first by apply: state_stays; apply: sub0mx.
  rewrite eqmx_opp; apply: summx_sub => j _; apply: scalemx_sub; apply: state_stays; exact: sub0mx.
rewrite -shift_polynomial.
transitivity (output (with_faults S f g) 0 u (n + k) - \sum_(j < n) c j *: output (with_faults S f g) 0 u (j + k)).
  rewrite shift_polynomial state_zero // big1 ?subr0 => [|j _].
    by apply: output_ext => j _; rewrite ue addrK.
  by rewrite state_zero ?scaler0 // => i ij; apply: u0; apply: ltn_trans ij _.
by rewrite e; congr (_ - _); apply: eq_bigr => j _; rewrite e.
Qed.

End Reachable.
