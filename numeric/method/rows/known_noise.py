"""The fault space where healthy samples have told the covariance of the noise: found in outputs whose noise is white across them.

The rows take the noise to have one colour and, beside stated powers, nothing in common between outputs. Noise of outputs that go together
turns them: along the direction in which there is most noise a law costs least, and a fault that excites little beside it is then placed by
the noise. In outputs W y, W S W' = I for the covariance S of the healthy residual, what the rows take for granted holds as far as a
covariance can tell. Fault columns are [f; W g] there, and a model has W C and W D, so that the space is that of y once it is turned back.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import scipy.linalg

from ....base.arrays import Array
from ..model.models import StateSpaceModel
from ..model.reduced_model import ReducedModel
from ..model.uncertainty import Uncertainty
from ..ranks.sample_windows import channel_sizes
from ..space.estimate import FaultSpaceEstimate, SpaceOfValley, SpaceUncertainty
from .space_by_rows import identified_fault_space


def whitening(covariance: Array) -> Array | None:
    """Return W (p, p) with W S W' = I; None where S is no covariance of outputs that all have noise of their own."""
    sizes = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    if not np.all(np.isfinite(covariance)) or not np.all(sizes > 0.0):
        return None
    own = covariance / np.outer(sizes, sizes)
    if np.linalg.eigvalsh(own)[0] <= len(own) * np.finfo(np.float64).eps:
        return None
    return np.asarray(np.linalg.inv(np.linalg.cholesky(own)) / sizes)


def space_in_known_noise(y: Any, u: Array | None, model: ReducedModel, mix: Array, *, n_v: int) -> FaultSpaceEstimate:
    """Return what `identified_fault_space` finds in outputs y W', W = `mix` (p, p), turned back to those of y (N, p).

    Several experiments are a list of pairs (y, u), with None for u. Raises InvalidData as that does. Source: [G25] problem (11), [W91].
    """
    outputs = [(one @ mix.T, inputs) for one, inputs in y] if u is None else y @ mix.T
    found = identified_fault_space(outputs, u, _mixed(model, mix), n_v=n_v, noise_level=np.ones(len(mix)))
    back = scipy.linalg.block_diag(np.eye(model.order), np.linalg.inv(mix))
    known = found.uncertainty
    if known is not None:
        valleys = [SpaceOfValley(one.weight, *_turned(back, one.basis, one.root)) for one in known.valleys]
        known = SpaceUncertainty(_turned(back, found.basis, known.root)[1], tuple(valleys))
    return replace(found, basis=_turned(back, found.basis, np.zeros((0, *found.basis.shape)))[0], uncertainty=known)


def state_units(y: Array, mix: Array) -> Array:
    """Return U (p, p): the states of two models were matched by the least squares of U^-1 C A^k."""
    return np.asarray(np.linalg.inv(mix) * channel_sizes(y @ mix.T))


def _turned(change: Array, basis: Array, root: Array) -> tuple[Array, Array]:
    """Return the orthonormal basis (n + p, n_z) and the root (q, n + p, n_z) of its error after a change of coordinates."""
    Q, R = np.linalg.qr(change @ basis)
    moved = change @ root
    return Q, np.asarray((moved - Q @ (Q.T @ moved)) @ np.linalg.inv(R))


def _mixed(found: ReducedModel, mix: Array) -> ReducedModel:
    """Return the model of the outputs y W'."""
    model, likelihood, arx, back = found.model, found.likelihood, found.arx, np.linalg.inv(mix)
    mixed = StateSpaceModel(model.A, model.B, mix @ model.C, mix @ model.D)
    entries = found.uncertainty.root.reshape(model.n + model.p, -1)
    root = (scipy.linalg.block_diag(np.eye(model.n), mix) @ entries).reshape(found.uncertainty.root.shape)
    return replace(
        found,
        model=mixed,
        innovation_covariance=mix @ found.innovation_covariance @ mix.T,
        uncertainty=Uncertainty(mixed, root),
        arx=replace(arx, outputs=mix @ arx.outputs @ back, inputs=mix @ arx.inputs, covariance=mix @ arx.covariance @ mix.T),
        likelihood=replace(likelihood, plant=mix @ likelihood.plant, weight=back.T @ likelihood.weight @ back),
        offsets=tuple(mix @ offset for offset in found.offsets),
    )
