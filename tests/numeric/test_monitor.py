"""The monitor: its predictor against a slow Kalman filter, its tests against their definitions, its rate of false alarms, its alarms.

watched     a monitor of a plant of two outputs, calibrated on a healthy record
record      that plant: y, u, with a fault where one is asked for
"""

from __future__ import annotations

import json
from copy import deepcopy
from functools import lru_cache
from typing import Any

import numpy as np
import pytest
import scipy.stats

import faultspace as fs
from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.base.progress import silent
from faultspace.numeric import Alarm, Monitor, StateSpaceModel, arx_reduction
from faultspace.numeric.plant.monitor import thresholds
from faultspace.numeric.plant.monitor.innovation_form import Predictor, innovation_form
from faultspace.numeric.plant.monitor.statistics import TESTS, Bank, Settings, checked, roots
from faultspace.numeric.plant.monitor.thresholds import ideal_thresholds, largest_of_blocks, simulated

PLANT = StateSpaceModel([[0.8, 0.3], [-0.3, 0.7]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0]], [[0.0], [0.2]])
NOTHING = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.zeros((2, 1)))
NOISE, WINDOW = 0.1, 10


def record(seed: int, samples: int, *, colour: float = 0.0) -> tuple[Any, Any]:
    """Return y, u with noise of the deviation NOISE, autoregressive by `colour`."""
    draw = np.random.default_rng(seed)
    u, noise = draw.standard_normal((samples, 1)), draw.standard_normal((samples, 2))
    for k in range(1, samples):
        noise[k] = colour * noise[k - 1] + np.sqrt(1 - colour**2) * noise[k]
    return PLANT.simulate(u, x0=[3.0, -2.0]) + NOISE * noise + [5.0, -100.0], u


@lru_cache
def calibrated(model: StateSpaceModel, level: float, colour: float, seed: int, samples: int) -> Monitor:
    return Monitor(model, *record(seed, samples, colour=colour), level=level, window=WINDOW)


def made(model: StateSpaceModel = PLANT, *, level: float = 1e-3, colour: float = 0.0, seed: int = 1, samples: int = 800) -> Monitor:
    """Return a monitor of the plant that has seen nothing yet."""
    return deepcopy(calibrated(model, level, colour, seed, samples))


@pytest.fixture
def watched() -> Monitor:
    return made()


def same(first: Any, second: Any) -> bool:
    """Say whether two arrays are the same bytes."""
    return bool(np.asarray(first).tobytes() == np.asarray(second).tobytes())


@pytest.mark.parametrize(("model", "gaps"), [(PLANT, 0.1), (NOTHING, 0.0)])
def test_one_by_one_and_all_at_once_are_the_same_bytes(model: StateSpaceModel, gaps: float) -> None:
    y, u = record(2, 300)
    y[200:, 0] += 0.6
    draw = np.random.default_rng(0)
    y[draw.random(y.shape) < gaps] = np.nan
    u[draw.random(u.shape) < gaps / 10] = np.nan
    whole, single, parts = made(model), made(model), made(model)
    seen = whole.extend(y, u)
    alarms: list[Alarm] = []
    statistics = []
    for sample, pushed in zip(y, u, strict=True):
        alarms += single.update(sample, pushed)
        statistics.append(single.statistics)
    pieces = [parts.extend(y[i : i + 37], u[i : i + 37]) for i in range(0, 300, 37)]
    assert alarms == list(seen.alarms) == [alarm for piece in pieces for alarm in piece.alarms] and alarms
    assert same(statistics, seen.statistics) and same(np.vstack([piece.statistics for piece in pieces]), seen.statistics)
    assert same(np.vstack([piece.innovations for piece in pieces]), seen.innovations)


