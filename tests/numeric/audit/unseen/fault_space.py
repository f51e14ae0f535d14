"""Mistakes in `fault_space`: zeros, conditions, windows, units, data that must be refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import Faulty, faulty, general, joined, jordan, with_zeros
from tests.numeric.audit.unseen.window_ranks import hankel
from tests.numeric.audit.unseen.witnesses import null_space, refuses, spans

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
OUTSIDE = faulty(with_zeros([1.5], [0.5, -0.3, 0.1], 2, 104), 300, 104)
AT_ONE = faulty(with_zeros([1.0], [0.5, -0.3, 0.1], 2, 105), 300, 105)
ZEROS = faulty(with_zeros([0.6, -0.2], [0.5, -0.3, 0.1, 0.8], 2, 110), 300, 110)
HIDDEN = faulty(joined([general([0.5, -0.2], 1, 2, 112)], np.eye(2), 112, unobservable=[0.3]), 300, 112)
HIDDEN_STATE = np.vstack([null_space(np.vstack([HIDDEN.C, HIDDEN.C @ HIDDEN.A])), np.zeros((2, 1))])
SMALL = faulty(general([0.7, -0.4, 0.3], 1, 2, 101), 300, 101, units=1e-11)
GROWING = faulty(general([1.05, -0.4], 1, 2, 111), 100, 111)
UNLIKE = faulty(general([0.7, -0.4, 0.3], 1, 2, 106), 300, 106, units=[1.0, 1e6])
WEAK = faulty(general([0.7, -0.4], 2, 3, 107), 300, 107, sizes=[1.0, 1e-8])
NILPOTENT = faulty(general(jordan(0.0, 3), 1, 2, 108), 300, 108)
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


@SPACE.broken("faults with zeros outside the unit circle", spans(OUTSIDE, truth(OUTSIDE, [1.5]), 1, 5))
def leaves_out_columns_of_unstable_zeros(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Columns whose response does not come from a decaying fault are left out: those with g = 0 and a growing signal."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    if Z.shape[1] == n_v:
        return Z
    n, extra = len(A), Z.shape[1] - n_v
    poles = np.linalg.eigvals(A)
    response = np.vstack([C @ np.linalg.matrix_power(A, k) @ Z[:n] for k in range(4)])
    order = np.argsort(np.linalg.norm(response, axis=0) * np.max(np.abs(poles)))
    return Z[:, np.sort(order[extra:])]


@SPACE.broken("a zero at 1", spans(AT_ONE, truth(AT_ONE, [1.0]), 1, 5))
def works_with_differences(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Conditions for a step are added to those for a pulse, as if every fault had to be seen when constant."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    n = len(A)
    steady = C @ np.linalg.solve(np.eye(n) - A, Z[:n]) + Z[n:]
    _, values, right = np.linalg.svd(steady)
    kept = right[: max(int(np.sum(values > 1e-6 * max(values[0], 1e-300))), n_v)]
    return Z @ kept.T


@SPACE.broken("faults that act on outputs directly", spans(PLAIN, PLAIN.columns, 1, 4))
def has_no_direct_part(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The columns have g = 0."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.vstack([Z[: len(A)], np.zeros((len(C), Z.shape[1]))])


@SPACE.broken("faults in both states and outputs", spans(PLAIN, PLAIN.columns, 1, 4))
def turns_the_sign_of_the_states(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """f has the sign of x(k+1) - A x = -F v."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.vstack([-Z[: len(A)], Z[len(A) :]])


