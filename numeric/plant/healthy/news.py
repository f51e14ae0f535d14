"""How many faults are news: beyond what their own past and the inputs tell, in the whole of a record.

A constant, a ramp, a sine, a gain that has changed are faults that residual and inputs predict from their past as well as noise lets
them. They do not excite what tells a fault space: with them outputs and inputs obey one law more, of a higher degree, and rows that are
fitted to so many laws less are placed by the noise. Persistent excitation of [u; v] is what the paper asks for. A fault column [f; g]
is met by a row where a polynomial vanishes, of a degree up to 2 n at order n: it does so by accident where v obeys an equation of its
own of degree 2 n + 1 or less.

    predictor     of r from its own past, the inputs, a constant and a slope, least squares on the part tested, with as many lags as leave
                  half of the samples, and at least 2 n + 1 more than the healthy residual needs: a signal of so low a degree leaves
                  nothing in its errors but what the noise in the lags makes. The same for the healthy part
    directions    those in which the errors of one half are largest beside the healthy ones, tested on the other half, which knows nothing
                  of them, by Fisher's law, and the other way round. A jump, with the lags after it, is in one half only
    news          as many directions as both halves show. The errors of one step of a regular signal have the rank of its spectrum, whatever
                  the delays, as far as noise lets the past of one output tell the others: never fewer, and now and then one more

    news_beyond_healthy
"""

from __future__ import annotations

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ....base.errors import InvalidData
from ...method.ranks.sample_windows import channel_sizes
from .healthy_model import HEALTHY_LEVEL, number_of_lags

MOST_LAGS = 64  # of very long records


def news_beyond_healthy(r: Array, u: Array, healthy: Array, healthy_u: Array, *, n_v: int, order: int) -> int | None:
    """Return how many of `n_v` faults in r (M, p), inputs u (M, n_u), are news beside a residual (K, p) without fault, with its inputs.

    `order` is that of the model. None where there are too few samples to tell, or channels that are constant or combinations of others.
    """
    scales, width = channel_sizes(healthy - healthy.mean(axis=0)), r.shape[1] + u.shape[1]
    parts = [(values / scales, inputs) for values, inputs in ((r, u), (healthy, healthy_u))]
    fewest = min(len(r), len(healthy))
    try:
        least = number_of_lags(*(values - values.mean(axis=0) for values in parts[1])) + 2 * order + 1
    except InvalidData:
        return None
    still = u.shape[1] + 2
    lags = min((fewest - 2 * still) // (2 * width + 1), max(MOST_LAGS, least))
    if lags < least:
        return None
    spent = lags * width + still
    try:
        errors, before = (_errors(*part, lags) for part in parts)
        under = len(before) - spent
        whiten = np.linalg.inv(np.linalg.cholesky(before.T @ before / under))
    except np.linalg.LinAlgError:
        return None
    e = errors @ whiten.T
    half = len(e) // 2
    first, second = e[:half], e[half + lags :]
    found = n_v
    for learnt, tested in ((first, second), (second, first)):
        directions = np.linalg.eigh(learnt.T @ learnt)[1][:, ::-1]
        over = len(tested) * (1.0 - spent / len(e))
        ratios = np.sum((tested @ directions) ** 2, axis=0) / over
        beyond = scipy.special.fdtrc(over, under, ratios) < HEALTHY_LEVEL
        found = min(found, int(np.argmin(np.append(beyond, False))))
    return found


def _errors(r: Array, u: Array, lags: int) -> Array:
    """Return the one-step errors (M - lags, p). Raises LinAlgError where they are not finite."""
    M = len(r)
    time = np.linspace(-1.0, 1.0, M - lags)[:, None]
    X = [np.ones((M - lags, 1)), time, u[lags:]]
    X += [block for j in range(1, lags + 1) for block in (r[lags - j : M - j], u[lags - j : M - j])]
    joint = np.hstack(X)
    sizes = np.linalg.norm(joint, axis=0)
    joint = joint / np.where(sizes > 0.0, sizes, 1.0)
    basis = np.linalg.qr(joint)[0]
    e = r[lags:] - basis @ (basis.T @ r[lags:])
    if not np.all(np.isfinite(e)):
        raise np.linalg.LinAlgError("errors beyond all numbers")
    return np.asarray(e)
