"""What a plant does to a record, and what `identify` then says: a residual that grows beyond all numbers, and others."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import numpy as np

from benchmarks.changes_records import KINDS, SETTINGS, record
from faultspace import numeric
from faultspace.base.arrays import Array
from faultspace.numeric import StateSpaceModel, identify

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


def test_the_shape_of_what_laws_leave_is_a_likelihood_ratio() -> None:
    y, u = measured(3)
    document = identify(y, u, order=2).to_json()
    shapes = [test["sphericity"] for test in document["laws"]["tests"] if test["sphericity"]]
    assert shapes and all(set(shape) == {"log_likelihood_ratio", "expected"} for shape in shapes)
    jsonschema.validate(document | {"files": []}, json.loads(SCHEMA.read_text("utf-8")))
