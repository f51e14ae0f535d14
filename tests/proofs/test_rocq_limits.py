"""Stability and limits in Rocq: each condition of the checks is needed, and Rocq agrees with the checker on mutations."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from random import Random
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.limits.moesp import limit
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq.export import translated
from faultspace.proofs.rocq.export_limits import LIMIT_KINDS
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.terms import Terms
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from faultspace.proofs.trust.limit_certificates import Certified
from tests.proofs.examples import LEADING, OUTPUTS, SQRT2, Certificate, certificates, experiment, spoiled, written
from tests.proofs.test_mutations import mutated, mutations
from tests.proofs.test_rocq_hints import Questions, asked, translations
from tests.thorough import THOROUGH

needs_rocq = pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
TRIED = 40  # mutations of each kind
HALF = written(make.schur_stable(ResidualSystem.of([["1/2", 3], [0, "-1/3"]], [[], []], [[1, 0]], [[]])))


def with_term(terms: Terms, name: str, value: str) -> Terms:
    """Returns the terms with another one in the place of that of a name."""
    assert sum(one == name for one, _, _ in terms.definitions) == 1
    changed = tuple((one, kind, value if one == name else term) for one, kind, term in terms.definitions)
    return Terms(changed, terms.check, terms.statement, terms.lemma)


def weakened(*conditions: str) -> str:
    """Returns the checks without some of their conditions."""
    text = sources()["ExperimentsVocabulary.v"]
    _, start, text = text.partition("(** ** The checks: stability *)")
    text, others, rest = text.partition("(** R' is the response")  # the checks of B and D have some of the same conditions
    for condition in conditions:
        assert text.count(condition) == 1, condition
        text = text.replace(condition, f"(({condition}) || true)")
    text = start + text + others + rest
    return f"From mathcomp Require Import ssrZ.\nSet Implicit Arguments. Unset Strict Implicit.\n{text}\n"


def stability_forgeries() -> dict[str, Terms]:
    """Returns, for each condition, a polynomial that passes without it and says of a matrix that it is stable which is not."""
    wild = translated(spoiled(HALF, ("statement.system.A", [["1/2", 3], [0, "-3"]])))
    unit = translated(spoiled(HALF, ("statement.system.A", [["1/2", 3], [0, "1"]])))
    return {
        "all (fun i => blank (row_polynomial f M (unit_row R n i))) (iota 0 n)": with_term(wild, "h", "[:: 6; (-1); (-1)]"),
        "inside_circle (size f).-1 f": wild,
        "Z.ltb (Z.abs b) (Z.abs a)": with_term(unit, "h", "[:: 2; (-3); 1]"),
        "a != Z0": with_term(wild, "h", "[:: 0]"),
    }


@pytest.mark.programs
@needs_rocq
def test_each_condition_of_stability_is_needed() -> None:
    questions = Questions()
    questions.ask(asked(translated(HALF)), True, "true")
    for condition, terms in stability_forgeries().items():
        questions.ask(asked(terms), False, condition)
    for condition in ("all (fun i => blank (row_polynomial f M (unit_row R n i))) (iota 0 n)", "inside_circle (size f).-1 f"):
        terms = stability_forgeries()[condition]
        questions.ask(f"{weakened(condition)}{asked(terms)}", True, f"without {condition}")
    assert questions.wrong() == []


def limit_forgeries() -> dict[str, Terms]:
    """Returns, for each condition, the terms of a certificate that passes without it alone."""
    more = {name: LEADING["statement"][f"{name}_rank"] + 1 for name in ("limit", "observability", "joint")}
    P = LEADING["witness"]["covariance"]
    wrong = spoiled(LEADING, ("witness.covariance.0.0", str(Fraction(P[0][0]) + 1)))
    found = {
        "@equal_tables R a a (covariances a P a next next) P": translated(wrong),
        "is_stable a (take a next) f": with_term(translated(LEADING), "h", "[:: 1]"),
    }
    parts = {"limit": ("rl", "of_limit"), "observability": ("ro", "of_states"), "joint": ("rj", "of_both")}
    for name, size in more.items():
        try:
            terms = translated(spoiled(LEADING, (f"statement.{name}_rank", size)))
        except checker.Rejected:  # the rank modulo the prime is smaller: the terms of the true one, with another number in the check
            terms = translated(LEADING)
            ranks = [LEADING["statement"][f"{one}_rank"] for one in ("limit", "observability", "joint")]
            said = " ".join(f"{rank}%N" for rank in ranks)
            other = " ".join(f"{size if one == name else rank}%N" for one, rank in zip(more, ranks, strict=True))
            assert terms.check.count(f" {said} E") == 1
            terms = Terms(terms.definitions, terms.check.replace(f" {said} E", f" {other} E"), terms.statement, terms.lemma)
        found[parts[name][0]] = terms
    return found


RANKS = {
    "rl": "has_rank (s * nu + (past * nu + q * p)) (s * nu + s * p) (s * nu + rl) (upper ++ lower) of_limit.1 of_limit.2",
    "ro": "has_rank (s * nu + n) (s * nu + s * p) (s * nu + ro) (upper ++ seen) of_states.1 of_states.2",
    "rj": "has_rank (s * nu + (past * nu + q * p + n)) (s * nu + s * p) (s * nu + rj) (upper ++ (lower ++ seen)) of_both.1 of_both.2",
}


@pytest.mark.programs
@needs_rocq
def test_each_condition_of_a_limit_is_needed() -> None:
    questions = Questions()
    for true in LEADING, OUTPUTS:
        questions.ask(asked(translated(true)), True, "true")
    for condition, terms in limit_forgeries().items():
        questions.ask(asked(terms), False, condition)
        if condition in RANKS or condition.startswith("is_stable"):
            questions.ask(f"{weakened(RANKS.get(condition, condition))}{asked(terms)}", True, f"without {condition}")
    assert questions.wrong() == []


@pytest.mark.programs
@needs_rocq
def test_rocq_and_the_checker_agree_on_mutations_of_stability_and_limits() -> None:
    questions, verdicts = Questions(), dict[tuple[str, bool], int]()
    made = {kind: [written(c) for field in (QQ, SQRT2) for c in certificates(field) if c["kind"] == kind] for kind in LIMIT_KINDS}
    for kind, some in made.items():
        every = [(one, path, value) for one in some for path, value in mutations(one)]
        tried = Random(7).sample(every, min(len(every), 40 * TRIED if THOROUGH else TRIED))
        for candidate, terms, verdict in translations(((one[0], mutated(*one)) for one in tried), LIMIT_KINDS):
            questions.ask(asked(terms), verdict, json.dumps(candidate))
            verdicts[kind, verdict] = verdicts.get((kind, verdict), 0) + 1
    assert all(verdicts.get((kind, verdict), 0) > 0 for kind in LIMIT_KINDS for verdict in (True, False)), verdicts
    assert questions.wrong() == []


DEGENERATE: dict[str, dict[str, Any]] = {
    "no memory": {"u_filter": [[[1]]], "v_filter": [[["1/2"]]]},
    "nothing but an input": {
        "A": [], "B": [], "F": [], "C": [[]], "G": [[]], "D": [[1]], "n": 0, "m": 0, "p": 1, "nu": 1, "u_filter": [[[1]]], "v_filter": [[]],
    },
    "silent faults": {"v_filter": [[[0]]]},
}  # fmt: skip


@pytest.mark.programs
@needs_rocq
def test_degenerate_experiments_pass_and_other_ranks_do_not() -> None:
    questions = Questions()
    for name, changes in DEGENERATE.items():
        found = limit(experiment(**changes))
        for certificate in map(written, (Certified(found).past_input_limit(), Certified(found).past_input_and_output_limit())):
            checker.verify(certificate)
            questions.ask(asked(translated(certificate)), True, name)
            for rank in ("limit", "observability", "joint"):
                less = spoiled(certificate, (f"statement.{rank}_rank", max(certificate["statement"][f"{rank}_rank"] - 1, 0)))
                if less != certificate:
                    questions.ask(asked(translated(less)), False, f"{name}, {rank} less")
    assert questions.wrong() == []


def test_a_covariance_of_the_plant_is_solved_for() -> None:
    """The certificate has the columns of the filters' states alone; what is found for Rocq is the stationary covariance of all states."""
    whole, part = translated(OUTPUTS), translated(LEADING)
    first, second = ({name: term for name, _, term in terms.definitions}["P"] for terms in (whole, part))
    assert first == second


