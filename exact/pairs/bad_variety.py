"""This describes the bad P as a variety: its dimension in every case, and for small cases its equations written out and factored.

    BadSet              dimension and codimension in the n_z r entries of P, and the strata that give them
    bad_set             by counting parameters
    BadStratum          the bad P whose L(q) P, of rank r - 1, has rows in a module with minimal indices `indices`
    BadEquations        the zeta + 1 coefficients of D(q; P), expanded in the entries of P, as sympy expressions, with factors
    bad_equations       over Q and prime fields, up to MAX_ENTRIES entries

P is bad iff det(L(q) P) = 0, and L(q) P is any r x r matrix Q(q) with row j of degree at most k_j (the map to Q is onto and linear, so
that codimensions stay). The singular Q of rank r - 1 are sorted by the minimal indices e_1 <= ... <= e_(r-1) of the module that their
rows span, saturated. Such modules are the kernels of a polynomial vector of degree d = sum e_i, up to scale: r (d + 1) - 1 parameters,
less sum_(i<j) max(0, e_j - e_i - 1), the codimension of the splitting type e among them; each row then has sum_i max(0, k_j - e_i + 1)
parameters. Rank r - 1 is reached iff e_i <= k_(i+1), and every singular Q is a limit of such ones (add a multiple of one row times a
polynomial vector: the rank grows by at most one). e = 0 is the set of rank-deficient P when (A, C) is observable: codimension zeta + 1.
Source: [F75]; the splitting types of the module are those of vector bundles on the line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from flint import Ordering, nmod_mpoly_ctx

from ...base.errors import InvalidInput
from ...base.sheets import Shown, counted
from ..algebra.fields import NumberField, PrimeField, Rationals
from ..algebra.notation import several
from ..system.systems import System
from .pluecker import coefficient_forms, forms_of_determinant
from .polynomial import Exceptional, pencil_of

MAX_ENTRIES = 16
MAX_STRATA = 100_000


@dataclass(frozen=True)
class BadStratum:
    """`indices` are the minimal indices e of the row module of L(q) P, ascending, and `codimension` is that of the bad P of that type."""

    indices: tuple[int, ...]
    codimension: int


@dataclass(frozen=True, repr=False)
class BadSet(Shown):
    """Over an algebraically closed field `dimension` + `codimension` = n_z r; for r = 0 there is no bad P, and both are None.

    `strata` are ordered by codimension; those of the least one make components of largest dimension.
    """

    exceptional: Exceptional
    dimension: int | None
    codimension: int | None
    strata: tuple[BadStratum, ...]

    @property
    def rank_deficient_codimension(self) -> int | None:
        """The codimension of the P that are not of full column rank: n_z - r + 1 = zeta + 1; None for r = 0."""
        return None if self.exceptional.columns == 0 else self.exceptional.zeta + 1

    def to_json(self) -> dict[str, Any]:
        """The result holds the dimensions, the degrees k_j and the strata."""
        return {
            "entries": self.exceptional.n_z * self.exceptional.columns,
            "left_degrees": list(self.exceptional.left_degrees),
            "dimension": self.dimension,
            "codimension": self.codimension,
            "rank_deficient_codimension": self.rank_deficient_codimension,
            "strata": [{"indices": list(s.indices), "codimension": s.codimension} for s in self.strata],
        }

    @property
    def title(self) -> str:
        """This says how large the bad set is."""
        if self.codimension is None:
            return "no P is bad: the normal rank is 0"
        return f"dimension {self.dimension}, codimension {self.codimension}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the strata, by codimension, and the codimension of the P of deficient rank."""
        yield "codimension of rank-deficient P", str(self.rank_deficient_codimension)
        for stratum in self.strata:
            yield f"indices {several(stratum.indices)}", f"codimension {stratum.codimension}"


