"""The matrices of a window of s samples, block by block from their definitions.

observability(system, s)    O_s: C, CA, ..., CA^(s-1)
toeplitz(system, s)         T_s: s x s blocks, G on the diagonal, C A^(i-j-1) F below
window_matrix(system, s)    [O_s T_s]
reachability(system)        [F, AF, ..., A^(n-1) F]
window_rank, toeplitz_rank  their ranks; rank [O_0 T_0] = rank T_0 = 0
gap(system, k)              rank [O_(k+1) T_(k+1)] - rank [O_k T_k]
hankel(blocks, s)           block Hankel matrix with s block rows of a list of columns
"""

from __future__ import annotations

from collections.abc import Sequence

from .fields import Field
from .linear import Matrix, above, beside, identity, rank, zeros
from .systems import System


def power(a: Matrix, k: int) -> Matrix:
    """The result is the k-th power of a."""
    result = identity(a.field, a.height)
    for _ in range(k):
        result = a @ result
    return result


def observability(system: System, s: int) -> Matrix:
    """The result is O_s, (p s) x n."""
    blocks = [zeros(system.field, 0, system.n)]
    row = system.C
    for _ in range(s):
        blocks.append(row)
        row = row @ system.A
    return above(*blocks)


def reachability(system: System) -> Matrix:
    """The result is [F, AF, ..., A^(n-1) F], n x (n m)."""
    blocks = [zeros(system.field, system.n, 0)]
    for k in range(system.n):
        blocks.append(power(system.A, k) @ system.F)
    return beside(*blocks)


def toeplitz(system: System, s: int) -> Matrix:
    """The result is T_s, (p s) x (m s)."""
    markov = [system.G]
    column = system.F
    for _ in range(1, s):
        markov.append(system.C @ column)
        column = system.A @ column
    blank = zeros(system.field, system.p, system.m)
    block_rows = [zeros(system.field, 0, system.m * s)]
    for i in range(s):
        block_rows.append(beside(*(markov[i - j] if j <= i else blank for j in range(s))))
    return above(*block_rows)


def window_matrix(system: System, s: int) -> Matrix:
    """The result is [O_s T_s], (p s) x (n + m s)."""
    return beside(observability(system, s), toeplitz(system, s))


def window_rank(system: System, s: int) -> int:
    """The result is rank [O_s T_s]."""
    return rank(window_matrix(system, s))


def toeplitz_rank(system: System, s: int) -> int:
    """The result is rank T_s."""
    return rank(toeplitz(system, s))


def gap(system: System, k: int) -> int:
    """The result is rank [O_(k+1) T_(k+1)] - rank [O_k T_k]."""
    return window_rank(system, k + 1) - window_rank(system, k)


def hankel(field: Field, blocks: Sequence[Matrix], block_height: int, s: int) -> Matrix:
    """The result is the block Hankel matrix of N columns with s block rows: column k = 0..N-s holds blocks k..k+s-1."""
    columns = [zeros(field, block_height * s, 0)]
    for k in range(len(blocks) - s + 1):
        columns.append(above(zeros(field, 0, 1), *blocks[k : k + s]))
    return beside(*columns)
