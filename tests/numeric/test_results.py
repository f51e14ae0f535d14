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
from faultspace.base.sheets import Shown
from faultspace.numeric.model.models import StateSpaceModel

Array = NDArray[np.float64]
RESULTS = ("model", "residual", "dimension", "space", "signal", "study")
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
    return {"y": y, "u": u, **steps, "whole": whole, "study": study}


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_is_read_by_people_programs_and_notebooks(name: str, chain: dict[str, Any]) -> None:
    found: Shown = chain[name]
    assert isinstance(found, Shown)
    assert found.summary().splitlines()[0] == found.title and len(found.summary().splitlines()) > 2
    assert repr(found) == f"<{type(found).__name__}: {found.title}>" and len(repr(found)) < 120
    assert found.title.split()[0] in found._repr_html_()
    record = json.loads(json.dumps(chain[name].to_json(), allow_nan=False))
    assert record and all(isinstance(key, str) for key in record)


@needs_matplotlib
@pytest.mark.parametrize("name", ["model", "residual", "dimension", "space", "signal", "study", "whole"])
def test_a_result_draws_itself_into_the_axes_given(name: str, chain: dict[str, Any]) -> None:
    from matplotlib.figure import Figure

    ax: Any = Figure(layout="constrained").add_subplot()
    assert chain[name].plot(ax) is ax
    assert ax.lines or ax.collections


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
    with pytest.raises(InvalidData, match="nothing to draw"):
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
    for module in ("faultspace.numeric.drawing", "faultspace.numeric.model.models"):
        monkeypatch.setattr(f"{module}.import_module", absent)
    with pytest.raises(ImportError, match=advice):
        getattr(chain["whole"], ask)()


@pytest.mark.parametrize("dt", [0.0, -1.0, float("nan"), float("inf")])
def test_a_sample_time_is_a_positive_number(dt: float) -> None:
    with pytest.raises(InvalidData, match="dt: got"):
        numeric.identify(np.zeros((50, 1)), np.ones((50, 1)), dt=dt)
