"""The fault dimension: exact ranks where only rounding stands in between, few and never wrong answers under noise."""

from fractions import Fraction
from itertools import pairwise, product

import numpy as np
import pytest
import scipy.signal
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.ranks.hankel_ranks import hankel_triangle, hankel_values
from faultspace.numeric.method.ranks.one_row import kernel_row, window_moments
from faultspace.numeric.method.ranks.rank_gap import fault_dimension
from tests.thorough import every

Array = NDArray[np.float64]


def structured_residual(delays: tuple[int, ...], indices: tuple[int, ...], seed: int, samples: int = 1500) -> Array:
    """Return a residual with left indices `indices` and one fault per entry of `delays`, known by construction.

    A chain of length eta seen at its end and driven by nothing has left index eta; a chain of length d driven at its start is a delayed
    fault. State feedback, output injection and mixed outputs leave the Kronecker structure of the pencil alone.
    """
    random = np.random.default_rng(seed)
    lengths, m = (*delays, *indices), len(delays)
    n, p = sum(lengths), len(lengths)
    A, F, C, G = np.zeros((n, n)), np.zeros((n, m)), np.zeros((p, n)), np.zeros((p, m))
    start = 0
    for j, length in enumerate(lengths):
        A[range(start, start + length - 1), range(start + 1, start + length)] = 1.0
        if length:
            C[j, start] = 1.0
        if j < m:
            if length:
                F[start + length - 1, j] = 1.0
            else:
                G[j, j] = 1.0
        start += length
    K, L = random.standard_normal((m, n)), random.standard_normal((n, p))
    shrink = 1.0
    while True:
        A1, C1 = A + F @ K * shrink, C + G @ K * shrink
        A2, F2 = A1 + L @ C1 * shrink, F + L @ G * shrink
        if n == 0 or np.max(np.abs(np.linalg.eigvals(A2))) < 0.97:
            break
        shrink *= 0.8
    mix = np.linalg.qr(random.standard_normal((p, p)))[0]
    x, v = random.standard_normal(n), random.standard_normal((samples, m))
    r = np.empty((samples, p))
    for k in range(samples):
        r[k] = mix @ (C1 @ x + G @ v[k])
        x = A2 @ x + F2 @ v[k]
    return r


def expected_ranks(m: int, indices: tuple[int, ...], windows: int) -> tuple[int, ...]:
    """Return s r + sum_i min(s, eta_i)."""
    return tuple(s * m + sum(min(s, eta) for eta in indices) for s in range(1, windows + 1))


STRUCTURES = [((0,), (2,)), ((1,), (1, 2)), ((0, 1), (3,)), ((2,), (0, 2)), ((1, 0), (1, 2)), ((0, 1, 2), (2,)), ((1,), (0, 1, 1, 2))]


@pytest.mark.parametrize(("delays", "indices"), STRUCTURES)
@pytest.mark.parametrize("seed", [0, 1])
def test_exact_ranks_follow_the_left_indices(delays: tuple[int, ...], indices: tuple[int, ...], seed: int) -> None:
    answer = fault_dimension(structured_residual(delays, indices, seed), block_rows=9)
    assert answer.regime == "rounding", answer.reason
    assert answer.ranks == expected_ranks(len(delays), indices, 10)
    assert answer.gaps == tuple(b - a for a, b in pairwise(answer.ranks))
    assert answer.n_v == len(delays) and answer.decided, answer.reason
    assert min(answer.margins) >= 1.0


def author_example(samples: int = 1001) -> Array:
    """Return the paper's example: A, C, a real eigenvector of A for F, the chirp with offset for v."""
    A = np.array([[0, 1, 0], [0, 0, 1], [float(Fraction(-1, 4)), 0.75, 0.25]])
    values, vectors = np.linalg.eig(A)
    F = vectors[:, np.argmax(np.isreal(values))].real
    C = np.eye(2, 3)
    k = np.arange(samples)
    v = np.sin(0.25 * k**1.3) + 0.1
    x = np.random.default_rng(0).standard_normal(3)
    r = np.empty((samples, 2))
    for i in range(samples):
        r[i] = C @ x
        x = A @ x + F * v[i]
    return r


