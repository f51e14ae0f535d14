"""This is what `faultspace identify` says to people: the Answer as lines of Markdown, on the terminal and in summary.md.

summary     the lines: model, faults, fault space, fault signal, notes, what to try next
advice      what to try next, from what was found
fit         how much of each output the model explains
markdown    the lines as a file: blank lines around headings, code and lists
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import quote_path
from ....base.others_text import as_markdown, printable
from ....base.sheets import counted, or_undecided, several
from ...method.model.invariants import half_transfers, system_matrix
from ...method.model.reduced_model import ReducedModel
from ..healthy.mean_shift import POWER
from ..steps.findings import Because
from ..steps.operating_point import ZERO
from .by_experiment import experiment_lines
from .causes_told import after_healthy, isolation_lines, onset_lines
from .physical import mode_lines

if TYPE_CHECKING:
    from ..steps.findings import Answer

NOISE = "noise fills every direction of outputs and inputs"
NO_NOISE = "outputs and inputs obey a law without noise, to rounding"
MODEL_FILE = "model.json"
MOST_ROWS = 12
DIGITS = 4
CANDIDATES = 3
MOST_POLES = 3
_BEGINNING = re.compile(r"#{1,3} |- ")
_BOLD = re.compile(r"(?:(.*? |)\*\*(\S.*?)\*\*(?![\w*]))?(.*)", re.DOTALL)
LEVEL_MISSED = np.sqrt(0.5)  # of what is missed, by size, so that half of its squares are a constant


def fit(answer: Answer) -> Array | None:
    """Return 100 (1 - |y - simulated| / |y - mean|) for each output (p,), on the data that identified the model."""
    if answer.sizes is None:
        return None
    record = answer.record if answer.healthy is None else answer.record.beginning(answer.healthy)
    spread = np.sqrt(len(record)) * record.channels.deviation[record.n_u :]
    return np.asarray(100 * (1 - answer.sizes.early_norm / np.where(spread > 0, spread, 1.0)))


def summary(answer: Answer, data: str, *, worded: Callable[[str], str] = str) -> Iterator[str]:
    """Yield the answer for people, as lines of Markdown; `worded` rewrites notes and advice, which name arguments as Python does."""
    record, model = answer.record, answer.model
    yield f"# {quote_path(data)}"
    several = f" of {len(record.lengths)} experiments" if record.lengths else ""
    yield f"{counted(len(record), 'sample')}{several}, inputs {_several(record.inputs)}, outputs {_several(record.outputs)}"
    yield f"windows of {answer.block_rows} samples"
    yield worded(operating_point_line(answer))
    yield ""
    yield "## Model"
    if model is None:
        yield "order: **undecided**, the singular values have no gap to trust"
        yield f"singular values: {_listed(answer.singular_values)}"
    else:
        yield f"order **{model.order}**, {_why_the_order(answer)}"
        yield f"from {answer.way}, since {NO_NOISE if answer.exact else NOISE}"
        yield from _orders(answer)
        yield from _certainty(answer)
        yield from mode_lines(answer)
        explained = fit(answer)
        if explained is not None:
            pairs = [f"{name} {value:.4g} %" for name, value in zip(record.outputs, explained, strict=True)]
            left = "what is left is faults, noise and the model's error"
            if answer.healthy is not None:
                source = "those of the healthy record" if answer.healthy_record else "stated to be without fault"
                yield f"identified from the samples 0 to {answer.healthy - 1}, {source}"
                left = "what is left is noise and the model's error"
            yield f"fit of the simulated outputs, from the fitted initial state: {_several(pairs)}; {left}"
            yield "fit means 100 (1 - |y - simulated y| / |y - mean of y|) % by output: 100 is a perfect fit, 0 no better than the mean"
            yield from _below_zero(answer, explained)
        yield from onset_lines(answer)
        yield from experiment_lines(answer)
        yield ""
        yield "## Faults"
        yield f"number of independent faults n_v: **{_count(answer)}{_condition(answer)}**"
        yield from _changed_all_the_same(answer)
        yield f"why: {worded(answer.reason)}"
        if _told_of_laws(answer):
            yield (
                "law, or row: an equation that the last few samples of the channels obey up to noise, whatever the faults do; dB: of the "
                "power of what it leaves"
            )
        yield from _law_lines(answer)
        yield from _healthy_lines(answer)
        yield from _mean_lines(answer)
        yield from _visible_lines(answer)
        if answer.changes is not None:
            yield from answer.changes.lines()
        if answer.dimension and answer.dimension.regime == "rounding":
            yield f"gaps rank R_(s+1) - rank R_s beyond the inputs, s = 1, 2, ...: {' '.join(map(str, answer.dimension.gaps))}"
        yield from _space_lines(answer)
        yield from isolation_lines(answer)
        yield from _signal_lines(answer)
    if answer.doubts:
        yield from ("", "## Doubts")
        yield from (f"- {worded(row.line)}" for row in answer.doubts)
    if answer.notes:
        yield from ("", "## Notes")
        yield from (f"- {worded(note)}" for note in answer.notes)
    yield ""
    yield "## What to try next"
    yield from (f"- {worded(line)}" for line in advice(answer))


def _told_of_laws(answer: Answer) -> bool:
    """Say whether the reasons of the count speak of laws, or rows."""
    ranks, broken = answer.dimension, any(reason.code == Because.LAWS_BROKEN for reason in answer.because)
    asked = bool(answer.count and answer.count.tests) or broken
    return asked or (ranks is not None and (ranks.regime == "noise" or ranks.gaps[-1:] == (0,)))


def operating_point_line(answer: Answer) -> str:
    """Return about which point the channels were taken, and why."""
    point = answer.operating_point
    if point.of == ZERO:
        return f"operating point: zero ({point.reason})"
    where = (
        "" if point.values is None else f", {_several([f'{n} {v:.4g}' for n, v in zip(answer.record.names, point.values, strict=True)])}"
    )
    return f"operating point: the means of the {point.of}{where} ({point.reason})"


def missed_levels(answer: Answer, explained: Array) -> list[str]:
    """Return the outputs with a fit below zero of which the model misses mostly the level: half of the squares that are left, or more."""
    sizes, samples = answer.sizes, answer.modelled
    poor = np.flatnonzero(explained < 0)
    if not len(poor) or sizes is None or answer.residual is None:
        return []
    total = np.zeros(answer.record.p)
    for piece in answer.residual.store.pieces(0, samples):
        total = total + piece.sum(axis=0)
    return [answer.record.outputs[i] for i in poor if abs(total[i]) / np.sqrt(samples) > LEVEL_MISSED * sizes.early_norm[i]]


def _below_zero(answer: Answer, explained: Array) -> Iterator[str]:
    """Yield what a fit below zero means, and whether the level of the output is what is missed."""
    poor = [name for name, value in zip(answer.record.outputs, explained, strict=True) if value < 0]
    if poor:
        yield f"below zero: the simulated {_several(poor)} lies farther from the measured than the mean does: the model says little of it"
    if off := missed_levels(answer, explained):
        yield (
            f"what is missed of {_several(off)} is mostly its level, not its course: the means of inputs and outputs are those of an "
            "operating point, which the model does not know, and onsets and faults may be nothing but this"
        )


def _why_the_order(answer: Answer) -> str:
    model, orders = answer.model, answer.orders
    assert model is not None
    if orders is not None:
        left = "the only one left open" if orders.decided else f"orders {orders.least} to {orders.most} are left open by the data"
        return f"chosen from the data: {left}"
    how = "as given" if answer.order_given else "by the gap in the singular values"
    if isinstance(model, ReducedModel):
        return how
    gap = model.gap
    if gap.order >= len(answer.singular_values):
        return f"{how}: as many as there are singular values"
    clean = "clean" if gap.clean else "NOT clean"
    return (
        f"{how}: singular value {gap.order} is {gap.ratio:.3g} times the next, against {gap.runner_up_ratio:.3g} times at {gap.runner_up} "
        f"({clean})"
    )


def _orders(answer: Answer) -> Iterator[str]:
    """Yield the evidence for the order as a table, where it was left open."""
    orders = answer.orders
    if orders is None:
        return
    yield "fits on the last third, held back from models of the rest (1: perfect, 0: no better than zero):"
    largest_gap = max((row.gap for row in orders.rows if np.isfinite(row.gap)), default=np.nan)
    yield "    order  one-step  free run  chance      gap   poles"
    for row in orders.rows:
        mark = "  <- taken" if row.order == orders.best else ""
        star = "*" if row.gap == largest_gap else " "
        gap = f"{row.gap:.3g}" if np.isfinite(row.gap) else "-"
        fits = f"{row.one_step:>8.4f}  {row.free_run:>8.4f}  {row.chance:>6.2g}"
        yield f"    {row.order:>5}  {fits}  {gap:>7}{star}  {_pairs(row.poles) or 'none'}{mark}"
    yield "chance: the probability of so much worse an explanation than that of the order taken, were this order right"
    yield "gap: singular value n over the next, * the largest; poles: those of the model of this order, a pair once"
    if not orders.decided:
        yield "the number of faults, the fault space and the signal rest on the order taken"


def _pairs(poles: Sequence[complex]) -> str:
    """Return the first poles in short, one of each pair."""
    upper = [pole for pole in poles if pole.imag >= 0]
    texts = [f"{pole.real:.3g}+-{pole.imag:.3g}i" if pole.imag else f"{pole.real:.3g}" for pole in upper[:MOST_POLES]]
    return " ".join(texts) + (" .." if len(upper) > MOST_POLES else "")


def _certainty(answer: Answer) -> Iterator[str]:
    """Yield the poles and static gains, with standard errors where the model has them."""
    found, record = answer.model, answer.record
    assert found is not None
    model = found.model
    stability = "stable" if model.is_stable else "NOT stable"
    radius = f"({stability}, largest modulus {np.abs(model.poles).max(initial=0.0):.{DIGITS}g})"
    if not isinstance(found, ReducedModel):
        yield f"poles: {_listed(model.poles)} {radius}"
        return
    poles = [
        f"{_number(pole)} +- {_error(error if pole.imag else error.real)}"
        for pole, error in zip(model.poles, found.uncertainty.poles(), strict=True)
    ]
    yield f"poles, +- standard error: {_several(poles) or 'none'} {radius}"
    gains = half_transfers(system_matrix(model), model.n, np.zeros(1))[0][0].real
    errors = found.uncertainty.transfer([0.0])[0].real
    pairs = [
        f"{u} to {y} {gain:.{DIGITS}g} +- {error:.2g}"
        for y, row, spread in zip(record.outputs, gains, errors, strict=True)
        for u, gain, error in zip(record.inputs, row, spread, strict=True)
    ]
    yield f"static gains: {_several(pairs)}; standard errors of Markov parameters and frequency response are in the JSON"


def _error(value: complex) -> str:
    """Return a standard error, of a complex pole those of both parts."""
    return f"{value:.2g}" if not np.iscomplexobj(value) else f"({value.real:.2g}, {value.imag:.2g}i)"


def _healthy_lines(answer: Answer) -> Iterator[str]:
    """Yield both counts, where there are two."""
    against, alone = answer.against, answer.dimension
    if against is None:
        return
    first, until = answer.counted_against
    taken = f"; taken: {answer.counted_by}" if answer.counted_by else ""
    yield f"against the healthy samples {first} to {until - 1}: {or_undecided(against.n_v)} ({against.reason})"
    yield f"from the residual alone: {f'{or_undecided(alone.n_v)} ({alone.reason})' if alone else 'none'}{taken}"


def _changed_all_the_same(answer: Answer) -> Iterator[str]:
    """Yield, where no number is told, that the residual has become another one all the same."""
    onset = answer.onset
    if answer.n_v is None and onset is not None and onset.onsets:
        first = onset.onsets[0]
        names = _several([answer.record.outputs[i] for i in first.changed]) or "all outputs together"
        # Where the mean has moved the inputs are accounted for.
        driven = "" if answer.moved else ", and whether it is a fault or the plant driven elsewhere"
        yield (
            f"something changes at sample {first.sample}{after_healthy(answer, first.sample)}, in {names} (see the onset); open is how "
            f"many independent faults that takes{driven}"
        )


def _law_lines(answer: Answer) -> Iterator[str]:
    """Yield what was asked of the laws of outputs and inputs, the noise that they leave, and what the ranks say beside them."""
    count, ranks = answer.count, answer.dimension
    if count is None:
        return
    answers = {True: "laws", False: "no laws", None: "in doubt"}
    asked = [f"{laws.count} {answers[laws.holds]} ({laws.probability:.2g})" for laws in count.tests]
    if asked:
        yield f"rows asked whether they are laws of outputs and inputs (probability): {_several(asked)}"
    if count.noise_power is not None:
        yield f"noise that the laws leave, deviation: {_by_output(answer, np.sqrt(count.noise_power))}"
    if ranks is not None:
        yield f"from the ranks of the residual, for comparison: {or_undecided(ranks.n_v)} ({ranks.reason})"


def _condition(answer: Answer) -> str:
    """Return what a 0 of the laws rests on where nobody has said how large the noise is."""
    count = answer.count
    if answer.n_v != 0 or answer.n_v_given or answer.noise_level is not None or count is None or count.noise_power is None:
        return ""
    return f", if this is the noise of each output: {_by_output(answer, np.sqrt(count.noise_power))} (deviation)"


def _by_output(answer: Answer, sizes: Array) -> str:
    """Return one size (p,) for each output, beside its name."""
    return _several([f"{name} {size:.3g}" for name, size in zip(answer.record.outputs, sizes, strict=True)])


def _count(answer: Answer) -> str:
    if answer.n_v is not None:
        return str(answer.n_v)
    if answer.possible:
        return f"undecided: {' or '.join(map(str, answer.possible))}"
    return f"undecided, at least {answer.at_least}" if answer.at_least else "undecided"


def _mean_lines(answer: Answer) -> Iterator[str]:
    """Yield what moved the mean, and by how much, beside the rank."""
    mean, sizes, record = answer.mean, answer.sizes, answer.record
    if mean is None or sizes is None:
        return
    against = "zero" if answer.healthy is None else "that of the healthy samples"
    yield f"mean of the residual against {against}: {mean.reason}"
    if not mean.shifted or mean.shift is None or mean.deviations is None:
        return
    noise = np.sqrt(answer.modelled) / np.where(sizes.early_norm > 0, sizes.early_norm, np.inf)
    rows = zip(record.outputs, mean.shift, mean.deviations, mean.shift * noise, strict=True)
    sigma = "" if answer.healthy is None else " ({:.3g} times the size of its healthy residual)"
    yield "mean by output: " + _several([f"{name} {d:.4g} +- {e:.2g}{sigma.format(size)}" for name, d, e, size in rows])


def _visible_lines(answer: Answer) -> Iterator[str]:
    """Yield what would have been seen, where little or nothing was."""
    mean = answer.mean
    if answer.healthy is None or mean is None:
        return
    kinds = [("a constant at one output", mean.visible), ("a white signal at one output, deviation", answer.visible)]
    for kind, sizes in kinds:
        if sizes is not None:
            yield f"seen with a chance of {POWER:g} (level {mean.level:g}), {kind}: {_by_output(answer, sizes)}"


def _space_lines(answer: Answer) -> Iterator[str]:
    space = answer.fault_space
    if space is None:
        return
    yield ""
    yield "## Fault space"
    if not space.meaningful:
        yield f"**none that means anything**: {space.reason}"
        return
    yield f"dimension n_z = **{space.n_z}**{'' if space.decided else ' (undecided)'}: {space.reason}"
    if space.uncertainty is not None:
        angle = np.degrees(space.uncertainty.angle())
        if isinstance(answer.model, ReducedModel) and space.method == "kernel rows":
            count = len(space.uncertainty.valleys)
            others = f", over {count} models that explain the data about as well" if count > 1 else ""
            taken = f"n_z and the order taken as right{others}"
        else:
            taken = "n_z, A and C taken as right"
        yield f"angle to the true space: below {angle:.2g} degrees with probability 0.95, {taken}"
    yield f"equations: {space.equations} independent ones for the {space.unknowns} entries of a fault column [f; g]"
    if space.zeta == 0:
        up_to = "a factor" if space.n_v == 1 else "a mixture of the faults"
        yield f"meaning: no zeros, neither finite nor infinite, so F and G are determined up to {up_to}"
    elif space.zeta is not None:
        zeros = f"{space.zeta} for {'its zero' if space.zeta == 1 else 'zeros'}, finite or infinite"
        found = "" if answer.signal is None else f"; the F and G taken here have the finite zeros: {_listed(answer.signal.zeros) or 'none'}"
        yield f"meaning: {space.n_v} for {'the fault' if space.n_v == 1 else 'the faults'} and {zeros}{found}"
        columns = "any column" if space.n_v == 1 else f"any {space.n_v} columns"
        yield f"F and G are not unique: {columns} out of the space, in general position, make the same outputs"
    yield f"basis of [F; G], the first {space.n} rows are F:"
    yield from (f"    {line}" for line in _matrix(space.basis))


def _signal_lines(answer: Answer) -> Iterator[str]:
    signal, space, record = answer.signal, answer.fault_space, answer.record
    if answer.explained is not None and answer.by_noise is not None:
        yield ""
        yield "## Fault signal"
        on = " after the healthy samples" if answer.healthy is not None else ""
        yield (
            f"explained of the residual{on}: {100 * answer.explained:.4g} %, where mere noise of its spectra could give up to "
            f"{100 * answer.by_noise:.3g} %{'' if signal is not None else ': **withheld**, with F and G'}"
        )
        unit = "healthy residual" if answer.healthy is not None else "residual"
        yield (
            f"that is a share of the sum of squares, each output in units of the size of its {unit}; the rest is noise, or what n_v or "
            "the order miss"
        )
    if signal is None or space is None:
        return
    first, last = signal.trusted
    N = len(record)
    delay = "not determined by the outputs" if signal.delay is None else counted(signal.delay, "sample")
    yield f"delay until it is seen in the outputs, the state being unknown: {delay}"
    if first >= last:
        yield f"determined: **no sample** ({signal.reason})"
    elif (first, last) == (0, N):
        yield f"determined: all {N} samples"
    else:
        yield f"determined: samples {first} to {last - 1} of 0 to {N - 1} ({signal.reason})"
    if space.zeta:
        yield "it belongs to one choice of F and G in the space; other choices have other signals and the same outputs"
    yield "its scale, sign and mixture go with the columns of F and G in the model file"


def advice(answer: Answer) -> list[str]:
    """Say what to try next: about what is undecided first, and how to make sure of what is not."""
    model, record, orders = answer.model, answer.record, answer.orders
    if model is None:
        return [
            f"order=K: the largest ratios of neighbouring singular values are {_candidates(answer.singular_values)}",
            f"block_rows={2 * answer.block_rows} or {max(answer.block_rows // 2, 2)}: an order is right when it does not change",
            "more samples, or an input that excites more: noise moves the singular values together",
        ]
    lines = []
    explained = fit(answer)
    if explained is not None and missed_levels(answer, explained):
        lines.append('operating_point="means", before anything else: the levels of the channels hide what moves, and look like faults')
    if not model.model.is_stable:
        means = "" if answer.means_removed else 'operating_point="means", '
        lines.append(f"the model is not stable: a lower order=, {means}or a record without drift, unless the plant is unstable")
    if orders is not None and not orders.decided:
        lines.append(f"order=K, for another of the orders {orders.least} to {orders.most}: what follows from it should stay as it is")
    if answer.n_v is None:
        if answer.noise_level is None and answer.healthy is None and answer.possible:
            lines.append("noise_level=SIGMA, the deviation of the noise in each output, where it is known: it tells faults from noise")
        lines.append("n_v=K, where the number of faults is known; the space and the signal then follow")
        if answer.healthy is None:
            lines.append("healthy=K, where the record begins with K samples without fault: what they show is not counted")
        if record.p == 1:
            lines.append("more outputs: with one, a fault cannot be told from noise")
        else:
            lines.append("more samples, larger block_rows=, or more outputs than faults; constant or sinusoidal faults count as fewer")
        if answer.moved:
            lines.append("for a constant fault: the outputs whose means moved, above, and by how much; record where it sets in or varies")
    elif answer.n_v == 0:
        lines.append("nothing about faults: record while one acts")
        if answer.counted_by == "outputs and inputs" and answer.noise_level is None:
            lines.append("noise_level=SIGMA or healthy=K, where one is known: they tell faults in single outputs from noise")
    elif answer.fault_space is None or not answer.fault_space.meaningful:
        if answer.n_v >= record.p:
            lines.append("more outputs than independent faults: as many faults as outputs leave no relation to find F and G from")
        else:
            lines.append("a record in which the faults vary more, or a longer one: this one does not determine their space")
    else:
        if not answer.fault_space.decided:
            lines.append("more samples: the dimension of the fault space is a near thing; F, G and the signal follow where it is decided")
        if answer.explained is not None and answer.signal is None:
            lines.append("another order= or n_v=: the signal explains no more of the residual than it would of noise")
        if answer.signal is not None and answer.signal.trusted[0] >= answer.signal.trusted[1]:
            lines.append("an output that sees the fault sooner, or another one: no sample of the signal is determined by these")
    other = answer.block_rows + max(answer.block_rows // 2, 2)
    lines.append(f"block_rows={other}: order, n_v and n_z should stay as they are")
    return lines


def _candidates(values: Array) -> str:
    held = np.maximum(values, np.finfo(np.float64).eps * values.max(initial=0.0))
    ratios = held[:-1] / np.where(held[1:] > 0, held[1:], 1.0)
    best = np.argsort(-ratios[:-1], kind="stable")[:CANDIDATES] if len(ratios) > 1 else np.arange(len(ratios))
    return ", ".join(f"{ratios[k]:.3g} at {k + 1}" for k in best) or "none"


def _listed(values: ArrayLike, most: int = MOST_ROWS) -> str:
    return several([_number(value) for value in np.asarray(values).ravel()], most)


def _number(value: Any) -> str:
    if np.iscomplexobj(value) and abs(value.imag) > 0:
        return f"{value.real:.{DIGITS}g} {'+' if value.imag >= 0 else '-'} {abs(value.imag):.{DIGITS}g}i"
    return f"{value.real:.{DIGITS}g}"


def _several(names: Sequence[str]) -> str:
    return several(names, MOST_ROWS)


def _matrix(matrix: Array) -> list[str]:
    # No minus before a zero that rounding made.
    rounded = np.round(matrix, DIGITS) + 0.0
    rows = [[f"{entry: .{DIGITS}f}" for entry in row[:MOST_ROWS]] + ["..."] * (len(row) > MOST_ROWS) for row in rounded]
    kept = rows if len(rows) <= 2 * MOST_ROWS else [*rows[: 2 * MOST_ROWS - 1], ["..."]]
    return ["[ " + "  ".join(row) + " ]" for row in kept]


def markdown(lines: Sequence[str]) -> str:
    """Return the lines with blank ones around headings, code and lists; a plain line is a paragraph's own line. The one Markdown that lines
    have is ours: their beginnings, and the first thing in bold; names and whatever else stands in them is text."""
    text: list[str] = []
    for line in lines:
        plain = bool(line) and not line.startswith(("#", "-", "    "))
        last = text[-1] if text else ""
        code, after_code = line.startswith("    "), last.startswith("    ")
        if (last and (line.startswith("#") or (code and not after_code))) or (after_code and plain):
            text.append("")
        shown = printable(line) if code else _shown(line)
        text.append(f"{shown}  " if plain else shown)
        if line.startswith("#"):
            text.append("")
    return "\n".join(text) + "\n"


def _shown(line: str) -> str:
    """Return a line that is no code, its text escaped."""
    begins = _BEGINNING.match(line)
    mark = "" if begins is None else begins[0]
    before, bold, after = _BOLD.fullmatch(line[len(mark) :]).groups()  # type: ignore[union-attr]  # it matches every line
    if bold is None:
        return mark + as_markdown(after, first=True)
    return f"{mark}{as_markdown(before, first=True)}**{as_markdown(bold)}**{as_markdown(after)}"
