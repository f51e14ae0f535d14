"""The estimators that `identify` calls under noise, before the audit's checks, whose answers are known exactly.

Reduction    `arx_reduction` as an implementation; the window that the checks prescribe is PI-MOESP's, and it takes none
"""

from __future__ import annotations

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.arrays import Array
from faultspace.numeric import arx_reduction, count_faults, fault_space_by_rows
from faultspace.numeric.audit.running import ExpectedFailure
from faultspace.numeric.audit.vectors.rationals import floats
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from faultspace.numeric.audit.vectors.trouble import default_troubles
from faultspace.numeric.method.space.distances import two_sided_error
from faultspace.numeric.study.random_systems import N_V, study_system
from faultspace.numeric.study.runs import study_run

# Twenty lags of forty samples would be as many coefficients as numbers.
OTHERWISE = (ExpectedFailure("split-data[n2-u3-p1]", "40 samples do not carry the two lags of order 2 with four windows a regressor"),)
QUICK = ("exact-recovery", "consistent-under-coloured-fault", "refuses-unexciting-input")


class Reduction:
    """A, B, C, D by reduction."""

    def identify(self, y: Array, u: Array, order: int, block_rows: int) -> tuple[Array, Array, Array, Array]:
        model = arx_reduction(y, u, order=order).model
        return model.A, model.B, model.C, model.D


def beyond_the_reduction() -> tuple[ExpectedFailure, ...]:
    """Return the checks of models that no reduction has: it fits a stable transfer function, which has no mode that inputs miss."""
    expected = []
    for trouble in default_troubles():
        if trouble.model and trouble.model.asked("poles"):
            A, B = floats(trouble.model.A), floats(trouble.model.B)
            reached = np.linalg.matrix_rank(np.hstack([np.linalg.matrix_power(A, power) @ B for power in range(len(A))]))
            # A pole at one is stable to rounding, and comes back.
            if np.abs(np.linalg.eigvals(A)).max() > 1 + 1e-6:
                expected.append(ExpectedFailure(f"exact-recovery[{trouble.kind}]", "the models of a reduction are stable"))
            elif reached < len(A):
                reason = "the transfer function does not have a mode that inputs miss"
                expected.append(ExpectedFailure(f"exact-recovery[{trouble.kind}]", reason))
    return tuple(expected)


@pytest.mark.parametrize("only", [QUICK, pytest.param((), marks=pytest.mark.slow)], ids=["quick", "all"])
def test_the_reduction_is_exact_where_the_records_are(only: tuple[str, ...]) -> None:
    beyond = beyond_the_reduction()
    found = fs.audit(Reduction(), only=only, expected=beyond if only else beyond + OTHERWISE)
    assert len(found) > 15 and len(beyond) == 5 and not found.failed, [one.name for one in found.failed]


def test_a_reduction_that_is_off_is_seen() -> None:
    class Off(Reduction):
        def identify(self, y: Array, u: Array, order: int, block_rows: int) -> tuple[Array, Array, Array, Array]:
            A, B, C, D = super().identify(y, u, order, block_rows)
            return A, B * (1 + 1e-4), C, D

    assert fs.audit(Off(), only=["exact-recovery[n2-u2-p3]"]).failed


@pytest.mark.parametrize("vector", shipped("consistency"), ids=lambda vector: vector.slug)
def test_the_faults_of_exact_records_are_counted(vector: object) -> None:
    y, u = vector.record()  # type: ignore[attr-defined]
    system = vector.system.residual  # type: ignore[attr-defined]
    # One fault in one output is noise of its colour to everybody.
    assert count_faults(y, u, order=system.n).possible == ((system.m,) if system.m < system.p else (0, 1))


@pytest.mark.parametrize("zeros", [1, 3])
def test_the_fault_space_of_a_record_without_noise_has_every_zero(zeros: int) -> None:
    """A and C true: the laws of the record are exact, and so is the space."""
    system = study_system(zeros, np.random.SeedSequence(41))
    run = study_run(system, 41, level=0.0, samples=600)
    found = fault_space_by_rows(run.y, run.u, system.model.A, system.model.C, n_v=N_V)
    assert found.decided and found.n_z == N_V + zeros, found.reason
    assert two_sided_error(system.Z, found.basis) < 1e-3
