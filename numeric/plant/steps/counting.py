"""Count the faults of `identify`: by the laws of outputs and inputs, against healthy samples, or by the ranks of the residual.

with_count   the Findings with the number of faults, or with those that remain possible, and the reason

    exact record             the ranks of the residual beside the inputs (`fault_dimension`), which are exact then
    no healthy samples       the laws that outputs and inputs obey (`count_faults`), each with a probability; no model enters
    healthy samples          against what the residual shows there; the ranks where that is undecided; the mean and the table of changes
                             (`changing.py`) beside both

The ranks are looked at in any case, as evidence. A 0 of the laws is said only where the ranks do not find a fault either. Outputs and
inputs are counted about their means: a constant is an operating point for the laws, so that one equation holds for both.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ....base.progress import Progress
from ....base.sheets import counted
from ...method.model.reduced_model import ReducedModel
from ...method.ranks.rank_gap import fault_dimension
from ...method.rows.evidence import LONG
from ...method.rows.fault_count import NO_CONSTANT, count_faults
from ...method.rows.joint import affordable
from ...method.signal.residual_sizes import loudest
from ...method.space.shift_isolation import gain_errors
from ..healthy.against_healthy import fault_dimension_against_healthy
from ..healthy.detectable import visible_white_faults
from ..healthy.healthy_model import healthy_reference
from ..healthy.mean_shift import POWER, mean_about_zero, mean_shift
from ..healthy.news import news_beyond_healthy
from ..healthy.unlike_healthy import beyond_healthy_inputs, unlike_healthy
from .changing import beside_changes, unlike_healthy_ranks, with_changes
from .choice import MEANS_FROM, ROUNDING, about_own_means, beyond_rounding, largest
from .elsewhere import doubt_of_means
from .findings import Findings
from .several_experiments import for_each, looked_at

HELD = 1 << 21  # numbers of residual and inputs that faults are counted on
AS_MANY = "as many faults as outputs look like noise in every output"
DEPENDENT = 1e-10  # singular values of the scaled outputs, beside the largest they could have, below which a channel is a combination
UNLIKELY = 1e-6  # probability of spikes that is not put down to noise
UNEQUAL = float(np.finfo(np.float64).eps ** -0.25)  # ratio of numbers whose squares keep half of their digits side by side
TINY = float(np.finfo(np.float64).tiny)


def with_count(answer: Findings, faults: int | None, on_progress: Progress) -> Findings:
    """Count the faults, from the residual beside the inputs."""
    record, rest, sizes, notes = answer.record, answer.residual, answer.sizes, answer.notes
    assert rest is not None and sizes is not None
    on_progress("counting faults", 0, 0)
    most = HELD // (record.p + record.n_u)
    first, last = loudest(sizes.energies, len(record), most)
    healthy = answer.healthy or 0
    if first < healthy:
        first, last = healthy, min(healthy + most, len(record))
    if answer.parts and healthy:
        first, last = looked_at(replace(answer, held=(first, last)))
    if last - first < len(record):
        why = "where the residual is largest" if first > healthy or not healthy else "after those stated to be without fault"
        source = "the fault signal is from all samples, the model from the healthy ones"
        source = source if healthy else "the model and the fault signal are from all samples"
        why += ", counted over all experiments one after the other" if answer.parts else ""
        notes += (f"faults are counted, and their space is found, on samples {first} to {last - 1}, {why}; {source}",)
    answer = replace(answer, held=(first, last), notes=notes)
    try:
        answer = _counted(answer, faults, on_progress)
    except np.linalg.LinAlgError:
        answer = _counted_before(answer, faults, on_progress)
    if faults is None:
        return answer
    by_data = answer.n_v if answer.n_v is not None else " or ".join(map(str, answer.possible)) or "undecided"
    agreement = "as the data say" if faults == answer.n_v else f"the data say {by_data}: {answer.reason}"
    return replace(answer, n_v=faults, possible=(faults,), reason=f"{faults} given; {agreement}", counted_by="given")


def _counted(answer: Findings, faults: int | None, on_progress: Progress) -> Findings:
    """Count on the samples that are held. Raises LinAlgError where numbers are too unequal."""
    rest, r = answer.residual, beyond_rounding(answer)
    assert rest is not None
    answer = _by_ranks(answer, r)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        # Not those set to zero: rounding is held against rounding.
        if answer.healthy:
            answer = _against_healthy(answer, rest.store.read(*answer.held), faults, on_progress)
        else:
            answer = _about_zero(answer if answer.exact else for_each(_by_laws(answer, on_progress), with_changes), r)
        return beside_changes(answer)


def _counted_before(answer: Findings, faults: int | None, on_progress: Progress) -> Findings:
    """Count on the samples before the residual has grown beyond what can be computed with, as it does where a fault opens a loop that is
    unstable without it; where there are none, nothing is counted."""
    first, grown = answer.held[0], _grows(answer)
    if grown - first > 2 * answer.block_rows:
        note = (
            f"from sample {grown} on the residual is more than {UNEQUAL:.0f} times its healthy size, as where a loop has become unstable: "
            f"faults are counted, and their space is found, on samples {first} to {grown - 1}"
        )
        with suppress(np.linalg.LinAlgError):
            return _counted(replace(answer, held=(first, grown), notes=(*answer.notes, note)), faults, on_progress)
    reason = "numbers of the residual are too unequal to compute with, as outliers make them: mend the record there"
    return replace(answer, n_v=None, counted_by=None, reason=reason)


def _grows(answer: Findings) -> int:
    """Return the first sample held at which the residual is UNEQUAL times its healthy size; the first one where nothing is healthy."""
    rest, sizes, until = answer.residual, answer.sizes, answer.healthy
    first, last = answer.held
    if not until or rest is None or sizes is None or answer.parts:
        return first
    sigma = sizes.early_norm / np.sqrt(until)
    large = np.any(np.abs(rest.store.read(first, last)) > UNEQUAL * np.where(sigma > 0, sigma, np.inf), axis=1)
    return first + int(np.argmax(large)) if np.any(large) else first


def _by_ranks(answer: Findings, r: Array) -> Findings:
    """Count by the ranks of the residual r on the samples held, beside the inputs."""
    record, sizes = answer.record, answer.sizes
    assert sizes is not None
    try:
        y, u = record.stretch(*looked_at(answer))
        # Beside an estimated model, what it errs by is small and has no clear rank; outputs and inputs have theirs without it.
        r = y if answer.exact and isinstance(answer.model, ReducedModel) else r
        found = fault_dimension(r.astype(np.float32) if record.single and answer.exact else r, u=u)
    except InvalidData as error:
        return replace(answer, reason=str(error))
    seen = int(np.sum(sizes.peak > ROUNDING * largest(record)))
    if found.n_v and found.n_v >= seen and seen < record.p:
        found = replace(found, n_v=None, reason=f"{found.reason}; but so many outputs are not explained to rounding: {AS_MANY}")
    independent = np.linalg.matrix_rank((y - y.mean(axis=0)) / np.maximum(y.std(axis=0), TINY), tol=DEPENDENT * np.sqrt(y.size))
    if found.n_v and found.n_v >= independent < record.p:
        copies = f"but the {record.p} outputs are combinations of {independent} of them, as copies are: leave the others out"
        found = replace(found, n_v=None, reason=f"{found.reason}; {copies}, for {AS_MANY}")
    by = None if found.n_v is None else "residual alone"
    return replace(answer, dimension=found, n_v=found.n_v, reason=found.reason, counted_by=by)


def _by_laws(answer: Findings, on_progress: Progress) -> Findings:
    """Count by the laws of outputs and inputs on the samples held, for systems of the model's order or less."""
    record, model, ranks = answer.record, answer.model, answer.dimension
    assert model is not None
    order = max(model.order, 1)
    if not affordable(record.p + record.n_u, order + LONG):
        outputs = counted(record.p, "output")
        note = f"order {model.order} is too high for the laws of {outputs} and of the inputs: the residual alone is counted"
        return replace(answer, notes=(*answer.notes, note))
    on_progress("counting the laws of outputs and inputs", 0, 0)
    data = about_own_means(record.stretches(*answer.held))
    try:
        same = answer.held == (0, len(record)) and answer.modelled == len(record)
        given = model if same and isinstance(model, ReducedModel) else None
        count = count_faults(*data, order=order, noise_level=answer.noise_level, model=given)
    except (InvalidData, np.linalg.LinAlgError) as error:
        return replace(answer, notes=(*answer.notes, f"the laws of outputs and inputs were not counted, the residual alone was: {error}"))
    answer = replace(answer, count=count, possible=count.possible)
    if count.n_v == 0 and ranks is not None and ranks.n_v:
        reason = f"{count.reason}; but the residual shows {ranks.n_v}: {ranks.reason}"
        return replace(answer, n_v=None, possible=tuple(range(ranks.n_v + 1)), reason=reason, counted_by=None)
    if count.n_v == 0 and (spikes := _spikes(answer)):
        return replace(answer, n_v=None, possible=(), reason=f"{count.reason}; but {spikes}", counted_by=None)
    return replace(answer, n_v=count.n_v, reason=count.reason, counted_by=None if count.n_v is None else "outputs and inputs")


