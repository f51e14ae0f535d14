"""Everything a stratification states, expanded again by a second algebra.

`stratification` finds its identities in sympy's polynomial rings; here each of them is built anew from the entries of A, C,
F, G as FLINT polynomials and multiplied out, and two sides that ought to be equal are compared. Nothing is reduced and
nothing is searched: membership in the ideal of a stratum is the explicit sum of cofactors times equations.

What makes the strata cover all parameter values is checked from their decisions alone: at each node one child has g = 0,
the other g != 0. What makes a unit a unit is a decision, or a product with it that is
an earlier unit. What makes rows independent is that the reduced rows of a window are triangular with units at their pivots.

    verify_identities   all of it for one Stratification, as an Expansion
    Expansion           how much was checked
    IdentityFailure     raised by the first thing that is not so
    SecondRoute         the polynomials of one ring in FLINT, and the comparisons
    verify_cases        branches cover all values once, and their units are units
    FlintWindow, flint_determinant, maximal_minors, read_back
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import flint

from .case_tree import Branch, Congruence, Polynomial, Ring, UnitProduct
from .stratification import Indeterminates, ReducedRow, Row, Stratification, Stratum

# A polynomial of FLINT; python-flint ships no types for it.
FlintPolynomial = Any


class IdentityFailure(ValueError):
    """Two polynomials that were stated to be equal differ, or the strata leave values out: that is what is raised here."""


@dataclass(frozen=True)
class Expansion:
    """What `verify_identities` checked.

    `relations` counts the rows (k, i) of windows that were seen to depend on earlier rows, `independent` those seen to be independent, and
    `expanded` the polynomial identities multiplied out.
    """

    relations: int
    independent: int
    expanded: int


class SecondRoute:
    """FLINT's copy of a ring, with a counter of what was expanded in it."""

    def __init__(self, ring: Ring) -> None:
        self.names = tuple(str(symbol) for symbol in ring.symbols)
        self.context = flint.fmpz_mpoly_ctx.get(self.names, flint.Ordering.lex)
        self.expanded = 0
        self._images: dict[Polynomial, FlintPolynomial] = {}

    def __call__(self, f: Polynomial) -> FlintPolynomial:
        """Return the image of a polynomial."""
        image = self._images.get(f)
        if image is None:
            terms = {tuple(map(int, exponents)): int(coefficient) for exponents, coefficient in f.items()}
            image = self._images[f] = self.context.from_dict(terms)
        return image

    def generator(self, name: str) -> FlintPolynomial:
        """Return the generator of that name."""
        return self.context.gen(self.names.index(name))

    def unit(self, branch: Branch, product: UnitProduct) -> FlintPolynomial:
        """A product of units, multiplied out; raises IdentityFailure when its integer is 0."""
        if product.constant == 0 or any(not 0 <= index < len(branch.units) for index, _ in product.powers):
            raise IdentityFailure("a product of units has the factor 0, or one that is no unit of its branch")
        value = self.context.constant(product.constant)
        for index, exponent in product.powers:
            value *= self(branch.units[index].polynomial) ** exponent
        return value

    def equal(self, left: FlintPolynomial, right: FlintPolynomial, what: str) -> None:
        """Both sides are expanded and compared."""
        self.expanded += 1
        if left != right:
            raise IdentityFailure(f"{what}: the two sides differ by {_shortened(left - right)}")

    def congruent(self, branch: Branch, f: FlintPolynomial, congruence: Congruence, what: str) -> None:
        """This checks that multiplier * f = sum of cofactors * equations + remainder."""
        self.equal(
            self.unit(branch, congruence.multiplier) * f,
            self.combination(branch, congruence.cofactors) + self(congruence.remainder),
            what,
        )

    def combination(self, branch: Branch, cofactors: Sequence[Polynomial]) -> FlintPolynomial:
        """Return sum of cofactors * equations."""
        return self.combination_of_images(branch, [self(cofactor) for cofactor in cofactors])

    def combination_of_images(self, branch: Branch, cofactors: Sequence[FlintPolynomial]) -> FlintPolynomial:
        """Return the same with cofactors that are FLINT's already."""
        total = self.context.constant(0)
        for cofactor, equation in zip(cofactors, branch.equations, strict=True):
            total += cofactor * self(equation.polynomial)
        return total


