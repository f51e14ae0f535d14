"""What claims about a choice can speak of: a system, and (A, Fhat P, C, Ghat P) for a P. Source: [G25] Theorem 3.

    OF_A_CHOICE     the quantities of a choice, by their names; what compares the two systems is that of a pair
    Choices         many choices at once, with k columns in each P

[Fhat; Ghat] is the reduced basis of the system's fault space, whose dimension n_z is not the same for all systems of the same sizes, and
which may have denominators. F and G of a chosen system are kept as integers, as a multiple of them where that is needed, which changes no
rank; where they are asked for themselves, such systems are looked at one by one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np

from .batches import Batch
from .blocks import exactly
from .cases import Choice
from .elimination import Integers, Overflow
from .many import Both, Chosen, Column
from .pairs import OF_A_PAIR, TOGETHER, together
from .registry import Kind, Quantity


@dataclass
class Choices(Both):
    """Choice i has the chosen system i of `second`, and P[i], of which the first heights[i] rows count.

    F and G of the chosen system are `scales[i]` times what they should be.
    """

    called: ClassVar[tuple[str, str]] = ("", "chosen")
    first: Batch
    firsts: Chosen
    second: Batch
    P: Integers
    heights: Chosen
    scales: Integers
    _columns: dict[object, Column] = field(default_factory=dict)

    @property
    def own(self) -> Mapping[str, Any]:  # type: ignore[override]
        """The quantities of a choice."""
        return OF_A_CHOICE

    @property
    def seconds(self) -> Chosen:  # type: ignore[override]
        """Each chosen system stands once."""
        return np.arange(len(self))

    def case(self, index: int) -> Choice:
        """Return one of the choices."""
        rows = self.P[index, : int(self.heights[index]) * self.degree]
        return Choice(self.first.system(int(self.firsts[index])), exactly(rows, self.denominator, self.number_field, self.prime))

    def matrix(self, subject: str, name: str) -> Integers:
        """Return P, or A, F, C or G of one of the two systems. Raises Overflow where they are no integers."""
        if subject == "chosen":
            if name in ("F", "G") and (self.scales != 1).any():
                raise Overflow("numbers over a denominator")
            return self.second.matrix("", name)
        if name == "P":
            return self.P[:, : int(self.heights.max(initial=0)) * self.degree]
        return self.first.matrix("", name)[self.firsts]

    def part(self, rows: Chosen) -> Choices:
        """Return the choices of these rows; what is known of the systems stays known."""
        return Choices(self.first, self.firsts[rows], self.second.part(rows), self.P[rows], self.heights[rows], self.scales[rows])

    def column(self, key: Any, rows: Chosen, find: Callable[[Any], Integers] | None = None) -> Integers:
        """Return the numbers of a family of one of the systems, of both together, or of what `find` finds. Raises Overflow."""
        if key == TOGETHER:
            return self.kept(key, rows, together)
        return self.of_system(key, rows) if find is None else self.kept(key, rows, lambda part: part.by_height(find))

    def by_height(self, find: Callable[[Choices], Integers]) -> Integers:
        """Return what `find` finds, asked about those with as many rows in P at once; narrower rows are filled up with zeros."""
        groups = [np.flatnonzero(self.heights == one) for one in np.unique(self.heights)]
        parts = [find(self.part(rows)) for rows in groups]
        found = np.zeros((len(self), max((part.shape[1] for part in parts), default=0)), dtype=np.int64)
        for rows, part in zip(groups, parts, strict=True):
            found[rows, : part.shape[1]] = part
        return found


OF_A_CHOICE: dict[str, Quantity] = {
    name: replace(OF_A_PAIR[name], meaning=meaning)
    for name, meaning in (
        ("equal", "the chosen system makes the same outputs as the system on every window"),
        ("contained", "every output of the system is one of the chosen system, on every window"),
        ("first_difference", "the least number of samples on which their outputs differ; inf where they are equal"),
        ("equal_on", "both make the same outputs of s samples"),
        ("contained_on", "every output of s samples of the system is one of the chosen system"),
    )
} | {
    "k": Quantity(
        "k",
        Kind.INTEGER,
        "the number of columns of P, which is the number of faults of the chosen system",
        lambda x: x.P.ncols,
        lambda r: r.sizes["chosen"][1],
        lambda x: [],
    )
}
