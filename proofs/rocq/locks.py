"""The locks of the headlines: what each theorem says, down to every word of ours that it uses, so that no word changes unnoticed.

    Lock          one theorem: its statement, the words that it reaches, the SHA-256 of all of it
    Locks         the locks of all headlines, with the texts that they are made of
    made          the locks that a set of sources has
    kept          those of theory/locks.json, which were made when somebody last read the statements
    held          the locks of the sources; raises NotProved where they are not those kept, and says which word changed

A lock is computed from the text of our sources, without comments and line breaks, so it is the same for each version of Rocq. It is the
SHA-256 of the lines: what the file opens with, every sentence of every vocabulary that it imports, in order, what may change the reading
of a text from afar (canonical structures and notations of the whole theory), the statement. Words that the statement does not reach are in
it, too: a name that nobody uses can still stand for one of MathComp's. That a theorem says what a reading of the ledger says in words, or
what a statement in the language of claims says, is for readers to see, too, and so these are locked with the theorems, and with the
readings what makes of their verdicts that on the claim. After a change that is wanted,

    python -m faultspace.proofs.rocq.locks

writes the file anew and says what is different.
"""

from __future__ import annotations

import hashlib
import json
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from ...base.writing import write_text
from ..verdict.ledger import expected_without, load
from .build import NotProved
from .sentences import refusals, short
from .sources import THEORY, sources
from .statements import Headline, Statements, read

LOCKS = "locks.json"
COMMAND = "python -m faultspace.proofs.rocq.locks"
MOST_LISTED = 4
# The texts of readings, and what theorems say, in the language of claims: package, path, table.
# What is said of verdicts in sentences stands with them.
IN_THE_LANGUAGE = (
    ("faultspace", ("examples", "ledger.toml"), "claim"),
    ("faultspace.proofs.brought", ("theorems.toml",), "theorem"),
    ("faultspace.proofs.verdict", ("cards.toml",), "card"),
)


@dataclass(frozen=True)
class Lock:
    """A lock holds what one headline says. `words`: the keys of all words that it reaches; `sha256`: of the text that they make
    together."""

    file: str
    statement: str
    words: tuple[str, ...]
    sha256: str

    def to_json(self) -> dict[str, Any]:
        """Return the object of one theorem in the file."""
        return {"file": self.file, "sha256": self.sha256, "statement": self.statement, "words": list(self.words)}


