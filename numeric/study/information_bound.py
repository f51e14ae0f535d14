"""Compute the Cramer-Rao bound of A, B, C, D under a coloured Gaussian disturbance, which no unbiased estimate from N samples beats.

With plant G, input spectrum P and disturbance spectrum Phi, faults and noise together, the information of N samples about
T = [[A, B], [C, D]] is, but for end effects of order one [W53, L99 ch. 9.4],

    J = N / (2 pi)  integral over (-pi, pi) of  Re tr( Phi^-1 dG P dG* ) dw,

whether Phi is known or has parameters of its own: in open loop those are orthogonal to T. J is singular along changes of the state basis
and nowhere else for a minimal model and an input that excites it; what depends on the basis has no bound.

cramer_rao      the bound as an Uncertainty: standard deviations of Markov parameters, transfer function, poles
settled, stable    the integral over the angles; the refusal of a model that is not stable
relative_error  |first Markov parameters - true ones| over the root of their bound's trace: about one for an efficient estimate
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.threads import one_thread
from ..data.validation import positive
from ..method.model.invariants import system_matrix
from ..method.model.models import StateSpaceModel
from ..method.model.uncertainty import Uncertainty, uncertainty_of
from ..method.model.weighted_reduction import Reduction, circle, spectral_radius
from .driving_spectra import Spectra

COARSE, FINE = 128, 1 << 15
SAME_INTEGRAL = 1e-6  # relative change of the information that twice the angles may make
COUNT = 20


@one_thread()
def cramer_rao(model: StateSpaceModel, spectra: Spectra, N: int) -> Uncertainty:
    """Compute the least standard deviations of an unbiased estimate of a stable, minimal model from N samples [W53].

    Angles are doubled until the information matrix stays the same.

    Parameters
    ----------
    model : StateSpaceModel
    spectra : Spectra
        Of the input (M, n_u, n_u), and of the disturbance (M, p, p), faults and noise, in the squared units of u and y.
    N : int
        Number of samples.

    Returns
    -------
    Uncertainty
        Of Markov parameters, transfer function and poles, in the units of y / u.

    Raises
    ------
    InvalidData
        A model that is not stable, spectra that do not fit it, a disturbance without power in some direction.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import Spectra, StateSpaceModel, cramer_rao
    >>> from faultspace.numeric.study.driving_spectra import white
    >>> static = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), [[2.0]])
    >>> cramer_rao(static, Spectra(white([[4.0]]), white([[1.0]])), 100).markov(1).tolist()
    [[[0.05]]]
    """
    samples = positive(N, "N")
    stable(model)
    return uncertainty_of(model, settled(partial(_information, model, spectra, samples)))


def stable(model: StateSpaceModel) -> None:
    """Raise InvalidData for a model that is not."""
    if spectral_radius(model.A) >= 1:
        raise InvalidData(
            f"the model is not stable: its poles reach modulus {spectral_radius(model.A):.6g}; a bound for N samples needs less than 1"
        )


def settled(information: Callable[[int], Array]) -> Array:
    """Return the information matrix from so many angles that twice as many leave it the same, FINE at most."""
    before, count = information(COARSE), 2 * COARSE
    while count <= FINE:
        now = information(count)
        if np.max(np.abs(now - before)) <= SAME_INTEGRAL * np.max(np.abs(now)):
            return now
        before, count = now, 2 * count
    return before


def relative_error(estimate: StateSpaceModel, truth: StateSpaceModel, bound: Uncertainty, count: int = COUNT) -> float:
    """Return the Frobenius norm of the error of the first `count` Markov parameters (count, p, n_u) over that of their least deviations.

    The two models may have different orders and need the same channels.
    """
    error = np.linalg.norm(estimate.markov(count) - truth.markov(count))
    return float(error / np.linalg.norm(bound.markov(count)))


def _information(model: StateSpaceModel, spectra: Spectra, samples: int, count: int) -> Array:
    angles = circle(count)
    disturbance, driven = spectra.disturbance(angles), spectra.input(angles)
    for name, spectrum, size in (("disturbance", disturbance, model.p), ("input", driven, model.n_u)):
        if spectrum.shape != (count, size, size):
            raise InvalidData(
                f"the spectrum of the {name} has shape {spectrum.shape} at {count} angles, the model needs {(count, size, size)}"
            )
    try:
        root = np.linalg.inv(np.linalg.cholesky(disturbance))
    except np.linalg.LinAlgError:
        raise InvalidData(
            "the disturbance has no power in some direction at some angle, so that an estimate could be exact and "
            "there is no bound; a disturbance in every direction is needed"
        ) from None
    weight = np.conj(np.swapaxes(root, 1, 2)) @ root
    # The plant of the reduction does not matter for the information.
    reduction = Reduction(angles, np.zeros((count, model.p, model.n_u), dtype=np.complex128), weight, driven, samples)
    return reduction.information(system_matrix(model), model.n)
