"""exact-recovery[zeros-none]-identify: the model is wrong although the data determine it: every prediction and every residual made with it.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery[zeros-none]-identify' --language python
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
    [-20.5, -24.5, -27.0, -15.5], [-85.25, 16.0, -5.5, -39.75], [-8.5, -24.5, 35.3125, 3.375], [14.953125, -21.78125, -14.28125,
    -7.765625], [-110.578125, 24.15625, 3.16015625, -49.5234375], [86.9306640625, -14.509765625, 0.298828125, 56.0419921875],
    [10.240234375, 3.88671875, 58.452392578125, -5.41259765625], [36.86651611328125, -14.2911376953125, 19.0853271484375,
    26.65472412109375], [-25.16156005859375, -20.4688720703125, 23.173599243164062, -30.858612060546875], [-8.188411712646484,
    23.398460388183594, -81.8145980834961, 2.610851287841797], [-74.12504577636719, 5.814453125, 17.250798225402832,
    -34.57486152648926], [41.7541229724884, -21.982914447784424, -21.785561084747314, 20.74157691001892], [-86.69942688941956,
    6.455204486846924, -33.66771358251572, -56.446290373802185], [-108.47322116792202, -9.489658027887344, -40.05999371409416,
    -45.91150529682636], [-24.145636290311813, 7.685557186603546, 28.77894001081586, -4.411065258085728], [78.07811525929719,
    -20.65624630637467, 13.513558810576797, 39.14447250124067], [-34.36330845486373, 9.027704333886504, 67.71538993739523,
    -19.879897765349597], [79.3486618437455, -32.592158151441254, -1.3116822143783793, 42.22780917136697], [-61.561791508458555,
    12.430713588837534, 47.552546601116774, -37.65657834036392], [2.465167412756273, -37.8196839354423, 29.287143814079172,
    5.6138641207326145], [79.1714184950797, 32.67642513753526, 4.0155036982114325, 43.38424431808562], [-78.22738738497151,
    -65.61648439963983, 7.555656836648723, -60.780593840722986], [-137.96100358285594, 30.45840468635197, -47.496063780063366,
    -63.44770196891807], [-61.558861282461905, -42.4990638614195, -52.95187187680827, -32.81218668594637], [-92.4484505457526,
    45.13186298272851, 37.20113383557015, -35.63511919488149], [143.39698703621423, -43.94453850871235, -8.9601578586686,
    74.19365419849643], [-22.1566525588856, 46.576064199450755, -2.3275547355008035, -24.730819349456155], [-24.917782510404564,
    -24.49271322906719, -43.086165665998834, -6.774240812761926], [-4.584095134804385, 34.915951191670175, -51.91491782109477,
    -4.619980559215045], [-64.49382064449476, -8.823567461220074, 9.993573883469546, -26.609849288392095], [78.04083848227059,
    15.308076612781917, 26.209223207985723, 47.94484564324492], [101.80175288857218, -2.8099077138031534, 0.8857316888637381,
    42.2007510983286], [-9.27816010399792, 24.627143348906543, -23.14371104036106, -7.002909656437025], [20.471581437390636,
    10.337214347431548, -2.49111365130089, 20.777768825500413], [68.95557358210897, 0.5764462746484756, 33.04930947136859,
    35.75402673508153], [-16.700245101619718, -30.76467396479189, -2.800975661749672, -25.274858389862857], [-105.82267494502571,
    15.781590288295302, -61.802019864131935, -52.92902162296493], [-80.85852909842059, -7.513213919896822, -9.860297199289999,
    -31.331942428935786], [-22.64346934938709, -23.16458425915855, -4.926824076185263, -19.90011601675829], [-24.22680644465905,
    30.3858118691392, -36.25562019894786, -7.41264477781625], [19.50370694766913, -3.3237023205469733, -8.883100286767402,
    14.800166530958428], [17.663819260704443, 10.001362595083373, 36.431029074070125, 11.464704364882119], [35.7729856866076,
    -29.065668409980816, 13.578302229698762, 13.572764410563178], [-44.55370179798968, 15.971662923402683, 49.09087981891309,
    -21.628646478978574], [63.65876698175075, -40.24060009653128, -51.29306148698161, 24.55250315199798], [-143.3986978946277,
    41.495913298393276, -17.1927284790646, -76.6221319371895], [-26.662320914450575, -40.95080078029366, -27.81482249212635,
    -3.4814624038101254], [-13.76292323030673, 29.201567036844924, -12.492790918049037, -12.683137857966845], [-56.23789159823379,
    -29.554541890539863, -28.94817986467727, -31.63283794131876], [-13.400310296083703, 46.26674807113144, -18.428171838188533,
    3.6984262896875406], [44.851164970752535, -34.194021466655215, -19.76904443718448, 17.326480824309726], [-67.99485679023684,
    34.73775620331807, 4.849326656844828, -35.36368575362614], [66.92901335822074, -10.232627178320216, 10.107369175127262,
    49.396220599068066], [63.28877228994867, 2.156797890198079, 49.577132076714335, 21.921970479736835], [29.880787705384947,
    -0.7694302942630381, 26.527736202949306, 19.222488157937903], [49.40881749024968, -7.541219310149102, 15.614051532666757,
    22.94839237711144], [-85.01146518500936, -32.095762509676575, 2.005747929280248, -59.2713589067248], [-80.15893809441246,
    19.697241130329534, -49.21463259165527, -32.5939646639836], [18.56733781660171, 5.351964340234823, -8.598945145084782,
    19.3010944589945], [-27.725036923899378, -28.201447052171613, 10.482938756020143, -30.283476084497572], [-24.037588916713446,
    33.885453738377585, -60.77688654131675, -2.8979791265638957], [-75.79521666005542, -34.3164324160954, -23.37616447543703,
    -48.83011910759281]
])
u = np.array([
    [5.0, 5.0], [-1.0, 7.0], [-7.0, 1.0], [6.0, 7.0], [1.0, -4.0], [-8.0, 3.0], [-5.0, 2.0], [-8.0, 6.0], [8.0, -7.0], [7.0, 3.0],
    [-2.0, -1.0], [3.0, 1.0], [9.0, 6.0], [4.0, 5.0], [-6.0, -2.0], [-6.0, 8.0], [-7.0, -1.0], [-4.0, 7.0], [-6.0, 9.0], [-1.0,
    -7.0], [-9.0, 9.0], [9.0, 8.0], [7.0, 2.0], [7.0, 9.0], [-5.0, -7.0], [-1.0, -4.0], [5.0, -1.0], [8.0, -8.0], [5.0, 4.0],
    [-1.0, -2.0], [-6.0, -9.0], [2.0, -5.0], [5.0, -4.0], [-4.0, -3.0], [-8.0, 3.0], [8.0, 2.0], [9.0, 5.0], [-2.0, 5.0], [7.0,
    -3.0], [4.0, -4.0], [-2.0, 1.0], [-7.0, 1.0], [-3.0, 8.0], [-4.0, -5.0], [8.0, 4.0], [5.0, 4.0], [3.0, -2.0], [2.0, 3.0],
    [9.0, -3.0], [-1.0, -5.0], [3.0, 3.0], [2.0, -3.0], [-9.0, -1.0], [-5.0, 1.0], [-5.0, -2.0], [-6.0, 9.0], [9.0, 3.0], [7.0,
    -4.0], [-6.0, 5.0], [9.0, -5.0], [3.0, 3.0], [9.0, 3.0]
])
order = 4
block_rows = 3

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [-3.0, -1.5], [-1.5, -1.0], [-3.5, -1.5], [-2.5, -1.0], [-6.5, -8.75], [3.25, -0.75], [-2.5, 2.5], [-2.25, -4.5], [2.125,
    3.0], [-2.8125, -0.9375], [0.125, -1.4375], [1.0625, 1.9375], [-0.90625, -1.359375], [2.203125, 1.078125], [0.34375, 0.96875],
    [-0.640625, -1.09375], [0.5078125, 0.796875], [-1.67578125, -0.90234375], [-0.3671875, -0.69921875], [0.44140625, 0.73046875],
    [-0.337890625, -0.5419921875], [1.2626953125, 0.7001953125], [0.302734375, 0.517578125], [-0.3212890625, -0.525390625],
    [0.24267578125, 0.392578125], [-0.948486328125, -0.531005859375], [-0.23388671875, -0.386474609375], [0.238525390625,
    0.388427734375], [-0.1793212890625, -0.29095458984375], [0.71173095703125, 0.39971923828125], [0.1771240234375,
    0.2894287109375], [-0.17828369140625, -0.2899169921875], [0.133819580078125, 0.21734619140625], [-0.5338897705078125,
    -0.3001556396484375], [-0.133270263671875, -0.2169647216796875], [0.1335601806640625, 0.2170867919921875],
    [-0.10019683837890625, -0.16279220581054688], [0.4004402160644531, 0.22520828247070312], [0.10005950927734375,
    0.16269683837890625], [-0.10013198852539062, -0.16272735595703125]
])
bound = np.array([
    [7.1e-07, 8.6e-07], [3e-07, 3.6e-07], [3.6e-07, 4.3e-07], [3.8e-07, 4.6e-07], [3e-07, 3.6e-07], [1.2e-07, 1.5e-07], [1.5e-07,
    1.8e-07], [1.6e-07, 1.9e-07], [2.2e-07, 2.6e-07], [9e-08, 1.1e-07], [1.1e-07, 1.3e-07], [1.2e-07, 1.4e-07], [2.2e-07,
    2.6e-07], [9e-08, 1.1e-07], [1.1e-07, 1.3e-07], [1.2e-07, 1.4e-07], [1.8e-07, 2.2e-07], [7.5e-08, 9e-08], [9e-08, 1.1e-07],
    [9.6e-08, 1.2e-07], [1.4e-07, 1.7e-07], [5.9e-08, 7.1e-08], [7.1e-08, 8.6e-08], [7.6e-08, 9.2e-08], [1.1e-07, 1.3e-07],
    [4.6e-08, 5.6e-08], [5.5e-08, 6.7e-08], [5.9e-08, 7.1e-08], [8.5e-08, 1e-07], [3.6e-08, 4.3e-08], [4.3e-08, 5.2e-08],
    [4.6e-08, 5.5e-08], [6.6e-08, 7.9e-08], [2.7e-08, 3.3e-08], [3.3e-08, 4e-08], [3.5e-08, 4.2e-08], [5.1e-08, 6.1e-08],
    [2.1e-08, 2.5e-08], [2.5e-08, 3.1e-08], [2.7e-08, 3.3e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [-7.9714285714285715, -8.128571428571428], [0.18571428571428572, -2.1142857142857143], [-5.728571428571429,
    0.12857142857142856], [-4.071428571428571, -4.228571428571429]
])
bound = np.array([
    [9.9e-07, 1.2e-06], [4.1e-07, 5e-07], [4.9e-07, 6e-07], [5.3e-07, 6.4e-07]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [8.333333333333334, 14.5], [-16.5, -6.0], [-2.8333333333333335, -9.166666666666666], [3.1666666666666665, 9.333333333333334]
])
bound = np.array([
    [1.9e-06, 2.3e-06], [8e-07, 9.7e-07], [9.6e-07, 1.2e-06], [1e-06, 1.2e-06]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [-5.808080808080808, -5.257575757575758], [-0.3787878787878788, -1.5151515151515151], [-4.691919191919192,
    -0.5202020202020202], [-3.419191919191919, -2.8686868686868685]
])
bound = np.array([
    [8.5e-07, 1e-06], [3.5e-07, 4.3e-07], [4.3e-07, 5.2e-07], [4.6e-07, 5.5e-07]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [2.0], [1.375], [0.375], [0.03515625]
])
bound = np.array([
    [1.7e-09], [2.6e-09], [1.3e-09], [1.9e-10]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(-0.25+0j)], [(-0.25+0j)], [(-0.75+0j)], [(-0.75+0j)]
])
bound = np.array([
    [9.5e-10], [9.5e-10], [9.5e-10], [9.5e-10]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
