"""Experiments to test population limits on: random ones, and white inputs with leads and lags.

random_experiment   shapes given, entries small; with `nilpotent` every impulse response is finite
white_with_leads    u(k) = e(k) white, v(k) = sum_j phi_j u(k+j), written by delaying u
driven              a system, its windows and filters as an Experiment
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import Any

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.algebra.stability import is_stable
from faultspace.exact.limits.experiments import Experiment, read_experiment

Rows = list[list[str]]


def rows(random: Random, nrows: int, ncols: int, *, top: int = 3, bottom: int = 3) -> Rows:
    """These are small rationals as strings."""
    return [[str(Fraction(random.randint(-top, top), random.randint(1, bottom))) for _ in range(ncols)] for _ in range(nrows)]


def stable(random: Random, n: int) -> Rows:
    """The result is a stable n x n matrix: entries are halved until it is."""
    while True:
        A = rows(random, n, n)
        for _ in range(2):
            if is_stable(Matrix.of(A, shape=(n, n))):
                return A
            A = [[str(Fraction(x) / 2) for x in row] for row in A]


def nilpotent(random: Random, n: int) -> Rows:
    """The result is a strictly upper triangular matrix."""
    return [[x if j > i else "0" for j, x in enumerate(row)] for i, row in enumerate(rows(random, n, n))]


def system(random: Random, n: int, m: int, p: int, nu: int, A: Rows | None = None) -> dict[str, Any]:
    """The result is a SYSTEM with B and D."""
    sizes: dict[str, Any] = {"n": n, "m": m, "p": p, "nu": nu}
    shapes = {"B": (n, nu), "C": (p, n), "D": (p, nu), "F": (n, m), "G": (p, m)}
    return sizes | {"A": A or stable(random, n)} | {name: rows(random, *shape) for name, shape in shapes.items()}


def driven(system: dict[str, Any], s: int, past: int, u: object, v: object, w: object = None) -> Experiment:
    """The result is an experiment with random filters."""
    data = system | {"s": s, "past": past, "u_filter": u, "v_filter": v}
    return read_experiment(data if w is None else data | {"w_filter": w})


def random_experiment(seed: int, *, finite: bool, n: int = 2, m: int = 1, p: int = 2, nu: int = 1, s: int = 2, past: int = 2) -> Experiment:
    """Joint filters of one more noise than there are inputs, w with its own; rational ones unless `finite`."""
    random = Random(seed)
    given = system(random, n, m, p, nu, nilpotent(random, n) if finite else None)
    noise = nu + 1
    u: Any = [rows(random, nu, noise) for _ in range(random.randint(1, 3))]
    v: Any = [rows(random, m, noise) for _ in range(random.randint(1, 3))]
    w: Any = [rows(random, p, p) for _ in range(random.randint(1, 2))]
    if not finite:
        dens = (["1", "-1/2"], ["1", "1/3", "1/5"], ["1"])
        u, v, w = ({"num": x, "den": random.choice(dens)} for x in (u, v, w))
    return driven(given, s, past, u, v, w if random.random() < 0.7 else None)


def white_with_leads(given: dict[str, Any], s: int, past: int, phi: Sequence[Rows]) -> Experiment:
    """v(k) = sum_j phi[j] u(k+j) of a white u with nu channels; phi[j] is m x nu."""
    nu, delay = given["nu"], len(phi) - 1
    zero, one = [["0"] * nu for _ in range(nu)], [["1" if i == j else "0" for j in range(nu)] for i in range(nu)]
    return driven(given, s, past, [zero] * delay + [one], list(reversed(phi)))
