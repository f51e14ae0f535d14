(** The system of the integer tables of a listed one, over any field; modulo a prime its windows have no larger rank than those of the
    system over the rational numbers.

    over_field K n m p L == the system of the tables L over K, the denominator left out
      table_matrix a b M == the table M as a matrix of integers *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum ssrint
  rat matrix mxalgebra.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary Basics Windows WindowBlocks CertificatesVocabulary Lists ListedSystems SeenBasis.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Definition over_field (K : fieldType) n m p (L : listed) : system K n m p :=
  System (mat K n n (lA L)) (mat K m n (lF L)) (mat K n p (lC L)) (mat K m p (lG L)).

Section Image.
Variables (n m p : nat) (L : listed) (s : nat).

Definition table_matrix a b (M : table) : 'M[Z]_(a, b) := \matrix_(i, j) entry (nth [::] M i) j.

Lemma mat_image (K : fieldType) a b M : mat K a b M = map_mx (number_rmorphism K) (table_matrix a b M).
Proof. by apply/matrixP => i j; rewrite !mxE. Qed.

Notation power k := (iter k (mulmx (table_matrix n n (lA L))) (table_matrix n p (lC L))).

Lemma power_image (K : fieldType) k : iter k (mulmx (mat K n n (lA L))) (mat K n p (lC L)) = map_mx (number_rmorphism K) (power k).
Proof. by elim: k => [|k IH]; [exact: mat_image | rewrite !iterS IH mat_image -map_mxM]. Qed.

Lemma entry_image (i : 'I_(n + s * m)) (j : 'I_(s * p)) :
  exists z, forall K, window (over_field K n m p L) s i j = number_rmorphism K z.
Proof.
case/mxvec_indexP: j => k b; rewrite /window; case: (split_ordP i) => [a ->|j ->].
  exists (power k a b) => K; rewrite col_mxEu.
  have [/matrixP/(_ a b) + _] := window_blocks (over_field K n m p L) k k; rewrite mxE => ->.
  by rewrite power_image mxE.
case/mxvec_indexP: j => t a.
exists ((if (t < k)%N then table_matrix m n (lF L) *m power (k - t.+1) else if t == k then table_matrix m p (lG L) else 0) a b) => K.
rewrite col_mxEd; have [_ /matrixP/(_ a b)] := window_blocks (over_field K n m p L) t k; rewrite mxE => ->.
case: ifP => _; first by rewrite power_image /= mat_image -map_mxM mxE.
by case: ifP => _; rewrite /= ?mat_image mxE // [in RHS]mxE rmorph0.
Qed.

Lemma window_image : exists M : 'M[Z]_(n + s * m, s * p), forall K, window (over_field K n m p L) s = map_mx (number_rmorphism K) M.
Proof.
have /fin_all_exists[M h] : forall i, exists f : 'I_(s * p) -> Z, forall j K, window (over_field K n m p L) s i j =
    number_rmorphism K (f j).
  by move=> i; apply: (fin_all_exists (entry_image i)).
by exists (\matrix_(i, j) M i j) => K; apply/matrixP => i j; rewrite h [RHS]mxE [X in _ = _ X]mxE.
Qed.

Lemma number_injective : injective (number_rmorphism (field_of rat)).
Proof. by move=> x y /eqP; rewrite -subr_eq0 -rmorphB /= number_eq0 subr_eq0 => /eqP. Qed.

Theorem rank_over_field (K : fieldType) : (\rank (window (over_field K n m p L) s) <= \rank (window (over_field ratF n m p L) s))%N.
Proof. by have [M e] := window_image; rewrite !e; apply/rank_image/number_injective. Qed.

End Image.

(** Multiplying A, F, C, G by e changes no rank. *)
Section ScaledWindows.
Variables (K : fieldType) (n m p : nat) (s : nat).

Lemma scaled_rank_le (e : K) (S : system K n m p) : e != 0 -> (\rank (window (scaled e S) s) <= \rank (window S s))%N.
Proof.
move=> e0; pose d := samples s (fun k => const_mx (e ^+ k.+1) : 'rV[K]_p).
apply: leq_trans (mxrankM_maxl _ (diag_mx d)); apply/mxrankS/row_subP => i.
have /sub_windowP[x [v h]] := row_sub i (window (scaled e S) s).
have -> : row i (window (scaled e S) s) = samples s (output S x (fun j => e ^- j *: v j)) *m diag_mx d.
  rewrite -[LHS]unsamplesK; apply/rowP => j; rewrite mul_mx_diag [RHS]mxE; case/mxvec_indexP: j => k b.
  have at_kb r : samples s r 0 (mxvec_index k b) = r k 0 b :> K by rewrite mxvecE mxE.
  by rewrite /d !at_kb h // scaled_output_back // mxE [X in _ = _ * X]mxE mulrC.
apply: submxMr; apply/windowP; exact: output_word.
Qed.

Theorem scaled_rank (e : K) (S : system K n m p) : e != 0 -> \rank (window (scaled e S) s) = \rank (window S s).
Proof.
move=> e0; apply/eqP; rewrite eqn_leq scaled_rank_le //=.
have {1}-> : S = scaled e^-1 (scaled e S) by case: S => A F C G; rewrite /scaled /= !scalerA mulVf // !scale1r.
by apply: scaled_rank_le; rewrite invr_eq0.
Qed.

End ScaledWindows.

(** In sum: a bound from below over any field holds over the rational numbers. *)
Theorem rank_from_below (K : fieldType) n m p L s : well_formed n m p L ->
  (\rank (window (over_field K n m p L) s) <= \rank (window (meant n m p L) s))%N.
Proof.
move=> wf; rewrite -(scaled_rank _ _ (den_neq0 wf)) -/(integral n m p L) (integralE wf); exact: rank_over_field.
Qed.
