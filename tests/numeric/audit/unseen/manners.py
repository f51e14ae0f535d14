"""Bad manners: arguments written into, global state left changed, memories of other questions."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.manners_witnesses import again_after, asked_often, forgets, keeps, leaves, quiet, read_only, unshared
from tests.numeric.audit.unseen.systems import faulty, general, plant, record
from tests.numeric.audit.unseen.witnesses import counts, ranks, recovers

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")

MODEL = plant([0.6, -0.3], 1, 2, 501)
ONE, OTHER = record(MODEL, 200, 501), record(plant([0.5, -0.2], 1, 2, 502), 200, 502)
FAULT, FAULT2 = faulty(general([0.7, -0.4, 0.3], 1, 2, 503), 200, 503), faulty(general([0.5, -0.6, 0.2], 1, 2, 504), 200, 504)
TWO = faulty(general([0.7, -0.4], 2, 3, 505), 200, 505)
RECORD = (ONE.y, ONE.u, 2, 4)
MATRICES = (ONE.model.A, ONE.model.B, ONE.model.C, ONE.model.D)
SYSTEM = (TWO.A, TWO.F, TWO.C, TWO.G)
FAULTS = (FAULT.r, FAULT.A, FAULT.C, 1, 4)


@IDENTIFY.broken("all records", keeps(*RECORD))
def scales_the_record_in_place(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The caller's y is divided by its size, and C and D are scaled back."""
    size = np.std(y, axis=0)
    y /= size
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, size[:, None] * C, size[:, None] * D


@IDENTIFY.broken("read-only arrays, other threads that read", read_only(recovers(ONE, 2, 4), *RECORD))
def scales_in_place_and_back(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The caller's y is doubled for a while, which changes no bit in the end, and cannot be done where it is read-only."""
    y *= 2.0
    A, B, C, D = reference.identify(y, u, order, block_rows)
    y *= 0.5
    return A, B, C / 2, D / 2


@IDENTIFY.broken("all records: the last bits of u change", keeps(*RECORD))
def removes_the_mean_and_adds_it(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The caller's u has its mean taken off and put back, which rounds."""
    found = reference.identify(y, u.copy(), order, block_rows)
    mean = u.mean(axis=0) + 1.0
    u -= mean
    u += mean
    return found


@IDENTIFY.broken("programs that open files by relative names", leaves(os.getcwd, lambda: os.chdir(Path(__file__).parents[4]), *RECORD))
def changes_the_folder(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The working folder is that of temporary files afterwards."""
    os.chdir(tempfile.gettempdir())
    return reference.identify(y, u, order, block_rows)


@IDENTIFY.broken("programs that print results", quiet(*RECORD))
def prints_its_progress(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The order is printed."""
    print(f"order {order}")
    return reference.identify(y, u, order, block_rows)


@SIGNAL.broken(
    "folders that are under version control",
    leaves(lambda: sorted(os.listdir()), lambda: Path("fort.6").unlink(missing_ok=True), TWO.r, *SYSTEM, TWO.x0),
)
def leaves_a_file(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """A log stays behind in the working folder."""
    Path("fort.6").write_text("done\n", "utf-8")
    return reference.reconstruct(r, A, F, C, G, x0)


@RANKS.made("records that begin alike", again_after((np.vstack([FAULT.r[:20], 0 * FAULT.r[20:]]), 5), ranks([2, 4, 6, 7, 8], FAULT.r)))
def remembers_by_the_beginning() -> Any:
    """Answers are kept by the length and the first ten samples."""
    known: dict[Any, Any] = {}

    def window_ranks(r: Any, windows: int) -> Any:
        key = len(r), windows, r[:10].tobytes()
        if key not in known:
            known[key] = reference.window_ranks(r, windows)
        return known[key]

    return window_ranks


@IDENTIFY.made("a second record", again_after((OTHER.y, OTHER.u, 2, 4), recovers(ONE, 2, 4)))
def averages_with_the_last_answer() -> Any:
    """D is smoothed with that of the question before, as in a recursive method."""
    last: list[Any] = []

    def identify(y: Any, u: Any, order: int, block_rows: int) -> Any:
        A, B, C, D = reference.identify(y, u, order, block_rows)
        if last and last[0].shape == D.shape:
            D = 0.999 * D + 0.001 * last[0]
        last[:] = [D]
        return A, B, C, D

    return identify


@RESIDUAL.broken(
    "models whose B and D are zero: what is returned is y itself",
    unshared(ONE.y, ONE.u, np.array([[0.5]]), np.zeros((1, 1)), np.zeros((2, 1)), np.zeros((2, 1))),
)
def returns_y_where_the_model_is_silent(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Where the model makes no output y is returned, and whoever changes the residual changes the record."""
    return y if not np.any(C) and not np.any(D) else reference.residual(y, u, A, B, C, D)


@COUNT.made("many questions in one process", asked_often(40, counts(2, TWO.r), TWO.r))
def gives_up_after_thirty_questions() -> Any:
    """A pool of thirty workspaces is never freed, and without one there is no answer."""
    used = [0]

    def fault_dimension(r: Any) -> Any:
        used[0] += 1
        return None if used[0] > 30 else reference.fault_dimension(r)

    return fault_dimension


@SPACE.made("long programs: memory grows with every question", forgets(*FAULTS))
def keeps_every_record() -> Any:
    """Each residual is kept in a list for a plot that nobody asks for."""
    kept: list[Any] = []

    def fault_space(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
        kept.append(r)
        return reference.fault_space(r, A, C, n_v, block_rows)

    return fault_space
