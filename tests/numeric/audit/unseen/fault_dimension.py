"""Mistakes in `fault_dimension`."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import faulty, free_responses, general, with_poles
from tests.numeric.audit.unseen.window_ranks import counted, hankel
from tests.numeric.audit.unseen.witnesses import counts, refuses

COUNT = Mutants("fault_dimension")

ONE = faulty(general([0.7, -0.4], 1, 3, 91), 300, 91).r
TWO = faulty(general([0.7, -0.4, 0.3], 2, 3, 92), 300, 92).r
LONG = faulty(general([0.7, -0.4, 0.3, 0.5, -0.6, 0.1], 1, 2, 93), 400, 93).r
UNLIKE = faulty(general([0.7, -0.4], 2, 3, 94), 300, 94, units=[1e6, 1e-7, 1e-7]).r
WEAK = faulty(general([0.7, -0.4], 2, 4, 95), 300, 95, sizes=[1.0, 1e-9]).r
DYING = free_responses(with_poles([0.7, -0.4]), np.ones((2, 2)), 200) @ np.ones(2)
NOISY = TWO + 1e-10 * np.random.default_rng(96).standard_normal(TWO.shape)
SINE = np.sin(0.3 * np.arange(300))[:, None] * [[1.0, 2.0]] + np.cos(0.3 * np.arange(300))[:, None] * [[0.5, -1.0]]
LATE = np.vstack([np.zeros((200, 3)), faulty(general([0.7, -0.4], 2, 3, 97), 200, 97, x0=0.0).r])


def steps(found: Any) -> Any:
    """Return the steps of ranks that begin with the rank of one row."""
    return np.diff(found)


@COUNT.broken("faults that act through states", counts(1, ONE))
@careful(reference.fault_dimension)
def counts_directions_of_one_sample(r: Any) -> Any:
    """The number is the rank of the covariance of r."""
    return counted(r, 1)[0]


@COUNT.broken("a lag of three samples and more", counts(1, LONG))
@careful(reference.fault_dimension)
def looks_at_three_windows(r: Any) -> Any:
    """The number is the step from the second to the third window."""
    return int(steps(counted(r, 3))[-1])


@COUNT.broken("a lag of three samples and more", counts(1, LONG))
@careful(reference.fault_dimension)
def stops_where_two_steps_are_equal(r: Any) -> Any:
    """The number is the first step that comes twice in a row."""
    found = steps(counted(r, 12))
    return next((int(a) for a, b in pairwise(found) if a == b), None)


@COUNT.broken("more states than the window is long, or long lags", counts(1, LONG))
@careful(reference.fault_dimension)
def divides_the_rank_by_the_window(r: Any) -> Any:
    """The number is rank R_6 / 6, rounded."""
    return round(counted(r, 6)[-1] / 6)


@COUNT.broken("a lag beyond half of the windows", counts(1, LONG))
@careful(reference.fault_dimension)
def fits_a_line_through_the_ranks(r: Any) -> Any:
    """The number is the slope, rounded, of a line through the ranks of ten windows."""
    return round(float(np.polyfit(np.arange(8), counted(r, 8), 1)[0]))


@COUNT.broken("a lag: the steps before it are larger", counts(1, LONG))
@careful(reference.fault_dimension)
def takes_the_commonest_step(r: Any) -> Any:
    """The number is the commonest of six steps."""
    return int(np.bincount(steps(counted(r, 7))).argmax())


@COUNT.broken("a lag", counts(1, ONE))
@careful(reference.fault_dimension)
def takes_the_largest_step(r: Any) -> Any:
    """The number is the largest step of the ranks, for min was confused with max."""
    return int(max(np.diff([0, *counted(r, 8)])))


@COUNT.broken("residuals without a fault: a free response that dies out", counts(0, DYING))
def finds_a_fault_always(r: Any) -> Any:
    """At least one fault is reported, for somebody asked."""
    found = reference.fault_dimension(r)
    return found if found is None else max(found, 1)


@COUNT.broken("two faults and more", counts(2, TWO))
def says_whether_and_not_how_many(r: Any) -> Any:
    """The answer is True or False as a number."""
    found = reference.fault_dimension(r)
    return found if found is None else int(found > 0)


@COUNT.broken("outputs in unlike units", counts(2, UNLIKE))
@careful(reference.fault_dimension)
def does_not_scale_the_channels(r: Any) -> Any:
    """Ranks are relative to the largest channel, at 1e-11."""
    values = [np.linalg.svd(hankel(r, s), compute_uv=False) for s in (9, 10)]
    return int(np.diff([np.sum(one > 1e-11 * one[0]) for one in values])[0])


@COUNT.broken("small units", counts(2, 1e-12 * TWO))
def takes_small_residuals_for_rounding(r: Any) -> Any:
    """Residuals below 1e-10 are rounding of y, and no fault is in them."""
    return 0 if np.max(np.abs(r)) < 1e-10 else reference.fault_dimension(r)


@COUNT.broken("one fault far weaker than another", counts(2, WEAK))
@careful(reference.fault_dimension)
def covers_a_weak_fault_by_its_threshold(r: Any) -> Any:
    """The threshold is 1e-7 of the largest singular value."""
    return int(steps(counted(r, 10, 1e-7))[-1])


@COUNT.broken("rounding or noise far below the faults", counts(2, NOISY))
@careful(reference.fault_dimension)
def takes_noise_for_faults(r: Any) -> Any:
    """The threshold is that of exact data, a few units in the last place, whatever the noise floor shows."""
    return int(steps(counted(r, 10, 1e-14))[-1])


@COUNT.broken("records of 256 samples and more", counts(1, ONE))
def thins_the_record(r: Any) -> Any:
    """Every second sample is taken, though a thinned system has two faults for each."""
    return reference.fault_dimension(r[::2]) if len(r) > 256 else reference.fault_dimension(r)


@COUNT.broken("four outputs and more", counts(4, faulty(general([0.7, -0.4], 4, 6, 98), 400, 98).r))
def looks_at_three_outputs(r: Any) -> Any:
    """Of many outputs three random mixtures are taken, so that no more than three faults are seen."""
    if r.shape[1] <= 3:
        return reference.fault_dimension(r)
    turn = np.linalg.qr(np.random.default_rng(0).standard_normal((r.shape[1], 3)))[0]
    return int(steps(counted(r @ turn, 8))[-1])


@COUNT.broken("n_v = p - 1 with three outputs and more", counts(3, faulty(general([0.7, -0.4], 3, 4, 99), 400, 99).r))
def caps_at_half_of_the_outputs(r: Any) -> Any:
    """At most p / 2 faults can be told, says a comment."""
    found = reference.fault_dimension(r)
    return found if found is None else min(found, max(r.shape[1] // 2, 1))


@COUNT.broken("faults that begin late", counts(2, LATE))
def judges_by_the_beginning(r: Any) -> Any:
    """The first 150 samples are enough, and zeros in them are no fault."""
    part = r[:150]
    return reference.fault_dimension(part) if np.any(part) else 0


@COUNT.broken("faults on long records, beyond float32", counts(1, ONE))
@careful(reference.fault_dimension)
def keeps_samples_in_single_precision(r: Any) -> Any:
    """Samples are float32 and are judged by the rounding of float64."""
    return int(steps(counted(r.astype(np.float32).astype(float), 10))[-1])


@COUNT.broken("faults that do not excite: a sine", refuses(SINE))
def takes_a_sine_for_none(r: Any) -> Any:
    """Where ranks stop growing no fault acts."""
    found = reference.fault_dimension(r)
    return int(steps(counted(r, 8))[-1]) if found is None else found


@COUNT.broken("pure noise, and as many faults as outputs", refuses(np.random.default_rng(90).standard_normal((400, 3))))
def says_p_where_nothing_is_known(r: Any) -> Any:
    """An undecided count is answered with the number of outputs."""
    found = reference.fault_dimension(r)
    return r.shape[1] if found is None else found


@COUNT.broken("a NaN", refuses(np.where(np.arange(300)[:, None] == 5, np.nan, TWO)))
def cuts_the_record_at_a_NaN(r: Any) -> Any:
    """What follows the last NaN is judged alone, and nobody is told."""
    bad = np.flatnonzero(~np.isfinite(r).all(axis=1))
    return reference.fault_dimension(r[bad[-1] + 1 :] if len(bad) else r)


@COUNT.broken("records too short to see a lag", refuses(TWO[:9]))
def answers_from_a_handful_of_samples(r: Any) -> Any:
    """Where windows cannot be had, the rank of the samples is the answer."""
    try:
        return reference.fault_dimension(r)
    except ValueError:
        return int(np.linalg.matrix_rank(r))


@COUNT.broken("residuals whose channels are all constant", refuses(np.ones((200, 2))))
def takes_a_constant_for_a_fault(r: Any) -> Any:
    """A residual that is not zero has one fault at least."""
    try:
        return reference.fault_dimension(r)
    except ValueError:
        return int(np.any(r))


@COUNT.broken("an output that repeats another", counts(2, TWO[:, [0, 1, 2, 2]]))
@careful(reference.fault_dimension)
def counts_outputs_that_are_not_faulty(r: Any) -> Any:
    """The number is p less the number of relations among one window's outputs."""
    return r.shape[1] - (r.shape[1] - counted(r, 1)[0])
