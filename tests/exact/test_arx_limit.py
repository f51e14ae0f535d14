"""The exact limit of an ARX model is judged: it stays right under every kept colour of the input that takes the rank from PI-MOESP."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidInput
from faultspace.exact import ARXLimit, Experiment, arx_limit, limit, read_experiment
from faultspace.exact.limits import autoregression
from faultspace.exact.limits.lyapunov import solve
from faultspace.exact.limits.moesp import markov_parameters
from faultspace.exact.limits.moments import covariances
from faultspace.proofs.evidence.refuting_experiments import kept

HIDDEN = [
    "integer-taps",
    "moving-average-input",
    "moving-average-input-coloured-fault",
    "rational-input",
    "rational-input-one-output",
    "seasonal-input",
    "seasonal-input-coloured-fault",
]
FOLLOWING = ["following-fault", "following-fault-regression", "following-fault-two-states"]


def true_markov(experiment: Experiment, count: int) -> list[Any]:
    system = experiment.system
    return markov_parameters(system.residual.A, system.B, system.residual.C, system.D, count)


def floats(matrices: list[Any]) -> Array:
    return np.array([[[float(Fraction(int(x.p), int(x.q))) for x in row] for row in one.elements()] for one in matrices])


@cache
def noisy(name: str) -> Experiment:
    """Return the kept experiment with white noise on all outputs, a tenth of the driving noise in size."""
    given = kept(name).to_json()
    p = len(given["C"])
    return read_experiment(given | {"w_filter": [[["1/10" if i == j else "0" for j in range(p)] for i in range(p)]]})


def error(experiment: Experiment, lags: int) -> float:
    """Relative, of the first Markov parameters of the limit's plant."""
    found, true = (floats(one) for one in (arx_limit(experiment, lags).markov(8), true_markov(experiment, 8)))
    return float(np.linalg.norm(found - true) / np.linalg.norm(true))


def deadbeat(name: str) -> Experiment:
    """Return the experiment with faults that act as innovations of a deadbeat observer, K with (A - K C)^n = 0, and are white."""
    given = kept(name).to_json()
    A, C = (np.array([[Fraction(x) for x in row] for row in given[key]]) for key in "AC")
    n, p = len(A), len(C)
    observed = np.concatenate([C @ np.linalg.matrix_power(A, k) if k else C for k in range(n)])
    if p == 1:  # Ackermann's formula: K = A^n O^-1 (0, .., 0, 1)'
        (a, b), (c, d) = observed
        K = A @ A @ np.array([[-b], [a]]) / (a * d - b * c)
    else:
        (a, b), (c, d) = C
        K = A @ np.array([[d, -b], [-c, a]]) / (a * d - b * c)
    assert not np.any((A - K @ C) @ (A - K @ C))
    nu = len(given["u_filter"]["num"][0]) if isinstance(given["u_filter"], dict) else len(given["u_filter"][0])
    filters = given["u_filter"] if isinstance(given["u_filter"], dict) else {"num": given["u_filter"], "den": ["1"]}
    num = [[[*row, *["0"] * p] for row in one] for one in filters["num"]]
    width = len(num[0][0])
    v = [[["1" if j == width - p + i else "0" for j in range(width)] for i in range(p)]]
    rows = [[str(x) for x in row] for row in K]
    eye = [["1" if i == j else "0" for j in range(p)] for i in range(p)]
    rest = {key: value for key, value in given.items() if key not in ("w_filter", "m", "n", "p", "nu", "field")}
    assert nu == 1
    return read_experiment(rest | {"F": rows, "G": eye, "u_filter": {"num": num, "den": filters["den"]}, "v_filter": v})


@pytest.mark.parametrize("name", HIDDEN)
def test_the_plant_is_exact_where_pi_moesp_loses_a_state(name: str) -> None:
    """The theorem of the module: the colour of u does not matter, and the realisation sees all states."""
    experiment = deadbeat(name)
    n = experiment.system.residual.n
    assert limit(experiment).past_inputs.rank < n
    for lags in (n, n + 1):
        found = arx_limit(experiment, lags)
        assert found.open_loop and found.markov(8) == true_markov(experiment, 8)
        assert found.innovation == type(found.innovation).identity(found.innovation.field, found.innovation.nrows)


