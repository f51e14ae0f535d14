"""Whether the data need the last state of a model: zeros that a surplus state invents are undecided, and those that are there are not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from faultspace.numeric import arx_reduction, identified_fault_space
from faultspace.numeric.model.last_state import last_state
from faultspace.numeric.rows.degree import least_degree
from tests.numeric.planted import joint_record, planted


@pytest.mark.parametrize(("seed", "zeros"), [(22, ()), pytest.param(6, (0.5,), marks=pytest.mark.slow)])
def test_a_surplus_state_leaves_the_zeros_undecided(seed: int, zeros: tuple[float, ...]) -> None:
    system = planted(seed, zeros, n=3)
    y, u = joint_record(system, seed, 1000, 40)
    found, more = (identified_fault_space(y, u, arx_reduction(y, u, order=order), n_v=2) for order in (3, 4))
    assert found.decided and found.zeta == len(zeros), found.reason
    assert more.n_z == found.n_z + 1 and not more.decided and more.zeta is None and more.margin < 1
    assert more.reason.startswith("undecided: ") and "order 3 explains the data nearly as well" in more.reason


def test_what_the_last_state_gains() -> None:
    """A state that is there gains what it explains, one that is not about as much as it has parameters."""
    rng = np.random.default_rng(0)
    u, y = rng.standard_normal((300, 1)), np.zeros((300, 2))
    for k in range(299):
        y[k + 1] = 0.5 * y[k] + u[k] * [1.0, 2.0]
    y += 0.1 * rng.standard_normal(y.shape)
    there, surplus = (last_state(arx_reduction(y, u, order=order)) for order in (1, 2))
    assert there.parameters == surplus.parameters == 3
    assert there.worth > 100 and surplus.worth < 1
    # Other units gain the same.
    assert last_state(arx_reduction(1e5 * y, 1e-3 * u, order=1)).gain == pytest.approx(there.gain, rel=0.02)


def course_of(*levels: float) -> tuple[Any, Any]:
    """Return moments of 1000 samples of four channels, and fits of one row with total degrees 0, 1, .. that leave these levels."""
    fits = [SimpleNamespace(level=level, rows=(np.zeros((degree + 1, 4)),)) for degree, level in enumerate(levels)]
    return cast(Any, SimpleNamespace(samples=1000.0, moments=SimpleNamespace(channels=4))), cast(Any, fits)


def test_where_every_degree_is_refused_the_likeliest_is_answered() -> None:
    """Degree 2 leaves a little that higher ones explain, degree 3 no less, degree 1 nearly everything."""
    found = least_degree(*course_of(-1.0, -2.0, -11.0, -11.003, -11.04, -11.12), 1, 4)
    assert found.degree == 2 and not found.decided and "higher degree" in found.reason
    # Where nothing is likely at all the order is too low: the highest degree that it allows is the least wrong.
    low = least_degree(*course_of(-1.0, -2.0, -3.0, -11.0), 0, 2)
    assert low.degree == 2 and not low.decided and low.reason.endswith("the order is too low")
    # And a degree that suffices is found as ever.
    assert least_degree(*course_of(-1.0, -2.0, -11.0, -11.003, -11.004, -11.005), 1, 4).degree == 2
