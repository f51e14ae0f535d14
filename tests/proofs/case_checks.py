"""What the tests of claims about pairs, choices and records check alike.

check_order        a box is gone through in the stated order
check_weights      those that are looked at stand for all
check_the_first    what refutes is the first case of the box, which exact functions find one by one
check_example      an example in a smaller box is answered as expected, with certificates that the checker accepts
check_refused      a text that is no claim is refused in these words, and so is a document that is no case
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.cli.command_line import main
from faultspace.proofs.boxes.box import Box
from faultspace.proofs.brought.answers import ClaimAnswers
from faultspace.proofs.brought.claiming import decide_claims
from faultspace.proofs.brought.claims import Claim, make_claim
from faultspace.proofs.language.evaluating import evaluate, exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.vocabularies import CHOICE, VOCABULARIES
from faultspace.proofs.trust.structure_certificates import accept

InOrder = Callable[[Any], Iterator[Any]]


def check_order(box: Box, in_order: InOrder) -> None:
    listed: list[Any] = []
    for sizes in box.sizes():
        before = len(listed)
        for stretch in box.stretches(sizes, reduced=False):
            listed += [stretch.batch.case(int(i)) for i in range(len(stretch.batch))]
            assert set(stretch.weights) <= {1}
        assert box.about == CHOICE or len(listed) - before == box.count(*sizes)
    assert listed == list(in_order(box))


def check_weights(box: Box) -> None:
    for sizes in box.sizes():
        looked_at = sum(int(stretch.weights.sum()) for stretch in box.stretches(sizes, reduced=True))
        every_one = sum(len(stretch.batch) for stretch in box.stretches(sizes, reduced=False)) if box.about == CHOICE else box.count(*sizes)
        assert looked_at == every_one, sizes


def check_the_first(about: str, conclusion: str, hypotheses: Sequence[str], given: dict[str, Any], in_order: InOrder) -> None:
    claim = make_claim("x", {"about": about, "conclusion": conclusion, "hypotheses": hypotheses, "box": given})

    def fails(case: Any) -> bool:
        knows = exactly(case)
        return all(evaluate(one.that, knows) for one in claim.hypotheses) and not evaluate(claim.conclusion, knows)

    wanted = next((one for one in in_order(claim.boxes["Q"]) if fails(one)), None)
    found = fs.claim(conclusion, hypotheses=hypotheses, about=about, box=given, ablation=False).answers[0].counterexample
    if wanted is None:
        assert found is None or not found.smallest
    else:
        assert found is not None and found.smallest and found.case == wanted


def check_example(claim: Claim, smaller: Callable[[Any], Box]) -> ClaimAnswers:
    answers = decide_claims([replace(claim, boxes={field: smaller(box) for field, box in claim.boxes.items()})])
    assert answers.as_expected, answers.title
    for one in answers.certificates:
        accept(one)
    return answers


def check_refused(text: str, words: str, about: str) -> None:
    with pytest.raises(InvalidInput) as error:
        read(text, vocabulary=VOCABULARIES[about])
    assert words in str(error.value)


def check_documents(claims: Path, documents: Sequence[tuple[object, str]], capsys: pytest.CaptureFixture[str]) -> None:
    """Each document is refused by `claim --explain` in its words."""
    for document, words in documents:
        claims.with_name("document.json").write_text(json.dumps(document))
        assert main(["claim", str(claims), "--explain", str(claims.with_name("document.json"))]) == 2
        assert words in capsys.readouterr().err
