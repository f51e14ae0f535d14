"""Tell whether the input follows what disturbed the outputs before: a closed loop, as a test of a stated level.

In open loop the innovations e of the ARX model are uncorrelated with u at every lag. With u(k) less its best prediction from its own past,
and e(k), both whitened, as z(k) and w(k), the squared correlations of z(k) with w(k-1), .., w(k-m) times the samples add up to a number
that is chi-squared with m p n_u degrees of freedom [H76]; factors of small samples are those of [LB78]. That u(k) is predicted from its
own past, and not used as it is, keeps the errors of the ARX model, which are combinations of past u and y, out of it to first order.

What feedback does. An ARX model predicts y(k) from all that came before, so that its plant stays consistent where u(k) has no part in it of
e(k), that is, where the loop has a delay [L99, ch. 13]; the standard errors are then those of an open loop, which are too small. Without
a delay e(k) is in u(k), D is wrong, and nothing in the data shows it, since e is uncorrelated with u(k) by construction.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_tail
from .arx import Arx
from .compression import EPS

FEEDBACK_LEVEL = 1e-3
"""The probability of a note in open loop."""
HEARD = 1 << 13
"""Samples of an experiment that are looked at: so many show a correlation of 0.2 at one lag, be there a hundred others."""


def feedback_chance(records: Sequence[tuple[Array, Array]], arx: Arx, lags: int) -> float:
    """Return the probability, in open loop, of correlations as large as those of stretches (y, u) of a record, or of several, and the ARX
    model of them; 1 where they are too short.

    y (N, p) and u (N, n_u) are in the units of the model, and `lags` is m.
    """
    reach = max(arx.order, lags)
    long = [(y - y.mean(axis=0), u - u.mean(axis=0)) for y, u in records if len(y) > 2 * reach + lags]
    p, n_u = arx.inputs.shape[1:]
    if not long or lags == 0 or sum(len(y) - reach for y, _ in long) <= 2 * lags * n_u + p:
        return 1.0
    regressors = np.concatenate([np.hstack([u[reach - i : len(u) - i] for i in range(1, reach + 1)]) for _, u in long])
    targets = np.concatenate([u[reach:] for _, u in long])
    news = targets - regressors @ np.linalg.lstsq(regressors, targets, rcond=None)[0]
    errors = [one_step_errors(y, u, arx, reach) for y, u in long]
    if sum(float(np.sum(part**2)) for part in errors) <= EPS * sum(float(np.sum(y**2)) for y, _ in long):
        return 1.0  # what is left is rounding, which follows the signals
    z, w = _white(news), _white(np.concatenate(errors))
    total, start = 0.0, 0
    for part in errors:
        stop = start + len(part)
        for lag in range(1, lags + 1):
            moment = z[start + lag : stop].T @ w[start : stop - lag]
            total += float(np.sum(moment**2)) / (len(part) - lag)
        start = stop
    # One sum for each stretch: as many degrees of freedom for each.
    return chi_squared_tail(total, len(errors) * lags * p * n_u)


def one_step_errors(y: Array, u: Array, arx: Arx, reach: int) -> Array:
    """Return the one-step errors (N - reach, p) of a stretch y (N, p), u (N, n_u) from sample `reach` on."""
    errors = np.zeros((len(y) - reach, y.shape[1]))
    for i in range(arx.order + 1):
        errors += y[reach - i : len(y) - i] @ arx.outputs[i].T - u[reach - i : len(u) - i] @ arx.inputs[i].T
    return errors


def _white(signal: Array) -> Array:
    """Return the signal with its covariance made the identity; directions without power stay zero."""
    left, values, _ = np.linalg.svd(signal - signal.mean(axis=0), full_matrices=False)
    kept = values > len(signal) * np.finfo(np.float64).eps * values.max(initial=0.0)
    return np.asarray(left * kept * np.sqrt(len(signal)))
