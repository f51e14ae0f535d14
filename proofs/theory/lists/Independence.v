(** When a square matrix of integers is invertible over the rational numbers: it is triangular with a diagonal free of zeros, or it is the
    identity modulo some l > 1, prime or not. For a determinant that is 1 modulo l is not zero. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset order
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv ssrnum ssrint rat matrix mxpoly vector fraction interval.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import CertificatesVocabulary Lists.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Units.
Variables (t : nat) (Q : 'M[Z]_t).

Lemma unit_by_determinant : \det Q != 0 -> map_mx ratn Q \in unitmx.
Proof. by rewrite unitmxE det_map_mx unitfE number_eq0. Qed.

Lemma triangular_unit : (forall i j : 'I_t, (j < i)%N -> Q i j = 0) -> (forall i, Q i i != 0) -> map_mx ratn Q \in unitmx.
Proof.
move=> lower diagonal; apply: unit_by_determinant; rewrite -det_tr det_trig; first by apply/prodf_neq0 => i _; rewrite mxE.
by apply/is_trig_mxP => i j ij; rewrite mxE lower.
Qed.

Lemma identity_modulo_unit (l : Z) : Z.lt 1 l -> (forall i j, Z.modulo (Q i j - (i == j)%:R) l = Z0) -> map_mx ratn Q \in unitmx.
Proof.
move=> l1 h; apply: unit_by_determinant.
pose f := [the {rmorphism Z -> 'Z_(Z.to_nat l)} of intmul 1 \o int_of_Z].
suff e : map_mx f Q = 1%:M by apply/eqP => /(congr1 f)/eqP; rewrite -det_map_mx e det1 rmorph0 oner_eq0.
have l0 : f l = 0.
  rewrite /=; have -> : int_of_Z l = Z.to_nat l by lia.
  by rewrite -pmulrn char_Zp //; lia.
apply/matrixP => i j; rewrite !mxE; have [z e] : exists z, Q i j = l * z + (i == j)%:R.
  by exists (Z.div (Q i j - (i == j)%:R) l); rewrite -[l * _](Z_div_exact_full_2 _ l _ (h i j)) ?subrK //; lia.
by rewrite e rmorphD rmorphM l0 mul0r add0r rmorph_nat.
Qed.

End Units.

(** The same from lists, entry by entry. *)
Lemma triangular_at M i j : triangular M -> (j <= i < size M)%N -> (entry (nth [::] M i) j == 0) = (j < i)%N.
Proof.
move=> /allP h /andP[ji iM]; have /h/andP[d /allP l] : i \in iota 0 (size M) by rewrite mem_iota.
move: ji; rewrite leq_eqVlt => /predU1P[->|ji]; first by rewrite ltnn (negPf d).
by rewrite ji; apply: l; rewrite mem_iota.
Qed.

Lemma triangular_entries t (Q : 'M[Z]_t) M : triangular M -> (t <= size M)%N ->
  (forall i j : 'I_t, Q i j = entry (nth [::] M i) j) -> map_mx ratn Q \in unitmx.
Proof.
move=> tri tM e; apply: triangular_unit => [i j ji|i]; last by rewrite e triangular_at ?ltnn // leqnn (leq_trans (ltn_ord i)).
by apply/eqP; rewrite e triangular_at // (ltnW ji) (leq_trans (ltn_ord i)).
Qed.

Lemma identity_modulo_congruent t (Q : 'M[Z]_t) M l : identity_modulo l M -> t = size M ->
  (forall i j : 'I_t, exists q, entry (nth [::] M i) j = Q i j + l * q) -> map_mx ratn Q \in unitmx.
Proof.
move=> /andP[/Z.ltb_lt l1 /allP h] tM e; apply: (identity_modulo_unit l1) => i j.
have mem (k : 'I_t) : nat_of_ord k \in iota 0 (size M) by rewrite mem_iota -tM /=.
have /allP/(_ _ (mem j))/eqP := h _ (mem i); have [q ->] := e i j.
rewrite (_ : Z.sub _ _ = Z.add (Q i j - (i == j)%:R) (Z.mul q l)) ?Z_mod_plus_full //.
rewrite -val_eqE /=; case: (val i == val j); rewrite /GRing.add /GRing.mul /GRing.opp /=; lia.
Qed.

Lemma identity_modulo_entries t (Q : 'M[Z]_t) M l : identity_modulo l M -> t = size M ->
  (forall i j : 'I_t, Q i j = entry (nth [::] M i) j) -> map_mx ratn Q \in unitmx.
Proof. by move=> one tM e; apply: identity_modulo_congruent one tM _ => i j; exists 0; rewrite e mulr0 addr0. Qed.
