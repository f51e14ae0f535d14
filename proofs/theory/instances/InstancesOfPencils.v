(** Instances for headlines on the pencil, its indices and zeros, and on the subspaces of the state, as InstancesOfLimits.v has them for
    those on limits.

       side_by_side == a part with more outputs than faults beside one with more faults than outputs:
                       x1(k+1) = x1(k) + v1(k), r1 = x1, r2 = v1; x2(k+1) = x2(k) + v2(k), r3 = x2 + v3
    summed_register == x1(k+1) = x2(k), x2(k+1) = v(k), r = x1 + x2: transfer function (q + 1) / q^2 *)
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import Vocabulary StructureVocabulary.
From faultspace Require Inversion TransferRank EchelonExists UnobservableZeros ExtremalSubspaces Existence.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Systems.
Variable K : fieldType.

Definition side_by_side : system K (1 + 1) (1 + 1 + 1) (1 + 1 + 1) :=
  System 1%:M (col_mx 1%:M 0) (block_mx (row_mx 1%:M 0) 0 0 1%:M) (block_mx (block_mx 0 1%:M 0 0) 0 0 1%:M).

Definition summed_register : system K (1 + 1) 1 1 := System (block_mx 0 0 1%:M 0) (row_mx 0 1%:M) (col_mx 1%:M 1%:M) 0.

Lemma summed_with_delay : inverts_with_delay summed_register 1.
Proof.
by move=> v /(_ 1%N isT); rewrite /output /= !mulmx0 mul0mx add0r addr0 mul_mx_row mulmx0 mulmx1 mul_row_col mul0mx mulmx1 add0r.
Qed.

Lemma summed_left_invertible : left_invertible summed_register.
Proof. exact: Inversion.delay_left_invertible summed_with_delay. Qed.

Lemma twice_zero_left_invertible : left_invertible (UnobservableZeros.twice_zero K).
Proof. by have [] := UnobservableZeros.twice_zero_not_recovered K. Qed.

End Systems.

(** ** window-ranks *)

