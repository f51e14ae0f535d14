"""Mistakes in `reconstruct`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import Faulty, channel, faulty, free_responses, general, joined, mixing, with_zeros
from tests.numeric.audit.unseen.witnesses import refuses, restores

SIGNAL = Mutants("reconstruct")

PLAIN = faulty(general([0.7, -0.4, 0.3], 1, 2, 201), 120, 201)
TWO = faulty(general([0.7, -0.4], 2, 3, 202), 120, 202)
THREE = faulty(general([0.7, -0.4], 3, 4, 203), 120, 203, sizes=[1.0, 9.0, 4.0])
DELAYED = faulty(joined([channel([], [0.5, -0.3])], mixing(2, 1), 204), 120, 204)
INSIDE = faulty(with_zeros([0.8], [0.5, -0.3], 2, 205), 120, 205)
OUTSIDE = faulty(with_zeros([1.5], [0.5, -0.3, 0.2], 2, 206), 120, 206)
LONG = faulty(general([0.9, -0.4], 1, 2, 207), 1500, 207)
SMALL_G = faulty(general([0.7, -0.4], 2, 2, 208, G=3e-5), 60, 208)
UNSTABLE = faulty(general([1.05, -0.4], 1, 2, 209), 100, 209)
N8 = faulty(general([0.9, 0.7, 0.5, 0.3, -0.2, -0.4, -0.6, 0.3 + 0.8j], 1, 2, 210), 150, 210)


def _spiky() -> Faulty:
    base = faulty(general([0.7, -0.4], 1, 2, 211), 120, 211, x0=0.0)
    v = 0.1 * base.v
    v[60] = 10.0
    r = 0.1 * base.r
    pulse = np.vstack([base.G.T, (free_responses(base.A, base.C, 119 - 60) @ base.F)[:, :, 0]])
    r[60:] += (10.0 - 0.1 * base.v[60, 0]) * pulse[: len(r) - 60]
    return Faulty(base.A, base.F, base.C, base.G, v, base.x0, r)


SPIKY = _spiky()
SIGN = float(-np.sign(PLAIN.G[0, 0]))
NEGATIVE = Faulty(PLAIN.A, SIGN * PLAIN.F, PLAIN.C, SIGN * PLAIN.G, SIGN * PLAIN.v, PLAIN.x0, PLAIN.r)


def inverse(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Return the signal by v = G^+ (r - C x), sample by sample."""
    x, left, v = x0.astype(float), np.linalg.pinv(G), np.zeros((len(r), G.shape[1]))
    for k in range(len(r)):
        v[k] = left @ (r[k] - C @ x)
        x = A @ x + F @ v[k]
    return v


