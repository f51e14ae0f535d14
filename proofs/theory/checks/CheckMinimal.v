(** Kernel rows seen to be a minimal basis modulo l, prime or not: then no window has a smaller rank than they say.

        col_over K k u == the list u as a column over K
    row_over K l p L c == a kernel row, as columns over K
            pivot_of a == the output in which row a has its pivot *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop prime zmodp ssralg finalg poly ssrint
  matrix mxalgebra fraction.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary CertificatesVocabulary Lists ListedSystems SeenBasis BasisByStates SeenRows.
From faultspace Require Import Elimination IntegralWindows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma field_modulo l : Z.ltb 1 l -> exists K : fieldType, number_rmorphism K l = 0.
Proof.
move/Z.ltb_lt => l1; have pr : prime (pdiv (Z.to_nat l)) by apply: pdiv_prime; lia.
exists (field_of 'F_(pdiv (Z.to_nat l))); rewrite /= /number; have -> : int_of_Z l = Z.to_nat l by lia.
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

(** A minor that is not zero. *)
Lemma is_minor_sound a b (T : table) (minor_rows columns : seq nat) d (M : 'M[K]_(a, b)) : is_minor a b l T minor_rows columns d ->
  (forall i j, M i j = phi (entry (nth [::] T i) j)) -> (size minor_rows <= \rank M)%N.
Proof.
case/and5P=> /allP r_in /allP c_in /eqP sizes unit /(is_determinant_sound vanishing) e entries.
have row_lt (i : 'I_(size minor_rows)) : (nth 0%N minor_rows i < a)%N by apply/r_in/mem_nth.
have column_lt (j : 'I_(size minor_rows)) : (nth 0%N columns j < b)%N by apply/c_in/mem_nth; rewrite sizes.
apply: (@minor_rank _ _ _ _ _ (fun i => Ordinal (row_lt i)) (fun j => Ordinal (column_lt j))).
move: (invertible_neq0 unit); rewrite -e; congr (\det _ != 0); apply/matrixP => i j.
rewrite mxE [LHS]mxE [RHS]mxE entries /= (nth_map 0%N) // /at_pivots {1}/entry (nth_map 0%N) ?sizes //.
Qed.

Lemma pencil_minor_sound q minor_rows columns d : pencil_minor n m p l L q minor_rows columns d ->
  (rank_shown n q minor_rows <= \rank (over_fractions (pencil S)))%N.
Proof.
case: q => [x|] /is_minor_sound shown.
  exact: leq_trans (shown _ (pencil_entry x)) (rank_at_point _ _).
by apply: leq_trans (rank_at_infinity S); rewrite leq_add2l shown // => i j; rewrite !mxE.
Qed.

(** The states of all rows, by row and degree. *)
Let places := flatten [seq [seq (a, j) | j <- iota 0 (size (nth (0%N, [::]) rows a).2).-1] | a <- iota 0 k].
Let state_at (place : nat * nat) : 'cV[K]_n := horner_state (sysA S) (sysC S) (drop place.2.+1 (c place.1)).

Lemma states_at : map (col_over n) (states_of_rows l L rows) = map state_at places.
Proof.
rewrite /states_of_rows /places !map_flatten; congr flatten.
rewrite -{1}[rows](mkseq_nth (0%N, [::])) /mkseq -!map_comp; apply/eq_in_map => a; rewrite mem_iota /= => ak.
set row := nth _ rows a; rewrite /demands_modulo horner_modulo_demands !size_map weighted_size -!map_comp -map_take take_iota.
rewrite -map_comp (minn_idPl (leq_pred _)); apply/eq_in_map => j _ /=.
by rewrite horner_modulo_meaning map_drop.
Qed.

Lemma states_independent d columns : is_minor (size (states_of_rows l L rows)) n l (states_of_rows l L rows)
    (iota 0 (size (states_of_rows l L rows))) columns d ->
  forall w : 'I_k -> nat -> K,
  \sum_(a < k) \sum_(j < (size (c a)).-1) w a j *: horner_state (sysA S) (sysC S) (drop j.+1 (c a)) = 0 ->
  forall (a : 'I_k) j, (j < (size (c a)).-1)%N -> w a j = 0.
Proof.
set T := states_of_rows l L rows; pose t := size T => minor w zero a j ja.
have t_places : size places = t by rewrite -(size_map state_at) -states_at size_map.
pose M : 'M[K]_(t, n) := \matrix_(i, j) phi (entry (nth [::] T i) j).
have tM : (t <= \rank M)%N by have := is_minor_sound (M := M) minor; rewrite size_iota; apply=> i' j'; rewrite mxE.
have row_M (i : 'I_t) : (row i M)^T = state_at (nth (0%N, 0%N) places i).
  rewrite -(nth_map _ 0 state_at) ?t_places // -states_at (nth_map [::]) //.
  by apply/colP => j0; rewrite !mxE.
pose w' (place : nat * nat) := if insub place.1 is Some a' then w (a' : 'I_k) place.2 else 0.
have w'E (a' : 'I_k) j0 : w' (a' : nat, j0) = w a' j0 by rewrite /w' valK.
have zM : (\row_(i < t) w' (nth (0%N, 0%N) places i)) *m M = 0.
  apply: trmx_inj; rewrite trmx0 -zero mulmx_sum_row linear_sum /=.
  transitivity (\sum_(place <- places) w' place *: state_at place).
    rewrite (big_nth (0%N, 0%N)) t_places big_mkord; apply: eq_bigr => i _; by rewrite linearZ /= row_M mxE.
  rewrite big_flatten big_map -{1}[k]subn0 big_mkord; apply: eq_bigr => a' _.
  rewrite big_map row_over_size -{1}[(size _).-1]subn0 big_mkord; apply: eq_bigr => j0 _.
  by rewrite w'E.
have free : row_free M by rewrite /row_free eqn_leq rank_leq_row.
move/eqP: zM; rewrite mulmx_free_eq0 // => /eqP/rowP z0.
have a_in : (a : nat, j) \in places.
  apply/flattenP; exists [seq (a : nat, j0) | j0 <- iota 0 (size (nth (0%N, [::]) rows a).2).-1].
    by apply/mapP; exists (a : nat); rewrite ?mem_iota //=.
  by apply/mapP; exists j; rewrite // mem_iota /= add0n -row_over_size.
have it : (index (a : nat, j) places < t)%N by rewrite -t_places index_mem.
by have := z0 (Ordinal it); rewrite !mxE /= nth_index // w'E.
Qed.

Theorem minimal_modulo s : (k <= p)%N /\
  \rank (window S s) = (s * (p - k) + \sum_(mu <- degrees rows) minn s mu)%N.
Proof.
case/andP: (ok) => _ /and4P[/andP[lead_unit lead_ok] /states_independent states few /pencil_minor_sound enough].
have regular : \det (\matrix_(a < k, b < k) last 0 (c a) (pivot_of b) 0) != 0.
  move: (invertible_neq0 lead_unit); rewrite -(is_determinant_sound vanishing lead_ok); congr (\det _ != 0); apply/matrixP => a b.
  rewrite mxE [RHS]mxE [LHS]mxE (nth_map (0%N, [::])) // /at_pivots {1}/entry (nth_map 0%N) ?size_map // (nth_map (0%N, [::])) //.
  by rewrite last_row_over !mxE.
have kernel (a : 'I_k) : passes S (c a) by have [] := row_facts (ltn_ord a).
have nonempty (a : 'I_k) : (0 < size (c a))%N by rewrite row_over_size; have [] := row_facts (ltn_ord a).
have {}few : (n + p <= \rank (over_fractions (pencil S)) + k)%N by apply: leq_trans few _; rewrite leq_add2r.
have [kp ->] := seen_rank kernel nonempty regular states few s.
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
