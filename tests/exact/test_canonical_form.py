"""Names of behaviours: equal exactly when behaviours are, for fixed (A, C) and for any."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.pairs.canonical_form import behavior_name, fault_class, feedback_class, with_feedback
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from tests.exact import pair_checks
from tests.exact.checks import read
from tests.exact.test_broken_on_purpose import Broken, noticed
from tests.oracle.families import FIELDS, adversarial
from tests.oracle.strategies import SEEDS, system_pairs, systems
from tests.thorough import examples, sampled

Json = Any
Q, THREE = adversarial("Q"), adversarial({"prime": 3})


@settings(max_examples=examples(400))
@given(system_pairs())
def test_pairs_of_systems(pair: tuple[Json, Json]) -> None:
    pair_checks.check_names(*pair)


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
@settings(max_examples=examples(25))
@given(data=st.data())
def test_feedback(field: Json, data: st.DataObject) -> None:
    pair_checks.check_feedback(data.draw(systems(field=field)), data.draw(SEEDS))


@pytest.mark.parametrize("field", ["Q", {"prime": 2}], ids=str)
def test_all_pairs_of_named_systems(field: Json) -> None:
    kernels = [kernel_representation(read(system)) for system in adversarial(field).values()]
    assert 0 < _agreeing(kernels, kernels) < len(kernels) ** 2


def test_all_pairs_of_small_systems_over_two_elements() -> None:
    """One system of each name and three more are compared with all others: every pair, n <= 2, m <= 2, one output or two."""
    for output, shapes in ((1, [(1, 1), (1, 2), (2, 1), (0, 1), (1, 0), (2, 0)]), (2, [(1, 1), (0, 1), (0, 2), (1, 0)])):
        kernels = []
        for n, m in shapes:
            kernels += [kernel_representation(read(system)) for system in pair_checks.small_systems(n, output, m)]
        groups: dict[object, list[KernelRepresentation]] = {}
        for kernel in kernels:
            groups.setdefault(behavior_name(kernel), []).append(kernel)
        assert 5 < len(groups) < len(kernels)
        for group in groups.values():  # equal names: every member behaves as the first
            assert all(compare(group[0], member).equivalent for member in group)
        representatives = [group[0] for group in groups.values()]
        assert _agreeing(representatives, representatives) == len(representatives)  # different names: pairwise different


def test_fixed_dynamics_all_pairs() -> None:
    """For every (A, C) over GF(2) with n = 1, p = 2 and all (F, G) with m <= 2: equal echelon forms iff equal behaviours."""
    groups: dict[object, list[KernelRepresentation]] = {}
    for m in (0, 1, 2):
        for system in pair_checks.small_systems(1, 2, m):
            kernel = kernel_representation(read(system))
            groups.setdefault((kernel.system.A, kernel.system.C), []).append(kernel)
    for group in groups.values():
        sample = Random(0).sample(group, 6)
        for one in sample:
            for two in group:
                assert (fault_class(one) == fault_class(two)) == compare(one, two).equivalent


def test_the_same_behaviour_with_other_dynamics() -> None:
    """The systems have A = 0 and A = F K = 7 with C = 1 and C + G K = 1: one behaviour, one feedback class, two fault classes."""
    system = ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]])
    other = with_feedback(system, [[7]])
    assert other == ResidualSystem.of([[7]], [[1]], [[1], [7]], [[0], [1]])
    one, two = kernel_representation(system), kernel_representation(other)
    assert compare(one, two).equivalent
    assert behavior_name(one) == behavior_name(two)
    assert feedback_class(one) == feedback_class(two) and fault_class(one) != fault_class(two)
    assert feedback_class(one).residue == Matrix.of([[0], [1], [0]])


def test_a_feedback_class_is_finer_than_the_behaviour() -> None:
    """A change of basis of the state leaves the behaviour and changes the class; so does a state that no output shows."""
    system = ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]])
    scaled = ResidualSystem.of([[0]], [[2]], [["1/2"], [0]], [[0], [1]])
    padded = ResidualSystem.of([[0, 0], [0, 3]], [[1], [1]], [[1, 0], [0, 0]], [[0], [1]])
    one = kernel_representation(system)
    for other in (scaled, padded):
        two = kernel_representation(other)
        assert behavior_name(one) == behavior_name(two) and feedback_class(one) != feedback_class(two)


def test_autonomous_parts_have_names() -> None:
    """r(k+1) = 2 r(k), r(k+1) = 3 r(k), r = 0 and the fault with an uncontrollable mode beside it: the module tells them apart."""
    free: Json = {"F": [[]], "C": [[1]], "G": [[]], "n": 1, "m": 0, "p": 1}
    names = {behavior_name(kernel_representation(read(free | {"A": [[a]]}))) for a in (2, 3)}
    names.add(behavior_name(kernel_representation(read(free | {"A": [[2]], "C": [[0]]}))))
    assert {name.rows for name in names} == {(Matrix.of([[-2], [1]]),), (Matrix.of([[-3], [1]]),), (Matrix.of([[1]]),)}
    assert {name.left_minimal_indices for name in names} == {(1,), (0,)}
    mode = ResidualSystem.of([[0, 0], [0, 5]], [[1], [0]], [[1, 1], [0, 1]], [[0], [1]])
    without = ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]])
    assert behavior_name(kernel_representation(mode)) != behavior_name(kernel_representation(without))


def test_names_are_records() -> None:
    name = behavior_name(kernel_representation(read(Q["a0-fault-and-doubled-state-seen"])))
    assert name.to_json() == {"field": "Q", "p": 2, "rows": [[["0", "-2"], ["1", "0"]]]}
    found = fault_class(kernel_representation(read(Q["a0-fault-and-doubled-state-seen"])))
    assert found.to_json()["fault_space"] == [["1", "0", "1/2"]]
    assert set(feedback_class(kernel_representation(read(Q["nothing"]))).to_json()) == {"field", "fault_space", "residue"}
    with pytest.raises(InvalidInput, match=r"K: got shape 1 x 2, expected 1 x 1"):
        with_feedback(ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), [[1, 2]])
    assert behavior_name(kernel_representation(read(Q["no-output"]))).rows == () and QQ.element(1) == 1


def _agreeing(first: list[KernelRepresentation], second: list[KernelRepresentation]) -> int:
    """This says how many pairs are equivalent, each asserted to be what the names say."""
    equal = 0
    for one in first:
        for two in second:
            if one.system.p == two.system.p:
                equivalent = compare(one, two).equivalent
                assert equivalent == (behavior_name(one) == behavior_name(two))
                equal += equivalent
    return equal


SCALED: Json = {"A": [["1/3"]], "F": [[]], "C": [["1"]], "G": [[]], "n": 1, "m": 0, "p": 1}
BROKEN: dict[str, Broken] = {
    "only the degrees": Broken(
        "behavior_name",
        "[[x / lead for x in line] for line in row.coefficients.elements()]",
        "[[lead / lead for x in line] for line in row.coefficients.elements()]",
        pair_checks.check_names,
        (SCALED, SCALED | {"A": [["1/5"]]}),
    ),
    "the residue keeps its pivots": Broken(
        "feedback_class",
        "columns - echelon.matrix.transposed() @ columns.rows(echelon.pivots)",
        "columns + echelon.matrix.transposed() @ columns.rows(echelon.pivots)",
        pair_checks.check_feedback,
        (Q["a0-fault-and-state-seen"], 1),
    ),
    "no feedback to the output": Broken(
        "with_feedback",
        "system.C + system.G @ gain",
        "system.C",
        pair_checks.check_feedback,
        (Q["a0-fault-and-state-seen"], 1),
    ),
    "the class forgets Z": Broken(
        "fault_class",
        "fault_space(kernel).basis",
        "system.A",
        pair_checks.check_names,
        (Q["a0-fault-and-state-seen"], Q["a0-fault-and-doubled-state-seen"]),
    ),
}


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    noticed(monkeypatch, BROKEN[name])