class FlintWindow:
    """[O_s T_s] from its definition, over FLINT: row (k, i) is [C A^k, C A^(k-1) F, ..., C F, G, 0, ..., 0] in row i."""

    def __init__(self, route: SecondRoute, entries: Indeterminates, samples: int) -> None:
        n, p, m = entries.n, entries.p, entries.m
        self.route = route
        self.zero = route.context.constant(0)
        self.A, self.C, self.F, self.G = (
            [[route.generator(f"{letter}{i + 1}{j + 1}") for j in range(width)] for i in range(height)]
            for letter, height, width in (("a", n, n), ("c", p, n), ("f", n, m), ("g", p, m))
        )
        powers = [self.C]
        for _ in range(samples):
            powers.append([self.times(row, self.A, n) for row in powers[-1]])
        markov = [self.G, *([self.times(row, self.F, m) for row in power] for power in powers)]
        blank = [self.zero] * m
        self.rows: dict[Row, list[FlintPolynomial]] = {
            (k, i): powers[k][i] + [f for j in range(samples) for f in (markov[k - j][i] if j <= k else blank)]
            for k in range(samples)
            for i in range(p)
        }

    def times(self, row: Sequence[FlintPolynomial], matrix: Sequence[Sequence[FlintPolynomial]], width: int) -> list[Any]:
        """Return the row vector times the matrix."""
        products = [[x * line[j] for x, line in zip(row, matrix, strict=True)] for j in range(width)]
        return [sum(column, self.zero) for column in products]


def verify_identities(stratification: Stratification) -> Expansion:
    """Expand every identity of a stratification by FLINT; raises IdentityFailure at the first that does not hold."""
    route = SecondRoute(stratification.entries.ring)
    verify_cases(route, [stratum.branch for stratum in stratification.strata])
    # A relation of degree d is expanded in its own window of d + 1 samples even where `windows` is smaller.
    samples = max(stratification.windows, stratification.entries.n + 1)
    window = FlintWindow(route, stratification.entries, samples)
    relations = independent = 0
    for stratum in stratification.strata:
        if stratum.ends.keys() != set(range(stratification.entries.p)):
            raise IdentityFailure("an output has no end")
        verify_echelon(route, stratum)
        for row in stratum.rows:
            relations += verify_row(window, stratum, row, samples)
        independent += len(stratum.independent_rows(stratification.windows))
    return Expansion(relations, independent, route.expanded)


def verify_cases(route: SecondRoute, branches: Sequence[Branch]) -> None:
    """The branches cover all parameter values and do not overlap, and their units are units."""
    _verify_covering([branch.decisions for branch in branches])
    for branch in branches:
        verify_branch(route, branch)


def _verify_covering(lists: Sequence[Sequence[tuple[Polynomial, bool]]]) -> None:
    """The lists of decisions are the paths of a binary tree: below every node both answers to one question."""
    if not lists:
        raise IdentityFailure("some parameter values lie in no stratum")
    if not all(lists):
        if len(lists) > 1:
            raise IdentityFailure("two strata overlap")
        return
    question = lists[0][0][0]
    if any(decisions[0][0] != question for decisions in lists):
        raise IdentityFailure("the strata are not the leaves of one tree of decisions")
    for answer in (False, True):
        _verify_covering([decisions[1:] for decisions in lists if decisions[0][1] is answer])


def verify_branch(route: SecondRoute, branch: Branch) -> None:
    """Equations and decided units are the decisions; every other unit divides an earlier one modulo the equations."""
    zeros = [polynomial for polynomial, vanishes in branch.decisions if vanishes]
    others = [polynomial for polynomial, vanishes in branch.decisions if not vanishes]
    if zeros != [equation.polynomial for equation in branch.equations]:
        raise IdentityFailure("the equations of a branch are not those it decided")
    if others != [unit.polynomial for unit in branch.units if unit.source is None]:
        raise IdentityFailure("the units of a branch are not those it decided")
    for number, unit in enumerate(branch.units):
        if unit.source is None:
            continue
        congruence = unit.congruence
        if congruence is None or any(index >= number for index in (unit.source, *_indices(congruence.multiplier))):
            raise IdentityFailure("a unit was derived from itself or from nothing")
        product = route(unit.polynomial) * route(unit.complement)
        route.equal(product, route(congruence.remainder), "derived unit")
        # A congruence found before later equations were added has fewer cofactors; the missing ones are 0.
        missing = (route(unit.polynomial.ring.zero),) * (len(branch.equations) - len(congruence.cofactors))
        cofactors = [*(route(f) for f in congruence.cofactors), *missing]
        left = route.unit(branch, congruence.multiplier) * route(branch.units[unit.source].polynomial)
        route.equal(left, route.combination_of_images(branch, cofactors) + product, "derived unit")


