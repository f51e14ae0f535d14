(** Silent ways give solutions of problem (11). Let y be reached at time M with zero output. A kick adds y to the state and u to the
    faults, once: one more fault, with the columns y A + u F and y C + u G. A window of M + 1 samples cannot tell a kick from the trajectory
    that has been on the silent way to y before. So the column solves problem (11) on M + 1 samples, though it need not on more.

        add_faults == S with the faults (F, G) beside its own
    kick_f, kick_g == y A + u F and y C + u G
              kick == S with (kick_f, kick_g) as its one fault
          once w k == w at time 0, and 0 afterwards *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg matrix.
From faultspace Require Import Vocabulary Basics Windows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

(** Two groups of faults act one by one. *)
Section TwoGroups.
Variables (K : fieldType) (n m m' p : nat) (S : system K n m p) (F : 'M[K]_(m', n)) (G : 'M[K]_(m', p)).
Implicit Types (x : 'rV[K]_n) (v : nat -> 'rV[K]_m) (w : nat -> 'rV[K]_m').

Definition add_faults : system K n (m + m') p := with_faults S (col_mx (sysF S) F) (col_mx (sysG S) G).

Lemma state_add_faults x v w k : state add_faults x (fun j => row_mx (v j) (w j)) k = state S x v k + state (with_faults S F G) 0 w k.
Proof. by elim: k => [|k IH]; [rewrite addr0|rewrite /= IH mul_row_col mulmxDl addrACA]. Qed.

Lemma output_add_faults x v w k : output add_faults x (fun j => row_mx (v j) (w j)) k = output S x v k + output (with_faults S F G) 0 w k.
Proof. by rewrite /output state_add_faults mul_row_col mulmxDl addrACA. Qed.

End TwoGroups.

Section Kicks.
Variables (K : fieldType) (n m p : nat) (S : system K n m p) (y : 'rV[K]_n) (u : 'rV[K]_m).
Implicit Types (w : 'rV[K]_1) (i k : nat) (kappa : nat -> 'rV[K]_1).

Definition kick_f : 'rV[K]_n := y *m sysA S + u *m sysF S.
Definition kick_g : 'rV[K]_p := y *m sysC S + u *m sysG S.
Definition kick : system K n 1 p := with_faults S kick_f kick_g.
Definition once q (w : 'rV[K]_q) k : 'rV[K]_q := if k is 0 then w else 0.

(** A kick at time zero. *)
Lemma output_kick_once w k : output kick 0 (once w) k = output S (w *m y) (once (w *m u)) k.
Proof.
case: k => [|k]; first by rewrite /output /= mul0mx add0r mulmxDr !mulmxA.
by rewrite !output_step /= mul0mx add0r mulmxDr !mulmxA output_free.
Qed.

(** A kick at time i: the trajectory that is silent until then. *)
Lemma kick_word M i w : silently_reaches S M y -> (i <= M)%N -> forall s, word S s (output kick 0 (follow i (fun=> 0) (once w))).
Proof.
move=> [x [v [silent_v ey]]] iM s; rewrite -(subnK iM) in silent_v ey.
exists (w *m state S x v (M - i)), (follow i (fun j => w *m v (M - i + j)%N) (once (w *m u))) => k _.
have scaled (z : 'rV[K]_n) a j : state S (w *m z) (fun i => w *m a i) j = w *m state S z a j.
  by elim: j => //= j ->; rewrite mulmxDr !mulmxA.
have [ki|ik] := ltnP k i.
  rewrite !output_follow_before // output_zero // /output scaled -state_shift -!mulmxA -mulmxDr.
  by rewrite -[X in _ *m X]/(output S x v (M - i + k)%N) silent_v ?mulmx0 // ltn_add2l.
by rewrite -(subnKC ik) !output_follow_after state_zero // scaled -state_shift ey output_kick_once.
Qed.

Theorem kick_solves M : silently_reaches S M y -> solves S M.+1 kick_f kick_g.
Proof.
move=> reach; apply/solvesP => kappa; rewrite -/kick.
have words : word S M.+1 (fun k => \sum_(i < M.+1) output kick 0 (follow i (fun=> 0) (once (kappa i))) k).
  by apply: word_sum => i _; apply: kick_word reach (ltn_ord i : (i <= M)%N) _.
apply: word_ext words => k kM.
rewrite -output_sum big1 //; apply: output_ext => j jk.
rewrite (bigD1 (Ordinal (leq_ltn_trans jk kM))) //= big1 => [|i].
  by rewrite /follow ltnn subnn addr0.
rewrite -(inj_eq val_inj) /follow /= => ij; have [//|ij'] := ltnP j i.
by have: (0 < j - i)%N; [rewrite subn_gt0 ltn_neqAle ij|case: (j - i)%N].
Qed.

End Kicks.
