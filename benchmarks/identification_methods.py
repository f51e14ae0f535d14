"""These are the methods of the identification benchmark. Each is a program of its own, run in a folder with a record, that writes one line:

    RESULT {"seconds": ..., "megabytes": ..., "changed": ..., "A": ..., "B": ..., "C": ..., "D": ...}

A method prepares the record as its interface wants it (Fortran order, transposed, a data frame), which is neither timed nor counted as
memory; it runs once on WARM samples, so that what is imported late is there; then on all samples, the peak of the resident memory above
that before the call being noted; short ones REPEATS times, each on a fresh copy, the least time counting.

    Method      name, what it does, what it gives, what it needs
    METHODS     ours first

`python -m benchmarks.identification_methods NAME` runs a Python method in the folder it is started in; the names in SPECIAL are not
methods: the rates of the machine, and our side of the study.
"""

from __future__ import annotations

import json
import resource
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.identification_bounds import rates_here
from benchmarks.identification_cells import RESULT, python_command
from benchmarks.identification_data import ORDER, Array, Setting, read
from benchmarks.identification_octave import author_script, octave_command, octave_missing, octave_version, packaged_script
from benchmarks.identification_study import study_here

WARM = 2000
REPEATS = 5
BRIEF = 1.0  # CPU seconds below which a call is repeated
Matrices = tuple[Any, Any, Any, Any]
Call = Callable[[], Matrices | None]
Preparation = Callable[[Array, Array, Setting], Call]


@dataclass(frozen=True)
class Method:
    """A method `needs` "" (ours), a Python distribution, or "octave", `gives` "factor" or "model", and has its tool's `instruments`."""

    name: str
    words: str
    gives: str
    instruments: str
    needs: str = ""

    def missing(self, fault_id: Path | None) -> str | None:
        """It says why the method cannot run here; None means that it can."""
        if self.needs == "octave":
            if self.name == "fault-id" and fault_id is None:
                return "no clone of ggleizer/fault_id given (--fault-id)"
            return octave_missing()
        try:
            version(self.needs or "numpy")
        except PackageNotFoundError:
            return f"the Python package {self.needs} is not installed"
        return None

    def version(self) -> str:
        """It names the package and its version."""
        if self.needs == "octave":
            return octave_version()
        return f"{self.needs} {version(self.needs)}" if self.needs else f"numpy {np.__version__}, scipy {version('scipy')}"

    def command(self, setting: Setting, fault_id: Path | None) -> list[str]:
        """Return what runs it in the folder of the record."""
        if self.needs != "octave":
            return python_command(self.name)
        if self.name == "fault-id":
            assert fault_id is not None
            return octave_command(author_script(setting, fault_id))
        return octave_command(packaged_script(self.name, setting))


def _pi_moesp(y: Array, u: Array, setting: Setting) -> Call:
    from faultspace.numeric.method.model.past_inputs import pi_moesp

    def call() -> Matrices:
        found = pi_moesp(y, u, order=ORDER, block_rows=setting.block_rows)
        return found.A, found.B, found.C, found.D

    return call


def _from_compression(y: Array, u: Array, setting: Setting) -> Call:
    from faultspace.numeric.method.model.compression import compress
    from faultspace.numeric.method.model.past_inputs import pi_moesp_from_compression

    def call() -> Matrices:
        found = pi_moesp_from_compression(compress(y, u, block_rows=setting.block_rows), order=ORDER)
        return found.A, found.B, found.C, found.D

    return call


def _compression(route: str) -> Preparation:
    def prepared(y: Array, u: Array, setting: Setting) -> Call:
        from faultspace.numeric.method.model.compression import compress

        def call() -> None:
            compress(y, u, block_rows=setting.block_rows, route=route)

        return call

    return prepared


