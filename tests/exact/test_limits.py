"""Population limits against the oracle, which solves dense equations and writes regressions out, and against long sums in floats."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, beside, rank, stacked
from faultspace.exact.algebra.stability import rational_characteristic_polynomial
from faultspace.exact.limits.column_space import past_input_and_output_limit, past_input_limit, state_part
from faultspace.exact.limits.experiments import Experiment
from faultspace.exact.limits.inputs import by_moesp, by_output_error
from faultspace.exact.limits.lyapunov import solve, state_covariance, stein
from faultspace.exact.limits.moesp import limit
from faultspace.exact.limits.moments import covariances, window_covariances
from faultspace.exact.limits.process import joint_process
from faultspace.exact.system.windows import observability_matrix
from tests.exact.checks import as_exact
from tests.exact.experiment_families import random_experiment
from tests.oracle import limits as slow
from tests.oracle.systems import parse_matrix

SHAPES = [
    {"n": 2, "m": 1, "p": 2, "nu": 1},
    {"n": 1, "m": 2, "p": 1, "nu": 2},
    {"n": 3, "m": 1, "p": 1, "nu": 1, "s": 3, "past": 1},
    {"n": 0, "m": 1, "p": 1, "nu": 1},
    {"n": 2, "m": 0, "p": 1, "nu": 1, "s": 3},
]


def excited(experiment: Experiment) -> bool:
    known = covariances(experiment)
    count = experiment.s + experiment.past
    whole = known.windows(known.process.u, known.process.u, range(count), range(count))
    return rank(whole) == whole.nrows


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("seed", range(3))
def test_the_covariance_is_the_one_of_the_dense_equation(seed: int, shape: dict[str, int]) -> None:
    process = joint_process(random_experiment(seed, finite=False, **shape))
    Phi, Gamma = (parse_matrix(slow.Q, part.to_json(), *part.shape) for part in (process.Phi, process.Gamma))
    assert state_covariance(process) == as_exact(slow.lyapunov(Phi, Gamma), QQ)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("seed", range(3))
def test_the_limits_are_those_of_the_oracle(seed: int, shape: dict[str, int]) -> None:
    """The oracle sums impulse responses, and solves dense equations; neither this process nor this Lyapunov solver is known to it."""
    experiment = random_experiment(seed + 100, finite=True, **shape)
    assert excited(experiment)
    found, told = limit(experiment), slow.parse_experiment(experiment.to_json())
    known, (driven, signals) = found.known, slow.process(told)
    for lag in range(-5, 6):
        for a, b in (("y", "u"), ("y", "y"), ("v", "u")):
            fast = known.sequence(getattr(known.process, a), getattr(known.process, b), lag, lag)[lag]
            assert fast == as_exact(driven.covariance(signals[a], signals[b], lag), QQ), (lag, a, b)
    for result, outputs in ((found.past_inputs, False), (found.past_outputs, True)):
        expected = slow.moesp_limit_of(told, outputs)
        assert expected is not None and result.matrix == as_exact(expected, QQ)
        assert (result.rank, result.observability_rank, result.joint_rank) == slow.moesp_ranks(told, outputs)


@pytest.mark.parametrize("seed", range(8))
def test_regressions_are_the_ones_written_out(seed: int) -> None:
    """A is nilpotent and the pair observable, so that both regressions have one solution and it is a finite sum."""
    experiment = random_experiment(seed + 200, finite=True, nu=1 + seed % 2, s=3)
    residual = experiment.system.residual
    told = slow.parse_experiment(experiment.to_json())
    known = covariances(experiment)
    blocks = window_covariances(experiment, known)
    observability = observability_matrix(residual, experiment.s)
    error, moesp = by_output_error(known, residual.A, residual.C), by_moesp(blocks, observability, residual.p)
    assert (error is not None) == (rank(observability) == residual.n)
    for fast, expected in ((error, slow.output_error(told)), (moesp, slow.moesp_regression(told))):
        assert (fast is None) == (expected is None)
        if fast is not None and expected is not None:
            assert tuple(as_exact(one, QQ) for one in expected) == (fast.B, fast.D)


def test_the_regressions_were_compared_on_observable_pairs() -> None:
    experiments = [random_experiment(seed + 200, finite=True, nu=1 + seed % 2, s=3) for seed in range(8)]
    assert sum(rank(observability_matrix(e.system.residual, 3)) == 2 for e in experiments) >= 5


@pytest.mark.parametrize("seed", range(6))
def test_rational_filters_meet_long_sums_in_floats(seed: int) -> None:
    """The companion states must reproduce impulse responses of 300 lags by long division."""
    experiment = random_experiment(seed + 300, finite=False, n=2, nu=1, s=3, past=3)
    made = _in_floats(experiment, 300)
    known = covariances(experiment)
    for a, b in (("y", "u"), ("y", "y"), ("v", "u"), ("u", "u")):
        for lag, fast in known.sequence(getattr(known.process, a), getattr(known.process, b), -4, 4).items():
            first, second = (made[a], made[b]) if lag >= 0 else (made[b], made[a])
            total = np.einsum("jab,jcb->ac", first[abs(lag) :], second[: 300 - abs(lag)])
            assert np.allclose(_floats(fast), total if lag >= 0 else total.T, atol=1e-9), (a, b, lag)


@pytest.mark.parametrize("seed", range(6))
def test_output_error_cannot_be_lowered(seed: int) -> None:
    """The stationary E|y - G(q)u|^2, as a quadratic function of B and D by long sums, has no slope at the minimiser."""
    experiment = random_experiment(seed + 400, finite=False, n=2, nu=1)
    residual = experiment.system.residual
    found = by_output_error(covariances(experiment), residual.A, residual.C)
    assert found is not None
    A, C = _floats(residual.A), _floats(residual.C)
    made = _in_floats(experiment, 400)

    def power(B: Any, D: Any) -> float:
        state, total = np.zeros((2, made["u"].shape[2])), 0.0
        for u, y in zip(made["u"], made["y"], strict=True):
            total += float(np.sum((y - C @ state - D @ u) ** 2))
            state = A @ state + B @ u
        return total

    B, D = _floats(found.B), _floats(found.D)
    least = power(B, D)
    for matrix in (B, D):
        for index in np.ndindex(matrix.shape):
            values = []
            for step in (-0.1, 0.1):
                matrix[index] += step
                values.append(power(B, D))
                matrix[index] -= step
            # Equal on both sides: the slope vanishes. Above the least: it is no maximum.
            assert values[0] == pytest.approx(values[1], rel=1e-7) and min(values) > least


def _floats(matrix: Matrix) -> Any:
    return np.array([[int(x.p) / int(x.q) for x in row] for row in matrix.elements()]).reshape(matrix.shape)


def _in_floats(experiment: Experiment, lags: int) -> dict[str, Any]:
    """The recursions that define the signals give the impulse responses over (lag, row, noise)."""
    system, residual = experiment.system, experiment.system.residual
    filters = {"u": experiment.u_filter, "v": experiment.v_filter, "w": experiment.w_filter}
    noise = experiment.u_filter.noise
    own = experiment.w_filter.noise if experiment.w_filter else 0
    made: dict[str, Any] = {"w": np.zeros((lags, residual.p, noise + own))}
    for name, one in filters.items():
        if one is None:
            continue
        result = np.zeros((lags, one.channels, noise + own))
        columns = slice(noise, None) if name == "w" else slice(0, noise)
        for k in range(lags):
            if k < len(one.numerator):
                result[k, :, columns] = _floats(one.numerator[k])
            for j, d in enumerate(one.denominator[1:], 1):
                if j <= k:
                    result[k] -= int(d.p) / int(d.q) * result[k - j]
        made[name] = result
    A, B, C, D = (_floats(M) for M in (residual.A, system.B, residual.C, system.D))
    F, G = _floats(residual.F), _floats(residual.G)
    state, outputs = np.zeros((residual.n, noise + own)), []
    for u, v, w in zip(made["u"], made["v"], made["w"], strict=True):
        outputs.append(C @ state + D @ u + G @ v + w)
        state = A @ state + B @ u + F @ v
    return made | {"y": np.array(outputs)}


def test_an_unstable_model_has_no_stationary_output_error() -> None:
    known = covariances(random_experiment(3, finite=False))
    C = Matrix.of([[1], [1]])
    assert by_output_error(known, Matrix.of([["1/2"]]), C) is not None
    for pole in (1, "-3/2", -1):
        assert by_output_error(known, Matrix.of([[pole]]), C) is None


def test_stein_with_two_different_sides() -> None:
    S, T = Matrix.of([["1/2", "1"], [0, "-1/3"]]), Matrix.of([["1/5", 0, "2"], [0, "1/7", 0], [0, 0, "-1/2"]])
    R = Matrix.of([[1, 2, 3], ["-1/2", 0, 5]])
    coefficients = [QQ.element(c) for c in rational_characteristic_polynomial(T)]
    X = stein(S, T, R, coefficients)
    assert S @ X @ T.transposed() + R == X
    # Any multiple annihilates just as well.
    assert stein(S, T, R, [QQ.element(0), *coefficients]) == X
    # What does not annihilate is not taken for it.
    assert stein(S, T, R, [*coefficients[:-1], QQ.element(2)]) != X


def test_a_wrong_covariance_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    from faultspace.exact.limits import lyapunov

    process = joint_process(random_experiment(1, finite=False))
    monkeypatch.setattr(lyapunov, "rational_characteristic_polynomial", lambda A: (*rational_characteristic_polynomial(A)[:-1], 2))
    with pytest.raises(ArithmeticError, match="Lyapunov"):
        lyapunov.state_covariance(process)


def test_state_parts() -> None:
    """The column spaces are known by construction: C, CA, ... of a known pair; one column too few; not shift-invariant; s too small."""
    A, C = Matrix.of([["1/2", 1], [0, "1/3"]]), Matrix.of([[1, 0]])
    observed = stacked(C, C @ A, C @ A @ A)
    mixed = observed @ Matrix.of([[2, 1], [1, 1]])
    found = state_part(mixed, 1)
    assert found is not None and found.characteristic_polynomial == rational_characteristic_polynomial(A)
    assert rank(beside(observed, stacked(found.C, found.C @ found.A, found.C @ found.A @ found.A))) == 2
    assert state_part(Matrix.of([[1, 0], [0, 1], [1, 5], [0, 7]]), 1) is None
    assert state_part(Matrix.of([[1], [2], [5]]), 1) is None
    assert state_part(Matrix.of([[1, 0], [0, 1]]), 1) is None
    assert state_part(Matrix.of([[0], [1]]), 1) is None


def test_the_projection_solves_its_equation() -> None:
    experiment = random_experiment(7, finite=False, nu=2)
    known = covariances(experiment)
    blocks = window_covariances(experiment, known)
    for result, right in ((past_input_limit, blocks.uf_up), (past_input_and_output_limit, beside(blocks.uf_up, blocks.uf_yp))):
        found = result(experiment, blocks)
        assert blocks.uf_uf @ found.projection == right
    assert solve(Matrix.of([], shape=(0, 0)), Matrix.zero(QQ, 0, 3)).shape == (0, 3)


def test_the_dict_says_what_the_records_say() -> None:
    experiment = random_experiment(11, finite=False, n=2, s=3, past=3)
    found, document = limit(experiment), limit(experiment).to_json()
    assert document["limit_rank"] == found.past_inputs.rank and document["past_outputs"]["limit_rank"] == found.past_outputs.rank
    assert found.true_AC is not None and document["true_AC"]["B"] == found.true_AC.B.to_json()
    bias = Matrix.of(document["true_AC"]["bias"]["B"])
    assert bias + experiment.system.B == found.true_AC.B
