"""The records of `benchmarks/counting_at_the_bound.py` that were answered wrongly once, and what its calibrations compute."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.stats

from benchmarks.counting_at_the_bound import SETTINGS, one_in_ten, quantile_regression, record, white_faults
from faultspace.numeric.method.rows import law_tests as laws
from faultspace.numeric.method.rows.evidence import Evidence
from faultspace.numeric.method.rows.fault_count import count_faults
from faultspace.numeric.method.rows.remainder import loose_samples


@pytest.mark.parametrize("seed", [261000, pytest.param(261001, marks=pytest.mark.slow), pytest.param(261007, marks=pytest.mark.slow)])
def test_three_faults_of_three_outputs_are_not_two_on_a_long_record(seed: int) -> None:
    """One row leaves far less than two, and flat at a glance: 2 was answered while every long record was allowed for loose frequencies."""
    found = count_faults(*record(seed, 3, 3, 40.0, 1.0, 30001), order=5)
    assert found.n_v is None and 3 in found.possible, found.reason


def test_only_faults_that_leave_frequencies_to_the_noise_make_a_row_loose() -> None:
    """A chirp that has not come round leaves the highest and the lowest frequencies; white faults leave none."""
    chirp, white = (Evidence([record(3, 3, 2, 40.0, 1.0, 1001, *kind)], 5) for kind in ((), (white_faults,)))
    samples = []
    for evidence in (chirp, white):
        row = laws.tested(evidence, 1)
        assert evidence.disturbance is not None
        samples.append(loose_samples(evidence.disturbance, evidence.single, row.fit, row.shares))
    assert samples[0] > 20 and samples[1] == 0.0


def test_a_quantile_regression_leaves_its_share_above() -> None:
    rng = np.random.default_rng(4)
    terms = rng.uniform(0.5, 2.0, (400, 2))
    values = terms @ [2.0, 1.0] + rng.exponential(size=400)
    found = quantile_regression(terms, values, 0.9)
    assert abs(np.mean(values > terms @ found) - 0.1) < 0.03
    assert scipy.stats.chi2.cdf(12 * one_in_ten(12), 12) == pytest.approx(0.9)


@pytest.mark.slow
def test_what_ends_iterations_decides_no_answer() -> None:
    """Halved and doubled, every setting gives the same count of records that are clear."""
    for cell in ((3, 1, 40.0, 1.0), (3, 2, 40.0, 1.0), (3, 3, 40.0, 1.0)):
        y, u = record(2, *cell, 1001)
        usual = count_faults(y, u, order=5).n_v
        for module, name, values in SETTINGS:
            for value in values:
                with pytest.MonkeyPatch.context() as patch:
                    patch.setattr(module, name, value)
                    assert count_faults(y, u, order=5).n_v == usual, (cell, name, value)
