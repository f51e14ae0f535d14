"""This says what the float methods accept as data, and what they say to the rest; what they refuse is InvalidData.

Arrays are time-major: one row a sample, one column a channel; a 1-d array is one channel. Integers, booleans, float32 and strided arrays
are read as float64; the caller's arrays are never written to. Data too long for memory come in pieces, converted and checked one by one.

two_dimensional     an array as (N, channels) without a copy, whatever its real type
signal, signals     checked float64 arrays (N, p), or the pair y, u of equal length
pieces              the checked float64 pieces (y, u) of one experiment, for data that should not be copied whole
experiment          the checked pieces (y, u) of one experiment, from arrays or pieces, anew at each `iter`
checked_piece       one such piece that the caller hands over
enough_samples      a refusal of too few samples, with a hint at transposed data
first_not_finite    where the first number stands that is NaN or infinite
positive            a positive integer argument
whole               an integer argument with a least value
noise_deviations    the deviations of the noise in the outputs, as they are stated
constant_channels   numbers of the channels that never change, from their least and greatest values
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from operator import index
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.arrays import Array
from ...base.errors import InvalidData, shorten
from ...base.sheets import counted

PIECE = 1 << 14  # samples converted and checked at once


def positive(value: Any, name: str, advice: str = "") -> int:
    """Return `value` as a positive int. Raises InvalidData for anything else, booleans and floats included; `advice` says what to try."""
    number = _integer(value)
    if number is None or number < 1:
        raise InvalidData(f"{name} must be a positive integer (got {shorten(value)}){advice and f': {advice}'}")
    return number


def whole(value: Any, name: str, least: int, advice: str) -> int:
    """Return `value` as an int of at least `least`. Raises InvalidData for anything else, booleans, floats and text included; `advice` says
    what to try."""
    number = _integer(value)
    if number is None or number < least:
        raise InvalidData(f"{name}: got {shorten(value)}; an integer of at least {least} is needed: {advice}")
    return number


def _integer(value: Any) -> int | None:
    """Return an integer, numpy's included, as an int; None for anything else, booleans among them."""
    if isinstance(value, bool | np.bool_):
        return None
    try:
        return index(value)
    except TypeError:
        return None


def two_dimensional(values: ArrayLike, name: str) -> NDArray[Any]:
    """Return `values` as an array (N, channels), a view where it already is an array. Raises InvalidData for other shapes and types without
    real values.
    """
    if np.ma.is_masked(values):
        raise InvalidData(
            f"{name} has masked samples; every sample is needed: cut the record there, or identify from its parts as several experiments"
        )
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise InvalidData(f"{name} must be an array with one row a sample and one column a channel: {error}") from None
    if array.dtype.kind not in "fiub":
        hint = "split it into real and imaginary channels" if array.dtype.kind == "c" else "convert it with numpy.asarray(..., dtype=float)"
        raise InvalidData(f"{name} holds values of type {array.dtype}; real numbers are needed: {hint}")
    if array.ndim == 1:
        array = array[:, np.newaxis]
    if array.ndim != 2:
        raise InvalidData(f"{name} has {array.ndim} axes, shape {array.shape}; (samples, channels) is needed, or one axis for one channel")
    if array.shape[0] == 0 or array.shape[1] == 0:
        raise InvalidData(f"{name} is empty, shape {array.shape}: at least one sample and one channel are needed")
    return array


def _finite(array: NDArray[Any], name: str, first: int) -> Array:
    """Return `array` as float64. Raises InvalidData that names the first sample (counted from `first`) and channel that is not finite."""
    piece = np.asarray(array, dtype=np.float64)
    if wrong := first_not_finite(piece):
        row, column = wrong
        value = "NaN" if np.isnan(piece[row, column]) else "infinite"
        raise InvalidData(
            f"{name} is {value} at sample {first + row}, channel {column} (counted from 0); every sample must be finite: cut the "
            "record there, or identify from its parts as several experiments"
        )
    return piece


def first_not_finite(rows: Array) -> tuple[int, int] | None:
    """Return row and column of the first number that is NaN or infinite, None where every one is finite."""
    # A finite sum needs finite terms: the element-wise search runs only where the sum is not finite (or overflows).
    with np.errstate(over="ignore", invalid="ignore"):
        if np.isfinite(np.sum(rows)):
            return None
    wrong = np.argwhere(~np.isfinite(rows))
    return (int(wrong[0, 0]), int(wrong[0, 1])) if len(wrong) else None


def signal(values: ArrayLike, name: str = "y") -> Array:
    """Return a checked signal (N, channels) in float64: `values` themselves where they are float64, else a converted copy."""
    array = two_dimensional(values, name)
    converted = array.astype(np.float64, copy=False)
    for first in range(0, len(array), PIECE):
        _finite(converted[first : first + PIECE], name, first)
    return converted


