(** The ninth part of Headlines.v, which includes it: inputs of any rational spectrum, a long memory included, in the language of
    HeadlinesMeans.v. With n past inputs or more, u and v uncorrelated and an input that excites, the limit of PI-MOESP has all of the
    range of O_s for almost every (A, B). *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype finfun bigop zmodp ssralg ssrnum matrix mxalgebra.
From faultspace Require Import Vocabulary LimitsVocabulary MeansVocabulary.
From faultspace Require RationalSeen RationalMeans LeastOrder.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(** ** proposition-1, two-sided-almost-every *)

(** A stable, u and v uncorrelated at all lags. r and a are those of an equation that the covariances of u satisfy, R is the covariance of
    r + q + s successive inputs. M, which the limit would be if the state were measured, times reciprocal_at r a A is seen_rational, a
    polynomial in A and B. Where s samples show all states and s successive inputs excite, that has full rank iff the factor is regular and
    the limit has all of the range. *)
Theorem mean_rational_range (K : realFieldType) (E : (nat -> K) -> K -> Prop) n m p nu (S : system K n m p) (B : 'M_(nu, n))
    (D : 'M_(nu, p)) u v x y q s r a R L :
  mean E -> positive E -> process S B D u v x y -> stable (sysA S) ->
  quasi_stationary E (fun t => row_mx (row_mx (u t) (v t)) (x t)) -> uncorrelated E u v -> spectrum_equation E r a u ->
  covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R -> excites E s u -> row_free (O S s) ->
  limit E (successive 0 q u) (successive q s u) (successive q s y) L ->
  (exists M, [/\ limit E (successive 0 q u) (successive q s u) (later q x) M, L = M *m O S s
    & seen_rational a R (sysA S) B = M *m reciprocal_at r a (sysA S)]) /\
  row_full (seen_rational a R (sysA S) B) = (L == O S s)%MS && (reciprocal_at r a (sysA S) \in unitmx).
Proof.
move=> isE pos model st quasi uv spectrum; exact: (RationalMeans.rational_range isE pos model st quasi uv spectrum).
Qed.

(** An input whose covariances satisfy an equation satisfies one, of no larger order, for which the factor is regular at every stable A.
    With it, A being stable and the rest as in mean_rational_range, the limit has all of the range iff seen_rational has full rank. *)
Theorem mean_rational_order (K : realFieldType) (E : (nat -> K) -> K -> Prop) nu (u : nat -> 'rV_nu) r :
  mean E -> positive E -> quasi_stationary E u -> order_of_spectrum E r u -> exists r' a, [/\ (r' <= r)%N, spectrum_equation E r' a u
  & forall n (A : 'M[K]_n), stable A -> reciprocal_at r' a A \in unitmx].
Proof. move=> isE pos quasi; exact: (LeastOrder.least_order isE pos quasi). Qed.

(** On every line through an (A, B) where seen_rational has full rank it has full rank at all but at most n (q + r) points. *)
Theorem rational_almost_every (K : fieldType) n nu r (a : nat -> K) q s (R : 'M_((r + q + s) * nu)) (A A1 : 'M_n) (B B1 : 'M_(nu, n))
    (ts : seq K) : row_full (seen_rational a R A B) -> uniq ts ->
  (forall c, c \in ts -> ~~ row_full (seen_rational a R (A + c *: A1) (B + c *: B1))) -> (size ts <= n * (q + r))%N.
Proof. exact: RationalSeen.seen_rational_almost_every. Qed.

(** With at least one input, n past ones or more, and s and q + s successive ones that excite, it has full rank at some (A, B), A being
    nilpotent. *)
Theorem mean_rational_somewhere (K : fieldType) (E : (nat -> K) -> K -> Prop) n nu (u : nat -> 'rV_nu) r (a : nat -> K) q s R :
  mean E -> covariance E (successive 0 (r + q + s) u) (successive 0 (r + q + s) u) R -> excites E s u -> excites E (q + s) u ->
  a r = 1 -> (0 < nu)%N -> (n <= q)%N ->
  exists (A : 'M_n) (B : 'M_(nu, n)), iter n (mulmxr A) 1%:M = 0 /\ row_full (seen_rational a R A B).
Proof. move=> isE; exact: (RationalMeans.rational_somewhere isE). Qed.
