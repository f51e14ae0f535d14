"""Estimate A, B, C, D under strong coloured faults as well as the data allow: ARX of high order, then its weighted reduction to order n.

1  One factor of the record's windows (`arx_windows`): the length of the record enters once, pieces and experiments merge.
2  An ARX model of high order and the input's spectrum from it (`arx`): plant G_h, inverse spectrum W of faults and noise together.
3  The model of order n nearest to G_h under W and the input's spectrum (`weighted_reduction`), from several starts, up a ladder of weights.

PI-MOESP uses past inputs as instruments and says nothing about the colour of what disturbs. On simulated records of 1000 samples its median
errors are 1.2 to 3.6 times the Cramer-Rao bound of a known disturbance spectrum, those that remain here 0.9 to 1.1 times; such estimates
are efficient for long records [W89]. `python benchmarks/at_the_bound.py` measures it. Nothing is random: equal data give equal models.

What must hold: u and the faults uncorrelated (open loop), a stable model, u that excites lags + 1 samples beside its mean. The colour of u
does not matter otherwise. Feedback is tested for, and noted (`feedback`): with a delay in the loop the model stays consistent.

Offsets. A constant stands among the regressors unless `offset=False`, one for each experiment. The zero of a sensor, an operating point and
the mean of a fault all add a constant to the outputs, and a fault may be any signal: that its mean is zero is nothing that data could show.
The price is p parameters, and that the mean of u tells nothing of the gain any more: a constant excites only where it is known what the
outputs would be without it. For the same reason a constant fault is part of the offset. Where zero is known to be zero, and no fault has a
mean, `offset=False` lets the means excite; with a mean of the faults its gain at frequency zero is then wrong.

arx_reduction              from y and u: arrays, or pieces that can be read more than once
arx_reduction_experiments  from several experiments
lengths_and_lags           how many lags experiments carry
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.records import Record
from ...data.validation import experiment, positive
from .arx_windows import about_zero, arx_windows, longest_lag, merge_windows
from .compression import EPS, Pieces
from .feedback import FEEDBACK_LEVEL, HEARD, feedback_chance
from .models import StateSpaceModel
from .order_choice import order_tried
from .reduced_model import ReducedModel, reduced
from .residuals import residual
from .weighted_reduction import spectral_radius

MOST_FREE = 1 << 16  # samples from which an initial state is fitted at most: they stand in memory


@one_thread()
def arx_reduction(
    y: ArrayLike | Iterable[tuple[ArrayLike, ArrayLike]],
    u: ArrayLike | None = None,
    *,
    order: int | None = None,
    lags: int | None = None,
    offset: bool = True,
) -> ReducedModel:
    """Estimate the stable model of order n from one experiment with coloured faults, by ARX and weighted reduction [W89].

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
        In any units, not modified; without `u`, `y` gives the consecutive pieces (y, u) anew at each `iter`, as a list or a record does.
    order : int, optional
        n >= 0; else the best of those tried, for which `orders` of the result has the evidence.
    lags : int, optional
        Bound on the order of the ARX model, about 1.6 N^(1/3) by default.
    offset : bool
        Whether a constant is fitted, which changes `offsets` of the result alone; without is right where neither sensors nor faults have a
        mean of their own.

    Returns
    -------
    ReducedModel
        `model` with its standard errors, `uncertainty`.

    Raises
    ------
    InvalidData
        Too few samples, an input that does not excite lags + 1 samples (beside a constant, where one is fitted), an unstable plant, NaN.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import arx_reduction
    >>> u = np.random.default_rng(1).standard_normal((300, 1))
    >>> y = np.zeros((300, 1))
    >>> for k in range(299):
    ...     y[k + 1] = 0.5 * y[k] + u[k]
    >>> found = arx_reduction(y, u, order=1)
    >>> found.model.A.round(6).tolist(), found.model.markov(4).ravel()[1:].round(6).tolist()
    ([[0.5]], [1.0, 0.5, 0.25])
    >>> again = arx_reduction(y + 70, u, order=1)
    >>> again.model.A.round(6).tolist(), again.offset.round(6).tolist()
    ([[0.5]], [70.0])
    """
    return _from_experiments([experiment(y, u)], order, lags, offset)


@one_thread()
def arx_reduction_experiments(
    experiments: Sequence[tuple[ArrayLike | Pieces, ArrayLike | None] | Record],
    *,
    order: int | None = None,
    lags: int | None = None,
    offset: bool = True,
) -> ReducedModel:
    """Estimate one model from several experiments (y, u) with the same channels and units [W89].

    Each has a length, an initial state and an offset of its own: their operating points may differ. Experiments no longer than the lags
    have no part in the model; their offset and state are NaN, and a note tells how many there are.

    Parameters
    ----------
    experiments : list of (y, u), or of Record
        y has the shape (N_i, p) and u (N_i, n_u), or y is pieces and u None; `read_stretches` gives records.
    order, lags, offset
        As of `arx_reduction`.

    Returns
    -------
    ReducedModel
        As of `arx_reduction`.

    Raises
    ------
    InvalidData
        As `arx_reduction`, and where no experiment is given.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, arx_reduction_experiments
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]])
    >>> inputs = np.split(np.random.default_rng(1).standard_normal((300, 1)), [100])
    >>> arx_reduction_experiments([(model.simulate(u), u) for u in inputs], order=1).model.A.round(6).tolist()
    [[0.5]]
    """
    if len(experiments) == 0:
        raise InvalidData("no experiment: give at least one pair (y, u)")
    sources = [experiment(one, None) if isinstance(one, Record) else experiment(*one) for one in experiments]
    return _from_experiments(sources, order, lags, offset)


def _from_experiments(sources: Sequence[Pieces], order: int | None, lags: int | None, offset: bool) -> ReducedModel:
    found, carried = reduction(sources, order, lags, offset)
    return replace(found, notes=found.notes + _feedback(sources, found, carried))


def reduction(sources: Sequence[Pieces], order: int | None, lags: int | None, offset: bool) -> tuple[ReducedModel, int]:
    """Return the model of some experiments and its lags, without asking whether the inputs follow the outputs."""
    n = order if order is None or (order == 0 and not isinstance(order, bool)) else positive(order, "order")
    if not isinstance(offset, bool | np.bool_):
        raise InvalidData(f"offset: got {shorten(offset)}; True or False is needed")
    lengths, carried = lengths_and_lags(sources, n or 0, lags)
    if n is None:
        evidence, found = order_tried(sources, lengths, carried, bool(offset))
        notes = found.notes
        if not evidence.decided:
            notes += (f"the data leave orders {evidence.least} to {evidence.most} open; the model has {evidence.best}",)
        found = replace(found, orders=evidence, notes=notes)
    else:
        parts = [arx_windows(source, carried) for source in sources]
        found = reduced(merge_windows(parts if offset else [about_zero(part) for part in parts]), n)
    used = [length > carried for length in lengths]
    unknown = np.full(found.model.p, np.nan)
    offsets = tuple(mean if known else unknown for mean, known in zip(found.offsets, used, strict=True))
    states = tuple(
        _initial_state(source, found, mean) if known else np.full(found.order, np.nan)
        for source, mean, known in zip(sources, offsets, used, strict=True)
    )
    notes = found.notes
    if not all(used):
        notes += (
            f"{used.count(False)} of {len(used)} experiments are too short for a part in the model, which takes {carried + 1} samples",
        )
    return replace(found, offsets=offsets, initial_states=states, notes=notes), carried


def _feedback(sources: Sequence[Pieces], found: ReducedModel, lags: int) -> tuple[str, ...]:
    """Say where the input follows earlier outputs."""
    chance = feedback_chance([_beginning(source, HEARD) for source in sources], found.arx, lags)
    if chance >= FEEDBACK_LEVEL:
        return ()
    return (
        f"u follows what disturbed y before (a chance of {chance:.2g} in open loop): in a closed loop the standard errors are too small, "
        "and D is wrong where the loop has no delay",
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
    if carried < least and lags is not None:
        raise InvalidData(f"lags: got {lags}; order {n} with {counted(p, 'output')} needs {least} or more: pass more lags")
    if carried < least:
        raise InvalidData(
            f"{counted(sum(lengths), 'sample')} of {counted(p, 'output')} and {counted(n_u, 'input')} carry "
            f"{counted(max(carried, 0), 'lag')}, order {n} needs {least} or more: record more"
        )
    return lengths, carried


def _initial_state(source: Pieces, found: ReducedModel, offset: Array) -> Array:
    """Estimate the initial state by least squares over the samples in which it can be seen, each output in units of its disturbance."""
    model = found.model
    radius = min(spectral_radius(model.A), 1.0)
    left = MOST_FREE if radius == 1 else model.n + (int(min(np.log(EPS) / np.log(radius), MOST_FREE)) if radius > 0 else 0) + 1
    y, u = _beginning(source, left)
    y = y - offset
    # Of least squares in units of y the loudest output alone would have a say; where there is no disturbance, rounding stands for it.
    unit = np.maximum(np.sqrt(np.diag(found.arx.covariance)), EPS * np.abs(y).max(axis=0))
    unit = np.where(unit > 0.0, unit, 1.0)
    return residual(y / unit, u, StateSpaceModel(model.A, model.B, model.C / unit[:, None], model.D / unit[:, None])).x0


def _beginning(source: Pieces, samples: int) -> tuple[Array, Array]:
    """Return the first samples of an experiment, so many at most."""
    pieces: list[tuple[Array, Array]] = []
    for y, u in source:
        pieces.append((y[:samples], u[:samples]))
        samples -= len(y)
        if samples <= 0:
            break
    y, u = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    return y, u
