"""Bounds on an integer by others, from a stated grammar, fitted on a table of what systems have.

    Term           a coefficient and a column, or the smaller or larger of two columns
    Form           a sum of terms
    Grammar        how many terms a form may have, how large its coefficients and the constant beside it may be
    Fitted         a form with the constant that makes it a bound, and the rows where it is attained
    Fit            the bounds that are kept, those of which the difference is constant, and how many forms were looked at
    forms          all forms of a grammar in some columns
    fit            the bounds of a target, above or below, that no row refutes, none of them implied by others

A bound above is target <= form + c, with c the least number that no row refutes; it is then attained, and c - 1 is refuted by what attains
it. Bounds with a constant beyond the grammar's, and those that no system of the box attains, are left out: they tell where the box ends. So
are those attained only on rows of the box where a single other one is attained, and elsewhere, too; of bounds attained on the same rows of
the box that one stays which is attained most often outside it and then costs least, the cost being its size. The kept ones are a cover:
each row of the box on which some bound of the grammar is attained has a kept one that is attained there, and each kept one has a row on
which it alone of them is, so that the others do not imply it. It is the greedy cover, by new rows for the cost: few and simple bounds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from ...base.sheets import counted
from ..language.linear import words
from ..quantities.elimination import Integers

AT_ONCE = 4_000_000  # numbers of a table of forms on rows that are held at a time
ABOVE, BELOW = "above", "below"


@dataclass(frozen=True)
class Term:
    """`coefficient` times the column, or times the `op` ("min", "max") of two columns."""

    coefficient: int
    columns: tuple[int, ...]
    op: str = ""

    def words(self, names: Sequence[str]) -> str:
        """Return what the coefficient stands before, in the language."""
        inside = ", ".join(names[k] for k in self.columns)
        return f"{self.op}({inside})" if self.op else inside

    @property
    def cost(self) -> int:
        """One for each column, for min or max, and for each unit of the coefficient beyond the first."""
        return len(self.columns) + bool(self.op) + abs(self.coefficient) - 1


@dataclass(frozen=True)
class Form:
    """A sum of terms."""

    terms: tuple[Term, ...]

    @property
    def cost(self) -> int:
        """The size of the form: the sum of its terms'."""
        return sum(one.cost for one in self.terms)

    def words(self, names: Sequence[str], constant: int) -> str:
        """Return form + constant in the language."""
        return words([(one.words(names), one.coefficient) for one in self.terms], constant)

    def on(self, table: Integers) -> Integers:
        """Return the values (rows,) of the form on a table (rows, columns)."""
        found = np.zeros(len(table), dtype=table.dtype)
        for one in self.terms:
            found += one.coefficient * _column(one, table)
        return found


@dataclass(frozen=True)
class Grammar:
    """Sums of at most `terms` columns with coefficients from -largest to largest, and a constant from -constant to constant.

    One term may be the larger of two columns where that is more than two bounds would say, the smaller where the bound is below.
    """

    terms: int = 3
    largest: int = 2
    constant: int = 2

    def words(self, side: str) -> str:
        """Return the grammar in words."""
        op = "max" if side == ABOVE else "min"
        more = f", or {op} of two of them" + (" and one more" if self.terms > 1 else "")
        sums = f"sums of at most {counted(self.terms, 'quantity', 'quantities')} with coefficients from -{self.largest} to {self.largest}"
        return f"{sums}{more}, and " + (f"a constant from -{self.constant} to {self.constant}" if self.constant else "no constant")


@dataclass(frozen=True)
class Fitted:
    """`attained` are flags (rows,): where the target is form + constant."""

    form: Form
    constant: int
    attained: NDArray[np.bool_]

    @property
    def cost(self) -> int:
        """The size of the bound."""
        return 1 + self.form.cost + abs(self.constant)

    @property
    def often(self) -> int:
        """On how many rows the bound is attained."""
        return int(self.attained.sum())


@dataclass(frozen=True)
class Fit:
    """`kept` stand in the order in which they were taken; `equal` are forms that differ from the target by their constant on every row."""

    kept: tuple[Fitted, ...]
    equal: tuple[Fitted, ...]
    looked_at: int