@SPACE.broken("A other than the identity", spans(PLAIN, PLAIN.columns, 1, 4))
def lets_the_fault_act_a_sample_late(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The pulse reaches the state after the step: f has become A f."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.vstack([A @ Z[: len(A)], Z[len(A) :]])


@SPACE.broken("A not symmetric", spans(PLAIN, PLAIN.columns, 1, 4))
@careful(reference.fault_space)
def transposes_the_powers(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Conditions are made with powers of A'."""
    return twin(r, A.T, C, block_rows)


@SPACE.broken("outputs in unlike units", spans(UNLIKE, UNLIKE.columns, 1, 4))
def does_not_scale_g_back(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """g is left in units of the channels' sizes."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.vstack([Z[: len(A)], Z[len(A) :] / np.sqrt(np.mean(r**2, axis=0))[:, None]])


@SPACE.broken("outputs in unlike units", spans(UNLIKE, UNLIKE.columns, 1, 4))
def orthonormalises_and_tidies(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Entries below a ten-thousandth of the largest are set to zero, so that the answer reads well."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.where(np.abs(Z) < 1e-4 * np.max(np.abs(Z)), 0.0, Z)


@SPACE.broken("windows just long enough", spans(PLAIN, PLAIN.columns, 1, 4))
@careful(reference.fault_space)
def leaves_out_the_last_pulse(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Pulses stand at all samples of the window but the last: an index ends early."""
    return (
        twin(r, A, C, 3, pulses=lambda s: range(s - 1)) if block_rows < 3 else twin(r, A, C, block_rows, pulses=lambda s: range(s - 2, s))
    )


@SPACE.broken("all faults that act through states", spans(PLAIN, PLAIN.columns, 1, 4))
@careful(reference.fault_space)
def leaves_out_the_last_row(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The sum over the window ends a sample early."""
    return twin(r, A, C, block_rows, last=1)


@SPACE.broken("faults with zeros, whose ranks are smaller", spans(ZEROS, truth(ZEROS, [0.6, -0.2]), 1, 4))
@careful(reference.fault_space)
def takes_the_generic_rank(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The rank of R_s is said to be n_v s + n, which holds without zeros, and windows with no null row by that count are refused."""
    rank = n_v * block_rows + len(A)
    if rank >= r.shape[1] * block_rows:
        raise ValueError(f"{block_rows} block rows are too few")
    return twin(r, A, C, block_rows, rank=rank)


@SPACE.broken("lags of five samples and more", spans(LONG, LONG.columns, 1, 7))
@careful(reference.fault_space)
def caps_the_window(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The window is at most four block rows, to save time."""
    return twin(r, A, C, min(block_rows, 4))


@SPACE.broken("two faults of unlike sizes", spans(WEAK, WEAK.columns, 2, 3, 1e-4))
@careful(reference.fault_space)
def takes_a_weak_fault_for_rounding(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The threshold is 1e-6 of the largest singular value."""
    return twin(r, A, C, block_rows, relative=1e-6)


@SPACE.broken("small units", spans(SMALL, SMALL.columns, 1, 4))
@careful(reference.fault_space)
def adds_a_ridge(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The Gram matrix of R_s gets 1e-12 on its diagonal, whatever the units, and its eigenvectors below 1e-10 are null vectors."""
    R = hankel(r, block_rows)
    values = np.linalg.eigvalsh(R @ R.T + 1e-12 * np.eye(len(R)))
    return twin(r, A, C, block_rows, rank=int(np.sum(values > 1e-10)))


@SPACE.broken("all residuals whose signal has a mean", spans(PLAIN, PLAIN.columns, 1, 4))
@careful(reference.fault_space)
def centres_the_residual(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The mean is taken off r, by which it obeys its laws no more."""
    return twin(r - r.mean(axis=0), A, C, block_rows, relative=1e-3, rank=n_v * block_rows + len(A))


@SPACE.broken("poles at 0", spans(NILPOTENT, NILPOTENT.columns, 1, 4))
def inverts_A(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A change of state by A and back needs A to be invertible."""
    if np.linalg.cond(A) > 1e10:
        raise np.linalg.LinAlgError("Singular matrix")
    return reference.fault_space(r, A, C, n_v, block_rows)


@SPACE.broken("unstable systems", spans(GROWING, GROWING.columns, 1, 3, 1e-6))
@careful(reference.fault_space)
def replaces_unstable_poles(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A is scaled to spectral radius one where it is larger."""
    return twin(r, A / max(1.0, float(np.max(np.abs(np.linalg.eigvals(A))))), C, block_rows)


@SPACE.broken("complex poles in modal form", spans(P3, P3.columns, 2, 5))
@careful(reference.fault_space)
def takes_the_real_part_of_modes(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Powers of A are those of the real parts of its eigenvalues."""
    poles, V = np.linalg.eig(A)
    return twin(r, np.real(V @ np.diag(poles.real) @ np.linalg.inv(V)), C, block_rows)


@SPACE.broken("three outputs and more", spans(P3, P3.columns, 2, 5))
@careful(reference.fault_space)
def takes_one_null_row(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Of the kernel rows the last is used, as if p - n_v were one and its shifts came by themselves."""
    return twin(r, A, C, block_rows, rank=r.shape[1] * block_rows - 1, pulses=lambda s: range(1))


@SPACE.broken("models with a mode that no output shows", spans(HIDDEN, np.hstack([HIDDEN.columns, HIDDEN_STATE]), 1, 3))
def leaves_out_what_is_not_seen(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Columns without any response are left out, though they explain r as well as any."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    n = len(A)
    response = np.vstack([Z[n:], *[C @ np.linalg.matrix_power(A, k) @ Z[:n] for k in range(n)]])
    _, values, right = np.linalg.svd(response)
    return Z @ right[: int(np.sum(values > 1e-8 * values[0]))].T


@SPACE.broken("all residuals, by about the accuracy of float32", spans(P3, P3.columns, 2, 5))
@careful(reference.fault_space)
def powers_in_single_precision(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A and C are float32 where the conditions are made."""
    return twin(r, A.astype(np.float32).astype(float), C.astype(np.float32).astype(float), block_rows)


@SPACE.broken("more than one column", spans(P3, P3.columns, 2, 5))
def returns_columns_of_the_pairwise_largest(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Each state and output keeps its largest coefficient alone, a sparse guess of which sensor or actuator it is."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    return np.where(np.abs(Z) == np.max(np.abs(Z), axis=1, keepdims=True), Z, 0.0) if Z.shape[1] > 1 else Z


@SPACE.broken("windows at the lag", refuses(LONG.r, LONG.A, LONG.C, 1, 3))
def accepts_any_window(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Where the window has no null row every column is a solution and is returned."""
    try:
        return reference.fault_space(r, A, C, n_v, block_rows)
    except ValueError:
        if not np.isfinite(r).all() or len(r) < 20:
            raise
        return np.eye(len(A) + len(C))


@SPACE.broken("C with as many columns as A and rows as r, but r turned", refuses(P3.r.T, P3.A, P3.C, 2, 5))
def turns_r_to_fit(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A residual with a column a sample is turned without a word."""
    return reference.fault_space(r.T if r.shape[0] == len(C) else r, A, C, n_v, block_rows)


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
