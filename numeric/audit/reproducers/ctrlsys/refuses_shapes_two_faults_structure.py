# refuses-shapes[two-faults]-structure: matrices of another system are taken for those of the residual.
# It must be refused.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-shapes[two-faults]-structure' --language python

from __future__ import annotations

import sys

import numpy as np

wrong = []

# -- how ctrlsys (SLICOT in C): ib01ad, ib01bd; ab08nd is called
def _zeros_of_slicot(nu: int, rank: int, infz: Any, Af: Any, Bf: Any, inputs: int) -> dict[str, Any]:
    import scipy.linalg

    # Finite zeros are the eigenvalues of the pencil (Af, Bf), which is left to the caller of AB08ND. infz[i] infinite zeros have the
    # order i + 1; as many as the rank leaves over have the order 0, which AB08ND does not list.
    zeros = scipy.linalg.eigvals(Af[:nu, :nu], Bf[:nu, :nu]) if nu else []
    orders = [i + 1 for i, count in enumerate(infz) for _ in range(int(count))]
    orders = [0] * (int(rank) - len(orders)) + orders
    known = {"normal_rank": int(rank), "left_invertible": int(rank) == inputs}
    return {**known, "finite_zeros": [complex(z) for z in zeros], "infinite_zero_orders": orders}

def _ctrlsys_zeros(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import ctrlsys
    import numpy as np

    n, m = len(A), F.shape[1]
    matrices = (np.asfortranarray(M) for M in (A, F, C, G))
    # Without scaling, at the default tolerance.
    nu, rank, dinfz, _, _, infz, _, _, Af, Bf, info = ctrlsys.ab08nd("N", n, m, len(C), *matrices, 0.0)
    if info != 0:
        raise ValueError(f"ab08nd: info {info}")
    return _zeros_of_slicot(nu, rank, infz[:dinfz], Af, Bf, m)

structure = _ctrlsys_zeros

# -- the question
A = np.array([0.1875, 0.3125, -0.75, -0.5625, 0.125, 0.5, 0.0, 0.0, 0.0625]).reshape(3, 3)
F = np.array([-2.6666666666666665, -1.6666666666666667, 2.6666666666666665, -1.6666666666666667]).reshape(2, 2)
C = np.array([0.2, -1.6, -1.6, 1.4, -0.4, 0.4, 0.2, 0.8, -1.4]).reshape(3, 3)
G = np.array([
    -1.0, 1.2857142857142858, -1.2857142857142858, -0.8571428571428571, 0.42857142857142855, 0.7142857142857143
]).reshape(3, 2)
try:
    answer = structure(A, F, C, G)
except (ValueError, ArithmeticError) as error:
    answer = print("refused:", error)
if answer is None:
    print("right: there is nothing to answer")
    sys.exit(0)
print("WRONG: answered where a refusal is due\n  got", answer)
wrong.append(True)
sys.exit(any(wrong))
