(** Random signals for the consistency of subspace identification. A random row vector of q entries is written as a matrix N x q: each
    of its columns gives one entry as a combination of N basic random variables, whose covariances are an arbitrary N x N matrix Q. Any
    finite set of random variables can be written in this way, and with Q = 1/N the matrices may also be N samples of data, cov their
    sample covariance. So every identity here holds for finite data, for each sample size, and for the population limit. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Covariances.
Variables (K : fieldType) (N : nat) (Q : 'M[K]_N).

Lemma cov_add a b (x : 'M[K]_(N, a)) (y z : 'M[K]_(N, b)) : cov Q x (y + z) = cov Q x y + cov Q x z.
Proof. exact: mulmxDr. Qed.

Lemma cov_sub a b (x : 'M[K]_(N, a)) (y z : 'M[K]_(N, b)) : cov Q x (y - z) = cov Q x y - cov Q x z.
Proof. exact: mulmxBr. Qed.

Lemma cov_mul a b c (x : 'M[K]_(N, a)) (y : 'M[K]_(N, b)) (M : 'M_(b, c)) : cov Q x (y *m M) = cov Q x y *m M.
Proof. by rewrite /cov !mulmxA. Qed.

Lemma cov_zero a b (x : 'M[K]_(N, a)) : cov Q x (0 : 'M_(N, b)) = 0.
Proof. exact: mulmx0. Qed.

Lemma cov_sum a b (x : 'M[K]_(N, a)) I (t : seq I) (P : pred I) (y : I -> 'M[K]_(N, b)) :
  cov Q x (\sum_(i <- t | P i) y i) = \sum_(i <- t | P i) cov Q x (y i).
Proof. exact: mulmx_sumr. Qed.

Lemma cov_add_left a b (x y : 'M[K]_(N, a)) (z : 'M[K]_(N, b)) : cov Q (x + y) z = cov Q x z + cov Q y z.
Proof. by rewrite /cov linearD !mulmxDl. Qed.

Lemma cov_sub_left a b (x y : 'M[K]_(N, a)) (z : 'M[K]_(N, b)) : cov Q (x - y) z = cov Q x z - cov Q y z.
Proof. by rewrite /cov linearB !mulmxBl. Qed.

Lemma cov_mul_left a b c (x : 'M[K]_(N, a)) (y : 'M[K]_(N, b)) (M : 'M_(a, c)) : cov Q (x *m M) y = M^T *m cov Q x y.
Proof. by rewrite /cov trmx_mul !mulmxA. Qed.

Lemma cov_sum_left a b (z : 'M[K]_(N, b)) I (t : seq I) (P : pred I) (y : I -> 'M[K]_(N, a)) :
  cov Q (\sum_(i <- t | P i) y i) z = \sum_(i <- t | P i) cov Q (y i) z.
Proof. by rewrite /cov linear_sum !mulmx_suml. Qed.

Lemma cov_transpose a b (x : 'M[K]_(N, a)) (y : 'M[K]_(N, b)) : Q^T = Q -> (cov Q x y)^T = cov Q y x.
Proof. by move=> e; rewrite /cov !trmx_mul trmxK e mulmxA. Qed.

(** Where the future inputs have an invertible covariance, the projected limit exists and is unique. *)
Lemma projected_limit_exists z f g (Z : 'M_(N, z)) (Uf : 'M_(N, f)) (Yf : 'M_(N, g)) : cov Q Uf Uf \in unitmx ->
  projected_limit Q Z Uf Yf (cov Q Z Yf - cov Q Z Uf *m invmx (cov Q Uf Uf) *m cov Q Uf Yf).
Proof. by move=> unit; exists (cov Q Z Uf *m invmx (cov Q Uf Uf)); rewrite mulmxKV. Qed.

Lemma projected_limit_unique z f g (Z : 'M_(N, z)) (Uf : 'M_(N, f)) (Yf : 'M_(N, g)) L L' : cov Q Uf Uf \in unitmx ->
  projected_limit Q Z Uf Yf L -> projected_limit Q Z Uf Yf L' -> L = L'.
Proof.
move=> unit [X [hX ->]] [X' [hX' ->]]; suff -> : X = X' by [].
by rewrite -(mulmxK unit X) hX -hX' mulmxK.
Qed.

End Covariances.

Section Processes.
Variables (K : fieldType) (N n m p nu : nat) (S : system K n m p) (B : 'M[K]_(nu, n)) (D : 'M[K]_(nu, p)).
Variables (u : nat -> 'M[K]_(N, nu)) (v : nat -> 'M[K]_(N, m)) (x : nat -> 'M[K]_(N, n)) (y : nat -> 'M[K]_(N, p)).
Hypothesis model : process S B D u v x y.

(** Row by row, from any time on: the response to the state and the faults plus the response from rest to the input. *)
Lemma process_state i t k : row i (x (t + k)%N) =
  state S (row i (x t)) (fun j => row i (v (t + j)%N)) k + state (with_faults S B D) 0 (fun j => row i (u (t + j)%N)) k.
Proof.
elim: k => [|k IH]; first by rewrite addn0 addr0.
have [e _] := model (t + k)%N; rewrite addnS e !linearD /= !row_mul IH mulmxDl -!addrA; congr (_ + _).
by rewrite addrA addrC.
Qed.

Lemma process_output i t k : row i (y (t + k)%N) =
  output S (row i (x t)) (fun j => row i (v (t + j)%N)) k + output (with_faults S B D) 0 (fun j => row i (u (t + j)%N)) k.
Proof.
have [_ e] := model (t + k)%N; rewrite e !linearD /= !row_mul process_state mulmxDl /output /= -!addrA; congr (_ + _).
by rewrite addrA addrC.
Qed.

End Processes.
