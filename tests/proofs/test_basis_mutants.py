"""Kernel rows with hints: structured mutations are refused or true, and each check of the checker is needed for that.

`python -m tests.proofs.basis_mutants 100000` tries so many; here it is a sample.
"""

from __future__ import annotations

from random import Random

import pytest

from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.modular_rows import pencil_rank_at
from faultspace.exact.structure.short_rows import short_rows
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.proofs.basis_mutants import CHANGES, Rows, is_true, needed, tried
from tests.proofs.examples import FLAT, Certificate, seen, written

PRIME = 2**27 - 39
VANISHES = ResidualSystem.of([[0]], [[1]], [[PRIME], [0]], [[0], [1]])  # modulo the prime the first output is zero
HALF = ResidualSystem.of([], [], [[], []], [[0], [1]], n=0, m=1, p=2)  # the first output is zero
LONG = ResidualSystem.of([[0, 1, 0], [0, 0, 1], [0, 0, 0]], [[]] * 3, [[1, 0, 0], [0, 0, PRIME]], [[]] * 2, n=3, m=0, p=2)


def stated(system: ResidualSystem, rows: Rows, pivots: list[int], key: str = "kernel") -> Certificate:
    """Return the certificate that these rows would give."""
    found = written(make.window_ranks(kernel_representation(system)))
    s, w = found["statement"], found["witness"]
    indices, r = [len(row) - 1 for row in rows], system.p - len(rows)
    ranks = [k * r + sum(min(k, mu) for mu in indices) for k in range(1, system.n + 4)]
    found["statement"] = s | {"normal_rank": r, "left_minimal_indices": indices, "window_ranks": ranks}
    written_rows = [{"pivot": pivot, "coefficients": row} for pivot, row in zip(pivots, rows, strict=True)]
    found["witness"] = {"prime": PRIME, "point": w["point"], key: written_rows}
    return found


# The reason that is left out -> a false statement that then passes.
NEEDED: dict[str, Certificate] = {
    "at the pivots are dependent": stated(HALF, [[[1, 0]], [[1, 0]]], [0, 1]),
    "may have a common factor": stated(seen(), [[[0, 1], [-1, -1], [1, 0]]], [0]),
    "there may be more rows": stated(seen(), [], []),
    "does not annihilate the system": stated(VANISHES, [[[1, 0]]], [0]),
    "that their shape allows": stated(VANISHES, [[[1, 0]]], [0], "kernel_modulo"),
}


@pytest.mark.parametrize("reason", NEEDED)
def test_without_one_of_the_checks_something_false_passes(reason: str, monkeypatch: pytest.MonkeyPatch) -> None:
    needed(NEEDED[reason], reason, monkeypatch)


def test_structured_mutations_are_refused_or_true() -> None:
    counts, wrong = tried(Random(16), 1200)
    assert wrong == []
    assert counts.true_accepted > 200 and counts.false_refused > 400


def test_degrees_that_only_add_up_are_not_enough_modulo_a_prime() -> None:
    # Modulo the prime the second output is zero, with index 0; the first has 3: they add up to n, and their windows could be larger.
    false = stated(LONG, [[[0, 1]], [[0, 0], [0, 0], [0, 0], [1, 0]]], [1, 0], "kernel_modulo")
    assert not is_true(false["statement"])
    with pytest.raises(checker.Rejected, match="that their shape allows"):
        checker.verify(false)


def test_exact_rows_that_vanish_in_different_slots_do_not_cancel() -> None:
    """What two rows leave over cannot add up to zero in the one number in which both stand."""
    true = written(make.window_ranks(kernel_representation(FLAT)))
    checker.verify(true)
    one, other = ([[x, y]] for x, y in ((1, 0), (0, 1)))
    system = checker.System({"A": [], "F": [], "C": [[], []], "G": [[1], [-1]], "n": 0, "m": 1, "p": 2})

    def left(rows: list[checker.Vectors]) -> bool:
        return any(system.field.seen(system, rows, system.F, system.G))

    for shift in range(12):
        assert left([[[2**shift, 0]], other]) and left([one, other])
    assert not left([[[1, 1]], [[5, 5]]])


