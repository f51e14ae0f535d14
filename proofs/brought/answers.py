"""What is answered to a claim, for people, programs and the checker.

Counterexample    the system, what the claim reads of it, the certificates that bear this, and what no kind of certificate bears
Dropped           the claim without one of its hypotheses
ClaimAnswer       the verdict on a claim over one field, and what was tried
ClaimAnswers      the verdicts on a file; what `fs.claim` returns
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import isinf
from typing import Any

from ...base.sheets import Shown, counted
from ...exact.system.systems import ResidualSystem
from ..quantities.cases import Case, case_json
from ..trust.structure_certificates import Certificate, sha256
from .claims import Answered
from .theorems import Proof


@dataclass(frozen=True)
class Counterexample:
    """`quantities` are those that the hypotheses and the conclusion read, by their words; `computed` names those without a certificate.

    `smallest` tells whether it is the first of the box; else it is one of the known ones, made smaller as far as single steps led, and lies
    outside the box where all of the box was tried.
    """

    case: Case
    quantities: Mapping[str, Any]
    certificates: tuple[Certificate, ...]
    computed: tuple[str, ...]
    smallest: bool

    @property
    def system(self) -> ResidualSystem:
        """The system, where the claim is about one. Raises TypeError where it is about something else: then `case` has it."""
        if not isinstance(self.case, ResidualSystem):
            raise TypeError(f"got a counterexample that is no system, expected one; .case is {self.case}")
        return self.case

    @property
    def words(self) -> Iterator[tuple[str, str]]:
        """These say the quantities."""
        for name, value in self.quantities.items():
            yield name, _shown(value) + (" (computed, not certified)" if name in self.computed else "")

    def to_json(self) -> dict[str, Any]:
        """Return `smallest` of the JSON answer; inf is written as null."""
        values = {name: _json(value) for name, value in self.quantities.items()}
        return {**case_json(self.case), "quantities": values, "computed": list(self.computed), "in_box": self.smallest}


@dataclass(frozen=True)
class Tried:
    """What was gone through: the box in words, how many systems of it, one an orbit or all, how many meet the hypotheses; then the others.

    `met` counts up to the counterexample where there is one.
    """

    box: str
    systems: int
    looked_at: int
    exhausted: bool
    met: int
    corpus: int
    corpus_met: int
    adversary: int
    adversary_met: int
    of: str = field(default="systems", kw_only=True)

    @property
    def words(self) -> str:
        """This says it in a sentence."""
        how_far = "all" if self.exhausted else "the first"
        here = (
            f"{how_far} {self.systems} {self.of} with {self.box} (by {self.looked_at} that stand for them), {self.met} meet the hypotheses"
        )
        others = (
            f"{self.corpus} of the corpus, {self.corpus_met} meet them",
            f"{self.adversary} of the adversary's families, {self.adversary_met} meet them",
        )
        return "; ".join([here, *others] if self.corpus or self.adversary else [here])


@dataclass(frozen=True)
class Dropped:
    """The verdict on the claim without the hypothesis `label`, with what refutes it; `undefined` says why there is none.

    `informs` is False where the claim is refuted with the hypothesis, too; `proof` says why it is PROVED without.
    """

    label: str
    verdict: Answered | None
    case: Case | None
    undefined: str = ""
    informs: bool = True
    proof: Proof | None = None

    @property
    def words(self) -> str:
        """This says what the hypothesis is worth."""
        match self.verdict:
            case None:
                return f"the conclusion has no value without it: {self.undefined}"
            case Answered.REFUTED:
                return f"needed: without it {self.case} refutes the claim" if self.informs else "the claim is refuted with it, too"
            case Answered.VACUOUS:
                return "without it nothing meets the others either"
            case Answered.PROVED if self.proof is not None:
                return f"not needed: without it the claim {self.proof.words}"
        return "not shown to be needed: nothing that was tried refutes the claim without it"


@dataclass(frozen=True, repr=False)
class ClaimAnswer(Shown):
    """The verdict on a claim over one field, with the system that refutes it and what was tried: an entry of ClaimAnswers.

    `verdict` is "REFUTED", "NOT REFUTED", "VACUOUS" or "PROVED", and `proof.theorems` then has the names of Rocq's theorems with their
    locks. `counterexample` is None, or has the `system` (the `case`, where the claim is about two), the dict `quantities` of what the
    claim reads of it, and `certificates`; `tried` has the number of systems that were gone through and of those that meet the hypotheses;
    `dropped` is what becomes of the claim without each hypothesis, None where that was not asked; `expected` is the verdict that was
    expected, None where none was. Source: [F75], [VD79] for what is asked of every window. Raises nothing by itself.

    >>> import faultspace as fs
    >>> found = fs.claim("finite_zeros == 0", hypotheses=["minimal"], box={"total": 3}).answers[0]
    >>> str(found.verdict), found.tried.met, dict(found.counterexample.quantities)
    ('REFUTED', 36, {'minimal': True, 'finite_zeros': 1})
    """

    id: str
    field: str
    statement: str
    source: str
    hypotheses: tuple[str, ...]
    conclusion: str
    verdict: Answered
    counterexample: Counterexample | None
    tried: Tried
    dropped: tuple[Dropped, ...] | None
    expected: Answered | None
    seconds: float
    proof: Proof | None = None

    @property
    def as_expected(self) -> bool:
        """Whether the verdict is the one that was expected, if one was; what is PROVED is NOT REFUTED, too."""
        return self.expected in (None, self.verdict) or (self.verdict, self.expected) == (Answered.PROVED, Answered.NOT_REFUTED)

    @property
    def title(self) -> str:
        """The verdict on the claim."""
        over = "" if self.field == "Q" else f" over {self.field}"
        return f"{self.id}{over}: {self.verdict}" + ("" if self.as_expected else f", expected {self.expected}")

    def sheet(self) -> Iterator[tuple[str, str]]:
        """These pairs are all that was found out."""
        if self.statement:
            yield "statement", self.statement
        if self.source:
            yield "source", self.source
        for k, text in enumerate(self.hypotheses):
            yield "" if k else "hypotheses", text
        yield "conclusion", self.conclusion
        if self.proof is not None:
            yield "proof", self.proof.words
        if self.verdict == Answered.VACUOUS:
            yield "vacuous", "nothing that was tried meets the hypotheses"
        if (found := self.counterexample) is not None:
            kind = "smallest counterexample" if found.smallest else "counterexample, not from the box"
            yield kind, str(found.case)
            for name, value in found.words:
                yield f"  {name}", value
            yield "certificates", f"{counted(len(found.certificates), 'certificate')}, accepted by the checker"
            for one in found.certificates:
                yield f"  {one['kind']}", sha256(one)[:12]
        yield "tried", self.tried.words
        for without in self.dropped or ():
            yield f"without {without.label}", without.words
        yield "seconds", f"{self.seconds:.1f}"

    def to_json(self) -> dict[str, Any]:
        """Return one entry of "claims" in the JSON answer."""
        found = self.counterexample
        tried = {name: getattr(self.tried, name) for name in self.tried.__dataclass_fields__}
        answer: dict[str, Any] = {"id": self.id, "field": self.field, "verdict": str(self.verdict)}
        answer["expected"] = None if self.expected is None else str(self.expected)
        answer["theorems"] = {} if self.proof is None else dict(self.proof.theorems)
        answer["smallest"] = None if found is None else found.to_json()
        answer["tried"] = tried
        answer["hypotheses"] = [
            {
                "dropped": one.label,
                "verdict": None if one.verdict is None else str(one.verdict),
                "system": None if one.case is None else one.case.to_json(),
            }
            for one in self.dropped or ()
        ]
        answer["certificates"] = [] if found is None else [sha256(one) for one in found.certificates]
        return answer


@dataclass(frozen=True, repr=False)
class ClaimAnswers(Shown):
    """The verdicts on one claim or on the claims of a file, over each field; `fs.claim` returns it.

    `answers` has a ClaimAnswer for each claim and field, with `verdict`, `counterexample` and `tried`; `as_expected` says whether each
    verdict is the one that was expected, where one was; `certificates`, each a dict, are those of all counterexamples. Source: [F75] and
    [VD79] for what is asked of every window. Raises nothing by itself.

    >>> import faultspace as fs
    >>> found = fs.claim("delay_known <= n - nullity(G)", hypotheses=["left_invertible"], ablation=False)
    >>> found
    <ClaimAnswers: claim: REFUTED>
    >>> print(found.answers[0].counterexample.system)
    A=[[-1]], F=[[-1]], C=[[-1]], G=[[0]]
    """

    answers: tuple[ClaimAnswer, ...]

    @property
    def as_expected(self) -> bool:
        """Whether each verdict is the expected one."""
        return all(one.as_expected for one in self.answers)

    @property
    def certificates(self) -> tuple[Certificate, ...]:
        """These bear the quantities of the counterexamples, each accepted by the checker."""
        return tuple(one for answer in self.answers if answer.counterexample for one in answer.counterexample.certificates)

    @property
    def title(self) -> str:
        """The verdict, or how many claims got each."""
        if len(self.answers) == 1:
            return self.answers[0].title
        counts = ((verdict, sum(one.verdict == verdict for one in self.answers)) for verdict in Answered)
        return f"{counted(len(self.answers), 'answer')}: {', '.join(f'{count} {verdict}' for verdict, count in counts if count)}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """These pairs are those of every claim, below its verdict."""
        for one in self.answers:
            if len(self.answers) > 1:
                yield one.title, ""
            yield from one.sheet()

    def to_json(self) -> dict[str, Any]:
        """Return what `faultspace claim --json` prints."""
        return {"claims": [one.to_json() for one in self.answers]}


def _json(value: Any) -> Any:
    if isinstance(value, tuple):
        return list(value)
    return None if isinstance(value, float) and isinf(value) else value


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"[{', '.join(map(str, value))}]" if isinstance(value, tuple) else str(value)
