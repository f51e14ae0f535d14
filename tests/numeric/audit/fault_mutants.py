"""Mutants of what comes after a model: residual, ranks, number of faults, their space and signal, and the structure of a system.

FAULTS     all of them; those marked "published" are errors found in packages and in published code
UNSEEN     the views in which a mutant of the residual, or of the signal, is wrong as it is in the plain check
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix
from faultspace.numeric.method.ranks.sample_windows import hankel_factor
from faultspace.numeric.method.space.by_ranks import noise_free_fault_space
from faultspace.numeric.study import toeplitz_factorisation
from tests.numeric.audit.breaking import mutant, patched, views
from tests.numeric.audit.identification_mutants import RANGE

# -- faults ------------------------------------------------------------------------------------------------------------------------


def _ranks_at(level: float) -> Callable[[Any, int], list[int]]:
    """Singular values above an absolute level count."""

    def window_ranks(r: Any, windows: int) -> list[int]:
        return [int(np.sum(np.linalg.svd(hankel_factor(r, s), compute_uv=False) > level)) for s in range(1, windows + 1)]

    return window_ranks


def _ranks_one_short(r: Any, windows: int) -> Any:
    return [0, *reference.window_ranks(r, windows)[:-1]]


def _whole_outputs(r: Any) -> int:
    """The default threshold of a rank takes rounding for faults: n_v = p."""
    return int(r.shape[1])


def _count_at(level: float) -> Callable[[Any], int]:
    """The last gap of ranks by an absolute threshold."""

    def fault_dimension(r: Any) -> int:
        ranks = _ranks_at(level)(r, 8)
        return ranks[-1] - ranks[-2]

    return fault_dimension


def _gap_at_one(r: Any) -> int:
    """rank R_2 - rank R_1: a window below the lag."""
    ranks = reference.window_ranks(r, 2)
    return ranks[1] - ranks[0]


def _default_tolerance(r: Any) -> int:
    """The gap of ranks at numpy's default tolerance: of the largest singular value, in whatever units."""
    ranks = [int(np.linalg.matrix_rank(hankel_factor(r, s))) for s in (7, 8)]
    return ranks[1] - ranks[0]


def _relative_ranks(r: Any, windows: int) -> list[int]:
    """Singular values above 1e-10 of the largest count, channels in whatever units."""
    values = (np.linalg.svd(hankel_factor(r, s), compute_uv=False) for s in range(1, windows + 1))
    return [int(np.sum(one > 1e-10 * one[0])) for one in values]


def _padded(r: Any) -> Any:
    """Zeros behind the record, up to the length that buffers have: right for a record that fills them."""
    return np.vstack([r, np.zeros((max(90 - len(r), 0), r.shape[1]))])


def _ranks_padded(r: Any, windows: int) -> Any:
    return reference.window_ranks(_padded(r), windows)


def _count_padded(r: Any) -> Any:
    data = _padded(r)
    ranks = reference.window_ranks(data, 8)
    return ranks[-1] - ranks[-2]


