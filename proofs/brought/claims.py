"""A claim as it is brought: what it says, under which hypotheses, over which fields and in which box its counterexample is sought.

Claim          a claim that has been read
Hypothesis     one of its hypotheses, with the label that it is shown by
Answered       the verdicts: REFUTED, NOT REFUTED, VACUOUS, PROVED
make_claim     a Claim from the keys of a file, each checked; KEYS are these
field_name     how a field is written: Q, GF(2)
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from enum import StrEnum
from fractions import Fraction
from typing import Any

from flint import fmpz

from ...base.errors import InvalidInput, shorten
from ..language.grammar import read
from ..language.nodes import Node, reads, walk
from ..language.vocabularies import ABOUT_A_SYSTEM, CHOICE, ONE_A_AND_C, PAIR, RECORD, SYSTEM, VOCABULARIES, Vocabulary
from ..quantities.registry import Kind, quantities
from .boxes import Box
from .choice_boxes import ChoiceBox
from .pair_boxes import PairBox
from .record_boxes import RecordBox

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
LARGEST_SIZE, LARGEST_TOTAL, LARGEST_PRIME, MOST_ENTRIES = 8, 16, 97, 32
LONGEST_TEXT, MOST_HYPOTHESES, MOST_FIELDS = 2000, 16, 8


class Answered(StrEnum):
    """What is answered to a claim that is brought."""

    REFUTED = "REFUTED"
    NOT_REFUTED = "NOT REFUTED"
    VACUOUS = "VACUOUS"
    PROVED = "PROVED"


@dataclass(frozen=True)
class Hypothesis:
    """A condition, and the words it is shown by."""

    that: Node
    label: str


@dataclass(frozen=True)
class Claim:
    """This is a claim that has been read. `boxes` has a box for each field, in order; `expected` the verdict expected over some of them."""

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


def field_name(prime: int | None) -> str:
    """Return the name of the field."""
    return "Q" if prime is None else f"GF({prime})"


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
    about = _about(given.get("about", SYSTEM))
    hypotheses = tuple(_hypotheses(given.get("hypotheses", []), VOCABULARIES[about]))
    conclusion = expression(given["conclusion"], "conclusion", vocabulary=VOCABULARIES[about])
    primes = _fields(given.get("fields", ["Q"]))
    box = given.get("box", {})
    if not isinstance(box, Mapping):
        raise InvalidInput(f"box: got {shorten(box)}, expected a table such as {{n = [1, 3], total = 5}}")
    boxes = {field_name(prime): make_box(box, prime, about) for prime in primes}
    nodes = (*(one.that for one in hypotheses), conclusion)
    if any(prime is not None for prime in primes):
        _refuse_the_circle(nodes)
    expected = _expected(given["expected"], tuple(boxes)) if "expected" in given else {}
    return Claim(id, _text(given, "statement"), _text(given, "source"), about, hypotheses, conclusion, boxes, expected)


def expression(given: object, where: str, kind: Kind = Kind.WORD, vocabulary: Vocabulary = ABOUT_A_SYSTEM) -> Node:
    """Return the expression of a text, or what a Python predicate makes one. Raises InvalidInput that begins with `where`."""
    if callable(given):
        name = getattr(given, "__name__", "a predicate")
        return Node("python", kind, (), given, "a predicate of Python" if name == "<lambda>" else name, 1)
    if not isinstance(given, str):
        raise InvalidInput(f"{where}: got {shorten(given)}, expected an expression as a string")
    try:
        return read(given, kind, vocabulary)
    except InvalidInput as error:
        raise InvalidInput(f"{where}: {error}") from None


def make_box(given: Mapping[str, Any], prime: int | None, about: str = SYSTEM) -> Box:
    """Return the box with these bounds over Q or GF(prime). Raises InvalidInput that begins with `box`."""
    plain = USUAL[about]
    own = OWN_KEYS.get(about, ())
    known = (*BOX_KEYS, *own)
    for key in given:
        if key not in known:
            raise InvalidInput(f"box.{key}: got an unknown key; {nearest(str(key), known)}")
    ranges = {name: _range(given[name], name) if name in given else getattr(plain, name) for name in ("n", "m", "p", *own)}
    total = given.get("total", plain.total)
    if type(total) is not int or not 0 <= total <= LARGEST_TOTAL:
        raise InvalidInput(f"box.total: got {shorten(total)}, expected an integer from 0 to {LARGEST_TOTAL}")
    entries = _entries(given["entries"], prime) if "entries" in given else _usual(prime)
    box = replace(plain, **ranges, total=total, entries=entries, prime=prime)
    if not box.sizes():
        least = sum(ranges[name][0] for name in ("n", "m", "p"))
        raise InvalidInput(f"box: got an empty box, n + m + p is at least {least} and at most total = {total}")
    return box


def _about(about: object) -> str:
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


def _fields(given: object) -> list[int | None]:
    if not isinstance(given, (list, tuple)) or not 1 <= len(given) <= MOST_FIELDS or len(set(map(str, given))) < len(given):
        raise InvalidInput(f'fields: got {shorten(given)}, expected a list such as ["Q", "GF(2)"], none twice')
    return [_prime(one) for one in given]


def _prime(given: object) -> int | None:
    if given == "Q":
        return None
    found = re.fullmatch(r"GF\(([0-9]{1,9})\)", str(given))
    if found is None:
        raise InvalidInput(f"fields: got {shorten(given)}, expected Q or GF(q); number fields are not searched yet")
    prime = int(found[1])
    if prime > LARGEST_PRIME or not fmpz(prime).is_prime():
        raise InvalidInput(f"fields: got {given}, expected GF(q) with a prime q up to {LARGEST_PRIME}")
    return prime


def _range(given: object, name: str) -> tuple[int, int]:
    if isinstance(given, (list, tuple)) and len(given) == 2 and all(type(x) is int for x in given):
        low, high = given
        if 0 <= low <= high <= LARGEST_SIZE:
            return low, high
    raise InvalidInput(f"box.{name}: got {shorten(given)}, expected [first, last] with 0 <= first <= last <= {LARGEST_SIZE}")


def _usual(prime: int | None) -> tuple[Fraction, ...]:
    """Return -1, 0, 1, or all residues between -q/2 and q/2; over GF(2) these are 0 and 1."""
    if prime is None:
        return Box().entries
    return tuple(Fraction(x) for x in range(-((prime - 1) // 2), prime // 2 + 1))


def _entries(given: object, prime: int | None) -> tuple[Fraction, ...]:
    wanted = f'expected a list of at most {MOST_ENTRIES} integers or strings such as "-1/2"'
    if not isinstance(given, (list, tuple)) or not 1 <= len(given) <= MOST_ENTRIES:
        raise InvalidInput(f"box.entries: got {shorten(given)}, {wanted}")
    found = set()
    for x in given:
        rational = isinstance(x, str) and re.fullmatch(r"-?[0-9]{1,6}(/[1-9][0-9]{0,5})?", x)
        if not rational and (type(x) is not int or abs(x) >= 10**6):
            raise InvalidInput(f"box.entries: got {shorten(x)}, {wanted}")
        value = Fraction(x)
        if prime is not None:
            if value.denominator % prime == 0:
                raise InvalidInput(f"box.entries: got {x} over GF({prime}), expected denominators that {prime} does not divide")
            residue = value.numerator * pow(value.denominator, -1, prime) % prime
            value = Fraction(residue - prime if residue > prime // 2 else residue)
        found.add(value)
    return tuple(sorted(found))


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


def _refuse_the_circle(nodes: tuple[Node, ...]) -> None:
    for _, name in sorted(reads(*nodes)):
        if name in quantities() and quantities()[name].only_over_Q:
            raise InvalidInput(f"fields: got a claim that reads {name} and a finite field, which has no unit circle; expected Q alone")
    for node in nodes:
        if any(one.op == "schur_stable" for one in walk(node)):
            raise InvalidInput("fields: got a claim that reads schur_stable and a finite field, which has no unit circle; expected Q alone")


def _text(given: Mapping[str, Any], key: str) -> str:
    found = given.get(key, "")
    if not isinstance(found, str) or len(found) > LONGEST_TEXT:
        raise InvalidInput(f"{key}: got {shorten(found)}, expected a text of at most {LONGEST_TEXT} characters")
    return " ".join(found.split())
