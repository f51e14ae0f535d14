(** The Popov form of the kernel representation of a behaviour: which matrix it is is known from the behaviour, and every system has one.
    Columns are read as single polynomials (PowerModules.v), whose modules over K[q^p] have exactly one reduced basis; and what annihilates
    all signals that a reduced basis annihilates is in its module, for signals can be chosen freely where no element of the basis leads. So
    a matrix in Popov form is known from its kernel.

        applied p f w t == (f(q) w)(p t)
    next, begun, signal == a signal w with f(q) w = 0 at the multiples of p for each f of a reduced basis, and with given values elsewhere
           interlaced c == c_0(q^p) + q c_1(q^p) + ... + q^(p-1) c_(p-1)(q^p) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary StructureVocabulary MinimalIndices PowerModules KernelRepresentation.
From faultspace Require Theorem3 Indices.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** What annihilates all signals that a reduced basis annihilates *)

Section Signals.
Variables (K : fieldType) (p : nat).
Hypothesis p_gt0 : (0 < p)%N.
Implicit Types (u c f g h : {poly K}).
Notation lead f := (size f).-1.

(** f(q) w at the times 0, p, 2p, ... *)
Definition applied f (w : nat -> K) t := \sum_(m < size f) f`_m * w (p * t + m)%N.

Lemma applied_wide f w t s : (size f <= s)%N -> applied f w t = \sum_(m < s) f`_m * w (p * t + m)%N.
Proof.
move=> fs; rewrite /applied (big_ord_widen s (fun m => f`_m * w (p * t + m)%N) fs) big_mkcond; apply: eq_bigr => m _ /=.
by case: ltnP => // fm; rewrite nth_default ?mul0r.
Qed.

Lemma appliedD f g w t : applied (f + g) w t = applied f w t + applied g w t.
Proof.
pose s := maxn (size f) (size g); have [fs gs] : (size f <= s)%N /\ (size g <= s)%N by rewrite leq_maxl leq_maxr.
rewrite (applied_wide w t (leq_trans (size_add f g) (leqnn s))) (applied_wide w t fs) (applied_wide w t gs) -big_split.
by apply: eq_bigr => m _; rewrite coefD mulrDl.
Qed.

Lemma applied0 w t : applied 0 w t = 0.
Proof. by rewrite /applied size_poly0 big_ord0. Qed.

Lemma applied_sum I (r : seq I) (g : I -> {poly K}) w t : applied (\sum_(i <- r) g i) w t = \sum_(i <- r) applied (g i) w t.
Proof. by elim: r => [|i r IH]; rewrite ?big_nil ?applied0 // !big_cons appliedD IH. Qed.

Lemma applied_monomial f x k w t : applied ((x *: 'X^(p * k)) * f) w t = x * applied f w (t + k).
Proof.
have le : (size ((x *: 'X^(p * k)) * f)%R <= p * k + size f)%N.
  apply: leq_trans (size_mul_leq _ _) _; have := size_scale_leq x 'X^(p * k); rewrite size_polyXn => xk.
  by rewrite -subn1 leq_subLR addnA add1n leq_add2r.
rewrite (applied_wide w t le) big_split_ord /= big1 ?add0r => [|m _]; last first.
  by rewrite -scalerAl coefZ coefXnM ltn_ord mulr0 mul0r.
rewrite /applied mulr_sumr; apply: eq_bigr => m _; rewrite -scalerAl coefZ coefXnM ltnNge leq_addr addKn mulrA.
by congr (_ * w _); rewrite mulnDr addnA.
Qed.

Lemma applied_upto u f w : (forall t, applied f w t = 0) -> forall t, applied (upto p u * f) w t = 0.
Proof.
move=> zero t; rewrite /upto comp_polyE mulr_suml applied_sum big1 // => k _.
by rewrite -exprM applied_monomial zero mulr0.
Qed.

Section Signal.
Variables (d : nat) (f : 'I_d -> {poly K}) (s : nat).
Hypothesis red : reduced p f.

(** The signal that is 1 at s and free to be 0 elsewhere but where some f j determines it from what came before. *)
Definition next (l : seq K) : K :=
  if [pick j | (lead (f j) <= size l)%N && (p %| size l - lead (f j))%N] is Some j
  then - \sum_(y < lead (f j)) (f j)`_y * l`_(size l - lead (f j) + y) else (size l == s)%:R.
Fixpoint begun n := if n is k.+1 then rcons (begun k) (next (begun k)) else [::].
Definition signal m := next (begun m).

Lemma size_begun n : size (begun n) = n.
Proof. by elim: n => //= n IH; rewrite size_rcons IH. Qed.

Lemma begun_signal n k : (k < n)%N -> (begun n)`_k = signal k.
Proof.
elim: n => // n IH; rewrite ltnS leq_eqVlt /= nth_rcons size_begun => /orP[/eqP ->|kn]; first by rewrite ltnn eqxx.
by rewrite kn IH.
Qed.

Lemma signal_free m : (forall j a, m != (lead (f j) + p * a)%N) -> signal m = (m == s)%:R.
Proof.
move=> free; rewrite /signal /next; case: pickP => [j /andP[]|_]; rewrite size_begun // => le /dvdnP[a e].
by have := free j a; rewrite mulnC -e subnKC // eqxx.
Qed.

Lemma signal_annihilated j t : applied (f j) signal t = 0.
Proof.
have [monic _ _] := red; have f0 i : f i != 0 by apply: monic_neq0.
rewrite /applied -(prednK (_ : 0 < size (f j))%N) ?size_poly_gt0 // big_ord_recr /= -/(lead_coef _) (eqP (monic j)) mul1r.
rewrite {2}/signal /next size_begun; case: pickP => [i /andP[le div]|/(_ j)]; last by rewrite leq_addl addnK dvdn_mulr.
have ij : i = j.
  apply: (reduced_apart red) => //; move: div; rewrite -eqn_mod_dvd // => /eqP <-.
  by rewrite mulnC modnMDl.
rewrite ij addnK; apply/eqP; rewrite subr_eq0; apply/eqP; apply: eq_bigr => y _.
by rewrite begun_signal // ltn_add2l.
Qed.

End Signal.

Theorem generated_by_annihilation d (f : 'I_d -> {poly K}) c : reduced p f ->
  (forall w, (forall j t, applied (f j) w t = 0) -> forall t, applied c w t = 0) -> generated p f c.
Proof.
move=> red ann; have [monic _ _] := red; have [|h [gen _ zero]] := @division _ p p_gt0 _ f c; first by move=> j; apply: monic_neq0.
suff h0 : h = 0 by rewrite h0 subr0 in gen.
apply/eqP; apply: contraT; rewrite -lead_coef_eq0; set s := lead h; pose w := signal f s.
have wf j t : applied (f j) w t = 0 by apply: signal_annihilated.
have : applied h w 0 = 0.
  have [u e] := gen; have := ann w wf 0%N; rewrite -[c](subrK h) appliedD e applied_sum big1 ?add0r // => j _.
  exact: applied_upto.
suff -> : applied h w 0 = lead_coef h by move=> ->; rewrite eqxx.
have [->|h0] := eqVneq h 0; first by rewrite applied0 lead_coef0.
rewrite /applied -(prednK (_ : 0 < size h)%N) ?size_poly_gt0 // big_ord_recr /= big1 ?add0r => [|m _].
all: rewrite muln0 add0n /w.
  rewrite signal_free ?eqxx ?mulr1 // => j a; apply: contraNneq h0 => e; rewrite -lead_coef_eq0 /lead_coef.
  by have := zero j a; rewrite -e => ->.
have [->|hm] := eqVneq h`_m 0; first by rewrite mul0r.
rewrite signal_free; first by rewrite (ltn_eqF (ltn_ord m)) mulr0.
by move=> j a; apply: contraNneq hm => ->; rewrite zero.
Qed.

End Signals.

(** ** Columns as single polynomials *)

Section Columns.
Variables (K : fieldType) (p : nat).
Hypothesis p_gt0 : (0 < p)%N.
Implicit Types (c : 'cV[{poly K}]_p) (i : 'I_p).

Definition interlaced c := \sum_i upto p (c i 0) * 'X^i.

Lemma place_lt k l i (j : 'I_p) : (p * k + i < p * l + j)%N = (k < l)%N || (k == l) && (i < j)%N.
Proof.
have up a b (i' j' : 'I_p) : (a < b)%N -> (p * a + i' < p * b + j')%N.
  move=> ab; apply: leq_trans (leq_addr _ _); apply: leq_trans (_ : p * a.+1 <= _)%N; last by rewrite leq_mul2l ab orbT.
  by rewrite mulnS addnC ltn_add2r.
case: (ltngtP k l) => [/up ->|lk|->] //=; last by rewrite ltn_add2l.
by apply/negbTE; rewrite -leqNgt ltnW // up.
Qed.

Lemma place_eq k l i (j : 'I_p) : (p * k + i == p * l + j)%N = (i == j) && (k == l).
Proof.
apply/eqP/andP => [e|[/eqP -> /eqP ->] //]; have := place_lt k l i j; have := place_lt l k j i; rewrite e !ltnn.
rewrite -[i == j]/(i == j :> nat).
by case: (ltngtP k l); case: (ltngtP i j).
Qed.

Lemma placed m : exists k i, m = (p * k + i)%N.
Proof. by exists (m %/ p)%N, (Ordinal (ltn_pmod m p_gt0)); rewrite mulnC -divn_eq. Qed.

Lemma upto_sum (u : {poly K}) : upto p u = \sum_(l < size u) u`_l *: 'X^(p * l).
Proof. by rewrite /upto comp_polyE; apply: eq_bigr => l _; rewrite -exprM. Qed.

Lemma coef_interlaced c k i : (interlaced c)`_(p * k + i) = (c i 0)`_k.
Proof.
have coef j : (upto p (c j 0) * 'X^j)`_(p * k + i) = if i == j then (c j 0)`_k else 0.
  rewrite upto_sum mulr_suml coef_sum; transitivity (\sum_(l < size (c j 0%R)) (c j 0)`_l * ((i == j) && (k == l))%:R).
    by apply: eq_bigr => l _; rewrite -scalerAl coefZ -exprD coefXn place_eq.
  case: eqP => _; last by rewrite big1 // => l _; rewrite mulr0.
  have [ks|sk] := ltnP k (size (c j 0%R)); last first.
    by rewrite nth_default // big1 // => l _; rewrite gtn_eqF ?mulr0 // (leq_trans (ltn_ord l)).
  rewrite (bigD1 (Ordinal ks)) //= eqxx mulr1 big1 ?addr0 // => l; rewrite -val_eqE eq_sym /= => /negPf ->.
  by rewrite mulr0.
rewrite coef_sum (bigD1 i) //= coef eqxx big1 ?addr0 // => j; rewrite coef eq_sym => /negPf -> //.
Qed.

Lemma interlaced_inj : injective interlaced.
Proof.
move=> c c' e; apply/matrixP => i j; rewrite ord1; apply/polyP => k.
by rewrite -!coef_interlaced e.
Qed.

Lemma interlacedM d (N : 'M_(p, d)) (u : 'cV_d) : interlaced (N *m u) = \sum_j upto p (u j 0) * interlaced (col j N).
Proof.
have upto_add : {morph @upto K p : x y / x + y} by move=> x y; apply: comp_polyD.
transitivity (\sum_i \sum_j upto p (u j 0) * (upto p (N i j) * 'X^i)).
  apply: eq_bigr => i _; rewrite mxE (big_morph _ upto_add (upto0 _ p)) mulr_suml; apply: eq_bigr => j _.
  by rewrite mulrA; congr (_ * _); rewrite mulrC; apply: comp_polyM.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_sumr; apply: eq_bigr => i _.
by rewrite mxE.
Qed.

Lemma combinations d (N : 'M_(p, d)) c : (exists u, c = N *m u) <-> generated p (fun j => interlaced (col j N)) (interlaced c).
Proof.
split=> [[u ->]|[u e]]; first by exists (fun j => u j 0); rewrite interlacedM.
exists (\col_j u j); apply: interlaced_inj; rewrite interlacedM e; apply: eq_bigr => j _.
by rewrite mxE.
Qed.

Lemma interlaced_onto d (f : 'I_d -> {poly K}) : exists N : 'M_(p, d), forall j, interlaced (col j N) = f j.
Proof.
exists (\matrix_(i, j) \poly_(k < size (f j)) (f j)`_(p * k + i)) => j; apply/polyP => m; have [k [i ->]] := placed m.
rewrite coef_interlaced !mxE coef_poly; case: ltnP => // le; rewrite nth_default //.
by apply: leq_trans le _; apply: leq_trans (leq_addr _ _); rewrite leq_pmull.
Qed.

Variables (d : nat) (N : 'M[{poly K}]_(p, d)).
Notation f j := (interlaced (col j N)).

Lemma coef_column k i j : (f j)`_(p * k + i) = (N i j)`_k.
Proof. by rewrite coef_interlaced mxE. Qed.

Lemma column_size i j k : (forall l, (k <= l)%N -> (f j)`_(p * l + i) = 0) -> (size (N i j) <= k)%N.
Proof. by move=> zero; apply/leq_sizeP => l kl; rewrite -coef_column zero. Qed.

Lemma popov_reduced : popov_form N -> reduced p (fun j => f j).
Proof.
case=> pivot; set s := fun j => size _ => -[monic top clear ascend].
have s_gt0 j : (0 < s j)%N by rewrite size_poly_gt0 monic_neq0.
have one j : (f j)`_(p * (s j).-1 + pivot j) = 1 by rewrite coef_column -/(lead_coef _) (eqP (monic j)).
have size_f j : size (f j) = (p * (s j).-1 + pivot j).+1.
  apply/eqP; rewrite eqn_leq; apply/andP; split; last first.
    by rewrite ltnNge; apply/negP => le; have := one j; rewrite nth_default // => /esym/eqP; rewrite oner_eq0.
  apply/leq_sizeP => m; have [k [i ->]] := placed m; rewrite place_lt coef_column => lt; apply: nth_default.
  have [le lt_below] := top i j; case/orP: lt => [lt|/andP[/eqP <- /lt_below]]; last by move=> lt; rewrite -ltnS prednK.
  by apply: leq_trans le _; rewrite -(prednK (s_gt0 j)).
split=> [j|j k a jk|j k jk]; first by rewrite monicE /lead_coef size_f one.
  rewrite size_f /= addnAC -mulnDr coef_column; apply: nth_default; have := clear j k jk.
  by rewrite -/(s j) -{1}(prednK (s_gt0 j)) ltnS => /leq_trans -> //; apply: leq_addr.
rewrite !size_f /= place_lt; case: (ascend j k jk) => [|[-> ->]]; last by rewrite eqxx orbT.
by rewrite -(prednK (s_gt0 j)) -(prednK (s_gt0 k)) ltnS => ->.
Qed.

Lemma reduced_popov : reduced p (fun j => f j) -> popov_form N.
Proof.
move=> [monic clear ascend]; pose l j := (size (f j)).-1; pose pivot j := Ordinal (ltn_pmod (l j) p_gt0).
have leadE j : l j = (p * (l j %/ p) + pivot j)%N by rewrite mulnC -divn_eq.
have beyond j m : (l j < m)%N -> (f j)`_m = 0 by move=> lm; apply: nth_default; apply: leq_trans lm; apply: leqSpred.
have one j : (N (pivot j) j)`_(l j %/ p) = 1 by rewrite -coef_column -leadE -(eqP (monic j)).
have size_pivot j : size (N (pivot j) j) = (l j %/ p).+1.
  apply/eqP; rewrite eqn_leq; apply/andP; split; last first.
    by rewrite ltnNge; apply/negP => le; have := one j; rewrite nth_default // => /esym/eqP; rewrite oner_eq0.
  by apply: column_size => k lk; apply: beyond; rewrite leadE place_lt lk.
exists pivot; split=> [j|i j|j k jk|j k jk].
- by rewrite monicE /lead_coef size_pivot one.
- rewrite size_pivot; split=> [|ij]; first by apply: column_size => k lk; apply: beyond; rewrite leadE place_lt lk.
  rewrite ltnS; apply: column_size => k; rewrite leq_eqVlt => /orP[/eqP <-|lk]; apply: beyond; rewrite {1}leadE place_lt ?lk //.
  by rewrite eqxx ij orbT.
- rewrite size_pivot ltnS; apply: column_size => k' le.
  have -> : (p * k' + pivot j = l j + p * (k' - l j %/ p))%N by rewrite {1}leadE addnAC -mulnDr subnKC.
  exact: clear.
rewrite !size_pivot ltnS; have := ascend j k jk; rewrite -/(l j) -/(l k) {1}(leadE j) {1}(leadE k) place_lt.
by case/orP=> [->|/andP[/eqP -> ->]]; [left | right].
Qed.

End Columns.

Section Kernel.
Variables (K : fieldType) (p : nat).
Hypothesis p_gt0 : (0 < p)%N.

(** A column c of difference equations, of a signal that is read p samples at a time. *)
Lemma shifted_applied (c : 'cV[{poly K}]_p) w t : shifted c (fun k => \row_i w (p * k + i)%N) t = (applied p (interlaced c) w t)%:M.
Proof.
have single i k : applied p 'X^i w k = w (p * k + i)%N.
  rewrite /applied size_polyXn big_ord_recr /= coefXn eqxx mul1r big1 ?add0r // => m _.
  by rewrite coefXn ltn_eqF ?mul0r.
have -> : applied p (interlaced c) w t = \sum_i \sum_(k < sizem c) (c i 0)`_k * w (p * (t + k) + i)%N.
  rewrite applied_sum; apply: eq_bigr => i _; rewrite upto_sum mulr_suml applied_sum.
  transitivity (\sum_(k < size (c i 0%R)) (c i 0)`_k * w (p * (t + k) + i)%N).
    by apply: eq_bigr => k _; rewrite applied_monomial single.
  have le : (size (c i 0%R) <= sizem c)%N by apply: (leq_bigmax (i, 0)).
  rewrite (big_ord_widen _ (fun k => (c i 0)`_k * w (p * (t + k) + i)%N) le) big_mkcond; apply: eq_bigr => k _ /=.
  by case: ltnP => // ck; rewrite nth_default ?mul0r.
apply/matrixP => i j; rewrite !ord1 {i j} [RHS]mxE /= mulr1n exchange_big /shifted summxE; apply: eq_bigr => k _.
by rewrite mxE; apply: eq_bigr => i _; rewrite !mxE mulrC.
Qed.

End Kernel.

Section Popov.
Variables (K : fieldType) (p : nat).

(** A matrix in Popov form generates all equations that hold on its kernel. *)
Theorem popov_equations d (N : 'M[{poly K}]_(p, d)) (c : 'cV_p) : popov_form N ->
  (forall r, (forall t, shifted N r t = 0) -> forall t, shifted c r t = 0) <-> exists u, c = N *m u.
Proof.
move=> popov; split=> [ann | [u ->] r zero]; last exact: shifted_mul.
have [p0|p_gt0] := posnP p; first by exists 0; apply/matrixP => i; have := ltn_ord i; rewrite [X in (_ < X)%N]p0.
apply/(combinations N c); apply: (generated_by_annihilation p_gt0 (popov_reduced p_gt0 popov)) => w zero t.
have /(_ _ t) := ann (fun k => \row_i w (p * k + i)%N); rewrite shifted_applied => e.
have /matrixP/(_ 0 0) : (applied p (interlaced c) w t)%:M = 0 :> 'M_1; last by rewrite !mxE.
by apply: e => k; apply/shifted_cols => j; rewrite shifted_applied zero raddf0.
Qed.

Lemma no_outputs d (N : 'M[{poly K}]_(p, d)) : p = 0%N -> popov_form N -> d = 0%N.
Proof.
move=> p0 [pivot _]; case: d N pivot => // d N pivot.
by have := ltn_ord (pivot ord0); rewrite [X in (_ < X)%N]p0.
Qed.

Theorem popov_unique d d' (N : 'M[{poly K}]_(p, d)) (N' : 'M_(p, d')) : popov_form N -> popov_form N' ->
  (forall c : 'cV_p, (exists u, c = N *m u) <-> exists u, c = N' *m u) -> exists e : d = d', castmx (erefl, e) N = N'.
Proof.
move=> popov popov' same; have [p0|p_gt0] := posnP p.
  have e : d = d' by rewrite (no_outputs p0 popov) (no_outputs p0 popov').
  by exists e; apply/matrixP => i; have := ltn_ord i; rewrite [X in (_ < X)%N]p0.
have [|e colE] := reduced_unique p_gt0 (popov_reduced p_gt0 popov) (popov_reduced p_gt0 popov').
  move=> g; have [M /(_ ord0) <-] := interlaced_onto p_gt0 (fun _ : 'I_1 => g).
  by rewrite -!combinations; apply: same.
exists e; case: _ / e N' {popov' same} colE => N' colE; rewrite castmx_id; apply/matrixP => i j.
have /interlaced_inj/matrixP/(_ i 0) := colE j; rewrite cast_ord_id.
by rewrite !mxE.
Qed.

(** The columns of every matrix generate what those of one in Popov form do. *)
Theorem popov_exists e (M : 'M[{poly K}]_(p, e)) : exists d (N : 'M_(p, d)), popov_form N /\
  forall c : 'cV_p, (exists u, c = N *m u) <-> exists u, c = M *m u.
Proof.
have [p0|p_gt0] := posnP p.
  have no (Q : Prop) (j : 'I_0) : Q by case: j.
  exists 0%N, 0; split; first by exists (fun j => match no False j with end); split=> [j|i j|j|j]; apply: no j.
  by move=> c; split=> _; exists 0; apply/matrixP => i; have := ltn_ord i; rewrite [X in (_ < X)%N]p0.
have [d [f [red gen]]] := reduced_exists p_gt0 (fun j => interlaced (col j M)); have [N colE] := interlaced_onto p_gt0 f.
exists d, N; split=> [|c].
  apply: reduced_popov => //; have [monic clear ascend] := red.
  by split=> [j|j k a jk|j k jk]; rewrite !colE; [apply: monic | apply: clear | apply: ascend].
rewrite !combinations // -gen; split; apply: generated_trans => j; rewrite ?colE; [|rewrite -(colE j)]; exact: generated_one.
Qed.

(** Equal kernels, equal matrices. *)
Theorem popov_kernel_unique d d' (N : 'M[{poly K}]_(p, d)) (N' : 'M_(p, d')) : popov_form N -> popov_form N' ->
  (exists e : d = d', castmx (erefl, e) N = N') <->
  (forall r, (forall t, shifted N r t = 0) <-> forall t, shifted N' r t = 0).
Proof.
move=> popov popov'; split=> [[e <-] r|same]; first by case: _ / e; rewrite castmx_id.
apply: popov_unique => // c; rewrite -!popov_equations //.
by split=> ann r /same; apply: ann.
Qed.

End Popov.

(** ** The Popov rows of a system *)

Section Systems.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** Ledger: canonical-form, popov-rows. *)
Theorem popov_rows_name n' m' (S' : system K n' m' p) d d' (N : 'M_(p, d)) (N' : 'M_(p, d')) :
  popov_rows S N -> popov_rows S' N' -> (exists e : d = d', castmx (erefl, e) N = N') <-> same_behavior S S'.
Proof.
move=> [popov ker] [popov' ker']; rewrite popov_kernel_unique //.
by split=> same r; [rewrite ker ker' | rewrite -ker -ker'].
Qed.

Theorem popov_rows_exist : exists d (N : 'M_(p, d)), popov_rows S N.
Proof.
have [Y [inker gen _]] := Indices.pencil_minimal_basis S; have [d [N [popov same]]] := popov_exists (dsubmx Y).
exists d, N; split=> // r; rewrite (kernel_representation inker gen); split=> zero t; apply/shifted_cols => j.
  by have [u ->] := (same _).1 (ex_intro _ (delta_mx j 0) (colE j N)); apply: shifted_mul.
by have [u ->] := (same _).2 (ex_intro _ (delta_mx j 0) (colE j (dsubmx Y))); apply: shifted_mul.
Qed.

(** They are the last p rows of a minimal basis of the kernel of the pencil, whose columns have no higher degrees. *)
Lemma leading_popov d (N : 'M[{poly K}]_(p, d)) : popov_form N -> \rank (leading N) = d.
Proof.
case=> pivot; set s := fun j => size _ => -[monic top clear ascend].
have degree_N j : degree N j = (s j).-1.
  apply/eqP; rewrite eqn_leq; apply/andP; split; last exact: (leq_leads (size_column N (pivot j) j)).
  by apply: leq_leads; apply/bigmax_leqP => -[i k] _; rewrite mxE; case: (top i j).
pose L := rowsub pivot (leading N); have trig : is_trig_mx L.
  apply/is_trig_mxP => j k jk; rewrite !mxE degree_N; apply: nth_default; have jk' : j != k by rewrite neq_ltn jk.
  have le : (s j <= s k)%N by case: (ascend j k jk) => [/ltnW|[->]].
  by have := leq_trans (clear j k jk') le; case: (s k).
have det1 : \det L = 1 by rewrite det_trig // big1 // => j _; rewrite !mxE degree_N; apply/eqP/monic.
apply/eqP; rewrite eqn_leq rank_leq_col; have /mxrankS := rowsub_sub pivot (leading N).
by rewrite -/L mxrank_unit // unitmxE det1 unitr1.
Qed.

Theorem popov_rows_minimal d (N : 'M_(p, d)) : popov_rows S N ->
  exists Y, [/\ minimal_basis (pencil S) Y, dsubmx Y = N & forall j, degree Y j = degree N j].
Proof.
move=> [popov ker]; have /fin_all_exists[b hb] j : exists b, pencil S *m col_mx b (col j N) = 0.
  by apply/annihilating_columns => r /ker zero t; rewrite shifted_col zero; apply/matrixP => x y; rewrite !mxE.
pose B := \matrix_(i, j) b j i 0; have col_B j : col j B = b j by apply/matrixP => i k; rewrite ord1 !mxE.
have inker : pencil S *m col_mx B N = 0.
  apply/matrixP => i j; have : col j (pencil S *m col_mx B N) = 0 by rewrite colE -mulmxA -colE col_col_mx col_B hb.
  by move/matrixP/(_ i 0); rewrite mxE => ->; rewrite !mxE.
have degreeY j : degree (col_mx B N) j = degree N j.
  rewrite /degree col_col_mx; congr _.-1; apply/eqP; rewrite eqn_leq; apply/andP; split.
    by apply/Indices.sizem_col_mx; split=> //; rewrite col_B; apply: Indices.costate_size (hb j) (leqnn _).
  by have /Indices.sizem_col_mx[] := leqnn (sizem (col_mx (col j B) (col j N))).
exists (col_mx B N); split; rewrite ?col_mxKd //; split=> // [y|].
  rewrite -[y]vsubmxK; move: (usubmx y) (dsubmx y) => b0 c0 ker0.
  have [u cu] : exists u, c0 = N *m u.
    apply/popov_equations => // r /ker; apply: (annihilating_columns S c0).2; by exists b0.
  exists u; rewrite mul_col_mx cu; congr col_mx; apply: (Theorem3.costate_unique (S := S) (S' := S) _ _ _ ker0) => //.
  by rewrite cu -mul_col_mx mulmxA inker mul0mx.
apply/eqP; rewrite eqn_leq rank_leq_col -{1}(leading_popov popov); apply: mxrankS.
rewrite -[X in (_ <= X)%MS]vsubmxK -addsmxE; apply: submx_trans (addsmxSr _ _).
by rewrite (_ : dsubmx _ = leading N) //; apply/matrixP => i j; rewrite 2![LHS]mxE [RHS]mxE degreeY col_mxEd.
Qed.

End Systems.
