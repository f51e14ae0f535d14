"""This learns what a residual looks like without a fault: measured on a healthy record, so that noise and model error become white.

A residual of measured data is never zero: noise of unequal size and colour, and the error of the model. A healthy record
of the same plant shows both. From it

    predictor       e(k) = r(k) - sum_j A_j r(k-j) - sum_j B_j u(k-j), about means: least squares, the order by the corrected Akaike
                    criterion [BT94]; e is nearly white. The filter I - sum A_j q^-j is invertible, so a fault keeps its rank in e at almost
                    every frequency
    forecast        in another record e also contains the error of the predictor's coefficients times its regressors: for T transforms
                    of regressors, the rows of X, these have the covariance I + X (X0' X0)^-1 X* between them, X0 the regressors of the
                    healthy record (the variance of a forecast by least squares [C60]). It is divided out, which changes no rank: else
                    lightly damped modes that the healthy record hardly excited would look like faults
    tapers          transforms X_t(f) of e with the sine tapers, orthonormal and of low leakage [RS95]: for white e the X_t, t = 1 .. T, are
                    independent complex Gaussian vectors, and those of centres T / (N + 1) apart nearly so
    covariances     at each centre, over as many centres around it as give `FREEDOM` degrees of freedom a channel: the colour that is left
    strain          how far the healthy record itself departs from the law that a count of faults relies on: each half is held against
                    the other, which knows nothing of it, by the exact law of the largest ratio of two covariances (`largest_root`); 1.5
                    at a frequency says that the ratio came out at 1.5 times its quantile (drifts, mains hum, lightly damped modes that
                    were hardly excited). Thresholds are raised by it, so an unsteady frequency needs a louder fault
    freedom         complex degrees of freedom of a covariance, those spent on the predictor taken off

HEALTHY_LEVEL is a promise. The other constants are judged by `benchmarks/constants.py healthy`: MOST_LAGS, SPENT, MANY_TAPERS and
FEW_TAPERS are no worse than their halves and doubles (seed 700100, 320 records), nor is FREEDOM (seed 700900). LEAST_SAMPLES refuses and
decides nothing.

    healthy_reference   from a healthy residual (and its inputs)
    HealthyReference    `innovations` and `spectra` of any record, `response` A(f) of the predictor, the `covariances`
    Spectra, spectra    tapered transforms of a record at their centres
    covering_spectra    the same, with no frequency left out
    noise_share         how much of mere noise n_v signals explain at most
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name, plain
from ...data.validation import signal
from ...method.ranks.sample_windows import channel_sizes, stacked_triangle
from .largest_root import largest_root_quantile

Complex = NDArray[np.complex128]

HEALTHY_LEVEL = 0.001
LEAST_SAMPLES = 256
MANY_TAPERS = 16
FEW_TAPERS = 4
FREEDOM = 4
"""A covariance has so many degrees of freedom for each channel: at four the whitening costs a quarter of a fault."""
MOST_LAGS = 32
STRETCH = 1 << 13  # rows that a triangle takes at a time
SPENT = 8
"""At most the eighth part of the healthy samples is spent on coefficients of the predictor."""


@dataclass(frozen=True)
class Spectra:
    """The record holds the `transforms` (centres, T, p) of a signal at `frequencies` (centres,), in cycles a sample."""

    frequencies: Array
    transforms: Complex


@dataclass(frozen=True, eq=False)
class Fold:
    """One half of the healthy record, `residual` (N, p) and `inputs` (N, n_u), is judged by the `reference` learnt on the other half."""

    reference: HealthyReference
    residual: Array
    inputs: Array


@dataclass(frozen=True, eq=False, repr=False)
class HealthyReference(Shown):
    """How a residual behaves without a fault; the head of the module explains it.

    `scales` (p,) and `input_scales` (n_u,) are the units taken out of r and u. The predictor has `lags` lags and the `coefficients` (q, p),
    q = (p + n_u) lags + n_u; `root` (q, q) satisfies root' root = (X0' X0)^-1, and `samples` were predicted. The complex `covariances`
    (centres, p, p) of `freedom` degrees of freedom belong to `centres` (centres,), in cycles a sample, and `strains` holds frequencies and
    strains by number of tapers; `folds` are both halves of the healthy record, each with what was learnt on the other. Look at the largest
    strain first, which `summary()` tells: far above 1 the healthy record is not steady, and only louder faults are seen. Raises
    InvalidData, in its methods, for a record that does not fit the healthy one. Sources: [RS95] for the tapers, [C60] for the forecast.

    >>> import numpy as np
    >>> from faultspace.numeric import healthy_reference
    >>> noise = np.random.default_rng(1).standard_normal((2000, 3))
    >>> healthy = healthy_reference(noise)
    >>> healthy.p, healthy.scales.shape, healthy.innovations(noise)[0].shape == (2000 - healthy.lags, 3)
    (3, (3,), True)
    """

    scales: Array
    input_scales: Array
    lags: int
    coefficients: Array
    root: Array
    samples: int
    centres: Array
    covariances: Complex
    freedom: int
    strains: dict[int, tuple[Array, Array]]
    folds: tuple[Fold, ...]

    @property
    def title(self) -> str:
        """Return what was learnt from, on one short line."""
        inputs = counted(len(self.input_scales), "input") if len(self.input_scales) else "no inputs"
        return f"healthy reference from {counted(self.samples, 'sample')}, {counted(self.p, 'channel')}, {inputs}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what was learnt, and where the healthy record itself is unsteady."""
        yield "lags of the predictor", str(self.lags)
        yield "frequencies, degrees of freedom", f"{len(self.centres)}, {self.freedom}"
        yield "size of the channels", ", ".join(f"{size:.4g}" for size in self.scales)
        for tapers, (frequencies, strains) in self.strains.items():
            worst = int(np.argmax(strains))
            yield f"largest strain, {tapers} tapers", f"{strains[worst]:.3g} at {frequencies[worst]:.4g} cycles a sample"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of everything but the samples of the halves; complex numbers are pairs."""
        names = ("samples", "scales", "input_scales", "lags", "coefficients", "root", "centres", "covariances", "freedom")
        strains = [{"tapers": tapers, "frequencies": plain(at), "strains": plain(values)} for tapers, (at, values) in self.strains.items()]
        return by_name(self, *names) | {"strains": strains}

    @property
    def p(self) -> int:
        """Return the number of channels."""
        return len(self.scales)

    @property
    def tapers(self) -> int:
        """Return T, as many as there are channels and at least sixteen."""
        return max(self.p, MANY_TAPERS)

    @property
    def taper_numbers(self) -> tuple[int, ...]:
        """Return T, T / 2, T / 4 .. down to at least four, which are the widths at which a record may be looked at."""
        return tuple(self.tapers >> k for k in range(int(np.log2(self.tapers / FEW_TAPERS)) + 1))

    @one_thread()
    def innovations(self, r: ArrayLike, u: ArrayLike | None = None) -> tuple[Array, Array]:
        """Return e (N - lags, p) of a residual r (N, p) with inputs u (N, n_u), and its regressors X root', (N - lags, q).

        Raises InvalidData where the record does not fit the healthy one.
        """
        return self.unchecked_innovations(*self._fitting(r, u))

    def _fitting(self, r: ArrayLike, u: ArrayLike | None) -> tuple[Array, Array]:
        residual, inputs = residual_and_inputs(r, u)
        if residual.shape[1] != self.p or inputs.shape[1] != len(self.input_scales):
            raise InvalidData(
                f"the record has {counted(residual.shape[1], 'channel')} and "
                f"{counted(inputs.shape[1], 'input')}, the healthy one {self.p} and "
                f"{len(self.input_scales)}; they must be of the same plant: give the same channels, and u for both or for neither"
            )
        if len(residual) < self.lags + 4 * self.tapers:
            raise InvalidData(
                f"r has {counted(len(residual), 'sample')}; at least {self.lags + 4 * self.tapers} "
                f"are needed against this healthy record: record more"
            )
        return residual, inputs

    def unchecked_innovations(self, residual: Array, inputs: Array) -> tuple[Array, Array]:
        """Return the same for arrays (N, p) and (N, n_u) known to fit."""
        past, now = _about_means(*lagged(residual / self.scales, inputs / self.input_scales, self.lags))
        return now - past @ self.coefficients, past @ self.root.T

    @one_thread()
    def spectra(self, r: ArrayLike, u: ArrayLike | None = None, *, tapers: int | None = None) -> Spectra:
        """Return tapered transforms of e, with the error of the forecast divided out; arguments as `innovations`."""
        return self.unchecked_spectra(*self._fitting(r, u), tapers or self.tapers)

    def unchecked_spectra(self, residual: Array, inputs: Array, tapers: int) -> Spectra:
        """Return the same for arrays (N, p) and (N, n_u) known to fit."""
        e, regressors = self.unchecked_innovations(residual, inputs)
        record = covering_spectra(e, tapers)
        explained = covering_spectra(regressors, tapers).transforms
        between = np.eye(tapers) + explained @ explained.conj().transpose(0, 2, 1)
        return Spectra(record.frequencies, np.asarray(np.linalg.solve(np.linalg.cholesky(between), record.transforms), dtype=complex))

    def response(self, frequencies: Array) -> Complex:
        """Return the filter from r to e at these frequencies, (len, p, p), units included."""
        p, width = self.p, self.p + len(self.input_scales)
        turns = np.exp(-2j * np.pi * np.outer(frequencies, np.arange(1, self.lags + 1)))
        steps = self.coefficients[: width * self.lags].reshape(self.lags, width, p)[:, :p].transpose(0, 2, 1)
        filters = np.eye(p) - np.tensordot(turns, steps, axes=1)
        return np.asarray(filters / self.scales)

    def remembered(self, frequencies: Array) -> Complex:
        """Return what a unit signal at each output is in the regressors X root' of `innovations`, (len, q, p)."""
        width, count = self.p + len(self.input_scales), len(self.root)
        turns = np.exp(-2j * np.pi * np.outer(frequencies, np.arange(1, self.lags + 1)))
        places = np.zeros((self.lags, count, self.p))
        for j in range(self.lags):
            places[j, j * width : j * width + self.p] = np.diag(1.0 / self.scales)
        return np.asarray(self.root @ np.tensordot(turns, places, axes=1))

    def nearest(self, frequencies: Array) -> NDArray[np.int_]:
        """Return the number of the centre nearest to each frequency."""
        return np.searchsorted((self.centres[1:] + self.centres[:-1]) / 2.0, frequencies)

    def strain(self, record: Spectra) -> Array:
        """Return what thresholds at the record's centres are multiplied by: the largest strain with as many tapers nearby, at least 1."""
        known = self.strains.get(record.transforms.shape[1])
        if known is None:
            return np.ones(len(record.frequencies))
        reach = 1.5 * float(np.max(np.diff(np.unique(known[0])), initial=0.0))
        near = np.abs(record.frequencies[:, None] - known[0]) <= reach
        return np.asarray(np.maximum(1.0, np.max(np.where(near, known[1], 1.0), axis=1)))

    def roots(self, record: Spectra) -> Array:
        """Return ratios of a whitened record's covariance to the healthy one at each centre, (centres, p), falling."""
        found = np.empty((len(record.frequencies), self.p))
        for i, (rows, centre) in enumerate(zip(record.transforms, self.nearest(record.frequencies), strict=True)):
            own = rows.T @ rows.conj() / len(rows)
            found[i] = scipy.linalg.eigh(own, self.covariances[centre], eigvals_only=True, check_finite=False)[::-1]
        return np.maximum(found, 0.0)

    def thresholds(self, record: Spectra, level: float) -> Array:
        """Return what the root j + 1 of `roots` exceeds, given j faults, with a chance of at most `level` over all centres: (centres,
        p)."""
        return self.strain(record)[:, None] * self.chance_roots(record, level / len(record.frequencies))

    def chance_roots(self, record: Spectra, chance: float) -> Array:
        """Return what the root j + 1 exceeds, given j faults, with this chance at one centre: (p,)."""
        tapers, p = record.transforms.shape[1:]
        return np.array([largest_root_quantile(chance, p - j, tapers, self.freedom) for j in range(p)])


