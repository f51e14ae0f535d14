"""Fit kernel rows of outputs and inputs together by maximum likelihood, for which no model of the system is needed.

In x+ = A x + B u + F v, y = C x + D u + G v + w let the polynomial row [N_y N_u](q) annihilate every [y; u] that the system can make
without noise, whatever v and x(0) are. Then N_y(q) y + N_u(q) u = N_y(q) w: neither the faults nor the initial state nor the input are
left, and the inputs carry no noise. There are k = p - n_v such rows [W91], whose degrees add up to n - zeta where the system is
minimal; they are fitted by the likelihood of `numeric/method/space/basis.py`,

    cost(N) = sum over frequencies of tr[(N_y diag(lam) N_y*)^-1 N S N*] / phi,    N = [N_y N_u],

S the cross-spectral moments of [y; u]. Without noise the rows are exactly those of the system, up to unimodular combinations.

    JointMoments    the moments of [y; u], each channel in units of its deviation: the only place where N enters
    joint_moments   from experiments of the same system
    lam             (p,) powers of the noise in the channels relative to phi, in the units of the moments: the `shares`
    affordable      whether moments of so many channels and degrees can be had
    even_split      degrees of k rows with a given sum, as equal as can be
    fitted          rows of given degrees from given starts and from those that the moments make least
    refitted        rows from one start alone
    course          one fit for every total degree 0, 1, .., each started from the one before
    compared_fits   the fits of a course, descended again for the moments under which their degrees are compared
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ...data.validation import signals
from ..ranks.sample_windows import channel_sizes
from ..space.basis import FLAT, KernelBasis, kernel_basis, refined_basis
from ..space.tapered_moments import BANDS, CrossMoments, about_means, pooled_moments

# Turns of colour and rows: the level moves by less than a thousandth of a nat afterwards.
ROUNDS = 5
# And of colour and rows that begin near their end.
TURNS = 2
# Share of the unit of a likelihood ratio that the last step of a descent may still gain: steps that crawl add up.
PRECISION = 0.02
# Rows of the largest moments that are fitted in an identification. A budget of time: fits take the cube of their number, 1 CPU second a
# count at 35 rows, so that so many take some twenty. It decides no number.
LARGEST = 100
# Power, beside that of a channel, that moments cannot tell from their rounding: rows that leave less are exact, and not refined further.
ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class JointMoments:
    """`moments` are those of [y / scale[:p], u / scale[p:]] of p outputs and n_u inputs, and `scale` (p + n_u,) is that of the channels."""

    moments: CrossMoments
    scale: Array
    p: int

    @property
    def n_u(self) -> int:
        """Return the number of inputs."""
        return self.moments.channels - self.p

    @property
    def samples(self) -> float:
        """Return how many independent samples the moments are worth."""
        return self.moments.samples

    @property
    def degree(self) -> int:
        """Return the largest degree of a row that they serve."""
        return self.moments.degree

    def noise(self, shares: Array | None) -> Array:
        """Return the shares (p + n_u,) of all channels: these (p,) of the outputs, ones where they are None, and zeros of the inputs."""
        return np.concatenate([np.ones(self.p) if shares is None else shares, np.zeros(self.n_u)])


def joint_moments(experiments: Sequence[tuple[ArrayLike, ArrayLike]], degree: int, bands: int = BANDS) -> JointMoments:
    """Return the moments of experiments (y, u) of one system, (N, p) and (N, n_u), each from its own initial state, weighted by their
    lengths, for rows up to this degree, in so many bands or fewer.

    Of those about their means, N_i(1) times these is unknown to what the ends of the record make of it, and each window has a constant.

    Raises InvalidData for data that are no signals, for lengths that differ, and where N of the shortest is less than 2 (p + n_u)
    (degree + 1) + degree, and for experiments with other numbers of channels.

    >>> t = np.arange(400.0)
    >>> joint_moments([(np.sin(t), np.cos(3 * t))], 2).p
    1
    """
    records = [signals(y, u) for y, u in experiments]
    if len({(y.shape[1], u.shape[1]) for y, u in records}) != 1:
        raise InvalidData(
            f"experiments: got {[(y.shape, u.shape) for y, u in records]}; at least one is needed, all with the same channels"
        )
    lengths = np.array([len(y) for y, _ in records], dtype=float)
    sizes = np.array([_deviations(np.hstack(record)) for record in records])
    scale = np.sqrt(lengths @ sizes**2 / lengths.sum())
    joint = [np.hstack(record) / scale for record in records]
    pooled = pooled_moments(joint, degree, bands, constants=[about_means(one) for one in joint])
    return JointMoments(pooled, scale, records[0][0].shape[1])


def _deviations(signals: Array) -> Array:
    """Return the standard deviations (c,), and the size of a constant channel: an offset does not show how loud a sensor's noise is."""
    deviations = channel_sizes(signals - signals.mean(axis=0))
    return np.where(np.ptp(signals, axis=0) > 0.0, deviations, channel_sizes(signals))


