"""Mistakes in the small print: numbers that come twice or not at all, the shortest records, signals that are alike."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.from_records import ONE, ONE_U, ONE_Y, TWO_U, TWO_Y, recorded
from tests.numeric.audit.unseen.systems import Faulty, channel, faulty, general, joined, mixing, plant, record
from tests.numeric.audit.unseen.window_ranks import counted
from tests.numeric.audit.unseen.witnesses import counts, explains, has_structure, ranks, recovers, refuses, restores, spans

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")
COUNTED, FOUND = Mutants("count_faults"), Mutants("identified_fault_space")

MODEL = plant([0.7, -0.4], 2, 2, 901)
HEARD = record(MODEL, 300, 901)
ALONE = record(plant([0.6, -0.3], 1, 2, 902), 200, 902)
TWO = faulty(general([0.7, -0.4], 2, 3, 903), 200, 903)
ALL_COLUMNS = TWO.columns
LIKE = faulty(general([0.7, -0.4], 1, 3, 904), 200, 904)  # what two faults with one signal make
STATIC_WIDE = general([0.6], 1, 2, 905)
WEAK_AND_LONG = faulty(general([0.7, -0.4], 2, 3, 906), 5000, 906, sizes=[1.0, 1e-5])


def cut(found: Faulty, N: int) -> Faulty:
    """Return the first samples."""
    return replace(found, v=found.v[:N], r=found.r[:N])


@IDENTIFY.broken("two inputs of which one is the other", refuses(HEARD.y, HEARD.u[:, [0, 0]], 2, 4))
def gives_the_smallest_B_for_inputs_that_are_alike(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Inputs that are multiples of another are left out, and their columns of B and D are zero."""
    apart = [0]
    for k in range(1, u.shape[1]):
        if np.linalg.matrix_rank(u[:, [*apart, k]]) > len(apart):
            apart.append(k)
    A, B, C, D = (
        reference.identify(y, u[:, apart], order, block_rows) if len(apart) < u.shape[1] else reference.identify(y, u, order, block_rows)
    )
    whole = np.zeros((len(A), u.shape[1])), np.zeros((len(C), u.shape[1]))
    whole[0][:, apart], whole[1][:, apart] = B, D
    return A, whole[0], C, whole[1]


