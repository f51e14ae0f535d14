"""What claims about a record can speak of: a system with inputs, driven by a finite u from x0 without a fault. Source: [WRMM05].

    OF_A_RECORD     the quantities of a record, by their names
    Records         many records of the same lengths at once
    INPUT, OUTPUT, BOTH, STATE      the families: ranks of the Hankel matrices of u, y, [u; y], and of [X; U_k], each with its k

A Hankel matrix with k block rows has N - k + 1 columns, k = 0, ..., N; beyond N it has none, and its rank is 0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ...exact.algebra.matrices import Matrix, beside, rank, stacked
from ...exact.structure.signals import excitation_matrix, hankel
from ...exact.system.systems import FaultySystem, ResidualSystem
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from .batches import Batch
from .blocks import exactly, transposed
from .cases import Record, RecordSubject
from .elimination import Integers, leading_ranks
from .many import Both, Chosen, Column
from .registry import Kind, Quantity

INPUT, OUTPUT, BOTH, STATE = "Hankel of u", "Hankel of y", "Hankel of [u; y]", "[X; U]"


@dataclass
class Records(Both):
    """Many records: `first` has the systems (A, F, C, G), `second` those of the inputs, (A, B, C, D); u[i] is (N, nu), x0[i] (n, 1)."""

    called: ClassVar[tuple[str, str]] = ("", "inputs")
    first: Batch
    firsts: Chosen
    second: Batch
    seconds: Chosen
    u: Integers
    x0: Integers
    _columns: dict[object, Column] = field(default_factory=dict)

    @property
    def own(self) -> Mapping[str, Any]:  # type: ignore[override]
        """The quantities of a record."""
        return OF_A_RECORD

    @property
    def samples(self) -> int:
        """The number of samples."""
        return int(self.u.shape[1]) // self.degree

    def case(self, index: int) -> Record:
        """Return one of the records."""
        system, inputs = self.first.system(int(self.firsts[index])), self.second.system(int(self.seconds[index]))
        u, x0 = (exactly(part[index], self.denominator, self.number_field, self.prime) for part in (self.u, self.x0))
        return Record(FaultySystem(system, inputs.F, inputs.G), u, x0)

    def matrix(self, subject: str, name: str) -> Integers:
        """Return A, F, C or G of one of the two systems, B, D, u or x0."""
        if subject or name in ("B", "D"):
            return self.second.matrix("", {"B": "F", "D": "G"}.get(name, name))[self.seconds]
        if name in ("u", "x0"):
            return self.u if name == "u" else self.x0
        return self.first.matrix("", name)[self.firsts]

    def part(self, rows: Chosen) -> Records:
        """Return the records of these rows; what is known of the systems stays known."""
        return Records(self.first, self.firsts[rows], self.second, self.seconds[rows], self.u[rows], self.x0[rows])

    def column(self, key: Any, rows: Chosen, find: Callable[[Any], Integers] | None = None) -> Integers:
        """Return the numbers of a family of one of the systems, of the data, or of what `find` finds. Raises Overflow."""
        if find is not None:
            return self.kept(key, rows, find)
        if isinstance(key, tuple) and key[0] in DATA:
            family, k = key
            return self.kept(key, rows, lambda part: leading_ranks(DATA[family](part, k), part.prime)[:, -1:] // part.degree)
        return self.of_system(key, rows)

    @property
    def inputs_in_time(self) -> Integers:
        """u(0), ..., u(N - 1) as columns (cases, N, nu d, d)."""
        d = self.degree
        columns = [transposed(self.u[:, t * d : (t + 1) * d], d) for t in range(self.samples)]
        return np.stack(columns, axis=1) if columns else np.zeros((len(self), 0, self.u.shape[2], d), dtype=np.int64)

    def trajectory(self) -> tuple[Integers, Integers]:
        """Return the states x(0), ..., x(N) as columns (cases, N + 1, n d, d), and outputs (cases, N, p d, d). Raises Overflow."""
        A, B, C, D = (self.second.matrix("", name)[self.seconds] for name in "AFCG")
        state, states, outputs = self.x0, [self.x0], []
        for u in np.moveaxis(self.inputs_in_time, 1, 0):
            outputs.append(self.sum(self.product(C, state), self.product(D, u)))
            state = self.sum(self.product(A, state), self.product(B, u))
            states.append(state)
        empty = np.zeros((len(self), 0, C.shape[1], self.degree), dtype=np.int64)
        return np.stack(states, axis=1), np.stack(outputs, axis=1) if outputs else empty

    def sum(self, left: Integers, right: Integers) -> Integers:
        """Return the sum, reduced over GF(prime); products that fit have sums that do."""
        return left + right if self.prime is None else (left + right) % self.prime


def _hankel(signal: Integers, k: int) -> Integers:
    """Return the Hankel matrices (cases, q k d, (N - k + 1) d) of signals of columns (cases, N, q d, d)."""
    count, samples, _, d = signal.shape
    columns = samples - k + 1
    blocks = [_side_by_side(signal[:, i : i + columns]) for i in range(k)]
    return np.concatenate([np.zeros((count, 0, columns * d), dtype=np.int64), *blocks], axis=1)


def _side_by_side(columns: Integers) -> Integers:
    """Return the matrices (cases, q d, N d) of these columns (cases, N, q d, d)."""
    count, samples, height, d = columns.shape
    return np.swapaxes(columns, 1, 2).reshape(count, height, samples * d)


def _of_state(records: Records, k: int) -> Integers:
    states = records.trajectory()[0][:, : records.samples - k + 1]
    return np.concatenate([_side_by_side(states), _hankel(records.inputs_in_time, k)], axis=1)


DATA: dict[str, Callable[[Records, int], Integers]] = {
    INPUT: lambda records, k: _hankel(records.inputs_in_time, k),
    OUTPUT: lambda records, k: _hankel(records.trajectory()[1], k),
    BOTH: lambda records, k: _hankel(np.concatenate([records.inputs_in_time, records.trajectory()[1]], axis=2), k),
    STATE: _of_state,
}


def _input_alone(record: RecordSubject) -> tuple[ResidualSystem, Matrix]:
    """Return the system without states and with the feedthrough I, of which u is the output."""
    field, nu = record.u.field, record.u.ncols
    parts = Matrix.zero(field, 0, 0), Matrix.zero(field, 0, nu), Matrix.zero(field, nu, 0), Matrix.identity(field, nu)
    return ResidualSystem(*parts), Matrix.zero(field, 0, 1)


def _both(record: RecordSubject) -> tuple[ResidualSystem, Matrix]:
    """Return (A, B, [0; C], [I; D]), of which [u; y] is the output."""
    one = record.inputs.system
    C = stacked(Matrix.zero(one.field, one.m, one.n), one.C)
    return ResidualSystem(one.A, one.F, C, stacked(Matrix.identity(one.field, one.m), one.G)), record.x0


def _itself(record: RecordSubject) -> tuple[ResidualSystem, Matrix]:
    return record.inputs.system, record.x0


def _data_rank(
    name: str,
    meaning: str,
    family: str,
    built: Callable[[RecordSubject, int], Matrix],
    shown: Callable[[RecordSubject], tuple[ResidualSystem, Matrix]],
    kind: str = "residual-hankel",
) -> Quantity:
    """Return the rank of a matrix of data, 0 beyond N; the certificate says it of a system, from its initial state, driven by u."""

    def borne(record: RecordSubject, k: int) -> list[Certificate]:
        return [make.data_rank(kind, *shown(record), record.u, k)] if k <= record.u.nrows else []

    return Quantity(
        name,
        Kind.INTEGER,
        f"{meaning}; 0 beyond N",
        lambda x, k: rank(built(x, k)) if k <= x.u.nrows else 0,
        lambda r, k: r.table((family, k))[0] if k <= r.samples else 0,
        borne,
        windowed=True,
    )


def _y(record: RecordSubject) -> Matrix:
    return record.trajectory.residuals


_U = _data_rank("u_rank", "the rank of the Hankel matrix of u with s block rows", INPUT, lambda x, k: hankel(x.u, k), _input_alone)
_LISTED = (
    Quantity("N", Kind.INTEGER, "the number of samples", lambda x: x.u.nrows, lambda r: r.samples, lambda x: []),
    Quantity("nu", Kind.INTEGER, "the number of inputs", lambda x: x.u.ncols, lambda r: r.sizes["inputs"][1], lambda x: []),
    _U,
    _data_rank("y_rank", "the rank of the Hankel matrix of y with s block rows", OUTPUT, lambda x, k: hankel(_y(x), k), _itself),
    _data_rank(
        "w_rank", "the rank of the Hankel matrix of [u; y] with s block rows", BOTH, lambda x, k: hankel(beside(x.u, _y(x)), k), _both
    ),
    _data_rank(
        "x_rank",
        "the rank of [X; U_s], X = [x(0), ..., x(N - s)]",
        STATE,
        lambda x, k: excitation_matrix(x.trajectory, k),
        _itself,
        "excitation",
    ),
    Quantity(
        "exciting",
        Kind.WORD,
        "u is persistently exciting of order s: u_rank(s) = nu s, and s <= N",
        lambda x, k: k <= x.u.nrows and _U.exact(x, k) == x.u.ncols * k,
        lambda r, k: k <= r.samples and _U.from_ranks(r, k) == r.sizes["inputs"][1] * k,
        _U.certificates,
        windowed=True,
    ),
)
OF_A_RECORD = {one.name: one for one in _LISTED}
