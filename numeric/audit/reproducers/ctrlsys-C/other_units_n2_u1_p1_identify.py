"""other-units[n2-u1-p1]-identify: the answer depends on the units of the channels.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'other-units[n2-u1-p1]-identify' --language python
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

# -- how ctrlsys: ib01bd with METH = C (B and D by N4SID) is called
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
identify = combined.identify

# -- the question
y = np.array([
    [-2.34e-05], [3.8347619047619044e-05], [3.733690476190476e-05], [2.0264285714285714e-05], [9.897730654761905e-06],
    [3.2404994419642857e-06], [-5.052012997581845e-06], [-1.1771037292480469e-05], [-1.2824291692461287e-05],
    [-1.1628781299364e-05], [-6.276417448265212e-06], [3.4688949277181e-06], [8.020154140466115e-06], [1.2087683155088563e-05],
    [1.0377075947237435e-05], [1.2122665525561895e-05], [1.1461751733313231e-05], [3.856961587694317e-06],
    [-2.439857278620218e-06], [-6.392573561338918e-06], [-1.2440092769495708e-06], [5.098260206354871e-06],
    [6.7518547098932306e-06], [9.545604641492639e-06], [5.805495367326439e-06], [3.000636002512691e-06],
    [-4.1390384665469115e-06], [-1.1315845402825818e-05], [-4.243271491486882e-06], [4.759800055388554e-06],
    [5.09006449675155e-06], [1.0255159696350884e-05], [9.577372649452146e-06], [-1.1491270200680332e-06],
    [1.6699993046585284e-06], [4.434942355787523e-06], [-1.113309215151399e-06], [-1.0521967775014565e-05],
    [-6.329852078990044e-06], [2.299369405477672e-06], [-7.229289485070822e-06], [-8.546174880694735e-06],
    [2.6752302447275406e-06], [-6.280906378542861e-07], [-1.1734190686061411e-05], [-9.692819642320729e-06],
    [1.9213513112595813e-06], [5.270534313157413e-06], [2.7048147818175597e-06], [-4.949014065960439e-06],
    [-1.6324822079046415e-06], [5.486020133107523e-06], [-5.589959481708249e-07], [-5.6972240730524566e-06],
    [-8.737790700258532e-06], [-1.0206441953888847e-05], [-6.806447374923569e-06], [-2.115244180406842e-06],
    [5.7773574196942584e-06], [-2.9118644980654322e-06], [-4.400071228508229e-06], [5.2255985101975885e-06],
    [5.771521420516208e-06], [3.159064902179293e-06], [4.289161478668961e-06], [-2.94725534399257e-06], [2.394504643404809e-06],
    [2.420558431382344e-06], [6.359071689095702e-06], [-5.372452286049006e-06], [-1.3425276015615899e-05],
    [-9.443023528471644e-06], [1.1797883029080518e-06], [4.8979761618977175e-06], [1.011068616468508e-05],
    [4.6602395372557485e-06], [-1.6042410986641768e-06], [5.421504497037008e-06], [4.069148937144932e-06], [5.97752740175116e-06]
])
u = np.array([
    [-2333333.3333333335], [-1000000.0], [-2000000.0], [-1000000.0], [-333333.3333333333], [-1333333.3333333333],
    [-2666666.6666666665], [-2333333.3333333335], [-2000000.0], [-1666666.6666666667], [1333333.3333333333], [1000000.0],
    [2666666.6666666665], [1333333.3333333333], [2000000.0], [2666666.6666666665], [333333.3333333333], [-333333.3333333333],
    [-1666666.6666666667], [-333333.3333333333], [1666666.6666666667], [666666.6666666666], [2333333.3333333335],
    [666666.6666666666], [666666.6666666666], [-333333.3333333333], [-3000000.0], [-1000000.0], [2000000.0], [333333.3333333333],
    [1666666.6666666667], [3000000.0], [-1666666.6666666667], [333333.3333333333], [1333333.3333333333], [333333.3333333333],
    [-2666666.6666666665], [-2000000.0], [2333333.3333333335], [-1666666.6666666667], [-3000000.0], [1666666.6666666667],
    [666666.6666666666], [-3000000.0], [-2666666.6666666665], [1333333.3333333333], [1000000.0], [1000000.0],
    [-1666666.6666666667], [-1000000.0], [2333333.3333333335], [-333333.3333333333], [-1333333.3333333333], [-1333333.3333333333],
    [-2333333.3333333335], [-666666.6666666666], [-1333333.3333333333], [2666666.6666666665], [-1000000.0], [-2000000.0],
    [1666666.6666666667], [1666666.6666666667], [-666666.6666666666], [2333333.3333333335], [-2333333.3333333335],
    [1666666.6666666667], [-666666.6666666666], [2666666.6666666665], [-1333333.3333333333], [-3000000.0], [-2333333.3333333335],
    [1333333.3333333333], [333333.3333333333], [2333333.3333333335], [1333333.3333333333], [-2000000.0], [2000000.0],
    [666666.6666666666], [333333.3333333333], [3000000.0]
])
order = 2
block_rows = 4

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [1.2857142857142857e-12], [3.2e-12], [1.1e-12], [2.625e-13], [-1.09375e-14], [-6.69921875e-14]
])
bound = np.array([
    [6.4e-21], [6.4e-21], [5e-21], [4.3e-21], [2.9e-21], [1.6e-21]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [5.649350649350649e-12]
])
bound = np.array([
    [2.2e-20]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [-1.0545842217484008e-12]
])
bound = np.array([
    [1.2e-20]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [3.189511754068716e-12]
])
bound = np.array([
    [1e-20]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [-0.875], [0.21875]
])
bound = np.array([
    [2.6e-10], [1.6e-10]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(0.4375-0.16535945694153692j)], [(0.4375+0.16535945694153692j)]
])
bound = np.array([
    [3.4e-10], [3.4e-10]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
