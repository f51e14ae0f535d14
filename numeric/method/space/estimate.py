"""This is what every estimate of the fault space answers, and what a kernel row asks of a fault column.

    FaultSpaceEstimate   basis of the columns [f; g], its dimension, how it was found, whether it means anything and why
    SpaceUncertainty     the estimate's error, to first order in each valley of the likelihood: an angle, a distance
    SpaceOfValley        the space in one valley, with its probability
    everything           the answer where nothing can be said: the whole space, not meaningful
    kernel_conditions    for rows N_0 .. N_(s-1) at once: the conditions [X_(k+1), N_k] z = 0, X_k = N_k C + X_(k+1) A
    condition_maps       the same as linear maps of the row, for carrying the row's uncertainty over

z = [f; g] solves N T_s(z) = 0 with all block columns iff it meets the s conditions of every row N; the Horner
recursion gives them for q rows in time q s n (n + p), where building T_s(z) for every unit column costs q s^2 p (n +
p). Source: [G25] problem (11).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, or_undecided
from ...data.plain import by_name, plain
from ..plotting import plot_conditions

DRAWS = 4000
_SEED = 20250519


@dataclass(frozen=True, eq=False)
class SpaceOfValley:
    """The true space is near the span of `basis` (n + p, n_z) with probability `weight`, off it by `root` (q, n + p, n_z) times standard
    normal numbers."""

    weight: float
    basis: Array
    root: Array


@dataclass(frozen=True, eq=False, repr=False)
class SpaceUncertainty(Shown):
    """A fault space may be off by this linear map of standard normal numbers, which is honest while errors are small [MN89].

    `root` has the shape (q, n + p, n_z): to first order the orthonormal basis (n + p, n_z) of the space is off its span by the sum of
    root[i] times standard normal numbers. Where the likelihood of a model has several valleys, `valleys` are the spaces in all of them,
    which may lie far from one another, the estimate's own one first; it is empty where only one is known. Every call gives the same
    figures. Raises InvalidData for a confidence outside (0, 1).

    >>> import numpy as np
    >>> from faultspace.numeric import SpaceUncertainty
    >>> one = SpaceUncertainty(np.array([[[0.0], [0.01]]]))
    >>> round(one.angle(0.95), 4), round(one.distance(0.95), 4)
    (0.0194, 0.0124)
    """

    root: Array
    valleys: tuple[SpaceOfValley, ...] = ()

    @property
    def title(self) -> str:
        """Return what it is about, on one short line."""
        return f"a fault space is within {self.angle():.2g} rad of the true one with probability 0.95, {self.order}"

    @property
    def order(self) -> str:
        """Return how far the figures can be trusted, in words."""
        count = len(self.valleys)
        return f"over {count} valleys of the likelihood" if count > 1 else "to first order"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the angle and the distance that the error stays below, each with its probability, and the valleys where there are more."""
        yield "angle, probability 0.95", f"{self.angle():.4g} rad"
        yield "distance, probability 0.5", f"{self.distance():.4g}, of 1 at most"
        if len(self.valleys) > 1:
            weights = ", ".join(f"{valley.weight:.2g}" for valley in self.valleys)
            yield "valleys of the likelihood", f"{len(self.valleys)} with probabilities {weights}, that of the estimate first"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: the linear map `root`, the valleys, and the angle and the distance that `summary` tells."""
        valleys = [{"weight": one.weight, "basis": plain(one.basis), "root": plain(one.root)} for one in self.valleys]
        return {"root": plain(self.root), "valleys": valleys, "angle": self.angle(), "distance": self.distance()}

    def angle(self, confidence: float = 0.95) -> float:
        """Return the radians that the largest principal angle to the true space stays below with this probability."""
        return self._quantile(confidence, lambda angles: angles[:, 0])

    def distance(self, confidence: float = 0.5) -> float:
        """Return what the two-sided distance of the spaces, between 0 and 1, stays below with this probability."""
        return self._quantile(confidence, lambda angles: np.sqrt(np.mean(angles**2, axis=1)) / (np.pi / 2))

    def _quantile(self, confidence: float, size: Callable[[Array], Array]) -> float:
        if not 0 < confidence < 1:
            raise InvalidData(f"confidence: got {confidence}; a number between 0 and 1 is needed, for example 0.95")
        if 0 in self.root.shape:
            return 0.0
        return float(np.quantile(size(self._angles()), confidence))

    def _angles(self) -> Array:
        """Return the principal angles (DRAWS, n_z) to drawn spaces, descending."""
        rng = np.random.default_rng(_SEED)
        if len(self.valleys) < 2:
            normal = rng.standard_normal((DRAWS, len(self.root)))
            return np.asarray(np.arctan(np.linalg.svd(np.tensordot(normal, self.root, axes=1), compute_uv=False)), dtype=np.float64)
        Q = self.valleys[0].basis
        # As many draws as the weights say, and the whole of them DRAWS.
        counts = np.diff(np.rint(DRAWS * np.cumsum([0.0, *(valley.weight for valley in self.valleys)])).astype(int))
        angles = []
        for valley, count in zip(self.valleys, counts, strict=True):
            normal = rng.standard_normal((count, len(valley.root)))
            drawn = np.linalg.qr(valley.basis + np.tensordot(normal, valley.root, axes=1))[0]
            sines = np.linalg.svd(drawn - Q @ (Q.T @ drawn), compute_uv=False)
            angles.append(np.arcsin(np.minimum(sines, 1.0)))
        return np.concatenate(angles)


@dataclass(frozen=True, repr=False)
class FaultSpaceEstimate(Shown):
    """The columns [f; g] that explain no more than the residual shows.

    basis            (n + p, n_z), orthonormal columns
    n_z              its columns, n_v + zeta for a left-invertible fault system; where `decided` is False the likeliest
                     number, not a finding
    n                number of states: F are the first n rows, G the others
    n_v              number of faults, given or found (None: undecided)
    lag              largest degree of a kernel row, found or expected (None: unknown); the window must be longer
    block_rows       s, samples of the window
    singular_values  of the conditions, descending: the last n_z are the ones taken for zero
    equations        number of independent conditions found
    unknowns         n + p
    margin           ratio at the weakest decision that n_z rests on; near 1 it was a toss-up
    decided          whether that margin is convincing and independent counts of n_z agree
    meaningful       False where the answer says nothing about the faults; `reason` says why
    finding          what was found, or why nothing was
    doubts           why it is undecided, beside that; `reason` has both in words
    error_bound      bound on the sine of the angle to the true space from rounding and conditioning; None with noise
    method           "noise-free", "likelihood" or "kernel rows" ("none" where no equation was found)
    uncertainty      of the likelihood form: the angle to the true space with a confidence, n_z taken as right; else None

    f is in the units of the state and g in those of y, each for a fault in units of its own. Raises nothing itself; `fault_space`,
    which makes it, raises InvalidData. Source: [G25] problem (11).

    >>> import numpy as np
    >>> from faultspace.numeric import fault_space
    >>> v = np.random.default_rng(1).standard_normal((100, 1))
    >>> fault_space(np.hstack([v, 2 * v]), [[0.5]], [[1.0], [0.0]])
    <FaultSpaceEstimate: fault space of dimension 1 (undecided), n_v 1>
    """

    basis: Array
    n_z: int
    n: int
    n_v: int | None
    lag: int | None
    block_rows: int
    singular_values: Array
    equations: int
    unknowns: int
    margin: float
    decided: bool
    meaningful: bool
    finding: str
    error_bound: float | None
    method: str
    uncertainty: SpaceUncertainty | None = None
    doubts: tuple[str, ...] = ()

    @property
    def why(self) -> str:
        """Return the doubts and what was found."""
        return "; ".join((*self.doubts, self.finding))

    @property
    def reason(self) -> str:
        """Return the same, and first of all whether it is undecided."""
        return f"undecided: {self.why}" if self.doubts or (self.meaningful and not self.decided) else self.why

    @property
    def F(self) -> Array:
        """Return Fhat, n x n_z."""
        return self.basis[: self.n]

    @property
    def G(self) -> Array:
        """Return Ghat, p x n_z."""
        return self.basis[self.n :]

    @property
    def title(self) -> str:
        """Return what the estimate is, on one short line."""
        if not self.meaningful:
            return "fault space: none that means anything"
        return f"fault space of dimension {self.n_z}{'' if self.decided else ' (undecided)'}, n_v {or_undecided(self.n_v)}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value."""
        yield "why", self.reason
        yield "number of faults n_v", or_undecided(self.n_v)
        yield "zeros, finite and infinite", or_undecided(self.zeta)
        yield "equations", f"{self.equations} for the {self.unknowns} entries of a column [f; g]"
        yield "method", f"{self.method}, windows of {self.block_rows} samples"
        if self.error_bound is not None:
            yield "sine of the angle to the true space", f"at most {self.error_bound:.2g}, from rounding"
        if self.uncertainty is not None:
            yield (
                "angle to the true space",
                f"below {np.degrees(self.uncertainty.angle()):.2g} degrees with probability 0.95, {self.uncertainty.order}",
            )

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict; basis, F and G are null where the estimate means nothing."""
        known = by_name(self, "n", "n_v", "n_z", "zeta", "equations", "unknowns", "meaningful", "decided", "reason", "block_rows")
        known |= {"p": len(self.basis) - self.n} | by_name(self, "basis", "F", "G")
        return known if self.meaningful else known | dict.fromkeys(("n_z", "basis", "F", "G"))

    def plot(self, ax: Any = None) -> Any:
        """Draw the singular values of the conditions, those taken for zero open, into the matplotlib axes `ax`, new ones where None are
        given, and return them. Raises InvalidData where there is no condition, and ImportError without matplotlib."""
        values, others = self.singular_values, f"taken for zero: dimension {self.n_z}"
        if self.method in ("likelihood", "kernel rows"):
            # Rows of a fit have so many solutions by their degrees: that these values are zero is no evidence, and they are not drawn.
            values, others = values[: self.equations], f"zero by the fit, not drawn: dimension {self.n_z}"
        return plot_conditions(values, self.equations, others=others, ax=ax)

    @property
    def zeta(self) -> int | None:
        """Return the number of zeros, finite and infinite, of a left-invertible fault system; None where the data cannot tell:
        n_v unknown, the answer without meaning, or n_z undecided.
        """
        return None if self.n_v is None or not self.meaningful or not self.decided else self.n_z - self.n_v


def everything(n: int, p: int, n_v: int | None, block_rows: int, reason: str, *, lag: int | None = None) -> FaultSpaceEstimate:
    """Return the estimate without a single equation: every column is a solution, which means nothing."""
    return FaultSpaceEstimate(np.eye(n + p), n + p, n, n_v, lag, block_rows, np.zeros(0), 0, n + p, 1.0, False, False, reason, None, "none")


def kernel_conditions(rows: Array, A: Array, C: Array) -> Array:
    """Return conditions (q, s, n + p) of the kernel rows (q, s, p), row k holding [X_(k+1), N_k], for A (n, n), C (p, n)."""
    q, s, p = rows.shape
    n = A.shape[0]
    conditions = np.zeros((q, s, n + p))
    conditions[:, :, n:] = rows
    X = np.zeros((q, n))
    for k in reversed(range(s)):
        conditions[:, k, :n] = X
        X = rows[:, k] @ C + X @ A
    return conditions


def condition_maps(A: Array, C: Array, s: int) -> Array:
    """Return (s, p s, n + p): condition k of a row g (p s,) is g @ maps[k]. Column j of maps[k] is block column k of
    T_s(e_j).
    """
    p = C.shape[0]
    return kernel_conditions(np.eye(p * s).reshape(p * s, s, p), A, C).transpose(1, 0, 2)


def orthonormal(columns: Array) -> Array:
    """Return orthonormal columns with the span of independent `columns`."""
    return np.asarray(np.linalg.qr(columns)[0]) if columns.shape[1] else columns
