"""The formulas of numeric/ in 50 digits: exact data give exact answers to 1e-40, and what floats make of noisy, faulty data differs from
them by no more than the bounds of `conditioning` and `residual_conditioning`. Got / bound / ratio are printed.

With the backward error measured in 50 digits (tens of units in the last place at the most) instead of the worst case (thousands), the
bounds hold as well: what remains in floats is conditioning.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from random import Random
from typing import Any

import mpmath
import numpy as np
import pytest

from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.signals import hankel, simulate
from faultspace.exact.system.systems import ResidualSystem
from faultspace.numeric.method.model.compression import Blocks, Compression, compress
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.past_inputs import pi_moesp, pi_moesp_from_compression
from faultspace.numeric.method.model.residuals import residual
from faultspace.numeric.method.ranks.hankel_ranks import hankel_values
from faultspace.numeric.method.ranks.rank_gap import fault_dimension
from faultspace.numeric.method.signal.reconstruction import reconstruct_fault
from faultspace.numeric.study.conditioning import (
    BackwardError,
    Setting,
    by_gram,
    by_qr,
    gram_error,
    measured,
    moesp_error,
    noise_free_range,
    output_error_error,
    reflections_error,
    setting,
)
from faultspace.numeric.study.residual_conditioning import fault_signal_error, fitted_state_error
from tests.numeric import high_precision as precise
from tests.numeric.exact_cases import ExactCase, exact_case, floats
from tests.numeric.rounding_bounds import given_state_error, noisy_range, singular_value_error

CASES = [(1, 1, 1), (1, 2, 2), (2, 2, 1), (3, 1, 2), (3, 2, 2)]  # n, n_u, p
DIGITS_KEPT = 1e-40


def print_margin(label: str, got: float, bound: float) -> None:
    print(f"{label}: got {got:.1e}, bound {bound:.1e}, ratio {got / bound:.1e}")


def window(n: int) -> int:
    return n + 2


def coloured_fault(samples: int, p: int, seed: int) -> Any:
    """Return a moving average on every output."""
    white = np.random.default_rng(seed).standard_normal((samples + 3, p))
    return white[3:] + 0.9 * white[2:-1] + 0.7 * white[1:-2] + 0.5 * white[:-3]


# PI-MOESP


@pytest.mark.parametrize("n, n_u, p", CASES)
def test_fifty_digits_give_the_exact_system(n: int, n_u: int, p: int) -> None:
    """Without noise the Markov parameters, the characteristic polynomial and x0 are right to 1e-40 by both regressions, and the rank is
    n exactly."""
    case = exact_case(5, n, n_u, p, samples=40)
    with precise.precise():
        y, u = precise.lift(case.y), precise.lift(case.u)
        truth = precise.Model(*(precise.lift(M) for M in (case.A, case.B, case.C, case.D)))
        factor = precise.compression(y, u, window(n), window(n))
        A, C, values = precise.identify(factor, n)
        assert values[n - 1] > 1e-6 and all(value < DIGITS_KEPT for value in values[n:])
        wanted = precise.markov(truth, 2 * n + 2)
        models = [precise.by_moesp(factor, A, C), precise.by_output_error(y, u, A, C, np.ones(p))]
        for model in models:
            assert precise.norm(precise.markov(model, 2 * n + 2) - wanted) < DIGITS_KEPT
        polynomials = [precise.characteristic_polynomial(M) for M in (A, truth.A)]
        assert precise.norm(polynomials[0] - polynomials[1]) < DIGITS_KEPT
        assert precise.norm(precise.simulate(models[1], u, models[1].x0) - y) < DIGITS_KEPT


def measured_by_qr(where: Setting, H: Any) -> float:
    """Return the least E, each row relative to its row of H, with factor the one of H + E: an orthogonal Procrustes problem."""
    exact = precise.triangle(H.T)
    lengths = np.array([precise.norm(exact[:, j]) for j in range(len(exact))], dtype=object)
    found, exact = precise.lift(where.compression.factor) / lengths, exact / lengths
    left, _, right = mpmath.svd_r(mpmath.matrix((exact @ found.T).tolist()))
    turn = np.array((left * right).tolist(), dtype=object).reshape(len(exact), -1)
    E = turn @ found - exact
    return max(float(precise.norm(E[:, j])) for j in range(len(exact)))


def measured_by_gram(where: Setting, H: Any) -> float:
    """Return the largest |dG_ij| / |h_i| |h_j| over the blocks that are used."""
    found = precise.lift(where.compression.factor)
    lengths = np.array([precise.norm(row) for row in H], dtype=object)
    off = (found.T @ found - H @ H.T)[:, : where.compression.inputs]
    return float(np.max(np.abs(off / np.multiply.outer(lengths, lengths[: where.compression.inputs]))))


@dataclass(frozen=True, eq=False)
class Both:
    """The same floats are taken through numeric/ and through 50 digits; `got` is what of the float models differs, by name."""

    label: str
    y: Any
    u: Any
    where: Setting
    where_full: Setting
    H: Any
    got: dict[str, Any]


def both_ways(n: int, n_u: int, p: int, smoothing: int, noise: float, route: str) -> Both:
    case = exact_case(7, n, n_u, p, samples=44, smoothing=smoothing)
    y, u = case.data()
    y = y + noise * coloured_fault(len(y), p, n) * np.sqrt(np.mean(y**2, axis=0))
    s, count = n // p + 2, 2 * n + 2
    compressed = compress(y, u, block_rows=s, route=route)
    plain, full = pi_moesp_from_compression(compressed, order=n), pi_moesp(y, u, order=n, block_rows=s, route=route)
    assert full.x0 is not None
    where = setting(compressed, plain)
    with precise.precise():
        Y, U = precise.lift(y), precise.lift(u)
        factor = precise.compression(Y, U, s, s)
        A, C, _ = precise.identify(factor, n, where.scale)
        exact = {"MOESP": precise.by_moesp(factor, A, C), "output error": precise.by_output_error(Y, U, A, C, where.scale)}
        got = {}
        for found, (name, model) in zip((plain, full), exact.items(), strict=True):
            lifted = precise.Model(*(precise.lift(getattr(found, letter)) for letter in "ABCD"))
            got[name] = np.abs(precise.markov(lifted, count) - precise.markov(model, count)).astype(float)
        polynomials = [precise.characteristic_polynomial(M) for M in (precise.lift(plain.A), A)]
        got["det(zI - A)"] = np.abs(polynomials[0] - polynomials[1]).astype(float)
        H = precise.data_matrix(Y, U, s, s)
    label = f"n={n} n_u={n_u} p={p} noise {noise:g} {route} condition {compressed.condition:.0e}"
    return Both(label, y, u, where, setting(compressed, full), H, got)


def excess(both: Both, backward: BackwardError, kind: str) -> float:
    """Return the largest got / bound and print all of them."""
    moved, count = noisy_range(both.where, backward), 2 * both.where.n + 2
    moesp = moesp_error(both.where, backward, moved)
    bounds = {
        "MOESP": moesp.markov(count),
        "output error": output_error_error(both.where_full, moved, [(both.y, both.u)]).markov(count),
        "det(zI - A)": moesp.characteristic_polynomial,
    }
    largest = 0.0
    for name, bound in bounds.items():
        off = both.got[name]
        place = np.unravel_index(np.argmax(off / bound), off.shape)
        print_margin(f"{both.label} {kind} {name}", float(off[place]), float(bound[place]))
        largest = max(largest, float(off[place] / bound[place]))
        assert float(bound[place]) < 1e-3, "a bound that nothing could exceed"
    return largest


NOISY = [  # n, n_u, p, smoothing of u, fault and noise against the response
    (1, 1, 1, 0, 0.0),
    (1, 1, 1, 0, 0.3),
    (1, 2, 2, 0, 1e-3),
    (2, 2, 1, 0, 0.3),
    (3, 1, 2, 0, 1e-3),
    (3, 1, 2, 0, 0.3),
    (3, 2, 2, 0, 0.1),
    (2, 1, 2, 6, 0.3),
]


@pytest.mark.parametrize("n, n_u, p, smoothing, noise", NOISY)
def test_qr_and_fifty_digits_on_faulty_data(n: int, n_u: int, p: int, smoothing: int, noise: float) -> None:
    """The same floats in, both ways through: the difference is within the bound, with the worst case and with the E that was measured."""
    both = both_ways(n, n_u, p, smoothing, noise, "qr")
    with precise.precise():
        size, worst = measured_by_qr(both.where, both.H), reflections_error(len(both.H), both.where.compression.columns)
    print_margin(f"{both.label} backward error", size, worst)
    assert size <= worst
    assert excess(both, by_qr(both.where), "worst case") <= 1
    assert excess(both, measured(both.where, size), "measured") <= 1


@pytest.mark.parametrize("n, n_u, p, smoothing, noise", NOISY)
def test_gram_and_fifty_digits_on_faulty_data(n: int, n_u: int, p: int, smoothing: int, noise: float) -> None:
    """The Gram keeps within its bound in the same way."""
    both = both_ways(n, n_u, p, smoothing, noise, "gram")
    with precise.precise():
        size, worst = measured_by_gram(both.where, both.H), gram_error(both.where)
    print_margin(f"{both.label} backward error", size, worst)
    assert size <= worst
    assert excess(both, by_gram(both.where), "worst case") <= 1


def test_a_broken_projection_is_seen_on_faulty_data(monkeypatch: pytest.MonkeyPatch) -> None:
    """L32 is taken with one millionth of L31 left in it."""
    true_blocks = Compression.blocks

    def blocks(self: Compression) -> Blocks:
        parts = true_blocks(self)
        return parts._replace(l32=parts.l32 + 1e-6 * parts.l31[:, : parts.l32.shape[1]])

    monkeypatch.setattr(Compression, "blocks", blocks)
    both = both_ways(2, 2, 1, 0, 0.3, "qr")
    assert excess(both, by_qr(both.where), "broken") > 1


def worst_direction(answer: Callable[[Any, Any], Any], y: Any, u: Any) -> tuple[Any, Any]:
    """Return signs for each sample: the error of the data, relative to each sample, that moves some Markov parameter most, to first
    order."""
    base, step, slopes = answer(y, u), 1e-7, []
    for signal in (y, u):
        for index in np.ndindex(signal.shape):
            moved = signal.copy()
            moved[index] *= 1 + step
            slopes.append(((answer(moved, u) if signal is y else answer(y, moved)) - base).ravel())
    columns = np.array(slopes)
    hardest = np.argmax(np.abs(columns).sum(axis=0))
    signs = np.where(columns[:, hardest] < 0, -1.0, 1.0)
    return signs[: y.size].reshape(y.shape), signs[y.size :].reshape(u.shape)


def parameters(method: Callable[[Any, Any], Any], count: int, y: Any, u: Any) -> Any:
    """Return Markov parameters of the model that the method finds."""
    return method(y, u).model.markov(count)


@pytest.mark.parametrize("noise", [0.0, 0.3])
@pytest.mark.parametrize(
    "n, n_u, p", [(1, 1, 1), pytest.param(1, 2, 2, marks=pytest.mark.slow), (2, 1, 2), pytest.param(3, 2, 2, marks=pytest.mark.slow)]
)
def test_errors_planted_in_the_data(n: int, n_u: int, p: int, noise: float) -> None:
    """Samples wrong by 1e-9 of themselves in the worst direction: the amplification alone, far above rounding, and without any count of
    operations. The bound holds, and is not idle: the worst data reach at least one part in ten thousand of it.
    """
    case, relative, count, s = exact_case(7, n, n_u, p, samples=40), 1e-9, 2 * n + 2, n // p + 2
    y, u = case.data()
    y = y + noise * coloured_fault(len(y), p, n) * np.sqrt(np.mean(y**2, axis=0))

    def plain(y: Any, u: Any) -> Any:
        return pi_moesp_from_compression(compress(y, u, block_rows=s, route="qr"), order=n)

    def full(y: Any, u: Any) -> Any:
        return pi_moesp(y, u, order=n, block_rows=s, route="qr")

    compressed = compress(y, u, block_rows=s, route="qr")
    for name, method in (("MOESP", plain), ("output error", full)):
        found = method(y, u)
        where = setting(compressed, found)
        error = measured(where, relative)
        moved = noisy_range(where, error) if noise else noise_free_range(where, error)
        if method is plain:
            bound = moesp_error(where, error, moved).markov(count)
        else:
            bound = output_error_error(where, moved, [(y, u)], relative=relative).markov(count)
        wrong_y, wrong_u = worst_direction(partial(parameters, method, count), y, u)
        off = method(y * (1 + relative * wrong_y), u * (1 + relative * wrong_u)).model.markov(count) - found.model.markov(count)
        ratio = float(np.max(np.abs(off) / bound))
        print(f"n={n} n_u={n_u} p={p} noise {noise:g} {name}: worst planted error over bound {ratio:.1e}")
        assert 1e-4 < ratio <= 1


# Residual, ranks, fault signal


def faulty(seed: int, *, samples: int = 40, m: int = 1) -> tuple[ExactCase, ResidualSystem, Matrix, Matrix]:
    """Return an exact case with faults added to its outputs: the case with the faulty y, the fault system, v and the fault response from
    rest."""
    case = exact_case(seed, 3, 2, 2, samples=samples)
    rng = Random(seed)
    F, G = (Matrix.of([[rng.randint(-5, 5) for _ in range(m)] for _ in range(rows)], shape=(rows, m)) for rows in (3, 2))
    v = Matrix.of([[rng.randint(-9, 9) for _ in range(m)] for _ in range(samples)], shape=(samples, m))
    system = ResidualSystem(case.A, F, case.C, G)
    response = simulate(system, Matrix.zero(system.field, 3, 1), v).residuals
    return ExactCase(case.A, case.B, case.C, case.D, case.x0, case.u, case.y + response), system, v, response


def rounded(case: ExactCase) -> StateSpaceModel:
    return StateSpaceModel(*(floats(M) for M in (case.A, case.B, case.C, case.D)))


@pytest.mark.parametrize("seed", range(4))
def test_residual_from_a_given_state(seed: int) -> None:
    """The residual is held against the fault response of the exact branch; and a state off by 1e-9 of itself is noticed."""
    case, _, _, response = faulty(seed)
    y, u = case.data()
    model, x0 = rounded(case), floats(case.x0).ravel()
    bound = given_state_error(y, u, model, x0)
    got = float(np.linalg.norm(residual(y, u, model, x0=x0).r - floats(response)))
    print_margin("residual, x0 given", got, bound)
    assert got <= bound
    assert np.linalg.norm(residual(y, u, model, x0=x0 * (1 + 1e-9)).r - floats(response)) > bound


@pytest.mark.parametrize("seed", range(4))
def test_residual_with_a_fitted_state(seed: int) -> None:
    """Fifty digits start from the exact rationals and floats from their roundings; fifty digits without the fit are far outside."""
    case, _, _, response = faulty(seed)
    y, u = case.data()
    model = rounded(case)
    found = residual(y, u, model).r
    with precise.precise():
        exact_model = precise.Model(*(precise.lift(M) for M in (case.A, case.B, case.C, case.D)))
        exact = precise.residual(precise.lift(case.y), precise.lift(case.u), exact_model)
        # The fit takes out the free response that looks like the fault's: what is left obeys the fault model from another state.
        free = precise.observability(exact_model.A, exact_model.C, len(exact))
        left = (exact - precise.lift(response)).reshape(-1, 1)
        assert precise.norm(left - free @ precise.least_squares(free, left)) < DIGITS_KEPT
        got = float(precise.norm(precise.lift(found) - exact))
        unfitted = float(precise.norm(precise.lift(response) - exact))
    bound = fitted_state_error(y, u, model, found)
    print_margin("residual, x0 fitted", got, bound)
    assert got <= bound < 1e-6 < unfitted


@pytest.mark.parametrize("seed", range(3))
def test_singular_values_of_the_residual(seed: int, windows: int = 6) -> None:
    """n_v and the ranks of R_s are those of the exact branch, zeros lie below 1e-40 in 50 digits, and float singular values within
    Weyl's bound."""
    _, system, _, response = faulty(seed)
    assert fault_dimension(floats(response), block_rows=windows).n_v == kernel_representation(system).normal_rank == 1
    values = hankel_values(floats(response), windows)
    columns = response.nrows - windows + 1
    with precise.precise():
        exact = precise.hankel_values(precise.lift(response), windows)
    for s in range(1, windows + 1):
        true_rank = rank(hankel(response.rows(range(s + columns - 1)), s))
        assert sum(value > DIGITS_KEPT for value in exact[s - 1]) == true_rank
        bound = singular_value_error(values[s - 1], columns)
        got = float(np.max(np.abs(values[s - 1] - exact[s - 1].astype(float))))
        print_margin(f"singular values of R_{s}", got, bound)
        assert got <= bound and int(np.sum(values[s - 1] > bound)) == true_rank
        # Windows one sample short: another matrix, and not within the bound.
        other = np.linalg.svd(np.vstack([floats(response)[i : i + columns - 1].T for i in range(s)]), compute_uv=False)
        assert np.max(np.abs(values[s - 1] - other)) > bound


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("seed, direct", [(0, True), (1, True), (2, True), (1, False), (2, False)])
def test_the_fault_signal(seed: int, direct: bool, known: bool) -> None:
    """The exact v is met on the trusted samples; and a signal read one sample late is outside the bound."""
    system, v, trajectory = invertible(seed, direct=direct)
    r = floats(trajectory.residuals)
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    x0 = floats(trajectory.states.rows([0])).ravel() if known else None
    found = reconstruct_fault(r, A, F, C, G, x0=x0)
    first, last = found.trusted
    bound = fault_signal_error(r, A, F, C, G, found, x0=x0)
    got = float(np.linalg.norm((found.v - floats(v))[first:last]))
    print_margin(
        f"fault signal, G {'given' if direct else 'zero'}, state {'known' if known else 'unknown'}, samples {first}..{last}", got, bound
    )
    assert last - first >= len(r) - 4 and got <= bound < 1e-6
    assert np.linalg.norm((np.roll(found.v, 1, axis=0) - floats(v))[first:last]) > bound


