"""Count the faults of `identify`: by the laws of outputs and inputs, against healthy samples, or by the ranks of the residual.

counted_faults   the count, with what remains possible and the reasons, beside all evidence

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
from ....base.errors import InvalidData
from ....base.progress import Progress
from ....base.sheets import counted
from ...method.model.reduced_model import ReducedModel
from ...method.ranks.rank_gap import FaultDimension, fault_dimension
from ...method.rows.evidence import LONG
from ...method.rows.fault_count import FaultCount, count_faults
from ...method.rows.joint import affordable
from ...method.space.shift_isolation import gain_errors
from ..changes.onset import FaultOnset
from ..changes.table import Changes
from ..healthy.against_healthy import fault_dimension_against_healthy
from ..healthy.detectable import visible_white_faults
from ..healthy.healthy_model import healthy_reference
from ..healthy.mean_shift import POWER, MeanShift, mean_about_zero, mean_shift
from ..healthy.news import news_beyond_healthy
from ..healthy.unlike_healthy import beyond_healthy_inputs, unlike_healthy
from .changing import beside_changes, changes_in, unlike_healthy_ranks
from .choice import MEANS_FROM, ROUNDING, about_own_means, beyond_rounding, largest
from .explaining import doubt_of_means, looked_at, most_held
from .findings import Because, Count, Counted, CountedBy, Explained, Reason
from .words import said

DEPENDENT = 1e-10  # singular values of the scaled outputs, beside the largest they could have, below which a channel is a combination
UNLIKELY = 1e-6  # probability of spikes that is not put down to noise
UNEQUAL = float(np.finfo(np.float64).eps ** -0.25)  # ratio of numbers whose squares keep half of their digits side by side
TINY = float(np.finfo(np.float64).tiny)


def counted_faults(plant: Explained, onset: FaultOnset | None, faults: int | None, on_progress: Progress) -> Counted:
    """Count the faults, from the residual beside the inputs; `onset` is that of the one experiment, and `faults` a number that is given."""
    on_progress("counting faults", 0, 0)
    try:
        found = _counted(plant, onset, faults, on_progress)
    except np.linalg.LinAlgError:
        found = _counted_before(plant, onset, faults, on_progress)
    found = replace(found, notes=_counted_on(plant) + found.notes)
    if faults is None:
        return found
    count = found.count
    agrees = Reason(Because.GIVEN, {"n_v": faults, "counted": count.n_v, "possible": list(count.possible)})
    return replace(found, count=Count(faults, (faults,), CountedBy.GIVEN, (*count.because, agrees)))


def _counted_on(plant: Explained) -> tuple[str, ...]:
    """Say which samples faults are counted on, where these are not all."""
    (first, last), healthy = plant.held, plant.healthy
    if last - first == len(plant.record):
        return ()
    why = "where the residual is largest" if first > (healthy or 0) or not healthy else "after those stated to be without fault"
    source = "the fault signal is from all samples, the model from the healthy ones"
    source = source if healthy else "the model and the fault signal are from all samples"
    why += ", counted over all experiments one after the other" if plant.parts else ""
    return (f"faults are counted, and their space is found, on samples {first} to {last - 1}, {why}; {source}",)


def _counted(plant: Explained, onset: FaultOnset | None, faults: int | None, on_progress: Progress) -> Counted:
    """Count on the samples that are held. Raises LinAlgError where numbers are too unequal."""
    r = beyond_rounding(plant)
    ranks, by_ranks = _by_ranks(plant, r)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        if not plant.healthy:
            found = _by_itself(plant, r, by_ranks, on_progress)
        elif np.all(plant.sizes.early_peak <= ROUNDING * largest(plant.record)):
            found = Counted(by_ranks if by_ranks.n_v else by_ranks.but(Reason(Because.UNEXPLAINED)), plant.held, unexplained=True)
        else:
            found = _against_healthy(plant, onset, by_ranks, faults, on_progress)
    return replace(found, count=beside_changes(found.count, found.changes), ranks=ranks, by_ranks=by_ranks)


def _counted_before(plant: Explained, onset: FaultOnset | None, faults: int | None, on_progress: Progress) -> Counted:
    """Count on the samples before the residual has grown beyond what can be computed with, as it does where a fault opens a loop that is
    unstable without it; where there are none, nothing is counted."""
    first, grown = plant.held[0], _grows(plant)
    if grown - first > 2 * plant.block_rows:
        note = (
            f"from sample {grown} on the residual is more than {UNEQUAL:.0f} times its healthy size, as where a loop has become unstable: "
            f"faults are counted, and their space is found, on samples {first} to {grown - 1}"
        )
        with suppress(np.linalg.LinAlgError):
            found = _counted(replace(plant, held=(first, grown)), onset, faults, on_progress)
            return replace(found, notes=(note, *found.notes))
    return Counted(Count(None, (), None, (Reason(Because.UNEQUAL_NUMBERS),)), plant.held)


def _grows(plant: Explained) -> int:
    """Return the first sample held at which the residual is UNEQUAL times its healthy size; the first one where nothing is healthy."""
    first, last = plant.held
    if not plant.healthy or plant.parts:
        return first
    sigma = plant.sizes.early_norm / np.sqrt(plant.healthy)
    large = np.any(np.abs(plant.residual.store.read(first, last)) > UNEQUAL * np.where(sigma > 0, sigma, np.inf), axis=1)
    return first + int(np.argmax(large)) if np.any(large) else first


def _by_ranks(plant: Explained, r: Array) -> tuple[FaultDimension | None, Count]:
    """Count by the ranks of the residual r on the samples held, beside the inputs."""
    record = plant.record
    try:
        y, u = record.stretch(*looked_at(plant))
        # Beside an estimated model, what it errs by is small and has no clear rank; outputs and inputs have theirs without it.
        r = y if plant.exact and isinstance(plant.model, ReducedModel) else r
        found = fault_dimension(r.astype(np.float32) if record.single and plant.exact else r, u=u)
    except InvalidData as error:
        return None, Count(None, (), None, (Reason(Because.RANKS, {"n_v": None}, str(error)),))
    by = None if found.n_v is None else CountedBy.RANKS
    count = Count(found.n_v, (), by, (Reason(Because.RANKS, {"n_v": found.n_v, "regime": found.regime}, found.reason),))
    seen = int(np.sum(plant.sizes.peak > ROUNDING * largest(record)))
    if count.n_v and count.n_v >= seen and seen < record.p:
        count = count.but(Reason(Because.AS_MANY_AS_OUTPUTS, {"unexplained": seen}))
    independent = int(np.linalg.matrix_rank((y - y.mean(axis=0)) / np.maximum(y.std(axis=0), TINY), tol=DEPENDENT * np.sqrt(y.size)))
    if count.n_v and count.n_v >= independent < record.p:
        count = count.but(Reason(Because.COPIES, {"p": record.p, "independent": independent}))
    return found, count


def _by_itself(plant: Explained, r: Array, by_ranks: Count, on_progress: Progress) -> Counted:
    """Count where no samples are stated to be healthy: by laws, or by ranks where the record is exact."""
    count, laws, notes = by_ranks, None, tuple[str, ...]()
    tables: tuple[Changes | None, ...] = ()
    if not plant.exact:
        laws, notes = _laws(plant, plant.held, plant.noise_level, on_progress)
        count = count if laws is None else _by_laws(plant, laws, by_ranks)
        tables = tuple(changes_in(one) for one in plant.experiments)
    count, mean, more = _about_zero(plant, r, count, laws)
    return Counted(count, plant.held, notes + more, tables, laws=laws, mean=mean)


def _laws(
    plant: Explained, held: tuple[int, int], noise_level: Array | None, on_progress: Progress
) -> tuple[FaultCount | None, tuple[str, ...]]:
    """Return the laws of outputs and inputs on these samples, for systems of the model's order or less, or why they were not counted."""
    record, model = plant.record, plant.model
    order = max(model.order, 1)
    if not affordable(record.p + record.n_u, order + LONG):
        outputs = counted(record.p, "output")
        return None, (f"order {model.order} is too high for the laws of {outputs} and of the inputs: the residual alone is counted",)
    on_progress("counting the laws of outputs and inputs", 0, 0)
    same = held == (0, len(record)) and plant.healthy in (None, 0, len(record))
    given = model if same and isinstance(model, ReducedModel) else None
    try:
        return count_faults(*about_own_means(record.stretches(*held)), order=order, noise_level=noise_level, model=given), ()
    except (InvalidData, np.linalg.LinAlgError) as error:
        return None, (f"the laws of outputs and inputs were not counted, the residual alone was: {error}",)


