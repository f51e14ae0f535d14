"""The published way to the fault space is right without noise, the null rows' answer where they determine it, not theirs elsewhere."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.ranks.sample_windows import hankel_factor
from faultspace.numeric.method.space.distances import subspace_distance
from faultspace.numeric.method.space.estimate import kernel_conditions
from faultspace.numeric.study.random_systems import StudySystem, study_system
from faultspace.numeric.study.runs import study_run
from faultspace.numeric.study.toeplitz_factorisation import toeplitz_factorisation
from tests.numeric.published_error import author_error

Array = NDArray[np.float64]


def residual_of(system: StudySystem, level: float) -> Array:
    run = study_run(system, 9, level=level)
    return run.y - system.model.simulate(run.u)


def null_rows(r: Array, A: Array, C: Array, s: int, rank: int, n_z: int) -> Array:
    """Return the columns that least violate N_s T_s(z) = 0, N_s from the singular vectors beyond the rank."""
    rows = np.linalg.svd(hankel_factor(r, s))[0][:, rank:].T.reshape(-1, s, C.shape[0])
    conditions = kernel_conditions(rows, A, C).reshape(-1, A.shape[0] + C.shape[0])
    return np.asarray(np.linalg.svd(conditions)[2][-n_z:].T)


@pytest.mark.parametrize("n_zeros", range(4))
@pytest.mark.parametrize("s", [6, 7])
def test_it_finds_the_fault_space_without_noise(n_zeros: int, s: int) -> None:
    system = study_system(n_zeros, 8)
    A, C = system.model.A, system.model.C
    rank, n_z = 5 + 2 * s - n_zeros, 2 + n_zeros
    found = toeplitz_factorisation(residual_of(system, 0.0), A, C, block_rows=s, rank=rank, n_z=n_z)
    assert found.shape == (8, n_z)
    assert subspace_distance(found, system.Z) < 1e-6


def test_with_noise_it_is_the_null_rows_answer_where_that_solves_every_condition_and_only_there() -> None:
    # One zero, s = 5: one null row, five conditions on eight unknowns, three solutions. Two zeros: more conditions than unknowns.
    for n_zeros, equal in ((1, True), (2, False)):
        system = study_system(n_zeros, 8)
        A, C, r = system.model.A, system.model.C, residual_of(system, 0.01)
        settings: dict[str, Any] = {"rank": 15 - n_zeros, "n_z": 2 + n_zeros}
        found = toeplitz_factorisation(r, A, C, block_rows=5, **settings)
        apart = subspace_distance(found, null_rows(r, A, C, 5, **settings))
        assert (apart < 1e-8) is equal
        assert author_error(system.fault_columns, found) < 0.3


def test_without_a_null_row_every_column_is_a_solution() -> None:
    system = study_system(0, 8)
    found = toeplitz_factorisation(residual_of(system, 0.01), system.model.A, system.model.C, block_rows=5, rank=15, n_z=2)
    assert np.array_equal(found, np.eye(8))


@pytest.mark.parametrize("wrong", [{"block_rows": 1}, {"rank": 0}, {"rank": 16}, {"n_z": 0}, {"n_z": 9}])
def test_what_cannot_be_is_refused(wrong: dict[str, int]) -> None:
    system = study_system(1, 8)
    with pytest.raises(InvalidData, match=next(iter(wrong))):
        settings = {"block_rows": 5, "rank": 14, "n_z": 3} | wrong
        toeplitz_factorisation(np.ones((50, 3)), system.model.A, system.model.C, **settings)
