"""This counts how many faults stand out of what a healthy record shows, where they act, and their signal.

`fault_dimension` knows nothing but the residual, so what it cannot tell from noise it leaves undecided. Who has a record from before the
fault knows more: noise and model error, their sizes and colours. At each frequency

    covariance of r = that of the healthy residual + H(f) S_v(f) H(f)*,  rank of the second term at most n_v, and n_v at almost all f
                      for faults of full spectrum; H = C (zI - A)^-1 F + G

Count. l_1 >= l_2 >= ..: roots of the tapered covariance of the record against the healthy one, whitened (`healthy_model.py`). With j
faults, on the p - j dimensional space of combinations w with w* H = 0 both covariances are those of noise, and by Courant and Fischer
l_(j+1) is at most the largest root there. That has an exact law (`largest_root`) whatever the noise; so a threshold at its quantile is
exceeded with the stated chance at most, shared among the frequencies by Bonferroni's inequality and raised by the strain that the
healthy record showed there.

The form of the threshold is derived. What it does not tell, the least number of tapers and the rule for turning directions below with
its share TURNED, is judged by `benchmarks/constants.py healthy`: of 320 records with 0 to 3 faults (seed 700100) 217 are answered
rightly and 2 wrongly, and no factor from a half to two of either is better. The default level is a promise, and no matter of data; it
was .01 at first, until a stretch of measured data without a fault came 2 % above an early form of the threshold.

    n_v             the largest count over the frequencies; 0: none is seen. By chance alone it is too large with at most the probability
                    `level`, but a direction that turns may count twice all the same, see below
    turning         H(f) turns within the width of a centre, and a strong turning direction may look like two. With half the tapers, so half
                    the width, a turn keeps a quarter of its excess over chance; the last of j equal faults keeps, for fewer tapers T, the
                    share (1 - (2 j/T)^(1/2))^2 / (1 - (j/T)^(1/2))^2, the edges of Marchenko and Pastur. Below the geometric mean of
                    the two the count is taken again with half the tapers, twice as many centres; if that never ends n_v is None.
                    A rule of thumb: of 120 simulated residuals with one fault it let 6 be counted as two (all counts decided, level .001)
    undecided too   as many faults as outputs: a new noise level in every channel would look the same
    visible         largest root that chance explains: a fault adding less than that times the noise, in its best direction, is not seen

One fault's direction. [F; G] = z maximises the sum over frequencies of |w* x|^2 / (w* w), w = Phi^(-1/2) (H z)(f), x the whitened
transform: maximum likelihood for an arbitrary unknown signal, which the quotient has eliminated. The signal is w* x / (w* w), shrunk at
each frequency by the share that noise explains. How loud noise is in that direction is measured where it was not learnt: each half of the
healthy record is whitened by the other's predictor and covariances. Taken as learnt, the drift of measured data at the lowest frequencies
passed for signal: of an injected fault at 0.3 % of a measured record the signal then correlated with the truth by .64 to .88 (four
draws), and with the level measured by .78 to .94.

    fault_dimension_against_healthy   n_v with its evidence
    fault_direction_against_healthy   z and the signal of one fault, for known A, C or purely at the outputs
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy  # its folders are loaded when they are first used
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name, plain
from ...method.plotting import plot_fault_signal, plot_roots
from .healthy_model import FEW_TAPERS, HEALTHY_LEVEL, HealthyReference, Spectra, covering_spectra

Complex = NDArray[np.complex128]

TURNED = 0.25
"""This is the share of its excess that a turning direction keeps at half the width, since it grows with the square of the width. That
halves are compared at all, and against the geometric mean, is judged with it (head of the module)."""


@dataclass(frozen=True, eq=False, repr=False)
class FaultsAgainstHealthy(Shown):
    """How many faults stand out of what the healthy record shows, with the evidence.

    `n_v` is the count (None where it is undecided), and `reason` says why. `roots` and `thresholds` of shape (centres, p) belong to the
    `frequencies` (centres,) in cycles a sample, and `counts` (centres,) are the roots above. A fault of less than `visible` times its noise
    would not be seen, and `kept` is the share of its excess that the last counted root keeps at half the width. Look at `n_v` first; where
    it is 0, at `visible`: smaller faults may be there. Raises nothing itself, but ImportError in `plot()` without matplotlib;
    `fault_dimension_against_healthy`, which makes it, raises InvalidData. Sources: [K64], [RS95].

    >>> import numpy as np
    >>> from faultspace.numeric import fault_dimension_against_healthy, healthy_reference
    >>> noise = np.random.default_rng(1).standard_normal((2000, 3))
    >>> found = fault_dimension_against_healthy(noise[1000:], healthy_reference(noise[:1000]))
    >>> found.n_v, found.at_least, found.decided
    (0, 0, True)
    """

    n_v: int | None
    reason: str
    frequencies: Array
    roots: Array
    thresholds: Array
    counts: NDArray[np.int_]
    visible: float
    kept: float | None

    @property
    def at_least(self) -> int:
        """Return `n_v` where it is decided; else 1 where anything stands out: that there is a fault is no matter of turning."""
        return min(1, int(self.counts.max())) if self.n_v is None else self.n_v

    @property
    def decided(self) -> bool:
        """Say whether there is an answer."""
        return self.n_v is not None

    @property
    def title(self) -> str:
        """Return the answer, on one short line."""
        answer = f"undecided, at least {self.at_least}" if self.n_v is None else f"{self.n_v}"
        return f"number of faults beyond the healthy record: {answer}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the reason, what would be seen, and the loudest frequency."""
        yield "why", self.reason
        yield "faults seen from", f"{self.visible:.3g} times the noise on"
        loudest = int(np.argmax(self.roots[:, 0] / self.thresholds[:, 0]))
        times = self.roots[loudest, 0] / self.thresholds[loudest, 0]
        yield "loudest frequency", f"{self.frequencies[loudest]:.4g} cycles a sample, {times:.3g} times its threshold"
        for count in range(int(self.counts.max()), 0, -1):
            yield f"frequencies with {count} above", f"{int(np.sum(self.counts == count))} of {len(self.counts)}"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of the answer, its reason and everything by frequency."""
        return by_name(self, "n_v", "at_least", "reason", "visible", "kept", "frequencies", "roots", "thresholds", "counts")

    def plot(self, ax: Any = None) -> Any:
        """Draw the largest roots and their thresholds by frequency into the matplotlib axes `ax`, new ones where None are given, and
        return them. Raises ImportError without matplotlib."""
        return plot_roots(self.frequencies, self.roots, self.thresholds, self.n_v, ax=ax)


@dataclass(frozen=True, eq=False, repr=False)
class FaultDirection(Shown):
    """The direction of one fault and its signal.

    `z` = [F; G] (n + p,) has unit norm, and F is empty without A and C. `signal` (N,) is zero before the first whitened sample and is
    shrunk at each frequency by the share that noise explains. `strength` is the mean of |w* x|^2 / (w* w), which is one for noise alone.
    Look at `strength` first: near one there is nothing but noise in the direction. Raises nothing itself, but ImportError in `plot()`
    without matplotlib; `fault_direction_against_healthy`, which makes it, raises InvalidData. Source: [RS95] for the tapers.

    >>> import numpy as np
    >>> from faultspace.numeric import fault_direction_against_healthy, healthy_reference
    >>> noise = np.random.default_rng(1).standard_normal((2000, 3))
    >>> noise[1000:, 1] += 5 * np.random.default_rng(2).standard_normal(1000)
    >>> found = fault_direction_against_healthy(noise[1000:], healthy_reference(noise[:1000]))
    >>> found.z.shape, found.signal.shape, found.strength > 10
    ((3,), (1000,), True)
    """

    z: Array
    signal: Array
    strength: float

    @property
    def title(self) -> str:
        """Return what it is, on one short line."""
        return f"direction of a fault, {self.strength:.3g} times the power of noise, {counted(len(self.signal), 'sample')}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the direction and the size of the signal."""
        yield "z = [F; G]", ", ".join(f"{entry:.4g}" for entry in self.z)
        yield "root mean square of the signal", f"{float(np.sqrt(np.mean(self.signal**2))):.4g}"
        yield "largest sample", f"{float(np.max(np.abs(self.signal))):.4g}, number {int(np.argmax(np.abs(self.signal)))}"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of everything but the samples of the signal."""
        return {"z": plain(self.z), "strength": plain(self.strength), "samples": len(self.signal)}

    def plot(self, ax: Any = None) -> Any:
        """Draw the signal into the matplotlib axes `ax`, new ones where None are given, and return them. Raises ImportError without
        matplotlib."""
        return plot_fault_signal(self.signal[:, None], ax=ax)


@one_thread()
def fault_dimension_against_healthy(
    r: ArrayLike, healthy: HealthyReference, *, u: ArrayLike | None = None, level: float = HEALTHY_LEVEL
) -> FaultsAgainstHealthy:
    """Count the faults in a residual that the healthy record does not explain.

    Source: [K64], [RS95].

    Parameters
    ----------
    r : array_like, (N, p)
        N samples in the units of the healthy record.
    healthy : HealthyReference
    u : array_like (N, n_u), optional
        Needed where the reference was learnt with inputs.
    level : float in (0, 1)
        Probability of counting too many by chance, turning directions apart.

    Returns
    -------
    FaultsAgainstHealthy
        `n_v`, None where it is undecided, and `at_least`.

    Raises
    ------
    InvalidData
        Where r does not fit the reference.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import fault_dimension_against_healthy, healthy_reference
    >>> noise = np.random.default_rng(1).standard_normal((2000, 3))
    >>> noise[1000:, 1] += 5 * np.random.default_rng(2).standard_normal(1000)
    >>> fault_dimension_against_healthy(noise[1000:], healthy_reference(noise[:1000])).n_v
    1
    """
    if not 0.0 < level < 1.0:
        raise InvalidData(f"level: got {level}; needed a chance strictly between 0 and 1, such as 0.001")
    e = healthy.innovations(r, u)[0]
    for tapers in healthy.taper_numbers:
        record = healthy.spectra(r, u, tapers=tapers)
        roots, thresholds = healthy.roots(record), healthy.thresholds(record, level / len(healthy.taper_numbers))
        counts = np.cumprod(roots > thresholds, axis=1).sum(axis=1)
        found = int(counts.max())
        # The forecast's error is left in here: dividing it out shrinks a strong direction more than what its turn adds.
        whole = covering_spectra(e, tapers)
        kept = _kept_at_half_width(healthy, whole, counts == found, found) if 1 < found < healthy.p else None
        needed = _enough_kept(found, tapers)
        if kept is None or kept >= needed:
            break
    visible = float(np.median(thresholds[:, 0]))
    places = (
        f"{counted(found, 'direction')} beyond the healthy record at {int(np.sum(counts == found))} of {len(counts)} frequencies; "
        f"by chance alone more than there are with probability {level:g} at most; one whose direction turns may count twice"
    )
    n_v: int | None = found
    if found == 0:
        reason = f"nothing goes beyond the healthy record; a fault of less than {visible:.1f} times its noise would not be seen"
    elif found == healthy.p:
        n_v, reason = (
            None,
            f"every direction of {counted(found, 'output')} is louder than in the healthy record: {counted(found, 'fault')}, or more noise",
        )
    elif kept is not None and kept < needed:
        n_v, reason = None, f"{places}; but at half the width the last keeps {kept:.2f} of its excess: a fault whose direction turns?"
    else:
        reason = places
    return FaultsAgainstHealthy(n_v, reason, record.frequencies, roots, thresholds, counts, visible, kept)


def _enough_kept(count: int, tapers: int) -> float:
    """Return the share of its excess at half the width from which on a direction is no turn; infinite where tapers are too few to tell."""
    if tapers < 4 * count:
        return np.inf
    equal = (1.0 - np.sqrt(2.0 * count / tapers)) ** 2 / (1.0 - np.sqrt(count / tapers)) ** 2
    return float(np.sqrt(TURNED * equal))


def _kept_at_half_width(healthy: HealthyReference, record: Spectra, where: NDArray[np.bool_], count: int) -> float:
    """Return the median over the centres `where` of the excess of root number `count` over its median by chance, half the tapers against
    all."""
    wide = Spectra(record.frequencies[where], record.transforms[where])
    half = Spectra(wide.frequencies, wide.transforms[:, : wide.transforms.shape[1] // 2])
    last = count - 1
    excess = healthy.roots(wide)[:, last] - healthy.chance_roots(wide, 0.5)[last]
    return float(np.median((healthy.roots(half)[:, last] - healthy.chance_roots(half, 0.5)[last]) / excess))


@one_thread()
def fault_direction_against_healthy(
    r: ArrayLike, healthy: HealthyReference, *, A: ArrayLike | None = None, C: ArrayLike | None = None, u: ArrayLike | None = None
) -> FaultDirection:
    """Return the column [F; G] and the signal of the one fault in a residual.

    The sign and the split of size between z and the signal are free: z has unit norm in the given units. With zeros in the fault model
    (zeta > 0) other members of the fault space fit as well. Needs memory for (N / 2) p (n + p) complex numbers. Source: [RS95] for the
    tapers that the noise is learnt with.

    Parameters
    ----------
    r : array_like, (N, p)
        In the units of the healthy record.
    healthy : HealthyReference
    A, C : array_like, (n, n) and (p, n), optional
        Of the model; neither for a fault at the outputs alone.
    u : array_like (N, n_u), optional
        Needed where the reference was learnt with inputs.

    Returns
    -------
    FaultDirection
        The column z (n + p,) and the signal.

    Raises
    ------
    InvalidData
        Where shapes do not fit.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import fault_direction_against_healthy, healthy_reference
    >>> noise = np.random.default_rng(1).standard_normal((2000, 3))
    >>> v = 5 * np.random.default_rng(2).standard_normal(1000)
    >>> noise[1000:, 1] += v
    >>> found = fault_direction_against_healthy(noise[1000:], healthy_reference(noise[:1000]))
    >>> bool(abs(found.z[1]) > 0.99), bool(abs(np.corrcoef(found.signal[50:], v[50:])[0, 1]) > 0.9)
    (True, True)
    """
    if (A is None) != (C is None):
        raise InvalidData("A and C: got one without the other; give both, or neither for a fault at the outputs alone")
    model = None if A is None or C is None else (np.array(A, dtype=float, ndmin=2), np.array(C, dtype=float, ndmin=2))
    e, regressors = healthy.innovations(r, u)
    record = _whitened(healthy, e, regressors, model)
    z = _likeliest(record.effect, record.x)
    matched, power, ratio = record.matched(z)
    level = _smooth(ratio, healthy.tapers)
    noise = _noise_level(healthy, model, z, record.frequencies)
    spectrum = np.zeros(len(e) // 2 + 1, dtype=complex)
    spectrum[1 : 1 + len(ratio)] = np.maximum(1.0 - noise / np.maximum(level, noise), 0.0) * matched / power
    signal = np.concatenate([np.zeros(healthy.lags), np.fft.irfft(spectrum * np.sqrt(len(e)), n=len(e))])
    return FaultDirection(z, signal, float(ratio.mean()))


@dataclass(frozen=True, eq=False)
class _Whitened:
    """This holds the transforms x (len, p) of a record at `frequencies` (len,), whitened, and the `effect` (len, p, size) of each column
    on them."""

    frequencies: Array
    effect: Complex
    x: Complex

    def matched(self, z: Array) -> tuple[Complex, Array, Array]:
        """Return w* x, w* w and |w* x|^2 / (w* w) at each frequency for w = effect z."""
        w = self.effect @ z
        power = np.sum(np.abs(w) ** 2, axis=1)
        inner = np.sum(w.conj() * self.x, axis=1)
        return inner, power, np.abs(inner) ** 2 / power


def _whitened(healthy: HealthyReference, e: Array, regressors: Array, model: tuple[Array, Array] | None) -> _Whitened:
    """Whiten innovations e (N, p) with their regressors (N, q), at all frequencies but zero and one half."""
    frequencies = np.asarray(np.fft.rfftfreq(len(e))[1:-1], dtype=float)
    transforms = np.fft.rfft(e, axis=0)[1:-1] / np.sqrt(len(e))
    explained = np.fft.rfft(regressors, axis=0)[1:-1] / np.sqrt(len(e))
    forecast = np.sqrt(1.0 + np.sum(np.abs(explained) ** 2, axis=1))
    effect = healthy.response(frequencies)
    if model is not None:
        effect = effect @ _columns(*model, frequencies, healthy.p)
    whitener = np.array([np.linalg.inv(np.linalg.cholesky(phi)) for phi in healthy.covariances])
    nearest = healthy.nearest(frequencies)
    for centre, factor in enumerate(whitener):
        effect[nearest == centre] = factor @ effect[nearest == centre]
    effect /= forecast[:, None, None]
    return _Whitened(frequencies, effect, np.einsum("kij,kj->ki", whitener[nearest], transforms / forecast[:, None]))


def _noise_level(healthy: HealthyReference, model: tuple[Array, Array] | None, z: Array, frequencies: Array) -> Array:
    """Return the |w* x|^2 / (w* w) that noise makes in the direction z near each frequency (len,), one where it is as it was learnt.

    Each half of the healthy record is whitened by what was learnt on the other, which knows nothing of it: a drift at the lowest
    frequencies, which a predictor fits where it is learnt and does not where it is used, shows in no other way.
    """
    levels = []
    for fold in healthy.folds:
        innovations = fold.reference.unchecked_innovations(fold.residual, fold.inputs)
        half = _whitened(fold.reference, *innovations, model)
        levels.append(np.interp(frequencies, half.frequencies, _smooth(half.matched(z)[2], 2 * FEW_TAPERS + 1)))
    return np.asarray(np.mean(levels, axis=0))


def _smooth(values: Array, width: int) -> Array:
    """Return the mean of the `width` values around each, fewer at the ends."""
    window = np.ones(min(width, len(values)))
    return np.asarray(np.convolve(values, window, "same") / np.convolve(np.ones(len(values)), window, "same"))


def _columns(A: Array, C: Array, frequencies: Array, p: int) -> Complex:
    """Return [C (zI - A)^-1, I] at z = exp(2 pi i f): (len, p, n + p)."""
    n = A.shape[0]
    if A.shape != (n, n) or C.shape != (p, n):
        raise InvalidData(f"A, C: got shapes {A.shape}, {C.shape}; needed (n, n), ({p}, n) for a residual of {counted(p, 'channel')}")
    schur, turn = scipy.linalg.schur(A, output="complex")
    turned = C @ turn
    states = np.empty((len(frequencies), p, n), dtype=complex)
    for k, point in enumerate(np.exp(2j * np.pi * frequencies)):
        shifted = point * np.eye(n) - schur
        states[k] = scipy.linalg.solve_triangular(shifted, turned.T, trans="T", check_finite=False).T @ turn.conj().T
    return np.concatenate([states, np.broadcast_to(np.eye(p), (len(frequencies), p, p))], axis=2)


def _likeliest(effect: Complex, x: Complex) -> Array:
    """Return the unit z that maximises sum_k |w_k* x_k|^2 / |w_k|^2, w_k = effect_k z; sought in coordinates where sum_k |w_k|^2 =
    |z|^2."""
    size = effect.shape[2]
    sizes = np.sqrt(np.sum(np.abs(effect) ** 2, axis=(0, 1)))
    scaled = effect / sizes
    flat = scaled.reshape(-1, size)
    values, vectors = np.linalg.eigh(np.real(flat.conj().T @ flat))
    basis = vectors / np.sqrt(np.maximum(values, 1e-10 * values[-1]))
    scaled = scaled @ basis
    matched = np.einsum("kpi,kp->ki", scaled.conj(), x)

    def cost(z: Array) -> tuple[float, Array]:
        w = scaled @ z
        power = np.sum(np.abs(w) ** 2, axis=1)
        power = np.maximum(power, np.finfo(float).tiny)
        inner = matched @ z
        gain = np.abs(inner) ** 2 / power
        slope = np.real((inner.conj() / power) @ matched) - np.real(np.einsum("k,kp,kpi->i", gain / power, w.conj(), scaled, optimize=True))
        return -float(gain.sum()), -2.0 * np.asarray(slope)

    starts = np.linalg.eigh(np.real(matched.T @ matched.conj()))[1].T[:-4:-1]
    fits = [scipy.optimize.minimize(cost, start, jac=True, method="L-BFGS-B", options={"maxiter": 300}) for start in starts]
    best = min(fits, key=lambda fit: float(fit.fun))
    z = (basis @ best.x) / sizes
    return np.asarray(z / np.linalg.norm(z))
