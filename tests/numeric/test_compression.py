"""The compression equals the factor of the Hankel matrix written out, by both routes, however the data are cut, in memory independent of
N.
"""

import pickle
import tracemalloc
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model.compression import HARMLESS, Compression, compress, compress_chunks, merge, scaled_condition
from faultspace.numeric.method.model.sequential_qr import TOGETHER

Array = NDArray[np.float64]


def record(samples: int, n_u: int, p: int, seed: int = 0) -> tuple[Array, Array]:
    """Return white y (N, p) and u (N, n_u) with a mean, of unequal sizes."""
    rng = np.random.default_rng(seed)
    y = rng.standard_normal((samples, p)) * 10.0 ** np.arange(p) + 0.5
    return y, rng.standard_normal((samples, n_u)) + 0.3


def written_out(y: Array, u: Array, block_rows: int, past_rows: int) -> Array:
    """Return the factor from the whole Hankel matrix."""
    lags = past_rows + block_rows
    columns = len(y) - lags + 1
    past, future = range(past_rows), range(past_rows, lags)
    stacked = [u[k : k + columns].T for k in future] + [u[k : k + columns].T for k in past] + [y[k : k + columns].T for k in future]
    factor = np.linalg.qr(np.vstack(stacked).T, mode="r")
    turned: Array = np.where(np.diag(factor) < 0, -1.0, 1.0)[:, np.newaxis] * factor
    return turned


def difference(one: Array, other: Array) -> float:
    """Return the largest difference of entries, each column by its length: units cancel."""
    return float(np.max(np.abs(one - other) / np.linalg.norm(other, axis=0)))


def cut(y: Array, u: Array, lengths: list[int]) -> Iterator[tuple[Array, Array]]:
    first = 0
    for length in lengths:
        yield y[first : first + length], u[first : first + length]
        first += length
    yield y[first:], u[first:]


@pytest.mark.parametrize("route", ["qr", "gram"])
@pytest.mark.parametrize(("n_u", "p", "s", "q"), [(1, 1, 3, 3), (2, 3, 5, 4), (3, 2, 4, 7), (2, 12, 3, 2), (1, 1, 1, 1)])
@pytest.mark.parametrize("chunk", [1, 6, 64, 10_000])
def test_the_factor_is_that_of_the_hankel_matrix(route: str, n_u: int, p: int, s: int, q: int, chunk: int) -> None:
    y, u = record(400, n_u, p)
    found = compress(y, u, block_rows=s, past_rows=q, route=route, chunk=chunk)
    assert difference(found.factor, written_out(y, u, s, q)) < 1e-13
    assert (found.route, found.samples, found.columns) == (route, 400, 400 - s - q + 1)
    assert (found.block_rows, found.past_rows, found.n_u, found.p, found.inputs) == (s, q, n_u, p, (s + q) * n_u)


