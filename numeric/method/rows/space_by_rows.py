"""Estimate the fault space from kernel rows of outputs and inputs, and A, C of the model.

The rows [N_y N_u] are fitted to [y; u] without the model, so that its error does not enter them. A fault column z = [f; g] belongs to the
space iff N_y (g + C (q - A)^-1 f) vanishes, that is iff it meets the conditions [X_(j+1), N_j] z = 0, X_j = N_j C + X_(j+1) A, of every
row ([G25] problem (11)). Of k rows with degrees eta_i there are sum (eta_i + 1) conditions, exactly n + p - n_z, so that rows and A, C
that do not fit exactly contradict each other nowhere: N_y O_s = 0, which holds for true ones, need not be imposed.

    pooled                  the moments of the experiments that carry such rows, as they are counted on
    compared                the fits whose likelihoods decide the total degree
    fault_space_by_rows     the space, its dimension with a probability, and the angle by which it may be off where A, C are right
    identified_fault_space  the same for an identified model, whose error is in the angle
    n_z                     n_v + n - (total degree of the rows): of an order that is too high by one, one too many

The total degree is not below the sum of the k = p - n_v least observability indices of (A, C), and not above n (`largest.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.validation import noise_deviations, positive, signals
from ..model.arx import Arx
from ..model.models import StateSpaceModel, observability_matrix
from ..model.reduced_model import ReducedModel
from ..model.uncertainty import Uncertainty
from ..model.valleys import last_state, valleys
from ..ranks.arguments import shaped
from ..ranks.sample_windows import ObservedCoordinates, channel_sizes, observed_coordinates
from ..space.basis import KernelBasis
from ..space.estimate import FaultSpaceEstimate, SpaceOfValley, SpaceUncertainty, everything, kernel_conditions, orthonormal
from ..space.largest import largest_fault_space
from ..space.space_uncertainty import space_uncertainty, turned_by_model
from ..space.tapered_moments import BANDS, SEGMENT
from .bootstrap import redrawn
from .degree import SLACK, LeastDegree, freedom, least_degree, likelihood_ratio, misfits
from .evidence import arx_of, longest_degree
from .faint_faults import even_moments
from .from_above import from_above
from .joint import ROUNDING, TURNS, JointMoments, compared_fits, course, even_split, joint_moments, refitted

Experiments = Sequence[tuple[Array, Array]]
# Frequencies of a segment in each band of the likelihoods that decide.
A_BAND = 4
# Entries of their moments that are held at once: 64 MB of complex numbers. A budget of memory.
NUMBERS = 2**22
# Total degrees beyond the order by which it is tested.
BEYOND = 1
SEED = 20251123
# What multiplies the model's part of the angle within a valley: the curvature of the likelihood at an estimate is larger, by chance, than
# it is at the truth. `python benchmarks/space_at_the_bound.py --calibrate` repeats the measurement: the 95 % quantile of the tangent of the
# angle over that of the stated one, not widened, where the estimate's own valley is alone. It was 1.45 (seeds 60001, 61000 and 62001, 68
# records of 1001 samples).
WIDENED = 1.5


@one_thread()
def fault_space_by_rows(
    y: ArrayLike | Experiments,
    u: ArrayLike | None,
    A: ArrayLike,
    C: ArrayLike,
    *,
    n_v: int,
    noise_level: ArrayLike | None = None,
    draws: int = 0,
) -> FaultSpaceEstimate:
    """Estimate the fault space of outputs y and inputs u for the model's A and C, from the laws that they obey.

    The number of zeros is decided by likelihood ratios of a stated level (`numeric/method/rows/degree.py`), whose misfit is calibrated. The
    angle of the answer takes n_z, A and C as right: `identified_fault_space` has the error of an identified model in it. The noise is taken
    to have one colour; noise of other ratios of powers than stated turns the space, and on long records hides that a degree suffices.
    Source: [G25] problem (11), [W91].

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
        In any units; with `u` None, `y` is a list of pairs (y, u), experiments with initial states of their own, those too short for the
        rows left out.
    A, C : array_like, (n, n) and (p, n)
    n_v : int
        Number of faults, 1 to p - 1; of p faults the answer is one that means nothing, with a reason.
    noise_level : float or (p,), optional
        Deviations of the noise in units of y, of which only the ratios matter, by default those of the outputs: the root of `noise_power`
        of `count_faults` serves.
    draws : int
        Records of the parametric bootstrap that estimates the misfit of this record instead; ten take seconds at a thousand samples. Faults
        are as loud there as they are here with the noise, so that where they are faint it is uncertain.

    Returns
    -------
    FaultSpaceEstimate
        `basis` (n + p, n_z) in the states of A and the units of y, with its `uncertainty`.

    Raises
    ------
    InvalidData
        Shapes that do not fit, n_v outside 1 .. p, records too short for p - n_v rows whose degrees add up to one more than the states that
        the outputs show.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import fault_space_by_rows
    >>> rng = np.random.default_rng(0)
    >>> u, v = rng.standard_normal((300, 1)), rng.standard_normal((300, 1))
    >>> y = np.hstack([u + v, u - v]) + 0.01 * rng.standard_normal((300, 2))
    >>> fault_space_by_rows(y, u, np.zeros((0, 0)), np.zeros((2, 0)), n_v=1).G.ravel().round(1) ** 2
    array([0.49, 0.49])
    """
    records = _experiments(y, u)
    outputs, A, C = shaped(_outputs(records), A, C)
    rows = _fitted(records, outputs, A, C, n_v, noise_level, draws)
    return rows if isinstance(rows, FaultSpaceEstimate) else _estimate(rows, _solved(rows, outputs, A, C, np.zeros((A.size + C.size, 0))))


@one_thread()
def identified_fault_space(
    y: ArrayLike | Experiments, u: ArrayLike | None, model: ReducedModel, *, n_v: int, noise_level: ArrayLike | None = None, draws: int = 0
) -> FaultSpaceEstimate:
    """Estimate the fault space of outputs y and inputs u for a model that `arx_reduction` found in such data, its error in the angle.

    The likelihood of a model has several valleys in short records: models with other poles that explain the data as well
    (`numeric/method/model/valleys.py`). The space is that of the given model; the angle is over all valleys, each with its probability. In
    each of them the covariance of A and C is carried to the space to first order [MN89], widened by what
    `benchmarks/space_at_the_bound.py --calibrate` measures, and added to that of the rows. Both take the order and the number of zeros as
    right. A state too many is a zero too many: where the data would rather do with a state less, zeros are undecided if the data chose the
    order, and hold for the order that was given, which the reason then says. The benchmark counts how often the angle holds; one above half
    a radian says that the space is hardly known. The states are matched with the true ones by least squares of the observability matrices.

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
    model : ReducedModel
    n_v : int
        Number of faults.
    noise_level : float or (p,), optional
    draws : int
        All but `model` as of `fault_space_by_rows`.

    Returns
    -------
    FaultSpaceEstimate
        `basis` (n + p, n_z) in the states of the model and the units of y, with its `uncertainty`.

    Raises
    ------
    InvalidData
        As `fault_space_by_rows`.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, arx_reduction, identified_fault_space
    >>> rng = np.random.default_rng(0)
    >>> u, v, w = rng.standard_normal((3, 500, 2)) * np.array([[[1.0]], [[1.0]], [[0.01]]])
    >>> y = StateSpaceModel([[0.5]], [[1.0, 2.0]], [[1.0], [1.0]], [[0.0, 1.0], [0.0, 0.0]]).simulate(np.hstack([u[:, :1], v[:, :1]])) + w
    >>> found = identified_fault_space(y, u[:, :1], arx_reduction(y, u[:, :1], order=1), n_v=1)
    >>> found.n_z, bool(found.uncertainty.angle() < 0.2)
    (1, True)
    """
    records = _experiments(y, u)
    outputs, A, C = shaped(_outputs(records), model.model.A, model.model.C)
    rows = _fitted(records, outputs, A, C, n_v, noise_level, draws, model.arx)
    if isinstance(rows, FaultSpaceEstimate):
        return rows
    known = valleys(model)
    spaces = [_solved(rows, outputs, one.uncertainty.model.A, one.uncertainty.model.C, _of_states(one.uncertainty)) for one in known]
    turns = [_turn(outputs, model.model, one.uncertainty.model) for one in known]
    found = _with_order(_estimate(rows, spaces[0]), model)
    weighed = [space.turned(turn, one.weight) for space, turn, one in zip(spaces, turns, known, strict=True)]
    return replace(found, uncertainty=SpaceUncertainty(spaces[0].root, tuple(weighed)))


def _with_order(found: FaultSpaceEstimate, model: ReducedModel) -> FaultSpaceEstimate:
    """Return the estimate with its condition where the data would rather do with a state less: a surplus state would be one of the zeros.

    It is undecided where the data chose the order, and holds for the order that was given, which it says. Without zeros the rows
    themselves need the order.
    """
    if not found.decided or found.n_z == found.n_v:
        return found
    last = last_state(model)
    if last.worth >= 1:
        return found
    doubt = f"order {found.n - 1} explains the data nearly as well (likelihood ratio {last.gain:.2g} with {last.parameters} parameters)"
    if model.orders is None:
        return replace(
            found, finding=f"if the order is {found.n}, as given: {found.finding}; {doubt}, and a state too many is a zero too many"
        )
    return replace(
        found, decided=False, margin=last.worth, finding=f"{found.finding}; but {doubt}, and a state too many is a zero too many"
    )


@dataclass(frozen=True, eq=False)
class _Rows:
    """The rows of the degree that was chosen for n_v faults, what they were fitted to, the largest n_z that the estimate's A, C allow, and
    the `misfit` by which likelihood ratios exceed their law, which widens the covariance of the rows [MN89]."""

    data: JointMoments
    fit: KernelBasis
    chosen: LeastDegree
    n_v: int
    largest: int
    misfit: float


@dataclass(frozen=True, eq=False)
class _Solved:
    """The columns that rows and some A, C (p, n) admit: singular values of the conditions, orthonormal basis, root of its covariance."""

    strengths: Array
    basis: Array
    root: Array
    n: int

    def turned(self, turn: Array, weight: float) -> SpaceOfValley:
        """Return the space in other states, to which `turn` (n, n) takes those of this model."""
        change = scipy.linalg.block_diag(turn, np.eye(len(self.basis) - self.n))
        Q, R = np.linalg.qr(change @ self.basis)
        moved = change @ self.root
        return SpaceOfValley(weight, Q, np.asarray((moved - Q @ (Q.T @ moved)) @ np.linalg.inv(R)))


def _turn(outputs: Array, target: StateSpaceModel, source: StateSpaceModel) -> Array:
    """Return the map (n, n) of the states of one model to those of another, by least squares of what the outputs show of them."""
    if not target.n or not source.n:
        return np.zeros((target.n, source.n))
    sizes = np.tile(channel_sizes(outputs), 2 * target.n)[:, None]
    seen, given = (observability_matrix(model.A, model.C, 2 * target.n) / sizes for model in (target, source))
    return np.asarray(np.linalg.lstsq(seen, given, rcond=None)[0], dtype=np.float64)


def _of_states(uncertainty: Uncertainty) -> Array:
    """Return the root of the covariance of the entries [A; C] (n + p, n), in row order."""
    model, root = uncertainty.model, uncertainty.root
    n, p = model.n, model.p
    return np.asarray(root.reshape(n + p, n + model.n_u, root.shape[1])[:, :n].reshape((n + p) * n, root.shape[1]))


def _experiments(y: Any, u: ArrayLike | None) -> list[tuple[Array, Array]]:
    """Return the experiments, checked, of y and u, or of a list of pairs."""
    if u is not None:
        return [signals(y, u)]
    if not isinstance(y, Sequence) or not y or not all(isinstance(one, tuple) and len(one) == 2 for one in y):
        raise InvalidData("u is missing: pass it, or a list of pairs (y, u), one an experiment")
    return [signals(*one) for one in y]


def _outputs(records: Experiments) -> Array:
    """Return the outputs of all experiments, one after the other."""
    return records[0][0] if len(records) == 1 else np.vstack([y for y, _ in records])


def pooled(records: Experiments, degree: int, bands: int = BANDS) -> JointMoments:
    """Return the moments of the experiments (y, u) that are long enough for rows up to this degree: all of one, so that it says itself what
    it lacks. Bands, at most so many, follow from the samples of all together, which a short one need not fill by itself. Raises
    InvalidData as `joint_moments`."""
    kept = [record for record in records if longest_degree(*record) >= degree]
    return joint_moments(kept or [max(records, key=lambda record: len(record[0]))], degree, bands)


@dataclass(frozen=True, eq=False)
class Compared:
    """The fits of total degrees 0, 1, .. of a course, `data` in bands as narrow as memory allows, and the `moments` under which the
    likelihoods of the degrees are compared, with the `fits` to these."""

    course: list[KernelBasis]
    data: JointMoments
    moments: JointMoments
    fits: list[KernelBasis]


def compared(records: Experiments, wide: JointMoments, rows: int, most: int, shares: Array, n: int, arx: Arx | None = None) -> Compared:
    """Return the likeliest rows of total degrees up to `most`; `wide` are moments of the same experiments in the usual bands, in which they
    are sought, `arx` is a model of such data, where there is one, and n an order for another."""
    fits = from_above(wide, course(wide, rows, most, shares=shares), shares=shares)
    bands = max(BANDS, min(SEGMENT // 2 // A_BAND, NUMBERS // int(wide.moments.moments[0].size)))
    data = pooled(records, wide.degree, bands)
    moments = _even(records, data, refitted(data, even_split(most, rows), fits[-1].rows, shares=shares), shares, n, arx)
    return Compared(fits, data, moments, compared_fits(moments, fits, shares))


def _even(records: Experiments, data: JointMoments, fit: KernelBasis, shares: Array, n: int, arx: Arx | None) -> JointMoments:
    """Return the moments under which degrees are compared, of the noise that these rows of the highest degree leave: those that are even
    where the faults are faint, or the plain ones where the record gives no ARX model, or its noise is rounding."""
    if fit.level > np.log(ROUNDING) and (model := arx_of(records, n, data.scale, arx)) is not None:
        longer = [record for record in records if len(record[0]) > model.order]
        return even_moments(longer, data, fit, model, shares)
    over = data.moments.moments / fit.spectrum[:, None, None]
    return replace(data, moments=replace(data.moments, moments=over))


def _fitted(
    records: list[tuple[Array, Array]],
    outputs: Array,
    A: Array,
    C: Array,
    n_v: int,
    noise_level: ArrayLike | None,
    draws: int,
    arx: Arx | None = None,
) -> _Rows | FaultSpaceEstimate:
    """Return the rows of the total degree that the data accept, or what there is to say where no row is left."""
    p, n = C.shape
    faults = positive(n_v, "n_v")
    if faults > p:
        raise InvalidData(
            f"n_v: got {n_v} with {counted(p, 'output')}; needed 1 <= n_v <= p (more faults than outputs cannot be told apart)"
        )
    if faults == p:
        reason = (
            f"{counted(p, 'fault')} in {counted(p, 'output')} {'leaves' if p == 1 else 'leave'} no "
            f"relation between the outputs: every column is a solution"
        )
        return everything(n, p, faults, n + 1, reason)
    coordinates = observed_coordinates(outputs, A, C, n + 1)
    rows, seen = p - faults, coordinates.observed
    data = pooled(records, -(-(seen + BEYOND) // rows))
    largest = largest_fault_space(coordinates.A, coordinates.C, faults)
    shares = np.ones(p)
    if noise_level is not None:
        powers = (noise_deviations(noise_level, p) / data.scale[:p]) ** 2
        shares = powers / np.exp(np.mean(np.log(powers)))
    least = n + faults - largest
    both = compared(records, data, rows, seen + BEYOND, shares, n, arx)
    chosen = least_degree(both.moments, both.fits, least, seen, misfits(len(both.fits) - 1))
    widened = 1 + SLACK[0]
    if draws:
        drawn = _misfits(records, both, chosen, shares, draws, n)
        chosen, widened = least_degree(both.moments, both.fits, least, seen, drawn), max(widened, drawn[0])
    return _Rows(both.data, _shown(both, chosen.degree, shares), chosen, faults, largest, widened)


def _shown(both: Compared, degree: int, shares: Array) -> KernelBasis:
    """Return the likeliest rows of a total degree, whose covariance is known."""
    degrees, flat = even_split(degree, len(both.fits[degree].rows)), 1 / both.data.samples
    starts = (both.course[degree].rows, both.fits[degree].rows)
    trials = [refitted(both.data, degrees, start, shares=shares, rounds=TURNS, flat=flat) for start in starts]
    return min(trials, key=lambda trial: trial.level)


def _solved(rows: _Rows, outputs: Array, A: Array, C: Array, model_root: Array) -> _Solved:
    """Return what the rows say with A, C whose entries [A; C], in row order, have the covariance model_root @ model_root.T."""
    p, n = C.shape
    coordinates = observed_coordinates(outputs, A, C, n + 1)
    units = coordinates.scale / rows.data.scale[:p]
    rows_of_y = [row[:, :p] * units for row in rows.fit.rows]
    strengths, columns = solutions(rows_of_y, coordinates, rows.n_v + n - rows.chosen.degree)
    of_rows = space_uncertainty(rows_of_y, _selections(rows.fit, units), rows.misfit * rows.fit.covariance, coordinates, columns).root
    of_model = WIDENED * np.tensordot(_observed(model_root, coordinates).T, turned_by_model(rows_of_y, coordinates, columns), axes=1)
    return _Solved(strengths, orthonormal(coordinates.back(columns)), np.concatenate([of_rows, of_model]), n)


def _estimate(rows: _Rows, solved: _Solved) -> FaultSpaceEstimate:
    """Return the answer."""
    n, chosen, n_v = solved.n, rows.chosen, rows.n_v
    p, n_z = len(solved.basis) - n, n_v + n - chosen.degree
    lag = max(map(len, rows.fit.rows)) - 1
    words = "; as many as the observability indices of (A, C) allow" if n_z == rows.largest else ""
    if n_z > n_v:
        words += "; what the data cannot tell from a zero counts as one"
    finding = f"n_z = {n_z} = n_v + zeta = {n_v} + {n_z - n_v}; for the rows total {chosen.reason}{words}"
    return FaultSpaceEstimate(
        solved.basis,
        n_z,
        n,
        n_v,
        lag,
        lag + 1,
        solved.strengths,
        n + p - n_z,
        n + p,
        chosen.margin,
        chosen.decided,
        True,
        finding,
        None,
        "kernel rows",
        SpaceUncertainty(solved.root),
    )


def _observed(model_root: Array, coordinates: ObservedCoordinates) -> Array:
    """Return a root of the covariance of [A; C] in the observed coordinates from that in the given ones."""
    p, n = coordinates.C.shape
    left = scipy.linalg.block_diag(coordinates.T, np.diag(1 / coordinates.scale))
    changes = model_root.reshape(n + p, n, model_root.shape[1])
    return np.asarray(np.einsum("ir,rcq,cj->ijq", left, changes, np.linalg.inv(coordinates.T)).reshape(model_root.shape))


def _misfits(records: Experiments, found: Compared, chosen: LeastDegree, shares: Array, draws: int, n: int) -> list[float]:
    """Return the means of the ratios over their degrees of freedom, for one degree more, two, .., on records made from the chosen fit."""
    data, fits, ratios = found.data, found.fits, []
    kept = [record for record in records if longest_degree(*record) >= data.degree]
    fit, highest = _shown(found, chosen.degree, shares), _shown(found, len(fits) - 1, shares)
    made = [redrawn(y, u, data, fit, shares, draws, SEED + number) for number, (y, u) in enumerate(kept)]
    for outputs in zip(*made, strict=True):
        pairs = [(y, u) for y, (_, u) in zip(outputs, kept, strict=True)]
        again = joint_moments(pairs, data.degree, len(data.moments.angles))
        moments = _even(pairs, again, highest, shares, n, None)
        steps = compared_fits(moments, fits[chosen.degree :], shares)
        ratios.append([likelihood_ratio(moments, steps[0], step) / freedom(moments, steps[0], step) for step in steps[1:]])
    return [max(float(mean), 1.0) for mean in np.mean(ratios, axis=0)] or [1.0]


def solutions(rows: Sequence[Array], coordinates: ObservedCoordinates, n_z: int) -> tuple[Array, Array]:
    """Return the n + p singular values of the conditions of rows N_y (eta_i + 1, p), and the columns (n + p, n_z) that meet them best."""
    p, n = coordinates.C.shape
    conditions = np.vstack([kernel_conditions(row[None], coordinates.A, coordinates.C)[0] for row in rows])
    _, values, right = np.linalg.svd(conditions)
    return np.concatenate([values, np.zeros(n + p - values.size)]), right[n + p - n_z :].T


def _selections(fit: KernelBasis, units: Array) -> list[Array]:
    """Return, for each row, (q_i, p (eta_i + 1)): what a unit change of a coefficient does to those of the outputs, in other units."""
    p = len(units)
    each = [np.pad(np.diag(units), ((0, row.shape[1] - p), (0, 0))) for row in fit.rows]
    return [np.asarray(np.kron(np.eye(len(row)), change), dtype=np.float64) for row, change in zip(fit.rows, each, strict=True)]
