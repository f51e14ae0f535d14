"""A claim as it is brought: what it says, under which hypotheses, over which fields and in which box its counterexample is sought.

Claim          a claim that has been read
Hypothesis     one of its hypotheses, with the label that it is shown by
Answered       the verdicts: REFUTED, NOT REFUTED, VACUOUS, PROVED
make_claim     a Claim from the keys of a file, each checked; KEYS are these
about_what     what a claim is about, checked
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from enum import StrEnum
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...exact.algebra.embeddings import one_modulus
from ...exact.algebra.fields import QQ, Field, NumberField, PrimeField
from ..boxes.box import Box
from ..boxes.choice_box import ChoiceBox
from ..boxes.pair_box import PairBox
from ..boxes.record_box import RecordBox
from ..language.grammar import read
from ..language.nodes import Node, reads, walk
from ..language.vocabularies import ABOUT_A_SYSTEM, CHOICE, ONE_A_AND_C, PAIR, RECORD, SYSTEM, VOCABULARIES, Vocabulary
from ..quantities.registry import Kind, quantities
from .fields import read_entries, read_field, usual_entries

KEYS = ("statement", "source", "about", "hypotheses", "conclusion", "fields", "box", "expected")
BOX_KEYS = ("n", "m", "p", "total", "entries")
OWN_KEYS: dict[str, tuple[str, ...]] = {CHOICE: ("k",), RECORD: ("nu", "N")}
_TWO = PairBox(n=(1, 2), m=(1, 2), p=(1, 2), total=4)
USUAL: dict[str, Box] = {
    SYSTEM: Box(),
    PAIR: _TWO,
    ONE_A_AND_C: replace(_TWO, one_A_and_C=True),
    CHOICE: ChoiceBox(n=(1, 2), total=4),
    RECORD: RecordBox(n=(1, 2), m=(0, 0), p=(1, 1), total=3),
}  # the boxes where none is stated
_ONE = PairBox(n=(1, 1), m=(1, 1), p=(1, 1), total=3)
USUAL_OVER_QA: dict[str, Box] = {
    SYSTEM: Box(total=4),
    PAIR: _ONE,
    ONE_A_AND_C: replace(_ONE, one_A_and_C=True),
    CHOICE: ChoiceBox(n=(1, 1), m=(1, 1), p=(1, 2), total=3, k=(1, 1)),
    RECORD: RecordBox(n=(1, 1), m=(0, 0), p=(1, 1), total=2, N=(1, 3)),
}  # the same over number fields, where there are five entries
LARGEST_SIZE, LARGEST_TOTAL = 8, 16
LONGEST_TEXT, MOST_HYPOTHESES, MOST_FIELDS = 2000, 16, 8


class Answered(StrEnum):
    """What is answered to a claim that is brought."""

    REFUTED = "REFUTED"
    NOT_REFUTED = "NOT REFUTED"
    VACUOUS = "VACUOUS"
    PROVED = "PROVED"


@dataclass(frozen=True)
class Hypothesis:
    """A condition, and what it is called by whoever brings it."""

    that: Node
    label: str

    @property
    def words(self) -> str:
        """What was decided, whatever it is called."""
        return self.label if self.label == self.that.text else f"{self.label}: {self.that.text}"


@dataclass(frozen=True)
class Claim:
    """A claim that has been read. `boxes` has a box for each field, in order; `expected` the verdict expected over some of them."""

    id: str
    statement: str
    source: str
    about: str
    hypotheses: tuple[Hypothesis, ...]
    conclusion: Node
    boxes: Mapping[str, Box]
    expected: Mapping[str, Answered]

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The hypotheses, then the conclusion."""
        return (*(one.that for one in self.hypotheses), self.conclusion)


def nearest(name: str, known: tuple[str, ...]) -> str:
    """Return words that name the nearest one, or all of them."""
    near = get_close_matches(name, known, 1, 0.5)
    return f"the nearest is {near[0]}" if near else f"expected one of {', '.join(known)}"


def make_claim(id: str, given: Mapping[str, Any]) -> Claim:
    """Return the claim. Raises InvalidInput that begins with the key where something is wrong."""
    for key in given:
        if key not in KEYS:
            raise InvalidInput(f"{key}: got an unknown key; {nearest(str(key), KEYS)}")
    if "conclusion" not in given:
        raise InvalidInput("conclusion: got none, expected an expression")
    about = about_what(given.get("about", SYSTEM))
    hypotheses = tuple(_hypotheses(given.get("hypotheses", []), VOCABULARIES[about]))
    conclusion = expression(given["conclusion"], "conclusion", vocabulary=VOCABULARIES[about])
    fields = _fields(given.get("fields", ["Q"]))
    box = given.get("box", {})
    if not isinstance(box, Mapping):
        raise InvalidInput(f"box: got {shorten(box)}, expected a table such as {{n = [1, 3], total = 5}}")
    boxes = {str(field): make_box(box, field, about) for field in fields}
    nodes = (*(one.that for one in hypotheses), conclusion)
    for field in fields:
        _check_the_circle(nodes, field)
    expected = _expected(given["expected"], tuple(boxes)) if "expected" in given else {}
    return Claim(id, _text(given, "statement"), _text(given, "source"), about, hypotheses, conclusion, boxes, expected)


