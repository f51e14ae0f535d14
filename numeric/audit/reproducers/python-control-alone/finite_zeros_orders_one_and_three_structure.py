# finite-zeros[orders-one-and-three]-structure: faults that no output shows are missed, or seen where there are none.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'finite-zeros[orders-one-and-three]-structure' --language python

from __future__ import annotations

import sys

import numpy as np

wrong = []


def told(what, got, expected, off, bound):
    wrong.append(not np.all(off <= np.asarray(bound)))
    most = [np.max(one, initial=0.0) for one in (off, bound)]
    print("{}: {}, off by {:.3g}, bound {:.3g}".format(what, "WRONG" if wrong[-1] else "right", *most))
    print("  got", got, "\n  expected", expected)


def nearest(got, expected):
    """The numbers of got in the order of those of expected that they are nearest to, where there are as many."""
    left = list(np.asarray(got, dtype=complex))
    pairs = expected if len(left) == len(expected) else []
    return np.array([left.pop(int(np.argmin(np.abs(np.array(left) - z)))) for z in pairs] or left)

# -- how python-control without slycot: StateSpace.zeros is called
Refused = ValueError
def _control_zeros(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import control

    try:  # by slycot where that is installed, else of square systems alone
        return {"finite_zeros": [complex(z) for z in control.StateSpace(A, F, C, G, True).zeros()]}
    except NotImplementedError as lacking:
        raise Refused(str(lacking)) from lacking

def _zeros_without_slycot(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import sys
    from unittest.mock import patch

    # The package imports slycot where it needs it, and takes a module of None for one that is not installed.
    with patch.dict(sys.modules, {"slycot": None}):
        return _control_zeros(A, F, C, G)

structure = _zeros_without_slycot

# -- the question
A = np.array([
    -1.0, 0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, -1.0, 0.0, -1.75, 0.0, 0.0, 1.0, 0.25, -2.703125, 0.234375, 0.0, 2.25, 0.0, 1.0, 1.0,
    1.0, -1.0, 0.0
]).reshape(5, 5)
F = np.array([0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0, 0.0, 0.0]).reshape(5, 2)
C = np.array([1.5, 2.0, 1.0, 0.0, 0.5, 2.5, 3.0, 1.0, 0.0, 0.5]).reshape(2, 5); G = np.array([0.0, 0.0, 0.0, 0.0]).reshape(2, 2)
try:
    answer = structure(A, F, C, G)
except (ValueError, ArithmeticError) as error:
    answer = print("refused:", error)
if answer is None:
    print("WRONG: an answer is due")
    sys.exit(1)
expected = np.array([(-0.5+0j)]); bound = np.array([8.9e-13])
got = answer['finite_zeros'] if isinstance(answer, dict) else answer.finite_zeros

got = nearest(got, expected)
told("number of finite zeros", got, expected, *((np.abs(got - expected), bound) if len(got) == len(expected) else (np.inf, 0.0)))
sys.exit(any(wrong))
