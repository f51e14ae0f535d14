"""exact-recovery[n2-u1-p1]-identify: the model is wrong although the data determine it: every prediction and every residual made with it.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery[n2-u1-p1]-identify' --language python
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
    [-23.4], [38.34761904761905], [37.33690476190476], [20.264285714285716], [9.897730654761904], [3.240499441964286],
    [-5.052012997581845], [-11.771037292480468], [-12.824291692461287], [-11.628781299363999], [-6.276417448265212],
    [3.4688949277181003], [8.020154140466115], [12.087683155088563], [10.377075947237435], [12.122665525561894],
    [11.46175173331323], [3.8569615876943173], [-2.439857278620218], [-6.392573561338918], [-1.2440092769495708],
    [5.098260206354871], [6.75185470989323], [9.54560464149264], [5.805495367326439], [3.0006360025126906], [-4.1390384665469115],
    [-11.315845402825818], [-4.243271491486882], [4.759800055388554], [5.09006449675155], [10.255159696350884],
    [9.577372649452146], [-1.1491270200680332], [1.6699993046585284], [4.434942355787523], [-1.1133092151513988],
    [-10.521967775014566], [-6.329852078990044], [2.299369405477672], [-7.229289485070822], [-8.546174880694734],
    [2.6752302447275405], [-0.628090637854286], [-11.734190686061412], [-9.69281964232073], [1.9213513112595815],
    [5.2705343131574125], [2.7048147818175594], [-4.949014065960438], [-1.6324822079046415], [5.486020133107523],
    [-0.5589959481708249], [-5.697224073052457], [-8.737790700258532], [-10.206441953888847], [-6.806447374923569],
    [-2.115244180406842], [5.777357419694258], [-2.911864498065432], [-4.400071228508229], [5.225598510197589],
    [5.771521420516208], [3.159064902179293], [4.2891614786689605], [-2.94725534399257], [2.394504643404809],
    [2.4205584313823443], [6.3590716890957015], [-5.372452286049006], [-13.425276015615898], [-9.443023528471644],
    [1.1797883029080518], [4.897976161897717], [10.110686164685081], [4.660239537255748], [-1.6042410986641769],
    [5.421504497037008], [4.0691489371449325], [5.977527401751161]
])
u = np.array([
    [-2.3333333333333335], [-1.0], [-2.0], [-1.0], [-0.3333333333333333], [-1.3333333333333333], [-2.6666666666666665],
    [-2.3333333333333335], [-2.0], [-1.6666666666666667], [1.3333333333333333], [1.0], [2.6666666666666665], [1.3333333333333333],
    [2.0], [2.6666666666666665], [0.3333333333333333], [-0.3333333333333333], [-1.6666666666666667], [-0.3333333333333333],
    [1.6666666666666667], [0.6666666666666666], [2.3333333333333335], [0.6666666666666666], [0.6666666666666666],
    [-0.3333333333333333], [-3.0], [-1.0], [2.0], [0.3333333333333333], [1.6666666666666667], [3.0], [-1.6666666666666667],
    [0.3333333333333333], [1.3333333333333333], [0.3333333333333333], [-2.6666666666666665], [-2.0], [2.3333333333333335],
    [-1.6666666666666667], [-3.0], [1.6666666666666667], [0.6666666666666666], [-3.0], [-2.6666666666666665],
    [1.3333333333333333], [1.0], [1.0], [-1.6666666666666667], [-1.0], [2.3333333333333335], [-0.3333333333333333],
    [-1.3333333333333333], [-1.3333333333333333], [-2.3333333333333335], [-0.6666666666666666], [-1.3333333333333333],
    [2.6666666666666665], [-1.0], [-2.0], [1.6666666666666667], [1.6666666666666667], [-0.6666666666666666], [2.3333333333333335],
    [-2.3333333333333335], [1.6666666666666667], [-0.6666666666666666], [2.6666666666666665], [-1.3333333333333333], [-3.0],
    [-2.3333333333333335], [1.3333333333333333], [0.3333333333333333], [2.3333333333333335], [1.3333333333333333], [-2.0], [2.0],
    [0.6666666666666666], [0.3333333333333333], [3.0]
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
    [1.2857142857142858], [3.2], [1.1], [0.2625], [-0.0109375], [-0.0669921875]
])
bound = np.array([
    [6.4e-09], [6.4e-09], [5e-09], [4.3e-09], [2.9e-09], [1.6e-09]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [5.64935064935065]
])
bound = np.array([
    [2.2e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [-1.054584221748401]
])
bound = np.array([
    [1.2e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [3.189511754068716]
])
bound = np.array([
    [1e-08]
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
