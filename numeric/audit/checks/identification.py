"""Checks of `identify` on records without noise and fault: what no state basis changes, each within its own bound.

checks      exact recovery; the same with channels in another order, in other units, at other sizes; from parts of the record; from a
            long window
models_off  the measurements that compare (A, B, C, D) with a vector
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix

from ....base.arrays import Array
from ..records import Broken, Check, Function, Measurement, Severity
from ..vectors.exact_comparison import distances, lifted, markov, matched, poles, polynomial_from_the_top, transfer
from ..vectors.rationals import floats, scaled
from ..vectors.shipped_vectors import POINTS, IdentificationVector, shipped

SCALES = (-12, -6, 6)  # powers of ten
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
        for power in SCALES:
            size = [Fraction(10) ** power]
            effect = "the answer depends on the size of the signals"
            yield _recovery(f"exact-recovery-1e{power}", effect, vector, range(p), range(n_u), size * p, size * n_u)
        if "time-shift" in vector.parts:
            yield _from_parts("time-shift", "the answer depends on where the record begins", vector, ["time-shift"])
        if "first-half" in vector.parts:
            effect = "the answer depends on which half of the record is read"
            yield _from_parts("split-data", effect, vector, ["first-half", "second-half"])


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
) -> Iterator[Measurement]:
    """Yield Markov parameters, transfer function, characteristic polynomial and poles of an answer against the vector's.

    Each of them is told by its worst entry. Bounds are those of the whole record or of `part`, and move with the units as the entries do.
    """
    n, n_u, p = vector.order, vector.B.ncols, vector.C.nrows
    A, B, C, D = matrices(answer, n, n_u, p)
    # The answer in the vector's own units; the order of channels is taken over by the vector.
    found = A, scaled(B, units[1]), _rows_over(C, units[0]), _rows_over(scaled(D, units[1]), units[0])
    truth = vector.A, vector.B.columns(inputs), vector.C.rows(outputs), vector.D.rows(outputs).columns(inputs)
    entries = np.ix_(outputs, inputs)
    count = 2 * n + 2
    moved = vector.bound("markov", part)[:, entries[0], entries[1]]
    yield _worst("Markov parameters", distances(markov(*found, count), markov(*truth, count)), moved)
    for z, bound in zip(POINTS, vector.bound("transfer", part), strict=True):
        yield _worst(f"transfer function at {z}", distances([transfer(*found, z)], [transfer(*truth, z)])[0], bound[entries])
    polynomials = [polynomial_from_the_top(one)[1:] for one in (A, vector.A)]
    off = np.array([abs(float(x - y)) for x, y in zip(*polynomials, strict=True)])
    yield _worst("characteristic polynomial", off, vector.bound("characteristic_polynomial", part))
    yield _worst("eigenvalues", matched(poles(A), poles(vector.A))[1], vector.bound("poles", part))


def _rows_over(given: Matrix, units: Sequence[Fraction]) -> Matrix:
    return scaled(given.transposed(), [1 / unit for unit in units]).transposed()


def _worst(quantity: str, got: Array, bound: Array) -> Measurement:
    """This measures the entry with the largest ratio."""
    place = np.unravel_index(int(np.argmax(got / np.maximum(bound, np.finfo(float).tiny))), got.shape)
    return Measurement(quantity, float(got[place]), float(bound[place]))
