"""A model of order n from an ARX model alone, in milliseconds: a start for what is fitted afterwards, and no estimate to report.

The realisations of the ARX plant's Markov parameters [HK66, K78] that `reduction_starts.py` begins from are compared under the ARX model's
own weight, and the best is improved by few steps of the weighted reduction at few angles, the input taken for white. `arx_reduction`
climbs a ladder of weights instead, from more starts.

quick_reduction     the StateSpaceModel, in the units of the ARX model
"""

from __future__ import annotations

import numpy as np

from ....base.errors import InvalidData
from .arx import Arx
from .invariants import state_space
from .models import StateSpaceModel
from .reduction_starts import realisations
from .weighted_reduction import Reduction, circle, descend

ANGLES = 32
STEPS, GAIN = 25, 1e-2  # of a descent that only makes a start: at most so many, until one gains no more than such a share


def quick_reduction(arx: Arx, n: int) -> StateSpaceModel:
    """Return a stable model of order n. Raises InvalidData where the ARX model shows no dynamics to begin from."""
    angles = circle(ANGLES)
    n_u = arx.inputs.shape[2]
    white = np.broadcast_to(np.eye(n_u, dtype=np.complex128), (ANGLES, n_u, n_u))
    problem = Reduction(angles, arx.plant(angles), arx.weight(angles), white, arx.rows)
    begun = sorted(realisations(arx, problem, n, arx.order), key=lambda start: problem.cost(start, n))
    if not begun:
        raise InvalidData(f"no model of order {n} can be begun from this ARX model: try another order")
    return state_space(descend(problem, begun[0], n, STEPS, GAIN)[0], n)
