"""refuses-shapes[two-faults]-structure: matrices of another system are taken for those of the residual.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-shapes[two-faults]-structure' --language
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
A = np.array([
    [0.1875, 0.3125, -0.75], [-0.5625, 0.125, 0.5], [0.0, 0.0, 0.0625]
])
F = np.array([
    [-2.6666666666666665, -1.6666666666666667], [2.6666666666666665, -1.6666666666666667]
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

print('WRONG: answered where a refusal is due')
print('  got', answer)
failed = True

sys.exit(1 if failed else 0)
