"""This says what a check is, and what it leaves behind.

Check         slug, function tested, vector, claim, effect on a user, severity, kind, and `measure`, which calls the function
Measurement   quantity, got, bound: a distance from the exact answer, and what rounding may make of it
Sides         the answer beside the truth that a measurement compared, and the way of comparing
Named         what both are called by;   named, patterned: whether a name or a pattern with * and ? fits one, whether it is a pattern
CheckResult   a check's outcome: verdict (a Status), the worst measurement, in words what happened
Demand        must-hold, must-refuse (an answer is the failure) or free (told, never failed)
NEARNESS      how many bounds off is near
Refused       the implementation declined to answer; Broken: it crashed, hung or answered what is no answer
or_refused    what compares an answer, where a refusal is as right
perform       runs one check; never raises for what the implementation does
inside        what is measured in the process of the function, which may be another one
grouped       results by slug and function
message       a failure in words, with the line that shows it again
plain         nested numbers as JSON has them
first_difference   where in a record the answer begins to differ
"""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields
from enum import StrEnum
from fractions import Fraction
from functools import cache
from math import inf, isfinite, isnan
from typing import Any

import numpy as np

from ...base.threads import one_thread

NEARNESS = 10.0  # a bound is a worst case to first order, with constants of the methods that we know: another's may be some times larger
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
    """A check has this status; FAIL is beyond the bound, or an answer where a refusal is due, and REFUSED is none where one is due.

    NEAR is beyond a bound of rounding by less than NEARNESS: it is told and counted apart, and fails nothing. EXPECTED is whatever is not
    right where somebody said so before, UNEXPECTED what is right all the same.
    """

    PASS = "pass"
    FAIL = "fail"
    REFUSED = "refused"
    BROKEN = "broken"
    NEAR = "near"
    NOT_OFFERED = "not offered"
    EXPECTED = "expected failure"
    UNEXPECTED = "unexpected pass"


GREEN = frozenset({Status.PASS, Status.NOT_OFFERED, Status.EXPECTED})
"""Of one of these there is nothing to tell."""


@dataclass(frozen=True)
class Sides:
    """The answer stands beside the truth, both in the units of the question, as numbers or nested lists of them (Fraction where exact).

    of: what of the answer was compared, a key of `upstream.exporting.RECIPES`. bounds: what rounding allows, a number or a list of the
    truth's shape. given: what the way of comparing needs besides, by name. place: the indices of the entry that is furthest off, where
    single entries are compared.
    """

    of: str
    answer: Any
    truth: Any
    bounds: Any = 0.0
    given: Mapping[str, Any] = field(default_factory=dict)
    place: tuple[int, ...] = ()


@dataclass(frozen=True)
class Measurement:
    """A measurement is a distance `got` >= 0 from the exact answer beside its `bound`; a bound of 0 asks for equality.

    `sides` are what was compared, None where nothing of the answer was (manners, costs).
    """

    quantity: str
    got: float
    bound: float
    sides: Sides | None = None

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


def patterned(name: str) -> bool:
    """This tells whether the name holds * or ?; brackets are part of names."""
    return "*" in name or "?" in name


def named(one: Named, name: str) -> bool:
    """This tells whether one of the names of a check or a result is `name`, in which * stands for any characters and ? for one."""
    return any(_pattern(name).fullmatch(known) for known in one.names)


@cache
def _pattern(name: str) -> re.Pattern[str]:
    return re.compile("".join({"*": ".*", "?": "."}.get(letter, re.escape(letter)) for letter in name))


@dataclass(frozen=True)
class Check(Named):
    """This is one question to one function on one vector. `measure` takes the guarded function and gives measurements.

    `claim`: the statement in the ledger that the expected answer rests on, None where it is plain good manners. `nearness`: below this
    ratio a miss is called near; one where the bound is not one of rounding, so that there is nothing between right and wrong.
    """

    claim: str | None
    effect: str
    severity: Severity
    measure: Callable[[Function], Iterable[Measurement]]
    kind: Demand = Demand.MUST_HOLD
    nearness: float = NEARNESS


