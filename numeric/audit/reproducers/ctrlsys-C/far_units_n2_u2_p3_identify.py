"""far-units[n2-u2-p3]-identify: an output in large units is lost.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'far-units[n2-u2-p3]-identify' --language python
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
    [5.628571428571429, 26.561904761904763, 9.495238095238095e-08], [8.899603174603175, 25.006349206349206,
    8.661507936507936e-08], [2.327901785714286, 18.582440476190477, 2.258358134920635e-08], [0.6199017237103175,
    7.072104414682539, -3.9264167906746036e-09], [-1.0037639315166171, -8.276922510540675, -4.9485899910094246e-09],
    [1.5844475579640223, 6.5314663599407865, -4.365768008761936e-09], [-4.396658959085979, -7.41653586644975,
    -3.7770370116309514e-08], [-1.6125179096110283, -12.53255885621858, 8.651578954997517e-09], [1.698770167685986,
    3.0692876758024332, 3.904793167576962e-08], [6.255849197350114, 16.633350546500232, 4.9314169416798184e-08],
    [-1.2044525796530612, 11.239698474431972, -2.3387472957630384e-08], [-3.9130409612815336, -11.151234402042233,
    -3.189310585897463e-08], [0.6765218026016201, -6.87413769073705, -4.39813888707638e-09], [-0.7099616376092612,
    -1.2636224621735657, -1.0895250419093194e-08], [0.28965221666825874, 2.708232805910824, -1.4945346432463435e-08],
    [1.8941719355425022, -6.41276243797142, 1.7929837135488417e-09], [-2.186886190532953, 3.255986672772179,
    -2.3814502124258193e-08], [0.5466374899178731, -7.684651391693013, 1.2937950429959468e-08], [2.251666577961843,
    6.133550384852816, 1.8309016415368725e-08], [0.6230757816437037, 1.5549686791126318, 2.4856281046848517e-08],
    [0.7916654848806055, 6.769765144808141, 3.335764603499498e-08], [2.8628563613604343, 10.043445614413669,
    3.217605095783005e-08], [2.6918325061168824, 5.727132174039152, 2.4482244922164275e-08], [1.977833552153134,
    10.929832009090825, 2.963523427309668e-11], [2.5553315089983646, -1.8699786040383606, 5.530312137419135e-09],
    [1.934589721889692, 4.145855739353725, 4.898706888264117e-09], [-0.8062478471186566, 5.584667762501798,
    -2.2915793885391438e-08], [2.982854204456548, -7.515104676526734, 1.0248473502542279e-08], [-0.3972466183322429,
    10.016994433264365, -3.604094845731018e-08], [-0.6730953111734996, -11.796842300263885, -2.442123480335438e-08],
    [-2.2799418216261107, -7.636335884435255, -1.6432601944305884e-08], [-2.594564995830517, -1.9441172067954613,
    -9.070541913692586e-09], [0.6187860901606348, -6.555516918534618, 2.7490607908813418e-08], [0.7122089128939023,
    8.403282581673286, 2.5597335856507095e-08], [1.3409387834694917, 7.991494536971278, 1.607903494297416e-08],
    [4.922232474064011, 3.4257038433542797, 3.028027579525991e-08], [-1.1790676627038263, 7.197141285681483,
    -1.063847209442207e-08], [1.7031823674742645, -1.8933451802360124, 2.0200865289590936e-08], [0.349403085889666,
    8.099908247450623, -1.1659321245177371e-08], [-1.1302694383825957, -7.987816673729171, -6.918626420861062e-09],
    [-3.5271725573677464, -0.7426208356759328, -2.2836273303232317e-08], [1.2981616568573782, -5.325829825451484,
    6.364345917066939e-09], [-0.8243820680946187, 0.271384306915387, -1.2169495701322856e-08], [1.6796153274654306,
    -1.3105422256960324, 1.3922966065861134e-08], [1.0551657948076032, 1.8871533211137137, 2.11674057673506e-08],
    [1.532108878268296, 4.8331960090708, 4.282887583869285e-08], [2.712457530431454, 11.529762593045428, 5.0276313434395504e-08],
    [4.633692084899605, 12.797076886422854, 5.330632061874491e-08], [1.8608927233025587, 14.217544781685094,
    1.564922020125008e-08], [-1.6409571150040958, 1.5003527513393673, -1.6366618933047033e-08], [-1.6768356059678782,
    -10.610486137779224, 8.566083366577362e-10], [1.3228445683124266, 1.7283965062457114, 2.9733290172295043e-08],
    [4.159043666141972, 10.935729536686718, 4.0112606801177935e-08], [1.0813564210417062, 7.805729496197906,
    1.915999592019752e-08], [2.0002239493990506, 4.484782020644407, 3.131743531756236e-08], [-0.5409167036205463,
    10.018081545191432, -6.904072785267466e-09], [-2.567061493009854, -7.979592678281077, -1.5919021521725674e-08],
    [-3.100762899800693, -4.362296798439953, -2.409333981278351e-08], [-0.9741630686620862, -8.97992057711748,
    -2.1268721371903542e-09], [4.130072443754223, 4.57433855671677, 2.1818769985672244e-08], [3.3630486195984814,
    8.714000492384391, 7.175362267544219e-09], [1.3961335307494078, 1.1474250156185923, 8.80019815606075e-09],
    [3.4737593203357133, 8.051803973712753, 1.7780116079993747e-08], [-0.6213972791304747, 5.414097610110753,
    -2.2567982987402395e-08], [-1.6495307468281597, -6.263468676417966, -3.0865060021845276e-08], [1.4523498188357422,
    -7.686284926835865, -4.3967794292109466e-09], [0.8292589515223414, 6.187793484416857, -2.3433768120596725e-08],
    [-1.542187461999651, -6.548905662124864, -3.6298090213188e-08], [-5.235778914140045, -12.892029460660659,
    -4.124023564413345e-08], [-1.7595800992434658, -9.989926795485646, -1.7662239536888214e-09], [4.109924783993976,
    2.414394043253134, 3.383814142738273e-08], [2.9678987287143013, 12.40020536099787, 1.4134155215346575e-08],
    [1.5252440607202917, 1.9694502728581014, 1.5510776399318735e-08], [-0.05464764161841508, 2.7343833788961764,
    1.6670303755841592e-08], [1.4534697770809182, 5.126871901375524, 2.805420108407417e-08], [5.017161492374398,
    8.442206519381074, 4.242541353813003e-08], [-0.2726537579870974, 13.66107079030721, -1.736613112157911e-08],
    [-2.5660006202486048, -10.522728267687915, -2.0110313640598187e-08], [-3.406663773918605, -4.259699397936141,
    -3.18373163985335e-08], [-3.109925149761678, -12.5247151670345, -1.741927301360818e-08]
])
u = np.array([
    [-2.3333333333333335, -1.6666666666666667], [2.6666666666666665, -2.3333333333333335], [-0.3333333333333333,
    -0.6666666666666666], [2.3333333333333335, 3.0], [-1.3333333333333333, -1.6666666666666667], [3.0, 1.6666666666666667], [-2.0,
    1.3333333333333333], [-2.6666666666666665, -1.3333333333333333], [-2.3333333333333335, -2.6666666666666665], [3.0,
    -1.3333333333333333], [0.6666666666666666, 2.6666666666666665], [-0.6666666666666666, 2.6666666666666665],
    [1.6666666666666667, -0.3333333333333333], [-0.6666666666666666, -1.0], [2.6666666666666665, 2.3333333333333335],
    [1.3333333333333333, -3.0], [-1.0, 1.0], [-0.3333333333333333, -1.3333333333333333], [0.3333333333333333,
    -1.6666666666666667], [-2.6666666666666665, -2.6666666666666665], [-2.3333333333333335, -0.6666666666666666], [1.0,
    0.3333333333333333], [0.3333333333333333, -2.0], [2.6666666666666665, 1.3333333333333333], [2.0, -2.3333333333333335],
    [0.6666666666666666, -2.3333333333333335], [1.6666666666666667, 2.6666666666666665], [2.3333333333333335, -3.0],
    [2.6666666666666665, 2.3333333333333335], [1.6666666666666667, -0.3333333333333333], [-2.3333333333333335,
    -1.6666666666666667], [-1.6666666666666667, 2.0], [-2.0, -2.3333333333333335], [-2.0, -0.6666666666666666], [1.0,
    1.6666666666666667], [2.6666666666666665, -3.0], [-1.6666666666666667, -0.3333333333333333], [0.6666666666666666,
    -0.6666666666666666], [1.6666666666666667, 1.6666666666666667], [-1.0, -1.0], [-1.6666666666666667, 2.6666666666666665], [2.0,
    0.3333333333333333], [-0.6666666666666666, -0.6666666666666666], [0.6666666666666666, -1.3333333333333333], [-2.0, -3.0],
    [-3.0, -2.6666666666666665], [-1.6666666666666667, -1.3333333333333333], [0.3333333333333333, -2.0], [0.6666666666666666,
    0.6666666666666666], [0.3333333333333333, 2.6666666666666665], [-2.3333333333333335, -1.3333333333333333],
    [-1.6666666666666667, -2.0], [1.0, -1.6666666666666667], [-1.3333333333333333, -1.3333333333333333], [-0.6666666666666666,
    -1.3333333333333333], [0.6666666666666666, 3.0], [-1.0, 1.3333333333333333], [-0.6666666666666666, 2.6666666666666665],
    [-0.6666666666666666, -0.3333333333333333], [2.6666666666666665, -2.0], [2.3333333333333335, -2.0], [-0.3333333333333333,
    -2.6666666666666665], [2.3333333333333335, -1.0], [1.3333333333333333, 1.6666666666666667], [1.6666666666666667, 2.0],
    [1.6666666666666667, -2.3333333333333335], [3.0, 1.0], [1.6666666666666667, 1.0], [-2.6666666666666665, 1.0],
    [-1.3333333333333333, 0.3333333333333333], [1.3333333333333333, -3.0], [1.3333333333333333, -1.3333333333333333],
    [-0.3333333333333333, -2.0], [-2.3333333333333335, -1.3333333333333333], [-0.6666666666666666, -0.3333333333333333],
    [1.6666666666666667, -2.6666666666666665], [1.3333333333333333, 2.6666666666666665], [-0.6666666666666666, 1.0],
    [-0.3333333333333333, 3.0], [-1.6666666666666667, 0.6666666666666666]
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
    [0.8571428571428571, -0.8571428571428571], [1.2857142857142858, 0.14285714285714285], [1.4285714285714286e-09,
    -8.571428571428572e-09], [-0.4, -0.3333333333333333], [-0.2, -3.2666666666666666], [-7.333333333333334e-09,
    -2.6666666666666666e-09], [-0.2375, -0.13333333333333333], [-1.75, -0.16666666666666666], [-2.5416666666666667e-09,
    -2.333333333333333e-09], [-0.10703125, -0.07708333333333334], [-0.359375, -0.5416666666666666], [-1.6223958333333333e-09,
    -8.541666666666667e-10], [-0.057177734375, -0.03528645833333333], [-0.3408203125, -0.12760416666666666],
    [-7.013346354166667e-10, -5.247395833333333e-10], [-0.0274444580078125, -0.018660481770833334], [-0.12005615234375,
    -0.10856119791666667], [-3.8499959309895834e-10, -2.3185221354166667e-10]
])
bound = np.array([
    [2.3e-09, 2.1e-09], [7.3e-09, 6.6e-09], [2.3e-17, 2.1000000000000002e-17], [1.9e-09, 1.7e-09], [6e-09, 5.5e-09], [1.9e-17,
    1.7e-17], [1.2e-09, 1.1e-09], [4e-09, 3.6e-09], [1.2000000000000001e-17, 1.1e-17], [5.1e-10, 4.6e-10], [1.6e-09, 1.5e-09],
    [5.1e-18, 4.6e-18], [3e-10, 2.8e-10], [9.7e-10, 8.9e-10], [3.0000000000000002e-18, 2.8e-18], [1.5e-10, 1.3e-10], [4.7e-10,
    4.3e-10], [1.5000000000000001e-18, 1.4e-18]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [0.0, -1.4730158730158731], [-1.6285714285714286, -4.155555555555556], [-1.1523809523809524e-08, -1.5428571428571428e-08]
])
bound = np.array([
    [5.4e-09, 5e-09], [1.7e-08, 1.6e-08], [5.5e-17, 5.0000000000000005e-17]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [1.0874458874458874, -0.6025974025974026], [-0.18095238095238095, 3.742857142857143], [7.408369408369408e-09,
    -7.763347763347764e-09]
])
bound = np.array([
    [4.5e-09, 4.2e-09], [1.5e-08, 1.3e-08], [4.6e-17, 4.2000000000000005e-17]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [0.5796653796653797, -1.0697554697554696], [0.6767052767052767, -1.612097812097812], [-3.135993135993136e-09,
    -1.0637494637494638e-08]
])
bound = np.array([
    [2.9e-09, 2.7e-09], [9.4e-09, 8.6e-09], [2.8999999999999997e-17, 2.7e-17]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [-0.1875], [-0.15625]
])
bound = np.array([
    [9.9e-11], [4.4e-11]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(-0.3125+0j)], [(0.5+0j)]
])
bound = np.array([
    [5.4e-11], [5.4e-11]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
