"""What is answered where bounds are sought, for people, programs and the checker.

Sharper        a bound that says more than another, with the smallest system that refutes it
Bound          a bound that nothing that was tried refutes, where it is attained, and the next sharper ones
Evidence       what was gone through
Conjectures    bounds on a quantity by others; what `fs.conjecture` returns
Sharpened      bounds in the place of a claim's
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ...base.sheets import Shown, counted, told
from ...exact.system.systems import ResidualSystem
from ..language.vocabularies import SYSTEM
from ..quantities.cases import Case
from ..trust.structure_certificates import Certificate, sha256
from .answers import Counterexample, Tried
from .drawn_cases import LARGEST_STATES


@dataclass(frozen=True)
class Sharper:
    """`counterexample` is None where nothing that was tried refutes `text` either, and it is attained no more often than the bound."""

    text: str
    counterexample: Counterexample | None

    @property
    def words(self) -> str:
        """This says what becomes of it."""
        found = self.counterexample
        if found is None:
            return f"{self.text}: not refuted either"
        return f"{self.text}: refuted by {found.case}" + ("" if found.smallest else " (not from the box)")

    def to_json(self) -> dict[str, Any]:
        """Return an entry of "sharper" in the JSON answer."""
        found = self.counterexample
        return {
            "bound": self.text,
            "smallest": None if found is None else found.to_json(),
            "certificates": [] if found is None else [sha256(one) for one in found.certificates],
        }


@dataclass(frozen=True)
class Bound:
    """`text` is an expression of the language. `systems` cases of the box attain it, of which `case` comes first; where none does, which
    only the claim's own bound allows, `case` lies outside the box. `known` names like statements, `nouns` are what one case is called, and
    several.

    `theorems` are those of Rocq that it follows from, none where it is not proved.

    The first of `sharper` has the next constant, and `case` refutes it; the others have one coefficient that is one less, or more.
    """

    text: str
    case: Case
    systems: int
    sharper: tuple[Sharper, ...]
    known: tuple[str, ...]
    nouns: tuple[str, str] = ("system", "systems")
    theorems: tuple[str, ...] = ()

    @property
    def standing(self) -> str:
        """This says how far it was tried, and what proves it."""
        tried = f"not refuted up to {LARGEST_STATES} states by what was tried"
        return f"{tried}; " + (f"it follows from {', '.join(self.theorems)}" if self.theorems else "no theorem")

    @property
    def first(self) -> ResidualSystem:
        """`case`, where the bound is about systems. Raises TypeError where it is about something else."""
        if not isinstance(self.case, ResidualSystem):
            raise TypeError(f"got a bound that is attained by a {self.nouns[0]}, expected one about systems; .case is {self.case}")
        return self.case

    @property
    def certificates(self) -> tuple[Certificate, ...]:
        """These bear what the counterexamples to the sharper bounds are."""
        return tuple(one for sharper in self.sharper if sharper.counterexample for one in sharper.counterexample.certificates)

    def sheet(self, name: str) -> Iterator[tuple[str, str]]:
        """These pairs say it, below its `name`."""
        yield name, self.text
        yield "  standing", self.standing
        inside = f"by {counted(self.systems, *self.nouns)} of the box, first by {self.case}"
        yield "  attained", inside if self.systems else f"by no {self.nouns[0]} of the box, but outside it by {self.case}"
        for k, one in enumerate(self.sharper):
            yield "" if k else "  sharper", one.words
        for k, said in enumerate(self.known):
            yield "" if k else "  known", said

    def to_json(self) -> dict[str, Any]:
        """Return an entry of "above" or "below" in the JSON answer."""
        return {
            "bound": self.text,
            "attained": {**_parts(self.case), "systems": self.systems},
            "sharper": [one.to_json() for one in self.sharper],
            "known": list(self.known),
            "theorems": list(self.theorems),
        }


@dataclass(frozen=True)
class Evidence(Tried):
    """Direct sums of two cases of the box and drawn cases were looked at, too; `rows` counts the different values that were met.
    `sparse` systems attacked the bounds, of which `sparse_met` meet the hypotheses; the rows have those alone that refuted one."""

    sums: int
    sums_met: int
    drawn: int
    drawn_met: int
    sparse: int
    sparse_met: int
    rows: int

    @property
    def words(self) -> str:
        """This says it in a sentence."""
        sums = f"{self.sums} direct sums of {self.of} of the box, {self.sums_met} meet them"
        drawn = f"{self.drawn} drawn {self.of} with up to 6 states, {self.drawn_met} meet them"
        sparse = f"; {self.sparse} sparse ones more against the bounds, {self.sparse_met} meet them" if self.sparse else ""
        return f"{super().words}; {sums}; {drawn}{sparse}; together {counted(self.rows, 'set')} of values"

    def to_json(self) -> dict[str, Any]:
        """Return "tried" in the JSON answer."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}