Theorem window_ranks_left_indices_instance (K : fieldType) : exists n m p (S : system K n m p) d (Y : 'M_(n + p, d)),
  minimal_basis (pencil S) Y.
Proof.
have [_ _ [c [X basis]] _] := Existence.zeros_exist (side_by_side K).
by exists (1 + 1)%N, (1 + 1 + 1)%N, (1 + 1 + 1)%N, (side_by_side K), c, X.
Qed.

Theorem window_ranks_indices_instance (K : fieldType) : exists n m p (S : system K n m p) c k (X : 'M_(n + p, c)) (Y : 'M_(n + m, k)) g d,
  minimal_basis (pencil S) X /\ minimal_basis (pencil S)^T Y /\
  gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g /\ system_infinite_zeros S d.
Proof.
have [_ [g [d [minors infinite]]] [c [X left_basis]] [k [Y right_basis]]] := Existence.zeros_exist (side_by_side K).
by exists (1 + 1)%N, (1 + 1 + 1)%N, (1 + 1 + 1)%N, (side_by_side K), c, k, X, Y, g, d.
Qed.

Theorem zeta_of_system_instance (K : fieldType) : exists n m p (S : system K n m p) k (Y : 'M_(n + m, k)) g d,
  minimal_basis (pencil S)^T Y /\ gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g /\ system_infinite_zeros S d.
Proof.
have [n [m [p [S [c [k [X [Y [g [d [_ one]]]]]]]]]]] := window_ranks_indices_instance K.
by exists n, m, p, S, k, Y, g, d.
Qed.

Theorem window_ranks_limit_instance (K : fieldType) : exists n m p (S : system K n m p) s k (Z : 'M_(k, n + p)) c (Y : 'M_(n + m, c)) g d,
  spans_solutions S s.+1 Z /\ minimal_basis (pencil S)^T Y /\
  gcd_of_minors_of_order (n + \rank (transfer S)) (pencil S) g /\ system_infinite_zeros S d.
Proof.
have [n [m [p [S [c [Y [g [d one]]]]]]]] := zeta_of_system_instance K.
by have [k [Z [_ span]]] := EchelonExists.solutions_echelon_exists S n.+1; exists n, m, p, S, n, k, Z, c, Y, g, d.
Qed.

(** ** The behaviour as a kernel *)

Theorem behavior_is_kernel_instance (K : fieldType) : exists n m p (S : system K n m p) d (Y : 'M_(n + p, d)),
  minimal_basis (pencil S) Y.
Proof. exact: window_ranks_left_indices_instance. Qed.

(** ** Zero states *)

Theorem zero_states_subspaces_instance (K : fieldType) : exists n m p (S : system K n m p) a b (V : 'M_(a, n)) (W : 'M_(b, n)),
  largest_output_nulling S V /\ smallest_input_containing S W.
Proof.
have [V [W both]] := ExtremalSubspaces.extremal_subspaces_exist (side_by_side K).
by exists (1 + 1)%N, (1 + 1 + 1)%N, (1 + 1 + 1)%N, (side_by_side K), (1 + 1)%N, (1 + 1)%N, V, W.
Qed.

Theorem zero_states_direct_instance (K : fieldType) : exists n m p (S : system K n m p) a b (V : 'M_(a, n)) (W : 'M_(b, n)) g d,
  largest_output_nulling S V /\ smallest_input_containing S W /\ left_invertible S /\ gcd_of_minors (pencil S) g /\ infinite_zeros S d.
Proof.
have [V [W [largest smallest]]] := ExtremalSubspaces.extremal_subspaces_exist (summed_register K).
have [/(_ (@summed_left_invertible K))[g [d zeros]] _ _ _] := Existence.zeros_exist (summed_register K).
exists (1 + 1)%N, 1%N, 1%N, (summed_register K), (1 + 1)%N, (1 + 1)%N, V, W, g, d.
by do 2!split=> //; split; first exact: summed_left_invertible.
Qed.

(** ** trajectory-recovered *)

(** One of the two states is unobservable. *)
Theorem trajectory_zero_polynomial_instance (K : fieldType) : exists n m p (S : system K n m p) d (N : 'M_(d, n)) M g,
  unobservable_dynamics S N M /\ gcd_of_minors (pencil S) g.
Proof.
have [d [N [M dynamics]]] := UnobservableZeros.unobservable_dynamics_exist (UnobservableZeros.twice_zero K).
have [/(_ (@twice_zero_left_invertible K))[g [_ [minors _]]] _ _ _] := Existence.zeros_exist (UnobservableZeros.twice_zero K).
by exists (1 + 1)%N, 1%N, 1%N, (UnobservableZeros.twice_zero K), d, N, M, g.
Qed.

Theorem trajectory_no_finite_zeros_instance (K : fieldType) : exists n m p (S : system K n m p) g, gcd_of_minors (pencil S) g.
Proof.
by have [n [m [p [S [_ [_ [_ [g [_ minors]]]]]]]]] := trajectory_zero_polynomial_instance K; exists n, m, p, S, g.
Qed.

Theorem infinite_zeros_by_ranks_instance (K : fieldType) : exists n m p (S : system K n m p) d s,
  left_invertible S /\ infinite_zeros S d /\ (n <= s)%N.
Proof.
have [/(_ (@summed_left_invertible K))[_ [d [_ infinite]]] _ _ _] := Existence.zeros_exist (summed_register K).
by exists (1 + 1)%N, 1%N, 1%N, (summed_register K), d, 2%N; split; first exact: summed_left_invertible.
Qed.

Theorem delay_by_controllability_instance (K : fieldType) : exists n m p (S : system K n m p) l d,
  inverts_with_delay S l /\ infinite_zeros S d.
Proof.
have [/(_ (@summed_left_invertible K))[_ [d [_ infinite]]] _ _ _] := Existence.zeros_exist (summed_register K).
by exists (1 + 1)%N, 1%N, 1%N, (summed_register K), 1%N, d; split; first exact: summed_with_delay.
Qed.

(** ** zero-assignment *)

Theorem zero_assignment_unobservable_instance (K : fieldType) : exists n m p (S : system K n m p) d (N : 'M_(d, n)) M (g : {poly K}),
  unobservable_dynamics S N M /\ let r := \rank (transfer S) in (0 < r)%N /\ g != 0.
Proof.
have [d [N [M dynamics]]] := UnobservableZeros.unobservable_dynamics_exist (UnobservableZeros.twice_zero K).
exists (1 + 1)%N, 1%N, 1%N, (UnobservableZeros.twice_zero K), d, N, M, 'X; split=> //=.
by rewrite ((TransferRank.left_invertible_transfer_rank _).1 (@twice_zero_left_invertible K)) polyX_eq0.
Qed.
