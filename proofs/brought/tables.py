"""What some integers are on all systems of a box, as a table: one row for each set of values that occurs.

    Row          the values, the first system of the box that has them, and how many have them, in the box and among the known systems
    Table        the rows, the first systems in the order of the box, and how much was gone through
    tabulate     the table of expressions on a box, on known systems, direct sums and drawn systems, under hypotheses

The direct sums are those of two systems of the table: most numbers of a direct sum are sums or maxima of those of its parts, so that they
reach beyond the box, and what is a bound only because the box ends falls. So do systems of up to six states that are drawn from a seed,
with few entries that are not 0. Whether an inequality between these integers fails somewhere is seen from the rows, and so is the first
system of the box on which it fails: tens of millions of systems have some hundreds of rows.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import groupby
from typing import Any

import numpy as np
from flint import nmod

from ...base.errors import InvalidInput
from ...base.progress import Progress
from ...base.tasks import ordered
from ...exact.algebra.fields import Field
from ...exact.system.systems import ResidualSystem
from ..language.by_batches import Table as Answers
from ..language.by_batches import UndefinedAt, Values, true_of, values_of
from ..language.evaluating import Exactly, evaluate
from ..language.invariance import invariant
from ..language.nodes import Node
from ..language.nodes import Undefined as NoValue
from ..quantities.batches import Batch
from ..quantities.blocks import Scalars, lifted
from ..quantities.elimination import Integers
from .boxes import Box, Share, Stretch
from .kept import WORTH_SHARING
from .known_systems import ADVERSARY, CORPUS, known_systems
from .trying import Undefined, must_have_a_value

Place = tuple[int, int, int]  # the number of the sizes in the order of the box, of the stretch, of the system
OUTSIDE = 10**9  # sizes of systems outside the box are numbered from here on, so that they come after it
# Sums; and draws of so many systems each, until so many meet the hypotheses: some twenty seconds where there are twenty columns.
MOST_SUMS, MOST_MET, DRAWS, AT_A_TIME, SEED = 2_000, 3_000, 80, 100, 1


@dataclass
class Row:
    """`systems` of the box have these values, of which `system`, at `place`, is the first; so have `others` outside it.

    Where no system of the box has them, `system` is the smallest known one that has, else a direct sum or a drawn one.
    """

    values: Values
    place: Place
    system: ResidualSystem
    systems: int = 0
    others: int = 0

    @property
    def in_box(self) -> bool:
        """Whether a system of the box has these values."""
        return self.place[0] < OUTSIDE


@dataclass
class Table:
    """`rows` stand in the order of their first systems. `systems` of the box were gone through, by `looked_at` of them."""

    box: Box
    rows: list[Row]
    systems: int = 0
    looked_at: int = 0
    exhausted: bool = True
    corpus: int = 0
    corpus_met: int = 0
    adversary: int = 0
    adversary_met: int = 0
    sums: int = 0
    sums_met: int = 0
    drawn: int = 0
    drawn_met: int = 0

    @property
    def met(self) -> int:
        """How many systems of the box meet the hypotheses."""
        return sum(row.systems for row in self.rows)


@dataclass(frozen=True)
class _Asked:
    """What a table is made of; `reduced` where one system of each orbit is enough."""

    box: Box
    hypotheses: tuple[Node, ...]
    columns: tuple[Node, ...]
    reduced: bool


@dataclass
class _Part(Share):
    """What one process found in its share of the systems of some sizes."""

    rows: dict[Values, Row] = field(default_factory=dict)
    undefined: tuple[Place, Undefined] | None = None
    answers: dict[object, Answers] = field(default_factory=dict)


def tabulate(box: Box, hypotheses: Sequence[Node], columns: Sequence[Node], *, most: int, jobs: int, progress: Progress) -> Table:
    """Return the table of the columns on the systems that meet the hypotheses: all of the box, or `most` of it, and the known ones.

    Raises InvalidInput where a hypothesis or a column has no value on a system, which it names.
    """
    table = Table(box, [])
    rows: dict[Values, Row] = {}
    asked = _Asked(box, tuple(hypotheses), tuple(columns), invariant(*hypotheses, *columns))
    total = sum(box.count(*one) for one in box.sizes())
    shown = max(1, total // 1000)

    def tell(more: int) -> None:
        progress("going through the box", (table.systems + more) // shown, total // shown)

    for number in range(len(box.sizes())):
        if table.systems >= most:
            table.exhausted = False
            break
        tell(0)
        parts = _share(asked, number, most - table.systems, jobs, tell)
        if undefined := [part.undefined for part in parts if part.undefined is not None]:
            raise must_have_a_value(min(undefined, key=lambda found: found[0])[1], "in the box")
        for part in parts:
            table.systems += part.systems
            table.looked_at += part.looked_at
            table.exhausted &= part.whole
            for row in part.rows.values():
                _merge(rows, row)
    progress("looking at known systems", 0, 0)
    _add_known(table, rows, hypotheses, columns, box.field)
    progress("looking at direct sums", 0, 0)
    _add_sums(table, rows, hypotheses, columns)
    progress("looking at drawn systems", 0, 0)
    _add_drawn(table, rows, hypotheses, columns)
    table.rows = sorted(rows.values(), key=lambda row: row.place)
    return table


def _merge(rows: dict[Values, Row], new: Row) -> None:
    """Add a row, or what it says to the row with the same values."""
    old = rows.setdefault(new.values, new)
    if old is new:
        return
    if new.place < old.place:
        old.place, old.system = new.place, new.system
    old.systems += new.systems
    old.others += new.others


def _share(asked: _Asked, number: int, left: int, jobs: int, tell: Callable[[int], None]) -> list[_Part]:
    if jobs == 1 or asked.box.count(*asked.box.sizes()[number]) < WORTH_SHARING:
        return [_of_sizes(asked, number, left, 0, 1, tell)]
    return list(ordered(_of_sizes, [(asked, number, left // jobs, k, jobs, None) for k in range(jobs)], count=jobs))


def _of_sizes(asked: _Asked, number: int, left: int, mine: int, of: int, tell: Callable[[int], None] | None) -> _Part:
    """Go through every `of`th stretch of the systems of the sizes with this number, from number `mine` on."""
    part = _Part()
    for k, stretch in part.stretches(asked.box, asked.box.sizes()[number], left, mine, of, reduced=asked.reduced):
        try:
            _add_stretch(part, (number, k), stretch, asked.hypotheses, asked.columns)
        except UndefinedAt as error:
            place = (number, k, int(stretch.places[error.index]))
            part.undefined = place, Undefined(str(error), stretch.batch.system(error.index))
            break
        if tell is not None:
            tell(part.systems)
    part.answers.clear()
    return part


def _add_stretch(part: _Part, at: tuple[int, int], stretch: Stretch, hypotheses: Sequence[Node], columns: Sequence[Node]) -> None:
    rows = np.arange(len(stretch.batch))
    for node in hypotheses:
        rows = rows[true_of(node, stretch.batch, rows, part.answers.setdefault(node, Answers()))]
    for values, members in values_of(columns, stretch.batch, rows, part.answers.setdefault("columns", Answers())):
        first = int(members[np.argmin(stretch.places[members])])
        place, systems = (*at, int(stretch.places[first])), int(stretch.weights[members].sum())
        old = part.rows.get(values)
        if old is None:
            part.rows[values] = Row(values, place, stretch.batch.system(first), systems)
            continue
        old.systems += systems
        if place < old.place:
            old.place, old.system = place, stretch.batch.system(first)


def _add_known(table: Table, rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node], field: Field) -> None:
    listed = sorted(known_systems(field), key=lambda one: (_sizes(one.subject.system), one.origin))
    met = dict.fromkeys((CORPUS, ADVERSARY), 0)
    for number, one in enumerate(listed):
        exactly = Exactly({"": one.subject})
        try:
            if not all(evaluate(node, exactly) for node in hypotheses):
                continue
            values = tuple(evaluate(node, exactly) for node in columns)
        except NoValue as error:
            raise InvalidInput(f"on {one.subject.system}, {error}") from None
        met[one.origin] += 1
        _merge(rows, Row(values, (OUTSIDE, 0, number), one.subject.system, others=1))
    table.corpus, table.adversary = (sum(1 for one in listed if one.origin == origin) for origin in (CORPUS, ADVERSARY))
    table.corpus_met, table.adversary_met = met[CORPUS], met[ADVERSARY]


def _add_sums(table: Table, rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> None:
    """Add the direct sums of the first systems of the rows with the smallest of them; there are none where entries have denominators."""
    if Scalars.of(table.box.entries, table.box.number_field).scale != 1:
        return
    firsts = [row.system for row in sorted(rows.values(), key=lambda row: row.place) if row.in_box]
    partners = firsts[: MOST_SUMS // len(firsts)] if firsts else []
    pairs = [(one, other) for k, one in enumerate(firsts) for other in partners[: k + 1]]
    pairs.sort(key=lambda pair: _sizes_of_sum(*pair))
    for number, (_, group) in enumerate(groupby(pairs, key=lambda pair: _sizes_of_sum(*pair))):
        listed = list(group)
        batch = _direct_sums(listed, table.box)
        table.sums += len(listed)
        table.sums_met += _add_batch(batch, (OUTSIDE + 1, number), rows, hypotheses, columns)


def _add_drawn(table: Table, rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> None:
    """Add systems with up to 6 states, 3 faults and 4 outputs, whose entries are -1, 0, 1 (over GF(2): 0, 1), many of them 0."""
    rng, degree = np.random.default_rng(SEED), table.box.field.degree
    for number in range(DRAWS):
        if table.drawn_met >= MOST_MET:
            break
        n, m, p = (int(rng.integers(1, 1 + most)) for most in (6, 3, 4))
        full = rng.choice((0.1, 0.2, 0.35, 0.6), size=4) * (1, 1, 1, rng.choice((0, 0.5, 1)))
        signs = (1,) if table.box.prime == 2 else (-1, 1)
        A, F, C, G = (
            lifted(np.where(rng.random((AT_A_TIME, *shape)) < share, rng.choice(signs, (AT_A_TIME, *shape)), 0).astype(np.int64), degree)
            for shape, share in zip(((n, n), (n, m), (p, n), (p, m)), full, strict=True)
        )
        batch = Batch(A, F, C, G, table.box.prime, number_field=table.box.number_field)
        table.drawn += AT_A_TIME
        table.drawn_met += _add_batch(batch, (OUTSIDE + 2, number), rows, hypotheses, columns)


def _add_batch(batch: Batch, at: tuple[int, int], rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> int:
    """Add systems outside the box, and return how many of them meet the hypotheses."""
    part, each = _Part(), Stretch(batch, np.arange(len(batch)), np.ones(len(batch), dtype=np.int64))
    try:
        _add_stretch(part, at, each, hypotheses, columns)
    except UndefinedAt as error:
        raise InvalidInput(f"on {batch.system(error.index)}, {error}") from None
    met = sum(row.systems for row in part.rows.values())
    for row in part.rows.values():
        row.systems, row.others = 0, row.systems
        _merge(rows, row)
    return met


def _direct_sums(pairs: Sequence[tuple[ResidualSystem, ResidualSystem]], box: Box) -> Batch:
    """Return the direct sums of pairs of systems with integer entries, all of the same sizes."""
    n, m, p = (size * box.field.degree for size in _sizes_of_sum(*pairs[0])[1:])
    built = {"A": (n, n), "F": (n, m), "C": (p, n), "G": (p, m)}
    joined = {name: np.zeros((len(pairs), *shape), dtype=np.int64) for name, shape in built.items()}
    for place, (one, other) in enumerate(pairs):
        for name, into in joined.items():
            first, second = _integers(one)[name], _integers(other)[name]
            height, width = first.shape
            into[place, :height, :width] = first
            into[place, height:, width:] = second
    return Batch(joined["A"], joined["F"], joined["C"], joined["G"], box.prime, number_field=box.number_field)


@lru_cache(maxsize=10_000)
def _integers(system: ResidualSystem) -> dict[str, Integers]:
    """Return the matrices of a system whose entries are integers, residues, or blocks of integers."""
    return {name: _table(getattr(system, name).flint) for name in "AFCG"}


def _table(matrix: Any) -> Integers:
    """Return the numbers of a matrix of flint, which are integers or residues."""
    numbers = [int(x) if isinstance(x, nmod) else int(x.p) for x in matrix.entries()]
    return np.array(numbers, dtype=np.int64).reshape(matrix.nrows(), matrix.ncols())


def _sizes_of_sum(one: ResidualSystem, other: ResidualSystem) -> tuple[int, ...]:
    return tuple(a + b for a, b in zip(_sizes(one), _sizes(other), strict=True))


def _sizes(system: ResidualSystem) -> tuple[int, ...]:
    return (system.n + system.m + system.p, system.n, system.m, system.p)
