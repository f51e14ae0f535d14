"""Search the minimum of a weighted reduction: from several starts, up a ladder of weights, for one order or for all from 0 on.

What a flat weight cannot tell apart the true one can: the ladder may merge all starts into one valley. So some starts are followed under
the true weight at once, and models of one state more, in which all modes of the plant and a spare one have found a place, lose one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ....base.arrays import Array
from ....base.errors import InvalidData
from .arx import Arx
from .arx_windows import ArxWindows
from .reduction_starts import one_state_less, starts
from .weighted_reduction import Reduction, arrived, descend, ladder

# One or three starts kept give the same errors (`--calibrate starts`); budgets only bound the time of the search, whose end is `arrived`.
KEPT = 2  # starts that are followed up the ladder
NEAREST = 2  # starts of the least cost under the true weight that are followed without the ladder
RUNGS, TRUE = (15, 1e-3), (25, 1e-4)  # most steps, and relative gain of a step below which a descent ends
DISTINCT = 1e-2  # relative difference of costs from which two starts are thought to lie in different valleys
PATIENCE = 4  # orders in a row that do not better the criterion: a resonance takes two states, two of them four


@dataclass(frozen=True, eq=False)
class Found:
    """T = `matrix` (n + p, n + n_u) has this cost."""

    matrix: Array
    cost: float


def minimum(windows: ArxWindows, arx: Arx, problem: Reduction, coarse: Reduction, n: int) -> Found:
    """Return T and cost of the least that was found at one order. The search uses the `coarse` problem of few angles, and only its end is
    the problem itself. Raises InvalidData where there is nothing to start from.
    """
    rungs = list(ladder(coarse, arx.disturbance(coarse.angles)))
    begun = list(starts(windows, arx, rungs[0], n))
    found = _climbed(rungs, begun, n, KEPT)
    longer = _climbed(rungs, starts(windows, arx, rungs[0], n + 1), n + 1, 1) if n else []
    found += _nearest(coarse, begun + [less for one in longer for less in one_state_less(one.matrix, n + 1, coarse)], n, TRUE)
    if not found:
        raise InvalidData(
            f"no model of order {n} can be begun, since the data show no dynamics for it: state a lower order, or record more"
        )
    return Found(*arrived(problem, _least(found).matrix, n))


def minima(windows: ArxWindows, arx: Arx, problem: Reduction, coarse: Reduction, penalty: float) -> list[Found]:
    """Return the minima at orders 0, 1, .., up to that of the ARX model, as far as cost + penalty order improves in PATIENCE orders."""
    rungs = list(ladder(coarse, arx.disturbance(coarse.angles)))
    found: list[Found] = []
    best, since = float("inf"), 0
    for n in range(arx.order * windows.p + 1):
        begun = list(starts(windows, arx, rungs[0], n))
        here = _climbed(rungs, begun, n, 1) + _nearest(coarse, begun, n, TRUE)
        if not here:
            break
        found.append(_least(here))
        criterion = found[-1].cost + penalty * n
        best, since = (criterion, 0) if criterion < best else (best, since + 1)
        if since == PATIENCE:
            break
    for n in range(len(found) - 2, -1, -1):
        less = list(one_state_less(found[n + 1].matrix, n + 1, coarse))
        found[n] = _least([found[n], *_nearest(coarse, less, n, TRUE)])
    return [Found(*descend(problem, one.matrix, n, *TRUE)) for n, one in enumerate(found)]


def _least(found: Iterable[Found]) -> Found:
    return min(found, key=lambda one: one.cost)


def _nearest(problem: Reduction, begun: Sequence[Array], n: int, budget: tuple[int, float]) -> list[Found]:
    """Return the ends of the NEAREST starts of least cost, followed under the true weight."""
    near = sorted(begun, key=lambda start: problem.cost(start, n))[:NEAREST]
    return [Found(*descend(problem, start, n, *budget)) for start in near]


def _climbed(rungs: Sequence[Reduction], begun: Iterable[Array], n: int, kept: int) -> list[Found]:
    """Return the ends of the ladder from the `kept` best distinct starts, the least cost first."""
    distinct: list[Found] = []
    for one in sorted((Found(*descend(rungs[0], start, n, *RUNGS)) for start in begun), key=lambda one: one.cost):
        if all(one.cost - other.cost > DISTINCT * one.cost for other in distinct):
            distinct.append(one)
    ends = []
    for one in distinct[:kept]:
        matrix = one.matrix
        for rung in rungs[1:-1]:
            matrix, _ = descend(rung, matrix, n, *RUNGS)
        ends.append(Found(*descend(rungs[-1], matrix, n, *TRUE)))
    return sorted(ends, key=lambda one: one.cost)
