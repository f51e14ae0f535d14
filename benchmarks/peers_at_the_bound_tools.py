"""These are the tools of the comparison at the bound. Each runs in a process of its own that answers the audit's questions by JSON lines.

    Tool       a name, what is called, what the method rests on, what it needs
    TOOLS      all of them, ours first
    IDENTIFY   name -> the function of a Python tool: identify(y, u, order, block_rows) -> A, B, C, D

`python -m benchmarks.peers_at_the_bound_tools NAME` answers for a Python tool; Octave's answer through the script that `Tool.command`
makes. Every tool is called as one does who knows it well: where a package has a way around one of its defects, it is taken, and a warning
counts for nothing. A tool fails where it gives no model.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from typing import Any

import numpy as np
from numpy.typing import NDArray

from faultspace.numeric.audit import peers

Array = NDArray[np.float64]
Matrices = tuple[Any, Any, Any, Any]
Identify = Callable[[Array, Array, int, int], Matrices]

OURS, PAPER, AUTHOR = "ours", "paper's way", "author's program"
OCTAVE = "octave"


@dataclass(frozen=True)
class Tool:
    """A tool has a name, `words` for what is called, the `basis` of its estimate, what it `needs` ("" for this package, a Python
    distribution, OCTAVE, or peers.FAULT_ID), and says whether it has a window of block rows.
    """

    name: str
    words: str
    basis: str
    needs: str = ""
    windowed: bool = True

    def version(self) -> str | None:
        """Return the version at hand; None where the tool is not installed."""
        if self.needs == OCTAVE:
            return peers.peer("octave-control").version()
        if self.needs == peers.FAULT_ID:
            return peers.peer("fault_id").version()
        try:
            return f"{self.needs or 'faultspace'} {metadata.version(self.needs or 'faultspace')}"
        except metadata.PackageNotFoundError:
            return None

    def command(self) -> list[str]:
        """Return the program that answers for the tool."""
        if self.needs == peers.FAULT_ID:
            return list(peers.peer("fault_id").command or ())
        if self.needs == OCTAVE:
            return [*peers.OCTAVE, "--eval", OCTAVE_SCRIPT % (peers.HERE / "json_lines.m", self.name.rpartition(" ")[2])]
        return [sys.executable, "-m", "benchmarks.peers_at_the_bound_tools", self.name]


OCTAVE_SCRIPT = """1;
pkg load control
source ("%s");
function a = identify (q)
  found = %s (iddata (q.y, q.u, 1), q.order, "s", q.block_rows);
  lastwarn ("");
  [a.A, a.B, a.C, a.D] = ssdata (found);
