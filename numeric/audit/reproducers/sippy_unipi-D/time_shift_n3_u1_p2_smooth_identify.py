"""time-shift[n3-u1-p2-smooth]-identify: the answer depends on where the record begins.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'time-shift[n3-u1-p2-smooth]-identify' --language
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

# -- how sippy_unipi: MOESP with SS_D_required=True is called
Array = object
import contextlib
import io
from types import SimpleNamespace
from typing import Any
from sippy_unipi import system_identification


def _identified(y: Array, u: Array, order: int, block_rows: int, **options: bool) -> tuple[Any, Any, Any, Any]:
    # It takes either orientation and guesses; a row a channel is that of its examples. Views, so that what it does to them is seen.
    with contextlib.redirect_stdout(io.StringIO()) as said:
        found = system_identification(y.T, u.T, "MOESP", SS_f=block_rows, SS_p=block_rows, SS_fixed_order=order, **options)
    if "Warning" in said.getvalue():  # printed, not raised
        raise ValueError(said.getvalue())
    return found.A, found.B, found.C, found.D



def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """It is called with its defaults."""
    return _identified(y, u, order, block_rows)



def _with_feedthrough(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _identified(y, u, order, block_rows, SS_D_required=True)

with_feedthrough = SimpleNamespace(identify=_with_feedthrough)
identify = with_feedthrough.identify

# -- the question
y = np.array([
    [-64.65861672461162, 31.600680775554956], [34.606915296891515, 50.1366880804559], [65.23292736162671, 5.986553530381158],
    [34.16420060377071, -23.776723692892084], [49.34977170527482, 4.4489962732015], [106.2145579512023, 19.962325588121917],
    [133.43253538817086, 0.6184244469326182], [102.5417415341933, -28.402822947764697], [68.94806395906029, -25.191500045655847],
    [87.04871309848063, 4.854043414554831], [88.51502550802915, -8.566098527360111], [47.11937205698969, -28.001876681327175],
    [23.15008482948681, -11.352352955393114], [3.092121883620894, -10.694891934200617], [-27.197525129831746,
    -16.376032396967105], [-15.807883643762924, 8.175492007949696], [25.50903739980167, 19.990131179814945], [39.149616742573365,
    2.5507717078767302], [22.40079734542106, -9.294736304201372], [-14.442939465595142, -17.051043696364072],
    [-46.494842203377566, -11.30679725321964], [-57.97867456332004, 0.5581717900934746], [-56.51579889666746, 6.920660429202007],
    [-55.69551063336243, 7.0794123184869315], [-80.42720986104324, -9.456025454057048], [-66.1297108890961, 12.666133285858653],
    [17.378283186803376, 46.975499532311936], [49.13477357671088, 12.666656875248638], [-22.141789659158214, -36.77871485307383],
    [-101.23982155936315, -32.85072900126355], [-81.60699316421673, 20.529324084339937], [-3.2828182323111332,
    44.673115417892305], [1.0479715666522802, -0.20027221239401133], [-59.16755701432982, -27.945817452618996],
    [-81.21839699271037, -4.33931080127348], [-22.99273319803672, 33.0950250362245], [55.60349717032071, 36.9129273503308],
    [59.633386008618736, -6.669578842794593], [24.370245898744948, -20.630675629356297], [12.995313766986609, -4.234361049943004],
    [5.1771431933048655, -5.1786118526618825], [-7.326424153243179, -7.238895384185096], [-1.5375778351576308,
    3.3535484063177208], [25.6656837968884, 15.738103683963654], [5.919767548040962, -10.30926218120005], [-64.0120978028232,
    -31.50698063150475], [-95.87626119371416, -3.2774415069628287], [-97.02907913955818, 10.166550225379266],
    [-106.85769741623943, 3.8621342959503298], [-110.66191499894103, 8.086911358937378], [-86.4846525081197, 21.499565834498704],
    [-45.408889208038524, 28.958890327956862], [-51.895593208195265, 0.7558353055473861], [-99.08621382935752,
    -19.958907843967424], [-76.83621115116803, 18.26905309204895], [23.473081289576516, 49.20831736913584], [110.26377173816262,
    30.53164424478175], [152.76184302901288, 5.820263521896588], [159.79705347696134, -12.450380309027452], [148.90596939124418,
    -21.167141706095027], [144.9998600344058, -15.89377240735174], [143.11584640382253, -15.120626714523057], [133.44496381682845,
    -17.189357922925666], [107.67453938459923, -21.59118437186519], [43.44498117964696, -40.32896616820296], [-5.438672916060268,
    -29.161753678395904], [42.36513843116179, 21.528857448934282], [125.86182432218352, 29.865956421064404], [159.14365042272524,
    -0.8261973359900654], [151.59662513187294, -16.275633702290246], [110.02624842038911, -29.519587447015848],
    [31.584221415848194, -45.08756998722247], [-24.645006484302733, -28.141959984252175]
])
u = np.array([
    [9.333333333333334], [15.666666666666666], [10.333333333333334], [14.333333333333334], [26.333333333333332], [31.0], [24.0],
    [17.333333333333332], [20.0], [19.333333333333332], [10.333333333333334], [4.0], [-0.6666666666666666], [-5.666666666666667],
    [-2.3333333333333335], [6.333333333333333], [8.666666666666666], [3.6666666666666665], [-5.0], [-12.0], [-14.333333333333334],
    [-14.0], [-14.333333333333334], [-17.666666666666668], [-12.333333333333334], [4.333333333333333], [8.666666666666666],
    [-7.666666666666667], [-23.0], [-17.333333333333332], [-1.6666666666666667], [-1.6666666666666667], [-14.0],
    [-16.666666666666668], [-2.6666666666666665], [13.333333333333334], [13.666666666666666], [5.666666666666667],
    [2.3333333333333335], [0.6666666666666666], [-1.3333333333333333], [0.3333333333333333], [4.333333333333333],
    [-1.6666666666666667], [-16.666666666666668], [-24.0], [-24.333333333333332], [-25.666666666666668], [-25.333333333333332],
    [-19.333333333333332], [-11.666666666666666], [-13.666666666666666], [-21.333333333333332], [-13.666666666666666],
    [9.666666666666666], [29.333333333333332], [38.0], [38.666666666666664], [36.0], [34.666666666666664], [33.666666666666664],
    [30.333333333333332], [22.666666666666668], [9.0], [1.3333333333333333], [13.333333333333334], [31.666666666666668],
    [38.333333333333336], [34.333333333333336], [22.666666666666668], [5.333333333333333], [-5.333333333333333],
    [-0.6666666666666666]
])
order = 3
block_rows = 5

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit('WRONG: an answer is due')

expected = np.array([
    [-1.1428571428571428], [-1.0], [5.733333333333333], [4.333333333333333], [-0.9541666666666667], [-5.08125],
    [0.6430989583333333], [2.1677734375], [-0.24259847005208332], [-1.209747314453125], [0.14477678934733074],
    [0.5505880355834961], [-0.06294188896814983], [-0.28782623410224917], [0.03399118719001611], [0.13667222168296575]
])
bound = np.array([
    [9.6e-05], [2.6e-05], [2.6e-05], [7e-06], [2.6e-05], [7e-06], [2e-05], [5.4e-06], [6.1e-06], [1.6e-06], [4.4e-06], [1.2e-06],
    [1.7e-06], [4.7e-07], [1.1e-06], [2.8e-07]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got, powered = D, B
while len(got) < len(expected):
    got, powered = np.vstack([got, C @ powered]), A @ powered
told('Markov parameters', got, expected, np.abs(got - expected), bound)

z = 1
expected = np.array([
    [4.142409715564078], [-0.4375199744327261]
])
bound = np.array([
    [0.00014], [3.8e-05]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 1', got, expected, np.abs(got - expected), bound)

z = -1
expected = np.array([
    [-8.98945426158541], [-14.903229011425733]
])
bound = np.array([
    [0.00015], [4e-05]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at -1', got, expected, np.abs(got - expected), bound)

z = 2
expected = np.array([
    [1.5542503590763452], [0.10527455529775716]
])
bound = np.array([
    [0.00011], [3e-05]
])
A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
told('transfer function at 2', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [0.1875], [-0.1630859375], [-0.005859375]
])
bound = np.array([
    [4.5e-08], [2.7e-08], [1.2e-08]
])
got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]
told('characteristic polynomial', got, expected, np.abs(got - expected), bound)

expected = np.array([
    [(-0.03479454249218135+0j)], [(0.3410547378997334+0j)], [(-0.493760195407552+0j)]
])
bound = np.array([
    [6.8e-08], [4.8e-08], [3.5e-08]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
