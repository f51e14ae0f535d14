"""These are the pictures of `faultspace identify`, one a file.

main_picture the one picture of `Identification.plot`
pictures     draws what the Answer holds into a folder; remarks on what could not be had
drawn        one picture into a file, or the remark that says why there is none
PICTURES     the names of the files

    singular-values   of PI-MOESP, with the order
    window-ranks      singular values of the residual's windows, with thresholds and ranks
    noise-levels      where noise fills every window: what the best law on k mixed outputs leaves, which jumps at k = n_v
    zeros-and-poles   poles of the model, with the regions that hold them where these are known, and finite zeros of the faults
    spectra           of the residual, before and after the onset, and of the fault signal (residual_spectra.py)
    outputs           the last samples, measured against simulated
    residual, isolation, shift-causes    of causes_told.py: the residual of the whole record with its onsets, the angles of single causes
                           to the fault space, their chances where the mean has moved
    fault-signal      the whole record, and a detail of it where the residual is loudest
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ....base.errors import InvalidData, shorten
from ....base.writing import new_file
from ...method import plotting as drawing
from ...method.model.reduced_model import ReducedModel
from ...method.signal.residual_sizes import loudest
from ..steps.explaining import most_moved
from . import residual_spectra as spectra
from .causes_told import CAUSES_DRAWN, causes_drawn

if TYPE_CHECKING:
    from ...method.model.moesp_model import MoespModel
    from ...method.model.residuals import ResidualSignal
    from ...method.signal.reconstruction import Reconstruction
    from ..steps.findings import Answer

PICTURES = (
    "singular-values.png", "window-ranks.png", "noise-levels.png", "zeros-and-poles.png", "outputs.png", "fault-signal.png", "spectra.png",
    *CAUSES_DRAWN,
)  # fmt: skip
PICTURED = 300  # samples of a detail
WIDE, SQUARE, TALL = (8.0, 4.6), (5.2, 5.2), (8.0, 6.4)  # inches


def pictures(answer: Answer, folder: Path) -> list[str]:
    """Draw what there is; without matplotlib the sentence that says so."""
    try:
        figure: Any = import_module("matplotlib.figure")
    except ImportError:
        return ["no plots: matplotlib is not installed (pip install 'faultspace[plots]')"]

    def made(size: tuple[float, float], draw: Callable[[Any], Any]) -> Any:
        picture = figure.Figure(figsize=size, layout="constrained")
        draw(picture)
        return picture

    return [remark for name, size, draw in _drawings(answer) for remark in drawn(folder / name, partial(made, size, draw))]


def drawn(path: Path, make: Callable[[], Any]) -> list[str]:
    """Draw the figure that `make` returns into a new file; remarks where that fails: an answer does not depend on its pictures. Raises
    OSError where the file cannot be written."""
    matplotlib: Any = import_module("matplotlib")
    picture = BytesIO()
    try:
        # Whatever the user's settings, a name is never handed to TeX.
        with matplotlib.rc_context({"text.usetex": False}), warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # letters that the font lacks are drawn as boxes, long names leave less room
            make().savefig(picture, format="png", dpi=130)
    except Exception as error:
        return [f"{path.name}: matplotlib did not draw it ({shorten(f'{type(error).__name__}: {error}')})"]
    with new_file(path, "xb") as stream:
        stream.write(picture.getvalue())
    return []


def main_picture(answer: Answer, ax: Any = None) -> Any:
    """Draw the fault signal where there is one, else the last samples of the outputs, measured and simulated, into `ax` and return it.

    Raises InvalidData where there is no model to draw anything of."""
    if answer.residual is None:
        raise InvalidData("there is no model, so that there is nothing to draw: state an order")
    answer = most_moved(answer)
    assert answer.residual is not None
    if answer.signal is not None:
        return answer.signal.plot(ax)
    y, simulated, first = _last_outputs(answer, answer.residual)
    return drawing.plot_measured_and_simulated(y, simulated, names=answer.record.outputs, first=first, ax=ax)


def _last_outputs(answer: Answer, rest: ResidualSignal) -> tuple[Any, Any, int]:
    """Return the last PICTURED samples of the outputs, measured and simulated, and the number of the first of them."""
    N = len(answer.record)
    first = max(N - PICTURED, 0)
    y = answer.record.stretch(first, N)[0]
    return y, y - rest.store.read(first, N), first


def _drawings(answer: Answer) -> list[tuple[str, tuple[float, float], Callable[[Any], Any]]]:
    """Return name, size and what to do with a figure; of several experiments that in which the residual varies most is drawn."""
    answer = most_moved(answer)
    model, dimension, rest, signal = answer.model, answer.dimension, answer.residual, answer.signal
    order = model.order if model else None
    spectrum, ranks, levels, plane, outputs, faults, frequencies = PICTURES[:7]
    drawings: list[tuple[str, tuple[float, float], Callable[[Any], Any]]] = [
        (spectrum, WIDE, lambda figure: drawing.plot_singular_values(answer.singular_values, order=order, ax=figure.add_subplot()))
    ]
    if dimension and len(dimension.windows) > 1:
        drawings.append((ranks, WIDE, lambda figure: drawing.plot_window_ranks(dimension, ax=figure.add_subplot())))
    if dimension and dimension.levels:
        drawings.append((levels, WIDE, lambda figure: drawing.plot_levels(dimension.levels, dimension.n_v, ax=figure.add_subplot())))
    if model:
        zeros = signal.zeros if signal else np.zeros(0)
        drawings.append((plane, SQUARE, lambda figure: _plane(model, zeros, figure.add_subplot())))
    if rest:
        names = answer.record.outputs
        y, simulated, first = _last_outputs(answer, rest)
        draw = drawing.plot_measured_and_simulated
        drawings.append((outputs, WIDE, lambda figure: draw(y, simulated, names=names, first=first, ax=figure.add_subplot())))
    if answer.sizes and signal:
        near = loudest(answer.sizes.energies, len(signal.store), PICTURED)
        drawings.append((faults, TALL, lambda figure: draw_signal(signal, near, figure)))
    found = spectra.panels(answer)
    if found:
        drawings.append((frequencies, (8.0, spectra.height(len(found))), lambda figure: spectra.draw(found, answer.dt, figure)))
    return [*drawings, *causes_drawn(answer)]


def _plane(model: MoespModel | ReducedModel, zeros: Any, ax: Any) -> Any:
    """Draw poles and zeros, with the regions of the poles where the model knows how sure it is."""
    if isinstance(model, ReducedModel):
        return model.uncertainty.plot(ax, zeros=zeros)
    return drawing.plot_zeros_and_poles(model.model.poles, zeros, ax=ax)


def draw_signal(signal: Reconstruction, near: tuple[int, int], figure: Any) -> None:
    """Draw the whole signal above, the samples `near` below."""
    whole, detail = figure.subplots(2)
    signal.plot(whole)
    drawing.plot_stored_signal(signal.store, signal.trusted, first=near[0], last=near[1], ax=detail)
    whole.set_xlabel("")
    # A legend moves a title to the left; there is one title, wherever it stood.
    detail.set_title("")
    detail.set_title("Detail, where the residual is loudest", loc="left")
