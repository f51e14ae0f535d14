"""How far rounding may carry a model from the exact one: the largest of four routes, each a worst case to first order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ....base.arrays import Array
from ...method.model.compression import compress
from ...method.model.past_inputs import pi_moesp, pi_moesp_from_compression
from ...study.conditioning import ModelError, by_gram, by_qr, moesp_error, noise_free_range, output_error_error, setting
from ..vectors.exact_comparison import markov, matched, poles, polynomial_from_the_top, transfer
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import POINTS, IdentificationVector
from .planting import TELLING, upward

OfPoles = Callable[[Array, float, Sequence[complex]], list[float]]


def _upward(values: Any) -> Any:
    return [_upward(one) for one in values] if isinstance(values, (list, np.ndarray)) else upward(float(values))


def model_bounds(vector: IdentificationVector, y: Array, u: Array, of_poles: OfPoles | None = None) -> dict[str, Any]:
    """Return the largest bound of four routes from these samples; `of_poles` for poles that need not be simple."""
    s, n = vector.block_rows, vector.order
    errors: list[ModelError] = []
    for route, backward_error in (("qr", by_qr), ("gram", by_gram)):
        compressed = compress(y, u, block_rows=s, route=route)
        for found in (pi_moesp_from_compression(compressed, order=n), pi_moesp(y, u, order=n, block_rows=s, route=route)):
            where = setting(compressed, found)
            moved = noise_free_range(where, backward_error(where))
            errors.append(moesp_error(where, backward_error(where), moved))
            errors.append(output_error_error(where, moved, [(y, u)]))
    exact = poles(vector.A)
    if of_poles is None:
        moved_by = [one.poles[matched(np.linalg.eigvals(one.model.A).tolist(), exact)[0]] for one in errors]
    else:
        worst = max(errors, key=lambda one: one.A)
        moved_by = [np.array(of_poles(worst.model.A, worst.A, exact))]

    def transfers(z: complex) -> Any:
        return _upward(np.max([one.transfer(z) for one in errors], axis=0))

    pole = [not sum(c * z**k for k, c in enumerate(reversed(polynomial_from_the_top(vector.A)))) for z in POINTS]
    return {
        "markov": _upward(np.max([one.markov(2 * n + 2) for one in errors], axis=0)),
        "characteristic_polynomial": _upward(np.max([one.characteristic_polynomial for one in errors], axis=0)),
        "transfer": [None if out else transfers(z) for z, out in zip(POINTS, pole, strict=True)],
        "poles": _upward(np.max(moved_by, axis=0)),
    }


def bounded(vector: IdentificationVector) -> IdentificationVector:
    """Return the vector with the bounds of its whole record."""
    return replace(vector, bounds=model_bounds(vector, floats(vector.y), floats(vector.u)))


def telling(vector: IdentificationVector) -> dict[str, Any]:
    """Return the bounds of the vector with None for those above TELLING times the size of their quantity (of a pole, at least of one)."""
    parts = vector.A, vector.B, vector.C, vector.D
    sizes = {
        "markov": max(float(np.max(np.abs(floats(one)))) for one in markov(*parts, 2 * vector.order + 2)),
        "characteristic_polynomial": float(max(abs(c) for c in polynomial_from_the_top(vector.A))),
        "poles": max(1.0, *(abs(z) for z in poles(vector.A))),
    }
    told: dict[str, Any] = {"transfer": []}
    for name, size in sizes.items():
        told[name] = vector.bounds[name] if _largest(vector.bounds[name]) <= TELLING * size else None
    for z, bound in zip(POINTS, vector.bounds["transfer"], strict=True):
        asked = bound is not None and _largest(bound) <= TELLING * float(np.max(np.abs(floats(transfer(*parts, z)))))
        told["transfer"].append(bound if asked else None)
    return {name: told[name] for name in vector.bounds}


def _largest(bound: Any) -> float:
    return float(np.max(np.array(bound, dtype=float)))
