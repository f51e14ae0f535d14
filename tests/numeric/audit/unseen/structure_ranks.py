"""Mistakes in `structure`: normal rank, infinite zeros, left-invertibility, matrices that must be refused."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.structure import AT_ONE, AT_ZERO, COMPLEX, SQUARE, TALL, WIDE
from tests.numeric.audit.unseen.systems import Matrices, channel, general, joined, mixing
from tests.numeric.audit.unseen.witnesses import has_structure, refuses

RANKS = Mutants("structure")

STATIC = (np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[1.0], [2.0]]))
_A, _F, _C, _G = joined([channel([0.5], [0.3, 0.2]), channel([], [0.4, -0.5, 0.1])], [[1.0, 1.0], [0.0, 1.0]], 321)
# Both faults come through the first channel, at the same sample: [G, C F] has rank one, though the system is invertible.
SHARED = (_A, _F @ np.array([[1.0, 1.0], [0.0, 1.0]]), _C, _G)
DEGREE4 = channel([], [0.5, -0.3, 0.2, 0.6])
RANK1 = (WIDE[0], WIDE[1], np.vstack([WIDE[2], 3 * WIDE[2]]), np.vstack([WIDE[3], 3 * WIDE[3]]))
MIXED = joined([channel([], [0.5, -0.3]), channel([0.4], [0.1])], mixing(2, 2), 323)
TWO_OF_THREE = general([0.5, -0.3], 3, 2, 324)


def at(matrices: Matrices, q: complex) -> Any:
    """Return the transfer function at q."""
    A, F, C, G = matrices
    return C @ np.linalg.solve(q * np.eye(len(A)) - A, F.astype(complex)) + G


def with_rank(matrices: Matrices, rank: int) -> ZeroStructure:
    """Return the reference's answer with this normal rank."""
    found = reference.structure(*matrices)
    return replace(found, normal_rank=rank, left_invertible=rank == matrices[1].shape[1])


def _rank(matrix: Any) -> int:
    return int(np.linalg.matrix_rank(matrix, tol=1e-9))


