"""A case tree runs one exact algorithm at every value of its parameters at once.

An algorithm that asks of polynomials in the parameters whether they are zero, and asks it of a `Branch`, is run for all
parameter values by `explore`: a question that the branch cannot answer splits it in two, on which the algorithm starts
again. What a branch knows is kept in one shape throughout:

    equations   e_j = u_j x_j + w_j, each linear in a parameter x_j that no later equation has, with u_j a unit
    units       polynomials that vanish nowhere on the branch

so the e_j are, after division by the units u_j, the reduced lexicographic Groebner basis x_j + w_j / u_j of the ideal of
the branch, membership is decided by dividing by them in turn, and a branch is the graph of a map on the set where finitely
many polynomials in the other parameters do not vanish: it is not empty, over every field of characteristic 0, and no branch
has to be dropped. Every statement that is made on a branch comes with the cofactors that prove it, for a second algebra to
expand (`faultspace.exact.parametric.identities`).

    Polynomial      an element of a sympy ring over ZZ
    UnitProduct     a nonzero integer times powers of units
    Equation        e_j, x_j and u_j
    Unit            a unit: decided by a split, or a factor of an earlier unit modulo the equations
    Congruence      multiplier * f = sum of cofactor_j * e_j + remainder
    Branch          decisions, equations, units; `is_zero`, `congruence`, `unit_product`, `split`, `point`
    Undecided       raised by a question that the branch leaves open; carries the polynomial to split on
    NonlinearCondition  raised when a polynomial to be split on is linear in no parameter
    Cases           the branches with the results of the algorithm
    explore, refine run an algorithm on a branch, on each of some cases
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import flint

# sympy ships no types: a PolyElement of a ring over ZZ, and the ring itself.
Polynomial = Any
Ring = Any

Result = TypeVar("Result")
Other = TypeVar("Other")


class Undecided(Exception):
    """The branch does not say whether `polynomial` vanishes; splitting on it decides more."""

    def __init__(self, polynomial: Polynomial) -> None:
        super().__init__(f"{polynomial} is neither zero nor a unit on this branch")
        self.polynomial = polynomial


class NonlinearCondition(ArithmeticError):
    """A condition is linear in no parameter: its zero set is outside what branches can describe."""


@dataclass(frozen=True)
class UnitProduct:
    """constant * product of units[index] ** exponent; `powers` holds the pairs (index, exponent) by ascending index."""

    constant: int = 1
    powers: tuple[tuple[int, int], ...] = ()

    def __mul__(self, other: UnitProduct) -> UnitProduct:
        exponents = dict(self.powers)
        for index, exponent in other.powers:
            exponents[index] = exponents.get(index, 0) + exponent
        return UnitProduct(self.constant * other.constant, tuple(sorted(exponents.items())))

    def __pow__(self, exponent: int) -> UnitProduct:
        if exponent == 0:
            return UnitProduct()
        return UnitProduct(self.constant**exponent, tuple((index, e * exponent) for index, e in self.powers))


@dataclass(frozen=True)
class Equation:
    """polynomial = initial * x + ..., linear in the parameter x number `variable`; `initial` is worth the unit product."""

    polynomial: Polynomial
    variable: int
    initial: Polynomial
    initial_product: UnitProduct


@dataclass(frozen=True)
class Congruence:
    """It states that multiplier * f = sum of cofactors[j] * equations[j] + remainder, with a remainder free of the solved parameters."""

    multiplier: UnitProduct
    cofactors: tuple[Polynomial, ...]
    remainder: Polynomial


@dataclass(frozen=True)
class Unit:
    """A polynomial without zeros on the branch.

    A split decided it when `source` is None. Otherwise it divides the remainder of the earlier unit number `source`: polynomial *
    complement = congruence.remainder, the congruence being that of the earlier unit.
    """

    polynomial: Polynomial
    source: int | None = None
    complement: Polynomial = None
    congruence: Congruence | None = None


@dataclass(frozen=True)
class Branch:
    """The parameter values at which every decision holds.

    `parameters` is the number of leading generators of the ring that are parameters; the others are indeterminates that no question may
    contain. `decisions` are pairs (polynomial, whether it vanishes) from the root down.
    """

    ring: Ring
    parameters: int
    decisions: tuple[tuple[Polynomial, bool], ...] = ()
    equations: tuple[Equation, ...] = ()
    units: tuple[Unit, ...] = ()
    _unit_index: dict[Polynomial, int] = field(default_factory=dict, compare=False, repr=False)

    @property
    def vanishing(self) -> tuple[Any, ...]:
        """The polynomials set to zero, as sympy expressions."""
        return tuple(polynomial.as_expr() for polynomial, vanishes in self.decisions if vanishes)

    @property
    def nonvanishing(self) -> tuple[Any, ...]:
        """The polynomials required not to vanish, as sympy expressions."""
        return tuple(polynomial.as_expr() for polynomial, vanishes in self.decisions if not vanishes)

    @property
    def dimension(self) -> int:
        """The number of parameters left free."""
        return self.parameters - len(self.equations)

    def contains(self, values: Sequence[Any]) -> bool:
        """This tells whether the parameter values (Fractions or ints, in the order of the ring's generators) lie on the branch."""
        return all((evaluate(polynomial, values) == 0) == vanishes for polynomial, vanishes in self.decisions)

    def point(self, values: Sequence[Any]) -> tuple[Any, ...]:
        """Return the point of the branch whose free parameters are those of `values` (Fractions); the others are solved for.

        Raises ValueError where a unit vanishes, so that there is no such point.
        """
        point = list(values)
        # A later equation is free of the parameters that earlier ones are solved for, so the last is solved first.
        for equation in reversed(self.equations):
            initial = evaluate(equation.initial, point)
            if initial == 0:
                raise ValueError("a unit of the branch vanishes at these values")
            point[equation.variable] -= evaluate(equation.polynomial, point) / initial
        if not self.contains(point):
            raise ValueError("a unit of the branch vanishes at these values")
        return tuple(point)

    def reduce(self, f: Polynomial) -> Polynomial:
        """Return the remainder of `congruence(f)`, without the cofactors."""
        (rest,) = self.joint_reduce([f])
        return rest

    def congruence(self, f: Polynomial) -> Congruence:
        """Return the result of dividing f by the equations in turn."""
        _, (found,) = self.joint_congruence([f])
        return found

    def joint_reduce(self, polynomials: Sequence[Polynomial]) -> list[Polynomial]:
        """Return remainders of several polynomials, all multiplied by one product of units."""
        rest = list(polynomials)
        for equation in self.equations:
            times = max((_degree(f, equation.variable) for f in rest), default=0)
            if times:
                divided = [_divide(f, equation) for f in rest]
                rest = [equation.initial ** (times - used) * remainder for used, _, remainder in divided]
        return rest

    def joint_congruence(self, polynomials: Sequence[Polynomial]) -> tuple[UnitProduct, list[Congruence]]:
        """Return congruences of several polynomials with one multiplier."""
        multiplier = UnitProduct()
        columns: list[list[Polynomial]] = [[] for _ in polynomials]
        rest = list(polynomials)
        for equation in self.equations:
            times = max((_degree(f, equation.variable) for f in rest), default=0)
            scale = equation.initial**times
            multiplier = multiplier * equation.initial_product**times
            for number, f in enumerate(rest):
                used, quotient, remainder = _divide(f, equation)
                lift = equation.initial ** (times - used)
                columns[number] = [scale * cofactor for cofactor in columns[number]] + [lift * quotient]
                rest[number] = lift * remainder
        pairs = zip(columns, rest, strict=True)
        return multiplier, [Congruence(multiplier, tuple(column), remainder) for column, remainder in pairs]

    def is_zero(self, f: Polynomial) -> bool:
        """This tells whether f vanishes at every value (True) or at none (False) on the branch; raises Undecided otherwise."""
        remainder = self.reduce(f)
        if not remainder:
            return True
        open_factors = [factor for factor, _ in factors(remainder)[1] if factor not in self._unit_index]
        if open_factors:
            raise Undecided(min(open_factors, key=_simplicity))
        return False

    def unit_product(self, f: Polynomial) -> UnitProduct:
        """Return f, free of solved parameters and never zero on the branch, as a product of units; raises Undecided if it may
        vanish.
        """
        constant, powers = factors(f)
        found: dict[int, int] = {}
        for factor, exponent in powers:
            if factor not in self._unit_index:
                raise Undecided(factor)
            found[self._unit_index[factor]] = exponent
        return UnitProduct(constant, tuple(sorted(found.items())))

    def without_units(self, polynomials: Sequence[Polynomial]) -> list[Polynomial]:
        """Return the polynomials divided by the integers and units that divide all of them."""
        rest = list(polynomials)
        filled = [f for f in rest if f]
        if not filled:
            return rest
        smallest = min(filled, key=_simplicity)
        for factor, exponent in factors(smallest)[1]:
            if factor not in self._unit_index:
                continue
            for _ in range(exponent):
                divided = [_exact_quotient(f, factor) for f in rest]
                if any(f is None for f in divided):
                    break
                rest = divided
        content = 0
        for f in rest:
            content = _gcd(content, f)
        return [f.quo_ground(content) for f in rest] if content > 1 else rest

    def split(self, g: Polynomial) -> list[Branch]:
        """Return the branches g != 0 and g = 0, or, when no unit multiplies a parameter linearly in g, those of a simpler
        polynomial.

        g is irreducible, free of solved parameters, and no unit. Raises NonlinearCondition.
        """
        linear = [x for x in range(self.parameters) if _degree(g, x) == 1]
        if not linear:
            raise NonlinearCondition(f"{g} is linear in no parameter; the case tree ends here")
        obstacles = []
        for x in sorted(linear, key=lambda x: _simplicity(_coefficient(g, x, 1))):
            initial = _coefficient(g, x, 1)
            try:
                equation = Equation(g, x, initial, self.unit_product(initial))
            except Undecided as undecided:
                obstacles.append(undecided.polynomial)
                continue
            unequal = self._with_unit(Unit(g), (*self.decisions, (g, False)))
            return [unequal, self._with_equation(equation)]
        return self.split(min(obstacles, key=_simplicity))

    def _with_unit(self, unit: Unit, decisions: tuple[tuple[Polynomial, bool], ...]) -> Branch:
        index = {**self._unit_index, unit.polynomial: len(self.units)}
        return replace(self, decisions=decisions, units=(*self.units, unit), _unit_index=index)

    def _with_equation(self, equation: Equation) -> Branch:
        """Return the branch on which the equation holds; its units are looked at again, as they may have got new factors.

        None of them becomes 0: before, the remainder of a unit was a product of irreducible units in the free parameters, and the equation
        is irreducible and no unit, so it does not divide this product.
        """
        decisions = (*self.decisions, (equation.polynomial, True))
        branch = replace(self, decisions=decisions, equations=(*self.equations, equation))
        for number, unit in enumerate(self.units):
            congruence = branch.congruence(unit.polynomial)
            if not congruence.remainder:
                raise ArithmeticError(f"{equation.polynomial} is not irreducible: the unit {unit.polynomial} would vanish with it")
            for factor, _ in factors(congruence.remainder)[1]:
                if factor not in branch._unit_index:
                    complement = _exact_quotient(congruence.remainder, factor)
                    derived = Unit(factor, source=number, complement=complement, congruence=congruence)
                    branch = branch._with_unit(derived, branch.decisions)
        return branch


Cases = tuple[tuple[Branch, Result], ...]


def explore(root: Branch, run: Callable[[Branch], Result]) -> Cases[Result]:
    """The results of `run` on the branches into which its questions split `root`; together they are `root`."""
    cases: list[tuple[Branch, Result]] = []
    waiting = [root]
    while waiting:
        branch = waiting.pop()
        try:
            cases.append((branch, run(branch)))
        except Undecided as undecided:
            waiting.extend(reversed(branch.split(undecided.polynomial)))
    return tuple(cases)


def refine(cases: Cases[Result], run: Callable[[Branch, Result], Other]) -> Cases[tuple[Result, Other]]:
    """Return the cases with `run` done on each of them, split further where `run` asks for it."""
    finer: list[tuple[Branch, tuple[Result, Other]]] = []
    for root, result in cases:

        def continued(branch: Branch, result: Result = result) -> tuple[Result, Other]:
            return result, run(branch, result)

        finer.extend(explore(root, continued))
    return tuple(finer)


def evaluate(f: Polynomial, values: Sequence[Any]) -> Any:
    """f at exact values of its leading generators, by its terms; generators beyond the values must not occur in f."""
    total: Any = 0
    for exponents, coefficient in f.items():
        if any(exponents[len(values) :]):
            raise ValueError(f"{f} has more indeterminates than the {len(values)} values given")
        term: Any = int(coefficient)
        for value, exponent in zip(values, exponents, strict=False):
            term *= value**exponent
        total += term
    return total


def factors(f: Polynomial) -> tuple[int, list[tuple[Polynomial, int]]]:
    """The integer content with sign and the irreducible factors with their exponents; f is not zero.

    The factors come from FLINT. They are multiplied again here, so nothing that follows rests on FLINT having been right;
    that each of them is irreducible only makes the case tree small.
    """
    ring = f.ring
    context = flint.fmpz_mpoly_ctx.get(tuple(str(symbol) for symbol in ring.symbols), flint.Ordering.lex)
    constant, powers = context.from_dict({e: int(c) for e, c in f.items()}).factor()
    sign = int(constant)
    result = []
    product = ring(sign)
    for factor, exponent in powers:
        polynomial = ring.from_dict({tuple(int(e) for e in m): ring.domain(int(c)) for m, c in factor.to_dict().items()})
        if polynomial.LC < 0:
            polynomial, sign = -polynomial, sign * (-1) ** int(exponent)
            product *= (-1) ** int(exponent)
        result.append((polynomial, int(exponent)))
        product *= polynomial ** int(exponent)
    if product != f:
        raise ArithmeticError(f"the factors of {f} do not multiply to it")
    return sign, result


def _divide(f: Polynomial, equation: Equation) -> tuple[int, Polynomial, Polynomial]:
    """Return (k, q, r) with initial**k f = q * equation + r and r free of the equation's parameter."""
    x, ring = equation.variable, f.ring
    quotient = ring.zero
    degree = _degree(f, x)
    for power in range(degree, 0, -1):
        shift = [0] * ring.ngens
        shift[x] = power - 1
        leading = _coefficient(f, x, power).mul_monom(tuple(shift))
        f = equation.initial * f - leading * equation.polynomial
        quotient = equation.initial * quotient + leading
    return degree, quotient, f


def _degree(f: Polynomial, x: int) -> int:
    """Return the degree in generator x, 0 for the zero polynomial."""
    return max((exponents[x] for exponents in f), default=0)


def _coefficient(f: Polynomial, x: int, power: int) -> Polynomial:
    """Return the coefficient of generator x to the power, a polynomial free of x."""
    terms = {}
    for exponents, coefficient in f.items():
        if exponents[x] == power:
            terms[(*exponents[:x], 0, *exponents[x + 1 :])] = coefficient
    return f.ring.from_dict(terms)


def coefficients(f: Polynomial, x: int) -> list[Polynomial]:
    """Return the coefficients of f by ascending powers of generator x; [] for the zero polynomial."""
    return [_coefficient(f, x, power) for power in range(_degree(f, x) + 1)] if f else []


def _exact_quotient(f: Polynomial, divisor: Polynomial) -> Polynomial | None:
    """Return f / divisor, or None where the division leaves a remainder."""
    quotient, remainder = f.div(divisor)
    return None if remainder else quotient


def _gcd(content: int, f: Polynomial) -> int:
    """Return the gcd of an integer and the coefficients of f."""
    for coefficient in f.values():
        content = int(flint.fmpz(content).gcd(flint.fmpz(int(coefficient))))
        if content == 1:
            break
    return content


def _simplicity(f: Polynomial) -> tuple[int, int, list[tuple[int, ...]]]:
    """Return a key by which few terms come first, then low degree; the exponents make the choice the same in every run."""
    return len(f), max((sum(exponents) for exponents in f), default=0), sorted(f)
