"""Mistakes in shapes and corner cases: one output, no states, as many faults as outputs, more outputs than states, duals, exact silence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure, guarded
from faultspace.numeric.audit.records import Refused
from tests.numeric.audit.unseen.form import Function, Mutants, Witness, careful
from tests.numeric.audit.unseen.systems import Faulty, channel, faulty, general, joined, mixing
from tests.numeric.audit.unseen.witnesses import answered, ranks

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")
COUNTED, FOUND = Mutants("count_faults"), Mutants("identified_fault_space")

FREE = 0.9 ** np.arange(80)[:, None]
MANY = faulty(general([0.5], 5, 6, 701), 400, 701)
ALL = faulty(general([0.5, -0.3], 2, 2, 702), 200, 702)
STATIC = faulty((np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[1.0], [-2.0]])), 120, 703)
DELAYED = faulty(joined([channel([], [0.5, -0.3])], mixing(2, 1), 704), 120, 704)
PLAIN = faulty(general([0.7, -0.4], 1, 2, 705), 150, 705)


@RANKS.broken("one output without a fault", ranks([1, 1, 1], FREE))
@careful(reference.window_ranks)
def takes_one_output_for_full_rank(r: Any, windows: int) -> Any:
    """One output has windows of full rank, which is so under a fault alone."""
    return list(range(1, windows + 1)) if r.shape[1] == 1 else reference.window_ranks(r, windows)


@RANKS.broken("one window asked", ranks([2], PLAIN.r))
@careful(reference.window_ranks)
def leaves_out_the_last_window(r: Any, windows: int) -> Any:
    """The list ends one window early where a single window is asked: range(1, windows)."""
    return list(reference.window_ranks(r, windows))[: max(windows - 1, 0)] if windows == 1 else reference.window_ranks(r, windows)


def all_or_nothing(found: Faulty) -> Witness:
    """With as many faults as outputs every column is a solution; to refuse is as right."""

    def witness(function: Function) -> float:
        try:
            Z = guarded(function)(found.r.copy(), found.A, found.C, found.r.shape[1], 5)
        except Refused:
            return 0.0
        whole = len(found.A) + len(found.C)
        return 0.0 if np.linalg.matrix_rank(Z) == whole else np.inf

    return witness


@SPACE.broken("as many faults as outputs", all_or_nothing(ALL))
def tells_g_alone_where_every_output_is_faulty(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """With as many faults as outputs, where every column explains r, the columns are [0; I]."""
    if n_v == r.shape[1]:
        return np.vstack([np.zeros((len(A), n_v)), np.eye(n_v)])
    return reference.fault_space(r, A, C, n_v, block_rows)


@STRUCTURE.broken(
    "orders that differ",
    answered(
        lambda got: float(list(got.infinite_zero_orders) != [1, 3]),
        *joined([channel([0.6], [0.5, -0.3]), channel([], [0.2, 0.7, 0.4])], mixing(2, 2), 710),
    ),
)
def lists_orders_from_the_largest(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders of infinite zeros are listed descending."""
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=sorted(found.infinite_zero_orders, reverse=True))
