"""Ranks of [O_s T_s] over the field Q(entries of A, C, F, G), and the polynomials that say where they drop.

The maximal minors of the indeterminate window are multiplied out by FLINT, without any elimination. They are reduced to a
short list with the same common zeros: their common factor is pulled out, and of what is left
the square-free parts are kept, each reduced modulo the ones before it. `stratification` finds the same places by
elimination and cases; the tests let the two meet.

    generic_window_ranks    GenericRanks for the windows asked for
    GenericWindow           rank, common factors and drop conditions of one window
    GenericRanks            the windows of one triple of dimensions
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from ...base.sheets import Shown
from ..algebra.validation import natural
from .case_tree import Polynomial
from .identities import FlintPolynomial, FlintWindow, SecondRoute, maximal_minors, read_back
from .stratification import Indeterminates, indeterminates


@dataclass(frozen=True)
class GenericWindow:
    """The window of `samples` samples: a rows x columns matrix of rank `rank` over Q(entries).

    At parameter values its rank is smaller if and only if one of the `factors` vanishes or all of the `remaining` do. The rank drops
    nowhere if there is no factor and the one remaining condition is 1. Both are polynomials of sympy's ring over ZZ; `common_factors` and
    `conditions` give expressions. `minors` is how many nonzero maximal minors they come from.
    """

    samples: int
    rows: int
    columns: int
    rank: int
    factors: tuple[Polynomial, ...]
    remaining: tuple[Polynomial, ...]
    minors: int

    @property
    def common_factors(self) -> tuple[Any, ...]:
        """Irreducible polynomials that divide every maximal minor, as sympy expressions."""
        return tuple(f.as_expr() for f in self.factors)

    @property
    def conditions(self) -> tuple[Any, ...]:
        """What the maximal minors have besides the common factors, as sympy expressions."""
        return tuple(f.as_expr() for f in self.remaining)

    @property
    def never_drops(self) -> bool:
        """This tells whether the rank is the same for all parameter values."""
        return not self.factors and any(f.is_ground for f in self.remaining)


@dataclass(frozen=True, repr=False)
class GenericRanks(Shown):
    """All entries of A (n x n), C (p x n), F (n x m), G (p x m) are indeterminate; the windows are in the order asked for."""

    entries: Indeterminates
    windows: tuple[GenericWindow, ...]

    @property
    def dimensions(self) -> tuple[int, int, int]:
        """The dimensions are (n, p, m)."""
        return self.entries.n, self.entries.p, self.entries.m

    @property
    def title(self) -> str:
        """This says of which dimensions the systems are."""
        return "n = {}, p = {}, m = {}, all entries indeterminate".format(*self.dimensions)

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the windows."""
        for window in self.windows:
            where = "nowhere less" if window.never_drops else "less where one of the factors vanishes or all conditions do"
            yield f"rank [O_s T_s], s = {window.samples}", f"{window.rank}, {where}"
            yield from (("", f"factor {factor}") for factor in window.common_factors)
            yield from (("", f"condition {condition}") for condition in window.conditions if not window.never_drops)

    def to_json(self) -> dict[str, Any]:
        """The polynomials are texts."""
        return {
            "dimensions": dict(zip("npm", self.dimensions, strict=True)),
            "windows": [
                {
                    "samples": window.samples,
                    "rank": window.rank,
                    "common_factors": [str(f) for f in window.common_factors],
                    "conditions": [str(f) for f in window.conditions],
                }
                for window in self.windows
            ],
        }


def generic_window_ranks(n: int, p: int, m: int, windows: Iterable[int]) -> GenericRanks:
    """Return the rank of [O_s T_s] for almost all A (n x n), C (p x n), F (n x m), G (p x m), and where it is smaller.

    The polynomials are the maximal minors, multiplied out; their number grows as a binomial coefficient in s p and n + s m, so that this is
    meant for matrices up to about 10 x 8. Source: [G25] Theorem 2 after [SB21] for the ranks themselves.

    Parameters
    ----------
    n, p, m : int
        Numbers of states, outputs and faults.
    windows : iterable of int
        Numbers of samples s >= 1.

    Returns
    -------
    GenericRanks
        Each GenericWindow has the `rank` over the field Q(entries), which drops where one of the `common_factors` vanishes or all
        `conditions` do.

    Raises
    ------
    InvalidInput
        For a dimension outside 0..9 and for a window that is no positive integer.

    Examples
    --------
    >>> from faultspace.exact import generic_window_ranks
    >>> (window,) = generic_window_ranks(1, 2, 1, [2]).windows
    >>> window.rank, window.common_factors
    (3, (c11*g21 - c21*g11,))
    >>> (square,) = generic_window_ranks(1, 1, 1, [1]).windows
    >>> square.rank, square.conditions  # [c11 g11] has rank 0 where both vanish
    (1, (c11, g11))
    """
    entries = indeterminates(n, p, m)
    found = []
    for s in windows:
        found.append(_generic_window(entries, natural(s, "window", least=1)))
    return GenericRanks(entries, tuple(found))


def _generic_window(entries: Indeterminates, samples: int) -> GenericWindow:
    route = SecondRoute(entries.ring)
    window = FlintWindow(route, entries, samples)
    matrix = [window.rows[k, i] for k in range(samples) for i in range(entries.p)]
    rows, columns = len(matrix), entries.n + samples * entries.m
    # Fewer lines than entries a line: minors are chosen along the longer side.
    tall = matrix if rows >= columns else [[line[j] for line in matrix] for j in range(columns)]
    width = min(rows, columns)
    for rank in range(width, -1, -1):
        minors = [
            minor
            for chosen in combinations(range(width), rank)
            for minor in maximal_minors(route, [[line[j] for j in chosen] for line in tall], rank)
        ]
        if minors:
            factors, remaining = _reduced(route, entries, minors)
            return GenericWindow(samples, rows, columns, rank, factors, remaining, len(minors))
    raise ArithmeticError("the empty minor is 1")


def _reduced(
    route: SecondRoute, entries: Indeterminates, minors: list[FlintPolynomial]
) -> tuple[tuple[Polynomial, ...], tuple[Polynomial, ...]]:
    """Return the irreducible common factors, and conditions with the same common zeros as the minors without their gcd."""
    common = minors[0]
    for minor in minors[1:]:
        common = common.gcd(minor)
    square_free: dict[str, FlintPolynomial] = {}
    for minor in minors:
        radical = route.context.constant(1)
        for factor, _ in (minor / common).factor()[1]:
            radical *= factor
        square_free[str(radical)] = radical
    kept: list[Polynomial] = []
    for f in sorted(square_free.values(), key=_size):
        image = read_back(entries.ring, f)
        # Where the ones before it vanish, f vanishes if and only if its remainder does.
        rest = image.rem(kept) if kept else image
        if rest:
            rest = rest.primitive()[1]
            kept.append(-rest if rest.LC < 0 else rest)
    factors = sorted((factor for factor, _ in common.factor()[1]), key=_size)
    return tuple(read_back(entries.ring, f) for f in factors), tuple(kept)


def _size(f: FlintPolynomial) -> tuple[int, int, str]:
    return f.total_degree(), len(f), str(f)
