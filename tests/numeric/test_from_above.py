"""Rows that begin from those of the next degree are judged: what divides them, and a record of which a course upwards refuses the order."""

from __future__ import annotations

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.numeric import StateSpaceModel, fault_space_by_rows
from faultspace.numeric.method.rows import space_by_rows as space
from faultspace.numeric.method.rows.degree import least_degree, misfits
from faultspace.numeric.method.rows.from_above import divided, from_above
from faultspace.numeric.method.rows.joint import JointMoments, course, joint_moments
from faultspace.numeric.method.space.basis import KernelBasis


def test_a_factor_is_divided_out() -> None:
    """Of rows N_1 and (q - a) N_2 + c N_1 of degree two the span at every q is that of N_1 and N_2 again."""
    rng = np.random.default_rng(3)
    for root in (0.6, -1.7, 0.01):
        first, second = rng.standard_normal((3, 4)), rng.standard_normal((2, 4))
        product = np.vstack([np.zeros((1, 4)), second]) - root * np.vstack([second, np.zeros((1, 4))])
        found = divided([first, product + 0.7 * first], (1, 2))
        assert [len(row) for row in found] == [2, 3]
        for q in np.exp(1j * np.array([0.3, 1.1, 2.9])):
            spans = [np.array([q ** np.arange(len(row)) @ row for row in pair]) for pair in (found, [second, first])]
            bases = [np.linalg.qr(each.T)[0] for each in spans]
            # The root is that of a grid: a few parts in a hundred of the span.
            assert np.linalg.norm(bases[0] - bases[1] @ (bases[1].conj().T @ bases[0])) < 0.2


def test_a_course_that_has_stuck_goes_on_from_above() -> None:
    rng = np.random.default_rng(5105)
    A = rng.standard_normal((3, 3))
    A *= rng.uniform(0.4, 0.9) / np.abs(np.linalg.eigvals(A)).max()
    F, C, G = rng.standard_normal((3, 1)), rng.standard_normal((3, 3)), rng.standard_normal((3, 1))
    B, D = rng.standard_normal((3, 1)), rng.standard_normal((3, 1))
    u, v, w = rng.standard_normal((3000, 1)), rng.standard_normal((3000, 1)), rng.standard_normal((3000, 3))
    clean = StateSpaceModel(A, np.hstack([B, F]), C, np.hstack([D, G])).simulate(np.hstack([u, v]), rng.standard_normal(3))
    y = clean + 0.03 * clean.std(axis=0) * w
    y, u = y - y.mean(axis=0), u - u.mean(axis=0)
    data = joint_moments([(y, u)], 2)
    fits = course(data, 2, 4)
    better = from_above(data, fits)
    assert all(new.level <= old.level for new, old in zip(better, fits, strict=True)) and better[3].level < fits[3].level - 0.005
    before, after = (least_degree(data, each, 0, 3, misfits(4)) for each in (fits, better))
    assert not before.decided and "the order is too low" in before.reason and after.decided and after.degree == 3


def test_the_space_is_from_such_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[int] = []

    def counted(data: JointMoments, fits: list[KernelBasis], *, shares: Array) -> list[KernelBasis]:
        seen.append(len(fits))
        return from_above(data, fits, shares=shares)

    monkeypatch.setattr(space, "from_above", counted)
    y, u = np.random.default_rng(1).standard_normal((2, 300, 2))
    fault_space_by_rows(y, u, [[0.5]], [[1.0], [0.0]], n_v=1)
    assert seen == [3]
