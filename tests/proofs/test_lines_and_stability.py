"""Certificates of lines of faults and of stability: made where the oracle says true, refused to be made where it says false."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import Field, NumberField, PrimeField
from faultspace.exact.system.modular import LARGEST_PRIME
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.trust import checker, checker_structure
from faultspace.proofs.trust import structure_certificates as make
from tests.oracle import truth
from tests.oracle.fields import PrimeField as SlowField
from tests.oracle.lines import determinant
from tests.proofs.examples import FIELDS, STABLE, seen


def pairs(field: Field, count: int) -> list[tuple[ResidualSystem, ResidualSystem]]:
    """Return random systems with the same A and C, dimensions from 0."""
    rng = Random(f"{field} {count}")

    def entry() -> object:
        if isinstance(field, NumberField) and rng.random() < 0.3:
            return [rng.choice(["0", "1/2", "-1/3", "1"]) for _ in range(field.degree)]
        return rng.choice([0, 0, 1, -1, 2] if isinstance(field, PrimeField) else [0, 0, 1, -1, "1/2", "-1/2", "3/4"])

    found = []
    for _ in range(count):
        n, m, p = rng.randint(0, 2), rng.randint(0, 2), rng.randint(0, 3)
        A, F, C, G, F2, G2 = (
            [[entry() for _ in range(width)] for _ in range(height)] for height, width in ((n, n), (n, m), (p, n), (p, m), (n, m), (p, m))
        )
        found.append(tuple(ResidualSystem.of(A, f, C, g, field=field, n=n, m=m, p=p) for f, g in ((F, G), (F2, G2))))
    return found  # type: ignore[return-value]


@pytest.mark.parametrize("name", FIELDS)
def test_a_line_is_certified_iff_it_is_good(name: str) -> None:
    field = FIELDS[name]
    good, unshown = {True: 0, False: 0}, 0
    for first, second in pairs(field, 60):
        true = truth("left-invertible-line", {"first": first.to_json(), "second": second.to_json()})
        try:
            certificate = make.left_invertible_line(first, second)
        except make.Unprovable as error:
            unshown += true
            # Only where the field has no n + 1 points may a true statement stay without a witness.
            assert not true or ("points of GF" in str(error) and isinstance(field, PrimeField) and field.p <= first.n)
            good[False] += 1
        else:
            assert true
            checker.verify(certificate)
            good[True] += 1
    assert min(good.values()) > 10 and unshown < 5


@pytest.mark.parametrize("name", [name for name, field in FIELDS.items() if not isinstance(field, PrimeField)])
def test_stability_is_certified_iff_it_is_so(name: str) -> None:
    stable = {True: 0, False: 0}
    for system, _ in pairs(FIELDS[name], 60):
        true = truth("schur-stable", {"system": system.to_json()})
        claimed = {**STABLE, "statement": {"system": system.to_json()}}
        if true:
            checker.verify(make.schur_stable(system))
        else:
            with pytest.raises(make.Unprovable, match="an eigenvalue"):
                make.schur_stable(system)
            with pytest.raises(checker.Rejected, match="unit circle"):
                checker.verify(claimed)
        stable[true] += 1
    assert min(stable.values()) > 10


def test_what_has_no_meaning_is_refused() -> None:
    with pytest.raises(ValueError, match="differ in A, C"):
        make.left_invertible_line(seen(), ResidualSystem.of([[1]], [[1]], [[1], [0]], [[0], [1]]))
    with pytest.raises(InvalidInput, match="no unit circle"):
        make.schur_stable(seen(PrimeField(3)))


def test_two_points_are_too_few_over_the_field_of_two() -> None:
    # The transfer matrix is a + b (q^2 + q): two forms in one, of which the points 0 and 1 see one.
    systems = [
        ResidualSystem.of([[0, 1], [0, 1]], f, [[1, 0], [0, 0]], g, field=PrimeField(2))
        for f, g in (([[0], [1]], [[0], [0]]), ([[0], [0]], [[1], [0]]))
    ]
    assert truth("left-invertible-line", {"first": systems[0].to_json(), "second": systems[1].to_json()})
    with pytest.raises(make.Unprovable, match=r"points of GF\(2\)"):
        make.left_invertible_line(*systems)
    over = [ResidualSystem.of(s.A.to_json(), s.F.to_json(), s.C.to_json(), s.G.to_json()) for s in systems]
    checker.verify(make.left_invertible_line(*over))


def test_a_prime_that_misleads_is_passed_over() -> None:
    small, large = ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), ResidualSystem.of([[0]], [[0]], [[1]], [[LARGEST_PRIME]])
    for first, second in ((small, large), (large, small)):
        certificate = make.left_invertible_line(first, second)
        assert certificate["witness"]["prime"] < LARGEST_PRIME
        checker.verify(certificate)


def test_forms_are_determinants() -> None:
    """By the bits of column sets against Leibniz."""
    rng = Random(5)
    for prime in (2, 3, 101):
        field = SlowField(prime)
        for m in (0, 1, 2, 3, 4) * 5:
            rows = [[rng.randrange(prime) for _ in range(2 * m)] for _ in range(m)]
            slow: Any = [[{(0, k): field.integer(x) for k, x in enumerate((row[j], row[m + j])) if x} for j in range(m)] for row in rows]
            expected = determinant(field, slow)
            assert checker_structure.binary_form(rows, prime) == [expected[0, k].value if (0, k) in expected else 0 for k in range(m + 1)]


def test_more_faults_are_more_work_and_too_many_too_much() -> None:
    def line(m: int) -> tuple[ResidualSystem, ResidualSystem]:
        gains = [[[int(i - j == k) for j in range(m)] for i in range(m + 1)] for k in (0, 1)]
        first, second = (ResidualSystem.of([], [], [[]] * (m + 1), g, n=0, m=m, p=m + 1) for g in gains)
        return first, second

    certificate = make.left_invertible_line(*line(8))
    checker.verify(certificate)
    larger = [system.to_json() for system in line(30)]
    statement = {"first": larger[0], "second": larger[1]}
    witness = {"prime": 101, "minors": [{"point": 0, "rows": list(range(30))}]}
    with pytest.raises(checker.Rejected, match="units of work"):
        checker.verify({**certificate, "statement": statement, "witness": witness})


def test_stability_of_twenty_states() -> None:
    rng = Random(3)
    A = [[f"{rng.randint(-9, 9)}/50" for _ in range(20)] for _ in range(20)]
    system = ResidualSystem.of(A, [[]] * 20, [], [], n=20, m=0, p=0)
    checker.verify(make.schur_stable(system))
    with pytest.raises(make.Unprovable):
        make.schur_stable(ResidualSystem.of([[x.replace("50", "5") for x in row] for row in A], [[]] * 20, [], [], n=20, m=0, p=0))
