"""Test whether k kernel rows of total degree n are laws that outputs and inputs obey up to noise, by likelihood ratios.

    sphericity   k >= 2: the remainder has one colour and the shape that noise of the channels gives it (`remainder.py`)
    flatness     rows of total degree n + EXTRA, a single one of degree n + LONG too, explain no more than noise does (`degree.py`)

Both are true of k <= p - n_v rows. Of more rows the faults are left in the remainder: its shape is theirs, and longer rows still gain. The
noise shares of the channels are estimated in turns with the rows; of a single row they are not identifiable and stay as stated.

Several rows begin from a model of the system (`model_rows`), which is made in milliseconds and only a start (`evidence.py`). Their
descent must have arrived before shares are estimated: those of a remainder that still holds faults run away. A descent may end elsewhere
(one of the first 48, seed 310014 of the benchmark); so a second one is made where the first leaves no laws, unless the disturbance of the
ARX model shows fewer, too. All p rows together say that no fault acts: y less what the model makes of u and of the initial state is
noise. Of them the model's residual is asked itself and not the rows, whose whitening would divide by a determinant that changes within a
band; where the disturbance of the ARX model has clearly another shape, that is enough.

    Laws         k rows with their level, shares, both ratios with their probabilities, and `holds`: True, False, or None in between
    step_to_two  what a single row leaves less than two: how far a last fault must stand above the noise
    tested       the test; with draws > 0 the misfit of the ratios is measured by the parametric bootstrap

What the constants rest on. SUFFICES is a level, and FAILS lies so far below it that no misfit explains it. SHAPE_MISFIT and FLAT_MISFIT
make the stated laws of several rows true at one in ten, and FAR is the middle, on a logarithmic scale, between the largest hundredth of
what the ratios of laws are in units of their misfits and the least hundredth of it where there is a row too many:
`benchmarks/counting_at_the_bound.py laws` prints all three. Ratios of laws keep their size where N grows and those of others grow with N,
so that the middle of N = 1001 serves longer records. CROWDED and LOOSE make the law of a single row true at one in ten, for 300 to 30001
samples: `counting_at_the_bound.py single` prints the quantile regression. The others end iterations or save time:
`counting_at_the_bound.py settings` counts the answers that change when each is halved and doubled.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_tail
from ...data.plain import by_name, plain
from ..model.models import StateSpaceModel, lower_toeplitz, observability_matrix
from ..space.basis import ROUGH, KernelBasis, colour_of, kernel_basis
from .bootstrap import redrawn
from .evidence import EXTRA, Evidence
from .joint import PRECISION, JointMoments, course, even_split, fitted, padded, refitted
from .remainder import Remainder, Sphericity, loose_samples, noise_shares, remainder, sphericity, whitened

# Turns of noise shares and rows, among the rows that a model admits and among all.
TURNS = 4
# Nats that a descent under the first shares gains at last, and its most repetitions.
ARRIVED, ARRIVALS = 0.1, 10
# Of the expected sphericity, what a turn gains at least for another one to follow.
SETTLED = 0.05
# By so much the ratios of sphericity and of flatness, of several rows, exceed the stated laws where the rows are laws: one in ten is
# beyond the tenth of the law times the misfit.
SHAPE_MISFIT, FLAT_MISFIT = 1.3, 3.0
# Of a single row the misfit of flatness is 1 + CROWDED / root(samples of a band) + LOOSE root(loose samples) / freedom, for EXTRA and
# for LONG.
CROWDED, LOOSE = (2.4, 3.7), (0.43, 5.1)
# Probabilities from which rows are laws, and below which a single row is none. Rows that are no laws are far below.
SUFFICES, FAILS = 0.01, 1e-12
# Several rows are refuted by a ratio so many times its misfit: beyond what a descent that ended elsewhere leaves of laws. And so many times
# beyond that they are worth neither another start nor a bootstrap.
FAR, HOPELESS = 5.5, 2.0
SEED = 20251122
ROUNDS = 1  # turns of colour and rows that begin from a model; what follows has more


@dataclass(frozen=True, eq=False)
class Laws:
    """k = `count` rows: `fit` has the total degree n, and `gain` is what rows of degree n + EXTRA gain, in nats.

    The noise `shares` (p,) have the mean logarithm zero and are in the units of the moments. `flatness` is the probability of such a gain,
    if the rows are laws; `probability` is that of ratios as large: of one row that of its flatness, of several twice the smaller one of
    the two. `ratios` are those of flatness over their degrees of freedom, before any misfit but that of narrow bands of several rows: none
    where the shape is hopeless, two of a single row. `longest` is the fit of a single row of the highest degree that was tried.
    """

    count: int
    fit: KernelBasis
    shares: Array
    sphericity: Sphericity | None
    gain: float
    flatness: float
    probability: float
    ratios: tuple[float, ...] = ()
    longest: KernelBasis | None = None

    @property
    def level(self) -> float:
        """Return the logarithm of the noise power, in units of the moments, that the rows leave in each of their signals."""
        return self.fit.level

    @property
    def holds(self) -> bool | None:
        """Return whether they are laws; None where it is a near thing."""
        if self.probability >= SUFFICES:
            return True
        if self.sphericity is None:
            return False if self.probability <= FAILS else None
        return False if self.farness > 1.0 else None

    @property
    def farness(self) -> float:
        """Return the larger ratio of several rows over what it should be, in units of FAR misfits: above one they are no laws."""
        shape = 0.0 if self.sphericity is None else self.sphericity.nats / (FAR * SHAPE_MISFIT * self.sphericity.expected)
        return max([shape] + [ratio / (FAR * FLAT_MISFIT) for ratio in self.ratios])

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of the numbers that the answer rests on; the ratio of sphericity is null of a single row."""
        found = self.sphericity
        shape = None if found is None else {"log_likelihood_ratio": plain(found.nats), "expected": plain(found.expected)}
        return {"rows": self.count, "sphericity": shape} | by_name(self, "holds", "probability", "level", "gain", "shares")


