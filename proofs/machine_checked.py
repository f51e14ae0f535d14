"""What Rocq's kernel says of the general theorems that the ledger names: each is there, for all systems, and rests on no axiom.

    Theorems       what was checked: Rocq's version, each theorem's statement as Rocq prints it
    check          compiles the theory (or takes it from the cache) and asks for each name's statement and assumptions

The theorems are in rocq/Headlines.v, the words they speak of in rocq/Vocabulary.v. NotProved of `rocq_build` is raised where a name
is not there, or rests on an axiom or on an admitted proof; NoRocq and BrokenTheory go through.
"""

from __future__ import annotations

import hashlib
import re
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from .rocq_build import CLOSED, BrokenTheory, NoRocq, NotProved, Progress, compile_file, compiled_theory, found

MARK = "== "
ALL = "all together"


@dataclass(frozen=True)
class Theorems:
    """`statements`: theorem -> its statement in Rocq's words. All closed under the global context."""

    version: str
    statements: Mapping[str, str]


def check(names: Iterable[str], progress: Progress = lambda name, done, total: None) -> Theorems:
    """The statements of these theorems of Headlines.v. Raises NoRocq, BrokenTheory, NotProved."""
    wanted = sorted(set(names))
    theory = compiled_theory(progress)
    compiler = found()
    if compiler is None:
        raise NoRocq("coqc is gone")
    return Theorems(compiler.version, answers(wanted, _said(theory, question(wanted), progress)))


def _said(theory: Path, asked: str, progress: Progress) -> str:
    """What Rocq prints, kept beside the compiled theory: the same question to the same files has the same answer."""
    kept = theory.with_suffix(f".{hashlib.sha256(asked.encode()).hexdigest()[:12]}.txt")
    if kept.is_file():
        return kept.read_text("utf-8")
    progress("Rocq: what the theorems rest on", 0, 1)
    try:
        said = compile_file(theory, "Asked.v", asked)
    except BrokenTheory as error:
        missing = re.search(r"The reference (\S+) was not found", str(error))
        if missing is None:
            raise
        raise NotProved(f"the ledger names the theorem {missing[1]}, which rocq/Headlines.v does not have") from None
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=theory.parent, delete=False) as scratch:
        scratch.write(said)
    Path(scratch.name).replace(kept)
    return said


def question(names: Iterable[str]) -> str:
    """A file that makes Rocq print, for each name, a mark and the statement, and then what all of them together rest on: to look for the
    assumptions of each would take a second or two for every one of them.
    """
    wanted = list(names)
    lines = ["From mathcomp Require Import all_ssreflect all_algebra.", "From faultspace Require Import Vocabulary Headlines."]
    for name in wanted:
        lines += [f'Goal True. idtac "{MARK}{name}". Abort.', f"Check Headlines.{name}."]
    # Each is a proof of a proposition, not a definition of the same name.
    together = ", ".join(f"(fun (P : Prop) (_ : P) => I) _ (@Headlines.{name})" for name in wanted)
    lines += [f'Goal True. idtac "{MARK}{ALL}". Abort.', f"Definition every_one := ({together}, I).", "Print Assumptions every_one."]
    return "\n".join(lines) + "\n"


def answers(names: Iterable[str], said: str) -> dict[str, str]:
    """name -> statement. Raises NotProved unless every name is there and all together rest on nothing."""
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
