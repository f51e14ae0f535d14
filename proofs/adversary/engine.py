"""One attack from its starts to its end.

    pursue         starts, descents, crossings, rounding, exact decisions; ends at the first counterexample or when the time is up
    exact_zero     rational points of the zero set near a float zero, along one parameter after the other
    value_at       the quantity of an attack at a stored point, evaluated again

The order, cheapest first: simple points near the starts are decided exactly (what fails on an open set falls here); points of different
sign are joined and their zeros rounded; each start is followed downhill, and the same is done again with the points met on the way.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import islice

import numpy as np

from ...base.errors import InvalidInput
from ..evidence.attacks import Aim, Attack, Floats, Point, Trial, Witness
from .following import Trace, crossings, descend, draw_starts, outward
from .rounding import bracket, moved, rational_roots, simple, solve_affine

SAMPLES = 16  # looks along one parameter for a change of sign
COARSE = (1, 2, 4)
NEAR = (2, 4, 8, 16, 32, 64)
TRIED, ROUNDS = 3, 12  # zeros that are rounded after each descent, and in all


class _Hunt:
    """A hunt keeps what has been found so far, and the clock, which counts the process's own time: a busy machine makes no weaker
    attack."""

    def __init__(self, attack: Attack, seconds: float) -> None:
        self.attack = attack
        self.ends = time.process_time() + seconds
        self.trace = Trace(attack.quantity)
        self.decided: set[Point] = set()
        self.witness: Witness | None = None
        self.bracket: tuple[Point, Point] | None = None
        self.crossed = 0
        self.lines: set[tuple[Point, int]] = set()

    @property
    def over(self) -> bool:
        return self.witness is not None or time.process_time() > self.ends

    def decide(self, points: Iterator[Point] | Sequence[Point]) -> None:
        for point in points:
            if self.over:
                return
            if point not in self.decided:
                self.decided.add(point)
                self.witness = _decided(self.attack, point)


def pursue(attack: Attack, *, seconds: float, seed: int) -> Trial:
    """Follows the attack for at most so many seconds of this process's time (an exact decision that has begun is ended). The same seed
    takes the same way."""
    started = time.process_time()
    hunt, box = _Hunt(attack, seconds), attack.family.box
    rng = np.random.default_rng([seed, *attack.id.encode()])
    starts = list(draw_starts(box, attack.starts, rng))
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        for start in starts:
            hunt.trace.vector(start)
        for start in starts[: max(4, attack.starts // 2)]:
            hunt.decide(simple(start, box, COARSE))
        _cross(hunt)
        for start in starts if attack.blocks else ():
            hunt.decide(_solved(hunt, start))
        for start in starts:
            if hunt.over:
                break
            _follow(hunt, start)
    far = attack.aim == Aim.NONZERO
    nearest, at = (hunt.trace.largest, hunt.trace.largest_at) if far else (hunt.trace.nearest, hunt.trace.nearest_at)
    return Trial(
        attack=attack,
        starts=len(starts),
        evaluations=hunt.trace.evaluations,
        decided=len(hunt.decided),
        seconds=time.process_time() - started,
        nearest=nearest,
        point=() if at is None else tuple(float(x) for x in at),
        witness=hunt.witness,
        bracket=None if hunt.witness else hunt.bracket,
    )


def value_at(attack: Attack, point: Sequence[float]) -> float:
    """Return the size of the quantity at a point."""
    return float(np.linalg.norm(np.atleast_1d(attack.quantity(np.array(point, dtype=np.float64)))))


def _follow(hunt: _Hunt, start: Floats) -> None:
    """Follows one start downhill (or uphill), and decides what is found at its end."""
    attack, box, steps = hunt.attack, hunt.attack.family.box, 60 * len(hunt.attack.family.box)
    if attack.aim == Aim.NONZERO:
        outward(hunt.trace, start, box, steps=steps)
        if hunt.trace.largest_at is not None:
            hunt.decide(simple(hunt.trace.largest_at, box, COARSE))
        return
    end = descend(hunt.trace, start, box, steps=steps, signed=attack.aim in (Aim.SIGN, Aim.STRATUM))
    if attack.aim in (Aim.SIGN, Aim.STRATUM):
        _cross(hunt)
    else:
        hunt.decide(_solved(hunt, end))
    hunt.decide(simple(end, box, COARSE))


def _cross(hunt: _Hunt) -> None:
    """Where signs differ there is a zero: decides rational points of the zero set near it."""
    if hunt.attack.aim not in (Aim.SIGN, Aim.STRATUM) or hunt.crossed >= ROUNDS:
        return
    for zero in islice(crossings(hunt.trace), TRIED):
        if hunt.over:
            return
        hunt.crossed += 1
        hunt.decide(exact_zero(hunt, zero))


def exact_zero(hunt: _Hunt, zero: Floats) -> Iterator[Point]:
    """Yield exact zeros on lines through simple points near a float zero; without a rational one, a pair of exact points of either sign is
    kept."""
    attack, box = hunt.attack, hunt.attack.family.box
    exact = attack.exact
    assert exact is not None
    for point in simple(zero, box, NEAR):
        for place in attack.family.order or range(len(box)):
            low, high = box[place]
            line = moved(point, place, Fraction(0)), place
            if hunt.over:
                return
            if line in hunt.lines:
                continue
            hunt.lines.add(line)
            ends = _ends(hunt.trace, point, place, low, high)
            if ends is None:
                continue

            def along(x: Fraction, point: Point = point, place: int = place) -> Fraction:
                return exact(moved(point, place, x))

            try:
                for root in rational_roots(along, *ends) or ():
                    yield moved(point, place, root)
                if attack.aim == Aim.SIGN and hunt.bracket is None and (pair := bracket(along, *ends)) is not None:
                    hunt.bracket = moved(point, place, pair[0]), moved(point, place, pair[1])
            except (InvalidInput, ArithmeticError):
                continue


def _ends(trace: Trace, point: Point, place: int, low: float, high: float) -> tuple[Fraction, Fraction] | None:
    """Return the first two neighbouring looks along a parameter between which the sign changes."""
    base = np.array([float(x) for x in point])
    before: tuple[Fraction, float] | None = None
    bottom, top = Fraction(low).limit_denominator(1000), Fraction(high).limit_denominator(1000)
    for i in range(SAMPLES + 1):
        x = bottom + (top - bottom) * Fraction(i, SAMPLES)
        base[place] = float(x)
        value = trace.number(base)
        if before is not None and before[1] * value < 0:
            return before[0], x
        before = x, value
    return None


def _solved(hunt: _Hunt, end: Floats) -> Iterator[Point]:
    """Yield simple points near the end, with the equations solved exactly for the parameters in which they are affine."""
    if not hunt.attack.blocks:
        return
    for point in simple(end, hunt.attack.family.box, NEAR):
        found: Point | None = point
        for block in hunt.attack.blocks:
            try:
                found = None if found is None else solve_affine(block.equations, found, block.places)
            except (InvalidInput, ArithmeticError):
                found = None
        if found is not None:
            yield found


def _decided(attack: Attack, point: Point) -> Witness | None:
    """Decide a point exactly; one outside the family's domain (an unstable A, a singular covariance) is no counterexample."""
    try:
        return attack.decide(point)
    except (InvalidInput, ZeroDivisionError):
        return None
