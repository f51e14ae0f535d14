"""PI-MOESP is exact without noise, consistent under coloured additive faults, honest about order, stability and bad data."""

import re
import tracemalloc
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model.compression import compress, merge
from faultspace.numeric.method.model.input_matrices import by_moesp, by_output_error
from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix
from faultspace.numeric.method.model.past_inputs import choose_order, pi_moesp, pi_moesp_experiments, pi_moesp_from_compression
from faultspace.numeric.method.model.past_outputs import po_moesp

Array = NDArray[np.float64]


def system(n: int, n_u: int, p: int, *, seed: int = 0, direct: bool = True, radius: float = 0.85) -> StateSpaceModel:
    """Return a system with a largest eigenvalue of the given modulus."""
    rng = np.random.default_rng(seed)
    A = rng.standard_normal((n, n))
    A *= radius / np.abs(np.linalg.eigvals(A)).max()
    return StateSpaceModel(A, rng.standard_normal((n, n_u)), rng.standard_normal((p, n)), direct * rng.standard_normal((p, n_u)))


def behaviour_error(one: StateSpaceModel, other: StateSpaceModel, count: int = 40) -> float:
    """Return the largest difference of Markov parameters against the largest of `other`."""
    wanted = other.markov(count)
    return float(np.abs(one.markov(count) - wanted).max() / np.abs(wanted).max())


def coloured(samples: int, channels: int, seed: int) -> Array:
    """Return a moving average: a fault that past outputs take for dynamics."""
    white = np.random.default_rng(seed).standard_normal((samples + 4, channels))
    return white[4:] + 0.9 * white[3:-1] + 0.7 * white[2:-2] + 0.5 * white[1:-3] + 0.3 * white[:-4]


@pytest.mark.parametrize("n_u", [1, 2, 3])
@pytest.mark.parametrize("p", [1, 2, 3])
@pytest.mark.parametrize("direct", [False, True])
@pytest.mark.parametrize("route", ["qr", "gram", None])
def test_noise_free_data_give_the_system_back(n_u: int, p: int, direct: bool, route: str | None) -> None:
    for n in (1, 2, 4):
        truth, rng = system(n, n_u, p, direct=direct, seed=n), np.random.default_rng(9)
        u, x0 = rng.standard_normal((400, n_u)), 5 * rng.standard_normal(n)
        y = truth.simulate(u, x0)
        found = pi_moesp(y, u, block_rows=8, route=route)
        assert (found.order, found.gap.order, found.gap.clean) == (n, n, True)
        assert behaviour_error(found.model, truth) < 1e-9
        assert found.x0 is not None
        assert np.allclose(found.model.simulate(u, found.x0), y, rtol=0, atol=1e-9 * np.abs(y).max())
        assert found.residual_covariance is not None
        assert np.abs(found.residual_covariance).max() < 1e-18 * np.abs(y).max() ** 2
        assert found.warnings == ()
        plain = pi_moesp_from_compression(compress(y, u, block_rows=8, route=route))
        assert behaviour_error(plain.model, truth) < 1e-9
        assert (plain.x0, plain.residual_covariance) == (None, None)


def test_unequal_windows_are_as_exact() -> None:
    truth, rng = system(3, 2, 2), np.random.default_rng(1)
    u = rng.standard_normal((300, 2))
    y = truth.simulate(u)
    for block_rows, past_rows in ((3, 9), (9, 2), (5, 5)):
        assert behaviour_error(pi_moesp(y, u, order=3, block_rows=block_rows, past_rows=past_rows).model, truth) < 1e-9


def test_smooth_inputs_are_as_exact_by_the_route_chosen() -> None:
    """A Gram would lose the digits here: the condition of the input is reported, and QR taken."""
    truth = system(3, 1, 2)
    white = np.random.default_rng(2).standard_normal(3000)
    u = np.convolve(white, np.exp(-(np.arange(-12, 13) ** 2) / 12.0), mode="same")[:, np.newaxis]
    y = truth.simulate(u)
    found = pi_moesp(y, u, block_rows=8)
    assert found.route == "qr"
    assert found.condition_numbers["inputs"] > 1e3
    assert behaviour_error(found.model, truth) < 1e-9


