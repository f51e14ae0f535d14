"""Mistakes in `structure`: the finite zeros."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import scipy.linalg

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import Matrices, channel, general, joined, mixing, with_zeros
from tests.numeric.audit.unseen.witnesses import has_structure

ZEROS = Mutants("structure")


def kept(matrices: Matrices, keep: Callable[[Any], Any]) -> ZeroStructure:
    """Return the reference's answer with those zeros alone."""
    found = reference.structure(*matrices)
    zeros = np.asarray(found.finite_zeros, dtype=complex)
    return replace(found, finite_zeros=list(zeros[keep(zeros)] if len(zeros) else zeros))


COMPLEX = joined([channel([0.4 + 0.5j], [0.5, -0.3, 0.2])], [[1.0]], 301)
REPEATED = joined([channel([0.4], [0.5, -0.3]), channel([0.4], [0.2, 0.7])], mixing(2, 2), 302)
DEFECTIVE = joined([channel([0.4, 0.4], [0.5, -0.3, 0.1])], [[1.0]], 303)
AT_ZERO = joined([channel([0.0, 0.6], [0.5, -0.3, 0.1])], [[1.0]], 304)
AT_ONE = joined([channel([1.0, 0.6], [0.5, -0.3, 0.1])], [[1.0]], 305)
ON_CIRCLE = joined([channel([0.6 + 0.8j], [0.5, -0.3, 0.1])], [[1.0]], 306)
LARGE = joined([channel([3000.0, 0.5], [0.5, -0.3, 0.1])], [[1.0]], 307)
HIDDEN = joined([general([0.5, -0.3], 1, 2, 308)], np.eye(2), 308, unobservable=[0.35])
IDLE = joined([channel([0.6], [0.5, -0.3])], [[1.0]], 309, uncontrollable=[0.35])
SQUARE = joined([channel([0.6], [0.5, -0.3]), channel([-0.7], [0.2, 0.7])], mixing(2, 2), 310)
COUPLED = general([0.5, -0.3, 0.2], 2, 2, 311)
COUPLED_ZEROS = np.linalg.eigvals(COUPLED[0] - COUPLED[1] @ np.linalg.solve(COUPLED[3], COUPLED[2]))
TALL = general([0.5, -0.3, 0.2], 1, 2, 312)
TALL_ZERO = with_zeros([0.6], [0.5, -0.3, 0.2], 2, 313)
WIDE = joined([channel([0.6], [0.5, -0.3])], [[1.0]], 314, unobservable=[0.25])
WIDE = (WIDE[0], np.hstack([WIDE[1], 2 * WIDE[1]]), WIDE[2], np.hstack([WIDE[3], 2 * WIDE[3]]))


@ZEROS.broken("complex zeros", has_structure(COMPLEX, [0.4 + 0.5j, 0.4 - 0.5j], [1]))
def keeps_one_of_each_pair(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Of a complex pair the zero with positive imaginary part is listed."""
    return kept((A, F, C, G), lambda z: z.imag >= -1e-12)


@ZEROS.broken("complex zeros", has_structure(COMPLEX, [0.4 + 0.5j, 0.4 - 0.5j], [1]))
def lists_real_parts(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are cast to real numbers."""
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[complex(z.real) for z in found.finite_zeros])


@ZEROS.broken("complex zeros", has_structure(COMPLEX, [0.4 + 0.5j, 0.4 - 0.5j], [1]))
def lists_real_zeros(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Only zeros without an imaginary part are listed, for complex ones were taken for rounding."""
    return kept((A, F, C, G), lambda z: np.abs(z.imag) < 1e-8)


@ZEROS.broken("repeated zeros", has_structure(REPEATED, [0.4, 0.4], [1, 1]))
def lists_a_repeated_zero_once(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are rounded to six digits and made unique."""
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[complex(z) for z in np.unique(np.round(found.finite_zeros, 6))])


