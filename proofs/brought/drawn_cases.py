"""Cases that are drawn from a seed, many of the same sizes at once: systems, pairs, choices, records beyond the box.

    drawn      cases of what a box is of, with up to 6 states

Systems have up to 6 states, 3 faults and 4 outputs, and entries -1, 0, 1 (over GF(2): 0, 1), many of them 0. The second system of a pair is
the first with one entry changed, the first with other faults, or another one with as many outputs, and half of the pairs are turned round:
those of the first two kinds may agree for a while, all the more since in half of the draws the first is a chain of states of which the last
is seen. Half of the other ones make every output: they agree with the first as long as its lag. A choice has a P with such entries, and a
record up to 16 samples of one or two inputs.
"""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from ...exact.structure.fault_columns import fault_space
from ...exact.structure.kernel_rows import kernel_representation
from ..boxes.box import Box
from ..boxes.choice_box import choices_of
from ..language.vocabularies import CHOICE, ONE_A_AND_C, RECORD, SYSTEM
from ..quantities.batches import Batch
from ..quantities.blocks import lifted
from ..quantities.elimination import Integers
from ..quantities.many import Many
from ..quantities.pairs import Pairs
from ..quantities.records import Records

AT_A_TIME, LARGEST_STATES, MOST_FAULTS, MOST_OUTPUTS = 100, 6, 3, 4
CHOICES_EACH, LONGEST = 4, 16  # choices of one system, whose fault space takes a while to find; samples of a record
Sizes = tuple[int, int, int]


def drawn(box: Box, rng: Generator) -> Many:
    """Return AT_A_TIME cases of the same sizes over the field of the box."""
    sizes = (int(rng.integers(1, 1 + LARGEST_STATES)), int(rng.integers(1, 1 + MOST_FAULTS)), int(rng.integers(1, 1 + MOST_OUTPUTS)))
    if box.about == SYSTEM:
        return _systems(box, rng, sizes, AT_A_TIME)
    if box.about == CHOICE:
        return _choices(box, rng, sizes)
    return _records(box, rng, sizes) if box.about == RECORD else _pairs(box, rng, sizes)


def _systems(box: Box, rng: Generator, sizes: Sizes, count: int) -> Batch:
    n, m, p = sizes
    shares = rng.choice((0.1, 0.2, 0.35, 0.6), size=4) * (1, 1, 1, rng.choice((0, 0.5, 1)))
    shapes = ((n, n), (n, m), (p, n), (p, m))
    A, F, C, G = (_entries(box, rng, (count, *shape), share) for shape, share in zip(shapes, shares, strict=True))
    return Batch(A, F, C, G, box.prime, number_field=box.number_field)


def _entries(box: Box, rng: Generator, shape: tuple[int, ...], share: float) -> Integers:
    """Return matrices of which this share of the entries is not 0."""
    signs = (1,) if box.prime == 2 else (-1, 1)
    return lifted(np.where(rng.random(shape) < share, rng.choice(signs, shape), 0).astype(np.int64), box.field.degree)


def _pairs(box: Box, rng: Generator, sizes: Sizes) -> Pairs:
    first, shared = _systems(box, rng, sizes, AT_A_TIME), box.about == ONE_A_AND_C
    if rng.random() < 0.5:
        first = _chained(first)
    way = int(rng.integers(2 if shared else 3))
    if way == 0:
        second = _changed(first, rng, "FG" if shared else "AFCG")
    elif way == 1:
        other = _systems(box, rng, (sizes[0], int(rng.integers(1, 1 + MOST_FAULTS)), sizes[2]), AT_A_TIME)
        second = _of(first, first.A, other.F, first.C, other.G)
    else:
        second = _systems(box, rng, (int(rng.integers(1, 1 + LARGEST_STATES)), *sizes[1:]), AT_A_TIME)
        second = _free(second) if rng.random() < 0.5 else second
    both = (second, first) if rng.random() < 0.5 else (first, second)
    each = np.arange(AT_A_TIME)
    return Pairs(both[0], each, both[1], each, shared)


def _chained(batch: Batch) -> Batch:
    """Return the systems with each state driving the next one, the last being the first output; the others see no state."""
    A, C, d = np.zeros_like(batch.A), np.zeros_like(batch.C), batch.degree
    A[:, d:, : A.shape[2] - d] = np.eye(A.shape[1] - d, dtype=np.int64)
    C[:, :d, -d:] = np.eye(d, dtype=np.int64)
    return _of(batch, A, batch.F, C, batch.G)


def _free(batch: Batch) -> Batch:
    """Return the systems with a fault of its own for each output, so that every output is possible, and the fault moves no state."""
    unit = np.broadcast_to(np.eye(batch.C.shape[1], dtype=np.int64), (len(batch), batch.C.shape[1], batch.C.shape[1]))
    return _of(batch, batch.A, np.zeros((len(batch), batch.A.shape[1], unit.shape[2]), dtype=np.int64), batch.C, unit)


def _changed(batch: Batch, rng: Generator, names: str) -> Batch:
    """Return the systems with one entry of these matrices, in each another one, that is one more than it was."""
    d = batch.degree
    parts = {name: batch.matrix("", name).copy() for name in "AFCG"}
    places = [(name, i, j) for name in names for i in range(parts[name].shape[1] // d) for j in range(parts[name].shape[2] // d)]
    for number, at in enumerate(rng.integers(len(places), size=len(batch))):
        name, i, j = places[at]
        block = parts[name][number, i * d : (i + 1) * d, j * d : (j + 1) * d]
        block += np.eye(d, dtype=np.int64)
        if batch.prime is not None:
            block %= batch.prime
    return _of(batch, *parts.values())


def _of(batch: Batch, A: Integers, F: Integers, C: Integers, G: Integers) -> Batch:
    return Batch(A, F, C, G, batch.prime, number_field=batch.number_field)


def _choices(box: Box, rng: Generator, sizes: Sizes) -> Many:
    first = _systems(box, rng, sizes, AT_A_TIME // CHOICES_EACH)
    spaces = [fault_space(kernel_representation(first.system(i))) for i in range(len(first))]
    k, share, each = int(rng.integers(1, 1 + MOST_FAULTS)), rng.choice((0.2, 0.5, 0.9)), np.ones(CHOICES_EACH, dtype=np.int64)
    tables = {n_z: (_entries(box, rng, (CHOICES_EACH, n_z, k), share), each) for n_z in sorted({one.dimension for one in spaces})}
    return choices_of(first, spaces, tables, range(len(first)))[0]


def _records(box: Box, rng: Generator, sizes: Sizes) -> Records:
    n, m, p = sizes
    first = _systems(box, rng, (n, m - 1, p), AT_A_TIME)
    nu, samples = int(rng.integers(1, 3)), int(rng.integers(1, 1 + LONGEST))
    driving = _systems(box, rng, (n, nu, p), AT_A_TIME)
    inputs = _of(first, first.A, driving.F, first.C, driving.G)
    u, x0 = (_entries(box, rng, (AT_A_TIME, *shape), rng.choice((0.1, 0.5, 0.9))) for shape in ((samples, nu), (n, 1)))
    each = np.arange(AT_A_TIME)
    return Records(first, each, inputs, each, u, x0)
