"""This is a linear model x(k+1) = A x(k) + B u(k), y(k) = C x(k) + D u(k) in floats: what is identified, simulated and written to files.

StateSpaceModel         the matrices, checked and read-only, with simulation, Markov parameters and conversions
Simulator               the response to inputs that come in pieces, many samples at a time by matrix products
Identified              what the results of both methods of identification share
observability_matrix    O_s, the rows C, CA, ..., CA^(s-1)
lower_toeplitz          the matrix from a window of inputs to that of outputs
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from itertools import accumulate, repeat
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.validation import signal
from ..plotting import plot_zeros_and_poles

FORMAT = "faultspace-model/1"
BLOCK = 64  # samples simulated by one matrix product
PIECE = 1 << 14  # samples simulated before the next are read
WIDEST = 4  # columns of a matrix that a line of the sheet has room for


def observability_matrix(A: Array, C: Array, rows: int) -> Array:
    """Return O_rows (rows p, n), rows >= 1."""
    return np.concatenate(list(accumulate(repeat(A, rows - 1), lambda block, step: block @ step, initial=C)))


def _matrix(values: ArrayLike, name: str) -> Array:
    try:
        matrix = np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidData(f"{name} must be a matrix of real numbers: {error}") from None
    if matrix.ndim != 2:
        raise InvalidData(f"{name} must be a matrix with two axes (got shape {matrix.shape})")
    if not np.all(np.isfinite(matrix)):
        raise InvalidData(f"{name} has entries that are NaN or infinite; every entry must be finite")
    matrix.setflags(write=False)
    return matrix


@dataclass(frozen=True, eq=False, init=False, repr=False)
class StateSpaceModel(Shown):
    """A linear model in floats: x(k+1) = A x(k) + B u(k), y(k) = C x(k) + D u(k).

    A (n, n), B (n, n_u), C (p, n) and D (p, n_u) are anything that numpy reads as a matrix, in the units of the data, and are copied to
    read-only float64. n may be 0: the arrays then have the shapes (0, 0), (0, n_u), (p, 0) and (p, n_u). Look at `poles` and `is_stable`
    first: they, `markov` and the gain do not depend on the basis of the state, which another estimate may choose otherwise; the entries of
    the matrices do. Raises InvalidData where shapes do not fit or entries are not finite, and ImportError in `plot()` and `to_control()`
    where the package that they need is not installed.

    >>> from faultspace.numeric import StateSpaceModel
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]])
    >>> model.is_stable, model.simulate([1.0, 0.0, 0.0]).ravel().tolist()
    (True, [0.0, 1.0, 0.5])
    """

    A: Array
    B: Array
    C: Array
    D: Array

    def __init__(self, A: ArrayLike, B: ArrayLike, C: ArrayLike, D: ArrayLike) -> None:
        for name, values in zip("ABCD", (A, B, C, D), strict=True):
            object.__setattr__(self, name, _matrix(values, name))
        wanted = {"A": (self.n, self.n), "B": (self.n, self.n_u), "C": (self.p, self.n), "D": (self.p, self.n_u)}
        for name, shape in wanted.items():
            if getattr(self, name).shape != shape:
                raise InvalidData(
                    f"{name} has shape {getattr(self, name).shape}; with n = {self.n} (rows of A), n_u = {self.n_u} (columns of D) and "
                    f"p = {self.p} (rows of D) it must be {shape}"
                )

    @property
    def n(self) -> int:
        """Return the number of states."""
        return int(self.A.shape[0])

    @property
    def n_u(self) -> int:
        """Return the number of inputs."""
        return int(self.D.shape[1])

    @property
    def p(self) -> int:
        """Return the number of outputs."""
        return int(self.D.shape[0])

    @property
    def poles(self) -> NDArray[np.complex128]:
        """Return the eigenvalues of A by falling modulus, then falling real and imaginary part."""
        values = np.linalg.eigvals(self.A).astype(np.complex128)
        return values[np.lexsort((-values.imag, -values.real, -np.abs(values)))]

    @property
    def is_stable(self) -> bool:
        """Say whether every pole lies strictly inside the unit circle."""
        return bool(np.all(np.abs(self.poles) < 1))

    @property
    def title(self) -> str:
        """Return what the model is, on one short line."""
        stability = "stable" if self.is_stable else "NOT stable"
        return f"state-space model of order {self.n}, {counted(self.n_u, 'input')}, {counted(self.p, 'output')}, {stability}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the poles and the matrices by rows; of a matrix too wide for a line its shape alone."""
        yield "poles", ", ".join(f"{pole:.4g}" if pole.imag else f"{pole.real:.4g}" for pole in self.poles) or "none"
        yield "moduli of the poles", ", ".join(f"{abs(pole):.4g}" for pole in self.poles) or "none"
        for name in "ABCD":
            matrix = getattr(self, name)
            if not matrix.size or matrix.shape[1] > WIDEST:
                yield f"{name}", f"{matrix.shape[0]} x {matrix.shape[1]}"
                continue
            yield from ((name if not i else "", "".join(f"{entry:>10.3g}" for entry in row)) for i, row in enumerate(matrix))

    def plot(self, ax: Any = None) -> Any:
        """Draw the poles and the unit circle into the matplotlib axes `ax`, new ones where None are given, and return them. Raises
        ImportError without matplotlib."""
        return plot_zeros_and_poles(self.poles, ax=ax)

    def markov(self, count: int) -> Array:
        """Return D, CB, CAB, ..., as an array (count, p, n_u), count >= 0."""
        values = np.empty((max(count, 0), self.p, self.n_u))
        state = self.B
        for k in range(len(values)):
            values[k] = self.D if k == 0 else self.C @ state
            state = self.A @ state if k > 0 else state
        return values

    @one_thread()
    def simulate(self, u: ArrayLike, x0: ArrayLike | None = None) -> Array:
        """Return y (N, p) from u (N, n_u) and the state x0 (n,) at the first sample, zero unless given. An unstable model may overflow to
        inf."""
        inputs = signal(u, "u")
        if inputs.shape[1] != self.n_u:
            hint = "; it looks transposed: pass u.T" if inputs.shape[0] == self.n_u else ""
            raise InvalidData(
                f"u has {counted(inputs.shape[1], 'column')}, the model {counted(self.n_u, 'input')}: one column an input is needed{hint}"
            )
        simulator = Simulator(self, x0)
        y = np.empty((len(inputs), self.p))
        for first in range(0, len(inputs), PIECE):
            y[first : first + PIECE] = simulator.respond(inputs[first : first + PIECE])
        return y

    def to_control(self, *, dt: float | None = None, inputs: Sequence[str] | None = None, outputs: Sequence[str] | None = None) -> Any:
        """Return the model as control.StateSpace, with the names of its channels where they are given.

        `dt` is the sample time in seconds; where it is None, the model is of discrete time with a time unstated (control's dt=True). The
        data of python-control are channel-major. Raises ImportError where it is not installed.
        """
        try:
            control = import_module("control")
        except ImportError:
            raise ImportError("to_control() needs python-control: pip install control") from None
        names = {"inputs": None if inputs is None else list(inputs), "outputs": None if outputs is None else list(outputs)}
        return control.ss(self.A, self.B, self.C, self.D, True if dt is None else dt, **names)

    def to_scipy(self, *, dt: float | None = None) -> Any:
        """Return the model as scipy.signal.dlti with the sample time `dt` in seconds, 1 where it is None."""
        from scipy.signal import dlti

        return dlti(self.A, self.B, self.C, self.D, dt=1 if dt is None else dt)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict {"format": "faultspace-model/1", "n", "n_u", "p", "A", "B", "C", "D"}; floats come back bit for bit."""
        sizes = {"format": FORMAT, "n": self.n, "n_u": self.n_u, "p": self.p}
        return sizes | {name: getattr(self, name).tolist() for name in "ABCD"}

    @classmethod
    def from_json(cls, record: Mapping[str, Any]) -> Self:
        """Return the model of `to_json`. InvalidData for another format, missing keys or shapes that do not fit."""
        if not isinstance(record, Mapping) or record.get("format") != FORMAT:
            got = record.get("format") if isinstance(record, Mapping) else type(record).__name__
            raise InvalidData(f'a model has "format": "{FORMAT}" (got {got!r})')
        missing = [name for name in ("n", "n_u", "p", *"ABCD") if name not in record]
        if missing:
            raise InvalidData(f"the model lacks {', '.join(missing)}; a model has n, n_u, p, A, B, C, D")
        n, n_u, p = (record[name] for name in ("n", "n_u", "p"))
        shapes = {"A": (n, n), "B": (n, n_u), "C": (p, n), "D": (p, n_u)}
        try:
            matrices = {name: np.array(record[name], dtype=np.float64).reshape(shape) for name, shape in shapes.items()}
        except (TypeError, ValueError, OverflowError) as error:
            raise InvalidData(f"the model's matrices do not fit n = {n}, n_u = {n_u}, p = {p}: {error}") from None
        return cls(**matrices)


class Simulator:
    """The simulator gives the response of a model to inputs that come in pieces; `state` is the state at the next sample.

    It takes BLOCK samples at a time: Y = O x + T u with the block's observability matrix O and Toeplitz matrix T, x := A^b x + [A^(b-1)B
    ... B] u.
    """

    def __init__(self, model: StateSpaceModel, x0: ArrayLike | None = None) -> None:
        start = np.zeros(model.n) if x0 is None else np.array(x0, dtype=np.float64)
        if start.shape != (model.n,) or not np.all(np.isfinite(start)):
            raise InvalidData(f"x0 must be {model.n} finite numbers, one a state (got shape {start.shape})")
        self.state: Array = start
        self._model = model
        with np.errstate(over="ignore", invalid="ignore"):
            self._free = observability_matrix(model.A, model.C, BLOCK)
            self._forced = lower_toeplitz(model.markov(BLOCK))
            self._reach = observability_matrix(model.A.T, model.B.T, BLOCK)
            self._step = np.linalg.matrix_power(model.A, BLOCK)

    def respond(self, u: Array) -> Array:
        """Return y (T, p) for the next samples u (T, n_u)."""
        model, whole = self._model, len(u) // BLOCK
        y = np.empty((len(u), model.p))
        with np.errstate(over="ignore", invalid="ignore"):
            if whole:
                blocks = np.ascontiguousarray(u[: whole * BLOCK]).reshape(whole, BLOCK * model.n_u)
                # _reach holds B^T, (AB)^T, ...: the last sample of a block meets B.
                backwards = np.ascontiguousarray(u[: whole * BLOCK].reshape(whole, BLOCK, model.n_u)[:, ::-1]).reshape(whole, -1)
                pushes = backwards @ self._reach
                states = np.empty((whole, model.n))
                for number in range(whole):
                    states[number] = self.state
                    self.state = self._step @ self.state + pushes[number]
                y[: whole * BLOCK] = (blocks @ self._forced.T + states @ self._free.T).reshape(-1, model.p)
            for k in range(whole * BLOCK, len(u)):
                y[k] = model.C @ self.state + model.D @ u[k]
                self.state = model.A @ self.state + model.B @ u[k]
        return y


def lower_toeplitz(markov: Array) -> Array:
    """Return the lower block-triangular Toeplitz matrix T_s (s p, s n_u) of s Markov parameters."""
    count, p, n_u = markov.shape
    blocks = np.zeros((count, p, count, n_u))
    for column in range(count):
        blocks[column:, :, column] = markov[: count - column]
    return blocks.reshape(count * p, count * n_u)


class Identified:
    """A result of identification shows the matrices of its `model`, and the first of its `initial_states`, as its own."""

    model: StateSpaceModel
    initial_states: tuple[Array, ...]

    @property
    def A(self) -> Array:
        """Return the state matrix (n, n)."""
        return self.model.A

    @property
    def B(self) -> Array:
        """Return the input matrix (n, n_u)."""
        return self.model.B

    @property
    def C(self) -> Array:
        """Return the output matrix (p, n)."""
        return self.model.C

    @property
    def D(self) -> Array:
        """Return the direct feedthrough (p, n_u)."""
        return self.model.D

    @property
    def x0(self) -> Array | None:
        """Return the state (n,) at the first sample of the first experiment."""
        return self.initial_states[0] if self.initial_states else None

    def to_control(self) -> Any:
        """Return the model as control.StateSpace. Raises ImportError without python-control."""
        return self.model.to_control()

    def to_scipy(self) -> Any:
        """Return the model as scipy.signal.dlti."""
        return self.model.to_scipy()
