(** The words of the statements about limits that no other file has.

                 steered S B z == inputs through B lead from rest to the state z
                  similar S S' == the same (A, C) in another basis of the state
    autoregressive Q a A u e H == u is autoregressive of order a, with the innovations e, before H
            stationary Q x y H == the covariances of x and y before H depend on the difference of the times alone
      seen_state Q u t q s A B == the covariance of q past inputs with the state, s future ones projected away
           reciprocal_at r a A == a_0 A^r + a_1 A^(r-1) + ... + a_r: the reciprocal polynomial of a, at A
         seen_rational a R A B == for a stable A and inputs that satisfy the equation a: the covariance of q past inputs with the
                                  state, s future ones projected away, times reciprocal_at r a A *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Inputs through B lead from rest to the state z. (A, B) is controllable when they lead to every state. *)
Definition steered (K : fieldType) n m p nu (S : system K n m p) (B : 'M[K]_(nu, n)) (z : 'rV_n) :=
  exists k w, state (with_faults S B (0 : 'M_(nu, p))) 0 w k = z.

(** The same (A, C) in another basis of the state. *)
Definition similar (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) :=
  exists2 P, P \in unitmx & sysA S' = P *m sysA S *m invmx P /\ sysC S' = P *m sysC S.

(** u(k) = u(k-1) A_0 + ... + u(k-a) A_(a-1) + e(k) at the times a, ..., H - 1, where the innovation e(k) has an invertible covariance and
    knows nothing of earlier inputs. *)
Definition autoregressive (K : fieldType) N nu (Q : 'M[K]_N) a (A : nat -> 'M[K]_nu) (u e : nat -> 'M[K]_(N, nu)) H :=
  forall k, (a <= k < H)%N -> [/\ u k = \sum_(i < a) u (k - i.+1)%N *m A i + e k, cov Q (e k) (e k) \in unitmx &
    forall i, (i < k)%N -> cov Q (e k) (u i) = 0].

(** The covariances of x and y at the times before H depend on the difference of the times alone. *)
Definition stationary (K : fieldType) N a b (Q : 'M[K]_N) (x : nat -> 'M[K]_(N, a)) (y : nat -> 'M[K]_(N, b)) H :=
  forall i k, (i.+1 < H)%N -> (k.+1 < H)%N -> cov Q (x i.+1) (y k.+1) = cov Q (x i) (y k).

(** The covariance of the q past inputs with the state x(t), the s future inputs projected away, as u alone tells it: a polynomial in the
    entries of A and B. *)
Definition seen_state (K : fieldType) N n nu (Q : 'M[K]_N) (u : nat -> 'M[K]_(N, nu)) t q s (A : 'M_n) (B : 'M_(nu, n)) :=
  let Z := future (t - q) q u in let Uf := future t s u in
  \sum_(k < t) (cov Q Z (u k) - cov Q Z Uf *m invmx (cov Q Uf Uf) *m cov Q Uf (u k)) *m iter (t.-1 - k) (mulmxr A) B.

(** a_0 A^r + a_1 A^(r-1) + ... + a_r: the reciprocal polynomial of a_0 + ... + a_r z^r, at A. *)
Definition reciprocal_at (K : fieldType) n r (a : nat -> K) (A : 'M[K]_n) : 'M_n := \sum_(k < r.+1) a k *: iter (r - k) (mulmxr A) 1%:M.

(** R is the covariance of r + q + s successive inputs, of which the last s are the future ones and the q before them the past ones. The
    sum over k of seen_state for what the last q + k inputs before the present made of the state, times a_k A^(r-k): a polynomial in the
    entries of A and B. *)
Definition seen_rational (K : fieldType) n nu r (a : nat -> K) q s (R : 'M[K]_((r + q + s) * nu)) (A : 'M_n) (B : 'M_(nu, n)) :=
  let u k := if insub k is Some i then (place K nu (i : 'I_(r + q + s)))^T else 0 in
  \sum_(k < r.+1) a k *: iter (r - k) (mulmxr A) (seen_state R (fun i => u (r - k + i)%N) (q + k) q s A B).
