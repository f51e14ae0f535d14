(** A fault that follows a white input, v(k) = u(k-1) Phi, given as w(k) Phi with w(k+1) = u(k). If the limit of PI-MOESP lies in the range
    of O_s all the same, with a past input and all states shown by s - 1 samples, s >= 1, then some d has d A = Phi F and d C = Phi G, and
    the fault acts as B + d would do without it: so B and D by output error are B + d and D, and right only if the fault is never seen.

    first_response S B Phi s == the first s samples of the response to a pulse of u before the window *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop finset order zmodp ssralg finalg ssrnum
  matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Places Signals Leads OutputError Undetectable.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.TTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Memory.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)) (Phi : 'M[K]_(nu, m)).
Notation Sw := (with_memory S Phi).
Notation Bw := (row_mx B (1%:M : 'M_nu)).
Let after := B *m sysA S + Phi *m sysF S.

Lemma memory_output_now (z : 'rV_n) (w : 'rV_nu) : output Sw (row_mx z w) (fun=> 0) 0 = z *m sysC S + w *m (Phi *m sysG S).
Proof. by rewrite /output /= mulmx0 addr0 mul_row_col. Qed.

Lemma memory_output_later (z : 'rV_n) (w : 'rV_nu) k :
  output Sw (row_mx z w) (fun=> 0) k.+1 = output S (z *m sysA S + w *m (Phi *m sysF S)) (fun=> 0) k.
Proof.
have states z' j : state Sw (row_mx z' 0) (fun=> 0) j = row_mx (state S z' (fun=> 0) j) 0.
  by elim: j => //= j ->; rewrite mulmx0 addr0 mul_row_block !mul0mx !addr0 !mulmx0 ?addr0.
rewrite output_step mul0mx addr0 [row_mx z w *m _]mul_row_block !mulmx0 addr0 /output states /=.
by rewrite mul_row_col mul0mx !mulmx0 !mul0mx !addr0.
Qed.

Lemma memory_power j : times_power Sw Bw j.+1 = row_mx (times_power S after j) 0.
Proof.
elim: j => [|j IH]; first by rewrite /= mul_row_block !mulmx0 addr0 mul1mx.
by rewrite -[LHS]/(times_power Sw Bw j.+1 *m sysA Sw) IH mul_row_block !mulmx0 !mul0mx !addr0.
Qed.

Lemma memory_O s a (z : 'M_(a, n)) : row_mx z 0 *m O Sw s = z *m O S s.
Proof.
apply/row_matrixP=> i; rewrite !row_mul row_row_mx row0 !mul_O; apply: samples_ext => -[|k] _.
  by rewrite memory_output_now mul0mx addr0 /output mul0mx addr0.
by rewrite memory_output_later mul0mx addr0 output_step mul0mx addr0.
Qed.

(** The first samples of the response to a pulse of u before the window. *)
Definition first_response s := Bw *m O Sw s.

Lemma first_responseE s i : row i (first_response s) =
  samples s (fun k => if k is j.+1 then output S (row i after) (fun=> 0) j else row i (B *m sysC S + Phi *m sysG S)).
Proof.
rewrite row_mul mul_O row_row_mx; apply: samples_ext => -[|k] _.
  by rewrite memory_output_now !rowE !mulmxDr !mulmxA mulmx1.
by rewrite memory_output_later !rowE !mulmxDr !mulmxA mulmx1.
Qed.

(** Containment in the range of O_s tells d. *)
Lemma contained_response s : (0 < s)%N -> row_free (O S s.-1) -> (first_response s <= O S s)%MS ->
  exists d, d *m sysA S = Phi *m sysF S /\ d *m sysC S = Phi *m sysG S.
Proof.
case: s => // s _ obs /submxP[X eX]; exists (X - B); rewrite !mulmxBl.
have out i k : (k < s.+1)%N -> (if k is j.+1 then output S (row i after) (fun=> 0) j else row i (B *m sysC S + Phi *m sysG S)) =
    output S (row i X) (fun=> 0) k.
  by move: k; apply: samples_inj; rewrite -first_responseE -mul_O -row_mul eX.
split; apply/eqP; rewrite subr_eq addrC eq_sym; apply/eqP/row_matrixP=> i; last first.
  by have := out i 0%N isT; rewrite /output mul0mx addr0 -row_mul.
apply: (row_free_inj obs); rewrite !mul_O; apply: samples_ext => k ks.
by rewrite (out i k.+1 ks) output_step mul0mx addr0 row_mul.
Qed.

(** Then the fault is hidden in B + d. *)
Lemma hidden_following_fault N (u w x : nat -> 'M[K]_(N, _)) y d : (forall k, w k.+1 = u k) ->
  d *m sysA S = Phi *m sysF S -> d *m sysC S = Phi *m sysG S -> process S B D u (fun k => w k *m Phi) x y ->
  process S (B + d) D u (fun=> 0) (fun k => x k + w k *m d) y.
Proof.
move=> wu dA dC model k; have [-> ->] := model k; rewrite wu !mul0mx !addr0 mulmxDr !mulmxDl -!mulmxA dA dC.
by split; [rewrite [RHS]addrA; congr (_ + _); apply: addrAC|apply: addrAC].
Qed.

End Memory.

Section White.
Variables (K : fieldType) (N n m p nu : nat) (Q : 'M[K]_N) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (Phi : 'M[K]_(nu, m)) (u w : nat -> 'M[K]_(N, nu)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)) (H : nat).
Hypotheses (model : process S B D u (fun k => w k *m Phi) x y) (wu : forall k, w k.+1 = u k) (u_white : white Q u H).
Hypothesis start : forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0.
Notation Sw := (with_memory S Phi).
Notation Bw := (row_mx B (1%:M : 'M_nu)).

Lemma memory_process : process Sw Bw D u (fun=> 0) (fun k => row_mx (x k) (w k)) y.
Proof. exact: past_fault wu model. Qed.

Lemma memory_start i : (0 <= i < H)%N -> cov Q (u i) (row_mx (x 0%N) (w 0%N)) = 0.
Proof. by case/andP=> _ /start[xi wi]; rewrite /cov mul_mx_row -/(cov Q (u i) _) -/(cov Q (u i) (w 0%N)) xi wi row_mx0. Qed.

Lemma no_leads : leads 0 (fun=> 0 : 'M[K]_(nu, m)) Q H u (fun=> 0).
Proof. by apply: uncorrelated_leads => i k _ _; apply: cov_zero. Qed.

(** The limit holds the response to each past input. *)
Theorem following_limit t q s L : (q <= t)%N -> (t + s <= H)%N ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L ->
  L = \sum_(j < q) (place K nu j)^T *m (times_power Sw Bw (q.-1 - j) *m O Sw s).
Proof.
move=> qt tH limit.
have -> := white_limit memory_process u_white no_leads memory_start qt _ limit; last by rewrite addn0.
by rewrite /reach_rows /seen_B big_ord0 addr0 mulmx_suml; apply: eq_bigr => j _; rewrite mulmxA.
Qed.

Lemma limit_holds_first_response t q s L : (0 < q <= t)%N -> (t + s <= H)%N ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (first_response S B Phi s <= L)%MS.
Proof.
case: q L => // q L /= qt tH /(following_limit qt tH) ->; apply/submxP; exists (place K nu (ord_max : 'I_q.+1)).
rewrite mulmx_sumr (bigD1 ord_max) //= big1 ?addr0 => [|j]; rewrite mulmxA place_orthonormal.
  by rewrite eqxx mul1mx subnn.
by rewrite -val_eqE eq_sym => /negbTE ->; rewrite mul0mx.
Qed.

Theorem following_fault_hidden t q s L : (0 < q <= t)%N -> (t + s <= H)%N -> (0 < s)%N -> row_free (O S s.-1) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L <= O S s)%MS ->
  exists d, [/\ d *m sysA S = Phi *m sysF S, d *m sysC S = Phi *m sysG S &
    process S (B + d) D u (fun=> 0 : 'M_(N, m)) (fun k => x k + w k *m d) y].
Proof.
move=> qt tH s0 obs limit sub; have first := limit_holds_first_response qt tH limit.
have [d [dA dC]] := contained_response s0 obs (submx_trans first sub).
exists d; split; [exact: dA|exact: dC|exact: (hidden_following_fault wu dA dC model)].
Qed.

End White.

(** Not both, under these conditions: range in that of O_s, and B, D right by output error, summed over several times. *)
Theorem not_both_in_sum (K : realFieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    (Phi : 'M_(nu, m)) (u w : nat -> 'M[K]_(N, nu)) x y H t q s L t' ks k :
  process S B D u (fun k => w k *m Phi) x y -> (forall k, w k.+1 = u k) -> white Q u H -> Q^T = Q ->
  (forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0) ->
  (0 < q <= t)%N -> (t + s <= H)%N -> (0 < s)%N -> row_free (O S s.-1) ->
  (forall j, j \in ks -> (t' + j < H)%N) -> k \in ks -> row_free (O S k) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L <= O S s)%MS ->
  (forall B' D', \sum_(j <- ks) mean_square Q S u y t' j B D <= \sum_(j <- ks) mean_square Q S u y t' j B' D') ->
  Phi *m sysF S = 0 /\ Phi *m sysG S = 0.
Proof.
move=> model wu u_white symmetric start qt tH s0 obs kH kks obs' limit sub least.
have [d [dA dC hidden]] := following_fault_hidden model wu u_white start qt tH s0 obs limit sub.
have past i : (0 <= i < H)%N -> cov Q (u i) (x 0%N + w 0%N *m d) = 0.
  by case/andP=> _ /start[xi wi]; rewrite cov_add cov_mul xi wi mul0mx addr0.
have v_leads : leads 0 (fun=> 0 : 'M[K]_(nu, m)) Q H u (fun=> 0) by apply: no_leads.
pose error j := mean_square Q S u y t' j.
have fit j : j \in ks -> error j (B + d) D <= error j B D /\
    (row_free (O S j) -> error j B D = error j (B + d) D -> B = B + d /\ D = D).
  move=> /kH jH; have [|] := least_squares hidden u_white v_leads past (t := t') (k := j) B D symmetric isT; first by rewrite addn0.
  by rewrite /seen_B /seen_D big_ord0 !addr0 big_ord0 !addr0.
have /eqP : \sum_(j <- ks) (error j B D - error j (B + d) D) = 0.
  apply/eqP; rewrite sumrB subr_eq0 eq_le least /= big_seq [leRHS]big_seq; apply: ler_sum => j /fit[le _]; exact: le.
rewrite big_seq psumr_eq0 => [/allP/(_ k kks)|j /fit[le _]]; last by rewrite subr_ge0.
rewrite kks subr_eq0 => /eqP e; have [/esym/eqP + _] := (fit k kks).2 obs' e.
by rewrite addrC -subr_eq0 addrK => /eqP d0; rewrite -dA -dC d0 !mul0mx.
Qed.

(** At one time alone. *)
Theorem not_both (K : realFieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p))
    (Phi : 'M_(nu, m)) (u w : nat -> 'M[K]_(N, nu)) x y H t q s L t' k :
  process S B D u (fun k => w k *m Phi) x y -> (forall k, w k.+1 = u k) -> white Q u H -> Q^T = Q ->
  (forall i, (i < H)%N -> cov Q (u i) (x 0%N) = 0 /\ cov Q (u i) (w 0%N) = 0) ->
  (0 < q <= t)%N -> (t + s <= H)%N -> (0 < s)%N -> row_free (O S s.-1) -> (t' + k < H)%N -> row_free (O S k) ->
  projected_limit Q (future (t - q) q u) (future t s u) (future t s y) L -> (L <= O S s)%MS ->
  (forall B' D', mean_square Q S u y t' k B D <= mean_square Q S u y t' k B' D') -> Phi *m sysF S = 0 /\ Phi *m sysG S = 0.
Proof.
move=> model wu u_white symmetric start qt tH s0 obs tkH obs' limit sub least.
apply: (not_both_in_sum (t' := t') (ks := [:: k]) model wu u_white symmetric start qt tH s0 obs _ (mem_head _ _) obs' limit sub).
  by move=> j; rewrite inE => /eqP ->.
by move=> B' D'; rewrite !big_seq1.
Qed.
