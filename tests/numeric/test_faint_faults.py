"""Degrees of rows are compared under moments that are even where faults are faint: no row gains by turning to where noise is least."""

from __future__ import annotations

import numpy as np
import scipy.signal

from faultspace.base.arrays import Array
from faultspace.numeric.method.model.feedback import one_step_errors
from faultspace.numeric.method.rows.degree import excess, likelihood_ratio
from faultspace.numeric.method.rows.evidence import arx_of
from faultspace.numeric.method.rows.faint_faults import even_moments
from faultspace.numeric.method.rows.joint import JointMoments, compared_fits, course, joint_moments, refitted
from faultspace.numeric.method.rows.remainder import remainder

N, P = 4000, 3


def record(seed: int, *, slow: bool) -> tuple[Array, Array]:
    """Return y (N, 3) and u (N, 1) of no states and two faults, the second white or ending at a quarter of all frequencies, with noise of
    one power relative to the outputs."""
    rng = np.random.default_rng(seed)
    v, noise = rng.standard_normal((N, 2)), 1e-2 * rng.standard_normal((N, P))
    if slow:
        v[:, 1] = scipy.signal.sosfiltfilt(scipy.signal.cheby2(12, 100, 0.25, output="sos"), v[:, 1])
    u = rng.standard_normal((N, 1))
    clean = v @ rng.standard_normal((2, P)) + u
    return clean + clean.std(axis=0) * noise, u


def both(y: Array, u: Array) -> tuple[JointMoments, JointMoments]:
    """Return the plain moments of a record and the even ones."""
    data = joint_moments([(y, u)], 4, 256)
    arx = arx_of([(y, u)], 1, data.scale)
    assert arx is not None
    return data, even_moments([(y, u)], data, course(data, 1, 4)[-1], arx, np.ones(P))


# Misfits by which plain moments refuse three of the four records below, and even ones one; by those that are set each refuses one.
BY_THE_LAW = [1.6, 3.0]


def test_frequencies_without_a_fault_make_no_degree_needed() -> None:
    """Three quarters of the samples leave a direction to the noise, which is the hard case. A static row is the law, and what rows of
    degree four gain beyond it is less under even moments than under plain ones, if not always nothing."""
    gains, refused = list[tuple[float, float]](), list[tuple[bool, bool]]()
    for seed in range(4):
        data, even = both(*record(seed, slow=True))
        fits = course(data, 1, 4)
        static, long = (refitted(data, (degree,), fits[degree].rows) for degree in (0, 4))
        found = compared_fits(even, fits)
        gains.append((likelihood_ratio(data, static, long), likelihood_ratio(even, found[0], found[4])))
        refused.append((excess(data, static, long, BY_THE_LAW) < 0.01, excess(even, found[0], found[4], BY_THE_LAW) < 0.01))
    assert all(after < before for before, after in gains), gains
    assert sum(one for _, one in refused) < sum(one for one, _ in refused)


def test_where_faults_are_loud_nothing_is_added_but_the_noise_itself() -> None:
    """Of a law both terms are one, so that the level is that of two; a row that is no law is refused as by plain moments."""
    y, u = record(1, slow=False)
    data, even = both(y, u)
    assert even.samples == 2 * data.samples
    fits = course(data, 1, 1)
    law = compared_fits(even, fits)[0]
    assert abs(law.level - np.log(2)) < 0.02
    # That the inputs alone foretell the first output is none.
    zero = evaluated(even, np.array([[1.0, 0.0, 0.0, 0.0]]))
    assert zero > 1000 * evaluated(even, law.rows[0])


def evaluated(data: JointMoments, row: Array) -> float:
    """Return the cost of a static row (1, channels)."""
    power = np.einsum("i,bij,j->b", row[0], data.moments.of_degree(0).moments, row[0]).real
    return float(np.sum(power) / np.sum(row[0, :P] ** 2))


def test_the_slope_is_that_of_the_likelihood_of_faults_that_have_a_spectrum() -> None:
    """tr[W N E N*] / phi + log det(W N Phi^-1 N*) is touched by the cost where the second term is that of the noise: added to the plain
    cost it has the slope of the logarithm, with unequal shares, too."""
    rng = np.random.default_rng(5)
    y, u = record(2, slow=True)
    data = joint_moments([(y, u)], 2, 256)
    arx = arx_of([(y, u)], 1, data.scale)
    assert arx is not None
    shares = np.array([0.5, 1.0, 2.0])
    fit = course(data, 1, 2, shares=shares)[2]
    even = even_moments([(y, u)], data, fit, arx, shares)
    weights, powers = data.moments.weights, np.exp(1j * np.outer(data.moments.angles, np.arange(3)))

    def parts(rows: Array, moments: JointMoments) -> tuple[Array, Array]:
        """Return N S N* of a row (3, 4) under these moments, and N_y lam N_y*, in each band."""
        gains = powers @ rows[:, :P]
        power = np.einsum("i,bij,j->b", rows.ravel(), moments.moments.moments, rows.ravel()).real / weights
        return power, np.einsum("bi,i,bi->b", gains, shares, gains.conj()).real

    at = fit.rows[0]
    plain, size = parts(at, data)
    whole, _ = parts(at, even)
    # What the even moments add at the fit is one in every band, whatever phi there: so phi is told by the two.
    phi = plain / (whole - size)
    assert np.all(phi > 0)

    def added(rows: Array) -> Array:
        """Return W N Phi^-1 N* phi in each band."""
        old, size = parts(rows, data)
        return (parts(rows, even)[0] - old / phi) / size

    np.testing.assert_allclose(added(at), 1.0, rtol=1e-8)
    for _ in range(3):
        step = 1e-5 * rng.standard_normal(at.shape)
        slopes = [np.sum(weights * (change(added(at + step)) - change(added(at - step)))) for change in (np.log, lambda x: x)]
        np.testing.assert_allclose(slopes[0], slopes[1], rtol=1e-4, atol=1e-9)
    assert np.all(added(at + rng.standard_normal(at.shape)) > 0.0)
    assert remainder(data, fit).gains.shape == (len(weights), 1, P)


def test_what_the_model_does_not_foretell() -> None:
    y, u = record(3, slow=False)
    arx = arx_of([(y, u)], 2, np.ones(4))
    assert arx is not None
    h, k = arx.order, 100
    slow = sum(arx.outputs[i] @ y[k - i] - arx.inputs[i] @ u[k - i] for i in range(h + 1))
    np.testing.assert_allclose(one_step_errors(y, u, arx, h)[k - h], slow, atol=1e-12)
