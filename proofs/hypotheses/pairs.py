"""The hypotheses of the claims about two systems: theorem-1 on a window, theorem-3 (i) on every window.

    Compared      a pair of systems that agree on a window, by accepted certificates
    theorem_1     equal on the window, so equal for ever?
    theorem_3_i   equal for ever, so the second's fault columns lie in the first's Z?
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from ...exact.fault_space import fault_space
from ...exact.kernel_representation import kernel_representation
from ...exact.matrices import column_basis, rank, stacked
from ...exact.systems import ResidualSystem
from ...exact.windows import window_matrix
from .. import certificate as make
from ..ablation import Experiment, Found
from ..certificate import Certificate
from ..pairs import comparison_certificate
from ..search import Box, systems_in_order
from ..workbench import Workbench
from .facets import facets, flags

BOX = Box(total=5, largest_n=2, largest_m=2, largest_p=2)
SMALLER = Box(total=4, largest_n=1, largest_m=2, largest_p=2)


@dataclass(frozen=True)
class Compared:
    """Two systems whose behaviours agree on `window` samples; None: for ever. `equal`: they do for ever."""

    first: ResidualSystem
    second: ResidualSystem
    window: int | None
    equal: bool
    weight: int
    accepted: int

    @property
    def size(self) -> tuple[int, ...]:
        """Both n + m + p, then the first's n, m, p, then the window."""
        one, two = self.first, self.second
        return (one.n + one.m + one.p + two.n + two.m + two.p, one.n, one.m, one.p, self.window or 0)

    @property
    def field(self) -> str:
        """The field in words."""
        return str(self.first.field)

    @property
    def both(self) -> tuple[ResidualSystem, ResidualSystem]:
        """The two systems."""
        return self.first, self.second

    def __str__(self) -> str:
        window = "" if self.window is None else f", equal on {self.window} samples"
        return f"{self.first} against {self.second}{window}"


def same_a_and_c(pair: Compared) -> bool:
    """Whether the two systems share A and C."""
    return pair.first.A == pair.second.A and pair.first.C == pair.second.C


ALONE = {"both observable", "both controllable", "both left-invertible", "both A stable"}
MODEL: dict[str, Callable[[Compared], bool]] = {
    "same (A, C)": same_a_and_c,
    "both observable": lambda c: all(facets(s).observable for s in c.both),
    "both controllable": lambda c: all(facets(s).controllable for s in c.both),
    "both left-invertible": lambda c: all(facets(s).left_invertible for s in c.both),
    "both A stable": lambda c: all(facets(s).stable for s in c.both),
}


def theorem_1() -> Experiment[Compared]:
    """Equal restricted behaviours on a window of n + 1 samples."""

    def long_enough(pair: Compared) -> bool:
        return pair.window is not None and pair.window >= max(pair.first.n, pair.second.n) + 1

    return Experiment(
        name="equal-on-a-window",
        claim="theorem-1",
        conclusion="behaviours equal on the window are equal for ever",
        hypotheses={**MODEL, "window >= n + 1": long_enough},
        holds=lambda pair: pair.equal,
        subjects=_agreeing,
        over_q=_smallest_agreeing,
        show=_show_difference,
    )


def theorem_3_i() -> Experiment[Compared]:
    """Equal output behaviours of two systems with as many states."""
    return Experiment(
        name="columns-in-Z",
        claim="theorem-3-i",
        conclusion="the columns [F'; G'] of an equivalent system lie in Z",
        hypotheses=MODEL,
        holds=columns_in_space,
        subjects=_equivalent,
        over_q=_smallest_outside,
        show=_show_outside,
    )


def columns_in_space(pair: Compared) -> bool:
    """Whether the columns [F'; G'] of the second solve problem (11) of the first."""
    basis = fault_space(kernel_representation(pair.first)).basis
    return rank(stacked(basis, stacked(pair.second.F, pair.second.G).transposed())) == basis.nrows