def test_the_papers_example_has_its_exact_ranks() -> None:
    answer = fault_dimension(author_example(), block_rows=5)
    assert answer.ranks == (2, 4, 5, 6, 7, 8)
    assert answer.n_v == 1
    assert fault_dimension(author_example()).n_v == 1


def test_as_many_faults_as_outputs_stay_undecided() -> None:
    for delays in ((1, 0), (0, 0, 1)):
        answer = fault_dimension(structured_residual(delays, (), 3))
        assert set(answer.gaps) == {len(delays)} or answer.regime == "noise"
        assert answer.n_v is None


def noisy(r: Array, decibel: float, seed: int) -> Array:
    """Return r with the paper's low-pass noise in every channel."""
    white = np.random.default_rng(seed).standard_normal((len(r) + 64, r.shape[1]))
    noise = scipy.signal.lfilter([0.17, 0.5, 0.5, 0.17], [1.0, 0.0, 0.33, 0.0], white, axis=0)[64:]
    return np.asarray(r + noise / noise.std(axis=0) * r.std(axis=0) * 10.0 ** (-decibel / 20.0))


@pytest.mark.parametrize(
    ("delays", "indices", "decibel"),
    [((1,), (1, 2), 40.0), ((0,), (1, 1), 40.0), ((1, 0), (1, 2), 50.0), ((0, 1), (2,), 60.0), ((1,), (1, 2), 90.0)],
)
def test_noise_hides_the_ranks_but_not_the_laws(delays: tuple[int, ...], indices: tuple[int, ...], decibel: float) -> None:
    for seed in range(0, 2, every()):
        r = noisy(structured_residual(delays, indices, seed), decibel, seed)
        answer = fault_dimension(r)
        assert answer.regime == "noise"
        assert answer.n_v == len(delays), answer.reason
        assert answer.levels[0].outputs == r.shape[1]


@pytest.mark.parametrize("delays", [(1, 0), (0, 0, 1)])
def test_noise_and_no_law_stay_undecided(delays: tuple[int, ...]) -> None:
    for seed in range(0, 2, every()):
        assert fault_dimension(noisy(structured_residual(delays, (), seed), 40.0, seed)).n_v is None


@pytest.mark.parametrize("p", [1, 2, 4])
def test_noise_alone_is_undecided(p: int) -> None:
    for seed in range(0, 2, every()):
        answer = fault_dimension(np.random.default_rng(seed).standard_normal((800, p)))
        assert answer.n_v is None and answer.reason


@pytest.mark.parametrize(
    ("decibel", "factor"), [*product((None,), (1e6, 1e-12, 1e200, -1.0)), *product((40.0,), (1e200, 1e6, 1e-12, -1.0)[:: every(2)])]
)
def test_units_do_not_matter(decibel: float | None, factor: float) -> None:
    exact = structured_residual((1,), (1, 2), 0)
    r = exact if decibel is None else noisy(exact, decibel, 0)
    plain, scaled = fault_dimension(r), fault_dimension(r * factor)
    assert plain.n_v == scaled.n_v == 1
    assert plain.ranks == scaled.ranks and plain.regime == scaled.regime
    assert np.allclose(plain.thresholds, scaled.thresholds, rtol=1e-2 if decibel else 3.0)


@pytest.mark.parametrize("decibel", [40.0, None])
def test_channels_may_be_permuted_and_have_their_own_units(decibel: float | None) -> None:
    exact = structured_residual((1,), (1, 2), 1)
    r = exact if decibel is None else noisy(exact, decibel, 1)
    changed = r[:, [2, 0, 1]] * [1e8, 1.0, 1e-5]
    plain, other = fault_dimension(r), fault_dimension(changed)
    assert plain.n_v == other.n_v == 1
    assert plain.ranks == other.ranks
    assert np.allclose(other.channel_scales, plain.channel_scales[[2, 0, 1]] * [1e8, 1.0, 1e-5])


