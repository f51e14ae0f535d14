"""Sums of products: integers in a normal form.

Atom       a part that is no sum and no product: a quantity, rank_OT(n + 1), rank(C @ F), max(n, delay_known), a window
Product    atoms in order; the empty one is 1
Sum        integer multiples of products; the constant is the multiple of the empty product
number     the sum that is a constant; of_atom: the sum that is an atom
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property


@dataclass(frozen=True, order=True)
class Atom:
    """`text` names it. `argument` is that of a function with a window."""

    text: str
    finite: bool = True
    argument: Sum | None = field(default=None, compare=False)


Product = tuple[Atom, ...]


@dataclass(frozen=True)
class Sum:
    """The multiples by product, none of them 0, in order."""

    terms: tuple[tuple[Product, int], ...]

    @cached_property
    def atoms(self) -> frozenset[Atom]:
        """The atoms in it."""
        return frozenset(atom for product, _ in self.terms for atom in product)

    @property
    def constant(self) -> int:
        """The multiple of the empty product."""
        return dict(self.terms).get((), 0)

    def __add__(self, other: Sum) -> Sum:
        found = dict(self.terms)
        for product, times in other.terms:
            found[product] = found.get(product, 0) + times
        return _sum(found)

    def times(self, factor: int) -> Sum:
        """Return so many times the sum."""
        return _sum({product: factor * times for product, times in self.terms})

    def __sub__(self, other: Sum) -> Sum:
        return self + other.times(-1)

    def __mul__(self, other: Sum) -> Sum:
        found: dict[Product, int] = {}
        for left, a in self.terms:
            for right, b in other.terms:
                product = tuple(sorted((*left, *right)))
                found[product] = found.get(product, 0) + a * b
        return _sum(found)

    def __str__(self) -> str:
        return " + ".join(f"{times}*{'*'.join(atom.text for atom in product)}" for product, times in self.terms) or "0"


def _sum(found: Mapping[Product, int]) -> Sum:
    return Sum(tuple(sorted((product, times) for product, times in found.items() if times)))


def number(value: int) -> Sum:
    """Return the sum that is a constant."""
    return _sum({(): value})


def of_atom(atom: Atom) -> Sum:
    """Return the sum that is an atom."""
    return _sum({(atom,): 1})
