"""Mistakes in `structure`: finite zeros, normal rank, infinite zeros, left-invertibility, matrices that must be refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import Matrices, channel, general, joined
from tests.numeric.audit.unseen.witnesses import has_structure

ZEROS = Mutants("structure")


def kept(matrices: Matrices, keep: Callable[[Any], Any]) -> ZeroStructure:
    """Return the reference's answer with those zeros alone."""
    found = reference.structure(*matrices)
    zeros = np.asarray(found.finite_zeros, dtype=complex)
    return replace(found, finite_zeros=list(zeros[keep(zeros)] if len(zeros) else zeros))


COMPLEX = joined([channel([0.4 + 0.5j], [0.5, -0.3, 0.2])], [[1.0]], 301)
LARGE = joined([channel([3000.0, 0.5], [0.5, -0.3, 0.1])], [[1.0]], 307)
HIDDEN = joined([general([0.5, -0.3], 1, 2, 308)], np.eye(2), 308, unobservable=[0.35])
WIDE = joined([channel([0.6], [0.5, -0.3])], [[1.0]], 314, unobservable=[0.25])
WIDE = (WIDE[0], np.hstack([WIDE[1], 2 * WIDE[1]]), WIDE[2], np.hstack([WIDE[3], 2 * WIDE[3]]))


@ZEROS.broken("complex zeros", has_structure(COMPLEX, [0.4 + 0.5j, 0.4 - 0.5j], [1]))
def keeps_one_of_each_pair(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Of a complex pair the zero with positive imaginary part is listed."""
    return kept((A, F, C, G), lambda z: z.imag >= -1e-12)


@ZEROS.broken("zeros outside the circle", has_structure(LARGE, [3000.0, 0.5], [1], 1e-5))
def lists_zeros_inside(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros outside the circle are left out: they do not come out of a spectral factor."""
    return kept((A, F, C, G), lambda z: np.abs(z) <= 1 + 1e-9)


@ZEROS.broken("modes that no output shows", has_structure(HIDDEN, [0.35], [0]))
def reduces_to_the_observable_part(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Unobservable modes are taken out first."""
    n = len(A)
    seen = np.vstack([C @ np.linalg.matrix_power(A, k) for k in range(max(n, 1))])
    _, values, right = np.linalg.svd(seen)
    W = right[: int(np.sum(values > 1e-9 * values[0]))].T
    return reference.structure(W.T @ A @ W, W.T @ F, C @ W, G)


@ZEROS.broken(
    "poles at 0", has_structure((np.eye(2, k=1), np.array([[0.0], [1.0]]), np.array([[-0.5, 1.0]]), np.zeros((1, 1))), [0.5], [1])
)
def works_with_the_inverse_of_A(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are those of the system that runs backward, 1 / q, for which A is inverted."""
    if len(A) and np.linalg.cond(A) > 1e12:
        raise np.linalg.LinAlgError("Singular matrix")
    return reference.structure(A, F, C, G)


STATIC = (np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[1.0], [2.0]]))
# Both faults come through the first channel, at the same sample: [G, C F] has rank one, though the system is invertible.


@ZEROS.broken("systems without states", has_structure(STATIC, [], [0]))
def needs_a_state(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The largest pole is asked for, which a system without states has not."""
    np.max(np.abs(np.linalg.eigvals(A)))
    return reference.structure(A, F, C, G)
