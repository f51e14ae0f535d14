"""This decides inclusion and equality of output behaviours, on a window and in full, with a word that separates them where they differ.

    Separation          a word (x0, v) of one system on `window` samples and a kernel row of the other that it violates
    separation          the shortest word of `inner` that is none of `outer`, or None: then B(inner) is contained in B(outer)
    Comparison          both directions at once; `first_difference` = the least window on which the restricted behaviours differ
    Word                the shortest word that one system makes and the other cannot, with its outputs
    compare             of two systems with the same field and p; n and m may differ

B(inner)|_s lies in B(outer)|_s iff every kernel row of `outer` of degree below s annihilates `inner`: those rows and their shifts span
the left null space of [O_s T_s], and a row that annihilates a system annihilates every later part of its outputs too. Source: [G25]
Theorem 1, [W91].
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from ...base.errors import InvalidInput
from ...base.sheets import Shown, counted
from ..algebra.matrices import Matrix
from ..algebra.notation import entry, polynomial
from ..system.systems import ResidualSystem, System
from .kernel_rows import KernelRepresentation, KernelRow, horner, kernel_of
from .signals import simulate

MOST_SAMPLES = 24


@dataclass(frozen=True)
class Separation:
    """A word of the maker that the other system cannot make: `x0` n x 1, `v` window x m, `row` a kernel row of the other."""

    window: int
    x0: Matrix
    v: Matrix
    row: KernelRow


@dataclass(frozen=True)
class Word:
    """What the system `of`, "first" or "second", makes and the other cannot: `separation` with the outputs, window x p."""

    of: str
    maker: ResidualSystem
    separation: Separation
    outputs: Matrix

    def to_json(self) -> dict[str, Any]:
        """v and r hold one row a sample; row holds [c_0, ..., c_mu] of the kernel row that is violated."""
        return {
            "of": self.of,
            "x0": [row[0] for row in self.separation.x0.to_json()],
            "v": self.separation.v.to_json(),
            "r": self.outputs.to_json(),
            "row": self.separation.row.coefficients.to_json(),
        }


@dataclass(frozen=True, repr=False)
class Comparison(Shown):
    """This tells how the output behaviours of two systems with p outputs differ, if they do; `compare` makes it.

    `equivalent` says whether they are equal, `first_difference` is the least number of samples on which they differ (None where they do
    not), and `word` the shortest word of one system that the other cannot make. `first_not_in_second` and `second_not_in_first` are the
    words of each direction, None where there is inclusion; `first` and `second` are the kernel representations. Source: [G25] Theorem 1,
    [W91]. Raises nothing by itself.

    >>> import faultspace as fs
    >>> found = fs.compare(fs.System(A=[[0]], F=[[1]], C=[[1]], G=[[0]]), fs.System(A=[["1/2"]], F=[[0]], C=[[1]], G=[[0]]))
    >>> print(found.summary())
    different: first on 2 samples, the same on fewer
    the first system makes this word of 2 samples, which the second system cannot:
      x(0) = (1)
      k    v(k)    r(k)
      0    0       1
      1    0       0
    every word r of the second system satisfies N(q) r = 0 with N(q) = [ 2 q - 1 ]
    """

    first: KernelRepresentation
    second: KernelRepresentation
    first_not_in_second: Separation | None
    second_not_in_first: Separation | None

    @property
    def equivalent(self) -> bool:
        """This tells whether the output behaviours are equal."""
        return self.first_difference is None

    @property
    def first_difference(self) -> int | None:
        """The least number of samples on which the restricted behaviours differ, None where they are equal."""
        found = [s.window for s in (self.first_not_in_second, self.second_not_in_first) if s is not None]
        return min(found, default=None)

    @property
    def word(self) -> Word | None:
        """The shortest word of one system that the other cannot make; None where they are equivalent."""
        candidates = [("first", self.first.system, self.first_not_in_second), ("second", self.second.system, self.second_not_in_first)]
        words = [(of, maker, found) for of, maker, found in candidates if found is not None]
        shortest = min(words, key=lambda candidate: candidate[2].window, default=None)
        if shortest is None:
            return None
        of, maker, found = shortest
        return Word(of, maker, found, simulate(maker, found.x0, found.v).residuals)

    @property
    def title(self) -> str:
        """This tells whether the two are equivalent, and where not, on how many samples they first differ."""
        if self.first_difference is None:
            return "equivalent: both make the same outputs, on every window"
        return f"different: first on {counted(self.first_difference, 'sample')}, the same on fewer"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the verdict, and the word that separates the two, as (name, value) pairs."""
        yield from (("", text) for text in self.lines()[1:])

    def summary(self) -> str:
        """Return the verdict, and the word that separates the two; of a long one the first samples."""
        return "\n".join(self.lines())

    def lines(self, first: str = "the first system", second: str = "the second system", *, samples: int = MOST_SAMPLES) -> list[str]:
        """Return what `faultspace compare` prints, with these names of the two systems, and at most so many samples of the word."""
        word = self.word
        if word is None:
            return [self.title]
        own, other = (first, second) if word.of == "first" else (second, first)
        found, field = word.separation, word.maker.field

        def row_of(matrix: Matrix, i: int) -> str:
            return ", ".join(entry(matrix[i, j], field) for j in range(matrix.ncols))

        result = [self.title, f"{own} makes this word of {counted(found.window, 'sample')}, which {other} cannot:"]
        result.append(f"  x(0) = ({', '.join(entry(found.x0[i, 0], field) for i in range(word.maker.n))})")
        listed = min(found.window, samples)
        table = [("k", "v(k)", "r(k)"), *((str(k), row_of(found.v, k), row_of(word.outputs, k)) for k in range(listed))]
        widths = [max(map(len, column)) for column in zip(*table, strict=True)]
        result += ["".join(f"  {text:<{width}}  " for text, width in zip(row, widths, strict=True)).rstrip() for row in table]
        if listed < found.window:
            result.append(f"  ... and {counted(found.window - listed, 'sample')} more; --word prints them all")
        row = found.row.coefficients
        polynomials = [polynomial([row[k, j] for k in range(row.nrows)], field) for j in range(row.ncols)]
        return [*result, f"every word r of {other} satisfies N(q) r = 0 with N(q) = [ {',  '.join(polynomials)} ]"]

    def to_json(self) -> dict[str, Any]:
        """Return the verdict and the separating word: what `faultspace compare --json --word` prints."""
        word = self.word
        return {"equivalent": self.equivalent, "first_difference": self.first_difference, "word": None if word is None else word.to_json()}


