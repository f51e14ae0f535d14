"""What some integers are on all cases of a box, systems or what claims are about else, as a table: one row for each set of values.

    Row          the values, the first case of the box that has them, and how many have them, in the box and among the known cases
    Table        the rows, the first cases in the order of the box, and how much was gone through
    add_batch    cases outside the box, added to the rows
    tabulate     the table of expressions on a box, on known cases, direct sums and drawn cases, under hypotheses

The direct sums are those of two cases of the table: most numbers of a direct sum are sums or maxima of those of its parts, so that they
reach beyond the box, and what is a bound only because the box ends falls. So do cases of up to six states that are drawn from a seed,
with few entries that are not 0. Whether an inequality between these integers fails somewhere is seen from the rows, and so is the first
case of the box on which it fails: tens of millions of systems have some hundreds of rows.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import groupby, islice

import numpy as np

from ...base.errors import InvalidInput
from ...base.progress import Progress
from ...base.tasks import ordered
from ..boxes.box import Box, Share, Stretch
from ..language.by_batches import Table as Answers
from ..language.by_batches import UndefinedAt, Values, true_of, values_of
from ..language.evaluating import evaluate, exactly
from ..language.invariance import invariant
from ..language.nodes import Node
from ..language.nodes import Undefined as NoValue
from ..language.vocabularies import VOCABULARIES
from ..quantities.blocks import Scalars
from ..quantities.cases import Case, size_of
from ..quantities.many import Many
from .direct_sums import direct_sums, sum_sizes
from .drawn_cases import drawn
from .kept import WORTH_SHARING
from .known_cases import ADVERSARY, CORPUS, known_cases
from .trying import Undefined, must_have_a_value

Place = tuple[int, int, int]  # the number of the sizes in the order of the box, of the stretch, of the system
OUTSIDE = 10**9  # sizes of cases outside the box are numbered from here on, so that they come after it
# Sums; and draws, until so many meet the hypotheses: some twenty seconds where there are twenty columns.
MOST_SUMS, MOST_MET, DRAWS, SEED = 2_000, 3_000, 80, 1


@dataclass
class Row:
    """`systems` cases of the box have these values, of which `case`, at `place`, is the first; so have `others` outside it.

    Where none of the box has them, `case` is the smallest known one that has, else a direct sum or a drawn one.
    """

    values: Values
    place: Place
    case: Case
    systems: int = 0
    others: int = 0

    @property
    def in_box(self) -> bool:
        """Whether a case of the box has these values."""
        return self.place[0] < OUTSIDE


@dataclass
class Table:
    """`rows` stand in the order of their first cases. `systems` cases of the box were gone through, by `looked_at` of them."""

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
    sparse: int = 0
    sparse_met: int = 0

    @property
    def met(self) -> int:
        """How many cases of the box meet the hypotheses."""
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
    """Return the table of the columns on the cases that meet the hypotheses: all of the box, or `most` of it, and those outside it.

    Raises InvalidInput where a hypothesis or a column has no value on a case, which it names.
    """
    table = Table(box, [])
    rows: dict[Values, Row] = {}
    reduced = invariant(*hypotheses, *columns, vocabulary=VOCABULARIES[box.about])
    asked = _Asked(box, tuple(hypotheses), tuple(columns), reduced)
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
    progress(f"looking at known {box.noun}", 0, 0)
    _add_known(table, rows, hypotheses, columns)
    progress("looking at direct sums", 0, 0)
    _add_sums(table, rows, hypotheses, columns)
    progress(f"looking at drawn {box.noun}", 0, 0)
    _add_drawn(table, rows, hypotheses, columns)
    table.rows = sorted(rows.values(), key=lambda row: row.place)
    return table


def _merge(rows: dict[Values, Row], new: Row) -> None:
    """Add a row, or what it says to the row with the same values."""
    old = rows.setdefault(new.values, new)
    if old is new:
        return
    if new.place < old.place:
        old.place, old.case = new.place, new.case
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
            place = (number, k, error.index)
            part.undefined = place, Undefined(str(error), stretch.batch.case(error.index))
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
        first = int(members.min())
        place, systems = (*at, first), int(stretch.weights[members].sum())
        old = part.rows.get(values)
        if old is None:
            part.rows[values] = Row(values, place, stretch.batch.case(first), systems)
            continue
        old.systems += systems
        if place < old.place:
            old.place, old.case = place, stretch.batch.case(first)


def _add_known(table: Table, rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> None:
    listed = sorted(known_cases(table.box), key=lambda one: (size_of(one.case), one.origin))
    met = dict.fromkeys((CORPUS, ADVERSARY), 0)
    for number, one in enumerate(listed):
        knows = exactly(one.case, one.subject)
        try:
            if not all(evaluate(node, knows) for node in hypotheses):
                continue
            values = tuple(evaluate(node, knows) for node in columns)
        except NoValue as error:
            raise InvalidInput(f"on {one.case}, {error}") from None
        met[one.origin] += 1
        _merge(rows, Row(values, (OUTSIDE, 0, number), one.case, others=1))
    table.corpus, table.adversary = (sum(1 for one in listed if one.origin == origin) for origin in (CORPUS, ADVERSARY))
    table.corpus_met, table.adversary_met = met[CORPUS], met[ADVERSARY]


def _add_sums(table: Table, rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> None:
    """Add the direct sums of the first cases of the rows with the smallest of them; there are none where entries have denominators."""
    if Scalars.of(table.box.entries, table.box.number_field).scale != 1:
        return
    firsts = [row.case for row in sorted(rows.values(), key=lambda row: row.place) if row.in_box]
    partners = firsts[: max(1, MOST_SUMS // len(firsts))] if firsts else []
    every = ((sizes, (one, other)) for k, one in enumerate(firsts) for other in partners[: k + 1] if (sizes := sum_sizes(one, other)))
    couples = sorted(islice(every, MOST_SUMS), key=lambda one: one[0])
    for number, (_, group) in enumerate(groupby(couples, key=lambda one: one[0])):
        listed = [couple for _, couple in group]
        table.sums += len(listed)
        table.sums_met += add_batch(direct_sums(listed, table.box), (OUTSIDE + 1, number), rows, hypotheses, columns)


def _add_drawn(table: Table, rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> None:
    rng = np.random.default_rng(SEED)
    for number in range(DRAWS):
        if table.drawn_met >= MOST_MET:
            break
        batch = drawn(table.box, rng)
        table.drawn += len(batch)
        table.drawn_met += add_batch(batch, (OUTSIDE + 2, number), rows, hypotheses, columns)


def add_batch(batch: Many, at: tuple[int, int], rows: dict[Values, Row], hypotheses: Sequence[Node], columns: Sequence[Node]) -> int:
    """Add cases outside the box, and return how many of them meet the hypotheses."""
    part, each = _Part(), Stretch(batch, np.ones(len(batch), dtype=np.int64))
    try:
        _add_stretch(part, at, each, hypotheses, columns)
    except UndefinedAt as error:
        raise InvalidInput(f"on {batch.case(error.index)}, {error}") from None
    met = sum(row.systems for row in part.rows.values())
    for row in part.rows.values():
        row.systems, row.others = 0, row.systems
        _merge(rows, row)
    return met
