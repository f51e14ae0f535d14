"""This is what `faultspace identify` writes of the Answer: JSON and the files of its folder.

document     the JSON-ready dict of --json (schemas/identify.schema.json)
write        all files, written elsewhere first and then renamed into place; says which, and what is missing and why
NAMES        the names of the files; those of an earlier answer that this one lacks are removed (`folders`: those of anybody else never)
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ....base.errors import InvalidData, InvalidInput, quote_path, shorten
from ....base.others_text import table_cell
from ....base.progress import Progress
from ....base.writing import UNFINISHED, new_file, reason
from ...data.plain import by_name, plain
from ...method.model.invariants import half_transfers, system_matrix
from ...method.model.moesp_model import MoespModel
from ...method.model.reduced_model import ReducedModel
from ...method.model.weighted_reduction import circle
from ...method.rows.joint import even_split
from ...method.space.distances import containment_distance
from ..healthy.mean_shift import POWER
from ..monitor.learned import MONITORING
from ..monitor.monitoring import learned_of
from .by_experiment import experiments, numbered
from .causes_told import RESIDUAL, residual_table, told
from .folders import refuse, replace
from .physical import physical
from .result_page import report
from .result_pictures import PICTURES, pictures
from .summary import MODEL_FILE, advice, fit, markdown, summary

if TYPE_CHECKING:
    from ...method.model.models import StateSpaceModel
    from ..steps.findings import Answer

MODEL, SPACE, SIGNAL, SUMMARY, PAGE = MODEL_FILE, "fault-space.json", "fault-signal.csv", "summary.md", "report.html"
FREQUENCIES = 32  # of the transfer function with standard errors
NAMES = (MODEL, SPACE, SIGNAL, RESIDUAL, SUMMARY, PAGE, *PICTURES)


def document(answer: Answer, data: str, *, worded: Callable[[str], str] = str) -> dict[str, Any]:
    """Return everything in JSON: null where there is no answer, complex numbers as [real, imaginary]; `worded` as in `summary`."""
    record, model = answer.record, answer.model
    result: dict[str, Any] = {
        "data": data,
        "samples": len(record),
        "inputs": list(record.inputs),
        "outputs": list(record.outputs),
        "experiments": experiments(answer),
        "operating_point": answer.operating_point.to_json() | {"reason": worded(answer.operating_point.reason)},
        **by_name(answer, "block_rows", "order_given", "singular_values", "exact", "n_v", "n_v_given", "healthy_record", "noise_level"),
        "order": model.order if model else None,
        "model_from": answer.way,
        "n_v_possible": list(answer.possible) if answer.n_v is None else [answer.n_v],
        "n_v_at_least": answer.at_least,
        "n_v_reason": worded(answer.reason),
        "n_v_because": plain(answer.because),
        "n_v_from": answer.counted_by,
        "healthy_until": answer.healthy,
        "doubts": None if answer.doubts is None else _worded(answer.doubts.to_json(), worded),
        "notes": [worded(note) for note in answer.notes],
        "next": [worded(line) for line in advice(answer)],
    }
    result |= physical(answer)
    if model:
        result |= {
            "poles": plain(model.model.poles),
            "stable": model.model.is_stable,
            "fit": plain(fit(answer)),
            "residual_covariance": plain(answer.residual.covariance) if answer.residual else None,
            "x0": plain(answer.residual.x0) if answer.residual else None,
        }
        result |= _of_reduction(model) if isinstance(model, ReducedModel) else _of_past_inputs(model)
    if answer.count:
        result["laws"] = answer.count.to_json()
    if answer.dimension:
        result |= {"residual_dimension": answer.dimension.n_v, "counted_on": list(answer.held)}
        result |= by_name(answer.dimension, "regime", "windows", "ranks", "gaps", "margins")
    if answer.against:
        counted = by_name(answer.against, "n_v", "at_least", "reason", "visible")
        result["against_healthy"] = counted | {"healthy": list(answer.counted_against)}
    mean = answer.mean
    result["mean_shift"] = mean and {
        "against": "zero" if answer.healthy is None else "healthy samples",
        **by_name(mean, "shifted", "reason", "level", "statistic", "threshold", "shift", "deviations"),
        "outputs": [answer.record.outputs[i] for i in mean.channels],
    }
    result["changes"] = answer.changes and answer.changes.to_json()
    if answer.healthy is not None and mean:
        result["visible"] = {"power": POWER, "level": mean.level, "constant": plain(mean.visible), "white": plain(answer.visible)}
    result["fault_space"] = _space(answer)
    result |= told(answer)
    result["explained"] = plain(answer.explained)
    result["explained_by_noise"] = plain(answer.by_noise)
    result["fault_signal"] = answer.signal and by_name(answer.signal, "delay", "trusted", "zeros", "misfit", "mismatch", "reason")
    return result


def _worded(found: dict[str, Any], worded: Callable[[str], str]) -> dict[str, Any]:
    """Return the doubts with their advice, which names arguments, reworded."""
    return found | {"rows": [row | {"evidence": worded(row["evidence"]), "advice": worded(row["advice"])} for row in found["rows"]]}


def _of_past_inputs(model: MoespModel) -> dict[str, Any]:
    """Return what PI-MOESP's model rests on."""
    return {"order_gap": plain(model.gap.ratio), "order_gap_clean": model.gap.clean} | by_name(model, "condition_numbers")


