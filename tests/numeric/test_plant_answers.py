"""What a plant does to a record, and what `identify` then says: a residual that grows beyond all numbers, and others."""

from __future__ import annotations

import json
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from unittest.mock import patch

import jsonschema
import numpy as np
import pytest

from benchmarks.changes_records import KINDS, SETTINGS, coloured, plant, record, run
from faultspace import numeric
from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric import Doubts, Monitor, StateSpaceModel, identify, read_record

PLANT = StateSpaceModel([[0.8, 0.2], [-0.2, 0.7]], [[1.0], [0.2]], [[1.0, 0.0], [0.5, 1.0], [0.0, 1.0]], np.zeros((3, 1)))
K = 250
SCHEMA = Path(numeric.__file__).parent / "schemas" / "identify.schema.json"


def measured(seed: int, samples: int = 2 * K) -> tuple[Array, Array]:
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((samples, 1))
    return PLANT.simulate(u) + 0.1 * draw.standard_normal((samples, 3)), u


def test_a_residual_that_grows_beyond_all_numbers_is_counted_before_it_does() -> None:
    kind = 1 + list(KINDS).index("stuck")
    drawn = record("stuck", 3.0, SETTINGS["middle"], np.random.default_rng((1, 1, kind, 3, True, 2)), True)  # its loop is unstable then
    found = identify(drawn.y, drawn.u, order=3, healthy=drawn.healthy)
    assert np.abs(drawn.y).max() > 1e12 and found.onset is not None and abs(found.onset.onsets[0].sample - drawn.healthy) <= 2
    assert any("as where a loop has become unstable: faults are counted" in note for note in found.notes)
    assert drawn.healthy < found.held[1] < len(drawn.y) and "too unequal" not in found.reason and found.n_v != 0


def moved(*, offset: float, seed: int) -> tuple[Array, Array]:
    """Return a record whose input rests a deviation and a half higher after K samples, where its actuator is off by `offset`."""
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((2 * K, 1))
    u[K:] += 1.5
    driven = u.copy()
    driven[K:] += offset
    return PLANT.simulate(driven) + 0.05 * draw.standard_normal((2 * K, 3)), u


def test_an_actuator_that_is_off_is_named_although_the_set_point_has_moved(tmp_path: Path) -> None:
    """The means of the inputs account for what the errors of the static gain allow, and no more."""
    for seed in range(3):
        y, u = moved(offset=0.4, seed=seed)
        found = identify(y, u, order=2, healthy=K)
        assert found.moved and found.shift_isolation is not None and found.n_v != 0
        assert [cause.channel for cause in found.shift_isolation.of("consistent")] == ["u1"]
        if seed == 0 and find_spec("matplotlib") is not None:
            found.save(tmp_path / "answer")
            assert (tmp_path / "answer" / "shift-causes.png").read_bytes().startswith(b"\x89PNG")
        clean = identify(*moved(offset=0.0, seed=seed), order=2, healthy=K)
        assert not clean.moved and clean.shift_isolation is None


def curved(seed: int) -> tuple[Array, Array]:
    """Return a record of a curved plant whose inputs rest a deviation and a half higher after 300 samples, without a fault."""
    draw = np.random.default_rng((299, seed))
    system, noise, u = plant(draw, 3, 2, loop=False), coloured(draw, 600, 3), draw.standard_normal((600, 2))
    u[300:] += 1.5
    driven, same = u + 0.02 * u * np.abs(u) + 0.02 * u**2, np.ones((600, 2))
    quiet, _ = run(system, driven, np.zeros((600, 3)), lambda k, y, last: y, same)
    return run(system, driven, noise * quiet.std(axis=0) / 40, lambda k, y, last: y, same)[0], u


def test_a_plant_that_is_curved_has_no_fault_for_being_driven_elsewhere() -> None:
    without = 0
    for seed in range(2):
        y, u = curved(seed)
        found = identify(y, u, order=3, healthy=300)
        assert not found.moved and found.shift_isolation is None and found.changes is not None and not found.changes.seen
        with patch("faultspace.numeric.plant.steps.explaining.doubts", return_value=Doubts((), ())):
            without += identify(y, u, order=3, healthy=300).moved
    assert without


def test_an_input_that_rests_where_it_has_never_been_leaves_the_mean_open() -> None:
    y, u = moved(offset=0.0, seed=1)
    u[K:] += 5.0
    y[K:] += PLANT.simulate(np.full((K, 1), 5.0)) + 3.0
    found = identify(y, u, order=2, healthy=K)
    assert found.mean is not None and found.mean.shifted is None and "have not been" in found.mean.reason