def _agreeing(bench: Workbench) -> Iterator[Compared]:
    """Every pair that agrees on s samples, for each s it is so up to n + 2; certificates are told once a pair."""
    for d in bench.pairs:
        last = max(d.first.n, d.second.n) + 2 if d.first_difference is None else d.first_difference - 1
        for s in range(1, last + 1):
            yield Compared(d.first, d.second, s, d.first_difference is None, d.weight, d.accepted if s == 1 else 0)


def _equivalent(bench: Workbench) -> Iterator[Compared]:
    """Pairs with equal behaviours and as many states: other fault matrices for the same (A, C), and other (A, C)."""
    for rival in bench.rivals:
        if rival.equal:
            yield Compared(rival.system, rival.rival, None, True, rival.weight, rival.accepted)
    for pair in bench.pairs:
        if pair.first_difference is None and pair.first.n == pair.second.n:
            yield Compared(pair.first, pair.second, None, True, pair.weight, pair.accepted)


def _groups(
    box: Box, dropped: Sequence[str], key: Callable[[ResidualSystem], object]
) -> Iterator[tuple[ResidualSystem, list[ResidualSystem]]]:
    """Every system of the box in order, with all those of its dimensions that share its key."""
    for n, m, p in box.dimensions():
        here = Box(total=n + m + p, largest_n=n, largest_m=m, largest_p=p, least_m=m)
        systems = [s for s in systems_in_order(here, flags(ALONE - set(dropped), "both ")) if (s.n, s.m, s.p) == (n, m, p)]
        shared = "same (A, C)" not in dropped
        groups: dict[object, list[ResidualSystem]] = defaultdict(list)
        keys = [(key(system), (system.A, system.C) if shared else None) for system in systems]
        for system, name in zip(systems, keys, strict=True):
            groups[name].append(system)
        for system, name in zip(systems, keys, strict=True):
            yield system, groups[name]


def _words(box: Box) -> str:
    return f"{box}, both of the same dimensions"


def _smallest_agreeing(bench: Workbench, dropped: Sequence[str]) -> Found[Compared]:
    """The first system with a partner equal on n samples (n + 1, where that is kept) and not for ever, decided on 2n + 1."""
    extra = 0 if "window >= n + 1" in dropped else 1
    box = BOX if extra == 0 else SMALLER
    for first, group in _groups(box, dropped, lambda s: column_basis(window_matrix(s, s.n + extra))):
        if len(group) > 1:
            longer = column_basis(window_matrix(first, 2 * first.n + 1))
            for second in group:
                if column_basis(window_matrix(second, 2 * first.n + 1)) != longer:
                    return Found(Compared(first, second, first.n + extra, False, 1, 0), _words(box))
    return Found(None, _words(box))


def _smallest_outside(bench: Workbench, dropped: Sequence[str]) -> Found[Compared]:
    """The first system with an equivalent one whose fault columns lie outside its Z."""
    for first, group in _groups(SMALLER, dropped, lambda s: column_basis(window_matrix(s, 2 * s.n + 1))):
        for second in group:
            pair = Compared(first, second, None, True, 1, 0)
            if not columns_in_space(pair):
                return Found(pair, _words(SMALLER))
    return Found(None, _words(SMALLER))


def _of_each(pair: Compared) -> Iterator[Certificate]:
    for system in pair.both:
        kernel = kernel_representation(system)
        yield make.left_invertible(kernel)
        yield make.matrix_rank("observability", system)
        yield make.matrix_rank("reachability", system)


def _show_difference(pair: Compared) -> Iterator[Certificate]:
    kernels = kernel_representation(pair.first), kernel_representation(pair.second)
    yield make.window_equality(*kernels, pair.window or 0)
    yield comparison_certificate(*kernels)
    yield from _of_each(pair)


def _show_outside(pair: Compared) -> Iterator[Certificate]:
    kernels = kernel_representation(pair.first), kernel_representation(pair.second)
    yield comparison_certificate(*kernels)
    yield make.fault_space(kernels[0], fault_space(kernels[0]))
    yield from _of_each(pair)
