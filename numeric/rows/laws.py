"""Test whether k kernel rows of total degree n are laws that outputs and inputs obey up to noise, by two likelihood ratios.

    sphericity   k >= 2: the remainder has one colour and the shape that noise of the channels gives it (`remainder.py`)
    flatness     rows of total degree n + EXTRA explain no more than noise does (`degree.py`)

Both are true of k <= p - n_v rows. Of more rows the faults are left in the remainder: its shape is theirs, and longer rows still gain. The
noise shares of the channels are estimated in turns with the rows; of a single row they are not identifiable and stay as stated.

    Laws         k rows with their level, shares, both ratios with their probabilities, and `holds`: True, False, or None in between
    tested       the test; with draws > 0 the misfit of both ratios is measured by the parametric bootstrap

The constants have two origins. SHAPE_MISFIT, and MISFITS of `degree.py`, are means of the ratios where the rows are laws, which
`benchmarks/counting_at_the_bound.py calibrate` measures again on fresh seeds. The others were set by hand: SUFFICES is a level of one in
a hundred; FAILS lies far below it, for rows that are no laws were seen far below; FAR was settled after looking at the benchmark's records;
EXTRA, TURNS and HOPELESS are compromises between time and power. How often the answers are then right, `count` of that benchmark measures.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base.arrays import Array
from ..data.plain import plain
from ..space.basis import KernelBasis
from .bootstrap import redrawn
from .degree import MISFITS, excess, freedom, likelihood_ratio
from .joint import JointMoments, course, even_split, fitted, joint_moments, padded, refitted
from .remainder import Sphericity, noise_shares, remainder, sphericity

# Degrees beyond the order by which flatness is seen: one more could still be explained by a single root of the colour of a fault.
EXTRA = 3
# Turns of noise shares and rows.
TURNS = 4
# Mean of the ratio of sphericity over what it should have, where the rows are laws.
SHAPE_MISFIT = 1.3
# Ratios that many times their expectation are no law whatever the misfit, and are worth neither another start nor a bootstrap.
HOPELESS = 15.0
# Probabilities from which rows are laws, and below which a single row is none. Rows that are no laws are far below.
SUFFICES, FAILS = 0.01, 1e-12
# Several rows are refuted by a sphericity beyond what a descent that ended elsewhere leaves of laws: up to 4 times the expected one was
# seen on the benchmark's records, and 14 times or more where there are no laws.
FAR = 8.0
SEED = 20251122


@dataclass(frozen=True, eq=False)
class Laws:
    """These are k = `count` rows: `fit` has the total degree n and `longer` n + EXTRA; `gain` is what `longer` gains, in nats.

    The noise `shares` (p,) have the mean logarithm zero and are in the units of the moments. `probability` is that of ratios as large if
    the rows are laws: of one row that of its only ratio, of several twice the smaller one of the two.
    """

    count: int
    fit: KernelBasis
    longer: KernelBasis
    shares: Array
    sphericity: Sphericity | None
    gain: float
    probability: float
    shape_misfit: float
    misfit: float

    @property
    def level(self) -> float:
        """Return the logarithm of the noise power, in units of the moments, that the rows leave in each of their signals."""
        return self.fit.level

    @property
    def holds(self) -> bool | None:
        """Return whether they are laws; None where it is a near thing, or where they have the shape of laws but longer rows gain.

        The latter is an order that is too low, or a descent that ended elsewhere: no ground for another fault.
        """
        if self.probability >= SUFFICES:
            return True
        if self.sphericity is None:
            return False if self.probability <= FAILS else None
        return False if self.sphericity.nats > FAR * self.sphericity.expected else None

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of the numbers that the answer rests on; the ratio of sphericity is null of a single row."""
        shape = None if self.sphericity is None else {"nats": plain(self.sphericity.nats), "expected": plain(self.sphericity.expected)}
        return {
            "rows": self.count,
            "holds": self.holds,
            "probability": plain(self.probability),
            "level": plain(self.level),
            "gain": plain(self.gain),
            "sphericity": shape,
            "shares": plain(self.shares),
        }


