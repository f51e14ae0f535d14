"""exact-recovery-1e6[n2-u2-p2-no-D-at-rest]-identify: the answer depends on the size of the signals.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery-1e6[n2-u2-p2-no-D-at-rest]-identify'
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

# -- how nfoursid: NFourSID is called
Array = object
from typing import Any
import pandas
from nfoursid.nfoursid import NFourSID


def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """num_block_rows is the window: its default, 2, carries no order beyond 2 p."""
    outputs, inputs = ([f"{letter}{j}" for j in range(array.shape[1])] for letter, array in (("y", y), ("u", u)))
    # One frame of two, as from two files: a shorter one is filled up with missing values, which the package refuses.
    frame = pandas.concat([pandas.DataFrame(y, columns=outputs), pandas.DataFrame(u, columns=inputs)], axis=1)
    run = NFourSID(frame, output_columns=outputs, input_columns=inputs, num_block_rows=block_rows)
    run.subspace_identification()
    found, _ = run.system_identification(rank=order)
    return found.a, found.b, found.c, found.d

# -- the question
y = np.array([
    [0.0, 0.0], [266666.6666666667, -1022222.2222222222], [-6233333.333333333, -7022222.222222222], [9187500.0,
    4395833.333333333], [-8305729.166666667, -8485590.277777778], [7000846.354166667, 2617686.6319444445], [-7859073.893229167,
    -7101435.004340278], [11410022.989908854, 8827758.4499783], [-12250436.782836914, -2624897.6389567056], [13119132.1849823,
    12571328.687667847], [-8945907.328526178, -3855116.27263493], [9961002.24579374, 7504046.207583613], [-14582543.63173619,
    -11429036.940975735], [8626392.344435832, 2247604.3857931574], [-1148093.301381353, -1114589.3740728046],
    [-2728751.6946246494, -3424574.838953029], [7720991.066129901, 5602178.133689406], [-5289200.516196997, 180128.27300367682],
    [2094717.1183390392, 3915024.4772193246], [4700455.8547866745, 8884386.675061803], [20434.460394993534, 7314242.034348012],
    [-4817880.152845619, -133901.4987841933], [4482311.800406584, 3494486.8001666847], [-4855356.158689094, 903094.0691798154],
    [2781769.9721862907, 5952592.426184132], [-434048.72566300427, 5131914.762959571], [113125.96828846204, 1287121.6565356127],
    [834348.111080929, 2279151.078347489], [3136612.0694708535, 7087557.480085838], [-6611202.227453664, 2131970.432377032],
    [3651468.6156886225, 10112491.07003698], [4004964.9612724553, 12485044.212492805], [-971011.0077800652, 10814580.627039056],
    [4049634.631807557, 10774821.019401854], [589903.030501721, 5355771.464624704], [5083834.848310994, 5984838.194237713],
    [-7515022.158938787, 372175.80493580375], [10308977.722404772, 7169916.978240412], [-6220355.507104175, -235332.58362426364],
    [9976144.402049487, 6406896.812145526], [-8462459.685126634, -1777521.331743836], [9271318.891152471, 7621160.643882925],
    [-7045737.363091746, -1258032.343331147], [965020.1927052777, -1258025.9512021036], [-311059.3352837846, -3912774.925855247],
    [3872176.9183733114, 563517.3352555253], [-5654821.470243314, -3599309.323110557], [7347968.7864629, 7519721.916650258],
    [-3096139.3548217043, -1179789.7606503633], [1775788.6021356578, 4660069.005660805], [1912851.639797966, 2504365.4549767096],
    [859588.148510113, 1334013.4919817036], [1781193.7033869845, 3465627.0322196414], [1774788.8428697218, 5114465.19730776],
    [-5152940.237511007, -1064990.4097693302], [5308822.707822131, 5072824.920287717], [-11445219.869344365, -8216336.4047804205],
    [5747900.719009652, 3161638.9600919224], [-6629413.129133446, -1003842.3023153082], [9667403.154658431, 7778083.633127515],
    [-10992311.09365946, -6719920.853924249], [8151605.540285362, 6116579.713202685], [-4999321.514416358, -3402298.302315902],
    [8774406.325114314, 4372626.057912083], [-3944272.201141691, -3440447.6292449324], [10651238.17599898, 9599591.804160422],
    [-14386500.070665773, -7585520.509989818], [9388187.561832553, 2364588.8518956704], [-12881330.78327015, -8334682.5522788875],
    [8737831.102028048, 6804707.864202506], [-3112268.8809412085, 1351998.314263889], [5123235.270823557, 6796589.746599908],
    [-3682830.861970613, 1121008.508744022], [8822477.004224285, 10903469.29094652], [-12519667.37869625, -3877271.8275050507],
    [17621375.623025887, 15534505.14506623], [-20885370.336814318, -9280717.224377913], [22274699.04471253, 17721275.32116362],
    [-16823694.997456793, -8277852.31586568], [17654066.45610803, 8669874.02455239]
])
u = np.array([
    [-333333.3333333333, 1000000.0], [2666666.6666666665, 1666666.6666666667], [-1666666.6666666667, -1000000.0],
    [-333333.3333333333, 2333333.3333333335], [333333.3333333333, -1000000.0], [666666.6666666666, 1000000.0],
    [-1666666.6666666667, -3000000.0], [1666666.6666666667, -2666666.6666666665], [-1000000.0, -1000000.0], [-1666666.6666666667,
    2000000.0], [-1000000.0, -333333.3333333333], [2333333.3333333335, 3000000.0], [2000000.0, 333333.3333333333], [-3000000.0,
    -1000000.0], [1666666.6666666667, 1000000.0], [-2333333.3333333335, -1666666.6666666667], [-333333.3333333333, -2000000.0],
    [1333333.3333333333, -333333.3333333333], [-2666666.6666666665, -3000000.0], [-1666666.6666666667, -2000000.0], [2000000.0,
    2000000.0], [-333333.3333333333, 1000000.0], [1000000.0, -2666666.6666666665], [1000000.0, -1333333.3333333333],
    [-666666.6666666666, -1666666.6666666667], [-333333.3333333333, 2333333.3333333335], [-333333.3333333333, -666666.6666666666],
    [-1333333.3333333333, -3000000.0], [2333333.3333333335, -2000000.0], [1666666.6666666667, -3000000.0], [-3000000.0,
    -3000000.0], [-666666.6666666666, -3000000.0], [-1666666.6666666667, 333333.3333333333], [-2333333.3333333335,
    1333333.3333333333], [-3000000.0, 1000000.0], [2000000.0, -2333333.3333333335], [-2333333.3333333335, 2333333.3333333335],
    [-1000000.0, -2000000.0], [-2666666.6666666665, 2000000.0], [333333.3333333333, -2333333.3333333335], [-1000000.0,
    333333.3333333333], [-333333.3333333333, -1000000.0], [2000000.0, 3000000.0], [-666666.6666666666, 2000000.0],
    [-1666666.6666666667, -666666.6666666666], [1333333.3333333333, -1000000.0], [-666666.6666666666, -2666666.6666666665],
    [-2000000.0, 1666666.6666666667], [1000000.0, -2666666.6666666665], [-2000000.0, 1333333.3333333333], [-1333333.3333333333,
    333333.3333333333], [-1000000.0, -1333333.3333333333], [-1333333.3333333333, -1666666.6666666667], [1666666.6666666667,
    666666.6666666666], [-333333.3333333333, -333333.3333333333], [3000000.0, 2000000.0], [2333333.3333333335, -1000000.0],
    [1333333.3333333333, -2666666.6666666665], [-2000000.0, 333333.3333333333], [1000000.0, 1333333.3333333333], [1000000.0,
    -1333333.3333333333], [-1333333.3333333333, 1333333.3333333333], [-2333333.3333333335, 666666.6666666666], [-2000000.0,
    666666.6666666666], [-3000000.0, -3000000.0], [2333333.3333333335, 1000000.0], [1000000.0, 3000000.0], [2666666.6666666665,
    -1666666.6666666667], [1666666.6666666667, -2000000.0], [-2000000.0, -1333333.3333333333], [-1000000.0, -1000000.0],
    [-333333.3333333333, -333333.3333333333], [-2333333.3333333335, -2333333.3333333335], [2333333.3333333335, 333333.3333333333],
    [-3000000.0, -1666666.6666666667], [2666666.6666666665, 333333.3333333333], [-1666666.6666666667, -1666666.6666666667],
    [-1666666.6666666667, 1666666.6666666667], [-2000000.0, 2666666.6666666665], [-2000000.0, 2666666.6666666665]
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
    [0.0, 0.0], [0.0, 0.0], [-2.0, -0.4], [-1.3333333333333333, -1.4666666666666666], [1.75, 0.35], [0.9166666666666666,
    -0.7166666666666667], [-1.53125, -0.30625], [-0.9895833333333334, -0.8729166666666667], [1.33984375, 0.26796875],
    [0.7252604166666666, -0.3611979166666667], [-1.17236328125, -0.23447265625], [-0.7400716145833334, -0.5277018229166667]
])
bound = np.array([
    [4.2e-09, 4.1e-09], [3.3e-09, 3.2e-09], [3.4e-09, 3.3e-09], [2.7e-09, 2.6e-09], [3.2e-09, 3.1e-09], [2.5e-09, 2.4e-09],
    [2.4e-09, 2.3e-09], [1.9e-09, 1.9e-09], [2.3e-09, 2.2e-09], [1.8e-09, 1.8e-09], [1.8e-09, 1.8e-09], [1.4e-09, 1.4e-09]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [-1.0666666666666667, -0.21333333333333335], [-1.2444444444444445, -5.0488888888888885]
])
bound = np.array([
    [1.7e-08, 1.7e-08], [1.3e-08, 1.3e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [16.0, 3.2], [9.523809523809524, 2.5904761904761906]
])
bound = np.array([
    [2.9e-08, 2.9e-08], [2.3e-08, 2.3e-08]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [-0.6956521739130435, -0.1391304347826087], [-0.5333333333333333, -1.0666666666666667]
])
bound = np.array([
    [6.6e-09, 6.5e-09], [5.2e-09, 5.1e-09]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0.125], [-0.65625]
])
bound = np.array([
    [5.3e-11], [4.3e-11]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(0.75+0j)], [(-0.875+0j)]
])
bound = np.array([
    [2.6e-11], [2.6e-11]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
