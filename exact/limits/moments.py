"""These are stationary covariances of an experiment's signals, and of windows of them.

    Covariances        of a joint process: sequences and block Toeplitz matrices
    toeplitz           the block Toeplitz matrix of a sequence
    covariances        from an Experiment; solves the Lyapunov equation
    WindowCovariances  the blocks that the limits are made of, with Yf = (y(k); ...; y(k+s-1)), Up = (u(k-past); ...; u(k-1)) and so on
    window_covariances from an Experiment and its Covariances; refuses inputs that do not excite s + past block rows

Lags: sequence(a, b, l) is Cov(a(k+l), b(k)).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...base.errors import InvalidInput
from ..algebra.fields import QQ, base_matrix
from ..algebra.matrices import Matrix, rank
from .experiments import Experiment
from .lyapunov import state_covariance
from .process import JointProcess, Signal, joint_process


@dataclass(frozen=True)
class Covariances:
    """A joint process with the covariance P of its state, N x N."""

    process: JointProcess
    P: Matrix

    def now(self, a: Signal, b: Signal) -> Matrix:
        """Return Cov(a(k), b(k))."""
        return a.H @ self.P @ b.H.transposed() + a.J @ b.J.transposed()

    def with_next_state(self, b: Signal) -> Matrix:
        """Return Cov(xi(k+1), b(k)), N x rows of b."""
        return self.process.Phi @ (self.P @ b.H.transposed()) + self.process.Gamma @ b.J.transposed()

    def forward(self, a: Signal, b: Signal, most: int) -> list[Matrix]:
        """Return Cov(a(k+l), b(k)) for l = 0..most."""
        result = [self.now(a, b)]
        reached = self.with_next_state(b)
        for lag in range(1, most + 1):
            result.append(a.H @ reached)
            if lag < most:
                reached = self.process.Phi @ reached
        return result

    def sequence(self, a: Signal, b: Signal, least: int, most: int) -> dict[int, Matrix]:
        """Return Cov(a(k+l), b(k)) for l = least..most, either sign."""
        result, ahead = {}, list[Matrix]()
        if most >= 0:
            ahead = self.forward(a, b, most)
            result = {lag: block for lag, block in enumerate(ahead) if lag >= least}
        if least < 0:
            backward = ahead if a is b and len(ahead) > -least else self.forward(b, a, -least)
            result |= {-lag: backward[lag].transposed() for lag in range(max(1, -most), -least + 1)}
        return result

    def windows(self, a: Signal, b: Signal, rows: range, columns: range) -> Matrix:
        """Return the block matrix Cov(a(k+i), b(k+j)), i in `rows` and j in `columns`, both consecutive."""
        return toeplitz(self.sequence(a, b, rows[0] - columns[-1], rows[-1] - columns[0]), rows, columns)


def toeplitz(blocks: Mapping[int, Matrix], rows: range, columns: range) -> Matrix:
    """Return the block matrix of the blocks[i - j], i in `rows` and j in `columns`, neither of them empty."""
    tables = {lag: block.flint.tolist() for lag, block in blocks.items()}
    height, width = blocks[rows[0] - columns[0]].shape
    entries = [x for i in rows for r in range(height) for j in columns for x in tables[i - j][r]]
    shape = len(rows) * height, len(columns) * width
    return Matrix(QQ, *shape, base_matrix(QQ, *shape, entries))


@dataclass(frozen=True)
class WindowCovariances:
    """With f = s and q = past block rows, uf_uf is (f nu)^2, uf_up f nu x q nu, uf_yp f nu x q p; yf_uf, yf_up and yf_yp have f p rows."""

    uf_uf: Matrix
    uf_up: Matrix
    uf_yp: Matrix
    yf_uf: Matrix
    yf_up: Matrix
    yf_yp: Matrix


def covariances(experiment: Experiment) -> Covariances:
    """Return the joint process with its exact state covariance."""
    process = joint_process(experiment)
    return Covariances(process, state_covariance(process))


def window_covariances(experiment: Experiment, known: Covariances) -> WindowCovariances:
    """Return the blocks for the windows of the experiment.

    Raises InvalidInput where the covariance of s + past block rows of u is singular: u is then a combination of its own past.
    """
    s, past = experiment.s, experiment.past
    u, y = known.process.u, known.process.y
    future, before = range(s), range(-past, 0)
    # From the lags of each two signals that any of the windows has, found once.
    inputs, crossed = known.sequence(u, u, -past - s + 1, past + s - 1), known.sequence(y, u, -past - s + 1, past + s - 1)
    whole = toeplitz(inputs, range(s + past), range(s + past))
    excited = rank(whole)
    if excited < whole.nrows:
        raise InvalidInput(
            f"u_filter: got an input whose covariance over s + past = {s + past} block rows has rank {excited}, expected "
            f"{whole.nrows}: try an input with more independent noise, or fewer block rows"
        )
    return WindowCovariances(
        uf_uf=toeplitz(inputs, future, future),
        uf_up=toeplitz(inputs, future, before),
        uf_yp=toeplitz({-lag: block.transposed() for lag, block in crossed.items()}, future, before),
        yf_uf=toeplitz(crossed, future, future),
        yf_up=toeplitz(crossed, future, before),
        yf_yp=known.windows(y, y, future, before),
    )
