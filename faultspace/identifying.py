"""`faultspace identify`: from a file of faulty data to model, fault dimension, fault space and fault signal.

run              the command's body
identify         the whole chain on arrays: an Answer, "undecided" where the data cannot tell
count_faults     the fault dimension of a residual that carries the model's error too
choose_pair      n_v columns (F, G) out of a fault space, whose signal is then reconstructed
default_block_rows   the window taken where none is given

1  PI-MOESP. No clean gap in the singular values and no order given: the order is undecided, and the chain ends there.
2  The residual of that model, its initial state fitted.
3  The fault dimension. An identified model is wrong by about N^(-1/2), so the residual of noise-free data has the inputs in it as if they
were faults. The joint signal [u, y] knows no model: its dimension is n_u + n_v, and settles the count there.
4  The fault space, unless the dimension is undecided, 0 or p.
5  The fault signal for one pair out of the space: it is determined up to that choice.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.text import Text

from . import identification_report as report
from .consoles import answers, print_json, stages
from .data_files import Record, read_record
from .exact.input_rules import InvalidInput
from .failures import ANSWERED, placed, printable, say
from .numeric.compression import compress
from .numeric.fault_dimension import FaultDimension, fault_dimension
from .numeric.fault_space import FaultSpaceEstimate, fault_space
from .numeric.input_checks import InvalidData
from .numeric.pi_moesp import Identification, pi_moesp, pi_moesp_from_compression
from .numeric.reconstruction import Reconstruction, reconstruct_fault
from .numeric.residuals import ResidualSignal, residual
from .reading_files import prepare_folder

Array = NDArray[np.float64]
Tell = Callable[[str, int, int], None]

DEFAULT_WINDOW = 20
SPARE = 3  # windows for each row of the Hankel matrices, at least
PAIRS_TRIED = 6
TRIED_ON = 4000  # samples that a pair is tried on
STEPS = ("reading", "identifying the model", "residual and fault dimension", "fault space", "fault signal", "writing")


@dataclass(frozen=True, eq=False)
class Answer:
    """What was found. None: not asked, because of what came before; `notes` says what a user must know, why an end was reached included.

    singular_values of PI-MOESP; count: the n_v taken (None: undecided) and count_reason; pair: F (n, n_v), G (p, n_v) of `signal`.
    """

    record: Record
    block_rows: int
    means_removed: bool
    singular_values: Array
    identification: Identification | None
    residual: ResidualSignal | None = None
    dimension: FaultDimension | None = None
    count: int | None = None
    count_reason: str = ""
    space: FaultSpaceEstimate | None = None
    pair: tuple[Array, Array] | None = None
    signal: Reconstruction | None = None
    notes: tuple[str, ...] = ()


def run(
    data: str,
    *,
    inputs: Sequence[str],
    outputs: Sequence[str],
    out: Path,
    order: int | None,
    block_rows: int | None,
    faults: int | None,
    remove_means: bool,
    as_json: bool,
) -> int:
    """Identifies and writes the files of `report.NAMES` into `out`; exit code 0 whenever there is an answer, "undecided" included."""
    taken = [name for name in report.NAMES if (out / name).exists() and _same(out / name, data)]
    if taken:
        raise InvalidInput(f"{printable(data)}: would be overwritten by the answer of this name, expected another --out")
    prepare_folder(out)
    with stages() as tell:
        tell(STEPS[0], 0, len(STEPS))
        last = 0.0

        def reading(done: int, total: int) -> None:
            nonlocal last
            if total and done / total - last >= 0.25 and done < total:  # a line each quarter, of long files only
                last = done / total
                tell(f"{STEPS[0]} {printable(data)}, {100 * done // total} %", 0, len(STEPS))

        record = read_record(data, inputs=inputs, outputs=outputs, tell=reading)
        with placed(data):
            try:
                answer = identify(record, order=order, block_rows=block_rows, faults=faults, remove_means=remove_means, tell=tell)
            except InvalidData as error:
                raise InvalidInput(str(error)) from None
        tell(STEPS[5], 5, len(STEPS))
        written, remarks = report.write(answer, out, data)
    for remark in remarks:
        say(remark)
    if as_json:
        print_json(report.document(answer, data) | {"files": written})
        return ANSWERED
    console = answers()
    for line in report.summary(answer, data):
        console.print(Text(line, style="bold cyan" if line.startswith("#") else ""), soft_wrap=True)
    console.print(Text(f"written into {printable(str(out))}: {', '.join(written)}"), soft_wrap=True)
    return ANSWERED


def identify(
    record: Record,
    *,
    order: int | None = None,
    block_rows: int | None = None,
    faults: int | None = None,
    remove_means: bool = False,
    tell: Tell | None = None,
) -> Answer:
    """The chain of the module's docstring on a record; `faults` states n_v instead of estimating it. Raises InvalidData."""
    say_step = tell or (lambda stage, done, total: None)
    y, u = record.y, record.u
    if remove_means:
        y, u = y - y.mean(axis=0), u - u.mean(axis=0)
        record = replace(record, y=y, u=u)
    if faults is not None and faults > record.y.shape[1]:
        raise InvalidData(f"--faults: got {faults} for {record.y.shape[1]} outputs; at most as many can be told apart: state fewer")
    rows = block_rows if block_rows is not None else default_block_rows(len(y), y.shape[1], u.shape[1], order)
    say_step(STEPS[1], 1, len(STEPS))
    notes = _offsets(record, remove_means)
    model, values, refusal = _model(y, u, order, rows)
    if model is None:
        return Answer(record, rows, remove_means, values, None, notes=(*notes, f"the order is undecided: {refusal}"))
    notes += model.warnings
    if order is not None and not model.gap.clean:
        notes += (f"order {order} was given; the singular values have no clean gap there (ratio {model.gap.ratio:.3g})",)
    say_step(STEPS[2], 2, len(STEPS))
    rest = residual(y, u, model.model)
    answer = Answer(record, rows, remove_means, values, model, rest, notes=(*notes, *rest.notes))
    if _is_rounding(rest.r, y):
        return replace(answer, count=0, count_reason="the model explains the outputs to rounding: no fault acts")
    dimension, count, reason = count_faults(rest.r, y, u)
    if faults is not None:
        agrees = "as the data say" if faults == count else f"the data say {'undecided' if count is None else count}: {reason}"
        count, reason = faults, f"{faults} given; {agrees}"
    answer = replace(answer, dimension=dimension, count=count, count_reason=reason)
    if not count:
        return answer
    say_step(STEPS[3], 3, len(STEPS))
    space = fault_space(rest.r, model.A, model.C, n_v=count)
    answer = replace(answer, space=space)
    if not space.meaningful or space.n_z < count:
        return answer
    say_step(STEPS[4], 4, len(STEPS))
    F, G = choose_pair(rest.r, model.A, model.C, space, count)
    return replace(answer, pair=(F, G), signal=reconstruct_fault(rest.r, model.A, F, model.C, G))


