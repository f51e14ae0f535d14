# right-on-long-records[N12000]-identify: wrong answers on records of ordinary length.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'right-on-long-records[N12000]-identify' --language python

from __future__ import annotations

import sys

import numpy as np

wrong = []


def told(what, got, expected, off, bound):
    wrong.append(not np.all(off <= np.asarray(bound)))
    most = [np.max(one, initial=0.0) for one in (off, bound)]
    print("{}: {}, off by {:.3g}, bound {:.3g}".format(what, "WRONG" if wrong[-1] else "right", *most))
    print("  got", got, "\n  expected", expected)

# -- how sippy_unipi: MOESP, defaults (no D) is called
def _sippy(y: Array, u: Array, order: int, block_rows: int, **options: bool) -> tuple[Any, Any, Any, Any]:
    import contextlib
    import io

    from sippy_unipi import system_identification

    # It takes either orientation and guesses; a row a channel is that of its examples. Views, so that what it does to them is seen.
    with contextlib.redirect_stdout(io.StringIO()) as said:
        found = system_identification(y.T, u.T, "MOESP", SS_f=block_rows, SS_p=block_rows, SS_fixed_order=order, **options)
    if "Warning" in said.getvalue():  # printed, not raised
        raise ValueError(said.getvalue())
    return found.A, found.B, found.C, found.D

identify = _sippy

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

def markov(A, B, C, D):
    return np.array([D] + [C @ np.linalg.matrix_power(A, k) @ B for k in range(2 * len(A) + 1)])


record, signs = driven(12000)
found = [np.asarray(one, dtype=float) for one in identify(record, signs, 3, 4)]
got, expected = markov(*found), markov(A, B, C, D)
told("D, C B, C A B, ...", got, expected, np.abs(got - expected), 0.5)
sys.exit(any(wrong))
