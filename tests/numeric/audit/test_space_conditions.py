"""A fault space is asked only where rounding hides none of the conditions that it rests on."""

from __future__ import annotations

from unittest.mock import patch

import numpy as np
import pytest

from faultspace.exact.structure.signals import hankel
from faultspace.numeric.audit.making import trouble_vectors
from faultspace.numeric.audit.making.fault_records import conditions_clear, conditions_gap
from faultspace.numeric.audit.making.kinds_of_trouble import KINDS
from faultspace.numeric.audit.making.trouble_vectors import unbounded
from faultspace.numeric.audit.vectors.fault_vectors import FaultVector, channel_units, in_channel_units
from faultspace.numeric.audit.vectors.rationals import floats
from faultspace.numeric.audit.vectors.trouble import default_troubles

KIND = {kind.slug: kind for kind in KINDS}
ASKED = [(one.kind, one.faults, s) for one in default_troubles() if one.faults for s in one.faults.space_bounds]


def slow_gap(vector: FaultVector, s: int) -> tuple[float, float]:
    """Return the least nonzero singular value of the conditions and the norm of the response, all of it in floats."""
    n, p = vector.system.n, vector.system.p
    A, C = floats(vector.system.A), floats(vector.system.C) / np.array([[float(unit)] for unit in channel_units(vector.r)])
    C = C / (np.max(np.abs(C), initial=0) or 1)
    blocks = [np.hstack([np.zeros((p, n)), np.eye(p)])]
    for j in range(s - 1):
        blocks.append(np.hstack([C @ np.linalg.matrix_power(A, j), np.zeros((p, p))]))
    response = np.vstack(blocks)
    left, _, _ = np.linalg.svd(floats(hankel(in_channel_units(vector.r), s)))
    rows = left[:, vector.ranks[s - 1] :].T
    conditions = np.vstack([rows[:, j * p :] @ response[: (s - j) * p] for j in range(s)])
    values = np.linalg.svd(conditions, compute_uv=False)
    least = values[n + p - vector.space.ncols - 1] if rows.size else np.inf
    return float(least), float(np.linalg.norm(response, 2))


@pytest.mark.parametrize(("slug", "vector", "s"), [one for one in ASKED if one[2] <= len(one[1].ranks)][::3])
def test_the_enclosure_is_that_of_floats(slug: str, vector: FaultVector, s: int) -> None:
    least, size = slow_gap(vector, s)
    assert conditions_gap(vector.r, vector.system, s) == pytest.approx((least, size), rel=3e-3), slug


@pytest.mark.parametrize("slug", ["zeros-none", "order-0", "zeros-large", "delays"])
def test_shipped_questions_are_clear(slug: str) -> None:
    shipped = [(vector, s) for kind, vector, s in ASKED if kind == slug]
    assert shipped
    assert all(conditions_clear(vector.r, vector.system, s) for vector, s in shipped)


def test_without_a_row_there_is_no_condition() -> None:
    """As many faults as outputs leave no row that vanishes on the windows, and hide nothing."""
    noise = next(one.faults for one in default_troubles() if one.kind == "pure-noise")
    assert noise is not None
    assert conditions_gap(noise.r, noise.system, 2)[0] == np.inf
    assert conditions_clear(noise.r, noise.system, 2)


def test_a_draw_that_hides_a_condition_is_not_asked() -> None:
    """Seed 5 draws a state that the outputs hardly show; a condition stands 600 times what rounding makes of it, a thousand are asked."""
    kind = KIND["poles-nearly-unobservable"]
    with patch.object(trouble_vectors, "conditions_clear", return_value=True):
        before = unbounded(kind, 5).faults
    after = unbounded(kind, 5).faults
    assert before is not None and after is not None
    assert not conditions_clear(before.r, before.system, before.lag + 1)
    assert conditions_clear(after.r, after.system, after.lag + 1)
    assert before.system != after.system
