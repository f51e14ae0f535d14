"""The search for the smallest counterexample: its order, its ranks, and the counterexamples of the ledger found again by brute force."""

from __future__ import annotations

import random
from itertools import islice, permutations, product
from typing import Any

import numpy as np
import pytest

from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.evidence import search
from faultspace.proofs.evidence.search import Box, Facts, Flags, chunks, first_of_orbits, ranks, smallest, systems_in_order
from tests.oracle import inspect_slowly
from tests.thorough import THOROUGH


def everything(facts: Facts) -> Flags:
    return np.ones(len(facts.A), dtype=np.bool_)


def slowly(total: int, largest: tuple[int, int, int]) -> list[dict[str, Any]]:
    """Return every system of a box in the stated order, by nested loops."""
    found = []
    sizes = sorted((d for d in product(*(range(1, x + 1) for x in largest)) if sum(d) <= total), key=lambda d: (sum(d), d[0], d[1], d[2]))
    for n, m, p in sizes:
        for entries in product((-1, 0, 1), repeat=(n + p) * (n + m)):
            cut = iter(entries)
            table: dict[str, Any] = {}
            for name, rows, cols in (("A", n, n), ("F", n, m), ("C", p, n), ("G", p, m)):
                table[name] = [[str(next(cut)) for _ in range(cols)] for _ in range(rows)]
            found.append(table)
    return found


def test_order_is_the_stated_one() -> None:
    box = Box(total=4, largest_n=1, largest_m=1, largest_p=2)
    fast = [system.to_json() for system in systems_in_order(box, everything)]
    assert fast == slowly(4, (1, 1, 2))
    assert len(fast) == 3**4 + 3**6


def moved_slowly(entries: tuple[int, ...], n: int, m: int, p: int) -> set[tuple[int, ...]]:
    """Return what renumbering and signs of states, outputs and faults make of a system, entry by entry."""
    table = [entries[: n * n], entries[n * n : n * (n + m)], entries[n * (n + m) : n * (n + m + p)], entries[n * (n + m + p) :]]
    shapes = ((n, n), (n, m), (p, n), (p, m))
    found = set()
    signed = [[(order, signs) for order in permutations(range(k)) for signs in product((1, -1), repeat=k)] for k in (n, p, m)]
    for states, outputs, faults in product(*signed):
        sides = ((states, states), (states, faults), (outputs, states), (outputs, faults))
        image: list[int] = []
        for part, (rows, cols), (left, right) in zip(table, shapes, sides, strict=True):
            for i, j in product(range(rows), range(cols)):
                image.append(left[1][i] * right[1][j] * part[left[0][i] * cols + right[0][j]])
        found.add(tuple(image))
    return found


@pytest.mark.parametrize(("n", "m", "p"), [(1, 1, 1), (1, 2, 1), (1, 1, 2), (2, 1, 1), (1, 2, 2)])
def test_first_of_orbits_are_the_least_of_what_renumbering_and_signs_make_of_them(n: int, m: int, p: int) -> None:
    box = Box(total=n + m + p, largest_n=n, largest_m=m, largest_p=p, least_m=m)
    seen: set[tuple[int, ...]] = set()
    slow = []
    for entries in product((-1, 0, 1), repeat=(n + m) * (n + p)):
        if entries not in seen:
            slow.append(entries)
            seen |= moved_slowly(entries, n, m, p)
    kept = [facts for facts in first_of_orbits(box) if (facts.n, facts.m, facts.C.shape[1]) == (n, m, p)]
    parts = [np.concatenate([getattr(facts, name).reshape(len(facts.A), -1) for name in "AFCG"], axis=1) for facts in kept]
    assert [tuple(row) for row in np.concatenate(parts).tolist()] == slow


