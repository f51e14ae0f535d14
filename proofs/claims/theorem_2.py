"""theorem-2: rank [O_s T_s] = n_x + s n_v - zeta, zeta the number of transmission zeros (stated for minimal systems)."""

from __future__ import annotations

from collections.abc import Iterator

from ...exact.algebra.matrices import column_basis, solve_left
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import reachability_matrix
from ..boxes.box import Box, in_order
from ..evidence.corpus import Evidence
from ..evidence.parametric import zero_count_claim
from ..evidence.questions import MINIMAL, ZEROS
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify, counterexample
from .common import identity, zeros

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)


def transfer_function_zeros(bench: Workbench) -> Outcome:
    """The formula is claimed with the zeros of the transfer function, for observable left-invertible systems, controllable or not."""

    def confirm(system: ResidualSystem) -> bool:
        statements = {c["kind"]: c["statement"] for c in _with_reachable_part(system)}
        part = statements["finite-zeros"], statements["infinite-zeros"]
        zeta = len(part[0]["invariant_zero_polynomial"]) - 1 + sum(part[1]["infinite_zero_orders"])
        ranks = statements["window-ranks"]["window_ranks"]
        return any(ranks[s - 1] != system.n + s * system.m - zeta for s in range(max(system.n, 1), len(ranks) + 1))

    sought = in_order(BOX, "observable and left_invertible and not controllable", reduced=True)
    found = next((system for system in sought if confirm(system)), None)
    if found is None:
        return certify(
            bench,
            (*MINIMAL, *ZEROS),
            lambda e: e.observable and e.left_invertible and e.controllable,
            lambda e: _formula(e, e.zeta, e.system.n),
            zeros,
        )
    return counterexample(f"{found}, whose transfer function is that of its reachable part", BOX, _with_reachable_part(found))


def parametric(bench: Workbench) -> Outcome:
    """With all entries indeterminate the formula holds on every stratum with r = m, where the zeros are counted on the pencil."""
    return identity(bench, zero_count_claim, [(1, 1, 1), (1, 2, 1), (1, 2, 2), (2, 1, 1)], [(2, 2, 1), (1, 3, 1), (2, 1, 2), (1, 3, 2)])


def _minimal(e: Evidence) -> bool:
    return e.left_invertible and e.observable and e.controllable


def _formula(e: Evidence, zeta: int, start: int) -> bool:
    return all(e.kernel.rank(s) == e.system.n + s * e.system.m - zeta for s in range(max(start, 1), max(start, e.system.n) + 3))


def _with_reachable_part(system: ResidualSystem) -> Iterator[Certificate]:
    """Certificates of the window ranks, and of the zeros of the reachable part, which is minimal where the system is observable."""
    yield from zeros(system)
    basis = column_basis(reachability_matrix(system))
    coordinates = [solve_left(basis.transposed(), part.transposed()) for part in (system.A @ basis, system.F)]
    if coordinates[0] is None or coordinates[1] is None:
        raise ArithmeticError("the reachable subspace is not invariant")
    part = ResidualSystem(coordinates[0].transposed(), coordinates[1].transposed(), system.C @ basis, system.G)
    yield make.finite_zeros(part)
    yield make.infinite_zeros(part)
    yield make.matrix_rank("observability", part)
    yield make.matrix_rank("reachability", part)
