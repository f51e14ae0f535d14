"""python-control: markov by least squares, then eigensys_realization; StateSpace.zeros.

markov has no initial state and takes the impulse response to be over after m samples: it should be long enough for that, and m n_u unknowns
ask for as many samples at least. The package has no normal rank and no infinite zeros: `structure` tells the finite zeros alone.

without_slycot    the same where slycot is not installed, which finds the zeros otherwise: those of square systems alone
"""

from __future__ import annotations

import sys
import warnings
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import control

from ....base.arrays import Array
from ..records import Refused
from ._promises import from_a_state, not_over, not_square

LONGEST = 100


def _taken(samples: int, n_u: int, order: int) -> int:
    """Return the number m of Markov parameters."""
    return max(min(samples // (2 * n_u), LONGEST), 4 * order + 1)


def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """The number m of Markov parameters is two equations an unknown, at most LONGEST, never fewer than eigensys_realization's default
    Hankel matrix takes (the default m, as many as samples, is right for a single input at rest alone).
    """
    n_u, p = u.shape[1], y.shape[1]
    m = _taken(len(u), n_u, order)
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)  # "Not enough data for requested number of parameters"
        try:
            response = control.markov(y.T, u.T, m)
        except UserWarning as warning:
            raise ValueError(str(warning)) from warning
    found, _ = control.eigensys_realization(response.reshape(p, n_u, m), order)
    return found.A, found.B, found.C, found.D


def structure(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    """Return the zeros, found by slycot where that is installed, else of square systems alone."""
    try:
        return {"finite_zeros": [complex(z) for z in control.StateSpace(A, F, C, G, True).zeros()]}
    except NotImplementedError as lacking:
        raise Refused(str(lacking)) from lacking


def _without_slycot(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    # The package imports slycot where it needs it, and takes a module of None for one that is not installed.
    with patch.dict(sys.modules, {"slycot": None}):
        return structure(A, F, C, G)


without_slycot = SimpleNamespace(structure=_without_slycot)
without_slycot.NOT_PROMISED = not_square("zeros of square systems alone")
NOT_PROMISED = not_over(_taken, "markov takes the impulse response to be over after m samples") | from_a_state(
    "markov has no initial state"
)
