(** The examples of HeadlinesMeans.v: the mean in which there are white signals, and the example of section V.

                            example_v a == the example of section V, with F = (1, a, a^2)
                         example_root a == F is an eigenvector of A, of the eigenvalue a
                          block_sum f a == a is the sum of f over each late block, which are the times from i^2 to (i+1)^2
    rudin_shapiro, rudin_shapiro_turned == the sequence of Rudin and Shapiro, and the same with every second sign turned
                       white_source N t == N white signals made of it, that take turns *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice div fintype bigop zmodp ssralg matrix.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** A is the transpose of [0, 1, 0; 0, 0, 1; -1/4, 3/4, 1/4], C tells the first two states, F = (1, a, a^2), and G = 0. *)
Definition example_v (K : fieldType) (a : K) : system K 3 1 2 :=
  System (\matrix_(i, j) nth 0 (nth [::] [:: [:: 0; 0; - 1 / 4%:R]; [:: 1; 0; 3%:R / 4%:R]; [:: 0; 1; 1 / 4%:R]] i) j)
    (\row_j a ^+ j) (\matrix_(i, j) (i == j :> nat)%:R) 0.

(** F is an eigenvector of A, of the eigenvalue a. *)
Definition example_root (K : fieldType) (a : K) := 4%:R != 0 :> K /\ 4%:R * a ^+ 3 - a ^+ 2 - 3%:R * a + 1 = 0.

(** The mean a of f is its sum over block i, which are the times from i^2 to (i+1)^2: the same in all late blocks, and so where they are
    shifted. *)
Definition block_sum (K : ringType) (f : nat -> K) a :=
  forall J, exists M, forall i, (M <= i)%N -> \sum_(j < i.*2.+1) f (i * i + (J + j))%N = a.

(** The sequence of Rudin and Shapiro: -1 where the binary digits of t have an odd number of neighbouring ones, and 1 elsewhere; and the
    same with every second sign turned. *)
Definition rudin_shapiro (K : ringType) t : K := (-1) ^+ \sum_(i < t) (odd (t %/ 2 ^ i) && odd (t %/ 2 ^ i.+1)).
Definition rudin_shapiro_turned (K : ringType) t : K := (-1) ^+ t * rudin_shapiro K t.

(** N signals that are the sequence of Rudin and Shapiro in turn: signal i is 2N+1 times its value at the times i modulo (2N+1)^2, and
    zero at all others, so that at most one of them is not zero. *)
Definition white_source (K : ringType) N t : 'rV[K]_N :=
  \row_i (if (t %% (N.*2.+1 * N.*2.+1))%N == i then N.*2.+1%:R * rudin_shapiro K t else 0).