def test_short_rows_are_shorter_and_span_the_same() -> None:
    rng = Random(3)
    system = ResidualSystem.of(*([[rng.randint(-9, 9) for _ in range(w)] for _ in range(h)] for h, w in ((9, 9), (9, 2), (5, 9), (5, 2))))
    kernel = kernel_representation(system)
    rows = [[[int(x) for x in c] for c in row.coefficients.elements()] for row in kernel.rows]
    short = short_rows(rows, [row.pivot for row in kernel.rows])
    bits = [max(abs(x).bit_length() for row in some for c in row for x in c) for some in (rows, short)]
    assert bits[1] < 0.6 * bits[0] and [*map(len, short)] == [*map(len, rows)]
    checker.verify(written(make.window_ranks(kernel)))


def test_rows_pass_exactly_where_their_degrees_are_the_left_minimal_indices() -> None:
    """Over small fields, where much goes wrong by chance: the slow twin is what the recursion of the output-nulling subspaces says."""
    rng, seen_minimal, refused = Random(16), 0, 0
    for _ in range(400):
        prime, (n, m, p) = rng.choice((2, 3, 5)), (rng.randint(0, 4), rng.randint(0, 2), rng.randint(1, 3))
        blocks = [[[rng.randrange(prime) for _ in range(w)] for _ in range(h)] for h, w in ((n, n), (n, m), (p, n), (p, m))]
        exact = ResidualSystem.of(*blocks, field=PrimeField(prime), n=n, m=m, p=p)
        kernel = kernel_representation(exact)
        rows: Rows = [[[int(x) for x in c] for c in row.coefficients.elements()] for row in kernel.rows]
        if rows and rng.random() < 0.8:
            rng.choice(CHANGES)(rng, rows)
        rows = [[[x % prime for x in c] for c in row] for row in rows]
        for row in rows:
            while len(row) > 1 and not any(row[-1]):
                row.pop()
        rows.sort(key=len)
        pivots = [rng.choice([j for j, x in enumerate(row[-1]) if x] or [0]) for row in rows]
        about = checker.SUBJECTS["system"](exact.to_json())
        leading = Matrix.of([[row[-1][j] for j in pivots] for row in rows], PrimeField(prime), shape=(len(rows), len(rows)))
        flat = [Matrix.of([[x for c in row for x in c]], PrimeField(prime)) for row in rows]
        vanish = all((one @ window_matrix(exact, len(row))).is_zero() for one, row in zip(flat, rows, strict=True))
        minimal = vanish and rank(leading) == len(rows) and tuple(len(row) - 1 for row in rows) == kernel.left_minimal_indices
        for point in (*range(prime), "infinity"):
            there = n + rank(exact.G) if point == "infinity" else pencil_rank_at(exact, point)
            try:
                about.minimal(pivots, rows, {"point": point})
                accepted = True
            except checker.Rejected:
                accepted = False
            assert accepted == (minimal and there >= n + p - len(rows)), (exact, rows, pivots, point)
            seen_minimal, refused = seen_minimal + accepted, refused + (not accepted)
    assert seen_minimal > 200 and refused > 200


def test_the_rank_at_infinity_is_that_of_the_feedthrough_modulo_the_prime() -> None:
    """G that the prime divides, or that is zero, tells nothing at infinity, whatever the normal rank is."""
    late = ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [0]])
    for system, seen_there in ((late, False), (VANISHES, True)):
        certificate = written(make.left_invertible(kernel_representation(system)))
        certificate["witness"]["point"] = "infinity"
        if seen_there:
            checker.verify(certificate)
        else:
            with pytest.raises(checker.Rejected, match="smaller rank at that point"):
                checker.verify(certificate)
    divided = written(make.left_invertible(kernel_representation(ResidualSystem.of([], [], [[]], [[PRIME]], n=0, m=1, p=1))))
    divided["witness"] |= {"prime": PRIME, "point": "infinity"}
    with pytest.raises(checker.Rejected, match="smaller rank at that point"):
        checker.verify(divided)


def test_a_mix_of_an_older_file_proves_nothing_and_has_to_be_an_index() -> None:
    older = written(make.window_ranks(kernel_representation(seen())))
    older["witness"]["mix"] = 7
    checker.verify(older)
    for mix in ("7", -1, PRIME, True, None):
        older["witness"]["mix"] = mix
        with pytest.raises(checker.Malformed, match="mix"):
            checker.verify(older)
