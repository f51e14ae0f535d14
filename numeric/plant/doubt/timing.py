"""Doubts about time: the clock of the record, the pace of sampling beside the poles, delays, inputs that are held.

clock_doubts    what the time column says against what was stated, gaps and jitter
mode_doubts     modes so slow that the record holds few of their time constants, or so fast that none of their course is seen
delay_doubts    outputs that answer an input late
held_doubts     inputs that change at every h-th sample alone

A pole z is exp(s) of a pole s of the plant, in samples: the mode dies out with the time constant -1 / Re s, and its course, turning
included, takes 1 / |s|. A record of N samples holds N over its time constant of a mode; below LEAST_CONSTANTS it is told to be short for
the mode. A rule of thumb of ours is ten samples to the course of the fastest mode that matters ([L99, ch. 13] on how to choose); where all
modes take more than TOO_FAST samples, sampling is called fast.

A delay is told where Markov parameters k = 0 .. d - 1 of one output to one input, d >= 2, are none of them seen, and are all surely smaller
than the next: their sizes and FAR standard errors together stay below what is left of the next without FAR of its own. FAR is such that the
next one would look as large by chance with the probability DOUBT_LEVEL, all pairs of channels together. That the ones before it are zero
is what nobody can know: the doubt says how large they may be beside the next.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ....base.sheets import counted
from ...data.clocks import Clock
from ...method.model.reduced_model import ReducedModel
from .listing import DOUBT_LEVEL, Doubt, named

LEAST_CONSTANTS = 10
"""Time constants of a mode that a record should hold: with T of them the relative error of an autoregression's time constant is about
sqrt(2 / T), 45 % here."""
TOO_FAST = 100
"""Samples that the fastest mode takes, from which sampling is called fast: ten times the rule of thumb of ten."""
MOST_MARKOV = 20
SAME = 1e-6  # relative difference of sample times that are called equal
ROUTE = "cut the record there and give its parts as experiments (identify of read_stretches, or --gaps), or fill in what is missing"


def clock_doubts(clock: Clock | None, stated: float | None) -> Iterator[Doubt]:
    """Yield what is odd about the time column, and where a sample time that was stated is another."""
    if clock is None:
        return
    where, column = f"at sample {clock.first_odd}", clock.name
    if clock.backwards:
        evidence = f"the time in {column} does not go on {where}, and {counted(clock.backwards, 'time')} in all"
        effect = "samples out of order, or twice, break the recursion that the model is"
        yield Doubt("sampling time", (column,), evidence, effect, "sort the rows by time, and take those that stand twice out")
    elif clock.missing:
        evidence = f"{counted(clock.missing, 'row')} at least are missing by the time in {column}, first {where}"
        effect = "each gap is a jump that no model explains, a spike in the residual that dies out with the slowest mode"
        yield Doubt("missing samples", (column,), evidence, effect, ROUTE)
    elif not clock.regular:
        spread = 100 * (clock.greatest - clock.least) / (2 * clock.dt)
        evidence = f"the steps of {column} lie between {clock.least:.4g} and {clock.greatest:.4g} s, +- {spread:.2g} % of their mean"
        effect = "the model takes them as equal, so that the plant seems to change from sample to sample, which looks like noise"
        yield Doubt("sampling time", (column,), evidence, effect, "interpolate all channels to equal steps, or record with a fixed clock")
    if stated is not None and abs(stated - clock.dt) > max(SAME * clock.dt, clock.resolution):
        evidence = f"dt={stated:g} s was stated, the times step by {clock.dt:.6g} s ({clock.source})"
        effect = "frequencies and damping in physical units are those of the stated time"
        yield Doubt("sampling time", (column,), evidence, effect, "leave dt out where the column is right")


def mode_doubts(model: ReducedModel, samples: int, dt: float | None) -> Iterator[Doubt]:
    """Yield a doubt where the slowest mode outlasts the record, and one where even the fastest takes very many samples."""
    poles = model.model.poles
    sizes = np.abs(poles)
    if not sizes.size or sizes.max() >= 1.0 or sizes.max() == 0.0:
        return
    slowest = poles[int(np.argmax(sizes))]
    slow = float(-1.0 / np.log(sizes.max()))
    if samples < LEAST_CONSTANTS * slow:
        turns = slowest.imag != 0 or slowest.real < 0
        yield Doubt(
            "slow modes",
            (),
            f"the mode of least damping dies out with a time constant of {_long(slow, dt)}, of which the record holds {samples / slow:.2g}",
            ("its damping is little known" if turns else "its pole is hardly told from an integration or a drift")
            + ", the standard error, which is of first order, is too small, and the state at the start is felt throughout",
            "a longer record",
        )
    fast = float(1.0 / np.max(np.abs(np.log(np.maximum(sizes, np.finfo(np.float64).tiny)) + 1j * np.angle(poles))))
    if fast > TOO_FAST:
        yield Doubt(
            "fast sampling",
            (),
            f"even the fastest mode takes {_long(fast, dt)}",
            "all poles crowd at 1, where rounding and small errors of a sample move them most, and windows see little of a mode's course",
            f"take every {int(fast // 10)}-th sample behind a low-pass filter",
        )


def _long(constant: float, dt: float | None) -> str:
    return f"{constant:.3g} samples" if dt is None else f"{constant:.3g} samples ({constant * dt:.3g} s)"


def delay_doubts(model: ReducedModel, inputs: Sequence[str], outputs: Sequence[str]) -> Iterator[Doubt]:
    """Yield the inputs that an output answers late, by Markov parameters and their standard errors."""
    if model.order == 0:
        return
    sizes, errors = np.abs(model.model.markov(MOST_MARKOV)), model.uncertainty.markov(MOST_MARKOV)
    far = -float(scipy.special.ndtri(DOUBT_LEVEL / (2 * sizes[0].size)))
    for i, u in enumerate(inputs):
        late = [(j, found) for j in range(len(outputs)) if (found := _delay(sizes[:, j, i], errors[:, j, i], far)) >= 2]
        if late:
            who, least = [outputs[j] for j, _ in late], min(found for _, found in late)
            hidden = max(float(np.max(sizes[:d, j, i] + far * errors[:d, j, i]) / sizes[d, j, i]) for j, d in late)
            sooner = ", unless the outputs that answer sooner matter" if len(late) < len(outputs) else ""
            yield Doubt(
                "delay",
                (u, *who),
                f"{named(who)} {'answers' if len(who) == 1 else 'answer'} {u} after {counted(least, 'sample')} at the earliest; what may "
                f"come sooner is {100 * hidden:.2g} % of that at most",
                "a delay takes states of the model, one an input and sample, that are none of the plant",
                f"move {u} by {least - 1} later{sooner}",
            )


def _delay(sizes: Array, errors: Array, far: float) -> int:
    """Return at which Markov parameter the answer begins, where those before it are surely smaller; 0 where that is not sure."""
    for d in range(2, len(sizes)):
        if np.any(sizes[:d] > far * errors[:d]):
            return 0
        if sizes[d] - far * errors[d] > np.max(sizes[:d] + far * errors[:d]):
            return d
    return 0


def held_doubts(u: Array, inputs: Sequence[str]) -> Iterator[Doubt]:
    """Yield the inputs (N, n_u) that change at every h-th sample alone, h >= 2, though they change often."""
    found = [(name, step) for name, values in zip(inputs, u.T, strict=True) if (step := held_step(values)) >= 2]
    if found:
        names = [name for name, _ in found]
        least = min(step for _, step in found)
        yield Doubt(
            "held input",
            tuple(names),
            f"{named(names)} {'changes' if len(names) == 1 else 'change'} at every {least}-th sample alone",
            f"little is excited beyond 1/{2 * least} of the sampling rate, where the model rests on few data, as its errors say",
            "an input that may change at every sample, or slower sampling",
        )


def held_step(values: Array) -> int:
    """Return h where the values (N,) change at every h-th sample alone, 1 where they change anywhere or hardly ever."""
    changes = np.flatnonzero(np.diff(values)) + 1
    if len(changes) < 3 or len(np.unique(values)) < 3:
        return 1
    return int(np.gcd.reduce(np.diff(changes)))
