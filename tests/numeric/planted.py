"""These are fault systems in floats whose zeros and fault space are known by construction, and residuals of them.

Planted         A, F, C, G with chosen finite zeros and the basis of its fault space Z
planted         a random stable one, p > m, rank G = m, so that all its zeros are the chosen ones
paper_example   the example of the paper: G = 0, F an eigenvector of A, one infinite zero
simulate        r (N, p) from x0 and v (N, m), by the recursion
faults          the signals of the paper's study
coloured        low-pass noise so many decibels below each channel
joint_record    y and u of a system with inputs, white faults and such noise
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg
import scipy.signal


@dataclass(frozen=True)
class Planted:
    """The system is x+ = A x + F v, r = C x + G v; `Z` (n + p, n_v + zeta) spans its fault space."""

    A: Any
    F: Any
    C: Any
    G: Any
    Z: Any
    zeros: tuple[float, ...]

    @property
    def m(self) -> int:
        return int(self.F.shape[1])


def planted(seed: int, zeros: tuple[float, ...] = (), *, n: int = 5, p: int = 3, m: int = 2) -> Planted:
    """Return a stable system with exactly these real finite zeros and none at infinity.

    On a subspace W, the feedback v = K x is made to keep x in W with zero output: A W = W diag(zeros) - F K, C W = -G K. Then V* = W, and Z
    = im [F; G] + [A; C] W + [W; 0].
    """
    rng = np.random.default_rng(seed)
    k = len(zeros)
    while True:
        A = rng.standard_normal((n, n))
        A *= 0.9 * rng.random() ** 0.3 / np.max(np.abs(np.linalg.eigvals(A)))
        F, C, G = (rng.standard_normal(shape) for shape in ((n, m), (p, n), (p, m)))
        W = np.linalg.qr(rng.standard_normal((n, k)))[0]
        K = rng.standard_normal((m, k))
        A = A + (W @ np.diag(zeros) - F @ K - A @ W) @ W.T
        C = C + (-G @ K - C @ W) @ W.T
        if np.max(np.abs(np.linalg.eigvals(A))) < 0.97:
            break
    columns = np.vstack([np.hstack([F, W]), np.hstack([G, np.zeros((p, k))])])
    Z = scipy.linalg.orth(np.hstack([columns, np.vstack([A @ W, C @ W])]), rcond=1e-10)
    assert Z.shape == (n + p, m + k)
    return Planted(A, F, C, G, Z, zeros)


def paper_example() -> Planted:
    """Return Z = im [F; 0] + [A; C] F + [F; 0] for the infinite zero's U = im F; F is an eigenvector of A with a real eigenvalue."""
    A = np.array([[0, 1, 0], [0, 0, 1], [-0.25, 0.75, 0.25]])
    C = np.array([[1.0, 0, 0], [0, 1, 0]])
    root = min(np.roots([4, -1, -3, 1]).real)
    F = np.array([[1.0], [root], [root**2]])
    assert np.allclose(A @ F, root * F)
    Z = np.block([[F, A @ F * 0], [np.zeros((2, 1)), C @ F]])
    return Planted(A, F, C, np.zeros((2, 1)), Z, ())


def simulate(system: Planted, x0: Any, v: Any) -> Any:
    """Return r (N, p)."""
    x = np.asarray(x0, dtype=float)
    r = np.empty((len(v), system.C.shape[0]))
    for k, fault in enumerate(v):
        r[k] = system.C @ x + system.G @ fault
        x = system.A @ x + system.F @ fault
    return r


def faults(seed: int, samples: int, m: int = 2) -> Any:
    """Return a chirp, a slow rise with white noise, then white noise: (samples, m)."""
    t = np.arange(samples)
    rng = np.random.default_rng(seed)
    signals = [np.sin(0.25 * t**1.3) + 0.1, 1 - 0.99**t + rng.standard_normal(samples)]
    return np.column_stack([*signals, *rng.standard_normal((max(m - 2, 0), samples))][:m])


def coloured(seed: int, r: Any, decibels: float) -> Any:
    """Return the paper's low-pass noise, (N, p), each channel that far below the one of r."""
    white = np.random.default_rng(seed).standard_normal((len(r) + 200, r.shape[1]))
    noise = scipy.signal.lfilter([0.17, 0.5, 0.5, 0.17], [1, 0, 0.33, 0], white, axis=0)[200:]
    return noise / noise.std(axis=0) * r.std(axis=0) * 10 ** (-decibels / 20)


def joint_record(system: Planted, seed: int, samples: int, decibels: float | None, *, inputs: int = 1) -> tuple[Any, Any]:
    """Return y (N, p) and u (N, inputs) of a system with white faults and inputs, and low-pass noise so far below each output."""
    rng = np.random.default_rng([seed, 77])
    B, D = rng.standard_normal((len(system.A), inputs)), rng.standard_normal((len(system.C), inputs))
    u, v = rng.standard_normal((samples, inputs)), rng.standard_normal((samples, system.m))
    driven = Planted(system.A, np.hstack([system.F, B]), system.C, np.hstack([system.G, D]), system.Z, ())
    y = simulate(driven, rng.standard_normal(len(system.A)), np.hstack([v, u]))
    return (y if decibels is None else y + coloured(seed, y, decibels)), u
