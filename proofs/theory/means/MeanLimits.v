(** What the theorems about covariances say of means: the limit of PI-MOESP lies in the range of O_s, B and D are right, an autoregressive
    input shows all of the range; and with past outputs among the instruments the limit lies in the range where the faults are white. Where
    the covariances exist and s successive inputs excite, the limits of PI-MOESP and of PO-MOESP exist. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary Signals Consistency Regression LimitsVocabulary ShortPast MeansVocabulary Means.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Limits.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p).
Hypotheses (isE : mean E) (model : process S B D u v x y) (quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t))).

(** lifted, with windows. *)
Lemma lifted_windows H : exists N (Q : 'M[K]_N) (g : nat -> 'rV[K]_N) U V X Y, [/\ Q^T = Q /\ covariance E g g Q, process S B D U V X Y,
  forall k, (k < H)%N -> forall t, u (t + k)%N = g t *m U k /\ v (t + k)%N = g t *m V k,
  (forall k, (k <= H)%N -> forall t, x (t + k)%N = g t *m X k) /\ (forall k, (k < H)%N -> forall t, y (t + k)%N = g t *m Y k)
  & forall k s, (k + s <= H)%N -> forall t, [/\ successive k s u t = g t *m future k s U, successive k s v t = g t *m future k s V
      & successive k s y t = g t *m future k s Y]].
