"""The plant that ARX reduction tends to is judged under every colour of the input that hides a state from PI-MOESP.

The ARX model of the limit is exact (`arx_limit`); the nearest plant of n states under its weight is found here by the library's own descent
at the exact spectra, whose rounding is that of floats.
"""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.exact import Experiment, arx_limit, limit, read_experiment
from faultspace.numeric.method.model.arx import adjoint, polynomial
from faultspace.numeric.method.model.invariants import transfer
from faultspace.numeric.method.model.weighted_reduction import Reduction, circle, descend
from faultspace.proofs.evidence.refuting_experiments import WITHOUT_RANK, kept

ANGLES = 1024
NOISE = "1/10"


def noisy(experiment: Experiment) -> Experiment:
    """Return the experiment with white noise on all outputs where it has none, without which no ARX model of many lags is unique."""
    given = experiment.to_json()
    p = len(given["C"])
    noise = [[[NOISE if i == j else "0" for j in range(p)] for i in range(p)]]
    return read_experiment(given | {"w_filter": given.get("w_filter") or noise})


def floats(matrices: Any) -> Array:
    return np.array([[[float(Fraction(int(x.p), int(x.q))) for x in row] for row in one.elements()] for one in matrices])


def reduced(experiment: Experiment, lags: int) -> tuple[float, float, float]:
    """Return the misfit of the limit by integration, that of the plant reduced from the true one on, and the error of its Markov
    parameters."""
    found, system = arx_limit(experiment, lags), experiment.system
    n, angles = system.residual.n, circle(ANGLES)
    A, B = polynomial(floats(found.outputs), angles), polynomial(floats(found.inputs), angles)
    S = floats([found.innovation])[0]
    shape = experiment.u_filter
    denominator = np.exp(-1j * np.outer(angles, np.arange(len(shape.denominator)))) @ np.array(
        [float(Fraction(str(d))) for d in shape.denominator]
    )
    colour = np.asarray(polynomial(floats(shape.numerator), angles) / denominator[:, None, None], dtype=np.complex128)
    plant, weight, spectrum = (
        np.asarray(np.linalg.solve(A, B), dtype=np.complex128),
        adjoint(A) @ np.linalg.inv(S) @ A,
        colour @ adjoint(colour),
    )
    weight = np.asarray(weight, dtype=np.complex128)
    problem = Reduction(angles, plant, weight, spectrum, 1.0)
    true = np.vstack(
        [np.hstack([floats([part])[0] for part in pair]) for pair in ((system.residual.A, system.B), (system.residual.C, system.D))]
    )
    matrix, _ = descend(problem, true, n, 200, 1e-12)
    after = Reduction(angles, transfer(true, n, angles), weight, spectrum, 1.0).cost(matrix, n)
    powers = [np.linalg.matrix_power(matrix[:n, :n], k) for k in range(6)]
    own = np.array([matrix[n:, :n] @ power @ matrix[:n, n:] for power in powers])
    wanted = np.array([true[n:, :n] @ np.linalg.matrix_power(true[:n, :n], k) @ true[:n, n:] for k in range(6)])
    return problem.cost(true, n), after, float(np.linalg.norm(own - wanted) / np.linalg.norm(wanted))


QUICK = ("seasonal-input-coloured-fault", "moving-average-input")
NAMES = [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in WITHOUT_RANK]


@pytest.mark.parametrize("name", NAMES)
def test_the_reduced_plant_stays_right_where_pi_moesp_loses_a_state(name: str) -> None:
    """The misfit is the integral that it is said to be, four times it bounds that of the reduced plant, and both fall with the lags."""
    experiment = noisy(kept(name))
    assert limit(experiment).past_inputs.rank < experiment.system.residual.n
    errors = []
    for lags in (2, 8):
        misfit, after, error = reduced(experiment, lags)
        exact = arx_limit(experiment, lags).misfit
        assert exact is not None and misfit == pytest.approx(float(exact), rel=1e-4)
        assert after <= 4 * float(exact) + 1e-9
        errors.append(error)
    assert errors[1] < 0.05 and errors[1] <= max(errors[0], 1e-9)


def certified(folder: Path) -> list[Experiment]:
    """Return the experiments of all certificates of limits in a folder, each once."""
    found: dict[str, Experiment] = {}
    for path in sorted(folder.iterdir()):
        if "-limit-" in path.name:
            given = json.loads(path.read_text(encoding="utf-8"))["statement"]["experiment"]
            found.setdefault(json.dumps(given, sort_keys=True), read_experiment(given))
    return list(found.values())


@pytest.mark.slow
def test_no_certified_colour_of_the_input_takes_a_state_from_the_reduced_plant(certificates_of_a_run: Path) -> None:
    """Every experiment of every certificate in which input and fault are uncorrelated, and PI-MOESP's limit has another range."""
    judged = 0
    for experiment in map(noisy, certified(certificates_of_a_run)):
        if limit(experiment).past_inputs.equals_observability_range or not arx_limit(experiment, 1).open_loop:
            continue
        errors = [reduced(experiment, lags)[2] for lags in (2, 10)]
        assert errors[1] < 0.1, (experiment.to_json(), errors)
        judged += 1
    assert judged >= 5