def test_a_weak_fault_that_a_gram_would_lose() -> None:
    random = np.random.default_rng(5)
    v = random.standard_normal((1000, 2))
    r = np.stack([v[:, 0], v[:, 0] + 1e-9 * v[:, 1], v[:, 0]], axis=1)
    assert np.linalg.matrix_rank(r.T @ r, hermitian=True) == 1
    assert fault_dimension(r).n_v == 2


def test_rounding_left_by_cancellation_is_recognised() -> None:
    r = structured_residual((1,), (1, 2), 2)
    big = np.random.default_rng(6).standard_normal(r.shape) * 3e4
    left = (big + r) - big
    answer = fault_dimension(left, block_rows=9)
    assert answer.ranks == expected_ranks(1, (1, 2), 10) and answer.n_v == 1


def test_single_precision_data_are_judged_by_their_own_rounding() -> None:
    r = structured_residual((1,), (0, 1), 2).astype(np.float32)
    answer = fault_dimension(r, block_rows=6)
    assert answer.regime == "rounding" and answer.n_v == 1


def test_free_responses_and_constant_faults() -> None:
    k = np.arange(2000)
    dying = np.stack([0.9**k, 0.5**k + 0.9**k], axis=1)
    assert fault_dimension(dying).n_v == 0
    lasting = np.stack([np.cos(k) + 1.0, np.sin(k)], axis=1)
    answer = fault_dimension(lasting)
    assert answer.n_v is None and "constant" in answer.reason


def test_the_lag_must_lie_within_the_windows() -> None:
    r = structured_residual((0,), (5,), 0)
    assert fault_dimension(r, block_rows=4).n_v is None
    assert fault_dimension(r, block_rows=12).n_v == 1


def test_one_triangle_serves_every_window_and_chunk() -> None:
    r = np.random.default_rng(7).standard_normal((700, 2))
    values = hankel_values(r, 4)
    columns = len(r) - 3
    for s in range(1, 5):
        direct = np.vstack([r[j : j + columns].T for j in range(s)])
        assert np.allclose(values[s - 1], np.linalg.svd(direct, compute_uv=False), rtol=1e-12)
    triangle, chunked = hankel_triangle(r, 4), hankel_triangle(r, 4, chunk=50)
    assert np.allclose(np.abs(np.diag(triangle)), np.abs(np.diag(chunked)), rtol=1e-12)


def test_the_kernel_row_is_found_and_its_level_is_the_noise_power() -> None:
    random = np.random.default_rng(8)
    v = random.standard_normal(4000)
    # (q^2 - q + 1/2) r_2 = (q + 1/2) r_1 by construction.
    s = np.stack([v, scipy.signal.lfilter([0.0, 1.0, 0.5], [1.0, -1.0, 0.5], v)], axis=1)
    noise = scipy.signal.lfilter([1.0], [1.0, -0.6], random.standard_normal((4000, 2)), axis=0)
    r = s + 0.05 * noise
    truth = np.array([[0.5, -0.5], [1.0, 1.0], [0.0, -1.0]])
    row = kernel_row(window_moments(r, 2))
    sine = np.linalg.norm(row.coefficients - truth * np.sum(truth * row.coefficients) / np.sum(truth**2))
    assert sine < 0.02
    # Innovation variance of the noise, 0.05^2; the spectrum has mean logarithm zero around it. Deviation (2/4000)^(1/2).
    assert abs(row.level - np.log(0.05**2)) < 5 * np.sqrt(2 / 4000)
    assert np.allclose(row.noise_colour[1], -0.6, atol=0.06)
    within = kernel_row(window_moments(r, 2), within=np.eye(6)[:5])
    assert np.allclose(within.coefficients.ravel()[5], 0.0) and within.level > row.level + 1.0


