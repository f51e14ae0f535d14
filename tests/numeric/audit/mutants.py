"""The reference with one thing broken, each as an adapter and the slug of a check that must catch it.

MUTANTS     all of them, with those of `manner_mutants`; `breaking` says what a mutant is. Checks that an unseen mutant fails need none here
IDENTIFICATION, FAULTS, EDGES    of `identify`; of what comes after a model; right wherever there is plenty. Those marked "published" are
            errors found in packages and in published code
VIEWED      the views in which a mutant of the residual, or of the signal, is wrong as it is in the plain check
RANGE       what a mutant of limited range cuts signals at;   REFUSES: names of those whose mistake is to give no answer
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model import input_matrices
from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix
from faultspace.numeric.method.model.past_outputs import po_moesp
from faultspace.numeric.method.ranks.sample_windows import hankel_factor
from faultspace.numeric.method.space.by_ranks import noise_free_fault_space
from faultspace.numeric.study import toeplitz_factorisation
from tests.numeric.audit.breaking import Mutant, mutant, patched, views
from tests.numeric.audit.manner_mutants import MANNERS


def _interleaved(y: Any, u: Any, order: int, block_rows: int) -> Any:
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, np.ascontiguousarray(B.T).reshape(B.shape), C, D


def _in_place(y: Any, u: Any, order: int, block_rows: int) -> Any:
    y -= y.mean(axis=0)
    return reference.identify(y, u, order, block_rows)


def _past_outputs(y: Any, u: Any, order: int, block_rows: int) -> Any:
    found = po_moesp(y, u, order=order, block_rows=block_rows)
    return found.A, found.B, found.C, found.D


def _jittered(y: Any, u: Any, order: int, block_rows: int) -> Any:
    noise = np.random.default_rng().standard_normal(y.shape)
    return reference.identify(y * (1 + 1e-15 * noise), u, order, block_rows)


def _absolute_scale(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Small channels are rounded away: a fixed resolution."""
    return reference.identify(np.round(y, 9), np.round(u, 9), order, block_rows)


RANGE = 1e5
true_regression = input_matrices._Regression.__init__


def _from_rest(self: Any, A: Any, C: Any, n_u: int) -> None:
    true_regression(self, A, C, n_u)
    self._states[0] = 0.0


