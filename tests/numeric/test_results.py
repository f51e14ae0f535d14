"""What the functions of the room return is read by people, programs, notebooks and by the functions that come next.

chain      one record with a fault and the result of every step, and a small study
RESULTS    the results that have a summary, a JSON form and a short repr
"""

from __future__ import annotations

import builtins
import importlib.util
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace import example_data, monte_carlo, numeric
from faultspace.base.errors import InvalidData, InvalidInput
from faultspace.base.sheets import Shown, counted
from faultspace.numeric.method import plotting as drawing
from faultspace.numeric.method.model.models import StateSpaceModel

Array = NDArray[np.float64]
RESULTS = (
    *("model", "residual", "dimension", "space", "signal", "study", "record", "matrices"),
    *("reduced", "uncertainty", "orders", "count", "open count", "healthy", "against", "direction", "changes", "doubts", "shift"),
)
DRAWN = (*(name for name in RESULTS if name not in ("record", "count", "open count", "healthy", "changes", "doubts", "shift")), "whole")
needs_matplotlib = pytest.mark.skipif(importlib.util.find_spec("matplotlib") is None, reason="matplotlib is not installed")


@pytest.fixture(scope="module")
def chain() -> dict[str, Any]:
    record = example_data.faulty_record()
    u, y = record.u, record.y
    model = numeric.pi_moesp(y, u, order=3, block_rows=20)
    rest = numeric.residual(y, u, model, x0=model.x0)
    space = numeric.fault_space(rest, model.A, model.C, n_v=1)
    signal = numeric.reconstruct_fault(rest, model.A, space.F[:, :1], model.C, space.G[:, :1])
    whole = numeric.identify(y, u, order=3, dt=0.5, inputs=example_data.INPUTS, outputs=example_data.OUTPUTS)
    dimension = numeric.fault_dimension(rest, u=u)
    study = monte_carlo("published", systems=8, samples=200, jobs=1)
    steps = {"model": model, "residual": rest, "dimension": dimension, "space": space, "signal": signal}
    reduced = numeric.arx_reduction(y[:400], u[:400])
    near = {
        "record": whole.record,
        "matrices": model.model,
        "reduced": reduced,
        "uncertainty": reduced.uncertainty,
        "orders": reduced.orders,
        "doubts": numeric.doubts(numeric.record_from(y + 50, u), reduced),
    }
    draw = np.random.default_rng(1)
    noise = draw.standard_normal((1600, 3))
    noise[800:, 1] += 4 * draw.standard_normal(800)
    healthy = numeric.healthy_reference(noise[:800])
    against = numeric.fault_dimension_against_healthy(noise[800:], healthy)
    direction = numeric.fault_direction_against_healthy(noise[800:], healthy)
    pushed = draw.standard_normal((800, 1))
    one = np.hstack([pushed + noise[:800, :1], pushed - noise[:800, :1], noise[:800, :1]]) + 0.01 * draw.standard_normal((800, 3))
    counts = {
        "count": numeric.count_faults(one, pushed, order=1),
        "open count": numeric.count_faults(noise[:800, :1], pushed, order=1),
    }
    changes = numeric.changes_since_healthy(noise, noise, noise[:, :1], healthy=800)
    shift = numeric.isolate_shift([0.0, 9.0, 0.0], np.eye(3), reduced)
    more = {"healthy": healthy, "changes": changes, "shift": shift, "against": against, "direction": direction, **counts, **near}
    return {"y": y, "u": u, **steps, **more, "whole": whole, "study": study}


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_is_read_by_people_programs_and_notebooks(name: str, chain: dict[str, Any]) -> None:
    found: Shown = chain[name]
    assert isinstance(found, Shown)
    assert found.summary().splitlines()[0] == found.title and len(found.summary().splitlines()) > 2
    assert repr(found) == f"<{type(found).__name__}: {found.title}>" and len(repr(found)) < 120
    assert found.title.split()[0] in found._repr_html_()
    assert max(map(len, found.summary().splitlines())) <= 80
    record = json.loads(json.dumps(chain[name].to_json(), allow_nan=False))
    assert record and all(isinstance(key, str) for key in record)


