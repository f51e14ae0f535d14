"""The checks put to an implementation, and the two faces of that: an Audit, and pytest cases.

audit                     what all checks say of an implementation, given as an object, by name, as a program or as a published package
parametrize_with_checks   decorates a test that takes `check`: `check()` raises AssertionError with slug, effect, got, bound, ratio
ExpectedFailure           a failure with its reason; turns red when the check passes (from `expectations`)
"""

from __future__ import annotations

import atexit
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeVar

from ...base.errors import InvalidData, shorten
from ...base.processes import Limits
from ...base.progress import Progress, silent
from .checks.catalogue import chosen
from .expectations import ExpectedFailure, as_expected
from .outcome import Audit
from .records import Broken, Check, CheckResult, Status, message, named
from .reports.causes import causes, folded, lines_of, told
from .subjects.isolation import Auditee, Isolated
from .subjects.opening import Command, InProcess, label, opened
from .vectors.trouble import SEED

__all__ = ["GIBIBYTES", "SECONDS", "ExpectedFailure", "audit", "parametrize_with_checks"]
Test = TypeVar("Test", bound=Callable[..., object])
SECONDS, GIBIBYTES = 60.0, 4.0  # that a check may take, where no others are stated: what a small machine has


def audit(
    adapter: object = None,
    *,
    command: Command | None = None,
    peer: str | None = None,
    only: Sequence[str] | str = (),
    seed: int = SEED,
    quick: bool = False,
    expected: Sequence[ExpectedFailure] = (),
    seconds: float = SECONDS,
    gibibytes: float = GIBIBYTES,
    environment: Sequence[str] = (),
    on_progress: Progress | None = None,
) -> Audit:
    """Audit an implementation of subspace identification and fault estimation, of anyone's, by checks with exactly known answers.

    `adapter` has one or more of the functions that `faultspace.numeric.audit.adapter` describes (`identify`, `residual`, `fault_dimension`,
    `fault_space`, ...; arrays are time-major, y is N x p and u is N x n_u). It is any object, a module say, or a name, `package.module`,
    `module:object`, `file.py` or `file.py:object`. In its place `command` names a program that speaks JSON lines, and `peer` a published
    package that an adapter comes for; without any of the three our own numeric branch is audited. `only` names the checks to run, by slug
    or slug[vector], in which * and ? stand for anything, one or a list; `seed`, a natural number, is that of the vectors of each kind of
    trouble (0: those that come with the package), and `quick` takes a part, of every check the first vector and of every kind of trouble
    all; `expected` lists failures that are known; `on_progress(name, done, total)` hears of the progress.

    What has a name runs in a process of its own, where a check (of a program: an answer) may take `seconds` and hold `gibibytes`, and which
    sees of the environment what any program needs (PATH, HOME, the language) and the variables named in `environment`, "*" for all; an
    object runs in this process, where nothing limits it and it could look at the answers. What the functions do, this never raises.
    Failures are explained where a computation shows what is wrong, in at most as much time as the checks took. The Audit is a sequence of
    results, one a check: `verdict`, and what was `got` beside the `bound`; it has `failed`, `summary()` and `to_json()`. Source: the checks
    take their truth from [G25] and the claims of this library.

    Raises InvalidData for an implementation that cannot be reached, has none of the functions or one that takes other arguments, for
    names of checks that do not exist, for a `seed` that is no natural number, for `seconds` or `gibibytes` that are not positive, and for
    an `environment` that is no list of names.

    >>> import faultspace as fs
    >>> from faultspace.numeric.audit import reference
    >>> found = fs.audit(reference, only=["fault-dimension[one-fault]", "window-ranks[one-fault]"])
    >>> found
    <Audit: 2 checks of window_ranks, fault_dimension: 0 failed>
    >>> [(one.name, one.verdict, one.got, one.bound) for one in found if one.function == "fault_dimension"]
    [('fault-dimension[one-fault]', 'pass', 0.0, 0.0)]
    """
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise InvalidData(f"seed: got {shorten(seed)}, expected a natural number")
    for name, value in (("seconds", seconds), ("gibibytes", gibibytes)):
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 < value < float("inf"):
            raise InvalidData(f"{name}: got {shorten(value)}, expected a positive number")
    only = [only] if isinstance(only, str) else only
    if not isinstance(only, Collection):
        raise InvalidData(f"only: got {shorten(only)}, expected a list of names of checks")
    environment = [environment] if isinstance(environment, str) else environment
    if not isinstance(environment, Collection) or not all(isinstance(one, str) for one in environment):
        raise InvalidData(f"environment: got {shorten(environment)}, expected a list of names of variables")
    with opened(adapter, command, peer, Limits(seconds, int(gibibytes * 2**30), tuple(environment))) as subject:
        todo = _todo(subject, only, expected, seed, quick)
        heard, results = on_progress or silent, []
        for done, check in enumerate(todo):
            heard(check.name, done, len(todo))
            results.append(as_expected(subject.perform(check), expected))
        results = _explained(results, todo, subject, heard)
    return Audit(label(adapter, command, peer), tuple(results))