def tested(data: JointMoments, count: int, order: int, shares: Array | None = None) -> Laws:
    """Test `count` rows on moments of degree order + EXTRA; `shares` are those of the channels where they are known."""
    known = np.ones(data.p) if shares is None else shares
    degrees = even_split(order, count)
    short = fitted(data, even_split(order // 2 + 1, count), shares=known, rounds=3).rows
    fit = fitted(data, degrees, [padded(short, degrees), padded(short, degrees, below=True)], shares=known, rounds=3)
    if count == 1 or shares is not None:
        return _with_probabilities(data, fit, known, MISFITS[-1], SHAPE_MISFIT)
    laws = _with_probabilities(data, *_with_shares(data, fit, known), MISFITS[-1], SHAPE_MISFIT)
    if laws.holds or _hopeless(data, laws):
        return laws
    # A descent from rows that were fitted to equal shares may have ended elsewhere; longer rows are nearer to the noise.
    for shares in (laws.shares, noise_shares(remainder(data, laws.longer), laws.shares)):
        fit = course(data, count, order, shares=shares, rounds=3)[-1]
        again = _with_probabilities(data, *_with_shares(data, fit, shares), MISFITS[-1], SHAPE_MISFIT)
        laws = max(laws, again, key=lambda each: each.probability)
        if laws.holds:
            break
    return laws


def _hopeless(data: JointMoments, laws: Laws) -> bool:
    """Return whether a ratio is far beyond what any misfit makes of laws."""
    flat = likelihood_ratio(data, laws.fit, laws.longer) <= HOPELESS * freedom(data, laws.fit, laws.longer)
    round_enough = laws.sphericity is None or laws.sphericity.nats <= HOPELESS * laws.sphericity.expected
    return not (flat and round_enough)


def _with_shares(data: JointMoments, fit: KernelBasis, shares: Array) -> tuple[KernelBasis, Array]:
    """Estimate rows and shares in turns, as long as the remainder becomes more spherical."""
    degrees = [len(row) - 1 for row in fit.rows]
    best = sphericity(remainder(data, fit), shares).nats
    for _ in range(TURNS):
        found = noise_shares(remainder(data, fit), shares)
        trial = refitted(data, degrees, fit.rows, shares=found, rounds=2)
        nats = sphericity(remainder(data, trial), found).nats
        if not nats < best:
            break
        fit, shares, best = trial, found, nats
    return fit, shares


def bootstrapped(y: Array, u: Array, data: JointMoments, laws: Laws, draws: int) -> Laws:
    """Return the laws with probabilities by the misfit of so many records made from the rows, or as they are where they are hopeless."""
    if _hopeless(data, laws):
        return laws
    gains, shapes = [], []
    for record in redrawn(y, u, data, laws.fit, laws.shares, draws, SEED):
        again = joint_moments(record, u, data.degree)
        fit = refitted(again, [len(row) - 1 for row in laws.fit.rows], laws.fit.rows, shares=laws.shares, rounds=3)
        one = _with_probabilities(again, fit, laws.shares, 1.0, 1.0)
        gains.append(likelihood_ratio(again, one.fit, one.longer) / freedom(again, one.fit, one.longer))
        shapes.append(one.sphericity.nats / one.sphericity.expected if one.sphericity else 1.0)
    return _with_probabilities(data, laws.fit, laws.shares, max(float(np.mean(gains)), 1.0), max(float(np.mean(shapes)), 1.0))


def _with_probabilities(data: JointMoments, fit: KernelBasis, shares: Array, misfit: float, shape_misfit: float) -> Laws:
    """Return the laws of a fit with these shares, with both ratios and their probabilities."""
    count = len(fit.rows)
    total = sum(map(len, fit.rows)) - count
    degrees = even_split(total + EXTRA, count)
    longer = refitted(data, degrees, fit.rows, shares=shares, rounds=3)
    flat = excess(data, fit, longer, (misfit,))
    if count == 1:
        return Laws(count, fit, longer, shares, None, fit.level - longer.level, flat, shape_misfit, misfit)
    shape = sphericity(remainder(data, fit), shares, shape_misfit)
    probability = min(1.0, 2 * min(flat, shape.level))
    return Laws(count, fit, longer, shares, shape, fit.level - longer.level, probability, shape_misfit, misfit)
