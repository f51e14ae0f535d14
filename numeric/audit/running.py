"""One generator of checks, and its faces: records, pytest cases, the command line.

all_checks                every check, in order
audit                     records of the checks on what an implementation offers
parametrize_with_checks   decorates a test that takes `check`: `check()` raises AssertionError with slug, effect, got, bound, ratio
ExpectedFailure           a failure with its reason; turns red when the check passes
told                      a failed record in words, with the line that reproduces it
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar

from ..input_checks import InvalidData
from . import consistency_checks, fault_checks, good_manners, identification_checks, refusal_checks, structure_checks
from .adapter import guarded, offered
from .records import Check, Record, Verdict, perform

Test = TypeVar("Test", bound=Callable[..., object])
MODULES = (identification_checks, consistency_checks, fault_checks, structure_checks, refusal_checks, good_manners)


@dataclass(frozen=True)
class ExpectedFailure:
    """Of the check `name`: a slug, or slug[vector]. `reason` says why it fails and who knows of it."""

    name: str
    reason: str

    def __post_init__(self) -> None:
        if not self.reason.strip():
            raise InvalidData(f"the expected failure of {self.name} needs a reason")


def all_checks() -> Iterator[Check]:
    """Every check."""
    for module in MODULES:
        yield from module.checks()


def chosen(functions: Mapping[str, Any], only: Sequence[str] = ()) -> list[Check]:
    """The checks of these functions, those named by slug or slug[vector] alone if any are. Raises InvalidData for an unknown name."""
    known = list(all_checks())
    for name in only:
        if not any(name in (one.slug, one.name) for one in known):
            raise InvalidData(f"check {name}: there is none of that name; there are {', '.join(dict.fromkeys(one.slug for one in known))}")
    return [one for one in known if one.function in functions and (not only or one.slug in only or one.name in only)]


def audit(
    implementation: object,
    *,
    only: Sequence[str] = (),
    expected: Sequence[ExpectedFailure] = (),
    tell: Callable[[str, int, int], None] = lambda name, done, total: None,
) -> tuple[Record, ...]:
    """A record for every check of the functions that the implementation has; never raises for what they do.

    `only`: slugs, or slug[vector]. `expected`: failures that are known. `tell` hears of the progress. Raises InvalidData for an
    implementation without a function, and for unknown names.
    """
    functions = {name: guarded(one) for name, one in offered(implementation).items()}
    todo = chosen(functions, only)
    if expected:
        chosen({}, [one.name for one in expected])
    records = []
    for done, check in enumerate(todo):
        tell(check.name, done, len(todo))
        records.append(_expecting(perform(check, functions[check.function]), expected))
    return tuple(records)


def _expecting(record: Record, expected: Sequence[ExpectedFailure]) -> Record:
    """An expected failure passes and says why; a pass where a failure is expected fails."""
    known = next((one for one in expected if one.name in (record.slug, record.name)), None)
    if known is None:
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
        f"Again: faultspace audit {adapter} --check '{record.name}'"
    )


def parametrize_with_checks(implementation: object, *, expected: Sequence[ExpectedFailure] = ()) -> Callable[[Test], Test]:
    """A pytest decorator: the test gets `check`, a function to call, once for each check; ids are slug[vector]-function."""
    import pytest

    functions = {name: guarded(one) for name, one in offered(implementation).items()}
    if expected:
        chosen({}, [one.name for one in expected])
    cases = [pytest.param(partial(_asserted, one, functions, expected), id=f"{one.name}-{one.function}") for one in chosen(functions)]
    return pytest.mark.parametrize("check", cases)


def _asserted(check: Check, functions: Mapping[str, Any], expected: Sequence[ExpectedFailure]) -> Record:
    record = _expecting(perform(check, functions[check.function]), expected)
    if record.failed:
        raise AssertionError(told(record))
    return record
