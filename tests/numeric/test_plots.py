"""The plots: into the axes given, with what was asked to be seen in them, and drawable.

axes        of a figure without a window
points      the coordinates of a line of a plot
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.util import find_spec
from io import BytesIO
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method import plotting as drawing
from faultspace.numeric.method.ranks.rank_gap import FaultDimension, fault_dimension
from faultspace.numeric.method.signal.reconstruction import reconstruct_fault
from faultspace.numeric.plant.report.result_pictures import draw_signal

if find_spec("matplotlib") is None:
    pytest.skip("matplotlib is not installed", allow_module_level=True)
Array = NDArray[np.float64]


def figure(**options: Any) -> Any:
    """Return a figure of Matplotlib, which is loaded when the first of them is asked for: that takes half a second."""
    return import_module("matplotlib.figure").Figure(**options)


@pytest.fixture
def axes() -> Any:
    return figure(figsize=(8, 4.6), layout="constrained").add_subplot()


@pytest.fixture(scope="module")
def dimension() -> FaultDimension:
    """Return the count for a noise-free residual with one fault in three outputs."""
    v = np.random.default_rng(0).standard_normal(600)
    return fault_dimension(np.column_stack([v[2:], v[1:-1] + 0.5 * v[2:], v[:-2]]), block_rows=6)


def rendered(ax: Any) -> bytes:
    """Return the picture as it is written to files."""
    stream = BytesIO()
    ax.figure.savefig(stream, format="png")
    return stream.getvalue()


def points(ax: Any, number: int) -> tuple[Array, Array]:
    x, y = ax.lines[number].get_data()
    return np.asarray(x, dtype=float), np.asarray(y, dtype=float)


def words(ax: Any) -> str:
    """Return every word of the picture: title, axes, legend, annotations."""
    legend = [text.get_text() for text in ax.get_legend().get_texts()] if ax.get_legend() else []
    titles = [ax.get_title(loc) for loc in ("left", "center")]
    return " | ".join([*titles, ax.get_xlabel(), ax.get_ylabel(), *legend, *(text.get_text() for text in ax.texts)])


def drawings(dimension: FaultDimension) -> Iterator[Callable[[Any], Any]]:
    draw = np.random.default_rng(1)
    signal = draw.standard_normal((500, 3))
    yield lambda ax: drawing.plot_singular_values([5.0, 2.0, 1e-3, 0.0], order=2, ax=ax)
    yield lambda ax: drawing.plot_window_ranks(dimension, ax=ax)
    yield lambda ax: drawing.plot_zeros_and_poles([0.5 + 0.2j, 0.5 - 0.2j], [2.0], ax=ax)
    yield lambda ax: drawing.plot_measured_and_simulated(signal, signal + 0.1, ax=ax)
    yield lambda ax: drawing.plot_fault_signal(signal, trusted=(20, 480), ax=ax)
    yield lambda ax: drawing.plot_conditions([2.0, 1.0, 1e-9], 2, others="dimension 1", ax=ax)


@pytest.mark.parametrize("number", range(6))
def test_a_plot_returns_its_axes_and_draws(number: int, axes: Any, dimension: FaultDimension) -> None:
    draw = list(drawings(dimension))[number]
    assert draw(axes) is axes
    assert axes.get_xlabel() and axes.get_ylabel() and words(axes)
    picture = rendered(axes)
    assert picture.startswith(b"\x89PNG") and len(picture) > 5000


def test_without_axes_a_figure_is_made(dimension: FaultDimension, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "Agg")
    pyplot: Any = import_module("matplotlib.pyplot")
    ax = drawing.plot_window_ranks(dimension)
    assert rendered(ax).startswith(b"\x89PNG")
    pyplot.close(ax.figure)


def test_singular_values_up_to_the_order_are_filled(axes: Any) -> None:
    drawing.plot_singular_values([5.0, 2.0, 1e-3, 0.0], order=2, ax=axes)
    assert points(axes, 0)[0].tolist() == [1, 2] and points(axes, 1)[0].tolist() == [3, 4]
    assert axes.lines[1].get_fillstyle() == "none" and axes.lines[0].get_fillstyle() == "full"
    assert np.all(points(axes, 1)[1] > 0)  # zero has a place on a logarithmic scale
    assert points(axes, 2)[0].tolist() == [2.5, 2.5]


@pytest.mark.parametrize("window", [None, 2])
def test_windows_show_thresholds_and_ranks(window: int | None, axes: Any, dimension: FaultDimension) -> None:
    drawing.plot_window_ranks(dimension, window=window, ax=axes)
    s = window or 6
    for k, first in ((s - 1, 0), (s, 3)):
        above, below = points(axes, first), points(axes, first + 1)
        assert len(above[0]) == dimension.ranks[k] and len(above[0]) + len(below[0]) == len(dimension.singular_values[k])
        assert np.all(above[1] > dimension.thresholds[k]) and np.all(below[1] <= dimension.thresholds[k])
        assert points(axes, first + 2)[1].tolist() == [dimension.thresholds[k]] * 2
    assert f"rank {dimension.ranks[s - 1]} of" in words(axes) and f"= {dimension.n_v}" in words(axes)


def test_a_window_not_looked_at_is_refused(dimension: FaultDimension) -> None:
    for window in (0, 7):
        with pytest.raises(InvalidData, match="windows 1 to 6"):
            drawing.plot_window_ranks(dimension, window=window)


def test_far_zeros_are_inside_the_picture_and_scales_equal(axes: Any) -> None:
    drawing.plot_zeros_and_poles([0.9], [-7.0, 1j], ax=axes)
    assert axes.get_xlim()[0] < -7 and axes.get_xlim()[1] == -axes.get_xlim()[0] == axes.get_ylim()[1]
    assert axes.get_aspect() == 1.0
    assert "1 pole " in f"{words(axes)} " and "2 finite zeros" in words(axes)


def test_one_channel_keeps_its_units(axes: Any) -> None:
    y = np.linspace(50, 70, 40)
    drawing.plot_measured_and_simulated(y, y - 1, names=["kelvin"], first=100, ax=axes)
    assert points(axes, 0)[1].tolist() == y.tolist() and points(axes, 1)[1].tolist() == (y - 1).tolist()
    assert points(axes, 0)[0][0] == 100 and axes.get_ylabel() == "kelvin"


def test_several_channels_do_not_overlap_and_many_are_cut(axes: Any) -> None:
    draw = np.random.default_rng(2)
    y = draw.standard_normal((300, 11)) * 10.0 ** np.arange(11)
    drawing.plot_measured_and_simulated(y, 0 * y, ax=axes)
    ranges = [(points(axes, i)[1].min(), points(axes, i)[1].max()) for i in range(0, 16, 2)]
    assert all(upper[0] > lower[1] for upper, lower in pairwise(ranges))
    assert "8 of 11" in words(axes) and len(axes.lines) == 16


def test_undetermined_samples_are_shaded_and_do_not_set_the_scale(axes: Any) -> None:
    v = np.sin(np.arange(200.0))
    v[190:] = 1e9
    drawing.plot_fault_signal(v, trusted=(10, 190), ax=axes)
    assert axes.get_ylim()[1] < 3
    assert [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in axes.patches] == [(0, 10), (190, 199)]
    assert "not determined" in words(axes)


def test_long_signals_keep_their_extremes(axes: Any) -> None:
    v = np.zeros(100_000)
    v[77_777] = 1.0
    drawing.plot_fault_signal(v, ax=axes)
    (band,) = axes.collections
    assert np.max(band.get_paths()[0].vertices[:, 1]) == 1.0
    assert len(band.get_paths()[0].vertices) < 10_000


def test_conditions_taken_for_zero_are_open_and_as_many_as_the_dimension(axes: Any) -> None:
    drawing.plot_conditions([4.0, 2.0, 1.0, 1e-9, 0.0], 3, others="dimension 2", ax=axes)
    assert points(axes, 0)[1].tolist() == [1.0, 0.5, 0.25] and points(axes, 1)[0].tolist() == [4, 5]
    assert np.all(points(axes, 1)[1] > 0) and axes.lines[1].get_fillstyle() == "none"
    assert "3 independent conditions" in words(axes) and "dimension 2" in words(axes)


def test_under_noise_no_rank_is_shown(axes: Any) -> None:
    noise = np.random.default_rng(4).standard_normal((400, 2))
    counted = fault_dimension(noise)
    assert counted.regime == "noise"
    drawing.plot_window_ranks(counted, ax=axes)
    assert "above what noise reaches" in words(axes) and "rank " not in words(axes)


def test_the_detail_of_a_fault_signal_has_one_title() -> None:
    r = np.random.default_rng(1).standard_normal((600, 2))
    signal = reconstruct_fault(r, [[0.5]], [[1.0]], [[1.0], [0.0]], [[0.0], [1.0]])
    picture = figure()
    draw_signal(signal, (100, 400), picture)
    for ax in picture.axes:
        assert [bool(ax.get_title(place)) for place in ("left", "center", "right")].count(True) == 1


@pytest.mark.parametrize(
    "draw",
    [
        lambda: drawing.plot_singular_values([1.0, np.nan]),
        lambda: drawing.plot_singular_values([-1.0]),
        lambda: drawing.plot_zeros_and_poles([np.inf]),
        lambda: drawing.plot_measured_and_simulated(np.zeros(4), np.zeros(5)),
        lambda: drawing.plot_fault_signal([np.nan]),
        lambda: drawing.plot_conditions([-0.1], 1, others=""),
        lambda: drawing.plot_conditions([], 0, others=""),
    ],
)
def test_what_cannot_be_drawn_is_refused(draw: Callable[[], Any]) -> None:
    with pytest.raises(InvalidData):
        draw()
