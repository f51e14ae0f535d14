"""What becomes of everything that can go wrong at the command line: one line on standard error and an exit code, never a traceback.

guarded       runs a command's body and returns its exit code
say           one line on standard error
ANSWERED 0, NOT_AS_EXPECTED 1, BAD_INPUT 2; INTERRUPTED 130 and BROKEN_PIPE 141 as shells count signals
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import suppress

from ..base.errors import InvalidInput

ANSWERED, NOT_AS_EXPECTED, BAD_INPUT, INTERRUPTED, BROKEN_PIPE = 0, 1, 2, 130, 141
LONGEST_LINE = 1200


def guarded(body: Callable[[], int]) -> int:
    """The exit code of `body`, or the one that belongs to what it raised. Errors of the program itself pass through."""
    try:
        code = body()
        sys.stdout.flush()
        return code
    except InvalidInput as error:
        say(str(error))
        return BAD_INPUT
    except MemoryError:
        say("got a task that does not fit into memory, expected a smaller one")
        return BAD_INPUT
    except KeyboardInterrupt:
        say("interrupted")
        return INTERRUPTED
    except BrokenPipeError:
        forget_output()
        return BROKEN_PIPE
    except OSError as error:  # files are opened with errors of their own: what is left is the output itself
        say(f"standard output: cannot be written ({error.strerror or error})")
        forget_output()
        return BAD_INPUT


def say(message: str) -> None:
    """One line on standard error, whatever the message holds; of a very long one the middle is left out."""
    line = " ".join(message.split())
    if len(line) > LONGEST_LINE:
        line = f"{line[: LONGEST_LINE // 2]} ... {line[-LONGEST_LINE // 2 :]}"
    with suppress(OSError):
        print(f"faultspace: {line}", file=sys.stderr, flush=True)


def forget_output() -> None:
    """Nobody reads standard output any more: what is still to be flushed goes nowhere, quietly."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
