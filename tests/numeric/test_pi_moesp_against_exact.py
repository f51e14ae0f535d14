"""PI-MOESP in floats against exact rational systems, records without noise or fault: every difference within the bound that
`conditioning` derives, printed as got / bound / ratio; and the same comparison with a formula broken on purpose, which must fail.

Compared is what does not depend on the basis: Markov parameters, the characteristic polynomial, poles, the transfer function. The
identified matrices are read as the rationals that they are and evaluated in 50 digits, so that the differences are theirs alone.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import scipy.linalg
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from faultspace.numeric.method.model import compression as compression_module
from faultspace.numeric.method.model import input_matrices
from faultspace.numeric.method.model import past_inputs as pi_moesp
from faultspace.numeric.method.model.compression import Blocks, Compression, compress
from faultspace.numeric.study.conditioning import ModelError, by_gram, by_qr, moesp_error, noise_free_range, output_error_error, setting
from tests.numeric import high_precision as precise
from tests.numeric.exact_cases import ExactCase, exact_case
from tests.thorough import examples

CASES = [  # n, n_u, p: corners first
    (1, 1, 1),
    (1, 2, 1),
    (1, 1, 3),
    (1, 3, 2),
    (2, 1, 1),
    (2, 2, 2),
    (3, 1, 2),
    (3, 3, 1),
    (4, 2, 3),
    (4, 1, 1),
]
ROUTES = ["qr", "gram"]
POINTS = [1.0 + 0.0j, -1.0 + 0.0j, 0.6 + 0.8j]  # on the unit circle, and floats of few digits


def window(case: ExactCase) -> int:
    """Return enough block rows for the lag of any system of this order, and one more."""
    return case.n + 2


def by_moesp(case: ExactCase, route: str) -> tuple[Any, ModelError]:
    """Return the float model with MOESP's regression for B and D, and its bounds."""
    y, u = case.data()
    compressed = compress(y, u, block_rows=window(case), route=route)
    found = pi_moesp.pi_moesp_from_compression(compressed, order=case.n)
    where = setting(compressed, found)
    backward = by_qr(where) if route == "qr" else by_gram(where)
    return found, moesp_error(where, backward, noise_free_range(where, backward))


def by_output_error(case: ExactCase, route: str) -> tuple[Any, ModelError]:
    """Return the float model with output error for B and D, and its bounds."""
    y, u = case.data()
    found = pi_moesp.pi_moesp(y, u, order=case.n, block_rows=window(case), route=route)
    assert found.x0 is not None
    where = setting(compress(y, u, block_rows=window(case), route=route), found)
    backward = by_qr(where) if route == "qr" else by_gram(where)
    return found, output_error_error(where, noise_free_range(where, backward), [(y, u)])


METHODS = [by_moesp, by_output_error]


def differences(case: ExactCase, found: Any, error: ModelError) -> dict[str, tuple[float, float]]:
    """Return quantity -> (got, bound) at the entry where their ratio is largest."""
    count = 2 * case.n + 2
    pairs: dict[str, tuple[Any, Any]] = {}
    with precise.precise():
        truth = precise.Model(*(precise.lift(M) for M in (case.A, case.B, case.C, case.D)))
        model = precise.Model(*(precise.lift(M) for M in (found.A, found.B, found.C, found.D)))
        pairs["Markov parameters"] = precise.markov(model, count) - precise.markov(truth, count), error.markov(count)
        polynomials = [precise.characteristic_polynomial(one.A) for one in (model, truth)]
        pairs["characteristic polynomial"] = polynomials[0] - polynomials[1], error.characteristic_polynomial
        for z in POINTS:
            pairs[f"transfer at {z}"] = precise.transfer(model, z) - precise.transfer(truth, z), error.transfer(z)
        exact_poles = np.array([complex(pole) for pole in precise.poles(truth.A)])
        gaps = np.array([[abs(complex(mine) - theirs) for theirs in exact_poles] for mine in np.linalg.eigvals(error.model.A)])
        absolute = {name: (np.abs(got).astype(float), np.asarray(bound)) for name, (got, bound) in pairs.items()}
    bounds = error.poles
    order = linear_sum_assignment(gaps / bounds[:, np.newaxis])
    absolute["poles"] = gaps[order], bounds[order[0]]
    worst = {}
    for name, (got, bound) in absolute.items():
        place = np.unravel_index(np.argmax(got / bound), got.shape)
        worst[name] = float(got[place]), float(bound[place])
    return worst


def print_margins(label: str, worst: dict[str, tuple[float, float]]) -> None:
    for name, (got, bound) in worst.items():
        print(f"{label} {name}: got {got:.1e}, bound {bound:.1e}, ratio {got / bound:.1e}")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("n, n_u, p", CASES)
def test_floats_agree_with_the_exact_system(n: int, n_u: int, p: int, route: str, method: Any) -> None:
    """The difference is within the bound, and the bound itself is small: it would notice the fifth digit."""
    case = exact_case(3, n, n_u, p)
    assert not case.x0.is_zero() and not case.D.is_zero() and not case.B.is_zero()
    found, error = method(case, route)
    worst = differences(case, found, error)
    print_margins(f"n={n} n_u={n_u} p={p} {route} {method.__name__}", worst)
    assert all(got <= bound for got, bound in worst.values())
    assert all(bound < 1e-5 for _, bound in worst.values())


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("smoothing", [4, 8, 12])
def test_smooth_inputs(smoothing: int, method: Any) -> None:
    """By QR the input's condition does not show in the error, by the Gram its square does; both bounds follow."""
    case = exact_case(3, 3, 1, 2, samples=80, smoothing=smoothing)
    errors = {}
    for route in ROUTES:
        found, error = method(case, route)
        worst = differences(case, found, error)
        print_margins(f"condition {found.condition_numbers['inputs']:.1e} {route} {method.__name__}", worst)
        assert all(got <= bound for got, bound in worst.values())
        errors[route] = worst["Markov parameters"]
    if smoothing == 12:
        assert errors["gram"][0] > 100 * errors["qr"][0] and errors["gram"][1] > 10 * errors["qr"][1]


