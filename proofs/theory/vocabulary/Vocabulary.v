(** What the theorems speak of: every word that the statements of Headlines.v and HeadlinesMore.v use, and field_of, stack and
    reachability, which other files use. The other files of headlines have vocabularies of their own beside this one. Who has read these
    files and the statements knows what is claimed; the other files prove it.

    Signals and states are row vectors, so a matrix here is the transpose of the paper's:

        x(k+1) = x(k) A + v(k) F,      r(k) = x(k) C + v(k) G.

    Nothing is assumed: any field K, any n states, m faults, p outputs, zero included. README.md says what the main ones are in the paper.

                                              field_of T == a type that MathComp knows as a field, as that field
                          system, sysA, sysF, sysC, sysG == a system with n states, m faults and p outputs: A, F, C, G
                                           state, output == x(k) and r(k) from an initial state under faults
                                          word, behavior == the sequences that are possible for s samples, and for ever
    left_invertible, inverts_with_delay, inverts_at_once == whether, and when, the output tells the faults
        silently_reaches, holds_zero, fault_controllable == which states faults can reach, and hold silent
                                  with_faults, faults_of == the same (A, C) with other faults: F and G, or the rows of [F G]
                               same_words, same_behavior == two systems have the same words of s samples; the same behaviour
                                   samples, stack, place == samples side by side, of one and of finitely many sequences; one sample
                                                            among s
                         pulse, O, T, window, observable == unit fault signals, O_s, T_s, [O_s T_s], and (A, C) observable
                    solves, spans_solutions, data_solves == problem (11), all its solutions, and the same with data
                                         reduced_echelon == in reduced row echelon form without zero rows
                                     silent_step, silent == one step with zero output, and W_k
             after_zeros, gap, lag, gap_drop, etas, zeta == how the rank of a window grows, the indices eta, and zeta = n - sum eta
                    hold_step, zero_holding, zero_states == V_k, V* and V* + W_n
                              pencil, pencil_at_infinity == P(q), and the same at 1/q
                                over_fractions, transfer == polynomial matrices over the rational functions, and the transfer matrix
                           divides_minors, gcd_of_minors == of the maximal minors: their greatest common divisor tells the finite zeros
         divides_minors_of_order, gcd_of_minors_of_order == of the minors of an order
                   infinite_zeros, system_infinite_zeros == how many zeros are infinite, of a left-invertible and of every system
                   sizem, degree, leading, minimal_basis == one more than the degree of a matrix; degrees of columns; a minimal basis
               hankel, excitation, persistently_exciting == R_s, [X V_s], and the excitation of data
                                            reachability == [F, AF, ..., A^(n-1) F]
                                              cov, white == covariances of random signals, and white ones
                                         process, future == the equations of the system for random signals, and s samples from t on
                                         projected_limit == what PI-MOESP and PO-MOESP converge to
                      times_power, leads, seen_B, seen_D == M A^k; a fault that leads the input; B and D with what it adds
                        impulse, prediction, mean_square == the impulse response, what a model predicts, and the mean square of its
                                                            error
                       leading_fault, variances, signals == what the example is made of
       MovingAverage, Q, half, us, vs, xs, u, v, x, y, S == the example *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp ssralg poly polydiv rat matrix mxalgebra fraction.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A type that MathComp knows as a field, as that field. *)
Notation field_of T := ltac:(let K := eval cbv beta iota delta [TheCanonical.get] in [the fieldType of T : Type] in exact K) (only parsing).

(** ** Systems and what they can do *)

Section Systems.
Variables (K : fieldType) (n m p : nat).

