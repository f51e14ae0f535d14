"""The shipped vectors are what the tool makes, meet their schema, and are true by routes that do not share their making."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from importlib.resources import files
from itertools import count
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from faultspace.exact.algebra.matrices import rank, stacked
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import data_fault_space, hankel, simulate
from faultspace.exact.system.systems import ResidualSystem
from faultspace.numeric.audit.making import all_vectors, fault_records
from faultspace.numeric.audit.making.all_vectors import MAKERS, documents, main
from faultspace.numeric.audit.making.fault_records import singular_values
from faultspace.numeric.audit.vectors.exact_comparison import markov, polynomial_from_the_top
from faultspace.numeric.audit.vectors.fault_vectors import VIEWS, in_channel_units, unexciting_inputs
from faultspace.numeric.audit.vectors.rationals import floats, fractions, matrix, scaled, signs
from faultspace.numeric.audit.vectors.shipped_vectors import KINDS, shipped
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.space.by_ranks import noise_free_fault_space
from tests.thorough import every

DATA = files("faultspace.numeric.audit.vectors").joinpath("data")


def _read(name: str) -> Any:
    return json.loads(DATA.joinpath(name).read_text("utf-8"))


def _same(made: Any, kept: Any, place: str) -> None:
    """Equal, floats within rounding; bounds, which inherit the machine's arithmetic in their last digits, within a tenth."""
    if isinstance(kept, dict):
        assert made.keys() == kept.keys(), place
        for key in kept:
            _same(made[key], kept[key], f"{place}.{key}")
    elif isinstance(kept, list):
        assert len(made) == len(kept), place
        for index, (one, other) in enumerate(zip(made, kept, strict=True)):
            _same(one, other, f"{place}[{index}]")
    elif isinstance(kept, float):
        assert math.isclose(made, kept, rel_tol=0.5 if ".bounds" in place else 1e-12, abs_tol=1e-15), place
    else:
        assert made == kept, place


@pytest.fixture(scope="module")
def made() -> dict[str, Any]:
    """All documents as the tool would write them now; a part of the records of faults, made in ten views each, and of bounds of models."""
    part, bounded, numbers = fault_records.fault_systems()[:: every()], all_vectors._bounded, count()
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(MAKERS, "faults", lambda: [fault_records._faults(slug, system) for slug, system in part])
        patch.setattr(all_vectors, "_bounded", lambda blank: blank if next(numbers) % every() else bounded(blank))
        result: dict[str, Any] = json.loads(json.dumps(documents()))
    return result


@pytest.mark.parametrize("kind", KINDS)
def test_shipped_files_are_what_the_tool_makes(kind: str, made: dict[str, Any]) -> None:
    kept = _read(f"{kind}.json")
    if kind == "faults":
        slugs = [one["slug"] for one in kept["vectors"]]
        assert slugs == [slug for slug, _ in fault_records.fault_systems()]
        kept["vectors"] = kept["vectors"][:: every()]
    if kind == "identification":
        for one, other in zip(made[f"{kind}.json"]["vectors"], kept["vectors"], strict=True):
            if not one["bounds"]:
                other |= {"bounds": {}, "parts": []}
    _same(made[f"{kind}.json"], kept, kind)


