"""Checks of `identify` on records without noise and fault: what no state basis changes, each within its own bound.

checks      exact recovery; the same with channels in another order, in other units, at other sizes; from parts of the record; from a
            long window. A coloured fault independent of the input: past outputs as instruments show their bias, which stays however long
            the record; the limits are exact, and the bound is half the bias, so that the question is which of two limits is nearer
models_off  the measurements that compare (A, B, C, D) with a vector;   as_it_is: in its own units and order of channels
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix

from ....base.arrays import Array
from ..records import Broken, Check, Function, Measurement, Severity, Sides
from ..vectors.exact_comparison import distances, lifted, markov, matched, poles, polynomial_from_the_top, transfer
from ..vectors.rationals import floats, fractions, scaled
from ..vectors.recipe_vectors import ConsistencyVector
from ..vectors.shipped_vectors import POINTS, IdentificationVector, shipped

SCALES = (-12, -6, 6)  # powers of ten
FAR = Fraction(1, 10**8)  # as pascals in kilobars
LONG = 20  # block rows of a long window
RECOVERY = "the model is wrong although the data determine it: every prediction and every residual made with it"


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for vector in shipped("identification"):
        p, n_u = vector.C.nrows, vector.B.ncols
        ones = [Fraction(1)]
        slug = "exact-recovery" if vector.block_rows < LONG else "long-window"
        yield _recovery(slug, RECOVERY, vector, range(p), range(n_u), ones * p, ones * n_u)
        if p > 1 or n_u > 1:
            effect = "the answer depends on the order of the channels"
            yield _recovery("permuted-channels", effect, vector, range(p)[::-1], range(n_u)[::-1], ones * p, ones * n_u)
        units = [Fraction(10) ** (4 * (j % 2) - 6) for j in range(p)], [Fraction(10) ** (6 - 3 * j) for j in range(n_u)]
        yield _recovery("other-units", "the answer depends on the units of the channels", vector, range(p), range(n_u), *units)
        if p > 1:
            far = [FAR if j == p - 1 else Fraction(1) for j in range(p)], [Fraction(1)] * n_u
            yield _recovery("far-units", "an output in large units is lost", vector, range(p), range(n_u), *far)
        for power in SCALES:
            size = [Fraction(10) ** power]
            effect = "the answer depends on the size of the signals"
            yield _recovery(f"exact-recovery-1e{power}", effect, vector, range(p), range(n_u), size * p, size * n_u)
        if "time-shift" in vector.parts:
            yield _from_parts("time-shift", "the answer depends on where the record begins", vector, ["time-shift"])
        if "first-half" in vector.parts:
            effect = "the answer depends on which half of the record is read"
            yield _from_parts("split-data", effect, vector, ["first-half", "second-half"])
    for coloured in shipped("consistency"):
        yield _coloured(coloured)


def _recovery(
    slug: str, effect: str, vector: IdentificationVector, outputs: Sequence[int], inputs: Sequence[int], *units: Sequence[Fraction]
) -> Check:
    """Return recovery with output i read from outputs[i] and multiplied by units[0][i], inputs likewise."""

    def measure(function: Function) -> Iterator[Measurement]:
        y = scaled(vector.y.columns(outputs), units[0])
        u = scaled(vector.u.columns(inputs), units[1])
        answer = function(floats(y), floats(u), vector.order, vector.block_rows)
        yield from models_off(answer, vector, outputs, inputs, *units)

    return Check(slug, "identify", vector.slug, "proposition-1", effect, Severity.SILENT, measure)


def _from_parts(slug: str, effect: str, vector: IdentificationVector, parts: Sequence[str]) -> Check:
    """Measure the recovery from each of these parts of the record: whatever the initial state, the model is the same."""

    def measure(function: Function) -> Iterator[Measurement]:
        p, n_u = vector.C.nrows, vector.B.ncols
        ones = [Fraction(1)]
        for part in parts:
            first, last, _ = vector.parts[part]
            answer = function(floats(vector.y)[first:last], floats(vector.u)[first:last], vector.order, vector.block_rows)
            yield from models_off(answer, vector, range(p), range(n_u), ones * p, ones * n_u, part=part)

    return Check(slug, "identify", vector.slug, "proposition-1", effect, Severity.SILENT, measure)


def matrices(answer: Any, n: int, n_u: int, p: int) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Return (A, B, C, D) over Q. Raises Broken for anything but four matrices of these sizes."""
    try:
        A, B, C, D = answer
    except (TypeError, ValueError):
        raise Broken("identify must give A, B, C, D") from None
    return lifted(A, "A", (n, n)), lifted(B, "B", (n, n_u)), lifted(C, "C", (p, n)), lifted(D, "D", (p, n_u))