def _ib01ad(algorithm: str, y: Array, u: Array, setting: Setting) -> Array:
    """Return SLICOT's factor R and the singular values: one sequential block, no past data, order by the gap (not used)."""
    import ctrlsys

    _, factor, _, _, info = ctrlsys.ib01ad("M", algorithm, "N", "O", "N", "N", setting.block_rows, setting.n_u, setting.p, u, y, 0.0, -1.0)
    if info != 0:
        raise RuntimeError(f"ctrlsys: ib01ad({algorithm}) gives info = {info}")
    return np.asarray(factor)


def _ctrlsys_factor(algorithm: str) -> Preparation:
    def prepared(y: Array, u: Array, setting: Setting) -> Call:
        outputs, inputs = np.asfortranarray(y), np.asfortranarray(u)

        def call() -> None:
            _ib01ad(algorithm, outputs, inputs, setting)

        return call

    return prepared


def _ctrlsys(y: Array, u: Array, setting: Setting) -> Call:
    """Return A and C from ib01bd, whose B and D are wrong with info = 0; B, D and x0 from ib01cd, which SLICOT offers for that."""
    import ctrlsys

    s, n_u, p = setting.block_rows, setting.n_u, setting.p
    outputs, inputs = np.asfortranarray(y), np.asfortranarray(u)

    def call() -> Matrices:
        factor = np.asfortranarray(_ib01ad("C", outputs, inputs, setting))
        A, C, *_, info = ctrlsys.ib01bd("M", "C", "N", s, ORDER, n_u, p, len(outputs), factor, 0.0)
        if info != 0:
            raise RuntimeError(f"ctrlsys: ib01bd gives info = {info}")
        kept = np.array(A, order="F"), np.array(C, order="F")
        empty = np.zeros((ORDER, n_u), order="F"), np.zeros((p, n_u), order="F")
        _, B, D, *_, info = ctrlsys.ib01cd(
            "X", "C", "D", ORDER, n_u, p, kept[0].copy("F"), empty[0], kept[1].copy("F"), empty[1], inputs, outputs, 0.0
        )
        if info != 0:
            raise RuntimeError(f"ctrlsys: ib01cd gives info = {info}")
        return kept[0], B, kept[1], D

    call.touches = (outputs, inputs)  # type: ignore[attr-defined]
    return call


def _sippy(y: Array, u: Array, setting: Setting) -> Call:
    from sippy_unipi import system_identification

    outputs, inputs, s = np.ascontiguousarray(y.T), np.ascontiguousarray(u.T), setting.block_rows

    def call() -> Matrices:
        found = system_identification(outputs, inputs, "MOESP", SS_fixed_order=ORDER, SS_f=s, SS_p=s, SS_D_required=True)
        return found.A, found.B, found.C, found.D

    call.touches = (outputs, inputs)  # type: ignore[attr-defined]
    return call


def _nfoursid(y: Array, u: Array, setting: Setting) -> Call:
    import pandas
    from nfoursid.nfoursid import NFourSID

    names = [f"y{i}" for i in range(setting.p)], [f"u{i}" for i in range(setting.n_u)]
    frame = pandas.DataFrame(np.hstack([y, u]), columns=names[0] + names[1])

    def call() -> Matrices:
        run = NFourSID(frame, output_columns=names[0], input_columns=names[1], num_block_rows=setting.block_rows)
        run.subspace_identification()
        found, _ = run.system_identification(rank=ORDER)
        return found.a, found.b, found.c, found.d

    return call


def _control(y: Array, u: Array, setting: Setting) -> Call:
    """A FIR model by least squares, as long as the subspace methods' two windows, then the eigensystem realisation."""
    import control

    outputs, inputs = np.ascontiguousarray(y.T), np.ascontiguousarray(u.T)

    def call() -> Matrices:
        markov = control.markov(outputs, inputs, 2 * setting.block_rows)
        found, _ = control.eigensys_realization(markov.reshape(setting.p, setting.n_u, -1), ORDER)
        return found.A, found.B, found.C, found.D

    return call


