"""Long records compressed to one small triangular matrix, from which PI-MOESP needs nothing else; parts compressed apart merge to the
whole.

With windows of q = past_rows and s = block_rows samples, the Hankel matrix H = [Uf; Up; Yf] has s n_u, q n_u and s p rows and one column a
window. Its factor R, upper triangular with R.T @ R = H @ H.T, is all that is kept, and H itself is never formed. Two routes give it:

    "qr"     blocks of columns appended one after the other: error about eps, whatever the input       (sequential_qr)
    "gram"   correlations and Hankel displacement: much faster, error about eps * condition^2 * cancellation     (displacement_gram)

With route=None the Gram is tried, and kept where that error is below HARMLESS; else the data are read a second time by QR. Data that can
be read only once (a generator) go by QR. [VV07, ch. 9] has the factor's place in the method.

Compression         the factor with its dimensions; `blocks()` names its parts
compress            from arrays or memory maps
compress_chunks     from pieces (y, u) of one experiment
merge               from compressions of several experiments, or of parts whose edges overlap by past_rows + block_rows - 1 samples
scaled_condition    of a triangular factor, whatever the units
window_rows         (lag, channel) of the rows of H
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.validation import checked_pieces, enough_samples, pieces, positive, two_dimensional
from .displacement_gram import DisplacementGram, factor_from_gram
from .sequential_qr import SequentialQR, triangular

HARMLESS = 1e-11  # relative error of the Gram route up to which it is taken
EPS = float(np.finfo(np.float64).eps)
Pieces = Iterable[tuple[Array, Array]]


class Blocks(NamedTuple):
    """The blocks of L = R.T against Uf, Up, Yf: Yf = l31 Q1 + l32 Q2 + l33 Q3, Up = l21 Q1 + l22 Q2, Uf = l11 Q1, with
    orthonormal Q1, Q2, Q3."""

    l11: Array
    l21: Array
    l22: Array
    l31: Array
    l32: Array
    l33: Array


@dataclass(frozen=True, eq=False)
class Compression:
    """What PI-MOESP needs of any number of samples.

    `factor` (k, k) is upper triangular with a nonnegative diagonal, k = (block_rows + past_rows) n_u + block_rows p; the rows of H come in
    the order Uf, Up, Yf, in each by time, then channel. `samples` and `columns` (windows) are counted over all parts merged; `condition` is
    that of [Uf; Up] with its rows scaled to equal length; `rounding` estimates the relative error of the factor's blocks that a model uses.
    """

    block_rows: int
    past_rows: int
    p: int
    n_u: int
    samples: int
    columns: int
    factor: Array
    route: str
    condition: float
    rounding: float

    @property
    def inputs(self) -> int:
        """Return rows of [Uf; Up]."""
        return (self.block_rows + self.past_rows) * self.n_u

    def blocks(self) -> Blocks:
        """Return the blocks of R.T, as views where possible."""
        lower = self.factor.T
        a, b = self.block_rows * self.n_u, self.inputs
        return Blocks(lower[:a, :a], lower[a:b, :a], lower[a:b, a:b], lower[b:, :a], lower[b:, a:b], lower[b:, b:])


def window_rows(n_u: int, p: int, past_rows: int, block_rows: int) -> NDArray[np.intp]:
    """Return the rows (lag, channel) of [Uf; Up; Yf] for the joint signal [u, y]."""
    past, future = range(past_rows), range(past_rows, past_rows + block_rows)
    inputs, outputs = range(n_u), range(n_u, n_u + p)
    parts = ((future, inputs), (past, inputs), (future, outputs))
    return np.array([(lag, channel) for lags, channels in parts for lag in lags for channel in channels], dtype=np.intp)


def scaled_condition(upper: Array) -> float:
    """Return the condition of a triangular factor with its columns scaled to equal length; infinite where one vanishes."""
    # By a power of two, which rounds nothing: squares of large numbers overflow.
    upper = np.ldexp(upper, -int(np.frexp(np.max(np.abs(upper), initial=0.0))[1]))
    lengths = np.linalg.norm(upper, axis=0)
    return float("inf") if np.any(lengths == 0) else float(np.linalg.cond(upper / lengths))


class _Shape(NamedTuple):
    n_u: int
    p: int
    past_rows: int
    block_rows: int

    def compression(self, samples: int, columns: int, factor: Array, route: str, condition: float, rounding: float) -> Compression:
        return Compression(self.block_rows, self.past_rows, self.p, self.n_u, samples, columns, factor, route, condition, rounding)


def _signals(y: Array, u: Array, first: tuple[int, int]) -> tuple[Array, Array]:
    """Return u and y, in the order of the joint signal, where they have as many channels as the first piece."""
    if (u.shape[1], y.shape[1]) != first:
        raise InvalidData(
            f"a piece has {counted(u.shape[1], 'input')} and {counted(y.shape[1], 'output')} "
            f"where the first has {first[0]} and {first[1]}: all need the same"
        )
    return u, y


def _enough(samples: int, shape: _Shape) -> None:
    lags = shape.past_rows + shape.block_rows
    enough_samples(samples, lags, f"a window of past_rows + block_rows = {shape.past_rows} + {shape.block_rows} samples")


def _started(data: Iterator[tuple[Array, Array]], past_rows: int, block_rows: int) -> tuple[_Shape, tuple[Array, Array]]:
    """Return the shape that the first piece has, and that piece as u and y."""
    try:
        y, u = next(data)
    except StopIteration:
        raise InvalidData("got no data, since the iterable of pieces (y, u) is empty: give at least one piece") from None
    shape = _Shape(u.shape[1], y.shape[1], past_rows, block_rows)
    return shape, (u, y)


def _by_qr(data: Pieces, past_rows: int, block_rows: int) -> Compression:
    source = iter(data)
    shape, piece = _started(source, past_rows, block_rows)
    running = SequentialQR(window_rows(*shape), shape.n_u + shape.p)
    running.append(np.concatenate(piece, axis=1))
    samples = len(piece[0])
    for y, u in source:
        running.append(np.concatenate(_signals(y, u, shape[:2]), axis=1))
        samples += len(y)
    _enough(samples, shape)
    factor, inputs = running.factor(), (past_rows + block_rows) * shape.n_u
    return shape.compression(samples, running.columns, factor, "qr", scaled_condition(factor[:inputs, :inputs]), EPS)


def _by_gram(data: Pieces, past_rows: int, block_rows: int) -> Compression | None:
    """Return the compression by Gram, or None where its input block is not positive definite in floats (squares that overflow included)."""
    source = iter(data)
    shape, piece = _started(source, past_rows, block_rows)
    channels = shape.n_u + shape.p
    running = DisplacementGram(channels, past_rows + block_rows)
    with np.errstate(over="ignore", invalid="ignore"):
        running.append(*piece)
        for y, u in source:
            running.append(*_signals(y, u, shape[:2]))
        _enough(running.samples, shape)
        whole = running.gram()
    rows = window_rows(*shape)
    chosen = rows[:, 0] * channels + rows[:, 1]
    factor, condition = factor_from_gram(whole[np.ix_(chosen, chosen)], (past_rows + block_rows) * shape.n_u)
    if factor is None:
        return None
    rounding = EPS * condition**2 * running.cancellation(whole)
    return shape.compression(running.samples, running.columns, factor, "gram", condition, rounding)


def _by_route(again: Callable[[], Pieces] | None, once: Pieces | None, past_rows: int, block_rows: int, route: str | None) -> Compression:
    """Choose the route and compress; `again` gives the data anew at each call; `once` are data that can be read one time."""
    if route not in (None, "qr", "gram"):
        raise InvalidData(f"route must be 'qr', 'gram' or None, which chooses (got {route!r})")
    data = once if again is None else again()
    assert data is not None
    if route == "qr" or (route is None and again is None):
        return _by_qr(data, past_rows, block_rows)
    by_gram = _by_gram(data, past_rows, block_rows)
    if route == "gram":
        if by_gram is None:
            raise InvalidData(
                "the Gram matrix of the inputs is not positive definite in floats: u excites too few directions for route='gram'; try "
                "route='qr'"
            )
        return by_gram
    assert again is not None
    return by_gram if by_gram is not None and by_gram.rounding <= HARMLESS else _by_qr(again(), past_rows, block_rows)


@one_thread()
def compress(
    y: ArrayLike, u: ArrayLike, *, block_rows: int, past_rows: int | None = None, route: str | None = None, chunk: int = 1 << 14
) -> Compression:
    """Return the compression of one experiment.

    y (N, p), u (N, n_u): arrays or memory maps, read `chunk` samples at a time; extra memory does not grow with N. past_rows defaults to
    block_rows. InvalidData for unusable arrays and for fewer than past_rows + block_rows samples.
    """
    future, past = windows(block_rows, past_rows)
    size = positive(chunk, "chunk")
    outputs, inputs = two_dimensional(y, "y"), two_dimensional(u, "u")
    if len(outputs) == len(inputs):
        enough_samples(len(outputs), past + future, f"a window of past_rows + block_rows = {past} + {future} samples", outputs.shape)
    return _by_route(lambda: pieces(outputs, inputs, size), None, past, future, route)


@one_thread()
def compress_chunks(
    chunks: Iterable[tuple[ArrayLike, ArrayLike]], *, block_rows: int, past_rows: int | None = None, route: str | None = None
) -> Compression:
    """Return the compression of one experiment handed over in consecutive pieces (y, u) of any lengths, without overlap.

    A list, or any object that gives its pieces anew at each `iter`, may be read twice when route is None; a generator is read once, by QR.
    """
    future, past = windows(block_rows, past_rows)

    if isinstance(chunks, Iterator):
        return _by_route(None, checked_pieces(chunks), past, future, route)
    return _by_route(lambda: checked_pieces(chunks), None, past, future, route)


def windows(block_rows: int, past_rows: int | None) -> tuple[int, int]:
    """Check block_rows and past_rows and return both; past_rows = block_rows where it is None."""
    future = positive(block_rows, "block_rows")
    return future, future if past_rows is None else positive(past_rows, "past_rows")


@one_thread()
def merge(*compressions: Compression) -> Compression:
    """Return the compression of all windows of the given ones: of several experiments, or of parts of one.

    Parts of one experiment give the whole when neighbours share past_rows + block_rows - 1 samples: each window is then seen once. The
    order does not matter up to rounding. InvalidData without arguments or where dimensions differ.
    """
    if not compressions:
        raise InvalidData("nothing to merge: give at least one compression")
    first = compressions[0]
    for other in compressions:
        for name in ("block_rows", "past_rows", "p", "n_u"):
            if getattr(other, name) != getattr(first, name):
                raise InvalidData(
                    f"compressions with {name} = {getattr(first, name)} and {getattr(other, name)} cannot be merged: compress with "
                    "equal settings"
                )
    if len(compressions) == 1:
        return first
    factor = triangular(*(one.factor for one in compressions))
    routes = {one.route for one in compressions}
    return _Shape(first.n_u, first.p, first.past_rows, first.block_rows).compression(
        sum(one.samples for one in compressions),
        sum(one.columns for one in compressions),
        factor,
        routes.pop() if len(routes) == 1 else "gram and qr",
        scaled_condition(factor[: first.inputs, : first.inputs]),
        max(one.rounding for one in compressions),
    )
