"""What a monitor has learned of a record without fault, in a form that a file can hold: `monitoring` of model.json, or a saved Monitor.

    learn           from a model and a healthy record
    Learned         the innovation form, the names and ranges of the channels, and the largest healthy statistics
    from_json       what a file holds, checked
    calibration     thresholds for a rate of false alarms; they need no healthy sample any more

The largest statistics of each healthy block stand in the file rather than thresholds, so that the rate can be chosen when the watch begins.
The window and the shift cannot: other ones have other statistics.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ....base.progress import Progress, silent
from ....base.sheets import counted
from ...data.plain import by_name
from ...data.validation import whole
from ...method.model.models import FORMAT as MODEL_FORMAT
from ...method.model.models import StateSpaceModel
from .innovation_form import Fitted, Form, Units, innovation_form
from .statistics import TESTS, Settings, checked
from .thresholds import Calibration, calibrated, largest_of_blocks

FORMAT = "faultspace-monitor/1"
MONITORING = "monitoring"  # the key of model.json under which it stands
LARGEST = float(np.sqrt(np.finfo(float).max))
MARGIN = 0.1  # of the range of an input, by which it may leave it


@dataclass(frozen=True, eq=False)
class Learned:
    """The `form`, what the tests are (`settings`), and what the healthy record showed.

    `maxima` (blocks, 4) are the largest statistics of each block of the healthy `samples`, in the order of the tests. The inputs stay
    between `least` and `greatest` (n_u,) unless they are beyond what the record has shown; these are infinite where it shows nothing of
    inputs. `notes` say where the record comes from, where this must be known.
    """

    form: Form
    settings: Settings
    maxima: Array
    samples: int
    least: Array
    greatest: Array
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    notes: tuple[str, ...]

    def calibration(self, level: float, heard: Progress = silent) -> Calibration:
        """Return the thresholds for `level` false alarms a sample, all tests together."""
        return calibrated(self.settings, level, self.maxima, self.samples, heard)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict; null stands for infinite. Floats come back bit for bit."""
        form = self.form
        return {
            "format": FORMAT,
            **by_name(self, "outputs", "inputs", "samples", "notes", "least", "greatest", "maxima"),
            **by_name(self.settings, "window", "shift"),
            **by_name(form, "lags", "parameters"),
            "units": by_name(form.units),
            "form": by_name(form, *_MATRICES),
        }

    @classmethod
    def from_json(cls, document: Any) -> Self:
        """Return what `to_json` made. Raises InvalidData, which names the key, for anything else."""
        if isinstance(document, Mapping) and document.get("format") == MODEL_FORMAT:
            raise InvalidData(
                'the model has no "monitoring", which says what its errors are like without fault: it is of an earlier version, or of a '
                "record that was too short or without noise: give a record without fault beside it, or identify it again"
            )
        if not isinstance(document, Mapping) or document.get("format") != FORMAT:
            got = document.get("format") if isinstance(document, Mapping) else document
            raise InvalidData(f'got format {shorten(got)}, expected a monitor of "format": "{FORMAT}"')
        outputs, inputs = _names(document, "outputs"), _names(document, "inputs")
        p, n_u = len(outputs), len(inputs)
        if not p:
            raise InvalidData("outputs: got no name, expected one for each output that is watched")
        units, shift = _part(document, "units"), array(document, "shift", ())
        if not shift > 0:
            raise InvalidData(f"shift: got {shorten(document['shift'])}, expected a positive number")
        settings = checked(Settings(p, _count(document, "window", 2), float(shift)))
        inside = _part(document, "form")
        states = inside.get("push")
        d = len(states) if isinstance(states, list) else 0
        shapes = {"A": (d, d), "B": (d, n_u), "C": (p, d), "D": (p, n_u), "K": (d, p), "push": (d,), "level": (p,)}
        shapes |= {"covariance": (p, p), "unknown": (d, d)}
        form = Form(
            **{name: array(inside, name, shapes[name]) for name in _MATRICES},
            units=Units(
                array(units, "centre", (p,)),
                _positive(units, "scale", p),
                array(units, "input_centre", (n_u,)),
                _positive(units, "input_scale", n_u),
            ),
            lags=_count(document, "lags", 0),
            parameters=_count(document, "parameters", 0),
        )
        if not (_is_covariance(form.covariance, definite=True) and _is_covariance(form.unknown, definite=False)):
            raise InvalidData("form: got a covariance that is none, expected symmetric ones without negative variances")
        blocks = document.get("maxima")
        maxima = array(document, "maxima", (len(blocks) if isinstance(blocks, list) else 0, len(TESTS)))
        samples = _count(document, "samples", 1)
        if not len(maxima) or len(maxima) != samples // settings.memory:
            raise InvalidData(
                f"maxima: got {counted(len(maxima), 'block')} of {settings.memory} samples in {shorten(samples)} healthy samples, expected "
                "as many as there are, and one at least"
            )
        return cls(
            form,
            settings,
            maxima,
            samples,
            array(document, "least", (n_u,), missing=-np.inf),
            array(document, "greatest", (n_u,), missing=np.inf),
            outputs,
            inputs,
            _names(document, "notes"),
        )


