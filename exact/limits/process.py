"""Input, fault, noise, state and output of an experiment become one linear system driven by white noise of unit covariance.

    xi(k+1) = Phi xi(k) + Gamma e(k),   every signal = H xi(k) + J e(k),   e = (noise of u and v; noise of w)

    Signal          H, J: rows of one signal
    DelayLine       the last values of z(k) = e(k) - d_1 z(k-1) - ... - d_k z(k-k), for one denominator and one noise
    JointProcess    Phi, Gamma, the signals x, u, v, w, y, and the lines
    joint_process   from an Experiment

xi = (x(k); lines), a line being (z(k-1); ...; z(k-length)), each of the width of its noise. Lines in order: the one of u; the one of v,
which is u's where the denominators agree (its length is then the larger of the two); the one of w. So Phi = [[A, M], [0, N]], N block
diagonal, a companion matrix Kronecker an identity a line; where denominators are 1, N is nilpotent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import fmpq

from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, beside, stacked
from .experiments import Experiment
from .filters import Filter


@dataclass(frozen=True)
class Signal:
    """A signal H xi(k) + J e(k)."""

    H: Matrix
    J: Matrix


@dataclass(frozen=True)
class DelayLine:
    """This holds `length` past values of z, `width` entries each, z driven by the columns of e from `noise_start` on; `denominator` is by
    lag.
    """

    denominator: tuple[Any, ...]
    length: int
    width: int
    noise_start: int

    @property
    def size(self) -> int:
        """This says how many entries of xi it takes."""
        return self.length * self.width

    def companion(self) -> Matrix:
        """Return the length x length matrix that moves one channel of the line on."""
        rows = [[fmpq(0)] * self.length for _ in range(self.length)]
        for j, d in enumerate(self.denominator[1:]):
            rows[0][j] = -d
        for i in range(1, self.length):
            rows[i][i - 1] = fmpq(1)
        return Matrix.from_elements(QQ, self.length, self.length, rows)

    def annihilator(self) -> tuple[Any, ...]:
        """Return q^length + d_1 q^(length-1) + ..., ascending: the characteristic polynomial of the companion matrix."""
        padded = [*self.denominator, *[fmpq(0)] * (self.length + 1 - len(self.denominator))]
        return tuple(reversed(padded))


@dataclass(frozen=True)
class JointProcess:
    """The dictionary of the module explains the fields; `lines` tile xi after the first n entries."""

    n: int
    Phi: Matrix
    Gamma: Matrix
    x: Signal
    u: Signal
    v: Signal
    w: Signal
    y: Signal
    lines: tuple[DelayLine, ...]


def joint_process(experiment: Experiment) -> JointProcess:
    """The joint process; Phi is Schur-stable because A and the denominators are."""
    system, u, v, w = experiment.system, experiment.u_filter, experiment.v_filter, experiment.w_filter
    residual = system.residual
    n, m, p = residual.n, residual.m, residual.p
    if m == 0:
        v = Filter((Matrix.zero(QQ, 0, u.noise),), (fmpq(1),))
    shared = m == 0 or u.denominator == v.denominator
    lines = [DelayLine(u.denominator, max(u.memory, v.memory) if shared else u.memory, u.noise, 0)]
    if not shared:
        lines.append(DelayLine(v.denominator, v.memory, v.noise, 0))
    if w is not None:
        lines.append(DelayLine(w.denominator, w.memory, w.noise, u.noise))
    noise = u.noise + (0 if w is None else w.noise)
    starts = [n]
    for line in lines:
        starts.append(starts[-1] + line.size)
    size = starts[-1]
    signal_u = _filtered(u, lines[0], starts[0], size, noise)
    signal_v = _filtered(v, lines[0 if shared else 1], starts[0 if shared else 1], size, noise)
    signal_w = Signal(Matrix.zero(QQ, p, size), Matrix.zero(QQ, p, noise))
    if w is not None:
        signal_w = _filtered(w, lines[-1], starts[-2], size, noise)
    state = Signal(beside(Matrix.identity(QQ, n), Matrix.zero(QQ, n, size - n)), Matrix.zero(QQ, n, noise))

    def driven(through_x: Matrix, through_u: Matrix, through_v: Matrix) -> Signal:
        H = through_x @ state.H + through_u @ signal_u.H + through_v @ signal_v.H
        return Signal(H, through_u @ signal_u.J + through_v @ signal_v.J)

    following = driven(residual.A, system.B, residual.F)
    output = driven(residual.C, system.D, residual.G)
    output = Signal(output.H + signal_w.H, output.J + signal_w.J)
    moves = [_moved(line, start, size, noise) for line, start in zip(lines, starts, strict=False)]
    Phi = stacked(following.H, *(move.H for move in moves))
    Gamma = stacked(following.J, *(move.J for move in moves))
    return JointProcess(n, Phi, Gamma, state, signal_u, signal_v, signal_w, output, tuple(lines))


def _filtered(one: Filter, line: DelayLine, start: int, size: int, noise: int) -> Signal:
    """Return sum_j U_j z(k-j), with z(k) = e(k) - sum_j d_j z(k-j) put in."""
    first, nothing = one.numerator[0], Matrix.zero(QQ, one.channels, one.noise)
    blocks = []
    for j in range(1, line.length + 1):
        block = one.numerator[j] if j < len(one.numerator) else nothing
        if j < len(one.denominator):
            block = block - Matrix(QQ, *first.shape, first.flint * one.denominator[j])
        blocks.append(block)
    before, after = Matrix.zero(QQ, one.channels, start), Matrix.zero(QQ, one.channels, size - start - line.size)
    early, late = Matrix.zero(QQ, one.channels, line.noise_start), Matrix.zero(QQ, one.channels, noise - line.noise_start - one.noise)
    return Signal(beside(before, *blocks, after), beside(early, first, late))


def _moved(line: DelayLine, start: int, size: int, noise: int) -> Signal:
    """Return the line one step later."""
    rows = [[fmpq(0)] * size for _ in range(line.size)]
    drive = [[fmpq(0)] * noise for _ in range(line.size)]
    step = line.companion().elements()
    for channel in range(line.width):
        for i in range(line.length):
            for j in range(line.length):
                rows[i * line.width + channel][start + j * line.width + channel] = step[i][j]
        if line.length:
            drive[channel][line.noise_start + channel] = fmpq(1)
    return Signal(Matrix.from_elements(QQ, line.size, size, rows), Matrix.from_elements(QQ, line.size, noise, drive))
