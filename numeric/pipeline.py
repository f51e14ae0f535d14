"""From a record of faulty data to model, number of faults, fault space and fault signal.

identify         the whole chain on a record: an Identification, "undecided" where the data cannot tell
default_block_rows   the window taken where none is given

1  PI-MOESP. No clean gap in the singular values and no order given: the order is undecided, and the chain ends there.
2  The residual of that model, its initial state fitted.
3  The fault dimension, of the residual beside the inputs: an identified model is wrong by about N^(-1/2), so that the residual alone has
the inputs in it as if they were faults. Where the first samples are stated to be without fault, model and means are from these alone, the
faults of the others are counted once more against what the residual shows there, and its mean is held against theirs: a constant fault
moves the mean and no rank. The count against them goes first where it is decided, the other where it is not; 0 is said only where nothing
is counted, no output has a spike or is stuck, and the mean is tested and has not moved, with the size of fault that would have been seen.
Where the inputs leave what the healthy samples show, the model's error can look like a fault, and none is counted against them.
4  The fault space, unless the dimension is undecided or 0.
5  F, G and the fault signal for one pair out of the space: determined up to that choice, and given only where n_z is decided and the signal
explains more of the residual than it would of noise.

Memory. Steps 1, 2 and 5 read the record, or the residual, in pieces and hold none of them, whatever N. Steps 3 and 4 hold the residual
(N x p floats) and the inputs (N x n_u) of at most HELD numbers together: of a longer record the stretch with most of the residual's energy,
and the notes say which. Models too unstable to be simulated forward, and signals whose uncertainty fades too slowly, are the exceptions
(`residual`, `reconstruct_fault`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from numbers import Real
from typing import Any

import numpy as np

from ..base.arrays import Array
from ..base.errors import InvalidData, shorten
from ..base.threads import one_thread
from .choice import MEANS_FROM, ROUNDING, beyond_rounding, largest, with_signal, with_space
from .count.against_healthy import fault_dimension_against_healthy
from .count.detectable import visible_white_faults
from .count.healthy_model import healthy_reference
from .count.mean_shift import POWER, mean_about_zero, mean_shift
from .count.rank_gap import fault_dimension
from .count.unlike_healthy import beyond_healthy_inputs, unlike_healthy
from .data.records import OnProgress, Passes, Record, silent
from .data.sources import Source, record_from
from .data.validation import whole
from .findings import Findings
from .model.moesp_model import MoespModel, OrderUndecided
from .model.past_inputs import pi_moesp
from .model.residuals import ResidualSignal, growing_modes, residual
from .result import Identification
from .signal.residual_sizes import loudest, residual_sizes

DEFAULT_WINDOW = 20
SPARE = 3  # windows for each row of the Hankel matrices, at least
HELD = 1 << 21  # numbers of residual and inputs that faults are counted on
AS_MANY = "as many faults as outputs look like noise in every output"


@one_thread()
def identify(
    y: Source,
    u: Any = None,
    *,
    order: int | None = None,
    block_rows: int | None = None,
    n_v: int | None = None,
    healthy: int | None = None,
    remove_means: bool = False,
    inputs: str | Sequence[str] | None = None,
    outputs: str | Sequence[str] | None = None,
    dt: float | None = None,
    on_progress: OnProgress | None = None,
) -> Identification:
    """Identifies the model, the number of faults, their space and one signal from a record of inputs and outputs with faults [V93], [G25].

    y (N, p) and u (N, n_u) are arrays or data frames, one row a sample, in any units. Without u, y holds both: a record, the path of a
    data file or a frame, whose channels `inputs` and `outputs` choose, or an iterator of consecutive pieces (y, u), which is read once.
    All of them become one record, and the same numbers give the same answer.

    `order` is the number n of states, `block_rows` the samples of a window, `n_v` the number of faults, each found from the data where it
    is not stated; `healthy` says how many samples, from the first on, are without fault; `remove_means` takes the means off, of the healthy
    samples where there are any. `dt` is the time from sample to sample in seconds, which only the exports need. `on_progress(stage, done,
    total)` hears how far it has come. Raises InvalidInput for a file that cannot be read, and InvalidData for data from which no model can
    be had; what cannot be told after that is a note of the Identification.

    >>> import numpy as np
    >>> from faultspace.numeric import identify
    >>> from faultspace.numeric.model.models import StateSpaceModel
    >>> u = np.random.default_rng(1).standard_normal((400, 1))
    >>> y = StateSpaceModel([[0.5]], [[1.0]], [[1.0], [2.0]], [[0.0], [1.0]]).simulate(u)
    >>> found = identify(y, u)
    >>> found.model.order, found.n_v
    (1, 0)
    """
    on_progress = on_progress or silent
    order, block_rows, n_v, healthy = _integers(order, block_rows, n_v, healthy)
    if not isinstance(remove_means, bool | np.bool_):
        raise InvalidData(f"remove_means: got {shorten(remove_means)}; True or False is needed")
    dt = _seconds(dt)
    record = record_from(y, u, inputs=inputs, outputs=outputs, on_progress=on_progress)
    if n_v is not None and n_v > record.p:
        raise InvalidData(f"n_v: got {n_v} for {record.p} outputs; at most as many can be told apart: state fewer")
    if healthy is not None and healthy >= len(record):
        raise InvalidData(f"healthy: got {healthy} for {len(record)} samples; some must follow: state fewer")
    found = _findings(record, order, block_rows, n_v, healthy, bool(remove_means), on_progress)
    return Identification(**vars(found) | {"dt": dt})


def _integers(
    order: int | None, block_rows: int | None, n_v: int | None, healthy: int | None
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


def _findings(
    record: Record,
    order: int | None,
    block_rows: int | None,
    n_v: int | None,
    healthy: int | None,
    remove_means: bool,
    on_progress: OnProgress,
) -> Findings:
    """Go through the chain of the module's docstring."""
    part = record if healthy is None else record.beginning(healthy)
    rows = block_rows if block_rows is not None else default_block_rows(len(part), record.p, record.n_u, order)
    try:
        _enough(part, rows)
        _varying(part)
    except InvalidData as error:
        raise error if healthy is None else InvalidData(f"healthy: the model is from these samples alone: {error}") from None
    notes = () if remove_means else _far_from_zero(part)
    if remove_means:
        record, part = record.about(part.channels.mean), part.about_means()
    model, values, refusal = _model(part, order, rows, on_progress)
    answer = Findings(record, rows, remove_means, order is not None, values, model, notes=notes)
    answer = replace(answer, n_v_given=n_v is not None, healthy=healthy)
    if model is None:
        return replace(answer, notes=(*notes, f"the order is undecided: {refusal}"))
    notes += model.warnings
    if order is not None and not model.gap.clean:
        notes += (f"order {order} was given; the singular values have no clean gap there (ratio {model.gap.ratio:.3g})",)
    rest = _residual(record, model, on_progress)
    sizes = residual_sizes(rest.store, healthy or len(record))
    answer = replace(answer, residual=rest, sizes=sizes, notes=(*notes, *rest.notes))
    if np.all(sizes.peak <= ROUNDING * largest(record)):
        return replace(answer, n_v=0, n_v_given=False, reason=_nothing_left(answer), counted_by="model")
    return with_signal(with_space(_with_count(answer, n_v, on_progress), on_progress), on_progress)


