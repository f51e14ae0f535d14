"""Records made to mislead `identify --healthy-until`: no fault is counted as a bold 0, and no healthy record as a fault.

record      the packaged plant with a fault that begins at a sample, under unequal, coloured noise; the healthy part is what is stated
FAULTS      what is added to the outputs from the sample START on, in units of each sensor's noise
HEALTHY     records without a fault that look as if they had one
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import butter, lfilter, sosfilt

from faultspace import example_data as made
from faultspace.base.errors import InvalidData
from faultspace.numeric.data.records import recorded
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.space.largest import largest_fault_space
from faultspace.numeric.plant.answer import Identification
from faultspace.numeric.plant.pipeline import identify
from faultspace.numeric.plant.report import result_files as report
from faultspace.numeric.plant.report.summary import summary
from tests.end_to_end.identify_runs import valid
from tests.thorough import every

Array = NDArray[np.float64]

N, START = 1600, 800
LEVELS = np.array([0.3, 0.1, 0.02])


def noise(draw: np.random.Generator, samples: int, pole: float = 0.3) -> Array:
    white = draw.standard_normal((samples + 100, 3))
    return np.asarray(lfilter([np.sqrt(1 - pole**2)], [1.0, -pole], white, axis=0)[100:] * LEVELS)


def clean(u: Array, A: Array = made.A) -> Array:
    return np.asarray(StateSpaceModel(A, made.B, made.C, np.zeros((3, 2))).simulate(u))


def answered(
    y: Array, u: Array, *, until: int = START, outputs: tuple[str, ...] = made.OUTPUTS, **options: Any
) -> tuple[Identification, dict[str, Any], str]:
    """Return the answer, its document, which the schema accepts, and what people read."""
    answer = identify(recorded(y, u, outputs=outputs, inputs=made.INPUTS), order=3, healthy=until, **options)
    document = valid("identify", report.document(answer, "record") | {"files": []})
    space = answer.fault_space
    if space is not None and space.meaningful and space.n_v is not None:
        assert answer.model is not None
        assert space.n_z <= largest_fault_space(answer.model.A, answer.model.C, space.n_v)
    assert (answer.pair is None) == (answer.signal is None)
    assert answer.signal is None or (space is not None and space.decided)
    return answer, document, "\n".join(summary(answer, "record"))


def _only(output: int, values: NDArray[Any]) -> Array:
    added = np.zeros((len(values), 3))
    added[:, output] = values
    return added


FAULTS: dict[str, Callable[[NDArray[np.int_], np.random.Generator], Array]] = {
    "bias of one sensor": lambda k, draw: _only(2, np.full(len(k), 20.0)),
    "small bias of one sensor": lambda k, draw: _only(0, np.full(len(k), 1.0)),
    "bias of all sensors": lambda k, draw: np.full((len(k), 3), 5.0),
    "ramp": lambda k, draw: _only(1, 10.0 * k / len(k)),
    "ramp about zero": lambda k, draw: _only(1, 20.0 * (k / len(k) - 0.5)),
    "slow drift of all": lambda k, draw: np.outer(5.0 * np.sin(np.pi * k / len(k)), [1.0, -1.0, 1.0]),
    "step half way": lambda k, draw: _only(0, 10.0 * (k > len(k) / 2)),
    "spikes": lambda k, draw: _only(1, 60.0 * (k % 97 == 5)),
    "sinusoid": lambda k, draw: _only(2, 5.0 * np.sin(0.7 * k)),
    "white in one": lambda k, draw: _only(0, 5.0 * draw.standard_normal(len(k))),
    "white in all alike": lambda k, draw: np.outer(5.0 * draw.standard_normal(len(k)), np.ones(3)),
    "louder noise": lambda k, draw: 5.0 * draw.standard_normal((len(k), 3)),
    "every second sample": lambda k, draw: _only(1, 5.0 * (-1.0) ** k),
}


# What the default run tries too: with the means taken off, and as they are. A drift of all outputs and spikes are tried below.
WITHOUT, WITH = ("ramp", "white in one"), ("small bias of one sensor", "sinusoid", "white in all alike")
TRIED = [
    pytest.param(name, means, marks=() if name in some else pytest.mark.slow, id=f"{name}-means removed" if means else name)
    for means, some in ((False, WITH), (True, WITHOUT))
    for name in FAULTS
]


@pytest.mark.parametrize(("name", "means"), TRIED)
def test_no_fault_is_counted_as_zero(name: str, means: bool) -> None:
    draw = np.random.default_rng(list(name.encode()))
    u = draw.standard_normal((N, 2)) + 3.0 * means
    y = clean(u) + noise(draw, N)
    y[START:] += FAULTS[name](np.arange(N - START), draw) * LEVELS
    units = np.array([1e-6, 1.0, 1e6])
    answer, document, words = answered(y * units + 100.0 * units * means, u, operating_point="means" if means else "zero")
    assert answer.n_v != 0 and answer.at_least >= 1, words
    assert document["n_v_at_least"] >= 1 and "n_v: **0" not in words


def _plain(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    return clean(u) + noise(draw, N), u


def _another_operating_point(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    u[START:] += [2.0, -1.0]
    return clean(u) + noise(draw, N), u


def _louder_inputs(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    u[START:] *= 3.0
    return clean(u) + noise(draw, N), u


def _coloured(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    return clean(u) + noise(draw, N, 0.9), u


def _hum(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    return clean(u) + noise(draw, N) + np.outer(np.sin(0.9 * np.arange(N)), LEVELS), u


def _integrating(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    A = made.A.copy()
    A[2] = [0.0, 0.0, 1.0]
    return clean(u, A) + noise(draw, N), u


def _still_input_later(draw: np.random.Generator) -> tuple[Array, Array]:
    u = draw.standard_normal((N, 2))
    u[START:, 0] = 0.5
    return clean(u) + noise(draw, N), u


HEALTHY = {
    f.__name__.strip("_").replace("_", " "): f
    for f in (_plain, _another_operating_point, _louder_inputs, _coloured, _hum, _integrating, _still_input_later)
}


@pytest.mark.parametrize("seed", range(2)[:: every()])
@pytest.mark.parametrize("name", HEALTHY)
def test_no_healthy_record_is_called_faulty(name: str, seed: int) -> None:
    y, u = HEALTHY[name](np.random.default_rng((seed, *name.encode())))
    answer, document, words = answered(y * [1e6, 1.0, 1e-6], u)
    assert answer.at_least == 0 and answer.n_v in (0, None), words
    if answer.n_v == 0:
        assert document["visible"]["constant"] is not None and "seen with a chance of 0.9" in words


# What neither spectra nor means show


@pytest.mark.parametrize("noise_level", [pytest.param(2.0, marks=pytest.mark.slow), 20.0])
def test_a_dead_sensor_that_was_mostly_noise_is_no_zero(noise_level: float) -> None:
    draw = np.random.default_rng(11)
    u = draw.standard_normal((N, 2))
    y = clean(u) + noise(draw, N) / LEVELS * [0.3, 0.1, noise_level]
    y[START:, 2] = 0.0
    answer, _, words = answered(y, u)
    assert answer.n_v is None and "stuck or dead" in words, words


def test_a_sensor_that_only_hums_since_it_died_is_no_zero() -> None:
    draw = np.random.default_rng(12)
    u = draw.standard_normal((N, 2))
    y = clean(u) + noise(draw, N) / LEVELS * [0.3, 0.1, 20.0]
    y[START:, 2] = 0.01 * draw.standard_normal(N - START)
    answer, _, words = answered(y, u)
    assert answer.n_v is None and "smaller than while healthy" in words, words


@pytest.mark.parametrize("length", [1, pytest.param(3, marks=pytest.mark.slow)])
def test_a_short_spike_in_a_long_record_is_no_zero(length: int) -> None:
    draw = np.random.default_rng(13)
    u = draw.standard_normal((20000, 2))
    y = clean(u) + noise(draw, 20000)
    y[15000 : 15000 + length, 1] += 20.0 * LEVELS[1]
    answer, _, words = answered(y, u, until=2000)
    assert answer.n_v is None and "times its healthy peak" in words, words


@pytest.mark.parametrize("seed", range(4)[:: every(2)])
def test_much_louder_inputs_make_no_fault_of_the_error_of_the_model(seed: int) -> None:
    draw = np.random.default_rng((14, seed))
    u = draw.standard_normal((N, 2))
    u[START:] *= 30.0
    answer, _, words = answered(clean(u) + noise(draw, N), u)
    assert answer.at_least == 0 and "the error of the model can look like a fault" in words, words


@pytest.mark.parametrize(
    ("sample", "size"),
    [
        (300, 1e150),
        pytest.param(900, 1e12, marks=pytest.mark.slow),
        pytest.param(300, 1e12, marks=pytest.mark.slow),
        pytest.param(900, 1e150, marks=pytest.mark.slow),
    ],
)
def test_an_outlier_beyond_all_numbers_is_no_crash(sample: int, size: float) -> None:
    y, u = biased(15, START)
    y[sample, 1] = size
    assert answered(y, u)[0].n_v != 0


def test_an_output_without_noise_makes_no_faults_of_the_noise_of_others() -> None:
    y, u = biased(16, N)
    y = np.hstack([y, u[:, :1]])
    names = (*made.OUTPUTS, "copy")
    assert identify(recorded(y, u, outputs=names, inputs=made.INPUTS), order=3).n_v is None
    y[START:, 2] += 20.0 * LEVELS[2] * np.random.default_rng(17).standard_normal(N - START)
    assert answered(y, u, outputs=names)[0].n_v in (1, None)


@pytest.mark.parametrize("seed", range(2)[:: every()])
def test_two_faults_in_separate_bands_are_not_counted_as_one(seed: int) -> None:
    """Against healthy samples one direction stands out at each frequency."""
    draw = np.random.default_rng((18, seed))
    u = draw.standard_normal((N, 2))
    bands = [butter(6, 0.3, output="sos"), butter(6, 0.7, "high", output="sos")]
    v = np.stack([sosfilt(band, draw.standard_normal(N)) for band in bands], axis=1)
    v[:START] = 0.0
    F, G = np.array([[1.0, 0.0], [0.3, 1.0], [0.5, 0.2]]), np.array([[0.4, 0.0], [0.0, 0.3], [1.0, 0.5]])
    driven = StateSpaceModel(made.A, np.hstack([made.B, F]), made.C, np.hstack([made.D, G]))
    answer, _, words = answered(driven.simulate(np.hstack([u, v])) + noise(draw, N) / LEVELS * 0.1, u)
    assert answer.n_v in (2, None) and answer.at_least >= 1, words


# Where the records end, and what is stated wrongly


def biased(seed: int, first: int, samples: int = N) -> tuple[Array, Array]:
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((samples, 2))
    y = clean(u) + noise(draw, samples)
    y[first:] += 20.0 * LEVELS
    return y, u


# What must be said changes at 50 and at N - 2: one below, two between and one above are tried daily.
UNTIL = {30: True, 64: True, N - 5: True, N - 1: True} | dict.fromkeys((20, 50, 150, 255, N - 64, N - 2), False)


@pytest.mark.parametrize("until", [pytest.param(k, marks=() if daily else pytest.mark.slow) for k, daily in UNTIL.items()])
def test_a_bias_beside_few_samples_is_seen_or_undecided(until: int) -> None:
    y, u = biased(until, until)
    answer, _, words = answered(y, u, until=until)
    assert answer.n_v != 0, words
    if 50 <= until <= N - 2:
        assert answer.moved and answer.at_least == 1, words


@pytest.mark.parametrize("first", [100, *(pytest.param(first, marks=pytest.mark.slow) for first in (400, 700))])
def test_a_fault_among_the_healthy_samples_gives_no_zero(first: int) -> None:
    answer, _, words = answered(*biased(first, first))
    assert answer.n_v != 0, words


def test_a_drift_through_all_samples_gives_no_zero() -> None:
    y, u = biased(5, N)
    answer, _, words = answered(y + np.outer(np.linspace(0.0, 5.0, N), LEVELS), u)
    assert answer.n_v != 0 and "mean" in answer.reason, words


@pytest.mark.parametrize("value", ["stuck", "dead"])
def test_an_output_that_is_still_after_the_healthy_samples_is_a_fault(value: str) -> None:
    y, u = biased(6, N)
    y[START:, 0] = y[START, 0] if value == "stuck" else 0.0
    kind = np.float32 if value == "stuck" else np.float64
    assert answered(y.astype(kind), u.astype(kind))[0].at_least == 1


@pytest.mark.parametrize("channel", ["input", "output"])
def test_a_channel_that_is_still_while_healthy_is_refused_with_the_reason(channel: str) -> None:
    y, u = biased(6, N)
    (u if channel == "input" else y)[:START, 0] = 1.0
    with pytest.raises(InvalidData, match="healthy: the model is from these samples alone"):
        answered(y, u)


@pytest.mark.parametrize("kind", ["none", "bias", "white"])
def test_without_noise_what_the_healthy_samples_do_not_show_is_a_fault(kind: str) -> None:
    draw = np.random.default_rng(7)
    u = draw.standard_normal((N, 2))
    y = clean(u)
    if kind != "none":
        y[START:, 0] += 1.0 if kind == "bias" else draw.standard_normal(N - START)
    answer, _, words = answered(y, u)
    assert (answer.n_v == 0) == (kind == "none"), words
    assert answer.at_least == (0 if kind == "none" else 1), words


def test_without_healthy_samples_a_mean_is_reported_and_decides_nothing() -> None:
    """That it is removed where no point is stated is asked in `test_operating_point.py`."""
    y, u = biased(9, 0)
    kept = identify(recorded(y, u, outputs=made.OUTPUTS, inputs=made.INPUTS), order=3, operating_point="zero")
    assert kept.n_v is None and any("an operating point, or a constant fault" in note for note in kept.notes)
    assert valid("identify", report.document(kept, "record") | {"files": []})["mean_shift"]["against"] == "zero"


def test_a_model_that_grows_only_beyond_the_healthy_samples_is_run_all_the_same() -> None:
    """A pole of 1.02 grows by 10 over 120 samples, and by 1e8 over 1000."""
    draw = np.random.default_rng(23)
    u = draw.standard_normal((1000, 1))
    y = np.zeros((1000, 2))
    state = 0.0
    for k in range(1000):
        y[k] = (state, 2.0 * state)
        state = (1.02 if k < 120 else 0.9) * state + u[k, 0]
    y += 1e-2 * draw.standard_normal(y.shape)
    found = identify(recorded(y, u, outputs=("one", "two"), inputs=("u",)), order=1, healthy=120)
    assert found.residual is not None and found.n_v != 0
