"""The hypotheses of the claims about two systems: theorem-1 on a window, theorem-3 (i) on every window.

Compared       a pair of systems that agree on a window, by accepted certificates
theorem_1      equal on the window, so equal for ever?
theorem_3_i    equal for ever: do the second's fault columns lie in the first's Z, once its state is changed in some way?
same_model     equal for ever: is the second (A, Fhat P, C, Ghat P), once its state is changed in some way?
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from itertools import chain

from ...exact.algebra.matrices import Matrix, column_basis, rank, stacked
from ...exact.structure.fault_columns import fault_space
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import window_matrix
from ..boxes.box import Box, grouped
from ..evidence.alternatives import ALTERNATIVES, PAIRS, PairEvidence, comparison_certificate, examine_pair
from ..evidence.material import Material
from ..evidence.subjects import kernel_once, space_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.ablation import Ablation, Found, Proof, first_found
from ..verdict.workbench import Workbench
from .changes_of_state import columns_moved, equivalent_pairs, moved, similarity
from .facets import aimed_systems, degenerate, expressions, facets, other_columns

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=5)
SMALLER = Box(n=(1, 1), m=(1, 2), p=(1, 2), total=4)


@dataclass(frozen=True)
class Compared:
    """Two systems whose behaviours agree on `window` samples, for ever where it is None; `equal` says whether they do for ever."""

    first: ResidualSystem
    second: ResidualSystem
    window: int | None
    equal: bool
    weight: int
    accepted: frozenset[str]

    @property
    def size(self) -> tuple[int, ...]:
        """The sum of both n + m + p, then the first's n, m, p, then the window."""
        one, two = self.first, self.second
        return (one.n + one.m + one.p + two.n + two.m + two.p, one.n, one.m, one.p, self.window or 0)

    @property
    def field(self) -> str:
        """The field in words, as it is printed."""
        return str(self.first.field)

    @property
    def both(self) -> tuple[ResidualSystem, ResidualSystem]:
        """The two systems, the first one first."""
        return self.first, self.second

    @cached_property
    def degenerate(self) -> str:
        """Why it would be a poor witness: one of the systems is one, or all outputs are possible and all columns lie in Z."""
        everything = "every output is possible" if facets(self.first).normal_rank == self.first.p else ""
        return degenerate(self.first) or degenerate(self.second) or everything

    @cached_property
    def similarity(self) -> Matrix | None:
        """T with A T = T A' and C T = C', invertible, where (A', C') of the second is similar to (A, C) of the first."""
        return similarity(self.first, self.second)

    def __str__(self) -> str:
        window = "" if self.window is None else f", equal on {self.window} samples"
        return f"{self.first} against {self.second}{window}"


def same_a_and_c(pair: Compared) -> bool:
    """Return whether the two systems share A and C."""
    return pair.first.A == pair.second.A and pair.first.C == pair.second.C


ALONE = {"both observable", "both controllable", "both left-invertible", "both A stable"}
SIMILAR = "(A', C') similar to (A, C)"
MODEL: dict[str, Callable[[Compared], bool]] = {
    "both observable": lambda c: all(facets(s).observable for s in c.both),
    "both controllable": lambda c: all(facets(s).controllable for s in c.both),
    "both left-invertible": lambda c: all(facets(s).left_invertible for s in c.both),
    "both A stable": lambda c: all(facets(s).stable for s in c.both),
}


def theorem_1() -> Ablation[Compared]:
    """Return the ablation of the claim that behaviours equal on a window of n + 1 samples are equal for ever."""

    def long_enough(pair: Compared) -> bool:
        return pair.window is not None and pair.window >= max(pair.first.n, pair.second.n) + 1

    return Ablation(
        name="equal-on-a-window",
        claim="theorem-1",
        conclusion="behaviours equal on the window are equal for ever",
        hypotheses={"same (A, C)": same_a_and_c, **MODEL, "window >= n + 1": long_enough},
        holds=lambda pair: pair.equal,
        subjects=_agreeing,
        over_q=_smallest_agreeing,
        show=_show_difference,
        proof=Proof(("theorem_1_lag", "lag_at_most_n"), frozenset({"window >= n + 1"})),
    )


def theorem_3_i() -> Ablation[Compared]:
    """Drop hypotheses of: the columns of an equivalent system with as many states lie in Z after some change of its state."""
    words = "the columns [T F'; G'] of an equivalent system with as many states lie in Z, for some change T of its state"
    return _of_equivalent("columns-in-Z", words, _columns_in_space, Proof(("columns_after_change_of_state",)))


def same_model() -> Ablation[Compared]:
    """The ablation of the claim that (A, C) is the same as well, which the outputs alone do not tell."""
    words = "an equivalent system is (A, Fhat P, C, Ghat P), after some change of its state"
    # The theorem is about the second system in the coordinates where it has the (A, C) of the first.
    return _of_equivalent("same-model", words, _same_model, Proof(("theorem_3_part_i",), frozenset({SIMILAR})))


def _of_equivalent(name: str, words: str, holds: Callable[[Compared], bool], proof: Proof) -> Ablation[Compared]:
    return Ablation(
        name=name,
        claim="theorem-3-i",
        conclusion=words,
        hypotheses={SIMILAR: lambda pair: pair.similarity is not None, **MODEL},
        holds=holds,
        subjects=_equivalent,
        over_q=partial(_smallest_outside, holds),
        show=_show_outside,
        proof=proof,
    )