(** A system (A, F, C, G) with n states, m faults and p outputs. *)
Record system := System { sysA : 'M[K]_n; sysF : 'M[K]_(m, n); sysC : 'M[K]_(n, p); sysG : 'M[K]_(m, p) }.
Implicit Types (S : system) (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (r : nat -> 'rV[K]_p).

(** The state x(k) from x(0) = x under the faults v, and the output r(k). *)
Fixpoint state S x v k := if k is j.+1 then state S x v j *m sysA S + v j *m sysF S else x.
Definition output S x v k := state S x v k *m sysC S + v k *m sysG S.

(** r(0), ..., r(s-1) are possible: r is in the restricted behaviour B|_s. *)
Definition word S s r := exists x v, forall k, (k < s)%N -> r k = output S x v k.

(** r is possible for ever: r is in the output behaviour B. *)
Definition behavior S r := exists x v, forall k, r k = output S x v k.

(** From rest, only v = 0 gives zero output. This is said of the paper's system, not of the matrices as they stand here. *)
Definition left_invertible S := forall v, (forall k, output S 0 v k = 0) -> forall k, v k = 0.

(** From rest, l + 1 samples of zero output say that v(0) = 0: the faults are known from delay l on. *)
Definition inverts_with_delay S l := forall v, (forall k, (k <= l)%N -> output S 0 v k = 0) -> v 0%N = 0.

(** The first sample alone says so, whatever the initial state is: the best delay that there can be. *)
Definition inverts_at_once S := forall x v, output S x v 0 = 0 -> v 0%N = 0.

(** y is a state at time k after zero output at all times before; these states are W_0 = K^n,
    W_(k+1) = { x A + v F : x in W_k, x C + v G = 0 }. *)
Definition silently_reaches S k y := exists x v, (forall j, (j < k)%N -> output S x v j = 0) /\ state S x v k = y.

(** Some faults keep the output from the initial state x zero for k samples. *)
Definition holds_zero S k x := exists v, forall j, (j < k)%N -> output S x v j = 0.

(** Faults lead from rest to every state: (A, F) is controllable. *)
Definition fault_controllable S := forall y, exists k v, state S 0 v k = y.

End Systems.

(** The same (A, C) with other fault matrices, of any number of faults. *)
Definition with_faults K n m p m' (S : system K n m p) F G : system K n m' p := System (sysA S) F (sysC S) G.

(** Two systems with outputs of as many entries, whatever their states and faults are: the same words of s samples, and the same
    behaviour. *)
Definition same_words K n m n' m' p (S : system K n m p) (S' : system K n' m' p) s := forall r, word S s r <-> word S' s r.
Definition same_behavior K n m n' m' p (S : system K n m p) (S' : system K n' m' p) := forall r, behavior S r <-> behavior S' r.

(** ** Windows: O_s, T_s and [O_s T_s] *)

Section Windows.
Variables (K : fieldType) (n m p : nat).
Implicit Types (S : system K n m p) (r : nat -> 'rV[K]_p).

(** r(0), ..., r(s-1) side by side. *)
Definition samples s r : 'rV[K]_(s * p) := mxvec (\matrix_(k < s) r k).

(** The i-th unit fault signal of s samples: one fault at one time. *)
Definition pulse s (i : 'I_(s * m)) k : 'rV[K]_m := oapp (fun j => row j (vec_mx (delta_mx 0 i))) 0 (insub k : option 'I_s).

(** O_s and T_s: their rows are the outputs r(0), ..., r(s-1) of unit initial states, and of unit fault signals from rest. Their blocks
    A^k C, G and F A^(k-i-1) C are told by the headline blocks_of_window. *)
Definition O S s : 'M[K]_(n, s * p) := \matrix_i samples s (output S (row i 1%:M) (fun=> 0)).
Definition T S s : 'M[K]_(s * m, s * p) := \matrix_i samples s (output S 0 (pulse i)).

(** [O_s T_s]. *)
Definition window S s : 'M[K]_(n + s * m, s * p) := col_mx (O S s) (T S s).

(** O_n has full rank: (A, C) is observable. *)
Definition observable S := row_free (O S n).

End Windows.

(** Problem (11): z = (f, g) is a solution at s iff all block columns of T_s(z) lie in the column space of [O_s T_s]. *)
Definition solves K n m p (S : system K n m p) s (f : 'rV[K]_n) (g : 'rV[K]_p) :=
  (T (with_faults S f g) s <= window S s)%MS.

Section Solutions.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** (A, C) with the rows of Z = [F G] as its faults. *)
Definition faults_of k (Z : 'M[K]_(k, n + p)) := with_faults S (lsubmx Z) (rsubmx Z).

(** The rows of Z span the solutions of problem (11) at s. *)
Definition spans_solutions s k (Z : 'M[K]_(k, n + p)) := forall (f : 'rV_n) (g : 'rV_p), solves S s f g <-> (row_mx f g <= Z)%MS.

End Solutions.

(** R is in reduced row echelon form without zero rows: row i has its leading one in column pivot i, alone there, and the pivots
    ascend. *)
Definition reduced_echelon (K : fieldType) k N (R : 'M[K]_(k, N)) := exists pivot : 'I_k -> 'I_N,
  [/\ forall i j, R i (pivot j) = (i == j)%:R, forall i (l : 'I_N), (l < pivot i)%N -> R i l = 0
    & forall i j : 'I_k, (i < j)%N -> (pivot i < pivot j)%N].

(** ** How the rank of a window grows *)

Section Gap.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** { x A + v F : x in U, x C + v G = 0 }: one step with zero output from a state in the row space of U. *)
Definition silent_step (U : 'M[K]_n) : 'M[K]_n := <<kermx (col_mx (U *m sysC S) (sysG S)) *m col_mx (U *m sysA S) (sysF S)>>%MS.

(** W_k, the states that silently_reaches tells, as a row space. *)
Definition silent k := iter k silent_step 1%:M.

(** { x C + v G : x in W_s }: the values of r(s) that are possible after s zeros. *)
Definition after_zeros s : 'M[K]_(n + m, p) := col_mx (silent s *m sysC S) (sysG S).

(** Their dimension, which is how much the rank of [O_s T_s] grows from s to s + 1 samples (the headline gap_meaning). *)
Definition gap s := \rank (after_zeros s).

(** The lag: the least s with gap s = gap n, from which on the gap no longer changes (lag_meaning). *)
Definition lag := ex_minn (ex_intro (fun s => gap s == gap n) n (eqxx (gap n))).

(** By how much the gap falls on reaching s samples: from gap (s - 1) to gap s, and from p to gap 0. *)
Definition gap_drop s := ((if s is t.+1 then gap t else p) - gap s)%N.

(** The indices eta: each s as often as the gap falls there. They are the left minimal indices of the pencil (window_ranks_left_indices). *)
Definition etas := flatten [seq nseq (gap_drop s) s | s <- iota 0 n.+1].

(** zeta = n - sum eta: the number of zeros, finite and infinite, where the system is left-invertible (window_ranks_zeros), and in
    general that number and the sum of the right minimal indices (zeta_of_system). *)
Definition zeta := (n - sumn etas)%N.

(** { x : x A + v F in U and x C + v G = 0 for some v }: the states that hold the output at zero for one step into U. *)
Definition hold_step (U : 'M[K]_n) : 'M[K]_n :=
  <<lsubmx (kermx (block_mx (sysA S *m cokermx U) (sysC S) (sysF S *m cokermx U) (sysG S)))>>%MS.

(** V*: the states that can hold the output at zero, for n samples and so for ever. *)
Definition zero_holding : 'M[K]_n := iter n hold_step 1%:M.

(** V* + W_n, the zero states: the states u for which (u, 0) solves problem (11) at s > n. *)
Definition zero_states : 'M[K]_n := (silent n + zero_holding)%MS.

End Gap.

(** ** The pencil, the transfer matrix and their zeros *)

Section Pencil.
Variables (K : fieldType) (n m p : nat).
Implicit Types S : system K n m p.

(** P(q) = [qI - A, C; -F, G]. *)
Definition pencil S : 'M[{poly K}]_(n + m, n + p) :=
  block_mx ('X%:M - map_mx polyC (sysA S)) (map_mx polyC (sysC S)) (- map_mx polyC (sysF S)) (map_mx polyC (sysG S)).

(** The pencil at infinity: at 1/q, with its first n columns times q. *)
Definition pencil_at_infinity S : 'M[{poly K}]_(n + m, n + p) :=
  block_mx (1%:M - 'X *: map_mx polyC (sysA S)) (map_mx polyC (sysC S)) (- ('X *: map_mx polyC (sysF S))) (map_mx polyC (sysG S)).

(** A matrix of polynomials over the field of rational functions of q. *)
Definition over_fractions a b (M : 'M[{poly K}]_(a, b)) := map_mx (@FracField.tofrac _) M.

(** The transfer matrix F (qI - A)^-1 C + G, whose rank is the normal rank. *)
Definition transfer S : 'M[{fraction {poly K}}]_(m, p) :=
  over_fractions (map_mx polyC (sysF S)) *m invmx (over_fractions ('X%:M - map_mx polyC (sysA S)))
    *m over_fractions (map_mx polyC (sysC S)) + over_fractions (map_mx polyC (sysG S)).

End Pencil.

Section Minors.
Variables (K : fieldType) (a b : nat) (P : 'M[{poly K}]_(a, b)).

(** g divides all minors of P with as many rows as P has. *)
Definition divides_minors (g : {poly K}) := forall f : 'I_a -> 'I_b, g %| \det (colsub f P).

(** g is their greatest common divisor. Of the pencil of a left-invertible system its roots are the finite zeros, in extensions of the field
    too, and its degree is their number; it is 0 where the system is not left-invertible. *)
Definition gcd_of_minors g := divides_minors g /\ forall h, divides_minors h -> h %| g.

End Minors.

Section MinorsOfOrder.
Variables (K : fieldType) (N a b : nat) (P : 'M[{poly K}]_(a, b)).

(** The same with the minors of order N, for matrices that need not have full row rank. *)
Definition divides_minors_of_order (g : {poly K}) := forall (h : 'I_N -> 'I_a) (f : 'I_N -> 'I_b), g %| \det (mxsub h f P).
Definition gcd_of_minors_of_order g := divides_minors_of_order g /\ forall h, divides_minors_of_order h -> h %| g.

End MinorsOfOrder.

(** There are d infinite zeros: q^d is the highest power of q that divides the maximal minors of the pencil at infinity; and with the
    minors of order n + gap n, the normal rank of the pencil, for systems that are not left-invertible. *)
Definition infinite_zeros K n m p (S : system K n m p) d := forall e, divides_minors (pencil_at_infinity S) 'X^e <-> (e <= d)%N.
Definition system_infinite_zeros K n m p (S : system K n m p) d :=
  forall e, divides_minors_of_order (n + gap S n) (pencil_at_infinity S) 'X^e <-> (e <= d)%N.

(** One more than the highest degree of an entry; 0 for the zero matrix. *)
Definition sizem (K : fieldType) a b (M : 'M[{poly K}]_(a, b)) := \max_ij size (M ij.1 ij.2).

Section MinimalBases.
Variables (K : fieldType) (a b : nat) (M : 'M[{poly K}]_(a, b)).

(** The degree of column j of Y, and the coefficients of the columns of Y at their degrees. *)
Definition degree d (Y : 'M[{poly K}]_(b, d)) j := (sizem (col j Y)).-1.
Definition leading d (Y : 'M[{poly K}]_(b, d)) : 'M[K]_(b, d) := \matrix_(i, j) (Y i j)`_(degree Y j).

(** The columns of Y are a minimal basis of the right kernel of M: they generate its polynomial columns, and their leading coefficients
    are independent. Their degrees are the minimal (Kronecker) indices. *)
Definition minimal_basis d (Y : 'M[{poly K}]_(b, d)) := [/\ M *m Y = 0,
  forall y : 'cV_b, M *m y = 0 -> exists u, y = Y *m u & \rank (leading Y) = d].

End MinimalBases.

(** ** Data *)

Section Data.
Variables (K : fieldType) (n m p : nat).

(** R_s of N windows: row i is r(i), ..., r(i+s-1). *)
Definition hankel q N s (r : nat -> 'rV[K]_q) : 'M[K]_(N, s * q) := \matrix_(i < N) samples s (fun k => r (i + k)%N).

(** [X V_s]: row i is the state at time i and the faults from then on. *)
Definition excitation (S : system K n m p) x v N s : 'M[K]_(N, n + s * m) :=
  \matrix_(i < N) row_mx (state S x v i) (samples s (fun k => v (i + k)%N)).

(** v is persistently exciting of order s on N windows. *)
Definition persistently_exciting N s (v : nat -> 'rV[K]_m) := row_full (hankel N s v).

(** Problem (11) with R_s in the place of [O_s T_s]. *)
Definition data_solves (S : system K n m p) N s r (f : 'rV[K]_n) (g : 'rV[K]_p) :=
  (T (with_faults S f g) s <= hankel N s r)%MS.

End Data.

(** Finitely many sequences side by side, r k holding their samples k as rows. *)
Definition stack (K : fieldType) a p s (r : nat -> 'M[K]_(a, p)) : 'M[K]_(a, s * p) := \matrix_i samples s (fun k => row i (r k)).

(** [F, AF, ..., A^(n-1) F] of the paper, which is n x n m. *)
Definition reachability (K : fieldType) n m p (S : system K n m p) : 'M[K]_(n, n * m) :=
  stack n (fun k => (iter k (mulmxr (sysA S)) (sysF S))^T).

(** ** Random signals, and what identification converges to *)

(** A random row vector of q entries is a matrix N x q: each column gives one entry as a combination of N basic random variables, whose
    covariances are an arbitrary N x N matrix Q. With Q = 1/N the matrices may also be N samples of data, cov their sample covariance. *)
Section Signals.
Variables (K : fieldType) (N : nat).

(** Cov(x, y). *)
Definition cov (Q : 'M[K]_N) a b (x : 'M[K]_(N, a)) (y : 'M[K]_(N, b)) : 'M[K]_(a, b) := x^T *m Q *m y.

(** u is white at the times before H: u(0), ..., u(H-1) have unit covariance and are uncorrelated with each other. *)
Definition white Q nu (u : nat -> 'M[K]_(N, nu)) H :=
  forall i k, (i < H)%N -> (k < H)%N -> cov Q (u i) (u k) = if i == k then 1%:M else 0.

(** x(k+1) = x(k) A + u(k) B + v(k) F and y(k) = x(k) C + u(k) D + v(k) G as random signals. *)
Definition process n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) (u : nat -> 'M[K]_(N, nu))
    (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)) :=
  forall k, x k.+1 = x k *m sysA S + u k *m B + v k *m sysF S /\ y k = x k *m sysC S + u k *m D + v k *m sysG S.

(** The samples r(t), ..., r(t+s-1) side by side: the random row vector that a window of s samples is. *)
Definition future p t s (r : nat -> 'M[K]_(N, p)) : 'M[K]_(N, s * p) := \matrix_i samples s (fun k => row i (r (t + k)%N)).

(** The matrix that PI-MOESP (Z past inputs) and PO-MOESP (Z past inputs and outputs) converge to, transposed: the covariance of Z with
    Yf once Uf has been projected away. It is unique where Cov(Uf, Uf) is invertible. *)
Definition projected_limit Q z f g (Z : 'M_(N, z)) (Uf : 'M_(N, f)) (Yf : 'M_(N, g)) (L : 'M[K]_(z, g)) :=
  exists X, X *m cov Q Uf Uf = cov Q Z Uf /\ L = cov Q Z Yf - X *m cov Q Uf Yf.

End Signals.

(** The rows of the identity at time k among s times: w times place k is the signal that is w at time k and zero elsewhere. *)
Definition place (K : fieldType) p s (k : 'I_s) : 'M[K]_(p, s * p) := \matrix_i samples s (fun j => if j == k then row i 1%:M else 0).

Section Leads.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (J : nat) (Phi : nat -> 'M[K]_(nu, m)).

(** M A^k, with no condition on n. *)
Definition times_power a (M : 'M[K]_(a, n)) k : 'M[K]_(a, n) := iter k (mulmxr (sysA S)) M.

(** v(k) is correlated with u(k), ..., u(k+J-1) alone, among the inputs before H, as sum_(j<J) u(k+j) Phi_j is where u is white. For
    J = 0 the fault is uncorrelated with the input at all lags. *)
Definition leads N Q H (u : nat -> 'M[K]_(N, nu)) v :=
  forall i k, (i < H)%N -> (k + J <= H)%N -> cov Q (u i) (v k) = if (k <= i < k + J)%N then Phi (i - k)%N else 0.

(** B and D with what such a fault adds to the effect of the input: B + sum_j Phi_j F A^j and
    D + Phi_0 G + sum_(j >= 1) Phi_j F A^(j-1) C. *)
Definition seen_B (B : 'M_(nu, n)) := B + \sum_(j < J) times_power (Phi j *m sysF S) j.
Definition seen_D (D : 'M_(nu, p)) := D + (if J is _.+1 then Phi 0%N *m sysG S else 0)
  + \sum_(j < J.-1) times_power (Phi j.+1 *m sysF S) j *m sysC S.

End Leads.

Section Predictions.
Variables (K : fieldType) (n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).

(** The impulse response D, B C, B A C, ... *)
Definition impulse d : 'M_(nu, p) := if d is e.+1 then times_power S B e *m sysC S else D.

(** The output at time t + k of the model (A, B, C, D) from rest at time t. *)
Definition prediction N (u : nat -> 'M[K]_(N, nu)) t k := \sum_(i < k.+1) u (t + i)%N *m impulse (k - i).

End Predictions.

(** The mean square of its error. *)
Definition mean_square (K : fieldType) N n m p nu (Q : 'M[K]_N) (S : system K n m p) (u : nat -> 'M[K]_(N, nu))
    (y : nat -> 'M_(N, p)) t k B D :=
  let e := y (t + k)%N - prediction S B D u t k in \tr (cov Q e e).

(** ** One example over the rational numbers, of the headline proposition_1_coloured_a_c *)

(** u(k) = e(k) + e(k-1)/2, v(k) = e(k+1), A = 1/2, B = F = 1, C = [1 0], G = [0 1]. Signals are lists of their coefficients at seven
    uncorrelated variables: xi, e(-1), e(0), ..., e(4), where xi is what x(0) remembers of e(-2), e(-3), ...: xi = sum_j 2^-j e(-2-j), of
    variance 4/3, the others of variance 1. *)
Definition leading_fault (K : fieldType) (a : K) : system K 1 1 (1 + 1) := System a%:M 1%:M (row_mx 1%:M 0) (row_mx 0 1%:M).
Definition variances (K : fieldType) (variance : K) : 'M[K]_7 := diag_mx (\row_i nth 1 [:: variance] i).
Definition signals (K : fieldType) k (l : seq (seq K)) : 'M[K]_(7, k) := \matrix_(i, j) nth 0 (nth [::] l j) i.

Module MovingAverage.

(** The covariances of the seven variables. *)
Definition Q := variances (4%:R / 3%:R : rat).

(** u(k) = e(k) + e(k-1)/2 and v(k) = e(k+1) for k = 0, ..., 3. *)
Definition half : rat := 1 / 2%:R.
Definition us : seq (seq rat) := [:: [:: 0; half; 1]; [:: 0; 0; half; 1]; [:: 0; 0; 0; half; 1]; [:: 0; 0; 0; 0; half; 1]].
Definition vs : seq (seq rat) := [:: [:: 0; 0; 0; 1]; [:: 0; 0; 0; 0; 1]; [:: 0; 0; 0; 0; 0; 1]; [:: 0; 0; 0; 0; 0; 0; 1]].

(** x(0) = e(0) + 3/2 e(-1) + 5/4 xi, as if there had been no beginning, and x(k+1) = x(k)/2 + u(k) + v(k). *)
Fixpoint xs k : seq rat := if k is j.+1 then mkseq (fun i => nth 0 (xs j) i * half + nth 0 (nth [::] us j) i + nth 0 (nth [::] vs j) i) 7
  else [:: 5%:R / 4%:R; 3%:R / 2%:R; 1].

(** The same as random signals, the outputs, and the system. *)
Definition u k := signals 1 [:: nth [::] us k].
Definition v k := signals 1 [:: nth [::] vs k].
Definition x k := signals 1 [:: xs k].
Definition y k : 'M[rat]_(7, 1 + 1) := row_mx (x k) (v k).
Definition S := leading_fault half.

End MovingAverage.