def test_a_finite_field_has_no_unit_circle() -> None:
    forged: Certificate = spoiled(HALF, ("statement.system.field", {"prime": 3}), ("statement.system.A", [[0, 0], [0, 0]]))
    with pytest.raises(checker.Malformed):
        translated(forged)


def input_forgeries(regression: Certificate, output_error: Certificate) -> list[tuple[str, Terms]]:
    """Returns terms with one table that is wrong, for each of the two regressions."""
    made = [("regression", name, translated(regression)) for name in ("B", "D", "P", "R'", "X")]
    made += [("output error", name, translated(output_error)) for name in ("B", "D", "B'", "D'", "P", "S")]
    found = []
    for what, name, terms in made:
        term = next(one for known, _, one in terms.definitions if known == name)
        number = re.search(r"\((\(?-?\d+\)?), (\d+)\)", term)
        wrong = "[:: [:: [:: (1, 1)]]]"  # where all entries are zero
        if number is not None:
            wrong = term.replace(number.group(0), f"({number.group(1)} + 1, {number.group(2)})", 1)
        found.append((f"{what}, {name}", with_term(terms, name, wrong)))
    for what, terms in ("regression", made[0][2]), ("output error", made[-1][2]):
        found.append((f"{what}, no root inside the circle", with_term(terms, "h", "[:: 1]")))
    for name in "shown0", "shown1":
        found.append((f"regression, {name}", with_term(made[0][2], name, "([::], [::])")))
    return found


