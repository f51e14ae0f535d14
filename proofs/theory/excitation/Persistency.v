(** Persistency of excitation, after Willems, Rapisarda, Markovsky and De Moor [WRMM05]: if v is persistently exciting of order n + s,
    then the rows of [X V_s] span all pairs of a state that the faults and x(0) can reach and of s faults, controllable or not. Idea:
    what annihilates these rows annihilates them at later times, which by the monic relation of A gives an annihilator of n + s faults
    alone; its coefficients are zero, the last ones first.

        orbit A M == the smallest subspace that holds the rows of M and that A leaves in place
    excitable S x == the states that F and x reach *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Basics Places Reachable.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Section: definitions. *)
(** The smallest subspace that holds the rows of M and that A leaves in place, and the states that F and x reach. *)
Definition orbit (K : fieldType) n a (A : 'M[K]_n) (M : 'M[K]_(a, n)) : 'M[K]_n := (\sum_(k < n) <<iter k (mulmxr A) M>>)%MS.
Definition excitable (K : fieldType) n m p (S : system K n m p) (x : 'rV[K]_n) := orbit (sysA S) (col_mx (sysF S) x).

Section Orbit.
Variables (K : fieldType) (n : nat) (A : 'M[K]_n).

Lemma iter_mulmx a (M : 'M[K]_(a, n)) i k : row i (iter k (mulmxr A) M) = iter k (mulmxr A) (row i M).
Proof. by elim: k => //= k IH; rewrite row_mul IH. Qed.

Lemma orbit_power a (M : 'M[K]_(a, n)) k : (k < n)%N -> (iter k (mulmxr A) M <= orbit A M)%MS.
Proof. by move=> kn; apply: (sumsmx_sup (Ordinal kn)) => //; rewrite genmxE. Qed.

Lemma orbit_contains a (M : 'M[K]_(a, n)) : (M <= orbit A M)%MS.
Proof.
have [n0|] := posnP n; last exact: (@orbit_power _ M 0).
apply/row_subP=> i; rewrite (_ : row i M = 0) ?sub0mx //; apply/rowP=> j.
by have := leq_ltn_trans (leq0n j) (ltn_ord j); rewrite lt0n => /eqP/(_ n0).
Qed.

Lemma orbit_stays a (M : 'M[K]_(a, n)) : (orbit A M *m A <= orbit A M)%MS.
Proof.
rewrite sumsmxMr; apply/sumsmx_subP=> k _; rewrite (eqmxMr _ (genmxE _)) -[_ *m A]/(iter k.+1 (mulmxr A) M).
have := ltn_ord k; rewrite leq_eqVlt => /orP[/eqP->|]; last exact: orbit_power.
have [c relation] := monic_relation A; apply/row_subP=> i; rewrite iter_mulmx relation.
apply: summx_sub => j _; apply: scalemx_sub; rewrite -iter_mulmx; apply: submx_trans (row_sub _ _) _; exact: orbit_power.
Qed.

End Orbit.

Section Persistency.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m).
Let A := sysA S.
Let F := sysF S.

Lemma excitable_reachable x : holds_reachable S (excitable S x).
Proof.
rewrite /holds_reachable orbit_stays; apply: submx_trans (orbit_contains A (col_mx F x)).
by rewrite -addsmxE addsmxSl.
Qed.

Lemma excitable_initial x : (x <= excitable S x)%MS.
Proof. by apply: submx_trans (orbit_contains A (col_mx F x)); rewrite -addsmxE addsmxSr. Qed.

(** Annihilators (xi, eta) of all rows (x(i), v(i), ..., v(i+s-1)), several at once. *)
Section Annihilators.
Variables (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (M s q : nat) (xi : 'M[K]_(n, q)) (eta : nat -> 'M[K]_(m, q)).
Hypothesis excited : persistently_exciting M (n + s) v.
Hypothesis annihilated : forall i, (i < n + M)%N -> state S x v i *m xi + \sum_(j < s) v (i + j)%N *m eta j = 0.

Let power k := iter k (mulmx A) xi.
(** eta(s-1), ..., eta(0), F xi, F A xi, ... *)
Let omega t := if (t < s)%N then eta (s - t.+1)%N else F *m power (t - s).

Lemma annihilated_later k i : (i + k < n + M)%N ->
  state S x v i *m power k + \sum_(t < s + k) v (i + (s + k - t.+1))%N *m omega t = 0.
Proof.
elim: k i => [|k IH] i ik.
  rewrite !addn0 in ik *; rewrite -[RHS](annihilated ik); congr (_ + _).
  rewrite [RHS](reindex_inj rev_ord_inj); apply: eq_bigr => t _ /=.
  by rewrite /omega ltn_ord.
rewrite addnS big_ord_recr /= subnn addn0 addrCA -[RHS](IH i.+1) ?addSnnS // addrC; congr (_ + _).
  by rewrite mulmxDl -!mulmxA /omega ltnNge leq_addr addKn.
by apply: eq_bigr => t _; rewrite addSnnS subSn.
Qed.

(** The annihilator of v that the monic relation gives. *)
Let theta (c : nat -> K) j := omega (s + n - j.+1)%N - \sum_(k < n) c k *: (if (j < s + k)%N then omega (s + k - j.+1)%N else 0).

Lemma faults_annihilated (c : nat -> K) i : (forall y : 'rV_n, iter n (mulmxr A) y = \sum_(k < n) c k *: iter k (mulmxr A) y) ->
  (i < M)%N -> \sum_(j < n + s) v (i + j)%N *m theta c j = 0.
Proof.
move=> relation iM.
have turn k (y : 'rV_n) : iter k (mulmxr A) y *m xi = y *m power k.
  by elim: k y => // k IH y; rewrite iterSr IH mulmxA.
have later k : (k <= n)%N -> \sum_(j < n + s) v (i + j)%N *m (if (j < s + k)%N then omega (s + k - j.+1)%N else 0)
    = - (state S x v i *m power k).
  move=> kn; have ik : (i + k < n + M)%N by rewrite addnC; apply: leq_ltn_trans (leq_add kn (leqnn i)) _; rewrite ltn_add2l.
  have /eqP := annihilated_later ik; rewrite addrC addr_eq0 => /eqP<-.
  rewrite [RHS](reindex_inj rev_ord_inj) /=.
  rewrite (big_ord_widen (n + s)%N (fun j => v (i + (s + k - (s + k - j.+1).+1))%N *m omega (s + k - j.+1)%N)).
    rewrite [RHS]big_mkcond; apply: eq_bigr => j _; case: ifP => // jk; last by rewrite mulmx0.
    by rewrite subnSK // subKn // ltnW.
  by rewrite addnC leq_add2r.
under eq_bigr => j _ do rewrite mulmxBr mulmx_sumr.
rewrite sumrB exchange_big /=.
have -> : \sum_(j < n + s) v (i + j)%N *m omega (s + n - j.+1)%N = - (state S x v i *m power n).
  by rewrite -later //; apply: eq_bigr => j _; rewrite [(s + n)%N]addnC ltn_ord.
rewrite -turn relation mulmx_suml -opprD -big_split big1 ?oppr0 // => k _ /=.
under eq_bigr => j _ do rewrite -scalemxAr.
by rewrite -scaler_sumr later ?(ltnW (ltn_ord k)) // -scalemxAl turn scalerN subrr.
Qed.

Lemma omega_zero t : (t < n + s)%N -> omega t = 0.
Proof.
have [c relation] := monic_relation A.
have theta0 j : (j < n + s)%N -> theta c j = 0.
  move=> js; pose Th := \sum_(l < n + s) (place K m l)^T *m theta c l.
  have ThE (l : 'I_(n + s)) : place K m l *m Th = theta c l.
    rewrite mulmx_sumr (bigD1 l) //= big1 => [|l']; first by rewrite mulmxA place_orthonormal eqxx mul1mx addr0.
    by rewrite -val_eqE eq_sym mulmxA place_orthonormal => /negbTE->; rewrite mul0mx.
  have : hankel M (n + s) v *m Th = 0.
    apply/row_matrixP=> i; rewrite row_mul rowK row0 samples_places mulmx_suml -[RHS](faults_annihilated relation (ltn_ord i)).
    by apply: eq_bigr => l _; rewrite -mulmxA ThE.
  have /row_fullP[E EH] := excited.
  by move=> /(congr1 (mulmx E)); rewrite mulmxA EH mul1mx mulmx0 => Th0; rewrite -(ThE (Ordinal js)) Th0 mulmx0.
elim/ltn_ind: t => t IH ts; have lt : (n + s - t.+1 < n + s)%N by rewrite -subSn // subSS leq_subr.
have := theta0 _ lt; rewrite /theta [(s + n)%N]addnC subnSK // subKn ?(ltnW ts) // => /eqP; rewrite subr_eq0 => /eqP->.
rewrite big1 // => k _; case: ifP => [h|_]; last by rewrite scaler0.
have kt : (s + k - (n + s - t) < t)%N by have := ltn_ord k; move: h ts; lia.
by rewrite IH ?scaler0 // (ltn_trans kt).
Qed.

(** So it annihilates all faults, and all states that faults or x(0) can reach. *)
Lemma annihilates_excitable : (forall j, (j < s)%N -> eta j = 0) /\ excitable S x *m xi = 0.
Proof.
have eta0 j : (j < s)%N -> eta j = 0.
  move=> js; have ts : (s - j.+1 < s)%N by rewrite -subn_gt0 subKn.
  by have := omega_zero (ltn_addl n ts); rewrite /omega ts subnSK // subKn // ltnW.
split=> //.
have F0 k : (k < n)%N -> F *m power k = 0.
  move=> kn; have : omega (s + k) = 0 by apply: omega_zero; rewrite addnC ltn_add2r.
  by rewrite /omega ltnNge leq_addr addKn.
have state0 i : (i < n + M)%N -> state S x v i *m xi = 0.
  by move=> iM; rewrite -[RHS](annihilated iM) big1 ?addr0 // => j _; rewrite eta0 ?mulmx0.
have turn a (N : 'M[K]_(a, n)) k : iter k (mulmxr A) N *m xi = N *m power k.
  by elim: k N => // k IH N; rewrite iterSr IH mulmxA.
(* from rest the states are combinations of F, F A, ..., so the free response of x(0) is annihilated as well *)
have rest k : (k <= n)%N -> state S 0 v k *m xi = 0.
  move=> kn; suff [c ->] : exists c : nat -> 'rV_m, state S 0 v k = \sum_(j < k) c j *m iter j (mulmxr A) F.
    rewrite mulmx_suml big1 // => j _; rewrite -mulmxA turn F0 ?mulmx0 //; exact: leq_trans (ltn_ord j) kn.
  elim: k {kn} => [|k [c e]]; first by exists (fun=> 0); rewrite big_ord0.
  exists (fun j => if j is i.+1 then c i else v k); rewrite /= e big_ord_recl addrC mulmx_suml; congr (_ + _).
  by apply: eq_bigr => j _; rewrite -mulmxA.
apply/eqP; rewrite -submx0 /excitable /orbit sumsmxMr_gen; apply/sumsmx_subP=> k _.
rewrite genmxE (eqmxMr _ (genmxE _)) turn mul_col_mx F0 //.
rewrite -turn; have := state0 k; rewrite (leq_trans (ltn_ord k) (leq_addr _ _)) => /(_ isT).
rewrite state_split mulmxDl rest ?(ltnW (ltn_ord k)) // addr0 => e.
have -> : iter k (mulmxr A) x = state S x (fun=> 0) k by elim: (k : nat) => //= j ->; rewrite mul0mx addr0.
by rewrite e col_mx0 sub0mx.
Qed.

End Annihilators.

(** Willems' lemma, controllable or not. *)
Theorem persistency_excites x v M s : persistently_exciting M (n + s) v ->
  (excitation S x v (n + M) s :=: block_mx (excitable S x) 0 0 (1%:M : 'M_(s * m)))%MS.
Proof.
move=> pe; apply/eqmxP/andP; split.
  apply/row_subP=> i; rewrite rowK.
  have /submxP[c ->] := state_stays (excitable_reachable x) v i (excitable_initial x).
  by apply/submxP; exists (row_mx c (samples s (fun k => v (i + k)%N))); rewrite mul_row_block !mulmx0 mulmx1 addr0 add0r.
set E := excitation _ _ _ _ _; pose xi := usubmx (cokermx E); pose et := dsubmx (cokermx E).
pose eta k := (if insub k is Some j then place K m (j : 'I_s) else 0) *m et.
have etaE (j : 'I_s) : eta j = place K m j *m et by rewrite /eta valK.
have [i iM|eta0 x0] := @annihilates_excitable x v M s _ xi eta pe.
  have /(congr1 (row (Ordinal iM))) := mulmx_coker E; rewrite row_mul row0 rowK -[cokermx E]vsubmxK mul_row_col => e.
  rewrite -[RHS]e samples_places mulmx_suml; congr (_ + _); apply: eq_bigr => j _.
  by rewrite etaE mulmxA.
rewrite submxE -[cokermx E]vsubmxK mul_block_col !mul0mx mul1mx addr0 add0r -/xi -/et x0.
rewrite (_ : et = 0) ?col_mx0 // -[et]mul1mx -sum_places mulmx_suml big1 // => j _.
by rewrite -mulmxA -etaE eta0 // mulmx0.
Qed.

(** Where F and x(0) reach everything this is full rank. *)
Corollary persistency_full x v M s : persistently_exciting M (n + s) v -> row_full (excitable S x) ->
  row_full (excitation S x v (n + M) s).
Proof.
move=> pe full; rewrite -sub1mx (persistency_excites x pe) scalar_mx_block.
rewrite -sub1mx in full; have /submxP[D e] := full.
by apply/submxP; exists (block_mx D 0 0 1%:M); rewrite mulmx_block !mulmx0 !mul0mx mulmx1 !addr0 add0r -e.
Qed.

End Persistency.
