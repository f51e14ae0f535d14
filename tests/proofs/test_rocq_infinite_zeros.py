"""Infinite zeros in Rocq: without one of its conditions the check lets something false pass; agreement with the checker on mutations."""

from __future__ import annotations

import json
from random import Random

import pytest

from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq.export import translated
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.proofs.examples import Certificate, spoiled, written
from tests.proofs.test_mutations import mutated, mutations
from tests.proofs.test_rocq_certificates import small_ones
from tests.proofs.test_rocq_hints import Questions, asked, translations
from tests.thorough import THOROUGH

needs_rocq = pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
DELAY = written(make.infinite_zeros(ResidualSystem.of([[0]], [[1]], [[1]], [[0]])))  # r(k) = v(k - 1): one zero, of order 1
UNIT = [[[1], []], [[], [1]]]
TRIED = 60  # mutations


def one_more(certificate: Certificate, **witness: object) -> Certificate:
    """Returns a certificate that says order 2 in the place of 1, with other parts of its witness."""
    said = spoiled(certificate, ("statement.infinite_zero_orders", [2]))
    return {**said, "witness": said["witness"] | witness}


def forgeries() -> dict[str, Certificate]:
    """Returns, for each condition of the check, a false certificate that passes without it."""
    w = DELAY["witness"]
    diagonal = [[0, *f] if f[0] in (0, "0") else f for f in w["diagonal"]]
    assert sum(f != g for f, g in zip(diagonal, w["diagonal"], strict=True)) == 1
    (place,) = (i for i, f in enumerate(w["diagonal"]) if f != diagonal[i])
    left = [[[0, *f] for f in row] if i == place else row for i, row in enumerate(w["left"])]
    right = [[[0, *f] if j == place else f for j, f in enumerate(row)] for row in w["right"]]
    units = dict.fromkeys(("left", "left_inverse", "right", "right_inverse"), UNIT)
    return {
        "@equal_tables P a a (@table_product P U U') (diagonal_table a a (nseq a [:: one R]))": one_more(
            DELAY, right=right, diagonal=diagonal
        ),
        "@equal_tables P b b (@table_product P V V') (diagonal_table b b (nseq b [:: one R]))": one_more(
            DELAY, left=left, diagonal=diagonal
        ),
        "@equal_tables P a b (@table_product P (@table_product P U T) V) (diagonal_table a b d)": one_more(
            DELAY, diagonal=[[1], [0, 0, 0, 1]], **units
        ),
        "sort leq [seq valuation (nth [::] d i) | i <- places] == nseq n 0%N ++ orders": one_more(DELAY),
    }


def weakened(condition: str) -> str:
    """Returns the check without one of its conditions."""
    text = sources()["NumbersVocabulary.v"]
    text = text[text.index("Definition is_diagonalized") : text.index("End PolynomialChecks.")]
    assert text.count(condition) == 1, condition
    weaker = text.replace(condition, f"(({condition}) || true)")
    return f"Set Implicit Arguments. Unset Strict Implicit.\nSection Weakened. Variable R : arithmetic.\n{weaker}\nEnd Weakened.\n"


@pytest.mark.programs
@needs_rocq
def test_each_condition_is_needed() -> None:
    questions = Questions()
    questions.ask(asked(translated(DELAY)), True, "true")
    for condition, forged in forgeries().items():
        with pytest.raises(checker.Rejected):
            checker.verify(forged)
        questions.ask(asked(translated(forged)), False, condition)
        questions.ask(f"{weakened(condition)}{asked(translated(forged))}", True, f"without {condition}")
    assert questions.wrong() == []


@pytest.mark.programs
@needs_rocq
def test_rocq_and_the_checker_agree_on_mutations_of_infinite_zeros() -> None:
    made = [one for one in small_ones() if one["kind"] == "infinite-zeros"]
    every = [(one, path, value) for one in made for path, value in mutations(one)]
    questions, verdicts = Questions(), list[bool]()
    tried = Random(7).sample(every, len(every) if THOROUGH else 3 * TRIED)
    for candidate, terms, verdict in translations((one[0], mutated(*one)) for one in tried):
        questions.ask(asked(terms), verdict, json.dumps(candidate))
        verdicts.append(verdict)
    assert verdicts.count(True) > 10 and verdicts.count(False) > TRIED / 2
    assert questions.wrong() == []


def test_a_multiplier_that_cannot_be_divided_is_refused() -> None:
    """The checker refuses it, too: in the form of a true certificate the columns without t are mapped to such columns."""
    for i, row in enumerate(DELAY["witness"]["left"]):
        for j, f in enumerate(row):
            forged = spoiled(DELAY, (f"witness.left.{i}.{j}", [7, *f[1:]]))
            with pytest.raises(checker.Rejected):
                checker.verify(forged)
    late = next(i for i, f in enumerate(DELAY["witness"]["diagonal"]) if f[0] in (0, "0"))
    with pytest.raises(checker.Rejected, match="does not map columns"):
        translated(spoiled(DELAY, (f"witness.left.{late}.0", [7])))