def verify_echelon(route: SecondRoute, stratum: Stratum) -> None:
    """The reduced rows of the stratum are triangular with units at the pivots, and every output goes on until it ends.

    Order the reduced rows of a window as: fault rows by descending shift, then in their own order, then state rows. By
    the zeros checked here each row has nothing at the pivots of the rows before it, so all are independent.
    """
    for kind in ("fault", "state"):
        pivots: list[int] = []
        for row in (row for row in stratum.rows if row.kind == kind):
            part = row.fault if kind == "fault" else row.state
            if row.pivot is None or row.pivot_value is None or any(part[c] for c in pivots):
                raise IdentityFailure(f"row {row.degree, row.output} is not reduced by the {kind} rows before it")
            route.equal(route(part[row.pivot]), route.unit(stratum.branch, row.pivot_value), "pivot")
            pivots.append(row.pivot)
    for row in stratum.rows:
        if (row.kind != "fault" and any(row.fault)) or (row.kind == "relation" and any(row.state)):
            raise IdentityFailure(f"row {row.degree, row.output} is no {row.kind} row")
        top = max(combined_row for combined_row, _ in row.coefficients)
        if top != (row.degree, row.output):
            raise IdentityFailure(f"row {row.degree, row.output} is combined with later rows")
        leading = route(dict(row.coefficients)[top])
        route.equal(leading, route.unit(stratum.branch, row.leading), "leading coefficient")
    found = Counter((row.degree, row.output, row.kind == "state") for row in stratum.rows)
    expected = Counter((k, end.output, k < end.degree) for end in stratum.ends.values() for k in range(end.degree + 1))
    if found != expected:
        raise IdentityFailure("an output has no row, or two, at some time before its elimination ended")


def verify_row(window: FlintWindow, stratum: Stratum, row: ReducedRow, samples: int) -> int:
    """Expand the row and, unless it is a state row, all its shifts within the window; returns how many are relations.

    With x(1) = A x(0) + F v(0) the cofactors of a shift are those of the row, multiplied by A and F in their state part.
    """
    route, branch = window.route, stratum.branch
    n, m = len(row.state), len(row.fault)
    width = n + (row.degree + 1) * m
    if len(row.congruences) != width or len({congruence.multiplier for congruence in row.congruences}) > 1:
        raise IdentityFailure("a row needs one congruence a column, all with one multiplier")
    if any(congruence.remainder for congruence in row.congruences):
        raise IdentityFailure(f"row {row.degree, row.output} differs from what it was reduced to")
    one = route.context.constant(1)
    multiplier = route.unit(branch, row.congruences[0].multiplier) if width else one
    # One line an equation, one entry a column.
    cofactors = [[route(congruence.cofactors[j]) for congruence in row.congruences] for j in range(len(branch.equations))]
    claimed = [route(f) for f in (*row.state, *row.fault)] + [window.zero] * (width - n - m)
    coefficients = [(key, route(f)) for key, f in row.coefficients]
    last = row.degree if row.kind == "state" else samples - 1
    for shift in range(last - row.degree + 1):
        if shift:
            cofactors = [_shifted(window, line, n, m) for line in cofactors]
            claimed = _shifted(window, claimed, n, m)
        shifted = [(window.rows[k + shift, i], f) for (k, i), f in coefficients]
        for column in range(n + samples * m):
            left = sum((f * line[column] for line, f in shifted), window.zero)
            inside = column < len(claimed)
            right = route.combination_of_images(branch, [line[column] if inside else window.zero for line in cofactors])
            stated = claimed[column] if inside else window.zero
            what = f"row {row.degree + shift, row.output}, column {column}"
            route.equal(multiplier * (left - stated), right, what)
    return last - row.degree + 1 if row.kind == "relation" else 0


def _shifted(window: FlintWindow, line: list[FlintPolynomial], n: int, m: int) -> list[FlintPolynomial]:
    """Return (state | faults) one sample later: (state A | state F, faults)."""
    state = line[:n]
    return window.times(state, window.A, n) + window.times(state, window.F, m) + line[n:]


def flint_determinant(route: SecondRoute, matrix: Sequence[Sequence[FlintPolynomial]]) -> FlintPolynomial:
    """Return the determinant of a small matrix, as its one maximal minor."""
    return next(iter(maximal_minors(route, matrix, len(matrix))), route.context.constant(0))


def maximal_minors(route: SecondRoute, lines: Sequence[Sequence[FlintPolynomial]], width: int) -> list[FlintPolynomial]:
    """Return the nonzero minors of size `width` of a matrix with so many columns, column by column, smaller minors shared."""
    minors: dict[tuple[int, ...], FlintPolynomial] = {(): route.context.constant(1)}
    for column in range(width):
        larger: dict[tuple[int, ...], FlintPolynomial] = {}
        for chosen, minor in minors.items():
            for i, line in enumerate(lines):
                if i in chosen or not line[column]:
                    continue
                # Expansion along the last column: the sign is that of the rows below i.
                sign = (-1) ** sum(c > i for c in chosen)
                key = tuple(sorted((*chosen, i)))
                larger[key] = larger.get(key, route.context.constant(0)) + sign * line[column] * minor
        minors = {key: minor for key, minor in larger.items() if minor}
    return list(minors.values())


def read_back(ring: Ring, f: FlintPolynomial) -> Polynomial:
    """Return sympy's polynomial of FLINT's."""
    return ring.from_dict({tuple(map(int, exponents)): ring.domain(int(c)) for exponents, c in f.to_dict().items()})


def _indices(product: UnitProduct) -> tuple[int, ...]:
    return tuple(index for index, _ in product.powers)


def _shortened(f: FlintPolynomial) -> str:
    text = str(f)
    return text if len(text) <= 120 else f"{text[:120]}... ({len(f)} terms)"
