"""This finds the minimal kernel rows of a system over GF(l), l large, by one elimination: their shape is that of the exact rows.

ModularRows      leads, coefficients N_k and states X_k of all rows as matrices, and the point that shows that there are no more
rows_modulo      of a system over a prime field; None where the field has too few points
Reduced          the system without the faults that outputs tell
states_of        the states X_1, X_2, ... of rows, by Horner's recursion
placed           matrices one above the other, or side by side
pencil_rank_at   rank [[A - qI, F], [C, G]] at a point

Faults that outputs tell are eliminated first. Let the rows I of G be the first g that are independent, and the columns J such that G_IJ is
invertible; the other rows are G_O = L G_I. Then v_J is what r_I, x and the other faults w say, and x(k+1) = A' x + F' w + ... r_I, and
r_O - L r_I = C' x, without feedthrough: a system with p - g outputs, whose rows are those of the first one in a window of n columns where
w is nowhere seen, else of n + (m - g) s. A row N has N_O = y, N_I = -(y L + X F_J G_IJ^-1), and the states X of y.

The rows of [O_s T_s] that depend on earlier ones are read off its null space; the first of each output is a lead. There are never more
leads than p - r, r the normal rank, and p - r of them at s = n + 1. The rank of [[A - qI, F], [C, G]] at a point q is n + r at most, and
n + g at infinity. So where it is n + p less the number of leads, both are what they can be, and the rows are all; windows a little longer
than the lag are enough. Source: [F75].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random
from typing import Literal

from flint import fmpz_mat, nmod_mat

from ..system.systems import ResidualSystem
from .window_columns import residues, window_columns

Lead = tuple[int, int]
Point = int | Literal["infinity"]
DRAWS = 8  # points that lower the rank of the pencil are zeros, at most n of as many as the prime


@dataclass(frozen=True)
class Reduced:
    """(A, F, C) without feedthrough, and what the rows of it lack: `chosen` outputs I, `others` O, `used` faults J, and G_IJ^-1.

    `mixing` is L, `feed` F_J G_IJ^-1 (n x g).
    """

    A: nmod_mat
    F: nmod_mat
    C: nmod_mat
    chosen: tuple[int, ...]
    others: tuple[int, ...]
    used: tuple[int, ...]
    inverse: nmod_mat
    mixing: nmod_mat
    feed: nmod_mat


@dataclass(frozen=True)
class ModularRows:
    """The rows of a minimal basis, ascending by (degree mu, output) of their leads, k of them.

    `coefficients` are N_0, N_1, ... (k x p), `states` X_1, X_2, ... (k x n), the last of which is zero, `reduced` is the system in which
    they were found, and `point` is infinity where the normal rank is that of G.
    """

    leads: tuple[Lead, ...]
    coefficients: tuple[nmod_mat, ...]
    states: tuple[nmod_mat, ...]
    reduced: Reduced
    point: Point

    @property
    def degrees(self) -> tuple[int, ...]:
        """The left minimal indices, ascending."""
        return tuple(mu for mu, _ in self.leads)

    @property
    def pivots(self) -> tuple[int, ...]:
        """The outputs of the leads, at which the leading coefficients are triangular."""
        return tuple(output for _, output in self.leads)

    @cached_property
    def rows(self) -> tuple[list[list[int]], ...]:
        """Each row has mu + 1 lists of p residues."""
        tables = [residues(coefficient) for coefficient in self.coefficients]
        return tuple([table[a] for table in tables[: mu + 1]] for a, (mu, _) in enumerate(self.leads))


def rows_modulo(system: ResidualSystem) -> ModularRows | None:
    """Return the rows of a minimal basis over GF(l). None where every point that was tried lowers the rank of the pencil.

    That needs l to be about n: of the points of a larger field at most n, the zeros, do so.
    """
    n, p, reduced = system.n, system.p, reduced_system(system)
    count = len(reduced.others)
    if not reduced.C * reduced.F:
        rows = _rows(system, reduced, _found(reduced, count, seen=False), "infinity")
        if len(rows.leads) == count and not any(state * reduced.F for state in rows.states):
            return rows
    rng, prime = Random(0), system.field.p  # type: ignore[union-attr]
    point = rng.randrange(prime)
    rank = pencil_rank_at(system, point)
    found = _found(reduced, n + p - rank, seen=True)
    for _ in range(n + DRAWS):
        if rank == n + p - len(found):
            return _rows(system, reduced, found, point)
        point = rng.randrange(prime)
        rank = pencil_rank_at(system, point)
    return None


def reduced_system(system: ResidualSystem) -> Reduced:
    """Return the system over a prime field without the faults that outputs tell."""
    m, p, prime = system.m, system.p, system.field.p  # type: ignore[union-attr]
    A, F, C, G = system.A.flint, system.F.flint, system.C.flint, system.G.flint
    chosen = _pivots(G.transpose())
    others, first = [i for i in range(p) if i not in chosen], selection(chosen, p, prime)
    used = _pivots(first * G)
    free, last = [j for j in range(m) if j not in used], selection(used, m, prime).transpose()
    rest, second = selection(free, m, prime).transpose(), selection(others, p, prime)
    told = first * G
    inverse = (told * last).inv() if used else nmod_mat(0, 0, prime)
    feed, mixing, seen = F * last * inverse, second * G * last * inverse, first * C
    parts = A - feed * seen, F * rest - feed * (told * rest), second * C - mixing * seen
    return Reduced(*parts, tuple(chosen), tuple(others), tuple(used), inverse, mixing, feed)


def states_of(A: nmod_mat, C: nmod_mat, coefficients: Sequence[nmod_mat], count: int) -> tuple[list[nmod_mat], nmod_mat]:
    """Return X_1, X_2, ... of so many rows N, where X_k = N_k C + X_(k+1) A, and X_0."""
    state, found = nmod_mat(count, A.nrows(), A.modulus()), list[nmod_mat]()
    for coefficient in reversed(coefficients):
        found.append(state)
        state = coefficient * C + state * A
    return found[::-1], state


def placed(parts: Sequence[nmod_mat], ncols: int, prime: int) -> nmod_mat:
    """Return the matrices with so many columns, one above the other. It takes products, since flint's entries are slow to read."""
    height, start = sum(part.nrows() for part in parts), 0
    whole = nmod_mat(height, ncols, prime)
    for part in parts:
        place = nmod_mat(height, part.nrows(), prime)
        for i in range(part.nrows()):
            place[start + i, i] = 1
        whole, start = whole + place * part, start + part.nrows()
    return whole


