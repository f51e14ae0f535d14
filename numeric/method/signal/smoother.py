"""This smooths the fault signal of one stretch of the residual in memory: v and x such that the simulated residual equals the given one.

    smoothed            the smoother for r, A, F, C, G, with the initial state known or not
    Solution            delay, zeros, the samples to be trusted, and why not the others
    Stretch             a Solution with v, x and simulated in memory
    simulated           x and C x + G v from v and the initial state
    linear_recursion    x(k+1) = A x(k) + drive(k) in about 2 sqrt(N) steps
    delay               v(k) is first seen in r(k + delay): at the end of the record some samples of v are not
                        determined and come out small
    trusted             samples of v that no zero and no delay disturbs

The least squares problem min sum |r - C x - G v|^2 + eps^2 |v|^2 is solved for the whole record at once in time
proportional to N: backward, the cost still to come is |S_k x - t_k|^2, a QR step each; forward, v(k) = K_k x(k) +
c_k. S and K do not depend on the data and settle after a few steps. eps makes the forward recursion stable whatever
the zeros; its bias is removed by solving again for what is left over, with the same gains (iterated regularisation).

What no method can do: a finite zero q hides the trajectories q^k. Inside the unit circle and with x(0) unknown, they
disturb the first samples, dying out like |q|^k; outside, the last ones, like |q|^-(N-k), although the future of r
was used; on the circle, all of them. Source: [HP98], [MZ10], [K11].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ..ranks.arguments import shaped
from ..ranks.sample_windows import ObservedCoordinates, observed_coordinates
from .pair_zeros import FaultZeros, fault_zeros

# Weight of v beside r, both of unit size: small enough to hide, large enough that rounding / REGULARISATION is still
# small.
REGULARISATION = 1e-5
REFINEMENTS = 20
# A zero's disturbance is trusted to be gone when it has shrunk to this.
FADED = 1e-6
# Steps after which gains that have not settled are used as they are (zeros on the unit circle); refinement makes up
# for it.
MOST_GAINS = 5000
SETTLED = 1e-13  # relative change of a refinement at the level of rounding


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class Solution:
    """What is known of a fault signal beside its values; the docstring of `Reconstruction` explains the fields one by one."""

    delay: int | None
    trusted: tuple[int, int]
    zeros: NDArray[np.complex128]
    left_invertible: bool
    misfit: float
    reason: str
    x0: Array
    pair: tuple[Array, Array, Array, Array]


@dataclass(frozen=True, eq=False, kw_only=True)
class Stretch(Solution):
    """One stretch of a solution: the signal v (N, m), the states x (N, n) of x(k+1) = A x + F v, and `simulated` = C x + G v (N,
    p)."""

    v: Array
    x: Array
    simulated: Array


def smoothed(r: ArrayLike, A: ArrayLike, F: ArrayLike, C: ArrayLike, G: ArrayLike, *, x0: ArrayLike | None = None) -> Stretch:
    """Find v and x from r (N, p) for A (n, n), F (n, m), C (p, n), G (p, m); x0 (n,) if the initial state is known.

    Raises InvalidData for shapes that do not fit, values that are not finite, more faults than outputs, a fault
    without any effect, or a model so unstable that the record overflows.
    """
    r, A, C = shaped(r, A, C)
    F, G, start = _faults(len(A), len(C), F, G, x0)
    N, n, m = len(r), len(A), F.shape[1]
    growth = max((float(np.max(np.abs(np.linalg.eigvals(A)))) if n else 0.0), 1.0)
    if N * np.log10(growth) > 100:
        raise InvalidData(
            f"A: has an eigenvalue of modulus {growth:.4g}, which grows to 1e{N * np.log10(growth):.0f} over {N} "
            "samples; reconstruct from shorter pieces of the record or take a stable model"
        )
    coordinates = observed_coordinates(r, A, C, n + 1)
    columns = np.vstack([coordinates.T @ F, G / coordinates.scale[:, None]])
    sizes = np.linalg.norm(columns, axis=0)
    if np.any(sizes == 0):
        raise InvalidData(f"F, G: fault {int(np.argmin(sizes))} has a zero column in both, so that r cannot tell its signal; leave it out")
    columns = columns / sizes
    limits = fault_zeros(coordinates.A, columns[:n], coordinates.C, columns[n:])
    smoother = _Smoother(coordinates, columns[:n], columns[n:], N)
    v, x_start = _refined(smoother, r / coordinates.scale, None if start is None else coordinates.T @ start)
    v = v / sizes
    initial = np.asarray(np.linalg.solve(coordinates.T, x_start)) if start is None else start
    x, response = simulated(A, F, C, G, initial, v)
    size = float(np.linalg.norm(r))
    misfit = float(np.linalg.norm(r - response)) / size if size else 0.0
    delay = limits.delay_known_state if start is not None or limits.delay_unknown_state is None else limits.delay_unknown_state
    trusted, reason = _limits(N, m, limits, delay, start is not None)
    return Stretch(
        delay=delay,
        trusted=trusted,
        zeros=limits.zeros,
        left_invertible=limits.left_invertible,
        misfit=misfit,
        reason=reason,
        x0=initial,
        pair=(A, F, C, G),
        v=v,
        x=x,
        simulated=response,
    )


def _faults(n: int, p: int, F: ArrayLike, G: ArrayLike, x0: ArrayLike | None) -> tuple[Array, Array, Array | None]:
    F, G = (np.array(matrix, dtype=float, ndmin=2) for matrix in (F, G))
    m = G.shape[1]
    if F.shape != (n, m) or G.shape != (p, m):
        raise InvalidData(f"F, G: got shapes {F.shape} and {G.shape}; needed ({n}, n_v) and ({p}, n_v), columns even for one fault")
    if not (np.all(np.isfinite(F)) and np.all(np.isfinite(G))):
        raise InvalidData("F, G: got entries that are NaN or infinite, expected finite ones")
    if not 1 <= m <= p:
        raise InvalidData(
            f"F, G: got {counted(m, 'fault')} for {counted(p, 'output')}; needed 1 <= n_v <= "
            f"p. Choose n_v columns of a fault space, as [F P; G P]"
        )
    if x0 is None:
        return F, G, None
    start = np.array(x0, dtype=float).reshape(-1)
    if start.shape != (n,) or not np.all(np.isfinite(start)):
        raise InvalidData(
            f"x0: got {counted(start.shape[0], 'entry', 'entries')}; needed {n} finite ones, or None if the initial state is not known"
        )
    return F, G, start


@dataclass(frozen=True)
class _Gains:
    """The gains make v = from_r r + from_t t - from_x x, and the cost to come before this sample |S x - (t_from_r r + t_from_t t)|^2."""

    from_x: Array
    from_r: Array
    from_t: Array
    S: Array
    t_from_r: Array
    t_from_t: Array


class _Smoother:
    """The smoother holds the gains for N samples, counted from the end; they repeat once S has settled."""

    def __init__(self, coordinates: ObservedCoordinates, F: Array, G: Array, samples: int) -> None:
        self.A, self.F, self.C, self.G = coordinates.A, F, coordinates.C, G
        self.gains: list[_Gains] = []
        n = len(F)
        S = np.zeros((n, n))
        for _ in range(min(samples, MOST_GAINS)):
            self.gains.append(self._before(S))
            change = np.max(np.abs(self.gains[-1].S - S), axis=1, initial=0.0)
            sizes = np.max(np.abs(S), axis=1, initial=0.0)
            S = self.gains[-1].S
            if np.all(change <= SETTLED * np.maximum(sizes, 1e-3 * REGULARISATION)):
                break

    def _before(self, S: Array) -> _Gains:
        """Eliminate v from eps v = 0, G v = r - C x, S F v = t - S A x by QR; what is left is about x alone."""
        n, m = self.F.shape
        p = self.C.shape[0]
        of_v = np.vstack([REGULARISATION * np.eye(m), self.G, S @ self.F])
        of_x = np.vstack([np.zeros((m, n)), self.C, S @ self.A])
        Q, R = np.linalg.qr(np.hstack([of_v, of_x]))
        signs = np.where(np.diag(R) < 0, -1.0, 1.0)
        Q, R = Q * signs, R * signs[:, None]
        top = np.linalg.solve(R[:m, :m], np.hstack([R[:m, m:], Q[m:, :m].T]))
        below = Q[m:, m:].T
        return _Gains(top[:, :n], top[:, n : n + p], top[:, n + p :], R[m:, m:], below[:, :p], below[:, p:])

    def solve(self, r: Array, start: Array | None) -> tuple[Array, Array]:
        """Return v (N, m) and x(0) for r (N, p), regularised."""
        N = len(r)
        n, m = self.F.shape
        steady, settling = self.gains[-1], min(len(self.gains), N)
        # t[k] belongs to the cost from sample k on; t[N] = 0.
        t = np.zeros((N + 1, n))
        for j in range(settling):
            k, gain = N - 1 - j, self.gains[j]
            t[k] = gain.t_from_r @ r[k] + gain.t_from_t @ t[k + 1]
        drive, step = r[: N - settling] @ steady.t_from_r.T, steady.t_from_t
        t[: N - settling + 1] = linear_recursion(step, drive[::-1], t[N - settling])[::-1]
        x = np.linalg.lstsq(self.gains[settling - 1].S, t[0], rcond=None)[0] if start is None else start
        x0 = x
        v = np.zeros((N, m))
        given = r @ steady.from_r.T + t[1:] @ steady.from_t.T
        closed, push = self.A - self.F @ steady.from_x, given @ self.F.T
        states = linear_recursion(closed, push[: N - settling], x)
        x = states[-1]
        v[: N - settling] = given[: N - settling] - states[:-1] @ steady.from_x.T
        for k in range(N - settling, N):
            gain = self.gains[N - 1 - k]
            v[k] = gain.from_r @ r[k] + gain.from_t @ t[k + 1] - gain.from_x @ x
            x = self.A @ x + self.F @ v[k]
        return v, x0


def _refined(smoother: _Smoother, r: Array, start: Array | None) -> tuple[Array, Array]:
    """Return the solution plus the solutions for what it leaves over, until that stops shrinking."""
    v, x0 = smoother.solve(r, start)
    matrices = smoother.A, smoother.F, smoother.C, smoother.G
    left = r - simulated(*matrices, x0, v)[1]
    for _ in range(REFINEMENTS):
        more, shift = smoother.solve(left, None if start is None else np.zeros_like(x0))
        tried = r - simulated(*matrices, x0 + shift, v + more)[1]
        if not np.linalg.norm(tried) < np.linalg.norm(left):
            break
        enough = np.linalg.norm(tried) > 0.9 * np.linalg.norm(left)
        v, x0, left = v + more, x0 + shift, tried
        if enough:
            break
    return v, x0


def simulated(A: Array, F: Array, C: Array, G: Array, x0: Array, v: Array) -> tuple[Array, Array]:
    """Return x (N, n) and C x + G v (N, p) of x(k+1) = A x + F v from x(0) = x0 (n,)."""
    x = linear_recursion(A, v @ F.T, x0)[:-1]
    return x, x @ C.T + v @ G.T


def linear_recursion(A: Array, drive: Array, start: Array) -> Array:
    """Return x (N + 1, n) with x(0) = start, x(k+1) = A x(k) + drive(k), for drive (N, n).

    Blocks of about sqrt(N) samples run side by side from zero; then their starts one after the other: 2 sqrt(N) steps.
    """
    N, n = drive.shape
    size = max(int(np.sqrt(N)), 1)
    count = -(-N // size)
    padded = np.zeros((count * size, n))
    padded[:N] = drive
    blocks = padded.reshape(count, size, n)
    local, powers = np.zeros((count, size + 1, n)), np.empty((size + 1, n, n))
    powers[0] = np.eye(n)
    for k in range(size):
        local[:, k + 1] = local[:, k] @ A.T + blocks[:, k]
        powers[k + 1] = A @ powers[k]
    starts = np.empty((count + 1, n))
    starts[0] = start
    for b in range(count):
        starts[b + 1] = powers[size] @ starts[b] + local[b, size]
    x = local[:, :size] + np.einsum("kij,bj->bki", powers[:size], starts[:-1])
    # The last start is x(N) where the blocks fit exactly; where they do not, it lies beyond.
    return np.vstack([x.reshape(count * size, n), starts[-1:]])[: N + 1]


def _limits(N: int, m: int, limits: FaultZeros, delay: int | None, known: bool) -> tuple[tuple[int, int], str]:
    """Return the samples that nothing disturbs, and the sentence about the others."""
    zeros, tail = limits.zeros, limits.delay_known_state
    if delay is None or tail is None:
        return (0, 0), f"not left-invertible: other signals of {counted(m, 'fault')} give the same residual; v is one, a small one"
    if delay >= N:
        return (0, 0), f"the record is no longer than the delay of {counted(delay, 'sample')}: v is not determined"
    sizes = np.abs(zeros)
    moduli = ", ".join(f"{size:.4g}" for size in sizes)
    # At the end of a long record the state is known from the past, so that the shorter delay counts there.
    first, last = 0, N - tail
    sentences = [
        f"v is seen after {counted(delay, 'sample')}"
        + (f", {'the last is' if tail == 1 else f'the last {tail} are'} not determined" if tail else "")
    ]
    inside, outside = sizes[sizes < 1], sizes[sizes > 1]
    if inside.size and not known:
        first = min(_fading(float(inside.max()), N), N)
        sentences.append(
            f"zeros inside the unit circle leave "
            f"{'the first sample' if first == 1 else f'the first {first} samples'} to the unknown initial state"
        )
    if outside.size:
        lost = min(_fading(1 / float(outside.min()), N), N)
        last = max(last - lost, 0)
        sentences.append(f"zeros outside the unit circle leave the last {lost} uncertain, although the future was used")
    if np.any(np.isclose(sizes, 1, atol=1e-6, rtol=0)):
        sentences.append(f"a zero on the unit circle disturbs every sample (moduli {moduli})")
        return (0, 0), "; ".join(sentences)
    return (first, last), "; ".join(sentences) + (f" (moduli of the zeros: {moduli})" if zeros.size else "")


def _fading(rate: float, most: int) -> int:
    """Return samples until rate^k has fallen to FADED."""
    return 1 if rate == 0 else min(int(np.ceil(np.log(FADED) / np.log(rate))), most)