@needs_matplotlib
@pytest.mark.parametrize("name", DRAWN)
def test_a_result_draws_itself_into_the_axes_given(name: str, chain: dict[str, Any]) -> None:
    from matplotlib.figure import Figure

    ax: Any = Figure(layout="constrained").add_subplot()
    assert chain[name].plot(ax) is ax
    assert ax.lines or ax.collections


def test_floats_come_back_from_json_bit_for_bit(chain: dict[str, Any]) -> None:
    reduced, record, against = (json.loads(json.dumps(chain[name].to_json())) for name in ("reduced", "record", "against"))
    found = chain["reduced"]
    assert np.array_equal(numeric.StateSpaceModel.from_json(reduced).A, found.model.A)
    assert np.array_equal(reduced["uncertainty"]["root"], found.uncertainty.root)
    deviations = np.array(reduced["uncertainty"]["pole_deviations"])
    assert np.array_equal(deviations[:, 0] + 1j * deviations[:, 1], found.uncertainty.poles())
    assert [row["chance"] for row in reduced["orders"]["rows"]] == [row.chance for row in found.orders.rows]
    assert record["deviation"] == chain["record"].channels.deviation.tolist()
    assert np.array_equal(against["roots"], chain["against"].roots) and against["n_v"] == 1


@needs_matplotlib
def test_the_region_of_a_pole_holds_it_as_often_as_stated() -> None:
    from matplotlib.figure import Figure
    from matplotlib.path import Path as Outline

    draw = np.random.default_rng(4)
    poles, roots = np.array([0.5 + 0.3j, 0.5 - 0.3j, -0.4]), np.array([[0.02, 0.01j], [0.02, -0.01j], [0.05, 0.02]])
    ax: Any = Figure(layout="constrained").add_subplot()
    drawing.plot_uncertain_poles(poles, roots, ax=ax)
    by_size = [line.get_xydata() for line in ax.lines[-3:]]
    errors = draw.standard_normal((4000, 2)) @ roots.T
    inside = [
        Outline(edge).contains_points(np.stack([z.real, z.imag], 1)).mean()
        for edge, z in zip(by_size[:2], (poles + errors).T, strict=False)
    ]
    inside.append(float(np.mean(np.abs(errors[:, 2]) <= np.ptp(by_size[2][:, 0]) / 2)))
    assert np.allclose(inside, 0.95, atol=0.015)
    assert ax.get_legend().get_texts()[1].get_text() == "95 % region"
    small: Any = Figure(layout="constrained").add_subplot()
    drawing.plot_uncertain_poles(poles, roots / 1000, ax=small)
    assert small.get_legend().get_texts()[1].get_text() == "95 % region, drawn 1000 times larger"
    assert np.allclose(small.lines[-1].get_xydata(), by_size[2])
    multiple: Any = Figure(layout="constrained").add_subplot()
    drawing.plot_uncertain_poles(poles, np.full((3, 2), np.nan + 0j), ax=multiple)
    assert multiple.get_legend().get_texts()[1].get_text() == "3 poles without: multiple"


@needs_matplotlib
def test_the_picture_of_the_orders_shows_what_is_open_and_what_is_taken(chain: dict[str, Any]) -> None:
    from matplotlib.figure import Figure

    ax: Any = Figure(layout="constrained").add_subplot()
    orders = chain["orders"]
    orders.plot(ax)
    akaike = np.array([row.akaike for row in orders.rows])
    assert np.allclose(ax.lines[0].get_ydata(), akaike - akaike.min()) and ax.lines[1].get_xdata().tolist() == [orders.best]
    assert f"left open: {orders.least}" in ax.get_legend().get_texts()[-1].get_text()


