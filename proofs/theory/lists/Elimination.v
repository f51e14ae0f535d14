(** Determinants modulo l, by elimination on lists. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import CertificatesVocabulary Lists.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Meaning.
Variables (K : fieldType) (l : Z).
Notation phi := (number_rmorphism K).
Hypothesis vanishing : phi l = 0.

Lemma number_add a b : phi (Z.add a b) = phi a + phi b. Proof. exact: rmorphD. Qed.
Lemma number_sub a b : phi (Z.sub a b) = phi a - phi b. Proof. exact: rmorphB. Qed.
Lemma number_mul a b : phi (Z.mul a b) = phi a * phi b. Proof. exact: rmorphM. Qed.
Lemma number_opp a : phi (Z.opp a) = - phi a. Proof. exact: rmorphN. Qed.
Lemma number_one : phi (Zpos xH) = 1. Proof. exact: rmorph1. Qed.

Lemma number_zero z : Z.eqb (Z.modulo z l) Z0 -> phi z = 0.
Proof. by move/Z.eqb_eq => e; rewrite (Z_div_mod_eq_full z l) e [phi _](rmorphD phi) rmorphM vanishing mul0r rmorph0 addr0. Qed.

Lemma number_modulo z : phi (Z.modulo z l) = phi z.
Proof. by rewrite [in RHS](Z_div_mod_eq_full z l) [RHS](rmorphD phi) rmorphM vanishing mul0r add0r. Qed.

Lemma number_inverts a b : inverts_modulo l a b -> phi a * phi b = 1.
Proof. by move/number_zero/eqP; rewrite number_sub number_mul number_one subr_eq0 => /eqP. Qed.

Lemma vec_reduced k u : vec K k (reduced l u) = vec K k u.
Proof.
apply/rowP => j; rewrite !mxE /entry /reduced; have [ju|uj] := ltnP j (size u); last by rewrite !nth_default ?size_map.
by rewrite (nth_map Z0) // [LHS]number_modulo.
Qed.

Lemma vec_lead k u : vec K (1 + k) u = row_mx (number K (entry u 0))%:M (vec K k (behead u)).
Proof.
apply/rowP => j; rewrite mxE; case: (split_ordP j) => i ->; rewrite ?row_mxEl ?row_mxEr !mxE ?ord1 ?eqxx ?mulr1n //.
by rewrite /entry nth_behead.
Qed.

Lemma mat_cons a b r M : mat K (1 + a) b (r :: M) = col_mx (vec K b r) (mat K a b M).
Proof.
by apply/row_matrixP => i; rewrite rowK; case: (split_ordP i) => j ->; rewrite ?rowKu ?rowKd ?ord1 ?row_id ?rowK.
Qed.

Lemma det_ready k r rows : size rows = k ->
  \det (mat K (1 + k) (1 + k) (ready l r rows :: rows)) = \det (mat K (1 + k) (1 + k) (r :: rows)).
Proof.
move=> sk; rewrite /ready; case: ifP => // _; case e: [seq other <- rows | _] => [|other few] /=.
  by rewrite !mat_cons vec_add vec_nil addr0.
have : other \in rows by move: (mem_head other few); rewrite -e mem_filter => /andP[].
case/(nthP [::]) => i; rewrite sk => ik other_is; pose i1 := rshift 1 (Ordinal ik) : 'I_(1 + k).
rewrite (@determinant_multilinear _ _ _ (mat K (1 + k) (1 + k) (r :: rows)) (mat K (1 + k) (1 + k) (other :: rows)) 0 1 1).
- rewrite !mul1r [X in _ + X](@determinant_alternate _ _ _ 0 i1) ?addr0 // => j.
  by rewrite !mxE /= other_is.
- by rewrite !rowK /= vec_add !scale1r.
- by apply/row_matrixP => j; rewrite !row_rowsub !rowK.
- by apply/row_matrixP => j; rewrite !row_rowsub !rowK.
Qed.

Lemma schur k (a : K) (b : 'rV[K]_k) (c : 'cV[K]_k) (D : 'M[K]_k) : a != 0 ->
  \det (block_mx a%:M b c D) = a * \det (D - a^-1 *: (c *m b)).
Proof.
move=> a0; rewrite -[LHS]mul1r.
have <- : \det (block_mx 1%:M 0 (- (a^-1 *: c)) 1%:M) = 1 :> K by rewrite det_lblock !det1 mulr1.
rewrite -det_mulmx mulmx_block !mul1mx !mul0mx !addr0 mulNmx mul_mx_scalar scalerA mulfV // scale1r addNr det_ublock det_scalar1.
by congr (_ * \det _); rewrite mulNmx -scalemxAl addrC.
Qed.

Theorem is_determinant_sound k rows d : is_determinant l k rows d -> \det (mat K k k rows) = phi d.
Proof.
elim: k rows d => [|k IH] rows d /=.
  by move/number_zero/eqP; rewrite number_sub number_one subr_eq0 det_mx00 => /eqP ->.
case: rows => // r rows; set lead := ready _ _ _; set b := inverse_modulo _ _ => /andP[/eqP sk].
case: ifP => [/number_inverts ab|_ /andP[/allP zero /number_zero ->]]; last first.
  rewrite (expand_det_col _ 0) big1 // => i _; rewrite mxE mxE (_ : number K _ = 0) ?mul0r //.
  by apply/number_zero/zero/mem_nth; rewrite /= sk.
have a0 : phi (entry lead 0) != 0 by apply/eqP => e; move/eqP: ab; rewrite e mul0r eq_sym oner_eq0.
have inv : (phi (entry lead 0))^-1 = phi b by apply: (mulfI a0); rewrite ab mulfV.
move/IH; rewrite number_modulo number_mul => rest.
rewrite -(det_ready r sk) -/lead mat_cons vec_lead.
have -> : mat K k (1 + k) rows = row_mx (mat K k 1 rows) (mat K k k [seq behead other | other <- rows]).
  apply/row_matrixP => i; rewrite rowK row_row_mx !rowK vec_lead (nth_map [::]) ?sk //; congr row_mx.
  by apply/rowP => j; rewrite !mxE !ord1 eqxx mulr1n.
move: rest; set cleared := mat K k k _ => rest.
rewrite -/(block_mx _ _ _ _) schur // inv (_ : _ - _ = cleared); first by rewrite rest mulrCA ab mulr1.
rewrite /cleared; apply/row_matrixP => i; rewrite linearB /= linearZ /= row_mul !rowK !(nth_map [::]) ?sk // vec_reduced vec_add vec_scale.
rewrite [number K (Z.modulo _ _)]number_modulo number_opp number_mul scaleNr; congr (_ - _).
rewrite [vec K 1 _]mx11_scalar mul_scalar_mx scalerA mxE mulrC; congr (_ *: _).
Qed.

End Meaning.