def _by_laws(plant: Explained, laws: FaultCount, by_ranks: Count) -> Count:
    """Return the count by laws; their 0 stands where the residual shows no rank and no spikes."""
    by = None if laws.n_v is None else CountedBy.LAWS
    count = Count(laws.n_v, laws.possible, by, (Reason(Because.LAWS, {"n_v": laws.n_v}, laws.reason),))
    if laws.n_v != 0:
        return count
    if by_ranks.n_v:
        shown = Reason(Because.RANKS_SHOW_FAULTS, {"n_v": by_ranks.n_v}, said(by_ranks.because))
        return count.but(shown, tuple(range(by_ranks.n_v + 1)))
    spikes = _spikes(plant)
    return count if spikes is None else count.but(spikes, ())


def _spikes(plant: Explained) -> Reason | None:
    """Return which outputs have samples in their residual that normal noise would not have, None where none has: no spectrum shows spikes.

    Of N normal numbers, dependent or not, one exceeds t deviations with a probability of at most N times that of a single one. The
    deviation is told by the median of the sizes, which spikes hardly move.
    """
    first, last = plant.held
    inside = [(max(first, start), min(last, stop)) for start, stop in plant.record.bounds if max(first, start) < min(last, stop)]
    parts = [plant.residual.store.read(*part) for part in inside]
    sizes = np.abs(np.concatenate([r - np.median(r, axis=0) for r in parts]))
    deviation = np.median(sizes, axis=0) / scipy.special.ndtri(0.75)
    most = float(-scipy.special.ndtri(UNLIKELY / (2 * sizes.size)))
    spiky = [name for name, peak, one in zip(plant.record.outputs, sizes.max(axis=0), deviation, strict=True) if peak > most * one]
    return Reason(Because.SPIKES, {"outputs": spiky, "deviations": most}) if spiky else None


