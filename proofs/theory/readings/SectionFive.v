(** The example of section V, over every field in which its eigenvalue lies. Two samples are free and the third satisfies an equation, so
    the gap is 2, 2, 1, 1, ...; the rest is what the theorems make of it. Only controllability depends on the eigenvalue. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop order zmodp ssralg finalg poly ssrnum
  matrix mxalgebra fraction zify.
From faultspace Require Import Vocabulary StructureVocabulary ExampleVocabulary Windows Gap Lag Inversion TransferRank Excitation
  SolutionCount.
From faultspace Require Import SmallSystems InputDelay Readings.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Example.
Variables (K : fieldType) (a : K).
Let S := example_v a.
Let o0 : 'I_3 := ord0.
Let o1 : 'I_3 := lift ord0 ord0.
Let o2 : 'I_3 := lift ord0 (lift ord0 ord0).

Lemma row3 (x y : 'rV[K]_3) : x 0 o0 = y 0 o0 -> x 0 o1 = y 0 o1 -> x 0 o2 = y 0 o2 -> x = y.
Proof.
move=> e0 e1 e2; apply/rowP => -[[|[|[|//]]] lt]; [move: e0|move: e1|move: e2].
all: by congr (_ = _); congr (fun_of_matrix _ _ _); apply: val_inj.
Qed.

Lemma output_example x v k : let z := state S x v k in
  output S x v k 0 ord0 = z 0 o0 /\ output S x v k 0 (lift ord0 ord0) = z 0 o1.
Proof.
move=> z; rewrite /output -/z mulmx0 addr0 /= !mxE !big_ord_recl !big_ord0 !mxE /=.
by rewrite !mulr0 !mulr1 !addr0 !add0r.
Qed.

Lemma state_example x v k : let z := state S x v k in let z' := state S x v k.+1 in
  [/\ z' 0 o0 = z 0 o1 + v k 0 0, z' 0 o1 = z 0 o2 + v k 0 0 * a
    & z' 0 o2 = z 0 o0 * (- 1 / 4%:R) + z 0 o1 * (3%:R / 4%:R) + z 0 o2 * (1 / 4%:R) + v k 0 0 * a ^+ 2].
Proof.
move=> z z'; rewrite /z' /= -/z; split; rewrite !mxE !big_ord_recl !big_ord0 !mxE /= ?expr0 ?expr1.
- by rewrite !mulr0 !mulr1 !addr0 add0r.
- by rewrite !mulr0 !mulr1 !addr0 !add0r.
by rewrite !addr0 !addrA.
Qed.

Lemma example_observable : observable S.
Proof.
apply: observable_from_zeros => x zero; have [h0 h1] := output_example x (fun=> 0) 0; have [h0' h1'] := output_example x (fun=> 0) 1.
have [_ e1 _] := state_example x (fun=> 0) 0; rewrite zero // mxE in h0; rewrite zero // mxE in h1.
rewrite zero // e1 !mxE mul0r addr0 in h1'.
by apply: row3; rewrite [RHS]mxE; [exact: esym h0|exact: esym h1|exact: esym h1'].
Qed.

Lemma example_delay : inverts_from_any_state S 1.
Proof.
move=> x v zero; have [_ h1] := output_example x v 0; have [h0' _] := output_example x v 1; have [e0 _ _] := state_example x v 0.
rewrite zero // mxE in h1; rewrite zero // mxE e0 -h1 add0r in h0'.
by apply/rowP => j; rewrite !ord1 [RHS]mxE.
Qed.

Lemma example_delay_known : inverts_with_delay S 1. Proof. by move=> v; apply: example_delay. Qed.

Lemma example_no_delay : ~ inverts_with_delay S 0.
Proof.
move=> h; have /rowP/(_ 0) : (fun=> 1%:M : 'M[K]_1) 0%N = 0.
  by apply: (h (fun=> 1%:M)) => k; rewrite leqn0 => /eqP->; rewrite /output /= mul0mx mulmx0 addr0.
by rewrite !mxE /= => /eqP; rewrite oner_eq0.
Qed.

Lemma example_left_invertible : left_invertible S. Proof. exact: delay_left_invertible example_delay_known. Qed.

(** Two samples are free. *)
Lemma example_two_samples r : word S 2 r.
Proof.
pose c := r 1%N 0 ord0 - r 0%N 0 (lift ord0 ord0).
pose x : 'rV[K]_3 := \row_i nth 0 [:: r 0%N 0 ord0; r 0%N 0 (lift ord0 ord0); r 1%N 0 (lift ord0 ord0) - c * a] i.
have row2 (y z : 'rV[K]_2) : y 0 ord0 = z 0 ord0 -> y 0 (lift ord0 ord0) = z 0 (lift ord0 ord0) -> y = z.
  move=> e0 e1; apply/rowP => j; have [->|-> //] : j = ord0 \/ j = lift ord0 ord0; last by [].
  by case: j => -[|[|//]] lt; [left|right]; apply: val_inj.
exists x, (fun=> c%:M) => -[_|[_|//]].
  by have [h0 h1] := output_example x (fun=> c%:M) 0; apply: row2; rewrite ?h0 ?h1 /= !mxE.
have [h0 h1] := output_example x (fun=> c%:M) 1; have [e0 e1 _] := state_example x (fun=> c%:M) 0.
apply: row2; [rewrite h0 e0|rewrite h1 e1]; rewrite /= !mxE /= mulr1n; last by rewrite subrK.
by rewrite /c addrC subrK.
Qed.

(** The third is not. *)
Lemma example_three_samples : ~ (forall r, word S 3 r).
Proof.
pose r k : 'rV[K]_2 := if k == 2%N then delta_mx 0 (lift ord0 ord0) else 0.
move=> /(_ r)[x [v e]]; have r0 k j : (k < 2)%N -> output S x v k 0 j = 0.
  by move=> k2; rewrite -e ?(leqW k2) // /r; case: k k2 => [|[|//]] _; rewrite mxE.
have [h0 h1] := output_example x v 0; have [h0' h1'] := output_example x v 1; have [h0'' h1''] := output_example x v 2.
have [e0 e1 e2] := state_example x v 0; have [f0 f1 _] := state_example x v 1.
have r2 : r 2%N 0 ord0 = 0 /\ r 2%N 0 (lift ord0 ord0) = 1 by rewrite /r !mxE.
rewrite r0 // in h0; rewrite r0 // in h1; rewrite r0 // in h0'; rewrite r0 // in h1'.
rewrite -e // r2.1 in h0''; rewrite -e // r2.2 in h1''.
rewrite -h1 add0r in e0; rewrite -h0 -h1 !mul0r !add0r in e2; rewrite -h0' in e0.
have v0 : v 0%N 0 0 = 0 by [].
rewrite v0 mul0r addr0 in e1; rewrite v0 mul0r addr0 in e2; rewrite -h1' in e1; rewrite -e1 mul0r in e2.
rewrite -h1' add0r in f0; rewrite -h0'' in f0; have v1 : v 1%N 0 0 = 0 by [].
by rewrite e2 v1 mul0r addr0 in f1; have /eqP := h1''; rewrite f1 oner_eq0.
Qed.

Lemma example_gaps : [/\ gap S 0 = 2, gap S 1 = 2, gap S 2 = 1 & gap S 3 = 1]%N.
Proof.
have w2 : \rank (window S 2) = 4%N by apply: full_window example_two_samples.
have w1 : \rank (window S 1) = 2%N.
  by apply: full_window => r; have [x [v e]] := example_two_samples r; exists x, v => k k1; apply: e; apply: leqW.
have w0 : \rank (window S 0) = 0%N by apply/eqP; rewrite -leqn0; apply: leq_trans (rank_leq_col _) _; rewrite mul0n.
have w3 : (\rank (window S 3) <= 5)%N.
  rewrite -ltnS ltn_neqAle (leq_trans (rank_leq_col _)) // andbT; apply/negP => full; apply: example_three_samples => r.
  by apply/windowP; apply: submx_full; rewrite /row_full (eqP full).
have g3 : gap S 3 = 1%N by rewrite -normal_rank; apply/left_invertible_transfer_rank/example_left_invertible.
have := gap_decreasing S (isT : (2 <= 3)%N); rewrite g3.
have := rank_window_step S 0; have := rank_window_step S 1; have := rank_window_step S 2; rewrite w0 w1 w2 => e2 e1 e0.
by split=> //; lia.
Qed.

Lemma example_etas : etas S = [:: 2%N].
Proof. by have [g0 g1 g2 g3] := example_gaps; rewrite /etas /= /gap_drop g0 g1 g2 g3. Qed.

Theorem example_windows s : \rank (window S s) = (s + minn s 2)%N.
Proof.
rewrite window_rank_by_indices example_etas big_seq1 (left_invertible_transfer_rank S).1 ?muln1 //.
exact: example_left_invertible.
Qed.

Theorem example_lag : lag S = 2%N.
Proof. by rewrite lag_is_largest_eta example_etas big_seq1. Qed.

Theorem example_solutions s k (Z : 'M[K]_(k, 3 + 2)) : spans_solutions S s Z -> ((2 < s)%N -> \rank Z = 2%N) /\ (s = 2%N -> \rank Z = 5%N).
Proof.
case: s => [|s] span; first by split.
have := solution_count span; rewrite example_etas big_cons big_nil => count; split=> [s2|[es]]; move: count.
  by rewrite ltnS in s2; rewrite s2; lia.
by rewrite es /= addn0.
Qed.

Theorem example_data x v N : row_full (excitation S x v N 6) ->
  \rank (hankel N 5 (output S x v)) = 7%N /\ \rank (hankel N 6 (output S x v)) = 8%N.
Proof. by move=> full; rewrite !rank_hankel ?example_windows //; apply: excitation_shorter. Qed.

Theorem example_zeros g d : gcd_of_minors (pencil S) g -> infinite_zeros S d -> (size g).-1 = 0%N /\ d = 1%N.
Proof.
move=> hg hd; have inv := example_left_invertible; have := dimension_by_zeros inv hg hd; rewrite example_etas /=.
have tells : exists l, inverts_from_any_state S l by exists 1%N; apply: example_delay.
have [_ ->] := (recovered_blindly_by_zeros hg).1 ((tells_some S).2 tells).
by rewrite (eqP example_observable); lia.
Qed.

Theorem example_zeros_and_delays g d : gcd_of_minors (pencil S) g -> infinite_zeros S d ->
  [/\ (size g).-1 = 0%N, d = 1%N, lag S = 2%N, inverts_with_delay S 1 /\ inverts_from_any_state S 1 & ~ inverts_with_delay S 0].
Proof.
move=> hg hd; have [n_f n_inf] := example_zeros hg hd; split=> //; [exact: example_lag| |exact: example_no_delay].
by split; [exact: example_delay_known|exact: example_delay].
Qed.

Theorem example_not_controllable : example_root a -> ~ fault_controllable S.
Proof.
move=> [four root]; have eigen : sysF S *m sysA S = a *: sysF S.
  apply: row3; rewrite !mxE !big_ord_recl !big_ord0 !mxE /= ?expr0 ?expr1 ?mulr0 ?mulr1 ?mul1r ?addr0 ?add0r //.
  rewrite -[bump 0 (bump 0 0)]/2%N; apply: (mulIf four); rewrite mulrDl [X in _ + X]mulrDl -[a * _ * 4%:R]mulrA !divfK //.
  apply/eqP; rewrite eq_sym -exprS [a ^+ 3 * _]mulrC -subr_eq0 -[X in _ == X]root [a * _]mulrC; apply/eqP.
  by rewrite !opprD opprK [- _ - _]addrC [1 + _]addrC !addrA.
move=> /(_ (delta_mx 0 (lift ord0 (lift ord0 ord0))))[k [v e]].
have [c ec] : exists c, state S 0 v k = c *: sysF S.
  elim: k {e} => [|k [c IH]]; first by exists 0; rewrite scale0r.
  exists (c * a + v k 0 0); rewrite /= IH -scalemxAl eigen scalerA scalerDl; congr (_ + _).
  by rewrite {1}[v k]mx11_scalar mul_scalar_mx.
have := congr1 (fun x : 'rV_3 => x 0 (lift ord0 (lift ord0 ord0))) e; have := congr1 (fun x : 'rV_3 => x 0 ord0) e.
rewrite ec !mxE /= expr0 mulr1 => c0; rewrite c0 mul0r => /eqP; by rewrite eq_sym oner_eq0.
Qed.

End Example.

(** 2 modulo 23; and from -1 to 0 the polynomial changes its sign. *)
Theorem example_roots : example_root (2%:R : 'F_23) /\ forall K : rcfType, exists a : K, example_root a.
Proof.
split; first by split; [|apply/eqP].
move=> K; pose f : {poly K} := 4%:R *: 'X^3 - 'X^2 - 3%:R *: 'X + 1.
have fE a : f.[a] = 4%:R * a ^+ 3 - a ^+ 2 - 3%:R * a + 1 by rewrite !hornerE.
have four : (4%:R : K) = 1 + 3%:R by rewrite -[1]/(1%:R) -natrD.
have at_m1 : f.[-1] = -1.
  by rewrite fE exprS sqrrN expr1n mulr1 !mulrN !mulr1 opprK four opprD [_ - 1 + _]addrAC !subrK.
have ivt : -1 <= 0 :> K -> f.[-1] <= 0 <= f.[0] -> exists2 a, -1 <= a <= 0 & root f a := @poly_ivt K f (- 1) 0.
have le1 : -1 <= 0 :> K by rewrite oppr_le0 ler01.
have le : f.[-1] <= 0 <= f.[0] by rewrite at_m1 fE !expr0n /= !mulr0 !subr0 add0r oppr_le0 ler01.
by have [a _ /rootP] := ivt le1 le; rewrite fE => root_a; exists a; split=> //; rewrite pnatr_eq0.
Qed.
