"""far-units[n2-u1-p2]-identify: an output in large units is lost.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'far-units[n2-u1-p2]-identify' --language python
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
    [-13.17142857142857, 4.2066666666666665e-07], [-7.967460317460318, -2.3283333333333332e-07], [2.5131448412698414,
    3.8295138888888886e-08], [-2.8687841021825395, 6.367469618055556e-08], [-5.417957705543155, -1.320587429470486e-07],
    [1.6432005503820994, -6.837361229790581e-08], [2.536778193428403, 1.0345683908462524e-07], [2.3715227242973116,
    -4.217966660857201e-08], [1.8669460259525785, 1.2976955109607015e-07], [0.6817028324350729, -7.783825799857732e-08],
    [5.474805442571729, 7.945679965560056e-08], [-1.4539855625143951, 1.2580215355400958e-07], [-0.16876032350768008,
    -1.817667033257845e-07], [1.849766627740013, 1.8813746442082566e-07], [-0.6183791260511317, -1.4465654564064925e-07],
    [3.9234115280243222, 1.1885605737324267e-07], [-1.8970848651847825, 2.2147294444089846e-08], [-3.531750941979619,
    -5.743677040711798e-08], [0.396034106245574, -7.119088194249827e-08], [3.674261466821321, 5.7655943285832766e-08],
    [1.7708040990354532, 5.514087976560239e-08], [3.878082231816578, -1.7805828687988064e-08], [1.3657847056368877,
    1.6076974692436338e-07], [-3.6065133947238164, -9.470426932265311e-08], [2.9403202002605435, -4.112921104972025e-08],
    [-1.0395351417899623, 1.55487297502222e-07], [-2.36548818484752, -1.930805112233148e-07], [-0.8913321681769989,
    1.4050837797405787e-07], [-5.150463633193038, -1.6245288572834482e-07], [4.165742791174266, -3.960775208838575e-08],
    [1.6922451030214254, 1.717463912088258e-07], [-6.253938695198567, -7.787424921018273e-08], [1.9561717526346958,
    -1.507889951608236e-07], [5.2391446431293005, 1.893403298603195e-07], [0.8971331163803689, -2.877757586014805e-08],
    [3.8557099353509474, 5.2004426449288044e-08], [-0.5068716224997026, 9.22528035813817e-08], [-1.5759762517637432,
    -1.0115686444125777e-07], [-0.1276617258169639, 6.010838979137442e-08], [-3.0568390650304798, -5.479882440090636e-08],
    [-4.073092654602521, -1.9571614411660627e-08], [-1.1746152481477703, -1.283266914917206e-07], [4.762017887793403,
    5.440080366784129e-08], [-0.17780629506135612, 1.0946807116761979e-07], [-0.44375306198274367, -1.170432173730452e-07],
    [2.5647571529619353, 1.0058288038603165e-07], [-1.0158781656291598, -1.411574821360298e-08], [-1.0602604621155889,
    -5.969227175170686e-09], [-0.07378667156021396, -3.348738446905982e-08], [-0.26329825060984796, 3.468060687122212e-08],
    [-4.718193468197083, -1.3953542473494634e-08], [-1.1263134229396987, -1.5107557822311724e-07], [3.5302371514639623,
    9.166042692934386e-08], [0.9405688911874566, 1.2079510880493775e-08], [-0.02503404430534949, 3.02156774933403e-08],
    [2.4285228464386917, -5.041000531533932e-08], [6.266227068402965, 1.0032199155765441e-07], [-0.09160731914512431,
    1.2436288308316007e-07], [-1.8994901886569895, -1.131287027065129e-07], [5.104184532188385, 2.372849934795731e-08],
    [4.933642643650141, 1.1872898991049631e-07], [-2.424530568672993, 7.845047060859905e-08], [-1.044555761059071,
    -1.5590306706796039e-07], [-1.347859517642722, 1.4791338446550874e-07], [-1.660569536805441, -2.1170735567282606e-07],
    [4.994707379981528, 1.3964650137521516e-07], [1.2329898586198391, 8.806763976822439e-09], [-1.0259227607428703,
    5.684175195800128e-08], [-3.3735173377492247, -7.159311838057801e-08], [-0.06539829884853234, -4.3807502159148006e-08],
    [2.0101331832568374, 2.2570933557527448e-08], [-2.337974792846531, 6.470564438962784e-08], [0.8577694889312449,
    -1.627902600513615e-07], [1.565551299657897, 2.020333957409364e-07], [-0.6058845145837859, -1.692225684240845e-07],
    [2.707631139768977, 1.567316415888085e-07], [-2.497694839883582, -6.209741368673503e-08], [2.929725285431413,
    -3.6118474759090385e-08], [5.3244155366181305, 1.0324212580092578e-07], [-1.1114446911417044, 9.42453143118523e-08]
])
u = np.array([
    [0.3333333333333333], [-0.3333333333333333], [1.0], [-2.6666666666666665], [-2.0], [1.6666666666666667], [0.3333333333333333],
    [2.3333333333333335], [-0.3333333333333333], [1.6666666666666667], [2.6666666666666665], [-2.3333333333333335],
    [2.3333333333333335], [-1.3333333333333333], [1.6666666666666667], [1.0], [-1.3333333333333333], [-1.6666666666666667], [1.0],
    [1.6666666666666667], [0.6666666666666666], [3.0], [-1.0], [-1.0], [2.3333333333333335], [-2.6666666666666665], [1.0],
    [-2.6666666666666665], [-1.3333333333333333], [3.0], [-1.0], [-3.0], [3.0], [1.0], [1.3333333333333333], [2.0],
    [-1.3333333333333333], [0.3333333333333333], [-1.0], [-1.3333333333333333], [-2.6666666666666665], [0.6666666666666666],
    [2.3333333333333335], [-1.3333333333333333], [1.3333333333333333], [0.3333333333333333], [-0.3333333333333333],
    [-0.6666666666666666], [0.3333333333333333], [-0.6666666666666666], [-3.0], [1.0], [1.0], [0.6666666666666666],
    [-0.3333333333333333], [2.3333333333333335], [3.0], [-1.3333333333333333], [0.3333333333333333], [3.0], [2.0],
    [-2.3333333333333335], [1.3333333333333333], [-3.0], [1.6666666666666667], [1.3333333333333333], [1.0], [-1.3333333333333333],
    [-1.3333333333333333], [0.3333333333333333], [1.0], [-2.3333333333333335], [2.6666666666666665], [-1.6666666666666667], [2.0],
    [-0.3333333333333333], [-0.6666666666666666], [2.3333333333333335], [2.3333333333333335], [-1.6666666666666667]
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
    [1.2857142857142858], [-1e-08], [0.9333333333333333], [5.2e-08], [-0.475], [-1.8083333333333333e-08], [0.13697916666666668],
    [5.5364583333333335e-09], [-0.04352213541666667], [-1.7373046875e-09], [0.013555908203125], [5.424601236979166e-10]
])
bound = np.array([
    [1.4e-08], [5.3e-16], [3.8e-09], [1.5e-16], [2.4e-09], [9.100000000000001e-17], [8.1e-10], [3.1e-17], [3.1e-10],
    [1.2000000000000001e-17], [1.1e-10], [4.3e-18]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [1.8478306878306878], [2.812910052910053e-08]
])
bound = np.array([
    [1.8e-08], [7e-16]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [-0.3228418640183346], [-8.814616755793226e-08]
])
bound = np.array([
    [2e-08], [7.7e-16]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [1.648399551625358], [1.2077303109561174e-08]
])
bound = np.array([
    [1.6e-08], [6.100000000000001e-16]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0.25], [-0.01953125]
])
bound = np.array([
    [3e-10], [9.3e-11]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(0.0625+0j)], [(-0.3125+0j)]
])
bound = np.array([
    [2.5e-10], [2.5e-10]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
