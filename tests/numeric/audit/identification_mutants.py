"""Mutants of `identify`: our subspace method with one thing broken.

IDENTIFICATION     all of them; those marked "published" are errors found in packages and in published code
RANGE              what a mutant of limited range cuts signals at, of those in `fault_mutants` too
"""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model import compression, input_matrices
from faultspace.numeric.method.model.compression import Blocks, Compression
from faultspace.numeric.method.model.past_outputs import po_moesp
from tests.numeric.audit.breaking import mutant, patched


def _wrong_transpose(y: Any, u: Any, order: int, block_rows: int) -> Any:
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A.T, B, C, D


def _without_feedthrough(y: Any, u: Any, order: int, block_rows: int) -> Any:
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, np.zeros_like(D)


def _interleaved(y: Any, u: Any, order: int, block_rows: int) -> Any:
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, np.ascontiguousarray(B.T).reshape(B.shape), C, D


def _past_outputs(y: Any, u: Any, order: int, block_rows: int) -> Any:
    found = po_moesp(y, u, order=order, block_rows=block_rows)
    return found.A, found.B, found.C, found.D


def _order_ignored(y: Any, u: Any, order: int, block_rows: int) -> Any:
    return reference.identify(y, u, min(order, y.shape[1] * (block_rows - 1), 2), block_rows)


def _channels_by_size(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Sorts the outputs and forgets to sort them back."""
    return reference.identify(y[:, np.argsort(np.sum(y**2, axis=0))], u, order, block_rows)


def _missing_as_zero(y: Any, u: Any, order: int, block_rows: int) -> Any:
    return reference.identify(np.nan_to_num(y), np.nan_to_num(u), order, block_rows)


def _in_place(y: Any, u: Any, order: int, block_rows: int) -> Any:
    y -= y.mean(axis=0)
    return reference.identify(y, u, order, block_rows)


def _cut_to_fit(y: Any, u: Any, order: int, block_rows: int) -> Any:
    shared = min(len(y), len(u))
    return reference.identify(y[-shared:], u[-shared:], order, block_rows)


def _jittered(y: Any, u: Any, order: int, block_rows: int) -> Any:
    noise = np.random.default_rng().standard_normal(y.shape)
    return reference.identify(y * (1 + 1e-15 * noise), u, order, block_rows)


def _absolute_scale(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Small channels are rounded away: a fixed resolution."""
    return reference.identify(np.round(y, 9), np.round(u, 9), order, block_rows)


def _finer_scale(y: Any, u: Any, order: int, block_rows: int) -> Any:
    return reference.identify(np.round(y, 15), np.round(u, 15), order, block_rows)


RANGE = 1e5
true_blocks, true_rows, true_regression = Compression.blocks, compression.window_rows, input_matrices._Regression.__init__


def _blocks_without_projection(self: Compression) -> Blocks:
    parts = true_blocks(self)
    return parts._replace(l32=parts.l32 + parts.l31[:, : parts.l32.shape[1]])


def _blocks_of_the_future(self: Compression) -> Blocks:
    parts = true_blocks(self)
    return parts._replace(l32=parts.l31[:, : parts.l32.shape[1]])


def _rows_off_by_one(n_u: int, p: int, past_rows: int, block_rows: int) -> Any:
    result = true_rows(n_u, p, past_rows, block_rows).copy()
    result[(past_rows + block_rows) * n_u :, 0] -= 1
    return result


def _from_rest(self: Any, A: Any, C: Any, n_u: int) -> None:
    true_regression(self, A, C, n_u)
    self._states[0] = 0.0


def _dead_outputs(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Outputs of a millionth of the largest are taken for dead."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    sizes = np.max(np.abs(y), axis=0)
    alive = (sizes > 1e-6 * np.max(sizes))[:, None]
    return A, B, C * alive, D * alive


def _limited_range(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Samples beyond the converter's range are cut."""
    return reference.identify(np.clip(y, -RANGE, RANGE), u, order, block_rows)


def _square_memory(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Compares every pair of samples; a byte each, which is little enough for a test."""
    t = np.arange(len(y))
    return reference.identify(y[np.equal.outer(t, t).argmax(axis=1)], u, order, block_rows)


_identify = reference.identify
IDENTIFICATION = [
    mutant("wrong-transpose", "A transposed", "exact-recovery", identify=_wrong_transpose),
    mutant("feedthrough-ignored", "D = 0 (published)", "exact-recovery", identify=_without_feedthrough),
    mutant(
        "interleaved-inputs", "B reshaped by rows, wrong for n_u > 1 (published)", "exact-recovery", "long-window", identify=_interleaved
    ),
    mutant(
        "hankel-off-by-one",
        "y(k) paired with u(k+1)",
        "exact-recovery",
        identify=patched(_identify, (compression, "window_rows", _rows_off_by_one)),
    ),
    mutant(
        "projection-dropped",
        "future inputs not projected out",
        "exact-recovery",
        identify=patched(_identify, (Compression, "blocks", _blocks_without_projection)),
    ),
    mutant(
        "future-as-instruments",
        "future inputs in place of past ones",
        "exact-recovery",
        identify=patched(_identify, (Compression, "blocks", _blocks_of_the_future)),
    ),
    mutant(
        "initial-state-ignored",
        "B and D fitted from rest (published)",
        "exact-recovery",
        "time-shift",
        "split-data",
        identify=patched(_identify, (input_matrices._Regression, "__init__", _from_rest)),
    ),
    mutant("past-outputs", "PO-MOESP: past outputs as instruments", "consistent-under-coloured-fault", identify=_past_outputs),
    mutant("order-ignored", "never more than two states (published)", "exact-recovery", identify=_order_ignored),
    mutant("fixed-resolution", "signals rounded to nine decimals", "other-units", "exact-recovery-1e-6", identify=_absolute_scale),
    mutant("finer-resolution", "signals rounded to fifteen decimals", "exact-recovery-1e-12", identify=_finer_scale),
    mutant("channels-by-size", "outputs sorted, and not back", "permuted-channels", identify=_channels_by_size),
    mutant("missing-as-zero", "NaN read as zero", "refuses-nan-output", identify=_missing_as_zero),
    mutant("inputs-modified", "means removed in place (published)", "inputs-untouched", identify=_in_place),
    mutant("cut-to-fit", "records of unequal lengths cut", "refuses-unequal-lengths", identify=_cut_to_fit),
    mutant("jittered", "a random perturbation", "deterministic", identify=_jittered),
    mutant(
        "window-undetermined",
        "a window at the lag goes through",
        "refuses-window-at-the-lag",
        identify=patched(_identify, (reference, "UNDETERMINED", np.inf)),
    ),
    mutant("limited-range", "outputs cut at 1e5", "exact-recovery-1e6", identify=_limited_range),
    mutant("dead-outputs", "outputs of a millionth of the largest taken for dead", "far-units", identify=_dead_outputs),
    mutant("square-memory", "a weight for every pair of samples (published)", "memory-grows-with-N", identify=_square_memory),
]
