"""These are kernel rows changed as an algebraist would change them: what a checker accepts of them must be true all the same.

    mutants       certificates of window ranks of random systems whose rows were multiplied, combined, left out, or read at a bad prime;
                  each states what its rows would prove
    is_true       whether the ranks of the windows, each computed by elimination over the integers, are those that are stated
    Counts        how many were true and accepted, true and refused, false and accepted, false and refused
    needed        asks that a false statement is refused for a reason, and passes where that check is left out
    main          python -m tests.proofs.basis_mutants COUNT [SEED]

Each check of a minimal basis has the change that it is there for: rows times q - a have a common factor; a row with a multiple of another
added, of higher degree, is not row-reduced; a row left out leaves the pencil's rank too small; a prime that divides an entry gives fewer or
more rows than there are.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from random import Random
from typing import Any

import pytest

from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem, read_system
from faultspace.exact.system.windows import window_matrix
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.proofs.examples import Certificate, written

Rows = list[list[list[int]]]
PRIMES = (2, 3, 5, 7, 11, 2**27 - 39)


@dataclass
class Counts:
    """This counts by what is so and by what the checker says."""

    true_accepted: int = 0
    true_refused: int = 0
    false_accepted: int = 0
    false_refused: int = 0


def random_system(rng: Random) -> ResidualSystem:
    """Return a small system with many zeros, now and then without feedthrough, unobservable or with entries that a small prime divides."""
    n, m, p, blank = rng.randint(1, 4), rng.randint(0, 3), rng.randint(1, 4), 0.8 * rng.random()
    entries = rng.choice(((-2, -1, 1, 2), (-1, 1), (-2, 3, 6, 30)))

    def block(height: int, width: int, blank: float = blank) -> list[list[int]]:
        return [[0 if rng.random() < blank else rng.choice(entries) for _ in range(width)] for _ in range(height)]

    gains = block(p, m, 1.0 if rng.random() < 0.3 else blank)
    return ResidualSystem.of(block(n, n), block(n, m), block(p, n), gains, n=n, m=m, p=p)


def times(row: list[list[int]], factor: list[int]) -> list[list[int]]:
    """Return the row times a polynomial."""
    found = [[0] * len(row[0]) for _ in range(len(row) + len(factor) - 1)]
    for i, c in enumerate(row):
        for j, x in enumerate(factor):
            found[i + j] = [a + x * b for a, b in zip(found[i + j], c, strict=True)]
    return found


def linear(rng: Random, rows: Rows) -> None:
    """A row times q - a."""
    i = rng.randrange(len(rows))
    rows[i] = times(rows[i], [rng.randint(-2, 2), 1])


def quadratic(rng: Random, rows: Rows) -> None:
    """A row times a polynomial that need not have a root."""
    i = rng.randrange(len(rows))
    rows[i] = times(rows[i], [1, rng.randint(-2, 2), 1])


def left_out(rng: Random, rows: Rows) -> None:
    """Leave a row out."""
    del rows[rng.randrange(len(rows))]


def twice(rng: Random, rows: Rows) -> None:
    """A row once more."""
    rows.append(rows[rng.randrange(len(rows))])


def combined(rng: Random, rows: Rows) -> None:
    """A row with a multiple of another added, of a degree that may be higher."""
    i, j = rng.randrange(len(rows)), rng.randrange(len(rows))
    if i == j:
        return
    other = times(rows[j], [rng.randint(-2, 2) for _ in range(rng.randint(1, 3))])
    width, length = len(rows[i][0]), max(len(rows[i]), len(other))
    own, other = (row + [[0] * width] * (length - len(row)) for row in (rows[i], other))
    rows[i] = [[a + b for a, b in zip(c, d, strict=True)] for c, d in zip(own, other, strict=True)]


def disturbed(rng: Random, rows: Rows) -> None:
    """One number changed."""
    coefficient = rng.choice(rng.choice(rows))
    coefficient[rng.randrange(len(coefficient))] += rng.choice((-1, 1))


def kept(rng: Random, rows: Rows) -> None:
    """All as it is; the prime may change."""


CHANGES: tuple[Callable[[Random, Rows], None], ...] = (linear, quadratic, left_out, twice, combined, disturbed, kept)


def mutants(rng: Random, count: int) -> Iterator[Certificate]:
    """Yield so many certificates, about each system those of every change."""
    made = 0
    while made < count:
        system = random_system(rng)
        for certificate in (make.window_ranks_of(system), make.window_ranks(kernel_representation(system))):
            for change in CHANGES:
                if (mutant := _changed(rng, written(certificate), change)) is not None and made < count:
                    made += 1
                    yield mutant


def _changed(rng: Random, certificate: Certificate, change: Callable[[Random, Rows], None]) -> Certificate | None:
    s, w = certificate["statement"], certificate["witness"]
    key = "kernel" if "kernel" in w else "kernel_modulo"
    rows = [[[int(x) for x in c] for c in row["coefficients"]] for row in w[key]]
    if not rows and change is not kept:
        return None
    change(rng, rows)
    for row in rows:
        while len(row) > 1 and not any(row[-1]):
            row.pop()
    rows.sort(key=len)
    if rng.random() < 0.2 or change is kept:
        w["prime"] = rng.choice(PRIMES)
        w["point"] = rng.choice(("infinity", rng.randrange(w["prime"])))
    pivots = [rng.choice([j for j, x in enumerate(row[-1]) if x % w["prime"]] or [0]) for row in rows]
    if key == "kernel_modulo":
        rows = [[[x % w["prime"] for x in c] for c in row] for row in rows]
    w[key] = [{"pivot": pivot, "coefficients": row} for pivot, row in zip(pivots, rows, strict=True)]
    indices, windows = [len(row) - 1 for row in rows], range(1, len(s["window_ranks"]) + 1)
    r = len(s["system"]["C"]) - len(rows)
    ranks = [k * r + sum(min(k, mu) for mu in indices) for k in windows]
    s |= {"normal_rank": r, "left_minimal_indices": indices, "window_ranks": ranks}
    return certificate if r >= 0 else None


def is_true(statement: dict[str, Any]) -> bool:
    """Return whether rank [O_s T_s] is what is stated, s = 1, ..., n + 3: from n + 1 on both grow by a constant."""
    system = read_system(statement["system"]).residual
    built = (window_matrix(system, s).flint.numer_denom()[0] for s in range(1, len(statement["window_ranks"]) + 1))
    return bool(statement["window_ranks"] == [window.rank() for window in built])


def tried(rng: Random, count: int) -> tuple[Counts, list[Certificate]]:
    """Return what the checker says of so many mutants, and those that it accepts though they are false."""
    counts, wrong = Counts(), list[Certificate]()
    for mutant in mutants(rng, count):
        try:
            checker.verify(mutant)
            accepted = True
        except (checker.Rejected, checker.Malformed):
            accepted = False
        word = f"{'true' if is_true(mutant['statement']) else 'false'}_{'accepted' if accepted else 'refused'}"
        setattr(counts, word, getattr(counts, word) + 1)
        if word == "false_accepted":
            wrong.append(mutant)
    return counts, wrong


def needed(false: Certificate, reason: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ask that the statement is false and refused for this reason, and that it passes once the check that gives the reason is left out."""
    assert not is_true(false["statement"])
    with pytest.raises(checker.Rejected, match=reason):
        checker.verify(false)
    strict = checker.require
    monkeypatch.setattr(checker, "require", lambda condition, why, *error: strict(condition or reason in why, why, *error))
    checker.verify(false)


def main() -> int:
    """Prints the counts and what was accepted though false; 1 where there is such."""
    count, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    counts, wrong = tried(Random(seed), count)
    print(counts, *wrong, sep="\n")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
