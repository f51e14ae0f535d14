"""refuses-short-data[n3-u2-p2]-identify: a model from fewer equations than unknowns.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-short-data[n3-u2-p2]-identify' --language
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
    [7.457142857142857, -26.485714285714284], [1.2107142857142856, 19.53690476190476], [-10.425347222222221, 1.1234126984126984],
    [4.762383742559524, -7.414933655753968], [2.3799602690197172, 6.292115711030506], [1.4466789745149158, -0.24925264328245134],
    [-12.15347046781154, 18.42640489576355], [-1.4288878914486203, -10.68829941412227], [4.178940824338647, -10.759505653488986]
])
u = np.array([
    [1.0, 1.0], [2.3333333333333335, 1.6666666666666667], [-2.0, -1.3333333333333333], [-0.3333333333333333, 1.6666666666666667],
    [2.0, -2.3333333333333335], [3.0, 3.0], [-1.6666666666666667, 1.0], [-2.3333333333333335, -2.3333333333333335],
    [-2.6666666666666665, 2.3333333333333335]
])
order = 3
block_rows = 5

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