@pytest.mark.slow
def test_the_shape_of_what_laws_leave_is_a_likelihood_ratio() -> None:
    y, u = measured(3)
    document = identify(y, u, order=2).to_json()
    shapes = [test["sphericity"] for test in document["laws"]["tests"] if test["sphericity"]]
    assert shapes and all(set(shape) == {"log_likelihood_ratio", "expected"} for shape in shapes)
    jsonschema.validate(document | {"files": []}, json.loads(SCHEMA.read_text("utf-8")))


@pytest.mark.parametrize(
    ("factor", "at", "words"),
    [
        (1e300, slice(None), "'y2' reaches .*e.30[01], whose square no float holds: use other units, or mend a slip"),
        (1e-300, slice(None), "'y2' varies by .*e-300, whose square no float holds: use other units"),
        (1e-310, slice(None), "'y2' varies by .*, whose square no float holds"),
        (1e307, 77, "'y2' reaches .*e.30[67], whose square no float holds"),
        (0.0, slice(None), "output 'y2' is constant .-?0.: it tells nothing of the system"),
    ],
)
def test_numbers_that_no_square_holds_are_refused_by_name(factor: float, at: Any, words: str) -> None:
    y, u = measured(4)
    y[at, 1] *= factor
    for healthy in (None, 100):
        with pytest.raises(InvalidData, match=words):
            identify(y, u, healthy=healthy)


def test_outputs_that_are_all_constant_are_named_together() -> None:
    y, u = measured(4)
    with pytest.raises(InvalidData, match=r"outputs .y1., .y2., .y3. are constant: they tell nothing .*; leave them out"):
        identify(np.ones_like(y), u)


def test_a_step_is_an_input_though_no_state_is_found_by_it() -> None:
    draw = np.random.default_rng(1)
    u = 1.0 * (np.arange(400)[:, None] > 50)
    y = StateSpaceModel([[0.8]], [[1.0]], [[1.0], [0.5]], [[0.0], [1.0]]).simulate(draw.standard_normal((400, 1)))
    found = identify(y + 0.1 * draw.standard_normal((400, 2)), u)
    assert found.model is not None and found.model.order == 0 and found.n_v == 1 and found.fault_space is not None


@pytest.mark.slow
def test_levels_far_beyond_the_noise_are_levels_and_not_rounding() -> None:
    y, u = measured(5)
    found = identify(y + np.array([1e15, 1e12, -1e14]), u + 1e12, order=2)
    assert found.operating_point.of == "whole record" and not found.exact and found.model is not None


def test_times_that_run_backwards_are_told_and_no_time_is_negative(tmp_path: Path) -> None:
    y, u = measured(6)
    path = tmp_path / "back.csv"
    time = 0.1 * np.arange(len(y))[::-1, None]
    np.savetxt(path, np.hstack([time, u, y]), delimiter=",", header="time,u,a,b,c", comments="")
    clock = read_record(path, inputs="u", outputs="a,b,c").clock
    assert clock is not None and clock.dt == pytest.approx(0.1) and clock.backwards == len(y) - 1 and clock.first_odd == 1


def test_a_monitor_of_several_experiments_learns_from_the_longest_at_its_own_point() -> None:
    lengths, levels = (200, 400, 200), (0.0, 50.0, -30.0)
    pieces = [measured(20 + k, length) for k, length in enumerate(lengths)]
    found = identify([y + level for (y, _), level in zip(pieces, levels, strict=True)], [u - 3.0 for _, u in pieces], order=2)
    watch = Monitor(found, level=1e-3)
    assert any("of experiment 2, the longest," in note for note in watch.notes)
    y, u = measured(30, 300)
    y[200:, 1] += 1.0
    alarms = watch.extend(y + 50.0, u - 3.0).alarms
    # At the level of another experiment the first samples would give an alarm, and all tests would.
    assert min(alarm.sample for alarm in alarms) > 10 and len({alarm.test for alarm in alarms if 200 <= alarm.sample < 205}) >= 3


def test_a_start_up_is_named_beside_its_onset() -> None:
    y, u = measured(6, 600)
    y += 5.0 * np.exp(-np.arange(600) / 25.0)[:, None] * [1.0, 0.3, 0.0]
    found = identify(y, u, order=2)
    words = found.summary()
    assert found.onset is not None and found.onset.onsets and "a start-up that had not died out, or a fault from early on" in words


def test_a_sensor_that_is_stuck_has_no_fault_space() -> None:
    random = np.random.default_rng((1, 1, 1 + list(KINDS).index("stuck"), 3, False, 0))
    drawn = record("stuck", 3.0, SETTINGS["middle"], random, False)
    found = identify(drawn.y, drawn.u, order=3, healthy=drawn.healthy)
    assert found.n_v == 1 and found.fault_space is None and found.isolation is None
    assert any(f"no fault space is given: {drawn.channel} has lost variance" in note for note in found.notes)
    assert found.shift_isolation is not None and found.shift_isolation.answer.startswith(f"a sensor fault on {drawn.channel} explains")
