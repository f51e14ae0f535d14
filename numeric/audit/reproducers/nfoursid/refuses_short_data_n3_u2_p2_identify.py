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

print('WRONG: answered where a refusal is due')
print('  got', answer)
failed = True

sys.exit(1 if failed else 0)
