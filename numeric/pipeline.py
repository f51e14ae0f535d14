"""From a record of faulty data to model, number of faults, fault space and fault signal.

identify         the whole chain on a record: an Answer, "undecided" where the data cannot tell
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
(`long_residuals`, `long_reconstruction`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..base.errors import InvalidData, shorten
from .count.against_healthy import fault_dimension_against_healthy
from .count.detectable import visible_white_faults
from .count.healthy_model import healthy_reference
from .count.mean_shift import POWER, mean_about_zero, mean_shift
from .count.rank_gap import fault_dimension
from .data.records import Passes, Record, Tell
from .model.chunks import pi_moesp_from_chunks
from .model.compression import compress_chunks
from .model.past_inputs import Identification, check_compression, pi_moesp_from_compression
from .result import Answer
from .signal.choice import MEANS_FROM, ROUNDING, beyond_rounding, largest, with_signal, with_space
from .signal.long_residuals import loudest, residual_of

Array = NDArray[np.float64]

DEFAULT_WINDOW = 20
SPARE = 3  # windows for each row of the Hankel matrices, at least
HELD = 1 << 21  # numbers of residual and inputs that faults are counted on
# Rules of thumb, for what no test of means and spectra looks at:
LOUDER = 1.5  # an input of more than so many times its healthy deviation drives model error that the healthy samples do not show
AWAY = 10.0  # and so does one that moved by more than so many
PEAK = 3.0  # a residual of more than so many times its healthy peak is no noise like the healthy one,
QUIET = 0.5  # nor is one of less than this share of its healthy size,
STUCK = 20  # nor an output that keeps one value for so many samples, and LONGER times as many as while healthy
LONGER = 4
AS_MANY = "as many faults as outputs look like noise in every output"


def identify(
    record: Record,
    *,
    order: int | None = None,
    block_rows: int | None = None,
    faults: int | None = None,
    healthy_until: int | None = None,
    remove_means: bool = False,
    tell: Tell | None = None,
) -> Answer:
    """The chain of the module's docstring on a record; `faults` states n_v instead of estimating it, `healthy_until` how many samples, from
    the first on, are without fault. Raises InvalidData for data from which no model can be had; what cannot be told after that is a note of
    the Answer."""
    told = tell or (lambda stage, done, total: None)
    if faults is not None and faults > record.p:
        raise InvalidData(f"--faults: got {faults} for {record.p} outputs; at most as many can be told apart: state fewer")
    if healthy_until is not None and not 0 < healthy_until < len(record):
        raise InvalidData(f"--healthy-until: got {healthy_until} for {len(record)} samples; some must follow: state fewer")
    part = record if healthy_until is None else record.beginning(healthy_until)
    rows = block_rows if block_rows is not None else default_block_rows(len(part), record.p, record.n_u, order)
    try:
        _enough(part, rows)
        _varying(part)
    except InvalidData as error:
        raise error if healthy_until is None else InvalidData(f"--healthy-until: the model is from these samples alone: {error}") from None
    notes = () if remove_means else _far_from_zero(part)
    if remove_means:
        record, part = record.about(part.channels.mean), part.about_means()
    model, values, refusal = _model(part, order, rows, told)
    answer = Answer(record, rows, remove_means, order is not None, values, model, notes=notes)
    answer = replace(answer, count_given=faults is not None, healthy_until=healthy_until)
    if model is None:
        return replace(answer, notes=(*notes, f"the order is undecided: {refusal}"))
    notes += model.warnings
    if order is not None and not model.gap.clean:
        notes += (f"order {order} was given; the singular values have no clean gap there (ratio {model.gap.ratio:.3g})",)
    rest = residual_of(record, model, "residual", told, until=healthy_until)
    answer = replace(answer, residual=rest, notes=(*notes, *rest.notes))
    if np.all(rest.peak <= ROUNDING * largest(record)):
        return replace(answer, count=0, count_given=False, count_reason=_nothing_left(answer), counted_by="model")
    return with_signal(with_space(_with_count(answer, faults, told), told), told)


def _nothing_left(answer: Answer) -> str:
    least = ROUNDING * largest(answer.record)
    sizes = ", ".join(f"{shorten(name)} {size:.2g}" for name, size in zip(answer.record.outputs, least, strict=True))
    hidden = ""
    if answer.healthy_until is None:
        hidden = (
            "; a fault that is constant over the whole record went with the means"
            if answer.means_removed
            else "; a fault that is constant over the whole record can pass for the response to the mean of the inputs"
        )
    return f"the model explains the outputs to rounding: nothing larger than {sizes} acts{hidden}"


def _with_count(answer: Answer, faults: int | None, tell: Tell) -> Answer:
    """How many faults act, from the residual beside the inputs."""
    record, rest, notes = answer.record, answer.residual, answer.notes
    assert rest is not None
    tell("counting faults", 0, 0)
    most = HELD // (record.p + record.n_u)
    first, last = loudest(rest.energies, len(record), most)
    healthy = answer.healthy_until or 0
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
        seen = int(np.sum(rest.peak > ROUNDING * largest(record)))
        if found.n_v and found.n_v >= seen and seen < record.p:
            found = replace(found, n_v=None, reason=f"{found.reason}; but so many outputs are not explained to rounding: {AS_MANY}")
        by = None if found.n_v is None else "residual alone"
        answer = replace(answer, dimension=found, count=found.n_v, count_reason=found.reason, counted_by=by)
    except InvalidData as error:
        answer = replace(answer, count_reason=str(error))
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            # Not those set to zero: rounding is held against rounding.
            answer = _against_healthy(answer, rest.store.read(first, last), tell) if healthy else _about_zero(answer, r)
    except np.linalg.LinAlgError:
        told = "numbers of the residual are too unequal to compute with, as outliers make them: mend the record there"
        answer = replace(answer, count=None, counted_by=None, count_reason=told)
    if faults is None:
        return answer
    said = "undecided" if answer.count is None else answer.count
    told = "as the data say" if faults == answer.count else f"the data say {said}: {answer.count_reason}"
    return replace(answer, count=faults, count_reason=f"{faults} given; {told}", counted_by="given")


def _about_zero(answer: Answer, r: Array) -> Answer:
    """Without healthy samples: the mean of the residual against zero, where it was not removed. It decides nothing, since a constant fault
    over a whole record cannot be told from an operating point."""
    if answer.count == 0:
        answer = replace(answer, count_reason=f"{answer.count_reason}; a fault that is constant over the whole record would not be seen")
    if answer.means_removed:
        return answer
    mean = mean_about_zero(r[:MEANS_FROM])
    notes = answer.notes
    if mean.shifted:
        notes += (
            f"the residual is not about zero ({mean.reason}): an operating point, or a constant fault; which of them, only samples without "
            "fault can tell (--healthy-until)",
        )
    return replace(answer, mean=mean, notes=notes)


def _against_healthy(answer: Answer, r: Array, tell: Tell) -> Answer:
    """The count of `answer`'s residual r beside that against the samples stated to be without fault, of which the last HELD numbers are
    held, and beside the test of the mean."""
    record, rest, until = answer.record, answer.residual, answer.healthy_until
    assert rest is not None and until is not None
    if np.all(rest.early_peak <= ROUNDING * largest(record)):
        return _zero_or_not(replace(answer, unexplained=True))
    tell("counting faults against the healthy samples", 0, 0)
    start = max(until - HELD // (record.p + record.n_u), 0)
    healthy, before, u = rest.store.read(start, until), record.stretch(start, until)[1], record.stretch(*answer.held)[1]
    mean = mean_shift(r[:MEANS_FROM], u[:MEANS_FROM], healthy[-MEANS_FROM:], before[-MEANS_FROM:])
    if not rest.foreseen:
        mean = replace(mean, shifted=None, reason="the model is too unstable to be run on from the healthy samples", visible=None)
    answer = replace(answer, mean=mean)
    driven = _beyond_healthy_inputs(before, u, record.inputs)
    if driven and mean.shifted:
        answer = replace(answer, mean=replace(mean, shifted=None, reason=driven, visible=None))
    try:
        reference = healthy_reference(healthy, before)
        against = fault_dimension_against_healthy(r, reference, u=u)
    except InvalidData as error:
        return _zero_or_not(replace(answer, notes=(*answer.notes, f"not counted against samples {start} to {until - 1}: {error}")))
    if driven and against.n_v != 0:
        return _zero_or_not(replace(answer, notes=(*answer.notes, f"not counted against samples {start} to {until - 1}: {driven}")))
    strange = _unlike_healthy(r, healthy, record.stretch(*answer.held)[0], record.stretch(start, until)[0], record.outputs)
    if strange and against.n_v == 0:
        against = replace(against, n_v=None, reason=f"{against.reason}; but {strange}")
        # Ranks of the residual alone would count the noise of the other outputs as faults beside a dead one.
        answer = replace(answer, count=None, counted_by=None, count_reason=against.reason)
    answer = replace(answer, healthy=(start, until), against=against, visible=visible_white_faults(reference, against, POWER))
    if against.n_v is not None:
        answer = replace(answer, count=against.n_v, count_reason=against.reason, counted_by="healthy samples")
    return _zero_or_not(answer)


def _beyond_healthy_inputs(before: Array, u: Array, names: Sequence[str]) -> str:
    """Why the model's error need not be as the healthy samples show it, or nothing."""
    sizes = np.where(before.std(axis=0) > 0.0, before.std(axis=0), 1.0)
    louder, away = u.std(axis=0) / sizes, np.abs(u.mean(axis=0) - before.mean(axis=0)) / sizes
    for i, name in enumerate(names):
        if louder[i] > LOUDER or away[i] > AWAY:
            how = f"{louder[i]:.3g} times as loud" if louder[i] > LOUDER else f"{away[i]:.3g} deviations away"
            return f"input {shorten(name)} is {how} after the healthy samples, so that the error of the model can look like a fault"
    return ""


