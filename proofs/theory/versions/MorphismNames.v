(** A lemma of MathComp under the name that it has in MathComp 2; MathComp 1 has it under another. It is proved here from what both name
    alike, and where MathComp 2 is, a file that imports it and GRing.Theory after it has MathComp's own. *)
From mathcomp Require Import ssreflect ssrfun eqtype ssrnat ssralg.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma rmorphXn (R S : ringType) (f : {rmorphism R -> S}) n : {morph f : x / x ^+ n}.
Proof. by move=> x; elim: n => [|n IH]; rewrite ?rmorph1 // !exprS rmorphM IH. Qed.
