"""Ranks of the leading rows of many small integer matrices at once, and other exact arithmetic on tables of int64.

    leading_ranks      rank of the first k rows of each matrix, for every k
    determinants       of many small square matrices
    times              products of matrices
    Overflow           the numbers may not fit into 64 bits: the systems are to be looked at one by one

A rank over Q is the largest of the ranks modulo some primes, if these have a product larger than every minor can be: a minor that is not
zero has a prime among them that does not divide it. Hadamard's inequality bounds the minors, so that as many primes as needed are taken;
one is enough for most boxes. Over GF(q) the one prime is q.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import isqrt

import numpy as np
from numpy.typing import NDArray

from ...exact.system.modular import primes_below

Integers = NDArray[np.int64]
LARGEST = 2**31 - 1  # a prime: products of two residues fit into 64 bits
MOST = 2**62


class Overflow(ArithmeticError):
    """The numbers may not fit into 64 bits."""


def times(left: Integers, right: Integers) -> Integers:
    """Return the products of the matrices (N, a, b) and (N, b, c). Raises Overflow."""
    if left.size and right.size and _largest(left) * _largest(right) * left.shape[-1] >= MOST:
        raise Overflow("a product of matrices")
    found: Integers = np.einsum("...ij,...jk->...ik", left, right)
    return found


def leading_ranks(matrices: Integers, prime: int | None) -> Integers:
    """Return, for matrices (N, rows, columns), the ranks (N, rows + 1) of their first 0, 1, ... rows, over GF(prime) or, None, over Q."""
    if prime is not None:
        return _modulo(matrices, prime)
    found = np.zeros((len(matrices), matrices.shape[1] + 1), dtype=np.int64)
    for modulus in _enough(matrices):
        found = np.maximum(found, _modulo(matrices, modulus))
    return found


def determinants(matrices: Integers) -> Integers:
    """Return the determinants of matrices (N, k, k), by expansion along the rows with the minors of the first i rows kept. Raises
    Overflow.
    """
    count, size, _ = matrices.shape
    if size and _bound(matrices) * 2 ** min(size, 20) >= MOST:
        raise Overflow("a determinant")
    minors: dict[int, Integers] = {0: np.ones(count, dtype=np.int64)}
    for row in range(size):
        grown: dict[int, Integers] = {}
        for columns, value in minors.items():
            for j in range(size):
                if not columns >> j & 1:
                    sign = -1 if (columns >> (j + 1)).bit_count() % 2 else 1
                    term = sign * matrices[:, row, j] * value
                    target = columns | 1 << j
                    grown[target] = grown[target] + term if target in grown else term
        minors = grown
    return minors[(1 << size) - 1]


def _largest(matrices: Integers) -> int:
    return max(-int(matrices.min()), int(matrices.max())) if matrices.size else 0


def _bound(matrices: Integers) -> int:
    """Return a bound on every minor of any of the matrices: the product of the lengths of the rows, each at least 1 (Hadamard)."""
    if not matrices.size:
        return 1
    if _largest(matrices) ** 2 * matrices.shape[2] >= MOST:
        raise Overflow("the length of a row")
    bound = 1
    for square in (matrices * matrices).sum(axis=2).max(axis=0):
        bound *= max(isqrt(int(square)) + 1, 1)
    return bound


def _enough(matrices: Integers) -> Iterator[int]:
    bound, product = _bound(matrices), 1
    for prime in primes_below(LARGEST):
        if product > bound:
            return
        yield prime
        product *= prime


def _modulo(matrices: Integers, prime: int) -> Integers:
    work = np.ascontiguousarray(np.moveaxis(matrices, 0, -1))  # the systems last: numpy's inner loops are long then
    work = _residues(work, prime)
    nrows, ncols, count = work.shape
    ranks = np.zeros((count, nrows + 1), dtype=np.int64)
    every = np.arange(count)
    for row in range(nrows):
        if not ncols:
            break
        chosen = np.argmax(work[row] != 0, axis=0)
        pivot = work[row, chosen, every]
        found = pivot != 0
        ranks[:, row + 1] = ranks[:, row] + found
        if row + 1 < nrows:
            lead = work[row + 1 :, chosen, every]
            scale, factor = np.where(found, pivot, 1), np.where(found, lead, 0)
            work[row + 1 :] = _residues(work[row + 1 :] * scale - factor[:, None] * work[row], prime)
    return ranks


def _residues(numbers: Integers, prime: int) -> Integers:
    """Return the numbers modulo the prime; numpy divides by one number several times faster than it takes the remainder."""
    residues: Integers = numbers - numbers // prime * prime
    return residues
