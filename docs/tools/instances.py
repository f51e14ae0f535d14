"""The smallest cases that meet what a reading of the ledger supposes, so that nobody has to ask whether it is empty.

    meeting     the smallest case of a reading's box over Q that meets its hypotheses, and that of an implication which it concludes
    supposed    what a conclusion supposes itself: P of "implies(P, R)", some P of "all(implies(P, R) for s in windows(a))"

A reading that the language of claims can say is a text, and a case that meets it is found as a counterexample is: by the search through
the box for one that refutes "False". Cases whose C or F is zero are left out, in every system that the reading names, for they say little.
Where the reading is refuted the case fails its conclusion, and is the counterexample.
"""

from __future__ import annotations

import ast
from functools import cache

from faultspace.base.progress import silent
from faultspace.proofs.brought.claims import Claim, make_claim
from faultspace.proofs.brought.readings import MOST, readings
from faultspace.proofs.brought.trying import Question, search
from faultspace.proofs.quantities.cases import Case

SYSTEMS = {"system": ("",), "pair": ("first.", "second."), "pair with the same (A, C)": ("first.", "second."), "choice": ("",)}
OF_A_RECORD = ("inputs.",)


@cache
def meeting(name: str, *, refuted: bool) -> Case | None:
    """Return the smallest case that meets what the reading "CLAIM--READING" supposes, and fails its conclusion where it is `refuted`; None
    where the box has none. Raises KeyError for a reading that the language does not say."""
    claim = readings()[name]
    *hypotheses, conclusion = _supposing(claim).nodes
    question = Question(tuple(hypotheses), claim.conclusion if refuted else conclusion)
    return search(claim.boxes["Q"], [question], most=MOST, jobs=1, progress=silent).found[0].failing


def supposed(conclusion: str) -> list[str]:
    """Return what the conclusion supposes, as texts of the language: one, or none."""
    match ast.parse(f"({conclusion})", mode="eval").body:
        case ast.Call(ast.Name("implies"), [before, _]):
            return [ast.unparse(before)]
        case ast.Call(ast.Name("all"), [ast.GeneratorExp(ast.Call(ast.Name("implies"), [before, _]), [over])]):
            return [ast.unparse(ast.Call(ast.Name("any"), [ast.GeneratorExp(before, [over])], []))]
    return []


def _supposing(claim: Claim) -> Claim:
    """Return the claim that nothing meets what this one supposes."""
    own = [f"not is_zero({one}{block})" for one in SYSTEMS.get(claim.about, OF_A_RECORD) for block in "CF"]
    asked = [*(one.that.text for one in claim.hypotheses), *supposed(claim.conclusion.text), *own]
    return make_claim(claim.id, {"about": claim.about, "hypotheses": asked, "conclusion": "False"})
