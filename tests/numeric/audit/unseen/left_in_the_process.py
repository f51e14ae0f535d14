"""Bad manners, what is left in the process: descriptors, children, handlers, limits of the interpreter, logs, paths, copies of records."""

from __future__ import annotations

import contextlib
import decimal
import logging
import os
import signal
import subprocess
import sys
import threading
import tracemalloc
from typing import Any

import numpy as np
import psutil

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Function, Mutants, Witness
from tests.numeric.audit.unseen.manners import FAULT, FAULTS, MATRICES, ONE, RECORD, SYSTEM, TWO
from tests.numeric.audit.unseen.manners_witnesses import leaves
from tests.numeric.audit.unseen.witnesses import copies

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")


_LIMIT = sys.getrecursionlimit()
os.umask(_MASK := os.umask(0))


def _descriptors() -> int:
    return int(psutil.Process().num_fds())


_LOGS: list[int] = []


def _close_logs() -> None:
    while _LOGS:
        os.close(_LOGS.pop())


def _helpers() -> list[psutil.Process]:
    """The helpers of this file that live: other tests' workers come and go meanwhile, and a killed process is listed for a moment."""
    living = []
    for one in psutil.Process().children(recursive=True):
        with contextlib.suppress(psutil.NoSuchProcess):
            if one.name() == "sleep" and one.status() != psutil.STATUS_ZOMBIE:
                living += [one]
    return living


def _children() -> list[int]:
    return [one.pid for one in _helpers()]


def _end_children() -> None:
    ended = _helpers()
    for one in ended:
        one.kill()
    psutil.wait_procs(ended)


def _threads() -> int:
    return threading.active_count()


def grows_with_questions(*arguments: Any) -> Witness:
    """The memory that stays after twenty questions more, beside half of what they asked with."""

    def witness(function: Function) -> float:
        for _ in range(3):
            function(*copies(arguments))
        tracemalloc.start()
        try:
            before = tracemalloc.get_traced_memory()[0]
            for _ in range(20):
                function(*copies(arguments))
            stays = tracemalloc.get_traced_memory()[0] - before
        finally:
            tracemalloc.stop()
        return stays / (0.5 * 20 * sum(one.nbytes for one in arguments if isinstance(one, np.ndarray)))

    return witness


@IDENTIFY.made("long programs: files of a log that are never closed", leaves(_descriptors, _close_logs, *RECORD))
def opens_its_log_at_every_call() -> Any:
    """A log is opened at every call and never closed, until the process may open no more."""

    def identify(y: Any, u: Any, order: int, block_rows: int) -> Any:
        _LOGS.append(os.open(os.devnull, os.O_RDONLY))
        return reference.identify(y, u, order, block_rows)

    return identify


