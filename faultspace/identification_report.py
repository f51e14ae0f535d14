"""What `faultspace identify` tells and writes of an Answer: summary, JSON, and the files of its folder.

summary      lines of Markdown for people, on the terminal and in summary.md
document     the JSON-ready dict of --json
write        all files, written elsewhere first and then renamed into place; says which, and what is missing and why
NAMES        the names of the files; those of an earlier answer that this one lacks are removed
"""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .exact.input_rules import InvalidInput
from .failures import printable
from .numeric import plots
from .numeric.distances import containment_distance

if TYPE_CHECKING:
    from .identifying import Answer

Array = NDArray[np.float64]

MODEL, SPACE, SIGNAL, SUMMARY = "model.json", "fault-space.json", "fault-signal.csv", "summary.md"
PICTURES = ("singular-values.png", "window-ranks.png", "zeros-and-poles.png", "outputs.png", "fault-signal.png")
NAMES = (MODEL, SPACE, SIGNAL, SUMMARY, *PICTURES)
PICTURED = 300  # samples of the outputs that are drawn
MOST_ROWS = 12
DIGITS = 4


def fit(answer: Answer) -> Array | None:
    """100 (1 - |y - simulated| / |y - mean|) for each output (p,), on the data that identified the model."""
    if answer.residual is None:
        return None
    y, r = answer.record.y, answer.residual.r
    spread = np.linalg.norm(y - y.mean(axis=0), axis=0)
    return np.asarray(100 * (1 - np.linalg.norm(r, axis=0) / np.where(spread > 0, spread, 1.0)))


def document(answer: Answer, data: str) -> dict[str, Any]:
    """Everything in JSON: null where there is no answer, complex numbers as [real, imaginary]."""
    record, model = answer.record, answer.identification
    result: dict[str, Any] = {
        "data": data,
        "samples": len(record.y),
        "inputs": list(record.inputs),
        "outputs": list(record.outputs),
        "means_removed": answer.means_removed,
        "block_rows": answer.block_rows,
        "order": model.order if model else None,
        "singular_values": _plain(answer.singular_values),
        "n_v": answer.count,
        "n_v_reason": answer.count_reason,
        "notes": list(answer.notes),
    }
    if model:
        result |= {
            "order_gap": _plain(model.gap.ratio),
            "order_gap_clean": model.gap.clean,
            "poles": _plain(model.model.poles),
            "stable": model.model.is_stable,
            "fit": _plain(fit(answer)),
            "residual_covariance": _plain(answer.residual.covariance) if answer.residual else None,
            "x0": _plain(answer.residual.x0) if answer.residual else None,
            "condition_numbers": {name: _plain(value) for name, value in model.condition_numbers.items()},
        }
    if answer.dimension:
        found = answer.dimension
        result |= {
            "residual_dimension": found.n_v,
            "regime": found.regime,
            "windows": list(found.windows),
            "ranks": list(found.ranks),
            "gaps": list(found.gaps),
            "margins": _plain(found.margins),
        }
    result["fault_space"] = _space(answer)
    signal = answer.signal
    result["fault_signal"] = signal and {
        "delay": signal.delay,
        "trusted": list(signal.trusted),
        "zeros": _plain(signal.zeros),
        "misfit": _plain(signal.misfit),
        "reason": signal.reason,
    }
    return result


def summary(answer: Answer, data: str) -> Iterator[str]:
    """The answer for people, as lines of Markdown."""
    record, model = answer.record, answer.identification
    yield f"# {printable(data)}"
    yield f"{len(record.y)} samples, inputs {_several(record.inputs)}, outputs {_several(record.outputs)}"
    yield f"windows of {answer.block_rows} samples{', means removed' if answer.means_removed else ''}"
    yield ""
    yield "## Model"
    if model is None:
        yield "order: **undecided**"
        yield f"singular values: {_listed(answer.singular_values)}"
    else:
        clean = "clean" if model.gap.clean else "not clean"
        gap = f"ratio {model.gap.ratio:.3g}, next {model.gap.runner_up_ratio:.3g} ({clean})"
        yield f"order {model.order}; gap in the singular values: {gap}"
        yield f"poles: {_listed(model.model.poles)} ({'stable' if model.model.is_stable else 'NOT stable'})"
        shown = fit(answer)
        if shown is not None:
            pairs = [f"{name} {value:.2f} %" for name, value in zip(record.outputs, shown, strict=True)]
            yield f"fit to the data identified from: {_several(pairs)}"
        yield ""
        yield "## Faults"
        yield f"number of independent faults n_v: **{'undecided' if answer.count is None else answer.count}**"
        yield f"why: {answer.count_reason}"
        if answer.dimension and answer.dimension.regime == "rounding":
            yield f"gaps rank R_(s+1) - rank R_s of the residual, s = 1, 2, ...: {' '.join(map(str, answer.dimension.gaps))}"
        yield from _fault_lines(answer)
    if answer.notes:
        yield ""
        yield "## Notes"
        yield from (f"- {note}" for note in answer.notes)