def _residual(record: Record, model: MoespModel, on_progress: OnProgress) -> ResidualSignal:
    """Take the residual from the state that goes with the model's B and D, where output error has found one and the model can be run from
    it over the whole record, of which it may have seen a part: no sample is then held. Its covariance has taken off all parameters that
    were fitted."""
    data = Passes(record, "residual", on_progress)
    if model.x0 is None or model.residual_covariance is None or growing_modes(model.model, len(record)):
        return residual(data, None, model.model)
    return replace(residual(data, None, model.model, x0=model.x0), covariance=model.residual_covariance)


def _nothing_left(answer: Findings) -> str:
    least = ROUNDING * largest(answer.record)
    sizes = ", ".join(f"{shorten(name)} {size:.2g}" for name, size in zip(answer.record.outputs, least, strict=True))
    hidden = ""
    if answer.healthy is None:
        hidden = (
            "; a fault that is constant over the whole record went with the means"
            if answer.means_removed
            else "; a fault that is constant over the whole record can pass for the response to the mean of the inputs"
        )
    return f"the model explains the outputs to rounding: nothing larger than {sizes} acts{hidden}"


def _with_count(answer: Findings, faults: int | None, on_progress: OnProgress) -> Findings:
    """Count the faults, from the residual beside the inputs."""
    record, rest, sizes, notes = answer.record, answer.residual, answer.sizes, answer.notes
    assert rest is not None and sizes is not None
    on_progress("counting faults", 0, 0)
    most = HELD // (record.p + record.n_u)
    first, last = loudest(sizes.energies, len(record), most)
    healthy = answer.healthy or 0
    if first < healthy:
        first, last = healthy, min(healthy + most, len(record))
    if last - first < len(record):
        why = "where the residual is largest" if first > healthy or not healthy else "after those stated to be without fault"
        source = "the fault signal is from all samples, the model from the healthy ones"
        source = source if healthy else "the model and the fault signal are from all samples"
        notes += (f"faults are counted, and their space is found, on samples {first} to {last - 1}, {why}; {source}",)
    answer = replace(answer, held=(first, last), notes=notes)
    r = beyond_rounding(answer)
    try:
        found = fault_dimension(r.astype(np.float32) if record.single else r, u=record.stretch(first, last)[1])
        seen = int(np.sum(sizes.peak > ROUNDING * largest(record)))
        if found.n_v and found.n_v >= seen and seen < record.p:
            found = replace(found, n_v=None, reason=f"{found.reason}; but so many outputs are not explained to rounding: {AS_MANY}")
        by = None if found.n_v is None else "residual alone"
        answer = replace(answer, dimension=found, n_v=found.n_v, reason=found.reason, counted_by=by)
    except InvalidData as error:
        answer = replace(answer, reason=str(error))
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            # Not those set to zero: rounding is held against rounding.
            answer = _against_healthy(answer, rest.store.read(first, last), on_progress) if healthy else _about_zero(answer, r)
    except np.linalg.LinAlgError:
        reason = "numbers of the residual are too unequal to compute with, as outliers make them: mend the record there"
        answer = replace(answer, n_v=None, counted_by=None, reason=reason)
    if faults is None:
        return answer
    counted = "undecided" if answer.n_v is None else answer.n_v
    agreement = "as the data say" if faults == answer.n_v else f"the data say {counted}: {answer.reason}"
    return replace(answer, n_v=faults, reason=f"{faults} given; {agreement}", counted_by="given")


