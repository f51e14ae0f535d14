"""These bounds of rounding are for the 50 digits, and no command needs them: they follow from those of `rounding`.

noisy_range             the bound on |D|, the change of the range, for any data                         [W72]
given_state_error       |r - exact r|, the initial state given: what simulation loses
singular_value_error    |sigma - exact sigma| <= |E|_F for every singular value of R_s                  [GVL13, corollary 8.6.2]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from faultspace.numeric.method.model.compression import EPS
from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix
from faultspace.numeric.study.conditioning import SMALL, UNIT, BackwardError, Setting, reflections_error, state_norm
from faultspace.numeric.study.residual_conditioning import simulation_error

Array = NDArray[np.float64]


def noisy_range(where: Setting, backward: BackwardError) -> float:
    """Return the bound on |D| for any data: what floats and exact arithmetic make of the same windows."""
    others = np.hstack([where.part("y", "f"), where.part("y", "y")])
    beyond = where.values[where.n] if len(where.values) > where.n else 0.0
    rounding = SMALL * len(where.U) * EPS * where.values[0]
    moved = backward.outputs + np.sqrt(2.0) * np.linalg.norm(others, 2) * backward.turn + rounding
    return float(moved / (where.values[where.n - 1] - beyond))


def given_state_error(y: Array, u: Array, model: StateSpaceModel, x0: Array) -> float:
    """Return the bound on |r - exact r| for `residual(y, u, model, x0=x0)`, y (N, p), u (N, n_u), x0 (n,)."""
    free = np.linalg.norm(observability_matrix(model.A, np.eye(model.n), len(u)))
    of_start = float(free * UNIT * np.linalg.norm(x0) * np.linalg.norm(model.C))
    return simulation_error(model, y, u, state_norm(model, u, x0)) + of_start


def singular_value_error(values: Array, columns: int) -> float:
    """Return the bound on the error of every one of the singular values (s p,) of R_s with so many columns, samples correctly rounded."""
    width = len(values)
    return float((UNIT + reflections_error(width, columns) + SMALL * width * EPS) * np.linalg.norm(values))
