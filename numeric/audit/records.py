"""This says what a check is, and what it leaves behind.

Check         slug, function tested, vector, claim, effect on a user, severity, kind, and `measure`, which calls the function
Measurement   quantity, got, bound: a distance from the exact answer, and what rounding may make of it
Named         what both are called by
CheckResult   a check's outcome: verdict (a Status), the worst measurement, in words what happened
Demand        must-hold, must-refuse (an answer is the failure) or free (told, never failed)
Refused       the implementation declined to answer; Broken: it crashed, hung or answered what is no answer
perform       runs one check; never raises for what the implementation does
broken        the result of a check during which the implementation broke
grouped       results by slug and function
message       a failure in words, with the line that shows it again
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from enum import StrEnum
from math import inf, isnan
from typing import Any

from ...base.threads import one_thread

Function = Callable[..., Any]


class Refused(Exception):
    """The implementation declined to answer; the message is its own."""


class Broken(Exception):
    """It is raised where the implementation crashed, hung, or answered what is no answer."""


class NotOffered(Exception):
    """The implementation answers, but not what this check asks of it: some do not tell all that a function can."""


class Demand(StrEnum):
    """This is what a check asks for."""

    MUST_HOLD = "must-hold"
    MUST_REFUSE = "must-refuse"
    FREE = "free"


class Severity(StrEnum):
    """The severity says what a failure does: a wrong answer without a warning, a wrong one in some uses, or trouble that is seen at
    once."""

    SILENT = "silently wrong"
    SOMETIMES = "wrong in some uses"
    NUISANCE = "nuisance"


class Status(StrEnum):
    """A check has this status; FAIL is beyond the bound, or an answer where none can be, and REFUSED is none where one is due."""

    PASS = "pass"
    FAIL = "fail"
    REFUSED = "refused"
    BROKEN = "broken"
    NOT_OFFERED = "not offered"


@dataclass(frozen=True)
class Measurement:
    """A measurement is a distance `got` >= 0 from the exact answer beside its `bound`; a bound of 0 asks for equality."""

    quantity: str
    got: float
    bound: float

    @property
    def ratio(self) -> float:
        """This is got / bound: at most one where all is well."""
        if isnan(self.got):
            return inf
        return self.got / self.bound if self.bound > 0 else (0.0 if self.got == 0 else inf)


@dataclass(frozen=True)
class Named:
    """This is what a check and its result are called by."""

    slug: str
    function: str
    vector: str

    @property
    def name(self) -> str:
        """The name is slug[vector]."""
        return f"{self.slug}[{self.vector}]"

    @property
    def full_name(self) -> str:
        """The name is slug[vector]-function; no other check has it."""
        return f"{self.name}-{self.function}"

    @property
    def names(self) -> tuple[str, str, str]:
        """These are its names for itself, with that of other functions, with all of its slug."""
        return self.full_name, self.name, self.slug


@dataclass(frozen=True)
class Check(Named):
    """This is one question to one function on one vector. `measure` takes the guarded function and gives measurements.

    `claim`: the statement in the ledger that the expected answer rests on, None where it is plain good manners.
    """

    claim: str | None
    effect: str
    severity: Severity
    measure: Callable[[Function], Iterable[Measurement]]
    kind: Demand = Demand.MUST_HOLD


@dataclass(frozen=True)
class CheckResult(Named):
    """This is the outcome of one check; got, bound, ratio are those of the worst measurement (None where nothing was measured)."""

    claim: str | None
    effect: str
    severity: str
    kind: str
    verdict: str
    quantity: str | None
    got: float | None
    bound: float | None
    ratio: float | None
    detail: str
    seconds: float

    @property
    def failed(self) -> bool:
        """It has failed where a must is not met."""
        return self.kind != Demand.FREE and self.verdict not in (Status.PASS, Status.NOT_OFFERED)

    def to_json(self) -> dict[str, Any]:
        """Return what is ready for JSON; numbers that are not finite as strings."""
        values = {name: str(value) if isinstance(value, float) and abs(value) == inf else value for name, value in asdict(self).items()}
        return {"check": self.name, **values, "failed": self.failed}


@one_thread()
def perform(check: Check, function: Function) -> CheckResult:
    """Return the result of one check on a guarded function."""
    begun = time.perf_counter()
    worst: Measurement | None = None
    detail = ""
    try:
        measured = list(check.measure(function))
        if check.kind is Demand.MUST_REFUSE:
            verdict, detail = Status.FAIL, "answered where no answer can be right"
        else:
            worst = max(measured, key=lambda one: one.ratio)
            verdict = Status.PASS if worst.ratio <= 1 else Status.FAIL
            beyond = [one.quantity for one in measured if one.ratio > 1]
            detail = f"beyond the bound: {', '.join(dict.fromkeys(beyond))}" if beyond else ""
    except Refused as refusal:
        verdict = Status.PASS if check.kind is Demand.MUST_REFUSE else Status.REFUSED
        detail = str(refusal)
    except Broken as failure:
        verdict, detail = Status.BROKEN, str(failure)
    except NotOffered as absent:
        verdict, detail = Status.NOT_OFFERED, str(absent)
    except Exception as error:  # the comparison did not expect such an answer
        verdict, detail = Status.BROKEN, f"the answer cannot be read: {type(error).__name__}: {error}"
    return _result(check, verdict, worst, detail, time.perf_counter() - begun)


def broken(check: Check, failure: Exception, seconds: float) -> CheckResult:
    """The status is BROKEN, in the words of the failure."""
    return _result(check, Status.BROKEN, None, str(failure), seconds)


def grouped(results: Iterable[CheckResult]) -> list[list[CheckResult]]:
    """Return the results grouped: those of one slug and function stand together, in their order."""
    groups: dict[tuple[str, str], list[CheckResult]] = {}
    for one in results:
        groups.setdefault((one.slug, one.function), []).append(one)
    return list(groups.values())


def message(result: CheckResult, adapter: str = "ADAPTER") -> str:
    """Return what went wrong, what it does to a user, by how much, and the line that shows it again."""
    measured = "" if result.ratio is None else f" {result.quantity}: got {result.got:.3g}," if result.got is not None else " got NaN,"
    if result.ratio is not None and result.bound is not None:
        measured += f" bound {result.bound:.3g}, ratio {result.ratio:.3g}."
    detail = f" {result.detail}." if result.detail else ""
    return (
        f"{result.name} ({result.function}): {result.verdict}.{measured}{detail} Effect: {result.effect} ({result.severity}). "
        f"Again: faultspace audit {adapter} --check '{result.full_name}'"
    )


def _result(check: Check, verdict: Status, worst: Measurement | None, detail: str, seconds: float) -> CheckResult:
    effect, severity = check.effect, check.severity
    if verdict in (Status.REFUSED, Status.BROKEN):  # whoever gets no answer is not misled
        due = "something was to be said of the question" if check.kind is Demand.MUST_REFUSE else "there is an answer"
        effect, severity = f"no answer where {due}", Severity.NUISANCE
    return CheckResult(
        check.slug,
        check.function,
        check.vector,
        check.claim,
        effect,
        str(severity),
        str(check.kind),
        str(verdict),
        worst.quantity if worst else None,
        None if worst is None or isnan(worst.got) else float(worst.got),
        worst.bound if worst else None,
        worst.ratio if worst else None,
        detail,
        seconds,
    )
