"""The checks put to an implementation, and the two faces of that: an Audit, and pytest cases.

audit                     what all checks say of an implementation, given as an object, by name, as a program or as a published package
parametrize_with_checks   decorates a test that takes `check`: `check()` raises AssertionError with slug, effect, got, bound, ratio
ExpectedFailure           a failure with its reason; turns red when the check passes
"""

from __future__ import annotations

import atexit
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

from ...base.errors import InvalidData, shorten
from ...base.processes import Limits
from ...base.progress import Progress, silent
from .checks.catalogue import chosen
from .outcome import Audit
from .records import Check, CheckResult, Status, message
from .subjects.isolation import Isolated
from .subjects.opening import Auditee, Command, InProcess, label, opened

Test = TypeVar("Test", bound=Callable[..., object])
SECONDS, GIBIBYTES = 60.0, 4.0  # that a check may take, where no others are stated: what a small machine has


@dataclass(frozen=True)
class ExpectedFailure:
    """This is an expected failure of the check `name`: a slug (then all of its vectors), slug[vector], or slug[vector]-function where
    several functions have it.

    `reason` says why it fails and who knows of it. To hang or to crash is never expected.
    """

    name: str
    reason: str

    def __post_init__(self) -> None:
        if not self.reason.strip():
            raise InvalidData(f"the expected failure of {self.name} needs a reason")


def audit(
    adapter: object = None,
    *,
    command: Command | None = None,
    peer: str | None = None,
    only: Sequence[str] | str = (),
    expected: Sequence[ExpectedFailure] = (),
    seconds: float = SECONDS,
    gibibytes: float = GIBIBYTES,
    on_progress: Progress | None = None,
) -> Audit:
    """Audit an implementation of subspace identification and fault estimation, of anyone's, by checks with exactly known answers.

    `adapter` has one or more of the functions that `faultspace.numeric.audit.adapter` describes (`identify`, `residual`, `fault_dimension`,
    `fault_space`, ...; arrays are time-major, y is N x p and u is N x n_u). It is any object, a module say, or a name, `package.module`,
    `module:object`, `file.py` or `file.py:object`. In its place `command` names a program that speaks JSON lines, and `peer` a published
    package that an adapter comes for; without any of the three our own numeric branch is audited. `only` names the checks to run, by slug
    or slug[vector], one or a list; `expected` lists failures that are known; `on_progress(name, done, total)` hears of the progress.

    What has a name runs in a process of its own, where a check (of a program: an answer) may take `seconds` and hold `gibibytes`; an
    object runs in this process, and nothing limits it. What the functions do, this never raises. The Audit is a sequence of results, one
    a check: `verdict`, and what was `got` beside the `bound`; it has `failed`, `summary()` and `to_json()`. Source: the checks take their
    truth from [G25] and the claims of this library.

    Raises InvalidData for an implementation that cannot be reached or has none of the functions, for names of checks that do not exist, and
    for `seconds` or `gibibytes` that are not positive.

    >>> import faultspace as fs
    >>> from faultspace.numeric.audit import reference
    >>> found = fs.audit(reference, only=["fault-dimension[one-fault]", "window-ranks[one-fault]"])
    >>> found
    <Audit: 2 checks of window_ranks, fault_dimension: 0 failed>
    >>> [(one.name, one.verdict, one.got, one.bound) for one in found if one.function == "fault_dimension"]
    [('fault-dimension[one-fault]', 'pass', 0.0, 0.0)]
    """
    for name, value in (("seconds", seconds), ("gibibytes", gibibytes)):
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 < value < float("inf"):
            raise InvalidData(f"{name}: got {shorten(value)}, expected a positive number")
    only = [only] if isinstance(only, str) else only
    if not isinstance(only, Collection):
        raise InvalidData(f"only: got {shorten(only)}, expected a list of names of checks")
    with opened(adapter, command, peer, Limits(seconds, int(gibibytes * 2**30))) as subject:
        todo = _todo(subject, only, expected)
        heard, results = on_progress or silent, []
        for done, check in enumerate(todo):
            heard(check.name, done, len(todo))
            results.append(_expecting(subject.perform(check), expected))
    return Audit(label(adapter, command, peer), tuple(results))


def parametrize_with_checks(
    adapter: object, *, expected: Sequence[ExpectedFailure] = (), seconds: float = SECONDS, gibibytes: float = GIBIBYTES
) -> Callable[[Test], Test]:
    """Return a pytest decorator: the test gets `check`, a function to call, once for each check; ids are slug[vector]-function.

    An adapter given by name (a string) runs in a process of its own under the limits, an object in this one without.
    """
    import pytest

    subject: Auditee
    if isinstance(adapter, str):
        subject = worker = Isolated(adapter, Limits(seconds, int(gibibytes * 2**30)))
        atexit.register(worker.close)
    else:
        subject = InProcess(adapter)
    name = label(adapter, None, None)
    cases = [pytest.param(partial(_asserted, one, subject, expected, name), id=one.full_name) for one in _todo(subject, (), expected)]
    return pytest.mark.parametrize("check", cases)


def _todo(subject: Auditee, only: Sequence[str], expected: Sequence[ExpectedFailure]) -> list[Check]:
    """Return the checks to run; that there are checks of the expected names is seen first."""
    if expected:
        chosen((), [one.name for one in expected])
    return chosen(subject.functions, only)


def _expecting(result: CheckResult, expected: Sequence[ExpectedFailure]) -> CheckResult:
    """An expected failure passes and says why; a pass where a failure is expected fails."""
    known = next((one for one in expected if one.name in result.names), None)
    if known is None or result.verdict == Status.BROKEN:
        return result
    if result.verdict == Status.PASS:
        return replace(result, verdict=str(Status.FAIL), detail=f"passes, but a failure is expected ({known.reason}): take the mark away")
    return replace(result, verdict=str(Status.PASS), detail=f"fails as expected: {known.reason}")


def _asserted(check: Check, subject: Auditee, expected: Sequence[ExpectedFailure], adapter: str) -> CheckResult:
    result = _expecting(subject.perform(check), expected)
    if result.failed:
        raise AssertionError(message(result, adapter))
    return result
