"""This finds the minimal kernel rows modulo a prime of systems whose G has full column rank, by a window without faults.

GenericRows    the rows as tables of residues, ascending by degree, each with the output of its pivot, and a point
generic_rows   of a system over GF(l); None where G has dependent columns, or a degree is above the mean of n over the rows

So it finds those of all systems whose windows have the rank min(p s, n + m s) that their shape allows.

Where p > m, such a window has no dependent column for s large, nor has G. Then v is what m of the outputs say, given x: with these
outputs I, v = G_I^-1 (r_I - C_I x), x(k+1) = A' x + F' r_I where A' = A - F G_I^-1 C_I and F' = F G_I^-1, and the others, less
G_J G_I^-1 r_I, are C' x. So the rows are those of the pair (C', A') with p - m outputs and no fault, in a window of n columns instead of
n + m s. Source: [F75].
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from flint import nmod_mat

from ..system.systems import ResidualSystem
from .modular_rows import pencil_rank_at
from .window_columns import residues

DRAWS = 8  # points that lower the rank of the pencil are zeros, at most n of as many as the prime


@dataclass(frozen=True)
class GenericRows:
    """The row a has degree len(rows[a]) - 1 and p residues a sample; the leading coefficients at the pivots are triangular."""

    rows: tuple[list[list[int]], ...]
    pivots: tuple[int, ...]
    point: int

    @property
    def degrees(self) -> tuple[int, ...]:
        """These are the left minimal indices, ascending."""
        return tuple(len(row) - 1 for row in self.rows)


def generic_rows(system: ResidualSystem) -> GenericRows | None:
    """Return the rows, and a point at which the rank of the pencil leaves no room for more."""
    n, m, p, prime = system.n, system.m, system.p, system.field.p  # type: ignore[union-attr]
    found = _rows(system) if p > m else {}
    if found is None:
        return None
    rng = Random(0)
    for _ in range(DRAWS):
        point = rng.randrange(prime)
        if pencil_rank_at(system, point) == n + p - len(found):
            return GenericRows(tuple(found.values()), tuple(found), point)
    return None


def _rows(system: ResidualSystem) -> dict[int, list[list[int]]] | None:
    """Return the rows by their pivots, p - m of them; None where G has dependent columns or the window is too short."""
    n, m, p, prime = system.n, system.m, system.p, system.field.p  # type: ignore[union-attr]
    A, F, C, G = system.A.flint, system.F.flint, system.C.flint, system.G.flint
    chosen = _independent(G)
    if len(chosen) < m:
        return None
    others = [i for i in range(p) if i not in set(chosen)]
    first, second = _selection(chosen, p, prime), _selection(others, p, prime)
    inverse = (first * G).inv() if m else nmod_mat(0, 0, prime)
    gain, feed = second * G * inverse, F * inverse
    A, C = A - feed * (first * C), second * C - gain * (first * C)
    count, samples = p - m, -(-n // (p - m)) + 1
    ended = dict[int, tuple[int, list[int]]]()
    for vector in _null_vectors(A, C, samples):
        last = max(i for i, x in enumerate(vector) if x)
        mu, j = divmod(last, count)
        if j not in ended or mu < ended[j][0]:
            inverse_of_lead = pow(vector[last], -1, prime)
            ended[j] = mu, [x * inverse_of_lead % prime for x in vector[: count * (mu + 1)]]
    if len(ended) < count:
        return None
    found = dict[int, list[list[int]]]()
    for j, (_, vector) in sorted(ended.items(), key=lambda one: (one[1][0], one[0])):
        state, coefficients = nmod_mat(1, n, prime), []
        for k in reversed(range(0, len(vector), count)):
            y = nmod_mat(1, count, vector[k : k + count], prime)
            coefficients.append(residues(y * second - (y * gain + state * feed) * first)[0])
            state = y * C + state * A
        found[others[j]] = coefficients[::-1]
    return found


def _independent(G: nmod_mat) -> list[int]:
    """Return the first rows of G that are independent."""
    reduced, rank = G.transpose().rref()
    table = residues(reduced)
    return [next(j for j, x in enumerate(row) if x) for row in table[:rank]]


def _selection(chosen: list[int], width: int, prime: int) -> nmod_mat:
    """Return the matrix that picks these rows of a matrix with so many."""
    return nmod_mat(len(chosen), width, [int(j == i) for i in chosen for j in range(width)], prime)


def _null_vectors(A: nmod_mat, C: nmod_mat, samples: int) -> list[list[int]]:
    """Return a basis of the vectors y with y_0 C + y_1 C A + ... = 0, that of the reduced row echelon form."""
    n, count, prime = A.ncols(), C.nrows(), A.modulus()
    width = count * samples
    if not n:
        return [[int(i == j) for j in range(width)] for i in range(width)]
    turned, block, window = A.transpose(), C.transpose(), nmod_mat(n, width, prime)
    for k in range(samples):
        place = nmod_mat(count, width, prime)
        for i in range(count):
            place[i, k * count + i] = 1
        window += block * place
        block = turned * block
    basis, nullity = window.nullspace()
    first = nmod_mat(width, nullity, prime)  # flint pads the basis with columns of zeros
    for j in range(nullity):
        first[j, j] = 1
    return residues((basis * first).transpose())
