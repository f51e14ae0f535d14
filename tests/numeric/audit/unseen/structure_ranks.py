"""Mistakes in `structure`: normal rank, infinite zeros, left-invertibility, matrices that must be refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import Matrices, channel, joined
from tests.numeric.audit.unseen.witnesses import has_structure

RANKS = Mutants("structure")

STATIC = (np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[1.0], [2.0]]))
_A, _F, _C, _G = joined([channel([0.5], [0.3, 0.2]), channel([], [0.4, -0.5, 0.1])], [[1.0, 1.0], [0.0, 1.0]], 321)
# Both faults come through the first channel, at the same sample: [G, C F] has rank one, though the system is invertible.
SHARED = (_A, _F @ np.array([[1.0, 1.0], [0.0, 1.0]]), _C, _G)


def at(matrices: Matrices, q: complex) -> Any:
    """Return the transfer function at q."""
    A, F, C, G = matrices
    return C @ np.linalg.solve(q * np.eye(len(A)) - A, F.astype(complex)) + G


@RANKS.broken("systems without states", has_structure(STATIC, [], [0]))
def needs_a_state(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """The largest pole is asked for, which a system without states has not."""
    np.max(np.abs(np.linalg.eigvals(A)))
    return reference.structure(A, F, C, G)
