"""Every kind of trouble catches the carelessness that it is made for: the reference, careless in that one way, fails on its vector."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.checks.trouble import of_trouble
from faultspace.numeric.audit.making.kinds_of_trouble import KINDS
from faultspace.numeric.audit.subjects.opening import InProcess
from faultspace.numeric.audit.vectors.trouble import default_troubles
from tests.numeric.audit.unseen.catalogue import BY_NAME

Functions = dict[str, Callable[..., Any]]


def _kept(keep: Callable[[complex], bool]) -> Functions:
    """The finite zeros of which this holds."""

    def structure(*system: Any) -> Any:
        found = reference.structure(*system)
        return replace(found, finite_zeros=[z for z in found.finite_zeros if keep(z)])

    return {"structure": structure}


def _without_poles(A: Any, F: Any, C: Any, G: Any) -> Any:
    """Zeros at poles are taken for cancelled."""
    found, poles = reference.structure(A, F, C, G), np.linalg.eigvals(A)
    return replace(found, finite_zeros=[z for z in found.finite_zeros if np.min(np.abs(poles - z)) > 1e-6])


def _zeros(change: Callable[[list[complex]], list[complex]]) -> Functions:
    def structure(*system: Any) -> Any:
        found = reference.structure(*system)
        return replace(found, finite_zeros=change(list(found.finite_zeros)))

    return {"structure": structure}


def _once(zeros: list[complex]) -> list[complex]:
    return list({complex(np.round(z, 4)): z for z in zeros}.values())


def _rank_at(z: float) -> Functions:
    """The rank of the pencil at a single point."""

    def structure(A: Any, F: Any, C: Any, G: Any) -> Any:
        n = len(A)
        rank = int(np.linalg.matrix_rank(np.block([[z * np.eye(n) - A, -F], [C, G]]), tol=1e-9)) - n
        return replace(reference.structure(A, F, C, G), normal_rank=rank)

    return {"structure": structure}


def _square_is_regular(A: Any, F: Any, C: Any, G: Any) -> Any:
    return replace(reference.structure(A, F, C, G), normal_rank=min(G.shape), left_invertible=True)


def _orders(*system: Any) -> Any:
    found = reference.structure(*system)
    return replace(found, infinite_zero_orders=[0] * found.normal_rank)


def _largest_pole(A: Any, F: Any, C: Any, G: Any) -> Any:
    assert np.max(np.abs(np.linalg.eigvals(A))) >= 0  # of no pole at all there is no largest
    return reference.structure(A, F, C, G)


def _model(change: Callable[..., Any]) -> Functions:
    return {"identify": lambda y, u, order, block_rows: change(*reference.identify(y, u, order, block_rows))}


def _stabilised(A: Any, B: Any, C: Any, D: Any) -> Any:
    return A / max(1.0, float(np.max(np.abs(np.linalg.eigvals(A))))), B, C, D


def _invertible(A: Any, B: Any, C: Any, D: Any) -> Any:
    if np.linalg.cond(A) > 1e8:
        raise ValueError("A cannot be inverted")
    return A, B, C, D


def _modal(A: Any, B: Any, C: Any, D: Any) -> Any:
    """Real parts of the modal form."""
    values, vectors = np.linalg.eig(A)
    return np.diag(values.real), np.linalg.solve(vectors, B).real, (C @ vectors).real, D


def _diagonal(A: Any, B: Any, C: Any, D: Any) -> Any:
    """The modal form with equal poles made equal: what ties the states of a chain is lost."""
    values, vectors = np.linalg.eig(A)
    return np.diag(np.round(values, 4).real), np.linalg.solve(vectors, B).real, (C @ vectors).real, D


def _same_poles_once(A: Any, B: Any, C: Any, D: Any) -> Any:
    values, vectors = np.linalg.eig(A)
    _, kept = np.unique(np.round(values, 4), return_index=True)
    return np.diag(values[kept].real), np.linalg.solve(vectors, B).real[kept], (C @ vectors).real[:, kept], D


def _centred(y: Any, u: Any, order: int, block_rows: int) -> Any:
    return reference.identify(y - y.mean(axis=0), u - u.mean(axis=0), order, block_rows)


def _at_most_ten(y: Any, u: Any, order: int, block_rows: int) -> Any:
    return reference.identify(y, u, min(order, 10), block_rows)


def _space_of_what_is_seen(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    return reference.fault_space(r, A, np.where(np.abs(C) < 1e-2, 0.0, C), n_v, block_rows)


def _steps(r: Any, windows: int) -> list[int]:
    ranks = [0, *reference.window_ranks(r, windows)]
    return [b - a for a, b in pairwise(ranks)]


def _seven_windows(r: Any) -> int:
    return _steps(r, 7)[-1]


def _first_that_stays(r: Any) -> int:
    steps = _steps(r, 9)
    return next(a for a, b in pairwise(steps[1:]) if a == b)


def _coarse(r: Any) -> int:
    """Singular values above a thousandth count."""
    H = [np.hstack([r[i : len(r) - s + 1 + i] for i in range(s)]) for s in (5, 6)]
    values = [np.linalg.svd(one, compute_uv=False) for one in H]
    ranks = [int(np.sum(one > 1e-3 * one[0])) for one in values]
    return ranks[1] - ranks[0]


def _ranks(change: Callable[[Any, list[int]], list[int]]) -> Functions:
    return {"window_ranks": lambda r, windows: change(r, list(reference.window_ranks(r, windows)))}


def _blind_to_small_entries(*system: Any) -> Any:
    return reference.structure(*(np.where(np.abs(M) < 1e-9, 0.0, M) for M in system))


def _relative_degrees(A: Any, F: Any, C: Any, G: Any) -> Any:
    """When each fault is seen first, though they may be seen alike."""
    found, orders = reference.structure(A, F, C, G), []
    for j in range(F.shape[1]):
        pulses = [G[:, j], *(C @ np.linalg.matrix_power(A, k) @ F[:, j] for k in range(len(A)))]
        orders.append(next((k for k, one in enumerate(pulses) if np.any(one)), len(A)))
    return replace(found, infinite_zero_orders=sorted(orders))


def _needs_a_fault(A: Any, F: Any, C: Any, G: Any) -> Any:
    found = reference.structure(A, F, C, G)
    return found if np.any(F) or np.any(G) else replace(found, finite_zeros=[])


def _large_determinants(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    return reference.reconstruct(r, A, F, C, G if abs(np.linalg.det(G)) > 1e-8 else 0 * G, x0)


def _first_hundred(r: Any) -> Any:
    """Who sees no fault in a hundred samples says that there is none."""
    return reference.fault_dimension(r[:100]) or 0


def _without_outliers(r: Any, *system: Any) -> Any:
    v = reference.reconstruct(r, *system)
    most = 6 * np.std(v, axis=0)
    return np.clip(v, -most, most)


def _finite_memory(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Poles on the unit circle are taken for slow ones inside."""
    return reference.residual(y, u, A / max(1.0, float(np.max(np.abs(np.linalg.eigvals(A)))) / 0.98), B, C, D)


