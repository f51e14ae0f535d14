"""B and D once A and C are known: by MOESP's own regression from a compression, or by output-error least squares from the data.

MOESP [V93]: with the orthonormal complement U2 of O_s, U2^T L31 L11^-1 = U2^T T_s(B, D), linear in B and D. It needs the compression
alone, and minimises the Frobenius norm of Pi (L31 L11^-1 - T_s(B, D)), Pi = U2 U2^T.

Output error [VV07, ch. 7]: y(k) = C A^k x0 + sum_(l<k) C A^(k-1-l) B u(l) + D u(k) + e(k) is linear in x0, B and D; the least sum of
|e(k)|^2 is found by a sequential QR over pieces, in memory independent of N, with an own x0 for each experiment. Where A is unstable the
powers drown the data: `growth` tells.

InputMatrices           B, D, the initial states (none from MOESP's regression), the condition number of the regression
by_moesp                from a Compression
by_output_error         from experiments, each an iterable of pieces (y, u)
growth                  how much A amplifies over N samples
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import lstsq, qr, solve_triangular

from ....base.arrays import Array
from ....base.errors import InvalidData
from .compression import Compression
from .models import observability_matrix
from .recursion import Recursion, power_basis
from .sequential_qr import append_rows

ENTRIES = 1 << 17  # entries of the matrices built at once
BLOCK, LONGEST_BLOCK = 8, 32  # samples of a block
Pieces = Iterable[tuple[Array, Array]]


@dataclass(frozen=True, eq=False)
class InputMatrices:
    """B (n, n_u), D (p, n_u), one initial state (n,) an experiment where the data were read, the condition of the scaled
    regression, and where the data were read the sum `squares` (p, p) of r(k) r(k)^T over all samples, r being what the model leaves."""

    B: Array
    D: Array
    initial_states: tuple[Array, ...]
    condition: float
    squares: Array | None = None


def _least_squares(matrix: Array, right: Array) -> tuple[Array, float]:
    """Return the least-squares solution with columns scaled to equal length (shortest where rank is lacking), and the condition of the
    scaled matrix.
    """
    lengths = np.linalg.norm(matrix, axis=0)
    lengths[lengths == 0] = 1.0
    solution, _, _, values = lstsq(matrix / lengths, right, cond=len(lengths) * np.finfo(np.float64).eps, check_finite=False)
    condition = 1.0 if not len(values) else float("inf") if values[-1] == 0 else float(values[0] / values[-1])
    return (solution.T / lengths).T, condition


def by_moesp(compression: Compression, A: Array, C: Array) -> InputMatrices:
    """Find B and D by MOESP's regression [V93] on the compression, for A (n, n) and C (p, n) with s p > n."""
    s, p, n_u, n = compression.block_rows, compression.p, compression.n_u, len(A)
    parts = compression.blocks()
    observability = observability_matrix(A, C, s)
    annihilator = qr(observability, check_finite=False)[0][:, n:].T
    # L31 L11^-1, from L11^T X^T = L31^T.
    target = annihilator @ solve_triangular(parts.l11, parts.l31.T, trans="T", lower=True, check_finite=False).T
    # Against input block k stand D, times the annihilator's block k, and B, times its later blocks on O.
    regressors, targets = [], []
    for k in range(s):
        later = annihilator[:, (k + 1) * p :]
        through_state = later @ observability[: later.shape[1]]
        regressors.append(np.hstack([annihilator[:, k * p : (k + 1) * p], through_state]))
        targets.append(target[:, k * n_u : (k + 1) * n_u])
    solution, condition = _least_squares(np.concatenate(regressors), np.concatenate(targets))
    return InputMatrices(solution[p:], solution[:p], (), condition)


def growth(A: Array, samples: int) -> float:
    """Return the largest modulus of an eigenvalue of A to the power `samples` (inf where it overflows), 0 without states."""
    radius = float(np.max(np.abs(np.linalg.eigvals(A)), initial=0.0))
    with np.errstate(over="ignore"):
        return float(np.float64(radius) ** samples)


