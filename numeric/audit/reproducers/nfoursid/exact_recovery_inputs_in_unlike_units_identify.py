"""exact-recovery[inputs-in-unlike-units]-identify: the model is wrong although the data determine it: every prediction and every residual made with it.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery[inputs-in-unlike-units]-identify'
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
    [12.0, -9.0, -3.5], [34.75, 7.375, -38.5], [6.375, 13.75, -1.34375], [1.328125, -13.5078125, -5.21875], [24.6484375, -5.65625,
    -30.849609375], [13.0595703125, 18.84716796875, -13.001953125], [15.40966796875, 5.6591796875, -4.2532958984375],
    [3.97882080078125, 7.915496826171875, -14.3109130859375], [-10.756500244140625, 3.665771484375, 10.396217346191406],
    [-0.8010978698730469, 6.297956466674805, -5.613258361816406], [14.780881881713867, 13.377567291259766, 2.7928719520568848],
    [7.097127199172974, 19.795345187187195, -5.419326305389404], [6.333053946495056, 7.978222370147705, 5.858497053384781],
    [-3.273400828242302, 0.6912234351038933, 5.7257358729839325], [-31.573906011879444, -4.642472043633461, 21.890604028478265],
    [-6.873061533086002, -15.400410525966436, 12.670780817046762], [-10.192330288235098, -11.024635083973408, 22.050356760271825],
    [13.885586649936158, -20.101824159995886, -7.524866494000889], [6.615124504518462, -14.76609211898176, -2.4338972748591914],
    [5.3051214518091, -19.303352866905698, -12.572676473464526], [1.808381440327139, 0.16521232196100755, -21.934839484101303],
    [-26.65206945705063, 1.3642206719240448, 23.99614829241864], [-5.6529464459846395, -7.65390937287998, -6.42961110100336],
    [26.17608747555785, 10.56868470030701, -13.489045253350099], [36.23484310793909, 19.862581794601567, -20.141110432550654],
    [22.068135336591336, 30.032857728453674, -34.13012739302652], [3.0644587265922634, 18.031926878335632, 6.882671103967467],
    [-29.566486794463984, 0.15418098152788404, 18.834325208327996], [13.676549585215941, -16.61486911270206, 0.6142657899601364],
    [29.841295152364918, 9.99486159985495, -15.801839126381832], [5.188026575027162, 9.737566793431704, 2.6694843331652915],
    [-9.887965413623585, 0.7794056696677387, -5.365297109264629], [-33.45565725712792, -0.2969815344440774, 27.854704869296995],
    [-32.711928887588556, -11.748252670264307, 30.7135957955567], [0.9470579889866365, -13.87454306212419, 12.161761921267951],
    [-3.629916988942729, 5.910523491374259, 0.46865517612939966], [-3.9965865951418884, -5.379422801109539, 12.831344165787906],
    [26.89376316533675, -6.898400793216274, -22.618014167314172], [20.26136589571476, 8.606862353886218, -13.263755314082765],
    [33.3699673600558, 8.05402853153511, -30.32777574447388], [27.848410297990544, 15.766466361872075, -19.81949518815525],
    [17.955878200516025, 21.001004403477214, -22.929542409870315], [24.601303856544757, 14.86891825407718, -5.904515942444145],
    [34.111391134124474, 21.135262148513437, -25.311073400858163], [47.07031999115468, 22.742551640940142, -18.733361656848416],
    [1.3453766511056076, 19.162036236893503, 2.3341758594135946], [-25.29741397403645, -12.213870009183049, 24.087964610273502],
    [18.673436183780836, -16.804572663650788, -4.762480783215928], [6.810595013837361, 5.119974818033379, 13.255185287470757],
    [-4.8952539881780295, -5.58145766631034, 5.017520010658468], [-33.9506753414399, -8.696295338775279, 23.715449951508745],
    [-33.21820380978204, -22.289341321904853, 33.59962283619856], [-13.014931126606198, -30.115025417556556, 25.521694385306887],
    [13.810372880219829, -17.80920352345345, -12.314196085218185], [-19.07509693917259, -2.653645960477136, 9.592265325983393],
    [-34.354181408437114, -16.95611507694127, 14.295011423296767]
])
u = np.array([
    [8.0, -2.7939677238464355e-09], [3.0, 8.381903171539307e-09], [1.0, -7.450580596923828e-09], [3.0, -6.51925802230835e-09],
    [3.0, 7.450580596923828e-09], [-2.0, 2.7939677238464355e-09], [5.0, -2.7939677238464355e-09], [-5.0, 2.7939677238464355e-09],
    [-3.0, -1.862645149230957e-09], [-5.0, 8.381903171539307e-09], [4.0, 3.725290298461914e-09], [-4.0, 3.725290298461914e-09],
    [2.0, -9.313225746154785e-10], [-1.0, -1.862645149230957e-09], [-8.0, -3.725290298461914e-09], [3.0, 2.7939677238464355e-09],
    [5.0, -7.450580596923828e-09], [9.0, -1.862645149230957e-09], [7.0, -8.381903171539307e-09], [4.0, -4.6566128730773926e-09],
    [-6.0, 6.51925802230835e-09], [-4.0, -7.450580596923828e-09], [-3.0, 6.51925802230835e-09], [6.0, 7.450580596923828e-09],
    [7.0, 9.313225746154785e-10], [-8.0, 8.381903171539307e-09], [-1.0, -2.7939677238464355e-09], [-9.0, -4.6566128730773926e-09],
    [9.0, 4.6566128730773926e-09], [6.0, 4.6566128730773926e-09], [1.0, -6.51925802230835e-09], [-8.0, 2.7939677238464355e-09],
    [-8.0, -1.862645149230957e-09], [-4.0, -9.313225746154785e-10], [7.0, 1.862645149230957e-09], [-3.0, 1.862645149230957e-09],
    [4.0, -5.587935447692871e-09], [7.0, 4.6566128730773926e-09], [4.0, -1.862645149230957e-09], [4.0, 4.6566128730773926e-09],
    [3.0, 9.313225746154785e-10], [-5.0, 6.51925802230835e-09], [5.0, 1.862645149230957e-09], [1.0, 8.381903171539307e-09], [9.0,
    3.725290298461914e-09], [-5.0, -5.587935447692871e-09], [-4.0, -6.51925802230835e-09], [8.0, 8.381903171539307e-09], [5.0,
    -4.6566128730773926e-09], [-1.0, -2.7939677238464355e-09], [-8.0, -3.725290298461914e-09], [-1.0, -3.725290298461914e-09],
    [9.0, -6.51925802230835e-09], [7.0, 1.862645149230957e-09], [-4.0, -7.450580596923828e-09], [-7.0, -3.725290298461914e-09]
])
order = 3
block_rows = 3

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [2.5, 2147483648.0], [-0.5, 1073741824.0], [-1.0, -2147483648.0], [1.5, 1073741824.0], [0.75, 2147483648.0], [-1.75, 0.0],
    [0.875, 805306368.0], [0.4375, 805306368.0], [-0.9375, -402653184.0], [0.46875, 402653184.0], [0.234375, 301989888.0],
    [-0.421875, -100663296.0], [0.2109375, 100663296.0], [0.10546875, 75497472.0], [-0.10546875, 201326592.0], [0.052734375,
    -88080384.0], [0.0263671875, -37748736.0], [0.0791015625, 390070272.0], [-0.03955078125, -191889408.0], [-0.019775390625,
    -94371840.0], [0.177978515625, 479723520.0], [-0.0889892578125, -239075328.0], [-0.04449462890625, -119144448.0],
    [0.22247314453125, 502136832.0]
])
bound = np.array([
    [4.1e-08, 46.0], [2.8e-08, 31.0], [3.4e-08, 38.0], [2.7e-08, 31.0], [1.9e-08, 21.0], [2.3e-08, 26.0], [1.8e-08, 20.0],
    [1.2e-08, 14.0], [1.5e-08, 17.0], [2.3e-08, 26.0], [1.6e-08, 17.0], [1.9e-08, 21.0], [2.6e-08, 29.0], [1.8e-08, 20.0],
    [2.2e-08, 24.0], [2.7e-08, 30.0], [1.8e-08, 20.0], [2.2e-08, 25.0], [2.6e-08, 29.0], [1.7e-08, 20.0], [2.1e-08, 24.0],
    [2.4e-08, 27.0], [1.6e-08, 18.0], [2e-08, 22.0]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [4.5, 2147483648.0], [0.5, 3221225472.0], [-2.0, 2147483648.0]
])
bound = np.array([
    [2.9e-07, 320.0], [2e-07, 220.0], [2.4e-07, 270.0]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [1.5612244897959184, 1586508327.7061224], [-0.9693877551020408, -495236024.94693875], [0.12244897959183673,
    -2410440829.387755]
])
bound = np.array([
    [6.4e-08, 72.0], [4.3e-08, 49.0], [5.3e-08, 60.0]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [3.54, 2932849096.4114285], [0.02, 2386774683.062857], [-2.16, -2221111658.7885714]
])
bound = np.array([
    [5.8e-08, 65.0], [3.9e-08, 44.0], [4.8e-08, 54.0]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [-1.75], [0.9375], [-0.140625]
])
bound = np.array([
    [4.5e-10], [5.6e-10], [1.5e-10]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(0.25+0j)], [(0.75+0j)], [(0.75+0j)]
])
bound = np.array([
    [1.9e-10], [1.2e-05], [1.2e-05]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
