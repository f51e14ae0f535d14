"""Vectors of residuals: exact records of faults, with ranks, fault spaces and bounds, and the same records seen otherwise.

    FaultVector         A, F, C, G, x0, v, r over Q; window ranks, n_v, fault space; certified singular-value gaps
    FaultView           the same record in other units, another state basis, another order of outputs, or a part of it
    VIEWS               the views that every fault vector is given in
    UnexcitingVector    a fault signal from which the number of faults cannot be told: ranks and gaps alone
    samples_that_settle how long a record must be for a number of faults to be due
    channel_units       powers of ten of the size of each channel

A view is a fault vector of its own, over the transformed system, so that whatever is asked of the one can be asked of the other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import log10, sqrt
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem

from .rationals import floats, fractions, matrix, residual_system, scaled

SETTLED, WIDE = 3, 2  # two gaps may be equal by chance, and nearly square matrices have small singular values by chance
HALF = 45  # of the 90 samples of each record
CLEAR = 1e3 * 2.0**-53  # of the norm of R_s, channels in their units: a thousand times what rounding moves a singular value by


@dataclass(frozen=True)
class FaultView:
    """A view has the samples first .. last - 1, `scale` times the signals, outputs turned round, `units` 10^a, 10^(a - 4), ... for the
    channels, and the state basis T x with T upper triangular of ones.
    """

    slug: str
    first: int = 0
    last: int = 2 * HALF
    scale: Fraction = Fraction(1)
    reversed_outputs: bool = False
    largest_unit: int | None = None
    other_basis: bool = False

    def basis(self, n: int) -> tuple[Matrix, Matrix]:
        """The pair is T and its inverse."""
        T = [[int(j == i or (self.other_basis and j > i)) for j in range(n)] for i in range(n)]
        inverse = [[int(j == i) - int(self.other_basis and j == i + 1) for j in range(n)] for i in range(n)]
        return matrix(T, n), matrix(inverse, n)

    def outputs(self, p: int) -> list[int]:
        """Output i of the view is the output of this number."""
        return list(range(p))[::-1] if self.reversed_outputs else list(range(p))

    def units(self, p: int) -> list[Fraction]:
        """There is a factor for each output, in the new order."""
        return [Fraction(1) if self.largest_unit is None else Fraction(10) ** (self.largest_unit - 4 * i) for i in range(p)]

    def system(self, given: ResidualSystem) -> ResidualSystem:
        """Return (T A T^-1, T F, M C T^-1, M G), M the permutation and the units."""
        T, inverse = self.basis(given.n)
        outputs, units = self.outputs(given.p), self.units(given.p)
        C, G = (scaled(one.rows(outputs).transposed(), units).transposed() for one in (given.C, given.G))
        return ResidualSystem(T @ given.A @ inverse, T @ given.F, C @ inverse, G)

    def record(self, given: ResidualSystem, x0: Matrix, v: Matrix) -> tuple[Matrix, Matrix]:
        """The pair is x0 and v of the view."""
        T, _ = self.basis(given.n)
        start = simulate(given, x0, v).states.rows([self.first]).transposed()
        part = v.rows(range(self.first, self.last))
        return scaled(T @ start, [self.scale]), scaled(part, [self.scale] * v.ncols)


AS_GIVEN = FaultView("as-given")
VIEWS = (
    FaultView("1e-12", scale=Fraction(1, 10**12)),
    FaultView("1e-6", scale=Fraction(1, 10**6)),
    FaultView("1e6", scale=Fraction(10**6)),
    FaultView("other-basis", other_basis=True),
    FaultView("permuted-outputs", reversed_outputs=True),
    FaultView("other-units", largest_unit=3),
    FaultView("time-shift", first=7),
    FaultView("first-half", last=HALF),
    FaultView("second-half", first=HALF),
)


@dataclass(frozen=True, eq=False)
class FaultVector:
    """This is a residual r of x(k+1) = A x + F v, r = C x + G v from x0, exactly; `space`: basis columns [f; g] (n + p, n_z) of all
    solutions.

    ranks: of R_1, R_2, ... over all columns of each. gaps: (certified lower bound on the least nonzero, upper on the largest singular
    value of R_s), each channel divided by its unit of `channel_units`. lag: from lag + 1 block rows on a window suffices. bounds:
    "residual" on |r - exact r| of the fitted residual in those units, "signal" on |v - exact v| on the first `trusted` samples (None: not
    to be asked). space_bounds: block rows -> bound on the sine of the angle to `space` from windows of so many. views: by slug.
    """

    slug: str
    view: FaultView
    system: ResidualSystem
    x0: Matrix
    v: Matrix
    ranks: tuple[int, ...]
    gaps: tuple[tuple[float, float], ...]
    n_v: int
    space: Matrix
    lag: int
    trusted: int
    bounds: Mapping[str, float | None]
    space_bounds: Mapping[int, float]
    views: Mapping[str, FaultVector] = field(default_factory=dict)

    @cached_property
    def r(self) -> Matrix:
        """This is the exact residual (N, p)."""
        return simulate(self.system, self.x0, self.v).residuals

    @property
    def clear(self) -> bool:
        """This tells whether every rank stands clear of what rounding of the samples does to singular values: else floats cannot tell
        it."""
        rows = (self.system.p * s for s in range(1, len(self.gaps) + 1))
        return all(low > CLEAR * high * sqrt(height) for (low, high), height in zip(self.gaps, rows, strict=True))

    def seen(self, slug: str) -> FaultVector:
        """Return the view of that slug, or the vector itself."""
        return self if slug == AS_GIVEN.slug else self.views[slug]

    def to_json(self) -> dict[str, Any]:
        """Return the vector in JSON with the exact residual spelt out; views say how theirs comes from it."""
        whole = {name: getattr(self, name).to_json() for name in ("v", "r")}
        views = [{"slug": slug, **view._how(), **view._what()} for slug, view in self.views.items()]
        return {"slug": self.slug, **whole, **self._what(), "views": views}

    def _how(self) -> dict[str, Any]:
        p, view = self.system.p, self.view
        units = [str(unit * view.scale) for unit in view.units(p)]
        return {"samples": [view.first, view.last], "outputs": view.outputs(p), "units": units, "fault_scale": str(view.scale)}

    def _what(self) -> dict[str, Any]:
        return {
            "system": self.system.to_json(),
            "x0": self.x0.to_json(),
            "expected": {
                "window_ranks": list(self.ranks),
                "n_v": self.n_v,
                "fault_space": self.space.to_json(),
                "lag": self.lag,
                "trusted": self.trusted,
            },
            **gaps_to_json(self.r, self.gaps),
            "bounds": {**self.bounds, "space": [{"block_rows": s, "bound": bound} for s, bound in sorted(self.space_bounds.items())]},
        }

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> FaultVector:
        """Return the vector that `to_json` wrote; residuals are computed again."""
        v = matrix(data["v"], len(data["v"][0]))
        whole = FaultVector._read(data["slug"], AS_GIVEN, data, v)
        views = {}
        for one, view in zip(data["views"], VIEWS if data["views"] else (), strict=True):
            part = scaled(v.rows(range(*one["samples"])), [Fraction(one["fault_scale"])] * v.ncols)
            views[one["slug"]] = FaultVector._read(data["slug"], view, one, part)
        return FaultVector(**{name: getattr(whole, name) for name in FaultVector.__dataclass_fields__ if name != "views"}, views=views)

    @staticmethod
    def _read(slug: str, view: FaultView, data: Mapping[str, Any], v: Matrix) -> FaultVector:
        known = data["expected"]
        return FaultVector(
            slug,
            view,
            residual_system(data["system"]),
            matrix(data["x0"], 1),
            v,
            tuple(known["window_ranks"]),
            gaps_from_json(data),
            known["n_v"],
            matrix(known["fault_space"], len(known["fault_space"][0])),
            known["lag"],
            known["trusted"],
            {name: data["bounds"][name] for name in ("residual", "signal")},
            {one["block_rows"]: one["bound"] for one in data["bounds"]["space"]},
        )


@dataclass(frozen=True, eq=False)
class UnexcitingVector:
    """This is a residual of m faults whose signals show `visible` < m independent ones. ranks, gaps: as of FaultVector."""

    slug: str
    system: ResidualSystem
    x0: Matrix
    v: Matrix
    ranks: tuple[int, ...]
    gaps: tuple[tuple[float, float], ...]
    visible: int

    @cached_property
    def r(self) -> Matrix:
        """This is the exact residual (N, p)."""
        return simulate(self.system, self.x0, self.v).residuals

    def to_json(self) -> dict[str, Any]:
        """The document has the exact residual spelt out."""
        return {
            "slug": self.slug,
            "system": self.system.to_json(),
            **{name: getattr(self, name).to_json() for name in ("x0", "v", "r")},
            "expected": {"window_ranks": list(self.ranks), "shown": self.visible},
            **gaps_to_json(self.r, self.gaps),
        }

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> UnexcitingVector:
        """Return the vector that `to_json` wrote; the residual is computed again."""
        known, shown = data["expected"], residual_system(data["system"])
        v, x0 = matrix(data["v"], shown.m), matrix(data["x0"], 1)
        return UnexcitingVector(data["slug"], shown, x0, v, tuple(known["window_ranks"]), gaps_from_json(data), known["shown"])


def samples_that_settle(p: int, lag: int) -> int:
    """Return how many samples show that the ranks have settled, in windows with WIDE times as many columns as rows: SETTLED equal gaps, and
    in the last third of the gaps no other one, since of many gaps a few are equal by chance.

    Below that a number of faults is not to be told from the data alone: a longer lag would look the same.
    """
    longest = max(lag + SETTLED, -(-3 * (lag - 1) // 2) + 1)
    return (WIDE * p + 1) * longest - 1


def channel_units(r: Matrix) -> list[Fraction]:
    """Return the power of ten nearest to the root mean square of each channel of r (N, p)."""
    values = floats(r)
    sizes = np.max(np.abs(values), axis=0)
    mean = sizes * np.sqrt(np.mean((values / sizes) ** 2, axis=0))
    return [Fraction(10) ** round(log10(size)) for size in mean]


def in_channel_units(r: Matrix) -> Matrix:
    """Each channel of r is divided by its unit."""
    return scaled(r, [1 / unit for unit in channel_units(r)])


def gaps_to_json(r: Matrix, gaps: tuple[tuple[float, float], ...]) -> dict[str, Any]:
    """Return the certified singular values with the units that they are in."""
    values = [{"least_nonzero_above": low, "largest_below": high} for low, high in gaps]
    return {"channel_units": [str(unit) for unit in channel_units(r)], "singular_values": values}


def gaps_from_json(data: Mapping[str, Any]) -> tuple[tuple[float, float], ...]:
    """This reads what `gaps_to_json` wrote."""
    return tuple((one["least_nonzero_above"], one["largest_below"]) for one in data["singular_values"])


LONG_WINDOW = 10


def with_input(r: Matrix, system: ResidualSystem, size: Fraction) -> tuple[Matrix, Matrix]:
    """Return (y, u), where y is r plus the response from rest to u for the model B = F, D = G.

    Channel j of u is size at every (j + 2)nd sample and -size between.
    """
    u = matrix([[size if k % (j + 2) == 0 else -size for j in range(system.m)] for k in range(r.nrows)], system.m)
    return r + simulate(system, Matrix.zero(system.field, system.n, 1), u).residuals, u


def sine_samples(count: int) -> list[Fraction]:
    """The samples are cos(k a) for k = 0 .. count - 1."""
    c, s, result = Fraction(1), Fraction(0), []
    for _ in range(count):
        result.append(c)
        c, s = c * 3 / 5 - s * 4 / 5, c * 4 / 5 + s * 3 / 5
    return result


def unexciting_inputs(samples: int) -> dict[str, Matrix]:
    """Return two inputs of one channel: a constant and a sine, exciting of order one and two."""
    return {"constant": matrix([[Fraction(3, 2)]] * samples, 1), "sine": matrix([[x] for x in sine_samples(samples)], 1)}


def alike_inputs(u: Matrix) -> dict[str, Matrix]:
    """Return two inputs of as many samples as the one given (N, 1), of which the second says nothing that the first has not said."""
    first = [row[0] for row in fractions(u)]
    seconds = {"same": first, "turned": [-2 * x for x in first], "delayed": [Fraction(0), *first[:-1]]}
    return {name: matrix([list(pair) for pair in zip(first, second, strict=True)], 2) for name, second in seconds.items()}
