"""How well do models of measured records predict samples that they have not seen, beside those of today's tools?

    pip install ctrlsys nfoursid
    python benchmarks/plants.py --data DIR [--records NAME ...] [--most 12]

DIR is a clone of github.com/SLICOT/SLICOT-SystemIdentification, whose records come from DaISy (De Moor, KU Leuven); no data are kept here.

Every tool gets the first half of a record; each half is taken about its own means, since plants drift. An order is that of the best free
run on the last third of this half by a model of its first two thirds; the model is then made again from the whole half. `ours, left open`
is `arx_reduction` with no order told. Free run: 100 (1 - |y - yhat| / |y - mean|) % by output on the second half, simulated from the inputs
alone, the initial state fitted to it for all tools alike. `ARX` is least squares, its lags by the same rule. Negative fits are worse than
the mean. Behind an order, `*`: the model is not stable, and its growing modes are run backwards from the end, which no prediction could be.

RECORDS     name -> columns of inputs and outputs in the file NAME_dat.mat
free_run    the fits (p,) of a model on samples it has not seen
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy.io
from numpy.typing import NDArray

from benchmarks.peers_at_the_bound_tools import IDENTIFY, OURS, PAPER
from faultspace.base.errors import InvalidData
from faultspace.numeric import arx_reduction, residual
from faultspace.numeric.method.model.models import StateSpaceModel

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Columns:
    """These columns of the file are inputs and outputs."""

    inputs: slice
    outputs: slice
    words: str


RECORDS = {
    "robot_arm": Columns(slice(0, 1), slice(1, 2), "reaction torque to acceleration of an arm"),
    "CD_player_arm": Columns(slice(0, 2), slice(2, 4), "forces to tracking errors, in a closed loop"),
    "evaporator": Columns(slice(0, 3), slice(3, 6), "feed, vapour, cooling water to dry matter, flow, temperature"),
    "steamgen": Columns(slice(1, 5), slice(5, 9), "fuel, air, level, disturbance to pressure, oxygen, level, steam"),
    "powerplant": Columns(slice(1, 6), slice(6, 9), "gas, valves, spray, dampers, air to pressure and temperatures"),
    "cstr": Columns(slice(1, 2), slice(2, 4), "coolant flow to concentration and temperature"),
    "exchanger": Columns(slice(1, 2), slice(2, 3), "liquid flow to outlet temperature"),
}
ARX = "ARX"
OPEN = "ours, left open"
TOOLS = (OURS, PAPER, "SLICOT N4SID", "SLICOT MOESP", "nfoursid", ARX)


def free_run(model: StateSpaceModel, y: Array, u: Array) -> Array:
    """Return the fits (p,) in percent."""
    left = residual(y, u, model).r
    return np.asarray(100 * (1 - np.linalg.norm(left, axis=0) / np.linalg.norm(y - y.mean(axis=0), axis=0)))


def arx(y: Array, u: Array, order: int) -> StateSpaceModel:
    """Fit y(k) = sum A_i y(k-i) + sum B_i u(k-i), i up to the order, by least squares, and realise it in observer form."""
    p, n_u = y.shape[1], u.shape[1]
    rows = len(y) - order
    past = [y[order - i : order - i + rows] for i in range(1, order + 1)] + [u[order - i : order - i + rows] for i in range(order + 1)]
    found = np.linalg.lstsq(np.hstack(past), y[order:], rcond=None)[0].T
    own = [found[:, p * i : p * (i + 1)] for i in range(order)]
    driven = [found[:, p * order + n_u * i : p * order + n_u * (i + 1)] for i in range(order + 1)]
    A = np.eye(p * order, k=p)
    A[:, :p] = np.vstack(own)
    B = np.vstack([driven[i + 1] + own[i] @ driven[0] for i in range(order)])
    return StateSpaceModel(A, B, np.eye(p, p * order), driven[0])


def model_of(tool: str, y: Array, u: Array, order: int) -> StateSpaceModel:
    """Return the model of this order, or of this many lags. Raises what the tool raises."""
    if tool == ARX:
        return arx(y, u, order)
    rows = max(2 * order, 10)
    matrices = IDENTIFY[tool](y, u, order, min(rows, len(y) // (2 * u.shape[1] + y.shape[1] + 4)))
    return StateSpaceModel(*(np.real_if_close(np.asarray(matrix)).astype(float) for matrix in matrices))


def left_open(y: Array, u: Array) -> tuple[StateSpaceModel, str]:
    """Return our model with the order chosen from the data, and the orders that these leave open."""
    found = arx_reduction(y, u)
    assert found.orders is not None
    least, most = found.orders.least, found.orders.most
    return found.model, str(least) if least == most else f"{least} to {most}"


def chosen(tool: str, y: Array, u: Array, most: int) -> tuple[StateSpaceModel, str]:
    """Return the model of the order with the best free run on the last third, made again from all samples, and that order."""
    cut = 2 * len(y) // 3
    fits = [_fit_ahead(tool, y, u, cut, order) for order in range(1, most + 1)]
    if max(fits) == -np.inf:
        raise InvalidData("no order gives a model")
    order = 1 + int(np.argmax(fits))
    return model_of(tool, y, u, order), str(order)


def _fit_ahead(tool: str, y: Array, u: Array, cut: int, order: int) -> float:
    """Return the mean fit behind `cut` of the model of what stands before it, minus infinity where there is none."""
    try:
        with np.errstate(all="ignore"):
            fit = float(np.mean(free_run(model_of(tool, y[:cut], u[:cut], order), y[cut:], u[cut:])))
    except Exception:  # a peer may raise anything
        return -np.inf
    return fit if np.isfinite(fit) else -np.inf


def cell(tool: str, y: Array, u: Array, most: int) -> str:
    """Return the fits on the second half, each rounded, and in brackets the order or orders."""
    half = len(y) // 2
    y, u = (np.vstack([part - part.mean(axis=0) for part in (signal[:half], signal[half:])]) for signal in (y, u))
    try:
        with np.errstate(all="ignore"):
            model, order = left_open(y[:half], u[:half]) if tool == OPEN else chosen(tool, y[:half], u[:half], most)
            fits = free_run(model, y[half:], u[half:])
    except Exception as error:
        return f"none: {str(error)[:60]}"
    unstable = "" if np.max(np.abs(np.linalg.eigvals(model.A)), initial=0.0) < 1 else "*"
    return f"{', '.join(f'{fit:.0f}' if fit > 0 else 'below 0' for fit in fits)} ({order}{unstable})"


def main() -> None:
    """Print the table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True, help="clone of SLICOT-SystemIdentification")
    parser.add_argument("--records", nargs="+", default=list(RECORDS), choices=list(RECORDS))
    parser.add_argument("--most", type=int, default=12, help="largest order, or number of lags, that is tried")
    options = parser.parse_args()
    print(f"| record | {' | '.join((OPEN, *TOOLS))} |\n|{'---|' * (len(TOOLS) + 2)}")
    for name in options.records:
        columns = RECORDS[name]
        table = np.asarray(scipy.io.loadmat(options.data / f"{name}_dat.mat")[f"{name}_dat"], dtype=np.float64)
        y, u = table[:, columns.outputs], table[:, columns.inputs]
        print(f"| `{name}` | {' | '.join(cell(tool, y, u, options.most) for tool in (OPEN, *TOOLS))} |", flush=True)


if __name__ == "__main__":
    main()
