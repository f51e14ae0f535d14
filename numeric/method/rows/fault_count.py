"""Count the faults in a record of outputs and inputs by the laws that these still obey, without a model or a residual.

With m faults, k = p - m polynomial rows annihilate [y; u] up to noise, and no more (`joint.py`). So the question for every k is whether
k rows of total degree n are laws (`law_tests.py`), and the number of faults is p less the most that are. All p are asked first, which takes
no rows; then so many as the disturbance of an ARX model shows, and their neighbours; bisection finds the place where that misleads.

    k = p     no fault: what a model leaves of y is noise of one colour; noise shares of the channels are estimated. A 0 without a noise
              level rests on the powers found in this way, and says so; where what is left is unrelated between the outputs, an undecided
              answer keeps 0, for noise of unlike colours is unrelated, too
    k >= 2    sphericity and flatness, both with a probability; noise shares are estimated
    k = 1     flatness alone: one row leaves one signal, which any noise could be. So a last fault that is as faint as the noise looks
              like noise: the answer p - 1 rests on the assumption that no fault is fainter than FAINTEST beside the one before it; where
              the step from two rows to one is less, the answer is "p - 1 or p"
    known     a `noise_level` of the channels settles that: the remainder of laws has no more than that power, to a factor KNOWN_TO,
              and where it is beyond KNOWN_FAR there is another fault. Rows that would be laws but for that contradict the level: either it
              is stated too low, or faults look like noise, and the answer is undecided

A fault in one output alone with the colour of the noise is noise by every statistic of such a record, and so are p faults that are white
and of equal power in all outputs. n_v = p is answered only where the noise level is known. Without noise the ranks of `fault_dimension`
count, which are exact. Of an order that is too low fewer rows than there are may be laws; so the answer is asked again with EXTRA degrees
more, where one row more must still be none.

KNOWN_TO and KNOWN_FAR are what a stated level means. FAINTEST is an assumption, and no theory gives it: how faint a last fault may be.
It is the step that one in a hundred records with as many faults as outputs reaches while its single row is accepted:
`benchmarks/counting_at_the_bound.py faintest` prints that quantile, for short records and long ones, and what it costs where there is a
fault less. Flatness, and not the step, refuses p faults as a rule. It does so on long records, too: what a single row may gain is held
against the frequencies that this record's faults leave to the noise (`single_misfits`): a record of 30001 samples with 3 faults in 3
outputs (seed 261000) was answered by 2 while every long record was allowed for such frequencies, and it has none; its single row leaves a
remainder 4 nats below two, and it is undecided now. The constants that decide whether rows are laws stand in `law_tests.py`.

    count_faults    FaultCount: n_v, or "p - 1 or p", or undecided, the reason, and every test made
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted, decibels
from ....base.threads import one_thread
from ...data.plain import by_name
from ...data.records import Record
from ...data.validation import constant_channels, noise_deviations, positive, signals
from ..model.reduced_model import ReducedModel
from ..ranks.rank_gap import fault_dimension
from .evidence import EXTRA, LONG, Evidence, longest_degree
from .joint import ROUNDING, JointMoments, even_split
from .law_tests import FAILS, SUFFICES, Laws, bootstrapped, longer_are_laws, step_to_two, tested
from .remainder import unrelated

Experiments = Sequence[tuple[ArrayLike, ArrayLike]]
# Nats (10 dB) that the noise floor must lie below the faintest fault where only one row is left to see it.
FAINTEST = 2.4
# What a stated noise level means, as the docstring of `count_faults` says. Its power is right to 3 dB, a factor of 1.4 in deviation; and
# where the deviation is wrong by two, four in power, what is louder than both together is a fault in any case.
KNOWN_TO = 2.0
KNOWN_FAR = 4.0 * KNOWN_TO
# Coefficients of rows that are fitted at most: a step of a descent takes their cube, and those of 900 were not done in a hundred seconds on
# busy cores. It bounds the time and decides no number.
MOST = 500
# What no record can show, and 0 leaves out: the first always, the second where the noise is no louder than was stated. Where no level is
# stated, the condition of the answer speaks of noise.
NO_CONSTANT = "a fault that is constant over the whole record would not be seen"
NO_FAINT_NOISE = "nor would one of a single output that is noise of that colour within the stated level"
# Singular values of the scaled outputs below which a channel is a combination of others.
DEPENDENT = 1e-10


@dataclass(frozen=True, eq=False, repr=False)
class FaultCount(Shown):
    """The number of faults that `count_faults` finds, with what it rests on [W91].

    `n_v` is None where it is undecided; `possible` are the numbers that remain; `reason` says why. `tests`: what was asked of k rows, by
    falling k; empty where there was no noise. `noise_power`, of shape (p,): what the rows leave of each output, in its own units, squared;
    None where no rows are laws. `condition`: what the number rests on and no record can show; it is part of the title and of the reason,
    and empty where nothing is taken for granted. Look at `n_v` first, and where it is None at `reason`, which says what would settle it.
    Raises nothing itself.

    >>> from faultspace.numeric import FaultCount
    >>> FaultCount(None, (2, 3), "2 or 3: a fainter fault would look the same", ()).decided
    False
    """

    n_v: int | None
    possible: tuple[int, ...]
    reason: str
    tests: tuple[Laws, ...]
    noise_power: Array | None = None
    condition: str = ""

    @property
    def decided(self) -> bool:
        """This tells whether there is one answer."""
        return self.n_v is not None

    @property
    def title(self) -> str:
        """Return the answer, on one short line."""
        if self.n_v is not None:
            return f"number of faults n_v: {self.n_v}" + (f", if {self.condition}" if self.condition else "")
        return f"number of faults n_v: undecided, of {', '.join(map(str, self.possible))}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the reason, what was asked of so many rows, and the deviation of the noise that the rows leave."""
        yield "why", self.reason
        for laws in self.tests:
            one, several = {True: ("is a law", "are laws"), False: ("is no law", "are no laws"), None: ("in doubt",) * 2}[laws.holds]
            yield counted(laws.count, "row"), f"{one if laws.count == 1 else several}, probability {laws.probability:.2g}"
        if self.noise_power is not None:
            yield "deviation of the noise, by output", ", ".join(f"{size:.4g}" for size in np.sqrt(self.noise_power))

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: the answer, its reason and every test made; null stands for what there is not."""
        return by_name(self, "n_v", "possible", "reason", "tests", "noise_power")


@one_thread()
def count_faults(
    y: ArrayLike | Experiments | Record,
    u: ArrayLike | None,
    *,
    order: int,
    noise_level: ArrayLike | None = None,
    draws: int = 0,
    model: ReducedModel | None = None,
) -> FaultCount:
    """Decide how many independent faults act on outputs y with inputs u, where the system has this `order` or less.

    Operating points of experiments may differ where each is given about its own means; those too short for the rows that the longest one
    carries have no part, and the reason tells how many. Source: [W91] for the rows, [M82] and [W38] for the ratios.

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
        In any units; with `u` None, `y` is a list of pairs (y, u), experiments with initial states of their own, or a record.
    order : int
        Number of states, at most.
    noise_level : float or (p,), optional
        Standard deviation of the noise in each output, in units of y: taken as right to a factor of 1.4, it may be wrong by 2.
    draws : int
        Records of the parametric bootstrap for each k that is tried, by which the misfit of the stated laws is measured for this very
        record (20 will do, a quarter of a second each).
    model : ReducedModel, optional
        What `arx_reduction` found in these data: it saves time.

    Returns
    -------
    FaultCount
        `n_v`, None where it is undecided, with what remains `possible` and the tests.

    Raises
    ------
    InvalidData
        Shapes that do not fit, records too short for rows of degree order + 1, outputs that are constant, or combinations of others up to
        rounding.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import count_faults
    >>> rng = np.random.default_rng(0)
    >>> u, v = rng.standard_normal((600, 1)), rng.standard_normal((600, 1))
    >>> y = np.hstack([u + v, u - v, 2 * v]) + 0.01 * rng.standard_normal((600, 3))
    >>> count_faults(y, u, order=1).n_v
    1
    >>> count_faults([(y[:250], u[:250]), (y[300:], u[300:])], None, order=1).n_v
    1
    """
    return _count(_experiments(y, u), order, noise_level, draws, model)


def _experiments(y: ArrayLike | Experiments | Record, u: ArrayLike | None) -> list[tuple[Array, Array]]:
    """Return checked pairs y (N_i, p), u (N_i, n_u), one an experiment."""
    if u is not None:
        return [signals(cast(ArrayLike, y), u)]
    if isinstance(y, Record):
        return list(y.stretches(0, len(y)))
    if not isinstance(y, Sequence) or not y or not all(isinstance(one, tuple) and len(one) == 2 for one in y):
        raise InvalidData("u is missing: pass it, or a list of pairs (y, u), one an experiment, or a record")
    return [signals(*one) for one in cast(Experiments, y)]


def _count(
    experiments: Sequence[tuple[Array, Array]], order: int, noise_level: ArrayLike | None, draws: int, model: ReducedModel | None
) -> FaultCount:
    """Count the faults in checked experiments, and say how many of them had no part."""
    shapes = {(y.shape[1], u.shape[1]) for y, u in experiments}
    if len(shapes) > 1:
        raise InvalidData(f"experiments: got {[(y.shape, u.shape) for y, u in experiments]}; all need the same channels")
    p, n = experiments[0][0].shape[1], positive(order, "order")
    carried = min(n + LONG, max(longest_degree(*one) for one in experiments))
    used = [one for one in experiments if longest_degree(*one) >= carried]
    _measured(np.vstack([y for y, _ in used]))
    answer = _by_rows(Evidence(used, n, model), p, None if noise_level is None else noise_deviations(noise_level, p), draws)
    if answer.n_v == 0:
        unseen = (NO_CONSTANT,) if noise_level is None else (NO_CONSTANT, NO_FAINT_NOISE)
        answer = replace(answer, reason="; ".join([answer.reason, ", ".join(unseen)]))
    if len(used) == len(experiments):
        return answer
    left = f"{len(experiments) - len(used)} of {len(experiments)} experiments are too short for rows of degree {carried} and have no part"
    return replace(answer, reason=f"{answer.reason}; {left}")


def _by_rows(evidence: Evidence, p: int, level: Array | None, draws: int) -> FaultCount:
    """Count by kernel rows, with the deviations (p,) of the noise where they are stated."""
    n = evidence.order
    data = evidence.data
    known = None if level is None else level / data.scale[:p]
    shares = None if known is None else known**2 / np.exp(np.mean(np.log(known**2)))
    if not _exciting(data):
        reason = f"the inputs excite no more than {n + EXTRA} samples in a row: what they do and what faults do cannot be told apart"
        return FaultCount(None, tuple(range(p + 1)), reason, ())
    if _least_power(data, 0) < ROUNDING:
        return _by_ranks(evidence.experiments)
    tests: dict[int, Laws] = {}

    def laws(count: int) -> Laws:
        if count not in tests:
            quick = tested(evidence, count, shares)
            tests[count] = bootstrapped(evidence, quick, draws) if draws else quick
        return tests[count]

    # Invariant: `some` rows may be laws, `more` are not. Where more of them are laws, a doubt about fewer does not matter.
    some, more = 0, p + 1
    # That no fault acts is asked first, for it takes no rows: a model tells.
    if p > 1:
        some, more = (0, p) if _holds(laws(p), known) is False else (p, p + 1)
    # A single row is asked last, when two are none: flatness alone judges it.
    while more - some > 1 and more > 2:
        k = max(_next(some, more, evidence.apparent), 2)
        if k < p and (unknowns := _unknowns(data, n, k)) > MOST:
            reason = (
                f"{k} rows of {counted(data.moments.channels, 'channel')} have {unknowns} unknowns, of which no more than {MOST} are "
                "fitted: count groups of outputs, each for the faults that reach it"
            )
            return FaultCount(None, tuple(range(p - more + 1, p - some + 1)), reason, _walk(tests))
        some, more = (some, k) if _holds(laws(k), known) is False else (k, more)
    if not some:
        answer = _last(evidence, laws, tests, known)
    elif _holds(tests[some], known) is None:
        answer = _undecided(p, some, tests[some], tests)
    else:
        answer = _answer(p - some, tests[some], tests, data)
    if known is not None and answer.n_v is not None:
        answer = _believed(answer, evidence, tests, known)
    answer = _of_one_colour(answer, evidence, tests, known)
    # Of too low an order fewer rows than there are may be laws, and would count as more faults.
    refused = 0 if answer.n_v is None else p + 1 - answer.n_v
    if not 2 <= refused <= p:
        return answer
    if n + EXTRA >= evidence.longest:
        reason = f"the record is too short for rows of {EXTRA} degrees more, which would tell whether the order is too low"
    elif longer_are_laws(evidence, laws(refused), shares):
        reason = f"{refused} rows of {EXTRA} degrees more have about the shape of noise: the order may be too low"
    else:
        return answer
    return FaultCount(None, tuple(range(p + 2 - refused)), reason, answer.tests)


def _last(evidence: Evidence, laws: Callable[[int], Laws], tests: dict[int, Laws], known: Array | None) -> FaultCount:
    """Answer where no two rows are laws: p - 1, p, or either."""
    data, p, one = evidence.data, evidence.data.p, laws(1)
    if known is not None:
        longest = one.fit if one.longest is None else one.longest
        loud = _loudness(longest.level, longest.spectrum, known)
        if loud > KNOWN_FAR:
            reason = f"not even one row comes down to the noise level: its remainder has {loud:.3g} times that power"
            return FaultCount(p, (p,), reason, _walk(tests))
        if loud > KNOWN_TO:
            reason = (
                f"{p - 1} or {p}: one row leaves {loud:.3g} times the power of the stated noise, too much for laws, too little for a fault"
            )
            return FaultCount(None, (p - 1, p), reason, _walk(tests))
        if loud < 1 / KNOWN_TO:
            # The level is too high to be one, and settles nothing.
            known = None
    found = _holds(one, known)
    if found is None:
        return _undecided(p, 1, one, tests)
    if not found:
        reason = (
            f"{counted(p, 'fault')}, or an order above the one given: no row of its degree "
            f"leaves noise alone (probability {one.probability:.1g})"
        )
        return FaultCount(None, (p,), reason, _walk(tests))
    if known is not None:
        return _answer(p - 1, one, tests, data)
    if p == 1:
        reason = "0 or 1: of one output a fault cannot be told from noise of its colour; a noise_level would settle it"
        return FaultCount(None, (0, 1), reason, _walk(tests))
    step = step_to_two(evidence, one, laws(2))
    if step < FAINTEST:
        reason = (
            f"{p - 1} or {p}: one row leaves {decibels(step)} less than two, and a fault fainter than {decibels(FAINTEST)} beside the "
            "others would look the same; a noise_level would settle it"
        )
        return FaultCount(None, (p - 1, p), reason, _walk(tests))
    return _answer(p - 1, one, tests, data)


def _believed(answer: FaultCount, evidence: Evidence, tests: dict[int, Laws], known: Array) -> FaultCount:
    """Return the answer, undecided where only the stated level speaks against rows that are laws by all else that is asked of them."""
    p, refuted = len(known), [laws for laws in tests.values() if laws.holds and _holds(laws, known) is False]
    # Of a single row, what would decide without a level: that it stands far below two.
    single = 1 in tests and 2 in tests and step_to_two(evidence, tests[1], tests[2]) >= FAINTEST
    most = max((laws for laws in refuted if laws.count > 1 or single), key=lambda laws: laws.count, default=None)
    if most is None:
        return answer
    loud = _loudness(most.level, most.fit.spectrum, known)
    least = min((laws.count for laws in tests.values() if laws.holds is False), default=p + 1)
    reason = (
        f"{counted(most.count, 'row')} {'leaves' if most.count == 1 else 'leave'} what looks like noise (probability "
        f"{most.probability:.2g}), but {loud:.3g} times the power of the stated one: the noise_level is too low by {loud**0.5:.3g}, or so "
        "many more faults look like noise"
    )
    return FaultCount(None, tuple(range(p - least + 1, p + 1)), reason, answer.tests)


def _of_one_colour(answer: FaultCount, evidence: Evidence, tests: dict[int, Laws], known: Array | None) -> FaultCount:
    """Say what the answer takes for granted of the noise. That no fault acts rests on the powers that the noise is found to have. That one
    acts rests on the colour of the noise, the same in all outputs, where what disturbs them is unrelated between them: noise of unlike
    colours is so too, and where the count is undecided anyway it may be all that there is."""
    p = evidence.data.p
    if answer.n_v == 0:
        condition = "" if known is not None else "what is left of each output is noise, and no fault of single outputs like it"
    elif p > 1 and p in tests and _unrelated(evidence):
        condition = "the noise has one colour in all outputs"
    else:
        return answer
    if not condition:
        return answer
    if answer.n_v is not None:
        return replace(answer, condition=condition, reason=f"{answer.reason}, if {condition}")
    reason = f"{answer.reason}; what disturbs the outputs is unrelated between them: noise of unlike colours, or faults in single sensors"
    return replace(answer, possible=tuple(range(p + 1)), reason=reason)


def _unrelated(evidence: Evidence) -> bool:
    """Return whether what disturbs the outputs is unrelated between them; where the ARX model says clearly no, it is not reduced."""
    seen, left = evidence.disturbance, None
    if seen is not None and unrelated(seen) > FAILS:
        left = evidence.unexplained
    return left is not None and unrelated(left) >= SUFFICES


def _answer(n_v: int, found: Laws, tests: dict[int, Laws], data: JointMoments) -> FaultCount:
    """Return the count that follows where `found` are the most rows that are laws."""
    p = data.p
    verb = "leaves" if found.count == 1 else "leave"
    reason = f"{counted(found.count, 'row')} of outputs and inputs {verb} noise alone (probability {found.probability:.2g})"
    more = tests.get(found.count + 1)
    if more is not None:
        reason += f", {more.count} do not ({more.probability:.1g})"
    power = np.exp(found.level) * found.fit.spectrum.mean() * found.shares * data.scale[:p] ** 2
    return FaultCount(n_v, (n_v,), reason, _walk(tests), np.asarray(power))


def _undecided(p: int, k: int, near: Laws, tests: dict[int, Laws]) -> FaultCount:
    """Return the counts that remain possible where the k rows `near` are neither clearly laws nor clearly none."""
    most = max((count for count, laws in tests.items() if laws.holds), default=0)
    least = min((count for count, laws in tests.items() if laws.holds is False), default=p + 1)
    possible = tuple(range(max(p - least + 1, 0), p - most + 1))
    if near.sphericity is not None and near.sphericity.level >= SUFFICES:
        reason = (
            f"what {counted(k, 'row')} of this degree left has the shape of noise, but rows of {EXTRA} degrees more gain "
            f"{decibels(near.gain)}: try a higher order"
        )
    else:
        limits = f"accepted from {SUFFICES:g}; refused, of a single row below {FAILS:g}, of several far from the shape of noise"
        reason = f"{counted(k, 'row')} may or may not leave noise alone (probability {near.probability:.1g}, {limits})"
    return FaultCount(None, possible, reason, _walk(tests))


def _holds(laws: Laws, known: Array | None) -> bool | None:
    """Return whether they are laws; where the noise level is known, laws leave no more than it."""
    if known is not None and _loudness(laws.level, laws.fit.spectrum, known) > KNOWN_FAR:
        return False
    return laws.holds


def _loudness(level: float, spectrum: Array, known: Array) -> float:
    """Return the ratio of the noise power that rows leave to the known one, whose deviations (p,) are in units of the moments."""
    return float(np.exp(level - np.mean(np.log(known**2))) * spectrum.mean())


def _unknowns(data: JointMoments, order: int, rows: int) -> int:
    """Return how many coefficients so many rows of this total degree have."""
    return sum(data.moments.channels * (degree + 1) for degree in even_split(order, rows))


def _next(some: int, more: int, guess: int) -> int:
    """Return the number of rows to ask of next: the guess, then its neighbours, then half way."""
    if some < guess < more:
        return guess
    if some == guess:
        return some + 1
    return more - 1 if more == guess else (some + more) // 2


def _exciting(data: JointMoments) -> bool:
    """Return whether the windows of the inputs have full rank: else a row of inputs alone is a law, whatever the outputs do."""
    return data.n_u == 0 or _least_power(data, data.p) >= ROUNDING


def _least_power(data: JointMoments, first: int) -> float:
    """Return the least power of a combination, of unit norm, of the windows of the channels from `first` on."""
    power = data.moments.moments.sum(axis=0).real
    chosen = np.arange(len(power)) % data.moments.channels >= first
    return float(scipy.linalg.eigvalsh(power[np.ix_(chosen, chosen)], subset_by_index=(0, 0))[0])


def _by_ranks(experiments: Sequence[tuple[Array, Array]]) -> FaultCount:
    """Count by the ranks of windows where no noise is seen, of the longest experiment: they are exact, and no window spans two."""
    y, u = max(experiments, key=lambda one: len(one[0]))
    exact = fault_dimension(y, u=u)
    possible = tuple(range(y.shape[1] + 1)) if exact.n_v is None else (exact.n_v,)
    return FaultCount(exact.n_v, possible, f"no noise beyond rounding: {exact.reason}", ())


def _measured(outputs: Array) -> None:
    """Raise InvalidData for outputs (N, p) that show no noise of their own."""
    constant = constant_channels(outputs.min(axis=0), outputs.max(axis=0))
    if constant:
        raise InvalidData(f"y: channels {constant} (from 0) are constant: they show no fault and no noise; leave them out")
    sizes = np.abs(np.diag(scipy.linalg.qr(outputs / np.linalg.norm(outputs, axis=0), mode="r", pivoting=True)[0]))
    if sizes[-1] < DEPENDENT * sizes[0]:
        raise InvalidData("y: some channels are combinations of others up to rounding, such as copies: leave them out, they count as laws")


def _walk(tests: dict[int, Laws]) -> tuple[Laws, ...]:
    """Return the tests by falling number of rows."""
    return tuple(tests[count] for count in sorted(tests, reverse=True))