def _same_length(y: NDArray[Any], u: NDArray[Any]) -> None:
    if len(y) == len(u):
        return
    hint = "cut both to the samples they share"
    if u.shape[1] == y.shape[1] > max(len(y), len(u)):
        hint = "both look transposed: pass y.T and u.T"
    elif u.shape[1] == len(y):
        hint = "u looks transposed: pass u.T"
    elif y.shape[1] == len(u):
        hint = "y looks transposed: pass y.T"
    raise InvalidData(
        f"y has {counted(len(y), 'sample')} (shape {y.shape}) and u has {len(u)} (shape {u.shape}); equal numbers are needed: {hint}"
    )


def signals(y: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
    """Return checked y (N, p) and u (N, n_u) of equal length."""
    outputs, inputs = two_dimensional(y, "y"), two_dimensional(u, "u")
    _same_length(outputs, inputs)
    return signal(outputs, "y"), signal(inputs, "u")


def enough_samples(samples: int, needed: int, why: str, shape: tuple[int, ...] = ()) -> None:
    """Raise InvalidData where `samples` < `needed`; `why` says what needs them, `shape` (of y) allows a hint at transposed data."""
    if samples >= needed:
        return
    transposed = len(shape) == 2 and shape[1] > shape[0]
    hint = f"y of shape {shape} looks transposed: pass y.T and u.T" if transposed else "record more, or take fewer block_rows or past_rows"
    raise InvalidData(f"{counted(samples, 'sample')} {'is' if samples == 1 else 'are'} too few: {why} needs at least {needed}; {hint}")


def pieces(y: ArrayLike, u: ArrayLike, size: int = PIECE) -> Iterator[tuple[Array, Array]]:
    """Yield the checked pieces of one experiment, `size` samples each but the last: float64 copies only as large as one piece."""
    outputs, inputs = two_dimensional(y, "y"), two_dimensional(u, "u")
    _same_length(outputs, inputs)
    for first in range(0, len(outputs), size):
        part = slice(first, first + size)
        yield _finite(outputs[part], "y", first), _finite(inputs[part], "u", first)


def checked_piece(y: ArrayLike, u: ArrayLike, first: int) -> tuple[Array, Array]:
    """Return one piece (y, u) handed over by the caller, whose first sample has the number `first`."""
    outputs, inputs = two_dimensional(y, "y"), two_dimensional(u, "u")
    _same_length(outputs, inputs)
    return _finite(outputs, "y", first), _finite(inputs, "u", first)


class _Experiment:
    """The object gives the checked pieces of one experiment anew at each `iter`."""

    def __init__(self, begin: Callable[[], Iterator[tuple[Array, Array]]]) -> None:
        self._begin = begin

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        return self._begin()


def experiment(y: ArrayLike | Iterable[tuple[ArrayLike, ArrayLike]], u: ArrayLike | None) -> Iterable[tuple[Array, Array]]:
    """Return the checked pieces (y, u) of one experiment, which can be read more than once: of arrays y (N, p), u (N, n_u), PIECE samples
    each; where u is None, those that y gives at each `iter`, counted from its first sample.
    """
    if u is not None:
        return _Experiment(lambda: pieces(cast(ArrayLike, y), u))
    if isinstance(y, np.ndarray) or not isinstance(y, Iterable):
        raise InvalidData(f"u is missing: got y of type {type(y).__name__} alone; pass u, or pieces (y, u), or a record")
    if isinstance(y, Iterator):
        raise InvalidData(
            "the pieces can be read only once: pass a list, or an object whose `iter` begins anew, or use the compression alone"
        )
    chunks = cast(Iterable[tuple[ArrayLike, ArrayLike]], y)
    return _Experiment(lambda: checked_pieces(chunks))


def checked_pieces(chunks: Iterable[tuple[ArrayLike, ArrayLike]]) -> Iterator[tuple[Array, Array]]:
    """Check each piece (y, u) and yield it; samples are counted over all of them."""
    first = 0
    for y, u in chunks:
        piece = checked_piece(y, u, first)
        first += len(piece[0])
        yield piece


def constant_channels(least: Array, greatest: Array) -> list[int]:
    """Return the numbers (from 0) of the channels whose least and greatest values are equal."""
    return [int(channel) for channel in np.flatnonzero(least == greatest)]


def noise_deviations(level: ArrayLike, p: int) -> Array:
    """Return the standard deviations (p,) of the noise in the outputs, given as one number for all or one for each. Raises InvalidData
    for what is none."""
    try:
        values = np.broadcast_to(np.asarray(level, dtype=np.float64), (p,))
    except (TypeError, ValueError):
        values = np.zeros(p)
    if not (np.all(np.isfinite(values)) and np.all(values > 0)):
        raise InvalidData(f"noise_level: got {shorten(level)}; needed one positive standard deviation, or {p} of them, in units of y")
    return np.asarray(values)
