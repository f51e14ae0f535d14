"""This counts faults in noisy residuals: how many outputs still obey a common law?

Any k mixtures of the outputs obey at least one polynomial law N(q) r = 0 up to noise when the number of faults m is at most k - 1,
and in general none when m >= k. So fit the likeliest law to k mixtures and watch the noise that it leaves: it stays at one floor, that of
k = p, while k > m and jumps at k = m, a place found by bisection.

    level           J(k) of `kernel_likelihood`: log noise power per sample left by the best row on k mixtures, in nats
    drop            how far the level still falls from degree eta - 2 to eta: a law that fits has none left
    LawLevel        one k: outputs, level, drop
    KernelRowTest   the levels looked at, n_v or None, reason

Rules, each of which yields an undecided answer when it fails:

    floor           J(p) no longer drops with the degree: likelihood ratio against the lower degree [W38], with a slack for
                    noise colours that an autoregression of order four does not reach. No floor: there is no law to be seen.
    alarm           k mixtures more than ALARM nats above the floor are not at the floor (unequal noise levels raise it by less)
    steep           what the floor rose before the jump is at most the share STEEP of the jump
    size            the rise must be CLEAR nats; when it comes at once (n_v = p - 1) the floor is seen once only, a weak fault more would
                    look the same, and CLEAR_LAST nats and the smaller slack SLACK_LAST are demanded; CLEAR_SINGLE of two
                    outputs, since a single mixture has no quiet direction left to choose and starts higher anyway
    unmixed         mixtures mix the noise of a loud output into all: the outputs on which the best law has its weight, as many as there
                    would be faults, must be off the floor too by the share SPARSE of the rise; else the noise is unequal, or the faults are
    settled         the level after the rise must not be falling with the degree by a share that would undo the rise
    some rise       down to k = 1: otherwise r may be noise alone or as many faults as outputs, and data cannot tell

n_v = p is never returned: an arbitrary coloured noise is a weak fault in every output.

The likelihood ratios are derived; the capital constants trade right answers for undecided ones, wrong ones being the worst, and are judged
by `benchmarks/constants.py laws`: of 600 records (seed 700100) 181 are answered rightly and 4 wrongly, and no factor from a half to two
of any of them is better. The nearest trade is CLEAR_LAST: 1.4 times smaller it is 200 and 15, and 1.4 times larger 156 and 1. On other data
expect less. How near to a jump an answer was can be read from `levels`, but is no probability of error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_quantile
from ....base.sheets import counted, decibels
from .one_row import WindowMoments, kernel_row, window_moments

# Nats, shares of a rise, and of its falling: see the head, and `benchmarks/constants.py laws`.
ALARM = 1.0
CLEAR = 2.5
CLEAR_LAST = 4.0
CLEAR_SINGLE = 6.0
SLACK = 0.15
SLACK_LAST = 0.04
SETTLED = 0.25  # of the rise
STEEP = 0.2
SPARSE = 0.5
MIXES = 2
_SEED = 20250513


@dataclass(frozen=True)
class LawLevel:
    """What the best law on `outputs` mixtures leaves: the least and largest level over some random mixtures, in nats, and the
    largest drop."""

    outputs: int
    least: float
    largest: float
    drop: float

    @property
    def middle(self) -> float:
        """Return the level half way between the mixtures."""
        return (self.least + self.largest) / 2


@dataclass(frozen=True)
class KernelRowTest:
    """The test holds the levels looked at, by falling number of outputs, and what they say; `n_v` is None where it is undecided."""

    n_v: int | None
    levels: tuple[LawLevel, ...]
    noise_power: float
    reason: str


def kernel_row_test(r: Array, degree: int, *, u: Array | None = None) -> KernelRowTest:
    """Find the jump; r (N, p) scaled to unit mean square a channel, rows up to this degree (at least 3).

    With u (N, n_u), what the inputs explain of a law's remainder is left out.
    """
    p = r.shape[1]
    moments = window_moments(r, degree, u=u)
    random = np.random.default_rng(_SEED)
    rotations = [np.linalg.qr(random.standard_normal((p, p)))[0] for _ in range(MIXES)]
    floor = law_level(moments, (np.eye(p),))
    levels = {p: floor}
    noise_power = float(np.exp(floor.least))
    chance = chi_squared_quantile(0.999, 2 * p) / moments.samples
    bound = SLACK + chance

    def undecided(reason: str) -> KernelRowTest:
        return KernelRowTest(None, _walk(levels), noise_power, reason)

    if floor.drop > bound:
        return undecided(
            f"no noise floor: the best law on {'the one output' if p == 1 else f'all {p} outputs'} still "
            f"improves by {decibels(floor.drop)} over the last two degrees "
            f"(at most {decibels(bound)} allowed); there may be {counted(p, 'fault')}, or an order that needs larger block_rows"
        )
    # Invariant: `high` mixtures are at the floor, `low` are not (none at all, to begin with).
    high, low = p, 0
    while high - low > 1:
        k = (high + low + 1) // 2
        levels[k] = law_level(moments, tuple(rotation[:, :k] for rotation in rotations))
        if levels[k].middle - floor.middle <= ALARM and levels[k].drop <= bound:
            high = k
        else:
            low = k
    if low == 0:
        return undecided(
            "every single mixture is at the same floor: r looks like noise alone, which cannot be told from as many faults as outputs"
        )
    above, below = levels[high], levels[low]
    rise, before = below.least - above.largest, above.middle - floor.middle
    needed = CLEAR if low < p - 1 else CLEAR_LAST if p > 2 else CLEAR_SINGLE
    step = f"from {high} mixed outputs to {low} the noise left by the best law rises by at least {decibels(rise)}"
    if below.middle - floor.middle <= ALARM:
        return undecided(
            f"on {counted(low, 'mixed output')} the best law still improves by {decibels(below.drop)} over the last two degrees (at most "
            f"{decibels(bound)} allowed): the order may need larger block_rows"
        )
    if rise <= 0.0:
        return undecided(
            f"from {high} mixed outputs to {low} the noise left by the best law rises by less than mixtures of as many differ: no jump "
            f"tells a missing law (at least {decibels(needed)})"
        )
    if rise < needed:
        return undecided(f"{step}: too much for the same floor, too little for a missing law (at least {decibels(needed)})")
    if low == p - 1 and floor.drop > SLACK_LAST + chance:
        return undecided(
            f"only all {p} outputs together obey a law, and it still improves by {decibels(floor.drop)} over the last two degrees "
            f"(at most {decibels(SLACK_LAST + chance)} allowed here): {p} faults of unequal strength look like this"
        )
    if before > STEEP * rise:
        return undecided(f"{step}, but it had risen by {decibels(before)} before: weak faults, or outputs of very unequal noise")
    if below.drop > SETTLED * rise:
        return undecided(f"{step}, of which the last two degrees took back {decibels(below.drop)}: larger block_rows may settle it")
    chosen = _loaded(moments, low)
    alone = law_level(moments, (np.eye(p)[:, chosen],)).least - floor.middle
    if alone < SPARSE * rise:
        return undecided(
            f"{step}, but {counted(low, 'output')}, not mixed, {'obeys' if low == 1 else 'obey'} a law "
            f"nearly as good ({decibels(alone)} above the floor): noise that is "
            "louder, beside the faults, at other outputs looks like this"
        )
    reason = (
        f"{high} mixed outputs obey a common law up to the noise floor, {low} "
        f"{'does' if low == 1 else 'do'} not: {step} ({decibels(needed)} needed)"
    )
    return KernelRowTest(low, _walk(levels), noise_power, reason)


def _loaded(moments: WindowMoments, count: int) -> NDArray[np.int_]:
    """Return the outputs on which the best law on all of them has its largest coefficients."""
    sizes = np.linalg.norm(kernel_row(moments).coefficients, axis=0)
    return np.sort(np.argsort(-sizes, kind="stable")[:count])


def _walk(levels: dict[int, LawLevel]) -> tuple[LawLevel, ...]:
    """Return the levels by falling number of outputs."""
    return tuple(levels[k] for k in sorted(levels, reverse=True))


def law_level(moments: WindowMoments, mixes: tuple[Array, ...]) -> LawLevel:
    """Fit rows of rising degree on each mixture, each degree starting from the row before."""
    levels, drops = [], []
    for mix in mixes:
        mixed = moments.mixed(mix)
        degree = moments.degree
        course: list[float] = []
        starts: tuple[Array, ...] = ()
        for eta in sorted({*range(1, degree - 1, 2), degree - 2, degree}):
            fit = kernel_row(mixed.of_degree(eta), starts=starts)
            starts = (fit.coefficients,)
            course.append(fit.level)
        levels.append(min(course))
        drops.append(max(0.0, course[-2] - course[-1]))
    return LawLevel(mixes[0].shape[1], min(levels), max(levels), max(drops))