Proof.
have [N [Q [g [U [V [X [Y [gQ model' inputs states outputs]]]]]]]] := lifted isE model quasi H.
exists N, Q, g, U, V, X, Y; split=> // k s ksH t.
have lt j : (k <= j < k + s)%N -> (j < H)%N by lia.
by split; apply: image_window => j t' /lt jH; [have [] := inputs j jH t'|have [] := inputs j jH t'|exact: outputs].
Qed.

Theorem mean_containment q s L : uncorrelated E u v -> limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
  exists M, limit E (successive 0 q u) (successive q s u) (later q x) M /\ L = M *m O S s.
Proof.
move=> uv; have [N [Q [g [U [V [X [Y [[_ gQ] model' inputs [states _] windows]]]]]]]] := lifted_windows (q + s).
have Zu t : successive 0 q u t = g t *m future (q - q) q U by rewrite subnn; have [] := windows 0%N q (leq_addr s q) t.
have Uf t : successive q s u t = g t *m future q s U by have [] := windows q s (leqnn _) t.
have Yf t : successive q s y t = g t *m future q s Y by have [] := windows q s (leqnn _) t.
move/(image_limit isE gQ L Zu Uf Yf)/(two_sided_past_inputs model' (leqnn q)) => [i k|M [limit ->]].
  move=> ti tk; apply: (image_uncorrelated isE gQ uv (i := i) (k := k)) => t; [have [|] := inputs i _ t|have [|] := inputs k _ t] => //;
    lia.
by exists M; split=> //; apply/(image_limit isE gQ M Zu Uf (states q (leq_addr s q))).
Qed.

Theorem mean_regression s Ruu Ruy W B' D' : (0 < s)%N -> row_free (O S s.-1) -> uncorrelated E u v ->
  covariance E (successive 0 s u) (successive 0 s u) Ruu -> covariance E (successive 0 s u) (successive 0 s y) Ruy -> W *m Ruu = 1%:M ->
  (W *m Ruy - T (with_faults S B' D') s) *m cokermx (O S s) = 0 <-> B' = B /\ D' = D.
Proof.
move=> s0 obs uv uu uy; have [N [Q [g [U [V [X [Y [[_ gQ] model' inputs _ windows]]]]]]]] := lifted_windows s.
have Uf t : successive 0 s u t = g t *m future 0 s U by have [] := windows 0%N s (leqnn _) t.
have Yf t : successive 0 s y t = g t *m future 0 s Y by have [] := windows 0%N s (leqnn _) t.
rewrite -(image_cov isE gQ Uf Uf uu) -(image_cov isE gQ Uf Yf uy) => hW; apply: (two_sided_regression model') => //.
apply: uncorrelated_futures => i k ti tk.
by apply: (image_uncorrelated isE gQ uv (i := i) (k := k)) => t; [have [|] := inputs i _ t|have [|] := inputs k _ t] => //; lia.
Qed.

Theorem mean_autoregressive q s a Au e L : uncorrelated E u v -> autoregressive_input E a Au u e -> knows_nothing_before E (later a e) x ->
  excites E s u -> (0 < s)%N -> (a <= s)%N -> (n <= q)%N -> (forall z, steered S B z) ->
    limit E (successive 0 q u) (successive q s u) (successive q s y) L -> (L == O S s)%MS.
Proof.
move=> uv [ar [Re ee unit_e] past] causal [Ru uu unit_u] s0 short nq all hL; pose H := (q + a + s)%N.
have [N [Q [g [U [V [X [Y [[sym gQ] model' inputs [states _] windows]]]]]]]] := lifted_windows H.
pose I k := U k - \sum_(i < a) U (k - i.+1)%N *m Au i.
have innovations k : (a <= k < H)%N -> forall t, e (t + k)%N = g t *m I k.
  move=> /andP[ak kH] t; have := ar (t + (k - a))%N; have -> : (t + (k - a) + a = t + k)%N by lia.
  rewrite (proj1 (inputs k kH t)) => h; rewrite /I mulmxBr h mulmx_sumr; set sum := \sum_(i < a) u _ *m _.
  suff -> : \sum_(i < a) g t *m (U (k - i.+1)%N *m Au i) = sum by rewrite addrC addKr.
  apply: eq_bigr => i _; have iH : (k - i.+1 < H)%N by lia.
  rewrite mulmxA -(proj1 (inputs _ iH t)); congr (u _ *m _); have := ltn_ord i; lia.
have model_ar : autoregressive Q a Au U I (q + a + s).
  move=> k ak; split; first by rewrite /I addrC subrK.
    have ek := innovations k ak; rewrite (image_cov isE gQ (x := later k e) (y := later k e) ek ek (covariance_later isE k ee)) //.
  move=> i ik; apply: (image_before isE gQ past (i := k.-1) (k := i)) => [|t|t]; first by lia.
    by rewrite /later -addnA addn1 prednK ?innovations //; lia.
  by have [|] := inputs i _ t; first lia.
apply: (stationary_whole_range sym model' _ model_ar _ _ _ _ short nq (leq_addr a q) _ s0 all (L := L)) => [i k iH kH|k ak|||||].
- by apply: (image_uncorrelated isE gQ uv (i := i) (k := k)) => t; [have [|] := inputs i _ t|have [|] := inputs k _ t] => //; lia.
- apply: (image_before isE gQ causal (i := (k - a)%N) (k := 0%N)) => // t; last exact: states.
  by rewrite /later -addnA subnK ?innovations //; case/andP: ak.
- by apply: (image_stationary isE gQ (x := u) (y := u)) => k kH t; have [] := inputs k kH t.
- apply: (image_stationary isE gQ (x := u) (y := x)) => k kH t; [by have [] := inputs k kH t|by apply: states; lia].
- have Uf t : successive (q + a) s u t = g t *m future (q + a) s U by have [] := windows (q + a)%N s (leqnn _) t.
  have uu' := covariance_later isE (q + a) uu; rewrite (image_cov isE gQ Uf Uf (R := Ru)) //.
  by apply: covariance_ext uu' => // t; rewrite successive_later addn0.
- by rewrite leq_add2r.
have Za t : later a (successive 0 q u) t = g t *m future a q U.
  by rewrite successive_later addn0; have [|] := windows a q _ t; first by rewrite /H; lia.
have Ua t : later a (successive q s u) t = g t *m future (q + a) s U.
  by rewrite successive_later addnC; have [] := windows (q + a)%N s (leqnn _) t.
have Ya t : later a (successive q s y) t = g t *m future (q + a) s Y.
  by rewrite successive_later addnC; have [] := windows (q + a)%N s (leqnn _) t.
by rewrite addKn; apply/(image_limit isE gQ L Za Ua Ya)/limit_later.
Qed.

(** Past outputs among the instruments. *)
Theorem mean_past_outputs q s L : uncorrelated E u v -> knows_nothing_before E (later 1 v) v -> knows_nothing_before E v x ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> exists M, L = M *m O S s.
Proof.
move=> uv vv vx; have [N [Q [g [U [V [X [Y [[sym gQ] model' inputs [states _] windows]]]]]]]] := lifted_windows (q + s).
have Z t : row_mx (successive 0 q u t) (successive 0 q y t) = g t *m row_mx (future 0 q U) (future 0 q Y).
  by rewrite mul_mx_row; have [-> _ ->] := windows 0%N q (leq_addr s q) t.
have Uf t : successive q s u t = g t *m future q s U by have [] := windows q s (leqnn _) t.
have Yf t : successive q s y t = g t *m future q s Y by have [] := windows q s (leqnn _) t.
have inp k (kH : (k < q + s)%N) : (forall t, u (t + k)%N = g t *m U k) /\ (forall t, v (t + k)%N = g t *m V k).
  by split=> t; have [] := inputs k kH t.
have UV i k : (i < q + s)%N -> (k < q + s)%N -> cov Q (U i) (V k) = 0.
  by move=> iH kH; apply: (image_uncorrelated isE gQ uv (i := i) (k := k)); case: (inp _ iH) (inp _ kH) => [? ?] [? ?].
have before i k : (i < k < q + s)%N -> cov Q (Y i) (V k) = 0.
  move=> /andP[ik kH]; have iH := ltn_trans ik kH; have [_ vk] := inp k kH; have [_ vi] := inp i iH.
  have flip a (M : 'M_(N, a)) : cov Q (V k) M = 0 -> cov Q M (V k) = 0 by move=> e; rewrite -(cov_transpose (V k) M sym) e trmx0.
  have [_ ->] := model' i; rewrite !cov_add_left !cov_mul_left UV // mulmx0 addr0 [cov Q (X i) _]flip ?[cov Q (V i) _]flip ?mulmx0 ?addr0
    //.
    apply: (image_before isE gQ vv (i := k.-1) (k := i)) => [|t|]; [by lia| |exact: vi].
    by rewrite /later -addnA addn1 prednK ?vk //; lia.
  by apply: (image_before isE gQ vx (i := k) (k := i)) => [|//|t]; [exact: ltnW|apply: states; exact: ltnW].
move/(image_limit isE gQ L Z Uf Yf)/(two_sided_limit model') => [||M [_ ->]]; last by exists M.
  have -> : cov Q (row_mx (future 0 q U) (future 0 q Y)) (future q s V) = col_mx (cov Q (future 0 q U) (future q s V)) (cov Q (future 0 q
    Y) (future q s V)).
    by rewrite /cov tr_row_mx !mul_col_mx.
  rewrite !uncorrelated_futures ?col_mx0 // => i k ti tk; [apply: before; lia|apply: UV; lia].
by apply: uncorrelated_futures => i k ti tk; apply: UV; lia.
Qed.

End Limits.

(** Where the covariances exist and s successive inputs excite there are limits of PI-MOESP and of PO-MOESP. *)
Section Exist.
Variables (K : fieldType) (E : (nat -> K) -> K -> Prop) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m) (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p) (q s : nat).
Hypotheses (isE : mean E) (model : process S B D u v x y) (quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t))).
Hypothesis exciting : excites E s u.

Let limits_exist : (exists L, limit E (successive 0 q u) (successive q s u) (successive q s y) L) /\
  exists L, limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L.
Proof.
have [R uu unit] := exciting.
have [N [Q [g [U [V [X [Y [[_ gQ] model' inputs [states _] windows]]]]]]]] := lifted_windows isE model quasi (q + s).
have Uf t : successive q s u t = g t *m future q s U by have [] := windows q s (leqnn _) t.
have Yf t : successive q s y t = g t *m future q s Y by have [] := windows q s (leqnn _) t.
have e : cov Q (future q s U) (future q s U) = R.
  apply: (image_cov isE gQ Uf Uf); apply: (covariance_ext isE) (covariance_later isE q uu) => t; by rewrite successive_later addn0.
have instruments z (Z : nat -> 'rV[K]_z) M : (forall t, Z t = g t *m M) -> exists L, limit E Z (successive q s u) (successive q s y) L.
  move=> Zg; eexists; apply/(image_limit isE gQ _ Zg Uf Yf); eexists (_ *m invmx R); split; last by [].
  by rewrite e mulmxKV.
split; first by apply: (instruments _ _ (future 0 q U)) => t; have [] := windows 0%N q (leq_addr s q) t.
apply: (instruments _ _ (row_mx (future 0 q U) (future 0 q Y))) => t.
by rewrite mul_mx_row; have [-> _ ->] := windows 0%N q (leq_addr s q) t.
Qed.

Lemma limit_exists : exists L, limit E (successive 0 q u) (successive q s u) (successive q s y) L.
Proof. by have [] := limits_exist. Qed.

Lemma past_outputs_limit_exists :
  exists L, limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L.
Proof. by have [] := limits_exist. Qed.
End Exist.