def _columns_in_space(pair: Compared) -> bool:
    T = columns_moved(pair.first, pair.second)
    return T is not None and columns_in_space(pair.first, moved(pair.second, T))


def _same_model(pair: Compared) -> bool:
    """Return whether the columns of the second lie in Z in the coordinates in which it has the (A, C) of the first."""
    return pair.similarity is not None and columns_in_space(pair.first, moved(pair.second, pair.similarity))


def columns_in_space(first: ResidualSystem, second: ResidualSystem) -> bool:
    """Return whether the columns [F'; G'] of the second solve problem (11) of the first."""
    basis = space_once(first).basis
    return rank(stacked(basis, stacked(second.F, second.G).transposed())) == basis.nrows


def _agreeing(bench: Workbench) -> Iterator[Compared]:
    """Yield every pair that agrees on s samples, for each s where it does up to n + 2."""
    bench.need(PAIRS, MADE)
    for d in (*bench.pairs, *bench.material(MADE)):
        last = max(d.first.n, d.second.n) + 2 if d.first_difference is None else d.first_difference - 1
        for s in range(1, last + 1):
            yield Compared(d.first, d.second, s, d.first_difference is None, d.weight, d.accepted)


def _equivalent(bench: Workbench) -> Iterator[Compared]:
    """Yield pairs with equal behaviours and as many states, with other fault matrices for the same (A, C) or with other (A, C)."""
    bench.need(ALTERNATIVES, PAIRS, MADE)
    for alternative in bench.alternatives:
        if alternative.equal:
            yield Compared(alternative.system, alternative.alternative, None, True, alternative.weight, alternative.accepted)
    for pair in (*bench.pairs, *bench.material(MADE)):
        if pair.first_difference is None and pair.first.n == pair.second.n:
            yield Compared(pair.first, pair.second, None, True, pair.weight, pair.accepted)


def _sources(bench: Workbench) -> Iterator[tuple[ResidualSystem, ResidualSystem]]:
    """Yield equivalent pairs whose (A, C) differ, and aimed systems with other fault columns of Z for the same (A, C)."""
    others, aimed = (800, 100) if bench.full else (80, 16)
    return chain(equivalent_pairs(others), ((system, other_columns(system)) for system in aimed_systems(aimed)))


def _examined(pair: tuple[ResidualSystem, ResidualSystem]) -> list[PairEvidence]:
    return [examine_pair("made on purpose", *pair)]


MADE = Material("equivalent pairs", "comparing pairs made on purpose", _sources, _examined, 40)


@lru_cache(maxsize=1 << 14)  # the same small systems are gone through for each hypothesis that is dropped
def _outputs(system: ResidualSystem, s: int) -> Matrix:
    """Return the column space of [O_s T_s]."""
    return column_basis(window_matrix(system, s))


def _kept(dropped: Sequence[str]) -> tuple[str, ...]:
    return expressions(ALONE - set(dropped), "both ")


def _words(box: Box) -> str:
    return f"{box}, both of the same dimensions"


def _smallest_agreeing(bench: Workbench, dropped: Sequence[str]) -> Found[Compared]:
    """The first system with a partner equal on n samples (n + 1, where that is kept) and not for ever, decided on 2n + 1."""
    extra = 0 if "window >= n + 1" in dropped else 1
    box = BOX if extra == 0 else SMALLER

    def key(system: ResidualSystem) -> object:
        shared = None if "same (A, C)" in dropped else (system.A, system.C)
        return shared, _outputs(system, system.n + extra)

    def counterexamples(poor: bool) -> Iterator[Compared]:
        for first, group in grouped(box, key, *_kept(dropped)):
            if len(group) > 1 and (poor or not degenerate(first)):
                longer = _outputs(first, 2 * first.n + 1)
                for second in group:
                    pair = Compared(first, second, first.n + extra, False, 1, frozenset())
                    if bool(pair.degenerate) == poor and _outputs(second, 2 * first.n + 1) != longer:
                        yield pair

    return first_found(counterexamples, _words(box))


def _smallest_outside(holds: Callable[[Compared], bool], bench: Workbench, dropped: Sequence[str]) -> Found[Compared]:
    """Return the first system with an equivalent one for which the conclusion fails."""

    def counterexamples(poor: bool) -> Iterator[Compared]:
        for first, group in grouped(SMALLER, lambda s: _outputs(s, 2 * s.n + 1), *_kept(dropped)):
            for second in group:
                pair = Compared(first, second, None, True, 1, frozenset())
                kept = SIMILAR in dropped or pair.similarity is not None
                if bool(pair.degenerate) == poor and kept and not holds(pair):
                    yield pair

    return first_found(counterexamples, _words(SMALLER))


def _of_each(pair: Compared) -> Iterator[Certificate]:
    for system in pair.both:
        kernel = kernel_once(system)
        yield make.left_invertible(kernel)
        yield make.matrix_rank("observability", system)
        yield make.matrix_rank("reachability", system)


def _show_difference(pair: Compared) -> Iterator[Certificate]:
    kernels = kernel_once(pair.first), kernel_once(pair.second)
    yield make.window_equality(*kernels, pair.window or 0)
    yield comparison_certificate(*kernels)
    yield from _of_each(pair)


def _show_outside(pair: Compared) -> Iterator[Certificate]:
    kernels = kernel_once(pair.first), kernel_once(pair.second)
    yield comparison_certificate(*kernels)
    yield make.fault_space(kernels[0], fault_space(kernels[0]))
    yield from _of_each(pair)
