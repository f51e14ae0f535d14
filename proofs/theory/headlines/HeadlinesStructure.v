(** The fourth part of Headlines.v, which includes it: what ties the words of the ledger to the objects of the field. The behaviour as a
    kernel, the zero states as V* + S*, columns of pairs with another (A, C), zeros with multiplicities, pairs that tell the same signal.
    Words are told in Vocabulary.v and StructureVocabulary.v. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg poly polydiv matrix
  mxalgebra mxpoly fraction.
From faultspace Require Import Vocabulary StructureVocabulary.
From faultspace Require KernelRepresentation ChangeOfState ExtremalSubspaces UnobservableZeros ZeroFeedthroughSignal SharpPartner.
From faultspace Require ZeroAssignmentPairs Delay InputDelay DelaySharp ControlDelay PopovForm.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** ** The behaviour as a kernel, {r : N(q) r = 0} *)

(** N is made of the last p rows of a minimal basis of the kernel of the pencil (which zeros_exist provides): p - r difference equations, of
    the degrees that window_ranks_left_indices tells; and every equation that holds on the behaviour is a combination of them. *)
Theorem behavior_is_kernel (K : fieldType) n m p (S : system K n m p) d (Y : 'M_(n + p, d)) : minimal_basis (pencil S) Y ->
  [/\ d = (p - \rank (transfer S))%N, forall r, behavior S r <-> forall t, shifted (dsubmx Y) r t = 0
    & forall c : 'cV_p, (forall r, behavior S r -> forall t, shifted c r t = 0) <-> exists u, c = dsubmx Y *m u].
Proof. exact: KernelRepresentation.minimal_kernel_representation. Qed.

(** ** canonical-form *)

(** popov-rows: whatever (A, C), n and m, the behaviours are equal iff the Popov rows of N(q) are; and every system has them. *)
Theorem canonical_form_popov_rows (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) d d'
    (N : 'M_(p, d)) (N' : 'M_(p, d')) :
  popov_rows S N -> popov_rows S' N' -> (exists e : d = d', castmx (erefl, e) N = N') <-> same_behavior S S'.
Proof. exact: PopovForm.popov_rows_name. Qed.
Theorem canonical_form_popov_rows_exist (K : fieldType) n m p (S : system K n m p) : exists d (N : 'M_(p, d)), popov_rows S N.
Proof. exact: PopovForm.popov_rows_exist. Qed.

(** N is made of the last p rows of a minimal basis Y, of the same degrees, and so behavior_is_kernel and window_ranks_left_indices tell how
    many Popov rows there are, that they generate all equations, and their degrees. *)
Theorem canonical_form_popov_rows_minimal (K : fieldType) n m p (S : system K n m p) d (N : 'M_(p, d)) : popov_rows S N ->
  exists Y, [/\ minimal_basis (pencil S) Y, dsubmx Y = N & forall j, degree Y j = degree N j].
Proof. exact: PopovForm.popov_rows_minimal. Qed.

(** ** theorem-3-i, without the same (A, C) *)

(** The same behaviour and as many states: in other coordinates x T of the state, S' has its columns in Z, on every window. *)
Theorem columns_after_change_of_state (K : fieldType) n m m' p (S : system K n m p) (S' : system K n m' p) :
  same_behavior S S' -> exists T, [/\ T \in unitmx,
    same_behavior (System (invmx T *m sysA S' *m T) (sysF S' *m T) (invmx T *m sysC S') (sysG S')) S
  & forall s i, solves S s (row i (sysF S' *m T)) (row i (sysG S'))].
Proof. exact: ChangeOfState.columns_after_change_of_state. Qed.

(** Another number of states: a linear map of the states does it. *)
Theorem columns_after_map_of_state (K : fieldType) n m n' m' p (S : system K n m p) (S' : system K n' m' p) :
  same_behavior S S' -> exists T : 'M_(n', n), forall s i, solves S s (row i (sysF S' *m T)) (row i (sysG S')).
Proof. exact: ChangeOfState.columns_after_map_of_state. Qed.

(** ** Zero states *)

(** The zero states of solutions_closed_form are V* + S*, and zeta is their dimension, for every system. *)
Theorem zero_states_subspaces (K : fieldType) n m p (S : system K n m p) a b (V : 'M_(a, n)) (W : 'M_(b, n)) :
  largest_output_nulling S V -> smallest_input_containing S W ->
  (zero_states S :=: V + W)%MS /\ zeta S = \rank (V + W)%MS.
Proof. exact: ExtremalSubspaces.zero_states_extremal. Qed.
Theorem zero_subspaces_exist (K : fieldType) n m p (S : system K n m p) :
  exists V W : 'M_n, largest_output_nulling S V /\ smallest_input_containing S W.
Proof. exact: ExtremalSubspaces.extremal_subspaces_exist. Qed.

(** Left-invertible: the sum is direct, V* counts the finite zeros and S* the infinite ones. *)
Theorem zero_states_direct (K : fieldType) n m p (S : system K n m p) a b (V : 'M_(a, n)) (W : 'M_(b, n)) g d :
  largest_output_nulling S V -> smallest_input_containing S W ->
  left_invertible S -> gcd_of_minors (pencil S) g -> infinite_zeros S d ->
  [/\ (V :&: W)%MS = 0, zeta S = (\rank V + \rank W)%N, (size g).-1 = \rank V & d = \rank W].
Proof. move=> largest smallest; exact: (ExtremalSubspaces.zero_states_direct largest smallest). Qed.

(** ** trajectory-recovered *)

(** no-finite-zeros, with multiplicities: up to a constant, the zero polynomial is the characteristic polynomial of the unobservable part *)
Theorem trajectory_zero_polynomial (K : fieldType) n m p (S : system K n m p) d (N : 'M_(d, n)) M g :
  unobservable_dynamics S N M -> gcd_of_minors (pencil S) g ->
  (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k) <-> left_invertible S /\ g %= char_poly M.
Proof. exact: UnobservableZeros.recovered_blindly_by_polynomials. Qed.
Theorem unobservable_dynamics_exist (K : fieldType) n m p (S : system K n m p) :
  exists d (N : 'M_(d, n)) M, unobservable_dynamics S N M.
Proof. exact: UnobservableZeros.unobservable_dynamics_exist. Qed.

(** Without multiplicities, refuted twice: every finite zero is an unobservable mode, and yet v is not determined. x1(k+1) = 0,
    x2(k+1) = x2(k) + v(k), r = x2 + v. And x1(k+1) = x2(k+1) = 0, x3(k+1) = x2(k) + v(k), r = x3. *)
Theorem trajectory_multiplicity (K : fieldType) :
  let S : system K (1 + 1) 1 1 := System (block_mx 0 0 0 1%:M) (row_mx 0 1%:M) (col_mx 0 1%:M) 1%:M in
  [/\ left_invertible S, forall (L : fieldType) (f : {rmorphism K -> L}) z, zero_of S f z -> unobservable_mode S f z
    & ~ (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k)].
Proof. exact: UnobservableZeros.twice_zero_not_recovered. Qed.
Theorem trajectory_multiplicity_delayed (K : fieldType) :
  let S : system K (1 + (1 + 1)) 1 1 :=
    System (block_mx 0 0 0 (block_mx 0 1%:M 0 0)) (row_mx 0 (row_mx 0 1%:M)) (col_mx 0 (col_mx 0 1%:M)) 0 in
  [/\ left_invertible S, forall (L : fieldType) (f : {rmorphism K -> L}) z, zero_of S f z -> unobservable_mode S f z
    & ~ (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k)].
Proof. exact: UnobservableZeros.twice_zero_delayed_not_recovered. Qed.

(** state-known: the delay is the largest order of an infinite zero, where rank T_(k+1) - rank T_k counts the orders <= k. They sum to d,
    the number of infinite zeros of the pencil, since rank T_s = s m - d from s = n on. *)
Theorem trajectory_delay (K : fieldType) n m p (S : system K n m p) l :
  inverts_with_delay S l <-> \rank (T S l.+1) = (\rank (T S l) + m)%N.
Proof. exact: Delay.delay_by_ranks. Qed.
Theorem infinite_zeros_by_ranks (K : fieldType) n m p (S : system K n m p) d s :
  left_invertible S -> infinite_zeros S d -> (n <= s)%N -> (\rank (T S s) + d)%N = (s * m)%N.
Proof. exact: Delay.infinite_zeros_by_ranks. Qed.

(** state-known, from below: c + d <= l + rank [F, AF, ..., A^(n-1) F], c the controllability index and d the number of infinite zeros *)
Theorem delay_by_controllability (K : fieldType) n m p (S : system K n m p) l d :
  inverts_with_delay S l -> infinite_zeros S d -> (controllability_index S + d <= l + \rank (reachability S))%N.
Proof. exact: ControlDelay.delay_by_controllability. Qed.

(** state-unknown: some delay serves exactly when the output determines the faults; every longer one serves, too; and so do these two,
    the rank of [A F] and m + n - rank C *)
Theorem delay_any_state_exists (K : fieldType) n m p (S : system K n m p) :
  (forall x y v w, (forall k, output S x v k = output S y w k) -> forall k, v k = w k) <-> exists l, inverts_from_any_state S l.
Proof. exact: InputDelay.tells_some. Qed.
Theorem delay_any_state_longer (K : fieldType) n m p (S : system K n m p) l k :
  (l <= k)%N -> inverts_from_any_state S l -> inverts_from_any_state S k.
Proof. exact: InputDelay.tells_longer. Qed.
Theorem delay_by_the_range (K : fieldType) n m p (S : system K n m p) :
  (exists l, inverts_from_any_state S l) -> inverts_from_any_state S (\rank (col_mx (sysA S) (sysF S))).
Proof. exact: InputDelay.delay_within_range. Qed.
Theorem delay_by_outputs (K : fieldType) n m p (S : system K n m p) :
  (exists l, inverts_from_any_state S l) -> inverts_from_any_state S (m + n - \rank (sysC S)).
Proof. exact: InputDelay.delay_within_outputs. Qed.

(** Both are n + 1 for some system of n + 1 states, for which n is too little. *)
Theorem delay_bounds_attained (K : fieldType) n : exists S : system K n.+1 1 1,
  [/\ \rank (col_mx (sysA S) (sysF S)) = n.+1, (1 + n.+1 - \rank (sysC S))%N = n.+1, inverts_from_any_state S n.+1
    & ~ inverts_from_any_state S n].
Proof. exact: DelaySharp.delay_bounds_attained. Qed.

(** zero-feedthrough-signal: all equivalent pairs (F', 0) of m faults tell the same v, up to one basis for each pair, just when C F has
    rank m and the finite zeros, with multiplicities, are the unobservable modes. *)
Theorem zero_feedthrough_signal (K : fieldType) n m p (S : system K n m p) g :
  sysG S = 0 -> left_invertible S -> gcd_of_minors (pencil S) g ->
  (forall F' : 'M_(m, n), let S' := with_faults S F' (0 : 'M_(m, p)) in same_behavior S' S ->
    exists2 Q, Q \in unitmx & forall x v y w, (forall k, output S x v k = output S' y w k) -> forall k, v k = w k *m Q) <->
  \rank (sysF S *m sysC S) = m /\ (size g).-1 = (n - \rank (O S n))%N.
Proof. move=> G0 inv; exact: (ZeroFeedthroughSignal.zero_feedthrough_signal G0 inv). Qed.

(** ** sharp-windows *)

(** equality: the partner of sharp_equality may need a larger lag. x1(k+1) = x2(k), x2(k+1) = v(k), x3(k+1) = 0, r = (x1, x3): no other
    behaviour of one fault with this (A, C) is left-invertible and of lag 1. *)
Theorem sharp_equality_lag (K : fieldType) : let S : system K (1 + 1 + 1) 1 (1 + 1) :=
    System (block_mx (block_mx 0 0 1%:M 0) 0 0 0) (row_mx (row_mx 0 1%:M) 0) (block_mx (col_mx 1%:M 0) 0 0 1%:M) 0 in
  [/\ left_invertible S, lag S = 1%N & forall F G, let S' := with_faults S F G : system K (1 + 1 + 1) 1 (1 + 1) in
    left_invertible S' -> (lag S' <= lag S)%N -> same_behavior S' S].
Proof. exact: SharpPartner.no_partner_keeps_the_lag. Qed.

(** ** zero-assignment *)

(** every-polynomial: nonzero, as the zero polynomial of a pair of r faults is; (A, C) observable *)
Theorem zero_assignment_observable (K : fieldType) n m p (S : system K n m p) (g : {poly K}) : let r := \rank (transfer S) in
  observable S -> (0 < r)%N -> g != 0 ->
  (exists (F : 'M_(r, n)) (G : 'M_(r, p)), same_behavior (with_faults S F G) S /\
    gcd_of_minors (pencil (with_faults S F G)) g) <-> (size g <= (zeta S).+1)%N.
Proof. exact: ZeroAssignmentPairs.zero_polynomials_of_pairs_observable. Qed.

(** unobservable: the multiples other than 0, of degree at most zeta, of the characteristic polynomial of the unobservable part, and no
    others, where the normal rank is not 0 *)
Theorem zero_assignment_unobservable (K : fieldType) n m p (S : system K n m p) d (N : 'M_(d, n)) M (g : {poly K}) :
  unobservable_dynamics S N M -> let r := \rank (transfer S) in (0 < r)%N -> g != 0 ->
  (exists (F : 'M_(r, n)) (G : 'M_(r, p)), same_behavior (with_faults S F G) S /\
    gcd_of_minors (pencil (with_faults S F G)) g) <-> char_poly M %| g /\ (size g <= (zeta S).+1)%N.
Proof. move=> dynamics; exact: (ZeroAssignmentPairs.zero_polynomials_of_pairs dynamics). Qed.
