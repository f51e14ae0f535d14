"""Published implementations, called as their documentation tells and put to the same questions as our own. What calls them is ours.

    Peer      a name, what is called, how it is reached (an adapter module or a command), what to install, the version at hand
    PEERS     all of them
    peer      the one of that name
    FAULT_ID  the environment variable with the folder of a clone of ggleizer/fault_id
    MATRIX_PENCILS  the one with a folder of the package MatrixPencils and those that it needs, where Julia does not find it by itself

Nothing here imports a peer: a Python peer is imported where `adapters` calls it, one of Octave or Julia by its script. An adapter has the
functions that the package has, takes the defaults of the package where a user would, says why where it does not, and repairs nothing. A
warning that names the trouble counts as a refusal, as it does in our own adapter. Errors that lie in scripts, outside every function, are
in `by_hand.md`.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib import metadata
from pathlib import Path

from ....base.errors import InvalidData

FAULT_ID = "FAULT_ID"
MATRIX_PENCILS = "MATRIX_PENCILS"
VARIABLES = (FAULT_ID, MATRIX_PENCILS)  # which a peer's program sees, beside what any program needs
# Without optimization Julia is ready in half the time; the arithmetic of the peer is LAPACK's.
JULIA = ("julia", "--startup-file=no", "--optimize=0")
OCTAVE = ("octave-cli", "--no-gui", "--quiet", "--norc")
HERE = Path(__file__).parent


@dataclass(frozen=True)
class Peer:
    """This is a package to compare with. `adapter`: a module name for `adapter.load`, or None; `command`: a command for
    `subprocess_adapter.Exec`, or None. `version` gives None where the peer is not installed; `needs` says in a line what to install;
    `not_promised` is the NOT_PROMISED of what has no adapter module.
    """

    name: str
    title: str
    language: str
    adapter: str | None
    command: tuple[str, ...] | None
    needs: str
    version: Callable[[], str | None]
    not_promised: Callable[[], dict[str, str]] = dict


def _distribution(name: str) -> str | None:
    try:
        return f"{name} {metadata.version(name)}"
    except metadata.PackageNotFoundError:
        return None


@cache
def _octave(package: str | None = None) -> str | None:
    """Return Octave's version, with that of one of its packages; None where either is missing."""
    if shutil.which(OCTAVE[0]) is None:
        return None
    known = f"d = pkg('describe', '{package}'); printf('Octave %s, {package} %s', version(), d{{1}}.version)"
    asked = known if package else "printf('Octave %s', version())"
    run = subprocess.run([*OCTAVE, "--eval", asked], capture_output=True, check=False, stdin=subprocess.DEVNULL, text=True)
    return run.stdout.strip() or None


@cache
def _matrix_pencils() -> str | None:
    """Return the version of the package and that of Julia; None where either is missing. The package is not loaded, which takes long."""
    if shutil.which(JULIA[0]) is None:
        return None
    asked = (
        f'haskey(ENV, "{MATRIX_PENCILS}") && push!(LOAD_PATH, ENV["{MATRIX_PENCILS}"]); found = Base.find_package("MatrixPencils"); '
        'text = found === nothing ? "" : read(joinpath(dirname(dirname(found)), "Project.toml"), String); '
        'known = match(r"^version = .([0-9.]+)"m, text); known === nothing || print("MatrixPencils ", known[1], ", Julia ", VERSION)'
    )
    run = subprocess.run([*JULIA, "-e", asked], capture_output=True, check=False, stdin=subprocess.DEVNULL, text=True)
    return run.stdout.strip() or None


def _fault_id() -> str | None:
    """The clone has no version of its own: the first digits of the SHA-256 of the two functions called stand for it."""
    folder, octave = Path(os.environ.get(FAULT_ID, "")), _octave()
    called = [folder / name for name in ("pi_moesp.m", "estimate_input_matrices.m")]
    if octave is None or not all(file.is_file() for file in called):
        return None
    digest = hashlib.sha256(b"".join(file.read_bytes() for file in called)).hexdigest()
    return f"ggleizer/fault_id {digest[:12]}, {octave}"


def _of_moesp() -> dict[str, str]:
    from ._promises import coloured, more_block_rows_than_states

    return more_block_rows_than_states("moesp: The desired order of the resulting state-space system SYS. S > N > 0.") | coloured()


def _python(name: str, title: str, adapter: str, distribution: str) -> Peer:
    needs = f"pip install {distribution}"
    return Peer(name, title, "Python", f"{__name__}.adapters:{adapter}", None, needs, partial(_distribution, distribution))


def _script(name: str, title: str, file: str, needs: str, version: Callable[[], str | None], *arguments: str) -> Peer:
    return Peer(name, title, "Octave", None, (*OCTAVE, str(HERE / file), *arguments), needs, version)


CLONE = f"GNU Octave, a clone of github.com/ggleizer/fault_id, and its folder in the environment variable {FAULT_ID}"
CONTROL = "GNU Octave with its package control"
PENCILS = (
    f"Julia with its package MatrixPencils, which it finds by itself or in the folder that the environment variable {MATRIX_PENCILS} names"
)
PEERS = (
    _python("sippy_unipi", "sippy_unipi: MOESP, defaults (no D)", "Sippy", "sippy_unipi"),
    _python("sippy_unipi-D", "sippy_unipi: MOESP with SS_D_required=True", "SippyWithFeedthrough", "sippy_unipi"),
    _python("nfoursid", "nfoursid: NFourSID", "Nfoursid", "nfoursid"),
    _python("ctrlsys", "ctrlsys (SLICOT in C): ib01ad, ib01bd; ab08nd", "Ctrlsys", "ctrlsys"),
    _python("ctrlsys-C", "ctrlsys: ib01bd with METH = C (B and D by N4SID)", "CtrlsysCombined", "ctrlsys"),
    _python("python-control", "python-control: markov, eigensys_realization; StateSpace.zeros", "Control", "control"),
    _python("python-control-alone", "python-control without slycot: StateSpace.zeros", "ControlWithoutSlycot", "control"),
    _python("slycot", "slycot (SLICOT): ab08nd", "Slycot", "slycot"),
    replace(
        _script("octave-control", "Octave's control (SLICOT): moesp; zero", "octave_control.m", CONTROL, partial(_octave, "control")),
        not_promised=_of_moesp,
    ),
    Peer(
        "matrix-pencils",
        "MatrixPencils.jl: spzeros, sprank",
        "Julia",
        None,
        (*JULIA, str(HERE / "matrix_pencils.jl")),
        PENCILS,
        _matrix_pencils,
    ),
    _script("fault_id", "ggleizer/fault_id: PI-MOESP; rank and threshold of its exact example", "fault_id.m", CLONE, _fault_id),
    _script("fault_id-threshold", "ggleizer/fault_id: rank with the example's threshold 1", "fault_id.m", CLONE, _fault_id, "1"),
)


def peer(name: str) -> Peer:
    """This is the peer of that name. Raises InvalidData where there is none."""
    found = next((one for one in PEERS if one.name == name), None)
    if found is None:
        raise InvalidData(f"peer {name}: there is none of that name; there are {', '.join(one.name for one in PEERS)}")
    return found