def test_what_is_known_of_a_box_serves_the_next_and_is_not_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search that was stopped, one through a smaller box and one through a larger see the systems that a search of their own sees."""

    def seen(box: Box, known: dict[tuple[int, ...], search.Known] | None = None) -> list[tuple[list[int], list[int]]]:
        return [
            ([*facts.A.shape, *facts.G.shape, *facts.A.ravel(), *facts.G.ravel()], facts.rank(2).tolist())
            for facts in first_of_orbits(box, known)
        ]

    monkeypatch.setattr(search, "CHUNK", 50)
    small, large = Box(total=3, largest_n=1, largest_m=1, largest_p=1), Box(total=4, largest_n=2, largest_m=2, largest_p=2)
    known: dict[tuple[int, ...], search.Known] = {}
    next(first_of_orbits(large, known))  # stopped after the first batch
    assert seen(small, known) == seen(small)
    assert seen(large, known) == seen(large)
    monkeypatch.setattr(search, "_digits", None)
    assert len(seen(large, known)) > len(seen(small, known)) > 0


def test_a_box_without_entries_says_so() -> None:
    assert smallest(Box(total=2, largest_n=1, largest_m=1, largest_p=1), everything, lambda s: True) is None


@pytest.mark.parametrize("shape", [(3, 3), (4, 2), (2, 5), (1, 1), (6, 4)])
def test_batch_ranks_are_the_ranks(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(0)
    matrices = rng.integers(-1, 2, size=(300, *shape))
    matrices[::3] = matrices[::3, :1] * np.arange(shape[0])[None, :, None]  # rank at most one
    assert ranks(matrices).tolist() == [np.linalg.matrix_rank(m.astype(float)) for m in matrices]


def test_batch_ranks_refuse_what_the_prime_cannot_decide() -> None:
    with pytest.raises(ArithmeticError, match="minor"):
        ranks(np.full((1, 3, 3), 10**6))


def test_facts_agree_with_the_oracle() -> None:
    rng = random.Random(0)
    for box in (Box(total=4, largest_n=1, largest_m=1, largest_p=2), Box(total=4, largest_n=2, largest_m=1, largest_p=1)):
        for facts in chunks(box):
            for i in rng.sample(range(len(facts.A)), min(25, len(facts.A))):
                slow = inspect_slowly(facts.system(i).to_json())
                assert [int(facts.rank(s)[i]) for s in range(1, facts.n + 3)] == slow["window_ranks"][: facts.n + 2]
                assert bool(facts.observable[i]) == slow["observable"]
                assert bool(facts.controllable[i]) == slow["controllable"]
                assert bool(facts.left_invertible[i]) == slow["left_invertible"]
                none = facts.n + 1
                assert int(facts.delay_known_state[i]) == (none if slow["delay_known_state"] is None else slow["delay_known_state"])
                assert int(facts.delay_unknown_state[i]) == (none if slow["delay_unknown_state"] is None else slow["delay_unknown_state"])


def slow_gap_is_wrong(data: dict[str, Any]) -> bool:
    """Say whether it is observable, left-invertible, and gap(s) != m for some s >= max(l, n - 1, 1): straight from the oracle."""
    slow = inspect_slowly(data)
    if not (slow["observable"] and slow["left_invertible"]):
        return False
    rank = [0, *slow["window_ranks"]]
    start = max(slow["delay_known_state"], slow["n"] - 1, 1)
    return any(rank[s + 1] - rank[s] != slow["m"] for s in range(start, len(rank) - 1))


def test_nothing_smaller_than_the_counterexample_to_n_minus_1_at_four() -> None:
    """The ledger's counterexample has n + m + p = 5; below that the oracle finds none among all systems with n = 1."""
    step = 1 if THOROUGH else 4  # entries have three values: a step of three would leave the last one at the same
    assert not any(slow_gap_is_wrong(data) for data in islice(slowly(4, (1, 1, 2)), 0, None, step))


def test_a_search_whose_test_lets_too_little_through_misses_the_smallest(monkeypatch: pytest.MonkeyPatch) -> None:
    box = Box(total=4, largest_n=1, largest_m=1, largest_p=2)
    first = smallest(box, lambda f: f.left_invertible, lambda s: True)
    monkeypatch.setattr(search, "ranks", lambda matrices: np.zeros(len(matrices), dtype=np.int64))
    assert smallest(box, lambda f: f.left_invertible, lambda s: True) != first


def test_facts_system_round_trip() -> None:
    facts = next(chunks(Box(total=4, largest_n=1, largest_m=1, largest_p=2)))
    assert isinstance(facts.system(5), ResidualSystem)
    assert facts.system(5).A.to_json() == [[str(int(facts.A[5, 0, 0]))]]
