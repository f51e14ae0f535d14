# other-units[n2-u1-p1]-identify: the answer depends on the units of the channels.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'other-units[n2-u1-p1]-identify' --language python

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
y = np.array([
    -2.34e-05, 3.8347619047619044e-05, 3.733690476190476e-05, 2.0264285714285714e-05, 9.897730654761905e-06,
    3.2404994419642857e-06, -5.052012997581845e-06, -1.1771037292480469e-05, -1.2824291692461287e-05, -1.1628781299364e-05,
    -6.276417448265212e-06, 3.4688949277181e-06, 8.020154140466115e-06, 1.2087683155088563e-05, 1.0377075947237435e-05,
    1.2122665525561895e-05, 1.1461751733313231e-05, 3.856961587694317e-06, -2.439857278620218e-06, -6.392573561338918e-06,
    -1.2440092769495708e-06, 5.098260206354871e-06, 6.7518547098932306e-06, 9.545604641492639e-06, 5.805495367326439e-06,
    3.000636002512691e-06, -4.1390384665469115e-06, -1.1315845402825818e-05, -4.243271491486882e-06, 4.759800055388554e-06,
    5.09006449675155e-06, 1.0255159696350884e-05, 9.577372649452146e-06, -1.1491270200680332e-06, 1.6699993046585284e-06,
    4.434942355787523e-06, -1.113309215151399e-06, -1.0521967775014565e-05, -6.329852078990044e-06, 2.299369405477672e-06,
    -7.229289485070822e-06, -8.546174880694735e-06, 2.6752302447275406e-06, -6.280906378542861e-07, -1.1734190686061411e-05,
    -9.692819642320729e-06, 1.9213513112595813e-06, 5.270534313157413e-06, 2.7048147818175597e-06, -4.949014065960439e-06,
    -1.6324822079046415e-06, 5.486020133107523e-06, -5.589959481708249e-07, -5.6972240730524566e-06, -8.737790700258532e-06,
    -1.0206441953888847e-05, -6.806447374923569e-06, -2.115244180406842e-06, 5.7773574196942584e-06, -2.9118644980654322e-06,
    -4.400071228508229e-06, 5.2255985101975885e-06, 5.771521420516208e-06, 3.159064902179293e-06, 4.289161478668961e-06,
    -2.94725534399257e-06, 2.394504643404809e-06, 2.420558431382344e-06, 6.359071689095702e-06, -5.372452286049006e-06,
    -1.3425276015615899e-05, -9.443023528471644e-06, 1.1797883029080518e-06, 4.8979761618977175e-06, 1.011068616468508e-05,
    4.6602395372557485e-06, -1.6042410986641768e-06, 5.421504497037008e-06, 4.069148937144932e-06, 5.97752740175116e-06
]).reshape(80, 1)
u = np.array([
    -2333333.3333333335, -1000000.0, -2000000.0, -1000000.0, -333333.3333333333, -1333333.3333333333, -2666666.6666666665,
    -2333333.3333333335, -2000000.0, -1666666.6666666667, 1333333.3333333333, 1000000.0, 2666666.6666666665, 1333333.3333333333,
    2000000.0, 2666666.6666666665, 333333.3333333333, -333333.3333333333, -1666666.6666666667, -333333.3333333333,
    1666666.6666666667, 666666.6666666666, 2333333.3333333335, 666666.6666666666, 666666.6666666666, -333333.3333333333,
    -3000000.0, -1000000.0, 2000000.0, 333333.3333333333, 1666666.6666666667, 3000000.0, -1666666.6666666667, 333333.3333333333,
    1333333.3333333333, 333333.3333333333, -2666666.6666666665, -2000000.0, 2333333.3333333335, -1666666.6666666667, -3000000.0,
    1666666.6666666667, 666666.6666666666, -3000000.0, -2666666.6666666665, 1333333.3333333333, 1000000.0, 1000000.0,
    -1666666.6666666667, -1000000.0, 2333333.3333333335, -333333.3333333333, -1333333.3333333333, -1333333.3333333333,
    -2333333.3333333335, -666666.6666666666, -1333333.3333333333, 2666666.6666666665, -1000000.0, -2000000.0, 1666666.6666666667,
    1666666.6666666667, -666666.6666666666, 2333333.3333333335, -2333333.3333333335, 1666666.6666666667, -666666.6666666666,
    2666666.6666666665, -1333333.3333333333, -3000000.0, -2333333.3333333335, 1333333.3333333333, 333333.3333333333,
    2333333.3333333335, 1333333.3333333333, -2000000.0, 2000000.0, 666666.6666666666, 333333.3333333333, 3000000.0
]).reshape(80, 1)
order = 2; block_rows = 4
try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    answer = print("refused:", error)
if answer is None:
    print("WRONG: an answer is due")
    sys.exit(1)
expected = np.array([1.2857142857142857e-12, 3.2e-12, 1.1e-12, 2.625e-13, -1.09375e-14, -6.69921875e-14]).reshape(6, 1, 1)
bound = np.array([6.4e-21, 6.4e-21, 5e-21, 4.3e-21, 2.9e-21, 1.6e-21]).reshape(6, 1, 1)
A, B, C, D = (np.atleast_2d(np.asarray(one, dtype=float)) for one in answer)
got = np.array([D] + [C @ np.linalg.matrix_power(A, k) @ B for k in range(len(expected) - 1)])
# to the bound comes what comparing in floats adds
told("Markov parameters", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
z = 1; expected = np.array([5.649350649350649e-12]).reshape(1, 1, 1); bound = np.array([2.2e-20]).reshape(1, 1, 1)
got = (D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B))[None]
told("transfer function at 1", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
z = -1; expected = np.array([-1.0545842217484008e-12]).reshape(1, 1, 1); bound = np.array([1.2e-20]).reshape(1, 1, 1)
got = (D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B))[None]
told("transfer function at -1", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))
z = 2; expected = np.array([3.189511754068716e-12]).reshape(1, 1, 1); bound = np.array([1e-20]).reshape(1, 1, 1)
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
