# normal-rank[six-by-six]-structure: independent faults are taken for dependent or the reverse.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'normal-rank[six-by-six]-structure' --language python

from __future__ import annotations

import sys

import numpy as np

wrong = []


def told(what, got, expected, off, bound):
    wrong.append(not np.all(off <= np.asarray(bound)))
    most = [np.max(one, initial=0.0) for one in (off, bound)]
    print("{}: {}, off by {:.3g}, bound {:.3g}".format(what, "WRONG" if wrong[-1] else "right", *most))
    print("  got", got, "\n  expected", expected)

# -- how slycot (SLICOT): ab08nd is called
def _zeros_of_slicot(nu: int, rank: int, infz: Any, Af: Any, Bf: Any, inputs: int) -> dict[str, Any]:
    import scipy.linalg

    # Finite zeros are the eigenvalues of the pencil (Af, Bf), which is left to the caller of AB08ND. infz[i] infinite zeros have the
    # order i + 1; as many as the rank leaves over have the order 0, which AB08ND does not list.
    zeros = scipy.linalg.eigvals(Af[:nu, :nu], Bf[:nu, :nu]) if nu else []
    orders = [i + 1 for i, count in enumerate(infz) for _ in range(int(count))]
    orders = [0] * (int(rank) - len(orders)) + orders
    known = {"normal_rank": int(rank), "left_invertible": int(rank) == inputs}
    return {**known, "finite_zeros": [complex(z) for z in zeros], "infinite_zero_orders": orders}

def _slycot_zeros(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import slycot

    n, m = len(A), F.shape[1]
    try:  # no scaling, its own tolerance
        nu, rank, dinfz, _, _, infz, _, _, Af, Bf = slycot.ab08nd(n, m, len(C), A, F, C, G)
    except Exception as error:
        if type(error).__module__ != "_wrapper":
            raise
        raise ValueError(str(error)) from error  # f2py's class for arguments of the wrong shape, which no module exports
    return _zeros_of_slicot(nu, rank, infz[:dinfz], Af, Bf, m)

structure = _slycot_zeros

# -- the question
A = np.array([0.75, 0.0, 0.25, 0.0, -1.75, -0.75, -0.25, 0.0, -1.25, 0.0, -0.75, 0.0, -1.5, 0.0, -1.75, 0.75]).reshape(4, 4)
F = np.array([
    -1.0, -3.5, -3.0, 2.0, 0.5, -2.5, 1.5, 5.5, 2.0, -2.5, -2.0, 3.0, 2.5, 2.5, 2.5, -3.5, 1.0, 1.0, 2.0, -2.0, 3.0, -5.0, 3.0,
    -3.0
]).reshape(4, 6)
C = np.array([
    -2.5, 0.5, -1.5, -0.5, -1.5, -0.5, -2.5, 1.0, 1.5, -1.0, 3.0, -1.5, 2.0, 2.0, -3.0, 1.0, -2.0, -2.0, -2.0, 0.5, 3.5, 0.5, 3.5,
    -1.5
]).reshape(6, 4)
G = np.array([
    0.5, -5.0, -1.0, 0.5, 2.0, -4.5, 0.5, 1.0, 1.0, -1.5, 1.5, 2.0, -1.0, -0.5, 1.0, -1.5, -2.0, 0.0, -1.5, -4.5, -2.5, 1.5, 1.5,
    -3.5, -0.5, -4.0, -2.5, 1.5, -2.0, -3.0, -1.5, -2.5, -1.5, 2.0, 0.5, -1.5
]).reshape(6, 6)
try:
    answer = structure(A, F, C, G)
except (ValueError, ArithmeticError) as error:
    answer = print("refused:", error)
if answer is None:
    print("WRONG: an answer is due")
    sys.exit(1)
expected = 6; bound = 0.0
got = answer['normal_rank'] if isinstance(answer, dict) else answer.normal_rank
told("normal rank", got, expected, 0.0 if list(np.ravel(got)) == list(np.ravel(expected)) else np.inf, 0.0)
expected = True; bound = 0.0
got = answer['left_invertible'] if isinstance(answer, dict) else answer.left_invertible
told("left invertible", got, expected, 0.0 if list(np.ravel(got)) == list(np.ravel(expected)) else np.inf, 0.0)
sys.exit(any(wrong))
