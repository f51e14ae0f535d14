(** Words for the statements about means of signals (HeadlinesMeans.v): consistency without measure theory. A signal is a sequence of row
    vectors, and a mean is any shift-invariant linear functional of sequences that is defined where it is asked for: quasi-stationary
    signals in Ljung's sense. The limit of time averages is one (time_average) where no number is infinite, and so is, over an ordered
    field, the average over a period (period_average). Population covariances are its values.

                             mean E == E f a, read: f has the mean a, is true of one a at most, linear, and the same where f starts
                                       later
                          later k x == x begun k samples later
                 covariance E x y R == x(t)_i y(t)_j has the mean R_ij
               quasi_stationary E x == x has covariances with itself at all lags
                 uncorrelated E x y == at all lags, of both signs
         knows_nothing_before E x y == x is uncorrelated with what y was before, and is now
                 successive k s r t == r(t+k), ..., r(t+k+s-1) side by side
                      excites E s u == s successive samples of u have a regular covariance
                  limit E Z Uf Yf L == what PI-MOESP and PO-MOESP converge to
                    white_noise E w == of unit covariance, and uncorrelated at different times
     autoregressive_input E a A u e == u is autoregressive of order a, with the innovations e
           backward_error E r u c b == b(t) is the error of u(t), given the r inputs after it with the weights c
            forward_error E r u d f == f(t) is the error of u(t+r), given the r inputs before it with the weights d
            order_of_spectrum E r u == the covariances of u satisfy a difference equation of order r
          spectrum_equation E r a u == they satisfy that with the coefficients a_0, ..., a_r, a_r = 1
    noisy_process S B D u v e w x y == the equations of the system with noise e of the states and w of the outputs
                 disturbances v e w == the faults and the noise side by side
       period_average, time_average == the average over a period, and the limit of the averages over the times before N
                         positive E == no square has a negative mean
                           stable A == some power of A is as small as one likes
                      archimedean K == K has no infinite numbers *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly ssrnum matrix.
From faultspace Require Import Vocabulary.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Means.
Variable K : fieldType.
Implicit Types (E : (nat -> K) -> K -> Prop).

(** E f a is read: the sequence f has the mean a. At most one; linear; the same where f starts later. *)
Definition mean E := [/\ forall f a b, E f a -> E f b -> a = b, forall f g a, f =1 g -> E f a -> E g a, E (fun=> 0) 0,
  forall f g a b c, E f a -> E g b -> E (fun t => c * f t + g t) (c * a + b) & forall f a, E f a -> E (fun t => f t.+1) a].

Variable E : (nat -> K) -> K -> Prop.

(** x begun k samples later. *)
Definition later T k (x : nat -> T) t := x (t + k)%N.

(** Cov(x, y) = R: x(t)_i y(t)_j has the mean R_ij. *)
Definition covariance a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) (R : 'M_(a, b)) := forall i j, E (fun t => x t 0 i * y t 0 j) (R i j).

(** x has covariances with itself at all lags. *)
Definition quasi_stationary a (x : nat -> 'rV[K]_a) := forall l, exists R, covariance x (later l x) R.

(** x and y are uncorrelated at all lags, of both signs; and x with what y was before, and is now. *)
Definition uncorrelated a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) :=
  forall l, covariance x (later l y) 0 /\ covariance (later l x) y 0.
Definition knows_nothing_before a b (x : nat -> 'rV[K]_a) (y : nat -> 'rV[K]_b) := forall l, covariance (later l x) y 0.

(** The samples r(t+k), ..., r(t+k+s-1) side by side, for each t. *)
Definition successive p k s (r : nat -> 'rV[K]_p) t : 'rV_(s * p) := future (t + k)%N s r.

(** s successive samples of u have a regular covariance. *)
Definition excites s nu (u : nat -> 'rV[K]_nu) := exists2 R, covariance (successive 0 s u) (successive 0 s u) R & R \in unitmx.

(** projected_limit, with means for covariances: what PI-MOESP converges to, Z being the q inputs before s samples, successive 0 q u, and Uf
    and Yf those, successive q s u and successive q s y; and PO-MOESP, the outputs before being in Z, too. *)
Definition limit z f g (Z : nat -> 'rV[K]_z) (Uf : nat -> 'rV[K]_f) (Yf : nat -> 'rV[K]_g) L := exists Rzu Ruu Rzy Ruy X,
  [/\ covariance Z Uf Rzu, covariance Uf Uf Ruu, covariance Z Yf Rzy, covariance Uf Yf Ruy & X *m Ruu = Rzu /\ L = Rzy - X *m Ruy].

(** w(t) is white: of unit covariance, and uncorrelated at different times. *)
Definition white_noise a (w : nat -> 'rV[K]_a) := forall l, covariance w (later l w) (if l == 0%N then 1%:M else 0).

(** u(t+a) = u(t+a-1) A_0 + ... + u(t) A_(a-1) + e(t+a): autoregressive of order a, where the innovation e has a regular covariance and
    knows nothing of earlier inputs. *)
Definition autoregressive_input a nu (A : nat -> 'M[K]_nu) (u e : nat -> 'rV[K]_nu) :=
  [/\ forall t, u (t + a)%N = \sum_(i < a) u (t + (a - i.+1))%N *m A i + e (t + a)%N, exists2 R, covariance e e R & R \in unitmx
    & knows_nothing_before (later 1 e) u].

(** The errors of linear prediction, backward and forward: b(t) = u(t) - sum_(i < r) u(t+1+i) c_i is uncorrelated with u(t+1), ..., u(t+r),
    and f(t) = u(t+r) - sum_(i < r) u(t+i) d_i with u(t), ..., u(t+r-1). *)
Definition backward_error r nu (u : nat -> 'rV[K]_nu) (c : nat -> 'M_nu) (b : nat -> 'rV_nu) :=
  (forall t, b t = u t - \sum_(i < r) u (t + i.+1)%N *m c i) /\ forall i, (0 < i <= r)%N -> covariance b (later i u) 0.
Definition forward_error r nu (u : nat -> 'rV[K]_nu) (d : nat -> 'M_nu) (f : nat -> 'rV_nu) :=
  (forall t, f t = u (t + r)%N - \sum_(i < r) u (t + i)%N *m d i) /\ forall i, (i < r)%N -> covariance f (later i u) 0.

(** The covariances of u from lag 1 on satisfy a difference equation of order r: sum_(i <= r) a_i Cov(u(t), u(t+l+i)) = 0, a_r = 1. So they
    do where a filter of r states makes u of a signal that knows nothing of earlier inputs (filtered_inputs). *)
Definition order_of_spectrum r nu (u : nat -> 'rV[K]_nu) := exists2 a : {poly K}, a \is monic /\ size a = r.+1 &
  forall l, covariance u (fun t => \sum_(i < r.+1) a`_i *: later (l.+1 + i)%N u t) 0.

(** That equation with given coefficients a_0, ..., a_r = 1. *)
Definition spectrum_equation r (a : nat -> K) nu (u : nat -> 'rV[K]_nu) :=
  a r = 1 /\ forall l, covariance u (fun t => \sum_(i < r.+1) a i *: later (l.+1 + i)%N u t) 0.

(** x(k+1) = x(k) A + u(k) B + v(k) F + e(k) and y(k) = x(k) C + u(k) D + v(k) G + w(k): noise e of the states, and w of the outputs. What
    disturbs is the faults and the noise, side by side. *)
Definition noisy_process n m p nu (S : system K n m p) (B : 'M_(nu, n)) (D : 'M_(nu, p)) (u : nat -> 'rV[K]_nu) (v : nat -> 'rV[K]_m)
    (e : nat -> 'rV[K]_n) (w : nat -> 'rV[K]_p) (x : nat -> 'rV[K]_n) (y : nat -> 'rV[K]_p) :=
  forall k, x k.+1 = x k *m sysA S + u k *m B + v k *m sysF S + e k /\ y k = x k *m sysC S + u k *m D + v k *m sysG S + w k.
Definition disturbances n m p (v : nat -> 'rV[K]_m) (e : nat -> 'rV[K]_n) (w : nat -> 'rV[K]_p) t := row_mx (row_mx (v t) (e t)) (w t).

(** The average over a period. *)
Definition period_average (f : nat -> K) a := exists2 d, (0 < d)%N & (forall t, f (t + d)%N = f t) /\ \sum_(t < d) f t = d%:R * a.

End Means.

Section Ordered.
Variable K : realFieldType.

(** No square has a negative mean. *)
Definition positive (E : (nat -> K) -> K -> Prop) := forall f a, E (fun t => f t ^+ 2) a -> 0 <= a.

(** A is stable: some power of it is as small as one likes. *)
Definition stable n (A : 'M[K]_n) := forall eps, 0 < eps -> exists k, forall i j, `|iter k (mulmxr A) 1%:M i j| < eps.

(** K has no infinite numbers. *)
Definition archimedean := forall a : K, exists k, a < k%:R.

(** The averages of f over the times before N converge to a. *)
Definition time_average (f : nat -> K) a :=
  forall eps, 0 < eps -> exists M, forall N, (M <= N)%N -> `|\sum_(t < N) f t - N%:R * a| <= N%:R * eps.

End Ordered.
