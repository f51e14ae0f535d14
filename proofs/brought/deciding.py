"""From a claim to its verdict.

decide        the answers to a claim, over each of its fields
certified     what the claim reads of a counterexample, with certificates that the checker has accepted
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from ...base.errors import InvalidInput
from ...base.progress import Progress
from ...exact.algebra.matrices import Matrix
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box
from ..language.evaluating import evaluate, exactly
from ..language.nodes import Node, Undefined
from ..language.vocabularies import SYSTEM
from ..quantities.cases import Case, size_of
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, Unprovable, accept, sha256
from .answers import ClaimAnswer, Counterexample, Dropped, Tried
from .claims import Answered, Claim
from .kept import Sharing
from .known_cases import ADVERSARY, CORPUS, known_cases, smaller
from .theorems import Proof, proof_of
from .trying import Found, Question, must_have_a_value, search


@dataclass
class _Known:
    """What the systems outside the box say to a question."""

    met: dict[str, int]
    failing: Case | None = None
    undefined: str = ""


def decide(
    claim: Claim, *, ablation: bool, most: int, jobs: int = 1, progress: Progress, sharing: Sharing | None = None
) -> list[ClaimAnswer]:
    """Return the verdict over each field. Raises InvalidInput where the claim has no value on a system, and names it."""
    shared = sharing or Sharing(jobs)
    return [_over(claim, field, ablation=ablation, most=most, sharing=shared, progress=progress) for field in claim.boxes]


def _over(claim: Claim, field: str, *, ablation: bool, most: int, sharing: Sharing, progress: Progress) -> ClaimAnswer:
    started, box = time.perf_counter(), claim.boxes[field]
    *hypotheses, conclusion = claim.nodes
    questions = [Question(tuple(hypotheses), conclusion)]
    if ablation:
        questions += [
            Question(tuple(one for place, one in enumerate(hypotheses) if place != k), conclusion, k) for k in range(len(hypotheses))
        ]
    searched = search(box, questions, most=most, progress=progress, sharing=sharing)
    main = searched.found[0]
    if main.undefined is not None:
        raise must_have_a_value(main.undefined, f"claim.{claim.id}")
    progress(f"trying {claim.id} on known systems", 0, 0)
    known = _on_known_cases(questions[0], box) if main.failing is None else _Known({CORPUS: 0, ADVERSARY: 0})
    if known.undefined:
        raise InvalidInput(f"claim.{claim.id}: {known.undefined}")
    counterexample = None
    if main.failing is not None:
        counterexample = certified(claim, main.failing, smallest=True)
    elif known.failing is not None:
        counterexample = certified(claim, smaller(known.failing, lambda one: _fails(questions[0], one)), smallest=False)
    verdict = Answered.REFUTED if counterexample else _unrefuted(main, known)
    proof = None if verdict == Answered.VACUOUS else _proof(hypotheses, conclusion, box)
    if proof is not None:
        verdict = _proved(f"claim.{claim.id}", proof, None if counterexample is None else counterexample.case)
    asked = main.failing is None and known.failing is None
    listed = known_cases(box) if main.failing is None else ()
    counts = {origin: sum(1 for one in listed if one.origin == origin) for origin in (CORPUS, ADVERSARY)}
    tried = Tried(
        box=str(box),
        systems=searched.systems,
        looked_at=searched.looked_at,
        exhausted=searched.exhausted and main.failing is None,
        met=main.met,
        corpus=counts[CORPUS],
        corpus_met=known.met[CORPUS],
        adversary=counts[ADVERSARY],
        adversary_met=known.met[ADVERSARY],
        of=box.noun,
    )
    dropped = None
    if ablation:
        labels = [one.label for one in claim.hypotheses]
        dropped = tuple(
            _without(f"claim.{claim.id} without {labels[k]}", labels[k], question, found, box, asked=asked)
            for k, (question, found) in enumerate(zip(questions[1:], searched.found[1:], strict=True))
        )
    return ClaimAnswer(
        id=claim.id,
        field=field,
        statement=claim.statement,
        source=claim.source,
        hypotheses=tuple(one.words for one in claim.hypotheses),
        conclusion=conclusion.text,
        verdict=verdict,
        counterexample=counterexample,
        tried=tried,
        dropped=dropped,
        expected=claim.expected.get(field),
        proof=proof,
        seconds=time.perf_counter() - started,
    )


def certified(claim: Claim, case: Case, *, smallest: bool) -> Counterexample:
    """Return the counterexample with what the claim reads of it. Raises ArithmeticError where exact functions do not find that it is one.

    What was asked in deciding the hypotheses and the conclusion exactly is what the claim reads; each value comes with the certificates
    that bear it, where some do. Certificates about A', C', F', G' or about (A, C) alone say so.
    """
    knows = exactly(case)
    if not all(evaluate(one.that, knows) for one in claim.hypotheses) or evaluate(claim.conclusion, knows):
        raise ArithmeticError(f"two ways to find the quantities of {case} disagree")
    values: dict[str, object] = {}
    certificates: dict[str, Certificate] = {}
    computed = []
    for (subject, name, s), value in sorted(knows.asked.items(), key=lambda one: one[0][2] or 0):  # windows ascending, after what has none
        text = (f"{subject}." if subject else "") + (name if s is None else f"{name}({s})")
        values[text] = value
        of, quantity = knows.found(subject, name)
        maker = quantity.certificates
        try:
            if maker is None:
                raise Unprovable(name)
            made = maker(of) if s is None else maker(of, s)
        except Unprovable:
            computed.append(text)
            continue
        for one in made:
            accept(one)
            certificates[sha256(one)] = one
    for text, (function, built, value) in knows.matrices.items():
        values[text] = value
        if function in ("rows", "columns"):
            continue
        found = _of_a_matrix(function, built, value)
        if found is None:
            computed.append(text)
            continue
        accept(found)
        certificates[sha256(found)] = found
    return Counterexample(case, values, tuple(certificates.values()), tuple(computed), smallest)


def _of_a_matrix(function: str, built: Matrix, value: object) -> Certificate | None:
    """Return the certificate of the rank of X, which is T_1 of the system without states and the feedthrough X, or of its stability."""
    nothing = Matrix.zero(built.field, 0, 0)
    if function in ("rank", "nullity", "is_zero"):
        system = ResidualSystem(nothing, Matrix.zero(built.field, 0, built.ncols), Matrix.zero(built.field, built.nrows, 0), built)
        return make.matrix_rank("toeplitz", system, window=1)
    if function == "schur_stable" and value:
        n = built.nrows
        return make.schur_stable(ResidualSystem(built, Matrix.zero(built.field, n, 0), Matrix.zero(built.field, 0, n), nothing))
    return None


def _fails(question: Question, case: Case) -> bool:
    try:
        knows = exactly(case)
        return all(evaluate(one, knows) for one in question.hypotheses) and not evaluate(question.conclusion, knows)
    except Undefined:
        return False


def _on_known_cases(question: Question, box: Box) -> _Known:
    """Return the first that fails, in the order of sizes, and how many meet the hypotheses."""
    found = _Known({CORPUS: 0, ADVERSARY: 0})
    for one in sorted(known_cases(box), key=lambda one: (size_of(one.case), one.origin)):
        knows = exactly(one.case, one.subject)
        try:
            if not all(evaluate(node, knows) for node in question.hypotheses):
                continue
            found.met[one.origin] += 1
            failing = not evaluate(question.conclusion, knows)
        except Undefined as error:
            found.undefined = f"on {one.case}, {error}"
            return found
        if failing and found.failing is None:
            found.failing = one.case
    return found


def _unrefuted(main: Found, known: _Known) -> Answered:
    return Answered.NOT_REFUTED if main.met or sum(known.met.values()) else Answered.VACUOUS


def _proof(hypotheses: Sequence[Node], conclusion: Node, box: Box) -> Proof | None:
    """Return the proof of a claim about single systems, of which alone the theorems speak; None where none is found."""
    return proof_of(hypotheses, conclusion) if box.about == SYSTEM else None


def _proved(name: str, proof: Proof, failing: Case | None) -> Answered:
    """Return PROVED. Raises ArithmeticError where a system refutes what follows from theorems: one of the two is an error of ours."""
    if failing is not None:
        raise ArithmeticError(f"{name} {proof.words}, and yet {failing} refutes it")
    return Answered.PROVED


def _without(name: str, label: str, question: Question, found: Found, box: Box, *, asked: bool) -> Dropped:
    """Return what becomes of the claim without a hypothesis. Where it is refuted with it, `asked` is False, it is without it, too."""
    if not asked:
        return Dropped(label, Answered.REFUTED, found.failing, informs=False)
    proof = _proof(question.hypotheses, question.conclusion, box)
    if proof is not None:
        return Dropped(label, _proved(name, proof, found.failing), None, proof=proof)
    if found.failing is not None:
        return Dropped(label, Answered.REFUTED, found.failing)
    if found.undefined is not None:
        return Dropped(label, None, None, f"on {found.undefined.system}, {found.undefined.message}")
    known = _on_known_cases(question, box)
    if known.undefined:
        return Dropped(label, None, None, known.undefined)
    if known.failing is not None:
        return Dropped(label, Answered.REFUTED, smaller(known.failing, lambda one: _fails(question, one)))
    return Dropped(label, _unrefuted(found, known), None)