def test_the_tool_writes_them(tmp_path: Path, made: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.audit.making.all_vectors.documents", lambda: made)
    monkeypatch.setattr("faultspace.numeric.audit.making.all_vectors.trouble_documents", lambda: {})
    assert main(["--out", str(tmp_path / "new")]) == 0
    assert {path.name for path in (tmp_path / "new").iterdir()} == {f"{kind}.json" for kind in KINDS}
    assert json.loads((tmp_path / "new" / "faults.json").read_text("utf-8")) == made["faults.json"]


@pytest.mark.parametrize("kind", [*KINDS, "trouble"])
def test_schema(kind: str) -> None:
    schema, document = _read("schema.json"), _read(f"{kind}.json")
    validator = jsonschema.Draft202012Validator(schema)
    validator.validate(document)
    slugs = [one["slug"] for one in document["vectors"]]
    assert len(slugs) == len(set(slugs))
    del document["vectors"][0]["slug"]
    assert not validator.is_valid(document)


def test_the_coverage_that_is_promised() -> None:
    sizes = {(v.B.ncols, v.C.nrows) for v in shipped("identification")}
    assert {one for one, _ in sizes} == {1, 2, 3} == {other for _, other in sizes}
    assert {(v.D.is_zero(), v.x0.is_zero()) for v in shipped("identification")} == {(a, b) for a in (True, False) for b in (True, False)}
    assert any(abs(z) > 1 for v in shipped("structure") for z in v.zeros)
    assert any(not v.left_invertible for v in shipped("structure"))


@pytest.mark.parametrize("vector", shipped("identification"), ids=lambda vector: vector.slug)
def test_outputs_by_convolution(vector: Any) -> None:
    """In floats, y(k) is the sum of Markov parameters times u plus the free response; Fractions would need 200 digits more."""
    n, y, u = len(range(vector.u.nrows)), floats(vector.y), floats(vector.u)
    parameters = [floats(part) for part in markov(vector.A, vector.B, vector.C, vector.D, n)]
    state, A, C = floats(vector.x0).ravel(), floats(vector.A), floats(vector.C)
    for k in range(n):
        forced = sum(parameters[k - j] @ u[j] for j in range(k + 1))
        assert np.allclose(y[k], forced + C @ state, rtol=1e-9, atol=1e-9)
        state = A @ state


def test_characteristic_polynomials_annihilate() -> None:
    for vector in shipped("identification"):
        total, power = 0 * floats(vector.A), np.eye(vector.order)
        for coefficient in reversed(polynomial_from_the_top(vector.A)):
            total, power = total + float(coefficient) * power, power @ floats(vector.A)
        assert np.allclose(total, 0, atol=1e-12)


RECORDS = [*shipped("faults"), *shipped("unexciting"), *(view for one in shipped("faults") for view in one.views.values())]


@pytest.mark.parametrize(
    "vector", RECORDS[:: every()], ids=lambda vector: f"{vector.slug}-{vector.view.slug if hasattr(vector, 'view') else ''}"
)
def test_ranks_and_certified_gaps(vector: Any) -> None:
    """The gap encloses what a float SVD sees, and stands far above what rounding of the data can do wherever ranks are asked."""
    r = in_channel_units(vector.r)
    clear = not hasattr(vector, "clear") or vector.clear
    for s, (due, (least, largest)) in enumerate(zip(vector.ranks, vector.gaps, strict=True), start=1):
        H = hankel(r, s)
        assert rank(H) == due
        values = np.linalg.svd(floats(H), compute_uv=False)
        assert values[0] <= largest * (1 + 1e-6) and largest < values[0] * 1.01
        if clear:
            assert least <= values[due - 1] * (1 + 1e-6) and values[due - 1] * 0.99 < least
            assert least > 1e3 * 2.0**-53 * float(np.linalg.norm(floats(H)))
            assert due == len(values) or values[due] < 1e-3 * least
    assert vector.ranks[-1] - vector.ranks[-2] == (vector.visible if hasattr(vector, "visible") else vector.n_v)


def test_only_what_has_died_out_is_not_told() -> None:
    """The third state of zero-outside dies out like 4^-k: the second half shows it far below rounding, though the exact rank has it."""
    unclear = [(one.slug, view.view.slug) for one in shipped("faults") for view in one.views.values() if not view.clear]
    assert unclear == [("zero-outside", "second-half")]


def test_the_badly_conditioned_are() -> None:
    """In the given units a float SVD at numpy's default tolerance misjudges worst-units, whose certified gap in channel units is clear;
    nearly-one-fault is badly conditioned in any units.
    """
    conditions = {one.slug: max(high / low for low, high in one.gaps) for one in shipped("faults")}
    print({slug: f"{value:.2g}" for slug, value in conditions.items()})
    assert conditions["nearly-one-fault"] > 1e7 and conditions["one-fault"] < 1e2
    vectors = {one.slug: one for one in shipped("faults")}
    raw = {
        slug: [int(np.linalg.matrix_rank(floats(hankel(one.r, s)))) for s in range(1, len(one.ranks) + 1)] for slug, one in vectors.items()
    }
    assert raw["worst-units"] != list(vectors["worst-units"].ranks) and vectors["worst-units"].clear
    assert raw["one-fault"] == list(vectors["one-fault"].ranks)
    spread = [np.linalg.cond(floats(hankel(vectors[slug].r, 1))) for slug in ("bad-units", "worst-units")]
    assert spread[0] > 1e6 and spread[1] > 1e15


@pytest.mark.parametrize("vector", shipped("faults"), ids=lambda vector: vector.slug)
def test_views_are_the_same_record(vector: Any) -> None:
    """r of a view is what the file says: samples, outputs, units; its space explains it and is that of the changed system."""
    assert set(vector.views) == {view.slug for view in VIEWS}
    for view in vector.views.values():
        how = view.view
        expected = scaled(
            vector.r.rows(range(how.first, how.last)).columns(how.outputs(vector.system.p)),
            [unit * how.scale for unit in how.units(vector.system.p)],
        )
        assert view.r == expected
        explained = data_fault_space(view.r, view.system.A, view.system.C, view.system.n + 1)
        both = stacked(explained, view.space.transposed())
        assert rank(both) == explained.nrows == view.space.ncols


@pytest.mark.parametrize("vector", shipped("unexciting"), ids=lambda vector: vector.slug)
def test_unexciting_faults_are_explained_by_others(vector: Any) -> None:
    """Problem (11) has more solutions on these data than for the system, and the faults as given are fewer than they seem."""
    system = vector.system
    known = analyze(system).fault_space
    found = data_fault_space(vector.r, system.A, system.C, system.n + 5)
    assert vector.visible < system.m
    assert found.nrows != known.dimension or rank(stacked(found, known.basis)) > known.dimension
    assert not noise_free_fault_space(floats(vector.r), floats(system.A), floats(system.C), n_v=system.m).meaningful


@pytest.mark.parametrize("name", ["constant", "sine"])
def test_unexciting_inputs_leave_other_models(name: str) -> None:
    """(x0, B, D) -> y is linear for the given A, C, and not one to one: other models give the same outputs, a constant included."""
    model = next(one for one in shipped("identification") if (one.order, one.B.ncols) == (2, 1))
    u = unexciting_inputs(model.u.nrows)[name]
    n, p = model.order, model.C.nrows
    columns = []
    for k in range(2 * n + p):
        unit = [Fraction(int(j == k)) for j in range(2 * n + p)]
        x0, B, D = (matrix([[x] for x in part], 1) for part in (unit[:n], unit[n : 2 * n], unit[2 * n :]))
        y = simulate(ResidualSystem(model.A, B, model.C, D), x0, u).residuals
        columns.append([x for row in fractions(y) for x in row])
    assert rank(matrix(columns, len(columns[0]))) < 2 * n + p
    rich = simulate(ResidualSystem(model.A, model.B, model.C, model.D), model.x0, model.u).residuals
    assert rich == model.y


@pytest.mark.parametrize("vector", shipped("noisy"), ids=lambda vector: vector.slug)
def test_noise_is_far_below_the_certified_gap(vector: Any) -> None:
    """By float SVDs of the parts apart: the least nonzero singular value is about the certified one, the noise's norm below its bound."""
    v, noise = vector.drawn()
    model = StateSpaceModel(*(floats(M) for M in (vector.system.A, vector.system.F, vector.system.C, vector.system.G)))
    exact = model.simulate(v, np.zeros(vector.system.n))
    for s, (due, (low, high)) in enumerate(zip(vector.ranks, vector.gaps, strict=True), start=1):
        values = np.linalg.svd(_windows(exact, s), compute_uv=False)
        assert low <= values[due - 1] * (1 + 1e-9) and values[due - 1] < 1.5 * low
        assert due == len(values) or values[due] < 1e-9 * values[0]
        assert np.linalg.norm(_windows(float(vector.noise) * noise, s), 2) <= high <= low / 10
        if due < len(values):
            assert np.linalg.matrix_rank(_windows(vector.record(), s)) == len(values)  # a threshold of rounding sees no gap


def _windows(r: Any, s: int) -> Any:
    return np.hstack([r[i : len(r) - s + 1 + i] for i in range(s)])


def test_the_gap_is_that_of_a_matrix_known_in_closed_form() -> None:
    least, largest = singular_values(matrix([["3", "0", "0"], ["0", "1/1000", "0"], ["0", "0", "0"]], 3))
    assert 0.998e-3 < least <= 1e-3 and 3 <= largest < 3.01


@pytest.mark.parametrize("vector", [v for v in shipped("structure") if v.left_invertible], ids=lambda vector: vector.slug)
def test_zeros_drop_the_rank_of_the_pencil(vector: Any) -> None:
    A, F, C, G = (floats(M) for M in (vector.system.A, vector.system.F, vector.system.C, vector.system.G))

    def least(z: complex) -> float:
        return float(np.linalg.svd(np.block([[z * np.eye(len(A)) - A, -F], [C, G]]), compute_uv=False)[-1])

    assert all(least(z) < 1e-12 for z in vector.zeros)
    assert all(least(z) > 1e-6 for z in (0.123, 3.3 + 1j, -0.7j))
    # The pencil in other units is larger, and so is what rounding makes of it.
    largest = 1e-7 if vector.slug.endswith("other-units") else 1e-9
    assert all(0 < bound < largest for bound in vector.zero_bounds)


def test_floats_are_correctly_rounded() -> None:
    third = floats(matrix([["1/3", "1/10"]], 2))
    assert third.tolist() == [[1 / 3, 0.1]] and Fraction(third[0, 0]) != Fraction(1, 3)


def test_signs() -> None:
    drawn = signs(1, 4000)
    assert set(drawn) == {1.0, -1.0} and abs(drawn.mean()) < 0.05 and abs(np.mean(drawn[1:] * drawn[:-1])) < 0.05
    assert signs(1, 3).tolist() == [1.0 if state >> 63 else -1.0 for state in _states(1, 3)]


def _states(seed: int, count: int) -> list[int]:
    result = [seed]
    for _ in range(count):
        result.append((6364136223846793005 * result[-1] + 1442695040888963407) & (2**64 - 1))
    return result[1:]
