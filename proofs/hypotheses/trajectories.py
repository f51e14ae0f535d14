"""These are the hypotheses of the rank gap read off data: which trajectories show m = rank R_(s+1) - rank R_s?

Simulated              a system, an initial state, a fault signal, a window, and what accepted certificates say of the data
excited                with [X; V_(s+1)] of full row rank
persistently_excited   with v persistently exciting of order n + s + 1
"""

from __future__ import annotations

import random
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import islice

from ...exact.algebra.fields import QQ, Field
from ...exact.algebra.matrices import Matrix, rank
from ...exact.structure.signals import hankel, persistency, simulate
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.exhaustive import orbits
from ..evidence.families import adversarial, random_systems
from ..evidence.material import Material
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, accept
from ..verdict.ablation import Ablation, Found, Proof, first_found
from ..verdict.workbench import Workbench, size
from .facets import POOR, aimed_systems, degenerate, expressions, facets, of_system

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=5)


@dataclass(frozen=True)
class Simulated:
    """A trajectory of a system, as a subject.

    `gap` is rank R_(s+1) - rank R_s, `excitation` the rank of [X; V_(s+1)], both of certificates; `order` that of persistency of v.
    """

    system: ResidualSystem
    x0: Matrix
    v: Matrix
    window: int
    gap: int
    excitation: int
    order: int
    weight: int
    accepted: frozenset[str]

    @property
    def size(self) -> tuple[int, ...]:
        """The numbers n + m + p, then n, m, p, then the window, then the number of samples."""
        return (*size(self.system), self.window, self.v.nrows)

    @property
    def field(self) -> str:
        """The field in words, as it is printed."""
        return str(self.system.field)

    @property
    def degenerate(self) -> str:
        """This says why the system would be a poor witness."""
        return degenerate(self.system)

    def __str__(self) -> str:
        return f"{self.system}, x(0) = {self.x0}, v = {self.v}, s = {self.window}"


MODEL: dict[str, Callable[[Simulated], bool]] = {
    **of_system(lambda r: r.system),
    "s >= lag": lambda r: r.window >= facets(r.system).lag,
}
FULL_ROW_RANK = "[X; V_(s+1)] of full row rank"
PERSISTENT = "v persistently exciting of order n + s + 1"


def excited() -> Ablation[Simulated]:
    """Return the ablation with full row rank of [X; V_(s+1)], where the paper's assumption has s."""

    def full(record: Simulated) -> bool:
        return record.excitation == record.system.n + record.system.m * (record.window + 1)

    return _ablation("gap-on-data", {**MODEL, FULL_ROW_RANK: full}, "assumption_4_excitation_at_s_plus_1")


def persistently_excited() -> Ablation[Simulated]:
    """Return the ablation with persistency of v of order n + s + 1, whatever the modes that F does not reach do."""

    def persistent(record: Simulated) -> bool:
        return record.order >= record.system.n + record.window + 1

    return _ablation("gap-on-persistent-data", {**MODEL, PERSISTENT: persistent}, "assumption_4_persistency_suffices")


def _ablation(name: str, hypotheses: Mapping[str, Callable[[Simulated], bool]], theorem: str) -> Ablation[Simulated]:
    return Ablation(
        name=name,
        claim="assumption-4",
        conclusion="rank R_(s+1) - rank R_s = m",
        hypotheses=hypotheses,
        holds=lambda record: record.gap == record.system.m,
        subjects=_subjects,
        over_q=partial(_smallest, hypotheses),
        show=_certificates,
        proof=Proof((theorem,), frozenset(hypotheses) - {"observable", "controllable", "A stable"}),
    )


def signals(system: ResidualSystem, s: int, count: int) -> Iterator[tuple[Matrix, Matrix]]:
    """Yield pairs (x0, v): the zero state with a constant v and with a pulse, then `count` random ones, with entries in {-1, 0, 1}."""
    rng = random.Random(f"{system} {s}")
    samples = (system.m + 1) * (system.n + s + 1) + system.n + 2
    field: Field = system.field

    def made(state: list[int], rows: list[list[int]]) -> tuple[Matrix, Matrix]:
        x0 = Matrix.of([[x] for x in state], field, shape=(system.n, 1))
        return x0, Matrix.of(rows, field, shape=(samples, system.m))

    rest = [0] * system.n
    yield made(rest, [[1] * system.m] * samples)
    yield made(rest, [[int(k == 0)] * system.m for k in range(samples)])
    for _ in range(count):
        start = [rng.choice((0, 1, -1)) for _ in range(system.n)]
        yield made(start, [[rng.choice((-1, 0, 1)) for _ in range(system.m)] for _ in range(samples)])


