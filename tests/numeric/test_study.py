"""The Monte Carlo study: its systems by construction, its cases whatever the workers, its vacuous cases, and the paper's example."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace.numeric import study_systems
from faultspace.numeric.distances import containment_distance, subspace_distance
from faultspace.numeric.example_v import behaviour_ranks, exact_fault_space, lines, published_ranks, tally
from faultspace.numeric.example_v import system as example_system
from faultspace.numeric.input_checks import InvalidData
from faultspace.numeric.monte_carlo import STUDIES, by_phase, by_zeros, null_rows_estimate, study_as_corrected, study_as_published
from faultspace.numeric.study_systems import NOISE_GAIN, experiment, pencil_zeros, study_system


@pytest.mark.parametrize("n_zeros", range(4))
@pytest.mark.parametrize("seed", range(5))
def test_a_system_has_the_zeros_it_was_built_with(n_zeros: int, seed: int) -> None:
    system = study_system(n_zeros, seed)
    A, F, C, G = system.model.A, system.F, system.model.C, system.G
    assert system.n_zeros == n_zeros
    assert system.model.is_stable
    # By the pencil, with compressions other than those that accepted the system.
    found = pencil_zeros(A, F, C, G, np.random.default_rng(99))
    assert np.allclose(np.sort(found.real), system.zeros, rtol=1e-4, atol=1e-5)
    # By ranks, independently: rank [O_s T_s] = n + s n_v - zeta from the lag on, which is 5 - zeta.
    assert behaviour_ranks(A, F, C, G, 7)[5:] == (5 + 12 - n_zeros, 5 + 14 - n_zeros)


@pytest.mark.parametrize("n_zeros", range(4))
def test_the_fault_space_by_construction_solves_problem_11(n_zeros: int) -> None:
    system = study_system(n_zeros, 3)
    solved = exact_fault_space(system.model.A, system.F, system.model.C, system.G)
    assert solved.shape == system.Z.shape == (8, 2 + n_zeros)
    assert subspace_distance(solved, system.Z) < 1e-6
    assert containment_distance(system.fault_columns, system.Z) < 1e-10


def test_the_pencil_finds_zeros_that_no_construction_put_there() -> None:
    # x+ = v, r = (x - v/2, 2x - v): one zero at 2, and with a second, independent output none.
    A, F = np.zeros((1, 1)), np.ones((1, 1))
    C = np.array([[1.0], [2.0]])
    assert np.allclose(pencil_zeros(A, F, C, np.array([[-0.5], [-1.0]])), [2.0])
    assert pencil_zeros(A, F, C, np.array([[-0.5], [-1.5]])).size == 0


def test_the_estimator_finds_the_fault_space_without_noise() -> None:
    for n_zeros in range(4):
        system = study_system(n_zeros, 8)
        run = experiment(system, 9, level=0.0)
        r = run.y - system.model.simulate(run.u)
        found = null_rows_estimate(r, system.model.A, system.model.C, block_rows=6, rank=17 - n_zeros, n_z=2 + n_zeros)
        assert subspace_distance(found, system.Z) < 1e-6


def test_the_stated_noise_is_43_decibels_and_the_corrected_one_40() -> None:
    system = study_system(1, 0)
    published = experiment(system, 1, level=0.01, samples=20000).decibels
    corrected = experiment(system, 1, level=0.01 / NOISE_GAIN, samples=20000).decibels
    assert abs(published - (40 - 20 * np.log10(NOISE_GAIN))) < 0.2
    assert abs(corrected - 40) < 0.2
    assert abs(published - 43) < 0.2


def test_cases_do_not_depend_on_the_number_of_workers_nor_on_how_many_follow() -> None:
    alone, together = (study_as_published(systems=6, seed=4, jobs=jobs, samples=300) for jobs in (1, 2))
    for one, two in zip(alone.cases, together.cases, strict=True):
        assert one.zeros == two.zeros and one.random == two.random
        assert one.errors is not None and two.errors is not None
        # BLAS may run on other numbers of threads here and there: equal up to rounding.
        assert np.allclose(list(asdict(one.errors).values()), list(asdict(two.errors).values()), rtol=1e-6, atol=1e-9)
    shorter = study_as_published(systems=5, seed=4, jobs=1, samples=300)
    assert shorter.cases == alone.cases[:5]
    assert study_as_published(systems=5, seed=5, jobs=1, samples=300).cases != shorter.cases


def test_vacuous_cases_are_those_without_a_null_row_and_only_those() -> None:
    published, corrected = (make(systems=8, jobs=1, samples=300) for make in (study_as_published, study_as_corrected))
    assert [case.n_zeros for case in published.cases] == [0, 1, 2, 3] * 2
    assert [case.vacuous for case in published.cases] == [True, False, False, False] * 2
    assert not any(case.vacuous for case in corrected.cases)
    for case in published.cases:
        if case.vacuous:
            assert case.errors is not None
            assert case.errors.published < 1e-9 and case.random.published < 1e-9
            assert case.errors.two_sided > 0.5  # the whole space is far from a plane
            assert (case.rank, case.rows, case.n_z) == (15, 15, 8)
    groups = by_zeros(published)
    assert [group.label for group in groups] == ["0 zeros", "1 zero", "2 zeros", "3 zeros"]
    assert [group.vacuous for group in groups] == [2, 0, 0, 0]
    assert sum(group.cases for group in by_phase(published)) == 8


def test_all_studies_see_the_same_systems_and_beat_a_random_subspace() -> None:
    studies = [study(systems=8, seed=2, jobs=1) for study in STUDIES.values()]
    assert len({tuple(case.zeros for case in study.cases) for study in studies}) == 1
    for study in studies:
        errors = [study.error(case) for case in study.cases if not case.vacuous]
        random = [study.random_error(case) for case in study.cases if not case.vacuous]
        assert np.median([error for error in errors if error is not None]) < 0.7 * np.median(random)
        assert study.to_json()["vacuous"] == sum(case.vacuous for case in study.cases)


def test_progress_counts_to_the_end() -> None:
    seen: list[tuple[int, int, float]] = []
    study_as_corrected(systems=3, jobs=1, samples=200, progress=lambda *told: seen.append(told))
    assert [(done, total) for done, total, _ in seen] == [(1, 3), (2, 3), (3, 3)]
    assert seen[-1][2] == 0.0


@pytest.mark.parametrize("wrong", [{"systems": 0}, {"jobs": 0}, {"seed": -1}, {"samples": 0}])
def test_bad_numbers_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(InvalidData, match=next(iter(wrong))):
        study_as_published(**wrong)


def test_only_up_to_three_zeros_are_built() -> None:
    with pytest.raises(InvalidData, match="0, 1, 2 or 3"):
        study_system(4, 0)


def test_figures_are_drawn_on_the_axes_given(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    from faultspace.numeric import study_plots

    study = study_as_published(systems=8, jobs=1, samples=200)
    for draw in (study_plots.error_histogram, study_plots.errors_by_zeros, study_plots.errors_by_phase, study_plots.errors_against_circle):
        ax = Figure().add_subplot()
        assert draw(study, ax) is ax
        assert ax.has_data() and ax.get_title()
    # Six cases are not vacuous: the histogram's own bars hold exactly these.
    ax = study_plots.error_histogram(study, Figure().add_subplot())
    heights = [bar.get_height() for container in ax.containers for bar in container if bar.get_hatch() is None]
    assert max(heights) <= 6 and sum(heights) == 6
    study_plots.study_figure(study).savefig(tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 10000


def test_the_example_tells_where_its_ranks_differ_from_theory(published_run: list[str]) -> None:
    told = "\n".join(published_run)
    assert "theory, rank [O_s T_s]" in told
    first, second = published_ranks(1907)
    assert (first, second) == (6, 7)
    assert "rank R_5 is 6 where 7 is true, rank R_6 is 7 where 8 is true" in told
    assert "default ranks equal theory at every window" in told


@pytest.fixture(scope="module")
def published_run() -> list[str]:
    """The example's own words for its default seed."""
    from faultspace.numeric.example_v import example_v

    run = example_v()
    assert run.theory == (2, 4, 5, 6, 7, 8)
    assert run.default_true == run.theory
    assert run.window_gap == run.published_gap == 1
    assert run.dimension_true.n_v == 1
    assert run.fault_space_dimension == 2
    assert run.angle_true < 1e-9 < run.angle_identified < 0.1
    return list(lines(run))


def test_the_examples_ranks_are_counted_over_runs() -> None:
    counted = list(tally(4))
    assert sum(int(line.split(" in ")[1].split()[0]) for line in counted[1:]) == 4
    model, F, _ = example_system()
    assert np.linalg.matrix_rank(np.hstack([F, model.A @ F])) == 1  # not controllable from the fault


def test_the_noise_gain_is_that_of_the_filter() -> None:
    noise = study_systems.coloured_noise(200000, 1, np.random.default_rng(0))
    assert abs(noise.std() - NOISE_GAIN) < 0.01
