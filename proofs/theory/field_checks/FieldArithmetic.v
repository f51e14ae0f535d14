(** Residues modulo l mean integers in a field where l is zero; polynomials in a root of f mean their values at the root. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq ssralg poly ssrint fraction.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import CertificatesVocabulary NumbersVocabulary Lists Elimination CheckMinimal.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Theorem residues_mean (K : fieldType) l : number K l = 0 -> means (number K : numeral (residues l) -> K).
Proof.
move=> vanishing; split; rewrite /=.
- exact: (rmorph0 (number_rmorphism K)).
- exact: (rmorph1 (number_rmorphism K)).
- by move=> a b; rewrite (number_modulo vanishing) (number_add K).
- by move=> a b; rewrite (number_modulo vanishing) (number_sub K).
- by move=> a b; rewrite (number_modulo vanishing) (number_mul K).
- by move=> a; apply: (number_zero vanishing).
Qed.

(** There is such a field. *)
Theorem residues_exist l : Z.lt (Zpos xH) l -> exists K : fieldType, number K l = 0.
Proof. by move/Z.ltb_lt/field_modulo. Qed.

Section Root.
Variables (K : fieldType) (f : seq (Z * Z)) (a : K).
Hypotheses (faithful : forall z, number K z = 0 -> z = Z0) (root : value_at a f = 0).
Notation phi := (number_rmorphism K).
Notation fr := (fraction_in K).
Notation val := (value_at a).

Lemma phi_neq0 z : z != Z0 -> phi z != 0.
Proof. by apply: contraNneq => /faithful ->. Qed.

Lemma fraction_lowest c : fr (lowest c) = fr c.
Proof.
case: c => b c; rewrite /lowest /=; case: Z.eqb => //; rewrite /fraction_in /=; set g := Z.gcd b c; have [g0|g0] := eqVneq g Z0.
  by have [-> ->] : b = Z0 /\ c = Z0 by move: (Z.gcd_eq_0_l _ _ g0) (Z.gcd_eq_0_r _ _ g0).
have eb : b = Z.mul (Z.div b g) g by rewrite Z.mul_comm; apply: Z_div_exact_full_2; [exact/eqP|exact/Z.mod_divide/Z.gcd_divide_l/eqP].
have ec : c = Z.mul (Z.div c g) g by rewrite Z.mul_comm; apply: Z_div_exact_full_2; [exact/eqP|exact/Z.mod_divide/Z.gcd_divide_r/eqP].
rewrite {2}eb {2}ec ![number K (Z.mul _ _)](number_mul K) -mulf_div divff ?mulr1 //; exact: phi_neq0.
Qed.

Lemma value_fraction_plus b c : fr (fraction_plus b c) = fr b + fr c.
Proof.
rewrite /fraction_plus; case: Z.eqb_spec => [b0|/eqP b0].
  by rewrite [fr b]/fraction_in b0 [number K Z0](rmorph0 phi) invr0 mulr0 add0r.
case: Z.eqb_spec => [c0|/eqP c0].
  by rewrite [fr c]/fraction_in c0 [number K Z0](rmorph0 phi) invr0 mulr0 addr0.
rewrite fraction_lowest /fraction_in /= [number K (Z.add _ _)](number_add K) [number K (Z.mul _ _)](number_mul K) !(number_mul K).
by rewrite addf_div //; exact: phi_neq0.
Qed.

Lemma value_fraction_mult b c : fr (fraction_mult b c) = fr b * fr c.
Proof. by rewrite /fraction_mult fraction_lowest /fraction_in /= ![number K (Z.mul _ _)](number_mul K) mulf_div. Qed.

Lemma value_trimmed u : val (trimmed u) = val u.
Proof.
elim: u => //= c u IH; case: ifP => [/andP[/nilP e /Z.eqb_spec c0]|_] /=; last by rewrite IH.
by rewrite -IH e /= mulr0 addr0 /fraction_in c0 [number K Z0](rmorph0 phi) mul0r.
Qed.

Lemma value_polynomial_plus u v : val (polynomial_plus u v) = val u + val v.
Proof.
elim: u v => [|b u IH] [|c v] //=; rewrite ?add0r ?addr0 //.
by rewrite value_fraction_plus IH mulrDr addrACA.
Qed.

Lemma value_polynomial_multiple c u : val (polynomial_multiple c u) = fr c * val u.
Proof. by elim: u => [|b u IH] /=; rewrite ?mulr0 // value_fraction_mult IH mulrDr [a * _]mulrCA. Qed.

Lemma value_polynomial_minus u v : val (polynomial_minus u v) = val u - val v.
Proof.
rewrite /polynomial_minus value_trimmed value_polynomial_plus value_polynomial_multiple /fraction_in /=.
by rewrite [number K (Zneg _)](rmorphN1 phi) [number K (Zpos _)](rmorph1 phi) divr1 mulN1r.
Qed.

Lemma value_times_root u : val (times_root f u) = a * val u.
Proof.
rewrite /times_root value_polynomial_minus value_polynomial_multiple root mulr0 subr0 /=.
by rewrite /fraction_in /= [number K Z0](rmorph0 phi) mul0r add0r.
Qed.

Lemma value_polynomial_mult u v : val (polynomial_mult f u v) = val u * val v.
Proof.
elim: u => [|c u IH] /=; first by rewrite mul0r.
by rewrite value_trimmed value_polynomial_plus value_polynomial_multiple value_times_root IH mulrDl mulrA.
Qed.

Theorem algebraic_mean : means (val : numeral (algebraic f) -> K).
Proof.
split; rewrite //=.
- by rewrite /fraction_in /= [number K (Zpos _)](rmorph1 phi) divr1 mulr0 addr0.
- by move=> u v; rewrite value_trimmed value_polynomial_plus.
- exact: value_polynomial_minus.
- exact: value_polynomial_mult.
elim=> //= c u IH /andP[/Z.eqb_spec c0 /IH ->]; by rewrite mulr0 addr0 /fraction_in c0 [number K Z0](rmorph0 phi) mul0r.
Qed.

End Root.