@dataclass(frozen=True, repr=False)
class Conjectures(Shown):
    """Bounds above and below on a quantity by others, which nothing that was tried refutes and some system attains.

    `above` and `below` list them, each with `text`, a bound in the language, `first`, the first system of the box that attains it,
    or `case`, the first pair, choice or record, `systems`, how many of the box do, `sharper`, the next sharper bounds with the smallest
    case that refutes each, `theorems`, those that it follows from, if any, and `known`,
    the like statements of the field and of the ledger; none is implied by the others. `equal` are sums
    that the target equals wherever it was looked at. `by` are the quantities of the bounds; `left_out` those that are infinite on a case,
    which is named. `about` is what claims say they are about; `tried` counts what was gone through. Source: [F75], [VD79] for the ranks
    that the quantities are found by. Raises nothing by itself.

    >>> import faultspace as fs
    >>> found = fs.conjecture("lag", by=["n"], box={"total": 3})
    >>> [one.text for one in found.above], str(found.above[0].first)
    (['lag <= n'], 'A=[[-1]], F=[[0]], C=[[-1]], G=[[0]]')
    """

    target: str
    about: str
    field: str
    hypotheses: tuple[str, ...]
    by: tuple[str, ...]
    left_out: Mapping[str, Case]
    above: tuple[Bound, ...]
    below: tuple[Bound, ...]
    equal: tuple[str, ...]
    grammar: Mapping[str, str]
    tried: Evidence
    seconds: float

    @property
    def title(self) -> str:
        """How many bounds there are, and on what."""
        over = "" if self.field == "Q" else f" over {self.field}"
        if not self.tried.rows:
            return f"{self.target}{over}: none of the {self.tried.of} that were tried meets the hypotheses"
        bounds = f"{counted(len(self.above), 'bound')} above and {len(self.below)} below"
        return f"{self.target}{over}: {bounds} that nothing that was tried refutes"

    @property
    def certificates(self) -> tuple[Certificate, ...]:
        """These bear the counterexamples, each accepted by the checker."""
        return tuple(one for bound in (*self.above, *self.below) for one in bound.certificates)

    def sheet(self) -> Iterator[tuple[str, str]]:
        """These pairs are all that was found out."""
        for k, text in enumerate(self.hypotheses):
            yield "" if k else "hypotheses", text
        for k, text in enumerate(self.equal):
            yield "" if k else "equal wherever it was tried", text
        for k, bound in enumerate(self.above):
            yield from bound.sheet(f"above {k + 1}")
        for k, bound in enumerate(self.below):
            yield from bound.sheet(f"below {k + 1}")
        yield "bounds above that were sought", self.grammar["above"]
        yield "bounds below that were sought", self.grammar["below"]
        yield "by", ", ".join(self.by)
        for name, case in self.left_out.items():
            yield f"left out: {name}", f"inf on {case}"
        yield "tried", self.tried.words
        yield "seconds", f"{self.seconds:.1f}"

    def to_json(self) -> dict[str, Any]:
        """Return what `faultspace conjecture --json` prints."""
        left_out = [{"name": name, **_parts(case)} for name, case in self.left_out.items()]
        asked = told(self, "target", "about", "field", "hypotheses", "by")
        return asked | {"left_out": left_out} | told(self, "above", "below", "equal", "grammar", "tried")


@dataclass(frozen=True, repr=False)
class Sharpened(Shown):
    """Bounds in the place of a claim's: `own` is the claim's with the least constant beside it that nothing that was tried refutes.

    `words` are the bounds on the same quantity by what the claim's other side names, `others` those by all quantities, or the usual ones
    of pairs, choices and records, none implied by the others of its list. `counterexample` refutes the claim itself, and is None where
    nothing does. `own` is None where no constant will do.
    """

    id: str
    about: str
    field: str
    conclusion: str
    hypotheses: tuple[str, ...]
    counterexample: Case | None
    own: Bound | None
    words: tuple[Bound, ...]
    others: tuple[Bound, ...]
    left_out: Mapping[str, Case]
    grammar: str
    tried: Evidence
    seconds: float

    @property
    def title(self) -> str:
        """The bound in the place of the claim's."""
        over = "" if self.field == "Q" else f" over {self.field}"
        if not self.tried.rows:
            return f"{self.id}{over}: none of the {self.tried.of} that were tried meets the hypotheses"
        if self.own is None:
            return f"{self.id}{over}: no constant beside it makes the claim a bound that is attained"
        return f"{self.id}{over}: {self.own.text} is not refuted, and attained"

    @property
    def certificates(self) -> tuple[Certificate, ...]:
        """These bear the counterexamples, each accepted by the checker."""
        listed = (*((self.own,) if self.own else ()), *self.words, *self.others)
        return tuple(one for bound in listed for one in bound.certificates)

    def sheet(self) -> Iterator[tuple[str, str]]:
        """These pairs are all that was found out."""
        yield "the claim", self.conclusion
        for k, text in enumerate(self.hypotheses):
            yield "" if k else "hypotheses", text
        if self.tried.rows:
            yield "it is", "not refuted" if self.counterexample is None else f"refuted by {self.counterexample}"
        if self.own is not None:
            yield from self.own.sheet("with the least constant")
        for k, bound in enumerate(self.words):
            yield from bound.sheet(f"in its words {k + 1}")
        for k, bound in enumerate(self.others):
            yield from bound.sheet(f"by {'all' if self.about == SYSTEM else 'the usual'} quantities {k + 1}")
        yield "bounds that were sought", self.grammar
        for name, case in self.left_out.items():
            yield f"left out: {name}", f"inf on {case}"
        yield "tried", self.tried.words
        yield "seconds", f"{self.seconds:.1f}"

    def to_json(self) -> dict[str, Any]:
        """Return an entry of "sharpened" in the JSON answer."""
        left_out = [{"name": name, **_parts(case)} for name, case in self.left_out.items()]
        found = told(self, "id", "about", "field", "conclusion", "hypotheses", "counterexample", "own", "words", "others")
        return found | {"left_out": left_out} | told(self, "grammar", "tried")


def _parts(case: Case) -> dict[str, Any]:
    """Return a system under that name, or what else the case is made of."""
    return {"system": case.to_json()} if isinstance(case, ResidualSystem) else case.to_json()