def _fault_lines(answer: Answer) -> Iterator[str]:
    space, signal = answer.space, answer.signal
    if space is None:
        return
    yield ""
    yield "## Fault space"
    if not space.meaningful:
        yield f"**none that means anything**: {space.reason}"
        return
    yield f"dimension n_z = {space.n_z}{'' if space.decided else ' (undecided)'}: {space.reason}"
    yield f"basis of [F; G], the first {space.n} rows are F:"
    yield from (f"    {line}" for line in _matrix(space.basis))
    if signal is None:
        return
    first, last = signal.trusted
    yield ""
    yield "## Fault signal"
    yield f"simulated with it, the residual is met up to {100 * signal.misfit:.2g} % of its size"
    yield f"{f'samples {first} to {last - 1} are determined' if first < last else 'no sample is determined'}: {signal.reason}"
    if space.zeta:
        yield f"it belongs to one choice of {space.n_v} of the {space.n_z} columns; other choices have other signals and the same outputs"
    yield "its scale, sign and mixture go with the columns of F and G in the model file"


def write(answer: Answer, out: Path, data: str) -> tuple[list[str], list[str]]:
    """Writes the files into the folder `out`; their names, and remarks on what could not be had. Raises InvalidInput."""
    remarks: list[str] = []
    try:
        with tempfile.TemporaryDirectory(prefix=".unfinished-", dir=out) as name:
            folder = Path(name)
            _tables(answer, folder)
            if (remark := _pictures(answer, folder)) is not None:
                remarks.append(remark)
            lines = [*summary(answer, data)]
            if remarks:
                lines += ["", "## Missing", *(f"- {remark}" for remark in remarks)]
            (folder / SUMMARY).write_text(_markdown(lines), encoding="utf-8")
            written = [name for name in NAMES if (folder / name).exists()]
            for name in NAMES:
                if name in written:
                    os.replace(folder / name, out / name)
                else:
                    (out / name).unlink(missing_ok=True)
    except OSError as error:
        reason = error.strerror or str(error)
        raise InvalidInput(f"{printable(str(out))}: cannot be written into ({reason[:1].lower()}{reason[1:]})") from None
    return written, remarks


def _tables(answer: Answer, folder: Path) -> None:
    if answer.identification is not None:
        model = answer.identification.model.to_json()
        model |= {"inputs": list(answer.record.inputs), "outputs": list(answer.record.outputs)}
        if answer.pair is not None:
            F, G = answer.pair
            model |= {"n_v": F.shape[1], "F": F.tolist(), "G": G.tolist()}
        _json(folder / MODEL, model)
    if (space := _space(answer)) is not None:
        _json(folder / SPACE, space)
    if answer.signal is not None:
        _signal_table(answer.signal.v, answer.signal.trusted, folder / SIGNAL)


def _signal_table(v: Array, trusted: tuple[int, int], path: Path) -> None:
    """A line a sample: its number, whether v is determined there (1 or 0), v in digits that give the float back."""
    first, last = trusted
    with open(path, "w", encoding="utf-8", newline="\n") as stream:
        stream.write(",".join(["sample", "determined", *(f"v{j + 1}" for j in range(v.shape[1]))]) + "\n")
        for k, row in enumerate(v.tolist()):
            stream.write(",".join([str(k), str(int(first <= k < last)), *map(repr, row)]) + "\n")


def _space(answer: Answer) -> dict[str, Any] | None:
    space = answer.space
    if space is None:
        return None
    return {
        "n": space.n,
        "p": len(space.basis) - space.n,
        "n_v": space.n_v,
        "n_z": space.n_z if space.meaningful else None,
        "meaningful": space.meaningful,
        "decided": space.decided,
        "reason": space.reason,
        "block_rows": space.block_rows,
        "basis": _plain(space.basis) if space.meaningful else None,
        "F": _plain(space.F) if space.meaningful else None,
        "G": _plain(space.G) if space.meaningful else None,
        "pair_in_space": _plain(containment_distance(np.vstack(answer.pair), space.basis)) if answer.pair else None,
    }


