"""Gains that have changed since the healthy part: the residual on the simulated output, and on what each input alone does by the model.

An output whose sensor has the gain 1 + g adds g times the simulated output to its residual; an input whose actuator has it adds g times
the model's response to this input to all of them. Both go through the predictor and are regressed on with the weight of the innovations,
all outputs together, and all inputs together, so that one is not put down to another. With a single input the same change of all outputs
and one of the input are one thing. Means and slopes are taken off first: they are rows of their own.

The model was fitted to the healthy part, so that there is hardly anything of these signals in the healthy residual; how well that part
knew the gain is the variance of the same regression there, and it is added. With the regressors X of the predictor before the signal z,
the coefficient g0 of z in the healthy part comes from what X leaves of z (Frisch and Waugh), and the difference g - R g0 is tested, R the
share of z in the part tested that X, with the healthy coefficients, leaves. The two are independent for white e.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ....base.arrays import Array
from .predictor import LEARNT_FROM, Predictor, Stretch
from .slow import about_slope
from .table_rows import INPUT_GAIN, OUTPUT_GAIN, Estimate, Evidence, by_student, estimate, undecided

NO_MODEL = "the responses to single inputs need a model that is stable"
HELD = 1 << 22  # numbers of filtered signals
RIDGE = 1e-9  # of the power of a signal: what X leaves of it is known to rounding only


def changed_gains(
    learnt: Predictor, before: Stretch, after: Stretch, names: tuple[Sequence[str], Sequence[str]], level: float
) -> Iterator[Evidence]:
    """Yield the rows of the gains of outputs and inputs, `names` of both, each tested at `level`."""
    outputs, inputs = names
    p = learnt.p
    before = before.part(max(len(before) - LEARNT_FROM, 0), len(before))
    after = after.part(0, max(HELD // max(p * p, p * len(inputs), 1), 4 * p))
    if after.responses is None or before.responses is None:
        yield from (undecided(OUTPUT_GAIN, name, NO_MODEL) for name in outputs)
        yield from (undecided(INPUT_GAIN, name, NO_MODEL) for name in inputs)
        return
    simulated = [[_single(part.y - part.r, i) for i in range(p)] for part in (before, after)]
    for i, name in enumerate(outputs):
        spread = float(np.std((after.y - after.r)[:, i]))
        yield _row(OUTPUT_GAIN, name, _gain(learnt, after, simulated[0], simulated[1], i), level, spread, learnt.spread[i])
    for j, name in enumerate(inputs):
        found = _gain(learnt, after, list(before.responses), list(after.responses), j)
        sizes = np.std(after.responses[j], axis=0)
        loudest = int(np.argmax(sizes / learnt.spread))
        yield _row(INPUT_GAIN, name, found, level, float(sizes[loudest]), learnt.spread[loudest], f"in {outputs[loudest]}")


def _single(simulated: Array, output: int) -> Array:
    """Return the simulated outputs with all but one set to zero."""
    alone = np.zeros_like(simulated)
    alone[:, output] = simulated[:, output]
    return alone


def _row(kind: str, name: str, found: Estimate | str, level: float, size: float, spread: float, where: str = "") -> Evidence:
    if isinstance(found, str):
        return undecided(kind, name, found)
    seen = f"{100.0 * found.value:+.3g} % of the gain; from {100.0 * found.visible(level):.3g} % on"
    return by_student(kind, name, found, level, size, spread, f"{seen}{', ' + where if where else ''}")


def _gain(learnt: Predictor, after: Stretch, healthy_signals: Sequence[Array], signals: Sequence[Array], which: int) -> Estimate | str:
    """Return the change of one gain among those of all signals, each (M, p)."""
    z0 = np.stack([learnt.filtered(signal) for signal in healthy_signals], axis=2)
    z = np.stack([about_slope(learnt.filtered(signal)) for signal in signals], axis=2)
    precision = np.linalg.inv(learnt.covariance)
    power = np.einsum("kpi,pq,kqj->ij", z, precision, z, optimize=True)
    units = np.sqrt(np.maximum(np.diag(power), 0.0))
    known = np.einsum("kpi,pq,kqi->i", z0, precision, z0, optimize=True)
    hardly = np.any(units**2 * RIDGE >= known) or np.any(known * RIDGE >= units**2)
    if hardly or np.linalg.cond(power / np.outer(units, units)) > 1.0 / RIDGE:
        return "the signals of the gains are too much alike, or hardly there"
    solved = np.linalg.solve(power, np.eye(len(units))[which])
    weights = np.einsum("kpi,i->kp", z, solved) @ precision
    e = learnt.innovations(after)
    X0 = learnt.regressors
    projected = np.einsum("qr,rpi->qpi", learnt.root.T @ learnt.root, np.einsum("kq,kpi->qpi", X0, z0, optimize=True), optimize=True)
    left = z0 - np.einsum("kq,qpi->kpi", X0, projected, optimize=True)
    healthy_power = np.einsum("kpi,pq,kqj->ij", left, precision, left, optimize=True) + np.diag(RIDGE * known)
    healthy = np.linalg.solve(healthy_power, np.einsum("kpi,pq,kq->i", left, precision, learnt.e, optimize=True))
    # The regressors without the changes themselves, so that their error does not grow with these.
    amplitudes = np.linalg.solve(power, np.einsum("kpi,pq,kq->i", z, precision, e, optimize=True))
    cleared = replace(after, r=after.r - sum(a * signal for a, signal in zip(amplitudes, signals, strict=True)))
    moments = learnt.moments(cleared, weights)
    share = np.einsum("kp,kpi->i", weights, z) - np.einsum("qp,qpi->i", moments, projected)
    found = estimate(learnt, e, weights, moments)
    white = float(np.sum(weights @ learnt.covariance * weights))
    coloured = max(learnt.variance(weights)[0] / white, 1.0)
    variance = found.deviation**2 + coloured * float(share @ np.linalg.solve(healthy_power, share)) / learnt.share
    return Estimate(found.value - float(share @ healthy), float(np.sqrt(variance)), found.freedom)
