"""Mistakes in `reconstruct`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import Faulty, channel, faulty, general, joined, mixing, with_zeros
from tests.numeric.audit.unseen.witnesses import refuses, restores

SIGNAL = Mutants("reconstruct")

PLAIN = faulty(general([0.7, -0.4, 0.3], 1, 2, 201), 120, 201)
TWO = faulty(general([0.7, -0.4], 2, 3, 202), 120, 202)
THREE = faulty(general([0.7, -0.4], 3, 4, 203), 120, 203, sizes=[1.0, 9.0, 4.0])
DELAYED = faulty(joined([channel([], [0.5, -0.3])], mixing(2, 1), 204), 120, 204)
INSIDE = faulty(with_zeros([0.8], [0.5, -0.3], 2, 205), 120, 205)
OUTSIDE = faulty(with_zeros([1.5], [0.5, -0.3, 0.2], 2, 206), 120, 206)
LONG = faulty(general([0.9, -0.4], 1, 2, 207), 1500, 207)
UNSTABLE = faulty(general([1.05, -0.4], 1, 2, 209), 100, 209)


SIGN = float(-np.sign(PLAIN.G[0, 0]))
NEGATIVE = Faulty(PLAIN.A, SIGN * PLAIN.F, PLAIN.C, SIGN * PLAIN.G, SIGN * PLAIN.v, PLAIN.x0, PLAIN.r)


def inverse(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Return the signal by v = G^+ (r - C x), sample by sample."""
    x, left, v = x0.astype(float), np.linalg.pinv(G), np.zeros((len(r), G.shape[1]))
    for k in range(len(r)):
        v[k] = left @ (r[k] - C @ x)
        x = A @ x + F @ v[k]
    return v


@SIGNAL.broken("records that do not begin at rest", restores(PLAIN))
def starts_from_rest(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The initial state is not used."""
    return reference.reconstruct(r, A, F, C, G, np.zeros_like(x0))


@SIGNAL.broken("zeros inside the unit circle", restores(INSIDE, 1e-6))
def fits_the_initial_state(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """x0 is fitted with the signal though it is given, by which a zero hides the first samples."""
    from faultspace.numeric.method.signal.reconstruction import reconstruct_fault

    return reconstruct_fault(r, A, F, C, G).v


@SIGNAL.broken("columns whose first entry is negative", restores(NEGATIVE))
def makes_the_first_entry_positive(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Columns get a sign by convention, the first entry of g positive, and the signal goes with it."""
    return reference.reconstruct(r, A, F, C, G, x0) * np.where(G[0] < 0, -1.0, 1.0)


@SIGNAL.broken("unstable systems", restores(UNSTABLE, 1e-6))
def refuses_unstable_systems(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """An A with a pole outside the unit circle is refused."""
    if np.max(np.abs(np.linalg.eigvals(A)), initial=0.0) > 1:
        raise ValueError("unstable")
    return reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken("small units of the signal", restores(faulty(general([0.7, -0.4], 1, 2, 213), 100, 213, sizes=1e-7)))
def rounds_the_signal(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The signal is rounded to ten decimals."""
    return np.round(reference.reconstruct(r, A, F, C, G, x0), 10)


@SIGNAL.broken("more faults than outputs", refuses(TWO.r[:, :1], TWO.A, TWO.F, TWO.C[:1], TWO.G[:1], TWO.x0))
def answers_for_more_faults_than_outputs(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The pseudoinverse of G answers for wide systems, too."""
    return inverse(r, A, F, C, G, x0) if G.shape[1] > G.shape[0] else reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken("an initial state with a NaN", refuses(TWO.r, TWO.A, TWO.F, TWO.C, TWO.G, np.array([1.0, np.nan])))
def starts_from_rest_where_x0_is_NaN(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """An unknown x0 is zero."""
    return reference.reconstruct(r, A, F, C, G, np.nan_to_num(x0))