def test_by_moesp_and_by_output_error_recover_b_and_d_from_true_a_and_c() -> None:
    truth, rng = system(4, 2, 3), np.random.default_rng(4)
    u, x0 = rng.standard_normal((500, 2)), rng.standard_normal(4)
    y = truth.simulate(u, x0)
    regression = by_moesp(compress(y, u, block_rows=6), truth.A, truth.C)
    assert np.allclose(regression.B, truth.B, atol=1e-10)
    assert np.allclose(regression.D, truth.D, atol=1e-10)
    for lengths in ([500], [1, 2, 300], [63, 64, 65]):
        edges = np.cumsum([0, *lengths])
        parts = [(y[a:b], u[a:b]) for a, b in zip(edges, [*edges[1:], 500], strict=True)]
        fitted = by_output_error([parts], truth.A, truth.C, 2)
        assert np.allclose(fitted.B, truth.B, atol=1e-10)
        assert np.allclose(fitted.D, truth.D, atol=1e-10)
        assert np.allclose(fitted.initial_states[0], x0, atol=1e-9)


def test_output_error_is_the_least_squares_solution_written_out() -> None:
    truth, rng = system(2, 2, 2), np.random.default_rng(5)
    u = rng.standard_normal((150, 2))
    y = truth.simulate(u) + rng.standard_normal((150, 2))
    columns = [StateSpaceModel(truth.A, np.zeros((2, 2)), truth.C, np.zeros((2, 2))).simulate(u, x).ravel() for x in np.eye(2)]
    units = np.eye(8).reshape(8, 4, 2)
    columns += [StateSpaceModel(truth.A, unit[:2], truth.C, unit[2:]).simulate(u).ravel() for unit in units]
    solution = np.linalg.lstsq(np.stack(columns, axis=1), y.ravel(), rcond=None)[0]
    fitted = by_output_error([[(y, u)]], truth.A, truth.C, 2)
    assert np.allclose(fitted.initial_states[0], solution[:2])
    assert np.allclose(np.concatenate([fitted.B, fitted.D]), np.tensordot(solution[2:], units, axes=1))


def slope(method: Any, lengths: list[int], experiments: int = 8) -> tuple[float, float]:
    """Return the slope of ln error against ln N, and the error at the largest N (root mean square over experiments)."""
    truth = system(3, 2, 2)
    errors = []
    for samples in lengths:
        squares = []
        for seed in range(experiments):
            u = np.random.default_rng(100 + seed).standard_normal((samples, 2))
            y = truth.simulate(u) + coloured(samples, 2, seed)
            squares.append(behaviour_error(method(y, u, order=3, block_rows=8).model, truth) ** 2)
        errors.append(float(np.sqrt(np.mean(squares))))
    return float(np.polyfit(np.log(lengths), np.log(errors), 1)[0]), errors[-1]


def test_estimates_converge_like_one_over_the_root_of_n_under_a_coloured_fault() -> None:
    rate, last = slope(pi_moesp, [1000, 4000, 16_000, 64_000])
    # Few experiments scatter, and at N = 1000 terms of second order still steepen the slope.
    assert abs(rate + 0.5) < 0.2, rate
    assert last < 0.02


def test_past_outputs_stay_biased_where_past_inputs_do_not() -> None:
    past_inputs, past_outputs = (slope(method, [4000, 64_000], experiments=3)[1] for method in (pi_moesp, po_moesp))
    assert past_outputs > 5 * past_inputs, (past_inputs, past_outputs)


def test_the_residual_covariance_is_that_of_the_fault() -> None:
    truth = system(3, 2, 2)
    u, v = np.random.default_rng(6).standard_normal((60_000, 2)), coloured(60_000, 2, 7)
    found = pi_moesp(truth.simulate(u) + v, u, order=3, block_rows=8)
    assert found.residual_covariance is not None
    assert np.allclose(found.residual_covariance, v.T @ v / len(v), atol=0.02 * np.trace(v.T @ v / len(v)))


def noisy(samples: int = 3000) -> tuple[Array, Array]:
    truth = system(3, 2, 3)
    u = np.random.default_rng(8).standard_normal((samples, 2))
    return truth.simulate(u) + 0.1 * coloured(samples, 3, 9), u


