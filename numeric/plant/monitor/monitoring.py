"""Watch a plant online: a model against a stream of samples, with alarms at a stated rate of false ones.

Monitor       calibrated on a healthy record; `update` for one sample, `extend` for many, to the same bytes; `save` and `load` for a break
learned_of    what a monitor learns of the record of an Identification: what model.json holds
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ....base.progress import Progress, silent
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name, plain
from ...data.records import Record, recorded
from ...data.sources import Source, record_from
from ...data.validation import signal, whole
from ...method.model.models import StateSpaceModel
from ...method.model.reduced_model import ReducedModel
from ..healthy.healthy_model import MOST_LAGS
from .alarms import MISSING, Alarm, Watched
from .innovation_form import Predictor, innovation_form
from .learned import MONITORING, Learned, array, learn
from .saving import read, write
from .statistics import MEMORY, TESTS, Bank, Latest, Settings, checked, roots
from .thresholds import LEAST_BLOCKS

SIMULATED = 5_000  # samples of the disturbance of a reduced model, where no healthy record is given
SEED = 1
ALARM_LEVEL = 1e-4  # false alarms a sample, where none are stated
MOST = 100_000  # samples of an Identification that are used: as many as ALARM_LEVEL needs to be seen
NUMBERS = 1 << 24  # and no more than the channels with their lags make so many numbers of, 128 MiB
WINDOW, SHIFT = 20, 1.0  # of the chi-square test, and of the CUSUM, where none are stated


class Monitor(Shown):
    """A Monitor holds a model against a stream of samples, and tells at a stated rate of false alarms when they no longer fit together.

    Sources: [AM79] for the predictor, [BN93] for the tests, [C88] for the multivariate CUSUM; the heads of `numeric/plant/monitor` say how
    thresholds are derived or simulated, and corrected by healthy data.

    `model` is a StateSpaceModel, or a result of identification that has one, with n states, n_u inputs and p outputs in the units of the
    data. `y` (N, p) and `u` (N, n_u) are a record without fault, by which the innovations of the model and the thresholds are calibrated,
    in any form that `identify` takes: arrays, frames, a record, or the path of a file with the names `inputs` and `outputs`. A model of
    order 0 with D = 0 makes the monitor learn an autoregressive predictor from the record alone. Without y, an Identification brings the
    samples of its own record that were stated to be healthy, else those before the first onset, else all of them, faults included, which
    `notes` say; an `arx_reduction` has a record simulated by its disturbance, in which the faults of the record that it was identified
    from count as healthy. `level` is the expected number of false alarms a sample, all tests
    together, so that 1 / level is the mean time between them; `window` the samples of the chi-square test; `shift` the change of mean
    that the CUSUM is made for, in deviations of an innovation. 10 / level healthy samples are needed for such a rate to be seen in the
    record; `notes` say where there are fewer and what follows. Look at `notes` first, then at `calibration`. `on_progress(stage, done,
    total)` hears how far the calibration is, which takes long with many outputs or a long window.

    The tests are residual (one sample of one output), chi-square (a window), cusum (a mean that moved) and hankel (the largest root of
    the moments of Hankel columns, with their rank gap). An alarm begins where a statistic crosses its threshold, and ends when it has
    been below it for a window of samples. A sample costs the same whatever came before. A missing output is NaN: the others are judged
    without it; `begun_anew` counts the gaps after which the state of an unstable model was as unknown as at the start. A change of the
    operating point that the linear model does not describe is an alarm like any other, which names the inputs
    that are beyond what the healthy record has shown; `restart` forgets the state, and a new operating point for good needs a new healthy
    record. `save` and `load` carry a monitor over a break. Raises InvalidData for records and models that do not fit, are too short or have
    no noise, and InvalidInput for files that cannot be read.

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
        level: float = ALARM_LEVEL,
        window: int = WINDOW,
        shift: float = SHIFT,
        inputs: str | Sequence[str] | None = None,
        outputs: str | Sequence[str] | None = None,
        on_progress: Progress | None = None,
    ) -> None:
        with one_thread():
            plant, rate = _plant(model), _rate(level)
            if not (isinstance(shift, float | int | np.floating) and 0 < shift < np.inf):
                raise InvalidData(f"shift: got {shorten(shift)}; needed a positive change of mean, in deviations: try 1.0")
            window = whole(window, "window", 2, "state how many samples the chi-square test sums over, 20 for example")
            settings = checked(Settings(plant.p, window, float(shift)))
            heard = on_progress or silent
            self._begin(_learned(model, plant, settings, _given(plant, y, u, inputs, outputs), heard), rate, heard)

    def _begin(self, learned: Learned, level: float, heard: Progress) -> None:
        """Take what was learned, and begin to count samples."""
        self.outputs, self.inputs, self._settings, self._learned = learned.outputs, learned.inputs, learned.settings, learned
        self.calibration = learned.calibration(level, heard)
        self._form, self._predictor = learned.form, Predictor(learned.form)
        self._bounds = (learned.least, learned.greatest)
        self._root = np.linalg.cholesky(learned.form.covariance)
        self.notes = learned.notes + self.calibration.notes
        self.samples, self.untested, self.missing = 0, 0, np.zeros(learned.settings.p, int)
        self.mark: Mapping[str, Any] | None = None  # where in a file its samples end, for whoever reads one
        self.begun_anew, self._last_anew = 0, 0  # times that the predictor did, and the sample behind which it last did
        self.alarms = dict.fromkeys((*TESTS, MISSING), 0)
        self.restart()

    @one_thread()
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the monitor, with all that it remembers, into a file of JSON (monitor.schema.json): `load` goes on as without the break.

        A saved monitor of that name is replaced, whole or not at all. Raises InvalidInput where the file cannot be written, or is another.
        """
        stream = {} if self.mark is None else {"stream": self.mark}
        write(path, self._learned.to_json() | {"level": self.calibration.level, "state": self._state()} | stream)

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, level: float | None = None, on_progress: Progress | None = None) -> Self:
        """Return the monitor of `save`, which goes on where it was; or a new one by the model of `identify`: its model.json, or its folder.

        `level` is that of the file unless stated, and 1e-4 where the file states none. Raises InvalidInput for a file that cannot be read,
        and InvalidData, which says what is wrong, for one without what a monitor needs.
        """
        return cls.from_json(read(path), level=level, on_progress=on_progress)

    @classmethod
    @one_thread()
    def from_json(cls, document: Mapping[str, Any], *, level: float | None = None, on_progress: Progress | None = None) -> Self:
        """Return the monitor in a document of `save`, or in that of a model with what monitoring needs, as `load` does."""
        document = document.get(MONITORING, document) if isinstance(document, Mapping) else document
        learned = Learned.from_json(document)
        made = cls.__new__(cls)
        made._begin(learned, _rate(document.get("level", ALARM_LEVEL) if level is None else level), on_progress or silent)
        if "state" in document:
            made._resume(document["state"])
        if "stream" in document:
            made.mark = _mark(document["stream"])
        return made

    def _state(self) -> dict[str, Any]:
        """Return what changes from sample to sample, JSON-ready; null stands for what is unknown or has never been."""
        numbers, recent = self._latest.in_order()
        return {
            "samples": self.samples,
            "not_judged": self.untested,
            "missing": self.missing.tolist(),
            "alarms": dict(self.alarms),
            "absent": self._absent.tolist(),
            "quiet": self._quiet.tolist(),
            "beyond": plain(self._beyond),
            "statistics": plain(self.statistics),
            "numbers": numbers.tolist(),
            "recent": plain(recent),
            "bank": {name: values.tolist() for name, values in self._bank.state().items()},
            "state": self._predictor.state.tolist(),
            "root": plain(self._predictor.root),
            "begun_anew": self.begun_anew,
            "last_anew": self._last_anew,
        }

    def _resume(self, state: Any) -> None:
        """Go on from a state that `_state` told. Raises InvalidData, which names the key, for anything else."""
        if not isinstance(state, Mapping) or not isinstance(state.get("bank"), Mapping) or not isinstance(state.get("alarms"), Mapping):
            raise InvalidData(f"state: got {shorten(state)}, expected the state of a saved monitor")
        p, d = self._settings.p, len(self._form.A)
        self.samples = _counts(state, "samples", ()).item()
        self.untested = _counts(state, "not_judged", ()).item()
        self.missing, self._absent = _counts(state, "missing", (p,)), _counts(state, "absent", (p,))
        self.alarms = {test: _counts(state["alarms"], test, ()).item() for test in self.alarms}
        self._quiet = _counts(state, "quiet", (len(TESTS),))
        self._beyond = array(state, "beyond", (len(self.inputs),), missing=-np.inf)
        self.statistics = array(state, "statistics", (len(TESTS),), missing=np.nan)
        memory = self._settings.memory
        self._latest = Latest(_counts(state, "numbers", (memory,)), array(state, "recent", (memory, p)))
        bank = {name: array(state["bank"], name, values.shape) for name, values in self._bank.state().items()}
        if not 0 <= bank["place"] < self._settings.window:
            raise InvalidData(f"place: got {shorten(state['bank']['place'])}, expected a place in the window of {self._settings.window}")
        self._bank.resume(bank)
        self._predictor.state = array(state, "state", (d,))
        root = state.get("root")
        wide = len(root[0]) if isinstance(root, list) and root and isinstance(root[0], list) else 0
        self._predictor.root = None if root is None else array(state, "root", (d, wide if wide <= d + p else d))
        self.begun_anew, self._last_anew = _counts(state, "begun_anew", ()).item(), _counts(state, "last_anew", ()).item()

    def restart(self) -> None:
        """Forget the state of the plant and of the tests, as after a pause of unknown length; samples are counted on."""
        self._predictor.restart()
        cusum = float(self.calibration.threshold[TESTS.index("cusum")])
        self._bank = Bank(self._settings, 1, 2 * cusum)
        memory = self._settings.memory
        self._latest = Latest(np.full(memory, self.samples), np.zeros((memory, self._settings.p)))
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
        begun = self._lacking(number, missing) if missing.any() or self._absent.any() else []
        self._beyond[(u < self._bounds[0]) | (u > self._bounds[1])] = number
        judged = self._predictor.step(y, u)
        if self._predictor.begun_anew:
            self.begun_anew += self._last_anew <= number + 1 - int(self._absent.min())  # once a gap
            self._last_anew = number + 1
        if judged is None:
            self.untested += 1
            self.statistics = np.full(len(TESTS), np.nan)
            return tuple(begun), np.full(len(y), np.nan)
        z, s = judged
        self._latest.add(number, z)
        self.statistics = self._bank.update(z[None], s[None])[0]
        above = self.statistics > self.calibration.threshold
        fresh = above & (self._quiet >= self._settings.window)
        self._quiet = np.where(above, 0, self._quiet + 1)
        if fresh.any():
            begun += [self._alarm(number, int(test), s) for test in np.flatnonzero(fresh)]
        return tuple(begun), z

    def _lacking(self, number: int, missing: NDArray[np.bool_]) -> list[Alarm]:
        """Count the outputs that are missing, and return the alarms of those that are for a window now."""
        self.missing += missing
        self._absent = np.where(missing, self._absent + 1, 0)
        return [self._gone(number, int(i)) for i in np.flatnonzero(self._absent == self._settings.window)]

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
            share, onset = bank.scores[0], self._latest.changed()
        elif name == "cusum":
            share, onset = (self._root @ bank.sums[0] / deviations) ** 2, self._latest.moved()
        else:
            share = np.sum((bank.direction[0].reshape(rows, -1) @ self._root.T / deviations) ** 2, axis=0)
            onset = self._latest.changed()
        self.alarms[name] += 1
        outputs = tuple(self.outputs[i] for i in np.argsort(-share, kind="stable") if 2 * share[i] >= share.max())
        beyond = tuple(self.inputs[j] for j in np.flatnonzero(self._beyond > number - self._settings.window))
        threshold = float(self.calibration.threshold[test])
        return Alarm(number, name, float(self.statistics[test]), threshold, outputs, onset, self._rank_gap(), beyond)

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
        if self.begun_anew:
            yield "state unknown again", f"{counted(self.begun_anew, 'time')}, too much missing for an unstable model"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of what the sheet tells."""
        found = self.calibration
        return {
            **by_name(self, "outputs", "inputs", "notes", "samples", "missing", "begun_anew", "alarms"),
            **by_name(self._settings, "window", "shift"),
            **by_name(found, "level", "healthy_alarms"),
            "tests": list(TESTS),
            "thresholds": plain(found.threshold),
            "gaussian_thresholds": plain(found.ideal),
            "healthy_samples": found.samples,
            "healthy_samples_needed": found.needed,
            "lags": self._form.lags,
            "not_judged": self.untested,
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


def _rate(level: Any) -> float:
    if not (isinstance(level, float | np.floating) and 0 < level <= 0.1):
        raise InvalidData(f"level: got {shorten(level)}; needed the false alarms a sample, above 0 and at most 0.1: try 1e-4")
    return float(level)


def _given(
    plant: StateSpaceModel, y: Source | None, u: Any, inputs: str | Sequence[str] | None, outputs: str | Sequence[str] | None
) -> Record | None:
    """Return the healthy record that was given, None where there is none."""
    if y is None:
        return None
    if isinstance(y, np.ndarray) and not plant.n_u and (u is None or not np.size(u)):
        alone = signal(y, "y")
        names = [f"y{i + 1}" for i in range(alone.shape[1])] if outputs is None else outputs
        return recorded(alone, np.zeros((len(alone), 0)), outputs=names, inputs=())
    return record_from(y, u, inputs=inputs, outputs=outputs)


def _learned(model: Any, plant: StateSpaceModel, settings: Settings, record: Record | None, heard: Progress) -> Learned:
    """Return what the given record teaches, or where there is none, what the model or identification brings."""
    if record is not None:
        return learn(plant, record.y, record.u, settings, names=(record.outputs, record.inputs), heard=heard)
    if isinstance(getattr(model, "record", None), Record):
        return learned_of(model, settings)
    if not isinstance(_reduced(model), ReducedModel):
        raise InvalidData("healthy: got no record without fault, and the model does not tell what its errors are like: give y and u")
    note = (
        "no healthy record was given: what disturbed the record that the model is from counts as healthy, faults included, and the "
        "errors of the model are left out, so that more false alarms than stated are to be expected"
    )
    return learn(plant, *_simulated(model), settings, with_inputs=False, notes=(note,))


@one_thread()
def learned_of(found: Any, settings: Settings | None = None) -> Learned:
    """Return what the record of an Identification teaches: of the samples that were stated to be healthy; else of those before the first
    onset that leaves enough; else of the whole record. A note says which, where none were stated. Of several experiments, which do not go
    on from one to the next and have operating points of their own, it is the longest.

    Without `settings` the window is WINDOW, or what so few samples allow. Raises InvalidData where these are too few for any, or there is
    no noise.
    """
    plant = _plant(found)
    one, which = found, ""
    if found.parts and found.healthy is None:
        number = int(np.argmax([len(part.record) for part in found.parts]))
        one, which = found.parts[number], f" of experiment {number + 1}, the longest,"
    own = found.operating_point.by_experiment
    # A stream comes as it is measured.
    record = one.record.about(-own[number] if which and own else np.zeros_like(one.record.offset))

    def of(samples: int, *notes: str) -> Learned:
        part = record.beginning(min(samples, MOST, NUMBERS // (MOST_LAGS * (record.p + record.n_u))))
        fitted = innovation_form(plant, part.y, part.u, with_inputs=True)
        allowed = max(2, min(WINDOW, len(fitted.errors) // (LEAST_BLOCKS * MEMORY)))
        small = f"so few samples allow a window of {allowed} samples, not of {WINDOW}"
        notes += (small,) if settings is None and allowed < WINDOW else ()
        chosen = Settings(plant.p, allowed, SHIFT) if settings is None else settings
        return learn(plant, part.y, part.u, chosen, fitted=fitted, names=(part.outputs, part.inputs), notes=notes)

    if isinstance(found.healthy, int):
        return of(found.healthy)
    starts = [] if one.onset is None else [onset.interval[0] for onset in one.onset.onsets]
    for number, first in enumerate(starts):
        among = f", though it changes before, at sample {starts[0]}" if number else ""
        try:
            made = of(
                first,
                f"no samples were stated to be without fault: the first {first}{which} count as such, before the residual changes{among}",
            )
        except InvalidData:
            continue  # too few
        if made.settings.window >= WINDOW or settings is not None:
            return made
    return of(
        len(record),
        f"no samples were stated to be without fault: all{which or ' that the model is from'} count as such, so that a fault like one that "
        "acted there gives no alarm; a record without fault beside the model mends that",
    )


def _counts(document: Mapping[str, Any], key: str, shape: tuple[int, ...]) -> Any:
    """Return the integers under `key`, of this shape."""
    found = array(document, key, shape)
    if np.any(found != np.rint(found)) or np.any(found < 0) or np.any(found > 2.0**53):
        raise InvalidData(f"{key}: got {shorten(document[key])}, expected counts, integers from 0 to 2^53")
    return found.astype(int)


def _mark(stream: Any) -> Mapping[str, Any]:
    """Return where in a file the samples end. Raises InvalidData for what is none."""
    texts = isinstance(stream, Mapping) and all(isinstance(stream.get(key), str) for key in ("first", "last", "head"))
    if not texts or set(stream) != {"bytes", "line", "first", "last", "head"}:
        raise InvalidData(f"stream: got {shorten(stream)}, expected how far a file was read")
    counts = {key: _counts(stream, key, ()).item() for key in ("bytes", "line")}
    return dict(stream) | counts


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
    row = np.atleast_1d(_numbers(values))
    if row.shape != (width,):
        raise InvalidData(f"{name}: got {shorten(values)}; needed {counted(width, 'number')}, one for each {noun} of one sample")
    return row


def _rows(values: ArrayLike, width: int, name: str, noun: str) -> Array:
    rows = _numbers(values)
    rows = rows[:, None] if rows.ndim == 1 and width == 1 else rows
    if rows.ndim != 2 or rows.shape[1] != width:
        hint = "; it looks transposed" if rows.ndim == 2 and rows.shape[0] == width else ""
        raise InvalidData(f"{name}: got shape {rows.shape}; needed (samples, {width}), one column for each {noun}{hint}")
    return rows


def _numbers(values: ArrayLike) -> Array:
    """Return the real numbers, infinite where no float holds them; an array of no shape that is wanted for what are none."""
    try:
        with np.errstate(over="ignore"):
            numbers = np.asarray(values, dtype=np.float64) if np.asarray(values).dtype.kind != "c" else np.zeros((0, 0))
    except (TypeError, ValueError, OverflowError):
        numbers = np.zeros((0, 0))
    return numbers
