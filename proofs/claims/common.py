"""What several claims share: certificates about a system that show what they rest on, and tests of a system.

ranks_and_inversion    certificates of the window ranks, and of left-invertibility or its absence
delays                 these, and certificates of both delays of left inversion
zeros                  these, and certificates of the finite and the infinite zeros
spaces                 these, and certificates of the fault space at a window and in the limit
gap_is_m_from          whether the gap is m from a bound on
show_pair              certificates of a comparison of two systems, and of the window ranks of both
identity               the outcome of a parametric claim at several dimensions
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ...exact.parametric.stratification import Stratification, stratify
from ...exact.structure.fault_columns import fault_space
from ...exact.system.systems import ResidualSystem
from ..evidence.alternatives import PairEvidence, comparison_certificate
from ..evidence.corpus import Evidence
from ..evidence.parametric import Identity
from ..evidence.subjects import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Show, Test, Workbench


def ranks_and_inversion(system: ResidualSystem) -> Iterator[Certificate]:
    """Certificates of the window ranks, and of whether the system is left-invertible."""
    kernel = kernel_once(system)
    yield make.window_ranks(kernel)
    yield make.left_invertible(kernel)


def delays(system: ResidualSystem) -> Iterator[Certificate]:
    """Certificates of the window ranks, of left-invertibility, of observability and of both delays."""
    yield from ranks_and_inversion(system)
    yield make.matrix_rank("observability", system)
    kernel = kernel_once(system)
    yield make.inversion_delay(kernel, known_state=True)
    yield make.inversion_delay(kernel, known_state=False)


def zeros(system: ResidualSystem) -> Iterator[Certificate]:
    """Certificates of the window ranks, of left-invertibility, of the zeros, of observability and of controllability."""
    yield from ranks_and_inversion(system)
    yield make.finite_zeros(system)
    yield make.infinite_zeros(system)
    yield make.matrix_rank("observability", system)
    yield make.matrix_rank("reachability", system)


def spaces(window: Callable[[ResidualSystem], int]) -> Show:
    """Return a function that yields certificates of ranks, of left-invertibility, and of the fault space at the window and in the limit."""

    def show(system: ResidualSystem) -> Iterator[Certificate]:
        yield from ranks_and_inversion(system)
        kernel = kernel_once(system)
        yield make.fault_space(kernel, fault_space(kernel, window(system)))
        yield make.fault_space(kernel, fault_space(kernel))

    return show


def show_pair(record: PairEvidence) -> Iterator[Certificate]:
    """Yield certificates of whether the two systems have the same outputs, and of the window ranks of both."""
    kernels = kernel_once(record.first), kernel_once(record.second)
    yield comparison_certificate(*kernels)
    yield make.window_ranks(kernels[0])
    yield make.window_ranks(kernels[1])


Dimensions = tuple[int, int, int]


def identity(
    bench: Workbench, claim: Callable[[Stratification], Identity], quick: Sequence[Dimensions], full: Sequence[Dimensions]
) -> Outcome:
    """Return IDENTITY for a parametric claim at all these (n, p, m), or what it raises where a stratum or an expansion fails."""
    dimensions = [*quick, *full] if bench.full else list(quick)
    strata = expanded = 0
    for done, (n, p, m) in enumerate(dimensions):
        bench.progress(f"going through all parameter values, n={n} p={p} m={m}", done, len(dimensions))
        record = claim(stratify(n, p, m))
        strata, expanded = strata + record.strata, expanded + record.expanded
    listed = ", ".join(str(d).replace(" ", "") for d in dimensions)
    words = f"for all parameter values at (n,p,m) = {listed}: {strata} strata, {expanded} identities of sympy expanded again by FLINT"
    return Outcome(Verdict.IDENTITY, words)


def gap_is_m_from(bound: Callable[[Evidence], int]) -> Test:
    """Return a test that asks whether gap(s) = m for every s >= max(bound, 1)."""

    def holds(e: Evidence) -> bool:
        start = max(bound(e), 1)
        return all(e.kernel.gap(s) == e.system.m for s in range(start, max(start, e.system.n) + 2))

    return holds
