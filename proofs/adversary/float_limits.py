"""The limits of PI-MOESP and PO-MOESP in floats, some hundred microseconds each: what the adversary follows. It decides nothing.

    Drawn          an experiment as numbers, floats or Fractions: A, F, C, G, B, D, two windows, two filters
    FloatLimits    L of both, O_s, and the coordinates M of PI-MOESP's in the columns of O_s
    float_limits   of a Drawn
    exact_experiment   the same experiment for the exact branch
    determinant    of M, against Hadamard's bound
    outside        the share of L that lies outside the range of O_s
    input_bias     of B and D by MOESP's regression

P = Phi P Phi' + Gamma Gamma' is summed by doubling. Names as in `exact.joint_process` and `exact.limits`, written apart from them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from ...exact.limits.experiments import Experiment, read_experiment
from ..evidence.attacks import Floats

Table = Sequence[Sequence[Any]]


@dataclass(frozen=True)
class Drawn:
    """An experiment is drawn as tables by rows. u = sum_j u_taps[j] q^-j / sum u_den[j] q^-j of white e, v likewise of the same e: matrices
    with as many columns."""

    A: Table
    F: Table
    C: Table
    G: Table
    B: Table
    D: Table
    s: int
    past: int
    u_taps: Sequence[Table]
    u_den: Sequence[Any]
    v_taps: Sequence[Table]
    v_den: Sequence[Any] = (1,)


@dataclass(frozen=True)
class FloatLimits:
    """past_inputs: s p x past nu; past_outputs: s p x past (nu + p); observability: s p x n; coordinates: n x past nu;
    response = Cov(Yf, Uf) Cov(Uf, Uf)^-1: s p x s nu."""

    past_inputs: Floats
    past_outputs: Floats
    observability: Floats
    coordinates: Floats
    response: Floats


def exact_experiment(drawn: Drawn) -> Experiment:
    """Return the experiment in exact arithmetic. Raises InvalidInput where A or a filter is not stable."""
    matrices = {name: _texts(getattr(drawn, name)) for name in "AFCGBD"}
    u = {"num": [_texts(tap) for tap in drawn.u_taps], "den": [str(Fraction(x)) for x in drawn.u_den]}
    v = {"num": [_texts(tap) for tap in drawn.v_taps], "den": [str(Fraction(x)) for x in drawn.v_den]}
    return read_experiment({**matrices, "s": drawn.s, "past": drawn.past, "u_filter": u, "v_filter": v})


def float_limits(drawn: Drawn) -> FloatLimits:
    """Return the limits of an experiment in floats. Raises numpy.linalg.LinAlgError where the covariance of the future inputs is
    singular."""
    A, F, C, G, B, D = (np.array(getattr(drawn, name), dtype=np.float64) for name in "AFCGBD")
    n, nu, s, past = len(A), B.shape[1], drawn.s, drawn.past
    u_move, u_enter, u_read, u_now = _line(drawn.u_taps, drawn.u_den)
    v_move, v_enter, v_read, v_now = _line(drawn.v_taps, drawn.v_den)
    a, b = len(u_move), len(v_move)
    size = n + a + b
    Phi = np.zeros((size, size))
    Phi[:n] = np.hstack([A, B @ u_read, F @ v_read])
    Phi[n : n + a, n : n + a], Phi[n + a :, n + a :] = u_move, v_move
    Gamma = np.vstack([B @ u_now + F @ v_now, u_enter, v_enter])
    H_u, H_y = np.hstack([np.zeros((nu, n)), u_read, np.zeros((nu, b))]), np.hstack([C, D @ u_read, G @ v_read])
    J_u, J_y = u_now, D @ u_now + G @ v_now
    P = _stationary(Phi, Gamma @ Gamma.T)

    def windows(one: tuple[Floats, Floats], two: tuple[Floats, Floats], rows: range, columns: range) -> Floats:
        """Return Cov(one(k + i), two(k + j)) in blocks."""
        reach = max(rows[-1] - columns[0], columns[-1] - rows[0])
        ahead, behind = _sequence(Phi, Gamma, P, one, two, reach), _sequence(Phi, Gamma, P, two, one, reach)
        return np.vstack([np.hstack([ahead[i - j] if i >= j else behind[j - i].T for j in columns]) for i in rows])

    u, y, future, before = (H_u, J_u), (H_y, J_y), range(s), range(-past, 0)
    uf_uf, yf_uf = windows(u, u, future, future), windows(y, u, future, future)
    gain = np.linalg.solve(uf_uf, yf_uf.T).T
    inputs = windows(y, u, future, before) - gain @ windows(u, u, future, before)
    outputs = np.hstack([inputs, windows(y, y, future, before) - gain @ windows(u, y, future, before)])
    observability = np.vstack([C @ np.linalg.matrix_power(A, i) for i in range(s)])
    return FloatLimits(
        inputs,
        outputs,
        observability,
        np.linalg.lstsq(observability, inputs, rcond=None)[0],
        np.asarray(gain, dtype=np.float64),
    )


def determinant(M: Floats) -> float:
    """Return det M (n x n) against the product of the lengths of its rows, which bounds it: from -1 to 1."""
    lengths = float(np.prod(np.linalg.norm(M, axis=1)))
    return float(np.linalg.det(M)) / lengths if lengths > 0 else 0.0


def outside(L: Floats, observability: Floats) -> float:
    """Return the share of L outside the range of O_s, in the Frobenius norm: from 0 to 1."""
    basis, values, _ = np.linalg.svd(observability, full_matrices=False)
    basis = basis[:, values > 1e-9 * values[0]]
    total = float(np.linalg.norm(L))
    return float(np.linalg.norm(L - basis @ (basis.T @ L))) / total if total > 0 else 0.0


def _line(taps: Sequence[Table], den: Sequence[Any]) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the delay line of one filter: how it moves, how e enters it, how the signal is read from it, and e's direct way into the
    signal."""
    numerator = [np.array(tap, dtype=np.float64) for tap in taps]
    denominator = np.array([float(x) for x in den])
    channels, noise = numerator[0].shape
    memory = max(len(numerator), len(denominator)) - 1
    move, enter, read = np.zeros((memory * noise, memory * noise)), np.zeros((memory * noise, noise)), np.zeros((channels, memory * noise))
    for j in range(1, memory + 1):
        here, d = slice((j - 1) * noise, j * noise), denominator[j] if j < len(denominator) else 0.0
        move[:noise, here] = -d * np.eye(noise)
        if j < memory:
            move[j * noise : (j + 1) * noise, here] = np.eye(noise)
        read[:, here] = (numerator[j] if j < len(numerator) else 0.0) - d * numerator[0]
    if memory:
        enter[:noise] = np.eye(noise)
    return move, enter, read, numerator[0]