def _pictures(answer: Answer, folder: Path) -> str | None:
    """Draws what there is; without matplotlib the sentence that says so."""
    try:
        figure: Any = import_module("matplotlib.figure")
    except ImportError:
        return "no plots: matplotlib is not installed (pip install 'faultspace[plots]')"
    model, dimension, signal = answer.identification, answer.dimension, answer.signal
    drawings: dict[str, Callable[[Any], Any]] = {}
    order = model.order if model else None
    drawings[PICTURES[0]] = lambda ax: plots.plot_singular_values(answer.singular_values, order=order, ax=ax)
    if dimension and len(dimension.windows) > 1:
        drawings[PICTURES[1]] = lambda ax: plots.plot_window_ranks(dimension, ax=ax)
    if model:
        poles, zeros = model.model.poles, signal.zeros if signal else np.zeros(0)
        drawings[PICTURES[2]] = lambda ax: plots.plot_zeros_and_poles(poles, zeros, ax=ax)
    if answer.residual is not None:
        y = answer.record.y[-PICTURED:]
        simulated = y - answer.residual.r[-PICTURED:]
        first = len(answer.record.y) - len(y)
        names = answer.record.outputs
        drawings[PICTURES[3]] = lambda ax: plots.plot_measured_and_simulated(y, simulated, names=names, first=first, ax=ax)
    if signal:
        drawings[PICTURES[4]] = lambda ax: plots.plot_fault_signal(signal.v, trusted=signal.trusted, ax=ax)
    for name, draw in drawings.items():
        square = name == PICTURES[2]
        picture = figure.Figure(figsize=(5.2, 5.2) if square else (8, 4.6), layout="constrained")
        draw(picture.add_subplot())
        picture.savefig(folder / name, dpi=130)
    return None


def _json(path: Path, content: object) -> None:
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n", encoding="utf-8")


def _plain(values: ArrayLike | None) -> Any:
    """Lists and numbers that JSON has: null for what is not finite."""
    if values is None:
        return None
    array = np.asarray(values)
    if array.ndim:
        return [_plain(entry) for entry in array]
    if np.iscomplexobj(array):
        return [_plain(array.real), _plain(array.imag)]
    number = float(array)
    return number if np.isfinite(number) else None


def _listed(values: ArrayLike, most: int = MOST_ROWS) -> str:
    shown = [_number(value) for value in np.asarray(values).ravel()]
    return ", ".join(shown[:most]) + (f", ... ({len(shown)} in all)" if len(shown) > most else "")


def _number(value: Any) -> str:
    if np.iscomplexobj(value) and abs(value.imag) > 0:
        return f"{value.real:.{DIGITS}g} {'+' if value.imag >= 0 else '-'} {abs(value.imag):.{DIGITS}g}i"
    return f"{value.real:.{DIGITS}g}"


def _several(names: Any) -> str:
    return ", ".join(names[:MOST_ROWS]) + (f", ... ({len(names)} in all)" if len(names) > MOST_ROWS else "")


def _matrix(matrix: Array) -> list[str]:
    rows = [[f"{entry: .{DIGITS}f}" for entry in row[:MOST_ROWS]] + ["..."] * (len(row) > MOST_ROWS) for row in matrix]
    shown = rows if len(rows) <= 2 * MOST_ROWS else [*rows[: 2 * MOST_ROWS - 1], ["..."]]
    return ["[ " + "  ".join(row) + " ]" for row in shown]


def _markdown(lines: list[str]) -> str:
    """The lines with blank ones around headings, code and lists; a plain line is a paragraph's own line."""
    text: list[str] = []
    for line in lines:
        plain = bool(line) and not line.startswith(("#", "-", "    "))
        last = text[-1] if text else ""
        code, after_code = line.startswith("    "), last.startswith("    ")
        if (last and (line.startswith("#") or (code and not after_code))) or (after_code and plain):
            text.append("")
        text.append(f"{line}  " if plain else line)
        if line.startswith("#"):
            text.append("")
    return "\n".join(text) + "\n"
