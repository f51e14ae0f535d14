"""The checks as files that need nothing of ours: one JSON a check, a schema, checksums, readers, and a page that says how.

document       a check, ready for JSON
write_checks   all of them into a folder
RECIPES        what of an answer is compared -> how;   MANNERS: checks of manners -> how they are made
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from fractions import Fraction
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from ....base.errors import InvalidInput, quote_path
from ....base.progress import Progress
from ....base.writing import reason, write_text
from ..adapter import ARGUMENTS, FUNCTIONS
from ..checks import growth
from ..checks.catalogue import chosen
from ..records import Check, Demand, Sides, plain
from ..vectors.rationals import ROUNDING
from .questions import GROWS, Argument, question

FORMAT = "faultspace-audit-check/1"
SHORT = 100  # samples of a record that is made for the arguments beside it, which do not depend on its length
READERS = ("read_checks.py", "read_checks.m", "read_checks.jl", "README.md", "schema.json")

# -- how an answer is compared with the truth, in words that need no code of ours ---------------------------------------------------------

PAIRS = (
    "Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least; "
    "each is within its bound."
)
ENTRIES = "Every entry differs from the true one by no more than its bound."
EXACT = "A bound is derived for exact comparison; comparing in floats adds rounding, which is far below it."
ANGLE = (
    "It spans a space of the true dimension, and the sine of the largest angle between the two, from either side, is within the bound; "
    "spaces of unlike dimensions have the sine 1."
)

RECIPES = {
    "markov": f"D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. {ENTRIES} {EXACT}",
    "transfer": f"D + C (z I - A)^-1 B of the answer at the z given. {ENTRIES} {EXACT}",
    "polynomial": f"The coefficients of det(z I - A) of the answer, of z^(n-1), ..., 1. {ENTRIES} {EXACT}",
    "eigenvalues": f"The eigenvalues of the answer's A, each as [re, im]. {PAIRS}",
    "residual": "Subtract the true r (N, p) from the answer; what is left may be a response to some initial state. For each kernel row "
    "with coefficients c_0, ..., c_d, each of length p, the norm over all t of c_0 off(t) + ... + c_d off(t + d), which such a response "
    "leaves at 0, is within the bound of that row.",
    "ranks": "All ranks are equal to the true ones.",
    "count": "The number is equal to the true one.",
    "space": f"The columns of the answer (n + p, n_z). {ANGLE}",
    "dimension": "The dimension is equal to the true one.",
    "responses": "Of the answer (A, C, Z), let f be the first n rows of Z and g the others: stack g, C f, C A f, ... over the window "
    f"given, the outputs over their units. {ANGLE}",
    "signal": "The 2-norm, over the first samples that are given, of the difference from the true v is within the bound; what comes after "
    "is free.",
    "normal_rank": "The number is equal to the true one.",
    "left_invertible": "It is true or false as it is to be.",
    "infinite_zero_orders": "In ascending order, they are equal to the true ones.",
    "finite_zeros": f"As many as there are true ones. {PAIRS}",
}
MANNERS = {
    "deterministic": "The question is asked twice, with copies of the same arguments. Both answers are the same in every bit.",
    "order-of-calls": "The question is asked, then another one, then the first again: both answers to it are the same in every bit.",
    "same-array-new-data": "An array that was asked about is filled with other data and asked about again: the answer is that to the "
    "new data.",
    "prints-nothing": "While it is asked, the function writes nothing to standard output.",
    "leaves-no-files": "While it is asked, the function leaves no file in the working folder, nor in that of temporary files.",
    "leaves-the-state": "What a process has one of is after the call as it was before: random numbers of numpy and of the language, "
    "handling of floating-point errors, filters of warnings, the working folder, the environment, threads, open files, signals, timers, "
    "hooks, the log, the context of decimals, the mask of files, limits, priority and processors, functions of libraries, and how "
    "processes are started.",
    "right-on-long-records": "On a record of the length given, made by signs through the system, some of them late or of many digits, the "
    "answer differs from the true one by no more than half of a unit in each quantity named.",
    "earlier-answers-stay": "An answer is kept while two other questions of the same shapes are asked: it is the same in every bit after "
    "them, and none of its arrays is one that was given.",
    "forgets-the-records": "Twenty records are asked about, one after another, and let go: of ten at least nothing is held any more. Three "
    "longer ones after that take less memory for good than half of what they are.",
    "inputs-untouched": "After the call every array that was given is as it was before.",
}
REFUSAL = "No answer is right. The function raises an error or answers nothing."
GROWTH = (
    "The function is asked about records of the lengths given, made by the recipe. With c1 and c2 the peak memory in bytes, or the CPU "
    "time in seconds, of the process and its children, log(c2 / max(c1, floor N1 / N2)) / log(N2 / N1) is within the bound, or c2 is "
    "below the floor. Time that grows faster is measured once more at twice the length, since data may outgrow a cache between two "
    "lengths, and the smaller exponent counts."
)
EITHER = " To refuse is an answer here, too: what cannot be told may stay untold."
FREE = " Nothing is due: whatever is answered is told, and counts neither for nor against."


def document(check: Check) -> dict[str, Any]:
    """Return the check with its floats beside the rationals, what is due, the bounds, and how to compare."""
    head = {
        "format": FORMAT,
        "name": check.full_name,
        "slug": check.slug,
        "asks": check.function,
        "vector": check.vector,
        "claim": check.claim,
        "effect": check.effect,
        "severity": str(check.severity),
        "demand": str(check.kind),
        "rounding": ROUNDING,
    }
    if check.slug in GROWS:
        return {**head, "may_refuse": False, "recipe": GROWTH, "calls": [], "manner": None, "growth": _growth(check)}
    asked = question(check)
    manner = check.slug if asked.measured and not any(call.due for call in asked.calls) else None
    ways = [RECIPES[due.sides.of] for call in asked.calls for due in call.due]
    words = " ".join(dict.fromkeys(ways)) or (
        REFUSAL if check.kind is Demand.MUST_REFUSE else MANNERS.get(check.slug, _named(asked.measured))
    )
    words += EITHER if asked.may_refuse else ""
    words += FREE if check.kind is Demand.FREE else ""
    calls = [
        {
            "arguments": [_argument(one) for one in call.arguments],
            "expected": [{"quantity": one.quantity, **_sides(one.sides)} for one in call.due],
        }
        for call in asked.calls
    ]
    return {**head, "may_refuse": asked.may_refuse, "recipe": words, "calls": calls, "manner": manner, "growth": None}


def _named(measured: Sequence[tuple[str, float]]) -> str:
    return " ".join(f"{quantity}: at most {bound:g}." for quantity, bound in dict.fromkeys(measured))


def _argument(one: Argument) -> dict[str, Any]:
    if not isinstance(one.value, np.ndarray):
        return {"name": one.name, "floats": plain(one.value), "rationals": None, "shape": None, "memory": None}
    both = {"floats": plain(one.value.tolist()), "rationals": _rationals(one.exact)}
    return {"name": one.name, **both, "shape": list(one.value.shape), "memory": _memory(one.value)}


def _memory(value: Any) -> dict[str, Any] | None:
    """Return how an array lies in memory; None for the usual: float64, rows one after the other, writeable."""
    if value.dtype == np.float64 and value.flags.c_contiguous and value.flags.writeable:
        return None
    order = "rows" if value.flags.c_contiguous else "columns" if value.flags.f_contiguous else "strided"
    return {"dtype": str(value.dtype), "order": order, "writeable": bool(value.flags.writeable)}


def _sides(sides: Sides) -> dict[str, Any]:
    given = {name: _both(value) for name, value in sides.given.items()}
    return {"of": sides.of, **_both(sides.truth), "bounds": plain(sides.bounds), "given": given}


def _both(value: Any) -> dict[str, Any]:
    return {"floats": plain(value), "rationals": _rationals(value) if _exact(value) else None}


def _exact(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return all(map(_exact, value))
    return isinstance(value, (Fraction, int))


def _rationals(value: Any) -> Any:
    if isinstance(value, (list, tuple)):
        return [_rationals(one) for one in value]
    return plain(value) if isinstance(value, (float, bool)) or value is None else str(value)


def _growth(check: Check) -> dict[str, Any]:
    """Return how the records are made, and what is asked of the costs."""
    memory = check.slug == "memory-grows-with-N"
    used = growth.driven_system(check.function)
    asked = growth.question(check.function, SHORT)
    rest = {name: value for name, value in zip(ARGUMENTS[check.function], asked, strict=True) if not isinstance(value, np.ndarray)}
    return {
        "lengths": list(growth.LENGTHS),
        "bound": growth.BOUND,
        "floor": growth.MEMORY_FLOOR if memory else growth.TIME_FLOOR,
        "unit": "bytes" if memory else "seconds",
        "system": {
            name: _rationals([[Fraction(str(x)) for x in row] for row in one.to_json()]) for name, one in zip("ABCD", used, strict=True)
        },
        "signs": f"x := 6364136223846793005 x + 1442695040888963407 mod 2^64 from {growth.SEED}; "
        "+1 where bit 63 is set, else -1; channel after channel",
        "record": "x(k+1) = A x + B w, out = C x + D w from rest with the signs w; y or r is out, u is w; "
        "A, B, C, D stand for A, F, C, G of faults, too",
        "other_arguments": rest,
    }


def write_checks(folder: Path, only: Sequence[str], tell: Progress) -> int:
    """Write the checks that `only` names (none: all) with what goes with them, and return how many there are. Raises InvalidInput."""
    checks = chosen(FUNCTIONS, only)
    try:
        (folder / "checks").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{quote_path(str(folder))}: cannot be made ({reason(error)}), expected a folder to write into") from None
    here = files("faultspace.numeric.audit.upstream").joinpath("readers")
    sums = []
    for name in READERS:
        text = here.joinpath(name).read_text("utf-8")
        write_text(folder / name, text)
        sums.append((name, _digest(text)))
    for done, check in enumerate(checks):
        tell(check.full_name, done, len(checks))
        name = f"checks/{file_name(check)}"
        text = json.dumps(document(check), allow_nan=False) + "\n"
        write_text(folder / name, text)
        sums.append((name, _digest(text)))
    write_text(folder / "SHA256SUMS", "".join(f"{digest}  {name}\n" for name, digest in sums))
    return len(checks)


def file_name(check: Check) -> str:
    """Return a name that every file system takes."""
    return re.sub(r"[^A-Za-z0-9._-]", "_", check.full_name.replace("[", "--").replace("]", "-")) + ".json"


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
