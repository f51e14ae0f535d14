"""Inclusion and equality of output behaviours, on a window and in full, with a word that separates them where they differ.

    Separation          a word (x0, v) of one system on `window` samples and a kernel row of the other that it violates
    separation          the shortest word of `inner` that is none of `outer`, or None: then B(inner) is contained in B(outer)
    Comparison          both directions at once; `first_difference` = the least window on which the restricted behaviours differ
    compare             of two systems with the same field and p; n and m may differ

B(inner)|_s lies in B(outer)|_s iff every kernel row of `outer` of degree below s annihilates `inner`: those rows and their shifts span
the left null space of [O_s T_s], and a row that annihilates a system annihilates every later part of its outputs too. Source: [G25]
Theorem 1, [W91].
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.errors import InvalidInput
from ..algebra.matrices import Matrix
from ..system.systems import ResidualSystem
from .kernel_rows import KernelRepresentation, KernelRow, horner


@dataclass(frozen=True)
class Separation:
    """A word of the maker that the other system cannot make: `x0` n x 1, `v` window x m, `row` a kernel row of the other."""

    window: int
    x0: Matrix
    v: Matrix
    row: KernelRow


@dataclass(frozen=True)
class Comparison:
    """`first_not_in_second` and `second_not_in_first`: shortest separations, None where there is inclusion."""

    first: KernelRepresentation
    second: KernelRepresentation
    first_not_in_second: Separation | None
    second_not_in_first: Separation | None

    @property
    def equivalent(self) -> bool:
        """Whether the output behaviours are equal."""
        return self.first_difference is None

    @property
    def first_difference(self) -> int | None:
        """The least number of samples on which the restricted behaviours differ, None where they are equal."""
        found = [s.window for s in (self.first_not_in_second, self.second_not_in_first) if s is not None]
        return min(found, default=None)


def separation(inner: ResidualSystem, outer: KernelRepresentation) -> Separation | None:
    """The shortest word of `inner` that is not a word of `outer`, or None where B(inner) is contained in B(outer)."""
    _comparable(inner, outer.system)
    for row in outer.rows:
        left = horner(row.coefficients, inner)
        if left.vanishes():
            continue
        one = inner.field.element(1)
        state = [[inner.field.element(0)] for _ in range(inner.n)]
        fault = [[inner.field.element(0)] * inner.m for _ in range(row.degree + 1)]
        place = _first_nonzero(left.at_state)
        if place is not None:
            state[place][0] = one
        else:
            k, place = next((k, j) for k, part in enumerate(left.at_fault) if (j := _first_nonzero(part)) is not None)
            fault[k][place] = one
        x0 = Matrix.from_elements(inner.field, inner.n, 1, state)
        v = Matrix.from_elements(inner.field, row.degree + 1, inner.m, fault)
        return Separation(row.degree + 1, x0, v, row)
    return None


def compare(first: KernelRepresentation, second: KernelRepresentation) -> Comparison:
    """Whether two systems, given by their kernel representations, make the same outputs.

    Raises InvalidInput when fields or numbers of outputs differ.
    """
    return Comparison(first, second, separation(first.system, second), separation(second.system, first))


def included_on(inner: ResidualSystem, outer: KernelRepresentation, window: int) -> bool:
    """Whether every word of `inner` of that many samples is a word of `outer`."""
    found = separation(inner, outer)
    return found is None or found.window > window


def _first_nonzero(row: Matrix) -> int | None:
    return next((j for j, x in enumerate(row.elements()[0]) if x != 0), None) if row.ncols else None


def _comparable(first: ResidualSystem, second: ResidualSystem) -> None:
    if first.field != second.field:
        raise InvalidInput(f"field: got {first.field} and {second.field}, expected the same field for both systems")
    if first.p != second.p:
        raise InvalidInput(f"p: got {first.p} and {second.p} outputs, expected as many in both systems")
