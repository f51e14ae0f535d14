"""The last steps of `faultspace identify`: the fault space of what was counted, and one pair (F, G) out of it with its signal.

with_space    the Findings with the fault space
noise_mix     the mixture of outputs in which the space is sought where healthy samples tell the noise
with_signal   the Findings with F, G and the signal, or a note why they are withheld: n_z is undecided, or the signal explains no
              more than it would of noise
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
from ...method.space.by_ranks import FaultSpaceEstimate, fault_space
from ..changes.table_rows import FREEZING, LOSS
from ..doubt.listing import named
from ..healthy.explained_share import noise_share
from .findings import Findings
from .several_experiments import for_each, looked_at, most_moved

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


def with_space(answer: Findings, on_progress: Progress) -> Findings:
    """Return the space of all fault columns, on the samples that faults were counted on."""
    model, rest, faults = answer.model, answer.residual, answer.n_v
    if not faults or model is None or rest is None:
        return answer
    if answer.news is not None and answer.news < faults:
        return replace(answer, notes=(*answer.notes, f"no fault space is given: {FORETOLD}"))
    if quiet := _quieter(answer):
        lost = (
            f"no fault space is given: {named(quiet)} {'has' if len(quiet) == 1 else 'have'} lost variance since the healthy samples, as "
            "a sensor that is stuck, or whose gain has fallen, does; such a fault is no signal that is added, and its space misleads"
        )
        return replace(answer, notes=(*answer.notes, lost))
    on_progress("finding the fault space", 0, 0)
    A, C = model.model.A, model.model.C
    # An exact record gives exact rows, and an exact space where the model is.
    space, notes = None if answer.exact and not isinstance(model, ReducedModel) else _by_laws(answer, faults), answer.notes
    if isinstance(space, str):
        notes += (f"the fault space is from the residual: {space}",)
    if not isinstance(space, FaultSpaceEstimate):
        try:
            space = fault_space(beyond_rounding(answer), A, C, n_v=faults)
        except InvalidData as error:
            return replace(answer, notes=(*notes, f"no fault space is given: {error}"))
        if space.method == "likelihood":
            notes += (FROM_IDENTIFIED,)
        if answer.exact and not answer.healthy:
            reason = f"undecided: {ESTIMATED}; {space.reason.removeprefix('undecided: ')}"
            space = replace(space, decided=False, reason=reason, error_bound=None)
    return replace(answer, notes=notes, fault_space=space if answer.n_v_given else replace(space, reason=said_counted(space.reason)))


def _quieter(answer: Findings) -> list[str]:
    """Return the outputs that the table of changes sees to have lost variance, unless a sensor freezes and thaws, which adds signals."""
    tables = [one.changes for one in answer.experiments if answer.healthy and one.changes is not None]
    seen = [row for changes in tables for row in changes.seen]
    return [] if any(row.kind == FREEZING for row in seen) else sorted({row.channel for row in seen if row.kind == LOSS})


def _by_laws(answer: Findings, faults: int) -> FaultSpaceEstimate | str:
    """Return the space from the laws of outputs and inputs, about their means as they were counted, or the reason why there is none."""
    record, model, rows = answer.record, answer.model, max(answer.record.p - faults, 1)
    assert model is not None
    if not affordable(record.p + record.n_u, -(-(model.order + BEYOND) // rows)):
        outputs = f"{counted(record.p, 'output')} with {counted(faults, 'fault')}"
        return f"order {model.order} is too high for the laws of {outputs} and of the inputs"
    data = about_own_means(record.stretches(*answer.held))
    count, level = answer.count, answer.noise_level
    if level is None and count is not None and count.n_v == faults and count.noise_power is not None:
        level = np.sqrt(count.noise_power)
    try:
        mix = noise_mix(answer)
        if isinstance(model, ReducedModel) and mix is not None:
            space = space_in_known_noise(*data, model, mix, n_v=faults)
        elif isinstance(model, ReducedModel):
            space = identified_fault_space(*data, model, n_v=faults, noise_level=level)
        else:
            space = fault_space_by_rows(*data, model.A, model.C, n_v=faults, noise_level=level)
    except (InvalidData, np.linalg.LinAlgError) as error:
        return str(error)
    return replace(space, reason=f"{space.reason}; n_v as given")


def noise_mix(answer: Findings) -> Array | None:
    """Return the mixture (p, p) of the outputs that has white noise across them by the healthy samples; None without such samples, and for
    a model of PI-MOESP, of which the space is sought in the outputs themselves."""
    rest = answer.residual
    if not isinstance(answer.model, ReducedModel) or not answer.healthy or rest is None or rest.fitted or rest.covariance is None:
        return None
    return whitening(rest.covariance)


def with_signal(answer: Findings, on_progress: Progress) -> Findings:
    """Return the signal of one choice of columns out of the space, over all samples of each experiment, where there is ground for one."""
    model, rest, sizes, space, count = answer.model, answer.residual, answer.sizes, answer.fault_space, answer.n_v
    if model is None or rest is None or sizes is None or space is None or not count or not space.meaningful or space.n_z < count:
        return answer
    if not space.decided:
        return replace(answer, notes=(*answer.notes, "F, G and the fault signal are withheld: n_z is undecided, see the fault space"))
    on_progress("choosing F and G", 0, 0)
    one = most_moved(answer)
    assert one.residual is not None and one.sizes is not None
    part = one.residual.store.read(*loudest(one.sizes.energies, len(one.record), TRIED_ON))
    F, G = choose_pair(part, model.model.A, model.model.C, space, count)
    answer = for_each(answer, lambda one: _reconstructed(one, F, G, on_progress))
    shown = any(one.signal is not None for one in answer.parts)
    return replace(answer, pair=(F, G)) if shown else answer


def _reconstructed(answer: Findings, F: Array, G: Array, on_progress: Progress) -> Findings:
    """Return the signal of these columns over all samples, or a note why it is withheld."""
    model, rest, count = answer.model, answer.residual, F.shape[1]
    assert model is not None and rest is not None
    try:
        signal = reconstruct_fault(rest.store, model.model.A, F, model.model.C, G, within=answer.held, on_progress=on_progress)
    except InvalidData as error:
        return replace(answer, notes=(*answer.notes, f"no fault signal is given: {error}"))
    notes = answer.notes
    explained, by_noise = _shares(answer, signal, count)
    answer = replace(answer, explained=explained, by_noise=by_noise)
    if explained <= by_noise:
        note = (
            f"F, G and the fault signal are withheld: they explain {100 * explained:.3g} % of the residual, and {count} "
            f"signal{'' if count == 1 else 's'} could explain up to {100 * by_noise:.3g} % of mere noise of its spectra"
        )
        return replace(answer, notes=(*notes, note))
    if signal.mismatch > JOINED:
        notes += (f"the fault signal was found piece by piece, and neighbouring pieces differ by up to {signal.mismatch:.2g} of its size",)
    return replace(answer, pair=(F, G), signal=signal, notes=notes)


def _shares(answer: Findings, signal: Reconstruction, count: int) -> tuple[float, float]:
    """Return what the signal explains of the residual that was counted on, and what so many signals could of noise; outputs in units of the
    healthy residual where there is one, else each in units of its own size."""
    rest, sizes, until = answer.residual, answer.sizes, answer.healthy
    assert rest is not None and sizes is not None
    healthy = until is not None and not np.all(sizes.early_peak <= ROUNDING * largest(answer.record))
    units = sizes.early_norm if healthy else np.sqrt(signal.whole)
    units = np.where(units > 0.0, units, 1.0)
    start = max((until or 0) - MEANS_FROM, 0)
    noise = rest.store.read(start, until or 0) if healthy else rest.store.read(*answer.held)
    try:
        return signal.explained(units), noise_share(noise, count, units, healthy=healthy)
    except InvalidData:
        return signal.explained(units), count / answer.record.p


def said_counted(reason: str) -> str:
    """Return the reason of a fault space for an n_v that was estimated, where `fault_space` could only say that it was handed over."""
    return reason.replace("n_v as given", "n_v as counted").replace("was given but", "was counted but")


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


def beyond_rounding(answer: Findings) -> Array:
    """Return the residual on the samples that are looked at, zero for outputs that the model explains to rounding: beside others that it
    does not explain, their rounding would be scaled up and counted as faults."""
    rest, sizes = answer.residual, answer.sizes
    assert rest is not None and sizes is not None
    return np.asarray(rest.store.read(*looked_at(answer)) * (sizes.peak > ROUNDING * largest(answer.record)))
