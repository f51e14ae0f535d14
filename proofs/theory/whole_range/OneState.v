(** One state, A stable and all stationary, and an input of any colour: the limit of PI-MOESP has all of the range of O_s as soon as B is
    not zero. Otherwise what the inputs have made of the state, z, would be a combination of the s future inputs up to an error that the
    input before them knows nothing of. From one time to the next the error is multiplied by the pole, up to a combination of these s + 1
    inputs, with which it is uncorrelated; it is stationary, so it is zero; and then the inputs are linearly dependent, or B is zero. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Places Signals Consistency LimitsVocabulary WholeRange.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Null.
Variables (K : realFieldType) (N : nat) (Q : 'M[K]_N).
Hypotheses (symmetric : Q^T = Q) (positive : forall z : 'cV_N, 0 <= cov Q z z 0 0).

Lemma cov_sym (x y : 'cV[K]_N) : cov Q x y 0 0 = cov Q y x 0 0.
Proof. by rewrite -(cov_transpose y x symmetric) [LHS]mxE. Qed.

Let entry_add (M M' : 'M[K]_1) : (M + M') 0 0 = M 0 0 + M' 0 0. Proof. by rewrite mxE. Qed.
Let entry_sub (M M' : 'M[K]_1) : (M - M') 0 0 = M 0 0 - M' 0 0. Proof. by rewrite !mxE. Qed.

(** A signal of variance zero is uncorrelated with everything. *)
Lemma null_uncorrelated a (y : 'M_(N, a)) (x : 'cV_N) : cov Q x x 0 0 = 0 -> cov Q y x = 0.
Proof.
move=> xx; apply/row_matrixP=> i; rewrite row0.
have -> : row i (cov Q y x) = cov Q (col i y) x by rewrite /cov !row_mul tr_col.
move: (col i y) => z; suff zero : cov Q z x 0 0 = 0 by apply/matrixP=> k l; rewrite !ord1 zero mxE.
set r := cov Q z x 0 0.
apply/eqP; apply: contraT => r0; pose b := - (cov Q z z 0 0 + 1) / (r + r).
have rr : r + r != 0 by rewrite -mulr2n mulrn_eq0.
have := positive (z + b *: x); rewrite cov_add !cov_add_left !entry_add.
have scale_right (g h : 'cV_N) : cov Q g (b *: h) 0 0 = b * cov Q g h 0 0 by rewrite /cov -scalemxAr mxE.
have scale_left (g h : 'cV_N) : cov Q (b *: g) h 0 0 = b * cov Q g h 0 0 by rewrite cov_sym scale_right cov_sym.
rewrite !scale_right !scale_left xx !mulr0 addr0 [cov Q x z 0 0]cov_sym -/r.
have -> : cov Q z z 0 0 + b * r + b * r = - 1.
  by rewrite -addrA -mulrDr /b divfK // opprD addrA subrr add0r.
by rewrite oppr_ge0 ler10.
Qed.

Section Inputs.
Variables (nu : nat) (u : nat -> 'M[K]_(N, nu)) (t s : nat).
Hypothesis excites : cov Q (future t s.+1 u) (future t s.+1 u) \in unitmx.

Lemma independent a (beta : nat -> 'M_(nu, a)) : cov Q (future t s.+1 u) (\sum_(j < s.+1) u (t + j)%N *m beta j) = 0 ->
  forall j, (j < s.+1)%N -> beta j = 0.
Proof.
have -> : \sum_(j < s.+1) u (t + j)%N *m beta j = future t s.+1 u *m \sum_(j < s.+1) (place K nu j)^T *m beta j.
  by rewrite mulmx_sumr; apply: eq_bigr => j _; rewrite (sample_of_future t u j) mulmxA.
rewrite cov_mul => /(congr1 (mulmx (invmx (cov Q (future t s.+1 u) (future t s.+1 u))))); rewrite mulKmx // mulmx0 => e j js.
have := congr1 (mulmx (place K nu (Ordinal js))) e; rewrite mulmx0 mulmx_sumr (bigD1 (Ordinal js)) //= big1 => [|i].
  by rewrite addr0 mulmxA place_orthonormal eqxx mul1mx.
by rewrite -val_eqE eq_sym mulmxA place_orthonormal => /negbTE ->; rewrite mul0mx.
Qed.

Lemma future_later c : future t.+1 s u *m c = \sum_(j < s) u (t + j.+1)%N *m (place K nu j *m c) :> 'cV_N.
Proof. by rewrite (future_sum t.+1 s u) mulmx_suml; apply: eq_bigr => j _; rewrite mulmxA addnS. Qed.

(** The excitation of fewer inputs. *)
Lemma excites_later : cov Q (future t.+1 s u) (future t.+1 s u) \in unitmx.
Proof.
rewrite -row_full_unit; apply: row_full_seen => c e.
have null : cov Q (future t.+1 s u *m c) (future t.+1 s u *m c) 0 0 = 0 by rewrite cov_mul_left cov_mul e mulmx0 mxE.
have := null_uncorrelated (future t.+1 s u) null => _.
have := null_uncorrelated (future t s.+1 u) null; rewrite future_later.
pose beta j : 'cV_nu := if j is i.+1 then oapp (fun l : 'I_s => place K nu l *m c) 0 (insub i) else 0.
have -> : \sum_(j < s) u (t + j.+1)%N *m (place K nu j *m c) = \sum_(j < s.+1) u (t + j)%N *m beta j.
  by rewrite big_ord_recl mulmx0 add0r; apply: eq_bigr => j _; rewrite /= valK.
move=> /independent zero; rewrite -[c]mul1mx -sum_places mulmx_suml big1 // => j _; rewrite -mulmxA.
by have := zero j.+1 (ltn_ord j); rewrite /= valK /= => ->; rewrite mulmx0.
Qed.

Variables (alpha : K) (z z' : 'cV[K]_N) (b : 'cV[K]_nu) (c : 'cV[K]_(s * nu)).
Hypotheses (stable : `|alpha| < 1) (step : z' = alpha *: z + u t *m b).
Let e := z - future t s u *m c.
Let e' := z' - future t.+1 s u *m c.
Hypotheses (unseen : cov Q (future t s.+1 u) e' = 0) (stationary : cov Q e' e' = cov Q e e).

Theorem unseen_state_unreached : b = 0.
Proof.
pose cs j : 'cV_nu := oapp (fun l : 'I_s => place K nu l *m c) 0 (insub j).
have csE (j : 'I_s) : cs j = place K nu j *m c by rewrite /cs valK.
have cs_last j : (s <= j)%N -> cs j = 0 by move=> sj; rewrite /cs insubF // ltnNge sj.
pose beta j : 'cV_nu := (if j == 0%N then b else 0) + alpha *: cs j - (if j is i.+1 then cs i else 0).
have difference : e' - alpha *: e = \sum_(j < s.+1) u (t + j)%N *m beta j.
  have -> : e' - alpha *: e = u t *m b + alpha *: (future t s u *m c) - future t.+1 s u *m c.
    rewrite /e' /e step scalerBr opprB; move: (alpha *: z) => X; move: (alpha *: _) => R.
    by rewrite [X + _]addrC -!addrA; congr (_ + _); rewrite addrCA (addrCA X) subrr addr0 addrC.
  rewrite /beta (eq_bigr (fun j : 'I_s.+1 => u (t + j)%N *m (if j == 0%N :> nat then b else 0) + u (t + j)%N *m (alpha *: cs j) -
    u (t + j)%N *m (if nat_of_ord j is i.+1 then cs i else 0))) => [|j _]; last by rewrite -mulmxDr -mulmxBr.
  rewrite !big_split /= sumrN; congr (_ + _ - _).
  - by rewrite big_ord_recl /= addn0 big1 ?addr0 // => j _; rewrite mulmx0.
  - rewrite big_ord_recr /= cs_last // scaler0 mulmx0 addr0 (future_sum t s u) mulmx_suml scaler_sumr; apply: eq_bigr => j _.
    by rewrite csE -scalemxAr -mulmxA.
  by rewrite future_later big_ord_recl /= mulmx0 add0r; apply: eq_bigr => j _; rewrite csE.
have orthogonal : cov Q (e' - alpha *: e) e' = 0.
  rewrite difference cov_sum_left big1 // => j _; rewrite cov_mul_left (cov_future_zero unseen) ?mulmx0 //.
  by rewrite leq_addr ltn_add2l ltn_ord.
have variance : cov Q (e' - alpha *: e) (e' - alpha *: e) 0 0 = (alpha ^+ 2 - 1) * cov Q e e 0 0.
  have scale (g h : 'cV_N) : cov Q g (alpha *: h) 0 0 = alpha * cov Q g h 0 0 by rewrite /cov -scalemxAr mxE.
  have o : cov Q e' e' 0 0 = alpha * cov Q e' e 0 0.
    have : cov Q (e' - alpha *: e) e' 0 0 = 0 by rewrite orthogonal mxE.
    by rewrite cov_sub_left entry_sub => /eqP; rewrite subr_eq0 => /eqP ->; rewrite [LHS]cov_sym scale.
  rewrite cov_sub orthogonal sub0r mxE scale cov_sub_left entry_sub [cov Q (alpha *: e) e 0 0]cov_sym scale.
  rewrite mulrBr -o stationary opprB mulrA -expr2 mulrBl mul1r //.
have alpha2 : alpha ^+ 2 < 1 by rewrite -[_ ^+ 2]ger0_norm ?sqr_ge0 // normrX exprn_ilt1 ?normr_ge0.
have null : cov Q (e' - alpha *: e) (e' - alpha *: e) 0 0 = 0.
  apply/eqP; rewrite eq_le positive andbT variance nmulr_rle0 ?positive // subr_lt0 //.
have := null_uncorrelated (future t s.+1 u) null; rewrite difference => /independent zero.
have cs0 d : forall j, (s <= j + d)%N -> cs j = 0.
  elim: d => [|d IH] j sj; first by rewrite cs_last // -[j]addn0.
  have [sj'|js] := leqP s j; first exact: cs_last.
  have := zero j.+1 js; rewrite /beta /= add0r IH ?addSnnS // scaler0 sub0r => /eqP; rewrite oppr_eq0 => /eqP //.
by have := zero 0%N isT; rewrite /beta /= (cs0 s) // scaler0 addr0 subr0.
Qed.

End Inputs.
End Null.

Section Shifted.
Variables (K : fieldType) (N nu a : nat) (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)) (z : nat -> 'M[K]_(N, a)) (H : nat).

Lemma stationary_transpose : Q^T = Q -> stationary Q u z H -> stationary Q z u H.
Proof. by move=> symmetric st i k iH kH; rewrite -!(cov_transpose (u _) (z _) symmetric) st. Qed.

Lemma stationary_future t s : stationary Q u z H -> (t.+1 + s <= H)%N -> (t.+1 < H)%N ->
  cov Q (future t.+1 s u) (z t.+1) = cov Q (future t s u) (z t).
Proof. by move=> st tH tH'; rewrite !cov_future_left; apply: eq_bigr => k _; rewrite addSn st //; have := ltn_ord k; lia. Qed.

Lemma stationary_windows t s s' : stationary Q u u H -> (t.+1 + s <= H)%N -> (t.+1 + s' <= H)%N ->
  cov Q (future t.+1 s u) (future t.+1 s' u) = cov Q (future t s u) (future t s' u).
Proof.
move=> st tH tH'; rewrite !cov_future; apply: eq_bigr => k _; rewrite !cov_future_left; congr (_ *m _); apply: eq_bigr => j _.
by rewrite !addSn st //; [have := ltn_ord j|have := ltn_ord k]; lia.
Qed.

End Shifted.

Section OneState.
Variables (K : realFieldType) (N m p nu : nat) (Q : 'M[K]_N) (S : system K 1 m p) (B : 'M[K]_(nu, 1)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x z : nat -> 'M[K]_(N, 1)) (y : nat -> 'M[K]_(N, p)).
Variables (t q s : nat).
Let H := (t.+1 + s)%N.
Hypotheses (symmetric : Q^T = Q) (positive : forall g : 'cV_N, 0 <= cov Q g g 0 0).
Hypotheses (model : process S B D u v x y) (stable : `|sysA S 0 0| < 1).
Hypothesis uncorrelated : forall i k, (i < H)%N -> (k < H)%N -> cov Q (u i) (v k) = 0.
Hypotheses (driven : forall k, z k.+1 = z k *m sysA S + u k *m B) (start : forall i, (i < H)%N -> cov Q (u i) (x 0%N - z 0%N) = 0).
Hypotheses (uu : stationary Q u u H) (uz : stationary Q u z H) (zz : stationary Q z z H) (s0 : (0 < s)%N).
Hypothesis excites : cov Q (future t s.+1 u) (future t s.+1 u) \in unitmx.

Lemma cov_driven i k : (i < H)%N -> (k <= H)%N -> cov Q (u i) (x k) = cov Q (u i) (z k).
Proof.
move=> iH; elim: k => [_|k IH kH]; first by apply/eqP; rewrite -subr_eq0 -cov_sub start.
by have [-> _] := model k; rewrite driven !cov_add !cov_mul IH ?uncorrelated ?mul0mx ?addr0 // ltnW.
Qed.

Theorem one_state_whole_range L : B != 0 -> (0 < q <= t.+1)%N ->
  projected_limit Q (future (t.+1 - q) q u) (future t.+1 s u) (future t.+1 s y) L -> (L == O S s)%MS.
Proof.
move=> B0 /andP[q0 qt] /(two_sided_product model qt uncorrelated)[M [[X [hX eM]] ->]].
apply/eqmxP; apply: eqmxMfull; apply: row_full_seen => w Mw; apply/eqP; apply: contraT => w0.
have unit := excites_later symmetric positive excites; set Uf := future t.+1 s u in unit hX eM.
have {Mw} M0 : M = 0.
  have w00 : w 0 0 != 0 by apply: contraNneq w0 => e; apply/eqP/matrixP=> i j; rewrite !ord1 e mxE.
  by move: Mw; rewrite [w]mx11_scalar mul_mx_scalar => /eqP; rewrite scaler_eq0 (negPf w00) => /eqP.
pose c := invmx (cov Q Uf Uf) *m cov Q Uf (z t.+1).
have Uz : cov Q Uf (x t.+1) = cov Q Uf (z t.+1).
  by rewrite /Uf !cov_future_left; apply: eq_bigr => k _; rewrite cov_driven ?ltn_add2l ?leq_addr.
have Ue : cov Q Uf (z t.+1 - Uf *m c) = 0 by rewrite cov_sub cov_mul /c mulKVmx // subrr.
have Ze : cov Q (future (t.+1 - q) q u) (z t.+1 - Uf *m c) = 0.
  rewrite cov_sub cov_mul -hX /c -mulmxA mulKVmx // -Uz -M0 eM; congr (_ - _).
  rewrite !cov_future_left; apply: eq_bigr => k _; rewrite cov_driven ?leq_addr //.
  by have := ltn_ord k; rewrite /H; lia.
have unseen : cov Q (future t s.+1 u) (z t.+1 - Uf *m c) = 0.
  rewrite cov_future_left big1 // => k _; have ks := ltn_ord k; have [e|k0] := posnP k.
    by rewrite e addn0 (cov_future_zero Ze) ?mulmx0 //; lia.
  by rewrite (cov_future_zero Ue) ?mulmx0 //; lia.
suff Bz : B = 0 by rewrite Bz eqxx in B0.
apply: (unseen_state_unreached symmetric positive excites stable _ unseen).
  by rewrite driven {1}[sysA S]mx11_scalar mul_mx_scalar.
have tH : (t.+1 < H)%N by rewrite /H -addn1 leq_add2l.
have zu := stationary_transpose symmetric uz.
rewrite !cov_sub !cov_sub_left !cov_mul !cov_mul_left /Uf.
rewrite (stationary_future uz (leqnn _) tH) (stationary_windows uu (leqnn _) (leqnn _)) zz //.
have -> : cov Q (z t.+1) (future t.+1 s u) = cov Q (z t) (future t s u).
  by rewrite -!(cov_transpose (future _ s u) (z _) symmetric) (stationary_future uz (leqnn _) tH).
by [].
Qed.

End OneState.
