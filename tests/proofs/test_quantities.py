"""The quantities of claims: exact functions, ranks of batches and two slow oracles agree, and a broken quantity is noticed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import product
from math import inf
from typing import Any

import numpy as np
import pytest

from faultspace.exact import Matrix, ResidualSystem
from faultspace.exact.algebra.fields import QQ, Field, PrimeField
from faultspace.proofs.evidence.corpus import examine
from faultspace.proofs.language.evaluating import Exactly, evaluate, exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.quantities import elimination
from faultspace.proofs.quantities.batches import FIND, Batch
from faultspace.proofs.quantities.elimination import Overflow, determinants, leading_ranks
from faultspace.proofs.quantities.ranks import CHARACTERISTIC, MINORS, Ranks
from faultspace.proofs.quantities.registry import Kind, Quantity, Subject, quantities
from faultspace.proofs.trust.structure_certificates import Unprovable, accept
from tests.oracle.words import Words, by_definition, by_words, windows_by_definition, windows_by_words
from tests.thorough import THOROUGH, every, sampled

Sizes = tuple[int, int, int]
# every system over GF(2) of these sizes, n, m, p; and over Q with entries -1, 0, 1
OVER_2: tuple[Sizes, ...] = (*product((0, 1), (0, 1), (0, 1)), (2, 1, 1), (2, 0, 1), (2, 1, 0), (1, 2, 1), (1, 1, 2), (1, 2, 2))
OVER_Q: tuple[Sizes, ...] = ((0, 0, 0), (0, 2, 1), (0, 1, 2), (1, 0, 0), (1, 1, 0), (1, 0, 1), (1, 1, 1), (1, 1, 2), (1, 2, 1))


def tables(entries: tuple[int, ...], sizes: Sizes) -> Iterator[list[list[list[int]]]]:
    """Yield A, F, C, G of every system of these sizes with these entries."""
    n, m, p = sizes
    shapes = ((n, n), (n, m), (p, n), (p, m))
    for numbers in product(entries, repeat=(n + p) * (n + m)):
        rest = iter(numbers)
        yield [[[next(rest) for _ in range(columns)] for _ in range(rows)] for rows, columns in shapes]


def batch_of(listed: list[list[list[list[int]]]], sizes: Sizes, prime: int | None) -> Batch:
    n, m, p = sizes
    shapes = ((n, n), (n, m), (p, n), (p, m))
    A, F, C, G = (np.array([one[k] for one in listed], dtype=np.int64).reshape(len(listed), *shape) for k, shape in enumerate(shapes))
    return Batch(A, F, C, G, prime)


def ranks_of(batch: Batch) -> list[Ranks]:
    rows = np.arange(len(batch))
    families = [name for name in FIND if batch.prime is None or name not in (CHARACTERISTIC, MINORS)]
    columns = {name: batch.column(name, rows) for name in families}
    known: list[dict[object, tuple[int, ...]]] = [{name: tuple(map(int, table[i])) for name, table in columns.items()} for i in rows]
    return [Ranks(batch.n, batch.m, batch.p, one) for one in known]


@cache
def material(prime: int | None) -> list[tuple[Subject, Ranks, dict[str, Any], dict[str, list[int]]]]:
    """Return systems with their ranks, and what the oracles say of them: every system of some sizes, some of larger ones."""
    found = []
    entries = (0, 1) if prime == 2 else (-1, 0, 1)
    chosen = [(sizes, list(tables(entries, sizes))[:: 1 if prime == 2 else every(2)]) for sizes in (OVER_2 if prime == 2 else OVER_Q)]
    rng = np.random.default_rng(18)
    larger = [one for one in product((2, 3), (0, 1, 2), (0, 1, 2)) if sum(one) <= 5]
    for sizes in larger if prime is None else ((2, 2, 1), (2, 1, 2), (3, 1, 1)):
        n, m, p = sizes
        shapes = ((n, n), (n, m), (p, n), (p, m))
        chosen.append((sizes, [[rng.choice(entries, shape).tolist() for shape in shapes] for _ in range(40 if THOROUGH else 5)]))
    for sizes, listed in chosen:
        batch = batch_of(listed, sizes, prime)
        for i, ranks in enumerate(ranks_of(batch)):
            system = batch.system(i)
            if prime == 2:
                A, F, C, G = listed[i]
                words = Words(2, A, F, C, G, *sizes)
                told, windows = by_words(words), windows_by_words(words, sizes[0] + 2)
            else:
                told, windows = by_definition(system.to_json()), windows_by_definition(system.to_json(), sizes[0] + 3)
            found.append((Subject(system), ranks, told, windows))
    return found


def disagreements(quantity: Quantity, prime: int | None) -> list[str]:
    """Return on which systems the quantity differs from what an oracle says, or its two ways from each other."""
    wrong = []
    for subject, ranks, told, windows in material(prime):
        samples = range(len(windows.get(quantity.name, ()))) if quantity.windowed else [None]
        for s in samples:
            given = () if s is None else (s,)
            values = [quantity.exact(subject, *given), quantity.from_ranks(ranks, *given)]
            if s is not None:
                values.append(windows[quantity.name][s])
            elif quantity.name in told:
                values.append(told[quantity.name])
            if any(value != values[0] for value in values):
                wrong.append(f"{quantity.name}{given} of {subject.system}: {values}")
    return wrong


ASKED = [(name, prime) for name, one in quantities().items() for prime in (None, 2) if prime is None or not one.circle]


@pytest.mark.parametrize(("name", "prime"), ASKED[:: every()], ids=str)
def test_a_quantity_is_what_slow_ways_find(name: str, prime: int | None) -> None:
    assert disagreements(quantities()[name], prime) == []


def test_every_quantity_has_an_oracle() -> None:
    known = {name for prime in (None, 2) for name in (*material(prime)[0][2], *material(prime)[0][3])}
    assert set(quantities()) - known == set()


def _broken(value: Any) -> Any:
    """Something else of the same kind."""
    if isinstance(value, bool):
        return not value
    return (*value, 0) if isinstance(value, tuple) else value + 1 if value != float("inf") else 0


@pytest.mark.parametrize("way", ["exact", "from_ranks"])
@pytest.mark.parametrize("name", sampled(quantities(), 9))
def test_a_broken_quantity_is_noticed(name: str, way: str) -> None:
    """It is wrong for the systems with at least one state alone, and in one of its two ways."""
    right = quantities()[name]

    def wrong(given: Any, *s: int) -> Any:
        value = getattr(right, way)(given, *s)
        n = given.system.n if isinstance(given, Subject) else given.n
        return _broken(value) if n >= 1 else value

    changed = replace(right, exact=wrong) if way == "exact" else replace(right, from_ranks=wrong)
    assert disagreements(changed, None)


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("weakly_unobservable_dimension", "unobservable_dimension"),
        ("strongly_reachable_dimension", "normal_rank"),
        ("strongly_observable", "observable"),
        ("strongly_detectable", "minimum_phase"),
        ("delay_unknown", "delay_known"),
        ("controllability_index", "observability_index"),
        ("right_minimal_indices", "left_minimal_indices"),
        ("infinite_zeros", "finite_zeros"),
    ],
)
def test_a_quantity_is_not_taken_for_its_neighbour(name: str, other: str) -> None:
    """The systems that the tests try tell quantities apart that many systems do not."""
    mixed = replace(quantities()[name], exact=quantities()[other].exact, from_ranks=quantities()[other].from_ranks)
    assert disagreements(mixed, None) or disagreements(mixed, 2)


def over(field: Field, n: int, m: int, p: int, numbers: tuple[int, ...]) -> ResidualSystem:
    cuts = np.cumsum([n * n, n * m, p * n])
    parts = np.split(np.array(numbers), cuts)
    shaped = [part.reshape(shape).tolist() for part, shape in zip(parts, ((n, n), (n, m), (p, n), (p, m)), strict=True)]
    return ResidualSystem.of(*shaped, field=field, n=n, m=m, p=p)


def drawn(field: Field, sizes: Sizes, seed: int) -> ResidualSystem:
    n, m, p = sizes
    return over(field, n, m, p, tuple(int(x) for x in np.random.default_rng([seed, *sizes]).integers(-1, 2, (n + p) * (n + m))))


SIZES: tuple[Sizes, ...] = ((0, 1, 1), (1, 1, 1), (2, 1, 1), (2, 1, 2), (1, 2, 1), (3, 2, 2))
SMALL = [drawn(field, sizes, seed) for field in (QQ, PrimeField(2), PrimeField(3)) for sizes in SIZES for seed in range(3)]


@pytest.mark.parametrize("name", [name for name, one in quantities().items() if one.certificates is not None])
def test_the_checker_accepts_the_certificates_of_a_quantity(name: str) -> None:
    quantity, accepted = quantities()[name], 0
    assert quantity.certificates is not None
    for system in SMALL:
        if quantity.circle and system.field != QQ:
            continue
        subject = Subject(system)
        try:
            made = quantity.certificates(subject, 2) if quantity.windowed else quantity.certificates(subject)
        except Unprovable:
            assert name == "stable" and not quantity.exact(subject)
            continue
        for one in made:
            accept(one)
            accepted += 1
    assert accepted or name in ("n", "m", "p")


def test_certificates_state_the_values() -> None:
    """What a certificate states is what the quantity is, where it states it in so many words, or gives it by subtraction."""
    for system in SMALL:
        subject = Subject(system)
        certified = {name: one.certificates for name, one in quantities().items() if not one.windowed and name != "stable"}
        stated = {name: [one["statement"] for one in maker(subject)] for name, maker in certified.items() if maker is not None}
        n = system.n
        assert tuple(stated["left_minimal_indices"][0]["left_minimal_indices"]) == subject.kernel.left_minimal_indices
        assert tuple(stated["right_minimal_indices"][0]["left_minimal_indices"]) == subject.dual.left_minimal_indices
        assert stated["unobservable_dimension"][0]["rank"] == n - quantities()["unobservable_dimension"].exact(subject)
        driven, window = (one["rank"] for one in stated["weakly_unobservable_dimension"])
        assert n - window + driven == subject.weakly_unobservable.ncols
        driven, window = (one["rank"] for one in stated["strongly_reachable_dimension"])
        assert window - driven == subject.strongly_reachable.ncols
        assert max(stated["controllability_index"][0]["left_minimal_indices"], default=0) == subject.reached.lag


def told(system: ResidualSystem, one: Quantity) -> Any:
    """Return what accepted certificates tell of a system, of windows the values at 0, ..., n + 3 samples."""
    assert one.told is not None
    evidence = examine("a test", system, questions=one.told.asks)
    return [one.told.read(evidence, s) for s in range(system.n + 4)] if one.windowed else one.told.read(evidence)


@pytest.mark.parametrize("name", [name for name, one in quantities().items() if one.told is not None])
def test_certificates_tell_the_value(name: str) -> None:
    """Each value is read off answers to the questions that the quantity asks, and to no other."""
    one = quantities()[name]
    for system in SMALL:
        subject = Subject(system)
        value = [one.exact(subject, s) for s in range(system.n + 4)] if one.windowed else one.exact(subject)
        assert told(system, one) == value, system


def broken_rules(quantity: Quantity) -> list[str]:
    """Return where what derivations use of a quantity is not so: on systems of which exact functions tell what it speaks of."""
    wrong = []
    for subject in map(Subject, SMALL):
        knows = exactly(subject.system, subject)

        def value(text: str, knows: Exactly = knows) -> Any:
            return evaluate(read(text, Kind.INTEGER), knows) if text else 0

        if quantity.circle or quantity.windowed:
            continue
        found = quantity.exact(subject)
        if quantity.kind == Kind.INTEGER:
            sound = found >= 0 and (quantity.infinite or found < inf) and all(found <= value(one) for one in quantity.at_most)
            sound &= not quantity.parts or found == sum(map(value, quantity.parts))
        elif quantity.kind == Kind.LIST:
            sound = quantity.balance is None or len(found) == value(quantity.balance[0]) - value(quantity.balance[1])
        else:
            sound = quantity.balance is None or found == (value(quantity.balance[0]) == value(quantity.balance[1]))
            sound &= not quantity.parts or found == all(quantities()[one].exact(subject) for one in quantity.parts)
        if not sound:
            wrong.append(f"{quantity.name} = {found} of {subject.system}")
    return wrong


def test_what_derivations_use_of_a_quantity_is_so_and_what_is_not_is_noticed() -> None:
    known = quantities()
    assert [wrong for one in known.values() for wrong in broken_rules(one)] == []
    spoilt = [
        replace(known["delay_known"], infinite=False),
        replace(known["lag"], at_most=("finite_zeros",)),
        replace(known["zeta"], parts=("finite_zeros",)),
        replace(known["minimal"], parts=("observable",)),
        replace(known["left_invertible"], balance=("normal_rank", "p")),
        replace(known["left_minimal_indices"], balance=("m", "normal_rank")),
    ]
    assert all(broken_rules(one) for one in spoilt)


def test_ranks_of_leading_rows_are_those_of_exact_matrices() -> None:
    rng = np.random.default_rng(3)
    for rows, columns in product((0, 1, 3, 5), (0, 1, 4)):
        many = rng.integers(-2, 3, (30, rows, columns)) * rng.integers(0, 2, (30, rows, 1))
        for prime in (None, 2, 5):
            found = leading_ranks(many, prime)
            for matrix, ranks in zip(many, found, strict=True):
                field = QQ if prime is None else PrimeField(prime)
                exact = Matrix.of(matrix.tolist(), field, shape=(rows, columns))
                assert [int(x) for x in ranks] == [int(exact.rows(range(k)).flint.rank()) for k in range(rows + 1)]


def test_a_minor_that_the_first_prime_divides_is_seen() -> None:
    """[[2^31 - 1]] is 0 modulo the first prime; the bound on minors asks for a second one."""
    assert leading_ranks(np.array([[[elimination.LARGEST]]]), None).tolist() == [[0, 1]]
    assert elimination._modulo(np.array([[[elimination.LARGEST]]]), elimination.LARGEST).tolist() == [[0, 0]]


def test_numbers_that_do_not_fit_are_refused() -> None:
    huge = np.full((1, 3, 3), 2**40)
    with pytest.raises(Overflow):
        leading_ranks(huge, None)
    with pytest.raises(Overflow):
        determinants(np.full((1, 4, 4), 2**20))
    with pytest.raises(Overflow):
        elimination.times(huge, huge)


def test_determinants_are_those_of_exact_matrices() -> None:
    rng = np.random.default_rng(4)
    for size in range(6):
        many = rng.integers(-3, 4, (20, size, size))
        exact = [int(Matrix.of(one.tolist(), shape=(size, size)).flint.det()) if size else 1 for one in many]
        assert determinants(many).tolist() == exact
