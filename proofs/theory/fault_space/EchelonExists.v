(** Every row space has a reduced row echelon form: its pivots are where some vector of the space has its first entry.

            before l == the projection to the entries before l
    leading_from M l == the rows of M that vanish before l
        is_pivot M l == one of them does not vanish at l *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path fintype finfun bigop finset zmodp ssralg finalg matrix
  mxalgebra.
From faultspace Require Import Vocabulary CanonicalForm.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Existence.
Variables (K : fieldType) (a N : nat) (M : 'M[K]_(a, N)).
Implicit Types (y : 'rV[K]_N) (l j : 'I_N).

(** Vectors of the space that vanish before l, and the positions where one has its first entry that is not zero. *)
Definition before l : 'M[K]_N := \matrix_(i, j) ((i == j) && (j < l)%N)%:R.
Definition leading_from l : 'M[K]_N := (M :&: kermx (before l))%MS.
Definition is_pivot : pred 'I_N := fun l => col l (leading_from l) != 0.

Lemma leading_fromP l y : (y <= leading_from l)%MS <-> (y <= M)%MS /\ forall j, (j < l)%N -> y 0 j = 0.
Proof.
have entry j : (y *m before l) 0 j = if (j < l)%N then y 0 j else 0.
  rewrite mxE (bigD1 j) //= mxE eqxx /= big1 ?addr0 => [|i ij]; last by rewrite mxE (negPf ij) mulr0.
  by case: ltnP => _; rewrite ?mulr1 ?mulr0.
rewrite sub_capmx; split=> [/andP[-> /sub_kermxP e]|[-> zero]].
  by split=> // j jl; have := entry j; rewrite e jl mxE.
by apply/sub_kermxP/rowP => j; rewrite entry mxE; case: ifP => // /zero.
Qed.

Lemma is_pivot_intro l y : (y <= M)%MS -> (forall j, (j < l)%N -> y 0 j = 0) -> y 0 l != 0 -> is_pivot l.
Proof.
move=> yM zero yl; have /submxP[c yE] : (y <= leading_from l)%MS by apply/leading_fromP.
apply: contra yl => /eqP c0; have : col l y = 0 by rewrite yE colE -mulmxA -colE c0 mulmx0.
by move=> /matrixP/(_ 0 0); rewrite !mxE => ->.
Qed.

Lemma is_pivot_elim l : is_pivot l -> exists y, [/\ (y <= M)%MS, forall j, (j < l)%N -> y 0 j = 0 & y 0 l = 1].
Proof.
case/matrix0Pn => i [j]; rewrite mxE => e; pose y := (leading_from l i l)^-1 *: row i (leading_from l).
have /leading_fromP[yM zero] : (y <= leading_from l)%MS by apply: scalemx_sub; apply: row_sub.
by exists y; split=> //; rewrite !mxE mulVf.
Qed.

(** Clear the other pivots from left to right. *)
Lemma cleared d l : is_pivot l -> exists y, [/\ (y <= M)%MS, forall j, (j < l)%N -> y 0 j = 0, y 0 l = 1
  & forall j, is_pivot j -> j != l -> (j < d)%N -> y 0 j = 0].
Proof.
move=> lead_l; elim: d => [|d [y [yM zero one clear]]]; first by have [y [yM zero one]] := is_pivot_elim lead_l; exists y.
have [dN|Nd] := ltnP d N; last first.
  by exists y; split=> // j lead_j jl _; apply: clear => //; apply: leq_trans (ltn_ord j) Nd.
pose q := Ordinal dN; have [/andP[lead_q lq]|not_q] := boolP (is_pivot q && (l < q)%N); last first.
  exists y; split=> // j lead_j jl; rewrite ltnS leq_eqVlt => /orP[/eqP jd|]; last exact: clear.
  have jq : j = q by apply: val_inj.
  by apply: zero; rewrite ltn_neqAle jl jq leqNgt; move: not_q; rewrite -jq lead_j.
have [y2 [y2M zero2 one2]] := is_pivot_elim lead_q.
exists (y - y 0 q *: y2); split=> [|j jl||j lead_j jl].
- by apply: addmx_sub yM _; rewrite eqmx_opp scalemx_sub.
- by rewrite !mxE [y 0 j]zero // zero2 ?mulr0 ?subr0 // (ltn_trans jl).
- by rewrite !mxE one zero2 ?mulr0 ?subr0.
rewrite ltnS leq_eqVlt => /orP[/eqP jd|jd].
  have -> : j = q by apply: val_inj.
  by rewrite !mxE one2 mulr1 subrr.
by rewrite !mxE [y 0 j]clear // zero2 // mulr0 subr0.
Qed.

Theorem reduced_echelon_exists : exists k (R : 'M[K]_(k, N)), reduced_echelon R /\ (R :=: M)%MS.
Proof.
have rows (i : 'I_#|is_pivot|) : exists y, [/\ (y <= M)%MS, forall j, (j < enum_val i)%N -> y 0 j = 0, y 0 (enum_val i) = 1
    & forall j, is_pivot j -> j != enum_val i -> y 0 j = 0].
  have [y [yM zero one clear]] := cleared N (enum_valP i : is_pivot (enum_val i)).
  by exists y; split=> // j lead_j ji; apply: clear.
have [y hy] := fin_all_exists rows; pose R := \matrix_i y i.
have ones (i i' : 'I_#|is_pivot|) : R i (enum_val i') = (i == i')%:R.
  rewrite mxE; have [_ _ one clear] := hy i; case: eqP => [<- //|/eqP ii'].
  by apply: clear; [apply: (enum_valP i') | rewrite (inj_eq enum_val_inj) eq_sym].
exists #|is_pivot|, R; split.
  exists enum_val; split=> // [i l li|i j ij]; first by rewrite mxE; have [_ zero _ _] := hy i; apply: zero.
  have sorted_pivots : sorted ltn [seq val l | l <- enum is_pivot].
    apply: (subseq_sorted ltn_trans _ (iota_ltn_sorted 0 N)); rewrite -val_enum_ord; apply: map_subseq.
    by rewrite enumT; apply: filter_subseq.
  have size_pivots : size [seq val l | l <- enum is_pivot] = #|is_pivot| by rewrite size_map -cardE.
  have := sorted_ltn_nth ltn_trans 0%N sorted_pivots i j; rewrite !inE size_pivots !ltn_ord => /(_ isT isT ij).
  by rewrite !(nth_map (enum_default i)) -?cardE ?ltn_ord // -!(enum_val_nth (enum_default i)).
apply/eqmxP/andP; split; first by apply/row_subP => i; rewrite rowK; case: (hy i).
apply/row_subP => i0; have := row_sub i0 M; move: (row i0 M) => z zM.
pose w := z - \sum_i z 0 (enum_val i) *: row i R.
have wM : (w <= M)%MS.
  apply: addmx_sub zM _; rewrite eqmx_opp; apply: summx_sub => i _; apply: scalemx_sub; rewrite rowK; by case: (hy i).
have w_pivot j : is_pivot j -> w 0 j = 0.
  move=> lead_j; rewrite -(enum_rankK_in lead_j lead_j); set i := enum_rank_in _ _.
  rewrite !mxE summxE (bigD1 i) //= big1 => [|i' i'i]; first by rewrite addr0 2!mxE ones eqxx mulr1 subrr.
  by rewrite 2!mxE ones (negPf i'i) mulr0.
suff w0 : w = 0.
  move/eqP: w0; rewrite subr_eq0 => /eqP ->; apply: summx_sub => i _; apply: scalemx_sub; exact: row_sub.
apply/eqP; apply: contraT => /rV0Pn[l0 wl0].
case: (@arg_minnP _ l0 (fun l => w 0 l != 0) val wl0) => l wl least.
have lead_l : is_pivot l.
  apply: is_pivot_intro wM _ wl => j jl; apply: contraTeq jl => /least; by rewrite -leqNgt.
by rewrite w_pivot ?eqxx in wl.
Qed.

End Existence.

(** So the solutions of problem (11) have one, and canonical_echelon_form (EchelonForm.v) applies. *)
Theorem solutions_echelon_exists (K : fieldType) n m p (S : system K n m p) s :
  exists k (R : 'M[K]_(k, n + p)), reduced_echelon R /\ spans_solutions S s R.
Proof.
have [k [R [echelon eqR]]] := reduced_echelon_exists (solution_space S s).
by exists k, R; split=> // f g; rewrite (solution_spaceP S s) eqR.
Qed.
