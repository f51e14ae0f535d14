"""What has changed since the healthy part of a record: the tests of this folder, put into one table.

    changes_since_healthy    model, means, spectrum and noise from the healthy part alone, the other samples against it
    changes_within           the little that can be said without: the second half against the first
    table                    the same of two stretches, as `identify` asks

The probability that any row is seen by chance is at most `level`: each test is held against level / (number of tests). What no test allows
for makes rows undecided rather than seen: inputs that leave what the healthy part shows (the error of the model can then look like any
change), and rows that the second half of the healthy part would have against the first half, or its own drift.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.validation import signal, whole
from ...method.model.models import StateSpaceModel
from ...method.model.residuals import HasModel, growing_modes, model_of
from ...method.space.shift_isolation import gain_errors
from ..healthy.unlike_healthy import beyond_healthy_inputs
from .freezing import frozen_sensors
from .gains import changed_gains
from .lines import sinusoids
from .predictor import Stretch, predictor
from .slow import drifting, slow_changes
from .table import FIRST_HALF, Changes, judged
from .table_rows import DRIFT, FREEZING, INPUT_GAIN, KINDS, LOSS, MEAN, undecided
from .variances import changed_variances

CHANGES_LEVEL = 0.01
"""This is the probability that any row of a table is seen by chance."""
RAW = (FREEZING,)  # kinds that rest on the raw outputs alone
ITSELF = "the healthy samples change in this way themselves, by a drift or in their second half: state others, or fewer"


@one_thread()
def changes_since_healthy(
    residual: ArrayLike,
    y: ArrayLike,
    u: ArrayLike,
    *,
    healthy: int,
    model: StateSpaceModel | HasModel | None = None,
    outputs: Sequence[str] | None = None,
    inputs: Sequence[str] | None = None,
    level: float = CHANGES_LEVEL,
) -> Changes:
    """Test what has changed in a record since its first `healthy` samples, which are without fault.

    Tested are, for each output, the mean, a drift, a growth and a loss of variance, a sensor that freezes, a sinusoid and its gain, and for
    each input its gain. Where the healthy part is too short or has no noise, every row but that of freezing is undecided. Source: heads of
    the modules of `numeric/plant/changes`, [C60], [F29], [LLSW18].

    Parameters
    ----------
    residual : array_like, (N, p)
        Of a model that was identified from the healthy samples alone, in the units of `y`.
    y, u : array_like, (N, p) and (N, n_u)
        The record, in any units.
    healthy : int
        Number of samples without fault.
    model : StateSpaceModel or what has one, optional
        That model; without it, or where it is not stable, changed gains are undecided.
    outputs, inputs : list of str, optional
        Names of the channels.
    level : float in (0, 1)
        Probability that any row is seen where nothing has changed; it holds for residuals that a short predictor makes white, up to what
        `benchmarks/changes.py` measures.

    Returns
    -------
    Changes
        A row for each kind and channel.

    Raises
    ------
    InvalidData
        NaN, lengths or names that do not fit, healthy samples that leave none to test, a level that is none.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import changes_since_healthy
    >>> draw = np.random.default_rng(1)
    >>> y, u = draw.standard_normal((600, 2)), draw.standard_normal((600, 1))
    >>> y[300:, 0] = y[300, 0]
    >>> changes_since_healthy(y, y, u, healthy=300).seen[0].told
    '300 samples, longest run 300 samples, before 1'
    """
    whole_part, names = _checked(residual, y, u, outputs, inputs, level)
    until = whole(healthy, "healthy", 1, "state how many samples precede the faults")
    if until >= len(whole_part):
        raise InvalidData(f"healthy: got {until} for {counted(len(whole_part), 'sample')}; some must follow: state fewer")
    whole_part = replace(whole_part, responses=responses(model, whole_part.u), fitted=parameters(model))
    after = replace(whole_part.part(until, len(whole_part)), gain_errors=gain_errors(model))
    return table(whole_part.part(0, until), after, names, level)


@one_thread()
def changes_within(
    residual: ArrayLike, y: ArrayLike, u: ArrayLike, *, outputs: Sequence[str] | None = None, level: float = CHANGES_LEVEL
) -> Changes:
    """Test whether the second half of a record differs from the first, where no samples are known to be without fault.

    Asked are only a mean that has moved and sensors that are stuck, by freezing or by a loss of variance; all else would take the fault for
    the noise. A fault that acts alike in both halves is not seen. Source: [C60], [LLSW18], as of `changes_since_healthy`.

    Parameters
    ----------
    residual, y, u : array_like, (N, p), (N, p) and (N, n_u)
        In any units.
    outputs : list of str, optional
    level : float
        All as of `changes_since_healthy`.

    Returns
    -------
    Changes
        As of `changes_since_healthy`.

    Raises
    ------
    InvalidData
        As `changes_since_healthy`.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import changes_within
    >>> y, u = np.random.default_rng(1).standard_normal((600, 2)), np.zeros((600, 1))
    >>> y[300:, 1] = 0.5
    >>> found = changes_within(y, y, u)
    >>> found.against, found.seen[0].kind
    ('the first half of the record', 'freezing')
    """
    record, names = _checked(residual, y, u, outputs, None, level)
    half = len(record) // 2
    both = record.part(0, half), record.part(half, len(record))
    kinds = (MEAN, LOSS, FREEZING)
    return replace(_tested(*both, names, level, len(kinds) * len(names[0]), kinds), against=FIRST_HALF)


def parameters(model: StateSpaceModel | HasModel | None) -> float:
    """Return how many parameters of the model were fitted for each output, the initial state among them; 0 without a model."""
    model = model_of(model)
    return 0.0 if model is None else (model.n * (model.p + model.n_u + 1) + model.p * model.n_u) / model.p


def responses(model: StateSpaceModel | HasModel | None, u: Array) -> Array | None:
    """Return what each input alone does to the outputs by the model, (n_u, N, p); None without a model that is stable."""
    model = model_of(model)
    if model is None or growing_modes(model, len(u)) or not model.is_stable:
        return None
    return np.stack([model.simulate(np.where(np.arange(u.shape[1]) == j, u, 0.0)) for j in range(u.shape[1])])


def table(
    before: Stretch, after: Stretch, names: tuple[Sequence[str], Sequence[str]], level: float, believed: Sequence[str] = RAW
) -> Changes:
    """Return the table of the stretch `after` against `before`, which is without fault. `names` are those of outputs and inputs; rows of
    the kinds `believed` are seen wherever the inputs rest."""
    tests = 7 * len(names[0]) + len(names[1])
    found = _tested(before, after, names, level, tests, KINDS, believed)
    half = len(before) // 2
    suspects = [row for row in found.rows if row.seen]
    if not suspects:
        return found
    # Each row by itself: here a chance of `level` makes a row undecided, and no row seen.
    itself = _tested(before.part(0, half), before.part(half, len(before)), names, level, 1, KINDS)
    moving = {(row.kind, row.channel) for row in itself.seen}
    with suppress(InvalidData, np.linalg.LinAlgError):
        moving |= {(kind, names[0][i]) for i in drifting(before, level) for kind in (MEAN, DRIFT)}
    rows = (replace(row, seen=None, reason=ITSELF) if row.seen and (row.kind, row.channel) in moving else row for row in found.rows)
    return replace(found, rows=tuple(rows))


def _tested(
    before: Stretch,
    after: Stretch,
    names: tuple[Sequence[str], Sequence[str]],
    level: float,
    tests: int,
    kinds: Sequence[str],
    believed: Sequence[str] = RAW,
) -> Changes:
    """Return the rows of these kinds, judged together."""
    outputs, inputs = names
    one = level / tests
    evidence = []
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        try:
            if len(before) < 2:
                raise InvalidData(f"got {counted(len(before), 'sample')} without fault; two at least are needed: state more of them")
            learnt = predictor(before)
            if len(after) <= learnt.lags + 3:
                raise InvalidData(
                    f"got {counted(len(after), 'sample')} after those without fault; {learnt.lags + 4} at least are needed: state fewer"
                )
            e = learnt.innovations(after)
            if not np.all(np.isfinite(e)) or not np.all(np.isfinite(e**2)):
                raise InvalidData("numbers of the residual are too unequal to compute with, as outliers make them: mend those first")
            evidence += [*slow_changes(learnt, before, after, e, outputs, one), *changed_variances(learnt, before, after, e, outputs, one)]
            if set(kinds) == set(KINDS):
                evidence += [*sinusoids(learnt, after, e, outputs, one), *changed_gains(learnt, before, after, names, one)]
        except (InvalidData, np.linalg.LinAlgError) as error:
            asked = [(kind, name) for kind in KINDS if kind not in RAW for name in (inputs if kind == INPUT_GAIN else outputs)]
            evidence = [undecided(kind, name, str(error)) for kind, name in asked]
        if len(before) > 1:
            evidence += frozen_sensors(before, after, outputs, one)
    rows = sorted((row for row in evidence if row.kind in kinds), key=lambda row: KINDS.index(row.kind))
    return judged(rows, level, tests, (len(before), len(after)), _doubt(before, after, inputs), believed)


def _doubt(before: Stretch, after: Stretch, inputs: Sequence[str]) -> str:
    """Return why the error of the model need not be as the healthy part shows it, empty where nothing speaks for it."""
    return beyond_healthy_inputs(before.u, after.u, inputs) if before.u.shape[1] else ""


def _checked(
    residual: ArrayLike, y: ArrayLike, u: ArrayLike, outputs: Sequence[str] | None, inputs: Sequence[str] | None, level: float
) -> tuple[Stretch, tuple[Sequence[str], Sequence[str]]]:
    """Return the record as one stretch with its names."""
    r, measured, pushed = signal(residual, "residual"), signal(y, "y"), signal(u, "u")
    if r.shape != measured.shape or len(pushed) != len(r):
        raise InvalidData(
            f"residual, y, u: got shapes {r.shape}, {measured.shape}, {pushed.shape}; the first two must be alike, and all of one length"
        )
    if not 0.0 < level < 1.0:
        raise InvalidData(f"level: got {level}; a probability between 0 and 1 is needed")
    outputs = outputs if outputs is not None else [f"y{i + 1}" for i in range(r.shape[1])]
    inputs = inputs if inputs is not None else [f"u{j + 1}" for j in range(pushed.shape[1])]
    if len(outputs) != r.shape[1] or len(inputs) != pushed.shape[1]:
        raise InvalidData(f"outputs, inputs: got {len(outputs)} and {len(inputs)} names; one a channel is needed")
    return Stretch(r, measured, pushed, None), (outputs, inputs)