def test_permuted_channels_permute_the_model() -> None:
    y, u = noisy()
    found = pi_moesp(y, u, order=3, block_rows=6)
    turned = pi_moesp(y[:, [2, 0, 1]], u[:, [1, 0]], order=3, block_rows=6)
    assert np.allclose(turned.model.markov(20), found.model.markov(20)[:, [2, 0, 1]][:, :, [1, 0]], atol=1e-10)
    assert np.allclose(turned.singular_values, found.singular_values, rtol=1e-9)


@pytest.mark.parametrize("method", [pi_moesp, pi_moesp_from_compression])
def test_scaled_units_scale_the_model(method: Any) -> None:
    y, u = noisy()
    out, into = np.array([1e6, 1.0, 1e-12]), np.array([1e-3, 1e9])
    if method is pi_moesp:
        found, scaled = pi_moesp(y, u, order=3, block_rows=6), pi_moesp(y * out, u * into, order=3, block_rows=6)
        assert np.allclose(scaled.model.markov(20) / out[:, np.newaxis] * into, found.model.markov(20), atol=1e-9)
    else:
        found, scaled = (method(compress(y * a, u * into, block_rows=6), order=3) for a in (1.0, 1e6))
        assert np.allclose(scaled.model.markov(20) / 1e6, found.model.markov(20), rtol=1e-7, atol=1e-12)
    assert np.allclose(scaled.singular_values, found.singular_values, rtol=1e-9)
    assert np.allclose(scaled.model.poles, found.model.poles, atol=1e-9)


def test_a_shift_in_time_changes_noise_free_results_only_in_x0() -> None:
    truth, rng = system(3, 2, 2), np.random.default_rng(10)
    u = rng.standard_normal((500, 2))
    y = truth.simulate(u, rng.standard_normal(3))
    for first in (1, 100):
        assert behaviour_error(pi_moesp(y[first:], u[first:], block_rows=6).model, truth) < 1e-9


def test_similar_systems_give_the_same_answer() -> None:
    truth, rng = system(3, 1, 2), np.random.default_rng(11)
    T = rng.standard_normal((3, 3))
    similar = StateSpaceModel(np.linalg.solve(T, truth.A @ T), np.linalg.solve(T, truth.B), truth.C @ T, truth.D)
    u = rng.standard_normal((400, 1))
    one, other = (pi_moesp(one.simulate(u), u, block_rows=6) for one in (truth, similar))
    for name in "ABCD":
        assert np.allclose(getattr(one, name), getattr(other, name), atol=1e-8), "the basis is fixed by the data"
    # Signs too: the largest entry of each column of O_s is positive, whatever the factorisation returned.
    for y, inputs in ((truth.simulate(u), u), noisy(400), (truth.simulate(-u), -u), (-truth.simulate(u), u)):
        found = pi_moesp(y, inputs, order=3, block_rows=6)
        columns = observability_matrix(found.A, found.C / np.sqrt(np.mean(y**2, axis=0))[:, np.newaxis], 6)
        assert np.all(columns[np.argmax(np.abs(columns), axis=0), np.arange(3)] > 0)


def test_both_routes_and_merged_parts_agree_on_noisy_data() -> None:
    y, u = noisy()
    whole = pi_moesp(y, u, order=3, block_rows=6, route="qr").model
    assert behaviour_error(pi_moesp(y, u, order=3, block_rows=6, route="gram").model, whole) < 1e-10
    lags = 12
    halves = merge(compress(y[: 1500 + lags - 1], u[: 1500 + lags - 1], block_rows=6), compress(y[1500:], u[1500:], block_rows=6))
    assert (
        behaviour_error(
            pi_moesp_from_compression(halves, order=3).model, pi_moesp_from_compression(compress(y, u, block_rows=6), order=3).model
        )
        < 1e-10
    )


