(** An input of any rational spectrum and a stable system, as means. The covariances of the inputs satisfy a difference equation with
    coefficients a_0, ..., a_r, and so do those of the state with later inputs, since the state forgets where it was. So the covariance of
    the past inputs with the state, the future inputs projected away, times the reciprocal polynomial of a at A is seen_rational, a
    polynomial in A and B. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg ssrnum
  matrix mxalgebra zify.
From faultspace Require Import Vocabulary Signals Consistency LimitsVocabulary WholeRange.
From faultspace Require Import MeansVocabulary Means MeanLimits Forgetting FilteredInputs LongPast PastStates RationalSeen.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Reversed.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (nu r : nat) (a : nat -> K) (u : nat -> 'rV[K]_nu).
Hypotheses (isE : mean E) (quasi : quasi_stationary E u).

Lemma covariances_of_lags l k : exists R, forall i, (i < k)%N -> covariance E u (later (l + i) u) (R i).
Proof.
elim: k => [|k [R IH]]; first by exists (fun=> 0).
have [R' h] := quasi (l + k)%N; exists (fun i => if i == k then R' else R i) => i; rewrite ltnS leq_eqVlt.
by case: eqP => [-> _|_ /IH].
Qed.

(** The difference equation backwards in time. *)
Lemma equation_backwards l : spectrum_equation E r a u ->
  covariance E (later (r + l).+1 u) (fun t => \sum_(k < r.+1) a k *: later (r - k) u t) 0.
Proof.
move=> [_ eqn]; have [R hR] := covariances_of_lags l.+1 r.+1.
have zero : \sum_(k < r.+1) a k *: R k = 0 by exact: (covariance_unique isE (covariance_sum isE a hR) (eqn l)).
have each k : (k < r.+1)%N -> covariance E (later (r + l).+1 u) (later (r - k) u) (R k)^T.
  move=> kr; apply: (covariance_ext isE) (covariance_transpose isE (covariance_later isE (r - k) (hR k kr))) => // t.
  by rewrite /later; congr u; lia.
have := covariance_sum isE a each; have -> : \sum_(k < r.+1) a k *: (R k)^T = (\sum_(k < r.+1) a k *: R k)^T; last by rewrite zero trmx0.
by rewrite linear_sum; apply: eq_bigr => k _; rewrite linearZ.
Qed.

End Reversed.

(** What a signal that knows nothing of the faults shares with a later state. *)
Lemma cov_later_state (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y a
    (z : 'M_(N, a)) i j : process S B D u v x y -> (forall l, (l < j)%N -> cov Q z (v (i + l)%N) = 0) ->
  cov Q z (x (i + j)%N) = iter j (mulmxr (sysA S)) (cov Q z (x i)) +
    \sum_(l < j) cov Q z (u (i + l)%N) *m iter (j.-1 - l) (mulmxr (sysA S)) B.
Proof.
move=> model; elim: j => [|j IH] zv; first by rewrite addn0 big_ord0 addr0.
have [e _] := model (i + j)%N; rewrite addnS e !cov_add !cov_mul zv // mul0mx addr0 IH => [|l lj]; last by apply: zv; apply: ltnW.
rewrite mulmxDl -addrA; congr (_ + _); rewrite big_ord_recr /= subnn mulmx_suml; congr (_ + _); apply: eq_bigr => l _.
by rewrite -mulmxA; have := ltn_ord l; case: j {IH zv e} l => // j l lj; rewrite subSn //= -ltnS.
Qed.

Section Limits.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p) (r : nat) (a : nat -> K).
Hypotheses (isE : mean E) (pos : positive E) (model : process S B D u v x y) (st : stable (sysA S)).
Hypotheses (quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t))) (uv : uncorrelated E u v).
Hypothesis spectrum : spectrum_equation E r a u.
Let A := sysA S.
Let h t := row_mx (row_mx (u t) (v t)) (x t).
Let cu : combination h u.
Proof. by apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !addr0. Qed.
Let cx : combination h x.
Proof. by apply: combination_ext (combination_part h (col_mx 0 1%:M)) => t; rewrite !mul_row_col mulmx0 mulmx1 add0r. Qed.

(** The same difference equation for the state and later inputs. *)
Let along b (g : nat -> 'rV[K]_b) t := \sum_(k < r.+1) a k *: later (r - k) g t.

Lemma state_equation l : covariance E (later (r + l) u) (along x) 0.
Proof.
have calong : combination h (along x).
  apply: (combination_sum _ (f := fun k t => a k *: later (r - k) x t)) => k.
  by apply: combination_ext (combination_mul (a k)%:M (combination_later (r - k) cx)) => t; rewrite mul_mx_scalar.
have step t : along x t.+1 = along x t *m A + row_mx (along u t) (along v t) *m col_mx B (sysF S).
  rewrite mul_row_col /along !mulmx_suml -!big_split; apply: eq_bigr => k _ /=; rewrite /later addSn.
  by have [-> _] := model (t + (r - k))%N; rewrite !scalerDr -!scalemxAl addrA.
have of_u : knows_nothing_before E (later 1 (later r u)) (along u).
  have qu : quasi_stationary E u by move=> i; apply: (combination_covariance isE quasi cu (combination_later i cu)).
  move=> i; apply: (covariance_ext isE) (equation_backwards isE qu i spectrum) => // t.
  by rewrite /later; congr u; lia.
have of_v : knows_nothing_before E (later 1 (later r u)) (along v).
  move=> i; have := covariance_sum isE (k := r.+1) a (fun k _ => uncorrelated_at (i + 1 + r) (r - k) isE uv);
    rewrite big1 => [|k _]; last exact: scaler0.
  by apply: (covariance_ext isE) => // t; rewrite /later !addnA.
have := past_state isE pos quasi st (combination_later r cu) calong step (before_row isE of_u of_v) l.
by apply: (covariance_ext isE) => // t; rewrite /later; congr u; lia.
Qed.

Theorem rational_product q s R M : covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R -> excites E s u ->
  limit E (successive 0 q u) (successive q s u) (later q x) M -> seen_rational a R A B = M *m reciprocal_at r a A.
Proof.
move=> hR [Ru uu unit] hM; pose H := (r + q + s)%N.
have [N [Q [g [U [V [X [Y [[sym gQ] model' inputs [states _] windows]]]]]]]] := lifted_windows isE model quasi H.
have Wt t : successive 0 H u t = g t *m future 0 H U by have [] := windows 0%N H (leqnn _) t.
have Zt t : later r (successive 0 q u) t = g t *m future r q U.
  by rewrite successive_later addn0; have [|] := windows r q _ t; first by rewrite /H; lia.
have Ut t : later r (successive q s u) t = g t *m future (r + q) s U.
  by rewrite successive_later; have [] := windows (r + q)%N s (leqnn _) t.
have Xt t : later r (later q x) t = g t *m X (r + q)%N by rewrite /later -addnA states // /H; lia.
have UV i k : (i < H)%N -> (k < H)%N -> cov Q (U i) (V k) = 0.
  by move=> iH kH; apply: (image_uncorrelated isE gQ uv (i := i) (k := k)) => t; [have [] := inputs i iH t|have [] := inputs k kH t].
have [X0 [hX0 eM]] : projected_limit Q (future r q U) (future (r + q) s U) (X (r + q)%N) M.
  by apply/(image_limit isE gQ M Zt Ut Xt); apply: limit_later.
rewrite -(image_cov isE gQ Wt Wt hR) seen_rational_image reciprocal_mul.
have unitU : cov Q (future (r + q) s U) (future (r + q) s U) \in unitmx.
  rewrite (image_cov isE gQ Ut Ut (R := Ru)) //; apply: (covariance_ext isE) (covariance_later isE (r + q) uu) => t;
    by rewrite !successive_later ?addn0.
have {}hX0 : X0 = cov Q (future r q U) (future (r + q) s U) *m invmx (cov Q (future (r + q) s U) (future (r + q) s U)).
  by rewrite -hX0 mulmxK.
set Z := future r q U in hX0 eM; set Uf := future (r + q) s U in hX0 eM unitU.
pose P b (z : 'M[K]_(N, b)) := cov Q Z z - X0 *m cov Q Uf z.
have alone b (z : 'M_(N, b)) : (forall i, (r <= i < H)%N -> cov Q (U i) z = 0) -> cov Q Z z = 0 /\ cov Q Uf z = 0.
  move=> zero; rewrite /Z /Uf !cov_future_left; split; rewrite big1 // => i _; rewrite zero ?mulmx0 //;
    by have := ltn_ord i; rewrite /H; lia.
have ZV k : (k < H)%N -> cov Q Z (V k) = 0 /\ cov Q Uf (V k) = 0 by move=> kH; apply: alone => i /andP[_ iH]; apply: UV.
have part k : (k <= r)%N -> M = iter (q + k) (mulmxr A) (P n (X (r - k)%N)) + seen_state Q (fun i => U (r - k + i)%N) (q + k) q s A B.
  move=> kr; rewrite eM -[(r + q)%N](_ : r - k + (q + k) = _)%N; last by lia.
  have zero l : (l < q + k)%N -> cov Q Z (V (r - k + l)%N) = 0 /\ cov Q Uf (V (r - k + l)%N) = 0 by move=> lq; apply: ZV; rewrite /H; lia.
  rewrite !(cov_later_state (i := (r - k)%N) (j := (q + k)%N) model') => [|l /zero[]//|l /zero[]//].
  rewrite mulmxDr opprD addrACA; congr (_ + _); first by rewrite -iter_mul [in RHS]iter_power mulmxBl -!iter_power.
  rewrite /seen_state (_ : future (q + k - q) q _ = Z); last by apply: future_ext => i _; congr U; lia.
  rewrite (_ : future (q + k) s _ = Uf); last by apply: future_ext => i _; congr U; lia.
  by rewrite mulmx_sumr -sumrB; apply: eq_bigr => l _; rewrite -hX0 mulmxA -mulmxBl.
have null : \sum_(k < r.+1) a k *: P n (X (r - k)%N) = 0.
  have xt t : along x t = g t *m \sum_(k < r.+1) a k *: X (r - k)%N.
    rewrite /along mulmx_sumr; apply: eq_bigr => l _; rewrite -scalemxAr -states //; rewrite /H; lia.
  have UX i : (r <= i < H)%N -> cov Q (U i) (\sum_(k < r.+1) a k *: X (r - k)%N) = 0.
    move=> /andP[ri iH]; have Ui t : later i u t = g t *m U i by have [] := inputs i iH t.
    by apply: (image_cov isE gQ Ui xt); rewrite -(subnKC ri); apply: state_equation.
  have -> : \sum_(k < r.+1) a k *: P n (X (r - k)%N) = P n (\sum_(k < r.+1) a k *: X (r - k)%N).
    rewrite /P !cov_sum mulmx_sumr -sumrB; apply: eq_bigr => k _.
    by rewrite -!mul_mx_scalar !cov_mul mulmxBl !mulmxA.
  by rewrite /P; have [-> ->] := alone _ _ UX; rewrite mulmx0 subr0.
have : iter (q + r) (mulmxr A) (\sum_(k < r.+1) a k *: P n (X (r - k)%N)) = 0 by rewrite null iter_power mul0mx.
rewrite iter_sum -[LHS]addr0 => e; rewrite -[LHS]add0r -{1}e addr0 -big_split; apply: eq_bigr => k _ /=.
have kr : (k <= r)%N by rewrite -ltnS.
rewrite [in RHS](part k kr) iter_add iter_scale -scalerDr -iterD; congr (_ *: (iter _ _ _ + _)); lia.
Qed.

Theorem rational_range q s R L : covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R -> excites E s u ->
  row_free (O S s) -> limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
  (exists M, [/\ limit E (successive 0 q u) (successive q s u) (later q x) M, L = M *m O S s
    & seen_rational a R A B = M *m reciprocal_at r a A]) /\
  row_full (seen_rational a R A B) = (L == O S s)%MS && (reciprocal_at r a A \in unitmx).
Proof.
move=> hR exc obs /(mean_containment isE model quasi uv)[M [hM eL]]; have e := rational_product hR exc hM.
split; first by exists M.
rewrite eL e product_right //; set F := reciprocal_at r a A; apply/idP/andP => [full|[full unit]]; last first.
  by rewrite /row_full mxrankMfree // row_free_unit.
have top : (n <= \rank (M *m F))%N by rewrite (eqP full).
rewrite -row_full_unit /row_full !eqn_leq !rank_leq_col (leq_trans top) ?mxrankM_maxl //=.
by rewrite (leq_trans top) ?mxrankM_maxr.
Qed.

End Limits.

(** Somewhere the rank is full. *)
Theorem rational_somewhere (K : fieldType) (E : (nat -> K) -> K -> Prop) n nu (u : nat -> 'rV[K]_nu) r (a : nat -> K) q s R : mean E ->
  covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R -> excites E s u -> excites E (q + s) u ->
  a r = 1 -> (0 < nu)%N -> (n <= q)%N -> exists (A : 'M[K]_n) B, iter n (mulmxr A) 1%:M = 0 /\ row_full (seen_rational a R A B).
Proof.
move=> isE hR [R1 uu unit] [R2 uu' unit'] ar nu0 nq; pose g := successive 0 (r + q + s) u.
pose U k : 'M[K]_(_, nu) := if insub k is Some i then (place K nu (i : 'I_(r + q + s)))^T else 0.
have window k s' : (k + s' <= r + q + s)%N -> forall t, successive k s' u t = g t *m future k s' U.
  move=> kt t; apply: image_window => j t' /andP[_ jk]; have lt : (j < r + q + s)%N by lia.
  by rewrite /U insubT /g /successive addn0 -sample_of_future.
have shifted k s' R' : (k + s' <= r + q + s)%N -> covariance E (successive 0 s' u) (successive 0 s' u) R' ->
    cov R (future k s' U) (future k s' U) = R'.
  move=> kt uu''; apply: (image_cov isE hR (window k s' kt) (window k s' kt)).
  by apply: (covariance_ext isE) (covariance_later isE k uu'') => t; rewrite successive_later addn0.
apply: (seen_sum_somewhere (u := U) ar nu0 nq); first by rewrite (shifted _ _ _ (leqnn _) uu).
by rewrite (shifted _ _ _ _ uu') // addnA.
Qed.
