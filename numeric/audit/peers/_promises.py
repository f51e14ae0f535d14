"""Which checks ask for what a package says that it does not do: they are asked, and counted apart.

Each function gives patterns SLUG/VECTOR -> reason for an adapter's NOT_PROMISED. They are made of the default vectors; those of another
seed bear the same names, and are of the same kinds.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

import numpy as np

from faultspace.exact.system.systems import ResidualSystem

from ..checks.catalogue import all_checks
from ..checks.refusals import same_output_twice
from ..records import Demand
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import IdentificationVector, shipped
from ..vectors.trouble import default_troubles

NO_NUMBERS = ("refuses-nan-output", "refuses-nan-input", "refuses-infinity")  # whose refusal no promise is needed for
OVER = 1e-10  # what is left of an impulse response that is over: less than the bounds of the checks


def with_feedthrough(reason: str) -> dict[str, str]:
    """Return the checks of `identify` where D is not zero."""
    return _asked_of("identify", [name for name, model in _models().items() if floats(model.D).any()], reason)


def more_block_rows_than_states(reason: str) -> dict[str, str]:
    """Return the checks of `identify` where the order is not below the number of block rows."""
    return _asked_of("identify", [name for name, model in _models().items() if model.order >= model.block_rows], reason)


def coloured() -> dict[str, str]:
    """Return the checks of `identify` under a coloured fault, for a package that says nothing of one."""
    reason = "no document of the package promises consistency under a disturbance that is not white"
    return _asked_of("identify", [vector.slug for vector in shipped("consistency")], reason)


def from_a_state(reason: str) -> dict[str, str]:
    """Return the checks of `identify` where x0 is not zero."""
    return _asked_of("identify", [name for name, model in _models().items() if floats(model.x0).any()], reason)


def not_over(taken: Callable[[int, int, int], int], reason: str) -> dict[str, str]:
    """Return the checks of `identify` where more than OVER is left after taken(samples, inputs, order) samples."""

    def lasts(model: IdentificationVector) -> bool:
        radius = float(np.abs(np.linalg.eigvals(floats(model.A))).max(initial=0.0))
        return radius ** taken(model.u.nrows, model.u.ncols, model.order) > OVER

    return _asked_of("identify", [name for name, model in _models().items() if lasts(model)], reason)


def not_square(reason: str) -> dict[str, str]:
    """Return the checks of `structure` where there are not as many outputs as inputs."""
    return _asked_of("structure", [name for name, system in _systems().items() if system.p != system.m], reason)


def _models() -> dict[str, IdentificationVector]:
    troubled = {trouble.kind: trouble.model for trouble in default_troubles() if trouble.model}
    return {vector.slug: vector for vector in (*shipped("identification"), same_output_twice())} | troubled


def _systems() -> dict[str, ResidualSystem]:
    troubled = {trouble.kind: trouble.structure for trouble in default_troubles() if trouble.structure}
    return {name: vector.system for name, vector in ({vector.slug: vector for vector in shipped("structure")} | troubled).items()}


def _asked_of(function: str, vectors: Collection[str], reason: str) -> dict[str, str]:
    return {
        f"{check.slug}/{check.vector}": reason
        for check in all_checks()
        if check.function == function and check.kind == Demand.MUST_HOLD and check.vector in vectors and check.slug not in NO_NUMBERS
    }
