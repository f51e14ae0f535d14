"""objection-3: proposition-3 uses theorem-2, stated for minimal systems, while assumption 4 does not ask (A, F) to be controllable."""

from __future__ import annotations

from ..corpus import Dossier
from ..families import paper_example
from ..verdicts import Outcome, Verdict
from ..workbench import Workbench, accepted, certify
from .common import gap_is_m_from, zeros


def controllability_needed(bench: Workbench) -> Outcome:
    """'Without controllability the gap formula fails': the paper's own example, not controllable, where it holds."""
    system = paper_example().residual
    shown = accepted(zeros(system))
    says = {c["kind"] + c["statement"].get("matrix", ""): c["statement"] for c in shown}
    ranks, m, n = says["window-ranks"]["window_ranks"], system.m, system.n
    uncontrollable = says["matrix-rankreachability"]["rank"] < n
    holds = all(ranks[s] - ranks[s - 1] == m for s in range(n, len(ranks)))
    verdict = Verdict.REFUTED if uncontrollable and holds else Verdict.CERTIFIED
    words = f"the example of the paper: (A,F) reaches {says['matrix-rankreachability']['rank']} of {n} dimensions, window ranks {ranks}"
    return Outcome(verdict, words, shown, len(shown))


def gap_without_controllability(bench: Workbench) -> Outcome:
    """Not controllable, left-invertible, s >= n: the gap is m all the same."""
    return certify(bench, lambda d: d.left_invertible and not d.controllable, gap_is_m_from(lambda d: d.n), zeros)


def ranks_without_minimality(bench: Workbench) -> Outcome:
    """Neither controllable nor observable, left-invertible: rank [O_s T_s] = n + s m - zeta for s >= lag, zeros of the pencil."""

    def holds(d: Dossier) -> bool:
        return all(d.rank(s) == d.n + s * d.m - (d.zeta or 0) for s in range(d.lag, d.n + 4))

    return certify(bench, lambda d: d.left_invertible and d.zeta is not None and not (d.controllable and d.observable), holds, zeros)
