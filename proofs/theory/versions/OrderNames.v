(** Lemmas of MathComp on ordered rings under the names that they have in MathComp 2; MathComp 1 has them under others. They are proved here
    from what both name alike, and where MathComp 2 is, a file that imports Num.Theory after this one has MathComp's own. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq bigop order ssralg ssrnum.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Sums.
Variable R : numDomainType.
Implicit Types x y z t : R.

Lemma lerD2l x : {mono +%R x : y z / y <= z}.
Proof. by move=> y z; rewrite -[LHS]subr_ge0 opprD addrACA subrr add0r subr_ge0. Qed.

Lemma lerDl x y : (x <= x + y) = (0 <= y).
Proof. by rewrite -{1}[x]addr0 lerD2l. Qed.

Lemma lerDr x y : (x <= y + x) = (0 <= y).
Proof. by rewrite addrC lerDl. Qed.

Lemma gerDl x y : (x + y <= x) = (y <= 0).
Proof. by rewrite -{2}[x]addr0 lerD2l. Qed.

Lemma ltrDl x y : (x < x + y) = (0 < y).
Proof. by rewrite -[LHS]subr_gt0 addrAC subrr add0r. Qed.

Lemma ltrDr x y : (x < y + x) = (0 < y).
Proof. by rewrite addrC ltrDl. Qed.

Lemma lerD x y z t : x <= y -> z <= t -> x + z <= y + t.
Proof. by move=> xy zt; rewrite -subr_ge0 opprD addrACA addr_ge0 ?subr_ge0. Qed.

Lemma ltr_pwDl y x z : 0 < x -> y <= z -> y < x + z.
Proof. by move=> x0 yz; apply: le_lt_trans yz _; rewrite ltrDr. Qed.

Lemma ltr_pwDr y x z : 0 < x -> y <= z -> y < z + x.
Proof. by move=> x0 yz; apply: le_lt_trans yz _; rewrite ltrDl. Qed.

Lemma ltr_wpDr y x z : 0 <= x -> y < z -> y < z + x.
Proof. by move=> x0 yz; apply: lt_le_trans yz _; rewrite lerDl. Qed.

Lemma ler_normD (V : normedZmodType R) (v w : V) : `|v + w| <= `|v| + `|w|.
Proof. by have := ler_norm_sum [:: v; w] id xpredT; rewrite !big_cons !big_nil !addr0. Qed.

Lemma ler_normB (V : normedZmodType R) (v w : V) : `|v - w| <= `|v| + `|w|.
Proof. by rewrite -[`|w|]normrN ler_normD. Qed.

End Sums.

Section Products.
Variable R : numDomainType.
Implicit Types x y : R.

Lemma ler_wpM2l x : 0 <= x -> {homo *%R x : y z / y <= z}.
Proof. by move=> x0 y z yz; rewrite -subr_ge0 -mulrBr mulr_ge0 ?subr_ge0. Qed.

Lemma ler_wpM2r x : 0 <= x -> {homo *%R^~ x : y z / y <= z}.
Proof. by move=> x0 y z yz; rewrite -subr_ge0 -mulrBl mulr_ge0 ?subr_ge0. Qed.

Lemma ler_pM2l x : 0 < x -> {mono *%R x : y z / y <= z}.
Proof. by move=> x0 y z; rewrite -[LHS]subr_ge0 -mulrBr pmulr_rge0 // subr_ge0. Qed.

Lemma ler_pM2r x : 0 < x -> {mono *%R^~ x : y z / y <= z}.
Proof. by move=> x0 y z; rewrite -[LHS]subr_ge0 -mulrBl pmulr_lge0 // subr_ge0. Qed.

Lemma ltr_pM2l x : 0 < x -> {mono *%R x : y z / y < z}.
Proof. by move=> x0 y z; rewrite -[LHS]subr_gt0 -mulrBr pmulr_rgt0 // subr_gt0. Qed.

Lemma ltr_pM2r x : 0 < x -> {mono *%R^~ x : y z / y < z}.
Proof. by move=> x0 y z; rewrite -[LHS]subr_gt0 -mulrBl pmulr_lgt0 // subr_gt0. Qed.

Lemma ler_pMr x y : 0 < y -> (y <= y * x) = (1 <= x).
Proof. by move=> y0; rewrite -{1}[y]mulr1 ler_pM2l. Qed.

Lemma ger_pMr x y : 0 < y -> (y * x <= y) = (x <= 1).
Proof. by move=> y0; rewrite -{2}[y]mulr1 ler_pM2l. Qed.

Lemma ler_piMr x y : 0 <= y -> x <= 1 -> y * x <= y.
Proof. by move=> y0 x1; rewrite -{2}[y]mulr1 ler_wpM2l. Qed.

Lemma ler_peMr x y : 0 <= y -> 1 <= x -> y <= y * x.
Proof. by move=> y0 x1; rewrite -{1}[y]mulr1 ler_wpM2l. Qed.

Lemma ler_pM x1 y1 x2 y2 : 0 <= x1 -> 0 <= x2 -> x1 <= y1 -> x2 <= y2 -> x1 * x2 <= y1 * y2 :> R.
Proof. by move=> x10 x20 xy1 xy2; apply: le_trans (ler_wpM2l x10 xy2) (ler_wpM2r (le_trans x20 xy2) xy1). Qed.

Lemma ler_wiXn2l x : 0 <= x -> x <= 1 -> {homo GRing.exp x : k l / (l <= k)%N >-> k <= l}.
Proof. by move=> x0 x1 k l lk; rewrite -(subnKC lk) exprD ler_piMr ?exprn_ge0 // exprn_ile1. Qed.

End Products.

Section Quotients.
Variable F : numFieldType.
Implicit Types x y z : F.

Lemma ler_pdivlMr z x y : 0 < z -> (x <= y / z) = (x * z <= y).
Proof. by move=> z0; rewrite -[LHS](ler_pM2r z0) /= mulfVK ?lt0r_neq0. Qed.

Lemma ler_pdivrMr z x y : 0 < z -> (y / z <= x) = (y <= x * z).
Proof. by move=> z0; rewrite -[LHS](ler_pM2r z0) /= mulfVK ?lt0r_neq0. Qed.

Lemma ltr_pdivlMr z x y : 0 < z -> (x < y / z) = (x * z < y).
Proof. by move=> z0; rewrite -[LHS](ltr_pM2r z0) /= mulfVK ?lt0r_neq0. Qed.

Lemma ltr_pdivrMr z x y : 0 < z -> (y / z < x) = (y < x * z).
Proof. by move=> z0; rewrite -[LHS](ltr_pM2r z0) /= mulfVK ?lt0r_neq0. Qed.

Lemma ltf_pV2 : {in Num.pos &, {mono (@GRing.inv F) : x y /~ x < y}}.
Proof.
move=> x y; rewrite !posrE => x0 y0 /=.
by rewrite -(ltr_pM2l x0) mulfV ?lt0r_neq0 // ltr_pdivlMr // mul1r.
Qed.

End Quotients.

Section Minima.
Variable R : realDomainType.
Implicit Types x y z : R.

Lemma ge_min z x y : (Num.min x y <= z) = (x <= z) || (y <= z).
Proof.
rewrite minEle; case: ifP => [xy|/negbT]; last rewrite -ltNge => /ltW yx.
  by case: (boolP (y <= z)) => [/(le_trans xy) ->|_]; rewrite ?orbT ?orbF.
by case: (boolP (x <= z)) => [/(le_trans yx) ->|].
Qed.

Lemma lt_min z x y : (z < Num.min x y) = (z < x) && (z < y).
Proof. by rewrite !ltNge ge_min negb_or. Qed.

End Minima.