def test_inputs_are_left_alone_and_any_real_type_is_read() -> None:
    random = np.random.default_rng(9)
    v = random.integers(-9, 9, 600)
    r = np.stack([v, np.roll(v, 1), v - np.roll(v, 1)], axis=1)[1:]
    wide = np.zeros((2 * len(r), 6))
    wide[::2, ::2] = r
    kept, wide_kept = r.copy(), wide.copy()
    assert fault_dimension(r).n_v == fault_dimension(wide[::2, ::2]).n_v == 1
    assert np.array_equal(r, kept) and np.array_equal(wide, wide_kept)


@pytest.mark.parametrize("decibel", [40.0, None])
def test_the_error_of_an_identified_model_is_not_a_fault_when_u_is_given(decibel: float | None) -> None:
    exact = structured_residual((1,), (1, 2), 3)
    r = exact if decibel is None else noisy(exact, decibel, 3)
    u = np.random.default_rng(11).standard_normal(len(r))
    error = np.stack([scipy.signal.lfilter([1.0, gain], [1.0, -0.6], u) for gain in (0.5, -1.0, 2.0)], axis=1)
    model_error = 0.03 * r.std(axis=0) * error / error.std(axis=0)
    assert fault_dimension(r + model_error, u=u * 1e7).n_v == 1
    assert fault_dimension(r + model_error).n_v != 1
    with pytest.raises(InvalidData, match="equal numbers"):
        fault_dimension(r, u=u[:-1])


def test_one_channel_cannot_tell_fault_from_noise() -> None:
    assert fault_dimension(np.random.default_rng(10).standard_normal(500)).n_v is None


@pytest.mark.parametrize(
    ("r", "block_rows", "says"),
    [
        (np.full((100, 2), np.nan), None, "NaN"),
        (np.full((100, 2), 3.0), None, "constant"),
        (np.zeros((100, 2)), None, "constant"),
        (np.random.default_rng(0).standard_normal((3, 500)), None, r"\(N, p\)"),
        (np.random.default_rng(0).standard_normal((15, 2)), None, "at least 19 samples .* give more samples or fewer channels$"),
        (np.random.default_rng(0).standard_normal((8, 2)), None, "give more samples$"),  # one channel needs eleven
        (np.random.default_rng(0).standard_normal((8, 1)), None, "give more samples$"),
        (np.random.default_rng(0).standard_normal((3, 2)), 5, "give more samples$"),  # block_rows <= 0 would be refused
        (np.random.default_rng(0).standard_normal((100, 2)), 30, "block_rows <= 19"),
        (np.random.default_rng(0).standard_normal((100, 2)), 0, "positive integer"),
        (np.random.default_rng(0).standard_normal((100, 2)), 2.5, "positive integer"),
        (np.array([["a", "b"]]), None, "real numbers"),
    ],
)
def test_bad_data_are_refused_with_a_reason(r, block_rows, says) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InvalidData, match=says):
        fault_dimension(r, block_rows=block_rows)


@pytest.mark.parametrize("strengths", [(100, 100, 1), (1e3, 1e3, 1), (1e3, 1e3, 1, 1), (1e3, 1e3, 1e3, 1, 1)])
def test_one_fault_of_unequal_strengths_is_not_counted_as_more(strengths: tuple[float, ...]) -> None:
    """Beside a fault that is strong at some outputs, the noise of the others looks like faults of its own."""
    draw = np.random.default_rng(len(strengths))
    r = np.outer(draw.standard_normal(2000), strengths) + draw.standard_normal((2000, len(strengths)))
    assert fault_dimension(r).n_v in (1, None)


def test_one_smooth_noise_among_white_ones_is_no_fault() -> None:
    draw = np.random.default_rng(5)
    r = draw.standard_normal((2000, 3))
    r[:, 0] = scipy.signal.lfilter([1.0], np.poly([0.9, 0.9, 0.9]), r[:, 0])
    assert fault_dimension(r).n_v is None
