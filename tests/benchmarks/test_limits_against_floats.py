"""Floats meet exact limits in the benchmarks too: comparisons are right, wrong limits are seen, past outputs are as biased as predicted."""

from __future__ import annotations

import shutil
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks import limits_against_floats as room
from benchmarks import past_outputs_bias
from benchmarks.identification_data import ORDER, Setting, errors, record
from benchmarks.limits_against_floats import ERRORS, METHODS, chosen, compared, distance, drawn, expected, sample_limits, table
from benchmarks.past_outputs_bias import benchmark_experiment, examined, free_order, predicted
from faultspace.exact.limits.moesp import PopulationLimits, limit
from faultspace.numeric.method.model.past_outputs import po_moesp
from faultspace.proofs.evidence.experiments import FAMILIES
from tests.numeric.predicted_limits import invariants, predicted_model

LEADING = "u white, v leads it"
CELL = Setting(1, 1, 10, 100_000)


@cache
def benchmark_limits() -> PopulationLimits:
    return limit(benchmark_experiment(CELL))


def rows_of(family: str, seeds: int = 6) -> list[Any]:
    return list(compared(family, chosen(family), [1000, 20_000], seeds))


def test_the_sample_limits_are_what_the_hankel_matrices_give() -> None:
    random = np.random.default_rng(1)
    y, u, s, past = random.standard_normal((60, 2)), random.standard_normal((60, 3)), 3, 2
    columns = 60 - s - past + 1
    hankel = {
        name: np.vstack([z[k : k + columns].T for k in lags])
        for name, z, lags in (("uf", u, range(2, 5)), ("yf", y, range(2, 5)), ("up", u, range(2)), ("yp", y, range(2)))
    }
    free = hankel["yf"] - hankel["yf"] @ np.linalg.pinv(hankel["uf"]) @ hankel["uf"]
    first, second = sample_limits(y, u, s, past)
    assert np.allclose(first, free @ hankel["up"].T / columns)
    assert np.allclose(second, free @ np.vstack([hankel["up"], hankel["yp"]]).T / columns)


# The search for experiments of this family goes through minutes of exact algebra.
LONG = "u white, v(k) = K u(k-1), B and D right by output error"


def marked(family: str) -> Any:
    """Return the family, and whether it is looked at in every run."""
    return pytest.param(family, marks=[pytest.mark.slow, pytest.mark.timeout(1200)] if family == LONG else [])


@pytest.mark.parametrize("family", [marked(one) for one in FAMILIES])
def test_every_family_has_an_experiment_and_an_exact_limit(family: str) -> None:
    found = chosen(family)
    one_state = family == "u white, v(k) = K u(k-1), B and D right by output error"
    assert found.experiment.system.residual.n == (1 if one_state else 2) and found.past_inputs.rank
    exact = expected(found)
    for method, one in zip(METHODS, (found.past_inputs, found.past_outputs), strict=True):
        assert exact[method, "L"].size == one.matrix.nrows * one.matrix.ncols
        assert ((method, "model") in exact) == (one.state is not None)


def test_floats_tend_to_the_limit_and_right_models_are_told(tmp_path: Path) -> None:
    rows = rows_of(LEADING) + rows_of("u white, v(k) = u(k)")
    assert {(row.method, row.what) for row in rows} == {(method, what) for method in METHODS for what in ("L", "model")}
    for row in rows:
        assert row.standard_errors < 2 * ERRORS  # six seeds: the tails of Student's t with five degrees of freedom are long
        assert (row.slope is None) == (row.family != LEADING and row.what == "model")
        assert row.slope is None or -0.9 < row.slope < -0.2
    sheet = table(rows)
    assert [line[-2] for line in sheet.rows].count("right at every N") == 2
    drawn(rows, tmp_path / "floats.png")
    assert (tmp_path / "floats.png").read_bytes().startswith(b"\x89PNG")


