(** Signals for a fault that follows a white input: those of any stable system. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From faultspace Require Import Vocabulary MeansVocabulary ExampleVocabulary Means Forgetting.
From faultspace Require Import TimeAverages Responses WhiteMeans OddPeriods MeanLimits OrderNames.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma stable_twice (K : realFieldType) n (A : 'M[K]_n) : stable A -> stable (block_mx A 0 0 A).
Proof.
move=> st eps eps0; have [k hk] := st eps eps0; exists k.
have -> : iter k (mulmxr (block_mx A 0 0 A)) 1%:M = block_mx (iter k (mulmxr A) 1%:M) 0 0 (iter k (mulmxr A) 1%:M).
  elim: (k) => [|l IH]; first by rewrite /= -scalar_mx_block.
  by rewrite !iterS IH /= mulmx_block !mulmx0 !mul0mx !addr0 !add0r.
move=> i j; case: (split_ordP i) => i' ->; case: (split_ordP j) => j' ->.
- by rewrite block_mxEul.
- by rewrite block_mxEur mxE normr0.
- by rewrite block_mxEdl mxE normr0.
by rewrite block_mxEdr.
Qed.

Section Following.
Variables (K : realFieldType) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) (Phi : 'M[K]_(nu, m)).
Hypotheses (arch : archimedean K) (st : stable (sysA S)).
Let E := @time_average K.
Let isE : mean E := time_average_mean arch.
Let u := @white_source K nu.
Let w t := if t is t'.+1 then u t' else 0.
Let u_white : white_noise E u := @source_white K nu arch.

Let earlier a b (f : nat -> 'rV[K]_a) (g : nat -> 'rV[K]_b) R : covariance E (later 1 f) (later 1 g) R -> covariance E f g R.
Proof. by move=> c i j; apply: (average_earlier arch); apply: (mean_ext isE) (c i j) => t; rewrite /later !addn1. Qed.
Let w_later t : later 1 w t = u t. Proof. by rewrite /later addn1. Qed.
Let shifted l t : u (t + l)%N = later 1 (later l w) t. Proof. by rewrite /later -addnA add1n addnS. Qed.
Let uw l : covariance E u (later l w) (1%N == l)%:R%:M.
Proof.
apply: earlier; apply: (covariance_ext isE) (white_later isE 1 l u_white) => // t; exact: shifted.
Qed.
Let wv l : covariance E w (later l u) (0%N == l.+1)%:R%:M.
Proof.
apply: earlier; apply: (covariance_ext isE) (white_later isE 0 l.+1 u_white) => t; first by rewrite w_later /later addn0.
by rewrite /later -addnA add1n.
Qed.
Let ww l : covariance E w (later l w) (0%N == l)%:R%:M.
Proof.
apply: earlier; apply: (covariance_ext isE) (white_later isE 0 l u_white) => t; first by rewrite w_later /later addn0.
exact: shifted.
Qed.
Let uu l : covariance E u (later l u) (0%N == l)%:R%:M.
Proof. by apply: (covariance_ext isE) (white_later isE 0 l u_white) => // t; rewrite /later addn0. Qed.

Let g t := row_mx (u t) (w t).
Let g_lag l := covariance_rows arch (uu l) (uw l) (wv l) (ww l).
Let g_quasi : quasi_stationary E g. Proof. by move=> l; eexists; exact: g_lag. Qed.
Let g_short l : (2 <= l)%N -> covariance E g (later l g) 0.
Proof. by move=> l2; have := g_lag l; case: l l2 => [|[|l]] // _; rewrite !raddf0 block_mx0. Qed.
Let b := nu.*2.+1%:R *+ nu : K.
Let g_bounded t : size_of (g t) <= b + b.
Proof.
have -> : size_of (g t) = size_of (u t) + size_of (w t).
  rewrite /size_of big_split_ord; congr (_ + _); apply: eq_bigr => i _; by rewrite ?row_mxEl ?row_mxEr.
apply: lerD; first exact: source_bounded.
case: t => [|t]; last exact: source_bounded.
have b0 : 0 <= b by apply: mulrn_wge0; apply: ler0n.
by rewrite /size_of big1 // => i _; rewrite mxE normr0.
Qed.

Theorem following_exist : exists x z y, [/\ process S B D u (fun t => w t *m Phi) x y, forall t, z t.+1 = z t *m sysA S + u t *m B,
  quasi_stationary E (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))), white_noise E u
  & forall q s, exists L, limit E (successive 0 q u) (successive q s u) (successive q s y) L].
Proof.
pose F := block_mx B B (Phi *m sysF S) 0; pose A2 := block_mx (sysA S) 0 0 (sysA S).
pose X := fix X k : 'rV[K]_(n + n) := if k is j.+1 then X j *m A2 + g j *m F else 0.
have step t : X t.+1 = X t *m A2 + g t *m F by [].
pose x t := lsubmx (X t); pose z t := rsubmx (X t).
have parts t : x t.+1 = x t *m sysA S + u t *m B + w t *m Phi *m sysF S /\ z t.+1 = z t *m sysA S + u t *m B.
  have := step t; rewrite -[X t.+1]hsubmxK -[X t]hsubmxK !mul_row_block !mulmx0 !addr0 add0r add_row_mx => /eq_row_mx[e1 e2].
  by rewrite /x /z e1 e2 mulmxA addrA.
exists x, z, (fun t => x t *m sysC S + u t *m D + w t *m Phi *m sysG S).
have model : process S B D u (fun t => w t *m Phi) x (fun t => x t *m sysC S + u t *m D + w t *m Phi *m sysG S).
  by move=> t; split=> //; have [] := parts t.
have quasi : quasi_stationary E (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))).
  move=> l; have [R hR] := responses_quasi arch (stable_twice st) step g_bounded g_quasi g_short l; exists R.
  by apply: (covariance_ext isE) hR => t; rewrite /later /x /z hsubmxK.
split=> // [t|q s]; first by have [] := parts t.
apply: (limit_exists _ isE model); last exact: white_excites.
have c : combination (fun t => row_mx (row_mx (u t) (w t)) (row_mx (x t) (z t))) (fun t => row_mx (row_mx (u t) (w t *m Phi)) (x t)).
  apply: combination_ext (combination_part _ (block_mx (block_mx 1%:M 0 0 Phi) 0 0 (col_mx 1%:M 0))) => t.
  by rewrite !mul_row_block mul_row_col !mulmx0 !mulmx1 ?addr0 ?add0r ?addr0.
by move=> l; apply: (combination_covariance isE quasi c (combination_later l c)).
Qed.

End Following.
