(** The right minimal indices, in this convention those of the left kernel of the pencil, and where the dimension n goes, for every system:
    with V and S of SilentSubspaces.v, the sum of the right indices is dim (V n S), so that
        n = (sum of left indices) + (sum of right indices) + dim V / (V n S) + dim S / (V n S);
    for left-invertible systems the last two are the numbers of finite and infinite zeros, and there are no right indices. For a polynomial
    row of the kernel is a silent fault from rest to rest, and these are counted by ranks of windows.

            loops S s == the silent faults on s samples from rest to rest, as a row space
         value_at s k == the matrix that takes a row of samples to that of time k
    as_polynomial S U == the states and faults of rows U of such faults as columns of polynomials *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly matrix
  mxalgebra zify.
From faultspace Require Import Vocabulary Basics Windows Chain Balance Lag PolynomialKernel Inversion.
From faultspace Require Import MinimalIndices MinimalBasis Indices SilentSubspaces.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section RightIndices.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Notation const := (map_mx (@polyC K)).
Implicit Types (s k : nat).

(** Silent faults on s samples from rest to rest. *)
Definition loops s : 'M[K]_(s * m) := (kermx (T S s) :&: kermx (state_at S s s))%MS.

Lemma loopsP s u : (u <= loops s)%MS <-> (forall k, (k < s)%N -> output S 0 (unsamples u) k = 0) /\ state S 0 (unsamples u) s = 0.
Proof.
rewrite sub_capmx (sameP (sub_kermxP (A := state_at _ _ _)) eqP) mul_state_at; split=> [/andP[/restP h /eqP] //|[/restP -> ->]].
by rewrite eqxx.
Qed.

Fact value_linear s k : linear (fun w : 'rV[K]_(s * m) => unsamples w k).
Proof. by move=> a u w; rewrite unsamples_linear. Qed.
Definition value_at s k := lin1_mx (fun w : 'rV[K]_(s * m) => unsamples w k).

Lemma mul_value_at s k (w : 'rV[K]_(s * m)) : w *m value_at s k = unsamples w k.
Proof. exact: mul_lin1 (@value_linear s k). Qed.

(** The states and faults, the first with the highest power. *)
Definition as_polynomial s d (U : 'M[K]_(d, s * m)) : 'M[{poly K}]_(n + m, d) :=
  polym s (fun k => col_mx (U *m state_at S s (s.-1 - k))^T (U *m value_at s (s.-1 - k))^T).

Lemma as_polynomial_mul s d (U : 'M_(d, s * m)) e (a : 'M_(d, e)) : as_polynomial U *m const a = as_polynomial (a^T *m U).
Proof.
apply/coefmP => k; rewrite coefm_mulr !coefm_polym; case: ifP => _; last by rewrite mul0mx.
by rewrite mul_col_mx -!(mulmxA a^T) !(trmx_mul a^T) trmxK.
Qed.

Lemma as_polynomial_inj s (u u' : 'rV[K]_(s * m)) : as_polynomial u = as_polynomial u' -> u = u'.
Proof.
move=> same; rewrite -[u]unsamplesK -[u']unsamplesK; apply: samples_ext => k ks.
have s0 : (0 < s)%N by apply: leq_ltn_trans ks.
have := congr1 (coefm (s.-1 - k)) same; rewrite !coefm_polym.
have -> : (s.-1 - k < s)%N by apply: leq_ltn_trans (leq_subr _ _) _; rewrite ltn_predL.
rewrite subKn; last by rewrite -ltnS prednK.
by move/eq_col_mx => [_ /trmx_inj]; rewrite !mul_value_at.
Qed.

Lemma sizem_as_polynomial s d (U : 'M_(d, s * m)) : (sizem (as_polynomial U) <= s)%N.
Proof. by apply/sizem_leP => k sk; rewrite coefm_polym ltnNge sk. Qed.

Lemma coefm_tr a b k (N : 'M[{poly K}]_(a, b)) : coefm k N^T = (coefm k N)^T.
Proof. by rewrite /coefm map_trmx. Qed.

Lemma coefm_row a b c k (N : 'M[{poly K}]_(a, b)) (N' : 'M_(a, c)) : coefm k (row_mx N N') = row_mx (coefm k N) (coefm k N').
Proof. exact: map_row_mx. Qed.

Lemma coefm_horner a (f : nat -> 'rV[K]_a) l k : coefm k (horner_states f l) = if (k <= l)%N then f (l - k)%N else 0.
Proof.
by elim: l k => [|l IH] [|k] /=; rewrite ?coefm_const //; rewrite coefmD coefmX coefm_const ?add0r ?addr0 ?IH ?subSS.
Qed.

Lemma loop_kernel s (u : 'rV[K]_(s * m)) : (u <= loops s)%MS -> (as_polynomial u)^T *m pencil S = 0.
Proof.
move/loopsP => [quiet back]; case: s u quiet back => [|l] u quiet back.
  by have -> : as_polynomial u = 0; [apply/coefmP => k; rewrite coefm_polym coefm0 | rewrite trmx0 mul0mx].
have -> : (as_polynomial u)^T = row_mx (horner_states (state S 0 (unsamples u)) l) (horner_states (unsamples u) l).
  apply/coefmP => k; rewrite coefm_row !coefm_horner coefm_tr coefm_polym ltnS.
  by case: ifP => _; rewrite ?trmx0 ?row_mx0 // tr_col_mx !trmxK mul_state_at mul_value_at.
rewrite horner_pencil => [|k kl]; last by apply: quiet; rewrite ltnS.
by rewrite back map_mx0 oppr0 row_mx0.
Qed.

Lemma kernel_loop s (y : 'cV_(n + m)) : y^T *m pencil S = 0 -> (sizem y <= s)%N ->
  exists2 u : 'rV[K]_(s * m), (u <= loops s)%MS & y = as_polynomial u.
Proof.
move=> ker size_y; pose x := lsubmx y^T; pose w := rsubmx y^T; have yE : y^T = row_mx x w by rewrite hsubmxK.
have coef_y k : (s <= k)%N -> coefm k x = 0 /\ coefm k w = 0.
  move=> sk; have : coefm k y^T = 0 by rewrite coefm_tr (sizem_leP _ _ size_y) ?trmx0.
  by rewrite yE coefm_row -[X in _ = X -> _]row_mx0 => /eq_row_mx.
have x_size : (sizem x <= s)%N by apply/sizem_leP => k /coef_y[].
have w_size : (sizem w <= s)%N by apply/sizem_leP => k /coef_y[].
rewrite yE in ker; have trajectory := kernel_trajectory ker x_size w_size.
pose v k := reversed s w k.+1.
have start : reversed s w 0 = 0 by rewrite /reversed leq0n subn0 (coef_y s (leqnn s)).2.
have st k : state S 0 v k = reversed s x k.+1 by rewrite -(trajectory k.+1).1 state_step start !mul0mx addr0.
have out k : output S 0 v k = 0 by rewrite -(trajectory k.+1).2 output_step start !mul0mx addr0.
have vE k : (k < s)%N -> unsamples (samples s v) k = v k by apply: samplesK.
exists (samples s v).
  apply/loopsP; split=> [k ks|].
    by rewrite -(out k); apply: output_ext => j jk; rewrite vE // (leq_ltn_trans jk).
  by rewrite (state_ext _ _ (w := v)) ?st // /reversed ltnn.
apply: trmx_inj; rewrite yE; apply/coefmP => k.
rewrite coefm_row coefm_tr coefm_polym; case: ltnP => ks; last first.
  by have [-> ->] := coef_y k ks; rewrite row_mx0 trmx0.
have e : (s.-1 - k).+1 = (s - k)%N by rewrite -subSn ?prednK //; lia.
rewrite tr_col_mx !trmxK mul_state_at mul_value_at vE ?(state_ext _ _ (w := v)) ?st /v ?e; try lia.
  by rewrite /reversed leq_subr subKn // ltnW.
by move=> j jk; apply: vE; lia.
Qed.

Theorem row_kernel_dimension s : kernel_dimension (pencil S)^T s (\rank (loops s)).
Proof.
have tr_ker d (Y : 'M_(_, d)) : (pencil S)^T *m Y = (Y^T *m pencil S)^T by rewrite trmx_mul trmxK.
exists (as_polynomial (row_base (loops s))); have free := row_base_free (loops s).
have sub d (a : 'M_(d, _)) : (a *m row_base (loops s) <= loops s)%MS by apply: submx_trans (submxMl _ _) _; rewrite eq_row_base.
have sup (u : 'rV_(s * m)) : (u <= loops s)%MS -> (u <= row_base (loops s))%MS by rewrite eq_row_base.
move: (row_base _) free sub sup => U free sub sup.
split; [|exact: sizem_as_polynomial|move=> y].
  apply/matrixP => i j; suff /matrixP/(_ i 0) : col j ((pencil S)^T *m as_polynomial U) = 0 by rewrite mxE => ->; rewrite !mxE.
  by rewrite colE -(map_delta_mx [the {rmorphism _ -> _} of @polyC K]) -mulmxA as_polynomial_mul tr_ker loop_kernel ?trmx0.
rewrite tr_ker => /(congr1 trmx); rewrite trmxK trmx0 => ker size_y.
have [u u_loop ->] := kernel_loop ker size_y; have /submxP[a ua] := sup _ u_loop.
exists a^T; split=> [|a']; rewrite as_polynomial_mul ?trmxK -?ua // => /as_polynomial_inj.
by rewrite ua => /(row_free_inj free) ->; apply: trmxK.
Qed.

(** From n samples on. *)
Lemma rank_loops s : (n <= s)%N -> (\rank (loops s) + \rank (zero_holding S :&: silent_from_rest S n)%MS = s * (m - gap S n))%N.
Proof.
move=> ns; have := rank_on_the_way S s n; rewrite rank_back_at_rest -/(loops s) -/(zero_holding S).
have -> : \rank (silent_from_rest S s :&: zero_holding S)%MS = \rank (zero_holding S :&: silent_from_rest S n)%MS.
  rewrite capmxC; apply: eqmx_rank; have up := increasing_constant (@silent_step_mono _ _ _ _ S) s.
  by rewrite !capmxS ?submx_refl // (increasing (@silent_step_mono _ _ _ _ S) ns).
have total : (\rank (zero_holding S) + \rank (kermx (T S (s + n))) + (s * gap S n + n * gap S n) = zeta S + (s * m + n * m))%N.
  by rewrite -!mulnDl rank_rest_zeta ?leq_addl.
have := rank_rest_zeta S (leqnn n); have le : (s * gap S n <= s * m)%N by rewrite leq_mul2l (gap_le_faults S (leqnn n)) orbT.
move: total le; rewrite mulnBr; lia.
Qed.

(** There is a minimal basis of the polynomial rows, with m - gap n of them. *)
Theorem right_minimal_basis : exists Y : 'M_(n + m, m - gap S n), minimal_basis (pencil S)^T Y.
Proof.
apply: (minimal_basis_exists row_kernel_dimension (N := n)) => s ns.
apply: (@addIn (\rank (zero_holding S :&: silent_from_rest S n)%MS)); rewrite rank_loops ?(leqW ns) // addnAC rank_loops //.
by rewrite mulSn addnC.
Qed.

(** Any minimal basis has as many, and the sum of its degrees is dim (V n S). *)
Theorem right_indices d (Y : 'M_(n + m, d)) : minimal_basis (pencil S)^T Y ->
  d = (m - gap S n)%N /\ (\sum_(j < d) degree Y j = \rank (zero_holding S :&: silent_from_rest S n)%MS)%N.
Proof. by move=> basis_Y; apply: (sum_of_indices row_kernel_dimension basis_Y (N := n)) => s; apply: rank_loops. Qed.

(** Where n goes. *)
Theorem dimension_balance c d (X : 'M_(n + p, c)) (Y : 'M_(n + m, d)) :
  minimal_basis (pencil S) X -> minimal_basis (pencil S)^T Y ->
  n = (\sum_(j < c) degree X j + \sum_(j < d) degree Y j +
       (\rank (zero_holding S) - \rank (zero_holding S :&: silent_from_rest S n)%MS) +
       (\rank (silent_from_rest S n) - \rank (zero_holding S :&: silent_from_rest S n)%MS))%N.
Proof.
move=> basis_X /right_indices[_ ->]; have -> : (\sum_(j < c) degree X j = sumn (etas S))%N.
  by rewrite -(perm_sumn (etas_are_minimal_indices basis_X)) sumnE big_map big_enum.
have := rank_silent_subspaces S; rewrite /zeta; have := sum_etas_le_n S.
have := mxrank_sum_cap (zero_holding S) (silent_from_rest S n).
have := mxrankS (capmxSl (zero_holding S) (silent_from_rest S n)); have := mxrankS (capmxSr (zero_holding S) (silent_from_rest S n)).
move: (\rank _) (\rank (_ + _)%MS) (\rank (zero_holding S)) (\rank (silent_from_rest S n)) => i j k l. lia.
Qed.

End RightIndices.
