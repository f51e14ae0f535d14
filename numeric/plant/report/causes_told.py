"""This is what `identify` writes and says of the residual, its onsets and single causes.

onset_lines       the onsets, in lines of Markdown
after_healthy     which sample of the record after a healthy one of its own a sample is
isolation_lines   which single cause explains a shift of the mean, and which the faults, with the angles in a table
told              all of it in JSON
residual_table    residual.csv: a line a sample
stretches         for each sample, how many onsets came before
causes_drawn      the pictures of both, with their names
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ....base.others_text import table_cell
from ....base.progress import Progress
from ....base.writing import new_file
from ...data.plain import by_name
from ...method.plotting import plot_onsets
from .by_experiment import numbered

if TYPE_CHECKING:
    from ...method.space.shift_isolation import ShiftIsolation
    from ..steps.findings import Answer

RESIDUAL = "residual.csv"
MOST_ONSETS = 6  # that the summary tells
EARLY = 4  # onsets in the first of so many parts of a record may be its start
CAUSES_DRAWN = ("residual.png", "isolation.png", "shift-causes.png")


def onset_lines(answer: Answer) -> Iterator[str]:
    """Yield the section on the onset, where one was looked for."""
    found, outputs = answer.onset, answer.record.outputs
    if found is None:
        return
    yield ""
    yield "## Onset"
    if not found.onsets:
        yield f"**no onset**: {found.reason}"
        return
    for onset in found.onsets[:MOST_ONSETS]:
        first, last = onset.interval
        where = f"sample {onset.sample}{after_healthy(answer, onset.sample)}"
        within = f"between {first} and {last} with probability {found.confidence:g}"
        yield f"onset at **{where}**, {within}; chance without a change: {onset.p_value:.2g}"
        changed = ", ".join(outputs[j] for j in onset.changed) or "none by itself, all of them together"
        yield f"outputs that change: {changed}"
    if len(found.onsets) > MOST_ONSETS:
        yield (
            f"{len(found.onsets)} onsets in all, of which the first {MOST_ONSETS} are told here, and all in {RESIDUAL} and the JSON: noise "
            "whose power comes and goes, or a plant that is driven elsewhere, has so many; a fault that comes and stays has one or a few"
        )
    start = found.onsets[-1].stretch[0]
    if found.healthy is None and EARLY * start <= found.samples:
        yield (
            f"from sample {start} on the residual is alike to the end: a start-up that had not died out, or a fault from early on; "
            f"identified again without the first {start} samples, a start-up has no onset"
        )
    if answer.healthy_record and any(onset.interval[0] <= (found.healthy or 0) <= onset.interval[1] for onset in found.onsets):
        yield "an onset where the healthy record ends: both differ from the first sample on, by a fault, or by how the plant was run"
    yield "size of the fault's part in each output after it, in sigmas; how far the mean moves, in sigmas; the factor of the deviation:"
    width = max(6, *(len(name) for name in outputs))
    yield f"    {'from sample':>12}  {'output':<{width}}  {'sigmas':>8}  {'mean':>8}  {'deviation':>9}"
    for onset in found.onsets[:MOST_ONSETS]:
        rows = zip(outputs, onset.size, onset.shift, onset.growth, strict=True)
        yield from (f"    {onset.sample:>12}  {name:<{width}}  {a:>8.3g}  {b:>8.3g}  {c:>9.3g}" for name, a, b, c in rows)
    start, stop = found.reference
    yield f"one sigma is the deviation of the residual in samples {start} to {stop - 1}: {_sizes(outputs, found.deviation)}"
    yield f"why: {found.reason}; {RESIDUAL} has the residual, sample by sample"


def after_healthy(answer: Answer, sample: int) -> str:
    """Return which sample of the record after the healthy one this is, where that is a record of its own."""
    if not answer.healthy_record or answer.healthy is None or sample < answer.healthy:
        return ""
    return f", sample {sample - answer.healthy} of the record after the healthy one"


def isolation_lines(answer: Answer) -> Iterator[str]:
    """Yield the section on single causes, where there is a fault space."""
    found, shift = answer.isolation, answer.shift_isolation
    if found is None and shift is None:
        return
    yield ""
    yield "## Which sensor or actuator"
    first = shift is not None and shift.decided
    if shift is not None and first:
        yield from _shift_lines(shift)
    if found is not None:
        yield f"**{found.answer}**" if not first else f"by the fault space: {found.answer}"
    if shift is not None and not first:
        yield from _shift_lines(shift)
    if found is None:
        return
    width = max(len(cause.channel) for cause in found.causes)
    yield f"    {'fault of':<8}  {'':<{width}}  {'degrees':>8}  {'bound':>8}  {'chance':>7}"
    for cause in found.causes:
        bound = "" if cause.bound is None else f"{np.degrees(cause.bound):.3g}"
        chance = "" if cause.p_value is None else f"{cause.p_value:.2g}"
        yield f"    {cause.kind:<8}  {cause.channel:<{width}}  {np.degrees(cause.angle):>8.3g}  {bound:>8}  {chance:>7}  {cause.answer}"
    yield (
        "degrees: angle of the column [0; e_j] or [B_j; D_j] to the fault space, in the coordinates of the model; bound: what it stays "
        "below with probability 0.95, were this the cause; chance: of so large a deviation then, whatever the coordinates"
    )


def _shift_lines(found: ShiftIsolation) -> Iterator[str]:
    """Yield which cause explains the shift of the mean, and by how much each that may would have to act."""
    yield f"**{found.answer}**" if found.decided else f"by the shift of the mean: {found.answer}"
    if found.samples is not None and found.against is not None:
        (start, stop), (before, until) = found.samples, found.against
        yield f"the shift: the mean of the residual in samples {start} to {stop - 1} against that in samples {before} to {until - 1}"
    for cause in found.causes:
        if cause.size is not None and cause.p_value is not None:
            size = f"size {cause.size:.4g} +- {cause.deviation:.2g}"
            yield f"    {cause.kind} {cause.channel}: {cause.answer}, {size}, chance {cause.p_value:.2g}"


def told(answer: Answer) -> dict[str, Any]:
    """Return all of it in JSON, null where nothing was asked."""
    onset, names = answer.onset, answer.record.outputs
    told = None if onset is None else onset.to_json() | {"outputs": list(names)}
    return {"onset": told} | by_name(answer, "isolation", "shift_isolation")


def _sizes(names: tuple[str, ...], sizes: Any) -> str:
    return ", ".join(f"{name} {size:.3g}" for name, size in zip(names, sizes, strict=True))


def _bounds(answer: Answer) -> list[int]:
    return [] if answer.onset is None else [onset.sample for onset in answer.onset.onsets]


def residual_table(answer: Answer, path: Path, on_progress: Progress) -> None:
    """Write a line a sample: its number, how many onsets came before, the residual of each output in digits that give the float back. Where
    there are several experiments, the number of each stands first, and samples are counted in each."""
    rest = answer.residual
    assert rest is not None
    several = ["experiment"] if answer.parts else []
    with new_file(path, encoding="utf-8", newline="") as stream:
        lines = csv.writer(stream, lineterminator="\n")
        lines.writerow([*several, "sample", "stretch", *map(table_cell, answer.record.outputs)])
        done = 0
        for number, start, _, part in numbered(answer):
            assert part.residual is not None
            k, which = start, [number] if several else []
            for piece in part.residual.store.pieces(start):
                before = stretches(part, k, k + len(piece)).tolist()
                lines.writerows([*which, k - start + i, before[i], *map(repr, row)] for i, row in enumerate(piece.tolist()))
                k, done = k + len(piece), done + len(piece)
                on_progress("writing the residual", done, len(rest.store))


def stretches(answer: Answer, first: int, until: int) -> Any:
    """Return how many onsets came before each of the samples from `first` to before `until`."""
    return np.searchsorted(_bounds(answer), np.arange(first, until), side="right")


def causes_drawn(answer: Answer) -> list[tuple[str, tuple[float, float], Callable[[Any], Any]]]:
    """Return name, size and what to do with a figure."""
    rest, onset, isolation = answer.residual, answer.onset, answer.isolation
    drawings: list[tuple[str, tuple[float, float], Callable[[Any], Any]]] = []
    if rest is not None:
        found = [] if onset is None else [(one.sample, one.interval) for one in onset.onsets]
        height = 2.2 + 1.1 * min(answer.record.p, 8)
        drawings.append(
            (
                CAUSES_DRAWN[0],
                (8.0, height),
                lambda figure: plot_onsets(rest.store, found, healthy=answer.healthy, names=answer.record.outputs, ax=figure.add_subplot()),
            )
        )
    if isolation is not None and isolation.causes:
        size = (8.0, 1.8 + 0.38 * len(isolation.causes))
        drawings.append((CAUSES_DRAWN[1], size, lambda figure: isolation.plot(figure.add_subplot())))
    shift = answer.shift_isolation
    known = sum(cause.p_value is not None for cause in shift.causes) if shift is not None else 0
    if shift is not None and known:
        drawings.append((CAUSES_DRAWN[2], (8.0, 1.8 + 0.38 * known), lambda figure: shift.plot(figure.add_subplot())))
    return drawings