@dataclass(frozen=True)
class Locks:
    """The locks hold `theorems` by name, and the texts that they are made of: `words` by key, `openings` by file, `far`. `vocabularies`:
    file -> the SHA-256 of all that it says, in its order. `readings`: "claim.reading" -> the SHA-256 of it as the ledger has it, and of the
    claim's words; likewise of all else that the ledger says, of its texts in the language of claims, and of what that says of theorems."""

    theorems: Mapping[str, Lock]
    words: Mapping[str, str]
    vocabularies: Mapping[str, str]
    openings: Mapping[str, str]
    readings: Mapping[str, str]
    far: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the object that the file holds."""
        return {
            "about": f"The statements of the Rocq theory as they were last read. {COMMAND} writes this file.",
            "theorems": {name: lock.to_json() for name, lock in self.theorems.items()},
            "words": dict(self.words),
            "vocabularies": dict(self.vocabularies),
            "openings": dict(self.openings),
            "readings": dict(self.readings),
            "far": list(self.far),
        }


def made(texts: Mapping[str, str]) -> Locks:
    """Return the locks of these sources, file name -> text. Raises NotProved where a file says what no source may, or breaks a rule."""
    if refused := refusals(texts):
        listed = "; ".join(f"{name} has {', '.join(found)}" for name, found in list(refused.items())[:MOST_LISTED])
        raise NotProved(f"the sources of the theory say what no source may: {listed}")
    statements = read(texts)
    theorems: dict[str, Lock] = {}
    for name in sorted(statements.headlines):
        headline = statements.headlines[name]
        reached = tuple(word.key for word in statements.reached(headline))
        theorems[name] = Lock(headline.file, _stated(headline), reached, _digest(headline, statements))
    words = {word.key: word.text for found in statements.words.values() for word in found.values()}
    return Locks(
        theorems,
        {key: words[key] for key in sorted(words)},
        {file: _sha256(found) for file, found in sorted(statements.vocabularies.items())},
        dict(sorted(statements.openings.items())),
        _readings(),
        statements.far,
    )


def _readings() -> dict[str, str]:
    """Return the digests of what stands in words or in the language of claims, and is read beside the theorems, by names."""
    said: list[tuple[str, list[Any]]] = []
    for claim in load():
        said.append((claim.id, [{**claim.to_json(), "readings": [reading.id for reading in claim.readings]}]))
        said += ((f"{claim.id}.{reading.id}", [claim.statement, reading.to_json()]) for reading in claim.readings)
    said += ((f"without {name}", [verdicts]) for name, verdicts in expected_without().items())
    for package, path, table in IN_THE_LANGUAGE:
        text = resources.files(package).joinpath(*path).read_text("utf-8")
        said += ((f"{path[-1]}: {name}", [one]) for name, one in tomllib.loads(text)[table].items())
    if twice := [name for name, count in Counter(name for name, _ in said).items() if count > 1]:
        raise NotProved(f"what is read beside the theorems has one name twice, and so no lock of its own: {short(ascii(twice[0]))}")
    texts = {name: [one if isinstance(one, str) else json.dumps(one, sort_keys=True) for one in several] for name, several in said}
    return {name: _sha256(several) for name, several in texts.items()}


def _stated(headline: Headline) -> str:
    return f"Theorem {headline.name}{headline.statement}."


def _digest(headline: Headline, statements: Statements) -> str:
    lines = [f"{headline.file} opens with: {statements.openings[headline.file]}"]
    lines += [f"{file}: {one}" for file in sorted(statements.imports[headline.file]) for one in statements.vocabularies[file]]
    lines += [f"from afar: {one}" for one in statements.far]
    return _sha256([*lines, _stated(headline)])


def _sha256(lines: Sequence[str]) -> str:
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def kept() -> Locks:
    """Return the locks in theory/locks.json. Raises NotProved where the file is not there or not what this module writes."""
    try:
        data = json.loads(THEORY.joinpath(LOCKS).read_text("utf-8"))
        theorems = {
            str(name): Lock(str(one["file"]), str(one["statement"]), tuple(one["words"]), str(one["sha256"]))
            for name, one in data["theorems"].items()
        }
        words, vocabularies, openings, readings = (dict(data[key]) for key in ("words", "vocabularies", "openings", "readings"))
        return Locks(theorems, words, vocabularies, openings, readings, tuple(data["far"]))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise NotProved(f"the locks of the statements, theory/{LOCKS}, cannot be read: {type(error).__name__}: {error}") from None


def held(texts: Mapping[str, str], against: Locks | None = None) -> Locks:
    """Return the locks of these sources. Raises NotProved where they are not those kept, or where a source assumes something."""
    now, before = made(texts), kept() if against is None else against
    found = list(differences(before, now))
    if found or before != now:
        more = f"; and {len(found) - MOST_LISTED} more" if len(found) > MOST_LISTED else ""
        listed = f"{'; '.join(found[:MOST_LISTED]) or f'{LOCKS} has more than they need, or in another order'}{more}"
        raise NotProved(f"the statements are not as locked: {listed}. If that is wanted, {COMMAND} locks them anew")
    return now


def differences(before: Locks, now: Locks) -> Iterator[str]:
    """Yield what is different, one sentence for each headline, word or opening that is."""
    for name in sorted({*before.theorems, *now.theorems}):
        old, new = before.theorems.get(name), now.theorems.get(name)
        if old is None:
            yield f"the headline {name} has no lock"
        elif new is None:
            yield f"the headline {name} is locked and is not there"
        elif old.statement != new.statement:
            yield f"the headline {name} {_changed(new.statement, old.statement)}"
    for key in sorted({*before.words, *now.words}):
        said, was = now.words.get(key), before.words.get(key)
        if said != was:
            of = sorted(name for locks in (before, now) for name, lock in locks.theorems.items() if key in lock.words)
            what = "is not locked" if was is None else "is locked and is not there" if said is None else _changed(said, was)
            yield f"the word {key} {what}, which {len({*of})} headlines use{', ' + of[0] + ' for one' if of else ''}"
    for file in sorted({*before.openings, *now.openings}):
        said, was = now.openings.get(file, ""), before.openings.get(file, "")
        if said != was:
            yield f"what {file} opens with {_changed(said, was)}"
    for name in sorted({*before.readings, *now.readings}):
        if before.readings.get(name) != now.readings.get(name):
            yield f"what stands under {name} in the ledger, or in the language of claims, is not what was read with the theorems"
    for one in sorted({*before.far} ^ {*now.far}):
        yield f"{one} may change how statements are read, and is {'not locked' if one in now.far else 'gone'}"
    same = before.words == now.words and before.openings == now.openings and {*before.far} == {*now.far}
    if same and before.vocabularies != now.vocabularies:
        for file, _ in sorted({*before.vocabularies.items()} ^ {*now.vocabularies.items()}):
            yield f"{file} says more than its words, or says them in another order"
    if same and before.vocabularies == now.vocabularies:
        for name in sorted({*before.theorems} & {*now.theorems}):
            old, new = before.theorems[name], now.theorems[name]
            if old != new and old.statement == new.statement:
                yield f"the lock of {name} is not the SHA-256 of its own text, or tells other words or another file"


def _changed(text: str, before: str) -> str:
    return f"says {_around(text, before)} where its lock has {_around(before, text)}"


def _around(text: str, other: str, width: int = 60) -> str:
    """Return the part of the text where it differs from the other, with some words before it."""
    first = next((k for k, (a, b) in enumerate(zip(text, other, strict=False)) if a != b), min(len(text), len(other)))
    start = max(0, text.rfind(" ", 0, max(0, first - 15)) + 1)
    return f"'{'...' if start else ''}{text[start : first + width]}{'...' if first + width < len(text) else ''}'"


def written(locks: Locks) -> str:
    """Return the text of theory/locks.json."""
    return json.dumps(locks.to_json(), indent=1, ensure_ascii=False) + "\n"


def main() -> int:
    """Locks the statements of the sources as they are now, and prints what is different."""
    try:
        now = made(sources())
    except NotProved as error:
        print(error, file=sys.stderr)
        return 1
    try:
        found = list(differences(kept(), now))
    except NotProved as error:
        found = [str(error)]
    write_text(Path(str(THEORY)) / LOCKS, written(now))
    for one in found or ["nothing is different"]:
        print(one)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