@pytest.mark.parametrize("windows", range(1, 3 * TOGETHER + 2))
def test_windows_that_fill_no_group_are_counted(windows: int) -> None:
    y, u = record(windows + 4, 2, 3)
    found = compress_chunks(cut(y, u, [windows // 2 + 1]), block_rows=2, past_rows=3)
    wanted = written_out(y, u, 2, 3)
    assert found.route == "qr" and found.columns == windows
    assert np.allclose(found.factor.T @ found.factor, wanted.T @ wanted, rtol=0, atol=1e-12 * np.sum(wanted**2))


def test_the_blocks_are_those_of_the_lower_factor() -> None:
    y, u = record(300, 2, 1)
    found = compress(y, u, block_rows=3, past_rows=4)
    parts = found.blocks()
    assert [part.shape for part in parts] == [(6, 6), (8, 6), (8, 8), (3, 6), (3, 8), (3, 3)]
    assembled = np.block([[parts.l11, np.zeros((6, 11))], [parts.l21, parts.l22, np.zeros((8, 3))], [parts.l31, parts.l32, parts.l33]])
    assert np.array_equal(assembled, found.factor.T)


@pytest.mark.parametrize("route", ["qr", "gram", None])
def test_pieces_of_any_length_give_the_same(route: str | None) -> None:
    y, u = record(1000, 2, 2)
    whole = compress(y, u, block_rows=6, route=route)
    for lengths in ([1] * 40, [500], [3, 400, 1, 90, 2]):
        parts = list(cut(y, u, lengths))
        assert difference(compress_chunks(parts, block_rows=6, route=route).factor, whole.factor) < 1e-13
    once = compress_chunks(cut(y, u, [100, 7, 300]), block_rows=6, route=route)
    assert difference(once.factor, whole.factor) < 1e-13
    assert once.route == (route or "qr"), "data that are read once go by QR unless told otherwise"


@pytest.mark.parametrize("route", ["qr", "gram"])
def test_parts_with_overlapping_edges_merge_to_the_whole(route: str) -> None:
    y, u = record(900, 2, 3)
    s, q = 5, 4
    whole = compress(y, u, block_rows=s, past_rows=q, route=route)
    # A part of one window is enough for QR; a Gram needs more windows than input rows.
    edges = [0, 40, 333, 334 if route == "qr" else 390, 800, 900 - (s + q - 1)]
    parts = [compress(y[a : b + s + q - 1], u[a : b + s + q - 1], block_rows=s, past_rows=q, route=route) for a, b in pairwise(edges)]
    merged = merge(*parts)
    assert merged.columns == whole.columns
    assert merged.route == route
    assert difference(merged.factor, whole.factor) < 1e-13
    assert merged.condition == pytest.approx(whole.condition, rel=1e-9)
    # Associative and commutative up to rounding: a reduction over many machines may take any shape.
    assert difference(merge(merge(*parts[3:]), merge(*parts[:3])).factor, whole.factor) < 1e-13


def test_experiments_merge_to_the_sum_of_their_grams() -> None:
    (y1, u1), (y2, u2) = record(300, 1, 2, seed=1), record(200, 1, 2, seed=2)
    one, two = compress(y1, u1, block_rows=4, route="qr"), compress(y2, u2, block_rows=4, route="gram")
    both = merge(one, two)
    gram = one.factor.T @ one.factor + two.factor.T @ two.factor
    assert np.allclose(both.factor.T @ both.factor, gram, rtol=1e-12)
    assert (both.samples, both.columns, both.route) == (500, one.columns + two.columns, "gram and qr")


def test_a_compression_survives_pickling() -> None:
    found = compress(*record(100, 1, 1), block_rows=3)
    again = pickle.loads(pickle.dumps(found))
    assert isinstance(again, Compression)
    assert np.array_equal(again.factor, found.factor)
    assert (again.route, again.condition) == (found.route, found.condition)


def ill_conditioned(samples: int, spread: float) -> Array:
    """Return u whose second difference is white of size `spread` below a slow drift: smooth inputs make the Hankel matrix nearly
    singular."""
    rng = np.random.default_rng(3)
    slow = np.sin(np.arange(samples) / 50.0)
    return (slow + spread * rng.standard_normal(samples))[:, np.newaxis]


def test_the_route_follows_the_condition_of_the_inputs() -> None:
    y, _ = record(2000, 1, 1)
    for spread, route in ((1.0, "gram"), (1e-4, "qr"), (1e-9, "qr")):
        u = ill_conditioned(2000, spread)
        found = compress(y, u, block_rows=8)
        assert found.route == route
        # Both routes tell the same condition, where the Gram can tell it at all.
        assert found.condition == pytest.approx(compress(y, u, block_rows=8, route="qr").condition, rel=1e-3)
    forced = compress(y, ill_conditioned(2000, 1e-4), block_rows=8, route="gram")
    assert forced.rounding > HARMLESS, "a route that the caller insists on reports what it may lose"


def test_a_gram_that_cancels_is_not_taken() -> None:
    y, u = record(500, 1, 1)
    y[0] = 1e7
    assert compress(y, u, block_rows=4).route == "qr"
    assert difference(compress(y, u, block_rows=4).factor, written_out(y, u, 4, 4)) < 1e-13


def test_the_estimated_rounding_bounds_the_difference_of_the_routes() -> None:
    y, _ = record(2000, 1, 1)
    for spread in (1.0, 1e-1, 1e-2, 1e-3, 1e-4):
        u = ill_conditioned(2000, spread)
        gram, qr = (compress(y, u, block_rows=8, route=route) for route in ("gram", "qr"))
        error = difference(gram.blocks().l32, qr.blocks().l32) if spread > 1e-5 else 0.0
        assert error <= 100 * gram.rounding, f"condition {gram.condition:.3g}: difference {error:.3g}, estimate {gram.rounding:.3g}"


@pytest.mark.parametrize("factor", [1e-12, 1e6])
def test_units_change_nothing_but_the_factor_itself(factor: float) -> None:
    y, u = record(500, 2, 2)
    one, other = compress(y, u, block_rows=4), compress(factor * y, u / factor, block_rows=4)
    assert other.route == one.route
    assert other.condition == pytest.approx(one.condition, rel=1e-9)


def test_noise_free_outputs_do_not_break_the_gram() -> None:
    """With outputs that follow from the inputs the whole Gram matrix is singular; only its input block is factored."""
    _, u = record(600, 2, 1)
    y = np.cumsum(u, axis=0)[:, :1] * 0 + u[:, :1] - 0.5 * u[:, 1:]
    gram, qr = (compress(y, u, block_rows=4, route=route) for route in ("gram", "qr"))
    split = gram.inputs
    assert difference(gram.factor[:split], qr.factor[:split]) < 1e-13
    assert np.abs(qr.factor[split:, split:]).max() < 1e-12 * np.abs(qr.factor).max()


def peak(samples: int, route: str) -> int:
    y, u = record(samples, 2, 3)
    tracemalloc.start()
    compress(y, u, block_rows=10, route=route)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


@pytest.mark.parametrize("route", ["qr", "gram"])
def test_memory_does_not_grow_with_the_record(route: str) -> None:
    short, long = peak(40_000, route), peak(400_000, route)
    assert long < 1.05 * short + 1e5
    assert long < 16e6, "the record itself has 16 MB"


def test_types_strides_and_memory_maps_are_read_as_they_are(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    y, u = rng.integers(-50, 50, (300, 2)), rng.integers(-50, 50, (300, 1))
    wanted = compress(y.astype(float), u.astype(float), block_rows=4)
    fortran, strided = np.asfortranarray(y), np.repeat(u, 2, axis=0)[::2]
    mapped = np.memmap(tmp_path / "y.bin", dtype=np.float32, mode="w+", shape=y.shape)
    mapped[:] = y
    for outputs, inputs in ((y, u), (y.astype(np.float32), u[:, 0]), (fortran, strided), (mapped, u), (y.tolist(), u.tolist())):
        before = np.array(outputs), np.array(inputs)
        assert np.array_equal(compress(outputs, inputs, block_rows=4).factor, wanted.factor)
        assert np.array_equal(outputs, before[0])
        assert np.array_equal(inputs, before[1])


def test_read_only_data_are_enough() -> None:
    y, u = record(300, 1, 1)
    y.setflags(write=False)
    u.setflags(write=False)
    assert compress(y, u, block_rows=4).samples == 300


def test_bad_data_are_refused_with_a_way_out() -> None:
    y, u = record(100, 2, 3)
    broken = y.copy()
    broken[70, 2] = np.nan
    infinite = u.copy()
    infinite[3, 1] = -np.inf
    for outputs, inputs, words in (
        (broken, u, "NaN at sample 70, channel 2"),
        (y, infinite, "infinite at sample 3, channel 1"),
        (y[:5], u[:5], "5 samples are too few"),
        (y[:50], u, "y has 50 samples"),
        (y, u.T, "u looks transposed"),
        (y.T, u, "y looks transposed"),
        (y.T, u.T, "both look transposed"),
        (y.T[:2], u.T, "looks transposed"),
        (y + 1j, u, "real numbers are needed"),
        (np.array([["a"] * 3] * 100), u, "real numbers are needed"),
        (np.zeros((100, 2, 2)), u, "3 axes"),
        (np.zeros((0, 3)), u[:0], "empty"),
        (np.zeros((100, 0)), u, "empty"),
    ):
        with pytest.raises(InvalidData, match=words):
            compress(outputs, inputs, block_rows=4, chunk=32)
    with pytest.raises(InvalidData, match="NaN at sample 70"):
        compress_chunks(cut(broken, u, [30, 30]), block_rows=4)
    for rows in (0, -1, 2.0, True, "4"):
        with pytest.raises(InvalidData, match="block_rows must be a positive integer"):
            compress(y, u, block_rows=rows)  # type: ignore[arg-type]
    with pytest.raises(InvalidData, match="route must be"):
        compress(y, u, block_rows=4, route="svd")
    with pytest.raises(InvalidData, match="too few directions"):
        compress(y, np.ones_like(u), block_rows=4, route="gram")
    with pytest.raises(InvalidData, match="is empty"):
        compress_chunks([], block_rows=4)
    with pytest.raises(InvalidData, match="a piece has 1 input "):
        compress_chunks([(y, u), (y, u[:, :1])], block_rows=4)
    with pytest.raises(InvalidData, match="too few"):
        compress_chunks([(y[:3], u[:3])], block_rows=4)
    with pytest.raises(InvalidData, match="nothing to merge"):
        merge()
    with pytest.raises(InvalidData, match="block_rows = 4 and 5"):
        merge(compress(y, u, block_rows=4), compress(y, u, block_rows=5))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("power", [-1000, 600, 1000])
def test_the_condition_of_a_factor_knows_no_units(power: int) -> None:
    upper = np.triu(np.random.default_rng(4).standard_normal((6, 6)))
    assert scaled_condition(np.ldexp(upper, power)) == scaled_condition(upper)
    assert scaled_condition(np.zeros((2, 2))) == float("inf")