@pytest.mark.parametrize("name", HIDDEN)
def test_with_the_faults_as_they_are_the_plant_tends_to_the_true_one(name: str) -> None:
    experiment = noisy(name)
    assert limit(experiment).past_inputs.rank == 1 and arx_limit(experiment, 2).open_loop
    errors = [error(experiment, lags) for lags in (2, 24)]
    assert errors[1] < 1e-3 and errors[1] < 0.05 * errors[0]
    parts = floats(arx_limit(experiment, 24).markov(4))
    true = floats(true_markov(experiment, 4))
    values, wanted = (np.linalg.svd(np.block([[one[1], one[2]], [one[2], one[3]]]), compute_uv=False) for one in (parts, true))
    assert abs(values[1] - wanted[1]) < 0.2 * wanted[1]


@pytest.mark.parametrize("name", FOLLOWING)
def test_where_the_fault_leads_the_input_no_number_of_lags_helps_and_it_is_told(name: str) -> None:
    assert not arx_limit(noisy(name), 4).open_loop
    assert min(error(noisy(name), lags) for lags in (2, 4, 8, 12)) > 0.3


def test_the_error_is_uncorrelated_with_every_regressor() -> None:
    """The normal equations again, lag by lag, from covariance sequences and not from windows."""
    experiment = noisy("seasonal-input-coloured-fault")
    found, known = arx_limit(experiment, 3), covariances(experiment)
    y, u = known.process.y, known.process.u
    for signal in (y, u):
        own, driven = (known.sequence(one, signal, -3, 3) for one in (y, u))
        for lag in range(0 if signal is u else 1, 4):
            pairs = zip(found.outputs, found.inputs, strict=True)
            total = [a @ own[lag - i] - b @ driven[lag - i] for i, (a, b) in enumerate(pairs)]
            assert sum(total[1:], total[0]).is_zero()
    own, driven = (known.sequence(one, y, -3, 0) for one in (y, u))
    at_once = [a @ own[-i] - b @ driven[-i] for i, (a, b) in enumerate(zip(found.outputs, found.inputs, strict=True))]
    assert sum(at_once[1:], at_once[0]) == found.innovation


def two_inputs(delay: int) -> Experiment:
    """u = (e, e delayed): its windows have full rank as long as they are no longer than the delay."""
    e = [[["1", "0"], ["0", "0"]], *[[["0", "0"], ["0", "0"]]] * (delay - 1), [["0", "0"], ["1", "0"]]]
    system = {"A": [["1/2"]], "B": [["1", "2"]], "C": [["1"]], "D": [["0", "1"]], "F": [["1/2"]], "G": [["1"]]}
    return read_experiment(system | {"s": 1, "past": 1, "u_filter": e, "v_filter": [[["0", "1"]]]})


def test_persistency_of_excitation_of_order_lags_plus_one_is_what_it_takes() -> None:
    experiment = two_inputs(3)
    for lags in (1, 2):
        assert arx_limit(experiment, lags).markov(6) == true_markov(experiment, 6)
    with pytest.raises(InvalidInput, match="rank 7 of 8: try an input"):
        arx_limit(experiment, 3)
    with pytest.raises(InvalidInput, match="leave a combination of outputs exact"):
        arx_limit(kept("seasonal-input"), 4)
    wrong: tuple[Any, ...] = (-1, 1.5, True, 5000)
    for one in wrong:
        with pytest.raises(InvalidInput, match="lags: got"):
            arx_limit(experiment, one)


def test_a_limit_broken_on_purpose_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(autoregression, "solve", lambda gram, crossed: -solve(gram, crossed))
    found: ARXLimit = arx_limit(deadbeat("seasonal-input"), 2)
    assert found.markov(8) != true_markov(deadbeat("seasonal-input"), 8)


