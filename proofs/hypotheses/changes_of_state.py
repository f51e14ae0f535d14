"""Changes of the state x = T x' between two systems: where there is one that takes (A', C') to (A, C), and one that takes columns into Z.

    similarity        T with A T = T A' and C T = C', invertible; None where (A', C') is not similar to (A, C)
    columns_moved     T, invertible, such that a kernel row of the first sees T x' as it sees x' of the second
    moved             a system with T x' as its state
    equivalent_pairs  two systems with the same outputs and as many states, (A, C) not the same, made on purpose

Why columns_moved is there for every two systems with the same outputs and as many states: a row N(q) of the kernel representation asks of a
column [f; g] that X_(k+1) f + N_k g = 0 for each k, X_(k+1) made of N, A and C. Stacked, the X of the first are a matrix of full row rank,
sum eta, since no nonzero u outside a space of dimension n - sum eta has [u; 0] in Z; the X' of the second, made of the same N, have the
same rank. So X T = X' for some invertible T, and X T F' = X' F' = -N G'.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import product
from random import Random

from ...exact.algebra.fields import PrimeField
from ...exact.algebra.matrices import Matrix, beside, rank, right_null_space, solve_left, stacked
from ...exact.structure.fault_columns import with_pair
from ...exact.structure.kernel_rows import column_conditions
from ...exact.system.systems import ResidualSystem
from ..evidence.subjects import kernel_once, space_once


@lru_cache(maxsize=1 << 13)  # here and below: the same pairs are come upon for each hypothesis that is dropped
def similarity(first: ResidualSystem, second: ResidualSystem) -> Matrix | None:
    """Return T (n x n) with A T = T A' and C T = C', invertible; None where there is none.

    The solutions T_0 + sum t_i K_i of these linear equations have a determinant of degree at most n in the t_i: over Q and Q(a) it vanishes
    identically iff it does so for all natural t_i of sum at most n; over a prime field all t are tried.
    """
    n, field = first.n, first.field
    if second.n != n:
        return None
    unit = Matrix.identity(field, n)
    # vec by rows: (A T - T A') and C T are linear in T
    commute = _kronecker(first.A, unit) - _kronecker(unit, second.A.transposed())
    equations = stacked(commute, _kronecker(first.C, unit))
    wanted = stacked(Matrix.zero(field, n * n, 1), _by_rows(second.C))
    particular = _solution(equations, wanted)
    if particular is None:
        return None
    kernel = right_null_space(equations)
    free = kernel.ncols
    points = product(range(field.p), repeat=free) if isinstance(field, PrimeField) else _of_sum_at_most(n, free)
    for point in points:
        weights = Matrix.of([[t] for t in point], field, shape=(free, 1))
        T = _square(particular + kernel @ weights, n)
        if rank(T) == n:
            return T
    return None


@lru_cache(maxsize=1 << 13)
def columns_moved(first: ResidualSystem, second: ResidualSystem) -> Matrix | None:
    """Return T (n x n), invertible, with X T = X'; None where the two ranks differ, which they do not where the outputs are the same."""
    if first.n != second.n:
        return None
    rows = kernel_once(first).rows
    seen, seen_by_second = (
        stacked(Matrix.zero(s.field, 0, s.n), *(column_conditions(row.coefficients, s.A, s.C).columns(range(s.n)) for row in rows))
        for s in (first, second)
    )
    kernels = right_null_space(seen), right_null_space(seen_by_second)
    if kernels[0].ncols != kernels[1].ncols:
        return None
    # T takes the second's kernel to the first's, and x' to any x that the first sees in the same way.
    lifted = _solution(seen, seen_by_second)
    if lifted is None:
        return None
    complement = _complement(kernels[1])
    target = beside(kernels[0], lifted @ complement)
    inverse = solve_left(beside(kernels[1], complement), Matrix.identity(first.field, first.n))
    return None if inverse is None or rank(target) < first.n else target @ inverse


def moved(system: ResidualSystem, T: Matrix) -> ResidualSystem:
    """Return the system with T x as its state: (T A T^-1, T F, C T^-1, G)."""
    inverse = solve_left(T, Matrix.identity(system.field, system.n))
    if inverse is None:
        raise ArithmeticError("a change of the state is not invertible")
    return ResidualSystem(T @ system.A @ inverse, T @ system.F, system.C @ inverse, system.G)