class _Regression:
    """The object takes the rows (y(k); x0, B, D) of one experiment piece by piece into a triangular factor with the columns [x0, B, D, y].

    B's columns are the responses of X(k+1) = A X(k) + I u_j(k), whose states are polynomials in A and told by a few coordinates. All rows
    of a block of samples are one linear map of a short vector: these coordinates at the block's start, and its inputs and outputs. The
    factor of the vectors is gathered, and mapped once at the end.
    """

    def __init__(self, A: Array, C: Array, n_u: int) -> None:
        (self.p, self.n), self.n_u = C.shape, n_u
        n, p = self.n, self.p
        self.width = n + n_u * n + n_u * p + 1
        basis = power_basis(A)
        self._basis = basis.matrices.reshape(-1, n * n)
        d = len(self._basis)
        self._held = (1 + n_u) * d
        # About as many samples as coordinates make the factor of the vectors cheapest.
        self.block = min(LONGEST_BLOCK, max(BLOCK, self._held // (n_u + p)))
        self._length = self._held + self.block * (n_u + p)
        powers = observability_matrix(A, np.eye(n), self.block).reshape(self.block, n, n)
        self._free = (C @ powers).reshape(self.block * p, n)
        # forced[l, t] = C A^(t-1-l) for t > l: what input sample l of a block does to output sample t of it.
        forced = np.zeros((self.block, self.block, p, n))
        for sample in range(self.block - 1):
            forced[sample, sample + 1 :] = (C @ powers)[: self.block - 1 - sample]
        self._forced = forced.reshape(self.block, self.block * p * n)
        steps = observability_matrix(basis.H, np.eye(d), self.block).reshape(self.block, d, d)
        self._reach = (steps @ basis.identity)[::-1]
        self._recursion = Recursion(steps[-1] @ basis.H)
        # Coordinates of the responses at the next block: the first to x0, then one row an input.
        self._states = np.zeros((1 + n_u, d))
        self._states[0] = basis.identity
        self._vectors_factor = np.zeros((self._length,) * 2, order="F")
        self._last = np.empty((0, p, self.width))

    def take(self, y: Array, u: Array) -> None:
        """Take the next samples: whole blocks, but for the end of the experiment."""
        joint = np.concatenate([u, y], axis=1)
        whole, at_once = len(joint) // self.block, max(self._length, ENTRIES // self._length)
        for first in range(0, whole, at_once):
            part = joint[first * self.block : min(first + at_once, whole) * self.block]
            self._vectors_factor = append_rows(self._vectors_factor, self._vectors(part))
        rest = len(joint) - whole * self.block
        if rest:
            # Zeros fill the block up, and their rows are cut off.
            filled = np.zeros((self.block, joint.shape[1]))
            filled[:rest] = joint[-rest:]
            self._last = self._rows(self._vectors(filled))[:rest]

    def rows(self) -> Iterator[Array]:
        """Yield arrays (any, p, width) whose rows have the triangular factor of all rows taken, in total and for each pair of outputs."""
        vectors = np.triu(self._vectors_factor)
        at_once = max(1, ENTRIES // (self.block * self.p * self.width))
        for first in range(0, len(vectors), at_once):
            yield self._rows(vectors[first : first + at_once])
        yield self._last

    def factor(self) -> Array:
        """Return the triangular factor (width, width) of all rows taken."""
        factor = np.zeros((self.width, self.width), order="F")
        for rows in self.rows():
            factor = append_rows(factor, np.array(rows.reshape(-1, self.width), order="F"))
        return np.triu(factor)

    def squares(self, solution: Array) -> Array:
        """Return the sum (p, p) of r(k) r(k)^T over all samples taken, r being what [x0, B, D] leaves of y."""
        total = np.zeros((self.p, self.p))
        for rows in self.rows():
            r = rows[:, :, -1] - rows[:, :, :-1] @ solution
            total += r.T @ r
        return total

    def _vectors(self, joint: Array) -> Array:
        """Return one row a block: coordinates (x0's, then each input's), then the samples [u, y]."""
        count = len(joint) // self.block
        samples = joint.reshape(count, self.block, -1)
        pushes = np.zeros((count, *self._states.shape))
        pushes[:, 1:] = samples[:, :, : self.n_u].swapaxes(1, 2) @ self._reach
        states = self._recursion.states(pushes, self._states)
        self._states = states[-1]
        vectors = np.empty((count, self._length), order="F")
        vectors[:, : self._held] = states[:-1].reshape(count, self._held)
        vectors[:, self._held :] = samples.reshape(count, -1)
        return vectors

    def _rows(self, vectors: Array) -> Array:
        """Return the rows (samples, p, width) that belong to block vectors (count, length)."""
        n, p, count = self.n, self.p, len(vectors)
        states = (vectors[:, : self._held].reshape(count, 1 + self.n_u, -1) @ self._basis).reshape(count, 1 + self.n_u, n, n)
        samples = vectors[:, self._held :].reshape(count, self.block, -1)
        rows = np.zeros((count * self.block, p, self.width))
        for number in range(1 + self.n_u):
            response = (self._free @ states[:, number]).reshape(count * self.block, p, n)
            if number:
                response += (samples[:, :, number - 1] @ self._forced).reshape(count * self.block, p, n)
            rows[:, :, number * n : (number + 1) * n] = response
        start = n + self.n_u * n
        series = samples.reshape(count * self.block, -1)
        for output in range(p):
            rows[:, output, start + output * self.n_u : start + (output + 1) * self.n_u] = series[:, : self.n_u]
        rows[:, :, -1] = series[:, self.n_u :]
        return rows


def _full_batches(data: Pieces, size: int) -> Pieces:
    """Return the same samples in pieces of a multiple of `size`, but for the last."""
    kept: list[tuple[Array, Array]] = []
    length = 0
    for piece in data:
        kept.append(piece)
        length += len(piece[0])
        if length >= size:
            y, u = (np.concatenate(parts) for parts in zip(*kept, strict=True)) if len(kept) > 1 else kept[0]
            whole = length - length % size
            yield y[:whole], u[:whole]
            kept, length = [(y[whole:], u[whole:])], length - whole
    if length:
        y, u = (np.concatenate(parts) for parts in zip(*kept, strict=True))
        yield y, u


def by_output_error(experiments: Sequence[Pieces], A: Array, C: Array, n_u: int) -> InputMatrices:
    """Find B, D and the initial states of the least sum of squared output errors over all samples of all experiments, for A (n, n), C (p,
    n) and n_u inputs.

    An experiment is an iterable of pieces y (T, p), u (T, n_u) of float64. InvalidData where the powers of A overflow.
    """
    n, p = len(A), len(C)
    regressions, factors = [], []
    for data in experiments:
        regression = _Regression(A, C, n_u)
        with np.errstate(over="ignore", invalid="ignore"):
            for y, u in _full_batches(data, regression.block):
                regression.take(y, u)
            factor = regression.factor()
        if not np.all(np.isfinite(factor)):
            raise InvalidData("the model is so unstable that its simulation overflows: take B and D by MOESP's regression (by_moesp)")
        regressions.append(regression)
        factors.append(factor)
    # Rows below an experiment's x0 are what it tells of B and D alone.
    shared = np.concatenate([factor[n:, n:] for factor in factors])
    solution, condition = _least_squares(shared[:, :-1], shared[:, -1])
    states, squares = [], np.zeros((p, p))
    for regression, factor in zip(regressions, factors, strict=True):
        start, own = _least_squares(factor[:n, :n], factor[:n, -1] - factor[:n, n:-1] @ solution)
        states.append(start)
        squares += regression.squares(np.concatenate([start, solution]))
        condition = max(condition, own) if n else condition
    B = np.ascontiguousarray(solution[: n_u * n].reshape(n_u, n).T)
    return InputMatrices(B, solution[n_u * n :].reshape(p, n_u).copy(), tuple(states), condition, squares)
