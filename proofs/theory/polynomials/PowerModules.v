(** Modules of polynomials over K[q^p]: finitely many polynomials generate them with factors u(q^p). A column of p polynomials is told by
    one, c_0(q^p) + q c_1(q^p) + ... + q^(p-1) c_(p-1)(q^p), and multiplied by u where that is multiplied by u(q^p); the order in which the
    last sample and then the last output lead is the order by degree. The degrees of the elements of a module, modulo p, are what matters:
    generators whose degrees are different modulo p make elements of these degrees, plus multiples of p, and no others
    (degrees_generated). So the degrees of a reduced basis are known from the module, and with them the basis (reduced_unique). Every module
    has one (reduced_exists): divide generators of equal degree modulo p by each other, and then what is left of the rest by all of them.

           upto p u == u(q^p)
    generated p f c == c is a combination of the polynomials f i, with factors u(q^p)
          apart p f == the degrees of the f i that are not zero are different modulo p
        reduced p f == monic, by ascending degrees, and no power of q that one of them leads, times powers of q^p, occurs in another
       by_residue F == the degree of F i is i modulo p, where F i is not zero *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop ssralg poly zify.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Modules.
Variables (K : fieldType) (p : nat).
Hypothesis p_gt0 : (0 < p)%N.
Implicit Types (u v c f g h : {poly K}).

Definition upto u := u \Po 'X^p.
Notation lead f := (size f).-1.

Lemma size_upto u : u != 0 -> size (upto u) = ((size u).-1 * p).+1.
Proof.
move=> u0; have := size_comp_poly u 'X^p; rewrite size_polyXn /= => <-; rewrite prednK // size_poly_gt0.
by rewrite comp_poly_eq0 // size_polyXn.
Qed.

Lemma upto0 : upto 0 = 0. Proof. exact: comp_poly0. Qed.
Lemma upto1 : upto 1 = 1. Proof. exact: comp_polyC. Qed.

Lemma upto_eq0 u : (upto u == 0) = (u == 0).
Proof. by have [->|/size_upto e] := eqVneq u 0; rewrite ?upto0 ?eqxx // -size_poly_eq0 e. Qed.

Lemma size_term u f : u != 0 -> f != 0 -> size (upto u * f) = ((size u).-1 * p + size f)%N.
Proof. by move=> u0 f0; rewrite size_mul ?upto_eq0 // size_upto. Qed.

Lemma uptoN u : upto (- u) = - upto u.
Proof. by rewrite /upto -scaleN1r comp_polyZ scaleN1r. Qed.

Lemma upto_monomial a (x : K) : upto (x *: 'X^a) = x *: 'X^(p * a).
Proof.
rewrite /upto comp_polyZ; congr (_ *: _); elim: a => [|a IH]; first by rewrite muln0 -[RHS]upto1.
by rewrite exprS comp_polyM comp_polyX IH mulnS exprD.
Qed.

Lemma size_less c g : g != 0 -> size c = size g -> lead_coef c = lead_coef g -> (size (g - c)%R < size g)%N.
Proof.
rewrite -size_poly_gt0 => size_g cg top; rewrite -(prednK size_g) ltnS; apply/leq_sizeP => k.
rewrite leq_eqVlt => /orP[/eqP <-|lk]; first by rewrite coefB -/(lead_coef g) -top /lead_coef cg subrr.
have gk : (size g <= k)%N by rewrite -(prednK size_g).
by rewrite coefB !nth_default ?subrr ?cg.
Qed.

Lemma cancel_lead f g a : f != 0 -> g != 0 -> lead g = (lead f + p * a)%N -> exists v, (size (g - upto v * f)%R < size g)%N.
Proof.
move=> f0 g0 at_a; exists ((lead_coef g / lead_coef f) *: 'X^a).
have [size_f size_g] : (0 < size f)%N /\ (0 < size g)%N by rewrite !size_poly_gt0.
have nz : lead_coef g / lead_coef f != 0 by rewrite mulf_neq0 ?invr_neq0 ?lead_coef_eq0.
apply: size_less => //; last by rewrite lead_coefM upto_monomial lead_coefZ lead_coefXn mulr1 mulfVK ?lead_coef_eq0.
have v0 : (lead_coef g / lead_coef f) *: 'X^a != 0 by rewrite scaler_eq0 negb_or nz monic_neq0 ?monicXn.
rewrite size_term // size_scale // size_polyXn /= -(prednK size_g) at_a mulnC.
by rewrite -[in LHS](prednK size_f) addnS addnC.
Qed.

(** ** Combinations *)

Definition generated (I : finType) (f : I -> {poly K}) c := exists u : I -> {poly K}, c = \sum_i upto (u i) * f i.

Section Family.
Variables (I : finType) (f : I -> {poly K}).

Lemma generated0 : generated f 0.
Proof. by exists (fun=> 0); rewrite big1 // => i _; rewrite upto0 mul0r. Qed.

Lemma generated_add v c g : generated f c -> generated f g -> generated f (g + upto v * c).
Proof.
move=> [u ->] [w ->]; exists (fun i => w i + v * u i); rewrite mulr_sumr -big_split; apply: eq_bigr => i _ /=.
by rewrite /upto comp_polyD comp_polyM mulrDl mulrA.
Qed.

Lemma generated_sub v c g : generated f c -> generated f g -> generated f (g - upto v * c).
Proof. by move=> fc fg; have := generated_add (- v) fc fg; rewrite uptoN mulNr. Qed.

Lemma generated_one i : generated f (f i).
Proof.
exists (fun j => if j == i then 1 else 0); rewrite (bigD1 i) //= eqxx upto1 mul1r big1 ?addr0 // => j /negPf ->.
by rewrite upto0 mul0r.
Qed.

Lemma generated_sum (J : finType) (u g : J -> {poly K}) : (forall j, generated f (g j)) -> generated f (\sum_j upto (u j) * g j).
Proof.
move=> fg; elim/big_rec: _ => [|j c _ fc]; first exact: generated0.
by rewrite addrC; apply: generated_add.
Qed.

Lemma generated_trans (J : finType) (g : J -> {poly K}) c : (forall j, generated f (g j)) -> generated g c -> generated f c.
Proof. by move=> fg [u ->]; apply: generated_sum. Qed.

(** No degree is lost. *)
Definition apart := forall i j, f i != 0 -> f j != 0 -> lead (f i) = lead (f j) %[mod p] -> i = j.

Theorem degrees_generated c : apart -> generated f c -> c != 0 -> exists i a, f i != 0 /\ lead c = (lead (f i) + p * a)%N.
Proof.
move=> sep [u ->]; pose T i := upto (u i) * f i.
have -> : \sum_i upto (u i) * f i = \sum_i T i by []. move=> c0.
have [i0 Ti0|T0] := pickP (fun i => T i != 0); last by move: c0; rewrite big1 ?eqxx // => i _; have /negbFE/eqP-> := T0 i.
case: (@arg_maxnP _ i0 (fun i => T i != 0) (fun i => size (T i)) Ti0) => j Tj top.
have nz i : T i != 0 -> u i != 0 /\ f i != 0.
  by rewrite /T; move=> T1; split; apply: contraNneq T1 => ->; rewrite ?upto0 ?mul0r ?mulr0.
have leadT i : T i != 0 -> lead (T i) = (lead (f i) + p * (size (u i)).-1)%N.
  move=> /nz[ui fi]; rewrite /T size_term //; move: fi; rewrite -size_poly_gt0; move: (_ * p)%N (mulnC p (size (u i)).-1) => a ->.
  by case: (size (f i)) => // s _; rewrite addnS addnC.
have [uj fj] := nz j Tj.
exists j, (size (u j)).-1; split=> //; rewrite -leadT // (bigD1 j) //= size_addl //.
apply: leq_ltn_trans (size_sum _ _ _) _; rewrite -(prednK (_ : 0 < size (T j))%N) ?size_poly_gt0 // ltnS.
apply/bigmax_leqP => i ij; have [->|Ti] := eqVneq (T i) 0; first by rewrite size_poly0.
have /= le := top i Ti; rewrite leq_eqVlt in le; case/orP: le => [/eqP same|]; last by case: (size (T j)).
have [_ fi] := nz i Ti; case/eqP: ij; apply: sep => //.
have : lead (T i) = lead (T j) by rewrite same.
by rewrite !leadT // => /(congr1 (modn^~ p)); rewrite /= ![(_ + p * _)%N]addnC ![(p * _)%N]mulnC !modnMDl.
Qed.

(** Division: what is left has no power of q that one of the f i leads. *)
Theorem division g : (forall i, f i != 0) -> exists h, [/\ generated f (g - h), (size h <= size g)%N
  & forall i a, h`_(lead (f i) + p * a) = 0].
Proof.
move=> f0; have [s] := ubnP (size g); elim: s g => // s IH g; rewrite ltnS => gs.
have [->|g0] := eqVneq g 0.
  by exists 0; split=> [||i a]; rewrite ?subrr ?coef0 //; apply: generated0.
have size_g : (0 < size g)%N by rewrite size_poly_gt0.
have [i /existsP[[a ag] /eqP /= at_i]|free] := pickP (fun i => [exists a : 'I_(size g), lead g == lead (f i) + p * a]%N).
  have [v less] := cancel_lead (f0 i) g0 at_i.
  have [|h [gen size_h zero]] := IH (g - upto v * f i); first exact: leq_trans less gs.
  exists h; split=> //; last exact: leq_trans size_h (ltnW less).
  by have := generated_add v (generated_one i) gen; rewrite addrAC subrK.
pose m := lead_coef g *: 'X^(lead g).
have size_m : size m = size g by rewrite size_scale ?lead_coef_eq0 // size_polyXn prednK.
have less : (size (g - m)%R < size g)%N by apply: size_less => //; rewrite lead_coefZ lead_coefXn mulr1.
have [|h [gen size_h zero]] := IH (g - m); first exact: leq_trans less gs.
exists (h + m); split=> [||i a]; first by rewrite opprD addrCA addrA [- h + g]addrC addrAC.
  by apply: leq_trans (size_add _ _) _; rewrite geq_max size_m leqnn andbT (leq_trans size_h) // ltnW.
rewrite coefD zero add0r coefZ coefXn; case: eqP => [e|_]; last by rewrite mulr0.
have /negbT/negP[] := free i; apply/existsP.
have ag : (a < size g)%N by rewrite -(prednK size_g) -e ltnS; apply: leq_trans (leq_addl _ _); rewrite leq_pmull.
by exists (Ordinal ag); rewrite /= e.
Qed.

End Family.

(** ** Reduced bases *)

Definition reduced d (f : 'I_d -> {poly K}) := [/\ forall j, f j \is monic, forall j k a, j != k -> (f k)`_(lead (f j) + p * a) = 0
  & forall j k : 'I_d, (j < k)%N -> (lead (f j) < lead (f k))%N].

Lemma leq_leads a b : (a <= b)%N -> (a.-1 <= b.-1)%N. Proof. by case: a b => [|a] [|b]. Qed.

Lemma congruent a b : (a <= b)%N -> a = b %[mod p] -> exists x, b = (a + p * x)%N.
Proof.
move=> ab /eqP; rewrite eq_sym eqn_mod_dvd // => /dvdnP[x e]; exists x.
by rewrite mulnC -e subnKC.
Qed.

Lemma reduced_apart d (f : 'I_d -> {poly K}) : reduced f -> apart f.
Proof.
move=> [monic clear _] i j _ _; wlog le : i j / (lead (f i) <= lead (f j))%N => [wl same|same].
  by case/orP: (leq_total (lead (f i)) (lead (f j))) => /wl; [apply | move=> h; symmetry; apply: h].
have [x e] := congruent le same; apply/eqP; apply: contraT => /(clear i j x); rewrite -e -/(lead_coef _).
by rewrite (eqP (monic j)) => /eqP; rewrite oner_eq0.
Qed.

Lemma reduced_degrees d d' (f : 'I_d -> {poly K}) (f' : 'I_d' -> {poly K}) : reduced f -> reduced f' ->
  (forall c, generated f c <-> generated f' c) -> forall j, exists i, lead (f j) = lead (f' i).
Proof.
move=> red red' same j; have nz e (g : 'I_e -> {poly K}) i : reduced g -> g i != 0 by case=> monic _ _; apply: monic_neq0.
have [i [a [_ ji]]] := degrees_generated (reduced_apart red') ((same _).1 (generated_one f j)) (nz _ _ j red).
have [k [b [_ ik]]] := degrees_generated (reduced_apart red) ((same _).2 (generated_one f' i)) (nz _ _ i red').
exists i; have kj : k = j.
  by apply: (reduced_apart red) (nz _ _ _ red) (nz _ _ _ red) _; rewrite ji ik -addnA -mulnDr addnC mulnC modnMDl.
by move: ji ik; rewrite kj; lia.
Qed.

Lemma reduced_sorted d (f : 'I_d -> {poly K}) : reduced f -> sorted ltn [seq lead (f j) | j <- enum 'I_d].
Proof.
case=> _ _ ascend; rewrite sorted_map; apply: (@sub_sorted _ (relpre val ltn)); first exact: ascend.
by rewrite -sorted_map val_enum_ord iota_ltn_sorted.
Qed.

Theorem reduced_unique d d' (f : 'I_d -> {poly K}) (f' : 'I_d' -> {poly K}) : reduced f -> reduced f' ->
  (forall c, generated f c <-> generated f' c) -> exists e : d = d', forall j, f j = f' (cast_ord e j).
Proof.
move=> red red' same; have same' c : generated f' c <-> generated f c by split=> /same.
have leads : [seq lead (f j) | j <- enum 'I_d] = [seq lead (f' j) | j <- enum 'I_d'].
  apply: (irr_sorted_eq ltn_trans ltnn); try exact: reduced_sorted.
  move=> l; apply/mapP/mapP => -[j _ ->].
    by have [i e] := reduced_degrees red red' same j; exists i; rewrite ?mem_enum.
  by have [i e] := reduced_degrees red' red same' j; exists i; rewrite ?mem_enum.
have e : d = d' by have := congr1 size leads; rewrite 2!size_map 2!size_enum_ord.
exists e; case: _ / e f' red' same {same'} leads => f' red' same leads j; rewrite cast_ord_id.
have lead_j i : lead (f i) = lead (f' i).
  have := congr1 (nth 0%N ^~ i) leads; rewrite (nth_map i) ?size_enum_ord // (nth_map i) ?size_enum_ord //.
  by rewrite nth_ord_enum.
apply/eqP; rewrite -subr_eq0; apply: contraT => c0.
have gen : generated f (f j - f' j).
  have := generated_sub 1 ((same _).2 (generated_one f' j)) (generated_one f j); rewrite upto1 mul1r; exact.
have [i [a [_ top]]] := degrees_generated (reduced_apart red) gen c0.
move: c0; rewrite -lead_coef_eq0 /lead_coef top coefB; have [monic clear _] := red; have [monic' clear' _] := red'.
have [<-|ij] := eqVneq i j; last by rewrite clear // lead_j clear' // subrr eqxx.
have [->|a0] := posnP a; first by rewrite muln0 addn0 {2}lead_j -!/(lead_coef _) (eqP (monic i)) (eqP (monic' i)) subrr eqxx.
have beyond g l : lead g = l -> g`_(l + p * a) = 0.
  by move=> <-; apply: nth_default; have : (0 < p * a)%N by [rewrite muln_gt0 p_gt0]; case: (size g) => *; lia.
by rewrite (beyond _ _ (erefl _)) (beyond _ _ (esym (lead_j i))) subrr eqxx.
Qed.

(** ** Existence: one generator for each degree modulo p *)

Section Submodule.
Variable P : {poly K} -> Prop.
Hypotheses (P0 : P 0) (P_add : forall v c g, P c -> P g -> P (g + upto v * c)).
Implicit Types F : 'I_p -> {poly K}.

Definition by_residue F := forall i, F i != 0 -> (lead (F i) %% p = i)%N.

Lemma inserted F g : by_residue F -> (forall i, P (F i)) -> P g ->
  exists F', [/\ by_residue F', forall i, P (F' i), generated F' g & forall i, generated F' (F i)].
Proof.
have P_sub v c e : P c -> P e -> P (e - upto v * c) by move=> Pc Pe; have := P_add (- v) Pc Pe; rewrite uptoN mulNr.
have [m] := ubnP (\sum_i size (F i) + size g); elim: m F g => // m IH F g; rewrite ltnS => le res PF Pg.
have [->|g0] := eqVneq g 0.
  by exists F; split=> // [|i]; [apply: generated0 | apply: generated_one].
pose i := Ordinal (ltn_pmod (lead g) p_gt0); pose F1 k := if k == i then g else F k.
have res1 : by_residue F1 by move=> k; rewrite /F1; have [->|_] := eqVneq k i; last exact: res.
have PF1 k : P (F1 k) by rewrite /F1; case: ifP.
have keeps F' : (forall k, generated F' (F1 k)) -> generated F' g /\ forall k, k != i -> generated F' (F k).
  by move=> gen; split=> [|k ki]; [have := gen i | have := gen k]; rewrite /F1 ?eqxx ?(negPf ki).
have [Fi0|Fi] := eqVneq (F i) 0.
  have [gen_g gen] := keeps F1 (fun k => generated_one F1 k); exists F1; split=> // k.
  by have [->|/gen //] := eqVneq k i; rewrite Fi0; apply: generated0.
have same : lead (F i) = lead g %[mod p] by rewrite (res i Fi).
case: (leqP (size (F i)) (size g)) => [le_g|lt_g].
  have [a e] := congruent (leq_leads le_g) same; have [v less] := cancel_lead Fi g0 e.
  have [||F' [res' PF' gen_g gen]] := IH F (g - upto v * F i) _ res PF; [|exact: P_sub|].
    by apply: leq_trans le; rewrite ltn_add2l.
  by exists F'; split=> //; have := generated_add v (gen i) gen_g; rewrite subrK.
have [a e] := congruent (leq_leads (ltnW lt_g)) (esym same); have [v less] := cancel_lead g0 Fi e.
have [||F' [res' PF' gen_i gen]] := IH F1 (F i - upto v * g) _ res1 PF1; [|exact: P_sub|].
  apply: leq_trans le; rewrite (bigD1 i) //= [in X in (_ < X)%N](bigD1 i) //= {1}/F1 eqxx.
  rewrite (eq_bigr (fun k => size (F k))) => [|k /negPf ki]; last by rewrite /F1 ki.
  by move: (size (F i - _)%R) (bigop _ _ _) (size (F i)) (size g) less => x y b c; lia.
have [gen_g gen_k] := keeps F' gen; exists F'; split=> // k.
have [->|/gen_k //] := eqVneq k i; by have := generated_add v gen_g gen_i; rewrite subrK.
Qed.

Lemma by_residue_exists (s : seq {poly K}) : (forall c, c \in s -> P c) ->
  exists F, [/\ by_residue F, forall i, P (F i) & forall c, c \in s -> generated F c].
Proof.
elim: s => [|g s IH] Ps; first by exists (fun=> 0); split=> // i; rewrite eqxx.
have [|F [res PF gen]] := IH; first by move=> c cs; apply: Ps; rewrite inE cs orbT.
have [F' [res' PF' gen_g gen']] := inserted res PF (Ps g (mem_head _ _)).
exists F'; split=> // c; rewrite inE => /orP[/eqP -> //|/gen]; exact: generated_trans.
Qed.

End Submodule.

Lemma by_residue_apart F : by_residue F -> apart F.
Proof. by move=> res i j Fi Fj; rewrite (res i Fi) (res j Fj) => /val_inj. Qed.

Theorem reduced_exists (I : finType) (Y : I -> {poly K}) : exists d (f : 'I_d -> {poly K}),
  reduced f /\ forall c, generated f c <-> generated Y c.
Proof.
have [|||F [res PF gen]] := @by_residue_exists (generated Y) _ _ [seq Y i | i <- enum I].
- exact: generated0.
- by move=> v c g; apply: generated_add.
- by move=> c /mapP[i _ ->]; apply: generated_one.
have genF c : generated F c <-> generated Y c.
  by split; apply: generated_trans => // i; apply: gen; apply/map_f; rewrite mem_enum.
pose t := sort (relpre (fun i => size (F i)) leq) (enum [pred i | F i != 0]).
have memt i : (i \in t) = (F i != 0) by rewrite mem_sort mem_enum inE.
have uniq_t : uniq t by rewrite sort_uniq enum_uniq.
pose e (j : 'I_(size t)) := tnth (in_tuple t) j; pose l j := lead (F (e j)).
have Fe j : F (e j) != 0 by rewrite -memt mem_tnth.
have e_inj : injective e.
  by move=> j k; rewrite /e !(tnth_nth (e j)) /= => /eqP; rewrite nth_uniq // => /eqP/val_inj.
have ascend (j k : 'I_(size t)) : (j < k)%N -> (l j < l k)%N.
  move=> jk; have le : (size (F (e j)) <= size (F (e k)))%N.
    rewrite /e !(tnth_nth (e j)) /=; apply: (sorted_leq_nth (leT := relpre (fun i => size (F i)) leq)) => //; last exact: ltnW.
    - by move=> x y z; apply: leq_trans.
    - by move=> x; apply: leqnn.
    - by apply: sort_sorted => x y; apply: leq_total.
    - by rewrite inE.
    by rewrite inE.
  rewrite ltn_neqAle leq_leads // andbT; apply: contraTneq jk => /(congr1 (modn^~ p)).
  by rewrite /l (res _ (Fe j)) (res _ (Fe k)) => /val_inj/e_inj ->; rewrite ltnn.
pose g j := (lead_coef (F (e j)))^-1 *: F (e j) - 'X^(l j).
have /fin_all_exists[h hP] j : exists h, [/\ generated (F \o e) (g j - h), (size h <= l j)%N & forall k a, h`_(l k + p * a) = 0].
  have [|h [gen_h size_h zero]] := @division _ (F \o e) (g j); first by move=> k; apply: Fe.
  exists h; split=> //; apply: leq_trans size_h _; rewrite -ltnS /l prednK ?size_poly_gt0 //.
  have size_c : size ((lead_coef (F (e j)))^-1 *: F (e j)) = size (F (e j)) by rewrite size_scale // invr_eq0 lead_coef_eq0.
  rewrite -[X in (_ < X)%N]size_c; apply: size_less.
  - by rewrite scaler_eq0 invr_eq0 lead_coef_eq0 (negPf (Fe j)).
  - by rewrite size_polyXn prednK ?size_poly_gt0 ?size_c.
  by rewrite lead_coefXn lead_coefZ mulVf ?lead_coef_eq0.
pose f j := 'X^(l j) + h j.
have size_f j : size (f j) = (l j).+1 by have [_ size_h _] := hP j; rewrite size_addl size_polyXn.
have lead_f j : lead (f j) = l j by rewrite size_f.
exists (size t), f; split.
  split=> [j|j k a jk|j k]; last by rewrite !lead_f; apply: ascend.
    have [_ size_h _] := hP j; rewrite monicE /lead_coef lead_f coefD coefXn eqxx nth_default ?addr0 //.
  have [_ _ zero] := hP k; rewrite lead_f coefD zero addr0 coefXn; case: eqP => // /(congr1 (modn^~ p)).
  rewrite addnC mulnC modnMDl /l (res _ (Fe j)) (res _ (Fe k)) => /val_inj/e_inj jk'.
  by rewrite jk' eqxx in jk.
have fY j : generated Y (f j).
  apply/genF; have gen_F c : generated (F \o e) c -> generated F c by apply: generated_trans => k; apply: generated_one.
  have [/gen_F gen_h _ _] := hP j.
  have -> : f j = (lead_coef (F (e j)))^-1 *: F (e j) - (g j - h j).
    rewrite /f /g; move: (_ *: _) (h j) ('X^(l j)) => x y z.
    by rewrite -addrA opprD addrA subrr add0r opprB opprK addrC.
  have scaled := generated_add ((lead_coef (F (e j)))^-1)%:P (generated_one F (e j)) (generated0 F).
  have := generated_sub 1 gen_h scaled; rewrite upto1 mul1r add0r /upto comp_polyC mul_polyC; exact.
move=> c; split=> [|Yc]; first exact: generated_trans.
have [|r [gen_r _ zero]] := @division _ f c; first by move=> j; rewrite -size_poly_gt0 size_f.
suff r0 : r = 0 by rewrite r0 subr0 in gen_r.
apply/eqP; apply: contraT => r0.
have Fr : generated F r.
  apply/genF; have := generated_sub 1 (generated_trans fY gen_r) Yc; rewrite upto1 mul1r opprB addrC subrK; exact.
have [i [a [Fi top]]] := degrees_generated (by_residue_apart res) Fr r0.
have /(nthP i)[j jt ij] : i \in t by rewrite memt.
move: r0; rewrite -lead_coef_eq0 /lead_coef top; have := zero (Ordinal jt) a.
by rewrite lead_f /l /e (tnth_nth i) /= ij => ->; rewrite eqxx.
Qed.

End Modules.
