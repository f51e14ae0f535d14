"""refuses-impossible-number[no-block-rows]-identify: an answer to a question that cannot be meant.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-impossible-number[no-block-rows]-identify'
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

# -- how python-control: markov, eigensys_realization; StateSpace.zeros is called
Array = object
class Refused(ValueError):
    pass
import sys
import warnings
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch
import control
LONGEST = 100


def _taken(samples: int, n_u: int, order: int) -> int:
    """Return the number m of Markov parameters."""
    return max(min(samples // (2 * n_u), LONGEST), 4 * order + 1)



def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """The number m of Markov parameters is two equations an unknown, at most LONGEST, never fewer than eigensys_realization's default
    Hankel matrix takes (the default m, as many as samples, is right for a single input at rest alone).
    """
    n_u, p = u.shape[1], y.shape[1]
    m = _taken(len(u), n_u, order)
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)  # "Not enough data for requested number of parameters"
        try:
            response = control.markov(y.T, u.T, m)
        except UserWarning as warning:
            raise ValueError(str(warning)) from warning
    found, _ = control.eigensys_realization(response.reshape(p, n_u, m), order)
    return found.A, found.B, found.C, found.D



def structure(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    """Return the zeros, found by slycot where that is installed, else of square systems alone."""
    try:
        return {"finite_zeros": [complex(z) for z in control.StateSpace(A, F, C, G, True).zeros()]}
    except NotImplementedError as lacking:
        raise Refused(str(lacking)) from lacking



def _without_slycot(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    # The package imports slycot where it needs it, and takes a module of None for one that is not installed.
    with patch.dict(sys.modules, {"slycot": None}):
        return structure(A, F, C, G)

without_slycot = SimpleNamespace(structure=_without_slycot)

# -- the question
y = np.array([
    [7.457142857142857, -26.485714285714284], [1.2107142857142856, 19.53690476190476], [-10.425347222222221, 1.1234126984126984],
    [4.762383742559524, -7.414933655753968], [2.3799602690197172, 6.292115711030506], [1.4466789745149158, -0.24925264328245134],
    [-12.15347046781154, 18.42640489576355], [-1.4288878914486203, -10.68829941412227], [4.178940824338647, -10.759505653488986],
    [0.4762643054833707, 4.6852867313282935], [1.6490463628086882, -1.203412678438095], [-2.326549194044256, -0.2855292755551543],
    [-0.8081964268139168, 7.635125368025483], [-2.380479550490385, -6.186627186146621], [6.73205257632077, -10.885025342921205],
    [-0.9772665048362301, 0.3081938480694609], [9.143896069291603, -16.58768365100257], [1.4386030969500707, -0.5674900207501665],
    [7.818672513179403, -11.007547868445252], [-0.6237743789901787, 4.188752053155066], [-8.708765388021172, 7.576201562063908],
    [-0.8836483108008946, -5.495586472860778], [6.010935931796171, -16.90571658409052], [3.8813850158633034, 6.995163780072411],
    [-5.146259633144598, 8.007873846687412], [-6.089275219816571, 2.490816411981989], [4.220430778578332, 2.0034671602824687],
    [-8.34383476429625, 11.057495769456578], [5.2928754924994275, -18.56821589345389], [7.780632231586712, 2.298881702395097],
    [-6.978886278953094, 8.389561705911971], [1.3952170023125676, -13.395655679104369], [0.5714529252505142, 5.785527342964997],
    [0.6885542252951238, -10.826098132475867], [7.556461006150733, 1.287464070294791], [-5.510092569017176, 13.97204569039281],
    [-7.601145420391917, 5.633694190890473], [1.4501351840540164, 5.607647285494505], [-6.985549416237076, 4.466765066842645],
    [6.894243647959393, -12.578204289502475], [-1.793124971398495, -1.1270140129673425], [1.7572330540655134, 4.282797641643955],
    [4.271613615653806, -8.134307397150026], [-1.7542700534460933, -3.792859724831627], [10.468051357798535, -8.050291536452084],
    [-4.7590939065907065, -0.6282351901766595], [5.57887735523188, 2.5686990575909094], [-6.796451309311178, 10.847798325104577],
    [1.1190867049075022, -10.661572659534809], [3.5087189292020766, -2.5042716569540464], [5.951543055996003,
    -1.4335872979606574], [-6.855106861884992, 3.8540861361891827], [-0.4279460380943698, 1.4710982526165968],
    [0.19374248840180666, -10.153234261527922], [2.5397254778303977, 0.015376628618745971], [4.101398420381141,
    -0.9555894880362472], [0.18580068750372775, 1.7639679531184502], [-3.268093894640271, 12.859245516890592],
    [-1.9504699309281557, -3.250439462557786], [0.1062716437862573, 8.9916785238114], [-5.591765956432365, 15.532908459371967],
    [-7.862691370665111, 2.2960474530099995], [6.352809477848461, -10.669182376947708], [-3.934632419621431, 14.768316132811757],
    [-5.711162356237449, 2.265092139608183], [-3.2655490274785066, 3.784294983273662], [6.370673567283719, -19.91489733908073],
    [7.996896184316661, -5.429734763202348], [5.659869226338252, -1.2240512242449255], [-0.6333636386961231, 2.1265284606826684],
    [-2.5058472097879574, 11.450255417782932], [-7.759979198122986, 10.482402566676951], [-0.4638160237565909,
    -1.3205375953774459], [1.2774592379341907, 9.335385676910098], [-4.938587420895998, -2.0625642602782666], [0.2273075730113712,
    -0.2722773337907344], [5.372199664668861, -4.942430913754496], [-4.890817824843731, 1.2524344704924844], [-1.668981145086166,
    -2.5111915505687636], [2.755048285334623, 5.11954434770899]
])
u = np.array([
    [1.0, 1.0], [2.3333333333333335, 1.6666666666666667], [-2.0, -1.3333333333333333], [-0.3333333333333333, 1.6666666666666667],
    [2.0, -2.3333333333333335], [3.0, 3.0], [-1.6666666666666667, 1.0], [-2.3333333333333335, -2.3333333333333335],
    [-2.6666666666666665, 2.3333333333333335], [-1.0, 1.0], [1.0, -1.3333333333333333], [-1.0, 2.6666666666666665],
    [0.6666666666666666, -0.3333333333333333], [-1.6666666666666667, -2.6666666666666665], [-0.3333333333333333,
    0.6666666666666666], [-2.0, -3.0], [0.6666666666666666, -1.3333333333333333], [-1.0, -2.3333333333333335],
    [1.6666666666666667, -1.6666666666666667], [0.3333333333333333, 2.3333333333333335], [-2.6666666666666665,
    2.3333333333333335], [-2.6666666666666665, -3.0], [-2.3333333333333335, 1.3333333333333333], [1.0, 2.0], [0.6666666666666666,
    1.0], [-2.0, 1.0], [2.3333333333333335, 2.6666666666666665], [-1.0, -3.0], [-0.6666666666666666, -1.6666666666666667],
    [2.6666666666666665, 1.6666666666666667], [-0.3333333333333333, -3.0], [-1.6666666666666667, 2.0], [-1.0, -1.0],
    [-1.6666666666666667, -0.6666666666666666], [2.6666666666666665, 1.6666666666666667], [2.0, 1.0], [-0.6666666666666666,
    1.6666666666666667], [2.3333333333333335, 1.0], [-1.3333333333333333, -2.0], [0.6666666666666666, -2.0], [-2.3333333333333335,
    3.0], [0.6666666666666666, -2.0], [1.6666666666666667, -2.3333333333333335], [-2.3333333333333335, -1.0], [2.6666666666666665,
    -2.3333333333333335], [-2.3333333333333335, 1.0], [2.6666666666666665, 2.0], [0.3333333333333333, -2.0], [-0.6666666666666666,
    -1.0], [-0.3333333333333333, -0.6666666666666666], [3.0, -1.3333333333333333], [-1.6666666666666667, 2.3333333333333335],
    [-0.6666666666666666, -1.6666666666666667], [-2.3333333333333335, 0.6666666666666666], [-1.0, 0.6666666666666666], [2.0,
    -2.0], [1.6666666666666667, 2.3333333333333335], [2.0, -1.3333333333333333], [0.6666666666666666, 0.3333333333333333], [2.0,
    3.0], [2.6666666666666665, 1.0], [-1.3333333333333333, -2.6666666666666665], [0.6666666666666666, 2.3333333333333335],
    [0.3333333333333333, 1.3333333333333333], [-0.6666666666666666, 2.6666666666666665], [-1.6666666666666667, -3.0],
    [-1.3333333333333333, -2.3333333333333335], [0.3333333333333333, -1.0], [3.0, -2.3333333333333335], [1.6666666666666667, 1.0],
    [2.3333333333333335, 2.3333333333333335], [0.3333333333333333, -0.3333333333333333], [0.6666666666666666, 1.6666666666666667],
    [3.0, -1.6666666666666667], [-0.6666666666666666, 0.3333333333333333], [-1.0, -0.6666666666666666], [1.6666666666666667,
    -1.0], [-2.3333333333333335, 1.0], [-2.6666666666666665, 2.6666666666666665], [1.3333333333333333, 0.6666666666666666]
])
order = 3
block_rows = 0

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit(0)  # right: there is nothing to answer

print('WRONG: answered where no answer can be right')
print('  got', answer)
failed = True

sys.exit(1 if failed else 0)
