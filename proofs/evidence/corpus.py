"""The systems that claims are tried on, each with certificates that the checker has accepted: made once a run, read by every claim.

    Evidence     the Structure of a system as accepted certificates state it, with its origin and weight
    examine      one system: certificates made, checked, and read back into a structure
    CORPUS       all systems of an effort
    describe     how some of them were made, in words with counts

A claim reads evidence only, so that whatever it concludes rests on statements that the checker has accepted.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from ...exact.algebra.fields import QQ, Field, NumberField, PrimeField
from ...exact.algebra.matrices import Matrix, rank
from ...exact.structure.fault_columns import FaultSpace, fault_space
from ...exact.structure.kernel_rows import KernelRow, kernel_representation
from ...exact.structure.record import Structure
from ...exact.system.systems import ResidualSystem
from ..trust import structure_certificates as make
from ..trust.structure_certificates import accept
from .exhaustive import orbits
from .families import adversarial, paper_example, random_systems
from .material import Material


@dataclass(frozen=True, repr=False)
class Evidence(Structure):
    """This is the structure of a system as accepted certificates state it.

    `origin` says in words how the system was made, and `weight` how many systems it stands for (the size of an orbit, else 1).
    `window_ranks` are rank [O_s T_s] and `space_dimensions` the dimensions of problem (11) for s = 1, ..., n + 2, each from a certificate
    of its own, while those of `kernel` and `fault_space` follow from kernel rows. `accepted` counts the certificates.
    """

    origin: str
    weight: int
    window_ranks: tuple[int, ...]
    space_dimensions: tuple[int, ...]
    accepted: int

    @property
    def without_feedthrough(self) -> int:
        """This is the dimension of the members (f, g = 0) of the fault space."""
        return self.fault_space.dimension - rank(self.fault_space.G)


def describe(evidence: Iterable[Evidence]) -> str:
    """How these systems were made, with counts."""
    counts: Counter[str] = Counter()
    orbit_counts: Counter[str] = Counter()
    for one in evidence:
        counts[one.origin] += one.weight
        orbit_counts[one.origin] += 1
    parts = []
    for origin, total in counts.items():
        here = orbit_counts[origin]
        parts.append(f"{origin} ({total} systems in {here} orbits)" if total != here else f"{here} {origin}")
    return "; ".join(parts)


def examine(origin: str, system: ResidualSystem, weight: int = 1) -> Evidence:
    """Return certificates of everything that the claims ask about a system, accepted by the checker, read back into a structure.

    Raises checker.Rejected or checker.Malformed where the checker does not accept one, and ArithmeticError where two of them disagree.
    """
    kernel = kernel_representation(system)
    windows = range(1, system.n + 3)
    inversion, observability, reachability = (
        make.left_invertible(kernel),
        make.matrix_rank("observability", system),
        make.matrix_rank("reachability", system),
    )
    ranks, dual = make.window_ranks(kernel), make.window_ranks(kernel_representation(system.transposed()))
    known, unknown = (make.inversion_delay(kernel, known_state=is_known) for is_known in (True, False))
    finite, infinite = make.finite_zeros(system), make.infinite_zeros(system)
    limit = make.fault_space(kernel, fault_space(kernel))
    window_spaces = [make.fault_space(kernel, fault_space(kernel, s)) for s in windows]
    window_ranks = [make.matrix_rank("window", system, window=s) for s in windows]
    certificates = [
        inversion,
        observability,
        reachability,
        ranks,
        dual,
        known,
        unknown,
        finite,
        infinite,
        limit,
        *window_spaces,
        *window_ranks,
    ]
    for certificate in certificates:
        accept(certificate)

    field = system.field
    rows = tuple(KernelRow(row["pivot"], Matrix.of(row["coefficients"], field)) for row in ranks["witness"]["kernel"])
    basis = limit["statement"]["basis"]
    evidence = Evidence(
        kernel=replace(kernel, rows=rows),
        right_minimal_indices=tuple(dual["statement"]["left_minimal_indices"]),
        invariant_zero_polynomial=tuple(field.element(c) for c in finite["statement"]["invariant_zero_polynomial"]),
        infinite_zero_orders=tuple(infinite["statement"]["infinite_zero_orders"]),
        observable=observability["statement"]["rank"] == system.n,
        controllable=reachability["statement"]["rank"] == system.n,
        delay_known_state=known["statement"]["delay"],
        delay_unknown_state=unknown["statement"]["delay"],
        fault_space=FaultSpace(system, None, kernel.lag + 1, Matrix.of(basis, field, shape=(len(basis), system.n + system.p))),
        origin=origin,
        weight=weight,
        window_ranks=tuple(certificate["statement"]["rank"] for certificate in window_ranks),
        space_dimensions=tuple(len(certificate["statement"]["basis"]) for certificate in window_spaces),
        accepted=len(certificates),
    )
    if evidence.left_invertible != (inversion["kind"] == "left-invertible"):
        raise ArithmeticError(f"two accepted certificates disagree on whether {system} is left-invertible")
    return evidence


def _examined(item: tuple[str, ResidualSystem, int]) -> list[Evidence]:
    return [examine(*item)]


def _sources(bench: Any) -> Iterator[tuple[str, ResidualSystem, int]]:
    yield "the paper's example", paper_example().residual, 1
    for _, system in adversarial():
        yield "named adversarial systems", system, 1
    full = bench.full
    fields: list[tuple[Field, int]] = [
        (QQ, 3000 if full else 180),
        (NumberField(("-2", "0", "1")), 300 if full else 24),  # type: ignore[arg-type]
        (NumberField(("1", "-3", "-1", "4")), 300 if full else 24),  # type: ignore[arg-type]
        (PrimeField(5), 300 if full else 24),
    ]
    for field, count in fields:
        for system in islice(random_systems(field, count, seed=1), count):
            yield f"random systems of every structure over {field}", system, 1
    for q, n, p, m in _exhaustive_boxes(full):
        for orbit in orbits(q, n, p, m):
            yield f"all systems over GF({q}) in the box {_box(q, full)}", orbit.system, orbit.size
    for n, p in () if full else ((0, 2), (1, 2)):
        for orbit in orbits(2, n, p, 2):
            yield "all systems over GF(2) with n <= 1, p = 2, m = 2", orbit.system, orbit.size


def _exhaustive_boxes(full: bool) -> Iterator[tuple[int, int, int, int]]:
    for q in (2, 3):
        limits = _limits(q, full)
        for n in range(limits[0] + 1):
            for p in range(limits[1] + 1):
                for m in range(limits[2] + 1):
                    yield q, n, p, m


def _limits(q: int, full: bool) -> tuple[int, int, int]:
    """Return the largest n, p, m of the exhaustive box over GF(q)."""
    if q == 2:
        return (2, 3, 2) if full else (2, 2, 1)
    return (2, 2, 1) if full else (1, 2, 1)


def _box(q: int, full: bool) -> str:
    n, p, m = _limits(q, full)
    return f"n <= {n}, p <= {p}, m <= {m}"


CORPUS = Material("corpus", "certifying the systems", _sources, _examined, 40)
