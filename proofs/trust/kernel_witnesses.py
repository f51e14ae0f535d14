"""These are the witnesses of what holds on all windows: kernel rows, and the hints by which the checker sees that there are no more.

    image_witness      the prime of a kernel representation, over Q(a) the root and why f is irreducible
    kernel_witness     rows of a kernel representation with hints; the next where there are none
    chain_witness      its rows of degree below a window, without hints
    common_witness     the same for two systems with the same rows
    generic_witness    rows modulo a prime alone, of a system whose windows have all the rank that their shape allows
    nulling_witness    the same, of one in which states and faults that no output shows keep them from it
    point_witness      an image and a point at which the pencil has full column rank modulo the prime
    irreducible        why a minimal polynomial is irreducible

A hint is drawn, and looked at before it is given away: a point q at which the rank of [[A - qI, F], [C, G]] is that of almost all, and a
mix t for which two determinants are coprime. Where the field has too few elements for that, the witness has none, and the checker follows
the chain W_k instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import gcd, prod
from random import Random
from typing import Any

from flint import fmpz_mat, fmpz_poly, nmod_mat, nmod_poly

from ...exact.algebra.fields import Field, NumberField, PrimeField, Rationals
from ...exact.algebra.matrices import Matrix, pivot_columns
from ...exact.structure.generic_rows import GenericRows, generic_rows
from ...exact.structure.kernel_rows import KernelRepresentation, KernelRow
from ...exact.structure.modular_rows import pencil_rank_at, rows_modulo
from ...exact.structure.nulling import nulling
from ...exact.structure.short_rows import short_rows
from ...exact.structure.window_columns import residues
from ...exact.structure.zero_output import zero_output_chain
from ...exact.system.modular import Image, image, primes_below, reduce_matrix
from ...exact.system.systems import ResidualSystem
from . import checker

Witness = dict[str, Any]
Shown = tuple[tuple[int, ...], Witness]
DRAWS = 8  # modulo a prime of 27 bits one in a thousand fails, at most; modulo a small one most may


def image_witness(kernel: KernelRepresentation) -> Witness:
    """Return the prime of the image, the root and why f is irreducible, each where the field has one."""
    return _named_image(kernel.image, kernel.system.field)


def point_witness(kernel: KernelRepresentation) -> Witness:
    """Return the image and, where one is found, a point at which the pencil has rank n + m modulo the prime."""
    system = kernel.image.system
    return image_witness(kernel) | _point([system], system.p - system.m)


def kernel_witness(kernel: KernelRepresentation, window: int | None = None) -> Witness:
    """Return all rows, shortened, with hints. Where there are no hints: the rows of degree below the window, for the chain."""
    return _hinted(_Same(kernel)) or chain_witness(kernel, window)


def chain_witness(kernel: KernelRepresentation, window: int | None = None) -> Witness:
    """Return the rows of degree below the window, without hints."""
    return image_witness(kernel) | {"kernel": _written(kernel.rows_within(window))}


def common_witness(other: ResidualSystem, kernel: KernelRepresentation) -> Witness:
    """Return the rows of a kernel representation, which are also those of another system, with hints for both at one prime.

    Without hints: a prime modulo which both systems have the gaps of the rows.
    """
    rows, field = _short(kernel), kernel.system.field
    for first, second in _common_images(kernel, other):
        hints = _hints([first.system, second.system], rows, first)
        if hints is not None:
            return _named_image(first, field) | hints | {"kernel": _written(rows)}
        if isinstance(field, PrimeField) or _have_gaps((first.system, second.system), kernel):
            return _named_image(first, field) | {"kernel": _written(kernel.rows)}
    raise ArithmeticError("no prime serves both systems")


def window_witness(other: ResidualSystem, kernel: KernelRepresentation, window: int) -> Witness:
    """Return the rows of degree below a window, and a prime modulo which both systems have their gaps on it."""
    for first, second in _common_images(kernel, other):
        if _have_gaps((first.system, second.system), kernel, window):
            return _named_image(first, kernel.system.field) | {"kernel": _written(kernel.rows_within(window))}
    raise ArithmeticError("no prime serves both systems")


def generic_witness(system: ResidualSystem) -> Shown | None:
    """Return the left minimal indices and the witness of a system over Q or Q(a) whose windows have all the rank that their shape allows.

    None for any other system, and where the first prime misleads: it takes exact rows to see what that one is.
    """
    picture = image(system)
    found = None if isinstance(system.field, PrimeField) else generic_rows(picture.system)
    if found is None or (found.rows and (sum(found.degrees) != system.n or not _alike(found))):
        return None
    return _shown(system, picture, found, {})


def nulling_witness(system: ResidualSystem) -> Shown | None:
    """Return the same where only states and faults without output keep windows from that rank, and are told by small numbers. Over Q."""
    if not isinstance(system.field, Rationals):
        return None
    picture = image(system)
    found = generic_rows(picture.system) or _other_rows(picture.system)
    if found is None or not found.rows or not _alike(found):
        return None
    n, demands = system.n, _conditions(picture.system, _coefficients(found.rows, system.p, picture.prime))
    null = nulling(system, picture.system, [row[:n] for demand in demands for row in residues(demand) if any(row[:n])])
    if null is None:
        return None
    parts = {"states": null.states, "faults": null.faults, "motion": null.motion}
    return _shown(system, picture, found, {"nulling": {name: _plain(part) for name, part in parts.items()}})


def irreducible(field: Field) -> Witness:
    """Return, over Q(a) with d >= 2, a prime modulo which f is irreducible, or Eisenstein after a shift; nothing where neither is found."""
    if not isinstance(field, NumberField) or field.degree < 2:
        return {}
    coefficients = [int(c) for c in field.integer_polynomial.coeffs()]
    bad = coefficients[-1] * prod(c.denominator for c in field.minimal_polynomial)
    for prime in sorted(primes_below(997)):
        if bad % prime and _is_irreducible(nmod_poly(coefficients, prime)):
            return {"irreducible": {"modulo": prime}}
    for shift in range(-20, 21):
        shifted = field.integer_polynomial(fmpz_poly([shift, 1]))
        values = [int(c) for c in shifted.coeffs()]
        content = gcd(*values)
        values = [value // content for value in values]
        for prime in sorted(primes_below(97)):
            if values[-1] % prime and all(c % prime == 0 for c in values[:-1]) and values[0] % prime**2:
                return {"irreducible": {"eisenstein": {"prime": prime, "shift": shift}}}
    return {}


# -- parts -------------------------------------------------------------------------------------------------------------


def _is_irreducible(poly: nmod_poly) -> bool:
    _, factors = poly.factor()
    return len(factors) == 1 and factors[0][1] == 1


def _named_image(picture: Image, field: Field) -> Witness:
    return named_image(picture.prime, picture.root, field)


def named_image(prime: int, root: int | None, field: Field) -> Witness:
    """Return the prime, the root and why f is irreducible, each where the field has one."""
    if isinstance(field, PrimeField):
        return {}
    return {"prime": prime} | ({} if root is None else {"root": root}) | irreducible(field)


def _common_images(kernel: KernelRepresentation, other: ResidualSystem) -> Any:
    """Yield the images of both systems at the primes that serve both, from that of the kernel representation down."""
    if isinstance(kernel.system.field, PrimeField):
        yield kernel.image, image(other)
        return
    largest = kernel.image.prime
    while True:
        pictures = [image(system, largest=largest) for system in (kernel.system, other)]
        largest = min(picture.prime for picture in pictures)
        if pictures[0].prime == pictures[1].prime:
            yield tuple(pictures)
            largest -= 1


def _have_gaps(systems: Sequence[ResidualSystem], kernel: KernelRepresentation, window: int | None = None) -> bool:
    samples = max(system.n for system in systems) + 1 if window is None else window
    chains = [zero_output_chain(system) for system in systems]
    return all(chain.gap(k) == kernel.gap(k) for chain in chains for k in range(samples))


def _other_rows(picture: ResidualSystem) -> GenericRows | None:
    found = rows_modulo(picture)
    return None if found is None else GenericRows(found.rows, tuple(output for _, output in found.leads), found.point)


def _alike(found: GenericRows) -> bool:
    return found.degrees[-1] - found.degrees[0] <= 1


def _shown(system: ResidualSystem, picture: Image, found: GenericRows, more: Witness) -> Shown | None:
    hints = _mixed([picture.system], found.rows, found.pivots, picture.prime)
    if hints is None:
        return None
    written = [{"pivot": pivot, "coefficients": row} for pivot, row in zip(found.pivots, found.rows, strict=True)]
    return found.degrees, _named_image(picture, system.field) | {"point": found.point} | hints | more | {"kernel_modulo": written}


def _plain(matrix: Matrix) -> list[list[object]]:
    """Return the matrix as it is written, integers as such: most are zeros."""
    return [[x if "/" in str(x) else int(str(x)) for x in row] for row in matrix.to_json()]


class _Same:
    """This is a kernel representation as a key: it is equal to itself alone, which is quick to see."""

    def __init__(self, kernel: KernelRepresentation) -> None:
        self.kernel = kernel

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and self.kernel is other.kernel

    def __hash__(self) -> int:
        return id(self.kernel)


@lru_cache(maxsize=4)  # a system is asked for several certificates, one after the other
def _hinted(same: _Same) -> Witness | None:
    kernel, rows = same.kernel, _short(same.kernel)
    hints = _hints([kernel.image.system], rows, kernel.image)
    return None if hints is None else image_witness(kernel) | hints | {"kernel": _written(rows)}


def _short(kernel: KernelRepresentation) -> tuple[KernelRow, ...]:
    """Return the rows, over Q shortened, with pivots at which the leading coefficients are independent modulo the prime."""
    if not isinstance(kernel.system.field, Rationals) or not kernel.rows:
        return kernel.rows
    tables = [[[int(x) for x in row] for row in one.coefficients.flint.numer_denom()[0].tolist()] for one in kernel.rows]
    short = short_rows(tables, [row.pivot for row in kernel.rows])
    if short == tables:
        return kernel.rows
    leading = nmod_mat(fmpz_mat([row[-1] for row in short]), kernel.image.prime)
    pivots = pivot_columns(leading.rref()[0])
    return tuple(KernelRow(pivot, Matrix.of(row)) for pivot, row in zip(pivots, short, strict=True))


def _written(rows: Sequence[KernelRow]) -> list[dict[str, Any]]:
    return [{"pivot": row.pivot, "coefficients": row.coefficients.to_json()} for row in rows]


def _point(systems: Sequence[ResidualSystem], missing: int) -> Witness:
    """Return a point at which the pencils of all systems have rank n + p less what is missing; nothing where none is found."""
    prime, rng = systems[0].field.p, Random(0)  # type: ignore[union-attr]
    for _ in range(DRAWS):
        point = rng.randrange(prime)
        if all(pencil_rank_at(system, point) >= system.n + system.p - missing for system in systems):
            return {"point": point}
    return {}


def _hints(systems: Sequence[ResidualSystem], rows: Sequence[KernelRow], picture: Image) -> Witness | None:
    """Return a point and a mix with which the checker sees the rows to be a minimal basis for each of the systems over GF(l)."""
    reduced = [reduce_matrix(row.coefficients, picture.prime, picture.root) for row in rows]
    point = _point(systems, len(rows))
    if not point or any(one is None for one in reduced):
        return None
    mix = _mixed(systems, [residues(one.flint) for one in reduced if one is not None], [row.pivot for row in rows], picture.prime)
    return None if mix is None else point | mix


def _mixed(systems: Sequence[ResidualSystem], rows: Sequence[list[list[int]]], pivots: Sequence[int], prime: int) -> Witness | None:
    """Return a mix for rows of residues, with these pivots."""
    degree, p = sum(len(row) - 1 for row in rows), systems[0].p
    if prime <= degree:
        return None
    coefficients = _coefficients(rows, p, prime)
    checker.begin()
    try:
        places = [[int(i == pivot) for pivot in pivots] for i in range(p)]
        first = checker.determinant_polynomial(_polynomials(coefficients, places, prime), degree, prime)
        return _mix(systems, coefficients, first, prime)
    except checker.Rejected:  # the determinants take more work than there may be
        return None


def _coefficients(rows: Sequence[list[list[int]]], p: int, prime: int) -> list[nmod_mat]:
    """Return N_k of all rows, k = 0, 1, ..., in one matrix each."""
    blank, longest = [0] * p, max(map(len, rows), default=0)
    return [nmod_mat(len(rows), p, [x for row in rows for x in (row[k] if k < len(row) else blank)], prime) for k in range(longest)]


def _mix(systems: Sequence[ResidualSystem], coefficients: Sequence[nmod_mat], first: list[int], prime: int) -> Witness | None:
    """Return a mix for which the second determinant of every system has no factor in common with the first."""
    if not first[-1]:
        return None
    rng, count = Random(1), coefficients[0].nrows() if coefficients else 0
    conditions = [_conditions(system, coefficients) for system in systems]
    for _ in range(DRAWS):
        mix = rng.randrange(1, prime)
        serves = True
        for system, demands in zip(systems, conditions, strict=True):
            powers = [pow(mix, i + 1, prime) for i in range(system.n + system.p)]
            weights = [[pow(power, b + 1, prime) for b in range(count)] for power in powers]
            second = checker.determinant_polynomial(_polynomials(demands, weights, prime), len(first) - 1, prime)
            serves = serves and checker.coprime(first[:], second, prime)
        if serves:
            return {"mix": mix}
    return None


def _conditions(system: ResidualSystem, coefficients: Sequence[nmod_mat]) -> list[nmod_mat]:
    """Return [X_(k+1), N_k] of all rows, k = 0, 1, ..., in one matrix each."""
    A, C, found = system.A.flint, system.C.flint, list[nmod_mat]()
    n, p = system.n, system.p
    prime = system.field.p  # type: ignore[union-attr]
    left = nmod_mat(n, n + p, [int(i == j) for i in range(n) for j in range(n + p)], prime)
    right = nmod_mat(p, n + p, [int(i == j - n) for i in range(p) for j in range(n + p)], prime)
    state = nmod_mat(coefficients[0].nrows() if coefficients else 0, n, prime)
    for coefficient in reversed(coefficients):
        found.append(state * left + coefficient * right)
        state = coefficient * C + state * A
    return found[::-1]


def _polynomials(coefficients: Sequence[nmod_mat], weights: Sequence[Sequence[int]], prime: int) -> list[list[list[int]]]:
    """Return the matrix of polynomials sum of (coefficients_k weights) q^k."""
    if not coefficients:
        return []
    count = coefficients[0].nrows()
    mixed = nmod_mat(fmpz_mat(weights), prime)
    values = [[int(x) for x in (coefficient * mixed).entries()] for coefficient in coefficients]
    return [[[value[a * count + b] for value in values] for b in range(count)] for a in range(count)]
