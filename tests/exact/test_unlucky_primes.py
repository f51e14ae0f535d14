"""Systems made for the primes that are tried first: entries that vanish or have a pole modulo them, fields that do not split.

FIRST, SECOND the two largest primes up to 2^30, computed here by sympy SLY systems that look simpler modulo FIRST than they are Kernel
rows modulo a prime: the faults that outputs tell are eliminated first, and what comes out is what the slow ways find.
"""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import Any

import pytest
import sympy
from flint import nmod_mat
from hypothesis import given, settings

from faultspace.exact.algebra.fields import QQ, NumberField, PrimeField
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.kernel_rows import _leads as leads_of_chain
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.modular_rows import pencil_rank_at, placed, rows_modulo
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.zero_output import zero_output_chain
from faultspace.exact.system import modular
from faultspace.exact.system.modular import LARGEST_PRIME, image, primes_below, simple_root
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix
from tests.exact import checks
from tests.oracle.families import SQRT2
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any
FIRST = int(sympy.prevprime(2**27))
SECOND = int(sympy.prevprime(FIRST))
L, M = str(FIRST), str(SECOND)


def system(A: Any, F: Any, C: Any, G: Any, **more: Any) -> Json:
    return {"A": A, "F": F, "C": C, "G": G, **more}


# name -> (SYSTEM, whether the first prime can serve in the end)
SLY: dict[str, tuple[Json, bool]] = {
    "A vanishes": (system([[L]], [["1"]], [["1"]], [["0"]]), True),
    "C vanishes": (system([["1"]], [["1"]], [[L]], [["0"]]), False),
    "G vanishes": (system([["0"]], [["1"]], [["0"]], [[L]]), False),
    "F vanishes": (system([["0"]], [[L]], [["1"]], [["0"]]), False),
    "F vanishes beside a fault that does not": (system([["0"]], [[L]], [["1"], ["0"]], [["0"], ["1"]]), True),
    "a link of the chain vanishes": (
        system([["0", L], ["0", "0"]], [["0"], ["1"]], [["1", "0"]], [["0"]]),
        False,
    ),
    "C vanishes modulo both": (system([["1"]], [["1"]], [[str(FIRST * SECOND)]], [["0"]]), False),
    "C vanishes modulo the second": (system([["1"]], [["1"]], [[M]], [["0"]]), True),
    "a pole": (system([["1/" + L]], [["1"]], [["1"]], [["1"]]), False),
    "poles of both": (system([["1/" + L]], [["1/" + M]], [["1"], ["1"]], [["1"], ["0"]]), False),
    "poles that cancel": (system([["0"]], [["1/" + L]], [[L], ["0"]], [["0"], ["1"]]), False),
    "two outputs agree": (system([["1"]], [["1"]], [["1"], [str(FIRST + 1)]], [["0"], ["1"]]), True),
    "two outputs agree, no feedthrough": (
        system([["1", "0"], ["0", "2"]], [["1"], ["1"]], [["1", "0"], ["1", L]], [["0"], ["0"]]),
        False,
    ),
    "a zero that is one only modulo the first": (
        system([["0", "1"], ["0", "0"]], [["0"], ["1"]], [["0", "1"], [L, "0"]], [["0"], ["0"]]),
        False,
    ),
    "no faults": (system([["0", L], ["1", "0"]], [[], []], [["0", "1"]], [[]], n=2, m=0, p=1), True),
    "no faults, unobservable modulo the first": (system([["0", L], ["1", "0"]], [[], []], [["1", "0"]], [[]], n=2, m=0, p=1), False),
}


@pytest.mark.parametrize("name", list(SLY))
def test_sly_systems(name: str) -> None:
    sly, _ = SLY[name]
    for check in (checks.check_report, checks.check_kernel_rows, checks.check_fault_spaces, checks.check_inversion):
        check(sly)


@pytest.mark.parametrize("name", list(SLY))
def test_the_prime_that_is_settled_on(name: str) -> None:
    """Where ranks fall modulo the first prime it must not be the one that is kept; elsewhere it is."""
    sly, serves = SLY[name]
    kernel = kernel_representation(checks.read(sly))
    assert (kernel.image.prime == FIRST) == serves
    assert "both" not in name or kernel.image.prime < SECOND


