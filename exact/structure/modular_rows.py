"""This finds the minimal kernel rows of a system over GF(l), l large, by one elimination: their shape is that of the exact rows.

ModularRows    normal rank, leads, the rows as tables of residues, and the point that shows that there are no more
rows_modulo    of a system over a prime field; None where the field has too few points

The dependent rows (k, i) of [O_s T_s] are read off its null space; the first of each output i is a lead. There are never more leads than
p - r, r the normal rank, and p - r of them at s = n + 1. The rank of [[A - qI, F], [C, G]] at a point q is n + r at most. So where it is
n + p less the number of leads, both are what they can be, and the rows are all; windows a little longer than the lag are enough. Source:
[F75].
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from flint import fmpz_mat, nmod_mat

from ..system.systems import ResidualSystem
from .window_columns import null_vectors, residues, window_columns

Lead = tuple[int, int]


@dataclass(frozen=True)
class ModularRows:
    """These are the rows of a minimal basis, ascending by (degree mu, output) of their leads; each has mu + 1 lists of p residues."""

    normal_rank: int
    leads: tuple[Lead, ...]
    rows: tuple[list[list[int]], ...]
    point: int


def rows_modulo(system: ResidualSystem) -> ModularRows | None:
    """Return the rows of a minimal basis over GF(l). None where every point that was tried lowers the rank of the pencil.

    That needs l to be about n: of the points of a larger field at most n, the zeros, do so.
    """
    n, p, prime = system.n, system.p, system.field.p  # type: ignore[union-attr]
    rng, found = Random(0), dict[Lead, list[list[int]]]()
    point = rng.randrange(prime)
    rank = pencil_rank_at(system, point)
    count = n + p - rank  # of the rows, but where the point is a zero
    enough = min(n + 1, n // max(count, 1) + 2)  # where their degrees are as equal as they can be
    s = enough // 2 + 1
    while count and len(found := _leads(system, s)) != count and s <= n:
        s = enough if s < enough else min(n + 1, s + s // 2)
    for _ in range(n + 8):
        if rank == n + p - len(found):
            leads = sorted(found)
            return ModularRows(p - len(leads), tuple(leads), tuple(found[lead] for lead in leads), point)
        point = rng.randrange(prime)
        rank = pencil_rank_at(system, point)
    return None


def pencil_rank_at(system: ResidualSystem, point: int) -> int:
    """Return the rank of [[A - qI, F], [C, G]] at a point q, over a prime field."""
    A, F, C, G = (residues(block.flint) for block in (system.A, system.F, system.C, system.G))
    for i, row in enumerate(A):
        row[i] -= point
    table = [x for left, right in ((A, F), (C, G)) for row, more in zip(left, right, strict=True) for x in (*row, *more)]
    return int(nmod_mat(fmpz_mat(system.n + system.p, system.n + system.m, table), system.field.p).rank())  # type: ignore[union-attr]


def _leads(system: ResidualSystem, s: int) -> dict[Lead, list[list[int]]]:
    """Return (mu, output) of every output that depends on earlier ones from sample mu on, mu < s, and the row that says how."""
    p, prime = system.p, system.field.p  # type: ignore[union-attr]
    columns = window_columns(system.A.flint, system.F.flint, system.C.flint, system.G.flint, s)
    found = dict[Lead, list[list[int]]]()
    ended = sorted((max(i for i, x in enumerate(vector) if x), vector) for vector in null_vectors(columns, p * s, prime))
    outputs = set[int]()
    for last, vector in ended:
        mu, output = divmod(last, p)
        if output not in outputs:
            outputs.add(output)
            inverse = pow(vector[last], -1, prime)
            row = [x * inverse % prime for x in vector[: p * (mu + 1)]]
            found[mu, output] = [row[k : k + p] for k in range(0, len(row), p)]
    return found
