"""For given A, C a fault space can be only so large: the bound is tested against exact arithmetic, and on estimators that keep to it."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.fault_columns import from_kernel_rows
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.space import by_likelihood as noisy_fault_space
from faultspace.numeric.method.space.by_likelihood import fault_space_by_likelihood
from faultspace.numeric.method.space.by_ranks import fault_space
from faultspace.numeric.method.space.largest import largest_fault_space, observability_indices
from tests.thorough import every


def drawn(random: np.random.Generator, n: int, m: int, p: int, entries: int) -> ResidualSystem:
    """Draw small integers: they have many zeros, so that indices are unequal, states unobserved, outputs copies of others."""
    shapes = (n, n), (n, m), (p, n), (p, m)
    A, F, C, G = (random.integers(-entries, entries + 1, shape) * random.integers(0, 2, shape) for shape in shapes)
    if p > 1 and random.integers(3) == 0:
        C[-1] = C[0]
    return ResidualSystem.of(A=A.tolist(), F=F.tolist(), C=C.tolist(), G=G.tolist())


def floats(matrix: Matrix, shape: tuple[int, int]) -> NDArray[np.float64]:
    return np.array([[float(str(entry)) for entry in row] for row in matrix.to_json()], dtype=np.float64).reshape(shape)


@pytest.mark.parametrize("seed", range(4))
def test_no_exact_system_exceeds_the_bound_and_some_reach_it(seed: int) -> None:
    random = np.random.default_rng(seed)
    reached = below = 0
    for _ in range(150):
        n, p = int(random.integers(0, 6)), int(random.integers(1, 5))
        m = int(random.integers(0, p + 1))
        system = drawn(random, n, m, p, 2)
        kernel = kernel_representation(system)
        free = kernel_representation(ResidualSystem.of(A=system.A.to_json(), F=[[]] * n, C=system.C.to_json(), G=[[]] * p, n=n, m=0, p=p))
        # Without faults the left minimal indices are the observability indices.
        A, C = floats(system.A, (n, n)), floats(system.C, (p, n))
        assert observability_indices(A, C) == free.left_minimal_indices
        r = kernel.normal_rank
        bound = largest_fault_space(A, C, r)
        n_z = n + p - sum(degree + 1 for degree in kernel.left_minimal_indices)
        assert n_z <= bound, system
        reached += n_z == bound
        below += n_z < bound
        # The columns that the p - r rows of least degree admit reach it, and as faults they leave no row more.
        rows = sorted(free.rows, key=lambda row: row.degree)[: p - r]
        widest = from_kernel_rows((row.coefficients for row in rows), system.A, system.C)
        assert widest.nrows == bound
        best = kernel_representation(
            system.with_faults(widest.columns(range(n)).transposed(), widest.columns(range(n, n + p)).transposed())
        )
        assert best.normal_rank == r
        assert n + p - sum(degree + 1 for degree in best.left_minimal_indices) == bound
    assert reached and below


def test_indices_of_small_matrices_by_hand() -> None:
    shift = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]])
    assert observability_indices(shift, np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])) == (0, 3)
    assert observability_indices(shift, np.eye(3)) == (1, 1, 1)
    assert observability_indices(shift, np.array([[0.0, 1.0, 0.0]])) == (2,)
    assert observability_indices(np.zeros((0, 0)), np.zeros((2, 0))) == (0, 0)
    # One fault, C of three independent rows, three states: two columns are the most, all of (A, C) over these entries agree.
    assert largest_fault_space(shift, np.eye(3), 1) == 2


# In noise `fault_space` is the likelihood, which is asked daily at each level.
LEVELS = (1e-3, 0.1, 1.0, 10.0)
IN_NOISE = [
    *(pytest.param(fault_space, level, marks=() if level == 1e-3 else pytest.mark.slow) for level in LEVELS),
    *product((fault_space_by_likelihood,), LEVELS),
]


@pytest.mark.parametrize(("method", "level"), IN_NOISE)
def test_no_estimate_exceeds_the_bound_whatever_the_noise(method: object, level: float) -> None:
    for seed, (n, p, m) in product(range(0, 2, every()), ((3, 3, 1), (3, 3, 2), (4, 2, 1), (5, 4, 2))):
        random = np.random.default_rng((seed, n, p, m))
        A = random.standard_normal((n, n))
        A *= 0.9 / np.abs(np.linalg.eigvals(A)).max()
        C, F = random.standard_normal((p, n)), random.standard_normal((n, m))
        r = StateSpaceModel(A, F, C, np.zeros((p, m))).simulate(random.standard_normal((400, m)))
        r += level * r.std(axis=0) * random.standard_normal(r.shape)
        found = method(r * np.logspace(-6, 6, p), A, C * np.logspace(-6, 6, p)[:, None], n_v=m)  # type: ignore[operator]
        assert found.n_z <= largest_fault_space(A, C, m), (n, p, m, found.reason)
        assert found.basis.shape == (n + p, found.n_z)


def test_the_degree_is_never_below_what_the_indices_allow() -> None:
    # Levels that a row of degree 0 explains as well as any other: without the bound the answer would be 0.
    levels = np.array([1.0, 1.0, 1.0, 1.0])
    assert noisy_fault_space._least_degree(levels, 1000, 0)[0] == 0
    assert noisy_fault_space._least_degree(levels, 1000, 2)[0] == 2
