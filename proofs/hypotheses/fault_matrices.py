"""This drops hypotheses of theorem-3 (ii): when does a pair (Fhat P, Ghat P), from problem (11) at a window, give the same outputs?

Pair          a system, other fault matrices whose columns solve problem (11) at a window, and whether the outputs are the same
theorem_3_ii  equivalent: from a window of lag + 1 on, for P such that the normal rank stays
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from random import Random

from ...exact.algebra.matrices import Matrix, rank, stacked
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order, matrices_in_order
from ..evidence.alternatives import ALTERNATIVES, AlternativeEvidence, comparison_certificate, examine_alternative
from ..evidence.material import Material
from ..evidence.subjects import kernel_once, space_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.ablation import Ablation, Found, Proof, first_found
from ..verdict.workbench import Workbench, size
from .facets import aimed_systems, degenerate, expressions, facets, of_system

BOX = Box(n=(1, 1), m=(1, 2), p=(1, 2), total=5)


@dataclass(frozen=True)
class Pair:
    """A system and other fault matrices for its (A, C), as a subject.

    `alternative` has the (A, C) of `system` and columns [F'; G'] that solve its problem (11) at the window.
    """

    system: ResidualSystem
    alternative: ResidualSystem
    window: int
    equal: bool
    weight: int
    accepted: frozenset[str]

    @property
    def size(self) -> tuple[int, ...]:
        """The numbers n + m + p, then n, m, p, then the window."""
        return (*size(self.system), self.window)

    @property
    def field(self) -> str:
        """The field in words, as it is printed."""
        return str(self.system.field)

    @property
    def degenerate(self) -> str:
        """Why it would be a poor witness: the system is one, or P is not of full column rank."""
        return degenerate(self.system) or degenerate(self.alternative)

    def __str__(self) -> str:
        return f"{self.system} with F' = {self.alternative.F}, G' = {self.alternative.G}, s = {self.window}"


GOOD = "P good: normal rank r"
HYPOTHESES: dict[str, Callable[[Pair], bool]] = {
    **of_system(lambda x: x.system),
    "s >= lag + 1": lambda x: x.window >= facets(x.system).lag + 1,
    "P of full column rank": lambda x: rank(stacked(x.alternative.F, x.alternative.G)) == x.alternative.m,
    GOOD: lambda x: facets(x.alternative).normal_rank == facets(x.system).normal_rank,
}


def theorem_3_ii() -> Ablation[Pair]:
    """Return the ablation of the claim that the pair is equivalent to the system."""
    return Ablation(
        name="equivalent-pair",
        claim="theorem-3-ii",
        conclusion="(A, Fhat P, C, Ghat P) has the same output behaviour",
        hypotheses=HYPOTHESES,
        holds=lambda pair: pair.equal,
        subjects=_subjects,
        over_q=_smallest,
        show=_show,
        proof=Proof(("theorem_3_criterion",), frozenset({"s >= lag + 1", GOOD})),
        implied={
            "P of full column rank": "the system being left-invertible, a good pair has normal rank m, so its m columns are independent"
        },
    )


def _subjects(bench: Workbench) -> Iterator[Pair]:
    """Yield alternatives with columns in Z at lag + 1, the others at the longest window whose solutions they are, if there is one."""
    bench.need(ALTERNATIVES, AIMED_ALTERNATIVES)
    for d in (*bench.alternatives, *bench.material(AIMED_ALTERNATIVES)):
        window = facets(d.system).lag + 1 if d.in_space else _longest(d.system, d.alternative)
        if window:
            yield Pair(d.system, d.alternative, window, d.equal, d.weight, d.accepted)


def _aimed(bench: Workbench) -> Iterator[ResidualSystem]:
    return aimed_systems(150 if bench.full else 12)


def _examined(system: ResidualSystem) -> list[AlternativeEvidence]:
    """Return two random P of m columns for a system; they are bad for some and good for most."""
    found = []
    space, rng = space_once(system), Random(str(system))
    for _ in range(2):
        rows = [[rng.choice((-2, -1, 0, 0, 1, 2)) for _ in range(system.m)] for _ in range(space.dimension)]
        found.append(examine_alternative("aimed", system, with_pair(space, Matrix.of(rows, shape=(space.dimension, system.m)))))
    return found


AIMED_ALTERNATIVES = Material("aimed alternatives", "trying aimed fault matrices", _aimed, _examined, 20)


def _longest(system: ResidualSystem, alternative: ResidualSystem) -> int:
    columns = stacked(alternative.F, alternative.G).transposed()
    kernel = kernel_once(system)
    for s in range(kernel.lag, 0, -1):
        basis = fault_space(kernel, s).basis
        if rank(stacked(basis, columns)) == basis.nrows:
            return s
    return 0


def _smallest(bench: Workbench, dropped: Sequence[str]) -> Found[Pair]:
    """Return the first system, window and P, in this order, that meets what is kept and is not equivalent."""
    kept = [test for name, test in HYPOTHESES.items() if name not in dropped]

    def counterexamples(poor: bool) -> Iterator[Pair]:
        for system in in_order(BOX, *expressions(set(HYPOTHESES) - set(dropped))):
            if degenerate(system) and not poor:
                continue
            kernel = kernel_once(system)
            for s in range(1 if "s >= lag + 1" in dropped else kernel.lag + 1, kernel.lag + 2):
                space = fault_space(kernel, s)
                for P in matrices_in_order(space.dimension, system.m):
                    pair = Pair(system, with_pair(space, P), s, False, 1, frozenset())
                    if bool(pair.degenerate) == poor and all(test(pair) for test in kept) and _differs(pair):
                        yield pair

    return first_found(counterexamples, f"{BOX}, entries of P in {{-1, 0, 1}}")


def _differs(pair: Pair) -> bool:
    return compare(kernel_once(pair.system), kernel_once(pair.alternative)).first_difference is not None


def _show(pair: Pair) -> Iterator[Certificate]:
    kernel, alternative = kernel_once(pair.system), kernel_once(pair.alternative)
    yield comparison_certificate(kernel, alternative)
    yield make.fault_space(kernel, fault_space(kernel, pair.window))
    yield make.window_ranks(kernel)
    yield make.window_ranks(alternative)
    yield make.matrix_rank("observability", pair.system)
    yield make.matrix_rank("reachability", pair.system)
