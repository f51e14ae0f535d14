"""A quantity followed in floats: from several starts downhill, and along the paths between points where its sign differs.

Trace        every value seen: how many, the nearest, the points of either sign closest to zero
draw_starts  points of a box, uniform and degenerate on purpose: coordinates at 0, at a simple number, equal to one another
descend      towards the other sign, or towards a common zero; Nelder and Mead's simplex and least squares, by scipy
crossings    points where the sign changes, on the segments between points of different sign, by Brent's root of scipy
outward      towards the largest value, for a quantity that should be identically zero
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..evidence.attacks import Floats

Quantity = Callable[[Floats], float | Floats]
KEPT = 24
NOTHING = 1e-9  # a value this small may be nothing but rounding: its sign says nothing
SIMPLE = (0.0, 0.0, 1.0, -1.0, 0.5, -0.5)


@dataclass
class Trace:
    """A trace is the quantity with a memory. Where the quantity cannot be evaluated (a singular covariance) it is not a number, and counts
    as far away."""

    quantity: Quantity
    evaluations: int = 0
    nearest: float = np.inf
    nearest_at: Floats | None = None
    largest: float = 0.0
    largest_at: Floats | None = None
    signs: dict[bool, list[tuple[float, Floats]]] = field(default_factory=lambda: {True: [], False: []})

    def vector(self, point: Floats) -> Floats:
        """Return the value at this point as a vector, and remembers it."""
        self.evaluations += 1
        try:
            value = np.atleast_1d(np.asarray(self.quantity(point), dtype=np.float64))
        except (np.linalg.LinAlgError, ZeroDivisionError, OverflowError):
            value = np.array([np.nan])
        size = float(np.linalg.norm(value))
        if not np.isfinite(size):
            return np.full_like(value, 1e3)
        if size < self.nearest:
            self.nearest, self.nearest_at = size, point.copy()
        if size > self.largest:
            self.largest, self.largest_at = size, point.copy()
        if value.size == 1 and size > NOTHING:
            kept = self.signs[bool(value[0] > 0)]
            kept.append((size, point.copy()))
            if len(kept) > 8 * KEPT:
                kept.sort(key=lambda item: item[0])
                del kept[KEPT:]
        return value

    def number(self, point: Floats) -> float:
        """Return the value at this point as a number, and remembers it."""
        return float(self.vector(point)[0])


def draw_starts(box: Sequence[tuple[float, float]], count: int, rng: np.random.Generator) -> Iterator[Floats]:
    """Yield `count` points inside the box, every second of them with some coordinates degenerate."""
    low, high = np.array([b[0] for b in box]), np.array([b[1] for b in box])
    for i in range(count):
        point = rng.uniform(low, high)
        if i % 2 and len(box) > 1:
            for j in np.flatnonzero(rng.random(len(box)) < 0.5):
                other = int(rng.integers(len(box)))
                point[j] = point[other] if rng.random() < 0.4 else rng.choice(SIMPLE)
        yield np.clip(point, low, high)


def descend(trace: Trace, start: Floats, box: Sequence[tuple[float, float]], *, steps: int, signed: bool) -> Floats:
    """Go downhill from the start: signed, past zero to the other side, where it stops; else to a common zero by least squares."""
    from scipy.optimize import least_squares, minimize  # here and below: a run of `verify` follows nothing

    if not signed:
        low, high = np.array(box, dtype=np.float64).T
        inside = np.clip(start, low + 1e-9 * (high - low), high - 1e-9 * (high - low))
        found = least_squares(trace.vector, inside, bounds=(low, high), max_nfev=steps, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        return np.asarray(found.x, dtype=np.float64)
    side = 1.0 if trace.number(start) > 0 else -1.0

    class Crossed(Exception):
        """Raised where the sign has changed: there is nothing more to descend to."""

    def value(point: Floats) -> float:
        height = side * trace.number(point)
        if height < -NOTHING:
            raise Crossed
        return height

    try:
        options = {"maxfev": steps, "adaptive": True, "xatol": 1e-9, "fatol": 1e-14}
        found = minimize(value, start, method="Nelder-Mead", bounds=list(box), options=options)
    except Crossed:
        return start
    return np.asarray(found.x, dtype=np.float64)


def crossings(trace: Trace) -> Iterator[Floats]:
    """Yield zeros on the segments between points of different sign, the closest to zero first."""
    from scipy.optimize import brentq

    positive, negative = (sorted(trace.signs[side], key=lambda item: item[0])[:KEPT] for side in (True, False))
    pairs = sorted(((a[0] + b[0], i, j) for i, a in enumerate(positive) for j, b in enumerate(negative)))
    for _, i, j in pairs[:KEPT]:
        here, there = positive[i][1], negative[j][1]

        def along(t: float, here: Floats = here, there: Floats = there) -> float:
            return trace.number(here + t * (there - here))

        if along(0.0) * along(1.0) < 0:
            yield here + float(brentq(along, 0.0, 1.0, xtol=1e-14)) * (there - here)


def outward(trace: Trace, start: Floats, box: Sequence[tuple[float, float]], *, steps: int) -> None:
    """Go uphill in absolute value."""
    from scipy.optimize import minimize

    minimize(lambda point: -abs(trace.number(point)), start, method="Nelder-Mead", bounds=list(box), options={"maxfev": steps})
