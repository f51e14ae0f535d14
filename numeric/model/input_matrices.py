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

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import lstsq, qr, solve_triangular

from ...base.arrays import Array
from ...base.errors import InvalidData
from ..model.compression import Compression
from ..model.models import observability_matrix
from ..model.sequential_qr import append_rows

ENTRIES = 1 << 18  # entries of the matrices built at once
CONDENSED = 512  # length up to which block vectors are gathered before they are mapped
Pieces = Iterable[tuple[Array, Array]]


@dataclass(frozen=True, eq=False)
class InputMatrices:
    """These are B (n, n_u), D (p, n_u), one initial state (n,) an experiment where the data were read, and the condition of the scaled
    regression."""

    B: Array
    D: Array
    initial_states: tuple[Array, ...]
    condition: float


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

    B's columns are the responses of x(k+1) = A x(k) + e_i u_j(k) for each i and j. All rows of a block of samples are one linear map of a
    short vector: the states of those responses at the block's start, and its inputs and outputs. Where that vector is short enough
    (CONDENSED), the factor of the vectors is gathered first and mapped once at the end, which costs far less than mapping every block.
    """

    def __init__(self, A: Array, C: Array, n_u: int) -> None:
        (self.p, self.n), self.n_u = C.shape, n_u
        n, p = self.n, self.p
        self.width = n + n_u * n + n_u * p + 1
        self.block = max(4, min(32, int((ENTRIES / max(1, p * n)) ** 0.5)))
        self._length = (1 + n_u) * n * n + self.block * (n_u + p)
        self._condenses = self._length <= CONDENSED
        self._mapped_at_once = max(1, ENTRIES // (self.block * p * self.width))
        powers = observability_matrix(A, np.eye(n), self.block).reshape(self.block, n, n)
        self._free = (C @ powers).reshape(self.block * p, n)
        # forced[l, t] = C A^(t-1-l) for t > l: what input sample l of a block does to output sample t of it.
        forced = np.zeros((self.block, self.block, p, n))
        for sample in range(self.block - 1):
            forced[sample, sample + 1 :] = (C @ powers)[: self.block - 1 - sample]
        self._forced = forced.reshape(self.block, self.block * p * n)
        self._reach = powers[::-1].reshape(self.block, n * n)
        self._step = powers[-1] @ A
        # States of the responses at the next block: the first to x0, then one matrix an input.
        self._states = np.zeros((1 + n_u, n, n))
        self._states[0] = np.eye(n)
        self._vectors_factor = np.zeros((self._length,) * 2 if self._condenses else (0, 0), order="F")
        self._factor = np.zeros((self.width, self.width), order="F")

    def take(self, y: Array, u: Array) -> None:
        """Take the next samples: whole blocks, but for the end of the experiment."""
        whole = len(y) // self.block
        at_once = max(1, ENTRIES // (2 * self._length)) if self._condenses else self._mapped_at_once
        for first in range(0, whole, at_once):
            part = slice(first * self.block, min(first + at_once, whole) * self.block)
            vectors = self._vectors(y[part], u[part])
            if self._condenses:
                self._vectors_factor = append_rows(self._vectors_factor, vectors)
            else:
                self._map(vectors, part.stop - part.start)
        rest = len(y) - whole * self.block
        if rest:
            # Zeros fill the block up, and their rows are cut off.
            filled = [np.concatenate([part[-rest:], np.zeros((self.block - rest, part.shape[1]))]) for part in (y, u)]
            self._map(self._vectors(filled[0], filled[1]), rest)

    def factor(self) -> Array:
        """Return the triangular factor of all rows taken; nothing can be taken afterwards."""
        if self._condenses:
            vectors = np.triu(self._vectors_factor)
            for first in range(0, len(vectors), self._mapped_at_once):
                part = vectors[first : first + self._mapped_at_once]
                self._map(part, len(part) * self.block)
        return np.triu(self._factor)

    def _vectors(self, y: Array, u: Array) -> Array:
        """Return one row a block: states (x0's, then each input's), inputs, outputs, each channel's samples together."""
        count, n = len(y) // self.block, self.n
        states = np.empty((1 + self.n_u, count, n, n))
        pushes = np.zeros((1 + self.n_u, count, n, n))
        channels = np.concatenate([u, y], axis=1).T.reshape(-1, count, self.block)
        pushes[1:] = (channels[: self.n_u] @ self._reach).reshape(self.n_u, count, n, n)
        state = self._states
        for k in range(count):
            states[:, k] = state
            state = self._step @ state + pushes[:, k]
        self._states = state
        vectors = np.empty((count, self._length), order="F")
        held = (1 + self.n_u) * n * n
        vectors[:, :held] = states.reshape(1 + self.n_u, count, n * n).transpose(1, 0, 2).reshape(count, held)
        vectors[:, held:] = channels.transpose(1, 0, 2).reshape(count, -1)
        return vectors

    def _map(self, vectors: Array, samples: int) -> None:
        """Append the rows that belong to block vectors (count, length), the first `samples` of them."""
        n, p, count = self.n, self.p, len(vectors)
        held = (1 + self.n_u) * n * n
        channels = vectors[:, held:].reshape(count, self.n_u + p, self.block)
        rows = np.zeros((samples, p, self.width), order="F")
        for number in range(1 + self.n_u):
            states = vectors[:, number * n * n : (number + 1) * n * n].reshape(count, n, n)
            response = (self._free @ states).reshape(count * self.block, p, n)
            if number:
                response += (channels[:, number - 1] @ self._forced).reshape(count * self.block, p, n)
            rows[:, :, number * n : (number + 1) * n] = response[:samples]
        start = n + self.n_u * n
        series = channels.transpose(0, 2, 1).reshape(count * self.block, -1)[:samples]
        for output in range(p):
            rows[:, output, start + output * self.n_u : start + (output + 1) * self.n_u] = series[:, : self.n_u]
        rows[:, :, -1] = series[:, self.n_u :]
        self._factor = append_rows(self._factor, rows.reshape(samples * p, self.width, order="F"))


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
    factors = []
    for data in experiments:
        regression = _Regression(A, C, n_u)
        with np.errstate(over="ignore", invalid="ignore"):
            for y, u in _full_batches(data, regression.block):
                regression.take(y, u)
            factor = regression.factor()
        if not np.all(np.isfinite(factor)):
            raise InvalidData("the model is so unstable that its simulation overflows: take B and D by MOESP's regression (by_moesp)")
        factors.append(factor)
    # Rows below an experiment's x0 are what it tells of B and D alone.
    shared = np.concatenate([factor[n:, n:] for factor in factors])
    solution, condition = _least_squares(shared[:, :-1], shared[:, -1])
    states = []
    for factor in factors:
        start, own = _least_squares(factor[:n, :n], factor[:n, -1] - factor[:n, n:-1] @ solution)
        states.append(start)
        condition = max(condition, own) if n else condition
    B = solution[: n_u * n].reshape(n_u, n).T
    return InputMatrices(np.ascontiguousarray(B), solution[n_u * n :].reshape(p, n_u).copy(), tuple(states), condition)
