(** v(t) = f(t+2) + f(t) for a white f: a coloured fault that is uncorrelated with the input. With past outputs among the instruments the
    limit, with a past sample and two future ones or more, leaves the range of O_s, for a white input and every stable system with one
    fault, F other than 0 and G = 0, whose states are measured; and for the input and the system of PartOfTheRange.v, where past inputs
    alone do not show all of the range either. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary LimitsVocabulary MeansVocabulary ExampleVocabulary Means MeanLimits LongPast.
From faultspace Require Import TimeAverages RudinShapiro Responses WhiteMeans PastOutputMeans PartOfTheRange OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Fault.
Variable K : realFieldType.
Hypothesis arch : archimedean K.
Let E := @time_average K.
Let isE : mean E := time_average_mean arch.
Let pos : positive E := @time_average_positive K.
Let f t : 'rV[K]_1 := (rudin_shapiro_turned K t)%:M.
Let v t : 'rV[K]_1 := f (t + 2)%N + f t.

Let f_white : white_noise E f. Proof. by have [] := shapiro_white arch. Qed.
Let ff k l : covariance E (later k f) (later l f) (k == l)%:R%:M := white_later isE k l f_white.

Let vv k l : covariance E (later k v) (later l v) ((k + 2 == l + 2)%N%:R + (k + 2 == l)%N%:R + ((k == l + 2)%N%:R + (k == l)%:R))%:M.
Proof.
have right j : covariance E (later j f) (later l v) ((j == l + 2)%N%:R + (j == l)%:R)%:M.
  rewrite raddfD; apply: (covariance_ext isE) (covariance_add isE (ff j (l + 2)) (ff j l)) => // t.
  by rewrite /later /v addnA.
have := covariance_transpose isE (covariance_add isE (covariance_transpose isE (right (k + 2)%N)) (covariance_transpose isE (right k))).
rewrite linearD /= !trmxK -raddfD; apply: (covariance_ext isE) => // t; by rewrite /later /v addnA.
Qed.

Let v_quasi : quasi_stationary E v.
Proof. by move=> l; eexists; apply: (covariance_ext isE) (vv 0 l) => // t; rewrite /later addn0. Qed.

Let v_far k l : (k + 2 < l)%N || (l + 2 < k)%N -> covariance E (later k v) (later l v) 0.
Proof.
move=> kl; have := vv k l; rewrite (_ : _ + _ = 0); first by rewrite raddf0.
by do !case: eqP => //= ?; rewrite ?addr0 //; lia.
Qed.
Let v_short h l : (2 < h)%N -> (h <= l)%N -> covariance E v (later l v) 0.
Proof. by move=> h2 hl; apply: (covariance_ext isE) (v_far (k := 0) (l := l) _) => [t|t|]; rewrite /later ?addn0 //; lia. Qed.
Let v_before l : (2 < l)%N -> covariance E (later l v) v 0.
Proof. by move=> l2; apply: (covariance_ext isE) (v_far (k := l) (l := 0) _) => [t|t|]; rewrite /later ?addn0 //; lia. Qed.
Let v_two : covariance E v (later 2 v) 1%:M.
Proof. by have := vv 0 2; rewrite /= !addr0 add0r; apply: (covariance_ext isE) => // t; rewrite /later addn0. Qed.

Let f_size t : size_of (f t) <= 1.
Proof. by rewrite /size_of big_ord1 mxE mulr1n /rudin_shapiro_turned normrM normr_sign shapiro_norm mulr1. Qed.
Let v_bounded t : size_of (v t) <= 1 + 1.
Proof. by apply: le_trans (size_add _ _) _; apply: lerD. Qed.

Let v_uncorrelated (e : nat -> 'rV[K]_1) : uncorrelated E e f -> uncorrelated E e v.
Proof.
move=> ef l; split; rewrite -[0]addr0.
  apply: (covariance_ext isE) (covariance_add isE (uncorrelated_at 0 (l + 2) isE ef) (uncorrelated_at 0 l isE ef)) => t.
    by rewrite /later addn0.
  by rewrite /later /v addnA.
apply: (covariance_ext isE) (covariance_add isE (uncorrelated_at l 2 isE ef) (uncorrelated_at l 0 isE ef)) => // t.
by rewrite /later /v addn0.
Qed.

(** In any such system the limit leaves the range. *)
Lemma leaves_range n nu (S : system K n 1 n) (B : 'M_(nu, n)) (D : 'M_(nu, n)) u x y q s L :
  process S B D u v x y -> stable (sysA S) -> uncorrelated E u v -> quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) ->
  sysC S = 1%:M -> sysG S = 0 -> sysF S != 0 -> (0 < q)%N -> (1 < s)%N ->
  limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L -> ~ (L <= O S s)%MS.
Proof.
move=> model st uv quasi all_states no_feedthrough F0 q0 s1 hL le.
have := coloured_seen isE pos model st uv quasi v_before v_two all_states no_feedthrough q0 s1 hL le.
rewrite mulmx1 => FF; case/negP: F0; apply/eqP/matrixP => i j; rewrite !ord1 mxE; apply/eqP.
by have /matrixP/(_ j j) := FF; rewrite !mxE big_ord1 mxE => /eqP; rewrite mulf_eq0 orbb.
Qed.

(** u white. *)
Let u t : 'rV[K]_1 := (rudin_shapiro K t)%:M.
Let u_white : white_noise E u. Proof. by have [] := shapiro_white arch. Qed.
Let uf : uncorrelated E u f. Proof. by have [] := shapiro_white arch. Qed.

Theorem coloured_fault n (S : system K n 1 n) (B : 'M_(1, n)) (D : 'M_(1, n)) x0 : stable (sysA S) -> sysC S = 1%:M -> sysG S = 0 ->
  sysF S != 0 -> exists x y, [/\ process S B D u v x y /\ x 0%N = x0, quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)),
    white_noise E u /\ uncorrelated E u v
  & forall q s, (0 < q)%N -> (1 < s)%N ->
    let converges L := limit E (fun t => row_mx (successive 0 q u t) (successive 0 q y t)) (successive q s u) (successive q s y) L in
    (exists L, converges L) /\ forall L, converges L -> ~ (L <= O S s)%MS].