def _about_zero(answer: Findings, r: Array) -> Findings:
    """Hold the mean of the residual against zero, where there are no healthy samples and it was not removed. It decides nothing, since a
    constant fault over a whole record cannot be told from an operating point."""
    if answer.n_v == 0:
        answer = replace(answer, reason=f"{answer.reason}; a fault that is constant over the whole record would not be seen")
    if answer.means_removed:
        return answer
    mean = mean_about_zero(r[:MEANS_FROM])
    notes = answer.notes
    if mean.shifted:
        notes += (
            f"the residual is not about zero ({mean.reason}): an operating point, or a constant fault; which of them, only samples without "
            "fault can tell (healthy=K)",
        )
    return replace(answer, mean=mean, notes=notes)


def _against_healthy(answer: Findings, r: Array, on_progress: OnProgress) -> Findings:
    """Count the faults in the residual r of `answer` against the samples stated to be without fault, of which the last HELD numbers are
    held, and beside the test of the mean."""
    record, rest, sizes, until = answer.record, answer.residual, answer.sizes, answer.healthy
    assert rest is not None and sizes is not None and until is not None
    if np.all(sizes.early_peak <= ROUNDING * largest(record)):
        return _zero_or_not(replace(answer, unexplained=True))
    on_progress("counting faults against the healthy samples", 0, 0)
    start = max(until - HELD // (record.p + record.n_u), 0)
    healthy, before, u = rest.store.read(start, until), record.stretch(start, until)[1], record.stretch(*answer.held)[1]
    mean = mean_shift(r[:MEANS_FROM], u[:MEANS_FROM], healthy[-MEANS_FROM:], before[-MEANS_FROM:])
    if rest.fitted:
        mean = replace(mean, shifted=None, reason="the model is too unstable to be run on from the healthy samples", visible=None)
    answer = replace(answer, mean=mean)
    driven = beyond_healthy_inputs(before, u, record.inputs)
    if driven and mean.shifted:
        answer = replace(answer, mean=replace(mean, shifted=None, reason=driven, visible=None))
    try:
        reference = healthy_reference(healthy, before)
        against = fault_dimension_against_healthy(r, reference, u=u)
    except InvalidData as error:
        return _zero_or_not(replace(answer, notes=(*answer.notes, f"not counted against samples {start} to {until - 1}: {error}")))
    if driven and against.n_v != 0:
        return _zero_or_not(replace(answer, notes=(*answer.notes, f"not counted against samples {start} to {until - 1}: {driven}")))
    strange = unlike_healthy(r, healthy, record.stretch(*answer.held)[0], record.stretch(start, until)[0], record.outputs)
    if strange and against.n_v == 0:
        against = replace(against, n_v=None, reason=f"{against.reason}; but {strange}")
        # Ranks of the residual alone would count the noise of the other outputs as faults beside a dead one.
        answer = replace(answer, n_v=None, counted_by=None, reason=against.reason)
    answer = replace(answer, counted_against=(start, until), against=against, visible=visible_white_faults(reference, against, POWER))
    if against.n_v is not None:
        answer = replace(answer, n_v=against.n_v, reason=against.reason, counted_by="healthy samples")
    return _zero_or_not(answer)


def _zero_or_not(answer: Findings) -> Findings:
    """Leave 0 only where nothing was counted, against the healthy samples if possible, and the mean is known not to have moved."""
    if answer.n_v != 0 and not (answer.n_v is None and (answer.moved or answer.unexplained)):
        return answer
    mean, against = answer.mean, answer.against
    if answer.unexplained:
        reason = f"the model explains the healthy samples to rounding and not the others, so that a fault acts; {answer.reason}"
        return replace(answer, n_v=None, counted_by=None, reason=reason)
    assert mean is not None
    if mean.shifted:
        where = ", ".join(shorten(answer.record.outputs[i]) for i in mean.channels) or "no output by itself, all of them together"
        reason = (
            f"a fault moves the mean of the residual ({where}; {mean.reason}), at least one; a constant fault changes no rank, so that "
            f"ranks cannot count it; of faults that vary: {answer.reason}"
        )
        return replace(answer, n_v=None, counted_by=None, reason=reason)
    if mean.shifted is None:
        reason = f"{answer.reason}; but whether the mean has moved, as by a constant fault, is undecided: {mean.reason}"
        return replace(answer, n_v=None, counted_by=None, reason=reason)
    if against is not None and against.n_v is None:
        return replace(answer, n_v=None, counted_by=None, reason=against.reason)
    return replace(answer, reason=f"{answer.reason}; {mean.reason}")


def default_block_rows(samples: int, p: int, n_u: int, order: int | None) -> int:
    """Return 20 block rows, more where a given order needs them, fewer where the record is short."""
    wanted = DEFAULT_WINDOW if order is None else max(DEFAULT_WINDOW, -(-order // p) + 2, -(-order // n_u) + 1)
    affordable = samples // (2 + SPARE * (2 * n_u + p))
    return max(min(wanted, affordable), 2)


def _model(record: Record, order: int | None, rows: int, on_progress: OnProgress) -> tuple[MoespModel | None, Array, str]:
    """Return the model with its singular values; without an order to trust None, the values and the reason. Raises InvalidData for bad
    data."""
    try:
        found = pi_moesp(Passes(record, "identifying the model", on_progress), order=order, block_rows=rows)
    except OrderUndecided as error:
        return None, error.singular_values, str(error)
    return found, found.singular_values, ""


def _enough(record: Record, rows: int) -> None:
    """Refuses a record with fewer windows than rows in its Hankel matrices."""
    samples, height = len(record), 2 * record.n_u + record.p
    needed = rows * (height + 2) - 1
    if samples >= needed:
        return
    shorter = (samples + 1) // (height + 2)
    advice = "record more" if shorter < 2 or shorter >= rows else f"record more, or try block_rows={shorter}"
    if samples < height:
        advice = "there are fewer samples than channels: is the table transposed? It needs a row a sample"
    raise InvalidData(
        f"got {samples} samples, which are too few: with {record.n_u} inputs and {record.p} outputs, windows of {rows} samples need at "
        f"least {needed}; {advice}"
    )


def _varying(record: Record) -> None:
    """Refuses channels that never change: an input excites nothing, an output tells nothing."""
    for kind, names, start in (("input", record.inputs, 0), ("output", record.outputs, record.n_u)):
        least, greatest = (values[start : start + len(names)] for values in (record.channels.least, record.channels.greatest))
        still = [name for name, low, high in zip(names, least, greatest, strict=True) if low == high]
        if still and len(record) > 1:
            what = "excites nothing" if kind == "input" else "tells nothing of the system"
            which, value = ", ".join(map(shorten, still[:4])), least[names.index(still[0])]
            raise InvalidData(f"{kind} {which} is constant ({value:g}): it {what}; leave it out, or record it while it varies")


def _far_from_zero(record: Record) -> tuple[str, ...]:
    channels = record.channels
    far = [name for name, far in zip(record.names, np.abs(channels.mean) > channels.deviation, strict=True) if far]
    if not far:
        return ()
    which = ", ".join(far[:4]) + (f" and {len(far) - 4} more" if len(far) > 4 else "")
    return (f"the mean of {which} exceeds its deviation: about an operating point, try remove_means=True",)
