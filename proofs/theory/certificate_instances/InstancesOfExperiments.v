(** Instances for the headlines on stability and on experiments (HeadlinesExperiments.v), and for what polynomials in a root mean
    (algebraic_mean): over the rational numbers. The experiment is x(k+1) = x(k)/2 + u(k) + v(k), y = x, with u and v white. Its process
    begins at time 0 with the covariance that it keeps.

              rational, ratio == the rational numbers, as polynomials in the root 0 of q, and a / b as one
                      halving == the experiment
          one_root, two_roots == 2 q - 1, and 6 q^2 - q - 1, by their coefficients
              shown, relation == what shows a rank, and what the columns of limits on two samples satisfy
    inputs_shown, limit_shown == the ranks of the covariance of the inputs, and of the limit
     states_shown, both_shown == that of O_s, and of both
               process_exists == a process of an experiment without a filter, and the states of a model
              halving_process == that of this experiment
                ordered_field == the rational numbers as an ordered field, not to be computed with *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg ssrnum ssrint rat matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary CertificatesVocabulary NumbersVocabulary ExperimentsVocabulary FieldArithmetic Signals.
From faultspace Require Import ConsistencyExamples.
From faultspace Require Existence Leads.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Local Open Scope Z_scope.
Definition rational := algebraic [:: (0, 1); (1, 1)].
Definition ratio (a b : Z) : numeral rational := [:: (a, b)].
Definition halving := ExperimentList (Listing (R := rational) [:: [:: ratio 1 2]] [:: [:: ratio 1 1]] [:: [:: ratio 1 1]] [:: [:: [::]]])
  [:: [:: ratio 1 1]] [:: [:: [::]]] [:: [:: [:: ratio 1 1; [::]; [::]]; [:: [::]; ratio 1 1; [::]]]] [::].
Definition shown : Type := seq (nat * seq (numeral rational)) * seq (nat * seq (numeral rational)).
Definition relation : seq (nat * seq (numeral rational)) := [:: (3%N, [:: ratio (-2) 1; [::]; ratio (-1) 1; ratio 2 1])].
Definition inputs_shown : shown := ([::], [:: (0%N, [:: ratio 1 1]); (1%N, [:: [::]; ratio 1 1])]).
Definition limit_shown : shown :=
  (relation, [:: (0%N, [:: ratio 1 1]); (1%N, [:: [::]; ratio 1 1]); (2%N, [:: [::]; [::]; [::]; ratio 1 1])]).
Definition states_shown : shown :=
  (relation, [:: (0%N, [:: ratio 1 1]); (1%N, [:: [::]; ratio 1 1]); (2%N, [:: [::]; [::]; ratio 1 1])]).
Definition both_shown : shown :=
  (relation, [:: (0%N, [:: ratio 1 1]); (1%N, [:: [::]; ratio 1 1]); (2%N, [:: [::]; [::]; [::]; [::]; ratio 1 1])]).
Definition one_root := [:: 2; -1].
Definition two_roots := [:: 6; -1; -1].
Local Close Scope Z_scope.

(** ** Processes without a filter *)

Section Unfiltered.
Variables (K : fieldType) (n m p nu c : nat) (E : experiment K n m p nu c) (a d : K) (H : nat).
Hypotheses (H0 : (0 < H)%N) (unfiltered : memory E = 0%N) (scalar : sysA (plant E) = a%:M) (settled : d = a * a * d + 1).
Let inputs := lsubmx (forward E 0).
Hypothesis orthonormal : inputs^T *m inputs = 1%:M.

(** x, and z, which the model with B' has from the inputs, side by side. *)
Let faults := lsubmx (rsubmx (forward E 0)).
Let drive (B' : 'M_(nu, n)) : 'M_(c, n + n) := row_mx (inputs *m inputB E + faults *m sysF (plant E)) (inputs *m B').

Lemma process_exists (B' : 'M_(nu, n)) : exists N (Q : 'M[K]_N) e x st u y z, [/\ stationary_process E Q H e x st u y, white Q u H,
  model_states E Q e x st u B' z & cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N)].
Proof.
have [w ww] := white_exists K c H; pose W := drive B'; pose P := d *: (W^T *m W).
pose N := ((n + n) + H * c)%N; pose Q := block_mx P 0 0 1%:M : 'M[K]_N; pose e k : 'M[K]_(N, c) := col_mx 0 (w k).
pose g := fix g k : 'M[K]_(N, n + n) := if k is j.+1 then g j *m a%:M + e j *m W else col_mx 1%:M 0.
have blocks q r (x : 'M[K]_(n + n, q)) y (x' : 'M_(n + n, r)) y' :
    cov Q (col_mx x y) (col_mx x' y') = x^T *m P *m x' + cov 1%:M y y'.
  by rewrite /cov tr_col_mx mul_row_block !mulmx0 add0r addr0 mul_row_col.
have symmetric : Q^T = Q by rewrite tr_block_mx !trmx0 trmx1 /P linearZ /= trmx_mul trmxK.
have we : white Q e H by move=> i k iH kH; rewrite blocks trmx0 !mul0mx add0r ww.
have ge k : cov Q (g 0%N) (e k) = 0 by rewrite blocks mulmx0 add0r /cov trmx0 !mul0mx.
have eg k : cov Q (e k) (g 0%N) = 0 by rewrite -(cov_transpose (g 0%N) (e k) symmetric) ge trmx0.
have keeps : cov Q (g 1%N) (g 1%N) = cov Q (g 0%N) (g 0%N).
  have -> : cov Q (g 0%N) (g 0%N) = P by rewrite blocks cov_zero trmx1 mul1mx mulmx1 addr0.
  rewrite -[g 1%N]/(g 0%N *m a%:M + e 0%N *m W) cov_add !cov_add_left !cov_mul !cov_mul_left eg ge we // eqxx !(mul0mx, mulmx0).
  rewrite addr0 add0r blocks cov_zero trmx1 mul1mx mulmx1 addr0 mulmx1 tr_scalar_mx mul_mx_scalar mul_scalar_mx /P.
  by rewrite !scalerA ?mulrA -{2}[W^T *m W]scale1r -scalerDl -settled.
pose left : 'M[K]_(n + n, n) := col_mx 1%:M 0; pose right : 'M[K]_(n + n, n) := col_mx 0 1%:M.
pose x k := g k *m left; pose z k := g k *m right; pose st (k i : nat) : 'M[K]_(N, nu + (m + p)) := 0.
have step (M : 'M_(n + n, n)) k : g k.+1 *m M = g k *m M *m sysA (plant E) + e k *m (W *m M).
  by rewrite scalar mulmxDl -!mulmxA scalar_mxC.
pose f k := driving E (e k) (st k); pose u k := input_of (f k); pose y k := output_of E (e k) (x k) (st k).
have ef k : f k = e k *m forward E 0 by rewrite /f /driving add0r.
have eu k : u k = e k *m inputs by rewrite /u ef /input_of -mulmx_lsub.
have none i : (i < memory E)%N = false by rewrite unfiltered.
exists N, Q, e, x, st, u, y, z; split.
- split=> //; first (move=> k; split=> [//||i]; last by rewrite none).
    rewrite /x step mul_row_col mulmx1 mulmx0 addr0 mulmxDr addrA -/(f k) -/(u k) eu !mulmxA; congr (_ + _ *m _).
    by rewrite ef /fault_of -mulmx_rsub -mulmx_lsub.
  split=> [k _||i|i j]; try by rewrite none.
    split=> [|i]; last by rewrite none.
    by rewrite cov_mul_left ge mulmx0.
  by rewrite !cov_mul !cov_mul_left keeps.
- move=> i k iH kH; rewrite !eu cov_mul cov_mul_left we //; case: eqP => _; first by rewrite mulmx1.
  by rewrite mulmx0 mul0mx.
- split=> [k|||i]; last by rewrite none.
  + by rewrite /z step mul_row_col mulmx0 add0r mulmx1 eu !mulmxA.
  + by rewrite cov_mul_left ge mulmx0.
  + by rewrite !cov_mul !cov_mul_left keeps.
- by rewrite !cov_mul !cov_mul_left keeps.
Qed.
End Unfiltered.

(** ** Rational numbers, and the experiment *)

Section Rational.
Variable K : realFieldType.
Notation value := (value_at (0 : K) : numeral rational -> K).

Lemma ordered_faithful z : number K z = 0 -> z = Z0.
Proof. by move/eqP; rewrite intr_eq0 => /eqP e; rewrite -[z]int_of_ZK e. Qed.

Lemma rational_means : means value.
Proof. by apply: algebraic_mean ordered_faithful _; rewrite /= mul0r addr0 /fraction_in /= mul0r. Qed.

Lemma halving_process H : (0 < H)%N -> exists N (Q : 'M[K]_N) e x st u y z, let E := experiment_of value 1 1 1 1 2 halving in
  [/\ stationary_process E Q H e x st u y, white Q u H, model_states E Q e x st u 1%:M z & cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N)].
Proof.
move=> H0; apply: (process_exists (a := value (ratio 1 2)) (d := value (ratio 4 3))) => //.
- by apply/matrixP => i j; rewrite !ord1 !mxE eqxx mulr1n.
- rewrite -!(value_mult rational_means) -(value_one rational_means) -(value_plus rational_means).
  by congr (value_at _ _); vm_compute.
apply/matrixP => i j; rewrite !ord1 !mxE !big_ord_recl big_ord0 !mxE /=.
by have := value_one rational_means; rewrite /= => ->; rewrite !(mul0r, addr0, mulr1).
Qed.
End Rational.

Lemma ordered_field : exists K : realFieldType, True.
Proof. by exists [the realFieldType of rat : Type]. Qed.

(** a = 2/3 is the root of q - 2/3. *)
Theorem algebraic_mean_instance : exists (K : fieldType) f (a : K), (forall z, number K z = 0 -> z = Z0) /\ value_at a f = 0.
Proof.
have [K _] := ordered_field; exists K, [:: (Zneg 2, Zpos 3); (Zpos 1, Zpos 1)], (fraction_in K (Zpos 2, Zpos 3)).
split; first exact: ordered_faithful.
by rewrite /= mulr0 addr0 /fraction_in /= divr1 mulr1 mulNr addNr.
Qed.

(** ** Stability, and limits *)

(** The eigenvalues are 1/2 and -1/3. *)
Theorem field_schur_stable_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n (M : seq (seq (numeral R))) f,
  means value /\ is_stable n M f.
Proof.
have [K _] := ordered_field; exists rational, K, (value_at (0 : K)), 2%N, [:: [:: ratio 1 2; ratio 3 1]; [:: [::]; ratio (-1) 3]].
by exists two_roots; split; [exact: rational_means|vm_compute].
Qed.

Theorem field_moesp_limit_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p nu c past q s rl ro rj
    (E : experiment_list R) P f i1 i2 i3 i4,
  means value /\ is_limit n m p nu c past q s rl ro rj E P f i1 i2 i3 i4 /\
  exists N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q (past + s) e x st u y /\
    let Z := row_mx (future 0 past u) (future 0 q y) in let Uf := future past s u in let Yf := future past s y in
    exists L, projected_limit Q Z Uf Yf L.
Proof.
have [K _] := ordered_field; exists rational, K, (value_at (0 : K)), 1%N, 1%N, 1%N, 1%N, 2%N, 1%N, 1%N, 2%N, 1%N, 1%N, 1%N, halving.
exists [:: [:: ratio 8 3]], one_root, inputs_shown, limit_shown, states_shown, both_shown.
split; first exact: rational_means.
split; first by vm_compute.
have [//|N [Q [e [x [st [u [y [_ [process white_u _ _]]]]]]]]] := @halving_process K 3.
by exists N, Q, e, x, st, u, y; split; [exact: process|apply: Existence.limit_exists white_u _].
Qed.

Theorem field_input_limit_moesp_instance : exists (R : arithmetic) (K : realFieldType) (value : numeral R -> K) n m p nu c s
    (E : experiment_list R) B D P f R' X i1 i2,
  means value /\ is_regression n m p nu c s E B D P f R' X i1 i2 /\
  exists N (Q : 'M[K]_N) e x st u y, stationary_process (experiment_of value n m p nu c E) Q s e x st u y /\
    let Uf := future 0 s u in exists M, cov Q Uf Uf *m M = cov Q Uf (future 0 s y).
Proof.
have [K _] := ordered_field; exists rational, K, (value_at (0 : K)), 1%N, 1%N, 1%N, 1%N, 2%N, 2%N, halving.
exists [:: [:: ratio 1 1]], [:: [:: [::]]], [:: [:: ratio 8 3]], one_root, [:: [:: [::]; ratio 1 1]; [:: [::]; [::]]].
exists [:: [:: [::]]; [:: [::]]], inputs_shown, ([::], [:: (0%N, [:: ratio 1 1])]).
split; first exact: rational_means.
split; first by vm_compute.
have [//|N [Q [e [x [st [u [y [_ [process white_u _ _]]]]]]]]] := @halving_process K 2.
exists N, Q, e, x, st, u, y; split; first exact: process.
by exists (cov Q (future 0 2 u) (future 0 2 y)); rewrite (Leads.cov_future_white white_u) // mul1mx.
Qed.

(** Another model is that with twice the B. *)
Theorem field_input_limit_true_AC_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p nu c
    (E : experiment_list R) B D B' D' P f Sum,
  means value /\ is_output_error n m p nu c E B D B' D' P f Sum /\
  exists N (Q : 'M[K]_N) e x st u y, let E0 := experiment_of value n m p nu c E in stationary_process E0 Q 1 e x st u y /\
    exists z z1 B1, model_states E0 Q e x st u (matrix_of value nu n B) z /\ model_states E0 Q e x st u B1 z1 /\
      cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N) /\ cov Q (z1 1%N) (z 1%N) = cov Q (z1 0%N) (z 0%N).
Proof.
have [K _] := ordered_field; exists rational, K, (value_at (0 : K)), 1%N, 1%N, 1%N, 1%N, 2%N, halving.
exists [:: [:: ratio 1 1]], [:: [:: [::]]], [:: [:: [::]]], [:: [:: [::]]], [:: [:: ratio 4 3]], one_root, [:: [:: ratio 4 3]].
split; first exact: rational_means.
split; first by vm_compute.
have [//|N [Q [e [x [st [u [y [z [process _ [next start crossed filtered] keeps]]]]]]]]] := @halving_process K 1.
exists N, Q, e, x, st, u, y; split; first exact: process.
have one_B : matrix_of (value_at (0 : K) : numeral rational -> K) 1 1 [:: [:: ratio 1 1]] = 1%:M.
  by apply/matrixP => i j; rewrite !ord1 !mxE; apply: (value_one (rational_means K)).
exists z, (fun k => z k *m 2%:R%:M), (2%:R%:M); rewrite one_B; split=> //; split; last by rewrite !cov_mul_left keeps.
split=> [k|||//]; [|by rewrite cov_mul_left start mulmx0|by rewrite !cov_mul_left crossed].
by rewrite next mulmxDl -!mulmxA mul1mx scalar_mxC.
Qed.
