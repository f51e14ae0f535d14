"""Rocq itself refuses, for each headline, a theorem that says less or something else as a proof of the statement that is locked.

    with_hypothesis    the headline with one hypothesis more: its name, its binders and what it then states
    copies             a file in which Rocq proves the headline with one hypothesis more, by the headline, and refuses it, and the changed
                       copy of the headline, as proofs of what is locked
    tried              has Rocq compile that file

What is locked is asked as `faultspace verify` asks it (`question` of rocq/theorems.py): the proposition, and `exact` with the theorem. That
one word more or less is refused by nothing but a comparison of types is seen from this: both copies are theorems or hypotheses that Rocq
has accepted as such a line before, no time is limited, and the headline itself is accepted at the same place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import pytest

from faultspace.proofs.rocq.build import BrokenTheory, compile_file
from faultspace.proofs.rocq.locks import kept
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.statements import read
from faultspace.proofs.rocq.theorems import MARK, parted, proposition
from tests.proofs.test_rocq_headlines import CHANGES

STATEMENTS, LOCKED = read(sources()), kept().theorems
NAMES = [name for file in sorted({lock.file for lock in LOCKED.values()}) for name, lock in LOCKED.items() if lock.file == file]
ONE_IN = 16


def with_hypothesis(name: str) -> str:
    """Return the statement with one hypothesis more: that S is observable, that n is not 0, or a trivial one, by what it speaks of."""
    binders, stated = parted(_locked(name))
    one = re.search(r"\(S : system K n m p\)|\bn\b(?=[^:]*: nat\b)", binders)
    more = "(0 < 1)%N" if one is None else "(0 < n)%N" if one[0] == "n" else "observable S"
    return f"{binders} : {more} -> ({stated})"


def _locked(name: str) -> str:
    return LOCKED[name].statement.removeprefix(f"Theorem {name}").removesuffix(".").strip()


def copies(names: Iterable[str]) -> str:
    """Return the file. Each of our files is a module, since what it opens with is for its own headlines."""
    wanted = sorted(names, key=NAMES.index)
    lines = ["From mathcomp Require Import all_ssreflect all_algebra.", "From faultspace Require Headlines."]
    for file in dict.fromkeys(LOCKED[name].file for name in wanted):
        lines += [f"Module In{file.removesuffix('.v')}.", STATEMENTS.openings[file]]
        for name in (one for one in wanted if LOCKED[one].file == file):
            locked, changed = proposition(_locked(name)), proposition(_locked(name).replace(*CHANGES[name]))
            lines += [
                f'Goal True. idtac "{MARK}{name}". Abort.',
                f"Theorem more_{name} {with_hypothesis(name)}.\nProof. move=> _; exact: Headlines.{name}. Qed.",
                f"Goal {locked}.\nProof. Fail exact (@more_{name}). exact (@Headlines.{name}). Qed.",
                f"Goal ({changed}) ->\n  {locked}.\nProof. intro changed. Fail exact changed. Abort.",
            ]
        lines += [f"End In{file.removesuffix('.v')}."]
    return "\n".join(lines) + "\n"


def tried(theory: Path, names: list[str]) -> None:
    """Has Rocq prove and refuse the copies; raises BrokenTheory where it does otherwise."""
    wanted = sorted(names, key=NAMES.index)
    assert compile_file(theory, "Copies.v", copies(names)).split("\n") == [*(f"{MARK}{name}" for name in wanted), ""]


@pytest.mark.programs
@pytest.mark.mutants
@pytest.mark.timeout(900)
def test_rocq_refuses_copies_of_a_few_headlines(theory: Path) -> None:
    first_of_each_file = {LOCKED[name].file: name for name in reversed(NAMES)}
    tried(theory, sorted({*NAMES[::ONE_IN], *first_of_each_file.values()}))


@pytest.mark.slow
def test_rocq_refuses_the_copies_of_every_headline(theory: Path) -> None:
    assert set(NAMES) == set(STATEMENTS.headlines) == set(CHANGES)
    tried(theory, NAMES)


@pytest.mark.slow
def test_a_copy_that_says_the_same_is_noticed(theory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A change that is none, and a hypothesis that is none: Rocq accepts what it should have refused, and the file does not compile."""
    name = "proposition_3"
    with monkeypatch.context() as patched:
        patched.setitem(CHANGES, name, ("(n <= s)%N", "((n <= s)%N)"))
        with pytest.raises(BrokenTheory, match="has not failed"):
            tried(theory, [name])
    monkeypatch.setattr("tests.proofs.test_rocq_refusals.with_hypothesis", lambda name: " : ".join(parted(_locked(name))))
    with pytest.raises(BrokenTheory, match="does not compile"):
        tried(theory, [name])
