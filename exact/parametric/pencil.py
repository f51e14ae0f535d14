"""This computes normal rank and zeros of the pencil P(q) = [[q I - A, -F], [C, G]] for all parameter values of a branch.

Nothing here uses the windows [O_s T_s]: the normal rank comes from minors of P in ZZ[entries][q], the finite zeros from
the greatest common divisor of its maximal minors, the infinite ones from an ordinary elimination of T_s. That makes them
an independent measure of what the elimination in `stratification` found. All functions ask a `Branch`, so `refine` runs
them on every stratum. What they return carries congruences, which `pencil_expansion` multiplies out by FLINT.

    indeterminate_pencil, determinant
    NormalRank, normal_rank     minors that vanish, and one that does not
    FiniteZeros, finite_zeros   gcd of the maximal minors, for full column rank, with cofactors both ways
    Echelon, toeplitz_echelon   rank profile of T_s by rows in the order of time
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from .case_tree import Branch, Congruence, Polynomial, UnitProduct, coefficients
from .stratification import Indeterminates, Row

Minor = tuple[tuple[int, ...], tuple[int, ...]]
Table = Sequence[Sequence[Polynomial]]


@dataclass(frozen=True)
class NormalRank:
    """P has normal rank `rank` everywhere on the branch, which is n + r.

    `vanishing` pairs each minor (rows, columns) of size rank + 1 with the congruence that makes it 0; `witness` is a minor
    of size rank whose coefficient of q**power leaves, by `congruence`, a remainder that is the product `unit`.
    """

    rank: int
    vanishing: tuple[tuple[Minor, Congruence], ...]
    witness: Minor
    power: int
    congruence: Congruence
    unit: UnitProduct


@dataclass(frozen=True)
class FiniteZeros:
    """`divisor` is the greatest common divisor of the minors of size n + m, a polynomial in q whose leading coefficient is a unit.

    `combination` proves that the sum of bezout[k] * minors[k] is the divisor, `multiples` that scales[k] * minors[k] = quotients[k] *
    divisor with a product of units scales[k]; all are modulo the equations, and the congruences are of left side minus right side.
    """

    divisor: Polynomial
    degree: int
    leading: UnitProduct
    minors: tuple[Minor, ...]
    bezout: tuple[Polynomial, ...]
    combination: Congruence
    scales: tuple[UnitProduct, ...]
    quotients: tuple[Polynomial, ...]
    multiples: tuple[Congruence, ...]


@dataclass(frozen=True)
class EchelonRow:
    """sum of coefficients * rows = residual modulo the equations; `pivot` is a column, None where the residual is 0."""

    row: Row
    coefficients: tuple[tuple[Row, Polynomial], ...]
    residual: tuple[Polynomial, ...]
    pivot: int | None
    leading: UnitProduct
    pivot_value: UnitProduct | None
    congruences: tuple[Congruence, ...]


@dataclass(frozen=True)
class Echelon:
    """The rows of T_s in the order of time, each reduced by the independent ones before it."""

    samples: int
    rows: tuple[EchelonRow, ...]

    def rank(self, s: int) -> int:
        """rank T_s for s up to `samples`; raises ValueError beyond."""
        if not 0 <= s <= self.samples:
            raise ValueError(f"T_s was eliminated for s = 0 to {self.samples} (got {s})")
        return sum(row.pivot is not None for row in self.rows if row.row[0] < s)


def indeterminate_pencil(entries: Indeterminates, F: Table, G: Table) -> list[list[Polynomial]]:
    """Return [[q I - A, -F], [C, G]] for the A and C of the entries, (n + p) x (n + columns of F and G)."""
    upper = [
        [(entries.q if i == j else 0) - f for j, f in enumerate(row)] + [-f for f in line]
        for i, (row, line) in enumerate(zip(entries.A, F, strict=True))
    ]
    return upper + [[*row, *line] for row, line in zip(entries.C, G, strict=True)]


def determinant(entries: Indeterminates, matrix: Sequence[Sequence[Polynomial]], minor: Minor) -> Polynomial:
    """Return the minor, by sympy's division-free characteristic polynomial."""
    from sympy.polys.matrices import DomainMatrix  # here, where it is needed

    rows, columns = minor
    size = len(rows)
    if size == 0:
        return entries.ring.one
    domain = entries.ring.to_domain()
    square = DomainMatrix([[matrix[i][j] for j in columns] for i in rows], (size, size), domain)
    return (-1) ** size * square.charpoly()[-1]


