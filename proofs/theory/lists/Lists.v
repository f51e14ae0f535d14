(** Vectors and matrices as lists of integers, to compute with, and what they mean over a field of characteristic 0. A list stands for a
    vector of any length, zero where the list ends; so addition needs no lengths.

    mat K a b M == the table M as a matrix over K *)
From Coq Require Import ZArith.
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg ssrint rat matrix.
From mathcomp Require Import zify ssrZ.
From faultspace Require Import Vocabulary CertificatesVocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Lemma entry_add u v j : entry (add u v) j = entry u j + entry v j.
Proof.
by rewrite /entry; elim: u v j => [|a u IH] [|b v] [|j] //=; rewrite ?nth_nil ?add0r ?addr0.
Qed.

Lemma entry_scale a u j : entry (scale a u) j = a * entry u j.
Proof. by rewrite /entry; elim: u j => [|b u IH] [|j] //=; rewrite ?mulr0. Qed.

Lemma entry_null u j : null u -> entry u j = 0.
Proof. by rewrite /entry; elim: u j => [|b u IH] [|j] //= /andP[/eqP e h] //; apply: IH. Qed.

Section Meaning.
Variable (K : fieldType).
Notation number := (number K).
Notation vec := (vec K).

Let composed := [the {rmorphism Z -> K} of @intmul K 1 \o int_of_Z].
Canonical number_additive : {additive Z -> K}.
Proof. by exists number; exact: (GRing.Additive.class composed). Defined.
Canonical number_rmorphism : {rmorphism Z -> K}.
Proof. by exists number; exact: (GRing.RMorphism.class composed). Defined.

Definition mat a b (M : table) : 'M[K]_(a, b) := \matrix_(i < a) vec b (nth [::] M i).

Lemma vec_nil k : vec k [::] = 0.
Proof. by apply/rowP => j; rewrite !mxE /entry nth_nil rmorph0. Qed.

Lemma vec_add k u v : vec k (add u v) = vec k u + vec k v.
Proof. by apply/rowP => j; rewrite !mxE entry_add rmorphD. Qed.

Lemma vec_scale k a u : vec k (scale a u) = number a *: vec k u.
Proof. by apply/rowP => j; rewrite !mxE entry_scale rmorphM. Qed.

Lemma vec_null k u : null u -> vec k u = 0.
Proof. by move=> h; apply/rowP => j; rewrite !mxE entry_null // rmorph0. Qed.

Lemma vec_times a b x M : (size M <= a)%N -> vec b (times x M) = vec a x *m mat a b M.
Proof.
elim: M x a => [|r M IH] [|c x] a h /=; rewrite ?vec_nil ?mul0mx //.
- by rewrite (_ : mat a b [::] = 0) ?mulmx0 //; apply/row_matrixP => i; rewrite rowK row0 nth_nil vec_nil.
case: a h => // a h.
rewrite vec_add vec_scale (IH _ a h) !mulmx_sum_row big_ord_recl /= !mxE rowK; congr (_ + _).
by apply: eq_bigr => i _; rewrite !rowK !mxE.
Qed.

Lemma number_dot k u v : (size u <= k)%N -> vec k u *m (vec k v)^T = (number (dot u v))%:M.
Proof.
move=> h; apply/matrixP => i j; rewrite !ord1 {i j} !mxE eqxx mulr1n.
elim: u v k h => [|a u IH] v k h /=.
  by rewrite big1 ?rmorph0 // => i _; rewrite !mxE /entry nth_nil rmorph0 mul0r.
case: k h => // k h; case: v => [|b v].
  by rewrite big1 ?rmorph0 // => i _; rewrite !mxE /entry nth_nil rmorph0 mulr0.
rewrite big_ord_recl rmorphD rmorphM !mxE /= -(IH v k h); congr (_ + _).
by apply: eq_bigr => i _; rewrite !mxE.
Qed.

Lemma vec_apply a b M x : all (fun r => size r == b) M -> (vec a (apply M x))^T = mat a b M *m (vec b x)^T.
Proof.
move=> h; apply/row_matrixP => i; rewrite row_mul rowK.
have e : (size (nth [::] M i) <= b)%N.
  by have [l|l] := ltnP i (size M); [rewrite (eqP (all_nthP [::] h _ l))|rewrite nth_default].
rewrite (number_dot _ e); apply/matrixP => k j; rewrite !ord1 !mxE eqxx mulr1n /apply; congr number.
rewrite /entry; have [l|l] := ltnP i (size M); first by rewrite (nth_map [::]).
by rewrite !nth_default // size_map.
Qed.

End Meaning.

Lemma number_eq0 z : (number (field_of rat) z == 0) = (z == Z0).
Proof. by rewrite intr_eq0 -[RHS](inj_eq (can_inj int_of_ZK)). Qed.