def pencil_rank_at(system: ResidualSystem, point: Point) -> int:
    """Return the rank of [[A - qI, F], [C, G]] at a point q, over a prime field; at infinity that of [[I, 0], [0, G]]."""
    A, F, C, G = (block.flint for block in (system.A, system.F, system.C, system.G))
    if point == "infinity":
        return system.n + int(G.rank())
    shifted = nmod_mat(A)
    for i in range(system.n):
        shifted[i, i] -= point
    if shifted.rank() == system.n:  # no eigenvalue: what is left is the transfer function there
        return system.n + int((G - C * shifted.solve(F)).rank() if system.n and system.m else G.rank())
    blocks = ((shifted, F), (C, G))
    rows = [[*left, *right] for pair in blocks for left, right in zip(*map(residues, pair), strict=True)]
    table = fmpz_mat(system.n + system.p, system.n + system.m, [x for row in rows for x in row])
    return int(nmod_mat(table, system.field.p).rank())  # type: ignore[union-attr]


# -- parts -------------------------------------------------------------------------------------------------------------


def _found(reduced: Reduced, wanted: int, *, seen: bool) -> dict[Lead, list[list[int]]]:
    """Return (mu, place in `others`) of every output that depends on earlier ones, and the row that says how, once so many are found.

    Where the faults that are left are not `seen`, their columns are zero. What is found at n + 1 samples is returned in any case.
    """
    n, found = reduced.A.nrows(), dict[Lead, list[list[int]]]()
    s = min(n + 1, n // max(wanted, 1) + 2)  # enough where their degrees are as equal as they can be
    while wanted and len(found := _leads(reduced, s, seen=seen)) != wanted and s <= n:
        s = min(n + 1, s + s // 2)
    return found


def _leads(reduced: Reduced, s: int, *, seen: bool) -> dict[Lead, list[list[int]]]:
    count, found, outputs = len(reduced.others), dict[Lead, list[list[int]]](), set[int]()
    for row in _null_rows(_turned_window(reduced, s, seen=seen), count):
        last = max(i for i, x in enumerate(row) if x)
        mu, j = divmod(last, count)
        if j not in outputs:
            outputs.add(j)
            found[mu, j] = [row[k : k + count] for k in range(0, count * (mu + 1), count)]
            if len(outputs) == count:
                break
    return found


def _turned_window(reduced: Reduced, s: int, *, seen: bool) -> nmod_mat:
    """Return the transpose of [O_s T_s], or of O_s alone."""
    n, count, prime = reduced.A.nrows(), len(reduced.others), reduced.A.modulus()
    if seen:
        columns = window_columns(reduced.A, reduced.F, reduced.C, nmod_mat(count, reduced.F.ncols(), prime), s)
        return nmod_mat(fmpz_mat(len(columns), count * s, [x for column in columns for x in column]), prime)
    block, blocks = reduced.C, list[nmod_mat]()
    for _ in range(s):
        blocks.append(block)
        block = block * reduced.A
    return placed(blocks, n, prime).transpose()


def _null_rows(matrix: nmod_mat, at_once: int) -> Iterator[list[int]]:
    """Yield the basis of the columns x with matrix x = 0 in which each ends, with 1, where the others are zero; ascending by where that is.

    So many are taken apart at a time, for that is slow, and few are needed.
    """
    basis = null_space(matrix)
    for start in range(0, basis.nrows(), at_once):
        some = range(start, min(start + at_once, basis.nrows()))
        yield from residues(selection(some, basis.nrows(), matrix.modulus()) * basis)


def null_space(matrix: nmod_mat) -> nmod_mat:
    """Return the same basis as the rows of a matrix."""
    basis, nullity = matrix.nullspace()  # flint pads the basis with columns of zeros
    return selection(range(nullity), matrix.ncols(), matrix.modulus()) * basis.transpose()


def _rows(system: ResidualSystem, reduced: Reduced, found: dict[Lead, list[list[int]]], point: Point) -> ModularRows:
    """Return what rows of the reduced system are for the system itself."""
    leads, count, prime = sorted(found), len(reduced.others), reduced.A.modulus()
    height, blank, longest = len(leads), [0] * count, max((mu + 1 for mu, _ in leads), default=0)
    tables = [found[lead] for lead in leads]
    own = [nmod_mat(height, count, [x for row in tables for x in (row[k] if k < len(row) else blank)], prime) for k in range(longest)]
    states, _ = states_of(reduced.A, reduced.C, own, height)
    first, second = selection(reduced.chosen, system.p, prime), selection(reduced.others, system.p, prime)
    coefficients = [y * second - (y * reduced.mixing + state * reduced.feed) * first for y, state in zip(own, states, strict=True)]
    named = tuple((mu, reduced.others[j]) for mu, j in leads)
    return ModularRows(named, tuple(coefficients), tuple(states), reduced, point)


def _pivots(matrix: nmod_mat) -> list[int]:
    """Return the columns that are independent of those before them."""
    echelon, rank = matrix.rref()
    return [next(j for j, x in enumerate(row) if x) for row in residues(echelon)[:rank]]


def selection(chosen: Sequence[int], width: int, prime: int) -> nmod_mat:
    """Return the matrix that picks these rows of a matrix with so many."""
    picking = nmod_mat(len(chosen), width, prime)
    for i, j in enumerate(chosen):
        picking[i, j] = 1
    return picking
