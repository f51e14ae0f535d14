(** The delay of inversion with known initial state is long where faults take long to reach the states: after as many samples as the delay
    is, every state has been reached that can be reached silently from rest, as many dimensions as there are infinite zeros; and each
    sample before the controllability index adds a dimension to the states that are reached at all.

    drive_step S U == the states that one sample leads to from U
        driven S k == the states that faults lead to from rest in k samples *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg finalg matrix mxalgebra
  zify.
From faultspace Require Import Vocabulary StructureVocabulary Basics Stacks Chain SilentSubspaces Inversion InfiniteZeros.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section ControlDelay.
Variables (K : fieldType) (n m p : nat) (S : system K n m p).
Implicit Types (x y : 'rV[K]_n) (v : nat -> 'rV[K]_m).

(** Section: definitions. The states that faults lead to from rest in k samples. *)
Definition drive_step (U : 'M[K]_n) : 'M[K]_n := (U *m sysA S + sysF S)%MS.
Definition driven k := iter k drive_step 0.

Lemma drive_step_mono (U V : 'M[K]_n) : (U <= V)%MS -> (drive_step U <= drive_step V)%MS.
Proof. by move=> UV; apply: addsmxS; [apply: submxMr | apply: submx_refl]. Qed.

Lemma driven_kernel k (y : 'cV_n) : driven k *m y = 0 <-> forall j, (j < k)%N -> iter j (mulmxr (sysA S)) (sysF S) *m y = 0.
Proof.
elim: k y => [|k IH] y; first by rewrite mul0mx.
have -> : driven k.+1 = (driven k *m sysA S + sysF S)%MS by [].
split=> [/sub_kermxP | h].
  rewrite addsmx_sub => /andP[/sub_kermxP A0 /sub_kermxP F0] [|j] jk; first exact: F0.
  by rewrite /= -mulmxA; apply: (IH _).1 jk; rewrite mulmxA.
apply/sub_kermxP; rewrite addsmx_sub; apply/andP; split; apply/sub_kermxP; last exact: (h 0%N).
by rewrite -mulmxA; apply/IH => j jk; rewrite mulmxA; apply: (h j.+1).
Qed.

Lemma rank_driven k : \rank (driven k) = \rank (reachability_of S k).
Proof.
have e : (kermx (driven k)^T == kermx (reachability_of S k))%MS.
  have same (x : 'rV_n) : x *m (driven k)^T = 0 <-> x *m reachability_of S k = 0.
    rewrite mul_stack_eq0; split=> [/(congr1 trmx)|h].
      rewrite trmx_mul trmxK trmx0 => /driven_kernel h j jk; apply: trmx_inj; rewrite trmx_mul trmxK trmx0; exact: h.
    apply: trmx_inj; rewrite trmx_mul trmxK trmx0; apply/driven_kernel => j jk; apply: trmx_inj; rewrite trmx_mul trmxK trmx0; exact: h.
  by apply/andP; split; apply/row_subP => i; apply/sub_kermxP/same/sub_kermxP/row_sub.
have := eqmx_rank e; rewrite !mxrank_ker mxrank_tr.
have := rank_leq_row (reachability_of S k); have := rank_leq_row (driven k); lia.
Qed.

(** Below the controllability index each sample adds a dimension; from there on none does. *)
Lemma driven_stays j k : (driven j.+1 <= driven j)%MS -> (j <= k)%N -> (driven k <= driven j)%MS.
Proof.
move=> stop /subnK <-; elim: (k - j)%N => [|d IH]; first exact: submx_refl.
by apply: submx_trans stop; apply: drive_step_mono.
Qed.

Lemma index_and_rank k : (controllability_index S + \rank (driven k) <= k + \rank (driven n))%N.
Proof.
rewrite /controllability_index; case: ex_minnP => c; rewrite -!rank_driven => /eqP cn least.
have monotone i j : (i <= j)%N -> (\rank (driven i) <= \rank (driven j))%N.
  by move=> ij; apply/mxrankS/(increasing drive_step_mono).
have top j : (\rank (driven j) <= \rank (driven n))%N by apply/mxrankS/(increasing_constant drive_step_mono).
have [ck|kc] := leqP c k; first exact: leq_add.
suff grows d : (k + d <= c)%N -> (\rank (driven k) + d <= \rank (driven (k + d)))%N.
  have := grows (c - k)%N; rewrite subnKC ?(ltnW kc) // cn => /(_ (leqnn _)); lia.
elim: d => [|d IH] dc; first by rewrite !addn0.
have lt_c : (k + d < c)%N by rewrite -addnS.
rewrite !addnS; apply: leq_ltn_trans (IH (ltnW lt_c)) _; apply: rank_ltmx.
rewrite /ltmx (increasing drive_step_mono (leqnSn _)) /=; apply/negP => stop; move: lt_c; rewrite ltnNge => /negP; apply.
apply: least; rewrite -!rank_driven eqn_leq top /=.
have [nk|kn] := leqP n (k + d); first exact: monotone.
exact/mxrankS/(driven_stays stop)/ltnW.
Qed.

(** Silently reached is reached. *)
Lemma silent_from_rest_driven k : (silent_from_rest S k <= driven k)%MS.
Proof.
elim: k => [|k IH]; first exact: sub0mx.
apply/row_subP => i; have /silent_stepP[x [w [xk _ <-]]] := row_sub i (silent_from_rest S k.+1).
apply: addmx_sub; [apply: submx_trans (addsmxSl _ _); apply/submxMr/(submx_trans xk IH) | ].
exact: submx_trans (submxMl _ _) (addsmxSr _ _).
Qed.

(** From the delay on the states that are reached silently are no more: the first fault on the way is zero. *)
Lemma silent_from_rest_after_delay l : inverts_with_delay S l -> (silent_from_rest S n <= silent_from_rest S l)%MS.
Proof.
move=> inv; have stop : (silent_from_rest S l.+1 <= silent_from_rest S l)%MS.
  apply/row_subP => i; have /silent_from_restP[v [h <-]] := row_sub i (silent_from_rest S l.+1).
  have v0 : v 0%N = 0 by apply: inv => k kl; apply: h.
  apply/silent_from_restP; exists (fun j => v j.+1); split=> [j jl|].
    by rewrite -[RHS](h j.+1) // output_step v0 !mul0mx addr0.
  by rewrite state_step v0 !mul0mx addr0.
have stays k : (l <= k)%N -> (silent_from_rest S k <= silent_from_rest S l)%MS.
  by move=> /subnK <-; elim: (k - l)%N => [|d IH]; [apply: submx_refl | apply: submx_trans stop; apply: silent_step_mono].
have [nl|ln] := leqP n l; first exact: (increasing (@silent_step_mono _ _ _ _ S)).
exact/stays/ltnW.
Qed.

Theorem delay_by_controllability l d : inverts_with_delay S l -> infinite_zeros S d ->
  (controllability_index S + d <= l + \rank (reachability S))%N.
Proof.
move=> inv infinite; have left_inv : left_invertible S by apply: (left_inversion_delay S).2.2; exists l.
rewrite (infinite_zeros_unique infinite (number_of_infinite_zeros left_inv)).
have := index_and_rank l; rewrite [\rank (driven n)]rank_driven -[reachability_of S n]/(reachability S).
have := mxrankS (submx_trans (silent_from_rest_after_delay inv) (silent_from_rest_driven l)); lia.
Qed.

End ControlDelay.