def forms(columns: int, grammar: Grammar, side: str) -> Iterator[Form]:
    """Yield every form of the grammar in so many columns, a bound above or below being sought."""
    coefficients = [k for k in range(-grammar.largest, grammar.largest + 1) if k]
    for size in range(grammar.terms + 1):
        for chosen in combinations(range(columns), size):
            for numbers in product(coefficients, repeat=size):
                yield Form(tuple(Term(k, (column,)) for k, column in zip(numbers, chosen, strict=True)))
    # target <= min(a, b) says the two bounds target <= a and target <= b; max(a, b) and -min(a, b) say what no two bounds do
    op, other = ("max", "min") if side == ABOVE else ("min", "max")
    for pair in combinations(range(columns), 2):
        for term in (Term(1, pair, op), Term(-1, pair, other)):
            yield Form((term,))
            for column, sign in product(range(columns), (1, -1)):
                if column not in pair and grammar.terms > 1:
                    yield Form((term, Term(sign, (column,))))


def fit(target: Integers, table: Integers, in_box: NDArray[np.bool_], grammar: Grammar, side: str) -> Fit:
    """Return the bounds on `target` (rows,) by the columns of `table` (rows, columns) that no row refutes, attained on rows `in_box`."""
    if not in_box.any():
        return Fit((), (), 0)
    sign = 1 if side == ABOVE else -1
    largest = max((int(np.abs(one).max()) for one in (target, table) if one.size), default=0)
    if largest * (1 + grammar.terms * grammar.largest) < 2**15:  # narrow numbers are gone through several times faster
        target, table = target.astype(np.int16), table.astype(np.int16)
    found: dict[bytes, Fitted] = {}
    equal: list[Fitted] = []
    count = 0
    for listed, values in _on_rows(forms(table.shape[1], grammar, side), table):
        count += len(listed)
        gaps = sign * (target - values)
        constants = gaps.max(axis=1)
        attained = gaps == constants[:, None]
        usable = np.flatnonzero((np.abs(constants) <= grammar.constant) & attained[:, in_box].any(axis=1))
        for k in usable:
            new = Fitted(listed[k], sign * int(constants[k]), attained[k].copy())
            if attained[k].all():
                equal.append(new)
                continue
            name = np.packbits(attained[k][in_box]).tobytes()
            if name not in found or (new.often, -new.cost) > (found[name].often, -found[name].cost):
                found[name] = new
    equal.sort(key=lambda one: one.cost)
    return Fit(tuple(_cover(list(found.values()), in_box)), tuple(equal), count)


def _column(term: Term, table: Integers) -> Integers:
    found: Integers
    if not term.op:
        return table[:, term.columns[0]]
    found = (np.maximum if term.op == "max" else np.minimum)(table[:, term.columns[0]], table[:, term.columns[1]])
    return found


def _on_rows(every: Iterator[Form], table: Integers) -> Iterator[tuple[list[Form], Integers]]:
    """Yield forms, some at a time, and their values (forms, rows)."""
    size = max(1, AT_ONCE // max(1, len(table)))
    listed: list[Form] = []
    for one in every:
        listed.append(one)
        if len(listed) == size:
            yield listed, np.stack([form.on(table) for form in listed])
            listed = []
    if listed:
        yield listed, np.stack([form.on(table) for form in listed])


def _sharpest(found: list[Fitted], in_box: NDArray[np.bool_]) -> list[Fitted]:
    """Return those of which no other one is attained on all rows of the box where they are, and on more. No two have the same rows."""
    if not found:
        return []
    flags = np.stack([one.attained[in_box] for one in found]).astype(np.float32)  # counts below 2^24 are exact
    sizes = flags.sum(axis=1)
    step = max(1, AT_ONCE // len(found))
    kept: list[Fitted] = []
    for k in range(0, len(found), step):
        mine = sizes[k : k + step, None]
        beaten = ((flags[k : k + step] @ flags.T == mine) & (sizes > mine)).any(axis=1)
        kept += [one for one, within in zip(found[k : k + step], beaten, strict=True) if not within]
    return kept


def _cover(found: list[Fitted], in_box: NDArray[np.bool_]) -> list[Fitted]:
    """Return some that are together attained wherever one of all is, greedily, and none of which is attained only where others are."""
    found = _sharpest(found, in_box)
    if not found:
        return []
    attained = np.stack([one.attained[in_box] for one in found])
    costs = np.array([one.cost for one in found])
    covered = np.zeros(attained.shape[1], dtype=bool)
    kept: list[int] = []
    while (gains := (attained & ~covered).sum(axis=1)).any():
        best = int(np.argmax(gains / costs))
        kept.append(best)
        covered |= attained[best]
    for one in list(kept):
        others = [k for k in kept if k != one]
        if others and not (attained[one] & ~attained[others].any(axis=0)).any():
            kept = others
    return [found[k] for k in kept]