@pytest.mark.parametrize("name", HIDDEN)
def test_the_misfit_falls_with_the_lags_and_is_zero_where_the_plant_is_exact(name: str) -> None:
    assert arx_limit(deadbeat(name), 2).misfit == 0
    misfits = [arx_limit(noisy(name), lags).misfit for lags in (2, 10)]
    assert misfits[0] is not None and misfits[1] is not None and 0 < misfits[1] < misfits[0] / 10


def test_limit_tells_of_the_arx_model_beside_pi_moesp() -> None:
    noise_free, sound = limit(kept("seasonal-input")), limit(noisy("seasonal-input"))
    assert noise_free.arx is not None and noise_free.arx.lags == 1 and "the true one" in dict(noise_free.sheet())["its plant"]
    assert sound.past_inputs.rank == 1 and sound.arx is not None and sound.arx.lags == 2
    assert sound.to_json()["arx"]["misfit"] == str(sound.arx.misfit) and len(sound.to_json()["arx"]["bias"]) == 5
    told = dict(limit(noisy("following-fault")).sheet())
    assert "not the true one" in told["its plant"] and not limit(noisy("following-fault")).to_json()["arx"]["open_loop"]


def told_of(system: dict[str, Any], u: list[Any], v: list[Any], w: list[Any], s: int) -> tuple[ARXLimit, str]:
    found = limit({**system, "s": s, "past": s, "u_filter": u, "v_filter": v, "w_filter": w})
    assert found.arx is not None
    lines = [f"{name} {value}" for name, value in found.sheet()]
    return found.arx, " ".join(lines[lines.index("an ARX model, which identify reduces to the order ") :])


def test_what_is_said_of_the_plant_is_true_of_all_its_markov_parameters_and_of_faults_that_are_seen() -> None:
    one = {"A": [["1/2"]], "B": [["1"]], "C": [["1"]], "D": [["0"]], "F": [["1"]], "G": [["0"]]}
    white, noise = ([[["1", "0"]]], [[["0", "1"]]]), [[["1"]]]
    for s in (2, 3, 4):  # under a white input the first s + 1 Markov parameters are right, and later ones are not
        arx, words = told_of(one, *white, noise, s)
        assert arx.misfit != 0 and "not the true one" in words and "both tend to 0" in words
    assert "its plant the true one" in told_of(one | {"F": [["1/2"]], "G": [["1"]]}, *white, [[["0"]]], 3)[1]
    two = {"A": [["1/2", "0"], ["0", "1/3"]], "B": [["1"], ["0"]], "C": [["1", "0"]], "D": [["0"]], "G": [["0"]]}
    leading = [[["0"]], [["1"]]], [[["1"]], [["0"]]]  # v(k) = u(k+1)
    arx, words = told_of(two | {"F": [["0"], ["1"]]}, *leading, noise, 3)  # the fault moves a state that no output shows
    assert arx.open_loop and arx.misfit and "both tend to 0" in words
    arx, words = told_of(two | {"F": [["1"], ["0"]]}, *leading, noise, 3)
    assert not arx.open_loop and "more lags need not help" in words
    ahead = {**one, "F": [["0"]], "G": [["1"]], "s": 2, "past": 2, "u_filter": leading[0], "v_filter": leading[1], "w_filter": noise}
    errors = [error(read_experiment(ahead), lags) for lags in (2, 16)]  # y(k) has u(k+1) in it, and more lags do help
    assert not arx_limit(read_experiment(ahead), 2).open_loop and errors[1] < 1e-4 < 1e-1 < errors[0]
    words = told_of(one | {"C": [["1"], ["1"]], "D": [["0"], ["0"]], "G": [["0"], ["0"]]}, *white, [[["1"], ["1"]]], 2)[1]
    assert "mixture of outputs has no noise" in words  # y1 = y2, and each has noise
