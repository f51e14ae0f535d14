"""These are the experiments whose population limits are asked for: a system, its signals as filters of white noise, and two windows.

    Experiment        system (with B, D), s, past, u_filter, v_filter, w_filter or None
    read_experiment   from the dict of an exact file
    MAX_WINDOW_ROWS, MAX_STATES   what is supported

u(k) = sum_j U_j e(k-j) and v(k) = sum_j V_j e(k-j) are of the same white e of unit covariance, and w is of an independent one. A fault that
leads the input, v(k) = K u(k+1), is written by delaying u. The field is Q: covariances over another one have no meaning as numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import Shown, counted
from ..algebra.fields import QQ
from ..algebra.stability import is_stable
from ..algebra.validation import whole
from ..system.systems import FaultySystem, read_system
from .filters import Filter, read_filter

MAX_WINDOW_ROWS = 2048
MAX_STATES = 2048
_SYSTEM_KEYS = (*"AFCGBD", "field", "n", "m", "p", "nu")
_OWN_KEYS = ("s", "past", "u_filter", "v_filter", "w_filter")


@dataclass(frozen=True, repr=False)
class Experiment(Shown):
    """A system over Q with a stable A and the stationary signals that drive it: what `limit` answers for.

    `system` is a FaultySystem with n states, m faults, p outputs and nu inputs. `u_filter` (matrices nu x noise over lag), `v_filter` (m x
    noise) and `w_filter` (p x noise, or None) make input, fault and output noise out of white noise; u and v share theirs. `s` >= 1 and
    `past` >= 1 are the numbers of block rows of the future and the past window, with (s + past)(nu + p) at most 2048, and n and the
    filters' states are at most 2048 together.

    Raises InvalidInput for anything else, for a field other than Q, an A that is not stable and an input that is identically zero.

    >>> from faultspace.exact import Experiment, Filter, System
    >>> system = System(A=[["1/2"]], B=[[1]], C=[[1]], D=[[0]], F=[[1]], G=[[0]])
    >>> experiment = Experiment(system, s=2, past=2, u_filter=Filter.of([[[1, 0]]]), v_filter=Filter.of([[[0, 1]]]))
    >>> experiment.sizes
    '1 state, 1 fault, 1 output, 1 input; s = 2, past = 2'
    """

    system: FaultySystem
    s: int
    past: int
    u_filter: Filter
    v_filter: Filter
    w_filter: Filter | None = None

    def __post_init__(self) -> None:
        residual, nu = self.system.residual, self.system.nu
        if residual.field != QQ:
            raise InvalidInput(f"field: got {residual.field}, expected Q: covariances need numbers that can be compared")
        if nu == 0:
            raise InvalidInput("B: got no input, expected one at least: without inputs there are no instruments")
        if residual.p == 0:
            raise InvalidInput("C: got no output, expected one at least")
        for name, value in (("s", self.s), ("past", self.past)):
            if (number := whole(value)) is None or number < 1:
                raise InvalidInput(f"{name}: got {shorten(value)}, expected an integer >= 1, a number of block rows")
            object.__setattr__(self, name, number)
        rows = (self.s + self.past) * (nu + residual.p)
        if rows > MAX_WINDOW_ROWS:
            raise InvalidInput(f"s, past: got windows of (s + past)(nu + p) = {rows} rows, at most {MAX_WINDOW_ROWS} are supported")
        given = [("u_filter", self.u_filter, nu, "nu"), ("v_filter", self.v_filter, residual.m, "m")]
        if self.w_filter is not None:
            given.append(("w_filter", self.w_filter, residual.p, "p"))
        for name, one, channels, symbol in given:
            if one.channels != channels:
                raise InvalidInput(f"{name}: got {counted(one.channels, 'row')}, expected {symbol} = {channels}")
        states = residual.n + sum(one.memory * one.noise for _, one, _, _ in given)
        if states > MAX_STATES:
            raise InvalidInput(
                f"filters: got {states} states of system and filters, at most {MAX_STATES} are supported: try fewer lags, or columns"
            )
        if residual.m and self.v_filter.noise != self.u_filter.noise:
            raise InvalidInput(
                f"v_filter: got matrices with {counted(self.v_filter.noise, 'column')}, expected "
                f"{self.u_filter.noise} as in u_filter: u and v are "
                "filters of the same white noise; for independent ones give each its own columns"
            )
        if self.u_filter.is_zero():
            raise InvalidInput("u_filter: got an input that is identically zero, expected one that excites the system")
        if not is_stable(residual.A):
            raise InvalidInput(
                "A: got eigenvalues on or outside the unit circle, expected all inside: else there is no stationary state; try a system "
                "closed by its controller, or one with A scaled down"
            )

    @property
    def sizes(self) -> str:
        """This says in words how many states, faults, outputs and inputs there are, and how many block rows both windows have."""
        return f"{self.system.sizes.rpartition(', over ')[0]}; s = {self.s}, past = {self.past}"

    def to_json(self) -> dict[str, Any]:
        """Return the dict that exact files hold."""
        result = self.system.to_json() | {"s": self.s, "past": self.past}
        result |= {"u_filter": self.u_filter.to_json(), "v_filter": self.v_filter.to_json()}
        return result if self.w_filter is None else result | {"w_filter": self.w_filter.to_json()}

    @property
    def title(self) -> str:
        """The same as `sizes`."""
        return self.sizes

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the matrices of the system, and the sizes of the filters."""
        yield from self.system.sheet()
        for name, one in (("u_filter", self.u_filter), ("v_filter", self.v_filter), ("w_filter", self.w_filter)):
            if one is not None:
                yield name, f"{counted(one.channels, 'channel')} from {counted(one.noise, 'white noise')}, memory {one.memory}"


