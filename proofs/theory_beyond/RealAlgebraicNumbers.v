(** Two headlines are over real closed fields without infinite numbers: the real algebraic numbers are such a field. They are in MathComp's
    library of real closed fields, which the theory does without; so this is no file of it, and a test compiles it where that library is
    installed. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp.real_closed Require Import realalg.
From faultspace Require Import MeansVocabulary.
Import Order.TTheory Num.Theory.

Theorem mean_neither_right_instance : exists (K : rcfType), archimedean K.
Proof.
exists [the rcfType of realalg : Type] => a; exists (Num.bound `|a : realalg|%R).
exact: le_lt_trans (ler_norm (a : realalg)) (archi_boundP (normr_ge0 (a : realalg))).
Qed.

Theorem mean_part_of_the_range_instance : exists (K : rcfType), archimedean K.
Proof. exact: mean_neither_right_instance. Qed.