def slow_filter(form: Any, y: Any, u: Any) -> list[Any]:
    """Return the whitened innovations of a Kalman filter as a textbook has it, the joint covariance of state and output held whole."""
    units, found = form.units, []
    x, P = np.zeros(len(form.A)), 100 * form.unknown
    for sample, pushed in zip((y - units.centre) / units.scale, (u - units.input_centre) / units.input_scale, strict=True):
        mean = np.concatenate([form.A @ x + form.B @ pushed + form.push, form.C @ x + form.D @ pushed + form.level])
        step = np.vstack([np.hstack([form.A, form.K]), np.hstack([form.C, np.eye(form.p)])])
        middle = np.zeros((len(x) + form.p,) * 2)
        middle[: len(x), : len(x)], middle[len(x) :, len(x) :] = P, form.covariance
        joint = step @ middle @ step.T
        d, seen = len(x), [len(x) + i for i in range(form.p) if np.isfinite(sample[i])]
        gain = joint[:, seen] @ np.linalg.inv(joint[np.ix_(seen, seen)])
        e = sample[[i - d for i in seen]] - mean[seen]
        after, left = mean + gain @ e, joint - gain @ joint[seen]
        found.append(np.linalg.solve(np.linalg.cholesky(joint[d:, d:]), (after - mean)[d:]))
        x, P = after[:d], left[:d, :d]
    return found


@pytest.mark.parametrize("gaps", [0.0, 0.2])
def test_the_predictor_is_the_kalman_filter(gaps: float) -> None:
    form = innovation_form(PLANT, *record(1, 800, colour=0.7), with_inputs=True).form
    y, u = record(2, 120, colour=0.7)
    y[np.random.default_rng(3).random(y.shape) < gaps] = np.nan
    predictor = Predictor(form)
    steps = [predictor.step(sample, pushed) for sample, pushed in zip(y, u, strict=True)]
    found = [np.zeros(2) if step is None else step[0] for step in steps]
    assert form.lags > 0 and np.allclose(found, slow_filter(form, y, u), atol=1e-6)


@pytest.mark.parametrize(("model", "colour"), [(PLANT, 0.8), (NOTHING, 0.0)])
def test_innovations_are_white_of_deviation_one_from_the_first_sample_on(model: StateSpaceModel, colour: float) -> None:
    watch = made(model, colour=colour, samples=2000)
    z = watch.extend(*record(5, 1200, colour=colour)).innovations
    assert np.all(np.abs(z[:5]) < 5)
    for lag in range(4):
        moments = z[lag:].T @ z[: len(z) - lag] / len(z)
        assert np.allclose(moments, np.eye(2) if lag == 0 else 0, atol=0.12)


def loop(pole: float, seed: int, samples: int) -> tuple[Any, Any]:
    """Return y, u of x(k+1) = pole x + u in the loop u = -.5 y + noise."""
    draw, x = np.random.default_rng(seed), 0.0
    y, u = np.zeros((samples, 1)), np.zeros((samples, 1))
    for k in range(samples):
        y[k] = x + NOISE * draw.standard_normal()
        u[k] = -0.5 * y[k] + NOISE * draw.standard_normal()
        x = pole * x + u[k, 0]
    return y, u


@pytest.mark.parametrize(("pole", "gap", "anew"), [(1.002, 20_000, 1), (1.002, 45_000, 1), (1.05, 2_000, 1), (1.2, 300, 1), (1.2, 80, 0)])
def test_after_a_gap_an_unstable_plant_is_watched_as_before(pole: float, gap: int, anew: int) -> None:
    watch = Monitor(StateSpaceModel([[pole]], [[1.0]], [[1.0]], [[0.0]]), *loop(pole, 1, 2000))
    y, u = loop(pole, 2, 900 + gap)
    y[200 : 200 + gap] = np.nan
    z = watch.extend(y[: 800 + gap], u[: 800 + gap])
    assert [alarm.test for alarm in z.alarms] == ["missing"]
    assert all(abs(part.std() - 1) < 0.15 for part in (z.innovations[:200], z.innovations[200 + gap :]))
    assert watch.begun_anew == anew and ("state unknown again" in watch.summary()) == bool(anew)
    y[800 + gap :] += 50 * NOISE
    assert [alarm.sample for alarm in watch.extend(y[800 + gap :], u[800 + gap :]).alarms] == [pytest.approx(800 + gap, abs=1)] * len(TESTS)
    json.dumps(watch._state(), allow_nan=False)


