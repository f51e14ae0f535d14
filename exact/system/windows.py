"""The matrices of a window of s samples, built in full: definitions, and the slow obvious oracle for every fast rank.

observability_matrix   O_s, s block rows C, CA, ..., CA^(s-1)                        ps x n
toeplitz_matrix        T_s, G on the diagonal, C A^(i-j-1) F below                    ps x ms
window_matrix          [O_s T_s], from (x(0), v(0), ..., v(s-1)) to the samples        ps x (n + ms)
reachability_matrix    [F, AF, ..., A^(n-1) F]                                         n x nm
rank_of_every_window   ranks for s = 1..windows from the built matrices: compare with zero_output, never use at size
"""

from __future__ import annotations

from ..algebra.matrices import Matrix, beside, rank, stacked
from .systems import ResidualSystem


def observability_matrix(system: ResidualSystem, s: int) -> Matrix:
    """O_s, ps x n."""
    blocks = [Matrix.zero(system.field, 0, system.n)]
    row = system.C
    for _ in range(s):
        blocks.append(row)
        row = row @ system.A
    return stacked(*blocks)


def toeplitz_matrix(system: ResidualSystem, s: int) -> Matrix:
    """T_s, ps x ms: the response to the fault from rest."""
    markov = [system.G]
    state = system.F
    for _ in range(1, s):
        markov.append(system.C @ state)
        state = system.A @ state
    nothing = Matrix.zero(system.field, system.p, system.m)
    rows = [beside(*(markov[i - j] if j <= i else nothing for j in range(s))) for i in range(s)]
    return stacked(Matrix.zero(system.field, 0, system.m * s), *rows)


def window_matrix(system: ResidualSystem, s: int) -> Matrix:
    """[O_s T_s], ps x (n + ms): its column space is the restricted behaviour on s samples."""
    return beside(observability_matrix(system, s), toeplitz_matrix(system, s))


def reachability_matrix(system: ResidualSystem) -> Matrix:
    """[F, AF, ..., A^(n-1) F], n x nm."""
    blocks = [Matrix.zero(system.field, system.n, 0)]
    column = system.F
    for _ in range(system.n):
        blocks.append(column)
        column = system.A @ column
    return beside(*blocks)


def rank_of_every_window(system: ResidualSystem, windows: int) -> tuple[int, ...]:
    """rank [O_s T_s] for s = 1..windows by elimination of each built matrix."""
    return tuple(rank(window_matrix(system, s)) for s in range(1, windows + 1))
