"""What `identify` says without healthy samples: by the laws of outputs and inputs, and where these cannot tell.

answered     the packaged plant's response with faults and noise, identified at order 3
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace import example_data as made
from faultspace.base.errors import InvalidData
from faultspace.numeric import StateSpaceModel, identify
from faultspace.numeric.method.ranks.exactness import obeys_exactly
from faultspace.numeric.plant.answer import Identification
from faultspace.numeric.plant.report.result_files import document
from tests.end_to_end.identify_runs import valid

Array = NDArray[np.float64]

N, NOISE = 800, 0.1


def _drawn(seed: int, samples: int = N) -> tuple[Array, Array]:
    """Return y without fault and u."""
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((samples, 2))
    y = StateSpaceModel(made.A, made.B, made.C, made.D).simulate(u) + NOISE * draw.standard_normal((samples, 3))
    return y, u


def answered(seed: int, added: Any, **options: Any) -> tuple[Identification, str]:
    y, u = _drawn(seed)
    answer = identify(y + added, u, order=3, **options)
    valid("identify", document(answer, "record"))
    return answer, answer.summary()


def _at(output: int, values: Any) -> Array:
    added = np.zeros((N, 3))
    added[:, output] = values
    return added


@pytest.mark.parametrize(
    ("added", "said"),
    [
        (_at(0, 2.0), "a constant fault would have gone with the means"),
        (_at(1, 60 * NOISE * (np.arange(N) % 97 == 5)), "'y2' has spikes beyond"),
    ],
    ids=["constant", "spikes"],
)
def test_what_no_spectrum_shows_is_no_zero(added: Array, said: str) -> None:
    answer, words = answered(1, added)
    assert answer.n_v is None and said in answer.reason and "n_v: **0" not in words


def test_a_white_fault_in_one_output_is_noise_unless_the_noise_is_known() -> None:
    fault = _at(0, np.random.default_rng(2).standard_normal(N))
    answer, words = answered(2, fault)
    # 0 is said under a condition that stands beside it: ten times as much noise there as in the others.
    assert answer.n_v == 0 and "n_v: **0, if this is the noise of each output: y1 " in words and "would not be seen" in answer.reason
    assert answer.count is not None and answer.count.noise_power is not None
    sizes = np.sqrt(answer.count.noise_power)
    assert abs(sizes[0] - 1.0) < 0.2 and np.all(np.abs(sizes[1:] - NOISE) < 0.02)
    assert answered(2, fault, noise_level=NOISE)[0].n_v == 1
    known, words = answered(2, 0.0, noise_level=[NOISE] * 3)
    assert known.n_v == 0 and "n_v: **0**\n" in words


def test_numbers_that_remain_possible_are_shown_as_such() -> None:
    v = 0.5 * np.random.default_rng(4).standard_normal((N, 2))
    fault = StateSpaceModel(made.A, made.B, made.C, np.zeros((3, 2))).simulate(v)
    answer, words = answered(3, fault)
    assert answer.n_v is None and answer.possible == (2, 3) and answer.at_least == 2 and "undecided: 2 or 3" in words
    assert answer.fault_space is None and any("noise_level=" in line for line in answer.to_json()["next"])
    settled, _ = answered(3, fault, noise_level=NOISE)
    assert settled.n_v == 2 and settled.fault_space is not None and settled.fault_space.method == "kernel rows"


def test_of_one_output_a_fault_is_told_from_noise_where_its_level_is_known_alone() -> None:
    y, u = _drawn(5)
    answer = identify(y[:, :1], u, order=3)
    assert answer.n_v is None and answer.possible == (0, 1)
    assert identify(y[:, :1], u, order=3, noise_level=NOISE).n_v == 0


def test_copies_and_single_precision_make_no_faults_of_noise() -> None:
    y, u = _drawn(6)
    answer = identify(np.hstack([y, 2 * y[:, :1]]), u, order=3)
    assert answer.exact and answer.n_v is None and answer.fault_space is None
    assert not obeys_exactly(y.astype(np.float32).astype(float), u, single=True)
    clean = StateSpaceModel(made.A, made.B, made.C, made.D).simulate(u)
    assert obeys_exactly(clean, u) and obeys_exactly(clean.astype(np.float32).astype(float), u, single=True)
    assert not obeys_exactly(y, u) and not obeys_exactly(y[:9], u[:9])


def test_where_no_autoregression_can_be_had_pi_moesp_stands_in() -> None:
    draw = np.random.default_rng(7)
    A = np.diag([1.05, 0.5])
    u = draw.standard_normal((300, 1))
    y = StateSpaceModel(A, np.ones((2, 1)), np.array([[1.0, 1.0], [0.0, 1.0]]), np.zeros((2, 1))).simulate(u) + draw.standard_normal(
        (300, 2)
    )
    answer = identify(y, u, order=2)
    assert answer.model is not None and not answer.model.model.is_stable and answer.way.startswith("PI-MOESP")
    assert any("for want of an ARX model" in note for note in answer.notes)


@pytest.mark.parametrize("level", [0.0, -1.0, [1.0, 2.0], "loud", float("nan")])
def test_a_noise_level_is_one_number_or_one_an_output(level: Any) -> None:
    y, u = _drawn(8, 200)
    with pytest.raises(InvalidData, match="noise_level: got"):
        identify(y, u, order=3, noise_level=level)


def test_unequal_noise_and_other_units_make_no_spikes_of_the_initial_state() -> None:
    """Fitted in units of y, the initial state leaves an error of the loudest output's noise in the others, far beyond their own."""
    draw = np.random.default_rng(1)
    u = draw.standard_normal((N, 2))
    y = StateSpaceModel(made.A, made.B, made.C, made.D).simulate(u) + NOISE * draw.standard_normal((N, 3)) * [1.0, 0.01, 0.3]
    assert identify(y, u, order=3).n_v == identify(y * [1e6, 1.0, 1e-6], u * [1e-3, 1e5], order=3).n_v == 0
