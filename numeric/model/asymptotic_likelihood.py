"""Estimate A, B, C, D under strong coloured faults as well as the data allow: ARX of high order, then its weighted reduction to order n.

1  One factor of the record's windows (`arx_windows`): the length of the record enters once, pieces and experiments merge.
2  An ARX model of high order and the input's spectrum from it (`arx`): plant G_h, inverse spectrum W of faults and noise together.
3  The model of order n nearest to G_h under W and the input's spectrum (`weighted_reduction`), from several starts, up a ladder of weights.

PI-MOESP uses past inputs as instruments and says nothing about the colour of what disturbs. On simulated records of 1000 samples its median
errors are 1.3 to 3.6 times the Cramer-Rao bound of a known disturbance spectrum, those that remain here 0.8 to 1.1 times; such estimates
are efficient for long records [W89]. `python benchmarks/at_the_bound.py` measures it. Nothing is random: equal data give equal models.

What must hold: u and the faults uncorrelated (open loop), a stable model without offsets (subtract means first), u that excites lags + 1
samples. The colour of u does not matter otherwise.

arx_reduction              from y and u: arrays, or pieces that can be read more than once
arx_reduction_experiments  from several experiments
lengths_and_lags           how many lags experiments carry
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.threads import one_thread
from ..data.validation import experiment, positive
from .arx_windows import arx_windows, longest_lag, merge_windows
from .compression import EPS, Pieces
from .models import StateSpaceModel
from .order_choice import order_tried
from .reduced_model import ReducedModel, reduced
from .residuals import residual
from .weighted_reduction import spectral_radius

MOST_FREE = 1 << 16  # samples from which an initial state is fitted at most: they stand in memory


@one_thread()
def arx_reduction(
    y: ArrayLike | Iterable[tuple[ArrayLike, ArrayLike]], u: ArrayLike | None = None, *, order: int | None = None, lags: int | None = None
) -> ReducedModel:
    """Estimate the stable model of order n from one experiment with coloured faults, by ARX and weighted reduction [W89].

    y (N, p) and u (N, n_u) are arrays in any units, and are not modified; without u, y gives the consecutive pieces (y, u) of the
    experiment anew at each `iter`, as a list or a record does. Means are not taken off. `order` is n >= 0; where it is not given, orders
    are tried, `orders` of the result has the evidence for each, and the model is that of the best. `lags` bounds the order of the ARX
    model, about 1.6 N^(1/3) where it is not given. Raises InvalidData where the data cannot give a model: too few samples, an input that
    does not excite lags + 1 samples, an unstable plant, NaN.

    >>> import numpy as np
    >>> from faultspace.numeric import arx_reduction
    >>> u = np.random.default_rng(1).standard_normal((300, 1))
    >>> y = np.zeros((300, 1))
    >>> for k in range(299):
    ...     y[k + 1] = 0.5 * y[k] + u[k]
    >>> found = arx_reduction(y, u, order=1)
    >>> found.model.A.round(6).tolist(), found.model.markov(4).ravel()[1:].round(6).tolist()
    ([[0.5]], [1.0, 0.5, 0.25])
    """
    return _from_experiments([experiment(y, u)], order, lags)


@one_thread()
def arx_reduction_experiments(
    experiments: Sequence[tuple[ArrayLike, ArrayLike]], *, order: int | None = None, lags: int | None = None
) -> ReducedModel:
    """Estimate one model from several experiments (y, u) with the same channels and units, each with an own initial state and length [W89].

    `experiments` is a list of pairs, y with the shape (N_i, p) and u with (N_i, n_u); the other arguments and the result are those of
    `arx_reduction`. Raises InvalidData as there, and where no experiment is given.

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, arx_reduction_experiments
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]])
    >>> inputs = np.split(np.random.default_rng(1).standard_normal((300, 1)), [100])
    >>> arx_reduction_experiments([(model.simulate(u), u) for u in inputs], order=1).model.A.round(6).tolist()
    [[0.5]]
    """
    if len(experiments) == 0:
        raise InvalidData("no experiment: give at least one pair (y, u)")
    return _from_experiments([experiment(y, u) for y, u in experiments], order, lags)


def _from_experiments(sources: Sequence[Pieces], order: int | None, lags: int | None) -> ReducedModel:
    n = order if order is None or (order == 0 and not isinstance(order, bool)) else positive(order, "order")
    lengths, carried = lengths_and_lags(sources, n or 0, lags)
    if n is None:
        evidence, found = order_tried(sources, lengths, carried)
        notes = found.notes
        if not evidence.decided:
            notes += (f"the data leave orders {evidence.least} to {evidence.most} open; the model has {evidence.best}",)
        found = replace(found, orders=evidence, notes=notes)
    else:
        found = reduced(merge_windows([arx_windows(source, carried) for source in sources]), n)
    notes = found.notes + _offsets(sources)
    return replace(found, initial_states=tuple(_initial_state(source, found.model) for source in sources), notes=notes)


def _offsets(sources: Sequence[Pieces]) -> tuple[str, ...]:
    """Say which outputs are an offset for the most part: their mean has more power than what varies, and the model does not fit it."""
    samples, first, second = 0, np.zeros(1), np.zeros(1)
    for source in sources:
        for y, _ in source:
            samples, first, second = samples + len(y), first + y.sum(axis=0), second + (y * y).sum(axis=0)
    mean = first / samples
    large = np.flatnonzero(2 * mean**2 > second / samples)
    if not large.size:
        return ()
    names = ", ".join(str(channel) for channel in large)
    return (
        f"outputs {names} (from 0) have a mean larger than their deviation, which the model does not fit: subtract the means of y and u",
    )


def lengths_and_lags(sources: Sequence[Pieces], n: int, lags: int | None) -> tuple[list[int], int]:
    """Return the samples of each experiment and the lags, given or carried. Raises InvalidData where these are too few for order n."""
    shapes = [[(len(y), y.shape[1], u.shape[1]) for y, u in source] for source in sources]
    if not all(shapes):
        raise InvalidData("no data: an experiment has no samples")
    lengths = [sum(piece[0] for piece in pieces) for pieces in shapes]
    p, n_u = shapes[0][0][1:]
    carried = longest_lag(lengths, p, n_u) if lags is None else positive(lags, "lags")
    least = max(1, -(-n // p)) if n else 0
    if carried < least:
        raise InvalidData(
            f"{sum(lengths)} samples of {p} outputs and {n_u} inputs carry {max(carried, 0)} lags, order {n} needs {least} or more: record "
            "more" + ("" if lags is None else ", or pass more lags")
        )
    return lengths, carried


def _initial_state(source: Pieces, model: StateSpaceModel) -> Array:
    """Estimate the initial state by least squares over the samples in which it can be seen."""
    radius = min(spectral_radius(model.A), 1.0)
    left = MOST_FREE if radius == 1 else model.n + (int(min(np.log(EPS) / np.log(radius), MOST_FREE)) if radius > 0 else 0) + 1
    pieces: list[tuple[Array, Array]] = []
    for y, u in source:
        pieces.append((y[:left], u[:left]))
        left -= len(y)
        if left <= 0:
            break
    y, u = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    return residual(y, u, model).x0