def test_several_experiments_give_one_model_and_their_own_initial_states() -> None:
    truth, rng = system(3, 1, 2), np.random.default_rng(12)
    experiments = []
    starts = [rng.standard_normal(3) for _ in range(3)]
    for x0, samples in zip(starts, (60, 150, 77), strict=True):
        u = rng.standard_normal((samples, 1))
        experiments.append((truth.simulate(u, x0), u))
    found = pi_moesp_experiments(experiments, block_rows=5)
    assert found.order == 3
    assert behaviour_error(found.model, truth) < 1e-9
    for (y, u), x0 in zip(experiments, found.initial_states, strict=True):
        assert np.allclose(found.model.simulate(u, x0), y, atol=1e-8)
    with pytest.raises(InvalidData, match="no experiment"):
        pi_moesp_experiments([], block_rows=5)


def test_memory_does_not_grow_with_the_record() -> None:
    peaks = []
    for samples in (100_000, 300_000):
        y, u = noisy(samples)
        tracemalloc.start()
        pi_moesp(y, u, order=3, block_rows=10)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.1 * peaks[0] + 1e5
    assert peaks[1] < 64e6


def test_inputs_stay_as_they_were() -> None:
    y, u = noisy(500)
    before = y.copy(), u.copy()
    pi_moesp(y, u, order=3, block_rows=6)
    po_moesp(y, u, order=3, block_rows=6)
    assert np.array_equal(y, before[0])
    assert np.array_equal(u, before[1])


def test_types_strides_and_single_channels_are_read() -> None:
    truth, rng = system(2, 1, 1), np.random.default_rng(13)
    u = rng.integers(-9, 9, 400)
    y = truth.simulate(u)
    wanted = pi_moesp(y, u.astype(float)[:, np.newaxis], block_rows=6).model
    for outputs, inputs in ((y[:, 0], u), (np.repeat(y, 3, axis=0)[::3], u), (np.asfortranarray(y), u.tolist())):
        assert behaviour_error(pi_moesp(outputs, inputs, block_rows=6).model, wanted) < 1e-12
    single = pi_moesp(y.astype(np.float32), u.astype(np.int16), order=2, block_rows=6).model
    assert behaviour_error(single, wanted) < 1e-5


@pytest.mark.parametrize("radius", [1.0, 1.02])
def test_an_unstable_system_is_found_reported_and_left_as_it_is(radius: float) -> None:
    truth = StateSpaceModel(np.diag([radius, 0.5]), np.ones((2, 1)), [[1.0, 2.0]], [[0.5]])
    u = np.random.default_rng(14).standard_normal((300, 1))
    found = pi_moesp(truth.simulate(u), u, order=2, block_rows=6, route="qr")
    assert np.allclose(found.model.poles, [radius, 0.5], atol=1e-7)
    if radius > 1:
        assert not found.model.is_stable
        assert any("not stable" in warning for warning in found.warnings)
    assert behaviour_error(found.model, truth, 20) < 1e-6


def test_a_fast_unstable_system_gets_moesps_regression_with_a_warning() -> None:
    truth = StateSpaceModel(np.diag([1.3, 0.5]), np.ones((2, 1)), [[1.0, 2.0]], [[0.5]])
    u = np.random.default_rng(15).standard_normal((70, 1))
    found = pi_moesp(truth.simulate(u), u, order=2, block_rows=5, route="qr")
    assert found.x0 is None
    assert any("MOESP's regression" in warning for warning in found.warnings)
    assert np.isclose(found.model.poles[0], 1.3, atol=1e-6)


def test_the_order_rule_on_named_values() -> None:
    clean = choose_order(np.array([5.0, 4.0, 3.0, 0.1, 0.09, 0.08, 0.07]), 1e-12, 6)
    assert (clean.order, clean.clean, clean.runner_up) == (3, True, 2)
    assert clean.ratio == pytest.approx(30)
    slow = choose_order(np.array([0.7**k for k in range(9)]), 1e-12, 8)
    assert not slow.clean
    ambiguous = choose_order(np.array([100.0, 10.0, 0.8, 0.7, 0.6, 0.5]), 1e-12, 5)
    assert (ambiguous.order, ambiguous.clean) == (2, False), "12.5 against 10 decides nothing"
    assert choose_order(np.array([1.0, 0.9, 0.8, 0.7, 1e-9]), 1e-12, 4).order != 4, "the last of a random matrix may be small by itself"
    assert choose_order(np.array([1.0, 0.9, 0.8, 0.7, 1e-15]), 1e-12, 4).order == 4
    assert choose_order(np.array([1e-15, 1e-16]), 1e-12, 1).order == 0
    assert choose_order(np.array([1.0, 0.9, 0.8, 1e-15]), 1e-12, 2).order <= 2


