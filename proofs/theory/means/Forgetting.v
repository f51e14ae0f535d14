(** What positivity of a mean and stability give. A signal whose square has the mean zero is uncorrelated with every other; and a state that
    forgets is uncorrelated with whatever its inputs are uncorrelated with. Signals are finite combinations of samples of one that is
    quasi-stationary, so that all covariances exist.

    combination h f == f(t) is a combination of h(t), ..., h(t+H-1), the same for all t *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix.
From faultspace Require Import MeansVocabulary Means OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Combinations.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (N : nat) (h : nat -> 'rV[K]_N).
Hypotheses (isE : mean E) (quasi : quasi_stationary E h).

(** Section: definitions. *)
Definition combination a (f : nat -> 'rV[K]_a) :=
  exists (M : nat -> 'M_(N, a)) H, forall H', (H <= H')%N -> forall t, f t = \sum_(i < H') h (t + i)%N *m M i.

Lemma combination_ext a (f g : nat -> 'rV[K]_a) : f =1 g -> combination f -> combination g.
Proof. by move=> e [M [H c]]; exists M, H => H' HH t; rewrite -e; apply: c. Qed.

Lemma combination_part a (M : 'M_(N, a)) : combination (fun t => h t *m M).
Proof.
exists (fun i => if i == 0%N then M else 0), 1%N => -[//|H] _ t.
by rewrite big_ord_recl /= addn0 big1 ?addr0 // => i _; rewrite mulmx0.
Qed.

Lemma combination_add a (f g : nat -> 'rV[K]_a) : combination f -> combination g -> combination (fun t => f t + g t).
Proof.
move=> [M [H c]] [M' [H' c']]; exists (fun i => M i + M' i), (maxn H H') => L; rewrite geq_max => /andP[HL HL'] t.
by rewrite (c L) // (c' L) // -big_split; apply: eq_bigr => i _; rewrite mulmxDr.
Qed.

Lemma combination_mul a b (f : nat -> 'rV[K]_a) (X : 'M_(a, b)) : combination f -> combination (fun t => f t *m X).
Proof.
move=> [M [H c]]; exists (fun i => M i *m X), H => H' HH t; rewrite (c _ HH) mulmx_suml.
by apply: eq_bigr => i _; rewrite mulmxA.
Qed.

Lemma combination_zero a : combination (fun=> 0 : 'rV[K]_a).
Proof. by exists (fun=> 0), 0%N => H _ t; rewrite big1 // => i _; rewrite mulmx0. Qed.

Lemma combination_sum a k (f : nat -> nat -> 'rV[K]_a) : (forall i, combination (f i)) -> combination (fun t => \sum_(i < k) f i t).
Proof.
move=> c; elim: k => [|k IH]; first by apply: combination_ext (combination_zero a) => t; rewrite big_ord0.
by apply: combination_ext (combination_add IH (c k)) => t; rewrite big_ord_recr.
Qed.

Lemma combination_later a k (f : nat -> 'rV[K]_a) : combination f -> combination (later k f).
Proof.
move=> c; elim: k => [|k [M [H IH]]]; first by apply: combination_ext c => t; rewrite /later addn0.
exists (fun i => if i is j.+1 then M j else 0), H.+1 => -[//|H'] HH t.
rewrite big_ord_recl mulmx0 add0r /later -addSnnS -/(later k f t.+1) (IH H') //.
by apply: eq_bigr => i _; rewrite addSnnS.
Qed.

Lemma combination_covariance a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) : combination f -> combination g -> exists R,
  covariance E f g R.
Proof.
move=> [M [H c]] [M' [H' c']].
have one k l : exists R, covariance E (later k h) (later l h) R.
  have [kl|lk] := leqP k l.
    have [R e] := quasi (l - k)%N; exists R; have := covariance_later isE k e.
    by apply: covariance_ext => // t; rewrite /later -addnA subnKC.
  have [R e] := quasi (k - l)%N; exists R^T; have := covariance_transpose isE (covariance_later isE l e).
  by apply: covariance_ext => // t; rewrite /later -addnA subnKC // ltnW.
pose L := maxn H H'; have step k l : exists R, covariance E (fun t => \sum_(i < k) h (t + i)%N *m M i) (fun t => \sum_(i < l) h (t + i)%N
  *m M' i) R.
  elim: l => [|l [R e]].
    by exists 0 => i j; rewrite mxE; apply: (mean_ext isE) (mean_zero isE) => t; rewrite big_ord0 [X in _ * X]mxE mulr0.
  suff [R' e'] : exists R', covariance E (fun t => \sum_(i < k) h (t + i)%N *m M i) (fun t => h (t + l)%N *m M' l) R'.
    by exists (R + R'); apply: (covariance_ext isE) (covariance_add isE e e') => // t; rewrite big_ord_recr.
  elim: k {e R} => [|k [R e]].
    by exists 0 => i j; rewrite mxE; apply: (mean_ext isE) (mean_zero isE) => t; rewrite big_ord0 [X in X * _]mxE mul0r.
  have [R' e'] := one k l; exists (R + (M k)^T *m R' *m M' l).
  have := covariance_add isE (covariance_transpose isE e) (covariance_transpose isE (covariance_images isE (M k) (M' l) e')).
  by move/(covariance_transpose isE); rewrite linearD /= !trmxK; apply: covariance_ext => // t; rewrite big_ord_recr.
have [R e] := step L L; exists R; apply: (covariance_ext isE) e => t; rewrite -?(c L) -?(c' L) //; [exact: leq_maxl|exact: leq_maxr].
Qed.

(** Shift-invariance backwards, for signals that have covariances. *)
Lemma covariance_earlier a b k (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) R : combination f -> combination g ->
  covariance E (later k f) (later k g) R -> covariance E f g R.
Proof.
move=> cf cg e; have [R' e'] := combination_covariance cf cg.
by rewrite (covariance_unique isE e (covariance_later isE k e')).
Qed.

End Combinations.

(** The response of a state to inputs that w knows nothing of. *)
Lemma free_response (K : fieldType) (E : (nat -> K) -> K -> Prop) a n m (w : nat -> 'rV[K]_a) (d : nat -> 'rV[K]_n) (v : nat -> 'rV[K]_m)
    A F C k : mean E -> (forall t, d t.+1 = d t *m A + v t *m F) -> (forall j, (j < k)%N -> covariance E w (later j v) 0) ->
  covariance E w d C -> covariance E w (later k d) (iter k (mulmxr A) C).
Proof.
move=> isE step zero first; elim: k zero => [_|k IH zero]; first by apply: (covariance_ext isE) first => // t; rewrite /later addn0.
have e := covariance_mul isE A (IH (fun j jk => zero j (ltnW jk))).
have := covariance_add isE e (covariance_mul isE F (zero k (leqnn _))); rewrite mul0mx addr0.
by apply: covariance_ext => // t; rewrite /later addnS step.
Qed.

Section Positive.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop).
Hypotheses (isE : mean E) (pos : positive E).

Lemma product_bound f g rf rg r : E (fun t => f t * f t) rf -> E (fun t => g t * g t) rg -> E (fun t => f t * g t) r -> `|r| <= rf + rg.
Proof.
move=> ff gg fg; have square c : 0 <= c * c * rf + (c * r + c * r) + rg.
  apply: (pos (f := fun t => c * f t + g t)).
  have := mean_add isE (mean_add isE (mean_scale isE (c * c) ff) (mean_add isE (mean_scale isE c fg) (mean_scale isE c fg))) gg.
  by apply: (mean_ext isE) => t; rewrite sqrrD exprMn !expr2 mulr2n -!mulrA.
have plus := square 1; have minus := square (-1); rewrite mulrNN !mul1r !mulN1r in plus minus.
apply: le_trans (_ : `|r + r| <= _); first by rewrite -mulr2n normrMn mulr2n lerDl normr_ge0.
rewrite ler_norml -[X in X && _]subr_ge0 -[X in _ && X]subr_ge0 opprK; apply/andP; split.
  by rewrite addrA [r + r + _]addrC.
by rewrite opprD addrAC.
Qed.

Lemma square_positive a (f : nat -> 'rV[K]_a) R i : covariance E f f R -> 0 <= R i i.
Proof. by move=> ff; apply: (pos (f := fun t => f t 0 i)); apply: (mean_ext isE) (ff i i) => t; rewrite expr2. Qed.

(** Covariances at all lags are bounded by the variances. *)
Lemma covariance_bound a b k l (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) Rf Rg R i j : covariance E f f Rf -> covariance E g g Rg ->
  covariance E (later k f) (later l g) R -> `|R i j| <= \tr Rf + \tr Rg.
Proof.
move=> ff gg fg; have tr c (h : nat -> 'rV_c) (C : 'M_c) o : covariance E h h C -> C o o <= \tr C.
  by move=> hh; rewrite /mxtrace (bigD1 o) //= lerDl; apply: sumr_ge0 => o' _; apply: square_positive hh.
apply: le_trans (lerD (tr _ _ _ i ff) (tr _ _ _ j gg)).
exact: product_bound (covariance_later isE k ff i i) (covariance_later isE l gg j j) (fg i j).
Qed.

(** What is a bounded matrix times every power of a stable one is zero. *)
Lemma forgotten a n (A : 'M[K]_n) (C : 'M_(a, n)) bound : stable A ->
  (forall k, exists2 C', C = iter k (mulmxr A) C' & forall i j, `|C' i j| <= bound) -> C = 0.
Proof.
move=> st h; apply/matrixP=> i j; rewrite mxE; apply/eqP; apply: contraT; rewrite -normr_gt0 => pos_c.
pose M := `|bound| *+ n + 1; have M0 : 0 < M by rewrite ltr_pwDr ?ltr01 // mulrn_wge0.
have [k small] := st _ (divr_gt0 pos_c M0); have [C' eC le] := h k.
have power : C = C' *m iter k (mulmxr A) 1%:M.
  by rewrite eC; elim: (k) => [|l IH] /=; rewrite ?mulmx1 // IH mulmxA.
have : `|C i j| <= \sum_(l < n) `|bound| * (`|C i j| / M).
  rewrite [X in X <= _](_ : _ = `|\sum_l C' i l * iter k (mulmxr A) 1%:M l j|); last by rewrite {1}power mxE.
  apply: le_trans (ler_norm_sum _ _ _) _; apply: ler_sum => l _; rewrite normrM.
  by apply: ler_pM => //; [apply: le_trans (le i l) _; apply: ler_norm|apply: ltW].
rewrite sumr_const card_ord -mulrnAl mulrCA ler_pMr // ler_pdivlMr // mul1r /M -subr_ge0 opprD addrA subrr add0r.
by rewrite oppr_ge0 ler10.
Qed.

(** A signal of variance zero. *)
Lemma null_covariance a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) Rf R : covariance E f f Rf -> covariance E g g 0 ->
  covariance E f g R -> R = 0.
Proof.
move=> ff gg fg; apply/matrixP=> i j; rewrite mxE; apply/eqP; apply: contraT => r0; set r := R i j in r0.
pose c := - (Rf i i + 1) / (r + r); have rr : r + r != 0 by rewrite -mulr2n mulrn_eq0.
have : 0 <= Rf i i + (c * r + c * r) + c * c * 0.
  move: c => c; apply: (pos (f := fun t => f t 0 i + c * g t 0 j)); have gg0 := gg j j; rewrite mxE in gg0.
  have fgc := mean_scale isE c (fg i j).
  have := mean_add isE (mean_add isE (ff i i) (mean_add isE fgc fgc)) (mean_scale isE (c * c) gg0).
  apply: (mean_ext isE) => t; rewrite sqrrD exprMn !expr2 mulr2n -!mulrA; by rewrite [f t 0 i * (c * _)]mulrCA.
by rewrite mulr0 addr0 -mulrDr divfK // opprD addrA subrr add0r oppr_ge0 ler10.
Qed.

End Positive.
