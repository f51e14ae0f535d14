"""Several experiments in one identification: each has an initial state, a residual and onsets of its own; model and faults are of all.

long_enough              the record without the experiments that are too short for a part in it
residual_by_experiment   the residual of all samples, each experiment from its own state, and these states
with_parts               the Findings with a part for each experiment: its record and its residual
for_each                 a step taken for each part, or for the whole where it is one experiment
completed                the Findings whose parts have what is of all
looked_at                the samples that what cannot go across experiments is asked of; most_moved: the part that they are of

A part has the healthy samples before its own where some are stated, and model, number of faults and fault space are those of the whole.
One experiment has no parts: it is its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ....base.arrays import Array
from ....base.progress import Progress
from ....base.sheets import counted
from ...data.joining import joined
from ...data.records import Passes, Record, SampleStore, side_by_side
from ...method.model.arx_windows import longest_lag
from ...method.model.moesp_model import MoespModel
from ...method.model.reduced_model import ReducedModel
from ...method.model.residuals import ResidualSignal, growing_modes, residual
from ...method.signal.residual_sizes import residual_sizes
from .findings import Findings


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


def residual_by_experiment(
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
    store = SampleStore(found.model.p)
    for one in each:
        for rows in one.store.pieces():
            store.append(rows)
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


def with_parts(answer: Findings, each: tuple[ResidualSignal, ...]) -> Findings:
    """Return the Findings with a part for each experiment, of which `each` is the residual; a healthy record is none of them."""
    record, rest, healthy = answer.record, answer.residual, answer.healthy
    assert rest is not None
    states = tuple(one.x0 for one in each)
    chosen = range(1 if answer.healthy_record else 0, len(record.experiments))
    answer = replace(answer, initial_states=states)
    if len(chosen) < 2:
        return answer
    parts = []
    for number in chosen:
        experiment, start = record.experiments[number], record.bounds[number][0]
        store, early = each[number].store, len(experiment)
        apart = healthy is not None and start >= healthy
        if healthy is not None:
            early = healthy
        if apart and healthy is not None:
            experiment = replace(joined(record.part(0, healthy), experiment), offset=record.offset)
            store = _one_after_the_other(rest.store, healthy, store)
        signal = replace(rest if apart else each[number], store=store, covariance=rest.covariance)
        parts.append(
            replace(
                answer,
                record=replace(experiment, clock=record.clock),
                residual=signal,
                sizes=residual_sizes(store, early),
                held=(0, len(experiment)),
                healthy_record=apart,
                initial_states=(each[number].x0,),
                notes=(),
            )
        )
    return replace(answer, parts=tuple(parts))


def _one_after_the_other(before: SampleStore, until: int, after: SampleStore) -> SampleStore:
    store = SampleStore(before.width)
    for rows in before.pieces(0, until):
        store.append(rows)
    for rows in after.pieces():
        store.append(rows)
    return store


def for_each(answer: Findings, step: Callable[[Findings], Findings]) -> Findings:
    """Return the Findings after a step that each experiment takes by itself."""
    if not answer.parts:
        return step(answer)
    return replace(answer, parts=tuple(step(part) for part in answer.parts))


def looked_at(answer: Findings) -> tuple[int, int]:
    """Return the samples (first, last), of those held, of the experiment in which the residual varies most: windows across two experiments
    are none of the system. They are those held where these are of one experiment."""
    first, last = answer.held
    inside = [(max(first, start), min(last, stop)) for start, stop in answer.record.bounds]
    inside = [(start, stop) for start, stop in inside if start < stop]
    if len(inside) < 2 or answer.residual is None or answer.sizes is None:
        return answer.held
    unit = np.where(answer.sizes.norm > 0, answer.sizes.norm, 1.0)
    energies = []
    for start, stop in inside:
        r = answer.residual.store.read(start, stop) / unit
        energies.append(float(np.sum((r - r.mean(axis=0)) ** 2)))
    return inside[int(np.argmax(energies))]


def most_moved(answer: Findings) -> Findings:
    """Return the part of the experiment that is looked at, or the whole where it is one."""
    if not answer.parts:
        return answer
    first = looked_at(answer)[0]
    bounds = answer.record.bounds[1 if answer.healthy_record else 0 :]
    return answer.parts[next(number for number, (start, stop) in enumerate(bounds) if start <= first < stop)]


def completed(answer: Findings) -> Findings:
    """Return the Findings whose parts have the number of faults and the fault space of the whole beside what is their own."""
    own = ("record", "residual", "sizes", "held", "healthy_record", "initial_states", "onset", "changes", "parts")
    parts = tuple(
        replace(answer, mean=None, notes=answer.notes + part.notes, **{name: getattr(part, name) for name in own}) for part in answer.parts
    )
    return replace(answer, parts=parts)