def minors_of_size(height: int, width: int, size: int) -> list[Minor]:
    """Return all choices of rows and columns; for size 0 there is the empty minor, which is 1."""
    return [(rows, columns) for rows in combinations(range(height), size) for columns in combinations(range(width), size)]


def normal_rank(entries: Indeterminates, branch: Branch) -> NormalRank:
    """Normal rank of P, by its minors from the largest down; raises Undecided when the branch must be split."""
    matrix = indeterminate_pencil(entries, entries.F, entries.G)
    height, width = entries.n + entries.p, entries.n + entries.m
    vanishing: list[tuple[Minor, Congruence]] = []
    for size in range(min(height, width), -1, -1):
        smaller: list[tuple[Minor, Congruence]] = []
        for minor in minors_of_size(height, width, size):
            value = determinant(entries, matrix, minor)
            # Highest power first: its coefficient is the simplest, often a constant.
            for power, f in reversed(list(enumerate(coefficients(value, entries.parameters)))):
                if not branch.is_zero(f):
                    congruence = branch.congruence(f)
                    unit = branch.unit_product(congruence.remainder)
                    return NormalRank(size, tuple(vanishing), minor, power, congruence, unit)
            smaller.append((minor, branch.congruence(value)))
        vanishing = smaller
    raise ArithmeticError("the empty minor is 1")


def finite_zeros(entries: Indeterminates, branch: Branch) -> FiniteZeros:
    """Return the gcd of the minors of size n + m, which are not all 0, by Euclid's algorithm; raises Undecided.

    Raises ArithmeticError when the pencil has not full column rank on the branch.
    """
    matrix = indeterminate_pencil(entries, entries.F, entries.G)
    minors = minors_of_size(entries.n + entries.p, entries.n + entries.m, entries.n + entries.m)
    values = [determinant(entries, matrix, minor) for minor in minors]
    zero, one = entries.ring.zero, entries.ring.one
    divisor, bezout = zero, [zero] * len(values)
    for number, value in enumerate(values):
        unit_vector = [one if k == number else zero for k in range(len(values))]
        first, second = _tidy(entries, branch, value, unit_vector), (divisor, bezout)
        while second[0]:
            first, second = second, _remainder(entries, branch, first, second)
        divisor, bezout = first
    if not divisor:
        raise ArithmeticError("all minors of size n + m vanish: the pencil has not full column rank")
    leading = branch.unit_product(_leading(entries, divisor))
    products = (b * value for b, value in zip(bezout, values, strict=True))
    combination = branch.congruence(sum(products, zero) - divisor)
    scales, quotients, multiples = [], [], []
    for value in values:
        congruence = branch.congruence(value)
        power, quotient, rest = _divided(entries, congruence.remainder, divisor)
        if rest:
            raise ArithmeticError("the greatest common divisor does not divide a minor")
        scales.append(congruence.multiplier * leading**power)
        quotients.append(quotient)
        factor = _leading(entries, divisor) ** power
        multiples.append(Congruence(UnitProduct(), tuple(factor * cofactor for cofactor in congruence.cofactors), zero))
    if combination.remainder:
        raise ArithmeticError("the greatest common divisor is not the combination that Euclid's algorithm found")
    return FiniteZeros(
        divisor,
        len(coefficients(divisor, entries.parameters)) - 1,
        leading,
        tuple(minors),
        tuple(bezout),
        combination,
        tuple(scales),
        tuple(quotients),
        tuple(multiples),
    )