def _unseen(name: str) -> Functions:
    """One of the mutants whose writer had not seen the kinds, and for which this one was made."""
    return vars(BY_NAME[name].adapter)


CARELESS: dict[str, Functions] = {
    "zeros-none": _zeros(lambda zeros: [*zeros, 0j]),
    "zeros-complex": _kept(lambda z: z.imag >= 0),
    "zeros-repeated": _zeros(_once),
    "zeros-repeated-apart": _zeros(_once),
    "zeros-at-0": _kept(lambda z: abs(z) > 1e-8),
    "zeros-at-1": _kept(lambda z: abs(z - 1) > 1e-8),
    "zeros-on-the-circle": _kept(lambda z: abs(abs(z) - 1) > 1e-8),
    "zeros-outside": _kept(lambda z: abs(z) < 1),
    "zeros-large": _kept(lambda z: abs(z) < 100),
    "zeros-uncontrollable": {"structure": _without_poles},
    "zeros-unobservable": {"structure": _without_poles},
    "zeros-at-infinity": {"structure": _orders},
    "square-complex": _zeros(lambda zeros: [complex(z.real) for z in zeros]),
    "square-repeated": _zeros(_once),
    "rank-drops-at-0": _rank_at(0.0),
    "rank-drops-at-1": _rank_at(1.0),
    "rank-drops-at-0-and-1": _rank_at(1.0),
    "rank-deficient": {"structure": _square_is_regular},
    "poles-unstable": _model(_stabilised),
    "poles-unstable-pair": _model(_stabilised),
    "poles-at-0": _model(_invertible),
    "poles-at-1": {"identify": _centred},
    "poles-nilpotent": _model(_invertible),
    "poles-defective": _model(_diagonal),
    "poles-repeated": _model(_same_poles_once),
    "poles-complex": _model(_modal),
    "poles-nearly-unobservable": {"fault_space": _space_of_what_is_seen},
    "order-12": {"identify": _at_most_ten},
    "six-by-six": {"window_ranks": lambda r, windows: reference.window_ranks(r[:, :5], windows)},
    "five-of-six": {"fault_dimension": lambda r: min(reference.fault_dimension(r) or 0, 4)},
    "square-D": _model(lambda A, B, C, D: (A, B, C, 0 * D)),
    "more-faults-than-outputs": {"structure": _square_is_regular},
    "small-D": _model(lambda A, B, C, D: (A, B, C, np.round(D, 2))),
    "large-D": _model(lambda A, B, C, D: (A, B, C, np.clip(D, -100, 100))),
    "no-fault": _ranks(lambda r, ranks: [max(rank, s + r.shape[1]) for s, rank in enumerate(ranks)]),
    "no-fault-in-one-output": _unseen("window-ranks-takes-one-output-for-full-rank"),
    "pure-noise": _ranks(lambda r, ranks: [min(rank, (r.shape[1] - 1) * s + 1) for s, rank in enumerate(ranks, start=1)]),
    "order-0": {"structure": _largest_pole},
    "delays": {"structure": _orders},
    "long-lag": {"fault_dimension": _seven_windows},
    "one-long-among-short": {"fault_dimension": _first_that_stays},
    "nearly-parallel-faults": {"fault_dimension": _coarse},
    "whole-numbers": _model(lambda *model: tuple(part.astype(np.float32) for part in model)),
    "whole-numbers-that-add-up": {"residual": _finite_memory},
    "zeros-beyond-a-thousand": _kept(lambda z: abs(z) < 1e3),
    "zeros-ten": _zeros(lambda zeros: zeros[:8]),
    "orders-one-and-three": {"structure": _relative_degrees},
    "small-units": {"structure": _blind_to_small_entries},
    "silent-mode": {"structure": _needs_a_fault},
    "small-columns": {"reconstruct": _large_determinants},
    "order-1": _model(lambda A, B, C, D: (A, B, C, -D)),
    "fault-begins-late": {"fault_dimension": _first_hundred},
    "fault-with-a-spike": {"reconstruct": _without_outliers},
    "zeros-close": _unseen("structure-merges-close-zeros"),
    "faults-in-unlike-units": _unseen("reconstruct-takes-small-columns-for-none"),
    "outputs-in-unlike-units": _unseen("structure-balances-by-the-largest-output"),
    "inputs-about-a-mean": _unseen("identify-removes-an-operating-point-where-there-seems-to-be-one"),
    "inputs-in-unlike-units": _unseen("identify-calls-a-small-input-silent"),
    "poles-of-no-short-fraction": _unseen("identify-rounds-the-trace"),
}


def test_every_kind_has_its_carelessness() -> None:
    assert set(CARELESS) == {kind.slug for kind in KINDS}


@pytest.mark.parametrize(
    "trouble", [pytest.param(one, id=one.kind, marks=[pytest.mark.mutants] * (i % 6 > 0)) for i, one in enumerate(default_troubles())]
)
def test_the_careless_fail_where_the_reference_passes(trouble: Any) -> None:
    careless = InProcess(SimpleNamespace(**CARELESS[trouble.kind]))
    checks = [one for one in of_trouble(trouble) if one.function in careless.functions]
    assert checks and any(careless.perform(one).failed for one in checks)
    right = InProcess(reference)
    assert not any(right.perform(one).failed for one in checks)