def test_a_count_says_what_was_asked_and_what_it_answered(chain: dict[str, Any]) -> None:
    decided, left_open = chain["count"], chain["open count"]
    assert (decided.n_v, left_open.n_v) == (1, None) and left_open.title.endswith("undecided, of 0, 1")
    assert "    2 rows                              are laws, probability" in decided.summary()
    assert "    1 row                               is a law, probability" in left_open.summary()
    assert [test["rows"] for test in decided.to_json()["tests"]] == [3, 2] and decided.to_json()["noise_power"] is not None


def test_what_is_counted_has_its_number() -> None:
    assert [counted(1, "sample"), counted(2, "sample"), counted(0, "sample"), counted(2, "basis", "bases")] == [
        *("1 sample", "2 samples", "0 samples", "2 bases"),
    ]


def test_a_long_value_goes_on_below_itself() -> None:
    class Long(Shown):
        title = "a title"

        def sheet(self) -> list[tuple[str, str]]:
            return [("why", "word " * 30 + "w" * 60), ("heading", ""), ("", "short")]

    lines = Long().summary().splitlines()
    assert lines[0] == "a title" and lines[-2:] == ["  heading", " " * 40 + "short"] and lines[1].startswith("    why  ")
    assert all(line.startswith(" " * 40) and len(line) <= 80 for line in lines[2:5]) and lines[-3].strip() == "w" * 60


def test_a_study_tells_of_every_group_and_which_are_vacuous(chain: dict[str, Any]) -> None:
    said = chain["study"].summary()
    for label in ("0 zeros", "1 zero", "2 zeros", "3 zeros", "minimum phase", "not minimum phase"):
        assert f"    {label}, paper " in said
    assert said.count("2 systems, all vacuous: no null row") == 2  # as systems without zeros, and as systems without phase
    middle = chain["study"].to_json()["by_zeros"][1]["quantiles"][2]
    assert f"2 systems, median {100 * middle:.2g} %" in said


@needs_matplotlib
def test_a_fault_space_draws_what_its_dimension_rests_on(chain: dict[str, Any]) -> None:
    from matplotlib.figure import Figure

    fitted, B, D = chain["space"], example_data.F, example_data.G
    r = StateSpaceModel(example_data.A, B, example_data.C, D).simulate(np.random.default_rng(5).standard_normal((400, 1)))
    exact = numeric.fault_space(r, example_data.A, example_data.C)
    assert (exact.method, fitted.method) == ("noise-free", "likelihood")
    for space, shown in ((exact, exact.n_z), (fitted, 0)):  # what is zero by the fit is no evidence
        ax: Any = Figure(layout="constrained").add_subplot()
        space.plot(ax)
        assert [len(line.get_ydata()) for line in ax.lines] == [space.equations, shown]
        assert f"dimension {space.n_z}" in ax.get_legend().get_texts()[1].get_text()
    nothing = numeric.fault_space(np.random.default_rng(3).standard_normal((400, 1)), [[0.5]], [[1.0]])
    assert not nothing.meaningful
    with pytest.raises(InvalidData, match="no condition on a fault column to draw"):
        nothing.plot()


def test_each_function_takes_what_the_one_before_returns(chain: dict[str, Any]) -> None:
    model, rest, space = chain["model"], chain["residual"], chain["space"]
    r = rest.r
    same = numeric.residual(chain["y"], chain["u"], model.model, x0=model.x0)
    assert np.array_equal(same.r, r)
    assert np.array_equal(numeric.residual(chain["y"], chain["u"], chain["whole"], x0=chain["whole"].model.x0).r, chain["whole"].residual.r)
    assert np.array_equal(numeric.fault_space(r, model.A, model.C, n_v=1).basis, space.basis)
    assert numeric.fault_dimension(r, u=chain["u"]).to_json() == chain["dimension"].to_json()
    again = numeric.reconstruct_fault(r, model.A, space.F[:, :1], model.C, space.G[:, :1])
    assert np.array_equal(again.v, chain["signal"].v)


