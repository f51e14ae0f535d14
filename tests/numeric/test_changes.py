"""The table of changes: each kind is seen where it is and measured; of nothing no more is seen than stated; odd records are answered.

RECORD     a plant with coloured noise of known sizes, and the residual of its true model
ADDED      what is added to the residual and the outputs after the healthy samples, with the row that must see it and its size
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace import example_data as made
from faultspace.base.errors import InvalidData
from faultspace.numeric import Changes, StateSpaceModel, changes_since_healthy, changes_within, identify
from faultspace.numeric.data.joining import healthy_from, joined
from faultspace.numeric.data.records import recorded
from faultspace.numeric.plant.changes.lines import HealthySpectrum
from faultspace.numeric.plant.changes.predictor import Stretch, predictor
from faultspace.numeric.plant.healthy.unlike_healthy import longest_run
from faultspace.numeric.plant.report import result_files as report
from tests.end_to_end.identify_runs import valid
from tests.thorough import THOROUGH

Array = NDArray[np.float64]

MODEL = StateSpaceModel(made.A, made.B, made.C, made.D)
LEVELS = np.array([0.3, 0.1, 0.02])
UNITS = np.array([1e-6, 1.0, 1e6])
K, M = 500, 700


def noise(draw: np.random.Generator, samples: int, pole: float = 0.5) -> Array:
    """Return correlated coloured noise of the deviations LEVELS."""
    white = draw.standard_normal((samples + 100, 3)) @ np.array([[1.0, 0.5, 0.0], [0.0, 1.0, 0.3], [0.0, 0.0, 1.0]])
    made = lfilter([1.0, 0.3], [1.0, -pole], white, axis=0)[100:]
    return np.asarray(made / made.std(axis=0) * LEVELS)


def plain(seed: int, healthy: int = K, after: int = M) -> tuple[Array, Array, Array]:
    """Return residual, outputs and inputs without a change; the model is the true one."""
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((healthy + after, 2))
    r = noise(draw, healthy + after)
    return r, MODEL.simulate(u) + r, u


def tabled(r: Array, y: Array, u: Array, **options: Any) -> Changes:
    stated: dict[str, Any] = {"healthy": K, "model": MODEL}
    return changes_since_healthy(r, y, u, **(stated | options))


def _shift(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return np.outer(np.ones(M), [0.0, 0.05, 0.0])


def _drift(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return np.outer(np.arange(M) / M, [0.0, 0.0, 0.1])


def _white(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return np.outer(draw.standard_normal(M), [0.6, 0.0, 0.0])


def _sinusoid(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return np.outer(np.sin(0.7 * np.arange(M)), [0.0, 0.1, 0.0])


def _output_gain(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return -0.1 * MODEL.simulate(u)[K:] * [0.0, 1.0, 0.0]


def _input_gain(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return 0.1 * MODEL.simulate(u * [0.0, 1.0])[K:]


def _stuck(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return np.asarray((y[K - 1] - y[K:] + 1e-3 * draw.standard_normal((M, 3))) * [1.0, 0.0, 0.0])


def _half_stuck(y: Array, u: Array, draw: np.random.Generator) -> Array:
    return _stuck(y, u, draw) * (np.arange(M) < M // 2)[:, None]


def _freezing(y: Array, u: Array, draw: np.random.Generator) -> Array:
    added = np.zeros((M, 3))
    added[300:312, 2] = np.round(y[K + 300, 2], 6) - y[K + 300 : K + 312, 2]
    return added


Adds = Callable[[Array, Array, np.random.Generator], Array]
ADDED: dict[str, tuple[Adds, str, str, float]] = {
    "shift": (_shift, "mean shift", "y2", 0.05),
    "drift": (_drift, "drift", "y3", 0.1),
    "white": (_white, "growth of variance", "y1", 0.6),
    "sinusoid": (_sinusoid, "sinusoid", "y2", 0.1),
    "output gain": (_output_gain, "output gain", "y2", -0.1),
    "input gain": (_input_gain, "input gain", "u2", 0.1),
    "stuck": (_stuck, "loss of variance", "y1", 1.0),
    "half stuck": (_half_stuck, "loss of variance", "y1", 0.5),
    "freezing": (_freezing, "freezing", "y3", 12.0),
}


@pytest.mark.parametrize("name", ADDED)
def test_each_change_is_seen_where_it_is_and_measured(name: str) -> None:
    adds, kind, channel, size = ADDED[name]
    draw = np.random.default_rng(list(name.encode()))
    r, y, u = plain(int(draw.integers(1000)))
    added = adds(y, u, draw)
    r[K:] += added
    y[K:] = np.round(y[K:] + added, 9)  # as a converter does, so that what is held is equal
    found = tabled(r, y, u)
    (row,) = (row for row in found.seen if (row.kind, row.channel) == (kind, channel))
    told = float(row.detail.split(" %")[0]) / 100.0 if kind.endswith("gain") else row.size
    assert told is not None and abs(told - size) < 0.25 * abs(size), row
    assert row.visible is not None and row.probability is not None and row.probability < found.level
    # Of the same kind no other channel is seen: outputs are told from each other.
    assert [other.channel for other in found.seen if other.kind == kind] == [channel]
    # The same in other units, but for rounding.
    scaled = tabled(r * UNITS, y * UNITS, u * 1e3, model=StateSpaceModel(made.A, made.B / 1e3, made.C * UNITS[:, None], np.zeros((3, 2))))
    assert [(one.kind, one.channel) for one in scaled.seen] == [(one.kind, one.channel) for one in found.seen]


def test_of_nothing_no_more_is_seen_than_stated() -> None:
    trials, level = (200, 0.05) if THOROUGH else (20, 0.05)
    alarms = sum(bool(tabled(*plain(seed, 200, 300), healthy=200, level=level).seen) for seed in range(trials))
    # Three standard deviations of a binomial count above what is stated.
    assert alarms <= trials * level + 3.0 * np.sqrt(trials * level)


@pytest.mark.slow
def test_a_change_of_the_size_that_is_told_is_mostly_seen_and_a_tenth_of_it_is_not() -> None:
    seen = {1.0: 0, 0.1: 0}
    for seed in range(8):
        r, y, u = plain(100 + seed, 200, 300)
        (row,) = (row for row in tabled(r, y, u, healthy=200).rows if (row.kind, row.channel) == ("mean shift", "y2"))
        assert row.visible is not None
        for share in seen:
            moved = np.outer(np.arange(500) >= 200, [0.0, share * row.visible, 0.0])
            seen[share] += any(one.channel == "y2" for one in tabled(r + moved, y + moved, u, healthy=200).seen)
    assert seen[1.0] >= 4 and seen[0.1] <= 1


# Twins that do the same the long way


def test_what_the_predictor_says_is_what_least_squares_says() -> None:
    r, y, u = plain(5)
    before, after = (Stretch(r[part], y[part], u[part], None) for part in (slice(0, K), slice(K, None)))
    learnt = predictor(before)
    L = learnt.lags
    joint = np.hstack([r / learnt.scales, u / learnt.input_scales])
    rows = np.array([np.hstack([1.0, *(joint[k - j] for j in range(1, L + 1)), joint[k, 3:]]) for k in range(L, K)])
    coefficients = np.linalg.lstsq(rows, joint[L:K, :3], rcond=None)[0]
    assert np.allclose(learnt.e, joint[L:K, :3] - rows @ coefficients, atol=1e-9)
    rows = np.array([np.hstack([1.0, *(joint[k - j] for j in range(1, L + 1)), joint[k, 3:]]) for k in range(K + L, K + M)])
    assert np.allclose(learnt.innovations(after), joint[K + L :, :3] - rows @ coefficients, atol=1e-9)
    weights = np.random.default_rng(6).standard_normal((M - L, 2))
    assert np.allclose(learnt.moments(after, weights), rows.T @ weights)
    x = rows.T @ weights[:, 0]
    assert np.isclose(learnt.forecast(x), x @ np.linalg.solve(learnt.regressors.T @ learnt.regressors, x))
    # A signal in r is in e what the filter makes of it.
    signal = np.random.default_rng(7).standard_normal((M, 3)) * LEVELS
    moved = replace(after, r=after.r + signal)
    assert np.allclose(learnt.innovations(moved) - learnt.innovations(after), learnt.filtered(signal), atol=1e-9)
    turn = np.exp(2j * np.pi * 0.1 * np.arange(M))
    wave = np.outer(turn, [1.0, 2.0, 3.0] * learnt.scales)
    through = learnt.filtered(wave.real) + 1j * learnt.filtered(wave.imag)
    assert np.allclose(through, np.outer(turn[L:], learnt.response(0.1) @ [1.0, 2.0, 3.0]))


@pytest.mark.parametrize("shape", ["constant", "slope", "white"])
def test_the_variance_of_a_sum_is_that_of_many_draws(shape: str) -> None:
    draw = np.random.default_rng(8)
    r, y, u = plain(9, 4000, 10)
    learnt = predictor(Stretch(r[:4000], y[:4000], u[:4000], None))
    k = np.arange(300) - 149.5
    pattern = {"constant": np.ones(300), "slope": k, "white": draw.standard_normal(300)}[shape]
    weights = np.outer(pattern, [1.0, -1.0, 0.5])
    starts = draw.integers(0, learnt.count - 300, 3000)
    sums = np.array([np.sum(weights * learnt.e[start : start + 300]) for start in starts])
    variance, freedom = learnt.variance(weights)
    # Stretches of one record overlap, so that there are some thirteen independent ones.
    assert 0.3 < np.mean(sums**2) / variance < 3.0
    assert freedom >= learnt.freedom - 1 if shape != "white" else freedom > 3 * learnt.freedom
    white = draw.standard_normal((4000, 1))
    flat = predictor(Stretch(white, white, np.zeros((4000, 1)), None))
    assert np.isclose(flat.variance(np.ones((50, 1)))[0] * flat.scales[0] ** 2, 50.0, rtol=0.5)


def test_a_line_has_the_amplitude_that_regression_on_it_gives() -> None:
    r, y, u = plain(10)
    learnt = predictor(Stretch(r[:K], y[:K], u[:K], None))
    spectrum = HealthySpectrum(learnt)
    frequency = np.array([0.11])
    transform = np.array([[1.0 + 2.0j, 0.5, -1.0j]])
    amplitudes, densities = spectrum.seen(frequency, transform)
    back = np.linalg.inv(learnt.response(0.11))
    assert np.allclose(amplitudes[0], back @ transform[0])
    band = int(np.searchsorted(spectrum.edges, round(0.11 * learnt.count) - 1, side="right"))
    assert np.allclose(densities[0], np.diag(back @ spectrum.densities[band] @ back.conj().T).real)
    total = np.mean(np.abs(spectrum.transforms) ** 2, axis=0)
    assert np.allclose(total, np.diag(learnt.covariance), rtol=0.1)


def test_runs_are_found() -> None:
    draw = np.random.default_rng(11)
    for values in (draw.integers(0, 2, 40) for _ in range(20)):
        slow = max(j - i for i in range(40) for j in range(i + 1, 41) if len(set(values[i:j].tolist())) == 1)
        assert longest_run(values.astype(np.float64)) == slow


# What looks like a change and is none, and what no test can tell


def test_a_hum_of_the_healthy_part_is_no_change_until_it_doubles() -> None:
    r, y, u = plain(12)
    hum = np.outer(np.sin(0.9 * np.arange(K + M)), LEVELS)
    assert not [row for row in tabled(r + hum, y + hum, u).seen if row.kind == "sinusoid"]
    hum[K:] *= 3.0
    assert [row for row in tabled(r + hum, y + hum, u).seen if row.kind == "sinusoid"]


def test_a_sensor_that_mostly_stands_still_is_not_frozen_and_the_row_says_so() -> None:
    r, y, u = plain(13)
    coarse = np.asarray(np.round(np.cumsum(y * 0.02, axis=0)), dtype=np.float64)
    rows = [row for row in tabled(r, coarse, u).rows if row.kind == "freezing"]
    assert not any(row.seen for row in rows) and max(row.visible or 0.0 for row in rows) > 30.0


def test_with_much_louder_inputs_what_the_models_error_could_make_is_undecided() -> None:
    r, _, u = plain(14)
    u[K:] *= 30.0
    wrong = StateSpaceModel(made.A * 0.98, made.B, made.C, made.D)
    y = MODEL.simulate(u) + r
    assert not tabled(y - wrong.simulate(u), y, u, model=wrong).seen
    y[K:, 1] += 1.0
    found = tabled(y - MODEL.simulate(u), y, u)
    assert not found.seen and any("the error of the model" in row.reason for row in found.doubtful)


def test_what_the_healthy_part_does_itself_is_undecided() -> None:
    r, y, u = plain(15)
    moving = np.outer(np.arange(K + M) / 300.0, LEVELS)
    found = tabled(r + moving, y + moving, u)
    assert not [row for row in found.seen if row.kind in ("mean shift", "drift")]
    assert {row.kind for row in found.undecided} & {"mean shift", "drift"}


def test_sensors_are_not_stuck_while_nothing_drives_them() -> None:
    r, _, u = plain(23)
    u[K:] = 0.0
    assert not tabled(r, MODEL.simulate(u) + r, u).seen


def test_a_sensor_that_holds_its_values_while_healthy_too_is_not_frozen() -> None:
    """Few values repeat the one before, and those that do go on nine times out of ten."""
    draw = np.random.default_rng(24)
    r, y, u = plain(25)
    held = np.zeros(K + M, dtype=bool)
    for k in range(1, K + M):
        held[k] = draw.uniform() < (0.9 if held[k - 1] else 0.02)
        y[k] = np.where(held[k], y[k - 1], y[k])
    rows = [row for row in tabled(r, y, u).rows if row.kind == "freezing"]
    assert all(row.seen is False and (row.visible or 0.0) > 20.0 for row in rows), rows


@pytest.mark.parametrize("healthy", [1, 2, 5, 20, 40, K + M - 1, K + M - 3, K + M - 8])
def test_few_samples_on_either_side_are_answered(healthy: int) -> None:
    found = tabled(*plain(16), healthy=healthy)
    assert not found.seen and len(found.rows) in (20, 23)
    assert all(row.reason for row in found.undecided)


@pytest.mark.parametrize("name", ["dead residual", "dead output", "copy", "still input", "one output", "outlier", "zero"])
def test_odd_records_are_answered(name: str) -> None:
    r, y, u = plain(17)
    model: StateSpaceModel | None = MODEL
    if name == "dead residual":
        r[:, 0] = 0.0
    elif name == "dead output":
        y[:, 0] = 3.0
    elif name == "copy":
        r[:, 1], y[:, 1] = r[:, 0], y[:, 0]
    elif name == "still input":
        u[:] = 1.0
    elif name == "one output":
        r, y, model = r[:, :1], y[:, :1], StateSpaceModel(made.A, made.B, made.C[:1], made.D[:1])
    elif name == "outlier":
        r[K + 5, 0] = y[K + 5, 0] = 1e200
    else:
        r, y = np.zeros_like(r), np.zeros_like(y)
    found = tabled(r, y, u, model=model)
    assert not [row for row in found.seen if row.kind != "growth of variance"], found.summary()
    assert found.to_json()["rows"] and found.summary() and list(found.lines())


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"healthy": 0}, "healthy: got 0"),
        ({"healthy": K + M}, "some must follow"),
        ({"level": 1.0}, "level: got 1.0"),
        ({"outputs": ["a"]}, "one a channel is needed"),
    ],
)
def test_bad_questions_are_refused(change: dict[str, Any], says: str) -> None:
    with pytest.raises(InvalidData, match=says):
        tabled(*plain(18), **change)
    with pytest.raises(InvalidData, match="NaN"):
        tabled(np.full((K + M, 3), np.nan), *plain(18)[1:])
    with pytest.raises(InvalidData, match="got shapes"):
        tabled(plain(18)[0][1:], *plain(18)[1:])


def test_without_healthy_samples_only_means_and_stuck_sensors_are_asked() -> None:
    r, y, u = plain(19)
    quiet = changes_within(r, y, u)
    assert not quiet.seen and {row.kind for row in quiet.rows} == {"mean shift", "loss of variance", "freezing"}
    y[900:, 2], r[600:, 0] = y[900, 2], r[600:, 0] + 0.3
    seen = {(row.kind, row.channel) for row in changes_within(r, y, u).seen}
    assert {("freezing", "y3"), ("mean shift", "y1")} <= seen
    assert any("the first half" in line for line in changes_within(r, y, u).lines())


# Within `identify`


def test_nothing_of_the_model_is_from_the_faulty_part() -> None:
    _, y, u = plain(20)
    other = y.copy()
    other[K:] = 50.0 + 3.0 * np.random.default_rng(21).standard_normal((M, 3))
    one, two = (identify(values, u, order=3, healthy=K, operating_point="means") for values in (y, other))
    assert one.model is not None and two.model is not None and one.residual is not None and two.residual is not None
    for name in "ABCD":
        assert np.array_equal(getattr(one.model, name), getattr(two.model, name))
    assert np.array_equal(one.record.offset, two.record.offset) and np.array_equal(one.residual.x0, two.residual.x0)
    assert np.array_equal(one.residual.r[:K], two.residual.r[:K])
    assert one.changes is not None and not one.changes.seen and one.n_v == 0
    assert two.changes is not None and two.changes.seen and two.n_v != 0 and two.at_least


def test_a_healthy_record_of_its_own_says_what_healthy_samples_say(tmp_path: Any) -> None:
    _, y, u = plain(22)
    y[K + 300 : K + 307, 0] = y[K + 300, 0]  # nothing that a count or a mean sees
    first = identify(y, u, order=3, healthy=K)
    apart = identify(y[K:], u[K:], order=3, healthy=(y[:K], u[:K]))
    text = "\n".join(["a,b,c,d,e", *(",".join(map(repr, row)) for row in np.hstack([u, y]).tolist()[:K])])
    (tmp_path / "healthy.csv").write_text(text)
    channels: dict[str, Any] = {"inputs": ["a", "b"], "outputs": ["c", "d", "e"]}
    of_file = healthy_from(str(tmp_path / "healthy.csv"), recorded(y[K:], u[K:], **channels))
    assert np.array_equal(of_file.y, y[:K]) and np.array_equal(of_file.u, u[:K])
    assert first.model is not None and apart.model is not None
    assert np.array_equal(first.model.A, apart.model.A)
    for answer in (first, apart):
        assert answer.changes is not None and [row.kind for row in answer.changes.seen] == ["freezing"]
        assert answer.n_v is None and answer.at_least == 1 and "something has changed (freezing of " in answer.reason
        document = valid("identify", report.document(answer, "record") | {"files": []})
        assert document["healthy_until"] == K and document["changes"]["rows"][0]["kind"] == "mean shift"
    assert (first.healthy_record, apart.healthy_record) == (False, True) and "those of the healthy record" in apart.summary()
    with pytest.raises(InvalidData, match="both records need the same"):
        identify(y, u, healthy=recorded(y, u, outputs="abc", inputs="de"))
    both = joined(recorded(y, u, outputs="abc", inputs="de"), recorded(y, u, outputs="abc", inputs="de"))
    assert len(both) == 2 * (K + M) and np.array_equal(both.y[K + M :], y)
    assert np.array_equal(both.part(5, len(both)).y, both.y[5:])