def test_an_unstable_plant_is_found_again_behind_wild_numbers() -> None:
    watch = Monitor(StateSpaceModel([[1.2]], [[1.0]], [[1.0]], [[0.0]]), *loop(1.2, 1, 2000))
    y, u = loop(1.2, 2, 1500)
    y[200:500:2], y[201:500:2] = 1e9, 1e308
    seen = watch.extend(y, u)
    assert seen.alarms and {alarm.sample for alarm in seen.alarms} == {200}
    assert abs(seen.innovations[700:].std() - 1) < 0.15 and not np.any((seen.statistics > watch.calibration.threshold)[700:, :3])


@pytest.mark.parametrize("size", [1.0, 1e-160])
def test_what_the_caller_told_numpy_of_floats_changes_nothing(size: float) -> None:
    y, u = record(2, 300)
    y[:, 0] *= size  # whose squares no float holds
    plant = StateSpaceModel(PLANT.A, PLANT.B, PLANT.C * [[size], [1.0]], PLANT.D * [[size], [1.0]])
    healthy, pushed = record(1, 800)
    healthy[:, 0] *= size
    quiet = Monitor(plant, healthy, pushed, level=1e-3, window=WINDOW).extend(y, u)
    with np.errstate(all="raise"):
        watch = Monitor(plant, healthy, pushed, level=1e-3, window=WINDOW)
        loud = watch.extend(y, u)
        for wild in ([1e308, np.nan], [-1e308, 1e308], [np.inf, np.nan]):
            watch.update(wild, u[0])
    assert same(loud.statistics, quiet.statistics)


def test_the_statistics_are_what_they_are_said_to_be() -> None:
    settings = Settings(p=2, window=6, shift=1.0)
    draw = np.random.default_rng(1)
    z, s = draw.standard_normal((200, 2)), draw.standard_normal((200, 2))
    z[120:] += 1.5
    bank, rows, memory = Bank(settings, 1), settings.rows, settings.memory
    found = np.array([bank.update(one[None], other[None])[0] for one, other in zip(z, s, strict=True)])
    S, M, v = np.zeros(2), np.eye(2 * rows), np.full(2 * rows, (2 * rows) ** -0.5)
    padded = np.vstack([np.zeros((rows, 2)), z])
    for k in range(200):
        C = np.linalg.norm(S + z[k])
        S = np.zeros(2) if C <= 0.5 else (S + z[k]) * (1 - 0.5 / C)
        h = padded[k + 1 : k + 1 + rows].ravel()
        M = M + (np.outer(h, h) - M) / memory
        v = M @ v
        expected = [np.abs(s[k]).max(), np.sum(z[max(k - 5, 0) : k + 1] ** 2), np.linalg.norm(S), np.linalg.norm(v)]
        v = v / np.linalg.norm(v)
        if k >= 5:
            assert np.allclose(found[k], expected)
    assert np.allclose(roots(bank.moments[0])[0], found[-1, 3], rtol=0.05)  # the power method has followed


def test_a_ceiling_changes_no_crossing_below_it() -> None:
    settings, z = Settings(p=2, window=6, shift=1.0), np.random.default_rng(1).standard_normal((300, 1, 2)) + 0.8
    free, held = Bank(settings, 1), Bank(settings, 1, 20.0)
    pairs = np.array([[bank.update(one, one)[0, 2] for bank in (free, held)] for one in z])
    assert pairs[:, 0].max() > 30 and pairs[:, 1].max() == 20.0
    assert np.array_equal(pairs[:, 0] > 15, pairs[:, 1] > 15)


