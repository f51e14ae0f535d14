"""Failures that are known, with their reasons.

A file has a failure a line, `NAME: REASON`; empty lines, and lines that begin with #, are nobody's. NAME is a slug, slug[vector] or
slug[vector]-function, or a pattern of these with * and ?.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...base.errors import InvalidData, InvalidInput, quote_path, shorten
from ...base.regular_files import open_regular
from ...base.writing import reason
from .records import CheckResult, Status, named


@dataclass(frozen=True)
class ExpectedFailure:
    """This is an expected failure of the check `name`: a slug (then all of its vectors), slug[vector], or slug[vector]-function where
    several functions have it; * and ? stand for any characters and for one.

    `reason` says why it fails and who knows of it. To hang or to crash is never expected.
    """

    name: str
    reason: str

    def __post_init__(self) -> None:
        if not self.reason.strip():
            raise InvalidData(f"the expected failure of {self.name} needs a reason")


def expected_in(path: Path) -> tuple[ExpectedFailure, ...]:
    """Return the expected failures that a file lists. Raises InvalidData for a file that cannot be read, with the line for one that has no
    name, no reason, or a name that stands there already."""
    shown = quote_path(str(path))
    try:
        with open_regular(path, "a file of lines NAME: REASON") as stream:
            lines = stream.read().decode("utf-8").splitlines()
    except InvalidInput as error:
        raise InvalidData(f"{shown}: {error}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidData(f"{shown}: cannot be read ({reason(error)}), expected a file of lines NAME: REASON") from None
    found: dict[str, ExpectedFailure] = {}
    for number, line in enumerate(lines, start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        name, _, why = (part.strip() for part in line.partition(":"))
        if not name or not why:
            raise InvalidData(
                f"{shown}, line {number}: got {shorten(line)}, expected NAME: REASON, such as other-units[n2-u1-p1]: no scaling yet"
            )
        if name in found:
            raise InvalidData(f"{shown}, line {number}: got {name} for the second time, expected each name once")
        found[name] = ExpectedFailure(name, why)
    return tuple(found.values())


def as_expected(result: CheckResult, expected: Sequence[ExpectedFailure]) -> CheckResult:
    """Return a result whose failure is expected as that, with the reason, and a pass where a failure is expected as a failure."""
    known = next((one for one in expected if named(result, one.name)), None)
    if known is None or result.verdict in (Status.BROKEN, Status.NOT_OFFERED, Status.EXPECTED, Status.UNEXPECTED):
        return result
    if result.verdict == Status.PASS:
        detail = f"passes, but a failure is expected ({known.reason}): take the mark away"
        return replace(result, verdict=str(Status.UNEXPECTED), detail=detail)
    return replace(result, verdict=str(Status.EXPECTED), detail=f"fails as expected: {known.reason}")