def expression(given: object, where: str, kind: Kind = Kind.WORD, vocabulary: Vocabulary = ABOUT_A_SYSTEM) -> Node:
    """Return the expression of a text, or what a Python predicate makes one. Raises InvalidInput that begins with `where`."""
    if callable(given):
        name = getattr(given, "__name__", "a predicate")
        return Node("python", kind, (), given, "a predicate of Python" if name == "<lambda>" else f"{name}, a predicate of Python", 1)
    if not isinstance(given, str):
        raise InvalidInput(f"{where}: got {shorten(given)}, expected an expression as a string")
    try:
        return read(given, kind, vocabulary)
    except InvalidInput as error:
        raise InvalidInput(f"{where}: {error}") from None


def make_box(given: Mapping[str, Any], field: Field = QQ, about: str = SYSTEM) -> Box:
    """Return the box with these bounds over a field. Raises InvalidInput that begins with `box`."""
    over = field if isinstance(field, NumberField) else None
    plain = USUAL[about] if over is None else USUAL_OVER_QA[about]
    own = OWN_KEYS.get(about, ())
    known = (*BOX_KEYS, *own)
    for key in given:
        if key not in known:
            raise InvalidInput(f"box.{key}: got an unknown key; {nearest(str(key), known)}")
    ranges = {name: _range(given[name], name) if name in given else getattr(plain, name) for name in ("n", "m", "p", *own)}
    total = given.get("total", plain.total)
    if type(total) is not int or not 0 <= total <= LARGEST_TOTAL:
        raise InvalidInput(f"box.total: got {shorten(total)}, expected an integer from 0 to {LARGEST_TOTAL}")
    entries = read_entries(given["entries"], field) if "entries" in given else usual_entries(field)
    prime = field.p if isinstance(field, PrimeField) else None
    box = replace(plain, **ranges, total=total, entries=entries, prime=prime, number_field=over)
    if not box.sizes():
        least = sum(ranges[name][0] for name in ("n", "m", "p"))
        raise InvalidInput(f"box: got an empty box, n + m + p is at least {least} and at most total = {total}")
    return box


def about_what(about: object) -> str:
    """Return what a claim is about. Raises InvalidInput, which names the nearest, where it is nothing that a claim can be about."""
    if isinstance(about, str) and about in USUAL:
        return about
    known = tuple(USUAL)
    raise InvalidInput(f"about: got {shorten(about)}; {nearest(about, known) if isinstance(about, str) else f'expected one of {known}'}")


def _hypotheses(given: object, vocabulary: Vocabulary) -> list[Hypothesis]:
    if not isinstance(given, (list, tuple)) or len(given) > MOST_HYPOTHESES:
        raise InvalidInput(f"hypotheses: got {shorten(given)}, expected a list of at most {MOST_HYPOTHESES} expressions")
    found = []
    for k, one in enumerate(given):
        where = f"hypotheses[{k}]"
        if not isinstance(one, Mapping):
            that = expression(one, where, vocabulary=vocabulary)
            found.append(Hypothesis(that, that.text))
            continue
        if not set(one) <= {"that", "label"} or "that" not in one or not isinstance(one.get("label", ""), str):
            raise InvalidInput(f'{where}: got {shorten(dict(one))}, expected {{that = "...", label = "..."}}')
        that = expression(one["that"], where, vocabulary=vocabulary)
        found.append(Hypothesis(that, one.get("label") or that.text))
    return found


def _fields(given: object) -> list[Field]:
    if not isinstance(given, (list, tuple)) or not 1 <= len(given) <= MOST_FIELDS or len(set(map(str, given))) < len(given):
        raise InvalidInput(f'fields: got {shorten(given)}, expected a list such as ["Q", "GF(2)"], none twice')
    return [read_field(one) for one in given]


def _range(given: object, name: str) -> tuple[int, int]:
    if isinstance(given, (list, tuple)) and len(given) == 2 and all(type(x) is int for x in given):
        low, high = given
        if 0 <= low <= high <= LARGEST_SIZE:
            return low, high
    raise InvalidInput(f"box.{name}: got {shorten(given)}, expected [first, last] with 0 <= first <= last <= {LARGEST_SIZE}")


def _expected(given: object, fields: tuple[str, ...]) -> dict[str, Answered]:
    known = tuple(Answered)
    if isinstance(given, Mapping):
        for name in given:
            if name not in fields:
                raise InvalidInput(f"expected.{name}: got a field that the claim does not list; {nearest(str(name), fields)}")
        told = dict(given)
    else:
        told = dict.fromkeys(fields, given)
    for name, verdict in told.items():
        if verdict not in known:  # IDENTITY is an answer of the ledger's readings with letters for entries, which the language cannot say
            raise InvalidInput(f"expected: got {shorten(verdict)}, expected one of {', '.join(known)}")
        told[name] = Answered(verdict)
    return told


def _check_the_circle(nodes: tuple[Node, ...], field: Field) -> None:
    """Raise InvalidInput where the claim asks what lies inside the unit circle, and that has no one answer over the field."""
    if one_modulus(field):
        return
    read_ones = [name for _, name in sorted(reads(*nodes)) if name in quantities() and quantities()[name].circle]
    read_ones += ["schur_stable" for node in nodes if any(one.op == "schur_stable" for one in walk(node))]
    if read_ones:
        why = "a finite field, which has no unit circle; expected Q, or Q(a) with a root"
        if isinstance(field, NumberField):
            why = f"{field}, no root of which is chosen; expected a real one, as in Q(a) with a^2 - 2 = 0 and 1 < a < 2"
        raise InvalidInput(f"fields: got a claim that reads {read_ones[0]} and {why}")


def _text(given: Mapping[str, Any], key: str) -> str:
    found = given.get(key, "")
    if not isinstance(found, str) or len(found) > LONGEST_TEXT:
        raise InvalidInput(f"{key}: got {shorten(found)}, expected a text of at most {LONGEST_TEXT} characters")
    return " ".join(found.split())
