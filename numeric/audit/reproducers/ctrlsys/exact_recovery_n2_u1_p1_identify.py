# exact-recovery[n2-u1-p1]-identify: the model is wrong although the data determine it: every prediction and every residual made with it.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery[n2-u1-p1]-identify' --language python

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

# -- how ctrlsys (SLICOT in C): ib01ad, ib01bd; ab08nd is called
def _ctrlsys(y: Array, u: Array, order: int, block_rows: int, method: str = "M", jobd: str = "M") -> tuple[Any, Any, Any, Any]:
    import ctrlsys
    import numpy as np

    # METH = "M" and JOB = "A" promise A, B, C and D by MOESP, after ib01ad with JOBD = "M", which those need. info other than 0, and
    # warnings that say the problem is singular, are SLICOT's way to decline: of ib01ad all singular values zero, a rank-deficient problem.
    outputs, inputs = np.asfortranarray(y), np.asfortranarray(u)
    n_u, p = u.shape[1], y.shape[1]
    _, factor, _, warning, info = ctrlsys.ib01ad("M", "C", jobd, "O", "N", "N", block_rows, n_u, p, inputs, outputs, 0.0, -1.0)
    if info != 0 or warning in (3, 4, 5):
        raise ValueError(f"ib01ad: info {info}, warning {warning}")
    A, C, B, D, *_, warning, info = ctrlsys.ib01bd(method, "A", "N", block_rows, order, n_u, p, len(y), np.asfortranarray(factor), 0.0)
    if info != 0 or warning == 4:  # a least-squares problem with a rank-deficient matrix
        raise ValueError(f"ib01bd: info {info}, warning {warning}")
    return A, B, C, D

identify = _ctrlsys

# -- the question
y = np.array([
    -23.4, 38.34761904761905, 37.33690476190476, 20.264285714285716, 9.897730654761904, 3.240499441964286, -5.052012997581845,
    -11.771037292480468, -12.824291692461287, -11.628781299363999, -6.276417448265212, 3.4688949277181003, 8.020154140466115,
    12.087683155088563, 10.377075947237435, 12.122665525561894, 11.46175173331323, 3.8569615876943173, -2.439857278620218,
    -6.392573561338918, -1.2440092769495708, 5.098260206354871, 6.75185470989323, 9.54560464149264, 5.805495367326439,
    3.0006360025126906, -4.1390384665469115, -11.315845402825818, -4.243271491486882, 4.759800055388554, 5.09006449675155,
    10.255159696350884, 9.577372649452146, -1.1491270200680332, 1.6699993046585284, 4.434942355787523, -1.1133092151513988,
    -10.521967775014566, -6.329852078990044, 2.299369405477672, -7.229289485070822, -8.546174880694734, 2.6752302447275405,
    -0.628090637854286, -11.734190686061412, -9.69281964232073, 1.9213513112595815, 5.2705343131574125, 2.7048147818175594,
    -4.949014065960438, -1.6324822079046415, 5.486020133107523, -0.5589959481708249, -5.697224073052457, -8.737790700258532,
    -10.206441953888847, -6.806447374923569, -2.115244180406842, 5.777357419694258, -2.911864498065432, -4.400071228508229,
    5.225598510197589, 5.771521420516208, 3.159064902179293, 4.2891614786689605, -2.94725534399257, 2.394504643404809,
    2.4205584313823443, 6.3590716890957015, -5.372452286049006, -13.425276015615898, -9.443023528471644, 1.1797883029080518,
    4.897976161897717, 10.110686164685081, 4.660239537255748, -1.6042410986641769, 5.421504497037008, 4.0691489371449325,
    5.977527401751161
]).reshape(80, 1)
u = np.array([
    -2.3333333333333335, -1.0, -2.0, -1.0, -0.3333333333333333, -1.3333333333333333, -2.6666666666666665, -2.3333333333333335,
    -2.0, -1.6666666666666667, 1.3333333333333333, 1.0, 2.6666666666666665, 1.3333333333333333, 2.0, 2.6666666666666665,
    0.3333333333333333, -0.3333333333333333, -1.6666666666666667, -0.3333333333333333, 1.6666666666666667, 0.6666666666666666,
    2.3333333333333335, 0.6666666666666666, 0.6666666666666666, -0.3333333333333333, -3.0, -1.0, 2.0, 0.3333333333333333,
    1.6666666666666667, 3.0, -1.6666666666666667, 0.3333333333333333, 1.3333333333333333, 0.3333333333333333, -2.6666666666666665,
    -2.0, 2.3333333333333335, -1.6666666666666667, -3.0, 1.6666666666666667, 0.6666666666666666, -3.0, -2.6666666666666665,
    1.3333333333333333, 1.0, 1.0, -1.6666666666666667, -1.0, 2.3333333333333335, -0.3333333333333333, -1.3333333333333333,
    -1.3333333333333333, -2.3333333333333335, -0.6666666666666666, -1.3333333333333333, 2.6666666666666665, -1.0, -2.0,
    1.6666666666666667, 1.6666666666666667, -0.6666666666666666, 2.3333333333333335, -2.3333333333333335, 1.6666666666666667,
    -0.6666666666666666, 2.6666666666666665, -1.3333333333333333, -3.0, -2.3333333333333335, 1.3333333333333333,
    0.3333333333333333, 2.3333333333333335, 1.3333333333333333, -2.0, 2.0, 0.6666666666666666, 0.3333333333333333, 3.0
]).reshape(80, 1)
order = 2; block_rows = 4
try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    answer = print("refused:", error)
if answer is None:
    print("WRONG: an answer is due")
    sys.exit(1)
expected = np.array([1.2857142857142858, 3.2, 1.1, 0.2625, -0.0109375, -0.0669921875]).reshape(6, 1, 1)
bound = np.array([6.4e-09, 6.4e-09, 5e-09, 4.3e-09, 2.9e-09, 1.6e-09]).reshape(6, 1, 1)
A, B, C, D = (np.atleast_2d(np.asarray(one, dtype=float)) for one in answer)
got = np.array([D] + [C @ np.linalg.matrix_power(A, k) @ B for k in range(len(expected) - 1)])
# to the bound comes what comparing in floats adds
told("Markov parameters", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
z = 1; expected = np.array([5.64935064935065]).reshape(1, 1, 1); bound = np.array([2.2e-08]).reshape(1, 1, 1)
got = (D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B))[None]
told("transfer function at 1", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
z = -1; expected = np.array([-1.054584221748401]).reshape(1, 1, 1); bound = np.array([1.2e-08]).reshape(1, 1, 1)
got = (D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B))[None]
told("transfer function at -1", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
z = 2; expected = np.array([3.189511754068716]).reshape(1, 1, 1); bound = np.array([1e-08]).reshape(1, 1, 1)
got = (D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B))[None]
told("transfer function at 2", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
expected = np.array([-0.875, 0.21875]); bound = np.array([2.6e-10, 1.6e-10])
got = np.poly(np.asarray(answer[0], dtype=float))[1:]
told("characteristic polynomial", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
expected = np.array([(0.4375-0.16535945694153692j), (0.4375+0.16535945694153692j)]); bound = np.array([3.4e-10, 3.4e-10])
got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))
got = nearest(got, expected)
told("eigenvalues", got, expected, *((np.abs(got - expected), bound) if len(got) == len(expected) else (np.inf, 0.0)))
sys.exit(any(wrong))
