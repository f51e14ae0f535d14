"""Direct sums of two cases, many at once: of two systems, pairs, choices or records.

    sum_sizes      the sizes of the direct sum of two cases; None where they have none, records of different lengths
    direct_sums    the direct sums of couples of cases whose sums have the same sizes

The sum of two pairs has the sum of the first systems and that of the second ones. The solutions of problem (11) for a sum are those for its
parts, so that the rows of the reduced basis are those of both, ordered by the places of their leading ones; the rows of P go with them. The
sum of two records of the same length has the inputs of both side by side, and one initial state above the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import lcm
from typing import Any

import numpy as np
from flint import nmod

from ...exact.algebra.matrices import Matrix
from ...exact.structure.fault_columns import FaultSpace, fault_space, with_pair
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box
from ..quantities.batches import Batch
from ..quantities.cases import Case, Choice, Pair, Record, size_of
from ..quantities.choices import Choices
from ..quantities.elimination import Integers
from ..quantities.many import Many
from ..quantities.pairs import Pairs
from ..quantities.records import Records

Couple = tuple[Case, Case]


def sum_sizes(one: Case, other: Case) -> tuple[int, ...] | None:
    """Return by what direct sums are ordered and told apart."""
    if isinstance(one, Record) and isinstance(other, Record):
        if one.u.nrows != other.u.nrows:
            return None
        added = [a + b for a, b in zip(size_of(one), size_of(other), strict=True)]
        return (*added[:2], one.u.nrows, *added[3:])
    return tuple(a + b for a, b in zip(size_of(one), size_of(other), strict=True))


def direct_sums(couples: Sequence[Couple], box: Box) -> Many:
    """Return the direct sums, all of the same sizes, of cases of what the box is of, whose entries are integers."""
    if isinstance(couples[0][0], Pair):
        first, second = (
            _systems([(getattr(one, name), getattr(other, name)) for one, other in couples], box) for name in ("first", "second")
        )
        each = np.arange(len(couples))
        return Pairs(first, each, second, each, couples[0][0].one_A_and_C)
    if isinstance(couples[0][0], Choice):
        return _choices(couples, box)
    if isinstance(couples[0][0], Record):
        return _records(couples, box)
    return _systems(couples, box)


def _systems(couples: Sequence[tuple[Any, Any]], box: Box) -> Batch:
    A, F, C, G = (_diagonal([(getattr(one, name), getattr(other, name)) for one, other in couples]) for name in "AFCG")
    return Batch(A, F, C, G, box.prime, number_field=box.number_field)


def _records(couples: Sequence[tuple[Any, Any]], box: Box) -> Records:
    first = _systems([(one.system.residual, other.system.residual) for one, other in couples], box)
    B, D = (_diagonal([(getattr(one.system, name), getattr(other.system, name)) for one, other in couples]) for name in "BD")
    inputs = Batch(first.A, B, first.C, D, box.prime, number_field=box.number_field)
    u = np.stack([np.concatenate([integers(one.u), integers(other.u)], axis=1) for one, other in couples])
    x0 = np.stack([np.concatenate([integers(one.x0), integers(other.x0)], axis=0) for one, other in couples])
    each = np.arange(len(couples))
    return Records(first, each, inputs, each, u, x0)


def _choices(couples: Sequence[tuple[Any, Any]], box: Box) -> Choices:
    first = _systems([(one.system, other.system) for one, other in couples], box)
    spaces = [(_space(one.system), _space(other.system)) for one, other in couples]
    chosen = [(with_pair(a, one.P), with_pair(b, other.P)) for (a, b), (one, other) in zip(spaces, couples, strict=True)]
    scales = [lcm(*(_denominator(getattr(part, name)) for part in both for name in "FG")) for both in chosen]
    F, G = (
        np.stack([_block(*(integers(getattr(part, name), scale) for part in both)) for both, scale in zip(chosen, scales, strict=True)])
        for name in "FG"
    )
    second = Batch(first.A, F, first.C, G, box.prime, number_field=box.number_field)
    degree = box.field.degree
    width = first.A.shape[1] + first.C.shape[1]
    P = np.stack([_rows_in_order(one, other, a, b, width, degree) for (one, other), (a, b) in zip(couples, spaces, strict=True)])
    heights = np.array([a.dimension + b.dimension for a, b in spaces])
    return Choices(first, np.arange(len(couples)), second, P, heights, np.array(scales, dtype=np.int64))


def _rows_in_order(one: Choice, other: Choice, a: FaultSpace, b: FaultSpace, width: int, degree: int) -> Integers:
    """Return P of the sum, filled up with zeros to so many rows."""
    n, p = (one.system.n, other.system.n), (one.system.p, other.system.p)
    places = [k if k < n[0] else n[1] + k for k in _leading(a)]
    places += [n[0] + k if k < n[1] else n[0] + p[0] + k for k in _leading(b)]
    rows = _block(integers(one.P), integers(other.P))
    order = (np.argsort(np.array(places, dtype=np.int64))[:, None] * degree + np.arange(degree)).reshape(len(rows))
    return np.pad(rows[order], ((0, width - len(rows)), (0, 0)))


def _leading(space: FaultSpace) -> list[int]:
    """Return the places of the leading ones of the rows of the basis, ascending."""
    return [next(k for k, x in enumerate(row) if x != 0) for row in space.basis.elements()]


@lru_cache(maxsize=10_000)
def _space(system: ResidualSystem) -> FaultSpace:
    return fault_space(kernel_representation(system))


def _diagonal(parts: Sequence[tuple[Matrix, Matrix]]) -> Integers:
    return np.stack([_block(integers(one), integers(other)) for one, other in parts])


def _block(one: Integers, other: Integers) -> Integers:
    """Return one above and left of the other, and zeros."""
    (a, b), (c, d) = one.shape, other.shape
    found = np.zeros((a + c, b + d), dtype=np.int64)
    found[:a, :b], found[a:, b:] = one, other
    return found


@lru_cache(maxsize=40_000)
def integers(matrix: Matrix, scale: int = 1) -> Integers:
    """Return the numbers of a matrix, times the scale: integers or residues, over a number field those of its blocks."""
    table = matrix.flint
    numbers = [int(x) if isinstance(x, nmod) else int(x.p) * scale // int(x.q) for x in table.entries()]
    return np.array(numbers, dtype=np.int64).reshape(table.nrows(), table.ncols())


def _denominator(matrix: Matrix) -> int:
    """Return the common denominator of the entries; 1 over GF(q)."""
    return lcm(*(1 if isinstance(x, nmod) else int(x.q) for x in matrix.flint.entries()))
