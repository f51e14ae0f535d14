"""This shows how a coloured fault biases past outputs: the exact limit of PO-MOESP beside what ours and a peer find in its data.

    python benchmarks/past_outputs_bias.py [--largest 1000000] [--quick] [--peer-python PATH]

benchmark_experiment   the identification benchmark's system and signals with every float taken as the rational it is, the fault at 0 dB
predicted      the model of a given order that PI-MOESP or PO-MOESP tends to, from the exact L
free_order     what the exact L of PO-MOESP says where the order is its rank
measured       PI-MOESP and PO-MOESP of numeric/, and ctrlsys where it is installed (here, or for --peer-python)
examined       all of it for one cell of the benchmark, as a sheet with notes

Data, order and errors are the identification benchmark's. There fault and noise are scaled by the record's own root mean squares, here by
the stationary ones. The double pole at 0.9 of system and fault makes the eigenvalues of order 5 as inaccurate as the root of an error.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not


from benchmarks.identification_cells import CELL, measure, python_command
from benchmarks.identification_data import FAULT_POLE, ORDER, Setting, errors, record, system, write
from benchmarks.sheets import Sheet, markdown
from faultspace.base.processes import Limits
from faultspace.base.progress import working
from faultspace.exact.algebra.matrices import Matrix, beside, column_basis, stacked
from faultspace.exact.algebra.stability import rational_characteristic_polynomial
from faultspace.exact.limits.column_space import state_part
from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.inputs import by_output_error
from faultspace.exact.limits.moesp import PopulationLimits, limit, markov_parameters
from faultspace.exact.limits.moments import covariances
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.past_outputs import po_moesp
from tests.numeric.predicted_limits import floats

# Inputs, outputs, block rows, sensor noise: the benchmark's four cells.
CELLS = ((1, 1, 10, 0.0), (2, 3, 10, 0.0), (2, 3, 20, 0.0), (2, 3, 20, 0.01))


@dataclass(frozen=True)
class Row:
    """The errors are those of `identification_data.errors`, NaN where the method gave no model; then `who` says why."""

    who: str
    samples: str
    eigenvalues: float
    markov: float


@dataclass(frozen=True)
class FreeOrder:
    """rank: of L of PO-MOESP; contains: the range of O_s is in that of L; shift_invariant: of that rank.

    poles_are_system_and_fault: det(qI - A) is that of the system times q - FAULT_POLE, exactly; markov_exact: output error gives the true
    D, CB, ... exactly.
    """

    rank: int
    contains: bool
    shift_invariant: bool
    poles_are_system_and_fault: bool
    markov_exact: bool


def benchmark_experiment(setting: Setting) -> Experiment:
    """Return the benchmark's setting as an exact experiment, past = s = block_rows. The levels of fault and noise are the floats nearest
    to the roots of exact ratios of variances.
    """
    both, driven = (_power(_experiment(setting, fault, 0.0)) for fault in (1.0, 0.0))
    size = sqrt(driven / setting.p)
    return _experiment(setting, sqrt(driven / (both - driven)), setting.noise * size)


def _power(experiment: Experiment) -> Fraction:
    """The power is E|y|^2."""
    known = covariances(experiment)
    now = known.now(known.process.y, known.process.y)
    return sum((Fraction(str(now[i, i])) for i in range(now.nrows)), Fraction(0))


def _experiment(setting: Setting, fault: float, noise: float) -> Experiment:
    n_u, p = setting.n_u, setting.p
    true = system(n_u, p)
    given: dict[str, Any] = {name: _rational(getattr(true.from_input, name)) for name in "ABCD"}
    # The level is that of v, so that F and G stay the benchmark's.
    given |= {"F": _rational(true.from_fault.B), "G": _rational(true.from_fault.D)}
    given |= {"s": setting.block_rows, "past": setting.block_rows}
    given["u_filter"] = [_rational(np.eye(n_u, n_u + 1))]
    given["v_filter"] = {"num": [_rational(fault * np.eye(n_u + 1)[n_u:])], "den": ["1", str(-Fraction(FAULT_POLE))]}
    if noise:
        given["w_filter"] = [_rational(noise * np.eye(p))]
    return read_experiment(given)


def _rational(matrix: Any) -> list[list[str]]:
    return [[str(Fraction(float(x))) for x in row] for row in matrix]


def predicted(found: PopulationLimits, order: int, *, past_outputs: bool) -> tuple[StateSpaceModel, Any]:
    """Return the limit of the model at this order, and the singular values of L Cov(Z | Uf)^-1/2 that it is cut from.

    Floats begin at the square root: left singular vectors of the weighted L, A and C from their shift, B and D by exact output error.
    """
    known, blocks, before = found.known, found.blocks, range(-found.experiment.past, 0)
    u, y = known.process.u, known.process.y
    limit = found.past_outputs if past_outputs else found.past_inputs
    whole, crossed = known.windows(u, u, before, before), blocks.uf_up
    p, s = y.H.nrows, found.experiment.s
    scale = np.sqrt(np.diag(floats(known.now(y, y))))  # PI-MOESP takes outputs in units of their root mean square
    if past_outputs:
        mixed = known.windows(u, y, before, before)
        whole = stacked(beside(whole, mixed), beside(mixed.transposed(), known.windows(y, y, before, before)))
        crossed, scale = beside(crossed, blocks.uf_yp), np.ones(p)
    values, directions = np.linalg.eigh(floats(whole - crossed.transposed() @ limit.projection))
    kept = values > values[-1] * 1e-12  # noise-free past outputs are combinations of states: L vanishes on the rest
    weighted = floats(limit.matrix) @ directions[:, kept] / np.sqrt(values[kept]) / np.tile(scale, s)[:, np.newaxis]
    vectors, singular, _ = np.linalg.svd(weighted)
    left = vectors[:, :order]
    A, C = np.linalg.lstsq(left[:-p], left[p:], rcond=None)[0], left[:p] * scale[:, np.newaxis]
    inputs = by_output_error(known, Matrix.of(_rational(A)), Matrix.of(_rational(C)))
    if inputs is None:
        raise ArithmeticError("the limit of A is unstable, or B and D are not unique")
    return StateSpaceModel(A, floats(inputs.B), C, floats(inputs.D)), singular


def free_order(found: PopulationLimits) -> FreeOrder:
    """Return what is found at the order that a gap in the singular values would tell."""
    limit, residual, given = found.past_outputs, found.experiment.system.residual, found.experiment.system
    state = state_part(column_basis(limit.matrix), residual.p)
    poles = markov = False
    if state is not None:
        own, pole = rational_characteristic_polynomial(residual.A), Fraction(FAULT_POLE)
        longer = [low - pole * high for low, high in zip((Fraction(0), *own), (*own, Fraction(0)), strict=True)]
        poles = tuple(longer) == state.characteristic_polynomial
        inputs = by_output_error(found.known, state.A, state.C)
        if inputs is not None:
            count = 2 * (residual.n + limit.rank) + 1  # enough for equality at all lags: Cayley-Hamilton for the difference
            true = markov_parameters(residual.A, given.B, residual.C, given.D, count)
            markov = markov_parameters(state.A, inputs.B, state.C, inputs.D, count) == true
    return FreeOrder(limit.rank, limit.contains_observability_range, state is not None, poles, markov)


def measured(setting: Setting, rank: int, peer_python: str | None) -> Iterator[Row]:
    """The methods are run on the benchmark's record."""
    samples = f"{setting.samples:.0e}".replace("e+0", "e")
    y, u = record(setting)
    for who, method, order in (("PI-MOESP", pi_moesp, ORDER), ("PO-MOESP", po_moesp, ORDER), ("PO-MOESP", po_moesp, rank)):
        model = method(y, u, order=order, block_rows=setting.block_rows).model
        yield Row(f"{who}, order {order}", samples, *errors(model, setting.n_u, setting.p))
    with tempfile.TemporaryDirectory() as name:
        write(setting, Path(name))
        command = python_command("ctrlsys")
        cell = measure([peer_python or command[0], *command[1:]], setting, Path(name), Limits(120.0, CELL.memory))
    if cell.eigenvalue_error is None or cell.markov_error is None:
        yield Row(f"ctrlsys: {cell.outcome}, {cell.why}", samples, float("nan"), float("nan"))
    else:
        yield Row(f"ctrlsys, order {ORDER}", samples, cell.eigenvalue_error, cell.markov_error)


