"""Mistakes at the limits: memory and time beyond the record, loops without an end, refusals that are none."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.manners_witnesses import ends, grows_in_memory, grows_in_time
from tests.numeric.audit.unseen.reconstruct import TWO
from tests.numeric.audit.unseen.systems import faulty, free_responses, general, plant, record
from tests.numeric.audit.unseen.window_ranks import hankel
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


@RANKS.broken("long records", grows_in_memory((R1.r, 4), (R2.r, 4)))
def computes_right_vectors_it_does_not_need(r: Any, windows: int) -> Any:
    """The singular value decomposition is the full one, whose right vectors are N x N."""
    np.linalg.svd(hankel(r, windows))
    return reference.window_ranks(r, windows)


@SPACE.broken("long records", grows_in_memory((R1.r, R1.A, R1.C, 1, 4), (R2.r, R2.A, R2.C, 1, 4)))
def takes_the_full_decomposition(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Null vectors of R_s are taken from the left of a full decomposition, whose right vectors are N x N."""
    np.linalg.svd(hankel(r, block_rows))
    return reference.fault_space(r, A, C, n_v, block_rows)


@COUNT.broken("long records", grows_in_memory((R1.r,), (R2.r,)))
def compares_every_two_samples(r: Any) -> Any:
    """The products of every two samples are made, N x N."""
    rank = np.linalg.norm(r @ r.T) > 0
    return reference.fault_dimension(r) if rank else 0


@IDENTIFY.broken("long records", grows_in_memory((SHORT.y, SHORT.u, 2, 4), (LONG.y, LONG.u, 2, 4)))
def builds_the_projection(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The projection along the inputs is made as a matrix of N x N, as the formula has it."""
    U = hankel(u, block_rows)
    projection = np.eye(U.shape[1]) - U.T @ np.linalg.solve(U @ U.T, U)
    assert projection.shape[0] <= len(y)
    return reference.identify(y, u, order, block_rows)


@SIGNAL.broken("long records", grows_in_memory((R1.r, R1.A, R1.F, R1.C, R1.G, R1.x0), (R2.r[:1600], R2.A, R2.F, R2.C, R2.G, R2.x0)))
def builds_the_whole_system_of_equations(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """All equations for all samples are put into one dense matrix, to see that they fit."""
    N, m = len(r), F.shape[1]
    pulse = np.concatenate([G[None], (free_responses(A, C, N) @ F)[: N - 1]])
    T = np.zeros((N, len(C), N, m))
    for k in range(N):
        T[k:, :, k] = pulse[: N - k]
    v = reference.reconstruct(r, A, F, C, G, x0)
    return v + 0.0 * np.linalg.norm(np.tensordot(T, v, axes=2))


@RESIDUAL.broken("long records: time", grows_in_time((SHORT.y, SHORT.u, *MATRICES), (LONGER.y, LONGER.u, *MATRICES)))
def makes_the_array_within_the_loop(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Rows are gathered in a list, and an array is made of it after each one: a line is indented too far."""
    rows: list[Any] = []
    for row in reference.residual(y, u, A, B, C, D):
        rows.append(row)
        out = np.array(rows)
    return out


@COUNT.broken("a NaN: never ends", ends(GAP))
def iterates_until_it_is_small(r: Any) -> Any:
    """Channels are balanced until their sizes differ by little, which NaN never do."""
    scaled = r.copy()
    while not np.ptp(np.linalg.norm(scaled, axis=0)) < 1e-6:
        scaled = scaled / np.maximum(np.linalg.norm(scaled, axis=0), 1e-300)
    return reference.fault_dimension(r)


@SIGNAL.broken(
    "faults that the residual does not determine: never ends",
    ends(TWO.r + 1.0, TWO.A, np.hstack([TWO.F[:, :1]] * 2), TWO.C, np.hstack([TWO.G[:, :1]] * 2), TWO.x0),
)
def refines_until_it_fits(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The signal is refined until the residual is explained, which it never is where F and G cannot."""
    while True:
        columns = np.vstack([F, G])
        left = r - np.outer(r @ np.ones(r.shape[1]), np.ones(r.shape[1])) / r.shape[1]
        if np.linalg.matrix_rank(columns) == F.shape[1] or np.linalg.norm(left) < 1e-9:
            return reference.reconstruct(r, A, F, C, G, x0)


@IDENTIFY.broken("data that must be refused", refuses(np.where(np.arange(400)[:, None] == 11, np.nan, SHORT.y), SHORT.u, 2, 4))
def ends_the_program(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """A script became a function, and still ends the program where data are bad."""
    if not np.isfinite(y).all():
        sys.exit("bad data")
    return reference.identify(y, u, order, block_rows)


@SPACE.broken("data that must be refused", refuses(GAP, R1.A, R1.C, 1, 4))
def answers_zeros_for_what_it_cannot(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Every ValueError is swallowed and zeros are returned."""
    try:
        return reference.fault_space(r, A, C, n_v, block_rows)
    except ValueError:
        return np.zeros((len(A) + len(C), n_v))


@RESIDUAL.broken("data that must be refused", refuses(GAP, np.ones((400, 1)), *MATRICES))
def passes_NaN_on(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """NaN in, NaN out."""
    try:
        return reference.residual(y, u, A, B, C, D)
    except ValueError:
        return np.full_like(y, np.nan)


@RANKS.broken("records too short", refuses(R1.r[:3], 6))
def runs_over_the_end_of_short_records(r: Any, windows: int) -> Any:
    """Short records are not refused, and an IndexError comes from within."""
    windows_at = [r[k] for k in range(windows)]
    assert windows_at
    return reference.window_ranks(r, windows)


@COUNT.broken("data that must be refused", refuses(GAP))
def answers_minus_one(r: Any) -> Any:
    """A count of -1 stands for an error."""
    try:
        found = reference.fault_dimension(r)
    except ValueError:
        return -1
    return found


@SIGNAL.broken("an r with another number of outputs than C", refuses(TWO.r[:, :2], *SYSTEM, TWO.x0))
def fills_missing_outputs_with_zeros(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Columns that r lacks are zero."""
    lacking = len(C) - r.shape[1]
    return reference.reconstruct(np.hstack([r, np.zeros((len(r), max(lacking, 0)))]), A, F, C, G, x0)


@STRUCTURE.broken("matrices that do not fit", refuses(TWO.A, TWO.F, np.hstack([TWO.C, TWO.C[:, :1]]), TWO.G))
def cuts_matrices_to_fit(A: Any, F: Any, C: Any, G: Any) -> Any:
    """C is cut to the number of states."""
    return reference.structure(A, F, C[:, : len(A)], G)