def test_thresholds_have_the_stated_rate_on_streams_that_they_were_not_made_of() -> None:
    settings, rate, streams, samples = Settings(p=2, window=WINDOW, shift=1.0), 3e-4, 64, 1000
    threshold = ideal_thresholds(settings, rate)
    draw, bank = np.random.default_rng(99), Bank(settings, streams)
    above, episodes = np.zeros((streams, 4), bool), np.zeros(4)
    quiet = np.full((streams, 4), settings.memory)
    for k in range(-2 * settings.memory, samples):
        z = draw.standard_normal((streams, 2))
        above = bank.update(z, z) > threshold
        if k >= 0:
            episodes += np.sum(above & (quiet >= settings.window), axis=0)
        quiet = np.where(above, 0, quiet + 1)
    due = rate * streams * samples
    assert np.all(episodes <= scipy.stats.poisson.isf(1e-4, due)) and np.all(episodes[[0, 2, 3]] >= due / 3) and episodes[1] >= due / 10
    assert np.allclose(threshold[:2], [scipy.stats.norm.isf(rate / 4), scipy.stats.chi2.isf(rate, 20)])
    assert np.all(np.diff([ideal_thresholds(settings, one) for one in (1e-1, 1e-2, 1e-3, 1e-6)], axis=0) > 0)


def test_streams_are_simulated_in_parts_where_their_numbers_are_many(monkeypatch: pytest.MonkeyPatch) -> None:
    settings, held = Settings(p=1, window=5, shift=1.0), []
    whole = thresholds._simulated(settings, silent)

    def bank(settings: Settings, streams: int) -> Bank:
        held.append(streams)
        return Bank(settings, streams)

    monkeypatch.setattr(thresholds, "Bank", bank)
    monkeypatch.setattr(thresholds, "HELD", 30 * settings.numbers)
    told: list[int] = []
    parts = thresholds._simulated(settings, lambda _, done, of: told.append(done if done <= of else -1))
    assert held == [30, 30, 30, 30, 8] and told == sorted(told) and told[-1] == 128 * 22 * settings.memory
    assert parts.shape == whole.shape and np.allclose(parts.mean(axis=0), whole.mean(axis=0), rtol=0.02)
    for outputs, window, words in ((1449, 2, "outputs: got 1449; needed 1448 at most"), (1, 4 * 10**6, "window: got 4000000")):
        with pytest.raises(InvalidData, match=words):
            checked(Settings(outputs, window, 1.0))


@pytest.mark.slow
@pytest.mark.parametrize(("model", "colour"), [(PLANT, 0.0), (PLANT, 0.8), (NOTHING, 0.5)])
def test_false_alarms_on_fresh_records_are_no_more_than_stated(model: StateSpaceModel, colour: float) -> None:
    counts = []
    for seed in range(5):
        watch = made(model, colour=colour, seed=seed, samples=4000)
        counts.append(len(watch.extend(*record(100 + seed, 4000, colour=colour)).alarms))
    assert sum(counts) <= scipy.stats.poisson.isf(1e-3, 20.0)


def calibrate(settings: Settings, level: float, errors: Array) -> thresholds.Calibration:
    return thresholds.calibrated(settings, level, largest_of_blocks(settings, errors, errors), len(errors))


def test_healthy_errors_that_are_larger_raise_the_thresholds_and_smaller_ones_do_not_lower_them() -> None:
    settings = Settings(p=2, window=WINDOW, shift=1.0)
    z = np.random.default_rng(4).standard_normal((1000, 2))
    plain, loud, faint = (calibrate(settings, 1e-3, size * z) for size in (1.0, 1.5, 0.5))
    assert np.all(loud.threshold > 1.3 * plain.ideal) and np.array_equal(faint.threshold, faint.ideal)
    assert "thresholds are raised, that of" in loud.notes[1] and len(plain.notes) == 1
    assert plain.needed == 10_000 and "1000 healthy samples cannot show" in plain.notes[0]
    z[::400] *= 20
    assert any("is not steady" in note for note in calibrate(settings, 1e-2, z).notes) or np.all(
        calibrate(settings, 1e-2, z).threshold[:2] > 2 * plain.ideal[:2]
    )


