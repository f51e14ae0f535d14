"""permuted-channels[n1-u2-p1]-identify: the answer depends on the order of the channels.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'permuted-channels[n1-u2-p1]-identify' --language
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
    [-27.542857142857144], [9.414285714285715], [1.3803571428571428], [-2.1354910714285715], [2.780571056547619],
    [-2.0605712890625], [3.4619999476841516], [7.3719881148565385], [7.904552075976417], [-0.5903975046816327],
    [-4.975029507172959], [12.120397969951764], [1.8584221898395168], [6.182853583572086], [-2.0614272366966753],
    [-5.005536214810175], [-3.9753048718271367], [-2.103308292112443], [6.668502514304071], [-0.32330749048307417],
    [1.4986212613121053], [-1.3548401158491823], [5.700922186300586], [12.10263037061347], [2.7257993253056627],
    [-14.660269985084861], [6.086886958692538], [-0.979011180938273], [0.02308157380423331], [10.01753488601389],
    [-5.511337487017113], [13.22865631953618], [-0.846460405540353], [-6.104005919350939], [2.1592403149946975],
    [4.209332500924607], [5.7607860264389865], [0.3897052400853801], [-0.8782823221748747], [1.9924511089108161],
    [-9.606692975365366], [7.878700341952488], [-1.054512628232183], [-2.0438434786986455], [1.777155590226278],
    [-2.0878619177634254], [-7.611099399886334], [6.599400370195471], [5.020462956414794], [6.3649454389635],
    [-7.753521206277979], [8.532570452354243], [4.833619413700492], [-0.39117870870911325], [6.740739634813536],
    [-1.9789678392455523], [-0.2674108698067274], [-12.772339971441525], [0.3539132035762861], [-4.189860308483964],
    [-12.832373812889942], [5.5585687512623], [3.978631956371876], [-1.9574631741156439], [-2.098094166849491],
    [1.4260710268542733], [5.587842412548695], [-0.5621075713724274], [-6.077304898830578], [-4.009105901033771],
    [13.505795665268616], [4.628183768381412], [1.7203834678093517], [-8.140381895666602], [-12.55807107483931],
    [2.2104671292552176], [1.2496462551007221], [-0.7412363932818183], [-1.0720363525193182], [-6.583700653519541]
])
u = np.array([
    [-1.3333333333333333, -0.3333333333333333], [1.6666666666666667, -0.6666666666666666], [-2.3333333333333335, -2.0],
    [-0.3333333333333333, -1.3333333333333333], [1.6666666666666667, 3.0], [2.3333333333333335, 2.3333333333333335],
    [-0.3333333333333333, -3.0], [2.0, -1.6666666666666667], [0.6666666666666666, -1.3333333333333333], [-1.6666666666666667,
    1.3333333333333333], [0.6666666666666666, -3.0], [2.3333333333333335, 1.0], [2.3333333333333335, 0.3333333333333333],
    [2.6666666666666665, 2.6666666666666665], [-0.6666666666666666, 1.0], [-2.6666666666666665, -1.6666666666666667],
    [-2.3333333333333335, -0.3333333333333333], [2.3333333333333335, 0.3333333333333333], [-1.0, -2.0], [0.3333333333333333,
    -0.3333333333333333], [0.6666666666666666, 1.6666666666666667], [2.0, 1.6666666666666667], [2.0, -2.3333333333333335], [2.0,
    -2.6666666666666665], [-2.6666666666666665, 2.6666666666666665], [-1.6666666666666667, -2.3333333333333335],
    [-1.6666666666666667, -3.0], [1.0, 3.0], [2.0, -2.6666666666666665], [-0.6666666666666666, 1.3333333333333333],
    [2.6666666666666665, -0.6666666666666666], [2.6666666666666665, 0.6666666666666666], [-0.6666666666666666, 2.0], [1.0, 2.0],
    [2.6666666666666665, 2.0], [1.6666666666666667, -0.6666666666666666], [2.0, 1.3333333333333333], [1.6666666666666667, 3.0],
    [0.3333333333333333, -1.6666666666666667], [-2.0, 1.6666666666666667], [-1.3333333333333333, -3.0], [2.6666666666666665,
    2.3333333333333335], [1.0, 2.3333333333333335], [-1.0, -1.6666666666666667], [-0.6666666666666666, -1.3333333333333333],
    [-1.0, 2.6666666666666665], [-0.6666666666666666, -1.6666666666666667], [2.6666666666666665, 1.3333333333333333],
    [1.3333333333333333, -3.0], [-1.3333333333333333, 1.3333333333333333], [1.6666666666666667, 0.6666666666666666],
    [1.3333333333333333, -2.0], [0.6666666666666666, 1.3333333333333333], [2.3333333333333335, -0.3333333333333333],
    [-2.3333333333333335, -3.0], [-1.3333333333333333, -3.0], [-3.0, 1.6666666666666667], [0.6666666666666666,
    2.6666666666666665], [-1.3333333333333333, -1.6666666666666667], [-2.3333333333333335, 3.0], [-3.0, -3.0], [3.0, 1.0], [-1.0,
    -1.6666666666666667], [-2.3333333333333335, -1.6666666666666667], [0.3333333333333333, 0.6666666666666666],
    [-0.3333333333333333, -2.6666666666666665], [1.3333333333333333, 0.3333333333333333], [-2.0, -1.0], [-2.0,
    1.6666666666666667], [2.0, -1.6666666666666667], [2.0, -1.3333333333333333], [-0.3333333333333333, -2.6666666666666665],
    [-2.6666666666666665, -2.0], [-3.0, 2.6666666666666665], [-2.3333333333333335, -1.6666666666666667], [-0.6666666666666666,
    -1.6666666666666667], [1.0, 1.3333333333333333], [-0.6666666666666666, -1.0], [-1.3333333333333333, 0.6666666666666666],
    [-2.0, -0.3333333333333333]
])
order = 1
block_rows = 3

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [1.0, -0.5714285714285714], [2.4, -2.0], [-0.9, 0.75], [0.3375, -0.28125]
])
bound = np.array([
    [6.3e-10, 5.8e-10], [6.6e-10, 6.1e-10], [2.8e-10, 2.5e-10], [1.1e-10, 1e-10]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [2.7454545454545456, -2.0259740259740258]
])
bound = np.array([
    [1.1e-09, 1e-09]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [-2.84, 2.6285714285714286]
])
bound = np.array([
    [1.8e-09, 1.6e-09]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [2.0105263157894737, -1.413533834586466]
])
bound = np.array([
    [9.1e-10, 8.4e-10]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0.375]
])
bound = np.array([
    [8e-12]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(-0.375+0j)]
])
bound = np.array([
    [8e-12]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
