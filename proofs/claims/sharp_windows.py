"""sharp-windows: the lag for the rank gap, one sample more for problem (11) and for equality; none of the three can be shortened."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import islice

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.structure.kernel_rows import KernelRepresentation
from ...exact.system.systems import ResidualSystem
from ..evidence.alternatives import comparison_certificate
from ..evidence.families import adversarial, random_systems
from ..evidence.kept_kernels import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, accept
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted
from .common import ranks_and_inversion


def equality_as_many_faults(bench: Workbench) -> Outcome:
    """A left-invertible system with m >= 1 and lag >= 1 has a partner that agrees with it on lag samples and differs on lag + 1.

    The partner has the same (A, C) and as many faults, and is left-invertible too.
    """
    systems = [s for _, s in adversarial() if s.n <= 6] + list(islice(random_systems(QQ, 4000, seed=13), 400 if bench.full else 24))
    headline: tuple[Certificate, ...] = ()
    tried, decided = 0, set[str]()
    for done, system in enumerate(systems):
        bench.progress("comparing partners that differ late", done, len(systems))
        kernel = kernel_once(system)
        if kernel.normal_rank < system.m or system.m == 0 or kernel.lag == 0:
            continue
        partner = _partner(kernel)
        if partner is None:
            return Outcome(Verdict.REFUTED, f"no partner found for {system}", accepted(ranks_and_inversion(system)), frozenset(decided))
        certificates = tuple(_show(kernel, partner))
        decided.update(map(accept, certificates))
        alike = all(certificate["kind"] == "left-invertible" for certificate in certificates[2:])
        if certificates[1]["statement"]["window"] != kernel.lag + 1 or partner.system.m != system.m or not alike:
            return Outcome(Verdict.ERROR, f"the partner of {system} is not as it was to be")
        tried += 1
        headline = headline or certificates
    words = f"no counterexample found: one partner each for {tried} systems, named and random over Q"
    return Outcome(Verdict.CERTIFIED, words, headline, frozenset(decided))


def _partner(kernel: KernelRepresentation) -> KernelRepresentation | None:
    """Return a system whose fault columns are moved by solutions of problem (11) on lag samples that are none on lag + 1."""
    system: ResidualSystem = kernel.system
    space, rng = fault_space(kernel, kernel.lag), random.Random(str(system))
    for _ in range(60):
        P = Matrix.of([[rng.randint(-2, 2) for _ in range(system.m)] for _ in range(space.dimension)], shape=(space.dimension, system.m))
        other = kernel_once(with_pair(space, P))
        alike = other.normal_rank == system.m and other.rank(kernel.lag) == kernel.rank(kernel.lag)
        if alike and compare(kernel, other).first_difference == kernel.lag + 1:
            return other
    return None


def _show(kernel: KernelRepresentation, partner: KernelRepresentation) -> Iterator[Certificate]:
    yield make.window_equality(kernel, partner, kernel.lag)
    yield comparison_certificate(kernel, partner)
    yield make.left_invertible(kernel)
    yield make.left_invertible(partner)
