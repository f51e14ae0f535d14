"""What claims about two systems with the same number of outputs can speak of: their behaviours. Source: [G25], [W91].

    OF_A_PAIR             the quantities of a pair, by their names
    OF_ONE_A_AND_C        those of a pair with the same (A, C), which has one n
    Pairs                 many pairs at once
    TOGETHER, together    rank [O_s T_s] of the two systems side by side, s = 0, ..., n + 1 with the larger n

The outputs of s samples of the first are among those of the second iff the matrices [O_s T_s] of both side by side have no larger rank than
that of the second. A kernel row of the second that has degree s decides whether the first obeys it on s + 1 samples; no degree exceeds its
number of states, so that what holds on n + 1 samples holds on all.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import inf
from typing import Any, ClassVar

import numpy as np

from ...exact.algebra.matrices import Matrix, beside, stacked
from ...exact.system.systems import ResidualSystem
from ..evidence.alternatives import comparison_certificate
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from .batches import Batch, window
from .cases import Pair, PairSubject
from .elimination import Integers, leading_ranks
from .many import Both, Chosen, Column
from .ranks import WINDOW, Numbers
from .registry import Kind, Quantity

TOGETHER = "OT side by side"


@dataclass
class Pairs(Both):
    """Many pairs, `first` and `second` being batches of systems that differ."""

    called: ClassVar[tuple[str, str]] = ("first", "second")
    first: Batch
    firsts: Chosen
    second: Batch
    seconds: Chosen
    one_A_and_C: bool = False
    _columns: dict[object, Column] = field(default_factory=dict)

    @property
    def own(self) -> Mapping[str, Any]:  # type: ignore[override]
        """The quantities of a pair."""
        return OF_ONE_A_AND_C if self.one_A_and_C else OF_A_PAIR

    def case(self, index: int) -> Pair:
        """Return one of the pairs."""
        return Pair(self.first.system(int(self.firsts[index])), self.second.system(int(self.seconds[index])), self.one_A_and_C)

    def matrix(self, subject: str, name: str) -> Integers:
        """Return A, F, C or G of one of the two systems of every pair; A and C alone are those that both have."""
        batch, places = self.systems(subject)
        found: Integers = batch.matrix("", name)[places]
        return found

    def part(self, rows: Chosen) -> Pairs:
        """Return the pairs of these rows; what is known of the systems stays known."""
        return Pairs(self.first, self.firsts[rows], self.second, self.seconds[rows], self.one_A_and_C)

    def column(self, key: Any, rows: Chosen, find: Callable[[Any], Integers] | None = None) -> Integers:
        """Return the numbers of a family of one of the systems, of both together, or of what `find` finds. Raises Overflow."""
        return self.of_system(key, rows) if isinstance(key, tuple) else self.kept(key, rows, find or together)


def together(pairs: Both) -> Integers:
    """Return rank [O_s T_s] of both systems side by side, of pairs or choices; s = 0, ..., n + 1. Raises Overflow."""
    samples = max(pairs.first.n, pairs.second.n) + 1
    built = []
    for batch, places in map(pairs.systems, pairs.called):
        distinct, which = np.unique(places, return_inverse=True)
        built.append(window(batch.part(distinct), samples)[which])
    ranks = leading_ranks(np.concatenate(built, axis=2), pairs.prime)
    found: Integers = ranks[:, [pairs.first.G.shape[1] * s for s in range(samples + 1)]] // pairs.degree
    return found


def _equal_at(numbers: Numbers, s: int) -> bool:
    return all(_contained_in(numbers, s, outer) for outer in reversed(tuple(numbers.sizes)))


def _contained_at(numbers: Numbers, s: int) -> bool:
    """Return whether the outputs of the first are among those of the second."""
    _, second = numbers.sizes
    return _contained_in(numbers, s, second)


def _contained_in(numbers: Numbers, s: int, outer: str) -> bool:
    table = numbers.table(TOGETHER)
    at = min(s, len(table) - 1)
    return table[at] == numbers.of(outer).at(WINDOW, at)


def _last(numbers: Numbers) -> int:
    return max(n for n, _, _ in numbers.sizes.values()) + 1


def _first_difference(numbers: Numbers) -> float:
    return next((s for s in range(_last(numbers) + 1) if not _equal_at(numbers, s)), inf)


def _after(window: int | None, s: int) -> bool:
    return window is None or window > s


def _exact_difference(pair: PairSubject) -> float:
    found = pair.comparison.first_difference
    return inf if found is None else found


def _contained(pair: PairSubject) -> int | None:
    """Return the least number of samples on which the first is not contained in the second."""
    found = pair.comparison.first_not_in_second
    return None if found is None else found.window


def _compared(pair: PairSubject) -> list[Certificate]:
    """Return the certificate of equality, or of the shortest word that one system makes and the other does not."""
    return [comparison_certificate(pair.first.kernel, pair.second.kernel)]


def _first_difference_borne(pair: PairSubject) -> list[Certificate]:
    """Return the same, and that there is no difference on one sample less."""
    found = pair.comparison.first_difference
    equal = [] if found is None else [make.window_equality(pair.first.kernel, pair.second.kernel, found - 1)]
    return [*_compared(pair), *equal]


def _equal_on_borne(pair: PairSubject, s: int) -> list[Certificate]:
    if _after(pair.comparison.first_difference, s):
        return [make.window_equality(pair.first.kernel, pair.second.kernel, s)]
    return _compared(pair)


def _contained_borne(pair: PairSubject) -> list[Certificate]:
    if _contained(pair) is None:
        return [make.behaviour_inclusion(pair.first.system, pair.second.kernel)]
    return [make.behaviour_difference(pair.first.system, pair.second.kernel)]


def _contained_on_borne(pair: PairSubject, s: int) -> list[Certificate]:
    """Return that of inclusion or difference; where inclusion is on this window alone, of rank [O_s T_s] side by side and of the second."""
    window = _contained(pair)
    if window is None or window <= s:
        return _contained_borne(pair)
    return [
        make.matrix_rank("window", side_by_side(pair.first.system, pair.second.system), window=s),
        make.window_ranks(pair.second.kernel),
    ]


def side_by_side(first: ResidualSystem, second: ResidualSystem) -> ResidualSystem:
    """Return the system with the states and faults of both, whose output is the sum of theirs."""

    def diagonal(one: Matrix, other: Matrix) -> Matrix:
        field = one.field
        upper = beside(one, Matrix.zero(field, one.nrows, other.ncols))
        return stacked(upper, beside(Matrix.zero(field, other.nrows, one.ncols), other))

    outputs = beside(first.C, second.C), beside(first.G, second.G)
    return ResidualSystem(diagonal(first.A, second.A), diagonal(first.F, second.F), *outputs)


_LISTED = (
    Quantity(
        "equal",
        Kind.WORD,
        "both make the same outputs on every window",
        lambda x: x.comparison.equivalent,
        lambda r: _equal_at(r, _last(r)),
        _compared,
    ),
    Quantity(
        "contained",
        Kind.WORD,
        "every output of the first is one of the second, on every window",
        lambda x: _contained(x) is None,
        lambda r: _contained_at(r, _last(r)),
        _contained_borne,
    ),
    Quantity(
        "first_difference",
        Kind.INTEGER,
        "the least number of samples on which their outputs differ; inf where they are equal",
        _exact_difference,
        _first_difference,
        _first_difference_borne,
    ),
    Quantity(
        "equal_on",
        Kind.WORD,
        "both make the same outputs of s samples",
        lambda x, s: _after(x.comparison.first_difference, s),
        _equal_at,
        _equal_on_borne,
        windowed=True,
    ),
    Quantity(
        "contained_on",
        Kind.WORD,
        "every output of s samples of the first is one of the second",
        lambda x, s: _after(_contained(x), s),
        _contained_at,
        _contained_on_borne,
        windowed=True,
    ),
    Quantity(
        "p",
        Kind.INTEGER,
        "the number of outputs of both",
        lambda x: x.first.system.p,
        lambda r: r.sizes["first"][2],
        lambda x: [],
    ),
)
OF_A_PAIR = {one.name: one for one in _LISTED}
OF_ONE_A_AND_C = OF_A_PAIR | {
    "n": Quantity(
        "n", Kind.INTEGER, "the number of states of both", lambda x: x.first.system.n, lambda r: r.sizes["first"][0], lambda x: []
    )
}
