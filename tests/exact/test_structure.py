"""`structure` and everything under it are tested against the slow oracle: drawn, named, and all small systems over GF(2) and GF(3).

FIELD_PARAMETERS    every test that draws systems runs over each field of the oracle
all_systems         every system of these dimensions over a prime field
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.record import analyze
from tests.exact import checks
from tests.oracle.families import FIELDS, adversarial, paper_example, shift_register
from tests.oracle.fields import parse_field
from tests.oracle.strategies import planted_systems, systems
from tests.thorough import every, examples

Json = Any
FIELD_PARAMETERS = pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
MANY = 500  # systems: of more, one in `every()` is tried
# n, p, m and the prime: below 2^10 systems each
EXHAUSTED = [(2, n, p, m) for n, p, m in product(range(2), range(3), range(2))]
EXHAUSTED += [(2, 0, 2, 2), (2, 2, 0, 1), (2, 2, 1, 0), (2, 2, 1, 1), (2, 1, 1, 2)]
EXHAUSTED += [(3, n, p, m) for n, p, m in product(range(2), range(2), range(2))] + [(3, 1, 2, 1)]


def all_systems(prime: int, n: int, p: int, m: int) -> Iterator[Json]:
    """These are all prime^((n+p)(n+m)) systems."""
    for entries in product(range(prime), repeat=(n + p) * (n + m)):
        rows = [list(entries[i * (n + m) : (i + 1) * (n + m)]) for i in range(n + p)]
        blocks = {"A": [row[:n] for row in rows[:n]], "F": [row[n:] for row in rows[:n]]}
        blocks |= {"C": [row[:n] for row in rows[n:]], "G": [row[n:] for row in rows[n:]]}
        yield {**blocks, "n": n, "p": p, "m": m, "field": {"prime": prime}}


@FIELD_PARAMETERS
@settings(max_examples=examples(25))
@given(data=st.data())
def test_drawn_systems(field: Json, data: st.DataObject) -> None:
    checks.check_report(data.draw(systems(field=field)))


@FIELD_PARAMETERS
def test_named_systems(field: Json) -> None:
    for system in adversarial(field).values():
        checks.check_report(system)


@pytest.mark.parametrize("prime, n, p, m", EXHAUSTED)
def test_all_small_systems(prime: int, n: int, p: int, m: int) -> None:
    every_one = list(all_systems(prime, n, p, m))
    assert len(every_one) == prime ** ((n + p) * (n + m))
    for system in every_one[:: every() if len(every_one) > MANY else 1]:
        checks.check_report(system)


@FIELD_PARAMETERS
@settings(max_examples=examples(40))
@given(data=st.data())
def test_planted_structure_is_found(field: Json, data: st.DataObject) -> None:
    """Up to five states, outputs and faults: more than the oracle could do by minors."""
    system, planted = data.draw(planted_systems(field=field, largest=5))
    found = analyze(checks.read(system))
    assert found.kernel.normal_rank == planted.normal_rank
    assert found.kernel.left_minimal_indices == planted.left
    assert found.right_minimal_indices == planted.right
    assert found.infinite_zero_orders == planted.infinite
    over = parse_field(field)
    wanted = [found.system.field.element(over.write(c)) for c in planted.zero_polynomial(over)]
    assert list(found.invariant_zero_polynomial) == wanted


@pytest.mark.parametrize("check", checks.SINGLE_CHECKS, ids=lambda check: check.__name__)
@settings(max_examples=examples(40))
@given(data=st.data())
def test_every_check_on_drawn_systems(check: Callable[[Json], None], data: st.DataObject) -> None:
    check(data.draw(systems()))


@pytest.mark.parametrize("check", checks.SINGLE_CHECKS, ids=lambda check: check.__name__)
def test_every_check_on_named_systems(check: Callable[[Json], None]) -> None:
    for system in [*adversarial("Q").values(), *adversarial({"prime": 2}).values(), paper_example()]:
        if max(system.get("n", 3), system.get("m", 1)) <= 3:
            check(system)


@settings(max_examples=examples(60))
@given(systems(field={"prime": 2}, largest=4))
def test_larger_systems_over_two_elements(system: Json) -> None:
    checks.check_window_ranks(system)
    checks.check_kernel_rows(system)
    checks.check_kronecker_sum(system)


@pytest.mark.parametrize("n", [1, 7, 40])
def test_a_long_shift_register(n: int) -> None:
    """Lag n, delay 0: the kernel row has degree n, found without building a window of n samples over Q."""
    found = analyze(checks.read(shift_register("Q", n)))
    assert (found.kernel.lag, found.zeta, found.delay_known_state, found.delay_unknown_state) == (n, 0, 0, 0)
    assert [found.kernel.rank(s) for s in (1, n, n + 1)] == [2, 2 * n, 2 * n + 1]
    assert found.fault_space.exact_from == n + 1


def test_the_example_of_the_paper() -> None:
    found = analyze(checks.read(paper_example()))
    kernel = kernel_representation(found.system)
    assert [kernel.rank(s) for s in range(1, 7)] == [2, 4, 5, 6, 7, 8]
    assert (found.zeta, kernel.lag, found.fault_space.dimension) == (1, 2, 2)
    assert found.left_invertible and found.observable and not found.controllable