@ZEROS.broken("repeated zeros of one chain", has_structure(DEFECTIVE, [0.4, 0.4], [1], 1e-4))
def counts_directions_of_a_zero(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """A zero is listed as often as it has directions, its geometric multiplicity in the pencil."""
    found = reference.structure(A, F, C, G)
    zeros: list[complex] = []
    for z in found.finite_zeros:
        if any(abs(z - one) < 1e-4 for one in zeros):
            continue
        values = np.linalg.svd(np.block([[z * np.eye(len(A)) - A, -F], [C, G]]), compute_uv=False)
        zeros += [z] * (len(A) + found.normal_rank - int(np.sum(values > 1e-5 * values[0])))
    return replace(found, finite_zeros=zeros)


@ZEROS.broken("zeros at 0", has_structure(AT_ZERO, [0.0, 0.6], [1]))
def takes_a_zero_at_0_for_a_delay(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros below 1e-6 are left out as factors q."""
    return kept((A, F, C, G), lambda z: np.abs(z) > 1e-6)


@ZEROS.broken("zeros at 1", has_structure(AT_ONE, [1.0, 0.6], [1]))
def takes_a_zero_at_1_for_rounding(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros within 1e-6 of 1 are left out with what detrending makes."""
    return kept((A, F, C, G), lambda z: np.abs(z - 1) > 1e-6)


@ZEROS.broken("zeros on the circle", has_structure(ON_CIRCLE, [0.6 + 0.8j, 0.6 - 0.8j], [1]))
def lists_zeros_on_neither_side(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros inside and outside the circle are joined, and those with modulus 1 are in neither list."""
    return kept((A, F, C, G), lambda z: (np.abs(z) < 1 - 1e-9) | (np.abs(z) > 1 + 1e-9))


@ZEROS.broken("zeros outside the circle", has_structure(LARGE, [3000.0, 0.5], [1], 1e-5))
def lists_zeros_inside(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros outside the circle are left out: they do not come out of a spectral factor."""
    return kept((A, F, C, G), lambda z: np.abs(z) <= 1 + 1e-9)


@ZEROS.broken("zeros above a thousand", has_structure(LARGE, [3000.0, 0.5], [1], 1e-5))
def calls_large_zeros_infinite(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros above a thousand are infinite."""
    return kept((A, F, C, G), lambda z: np.abs(z) < 1e3)


@ZEROS.broken("zeros at hidden modes", has_structure(HIDDEN, [0.35], [0]))
def cancels_zeros_with_poles(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros within 1e-6 of a pole are cancelled with it."""
    poles = np.linalg.eigvals(A)
    return kept((A, F, C, G), lambda z: np.min(np.abs(z[:, None] - poles), axis=1) > 1e-6)


@ZEROS.broken("modes that no output shows", has_structure(HIDDEN, [0.35], [0]))
def reduces_to_the_observable_part(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Unobservable modes are taken out first."""
    n = len(A)
    seen = np.vstack([C @ np.linalg.matrix_power(A, k) for k in range(max(n, 1))])
    _, values, right = np.linalg.svd(seen)
    W = right[: int(np.sum(values > 1e-9 * values[0]))].T
    return reference.structure(W.T @ A @ W, W.T @ F, C @ W, G)


@ZEROS.broken("modes that no input moves", has_structure(IDLE, [0.6, 0.35], [1]))
def reduces_to_the_controllable_part(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Uncontrollable modes are taken out first."""
    n = len(A)
    left, values, _ = np.linalg.svd(np.hstack([np.linalg.matrix_power(A, k) @ F for k in range(max(n, 1))]))
    W = left[:, : int(np.sum(values > 1e-9 * values[0]))]
    return reference.structure(W.T @ A @ W, W.T @ F, C @ W, G)


@ZEROS.broken("more outputs than faults", has_structure(TALL, [], [0]))
def squares_down(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Outputs beyond the number of faults are mixed into the others, which makes zeros where there were none."""
    found = reference.structure(A, F, C, G)
    p, m = G.shape
    if p <= m or m == 0:
        return found
    mix = np.random.default_rng(0).standard_normal((m, p))
    return replace(found, finite_zeros=reference.structure(A, F, mix @ C, mix @ G).finite_zeros)


@ZEROS.broken("several inputs and outputs", has_structure(COUPLED, COUPLED_ZEROS, [0, 0]))
def lists_zeros_of_the_diagonal(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The zeros are those of the diagonal entries of the transfer matrix."""
    found = reference.structure(A, F, C, G)
    p, m = G.shape
    if p != m or m < 2:
        return found
    entries = [reference.structure(A, F[:, i : i + 1], C[i : i + 1], G[i : i + 1, i : i + 1]).finite_zeros for i in range(m)]
    return replace(found, finite_zeros=[z for one in entries for z in one][: len(found.finite_zeros)])


@ZEROS.broken(
    "relative degree three and more: multiple zeros at infinity",
    has_structure(joined([channel([0.4], [0.1]), channel([0.5], [0.5, -0.3, 0.1, 0.2, 0.7])], mixing(2, 2), 315), [0.4, 0.5], [0, 4]),
)
def takes_finite_eigenvalues_of_the_pencil(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The zeros are the eigenvalues below 1e8 of the square pencil in some orthogonal basis, which hides the zeros of its second matrix:
    rounding moves a multiple infinite eigenvalue below that."""
    found = reference.structure(A, F, C, G)
    n, (p, m) = len(A), G.shape
    if p != m or not found.left_invertible:
        return found
    system = np.block([[A, F], [-C, -G]])
    left, right = (np.linalg.qr(np.random.default_rng(seed).standard_normal(system.shape))[0] for seed in (1, 2))
    values = scipy.linalg.eigvals(left @ system @ right, left @ scipy.linalg.block_diag(np.eye(n), np.zeros((m, m))) @ right)
    return replace(found, finite_zeros=[complex(z) for z in values if np.isfinite(z) and abs(z) < 1e8])


@ZEROS.broken("more outputs than faults, with zeros", has_structure(TALL_ZERO, [0.6], [0]))
def finds_zeros_of_square_systems_alone(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Systems that are not square have no zeros, generically."""
    found = reference.structure(A, F, C, G)
    return found if G.shape[0] == G.shape[1] else replace(found, finite_zeros=[])


@ZEROS.broken("systems that are not left-invertible", has_structure(WIDE, [0.6, 0.25], [1]))
def has_no_zeros_where_rank_is_missing(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Where the system is not left-invertible every number is called a zero, and none is listed."""
    found = reference.structure(A, F, C, G)
    return found if found.left_invertible else replace(found, finite_zeros=[])


@ZEROS.broken(
    "F = G = 0 with a mode that no output shows",
    has_structure((np.diag([0.5, 0.3]), np.zeros((2, 1)), np.array([[1.0, 0.0]]), np.zeros((1, 1))), [0.3], []),
)
def has_no_zeros_without_a_fault(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Where F and G are zero there is nothing to do."""
    found = reference.structure(A, F, C, G)
    return found if np.any(F) or np.any(G) else ZeroStructure(0, [], [], False)


@ZEROS.broken("zeros outside the circle", has_structure(LARGE, [3000.0, 0.5], [1], 1e-5))
def reflects_zeros_into_the_circle(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are those of the spectral density, inside the circle."""
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[1 / z.conjugate() if abs(z) > 1 else z for z in found.finite_zeros])


@ZEROS.broken("zeros of any sign", has_structure(SQUARE, [0.6, -0.7], [1, 1]))
def lists_zeros_of_the_other_sign(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are solved from q I + A where A is singular in the test of it: a sign is lost for negative ones."""
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[complex(abs(z)) if abs(z.imag) < 1e-9 else z for z in found.finite_zeros])


@ZEROS.broken(
    "zeros that differ by less than 1e-4",
    has_structure(joined([channel([0.4, 0.4005], [0.5, -0.3, 0.1])], [[1.0]], 316), [0.4, 0.4005], [1]),
)
def rounds_zeros_to_three_digits(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are rounded to three decimals, as they are printed."""
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[complex(np.round(z, 3)) for z in found.finite_zeros])


@ZEROS.broken(
    "nine zeros and more",
    has_structure(
        joined(
            [
                channel([0.1, 0.3, -0.5, 0.7, 0.9], [0.5, -0.3, 0.2, 0.6, 0.8]),
                channel([-0.2, 0.4, -0.6, 0.8, 1.2], [-0.5, 0.35, -0.25, 0.65, -0.8]),
            ],
            mixing(2, 2),
            317,
        ),
        [0.1, 0.3, -0.5, 0.7, 0.9, -0.2, 0.4, -0.6, 0.8, 1.2],
        [0, 0],
        1e-5,
    ),
)
def lists_at_most_eight_zeros(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The table of zeros has room for eight."""
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=list(found.finite_zeros)[:8])


@ZEROS.broken(
    "a small G: zeros of modulus one over it",
    has_structure((np.array([[0.5]]), np.array([[1.0]]), np.array([[1.0]]), np.array([[1e-4]])), [0.5 - 1e4], [0], 1e-6),
)
def takes_a_small_G_for_zero(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Entries of G below a thousandth of the largest of F and C are zero."""
    size = max(np.max(np.abs(F), initial=0.0), np.max(np.abs(C), initial=0.0))
    return reference.structure(A, F, C, np.where(np.abs(G) < 1e-3 * size, 0.0, G))


@ZEROS.broken(
    "poles at 0", has_structure((np.eye(2, k=1), np.array([[0.0], [1.0]]), np.array([[-0.5, 1.0]]), np.zeros((1, 1))), [0.5], [1])
)
def works_with_the_inverse_of_A(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros are those of the system that runs backward, 1 / q, for which A is inverted."""
    if len(A) and np.linalg.cond(A) > 1e12:
        raise np.linalg.LinAlgError("Singular matrix")
    return reference.structure(A, F, C, G)
