"""Many small systems of the same sizes, one a row, and what is found out about all of them together.

    Batch        A (N, n, n), F (N, n, m), C (N, p, n), G (N, p, m): integers over Q, residues over GF(q)
    observed, driven, reached, window     O_s, T_s, [A^(s-1) F, ..., F], [O_s T_s] of every system

The families, with s = 0, ..., n + 1 unless another count is told:

    O      rank O_s                          T   rank T_s                    OT   rank [O_s T_s]
    R      rank [F, ..., A^(s-1) F]          dual OT   rank [O_s T_s] of (A', C', F', G')
    OT without v(0)     rank [O_s T_s] without the columns of v(0)
    [R; T]              one number, rank [R_n; T_n] with R_n = [A^(n-1) F, ..., F]
    det(qI - A)         n + 1 coefficients, ascending (over Q)
    minors of P(q)      the values at q = 0, ..., n of every minor of the size of the normal rank of P (over Q)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...base.errors import InvalidInput
from ...exact.algebra.fields import NumberField
from ...exact.system.systems import ResidualSystem
from . import ranks as names
from .blocks import exactly, transposed
from .elimination import Integers, Overflow, determinants, leading_ranks
from .many import Chosen, Column, Many
from .zeros import choices


@dataclass
class Batch(Many):
    """Systems of the same sizes over Q (`prime` None), GF(prime) or a number field: the matrices are these, over one denominator;
    over a number field of degree d their entries are blocks d x d.
    """

    A: Integers
    F: Integers
    C: Integers
    G: Integers
    prime: int | None = None
    denominator: int = 1
    number_field: NumberField | None = None
    _columns: dict[object, Column] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.A)

    @property
    def n(self) -> int:
        """The number of states."""
        return int(self.A.shape[1]) // self.degree

    @property
    def m(self) -> int:
        """The number of faults."""
        return int(self.F.shape[2]) // self.degree

    @property
    def p(self) -> int:
        """The number of outputs."""
        return int(self.C.shape[1]) // self.degree

    @property
    def sizes(self) -> Mapping[str, tuple[int, int, int]]:
        """The sizes n, m, p of the one system."""
        return {"": (self.n, self.m, self.p)}

    @property
    def own(self) -> Mapping[str, Any]:  # type: ignore[override]
        """A system has no quantities but those of a system."""
        return {}

    def matrix(self, subject: str, name: str) -> Integers:
        """Return A, F, C or G of every system."""
        found: Integers = getattr(self, name)
        return found

    def case(self, index: int) -> ResidualSystem:
        """Return one of the systems."""
        return self.system(index)

    def system(self, index: int) -> ResidualSystem:
        """Return one of the systems, as an exact one."""
        parts = (self.A, self.F, self.C, self.G)
        return ResidualSystem(*(exactly(part[index], self.denominator, self.number_field, self.prime) for part in parts))

    def column(self, key: object, rows: Chosen, find: Callable[[Batch], Integers] | None = None) -> Integers:
        """Return the numbers (len(rows), width) of a family, or of what `find` finds, for the systems of these rows. Raises Overflow."""
        if self.denominator != 1:
            raise Overflow("numbers over a denominator")
        if self.prime is not None and key in (names.CHARACTERISTIC, names.MINORS):
            raise InvalidInput(f"got a question about the unit circle over GF({self.prime}), expected one over Q")
        if self.number_field is not None and key in (names.CHARACTERISTIC, names.MINORS):
            raise Overflow("numbers of a number field")
        return self.kept(key, rows, find or FIND[str(key)])

    def part(self, rows: Chosen) -> Batch:
        """Return the batch of these rows alone, with nothing known of it; the batch itself where these are all."""
        if len(rows) == len(self):
            return self
        return Batch(self.A[rows], self.F[rows], self.C[rows], self.G[rows], self.prime, self.denominator, self.number_field)

    def with_faults(self, rows: Chosen, F: Integers, G: Integers) -> Batch:
        """Return A and C of these rows, each as often as it is named, with other F and G."""
        return Batch(self.A[rows], F, self.C[rows], G, self.prime, self.denominator, self.number_field)

    def transposed(self) -> Batch:
        """Return (A', C', F', G')."""
        A, F, C, G = (transposed(part, self.degree) for part in (self.A, self.C, self.F, self.G))
        return Batch(A, F, C, G, self.prime, self.denominator, self.number_field)


def observed(batch: Batch, s: int) -> Integers:
    """Return O_s of every system."""
    blocks, row = [np.zeros((len(batch), 0, batch.A.shape[1]), dtype=np.int64)], batch.C
    for k in range(s):
        blocks.append(row)
        if k < s - 1:
            row = batch.product(row, batch.A)
    return np.concatenate(blocks, axis=1)


def driven(batch: Batch, s: int) -> Integers:
    """Return T_s of every system."""
    p, m = batch.G.shape[1:]
    built = np.zeros((len(batch), p * s, m * s), dtype=np.int64)
    markov, state = batch.G, batch.F
    for k in range(s):
        for i in range(k, s):
            built[:, i * p : (i + 1) * p, (i - k) * m : (i - k + 1) * m] = markov
        if k < s - 1:
            markov = batch.product(batch.C, state)
            state = batch.product(batch.A, state)
    return built


def reached(batch: Batch, s: int) -> Integers:
    """Return [A^(s-1) F, ..., F] of every system."""
    blocks, column = [np.zeros((len(batch), batch.A.shape[1], 0), dtype=np.int64)], batch.F
    for k in range(s):
        blocks.append(column)
        if k < s - 1:
            column = batch.product(batch.A, column)
    return np.concatenate(blocks[::-1], axis=2)


def window(batch: Batch, s: int) -> Integers:
    """Return [O_s T_s] of every system."""
    return np.concatenate([observed(batch, s), driven(batch, s)], axis=2)


def _by_samples(batch: Batch, built: Integers, height: int) -> Integers:
    """Return the ranks of the first 0, 1, ..., n + 1 block rows of `height` rows."""
    ranks = leading_ranks(built, batch.prime)
    return ranks[:, [height * s * batch.degree for s in range(batch.n + 2)]] // batch.degree


def _window(batch: Batch) -> Integers:
    return _by_samples(batch, window(batch, batch.n + 1), batch.p)


def _later(batch: Batch) -> Integers:
    built = window(batch, batch.n + 1)
    return _by_samples(batch, np.delete(built, np.s_[batch.A.shape[1] : batch.A.shape[1] + batch.G.shape[2]], axis=2), batch.p)


def _silent(batch: Batch) -> Integers:
    built = np.concatenate([driven(batch, batch.n), reached(batch, batch.n)], axis=1)
    return leading_ranks(built, batch.prime)[:, -1:] // batch.degree


def characteristic(matrices: Integers) -> Integers:
    """Return det(qI - M) for integer matrices (N, k, k), ascending: the coefficients are sums of principal minors. Raises Overflow."""
    count, size, _ = matrices.shape
    found = np.zeros((count, size + 1), dtype=np.int64)
    for subset in range(1 << size):
        rows = [i for i in range(size) if subset >> i & 1]
        found[:, size - len(rows)] += (-1) ** len(rows) * determinants(matrices[:, rows][:, :, rows])
    return found


def _minors(batch: Batch) -> Integers:
    """Return the values of the minors of size n + r, r the normal rank; narrower rows are filled up with zeros."""
    n, m, p = batch.n, batch.m, batch.p
    every = np.arange(len(batch))
    table = batch.column(names.DRIVEN, every)
    rank = table[:, n + 1] - table[:, n]
    tables = {int(r): choices(n, m, p, int(r)) for r in np.unique(rank)}
    found = np.zeros((len(batch), max((len(one) for one in tables.values()), default=0) * (n + 1)), dtype=np.int64)
    for r, minors in tables.items():
        rows = np.flatnonzero(rank == r)
        part = batch.part(rows)
        for q in range(n + 1):
            upper = np.concatenate([q * np.eye(n, dtype=np.int64) - part.A, -part.F], axis=2)
            pencil = np.concatenate([upper, np.concatenate([part.C, part.G], axis=2)], axis=1)
            for k, (chosen, columns) in enumerate(minors):
                found[rows, k * (n + 1) + q] = determinants(pencil[:, chosen][:, :, columns])
    return found


FIND: dict[str, Callable[[Batch], Integers]] = {
    names.OBSERVED: lambda batch: _by_samples(batch, observed(batch, batch.n + 1), batch.p),
    names.DRIVEN: lambda batch: _by_samples(batch, driven(batch, batch.n + 1), batch.p),
    names.WINDOW: _window,
    names.REACHED: lambda batch: _by_samples(batch, observed(batch.transposed(), batch.n + 1), batch.m),
    names.DUAL: lambda batch: _window(batch.transposed()),
    names.LATER: _later,
    names.SILENT: _silent,
    names.CHARACTERISTIC: lambda batch: characteristic(batch.A),
    names.MINORS: _minors,
}
