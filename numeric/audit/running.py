"""One generator of checks, and its faces: records, pytest cases, the command line.

all_checks                every check, in order
audit                     records of the checks on what an object offers, in this process
audit_named               the same for an adapter by name, in a process of its own under limits of time and memory
parametrize_with_checks   decorates a test that takes `check`: `check()` raises AssertionError with slug, effect, got, bound, ratio
ExpectedFailure           a failure with its reason; turns red when the check passes
told                      a failed record in words, with the line that reproduces it
"""

from __future__ import annotations

import atexit
import shlex
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

from ...base.errors import InvalidData
from . import (
    consistency_checks,
    excitation_checks,
    fault_checks,
    good_manners,
    growth_checks,
    identification_checks,
    refusal_checks,
    structure_checks,
)
from .adapter import guarded, offered
from .isolation import Isolated
from .programs import STANDARD, Limits
from .records import Check, Record, Verdict, perform

Test = TypeVar("Test", bound=Callable[..., object])
MODULES = (
    identification_checks,
    consistency_checks,
    fault_checks,
    excitation_checks,
    structure_checks,
    refusal_checks,
    good_manners,
    growth_checks,
)


@dataclass(frozen=True)
class ExpectedFailure:
    """Of the check `name`: a slug (then all of its vectors), slug[vector], or slug[vector]-function where several functions have it.

    `reason` says why it fails and who knows of it. To hang or to crash is never expected.
    """

    name: str
    reason: str

    def __post_init__(self) -> None:
        if not self.reason.strip():
            raise InvalidData(f"the expected failure of {self.name} needs a reason")


def all_checks() -> Iterator[Check]:
    """Every check."""
    for module in MODULES:
        yield from module.checks()


def chosen(functions: Collection[str], only: Sequence[str] = ()) -> list[Check]:
    """The checks of these functions, those named by slug or slug[vector] alone if any are. Raises InvalidData for an unknown name."""
    known = list(all_checks())
    for name in only:
        if not any(name in one.names for one in known):
            raise InvalidData(f"check {name}: there is none of that name; there are {', '.join(dict.fromkeys(one.slug for one in known))}")
        if functions and not any(name in one.names for one in known if one.function in functions):
            asked = ", ".join(dict.fromkeys(one.function for one in known if name in one.names))
            raise InvalidData(f"check {name} asks {asked}, which this adapter does not have: it has {', '.join(functions)}")
    return [one for one in known if one.function in functions and (not only or any(name in only for name in one.names))]


def audit(
    implementation: object,
    *,
    only: Sequence[str] = (),
    expected: Sequence[ExpectedFailure] = (),
    tell: Callable[[str, int, int], None] = lambda name, done, total: None,
) -> tuple[Record, ...]:
    """An implementation of subspace identification and fault estimation, of anyone's, through checks with exactly known answers.

    `implementation` is any object, a module say, with one or more of the functions that `faultspace.numeric.audit.adapter` describes
    (`pi_moesp`, `residual`, `fault_dimension`, `fault_space`, ...; arrays are time-major, y is N x p and u is N x n_u). `only` names the
    checks to run, by slug or slug[vector]; `expected` lists failures that are known; `tell(name, done, total)` hears of the progress. The
    result has a Record for every check of the functions that are there: `verdict`, and what was got beside the bound. It runs in this
    process, so that nothing limits the time that the functions take; `audit_named` runs them in a process of its own. What they do, this
    never raises. Source: the checks take their truth from [G25] and the claims of this library.

    Raises InvalidData for an implementation without any of the functions, and for names of checks that do not exist.

    >>> import faultspace as fs
    >>> try:
    ...     fs.audit(object())
    ... except fs.errors.InvalidData as error:
    ...     print("refused")
    refused
    """
    functions = {name: guarded(one) for name, one in offered(implementation).items()}
    return _records(chosen(functions, only), lambda check: perform(check, functions[check.function]), expected, tell)


def audit_named(
    name: str,
    *,
    limits: Limits = STANDARD,
    only: Sequence[str] = (),
    expected: Sequence[ExpectedFailure] = (),
    tell: Callable[[str, int, int], None] = lambda name, done, total: None,
) -> tuple[Record, ...]:
    """The same for the adapter of that name (see `adapter.load`) in a process of its own, under the limits."""
    with Isolated(name, limits) as adapter:
        return _records(chosen(adapter.functions, only), adapter.perform, expected, tell)


def _records(
    todo: Sequence[Check],
    made: Callable[[Check], Record],
    expected: Sequence[ExpectedFailure],
    tell: Callable[[str, int, int], None],
) -> tuple[Record, ...]:
    if expected:
        chosen((), [one.name for one in expected])
    records = []
    for done, check in enumerate(todo):
        tell(check.name, done, len(todo))
        records.append(_expecting(made(check), expected))
    return tuple(records)


def _expecting(record: Record, expected: Sequence[ExpectedFailure]) -> Record:
    """An expected failure passes and says why; a pass where a failure is expected fails."""
    known = next((one for one in expected if one.name in record.names), None)
    if known is None or record.verdict == Verdict.BROKEN:
        return record
    if record.verdict == Verdict.PASS:
        return replace(record, verdict=str(Verdict.FAIL), detail=f"passes, but a failure is expected ({known.reason}): take the mark away")
    return replace(record, verdict=str(Verdict.PASS), detail=f"fails as expected: {known.reason}")


def told(record: Record, adapter: str = "ADAPTER") -> str:
    """What went wrong, what it does to a user, by how much, and the line that shows it again."""
    measured = "" if record.ratio is None else f" {record.quantity}: got {record.got:.3g}," if record.got is not None else " got NaN,"
    if record.ratio is not None and record.bound is not None:
        measured += f" bound {record.bound:.3g}, ratio {record.ratio:.3g}."
    detail = f" {record.detail}." if record.detail else ""
    return (
        f"{record.name} ({record.function}): {record.verdict}.{measured}{detail} Effect: {record.effect} ({record.severity}). "
        f"Again: faultspace audit {adapter} --check '{record.full_name}'"
    )


def parametrize_with_checks(
    implementation: object, *, limits: Limits = STANDARD, expected: Sequence[ExpectedFailure] = ()
) -> Callable[[Test], Test]:
    """A pytest decorator: the test gets `check`, a function to call, once for each check; ids are slug[vector]-function.

    An implementation given by name (a string) runs in a process of its own under the limits, an object in this one without.
    """
    import pytest

    if isinstance(implementation, str):
        adapter = Isolated(implementation, limits)
        atexit.register(adapter.close)
        name, todo, made = implementation, chosen(adapter.functions), adapter.perform
    else:
        name = getattr(implementation, "__name__", "ADAPTER")
        functions = {name: guarded(one) for name, one in offered(implementation).items()}
        todo, made = chosen(functions), lambda check: perform(check, functions[check.function])
    if expected:
        chosen((), [one.name for one in expected])
    cases = [pytest.param(partial(_asserted, one, made, expected, shlex.quote(name)), id=one.full_name) for one in todo]
    return pytest.mark.parametrize("check", cases)


def _asserted(check: Check, made: Callable[[Check], Record], expected: Sequence[ExpectedFailure], adapter: str) -> Record:
    record = _expecting(made(check), expected)
    if record.failed:
        raise AssertionError(told(record, adapter))
    return record