def affordable(channels: int, degree: int) -> bool:
    """Say whether moments of so many channels for rows up to this degree can be made and fitted in seconds."""
    return channels * (degree + 1) <= LARGEST


def even_split(total: int, rows: int) -> tuple[int, ...]:
    """Return ascending degrees of so many rows that add up to `total`, as equal as can be, which are those of almost every system."""
    low, rest = divmod(total, rows)
    return (low,) * (rows - rest) + (low + 1,) * rest


def fitted(
    data: JointMoments,
    degrees: Sequence[int],
    starts: Sequence[Sequence[Array]] = (),
    *,
    shares: Array | None = None,
    rounds: int = ROUNDS,
    flat: float = FLAT,
) -> KernelBasis:
    """Fit rows of these ascending degrees, from `starts` and from the least vectors of the moments."""
    moments = data.moments.of_degree(max(degrees))
    return kernel_basis(moments, _free(data, degrees), starts, rounds=rounds, shares=data.noise(shares), flat=flat)


def refitted(
    data: JointMoments,
    degrees: Sequence[int],
    start: Sequence[Array],
    *,
    shares: Array | None = None,
    rounds: int = ROUNDS,
    flat: float = FLAT,
) -> KernelBasis:
    """Fit rows of these ascending degrees, from rows of no higher degrees alone."""
    moments = data.moments.of_degree(max(degrees))
    return refined_basis(moments, _free(data, degrees), padded(start, degrees), rounds=rounds, shares=data.noise(shares), flat=flat)


def course(data: JointMoments, rows: int, most: int, *, shares: Array | None = None, rounds: int = ROUNDS) -> list[KernelBasis]:
    """Return the likeliest rows of total degree 0, 1, .., most, split as equally as can be.

    Each starts from the rows before, with zeros above and with zeros below: with a zero at infinity or at the origin.
    """
    fits: list[KernelBasis] = []
    for total in range(most + 1):
        degrees = even_split(total, rows)
        starts = [padded(fits[-1].rows, degrees), padded(fits[-1].rows, degrees, below=True)] if fits else []
        fits.append(fitted(data, degrees, starts, shares=shares, rounds=rounds))
    return fits


def compared_fits(data: JointMoments, fits: Sequence[KernelBasis], shares: Array | None = None) -> list[KernelBasis]:
    """Return fits of the same total degrees, each one more than that before, descended again for moments that are over the noise already
    (`faint_faults.py`).

    Each is the best of the descents from the rows given and from those found of one degree less. Moments of likelihoods that are compared
    are in narrow bands: within a band the rows are taken at its middle, and a row of higher degree gains by that where it turns fast, the
    more the more samples a band has.
    """
    flat, found = PRECISION / data.samples, list[KernelBasis]()
    for fit in fits:
        degrees = [len(row) - 1 for row in fit.rows]
        starts: list[Sequence[Array]] = [fit.rows]
        if found:
            starts += [padded(found[-1].rows, degrees), padded(found[-1].rows, degrees, below=True)]
        trials = [refitted(data, degrees, start, shares=shares, rounds=0, flat=flat) for start in starts]
        found.append(min(trials, key=lambda trial: trial.level))
    return found


def padded(rows: Sequence[Array], degrees: Sequence[int], *, below: bool = False) -> list[Array]:
    """Return the rows with zeros above their highest coefficients, or below their lowest, up to these degrees."""
    missing = [degree + 1 - len(row) for row, degree in zip(rows, degrees, strict=True)]
    return [np.pad(row, ((count, 0) if below else (0, count), (0, 0))) for row, count in zip(rows, missing, strict=True)]


def _free(data: JointMoments, degrees: Sequence[int]) -> list[Array]:
    """Return bases that leave every coefficient free."""
    return [np.eye(data.moments.channels * (degree + 1)) for degree in degrees]
