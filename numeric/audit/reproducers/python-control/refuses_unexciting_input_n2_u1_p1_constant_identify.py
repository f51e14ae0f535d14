"""refuses-unexciting-input[n2-u1-p1-constant]-identify: one of many models that fit, without a word.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-unexciting-input[n2-u1-p1-constant]-identify'
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
y = np.array([
    [-18.47142857142857], [53.82857142857143], [54.05357142857143], [38.43482142857143], [24.71919642857143],
    [16.134626116071427], [11.623420061383928], [9.553989519391742], [8.730064119611468], [8.46181732586452], [8.407335062537875],
    [8.418342068259205], [8.439891193368073], [8.456338895336792], [8.466016763441855], [8.470886963228129], [8.473031354393136],
    [8.473842340459269], [8.47408286769979], [8.47411592583328], [8.47409223636622], [8.47406427661584], [8.474044993905178],
    [8.474034237728745], [8.474029044167322], [8.474026852714672], [8.474026071285165], [8.474025866914614], [8.474025859028085],
    [8.474025896833432], [8.474025931638288], [8.474025953822617], [8.474025965620344], [8.474025971090532], [8.474025973296193],
    [8.474025974029544], [8.474025974188738], [8.474025974167612], [8.474025974114301], [8.474025974072278], [8.474025974047168],
    [8.47402597403439], [8.474025974028702], [8.47402597402652], [8.474025974025855], [8.47402597402575], [8.474025974025805],
    [8.474025974025874], [8.474025974025924], [8.474025974025952], [8.474025974025965], [8.474025974025972], [8.474025974025974],
    [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974],
    [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974],
    [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974],
    [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974], [8.474025974025974],
    [8.474025974025974], [8.474025974025974], [8.474025974025974]
])
u = np.array([
    [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5],
    [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5],
    [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5],
    [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5],
    [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5], [1.5]
])
order = 2
block_rows = 4

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit(0)  # right: there is nothing to answer

print('WRONG: answered where a refusal is due')
print('  got', answer)
failed = True

sys.exit(1 if failed else 0)
