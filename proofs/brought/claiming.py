"""Your own claim, decided: what `fs.claim` is, and what `faultspace claim` calls.

claim           one claim, given in Python
decide_claims   the claims of a file
explain         what each part of a claim is on a given system
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.progress import Progress, silent
from ...base.tasks import shared
from ...base.threads import one_thread
from ...exact.algebra.embeddings import RealField
from ...exact.system.systems import System
from ..language.evaluating import Asked, Exactly, evaluate, exactly, least_deciding
from ..language.nodes import Node, Undefined, variables
from ..language.vocabularies import SYSTEM
from ..quantities.cases import Case
from .answers import ClaimAnswers
from .case_files import at_root, fitting
from .claims import Claim, make_claim
from .deciding import decide
from .kept import Sharing, keeping

MOST = 10**9
Predicate = Callable[[Asked], bool]


@one_thread()
def claim(
    conclusion: str | Predicate,
    *,
    hypotheses: Sequence[str | Predicate] = (),
    fields: Sequence[str] = ("Q",),
    box: Mapping[str, Any] | None = None,
    about: str = SYSTEM,
    statement: str = "",
    source: str = "",
    ablation: bool = True,
    most: int = MOST,
    jobs: int = 1,
    on_progress: Progress | None = None,
) -> ClaimAnswers:
    """Decide a claim of your own about all systems x(k+1) = A x + F v, r = C x + G v: refuted by a counterexample, or not.

    The counterexample is the smallest of the box, where the box has one that was met.

    Each quantity of a counterexample comes with certificates, as far as the checker has a kind for it, and names what has none.
    Source: [F75], [VD79] for what is asked of every window.

    Parameters
    ----------
    conclusion : str or callable
        An expression of the language of `docs/your-claims.md`, "delay_known <= n" say, or a function of Python that takes an object with
        the same words and returns a bool: `lambda s: s.delay_known <= s.n`.
    hypotheses : list of str or callable
        Likewise.
    fields : list of str
        "Q", "GF(q)", and number fields such as "Q(a) with a^2 - 2 = 0".
    box : dict, optional
        "n", "m", "p" (first and last number of states, faults, outputs), "total" (the largest n + m + p) and "entries"; "k" of a choice,
        "nu" and "N" of a record.
    about : str
        "system"; "pair" or "pair with the same (A, C)" for two systems, as in `lambda s: s.equal or s.first_difference <= s.first.n + 1`;
        "choice" for a system and a P, "record" for a system and its data.
    statement, source : str
        Words that the answer repeats.
    ablation : bool
        Whether the claim is tried without each of its hypotheses, too.
    most : int
        The largest number of systems of the box that are gone through.
    jobs : int
        A number of processes.
    on_progress : callable, optional
        Called as (stage, done, total).

    Returns
    -------
    ClaimAnswers

    Raises
    ------
    InvalidInput
        For what is no expression, for an empty box, and where the claim has no value on a system, which it names.

    Examples
    --------
    >>> import faultspace as fs
    >>> found = fs.claim("all(gap(s) == m for s in windows(n))", hypotheses=["left_invertible"], box={"total": 4})
    >>> found.answers[0].verdict, found.answers[0].dropped[0].verdict
    (<Answered.PROVED: 'PROVED'>, <Answered.REFUTED: 'REFUTED'>)
    """
    given: dict[str, Any] = {"about": about, "conclusion": conclusion, "hypotheses": list(hypotheses), "fields": list(fields)}
    given |= {"statement": statement, "source": source} | ({} if box is None else {"box": box})
    return decide_claims([make_claim("claim", given)], ablation=ablation, most=most, jobs=jobs, on_progress=on_progress or silent)


def decide_claims(
    claims: Sequence[Claim],
    *,
    ablation: bool = True,
    most: int = MOST,
    jobs: int = 1,
    on_progress: Progress = silent,
    cluster: str | None = None,
    resume: Path | None = None,
) -> ClaimAnswers:
    """Return the verdict on each claim over each of its fields. Raises InvalidInput as `claim` does, and for numbers out of range.

    `cluster` is the address of a Dask scheduler, whose workers then go through large boxes; `resume` is a file that keeps what was gone
    through, so that the same call goes on where it was stopped.
    """
    for name, value in (("most", most), ("jobs", jobs)):
        if type(value) is not int or value < 1:
            raise InvalidInput(f"{name}: got {shorten(value)}, expected an integer >= 1")
    with keeping(resume) as kept, shared(cluster):
        sharing = Sharing(jobs, cluster, kept)
        answers = [one for given in claims for one in decide(given, ablation=ablation, most=most, progress=on_progress, sharing=sharing)]
    return ClaimAnswers(tuple(answers))


def explain(given: Claim, case: System | Case) -> Iterator[tuple[int, str, str]]:
    """Yield (level, text, value) for each part of the hypotheses and the conclusion that has a value of its own on a system, or a pair.

    A system over a number field, of which files hold no root, is taken with the first root of it that the claim names in its fields.
    Raises InvalidInput where it is no case of what the claim is about.
    """
    found = fitting(case.residual if isinstance(case, System) else case, given.about)
    for box in given.boxes.values():
        if isinstance(box.field, RealField):
            found = at_root(found, box.field)
    knows = exactly(found)
    for node in given.nodes:
        yield from _explained(node, knows, {}, 0)


def _explained(node: Node, knows: Exactly, bound: dict[str, int], level: int) -> Iterator[tuple[int, str, str]]:
    if node.op == "constant" or node.op == "variable":
        return
    if node.op in ("matrix", "transpose", "hstack", "vstack", "I", "zeros", "power") or node.op.startswith("matrix "):
        return
    try:
        value = str(evaluate(node, knows, bound))
    except Undefined as error:
        value = f"no value: {error}"
    here = "".join(f", {name} = {bound[name]}" for name in sorted(variables(node)))
    yield level, node.text + here, value
    if node.op in ("all", "any", "least") and len(node.args) >= 2:
        yield from _explained_window(node, knows, bound, level)
        return
    for part in node.args:
        yield from _explained(part, knows, bound, level + 1)


def _explained_window(node: Node, knows: Exactly, bound: dict[str, int], level: int) -> Iterator[tuple[int, str, str]]:
    """Explain the body at the window that decides: the first at which an `all` fails, or at which an `any` or `least` holds."""
    for part in node.args[:-1]:
        yield from _explained(part, knows, bound, level + 1)
    try:
        found = least_deciding(node, knows, bound)
    except Undefined:
        return
    if found is not None:
        yield from _explained(node.args[-1], knows, {**bound, node.value: found}, level + 1)