@one_thread()
def healthy_reference(healthy: ArrayLike, u: ArrayLike | None = None, *, level: float = HEALTHY_LEVEL) -> HealthyReference:
    """Learn the noise of a healthy residual and, where given, of what its inputs make of the model's error.

    Source: [BT94] for the number of lags, [RS95] for the tapers.

    Parameters
    ----------
    healthy : array_like, (N, p)
        Each channel in any units.
    u : array_like (N, n_u), optional
    level : float in (0, 1)
        Of the quantiles that strain is measured in.

    Returns
    -------
    HealthyReference

    Raises
    ------
    InvalidData
        NaN, fewer than 256 samples or 64 a channel, channels that are constant or exact combinations of others (there is no noise to
        compare with; `fault_dimension` counts the faults of such residuals).

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import healthy_reference
    >>> noise = np.random.default_rng(1).standard_normal((2000, 3))
    >>> healthy_reference(noise).p
    3
    """
    residual, inputs = residual_and_inputs(healthy, u)
    samples, p = residual.shape
    needed = max(LEAST_SAMPLES, LEAST_SAMPLES // 4 * p)
    if samples < needed:
        hint = "record more, or take fewer channels" if samples >= LEAST_SAMPLES else "record more"
        hint = "it looks transposed, pass healthy.T" if p > samples else hint
        raise InvalidData(f"healthy has {counted(samples, 'sample')} of {counted(p, 'channel')}; at least {needed} are needed: {hint}")
    half = samples // 2
    reference = _learnt(residual, inputs)
    strains = {}
    halves = [(residual[:half], inputs[:half]), (residual[half:], inputs[half:])]
    folds = tuple(Fold(_learnt(*learnt), *other) for learnt, other in (halves, halves[::-1]))
    for tapers in reference.taper_numbers:
        records = [(fold.reference, fold.reference.unchecked_spectra(fold.residual, fold.inputs, tapers)) for fold in folds]
        ratios = [learnt.roots(record)[:, 0] / learnt.thresholds(record, level)[:, 0] for learnt, record in records]
        strains[tapers] = np.concatenate([record.frequencies for _, record in records]), np.concatenate(ratios)
    return replace(reference, strains=strains, folds=folds)


def _learnt(residual: Array, inputs: Array) -> HealthyReference:
    """Return the reference without its strains and folds."""
    p = residual.shape[1]
    scales, input_scales = channel_sizes(residual), channel_sizes(inputs) if inputs.shape[1] else np.ones(0)
    scaled, pushed = residual / scales, inputs / input_scales
    lags = number_of_lags(scaled, pushed)
    past, now = _about_means(*lagged(scaled, pushed, lags))
    factor, triangle = np.linalg.qr(past)
    e = now - factor @ (factor.T @ now)
    root = np.linalg.inv(triangle).T
    coefficients = root.T @ (factor.T @ now)
    share = 1.0 - len(coefficients) / len(e)
    centres, covariances, freedom = _covariances(spectra(e, max(p, MANY_TAPERS)), share)
    return HealthyReference(scales, input_scales, lags, coefficients, root, len(e), centres, covariances, freedom, {}, ())


def spectra(e: Array, tapers: int) -> Spectra:
    """Return tapered transforms of e (N, p) at centres `tapers` / (N + 1) apart, the first half as far from zero, all below one half.

    The t-th sine taper (2 / (N+1))^(1/2) sin(pi t k / (N+1)) shifts the plain transform by t / (2 (N+1)) to both sides [RS95].
    """
    return _around(e, tapers, _apart(len(e), tapers))


def covering_spectra(e: Array, tapers: int) -> Spectra:
    """Return what `spectra` does, with one centre more, nearer than that to the last, where these would leave out frequencies next to one
    half."""
    last = len(e) + 1 - tapers
    return _around(e, tapers, np.union1d(_apart(len(e), tapers), last))


def _apart(samples: int, tapers: int) -> NDArray[np.int_]:
    """Return centres that share no frequency, in units of 1 / (2 (N+1))."""
    return np.arange(tapers, samples + 1 - tapers + 1, 2 * tapers)


def _around(e: Array, tapers: int, centres: NDArray[np.int_]) -> Spectra:
    """Return the transforms at these centres; channel by channel, so that the plain transform of one alone is held."""
    samples, p = e.shape
    shifts = np.arange(1, tapers + 1)
    found = np.empty((len(centres), tapers, p), complex)
    for channel in range(p):
        plain = np.fft.rfft(np.concatenate([[0.0], e[:, channel]]), n=2 * (samples + 1))
        found[:, :, channel] = plain[centres[:, None] - shifts] - plain[centres[:, None] + shifts]
    return Spectra(centres / (2.0 * (samples + 1)), found / (2j * np.sqrt((samples + 1) / 2.0)))


def residual_and_inputs(r: ArrayLike, u: ArrayLike | None) -> tuple[Array, Array]:
    """Return r and u as arrays of equal length; without u none of its channels."""
    residual = signal(r, "r")
    inputs = np.zeros((len(residual), 0)) if u is None else signal(u, "u")
    if len(inputs) != len(residual):
        raise InvalidData(
            f"u has {counted(len(inputs), 'sample')} and r has {len(residual)}; equal numbers are needed: cut both to those they share"
        )
    return residual, inputs


def lagged(r: Array, u: Array, lags: int) -> tuple[Array, Array]:
    """Return [r(k-1) u(k-1) .. r(k-lags) u(k-lags) u(k)] and r(k), for k = lags .. N - 1."""
    joint, samples = np.hstack([r, u]), len(r)
    past = [joint[lags - j : samples - j] for j in range(1, lags + 1)]
    return np.hstack([*past, u[lags:]]), r[lags:]


def _about_means(past: Array, now: Array) -> tuple[Array, Array]:
    """Take the means off both, which makes a predictor with a constant: a mean that has moved is no fault that keeps exciting, and is
    tested by `mean_shift`; left in, it would count as a fault at the lowest frequency."""
    return past - past.mean(axis=0), now - now.mean(axis=0)


def _triangle(r: Array, u: Array, lags: int) -> Array:
    """Return the triangle of [u(k), r(k-1) u(k-1) .. r(k-lags) u(k-lags), r(k)] over k = lags .. N - 1: fewer lags are leading columns."""
    split = (r.shape[1] + u.shape[1]) * lags
    rows = (np.hstack([past[:, split:], past[:, :split], now]) for past, now in lagged_stretches(r, u, lags))
    return stacked_triangle(u.shape[1] + split + r.shape[1], rows)


def lagged_stretches(r: Array, u: Array, lags: int) -> Iterator[tuple[Array, Array]]:
    """Yield what `lagged` returns, at most STRETCH rows at a time, so that memory does not grow with the record."""
    for start in range(0, len(r) - lags, STRETCH):
        stretch = slice(start, start + STRETCH + lags)
        yield lagged(r[stretch], u[stretch], lags)


def number_of_lags(r: Array, u: Array) -> int:
    """Return the lags of the predictor; one triangle serves every number of them, over the same samples."""
    samples, p = r.shape
    width, n_u = p + u.shape[1], u.shape[1]
    most = int(np.clip((samples // SPENT - n_u) // width, 0, MOST_LAGS))
    triangle = _triangle(r, u, most)
    sizes = np.abs(np.diag(triangle))
    norms = np.linalg.norm(triangle, axis=0)
    if np.any(sizes[-p:] <= 1e-12 * norms[-p:]):
        raise InvalidData(
            "healthy: channels are constant, or exact combinations of others and of their past: there is no noise to compare with; "
            "count the faults of such residuals with fault_dimension"
        )
    count = samples - most
    best, chosen = np.inf, 0
    for lags in range(most + 1):
        spent = n_u + width * lags
        if count <= spent + p + 1:  # so few samples say nothing of this many coefficients, nor do they of more
            break
        left = triangle[spent:, -p:]
        logdet = np.linalg.slogdet(left.T @ left / count)[1]
        # Corrected Akaike criterion for p regressions with a full covariance.
        criterion = count * logdet + 2.0 * count * p * (spent + (p + 1) / 2.0) / (count - spent - p - 1)
        if criterion < best:
            best, chosen = criterion, lags
    return chosen


def _covariances(record: Spectra, share: float) -> tuple[Array, Complex, int]:
    """Return centres, the covariance around each, and its degrees of freedom; `share` of the freedom is left after the predictor."""
    count, tapers, p = record.transforms.shape
    width = min(int(np.ceil(FREEDOM * p / (tapers * share))) | 1, count)
    sums = np.cumsum(np.einsum("ctp,ctq->cpq", record.transforms, record.transforms.conj()), axis=0)
    sums = np.concatenate([np.zeros((1, p, p)), sums])
    starts = np.clip(np.arange(count) - width // 2, 0, count - width)
    freedom = share * tapers * width
    return record.frequencies, np.asarray((sums[starts + width] - sums[starts]) / freedom), int(freedom)


def noise_share(r: ArrayLike, n_v: int, units: Array, *, healthy: bool) -> float:
    """Return the share that n_v <= p signals could explain of noise, r (N, p) in `units` (p,); `healthy`: r is a residual without fault.

    Otherwise only the spectrum of each output is taken from r. At each frequency the signals of one F, G reach one n_v-dimensional subspace
    of the outputs, and of noise of spectrum Phi(f) no such subspace holds more than the n_v largest eigenvalues of Phi(f). Summed over the
    frequencies this bounds what any F, G explain of noise: a share below it is no sign of a fault. Many tapers make the largest eigenvalues
    larger, and so the bound. Raises InvalidData for fewer than 4 MANY_TAPERS samples.
    """
    residual = signal(r, "r") / units
    if len(residual) < 4 * MANY_TAPERS:
        raise InvalidData(f"r has {counted(len(residual), 'sample')}; at least {4 * MANY_TAPERS} are needed for its spectra: record more")
    x = spectra(residual - residual.mean(axis=0), MANY_TAPERS).transforms
    alone = np.sort(np.sum(np.abs(x) ** 2, axis=1), axis=1)
    powers = np.linalg.eigvalsh(x.conj().transpose(0, 2, 1) @ x) if healthy else alone
    total = float(powers.sum())
    return float(powers[:, -n_v:].sum()) / total if total else 1.0
