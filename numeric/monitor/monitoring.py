"""Watch a plant online: a model against a stream of samples, with alarms at a stated rate of false ones.

Monitor     calibrated on a healthy record; `update` for one sample, `extend` for many, to the same bytes
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...base.arrays import Array
from ...base.errors import InvalidData, shorten
from ...base.sheets import Shown, counted
from ...base.threads import one_thread
from ..data.plain import plain
from ..data.records import Record, recorded
from ..data.sources import Source, record_from
from ..data.validation import signal, whole
from ..model.models import StateSpaceModel
from ..model.reduced_model import ReducedModel
from .alarms import MISSING, Alarm, Watched
from .innovation_form import Predictor, innovation_form
from .statistics import TESTS, Bank, Settings, roots
from .thresholds import calibrate

SIMULATED = 5_000  # samples of the disturbance of a reduced model, where no healthy record is given
SEED = 1
MARGIN = 0.1  # of the range of an input


class Monitor(Shown):
    """A Monitor holds a model against a stream of samples, and tells at a stated rate of false alarms when they no longer fit together.

    Sources: [AM79] for the predictor, [BN93] for the tests, [C88] for the multivariate CUSUM; the heads of `numeric/monitor` say how
    thresholds are derived or simulated, and corrected by healthy data.

    `model` is a StateSpaceModel, or a result of identification that has one, with n states, n_u inputs and p outputs in the units of the
    data. `y` (N, p) and `u` (N, n_u) are a record without fault, by which the innovations of the model and the thresholds are calibrated,
    in any form that `identify` takes: arrays, frames, a record, or the path of a file with the names `inputs` and `outputs`. A model of
    order 0 with D = 0 makes the monitor learn an autoregressive predictor from the record alone. Without y, an Identification with
    samples stated to be healthy brings these; any other `arx_reduction` has a record simulated by its disturbance, in which the faults
    of the record that it was identified from count as healthy. `level` is the expected number of false alarms a sample, all tests
    together, so that 1 / level is the mean time between them; `window` the samples of the chi-square test; `shift` the change of mean
    that the CUSUM is made for, in deviations of an innovation. 10 / level healthy samples are needed for such a rate to be seen in the
    record; `notes` say where there are fewer and what follows. Look at `notes` first, then at `calibration`.

    The tests are residual (one sample of one output), chi-square (a window), cusum (a mean that moved) and hankel (the largest root of
    the moments of Hankel columns, with their rank gap). An alarm begins where a statistic crosses its threshold, and ends when it has
    been below it for a window of samples. A sample costs the same whatever came before. A missing output is NaN: the others are judged
    without it. A change of the operating point that the linear model does not describe is an alarm like any other, which names the inputs
    that are beyond what the healthy record has shown; `restart` forgets the state, and a new operating point for good needs a new healthy
    record. Raises InvalidData for records and models that do not fit, are too short or have no noise, and InvalidInput for files that
    cannot be read.

    >>> import numpy as np
    >>> import faultspace as fs
    >>> model = fs.numeric.StateSpaceModel([[0.5]], [[1.0]], [[1.0], [2.0]], [[0.0], [0.0]])
    >>> draw = np.random.default_rng(1)
    >>> u, noise = draw.standard_normal((1300, 1)), 0.1 * draw.standard_normal((1300, 2))
    >>> y = model.simulate(u) + noise
    >>> watch = fs.Monitor(model, y[:1000], u[:1000], level=1e-3)
    >>> y[1200:, 1] += 0.5
    >>> first = watch.extend(y[1000:], u[1000:]).alarms[0]
    >>> first.outputs, abs(first.onset - 200) < 5
    (('y2',), True)
    """

    def __init__(
        self,
        model: Any,
        y: Source | None = None,
        u: Any = None,
        *,
        level: float = 1e-4,
        window: int = 20,
        shift: float = 1.0,
        inputs: str | Sequence[str] | None = None,
        outputs: str | Sequence[str] | None = None,
    ) -> None:
        with one_thread():
            plant, found = _plant(model), model
            if not (isinstance(level, float | np.floating) and 0 < level <= 0.1):
                raise InvalidData(f"level: got {shorten(level)}; needed the false alarms a sample, above 0 and at most 0.1: try 1e-4")
            if not (isinstance(shift, float | int | np.floating) and 0 < shift < np.inf):
                raise InvalidData(f"shift: got {shorten(shift)}; needed a positive change of mean, in deviations: try 1.0")
            window = whole(window, "window", 2, "state how many samples the chi-square test sums over, 20 for example")
            record = _healthy(found, y, u, inputs, outputs)
            simulated = record is None
            healthy = _simulated(found) if record is None else (record.y, record.u)
            if (healthy[0].shape[1], healthy[1].shape[1]) != (plant.p, plant.n_u):
                raise InvalidData(
                    f"healthy: got {counted(healthy[0].shape[1], 'output')} and {counted(healthy[1].shape[1], 'input')}; the model has "
                    f"{counted(plant.p, 'output')} and {counted(plant.n_u, 'input')}: give the channels of the model, in its order"
                )
            fitted = innovation_form(plant, *healthy, with_inputs=not simulated)
            self.outputs = tuple(f"y{i + 1}" for i in range(plant.p)) if record is None else record.outputs
            self.inputs = tuple(f"u{i + 1}" for i in range(plant.n_u)) if record is None else record.inputs
            self._settings = Settings(plant.p, window, float(shift))
            self.calibration = calibrate(self._settings, float(level), fitted.errors, fitted.sizes)
            self._form, self._predictor = fitted.form, Predictor(fitted.form)
            bounds = (np.full(plant.n_u, -np.inf), np.full(plant.n_u, np.inf))
            self._bounds = bounds if simulated else _bounds(healthy[1])
            self._root = np.linalg.cholesky(fitted.form.covariance)
            told = (
                "no healthy record was given: what disturbed the record that the model is from counts as healthy, faults included, and the "
                "errors of the model are left out, so that more false alarms than stated are to be expected"
            )
            self.notes = ((told,) if simulated else ()) + self.calibration.notes
            self.samples, self.untested, self.missing = 0, 0, np.zeros(plant.p, int)
            self.alarms = dict.fromkeys((*TESTS, MISSING), 0)
            self.restart()

    def restart(self) -> None:
        """Forget the state of the plant and of the tests, as after a pause of unknown length; samples are counted on."""
        self._predictor.restart()
        cusum = float(self.calibration.threshold[TESTS.index("cusum")])
        self._bank = Bank(self._settings, 1, 2 * cusum)
        self._numbers = np.full(self._settings.memory, self.samples)
        self._recent = np.zeros((self._settings.memory, self._settings.p))  # innovations, the latest last
        self._quiet = np.full(len(TESTS), self._settings.window)  # samples below the threshold
        self._absent = np.zeros(self._settings.p, int)  # samples missing in a row
        self._beyond = np.full(len(self.inputs), -np.inf)  # sample at which an input was last beyond
        self.statistics = np.full(len(TESTS), np.nan)

    @one_thread()
    def update(self, y: ArrayLike, u: ArrayLike = ()) -> tuple[Alarm, ...]:
        """Take one sample y (p,) and u (n_u,), NaN where one is missing, and return the alarms that begin with it.

        `statistics` (4,) then has what the tests made of it, NaN where they could not judge it. Raises InvalidData for other shapes.
        """
        return self._sample(_row(y, self._settings.p, "y", "output"), _row(u, len(self.inputs), "u", "input"))[0]

    @one_thread()
    def extend(self, y: ArrayLike, u: ArrayLike | None = None) -> Watched:
        """Take samples y (N, p) and u (N, n_u), one after the other, as `update` does, to the same bytes. Raises InvalidData for other
        shapes."""
        values = _rows(y, self._settings.p, "y", "output")
        inputs = np.zeros((len(values), 0)) if u is None else _rows(u, len(self.inputs), "u", "input")
        if inputs.shape != (len(values), len(self.inputs)):
            raise InvalidData(f"u: got shape {inputs.shape}; needed ({len(values)}, {len(self.inputs)}): a row for each sample of y")
        first = self.samples
        alarms: list[Alarm] = []
        statistics, innovations = np.empty((len(values), len(TESTS))), np.empty(values.shape)
        for k, (sample, pushed) in enumerate(zip(values, inputs, strict=True)):
            begun, innovations[k] = self._sample(sample, pushed)
            alarms += begun
            statistics[k] = self.statistics
        return Watched(first, tuple(alarms), statistics, innovations)

    def _sample(self, y: Array, u: Array) -> tuple[tuple[Alarm, ...], Array]:
        """Return the alarms that begin with this sample, and its innovations."""
        number = self.samples
        self.samples += 1
        missing = ~np.isfinite(y)
        self.missing += missing
        self._absent = np.where(missing, self._absent + 1, 0)
        self._beyond[(u < self._bounds[0]) | (u > self._bounds[1])] = number
        judged = self._predictor.step(y, u)
        begun = [self._gone(number, int(i)) for i in np.flatnonzero(self._absent == self._settings.window)]
        if judged is None:
            self.untested += 1
            self.statistics = np.full(len(TESTS), np.nan)
            return tuple(begun), np.full(len(y), np.nan)
        z, s = judged
        self._numbers[:-1], self._recent[:-1] = self._numbers[1:], self._recent[1:]
        self._numbers[-1], self._recent[-1] = number, z
        self.statistics = self._bank.update(z[None], s[None])[0]
        above = self.statistics > self.calibration.threshold
        fresh = above & (self._quiet >= self._settings.window)
        self._quiet = np.where(above, 0, self._quiet + 1)
        begun += [self._alarm(number, int(test), s) for test in np.flatnonzero(fresh)]
        return tuple(begun), z

    def _gone(self, number: int, output: int) -> Alarm:
        self.alarms[MISSING] += 1
        run = self._settings.window
        return Alarm(number, MISSING, float(run), float(run - 1), (self.outputs[output],), number - run + 1, 0, ())

    def _alarm(self, number: int, test: int, s: Array) -> Alarm:
        """Return the alarm of this test, with what its statistic is made of."""
        bank, name, rows = self._bank, TESTS[test], self._settings.rows
        deviations = np.sqrt(np.diag(self._form.covariance))
        if name == "residual":
            share, onset = s * s, number
        elif name == "chi-square":
            share, onset = bank.scores[0], self._changed()
        elif name == "cusum":
            share, onset = (self._root @ bank.sums[0] / deviations) ** 2, self._moved()
        else:
            share = np.sum((bank.direction[0].reshape(rows, -1) @ self._root.T / deviations) ** 2, axis=0)
            onset = self._changed()
        self.alarms[name] += 1
        outputs = tuple(self.outputs[i] for i in np.argsort(-share, kind="stable") if 2 * share[i] >= share.max())
        beyond = tuple(self.inputs[j] for j in np.flatnonzero(self._beyond > number - self._settings.window))
        threshold = float(self.calibration.threshold[test])
        return Alarm(number, name, float(self.statistics[test]), threshold, outputs, onset, self._rank_gap(), beyond)

    def _changed(self) -> int:
        """Return the sample from which the power of the innovations most likely was larger, among those remembered: of m Gaussian samples
        with p outputs and the power q the likelihood ratio is m (q - p - p log(q / p)) / 2."""
        p, counts = self._settings.p, np.arange(1, self._settings.memory + 1)
        power = np.cumsum(np.sum(self._recent[::-1] ** 2, axis=1)) / counts
        ratio = np.where(power > p, counts * (power - p - p * np.log(np.maximum(power, p) / p)), 0.0)
        return int(self._numbers[-1 - int(np.argmax(ratio))])

    def _moved(self) -> int:
        """Return the sample from which the mean of the innovations most likely was another, among those remembered: of m samples with the
        sum S the likelihood ratio is S'S / (2 m)."""
        sums = np.cumsum(self._recent[::-1], axis=0)
        ratio = np.sum(sums**2, axis=1) / np.arange(1, self._settings.memory + 1)
        return int(self._numbers[-1 - int(np.argmax(ratio))])

    def _rank_gap(self) -> int:
        """Return by how much the rank of the Hankel moments grows with a block row, noise left out."""
        p, moments = self._settings.p, self._bank.moments[0]
        bound = float(self.calibration.threshold[TESTS.index("hankel")])
        full, fewer = (int(np.sum(roots(part) > bound)) for part in (moments, moments[p:, p:]))
        return max(full - fewer, 0)

    @property
    def title(self) -> str:
        """Return what is watched, at which rate."""
        return (
            f"monitor of {counted(self._settings.p, 'output')} and {counted(len(self.inputs), 'input')}, "
            f"{self.calibration.level:g} false alarms a sample"
        )

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield notes, what the predictor and the thresholds rest on, and what has been seen so far."""
        yield from (("note", note) for note in self.notes)
        found = self.calibration
        yield "healthy errors, lags", f"{found.samples}, {self._form.lags}"
        for test, threshold, ideal, alarms in zip(TESTS, found.threshold, found.ideal, found.healthy_alarms, strict=True):
            yield f"threshold of {test}", f"{threshold:.4g} ({ideal:.4g} for Gaussian errors), {counted(alarms, 'healthy alarm')}"
        yield "samples seen, not judged", f"{self.samples}, {self.untested}"
        yield "alarms", ", ".join(f"{count} {test}" for test, count in self.alarms.items())
        gaps = [f"{name} {count}" for name, count in zip(self.outputs, self.missing, strict=True) if count]
        if gaps:
            yield "missing", ", ".join(gaps)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of what the sheet tells."""
        found = self.calibration
        return {
            "outputs": list(self.outputs),
            "inputs": list(self.inputs),
            "level": found.level,
            "window": self._settings.window,
            "shift": self._settings.shift,
            "tests": list(TESTS),
            "thresholds": plain(found.threshold),
            "gaussian_thresholds": plain(found.ideal),
            "healthy_samples": found.samples,
            "healthy_samples_needed": found.needed,
            "healthy_alarms": list(found.healthy_alarms),
            "lags": self._form.lags,
            "notes": list(self.notes),
            "samples": self.samples,
            "not_judged": self.untested,
            "missing": plain(self.missing),
            "alarms": dict(self.alarms),
        }