def count_faults(r: Array, y: Array, u: Array) -> tuple[FaultDimension, int | None, str]:
    """The fault dimension of r (N, p), the number of faults taken (None: undecided) and why; y (N, p), u (N, n_u) belong to r."""
    found = fault_dimension(r)
    if found.regime != "rounding" and not (found.n_v is None and _exact(np.hstack([u, y]))):
        return found, found.n_v, found.reason
    joint = fault_dimension(np.hstack([u, y]))
    n_u = u.shape[1]
    if joint.n_v is None or joint.n_v < n_u or joint.n_v - n_u == found.n_v:
        return found, found.n_v, found.reason
    count = joint.n_v - n_u
    seen = "undecided" if found.n_v is None else f"{found.n_v}"
    return found, count, (
        f"inputs and outputs together are of dimension {joint.n_v} = n_u + {count} ({joint.reason}); the residual alone ({seen}) "
        "also carries the error of the identified model, driven by the inputs"
    )


def choose_pair(r: Array, A: Array, C: Array, space: FaultSpaceEstimate, n_v: int) -> tuple[Array, Array]:
    """F (n, n_v), G (p, n_v) out of the space: of a few choices the one whose signal explains the residual best, then the one with
    most samples that no zero disturbs.

    Tried are the directions of largest G, which have the least delay, and general mixes: a special choice of columns may be inequivalent.
    """
    if space.n_z == n_v:
        return space.F, space.G
    right = np.linalg.svd(space.G, full_matrices=True)[2]
    draw = np.random.default_rng(space.n_z)
    mixes = [right[:n_v].T] + [np.linalg.qr(draw.standard_normal((space.n_z, n_v)))[0] for _ in range(PAIRS_TRIED - 1)]
    part = r[:TRIED_ON]
    best: tuple[float, float] | None = None
    chosen = mixes[0]
    for mix in mixes:
        try:
            tried = reconstruct_fault(part, A, space.F @ mix, C, space.G @ mix)
        except InvalidData:  # a mix without any effect
            continue
        first, last = tried.trusted
        score = (-round(float(np.log10(tried.misfit + 1e-12)), 1), float(max(last - first, 0)))
        if best is None or score > best:
            best, chosen = score, mix
    return space.F @ chosen, space.G @ chosen


def default_block_rows(samples: int, p: int, n_u: int, order: int | None) -> int:
    """20 block rows, more where a given order needs them, fewer where the record is short."""
    wanted = DEFAULT_WINDOW if order is None else max(DEFAULT_WINDOW, -(-order // p) + 2, -(-order // n_u) + 1)
    affordable = samples // (2 + SPARE * (2 * n_u + p))
    return max(min(wanted, affordable), 2)


def _model(y: Array, u: Array, order: int | None, rows: int) -> tuple[Identification | None, Array, str]:
    """The model with its singular values; without a clean gap None, the values and the reason. Raises InvalidData for bad data."""
    try:
        found = pi_moesp(y, u, order=order, block_rows=rows)
        return found, found.singular_values, ""
    except InvalidData as error:
        if order is not None:
            raise
        # Data from which some model can be had are good data: only the order is open.
        try:
            values = pi_moesp_from_compression(compress(y, u, block_rows=rows), order=1).singular_values
        except InvalidData:
            raise error from None
        return None, values, str(error)


def _offsets(record: Record, removed: bool) -> tuple[str, ...]:
    if removed:
        return ()
    both, names = np.hstack([record.u, record.y]), record.inputs + record.outputs
    far = [name for name, channel in zip(names, both.T, strict=True) if abs(channel.mean()) > channel.std() > 0]
    if not far:
        return ()
    which = ", ".join(far[:4]) + (f" and {len(far) - 4} more" if len(far) > 4 else "")
    return (f"the mean of {which} exceeds its deviation: about an operating point, try --remove-means",)


def _exact(signal: Array) -> bool:
    return fault_dimension(signal).regime == "rounding"


def _is_rounding(r: Array, y: Array) -> bool:
    """Whether nothing but rounding is left in any output."""
    return bool(np.all(np.abs(r).max(axis=0) <= 1e-12 * np.abs(y).max(axis=0)))


def _same(path: Path, other: str) -> bool:
    try:
        return path.samefile(other)
    except OSError:
        return False
