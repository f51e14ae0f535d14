"""Find the number of zeros from the least total degree of the kernel rows that the data accept, with a probability.

k rows of [y; u] whose degrees add up to d are rational curves of degree d in a Grassmannian and have d (p + n_u) + k (p + n_u - k)
parameters, so that every further degree frees p + n_u. The level of the rows is the logarithm of the noise power that they leave in each of
k signals; hence rows of degree d are as likely as those of degree D > d or less so by the likelihood ratio

    2 log(likelihood of D / likelihood of d) = samples k (level_d - level_D),

which, where d suffices, follows a chi-squared law with (D - d) (p + n_u) degrees of freedom [W38] multiplied by a misfit. What keeps the
misfit above one is that at d the parameters of D are not identified: rows of D are rows of d times factors that can have any root, and
the best root is taken, a maximum over a process that has the stated law at each root [D87]. So the misfit is measured:
`benchmarks/degree_misfits.py` does it on fresh seeds, and the parametric bootstrap for a given record. The moments are those of
`faint_faults.py`: under plain ones the ratio grows without end where faults leave frequencies to the noise.

    LeastDegree    the degree, the levels of all degrees, the probability that each suffices, and whether the answer is clear
    least_degree   from the fits of a course
    ENOUGH         a degree is accepted if data as unlikely come with at least this probability
    TOO_LOW        and clearly too low if with less than this; between the two the answer is undecided
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_tail
from ..space.basis import KernelBasis
from .joint import ROUNDING, JointMoments

# Levels of the test; how often zeta is wrong under them, `benchmarks/space_at_the_bound.py` counts.
ENOUGH, TOO_LOW = 0.01, 1e-6
# Where the degree suffices, the ratio over its degrees of freedom exceeds one by so much, for one degree more and for several. One more
# frees a real root, several free pairs of roots, which can stand at any frequency; so the second is larger. `python
# benchmarks/degree_misfits.py` prints what makes the law true at one in ten.
SLACK = 1.2, 3.0
# They were calibrated on records of up to 10 000 samples, each counted twice by the moments. What the rows miss within a segment of the
# moments does not fall with N, so that on longer and longer records the ratio would end by refusing every degree. They are judged as if
# they had half so many samples.
CALIBRATED = 32000


@dataclass(frozen=True, eq=False)
class LeastDegree:
    """The least total degree that the data accept is `degree`; `levels` and `probabilities` (most + 1,) belong to total degrees 0, 1, ...

    `margin` is the smaller of log(probability of the degree below) / log(TOO_LOW) and log(ENOUGH) / log(probability of the degree), which
    is at least one where `decided`.
    """

    degree: int
    levels: Array
    probabilities: Array
    margin: float
    decided: bool
    reason: str


def likelihood_ratio(data: JointMoments, low: KernelBasis, high: KernelBasis) -> float:
    """Return twice the log likelihood ratio of two fits with equally many rows, which is zero where both are exact up to rounding."""
    floor = float(np.log(ROUNDING))
    return max(min(data.samples, CALIBRATED) * len(low.rows) * (max(low.level, floor) - max(high.level, floor)), 0.0)


def freedom(data: JointMoments, low: KernelBasis, high: KernelBasis) -> int:
    """Return how many more parameters the fit of the higher total degree has."""
    return (_total(high) - _total(low)) * data.moments.channels


def misfits(most: int) -> list[float]:
    """Return what the ratio over its degrees of freedom is, as a rule, for 1 to `most` degrees more where the degree suffices."""
    return [1 + SLACK[min(more, len(SLACK)) - 1] for more in range(1, most + 1)]


def excess(data: JointMoments, low: KernelBasis, high: KernelBasis, misfits: Sequence[float]) -> float:
    """Return the probability of a ratio at least as large, if the lower total degree suffices.

    misfits[i] is the misfit for i + 1 degrees more, and the last one is that for all beyond.
    """
    misfit = misfits[min(_total(high) - _total(low), len(misfits)) - 1]
    return chi_squared_tail(likelihood_ratio(data, low, high) / misfit, freedom(data, low, high))


def _total(fit: KernelBasis) -> int:
    """Return the sum of the degrees of the rows."""
    return sum(len(row) - 1 for row in fit.rows)


def least_degree(data: JointMoments, fits: Sequence[KernelBasis], least: int, most: int, misfits: Sequence[float]) -> LeastDegree:
    """Choose among `fits` with total degrees 0, 1, ..; `least` and `most` bound what the structure allows; fits beyond test the order."""
    top = len(fits) - 1
    # The least favourable comparison, counted as many times as there are comparisons.
    probabilities = np.ones(top + 1)
    for d in range(top):
        probabilities[d] = min(1.0, (top - d) * min(excess(data, fits[d], fits[D], misfits) for D in range(d + 1, top + 1)))
    levels = np.array([fit.level for fit in fits])
    degree = next((d for d in range(least, most + 1) if probabilities[d] >= ENOUGH), None)
    if degree is None:
        # The likeliest stands for an answer, the highest of equals: where the order is too low all probabilities are zero.
        degree = max(range(least, most + 1), key=lambda d: (probabilities[d], d))
        cause = "the order is too low" if degree == most else "the order is too low, or a higher degree fits what is no law"
        reason = f"degree {degree} leaves what higher degrees explain (probability {probabilities[degree]:.1g}): {cause}"
        return LeastDegree(degree, levels, probabilities, 0.0, False, reason)
    # By small steps the same must come out: noise of another colour than assumed gains by many degrees at once. Steps of one degree and of
    # two, for a descent that has stuck makes the one step nothing and the next one twice as large.
    steps = (
        d for d in range(least, top) if all(excess(data, fits[d], fits[D], misfits) >= ENOUGH for D in range(d + 1, min(d + 2, top) + 1))
    )
    settled = next(steps, top) >= degree
    below = 0.0 if degree == least else float(probabilities[degree - 1])
    reason = f"degree {degree} suffices (probability {probabilities[degree]:.2g})"
    if degree == least:
        reason += ", the least that (A, C) allow"
    elif not settled:
        reason += f", but a lower one is not improved by the next two (probability of degree {degree - 1} {below:.1g})"
    else:
        reason += f", degree {degree - 1} {'does not' if below <= TOO_LOW else 'may'} ({below:.1g})"
    margin = _margin(below, float(probabilities[degree])) if settled else 0.0
    return LeastDegree(degree, levels, probabilities, margin, settled and below <= TOO_LOW, reason)


def _margin(below: float, at: float) -> float:
    """Return how far on their sides of the thresholds the two probabilities lie, as a ratio of their logarithms."""
    tiny = 1e-300
    return float(min(np.log(max(below, tiny)) / np.log(TOO_LOW), np.log(ENOUGH) / np.log(max(min(at, 1 - 1e-9), tiny))))
