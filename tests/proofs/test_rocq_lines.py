"""Lines of faults in Rocq: without one of its conditions the check lets something false pass; forged terms; agreement with the checker."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ, Field, PrimeField
from faultspace.exact.algebra.polynomials import trimmed
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq.build import NotProved
from faultspace.proofs.rocq.export import translated
from faultspace.proofs.rocq.export_lines import shown_at
from faultspace.proofs.rocq.numbered import system_of
from faultspace.proofs.rocq.recompute import ACCEPTED, proved, recomputed, theory
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.terms import Terms
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.oracle import truth
from tests.proofs.examples import FIELDS, SQRT2, Certificate, lines, spoiled, written
from tests.proofs.test_lines_and_stability import pairs
from tests.proofs.test_mutations import mutated, mutations
from tests.proofs.test_rocq_hints import Questions, asked, translations
from tests.thorough import THOROUGH

needs_rocq = pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
Line = tuple[ResidualSystem, ResidualSystem]
TRIED = 60  # mutations


def line(A: Any, C: Any, first: tuple[Any, Any], second: tuple[Any, Any], field: Field = QQ) -> Line:
    """Returns a line of faults, from F, G of its two ends."""
    n, m, p = len(A), len((first[1] or first[0])[0]), len(C)
    a, b = (ResidualSystem.of(A, F, C, G, field=field, n=n, m=m, p=p) for F, G in (first, second))
    return a, b


def dense() -> Line:
    """Returns a line with as many faults as outputs of which no number can be changed, and three minors."""
    return line(
        [["1/2", 1, 2], [3, "1/3", 1], [1, 2, -1]], [[1, 2, 1], [2, 1, "3/2"], [1, 1, 3]],
        ([[1, 2], [3, 1], ["1/2", 4]], [[2, 1], [1, 3], [5, "1/3"]]), ([[2, 5], [1, 1], [3, 1]], [[1, 4], [2, "2/3"], [1, 1]]),
    )  # fmt: skip


def claimed(pair: Line, *minors: tuple[int, list[int]], prime: int = 1009) -> Certificate:
    """Returns the certificate, true or not, with these minors, each a point and rows."""
    statement = {key: system.to_json() for key, system in zip(("first", "second"), pair, strict=True)}
    witness: dict[str, Any] = {"minors": [{"point": q, "rows": rows} for q, rows in minors]}
    field = pair[0].field
    witness |= {} if isinstance(field, PrimeField) else {"prime": prime}
    made = {"format": "faultspace-certificate/1", "kind": "left-invertible-line", "statement": statement, "witness": witness}
    return json.loads(json.dumps(made))  # type: ignore[no-any-return]


def with_parts(terms: Terms, **parts: list[str]) -> Terms:
    """Returns terms with other points, or others: each c, W, Y, Z and e."""
    told = {name: f"[:: {'; '.join(some)}]" if some else "[::]" for name, some in parts.items()}
    assert told.keys() <= {name for name, _, _ in terms.definitions}
    return replace(terms, definitions=tuple((name, kind, told.get(name, term)) for name, kind, term in terms.definitions))


def at(*parts: str) -> str:
    """Returns a point over Q: c, W, Y, Z and e."""
    return f"LinePoint (R := algebraic f) {' '.join(parts)}"


# -- what is not so -------------------------------------------------------------------------------------------------------

IDENTITY = (
    "@equal_tables P m m (@table_product P (@table_product P (faults_along n m p L L') (constants (unseen_by_states x))) (adjoint x))\n"
    "      (diagonal_table m m (nseq m (determinant_part x)))"
)
SUM = "@is_one (polynomials R) (foldr (@sum R) [::] [seq determinant_part x | x <- points])"
ONE, ZERO, NEGATIVE = "[:: (1, 1)]", "[::]", "[:: (-1, 1)]"
HIDDEN = claimed(line([[0]], [[0]], ([[1]], [[0]]), ([[0]], [[1]])))  # b alone is seen: (1 : 0) is bad
REACHED = line([[0, 0], [0, 0]], [[1, 0]], ([[1], [0]], [[0]]), ([[0], [1]], [[0]]))  # a alone is seen: (0 : 1) is bad


def forgeries() -> dict[str, Terms]:
    """Returns, for each condition of the check, the terms of something false that pass without it. One state: F = 1 is not seen, G' = 1 is;
    two states: the first is seen and reached by the first fault, the second, that the second fault reaches, is not."""
    hidden, reached, second = translated(HIDDEN), translated(claimed(REACHED)), REACHED[1].to_json()
    carried = {**second, "A": [["0", "1"], ["0", "0"]]}, {**second, "C": [["0", "1"]]}  # in which the second fault is seen
    in_another = [translated(spoiled(claimed(REACHED), ("statement.second", one))) for one in carried]
    unit = f"[:: [:: [:: {ONE}]]]"
    other = at(ONE, f"[:: [:: {ONE}]; [:: {ZERO}]]", f"[:: [:: {ZERO}]; [:: {ONE}]]", unit, f"[:: {ONE}]")  # G' + t G = 1
    undone = f"[:: [:: {ONE}; {ZERO}]; [:: {ZERO}; {ONE}]; [:: {ZERO}; {ZERO}]]"
    seen = at(ONE, undone, f"[:: [:: {NEGATIVE}]; [:: {ZERO}]; [:: {ONE}]]", unit, f"[:: {ONE}]")  # F + t F' times Y = 1 for every t
    back = at(ONE, undone, f"[:: [:: {NEGATIVE}]; [:: {ZERO}]; [:: {ONE}]]", unit, f"[:: {ZERO}; {ONE}]")  # F' + t F times Y = t
    sheared = f"[:: [:: {ONE}; {ZERO}]; [:: {ONE}; {ONE}]; [:: {ZERO}; {ZERO}]]"
    by_state = at(ONE, sheared, f"[:: [:: {NEGATIVE}]; [:: {NEGATIVE}]; [:: {ONE}]]", unit, f"[:: {ONE}; {ONE}]")
    by_output = at(ONE, undone, f"[:: [:: {ZERO}]; [:: {NEGATIVE}]; [:: {ONE}]]", unit, f"[:: {ONE}]")
    return {
        "equal_tables n n (table_product N (undoing x)) [seq unit_row R n i | i <- iota 0 n]": with_parts(
            hidden, others=[other],
            points=[at(ZERO, f"[:: [:: {ZERO}]; [:: {ZERO}]]", f"[:: [:: {NEGATIVE}]; [:: {ZERO}]]", unit, f"[:: {ONE}]")],
        ),
        "equal_tables n m (table_product N (unseen_by_states x)) [::]": with_parts(
            hidden, others=[other],
            points=[at(ONE, f"[:: [:: {ONE}]; [:: {ZERO}]]", f"[:: [:: {NEGATIVE}]; [:: {ZERO}]]", unit, f"[:: {ONE}]")],
        ),
        IDENTITY: with_parts(hidden, others=[other], points=[other]),
        SUM: with_parts(
            hidden, others=[other],
            points=[at(ONE, f"[:: [:: {ONE}]; [:: {ZERO}]]", f"[:: [:: {ZERO}]; [:: {ONE}]]", unit, f"[:: {ZERO}; {ONE}]")],
        ),
        "all (shown_at n m p L L') points": with_parts(hidden, others=[other], points=[at(ONE, *["[::]"] * 3, f"[:: {ONE}]")]),
        "has (fun x => shown_at n m p L' L x && invertible (at_place (determinant_part x) 0)) others": with_parts(reached, points=[seen]),
        "shown_at n m p L' L x": with_parts(reached, points=[seen], others=[at(ONE, *["[::]"] * 3, f"[:: {ONE}]")]),
        "invertible (at_place (determinant_part x) 0)": with_parts(reached, points=[seen], others=[back]),
        "tA L == tA L'": with_parts(in_another[0], points=[seen], others=[by_state]),
        "tC L == tC L'": with_parts(in_another[1], points=[seen], others=[by_output]),
    }  # fmt: skip


def weakened(condition: str) -> str:
    """Returns the check without one of its conditions."""
    text = sources()["NumbersVocabulary.v"]
    text = text[text.index("Definition shown_at") : text.index("End LineChecks.")]
    assert text.count(condition) == 1, condition
    weaker = text.replace(condition, f"(({condition}) || true)")
    opening = "Variable R : arithmetic. Local Notation line_point := (line_point R)."
    return f"Set Implicit Arguments. Unset Strict Implicit.\nSection Weakened. {opening}\n{weaker}\nEnd Weakened.\n"


@pytest.mark.programs
@needs_rocq
def test_each_condition_is_needed() -> None:
    questions = Questions()
    for bad in (HIDDEN, claimed(REACHED)):
        assert not truth("left-invertible-line", bad["statement"])
    for condition, terms in forgeries().items():
        questions.ask(asked(terms), False, condition)
        questions.ask(f"{weakened(condition)}{asked(terms)}", True, f"without {condition}")
    assert questions.wrong() == []


def numbers_changed(terms: Terms) -> Iterator[Terms]:
    """Yields terms with one number of a system or of a point changed: another numerator, denominator or sign."""
    for i, (name, kind, term) in enumerate(terms.definitions):
        if name in ("first", "second", "points", "others"):
            for one in re.finditer(r"\((\(?-?\d+\)?), (\d+)\)", term):
                top, bottom = int(one[1].strip("()")), int(one[2])
                for new in (f"(({top + 1}), {bottom})", f"({one[1]}, {bottom + 1})", f"(({-top}), {bottom})"):
                    if top or not new.startswith(f"({one[1]}, "):
                        changed = (name, kind, term[: one.start()] + new + term[one.end() :])
                        yield replace(terms, definitions=(*terms.definitions[:i], changed, *terms.definitions[i + 1 :]))


@pytest.mark.programs
@needs_rocq
def test_no_number_can_be_changed() -> None:
    terms = translated(written(make.left_invertible_line(*dense())))
    every = [*numbers_changed(terms)]
    assert len(every) > 300
    questions = Questions()
    questions.ask(asked(terms), True, "as it is")
    for one in every if THOROUGH else Random(2).sample(every, 40):
        questions.ask(asked(one), False, one.definitions)
    parts = re.split(r"(?=LinePoint)", next(term for name, _, term in terms.definitions if name == "points").removesuffix("]"))[1:]
    points = [part.rstrip("; ") for part in parts]
    assert len(points) == 2
    for told in (points[:1], points[1:], [*points, points[0]], []):  # each point is needed, and counts as often as it is there
        questions.ask(asked(with_parts(terms, points=told)), False, len(told))
    questions.ask(asked(with_parts(terms, points=points[::-1])), True, "exchanged")
    questions.ask(asked(with_parts(terms, others=[])), False, "(0 : 1) is not seen")
    assert questions.wrong() == []


# -- what is only so over a smaller field ---------------------------------------------------------------------------------


def static(G: Any, G2: Any, field: Field = QQ) -> Line:
    """Returns a line of feedthroughs without states."""
    return line([], [[] for _ in G], ([], G), ([], G2), field)


TURN, UNIT = [[0, 1], [-1, 0]], [[1, 0], [0, 1]]
OVER_AN_EXTENSION = {
    "a^2 + b^2 over Q": static(UNIT, TURN),
    "a^2 + b^2 over GF(3)": static(UNIT, TURN, PrimeField(3)),
    "a^2 + a b + b^2 over GF(2)": static(UNIT, [[0, 1], [1, 1]], PrimeField(2)),
    "a^2 - 2 b^2 over Q": static(UNIT, [[0, 2], [1, 0]]),
    "a^2 - 3 b^2 over Q(sqrt 2)": static(UNIT, [[0, 3], [1, 0]], SQRT2),
    "(a^2 + b^2)^2, twice": static([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
        [[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1], [0, 0, -1, 0]]),
}  # fmt: skip


def tried(pair: Line) -> Certificate:
    """Returns what claims to certify a static line, with all its rows, twice and at two points."""
    field, rows = pair[0].field, list(range(pair[0].m))
    made = claimed(pair, (0, rows), (1, rows), (0, rows), prime=1_000_003)
    if field == SQRT2:
        made["witness"] |= {"prime": 17, "root": 6, "irreducible": {"modulo": 3}}
    return made


def told(certificate: Certificate, factors: Random) -> Terms:
    """Returns the terms with what the minors show, each times some polynomial, and with the systems exchanged."""
    terms, s, w = translated(certificate), certificate["statement"], certificate["witness"]
    first, second = system_of(s["first"], w), system_of(s["second"], w)
    element, points, others = first.numbers.field.element, list[str](), list[str]()
    for minor in w["minors"]:
        for one in shown_at(first, second, minor["point"], minor["rows"]):
            points.append(one.times(trimmed(element(factors.randint(-2, 2)) for _ in range(3))).term(first.numbers))
        others += [one.term(first.numbers) for one in shown_at(second, first, minor["point"], minor["rows"])]
    assert points and others
    return with_parts(terms, points=points, others=others)


@pytest.mark.programs
@needs_rocq
def test_a_common_zero_over_an_extension_is_seen() -> None:
    questions = Questions()
    for name, pair in OVER_AN_EXTENSION.items():
        forged = tried(pair)
        assert not truth("left-invertible-line", forged["statement"]), name
        with pytest.raises(make.Unprovable):
            make.left_invertible_line(*pair)
        with pytest.raises(checker.Rejected, match="common zero"):
            checker.verify(forged)
        questions.ask(asked(translated(forged)), False, name)
        for seed in range(3):
            combined = asked(told(forged, Random(seed)))
            questions.ask(combined, False, f"{name}, combined")
            questions.ask(f"{weakened(SUM)}{combined}", True, f"{name}, whatever the sum is")
    # Over Q alone: the same form beside another one, without a common zero.
    both = static([*UNIT, [0, 0]], [*TURN, [1, 0]])
    questions.ask(asked(translated(written(make.left_invertible_line(*both)))), True, "with another minor")
    assert questions.wrong() == []


@pytest.mark.programs
@needs_rocq
def test_a_proof_of_something_false_does_not_compile() -> None:
    terms = told(tried(OVER_AN_EXTENSION["a^2 + b^2 over Q"]), Random(1))
    with pytest.raises(NotProved, match="does not compile"):
        proved([terms], theory())


# -- what is so -----------------------------------------------------------------------------------------------------------

SMALL = {
    "no faults": line([[1, 2], [0, 1]], [[1, 0]], ([[], []], [[]]), ([[], []], [[]])),
    "no faults, no outputs": line([[1]], [], ([[]], []), ([[]], [])),
    "nothing": (ResidualSystem.of([], [], [], [], n=0, m=0, p=0),) * 2,
    "no states": static([[1], [0]], [[0], [1]]),
    "seen by one output alone": line([[0]], [[1]], ([[1]], [[0]]), ([[0]], [[1]])),
    "eigenvalues at all points of GF(2)": line([[0, 0], [0, 1]], [[1, 0], [0, 1]], ([[1], [0]], [[0], [0]]), ([[0], [1]], [[0], [0]]),
        PrimeField(2)),
    "dense": dense(),
}  # fmt: skip


@pytest.mark.programs
@needs_rocq
def test_smallest_lines_are_proved() -> None:
    certificates = [written(make.left_invertible_line(*pair)) for pair in SMALL.values()]
    assert recomputed(certificates) == [ACCEPTED] * len(SMALL)


def test_minors_that_say_nothing_do_not_harm() -> None:
    """Repeated minors, and such as are zero: those of the first output alone, which is no output of the fault."""
    good = written(make.left_invertible_line(*static([[1], [0], [0]], [[0], [1], [0]])))
    minors = good["witness"]["minors"]
    more = spoiled(good, ("witness.minors", [{"point": 0, "rows": [2]}, *minors, *minors, {"point": 5, "rows": [2]}]))
    checker.verify(more)
    terms = translated(more)
    points = next(term for name, _, term in terms.definitions if name == "points")
    assert points.count("LinePoint") <= len(minors)


def test_a_prime_that_misleads_is_looked_at_by_the_checker() -> None:
    """The forms a and 7 b have a common zero modulo 7 alone; 2 divides a denominator."""
    pair = static([[1], [0]], [[0], [7]])
    translated(written(make.left_invertible_line(*pair)))
    for prime, why in ((7, "common zero"), (9, "prime")):
        with pytest.raises(checker.Rejected, match=why):
            translated(claimed(pair, (0, [0]), (0, [1]), prime=prime))
    with pytest.raises(checker.Rejected):
        translated(claimed(static([["1/2"], [0]], [[0], [1]]), (0, [0]), (0, [1]), prime=2))


def agreement(questions: Questions, count: int, seed: int) -> tuple[int, int]:
    """Asks about mutations of lines over every field; returns how many of those asked about the checker accepts and refuses."""
    made = [written(make.left_invertible_line(*pair)) for field in (QQ, SQRT2, PrimeField(2), PrimeField(3)) for pair in lines(field)]
    every, verdicts = [(one, path, value) for one in made for path, value in mutations(one)], list[bool]()
    tried = Random(seed).sample(every, min(count, len(every)))
    for candidate, terms, verdict in translations((one[0], mutated(*one)) for one in tried):
        questions.ask(asked(terms), verdict, json.dumps(candidate))
        verdicts.append(verdict)
    return verdicts.count(True), verdicts.count(False)


@pytest.mark.programs
@needs_rocq
def test_rocq_and_the_checker_agree_on_mutations_of_lines() -> None:
    questions = Questions()
    accepted, refused = agreement(questions, 3 * TRIED, 3)
    assert accepted > 10 and refused > 3
    assert questions.wrong() == []


@needs_rocq
@pytest.mark.slow
def test_rocq_and_the_checker_agree_on_many_mutations_of_lines() -> None:
    questions = Questions()
    accepted, refused = agreement(questions, 2000, 4)
    assert accepted > 100 and refused > 40
    assert questions.wrong() == []


@needs_rocq
@pytest.mark.slow
@pytest.mark.parametrize("name", FIELDS)
def test_whatever_line_is_certified_is_proved(name: str) -> None:
    certificates = list[Certificate]()
    for pair in pairs(FIELDS[name], 60):
        try:
            certificates.append(written(make.left_invertible_line(*pair)))
        except make.Unprovable:
            continue
    assert len(certificates) > 10
    assert recomputed(certificates) == [ACCEPTED] * len(certificates)
