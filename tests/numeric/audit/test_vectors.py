"""The shipped vectors are what the tool makes, meet their schema, and are true by routes that do not share their making."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from faultspace.exact.matrices import rank
from faultspace.exact.signals import hankel
from faultspace.numeric.audit.exact_comparison import characteristic_polynomial, markov
from faultspace.numeric.audit.making_vectors import singular_values
from faultspace.numeric.audit.vectors import KINDS, documents, floats, main, matrix, shipped, signs

DATA = files("faultspace.numeric.audit").joinpath("data")


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
    """All documents as the tool would write them now."""
    result: dict[str, Any] = json.loads(json.dumps(documents()))
    return result


@pytest.mark.parametrize("kind", KINDS)
def test_shipped_files_are_what_the_tool_makes(kind: str, made: dict[str, Any]) -> None:
    _same(made[f"{kind}.json"], _read(f"{kind}.json"), kind)


def test_the_tool_writes_them(tmp_path: Path, made: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.audit.vectors.documents", lambda: made)
    assert main(["--out", str(tmp_path / "new")]) == 0
    assert {path.name for path in (tmp_path / "new").iterdir()} == {f"{kind}.json" for kind in KINDS}
    assert json.loads((tmp_path / "new" / "faults.json").read_text("utf-8")) == made["faults.json"]


@pytest.mark.parametrize("kind", KINDS)
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
    """y(k) = sum of Markov parameters times u, plus the free response, in 200 digits less than Fractions would need: in floats."""
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
        for coefficient in reversed(characteristic_polynomial(vector.A)):
            total, power = total + float(coefficient) * power, power @ floats(vector.A)
        assert np.allclose(total, 0, atol=1e-12)


@pytest.mark.parametrize("vector", shipped("faults"), ids=lambda vector: vector.slug)
def test_ranks_and_certified_gaps(vector: Any) -> None:
    """The gap encloses what a float SVD sees, and stands far above what rounding of the data can do."""
    for s, (due, (least, largest)) in enumerate(zip(vector.ranks, vector.gaps, strict=True), start=1):
        H = hankel(vector.r, s)
        assert rank(H) == due
        values = np.linalg.svd(floats(H), compute_uv=False)
        assert least <= values[due - 1] * (1 + 1e-6) and values[0] <= largest * (1 + 1e-6)
        assert values[due - 1] * 0.99 < least
        assert least > 1e3 * 2.0**-53 * float(np.linalg.norm(floats(H)))
    assert vector.ranks[-1] - vector.ranks[-2] == vector.n_v


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
    assert all(0 < bound < 1e-9 for bound in vector.zero_bounds)


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