@dataclass(frozen=True)
class Misfits:
    """By these the ratios of sphericity and of flatness are divided; None of a single row stands for `single_misfits`."""

    shape: float = SHAPE_MISFIT
    flat: float = FLAT_MISFIT
    single: tuple[float, ...] | None = None


def tested(evidence: Evidence, count: int, shares: Array | None = None) -> Laws:
    """Test `count` rows; `shares` (p,) are those of the channels where they are known."""
    if count == 1:
        return _single(evidence, np.ones(evidence.data.p) if shares is None else shares)
    if count == evidence.data.p and evidence.disturbance is not None:
        laws = _all(evidence, evidence.disturbance, shares, Misfits())
        if _hopeless(laws) or evidence.unexplained is None:
            return laws
        return _all(evidence, evidence.unexplained, shares, Misfits())
    best: Laws | None = None
    for number, (fit, found) in enumerate(_descents(evidence, count, shares)):
        laws = _several(evidence, fit, found, Misfits())
        best = laws if best is None else max(best, laws, key=lambda each: (each.probability, -each.farness))
        # One descent may end elsewhere. Where the disturbance, too, shows fewer laws, it is enough; else a second one must confirm it.
        if best.holds or (_hopeless(best) and (number > 0 or count > evidence.apparent)):
            break
    assert best is not None
    return best


def _all(evidence: Evidence, rest: Remainder, known: Array | None, misfits: Misfits) -> Laws:
    """Return all p rows, those of a model, by what it leaves of the outputs, of which one of so many signals has the stated level."""
    data, p = evidence.data, evidence.data.p
    shares = noise_shares(rest, np.ones(p)) if known is None else known
    shape = sphericity(rest, shares, misfits.shape)
    power = np.einsum("bii->b", whitened(rest, shares)).real / p
    colour = colour_of(power, rest.angles, rest.weights)
    level = float(np.log(np.sum(power / colour * rest.weights)))
    degrees, model = even_split(evidence.order, p), evidence.quick
    fit = fitted(data, degrees, shares=shares, rounds=1, flat=ROUGH) if model is None else model_rows(data, model, degrees, shares)
    return Laws(p, replace(fit, level=level, spectrum=colour), shares, shape, 0.0, 1.0, shape.level)