def test_a_wrong_limit_is_seen(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """One and a half times the limit in its place: the command fails and says where."""
    monkeypatch.setattr(room, "FAMILIES", {LEADING: FAMILIES[LEADING]})
    monkeypatch.setattr(room, "expected", lambda found: {key: 1.5 * vector for key, vector in expected(found).items()})
    assert room.main(["--largest", "20000", "--seeds", "8"]) == 1
    out, complaint = capsys.readouterr()
    assert LEADING in out and "standard errors from the limit" in complaint


def test_distances_are_in_standard_errors() -> None:
    table = np.array([[1.0, 0.0], [3.0, 0.0]])  # mean 2, standard error 1
    assert distance(table, np.array([5.0, 0.0])) == pytest.approx(3.0)
    assert distance(table, np.array([2.0, 0.1])) > 1e6


def test_what_cannot_be_run_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    for command, arguments in (
        (room.main, ["--seeds", "2"]),
        (past_outputs_bias.main, ["--largest", "10"]),
        (past_outputs_bias.main, ["--peer-python", "/nonexistent/python"]),
    ):
        with pytest.raises(SystemExit, match="2"):
            command(arguments)
        assert "error: got --" in capsys.readouterr().err


def test_the_bias_of_past_outputs_is_predicted() -> None:
    """The errors of the exact limit at the true order agree with those of one record of the benchmark."""
    found = benchmark_limits()
    right = errors(predicted(found, ORDER, past_outputs=False)[0], 1, 1)
    biased = errors(predicted(found, ORDER, past_outputs=True)[0], 1, 1)
    assert max(right) < 1e-9 and min(biased) > 0.05
    y, u = record(CELL)
    seen = errors(po_moesp(y, u, order=ORDER, block_rows=CELL.block_rows).model, 1, 1)
    assert seen == pytest.approx(biased, rel=0.15)
    assert errors(predicted(found, 5, past_outputs=True)[0], 1, 1) == pytest.approx((0, 0), abs=1e-6)


@pytest.mark.parametrize("outputs", [False, True])
def test_the_prediction_is_that_of_the_other_tests(outputs: bool) -> None:
    found = benchmark_limits()
    limit = found.past_outputs if outputs else found.past_inputs
    other = predicted_model(found.known, found.blocks, limit, CELL.block_rows, CELL.block_rows, ORDER, outputs=outputs)
    model = predicted(found, ORDER, past_outputs=outputs)[0]
    assert np.allclose(invariants(model.A, model.B, model.C, model.D), other, atol=1e-9)


def test_a_free_order_models_the_fault_as_well(monkeypatch: pytest.MonkeyPatch) -> None:
    order = free_order(benchmark_limits())
    assert (order.rank, order.contains, order.shift_invariant) == (5, True, True)
    assert order.poles_are_system_and_fault and order.markov_exact
    monkeypatch.setattr(past_outputs_bias, "FAULT_POLE", 0.8)
    assert not free_order(benchmark_limits()).poles_are_system_and_fault


def test_fault_and_noise_have_the_levels_of_the_benchmark() -> None:
    """The variance of the outputs of one record agrees with the exact one."""
    for setting in (Setting(2, 3, 3, 200_000), Setting(2, 3, 3, 200_000, 1.0)):
        found = limit(benchmark_experiment(setting))
        now = found.known.now(found.known.process.y, found.known.process.y)
        exact = [float(int(now[i, i].p) / int(now[i, i].q)) for i in range(3)]
        assert np.var(record(setting)[0], axis=0) == pytest.approx(exact, rel=0.05)


def test_a_peer_that_is_not_there_is_named() -> None:
    nothing = shutil.which("false")
    assert nothing is not None
    sheet, notes = examined(Setting(1, 1, 10, 2000), [2000], nothing)
    assert sheet.rows[-1][0].startswith("ctrlsys: ") and sheet.rows[-1][2] == "nan"
    assert [row[1] for row in sheet.rows] == ["exact limit"] * 3 + ["2e3"] * 4
    assert notes[-1].count("yes") == 4
