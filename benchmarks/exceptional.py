"""The exceptional polynomial D(q; P) for a given P: one n_z x n_z determinant, against its Pluecker forms h_J and its expansion in P.

    python benchmarks/exceptional.py [--repeats K] [--limit SECONDS]

Systems with n states, p = m + 5 outputs and a planted output-nulling subspace of dimension zeta, n_z = m + zeta. A row a size: seconds
for the kernel representation, for [b, a], for D at a P, for all h_J (with their number), and for D expanded in the entries of P (with
the number of terms). A method that took more than the limit is not tried at larger sizes.
"""

from __future__ import annotations

import argparse
import random
import time
from collections.abc import Callable
from math import comb

import sympy

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.pairs.pluecker import forms_of_determinant, value
from faultspace.exact.pairs.polynomial import Exceptional, exceptional, judge
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem

SIZES = ((10, 2, 4), (20, 2, 6), (20, 3, 6), (40, 3, 6), (40, 3, 9), (40, 3, 12), (60, 3, 12))


def planted(n: int, m: int, zeta: int) -> ResidualSystem:
    """The first zeta states can be kept at zero output by v = -K x; the others random, entries small."""
    rng = random.Random(f"{n} {m} {zeta}")

    def entries(rows: int, cols: int) -> list[list[int]]:
        return [[rng.randint(-2, 2) for _ in range(cols)] for _ in range(rows)]

    p = m + 5
    A, F, C, G, K = entries(n, n), entries(n, m), entries(p, n), entries(p, m), entries(m, zeta)
    for i in range(zeta, n):
        A[i][:zeta] = [sum(F[i][k] * K[k][j] for k in range(m)) for j in range(zeta)]
    for i in range(p):
        C[i][:zeta] = [sum(G[i][k] * K[k][j] for k in range(m)) for j in range(zeta)]
    return ResidualSystem.of(A, F, C, G)


def expanded(pencil: Exceptional) -> int:
    """Return the number of terms of D expanded in q and the entries of P, multiplied out in a polynomial ring from the h_J."""
    forms = forms_of_determinant(pencil)
    names = [f"p{i}_{j}" for i in range(pencil.n_z) for j in range(pencil.columns)]
    ring, q, *entries = sympy.ring(["q", *names], sympy.QQ)
    width = pencil.columns

    def minor(rows: tuple[int, ...], cols: tuple[int, ...]) -> sympy.polys.rings.PolyElement:
        if not rows:
            return ring(1)
        parts = ((-1) ** k * entries[rows[k] * width + cols[0]] * minor(rows[:k] + rows[k + 1 :], cols[1:]) for k in range(len(rows)))
        return sum(parts, ring(0))

    total = ring(0)
    for subset, h in forms.minors.items():
        factor = sum((sympy.QQ(int(c.p), int(c.q)) * q**k for k, c in enumerate(h)), ring(0))
        total += factor * minor(subset, tuple(range(width)))
    return len(total)


def timed(action: Callable[[], object], repeats: int) -> tuple[float, object]:
    """The least seconds of some repeats, and the result."""
    least, result = float("inf"), None
    for _ in range(repeats):
        started = time.perf_counter()
        result = action()
        least = min(least, time.perf_counter() - started)
    return least, result


def main() -> None:
    """This prints the table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])  # type: ignore[union-attr]
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--limit", type=float, default=20.0, help="seconds after which a method is given up for larger systems")
    options = parser.parse_args()
    print("| n, m, zeta, n_z | kernel s | b, a s | D at a P s | h_J s | h_J | expanded s | terms |\n|---|---|---|---|---|---|---|---|")
    give_up = {"forms": False, "expanded": False}
    for n, m, zeta in SIZES:
        kernel_seconds, kernel = timed(lambda n=n, m=m, zeta=zeta: kernel_representation(planted(n, m, zeta)), 1)  # type: ignore[misc]
        pencil_seconds, pencil = timed(lambda kernel=kernel: exceptional(kernel), options.repeats)  # type: ignore[misc]
        assert isinstance(pencil, Exceptional)
        rng = random.Random(n)
        P = Matrix.of([[rng.randint(-9, 9) for _ in range(pencil.columns)] for _ in range(pencil.n_z)])
        at_seconds, verdict = timed(lambda pencil=pencil, P=P: judge(pencil, P), options.repeats)  # type: ignore[misc]
        cells = [f"{n}, {m}, {pencil.zeta}, {pencil.n_z}", f"{kernel_seconds:.2f}", f"{pencil_seconds:.3f}", f"{at_seconds:.4f}"]
        if give_up["forms"]:
            cells += ["", f"{comb(pencil.n_z, m)} at most"]
        else:
            seconds, forms = timed(lambda pencil=pencil: forms_of_determinant(pencil), 1)  # type: ignore[misc]
            assert value(forms, P) == verdict.polynomial  # type: ignore[arg-type, attr-defined]
            give_up["forms"] = seconds > options.limit
            cells += [f"{seconds:.3f}", str(len(forms.minors))]  # type: ignore[attr-defined]
        if give_up["expanded"] or give_up["forms"]:
            cells += ["", ""]
        else:
            seconds, terms = timed(lambda pencil=pencil: expanded(pencil), 1)  # type: ignore[misc]
            give_up["expanded"] = seconds > options.limit
            cells += [f"{seconds:.2f}", str(terms)]
        print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
