(** Words for the statements of HeadlinesStructure.v, beside those of Vocabulary.v.

                                  shifted N r t == (N(q) r)(t) = r(t) N_0 + r(t+1) N_1 + ...
                                   popov_form N == N is reduced, with monic pivots, and its columns are ordered
                                 popov_rows S N == N is in Popov form, and the behaviour of S is {r : N(q) r = 0}
                     inverts_from_any_state S l == from any state, l + 1 samples of zero output say that v(0) = 0
         output_nulling, largest_output_nulling == subspaces of states that can keep the output zero, and V*
    input_containing, smallest_input_containing == subspaces that no silent fault leaves, and S*
                    unobservable_dynamics S N M == the rows of N are a basis of the states that give no output, M moves them
                            reachability_of S k == [F, AF, ..., A^(k-1) F]
                        controllability_index S == the least k from which on its rank is what it is for n
                        unobservable_mode S f z == z is an eigenvalue of A that the output does not show
                                  zero_of S f z == the pencil loses rank at z *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice path div fintype tuple finfun bigop prime finset
  generic_quotient perm zmodp countalg ssralg finalg poly polydiv matrix mxalgebra mxpoly fraction.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** N(q) r: the sequence r(t) N_0 + r(t+1) N_1 + ...; a column of N is one difference equation. *)
Definition shifted (K : fieldType) p c (N : 'M[{poly K}]_(p, c)) (r : nat -> 'rV[K]_p) t : 'rV[K]_c :=
  \sum_(k < sizem N) r (t + k)%N *m map_mx (coefp k) N.

(** N is in Popov form. Column j has its pivot in row pivot j: this entry is monic, no entry of the column has a higher degree, and those
    below it have lower ones; so have, in its row, the entries of the other columns. The columns ascend by degree, and those of one degree
    by their pivots. (The size of a polynomial is one more than its degree, and 0 for the polynomial 0.) *)
Definition popov_form (K : fieldType) p d (N : 'M[{poly K}]_(p, d)) := exists pivot : 'I_d -> 'I_p,
  let pivot_size j := size (N (pivot j) j) in
  [/\ forall j, N (pivot j) j \is monic,
    forall i j, (size (N i j) <= pivot_size j)%N /\ ((pivot j < i)%N -> (size (N i j) < pivot_size j)%N),
    forall j k, j != k -> (size (N (pivot j) k) < pivot_size j)%N
    & forall j k : 'I_d, (j < k)%N -> (pivot_size j < pivot_size k)%N \/ pivot_size j = pivot_size k /\ (pivot j < pivot k)%N].

(** The columns of N are the Popov rows of the paper's N(q): N is in Popov form, and the behaviour is {r : N(q) r = 0}. *)
Definition popov_rows (K : fieldType) n m p (S : system K n m p) d (N : 'M[{poly K}]_(p, d)) :=
  popov_form N /\ forall r, behavior S r <-> forall t, shifted N r t = 0.

Section Subspaces.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).

(** From any state, l + 1 samples of zero output say that v(0) = 0: without the state, the faults are known from delay l on. *)
Definition inverts_from_any_state l := forall x v, (forall k, (k <= l)%N -> output S x v k = 0) -> v 0%N = 0.

(** From every state in X some fault gives zero output and leads into X. *)
Definition output_nulling k (X : 'M[K]_(k, n)) := forall x, (x <= X)%MS ->
  exists v : 'rV_m, x *m sysC S + v *m sysG S = 0 /\ ((x *m sysA S + v *m sysF S)%R <= X)%MS.
(** V*: output-nulling, and every other such subspace is inside. *)
Definition largest_output_nulling k (V : 'M[K]_(k, n)) :=
  output_nulling V /\ forall j (X : 'M_(j, n)), output_nulling X -> (X <= V)%MS.

(** Every fault that gives zero output leads from X into X. *)
Definition input_containing k (X : 'M[K]_(k, n)) := forall x (v : 'rV_m), (x <= X)%MS ->
  x *m sysC S + v *m sysG S = 0 -> ((x *m sysA S + v *m sysF S)%R <= X)%MS.
(** S*: input-containing, and inside every other such subspace. *)
Definition smallest_input_containing k (W : 'M[K]_(k, n)) :=
  input_containing W /\ forall j (X : 'M_(j, n)), input_containing X -> (W <= X)%MS.

(** The rows of N are a basis of the states that give no output; M moves them. *)
Definition unobservable_dynamics d (N : 'M[K]_(d, n)) (M : 'M[K]_d) :=
  [/\ row_free N, (N :=: kermx (O S n))%MS & N *m sysA S = M *m N].

(** [F, AF, ..., A^(k-1) F] of the paper, n x k m: its columns span the states that faults lead to from rest in k samples. *)
Definition reachability_of k : 'M[K]_(n, k * m) := stack k (fun j => (iter j (mulmxr (sysA S)) (sysF S))^T).
(** The least number of samples in which faults lead to all states that they lead to in n samples, and so in any number. *)
Definition controllability_index :=
  ex_minn (ex_intro (fun k => \rank (reachability_of k) == \rank (reachability_of n)) n (eqxx (\rank (reachability_of n)))).

Variables (L : fieldType) (f : {rmorphism K -> L}) (z : L).

(** z, in an extension of K by f, is an eigenvalue of A that the output does not show: Hautus' test. *)
Definition unobservable_mode := (\rank (row_mx (z%:M - map_mx f (sysA S)) (map_mx f (sysC S))) < n)%N.
(** The pencil loses rank at z. *)
Definition zero_of := (\rank (block_mx (z%:M - map_mx f (sysA S)) (map_mx f (sysC S)) (- map_mx f (sysF S)) (map_mx f (sysG S))) <
  n + \rank (transfer S))%N.

End Subspaces.