Proof.
move=> st all_states no_feedthrough F0; pose w t : 'rV[K]_(1 + 1) := row_mx (u t) (v t).
pose x := state (with_faults S (col_mx B (sysF S)) (0 : 'M_(1 + 1, n))) x0 w.
have step t : x t.+1 = x t *m sysA S + w t *m col_mx B (sysF S) by [].
exists x, (fun t => x t *m sysC S + u t *m D + v t *m sysG S).
have model : process S B D u v x (fun t => x t *m sysC S + u t *m D + v t *m sysG S).
  by move=> t; split=> //; rewrite step mul_row_col addrA.
have uv := v_uncorrelated uf.
have vu l : covariance E v (later l u) 0 by have [_ h] := uv l; have := covariance_transpose isE h; rewrite trmx0.
have w_quasi : quasi_stationary E w.
  by move=> l; have [R hR] := v_quasi l; eexists; exact: (covariance_rows arch (u_white l) (proj1 (uv l)) (vu l) hR).
have w_short l : (3 <= l)%N -> covariance E w (later l w) 0.
  move=> l3; have ul : covariance E u (later l u) 0 by have := u_white l; case: l l3 {uv}.
  by have := covariance_rows arch ul (proj1 (uv l)) (vu l) (v_short (h := 3) isT l3); rewrite block_mx0.
have w_bounded t : size_of (w t) <= 1 + (1 + 1).
  have -> : size_of (w t) = size_of (u t) + size_of (v t).
    rewrite /size_of big_split_ord; congr (_ + _); apply: eq_bigr => i _; by rewrite ?row_mxEl ?row_mxEr.
  by apply: lerD => //; rewrite /size_of big_ord1 mxE mulr1n shapiro_norm.
have quasi := responses_quasi arch st step w_bounded w_quasi w_short.
split=> // q s q0 s1; split; first by apply: (past_outputs_limit_exists _ isE model quasi); apply: white_excites.
by move=> L; apply: (leaves_range model st uv quasi).
Qed.

Lemma fault_facts : [/\ quasi_stationary E v, forall l, (4 <= l)%N -> covariance E v (later l v) 0, forall t, size_of (v t) <= 1 + 1
  & uncorrelated E u v].
Proof. by split=> // [l|]; [exact: (v_short (h := 4))|exact: v_uncorrelated]. Qed.

End Fault.

(** Neither past outputs nor past inputs are right. *)
Theorem neither_right (K : rcfType) : archimedean K -> let E := @time_average K in
  let u t : 'rV[K]_1 := (rudin_shapiro K (t + 3))%:M - (rudin_shapiro K t)%:M in
  let v t : 'rV[K]_1 := (rudin_shapiro_turned K (t + 2))%:M + (rudin_shapiro_turned K t)%:M in
  exists (S : system K 2 1 2) (B : 'M_(1, 2)) x y, [/\ process S B 0 u v x y,
    [/\ quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)), uncorrelated E u v & stable (sysA S)],
    [/\ forall z, steered S B z, row_free (sysC S) & forall s, excites E s u],
    (exists L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L) /\
      forall L, limit E (successive 0 2 u) (successive 2 2 u) (successive 2 2 y) L -> ~ (O S 2 <= L)%MS
  & let converges L := limit E (fun t => row_mx (successive 0 2 u t) (successive 0 2 y t)) (successive 2 2 u) (successive 2 2 y) L in
    (exists L, converges L) /\ forall L, converges L -> ~ (L <= O S 2)%MS].
Proof.
move=> arch E u v; have [a [a01 root]] := pole_exists K; have [v_quasi v_short v_bounded ev] := fault_facts arch.
have [y [model [quasi uv st] [steer free excite] past_inputs]] := part_of_the_range arch a01 root ev v_quasi v_short v_bounded.
exists (System (a%:M + delta_mx 0 1) (delta_mx 0 0) 1%:M 0), (delta_mx 0 0); eexists; exists y.
split; [exact: model|by split|by split|exact: past_inputs|split].
  exact: (past_outputs_limit_exists _ (time_average_mean arch) model quasi).
move=> L; apply: (leaves_range arch model st uv quasi) => //=.
by apply/negP => /eqP/matrixP/(_ 0 0); rewrite !mxE eqxx => /eqP; rewrite oner_eq0.
Qed.
