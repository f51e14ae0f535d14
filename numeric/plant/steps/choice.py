"""The last steps of `identify`: the fault space of what was counted, and one pair (F, G) out of it with its signal.

space_of      the fault space, or why there is none
noise_mix     the mixture of outputs in which the space is sought where healthy samples tell the noise
signals_of    F, G and the signals, or why they are withheld: n_z is undecided, or a signal explains no more than it would of noise
choose_pair   n_v columns (F, G) out of a fault space, whose signal is then reconstructed
largest       the largest |y| of each output
about_own_means   experiments as `count_faults` and the fault space take them, each about its means
beyond_rounding   the residual that faults are counted on, outputs that the model explains to rounding set to zero
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.progress import Progress
from ....base.sheets import counted
from ...data.records import Record
from ...method.model.reduced_model import ReducedModel
from ...method.rows.joint import affordable
from ...method.rows.known_noise import space_in_known_noise, whitening
from ...method.rows.space_by_rows import BEYOND, fault_space_by_rows, identified_fault_space
from ...method.signal.reconstruction import Reconstruction, reconstruct_fault
from ...method.signal.residual_sizes import loudest
from ...method.space.by_ranks import told_fault_space
from ...method.space.estimate import FaultSpaceEstimate
from ..changes.table_rows import FREEZING, LOSS
from ..doubt.listing import named
from ..healthy.healthy_model import noise_share
from .explaining import looked_at, most_moved
from .findings import Counted, CountedBy, Explained, Signal, Signals, Space

ROUNDING = 1e-12  # of the outputs: a residual below it is rounding
MEANS_FROM = 1 << 14  # samples that means and shares are taken of: the regressors of a test are many times as many numbers
PAIRS_TRIED = 6
TRIED_ON = 4000  # samples that a pair is tried on
JOINED = 1e-3  # relative difference of neighbouring pieces of a fault signal from which a note says so
FORETOLD = (
    "the residual foretells a fault from its own past and the inputs, as it does a constant, a ramp, a sine, a sensor that is stuck "
    "or a gain that has changed; such a fault excites too little for its space, which noise would place; what explains a shift of the "
    "mean, and the table of changes, say more"
)
ESTIMATED = (
    "the record has no noise, but what its faults do is told from what its inputs do by chance alone, so that A and C are an estimate, of "
    "unknown error; samples without fault would give them exactly (healthy=K)"
)
FROM_IDENTIFIED = (
    "the fault space takes the identified A and C as exact: their error can turn it, and invent or hide zeros (faultspace monte-carlo "
    "shows how much on systems of the paper's kind)"
)


def space_of(plant: Explained, found: Counted, on_progress: Progress) -> Space:
    """Return the space of all fault columns, on the samples that faults were counted on."""
    model, faults = plant.model, found.count.n_v
    if not faults:
        return Space(None)
    if found.news is not None and found.news < faults:
        return Space(None, (f"no fault space is given: {FORETOLD}",))
    if quiet := _quieter(plant, found):
        lost = (
            f"no fault space is given: {named(quiet)} {'has' if len(quiet) == 1 else 'have'} lost variance since the healthy samples, as "
            "a sensor that is stuck, or whose gain has fallen, does; such a fault is no signal that is added, and its space misleads"
        )
        return Space(None, (lost,))
    on_progress("finding the fault space", 0, 0)
    told = "given" if found.count.by == CountedBy.GIVEN else "counted"
    notes: tuple[str, ...] = ()
    # An exact record gives exact rows, and an exact space where the model is.
    if not plant.exact or isinstance(model, ReducedModel):
        space = _by_laws(plant, found, faults)
        if isinstance(space, FaultSpaceEstimate):
            return Space(replace(space, finding=f"{space.finding}; n_v as {told}"))
        notes = (f"the fault space is from the residual: {space}",)
    try:
        space = told_fault_space(beyond_rounding(plant), model.model.A, model.model.C, n_v=faults, told=told)
    except InvalidData as error:
        return Space(None, (*notes, f"no fault space is given: {error}"))
    if space.method == "likelihood":
        notes += (FROM_IDENTIFIED,)
    if plant.exact and not plant.healthy:
        space = replace(space, decided=False, doubts=(ESTIMATED, *space.doubts), error_bound=None)
    return Space(space, notes)


def _quieter(plant: Explained, found: Counted) -> list[str]:
    """Return the outputs that the table of changes sees to have lost variance, unless a sensor freezes and thaws, which adds signals."""
    seen = [row for changes in found.changes if plant.healthy and changes is not None for row in changes.seen]
    return [] if any(row.kind == FREEZING for row in seen) else sorted({row.channel for row in seen if row.kind == LOSS})


def _by_laws(plant: Explained, found: Counted, faults: int) -> FaultSpaceEstimate | str:
    """Return the space from the laws of outputs and inputs, about their means as they were counted, or the reason why there is none."""
    record, model, laws = plant.record, plant.model, found.laws
    if not affordable(record.p + record.n_u, -(-(model.order + BEYOND) // max(record.p - faults, 1))):
        outputs = f"{counted(record.p, 'output')} with {counted(faults, 'fault')}"
        return f"order {model.order} is too high for the laws of {outputs} and of the inputs"
    data = about_own_means(record.stretches(*plant.held))
    level = plant.noise_level
    if level is None and laws is not None and laws.n_v == faults and laws.noise_power is not None:
        level = np.sqrt(laws.noise_power)
    try:
        mix = noise_mix(plant)
        if isinstance(model, ReducedModel) and mix is not None:
            return space_in_known_noise(*data, model, mix, n_v=faults)
        if isinstance(model, ReducedModel):
            return identified_fault_space(*data, model, n_v=faults, noise_level=level)
        return fault_space_by_rows(*data, model.A, model.C, n_v=faults, noise_level=level)
    except (InvalidData, np.linalg.LinAlgError) as error:
        return str(error)


def noise_mix(plant: Explained) -> Array | None:
    """Return the mixture (p, p) of the outputs that has white noise across them by the healthy samples; None without such samples, and for
    a model of PI-MOESP, of which the space is sought in the outputs themselves."""
    rest = plant.residual
    if not isinstance(plant.model, ReducedModel) or not plant.healthy or rest.fitted or rest.covariance is None:
        return None
    return whitening(rest.covariance)


def signals_of(plant: Explained, count: int | None, space: FaultSpaceEstimate | None, on_progress: Progress) -> Signals:
    """Return the signal of one choice of columns out of the space, over all samples of each experiment, where there is ground for one."""
    if space is None or not count or not space.meaningful or space.n_z < count:
        return no_signals(plant)
    if not space.decided:
        return no_signals(plant, "F, G and the fault signal are withheld: n_z is undecided, see the fault space")
    on_progress("choosing F and G", 0, 0)
    one, model = most_moved(plant), plant.model.model
    part = one.residual.store.read(*loudest(one.sizes.energies, len(one.record), TRIED_ON))
    pair = choose_pair(part, model.A, model.C, space, count)
    each = tuple(_reconstructed(one, *pair, on_progress) for one in plant.experiments)
    return Signals(pair if any(one.reconstruction is not None for one in each) else None, each)


def no_signals(plant: Explained, *notes: str) -> Signals:
    """Return no signal for any experiment."""
    return Signals(None, (Signal(None, None, None, ()),) * len(plant.experiments), notes)


def _reconstructed(plant: Explained, F: Array, G: Array, on_progress: Progress) -> Signal:
    """Return the signal of these columns over all samples, or a note why it is withheld."""
    model, count = plant.model.model, F.shape[1]
    try:
        found = reconstruct_fault(plant.residual.store, model.A, F, model.C, G, within=plant.held, on_progress=on_progress)
    except InvalidData as error:
        return Signal(None, None, None, (f"no fault signal is given: {error}",))
    explained, by_noise = _shares(plant, found, count)
    if explained <= by_noise:
        note = (
            f"F, G and the fault signal are withheld: they explain {100 * explained:.3g} % of the residual, and {count} "
            f"signal{'' if count == 1 else 's'} could explain up to {100 * by_noise:.3g} % of mere noise of its spectra"
        )
        return Signal(None, explained, by_noise, (note,))
    apart = f"the fault signal was found piece by piece, and neighbouring pieces differ by up to {found.mismatch:.2g} of its size"
    return Signal(found, explained, by_noise, (apart,) if found.mismatch > JOINED else ())


def _shares(plant: Explained, signal: Reconstruction, count: int) -> tuple[float, float]:
    """Return what the signal explains of the residual that was counted on, and what so many signals could of noise; outputs in units of the
    healthy residual where there is one, else each in units of its own size."""
    rest, sizes, until = plant.residual, plant.sizes, plant.healthy
    healthy = until is not None and not np.all(sizes.early_peak <= ROUNDING * largest(plant.record))
    units = sizes.early_norm if healthy else np.sqrt(signal.whole)
    units = np.where(units > 0.0, units, 1.0)
    start = max((until or 0) - MEANS_FROM, 0)
    noise = rest.store.read(start, until or 0) if healthy else rest.store.read(*plant.held)
    try:
        return signal.explained(units), noise_share(noise, count, units, healthy=healthy)
    except InvalidData:
        return signal.explained(units), count / plant.record.p


def choose_pair(r: Array, A: Array, C: Array, space: FaultSpaceEstimate, n_v: int) -> tuple[Array, Array]:
    """Return F (n, n_v), G (p, n_v) out of the space: of a few choices the one whose signal explains the residual r best, then the one with
    most samples that no zero disturbs.

    Tried are the directions of largest G, which have the least delay, and general mixes: a special choice of columns may be inequivalent.
    """
    if space.n_z == n_v:
        return space.F, space.G
    right = np.linalg.svd(space.G, full_matrices=True)[2]
    draw = np.random.default_rng(space.n_z)
    mixes = [right[:n_v].T] + [np.linalg.qr(draw.standard_normal((space.n_z, n_v)))[0] for _ in range(PAIRS_TRIED - 1)]
    best: tuple[float, float] | None = None
    chosen = mixes[0]
    for mix in mixes:
        try:
            tried = reconstruct_fault(r, A, space.F @ mix, C, space.G @ mix)
        except InvalidData:  # a mix without any effect
            continue
        first, last = tried.trusted
        score = (-round(float(np.log10(tried.misfit + 1e-12)), 1), float(max(last - first, 0)))
        if best is None or score > best:
            best, chosen = score, mix
    return space.F @ chosen, space.G @ chosen


def largest(record: Record) -> Array:
    """Return the largest |y| of each output, as the record is read."""
    low, high = record.channels.least - record.offset, record.channels.greatest - record.offset
    return np.asarray(np.maximum(np.abs(low), np.abs(high))[record.n_u :])


def about_own_means(experiments: Sequence[tuple[Array, Array]]) -> tuple[Any, Any]:
    """Return y and u of one experiment about their means, or all experiments as a list of pairs, and None."""
    about = [(y - y.mean(axis=0), u - u.mean(axis=0)) for y, u in experiments]
    return about[0] if len(about) == 1 else (about, None)


def beyond_rounding(plant: Explained) -> Array:
    """Return the residual on the samples that are looked at, zero for outputs that the model explains to rounding: beside others that it
    does not explain, their rounding would be scaled up and counted as faults."""
    return np.asarray(plant.residual.store.read(*looked_at(plant)) * (plant.sizes.peak > ROUNDING * largest(plant.record)))
