"""Witnesses of bad manners: one call or several, and what is left behind. What they find changed they put back.

keeps               the arguments are bit by bit what they were
read_only           a witness, asked with arguments that cannot be written into
leaves              what `read` says is the same after the call; `put_back` mends it
quiet               nothing is written to file descriptor 1
again_after         a witness, asked after another question
altered_and_asked   a count, of an array that has changed since it was asked for, or of a view
keeps_the_answer    an answer does not change when another question is asked
unshared            the answer is no view of an argument
asked_often         a witness, asked after so many equal questions
forgets             no argument is kept alive
grows_in_memory, grows_in_time   what a call takes beside the length of the record
ends                a question is refused within a second
"""

from __future__ import annotations

import contextlib
import gc
import os
import signal
import sys
import tempfile
import time
import tracemalloc
import weakref
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from faultspace.numeric.audit.adapter import guarded
from faultspace.numeric.audit.records import Broken, Refused
from tests.numeric.audit.unseen.form import Function, Witness
from tests.numeric.audit.unseen.witnesses import copies


def keeps(*arguments: Any) -> Witness:
    """Compare the bytes of the arguments before and after."""

    def witness(function: Function) -> float:
        given = copies(arguments)
        before = [one.tobytes() for one in given if isinstance(one, np.ndarray)]
        function(*given)
        return 0.0 if before == [one.tobytes() for one in given if isinstance(one, np.ndarray)] else np.inf

    return witness


def read_only(then: Witness, *arguments: Any) -> Witness:
    """Refuse writing into the arguments; the answer is judged by `then`."""

    def witness(function: Function) -> float:
        given = copies(arguments)
        for one in given:
            if isinstance(one, np.ndarray):
                one.flags.writeable = False
        try:
            guarded(function)(*given)
        except (Refused, Broken):
            return np.inf
        return then(function)

    return witness


def leaves(read: Callable[[], Any], put_back: Callable[[], Any], *arguments: Any) -> Witness:
    """Compare what `read` says before and after, in an empty folder."""

    def witness(function: Function) -> float:
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            before = read()
            function(*copies(arguments))
            after = read()
            if before == after:
                return 0.0
            put_back()
            return np.inf

    return witness


def quiet(*arguments: Any) -> Witness:
    """Catch what goes to file descriptor 1."""

    def witness(function: Function) -> float:
        sys.stdout.flush()
        with tempfile.TemporaryFile() as caught:
            kept = os.dup(1)
            os.dup2(caught.fileno(), 1)
            try:
                with contextlib.redirect_stdout(os.fdopen(os.dup(1), "w")) as out:
                    function(*copies(arguments))
                    out.close()
            finally:
                os.dup2(kept, 1)
                os.close(kept)
            return np.inf if caught.seek(0, os.SEEK_END) else 0.0

    return witness


def again_after(first: Sequence[Any], then: Witness) -> Witness:
    """Ask another question first."""

    def witness(function: Function) -> float:
        with contextlib.suppress(Refused, Broken):
            guarded(function)(*copies(first))
        return then(function)

    return witness


def unshared(*arguments: Any) -> Witness:
    """See whether the answer shares memory with an argument."""

    def witness(function: Function) -> float:
        given = copies(arguments)
        found = function(*given)
        return np.inf if any(isinstance(one, np.ndarray) and np.shares_memory(one, found) for one in given) else 0.0

    return witness


def asked_often(times: int, then: Witness, *arguments: Any) -> Witness:
    """Ask the same many times before."""

    def witness(function: Function) -> float:
        for _ in range(times):
            function(*arguments)
        return then(function)

    return witness


class _Named(np.ndarray[Any, Any]):
    """An array that weak references may follow."""


def forgets(*arguments: Any) -> Witness:
    """Follow the first argument by a weak reference."""

    def witness(function: Function) -> float:
        given = copies(arguments)
        given[0] = given[0].view(_Named)
        ghost = weakref.ref(given[0])
        function(*given)
        del given
        gc.collect()
        return 0.0 if ghost() is None else np.inf

    return witness


def _seconds(function: Function, arguments: Sequence[Any]) -> float:
    begin = time.process_time()
    function(*arguments)
    return time.process_time() - begin


def _most_memory(function: Function, arguments: Sequence[Any]) -> float:
    tracemalloc.start()
    try:
        function(*arguments)
        return float(tracemalloc.get_traced_memory()[1])
    finally:
        tracemalloc.stop()


def _exponent(short: Sequence[Any], long: Sequence[Any], spent_short: float, spent_long: float) -> float:
    """The exponent of what is spent between records of unlike lengths, beside midway between linear and quadratic."""
    return float(np.log(spent_long / max(spent_short, 1e-9)) / np.log(len(long[0]) / len(short[0])) / 1.5)


def grows_in_memory(short: Sequence[Any], long: Sequence[Any]) -> Witness:
    """The exponent of memory between records of unlike lengths, beside midway between linear and quadratic."""

    def witness(function: Function) -> float:
        function(*short)  # What a first call imports or remembers for good is nobody's growth.
        return _exponent(short, long, _most_memory(function, short), _most_memory(function, long))

    return witness


def grows_in_time(short: Sequence[Any], long: Sequence[Any]) -> Witness:
    """The exponent of time between records of unlike lengths, beside midway between linear and quadratic.

    The short record is asked twice before the long one and twice after it, and its least time counts: what else a machine
    does makes it look slow at times, which would hide a growth.
    """

    def witness(function: Function) -> float:
        function(*short)
        before = [_seconds(function, short) for _ in range(2)]
        spent = _seconds(function, long)
        return _exponent(short, long, min(*before, *(_seconds(function, short) for _ in range(2))), spent)

    return witness


def ends(*arguments: Any) -> Witness:
    """A question without an answer is refused before a second has gone.

    The alarm may come while numpy enters `errstate`, which then never leaves it: singular values would be said not to converge in whatever
    the process computes later. What held before is therefore put back.
    """

    def alarmed(*_: Any) -> None:
        raise TimeoutError("a second has gone")

    def witness(function: Function) -> float:
        before = signal.signal(signal.SIGALRM, alarmed)
        signal.setitimer(signal.ITIMER_REAL, 1.0)
        try:
            with np.errstate():
                guarded(function)(*copies(arguments))
        except Refused:
            return 0.0
        except Broken:
            return np.inf
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)
        return np.inf

    return witness