@lru_cache(maxsize=4)  # whoever compares two systems asks for both directions, and whoever certifies it asks again
def separation(inner: ResidualSystem, outer: KernelRepresentation) -> Separation | None:
    """Return the shortest word of `inner` that is not a word of `outer`, or None where B(inner) is contained in B(outer)."""
    _comparable(inner, outer.system)
    for row in outer.rows:
        left = horner(row.coefficients, inner)
        if left.vanishes():
            continue
        one = inner.field.element(1)
        state = [[inner.field.element(0)] for _ in range(inner.n)]
        fault = [[inner.field.element(0)] * inner.m for _ in range(row.degree + 1)]
        if left.at_state.is_zero():
            k, j = _first_nonzero(left.at_fault)
            fault[k][j] = one
        else:
            _, j = _first_nonzero(left.at_state)
            state[j][0] = one
        x0 = Matrix.from_elements(inner.field, inner.n, 1, state)
        v = Matrix.from_elements(inner.field, row.degree + 1, inner.m, fault)
        return Separation(row.degree + 1, x0, v, row)
    return None


def compare(first: System | KernelRepresentation, second: System | KernelRepresentation) -> Comparison:
    """Tell whether two systems make the same outputs from any initial state and fault, and find a word that only one makes.

    Source: [G25] Theorem 1, [W91].

    Parameters
    ----------
    first, second : System or KernelRepresentation
        With p outputs each, over the same field; their numbers of states and faults may differ, and inputs play no part.

    Returns
    -------
    Comparison
        `equivalent`, `first_difference` (a number of samples, or None) and `word`.

    Raises
    ------
    InvalidInput
        When fields or numbers of outputs differ, and for anything that is no system.

    Examples
    --------
    >>> import faultspace as fs
    >>> delayed = fs.System(A=[[0]], F=[[1]], C=[[1]], G=[[0]])
    >>> direct = fs.System(A=[[0]], F=[[0]], C=[[0]], G=[[1]])
    >>> fs.compare(delayed, direct).equivalent
    True
    >>> fs.compare(delayed, fs.System(A=[["1/2"]], F=[[0]], C=[[1]], G=[[0]]))
    <Comparison: different: first on 2 samples, the same on fewer>
    """
    one, other = kernel_of(first), kernel_of(second)
    return Comparison(one, other, separation(one.system, other), separation(other.system, one))


def _first_nonzero(matrix: Matrix) -> tuple[int, int]:
    return next((i, j) for i, row in enumerate(matrix.elements()) for j, x in enumerate(row) if x != 0)


def _comparable(first: ResidualSystem, second: ResidualSystem) -> None:
    if first.field != second.field:
        raise InvalidInput(f"field: got {first.field} and {second.field}, expected the same field for both systems")
    if first.p != second.p:
        raise InvalidInput(f"p: got {first.p} and {second.p} outputs, expected as many in both systems")
