"""time-grows-with-N[N3000-N12000]-identify: no answer in bearable time on records of ordinary length.

How it is compared: The function is asked about records of the lengths given, made by the recipe. With c1 and
c2 the peak memory in bytes, or the CPU time in seconds, of the process and its children, log(c2 / max(c1,
floor N1 / N2)) / log(N2 / N1) is within the bound, or c2 is below the floor. Time that grows faster is
measured once more at twice the length, since data may outgrow a cache between two lengths, and the smaller
exponent counts.

Made by faultspace 0.1.0: faultspace audit --reproduce 'time-grows-with-N[N3000-N12000]-identify' --language
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
import time
import tracemalloc
from math import log

A = np.array([[0.0, -1.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]])
B = np.array([[-2.0], [-2.0], [1.0]])
C = np.array([[-1.0, -2.0, -2.0], [-1.0, -2.0, -2.0], [2.0, 1.0, -1.0]])
D = np.array([[-2.0], [2.0], [1.0]])


def driven(length):
    """The outputs and the inputs: signs of a linear congruential generator through the system, from rest."""
    state, drawn, x, out = 20250523, [], np.zeros(len(A)), []
    for _ in range(length * B.shape[1]):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        drawn.append(1.0 if state >> 63 else -1.0)
    signs = np.ascontiguousarray(np.array(drawn).reshape(B.shape[1], length).T)
    for w in signs:
        out.append(C @ x + D @ w)
        x = A @ x + B @ w
    return np.array(out), signs


def cost(length):
    record, signs = driven(length)
    begun = time.process_time()
    identify(record, signs, 3, 4)
    return time.process_time() - begun


lengths = (3000, 12000)
costs = [cost(length) for length in lengths]
share = 0.1 * lengths[0] / lengths[1]
exponent = log(costs[1] / max(costs[0], share)) / log(lengths[1] / lengths[0]) if costs[1] > 0.1 else 0.0
failed = exponent > 1.5
print('WRONG' if failed else 'right', '- costs', costs, 'at lengths', lengths)
print(f'  exponent: got {exponent:.2f}, at most 1.5')
sys.exit(1 if failed else 0)
