(** Existence of a minimal basis (MinimalIndices.v), when the dimensions D s of the columns of degree < s in the kernel grow evenly from
    some s on. The columns of degree s are chosen after those of lower degree, such that their leading coefficients are independent of the
    earlier ones, and span with them the leading coefficients of all columns of degree s. D (s + 1) - D s is the number of columns of degree
    at most s; so in the end none is added.

    basis_below M s Y == Y is a minimal basis of the columns of degree < s of the kernel of M
      raise Y s alpha == the column of alpha_j q^(s - degree Y j) *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly matrix mxalgebra zify.
From faultspace Require Import Vocabulary PolynomialKernel MinimalIndices.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Existence.
Variables (K : fieldType) (a b : nat) (M : 'M[{poly K}]_(a, b)).
Notation const := (map_mx (@polyC K)).

(** A minimal basis of the columns of degree < s. *)
Definition basis_below s d (Y : 'M[{poly K}]_(b, d)) := [/\ M *m Y = 0, (sizem Y <= s)%N, \rank (leading Y) = d &
  forall y : 'cV_b, M *m y = 0 -> (sizem y <= s)%N -> exists u, y = Y *m u].

Lemma degree_lt d (Y : 'M[{poly K}]_(b, d)) s j : \rank (leading Y) = d -> (sizem Y <= s)%N -> (degree Y j < s)%N.
Proof.
move=> free size_Y; apply: leq_trans size_Y; apply: leq_trans (sizem_col Y j); rewrite /degree.
case: (posnP (sizem (col j Y))) => [flat|pos]; last by rewrite prednK.
suff : col j (leading Y) = 0.
  have /row_fullP[D DY] : row_full (leading Y) by rewrite /row_full free.
  move/(congr1 (mulmx D)); rewrite colE mulmxA DY mul1mx mulmx0 => /matrixP/(_ j 0) /eqP.
  by rewrite !mxE !eqxx oner_eq0.
have /sizem_leP/(_ (degree Y j)) zero : (sizem (col j Y) <= 0)%N by rewrite flat.
by apply/matrixP => i k; have /matrixP/(_ i 0) := zero isT; rewrite !mxE.
Qed.

(** Columns of degree s with the leading coefficients Y' alpha. *)
Definition raise d (Y : 'M[{poly K}]_(b, d)) s (alpha : 'cV[K]_d) : 'cV[{poly K}]_d := \col_j ((alpha j 0)%:P * 'X^(s - degree Y j)).

Lemma coef_raise d (Y : 'M[{poly K}]_(b, d)) s alpha : (forall j, degree Y j <= s)%N ->
  coefm s (Y *m raise Y s alpha) = leading Y *m alpha /\ (sizem (Y *m raise Y s alpha) <= s.+1)%N.
Proof.
move=> le_s; split=> [|].
  apply/matrixP => i k; rewrite ord1 !mxE /= coef_sum; apply: eq_bigr => j _; rewrite !mxE mulrCA coefCM coefMXn.
  by rewrite ltnNge leq_subr /= subKn // mulrC.
apply/sizem_leP => k sk; apply/matrixP => i j; rewrite ord1 !mxE /= coef_sum big1 // => l _.
rewrite mxE mulrCA coefCM coefMXn; case: ifP => [_|_]; first by rewrite mulr0.
by rewrite nth_default ?mulr0 //; apply: leq_trans (size_column _ _ _) _; have := le_s l; lia.
Qed.

Lemma leading_row_mx d k (Y : 'M[{poly K}]_(b, d)) (W : 'M_(b, k)) : leading (row_mx Y W) = row_mx (leading Y) (leading W).
Proof.
by apply/matrixP => i j; case: (split_ordP j) => l ->; rewrite mxE !(row_mxEl, row_mxEr) mxE /degree ?colKl ?colKr.
Qed.

Lemma basis_step s d (Y : 'M_(b, d)) : (exists D, kernel_dimension M s.+1 D) -> basis_below s Y ->
  exists k (W : 'M_(b, k)), basis_below s.+1 (row_mx Y W) /\ forall j, degree W j = s.
Proof.
move=> [D [B [kerB sizeB genB]]] [kerY sizeY freeY genY].
pose A := (leading Y)^T; pose L := (coefm s B)^T; pose V := row_base (L :\: A)%MS.
have /submxP[R VR] : (V <= L)%MS by rewrite eq_row_base diffmxSl.
pose W := B *m const R^T.
have lead_W : coefm s W = V^T by rewrite coefm_mulr VR trmx_mul trmxK.
have sizeW : (sizem W <= s.+1)%N by apply/sizem_leP => k sk; rewrite coefm_mulr (sizem_leP _ _ sizeB) // mul0mx.
have V_free := row_base_free (L :\: A)%MS; rewrite -/V in V_free.
have degW j : degree W j = s.
  suff size_s : sizem (col j W) = s.+1 by rewrite /degree size_s.
  apply/eqP; rewrite eqn_leq (leq_trans (sizem_col _ _) sizeW) ltnNge; apply/negP => /sizem_leP/(_ s (leqnn s)).
  rewrite /coefm map_col -/(coefm s W) lead_W -tr_row => /(congr1 trmx); rewrite trmxK trmx0 rowE => /eqP.
  by rewrite mulmx_free_eq0 // => /eqP/matrixP/(_ 0 j)/eqP; rewrite !mxE !eqxx oner_eq0.
have leadW : leading W = V^T.
  by rewrite -lead_W; apply/matrixP => i j; rewrite !mxE degW.
exists _, W; split=> //; split.
- by rewrite mul_mx_row kerY mulmxA kerB mul0mx row_mx0.
- apply/sizem_leP => k sk; rewrite /coefm map_row_mx -/(coefm k Y) -/(coefm k W).
  by rewrite (sizem_leP _ _ sizeY) ?(sizem_leP _ _ sizeW) ?row_mx0 // ltnW.
- rewrite leading_row_mx leadW -mxrank_tr tr_row_mx trmxK -/A -addsmxE mxrank_disjoint_sum; last first.
    apply/eqP; rewrite -submx0 -(capmx_diff L A) sub_capmx capmxSl andbT.
    by apply: submx_trans (capmxSr _ _) _; rewrite eq_row_base.
  by rewrite (eqP V_free) mxrank_tr freeY.
move=> y ker size_y; have [u [yu _]] := genB y ker size_y.
have [al [be lead_y]] : exists al be, (coefm s y)^T = al *m A + be *m V.
  have : ((coefm s y)^T <= A + V)%MS.
    rewrite yu coefm_mulr trmx_mul; apply: submx_trans (submxMl _ _) _.
    rewrite -(addsmx_diff_cap_eq L A) addsmxC; apply: addsmxS; first exact: capmxSr.
    by rewrite eq_row_base.
  by move/sub_addsmxP => [[al be] ->]; exists al, be.
have le_s j : (degree Y j <= s)%N by apply/ltnW/degree_lt.
have [lead_r size_r] := coef_raise al^T le_s.
have [||u' yu'] := genY (y - Y *m raise Y s al^T - W *m const be^T).
- by rewrite !mulmxBr ker mulmxA kerY mulmxA (mulmxA M B) kerB !mul0mx !subr0.
- apply/sizem_leP => k; rewrite leq_eqVlt => /orP[/eqP <-|sk].
    rewrite !coefmB coefm_mulr lead_W lead_r; apply: trmx_inj; rewrite !linearB /= lead_y !trmx_mul !trmxK trmx0.
    by rewrite -/A addrAC addrK subrr.
  rewrite !coefmB coefm_mulr (sizem_leP _ _ size_y) // (sizem_leP _ _ size_r) // (sizem_leP _ _ sizeW) //.
  by rewrite mul0mx !subr0.
exists (col_mx (u' + raise Y s al^T) (const be^T)); rewrite mul_row_col mulmxDr -yu'.
by rewrite addrAC subrK subrK.
Qed.

(** A basis of degree < s gives the dimension; its next step, the number of columns. *)
Variable D : nat -> nat.
Hypothesis dims : forall s, kernel_dimension M s (D s).

Lemma basis_dimension s d (Y : 'M_(b, d)) : basis_below s Y -> (\sum_(j < d) (s - degree Y j) = D s)%N.
Proof. by move=> [ker _ free gen]; apply: kernel_dimension_unique (dims s); apply: generated_dimension. Qed.

Lemma step_size s d k (Y : 'M_(b, d)) (W : 'M_(b, k)) : basis_below s Y -> basis_below s.+1 (row_mx Y W) ->
  (forall j, degree W j = s) -> D s.+1 = (D s + (d + k))%N.
Proof.
move=> basis_Y basis_YW degW; rewrite -(basis_dimension basis_Y) -(basis_dimension basis_YW); have [_ size_Y free_Y _] := basis_Y.
rewrite big_split_ord /= (eq_bigr (fun j => (s - degree Y j) + 1)%N) => [|j _]; last first.
  by have := degree_lt j free_Y size_Y; rewrite /degree colKl -/(degree Y j) addn1 => /ltnW/subSn ->.
rewrite [X in (_ + X)%N](eq_bigr (fun=> 1%N)) => [|j _]; last by rewrite /degree colKr -/(degree W j) degW subSnn.
by rewrite big_split /= !sum1_card !card_ord -addnA.
Qed.

Lemma basis_at s : exists d (Y : 'M_(b, d)), basis_below s.+1 Y /\ D s.+1 = (D s + d)%N.
Proof.
have next t d (Y : 'M_(b, d)) : basis_below t Y -> exists d' (Y' : 'M_(b, d')), basis_below t.+1 Y' /\ D t.+1 = (D t + d')%N.
  move=> basis_Y; have [k [W [basis_YW degW]]] := basis_step (ex_intro _ _ (dims t.+1)) basis_Y.
  by exists (d + k)%N, (row_mx Y W); split=> //; apply: step_size basis_YW degW.
elim: s => [|s [d [Y [basis_Y _]]]]; last exact: next basis_Y.
apply: (next _ 0%N 0); split; first by rewrite mulmx0.
- by apply/sizem_leP => k _; rewrite coefm0.
- by apply/eqP; rewrite -leqn0 rank_leq_col.
move=> y _ /sizem_leP y0; exists 0; rewrite mul0mx; apply/coefmP => k.
by rewrite y0 // coefm0.
Qed.

Theorem minimal_basis_exists c N : (forall s, (N <= s)%N -> D s.+1 = (D s + c)%N) -> exists Y : 'M_(b, c), minimal_basis M Y.
Proof.
move=> even; have [d [Y [basis_Y]]] := basis_at N; rewrite even // => /addnI e.
case: d / e Y basis_Y => Y basis_Y; exists Y.
have stays s : basis_below (s + N.+1) Y.
  elim: s => [|s IH] //; have [k [W [basis_YW degW]]] := basis_step (ex_intro _ _ (dims (s + N.+1).+1)) IH.
  have := step_size IH basis_YW degW; rewrite even; last by rewrite addnS -addSn leq_addl.
  rewrite -{1}[c]addn0 => /addnI/addnI k0; rewrite -k0 in W basis_YW degW *.
  have [ker size_Y free gen] := IH; have [_ _ _ genW] := basis_YW; split=> // [|y y_ker y_size].
    exact: leq_trans size_Y (leqnSn _).
  have [u ->] := genW y y_ker y_size; exists (usubmx u).
  by rewrite -{1}[u]vsubmxK mul_row_col [W]thinmx0 mul0mx addr0.
have [ker _ free _] := basis_Y; split=> // y y_ker.
by have [_ _ _ gen] := stays (sizem y); apply: gen => //; apply: leq_addr.
Qed.

(** The degrees of a minimal basis tell the dimensions. *)
Theorem minimal_basis_dimension d (Y : 'M_(b, d)) s : minimal_basis M Y -> (\sum_(j < d) (s - degree Y j) = D s)%N.
Proof.
by move=> [ker gen free]; apply: kernel_dimension_unique (dims s); apply: generated_dimension => // y h _; apply: gen.
Qed.

(** In sum: D s = c s - (sum of the indices), from some s on. *)
Theorem sum_of_indices d (Y : 'M_(b, d)) c e N : minimal_basis M Y -> (forall s, (N <= s)%N -> (D s + e = s * c)%N) ->
  d = c /\ (\sum_(j < d) degree Y j = e)%N.
Proof.
move=> basis_Y even; pose t := maxn N (\max_(j < d) degree Y j).
have sum s : (t <= s)%N -> (s * d = D s + \sum_(j < d) degree Y j)%N.
  move=> ts; rewrite -(minimal_basis_dimension s basis_Y) -big_split /= (eq_bigr (fun=> s)) => [|j _].
    by rewrite sum_nat_const card_ord mulnC.
  by rewrite subnK //; apply: leq_trans ts; apply: leq_trans (leq_maxr _ _); apply: (leq_bigmax j).
have at_t s : (t <= s)%N -> (s * d + e = s * c + \sum_(j < d) degree Y j)%N.
  by move=> ts; rewrite (sum s ts) -(even s (leq_trans (leq_maxl _ _) ts)) addnAC.
have dc : d = c.
  by have := at_t t.+1 (leqnSn t); have := at_t t (leqnn t); rewrite !mulSn; move: (t * d)%N (t * c)%N (bigop _ _ _); lia.
split=> //; have td : (t * d = t * c)%N by congr (_ * _)%N.
by have := at_t t (leqnn t); rewrite td => /addnI.
Qed.

End Existence.
