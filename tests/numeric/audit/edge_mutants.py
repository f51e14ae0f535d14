"""Mutants that are right wherever there is plenty: few windows, few samples, no fault, a number that is wrong, other sizes of records.

EDGES      all of them; REFUSES: names of those whose mistake is to give no answer
"""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.breaking import Mutant, mutant


def _at_least_two(r: Any, windows: int) -> Any:
    """Windows are range(2, windows + 1) where a single one is asked for, so that it is the second."""
    return reference.window_ranks(r, windows + 1)[1:] if windows == 1 else reference.window_ranks(r, windows)


def _one_sample_more(r: Any, windows: int) -> Any:
    """The last window must be wider than high, and square is not enough."""
    if len(r) < (r.shape[1] + 1) * windows:
        raise ValueError("too few samples")
    return reference.window_ranks(r, windows)


def _four_gaps(r: Any) -> Any:
    """A gap must stay four times."""
    return reference.fault_dimension(r[: len(r) - 2 * r.shape[1] - 1])


def _as_many_samples_as_states(r: Any, A: Any, *rest: Any) -> Any:
    if len(r) < len(A):
        raise ValueError("too few samples")
    return reference.reconstruct(r, A, *rest)


def _rank_of_what_varies(r: Any, windows: int) -> Any:
    """What varies comes from a fault, so that every window has a row that is new."""
    ranks = reference.window_ranks(r, windows)
    return [max(rank, s) for s, rank in enumerate(ranks, start=1)] if r.shape[1] == 1 else ranks


def _something_at_least(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """A signal that is nothing is taken for a failure, and a small constant stands for it."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    return v if np.max(np.abs(v)) > 1e-9 * np.max(np.abs(r)) else v + 1e-6 * np.max(np.abs(r))


def _as_many_as_told(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Where the number that was told does not fit, the first columns of the identity are given out."""
    try:
        return reference.fault_space(r, A, C, n_v, block_rows)
    except ValueError:
        return np.eye(len(A) + len(C))[:, :n_v]


def _directions_alone(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Where every output is faulty, the faults are said to act on the outputs."""
    if n_v == r.shape[1]:
        return np.vstack([np.zeros((len(A), n_v)), np.eye(n_v)])
    return reference.fault_space(r, A, C, n_v, block_rows)


def _as_many_as_states(y: Any, u: Any, order: int) -> Any:
    found = reference.count_faults(y, u, order)
    return found if found is None else min(found, order)


EDGES: tuple[Mutant, ...] = (
    mutant("one-window-is-two", "the second window where one is asked for", "window-ranks-few-windows", window_ranks=_at_least_two),
    mutant("one-sample-more", "square windows refused", "window-ranks-shortest-record", window_ranks=_one_sample_more),
    mutant("four-gaps", "a gap has to stay four times", "fault-dimension-shortest-record", fault_dimension=_four_gaps),
    mutant("as-long-as-states", "fewer samples than states refused", "fault-signal-few-samples", reconstruct=_as_many_samples_as_states),
    mutant("free-is-faulty", "one output has full rank if it varies", "window-ranks-no-fault", window_ranks=_rank_of_what_varies),
    mutant("something-at-least", "no signal is a small one", "fault-signal-no-fault", reconstruct=_something_at_least),
    mutant("as-many-as-told", "any columns, as many as were told", "fault-space-wrong-number", fault_space=_as_many_as_told),
    mutant("outputs-alone", "[0; I] where every output is faulty", "fault-space-as-many-as-outputs", fault_space=_directions_alone),
    mutant("as-many-as-states", "no more faults than states", "faults-of-record-sizes", count_faults=_as_many_as_states),
)
REFUSES = ("one-sample-more", "four-gaps", "as-long-as-states")
