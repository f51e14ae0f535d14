"""These are the columns of [O_s T_s] as lists of numbers, put together once from powers of A: what eliminations over windows start from.

window_columns    n + m s columns, each of p s numbers, of flint's integer matrices, or of matrices modulo a prime
residues          the rows of a matrix modulo a prime, or of integers, as lists
null_vectors      a basis of {x : W x = 0} for W modulo a prime, as lists; each ends where a column of W depends on those before it

A matrix of flint is quick to multiply and slow to take apart: what is read here are powers of n columns and a few null vectors, never the
window itself, which is larger by the number of samples.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpz_mat, nmod_mat


def window_columns(A: Any, F: Any, C: Any, G: Any, s: int) -> list[list[Any]]:
    """Return the columns of [O_s T_s], those of x(0) first, of four flint matrices of one kind; residues come as Python's integers."""
    p = C.nrows()
    A, F, state, mark = (part.transpose() for part in (A, F, C, G))
    states, marks = [list[Any]() for _ in range(A.nrows())], [list[Any]() for _ in range(F.nrows())]
    for _ in range(s):
        for blocks, block in ((states, state), (marks, mark)):
            for whole, row in zip(blocks, residues(block), strict=True):
                whole += row
        state, mark = A * state, F * state
    return [*states, *([0] * (p * k) + column[: p * (s - k)] for k in range(s) for column in marks)]


def null_vectors(table: Sequence[Sequence[Any]], width: int, prime: int) -> list[list[int]]:
    """Return a basis of the vectors of that width that are orthogonal to every row of the table modulo the prime.

    The basis is the one that belongs to the reduced row echelon form: beside its last entry a vector is supported on its pivots.
    """
    if not table or not width:
        return [[int(i == j) for j in range(width)] for i in range(width)]
    basis, nullity = nmod_mat(fmpz_mat(table), prime).nullspace()
    if not nullity:
        return []
    first = nmod_mat(width, nullity, prime)  # flint pads the basis with columns of zeros
    for j in range(nullity):
        first[j, j] = 1
    return residues((basis * first).transpose())


def residues(matrix: Any) -> list[list[Any]]:
    """Return the rows, as lists."""
    entries, ncols = matrix.entries(), matrix.ncols()
    if isinstance(matrix, nmod_mat):
        entries = [*map(int, entries)]
    return [entries[i : i + ncols] for i in range(0, len(entries), ncols)] if ncols else [[] for _ in range(matrix.nrows())]
