"""This says who is put through the checks: an object in this process, an adapter by its name, a program, a published package.

InProcess    an object whose functions run in this process, without limits: it could look at the answers
opened       the subject that the arguments of `audit` name, closed at the end
label        how `faultspace audit` is told of it
REFERENCE    our own numeric branch, by its name
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

from ....base.errors import InvalidData
from ....base.processes import Limits
from ..adapter import fitting, guarded, not_promised
from ..peers import VARIABLES
from ..peers import peer as peer_named
from ..records import Check, Function
from .isolation import Auditee, Isolated
from .subprocess_adapter import Exec

REFERENCE = "faultspace.numeric.audit.reference"
Command = str | Sequence[str]


class InProcess(Auditee):
    """This is an object with one or more of the functions. Raises InvalidData where it has none."""

    def __init__(self, implementation: object) -> None:
        self._called = {name: guarded(one) for name, one in fitting(implementation).items()}
        self.functions = tuple(self._called)
        self._apart = not_promised(implementation)

    def _function(self, check: Check) -> Function:
        return self._called[check.function]


@contextmanager
def opened(adapter: object, command: Command | None, peer: str | None, limits: Limits) -> Iterator[Auditee]:
    """At most one of the three is given; without any it is our own reference. Raises InvalidData for more, and where nothing answers."""
    if sum(one is not None for one in (adapter, command, peer)) > 1:
        raise InvalidData("got more than one of an adapter, command= and peer=, expected one of them")
    if adapter == "":
        raise InvalidData("got an empty name, expected an adapter (none at all: our own reference)")
    if peer is not None:
        found = peer_named(peer)
        if found.version() is None:
            raise InvalidData(f"{found.name} is not installed here; needed is: {found.needs}")
        adapter, command = found.adapter, found.command
        limits = replace(limits, passed=(*limits.passed, *VARIABLES))  # where a clone or a package is, no program can know else
    if command is not None:
        with Exec(command, limits) as program:
            if peer is not None:
                program.NOT_PROMISED = peer_named(peer).not_promised()
            yield InProcess(program)
    elif adapter is None or isinstance(adapter, str):
        with Isolated(adapter or REFERENCE, limits) as worker:
            yield worker
    else:
        yield InProcess(adapter)


def label(adapter: object, command: Command | None, peer: str | None) -> str:
    """Return the words after `faultspace audit` that name the same subject; of an object that no name leads to, ADAPTER."""
    if peer is not None:
        return f"--peer {peer}"
    if command is not None:
        return f"--exec {shlex.quote(command if isinstance(command, str) else shlex.join(command))}"
    if adapter is None or isinstance(adapter, str):
        return shlex.quote(adapter or REFERENCE)
    return shlex.quote(getattr(adapter, "__name__", "ADAPTER"))