def _limited_range(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Samples beyond the converter's range are cut."""
    return reference.identify(np.clip(y, -RANGE, RANGE), u, order, block_rows)


def _square_memory(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Compares every pair of samples; a byte each, which is little enough for a test."""
    t = np.arange(len(y))
    return reference.identify(y[np.equal.outer(t, t).argmax(axis=1)], u, order, block_rows)


_identify = reference.identify
IDENTIFICATION = [
    mutant(
        "interleaved-inputs", "B reshaped by rows, wrong for n_u > 1 (published)", "exact-recovery", "long-window", identify=_interleaved
    ),
    mutant(
        "initial-state-ignored",
        "B and D fitted from rest (published)",
        "exact-recovery",
        "time-shift",
        "split-data",
        identify=patched(_identify, (input_matrices._Regression, "__init__", _from_rest)),
    ),
    mutant("fixed-resolution", "signals rounded to nine decimals", "other-units", "exact-recovery-1e-6", identify=_absolute_scale),
    mutant("past-outputs", "PO-MOESP: past outputs as instruments", "consistent-under-coloured-fault", identify=_past_outputs),
    mutant("inputs-modified", "means removed in place (published)", "inputs-untouched", identify=_in_place),
    mutant("jittered", "a random perturbation", "deterministic", identify=_jittered),
    mutant(
        "window-undetermined",
        "a window at the lag goes through",
        "refuses-window-at-the-lag",
        identify=patched(_identify, (reference, "UNDETERMINED", np.inf)),
    ),
    mutant("limited-range", "outputs cut at 1e5", "exact-recovery-1e6", identify=_limited_range),
    mutant("square-memory", "a weight for every pair of samples (published)", "memory-grows-with-N", identify=_square_memory),
]


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


def _unsuspecting(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Whatever the window gives, without a look at the ladder of ranks."""
    return noise_free_fault_space(r, A, C, n_v=n_v, block_rows=block_rows).basis


def _everything(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Contains every fault column, so that a one-sided distance is zero."""
    return np.eye(len(A) + len(C))


def _basis_assumed(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """F from an A taken for symmetric: right in one basis at the most."""
    return reference.fault_space(r, (A + A.T) / 2, C, n_v, block_rows)


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


def _signal_rounded(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return np.round(reference.reconstruct(r, A, F, C, G, x0), 12)


def _signal_limited(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return reference.reconstruct(np.clip(r, -RANGE, RANGE), A, F, C, G, x0)


# -- structure ---------------------------------------------------------------------------------------------------------------------


def _outputs_of_record(y: Any, u: Any, order: int) -> int:
    return int(y.shape[1])


def _columns_turned(y: Any, u: Any, order: int, n_v: int) -> Any:
    """The columns are [g; f] in place of [f; g]."""
    A, C, columns = reference.identified_fault_space(y, u, order, n_v) or (np.eye(order), np.eye(y.shape[1], order), np.eye(1))
    return A, C, np.vstack([columns[len(A) :], columns[: len(A)]])


VIEWED = ("other-units", "permuted-outputs", "other-basis", "time-shift", "split-data")


FAULTS = [
    mutant("square-time", "every sample looks at all before it", "time-grows-with-N", window_ranks=_square_time),
    mutant("ranks-at-one", "singular values above 1.0 count (published)", "window-ranks-1e-6", window_ranks=_ranks_at(1.0)),
    mutant(
        "count-at-one",
        "n_v from singular values above 1.0 (published)",
        "fault-dimension-1e-6",
        "fault-dimension-noisy",
        fault_dimension=_count_at(1.0),
    ),
    mutant("count-at-1e-9", "n_v from singular values above 1e-9", "fault-dimension-1e6", fault_dimension=_count_at(1e-9)),
    mutant("ranks-at-1e-9", "singular values above 1e-9 count", "window-ranks-1e6", window_ranks=_ranks_at(1e-9)),
    mutant("ranks-one-short", "window s - 1 for s", "window-ranks", "window-ranks-permuted-outputs", window_ranks=_ranks_one_short),
    mutant(
        "ranks-unscaled", "1e-10 of the largest singular value in whatever units", "window-ranks-other-units", window_ranks=_relative_ranks
    ),
    mutant("ranks-padded", "zeros behind the record", "window-ranks-time-shift", "window-ranks-split-data", window_ranks=_ranks_padded),
    mutant("ranks-as-if-excited", "the first step of the ranks goes on", "window-ranks-unexciting", window_ranks=_ranks_as_if_excited),
    mutant(
        "count-padded", "zeros behind the record", "fault-dimension-time-shift", "fault-dimension-split-data", fault_dimension=_count_padded
    ),
    mutant("count-unscaled", "1e-8 of the largest singular value", "fault-dimension-other-units", fault_dimension=_count_unscaled),
    mutant(
        "as-many-as-outputs", "n_v = p (published)", "fault-dimension", "fault-dimension-permuted-outputs", fault_dimension=_whole_outputs
    ),
    mutant("space-at-one", "rank of R_s by the threshold 1.0 (published)", "fault-space-1e-6", fault_space=_space_at(1.0)),
    mutant("space-at-1e-9", "rank of R_s by the threshold 1e-9", "fault-space-1e6", fault_space=_space_at(1e-9)),
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
    mutant(
        "residual-late",
        "x(k+1) used for x(k)",
        "residual-free-of-input",
        *views("residual-free-of-input", *VIEWED),
        residual=_residual_late,
    ),
    mutant(
        "residual-rounded",
        "twelve decimals",
        "residual-free-of-input-1e-12",
        "residual-free-of-input-1e-6",
        residual=_residual_rounded,
    ),
    mutant("signal-rounded", "twelve decimals", "fault-signal-1e-12", "fault-signal-1e-6", reconstruct=_signal_rounded),
    mutant("signal-limited", "residuals cut at 1e5", "fault-signal-1e6", reconstruct=_signal_limited),
    mutant("signal-from-rest", "x(0) ignored", "fault-signal", *views("fault-signal", *VIEWED), reconstruct=_signal_from_rest),
    mutant(
        "outputs-of-record",
        "n_v = p, from outputs and inputs",
        "faults-of-record",
        *views("faults-of-record", "noisy", "noisy-other-units"),
        count_faults=_outputs_of_record,
    ),
    mutant(
        "columns-turned",
        "g above f",
        "space-of-record-noisy",
        "space-of-record-noisy-other-units",
        identified_fault_space=_columns_turned,
    ),
]


def _one_sample_more(r: Any, windows: int) -> Any:
    """The last window must be wider than high, and square is not enough."""
    if len(r) < (r.shape[1] + 1) * windows:
        raise ValueError("too few samples")
    return reference.window_ranks(r, windows)


def _four_gaps(r: Any) -> Any:
    """A gap must stay four times."""
    return reference.fault_dimension(r[: len(r) - 2 * r.shape[1] - 1])


def _something_at_least(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """A signal that is nothing is taken for a failure, and a small constant stands for it."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    return v if np.max(np.abs(v)) > 1e-9 * np.max(np.abs(r)) else v + 1e-6 * np.max(np.abs(r))


def _as_many_as_told(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Where the number that was told does not fit, the first columns of the identity are given out."""
    try:
        return reference.fault_space(r, A, C, n_v, block_rows)
    except ValueError:
        return np.eye(len(A) + len(C))[:, :n_v]


EDGES: tuple[Mutant, ...] = (
    mutant("one-sample-more", "square windows refused", "window-ranks-shortest-record", window_ranks=_one_sample_more),
    mutant("four-gaps", "a gap has to stay four times", "fault-dimension-shortest-record", fault_dimension=_four_gaps),
    mutant("something-at-least", "no signal is a small one", "fault-signal-no-fault", reconstruct=_something_at_least),
    mutant("as-many-as-told", "any columns, as many as were told", "fault-space-wrong-number", fault_space=_as_many_as_told),
)
REFUSES = ("one-sample-more", "four-gaps")

MUTANTS = [*IDENTIFICATION, *FAULTS, *EDGES, *MANNERS]
