"""This lets something that waits for another program go on in a thread of its own, beside what this process does."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import Any, TypeVar

Result = TypeVar("Result")


def aside(function: Callable[..., Result], *args: Any) -> Future[Result]:
    """Return the future of function(*args), which has begun; `result()` waits for it, and raises what the function raised.

    The thread does not keep the process alive: where nobody asks any more, since something else failed, nobody waits either.
    """
    future = Future[Result]()

    def run() -> None:
        try:
            future.set_result(function(*args))
        except BaseException as error:  # whatever it is, it is for whoever asks
            future.set_exception(error)

    Thread(target=run, daemon=True).start()
    return future
