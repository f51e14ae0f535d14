"""What the quantities of claims are, by going through every word of a system over a small field, and by minors and null spaces over Q.

    by_words(system)     name -> value, of a SYSTEM over GF(q) of a few entries: states and words are sets, and are counted
    by_definition(json)  name -> value, of a SYSTEM over any field: ranks of built matrices, minors of the pencil
    windows_by_words     the functions of s, s = 0, ..., up to `longest`

Two systems of numbers, which do not know each other: a set of q^d vectors has the dimension d.
"""

from __future__ import annotations

from itertools import pairwise, product
from math import inf
from typing import Any

from .fault_space import fault_space, fault_space_limit
from .linear import above, beside, rank
from .pencil import infinite_zero_orders_of_pencil, invariant_zero_polynomial, normal_rank
from .quantities import KNOWN, UNKNOWN, delay, left_minimal_indices, right_minimal_indices
from .stability import inside_circle, is_stable
from .systems import System, parse_system
from .windows import observability, power, toeplitz_rank, window_rank

Vector = tuple[int, ...]
Rows = list[list[int]]


class Words:
    """A system over GF(q) whose states, faults and outputs are tuples of residues."""

    def __init__(self, q: int, A: Rows, F: Rows, C: Rows, G: Rows, n: int, m: int, p: int) -> None:
        self.q, self.n, self.m, self.p = q, n, m, p
        self.tables = A, F, C, G
        self.states = list(product(range(q), repeat=n))
        self.faults = list(product(range(q), repeat=m))
        self.moves = {(x, v): (self._next(A, F, x, v), self._next(C, G, x, v)) for x in self.states for v in self.faults}
        self.rest = (0,) * n
        self.nothing = (0,) * p

    def _next(self, first: Rows, second: Rows, x: Vector, v: Vector) -> Vector:
        pairs = zip(first, second, strict=True)
        return tuple(
            (sum(a * b for a, b in zip(one, x, strict=True)) + sum(a * b for a, b in zip(two, v, strict=True))) % self.q
            for one, two in pairs
        )

    def dimension(self, count: int) -> int:
        """Return the dimension of a space with so many vectors."""
        d = 0
        while self.q**d < count:
            d += 1
        assert self.q**d == count, "the set is no space"
        return d

    def outputs(self, s: int, starts: list[Vector], faults: list[Vector]) -> set[tuple[Vector, ...]]:
        """Return every word of s outputs from these states under these faults."""
        words: set[tuple[Vector, tuple[Vector, ...]]] = {(x, ()) for x in starts}
        for _ in range(s):
            words = {(self.moves[x, v][0], (*word, self.moves[x, v][1])) for x, word in words for v in faults}
        return {word for _, word in words}

    def rank_OT(self, s: int) -> int:
        return self.dimension(len(self.outputs(s, self.states, self.faults)))

    def rank_O(self, s: int) -> int:
        return self.dimension(len(self.outputs(s, self.states, [(0,) * self.m])))

    def rank_T(self, s: int) -> int:
        return self.dimension(len(self.outputs(s, [self.rest], self.faults)))

    def weakly_unobservable(self) -> int:
        """Keep the states from which some fault has output zero and stays among those that are kept."""
        kept = set(self.states)
        while True:
            stay = {x for x in kept if any(self.moves[x, v][1] == self.nothing and self.moves[x, v][0] in kept for v in self.faults)}
            if stay == kept:
                return self.dimension(len(kept))
            kept = stay

    def strongly_reachable(self) -> int:
        """Go on from rest with output zero until nothing new comes; the steps of a word may begin with waiting at rest."""
        found = {self.rest}
        while True:
            grown = found | {self.moves[x, v][0] for x in found for v in self.faults if self.moves[x, v][1] == self.nothing}
            if grown == found:
                return self.dimension(len(found))
            found = grown

    def reached(self, s: int) -> int:
        """Return the dimension of what s faults reach from rest."""
        found = {self.rest}
        for _ in range(s):
            found = {self.moves[x, v][0] for x in found for v in self.faults}
        return self.dimension(len(found))

    def delay(self, starts: list[Vector]) -> float:
        """Return the least l with which the outputs 0, ..., l belong to one v(0) alone."""
        for last in range(self.n + 1):
            firsts: dict[tuple[Vector, ...], set[Vector]] = {}
            started = ((self.moves[x, v], v) for x in starts for v in self.faults)
            words: set[tuple[Vector, tuple[Vector, ...], Vector]] = {(after, (output,), v) for (after, output), v in started}
            for _ in range(last):
                words = {(self.moves[x, v][0], (*word, self.moves[x, v][1]), first) for x, word, first in words for v in self.faults}
            for _, word, first in words:
                firsts.setdefault(word, set()).add(first)
            if all(len(one) == 1 for one in firsts.values()):
                return last
        return inf