def test_the_order_of_the_primes() -> None:
    assert LARGEST_PRIME == FIRST
    found = primes_below(LARGEST_PRIME)
    wanted = [FIRST]
    while len(wanted) < 4:
        wanted.append(int(sympy.prevprime(wanted[-1])))
    assert [next(found) for _ in wanted] == wanted
    assert list(primes_below(20)) == [19, 17, 13, 11, 7, 5, 3, 2] and list(primes_below(1)) == []


@settings(max_examples=examples(60))
@given(systems(field="Q", largest=2), SEEDS)
def test_entries_mixed_with_the_first_prime(given: Json, seed: int) -> None:
    """Every entry is taken times, over or plus the first prime, at random."""
    rng = Random(seed)

    def spoiled(entry: Any) -> str:
        x = Fraction(entry)
        return str(rng.choice((x, x * FIRST, x / FIRST, x + FIRST, x * FIRST * SECOND)))

    checks.check_report({**given, **{k: [[spoiled(x) for x in row] for row in given[k]] for k in "AFCG"}})


@settings(max_examples=examples(25))
@given(systems(field=SQRT2, largest=2), SEEDS)
def test_number_field_entries_that_vanish_modulo_the_root(given: Json, seed: int) -> None:
    """The entries are multiplied by (a - root), which is no rational multiple of a prime and yet 0 in the image."""
    field = NumberField((Fraction(-2), Fraction(0), Fraction(1)))
    good = next(prime for prime in primes_below(LARGEST_PRIME) if simple_root(field, prime) is not None)
    root = simple_root(field, good)
    assert root is not None and (root * root - 2) % good == 0
    rng = Random(seed)
    trap = field.element([-root, 1])

    def spoiled(entry: Any) -> Any:
        x = field.element(entry)
        return field.write(rng.choice((x, x * trap)))

    changed = {**given, **{k: [[spoiled(x) for x in row] for row in given[k]] for k in "AFCG"}}
    checks.check_report(changed)
    picture = image(checks.read(changed))
    assert (picture.prime, picture.root) == (good, root)


def test_the_trap_is_seen_and_left() -> None:
    """C = a - root is 0 in the first image: the prime is given up."""
    field = NumberField((Fraction(-2), Fraction(0), Fraction(1)))
    start = ResidualSystem.of([[0]], [[1]], [[1]], [[0]], field=field)
    picture = image(start)
    assert picture.root is not None
    trapped = ResidualSystem.of([[0]], [[1]], [[[-picture.root, 1]]], [[0]], field=field)
    assert image(trapped).system.C.is_zero()
    kernel = kernel_representation(trapped)
    assert kernel.image.prime < picture.prime and kernel.normal_rank == 1


def test_a_trap_at_the_conjugate_root() -> None:
    """C = a + root is not 0 in the first image but 0 at the other root: ranks there are right, the rational solve is singular."""
    field = NumberField((Fraction(-2), Fraction(0), Fraction(1)))
    picture = image(ResidualSystem.of([[0]], [[1]], [[1]], [[0]], field=field))
    assert picture.root is not None
    trapped = ResidualSystem.of([[3]], [[]], [[[picture.root, 1]]], [[]], field=field, n=1, m=0, p=1)
    assert not image(trapped).system.C.is_zero()
    kernel = kernel_representation(trapped)
    assert kernel.image.prime < picture.prime and kernel.left_minimal_indices == (1,)
    checks.check_report(trapped.to_json())
    checks.check_kernel_rows(trapped.to_json())


