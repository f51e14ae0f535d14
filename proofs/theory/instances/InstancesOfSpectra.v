(** Instances for the headlines on an input of rational spectrum with a long memory: xi(t+1) = xi(t)/2 + e(t), u(t) = xi(t) + e(t), so that
    the filter (z + 1/2)/(z - 1/2) makes u of e, and x(t+1) = x(t)/2 + u(t) + v(t), y = x. All are time averages over the rational numbers,
    and e and v are white.

    innovations_excite == an input that holds at each time something new of unit covariance excites
           half_system == x(t+1) = x(t)/2 + u(t) + v(t), y = x
           long_memory == these signals *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary LimitsVocabulary MeansVocabulary Places Consistency Windows Means.
From faultspace Require Import Forgetting FilteredInputs InstancesOfMeans.
From faultspace Require MeanLimits TimeAverages WhiteMeans WhiteSources PartOfTheRange RationalMeans.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Windows.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (N nu : nat) (h : nat -> 'rV[K]_N) (u : nat -> 'rV[K]_nu).
Hypotheses (isE : mean E) (quasi : quasi_stationary E h) (cu : combination h u).

Lemma combination_successive s : combination h (successive 0 s u).
Proof.
have c := combination_sum s (f := fun i t => later i u t *m (if insub i is Some i then place K nu (i : 'I_s) else 0))
  (fun i => combination_mul _ (combination_later i cu)).
by apply: combination_ext c => t; rewrite /successive addn0 future_sum; apply: eq_bigr => i _; rewrite valK.
Qed.

Lemma covariance_of_window s : exists R, covariance E (successive 0 s u) (successive 0 s u) R.
Proof. by apply: (combination_covariance isE quasi); apply: combination_successive. Qed.

Lemma innovations_excite (e : nat -> 'rV[K]_nu) s : positive E -> combination h e -> knows_nothing_before E (later 1 e) u ->
  covariance E e e 1%:M -> covariance E e u 1%:M -> excites E s u.
Proof.
move=> pos ce later_e ee eu; have [R hR] := covariance_of_window s; exists R => //.
rewrite -row_free_unit; apply: inj_row_free => c cR; pose d i : 'cV_nu := if insub i is Some i then place K nu (i : 'I_s) *m c^T else 0.
pose f t := successive 0 s u t *m c^T.
have ef t : f t = \sum_(i < s) 1 *: (later i u t *m d i).
  by rewrite /f /successive addn0 future_sum mulmx_suml; apply: eq_bigr => i _; rewrite scale1r /d valK mulmxA.
have ff : covariance E f f 0 by have := covariance_images isE c^T c^T hR; rewrite trmxK cR mul0mx.
have ek k : covariance E (later k e) f 0.
  have cf : combination h f by apply: combination_mul; apply: combination_successive.
  have [C hC] := combination_covariance isE quasi (combination_later k ce) cf.
  by rewrite -(null_covariance isE pos (covariance_later isE k ee) ff hC).
have down n k : (s <= k + n)%N -> d k = 0.
  elim: n k => [|n IH] k kn; first by rewrite /d insubF //; apply/negbTE; rewrite -leqNgt; lia.
  have [ks|sk] := ltnP k s; last by rewrite /d insubF //; apply/negbTE; rewrite -leqNgt.
  have each i : (i < s)%N -> covariance E (later k e) (fun t => later i u t *m d i) (if i == k then d k else 0).
    move=> _; case: eqP => [->|/eqP ne].
      by have := covariance_mul isE (d k) (covariance_later isE k eu); rewrite mul1mx.
    have [ki|ik] := ltnP k i.
      rewrite (IH i); last by lia.
      by move=> a b; rewrite mxE; apply: (mean_ext isE) (mean_zero isE) => t; rewrite mulmx0 [X in _ * X]mxE mulr0.
    have := covariance_mul isE (d i) (covariance_later isE i (later_e (k - i.+1)%N)); rewrite mul0mx; apply: (covariance_ext isE) => // t.
    by rewrite /later; congr e; lia.
  have := covariance_sum isE (fun=> 1) each; rewrite (bigD1 (Ordinal ks)) //= eqxx scale1r big1 => [|i ne]; last first.
    by rewrite ifF ?scaler0 //; apply/negbTE; rewrite -val_eqE in ne.
  rewrite addr0 => hd; apply: (covariance_unique isE hd); apply: (covariance_ext isE) (ek k) => // t; exact: ef.
apply: trmx_inj; rewrite trmx0 -[c^T]mul1mx -sum_places mulmx_suml big1 // => i _.
by have := down s i (leq_addl _ _); rewrite /d valK -mulmxA => ->; rewrite mulmx0.
Qed.

End Windows.

Lemma half_powers (K : realFieldType) n k : iter k (mulmxr ((2%:R^-1 : K)%:M : 'M_n)) 1%:M = ((2%:R^-1) ^+ k)%:M.
Proof. by elim: k => [|k /= ->]; rewrite ?expr0 // mul_mx_scalar scale_scalar_mx -exprS. Qed.

Definition half_system (K : realFieldType) : system K 1 1 1 := System (2%:R^-1)%:M 1%:M 1%:M 0.

(** What a filter with the pole a makes of white noise, and a system with that pole of it. *)
Section Filter.
Variables (K : realFieldType) (E : (nat -> K) -> K -> Prop) (a : K) (e v xi x : nat -> 'rV[K]_1).
Hypotheses (isE : mean E) (pos : positive E) (quasi : quasi_stationary E (fun t => row_mx (row_mx (e t) (v t)) (row_mx (xi t) (x t)))).
Hypotheses (we : white_noise E e) (ev : uncorrelated E e v) (e_xi : knows_nothing_before E e xi) (v_xi : knows_nothing_before E v xi).
Hypothesis next : forall t, xi t.+1 = xi t *m a%:M + e t *m 1%:M.
Let u t := xi t + e t.
Let h t := row_mx (row_mx (e t) (v t)) (row_mx (xi t) (x t)).

Let parts : [/\ combination h e, combination h v, combination h xi & combination h x].
Proof.
split.
- by apply: combination_ext (combination_part h (col_mx (col_mx 1%:M 0) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !addr0.
- by apply: combination_ext (combination_part h (col_mx (col_mx 0 1%:M) 0)) => t; rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
- by apply: combination_ext (combination_part h (col_mx 0 (col_mx 1%:M 0))) => t; rewrite !mul_row_col !mulmx0 mulmx1 !(addr0, add0r).
by apply: combination_ext (combination_part h (col_mx 0 (col_mx 0 1%:M))) => t; rewrite !mul_row_col !mulmx0 mulmx1 !add0r.
Qed.

Let pair b c (f : nat -> 'rV[K]_b) (g : nat -> 'rV[K]_c) : combination h f -> combination h g ->
  combination h (fun t => row_mx (f t) (g t)).
Proof.
move=> cf cg; apply: combination_ext (combination_add (combination_mul (row_mx 1%:M 0) cf) (combination_mul (row_mx 0 1%:M) cg)) => t.
by rewrite !mul_mx_row !mulmx1 !mulmx0 add_row_mx addr0 add0r.
Qed.

Lemma filter_facts : [/\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v, order_of_spectrum E 1 u
  & (forall s, excites E s u) /\ forall s, exists R, covariance E (successive 0 s u) (successive 0 s u) R].
Proof.
have [ce cv cxi cx] := parts; have cu : combination h u by apply: combination_add.
have quasi_of b (f : nat -> 'rV[K]_b) : combination h f -> quasi_stationary E f.
  by move=> cf l; apply: (combination_covariance isE quasi cf (combination_later l cf)).
have zero0 b c (f : nat -> 'rV[K]_b) (g : nat -> 'rV[K]_c) : covariance E f g 0 -> covariance E g f 0.
  by move=> fg; have := covariance_transpose isE fg; rewrite trmx0.
have ee : covariance E e e 1%:M by apply: (covariance_ext isE) (we 0%N) => // t; rewrite /later addn0.
have eu : covariance E e u 1%:M.
  rewrite -[1%:M]add0r; apply: (covariance_add isE) ee; apply: (covariance_ext isE) (e_xi 0%N) => // t; by rewrite /later addn0.
have e_u : knows_nothing_before E (later 1 e) u.
  move=> l; rewrite -[0]addr0; apply: (covariance_add isE) (WhiteMeans.white_before isE we l).
  by apply: (covariance_ext isE) (e_xi (l + 1)%N) => // t; rewrite /later addnA.
split.
- by apply: (quasi_of _ _ (pair (pair cu cv) cx)).
- move=> l; have [e1 e2] := ev l; split; apply: (zero0 _ _ _ _); rewrite -[0]addr0.
    exact: (covariance_add isE (v_xi l) (zero0 _ _ _ _ e1)).
  apply: (covariance_add isE _ (zero0 _ _ _ _ e2)); rewrite -(_ : iter l (mulmxr a%:M) 0 = 0 :> 'M_1).
    apply: (free_response isE next) => [j _|]; first by apply: (zero0 _ _ _ _); have [] := ev j.
    by apply: (covariance_ext isE) (v_xi 0%N) => // t; rewrite /later addn0.
  by elim: l {e1 e2} => //= l ->; rewrite mul0mx.
- apply: (filtered_inputs (A := a%:M) (B := 1%:M) (C := 1%:M) (D := 1%:M) isE (e := e) (xi := xi)) => //;
    last exact: (quasi_of _ _ (pair cu cxi)).
  by move=> t; split=> //; rewrite !mulmx1.
by split=> s; [apply: (innovations_excite isE quasi cu _ pos ce)|apply: (covariance_of_window isE quasi cu)].
Qed.

End Filter.

Lemma long_memory (K : realFieldType) : archimedean K -> exists (E : (nat -> K) -> K -> Prop) (u v x y : nat -> 'rV[K]_1),
  [/\ [/\ mean E, positive E, process (half_system K) (1%:M : 'M_1) 0 u v x y & stable (sysA (half_system K))],
    quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v, order_of_spectrum E 1 u
  & (forall s, excites E s u) /\ forall s, exists R, covariance E (successive 0 s u) (successive 0 s u) R].
Proof.
move=> arch; pose a : K := 2%:R^-1; have a01 : 0 < a < 1 by rewrite invr_gt0 ltr0n invf_lt1 ?ltr0n // ltr1n.
pose N : 'M[K]_(1 + 1) := block_mx 0 1%:M 0 0; pose M : 'M[K]_(1 + 1) := a%:M + N.
have NN : N *m N = 0 by rewrite /N mulmx_block !(mul0mx, mulmx0, addr0) block_mx0.
have stM : stable M := PartOfTheRange.double_pole_stable arch a01 NN.
have st : stable (sysA (half_system K)).
  have st2 : stable ((a%:M : 'M_2) + 0) by apply: (PartOfTheRange.double_pole_stable arch a01); rewrite mul0mx.
  move=> eps eps0; have [k small] := st2 eps eps0; exists k => i j; have := small 0 0; rewrite addr0 !half_powers !mxE.
  by rewrite !ord1 eqxx.
pose S : system K (1 + 1) 1 1 := System M (row_mx 0 1%:M) 0 0.
have [X [y' [[model _] quasi [we _ ev] [_ eX _ vX] _]]] :=
  WhiteSources.driven_exist arch (row_mx 1%:M 1%:M : 'M_(1, 1 + 1)) (0 : 'M_(1, 1)) 0 (stM : stable (sysA S)).
have isE := TimeAverages.time_average_mean arch; have pos := @TimeAverages.time_average_positive K.
move: isE pos model quasi we ev eX vX; move: (@time_average K) => E; set e := fun t => lsubmx _; set v := fun t => rsubmx _.
move=> isE pos model quasi; have {quasi} : quasi_stationary E (fun t => row_mx (row_mx (e t) (v t)) (X t)) by exact: quasi.
move: e v model => e v model quasi we ev eX vX.
pose xi t : 'rV[K]_1 := lsubmx (X t); pose x t : 'rV[K]_1 := rsubmx (X t); pose u t := xi t + e t.
have next t : X t.+1 = row_mx (a *: xi t + e t) (a *: x t + u t + v t).
  have [-> _] := model t; rewrite -[X t]hsubmxK -/(xi t) -/(x t) /= mulmxDr mul_mx_scalar mul_row_block !mul_mx_row scale_row_mx.
  by rewrite !mulmx1 !mulmx0 !addr0 !add_row_mx !addr0 addrA.
have knows (w : nat -> 'rV_1) : knows_nothing_before E w X -> knows_nothing_before E w xi.
  move=> wX l; have := covariance_mul isE (col_mx 1%:M 0) (wX l); rewrite mul0mx; apply: (covariance_ext isE) => // t.
  by rewrite -[X t]hsubmxK mul_row_col mulmx1 mulmx0 addr0.
have xi_next t : xi t.+1 = xi t *m a%:M + e t *m 1%:M by rewrite /xi next row_mxKl mul_mx_scalar mulmx1.
have quasi' : quasi_stationary E (fun t => row_mx (row_mx (e t) (v t)) (row_mx (xi t) (x t))).
  move=> l; have [R hR] := quasi l; exists R; apply: (covariance_ext isE) hR => t; by rewrite /later /xi /x hsubmxK.
have [quasi_u uv spectrum exc] := filter_facts isE pos quasi' we ev (knows _ eX) (knows _ vX) xi_next.
exists E, u, v, x, x; split=> //; split=> // t; split; last by rewrite /= mulmx1 !mulmx0 !addr0.
by rewrite {1}/x next row_mxKr /= mul_mx_scalar !mulmx1.
Qed.

Lemma half_observed (K : realFieldType) s : (0 < s)%N -> row_free (O (half_system K) s).
Proof.
move=> s0; apply: inj_row_free => x; rewrite mul_O => /samples_eq0/(_ 0%N s0).
by rewrite /output /= mulmx1 mul0mx addr0.
Qed.

Lemma equation_of_order (K : fieldType) (E : (nat -> K) -> K -> Prop) nu (u : nat -> 'rV[K]_nu) r : order_of_spectrum E r u ->
  exists a, spectrum_equation E r a u.
Proof. by move=> [a [/monicP lead size_a] eqn]; exists (fun i => a`_i); split=> //; rewrite -lead /lead_coef size_a. Qed.

(** ** proposition-1, all of the range: u of rational spectrum and a long memory *)

Theorem mean_rational_range_instance : exists (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p)
    (B : 'M_(nu, n)) (D : 'M_(nu, p)) u v x y q s r a R L,
  mean E /\ positive E /\ process S B D u v x y /\ stable (sysA S) /\
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) /\ uncorrelated E u v /\ spectrum_equation E r a u /\
  covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R /\ excites E s u /\ row_free (O S s) /\
  limit E (successive 0 q u) (successive q s u) (successive q s y) L.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE pos model st] quasi uv order [exc window]]]]]]] := long_memory arch.
have [a spectrum] := equation_of_order order; have [R hR] := window (1 + 1 + 1)%N.
have [L lim] := MeanLimits.limit_exists 1 isE model quasi (exc 1%N).
exists K, E, 1%N, 1%N, 1%N, 1%N, (half_system K), 1%:M, 0, u, v, x, y, 1%N, 1%N, 1%N, a, R, L.
by do 9 (split; first by []); split; first exact: half_observed.
Qed.

Theorem mean_rational_order_instance : exists (K : realFieldType) (E : (nat -> K) -> K -> Prop) nu (u : nat -> 'rV_nu) r,
  mean E /\ positive E /\ quasi_stationary E u /\ order_of_spectrum E r u.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE pos model st] quasi uv order [exc window]]]]]]] := long_memory arch.
exists K, E, 1%N, u, 1%N; do 2 (split; first by []); split; last by [].
apply: (quasi_part (M := col_mx (col_mx 1%:M 0) 0) isE) quasi => t; by rewrite !mul_row_col !mulmx0 mulmx1 !addr0.
Qed.

Theorem mean_rational_somewhere_instance : exists (K : fieldType) (E : (nat -> K) -> K -> Prop) n nu (u : nat -> 'rV_nu) r (a : nat -> K)
    q s R,
  mean E /\ covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R /\ excites E s u /\ excites E (q + s) u /\
  a r = 1 /\ (0 < nu)%N /\ (n <= q)%N.
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE pos model st] quasi uv order [exc window]]]]]]] := long_memory arch.
have [a [ar _]] := equation_of_order order; have [R hR] := window (1 + 1 + 1)%N.
by exists K, E, 1%N, 1%N, u, 1%N, a, 1%N, 1%N, R; do 6 (split; first by []).
Qed.

(** On the line from a good (A, B) to (A, 0) the rank is lost at B = 0. *)
Theorem rational_almost_every_instance : exists (K : fieldType) n nu r (a : nat -> K) q s (R : 'M_((r + q + s) * nu)) (A A1 : 'M_n)
    (B B1 : 'M_(nu, n)) (ts : seq K),
  row_full (seen_rational a R A B) /\ uniq ts /\
  (forall c, c \in ts -> ~~ row_full (seen_rational a R (A + c *: A1) (B + c *: B1))).
Proof.
have [K arch] := archimedean_field; have [E [u [v [x [y [[isE pos model st] quasi uv order [exc window]]]]]]] := long_memory arch.
have [a [ar _]] := equation_of_order order; have [R hR] := window (1 + 1 + 1)%N.
have [A [B [_ full]]] := RationalMeans.rational_somewhere (n := 1) isE hR (exc _) (exc _) ar isT isT.
have zero k b (C : 'M[K]_1) : iter k (mulmxr C) (0 : 'M_(b, 1)) = 0 by elim: k => //= k ->; rewrite mul0mx.
exists K, 1%N, 1%N, 1%N, a, 1%N, 1%N, R, A, 0, B, (- B), [:: 1]; do 2 (split; first by []); move=> c; rewrite inE => /eqP ->.
rewrite !scale1r subrr /seen_rational big1 => [|k _]; first by rewrite /row_full mxrank0.
rewrite /seen_state big1 ?zero ?scaler0 // => i _; by rewrite zero mulmx0.
Qed.
