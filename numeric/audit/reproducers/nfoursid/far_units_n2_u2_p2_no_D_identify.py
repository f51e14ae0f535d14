"""far-units[n2-u2-p2-no-D]-identify: an output in large units is lost.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'far-units[n2-u2-p2-no-D]-identify' --language python
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
    [16.2, -7.6e-08], [-13.908333333333333, -2.224722222222222e-07], [6.169791666666667, -9.356597222222223e-08], [-1.665234375,
    -9.241276041666666e-08], [1.1904134114583333, -8.312885199652778e-08], [-1.3082784016927083, -6.353254530164931e-08],
    [-0.5885897318522135, -5.8667296515570744e-08], [5.04834934870402, 2.7862401432461208e-08], [-6.683972346782684,
    -1.0594324628512065e-08], [8.248475803434848, 8.410899151861667e-08], [-4.684082994672159, -2.3077260588399238e-08],
    [6.231905953671473, 4.580340547986432e-08], [-11.319584376129205, -1.0048098905723116e-07], [5.771302995779721,
    1.5630529227592988e-09], [1.350109878692744, 5.306359825138113e-10], [-4.914679477189484, -4.942946490614233e-08],
    [9.633677875874133, 6.558246853234803e-08], [-6.962801474723199, -9.358117133421628e-09], [3.5591179570494655,
    4.681937072714221e-08], [3.419105120915051, 8.056186984585484e-08], [1.1416163525326637, 7.921053386451078e-08],
    [-5.798914308466081, -7.532589646721611e-09], [5.3407166865744875, 3.9701264332203176e-08], [-5.60646043408601,
    4.371857780591323e-09], [3.438986213158592, 6.322969471765664e-08], [-1.0091129365137679, 4.779865316213931e-08],
    [0.6163071527828803, 1.574187773541698e-08], [0.3940645746483131, 2.012235364294902e-08], [3.5218601638493925,
    7.309309083627654e-08], [-6.9482943100348855, 1.929088044587295e-08], [3.946424187947191, 1.0283375858335014e-07],
    [3.7468788355462075, 1.2330542046968535e-07], [-0.7451856477695984, 1.0946036540050174e-07], [3.8520374417983985,
    1.0656996984150162e-07], [0.7628005717597346, 5.456767411944712e-08], [4.932549499710232, 5.8948916776887886e-08],
    [-7.38264747891312, 4.496977099331745e-09], [10.193149877382313, 7.10119933863051e-08], [-6.119006142709524,
    -1.7586912851850125e-09], [9.887463708204168, 6.354367929263307e-08], [-8.38486407801198, -1.731932328970402e-08],
    [9.203422734927148, 7.580989939144789e-08], [-6.986328226394589, -1.223093222168814e-08], [0.9130371980952648,
    -1.2887553663317965e-08], [-0.2655742150000234, -3.886004950701254e-08], [3.8323774381250204, 5.400049096824152e-09],
    [-5.61999692502606, -3.578802473719111e-08], [7.317497309397802, 7.501728531193974e-08], [-3.0694768123897433,
    -1.1640829675551911e-08], [1.7524588775076924, 4.646297497318222e-08], [1.933265148847436, 2.5163944764882393e-08],
    [0.8417263280918269, 1.3234723119429422e-08], [1.7968227962529848, 3.474838725091428e-08], [1.7611133866119717,
    5.10639608629835e-08], [-5.140974213285475, -1.057936597446044e-08], [5.298352436624791, 5.066647839647381e-08],
    [-11.436058382046692, -8.210935205363222e-08], [5.7398844176241886, 3.156910100994552e-08], [-6.622398865421165,
    -9.997066578106003e-09], [9.661265673910187, 7.774463363781777e-08], [-10.986940798004746, -6.716754303549818e-08],
    [8.146906531587486, 6.113808092647741e-08], [-4.995209881805717, -3.399873801063313e-08], [8.770808646580003,
    4.370504119266327e-08], [-3.941124232424169, -3.4385913079672015e-08], [10.648483703371149, 9.597967241764428e-08],
    [-14.38408990711642, -7.584099228851806e-08], [9.386078668726869, 2.3633450726810482e-08], [-12.879485501802677,
    -8.33359436413024e-08], [8.736216480744009, 6.80375561057433e-08], [-3.110856087317674, 1.3528314694399608e-08],
    [5.121999076402965, 6.795860685759408e-08], [-3.681749191852594, 1.1216463994333816e-08], [8.82153054287102,
    1.0902911108433773e-07], [-12.518839225012142, -3.876783438926065e-08], [17.620650988552292, 1.5534077789219865e-07],
    [-20.88473628164992, -9.280343299892158e-08], [22.274144246443683, 1.7720948128328724e-07], [-16.823209548971555,
    -8.277566028817542e-08], [17.653641688683443, 8.669623518373472e-08]
])
u = np.array([
    [-0.3333333333333333, 1.0], [2.6666666666666665, 1.6666666666666667], [-1.6666666666666667, -1.0], [-0.3333333333333333,
    2.3333333333333335], [0.3333333333333333, -1.0], [0.6666666666666666, 1.0], [-1.6666666666666667, -3.0], [1.6666666666666667,
    -2.6666666666666665], [-1.0, -1.0], [-1.6666666666666667, 2.0], [-1.0, -0.3333333333333333], [2.3333333333333335, 3.0], [2.0,
    0.3333333333333333], [-3.0, -1.0], [1.6666666666666667, 1.0], [-2.3333333333333335, -1.6666666666666667],
    [-0.3333333333333333, -2.0], [1.3333333333333333, -0.3333333333333333], [-2.6666666666666665, -3.0], [-1.6666666666666667,
    -2.0], [2.0, 2.0], [-0.3333333333333333, 1.0], [1.0, -2.6666666666666665], [1.0, -1.3333333333333333], [-0.6666666666666666,
    -1.6666666666666667], [-0.3333333333333333, 2.3333333333333335], [-0.3333333333333333, -0.6666666666666666],
    [-1.3333333333333333, -3.0], [2.3333333333333335, -2.0], [1.6666666666666667, -3.0], [-3.0, -3.0], [-0.6666666666666666,
    -3.0], [-1.6666666666666667, 0.3333333333333333], [-2.3333333333333335, 1.3333333333333333], [-3.0, 1.0], [2.0,
    -2.3333333333333335], [-2.3333333333333335, 2.3333333333333335], [-1.0, -2.0], [-2.6666666666666665, 2.0],
    [0.3333333333333333, -2.3333333333333335], [-1.0, 0.3333333333333333], [-0.3333333333333333, -1.0], [2.0, 3.0],
    [-0.6666666666666666, 2.0], [-1.6666666666666667, -0.6666666666666666], [1.3333333333333333, -1.0], [-0.6666666666666666,
    -2.6666666666666665], [-2.0, 1.6666666666666667], [1.0, -2.6666666666666665], [-2.0, 1.3333333333333333],
    [-1.3333333333333333, 0.3333333333333333], [-1.0, -1.3333333333333333], [-1.3333333333333333, -1.6666666666666667],
    [1.6666666666666667, 0.6666666666666666], [-0.3333333333333333, -0.3333333333333333], [3.0, 2.0], [2.3333333333333335, -1.0],
    [1.3333333333333333, -2.6666666666666665], [-2.0, 0.3333333333333333], [1.0, 1.3333333333333333], [1.0, -1.3333333333333333],
    [-1.3333333333333333, 1.3333333333333333], [-2.3333333333333335, 0.6666666666666666], [-2.0, 0.6666666666666666], [-3.0,
    -3.0], [2.3333333333333335, 1.0], [1.0, 3.0], [2.6666666666666665, -1.6666666666666667], [1.6666666666666667, -2.0], [-2.0,
    -1.3333333333333333], [-1.0, -1.0], [-0.3333333333333333, -0.3333333333333333], [-2.3333333333333335, -2.3333333333333335],
    [2.3333333333333335, 0.3333333333333333], [-3.0, -1.6666666666666667], [2.6666666666666665, 0.3333333333333333],
    [-1.6666666666666667, -1.6666666666666667], [-1.6666666666666667, 1.6666666666666667], [-2.0, 2.6666666666666665], [-2.0,
    2.6666666666666665]
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
    [0.0, 0.0], [0.0, 0.0], [-2.0, -0.4], [-1.3333333333333334e-08, -1.4666666666666667e-08], [1.75, 0.35],
    [9.166666666666666e-09, -7.166666666666666e-09], [-1.53125, -0.30625], [-9.895833333333333e-09, -8.729166666666666e-09],
    [1.33984375, 0.26796875], [7.252604166666667e-09, -3.611979166666667e-09], [-1.17236328125, -0.23447265625],
    [-7.400716145833333e-09, -5.277018229166667e-09]
])
bound = np.array([
    [9.4e-09, 9.2e-09], [7.7e-17, 7.5e-17], [7.6e-09, 7.4e-09], [6.1e-17, 6e-17], [6.9e-09, 6.8e-09], [5.6e-17, 5.5e-17],
    [5.1e-09, 5e-09], [4.2000000000000005e-17, 4.1000000000000007e-17], [4.8e-09, 4.7e-09], [3.9000000000000005e-17, 3.8e-17],
    [3.8e-09, 3.7e-09], [3.1e-17, 3e-17]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [-1.0666666666666667, -0.21333333333333335], [-1.2444444444444444e-08, -5.048888888888889e-08]
])
bound = np.array([
    [3.7e-08, 3.6e-08], [3e-16, 2.9000000000000003e-16]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [16.0, 3.2], [9.523809523809524e-08, 2.5904761904761905e-08]
])
bound = np.array([
    [6e-08, 5.9e-08], [4.900000000000001e-16, 4.8e-16]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [-0.6956521739130435, -0.1391304347826087], [-5.333333333333333e-09, -1.0666666666666666e-08]
])
bound = np.array([
    [1.5e-08, 1.5e-08], [1.2e-16, 1.2e-16]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0.125], [-0.65625]
])
bound = np.array([
    [5.2e-11], [4.2e-11]
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