@dataclass(frozen=True, repr=False)
class BadEquations(Shown):
    """`equations[k]` is the coefficient of q^k in D(q; P), in the `entries` p11, p12, ... of P by rows.

    `factors[k]` holds its (factor, exponent) pairs, and `degree` is that of D in the entries, r; D is linear in each single one. All
    equations vanish exactly at the bad P.
    """

    exceptional: Exceptional
    entries: tuple[Any, ...]
    equations: tuple[Any, ...]
    factors: tuple[tuple[tuple[Any, int], ...], ...]

    @property
    def degree(self) -> int:
        """The degree is r."""
        return self.exceptional.columns

    def to_json(self) -> dict[str, Any]:
        """Return the equations and their factors as texts."""
        return {
            "equations": [str(f) for f in self.equations],
            "factors": [[[str(g), e] for g, e in factors] for factors in self.factors],
        }

    @property
    def title(self) -> str:
        """This says how many equations there are in how many entries."""
        return (
            f"{counted(len(self.equations), 'equation')} of degree {self.degree} in {counted(len(self.entries), 'entry', 'entries')} of P"
        )

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the equations, by power of q."""
        for power, equation in enumerate(self.equations):
            yield f"coefficient of q^{power}", str(equation)


def bad_set(pencil: Exceptional | System) -> BadSet:
    """Return the dimension and the codimension of the bad P, the n_z x r matrices whose pair is not equivalent to the system.

    Source: [F75], [G25] Theorem 3.

    Parameters
    ----------
    pencil : Exceptional or System
        Over any field; dimensions are those over the algebraic closure.

    Returns
    -------
    BadSet
        It also lists the `strata`, by the minimal indices of what L(q) P spans.

    Raises
    ------
    InvalidInput
        Where there are more than 100000 strata to compare.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, bad_set, exceptional, kernel_representation
    >>> system = ResidualSystem.of([[0, 1], [0, 0]], [[1, 0], [0, 1]], [[1, 0], [0, 1]], [[0, 0], [0, 0]])
    >>> found = bad_set(exceptional(kernel_representation(system)))
    >>> found.dimension, found.codimension, [stratum.indices for stratum in found.strata]
    (5, 3, [(0,), (1,)])
    """
    pencil = pencil_of(pencil)
    degrees, r = pencil.left_degrees, pencil.columns
    if r == 0:
        return BadSet(pencil, None, None, ())
    strata = []
    for count, indices in enumerate(_index_lists(degrees[1:])):
        if count == MAX_STRATA:
            raise InvalidInput(f"bad set: the degrees {degrees} have more than {MAX_STRATA} strata; fewer faults have fewer")
        strata.append(BadStratum(indices, _codimension(degrees, indices)))
    strata.sort(key=lambda s: (s.codimension, s.indices))
    least = strata[0].codimension
    return BadSet(pencil, pencil.n_z * r - least, least, tuple(strata))


def bad_equations(pencil: Exceptional | System) -> BadEquations:
    """Return the equations of the bad P: the zeta + 1 coefficients of D(q; P), expanded in the entries of P and factored.

    P, of shape n_z x r, is bad iff all coefficients are 0. Source: [G25] Theorem 3.

    Parameters
    ----------
    pencil : Exceptional or System
        Over Q or a prime field, with at most 16 entries in P.

    Returns
    -------
    BadEquations
        `entries`, the sympy symbols p11, p12, ..., `equations` and `factors`.

    Raises
    ------
    InvalidInput
        For more entries, and over Q(a).

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, bad_equations, exceptional, kernel_representation
    >>> found = bad_equations(exceptional(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]))))
    >>> found.entries, found.equations
    ((p11, p21), (-p11 + p21/2, -p21))
    """
    pencil = pencil_of(pencil)
    field, n_z, r = pencil.system.field, pencil.n_z, pencil.columns
    if isinstance(field, NumberField):
        raise InvalidInput(f"bad set: equations are expanded over Q and prime fields, got {field}; coefficient_forms has no such limit")
    if n_z * r > MAX_ENTRIES:
        raise InvalidInput(
            f"bad set: P has {n_z} x {r} entries, at most {MAX_ENTRIES} are expanded; coefficient_forms gives the equations in the "
            f"minors of P, judge decides one P"
        )
    import sympy  # here and below, where it is needed

    symbols = sympy.Matrix(n_z, r, lambda i, j: sympy.Symbol(f"p{i + 1}{j + 1}"))
    subsets, forms = coefficient_forms(forms_of_determinant(pencil))
    minors = [symbols.extract(list(J), list(range(r))).det(method="berkowitz") for J in subsets]
    equations, factors = [], []
    for row in forms.elements():
        sum_ = sympy.expand(sympy.Add(*(_sympy_number(c, field) * minor for c, minor in zip(row, minors, strict=True))))
        if isinstance(field, PrimeField):
            sum_, found = _reduced_and_factored(sum_, symbols, field.p)
        else:
            constant, powers = sympy.factor_list(sum_)
            found = _factors(constant, powers)
        equations.append(sum_)
        factors.append(found)
    return BadEquations(pencil, tuple(symbols), tuple(equations), tuple(factors))


def _index_lists(bounds: Sequence[int], least: int = 0) -> Iterator[tuple[int, ...]]:
    """Yield all ascending e with e_i <= bounds_i."""
    if not bounds:
        yield ()
        return
    for e in range(least, bounds[0] + 1):
        for rest in _index_lists(bounds[1:], e):
            yield (e, *rest)


def _codimension(degrees: Sequence[int], indices: Sequence[int]) -> int:
    """Return the codimension of the Q with this type among all with row degrees at most `degrees`."""
    r = len(degrees)
    modules = r * (sum(indices) + 1) - 1 - sum(max(0, y - x - 1) for x, y in combinations(indices, 2))
    rows = sum(max(0, k - e + 1) for k in degrees for e in indices)
    return sum(r * (k + 1) for k in degrees) - modules - rows


def _factors(constant: Any, powers: Sequence[tuple[Any, int]]) -> tuple[tuple[Any, int], ...]:
    """Return the constant, unless it is 1, and the powers."""
    import sympy

    return (*([(sympy.sympify(constant), 1)] if constant != 1 else []), *((g, int(e)) for g, e in powers))


def _reduced_and_factored(f: Any, symbols: Any, prime: int) -> tuple[Any, tuple[tuple[Any, int], ...]]:
    """Return f modulo the prime with residues in 0..p-1, and its factors, by FLINT: sympy factors in one unknown only."""
    import sympy

    if not len(symbols):
        return f % prime, _factors(f % prime, [])
    context = nmod_mpoly_ctx.get([str(x) for x in symbols], modulus=prime, ordering=Ordering.lex)

    def back(g: Any) -> Any:
        return sympy.Add(*(int(c) * sympy.Mul(*(x ** int(e) for x, e in zip(symbols, es, strict=True))) for es, c in g.to_dict().items()))

    image = context.from_dict({es: int(c) % prime for es, c in sympy.Poly(f, *symbols).terms() if int(c) % prime})
    if not image:
        return sympy.Integer(0), _factors(0, [])
    constant, powers = image.factor()
    return back(image), _factors(int(constant), [(back(g), e) for g, e in powers])


def _sympy_number(value: Any, field: Rationals | PrimeField) -> Any:
    import sympy

    return sympy.Integer(int(value)) if isinstance(field, PrimeField) else sympy.Rational(int(value.p), int(value.q))
