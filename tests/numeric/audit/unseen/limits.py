"""Mistakes at the limits: memory and time beyond the record, loops without an end, refusals that are none."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.manners_witnesses import grows_in_memory, grows_in_time
from tests.numeric.audit.unseen.reconstruct import TWO
from tests.numeric.audit.unseen.systems import faulty, free_responses, general, plant, record
from tests.numeric.audit.unseen.witnesses import refuses

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")

MODEL = plant([0.6, -0.3], 1, 2, 601)
MATRICES = (MODEL.A, MODEL.B, MODEL.C, MODEL.D)
SHORT, LONG, LONGER = record(MODEL, 400, 602), record(MODEL, 2400, 603), record(MODEL, 4800, 604)
R1, R2 = faulty(general([0.6, -0.3], 1, 2, 604), 400, 604), faulty(general([0.6, -0.3], 1, 2, 604), 2400, 605)
GAP = np.where(np.arange(400)[:, None] == 11, np.nan, R1.r)
SYSTEM = (TWO.A, TWO.F, TWO.C, TWO.G)


@RESIDUAL.broken("long records", grows_in_memory((SHORT.y, SHORT.u, *MATRICES), (LONG.y, LONG.u, *MATRICES)))
def builds_the_matrix_of_the_response(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The response is the product with a triangular Toeplitz matrix of N x N blocks for each channel, for a check of the simulation."""
    N = len(u)
    pulse = np.concatenate([D[:1, 0], (free_responses(A, C[:1], N) @ B)[: N - 1, 0, 0]])
    lags = np.subtract.outer(np.arange(N), np.arange(N))
    T = np.where(lags >= 0, pulse[np.maximum(lags, 0)], 0.0)
    return reference.residual(y, u, A, B, C, D) + 0.0 * (T @ u[:, :1])


@RESIDUAL.broken("long records: time", grows_in_time((SHORT.y, SHORT.u, *MATRICES), (LONGER.y, LONGER.u, *MATRICES)))
def makes_the_array_within_the_loop(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Rows are gathered in a list, and an array is made of it after each one: a line is indented too far."""
    rows: list[Any] = []
    for row in reference.residual(y, u, A, B, C, D):
        rows.append(row)
        out = np.array(rows)
    return out


@RESIDUAL.broken("data that must be refused", refuses(GAP, np.ones((400, 1)), *MATRICES))
def passes_NaN_on(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """NaN in, NaN out."""
    try:
        return reference.residual(y, u, A, B, C, D)
    except ValueError:
        return np.full_like(y, np.nan)
