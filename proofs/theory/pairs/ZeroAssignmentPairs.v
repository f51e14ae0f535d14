(** The zero polynomials of all equivalent pairs of r faults: the multiples, of degree at most zeta, of the characteristic polynomial of the
    unobservable part. Every pair has them as zeros, whatever its faults; the rest is placed on the observable part (ZeroAssignment.v). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra mxpoly vector fraction zify.
From faultspace Require Import Vocabulary Infinite TransferRank NormalRank Minors.
From faultspace Require Import FiniteZeros InfiniteZeros Readings ExceptionalPolynomial ZeroAssignment StructureVocabulary.
From faultspace Require Import UnobservableZeros ObservablePart.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma gcd_of_minors_eqp (K : fieldType) a b (P : 'M[{poly K}]_(a, b)) (g h : {poly K}) : g %= h -> gcd_of_minors P h -> gcd_of_minors P g.
Proof.
by move=> gh [div max]; split=> [f | q /max]; [rewrite (eqp_dvdl _ gh) | rewrite (eqp_dvdr _ gh)].
Qed.

Lemma gcd_of_minors_unique (K : fieldType) a b (P : 'M[{poly K}]_(a, b)) (g h : {poly K}) :
  gcd_of_minors P g -> gcd_of_minors P h -> g %= h.
Proof. by move=> [div max] [div' max']; rewrite /eqp max // max'. Qed.

Lemma det_divides (K : fieldType) a b d (P : 'M[{poly K}]_(a, b)) (E : 'M[K]_(d, a)) (Z : 'M[K]_(d, b)) (D : 'M[{poly K}]_d) : row_free E ->
  map_mx polyC E *m P = D *m map_mx polyC Z -> divides_minors P (\det D).
Proof.
move=> free rows; have := subnKC (_ : (d <= a)%N); rewrite -{1}(eqP free) rank_leq_col => /(_ isT); move: (a - d)%N => e ade.
case: a / ade P E free rows => P E free rows; have [E' unitE] := complete_rows free.
exact: det_divides_minors unitE rows.
Qed.

Section Pairs.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (d : nat) (N : 'M[K]_(d, n)) (M : 'M[K]_d).
Hypothesis dynamics : unobservable_dynamics S N M.
Notation const := (map_mx (@polyC K)).

Lemma unobservable_zeros k (F : 'M_(k, n)) (G : 'M_(k, p)) g : gcd_of_minors (pencil (with_faults S F G)) g -> char_poly M %| g.
Proof.
have [free NE NM] := dynamics; move=> [_ max]; apply: max; apply: (@det_divides _ _ _ _ _ (row_mx N 0) (row_mx N 0)).
  by apply: inj_row_free => u; rewrite mul_mx_row -[X in _ = X -> _]row_mx0 => /eq_row_mx[/eqP]; rewrite mulmx_free_eq0 // => /eqP.
have NC : N *m sysC S = 0.
  apply/row_matrixP => i; rewrite row0 row_mul; apply: (unobservable_step _).1; apply/sub_kermxP.
  by rewrite -NE row_sub.
rewrite !map_row_mx !map_mx0 mul_row_block mul_mx_row !mul0mx !addr0 mulmx0 -map_mxM NC map_mx0; congr row_mx.
by rewrite mulmxBr mulmxBl mul_mx_scalar mul_scalar_mx -!map_mxM NM.
Qed.

Lemma observable_pair no r (So : system K no m p) (g : {poly K}) : row_free (O So no) -> \rank (transfer So) = r.+1 ->
  g != 0 -> (size g <= (zeta So).+1)%N -> exists (F : 'M_(r.+1, no)) (G : 'M_(r.+1, p)), let S' := with_faults So F G in
  [/\ forall w, behavior S' w <-> behavior So w, left_invertible S' & gcd_of_minors (pencil S') g].
Proof.
move=> obs rk g0 sg; have := coordinates_exist So (ltnSn no); rewrite rk => -[Z [U [a [b co]]]].
have [P PE] := @every_exceptional_polynomial _ _ _ _ r _ _ _ _ _ _ _ co obs g sg.
have D0 : exceptional_polynomial a b P != 0 by rewrite PE.
exists (lsubmx (P *m Z)), (rsubmx (P *m Z)); split.
- exact: (good_exceptional (ltnSn no) co P).2 D0.
- exact: (exceptional_left_invertible (ltnSn no) co P).2 D0.
by have := exceptional_zero_polynomial (ltnSn no) co P; rewrite PE.
Qed.

(** Lifted: the unobservable part comes on top. *)
Lemma lifted_zero_polynomial Pi Psi So r (Fo : 'M[K]_(r, \rank (O S n))) (G : 'M_(r, p)) g : observable_part_maps Pi Psi So ->
  left_invertible (with_faults So Fo G) -> gcd_of_minors (pencil (with_faults So Fo G)) g ->
  gcd_of_minors (pencil (with_faults S (Fo *m Psi) G)) (char_poly M * g).
Proof.
move=> maps invo finite; have [free NE NM] := dynamics; have [PP kerE eA eC _] := maps; set S' := with_faults S _ _.
have out x v k : output S' x v k = output (with_faults So Fo G) (x *m Pi) v k by rewrite /S' (part_output maps) (part_lift maps).
have inv : left_invertible S' by move=> v silent; apply: invo => k; rewrite -[RHS](silent k) out mul0mx.
have [L [Mo dyn]] := zero_dynamics_exists (with_faults So Fo G).
have gE := gcd_of_minors_unique finite (zero_polynomial invo dyn); move: dyn gE; move: (\rank _) (row_base _) L Mo => e Z L Mo dyn gE.
have [freeZ inZ next quiet] := dyn; have [Y YPi] : exists Y : 'M_(e, n), Y *m Pi = Z by exists (Z *m Psi); rewrite (part_lift maps).
have NPi : N *m Pi = 0 by apply/kerE/sub_kermxP; rewrite NE.
have inN k (X : 'M_(k, n)) : X *m Pi = 0 -> (X <= N)%MS by move/kerE => z; rewrite NE; apply/sub_kermxP.
have /submxP[X XE] : ((Y *m sysA S + L *m (Fo *m Psi) - Mo *m Y)%R <= N)%MS.
  apply: inN; rewrite mulmxBl mulmxDl -(mulmxA Y) eA (mulmxA Y) YPi -(mulmxA L) (part_lift maps) -(mulmxA Mo) YPi.
  by move: next => /= ->; rewrite subrr.
pose M' := block_mx M 0 X Mo; have polyE : char_poly M' = char_poly M * char_poly Mo.
  rewrite /char_poly /char_poly_mx (scalar_mx_block _ _ 'X) map_block_mx opp_block_mx add_block_mx map_mx0 oppr0 addr0 det_lblock.
  by [].
apply: (@gcd_of_minors_eqp _ _ _ _ _ (char_poly M')); first by rewrite polyE; apply: eqp_mull.
apply: (@zero_polynomial _ _ _ _ S' _ (col_mx N Y) (col_mx 0 L) M' inv); split.
- apply: inj_row_free => u; rewrite -[u]hsubmxK mul_row_col => z; have := congr1 (mulmx^~ Pi) z.
  rewrite mul0mx mulmxDl -!mulmxA NPi YPi mulmx0 add0r => /eqP; rewrite mulmx_free_eq0 // => /eqP u2.
  by move/eqP: z; rewrite u2 mul0mx addr0 mulmx_free_eq0 // => /eqP ->; rewrite row_mx0.
- move=> x; split=> [/submxP[c ->] | [v silent]].
    have /inZ[v silent] : (c *m col_mx N Y *m Pi <= Z)%MS.
      by rewrite -[c]hsubmxK mul_row_col mulmxDl -!mulmxA NPi YPi mulmx0 add0r submxMl.
    by exists v => k; rewrite out.
  have /submxP[c cE] : (x *m Pi <= Z)%MS by apply/inZ; exists v => k; rewrite -out.
  rewrite -[x](subrK (c *m Y)); apply: submx_trans (_ : (_ <= N + Y)%MS) _; last by rewrite addsmxE.
  by apply: addmx_sub_adds; [apply: inN; rewrite mulmxBl -mulmxA YPi -cE subrr | exact: submxMl].
- rewrite /= mul_block_col !mul_col_mx add_col_mx !mul0mx !addr0 NM; congr col_mx.
  by rewrite -XE subrK.
rewrite /= !mul_col_mx add_col_mx mul0mx addr0 eC !mulmxA NPi YPi mul0mx.
by move: quiet => /= ->; rewrite col_mx0.
Qed.

(** Ledger: zero-assignment, unobservable. *)
Theorem zero_polynomials_of_pairs (g : {poly K}) : let r := \rank (transfer S) in (0 < r)%N -> g != 0 ->
  (exists (F : 'M_(r, n)) (G : 'M_(r, p)), (forall w, behavior (with_faults S F G) w <-> behavior S w) /\
    gcd_of_minors (pencil (with_faults S F G)) g) <->
  char_poly M %| g /\ (size g <= (zeta S).+1)%N.
Proof.
move=> r rpos g0; have [Pi [Psi [So maps]]] := observable_part_exists S.
split=> [[F [G [same finite]]] | [/dvdpP[go gE] sg]].
  split; first exact: unobservable_zeros finite.
  have inv : left_invertible (with_faults S F G).
    apply/left_invertible_transfer_rank; rewrite (equal_behaviors_equal_normal_rank (S' := S)) //.
    by move/behavior_eqP: same.
  have := zeros_of_equivalent_pairs (S := S) (fun w => iff_sym (same w)) inv finite (number_of_infinite_zeros inv).
  by have := size_poly_gt0 g; rewrite g0; move: (size g) (zeta S) (\rank _) => a b c; lia.
have [free NE _] := dynamics; have dE : d = (n - \rank (O S n))%N by rewrite -mxrank_ker -NE (eqP free).
have go0 : go != 0 by apply: contraNneq g0 => z; rewrite gE z mul0r.
have chi0 : char_poly M != 0 by rewrite monic_neq0 ?char_poly_monic.
have sgo : (size go <= (zeta So).+1)%N.
  have := part_zeta maps; rewrite -dE; move: sg; rewrite gE size_mul // size_char_poly.
  by move: (size go) (zeta S) (zeta So) => a b c; lia.
case e: r rpos => [//|r'] _; have rk : \rank (transfer So) = r'.+1 by rewrite (part_normal_rank maps) -/r e.
have [Fo [G [same inv finite]]] := observable_pair (part_observable maps) rk go0 sgo.
have := lifted_zero_polynomial maps inv finite; rewrite mulrC -gE => gcd_g.
exists (Fo *m Psi), G; split=> // w.
by rewrite -(part_behavior maps) (part_lift maps) same; apply: own_part_behavior maps w.
Qed.
End Pairs.

(** Observable: every nonzero polynomial of degree at most zeta, and no other. *)
Corollary zero_polynomials_of_pairs_observable (K : fieldType) n m p (S : system K n m p) (g : {poly K}) : let r := \rank (transfer S) in
  row_free (O S n) -> (0 < r)%N -> g != 0 ->
  (exists (F : 'M_(r, n)) (G : 'M_(r, p)), (forall w, behavior (with_faults S F G) w <-> behavior S w) /\
    gcd_of_minors (pencil (with_faults S F G)) g) <-> (size g <= (zeta S).+1)%N.
Proof.
move=> r obs rpos g0; have dyn : unobservable_dynamics S (0 : 'M_(0, n)) 0.
  split; [by rewrite /row_free mxrank0 | | by rewrite !mul0mx].
  by move: obs; rewrite -kermx_eq0 => /eqP ->; apply/eqmxP; rewrite !sub0mx.
rewrite (zero_polynomials_of_pairs dyn rpos g0); split=> [[] // | sg]; split=> //.
have -> : char_poly (0 : 'M[K]_0) = 1 by rewrite /char_poly det_mx00.
exact: dvd1p.
Qed.
