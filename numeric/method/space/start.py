"""This makes a kernel basis of maximum likelihood for given A, C, from a fault space estimated row by row.

joint_basis   all p - n_v rows at once, with the row degrees that the data accept
complement    P with orthonormal rows and P O_s = 0: a true kernel row is g P, because A and C are known
splits        row degrees that add up to n - zeta, the most equal first: those of almost every system
rows_from     kernel rows of given degrees that a fault space asks for
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations_with_replacement, islice

import numpy as np
import scipy.linalg

from ....base.arrays import Array
from ..ranks.sample_windows import EPS, ObservedCoordinates
from .basis import KernelBasis, kernel_basis
from .estimate import condition_maps
from .tapered_moments import CrossMoments

# Splits tried, and the nats a sample by which the joint level may lie above that of single rows before another is.
SPLITS = 6
SLACK = 0.3  # nats above the best split up to which another is a start, too; it decides which descents are made, and no answer


def joint_basis(
    moments: CrossMoments, coordinates: ObservedCoordinates, rows: int, degree: int, columns: Array, level: float
) -> KernelBasis | None:
    """Find the likeliest basis of this many rows, whose degrees add up to `degree`, started from the fault space `columns` (n + p, n_z) in
    the observed coordinates; None where no split of the degree comes near the `level` that single rows leave."""
    for degrees in islice(splits(degree, rows), SPLITS):
        within = [complement(coordinates.A, coordinates.C, eta + 1) for eta in degrees]
        start = rows_from(columns, coordinates, degrees)
        if start is None:
            continue
        basis = kernel_basis(moments.of_degree(max(degrees)), within, [start])
        if basis.level <= level + SLACK:
            return basis
    return None


def splits(degree: int, rows: int) -> Iterator[tuple[int, ...]]:
    """Return ascending row degrees that add up to `degree`, the most equal first."""
    parts = (part for part in combinations_with_replacement(range(degree + 1), rows) if sum(part) == degree)
    yield from sorted(parts, key=lambda part: (part[-1] - part[0], part[-1]))


def complement(A: Array, C: Array, s: int) -> Array:
    """Return P (k, p s) with orthonormal rows, P O_s = 0."""
    blocks = [C]
    for _ in range(s - 1):
        blocks.append(blocks[-1] @ A)
    left, values, _ = np.linalg.svd(np.vstack(blocks))
    size = float(values[0]) if values.size else 0.0
    observed = int(np.sum(values > left.shape[0] * EPS * size))
    return np.asarray(left[:, observed:].T)


def rows_from(columns: Array, coordinates: ObservedCoordinates, degrees: tuple[int, ...]) -> list[Array] | None:
    """Return kernel rows (eta_i + 1, p) of these ascending degrees that come nearest to N T_s(z) = 0 for the columns z and leave no
    row a combination of shifts of the others; None where the degrees leave no room for that."""
    p = coordinates.C.shape[0]
    found: list[Array] = []
    for degree in sorted(set(degrees)):
        P = complement(coordinates.A, coordinates.C, degree + 1)
        shifts = [np.pad(row.ravel(), (a * p, (degree - a + 1) * p - row.size)) for row in found for a in range(degree - len(row) + 2)]
        if shifts:
            P = scipy.linalg.null_space(np.array(shifts) @ P.T).T @ P
        wanted = degrees.count(degree)
        if len(P) < wanted:
            return None
        asked = np.concatenate(list(condition_maps(coordinates.A, coordinates.C, degree + 1) @ columns), axis=1)
        left = np.linalg.svd(P @ asked)[0]
        found += [(vector @ P).reshape(degree + 1, p) for vector in left[:, len(P) - wanted :].T]
    return found
