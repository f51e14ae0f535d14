"""Many cases of the published study are drawn, measured, estimated and judged at once: `published_case` for a stack.

    published_cases   the cases of these indices, whatever their numbers of zeros
    LONGEST           records longer than that are taken one by one

The study as published is small matrices: one system after the other, four fifths of its time go into Python around calls of LAPACK that
take microseconds. Systems with the same number of zeros have matrices of the same shapes, so they go through each step side by side. The
cases are those of `published_case` to the rounding error, and the same to the last bit whatever else is in the stack.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.arrays import Array
from ...base.threads import one_thread
from .random_systems import MOST_ZEROS, N_V, N_X, P
from .run_stacks import responses, study_runs
from .study_cases import (
    NOISE_LEVEL,
    PAPER,
    PUBLISHED_WINDOW,
    Case,
    Errors,
    Estimate,
    Numbered,
    one_by_one,
    published_case,
    seeds_of_parts,
    truth_of,
)
from .system_stacks import SystemStack, study_systems
from .toeplitz_stacks import toeplitz_factorisations

# Long records spend their time inside the calls, and would fill the memory; short ones have fewer windows than rows of the Hankel matrix.
LONGEST, SHORTEST = 10_000, 50


@one_thread()
def published_cases(numbered: Sequence[Numbered], samples: int) -> list[Case]:
    """Return `published_case` for each index and seed, in their order."""
    if not SHORTEST <= samples <= LONGEST:
        return one_by_one(published_case, numbered, samples)
    found: dict[int, Case] = {}
    for n_zeros in range(MOST_ZEROS + 1):
        alike = [each for each in numbered if each[0] % (MOST_ZEROS + 1) == n_zeros]
        if alike:
            found |= zip((index for index, _ in alike), _alike(n_zeros, alike, samples), strict=True)
    return [found[index] for index, _ in numbered]


def _alike(n_zeros: int, numbered: Sequence[Numbered], samples: int) -> list[Case]:
    """Return the cases of systems with the same number of zeros."""
    of_systems, of_runs, of_starts, of_subspaces = zip(*(seeds_of_parts(seed) for _, seed in numbered), strict=True)
    systems = study_systems(n_zeros, of_systems)
    runs = study_runs(systems, of_runs, level=NOISE_LEVEL, samples=samples)
    starts = np.array([np.random.default_rng(seed).standard_normal(N_X) for seed in of_starts])
    r = runs.y - responses(systems.A, systems.B, systems.C, systems.D, runs.u, starts)
    truth = truth_of(n_zeros, PUBLISHED_WINDOW)
    found = toeplitz_factorisations(r, systems.A, systems.C, block_rows=PUBLISHED_WINDOW, rank=truth.rank, n_z=truth.n_z)
    drawn = [np.random.default_rng(seed).standard_normal((N_X + P, truth.n_z)) for seed in of_subspaces]
    of_found, of_random = _errors(systems, found), _errors(systems, np.linalg.qr(np.array(drawn))[0])
    distances = np.min(np.abs(np.abs(systems.zeros) - 1), axis=1, initial=np.inf)
    return [
        Case(
            index=index,
            zeros=tuple(zeros.tolist()),
            minimum_phase=bool(np.all(np.abs(zeros) <= 1)),
            distance_to_unit_circle=float(distance) if n_zeros else None,
            decibels=float(decibels),
            block_rows=PUBLISHED_WINDOW,
            rows=P * PUBLISHED_WINDOW,
            rank=truth.rank,
            n_z=truth.n_z,
            vacuous=truth.vacuous,
            estimates={PAPER: Estimate(truth.n_z, errors)},
            random=random,
        )
        for (index, _), zeros, distance, decibels, errors, random in zip(
            numbered, systems.zeros, distances, runs.decibels, of_found, of_random, strict=True
        )
    ]


def _errors(systems: SystemStack, bases: Array) -> list[Errors]:
    """Return the errors of orthonormal `bases` (k, n + p, l), l >= n_v."""
    columns = np.linalg.qr(np.concatenate([systems.F, systems.G], axis=1))[0]
    contained = np.sqrt(np.sum(_angles(columns, bases) ** 2, axis=1) / N_V) / (np.pi / 2)
    dimensions = systems.Z.shape[2], bases.shape[2]
    squared = np.sum(_angles(systems.Z, bases) ** 2, axis=1) + abs(dimensions[0] - dimensions[1]) * np.pi**2 / 4
    two_sided = np.sqrt(squared / max(dimensions)) / (np.pi / 2)
    return [Errors(float(c / np.sqrt(N_V)), float(c), float(t)) for c, t in zip(contained, two_sided, strict=True)]


def _angles(first: Array, second: Array) -> Array:
    """Return the principal angles (k, min(l, l')) of orthonormal columns (k, d, l) and (k, d, l'), from sines and cosines together."""
    if first.shape[2] < second.shape[2]:
        first, second = second, first
    across = first.swapaxes(1, 2) @ second
    cosines = np.linalg.svd(across, compute_uv=False)
    sines = np.linalg.svd(second - first @ across, compute_uv=False)[:, ::-1]
    # numpy's arc tangent rounds otherwise where numbers do not lie side by side, and how they lie depends on the size of the stack.
    return np.asarray(np.arctan2(np.ascontiguousarray(sines), cosines))
