"""Ask everything that a record may give reason to doubt.

doubts      the Doubts of a record, with its model where there is one

What needs no model is asked of any record. The tests of one-step errors take the ARX model that the reduced model came from, or one that is
fitted here; where neither can be had, or where there is no noise, `unasked` of the answer says so. A stretch of HEARD samples is looked
at: a doubt that so many do not show is not worth one. Of several experiments the longest is asked, and all of them whether their inputs
follow their outputs.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.threads import one_thread
from ...data.records import Record
from ...data.validation import signal
from ...method.model.arx import Arx, fitted_arx
from ...method.model.arx_windows import arx_windows, longest_lag
from ...method.model.compression import EPS
from ...method.model.feedback import HEARD, feedback_chance, one_step_errors
from ...method.model.models import Simulator, StateSpaceModel
from ...method.model.moesp_model import MoespModel
from ...method.model.reduced_model import ReducedModel
from .channels import channel_doubts, limit_doubts, rounding_doubts
from .listing import DOUBT_LEVEL, Doubt, Doubts, in_order
from .one_step_errors import error_doubts, outlier_doubts
from .timing import clock_doubts, delay_doubts, held_doubts, mode_doubts

FACTS = ("constant channel", "copies", "operating point", "units", "limits", "held input")
OF_ERRORS = ("rounding", "closed loop", "non-linearity", "drift", "outliers", "bursts")
OF_MODEL = ("delay", "slow modes", "fast sampling")
OF_CLOCK = ("sampling time", "missing samples")


@one_thread()
def doubts(
    record: Record,
    model: ReducedModel | MoespModel | StateSpaceModel | None = None,
    residual: ArrayLike | None = None,
    *,
    dt: float | None = None,
    means_removed: bool = False,
) -> Doubts:
    """Return what a record gives reason to doubt: each reason with its evidence, what it does to the answer, and what to do.

    Every test raises a doubt without reason in one clean record of a thousand at most, all channels together; what is no test is a plain
    fact. Doubts are no refusals: the answer stays, and says less. `python benchmarks/doubts.py` measures both kinds of error. Source:
    [H76], [LB78] for the test of a closed loop; [L99, ch. 16] for tests on what a model leaves.

    Parameters
    ----------
    record : Record
        N samples, as `read_record` and `record_from` give them.
    model : ReducedModel, MoespModel or StateSpaceModel, optional
        What was identified from it; of a ReducedModel its ARX model, poles and standard errors are used, else an ARX model is fitted.
    residual : array_like (N, p), optional
        In units of the outputs; looked through for outliers where no ARX model can be had.
    dt : float, optional
        Sample time in seconds, as it was stated.
    means_removed : bool
        Whether the channels are about their means already.

    Returns
    -------
    Doubts
        A row for each reason.

    Raises
    ------
    InvalidData
        Where `record` is none, or `residual` has other samples or channels.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, doubts, record_from
    >>> u, noise = np.random.default_rng(1).standard_normal((2, 800, 1))
    >>> y = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u) + 0.1 * noise
    >>> len(doubts(record_from(y, u)))
    0
    >>> [row.kind for row in doubts(record_from(np.minimum(y, 1.0), u))]
    ['non-linearity', 'outliers', 'limits']
    """
    if not isinstance(record, Record):
        raise InvalidData(f"record: got one of type {type(record).__name__}; a Record is needed, as record_from(y, u) gives it")
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # what no float holds is asked nothing
        return _asked(record, model, residual, dt, means_removed)


def _asked(record: Record, model: object, residual: ArrayLike | None, dt: float | None, means_removed: bool) -> Doubts:
    record = record.about(np.zeros(len(record.names)))
    longest = max(record.experiments, key=len)
    y, u = longest.stretch(0, HEARD)
    rest = None if residual is None else _residual(residual, record)
    samples = np.hstack([u, y])
    rows = [*channel_doubts(samples, record.channels, record.names, record.n_u, means_removed=means_removed)]
    rows += limit_doubts(samples, record.names, record.n_u)
    rows += held_doubts(u, record.inputs)
    rows += clock_doubts(record.clock, dt)
    asked: list[str] = [*FACTS]
    unasked: dict[str, str] = {}
    if record.clock is None:
        unasked |= dict.fromkeys(OF_CLOCK, "the record has no time column")
    else:
        asked += OF_CLOCK
    if isinstance(model, ReducedModel):
        rows += mode_doubts(model, len(longest), dt if dt is not None or record.clock is None else record.clock.dt)
        rows += delay_doubts(model, record.inputs, record.outputs)
        asked += OF_MODEL
    else:
        unasked |= dict.fromkeys(OF_MODEL, "it needs a model with standard errors, as arx_reduction gives it")
    arx, why = _arx(longest, model)
    try:
        found = None if arx is None else _of_errors(y, u, arx, record)
    except np.linalg.LinAlgError:
        found, why = None, "numbers of the record are too unequal to compute with"
    if found is not None:
        rows += found
        asked += OF_ERRORS
    else:
        unasked |= dict.fromkeys(OF_ERRORS, why or "the record has no noise to speak of")
        if rest is not None:
            rows += outlier_doubts(rest, 0, record.outputs)
            asked.append("outliers")
            del unasked["outliers"]
    return Doubts(in_order(rows), tuple(asked), unasked)


def _residual(residual: ArrayLike, record: Record) -> Array:
    """Return the first HEARD samples of the residual. Raises InvalidData where it does not belong to the record."""
    values = signal(residual, "residual")
    if values.shape != (len(record), record.p):
        raise InvalidData(f"residual: got shape {values.shape}; {(len(record), record.p)} is needed, a row a sample of the record")
    return values[:HEARD]


def _arx(record: Record, model: object) -> tuple[Arx | None, str]:
    """Return the ARX model of a reduced model, else one fitted to the record; None with the reason where there is none."""
    if isinstance(model, ReducedModel):
        return model.arx, ""
    lags = longest_lag([min(len(record), HEARD)], record.p, record.n_u)
    try:
        if lags < 1:
            raise InvalidData("the record is too short for an ARX model: record more")
        windows = arx_windows([record.stretch(0, HEARD)], lags)
        return fitted_arx(windows, 1).scaled(*windows.scales), ""
    except (InvalidData, np.linalg.LinAlgError) as error:
        return None, f"no ARX model can be had: {error}"


def _of_errors(y: Array, u: Array, arx: Arx, record: Record) -> list[Doubt] | None:
    """Return the doubts that the one-step errors raise, None where they are rounding."""
    h = arx.order
    about_y, about_u = y - y.mean(axis=0), u - u.mean(axis=0)
    e = one_step_errors(about_y, about_u, arx, h)
    e = e - e.mean(axis=0)
    if not np.all(np.isfinite(e)):
        raise np.linalg.LinAlgError
    if len(e) < 2 or np.all(np.sum(e**2, axis=0) <= EPS * np.sum(about_y**2, axis=0)):
        return None
    rows = list(rounding_doubts(y, e.std(axis=0), record.outputs))
    lags = max(h, longest_lag([len(y)], record.p, record.n_u))
    chance = feedback_chance([one.stretch(0, HEARD) for one in record.experiments], arx, lags)
    if chance < DOUBT_LEVEL:
        rows.append(_closed_loop(chance, record))
    past = [np.hstack([about_u[h:]])] + [np.hstack([about_y[h - i : len(y) - i], about_u[h - i : len(u) - i]]) for i in range(1, h + 1)]
    with np.errstate(over="ignore", invalid="ignore"):
        x = _response(arx, about_u)
    if np.all(np.isfinite(x)):
        rows += error_doubts(e, about_u, x, np.hstack(past), arx, record.outputs)
    return rows


def _closed_loop(chance: float, record: Record) -> Doubt:
    return Doubt(
        "closed loop",
        record.inputs,
        "the inputs follow what disturbed the outputs before",
        "where the loop has a delay the model is right and its standard errors are too small; where it has none D is wrong, and with it "
        "all that follows; and a fault goes around with the inputs, so that the order may come out too high",
        "record in open loop, or with a reference that moves the inputs far more than the disturbances do; where nothing feeds back, look "
        "whether the outputs are recorded earlier than the inputs",
        chance,
    )


def _response(arx: Arx, u: Array) -> Array:
    """Return x (N, p), the response of the ARX plant to u (N, n_u) from rest."""
    h, p = arx.order, len(arx.covariance)
    n_u = u.shape[1]
    # State: the last h outputs and inputs, the latest first.
    size = h * (p + n_u)
    A, B = np.zeros((size, size)), np.zeros((size, n_u))
    past_y, past_u = slice(0, h * p), slice(h * p, size)
    C = np.zeros((p, size))
    if h:
        C[:, past_y] = -np.hstack(list(arx.outputs[1:]))
        C[:, past_u] = np.hstack(list(arx.inputs[1:]))
        A[:p] = C
        A[p : h * p, : (h - 1) * p] = np.eye((h - 1) * p)
        A[h * p + n_u :, h * p : size - n_u] = np.eye((h - 1) * n_u)
        B[:p], B[h * p : h * p + n_u] = arx.inputs[0], np.eye(n_u)
    return Simulator(StateSpaceModel(A, B, C, arx.inputs[0])).respond(u)