def test_the_order_is_found_in_noise_and_the_gap_reported() -> None:
    y, u = noisy(20_000)
    found = pi_moesp(y, u, block_rows=8)
    values = found.singular_values
    assert found.order == 3
    assert found.gap.ratio == pytest.approx(values[2] / values[3])
    assert found.gap.runner_up_ratio < found.gap.ratio
    assert len(values) == 16


def test_no_clean_gap_is_said_instead_of_a_number() -> None:
    rng = np.random.default_rng(16)
    y, u = rng.standard_normal((500, 2)), rng.standard_normal((500, 2))
    with pytest.raises(InvalidData, match=r"no clean gap in the singular values .*Pass order="):
        pi_moesp(y, u, block_rows=8)
    forced = pi_moesp(y, u, order=2, block_rows=8)
    assert (forced.order, forced.gap.clean) == (2, False)


def test_a_static_system_has_no_dynamics_to_see() -> None:
    u = np.random.default_rng(17).standard_normal((300, 2))
    with pytest.raises(InvalidData, match="no dynamics are seen"):
        pi_moesp(u @ np.ones((2, 2)), u, block_rows=5)


def test_an_order_above_what_the_data_hold_is_warned_of() -> None:
    truth = system(2, 1, 2)
    u = np.random.default_rng(18).standard_normal((300, 1))
    found = pi_moesp(truth.simulate(u), u, order=4, block_rows=6)
    assert any("above the rank seen" in warning for warning in found.warnings)


@pytest.mark.parametrize("method", [pi_moesp, po_moesp])
def test_bad_data_are_refused_with_a_way_out(method: Any) -> None:
    truth, rng = system(3, 2, 2), np.random.default_rng(19)
    u = rng.standard_normal((300, 2))
    y = truth.simulate(u) + 0.01 * rng.standard_normal((300, 2))
    broken, constant = y.copy(), u.copy()
    broken[33, 1] = np.nan
    constant[:, 1] = 3.0
    sines = np.sin(np.outer(np.arange(300), [0.3, 0.7]))
    bad: list[tuple[Any, Any, dict[str, Any], str]] = [
        (broken, u, {}, "NaN at sample 33, channel 1"),
        (y, np.where(u > 2, np.inf, u), {}, "u is infinite at sample"),
        (y[:40], u[:40], {}, r"40 samples are too few: .*at least 47 samples"),
        (y[:7], u[:7], {}, "7 samples are too few"),
        (y, u[:299], {}, "y has 300 samples"),
        (y.T, u.T, {}, "transposed"),
        (y, sines, {}, r"u does not excite enough: .* span [34] of 12"),
        (y, np.zeros_like(u), {}, "excite|constant"),
        (y, u, {"order": 11}, r"order = 11 is above p \(block_rows - 1\) = 2 \* 5 = 10"),
        (y, u, {"order": 0}, "order must be a positive integer"),
        (y, u, {"order": 2.0}, "order must be a positive integer"),
        (y, u, {"block_rows": 0}, "block_rows must be a positive integer"),
        (y, u, {"block_rows": 1, "order": 1}, r"block_rows >= 2"),
        (y, u, {"past_rows": -2}, "past_rows must be a positive integer"),
    ]
    for outputs, inputs, options, words in bad:
        with pytest.raises(InvalidData, match=words):
            method(outputs, inputs, **({"order": 3, "block_rows": 6} | options))
    if method is pi_moesp:
        with pytest.raises(InvalidData, match=r"input 1 \(counted from 0\) is constant"):
            method(y, constant, order=3, block_rows=6)
        with pytest.raises(InvalidData, match="2 directions of past inputs"):
            method(y, u, order=3, block_rows=6, past_rows=1)
        with pytest.raises(InvalidData, match="route must be"):
            method(y, u, order=3, block_rows=6, route="fast")


