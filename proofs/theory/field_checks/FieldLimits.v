(** What identification converges to in the stationary process of an experiment told by lists of numbers: the covariances from that of the
    states, the ranks by elimination. *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype finfun bigop order zmodp ssralg finalg ssrnum
  matrix mxalgebra zify.
From faultspace Require Import Vocabulary NumbersVocabulary ExperimentsVocabulary NumberLists CheckMatrices FieldMatrices Signals.
From faultspace Require Import Stability FieldProcesses.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma rank_eliminated (K : fieldType) a b r (M : 'M[K]_a) (B : 'M_(a, b)) (C : 'M_(r, a)) (D : 'M_(r, b)) X : M \in unitmx ->
  X *m M = C -> \rank (block_mx M B C D) = (a + \rank (D - X *m B)%R)%N.
Proof.
move=> unit_M eX.
have -> : block_mx M B C D = block_mx 1%:M 0 X 1%:M *m (block_mx 1%:M 0 0 (D - X *m B) *m block_mx M B 0 1%:M).
  by rewrite !mulmx_block !(mul1mx, mulmx1, mul0mx, mulmx0, addr0, add0r) eX addrC subrK.
rewrite eqmxMfull; last by rewrite row_full_unit unitmxE det_lblock !det1 mulr1 unitr1.
rewrite mxrankMfree; last by rewrite row_free_unit unitmxE det_ublock det1 mulr1 -unitmxE.
by rewrite rank_diag_block_mx mxrank1.
Qed.

(** Covariances of windows. *)
Section Windows.
Variables (K : fieldType) (N : nat) (Q : 'M[K]_N).

Lemma cov_future q w t s (Y : 'M[K]_(N, w)) (r : nat -> 'M[K]_(N, q)) i (j : 'I_(s * q)) :
  cov Q Y (future t s r) i j = cov Q Y (r (t + j %/ q)%N) i (Ordinal (output_lt j)).
Proof. by rewrite /cov mxE [RHS]mxE; apply: eq_bigr => k _; rewrite future_entry. Qed.

Lemma cov_future_left q w t s (Y : 'M[K]_(N, w)) (r : nat -> 'M[K]_(N, q)) (i : 'I_(s * q)) j :
  cov Q (future t s r) Y i j = cov Q (r (t + i %/ q)%N) Y (Ordinal (output_lt i)) j.
Proof. by rewrite /cov -!mulmxA !mxE; apply: eq_bigr => k _; rewrite [_^T _ _]mxE [_^T _ _ in RHS]mxE future_entry. Qed.

Lemma cov_blocks a b c d (W : 'M[K]_(N, a)) (X : 'M_(N, b)) (Y : 'M_(N, c)) (Z : 'M_(N, d)) :
  cov Q (row_mx W X) (row_mx Y Z) = block_mx (cov Q W Y) (cov Q W Z) (cov Q X Y) (cov Q X Z).
Proof. by rewrite /cov tr_row_mx mul_col_mx mul_col_row. Qed.

Lemma cov_white_window c H (e : nat -> 'M[K]_(N, c)) : white Q e H -> cov Q (future 0 H e) (future 0 H e) = 1%:M.
Proof.
move=> unit_e; apply/matrixP => i j; rewrite cov_future cov_future_left !add0n unit_e ?sample_lt // mxE.
have : (i == j) = (i %/ c == j %/ c)%N && (i %% c == j %% c)%N.
  apply/eqP/andP => [->|[/eqP d /eqP m]]; first by rewrite !eqxx.
  by apply: ord_inj; rewrite (divn_eq i c) (divn_eq j c) d m.
by move=> ->; case: (i %/ c == j %/ c)%N; rewrite !mxE // -val_eqE.
Qed.
End Windows.

Section Sound.
Variables (R : arithmetic) (n m p nu c H : nat) (E : experiment_list R).
Notation table := (seq (seq (numeral R))).
Let h := (nu + (m + p))%N.
Let l := size (tback E).
Let a := (n + l * h)%N.
Let b := (a + H * c)%N.
Let start : table * seq table := (basic R b 0 n, [seq basic R b (n + i * h) h | i <- iota 0 l]).
Let next : table := joint_states b n h (next_states m nu b E (basic R b a c) start).
Hypotheses (H0 : (0 < H)%N) (sizes : sized_experiment n m p nu c E).

Section Basis.
Variables (K : fieldType) (value : numeral R -> K) (N : nat).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).
Variables (x : 'M[K]_(N, n)) (s : nat -> 'M[K]_(N, h)) (e : nat -> 'M[K]_(N, c)).
Let X0 := row_mx x (future 0 l s).
Let X : 'M_(N, b) := row_mx X0 (future 0 H e).

Lemma start_holds : s l = 0 -> holds value E X start x s.
Proof.
move=> sl; split=> /=.
  have le : (0 + n <= b)%N by rewrite /b /a; lia.
  rewrite (mat_basic meaning _ le); apply/matrixP => i j; rewrite mxE.
  have -> : widen_ord le (rshift 0 j) = lshift _ (lshift _ j) by apply: val_inj.
  by rewrite !row_mxEl.
move=> i; rewrite -/l leq_eqVlt => /orP[/eqP ->|il].
  rewrite nth_default ?size_map ?size_iota // sl (_ : mat b h [::] = 0) ?mulmx0 //.
  by apply/matrixP => r j; rewrite mat_entry nth_nil (place_nil meaning) mxE.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n.
have le : (n + i * h + h <= b)%N by rewrite /b /a; nia.
rewrite (mat_basic meaning _ le); apply/matrixP => r j; rewrite mxE.
have lt : (i * h + j < l * h)%N by have := ltn_ord j; nia.
have -> : widen_ord le (rshift (n + i * h) j) = lshift _ (rshift _ (Ordinal lt)) by apply: val_inj; exact: esym (addnA _ _ _).
rewrite row_mxEl row_mxEr future_entry add0n /=; have h0 : (0 < h)%N := leq_ltn_trans (leq0n _) (ltn_ord j).
rewrite divnMDl // divn_small // addn0; congr (s i r _); apply: ord_inj; by rewrite /= modnMDl modn_small.
Qed.

Lemma noise_holds k : (k < H)%N -> X *m mat b c (basic R b (a + k * c) c) = e k.
Proof.
move=> kH; have le : (a + k * c + c <= b)%N by rewrite /b; nia.
rewrite (mat_basic meaning _ le); apply/matrixP => r j; rewrite mxE.
have lt : (k * c + j < H * c)%N by have := ltn_ord j; nia.
have -> : widen_ord le (rshift (a + k * c) j) = rshift _ (Ordinal lt) by apply: val_inj; exact: esym (addnA _ _ _).
rewrite row_mxEr future_entry add0n /=; have c0 : (0 < c)%N := leq_ltn_trans (leq0n _) (ltn_ord j).
rewrite divnMDl // divn_small // addn0; congr (e k r _); apply: ord_inj; by rewrite /= modnMDl modn_small.
Qed.

Lemma next_joint x' s' : follow (experiment_of value n m p nu c E) (e 0%N) x s x' s' -> s' l = 0 ->
  X *m mat b a next = row_mx x' (future 0 l s').
Proof.
move=> step s'l; have sl : s l = 0 by case: step.
have now := start_holds sl; have first : X *m mat b c (basic R b a c) = e 0%N by rewrite -(noise_holds H0) mul0n addn0.
have later : holds value E X (next_states m nu b E (basic R b a c) start) x' s'.
  exact: (next_holds meaning sizes now first step).
by apply: joint_holds later _; rewrite size_map size_iota.
Qed.
End Basis.

(** The joint transition. *)
Lemma next_upper (K : fieldType) (value : numeral R -> K) : matrix_of value a a next = matrix_of value a a (take a next).
Proof. by apply/matrixP => i j; rewrite !mxE nth_take. Qed.

Lemma stable_states f (C : numClosedFieldType) (value : numeral R -> C) : means value -> is_stable a (take a next) f ->
  stable_experiment (experiment_of value n m p nu c E).
Proof.
move=> meaning ok z x s step not_zero; have stable := is_stable_sound meaning ok.
have sl : s l = 0 by case: step.
have eX : row_mx (row_mx x (future 0 l s)) (future 0 H (fun=> 0 : 'M_(1, c))) *m matrix_of value b a next
    = z *: row_mx x (future 0 l s).
  rewrite (next_joint meaning step) ?sl ?scaler0 // scale_row_mx; congr row_mx; apply/matrixP => i j.
  by rewrite future_entry [RHS]mxE future_entry mxE.
apply: (stable z (row_mx x (future 0 l s))).
  apply/negP => /eqP X0; move: not_zero; rewrite -(row_mx0 _ _ n (l * h)) in X0; have [x0 s0] := eq_row_mx X0.
  case=> [/eqP //|[i il /eqP si]]; apply: si; have [_ /(_ i (ltnW il)) <-] := start_holds meaning x (fun=> 0 : 'M_(1, c)) sl.
  by rewrite x0 s0 row_mx0 (_ : future 0 H _ = 0) ?row_mx0 ?mul0mx //; apply/matrixP => r j; rewrite future_entry !mxE.
have noise0 : future 0 H (fun=> 0 : 'M_(1, c)) = 0 :> 'M[C]_(1, H * c) by apply/matrixP => r j; rewrite future_entry !mxE.
by move: eX; rewrite noise0 mat_rows mul_row_col mul0mx addr0.
Qed.

Section Stationary.
Variables (K : fieldType) (value : numeral R -> K) (C : numClosedFieldType) (embed : {rmorphism K -> C}).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).
Let E' := experiment_of value n m p nu c E.
Variables (f : seq Z) (P : table).
Hypotheses (sP : size P = a) (stable : is_stable a (take a next) f) (solves : equal_tables a a (covariances a P a next next) P).
Variables (N : nat) (Q : 'M[K]_N) (e : nat -> 'M[K]_(N, c)) (x : nat -> 'M[K]_(N, n)) (s : nat -> nat -> 'M[K]_(N, h))
  (u : nat -> 'M[K]_(N, nu)) (y : nat -> 'M[K]_(N, p)).
Hypothesis running : stationary_process E' Q H e x s u y.
Let X0 := row_mx (x 0%N) (future 0 l (s 0%N)).
Let X : 'M_(N, b) := row_mx X0 (future 0 H e).
Let W : 'M[K]_b := block_mx (mat a a P) 0 0 1%:M.

Lemma equal_meaning i j T T' : equal_tables i j T T' -> mat i j T = mat i j T'.
Proof.
move=> /allP eT; apply/matrixP => r k; rewrite !mat_entry; have r_in : nat_of_ord r \in iota 0 i by rewrite mem_iota /=.
have k_in : nat_of_ord k \in iota 0 j by rewrite mem_iota /=.
by apply/eqP; rewrite -subr_eq0 -(value_minus meaning) (value_vanishes meaning) //; have /allP := eT _ r_in; apply.
Qed.

Lemma next_size : size next = b.
Proof. by rewrite size_mkseq. Qed.

Lemma moments : cov Q X X = W.
Proof.
case: running => symmetric unit_e steps _ [fresh cxx cxs css].
have known0 : cov Q X0 (future 0 H e) = 0.
  rewrite /cov /X0 tr_row_mx !mul_col_mx -[RHS]col_mx0; congr col_mx; apply/matrixP => i j; rewrite -/(cov _ _ _) cov_future [RHS]mxE.
    by have [-> _] := fresh _ (sample_lt j); rewrite mxE.
  by rewrite cov_future_left !add0n; have [_ ->] := fresh _ (sample_lt j); rewrite ?mxE ?sample_lt.
have e1 : cov Q X X = block_mx (cov Q X0 X0) 0 0 1%:M.
  by rewrite /X cov_blocks known0 (cov_white_window unit_e) -[cov Q (future 0 H e) X0](cov_transpose _ _ symmetric) known0 trmx0.
have eX1 : X *m mat b a next = row_mx (x 1%N) (future 0 l (s 1%N)).
  by apply: (next_joint meaning (steps 0%N)); case: (steps 1%N).
have same : cov Q (row_mx (x 1%N) (future 0 l (s 1%N))) (row_mx (x 1%N) (future 0 l (s 1%N))) = cov Q X0 X0.
  rewrite /X0 !cov_blocks cxx; congr block_mx; apply/matrixP => i j.
  - by rewrite !cov_future !add0n cxs ?sample_lt.
  - rewrite -[cov Q (future _ _ (s 1%N)) _](cov_transpose _ _ symmetric) -[cov Q (future _ _ (s 0%N)) _](cov_transpose _ _ symmetric).
    by rewrite mxE [RHS]mxE !cov_future !add0n cxs ?sample_lt.
  by rewrite !cov_future !cov_future_left !add0n css ?sample_lt.
have eP := equal_meaning solves; rewrite (mat_covariances meaning a a next (e := H * c) sP next_size) in eP.
have eP' : (mat b a next)^T *m block_mx (cov Q X0 X0) 0 0 1%:M *m mat b a next = cov Q X0 X0.
  by rewrite -{2}same -eX1 cov_mul cov_mul_left e1.
set Phi := mat a a (take a next).
have difference (D : 'M[K]_a) : (mat b a next)^T *m block_mx D 0 0 (0 : 'M_(H * c)) *m mat b a next = Phi^T *m D *m Phi.
  by rewrite mat_rows tr_col_mx mul_row_block !mulmx0 !addr0 mul_row_col mul0mx addr0.
have stein : Phi^T *m (cov Q X0 X0 - mat a a P) *m Phi = cov Q X0 X0 - mat a a P.
  rewrite -difference -{2}eP' -{2}eP -mulmxBl -mulmxBr; congr (_ *m _ *m _).
  by rewrite opp_block_mx add_block_mx !oppr0 !addr0 subrr.
have meaning' : means (fun r => embed (value r) : C) := @means_in R K C value embed meaning.
have := is_stable_sound meaning' stable; rewrite -(@matrix_in R K C value embed) -/Phi => stable_Phi.
have := @stein_unique C a (map_mx embed Phi) (map_mx embed (cov Q X0 X0 - mat a a P)) stable_Phi.
rewrite map_trmx -!map_mxM stein => /(_ erefl)/eqP; rewrite map_mx_eq0 subr_eq0 => /eqP e0.
by rewrite e1 e0.
Qed.

(** Covariances of signals that tables tell. *)
Lemma told q q' T T' M M' : size T' = b -> X *m mat b q T = M -> X *m mat b q' T' = M' -> mat q q' (covariances a P q T T') = cov Q M M'.
Proof.
by move=> sT' <- <-; rewrite cov_mul cov_mul_left moments (mat_covariances meaning q q' (e := H * c) T sP sT').
Qed.

(** The inputs and outputs that tables record. *)
Let zs := recorded_channels m nu b E p start [seq basic R b (a + k * c) c | k <- iota 0 H].

Lemma recorded_signals k : (k < H)%N ->
  X *m mat b nu (nth [::] [seq z.1 | z <- zs] k) = u k /\ X *m mat b p (nth [::] [seq z.2 | z <- zs] k) = y k.
Proof.
case: running => _ _ steps reads _ kH; have [-> ->] := reads k.
have zs_size : size zs = H by rewrite recorded_size size_map size_iota.
rewrite !(nth_map ([::], [::])) ?zs_size // -[k]add0n.
apply: (recorded_hold meaning sizes (xs := start) (e := e) (x := x) (s := s)) (steps) _ _; rewrite ?size_map ?size_iota ?add0n //.
  by apply: (start_holds meaning); case: (steps 0%N).
move=> j jH; rewrite add0n (nth_map 0%N) ?size_iota // nth_iota // add0n; exact: (noise_holds meaning).
Qed.
End Stationary.
End Sound.

(** `moesp-limit`. *)
Section Limit.
Variables (R : arithmetic) (K : fieldType) (value : numeral R -> K).
Hypothesis meaning : means value.
Notation mat := (matrix_of value).

Lemma seen_table n m p w s (L : listing R) : sized n m p L ->
  mat n (w + s * p) [seq nseq w (zero R) ++ r | r <- free_rows n p s L] = row_mx 0 (O (system_of value n m p L) s).
Proof.
move=> wf; apply/matrixP => i j; rewrite mxE (nth_map [::]) ?size_map ?size_iota //; case: (split_ordP j) => k ->.
  by rewrite row_mxEl mxE /at_place nth_cat size_nseq /= ltn_ord nth_nseq ltn_ord (value_zero meaning).
rewrite row_mxEr /at_place nth_cat size_nseq /= ltnNge leq_addr addKn -[nth _ _ k]/(at_place _ k).
by rewrite (free_places meaning _ _ wf) position_val.
Qed.

Theorem is_limit_sound n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 : is_limit n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 ->
  forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),
  stable_experiment (experiment_of (fun r => embed (value r) : C) n m p nu c E) /\
  forall N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q (past + s) e x st u y ->
  let Z := row_mx (future 0 past u) (future 0 q y) in let Uf := future past s u in let Yf := future past s y in
  let seen := O (system_of value n m p (tplant E)) s in
  [/\ cov Q Uf Uf \in unitmx, \rank seen = ro &
    forall L, projected_limit Q Z Uf Yf L -> \rank L = rl /\ \rank (col_mx L seen) = rj].
Proof.
case/andP=> /andP[/and3P[past0 q_past sizes] /and3P[/eqP sP stable solves]] /and4P[ranks_u ranks_l ranks_o ranks_j] C embed.
have H0 : (0 < past + s)%N by rewrite addn_gt0 past0.
split.
  exact: (stable_states H0 sizes (@means_in R K C value embed meaning) stable).
move=> N Q e x st u y running Z Uf Yf seen; case: (running) => _ _ steps reads _.
have know := told H0 sizes embed meaning sP stable solves running.
move: know ranks_u ranks_l ranks_o ranks_j; set a := (n + _ * _)%N; set b := (a + _)%N; set X := row_mx _ (future 0 (past + s) e).
set start := (basic R b 0 n, _); set es := [seq basic R b (a + k * c) c | k <- iota 0 (past + s)].
set zs := recorded_channels _ _ _ _ _ _ _.
set us := [seq z.1 | z <- zs]; set ys := [seq z.2 | z <- zs] => know.
have es_size : size es = (past + s)%N by rewrite size_map size_iota.
have zs_size : size zs = (past + s)%N by rewrite recorded_size.
have zs_hold := recorded_signals H0 sizes meaning running; rewrite -/zs -/us -/ys in zs_hold.
have us_size : size us = (past + s)%N by rewrite size_map.
have ys_size : size ys = (past + s)%N by rewrite size_map.
have later w (ts : seq (seq (seq (numeral R)))) (r : nat -> 'M[K]_(N, w)) : size ts = (past + s)%N ->
    (forall k, (k < past + s)%N -> X *m mat b w (nth [::] ts k) = r k) ->
    X *m mat b (s * w) (windowed b w (drop past ts)) = future past s r.
  move=> ts_size hold; apply: windowed_holds; first by rewrite size_drop ts_size addKn.
  by move=> k ks; rewrite nth_drop hold // ltn_add2l.
have sooner w (ts : seq (seq (seq (numeral R)))) (r : nat -> 'M[K]_(N, w)) t : size ts = (past + s)%N -> (t <= past)%N ->
    (forall k, (k < past + s)%N -> X *m mat b w (nth [::] ts k) = r k) ->
    X *m mat b (t * w) (windowed b w (take t ts)) = future 0 t r.
  move=> ts_size le hold; apply: windowed_holds; first by rewrite size_takel // ts_size (leq_trans le) ?leq_addr.
  by move=> k kt; rewrite nth_take // hold // (leq_trans kt) // (leq_trans le) ?leq_addr.
have U_holds := later _ us u us_size (fun k kH => (zs_hold k kH).1).
have Y_holds := later _ ys y ys_size (fun k kH => (zs_hold k kH).2).
have UY_holds := beside_holds U_holds Y_holds.
have Z_holds := beside_holds (sooner _ us u past us_size (leqnn _) (fun k kH => (zs_hold k kH).1))
  (sooner _ ys y q ys_size q_past (fun k kH => (zs_hold k kH).2)).
have wf : sized n m p (tplant E) by case/and5P: sizes.
move=> /(rank_of_table meaning) + /(rank_of_table meaning) + /(rank_of_table meaning) + /(rank_of_table meaning).
rewrite !mat_cat ?size_map ?size_iota ?size_mkseq //.
rewrite (know _ _ _ _ _ _ _ U_holds U_holds) ?size_mkseq // (know _ _ _ _ _ _ _ U_holds UY_holds) ?size_mkseq //.
rewrite (know _ _ _ _ _ _ _ Z_holds UY_holds) ?size_mkseq // (seen_table _ _ wf).
have split_cov w (M : 'M[K]_(N, w)) : cov Q M (row_mx Uf Yf) = row_mx (cov Q M Uf) (cov Q M Yf) by rewrite /cov mul_mx_row.
rewrite -/Uf -/Yf -/Z !split_cov => rank_u rank_l rank_o rank_j.
have unit_u : cov Q Uf Uf \in unitmx by rewrite -row_free_unit /row_free rank_u.
split=> // [|L [A [eA ->]]].
  apply/eqP; rewrite -(eqn_add2l (s * nu)) -rank_o -[col_mx _ _]/(block_mx _ _ _ _).
  by rewrite (rank_eliminated _ _ unit_u (mul0mx _ _)) mul0mx subr0.
split; apply/eqP; rewrite -(eqn_add2l (s * nu)).
  by rewrite -rank_l -[col_mx _ _]/(block_mx _ _ _ _) (rank_eliminated _ _ unit_u eA).
rewrite -rank_j -[col_mx (row_mx (cov Q Z Uf) _) _]/(block_mx _ _ _ _) block_mxEh -[col_mx (row_mx _ _) _]/(block_mx _ _ _ _).
rewrite (rank_eliminated (X := col_mx A 0) _ _ unit_u) ?mul_col_mx ?mul0mx ?eA //.
by rewrite opp_col_mx add_col_mx subr0.
Qed.
End Limit.
