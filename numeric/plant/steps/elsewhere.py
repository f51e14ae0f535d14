"""Whether the mean of a residual can be believed where the inputs rest elsewhere than in the samples without fault.

A linear model foretells what a mean of the inputs does up to the errors of its static gain, which the tests of means have in their
variance. So a change of set point is no reason for doubt by itself: the doubt stays where these errors are not known, where the inputs
vary more than before or rest where they have not been, and where the samples without fault show a curved plant.

doubt_of_means    why a mean of the residual need not be that of the samples before, or nothing
"""

from __future__ import annotations

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ...method.space.shift_isolation import gain_errors
from ..doubt.asking import doubts
from ..healthy.unlike_healthy import beyond_healthy_inputs, beyond_healthy_levels
from .findings import Explained

CURVED = "non-linearity"  # the kind of doubt


def doubt_of_means(plant: Explained, until: int, before: Array, u: Array) -> str:
    """Say why the mean of the residual for inputs u (M, n_u) need not be that for `before` (K, n_u), which are of samples before `until`;
    it is empty where nothing speaks for it."""
    driven = beyond_healthy_inputs(before, u, plant.record.inputs)
    if not driven:
        return ""
    if gain_errors(plant.model) is None:
        return driven
    elsewhere = beyond_healthy_levels(before, u, plant.record.inputs)
    if elsewhere:
        return elsewhere
    try:
        raised = doubts(plant.record.beginning(until), plant.model, means_removed=plant.means_removed)
    except (InvalidData, np.linalg.LinAlgError):  # so few samples that nothing can be asked
        return driven
    if CURVED in raised.unasked or any(row.kind == CURVED for row in raised):
        return f"{driven}, for the plant may be curved"
    return ""
