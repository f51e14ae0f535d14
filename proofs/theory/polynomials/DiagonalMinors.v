(** The powers of X in the minors of every order, told by a diagonal form. Let U P V be diagonal for invertible polynomial U and V, and let
    its entries that are not zero be X^o times what does not vanish in 0. So X^e divides all minors of order N iff e is no more than the sum
    of the N least o: the minors of a diagonal matrix are products of its entries at N places, and such a product is among them. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset order
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv ssrnum ssrint rat matrix mxalgebra mxpoly vector fraction interval zify.
From faultspace Require Import Vocabulary SeenBasis MinorsOfOrder.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** N of some numbers add up to no less than the N least of them. *)
Lemma least_sum (s t u : seq nat) : sorted leq s -> perm_eq s (t ++ u) -> (sumn (take (size t) s) <= sumn t)%N.
Proof.
elim: s t u => [|a s IH] t u sorted_s perm; first by rewrite take_oversize.
have tail : sorted leq s by apply: path_sorted sorted_s.
have [a_t|a_t] := boolP (a \in t).
  have perm_t := perm_to_rem a_t; rewrite (perm_size perm_t) (perm_sumn perm_t) /= leq_add2l.
  apply: (IH _ u) => //; rewrite -(perm_cons a); apply: perm_trans perm _.
  by rewrite -cat_cons perm_cat2r.
