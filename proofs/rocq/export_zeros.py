"""Certificates of finite and infinite zeros as terms of Rocq: recomputed by the checks of theory/field_checks, over Q, Q(a) and GF(p).

    finite_zeros    writes finite-zeros
    infinite_zeros  writes infinite-zeros

Over Q they are written as over Q(a), where a is the root 0 of q.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..trust import checker
from .numbered import Numbers, system_of, terms_over
from .terms import Definition, Row, Rows, Terms, call, index, indices, natural, naturals, sequence

Json = Any


def finite_zeros(s: Json, w: Json) -> Terms:
    """Write finite-zeros."""
    system, r = system_of(s["system"], w), index(s["normal_rank"])
    numbers, name, sizes = system.numbers, system.named("system"), (system.n + system.p, system.n + system.m)
    g = _polynomial(numbers, s["invariant_zero_polynomial"])
    diagonal = _diagonal(numbers, w, sizes)
    tables = [_polynomial_table(numbers, part, rows) for part, rows in _multipliers(numbers, w, sizes).items()]
    product = numbers.unit(1, 0)
    for f in diagonal:
        product = _convolved(numbers, product, f) if any(x != 0 for x in f) else product
    leading = next((x for x in reversed(product) if x != 0), product[0])
    minors = f"gcd_of_minors_of_order ({natural(system.n)} + {natural(r)}) (pencil {name}) (polynomial_of value g)"
    return terms_over(
        numbers,
        [
            system.definition("system"), ("g", "vector", system.vector(g)), ("c", "V", numbers.number(leading)),
            ("d", "seq vector", system.table(diagonal)), *tables,
        ],
        call("has_finite_zeros", *system.sizes, r, "system g c d U U' V V'"),
        f"[/\\ \\rank (transfer {name}) = {natural(r)}%N, {minors} & polynomial_of value g \\is monic]",
        "has_finite_zeros_sound",
    )  # fmt: skip


def infinite_zeros(s: Json, w: Json) -> Terms:
    """Write infinite-zeros.

    The certificate has multipliers of the reversed pencil, [1 - t A, t C; - t F, t G] in the theory, which is the pencil at infinity,
    [1 - t A, C; - t F, G], with its last p columns times t. The form D of the one has n entries that do not vanish at t = 0, and V maps
    between the columns without t; so the other has the form D with all other entries over t, by the same U, and V with the rows of
    outputs times t and all other columns over t, for which V need only be divisible as it has to be.
    """
    system, orders = system_of(s["system"], w), indices(s["infinite_zero_orders"])
    numbers, name, sizes = system.numbers, system.named("system"), (system.n + system.p, system.n + system.m)
    diagonal, multipliers = _diagonal(numbers, w, sizes), _multipliers(numbers, w, sizes)
    later = [not (j < len(diagonal) and diagonal[j] and diagonal[j][0] != 0) for j in range(sizes[0])]
    outputs = [j >= system.n for j in range(sizes[0])]
    multipliers |= {"V": _shifted(numbers, multipliers["V"], outputs, later), "V'": _shifted(numbers, multipliers["V'"], later, outputs)}
    reduced = [f[1:] if late else f for f, late in zip(diagonal, later, strict=False)]
    r, written = natural(len(orders)), naturals(orders)
    minors = f"divides_minors_of_order ({natural(system.n)} + j) (pencil_at_infinity {name}) 'X^e"
    return terms_over(
        numbers,
        [
            system.definition("system"), ("d", "seq vector", system.table(reduced)),
            *(_polynomial_table(numbers, part, rows) for part, rows in multipliers.items()),
        ],
        call("has_infinite_zeros", *system.sizes, written, "system d U U' V V'"),
        f"\\rank (transfer {name}) = {r}%N /\\ forall j e, (j <= {r})%N -> {minors} <-> (e <= sumn (take j {written}))%N",
        "has_infinite_zeros_sound",
    )  # fmt: skip


# -- parts -------------------------------------------------------------------------------------------------------------


def _polynomial(numbers: Numbers, f: Json) -> Row:
    """Return the coefficients of a POLY."""
    (row,) = numbers.vectors([f], len(checker.items(f, "a polynomial")))
    return row


def _polynomials(numbers: Numbers, value: Json, size: int) -> list[Rows]:
    """Return a square POLYMATRIX of that size."""
    rows = checker.items(value, "a matrix of polynomials", size, size)
    return [[_polynomial(numbers, f) for f in checker.items(row, "a row of polynomials", size, size)] for row in rows]


def _diagonal(numbers: Numbers, w: Json, sizes: tuple[int, int]) -> Rows:
    """Return the diagonal of the form of a pencil of that shape."""
    return [_polynomial(numbers, f) for f in checker.items(w["diagonal"], "diagonal", min(sizes), min(sizes))]


def _multipliers(numbers: Numbers, w: Json, sizes: tuple[int, int]) -> dict[str, list[Rows]]:
    """Return the transposed multipliers of a pencil of that shape, by their names in the theory."""
    keys = {"V": ("left", sizes[0]), "V'": ("left_inverse", sizes[0]), "U": ("right", sizes[1]), "U'": ("right_inverse", sizes[1])}
    return {part: [list(row) for row in zip(*_polynomials(numbers, w[key], size), strict=True)] for part, (key, size) in keys.items()}


def _polynomial_table(numbers: Numbers, name: str, rows: Sequence[Rows]) -> Definition:
    return name, "seq (seq vector)", sequence(map(numbers.table, rows))


def _shifted(numbers: Numbers, table: Sequence[Rows], up: Sequence[bool], down: Sequence[bool]) -> list[Rows]:
    """Return polynomials, times t in the rows told and over t in the columns told. Rejected where a division leaves a rest."""
    found = []
    for row, raised in zip(table, up, strict=True):
        line = [[*numbers.unit(1, -1), *f] if raised else f for f in row]
        rests = (f[0] for f, lowered in zip(line, down, strict=True) if lowered and f)
        checker.require(not any(x != 0 for x in rests), "the left multiplier does not map columns without t to such columns")
        found.append([f[1:] if lowered else f for f, lowered in zip(line, down, strict=True)])
    return found


def _convolved(numbers: Numbers, f: Row, g: Row) -> Row:
    """Return the product of two polynomials."""
    checker.charge(2000 * len(f) * len(g) * numbers.field.degree**2)
    found = [numbers.field.element(0)] * (len(f) + len(g) - 1)
    for i, x in enumerate(f):
        for j, y in enumerate(g):
            found[i + j] = found[i + j] + x * y
    return found
