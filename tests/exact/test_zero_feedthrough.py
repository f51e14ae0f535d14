"""These tests are about G = 0: when it pins F and v, and what it leaves free."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.pairs.canonical_form import BehaviorName, behavior_name
from faultspace.exact.pairs.no_feedthrough import zero_feedthrough
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem
from tests.exact import pair_checks
from tests.exact.checks import read
from tests.exact.test_broken_on_purpose import Broken, noticed
from tests.oracle.families import CUBIC, FIELDS, adversarial, delay_line, paper_example
from tests.oracle.strategies import systems
from tests.thorough import examples, sampled

Json = Any
Q = adversarial("Q")


def without_feedthrough(system: Json) -> Json:
    """The result is the SYSTEM with zeros for G."""
    return system | {"G": [["0"] * len(row) for row in system["G"]]}


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
def test_named_systems(field: Json) -> None:
    for system in [*adversarial(field).values(), *([paper_example()] if field == CUBIC else [])]:
        pair_checks.check_zero_feedthrough(without_feedthrough(system))


@settings(max_examples=examples(80))
@given(systems())
def test_any_system(given: Json) -> None:
    pair_checks.check_zero_feedthrough(without_feedthrough(given))


@pytest.mark.parametrize("dimensions", [(1, 1, 1), (1, 2, 1), (1, 2, 2), (2, 1, 1)])
def test_every_system_over_two_elements(dimensions: tuple[int, int, int]) -> None:
    for system in pair_checks.small_systems(*dimensions, feedthrough=False):
        pair_checks.check_zero_feedthrough(system)


@pytest.mark.parametrize("dimensions", [(2, 1, 1), (2, 2, 1)])
def test_every_other_pair_over_two_elements(dimensions: tuple[int, int, int]) -> None:
    """Pinned iff no F' with another column space among all n x m matrices makes the same outputs."""
    pinned = {True: 0, False: 0}
    names: dict[ResidualSystem, BehaviorName] = {}

    def name(system: ResidualSystem) -> BehaviorName:
        if system not in names:
            names[system] = behavior_name(kernel_representation(system))
        return names[system]

    for system in pair_checks.small_systems(*dimensions, feedthrough=False):
        exact = read(system)
        kernel = kernel_representation(exact)
        if kernel.normal_rank < exact.m:
            continue
        found = zero_feedthrough(kernel)
        others = [
            F
            for F in pair_checks.all_matrices(exact.field, exact.n, exact.m)
            if F != exact.F and name(exact.with_faults(F, exact.G)) == name(exact)
        ]
        assert (not others) == found.pins_F  # over GF(2) and with m = 1 another F is another column space
        responses = [pair_checks.same_response_up_to_basis(exact, exact.with_faults(F, exact.G)) for F in others]
        assert all(responses) == found.pins_v
        pinned[found.pins_F] += 1
    assert pinned[False] > 4
    assert (pinned[True] > 4) == (dimensions[1] > dimensions[2])  # p = m: zeta = n, so that nothing is pinned for n > m


def test_the_example_is_pinned() -> None:
    found = zero_feedthrough(kernel_representation(read(paper_example())))
    assert found.pins_F and found.pins_v and found.ambiguity == 0
    assert (found.rank_CF, found.finite_zeros, found.delay_known_state) == (1, 0, 1)
    assert found.delay_unknown_state is not None


def test_relative_degree_two_leaves_a_delay_free() -> None:
    """r = q^-2 v: F = e2; F' = e1 makes the same outputs from v'(k) = v(k - 1), no multiple of v."""
    system = read(delay_line("Q", 2))
    found = zero_feedthrough(kernel_representation(system))
    assert not found.pins_F and not found.pins_v and (found.ambiguity, found.rank_CF, found.finite_zeros) == (1, 0, 0)
    assert found.alternative is not None
    assert found.to_json()["alternative"]["F"] == found.alternative.F.to_json()
    early = system.with_faults(Matrix.of([[1], [0]]), system.G)
    assert compare(kernel_representation(system), kernel_representation(early)).equivalent
    rest = Matrix.zero(system.field, 2, 1)
    v, w = Matrix.of([[3], [1], [4], [1], [5]]), Matrix.of([[0], [3], [1], [4], [1]])
    assert simulate(system, rest, v).residuals == simulate(early, rest, w).residuals


def test_a_finite_zero_leaves_a_filter_free() -> None:
    """C = [1 1], A = 0 over two states in a row, F = e2: rank CF = 1, but one finite zero: F is not fixed."""
    system = ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 1]], [[0]])
    found = zero_feedthrough(kernel_representation(system))
    assert (found.rank_CF, found.finite_zeros, found.ambiguity) == (1, 1, 1)
    assert not found.pins_F and not found.pins_v and found.delay_unknown_state is None
    assert found.alternative is not None
    assert not pair_checks.same_response_up_to_basis(system, found.alternative.system)


def test_an_unobservable_mode_leaves_f_free_but_not_v() -> None:
    """There is a second state that no output shows: F = [1; 0] and [1; 1] give the same outputs from the same v."""
    system = ResidualSystem.of([[0, 0], [0, 3]], [[1], [0]], [[1, 0]], [[0]])
    found = zero_feedthrough(kernel_representation(system))
    assert not found.pins_F and found.pins_v and found.ambiguity == 1
    assert found.delay_unknown_state == 1
    assert found.alternative is not None and rank(found.alternative.F) == 1


def test_hypotheses_are_asked_for() -> None:
    with pytest.raises(InvalidInput, match=r"G: got a nonzero feedthrough"):
        zero_feedthrough(kernel_representation(read(Q["unobservable"])))
    with pytest.raises(InvalidInput, match=r"normal rank 1 and 2 faults"):
        zero_feedthrough(kernel_representation(ResidualSystem.of([[0]], [[1, 1]], [[1]], [[0, 0]])))


BROKEN: dict[str, Broken] = {
    "the formula forgets U": Broken(
        "members_by_formula",
        "beside(system.F, U, system.A @ silent)",
        "beside(system.F, system.A @ silent)",
        pair_checks.check_zero_feedthrough,
        ({"A": [[0, 0], [0, 0]], "F": [[1], [0]], "C": [[1, 0]], "G": [[0]]},),
    ),
    "no alternative is looked for": Broken(
        "_alternative",
        "system.m == 0 or pencil.zeta == system.m",
        "True",
        pair_checks.check_zero_feedthrough,
        (delay_line("Q", 2),),
    ),
    "a hidden direction is taken": Broken(
        "_alternative",
        "beside(system.F, hidden) if pencil.zeta > system.m + hidden.ncols else system.F",
        "system.F",
        pair_checks.check_zero_feedthrough,
        ({"A": [[1, 0, 0], [0, 0, 1], [0, 0, 0]], "F": [[0], [0], [1]], "C": [[0, 1, 0]], "G": [[0]]},),
    ),
}


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    noticed(monkeypatch, BROKEN[name])
