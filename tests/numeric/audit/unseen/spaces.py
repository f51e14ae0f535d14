"""Mistakes in `fault_space` and in `reconstruct`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.ranks import hankel
from tests.numeric.audit.unseen.systems import Faulty, faulty, general, with_zeros
from tests.numeric.audit.unseen.witnesses import refuses, restores, spans

SPACE = Mutants("fault_space")


def truth(found: Faulty, zeros: list[float]) -> Any:
    """Return [F; G] and the columns [x; 0] of real zeros: (q I - A) x = F v, C x + G v = 0."""
    n, columns = len(found.A), [found.columns]
    for q in zeros:
        pencil = np.block([[q * np.eye(n) - found.A, -found.F], [found.C, found.G]])
        kernel = np.linalg.svd(pencil)[2][-1:].T
        columns.append(np.vstack([kernel[:n], np.zeros((len(found.C), 1))]))
    return np.hstack(columns)


PLAIN = faulty(general([0.7, -0.4, 0.3], 1, 2, 101), 300, 101)
P3 = faulty(general([0.7, -0.4, 0.3 + 0.4j], 2, 3, 102), 400, 102)
ZERO = faulty(with_zeros([0.6], [0.5, -0.3, 0.1], 2, 103), 300, 103)
ZEROS = faulty(with_zeros([0.6, -0.2], [0.5, -0.3, 0.1, 0.8], 2, 110), 300, 110)
UNLIKE = faulty(general([0.7, -0.4, 0.3], 1, 2, 106), 300, 106, units=[1.0, 1e6])
LONG = faulty(general([0.7, -0.4, 0.3, 0.5, -0.6, 0.1], 1, 2, 109), 400, 109)


def twin(r: Any, A: Any, C: Any, s: int, *, relative: float = 1e-11, pulses: Any = None, last: int = 0, rank: int | None = None) -> Any:
    """Return the columns that all left null vectors of R_s annihilate; for pulses at these samples of the window, and `last` rows less."""
    sizes = np.sqrt(np.mean(r**2, axis=0))
    r, C = r / sizes, C / sizes[:, None]
    p, n = C.shape
    left, values, _ = np.linalg.svd(np.asarray(np.linalg.qr(hankel(r, s).T, mode="r")).T)
    kept = int(np.sum(values > relative * values[0])) if rank is None else rank
    rows = left[:, kept:].T.reshape(-1, s, p)
    conditions = []
    for j in range(s) if pulses is None else pulses(s):
        state, of_f = np.eye(n), np.zeros((len(rows), n))
        for i in range(j + 1, s - last):
            of_f += rows[:, i] @ C @ state
            state = A @ state
        conditions.append(np.hstack([of_f, rows[:, j]]))
    _, strengths, right = np.linalg.svd(np.vstack(conditions))
    independent = int(np.sum(strengths > 1e-8 * strengths[0]))
    Z = right[independent:].T
    return np.vstack([Z[:n], sizes[:, None] * Z[n:]])


@SPACE.broken("faults with zeros", spans(ZERO, truth(ZERO, [0.6]), 1, 5))
def returns_n_v_columns(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """As many columns are returned as there are faults."""
    return reference.fault_space(r, A, C, n_v, block_rows)[:, :n_v]


@SPACE.broken("faults that act on outputs directly", spans(PLAIN, PLAIN.columns, 1, 4))
def has_no_direct_part(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The columns have g = 0."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.vstack([Z[: len(A)], np.zeros((len(C), Z.shape[1]))])


@SPACE.broken("A other than the identity", spans(PLAIN, PLAIN.columns, 1, 4))
def lets_the_fault_act_a_sample_late(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The pulse reaches the state after the step: f has become A f."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.vstack([A @ Z[: len(A)], Z[len(A) :]])


@SPACE.broken("outputs in unlike units", spans(UNLIKE, UNLIKE.columns, 1, 4))
def orthonormalises_and_tidies(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Entries below a ten-thousandth of the largest are set to zero, so that the answer reads well."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.where(np.abs(Z) < 1e-4 * np.max(np.abs(Z)), 0.0, Z)


@SPACE.broken("faults with zeros, whose ranks are smaller", spans(ZEROS, truth(ZEROS, [0.6, -0.2]), 1, 4))
@careful(reference.fault_space)
def takes_the_generic_rank(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The rank of R_s is said to be n_v s + n, which holds without zeros, and windows with no null row by that count are refused."""
    rank = n_v * block_rows + len(A)
    if rank >= r.shape[1] * block_rows:
        raise ValueError(f"{block_rows} block rows are too few")
    return twin(r, A, C, block_rows, rank=rank)


