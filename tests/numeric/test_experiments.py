"""Several experiments in one identification are judged: model, count and space of all, states and onsets of each; one is its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.base.progress import silent
from faultspace.numeric import (
    ReducedModel,
    StateSpaceModel,
    arx_reduction,
    count_faults,
    fault_space_by_rows,
    identified_fault_space,
    read_stretches,
)
from faultspace.numeric.data.joining import one_record
from faultspace.numeric.data.records import recorded
from faultspace.numeric.plant.answer import Identification
from faultspace.numeric.plant.report.causes_told import residual_table
from faultspace.numeric.plant.steps.explaining import looked_at, most_moved
from tests.end_to_end.identify_runs import valid

NOISE = 0.1
A = np.array([[0.6, 0.4], [-0.4, 0.6]])
B, C = np.array([[1.0], [0.5]]), np.array([[1.0, 0.0], [0.2, 1.0], [0.7, -0.4]])
F, G = np.array([[0.6], [-1.0]]), np.array([[0.5], [1.0], [-0.4]])
PLANT = StateSpaceModel(A, np.hstack([B, F]), C, np.hstack([np.zeros((3, 1)), G]))

Pair = tuple[Array, Array]


def experiment(seed: int, samples: int, *, fault: float = 1.0, x0: Sequence[float] = (0, 0), offset: float = 0.0) -> Pair:
    rng = np.random.default_rng(seed)
    u, v, w = rng.standard_normal((samples, 1)), rng.standard_normal((samples, 1)), rng.standard_normal((samples, 3))
    return PLANT.simulate(np.hstack([u, fault * v]), x0) + offset + NOISE * w, u


def columns(pairs: Sequence[Pair]) -> tuple[list[Array], list[Array]]:
    return [y for y, _ in pairs], [u for _, u in pairs]


@cache
def three() -> tuple[Pair, ...]:
    return experiment(1, 300, fault=0.3, x0=(5, -3)), experiment(2, 250, offset=3.0), experiment(3, 400, offset=-2.0)


@cache
def found_in_three() -> Identification:
    return fs.identify(*columns(three()), order=2, operating_point="means")


def in_states_of(model: StateSpaceModel) -> Array:
    """Return the map that takes states of the plant to those of the model, by what the outputs show of them."""
    seen, given = (np.vstack([C_ @ np.linalg.matrix_power(A_, k) for k in range(6)]) for A_, C_ in ((model.A, model.C), (A, C)))
    return np.asarray(np.linalg.lstsq(seen, given, rcond=None)[0])


def test_model_count_and_space_are_of_all_and_the_state_is_that_of_each() -> None:
    found = found_in_three()
    assert found.model is not None and found.n_v == 1 and found.fault_space is not None
    assert np.max(np.abs(np.sort_complex(found.model.model.poles) - np.sort_complex(np.linalg.eigvals(A)))) < 0.1
    change = in_states_of(found.model.model)
    assert np.linalg.norm(found.initial_states[0] - change @ (5, -3)) < 0.2 * np.linalg.norm(change @ (5, -3))
    column = np.concatenate([change @ F[:, 0], G[:, 0]])
    basis = found.fault_space.basis
    assert np.linalg.norm(column - basis @ (basis.T @ column)) < 0.15 * np.linalg.norm(column)
    assert [len(one.record) for one in found.experiments] == [300, 250, 400] and len(found.record) == 950
    for one in found.experiments:
        assert (one.n_v, one.fault_space) == (found.n_v, found.fault_space) and one.onset is not None and one.onset.onsets == ()
        assert one.signal is not None and one.explained is not None and one.explained > 0.9


def test_more_experiments_say_more_of_the_model() -> None:
    alone, joint = arx_reduction(*three()[2], order=2), found_in_three().model
    assert isinstance(joint, ReducedModel)
    assert np.linalg.norm(joint.uncertainty.poles()) < 0.85 * np.linalg.norm(alone.uncertainty.poles())


def test_no_window_goes_across_two_experiments() -> None:
    """Experiments in another order give the same model; as one record, with jumps of 5 between them, they do not."""
    first, second, third = three()
    joint = found_in_three().model
    assert isinstance(joint, ReducedModel)
    swapped = fs.identify(*columns([third, first, second]), order=2, n_v=0, operating_point="means").model
    assert swapped is not None and np.allclose(swapped.model.markov(6), joint.model.markov(6), atol=1e-6)
    across = arx_reduction(np.vstack([first[0], second[0], third[0]]), np.vstack([first[1], second[1], third[1]]), order=2)
    assert np.max(np.abs(across.model.markov(6) - joint.model.markov(6))) > 1e-3


def test_one_experiment_is_its_own_however_it_comes() -> None:
    y, u = experiment(4, 120)
    plain, listed = fs.identify(y, u, order=2), fs.identify([y], [u], order=2)
    assert plain.experiments == (plain,) and plain.parts == () and len(plain.initial_states) == 1
    assert plain.to_json() == listed.to_json() and np.array_equal(plain.residual.r, listed.residual.r)  # type: ignore[union-attr]
    (entry,) = plain.to_json()["experiments"]
    assert entry["samples"] == 120 and np.allclose(entry["fit"], plain.to_json()["fit"])


def test_the_parts_between_missing_samples_are_experiments(tmp_path: Path) -> None:
    y, u = experiment(5, 410)
    rows = [",".join(map(repr, row)) for row in np.hstack([u, y]).tolist()]
    rows[200], rows[210] = "0.1,,1,1", "0.1,nan,1,1"
    path = tmp_path / "gaps.csv"
    path.write_text("\n".join(["u,a,b,c", *rows]))
    parts = read_stretches(path, inputs="u", outputs="a,b,c")
    found = fs.identify(parts, order=2)
    assert [len(part) for part in parts] == [200, 9, 199] and [len(one.record) for one in found.experiments] == [200, 199]
    assert any("1 of 3 experiments, 9 samples in all, are left out" in note for note in found.notes)
    assert found.n_v == 1 and np.allclose(found.experiments[1].record.y, y[211:])


def test_each_experiment_is_held_against_the_healthy_one(tmp_path: Path) -> None:
    """A step of one sensor in the second of two is found there alone, with its sample."""
    healthy, pairs = experiment(6, 200, fault=0.0), [experiment(7 + k, 150, fault=0.0) for k in range(2)]
    pairs[1][0][60:, 1] += 10 * NOISE
    found = fs.identify(*columns(pairs), healthy=healthy, order=2)
    onsets = [[one.sample - 200 for one in part.onset.onsets] if part.onset else None for part in found.experiments]
    assert onsets[0] == [] and onsets[1] is not None and abs(onsets[1][0] - 60) <= 3
    seen = [{row.channel for row in part.changes.seen} if part.changes else None for part in found.experiments]
    assert seen == [set(), {"y2"}] and found.n_v != 0 and found.at_least == 1
    shift = found.experiments[1].shift_isolation
    assert shift is not None and "y2" in shift.answer
    document = valid("identify", found.to_json() | {"files": []})
    assert [entry["onsets"] for entry in document["experiments"]][1] == onsets[1] and document["healthy_record"]
    assert [entry["samples"] for entry in document["experiments"]] == [150, 150]
    residual_table(found, tmp_path / "residual.csv", silent)
    lines = (tmp_path / "residual.csv").read_text().splitlines()
    assert lines[0] == "experiment,sample,stretch,y1,y2,y3" and len(lines) == 301 and lines[151].startswith("2,0,0,")
    assert lines[151 + onsets[1][0]].startswith(f"2,{onsets[1][0]},1,")
    assert "## Experiments" in found.summary() and "3 experiments" in found.summary() and "2 experiments" in repr(found)


def test_records_without_noise_have_their_states_exactly() -> None:
    """Without fault and noise every experiment is explained to rounding, from its own state."""
    starts = ((1.0, 2.0), (0.0, -4.0))
    rng = np.random.default_rng(8)
    inputs = [rng.standard_normal((count, 1)) for count in (200, 150)]
    outputs = [PLANT.simulate(np.hstack([u, 0 * u]), x0) for u, x0 in zip(inputs, starts, strict=True)]
    found = fs.identify(outputs, inputs)
    assert found.exact and found.model is not None and found.model.order == 2 and found.n_v == 0
    change = in_states_of(found.model.model)
    for x0, state in zip(starts, found.initial_states, strict=True):
        assert np.allclose(state, change @ x0, atol=1e-8)


def test_the_frame_counts_samples_in_each_experiment() -> None:
    pytest.importorskip("pandas")
    frame = found_in_three().to_pandas()
    numbers = frame[("experiment", "number")].to_numpy()
    assert np.array_equal(np.bincount(numbers), [0, 300, 250, 400]) and list(frame.index[298:302]) == [298, 299, 0, 1]
    signal = found_in_three().experiments[1].signal
    assert signal is not None
    first, last = signal.trusted
    assert np.array_equal(frame[("fault", "v1")].to_numpy()[300 + first : 300 + last], signal.v[first:last, 0])


def test_the_space_of_rows_takes_experiments_and_leaves_short_ones_out() -> None:
    pairs = [(y - y.mean(axis=0), u - u.mean(axis=0)) for y, u in three()]
    joint = fault_space_by_rows(pairs, None, A, C, n_v=1, noise_level=NOISE)
    again = fault_space_by_rows([*pairs, experiment(9, 20)], None, A, C, n_v=1, noise_level=NOISE)
    assert np.allclose(joint.basis, again.basis, atol=1e-9) and joint.n_z == 1 and joint.decided
    column = np.concatenate([F[:, 0], G[:, 0]]) / np.linalg.norm(np.concatenate([F, G]))
    assert np.linalg.norm(column - joint.basis @ (joint.basis.T @ column)) < 0.05
    single = fault_space_by_rows(*pairs[0], A, C, n_v=1, noise_level=NOISE)
    assert np.array_equal(single.basis, fault_space_by_rows(pairs[:1], None, A, C, n_v=1, noise_level=NOISE).basis)
    drawn = fault_space_by_rows([*pairs, experiment(9, 20)], None, A, C, n_v=1, noise_level=NOISE, draws=2)
    assert drawn.n_z == 1 and drawn.margin != joint.margin
    model = found_in_three().model
    assert isinstance(model, ReducedModel)
    wrong: tuple[Any, ...] = (np.zeros((9, 3)), [], [np.zeros((9, 3))])
    for one in wrong:
        with pytest.raises(InvalidData, match="u is missing"):
            identified_fault_space(one, None, model, n_v=1)


def test_experiments_that_fill_no_band_by_themselves_are_counted_on_and_searched_together() -> None:
    short = [experiment(seed, 60) for seed in range(20)]
    assert 1 in count_faults(short, None, order=2).possible
    found = fault_space_by_rows([(y - y.mean(axis=0), u - u.mean(axis=0)) for y, u in short], None, A, C, n_v=1, noise_level=NOISE)
    column = np.concatenate([F[:, 0], G[:, 0]]) / np.linalg.norm(np.concatenate([F, G]))
    assert np.linalg.norm(column - found.basis @ (found.basis.T @ column)) < 0.05


WRONG: tuple[tuple[Callable[[], object], str], ...] = (
    (lambda: one_record([np.ones((9, 2)), np.ones((9, 2))], [np.ones((9, 1))]), "got 1 for 2 experiments"),
    (lambda: one_record([np.ones((9, 2)), np.ones((9, 2))], np.ones((9, 1))), "got one of type ndarray for 2"),
    (lambda: one_record([np.ones((9, 2)), np.ones((9, 3))], [np.ones((9, 1))] * 2), "experiment 2 has the channels"),
    (lambda: one_record([np.ones((9, 2)), np.full((9, 2), np.nan)], [np.ones((9, 1))] * 2), "experiment 2 of 2: .*NaN"),
    (lambda: one_record([recorded(np.ones((9, 1)), np.ones((9, 1)), outputs="a", inputs="b"), 3]), "among other things"),
    (
        lambda: one_record([recorded(np.ones((9, 1)), np.ones((9, 1)), outputs="a", inputs="b").about_means()] * 2),
        "experiment 1 is about its means",
    ),
    (lambda: fs.identify(*columns(three()), healthy=301), "got 301 for a first experiment of 300 samples"),
    (lambda: fs.identify(*experiment(1, 200), healthy=one_record(*columns(three()))), "healthy: got 3 experiments"),
)


@pytest.mark.parametrize(("call", "words"), WRONG, ids=[words[:20] for _, words in WRONG])
def test_what_is_no_list_of_experiments_is_refused(call: Callable[[], object], words: str) -> None:
    with pytest.raises(InvalidData, match=words):
        call()


def test_a_list_of_pairs_stays_the_pieces_of_one_experiment() -> None:
    y, u = experiment(1, 90)
    whole, pieces = one_record(y, u), one_record([(y[:40], u[:40]), (y[40:], u[40:])])
    assert whole.lengths == pieces.lengths == () and np.array_equal(whole.y, pieces.y)
    both = one_record([whole, pieces])
    assert both.lengths == (90, 90) and np.array_equal(both.experiments[1].y, y) and both.title.startswith("180 samples of 2 experiments")
    assert [len(part[0]) for part in both.stretches(30, 120)] == [60, 30] and both.part(10, 50).lengths == ()
    assert both.part(10, 100).lengths == (80, 10) and np.array_equal(both.part(10, 100).part(75, 90).u, both.u[85:100])


def test_what_cannot_go_across_experiments_is_asked_of_one() -> None:
    found = found_in_three()
    first, last = looked_at(found)
    assert (first, last) in found.record.bounds and len(most_moved(found).record) == last - first
