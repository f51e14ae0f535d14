"""These are experiments that lack one hypothesis of proposition-1 and have the others, with windows of every length; and the small ones to
search.

    aimed_experiments   as many of each family, then RANK_DROPS and UNREAD
    small_experiments   n = 1, then n = 2: every combination of a few values, for the smallest counterexample; BOX tells which
    RANK_DROPS          u coloured, v independent of it, the limit of lower rank than O_s although all else is as it should be
    UNREAD              observable on s samples and not on s - 1: the limit is all of the range of O_s, and A cannot be read from it

The family of RANK_DROPS: A = [[t, -d], [1, 0]], B = e1, u(k) + a u(k-s-1) + b u(k-2s-2) = e(k). Where C = I and s = 2 the rank drops for
a b d t = 1 + b; where C = [1 0] and s = 3 for a b d (t^2 - d) = 1 + b. The reflection coefficient of order s + 1 is a / (1 + b).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from random import Random
from typing import Any

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, rank
from ...exact.algebra.stability import is_stable
from ...exact.limits.experiments import Experiment, read_experiment
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix, reachability_matrix

Rows = list[list[str]]
Filter = dict[str, Any]

INDEPENDENT: Filter = {"num": [[["0", "1"]]], "den": ["1"]}
WHITE: Filter = {"num": [[["1", "0"]]], "den": ["1"]}
MOVING_AVERAGE: Filter = {"num": [[["1", "0"]], [["1/2", "0"]]], "den": ["1"]}


def experiment(system: dict[str, Any], s: int, past: int, u: Filter, v: Filter) -> Experiment:
    """An experiment with these windows, u and v filters of the same two noises."""
    return read_experiment(system | {"s": s, "past": past, "u_filter": u, "v_filter": v})


def drop(t: str, d: str, a: str, b: str, s: int, C: Rows) -> Experiment:
    """Return a member of the family of RANK_DROPS, whether or not the rank drops there."""
    none, den = [["0"]] * len(C), ["1", *["0"] * (2 * s + 2)]
    den[s + 1], den[2 * s + 2] = a, b
    system = {"A": [[t, str(-Fraction(d))], ["1", "0"]], "B": [["1"], ["0"]], "F": [["1"], ["0"]], "C": C, "D": none, "G": none}
    return experiment(system, s, 2, {"num": [[["1", "0"]]], "den": den}, INDEPENDENT)


ONE_OUTPUT: Rows = [["1", "0"]]
BOTH_STATES: Rows = [["1", "0"], ["0", "1"]]
RANK_DROPS = (
    drop("5/3", "7/9", "3/2", "3/4", 3, ONE_OUTPUT),
    drop("7/4", "4/5", "5/3", "3/4", 2, BOTH_STATES),
    drop("5/3", "9/10", "3/2", "4/5", 2, BOTH_STATES),
    drop("9/5", "5/6", "3/2", "4/5", 2, BOTH_STATES),
)
_READ_LATE: dict[str, Any] = {"A": [["0", "1"], ["-1/4", "1/2"]], "B": [["0"], ["1"]], "F": [["1"], ["0"]], "D": [["0"]], "G": [["0"]]}
UNREAD = experiment(_READ_LATE | {"C": ONE_OUTPUT}, 2, 2, WHITE, INDEPENDENT)


def aimed_experiments(count: int) -> Iterator[Experiment]:
    """Yield `count` experiments of each family over Q, then the fixed ones."""
    for family in FAMILIES:
        random = Random(family)
        for _ in range(count):
            yield _drawn(random, family)
    yield from (*RANK_DROPS, UNREAD)


FAMILIES = (
    "all", "v(k), u(k-l) uncorrelated, l >= 1", "v(k), u(k) uncorrelated", "v(k), u(k+l) uncorrelated, l >= 1", "(A, B) controllable",
    "(A, C) observable on s - 1", "past >= n", "u white", "u autoregressive of order at most s",
)  # fmt: skip


def _drawn(random: Random, family: str) -> Experiment:
    """Draw until s and past are as the family wants them; u white, or of order at most s, or a moving average where it may be."""
    while True:
        n, p = random.choice((1, 2, 2, 3)), random.randint(1, 2)
        A, B, F, C = (_rows(random, *shape) for shape in ((n, n), (n, 1), (n, 1), (p, n)))
        if family == "(A, B) controllable" and n > 1:
            A[-1][:-1], B[-1] = ["0"] * (n - 1), ["0"]
        system = {"A": _stabilised(A), "B": B, "F": F, "C": C, "D": _rows(random, p, 1), "G": _rows(random, p, 1)}
        s, past = random.randint(1, n + 2), random.randint(1, n + 2)
        residual = ResidualSystem.of(system["A"], F, C, system["G"])
        lacks = {
            "(A, B) controllable": rank(reachability_matrix(ResidualSystem.of(system["A"], B, C, system["D"]))) < n,
            "(A, C) observable on s - 1": rank(observability_matrix(residual, s - 1)) < n,
            "past >= n": past < n,
        }
        if all(lacking == (name == family) for name, lacking in lacks.items()):
            return experiment(system, s, past, *_signals(random, family, s))


def _signals(random: Random, family: str, s: int) -> tuple[Filter, Filter]:
    """The filters of u and v: of the same noise where they are to be correlated, else each of its own; half of the independent v are
    coloured.
    """
    gain = random.choice(("1", "-1", "2", "1/2"))
    delayed: Filter = {"num": [[["0", "0"]], [["1", "0"]]], "den": ["1"]}
    match family:
        case "v(k), u(k-l) uncorrelated, l >= 1":
            return WHITE, {"num": [*[[["0", "0"]]] * random.randint(1, 2), [[gain, "0"]]], "den": ["1"]}
        case "v(k), u(k) uncorrelated":
            return WHITE, {"num": [[[gain, random.choice(("0", "1"))]]], "den": ["1"]}
        case "v(k), u(k+l) uncorrelated, l >= 1":
            return delayed, {"num": [[[gain, random.choice(("0", "1"))]]], "den": ["1"]}
    u = WHITE
    if family == "u white":
        order = random.randint(1, s)
        u = {"num": [[["1", "0"]]], "den": ["1", *(str(Fraction(random.randint(-2, 2), 3 * order)) for _ in range(order - 1)), "1/3"]}
    if family == "u autoregressive of order at most s":
        den = ["1", *random.choice(([], ["-1/2"], ["1/3", "-1/4"]))]
        u = {"num": [[["1", "0"]], *([[[str(Fraction(random.randint(-3, 3), 4)), "0"]]] * random.randint(1, 2)), [["1", "0"]]], "den": den}
    return u, random.choice((INDEPENDENT, {"num": [[["0", "1"]], [["0", gain]]], "den": ["1", "-1/3"]}))


BOX = (
    "n = 1: A = 1/2, B = F = C = 1, G in {0, 1}, s = past = 2, u white or e(k) + e(k-1)/2, v white of its own, u(k-1), u(k) or u(k+1); "
    "n = 2: A in {[[0, 1], [1/4, 0]], [[0, 1], [0, 1/2]], diag(1/2, 0)}, B and F in {e1, e2}, C in {[1 0], [1 1]}, G = 0, s in {2, 3}, "
    "past in {1, 2}, u and v white; D = 0"
)


def small_experiments() -> Iterator[Experiment]:
    """Yield the experiments of BOX, the smaller n first."""
    delayed: Filter = {"num": [[["0", "0"]], [["1", "0"]]], "den": ["1"]}
    both = (WHITE, INDEPENDENT)
    drives = (both, (MOVING_AVERAGE, INDEPENDENT), (WHITE, delayed), (WHITE, WHITE), (delayed, WHITE))
    for G, (u, v) in product(("0", "1"), drives):
        yield experiment({"A": [["1/2"]], "B": [["1"]], "F": [["1"]], "C": [["1"]], "D": [["0"]], "G": [[G]]}, 2, 2, u, v)
    states = ([["0", "1"], ["1/4", "0"]], [["0", "1"], ["0", "1/2"]], [["1/2", "0"], ["0", "0"]])
    columns: Sequence[Rows] = ([["1"], ["0"]], [["0"], ["1"]])
    for A, B, F, C, s, past in product(states, columns, columns, (ONE_OUTPUT, [["1", "1"]]), (2, 3), (1, 2)):
        yield experiment({"A": A, "B": B, "F": F, "C": C, "D": [["0"]], "G": [["0"]]}, s, past, *both)


def _rows(random: Random, nrows: int, ncols: int) -> Rows:
    return [[str(Fraction(random.randint(-3, 3), random.choice((1, 2, 3)))) for _ in range(ncols)] for _ in range(nrows)]


def _stabilised(A: Rows) -> Rows:
    while not is_stable(Matrix.of(A, QQ)):
        A = [[str(Fraction(x) / 2) for x in row] for row in A]
    return A