def examined(system: ResidualSystem, x0: Matrix, v: Matrix, s: int, weight: int = 1) -> Simulated:
    """The subject of this trajectory, with its ranks certified."""
    bare = Simulated(system, x0, v, s, 0, 0, persistency(v), weight, frozenset())
    certificates = tuple(_data_ranks(bare))
    decided = frozenset(map(accept, certificates))
    before, after, excitation = (certificate["statement"]["rank"] for certificate in certificates)
    return replace(bare, gap=after - before, excitation=excitation, accepted=decided)


def _subjects(bench: Workbench) -> Iterator[Simulated]:
    return iter(bench.material(TRAJECTORIES))


def _sources(bench: Workbench) -> list[tuple[ResidualSystem, int, int]]:
    full = bench.full
    sources = [(system, 1) for _, system in adversarial() if 0 < system.n <= 3 and system.m]
    sources += [(s, 1) for s in islice(random_systems(QQ, 400, seed=5, largest=3), 300 if full else 12) if s.n and s.m]
    for n, p, m in ((1, 1, 1), (1, 2, 1), *(((2, 2, 1), (1, 2, 2)) if full else ())):
        sources += [(orbit.system, orbit.size) for orbit in orbits(2, n, p, m)]
    sources += [(system, 1) for system in aimed_systems(60 if full else 4)]
    return [(system, weight, 6 if full else 2) for system, weight in sources]


def _simulated(source: tuple[ResidualSystem, int, int]) -> list[Simulated]:
    system, weight, count = source
    windows = sorted({1, max(facets(system).lag, 1)})
    return [examined(system, x0, v, s, weight) for s in windows for x0, v in signals(system, s, count)]


TRAJECTORIES = Material("trajectories", "simulating", _sources, _simulated, 20)


def _smallest(hypotheses: Mapping[str, Callable[[Simulated], bool]], bench: Workbench, dropped: Sequence[str]) -> Found[Simulated]:
    """Return the first system and window, in this order, with one of the signals that meets what is kept and shows another gap."""
    kept = {name: test for name, test in hypotheses.items() if name not in dropped}

    def counterexamples(poor: bool) -> Iterator[Simulated]:
        for system in in_order(BOX, *_open_still(tuple(kept), poor)):
            lag = facets(system).lag
            for s in range(1 if "s >= lag" in dropped else max(lag, 1), max(lag, 1) + 1):
                for x0, v in _showing_another_gap(system, s):
                    record = examined(system, x0, v, s)
                    if record.gap != system.m and all(test(record) for test in kept.values()):
                        yield record

    return first_found(counterexamples, f"{BOX}, v constant, a pulse, or one of ten random signals, entries in {{-1, 0, 1}}")


def _open_still(kept: Collection[str], poor: bool) -> Iterator[str]:
    """Yield expressions that say which systems are degenerate, or are not, and may fail although they meet what is kept."""
    yield from expressions(kept)
    yield POOR if poor else f"not ({POOR})"
    if FULL_ROW_RANK in kept or PERSISTENT in kept:
        # Excited data show the model's gap, which is m from the lag on: there is nothing to find where the lag is 1 at most.
        yield "not (left_invertible and gap(1) == m)"


@lru_cache(maxsize=1 << 13)  # the same systems are gone through for each hypothesis that is dropped
def _showing_another_gap(system: ResidualSystem, s: int) -> tuple[tuple[Matrix, Matrix], ...]:
    """Return those of the signals that show another gap than m."""
    return tuple((x0, v) for x0, v in signals(system, s, 10) if _gap(system, x0, v, s) != system.m)


def _gap(system: ResidualSystem, x0: Matrix, v: Matrix, s: int) -> int:
    """Return rank R_(s+1) - rank R_s by exact ranks: a first look, which certifies nothing."""
    residuals = simulate(system, x0, v).residuals
    return rank(hankel(residuals, s + 1)) - rank(hankel(residuals, s))


def _data_ranks(record: Simulated) -> Iterator[Certificate]:
    for k in (record.window, record.window + 1):
        yield make.data_rank("residual-hankel", record.system, record.x0, record.v, k)
    yield make.data_rank("excitation", record.system, record.x0, record.v, record.window + 1)


def _certificates(record: Simulated) -> Iterator[Certificate]:
    yield from _data_ranks(record)
    yield make.matrix_rank("observability", record.system)
    yield make.matrix_rank("reachability", record.system)