@SPACE.broken("windows at the lag", refuses(LONG.r, LONG.A, LONG.C, 1, 3))
def accepts_any_window(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Where the window has no null row every column is a solution and is returned."""
    try:
        return reference.fault_space(r, A, C, n_v, block_rows)
    except ValueError:
        if not np.isfinite(r).all() or len(r) < 20:
            raise
        return np.eye(len(A) + len(C))


@SPACE.broken("A with a NaN", refuses(P3.r, np.where(np.eye(4) > 0, np.nan, P3.A), P3.C, 2, 5))
def replaces_NaN_in_A(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """NaN in A becomes zero."""
    return reference.fault_space(r, np.nan_to_num(A), C, n_v, block_rows)


@SPACE.broken("records with fewer windows than rows", refuses(P3.r[:15], P3.A, P3.C, 2, 5))
def takes_missing_columns_for_null_rows(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A record too short is not refused, and its shortage of data passes for laws."""
    return (
        twin(r, A, C, block_rows) if len(r) < 4 * block_rows and np.isfinite(r).all() else reference.fault_space(r, A, C, n_v, block_rows)
    )


@SPACE.broken("n_v above the number of outputs", refuses(P3.r, P3.A, P3.C, 4, 5))
def cuts_n_v_to_the_outputs(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """More faults than outputs are taken for p - 1."""
    return reference.fault_space(r, A, C, min(n_v, len(C) - 1), block_rows)


SIGNAL = Mutants("reconstruct")

SHOWN = faulty(general([0.7, -0.4, 0.3], 1, 2, 201), 120, 201)
TWO = faulty(general([0.7, -0.4], 2, 3, 202), 120, 202)
INSIDE = faulty(with_zeros([0.8], [0.5, -0.3], 2, 205), 120, 205)
UNSTABLE = faulty(general([1.05, -0.4], 1, 2, 209), 100, 209)


SIGN = float(-np.sign(SHOWN.G[0, 0]))
NEGATIVE = Faulty(
    SHOWN.A,
    SIGN * SHOWN.F,
    SHOWN.C,
    SIGN * SHOWN.G,
    SIGN * SHOWN.v,
    SHOWN.x0,
    SHOWN.r,
)


def inverse(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Return the signal by v = G^+ (r - C x), sample by sample."""
    x, left, v = x0.astype(float), np.linalg.pinv(G), np.zeros((len(r), G.shape[1]))
    for k in range(len(r)):
        v[k] = left @ (r[k] - C @ x)
        x = A @ x + F @ v[k]
    return v


@SIGNAL.broken("records that do not begin at rest", restores(SHOWN))
def starts_from_rest(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The initial state is not used."""
    return reference.reconstruct(r, A, F, C, G, np.zeros_like(x0))


@SIGNAL.broken("zeros inside the unit circle", restores(INSIDE, 1e-6))
def fits_the_initial_state(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """x0 is fitted with the signal though it is given, by which a zero hides the first samples."""
    from faultspace.numeric.method.signal.reconstruction import reconstruct_fault

    return reconstruct_fault(r, A, F, C, G).v


@SIGNAL.broken("columns whose first entry is negative", restores(NEGATIVE))
def makes_the_first_entry_positive(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Columns get a sign by convention, the first entry of g positive, and the signal goes with it."""
    return reference.reconstruct(r, A, F, C, G, x0) * np.where(G[0] < 0, -1.0, 1.0)


@SIGNAL.broken("unstable systems", restores(UNSTABLE, 1e-6))
def refuses_unstable_systems(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """An A with a pole outside the unit circle is refused."""
    if np.max(np.abs(np.linalg.eigvals(A)), initial=0.0) > 1:
        raise ValueError("unstable")
    return reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken("small units of the signal", restores(faulty(general([0.7, -0.4], 1, 2, 213), 100, 213, sizes=1e-7)))
def rounds_the_signal(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The signal is rounded to ten decimals."""
    return np.round(reference.reconstruct(r, A, F, C, G, x0), 10)


@SIGNAL.broken("more faults than outputs", refuses(TWO.r[:, :1], TWO.A, TWO.F, TWO.C[:1], TWO.G[:1], TWO.x0))
def answers_for_more_faults_than_outputs(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The pseudoinverse of G answers for wide systems, too."""
    return inverse(r, A, F, C, G, x0) if G.shape[1] > G.shape[0] else reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken("an initial state with a NaN", refuses(TWO.r, TWO.A, TWO.F, TWO.C, TWO.G, np.array([1.0, np.nan])))
def starts_from_rest_where_x0_is_NaN(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """An unknown x0 is zero."""
    return reference.reconstruct(r, A, F, C, G, np.nan_to_num(x0))