_MATRICES = ("A", "B", "C", "D", "K", "push", "level", "covariance", "unknown")


def learn(
    plant: StateSpaceModel,
    y: Array,
    u: Array,
    settings: Settings,
    *,
    fitted: Fitted | None = None,
    names: tuple[tuple[str, ...], tuple[str, ...]] | None = None,
    with_inputs: bool = True,
    notes: tuple[str, ...] = (),
    heard: Progress = silent,
) -> Learned:
    """Return what the healthy y (N, p) and u (N, n_u) teach, the channels called by `names` of outputs and inputs.

    `with_inputs` is as for `innovation_form`, which makes `fitted`; without it nothing is known of the range of the inputs. Raises
    InvalidData for another number of channels, and for records that are too short or have no noise.
    """
    if (y.shape[1], u.shape[1]) != (plant.p, plant.n_u):
        raise InvalidData(
            f"healthy: got {counted(y.shape[1], 'output')} and {counted(u.shape[1], 'input')}; the model has "
            f"{counted(plant.p, 'output')} and {counted(plant.n_u, 'input')}: give the channels of the model, in its order"
        )
    fitted = innovation_form(plant, y, u, with_inputs=with_inputs) if fitted is None else fitted
    maxima = largest_of_blocks(settings, fitted.errors, fitted.sizes, heard)
    beyond = np.full(plant.n_u, np.inf)
    least, greatest = _bounds(u) if with_inputs else (-beyond, beyond)
    own = (tuple(f"y{i + 1}" for i in range(plant.p)), tuple(f"u{i + 1}" for i in range(plant.n_u)))
    outputs, inputs = own if names is None else names
    return Learned(fitted.form, settings, maxima, len(fitted.errors), least, greatest, outputs, inputs, notes)


def array(document: Mapping[str, Any], key: str, shape: tuple[int, ...], *, missing: float | None = None) -> Array:
    """Return the numbers under `key`, of this shape; null is `missing` where that is given. Raises InvalidData that names the key."""
    if key not in document:
        raise InvalidData(f"{key}: is missing, expected an array of shape {shape}")
    try:
        found = np.array(document[key], dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InvalidData(f"{key}: got what is no array of numbers, expected one of shape {shape}") from None
    found = found.reshape(shape) if found.size == 0 and 0 in shape else found
    if found.shape != shape:
        raise InvalidData(f"{key}: got shape {found.shape}, expected {shape}")
    if np.any(np.abs(found) > LARGEST):
        raise InvalidData(f"{key}: got {np.abs(found).max():g}, expected numbers whose squares a float holds")
    if missing is not None:
        found = np.where(np.isnan(found), missing, found)
    elif not np.all(np.isfinite(found)):
        raise InvalidData(f"{key}: got a number that is missing or not finite, expected finite ones")
    return found


def _bounds(u: Array) -> tuple[Array, Array]:
    """Return what the inputs may reach before they count as beyond the healthy record: its range and MARGIN of it on both sides."""
    least, greatest = u.min(axis=0), u.max(axis=0)
    return least - MARGIN * (greatest - least), greatest + MARGIN * (greatest - least)


def _part(document: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    found = document.get(key)
    if not isinstance(found, Mapping):
        raise InvalidData(f"{key}: got {shorten(found)}, expected an object")
    return found


def _names(document: Mapping[str, Any], key: str) -> tuple[str, ...]:
    found = document.get(key)
    if not isinstance(found, list) or not all(isinstance(one, str) for one in found):
        raise InvalidData(f"{key}: got {shorten(found)}, expected a list of texts")
    return tuple(found)


def _count(document: Mapping[str, Any], key: str, least: int) -> int:
    return whole(document.get(key), key, least, "the file does not hold what a monitor writes")


def _positive(document: Mapping[str, Any], key: str, width: int) -> Array:
    found = array(document, key, (width,))
    if not np.all(found > 0):
        raise InvalidData(f"{key}: got {shorten(document[key])}, expected positive numbers")
    return found


def _is_covariance(matrix: Array, *, definite: bool) -> bool:
    """Say whether the matrix is symmetric without negative eigenvalues, up to rounding; where it must be `definite` they are positive."""
    if not np.allclose(matrix, matrix.T, rtol=1e-9, atol=0.0):
        return False
    values = np.linalg.eigvalsh(matrix)
    rounding = len(values) * np.finfo(float).eps * np.abs(values).max(initial=0.0)
    return bool(np.all(values > rounding) if definite else np.all(values >= -1e3 * rounding))
