"""Stacks of the published study are its cases one by one: to the rounding error, and to the bytes whatever else is in the stack."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, fields, replace
from typing import Any

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric.study import case_stacks, system_stacks, toeplitz_stacks
from faultspace.numeric.study.case_stacks import published_cases
from faultspace.numeric.study.random_systems import study_system
from faultspace.numeric.study.studies import PUBLISHED, monte_carlo
from faultspace.numeric.study.study_cases import Case, Numbered, published_case
from faultspace.numeric.study.system_stacks import study_systems
from faultspace.numeric.study.toeplitz_stacks import least_directions


def numbered(seed: int, systems: int) -> list[Numbered]:
    return list(enumerate(np.random.SeedSequence(seed).spawn(systems)))


def leaves(value: Any) -> Iterator[Any]:
    """Yield all numbers and words of a record in order."""
    if isinstance(value, dict):
        for key in value:
            yield key
            yield from leaves(value[key])
    elif isinstance(value, list | tuple):
        for each in value:
            yield from leaves(each)
    else:
        yield value


def differ(one: Case, other: Case) -> float:
    """Return the largest difference of two floats of these cases, whose other entries must be equal."""
    largest = 0.0
    for a, b in zip(leaves(asdict(one)), leaves(asdict(other)), strict=True):
        assert type(a) is type(b)
        if isinstance(a, float):
            largest = max(largest, abs(a - b))
        else:
            assert a == b
    return largest


@pytest.mark.parametrize("samples", [case_stacks.SHORTEST, 1001])
def test_a_stack_has_the_cases_one_by_one(samples: int) -> None:
    some = numbered(7, 24)
    stacked = published_cases(some, samples)
    assert [case.index for case in stacked] == list(range(24))
    assert max(differ(case, published_case(*each, samples)) for case, each in zip(stacked, some, strict=True)) < 1e-9


def test_a_case_is_the_same_bytes_whatever_else_is_in_the_stack() -> None:
    some = numbered(8, 12)
    together = published_cases(some, 300)
    assert together == [published_cases([each], 300)[0] for each in some]
    assert together[3:7] == published_cases(some[3:7], 300) and together[::-1] == published_cases(some[::-1], 300)


def test_progress_counts_systems() -> None:
    seen: list[tuple[str, int, int]] = []
    monte_carlo(replace(PUBLISHED, stack=3), systems=7, jobs=1, samples=100, on_progress=lambda *each: seen.append(each))
    assert seen == [("published", done, 7) for done in (0, 3, 6, 7)]


@pytest.mark.parametrize("samples", [4, case_stacks.SHORTEST - 1, case_stacks.LONGEST + 1])
def test_records_that_are_short_or_long_are_taken_one_by_one(samples: int) -> None:
    some = numbered(9, 2)
    assert published_cases(some, samples) == [published_case(*each, samples) for each in some]


def test_too_few_samples_are_a_refusal_of_the_estimator_and_one_sample_of_the_study() -> None:
    failure = published_case(*numbered(1, 2)[1], 4).estimates["paper"].failure
    assert failure == "r: got 4 samples; 5 block rows need 5 or more"
    with pytest.raises(InvalidData, match=r"samples: got 1; .* needs 2 or more"):
        monte_carlo(PUBLISHED, systems=4, samples=1)


@pytest.mark.parametrize("n_zeros", range(4))
def test_systems_of_a_stack_are_those_of_their_seeds(n_zeros: int) -> None:
    seeds = [np.random.SeedSequence(seed) for seed in range(60)]
    stack = study_systems(n_zeros, seeds)
    for i, seed in enumerate(seeds):
        single = study_system(n_zeros, seed)
        whole = vars(single.model) | vars(single)
        for field in fields(stack):
            assert np.allclose(getattr(stack, field.name)[i], whole[field.name], rtol=1e-12, atol=1e-12)


def test_what_the_quick_check_doubts_is_drawn_by_study_system(monkeypatch: pytest.MonkeyPatch) -> None:
    # The second draw of seed 506 with two zeros: the first has another zero close to them.
    seeds = [np.random.SeedSequence(seed) for seed in (505, 506)]
    drawn = []

    def heard(n_zeros: int, seed: np.random.SeedSequence) -> Any:
        drawn.append(seed)
        return study_system(n_zeros, seed)

    monkeypatch.setattr(system_stacks, "study_system", heard)
    stack = study_systems(2, seeds)
    assert drawn == seeds[1:]
    assert np.array_equal(stack.F[1], study_system(2, seeds[1]).F)
    monkeypatch.setattr(system_stacks, "ELSEWHERE", 1.0)  # nothing is surely no zero
    assert np.array_equal(study_systems(2, seeds).F[0], study_system(2, seeds[0]).F)


def test_the_quick_check_sees_a_zero_that_was_not_planted() -> None:
    stack = study_systems(1, [np.random.SeedSequence(3)])
    planted = stack.zeros
    matrices = stack.A, stack.F, stack.C, stack.G
    assert system_stacks._as_planted(*matrices, planted).all()
    assert not system_stacks._as_planted(*matrices, np.zeros((1, 0))).any()
    assert not system_stacks._as_planted(*matrices, planted + 1e-6).any()
    assert not system_stacks._as_planted(stack.A, stack.F, stack.C, np.zeros_like(stack.G), planted).any()


def matrix_of(sizes: Array, rows: int) -> tuple[Array, Array]:
    """Return a random matrix (rows, n) with these singular values, n of them, and its right singular vectors as columns."""
    rng = np.random.default_rng(2)
    left, right = (np.linalg.qr(rng.standard_normal((k, sizes.size)))[0] for k in (rows, sizes.size))
    return (left * sizes) @ right.T, right


@pytest.mark.parametrize("least", [(0.4, 1e-2, 3e-5, 1e-9), (0.5, 0.0, 0.0, 0.0), (0.9, 2e-6, 1e-6, 1e-6)])
@pytest.mark.parametrize("rows", [40, 47])
def test_least_directions_are_those_of_the_singular_vectors(least: tuple[float, ...], rows: int) -> None:
    """Values of any size below the others: M'M alone would lose what lies below 1e-8."""
    matrix, right = matrix_of(np.concatenate([np.linspace(4, 1, 36), least]), rows)
    found = least_directions(matrix[np.newaxis], 4)[0]
    assert np.allclose(found @ found.T, right[:, -4:] @ right[:, -4:].T, atol=1e-12)
    if len(set(least)) == 4:
        assert np.allclose(np.abs(np.sum(found * right[:, -4:], axis=0)), 1, atol=1e-9)


def test_least_directions_of_a_wide_matrix_are_its_null_space() -> None:
    matrix = np.random.default_rng(1).standard_normal((2, 37, 40))
    for each, found in zip(matrix, least_directions(matrix, 3), strict=True):
        assert np.allclose(found.T @ found, np.eye(3)) and np.abs(each @ found).max() < 1e-12


def test_where_the_next_values_are_small_too_all_singular_vectors_are_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    matrix, right = matrix_of(np.logspace(0, -7, 30), 30)
    projections = []
    for distance in (toeplitz_stacks.DISTANCE, -1.0):
        monkeypatch.setattr(toeplitz_stacks, "DISTANCE", distance)
        found = least_directions(matrix[np.newaxis], 2)[0]
        projections.append(np.linalg.norm(found - right[:, -2:] @ (right[:, -2:].T @ found)))
    assert projections[0] < 1e-8 < projections[1]
