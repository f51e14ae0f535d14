"""Instances: that all premises of a headline hold together of something is a statement made of the headline's, and Rocq proves that one."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from docs.tools.premises import instances, together
from faultspace.proofs.rocq.build import CLOSED, BrokenTheory, NotProved, compile_file
from faultspace.proofs.rocq.sources import beyond, sources
from faultspace.proofs.rocq.statements import Headline, read
from faultspace.proofs.rocq.theorems import proposition

TEXTS, BEYOND = sources(), beyond()
STATEMENTS = read(TEXTS)
stated = cache(lambda: instances(STATEMENTS, TEXTS))
REAL_CLOSED = "From mathcomp.real_closed Require Import realalg.\n"

MADE = [
    (" n : P n", ()),
    (
        " (K : fieldType) n m (S : T n) : P S -> (0 < n)%N -> Q S",
        ("(K : fieldType) : exists n (S : T n), P S /\\ (0 < n)%N", ": exists (K : fieldType) n (S : T n), P S /\\ (0 < n)%N"),
    ),
    (
        " (K : fieldType) n N (M : 'M[K]_N) (x : 'rV_n) : P M -> Q x -> R M",
        ("(K : fieldType) : exists n N (M : 'M[K]_N) (x : 'rV_n), P M /\\ Q x",),
    ),
    (" (K : rcfType) : P K -> exists x, Q x -> R x", ("(K : rcfType) : P K", ": exists (K : rcfType), P K")),
    (
        " n : P n -> exists k, let j := k in [/\\ Q n -> R k, S j -> T k & U k n -> V k]",
        (": exists n, P n /\\ Q n", ": (exists n, P n /\\ Q n)"),
    ),
    (" n : let a := n in let b := 1 in P a -> Q b", (": exists n, let a := n in P a",)),
    (
        " n : P n -> [/\\ Q n, forall k, R k -> S k & forall l, T l \\/ U l -> V l]",
        (": exists n, P n /\\ ((exists k, R k) /\\ exists l, T l \\/ U l)",),
    ),
    (" n k : P n -> (forall j, Q j -> R j) -> S n k", (": exists n, P n /\\ (forall j, Q j -> R j)",)),
    (" n : (P n -> Q n) /\\ (R n -> S n)", (": exists n, P n /\\ R n", ": (exists n, P n) /\\ (exists n, R n)")),
]


@pytest.mark.parametrize(("statement", "wanted"), MADE)
def test_what_says_that_premises_hold_together(statement: str, wanted: tuple[str, ...]) -> None:
    found = together(Headline("made_up", statement, "", "Headlines.v"))
    assert found[: len(wanted)] == wanted and (wanted or not found)


def test_each_headline_that_supposes_something_has_an_instance_of_all_its_premises() -> None:
    wanted = {name: said for name, headline in STATEMENTS.headlines.items() if (said := together(headline))}
    found = {*stated(), *instances(STATEMENTS, BEYOND)}
    assert {f"{name}_instance{said[0]}": "is not there" for name, said in wanted.items() if name not in found} == {}
    assert len(wanted) > 150 and found == set(wanted)
    for name, one in stated().items():
        assert TEXTS[one.file].splitlines()[one.line - 1].startswith(f"Theorem {name}_instance")


@pytest.mark.parametrize("kind", ["Z", "id Z", "id (id Z)", "id (id (id Z))"])
def test_a_name_may_have_its_type_besides(kind: str) -> None:
    text = f"Theorem residues_exist_instance : exists (l : {kind}), Z.lt (Zpos xH) l.\nProof."
    assert set(instances(STATEMENTS, {"Made.v": text})) == {"residues_exist"}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("S B D u v x y /\\ (q <= t)%N /\\", "S B D u v x y /\\ (q < t)%N /\\"),
        (" /\\ (q <= t)%N /\\", " /\\"),
        ("proposition_1_two_sided_instance", "proposition_1_tow_sided_instance"),
        ("(Q : 'M[K]_N) (S : system K n m p) (B", "(Q : 'M[K]_N) (S : system K 0 0 0) (B"),
    ],
)
def test_an_instance_of_something_else_is_noticed(old: str, new: str) -> None:
    text = TEXTS["InstancesOfLimits.v"]
    assert old in text
    with pytest.raises(NotProved, match=r"InstancesOfLimits\.v: .*_instance does not say"):
        instances(STATEMENTS, {"InstancesOfLimits.v": text.replace(old, new, 1)})


def question() -> str:
    """Return a file in which Rocq reads each instance as the file of its headline would, proves it by the theorem, and says what all rest
    on."""
    lines = ["From mathcomp Require Import all_ssreflect all_algebra."]
    lines += [f"From faultspace Require Headlines {' '.join(sorted({one.file.removesuffix('.v') for one in stated().values()}))}."]
    for file in sorted({STATEMENTS.headlines[name].file for name in stated()}):
        lines += [f"Module In{file.removesuffix('.v')}.", STATEMENTS.openings[file]]
        for name, one in stated().items():
            if STATEMENTS.headlines[name].file == file:
                said = re.sub(r"^: ", "", one.statement) if one.statement.startswith(": ") else proposition(one.statement)
                lines += [f"Goal {said}.\nProof. exact (@{one.file.removesuffix('.v')}.{name}_instance). Qed."]
        lines += [f"End In{file.removesuffix('.v')}."]
    named = (f"(fun (P : Prop) (_ : P) => I) _ (@{one.file.removesuffix('.v')}.{name}_instance)" for name, one in stated().items())
    return "\n".join([*lines, f"Definition every_one := ({', '.join(named)}, I).", "Print Assumptions every_one.", ""])


@pytest.mark.slow
def test_instances_mean_what_the_headlines_would_mean_by_them(theory: Path) -> None:
    """No word of an instance is another than the headline's: Rocq reads its text with what the file of the headline opens with."""
    assert compile_file(theory, "Instances.v", question()).strip() == CLOSED


@pytest.mark.programs
def test_what_needs_more_of_mathcomp_is_proved_where_that_is_installed(theory: Path) -> None:
    """The files beside the theory state instances, too, and rest on nothing."""
    found = instances(STATEMENTS, BEYOND)
    assert found and {one.file for one in found.values()} == set(BEYOND) and not set(found) & set(stated())
    try:
        compile_file(theory, "Probe.v", REAL_CLOSED)
    except BrokenTheory:
        pytest.skip("MathComp's real closed fields are not installed: apt install libcoq-mathcomp-real-closed")
    for file, text in BEYOND.items():
        every_one = ", ".join(f"{name}_instance" for name, one in found.items() if one.file == file)
        asked = f"{text}Definition every_one := ({every_one}).\nPrint Assumptions every_one.\n"
        assert compile_file(theory, file, asked).strip() == CLOSED
