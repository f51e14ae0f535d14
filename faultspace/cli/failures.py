"""Turn everything that can go wrong at the command line into one line on standard error and an exit code, never a traceback.

guarded       runs a command's body and returns its exit code
asks_report   reports an error that is ours, with what to send; the code OUR_ERROR
TRACEBACK     the environment variable that has the traceback of an error of ours printed, too
holding       a context that gives another one, in which such requests wait: what belongs together is done as a whole
terminable    a context in which a request to end, such as SIGTERM, comes as Terminated: what was begun is ended and put away
ANSWERED 0, NOT_AS_EXPECTED 1, BAD_INPUT 2; OUR_ERROR 70 as in sysexits.h; HUNG_UP 129, INTERRUPTED 130, BROKEN_PIPE 141, TERMINATED 143 as
shells count signals; STOPPED what is said of those that a signal stopped
"""

from __future__ import annotations

import os
import platform
import signal
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import current_thread, main_thread
from types import FrameType

from .. import __version__
from ..base.errors import InvalidInput
from ..base.messages import LONGEST_LINE, say
from ..base.others_text import lines
from .argument_names import as_options

ANSWERED, NOT_AS_EXPECTED, BAD_INPUT, OUR_ERROR = 0, 1, 2, 70
HUNG_UP, INTERRUPTED, BROKEN_PIPE, TERMINATED = 129, 130, 141, 143
STOPPED = {HUNG_UP: "hung up", INTERRUPTED: "interrupted", TERMINATED: "terminated"}
TRACEBACK = "FAULTSPACE_TRACEBACK"


class Terminated(KeyboardInterrupt):
    """A signal asks us to end; whatever puts things away at an interrupt does it now, too."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.code = 128 + number


@contextmanager
def terminable() -> Iterator[None]:
    """Raise Terminated where SIGTERM or SIGHUP comes, unless somebody else hears or ignores it; a second one is not heard while the first
    is dealt with."""
    taken: list[signal.Signals] = []

    def terminate(number: int, _: FrameType | None) -> None:
        for each in taken:
            signal.signal(each, signal.SIG_IGN)
        raise Terminated(number)

    if current_thread() is main_thread():
        ends = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
        taken = [each for each in ends if signal.getsignal(each) is signal.SIG_DFL]
        for each in taken:
            signal.signal(each, terminate)
    try:
        yield
    finally:
        for each in taken:
            signal.signal(each, signal.SIG_DFL)


class Held:
    """While this is entered, the signals that ask us to end wait."""

    def __init__(self) -> None:
        self.replaced: dict[int, Callable[[int, FrameType | None], object]] = {}
        self._inside, self._waiting = False, 0

    def hear(self, number: int, frame: FrameType | None) -> None:
        """Take a signal, now or at the end of what is held."""
        if self._inside:
            self._waiting = number
        else:
            self.replaced[number](number, frame)

    def __enter__(self) -> None:
        self._inside = True

    def __exit__(self, *_: object) -> None:
        self._inside = False
        if number := self._waiting:
            self._waiting = 0
            self.replaced[number](number, None)


@contextmanager
def holding() -> Iterator[Held]:
    """Give what holds interrupts and requests to end, where somebody has said what they do."""
    held = Held()
    if current_thread() is main_thread():
        ends = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
        for each in ends:
            handler = signal.getsignal(each)
            if callable(handler) and not isinstance(handler, signal.Handlers):
                held.replaced[each] = handler
        for each in held.replaced:
            signal.signal(each, held.hear)
    try:
        yield held
    finally:
        for each, handler in held.replaced.items():
            if signal.getsignal(each) == held.hear:
                signal.signal(each, handler)


def guarded(body: Callable[[], int]) -> int:
    """Return the exit code of `body`, or the one that belongs to what it raised."""
    try:
        code = body()
        sys.stdout.flush()
        return code
    except InvalidInput as error:
        say(as_options(str(error)))
        return BAD_INPUT
    except MemoryError:
        say("got a task that does not fit into memory, expected a smaller one")
        return BAD_INPUT
    except Terminated as error:
        return error.code
    except KeyboardInterrupt:  # the command line says so, as of an interrupt that comes before the body
        return INTERRUPTED
    except BrokenPipeError:
        forget_output()
        return BROKEN_PIPE
    except OSError as error:  # files of the user's are opened with errors of their own: what names no file is the output itself
        if error.filename is not None:
            return asks_report(error)
        say(f"standard output: cannot be written ({error.strerror or error}), expected one that takes the answer")
        forget_output()
        return BAD_INPUT
    except Exception as error:
        return asks_report(error)


def asks_report(error: Exception) -> int:
    """Say in one line what broke and where, that it is no fault of the input, and what a report needs.

    The traceback comes too where TRACEBACK is set.
    """
    if os.environ.get(TRACEBACK):
        sys.stderr.write(lines("".join(traceback.format_exception(error))))
    frames = traceback.extract_tb(error.__traceback__)
    place = f" in {frames[-1].name}, line {frames[-1].lineno} of {os.path.basename(frames[-1].filename)}" if frames else ""
    what = " ".join(f"{type(error).__name__}: {error}".split())
    what = what if len(what) <= LONGEST_LINE // 3 else what[: LONGEST_LINE // 3] + "..."
    say(
        f"got an error of faultspace itself ({what}{place}), expected an answer or a complaint about the input; please report it to "
        "whoever gave you this package, with this line, the command line, the files that it read, and the traceback, which the "
        f"environment variable {TRACEBACK}=1 has printed "
        f"(faultspace {__version__}, Python {platform.python_version()}, {platform.platform()})"
    )
    return OUR_ERROR


def forget_output() -> None:
    """Let what is still to be flushed go nowhere, quietly, because nobody reads standard output any more."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