@pytest.mark.programs
@needs_rocq
def test_inputs_by_either_regression_are_recomputed_and_no_others() -> None:
    """Every table of the terms is looked at: with one entry more by one the check is false, and so are stability and both ranks."""
    questions = Questions()
    found = limit(experiment())
    true = [written(make_inputs(Certified(found))) for make_inputs in (Certified.moesp_inputs, Certified.output_error_inputs)]
    for certificate in true:
        checker.verify(certificate)
        questions.ask(asked(translated(certificate)), True, certificate["statement"]["regression"])
    for name, terms in input_forgeries(*true):
        questions.ask(asked(terms), False, name)
    assert questions.wrong() == []


TWO_INPUTS: dict[str, Any] = {
    "A": [["1/2", 1], [0, "1/3"]], "B": [[1, 0], [0, 1]], "F": [[1], [0]], "C": [[1, 0], [0, 1]], "G": [[0], [1]], "D": [[1, 0], [0, 1]],
    "n": 2, "m": 1, "p": 2, "nu": 2, "u_filter": [[[1, 0], [0, 1]]], "v_filter": [[["1/2", 0]], [["1/3", 1]]], "s": 3, "past": 3,
}  # fmt: skip


@pytest.mark.programs
@needs_rocq
def test_inputs_of_degenerate_experiments_and_of_several_inputs() -> None:
    questions = Questions()
    for name, changes in {**DEGENERATE, "two inputs": TWO_INPUTS}.items():
        found = limit(experiment(**changes))
        for certificate in map(written, (Certified(found).moesp_inputs(), Certified(found).output_error_inputs())):
            checker.verify(certificate)
            questions.ask(asked(translated(certificate)), True, name)
            for matrix in "B", "D":
                if certificate["statement"][matrix]:
                    questions.ask(asked(translated(spoiled(certificate, (f"statement.{matrix}.0.0", "7/3")))), False, f"{name}, {matrix}")
    assert questions.wrong() == []
