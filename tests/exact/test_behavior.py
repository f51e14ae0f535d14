"""Comparison of behaviours: equal by construction, different by perturbation, and against the oracle's ranks.

equal_pairs     a system and one with the same behaviour: feedback, other bases, unseen states, superfluous faults
"""

from __future__ import annotations

from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.matrices import Matrix, beside, stacked
from faultspace.exact.structure.behavior import compare, separation
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from tests.exact import checks
from tests.oracle.families import FIELDS, system
from tests.oracle.strategies import SEEDS, system_pairs, systems
from tests.oracle.structured import fed_back, similar
from tests.oracle.systems import parse_system, write_system
from tests.thorough import examples

Json = Any
SEEN = system("Q", [[0]], [[1]], [[1], [0]], [[0], [1]], n=1, p=2, m=1)
DOUBLED = system("Q", [[0]], [[2]], [[1], [0]], [[0], [1]], n=1, p=2, m=1)


def with_unseen_states(rng: Random, given: ResidualSystem) -> ResidualSystem:
    """The result has two more states, driven by the others, by the fault and by themselves, that no output sees."""
    more = 2
    A = stacked(
        beside(given.A, Matrix.zero(given.field, given.n, more)),
        checks.random_matrix(rng, given, more, given.n + more),
    )
    F = stacked(given.F, checks.random_matrix(rng, given, more, given.m))
    return ResidualSystem(A, F, beside(given.C, Matrix.zero(given.field, given.p, more)), given.G)


def with_superfluous_faults(rng: Random, given: ResidualSystem) -> ResidualSystem:
    """The result has fault columns that are combinations of the others, in front of them."""
    mixed = checks.random_matrix(rng, given, given.m, 2)
    return given.with_faults(beside(given.F @ mixed, given.F), beside(given.G @ mixed, given.G))


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
@settings(max_examples=examples(15))
@given(data=st.data())
def test_drawn_pairs(field: Json, data: st.DataObject) -> None:
    checks.check_comparison(*data.draw(system_pairs(field=field)))


@settings(max_examples=examples(60))
@given(systems(), SEEDS)
def test_equal_by_construction(given: Json, seed: int) -> None:
    rng = Random(seed)
    exact, slow = checks.read(given), parse_system(given)
    kernel = kernel_representation(exact)
    equal = [checks.read(write_system(change(rng, slow))) for change in (similar, fed_back)]
    equal += [with_unseen_states(rng, exact), with_superfluous_faults(rng, exact)]
    equal.append(with_superfluous_faults(rng, with_unseen_states(rng, equal[1])))
    for other in equal:
        found = compare(kernel, kernel_representation(other))
        assert found.equivalent and found.first_difference is None
        assert found.first_not_in_second is None and found.second_not_in_first is None
    assert compare(kernel, equal[3]).equivalent


def included_on(inner: ResidualSystem, outer: KernelRepresentation, window: int) -> bool:
    """This says whether every word of `inner` of that many samples is a word of `outer`."""
    found = separation(inner, outer)
    return found is None or found.window > window


@settings(max_examples=examples(60))
@given(systems(), st.data())
def test_fewer_faults_are_contained(given: Json, data: st.DataObject) -> None:
    exact = checks.read(given)
    kept = data.draw(st.sets(st.integers(0, exact.m - 1))) if exact.m else set()
    fewer = exact.with_faults(exact.F.columns(sorted(kept)), exact.G.columns(sorted(kept)))
    inner, outer = kernel_representation(fewer), kernel_representation(exact)
    assert compare(inner, outer).first_not_in_second is None
    for s in range(exact.n + 3):
        assert included_on(fewer, outer, s)
        assert included_on(exact, inner, s) == (inner.rank(s) == outer.rank(s))


@settings(max_examples=examples(60))
@given(systems(), systems())
def test_unrelated_systems_of_any_dimensions(first: Json, second: Json) -> None:
    """Most of them have different n and m; those that cannot be compared are refused."""
    if first["field"] == second["field"] and first["p"] == second["p"]:
        checks.check_comparison(first, second)
    else:
        with pytest.raises(InvalidInput, match=r"^(field|p): "):
            compare(kernel_representation(checks.read(first)), kernel_representation(checks.read(second)))


@settings(max_examples=examples(40))
@given(systems(field="Q"), SEEDS)
def test_a_perturbed_entry(given: Json, seed: int) -> None:
    """One entry of one matrix moved by 1/7: equal or not, the oracle knows."""
    rng = Random(seed)
    places = [(k, i, j) for k in "AFCG" for i, row in enumerate(given[k]) for j in range(len(row))]
    if not places:
        return
    key, i, j = rng.choice(places)
    moved = Matrix.of([[given[key][i][j]]]) + Matrix.of([["1/7"]])
    rows = [list(row) for row in given[key]]
    rows[i][j] = str(moved[0, 0])
    checks.check_comparison(given, {**given, key: rows})


def test_different_pairs_are_drawn() -> None:
    """The perturbations above are not all equivalent: the smallest example differs on two samples and not on one."""
    assert checks.check_comparison(SEEN, DOUBLED) == 2
    inner, outer = kernel_representation(checks.read(SEEN)), kernel_representation(checks.read(DOUBLED))
    assert included_on(inner.system, outer, 1) and not included_on(inner.system, outer, 2)


@pytest.mark.parametrize("n", [2, 5])
def test_the_difference_may_come_late(n: int) -> None:
    """Shift registers that agree on n samples: the first output is the other one n samples ago, once or twice as large."""
    A = [[int(j == i + 1) for j in range(n)] for i in range(n)]
    first, second = (
        kernel_representation(
            ResidualSystem.of(A, [[gain * int(i == n - 1)] for i in range(n)], [[int(j == 0) for j in range(n)], [0] * n], [[0], [1]])
        )
        for gain in (1, 2)
    )
    found = compare(first, second)
    assert found.first_difference == n + 1
    checks.check_separation(first, second, found.first_not_in_second)
    checks.check_separation(second, first, found.second_not_in_first)


@settings(max_examples=examples(60))
@given(systems(), SEEDS)
def test_pairs_of_the_fault_space(given: Json, seed: int) -> None:
    """B(A, Fhat P, C, Ghat P) is within B for every P, and is B iff the normal ranks are equal."""
    exact = checks.read(given)
    kernel = kernel_representation(exact)
    space = fault_space(kernel)
    P = checks.random_matrix(Random(seed), exact, space.dimension, kernel.normal_rank)
    candidate = exact.with_faults(space.F @ P, space.G @ P)
    other = kernel_representation(candidate)
    assert compare(other, kernel).first_not_in_second is None
    assert compare(kernel, candidate).equivalent == (other.normal_rank == kernel.normal_rank)
    everything = exact.with_faults(space.F, space.G)
    assert compare(kernel, everything).equivalent


def test_the_other_output_count_and_field_are_refused() -> None:
    one = kernel_representation(checks.read(SEEN))
    with pytest.raises(InvalidInput, match=r"^p: got 2 and 1 outputs, expected as many in both systems$"):
        compare(one, kernel_representation(ResidualSystem.of([[0]], [[1]], [[1]], [[0]])))
    with pytest.raises(InvalidInput, match=r"^field: got Q and GF\(2\), expected the same field"):
        compare(one, kernel_representation(checks.read({**SEEN, "field": {"prime": 2}})))
