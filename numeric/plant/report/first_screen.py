"""What `identify` says first: at most 15 lines, a question each, for somebody who has a minute; all evidence is in the summary.

first_screen     the lines
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from ....base.arrays import Array
from ....base.errors import quote_path
from ....base.sheets import counted, several
from ..steps.findings import Because
from .causes_told import after_healthy
from .summary import MOST_ROWS, advice, fit

if TYPE_CHECKING:
    from ..steps.findings import Answer

MOST_DOUBTS = 2
ORDINAL = {1: "a first", 2: "a second", 3: "a third", 4: "a fourth", 5: "a fifth"}
NONE = "none that the data show"


def first_screen(answer: Answer, data: str, *, worded: Callable[[str], str] = str) -> Iterator[str]:
    """Yield what was found; `worded` rewrites advice, which names arguments as Python does."""
    record = answer.record
    of = f" of {len(record.lengths)} experiments" if record.lengths else ""
    sizes = f"{counted(len(record.inputs), 'input')}, {counted(len(record.outputs), 'output')}"
    yield f"{quote_path(data)}: {counted(len(record), 'sample')}{of}, {sizes}"
    yield f"Model:   {_model(answer)}"
    if answer.model is not None:
        yield f"Faults:  {_faults(answer)}"
        yield f"Since:   {_since(answer)}"
        yield f"Where:   {_where(answer)}"
        yield f"Size:    {_size(answer)}"
        yield f"Sure:    {_sure(answer)}"
    rows = list(answer.doubts or ())
    for row in rows[:MOST_DOUBTS]:
        yield f"Doubt:   {row.kind}: {_first(row.evidence)}; {worded(_first(row.effect))}"
    if len(rows) > MOST_DOUBTS:
        yield f"Doubt:   {len(rows) - MOST_DOUBTS} more, of {', '.join(row.kind for row in rows[MOST_DOUBTS:])}"
    yield f"Next:    {worded(advice(answer)[0])}"


def _first(words: str) -> str:
    """Return the first clause outside brackets, which says it; what follows is evidence."""
    depth = 0
    for place, letter in enumerate(words):
        depth += (letter == "(") - (letter == ")")
        if depth == 0 and words.startswith("; ", place):
            return words[:place]
    return words


def _model(answer: Answer) -> str:
    model, orders, explained = answer.model, answer.orders, fit(answer)
    if model is None:
        return "order undecided, the singular values have no gap to trust; without a model nothing else is told"
    how = "as given" if answer.order_given else "from the data"
    if orders is not None:
        how = "the only one that the data leave open" if orders.decided else f"and {orders.least} to {orders.most} are open"
    poles = "stable" if model.model.is_stable else "NOT stable"
    fits = "" if explained is None else "; it simulates " + _by_name(answer, explained, "{:.0f} %")
    return f"order {model.order}, {how}; {poles}{fits}"


def _faults(answer: Answer) -> str:
    if answer.n_v is None:
        number = " or ".join(map(str, answer.possible)) or (f"at least {answer.at_least}" if answer.at_least else "no number is told")
        return f"undecided ({number}). {_first(answer.reason)}"
    if answer.n_v_given:
        return f"{answer.n_v}, as given"
    return f"{answer.n_v}. {_equations(answer) or _first(answer.reason)}"


def _equations(answer: Answer) -> str:
    """Return the count by equations between inputs and outputs, where they decide it; else ""."""
    count, p = answer.count, answer.record.p
    tests = {} if count is None else {one.count: one.holds for one in count.tests}
    if answer.n_v is None or {reason.code for reason in answer.because} != {Because.LAWS}:
        return ""
    held = p - answer.n_v
    if tests.get(held, held == 0) is not True or tests.get(held + 1, held == p) is True:
        return ""
    hold = f"{held} equation{'s' if held != 1 else ''} between inputs and outputs hold{'s' if held == 1 else ''} up to noise"
    fails = f", {ORDINAL.get(held + 1, 'one more')} does not" if held < p else ""
    rests = ", if what is left of single outputs is noise" if answer.n_v == 0 and answer.noise_level is None else ""
    return f"{hold}{fails}: {counted(p, 'output')} - {counted(held, 'equation')} = {counted(answer.n_v, 'fault')}{rests}"


def _since(answer: Answer) -> str:
    found = answer.onset
    if found is None:
        return "not asked"
    if not found.onsets:
        acts = "whatever acts, acts from the first sample on" if answer.at_least else "nothing sets in"
        return f"no onset in this record: {acts}"
    one = found.onsets[0]
    outputs = ", ".join(answer.record.outputs[j] for j in one.changed) or "all outputs together"
    time = f", {one.sample * answer.dt:g} s after the first" if answer.dt else ""
    more = f"; {len(found.onsets) - 1} more" if len(found.onsets) > 1 else ""
    within = f"{one.interval[0]} to {one.interval[1]} with probability {found.confidence:g}"
    return f"sample {one.sample}{after_healthy(answer, one.sample)}{time} ({within}), in {outputs}{more}"


def _where(answer: Answer) -> str:
    shift, found = answer.shift_isolation, answer.isolation
    if shift is not None and shift.decided:
        return shift.answer
    if found is not None:
        return found.answer
    return NONE if not answer.at_least else "not told: that needs a fault space, with fewer faults than outputs"


def _size(answer: Answer) -> str:
    mean, sizes, count = answer.mean, answer.sizes, answer.count
    moved = (
        [] if mean is None or not mean.shifted or mean.shift is None else [f"the mean moves by {_by_name(answer, mean.shift, '{:.3g}')}"]
    )
    if answer.onset is not None and answer.onset.onsets:
        return "; ".join([f"{_by_name(answer, answer.onset.onsets[0].size, '{:.2g}')} deviations of the residual before", *moved])
    if moved:
        return moved[0]
    if not answer.at_least or sizes is None:
        return NONE
    deviation = sizes.early_norm / np.sqrt(max(answer.modelled, 1))
    if count is None or count.noise_power is None:
        return "what the model leaves has the deviation " + _by_name(answer, deviation, "{:.3g}")
    fault = np.sqrt(np.maximum(deviation**2 - count.noise_power, 0.0))
    return f"deviation {_by_name(answer, fault, '{:.2g}')}; of the noise {_by_name(answer, np.sqrt(count.noise_power), '{:.2g}')}"


def _sure(answer: Answer) -> str:
    space = answer.fault_space
    if space is None or not space.meaningful:
        return "no directions of faults are told"
    angle = ""
    if space.uncertainty is not None:
        degrees = np.degrees(space.uncertainty.angle())
        angle = f"directions of faults to {degrees:.2g} degrees with probability 0.95, if order and counts are right"
    signal = "; the fault signal is determined" if answer.signal is not None and answer.signal.trusted[0] < answer.signal.trusted[1] else ""
    return f"{angle or 'the directions have no bound'}{'' if space.decided else '; their number is a near thing'}{signal}"


def _by_name(answer: Answer, values: Array, form: str) -> str:
    return several([f"{name} {form.format(value)}" for name, value in zip(answer.record.outputs, values, strict=True)], MOST_ROWS)
