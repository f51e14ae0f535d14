(** Kernel rows seen to be a minimal basis modulo l, prime or not: then no window has a smaller rank than they say. *)
From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary CertificatesVocabulary Lists ListedSystems SeenBasis SeenRows.
From faultspace Require Import Elimination PolynomialDeterminant IntegralWindows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma field_modulo l : Z.ltb 1 l -> exists K : fieldType, number_rmorphism K l = 0.
Proof.
move/Z.ltb_lt => l1; have pr : prime (pdiv (Z.to_nat l)) by apply: pdiv_prime; lia.
exists [fieldType of 'F_(pdiv (Z.to_nat l))]; rewrite /= /number; have -> : int_of_Z l = Z.to_nat l by lia.
by rewrite -pmulrn; apply/eqP; rewrite -(dvdn_charf (char_Fp pr)) pdiv_dvd.
Qed.

Section Meaning.
Variables (K : fieldType) (l : Z) (n m p : nat) (L : listed).
Notation phi := (number_rmorphism K).
Hypotheses (vanishing : phi l = 0) (wf : well_formed n m p L).
Let S := over_field K n m p L.
Definition col_over k (u : vector) : 'cV[K]_k := (vec K k u)^T.

Lemma invertible_neq0 a : invertible_modulo l a -> phi a != 0.
Proof. by move/(number_inverts vanishing) => e; apply/eqP => a0; move/eqP: e; rewrite a0 mul0r eq_sym oner_eq0. Qed.

Lemma vec_null_modulo k u : null (reduced l u) -> vec K k u = 0.
Proof. by move=> h; rewrite -(vec_reduced vanishing) vec_null. Qed.

Lemma horner_modulo_meaning c : col_over n (horner_modulo l L c).1 = horner_state (sysA S) (sysC S) (map (col_over p) c).
Proof.
case/and5P: wf => _ /andP[_ rA] _ /andP[_ rC] _.
elim: c => [|c0 c /=]; first by rewrite /col_over vec_nil trmx0.
case: (horner_modulo l L c) => X ds /= IH; rewrite /col_over (vec_reduced vanishing) vec_add linearD /=.
by rewrite (vec_apply _ _ _ rC) (vec_apply _ _ _ rA) -/(col_over n X) IH.
Qed.

Lemma horner_modulo_demands c : (horner_modulo l L c).2 = [seq ((horner_modulo l L (drop k.+1 c)).1, nth [::] c k) | k <- iota 0 (size c)].
Proof.
elim: c => //= c0 c; case e: (horner_modulo l L c) => [X ds] /= ->; rewrite drop0 e; congr cons.
by rewrite -[1%N]/(1 + 0)%N iotaDl -map_comp.
Qed.

(** A row, and what it is over the field. *)
Definition row_over (c : seq vector) : seq 'cV[K]_p := map (col_over p) [seq reduced l u | u <- (weighted (den L) c).2].

Lemma row_over_size c : size (row_over c) = size c.
Proof. by rewrite !size_map weighted_size. Qed.

Lemma last_row_over c : last 0 (row_over c) = col_over p (last [::] c).
Proof.
have last_weighted : forall x, col_over p (last x (weighted (den L) (x :: c)).2) = col_over p (last x c).
  elim: c => [|c0 c IH] x; first by rewrite /col_over /= vec_scale [number K _]rmorph1 scale1r.
  by have := IH c0; rewrite /=; case: (weighted (den L) c) => w cs /=.
rewrite /row_over -map_comp; case: c last_weighted => [|c0 c] h; first by rewrite /col_over vec_nil trmx0.
have := h c0; rewrite /=; case: (weighted _ c) => w cs /= <-.
by rewrite (last_map (fun u => col_over p (reduced l u))) /col_over (vec_reduced vanishing).
Qed.

Lemma col_joined (d : vector * vector) : col_over (n + p) (joined n d) = col_mx (col_over n d.1) (col_over p d.2).
Proof.
apply/colP => i; rewrite !mxE; case: (split_ordP i) => j ->; rewrite !mxE /entry /joined nth_cat size_mkseq /=.
  by rewrite ltn_ord nth_mkseq.
by rewrite ltnNge leq_addr addKn.
Qed.

Lemma polynomial_row_nth c k : (k < size c)%N -> col_over (n + p) (nth [::] (polynomial_row n l L c) k)
  = col_mx (horner_state (sysA S) (sysC S) (drop k.+1 (row_over c))) (row_over c)`_k.
Proof.
set cw := [seq reduced l u | u <- (weighted (den L) c).2]; have sw : size cw = size c by rewrite size_map weighted_size.
rewrite -sw /polynomial_row /demands_modulo -/cw horner_modulo_demands -map_comp => kc.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n /= col_joined /= horner_modulo_meaning map_drop.
by rewrite /row_over -/cw [X in _ = col_mx _ X](nth_map [::]).
Qed.

Lemma annihilated_modulo_sound c : annihilated_modulo l L c -> passes S (row_over c).
Proof.
rewrite /annihilated_modulo /demands_modulo; set cw := map _ _; case e: (horner_modulo l L cw) => [X ds] /andP[X0 /allP ds0].
split; first by rewrite /row_over -/cw -horner_modulo_meaning e /col_over vec_null // trmx0.
move=> k; rewrite size_map => kc; case/and5P: wf => _ _ /andP[_ rF] _ /andP[_ rG].
have : ((horner_modulo l L (drop k.+1 cw)).1, nth [::] cw k) \in ds.
  have -> : ds = (horner_modulo l L cw).2 by rewrite e.
  by rewrite horner_modulo_demands; apply/mapP; exists k; rewrite ?mem_iota.
move/ds0/(vec_null_modulo m); rewrite vec_add => /(congr1 trmx); rewrite trmx0 linearD /= (vec_apply _ _ _ rF) (vec_apply _ _ _ rG) => <-.
by rewrite /fault_action /row_over -/cw -map_drop -horner_modulo_meaning (nth_map [::]).
Qed.

Variables (rows : seq kernel_row) (h : hints) (ok : minimal n m p l L rows h).
Notation k := (size rows).
Notation c a := (row_over (nth (0%N, [::]) rows a).2).

Lemma row_facts a : (a < k)%N -> let row := nth (0%N, [::]) rows a in [/\ (row.1 < p)%N, (0 < size row.2)%N & passes S (row_over row.2)].
Proof.
case/andP: ok => /and4P[_ _ /allP shapes /allP ann] _ ak; have r_in := mem_nth (0%N, [::]) ak.
by have /andP[] := shapes _ r_in; split=> //; apply: annihilated_modulo_sound; apply: ann.
Qed.

Lemma pivot_proof (a : 'I_k) : ((nth (0%N, [::]) rows a).1 < p)%N. Proof. by have [] := row_facts (ltn_ord a). Qed.
Definition pivot_of a : 'I_p := Ordinal (pivot_proof a).
Notation Y := (columns_of S (fun a : 'I_k => c a)).

(** An entry of J Y, as a polynomial: coefficients are w times those of the row. *)
Lemma combined_polynomial (w : 'rV[K]_(n + p)) (a : 'I_k) (g : vector) :
  (forall i, (i < size (nth (0%N, [::]) rows a).2)%N ->
    number K (entry g i) = (w *m col_over (n + p) (nth [::] (polynomial_row n l L (nth (0%N, [::]) rows a).2) i)) 0 0) ->
  (size g <= size (nth (0%N, [::]) rows a).2)%N ->
  pol K g = (row_mx (- map_mx polyC (lsubmx w)) (map_mx polyC (rsubmx w)) *m col a Y) 0 0.
Proof.
move=> e short; rewrite col_columns; apply/polyP => i; rewrite coef_pol.
have split_w (y : 'cV[K]_(n + p)) : (row_mx (- lsubmx w) (rsubmx w) *m y) = w *m col_mx (- usubmx y) (dsubmx y).
  by rewrite -{1}[y]vsubmxK -{3}[w]hsubmxK !mul_row_col mulNmx mulmxN.
transitivity ((row_mx (- lsubmx w) (rsubmx w) *m (if (i < size (c a))%N then coefficient S (c a) i else 0)) 0 0); last first.
  rewrite [(_ *m column_of _ _) 0 0]mxE coef_sum [LHS]mxE; apply: eq_bigr => j _; rewrite [column_of _ _ _ _]mxE.
  have -> : row_mx (- map_mx polyC (lsubmx w)) (map_mx polyC (rsubmx w)) 0 j = (row_mx (- lsubmx w) (rsubmx w) 0 j)%:P.
    by case: (split_ordP j) => t ->; rewrite ?row_mxEl ?row_mxEr !mxE ?polyCN.
  by rewrite coefCM coef_poly; case: ifP; rewrite ?mxE ?mulr0.
rewrite row_over_size; case: ifP => [ic|/negbT]; last first.
  by rewrite -leqNgt => ci; rewrite mulmx0 mxE /entry nth_default ?(leq_trans short) // [LHS](rmorph0 phi).
by rewrite e // split_w /coefficient col_mxKu col_mxKd opprK polynomial_row_nth.
Qed.

(** Determinants of tables of polynomials that combine the rows. *)
Definition combining (w : 'I_k -> 'rV[K]_(n + p)) : 'M[{poly K}]_(k, n + p) :=
  \matrix_b row_mx (- map_mx polyC (lsubmx (w b))) (map_mx polyC (rsubmx (w b))).

Lemma combined_determinant w (T : seq table) f : size T = k -> is_determinant_polynomial l T f ->
  (forall (a b : 'I_k), let g := nth [::] (nth [::] T a) b in let row := (nth (0%N, [::]) rows a).2 in (size g <= size row)%N /\
    forall i, (i < size row)%N -> number K (entry g i) = (w b *m col_over (n + p) (nth [::] (polynomial_row n l L row) i)) 0 0) ->
  \det (combining w *m Y) = pol K f.
Proof.
move=> sT /(is_determinant_polynomial_sound vanishing sT) <- e; rewrite -det_tr; congr (\det _); apply/matrixP => a b; rewrite mxE [RHS]mxE.
have [short coefs] := e a b; rewrite /pols (combined_polynomial coefs short).
transitivity ((combining w *m Y) b a); first by [].
by rewrite [LHS]mxE [RHS]mxE; apply: eq_bigr => i _; rewrite [combining w b i]mxE mxE [col a Y i 0]mxE.
Qed.

Lemma polynomial_row_size c : size (polynomial_row n l L c) = size c.
Proof. by rewrite size_map /demands_modulo horner_modulo_demands !size_map size_iota weighted_size. Qed.

Lemma pencil_entry (x : Z) (i : 'I_(n + m)) (j : 'I_(n + p)) :
  map_mx (horner_eval (phi (Z.mul (den L) x))) (pencil S) i j = phi (entry (nth [::] (pencil_table n L x) i) j).
Proof.
case/and5P: wf => _ /andP[/eqP sA _] /andP[/eqP sF _] /andP[/eqP sC _] /andP[/eqP sG _].
rewrite mxE /pencil /pencil_table nth_cat size_map size_iota.
case: (split_ordP i) => s ->; rewrite ?(block_mxEul, block_mxEur) /=.
  rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n /entry nth_cat size_mkseq.
  case: (split_ordP j) => t ->; rewrite ?block_mxEul ?block_mxEur /=.
    rewrite nth_mkseq // [RHS]number_sub !mxE /horner_eval hornerD hornerN hornerC -val_eqE /= eq_sym.
    by case: (_ == _); rewrite ?hornerX ?mulr0n ?horner0 ?rmorph0 // mulr1n hornerX.
  by rewrite addKn !mxE /horner_eval hornerC.
rewrite addKn (nth_map ([::], [::])) ?size_zip ?sF ?sG ?minnn // nth_zip ?sF //= /entry nth_cat size_mkseq.
case: (split_ordP j) => t ->; rewrite ?block_mxEdl ?block_mxEdr /=.
  by rewrite nth_mkseq // [RHS]number_opp !mxE /horner_eval hornerN hornerC.
by rewrite addKn !mxE /horner_eval hornerC.
Qed.

Lemma pencil_minor_sound x minor_rows columns d : pencil_minor n m p l L x minor_rows columns d ->
  (size minor_rows <= \rank (map_mx (horner_eval (phi (Z.mul (den L) x))) (pencil S)))%N.
Proof.
case/and5P=> /allP r_in /allP c_in /eqP sizes unit /(is_determinant_sound vanishing) e.
have row_lt (i : 'I_(size minor_rows)) : (nth 0%N minor_rows i < n + m)%N by apply/r_in/mem_nth.
have column_lt (j : 'I_(size minor_rows)) : (nth 0%N columns j < n + p)%N by apply/c_in/mem_nth; rewrite sizes.
apply: (@minor_rank _ _ _ _ _ (fun i => Ordinal (row_lt i)) (fun j => Ordinal (column_lt j))).
move: (invertible_neq0 unit); rewrite -e; congr (\det _ != 0); apply/matrixP => i j.
rewrite mxE [LHS]mxE [RHS]mxE pencil_entry /= (nth_map 0%N) // /at_pivots {1}/entry (nth_map 0%N) ?sizes //.
Qed.

Theorem minimal_modulo s : (k <= p)%N /\
  \rank (window S s) = (s * (p - k) + \sum_(mu <- degrees rows) minn s mu)%N.
Proof.
case/andP: (ok) => _ /and5P[first_ok second_ok /andP[lead_unit lead_ok] coprime /andP[few pencil_ok]].
pose ws := mixtures l (mix h) (n + p) k.
pose pick (b : 'I_k) : 'rV[K]_(n + p) := delta_mx 0 (rshift n (pivot_of b)).
pose blend (b : 'I_k) : 'rV[K]_(n + p) := vec K (n + p) (nth [::] ws b).
have sizes s' x j : size (geometric l s' x j) = j by elim: j x => //= j IH x; rewrite IH.
have ws_size : size ws = k by rewrite size_map sizes.
have mix_size (b : 'I_k) : (size (nth [::] ws b) <= n + p)%N by rewrite (nth_map Z0) ?sizes.
have e1 : \det (combining pick *m Y) = pol K (at_pivots_is h).
  apply: combined_determinant first_ok _; rewrite ?size_map // => a b.
  rewrite (nth_map [::]) ?size_map // (nth_map (0%N, [::])) // (nth_map 0%N) ?size_map // => g row.
  rewrite /g size_map polynomial_row_size; split=> // i ir; rewrite /entry (nth_map [::]) ?polynomial_row_size // /pick -rowE !mxE.
  by rewrite /= (nth_map (0%N, [::])).
have e2 : \det (combining blend *m Y) = pol K (mixed_is h).
  apply: combined_determinant second_ok _; rewrite ?size_map // => a b.
  rewrite (nth_map [::]) ?size_map // (nth_map (0%N, [::])) // (nth_map [::]) ?ws_size // => g row.
  rewrite /g size_map polynomial_row_size; split=> // i ir; rewrite /entry (nth_map [::]) ?polynomial_row_size //
    [LHS](number_modulo vanishing).
  by rewrite (number_dot _ _ (_ : (size _ <= n + p)%N)) ?mxE ?eqxx // mix_size.
have leads : \det (\matrix_(a < k, b < k) last 0 (c a) (pivot_of b) 0) != 0.
  move: (invertible_neq0 lead_unit); rewrite -(is_determinant_sound vanishing lead_ok); congr (\det _ != 0); apply/matrixP => a b.
  rewrite mxE [RHS]mxE [LHS]mxE (nth_map (0%N, [::])) // /at_pivots {1}/entry (nth_map 0%N) ?size_map // (nth_map (0%N, [::])) //.
  by rewrite last_row_over !mxE.
have seen : coprimep (\det (combining pick *m Y)) (\det (combining blend *m Y)).
  by rewrite e1 e2; apply: coprime_modulo_sound coprime.
have enough := pencil_minor_sound pencil_ok.
have kernel (a : 'I_k) : passes S (c a) by have [] := row_facts (ltn_ord a).
have nonempty (a : 'I_k) : (0 < size (c a))%N by rewrite row_over_size; have [] := row_facts (ltn_ord a).
have {}few : (n + p <= \rank (map_mx (horner_eval (phi (Z.mul (den L) (at_point h)))) (pencil S)) + k)%N.
  by apply: leq_trans few _; rewrite leq_add2r.
have [kp ->] := seen_rank kernel nonempty leads seen few s.
split=> //; congr (_ + _)%N; rewrite /degrees big_map (big_nth (0%N, [::])) big_mkord.
by apply: eq_bigr => a _; rewrite row_over_size.
Qed.

End Meaning.

(** The lower bound, over the rational numbers. *)
Theorem minimal_sound n m p l L rows h : well_formed n m p L -> minimal n m p l L rows h -> (size rows <= p)%N /\
  forall s, (s * (p - size rows) + \sum_(mu <- degrees rows) minn s mu <= \rank (window (meant n m p L) s))%N.
Proof.
move=> wf ok; have [K vanishing] : exists K : fieldType, number_rmorphism K l = 0 by apply: field_modulo; case/andP: ok => /and4P[].
have rank := minimal_modulo vanishing wf ok; split=> [|s]; first by have [] := rank 0%N.
by have [_ <-] := rank s; apply: rank_from_below.
Qed.