def _unlike_healthy(r: Array, healthy: Array, y: Array, healthy_y: Array, names: Sequence[str]) -> str:
    """What a plot would show and no spectrum or mean: a spike, a sensor that is stuck or dead. Nothing where there is none."""
    peaks, sizes = np.abs(healthy).max(axis=0), np.sqrt(np.mean(healthy**2, axis=0))
    for i, name in enumerate(names):
        where = int(np.argmax(np.abs(r[:, i])))
        if abs(r[where, i]) > PEAK * peaks[i]:
            times = abs(r[where, i]) / peaks[i]
            return f"the residual of {shorten(name)} reaches {times:.3g} times its healthy peak: a short fault, or an outlier"
        if np.sqrt(np.mean(r[:, i] ** 2)) < QUIET * sizes[i]:
            return f"the residual of {shorten(name)} is much smaller than while healthy: a sensor that is stuck or dead, or less noise"
        still = _longest_still(y[:, i])
        if still >= max(STUCK, LONGER * _longest_still(healthy_y[:, i])):
            return f"{shorten(name)} keeps one value for {still} samples: a sensor that is stuck or dead, or nothing that moves it"
    return ""


def _longest_still(values: Array) -> int:
    """Samples of the longest run of equal values."""
    edges = np.flatnonzero(np.concatenate([[True], values[1:] != values[:-1], [True]]))
    return int(np.diff(edges).max())