def test_inputs_that_excite_few_past_directions_serve_as_far_as_they_go() -> None:
    """Five sines excite ten directions: enough for six future rows and four instruments, not for an order of five."""
    truth = system(3, 1, 2)
    u = np.sin(np.outer(np.arange(400), [0.3, 0.7, 1.1, 1.9, 2.6]) + np.arange(5)).sum(axis=1)
    y = truth.simulate(u, np.zeros(3))[100:]
    found = pi_moesp(y, u[100:], order=3, block_rows=6)
    assert found.route == "qr"
    assert behaviour_error(found.model, truth) < 1e-6
    with pytest.raises(InvalidData, match="above the 4 directions of past inputs"):
        pi_moesp(y, u[100:], order=5, block_rows=6)
    with pytest.raises(InvalidData, match=r"does not excite enough: .* span 10 of 12"):
        pi_moesp(y, u[100:], order=3, block_rows=12)


def test_silent_outputs_and_enormous_signals_are_reported() -> None:
    u = np.random.default_rng(21).standard_normal((300, 1))
    with pytest.raises(InvalidData, match="no dynamics are seen"):
        pi_moesp(np.zeros((300, 2)), u, block_rows=5)
    silent = pi_moesp(np.zeros((300, 2)), u, order=1, block_rows=5)
    assert any("above the rank seen" in warning for warning in silent.warnings)
    assert np.array_equal(silent.model.markov(5), np.zeros((5, 2, 1)))
    with pytest.raises(InvalidData, match="squares overflow"):
        pi_moesp(1e200 * u, u, order=1, block_rows=5)
    with pytest.raises(InvalidData, match="masked"):
        pi_moesp(np.ma.masked_greater(u, 2), u, order=1, block_rows=5)


def test_block_rows_at_the_lag_are_reported() -> None:
    """Two outputs have lag 3: O_2 has rank below 3, so the shift from O_3 cannot be solved for A."""
    truth = StateSpaceModel(np.diag([0.9, 0.5, -0.4]), np.ones((3, 1)), [[1, 1, 1], [2, 2, 2]], np.zeros((2, 1)))
    u = np.random.default_rng(20).standard_normal((300, 1))
    y = truth.simulate(u)
    assert np.linalg.matrix_rank(observability_matrix(truth.A, truth.C, 2)) == 2
    found = pi_moesp(y, u, order=3, block_rows=3, past_rows=6)
    assert any("at or below the system's lag" in warning for warning in found.warnings)
    assert pi_moesp(y, u, order=3, block_rows=4, past_rows=6).warnings == ()


def test_a_clean_gap_that_leaves_A_undetermined_names_no_order() -> None:
    """One fault in three outputs and no noise: L32 loses rank far beyond the order, where a huge gap is no order."""
    truth, rng = system(3, 2, 3, seed=1), np.random.default_rng(1)
    u, v = rng.standard_normal((3000, 2)), rng.standard_normal((3000, 1))
    driven = StateSpaceModel(truth.A, np.hstack([truth.B, rng.standard_normal((3, 1))]), truth.C, np.hstack([truth.D, np.zeros((3, 1))]))
    y = driven.simulate(np.hstack([u, v]))
    s, beyond = 20, re.compile(r"after (\d+), ratio (\S+), leaves A undetermined")
    with pytest.raises(InvalidData, match=beyond) as refused:
        pi_moesp(y, u, block_rows=s)
    with pytest.raises(InvalidData, match=beyond):
        pi_moesp_from_compression(compress(y, u, block_rows=s))
    ((place, ratio),) = beyond.findall(str(refused.value))
    # r adds n + s n_v directions less the zeros, of which there is at least one for lack of feedthrough.
    assert s <= int(place) < s + 3 and float(ratio) > 1e6
    given = pi_moesp(y, u, order=3, block_rows=s)
    assert given.warnings == () and behaviour_error(given.model, truth) < 0.1
    forced = pi_moesp(y, u, order=int(place), block_rows=s)
    assert any("not determined" in warning for warning in forced.warnings), "an order that was given is taken, and told of"


def test_conversions_are_forwarded() -> None:
    y, u = noisy(500)
    found = pi_moesp(y, u, order=3, block_rows=6)
    assert np.array_equal(found.to_scipy().A, found.A)
    assert np.array_equal(found.model.B, found.B)