def _space_padded(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    return noise_free_fault_space(_padded(r), A, C, n_v=n_v, block_rows=block_rows).basis


def _ranks_as_if_excited(r: Any, windows: int) -> Any:
    """It takes the first step to go on for ever."""
    one, two = reference.window_ranks(r, 2)
    return [one + (s - 1) * (two - one) for s in range(1, windows + 1)]


def _count_unscaled(r: Any) -> int:
    """The gap of ranks at 1e-8 of the largest singular value, channels in whatever units."""
    values = [np.linalg.svd(hankel_factor(r, s), compute_uv=False) for s in (7, 8)]
    return int(np.sum(values[1] > 1e-8 * values[1][0])) - int(np.sum(values[0] > 1e-8 * values[0][0]))


def _square_time(r: Any, windows: int) -> Any:
    """Every sample is compared with all others, six times: the cheapest square that stands out clearly."""
    first = np.ascontiguousarray(r[:, 0])
    for _ in range(6):
        assert sum(int(np.sum(first[k : k + 100, None] >= first)) for k in range(0, len(first), 100)) >= len(first)
    return reference.window_ranks(r, windows)


def _window_of_n(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """It takes n block rows where lag + 1 are needed."""
    return noise_free_fault_space(r, A, C, n_v=n_v, block_rows=len(A)).basis


def _window_one_short(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """block_rows - 1: a window of lag + 1 becomes one at the lag."""
    return noise_free_fault_space(r, A, C, n_v=n_v, block_rows=block_rows - 1).basis


def _factorised(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The published factorisation with the exact rank of R_s."""
    n_z = reference.fault_space(r, A, C, n_v, block_rows).shape[1]
    rank = reference.window_ranks(r, block_rows)[-1]
    return toeplitz_factorisation.toeplitz_factorisation(r, A, C, block_rows=block_rows, rank=rank, n_z=n_z)


def _floor_of_a_range(A: Any, C: Any, count: int) -> Any:
    """O_count whose block rows, last first, are numbered by floor((s - 1 - 1/p) : -1/p : 0), s - 1 = count: rounding drops some by one."""
    p = len(C)
    steps = np.arange(count * p)
    numbers = np.floor((count - 1 / p) + steps * (-1 / p)).astype(int)
    rows = observability_matrix(A, C, count).reshape(count, p, -1)
    return rows[numbers, steps % p].reshape(count, p, -1)[::-1].reshape(count * p, -1)


def _space_at(level: float) -> Callable[..., Any]:
    """The published factorisation with the rank of R_s by an absolute threshold; the dimension is given right."""

    def fault_space(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
        s = len(A) + 1
        n_z = reference.fault_space(r, A, C, n_v, block_rows).shape[1]
        return toeplitz_factorisation.toeplitz_factorisation(r, A, C, block_rows=s, rank=max(_ranks_at(level)(r, s)[-1], 1), n_z=n_z)

    return fault_space


def _space_unscaled(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The rank of R_s at 1e-10 of the largest singular value; the dimension is given right."""
    n_z = reference.fault_space(r, A, C, n_v, block_rows).shape[1]
    rank = _relative_ranks(r, block_rows)[-1]
    return toeplitz_factorisation.toeplitz_factorisation(r, A, C, block_rows=block_rows, rank=rank, n_z=n_z)


def _unsuspecting(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Whatever the window gives, without a look at the ladder of ranks."""
    return noise_free_fault_space(r, A, C, n_v=n_v, block_rows=block_rows).basis


def _everything(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Contains every fault column, so that a one-sided distance is zero."""
    return np.eye(len(A) + len(C))


def _basis_assumed(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """F from an A taken for symmetric: right in one basis at the most."""
    return reference.fault_space(r, (A + A.T) / 2, C, n_v, block_rows)


def _only_n_v(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    return reference.fault_space(r, A, C, n_v, block_rows)[:, :n_v]


def _residual_without_feedthrough(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    return reference.residual(y, u, A, B, C, 0 * D)


def _residual_of_reversed_inputs(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Input channels in the wrong order: right for one."""
    return reference.residual(y, u[:, ::-1], A, B, C, D)


def _residual_late(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """It uses x(k+1) for x(k)."""
    model = StateSpaceModel(A, B, C, D)
    late = np.vstack([model.simulate(u)[1:], np.zeros((1, len(C)))])
    return y - late


def _signal_from_rest(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return reference.reconstruct(r, A, F, C, G, 0 * x0)


def _residual_rounded(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """It has a fixed resolution."""
    return np.round(reference.residual(y, u, A, B, C, D), 12)


def _residual_limited(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    return reference.residual(np.clip(y, -RANGE, RANGE), u, A, B, C, D)


def _signal_rounded(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return np.round(reference.reconstruct(r, A, F, C, G, x0), 12)


def _signal_limited(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return reference.reconstruct(np.clip(r, -RANGE, RANGE), A, F, C, G, x0)


# -- structure ---------------------------------------------------------------------------------------------------------------------


def _finite_only(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=[0] * found.normal_rank)


def _inside_only(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[z for z in found.finite_zeros if abs(z) < 1])


def _columns_counted(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    found = reference.structure(A, F, C, G)
    return replace(found, normal_rank=min(F.shape[1], len(C)), left_invertible=F.shape[1] <= len(C))


def _outputs_of_record(y: Any, u: Any, order: int) -> int:
    return int(y.shape[1])


def _columns_turned(y: Any, u: Any, order: int, n_v: int) -> Any:
    """The columns are [g; f] in place of [f; g]."""
    A, C, columns = reference.identified_fault_space(y, u, order, n_v) or (np.eye(order), np.eye(y.shape[1], order), np.eye(1))
    return A, C, np.vstack([columns[len(A) :], columns[: len(A)]])


UNSEEN = ("other-units", "permuted-outputs", "other-basis", "time-shift", "split-data")


def _one_at_least(count: Callable[..., Any]) -> Callable[..., Any]:
    def counted(*arguments: Any) -> Any:
        found = count(*arguments)
        return found if found is None else max(found, 1)

    return counted


def _of_large_outputs(y: Any, u: Any, order: int) -> Any:
    return reference.count_faults(y, u, order) if np.max(np.abs(y)) > 1e-6 else 0


def _ten_windows(r: Any, windows: int) -> Any:
    found = list(reference.window_ranks(r, min(windows, 10)))
    return found + found[-1:] * (windows - len(found))


FAULTS = [
    mutant("square-time", "every sample looks at all before it", "time-grows-with-N", window_ranks=_square_time),
    mutant("ranks-at-one", "singular values above 1.0 count (published)", "window-ranks-1e-6", window_ranks=_ranks_at(1.0)),
    mutant("ranks-at-1e-6", "singular values above 1e-6 count", "window-ranks-1e-12", window_ranks=_ranks_at(1e-6)),
    mutant("count-at-1e-6", "n_v from singular values above 1e-6", "fault-dimension-1e-12", fault_dimension=_count_at(1e-6)),
    mutant(
        "count-at-one",
        "n_v from singular values above 1.0 (published)",
        "fault-dimension-1e-6",
        "fault-dimension-noisy",
        fault_dimension=_count_at(1.0),
    ),
    mutant("count-at-1e-9", "n_v from singular values above 1e-9", "fault-dimension-1e6", fault_dimension=_count_at(1e-9)),
    mutant("space-at-1e-6", "rank of R_s by the threshold 1e-6", "fault-space-1e-12", fault_space=_space_at(1e-6)),
    mutant("ranks-at-1e-9", "singular values above 1e-9 count", "window-ranks-1e6", window_ranks=_ranks_at(1e-9)),
    mutant("ranks-one-short", "window s - 1 for s", "window-ranks", "window-ranks-permuted-outputs", window_ranks=_ranks_one_short),
    mutant(
        "ranks-unscaled", "1e-10 of the largest singular value in whatever units", "window-ranks-other-units", window_ranks=_relative_ranks
    ),
    mutant("ranks-padded", "zeros behind the record", "window-ranks-time-shift", "window-ranks-split-data", window_ranks=_ranks_padded),
    mutant("ranks-as-if-excited", "the first step of the ranks goes on", "window-ranks-unexciting", window_ranks=_ranks_as_if_excited),
    mutant(
        "default-tolerance",
        "n_v from numpy's default tolerance: p wherever there is noise (published)",
        "fault-dimension-noisy",
        fault_dimension=_default_tolerance,
    ),
    mutant(
        "count-padded", "zeros behind the record", "fault-dimension-time-shift", "fault-dimension-split-data", fault_dimension=_count_padded
    ),
    mutant("count-unscaled", "1e-8 of the largest singular value", "fault-dimension-other-units", fault_dimension=_count_unscaled),
    mutant(
        "as-many-as-outputs", "n_v = p (published)", "fault-dimension", "fault-dimension-permuted-outputs", fault_dimension=_whole_outputs
    ),
    mutant("gap-below-the-lag", "rank R_2 - rank R_1", "fault-dimension", fault_dimension=_gap_at_one),
    mutant("window-of-n", "n block rows where lag + 1 are needed", "fault-space", fault_space=_window_of_n),
    mutant("space-at-one", "rank of R_s by the threshold 1.0 (published)", "fault-space-1e-6", fault_space=_space_at(1.0)),
    mutant("space-at-1e-9", "rank of R_s by the threshold 1e-9", "fault-space-1e6", fault_space=_space_at(1e-9)),
    mutant("space-unscaled", "rank of R_s at 1e-10 of the largest singular value", "fault-space-other-units", fault_space=_space_unscaled),
    mutant("space-padded", "zeros behind the record", "fault-space-time-shift", "fault-space-split-data", fault_space=_space_padded),
    mutant("unsuspecting", "no look at the ranks of other windows", "fault-space-at-the-lag", fault_space=_unsuspecting),
    mutant("window-one-short", "block_rows - 1 block rows", "fault-space-shortest-window", fault_space=_window_one_short),
    mutant(
        "floor-of-a-range",
        "rows of O off by one where the floor of a fractional range is: p = 3, s = 10 (published)",
        "fault-space-long-window",
        fault_space=patched(_factorised, (toeplitz_factorisation, "observability_matrix", _floor_of_a_range)),
    ),
    mutant(
        "everything",
        "all of R^(n+p), which a one-sided distance likes (published)",
        "fault-space",
        "fault-space-permuted-outputs",
        fault_space=_everything,
    ),
    mutant("basis-assumed", "A taken for symmetric", "fault-space-other-basis", fault_space=_basis_assumed),
    mutant("only-n-v", "n_v columns, the zeros' left out", "fault-space", fault_space=_only_n_v),
    mutant("residual-without-D", "D ignored in the residual", "residual-free-of-input", residual=_residual_without_feedthrough),
    mutant("residual-of-reversed-inputs", "input channels reversed", "residual-free-of-input", residual=_residual_of_reversed_inputs),
    mutant(
        "residual-late",
        "x(k+1) used for x(k)",
        "residual-free-of-input",
        *views("residual-free-of-input", *UNSEEN),
        residual=_residual_late,
    ),
    mutant(
        "residual-rounded",
        "twelve decimals",
        "residual-free-of-input-1e-12",
        "residual-free-of-input-1e-6",
        residual=_residual_rounded,
    ),
    mutant("residual-limited", "outputs cut at 1e5", "residual-free-of-input-1e6", residual=_residual_limited),
    mutant("signal-rounded", "twelve decimals", "fault-signal-1e-12", "fault-signal-1e-6", reconstruct=_signal_rounded),
    mutant("signal-limited", "residuals cut at 1e5", "fault-signal-1e6", reconstruct=_signal_limited),
    mutant("signal-from-rest", "x(0) ignored", "fault-signal", *views("fault-signal", *UNSEEN), reconstruct=_signal_from_rest),
    mutant("finite-only", "infinite zeros taken for none", "infinite-zeros", structure=_finite_only),
    mutant("inside-only", "zeros outside the unit circle dropped", "finite-zeros", structure=_inside_only),
    mutant("columns-counted", "min(m, p) for the normal rank", "normal-rank", structure=_columns_counted),
    mutant(
        "outputs-of-record",
        "n_v = p, from outputs and inputs",
        "faults-of-record",
        *views("faults-of-record", "noisy", "noisy-other-units"),
        count_faults=_outputs_of_record,
    ),
    mutant("small-outputs", "outputs below a millionth have no fault", "faults-of-record-small-units", count_faults=_of_large_outputs),
    mutant("one-at-least", "a fault in every residual", "no-fault-told", fault_dimension=_one_at_least(reference.fault_dimension)),
    mutant("one-at-least-of-record", "a fault in every record", "no-fault-of-record", count_faults=_one_at_least(reference.count_faults)),
    mutant("ten-windows", "the rank of the tenth window for all longer ones", "window-ranks-many-windows", window_ranks=_ten_windows),
    mutant(
        "columns-turned",
        "g above f",
        "space-of-record-noisy",
        "space-of-record-noisy-other-units",
        identified_fault_space=_columns_turned,
    ),
]