METHODS = (
    Method("ours", "pi_moesp: compression, A and C, B and D and x0 by output error, residual covariance", "model", "past inputs"),
    Method("ours-moesp", "compression, A and C, B and D by MOESP's regression: the data are read once", "model", "past inputs"),
    Method("ours-gram", "the compression alone, by Hankel displacement", "factor", "past inputs"),
    Method("ours-qr", "the compression alone, by sequential QR", "factor", "past inputs"),
    Method("ctrlsys-C", "ib01ad, Cholesky, alone (C translation of SLICOT)", "factor", "past outputs", "ctrlsys"),
    Method("ctrlsys-F", "ib01ad, fast QR, alone", "factor", "past outputs", "ctrlsys"),
    Method("ctrlsys", "ib01ad (Cholesky), A and C by ib01bd, B, D and x0 by ib01cd", "model", "past outputs", "ctrlsys"),
    Method("fault-id", "pi_moesp.m of ggleizer/fault_id as published, under Octave", "model", "past inputs", "octave"),
    Method("moen4", "Octave's control package (SLICOT, Cholesky)", "model", "past outputs", "octave"),
    Method("moesp", "Octave's control package (SLICOT, Cholesky)", "model", "past outputs", "octave"),
    Method("control", "python-control: markov (least squares), then eigensys_realization", "model", "none (FIR)", "control"),
    Method("sippy", "system_identification(..., 'MOESP')", "model", "past outputs", "sippy_unipi"),
    Method("nfoursid", "NFourSID", "model", "past outputs", "nfoursid"),
)
PREPARATIONS: dict[str, Preparation] = {
    "ours": _pi_moesp,
    "ours-moesp": _from_compression,
    "ours-gram": _compression("gram"),
    "ours-qr": _compression("qr"),
    "ctrlsys-C": _ctrlsys_factor("C"),
    "ctrlsys-F": _ctrlsys_factor("F"),
    "ctrlsys": _ctrlsys,
    "control": _control,
    "sippy": _sippy,
    "nfoursid": _nfoursid,
}


SPECIAL: dict[str, Callable[[], dict[str, Any]]] = {"rates": lambda: asdict(rates_here()), "study": study_here}


def cpu_seconds() -> float:
    """Return this process's CPU time. Under a limit on it, time.process_time would move in the kernel's ticks, 4 ms here."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def run(name: str, folder: Path) -> dict[str, Any]:
    """Run the method on the record in the folder, and return what it tells."""
    prepare = PREPARATIONS[name]
    setting, y, u = read(folder)
    prepare(y[:WARM].copy(), u[:WARM].copy(), setting)()
    call = prepare(y, u, setting)
    touched: tuple[Array, ...] = getattr(call, "touches", ())
    before = [array.copy() for array in touched]
    floor = _reset_peak()
    start = cpu_seconds()
    matrices = call()
    times = [cpu_seconds() - start]
    peak = _status("VmHWM") if floor is not None else None
    changed = any(not np.array_equal(array, kept) for array, kept in zip(touched, before, strict=True))
    while times[0] < BRIEF and len(times) < REPEATS:
        again = prepare(y, u, setting)
        start = cpu_seconds()
        again()
        times.append(cpu_seconds() - start)
    answer: dict[str, Any] = {"seconds": min(times), "changed": changed}
    if floor is not None and peak is not None:
        answer["megabytes"] = max(peak - floor, 0) / 1024
    if matrices is not None:
        answer |= {letter: np.atleast_2d(np.asarray(matrix)).tolist() for letter, matrix in zip("ABCD", matrices, strict=True)}
    return answer


def _status(field: str) -> int | None:
    """Return a field of Linux's account of this process, in KB."""
    file = Path("/proc/self/status")
    if not file.exists():
        return None
    return next((int(line.split()[1]) for line in file.read_text().splitlines() if line.startswith(field + ":")), None)


def _reset_peak() -> int | None:
    """Return the resident KB from which a new peak counts; None where the system does not let the peak be reset."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return None
    return _status("VmRSS")


if __name__ == "__main__":
    print(RESULT + json.dumps(SPECIAL[sys.argv[1]]() if sys.argv[1] in SPECIAL else run(sys.argv[1], Path.cwd())), flush=True)
