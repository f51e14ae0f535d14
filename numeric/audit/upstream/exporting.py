"""The checks as files that need nothing of ours: one JSON a check, a schema, checksums, readers, and a page that says how.

document       a check, ready for JSON
write_checks   all of them into a folder
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from ....base.errors import InvalidInput, quote_path
from ....base.progress import Progress
from ....base.writing import reason, write_text
from ..adapter import FUNCTIONS
from ..checks import growth
from ..checks.catalogue import chosen
from ..records import Check, Demand, Sides, plain
from ..signatures import ARGUMENTS
from ..vectors.rationals import ROUNDING
from .questions import GROWS, Argument, question
from .recipes import EITHER, FREE, GROWTH, MANNERS, RECIPES, REFUSAL

FORMAT = "faultspace-audit-check/1"
SHORT = 100  # samples of a record that is made for the arguments beside it, which do not depend on its length
READERS = ("read_checks.py", "read_checks.m", "read_checks.jl", "README.md")


@dataclass(frozen=True)
class _Kept:
    name: str
    text: str


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
    kept = [_Kept(name, here.joinpath(name).read_text("utf-8")) for name in READERS]
    kept.append(_Kept("schema.json", here.joinpath("schema.json").read_text("utf-8")))
    for one in kept:
        write_text(folder / one.name, one.text)
    sums = [(one.name, _digest(one.text)) for one in kept]
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