def invertible(seed: int, *, samples: int = 30, direct: bool = True) -> tuple[ResidualSystem, Matrix, Any]:
    """Say whether there are more outputs than faults and no finite zero: v is then seen at once, or one sample later without
    feedthrough."""
    rng = Random(seed)
    case = exact_case(seed, 3, 1, 3)
    F = Matrix.of([[rng.randint(1, 5)] for _ in range(3)], shape=(3, 1))
    G = Matrix.of([[rng.randint(1, 5) if direct else 0] for _ in range(3)], shape=(3, 1))
    system = ResidualSystem(case.A, F, case.C, G)
    v = Matrix.of([[rng.randint(-9, 9)] for _ in range(samples)], shape=(samples, 1))
    x0 = Matrix.of([[rng.randint(-9, 9)] for _ in range(3)], shape=(3, 1))
    return system, v, simulate(system, x0, v)


def test_the_fault_signal_in_fifty_digits() -> None:
    """The regularised problem is solved again for what it leaves over: it is right to 1e-40 after a few rounds, and not after one."""
    system, v, trajectory = invertible(1, samples=12)
    with precise.precise():
        r = precise.lift(trajectory.residuals)
        A, F, C, G = (precise.lift(M) for M in (system.A, system.F, system.C, system.G))
        for refinements, smallest, largest in ((1, 1e-14, 1e-6), (12, 0.0, DIGITS_KEPT)):
            x0, found = precise.reconstruct(r, A, F, C, G, 1e-5, refinements)
            assert smallest < precise.norm(found - precise.lift(v)) < largest or smallest == 0.0
            assert smallest < precise.norm(x0 - precise.lift(trajectory.states.rows([0])).ravel()) < largest or smallest == 0.0
        assert precise.norm(found - precise.lift(v)) < DIGITS_KEPT
