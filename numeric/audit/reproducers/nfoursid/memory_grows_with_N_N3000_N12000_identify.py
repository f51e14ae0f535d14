# memory-grows-with-N[N3000-N12000]-identify: memory runs out on records of ordinary length.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'memory-grows-with-N[N3000-N12000]-identify' --language python

from __future__ import annotations

import sys

import numpy as np

wrong = []


def told(what, got, expected, off, bound):
    wrong.append(not np.all(off <= np.asarray(bound)))
    most = [np.max(one, initial=0.0) for one in (off, bound)]
    print("{}: {}, off by {:.3g}, bound {:.3g}".format(what, "WRONG" if wrong[-1] else "right", *most))
    print("  got", got, "\n  expected", expected)

# -- how nfoursid: NFourSID is called
def by_nfoursid(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    import pandas
    from nfoursid.nfoursid import NFourSID

    outputs, inputs = ([f"{letter}{j}" for j in range(array.shape[1])] for letter, array in (("y", y), ("u", u)))
    # One frame of two, as from two files: a shorter one is filled up with missing values, which the package refuses.
    frame = pandas.concat([pandas.DataFrame(y, columns=outputs), pandas.DataFrame(u, columns=inputs)], axis=1)
    # num_block_rows is the window: its default, 2, carries no order beyond 2 p.
    run = NFourSID(frame, output_columns=outputs, input_columns=inputs, num_block_rows=block_rows)
    run.subspace_identification()
    found, _ = run.system_identification(rank=order)
    return found.a, found.b, found.c, found.d

identify = by_nfoursid

# -- the question
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

import time
import tracemalloc
from math import log


def cost(length):
    record, signs = driven(length)
    tracemalloc.stop(), tracemalloc.start()
    identify(record, signs, 3, 4)
    return tracemalloc.get_traced_memory()[1]  # bytes of numpy and Python alone


lengths = (3000, 12000)
costs = [cost(length) for length in lengths]
share = 32000000.0 * lengths[0] / lengths[1]
exponent = log(costs[1] / max(costs[0], share)) / log(lengths[1] / lengths[0]) if costs[1] > 32000000.0 else 0.0
told("costs {}, exponent".format(costs), exponent, "at most 1.5", exponent, 1.5)
sys.exit(any(wrong))
