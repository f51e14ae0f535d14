"""Questions at the edge: their data are such that floats can tell the answer, and what must be refused has no answer indeed."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from faultspace.exact.algebra.matrices import rank
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import hankel, simulate
from faultspace.exact.system.systems import ResidualSystem
from faultspace.numeric.audit.checks import edges, growth, laws
from faultspace.numeric.audit.vectors.fault_vectors import alike_inputs, samples_that_settle
from faultspace.numeric.audit.vectors.rationals import floats, fractions, matrix
from faultspace.numeric.audit.vectors.shipped_vectors import shipped

VECTORS = {one.slug: one for one in shipped("faults")}


def clear(r: Any, s: int, due: int) -> bool:
    """Whether the singular value that the rank `due` ends with is far above the next one, and above rounding."""
    values = np.linalg.svd(np.vstack([r[k : len(r) - s + 1 + k].T for k in range(s)]), compute_uv=False)
    values = np.append(values, 0.0)
    return due == 0 or bool(values[due - 1] > 1e-9 * values[0] and values[due] < 1e-13 * values[0])


@pytest.mark.parametrize("slug", ["one-fault", "two-faults"])
def test_the_ranks_of_the_shortest_record_are_clear_and_its_last_window_is_square(slug: str) -> None:
    r, due = edges.shortest(VECTORS[slug])
    p, s = r.ncols, len(due)
    assert r.nrows - s + 1 == p * s
    assert all(clear(floats(r), k, one) for k, one in enumerate(due, start=1))
    assert due == VECTORS[slug].ranks[:s], "so few samples show no more than many"


@pytest.mark.parametrize("name", edges.FREE)
def test_free_responses_have_ranks_that_end_and_are_clear(name: str) -> None:
    r, system, _ = edges.free_response(name)
    ranks = [rank(hankel(r, s)) for s in range(1, edges.WINDOWS + 1)]
    assert max(ranks) <= system.n
    assert all(clear(floats(r), s, one) for s, one in enumerate(ranks, start=1))


def test_few_samples_are_fewer_than_states() -> None:
    for slug in ("two-faults", "delayed"):
        short = edges.first(VECTORS[slug], edges.FEW)
        assert short.v.nrows < short.system.n and short.trusted > 0
        assert short.bounds["signal"] is not None


@pytest.mark.parametrize("lag", range(1, 13))
def test_a_count_is_due_where_three_gaps_and_a_third_of_all_are_equal(lag: int) -> None:
    """Gap s is that of windows s and s + 1, and is the number of faults from the lag on."""
    for p in (2, 3):
        gaps = (samples_that_settle(p, lag) + 1) // (2 * p + 1) - 1
        settled = gaps - lag + 1
        assert settled >= max(3, -(-gaps // 3))
        less = gaps - 1
        assert not less - lag + 1 >= max(3, -(-less // 3))


@pytest.mark.parametrize("name", ["same", "turned", "delayed"])
def test_inputs_that_are_alike_leave_other_models(name: str) -> None:
    """B and D with some columns other than zero give no output, for the given A and C and every initial state: the delayed one by
    x2 = -A b, D2 = -C b beside x1 = b."""
    model = next(one for one in shipped("identification") if one.B.ncols == 2)
    u = alike_inputs(model.u.columns([0]))[name]
    n, p = model.order, model.C.nrows
    columns = []
    for k in range(n + 2 * (n + p)):
        unit = [Fraction(int(j == k)) for j in range(n + 2 * (n + p))]
        x0 = matrix([[x] for x in unit[:n]], 1)
        B, D = (
            matrix([unit[n + 2 * i : n + 2 * i + 2] for i in range(n)], 2),
            matrix([unit[3 * n + 2 * i : 3 * n + 2 * i + 2] for i in range(p)], 2),
        )
        y = simulate(ResidualSystem(model.A, B, model.C, D), x0, u).residuals
        columns.append([x for row in fractions(y) for x in row])
    assert rank(matrix(columns, len(columns[0]))) < n + 2 * (n + p)


@pytest.mark.parametrize("slug", laws.OTHERS)
def test_records_of_other_sizes_show_their_faults(slug: str) -> None:
    """The windows of outputs and inputs have the rank that so many exciting faults and inputs give."""
    y, u, system = laws.other_record(slug)
    known = analyze(system)
    assert known.left_invertible and system.p > system.m + u.shape[1] - 1
    s = known.kernel.lag + 2
    Y = np.vstack([np.hstack([y, u])[k : len(y) - s + 1 + k].T for k in range(s)])
    step = np.linalg.matrix_rank(Y, tol=1e-9 * np.linalg.norm(Y)) - np.linalg.matrix_rank(
        Y[: -Y.shape[0] // s], tol=1e-9 * np.linalg.norm(Y)
    )
    assert step == system.m + u.shape[1]


def test_the_faint_fault_is_clear_in_long_records() -> None:
    due = analyze(growth.FAINT_SYSTEM).kernel
    r = growth.faint(growth.LENGTHS[1])
    for s in range(1, growth.WINDOWS + 1):
        values = np.append(np.linalg.svd(np.vstack([r[k : len(r) - s + 1 + k].T for k in range(s)]), compute_uv=False), 0.0)
        assert values[due.rank(s) - 1] > 1e-6 * values[0] and values[due.rank(s)] < 1e-11 * values[0]
