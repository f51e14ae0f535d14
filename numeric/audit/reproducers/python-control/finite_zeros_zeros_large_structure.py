"""finite-zeros[zeros-large]-structure: faults that no output shows are missed, or seen where there are none.

How it is compared: As many as there are true ones. Pair each true number with one of the answer's, so that
none is used twice and the sum of distances is least; each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'finite-zeros[zeros-large]-structure' --language python
"""

import base64
import sys
import zlib

import numpy as np

failed = False


def told(what, got, expected, off, bound):
    """Print one comparison; `off` and `bound` are arrays of one shape or numbers."""
    global failed
    off, bound = (np.atleast_1d(np.asarray(one, dtype=float)) for one in (off, bound))
    wrong = bool(np.any(~(off <= bound)))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(off == 0, 0.0, off / bound)
    failed = failed or wrong
    print(f"{what}: {'WRONG' if wrong else 'right'}")
    print("  got     ", np.array2string(np.asarray(got), threshold=40, prefix="  got      "))
    print("  expected", np.array2string(np.asarray(expected), threshold=40, prefix="  expected "))
    print(f"  off by {np.max(off, initial=0.0):.3g}, largest ratio to the bound {np.max(ratio, initial=0.0):.3g}")


def nearest(got, expected):
    """The numbers of `got` in the order of those of `expected` that they are nearest to; NaN where one is missing."""
    left, found = list(np.asarray(got, dtype=complex)), []
    for z in expected:
        found.append(left.pop(int(np.argmin(np.abs(np.array(left) - z)))) if left else np.nan)
    return np.array(found + ([np.nan] if left else []), dtype=complex)


def sine(got, expected):
    """The sine of the largest angle between the spaces of the columns, 1 where their dimensions differ."""
    spaces = []
    for columns in (got, expected):
        U, s, _ = np.linalg.svd(columns / (np.max(np.abs(columns), initial=0.0) or 1.0), full_matrices=False)
        spaces.append(U[:, s > 1e-12 * max(s, default=0.0)])
    P, Q = spaces
    return 1.0 if P.shape != Q.shape else np.linalg.norm(P - Q @ (Q.T @ P), 2)

# -- how python-control: markov, eigensys_realization; StateSpace.zeros is called
Array = object
class Refused(ValueError):
    pass
import sys
import warnings
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch
import control
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

# -- the question
A = np.array([
    [0.0, -1.0, 0.0, 1.0], [-128.0, -514.0, 0.0, 513.5], [-128.25, -511.25, 0.5, 511.5], [-127.75, -514.0, 0.0, 513.5]
])
F = np.array([
    [0.0], [-2.0], [-2.0], [-1.0]
])
C = np.array([
    [29.125, 129.625, -1.5, -128.125], [-62.25, -256.75, 1.5, 256.25], [98.875, 383.375, 1.5, -384.375]
])
G = np.array([
    [0.5], [-1.0], [1.5]
])

try:
    answer = structure(A, F, C, G)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [(0.25+0j)], [(256+0j)]
])
bound = np.array([
    [7.6e-11], [2e-08]
])
field = (lambda name: answer[name]) if isinstance(answer, dict) else (lambda name: getattr(answer, name))
got = field('finite_zeros')
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('number of finite zeros', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
