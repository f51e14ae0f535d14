"""Experiments that refute what one might expect of population limits: inputs of period three, found by search, and kept ones.

    Seasonal       A = [[t, -d], [1, 0]], B = e1, C = I, u(k) + a u(k-3) + b u(k-6) = e(k), s = past = 2
    seasonal       the experiment with such an input and a fault that is independent of it
    in_order       the members with fractions of small denominators that lose a rank, smallest first
    kept           the experiment of a name in counterexamples/, whose README says what each shows
    WITHOUT_RANK   those in which PI-MOESP loses a rank though v is uncorrelated with u at all lags

Samples three apart are of one phase, and phases are independent. Of the instruments, u(-1) belongs to the phase of u(2), which is not
given, u(-2) to that of u(1), which is; so the two reach the state through different filters. With k = a / (1 + b) the limit is O_s M, M
2 x 2, and det M = 0 iff k b d t = 1. The search takes that from here; whether the rank is lost is decided by a certificate of the member
that it finds.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib import resources
from itertools import product

from ...exact.limits.experiments import Experiment, read_experiment

LARGEST_DENOMINATOR = 5
BOX = (
    f"A = [[t, -d], [1, 0]], B = e1, C = I, u(k) + a u(k-3) + b u(k-6) = e(k), s = past = 2, denominators of t, d, b at most "
    f"{LARGEST_DENOMINATOR}, by the sum of all numerators and denominators of t, d, a, b"
)
WITHOUT_RANK = (
    "seasonal-input",
    "seasonal-input-coloured-fault",
    "moving-average-input",
    "moving-average-input-coloured-fault",
    "integer-taps",
    "rational-input",
    "rational-input-one-output",
)


@dataclass(frozen=True)
class Seasonal:
    """The four numbers of a member of the family; A and the recursion of u are stable."""

    t: Fraction
    d: Fraction
    a: Fraction
    b: Fraction

    @property
    def size(self) -> int:
        """The number by which the family is ordered."""
        return sum(abs(x.numerator) + x.denominator for x in (self.t, self.d, self.a, self.b))


@cache
def in_order(largest: int = LARGEST_DENOMINATOR) -> tuple[Seasonal, ...]:
    """Return the members that lose a rank, t, d and b with denominators up to `largest`, 0 < d, b < 1, 0 < t < 1 + d."""
    small = sorted({Fraction(i, j) for j in range(1, largest + 1) for i in range(1, j)})
    found = []
    for d, b, whole in product(small, small, (0, 1)):
        for part in (Fraction(0), *small):
            t = whole + part
            if not 0 < t < 1 + d:
                continue
            a = (1 + b) / (b * d * t)
            if a < 1 + b:
                found.append(Seasonal(t, d, a, b))
    return tuple(sorted(found, key=lambda one: (one.size, one.t, one.d, one.b)))


def seasonal(one: Seasonal, taps: int = 1, past: int = 2) -> Experiment:
    """Return the experiment of a member, with v(k) = f(k) + ... + f(k - taps + 1) of its own white f, F = e1 and G = 0."""
    return read_experiment(
        {
            "A": [[str(one.t), str(-one.d)], ["1", "0"]],
            "B": [["1"], ["0"]],
            "C": [["1", "0"], ["0", "1"]],
            "D": [["0"], ["0"]],
            "F": [["1"], ["0"]],
            "G": [["0"], ["0"]],
            "s": 2,
            "past": past,
            "u_filter": {"num": [[["1", "0"]]], "den": ["1", "0", "0", str(one.a), "0", "0", str(one.b)]},
            "v_filter": [[["0", "1"]]] * taps,
        }
    )


def kept(name: str) -> Experiment:
    """Return the experiment that stands in counterexamples/NAME.json."""
    text = resources.files("faultspace.proofs").joinpath("counterexamples", f"{name}.json").read_text(encoding="utf-8")
    return read_experiment(json.loads(text), where=name)
