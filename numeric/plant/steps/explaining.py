"""Set the model beside the record: what it leaves, of all samples and of each experiment.

long_enough    the record without the experiments that are too short for a part in it
explained      the residual of all samples, each experiment from its own state, and the experiments as parts
looked_at      the samples that what cannot go across experiments is asked of; most_moved: the part that they are of
most_held      how many samples faults are counted on
doubt_of_means why a mean of the residual need not be that of the samples before, or nothing: where the inputs rest elsewhere a linear model
               foretells it up to the errors of its static gain, which the tests of means have in their variance; the doubt stays where
               these are not known, where inputs vary more or rest where they have not been, and where the plant is seen to be curved

A part has the healthy samples before its own where some are stated, and model, number of faults and fault space are those of the whole.
One experiment has no parts: it is its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import chain
from typing import TypeVar

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.progress import Progress
from ....base.sheets import counted
from ...data.joining import joined
from ...data.records import Passes, Record, SampleStore, side_by_side
from ...method.model.arx_windows import longest_lag
from ...method.model.moesp_model import MoespModel
from ...method.model.reduced_model import ReducedModel
from ...method.model.residuals import ResidualSignal, growing_modes, residual
from ...method.signal.residual_sizes import ResidualSizes, loudest, residual_sizes
from ...method.space.shift_isolation import gain_errors
from ..doubt.asking import doubts
from ..healthy.unlike_healthy import beyond_healthy_inputs, beyond_healthy_levels
from .findings import Answer, Explained, Measured

Looked = TypeVar("Looked", Explained, Answer)

HELD = 1 << 21  # numbers of residual and inputs that faults are counted on


def long_enough(record: Record, block_rows: int) -> tuple[Record, tuple[str, ...]]:
    """Return the record without the experiments shorter than the lags of an ARX model of the others, or than block_rows samples, with a
    note of them; the record as it is where it is one experiment, or where none is longer."""
    kept = list(record.experiments)
    while len(record.experiments) > 1 and kept:
        least = max(longest_lag([len(one) for one in kept], record.p, record.n_u) + 1, block_rows)
        longer = [one for one in kept if len(one) >= least]
        if longer == kept:
            break
        kept = longer
    short = len(record.experiments) - len(kept)
    if not short or not kept:
        return record, ()
    samples = len(record) - sum(map(len, kept))
    note = (
        f"{short} of {len(record.experiments)} experiments, {counted(samples, 'sample')} in all, are left out: at least {least} samples in "
        "a row are needed for a part in the model"
    )
    return replace(side_by_side(kept), offset=record.offset, clock=record.clock), (note,)


def explained(measured: Measured, found: MoespModel | ReducedModel, exact: bool, block_rows: int, on_progress: Progress) -> Explained:
    """Return what the model leaves of the record, with a part for each experiment where there are several; a healthy record is none."""
    record, healthy = measured.record, measured.healthy
    with np.errstate(over="ignore", invalid="ignore"):  # outliers beyond all numbers are told by what they leave
        rest, each = _residuals(record, found, len(measured.part), on_progress)
    sizes = residual_sizes(rest.store, len(measured.part))
    held, parts = _held(record, sizes, healthy), tuple[Explained, ...]()
    chosen = range(1 if measured.healthy_record else 0, len(record.experiments))
    if len(chosen) > 1:
        parts = tuple(_part(measured, number, rest, each[number], (found, exact, block_rows)) for number in chosen)
        held = _most_varying(record, rest, sizes, held) if healthy else held
    return Explained(
        **vars(measured),
        model=found,
        exact=exact,
        block_rows=block_rows,
        residual=rest,
        sizes=sizes,
        held=held,
        initial_states=tuple(one.x0 for one in each),
        parts=parts,
    )


def _part(
    measured: Measured, number: int, rest: ResidualSignal, own: ResidualSignal, model: tuple[MoespModel | ReducedModel, bool, int]
) -> Explained:
    """Return this experiment with its `own` residual, behind the healthy samples where these came before it."""
    record, healthy = measured.record, measured.healthy
    experiment, store = record.experiments[number], own.store
    apart = healthy is not None and record.bounds[number][0] >= healthy
    if apart and healthy is not None:
        experiment = replace(joined(record.part(0, healthy), experiment), offset=record.offset)
        store = _one_after_the_other(store.width, chain(rest.store.pieces(0, healthy), store.pieces()))
    return Explained(
        replace(experiment, clock=record.clock),
        measured.operating_point,
        healthy,
        apart,
        measured.noise_level,
        *model,
        residual=replace(rest if apart else own, store=store, covariance=rest.covariance),
        sizes=residual_sizes(store, len(record.experiments[number]) if healthy is None else healthy),
        held=(0, len(experiment)),
        initial_states=(own.x0,),
        parts=(),
    )


def most_held(record: Record) -> int:
    """Return how many samples faults are counted on, at most."""
    return HELD // (record.p + record.n_u)


def _held(record: Record, sizes: ResidualSizes, healthy: int | None) -> tuple[int, int]:
    """Return the samples (first, last) to count on: where the residual is largest, or from the end of the healthy ones on."""
    most, known = most_held(record), healthy or 0
    first, last = loudest(sizes.energies, len(record), most)
    return (known, min(known + most, len(record))) if first < known else (first, last)


def _residuals(
    record: Record, found: MoespModel | ReducedModel, modelled: int, on_progress: Progress
) -> tuple[ResidualSignal, tuple[ResidualSignal, ...]]:
    """Return the residual of the whole record, whose first `modelled` samples the model is from, and that of each experiment.

    An experiment begins in the state that goes with the model, where there is one and the model can be run from it: no sample is then
    held. Else the state is fitted to the experiment. The covariance is that of the samples `modelled`, with all parameters that were fitted
    taken off.
    """
    each = []
    for number, (experiment, bounds) in enumerate(zip(record.experiments, record.bounds, strict=True)):
        state = _state(found, number) if bounds[0] < modelled else None
        data = Passes(experiment, "residual", on_progress)
        if state is None or growing_modes(found.model, len(experiment)):
            each.append(residual(data, None, found.model))
        else:
            each.append(residual(data, None, found.model, x0=state))
    first = each[0]
    if len(each) == 1:
        return _with_covariance(first, found, modelled, 1), (first,)
    store = _one_after_the_other(found.model.p, (rows for one in each for rows in one.store.pieces()))
    notes = tuple(dict.fromkeys(note for one in each for note in one.notes))
    several = sum(1 for start, _ in record.bounds if start < modelled)
    return _with_covariance(replace(first, store=store, notes=notes), found, modelled, several), tuple(each)


def _state(found: MoespModel | ReducedModel, number: int) -> Array | None:
    """Return the initial state that goes with the model, None where there is none, or the model lacks that of another experiment."""
    states = found.initial_states
    known = isinstance(found, ReducedModel) or len(states) == 1
    return states[number] if known and number < len(states) and np.all(np.isfinite(states[number])) else None


def _with_covariance(rest: ResidualSignal, found: MoespModel | ReducedModel, modelled: int, experiments: int) -> ResidualSignal:
    """Return the residual with the covariance of the samples that the model is from."""
    model = found.model
    if rest.fitted and experiments == 1:
        return rest
    if isinstance(found, MoespModel) and found.residual_covariance is not None:
        return replace(rest, covariance=found.residual_covariance)
    if isinstance(found, MoespModel) and experiments == 1:
        return rest
    squares = sum((r.T @ r for r in rest.store.pieces(0, modelled)), np.zeros((model.p, model.p)))
    fitted = model.n * (model.p + model.n_u + experiments) + model.p * model.n_u
    return replace(rest, covariance=squares / max(modelled - fitted / model.p, 1.0))


def _one_after_the_other(width: int, pieces: Iterable[Array]) -> SampleStore:
    store = SampleStore(width)
    for rows in pieces:
        store.append(rows)
    return store


def looked_at(plant: Explained | Answer) -> tuple[int, int]:
    """Return the samples (first, last), of those held, of the experiment in which the residual varies most: windows across two experiments
    are none of the system. They are those held where these are of one experiment."""
    if plant.residual is None or plant.sizes is None:
        return plant.held
    return _most_varying(plant.record, plant.residual, plant.sizes, plant.held)


def _most_varying(record: Record, rest: ResidualSignal, sizes: ResidualSizes, held: tuple[int, int]) -> tuple[int, int]:
    first, last = held
    inside = [(max(first, start), min(last, stop)) for start, stop in record.bounds]
    inside = [(start, stop) for start, stop in inside if start < stop]
    if len(inside) < 2:
        return held
    unit = np.where(sizes.norm > 0, sizes.norm, 1.0)
    energies = []
    for start, stop in inside:
        r = rest.store.read(start, stop) / unit
        energies.append(float(np.sum((r - r.mean(axis=0)) ** 2)))
    return inside[int(np.argmax(energies))]


def most_moved(plant: Looked) -> Looked:
    """Return the part of the experiment that is looked at, or the whole where it is one."""
    if not plant.parts:
        return plant
    first = looked_at(plant)[0]
    bounds = plant.record.bounds[1 if plant.healthy_record else 0 :]
    return plant.parts[next(number for number, (start, stop) in enumerate(bounds) if start <= first < stop)]


CURVED = "non-linearity"  # the kind of doubt


def doubt_of_means(plant: Explained, until: int, before: Array, u: Array) -> str:
    """Say why the mean of the residual for inputs u (M, n_u) need not be that for `before` (K, n_u), which are of samples before `until`;
    it is empty where nothing speaks for it."""
    driven = beyond_healthy_inputs(before, u, plant.record.inputs)
    if not driven:
        return ""
    if gain_errors(plant.model) is None:
        return driven
    elsewhere = beyond_healthy_levels(before, u, plant.record.inputs)
    if elsewhere:
        return elsewhere
    try:
        raised = doubts(plant.record.beginning(until), plant.model, means_removed=plant.means_removed)
    except (InvalidData, np.linalg.LinAlgError):  # so few samples that nothing can be asked
        return driven
    if CURVED in raised.unasked or any(row.kind == CURVED for row in raised):
        return f"{driven}, for the plant may be curved"
    return ""