def parametrize_with_checks(
    adapter: object, *, expected: Sequence[ExpectedFailure] = (), seconds: float = SECONDS, gibibytes: float = GIBIBYTES
) -> Callable[[Test], Test]:
    """Return a pytest decorator: the test gets `check`, a function to call, once for each check; ids are slug[vector]-function.

    An adapter given by name (a string) runs in a process of its own under the limits, an object in this one without. An expected failure
    is marked xfail, strictly, with its reason: pytest calls it red where it passes, hangs or crashes.
    """
    import pytest

    subject: Auditee
    if isinstance(adapter, str):
        subject = worker = Isolated(adapter, Limits(seconds, int(gibibytes * 2**30)))
        atexit.register(worker.close)
    else:
        subject = InProcess(adapter)
    name = label(adapter, None, None)
    cases = []
    for one in _todo(subject, (), expected):
        known = next((known for known in expected if named(one, known.name)), None)
        marks = () if known is None else pytest.mark.xfail(strict=True, raises=AssertionError, reason=known.reason)
        cases.append(pytest.param(partial(_asserted, one, subject, name), id=one.full_name, marks=marks))
    return pytest.mark.parametrize("check", cases)


def _todo(subject: Auditee, only: Sequence[str], expected: Sequence[ExpectedFailure], seed: int = SEED, quick: bool = False) -> list[Check]:
    """Return the checks to run; that there are checks of the expected names is seen first."""
    if expected:
        chosen((), [one.name for one in expected], seed)
    return chosen(subject.functions, only, seed, quick)


def _explained(results: Sequence[CheckResult], checks: Sequence[Check], subject: Auditee, heard: Progress) -> list[CheckResult]:
    """Return the results, the first of each fold of failures with what is probably wrong.

    That may take as long as the checks took: after it the rest goes without.
    """
    deadline = time.perf_counter() + sum(one.seconds for one in results)
    known = {one.full_name: check for one, check in zip(results, checks, strict=True)}
    first = [fold[0] for fold in folded(told(results))]
    found = dict[str, str]()
    for done, one in enumerate(first):
        heard(f"looking for the cause: {one.name}", done, len(first))
        found[one.full_name] = subject.explain(known[one.full_name])
        if time.perf_counter() > deadline:
            break
    return [replace(one, explanation=found.get(one.full_name, "")) for one in results]


def _asserted(check: Check, subject: Auditee, adapter: str) -> CheckResult:
    result = subject.perform(check)
    if result.verdict == Status.BROKEN and result.failed:  # never expected: no AssertionError, which xfail would take
        raise Broken(message(result, adapter))
    if result.failed:
        (cause,) = causes([replace(result, explanation=subject.explain(check))])
        raise AssertionError("\n".join([cause.title, *lines_of(cause, adapter)]))
    return result
