"""exact-recovery-1e-12[n3-u1-p2-smooth]-identify: the answer depends on the size of the signals.

How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
each is within its bound.

Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery-1e-12[n3-u1-p2-smooth]-identify'
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
    [1.8447619047619047e-11, -4.933333333333333e-11], [7.231765873015873e-11, 6.343611111111111e-11], [9.021431671626985e-11,
    -6.2852430555555556e-12], [6.459359673394097e-11, -1.25090087890625e-11], [-5.707317164587596e-12, -3.56203128390842e-11],
    [-7.851950100168349e-11, -2.936659535037147e-11], [-1.1455353453941644e-10, -1.1273127159972986e-11], [-6.465861672461163e-11,
    3.1600680775554956e-11], [3.460691529689152e-11, 5.01366880804559e-11], [6.52329273616267e-11, 5.986553530381159e-12],
    [3.4164200603770706e-11, -2.3776723692892085e-11], [4.934977170527482e-11, 4.4489962732015e-12], [1.062145579512023e-10,
    1.9962325588121916e-11], [1.3343253538817086e-10, 6.184244469326181e-13], [1.0254174153419331e-10, -2.8402822947764696e-11],
    [6.89480639590603e-11, -2.519150004565585e-11], [8.704871309848063e-11, 4.854043414554832e-12], [8.851502550802915e-11,
    -8.566098527360111e-12], [4.7119372056989695e-11, -2.8001876681327174e-11], [2.315008482948681e-11, -1.1352352955393114e-11],
    [3.092121883620894e-12, -1.0694891934200617e-11], [-2.7197525129831745e-11, -1.6376032396967107e-11],
    [-1.5807883643762925e-11, 8.175492007949697e-12], [2.5509037399801668e-11, 1.9990131179814943e-11], [3.914961674257337e-11,
    2.5507717078767303e-12], [2.2400797345421062e-11, -9.294736304201371e-12], [-1.4442939465595141e-11, -1.7051043696364073e-11],
    [-4.649484220337756e-11, -1.130679725321964e-11], [-5.797867456332004e-11, 5.581717900934746e-13], [-5.651579889666746e-11,
    6.920660429202007e-12], [-5.5695510633362435e-11, 7.0794123184869315e-12], [-8.042720986104324e-11, -9.456025454057048e-12],
    [-6.61297108890961e-11, 1.2666133285858653e-11], [1.7378283186803377e-11, 4.6975499532311935e-11], [4.913477357671088e-11,
    1.2666656875248639e-11], [-2.2141789659158215e-11, -3.677871485307383e-11], [-1.0123982155936315e-10,
    -3.2850729001263547e-11], [-8.160699316421673e-11, 2.052932408433994e-11], [-3.2828182323111333e-12, 4.4673115417892306e-11],
    [1.0479715666522802e-12, -2.002722123940113e-13], [-5.916755701432982e-11, -2.7945817452618995e-11], [-8.121839699271037e-11,
    -4.33931080127348e-12], [-2.299273319803672e-11, 3.309502503622449e-11], [5.560349717032071e-11, 3.69129273503308e-11],
    [5.963338600861874e-11, -6.6695788427945925e-12], [2.437024589874495e-11, -2.0630675629356297e-11], [1.2995313766986607e-11,
    -4.2343610499430045e-12], [5.177143193304865e-12, -5.178611852661883e-12], [-7.326424153243179e-12, -7.2388953841850955e-12],
    [-1.5375778351576309e-12, 3.3535484063177206e-12], [2.56656837968884e-11, 1.5738103683963656e-11], [5.919767548040962e-12,
    -1.0309262181200049e-11], [-6.40120978028232e-11, -3.150698063150475e-11], [-9.587626119371416e-11, -3.2774415069628286e-12],
    [-9.702907913955817e-11, 1.0166550225379267e-11], [-1.0685769741623943e-10, 3.86213429595033e-12], [-1.1066191499894102e-10,
    8.086911358937378e-12], [-8.648465250811968e-11, 2.1499565834498703e-11], [-4.540888920803852e-11, 2.895889032795686e-11],
    [-5.1895593208195265e-11, 7.558353055473861e-13], [-9.908621382935753e-11, -1.9958907843967426e-11], [-7.683621115116804e-11,
    1.8269053092048947e-11], [2.3473081289576515e-11, 4.9208317369135845e-11], [1.1026377173816262e-10, 3.0531644244781745e-11],
    [1.5276184302901288e-10, 5.820263521896588e-12], [1.5979705347696132e-10, -1.2450380309027453e-11], [1.489059693912442e-10,
    -2.1167141706095026e-11], [1.4499986003440582e-10, -1.589377240735174e-11], [1.4311584640382253e-10, -1.5120626714523057e-11],
    [1.3344496381682843e-10, -1.7189357922925668e-11], [1.0767453938459923e-10, -2.1591184371865192e-11], [4.344498117964696e-11,
    -4.032896616820296e-11], [-5.438672916060268e-12, -2.9161753678395904e-11], [4.2365138431161784e-11, 2.1528857448934285e-11],
    [1.2586182432218353e-10, 2.986595642106441e-11], [1.5914365042272523e-10, -8.261973359900654e-13], [1.5159662513187294e-10,
    -1.6275633702290247e-11], [1.1002624842038911e-10, -2.951958744701585e-11], [3.1584221415848195e-11, -4.508756998722247e-11],
    [-2.4645006484302732e-11, -2.8141959984252177e-11]
])
u = np.array([
    [1.8333333333333335e-11], [2.1333333333333334e-11], [1.2e-11], [-4.666666666666667e-12], [-2.0333333333333334e-11],
    [-2.5e-11], [-1.1666666666666667e-11], [9.333333333333333e-12], [1.5666666666666667e-11], [1.0333333333333333e-11],
    [1.4333333333333334e-11], [2.6333333333333333e-11], [3.1e-11], [2.4e-11], [1.7333333333333335e-11], [2e-11],
    [1.9333333333333334e-11], [1.0333333333333333e-11], [4e-12], [-6.666666666666667e-13], [-5.6666666666666665e-12],
    [-2.3333333333333334e-12], [6.333333333333333e-12], [8.666666666666667e-12], [3.666666666666667e-12], [-5e-12], [-1.2e-11],
    [-1.4333333333333334e-11], [-1.4e-11], [-1.4333333333333334e-11], [-1.7666666666666667e-11], [-1.2333333333333333e-11],
    [4.333333333333334e-12], [8.666666666666667e-12], [-7.666666666666666e-12], [-2.3e-11], [-1.7333333333333335e-11],
    [-1.6666666666666666e-12], [-1.6666666666666666e-12], [-1.4e-11], [-1.6666666666666667e-11], [-2.6666666666666667e-12],
    [1.3333333333333333e-11], [1.3666666666666666e-11], [5.6666666666666665e-12], [2.3333333333333334e-12],
    [6.666666666666667e-13], [-1.3333333333333334e-12], [3.3333333333333334e-13], [4.333333333333334e-12],
    [-1.6666666666666666e-12], [-1.6666666666666667e-11], [-2.4e-11], [-2.4333333333333333e-11], [-2.5666666666666665e-11],
    [-2.5333333333333333e-11], [-1.9333333333333334e-11], [-1.1666666666666667e-11], [-1.3666666666666666e-11],
    [-2.1333333333333334e-11], [-1.3666666666666666e-11], [9.666666666666667e-12], [2.9333333333333335e-11], [3.8e-11],
    [3.866666666666667e-11], [3.6e-11], [3.466666666666667e-11], [3.3666666666666667e-11], [3.033333333333333e-11],
    [2.2666666666666666e-11], [9e-12], [1.3333333333333334e-12], [1.3333333333333333e-11], [3.166666666666667e-11],
    [3.833333333333333e-11], [3.433333333333333e-11], [2.2666666666666666e-11], [5.3333333333333335e-12],
    [-5.3333333333333335e-12], [-6.666666666666667e-13]
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
    [9.3e-05], [2.5e-05], [2.6e-05], [7e-06], [2.6e-05], [7e-06], [2e-05], [5.4e-06], [6e-06], [1.6e-06], [4.3e-06], [1.2e-06],
    [1.7e-06], [4.7e-07], [1e-06], [2.8e-07]
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
    [6.9e-08], [4.9e-08], [3.5e-08]
])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected.ravel())
off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf
told('eigenvalues', got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)

sys.exit(1 if failed else 0)