def models_off(
    answer: Any,
    vector: IdentificationVector,
    outputs: Sequence[int],
    inputs: Sequence[int],
    *units: Sequence[Fraction],
    part: str | None = None,
    order: int | None = None,
) -> Iterator[Measurement]:
    """Yield Markov parameters, transfer function, characteristic polynomial and poles of an answer against the vector's.

    Each of them is told by its worst entry. Bounds are those of the whole record or of `part`, and move with the units as the entries do.
    Of a model of another `order` than the vector's the responses alone are compared: what it adds to them need not be seen.
    """
    n, n_u, p = vector.order, vector.B.ncols, vector.C.nrows
    A, B, C, D = matrices(answer, order or n, n_u, p)
    # The answer in the vector's own units; the order of channels is taken over by the vector.
    found = A, scaled(B, units[1]), _rows_over(C, units[0]), _rows_over(scaled(D, units[1]), units[0])
    gains = [[out / of for of in units[1]] for out in units[0]]  # by which a response in the vector's units becomes that in the question's
    truth = vector.A, vector.B.columns(inputs), vector.C.rows(outputs), vector.D.rows(outputs).columns(inputs)
    entries = np.ix_(outputs, inputs)
    count = 2 * n + 2
    if vector.asked("markov", part):
        moved = vector.bound("markov", part)[:, entries[0], entries[1]]
        got, due = markov(*found, count), markov(*truth, count)
        yield _worst("Markov parameters", distances(got, due), moved, _responses("markov", got, due, moved, gains))
    for z, bound in zip(POINTS, vector.bounds["transfer"] if part is None else vector.parts[part][2]["transfer"], strict=True):
        if bound is not None:
            got, due = [transfer(*found, z)], [transfer(*truth, z)]
            allowed = np.array(bound, dtype=float)[entries]
            sides = _responses("transfer", got, due, allowed[None], gains, z=z)
            yield _worst(f"transfer function at {z}", distances(got, due)[0], allowed, sides)
    if order is not None:
        return
    polynomials = [polynomial_from_the_top(one)[1:] for one in (A, vector.A)]
    off = np.array([abs(float(x - y)) for x, y in zip(*polynomials, strict=True)])
    if vector.asked("characteristic_polynomial", part):
        allowed = vector.bound("characteristic_polynomial", part)
        yield _worst("characteristic polynomial", off, allowed, Sides("polynomial", polynomials[0], polynomials[1], allowed.tolist()))
    if vector.asked("poles", part):
        got_poles, due_poles, allowed = poles(A), poles(vector.A), vector.bound("poles", part)
        places, off = matched(got_poles, due_poles)
        sides = Sides("eigenvalues", [got_poles[j] for j in places], list(due_poles), allowed.tolist())
        yield _worst("eigenvalues", off, allowed, sides)


def as_it_is(answer: Any, vector: IdentificationVector, order: int | None = None) -> Iterator[Measurement]:
    """Yield the measurements of `models_off` in the vector's own units, with the channels in its order."""
    p, n_u = vector.C.nrows, vector.B.ncols
    yield from models_off(answer, vector, range(p), range(n_u), [Fraction(1)] * p, [Fraction(1)] * n_u, order=order)


def _responses(
    of: str, got: Sequence[Matrix], due: Sequence[Matrix], bounds: Array, gains: Sequence[Sequence[Fraction]], **given: Any
) -> Sides:
    """Return both sides in the units of the question."""

    def moved(parts: Sequence[Any]) -> list[Any]:
        return [[[x * gain for x, gain in zip(*rows, strict=True)] for rows in zip(one, gains, strict=True)] for one in parts]

    floats_of_gains = np.array([[float(gain) for gain in row] for row in gains])
    answer, truth = (moved([fractions(one) for one in side]) for side in (got, due))
    return Sides(of, answer, truth, (bounds * floats_of_gains).tolist(), given)


def _rows_over(given: Matrix, units: Sequence[Fraction]) -> Matrix:
    return scaled(given.transposed(), [1 / unit for unit in units]).transposed()


def _worst(quantity: str, got: Array, bound: Array, sides: Sides) -> Measurement:
    """This measures the entry with the largest ratio."""
    place = np.unravel_index(int(np.argmax(got / np.maximum(bound, np.finfo(float).tiny))), got.shape)
    indices = (*[0] * (np.ndim(sides.bounds) - got.ndim), *map(int, place))
    return Measurement(quantity, float(got[place]), float(bound[place]), replace(sides, place=indices))


def _coloured(vector: ConsistencyVector) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        y, u = vector.record()
        n, n_u, p = vector.system.residual.n, vector.system.nu, vector.system.residual.p
        A, *_ = matrices(function(y, u, n, vector.block_rows), n, n_u, p)
        got = poles(A)
        places, off = matched(got, vector.poles)
        sides = Sides("eigenvalues", [got[j] for j in places], list(vector.poles), [vector.bound] * n)
        yield Measurement("poles", float(np.max(off)), vector.bound, sides)

    effect = "under a fault with memory poles off by more than half the bias of past outputs as instruments"
    return Check("consistent-under-coloured-fault", "identify", vector.slug, "past-outputs", effect, Severity.SILENT, measure, nearness=1.0)
