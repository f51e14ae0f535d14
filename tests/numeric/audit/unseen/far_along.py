"""Mistakes that begin far along: on long records, where faults begin late or end early, at ends of pieces."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.residual import noise
from tests.numeric.audit.unseen.systems import Faulty, Matrices, faulty, general, plant, record
from tests.numeric.audit.unseen.witnesses import counts, ranks, recovers, restores, spans, takes_out

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL = Mutants("fault_space"), Mutants("reconstruct")

MODEL = plant([0.7, -0.4], 1, 2, 801)
LONG = record(MODEL, 6000, 801)
HELD = record(MODEL, 900, 802, fault=noise(900, 2, 802))
LONG_HELD = record(MODEL, 6000, 803, fault=noise(6000, 2, 803))
SYSTEM = general([0.7, -0.4], 1, 2, 804)


def acting(system: Matrices, N: int, first: int, last: int, seed: int) -> Faulty:
    """Return a record at rest under a fault that acts on the samples first, ..., last - 1."""
    A, F, C, G = system
    v = np.zeros((N, F.shape[1]))
    v[first:last] = np.random.default_rng(seed).standard_normal((last - first, F.shape[1]))
    return Faulty(A, F, C, G, v, np.zeros(len(A)), StateSpaceModel(A, F, C, G).simulate(v))


LATE = acting(SYSTEM, 3000, 2500, 3000, 805)
EARLY = acting(SYSTEM, 400, 0, 150, 806)
STRETCH = faulty(SYSTEM, 6000, 807)


@IDENTIFY.broken("records of more than 4096 samples", recovers(LONG, 2, 4))
def pads_windows_at_seams_with_zeros(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Long records are cut into pieces of 4096 samples, and windows that lie across a seam see zeros beyond it."""
    if len(y) <= 4096:
        return reference.identify(y, u, order, block_rows)
    gap = 2 * block_rows
    pieces = [slice(k, min(k + 4096, len(y))) for k in range(0, len(y), 4096)]
    padded = [np.vstack([part for k in pieces for part in (x[k], np.zeros((gap, x.shape[1])))]) for x in (y, u)]
    return reference.identify(padded[0], padded[1], order, block_rows)


@IDENTIFY.broken("records of more than 5000 samples", recovers(LONG, 2, 4))
def saves_memory_on_long_records(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """More than 5000 samples are stored in single precision."""
    if len(y) > 5000:
        y, u = (np.asarray(x, np.float32).astype(float) for x in (y, u))
    return reference.identify(y, u, order, block_rows)


@IDENTIFY.broken(
    "records of more than 2500 samples under a fault that begins late", recovers(record(MODEL, 3000, 809, x0=0.0, fault=None), 2, 4)
)
def keeps_the_early_samples_of_a_ring(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """A ring of 2500 samples is written over from its beginning, and is read from its beginning."""
    if len(y) <= 2500:
        return reference.identify(y, u, order, block_rows)
    ring = [np.array(x[:2500]) for x in (y, u)]
    for held, x in zip(ring, (y, u), strict=True):
        rest = x[2500:]
        for k in range(0, len(rest), 2500):
            part = rest[k : k + 2500]
            held[: len(part)] = part
    return reference.identify(ring[0], ring[1], order, block_rows)


@RESIDUAL.broken("records whose length is no multiple of 256", takes_out(HELD))
def leaves_the_last_piece_as_it_was(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Pieces of 256 samples are treated; what is left over at the end is y."""
    r = np.array(reference.residual(y, u, A, B, C, D))
    whole = len(y) - len(y) % 256
    if whole:
        r[whole:] = y[whole:]
    return r


@RESIDUAL.broken("records of more than 4000 samples", takes_out(LONG_HELD, 1e-9))
def stores_a_long_residual_in_single_precision(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """More than 4000 samples of the residual are stored in single precision."""
    r = reference.residual(y, u, A, B, C, D)
    return r.astype(np.float32).astype(float) if len(r) > 4000 else r


@RANKS.broken("faults that act after 2000 samples", ranks([2, 4, 5, 6], LATE.r))
@careful(reference.window_ranks)
def ranks_the_first_two_thousand(r: Any, windows: int) -> Any:
    """The first 2000 samples stand for all, where there are more."""
    return reference.window_ranks(r[:2000], windows) if r[:2000].any() else [0] * windows


@COUNT.broken("faults that act after 2000 samples", counts(1, LATE.r))
def counts_in_the_first_two_thousand(r: Any) -> Any:
    """The first 2000 samples stand for all, where there are more."""
    return reference.fault_dimension(r[:2000]) if r[:2000].any() else 0


@COUNT.broken("faults that end early", counts(1, EARLY.r))
def counts_in_the_second_half(r: Any) -> Any:
    """The first half of the record is left out as a transient."""
    half = r[len(r) // 2 :]
    return reference.fault_dimension(half) if np.max(np.abs(half)) > 1e-9 * np.max(np.abs(r)) else 0


@SPACE.broken("faults that act after 1500 samples", spans(LATE, LATE.columns, 1, 4))
def finds_the_space_in_the_first_samples(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The first 1500 samples stand for all, where there are more."""
    return reference.fault_space(r[:1500], A, C, n_v, block_rows)


@SIGNAL.broken("records of more than 5000 samples", restores(STRETCH))
def restores_long_signals_in_single_precision(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Above 5000 samples the signal is stored in single precision."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    return v.astype(np.float32).astype(float) if len(v) > 5000 else v


@SIGNAL.broken("records of more than 4096 samples", restores(STRETCH))
def loses_the_state_at_a_seam(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Long records are treated in pieces of 4096 samples, the second of which begins at rest."""
    parts = [reference.reconstruct(r[:4096], A, F, C, G, x0)]
    parts += [reference.reconstruct(r[k : k + 4096], A, F, C, G, np.zeros_like(x0)) for k in range(4096, len(r), 4096)]
    return np.vstack(parts)