@settings(max_examples=examples(40), deadline=None, derandomize=True, suppress_health_check=[HealthCheck.filter_too_much])
@given(
    seed=st.integers(0, 10**6),
    n=st.integers(1, 4),
    n_u=st.integers(1, 3),
    p=st.integers(1, 3),
    route=st.sampled_from(ROUTES),
    method=st.sampled_from(METHODS),
)
def test_random_systems(seed: int, n: int, n_u: int, p: int, route: str, method: Any) -> None:
    """Any system that its order can be seen of: first order must be small for the bound to be one."""
    case = exact_case(seed, n, n_u, p, samples=70)
    found, error = method(case, route)
    # Nearly unobservable, uncontrollable or defective ones have no first order to speak of.
    assume(np.all(np.isfinite(error.poles)) and max(error.A, error.B, float(error.poles.max())) < 1e-3)
    for name, (got, bound) in differences(case, found, error).items():
        assert got <= bound, (name, got, bound)


# What goes wrong in real implementations, each put in by a patch.


def without_projection(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take Yf along past and future inputs alike: the future ones are not projected out."""
    true_blocks = Compression.blocks

    def blocks(self: Compression) -> Blocks:
        parts = true_blocks(self)
        return parts._replace(l32=parts.l32 + parts.l31[:, : parts.l32.shape[1]])

    monkeypatch.setattr(Compression, "blocks", blocks)


def hankel_off_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take future outputs one sample after future inputs: y(k) is paired with u(k+1)."""
    true_rows = compression_module.window_rows

    def rows(n_u: int, p: int, past_rows: int, block_rows: int) -> Any:
        result = true_rows(n_u, p, past_rows, block_rows).copy()
        result[(past_rows + block_rows) * n_u :, 0] -= 1
        return result

    monkeypatch.setattr(compression_module, "window_rows", rows)


def shift_the_wrong_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """Turn the block rows upside down: A comes out inverted."""
    true_range = pi_moesp.system_range

    def upside_down(projected: Any, scale: Any, *rest: Any) -> Any:
        p = len(scale)
        return true_range(projected.reshape(-1, p, projected.shape[1])[::-1].reshape(projected.shape), scale, *rest)

    monkeypatch.setattr(pi_moesp, "system_range", upside_down)


def transposed_solve(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take L11^-T for L11^-1 in MOESP's regression."""
    true_solve = scipy.linalg.solve_triangular

    def solve(a: Any, b: Any, **options: Any) -> Any:
        return true_solve(a, b, **{name: value for name, value in options.items() if name != "trans"})

    monkeypatch.setattr(input_matrices, "solve_triangular", solve)


def interleaved_inputs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fill B by rows where it comes by columns: this is right for one input and wrong for two."""
    for name in ("by_moesp", "by_output_error"):
        true_regression = getattr(pi_moesp, name)

        def regression(*arguments: Any, _inner: Any = true_regression) -> Any:
            result = _inner(*arguments)
            return replace(result, B=np.ascontiguousarray(result.B.T).reshape(result.B.shape))

        monkeypatch.setattr(pi_moesp, name, regression)


def forgotten_initial_state(monkeypatch: pytest.MonkeyPatch) -> None:
    """Start output error from rest: the columns of x0 are zero."""
    true_step = input_matrices._Regression.__init__

    def begin(self: Any, A: Any, C: Any, n_u: int) -> None:
        true_step(self, A, C, n_u)
        self._states[0] = 0.0

    monkeypatch.setattr(input_matrices._Regression, "__init__", begin)


@pytest.mark.parametrize(
    "broken, method",
    [
        (without_projection, by_moesp),
        (without_projection, by_output_error),
        (hankel_off_by_one, by_moesp),
        (shift_the_wrong_way, by_moesp),
        (transposed_solve, by_moesp),
        (interleaved_inputs, by_moesp),
        (interleaved_inputs, by_output_error),
        (forgotten_initial_state, by_output_error),
    ],
)
def test_a_broken_formula_exceeds_the_bound(broken: Any, method: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    case = exact_case(3, 2, 2, 2)
    broken(monkeypatch)
    found, error = method(case, "qr")
    worst = differences(case, found, error)
    print_margins(f"{broken.__name__} {method.__name__}", worst)
    assert max(got / bound for got, bound in worst.values()) > 100


@pytest.mark.parametrize("name", ["A", "B", "C", "D"])
def test_a_wrong_digit_exceeds_the_bound(name: str) -> None:
    """One entry of the model is off by 1e-6 of itself."""
    case = exact_case(3, 2, 2, 2)
    found, error = by_moesp(case, "qr")
    wrong = {key: getattr(found, key).copy() for key in "ABCD"}
    wrong[name][0, 0] *= 1 + 1e-6
    off = differences(case, precise.Model(**wrong), error)
    assert any(got > bound for key, (got, bound) in off.items() if key != "poles")
