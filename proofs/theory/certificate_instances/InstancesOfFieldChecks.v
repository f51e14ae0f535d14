(** Instances for the headlines on certificates over GF(p) and Q(a) (HeadlinesFields.v): small certificates over the field with three
    elements that the checks accept, of systems with one state, the same as in InstancesOfChecks.v.

               three == integers modulo 3
               table == a table of them
      three_elements == a field that they mean something in
    accumulator, fed == x(k+1) = x(k) + v(k), r = (x, v); and x(k+1) = v(k), r = (x, v - x), with the same behaviour
          memoryless == x(k+1) = v(k), r = (x, v)
             delayed == x(k+1) = x(k) + v(k), r = x
              direct == x(k+1) = x(k), r = x + v
               mixed == x(k+1) = x(k) + v(k), r = x - v, with the zero -1
          two_in_one == two faults, whose sum alone is seen
          two_faults == x(k+1) = x(k) + v_1(k), r = (x, v_1, v_2)
          both_alike == the same, one fault being v_1 and v_2
            relation == r_1(k+1) = r_1(k) + r_2(k), of the accumulator
           relation3 == the same with a third output
          other_step == r_1(k+1) = r_2(k)
            words_of == words of two samples, which show that there are no other relations; `first` are the faults of the one that
                        begins at 1
          more_words == words of two_faults
          other_word == the faults of the word of fed that begins at 1
        one_and_none == the faults 1 and 0 *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop ssralg matrix.
From faultspace Require Import Vocabulary CertificatesVocabulary NumbersVocabulary FieldArithmetic.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Local Open Scope Z_scope.
Definition three := residues 3.
Notation table := (seq (seq (numeral three))).
Definition accumulator := Listing (R := three) [:: [:: 1]] [:: [:: 1]] [:: [:: 1; 0]] [:: [:: 0; 1]].
Definition fed := Listing (R := three) [:: [:: 0]] [:: [:: 1]] [:: [:: 1; 2]] [:: [:: 0; 1]].
Definition memoryless := Listing (R := three) [:: [:: 0]] [:: [:: 1]] [:: [:: 1; 0]] [:: [:: 0; 1]].
Definition delayed := Listing (R := three) [:: [:: 1]] [:: [:: 1]] [:: [:: 1]] [:: [:: 0]].
Definition direct := Listing (R := three) [:: [:: 1]] [:: [:: 0]] [:: [:: 1]] [:: [:: 1]].
Definition mixed := Listing (R := three) [:: [:: 1]] [:: [:: 1]] [:: [:: 1]] [:: [:: 2]].
Definition two_in_one := Listing (R := three) [:: [:: 1]] [:: [:: 1]; [:: 1]] [:: [:: 1; 0]] [:: [:: 0; 1]; [:: 0; 1]].
Definition two_faults := Listing (R := three) [:: [:: 1]] [:: [:: 1]; [:: 0]] [:: [:: 1; 0; 0]] [:: [:: 0; 1; 0]; [:: 0; 0; 1]].
Definition both_alike := Listing (R := three) [:: [:: 1]] [:: [:: 1]] [:: [:: 1; 0; 0]] [:: [:: 0; 1; 1]].
Definition relation : seq (nat * table) := [:: (0%N, [:: [:: 2; 2]; [:: 1; 0]])].
Definition relation3 : seq (nat * table) := [:: (0%N, [:: [:: 2; 2; 0]; [:: 1; 0; 0]])].
Definition other_step : table := [:: [:: 0; 2]; [:: 1; 0]].
Definition words_of (first : table) : seq (seq (numeral three) * table * (nat * nat)) :=
  [:: ([:: 1], first, (0, 0)%N); ([:: 0], [:: [:: 1]; last [::] first], (0, 1)%N); ([:: 0], [:: [:: 0]; [:: 1]], (1, 1)%N)].
Definition more_words : seq (seq (numeral three) * table * (nat * nat)) :=
  [:: ([:: 1], [:: [::]; [::]], (0, 0)%N); ([:: 0], [:: [:: 1; 0]; [::]], (0, 1)%N); ([:: 0], [:: [:: 0; 1]; [::]], (0, 2)%N);
    ([:: 0], [:: [::]; [:: 1; 0]], (1, 1)%N); ([:: 0], [:: [::]; [:: 0; 1]], (1, 2)%N)].
Definition other_word : table := [:: [:: 1]; [:: 1]].
Definition one_and_none : table := [:: [:: 1]; [:: 0]].
Local Close Scope Z_scope.

(** ** Numbers *)

Lemma three_elements : exists K : fieldType, means (number K : numeral three -> K).
Proof. by have [//|K zero] := @residues_exist (Zpos (xI xH)); exists K; apply: residues_mean. Qed.

Theorem residues_mean_instance : exists (K : fieldType) l, number K l = 0.
Proof. by have [//|K zero] := @residues_exist (Zpos (xI xH)); exists K, (Zpos (xI xH)). Qed.

Theorem residues_exist_instance : exists l, Z.lt (Zpos xH) l.
Proof. by exists (Zpos (xI xH)). Qed.

(** ** Ranks of windows, left-invertibility, solutions *)

Theorem field_window_ranks_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r etas ranks (L : listing R)
    rows Q ws,
  means value /\ has_window_ranks n m p r etas ranks L rows Q ws.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 1%N, [:: 1%N], [:: 2; 3; 4]%N, accumulator, relation.
by exists None, (words_of [:: [::]; [::]]); split; [exact: meaning|vm_compute].
Qed.

Theorem field_left_invertible_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (L : listing R) ws,
  means value /\ is_left_invertible n m p L ws.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, accumulator, (words_of [:: [::]; [::]]).
by split; [exact: meaning|vm_compute].
Qed.

Theorem field_solutions_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p s (L : listing R)
    rows Q ws basis pivots combinations,
  means value /\ are_solutions n m p s L rows Q ws basis pivots combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 2%N, accumulator, relation, None.
exists (words_of [:: [::]; [::]]), [:: [:: 1; 0; 1]%Z], [:: 0%N], [:: (0%N, [:: 1; 1]%Z); (1%N, [:: 0; 1]%Z)].
by split; [exact: meaning|vm_compute].
Qed.

Theorem field_limit_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p beyond (L : listing R)
    rows Q ws basis pivots combinations,
  means value /\ are_solutions_beyond n m p beyond L rows Q ws basis pivots combinations /\ exists s, (beyond < s)%N.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 1%N, accumulator, relation, None.
exists (words_of [:: [::]; [::]]), [:: [:: 1; 0; 1]%Z], [:: 0%N], [:: (0%N, [:: 1; 1]%Z); (1%N, [:: 0; 1]%Z)].
by split; [exact: meaning|split; [vm_compute|exists 2%N]].
Qed.

(** ** Two behaviours *)

Theorem field_inclusion_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p (L : listing R)
    (L' : listing R) rows Q ws,
  means value /\ is_included n m n' m' p L L' rows Q ws /\
  let S := system_of value n m p L in (exists s r, word S s r) /\ exists r, behavior S r.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, 2%N, 3%N, both_alike, two_faults, relation3, None.
exists more_words; split; first exact: meaning.
split; first by vm_compute.
set S := system_of _ _ _ _ _.
by split; [exists 2%N|]; exists (output S (const_mx 1) (fun=> const_mx 1)), (const_mx 1), (fun=> const_mx 1).
Qed.

Theorem field_equality_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p (L : listing R)
    (L' : listing R) rows Q ws ws',
  means value /\ are_equal n m n' m' p L L' rows Q ws ws'.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, 1%N, 2%N, accumulator, fed, relation, None.
by exists (words_of [:: [::]; [::]]), (words_of other_word); split; [exact: meaning|vm_compute].
Qed.

Theorem field_window_equality_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p s (L : listing R)
    (L' : listing R) rows Q ws ws',
  means value /\ are_equal_on n m n' m' p s L L' rows Q ws ws'.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, 1%N, 2%N, 2%N, accumulator, fed, relation, None.
by exists (words_of [:: [::]; [::]]), (words_of other_word); split; [exact: meaning|vm_compute].
Qed.

Theorem field_difference_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m n' m' p s (L : listing R)
    (L' : listing R) x vs c,
  means value /\ differ n m n' m' p s L L' x vs c.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, 1%N, 2%N, 2%N, accumulator, memoryless, [:: 1%Z].
by exists one_and_none, other_step; split; [exact: meaning|vm_compute].
Qed.

(** ** Inversion *)

Theorem field_not_left_invertible_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (L : listing R) xs vs,
  means value /\ is_not_left_invertible n m p L xs vs.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 2%N, 2%N, two_in_one, [:: [:: 0]; [:: 0]]%Z, [:: [:: 2; 1]]%Z.
by split; [exact: meaning|vm_compute].
Qed.

Theorem field_delay_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (known : bool) l (L : listing R)
    rows x vs,
  means value /\ has_delay n m p known l L rows x vs /\ exists j, (j < l)%N.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, true, 1%N, delayed, [:: [:: [:: 2]; [:: 1]]]%Z.
by exists [:: 0]%Z, [:: [:: 1]]%Z; split; [exact: meaning|split; [vm_compute|exists 0%N]].
Qed.

Theorem field_no_delay_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (known : bool) (L : listing R)
    x vs,
  means value /\ has_no_delay n m p known L x vs /\ exists j, (j <= n)%N.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 2%N, 2%N, true, two_in_one, [:: 0]%Z, [:: [:: 2; 1]; [:: 0; 0]]%Z.
by split; [exact: meaning|split; [vm_compute|exists 1%N]].
Qed.

(** ** Ranks of named matrices *)

Theorem field_observability_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r (L : listing R)
    nulls combinations,
  means value /\ observability_has_rank n m p r L nulls combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 1%N, accumulator, [:: (1%N, [:: 0; 1]%Z)].
by exists [:: (0%N, [:: 1]%Z)]; split; [exact: meaning|vm_compute].
Qed.

Theorem field_window_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p s r (L : listing R)
    nulls combinations,
  means value /\ window_has_rank n m p s r L nulls combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 2%N, 3%N, accumulator, [:: (2%N, [:: 2; 2; 1; 0]%Z)].
by exists [:: (0%N, [:: 1; 0; 0]%Z); (1%N, [:: 0; 1; 0]%Z); (3%N, [:: 0; 0; 1]%Z)]; split; [exact: meaning|vm_compute].
Qed.

Theorem field_toeplitz_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p s r (L : listing R)
    nulls combinations,
  means value /\ toeplitz_has_rank n m p s r L nulls combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 2%N, 2%N, accumulator.
exists [:: (0%N, [:: 1; 0; 0; 0]%Z); (2%N, [:: 0; 2; 1; 0]%Z)], [:: (1%N, [:: 1; 0]%Z); (3%N, [:: 0; 1]%Z)].
by split; [exact: meaning|vm_compute].
Qed.

Theorem field_reachability_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r (L : listing R)
    nulls combinations,
  means value /\ reachability_has_rank n m p r L nulls combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 1%N, accumulator, [::], [:: (0%N, [:: 1]%Z)].
by split; [exact: meaning|vm_compute].
Qed.

Theorem field_hankel_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p N s r (L : listing R)
    x vs nulls combinations,
  means value /\ hankel_has_rank n m p N s r L x vs nulls combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 2%N, 1%N, 2%N, accumulator, [:: 1%Z], one_and_none.
by exists [::], [:: (0%N, [:: 0; 1]%Z); (1%N, [:: 1; 1]%Z)]; split; [exact: meaning|vm_compute].
Qed.

Theorem field_excitation_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p N s r (L : listing R)
    x vs nulls combinations,
  means value /\ excitation_has_rank n m p N s r L x vs nulls combinations.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 2%N, 2%N, 1%N, 2%N, accumulator, [:: 1%Z], one_and_none.
by exists [::], [:: (0%N, [:: 0; 1]%Z); (1%N, [:: 1; 1]%Z)]; split; [exact: meaning|vm_compute].
Qed.

(** ** Zeros, and a line of faults *)

Theorem field_finite_zeros_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p r (L : listing R)
    g c d U U' V V',
  means value /\ has_finite_zeros n m p r L g c d U U' V V'.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, 1%N, mixed, [:: 1; 1]%Z, 1%Z, [:: [:: 2]; [:: 2; 2]]%Z.
exists [:: [:: [::]; [:: 1]]; [:: [:: 1]; [:: 2; 1]]]%Z, [:: [:: [:: 1; 2]; [:: 1]]; [:: [:: 1]; [::]]]%Z.
by exists [:: [:: [:: 1]; [:: 2]]; [:: [::]; [:: 1]]]%Z, [:: [:: [:: 1]; [:: 1]]; [:: [::]; [:: 1]]]%Z; split; [exact: meaning|vm_compute].
Qed.

Theorem field_infinite_zeros_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p orders (L : listing R)
    d U U' V V',
  means value /\ has_infinite_zeros n m p orders L d U U' V V' /\ exists j, (j <= size orders)%N.
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, [:: 1%N], delayed, [:: [:: 2]; [:: 0; 1]]%Z.
exists [:: [:: [:: 2]; [:: 1]]; [:: [:: 0; 1]; [:: 1; 2]]]%Z, [:: [:: [:: 2; 1]; [:: 1]]; [:: [:: 0; 1]; [:: 1]]]%Z.
exists [:: [:: [:: 1]; [:: 2]]; [:: [:: 0]; [:: 1]]]%Z, [:: [:: [:: 1]; [:: 1]]; [:: [:: 0]; [:: 1]]]%Z.
by split; [exact: meaning|split; [vm_compute|exists 1%N]].
Qed.

Theorem field_left_invertible_line_instance : exists (R : arithmetic) (K : fieldType) (value : numeral R -> K) n m p (L : listing R)
    (L' : listing R) points others,
  means value /\ is_left_invertible_line n m p L L' points others /\ exists (a : K) (b : K), (a != 0) || (b != 0).
Proof.
have [K meaning] := three_elements; exists three, K, (number K), 1%N, 1%N, 1%N, delayed, direct.
exists [:: LinePoint (R := three) 1%Z [:: [:: 0]; [:: 1]]%Z [:: [:: 1]; [:: 0]]%Z [:: [:: [:: 2]]]%Z [:: 1]%Z].
exists [:: LinePoint (R := three) 0%Z [:: [:: 2]; [:: 0]]%Z [:: [:: 1]; [:: 1]]%Z [:: [:: [:: 1]]]%Z [:: 1; 2]%Z].
by split; [exact: meaning|split; [vm_compute|exists 1, 1; rewrite oner_eq0]].
Qed.
