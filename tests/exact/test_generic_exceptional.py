"""D(q; P) is tested with all entries indeterminate: the identities hold, and at random values they say what the oracle finds."""

from __future__ import annotations

from functools import reduce
from random import Random
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, row_echelon
from faultspace.exact.algebra.polynomials import monic, trimmed
from faultspace.exact.pairs.polynomial import exceptional
from faultspace.exact.parametric import cofactors as room
from faultspace.exact.parametric.case_tree import coefficients, evaluate
from faultspace.exact.parametric.cofactors import GenericExceptional, generic_exceptional, generic_exceptional_without_feedthrough
from faultspace.exact.parametric.identities import IdentityFailure
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from tests.exact.test_broken_on_purpose import Broken, noticed
from tests.oracle.pencil import invariant_zero_polynomial
from tests.oracle.systems import parse_system
from tests.thorough import sampled

ALL = [(n, p, m) for n in range(3) for p in range(4) for m in range(3)]


def matrices_at(found: GenericExceptional, values: list[int]) -> dict[str, Matrix]:
    """The result is A, C and the basis of Z at these values."""
    entries = found.entries
    shapes = {"A": (entries.n, entries.n), "C": (entries.p, entries.n)}
    result = {
        name: Matrix.of([[evaluate(f, values) for f in row] for row in getattr(entries, name)], QQ, shape=shape)
        for name, shape in shapes.items()
    }
    rows = [[evaluate(f, values) for f in row] for row in found.basis]
    return result | {"Z": Matrix.of(rows, QQ, shape=(entries.n + entries.p, found.n_z))}


def check_at_the_point(found: GenericExceptional, seed: int) -> None:
    """At the generic point the basis spans Z, and D at a random P is the zero polynomial of the pair by the oracle."""
    n, p = found.entries.n, found.entries.p
    values = list(found.point)
    at = matrices_at(found, values)
    Z = at["Z"]
    rng = Random(seed)
    P = [[rng.randint(-3, 3) for _ in range(found.normal_rank)] for _ in range(found.n_z)]
    D = [evaluate(c, [*values, 0, *(x for row in P for x in row)]) for c in coefficients(found.polynomial, found.entries.parameters)]
    whole = ResidualSystem(at["A"], Z.rows(range(n)), at["C"], Z.rows(range(n, n + p)))
    space = exceptional(kernel_representation(whole))
    assert row_echelon(Z.transposed()).matrix == space.space.basis
    assert (space.n_z, space.zeta, space.columns) == (found.n_z, found.zeta, found.normal_rank)
    columns = Z @ Matrix.of(P, QQ, shape=(found.n_z, found.normal_rank))
    pair = whole.with_faults(columns.rows(range(n)), columns.rows(range(n, n + p)))
    zeros = monic(trimmed(QQ.element(int(c)) for c in D))
    if zeros:
        slow = invariant_zero_polynomial(parse_system(pair.to_json()))
        assert [str(c) for c in zeros] == [str(c) for c in slow]
    else:
        assert kernel_representation(pair).normal_rank < found.normal_rank


@pytest.mark.parametrize("dimensions", ALL, ids=str)
def test_all_entries(dimensions: tuple[int, int, int]) -> None:
    n, p, m = dimensions
    found = generic_exceptional(*dimensions)
    assert found.normal_rank == min(p, m)
    assert found.zeta == (0 if m < p else n)
    assert found.expanded == 1 + len(found.cofactors)
    check_at_the_point(found, 1)
    check_at_the_point(found, 2)


@pytest.mark.parametrize("dimensions", [(n, p, m) for n, p, m in ALL if m < p and m <= n], ids=str)
def test_without_feedthrough(dimensions: tuple[int, int, int]) -> None:
    found = generic_exceptional_without_feedthrough(*dimensions)
    assert found.zeta == found.normal_rank == dimensions[2]
    assert found.n_z == 2 * dimensions[2]
    check_at_the_point(found, 3)


def test_one_fault_without_feedthrough() -> None:
    """D = -(p11 + q p21): the finite zero of the pair is where one wants it."""
    found = generic_exceptional_without_feedthrough(1, 2, 1)
    q = found.entries.q
    p11, p21 = found.entries.ring.gens[-2:]
    assert found.polynomial == -p11 - q * p21


def test_a_bad_pair_is_met() -> None:
    """P = 0 is bad: D vanishes with it, as a polynomial without constant term."""
    found = generic_exceptional(1, 1, 1)
    zeros = [0] * (len(found.entries.ring.gens) - found.entries.parameters - 1)
    assert all(evaluate(c, [*found.point, 0, *zeros]) == 0 for c in coefficients(found.polynomial, found.entries.parameters))


def test_what_is_not_covered_is_told() -> None:
    with pytest.raises(ValueError, match="n: got 3, expected an integer from 0 to 2"):
        generic_exceptional(3, 1, 1)
    with pytest.raises(ValueError, match="p: got True, expected an integer from 0 to 3"):
        generic_exceptional(1, True, 1)
    with pytest.raises(ValueError, match="without feedthrough expected m < p and m <= n"):
        generic_exceptional_without_feedthrough(1, 1, 1)


def _all_of_it() -> Any:
    return generic_exceptional_without_feedthrough(2, 3, 2), generic_exceptional(2, 1, 1)


BROKEN = {
    "F enters with the wrong sign": ("indeterminate_pencil", "[-f for f in line]", "[f for f in line]"),
    "C F is forgotten": ("_space", "[*[ring.zero] * m, *times(row, entries.F, m, ring)]", "[ring.zero] * 2 * m"),
    "a forgets A": ("_space", "_frozen([*entries.A, *entries.C])", "_frozen([*entries.A, *([ring.zero] * n for _ in entries.C)])"),
}


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    function, old, new = BROKEN[name]
    noticed(monkeypatch, Broken(function, old, new, _all_of_it, ()), (IdentityFailure, ArithmeticError))
    assert getattr(room, function).__globals__ is not vars(room)


@pytest.mark.parametrize(("n", "p", "m", "shared"), [(1, 2, 1, "f11"), (2, 3, 2, "f11*f22 - f12*f21"), (2, 3, 1, "1"), (2, 2, 1, "1")])
def test_without_feedthrough_the_cofactors_share_the_determinant_of_a_square_f(n: int, p: int, m: int, shared: str) -> None:
    """They have no common factor over the field of the entries; in the ring of the entries they have this one."""
    cofactors = [c.cofactor for c in generic_exceptional_without_feedthrough(n, p, m).cofactors]
    common = reduce(lambda one, other: one.gcd(other), cofactors)
    assert str(common.primitive()[1]) in (shared, f"-{shared}")
