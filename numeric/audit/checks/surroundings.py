"""What a function leaves behind beside its answer: state of the process, output, files, answers to other questions.

checks      for every function, on the vectors of `manners`
state       name -> what a call must leave as it was
hooks       where the interpreter lets others be called

Each function is called once before anything is looked at: what the first call loads and caches is its own affair.
"""

from __future__ import annotations

import builtins
import decimal
import gc
import io
import locale
import logging
import math
import multiprocessing
import os
import random
import signal
import sys
import tempfile
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import scipy.linalg

from ..records import Check, Function, Measurement, Severity, inside
from .manners import answered, copies, equal, questions

try:
    import resource
except ImportError:  # no such limits on this platform
    resource = None  # type: ignore[assignment]

Arguments = tuple[Any, ...]
LIBRARIES = (np, np.linalg, np.random, scipy.linalg, random, builtins, math, os, time)
FUNCTIONS_OF_OTHERS = {
    f"{library.__name__}.{name}": library
    for library in LIBRARIES
    for name, one in vars(library).items()
    if callable(one) and name[0] != "_"
}
"""Functions that a program may replace for everybody, by full name, with the module that has them."""
TIMERS = tuple(getattr(signal, name) for name in ("ITIMER_REAL", "ITIMER_VIRTUAL", "ITIMER_PROF") if hasattr(signal, name))


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for function, vector, arguments in questions():
        for slug, effect, measure in (
            ("leaves-the-state", "what others compute next changes: random numbers, warnings, threads", _leaves_the_state),
            ("prints-nothing", "noise on the standard output, where programs read", _prints_nothing),
            ("leaves-no-files", "files are left in folders of others", _leaves_no_files),
            ("order-of-calls", "the answer depends on what was asked before", _order_of_calls),
            ("same-array-new-data", "an old answer is given for new data in the same array", _same_array),
        ):
            yield Check(slug, function, vector, None, effect, Severity.SOMETIMES, partial(inside, measure, arguments))


def state() -> dict[str, Any]:
    """Return what a call must leave as it was. Threads of the interpreter are counted, and those that the linear algebra may use."""
    from threadpoolctl import threadpool_info

    numbers: Any = np.random.get_state(legacy=False)
    return {
        "numpy's random numbers": (numbers["state"]["key"].tobytes(), numbers["state"]["pos"], numbers["has_gauss"]),
        "Python's random numbers": random.getstate(),
        "numpy's handling of errors": np.geterr(),
        "numpy's print options": {name: str(value) for name, value in np.get_printoptions().items()},
        "filters of warnings": list(warnings.filters),
        "the folder": os.getcwd(),
        "environment variables": dict(os.environ),
        "the locale": locale.setlocale(locale.LC_ALL),
        "sys.path": list(sys.path),
        "the limit of recursion": sys.getrecursionlimit(),
        "collection of garbage": gc.isenabled(),
        "standard streams": (sys.stdout, sys.stderr, sys.stdin),
        "signals": {one: signal.getsignal(one) for one in signal.valid_signals()},
        "timers": [signal.getitimer(one)[0] > 0 for one in TIMERS],
        "hooks": hooks(),
        "the context of decimals": str(decimal.getcontext()),
        "the log of all": (tuple(logging.root.handlers), logging.root.level, logging.root.manager.disable),
        "the mask of new files": _mask(),
        "limits of the process": _limits(),
        "functions of libraries": _functions(),
        "numpy's buffer": np.getbufsize(),
        "how processes are started": multiprocessing.get_start_method(allow_none=True),
        "open files": psutil.Process().num_fds() if hasattr(psutil.Process, "num_fds") else 0,
        "threads of Python": threading.active_count(),
        "threads of the linear algebra": [(one["filepath"], one["num_threads"]) for one in threadpool_info()],
        "child processes": {one.pid for one in psutil.Process().children(recursive=True) if one.status() != psutil.STATUS_ZOMBIE},
    }


def hooks() -> tuple[Any, ...]:
    """Return what the interpreter calls for others: for errors, warnings, output, imports, traces."""
    of_sys = (sys.excepthook, sys.unraisablehook, sys.displayhook, sys.breakpointhook, sys.gettrace(), sys.getprofile())
    return (*of_sys, threading.excepthook, warnings.showwarning, tuple(sys.meta_path), tuple(sys.path_hooks), tuple(gc.callbacks))


def _functions() -> dict[str, Any]:
    return {name: vars(owner).get(name.rpartition(".")[2]) for name, owner in FUNCTIONS_OF_OTHERS.items()}


def _processors() -> Any:
    return os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else None


def _mask() -> int:
    mask = os.umask(0o077)
    os.umask(mask)
    return mask


def _limits() -> tuple[Any, ...]:
    """Return the limits of resources, the priority, and the processors allowed, of which some platforms have none."""
    if resource is None:
        return ()
    limits = tuple(resource.getrlimit(getattr(resource, name)) for name in dir(resource) if name.startswith("RLIMIT_"))
    return limits, os.nice(0), _processors()


