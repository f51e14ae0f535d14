"""What `identify` and the readers of records take as arguments, and what they say to the rest.

WRONG     arguments with what their refusal says
"""

from __future__ import annotations

import gc
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace import example_data as made
from faultspace import numeric
from faultspace.base.errors import InvalidData, InvalidInput

RECORD = made.faulty_record(600)

WRONG: list[tuple[dict[str, Any], str]] = [
    *(({name: value}, rf"{name}: got .*an integer of at least \d is needed: state .*leave it out")
      for name in ("order", "block_rows", "n_v", "healthy")
      for value in ("3", True, np.True_, 3.0, np.float64(3), 1.5, [3], -1)),
    ({"order": 0}, "order: got 0; an integer of at least 1 is needed: state how many"),
    ({"block_rows": 1}, "block_rows: got 1; an integer of at least 2 is needed: state more samples"),
    ({"healthy": 0}, "healthy: got 0; an integer of at least 1 is needed"),
    ({"healthy": 600}, "healthy: got 600 for 600 samples; some must follow: state fewer"),
    ({"n_v": 4}, "n_v: got 4 for 3 outputs; at most as many can be told apart: state fewer"),
    *(({"operating_point": value}, 'operating_point: got .*; "means" or "zero" is needed') for value in ("no", 1, True)),
    *(({"dt": value}, "dt: got .*; the seconds from sample to sample") for value in ("1", True, 1j, [1.0], float("nan"))),
    ({"inputs": "valve"}, "inputs: got 1 name for 2 channels: one name a channel is needed, in the order of the columns; got 'valve'"),
    ({"inputs": []}, "inputs: got 0 names for 2 channels.*got none"),
    ({"inputs": ["valve", 2]}, "inputs, outputs: got 2 as the name of a channel"),
    ({"inputs": ["valve", "valve"]}, "channel 'valve' twice"),
    ({"inputs": ["flow", "valve"], "outputs": ["level1", "level2", "flow"]}, "channel 'flow' as input and as output"),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "said"), WRONG, ids=[str(number) for number in range(len(WRONG))])
def test_an_argument_that_is_none_is_refused(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(InvalidData, match=said):
        numeric.identify(RECORD.y, RECORD.u, **arguments)


def test_integers_of_numpy_are_integers() -> None:
    plain = numeric.identify(RECORD.y, RECORD.u, order=3, n_v=1, block_rows=8, healthy=300, dt=1)
    of_numpy: dict[str, Any] = {
        "order": np.int32(3),
        "n_v": np.uint8(1),
        "block_rows": np.int64(8),
        "healthy": np.array(300),
        "dt": np.float32(1),
    }
    same = numeric.identify(RECORD.y, RECORD.u, **of_numpy)
    assert plain.to_json() == same.to_json() and type(same.n_v) is int


def test_a_text_is_a_name_or_names_separated_by_commas(tmp_path: Path) -> None:
    path = tmp_path / "data.csv"
    path.write_text(made.csv_text(RECORD), encoding="utf-8")
    listed = numeric.read_record(path, inputs=["valve", "pump"], outputs=["flow"])
    assert (listed.inputs, listed.outputs) == (("valve", "pump"), ("flow",))
    for record in (
        numeric.read_record(path, inputs="valve,pump", outputs="flow"),
        numeric.record_from(path, inputs="valve, pump", outputs="flow"),
        numeric.record_from(RECORD.y[:, 2:], RECORD.u, inputs="valve,pump", outputs="flow"),
    ):
        assert (record.inputs, record.outputs, len(record)) == (listed.inputs, listed.outputs, 600)
    wrong: Any = [0]
    with pytest.raises(InvalidInput, match="got 0 as the name of a channel, expected text"):
        numeric.read_record(path, inputs=wrong, outputs="flow")


def test_columns_that_are_merely_numbered_are_no_names() -> None:
    pandas = pytest.importorskip("pandas")
    record = numeric.record_from(pandas.DataFrame(RECORD.y), pandas.DataFrame(RECORD.u))
    assert (record.inputs, record.outputs) == (("u1", "u2"), ("y1", "y2", "y3"))


def test_no_model_is_no_identification_without_one() -> None:
    nothing: Any = None
    y: NDArray[np.float64] = np.zeros((9, 1))
    with pytest.raises(InvalidData, match="model: got None; a StateSpaceModel is needed"):
        numeric.residual(y, y, nothing)


def test_an_order_of_zero_says_what_to_try() -> None:
    with pytest.raises(InvalidData, match=r"order must be a positive integer \(got 0\): state how many states"):
        numeric.pi_moesp(RECORD.y, RECORD.u, order=0, block_rows=8)


def test_a_record_shows_itself_on_a_line() -> None:
    record = numeric.record_from(RECORD.y[:, :1], RECORD.u, inputs="valve, pump", outputs="flow")
    assert repr(record) == "<Record: 600 samples, inputs valve, pump, outputs flow>"
    many = numeric.record_from(np.zeros((9, 40)), np.zeros((9, 1)))
    assert repr(many).endswith("y12, ... (40 in all)>")


def test_stores_are_closed_with_their_owners() -> None:
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        numeric.identify(RECORD.y, RECORD.u, order=3, block_rows=8)
        numeric.arx_reduction(RECORD.y, RECORD.u, order=3, lags=3)
        gc.collect()
    assert not [warning for warning in heard if issubclass(warning.category, ResourceWarning)]
