"""Each doubt is raised where its reason was planted, not where it was not, and says what it does and what to do.

Y, U        a clean record of two outputs and one input
PLANTED     kind -> a record with that reason
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import ndtr
from scipy.stats import hypergeom, kstest

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric import StateSpaceModel, arx_reduction, doubts, identify, pi_moesp, record_from
from faultspace.numeric.data.clocks import Clock, clock_from
from faultspace.numeric.plant.doubt.channels import _hypergeometric_tail, limit_chance, written_step
from faultspace.numeric.plant.doubt.listing import DOUBT_LEVEL, KINDS, TESTED
from faultspace.numeric.plant.doubt.one_step_errors import burst_chance, outlier_chance, outlier_sizes, score_chance

N = 800
PLANT = StateSpaceModel([[0.6, 0.5], [-0.5, 0.6]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0]], [[0.4], [0.0]])
RNG = np.random.default_rng(11)
U = RNG.standard_normal((N, 1))
NOISE = 0.1 * RNG.standard_normal((N, 2))
Y = PLANT.simulate(U) + NOISE


def kinds(y: Array, u: Array = U, *, means_removed: bool = False) -> list[str]:
    return [row.kind for row in doubts(record_from(y, u), means_removed=means_removed)]


def closed_loop() -> tuple[Array, Array]:
    u = U.copy()
    u[1:] -= 4 * NOISE[:-1, :1]
    return PLANT.simulate(u) + NOISE, u


def curved() -> tuple[Array, Array]:
    return PLANT.simulate(U + 0.15 * U**2) + NOISE, U


def slipped() -> tuple[Array, Array]:
    y = Y.copy()
    y[300, 1] += 1.0
    return y, U


def bursting() -> tuple[Array, Array]:
    """Return the plant with noise of a GARCH process, alpha .3 and beta .6."""
    variance, white = np.ones(N), np.random.default_rng(9).standard_normal((N, 2))
    for k in range(1, N):
        variance[k] = 0.1 + (0.3 * white[k - 1, 0] ** 2 + 0.6) * variance[k - 1]
    return PLANT.simulate(U) + 0.1 * white * np.sqrt(variance)[:, None], U


PLANTED: dict[str, tuple[Array, Array]] = {
    "closed loop": closed_loop(),
    "non-linearity": curved(),
    "drift": (Y + np.linspace(0, 1, N)[:, None] * [0.3, 0.0], U),
    "outliers": slipped(),
    "bursts": bursting(),
    "limits": (np.clip(Y, -2.0, None), U),
    "constant channel": (np.hstack([Y, np.full((N, 1), 3.0)]), U),
    "copies": (np.hstack([Y, Y[:, :1] - 2 * Y[:, 1:]]), U),
    "operating point": (Y + np.array([0.0, 20.0]), U),
    "units": (Y * [1.0, 1e-9], U),
    "rounding": (np.round(2 * Y) / 2, U),
    "held input": (PLANT.simulate(np.repeat(U[:200], 4, axis=0)) + NOISE, np.repeat(U[:200], 4, axis=0)),
}


def test_a_clean_record_raises_none() -> None:
    found = doubts(record_from(Y, U), arx_reduction(Y, U, order=2))
    assert found.rows == () and found.title == "no doubts" and set(TESTED) <= set(found.asked)
    assert set(found.asked) | set(found.unasked) == set(KINDS) and not set(found.asked) & set(found.unasked)


@pytest.mark.parametrize("kind", PLANTED)
def test_a_planted_doubt_is_seen_with_what_to_do(kind: str) -> None:
    found = doubts(record_from(*PLANTED[kind]))
    (row,) = found.of(kind)
    assert row.evidence and row.effect and row.advice and row.line.startswith(f"{kind}: ")
    assert (row.chance is not None and row.chance < DOUBT_LEVEL) == (kind in TESTED)
    assert [one.kind for one in found] == sorted((one.kind for one in found), key=KINDS.index)


@pytest.mark.parametrize("units", [1e-6, 1e5])
def test_units_and_means_change_no_test(units: float) -> None:
    for kind in TESTED:
        y, u = PLANTED[kind]
        there = [row.chance or 0.0 for row in doubts(record_from(y, u)).of(kind)]
        moved = doubts(record_from(units * y + 3 * units, u / units - 7), means_removed=True)
        assert np.allclose([row.chance or 0.0 for row in moved.of(kind)], there, rtol=0.05), kind


def test_faults_that_set_in_are_no_doubt() -> None:
    v = np.random.default_rng(1).standard_normal(N) * (np.arange(N) >= 400)
    assert kinds(Y + v[:, None] * [0.5, 0.2]) == []


def test_delays_and_slow_modes_are_told_from_the_model() -> None:
    u = np.random.default_rng(2).standard_normal((1500, 1))
    noise = 0.05 * np.random.default_rng(3).standard_normal((1500, 1))
    lag = StateSpaceModel([[0.7]], [[1.0]], [[1.0]], [[0.0]])
    late = np.vstack([np.zeros((3, 1)), lag.simulate(u)[:-3]]) + noise
    (row,) = doubts(record_from(late, u), arx_reduction(late, u, order=4)).of("delay")
    assert row.channels == ("u1", "y1") and "after 4 samples" in row.evidence and "by 3 later" in row.advice
    soon = lag.simulate(u) + noise
    assert len(doubts(record_from(soon, u), arx_reduction(soon, u, order=1))) == 0
    slow = StateSpaceModel([[0.998]], [[1.0]], [[1.0]], [[0.0]]).simulate(u) + noise
    model = arx_reduction(slow, u, order=1)
    asked = doubts(record_from(slow[:1500], u), model, dt=0.1, means_removed=True)
    (row,) = asked.of("slow modes")
    assert "s)" in row.evidence and "integration" in row.effect and asked.of("fast sampling")
    turning = StateSpaceModel([[0.95, 0.31], [-0.31, 0.95]], [[1.0], [0.0]], [[1.0, 0.0]], [[0.0]])
    ringing = turning.simulate(u) + noise
    (row,) = doubts(record_from(ringing, u), arx_reduction(ringing, u, order=2)).rows
    assert row.kind == "slow modes" and "damping" in row.effect


def test_without_noise_or_samples_what_cannot_be_asked_is_said() -> None:
    found = doubts(record_from(PLANT.simulate(U), U))
    assert found.rows == () and "no noise" in found.unasked["drift"]
    short = doubts(record_from(Y[:9], U[:9]))
    assert "too short" in short.unasked["closed loop"] or "samples" in short.unasked["closed loop"]
    rest = np.zeros((9, 2))
    assert "outliers" in doubts(record_from(Y[:9], U[:9]), residual=rest).asked
    with pytest.raises(InvalidData, match="residual: got shape"):
        doubts(record_from(Y, U), residual=rest)
    with pytest.raises(InvalidData, match="Record is needed"):
        doubts(Y)  # type: ignore[arg-type]
    # Any model will do, none included.
    assert len(doubts(record_from(Y, U), pi_moesp(Y, U, order=2, block_rows=10))) == len(doubts(record_from(Y, U))) == 0


def test_one_channel_and_tiny_records_are_no_trouble() -> None:
    for samples in (1, 2, 3, 5, 12, 30):
        for p in (1, 2):
            assert all(row.kind in KINDS for row in doubts(record_from(Y[:samples, :p], U[:samples])))
    assert kinds(np.zeros((50, 1)), np.zeros((50, 1))) == ["constant channel", "constant channel"]


def test_numbers_at_the_end_of_floats_are_no_trouble() -> None:
    rng = np.random.default_rng(8)
    for y, u in (
        (np.full((3, 1), 1e300), np.arange(3.0)[:, None]),
        (1e200 * rng.standard_normal((40, 1)), 1e-200 * rng.standard_normal((40, 1))),
        (rng.standard_normal((300, 3)), np.zeros((300, 1))),
        (rng.standard_cauchy((600, 2)), rng.standard_normal((600, 2))),
        (np.arange(300.0)[:, None], rng.standard_normal((300, 1))),
    ):
        found = doubts(record_from(y, u))
        assert set(found.asked) | set(found.unasked) == set(KINDS)
        json.dumps(found.to_json(), allow_nan=False)


# The tests themselves


def test_chances_of_scores_are_uniform() -> None:
    rng = np.random.default_rng(4)
    chances = [score_chance(rng.standard_normal((400, 3)) * rng.uniform(0.5, 2, 3), 8) for _ in range(300)]
    assert kstest(chances, "uniform").pvalue > 1e-3
    # A variance that grows tenfold, and scores correlated over three samples.
    grown = np.linspace(1, 10, 600)[:, None]
    noise = rng.standard_normal((300, 602, 2))
    chances = [score_chance(grown * (one[2:] + one[1:-1] + one[:-2]), 15) for one in noise]
    assert np.mean(np.array(chances) < 0.05) < 0.1
    assert score_chance(rng.standard_normal((400, 2)) + 0.5, 8) < 1e-6
    assert score_chance(np.zeros((400, 2)), 8) == score_chance(rng.standard_normal((10, 3)), 8) == 1.0


def test_outliers_are_as_seldom_as_is_said() -> None:
    e = np.random.default_rng(5).standard_normal((60_000, 1))
    sizes, width = outlier_sizes(e)
    for t in (2.5, 3.5):
        assert np.mean(sizes > t) <= float(outlier_chance(np.array(t), width)) * 1.1
        assert np.mean(sizes > t) > 0.3 * 2 * ndtr(-t)


def clipped(values: Array, at: float) -> Array:
    return np.minimum(values, at)


def test_limits_are_told_from_signals_that_turn_are_held_or_rounded() -> None:
    rng = np.random.default_rng(6)
    k = np.arange(2000)
    smooth = np.convolve(rng.standard_normal(2040), np.hanning(41), "valid")
    quiet = {
        "white": rng.standard_normal(2000),
        "sine": np.sin(0.05 * k),
        "sine in steps": np.round(20 * np.sin(0.05 * k)),
        "periodic": np.tile(rng.standard_normal(100), 20),
        "steps": rng.integers(0, 4, 2000).astype(float),
        "held": np.repeat(rng.standard_normal(200), 10),
        "binary": np.sign(rng.standard_normal(2000)),
        "smooth": smooth,
        "smooth in steps": np.round(4 * smooth / smooth.std()),
        "at rest": np.minimum(k, 1500.0) + 0.0,
    }
    for (name, values), sign in itertools.product(quiet.items(), (1, -1)):
        chance = limit_chance(sign * values)[0]
        assert chance > DOUBT_LEVEL / 4 or name == "at rest", (name, chance)
    for name in ("white", "smooth", "sine"):
        values = quiet[name]
        assert limit_chance(clipped(values, np.quantile(values, 0.85)))[0] < DOUBT_LEVEL / 10, name


def test_the_step_that_numbers_are_written_in() -> None:
    rng = np.random.default_rng(7)
    assert written_step(np.round(rng.standard_normal(500), 1)) == pytest.approx(0.1)
    assert written_step(rng.standard_normal(500)) is None and written_step(np.sign(rng.standard_normal(500))) is None


# Time


def clock(times: Any, name: str = "t") -> Clock:
    found = clock_from(times, name)
    assert found is not None
    return found


def test_clocks_say_what_is_odd() -> None:
    t = np.arange(300) / 60
    assert clock(np.round(t, 3)).regular and clock(np.round(t, 3)).dt == pytest.approx(1 / 60, rel=1e-3)
    assert clock(1.7e9 + 0.05 * np.arange(300)).regular
    assert clock(np.arange(300.0), "t [ms]").dt == pytest.approx(1e-3)
    gone = np.delete(0.05 * np.arange(300), [100, 101, 200])
    assert (clock(gone).missing, clock(gone).first_odd) == (3, 100) and clock(gone).dt == pytest.approx(0.05)
    jitter = clock(t + 0.002 * np.random.default_rng(1).standard_normal(300))
    assert not jitter.regular and jitter.missing == 0
    back = t.copy()
    back[50] = back[49]
    assert clock(back).backwards == 1 and clock(back).first_odd == 50
    assert clock_from(np.zeros(5), "t") is None and clock_from(np.array(["a", "b"]), "t") is None and clock_from(t[:1], "t") is None
    dates = ["2024-03-01 10:00:00", "2024-03-01 10:00:00.5", "2024-03-01 10:00:01"]
    assert clock(np.array(dates)).dt == 0.5
    assert clock(np.array(["01.03.2024 10:00:00,0", "01.03.2024 10:00:00,5", "01.03.2024 10:00:01,0"])).dt == 0.5
    assert clock(np.array(["23:59:58", "23:59:59"])).dt == 1.0


def test_time_is_a_doubt_where_it_is_odd() -> None:
    record = record_from(Y, U)
    even = replace(record, clock=clock(0.05 * np.arange(N)))
    assert doubts(even).rows == () and "sampling time" in doubts(even).asked
    (row,) = doubts(even, dt=0.1)
    assert row.kind == "sampling time" and "0.1 s was stated" in row.evidence
    gaps = replace(record, clock=clock(0.05 * np.delete(np.arange(N + 1), 70)))
    assert [row.kind for row in doubts(gaps)] == ["missing samples"]
    assert [row.kind for row in doubts(replace(record, clock=clock(np.sort(np.random.default_rng(1).uniform(0, 9, N)))))] == [
        "sampling time"
    ]


def test_identify_has_doubts_and_says_them_once() -> None:
    found = identify(*PLANTED["closed loop"], order=2, dt=0.5)
    assert [row.kind for row in found.doubts or ()] == ["closed loop"]
    text = found.summary()
    assert text.count("closed loop") == text.count("follow what disturbed") == 1 and "## Doubts" in text
    assert "Nyquist frequency 1 Hz" in text and "modes: " in text
    written = found.to_json()
    assert [row["kind"] for row in written["doubts"]["rows"]] == ["closed loop"] and written["dt_from"] == "stated"
    (mode,) = written["modes"]
    z = complex(*mode["pole"])
    assert np.exp(-0.5 / mode["seconds"]) == pytest.approx(abs(z))
    wanted = 2 * np.pi * mode["hertz"] * np.sqrt(1 - mode["damping"] ** 2) * 0.5
    assert wanted == pytest.approx(np.angle(z))
    assert "## Doubts" not in identify(Y, U, order=2).summary() and identify(Y, U, order=2).to_json()["modes"] is None


@pytest.mark.parametrize("seed", range(20))
def test_the_tail_of_the_hypergeometric_law_is_that_of_scipy(seed: int) -> None:
    rng = np.random.default_rng([seed, 18])
    number = int(rng.integers(1, 3000))
    marked, drawn = (int(rng.integers(0, number + 1)) for _ in range(2))
    for least in {0, 1, int(rng.integers(0, min(marked, drawn) + 2)), min(marked, drawn), min(marked, drawn) + 1}:
        found = _hypergeometric_tail(least, number, marked, drawn)
        assert np.isclose(found, hypergeom(number, marked, drawn).sf(least - 1), rtol=1e-7, atol=1e-300)


def test_the_law_of_bursts_holds_for_any_law_of_noise_and_a_power_that_rises_once_is_none() -> None:
    draw = np.random.default_rng(4)
    rises = 1.0 + 2.0 * (np.arange(600) >= 240)
    made: dict[str, Callable[[Array], Array]] = {
        "normal": lambda e: e,
        "heavy": lambda e: e / np.sqrt(draw.chisquare(4, 600)),
        "two values": np.sign,
        "rises": lambda e: rises * e,
        "rises coloured": lambda e: np.where(rises > 1.0, lfilter([1.0], [1.0, -0.7], e), e),
    }
    for name, make in made.items():
        chances = np.array([burst_chance(make(draw.standard_normal(600))) for _ in range(200)])
        assert np.sum(chances < 0.01) <= 8, name  # of 200, five deviations of a binomial count
    assert burst_chance(np.ones(600)) == 1.0 and burst_chance(np.arange(50.0)) == 1.0