@pytest.mark.parametrize("output", [0, 1])
@pytest.mark.parametrize("fault", ["step", "drift", "sinusoid"])
def test_an_alarm_names_the_output_and_the_onset(fault: str, output: int) -> None:
    watch = made(level=1e-4)
    y, u = record(7, 400)
    after = np.arange(200)
    signal = {"step": np.full(200, 4.0), "drift": 0.1 * after, "sinusoid": 6 * np.sin(after)}[fault]
    y[200:, output] += NOISE * signal
    alarms = watch.extend(y, u).alarms
    assert alarms and all(alarm.sample >= 200 for alarm in alarms) and alarms[0].sample < 260
    assert watch.outputs[output] == alarms[0].outputs[0] and abs(alarms[0].onset - 200) < 50
    assert {alarm.test for alarm in alarms} <= set(TESTS)


def test_windows_and_cusum_find_the_sample_of_a_step() -> None:
    watch = made(level=1e-4)
    y, u = record(20, 300)
    y[200:, 0] += 5 * NOISE
    onsets = {alarm.test: alarm.onset for alarm in reversed(watch.extend(y, u).alarms)}
    assert set(onsets) >= {"chi-square", "cusum", "hankel"} and all(198 <= onset <= 202 for onset in onsets.values())


def test_a_healthy_record_may_begin_in_the_middle_of_a_transient() -> None:
    slow, draw = StateSpaceModel([[0.97]], [[1.0]], [[1.0]], [[0.0]]), np.random.default_rng(1)

    def drawn(start: float) -> tuple[Any, Any]:
        u = draw.standard_normal((600, 1))
        return slow.simulate(u, x0=[start]) + 0.01 * draw.standard_normal((600, 1)), u

    watch = Monitor(slow, *drawn(200.0), level=1e-3, window=WINDOW)
    form = watch._form
    assert form.lags == 0 and abs(np.sqrt(form.covariance[0, 0]) * form.units.scale[0] / 0.01 - 1) < 0.08
    assert abs(watch.extend(*drawn(0.0)).innovations[50:].std() - 1) < 0.15


def test_the_rank_gap_counts_the_signals_of_the_faults() -> None:
    for faults in (1, 2):
        watch = made(level=1e-4)
        y, u = record(8, 900)
        y[300:, :faults] += 8 * NOISE * np.random.default_rng(5).standard_normal((600, faults))
        last = [watch.extend(y[:300], u[:300]), watch.extend(y[300:], u[300:])][1]
        assert last.alarms and watch._rank_gap() == faults


def test_an_alarm_ends_and_another_begins() -> None:
    watch = made(level=1e-4)
    y, u = record(9, 900)
    for first in (200, 600):
        y[first : first + 40] += 10 * NOISE
    alarms = [alarm for alarm in watch.extend(y, u).alarms if alarm.test == "cusum"]
    assert len(alarms) == 2 and alarms[0].sample < 210 and 600 <= alarms[1].sample < 610


def test_missing_samples_are_no_fault_and_a_dead_output_is_told(watched: Monitor) -> None:
    y, u = record(10, 600)
    y[np.random.default_rng(1).random(y.shape) < 0.2] = np.nan
    assert len(watched.extend(y, u).alarms) <= 4 and np.all(watched.missing > 80)
    watched.restart()
    y, u = record(11, 100)
    y[40:, 1] = np.nan
    told = [alarm for alarm in watched.extend(y, u).alarms if alarm.test == "missing"]
    assert [(one.sample, one.outputs, one.onset) for one in told] == [(600 + 40 + WINDOW - 1, ("y2",), 640)]
    everything = np.full((30, 2), np.nan)
    before = watched.untested
    assert np.all(np.isnan(watched.extend(everything, np.zeros((30, 1))).statistics)) and watched.untested == before + 30