def test_without_a_model_nothing_is_handed_on(chain: dict[str, Any], tmp_path: Path) -> None:
    found = replace(chain["whole"], model=None, residual=None, signal=None)
    calls: list[Callable[[], object]] = [found.to_control, found.to_scipy, lambda: found.to_mat(tmp_path / "model.mat"), found.plot]
    calls.append(lambda: numeric.residual(np.zeros((9, 2)), np.zeros((9, 1)), found))
    for call in calls:
        with pytest.raises(InvalidData, match="state an order"):
            call()
    assert not list(tmp_path.iterdir())


def test_scipy_gets_the_model_and_the_sample_time(chain: dict[str, Any]) -> None:
    found = chain["whole"]
    system = found.to_scipy()
    assert system.dt == 0.5 and np.array_equal(system.A, found.model.A) and np.array_equal(system.D, found.model.D)
    assert chain["model"].to_scipy().dt == 1


def test_matlab_gets_everything_by_name(chain: dict[str, Any], tmp_path: Path) -> None:
    from scipy.io import loadmat

    found, path = chain["whole"], tmp_path / "model.mat"
    found.to_mat(path)
    got = loadmat(path)
    F, G = found.pair
    wanted = {"A": found.model.A, "B": found.model.B, "C": found.model.C, "D": found.model.D, "F": F, "G": G}
    for name, matrix in wanted.items():
        assert np.array_equal(got[name], matrix), name
    assert got["dt"].item() == 0.5 and got["x0"].shape == (3, 1)
    assert [str(name[0][0]) for name in got["outputs"]] == list(example_data.OUTPUTS)
    assert [str(name[0][0]) for name in got["inputs"]] == list(example_data.INPUTS)
    with pytest.raises(InvalidInput, match="cannot be written"):
        found.to_mat(tmp_path / "missing" / "model.mat")


def test_a_model_without_faults_has_matrices_without_columns(tmp_path: Path) -> None:
    from scipy.io import loadmat

    u = np.random.default_rng(1).standard_normal((400, 1))
    found = numeric.identify(StateSpaceModel([[0.5]], [[1.0]], [[1.0], [2.0]], [[0.0], [1.0]]).simulate(u), u)
    found.to_mat(tmp_path / "model.mat")
    got = loadmat(tmp_path / "model.mat")
    assert got["F"].shape == (1, 0) and got["G"].shape == (2, 0) and got["dt"].item() == -1


def test_control_gets_names_and_sample_time_or_the_reader_a_way_to_it(chain: dict[str, Any]) -> None:
    pytest.importorskip("control")
    system = chain["whole"].to_control()
    assert system.dt == 0.5 and np.array_equal(system.A, chain["whole"].model.A)
    assert system.input_labels == list(example_data.INPUTS) and system.output_labels == list(example_data.OUTPUTS)


@pytest.mark.parametrize(
    ("package", "ask", "advice"), [("control", "to_control", "pip install control"), ("matplotlib", "plot", "faultspace")]
)
def test_a_package_that_is_not_there_is_named(
    package: str, ask: str, advice: str, chain: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    real = builtins.__import__

    def without(name: str, *rest: Any, **options: Any) -> Any:
        if name.partition(".")[0] == package:
            raise ImportError(name)
        return real(name, *rest, **options)

    def absent(name: str, *rest: Any) -> Any:
        return without(name) if name.partition(".")[0] == package else importlib.import_module(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    for module in ("faultspace.numeric.method.plotting", "faultspace.numeric.method.model.models"):
        monkeypatch.setattr(f"{module}.import_module", absent)
    with pytest.raises(ImportError, match=advice):
        getattr(chain["whole"], ask)()


@pytest.mark.parametrize("dt", [0.0, -1.0, float("nan"), float("inf")])
def test_a_sample_time_is_a_positive_number(dt: float) -> None:
    with pytest.raises(InvalidData, match="dt: got"):
        numeric.identify(np.zeros((50, 1)), np.ones((50, 1)), dt=dt)