def _about_zero(plant: Explained, r: Array, count: Count, laws: FaultCount | None) -> tuple[Count, MeanShift | None, tuple[str, ...]]:
    """Hold the mean of the residual against zero, where there are no healthy samples and it was not removed. It decides nothing but that 0
    is too much said, since a constant fault over a whole record cannot be told from an operating point."""
    if count.n_v == 0 and laws is None:
        count = count.also(Reason(Because.CONSTANT_UNSEEN))
    if plant.means_removed:
        if count.n_v == 0 and not plant.operating_point.stated:
            count = count.but(Reason(Because.WENT_WITH_MEANS), ())
        return count, None, ()
    mean = mean_about_zero(r[:MEANS_FROM])
    if not mean.shifted:
        return count, mean, ()
    if count.n_v == 0 and laws is not None:
        count = count.but(Reason(Because.NOT_ABOUT_ZERO), ())
    note = (
        f"the residual is not about zero ({mean.reason}): an operating point, or a constant fault; which of them, only samples without "
        "fault can tell (healthy=K)"
    )
    return count, mean, (note,)


def _against_healthy(plant: Explained, onset: FaultOnset | None, by_ranks: Count, faults: int | None, on_progress: Progress) -> Counted:
    """Count the faults against the samples stated to be without fault, of which the last are held, as many as faults are counted on, and
    beside the test of the mean."""
    record, store, until = plant.record, plant.residual.store, plant.healthy
    assert until is not None
    on_progress("counting faults against the healthy samples", 0, 0)
    tables = tuple(changes_in(one) for one in plant.experiments)
    start = max(until - most_held(record), 0)
    # Not the residual set to zero where it is rounding: rounding is held against rounding.
    r, healthy = store.read(*plant.held), store.read(start, until)
    (y, u), (y_before, before) = record.stretch(*plant.held), record.stretch(start, until)
    mean = _mean_against(plant, (r, u), (healthy, before))
    driven = beyond_healthy_inputs(before, u, record.inputs)
    try:
        reference = healthy_reference(healthy, before)
        against = fault_dimension_against_healthy(r, reference, u=u)
    except InvalidData as error:
        note = f"faults were not counted against samples {start} to {until - 1}: {error}"
        count = _zero_or_not(plant, unlike_healthy_ranks(by_ranks, tables, healthy, before), mean, None)
        return Counted(count, plant.held, (note,), tables, mean=mean)
    if driven and against.n_v != 0:
        note = f"faults were not counted against samples {start} to {until - 1}: {driven}"
        return Counted(_zero_or_not(plant, by_ranks, mean, None), plant.held, (note,), tables, mean=mean)
    by = None if against.n_v is None else CountedBy.HEALTHY
    by_healthy = Count(against.n_v, (), by, (Reason(Because.AGAINST_HEALTHY, {"n_v": against.n_v}, against.reason),))
    strange = unlike_healthy(r, healthy, y, y_before, record.outputs)
    count, news = by_ranks, None
    if strange and against.n_v == 0:
        # Ranks of the residual alone would count the noise of the other outputs as faults beside a dead one.
        count = by_healthy = by_healthy.but(Reason(Because.UNLIKE_HEALTHY, said=strange))
    if asked := faults or by_healthy.n_v:
        news = _news(plant, onset, r, u, healthy, before, asked)
    if by_healthy.n_v is not None:
        count = _beside_laws(plant, _beside_news(by_healthy, news), healthy, (start, until), on_progress)
    return Counted(
        _zero_or_not(plant, count, mean, by_healthy),
        plant.held,
        changes=tables,
        mean=mean,
        against=against,
        by_healthy=by_healthy,
        against_samples=(start, until),
        news=news,
        visible=visible_white_faults(reference, against, POWER),
    )