def _spikes(answer: Findings) -> str:
    """Return which outputs have samples in their residual that normal noise would not have, empty where none has: no spectrum shows spikes.

    Of N normal numbers, dependent or not, one exceeds t deviations with a probability of at most N times that of a single one. The
    deviation is told by the median of the sizes, which spikes hardly move.
    """
    assert answer.residual is not None
    first, last = answer.held
    inside = [(max(first, start), min(last, stop)) for start, stop in answer.record.bounds if max(first, start) < min(last, stop)]
    parts = [answer.residual.store.read(*part) for part in inside]
    sizes = np.abs(np.concatenate([r - np.median(r, axis=0) for r in parts]))
    deviation = np.median(sizes, axis=0) / scipy.special.ndtri(0.75)
    most = -scipy.special.ndtri(UNLIKELY / (2 * sizes.size))
    spiky = [name for name, peak, one in zip(answer.record.outputs, sizes.max(axis=0), deviation, strict=True) if peak > most * one]
    return (
        f"the residual of {', '.join(map(shorten, spiky))} has spikes beyond {most:.2g} deviations, as normal noise has not"
        if spiky
        else ""
    )


def _about_zero(answer: Findings, r: Array) -> Findings:
    """Hold the mean of the residual against zero, where there are no healthy samples and it was not removed. It decides nothing but that 0
    is too much said, since a constant fault over a whole record cannot be told from an operating point."""
    if answer.n_v == 0 and answer.count is None:
        answer = replace(answer, reason=f"{answer.reason}; {NO_CONSTANT}")
    if answer.means_removed:
        if answer.n_v == 0 and not answer.operating_point.stated:
            reason = (
                f"{answer.reason}; but a constant fault would have gone with the means, which are the operating point unless one acts: "
                'operating_point="means" says that none does'
            )
            return replace(answer, n_v=None, possible=(), reason=reason, counted_by=None)
        return answer
    mean = mean_about_zero(r[:MEANS_FROM])
    notes = answer.notes
    if mean.shifted:
        notes += (
            f"the residual is not about zero ({mean.reason}): an operating point, or a constant fault; which of them, only samples without "
            "fault can tell (healthy=K)",
        )
        if answer.n_v == 0 and answer.count is not None:
            reason = f"{answer.count.reason}; but the residual is not about zero: an operating point, or a constant fault"
            answer = replace(answer, n_v=None, possible=(), reason=reason, counted_by=None)
    return replace(answer, mean=mean, notes=notes)


