"""Negative controls: what must be refused is tried while the page is made, and has to be refused.

controls    the object: spoiled certificates of the run, by kind, with how many were accepted all the same; false statements of the language
spoiled     a certificate whose statement is made false, None for kinds of which no change is false for certain
SPOILING    kind -> what is changed in the statement, and why the result is false
FALSE       statements that are false, as the language of claims says them, each with a true one that differs in one place
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...base.progress import Progress, silent
from ...proofs.brought.claiming import claim
from ...proofs.brought.claims import Answered
from ...proofs.checking import check
from ...proofs.trust.checker import Malformed, Rejected


@dataclass(frozen=True)
class Spoiling:
    """`change` alters a statement in place and tells whether it could; `words` say what is changed and why that is false."""

    words: str
    change: Callable[[dict[str, Any]], bool]


@dataclass(frozen=True)
class FalseStatement:
    """`conclusion` is false where `hypotheses` hold, and `true` is not refuted: of systems with entries 0 and 1, n + m + p <= `total`."""

    words: str
    hypotheses: tuple[str, ...]
    conclusion: str
    true: str
    total: int


def _raised(key: str) -> Callable[[dict[str, Any]], bool]:
    def change(statement: dict[str, Any]) -> bool:
        if statement[key] is None:  # a delay that does not exist
            return False
        statement[key] += 1
        return True

    return change


def _last_raised(key: str) -> Callable[[dict[str, Any]], bool]:
    def change(statement: dict[str, Any]) -> bool:
        if not statement[key]:
            return False
        statement[key][-1] += 1
        return True

    return change


def _constant_moved(statement: dict[str, Any]) -> bool:
    coefficients = statement["invariant_zero_polynomial"]
    if not isinstance(coefficients[0], str) or len(coefficients) < 2:  # over Q(a) a number is a list; of degree 0 it is 1 alone
        return False
    coefficients[0] = str(Fraction(coefficients[0]) + 1)
    return "prime" not in statement["system"].get("field", {})


def _fewer_columns(statement: dict[str, Any]) -> bool:
    return bool(statement["basis"]) and statement["basis"].pop() is not None


def _entry_moved(statement: dict[str, Any]) -> bool:
    if not statement["B"] or not statement["B"][0]:
        return False
    statement["B"][0][0] = str(Fraction(statement["B"][0][0]) + 1)
    return True


def _no_fault(statement: dict[str, Any]) -> bool:
    system = statement["system"]
    width = len(system["G"][0]) if system["G"] else 0
    for name in ("F", "G"):
        system[name] = [["0"] * len(row) for row in system[name]]
    return width > 0


def _the_same(statement: dict[str, Any]) -> bool:
    statement["second"] = copy.deepcopy(statement["first"])
    return True


SPOILING: Mapping[str, Spoiling] = {
    "window-ranks": Spoiling("the last of the ranks is raised by one; each rank has one value", _last_raised("window_ranks")),
    "matrix-rank": Spoiling("the rank is raised by one; it has one value", _raised("rank")),
    "infinite-zeros": Spoiling("the largest order is raised by one; the orders are determined", _last_raised("infinite_zero_orders")),
    "inversion-delay": Spoiling("the delay is raised by one; it is the least one", _raised("delay")),
    "moesp-limit": Spoiling("the rank of the limit is raised by one; it has one value", _raised("limit_rank")),
    "finite-zeros": Spoiling("the polynomial's constant is raised by one; the monic polynomial is determined", _constant_moved),
    "fault-space": Spoiling("a vector of the basis is left out; the rest spans less", _fewer_columns),
    "input-limit": Spoiling("an entry of B is raised by one; the regression has one minimum", _entry_moved),
    "left-invertible": Spoiling("F and G become zero; then every fault gives the same output", _no_fault),
    "behaviour-difference": Spoiling("the second system becomes the first; nothing differs from itself", _the_same),
}
FALSE = (
    FalseStatement("A left-invertible system has more outputs than faults.", ("left_invertible",), "p > m", "p >= m", 4),
    FalseStatement("A minimal system has no finite zero.", ("minimal",), "finite_zeros == 0", "finite_zeros <= n", 3),
    FalseStatement(
        "The rank gap is m one window before the lag already.", ("left_invertible", "lag >= 2"), "gap(lag - 1) == m", "gap(lag) == m", 5
    ),
)


def controls(
    certificates: Mapping[str, Mapping[str, Any]], statements: int = len(FALSE), *, on_progress: Progress = silent
) -> dict[str, Any]:
    """Spoil each certificate of the run whose kind allows it and hand it to the checker; decide so many false statements and true ones."""
    kinds: dict[str, dict[str, Any]] = {}
    for done, (digest, certificate) in enumerate(certificates.items()):
        on_progress("trying negative controls", done, len(certificates))
        changed = spoiled(certificate)
        if changed is None:
            continue
        row = kinds.setdefault(
            certificate["kind"], {"tried": 0, "accepted": [], "reason": "", "words": SPOILING[certificate["kind"]].words}
        )
        row["tried"] += 1
        reason = _refusal(changed)
        if reason is None:
            row["accepted"].append(digest)
        row["reason"] = row["reason"] or reason or ""
    return {"spoiled": kinds, "statements": [_decided(one) for one in FALSE[:statements]]}


def spoiled(certificate: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return a copy of the certificate with a false statement, where one is known to be false."""
    if certificate["kind"] not in SPOILING:
        return None
    changed = copy.deepcopy(dict(certificate))
    return changed if SPOILING[certificate["kind"]].change(changed["statement"]) else None


def _refusal(certificate: Mapping[str, Any]) -> str | None:
    try:
        check(certificate)
    except (Rejected, Malformed) as error:
        return str(error)
    return None


def _decided(one: FalseStatement) -> dict[str, Any]:
    false, true = (
        claim(conclusion, hypotheses=one.hypotheses, box={"total": one.total, "entries": [0, 1]}, ablation=False).answers[0]
        for conclusion in (one.conclusion, one.true)
    )
    return {
        "words": one.words,
        "hypotheses": list(one.hypotheses),
        "conclusion": one.conclusion,
        "true": one.true,
        "verdict": str(false.verdict),
        "verdict_of_true": str(true.verdict),
        "counterexample": None if false.counterexample is None else str(false.counterexample.case),
        "refused": false.verdict == Answered.REFUTED and true.verdict != Answered.REFUTED,
    }