case: t a_t perm => [|b t] a_t perm //=.
have a_u : a \in u by have := perm_mem perm a; rewrite mem_cat (negPf a_t) /= mem_head => <-.
apply: leq_add.
  have : b \in a :: s by rewrite (perm_mem perm) mem_cat mem_head.
  rewrite inE => /predU1P[-> //|]; apply/allP; apply: order_path_min sorted_s; apply: leq_trans.
apply: (IH _ (b :: rem a u)) => //; rewrite -(perm_cons a); apply: perm_trans perm _.
apply: (@perm_trans _ (b :: (t ++ a :: rem a u))).
  by rewrite cat_cons perm_cons perm_cat2l perm_to_rem.
by apply/seq.permP => f; rewrite /= !count_cat /=; lia.
Qed.

Section Diagonal.
Variables (K : fieldType) (a b : nat) (P : 'M[{poly K}]_(a, b)) (U U' : 'M[{poly K}]_a) (V V' : 'M[{poly K}]_b).
Variables (f : nat -> {poly K}) (places : seq nat) (o : nat -> nat) (g : nat -> {poly K}).
Let D : 'M[{poly K}]_(a, b) := \matrix_(i, j) if i == j :> nat then f i else 0.
Hypotheses (UU : U *m U' = 1%:M) (VV : V *m V' = 1%:M) (diagonal : U *m P *m V = D).
Hypotheses (unique : uniq places) (inside : forall i, i \in places -> (i < minn a b)%N).
Hypothesis zero : forall i, (i < minn a b)%N -> i \notin places -> f i = 0.
Hypotheses (split : forall i, i \in places -> f i = 'X^(o i) * g i) (at0 : forall i, i \in places -> (g i).[0] != 0).

Notation sum N := (sumn (take N (sort leq (map o places)))).

Lemma minors_same N (h : {poly K}) : divides_minors_of_order N P h <-> divides_minors_of_order N D h.
Proof.
split=> /divides_minors_of_order_det divides; apply/divides_minors_of_order_det => B C.
  by rewrite -diagonal !mulmxA -(mulmxA _ V); apply: divides.
have eP : P = U' *m D *m V' by rewrite -diagonal !mulmxA (mulmx1C UU) mul1mx -mulmxA VV mulmx1.
by rewrite eP !mulmxA -(mulmxA _ V'); apply: divides.
Qed.

(** Every minor of order N. *)
Lemma divides_diagonal N : divides_minors_of_order N D 'X^(sum N).
Proof.
move=> h l; have [inj|/injectivePn[i [j ij hij]]] := boolP (injectiveb h); last first.
  by rewrite (determinant_alternate ij) ?dvdp0 // => k; rewrite !mxE hij.
rewrite /determinant; apply: (big_ind (fun x => 'X^(sum N) %| x)) => [|x y|s _]; [exact: dvdp0 | exact: dvdp_add |].
apply: dvdp_mull.
pose at_place i := (h i == l (s i) :> nat) && (nat_of_ord (h i) \in places).
have [all_places|/allPn[i _ none]] := boolP (all at_place (enum 'I_N)); last first.
  move: none; rewrite /at_place => none.
  rewrite (bigD1 i) //= !mxE; case: eqP none => [e /= none|_ _]; last by rewrite mul0r dvdp0.
  by rewrite zero ?mul0r ?dvdp0 // leq_min ltn_ord e ltn_ord.
have here i : h i = l (s i) :> nat /\ nat_of_ord (h i) \in places by have /andP[/eqP] := allP all_places i (mem_enum _ i).
have -> : \prod_i mxsub h l D i (s i) = 'X^(\sum_i o (h i)) * \prod_i g (h i).
  rewrite (big_morph (GRing.exp 'X) (exprD 'X) (expr0 'X)) -big_split /=; apply: eq_bigr => i _.
  by have [e i_in] := here i; rewrite !mxE e eqxx -e split.
apply: dvdp_mulr; rewrite dvdp_exp2l //.
pose t := [seq nat_of_ord (h i) | i <- enum 'I_N].
have sub : {subset t <= places} by move=> _ /mapP[i _ ->]; have [] := here i.
have unique_t : uniq t.
  by rewrite map_inj_uniq ?enum_uniq // => i j /val_inj/(injectiveP _ inj).
have size_t : size t = N by rewrite size_map size_enum_ord.
have -> : (\sum_i o (h i) = sumn (map o t))%N by rewrite /t -map_comp sumnE big_map big_enum.
have -> : N = size (map o t) by rewrite size_map.
apply: (@least_sum _ _ (map o [seq i <- places | i \notin t])); first exact: sort_sorted leq_total _.
rewrite perm_sort -map_cat perm_map //; apply: uniq_perm; rewrite ?cat_uniq ?unique_t ?filter_uniq ?unique //=.
  by rewrite andbT; apply/hasPn => i; rewrite mem_filter => /andP[].
move=> i; rewrite mem_cat mem_filter; case i_t: (i \in t) => //=; exact: sub.
Qed.

(** One of them. *)
Lemma least_minor N : (N <= size places)%N ->
  exists (h : 'I_N -> 'I_a) (l : 'I_N -> 'I_b), exists2 G, \det (mxsub h l D) = 'X^(sum N) * G & G.[0] != 0.
Proof.
move=> few; pose q := take N (sort (relpre o leq) places).
have size_q : size q = N by rewrite size_takel // size_sort.
have unique_q : uniq q by rewrite take_uniq // sort_uniq.
have in_q (k : 'I_N) : nth 0%N q k \in places by rewrite -(mem_sort (relpre o leq)); apply: mem_take; apply: mem_nth; rewrite size_q.
have row_lt (k : 'I_N) : (nth 0%N q k < a)%N by have := inside (in_q k); rewrite leq_min => /andP[].
have col_lt (k : 'I_N) : (nth 0%N q k < b)%N by have := inside (in_q k); rewrite leq_min => /andP[].
exists (fun k => Ordinal (row_lt k)), (fun k => Ordinal (col_lt k)), (\prod_(k < N) g (nth 0%N q k)); last first.
  by rewrite horner_prod; apply/prodf_neq0 => k _; apply: at0.
have -> : mxsub (fun k => Ordinal (row_lt k)) (fun k => Ordinal (col_lt k)) D = diag_mx (\row_k f (nth 0%N q k)).
  by apply/matrixP => k l; rewrite !mxE /= nth_uniq ?size_q // -val_eqE; case: eqP => // ->.
have <- : (\sum_(k < N) o (nth 0%N q k) = sum N)%N.
  rewrite sort_map -map_take sumnE big_map -/q (big_nth 0%N) size_q big_mkord; by apply: eq_bigr.
rewrite det_diag (big_morph (GRing.exp 'X) (exprD 'X) (expr0 'X)) -big_split /=; apply: eq_bigr => k _.
by rewrite !mxE split.
Qed.

Lemma diagonal_divides N e : (N <= size places)%N -> divides_minors_of_order N D 'X^e -> (e <= sum N)%N.
Proof.
move=> /least_minor[h [l [G det_is G0]]] /(_ h l); rewrite det_is.
rewrite Gauss_dvdpl ?dvdp_Pexp2l ?size_polyX // coprimep_expl // coprimep_sym -['X]subr0 -polyC0 coprimep_XsubC.
exact: G0.
Qed.

Theorem powers_in_minors N e : (N <= size places)%N -> divides_minors_of_order N P 'X^e <-> (e <= sum N)%N.
Proof.
move=> few; split=> [/minors_same/(diagonal_divides few) //|small]; apply/minors_same => h l.
by rewrite (dvdp_trans _ (divides_diagonal h l)) ?dvdp_exp2l.
Qed.

(** Their number is the rank. *)
Lemma rank_diagonal : \rank (over_fractions P) = size places.
Proof.
have rank_D : \rank (over_fractions P) = \rank (over_fractions D).
  have unit d (Q Q' : 'M[{poly K}]_d) : Q *m Q' = 1%:M -> row_free (over_fractions Q) /\ row_full (over_fractions Q).
    move=> e; have u : over_fractions Q \in unitmx.
      apply: (proj1 (mulmx1_unit (_ : over_fractions Q *m over_fractions Q' = 1%:M))).
      by rewrite /over_fractions -map_mxM e map_mx1.
    by rewrite row_free_unit row_full_unit; split; exact: u.
  have -> : over_fractions D = over_fractions U *m over_fractions P *m over_fractions V.
    by rewrite -diagonal /over_fractions !map_mxM.
  rewrite mxrankMfree; last exact: (unit _ _ _ VV).1.
  rewrite eqmxMfull; [reflexivity|exact: (unit _ _ _ UU).2].
apply/eqP; rewrite rank_D eqn_leq; apply/andP; split.
  pose E : 'M[{poly K}]_(a, size places) := \matrix_(i, k) (nat_of_ord i == nth 0%N places k)%:R.
  pose G : 'M[{poly K}]_(size places, b) := \matrix_(k, j) if nth 0%N places k == j then f j else 0.
  have -> : D = E *m G.
    apply/matrixP => i j; rewrite !mxE; have [i_in|i_out] := boolP (nat_of_ord i \in places).
      have k_lt : (index (nat_of_ord i) places < size places)%N by rewrite index_mem.
      rewrite (bigD1 (Ordinal k_lt)) //= !mxE nth_index // eqxx mul1r big1 ?addr0 => [|k k_other]; first by case: eqP => // ->.
      rewrite !mxE; case: eqP => [e|_]; last by rewrite mul0r.
      by case/eqP: k_other; apply: val_inj; rewrite /= e index_uniq.
    rewrite big1 => [|k _]; last by rewrite !mxE; case: eqP => [e|_]; [rewrite e mem_nth in i_out|rewrite mul0r].
    by case: eqP => // e; rewrite zero // leq_min ltn_ord e ltn_ord.
  by rewrite /over_fractions map_mxM; apply: leq_trans (mxrankM_maxl _ _) (rank_leq_col _).
have [h [l [G det_is G0]]] := least_minor (leqnn _).
apply: (@minor_rank _ _ _ _ _ h l); rewrite -map_mxsub det_map_mx tofrac_eq0 det_is mulf_neq0 ?expf_neq0 ?polyX_eq0 //.
by apply: contraNneq G0 => ->; rewrite horner0.
Qed.

End Diagonal.
