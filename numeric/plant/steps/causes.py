"""When the faults of `identify` set in, and which single sensor or actuator explains them.

onset_in      the changes of the residual of an experiment
causes_of     the angle of each sensor and each input to the fault space, and in each experiment what explains the shift of the mean after
              the first onset, or after the healthy samples
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.progress import Progress
from ...method.rows.known_noise import state_units
from ...method.space.estimate import FaultSpaceEstimate
from ...method.space.isolation import Isolation, isolate
from ...method.space.shift_isolation import ShiftIsolation, gain_errors, isolate_shift, positive_definite, stays
from ..changes.onset import FaultOnset, fault_onset
from ..healthy.mean_shift import MeanShift, mean_about_zero, mean_shift
from .choice import MEANS_FROM, noise_mix
from .explaining import doubt_of_means
from .findings import Begun, Causes, Counted, Explained, Space

SETTLED = 1e-4  # of the response to a step, what may be left where its mean is taken for the steady one


def onset_in(plant: Explained, on_progress: Progress) -> Begun:
    """Return the samples from which on the residual is another one, or a note why these were not looked for."""
    on_progress("looking for the onset", 0, 0)
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return Begun(fault_onset(plant.residual, healthy=plant.healthy))
    except np.linalg.LinAlgError:
        return Begun(None, ("no onset was looked for: numbers of the residual are too unequal to compute with, as outliers make them",))


def causes_of(plant: Explained, found: Counted, space: Space, onsets: Sequence[Begun]) -> Causes:
    """Return what single sensors and actuators are to the space, and in each experiment, of which `onsets` are, to a shift of the mean."""
    moved = not plant.parts and bool(plant.healthy) and found.mean is not None and found.mean.shifted is True
    shifts = tuple(_shift(one, begun.onset, moved) for one, begun in zip(plant.experiments, onsets, strict=True))
    return Causes(None if space.estimate is None else _isolation(plant, space.estimate), shifts)


def _isolation(plant: Explained, space: FaultSpaceEstimate) -> Isolation:
    record = plant.record
    # The units that `identified_fault_space` matches states in: it is called with outputs about their means, those of each experiment.
    y = np.vstack([one - one.mean(axis=0) for one, _ in record.stretches(*plant.held)])
    sizes = np.sqrt(np.mean(y**2, axis=0))
    units = np.where(sizes > 0, sizes, 1.0)
    mix = noise_mix(plant) if space.method == "kernel rows" else None
    if mix is not None:
        units = state_units(y, mix)
    return isolate(space, plant.model, outputs=record.outputs, inputs=record.inputs, units=units)


def _shift(plant: Explained, onset: FaultOnset | None, has_moved: bool) -> ShiftIsolation | None:
    """Return what single causes are to a shift of the mean of the residual, the fault that no rank shows.

    The mean is that of the samples from the first onset with time for it, where its transient has died out, to the next onset, against
    those before all onsets, or the healthy ones; without an onset, of all samples after the healthy ones. Where neither has moved, or the
    residual has a growing mode, nothing is said.
    """
    rest, model, healthy = plant.residual, plant.model, plant.healthy
    if rest.backward or (rest.fitted and healthy):
        return None
    dying = np.abs(model.model.poles[np.abs(model.model.poles) < 1])
    transient = int(np.ceil(np.log(SETTLED) / np.log(max(float(np.max(dying, initial=0.0)), SETTLED))))
    stretches: list[tuple[tuple[int, int], tuple[int, int]]] = []
    if onset is not None and onset.onsets:
        # A step that dies in slowly has an onset more: the first that leaves time for the transient is taken, else the one with most.
        times = [one.stretch[1] - one.stretch[0] for one in onset.onsets]
        enough = [k for k, time in enumerate(times) if time >= 2 * transient]
        chosen = onset.onsets[enough[0] if enough else int(np.argmax(times))]
        stretches.append(((0, healthy or onset.onsets[0].interval[0]), chosen.stretch))
    if healthy and has_moved:
        stretches.append(((0, healthy), (healthy, len(rest.store))))
    for against, (first, last) in stretches:
        start = min(first + transient, (first + last) // 2)
        found = _moved(plant, against, (start, last))
        if found is None or not found.shifted or found.shift is None or found.covariance is None:
            continue
        # Inputs would explain what a fault makes of them, and take it out of the variation.
        own = _own(rest.store.read(start, min(last, start + MEANS_FROM)))
        varying = None if own is None else own.covariance
        steady = start == first + transient and varying is not None and _steady(plant, against, (start, last))
        isolated = isolate_shift(
            found.shift,
            found.covariance,
            model,
            freedom=min((law.freedom for law in (found, own) if law is not None and law.freedom is not None), default=None),
            steady=steady,
            varying=varying,
            outputs=plant.record.outputs,
            inputs=plant.record.inputs,
        )
        return replace(isolated, samples=(start, last), against=against)
    return None


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


def _steady(plant: Explained, against: tuple[int, int], samples: tuple[int, int]) -> bool:
    """Say whether the mean of the residual has moved by the same in both halves of the samples."""
    middle = sum(samples) // 2
    early, late = _moved(plant, against, (samples[0], middle)), _moved(plant, against, (middle, samples[1]))
    if early is None or late is None or early.covariance is None or late.covariance is None or early.shift is None or late.shift is None:
        return False
    return stays(early.shift, late.shift, early.covariance + late.covariance, early.freedom)


def _moved(plant: Explained, against: tuple[int, int], samples: tuple[int, int]) -> MeanShift | None:
    """Return the test of the mean of the residual in these samples against that in others before; None where it has no ground, as where the
    inputs are elsewhere, so that the error of the model is not what the others show."""
    before, after = (max(against[0], against[1] - MEANS_FROM), against[1]), (samples[0], min(samples[1], samples[0] + MEANS_FROM))
    if before[1] <= before[0] or after[1] <= after[0]:
        return None
    u, u_before = plant.record.stretch(*after)[1], plant.record.stretch(*before)[1]
    if doubt_of_means(plant, against[1], u_before, u):
        return None
    r = plant.residual.store
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return mean_shift(r.read(*after), u, r.read(*before), u_before, gain_errors=gain_errors(plant.model))
    except (InvalidData, np.linalg.LinAlgError):  # constant channels, exact combinations, numbers too unequal
        return None