def _leaves_the_state(arguments: Arguments, function: Function) -> Iterator[Measurement]:
    with _as_it_was():  # what is changed once and for all must be seen in the call after this
        function(*copies(arguments))
    with _as_it_was():
        np.random.seed(20250601)
        random.seed(20250601)
        if threading.current_thread() is threading.main_thread():  # to ignore what is ignored already would be seen nowhere
            signal.signal(signal.SIGINT, signal.default_int_handler)
        before = state()
        function(*copies(arguments))
        after = state()
        for name, value in before.items():
            yield Measurement(name, float(after[name] != value), 0.0)


@contextmanager
def _as_it_was() -> Iterator[None]:
    """Give back, as far as that is possible, what a function may have changed."""
    numbers, python, folder, environment = np.random.get_state(), random.getstate(), os.getcwd(), dict(os.environ)
    streams, path, printed = (sys.stdout, sys.stderr, sys.stdin), list(sys.path), np.get_printoptions()
    limit, collects, mask = sys.getrecursionlimit(), gc.isenabled(), _mask()
    handlers, level, speech = list(logging.root.handlers), logging.root.level, locale.setlocale(locale.LC_ALL)
    called = {name: getattr(sys, name) for name in ("excepthook", "unraisablehook", "displayhook", "breakpointhook")}
    processors, functions, starting = _processors(), _functions(), multiprocessing.get_start_method(allow_none=True)
    signals = {one: signal.getsignal(one) for one in signal.valid_signals()}
    with warnings.catch_warnings(), np.errstate(), decimal.localcontext():
        try:
            yield
        finally:
            np.random.set_state(numbers)
            random.setstate(python)
            os.chdir(folder)
            for name in set(os.environ) - set(environment):
                del os.environ[name]
            os.environ.update(environment)
            sys.stdout, sys.stderr, sys.stdin = streams
            sys.path[:] = path
            np.set_printoptions(**printed)
            sys.setrecursionlimit(limit)
            (gc.enable if collects else gc.disable)()
            os.umask(mask)
            locale.setlocale(locale.LC_ALL, speech)
            for name, hook in called.items():
                setattr(sys, name, hook)
            for name, one in functions.items():
                if vars(FUNCTIONS_OF_OTHERS[name]).get(name.rpartition(".")[2]) is not one:
                    setattr(FUNCTIONS_OF_OTHERS[name], name.rpartition(".")[2], one)
            if processors is not None and _processors() != processors:
                os.sched_setaffinity(0, processors)
            if multiprocessing.get_start_method(allow_none=True) != starting:
                multiprocessing.set_start_method(starting, force=True)
            logging.root.handlers[:] = handlers
            logging.root.setLevel(level)
            if threading.current_thread() is threading.main_thread():
                for one, handler in signals.items():
                    if handler is not None and signal.getsignal(one) != handler:
                        signal.signal(one, handler)


def _prints_nothing(arguments: Arguments, function: Function) -> Iterator[Measurement]:
    """What goes to the descriptor is seen as well as what goes to `sys.stdout`."""
    function(*copies(arguments))
    with _descriptor() as written, redirect_stdout(io.StringIO()) as printed:
        function(*copies(arguments))
    yield Measurement("characters on standard output", float(len(printed.getvalue()) + written()), 0.0)


@contextmanager
def _descriptor() -> Iterator[Callable[[], int]]:
    """Turn the descriptor of standard output to a file, and tell how many bytes came there."""
    sys.stdout.flush()
    kept = os.dup(1)
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        try:
            yield lambda: size
        finally:
            os.dup2(kept, 1)
            os.close(kept)
            size = os.fstat(file.fileno()).st_size


def _leaves_no_files(arguments: Arguments, function: Function) -> Iterator[Measurement]:
    """Look into the present folder and into that for temporary files, both empty before the first call."""
    with tempfile.TemporaryDirectory() as here, tempfile.TemporaryDirectory() as temporary, _as_it_was():
        usual = tempfile.tempdir
        os.chdir(here)
        tempfile.tempdir = os.environ["TMPDIR"] = temporary
        try:
            function(*copies(arguments))
        finally:
            tempfile.tempdir = usual
            os.chdir(os.path.sep)
        left = [path.name for folder in (here, temporary) for path in Path(folder).iterdir()]
    yield Measurement("files left", float(len(left)), 0.0)


def _other(arguments: Arguments) -> Arguments:
    """Return other arguments of the same shapes: the first array, which is the record or the model, backwards."""
    first, *rest = copies(arguments)
    return (np.ascontiguousarray(first[::-1]), *rest)


def _order_of_calls(arguments: Arguments, function: Function) -> Iterator[Measurement]:
    first = function(*copies(arguments))
    answered(function, _other(arguments))
    again = function(*copies(arguments))
    yield Measurement("answers differ after another question", float(not equal(first, again)), 0.0)


def _same_array(arguments: Arguments, function: Function) -> Iterator[Measurement]:
    """Ask twice with the same array, of which the contents were changed between, and once with a new one."""
    given, other = copies(arguments), _other(arguments)
    function(*given)
    given[0][...] = other[0]
    got, due = answered(function, given), answered(function, copies(other))
    yield Measurement("answers differ for an array used again", float(not equal(got, due)), 0.0)