@SIGNAL.broken("records that do not begin at rest", restores(PLAIN))
def starts_from_rest(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The initial state is not used."""
    return reference.reconstruct(r, A, F, C, G, np.zeros_like(x0))


@SIGNAL.broken("records that do not begin at rest", restores(PLAIN))
def begins_a_sample_late(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """x0 is taken for the state before the first sample."""
    return reference.reconstruct(r, A, F, C, G, A @ x0)


@SIGNAL.broken("zeros inside the unit circle", restores(INSIDE, 1e-6))
def fits_the_initial_state(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """x0 is fitted with the signal though it is given, by which a zero hides the first samples."""
    from faultspace.numeric.method.signal.reconstruction import reconstruct_fault

    return reconstruct_fault(r, A, F, C, G).v


@SIGNAL.broken(
    "zeros outside the unit circle, as many faults as outputs",
    restores(faulty(joined([channel([1.5, 0.2], [0.5, -0.3])], [[1.0]], 212), 240, 212), 1e-6, hidden=80),
)
def runs_the_inverse_forward(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """v comes sample by sample from G^+ (r - C x), where errors grow as the zero's powers."""
    if np.linalg.matrix_rank(G) < G.shape[1]:
        return reference.reconstruct(r, A, F, C, G, x0)
    return inverse(r, A, F, C, G, x0)


@SIGNAL.broken("faults that act through states alone", restores(DELAYED))
@careful(reference.reconstruct)
def needs_a_direct_effect(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """v = G^+ (r - C x), which is zero where G is."""
    return inverse(r, A, F, C, G, x0)


@SIGNAL.broken("faults that act through states alone: a delay", restores(DELAYED))
def stamps_the_signal_when_it_is_seen(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """v(k) stands at the sample at which it is seen first."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    delay, effect = 0, G
    while np.linalg.norm(effect) < 1e-9 and delay < len(A):
        effect, delay = C @ np.linalg.matrix_power(A, delay) @ F, delay + 1
    return np.vstack([np.zeros((delay, v.shape[1])), v[: len(v) - delay]])


@SIGNAL.broken("relative degree of two and more", restores(DELAYED))
def sees_a_fault_after_one_sample(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Where G is zero, v = (C F)^+ (r(k+1) - C A x), which is zero where C F is."""
    if np.any(np.abs(G) > 1e-9):
        return reference.reconstruct(r, A, F, C, G, x0)
    shifted = np.vstack([r[1:], r[-1:]])
    return inverse(shifted, A, F, C @ A, C @ F, x0)


@SIGNAL.broken("signals above the regularisation by little, or F and G small", restores(PLAIN))
@careful(reference.reconstruct)
def regularises_and_does_not_refine(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The signal is shrunk by a ridge of 1e-5, and the bias is left in it."""
    N, p, m = len(r), len(C), F.shape[1]
    free = free_responses(A, C, N)
    pulse = np.concatenate([G[None], (free @ F)[: N - 1]])
    T = np.zeros((N, p, N, m))
    for k in range(N):
        T[k:, :, k] = pulse[: N - k]
    matrix = T.reshape(N * p, N * m)
    right = (r - free @ x0).reshape(-1)
    return np.linalg.lstsq(np.vstack([matrix, 1e-3 * np.eye(N * m)]), np.concatenate([right, np.zeros(N * m)]), rcond=None)[0].reshape(N, m)


@SIGNAL.broken("three faults and more, in an order that is no involution", restores(THREE))
def permutes_faults_back_by_the_permutation(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Faults are sorted by the size of their columns and put back by the permutation in place of its inverse."""
    order = np.argsort(-np.linalg.norm(np.vstack([F, G]), axis=0))
    return reference.reconstruct(r, A, F[:, order], C, G[:, order], x0)[:, order]


@SIGNAL.broken("columns that are not of unit length", restores(TWO))
def leaves_the_columns_normalised(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Columns are scaled to unit length and the signal is that of the scaled ones."""
    sizes = np.linalg.norm(np.vstack([F, G]), axis=0)
    return reference.reconstruct(r, A, F, C, G, x0) * sizes


@SIGNAL.broken("columns whose first entry is negative", restores(NEGATIVE))
def makes_the_first_entry_positive(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Columns get a sign by convention, the first entry of g positive, and the signal goes with it."""
    return reference.reconstruct(r, A, F, C, G, x0) * np.where(G[0] < 0, -1.0, 1.0)


@SIGNAL.broken("signals with spikes", restores(SPIKY))
def removes_outliers(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Samples beyond six deviations are set to them."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    most = 6 * np.std(v, axis=0)
    return np.clip(v, -most, most)


@SIGNAL.broken("signals with a mean", restores(PLAIN))
def centres_the_signal(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The mean of the signal is taken off."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    return v - v.mean(axis=0)


@SIGNAL.broken("records of more than 1000 samples", restores(LONG))
def restarts_every_thousand_samples(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Pieces of 1000 samples all begin in x0."""
    return np.vstack([reference.reconstruct(r[k : k + 1000], A, F, C, G, x0) for k in range(0, len(r), 1000)])


@SIGNAL.broken(
    "more outputs than faults, where the first outputs do not see the faults",
    restores(
        Faulty(
            PLAIN.A,
            PLAIN.F,
            np.vstack([0 * PLAIN.C[:1], PLAIN.C]),
            np.vstack([[[0.0]], PLAIN.G]),
            PLAIN.v,
            PLAIN.x0,
            np.hstack([np.zeros((120, 1)), PLAIN.r]),
        )
    ),
)
def uses_as_many_outputs_as_faults(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The system is made square by the first outputs."""
    m = G.shape[1]
    return reference.reconstruct(r[:, :m], A, F, C[:m], G[:m], x0)


@SIGNAL.broken("as many faults as outputs, G small", restores(SMALL_G, 1e-6))
def tests_the_determinant_of_G(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """A square G whose determinant is below 1e-8 is singular, and is replaced by zero."""
    if G.shape[0] == G.shape[1] and abs(np.linalg.det(G)) < 1e-8:
        G = np.zeros_like(G)
    return reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken(
    "all records: the last determined sample is missing",
    restores(
        Faulty(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[1.0], [2.0]]), PLAIN.v, np.zeros(0), PLAIN.v * [[1.0, 2.0]])
    ),
)
def leaves_the_last_samples_zero(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The last n + 1 samples are left zero, though without a delay they are determined; so is one without any state."""
    v = reference.reconstruct(r, A, F, C, G, x0).copy()
    v[len(v) - len(A) - 1 :] = 0.0
    return v


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


@SIGNAL.broken("all signals, by about the accuracy of float32", restores(TWO))
def stores_the_signal_in_single_precision(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The signal is kept as float32."""
    return reference.reconstruct(r, A, F, C, G, x0).astype(np.float32)


@SIGNAL.broken("more than six states", restores(N8, 1e-6))
def truncates_high_orders(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """States beyond the six largest poles are left out of the simulation that is inverted."""
    poles, V = np.linalg.eig(A)
    if len(A) <= 6:
        return reference.reconstruct(r, A, F, C, G, x0)
    small = np.argsort(-np.abs(poles))[6:]
    cut = poles.copy()
    cut[small] = 0.0
    return reference.reconstruct(r, np.real(V @ np.diag(cut) @ np.linalg.inv(V)), F, C, G, x0)


@SIGNAL.broken("zeros outside the unit circle", restores(OUTSIDE, 1e-6, hidden=60))
def reflects_zeros_outside(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Where a zero is outside the unit circle the signal is passed through the all-pass that reflects it."""
    from faultspace.numeric.method.signal.pair_zeros import finite_zeros

    v = reference.reconstruct(r, A, F, C, G, x0).copy()
    for q in finite_zeros(A, F, C, G):
        if abs(q) > 1 + 1e-9 and abs(q.imag) < 1e-9:
            before = np.vstack([np.zeros((1, v.shape[1])), v[:-1]])
            v = (v - before / q.real) if abs(q) > 1 else v
    return v


@SIGNAL.broken(
    "faults of which one is a filtered other: not left-invertible",
    refuses(PLAIN.r, PLAIN.A, np.hstack([PLAIN.F, 2 * PLAIN.F]), PLAIN.C, np.hstack([PLAIN.G, 2 * PLAIN.G]), PLAIN.x0),
)
def returns_the_smallest_of_many_signals(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Where r does not determine v the least-norm one is returned."""
    from faultspace.numeric.method.signal.reconstruction import reconstruct_fault

    return reconstruct_fault(r, A, F, C, G, x0=x0).v


@SIGNAL.broken("more faults than outputs", refuses(TWO.r[:, :1], TWO.A, TWO.F, TWO.C[:1], TWO.G[:1], TWO.x0))
def answers_for_more_faults_than_outputs(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The pseudoinverse of G answers for wide systems, too."""
    return inverse(r, A, F, C, G, x0) if G.shape[1] > G.shape[0] else reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken("an initial state of another length", refuses(TWO.r, TWO.A, TWO.F, TWO.C, TWO.G, TWO.x0[:1]))
def fills_up_the_initial_state(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """An x0 that is too short is continued by zeros."""
    return reference.reconstruct(r, A, F, C, G, np.concatenate([x0, np.zeros(len(A))])[: len(A)])


@SIGNAL.broken("an initial state with a NaN", refuses(TWO.r, TWO.A, TWO.F, TWO.C, TWO.G, np.array([1.0, np.nan])))
def starts_from_rest_where_x0_is_NaN(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """An unknown x0 is zero."""
    return reference.reconstruct(r, A, F, C, G, np.nan_to_num(x0))


@SIGNAL.broken("a residual with a NaN", refuses(np.where(np.arange(120)[:, None] == 50, np.nan, TWO.r), TWO.A, TWO.F, TWO.C, TWO.G, TWO.x0))
def interpolates_gaps(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """NaN is replaced by a line between its neighbours."""
    r = r.copy()
    for column in r.T:
        good = np.isfinite(column)
        column[:] = np.interp(np.arange(len(column)), np.flatnonzero(good), column[good])
    return reference.reconstruct(r, A, F, C, G, x0)
