"""What Rocq's kernel says of the theorems that the ledger names: each is there, says what it is locked to say, rests on no axiom.

    Theorems       what was checked: Rocq's version, each theorem's statement as Rocq prints it, and its lock
    check          compares the sources with the locks, compiles the theory (or takes it from the cache) and asks Rocq for each name

The theorems are in theory/headlines, the words that they speak of in theory/vocabulary. NotProved of `rocq_build` is raised where a
statement is not the one that is locked, a name is not there, or rests on an axiom or on an admitted proof; NoRocq and BrokenTheory go
through, and Poisoned where the compiled files in the cache do not say what the sources say.

What is asked of Rocq does not lean on the compiled statements: each theorem is stated again from our sources and proved by the compiled
one, over vocabularies that are compiled again and must be the same bytes. The answer is kept, with the digests of the files it is about.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ...base.progress import Progress, silent
from ...base.writing import write_text
from .build import CLOSED, DIGESTS, INSTALL, BrokenTheory, NoRocq, NotProved, Poisoned, compile_file, compiled_again, compiled_theory, found
from .locks import held
from .sources import sources
from .statements import VOCABULARY, Headline, read

MARK = "== "
ALL = "all together"


@dataclass(frozen=True)
class Theorems:
    """Theorems of the theory. `statements`: theorem -> its statement in Rocq's words; all closed under the global context.
    `locks`: theorem -> its SHA-256.
    """

    version: str
    statements: Mapping[str, str]
    locks: Mapping[str, str] = field(default_factory=dict)


def check(names: Iterable[str], progress: Progress = silent) -> Theorems:
    """Return the statements of these headlines. Raises NotProved, NoRocq, BrokenTheory, Poisoned."""
    wanted, texts = sorted(set(names)), sources()
    locks = held(texts)
    statements = asked(wanted, texts, compiled_theory(progress, texts=texts), progress)  # of what was judged, whatever lies there now
    compiler = found()
    if compiler is None:
        raise NoRocq(f"coqc is no longer on the path; {INSTALL}")
    return Theorems(compiler.version, statements, {name: locks.theorems[name].sha256 for name in wanted})


def asked(wanted: list[str], texts: Mapping[str, str], theory: Path, progress: Progress = silent) -> dict[str, str]:
    """Return name -> statement, as Rocq prints it with the compiled theory of these sources. Raises NotProved, BrokenTheory, Poisoned."""
    statements = read(texts)
    missing = [name for name in wanted if name not in statements.headlines]
    if missing:
        raise NotProved(f"the ledger names the theorem {missing[0]}, which is in no file theory/headlines/Headlines*.v")
    lines = question([statements.headlines[name] for name in wanted], statements.openings)
    return answers(wanted, _answer(theory, texts, lines, progress))


def _answer(theory: Path, texts: Mapping[str, str], lines: list[str], progress: Progress) -> str:
    """Return what Rocq prints. It is kept beside the compiled theory: the same question to the same files has the same answer."""
    text = "\n".join(lines) + "\n"
    about = {"asked": _sha256(text.encode()), "files": _sha256((theory / DIGESTS).read_bytes())}
    place = theory.with_suffix(f".{about['asked'][:12]}.json")
    try:
        kept = json.loads(place.read_text("utf-8"))
        if {key: kept[key] for key in about} == about:
            return str(kept["said"])
    except (OSError, ValueError, KeyError, TypeError):
        pass
    progress("Rocq: asking what the theorems rest on", 0, 1)
    _same_vocabulary(theory, texts)
    try:
        said = compile_file(theory, "Asked.v", text)
    except BrokenTheory as error:
        raise Poisoned(_unlike(str(error), lines)) from None
    write_text(place, json.dumps({**about, "said": said}))
    return said


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _same_vocabulary(theory: Path, texts: Mapping[str, str]) -> None:
    """Raise Poisoned where a compiled vocabulary is not what coqc makes of its source now."""
    for name, made in compiled_again({name: text for name, text in texts.items() if VOCABULARY.fullmatch(name)}).items():
        if made != (theory / name).with_suffix(".vo").read_bytes():
            raise Poisoned(
                f"the compiled theory in {theory} is not believed: its {name} was not compiled from ours; "
                "faultspace verify --recheck removes it and compiles anew"
            )


def _unlike(error: str, lines: list[str]) -> str:
    """Say what a question that Rocq does not accept tells of the compiled theory."""
    place = re.search(r"line (\d+)", error)
    stated = lines[int(place[1]) - 1 if place else -1]
    of = re.search(r"@Headlines\.(\w+)", stated)
    which = f"the compiled theorem {of[1]} does not say what our source says" if of else "it does not have what our sources have"
    return f"the compiled theory is not believed: {which} ({error[-200:]}); faultspace verify --recheck removes it and compiles anew"


def question(about: list[Headline], openings: Mapping[str, str]) -> list[str]:
    """The lines of a file in which Rocq proves each statement, as our source has it, by the compiled theorem, prints it, and then prints
    what all of them together rest on: to look for the assumptions of each would take a second or two for every one of them.
    """
    lines = ["From mathcomp Require Import all_ssreflect all_algebra.", "From faultspace Require Headlines."]
    for file in sorted({headline.file for headline in about}):
        lines += [f"Module In{file.removesuffix('.v')}.", openings[file]]
        for headline in about:
            if headline.file == file:
                lines += [f'Goal True. idtac "{MARK}{headline.name}". Abort.']
                lines += [f"Goal {proposition(headline.statement)}. Proof. exact (@Headlines.{headline.name}). Qed."]
                lines += [f"Check Headlines.{headline.name}."]
        lines += [f"End In{file.removesuffix('.v')}."]
    # Each is a proof of a proposition, not a definition of the same name.
    together = ", ".join(f"(fun (P : Prop) (_ : P) => I) _ (@Headlines.{headline.name})" for headline in about)
    lines += [f'Goal True. idtac "{MARK}{ALL}". Abort.', f"Definition every_one := ({together}, I).", "Print Assumptions every_one."]
    return lines


def proposition(statement: str) -> str:
    """Returns, of binders and a proposition with a colon between, the proposition for all of these binders."""
    binders, stated = parted(statement)
    return f"forall {binders}, {stated}" if binders else stated


def parted(statement: str) -> tuple[str, str]:
    """Return the binders of a statement, and what it states."""
    depth = 0
    for k, sign in enumerate(statement):
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(sign, 0)
        if sign == ":" and depth == 0:
            return statement[:k].strip(), statement[k + 1 :].strip()
    raise NotProved(f"this is no statement: {statement[:80]}")


def answers(names: Iterable[str], said: str) -> dict[str, str]:
    """Return name -> statement. Raises NotProved unless every name is there and all together rest on nothing."""
    parts: dict[str, str] = {}
    _, *marked = re.split(rf"^{MARK}([\w ]+)$", said, flags=re.MULTILINE)
    for name, rest in zip(marked[::2], marked[1::2], strict=True):
        parts[name.strip()] = " ".join(rest.split())
    if parts.get(ALL) != CLOSED:
        raise NotProved(f"the theorems rest on more than the kernel: {parts.get(ALL, 'nothing was said')[-300:]}")
    for name in names:
        if not parts.get(name):
            raise NotProved(f"the theorem {name}: nothing was said of it")
    return {name: parts[name].partition(" : ")[2] for name in names}