def _mean_against(plant: Explained, after: tuple[Array, Array], before: tuple[Array, Array]) -> MeanShift:
    """Return the test of the mean of the residual and its inputs `after` against those `before`, undecided where it has no ground."""
    (r, u), (healthy, u_before), last = after, before, slice(-MEANS_FROM, None)
    mean = mean_shift(r[:MEANS_FROM], u[:MEANS_FROM], healthy[last], u_before[last], gain_errors=gain_errors(plant.model))
    if plant.residual.fitted:
        return replace(mean, shifted=None, reason="the model is too unstable to be run on from the healthy samples", visible=None)
    doubt = doubt_of_means(plant, plant.healthy or 0, u_before, u) if mean.shifted else ""
    return replace(mean, shifted=None, reason=doubt, visible=None) if doubt else mean


def _news(plant: Explained, onset: FaultOnset | None, r: Array, u: Array, healthy: Array, before: Array, faults: int) -> int | None:
    """Return how many of so many faults are more than residual and inputs foretell, in the longest stretch between two onsets: a predictor
    that is fitted over a jump has all of its coefficients bent. Where these are too short it is the whole."""
    last, (first, stop) = slice(-MEANS_FROM, None), plant.held
    onsets = [one for one in (onset.onsets if onset is not None else ()) if first <= one.sample < stop]
    stretches = [(one.stretch[0] - first, min(one.stretch[1], stop) - first) for one in onsets]
    begin, end = max(stretches, key=lambda part: part[1] - part[0], default=(0, stop - first))
    for part in (slice(begin, min(end, begin + MEANS_FROM)), slice(0, MEANS_FROM)):
        found = news_beyond_healthy(r[part], u[part], healthy[last], before[last], n_v=faults, order=plant.model.order)
        if found is not None:
            return found
    return None


def _beside_news(count: Count, news: int | None) -> Count:
    """Leave several faults undecided where fewer are more than residual and inputs foretell: against healthy samples the direction of one
    fault, as of a gain that has changed, may turn within a frequency's width and count twice."""
    n_v = count.n_v
    if n_v is None or n_v < 2 or news is None or news >= n_v:
        return count
    return count.but(Reason(Because.FORETOLD, {"news": news}), tuple(range(max(news, 1), n_v + 1)))


def _beside_laws(plant: Explained, count: Count, healthy: Array, against: tuple[int, int], on_progress: Progress) -> Count:
    """Leave a number of faults counted against the residual of the healthy samples (K, p) undecided where outputs and inputs
    do not obey the p - n_v laws that they should. Against healthy samples directions are counted at each frequency, so that faults in
    separate bands count as one; laws hold at all frequencies at once. They are heeded where they find no fault among the healthy samples:
    else it is the noise that has not the shape which they take for granted."""
    n_v, p = count.n_v, plant.record.p
    if not n_v or n_v == p or not np.all(np.ptp(healthy, axis=0) > 0.0):
        return count
    laws, _ = _laws(plant, plant.held, np.std(healthy, axis=0), on_progress)
    if laws is None or all(each.holds is not False for each in laws.tests if each.count <= p - n_v):
        return count
    silent, _ = _laws(plant, against, None, on_progress)
    if silent is None or silent.n_v != 0:
        return count
    return count.but(Reason(Because.LAWS_BROKEN, {"laws": p - n_v}), tuple(range(n_v, p + 1)))


def _zero_or_not(plant: Explained, count: Count, mean: MeanShift, by_healthy: Count | None) -> Count:
    """Leave 0 only where nothing was counted, against the healthy samples if possible, and the mean is known not to have moved."""
    if count.n_v or (count.n_v is None and not mean.shifted):
        return count
    if mean.shifted:
        return count.but(Reason(Because.MEAN_MOVED, {"outputs": [plant.record.outputs[i] for i in mean.channels]}, mean.reason))
    if mean.shifted is None:
        return count.but(Reason(Because.MEAN_OPEN, said=mean.reason))
    if by_healthy is not None and by_healthy.n_v is None:
        return Count(None, count.possible, None, by_healthy.because)
    return count.also(Reason(Because.MEAN_STAYED, said=mean.reason))