def test_a_fault_is_seen_through_missing_samples(watched: Monitor) -> None:
    y, u = record(12, 400)
    y[200:, 0] += 8 * NOISE
    y[np.random.default_rng(1).random(y.shape) < 0.2] = np.nan
    alarms = watched.extend(y, u).alarms
    assert any(200 <= alarm.sample < 220 and alarm.outputs[0] == "y1" for alarm in alarms)


@pytest.mark.parametrize("wild", [1e300, -1e12, float("inf")])
def test_a_wild_sample_is_an_alarm_and_then_forgotten(watched: Monitor, wild: float) -> None:
    y, u = record(18, 900)
    y[100, 0], u[500, 0] = wild, wild
    seen = watched.extend(y, u)
    assert ([alarm.sample for alarm in seen.alarms if alarm.sample < 101] == [100] * 4) == np.isfinite(wild)
    assert np.all(seen.statistics[[400, -1]] < watched.calibration.threshold) and np.all(np.isnan(seen.statistics[500]))


def test_a_stream_may_begin_where_the_healthy_record_has_not_been(watched: Monitor) -> None:
    y, u = record(19, 300)
    u = u + 8.0
    y = y + PLANT.simulate(np.full((300, 1), 8.0), x0=np.linalg.solve(np.eye(2) - PLANT.A, PLANT.B @ [8.0]))
    assert [alarm.title for alarm in watched.extend(y, u).alarms if alarm.sample < 20] == []


def test_a_restart_and_a_pause_of_unknown_length_raise_no_alarm(watched: Monitor) -> None:
    y, u = record(13, 200)
    watched.extend(y[:100], u[:100])
    before = dict(watched.alarms)
    watched.restart()
    y2, u2 = record(14, 60)
    watched.extend(y2, u2)
    assert watched.samples == 160 and sum(watched.alarms.values()) - sum(before.values()) <= 1


def test_an_operating_point_that_the_model_does_not_know_is_an_alarm_that_says_so(watched: Monitor) -> None:
    y, u = record(15, 300)
    u[200:] += 10
    y[200:] = y[200:] - PLANT.simulate(u)[200:] + PLANT.simulate(u)[200:] ** 3 / 100
    alarms = watched.extend(y, u).alarms
    assert alarms and alarms[0].inputs_beyond == ("u1",) and "inputs beyond the healthy record: u1" in alarms[0].line


def test_units_do_not_matter() -> None:
    y, u = record(1, 800)
    more, push = record(2, 200)
    scale, at = np.array([1e6, 1e-6]), np.array([1e7, 0.0])
    small = Monitor(PLANT, y, u, level=1e-3, window=WINDOW)
    scaled = StateSpaceModel(PLANT.A, PLANT.B / 1e-3, PLANT.C * scale[:, None], PLANT.D * scale[:, None] / 1e-3)
    large = Monitor(scaled, y * scale + at, u * 1e-3, level=1e-3, window=WINDOW)
    assert np.allclose(small.extend(more, push).statistics, large.extend(more * scale + at, push * 1e-3).statistics, rtol=1e-4)


def test_models_of_every_kind_bring_or_are_given_what_is_healthy() -> None:
    y, u = record(1, 900)
    reduced = arx_reduction(y, u, order=2)
    alone = Monitor(reduced, level=1e-3, window=WINDOW)
    assert "no healthy record was given" in alone.notes[0] and alone.to_json()["healthy_samples"] > 4000
    found = fs.identify(y[:300], u[:300], order=2, healthy=200)
    about_means = fs.identify(y[:300], u[:300], order=2, healthy=200, operating_point="means")
    brought, also = (Monitor(one, level=1e-3, window=WINDOW) for one in (found, about_means))
    assert 150 <= brought.calibration.samples <= 200
    more = record(2, 200)
    assert np.allclose(also.extend(*more).innovations, brought.extend(*more).innovations, atol=0.5)
    inputless = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 0)), np.zeros((1, 0)), np.zeros((1, 0)))
    noise = np.random.default_rng(1).standard_normal((900, 1))
    assert Monitor(inputless, noise, level=1e-3, window=WINDOW).extend(noise[:50]).statistics.shape == (50, 4)


