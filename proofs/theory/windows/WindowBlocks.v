(** The blocks of [O_s T_s] as the paper writes them: A^k C in O; in T, G on the diagonal, F A^(k-i-1) C beside it, zero before the fault.
    Row mxvec_index i a of T belongs to fault a at time i, column mxvec_index k b to output b at time k. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Blocks.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (s : nat).
Notation power k := (iter k (mulmx (sysA S)) (sysC S)).

Lemma pulse_at (i : 'I_s) a k : (k < s)%N -> pulse K (mxvec_index i a) k = if k == i :> nat then row a (1%:M : 'M_m) else 0.
Proof.
move=> ks; rewrite /pulse insubT /= vec_mx_delta; apply/rowP => j.
by rewrite !mxE -val_eqE /=; case: eqP => _; rewrite !mxE ?andFb // andTb eq_sym.
Qed.

Lemma state_free x t (v : nat -> 'rV[K]_m) k q (M : 'M_(n, q)) : (forall j, (t <= j < t + k)%N -> v j = 0) ->
  state S x v (t + k) *m M = state S x v t *m iter k (mulmx (sysA S)) M.
Proof.
elim: k M => [|k IH] M z; first by rewrite addn0.
rewrite addnS /= z ?leq_addr ?addnS //= mul0mx addr0 -mulmxA IH -?iterSr // => j /andP[tj jk].
by apply: z; rewrite tj addnS ltnW.
Qed.

Theorem window_blocks (i k : 'I_s) :
  \matrix_(a, b) O S s a (mxvec_index k b) = power k /\
  \matrix_(a, b) T S s (mxvec_index i a) (mxvec_index k b) =
    if (i < k)%N then sysF S *m power (k - i.+1) else if i == k then sysG S else 0.
Proof.
split; apply/row_matrixP => a.
  transitivity (output S (row a 1%:M) (fun=> 0) k); first by apply/rowP => b; rewrite !(mxE, mxvecE).
  by rewrite /output mul0mx addr0 -[k : nat]add0n state_free //= -row_mul mul1mx.
transitivity (output S 0 (pulse K (mxvec_index i a)) k); first by apply/rowP => b; rewrite !(mxE, mxvecE).
have before t : (t <= i)%N -> state S 0 (pulse K (mxvec_index i a)) t = 0.
  elim: t => //= t IH ti; have ts : (t < s)%N := ltn_trans ti (ltn_ord i).
  by rewrite IH ?(ltnW ti) // mul0mx add0r pulse_at // (ltn_eqF ti) mul0mx.
rewrite /output pulse_at // -val_eqE /= [k == i :> nat]eq_sym; case: (ltngtP i k) => [ik|ki|ki].
- rewrite mul0mx addr0 -{1}(subnKC ik) state_free /=; last first.
    move=> j /andP[ij]; rewrite subnKC // => jk; have js := ltn_trans jk (ltn_ord k); by rewrite pulse_at // (gtn_eqF ij).
  by rewrite before // mul0mx add0r pulse_at // eqxx -!row_mul mul1mx.
- by rewrite before ?(ltnW ki) // !mul0mx addr0 row0.
- by rewrite before ?ki // mul0mx add0r -row_mul mul1mx.
Qed.
End Blocks.
