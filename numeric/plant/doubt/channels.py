"""Doubts that single channels raise, whatever the model: constants, copies, operating points, units, and limits.

channel_doubts      plain facts of channels (N, k) and of what is known of them
limit_doubts        channels that stay at their least or greatest value as a clipped signal does
COPY                how near to a combination of the others a channel is where it is called a copy

Limits. A smooth signal turns at a peak as a parabola does, which spends at most 1/sqrt(2) of the samples of its two outermost levels in the
outermost one, whatever the distance of the levels; a density that falls towards its end spends less than a half. Two tests follow, each
binomial, and the lesser of their chances is taken twice, times the ends of all channels. One counts visits to both levels, so that a
signal which is held, or has come to rest, counts once. The other counts samples, and is heeded where the signal does not repeat its values
as readily inside its range as at its end (Fisher's exact test), as what is merely held or written with few digits does. A channel of
two levels has no inside, and is never suspected.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy  # its folders are loaded when they are first used
from numpy.typing import NDArray

from ....base.arrays import Array
from ...data.records import Channels
from ...data.validation import constant_channels
from .listing import DOUBT_LEVEL, Doubt, named

COPY = 1e-10
"""The share of a channel's deviation that a combination of others may leave where it is a copy: no sensor's noise is that small."""
DIGITS = 1e-8
"""The deviation over the mean below which more than half of the digits of a float tell the same number; the same ratio between two
channels is what no arithmetic on squares of both can hold."""
TURNING = float(np.sqrt(0.5))


def channel_doubts(samples: Array, known: Channels, names: Sequence[str], n_u: int, *, means_removed: bool) -> Iterator[Doubt]:
    """Yield the plain facts of channels `samples` (N, k), the n_u inputs before the outputs, with what is known of the whole record."""
    still = constant_channels(known.least, known.greatest)
    for j in still:
        what = "an input that stands still excites nothing" if j < n_u else "an output that stands still tells nothing of the system"
        evidence = f"{names[j]} is {known.mean[j]:g} throughout"
        yield Doubt("constant channel", (names[j],), evidence, f"{what}, and no model can be had with it", "leave it out")
    moving = [j for j in range(len(names)) if j not in still]
    yield from _copies(samples, names, moving, n_u)
    if not means_removed:
        yield from _operating_points(known, names, moving)
    yield from _units(known, names, moving)


def _copies(samples: Array, names: Sequence[str], moving: Sequence[int], n_u: int) -> Iterator[Doubt]:
    """Yield channels that are sums of multiples of earlier ones of the same kind, sample by sample, outputs also of inputs."""
    if len(samples) <= len(moving) or len(moving) < 2:
        return
    # In units of the largest value, whose squares overflow nowhere.
    about = samples[:, moving] / np.abs(samples[:, moving]).max(axis=0).clip(np.finfo(np.float64).tiny)
    about -= about.mean(axis=0)
    sizes = np.linalg.norm(about, axis=0)
    unit = about / np.where(sizes > 0, sizes, 1.0)
    kept: list[int] = []
    for place, j in enumerate(moving):
        if sizes[place] == 0.0:
            continue  # it moves elsewhere in the record
        if kept:
            weights = np.linalg.lstsq(unit[:, kept], unit[:, place], rcond=None)[0]
            if np.linalg.norm(unit[:, place] - unit[:, kept] @ weights) <= COPY:
                sources = [names[moving[k]] for k, weight in zip(kept, weights, strict=True) if abs(weight) > COPY]
                kind = "input" if j < n_u else "output"
                effect = (
                    "of two such inputs the data cannot tell which one acts"
                    if kind == "input"
                    else "an equation without noise joins them, which counts as a law without faults and weighs more than all others"
                )
                evidence = f"{names[j]} is a combination of {named(sources)}, to rounding"
                yield Doubt("copies", (names[j], *sources), evidence, effect, f"leave {names[j]} out")
                continue
        kept.append(place)


def _operating_points(known: Channels, names: Sequence[str], moving: Sequence[int]) -> Iterator[Doubt]:
    far = tuple(names[j] for j in moving if abs(known.mean[j]) > known.deviation[j])
    if far:
        yield Doubt(
            "operating point",
            far,
            f"the mean of {named(far)} exceeds its deviation",
            "the model is the same, but what the outputs are at rest stays in the residual, where it looks like a constant fault",
            'try operating_point="means", unless zero is known to be the resting point',
        )


def _units(known: Channels, names: Sequence[str], moving: Sequence[int]) -> Iterator[Doubt]:
    if not moving:
        return
    sizes = known.deviation[list(moving)]
    fine = [names[j] for j in moving if 0 < known.deviation[j] <= DIGITS * abs(known.mean[j])]
    if fine:
        yield Doubt(
            "units",
            tuple(fine),
            f"{named(fine)} varies by less than {DIGITS:g} of its mean",
            "more than half of the digits that a float has go to the mean, and the rest is rounding",
            "take the mean off before the numbers are written, or write them with all digits",
        )
    with np.errstate(divide="ignore"):
        ratio = float(np.min(sizes) / np.max(sizes))
    if ratio <= DIGITS:
        low, high = names[moving[int(np.argmin(sizes))]], names[moving[int(np.argmax(sizes))]]
        yield Doubt(
            "units",
            (low, high),
            f"the deviations of {high} and {low} are {1 / ratio:.2g} apart" if ratio > 0 else f"{low} hardly moves beside {high}",
            "channels are scaled inside, but F, G and norms over several channels are in the units given and show the large ones alone",
            "write both in units of like size",
        )


def limit_doubts(samples: Array, names: Sequence[str], n_u: int) -> Iterator[Doubt]:
    """Yield channels of `samples` (N, k) that stay at one end of their range as a clipped signal does, by the tests of the module."""
    ends = 2 * len(names)
    for j, name in enumerate(names):
        for end, values in (("greatest", samples[:, j]), ("least", -samples[:, j])):
            chance, share = limit_chance(values)
            if ends * chance < DOUBT_LEVEL:
                level = values.max() if end == "greatest" else -values.max()
                yield Doubt(
                    "limits",
                    (name,),
                    f"{name} stays at its {end} value, {level:g}, for {100 * share:.2g} % of "
                    "the samples, as what is clipped or at rest does",
                    "harmless where that is what acts on the plant, but a command that the actuator cannot follow makes the gain too small"
                    if j < n_u
                    else "the model and the residual are wrong while the output stands at its limit, which looks like a fault",
                    "record what acts, or smaller signals" if j < n_u else "widen the sensor's range, or leave these stretches out",
                    ends * chance,
                )


def limit_chance(values: Array) -> tuple[float, float]:
    """Return the chance that an unclipped signal (N,) stays so long at its greatest value, and the share of samples there."""
    top = values.max()
    at_top = values == top
    below = values[~at_top]
    if not below.size or np.all(below == below[0]):
        return 1.0, float(np.mean(at_top))
    second = values == below.max()
    by_visits = _end_chance(_visits(at_top), _visits(second))
    repeats = values[1:] == values[:-1]
    there = at_top[:-1]
    by_repeats = _hypergeometric_tail(int(np.sum(repeats & there)), len(repeats), int(repeats.sum()), int(there.sum()))
    by_samples = max(_end_chance(int(at_top.sum()), int(second.sum())), by_repeats)
    return min(2 * min(by_visits, by_samples), 1.0), float(np.mean(at_top))


def _end_chance(first: int, second: int) -> float:
    """Return the chance of so many in the outermost level, of those in the two outermost."""
    return float(scipy.special.bdtrc(first - 1, first + second, TURNING)) if first > 0 else 1.0


def _hypergeometric_tail(least: int, number: int, marked: int, drawn: int) -> float:
    """Return the probability of `least` marked ones or more among `drawn` out of `number`, of which so many are marked.

    scipy.stats has it too, and takes half a second to load.
    """
    seen = np.arange(max(least, drawn + marked - number, 0), min(marked, drawn) + 1.0)

    def ways(of: int, taken: Array) -> Array:
        return np.asarray(scipy.special.gammaln(of + 1) - scipy.special.gammaln(taken + 1) - scipy.special.gammaln(of - taken + 1))

    whole = ways(number, np.array([float(drawn)]))
    return min(float(np.sum(np.exp(ways(marked, seen) + ways(number - marked, drawn - seen) - whole))), 1.0)


def _visits(there: NDArray[np.bool_]) -> int:
    """Return how often a signal comes to where it is `there` (N,)."""
    return int(there[0]) + int(np.sum(there[1:] & ~there[:-1]))


def rounding_doubts(samples: Array, errors: Array, names: Sequence[str]) -> Iterator[Doubt]:
    """Yield the channels (N, p) that are written in steps so wide that most of the variance of their `errors` (p,), deviations of one-step
    errors, is that of rounding to such steps, step^2 / 12."""
    found = [(name, written_step(values), error) for name, values, error in zip(names, samples.T, errors, strict=True)]
    coarse = [(name, step, error) for name, step, error in found if step is not None and step**2 / 12 > error**2 / 2]
    if coarse:
        name, step, error = coarse[0]
        yield Doubt(
            "rounding",
            tuple(one for one, _, _ in coarse),
            f"{named([one for one, _, _ in coarse])} {'comes' if len(coarse) == 1 else 'come'} in steps, {name} of {step:.3g}, where what "
            f"the model cannot predict has a deviation of {error:.3g}",
            "most of the noise is rounding, which is not independent of the signal where that moves slowly",
            "write more digits, or use a finer converter",
        )


def written_step(values: Array) -> float | None:
    """Return the step that all differences of the values (N,) are multiples of, None where there is none to speak of."""
    levels = np.unique(values)
    if len(levels) < 3 or 2 * len(levels) > len(values):
        return None
    steps = np.diff(levels)
    least = float(steps.min())
    multiples = steps / least
    # Digits of values of this size are that uncertain in units of the step.
    tolerance = 4 * np.finfo(np.float64).eps * float(np.abs(levels).max()) / least + 1e-9
    return least if tolerance < 0.1 and np.all(np.abs(multiples - np.round(multiples)) <= tolerance * multiples.max()) else None
