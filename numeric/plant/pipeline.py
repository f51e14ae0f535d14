"""From a record of faulty data to model, number of faults, fault space and fault signal.

identify         the whole chain on a record: an Identification, with what remains possible where the data cannot tell; by steps/

1  The model (`modelling`): an ARX model of high order, reduced under its own weight, near the Cramer-Rao bound; the order is given, or
chosen with its evidence. PI-MOESP where the record has no noise, or where an ARX model cannot be had.
2  The residual of that model, its initial state fitted; the samples from which on it is another one (`causes`).
3  The number of faults (`counting`): by the laws that outputs and inputs obey, for which no model is needed. Where the first samples are
stated to be without fault, model and means are from these alone, the faults of the others are counted against what the residual shows
there, and its mean is held against theirs: a constant fault moves the mean and no rank. The count against them goes first where it is
decided, the ranks of the residual where it is not; 0 is said only where nothing is counted, no output has a spike or is stuck, and the
mean is tested and has not moved, with the size of fault that would have been seen. Where the inputs leave what the healthy samples show,
the model's error can look like a fault, and none is counted against them. Records without noise are counted by ranks, which are exact.
4  The fault space (`choice`), unless the number of faults is undecided or 0: from the same laws, with A and C of the model. Which
single sensor or actuator lies in it (`causes`).
5  F, G and the fault signal for one pair out of the space: determined up to that choice, and given only where n_z is decided and the signal
explains more of the residual than it would of noise.

Memory. Steps 1, 2 and 5 read the record, or the residual, in pieces and hold none of them, whatever N. Steps 3 and 4 hold the residual
(N x p floats), the outputs and the inputs (N x n_u) of at most HELD numbers together: of a longer record the stretch with most of the
residual's energy, and the notes say which. Models too unstable to be simulated forward, and signals whose uncertainty fades too slowly,
are the exceptions (`residual`, `reconstruct_fault`).
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...base.errors import InvalidData, shorten
from ...base.progress import Progress, silent
from ...base.sheets import counted
from ...base.threads import one_thread
from ..data.joining import healthy_from, joined, one_record
from ..data.records import Record
from ..data.sources import Source
from ..data.validation import noise_deviations, whole
from ..method.model.moesp_model import MoespModel
from ..method.model.reduced_model import ReducedModel
from .answer import Identification
from .answering import Told, answered, left_open
from .doubt.asking import doubts
from .steps.causes import causes_of, onset_in
from .steps.choice import ROUNDING, largest, no_signals, signals_of, space_of
from .steps.counting import counted_faults
from .steps.explaining import explained, long_enough
from .steps.findings import Because, Begun, Causes, Count, Counted, CountedBy, Explained, Measured, Modelled, Reason, Space
from .steps.modelling import modelled, window_default
from .steps.operating_point import asked_for, with_operating_point

NOTHING = "nothing of the system"


@one_thread()
def identify(
    y: Source | Sequence[Source],
    u: Any = None,
    *,
    order: int | None = None,
    block_rows: int | None = None,
    n_v: int | None = None,
    healthy: int | Source | None = None,
    noise_level: ArrayLike | None = None,
    operating_point: str | None = None,
    inputs: str | Sequence[str] | None = None,
    outputs: str | Sequence[str] | None = None,
    dt: float | None = None,
    on_progress: Progress | None = None,
) -> Identification:
    """Identify the model, the number of faults, their space and one signal from a record of inputs and outputs with faults.

    Look at `found.doubts` and `found.notes` first, then at `found.model`: where it is None the order stayed open, and
    `found.singular_values` tell the choices. Then at `found.n_v` and `found.reason`; None is an answer, too. Only then at
    `found.fault_space`, whose angle says how sure it is, and last at `found.pair` and `found.signal`, which are one choice out of that
    space. `print(found.summary())` tells all of it in this order.

    Several experiments of one plant have lengths, initial states and operating points of their own; model, number of faults and fault space
    are of all, and `found.experiments` has onset, changes, residual and signal of each. Experiments too short for the windows of the others
    are left out, and a note says so. Source: [W89] for the model, [W91] for the laws, [G25] for the fault space; [V93] for the model of a
    record without noise.

    Parameters
    ----------
    y, u : array_like or data frame, (N, p) and (N, n_u)
        One row a sample, in any units. Without `u`, `y` holds both: a record, the path of a data file, a frame, or an iterator of
        consecutive pieces (y, u), which is read once. Experiments are a list of records (as of `read_stretches`), paths or frames, or lists
        y and u of as many arrays each; a list of pairs (y, u) are pieces of one.
    order, block_rows, n_v : int, optional
        Number n of states; samples of a window (lags of the ARX model, block rows of PI-MOESP); number of faults. Else found from the data.
    healthy : int, or what holds a record, optional
        Number of first samples without fault; or another record of the same channels that has none, which then comes first in the record
        that the answer is about.
    noise_level : float or (p,), optional
        Standard deviation of the sensors' noise in units of y, by which faults are told from noise where no samples are healthy.
    operating_point : "means" or "zero", optional
        About what the plant is linear: by default the means of the healthy samples, or else those of each experiment unless zero may be it.
    inputs, outputs : str or list of str, optional
        Channels of a file or frame.
    dt : float, optional
        Seconds from sample to sample, which a time column may tell instead; exports have it, and the summary tells frequencies and damping.
    on_progress : callable, optional
        Hears (stage, done, total).

    Returns
    -------
    Identification
        What cannot be told is one of its `notes`.

    Raises
    ------
    InvalidInput
        A file that cannot be read.
    InvalidData
        Data from which no model can be had.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import identify
    >>> from faultspace.numeric.method.model.models import StateSpaceModel
    >>> u = np.random.default_rng(1).standard_normal((400, 1))
    >>> y = StateSpaceModel([[0.5]], [[1.0]], [[1.0], [2.0]], [[0.0], [1.0]]).simulate(u)
    >>> found = identify(y, u)
    >>> found.model.order, found.n_v
    (1, 0)
    """
    on_progress = on_progress or silent
    counted_healthy = None if _is_record(healthy) else healthy
    order, block_rows, n_v, until = _integers(order, block_rows, n_v, counted_healthy)
    asked, dt = asked_for(operating_point), _seconds(dt)
    record = one_record(y, u, inputs=inputs, outputs=outputs, on_progress=on_progress)
    if n_v is not None and n_v > record.p:
        raise InvalidData(f"n_v: got {n_v} for {counted(record.p, 'output')}; at most as many can be told apart: state fewer")
    if until is not None and until >= len(record):
        raise InvalidData(f"healthy: got {until} for {counted(len(record), 'sample')}; some must follow: state fewer")
    if until is not None and until > len(record.experiments[0]):
        raise InvalidData(
            f"healthy: got {until} for a first experiment of {counted(len(record.experiments[0]), 'sample')}; state samples of the first "
            "experiment, or give the experiment without fault as healthy and the others as experiments"
        )
    if until is None and healthy is not None:
        before = healthy_from(healthy, record, on_progress)
        record, until = joined(before, record), len(before)
    level = None if noise_level is None else noise_deviations(noise_level, record.p)
    _in_range(record)
    rows = window_default(until or len(record), record.p, record.n_u, order) if block_rows is None else block_rows
    record, notes = long_enough(record, rows)
    _judged(record if until is None else record.beginning(until), rows, until)
    measured = Measured(*with_operating_point(record, until, asked), until, until is not None and counted_healthy is None, level)
    made = modelled(measured.part, order, block_rows, on_progress)
    if level is not None and until is not None:
        notes += ("noise_level is not used: the healthy samples show the noise themselves",)
    raised = doubts(measured.part, made.model, dt=dt, means_removed=measured.means_removed)
    told = Told(order is not None, n_v is not None, record.clock.dt if dt is None and record.clock else dt, raised, notes)
    return left_open(measured, made, told) if made.model is None else _beside_model(measured, made, made.model, told, n_v, on_progress)


def _beside_model(
    measured: Measured, made: Modelled, model: MoespModel | ReducedModel, told: Told, n_v: int | None, on_progress: Progress
) -> Identification:
    """Go on from the model as the head of this module tells."""
    plant = explained(measured, model, made.exact, made.window, on_progress)
    if np.all(plant.sizes.peak <= ROUNDING * largest(plant.record)):
        nothing = Counted(Count(0, (), CountedBy.MODEL, (_nothing_left(plant),)), (0, 0))
        onsets, causes = [Begun(None)] * len(plant.experiments), Causes(None, (None,) * len(plant.experiments))
        return answered(plant, made, replace(told, n_v_given=False), onsets, nothing, Space(None), causes, no_signals(plant))
    onsets = [onset_in(one, on_progress) for one in plant.experiments]
    found = counted_faults(plant, None if plant.parts else onsets[0].onset, n_v, on_progress)
    plant = replace(plant, held=found.held)
    space = space_of(plant, found, on_progress)
    causes = causes_of(plant, found, space, onsets)
    signals = signals_of(plant, found.count.n_v, space.estimate, on_progress)
    return answered(plant, made, told, onsets, found, space, causes, signals)


def _nothing_left(plant: Explained) -> Reason:
    hidden = None if plant.healthy is not None else "means" if plant.means_removed else "inputs"
    return Reason(
        Because.EXPLAINED,
        {"outputs": list(plant.record.outputs), "sizes": (ROUNDING * largest(plant.record)).tolist(), "constant_hidden_by": hidden},
    )


def _is_record(healthy: Any) -> bool:
    """Say whether the healthy samples are told by a record, however it comes, rather than by their number."""
    if isinstance(healthy, str):
        return not healthy.strip().isdecimal()
    return isinstance(healthy, Record | os.PathLike | tuple | Iterator) or hasattr(healthy, "columns")


def _integers(
    order: int | None, block_rows: int | None, n_v: int | None, healthy: Any
) -> tuple[int | None, int | None, int | None, int | None]:
    """Return the arguments that count something, as ints. Raises InvalidData for anything else."""
    return (
        None if order is None else whole(order, "order", 1, "state how many states the model has, or leave it out to have it found"),
        None if block_rows is None else whole(block_rows, "block_rows", 2, "state more samples of a window, or leave it out"),
        None
        if n_v is None
        else whole(n_v, "n_v", 0, "state how many faults act, 0 to the number of outputs, or leave it out to count them"),
        None if healthy is None else whole(healthy, "healthy", 1, "state how many samples precede the faults, or leave it out"),
    )


def _seconds(dt: float | None) -> float | None:
    """Return the sample time as a float. Raises InvalidData for what is none."""
    number = isinstance(dt, Real) and not isinstance(dt, bool | np.bool_)
    if dt is None or (number and dt > 0 and np.isfinite(dt)):
        return None if dt is None else float(dt)
    raise InvalidData(f"dt: got {shorten(dt)}; the seconds from sample to sample are needed, or None where they are not known")


def _in_range(record: Record) -> None:
    """Refuse channels whose squares floats do not hold: too large for a sum, or so small that their digits are lost."""
    limits = np.finfo(np.float64)
    for name, low, high in zip(record.names, record.channels.least, record.channels.greatest, strict=True):
        size = max(abs(low), abs(high))
        if size > np.sqrt(limits.max / len(record)):
            raise InvalidData(f"channel {shorten(name)} reaches {size:.3g}, whose square no float holds: use other units, or mend a slip")
        if 0.0 < high - low < np.sqrt(limits.tiny):
            raise InvalidData(f"channel {shorten(name)} varies by {high - low:.3g}, whose square no float holds: use other units")


def _judged(part: Record, rows: int, healthy: int | None) -> None:
    """Refuse a record, or its healthy samples, from which no model can be had."""
    try:
        _enough(part, rows)
        _varying(part)
    except InvalidData as error:
        raise error if healthy is None else InvalidData(f"healthy: the model is from these samples alone: {error}") from None


def _enough(record: Record, rows: int) -> None:
    """Refuse a record with fewer windows than rows in its Hankel matrices."""
    samples, height = len(record), 2 * record.n_u + record.p
    needed = rows * (height + 2) - 1
    if samples >= needed:
        return
    shorter = (samples + 1) // (height + 2)
    advice = "record more" if shorter < 2 or shorter >= rows else f"record more, or try block_rows={shorter}"
    if samples < height:
        advice = "there are fewer samples than channels: is the table transposed? It needs a row a sample"
    raise InvalidData(
        f"got {counted(samples, 'sample')}, too few: with {counted(record.n_u, 'input')} and {counted(record.p, 'output')}, windows of "
        f"{rows} samples need at least {needed}; {advice}"
    )


def _varying(record: Record) -> None:
    """Refuse channels that never change: an input excites nothing, an output tells nothing."""
    for kind, names, start in (("input", record.inputs, 0), ("output", record.outputs, record.n_u)):
        least, greatest = (values[start : start + len(names)] for values in (record.channels.least, record.channels.greatest))
        still = [name for name, low, high in zip(names, least, greatest, strict=True) if low == high]
        if still and len(record) > 1:
            one, several = ("excites nothing", "excite nothing") if kind == "input" else (f"tells {NOTHING}", f"tell {NOTHING}")
            which, value = ", ".join(map(shorten, still[:4])), least[names.index(still[0])]
            if len(still) > 1:
                raise InvalidData(f"{kind}s {which} are constant: they {several}; leave them out, or record them while they vary")
            raise InvalidData(f"{kind} {which} is constant ({value:g}): it {one}; leave it out, or record it while it varies")
