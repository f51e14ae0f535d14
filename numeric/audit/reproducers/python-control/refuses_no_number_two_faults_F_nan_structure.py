"""refuses-no-number[two-faults-F-nan]-structure: an answer about no numbers.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-no-number[two-faults-F-nan]-structure'
--language python
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
    [0.1875, 0.3125, -0.75], [-0.5625, 0.125, 0.5], [0.0, 0.0, 0.0625]
])
F = np.array([
    [-2.6666666666666665, -1.6666666666666667], [2.6666666666666665, np.nan], [2.0, 0.3333333333333333]
])
C = np.array([
    [0.2, -1.6, -1.6], [1.4, -0.4, 0.4], [0.2, 0.8, -1.4]
])
G = np.array([
    [-1.0, 1.2857142857142858], [-1.2857142857142858, -0.8571428571428571], [0.42857142857142855, 0.7142857142857143]
])

try:
    answer = structure(A, F, C, G)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit(0)  # right: there is nothing to answer

print('WRONG: answered where no answer can be right')
print('  got', answer)
failed = True

sys.exit(1 if failed else 0)
