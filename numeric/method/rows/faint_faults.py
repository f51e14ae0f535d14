"""Make the likelihood of kernel rows even where the faults leave a direction to the noise, so that degrees can be compared there.

The cost of `numeric/method/space/basis.py` takes every sample of the faults for an unknown of its own. At frequencies where a fault is
fainter than the noise it then pays to turn a row to where the noise happens to be least: of m samples that lies below its mean by about one
over root m, so that rows of a higher degree gain some multiple of root m without being needed. A fault that has a spectrum allows no such
gain. Let y - G u have the spectrum Phi = phi n* n + V* S V, n the rows of unit length and V what is orthogonal to them. The likelihood of
its periodogram E, at the best S, is [W53]

    tr(n E n*) / phi + log det(n Phi^-1 n*)        for each sample,

Phi being smooth over frequency as S is. A logarithm lies below its tangent, here that at n Phi^-1 n* = I / phi, where the noise is. So

    tr(n E n*) / phi + phi tr(n Phi^-1 n*)

is what is made least: a direction with less noise by chance has a Phi^-1 that is as much larger, and gains at second order alone. Where
the faults are loud the second term vanishes. In the rows, with lam the shares of the noise, it reads as if the moments held
phi^2 lam Phi^-1 lam in the outputs, so that the same descent serves.

    even_moments   the moments of [y; u] over phi, with that added: twice as many samples, since at the noise both terms are one
    Phi            from what an ARX model leaves of y and u, whose spectrum is flat: its covariances, each over a band of the test of
                   sphericity, times the model's filter
    phi            what Phi leaves in the rows of a fit
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from ..model.arx import Arx, adjoint, polynomial
from ..model.feedback import one_step_errors
from ..space.basis import KernelBasis
from ..space.tapered_moments import pooled_moments
from .joint import JointMoments
from .remainder import TEST_BANDS, as_signals, groups, remainder

ComplexArray = NDArray[np.complex128]

# Samples up to which the bands of the test of sphericity do. Of more samples the bands are narrower as well as fuller: their number grows
# with the root. It is where the bands of the test were calibrated; half or twice as many do no better (`degree_misfits.py --short`).
SHORT = 1000
TINY = float(np.finfo(float).tiny)


def even_moments(records: Sequence[tuple[Array, Array]], data: JointMoments, fit: KernelBasis, arx: Arx, shares: Array) -> JointMoments:
    """Return the moments under which rows of all degrees are compared, from those of the experiments (y, u), all longer than the lags of
    `arx`, which is in the units of `data`; `fit` are rows of the highest degree. Of white noise now: no colour is to be found."""
    moments, p = data.moments, data.p
    crossed = shares[:, None] * _inverse(records, data, arx) * shares
    rest = remainder(data, fit)
    shape = (rest.gains * shares) @ adjoint(rest.gains)
    strength = np.einsum("bii->b", np.linalg.solve(shape, rest.gains @ crossed @ adjoint(rest.gains))).real
    phi = len(fit.rows) / strength
    added = np.zeros((len(phi), moments.channels, moments.channels), dtype=np.complex128)
    added[:, :p, :p] = crossed * (phi * moments.weights)[:, None, None]
    powers = np.exp(1j * np.outer(moments.angles, np.arange(moments.degree + 1)))
    turned = powers[:, :, None] * powers.conj()[:, None]
    extra = (turned[:, :, None, :, None] * added[:, None, :, None, :]).reshape(moments.moments.shape)
    return replace(data, moments=replace(moments, moments=moments.moments / phi[:, None, None] + extra, samples=2 * moments.samples))


def _inverse(records: Sequence[tuple[Array, Array]], data: JointMoments, arx: Arx) -> ComplexArray:
    """Return Phi^-1 (bands, p, p), of y - G u in the units of the moments."""
    errors = [one_step_errors(y / data.scale[: data.p], u / data.scale[data.p :], arx, arx.order) for y, u in records]
    moments = pooled_moments(errors, 0, len(data.moments.angles))
    rest = as_signals(moments.moments / np.maximum(moments.weights, TINY)[:, None, None], moments)
    covariances = np.empty_like(rest.powers)
    for group in groups(rest, int(TEST_BANDS * max(1.0, rest.samples / SHORT) ** 0.5)):
        share = rest.weights[group]
        # The inverse of a covariance of so many samples is too large by count / (count - p) in the mean [M82].
        count = max(rest.samples * share.sum() / 2, 2.0 * data.p)
        covariances[group] = np.tensordot(share / share.sum(), rest.powers[group], 1) * count / (count - data.p)
    nearest = np.rint(np.interp(data.moments.angles, rest.angles, np.arange(len(rest.angles)))).astype(int)
    filters = polynomial(arx.outputs, data.moments.angles)
    return adjoint(filters) @ np.linalg.solve(covariances[nearest], filters)
