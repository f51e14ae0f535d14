"""What a record says to kernel rows of a total degree: its moments, and the models that rows begin from.

    Evidence            the moments of [y; u] for rows of degree order + EXTRA, those for long single rows, and the models
    quick, higher       models of the order and of EXTRA states more, from the ARX model in milliseconds: starts, no estimates
    unexplained         the moments of what the model of `arx_reduction` leaves of y
    quick_reduction     such a model, in the units of the ARX model
    disturbance         the spectrum of what disturbs y, by the ARX model alone, whatever the order; `apparent` rows seem to be laws by it

Everything is made when it is first asked for, and once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ...data.validation import experiment
from ..model.arx import Arx, fitted_arx
from ..model.arx_windows import arx_windows, merge_windows
from ..model.asymptotic_likelihood import arx_reduction_experiments, lengths_and_lags
from ..model.invariants import state_space
from ..model.models import StateSpaceModel
from ..model.reduced_model import ReducedModel
from ..model.reduction_starts import realisations
from ..model.residuals import residual
from ..model.weighted_reduction import Reduction, circle, descend, spectral_radius
from ..space.tapered_moments import BANDS, pooled_moments
from .joint import JointMoments, joint_moments
from .remainder import Remainder, as_signals

# Degrees beyond the order by which flatness is seen: one more could still be explained by a single root of the colour of a fault.
EXTRA = 3
# And of a single row, which flatness alone judges: the remainder of a fault that is smooth over frequency gains slowly.
LONG = 10
# Samples up to which the usual number of bands does.
SHORT = 2000
# Share of the initial state's error, itself far below the noise, that is left where it is thought to have died away.
GONE = 1e-4
# Of a descent that only makes a start: at most so many steps, until one gains no more than such a share.
ANGLES, STEPS, GAIN = 32, 25, 1e-2
TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What experiments, pairs y (N_i, p) and u (N_i, n_u), say to rows of total degree `order` and more; `given` is a model of such data
    where there is one."""

    experiments: Sequence[tuple[Array, Array]]
    order: int
    given: ReducedModel | None = None

    @cached_property
    def data(self) -> JointMoments:
        """The moments for rows of degree order + EXTRA, or as much of it as the record is long for."""
        return joint_moments(self.experiments, self.order + max(1, min(EXTRA, self.longest - self.order)), self.bands)

    @property
    def samples(self) -> int:
        """How many samples the experiments have together."""
        return sum(len(y) for y, _ in self.experiments)

    @property
    def bands(self) -> int:
        """So many bands that what changes within one stays below the noise of the record: its power falls with the square of the width."""
        return int(BANDS * max(1.0, self.samples / SHORT) ** 0.5)

    @property
    def narrow(self) -> float:
        """How much larger the misfit of flatness of several rows is taken on records longer than SHORT: where faults leave a frequency to
        the noise it grows with the root of the samples there, as the root of the number of bands does."""
        return float((len(self.data.moments.angles) / BANDS) ** 0.5) if self.bands > BANDS else 1.0

    @property
    def longest(self) -> int:
        """The highest degree for which every experiment has twice as many windows as a window has entries."""
        return min(longest_degree(*one) for one in self.experiments)

    @cached_property
    def single(self) -> JointMoments:
        """The moments for a single row, of degree order + LONG or as much of it as the record is long for."""
        return joint_moments(self.experiments, self.order + max(1, min(LONG, self.longest - self.order)), self.bands)

    @cached_property
    def arx(self) -> Arx | None:
        """The ARX model in units of the moments, or None where the record gives none."""
        return arx_of(self.experiments, self.order, self.data.scale, None if self.given is None else self.given.arx)

    @cached_property
    def quick(self) -> StateSpaceModel | None:
        """A model of this order to begin from, in units of the moments, or None where there is none."""
        return self._quick(self.order)

    @cached_property
    def higher(self) -> StateSpaceModel | None:
        """A model of EXTRA states more."""
        return self._quick(self.order + EXTRA)

    def _quick(self, order: int) -> StateSpaceModel | None:
        try:
            return None if self.arx is None else quick_reduction(self.arx, order)
        except (InvalidData, np.linalg.LinAlgError):
            return None

    @cached_property
    def reduction(self) -> ReducedModel | None:
        """The model of this order, or None where the record gives none."""
        if self.given is not None and self.given.order == self.order:
            return self.given
        try:
            return arx_reduction_experiments(self.experiments, order=self.order)
        except InvalidData:
            return None

    @cached_property
    def unexplained(self) -> Remainder | None:
        """What the model leaves of y after the initial state, whose error would fill the nulls of the noise spectrum, has died away."""
        if self.reduction is None:
            return None
        radius = min(max(spectral_radius(self.reduction.model.A), TINY), 1 - 1 / max(len(y) for y, _ in self.experiments))
        rest = []
        for y, u in self.experiments:
            gone = min(int(np.log(GONE) / np.log(radius)) + 1, len(y) // 4)
            r = residual(y, u, self.reduction.model).r[gone:] / self.data.scale[: self.data.p]
            rest.append(r - r.mean(axis=0))
        moments = pooled_moments(rest, 0)
        return as_signals(moments.moments / moments.weights[:, None, None], moments)

    @cached_property
    def disturbance(self) -> Remainder | None:
        """What disturbs y by the ARX model."""
        return None if self.arx is None else as_signals(self.arx.disturbance(self.data.moments.angles), self.data.moments)

    @cached_property
    def apparent(self) -> int:
        """So many rows seem to be laws: the widest step between neighbouring powers of the disturbance, on average over frequency. This
        decides no answer, but what is asked first, and how often."""
        rest, p = self.disturbance, self.data.p
        if rest is None or p == 1:
            return p // 2
        powers = rest.weights @ np.log(np.maximum(np.linalg.eigvalsh(rest.powers), TINY))
        return 1 + int(np.argmax(np.diff(powers)))


def arx_of(experiments: Sequence[tuple[Array, Array]], order: int, scale: Array, given: Arx | None = None) -> Arx | None:
    """Return the ARX model of experiments (y, u) in units (p + n_u,) of the channels: that which is given, else one for this order, or None
    where they give none."""
    p = experiments[0][0].shape[1]
    if given is not None:
        return given.scaled(1 / scale[:p], 1 / scale[p:])
    sources = [experiment(y, u) for y, u in experiments]
    try:
        lengths, lags = lengths_and_lags(sources, order, None)
        windows = merge_windows([arx_windows(source, lags) for source, length in zip(sources, lengths, strict=True) if length > lags])
        y, u = windows.scales
        return fitted_arx(windows, -(-order // p)).scaled(y / scale[:p], u / scale[p:])
    except InvalidData:
        return None


def longest_degree(y: Array, u: Array) -> int:
    """Return the highest degree for which y (N, p) and u (N, n_u) have twice as many windows as a window has entries."""
    channels = int(y.shape[1] + u.shape[1])
    return (len(y) - 2 * channels) // (2 * channels + 1)


def quick_reduction(arx: Arx, n: int) -> StateSpaceModel:
    """Return a stable model of order n in the units of the ARX model, a start and no estimate: the best of the realisations of its Markov
    parameters [HK66, K78] under its own weight, improved by few steps at few angles, the input taken for white. Raises InvalidData where
    the ARX model shows no dynamics to begin from."""
    angles = circle(ANGLES)
    n_u = arx.inputs.shape[2]
    white = np.broadcast_to(np.eye(n_u, dtype=np.complex128), (ANGLES, n_u, n_u))
    problem = Reduction(angles, arx.plant(angles), arx.weight(angles), white, arx.rows)
    begun = sorted(realisations(arx, problem, n, arx.order), key=lambda start: problem.cost(start, n))
    if not begun:
        raise InvalidData(f"no model of order {n} can be begun from this ARX model: try another order")
    return state_space(descend(problem, begun[0], n, STEPS, GAIN)[0], n)
