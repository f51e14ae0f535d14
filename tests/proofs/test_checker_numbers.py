"""These tests are about numbers, fields and systems in the checker: primes, irreducibility, what is assumed without it, equal systems."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import pytest

from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.trust import checker, checker_fields
from faultspace.proofs.trust.structure_certificates import accept
from tests.proofs.examples import CUBED, FIELDS, GONE, RANKS, ROOTED, SQRT2, S, base, certificates, seen, spoiled


def test_primes_are_told_from_composites() -> None:
    sieve = [n for n in range(3000) if n > 1 and all(n % k for k in range(2, int(n**0.5) + 1))]
    assert [n for n in range(3000) if checker.is_prime(n)] == sieve
    assert all(map(checker.is_prime, (2**61 - 1, 2**64 - 59, 18446744073709551533)))
    pseudoprimes = (3215031751, 3474749660383, 341550071728321, 3825123056546413051, (2**32 - 5) * (2**32 - 17), (2**32 - 5) ** 2)
    assert not any(map(checker.is_prime, pseudoprimes))


def products(field: int, degree: int) -> set[tuple[int, ...]]:
    """Return the reducible monic polynomials of that degree over GF(field), multiplied out."""

    def monic(d: int) -> Iterator[tuple[int, ...]]:
        return ((*low, 1) for low in itertools.product(range(field), repeat=d))

    found = set()
    for d in range(1, degree // 2 + 1):
        for f, g in itertools.product(monic(d), monic(degree - d)):
            product = [0] * (degree + 1)
            for i, a in enumerate(f):
                for j, b in enumerate(g):
                    product[i + j] = (product[i + j] + a * b) % field
            found.add(tuple(product))
    return found


@pytest.mark.parametrize(("prime", "degree"), [(2, 1), (2, 2), (2, 4), (2, 6), (3, 2), (3, 4), (5, 3)])
def test_irreducible_modulo_a_prime_is_what_is_no_product(prime: int, degree: int) -> None:
    reducible = products(prime, degree)
    for low in itertools.product(range(prime), repeat=degree):
        # Another leading coefficient, and one divisible by the prime added, change nothing modulo the prime but a factor.
        coefficients = [(prime + 1) * c + prime for c in low] + [prime + 1]
        monic = tuple(c * pow(coefficients[-1], -1, prime) % prime for c in coefficients)
        field = checker_fields.NumberField({"minimal_polynomial": coefficients})
        if monic in reducible:
            with pytest.raises(checker.Rejected, match="reducible modulo"):
                field.irreducible({"irreducible": {"modulo": prime}})
        else:
            assert field.irreducible({"irreducible": {"modulo": prime}})


def test_eisenstein_shifts() -> None:
    # (x - 1)^4 - 3 and multiples of it.
    coefficients = [-2, -4, 6, -4, 1]
    for factor in ("", "/7"):
        field = checker_fields.NumberField({"minimal_polynomial": [f"{c * 6}{factor}" for c in coefficients]})
        assert field.irreducible({"irreducible": {"eisenstein": {"prime": 3, "shift": "1"}}})
        with pytest.raises(checker.Rejected):
            field.irreducible({"irreducible": {"eisenstein": {"prime": 3, "shift": "-1"}}})


def test_without_a_proof_of_irreducibility_the_statement_says_so() -> None:
    proven, unproven = CUBED, spoiled(CUBED, ("witness.irreducible", GONE))
    assert checker.verify(unproven).statement == f"assuming f irreducible: {checker.verify(proven).statement}"
    assert checker.verify(unproven).assumes == ["f is irreducible, with the coefficients [1,-3,-1,4] (ascending)"]


def test_no_verdict_rests_on_an_assumption() -> None:
    accept(CUBED)
    with pytest.raises(checker.Rejected, match="irreducible"):
        accept(spoiled(CUBED, ("witness.irreducible", GONE)))


def test_what_only_a_zero_divisor_proves_is_an_assumption() -> None:
    # a^2 = 1: the leading coefficient 1 + a is a zero divisor, and the row kills a system that 1 - a leads out of it.
    system = {"field": {"minimal_polynomial": [-1, 0, 1]}, "A": [], "F": [], "C": [[]], "G": [[[1, -1]]], "n": 0, "m": 1, "p": 1}
    kernel = [{"pivot": 0, "coefficients": [[[1, 1]]]}]
    statement = {"system": system, "normal_rank": 0, "left_minimal_indices": [0]}
    certificate = {**RANKS, "statement": statement, "witness": {"prime": 7, "root": 1, "kernel": kernel}}
    assert checker.verify(certificate).statement.startswith("assuming f irreducible: ")
    with pytest.raises(checker.Rejected, match="reducible"):
        checker.verify(spoiled(certificate, ("witness.irreducible", {"modulo": 7})))


@pytest.mark.parametrize("f", [["2", "3"], ["-1/2", "1/5"], [0, -1]])
def test_a_field_of_degree_1_needs_no_proof(f: list[object]) -> None:
    system = {**seen().to_json(), "field": {"minimal_polynomial": f}, "A": [[["0"]]]}
    a, b = (checker.rational(c, "")[0] * 10 // checker.rational(c, "")[1] for c in f)
    root = -a * pow(b, -1, 101) % 101
    certificate = spoiled(RANKS, (S, system), ("witness.prime", 101), ("witness.root", root))
    assert checker.verify(certificate).statement.startswith("for every s >= 1")


def test_multiples_of_a_minimal_polynomial_name_one_field() -> None:
    double = {**seen(SQRT2).to_json(), "field": {"minimal_polynomial": ["2/3", 0, "-1/3"]}}
    checker.verify(ROOTED, [double])
    with pytest.raises(checker.Rejected, match="the statement is not about"):
        checker.verify(ROOTED, [{**double, "field": {"minimal_polynomial": [-3, 0, 1]}}])


@pytest.mark.parametrize("name", FIELDS)
def test_the_own_system_is_recognised_and_a_foreign_one_never(name: str) -> None:
    foreign = ResidualSystem.of([[1]], [[1]], [[1]], [[1]], field=FIELDS[name]).to_json()
    for certificate in certificates(FIELDS[name]):
        own = [value for key, value in certificate["statement"].items() if key in ("system", "first", "second", "inner", "outer")]
        checker.verify(certificate, own)
        for others in ([foreign], [*own, foreign], [seen(PrimeField(5)).to_json()]):
            with pytest.raises(checker.Rejected, match="the statement is not about"):
                checker.verify(certificate, others)


def test_equal_numbers_are_equal_however_written() -> None:
    half = base("left-invertible", system=seen(gain="1/2"))
    checker.verify(half, [spoiled(half["statement"]["system"], ("F", [["2/4"]]))])
    checker.verify(RANKS, [{**seen().to_json(), "A": [[0]], "B": [["5"]], "D": [["1"], [2]], "n": 1}])
    checker.verify(CUBED, [{**CUBED["statement"]["system"], "F": [[["1", "0", "0/5"]]]}])
    checker.verify(base("left-invertible", PrimeField(3)), [{**seen(PrimeField(3)).to_json(), "F": [["-2"]]}])
    with pytest.raises(checker.Rejected):
        checker.verify(half, [{**half["statement"]["system"], "F": [["2/5"]]}])
    with pytest.raises(checker.Malformed):
        checker.verify(half, [{**half["statement"]["system"], "F": [["0.5"]]}])