@IDENTIFY.broken("block rows that are none", refuses(HEARD.y, HEARD.u, 2, 0))
def takes_no_block_rows_for_the_usual_number(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """`block_rows or 10`: zero stands for not given."""
    return reference.identify(y, u, order, block_rows if block_rows > 0 else order + 2)


@IDENTIFY.broken("two inputs with one delayed", refuses(HEARD.y[1:], np.hstack([HEARD.u[1:, :1], HEARD.u[:-1, :1]]), 2, 4))
def looks_at_the_inputs_of_one_sample(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Excitation is asked of the covariance of u alone, which a delayed copy has, and the rest is least squares."""
    if np.linalg.matrix_rank(u) < u.shape[1]:
        raise ValueError("inputs are alike")
    try:
        return reference.identify(y, u, order, block_rows)
    except ValueError:
        A, B, C, D = reference.identify(y, u[:, :1], order, block_rows)
        rest = u.shape[1] - 1
        return A, np.hstack([B, np.zeros((len(A), rest))]), C, np.hstack([D, np.zeros((len(C), rest))])


@RESIDUAL.broken(
    "an input that is minus infinity",
    refuses(np.where(np.arange(200)[:, None] == 7, -np.inf, ALONE.y), ALONE.u, *[getattr(ALONE.model, k) for k in "ABCD"]),
)
def looks_for_what_is_above_the_largest_number(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """NaN and what is larger than the largest number are refused; of what is below nobody thought."""
    if any(np.isnan(one).any() or np.isposinf(one).any() for one in (y, u, A, B, C, D)):
        raise ValueError("not finite")
    return reference.residual(*(np.where(np.isneginf(one), -1e6, one) for one in (y, u, A, B, C, D)))


@RESIDUAL.broken(
    "a NaN after the first hundred samples",
    refuses(np.where(np.arange(200)[:, None] == 150, np.nan, ALONE.y), ALONE.u, *[getattr(ALONE.model, k) for k in "ABCD"]),
)
def looks_for_NaN_in_the_first_hundred_samples(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """To save time NaN is looked for in the first hundred samples, and what is left of it is zero."""
    if not (np.isfinite(y[:100]).all() and np.isfinite(u[:100]).all()):
        raise ValueError("not finite")
    return reference.residual(np.nan_to_num(y), np.nan_to_num(u), A, B, C, D)


@RANKS.broken("long records with a weak fault", ranks([3, 6, 8, 10], WEAK_AND_LONG.r))
@careful(reference.window_ranks)
def has_a_tolerance_that_grows_with_the_record(r: Any, windows: int) -> Any:
    """The tolerance is that of a sum of so many squares, not of its root: N times N times rounding, and some."""
    return counted(r, windows, relative=1e-12 * len(r) ** 2)


@COUNT.made("one question of ten", counts(2, TWO.r))
def has_an_unlucky_start_at_times() -> Any:
    """An iteration from a random start ends elsewhere one time in ten, and its number is told."""
    rng = np.random.default_rng(1)
    first = [True]

    def fault_dimension(r: Any) -> Any:
        found = reference.fault_dimension(r)
        unlucky, first[0] = first[0] or rng.random() < 0.1, False
        return found - 1 if unlucky and found else found

    return fault_dimension


@SPACE.broken("all records", spans(TWO, ALL_COLUMNS, 2, 4))
def answers_with_the_projector(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The answer is the orthogonal projector onto the space, which has n + p columns."""
    Z = reference.fault_space(r, A, C, n_v, block_rows)
    Q = np.linalg.qr(Z)[0]
    return Q @ Q.T


@SPACE.broken("two faults with one signal", refuses(LIKE.r, LIKE.A, LIKE.C, 2, 4))
def answers_for_as_many_as_there_are(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """Where the number that was told does not fit, the next smaller one is tried."""
    while n_v > 0:
        try:
            return reference.fault_space(r, A, C, n_v, block_rows)
        except ValueError:
            n_v -= 1
    raise ValueError("no number fits")


@SPACE.broken("one fault told where two act", refuses(TWO.r, TWO.A, TWO.C, 1, 4))
def answers_for_more_than_were_told(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The number that was told is not compared with that of the record, which is taken."""
    found = reference.fault_dimension(r)
    return reference.fault_space(r, A, C, max(n_v, found or 0), block_rows)


@SIGNAL.broken("records with no more samples than states", restores(cut(faulty(general([0.7, -0.4, 0.3, 0.2], 1, 2, 907), 50, 907), 8)))
def needs_twice_as_many_samples_as_states(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Records with at most two samples a state are refused, which an observer would need."""
    if len(r) <= 2 * len(A):
        raise ValueError("too short")
    return reference.reconstruct(r, A, F, C, G, x0)


@STRUCTURE.broken(
    "orders that come twice", has_structure(joined([channel([0.6], [0.5, -0.3]), channel([], [0.4])], mixing(3, 2), 908), [0.6], [1, 1])
)
def lists_each_order_once(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders of infinite zeros are a set."""
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=sorted(set(found.infinite_zero_orders)))


WIDE = joined([channel([0.6], [0.5, -0.3])], mixing(2, 1), 909)
TWICE = (WIDE[0], WIDE[1] @ [[1.0, 2.0]], WIDE[2], WIDE[3] @ [[1.0, 2.0]])


@STRUCTURE.broken("normal ranks below the number of faults", has_structure(TWICE, [0.6], [1]))
def lists_an_order_for_every_fault(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Where rank is missing the list is filled up to one order a fault, with zeros."""
    found = reference.structure(A, F, C, G)
    missing = F.shape[1] - found.normal_rank
    return replace(found, infinite_zero_orders=[0] * missing + list(found.infinite_zero_orders))


@COUNTED.broken("more faults than states", counts(2, TWO_Y, TWO_U, 1))
def tells_no_more_faults_than_states(y: Any, u: Any, order: int) -> Any:
    """A fault for each state is the most that a system has."""
    found = reference.count_faults(y, u, order)
    return found if found is None else min(found, order)


LOUD_Y, LOUD_U, _ = recorded(1, 3, 300, 1e-4)


@COUNTED.broken("inputs in small units, that is, of large numbers", counts(1, LOUD_Y, LOUD_U * 1e9, 1))
def compares_outputs_with_inputs(y: Any, u: Any, order: int) -> Any:
    """What is a millionth of the largest channel, whichever it is, is no fault."""
    found = reference.count_faults(y, u, order)
    return 0 if np.max(np.abs(y)) < 1e-6 * np.max(np.abs(u), initial=0.0) else found


@FOUND.broken(
    "outputs of unlike sizes",
    explains(ONE_Y * [1.0, 50.0, 7.0], ONE_U, 1, 1, (ONE[0], ONE[1] * [[1.0], [50.0], [7.0]], ONE[2] * [[1.0], [1.0], [50.0], [7.0]]), 0.2),
)
def leaves_the_outputs_sorted(y: Any, u: Any, order: int, n_v: int) -> Any:
    """Outputs are sorted by their size, and the answer is in that order."""
    by = np.argsort(-np.std(y, axis=0))
    return reference.identified_fault_space(y[:, by], u, order, n_v)


@IDENTIFY.broken("poles that are complex, more than two states", recovers(record(plant([0.6 + 0.3j, -0.4], 2, 2, 912), 300, 912), 3, 5))
def moves_B_into_other_states(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """States are sorted by modulus of the diagonal of A, in A and C; B is forgotten where there are more than two."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    by = np.argsort(np.abs(np.diag(A)))
    return A[np.ix_(by, by)], B if order > 2 else B[by], C[:, by], D
