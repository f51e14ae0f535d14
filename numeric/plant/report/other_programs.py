"""This hands an Identification over for other programs."""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ....base.errors import InvalidData
from ....base.writing import whole_file
from .by_experiment import numbered
from .causes_told import stretches

if TYPE_CHECKING:
    from ...method.model.models import StateSpaceModel
    from ..steps.findings import Answer

UNKNOWN = -1.0  # the sample time that MATLAB's `ss` takes where it is not stated


def handed_on(answer: Answer) -> StateSpaceModel:
    """Return the model, for what python-control and scipy.signal make of it. Raises InvalidData where there is none."""
    if answer.model is None:
        raise InvalidData("there is no model to hand on, since the order is undecided: state an order")
    return answer.model.model


def to_mat(answer: Answer, path: str | os.PathLike[str]) -> None:
    """Write A, B, C, D, F, G, x0, names and sample time into a MAT file; F and G have no columns where no pair was found."""
    from scipy.io import savemat

    model, record = handed_on(answer), answer.record
    F, G = answer.pair or (np.zeros((model.n, 0)), np.zeros((model.p, 0)))
    x0 = np.zeros(0) if answer.residual is None else answer.residual.x0
    content = {"A": model.A, "B": model.B, "C": model.C, "D": model.D, "F": F, "G": G, "x0": x0[:, np.newaxis]}
    # Object arrays become cell arrays, as names of different lengths must.
    names = {"inputs": np.array(record.inputs, dtype=object), "outputs": np.array(record.outputs, dtype=object)}
    with whole_file(Path(path)) as stream:
        savemat(stream, content | names | {"dt": UNKNOWN if answer.dt is None else answer.dt}, oned_as="column")


def to_pandas(answer: Answer) -> Any:
    """Return a DataFrame, a row a sample, with columns ("input", name), ("output", name), ("residual", name of the output),
    ("onset", "before"), how many onsets came before, and ("fault", v1, ..): NaN where the signal is not determined. Of several experiments
    the first column is ("experiment", "number"), 0 for a healthy record before them, and samples count in each."""
    try:
        pandas: Any = import_module("pandas")
    except ImportError:
        raise ImportError("to_pandas() needs pandas: pip install pandas") from None
    record = answer.record.about(np.zeros(len(answer.record.names)))
    y, u = record.stretch(0, len(record))
    columns = {("input", name): values for name, values in zip(record.inputs, u.T, strict=True)}
    columns |= {("output", name): values for name, values in zip(record.outputs, y.T, strict=True)}
    if answer.residual is not None:
        rest = answer.residual.store.read(0, len(record))
        columns |= {("residual", name): values for name, values in zip(record.outputs, rest.T, strict=True)}
        columns |= {("onset", "before"): np.zeros(len(record), dtype=int)}
    if answer.pair is not None:
        columns |= {("fault", f"v{j + 1}"): np.full(len(record), np.nan) for j in range(answer.pair[0].shape[1])}
    samples = np.arange(len(record))
    if answer.parts:
        columns = {("experiment", "number"): np.zeros(len(record), dtype=int)} | columns
    for number, start, place, part in numbered(answer):
        inside = slice(place, place + len(part.record) - start)
        if answer.parts:
            columns[("experiment", "number")][inside] = number
            samples[inside] = np.arange(len(part.record) - start)
        if part.residual is not None:
            columns[("onset", "before")][inside] = stretches(part, start, len(part.record))
        if part.signal is not None:
            first, last = (max(sample, start) for sample in part.signal.trusted)
            for j, values in enumerate(part.signal.store.read(first, last).T):
                columns[("fault", f"v{j + 1}")][place + first - start : place + last - start] = values
    index = pandas.Index(samples, name="sample") if answer.dt is None else pandas.Index(samples * answer.dt, name="time [s]")
    return pandas.DataFrame(columns, index=index)
