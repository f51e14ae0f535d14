(** What the theorems speak of. Signals and states are row vectors, so a matrix here is the transpose of the paper's:

        x(k+1) = x(k) A + v(k) F,      r(k) = x(k) C + v(k) G.

    Nothing is assumed: any field K, any n states, m faults, p outputs, zero included. README.md says what each word is in the paper. *)
From mathcomp Require Import all_ssreflect all_algebra.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Definitions.
Variables (K : fieldType) (n m p : nat).

Record system := System { sysA : 'M[K]_n; sysF : 'M[K]_(m, n); sysC : 'M[K]_(n, p); sysG : 'M[K]_(m, p) }.
Implicit Types (S : system) (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (r : nat -> 'rV[K]_p).

Fixpoint state S x v k := if k is j.+1 then state S x v j *m sysA S + v j *m sysF S else x.
Definition output S x v k := state S x v k *m sysC S + v k *m sysG S.

(** r(0), ..., r(s-1) are possible; r is possible for ever: the restricted behaviour B|_s and the output behaviour B. *)
Definition word S s r := exists x v, forall k, (k < s)%N -> r k = output S x v k.
Definition behavior S r := exists x v, forall k, r k = output S x v k.

(** Left-invertible is said of the paper's system, not of the matrices as they stand here: from rest, only v = 0 gives zero
    output; known from delay l on: v(0) = 0 follows from l + 1 zero samples. *)
Definition left_invertible S := forall v, (forall k, output S 0 v k = 0) -> forall k, v k = 0.
Definition inverts_with_delay S l := forall v, (forall k, (k <= l)%N -> output S 0 v k = 0) -> v 0%N = 0.

(** [O_s T_s]: its rows are the outputs r(0), ..., r(s-1) of unit initial states and of unit faults. pulse i: one
    fault at one time. Their blocks A^k C, G and F A^(k-i-1) C are told by blocks_of_window in Headlines.v. *)
Definition samples s r : 'rV[K]_(s * p) := mxvec (\matrix_(k < s) r k).
Definition pulse s (i : 'I_(s * m)) k : 'rV[K]_m := oapp (fun j => row j (vec_mx (delta_mx 0 i))) 0 (insub k : option 'I_s).
Definition O S s : 'M[K]_(n, s * p) := \matrix_i samples s (output S (row i 1%:M) (fun=> 0)).
Definition T S s : 'M[K]_(s * m, s * p) := \matrix_i samples s (output S 0 (pulse i)).
Definition window S s : 'M[K]_(n + s * m, s * p) := col_mx (O S s) (T S s).

(** States reachable at time k with zero output before: W_0 = K^n, W_(k+1) = { x A + v F : x in W_k, x C + v G = 0 }. *)
Definition silently_reaches S k y := exists x v, (forall j, (j < k)%N -> output S x v j = 0) /\ state S x v k = y.

(** P(q) = [qI - A, C; -F, G] and F (qI - A)^-1 C + G, both over the rational functions of q. *)
Definition pencil S : 'M[{poly K}]_(n + m, n + p) :=
  block_mx ('X%:M - map_mx polyC (sysA S)) (map_mx polyC (sysC S)) (- map_mx polyC (sysF S)) (map_mx polyC (sysG S)).
Definition over_fractions a b (M : 'M[{poly K}]_(a, b)) := map_mx (@FracField.tofrac _) M.
Definition transfer S : 'M[{fraction {poly K}}]_(m, p) :=
  over_fractions (map_mx polyC (sysF S)) *m invmx (over_fractions ('X%:M - map_mx polyC (sysA S)))
    *m over_fractions (map_mx polyC (sysC S)) + over_fractions (map_mx polyC (sysG S)).

End Definitions.

(** The same (A, C) with other fault matrices, and problem (11): z = (f, g) is a solution at s iff all block columns of T_s(z) lie in the
    column space of [O_s T_s]. *)
Definition with_faults K n m p m' (S : system K n m p) F G : system K n m' p := System (sysA S) F (sysC S) G.
Definition solves K n m p (S : system K n m p) s (f : 'rV[K]_n) (g : 'rV[K]_p) :=
  (T (with_faults S f g) s <= window S s)%MS.
