"""The systems that claims are tried on, each with certificates that the checker has accepted: made once a run, read by every claim.

    Dossier      what accepted certificates say of one system: indices, zeros, delays, ranks, fault spaces
                 (`without_feedthrough`: the dimension of the members with g = 0)
    Corpus       all dossiers of a run, and in words how the systems were made
    examine      one system: certificates made, checked, and reduced to what they state
    build        the corpus of an effort, on all cores

A claim reads dossiers only, so that whatever it concludes rests on statements the checker accepted.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import Any

from joblib import Parallel, delayed

from ...exact.algebra.fields import QQ, Field, NumberField, PrimeField
from ...exact.algebra.matrices import Matrix, rank
from ...exact.structure.fault_columns import fault_space
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem, read_system
from ..trust import structure_certificates as make
from ..trust.structure_certificates import accept
from .exhaustive import orbits
from .families import adversarial, paper_example, random_systems

Progress = Callable[[str, int, int], None]
MAX_STATES_FOR_ZEROS = 4


@dataclass(frozen=True)
class Dossier:
    """Accepted statements about one system. `weight` is the number of systems it stands for (an orbit's size, else 1)."""

    origin: str
    data: dict[str, Any]
    weight: int
    n: int
    p: int
    m: int
    normal_rank: int
    left_minimal_indices: tuple[int, ...]
    right_minimal_indices: tuple[int, ...]
    window_ranks: tuple[int, ...]
    left_invertible: bool
    observable: bool
    controllable: bool
    delay_known_state: int | None
    delay_unknown_state: int | None
    finite_zeros: int | None
    infinite_zero_orders: tuple[int, ...] | None
    space_dimensions: tuple[int, ...]
    limit_dimension: int
    without_feedthrough: int
    accepted: int

    @property
    def lag(self) -> int:
        """The largest left minimal index, 0 where there is none."""
        return max(self.left_minimal_indices, default=0)

    @property
    def zeta(self) -> int | None:
        """Zeros of the pencil, finite and infinite, as certified on diagonal forms; None where those were not made."""
        if self.finite_zeros is None or self.infinite_zero_orders is None:
            return None
        return self.finite_zeros + sum(self.infinite_zero_orders)

    def rank(self, s: int) -> int:
        """rank [O_s T_s]."""
        return s * self.normal_rank + sum(min(s, eta) for eta in self.left_minimal_indices)

    def gap(self, s: int) -> int:
        """rank [O_(s+1) T_(s+1)] - rank [O_s T_s]."""
        return self.rank(s + 1) - self.rank(s)

    @cached_property
    def system(self) -> ResidualSystem:
        """The system itself, read back from the certificates' statement."""
        return read_system(self.data).residual


@dataclass(frozen=True)
class Corpus:
    """The dossiers of a run."""

    dossiers: tuple[Dossier, ...]

    @property
    def words(self) -> str:
        """How many systems of which origin."""
        return describe(self.dossiers)


def describe(dossiers: Iterable[Dossier]) -> str:
    """How the systems of these dossiers were made, with counts."""
    counts: Counter[str] = Counter()
    orbit_counts: Counter[str] = Counter()
    for d in dossiers:
        counts[d.origin] += d.weight
        orbit_counts[d.origin] += 1
    parts = []
    for origin, total in counts.items():
        here = orbit_counts[origin]
        parts.append(f"{origin} ({total} systems in {here} orbits)" if total != here else f"{here} {origin}")
    return "; ".join(parts)


def examine(origin: str, system: ResidualSystem, weight: int = 1) -> Dossier:
    """Certificates of everything the claims ask about a system, accepted by the checker, reduced to their statements."""
    kernel = kernel_representation(system)
    certificates: dict[str, dict[str, Any]] = {
        "ranks": make.window_ranks(kernel),
        "dual": make.window_ranks(kernel_representation(system.transposed())),
        "inversion": make.left_invertible(kernel),
        "known": make.inversion_delay(kernel, known_state=True),
        "unknown": make.inversion_delay(kernel, known_state=False),
        "observability": make.matrix_rank("observability", system),
        "reachability": make.matrix_rank("reachability", system),
        "limit": make.fault_space(kernel, fault_space(kernel)),
    }
    windows = range(1, system.n + 3)
    for s in windows:
        certificates[f"window {s}"] = make.fault_space(kernel, fault_space(kernel, s))
        certificates[f"rank {s}"] = make.matrix_rank("window", system, window=s)
    if system.n <= MAX_STATES_FOR_ZEROS:
        certificates["finite"] = make.finite_zeros(system)
        certificates["infinite"] = make.infinite_zeros(system)
    for certificate in certificates.values():
        accept(certificate)
    says = {name: certificate["statement"] for name, certificate in certificates.items()}
    return Dossier(
        origin=origin,
        data=says["ranks"]["system"],
        weight=weight,
        n=system.n,
        p=system.p,
        m=system.m,
        normal_rank=says["ranks"]["normal_rank"],
        left_minimal_indices=tuple(says["ranks"]["left_minimal_indices"]),
        right_minimal_indices=tuple(says["dual"]["left_minimal_indices"]),
        window_ranks=tuple(says[f"rank {s}"]["rank"] for s in windows),
        left_invertible=certificates["inversion"]["kind"] == "left-invertible",
        observable=says["observability"]["rank"] == system.n,
        controllable=says["reachability"]["rank"] == system.n,
        delay_known_state=says["known"]["delay"],
        delay_unknown_state=says["unknown"]["delay"],
        finite_zeros=len(says["finite"]["invariant_zero_polynomial"]) - 1 if "finite" in says else None,
        infinite_zero_orders=tuple(says["infinite"]["infinite_zero_orders"]) if "infinite" in says else None,
        space_dimensions=tuple(len(says[f"window {s}"]["basis"]) for s in windows),
        limit_dimension=len(says["limit"]["basis"]),
        without_feedthrough=_without_feedthrough(says["limit"]["basis"], system),
        accepted=len(certificates),
    )


def _without_feedthrough(basis: list[list[object]], system: ResidualSystem) -> int:
    """The dimension of the members (f, g = 0) of the space with this basis."""
    gains = Matrix.of([row[system.n :] for row in basis], system.field, shape=(len(basis), system.p))
    return len(basis) - rank(gains)


def build(effort: str, jobs: int, progress: Progress) -> Corpus:
    """The corpus of "quick" or "full"."""
    sources = list(_sources(effort))
    results: list[Dossier] = []
    batches = [sources[i : i + 40] for i in range(0, len(sources), 40)]
    stream = Parallel(n_jobs=jobs, return_as="generator")(delayed(_examine_all)(batch) for batch in batches)
    for batch in stream:
        results.extend(batch)
        progress("certifying the systems", len(results), len(sources))
    return Corpus(tuple(results))


def _examine_all(batch: list[tuple[str, ResidualSystem, int]]) -> list[Dossier]:
    return [examine(*item) for item in batch]


def _sources(effort: str) -> Iterator[tuple[str, ResidualSystem, int]]:
    yield "the paper's example", paper_example().residual, 1
    for _, system in adversarial():
        yield "named adversarial systems", system, 1
    full = effort == "full"
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
    """Largest n, p, m of the exhaustive box over GF(q)."""
    if q == 2:
        return (2, 3, 2) if full else (2, 2, 1)
    return (2, 2, 1) if full else (1, 2, 1)


def _box(q: int, full: bool) -> str:
    n, p, m = _limits(q, full)
    return f"n <= {n}, p <= {p}, m <= {m}"
