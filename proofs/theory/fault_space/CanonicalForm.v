(** A canonical form. For fixed (A, C) the solution space of problem (11) at any one window s >= n + 1 determines the behaviour, and is
    determined by it; left-invertibility is not needed. So whatever names a row space names the class of equivalent fault matrices:
    MathComp's <<Z>>, or the reduced row echelon form, which is unique.

          defect S s z == what T_s(z) has outside of [O_s T_s]: nothing where z solves problem (11)
    solution_space S s == the solutions of problem (11), as a row space *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra.
From faultspace Require Import Vocabulary Basics Windows Infinite SharpWindows Solutions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** The solutions of problem (11) are the row space of a matrix. *)
Section SolutionSpace.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s : nat).
Notation faults z := (with_faults S (lsubmx z) (rsubmx z) : system K n 1 p).

Lemma T_linear a (y z : 'rV[K]_(n + p)) : T (faults (a *: y + z)) s = a *: T (faults y) s + T (faults z) s.
Proof.
apply/row_matrixP => i; rewrite [RHS]linearD linearZ /= !rowK -samples_scale -samples_add.
apply: samples_ext => k _; move: (pulse K i) => v; rewrite /output.
have -> : state (faults (a *: y + z)) 0 v k = a *: state (faults y) 0 v k + state (faults z) 0 v k.
  elim: k => [|k IH] /=; first by rewrite scaler0 addr0.
  by rewrite IH !linearP /= mulmxDl -!scalemxAl scalerDr addrACA.
by rewrite /= !linearP /= mulmxDl -scalemxAl scalerDr addrACA.
Qed.

Definition defect (z : 'rV[K]_(n + p)) := mxvec (T (faults z) s *m cokermx (window S s)).

Lemma defect_linear : linear defect.
Proof. by move=> a y z; rewrite /defect T_linear mulmxDl -scalemxAl linearP. Qed.

Definition solution_space : 'M[K]_(n + p) := kermx (lin1_mx defect).

Theorem solution_spaceP : spans_solutions S s solution_space.
Proof.
move=> f g; split=> [sol | /sub_kermxP].
  apply/sub_kermxP; rewrite (mul_lin1 _ defect_linear) /defect row_mxKl row_mxKr.
  by move: sol; rewrite /solves submxE => /eqP ->; rewrite linear0.
by rewrite (mul_lin1 _ defect_linear) /defect row_mxKl row_mxKr => /eqP; rewrite mxvec_eq0 -submxE.
Qed.

End SolutionSpace.

Section CanonicalForm.
Variables (K : fieldType) (n m m' p : nat) (S : system K n m p) (S' : system K n m' p).
Hypotheses (sameA : sysA S' = sysA S) (sameC : sysC S' = sysC S).

Lemma same_faults k (F : 'M_(k, n)) (G : 'M_(k, p)) : with_faults S' F G = with_faults S F G.
Proof. by rewrite /with_faults sameA sameC. Qed.

(** At every window, for restricted behaviours. *)
Theorem equal_solutions_equal_words s :
  (forall (f : 'rV_n) (g : 'rV_p), solves S s f g <-> solves S' s f g) <-> (forall r, word S s r <-> word S' s r).
Proof.
split=> [same | same f g]; last first.
  by rewrite !solves_words same_faults; split=> sub r /sub /same.
have own k (Q : system K n k p) i : solves Q s (row i (sysF Q)) (row i (sysG Q)).
  by move: i; apply/solution_rows => r; rewrite with_own_faults.
move=> r; split.
  rewrite -{1}[S]with_own_faults -(same_faults (sysF S)); move: r; apply/solution_rows => i; apply/same; exact: own.
rewrite -{1}[S']with_own_faults same_faults; move: r; apply/solution_rows => i; apply/same; exact: own.
Qed.

Theorem equal_solutions_equal_behaviors s : (n < s)%N ->
  (forall (f : 'rV_n) (g : 'rV_p), solves S s f g <-> solves S' s f g) <-> (forall r, behavior S r <-> behavior S' r).
Proof.
case: s => // s ns; rewrite equal_solutions_equal_words behavior_eqP.
exact: equal_on_n_plus_1_samples.
Qed.

(** As row spaces: of any two matrices whose rows span the solutions, and of the canonical generators. *)
Theorem canonical_form s k k' (Z : 'M_(k, n + p)) (Z' : 'M_(k', n + p)) : (n < s)%N ->
  spans_solutions S s Z -> spans_solutions S' s Z' -> (Z :=: Z')%MS <-> (forall r, behavior S r <-> behavior S' r).
Proof.
move=> ns span span'; rewrite -(equal_solutions_equal_behaviors ns); split=> [eqZ f g | same].
  by rewrite span span' eqZ.
have sub (z : 'rV_(n + p)) : (z <= Z)%MS <-> (z <= Z')%MS by rewrite -[z]hsubmxK -span -span'; apply: same.
by apply/eqmxP/andP; split; apply/row_subP => i; apply/sub; apply: row_sub.
Qed.

Theorem canonical_generator s : (n < s)%N ->
  <<solution_space S s>>%MS = <<solution_space S' s>>%MS <-> (forall r, behavior S r <-> behavior S' r).
Proof.
move=> ns; rewrite -(canonical_form ns (solution_spaceP S s) (solution_spaceP S' s)).
by split=> [/genmxP/eqmxP | /eqmxP/genmxP].
Qed.

End CanonicalForm.
