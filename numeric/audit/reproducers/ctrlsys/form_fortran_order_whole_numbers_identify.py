"""form-fortran-order[whole-numbers]-identify: a wrong answer for the same numbers: fortran-order.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'form-fortran-order[whole-numbers]-identify' --language
python
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

# -- how ctrlsys (SLICOT in C): ib01ad, ib01bd; ab08nd is called
Array = object
from types import SimpleNamespace


def ZeroStructure(rank, zeros, orders, invertible):
    return SimpleNamespace(normal_rank=rank, finite_zeros=zeros, infinite_zero_orders=orders, left_invertible=invertible)
from types import SimpleNamespace


def ZeroStructure(rank, zeros, orders, invertible):
    return SimpleNamespace(normal_rank=rank, finite_zeros=zeros, infinite_zero_orders=orders, left_invertible=invertible)
from collections.abc import Sequence
from typing import Any
import numpy as np
import scipy.linalg


def structure_of(nu: int, rank: int, infz: Sequence[int], Af: Any, Bf: Any, inputs: int) -> ZeroStructure:
    """Finite zeros are the eigenvalues of the pencil (Af, Bf), which is left to the caller of AB08ND. infz[i] infinite zeros have the order
    i + 1; as many as the rank leaves over have the order 0, which AB08ND does not list.
    """
    zeros = scipy.linalg.eigvals(Af[:nu, :nu], Bf[:nu, :nu]) if nu else np.zeros(0)
    orders = [i + 1 for i, count in enumerate(infz) for _ in range(int(count))]
    return ZeroStructure(int(rank), [complex(z) for z in zeros], [0] * (int(rank) - len(orders)) + orders, int(rank) == inputs)

from types import SimpleNamespace
from typing import Any
import ctrlsys
import numpy as np
SINGULAR = (3, 4, 5)


def _identified(y: Array, u: Array, order: int, block_rows: int, method: str, for_matrices: str) -> tuple[Any, Any, Any, Any]:
    outputs, inputs = np.asfortranarray(y), np.asfortranarray(u)
    n_u, p = u.shape[1], y.shape[1]
    _, factor, _, warning, info = ctrlsys.ib01ad("M", "C", for_matrices, "O", "N", "N", block_rows, n_u, p, inputs, outputs, 0.0, -1.0)
    if info != 0 or warning in SINGULAR:
        raise ValueError(f"ib01ad: info {info}, warning {warning}")
    A, C, B, D, *_, warning, info = ctrlsys.ib01bd(method, "A", "N", block_rows, order, n_u, p, len(y), np.asfortranarray(factor), 0.0)
    if info != 0 or warning == 4:  # a least-squares problem with a rank-deficient matrix
        raise ValueError(f"ib01bd: info {info}, warning {warning}")
    return A, B, C, D



def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """info other than 0, and warnings that say the problem is singular, are refusals."""
    return _identified(y, u, order, block_rows, "M", "M")



def _combined(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _identified(y, u, order, block_rows, "C", "N")

combined = SimpleNamespace(identify=_combined)


def structure(A: Array, F: Array, C: Array, G: Array) -> ZeroStructure:
    """It is called without scaling, at the default tolerance."""
    n, m = len(A), F.shape[1]
    matrices = (np.asfortranarray(M) for M in (A, F, C, G))
    nu, rank, dinfz, _, _, infz, _, _, Af, Bf, info = ctrlsys.ab08nd("N", n, m, len(C), *matrices, 0.0)
    if info != 0:
        raise ValueError(f"ab08nd: info {info}")
    return structure_of(nu, rank, infz[:dinfz], Af, Bf, m)

# -- the question
y = np.array([
    [-30.0, -2.0, 17.0], [28.0, -4.0, -40.0], [-74.0, -50.0, 101.0], [53.0, 89.0, -103.0], [4.0, -8.0, -8.0], [-41.0, -61.0,
    67.0], [-6.0, 14.0, 1.0], [48.0, 36.0, -67.0], [-26.0, -58.0, 58.0], [-30.0, 6.0, 34.0], [71.0, 75.0, -112.0], [-63.0, -35.0,
    79.0], [30.0, 34.0, -59.0], [-12.0, -48.0, 31.0], [-38.0, -30.0, 58.0], [40.0, 68.0, -72.0], [11.0, 7.0, -18.0], [-53.0,
    -21.0, 60.0], [52.0, 36.0, -81.0], [-73.0, -41.0, 94.0], [62.0, 58.0, -101.0], [-66.0, -30.0, 80.0], [41.0, 57.0, -82.0],
    [-16.0, -44.0, 30.0], [-23.0, -55.0, 51.0], [23.0, -9.0, -9.0], [5.0, -3.0, 12.0], [34.0, 14.0, -31.0], [0.0, -36.0, 28.0],
    [-3.0, -23.0, 27.0], [36.0, 4.0, -26.0], [-4.0, -28.0, 33.0], [19.0, 3.0, -8.0], [20.0, -8.0, -5.0], [-18.0, -10.0, 35.0],
    [49.0, 29.0, -60.0], [-53.0, -21.0, 71.0], [77.0, 41.0, -104.0], [-67.0, -95.0, 122.0], [39.0, 11.0, -37.0], [-18.0, 14.0,
    26.0], [44.0, 76.0, -83.0], [-1.0, -29.0, 7.0], [-52.0, -68.0, 85.0], [9.0, 45.0, -28.0], [67.0, 31.0, -86.0], [-97.0, -73.0,
    140.0], [76.0, 80.0, -122.0], [-21.0, -49.0, 46.0], [-23.0, -31.0, 42.0], [42.0, 14.0, -44.0], [-19.0, -31.0, 46.0], [23.0,
    19.0, -25.0], [2.0, 6.0, 1.0], [2.0, 10.0, -6.0], [-14.0, 18.0, 3.0], [31.0, 15.0, -48.0], [-40.0, -68.0, 73.0], [14.0, -14.0,
    -2.0], [-7.0, 13.0, 13.0]
])
y = np.asfortranarray(y)
u = np.array([
    [7.0], [-8.0], [6.0], [9.0], [-3.0], [-5.0], [5.0], [-3.0], [-8.0], [9.0], [1.0], [7.0], [1.0], [-9.0], [2.0], [7.0], [-1.0],
    [8.0], [-4.0], [8.0], [-1.0], [9.0], [4.0], [-7.0], [-8.0], [-8.0], [-2.0], [-5.0], [-9.0], [-5.0], [-8.0], [-6.0], [-4.0],
    [-7.0], [2.0], [-5.0], [8.0], [-9.0], [-7.0], [-7.0], [8.0], [8.0], [-7.0], [-4.0], [9.0], [-9.0], [6.0], [1.0], [-7.0],
    [-2.0], [-7.0], [-3.0], [-1.0], [1.0], [2.0], [8.0], [-4.0], [-7.0], [-7.0], [5.0]
])
order = 3
block_rows = 4

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [-2.0], [2.0], [1.0], [4.0], [4.0], [-7.0], [-5.0], [-5.0], [7.0], [1.0], [1.0], [-2.0], [0.0], [0.0], [0.0], [0.0], [0.0],
    [0.0], [0.0], [0.0], [0.0], [0.0], [0.0], [0.0]
])
bound = np.array([
    [3e-08], [3e-08], [4.5e-08], [2.2e-08], [2.2e-08], [3.3e-08], [2.4e-08], [2.4e-08], [3.5e-08], [1.3e-08], [1.3e-08],
    [1.9e-08], [3.6e-09], [3.5e-09], [5.3e-09], [1.3e-09], [1.2e-09], [1.9e-09], [1.8e-10], [1.8e-10], [2.6e-10], [1.2e-24],
    [1.2e-24], [1.8e-24]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [-2.0], [2.0], [-1.0]
])
bound = np.array([
    [6.1e-08], [6.1e-08], [9.1e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [-12.0], [-8.0], [17.0]
])
bound = np.array([
    [7.3e-08], [7.3e-08], [1.1e-07]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [-1.125], [2.875], [-1.0]
])
bound = np.array([
    [4.3e-08], [4.2e-08], [6.3e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0.0], [0.0], [0.0]
])
bound = np.array([
    [7.3e-10], [3.3e-10], [9e-11]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0j], [0j], [0j]
])
bound = np.array([
    [0.00049], [0.00049], [0.00049]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