def _zero_or_not(answer: Answer) -> Answer:
    """0 is said only where nothing was counted, against the healthy samples if possible, and the mean is known not to have moved."""
    if answer.count != 0 and not (answer.count is None and (answer.moved or answer.unexplained)):
        return answer
    mean, against = answer.mean, answer.against
    if answer.unexplained:
        reason = f"the model explains the healthy samples to rounding and not the others, so that a fault acts; {answer.count_reason}"
        return replace(answer, count=None, counted_by=None, count_reason=reason)
    assert mean is not None
    if mean.shifted:
        where = ", ".join(shorten(answer.record.outputs[i]) for i in mean.channels) or "no output by itself, all of them together"
        reason = (
            f"a fault moves the mean of the residual ({where}; {mean.reason}), at least one; a constant fault changes no rank, so that "
            f"ranks cannot count it; of faults that vary: {answer.count_reason}"
        )
        return replace(answer, count=None, counted_by=None, count_reason=reason)
    if mean.shifted is None:
        reason = f"{answer.count_reason}; but whether the mean has moved, as by a constant fault, is undecided: {mean.reason}"
        return replace(answer, count=None, counted_by=None, count_reason=reason)
    if against is not None and against.n_v is None:
        return replace(answer, count=None, counted_by=None, count_reason=against.reason)
    return replace(answer, count_reason=f"{answer.count_reason}; {mean.reason}")


def default_block_rows(samples: int, p: int, n_u: int, order: int | None) -> int:
    """20 block rows, more where a given order needs them, fewer where the record is short."""
    wanted = DEFAULT_WINDOW if order is None else max(DEFAULT_WINDOW, -(-order // p) + 2, -(-order // n_u) + 1)
    affordable = samples // (2 + SPARE * (2 * n_u + p))
    return max(min(wanted, affordable), 2)


def _model(record: Record, order: int | None, rows: int, tell: Tell) -> tuple[Identification | None, Array, str]:
    """The model with its singular values; without an order to trust None, the values and the reason. Raises InvalidData for bad data."""
    data = Passes(record, "identifying the model", tell)
    compression = compress_chunks(data, block_rows=rows)
    check_compression(compression)
    try:
        found = pi_moesp_from_chunks(compression, data, order=order)
        return found, found.singular_values, ""
    except InvalidData as error:
        if order is not None:
            raise
        # Data from which some model can be had are good data: only the order is open.
        try:
            values = pi_moesp_from_compression(compression, order=1).singular_values
        except InvalidData:
            raise error from None
        return None, values, str(error)


def _enough(record: Record, rows: int) -> None:
    """Refuses a record with fewer windows than rows in its Hankel matrices."""
    samples, height = len(record), 2 * record.n_u + record.p
    needed = rows * (height + 2) - 1
    if samples >= needed:
        return
    shorter = (samples + 1) // (height + 2)
    advice = "record more" if shorter < 2 or shorter >= rows else f"record more, or try --block-rows {shorter}"
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
    return (f"the mean of {which} exceeds its deviation: about an operating point, try --remove-means",)
