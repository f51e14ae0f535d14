"""The methods beside the monitor are what they are said to be: parity space, PCA and dynamic PCA, thresholds of one rate for all."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.stats

from benchmarks.long_watch import compared
from benchmarks.monitoring import BLOCK, Plant, block_threshold, delay_cell, first_run
from benchmarks.monitoring_methods import averaged, components, parity_space, principal
from faultspace.numeric import StateSpaceModel
from tests.thorough import THOROUGH


def test_the_parity_vector_knows_neither_state_nor_input_and_its_square_is_chi_squared() -> None:
    draw = np.random.default_rng(1)
    model = StateSpaceModel([[0.8, 0.3], [-0.3, 0.7]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0]], [[0.0], [0.2]])

    def record(samples: int, size: float) -> tuple[np.ndarray, np.ndarray]:
        u = size * draw.standard_normal((samples, 1))
        return model.simulate(u, x0=[size, -size]) + 0.1 * draw.standard_normal((samples, 2)), u

    method = parity_space(model, *record(3000, 1.0))
    found = method.of(*record(2000, 100.0))[:, 0]
    assert np.all(np.isnan(found[:2])) and scipy.stats.kstest(found[2::3], scipy.stats.chi2(3 * 2 - 2).cdf).pvalue > 1e-3


def test_principal_components_split_what_they_keep_from_what_they_leave() -> None:
    draw = np.random.default_rng(2)
    mixing = draw.standard_normal((2, 6))

    def record(samples: int) -> tuple[np.ndarray, np.ndarray]:
        both = draw.standard_normal((samples, 2)) @ mixing + 0.1 * draw.standard_normal((samples, 6))
        return both[:, :4], both[:, 4:]

    y, u = record(2000)
    assert components(np.corrcoef(np.hstack([y, u]).T), 2000) == 2
    method = principal(y, u)
    y, u = record(2000)
    kept, left = method.of(y, u).T
    assert scipy.stats.kstest(kept, scipy.stats.chi2(2).cdf).pvalue > 1e-3
    mean = averaged(principal(y, u, lags=2), 20).of(y, u)
    assert np.isnan(mean[1]).all() and np.allclose(mean[100], principal(y, u, lags=2).of(y, u)[81:101].mean(axis=0))
    y[:, 0] += 1.0  # breaks the relation of the channels
    assert np.median(method.of(y, u)[:, 1]) > 10 * np.median(left)
    assert method.names == ("PCA T2", "PCA Q") and principal(y, u, lags=2).of(y, u).shape == (2000, 2)


def test_thresholds_are_exceeded_in_the_share_of_blocks_of_the_rate() -> None:
    values = np.random.default_rng(3).standard_normal((100_000, 2))
    maxima = values.reshape(-1, BLOCK, 2).max(axis=1)
    assert np.allclose(np.mean(maxima > block_threshold(values, 1e-3), axis=0), 1 - np.exp(-0.1), atol=2e-3)


def test_delays_count_what_is_not_found_and_runs_need_six() -> None:
    assert delay_cell([1.0, 3.0]) == "2.0" and delay_cell([0.0, float("nan")]) == "100.0 (0.50)"
    above = np.zeros(40, bool)
    above[[3, 4, 5, 6, 7, *range(20, 30)]] = True
    assert first_run(above) == "20" and first_run(above[:20]) == "-"


def test_a_fault_begins_where_it_is_said_to() -> None:
    first, second = (Plant(np.random.default_rng(1), 0.0) for _ in range(2))
    y, _ = first.faulty("sensor", "step", 1000)
    assert np.abs(np.diff(y, axis=0)).max(axis=1).argmax() == 149
    z, _ = second.faulty("actuator", "sinusoid", 0.0)
    assert z.shape == y.shape == (350, 3)


def test_a_disturbed_watch_gives_the_alarms_of_an_undisturbed_one(tmp_path: Path) -> None:
    found = compared(100_000 if THOROUGH else 6000, 500, 1, tmp_path)
    assert found.kills and found.undisturbed and found.disturbed == found.undisturbed
    assert found.late < found.early + 16  # MiB, of an interpreter that holds some 80