def _against_healthy(answer: Findings, r: Array, faults: int | None, on_progress: Progress) -> Findings:
    """Count the faults in the residual r of `answer` against the samples stated to be without fault, of which the last HELD numbers are
    held, and beside the test of the mean."""
    record, rest, sizes, until = answer.record, answer.residual, answer.sizes, answer.healthy
    assert rest is not None and sizes is not None and until is not None
    if np.all(sizes.early_peak <= ROUNDING * largest(record)):
        return _zero_or_not(replace(answer, unexplained=True))
    on_progress("counting faults against the healthy samples", 0, 0)
    answer = for_each(answer, with_changes)
    start = max(until - HELD // (record.p + record.n_u), 0)
    healthy, before, u = rest.store.read(start, until), record.stretch(start, until)[1], record.stretch(*answer.held)[1]
    last = slice(-MEANS_FROM, None)
    mean = mean_shift(r[:MEANS_FROM], u[:MEANS_FROM], healthy[last], before[last], gain_errors=gain_errors(answer.model))
    if rest.fitted:
        mean = replace(mean, shifted=None, reason="the model is too unstable to be run on from the healthy samples", visible=None)
    answer = replace(answer, mean=mean)
    driven = beyond_healthy_inputs(before, u, record.inputs)
    if mean.shifted and (doubt := doubt_of_means(answer, until, before, u)):
        answer = replace(answer, mean=replace(mean, shifted=None, reason=doubt, visible=None))
    try:
        reference = healthy_reference(healthy, before)
        against = fault_dimension_against_healthy(r, reference, u=u)
    except InvalidData as error:
        answer = replace(answer, notes=(*answer.notes, f"faults were not counted against samples {start} to {until - 1}: {error}"))
        return _zero_or_not(unlike_healthy_ranks(answer, healthy, before))
    if driven and against.n_v != 0:
        return _zero_or_not(
            replace(answer, notes=(*answer.notes, f"faults were not counted against samples {start} to {until - 1}: {driven}"))
        )
    strange = unlike_healthy(r, healthy, record.stretch(*answer.held)[0], record.stretch(start, until)[0], record.outputs)
    if strange and against.n_v == 0:
        against = replace(against, n_v=None, reason=f"{against.reason}; but {strange}")
        # Ranks of the residual alone would count the noise of the other outputs as faults beside a dead one.
        answer = replace(answer, n_v=None, counted_by=None, reason=against.reason)
    answer = replace(answer, counted_against=(start, until), against=against, visible=visible_white_faults(reference, against, POWER))
    if asked := faults or against.n_v:
        answer = replace(answer, news=_news(answer, r, u, healthy, before, asked))
    if against.n_v is not None:
        answer = replace(answer, n_v=against.n_v, reason=against.reason, counted_by="healthy samples")
        answer = _beside_news(answer)
        answer = _beside_laws(answer, healthy, on_progress)
    return _zero_or_not(answer)


def _news(answer: Findings, r: Array, u: Array, healthy: Array, before: Array, faults: int) -> int | None:
    """Return how many of so many faults are more than residual and inputs foretell, in the longest stretch between two onsets: a predictor
    that is fitted over a jump has all of its coefficients bent. Where these are too short it is the whole."""
    assert answer.model is not None
    order, last, (first, stop) = answer.model.order, slice(-MEANS_FROM, None), answer.held
    onsets = [one for one in (answer.onset.onsets if answer.onset is not None else ()) if first <= one.sample < stop]
    stretches = [(one.stretch[0] - first, min(one.stretch[1], stop) - first) for one in onsets]
    begin, end = max(stretches, key=lambda part: part[1] - part[0], default=(0, stop - first))
    for part in (slice(begin, min(end, begin + MEANS_FROM)), slice(0, MEANS_FROM)):
        found = news_beyond_healthy(r[part], u[part], healthy[last], before[last], n_v=faults, order=order)
        if found is not None:
            return found
    return None


def _beside_news(answer: Findings) -> Findings:
    """Leave several faults undecided where fewer are more than residual and inputs foretell: against healthy samples the direction of one
    fault, as of a gain that has changed, may turn within a frequency's width and count twice."""
    news, n_v = answer.news, answer.n_v
    if n_v is None or n_v < 2 or news is None or news >= n_v:
        return answer
    reason = (
        f"{answer.reason}; but {news} of them {'is' if news == 1 else 'are'} more than residual and inputs foretell: one fault whose "
        "direction turns with the frequency, as of a gain that has changed, counts twice"
    )
    return replace(answer, n_v=None, possible=tuple(range(max(news, 1), n_v + 1)), counted_by=None, reason=reason)


def _beside_laws(answer: Findings, healthy: Array, on_progress: Progress) -> Findings:
    """Leave a number of faults counted against the residual of the healthy samples (K, p) undecided where outputs and inputs
    do not obey the p - n_v laws that they should. Against healthy samples directions are counted at each frequency, so that faults in
    separate bands count as one; laws hold at all frequencies at once. They are heeded where they find no fault among the healthy samples:
    else it is the noise that has not the shape which they take for granted."""
    n_v, p = answer.n_v, answer.record.p
    if not n_v or n_v == p or not np.all(np.ptp(healthy, axis=0) > 0.0):
        return answer
    laws = _by_laws(replace(answer, noise_level=np.std(healthy, axis=0)), on_progress).count
    if laws is None or all(each.holds is not False for each in laws.tests if each.count <= p - n_v):
        return answer
    first, last = answer.counted_against
    silent = _by_laws(replace(answer, held=(first, last), noise_level=None), on_progress).count
    if silent is None or silent.n_v != 0:
        return answer
    reason = (
        f"{answer.reason}; but outputs and inputs do not obey {counted(p - n_v, 'law')} of so many states: more faults act, for in "
        "separate bands they count as one against healthy samples, or the order is too low"
    )
    return replace(answer, n_v=None, possible=tuple(range(n_v, p + 1)), counted_by=None, reason=reason)


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