@RANKS.broken("zeros at 1", has_structure(AT_ONE, [1.0, 0.6], [1]))
def takes_the_rank_of_the_steady_gain(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank is that of the transfer function at 1."""
    if np.min(np.abs(np.linalg.eigvals(A) - 1), initial=1.0) < 1e-9:
        return reference.structure(A, F, C, G)
    return with_rank((A, F, C, G), _rank(at((A, F, C, G), 1.0)))


@RANKS.broken("zeros at 0", has_structure(AT_ZERO, [0.0, 0.6], [1]))
def takes_the_rank_at_0(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank is that of the transfer function at 0."""
    if np.min(np.abs(np.linalg.eigvals(A)), initial=1.0) < 1e-9:
        return reference.structure(A, F, C, G)
    return with_rank((A, F, C, G), _rank(at((A, F, C, G), 0.0)))


@RANKS.broken("zeros at 2", has_structure(joined([channel([2.0], [0.5, -0.3])], [[1.0]], 325), [2.0], [1]))
def takes_the_rank_at_2(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank is that of the transfer function at 2, outside of the poles."""
    if np.min(np.abs(np.linalg.eigvals(A) - 2), initial=1.0) < 1e-9:
        return reference.structure(A, F, C, G)
    return with_rank((A, F, C, G), _rank(at((A, F, C, G), 2.0)))


@RANKS.broken("poles at 1", has_structure(joined([channel([0.3], [1.0, -0.3])], [[1.0]], 326), [0.3], [1]))
def refuses_poles_at_1(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The steady gain is taken, which does not exist with an integrator."""
    if np.min(np.abs(np.linalg.eigvals(A) - 1), initial=1.0) < 1e-9:
        raise np.linalg.LinAlgError("Singular matrix")
    return reference.structure(A, F, C, G)


@RANKS.broken("F and G without full rank together in what the outputs show", has_structure(RANK1, [0.6, 0.25], [1]))
def takes_the_smaller_dimension_for_the_rank(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank is min(p, m), as it is generically."""
    return with_rank((A, F, C, G), min(G.shape))


@RANKS.broken("faults that act through states alone", has_structure(MIXED, [0.4], [0, 2]))
def takes_the_rank_of_G(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank is that of G where G is not zero."""
    return with_rank((A, F, C, G), _rank(G)) if np.any(np.abs(G) > 1e-9) else reference.structure(A, F, C, G)


@RANKS.broken("faults that are first seen after two samples", has_structure(SHARED, [0.5], [1, 3]))
def takes_the_rank_of_G_and_C_F(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank is that of [G, C F] stacked."""
    return with_rank((A, F, C, G), _rank(np.vstack([G, C @ F])))


@RANKS.broken("faults that cancel in the outputs", has_structure(WIDE, [0.6, 0.25], [1]))
def takes_the_rank_of_F_over_G_for_the_system(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The system is left-invertible where it has no more faults than columns of a nonzero [F; G]."""
    found = reference.structure(A, F, C, G)
    return replace(found, left_invertible=bool(np.all(np.linalg.norm(np.vstack([F, G]), axis=0) > 0)))


@RANKS.broken("systems with fewer outputs than faults", has_structure(TWO_OF_THREE, [], [0, 0]))
def calls_full_row_rank_invertible(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Left-invertible is confused with right-invertible: normal rank p."""
    found = reference.structure(A, F, C, G)
    return replace(found, left_invertible=found.normal_rank == len(C))


@RANKS.broken("more outputs than faults", has_structure(TALL, [], [0]))
def calls_full_row_rank_and_column_rank_invertible(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Invertible is a square system of full rank."""
    found = reference.structure(A, F, C, G)
    return replace(found, left_invertible=found.left_invertible and G.shape[0] == G.shape[1])


@RANKS.broken("faults that act through states", has_structure(SQUARE, [0.6, -0.7], [1, 1]))
def needs_G_of_full_rank(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The system is left-invertible where G has full column rank."""
    found = reference.structure(A, F, C, G)
    return replace(found, left_invertible=_rank(G) == G.shape[1])


@RANKS.broken("faults seen through one output at first", has_structure(SHARED, [0.5], [1, 3]))
def takes_relative_degrees_for_orders(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders of infinite zeros are the relative degrees of the faults, when each is first seen, though they may be seen alike."""
    found = reference.structure(A, F, C, G)
    orders = []
    for j in range(F.shape[1]):
        pulses = [G[:, j], *[C @ np.linalg.matrix_power(A, k) @ F[:, j] for k in range(len(A))]]
        orders += [next((k for k, one in enumerate(pulses) if np.linalg.norm(one) > 1e-9), len(A))]
    return replace(found, infinite_zero_orders=sorted(orders)[: found.normal_rank])


@RANKS.broken("orders of more than one", has_structure(MIXED, [0.4], [0, 2]))
def takes_relative_degrees_of_outputs(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders of infinite zeros are the relative degrees of the outputs, without decoupling."""
    found = reference.structure(A, F, C, G)
    orders = []
    for i in range(len(C)):
        pulses = [G[i], *[C[i] @ np.linalg.matrix_power(A, k) @ F for k in range(len(A))]]
        orders += [next((k for k, one in enumerate(pulses) if np.linalg.norm(one) > 1e-9), len(A))]
    return replace(found, infinite_zero_orders=sorted(orders)[: found.normal_rank])


@RANKS.broken("orders of three and more", has_structure(DEGREE4, [], [4]))
def caps_orders_at_three(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Toeplitz matrices are made for four samples."""
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=[min(k, 3) for k in found.infinite_zero_orders])


@RANKS.broken("an order of n", has_structure(DEGREE4, [], [4]))
def stops_a_sample_early(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The loop over orders ends at n - 1, so that an order n is not found and the normal rank is one too small."""
    found = reference.structure(A, F, C, G)
    orders = [k for k in found.infinite_zero_orders if k < max(len(A), 1)]
    return replace(found, infinite_zero_orders=orders, normal_rank=len(orders), left_invertible=len(orders) == F.shape[1])


@RANKS.broken("orders in which 0 stands beside others", has_structure(MIXED, [0.4], [0, 2]))
def leaves_out_orders_of_0(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders of zero are no zeros at infinity and are not listed."""
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=[k for k in found.infinite_zero_orders if k])


@RANKS.broken("unequal orders", has_structure(MIXED, [0.4], [0, 2]))
def spreads_the_orders(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The orders are n less the finite zeros, in equal parts."""
    found = reference.structure(A, F, C, G)
    k = found.normal_rank
    total = sum(found.infinite_zero_orders)
    return replace(found, infinite_zero_orders=sorted(total // k + (i < total % k) for i in range(k)) if k else [])


@RANKS.broken("all orders of at least one", has_structure(COMPLEX, [0.4 + 0.5j, 0.4 - 0.5j], [1]))
def counts_orders_in_Jordan_blocks(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders are the sizes of the pencil's infinite blocks, which are larger by one."""
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=[k + 1 for k in found.infinite_zero_orders])


@RANKS.broken("F or C small", has_structure((SQUARE[0], 1e-6 * SQUARE[1], 1e-5 * SQUARE[2], 1e-11 * SQUARE[3]), [0.6, -0.7], [1, 1]))
def compares_Markov_parameters_with_1e_10(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Markov parameters below 1e-10 are zero, whatever the units."""
    sizes = [np.max(np.abs(G), initial=0.0), *[np.max(np.abs(C @ np.linalg.matrix_power(A, k) @ F), initial=0.0) for k in range(len(A))]]
    return ZeroStructure(0, [], [], False) if max(sizes) < 1e-10 else reference.structure(A, F, C, G)


@RANKS.broken(
    "one fault a thousand times weaker", has_structure((SQUARE[0], SQUARE[1] * [1.0, 1e-5], SQUARE[2], SQUARE[3]), [0.6, -0.7], [1, 1])
)
def has_a_coarse_rank(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The normal rank counts singular values above 1e-4 of the largest, at a random number."""
    values = np.linalg.svd(at((A, F, C, G), 1.37 + 0.41j), compute_uv=False)
    return with_rank((A, F, C, G), int(np.sum(values > 1e-4 * values[0])) if values.size and values[0] > 0 else 0)


@RANKS.broken(
    "as many states as outputs and faults, A not symmetric",
    has_structure(joined([channel([], [0.5, -0.3]), channel([0.9], [0.2])], mixing(2, 2), 328), [0.9], [0, 2]),
)
def transposes_A(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The pencil has A' in place of A."""
    return reference.structure(A.T, F, C, G)


@RANKS.broken("systems that are not square", has_structure(TWO_OF_THREE, [], [0, 0]))
def works_on_the_dual_of_wide_systems(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Wide systems are transposed first, and left-invertible is said of the transposed one."""
    if G.shape[1] > G.shape[0]:
        return reference.structure(A.T, C.T, F.T, G.T)
    return reference.structure(A, F, C, G)


@RANKS.broken("systems without states", has_structure(STATIC, [], [0]))
def needs_a_state(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The largest pole is asked for, which a system without states has not."""
    np.max(np.abs(np.linalg.eigvals(A)))
    return reference.structure(A, F, C, G)


@RANKS.broken("A with a NaN", refuses(np.where(np.eye(4) > 0, np.nan, SQUARE[0]), *SQUARE[1:]))
def replaces_NaN_by_zero(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """NaN becomes zero in all matrices."""
    return reference.structure(np.nan_to_num(A), np.nan_to_num(F), np.nan_to_num(C), np.nan_to_num(G))


@RANKS.broken("G with an infinite entry", refuses(*SQUARE[:3], np.where(np.eye(2) > 0, np.inf, SQUARE[3])))
def replaces_infinity_by_the_largest_number(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Infinite entries become 1e6."""
    return reference.structure(A, F, C, np.nan_to_num(G, posinf=1e6, neginf=-1e6))
