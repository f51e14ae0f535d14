"""When the faults of `identify` set in, and which single sensor or actuator explains them.

with_onset       the Findings with the changes of the residual over the whole record
with_isolation   the Findings with the angle of each sensor and each input to the fault space, where there is one
with_shift       the Findings with what explains the shift of the mean after the first onset, or after the healthy samples
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.progress import Progress
from ...method.rows.known_noise import state_units
from ...method.space.isolation import isolate
from ...method.space.shift_isolation import gain_errors, isolate_shift, positive_definite, stays
from ..changes.onset import fault_onset
from ..healthy.mean_shift import MeanShift, mean_about_zero, mean_shift
from .choice import MEANS_FROM, noise_mix
from .elsewhere import doubt_of_means
from .findings import Findings

SETTLED = 1e-4  # of the response to a step, what may be left where its mean is taken for the steady one


def with_onset(answer: Findings, on_progress: Progress) -> Findings:
    """Return the Findings with the samples from which on the residual is another one."""
    assert answer.residual is not None
    on_progress("looking for the onset", 0, 0)
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return replace(answer, onset=fault_onset(answer.residual, healthy=answer.healthy))
    except np.linalg.LinAlgError:
        note = "no onset was looked for: numbers of the residual are too unequal to compute with, as outliers make them"
        return replace(answer, notes=(*answer.notes, note))


def with_isolation(answer: Findings) -> Findings:
    """Return the Findings with what single causes are to the fault space; without a space nothing is said."""
    space, model, record = answer.fault_space, answer.model, answer.record
    if space is None or model is None:
        return answer
    # The units that `identified_fault_space` matches states in: it is called with outputs about their means, those of each experiment.
    y = np.vstack([one - one.mean(axis=0) for one, _ in record.stretches(*answer.held)])
    sizes = np.sqrt(np.mean(y**2, axis=0))
    units = np.where(sizes > 0, sizes, 1.0)
    mix = noise_mix(answer) if space.method == "kernel rows" else None
    if mix is not None:
        units = state_units(y, mix)
    return replace(answer, isolation=isolate(space, model, outputs=record.outputs, inputs=record.inputs, units=units))


def with_shift(answer: Findings) -> Findings:
    """Return the Findings with what single causes are to a shift of the mean of the residual, the fault that no rank shows.

    The mean is that of the samples from the first onset with time for it, where its transient has died out, to the next onset, against
    those before all onsets, or the healthy ones; without an onset, of all samples after the healthy ones. Where neither has moved, or the
    residual has a growing mode, nothing is said.
    """
    rest, model, onset, healthy = answer.residual, answer.model, answer.onset, answer.healthy
    if model is None or rest is None or rest.backward or (rest.fitted and healthy):
        return answer
    dying = np.abs(model.model.poles[np.abs(model.model.poles) < 1])
    transient = int(np.ceil(np.log(SETTLED) / np.log(max(float(np.max(dying, initial=0.0)), SETTLED))))
    stretches: list[tuple[tuple[int, int], tuple[int, int]]] = []
    if onset is not None and onset.onsets:
        # A step that dies in slowly has an onset more: the first that leaves time for the transient is taken, else the one with most.
        times = [one.stretch[1] - one.stretch[0] for one in onset.onsets]
        enough = [k for k, time in enumerate(times) if time >= 2 * transient]
        chosen = onset.onsets[enough[0] if enough else int(np.argmax(times))]
        stretches.append(((0, healthy or onset.onsets[0].interval[0]), chosen.stretch))
    if healthy and answer.moved:
        stretches.append(((0, healthy), (healthy, len(rest.store))))
    for against, (first, last) in stretches:
        start = min(first + transient, (first + last) // 2)
        found = _moved(answer, against, (start, last))
        if found is None or not found.shifted or found.shift is None or found.covariance is None:
            continue
        # Inputs would explain what a fault makes of them, and take it out of the variation.
        own = _own(rest.store.read(start, min(last, start + MEANS_FROM)))
        varying = None if own is None else own.covariance
        steady = start == first + transient and varying is not None and _steady(answer, against, (start, last))
        isolated = isolate_shift(
            found.shift,
            found.covariance,
            model,
            freedom=min((law.freedom for law in (found, own) if law is not None and law.freedom is not None), default=None),
            steady=steady,
            varying=varying,
            outputs=answer.record.outputs,
            inputs=answer.record.inputs,
        )
        return replace(answer, shift_isolation=replace(isolated, samples=(start, last), against=against))
    return answer


def _own(r: Array) -> MeanShift | None:
    """Return what the mean of these residuals (M, p) is worth by their own variation; None where they have none in some direction, as where
    a sensor is stuck, or too little to compute with."""
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            own = mean_about_zero(r)
    except (InvalidData, np.linalg.LinAlgError):
        return None
    V = own.covariance
    return own if V is not None and np.isfinite(V).all() and positive_definite(V) else None


def _steady(answer: Findings, against: tuple[int, int], samples: tuple[int, int]) -> bool:
    """Say whether the mean of the residual has moved by the same in both halves of the samples."""
    middle = sum(samples) // 2
    early, late = _moved(answer, against, (samples[0], middle)), _moved(answer, against, (middle, samples[1]))
    if early is None or late is None or early.covariance is None or late.covariance is None or early.shift is None or late.shift is None:
        return False
    return stays(early.shift, late.shift, early.covariance + late.covariance, early.freedom)


def _moved(answer: Findings, against: tuple[int, int], samples: tuple[int, int]) -> MeanShift | None:
    """Return the test of the mean of the residual in these samples against that in others before; None where it has no ground, as where the
    inputs are elsewhere, so that the error of the model is not what the others show."""
    assert answer.residual is not None
    before, after = (max(against[0], against[1] - MEANS_FROM), against[1]), (samples[0], min(samples[1], samples[0] + MEANS_FROM))
    if before[1] <= before[0] or after[1] <= after[0]:
        return None
    u, u_before = answer.record.stretch(*after)[1], answer.record.stretch(*before)[1]
    if doubt_of_means(answer, against[1], u_before, u):
        return None
    r = answer.residual.store
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return mean_shift(r.read(*after), u, r.read(*before), u_before, gain_errors=gain_errors(answer.model))
    except (InvalidData, np.linalg.LinAlgError):  # constant channels, exact combinations, numbers too unequal
        return None
