"""Faults that residual and inputs foretell are no news, and have no fault space; others are news."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace.numeric import StateSpaceModel, identify
from faultspace.numeric.plant.healthy.news import news_beyond_healthy

Array = NDArray[np.float64]
K, N = 300, 600
TIME = np.arange(N)
ON = TIME >= K


def residual_with(kind: str, size: float, seed: int) -> tuple[Array, Array]:
    """Return r and u of coloured noise that goes together across outputs, with faults of this kind in the second half."""
    draw = np.random.default_rng(seed)
    u, white = draw.standard_normal((N, 2)), draw.standard_normal((N, 3)) @ (np.eye(3) + 0.5 * draw.standard_normal((3, 3)))
    r = np.asarray(lfilter([1.0, 0.5], [1.0, -0.6], white, axis=0))
    news, direction = draw.standard_normal((N, 2)), draw.standard_normal((2, 3))
    fault = {
        "none": np.zeros((N, 3)),
        "constant": np.outer(np.ones(N), direction[0]),
        "ramp": np.outer((TIME - K) / K, direction[0]),
        "sine": np.outer(np.sin(0.3 * TIME + 1.0), direction[0]),
        "gain": np.outer(lfilter([1.0, 0.3], [1.0, -0.7], u[:, 0]), direction[0])
        + np.outer(lfilter([0.0, 1.0], [1.0, 0.4], u[:, 0]), direction[1]),
        "white": np.outer(news[:, 0], direction[0]),
        "slow": np.outer(lfilter([0.44], [1.0, -0.9], news[:, 0]), direction[0]),
        "two": news @ direction,
    }[kind]
    return r + size * fault * ON[:, None], u


def news(kind: str, size: float, seed: int) -> int | None:
    """Return the answer for such a record."""
    r, u = residual_with(kind, size, seed)
    return news_beyond_healthy(r[K:], u[K:], r[:K], u[:K], n_v=2, order=3)


@pytest.mark.parametrize("kind", ["none", "constant", "ramp", "sine", "gain"])
def test_what_the_past_and_the_inputs_tell_is_no_news(kind: str) -> None:
    assert [news(kind, size, seed) for size in (3.0, 30.0) for seed in range(4)] == [0] * 8


@pytest.mark.parametrize(("kind", "count"), [("white", 1), ("slow", 1), ("two", 2)])
def test_regular_faults_are_news_each_once(kind: str, count: int) -> None:
    assert [news(kind, size, seed) for size in (5.0, 30.0) for seed in range(4)] == [count] * 8


def test_nothing_is_said_of_few_samples_and_of_outputs_that_are_copies() -> None:
    r, u = residual_with("white", 10.0, 1)
    assert news_beyond_healthy(r[K : K + 90], u[K : K + 90], r[:K], u[:K], n_v=1, order=3) is None
    assert news_beyond_healthy(r[K:, :1] * [1, 1], u[K:], r[:K, :1] * [1, 1], u[:K], n_v=1, order=3) is None


@pytest.mark.parametrize("kind", ["sine", "white"])
def test_identify_gives_a_fault_space_of_what_is_news_alone(kind: str) -> None:
    r, u = residual_with("none", 0.0, 3)
    plant = StateSpaceModel([[0.7, 0.2], [-0.3, 0.5]], np.eye(2), [[1.0, 0.5], [0.2, 1.0], [1.0, -1.0]], np.zeros((3, 2)))
    y = plant.simulate(u) + 0.03 * r
    y[:, 1] += 0.3 * ON * (np.sin(0.3 * TIME) if kind == "sine" else np.random.default_rng(4).standard_normal(N))
    found = identify(y, u, order=2, n_v=1, healthy=K)
    said = any("foretells a fault" in note for note in found.notes)
    if kind == "sine":
        assert (found.n_v, found.news, found.fault_space, found.isolation, said) == (1, 0, None, None, True)
        advice = found.summary().split("## What to try next")[1]  # of three outputs and one fault
        assert "faults vary more" in advice and "more outputs than independent faults" not in advice
    else:
        assert (found.n_v, found.news, said) == (1, 1, False) and found.isolation is not None
        assert found.isolation.answer == "a sensor fault on y2 explains it, and no other single sensor or actuator does"
