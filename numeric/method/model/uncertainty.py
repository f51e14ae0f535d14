"""Compute a model's uncertainty as that of what does not depend on the state basis: Markov parameters, transfer function, poles.

A Fisher information J of T = [[A, B], [C, D]] is singular along the gauge, and only there for a minimal, excited model. With Q across the
gauge and Q' J Q = R R', the covariance of an invariant with Jacobian H (delta method, [L99]) is H Q (R R')^-1 Q' H', whatever Q.

Uncertainty        a model with its covariance off the gauge
uncertainty_of     from an information matrix
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigh

from ....base.arrays import Array
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import plain
from ..plotting import plot_uncertain_poles
from .invariants import markov_jacobian, off_gauge, pole_jacobian, system_matrix, transfer_jacobian
from .models import StateSpaceModel

ComplexArray = NDArray[np.complex128]
FIRST = 6  # Markov parameters that the sheet tells of
COUNT = 20  # Markov parameters that the JSON form holds


@dataclass(frozen=True, eq=False, repr=False)
class Uncertainty(Shown):
    """Standard deviations say how sure a model is, of what does not depend on the basis of the state, by the delta method [L99].

    `root` has the shape (K, K - n^2), and root @ root.T is the covariance of the entries of T = [[A, B], [C, D]] in row order, in the
    gauge orthogonal to changes of basis. Standard deviations are in the units of what they belong to. Those of complex numbers are
    returned as complex numbers: the real part is the deviation of the real part, the imaginary part that of the imaginary part. Look at
    `poles()` first, then at `transfer()` at the frequencies that matter. Raises ImportError in `plot()` without
    matplotlib, and nothing else.

    >>> from faultspace.numeric import Spectra, StateSpaceModel, cramer_rao
    >>> from faultspace.numeric.study.driving_spectra import white
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]])
    >>> least = cramer_rao(model, Spectra(white([[1.0]]), white([[0.01]])), 400)
    >>> least.markov(2).ravel().round(5).tolist(), least.poles().real.round(5).tolist()
    ([0.005, 0.00484], [0.00325])
    """

    model: StateSpaceModel
    root: Array

    @property
    def title(self) -> str:
        """Return what it is about, on one short line."""
        return f"standard deviations of a model of order {self.model.n}, by {counted(self.root.shape[1], 'free parameter')}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield every pole with its deviation, and the sizes of the first Markov parameters with theirs, as Frobenius norms."""
        for k, (pole, deviation) in enumerate(zip(self.model.poles, self.poles(), strict=True)):
            yield f"pole {k + 1}", _with_deviation(pole, deviation)
        sizes, deviations = (np.linalg.norm(part, axis=(1, 2)) for part in (self.model.markov(FIRST), self.markov(FIRST)))
        for k, (size, deviation) in enumerate(zip(sizes, deviations, strict=True)):
            yield f"Markov parameter {k}, size", f"{size:.4g} ± {deviation:.2g}"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: the model, `root`, poles and Markov parameters with their deviations; complex numbers are pairs, and
        null stands for what is not finite."""
        return {
            "model": self.model.to_json(),
            "root": plain(self.root),
            "poles": plain(self.model.poles),
            "pole_deviations": plain(self.poles()),
            "markov": plain(self.model.markov(COUNT)),
            "markov_deviations": plain(self.markov(COUNT)),
        }

    def plot(self, ax: Any = None, *, zeros: ArrayLike = ()) -> Any:
        """Draw the poles, each with the region that holds it with probability 0.95 to first order, and `zeros` where some are given, into
        the matplotlib axes `ax`, new ones where None are given, and return them. Raises ImportError without matplotlib."""
        return plot_uncertain_poles(self.model.poles, self._pole_roots(), zeros=zeros, ax=ax)

    def _pole_roots(self) -> ComplexArray:
        """Return the poles' errors (n, K - n^2) as linear maps of standard normal numbers; not finite where a pole is multiple."""
        with np.errstate(invalid="ignore"):
            return np.asarray(pole_jacobian(system_matrix(self.model), self.model.n)[1] @ self.root)

    @one_thread()
    def markov(self, count: int) -> Array:
        """Return the standard deviations (count, p, n_u) of D, CB, CAB, .."""
        spread = markov_jacobian(system_matrix(self.model), self.model.n, count) @ self.root
        return np.asarray(np.linalg.norm(spread, axis=1).reshape(count, self.model.p, self.model.n_u))

    @one_thread()
    def transfer(self, angles: ArrayLike) -> ComplexArray:
        """Return the standard deviations (M, p, n_u) of G(exp(i angle)), angles in radians a sample."""
        points = np.atleast_1d(np.asarray(angles, dtype=np.float64))
        spread = transfer_jacobian(system_matrix(self.model), self.model.n, points) @ self.root
        return _parts(spread).reshape(len(points), self.model.p, self.model.n_u)

    @one_thread()
    def poles(self) -> ComplexArray:
        """Return the standard deviations (n,) of the poles, in the order of `model.poles`.

        They are of first order, which says little where they come near the distances between poles. A real pole has none across the real
        axis, and a multiple one has an infinite or huge one.
        """
        deviations = _parts(self._pole_roots())
        return np.where(np.isnan(deviations), np.inf, deviations)


def _parts(spread: ComplexArray) -> ComplexArray:
    return np.asarray(np.linalg.norm(spread.real, axis=1) + 1j * np.linalg.norm(spread.imag, axis=1))


def _with_deviation(value: complex, deviation: complex) -> str:
    """Return a number and its deviation as text, of a real one the real parts alone."""
    return f"{value:.4g} ± {deviation:.2g}" if value.imag else f"{value.real:.4g} ± {deviation.real:.2g}"


def uncertainty_of(model: StateSpaceModel, information: Array) -> Uncertainty:
    """Return the uncertainty that goes with the Fisher information (K, K) of T.

    A direction that is not determined gets the deviation that goes with rounding, which is huge.
    """
    across = off_gauge(system_matrix(model), model.n)
    values, vectors = eigh(across.T @ information @ across)
    rounding = np.finfo(np.float64)
    level = max(len(values) * float(rounding.eps) * float(np.max(values, initial=0.0)), float(rounding.tiny))
    return Uncertainty(model, across @ vectors / np.sqrt(np.maximum(values, level)))
