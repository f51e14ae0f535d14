"""Readings of the ledger that the language of claims can say, decided from their texts: `verify` takes their verdicts from here.

    readings          the readings of `example:ledger`, by "CLAIM--READING"
    decide_reading    the outcome of one of them, for `verify`
    Certified         a system of which accepted certificates tell the quantities: `evaluate` reads them as it reads exact functions
    ANSWERS           which questions about a system tell which quantity

The text of a reading is evaluated on every system of the corpus, and what it reads there are answers of certificates that the checker has
accepted. Where a system fails, the smallest one is sought in the reading's box, as `faultspace claim` seeks it, over Q and with its
certificates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from math import inf
from typing import Any

from ...base.progress import silent
from ...exact.system.systems import ResidualSystem
from ..evidence import questions as ask
from ..evidence.corpus import Evidence, Questions
from ..language.evaluating import Bound, evaluate
from ..language.nodes import Node, Undefined, reads
from ..quantities.registry import Quantity, Subject, quantities
from ..trust.structure_certificates import Certificate, sha256
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify, counterexample
from .claim_files import read_claims
from .claims import Claim
from .deciding import certified
from .trying import Question, search

FILE = "ledger.toml"
MOST = 10**9
Read = Callable[[Evidence], Any]
WindowRead = Callable[[Evidence, int], int]


def _or_inf(delay: int | None) -> float:
    return inf if delay is None else delay


def _solutions(e: Evidence, s: int) -> int:
    """There are certificates for s = 1, ..., n + 2; from n + 1 on the dimension stays as it is, and on no sample every column solves."""
    return e.space_dimensions[min(s, e.system.n + 2) - 1] if s else e.system.n + e.system.p


ANSWERS: dict[str, tuple[Questions, Read]] = {
    "n": ((), lambda e: e.system.n),
    "m": ((), lambda e: e.system.m),
    "p": ((), lambda e: e.system.p),
    "normal_rank": ((ask.RANKS,), lambda e: e.kernel.normal_rank),
    "lag": ((ask.RANKS,), lambda e: e.kernel.lag),
    "left_minimal_indices": ((ask.RANKS,), lambda e: e.kernel.left_minimal_indices),
    "right_minimal_indices": ((ask.RIGHT_INDICES,), lambda e: e.right_minimal_indices),
    "left_invertible": ((ask.RANKS,), lambda e: e.left_invertible),
    "right_invertible": ((ask.RANKS,), lambda e: e.kernel.normal_rank == e.system.p),
    "observable": ((ask.OBSERVABILITY,), lambda e: e.observable),
    "controllable": ((ask.REACHABILITY,), lambda e: e.controllable),
    "minimal": ((ask.OBSERVABILITY, ask.REACHABILITY), lambda e: e.observable and e.controllable),
    "unobservable_dimension": ((ask.OBSERVABILITY,), lambda e: e.system.n - e.answer(ask.OBSERVABILITY)),
    "uncontrollable_dimension": ((ask.REACHABILITY,), lambda e: e.system.n - e.answer(ask.REACHABILITY)),
    "delay_known": ((ask.DELAY_KNOWN_STATE,), lambda e: _or_inf(e.delay_known_state)),
    "delay_unknown": ((ask.DELAY_UNKNOWN_STATE,), lambda e: _or_inf(e.delay_unknown_state)),
    "finite_zeros": ((ask.FINITE_ZEROS,), lambda e: e.finite_zeros),
    "infinite_zero_orders": ((ask.INFINITE_ZEROS,), lambda e: e.infinite_zero_orders),
    "infinite_zeros": ((ask.INFINITE_ZEROS,), lambda e: sum(e.infinite_zero_orders)),
    "zeta": (ask.ZEROS, lambda e: e.zeta),
    "n_z": ((ask.SPACE,), lambda e: e.fault_space.dimension),
}
WITH_A_WINDOW: dict[str, tuple[Questions, WindowRead]] = {
    "rank_OT": ((ask.RANKS,), lambda e, s: e.kernel.rank(s)),
    "gap": ((ask.RANKS,), lambda e, s: e.kernel.gap(s)),
    "solutions": ((ask.WINDOW_SPACES,), _solutions),
}


@dataclass(frozen=True)
class Certified:
    """What accepted certificates say of a system."""

    evidence: Evidence

    @property
    def horizon(self) -> int:
        """This is the number of states."""
        return self.evidence.system.n

    @property
    def own(self) -> Mapping[str, Quantity]:
        """A claim about a system has no quantities of a whole."""
        return {}

    @property
    def names(self) -> tuple[str, ...]:
        """The one system has no name."""
        return ("",)

    def quantity(self, subject: str, name: str) -> Any:
        """Return the value of a quantity. Raises KeyError where no question tells it."""
        return ANSWERS[name][1](self.evidence)

    def windowed(self, subject: str, name: str, s: int) -> Any:
        """Return the value of a quantity at s samples."""
        return WITH_A_WINDOW[name][1](self.evidence, s)

    def of_matrix(self, node: Node, bound: Bound) -> Any:
        """Raise Undefined: no question is about a matrix."""
        raise Undefined(f"got {node.text}, of which no question of the corpus tells anything")


@cache
def readings() -> dict[str, Claim]:
    """Return the claims of the file, by their names."""
    text = resources.files("faultspace").joinpath("examples", FILE).read_text("utf-8")  # data of the front door, as for known_bounds
    return {one.id: one for one in read_claims(text)}


def asked_by(claim: Claim) -> Questions:
    """Return the questions whose answers tell all that a claim reads. Raises KeyError for what none tells."""
    names = {name for _, name in reads(*claim.nodes)}
    tables = [(ANSWERS | WITH_A_WINDOW)[name][0] for name in sorted(names)]
    wanted = {question for table in tables for question in table}
    return tuple(question for question in ask.QUESTIONS if question in wanted)


def decide_reading(bench: Workbench, name: str) -> Outcome:
    """Return what becomes of the reading with this name: CERTIFIED, or REFUTED by the smallest system of its box, or of the corpus."""
    claim = readings()[name]
    *hypotheses, conclusion = claim.nodes
    found = certify(
        bench,
        asked_by(claim),
        lambda e: all(evaluate(one, Certified(e)) for one in hypotheses),
        lambda e: bool(evaluate(conclusion, Certified(e))),
        lambda system: shown(claim, system),
    )
    if found.verdict != Verdict.REFUTED:
        return found
    box = claim.boxes["Q"]
    failing = search(box, [Question(tuple(hypotheses), conclusion)], most=MOST, jobs=1, progress=silent).found[0].failing
    if failing is None:
        return found
    smallest = certified(claim, failing, smallest=True)
    if smallest.computed:
        return Outcome(Verdict.ERROR, f"{failing} fails, and no certificate bears its {smallest.computed[0]}")
    return counterexample(str(failing), box, smallest.certificates)


def shown(claim: Claim, system: ResidualSystem) -> Iterator[Certificate]:
    """Yield certificates of everything that the claim names, about one system that shows it; of windows those of n + 1 samples."""
    subject, seen = Subject(system), set[str]()
    for _, name in sorted(reads(*claim.nodes)):
        quantity = quantities()[name]
        if quantity.certificates is None:
            continue
        for one in quantity.certificates(subject, system.n + 1) if quantity.windowed else quantity.certificates(subject):
            if (digest := sha256(one)) not in seen:
                seen.add(digest)
                yield one