def by_words(words: Words) -> dict[str, Any]:
    """Return the quantities that sets of words and states tell."""
    n = words.n
    observed = [words.rank_O(s) for s in range(n + 1)]
    reached = [words.reached(s) for s in range(n + 1)]
    known, unknown = words.delay([words.rest]), words.delay(words.states)
    weak = words.weakly_unobservable()
    r = words.rank_T(n + 1) - words.rank_T(n)
    return {
        "n": n,
        "m": words.m,
        "p": words.p,
        "normal_rank": r,
        "left_invertible": r == words.m,
        "right_invertible": r == words.p,
        "observability_index": observed.index(observed[n]),
        "controllability_index": reached.index(reached[n]),
        "unobservable_dimension": n - observed[n],
        "uncontrollable_dimension": n - reached[n],
        "observable": observed[n] == n,
        "controllable": reached[n] == n,
        "minimal": observed[n] == n == reached[n],
        "weakly_unobservable_dimension": weak,
        "strongly_observable": weak == 0,
        "strongly_reachable_dimension": words.strongly_reachable(),
        "delay_known": known,
        "delay_unknown": unknown,
    }


def windows_by_words(words: Words, longest: int) -> dict[str, list[int]]:
    """Return what s samples tell, s = 0, ..., longest."""
    both = [words.rank_OT(s) for s in range(longest + 2)]
    return {
        "rank_O": [words.rank_O(s) for s in range(longest + 1)],
        "rank_T": [words.rank_T(s) for s in range(longest + 1)],
        "rank_OT": both[:-1],
        "gap": [after - before for before, after in pairwise(both)],
    }


def by_definition(json: dict[str, Any]) -> dict[str, Any]:
    """Return the quantities that ranks, minors and null spaces tell."""
    system = parse_system(json)
    n, m = system.n, system.m
    left, right, orders = left_minimal_indices(system), right_minimal_indices(system), infinite_zero_orders_of_pencil(system)
    zeros = invariant_zero_polynomial(system)
    finite, full = len(zeros) - 1, normal_rank(system) == rank(above(system.F, system.G))
    observed = [rank(observability(system, s)) for s in range(n + 1)]
    blocks = [power(system.A, k) @ system.F for k in range(n)]
    reached = [rank(beside(*blocks[:s])) if s else 0 for s in range(n + 1)]
    delays = {"delay_known": delay(system, KNOWN), "delay_unknown": delay(system, UNKNOWN)}
    answers: dict[str, Any] = {
        "n": n,
        "m": m,
        "p": system.p,
        "normal_rank": normal_rank(system),
        "left_minimal_indices": tuple(left),
        "right_minimal_indices": tuple(right),
        "lag": max(left, default=0),
        "infinite_zero_orders": tuple(orders),
        "infinite_zeros": sum(orders),
        "finite_zeros": finite,
        "zeta": finite + sum(orders),
        "left_invertible": normal_rank(system) == m,
        "right_invertible": normal_rank(system) == system.p,
        "observability_index": observed.index(observed[n]),
        "controllability_index": reached.index(reached[n]),
        "unobservable_dimension": n - observed[n],
        "uncontrollable_dimension": n - reached[n],
        "observable": observed[n] == n,
        "controllable": reached[n] == n,
        "minimal": observed[n] == n == reached[n],
        "weakly_unobservable_dimension": n - window_rank(system, n) + toeplitz_rank(system, n),
        "strongly_observable": full and finite == 0,
        "n_z": fault_space_limit(system).height,
    }
    answers |= {name: inf if value is None else value for name, value in delays.items()}
    if json.get("field", "Q") == "Q":
        inside = inside_circle(zeros)
        answers |= {"minimum_phase": inside, "strongly_detectable": full and inside, "stable": is_stable(system)}
    return answers


def windows_by_definition(json: dict[str, Any], longest: int) -> dict[str, list[int]]:
    """Return what s samples tell, s = 0, ..., longest."""
    system: System = parse_system(json)
    both = [window_rank(system, s) for s in range(longest + 2)]
    return {
        "rank_O": [rank(observability(system, s)) for s in range(longest + 1)],
        "rank_T": [toeplitz_rank(system, s) for s in range(longest + 1)],
        "rank_OT": both[:-1],
        "gap": [after - before for before, after in pairwise(both)],
        "solutions": [fault_space(system, s).height for s in range(longest + 1)],
    }
