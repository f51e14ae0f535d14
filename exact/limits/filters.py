"""Rational filters of white noise, as experiments give them: u(k) = sum_j U_j e(k-j), or the same with a scalar denominator.

    Filter         numerator U_0, ..., U_d (rows x noise) over denominator 1, d_1, ..., d_k, both by lag j = 0, 1, ...
    read_filter    from JSON: a list of matrices over lag, or {"num": [matrices], "den": ["1", ...]}
    MAX_LAG        the longest lag a filter may have

With z(k) = e(k) - d_1 z(k-1) - ... - d_k z(k-k), the output is sum_j U_j z(k-j): the last `memory` values of z are the state.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import counted
from ..algebra.fields import QQ
from ..algebra.matrices import Matrix
from ..algebra.stability import is_schur

MAX_LAG = 256
_STABLE = "all roots of z^k + d_1 z^(k-1) + ... + d_k inside the unit circle"


@dataclass(frozen=True)
class Filter:
    """This rational filter makes a signal out of white noise: it is sum_j numerator[j] q^-j / sum_j denominator[j] q^-j.

    The white noise has unit covariance. `numerator` is a tuple of matrices over lag, each of shape channels x noise, with `noise` the
    number of white noises that come in and `channels` that of signals that come out; `denominator` is a tuple of rationals over lag that
    begins with 1, ends with a nonzero coefficient and is stable. `Filter.of` takes lists and checks all this; at most 256 lags are
    supported.

    Raises InvalidInput, in `Filter.of`, for anything else.

    >>> from faultspace.exact import Filter
    >>> colored = Filter.of([[["1"]]], ["1", "-1/2"])  # u(k) = u(k-1) / 2 + e(k)
    >>> colored.channels, colored.noise, colored.memory
    (1, 1, 1)
    >>> colored.to_json()
    {'num': [[['1']]], 'den': ['1', '-1/2']}
    """

    numerator: tuple[Matrix, ...]
    denominator: tuple[Any, ...]

    @staticmethod
    def of(numerator: object, denominator: object = (1,), *, channels: int | None = None, where: str = "filter") -> Filter:
        """Return the filter with these matrices over lag (lists, sympy matrices) and scalars over lag. Raises InvalidInput."""
        if not isinstance(numerator, (list, tuple)) or not numerator:
            raise InvalidInput(f"{where}: got {shorten(numerator)}, expected a list of matrices over lag 0, 1, ..., one at least")
        if not isinstance(denominator, (list, tuple)) or not denominator:
            raise InvalidInput(f'{where}.den: got {shorten(denominator)}, expected a list of rationals that begins with "1"')
        if max(len(numerator), len(denominator)) > MAX_LAG + 1:
            raise InvalidInput(f"{where}: got {max(len(numerator), len(denominator))} lags, at most {MAX_LAG} beyond lag 0 are supported")
        matrices: list[Matrix] = []
        for j, entries in enumerate(numerator):
            place = f"{where}[{j}]"
            if channels == 0 and isinstance(entries, (list, tuple)) and not entries:
                matrices.append(Matrix.zero(QQ, 0, 0))
                continue
            matrix = Matrix.of(entries, where=place)
            if channels is not None and matrix.nrows != channels:
                raise InvalidInput(f"{place}: got {counted(matrix.nrows, 'row')}, expected {channels}, one for each channel of the signal")
            if matrices and matrix.shape != matrices[0].shape:
                raise InvalidInput(
                    f"{place}: got shape {matrix.nrows} x {matrix.ncols}, expected {matrices[0].nrows} x {matrices[0].ncols} as at lag 0"
                )
            matrices.append(matrix)
        scalars = [QQ.element(x, f"{where}.den[{j}]") for j, x in enumerate(denominator)]
        if scalars[0] != 1:
            raise InvalidInput(f'{where}.den[0]: got {scalars[0]}, expected "1": divide numerator and denominator by it')
        if not is_schur([Fraction(int(x.p), int(x.q)) for x in reversed(scalars)]):
            raise InvalidInput(f"{where}.den: got an unstable denominator, expected {_STABLE}; a stationary signal has no other")
        while scalars[-1] == 0:
            scalars.pop()
        return Filter(tuple(matrices), tuple(scalars))

    @property
    def channels(self) -> int:
        """The number of rows of each matrix."""
        return self.numerator[0].nrows

    @property
    def noise(self) -> int:
        """The number of columns of each matrix: the dimension of the white noise."""
        return self.numerator[0].ncols

    @property
    def memory(self) -> int:
        """This says how many past values of z are needed."""
        return max(len(self.numerator), len(self.denominator)) - 1

    def is_zero(self) -> bool:
        """This tells whether the signal is identically zero."""
        return all(matrix.is_zero() for matrix in self.numerator)

    def to_json(self) -> object:
        """Return a list of matrices where the denominator is 1, else {"num", "den"}."""
        matrices = [matrix.to_json() for matrix in self.numerator]
        return matrices if len(self.denominator) == 1 else {"num": matrices, "den": [QQ.write(x) for x in self.denominator]}


def read_filter(data: object, *, channels: int, where: str) -> Filter:
    """Return the Filter of an experiment's file, for a signal of so many channels.

    Parameters
    ----------
    data : list or dict
        A list of matrices over lag, each of shape channels x noise, or a dict with "num", such a list, and "den", a list of rationals
        that begins with "1".
    channels : int
    where : str
        How messages call it.

    Returns
    -------
    Filter

    Raises
    ------
    InvalidInput
        With one line that names the place.

    Examples
    --------
    >>> from faultspace.exact import read_filter
    >>> read_filter([[["1"]], [["1/2"]]], channels=1, where="u_filter").memory
    1
    """
    if not isinstance(data, Mapping):
        return Filter.of(data, channels=channels, where=where)
    if set(data) != {"num", "den"}:
        raise InvalidInput(f'{where}: got keys {shorten(sorted(map(str, data)))}, expected "num" and "den", or a list of matrices over lag')
    return Filter.of(data["num"], data["den"], channels=channels, where=where)