def read_experiment(data: object, *, where: str = "experiment") -> Experiment:
    """Return the Experiment that the dict of an exact file holds.

    Parameters
    ----------
    data : dict
        "A", "B", "C", "D", "F", "G" and the sizes as in a system's file, the block rows "s" and "past", "u_filter" and "v_filter", and
        "w_filter" where there is output noise; the shapes are those of Experiment.
    where : str
        How messages call it.

    Returns
    -------
    Experiment

    Raises
    ------
    InvalidInput
        With one line that names the place, for what is missing, unknown or outside what an Experiment can be.

    Examples
    --------
    >>> from faultspace.exact import read_experiment
    >>> system = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [[1]], "G": [[0]]}
    >>> experiment = read_experiment({**system, "s": 2, "past": 2, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]})
    >>> experiment.s, experiment.u_filter.noise, experiment.w_filter
    (2, 2, None)
    """
    if not isinstance(data, Mapping):
        raise InvalidInput(f"{where}: got {shorten(data)}, expected an object with A, B, C, D, F, G, s, past, u_filter, v_filter")
    unknown = sorted(set(map(str, data)) - set(_SYSTEM_KEYS) - set(_OWN_KEYS))
    if unknown:
        raise InvalidInput(f"{where}: unknown key {shorten(unknown[0])}, expected {', '.join(_SYSTEM_KEYS + _OWN_KEYS)}")
    missing = [key for key in (*_SYSTEM_KEYS[:6], *_OWN_KEYS[:4]) if key not in data]
    if missing:
        raise InvalidInput(f'{where}: key "{missing[0]}" is missing, expected A, B, C, D, F, G, s, past, u_filter, v_filter')
    system = read_system({key: value for key, value in data.items() if key not in _OWN_KEYS}, where=where)
    assert isinstance(system, FaultySystem)
    try:
        u = read_filter(data["u_filter"], channels=system.nu, where="u_filter")
        v = read_filter(data["v_filter"], channels=system.residual.m, where="v_filter")
        w = read_filter(data["w_filter"], channels=system.residual.p, where="w_filter") if "w_filter" in data else None
        return Experiment(system, data["s"], data["past"], u, v, w)
    except InvalidInput as error:
        raise InvalidInput(f"{where}.{error}") from None
