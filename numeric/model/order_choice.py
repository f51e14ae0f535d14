"""Orders 0, 1, 2, .. tried on one record, with the evidence for each.

The first part of every experiment makes models that are then tried on the part held back; the windows of both parts together, which share
`lags` samples at the cut, are those of the whole record, on which the criteria are computed. Orders are tried until PATIENCE in a row have
not bettered the second of them: a lightly damped resonance takes two states, two of them four.

order_tried     the evidence, and the model of the best order
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData
from .arx import Arx, fitted_arx
from .arx_windows import ArxWindows, about_zero, arx_windows, joined_windows, merge_windows
from .compression import Pieces
from .order_evidence import OrderEvidence, OrderRow, weighed
from .reduced_model import ReducedModel, judged, reduced, reduced_from
from .reduction_starts import hankel_factors
from .residuals import residual

KEPT_BACK = 3  # one part in so many is held back
MOST_HELD = 1 << 15  # samples of an experiment that are held back at most: they stand in memory
PATIENCE = 4


def order_tried(sources: Sequence[Pieces], lengths: Sequence[int], lags: int, offset: bool) -> tuple[OrderEvidence, ReducedModel]:
    """Return the evidence over orders and the model of the best, from experiments of these lengths. InvalidData as `arx_reduction`."""
    cuts = [max(length - length // KEPT_BACK, length - MOST_HELD) for length in lengths]
    first = [arx_windows(_part(source, 0, cut), lags) for source, cut in zip(sources, cuts, strict=True)]
    rest = [arx_windows(_part(source, max(cut - lags, 0), None), lags) for source, cut in zip(sources, cuts, strict=True)]
    both = [joined_windows(*parts) for parts in zip(first, rest, strict=True)]
    training, whole = (merge_windows(parts if offset else [about_zero(part) for part in parts]) for parts in (first, both))
    held = [_joined(_part(source, cut, None)) for source, cut in zip(sources, cuts, strict=True)]
    arx = fitted_arx(whole)
    gaps = _gaps(arx, max(lags, 1))
    rows: list[OrderRow] = []
    models: list[ReducedModel] = []
    best, since = np.inf, 0
    for n in range(whole.lags * whole.p + 1):
        try:
            found = reduced_from(whole, arx if arx.order * whole.p >= n else fitted_arx(whole, -(-n // whole.p)), n)
        except InvalidData:
            if not rows:
                raise
            break
        parameters = n * (whole.p + whole.n_u) + whole.p * whole.n_u
        one_step, free_run = _fits(training, held, n)
        gap = float(gaps[n - 1]) if 0 < n <= len(gaps) else float("nan")
        row = OrderRow(n, found.cost, parameters, float(found.cost + parameters * np.log(whole.rows)), 0.0, one_step, free_run, gap)
        rows.append(row)
        models.append(found)
        best, since = (row.akaike, 0) if row.akaike < best else (best, since + 1)
        if since == PATIENCE:
            break
    evidence = weighed(rows)
    # Orders too low may look like an unstable plant: only the choice is judged.
    return evidence, judged(models[evidence.best], whole)


def _part(source: Pieces, first: int, last: int | None) -> Iterator[tuple[Array, Array]]:
    """Samples first .. last - 1 of an experiment."""
    at = 0
    for y, u in source:
        chosen = slice(max(first - at, 0), None if last is None else max(last - at, 0))
        at += len(y)
        yield y[chosen], u[chosen]


def _joined(data: Iterator[tuple[Array, Array]]) -> tuple[Array, Array]:
    y, u = (np.concatenate(parts) for parts in zip(*data, strict=True))
    return y, u


def _gaps(arx: Arx, rows: int) -> Array:
    values = hankel_factors(arx, rows, weighted=True)[2]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios: Array = values[:-1] / values[1:]
    return ratios


def _fits(training: ArxWindows, held: Sequence[tuple[Array, Array]], n: int) -> tuple[float, float]:
    """One-step and free-run fit, on the samples held back, of the model of the first part; NaN where it is too short."""
    try:
        found = reduced(training, n)
        free = [residual(y - mean, u, found.model).r for (y, u), mean in zip(held, found.offsets, strict=True)]
    except InvalidData:
        return float("nan"), float("nan")
    scale = training.scales[0]
    h = found.arx.order
    power = sum(float(np.sum(((y - mean)[h:] / scale) ** 2)) for (y, _), mean in zip(held, found.offsets, strict=True))
    errors = [sum(r[h - i : len(r) - i] @ found.arx.outputs[i].T for i in range(h + 1)) for r in free]
    sizes = [np.sqrt(sum(float(np.sum((part / scale) ** 2)) for part in parts) / power) for parts in (errors, [r[h:] for r in free])]
    return float(1 - sizes[0]), float(1 - sizes[1])