end
answer_questions (struct ("identify", @identify));
"""


def _arx_reduction(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    from faultspace.numeric import arx_reduction

    found = arx_reduction(y, u, order=order).model
    return found.A, found.B, found.C, found.D


def _pi_moesp(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    from faultspace.numeric import pi_moesp

    found = pi_moesp(y, u, order=order, block_rows=block_rows).model
    return found.A, found.B, found.C, found.D


def _slicot_moesp(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    """Return A and C from ib01bd, whose B and D are wrong with info = 0; B and D from ib01cd, which fits them with x0."""
    import ctrlsys

    n_u, p = u.shape[1], y.shape[1]
    A, C, *_ = _slicot("M", "C", y, u, order, block_rows)
    A, C = np.array(A, order="F"), np.array(C, order="F")
    B, D = np.zeros((order, n_u), order="F"), np.zeros((p, n_u), order="F")
    data = np.asfortranarray(u).copy("F"), np.asfortranarray(y).copy("F")  # it writes to them
    _, B, D, *_, info = ctrlsys.ib01cd("X", "C", "D", order, n_u, p, A.copy("F"), B, C.copy("F"), D, *data, 0.0)
    if info != 0:
        raise RuntimeError(f"ib01cd: info = {info}")
    return A, B, C, D


def _slicot_n4sid(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    A, C, B, D, *_ = _slicot("N", "A", y, u, order, block_rows)
    return A, B, C, D


def _slicot(method: str, job: str, y: Array, u: Array, order: int, block_rows: int) -> Any:
    """Call ib01ad with its usual choices, then ib01bd."""
    import ctrlsys

    n_u, p = u.shape[1], y.shape[1]
    data = np.asfortranarray(u), np.asfortranarray(y)
    _, factor, *_, info = ctrlsys.ib01ad(method, "C", "N", "O", "N", "N", block_rows, n_u, p, *data, 0.0, -1.0)
    if info != 0:
        raise RuntimeError(f"ib01ad: info = {info}")
    *found, info = ctrlsys.ib01bd(method, job, "N", block_rows, order, n_u, p, len(y), np.asfortranarray(factor), 0.0)
    if info != 0:
        raise RuntimeError(f"ib01bd: info = {info}")
    return found


def _sippy(name: str) -> Identify:
    def identify(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
        from sippy_unipi import system_identification

        options = {"SS_f": block_rows, "SS_p": block_rows, "SS_fixed_order": order, "SS_D_required": True}
        found = system_identification(y.T.copy(), u.T.copy(), name, **options)
        return found.A, found.B, found.C, found.D

    return identify


def _sippy_armax(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    """Fit a model of the order to each output by itself, all polynomials of that degree."""
    from sippy_unipi import system_identification

    n_u, p = u.shape[1], y.shape[1]
    each, inputs, no_delay = [order] * p, [[order + 1] * n_u for _ in range(p)], [[0] * n_u for _ in range(p)]
    # Its polynomials have no direct feedthrough; inputs that come one sample early give it to them.
    early, outputs = u[1:].T.copy(), y[:-1].T.copy()
    found = system_identification(outputs, early, "ARMAX", ARMAX_orders=[each, inputs, each, no_delay], ARMAX_mod="OPT")
    numerators, denominators = (found.NUMERATOR, found.DENOMINATOR) if p > 1 else (found.G.num, found.G.den)
    return _realised(numerators, denominators, p, n_u)


def _realised(numerators: Any, denominators: Any, p: int, n_u: int) -> Matrices:
    """Return matrices of q G(q), the entries of G strictly proper and given by their polynomials, each with states of its own."""
    import scipy.linalg
    import scipy.signal

    blocks, columns, rows = [], [], []
    for i in range(p):
        for j in range(n_u):
            block, column, row, _ = scipy.signal.tf2ss(np.ravel(numerators[i][j]), np.ravel(denominators[i][j]))
            blocks.append(block)
            columns.append(column @ np.eye(n_u)[[j]])
            rows.append(np.eye(p)[:, [i]] @ row)
    A, B, C = scipy.linalg.block_diag(*blocks), np.vstack(columns), np.hstack(rows)
    return A, B, C @ A, C @ B


def _nfoursid(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    from faultspace.numeric.audit.peers.adapters import by_nfoursid

    return by_nfoursid(y, u, order, block_rows)


def _era(y: Array, u: Array, order: int, block_rows: int) -> Matrices:
    """Realise a FIR model by least squares, as long as the two windows of a subspace method and no shorter than its default asks for."""
    import control

    response = control.markov(y.T, u.T, max(2 * block_rows, 4 * order + 1))
    found, _ = control.eigensys_realization(response.reshape(y.shape[1], u.shape[1], -1), order)
    return found.A, found.B, found.C, found.D


PAST_INPUTS, PAST_DATA, ERRORS, IMPULSE = "past inputs", "past outputs", "prediction errors", "impulse response"
TOOLS = (
    Tool(OURS, "arx_reduction", ERRORS, windowed=False),
    Tool(PAPER, "pi_moesp", PAST_INPUTS),
    Tool(AUTHOR, "pi_moesp.m of ggleizer/fault_id, under Octave", PAST_INPUTS, peers.FAULT_ID),
    Tool("SLICOT MOESP", "ctrlsys: ib01ad, A and C by ib01bd, B and D by ib01cd", PAST_DATA, "ctrlsys"),
    Tool("SLICOT N4SID", "ctrlsys: ib01ad, ib01bd", PAST_DATA, "ctrlsys"),
    Tool("Octave moesp", "Octave's package control, moesp", PAST_DATA, OCTAVE),
    Tool("Octave moen4", "Octave's package control, moen4", PAST_DATA, OCTAVE),
    Tool("sippy MOESP", "sippy_unipi: MOESP", PAST_DATA, "sippy_unipi"),
    Tool("sippy N4SID", "sippy_unipi: N4SID", PAST_DATA, "sippy_unipi"),
    Tool("sippy CVA", "sippy_unipi: CVA", PAST_DATA, "sippy_unipi"),
    Tool("sippy PARSIM-K", "sippy_unipi: PARSIM-K", PAST_DATA, "sippy_unipi"),
    Tool("nfoursid", "nfoursid: NFourSID", PAST_DATA, "nfoursid"),
    Tool("sippy ARMAX", "sippy_unipi: ARMAX (OPT), each output by itself", ERRORS, "sippy_unipi", windowed=False),
    Tool("control ERA", "python-control: markov, eigensys_realization", IMPULSE, "control"),
)
IDENTIFY: dict[str, Identify] = {
    OURS: _arx_reduction,
    PAPER: _pi_moesp,
    "SLICOT MOESP": _slicot_moesp,
    "SLICOT N4SID": _slicot_n4sid,
    **{f"sippy {name}": _sippy(name) for name in ("MOESP", "N4SID", "CVA", "PARSIM-K")},
    "sippy ARMAX": _sippy_armax,
    "nfoursid": _nfoursid,
    "control ERA": _era,
}


def answer(identify: Identify, line: str) -> dict[str, Any]:
    """Answer one question of the protocol; an exception is a refusal in its own words."""
    question = json.loads(line)
    if question["call"] == "functions":
        return {"functions": ["identify"]}
    y, u = np.array(question["y"], dtype=float), np.array(question["u"], dtype=float)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            matrices = identify(y, u, question["order"], question["block_rows"])
        found = [np.real_if_close(np.asarray(matrix)).astype(float) for matrix in matrices]
        if not all(np.all(np.isfinite(matrix)) for matrix in found):
            return {"refused": "the model has entries that are not finite"}
        return {name: matrix.tolist() for name, matrix in zip("ABCD", found, strict=True)}
    except (Exception, SystemExit) as error:
        return {"refused": f"{type(error).__name__}: {error}"[:160]}


def main(name: str) -> None:
    """Answer until standard input ends, through a copy of standard output that the package does not see."""
    with os.fdopen(os.dup(1), "w") as answers, open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
        for line in sys.stdin:
            answers.write(json.dumps(answer(IDENTIFY[name], line)) + "\n")
            answers.flush()


if __name__ == "__main__":
    main(sys.argv[1])