def toeplitz_echelon(entries: Indeterminates, branch: Branch, samples: int) -> Echelon:
    """Rank profile of T_s, s up to `samples`, by plain elimination; raises Undecided when the branch must be split."""
    n, width = entries.n, samples * entries.m
    done: list[EchelonRow] = []
    for row in ((k, i) for k in range(samples) for i in range(entries.p)):
        residual = entries.window_row(row, samples)[n:]
        combination: dict[Row, Polynomial] = {row: entries.ring.one}
        residual, combination = _tidy_row(branch, residual, combination)
        for earlier in done:
            if earlier.pivot is None or not residual[earlier.pivot]:
                continue
            entry, scale = residual[earlier.pivot], earlier.residual[earlier.pivot]
            residual = [scale * x - entry * y for x, y in zip(residual, earlier.residual, strict=True)]
            before = dict(earlier.coefficients)
            combination = {key: scale * combination.get(key, 0) - entry * before.get(key, 0) for key in combination.keys() | before}
            residual, combination = _tidy_row(branch, residual, combination)
        pivot = next((c for c in reversed(range(width)) if not branch.is_zero(residual[c])), None)
        done.append(_certified(entries, branch, samples, row, residual, combination, pivot))
    return Echelon(samples, tuple(done))


def _certified(
    entries: Indeterminates,
    branch: Branch,
    samples: int,
    row: Row,
    residual: list[Polynomial],
    combination: dict[Row, Polynomial],
    pivot: int | None,
) -> EchelonRow:
    difference = [-f for f in residual]
    for key, f in combination.items():
        line = entries.window_row(key, samples)[entries.n :]
        difference = [x + f * y for x, y in zip(difference, line, strict=True)]
    congruences = tuple(branch.congruence(f) for f in difference)
    if any(congruence.remainder for congruence in congruences):
        raise ArithmeticError(f"the combination of rows for {row} is not what the elimination made of it")
    return EchelonRow(
        row,
        tuple(sorted(combination.items(), key=lambda pair: pair[0])),
        tuple(residual),
        pivot,
        branch.unit_product(combination[row]),
        None if pivot is None else branch.unit_product(residual[pivot]),
        congruences,
    )


def _tidy_row(
    branch: Branch, residual: list[Polynomial], combination: dict[Row, Polynomial]
) -> tuple[list[Polynomial], dict[Row, Polynomial]]:
    keys = sorted(combination)
    vector = branch.without_units(branch.joint_reduce([*residual, *(combination[key] for key in keys)]))
    rest = zip(keys, vector[len(residual) :], strict=True)
    return vector[: len(residual)], {key: f for key, f in rest if f}


def _tidy(entries: Indeterminates, branch: Branch, f: Polynomial, bezout: list[Polynomial]) -> tuple[Polynomial, list[Polynomial]]:
    """Return f modulo the equations with its leading zeros in q dropped, so that the leading coefficient is a unit."""
    f, *bezout = branch.without_units(branch.joint_reduce([f, *bezout]))
    if f:
        branch.is_zero(_leading(entries, f))
    return f, bezout


def _leading(entries: Indeterminates, f: Polynomial) -> Polynomial:
    return coefficients(f, entries.parameters)[-1]


def _divided(entries: Indeterminates, f: Polynomial, divisor: Polynomial) -> tuple[int, Polynomial, Polynomial]:
    """Return (k, Q, R) with leading**k f = Q divisor + R and R of lower degree in q than the divisor."""
    leading, degree = _leading(entries, divisor), len(coefficients(divisor, entries.parameters)) - 1
    quotient, power = entries.ring.zero, 0
    while f and (excess := len(coefficients(f, entries.parameters)) - 1 - degree) >= 0:
        term = _leading(entries, f) * entries.q**excess
        quotient = leading * quotient + term
        f = leading * f - term * divisor
        power += 1
    return power, quotient, f


def _remainder(
    entries: Indeterminates,
    branch: Branch,
    dividend: tuple[Polynomial, list[Polynomial]],
    divisor: tuple[Polynomial, list[Polynomial]],
) -> tuple[Polynomial, list[Polynomial]]:
    power, quotient, rest = _divided(entries, dividend[0], divisor[0])
    scale = _leading(entries, divisor[0]) ** power
    bezout = [scale * x - quotient * y for x, y in zip(dividend[1], divisor[1], strict=True)]
    return _tidy(entries, branch, rest, bezout)
