"""Estimates beside the Cramer-Rao bound, on a few records of one packaged experiment.

bound       the object: for each method the errors of the model over the bound, record by record
METHODS     what is compared, every method told the order
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.progress import Progress, silent
from ...exact.limits.experiments import Experiment
from ...numeric.method.model.asymptotic_likelihood import arx_reduction
from ...numeric.method.model.models import StateSpaceModel
from ...numeric.method.model.past_inputs import pi_moesp
from ...numeric.method.model.past_outputs import po_moesp
from ...numeric.study.driving_spectra import Spectra, through, total
from ...numeric.study.information_bound import COUNT, cramer_rao, relative_error
from .experiments import floats, model, packaged, record, spectrum

EXPERIMENT, SAMPLES, RECORDS, BLOCK_ROWS = "independent-fault", 1000, 20, 10
METHODS = {
    "reduction of an ARX model (identify)": lambda y, u, n: arx_reduction(y, u, order=n).model,
    "PI-MOESP, past inputs": lambda y, u, n: pi_moesp(y, u, order=n, block_rows=BLOCK_ROWS).model,
    "PO-MOESP, past outputs": lambda y, u, n: po_moesp(y, u, order=n, block_rows=BLOCK_ROWS).model,
}


def bound(records: int = RECORDS, *, samples: int = SAMPLES, on_progress: Progress = silent) -> dict[str, Any]:
    """Return the errors of the first Markov parameters over the root of the trace of their Cramer-Rao bound."""
    experiment = packaged(EXPERIMENT)
    truth = model(experiment)
    least = cramer_rao(truth, _spectra(experiment), samples)
    errors: dict[str, list[float | None]] = {name: [] for name in METHODS}
    for seed in range(records):
        on_progress("comparing estimates with the bound", seed, records)
        y, u = record(experiment, samples, 77_000 + seed)
        for name, method in METHODS.items():
            errors[name].append(_error(method, y, u, truth, least))
    return {
        "experiment": EXPERIMENT,
        "records": records,
        "samples": samples,
        "parameters": COUNT,
        "bound": float(np.linalg.norm(least.markov(COUNT))),
        "methods": [{"name": name, "errors": found} for name, found in errors.items()],
    }


def _error(method: Any, y: Array, u: Array, truth: StateSpaceModel, least: Any) -> float | None:
    try:
        return relative_error(method(y, u, truth.n), truth, least)
    except InvalidData:
        return None


def _spectra(experiment: Experiment) -> Spectra:
    residual = experiment.system.residual
    faulty = StateSpaceModel(*(floats(M) for M in (residual.A, residual.F, residual.C, residual.G)))
    parts = [through(faulty, spectrum(experiment.v_filter))]
    if experiment.w_filter is not None:
        parts.append(spectrum(experiment.w_filter))
    return Spectra(spectrum(experiment.u_filter), total(*parts))
