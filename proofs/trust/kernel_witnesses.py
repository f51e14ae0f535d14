"""These are the witnesses of what holds on all windows: kernel rows, and the hints by which the checker sees that there are no more.

    image_witness      the prime of a kernel representation, over Q(a) the root and why f is irreducible
    kernel_witness     rows of a kernel representation with hints; the next where there are none
    chain_witness      its rows of degree below a window, without hints
    common_witness     the same for two systems with the same rows
    modular_witness    rows modulo a prime alone, of a system whose windows have all the rank that their shape allows, or all but what
                       states and faults that no output shows keep from them
    point_witness      an image and a point at which the pencil has full column rank modulo the prime
    irreducible        why a minimal polynomial is irreducible

A hint is looked at before it is given away: a point q, or infinity, at which the rank of [[A - qI, F], [C, G]] is that of almost all. Where
the field has too few elements for that, the witness has none, and the checker follows the chain W_k instead.
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
from ...exact.structure.kernel_rows import KernelRepresentation, KernelRow
from ...exact.structure.modular_rows import DRAWS, Point, pencil_rank_at, placed, rows_modulo, states_of
from ...exact.structure.nulling import nulling
from ...exact.structure.short_rows import short_rows
from ...exact.structure.zero_output import zero_output_chain
from ...exact.system.modular import Image, image, primes_below, reduce_matrix
from ...exact.system.systems import ResidualSystem

Witness = dict[str, Any]
Shown = tuple[tuple[int, ...], Witness]


def image_witness(kernel: KernelRepresentation) -> Witness:
    """Return the prime of the image, the root and why f is irreducible, each where the field has one."""
    return _named_image(kernel.image, kernel.system.field)


def point_witness(kernel: KernelRepresentation) -> Witness:
    """Return the image and, where one is found, a point at which the pencil has rank n + m modulo the prime."""
    system = kernel.image.system
    point = _point([system], system.p - system.m)
    return image_witness(kernel) | ({} if point is None else {"point": point})


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


def modular_witness(system: ResidualSystem) -> Shown | None:
    """Return the left minimal indices and the witness of a system over Q or Q(a) whose windows have all the rank that their shape allows.

    Over Q also of one whose windows lack only what states and faults without output take from them, if small numbers tell these. None for
    any other system, and where the prime misleads: it takes exact rows to see what that one is.
    """
    if isinstance(system.field, PrimeField):
        return None
    picture = image(system)
    found = rows_modulo(picture.system)
    if found is None or (found.degrees and found.degrees[-1] - found.degrees[0] > 1):
        return None
    written = [{"pivot": pivot, "coefficients": row} for pivot, row in zip(found.pivots, found.rows, strict=True)]
    witness = _named_image(picture, system.field) | {"point": found.point}
    if not written or (len(written) == system.p - system.m and sum(found.degrees) == system.n):
        return found.degrees, witness | {"kernel_modulo": written}
    null = nulling(system, picture.system, found) if isinstance(system.field, Rationals) else None
    if null is None:
        return None
    parts = {"states": null.states, "faults": null.faults, "motion": null.motion}
    return found.degrees, witness | {"nulling": {name: _plain(part) for name, part in parts.items()}, "kernel_modulo": written}


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
    gaps = [kernel.gap(k) for k in range(samples)]
    return all([found[min(k, len(found) - 1)] for k in range(samples)] == gaps for found in map(_gaps, systems))


@lru_cache(maxsize=256)  # a system stands in many pairs
def _gaps(system: ResidualSystem) -> tuple[int, ...]:
    """Return the gaps of a system over a prime field for k = 0, 1, ...; the last of them repeats for ever."""
    return tuple(map(len, zero_output_chain(system).profiles))


def _plain(matrix: Matrix) -> list[list[object]]:
    """Return the matrix as it is written, integers as such: most are zeros."""
    numerators, denominator = matrix.flint.numer_denom()
    if denominator == 1:
        entries: list[object] = [*map(int, numerators.entries())]
        return [entries[i * matrix.ncols : (i + 1) * matrix.ncols] for i in range(matrix.nrows)]
    return [[int(x.p) if x.q == 1 else str(x) for x in row] for row in matrix.elements()]


class _Same:
    """A kernel representation as a key: it is equal to itself alone, which is quick to see."""

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


def _point(systems: Sequence[ResidualSystem], missing: int) -> Point | None:
    """Return a point at which the pencils of all systems have rank n + p less what is missing; None where none is found."""
    prime, rng = systems[0].field.p, Random(0)  # type: ignore[union-attr]
    draws: list[Point] = ["infinity", *(rng.randrange(prime) for _ in range(DRAWS))]
    enough = (point for point in draws if all(pencil_rank_at(system, point) >= system.n + system.p - missing for system in systems))
    return next(enough, None)


def _hints(systems: Sequence[ResidualSystem], rows: Sequence[KernelRow], picture: Image) -> Witness | None:
    """Return a point with which the checker sees the rows to be a minimal basis for each of the systems over GF(l)."""
    prime, count = picture.prime, len(rows)
    reduced = [reduce_matrix(row.coefficients, prime, picture.root) for row in rows]
    if any(one is None for one in reduced):
        return None
    tables, p = [one.elements() for one in reduced if one is not None], systems[0].p
    longest, blank = max(map(len, tables), default=0), [0] * p
    coefficients = [
        nmod_mat(count, p, [int(x) for table in tables for x in (table[k] if k < len(table) else blank)], prime) for k in range(longest)
    ]
    leading = nmod_mat(count, count, [int(table[-1][row.pivot]) for table in tables for row in rows], prime)
    if leading.rank() < count or not all(_serves(system, coefficients, count, sum(map(len, tables))) for system in systems):
        return None
    point = _point(systems, count)
    return None if point is None else {"point": point}


def _serves(system: ResidualSystem, coefficients: Sequence[nmod_mat], count: int, terms: int) -> bool:
    """Return whether the states of rows with so many coefficients in all are independent, where they annihilate the system."""
    states, rest = states_of(system.A.flint, system.C.flint, coefficients, count)
    left = any(y * system.G.flint + x * system.F.flint for y, x in zip(coefficients, states, strict=True))
    return not rest and not left and placed(states, system.n, system.field.p).rank() == terms - count  # type: ignore[union-attr]
