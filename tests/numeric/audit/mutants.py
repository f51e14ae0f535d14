"""The reference with one thing broken, each as an adapter and the slug of a check that must catch it.

Mutant      name, what is wrong, the slug, `adapter` (a namespace with the broken functions alone)
MUTANTS     all of them; those marked "published" are errors found in packages and in published code
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import numpy as np

from faultspace.numeric import compression, input_matrices
from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import Structure
from faultspace.numeric.compression import Blocks, Compression
from faultspace.numeric.fault_space import noise_free_fault_space
from faultspace.numeric.models import StateSpaceModel
from faultspace.numeric.po_moesp import po_moesp
from faultspace.numeric.residual_windows import hankel_factor
from faultspace.numeric.toeplitz_factorisation import toeplitz_factorisation


@dataclass(frozen=True)
class Mutant:
    """A broken implementation and the check that it must fail."""

    name: str
    wrong: str
    caught_by: str
    adapter: Any


def _patched(function: Callable[..., Any], *patches: tuple[Any, str, Any]) -> Callable[..., Any]:
    """The function, run with these attributes (owner, name, value) replaced."""

    @contextmanager
    def all_of(left: tuple[tuple[Any, str, Any], ...]) -> Iterator[None]:
        if not left:
            yield
            return
        with patch.object(*left[0]), all_of(left[1:]):
            yield

    def run(*arguments: Any) -> Any:
        with all_of(patches):
            return function(*arguments)

    return run


# -- identify ----------------------------------------------------------------------------------------------------------------------


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


def _window_of_n(r: Any, A: Any, C: Any, n_v: int) -> Any:
    """n block rows where lag + 1 are needed."""
    return noise_free_fault_space(r, A, C, n_v=n_v, block_rows=len(A)).basis


def _space_at(level: float) -> Callable[[Any, Any, Any, int], Any]:
    """The published factorisation with the rank of R_s by an absolute threshold; the dimension is given right."""

    def fault_space(r: Any, A: Any, C: Any, n_v: int) -> Any:
        s = len(A) + 1
        n_z = reference.fault_space(r, A, C, n_v).shape[1]
        return toeplitz_factorisation(r, A, C, block_rows=s, rank=max(_ranks_at(level)(r, s)[-1], 1), n_z=n_z)

    return fault_space


def _everything(r: Any, A: Any, C: Any, n_v: int) -> Any:
    """Contains every fault column, so that a one-sided distance is zero."""
    return np.eye(len(A) + len(C))


def _basis_assumed(r: Any, A: Any, C: Any, n_v: int) -> Any:
    """F from an A taken for symmetric: right in one basis at the most."""
    return reference.fault_space(r, (A + A.T) / 2, C, n_v)


def _only_n_v(r: Any, A: Any, C: Any, n_v: int) -> Any:
    return reference.fault_space(r, A, C, n_v)[:, :n_v]


def _residual_without_feedthrough(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    return reference.residual(y, u, A, B, C, 0 * D)


def _residual_late(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """x(k+1) used for x(k)."""
    model = StateSpaceModel(A, B, C, D)
    late = np.vstack([model.simulate(u)[1:], np.zeros((1, len(C)))])
    return y - late


def _signal_from_rest(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return reference.reconstruct(r, A, F, C, G, 0 * x0)


# -- structure ---------------------------------------------------------------------------------------------------------------------


def _finite_only(A: Any, F: Any, C: Any, G: Any) -> Structure:
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=[0] * found.normal_rank)


def _inside_only(A: Any, F: Any, C: Any, G: Any) -> Structure:
    found = reference.structure(A, F, C, G)
    return replace(found, finite_zeros=[z for z in found.finite_zeros if abs(z) < 1])


def _columns_counted(A: Any, F: Any, C: Any, G: Any) -> Structure:
    found = reference.structure(A, F, C, G)
    return replace(found, normal_rank=min(F.shape[1], len(C)), left_invertible=F.shape[1] <= len(C))


def _mutant(name: str, wrong: str, caught_by: str, **functions: Callable[..., Any]) -> Mutant:
    return Mutant(name, wrong, caught_by, SimpleNamespace(**functions))


_identify = reference.identify
MUTANTS = [
    _mutant("wrong-transpose", "A transposed", "exact-recovery", identify=_wrong_transpose),
    _mutant("feedthrough-ignored", "D = 0 (published)", "exact-recovery", identify=_without_feedthrough),
    _mutant("interleaved-inputs", "B reshaped by rows, wrong for n_u > 1 (published)", "exact-recovery", identify=_interleaved),
    _mutant(
        "hankel-off-by-one",
        "y(k) paired with u(k+1)",
        "exact-recovery",
        identify=_patched(_identify, (compression, "window_rows", _rows_off_by_one)),
    ),
    _mutant(
        "projection-dropped",
        "future inputs not projected out",
        "exact-recovery",
        identify=_patched(_identify, (Compression, "blocks", _blocks_without_projection)),
    ),
    _mutant(
        "future-as-instruments",
        "future inputs in place of past ones",
        "exact-recovery",
        identify=_patched(_identify, (Compression, "blocks", _blocks_of_the_future)),
    ),
    _mutant(
        "initial-state-ignored",
        "B and D fitted from rest (published)",
        "exact-recovery",
        identify=_patched(_identify, (input_matrices._Regression, "__init__", _from_rest)),
    ),
    _mutant("past-outputs", "PO-MOESP: past outputs as instruments", "consistent-under-coloured-fault", identify=_past_outputs),
    _mutant("order-ignored", "never more than two states (published)", "exact-recovery", identify=_order_ignored),
    _mutant("fixed-resolution", "signals rounded to nine decimals", "other-units", identify=_absolute_scale),
    _mutant("channels-by-size", "outputs sorted, and not back", "permuted-channels", identify=_channels_by_size),
    _mutant("missing-as-zero", "NaN read as zero", "refuses-nan-output", identify=_missing_as_zero),
    _mutant("inputs-modified", "means removed in place (published)", "inputs-untouched", identify=_in_place),
    _mutant("cut-to-fit", "records of unequal lengths cut", "refuses-unequal-lengths", identify=_cut_to_fit),
    _mutant("jittered", "a random perturbation", "deterministic", identify=_jittered),
    _mutant(
        "window-undetermined",
        "a window at the lag goes through",
        "refuses-window-at-the-lag",
        identify=_patched(_identify, (reference, "UNDETERMINED", np.inf)),
    ),
    _mutant("ranks-at-one", "singular values above 1.0 count (published)", "window-ranks-1e-6", window_ranks=_ranks_at(1.0)),
    _mutant("ranks-at-1e-6", "singular values above 1e-6 count", "window-ranks-1e-12", window_ranks=_ranks_at(1e-6)),
    _mutant("count-at-1e-6", "n_v from singular values above 1e-6", "fault-dimension-1e-12", fault_dimension=_count_at(1e-6)),
    _mutant("count-at-one", "n_v from singular values above 1.0 (published)", "fault-dimension-1e-6", fault_dimension=_count_at(1.0)),
    _mutant("count-at-1e-9", "n_v from singular values above 1e-9", "fault-dimension-1e6", fault_dimension=_count_at(1e-9)),
    _mutant("space-at-1e-6", "rank of R_s by the threshold 1e-6", "fault-space-1e-12", fault_space=_space_at(1e-6)),
    _mutant("ranks-at-1e-9", "singular values above 1e-9 count", "window-ranks-1e6", window_ranks=_ranks_at(1e-9)),
    _mutant("ranks-one-short", "window s - 1 for s", "window-ranks", window_ranks=_ranks_one_short),
    _mutant("as-many-as-outputs", "n_v = p (published)", "fault-dimension", fault_dimension=_whole_outputs),
    _mutant("gap-below-the-lag", "rank R_2 - rank R_1", "fault-dimension", fault_dimension=_gap_at_one),
    _mutant("window-of-n", "n block rows where lag + 1 are needed", "fault-space", fault_space=_window_of_n),
    _mutant("space-at-one", "rank of R_s by the threshold 1.0 (published)", "fault-space-1e-6", fault_space=_space_at(1.0)),
    _mutant("space-at-1e-9", "rank of R_s by the threshold 1e-9", "fault-space-1e6", fault_space=_space_at(1e-9)),
    _mutant("everything", "all of R^(n+p), which a one-sided distance likes (published)", "fault-space", fault_space=_everything),
    _mutant("basis-assumed", "A taken for symmetric", "fault-space-other-basis", fault_space=_basis_assumed),
    _mutant("only-n-v", "n_v columns, the zeros' left out", "fault-space", fault_space=_only_n_v),
    _mutant("residual-without-D", "D ignored in the residual", "residual-free-of-input", residual=_residual_without_feedthrough),
    _mutant("residual-late", "x(k+1) used for x(k)", "residual-free-of-input", residual=_residual_late),
    _mutant("signal-from-rest", "x(0) ignored", "fault-signal", reconstruct=_signal_from_rest),
    _mutant("finite-only", "infinite zeros taken for none", "infinite-zeros", structure=_finite_only),
    _mutant("inside-only", "zeros outside the unit circle dropped", "finite-zeros", structure=_inside_only),
    _mutant("columns-counted", "min(m, p) for the normal rank", "normal-rank", structure=_columns_counted),
]
