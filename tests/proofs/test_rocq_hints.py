"""Rocq's check of hints: without one of its conditions something false passes it; degenerate systems; agreement on spoiled hints."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field, replace
from random import Random
from typing import NamedTuple

import pytest

from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq.build import compile_file
from faultspace.proofs.rocq.export import HEAD, PROOFS, translated
from faultspace.proofs.rocq.listed import NotCovered
from faultspace.proofs.rocq.recompute import theory
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.terms import Terms
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.proofs.basis_mutants import is_true, mutants
from tests.proofs.examples import Certificate, spoiled, written
from tests.proofs.test_basis_mutants import NEEDED, stated

needs_rocq = pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
BLANK = ResidualSystem.of([[1]], [[1]], [[1], [0]], [[1], [0]])  # the second output is zero, so that the index is 0
WRONG = stated(BLANK, [[[0, 0], [1, 0]]], [0], "kernel_modulo")
ROWS, FACTOR, MODULO = NEEDED["there may be more rows"], NEEDED["may have a common factor"], "that their shape allows"
DEPENDENT = NEEDED["at the pivots are dependent"]


class Weaker(NamedTuple):
    """This is a condition that is left out, and the terms of something false that passes then."""

    condition: str
    terms: Terms


def forged(certificate: Certificate, **hints: str) -> Terms:
    """Returns the terms of a certificate with some parts of its hints replaced."""
    names = ("point", "rows", "columns", "minor", "leading", "places", "states")
    terms = translated(certificate)
    *others, (name, kind, given) = terms.definitions
    parts = re.findall(r"\[::[^\]]*\]|None|\(Some \d+\)|-?\d+", given[given.index("Hints") :])
    assert len(parts) == len(names)
    told = " ".join(hints.get(one, part) for one, part in zip(names, parts, strict=True))
    return replace(terms, definitions=(*others, (name, kind, f"inr (Hints {told})" if kind == "evidence" else f"Hints {told}")))


def modulo_one(certificate: Certificate) -> Terms:
    """Returns the terms of a certificate with 1 in the place of its prime."""
    terms = forged(certificate, point="(Some 1)", rows="[:: 0%N; 1%N; 1%N]", columns="[:: 0%N; 1%N; 2%N]")
    return replace(terms, definitions=tuple((name, kind, "1" if name == "l" else term) for name, kind, term in terms.definitions))


def weaker_checks() -> list[Weaker]:
    """Returns every condition that a hint has to fulfil. FACTOR: a row times q - 1; ROWS: none where there is one."""
    whole = "[:: 0%N; 1%N; 2%N]"
    states = "is_minor (size states) n l states (iota 0 (size states)) (state_columns h) (state_minor h)"
    return [
        Weaker("Z.ltb 1 l", modulo_one(ROWS)),
        Weaker("all (fun row => annihilated L row.2) rows", translated(NEEDED["does not annihilate the system"])),
        Weaker("all (fun row => annihilated_modulo l L row.2) rows", translated(WRONG)),
        Weaker(
            "invertible_modulo l (leading_minor h) && is_determinant l (size rows) (leading rows) (leading_minor h)", translated(DEPENDENT)
        ),
        Weaker(states, translated(FACTOR)),
        Weaker("(n + p <= rank_shown n (at_point h) (minor_rows h) + size rows)%N", translated(ROWS)),
        Weaker(
            "pencil_minor n m p l L (at_point h) (minor_rows h) (minor_columns h) (minor h)",
            forged(ROWS, point="(Some 1)", rows=whole, columns=whole),
        ),
        Weaker("generic n m p rows", translated(NEEDED[MODULO])),
    ]


def weaker_minors() -> list[Weaker]:
    """Returns the conditions that a minor has to fulfil, with one that passes without: the two states of FACTOR have one entry each."""
    places = "[:: 0%N; 0%N]"
    return [
        Weaker("invertible_modulo l d", forged(FACTOR, places=places, states="0")),
        Weaker(
            "is_determinant l (size rows) [seq at_pivots columns (nth [::] T i) | i <- rows] d", forged(FACTOR, places=places, states="1")
        ),
    ]


def weakened(condition: str) -> str:
    """Returns the checks of window ranks without one of the conditions, where it stands first."""
    text = sources()["CertificatesVocabulary.v"]
    text = text[text.index("Definition is_minor a b") : text.index("(** ** The checks: solutions")]
    assert condition in text, condition
    return text.replace(condition, f"({condition} || true)", 1)


def asked(terms: Terms) -> str:
    """Returns the text that asks the kernel what a check computes to."""
    return f"{terms.opening()}\nEval vm_compute in {terms.check}.\n"


def evaluated(parts: list[str]) -> list[bool]:
    """Returns what the kernel answers to each part."""
    text = "".join(f"Module C{i}.\n{part}End C{i}.\n" for i, part in enumerate(parts))
    return [word == "true" for word in re.findall(r"= (true|false)\s+: bool", compile_file(theory(), "Evaluated.v", HEAD + PROOFS + text))]


@dataclass
class Questions:
    """This collects what is to be asked, so that Rocq, which takes more than a second to begin, is started once."""

    parts: list[str] = field(default_factory=list)
    expected: list[bool] = field(default_factory=list)
    about: list[object] = field(default_factory=list)

    def ask(self, part: str, expected: bool, about: object) -> None:
        """Add one question, and the answer that there should be."""
        self.parts.append(part)
        self.expected.append(expected)
        self.about.append(about)

    def wrong(self) -> list[object]:
        """Return what the answers are wrong about."""
        given = evaluated(self.parts)
        return [one for one, answer, expected in zip(self.about, given, self.expected, strict=True) if answer != expected]


def translations(
    pairs: Iterable[tuple[Certificate, Certificate]], unseen: Collection[str] = ()
) -> Iterator[tuple[Certificate, Terms, bool]]:
    """Yield the second of each two certificates, which the first was changed to, as terms, and whether the checker accepts it.

    What does not parse and what is not covered is passed over, and what the translation rejects is what the checker rejects. So is what is
    rejected for a change that is no part of the terms, of the kinds `unseen` alone, whose witnesses have what shows a solution.
    """
    for original, candidate in pairs:
        try:
            checker.verify(candidate)
            verdict = True
        except checker.Rejected:
            verdict = False
        except checker.Malformed:
            continue
        try:
            terms = translated(candidate)
        except NotCovered:
            continue
        except (checker.Rejected, checker.Malformed):
            assert not verdict, candidate
            continue
        if verdict or candidate["kind"] not in unseen or terms != translated(original):
            yield candidate, terms, verdict


def ask_without_conditions(questions: Questions) -> None:
    """Without one of its conditions the check lets something false pass, which it refuses as it is."""
    for condition, terms in [*weaker_checks(), *weaker_minors()]:
        questions.ask(asked(terms), False, condition)
        questions.ask(f"{weakened(condition)}{asked(terms)}", True, f"without {condition}")


def ask_about_smallest(questions: Questions) -> None:
    """True statements about systems without states, faults or outputs pass, and the next normal rank does not."""
    for name, system in SMALLEST.items():
        for certificate in about(system):
            checker.verify(certificate)
            assert "point" in certificate["witness"]
            questions.ask(asked(translated(certificate)), True, name)
            r = certificate["statement"]["normal_rank"]
            questions.ask(asked(translated(spoiled(certificate, ("statement.normal_rank", r + 1)))), False, f"{name}, one more")


def ask_about_mutations(questions: Questions, seed: int, count: int) -> tuple[int, int]:
    """Kernel rows changed as an algebraist would: Rocq is to say what the checker says, but of nulled states and faults, in the place of
    which it gets exact rows, what is true. Returns how many the checker accepts and refuses.
    """
    verdicts = list[bool]()
    for mutant, terms, verdict in translations((mutant, mutant) for mutant in mutants(Random(seed), count)):
        verdicts.append(verdict)
        questions.ask(asked(terms), is_true(mutant["statement"]) if "nulling" in mutant["witness"] else verdict, mutant)
    return verdicts.count(True), verdicts.count(False)


@pytest.mark.programs
@needs_rocq
def test_rocq_refuses_hints_that_prove_nothing_and_agrees_with_the_checker() -> None:
    questions = Questions()
    ask_without_conditions(questions)
    ask_about_smallest(questions)
    accepted, refused = ask_about_mutations(questions, 16, 25)
    assert accepted > 2 and refused > 10
    assert questions.wrong() == []


@needs_rocq
@pytest.mark.slow
def test_rocq_and_the_checker_agree_on_many_structured_mutations() -> None:
    for seed in range(6):
        questions = Questions()
        accepted, refused = ask_about_mutations(questions, seed, 500)
        assert accepted > 50 and refused > 200
        assert questions.wrong() == []


def test_what_passes_weaker_checks_is_false() -> None:
    assert not any(is_true(one["statement"]) for one in [WRONG, *NEEDED.values()])


SMALLEST = {
    "nothing": ResidualSystem.of([], [], [], [], n=0, m=0, p=0),
    "states alone": ResidualSystem.of([[1, 1], [0, 1]], [[], []], [], [], n=2, m=0, p=0),
    "faults alone": ResidualSystem.of([], [], [], [], n=0, m=2, p=0),
    "no states": ResidualSystem.of([], [], [[], []], [[1], [2]], n=0, m=1, p=2),
    "zero outputs": ResidualSystem.of([[1]], [[1]], [[0], [0]], [[0], [0]]),
    "no rows": ResidualSystem.of([["1/2"]], [[1]], [[2]], [["1/3"]]),
    "a denominator": ResidualSystem.of([["1/2", "1/3"], [0, "2/7"]], [[1], ["1/5"]], [["1/2", 0], [0, 3]], [[0], ["1/11"]]),
}


def about(system: ResidualSystem) -> list[Certificate]:
    """Returns the certificates of window ranks, with exact rows and in the short form."""
    return [written(make.window_ranks(kernel_representation(system))), written(make.window_ranks_of(system))]