def _descents(evidence: Evidence, count: int, known: Array | None) -> Iterator[tuple[KernelBasis, Array]]:
    """Yield rows with their shares: from a model, from lower degrees, and step by step from degree zero, until one holds."""
    data, degrees = evidence.data, even_split(evidence.order, count)
    equal = np.ones(data.p) if known is None else known
    if evidence.quick is not None:
        fit = model_rows(data, evidence.quick, degrees, equal)
        yield _with_shares(data, fit, equal, known is not None)
    short = fitted(data, even_split(evidence.order // 2 + 1, count), shares=equal, rounds=1, flat=ROUGH).rows
    fit = fitted(data, degrees, [padded(short, degrees), padded(short, degrees, below=True)], shares=equal, rounds=1, flat=ROUGH)
    fit, shares = _with_shares(data, fit, equal, known is not None)
    yield fit, shares
    fit = course(data, count, evidence.order, shares=shares, rounds=3)[-1]
    yield _with_shares(data, fit, shares, known is not None)


def _hopeless(laws: Laws) -> bool:
    """Return whether a ratio is far beyond what any misfit makes of laws."""
    return laws.farness > HOPELESS


def _with_shares(data: JointMoments, fit: KernelBasis, shares: Array, known: bool) -> tuple[KernelBasis, Array]:
    """Estimate rows and shares in turns, as long as the remainder becomes more spherical; shares that are known stay."""
    degrees = [len(row) - 1 for row in fit.rows]
    # Shares of what is not yet near the noise run away from those of the noise.
    for _ in range(ARRIVALS):
        before, fit = fit.level, refitted(data, degrees, fit.rows, shares=shares, rounds=2, flat=ROUGH)
        if before - fit.level < ARRIVED:
            break
    best = sphericity(remainder(data, fit), shares)
    for _ in range(0 if known else TURNS):
        found = noise_shares(remainder(data, fit), shares)
        trial = refitted(data, degrees, fit.rows, shares=found, rounds=1, flat=ROUGH)
        shape = sphericity(remainder(data, trial), found)
        if not shape.nats < best.nats:
            break
        settled = shape.nats > best.nats - SETTLED * shape.expected
        fit, shares, best = trial, found, shape
        if settled:
            break
    if best.nats > HOPELESS * FAR * SHAPE_MISFIT * best.expected:
        return fit, shares
    return refitted(data, degrees, fit.rows, shares=shares, rounds=3, flat=_flat(data)), shares


def _flat(data: JointMoments) -> float:
    """Return the nats below which a step changes no ratio, whose unit is 1 / samples."""
    return PRECISION / data.samples


def _several(evidence: Evidence, fit: KernelBasis, shares: Array, misfits: Misfits) -> Laws:
    """Return several rows with both ratios. Where their shape is hopeless, longer rows are not asked."""
    data, count = evidence.data, len(fit.rows)
    shape = sphericity(remainder(data, fit), shares, misfits.shape)
    if shape.nats > HOPELESS * FAR * SHAPE_MISFIT * shape.expected:
        return Laws(count, fit, shares, shape, 0.0, 1.0, min(1.0, 2 * shape.level))
    extra = data.degree - evidence.order
    longer = refitted(data, even_split(evidence.order + extra, count), fit.rows, shares=shares, rounds=2, flat=_flat(data))
    gain = fit.level - longer.level
    ratio = data.samples * count * max(gain, 0.0)
    freedom = extra * data.moments.channels
    ratio /= evidence.narrow
    flat = chi_squared_tail(ratio / misfits.flat, freedom)
    return Laws(count, fit, shares, shape, gain, flat, min(1.0, 2 * min(flat, shape.level)), (ratio / freedom,))


def _single(evidence: Evidence, shares: Array, misfits: Misfits = Misfits(), start: KernelBasis | None = None) -> Laws:
    """Return a single row, refitted from `start` where there is one, with its ratio for EXTRA and for LONG more degrees."""
    data, order = evidence.single, evidence.order
    if start is None:
        short = fitted(data, (order // 2 + 1,), shares=shares, rounds=1, flat=ROUGH).rows
        starts = [padded(short, (order,)), padded(short, (order,), below=True)]
        if evidence.quick is not None:
            starts.append(list(model_rows(data, evidence.quick, (order,), shares).rows))
        fit = fitted(data, (order,), starts, shares=shares, rounds=3, flat=_flat(data))
    else:
        fit = refitted(data, (order,), start.rows, shares=shares, rounds=3, flat=_flat(data))
    longest, probability, gains, ratios = fit, 1.0, list[float](), list[float]()
    steps = [EXTRA, data.degree - order] if data.degree > order + EXTRA else [data.degree - order]
    freedoms = [degrees * data.moments.channels for degrees in steps]
    divisors = misfits.single or single_misfits(evidence, fit, shares, freedoms)
    for degrees, freedom, misfit in zip(steps, freedoms, divisors, strict=False):
        longest = refitted(data, (order + degrees,), longest.rows, shares=shares, rounds=3, flat=_flat(data))
        gains.append(max(fit.level - longest.level, 0.0))
        ratios.append(data.samples * gains[-1] / freedom)
        probability = min(probability, len(steps) * chi_squared_tail(ratios[-1] * freedom / misfit, freedom))
    return Laws(1, fit, shares, None, gains[0], probability, probability, tuple(ratios), longest)


def single_misfits(evidence: Evidence, fit: KernelBasis, shares: Array, freedoms: Sequence[int]) -> tuple[float, ...]:
    """Return the means of the ratios of flatness over these degrees of freedom, if the row of this fit is a law.

    A root of a longer row near the unit circle fits the few samples of one band, and the best place for it is taken: what that gains
    beyond the stated law falls with the samples of a band. Where the faults leave a frequency to the noise the direction of a row is free
    there, and the least of equal powers is taken, which of so many samples lies below their mean by a multiple of one over their root.
    """
    data = evidence.single
    band = data.samples / (2 * len(data.moments.angles))
    rest = evidence.disturbance
    loose = 0.0 if rest is None else loose_samples(rest, data, fit, shares)
    terms = zip(CROWDED, LOOSE, freedoms, strict=False)
    return tuple(1 + crowded / band**0.5 + free * loose**0.5 / freedom for crowded, free, freedom in terms)


def bootstrapped(evidence: Evidence, laws: Laws, draws: int) -> Laws:
    """Return the laws with probabilities by the misfit of so many records made from the rows, or as they are where they are hopeless."""
    if _hopeless(laws):
        return laws
    found = []
    inputs = [u for _, u in evidence.experiments]
    records = [
        redrawn(y, u, evidence.data, laws.fit, laws.shares, draws, SEED + number) for number, (y, u) in enumerate(evidence.experiments)
    ]
    for outputs in zip(*records, strict=True):
        one = _again(replace(evidence, experiments=list(zip(outputs, inputs, strict=True))), laws, Misfits(1.0, 1.0, (1.0, 1.0)))
        found.append(([one.sphericity.nats / one.sphericity.expected] if one.sphericity else []) + list(one.ratios))
    means = tuple(np.maximum(np.mean(found, axis=0), 1.0).tolist())
    return _again(evidence, laws, Misfits(single=means) if laws.count == 1 else Misfits(*means))


def _again(evidence: Evidence, laws: Laws, misfits: Misfits) -> Laws:
    """Return laws tested on such evidence, from the rows that they had, with these misfits."""
    if laws.count == 1:
        return _single(evidence, laws.shares, misfits, laws.fit)
    if laws.count == evidence.data.p and evidence.unexplained is not None:
        return _all(evidence, evidence.unexplained, laws.shares, misfits)
    degrees = [len(row) - 1 for row in laws.fit.rows]
    return _several(evidence, refitted(evidence.data, degrees, laws.fit.rows, shares=laws.shares, rounds=3), laws.shares, misfits)


def longer_are_laws(evidence: Evidence, refused: Laws, known: Array | None) -> bool:
    """Return whether as many rows as those refused, of degree order + EXTRA, have about the shape of noise: then the order is too low for
    fewer."""
    data, count = evidence.data, refused.count
    if count == data.p and evidence.disturbance is not None:
        shape = sphericity(evidence.disturbance, noise_shares(evidence.disturbance, refused.shares) if known is None else known)
        return shape.nats <= FAR * SHAPE_MISFIT * shape.expected
    degrees = even_split(evidence.order + EXTRA, count)
    starts = [refitted(data, degrees, refused.fit.rows, shares=refused.shares, rounds=1, flat=ROUGH)]
    if evidence.higher is not None:
        starts.append(model_rows(data, evidence.higher, degrees, refused.shares))
    for start in starts:
        fit, shares = _with_shares(data, start, refused.shares, known is not None)
        shape = sphericity(remainder(data, fit), shares)
        if shape.nats <= FAR * SHAPE_MISFIT * shape.expected:
            return True
    return False


def step_to_two(evidence: Evidence, one: Laws, two: Laws) -> float:
    """Return by how many nats a single row leaves less than two: the least step of the shares of the single one and of any that make the
    two more spherical, each at the end of a descent."""
    data, degrees = evidence.data, even_split(evidence.order, 2)
    fit = refitted(data, degrees, two.fit.rows, shares=one.shares, rounds=3, flat=_flat(data))
    least, shares = fit.level, two.shares
    best = np.inf
    for _ in range(TURNS):
        fit = refitted(data, degrees, fit.rows, shares=shares, rounds=2, flat=_flat(data))
        nats = sphericity(remainder(data, fit), shares).nats
        if not nats < best:
            break
        least, best, shares = min(least, fit.level), nats, noise_shares(remainder(data, fit), shares)
    return least - one.level


def model_within(model: StateSpaceModel, degrees: Sequence[int]) -> list[Array]:
    """Return the vectors that the coefficients of a row may combine, for each degree eta (p (eta + 1) - n, (p + n_u) (eta + 1)), in the
    order of the window of [y; u]."""
    spaces = {eta: _annihilators(model, eta) for eta in set(degrees)}
    return [spaces[eta] for eta in degrees]


def _annihilators(model: StateSpaceModel, eta: int) -> Array:
    p, n_u, n = model.p, model.n_u, model.n
    left = np.linalg.svd(observability_matrix(model.A, model.C, eta + 1))[0][:, n:].T
    toeplitz = lower_toeplitz(model.markov(eta + 1))
    both = np.concatenate([left.reshape(-1, eta + 1, p), (-left @ toeplitz).reshape(-1, eta + 1, n_u)], axis=2)
    return np.asarray(np.linalg.qr(both.reshape(len(left), -1).T)[0].T, dtype=np.float64)


def model_rows(data: JointMoments, model: StateSpaceModel, degrees: Sequence[int], shares: Array | None = None) -> KernelBasis:
    """Fit the likeliest rows of these degrees that the model, in the units of the moments, admits.

    A row [N_y N_u] that annihilates [y; u] without faults has N_y O = 0 and N_u = -N_y T, O the observability matrix of its window and T
    the Toeplitz matrix of its Markov parameters [W91]; the rows that faults leave are among them. So few coefficients are free that the
    least combination is found from any start. Where the model is wrong, they are a start for rows whose coefficients are all free."""
    moments = data.moments.of_degree(max(degrees))
    return kernel_basis(moments, model_within(model, degrees), rounds=ROUNDS, shares=data.noise(shares), flat=ROUGH)