@pytest.mark.parametrize(
    "ascending",
    [(1, 0, 1), (-2, 0, 0, 1), (1, 1, 1, 1, 1), (-3, 0, 0, 0, 0, 0, 0, 1), (1, -3, -1, 4), (FIRST, 0, 1), (-1, 0, FIRST)],
)
def test_fields_whose_first_primes_do_not_split(ascending: tuple[int, ...]) -> None:
    """The prime has a simple root of f, the larger ones that were passed over have none (or divide what they may not)."""
    field = NumberField(tuple(Fraction(c) for c in ascending))
    a = [0, 1] + [0] * (field.degree - 2)
    given = ResidualSystem.of([[a, 1], [0, a]], [[0], [1]], [[1, 0]], [[0]], field=field)
    kernel = kernel_representation(given)
    picture = kernel.image
    assert picture.root is not None

    def value(x: int) -> int:
        return sum(c * x**k for k, c in enumerate(ascending))

    def slope(x: int) -> int:
        return sum(k * c * x ** (k - 1) for k, c in enumerate(ascending) if k)

    assert value(picture.root) % picture.prime == 0 and slope(picture.root) % picture.prime != 0
    x = sympy.Symbol("x")
    for prime in primes_below(LARGEST_PRIME):
        if prime == picture.prime:
            break
        factors = sympy.Poly(list(reversed(ascending)), x, modulus=prime).factor_list()[1]
        simple = [f for f, times in factors if f.degree() == 1 and times == 1]
        assert not simple or ascending[-1] % prime == 0
    assert picture.system.A[0, 0] == picture.root and picture.system.A[0, 1] == 1
    checks.check_report(given.to_json())


def test_a_field_that_the_first_prime_ramifies_in() -> None:
    """f = x^2 - FIRST has the double root 0 modulo FIRST: not simple, and not used."""
    field = NumberField((Fraction(-FIRST), Fraction(0), Fraction(1)))
    assert simple_root(field, FIRST) is None
    given = ResidualSystem.of([[[0, 1]]], [[1]], [[1]], [[0]], field=field)
    assert kernel_representation(given).image.prime < FIRST
    checks.check_report(given.to_json())


def test_the_root_may_be_zero() -> None:
    """f = x^2 + x + FIRST is x (x + 1) modulo FIRST: a goes to 0, and what is a multiple of a vanishes there."""
    field = NumberField((Fraction(FIRST), Fraction(1), Fraction(1)))
    assert simple_root(field, FIRST) == 0
    given = ResidualSystem.of([[[1, 2]]], [[1]], [[1]], [[0]], field=field)
    picture = kernel_representation(given).image
    assert (picture.prime, picture.root) == (FIRST, 0) and picture.system.A[0, 0] == 1
    trapped = ResidualSystem.of([[[1, 2]]], [[1]], [[[0, 3]]], [[0]], field=field)
    assert kernel_representation(trapped).image.prime < FIRST
    for one in (given, trapped):
        checks.check_report(one.to_json())


def test_a_field_of_degree_one() -> None:
    """Q(a) with a = 3/2 is Q under another name."""
    field = NumberField((Fraction(-3), Fraction(2)))
    over = ResidualSystem.of([["1/2", 1], [0, 3]], [[0], [1]], [[1, 0]], [[0]], field=field)
    plain = ResidualSystem.of([["1/2", 1], [0, 3]], [[0], [1]], [[1, 0]], [[0]])
    checks.check_report(over.to_json())
    found, wanted = analyze(over).to_json(), analyze(plain).to_json()
    assert {**found, "field": "Q"} == wanted


def test_a_prime_field_is_its_own_image() -> None:
    given = ResidualSystem.of([[0]], [[1]], [[1]], [[0]], field=PrimeField(FIRST))
    picture = image(given)
    assert (picture.system, picture.prime, picture.root) == (given, FIRST, None)
    checks.check_report(given.to_json())


@pytest.mark.parametrize("prime", [2, FIRST, 18446744073709551557])
def test_extreme_prime_fields(prime: int) -> None:
    """The fields are those of 2 and of the largest prime below 2^64."""
    checks.check_report(system([["1", "1"], ["0", "1"]], [["1"], ["1"]], [["1", "1"]], [["1"]], field={"prime": prime}))


def test_running_out_of_primes_is_said() -> None:
    with pytest.raises(ArithmeticError, match="every prime up to the bound divides a denominator"):
        image(ResidualSystem.of([["1/6"]], [[1]], [[1]], [[0]]), largest=3)


def test_reduction_of_matrices() -> None:
    assert modular.reduce_matrix(Matrix.of([["1/2", "-3"]]), 5, None) == Matrix.of([[3, 2]], PrimeField(5))
    assert modular.reduce_matrix(Matrix.of([["1/10"]]), 5, None) is None
    assert modular.reduce_element(QQ.element("7/3"), QQ, 11, None) == 6