def _stationary(Phi: Floats, source: Floats) -> Floats:
    P, power = source, Phi
    for _ in range(40):
        step = power @ P @ power.T
        P, power = P + step, power @ power
        if np.abs(step).max() <= 1e-17 * np.abs(P).max():
            return P
    raise np.linalg.LinAlgError("no stationary covariance")


def _sequence(Phi: Floats, Gamma: Floats, P: Floats, one: tuple[Floats, Floats], two: tuple[Floats, Floats], most: int) -> list[Floats]:
    """Return Cov(one(k + l), two(k)) for l = 0..most."""
    result = [one[0] @ P @ two[0].T + one[1] @ two[1].T]
    reached = Phi @ P @ two[0].T + Gamma @ two[1].T
    for _ in range(most):
        result.append(one[0] @ reached)
        reached = Phi @ reached
    return result


def _texts(rows: Table) -> list[list[str]]:
    return [[str(Fraction(x)) for x in row] for row in rows]


def input_bias(drawn: Drawn) -> float:
    """Return how far MOESP's regression with the true A, C takes B, D from the truth, against their size and that of the fault's
    columns."""
    A, F, C, G, B, D = (np.array(getattr(drawn, name), dtype=np.float64) for name in "AFCGBD")
    found = float_limits(drawn)
    s, p, n, nu = drawn.s, len(C), len(A), B.shape[1]
    seen = found.observability
    Pi = np.eye(s * p) - seen @ np.linalg.pinv(seen)
    rows, target = [], []
    for k in range(s):
        column = np.zeros((s * p, p + n))
        column[k * p : (k + 1) * p, :p] = np.eye(p)
        column[(k + 1) * p :, p:] = seen[: (s - 1 - k) * p]
        rows.append(Pi @ column)
        target.append(Pi @ found.response[:, k * nu : (k + 1) * nu])
    solved = np.linalg.lstsq(np.vstack(rows), np.vstack(target), rcond=None)[0]
    scale = sum(float(np.linalg.norm(x)) for x in (B, D, F, G))
    return float(np.linalg.norm(solved - np.vstack([D, B]))) / scale if scale > 0 else 0.0
