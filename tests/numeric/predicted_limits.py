"""This computes what an estimate of a given order converges to, from exact covariances: the bridge from a limit to a float estimate.

simulated           y, u of an experiment, N samples in the stationary state
predicted_model     A, C at the given order from L Cov(Z | Uf)^-1/2, as the factorisations weigh it, and B, D by output error
invariants          characteristic polynomial of A, then D, CB, ..., CA^(n-1)B in one vector: equal for similar models
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from scipy.signal import lfilter

from faultspace.exact.algebra.matrices import Matrix, beside, stacked
from faultspace.exact.limits.column_space import Limit
from faultspace.exact.limits.experiments import Experiment
from faultspace.exact.limits.filters import Filter
from faultspace.exact.limits.inputs import by_output_error
from faultspace.exact.limits.moments import Covariances, WindowCovariances
from faultspace.numeric.method.model.models import StateSpaceModel

SETTLING = 500


def floats(matrix: Matrix) -> Any:
    """Return the float array."""
    return np.array([[int(x.p) / int(x.q) for x in row] for row in matrix.elements()]).reshape(matrix.shape)


def _filtered(one: Filter, noise: Any) -> Any:
    denominator = [int(d.p) / int(d.q) for d in one.denominator]
    numerator = np.array([floats(block) for block in one.numerator])
    result = np.zeros((len(noise), one.channels))
    for i in range(one.channels):
        for j in range(one.noise):
            result[:, i] += lfilter(numerator[:, i, j], denominator, noise[:, j])
    return result


def simulated(experiment: Experiment, samples: int, seed: int) -> tuple[Any, Any]:
    """Return y (N, p) and u (N, nu)."""
    generator = np.random.default_rng(seed)
    system, residual = experiment.system, experiment.system.residual
    noise = generator.standard_normal((samples + SETTLING, experiment.u_filter.noise))
    u, v = _filtered(experiment.u_filter, noise), _filtered(experiment.v_filter, noise)
    drive = [floats(beside(M, N)) for M, N in ((system.B, residual.F), (system.D, residual.G))]
    y = StateSpaceModel(floats(residual.A), drive[0], floats(residual.C), drive[1]).simulate(np.hstack([u, v]))
    if experiment.w_filter is not None:
        y = y + _filtered(experiment.w_filter, generator.standard_normal((len(y), experiment.w_filter.noise)))
    return y[SETTLING:], u[SETTLING:]


def predicted_model(known: Covariances, blocks: WindowCovariances, limit: Limit, s: int, past: int, order: int, *, outputs: bool) -> Any:
    """Return invariants() of the model that PI-MOESP (PO-MOESP with `outputs`) tends to at this order."""
    u, y, before = known.process.u, known.process.y, range(-past, 0)
    whole, crossed = known.windows(u, u, before, before), blocks.uf_up
    if outputs:
        mixed = known.windows(u, y, before, before)
        whole = stacked(beside(whole, mixed), beside(mixed.transposed(), known.windows(y, y, before, before)))
        crossed = beside(crossed, blocks.uf_yp)
    given = whole - crossed.transposed() @ limit.projection
    values, directions = np.linalg.eigh(floats(given))
    kept = values > values[-1] * 1e-12  # noise-free outputs are combinations of inputs: L vanishes on what those combinations leave
    weighted = floats(limit.matrix) @ directions[:, kept] / np.sqrt(values[kept])
    p = y.H.nrows
    # PI-MOESP takes outputs in units of their root mean square.
    scale = np.ones(p) if outputs else np.sqrt(np.diag(floats(known.now(y, y))))
    left = np.linalg.svd(weighted / np.tile(scale, s)[:, np.newaxis])[0][:, :order]
    A, C = np.linalg.lstsq(left[:-p], left[p:], rcond=None)[0], left[:p] * scale[:, np.newaxis]
    rational = [Matrix.of([[Fraction(float(x)) for x in row] for row in M]) for M in (A, C)]
    inputs = by_output_error(known, *rational)
    assert inputs is not None
    return invariants(A, floats(inputs.B), C, floats(inputs.D))


def invariants(A: Any, B: Any, C: Any, D: Any) -> Any:
    """Return the invariants of a model as one vector."""
    parts = [np.poly(A)[1:], D.ravel()]
    for _ in range(len(A)):
        parts.append((C @ B).ravel())
        B = A @ B
    return np.concatenate(parts)
