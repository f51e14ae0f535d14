(** Determinants of matrices of polynomials modulo l, from their values at 0, 1, 2, ... *)
From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra all_fingroup.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import CertificatesVocabulary Lists Elimination.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Meaning.
Variables (K : fieldType) (l : Z).
Notation phi := (number_rmorphism K).
Hypothesis vanishing : phi l = 0.

Definition pol (f : vector) : {poly K} := \poly_(i < size f) number K (entry f i).

Lemma coef_pol f i : (pol f)`_i = number K (entry f i).
Proof. by rewrite coef_poly; case: ltnP => // fi; rewrite /entry nth_default // [RHS](rmorph0 phi). Qed.

Lemma pol_nil : pol [::] = 0.
Proof. by apply/polyP => i; rewrite coef_pol coef0 /entry nth_nil [LHS](rmorph0 phi). Qed.

Lemma pol_cons c f : pol (c :: f) = (phi c)%:P + 'X * pol f.
Proof. by apply/polyP => -[|i]; rewrite coefD coefC coefXM !coef_pol ?addr0 ?add0r. Qed.

Lemma pol_add f g : pol (add f g) = pol f + pol g.
Proof. by apply/polyP => i; rewrite coefD !coef_pol entry_add [LHS](rmorphD phi). Qed.

Lemma pol_scale c f : pol (scale c f) = phi c *: pol f.
Proof. by apply/polyP => i; rewrite coefZ !coef_pol entry_scale [LHS](rmorphM phi). Qed.

Lemma pol_product f g : pol (product f g) = pol f * pol g.
Proof.
elim: f => [|c f IH]; first by rewrite pol_nil mul0r.
by rewrite pol_add pol_scale !pol_cons IH rmorph0 add0r mulrDl mulrA mul_polyC.
Qed.

Lemma value_modulo_sound x f : phi (value_modulo l x f) = (pol f).[phi x].
Proof.
elim: f => [|c f IH]; first by rewrite pol_nil horner0 rmorph0.
by rewrite pol_cons [LHS](number_modulo vanishing) number_add number_mul IH !hornerE.
Qed.

Lemma coprime_modulo_sound f g u v : coprime_modulo l f g u v -> coprimep (pol f) (pol g).
Proof.
move=> h; apply/Bezout_eq1_coprimepP; exists (pol u, pol v) => /=; apply/eqP; rewrite -subr_eq0; apply/eqP/polyP => i.
rewrite -!pol_product -pol_add coef0 coefB coefC coef_pol.
have /(congr1 (fun z => phi z)) := entry_null i h; rewrite rmorph0 => zero; rewrite -[RHS]zero.
have -> : entry (reduced l (add (add (product u f) (product v g)) [:: Zneg xH])) i =
    Z.modulo (entry (add (add (product u f) (product v g)) [:: Zneg xH]) i) l.
  rewrite /entry /reduced; set w := add _ _; have [iw|wi] := ltnP i (size w); first by rewrite (nth_map Z0).
  by rewrite !nth_default ?size_map.
rewrite (number_modulo vanishing) [entry (add _ [:: _]) i]entry_add [RHS](rmorphD phi); congr (_ + _).
case: i {zero} => [|i]; first by rewrite [RHS](rmorphN1 phi).
by rewrite /= oppr0 /entry /= nth_nil [RHS](rmorph0 phi).
Qed.

(** The size of a determinant of polynomials. *)
Lemma size_determinant k (A : 'M[{poly K}]_k) (w : 'I_k -> nat) : (forall i j, (size (A i j) <= w i)%N) ->
  (size (\det A) <= (\sum_i (w i).-1).+1)%N.
Proof.
move=> le_w; apply: leq_trans (size_sum _ _ _) _; apply/bigmax_leqP => s _.
rewrite -signr_odd; have -> : size ((-1) ^+ odd s * \prod_i A i (s i)) = size (\prod_i A i (s i)).
  by case: (odd s); rewrite ?expr0 ?mul1r // expr1 mulN1r size_opp.
apply: leq_trans (size_prod_leq _ _) _; rewrite leq_subLR card_ord addnS ltnS.
have -> : (k + \sum_i (w i).-1 = \sum_(i < k) (1 + (w i).-1))%N by rewrite big_split /= sum1_card card_ord.
by apply: leq_sum => i _; apply: leq_trans (le_w i (s i)) _; lia.
Qed.

Definition pols (T : seq table) a b := pol (nth [::] (nth [::] T a) b).

Lemma entry_size (T : seq table) k : size T = k ->
  (size (\det (\matrix_(a < k, b < k) pols T a b)) <= (degree_bound T).+1)%N.
Proof.
move=> sT; pose w a := foldr maxn 0%N [seq size f | f <- nth [::] T a].
have -> : (degree_bound T = \sum_(a < k) (w a).-1)%N.
  rewrite /degree_bound sumnE big_map (big_nth [::]) big_mkord sT; by apply: eq_bigr.
apply: (@size_determinant k _ (fun a => w a)) => a b; rewrite mxE /pols.
apply: leq_trans (size_poly _ _) _; rewrite /w; elim: (nth [::] T a) (nat_of_ord b) => [|f row IH] [|j] //=.
  by rewrite leq_maxl.
by apply: leq_trans (IH j) _; rewrite leq_maxr.
Qed.

Theorem is_determinant_polynomial_sound (T : seq table) k f : size T = k -> is_determinant_polynomial l T f ->
  \det (\matrix_(a < k, b < k) pols T a b) = pol f.
Proof.
move=> sT /and3P[short /allP distinct /allP values]; set D := \det _; apply/eqP; rewrite -subr_eq0; apply/eqP.
pose points := [seq phi (Z.of_nat i) | i <- iota 0 (degree_bound T).+1].
apply: (@roots_geq_poly_eq0 _ _ points).
- apply/allP => _ /mapP[i i_in ->]; have := is_determinant_sound vanishing (values i i_in); rewrite value_modulo_sound => e.
  rewrite rootE hornerD hornerN subr_eq0 -e -[D.[_]]/(horner_eval _ D) -det_map_mx sT.
  apply/eqP; congr (\det _); apply/matrixP => a b; rewrite !mxE /= /horner_eval -value_modulo_sound.
  rewrite /values_modulo /entry (nth_map [::]) ?sT //.
  have [lt|ge] := ltnP b (size (nth [::] T a)); first by rewrite (nth_map [::]).
  by rewrite [nth [::] (nth [::] T a) b]nth_default // [X in _ = number K X]nth_default ?size_map.
- rewrite map_inj_in_uniq ?iota_uniq // => i j; rewrite !mem_iota /= !add0n => i_le j_le.
  wlog ij : i j i_le j_le / (i <= j)%N => [wl|e]; first by case: (leqP i j) => h e; [exact: wl|apply/esym/wl => //; exact: ltnW].
  apply/eqP; rewrite eqn_leq ij leqNgt; apply/negP => lt.
  have : (j - i)%N \in iota 1 (degree_bound T) by rewrite mem_iota; lia.
  move/distinct/(number_inverts vanishing); have -> : Z.of_nat (j - i) = Z.sub (Z.of_nat j) (Z.of_nat i) by lia.
  by rewrite number_sub (e : phi _ = phi _) subrr mul0r => /esym/eqP; rewrite oner_eq0.
rewrite size_map size_iota; apply: leq_trans (size_add _ _) _; rewrite size_opp geq_max entry_size //=.
exact: leq_trans (size_poly _ _) short.
Qed.

End Meaning.
