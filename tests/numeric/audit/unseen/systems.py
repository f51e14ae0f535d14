"""Small systems and records with known answers, for the witnesses of this folder alone.

plant       a model with given poles in a random state basis; chain: one with poles at 0, a delay
channel     a transfer function of one input and one output with given zeros, poles and delay, as matrices
joined      channels side by side, their outputs mixed by a matrix, in a random state basis, hidden and idle modes added
with_zeros  a tall system with given zeros, generic else
Record      a model, its input, its output, and what of the output a fault makes
record      one of these
Faulty      A, F, C, G with a fault signal, an initial state and the residual
faulty      one of these
free_responses  the responses to unit states
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg

from faultspace.numeric.method.model.models import StateSpaceModel

Matrices = tuple[Any, Any, Any, Any]


def basis(n: int, seed: int) -> Any:
    """Return a random well-conditioned matrix (n, n)."""
    rng = np.random.default_rng(seed)
    if n == 0:
        return np.zeros((0, 0))
    turn, other = np.linalg.qr(rng.standard_normal((2, n, n)))[0]
    return (turn * rng.uniform(0.6, 1.6, n)) @ other


def with_poles(poles: Sequence[complex]) -> Any:
    """Return a block diagonal matrix; of a complex pair one is named."""
    blocks = [[[p.real, p.imag], [-p.imag, p.real]] if isinstance(p, complex) else [[p]] for p in poles]
    return scipy.linalg.block_diag(*blocks) if blocks else np.zeros((0, 0))


def plant(poles: Sequence[complex] | Any, n_u: int, p: int, seed: int, *, D: float = 1.0) -> StateSpaceModel:
    """Return a model with these poles (or with this A up to similarity), D of that size."""
    rng = np.random.default_rng(seed)
    A = np.asarray(poles) if isinstance(poles, np.ndarray) else with_poles(poles)
    n, T = len(A), basis(len(A), seed)
    B, C = rng.standard_normal((n, n_u)), rng.standard_normal((p, n))
    return StateSpaceModel(T @ A @ np.linalg.inv(T), T @ B, C @ np.linalg.inv(T), D * rng.standard_normal((p, n_u)))


def jordan(pole: float, size: int) -> Any:
    """Return one Jordan block."""
    return pole * np.eye(size) + np.eye(size, k=1)


def polynomial(roots: Sequence[complex]) -> Any:
    """Return the monic coefficients, highest first; of a complex pair one root is named."""
    every = [w for z in roots for w in ((z, z.conjugate()) if isinstance(z, complex) else (z,))]
    return np.atleast_1d(np.real(np.poly(every)))


def channel(zeros: Sequence[complex], poles: Sequence[complex], gain: float = 1.0) -> Matrices:
    """Return matrices of gain prod(q - zero) / prod(q - pole) in companion form; complex ones stand for their pairs."""
    above, below = polynomial(zeros), polynomial(poles)
    n = len(below) - 1
    A = np.eye(n, k=1)
    if n:
        A[-1] = -below[:0:-1]
    above = gain * np.concatenate([np.zeros(n + 1 - len(above)), above])
    rest = (above - above[0] * below)[:0:-1]
    B = np.zeros((n, 1))
    if n:
        B[-1] = 1.0
    return A, B, rest.reshape(1, n), np.array([[above[0]]])


def joined(
    channels: Sequence[Matrices], mix: Any, seed: int, *, unobservable: Sequence[float] = (), uncontrollable: Sequence[float] = ()
) -> Matrices:
    """Return the channels side by side with outputs mix @ y; modes that no output shows and modes that no input moves are added."""
    A, F, C, G = (scipy.linalg.block_diag(*[one[i] for one in channels]) for i in range(4))
    A, F, C, G = np.asarray(A), F.reshape(len(A), -1), C.reshape(-1, len(A)), G
    rng = np.random.default_rng(seed)
    hidden, idle = len(unobservable), len(uncontrollable)
    m = F.shape[1]
    A = scipy.linalg.block_diag(A, np.diag(unobservable), np.diag(uncontrollable)) if hidden + idle else A
    F = np.vstack([F, rng.standard_normal((hidden, m)), np.zeros((idle, m))])
    C = np.hstack([np.asarray(mix) @ C, np.zeros((len(mix), hidden)), rng.standard_normal((len(mix), idle))])
    T = basis(len(A), seed)
    back = np.linalg.inv(T)
    return T @ A @ back, T @ F, C @ back, np.asarray(mix) @ G


def with_zeros(zeros: Sequence[complex], poles: Sequence[complex] | Any, p: int, seed: int) -> Matrices:
    """Return a system of one fault and p outputs with these distinct zeros, of a complex pair one named: C (q I - A)^-1 F = -G at each."""
    A, F, C, _ = general(poles, 1, p, seed)
    states = [np.linalg.solve(q * np.eye(len(A)) - A, F[:, 0]) for q in zeros]
    apart = [x.imag for x in states if np.iscomplexobj(x)] + [x.real - states[0].real for x in states[1:]]
    if apart:
        W = np.linalg.qr(np.stack(apart, axis=1))[0]
        C = C - C @ W @ W.T
    return A, F, C, -(C @ states[0].real)[:, None]


def mixing(p: int, m: int, seed: int = 0) -> Any:
    """Return a random matrix (p, m) for the outputs."""
    return np.random.default_rng(seed + 17).standard_normal((p, m))


@dataclass(frozen=True)
class Record:
    """This is a model with u (N, n_u), y (N, p), and the part `fault` (N, p) of y."""

    model: StateSpaceModel
    u: Any
    y: Any
    fault: Any


def record(model: StateSpaceModel, N: int, seed: int, *, x0: float = 1.0, units: Any = 1.0, offset: Any = 0.0, fault: Any = None) -> Record:
    """Simulate with white inputs (plus `offset`), a random initial state of size x0, and outputs times `units`."""
    rng = np.random.default_rng(seed)
    u = rng.standard_normal((N, model.n_u)) + offset
    scale = np.broadcast_to(np.asarray(units, dtype=float), (model.p,))
    model = StateSpaceModel(model.A, model.B, scale[:, None] * model.C, scale[:, None] * model.D)
    part = np.zeros((N, model.p)) if fault is None else scale * fault
    return Record(model, u, model.simulate(u, x0 * rng.standard_normal(model.n)) + part, part)


@dataclass(frozen=True)
class Faulty:
    """These are A, F, C, G, v (N, m), x0 (n,), and r = C x + G v (N, p)."""

    A: Any
    F: Any
    C: Any
    G: Any
    v: Any
    x0: Any
    r: Any

    @property
    def columns(self) -> Any:
        """The fault's own columns [F; G]."""
        return np.vstack([self.F, self.G])


def faulty(system: Matrices, N: int, seed: int, *, x0: float = 1.0, units: Any = 1.0, sizes: Any = 1.0) -> Faulty:
    """Simulate white faults of these sizes, outputs times `units`."""
    rng = np.random.default_rng(seed)
    A, F, C, G = system
    p, m = G.shape
    scale = np.broadcast_to(np.asarray(units, dtype=float), (p,))[:, None]
    v = rng.standard_normal((N, m)) * sizes
    start = x0 * rng.standard_normal(len(A))
    r = StateSpaceModel(A, F, scale * C, scale * G).simulate(v, start)
    return Faulty(A, F, scale * C, scale * G, v, start, r)


def general(poles: Sequence[complex] | Any, m: int, p: int, seed: int, *, G: float = 1.0) -> Matrices:
    """Return matrices of a random system with these poles."""
    model = plant(poles, m, p, seed, D=G)
    return model.A, model.B, model.C, model.D


def free_responses(A: Any, C: Any, N: int) -> Any:
    """Return C A^k for k = 0 .. N - 1, (N, p, n)."""
    blocks, state = np.zeros((N, *C.shape)), np.asarray(C)
    for k in range(N):
        blocks[k] = state
        state = state @ A
    return blocks