def _plant(model: Any) -> StateSpaceModel:
    """Return the state-space model in what was given."""
    inner = model
    while not isinstance(inner, StateSpaceModel):
        inner = getattr(inner, "model", None)
        if inner is None:
            what = "an identification whose order stayed open" if hasattr(model, "model") else shorten(model)
            raise InvalidData(f"model: got {what}; needed a StateSpaceModel, or a result of identification that has one")
    return inner


def _healthy(
    model: Any, y: Source | None, u: Any, inputs: str | Sequence[str] | None, outputs: str | Sequence[str] | None
) -> Record | None:
    """Return the healthy record that was given, or that an Identification has; None where there is none."""
    if y is not None:
        if isinstance(y, np.ndarray) and not _plant(model).n_u and (u is None or not np.size(u)):
            alone = signal(y, "y")
            names = [f"y{i + 1}" for i in range(alone.shape[1])] if outputs is None else outputs
            return recorded(alone, np.zeros((len(alone), 0)), outputs=names, inputs=())
        return record_from(y, u, inputs=inputs, outputs=outputs)
    record, healthy = getattr(model, "record", None), getattr(model, "healthy", None)
    if isinstance(record, Record) and isinstance(healthy, int):
        return replace(record, offset=np.zeros_like(record.offset)).beginning(healthy)  # a stream comes as it is measured
    if isinstance(_reduced(model), ReducedModel):
        return None
    raise InvalidData("healthy: got no record without fault, and the model does not tell what its errors are like: give y and u")