@dataclass(frozen=True)
class CheckResult(Named):
    """This is the outcome of one check; got, bound, ratio are those of the worst measurement (None where nothing was measured).

    answer, truth: what that measurement compared, as floats, ready for JSON; None where it compared nothing of the answer.
    place: the indices of the entry that is furthest off. sample: where in a record the answer begins to differ by more than the bound.
    explanation: what is probably wrong, found by computation; empty where nothing was found or nobody asked.
    `not_promised`: why the implementation never promised what is asked, in its own words; empty where it did not say so.
    """

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
    not_promised: str = ""
    answer: Any = None
    truth: Any = None
    place: tuple[int, ...] = ()
    sample: int | None = None
    explanation: str = ""

    @property
    def failed(self) -> bool:
        """It has failed where a must is not met. What is near, not offered or was never promised is counted apart."""
        return self.kind != Demand.FREE and not self.not_promised and self.verdict not in (*GREEN, Status.NEAR)

    def to_json(self) -> dict[str, Any]:
        """Return what is ready for JSON; numbers that are not finite as strings."""
        values = {name: str(value) if isinstance(value, float) and abs(value) == inf else value for name, value in asdict(self).items()}
        return {"check": self.name, **values, "place": list(self.place), "failed": self.failed}

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> CheckResult:
        """Return the result that `to_json` wrote. Raises KeyError, TypeError or ValueError for anything else."""
        values = {one.name: data[one.name] for one in fields(CheckResult)}
        numbers = {name: None if values[name] is None else float(values[name]) for name in ("got", "bound", "ratio", "seconds")}
        return CheckResult(**{**values, **numbers, "place": tuple(values["place"])})


@one_thread()
def perform(check: Check, function: Function) -> CheckResult:
    """Return the result of one check on a guarded function."""
    begun = time.perf_counter()
    worst: Measurement | None = None
    detail = ""
    try:
        with np.errstate(all="ignore"):  # around all, so that what the function itself sets is seen, and undone
            measured = list(check.measure(function))
        if check.kind is Demand.MUST_REFUSE:
            verdict, detail = Status.FAIL, "answered where a refusal is due"
        else:
            worst = max(measured, key=lambda one: one.ratio)
            verdict = Status.PASS if worst.ratio <= 1 else Status.NEAR if worst.ratio < check.nearness else Status.FAIL
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


def or_refused(compare: Callable[[Function], Iterable[Measurement]]) -> Callable[[Function], Iterator[Measurement]]:
    """Return the measurement `compare` for a question that may be refused as well: to refuse it is to be off by nothing."""

    def measure(function: Function) -> Iterator[Measurement]:
        try:
            yield from compare(function)
        except Refused:
            yield Measurement("refused, as it may be", 0.0, 0.0)

    return measure


def inside(
    measure: Callable[[Any, Function], Iterable[Measurement]], arguments: tuple[Any, ...], function: Function
) -> Iterable[Measurement]:
    """Return what `measure(arguments, function)` measures of a call and of the process around it, made in that process.

    `measure` is a function of a module; it has the arguments alone, and no truth.
    """
    elsewhere = getattr(function, "inside", None)
    found: Iterable[Measurement] = measure(arguments, function) if elsewhere is None else elsewhere(measure, arguments)
    return found


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
    detail += f" Probably: {result.explanation}" if result.explanation else ""
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
        **_beside(worst.sides if worst else None),
    )


def plain(value: Any) -> Any:
    """Return numbers and nested lists of them as JSON has them: floats, [re, im] for a complex number, what is not finite as a string."""
    if isinstance(value, (bool, int, str)) or value is None:
        return value
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, (Fraction, float)):
        number = float(value)
        return number if isfinite(number) else {inf: "Infinity", -inf: "-Infinity"}.get(number, "NaN")
    return plain(value.item()) if getattr(value, "shape", None) == () else [plain(one) for one in value]


def first_difference(sides: Sides) -> int | None:
    """Return the first sample up to which a signal is further from the truth than its bound allows; None for what is no signal."""
    if sides.of not in ("signal", "residual"):
        return None
    off = [[float(a - b) for a, b in zip(mine, true, strict=True)] for mine, true in zip(sides.answer, sides.truth, strict=True)]
    if sides.of == "residual":  # of which a row of the kernel sees what no initial state can cause, with its last sample
        row = [[float(c) for c in coefficients] for coefficients in sides.given["kernel_row"]]
        seen = [
            [sum(c * x for k, part in enumerate(row) for c, x in zip(part, off[t + k], strict=True))]
            for t in range(len(off) - len(row) + 1)
        ]
        off = [[0.0]] * (len(row) - 1) + seen
    sum_of_squares = 0.0
    for sample, parts in enumerate(off):
        sum_of_squares += sum(x * x for x in parts)
        if not sum_of_squares**0.5 <= sides.bounds:
            return sample
    return None


def _beside(sides: Sides | None) -> dict[str, Any]:
    """These are the fields of a result that tell what was compared."""
    if sides is None:
        return {}
    both = {"answer": plain(sides.answer), "truth": plain(sides.truth)}
    return {**both, "place": tuple(int(i) for i in sides.place), "sample": first_difference(sides)}