def test_an_entry_that_is_a_product_of_all_the_first_primes() -> None:
    """As many of them as fit into 64 kbit: each is unlucky, and the next one has to do."""
    entry, count = 1, 0
    for prime in primes_below(LARGEST_PRIME):
        if (entry * prime).bit_length() > 65536:
            break
        entry, count = entry * prime, count + 1
    assert count > 2000
    found = analyze(ResidualSystem.of([[1]], [[1]], [[entry]], [[0]]))
    assert found.to_json()["window_ranks"] == [1, 2, 3, 4]


PRIME = 2**27 - 39
SIZES = [(0, 0, 0), (0, 2, 2), (0, 0, 3), (2, 0, 0), (1, 1, 0), (3, 0, 2), (1, 1, 1), (2, 2, 1), (3, 1, 4), (4, 2, 3), (5, 3, 3), (6, 2, 5)]


def random_system(rng: Random, n: int, m: int, p: int) -> ResidualSystem:
    """Return a system with many zeros over a prime field, its G of any rank."""
    few = 0.2 + 0.8 * rng.random()

    def block(height: int, width: int, density: float) -> Matrix:
        rows = [[rng.randint(-3, 3) if rng.random() < density else 0 for _ in range(width)] for _ in range(height)]
        return Matrix.of(rows, PrimeField(PRIME), shape=(height, width))

    return ResidualSystem(block(n, n, few), block(n, m, few), block(p, n, few), block(p, m, rng.choice((0.0, 0.3, few))))


@pytest.mark.parametrize("sizes", SIZES)
def test_leads_are_those_of_the_recursion_and_rows_vanish_on_the_window(sizes: tuple[int, int, int]) -> None:
    rng = Random(str(sizes))
    for _ in range(40):
        system = random_system(rng, *sizes)
        found = rows_modulo(system)
        assert found is not None
        assert list(found.leads) == leads_of_chain(zero_output_chain(system), system.p)
        assert pencil_rank_at(system, found.point) == system.n + system.p - len(found.leads)
        for row, (mu, output) in zip(found.rows, found.leads, strict=True):
            assert len(row) == mu + 1 and row[-1][output] == 1 and not any(row[-1][output + 1 :])
            flat = Matrix.of([[x for c in row for x in c]], system.field)
            assert (flat @ window_matrix(system, mu + 1)).is_zero()
        states = placed(found.states, system.n, PRIME)
        assert states.rank() == sum(found.degrees)  # the checker asks for that


def test_both_ends_are_met_with_and_without_faults_that_outputs_do_not_tell() -> None:
    rng, points = Random(3), set[bool]()
    for _ in range(60):
        found = rows_modulo(random_system(rng, 4, 2, 4))
        assert found is not None
        points.add(found.point == "infinity")
    assert points == {True, False}


@pytest.mark.parametrize("sizes", SIZES)
def test_the_rank_of_the_pencil_is_that_of_the_matrix_also_at_an_eigenvalue(sizes: tuple[int, int, int]) -> None:
    rng = Random(str(sizes))
    for _ in range(20):
        system, n = random_system(rng, *sizes), sizes[0]
        for point in (0, 1, rng.randrange(PRIME)):
            shift = Matrix.identity(system.field, n).flint * point
            shifted = Matrix(system.field, n, n, system.A.flint - shift)
            rows = [[*a, *f] for a, f in zip(shifted.elements(), system.F.elements(), strict=True)]
            rows += [[*c, *g] for c, g in zip(system.C.elements(), system.G.elements(), strict=True)]
            built = Matrix.from_elements(system.field, n + system.p, n + system.m, rows)
            assert pencil_rank_at(system, point) == rank(built)
        assert pencil_rank_at(system, "infinity") == n + rank(system.G)


def test_matrices_are_placed_one_above_the_other() -> None:
    parts = [nmod_mat(1, 2, [1, 2], 7), nmod_mat(0, 2, 7), nmod_mat(2, 2, [3, 4, 5, 6], 7)]
    assert placed(parts, 2, 7) == nmod_mat(3, 2, [1, 2, 3, 4, 5, 6], 7)
    assert (placed([], 3, 7).nrows(), placed([], 3, 7).ncols()) == (0, 3)