def equivalent_pairs(count: int) -> Iterator[tuple[ResidualSystem, ResidualSystem]]:
    """`count` pairs over Q: a system with hidden states, and one with other hidden states, fed back into the fault, in another basis.

    In every third pair the second is the first with other fault columns of Z, in another basis, which most often has the same outputs.
    Three of four have a small A and a small feedback, and so are mostly stable.
    """
    random = Random("equivalent pairs")
    for i in range(count):
        n, m = random.randint(1, 2), random.randint(1, 2)
        p, hidden = random.randint(m + 1, 3), random.randint(0, 2)
        scale = 1 if i % 4 == 0 else 8
        F, C, G = (_entries(random, *shape) for shape in ((n, m), (p, n), (p, m)))
        A = _entries(random, n, n, scale)
        if random.random() < 0.5:
            G = Matrix.of([[0] * m for _ in range(p)])
        first = _dressed(random, ResidualSystem(A, F, C, G), hidden, scale)
        if i % 3:
            yield first, _dressed(random, ResidualSystem(A, F, C, G), hidden, scale)
        else:
            space = space_once(first)
            yield first, moved(with_pair(space, _entries(random, space.dimension, m)), _invertible(random, n + hidden))


def _dressed(random: Random, bare: ResidualSystem, hidden: int, scale: int) -> ResidualSystem:
    n, m, p = bare.n, bare.m, bare.p
    below = beside(_entries(random, hidden, n, scale), _entries(random, hidden, hidden, scale))
    A = stacked(beside(bare.A, Matrix.zero(bare.field, n, hidden)), below)
    F = stacked(bare.F, _entries(random, hidden, m))
    C = beside(bare.C, Matrix.zero(bare.field, p, hidden))
    K = _entries(random, m, n + hidden, scale)
    return moved(ResidualSystem(A + F @ K, F, C + bare.G @ K, bare.G), _invertible(random, n + hidden))


def _invertible(random: Random, size: int) -> Matrix:
    T = _entries(random, size, size)
    while rank(T) < size:
        T = _entries(random, size, size)
    return T


def _entries(random: Random, nrows: int, ncols: int, scale: int = 1) -> Matrix:
    rows = [[Fraction(random.choice((-2, -1, 0, 0, 1, 1, 2)), scale) for _ in range(ncols)] for _ in range(nrows)]
    return Matrix.of([[str(x) for x in row] for row in rows], shape=(nrows, ncols))


def _solution(matrix: Matrix, right_side: Matrix) -> Matrix | None:
    """Return some X with M X = R, or None where there is none."""
    found = solve_left(matrix.transposed(), right_side.transposed())
    return None if found is None else found.transposed()


def _kronecker(left: Matrix, right: Matrix) -> Matrix:
    one, two = left.elements(), right.elements()
    rows = [[a * b for a in row for b in other] for row in one for other in two]
    return Matrix.from_elements(left.field, left.nrows * right.nrows, left.ncols * right.ncols, rows)


def _by_rows(matrix: Matrix) -> Matrix:
    return Matrix.from_elements(matrix.field, matrix.nrows * matrix.ncols, 1, [[x] for row in matrix.elements() for x in row])


def _square(column: Matrix, n: int) -> Matrix:
    entries = [row[0] for row in column.elements()]
    return Matrix.from_elements(column.field, n, n, [entries[i * n : (i + 1) * n] for i in range(n)])


def _of_sum_at_most(total: int, length: int) -> Iterator[tuple[int, ...]]:
    if length == 0:
        yield ()
        return
    for first in range(total + 1):
        for rest in _of_sum_at_most(total - first, length - 1):
            yield (first, *rest)


def _complement(columns: Matrix) -> Matrix:
    """Unit columns that complete independent columns to a basis."""
    unit = Matrix.identity(columns.field, columns.nrows)
    chosen: list[int] = []
    for j in range(columns.nrows):
        if rank(beside(columns, unit.columns([*chosen, j]))) == columns.ncols + len(chosen) + 1:
            chosen.append(j)
    return unit.columns(chosen)