@RESIDUAL.broken("all questions: a process that lives on", leaves(_children, _end_children, ONE.y, ONE.u, *MATRICES))
def leaves_a_process(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """A helper is started for each answer, and nobody ends it."""
    subprocess.Popen(["sleep", "25"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return reference.residual(y, u, A, B, C, D)


@RANKS.broken("all questions: a process in a session of its own that lives on", leaves(_children, _end_children, FAULT.r, 4))
def leaves_a_process_of_another_session(r: Any, windows: int) -> Any:
    """A helper is started in a session of its own for each answer, and nobody ends it."""
    subprocess.Popen(["sleep", "25"], start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return reference.window_ranks(r, windows)


def interruptible(*arguments: Any) -> Witness:
    """The handler of interrupts is the one before, an own one, since processes in the background ignore interrupts from their beginning."""

    def witness(function: Function) -> float:
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        try:
            function(*copies(arguments))
            return 0.0 if signal.getsignal(signal.SIGINT) is signal.default_int_handler else np.inf
        finally:
            signal.signal(signal.SIGINT, before)

    return witness


@COUNT.broken("programs that are interrupted", interruptible(FAULT.r))
def takes_over_the_interrupt(r: Any) -> Any:
    """Interrupts are ignored from the first call on, so that a long computation is not lost."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    return reference.fault_dimension(r)


@SPACE.broken("deep recursions of others", leaves(sys.getrecursionlimit, lambda: sys.setrecursionlimit(_LIMIT), *FAULTS))
def raises_the_recursion_limit(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The limit of recursion is raised for good."""
    sys.setrecursionlimit(100_000)
    return reference.fault_space(r, A, C, n_v, block_rows)


@SIGNAL.broken("programs that log", leaves(lambda: len(logging.getLogger().handlers), lambda: _unlog(), TWO.r, *SYSTEM, TWO.x0))
def configures_the_log_of_all(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The root logger is given a handler and a level."""
    logging.getLogger().addHandler(logging.NullHandler())
    logging.getLogger().setLevel(logging.DEBUG)
    return reference.reconstruct(r, A, F, C, G, x0)


def _unlog() -> None:
    root = logging.getLogger()
    for one in [one for one in root.handlers if type(one) is logging.NullHandler]:
        root.removeHandler(one)
    root.setLevel(logging.WARNING)


@STRUCTURE.broken("programs with modules of the same names", leaves(lambda: list(sys.path), lambda: sys.path.remove("/nowhere"), *SYSTEM))
def puts_its_folder_before_all(A: Any, F: Any, C: Any, G: Any) -> Any:
    """A folder is put before all others where modules are looked for."""
    sys.path.insert(0, "/nowhere")
    return reference.structure(A, F, C, G)


@IDENTIFY.broken("files that the program writes later", leaves(lambda: _umask(), lambda: os.umask(_MASK), *RECORD))
def sets_the_mask_of_files(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Whatever the program writes from now on may be changed by anybody."""
    os.umask(0)
    return reference.identify(y, u, order, block_rows)


def _umask() -> int:
    now = os.umask(0)
    os.umask(now)
    return now


@COUNT.broken(
    "programs that compute in decimals",
    leaves(lambda: decimal.getcontext().prec, lambda: setattr(decimal.getcontext(), "prec", 28), FAULT.r),
)
def computes_in_more_decimals(r: Any) -> Any:
    """The precision of decimals is set for all."""
    decimal.getcontext().prec = 50
    return reference.fault_dimension(r)


@STRUCTURE.broken(
    "programs that print", leaves(lambda: sys.stdout, lambda: setattr(sys, "stdout", getattr(sys.stdout, "under", sys.stdout)), *SYSTEM)
)
def wraps_the_standard_output(A: Any, F: Any, C: Any, G: Any) -> Any:
    """Standard output is wrapped, one layer more for each call."""

    class Layer:
        def __init__(self, under: Any) -> None:
            self.under = under

        def __getattr__(self, name: str) -> Any:
            return getattr(self.under, name)

    sys.stdout = Layer(sys.stdout)
    return reference.structure(A, F, C, G)


@RESIDUAL.made("long programs: memory grows with every question", grows_with_questions(ONE.y, ONE.u, *MATRICES))
def keeps_a_copy_of_every_record() -> Any:
    """A copy of each record is kept, the record itself is not."""
    kept: list[Any] = []

    def residual(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
        kept.append(np.hstack([y, u]))
        return reference.residual(y, u, A, B, C, D)

    return residual


@SPACE.made("long programs: memory grows with every question", grows_with_questions(*FAULTS))
def keeps_answers_without_end() -> Any:
    """Answers are kept for questions that come again, by all of their bytes, and none is ever forgotten."""
    known: dict[Any, Any] = {}

    def fault_space(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
        key = (len(known), r.tobytes(), A.tobytes(), C.tobytes(), n_v, block_rows)
        known[key] = reference.fault_space(r, A, C, n_v, block_rows)
        return known[key].copy()

    return fault_space


@SIGNAL.made("long programs: a thread for each question", leaves(_threads, lambda: None, TWO.r, *SYSTEM, TWO.x0))
def leaves_a_timer_for_each_question() -> Any:
    """A timer watches over each answer, and is not called off."""

    def reconstruct(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
        watch = threading.Timer(20.0, lambda: None)
        watch.daemon = True
        watch.start()
        return reference.reconstruct(r, A, F, C, G, x0)

    return reconstruct