def test_what_cannot_be_used_is_refused_in_a_line() -> None:
    y, u = record(1, 600)
    still = y.copy()
    twin = StateSpaceModel(PLANT.A, PLANT.B, PLANT.C[[0, 1, 0]], PLANT.D[[0, 1, 0]])
    still[:, 0] = 1.0
    for words, call in (
        ("model: got 3; needed", lambda: Monitor(3, y, u)),
        ("healthy: got no record without fault", lambda: Monitor(PLANT)),
        ("level: got 0.5", lambda: Monitor(PLANT, y, u, level=0.5)),
        ("shift: got -1", lambda: Monitor(PLANT, y, u, shift=-1)),
        ("window: got 1", lambda: Monitor(PLANT, y, u, window=1)),
        ("healthy: got 1 output and 1 input; the model has 2 outputs", lambda: Monitor(PLANT, y[:, :1], u)),
        ("healthy: got 12 samples", lambda: Monitor(PLANT, y[:12], u[:12])),
        ("are too few to calibrate", lambda: Monitor(PLANT, y[:100], u[:100])),
        ("healthy: the model explains an output to rounding", lambda: Monitor(PLANT, PLANT.simulate(u), u)),
        ("healthy: output 1 of the model is constant (1)", lambda: Monitor(PLANT, still, u)),
        ("healthy: an output is an exact combination", lambda: Monitor(twin, y[:, [0, 1, 0]], u)),
        ("y: got (1.0, 2.0, 3.0)", lambda: made().update((1.0, 2.0, 3.0), (1.0,))),
        ("y: got [1000", lambda: made().update([10**400, 1.0], (1.0,))),
        ("y: got", lambda: made().update(np.array([1.0, 2j]), (1.0,))),
        ("y: got shape", lambda: made().extend(1j * y[:3], u[:3])),
        ("it looks transposed", lambda: made().extend(y[:3].T, u[:3])),
        ("u: got shape (2, 1); needed (3, 1)", lambda: made().extend(y[:3], u[:2])),
        ("a mode of modulus 1.2", lambda: Monitor(StateSpaceModel([[1.2]], [[1.0]], [[0.0], [0.0]], [[0.0], [0.0]]), y, u)),
    ):
        with pytest.raises(InvalidData) as refused:
            call()
        assert words in str(refused.value) and "\n" not in str(refused.value)


def test_people_and_programs_read_it(watched: Monitor) -> None:
    y, u = record(16, 100)
    y[50:] += 1.0
    seen = watched.extend(y, u)
    for one in (watched, seen, seen.alarms[0]):
        assert json.loads(json.dumps(one.to_json(), allow_nan=False)) and one.summary().splitlines()[0] == one.title
        assert max(map(len, one.summary().splitlines())) <= 80 and len(repr(one)) < 120 and "<table" in one._repr_html_()
    assert repr(watched) == "<Monitor: monitor of 2 outputs and 1 input, 0.001 false alarms a sample>"


def test_a_sample_costs_the_same_whatever_came_before(watched: Monitor) -> None:
    def held() -> int:
        state = [*vars(watched).values(), *vars(watched._bank).values(), *vars(watched._predictor).values()]
        return sum(one.size for one in state if isinstance(one, np.ndarray))

    y, u = record(17, 300)
    watched.extend(y[:150], u[:150])
    before = held()
    watched.extend(y[150:], u[150:])
    assert held() == before and not simulated(watched._settings).flags.writeable