def _bounds(u: Array) -> tuple[Array, Array]:
    """Return what the inputs may reach before they count as beyond the healthy record: its range and MARGIN of it on both sides."""
    least, greatest = u.min(axis=0), u.max(axis=0)
    return least - MARGIN * (greatest - least), greatest + MARGIN * (greatest - least)


def _reduced(model: Any) -> Any:
    return model if isinstance(model, ReducedModel) else getattr(model, "model", None)


def _simulated(model: Any) -> tuple[Array, Array]:
    """Return a record that the ARX disturbance of a reduced model makes, about its operating point, with no input."""
    found = _reduced(model)
    if found.arx.radius() >= 1:
        raise InvalidData("healthy: the disturbance of the model is unstable, and cannot be simulated: give y and u without fault")
    draw, settle = np.random.default_rng(SEED), SIMULATED // 10
    e = draw.standard_normal((SIMULATED + settle, len(found.arx.covariance))) @ np.linalg.cholesky(found.arx.covariance).T
    d = np.zeros_like(e)
    for k in range(len(e)):
        d[k] = e[k] - sum((found.arx.outputs[j] @ d[k - j] for j in range(1, min(k, found.arx.order) + 1)), np.zeros(e.shape[1]))
    level = np.zeros(e.shape[1]) if found.offset is None else found.offset
    return d[settle:] + level, np.zeros((SIMULATED, found.model.n_u))


def _row(values: ArrayLike, width: int, name: str, noun: str) -> Array:
    try:
        row = np.atleast_1d(np.asarray(values, dtype=np.float64))
    except (TypeError, ValueError):
        row = np.zeros(0)
    if row.shape != (width,):
        raise InvalidData(f"{name}: got {shorten(values)}; needed {counted(width, 'number')}, one for each {noun} of one sample")
    return row


def _rows(values: ArrayLike, width: int, name: str, noun: str) -> Array:
    try:
        rows = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        rows = np.zeros(())
    rows = rows[:, None] if rows.ndim == 1 and width == 1 else rows
    if rows.ndim != 2 or rows.shape[1] != width:
        hint = "; it looks transposed" if rows.ndim == 2 and rows.shape[0] == width else ""
        raise InvalidData(f"{name}: got shape {rows.shape}; needed (samples, {width}), one column for each {noun}{hint}")
    return rows
