"""This calls slycot: ab08nd, SLICOT's normal rank, finite zeros and infinite zeros."""

from __future__ import annotations

import slycot

from ....base.arrays import Array
from ..adapter import ZeroStructure
from ._slicot import structure_of


def structure(A: Array, F: Array, C: Array, G: Array) -> ZeroStructure:
    """Return the zeros as the package finds them by default: no scaling, its own tolerance."""
    n, m = len(A), F.shape[1]
    try:
        nu, rank, dinfz, _, _, infz, _, _, Af, Bf = slycot.ab08nd(n, m, len(C), A, F, C, G)
    except Exception as error:
        if type(error).__module__ != "_wrapper":
            raise
        raise ValueError(str(error)) from error  # f2py's class for arguments of the wrong shape, which no module exports
    return structure_of(nu, rank, infz[:dinfz], Af, Bf, m)