def main(arguments: list[str] | None = None) -> int:
    """This prints a section for each shape."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--largest", type=int, default=10**6, help="samples of the longest record (default 1e6)")
    parser.add_argument("--quick", action="store_true", help="the first two of the benchmark's four cells")
    parser.add_argument("--peer-python", metavar="PATH", help="a Python that has ctrlsys, numpy and scipy (default: this one)")
    options = parser.parse_args(arguments)
    if options.largest < 1000:
        parser.error(f"got --largest {options.largest}, needed at least 1000")
    if options.peer_python and shutil.which(options.peer_python) is None:
        parser.error(f"got --peer-python {options.peer_python}, needed a program that can be run")
    lengths = [N for N in (10**4, 10**5) if options.largest > N] + [options.largest]
    cells = CELLS[: 2 if options.quick else None]
    for done, (n_u, p, block_rows, noise) in enumerate(cells):
        with working(f"past outputs, cell {done + 1} of {len(cells)}"):
            sheet, note = examined(Setting(n_u, p, block_rows, options.largest, noise), lengths, options.peer_python)
        print(markdown([sheet], note), end="\n\n", flush=True)
    return 0


def examined(setting: Setting, lengths: list[int], peer_python: str | None) -> tuple[Sheet, list[str]]:
    """The exact limits, then what was measured at each N, with notes on the order left free."""
    found = limit(benchmark_experiment(setting))
    free = free_order(found)
    rows, notes = [], []
    for past_outputs, order in ((False, ORDER), (True, ORDER), (True, free.rank)):
        model, singular = predicted(found, order, past_outputs=past_outputs)
        who = "PO-MOESP" if past_outputs else "PI-MOESP"
        rows.append(Row(f"{who}, order {order}", "exact limit", *errors(model, setting.n_u, setting.p)))
        if order == ORDER:
            leading = ", ".join(f"{x:.3g}" for x in singular[: free.rank + 1])
            notes.append(f"{who}: leading singular values of L Cov(Z given Uf)^-1/2: {leading}")
    for N in lengths:
        rows += measured(replace(setting, samples=N), free.rank, peer_python)
    said = {
        "contains the range of O_s": free.contains,
        "is shift-invariant": free.shift_invariant,
        f"has the poles of the system and {FAULT_POLE:g}": free.poles_are_system_and_fault,
        "has the true Markov parameters": free.markov_exact,
    }
    notes.append(
        f"exact L of PO-MOESP: rank {free.rank}; " + ", ".join(f"{words}: {'yes' if true else 'no'}" for words, true in said.items())
    )
    title = f"{setting.n_u}-in {setting.p}-out, s = past = {setting.block_rows}{', sensor noise' if setting.noise else ''}"
    cells = [[row.who, row.samples, f"{row.eigenvalues:.3g}", f"{row.markov:.3g}"] for row in rows]
    return Sheet(title, ["", "N", "eigenvalue error", "Markov error"], cells), notes


if __name__ == "__main__":
    sys.exit(main())