def _of_reduction(model: ReducedModel) -> dict[str, Any]:
    """Return how sure the reduced model is, and the evidence for its order where it was left open."""
    angles, sure = circle(FREQUENCIES), model.uncertainty
    errors = {name: value for name, value in sure.to_json().items() if name not in ("model", "root", "poles")}
    errors |= {
        "angles": plain(angles),
        "transfer": plain(half_transfers(system_matrix(model.model), model.order, angles)[0]),
        "transfer_deviations": plain(sure.transfer(angles)),
    }
    result: dict[str, Any] = {"standard_errors": errors, "offset": plain(model.offset)}
    return result if model.orders is None else result | {"orders": model.orders.to_json()}


def write(
    answer: Answer, out: Path, data: str, on_progress: Progress, *, worded: Callable[[str], str] = str
) -> tuple[list[str], list[str]]:
    """Write the files into the folder `out`; return their names, and remarks on what could not be had. `worded` is as in `summary`.

    Files of these names that an earlier run wrote are replaced, or removed where this answer has none. Raises InvalidInput where the folder
    cannot be written into, and, before anything is written, where it has a file of these names that is not ours.
    """
    remarks: list[str] = []
    refuse(out, NAMES)
    try:
        with tempfile.TemporaryDirectory(prefix=UNFINISHED, dir=out) as name:
            folder = Path(name)
            remarks += _tables(answer, folder, on_progress)
            remarks += pictures(answer, folder)
            lines = [*summary(answer, data, worded=worded)]
            if remarks:
                lines += ["", "## Files", *(f"- {remark}" for remark in remarks)]
            _text(folder / SUMMARY, markdown(lines))
            _text(folder / PAGE, report(answer, lines, folder, data))
            written = replace(folder, out, NAMES)
    except OSError as error:
        raise InvalidInput(f"{quote_path(str(out))}: cannot be written into ({reason(error)}), expected another folder") from None
    return written, remarks


def _tables(answer: Answer, folder: Path, on_progress: Progress) -> list[str]:
    """Write everything but pictures and summary; remarks on what could not be had."""
    remarks: list[str] = []
    if answer.model is not None:
        monitoring, remark = of_monitor(answer)
        remarks += remark
        _json(folder / MODEL, _model(answer, answer.model.model), monitoring)
    if (space := _space(answer)) is not None:
        _json(folder / SPACE, space)
    if answer.residual is not None:
        residual_table(answer, folder / RESIDUAL, on_progress)
        if formulas := [name for name in answer.record.outputs if table_cell(name) != name]:
            remarks += [f"{RESIDUAL}: an apostrophe stands before {shorten(formulas[0])}, which a spreadsheet would take for a formula"]
    if any(part.signal is not None for part in answer.experiments):
        _signal_table(answer, folder / SIGNAL, on_progress)
    return remarks


def _model(answer: Answer, inner: StateSpaceModel) -> dict[str, Any]:
    model = inner.to_json() | {"inputs": list(answer.record.inputs), "outputs": list(answer.record.outputs)}
    if answer.dt is not None:
        model |= {"dt": answer.dt}
    if answer.pair is not None:
        F, G = answer.pair
        model |= {"n_v": F.shape[1], "F": F.tolist(), "G": G.tolist()}
    return model


def of_monitor(answer: Answer) -> tuple[dict[str, Any] | None, list[str]]:
    """Return what a monitor needs, None where the record does not tell it, with a remark that says why."""
    try:
        return learned_of(answer).to_json(), []
    except InvalidData as error:
        return None, [f"{MODEL}, what `monitor` needs: {str(error).removeprefix('healthy: ')}"]


def _signal_table(answer: Answer, path: Path, on_progress: Progress) -> None:
    """Write a line a sample: its number, whether v is determined there (1 or 0), v in digits that give the float back. Where there are
    several experiments, the number of each stands first, samples are counted in each, and those without a signal have no lines."""
    several, done = ["experiment"] if answer.parts else [], 0
    with new_file(path, encoding="utf-8", newline="\n") as stream:
        width = answer.pair[0].shape[1] if answer.pair else 0
        stream.write(",".join([*several, "sample", "determined", *(f"v{j + 1}" for j in range(width))]) + "\n")
        for number, start, _, part in numbered(answer):
            if part.signal is None:
                continue
            (first, last), k = part.signal.trusted, start
            which = [str(number)] if several else []
            for piece in part.signal.store.pieces(start):
                lines = []
                for row in piece.tolist():
                    lines.append(",".join([*which, str(k - start), str(int(first <= k < last)), *map(repr, row)]))
                    k += 1
                stream.write("\n".join(lines) + "\n")
                done += len(piece)
                on_progress("writing the fault signal", done, len(answer.record))


def _space(answer: Answer) -> dict[str, Any] | None:
    space = answer.fault_space
    if space is None:
        return None
    rows = len(space.basis) - space.n - (space.n_v or 0)
    by_laws = space.method == "kernel rows"
    # The rows of a fit have degrees as equal as can be.
    degrees = list(even_split(space.n + (space.n_v or 0) - space.n_z, rows)) if by_laws and rows > 0 else None
    return space.to_json() | {
        "method": space.method,
        "angle_degrees": None if space.uncertainty is None else plain(np.degrees(space.uncertainty.angle())),
        "row_degrees": degrees,
        "pair_in_space": plain(containment_distance(np.vstack(answer.pair), space.basis)) if answer.pair else None,
    }


def _json(path: Path, content: dict[str, Any], monitoring: dict[str, Any] | None = None) -> None:
    """Write what people read a line a number, and what a monitor needs, where it is given, on one line behind it."""
    text = json.dumps(content, indent=1, allow_nan=False)
    if monitoring is not None:
        text = f'{text[:-2]},\n "{MONITORING}": {json.dumps(monitoring, allow_nan=False)}\n}}'
    _text(path, text + "\n")


def _text(path: Path, text: str) -> None:
    with new_file(path, encoding="utf-8", errors="backslashreplace") as stream:
        stream.write(text)
