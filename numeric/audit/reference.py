"""This is our own numeric branch as an implementation: what `faultspace audit` tests when nothing is named, and a pattern for adapters.

Its functions are the public ones of `faultspace.numeric`, those that `faultspace.identify` calls, with arrays as a record of one piece.
Where a function of ours warns and goes on, the adapter refuses: A that the window does not determine, ranks that are not clear.
"""

from __future__ import annotations

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.sheets import counted
from ..data.validation import enough_samples, signal
from ..method.model.asymptotic_likelihood import arx_reduction
from ..method.model.models import StateSpaceModel, lower_toeplitz
from ..method.model.past_inputs import UNDETERMINED, pi_moesp
from ..method.model.residuals import residual as subtract
from ..method.ranks.hankel_ranks import rounding_ranks
from ..method.ranks.rank_gap import fault_dimension as count
from ..method.ranks.sample_windows import EPS, channel_sizes
from ..method.rows.fault_count import count_faults as count_in_record
from ..method.rows.space_by_rows import identified_fault_space as space_of_model
from ..method.signal.pair_zeros import fault_zeros, in_equal_units
from ..method.signal.reconstruction import reconstruct_fault
from ..method.space.by_ranks import fault_space as space
from .adapter import ZeroStructure

RANK = 1e-10  # of the largest singular value: ranks of small matrices with entries of a few digits


def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Array, Array, Array, Array]:
    """The method is PI-MOESP."""
    found = pi_moesp(y, u, order=order, block_rows=block_rows)
    if not found.condition_numbers["observability"] <= UNDETERMINED:
        raise InvalidData("; ".join(found.warnings))
    return found.A, found.B, found.C, found.D


def residual(y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Array:
    """The initial state is fitted."""
    return subtract(y, u, StateSpaceModel(A, B, C, D)).r


def window_ranks(r: Array, windows: int) -> tuple[int, ...]:
    """Return the ranks at the rounding threshold, channels in unit mean square."""
    data = signal(r, "r")
    enough_samples(len(data), (data.shape[1] + 1) * windows - 1, f"a window of {counted(windows, 'block row')}", data.shape)
    return rounding_ranks(data / channel_sizes(data), windows, unit=EPS).ranks


def fault_dimension(r: Array) -> int | None:
    """The number is None where it is undecided."""
    return count(r).n_v


def fault_space(r: Array, A: Array, C: Array, n_v: int, block_rows: int) -> Array:
    """The space is from the exact ranks of the windows; where there is noise after all, and it is undecided, there is none."""
    found = space(r, A, C, n_v=n_v, block_rows=block_rows)
    if not found.meaningful or (found.method == "likelihood" and not found.decided):
        raise InvalidData(found.reason)
    return found.basis


def reconstruct(r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Array:
    """The signal is that of the smoother."""
    found = reconstruct_fault(r, A, F, C, G, x0=x0)
    if not found.left_invertible:
        raise InvalidData(found.reason)
    return found.v


def structure(A: Array, F: Array, C: Array, G: Array) -> ZeroStructure:
    """The orders of infinite zeros are from #{order <= k} = rank T_(k+1) - rank T_k; the finite zeros are those of the pencil."""
    if not all(np.all(np.isfinite(matrix)) for matrix in (A, F, C, G)):
        raise InvalidData("A, F, C, G: got entries that are NaN or infinite, expected finite ones")
    orders = _infinite_zero_orders(A, *in_equal_units(F, C, G))
    found = fault_zeros(A, F, C, G)
    return ZeroStructure(len(orders), [complex(z) for z in found.zeros], orders, len(orders) == F.shape[1])


def count_faults(y: Array, u: Array, order: int) -> int | None:
    """The number is None where it is undecided."""
    return count_in_record(y, u, order=order).n_v


def identified_fault_space(y: Array, u: Array, order: int, n_v: int) -> tuple[Array, Array, Array] | None:
    """The model is that of `arx_reduction`; None where the space is undecided."""
    model = arx_reduction(y, u, order=order)
    found = space_of_model(y, u, model, n_v=n_v)
    return (model.model.A, model.model.C, found.basis) if found.decided and found.meaningful else None


def _infinite_zero_orders(A: Array, F: Array, C: Array, G: Array) -> list[int]:
    markov = StateSpaceModel(A, F, C, G).markov(len(A) + 1)
    orders, before = list[int](), 0
    for k in range(len(markov)):
        rank = _rank(lower_toeplitz(markov[: k + 1]))
        orders += [k] * (rank - before - len(orders))
        before = rank
    return orders


def _rank(matrix: Array) -> int:
    values = np.linalg.svd(matrix, compute_uv=False)
    return int(np.sum(values > RANK * values[0]))
