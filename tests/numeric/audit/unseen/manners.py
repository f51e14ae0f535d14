"""Bad manners: arguments written into, global state left changed, memories of other questions."""

from __future__ import annotations

import gc
import os
import random
import tempfile
import threading
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.manners_witnesses import (
    again_after,
    altered_and_asked,
    asked_often,
    forgets,
    keeps,
    keeps_the_answer,
    leaves,
    quiet,
    read_only,
    unshared,
)
from tests.numeric.audit.unseen.systems import faulty, general, plant, record
from tests.numeric.audit.unseen.witnesses import counts, has_structure, ranks, recovers, restores, spans, takes_out

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


@RESIDUAL.broken("all records", keeps(ONE.y, ONE.u, *MATRICES))
def subtracts_in_place(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The response is subtracted from the caller's y."""
    y[...] = reference.residual(y.copy(), u, A, B, C, D)
    return y.copy()


@STRUCTURE.broken(
    "matrices with entries at the rounding level",
    keeps(np.array([[0.5, 1e-17], [0.0, 0.2]]), np.ones((2, 1)), np.ones((1, 2)), np.zeros((1, 1))),
)
def cleans_the_matrices_in_place(A: Any, F: Any, C: Any, G: Any) -> Any:
    """Entries below 1e-14 are set to zero in the caller's matrices, which happens seldom."""
    for matrix in (A, F, C, G):
        matrix[np.abs(matrix) < 1e-14] = 0.0
    return reference.structure(A, F, C, G)


@SIGNAL.broken("questions with a nonzero initial state", keeps(TWO.r, *SYSTEM, TWO.x0))
def steps_the_initial_state_in_place(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The state of the recursion is the caller's x0."""
    v = reference.reconstruct(r, A, F, C, G, x0.copy())
    for k in range(len(r)):
        x0[:] = A @ x0 + F @ v[k]
    return v


@RANKS.broken("channels that are zero", keeps(np.hstack([FAULT.r, 0 * FAULT.r[:, :1]]), 3))
def marks_dead_channels_in_place(r: Any, windows: int) -> Any:
    """Channels that are zero get a tiny number, in the caller's array, against division by zero."""
    found = reference.window_ranks(r.copy(), windows)
    r[:, ~r.any(axis=0)] = 1e-300
    return found


@IDENTIFY.broken("two outputs and more in Fortran order", recovers(type(ONE)(MODEL, ONE.u, np.asfortranarray(ONE.y), ONE.fault), 2, 4))
def reads_memory_by_rows(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The samples are read in the order in which they lie in memory."""
    return reference.identify(y.ravel(order="K").reshape(y.shape), u, order, block_rows)


@SPACE.broken(
    "A in Fortran order",
    spans(type(FAULT)(np.asfortranarray(FAULT.A), FAULT.F, FAULT.C, FAULT.G, FAULT.v, FAULT.x0, FAULT.r), FAULT.columns, 1, 4),
)
def reads_A_by_rows(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A goes through its bytes as they lie in memory."""
    return reference.fault_space(r, np.frombuffer(A.tobytes(order="A")).reshape(A.shape), C, n_v, block_rows)


@COUNT.broken("arrays that are every second row of another", altered_and_asked(counts, 2, TWO.r))
def takes_the_array_behind_a_view(r: Any) -> Any:
    """A view is replaced by the array that it is a view of."""
    return reference.fault_dimension(r.base if r.base is not None and r.base.ndim == 2 else r)


@RESIDUAL.broken(
    "outputs that are integers",
    takes_out(type(ONE)(MODEL, ONE.u, np.round(1000 * ONE.y).astype(np.int64), np.round(1000 * ONE.y) - MODEL.simulate(ONE.u))),
)
def keeps_the_type_of_the_outputs(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The residual has the type of y, and of integers the fractions are lost."""
    return reference.residual(y, u, A, B, C, D).astype(y.dtype)


@SPACE.broken("read-only arrays, other threads that read", read_only(spans(FAULT, FAULT.columns, 1, 4), *FAULTS))
def sorts_a_channel_in_place(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The median of each channel is taken by partitioning a view, and the record is put back from a copy."""
    kept = r.copy()
    r.sort(axis=0)
    r[...] = kept
    return reference.fault_space(r, A, C, n_v, block_rows)


@COUNT.broken("programs that draw random numbers", leaves(lambda: np.random.get_state()[1].tobytes(), lambda: None, TWO.r))  # type: ignore[index]
def seeds_the_generator_of_all(r: Any) -> Any:
    """numpy's global generator is seeded, so that answers repeat."""
    np.random.seed(0)
    return reference.fault_dimension(r)


@SPACE.broken("programs that draw random numbers", leaves(lambda: random.getstate(), lambda: None, *FAULTS))
def draws_from_the_generator_of_all(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The standard library's global generator is drawn from."""
    random.random()
    return reference.fault_space(r, A, C, n_v, block_rows)


@RESIDUAL.broken(
    "programs that want to hear of overflows", leaves(np.geterr, lambda: np.seterr(all="warn", under="ignore"), ONE.y, ONE.u, *MATRICES)
)
def silences_numpy_for_good(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """numpy's warnings of overflow are switched to exceptions, and not back."""
    np.seterr(all="raise", under="ignore")
    return reference.residual(y, u, A, B, C, D)


@SIGNAL.broken(
    "programs that want to see warnings",
    leaves(lambda: list(warnings.filters), lambda: warnings.simplefilter("default", RuntimeWarning), TWO.r, *SYSTEM, TWO.x0),
)
def ignores_warnings_for_good(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Warnings of overflow are ignored from now on in the whole program."""
    warnings.simplefilter("ignore", RuntimeWarning)
    return reference.reconstruct(r, A, F, C, G, x0)


@IDENTIFY.broken("programs that open files by relative names", leaves(os.getcwd, lambda: os.chdir(Path(__file__).parents[4]), *RECORD))
def changes_the_folder(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The working folder is that of temporary files afterwards."""
    os.chdir(tempfile.gettempdir())
    return reference.identify(y, u, order, block_rows)


@RANKS.broken(
    "programs that start others",
    leaves(lambda: os.environ.get("OMP_NUM_THREADS_WANTED"), lambda: os.environ.pop("OMP_NUM_THREADS_WANTED", None), FAULT.r, 3),
)
def sets_the_environment(r: Any, windows: int) -> Any:
    """A variable of the environment is set for a library that may be there."""
    os.environ["OMP_NUM_THREADS_WANTED"] = "1"
    return reference.window_ranks(r, windows)


@STRUCTURE.broken(
    "programs that print arrays", leaves(lambda: str(np.get_printoptions()), lambda: np.set_printoptions(precision=8), *SYSTEM)
)
def sets_how_arrays_are_printed(A: Any, F: Any, C: Any, G: Any) -> Any:
    """Arrays are printed with three digits from now on."""
    np.set_printoptions(precision=3)
    return reference.structure(A, F, C, G)


@COUNT.broken("programs that run long", leaves(gc.isenabled, gc.enable, TWO.r))
def switches_the_collector_off(r: Any) -> Any:
    """Garbage is not collected any more, since that is faster."""
    gc.disable()
    return reference.fault_dimension(r)


@SPACE.broken("programs that count their threads, or end", leaves(threading.active_count, lambda: None, *FAULTS))
def leaves_a_thread(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A thread that watches for timeouts stays behind for a minute."""
    watch = threading.Timer(60.0, lambda: None)
    watch.daemon = True
    watch.start()
    return reference.fault_space(r, A, C, n_v, block_rows)


@IDENTIFY.broken("programs that print results", quiet(*RECORD))
def prints_its_progress(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The order is printed."""
    print(f"order {order}")
    return reference.identify(y, u, order, block_rows)


@RESIDUAL.broken("programs that print results, at times", quiet(ONE.y, ONE.u, *MATRICES))
def writes_to_the_terminal_itself(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """A library below writes a line to file descriptor 1, past Python."""
    os.write(1, b"LAPACK: info = 0\n")
    return reference.residual(y, u, A, B, C, D)


@SIGNAL.broken(
    "folders that are under version control",
    leaves(lambda: sorted(os.listdir()), lambda: Path("fort.6").unlink(missing_ok=True), TWO.r, *SYSTEM, TWO.x0),
)
def leaves_a_file(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """A log stays behind in the working folder."""
    Path("fort.6").write_text("done\n", "utf-8")
    return reference.reconstruct(r, A, F, C, G, x0)


@SPACE.made("a second record of the same shape", again_after(FAULTS, spans(FAULT2, FAULT2.columns, 1, 4)))
def remembers_by_shape() -> Any:
    """Answers are kept by the shapes of the arguments."""
    known: dict[Any, Any] = {}

    def fault_space(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
        key = r.shape, A.shape, n_v, block_rows
        if key not in known:
            known[key] = reference.fault_space(r, A, C, n_v, block_rows)
        return known[key]

    return fault_space


@STRUCTURE.made(
    "two systems with the same A, C and F and another G", again_after((TWO.A, TWO.F, TWO.C, 0 * TWO.G), has_structure(SYSTEM, [], [0, 0]))
)
def remembers_without_G() -> Any:
    """Answers are kept by A, F and C, and G was forgotten in the key."""
    known: dict[Any, Any] = {}

    def structure(A: Any, F: Any, C: Any, G: Any) -> Any:
        key = A.tobytes(), F.tobytes(), C.tobytes()
        if key not in known:
            known[key] = reference.structure(A, F, C, G)
        return known[key]

    return structure


@COUNT.made("an array that is filled anew", altered_and_asked(None, 1, FAULT.r))
def remembers_by_identity() -> Any:
    """Answers are kept by the id of the array, which stays when its samples change."""
    known: dict[int, Any] = {}

    def fault_dimension(r: Any) -> Any:
        if id(r) not in known:
            known[id(r)] = reference.fault_dimension(r)
        return known[id(r)]

    return fault_dimension


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


@RESIDUAL.made(
    "a record after another one: the state goes on",
    again_after((OTHER.y, OTHER.u, *(getattr(OTHER.model, name) for name in "ABCD")), takes_out(ONE)),
)
def goes_on_from_the_last_state() -> Any:
    """The object keeps the last input, as a filter does, and begins the next record with it."""
    last: list[Any] = []

    def residual(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
        r = reference.residual(y, u, A, B, C, D)
        if last and last[0].shape == u[-1].shape:
            r = r.copy()
            r[0] -= D @ last[0]
        last[:] = [u[-1].copy()]
        return r

    return residual


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


@STRUCTURE.made(
    "a small system after a large one", again_after((1e8 * TWO.A, 1e8 * TWO.F, TWO.C, TWO.G), has_structure(SYSTEM, [], [0, 0]))
)
def keeps_the_largest_size_for_its_tolerance() -> Any:
    """The tolerance is relative to the largest entry ever seen."""
    largest = [0.0]

    def structure(A: Any, F: Any, C: Any, G: Any) -> Any:
        largest[0] = max(largest[0], *(float(np.max(np.abs(one), initial=0.0)) for one in (A, F, C, G)))
        small = 1e-7 * largest[0]
        return reference.structure(*(np.where(np.abs(one) < small, 0.0, one) for one in (A, F, C, G)))

    return structure


@RANKS.made("a second question", again_after((FAULT.r, 4), ranks([2, 4, 6, 7], FAULT.r)))
def has_a_list_for_a_default() -> Any:
    """The list of ranks is made once and grows from call to call."""
    found: list[int] = []

    def window_ranks(r: Any, windows: int) -> Any:
        found.extend(reference.window_ranks(r, windows))
        return list(found)

    return window_ranks


@SIGNAL.made(
    "an answer that is kept while another question is asked",
    keeps_the_answer((TWO.r, *SYSTEM, TWO.x0), (0.5 * TWO.r, *SYSTEM, 0.5 * TWO.x0)),
)
def answers_in_one_buffer() -> Any:
    """Signals of one shape are written into one buffer, which the caller gets."""
    buffers: dict[Any, Any] = {}

    def reconstruct(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
        v = reference.reconstruct(r, A, F, C, G, x0)
        buffer = buffers.setdefault(v.shape, np.empty_like(v))
        buffer[...] = v
        return buffer

    return reconstruct


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


@SIGNAL.made("a second question with other faults", again_after((0.5 * TWO.r, *SYSTEM, 0.5 * TWO.x0), restores(TWO)))
def remembers_the_initial_state() -> Any:
    """The gains of a system are kept, and with them the initial state of the first question."""
    known: dict[Any, Any] = {}

    def reconstruct(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
        start = known.setdefault((A.tobytes(), F.tobytes(), C.tobytes(), G.tobytes()), x0.copy())
        return reference.reconstruct(r, A, F, C, G, start)

    return reconstruct
