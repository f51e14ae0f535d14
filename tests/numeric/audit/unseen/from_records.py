"""Mistakes in `count_faults` and in `identified_fault_space`, which ask from a record of outputs and inputs."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants, Witness
from tests.numeric.audit.unseen.systems import general
from tests.numeric.audit.unseen.witnesses import counts, explains, refuses

COUNT = Mutants("count_faults")
FOUND = Mutants("identified_fault_space")
Answer = tuple[Any, Any, Any] | None


def recorded(m: int, p: int, N: int, noise: float, *, unit: float = 1.0) -> tuple[Any, Any, tuple[Any, Any, Any]]:
    """Return y, u and A, C, [F; G] of a system with one state, m faults a tenth of the input in size, and white noise in the outputs."""
    rng = np.random.default_rng(5)
    A, F, C, G = general([0.6], max(m, 1), p, 400)
    B, D = rng.standard_normal((1, 1)), rng.standard_normal((p, 1))
    u, v = rng.standard_normal((N, 1)), (0.1 if m else 0.0) * rng.standard_normal((N, max(m, 1)))
    y = StateSpaceModel(A, np.hstack([B, F]), C, np.hstack([D, G])).simulate(np.hstack([u, v]), np.ones(1))
    return unit * (y + noise * rng.standard_normal((N, p))), u, (A, unit * C, np.vstack([F, unit * G]))


NONE_Y, NONE_U, _ = recorded(0, 2, 200, 1e-3)
ONE_Y, ONE_U, ONE = recorded(1, 3, 300, 1e-4)
TWO_Y, TWO_U, TWO = recorded(2, 3, 300, 0.0)


def finds(y: Any, u: Any, n_v: int, truth: tuple[Any, Any, Any]) -> Witness:
    """The space is found to a fifth, the sine of twelve degrees."""
    return explains(y, u, 1, n_v, truth, 0.2)


@COUNT.broken("records without a fault", counts(0, NONE_Y, NONE_U, 1))
def finds_a_fault_always(y: Any, u: Any, order: int) -> Any:
    """The count begins at one."""
    found = reference.count_faults(y, u, order)
    return found if found is None else max(found, 1)


@COUNT.broken("two faults and more", counts(2, TWO_Y, TWO_U, 1))
def says_whether_and_not_how_many(y: Any, u: Any, order: int) -> Any:
    """The answer is whether there is a fault."""
    found = reference.count_faults(y, u, order)
    return found if found is None else int(found > 0)


@COUNT.broken("faults as many as half of the outputs and more", counts(2, TWO_Y, TWO_U, 1))
def caps_at_half_of_the_outputs(y: Any, u: Any, order: int) -> Any:
    """No more than p / 2 faults are told."""
    found = reference.count_faults(y, u, order)
    return found if found is None else min(found, y.shape[1] // 2)


@COUNT.broken("small units of the outputs", counts(1, *recorded(1, 3, 300, 1e-4, unit=1e-9)[:2], 1))
def takes_small_outputs_for_no_fault(y: Any, u: Any, order: int) -> Any:
    """Outputs whose deviation is below 1e-6 have no fault."""
    return 0 if np.max(np.std(y, axis=0)) < 1e-6 else reference.count_faults(y, u, order)


@COUNT.broken("records with a transient, or any others", counts(1, *recorded(1, 2, 200, 0.0)[:2], 1))
def counts_as_many_as_outputs_vary(y: Any, u: Any, order: int) -> Any:
    """The number is the rank of what a static gain leaves of the outputs."""
    left = y - u @ np.linalg.lstsq(u, y, rcond=None)[0]
    values = np.linalg.svd(left, compute_uv=False)
    return int(np.sum(values > 1e-6 * values[0]))


@COUNT.broken("y and u of unequal lengths", refuses(TWO_Y, TWO_U[:-9], 1))
def cuts_to_the_shorter(y: Any, u: Any, order: int) -> Any:
    """The longer signal is cut."""
    N = min(len(y), len(u))
    return reference.count_faults(y[:N], u[:N], order)


@FOUND.broken("models whose C is not of that size", explains(ONE_Y, ONE_U, 1, 1, ONE, 0.02))
def returns_columns_in_other_states(y: Any, u: Any, order: int, n_v: int) -> Answer:
    """The model is scaled so that the largest entry of C is a tenth, and the columns stay in the states before."""
    found = reference.identified_fault_space(y, u, order, n_v)
    if found is None:
        return None
    A, C, Z = found
    size = 10 * np.max(np.abs(C), axis=0)
    return A * size[:, None] / size, C / size, Z


@FOUND.broken("all records, faults with a direct part", finds(ONE_Y, ONE_U, 1, ONE))
def has_no_direct_part(y: Any, u: Any, order: int, n_v: int) -> Answer:
    """The columns have g = 0."""
    found = reference.identified_fault_space(y, u, order, n_v)
    return None if found is None else (found[0], found[1], np.vstack([found[2][:order], 0 * found[2][order:]]))


@FOUND.broken("A other than the identity", finds(ONE_Y, ONE_U, 1, ONE))
def lets_the_fault_act_a_sample_late(y: Any, u: Any, order: int, n_v: int) -> Answer:
    """f has become A f."""
    found = reference.identified_fault_space(y, u, order, n_v)
    return None if found is None else (found[0], found[1], np.vstack([found[0] @ found[2][:order], found[2][order:]]))
