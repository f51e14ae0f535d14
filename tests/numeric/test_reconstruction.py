"""Fault signals are recovered: exactly where theory says so, with its delay; near zeros only where it says so; never in
a fresh model's dream.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.signal.pair_zeros import fault_zeros, output_nulling
from faultspace.numeric.method.signal.reconstruction import Reconstruction, reconstruct_fault
from faultspace.numeric.method.signal.smoother import linear_recursion
from faultspace.numeric.method.space.by_ranks import fault_space
from tests.numeric.planted import Planted, coloured, faults, paper_example, planted, simulate

ROUNDING = 1e-10


def run(system: Planted, v: Any, x0: Any, *, known: bool = False) -> Reconstruction:
    r = simulate(system, x0, v)
    return reconstruct_fault(r, system.A, system.F, system.C, system.G, x0=x0 if known else None)


def error(found: Reconstruction, v: Any) -> Any:
    """Return the largest error of each sample over the size of v."""
    return np.max(np.abs(found.v - v), axis=1) / np.sqrt(np.mean(v**2))


def test_the_papers_example() -> None:
    """The delay is one: everything but the last sample of v is found, from an unknown initial state."""
    system, v = paper_example(), faults(0, 1001, 1)
    found = run(system, v, [1.0, -2.0, 0.5])
    assert found.delay == 1 and found.trusted == (0, 1000) and found.left_invertible and found.zeros.size == 0
    assert found.misfit < 1e-12 and found.fit == pytest.approx(1)
    assert np.max(error(found, v)[:1000]) < ROUNDING
    assert np.max(error(found, v)[1000:]) > 1e-3  # the last sample cannot be known
    np.testing.assert_allclose(found.x[0], [1.0, -2.0, 0.5], atol=ROUNDING)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("known", [False, True])
@pytest.mark.parametrize("m", [1, 2, 3])
def test_no_zeros(seed: int, known: bool, m: int) -> None:
    """With feedthrough of full rank a known state gives v at once; an unknown one is found from the record."""
    system, v = planted(seed, p=4, m=m), faults(seed, 300, m)
    found = run(system, v, np.arange(5.0), known=known)
    assert found.zeros.size == 0 and found.trusted == (0, 300)
    assert found.delay == 0 if known else found.delay is not None and found.delay > 0
    assert found.misfit < 1e-12 and np.max(error(found, v)) < ROUNDING


@pytest.mark.parametrize("zeros", [(0.5,), (0.3, -0.8), (1.25,), (-1.4, 0.6), (1.2, -1.5, 0.4)], ids=str)
@pytest.mark.parametrize("known", [False, True])
def test_zeros_disturb_the_ends_and_nothing_else(zeros: tuple[float, ...], known: bool) -> None:
    """Trusted samples are right, and the disturbance outside them fades at the rate of the zero."""
    N = 400
    for seed in range(4):
        system, v = planted(seed, zeros), faults(seed, N)
        found = run(system, v, np.ones(5), known=known)
        np.testing.assert_allclose(sorted(found.zeros.real), sorted(zeros), atol=1e-7)
        assert found.misfit < 1e-12
        first, last = found.trusted
        size = error(found, v)
        assert np.max(size[first:last]) < 1e-4
        inside, outside = [abs(q) for q in zeros if abs(q) < 1], [abs(q) for q in zeros if abs(q) > 1]
        assert (first > 0) == (bool(inside) and not known) and (last < N) == bool(outside)
        middle = size[N // 2 - 20 : N // 2 + 20]
        assert np.max(middle) < 1e-8
        if outside:
            assert np.max(size[-5:]) > 1e-3  # an honest limit, not a fault of the method
        if inside and not known:
            assert np.max(size[:3]) > 1e-6


def test_faults_that_are_hard_to_tell_apart() -> None:
    """Two columns lie at an angle of 1e-3: the regularisation alone would bias v by 3 percent, and refinement takes that away."""
    system, v = planted(2), faults(2, 300)
    mix = np.array([[1.0, 1.0], [0.0, 1e-3]])
    close = Planted(system.A, system.F @ mix, system.C, system.G @ mix, None, ())
    assert np.max(error(run(close, v, np.ones(5)), v)) < 1e-8


def test_what_is_left_undetermined_moves_along_the_zero() -> None:
    """With a stable zero and an unknown state the error of v is a multiple of q^k."""
    system, v = planted(3, (0.8,)), faults(3, 200)
    wrong = run(system, v, np.ones(5)).v - v
    ratios = wrong[1:30, 0] / wrong[:29, 0]
    np.testing.assert_allclose(ratios, 0.8, atol=1e-4)


def test_zero_on_the_unit_circle_is_admitted() -> None:
    system, v = planted(4, (1.0,)), faults(4, 300)
    found = run(system, v, np.ones(5))
    assert found.trusted == (0, 0) and "on the unit circle" in found.reason
    assert found.misfit < 1e-9


def test_another_member_of_the_fault_space_explains_the_same_residual() -> None:
    """For a good P the residual is reproduced by (Fhat P, Ghat P), whatever zeros P has placed."""
    system, v = planted(5, (0.5,)), faults(5, 500)
    r = simulate(system, np.ones(5), v)
    space = fault_space(r, system.A, system.C)
    assert space.n_z == 3
    P = np.random.default_rng(5).standard_normal((3, 2))
    found = reconstruct_fault(r, system.A, space.F @ P, system.C, space.G @ P)
    assert found.misfit < 1e-6
    alien = np.random.default_rng(6).standard_normal((8, 2))
    assert reconstruct_fault(r, system.A, alien[:5], system.C, alien[5:]).misfit > 1e-2


def test_equivariance() -> None:
    """Under other state bases, channel orders and units, and other units of the fault, v changes by its own units alone."""
    system, v = planted(6, (0.6, 1.3)), faults(6, 300)
    r = simulate(system, np.ones(5), v)
    reference = reconstruct_fault(r, system.A, system.F, system.C, system.G)
    rng = np.random.default_rng(6)
    T = rng.standard_normal((5, 5))
    units, order, sizes = np.array([1e6, 1e-9, 3.0]), [2, 0, 1], np.array([1e-5, 1e4])
    A, F, C = (
        np.linalg.solve(T, system.A @ T),
        np.linalg.solve(T, system.F) * sizes,
        (units[:, None] * system.C @ T)[order],
    )
    G = (units[:, None] * system.G)[order] * sizes
    found = reconstruct_fault((r * units)[:, order], A, F, C, G)
    assert found.delay == reference.delay and found.trusted == reference.trusted
    first, last = found.trusted
    np.testing.assert_allclose((found.v * sizes)[first:last], reference.v[first:last], atol=1e-4)
    assert found.misfit < 1e-9


def test_noise_is_spread_and_not_amplified_without_bound() -> None:
    """In a strictly non-minimum phase system with noise the causal inverse diverges, and the smoother does not."""
    system, v = planted(7, (1.3,)), faults(7, 2000)
    r = simulate(system, np.zeros(5), v)
    found = reconstruct_fault(r + coloured(7, r, 60), system.A, system.F, system.C, system.G)
    first, last = found.trusted
    assert np.sqrt(np.mean((found.v - v)[first:last] ** 2)) < 0.2
    assert 0 < found.misfit < 1e-2


def test_not_left_invertible() -> None:
    """The same fault stands there twice: the residual is explained, and v is not claimed."""
    system = planted(8, m=1)
    twice = Planted(system.A, np.hstack([system.F, system.F]), system.C, np.hstack([system.G, system.G]), system.Z, ())
    v = faults(8, 200)
    found = run(twice, v, np.zeros(5))
    assert not found.left_invertible and found.delay is None and found.trusted == (0, 0) and "not left-invertible" in found.reason
    assert found.misfit < 1e-9
    np.testing.assert_allclose(found.v.sum(axis=1), v.sum(axis=1), atol=1e-6)


def test_cost_is_linear_in_samples() -> None:
    """A dense matrix would take 6e10 entries for this record of 1e5 samples."""
    system, v = planted(9), faults(9, 100_000)
    found = run(system, v, np.zeros(5))
    assert np.max(error(found, v)[:-5]) < 1e-8


def test_no_states() -> None:
    G = np.random.default_rng(0).standard_normal((3, 2))
    static, v = Planted(np.zeros((0, 0)), np.zeros((0, 2)), np.zeros((3, 0)), G, None, ()), faults(0, 50)
    found = run(static, v, np.zeros(0))
    assert found.delay == 0 and found.trusted == (0, 50) and np.max(error(found, v)) < ROUNDING


@pytest.mark.parametrize("N", [1, 2, 3, 4, 5, 8, 9, 10, 99, 100, 101])
def test_the_blocked_recursion(N: int) -> None:
    """Blocks side by side give what one step after the other gives, whether or not they fit."""
    rng = np.random.default_rng(N)
    A, drive, state = 0.5 * rng.standard_normal((3, 3)), rng.standard_normal((N, 3)), rng.standard_normal(3)
    slow = [state]
    for push in drive:
        slow.append(A @ slow[-1] + push)
    np.testing.assert_allclose(linear_recursion(A, drive, state), slow, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("samples", [1, 2, 3])
def test_short_records(samples: int) -> None:
    system, v = planted(10), faults(10, 3)[:samples]
    found = run(system, v, np.ones(5), known=True)
    assert found.v.shape == (samples, 2) and np.max(error(found, v)) < ROUNDING
    unknown = run(system, v, np.ones(5))
    assert unknown.misfit < 1e-9 and unknown.trusted == (0, 0)


def test_delays_of_a_delay_line() -> None:
    """A fault behind d states is seen d samples late, with the state known or not."""
    for d in range(1, 5):
        A, F, C, G = np.eye(d, k=1), np.eye(d)[:, -1:], np.eye(d)[:1], np.zeros((1, 1))
        limits = fault_zeros(A, F, C, G)
        assert (limits.delay_known_state, limits.delay_unknown_state) == (d, d) and limits.zeros.size == 0
        v = faults(d, 40, 1)
        found = run(Planted(A, F, C, G, None, ()), v, np.ones(d))
        assert found.trusted == (0, 40 - d) and np.max(error(found, v)[: 40 - d]) < ROUNDING


def test_output_nulling_dimension() -> None:
    for count in range(4):
        system = planted(20 + count, (0.5, -0.7, 1.4)[:count])
        assert output_nulling(system.A, system.F, system.C, system.G).shape == (5, count)


def test_input_is_left_alone_and_may_be_of_any_kind() -> None:
    system, v = planted(11), faults(11, 100)
    r = simulate(system, np.ones(5), v)
    before = r.copy()
    strided = np.asfortranarray(np.repeat(r, 2, axis=0))[::2]
    found = reconstruct_fault(strided, system.A.tolist(), system.F, system.C, system.G)
    assert np.array_equal(r, before) and np.max(error(found, v)[:-5]) < ROUNDING
    assert found.v.shape == (100, 2) and found.x.shape == (100, 5) and found.simulated.shape == (100, 3)


BAD = [
    ({"F": np.ones((4, 2))}, r"F, G: got shapes \(4, 2\) and \(3, 2\); needed \(5, n_v\) and \(3, n_v\)"),
    ({"F": np.full((5, 2), np.nan)}, r"F, G: got entries that are NaN"),
    ({"F": np.ones((5, 4)), "G": np.ones((3, 4))}, r"got 4 faults for 3 outputs.*Choose n_v columns"),
    ({"F": np.eye(5)[:, :2] * [1, 0], "G": np.eye(3)[:, :2] * [1, 0]}, r"fault 1 has a zero column in both"),
    ({"A": 2 * np.eye(5)}, r"eigenvalue of modulus 2, which grows to 1e301? over 1000 samples"),
    ({"C": np.ones((2, 5))}, r"r, A, C: got shapes"),
    ({"r": np.full((1000, 3), np.inf)}, r"r is infinite at sample 0"),
    ({"r": np.zeros((1000, 3))}, r"r is zero throughout"),
    ({"x0": np.ones(4)}, r"x0: got 4 entries; needed 5"),
]


@pytest.mark.parametrize("change, message", BAD)
def test_bad_input(change: dict[str, Any], message: str) -> None:
    system = planted(12)
    given = {"r": np.ones((1000, 3)), "A": system.A, "F": system.F, "C": system.C, "G": system.G, "x0": None} | change
    with pytest.raises(InvalidData, match=message):
        reconstruct_fault(given["r"], given["A"], given["F"], given["C"], given["G"], x0=given["x0"])
