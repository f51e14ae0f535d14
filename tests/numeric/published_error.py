"""This computes the error of the study as it was published; the product takes it from the containment error.

author_error   |angles| / (n_v pi/2), containment only
"""

from __future__ import annotations

import numpy as np

from faultspace.numeric.method.space.distances import principal_angles


def author_error(truth: object, estimate: object) -> float:
    """Return the error as published: the 2-norm of the angles between the true [F; G] (d, n_v) and the estimate over n_v pi/2.

    Two doubts come with it: the angles cannot exceed sqrt(n_v) pi/2 in norm, so that for n_v > 1 the error never reaches one; and an
    estimate that is the whole space scores zero. `containment_error` mends the first, `two_sided_error` both. Source: [G25] section V.
    """
    return float(np.linalg.norm(principal_angles(truth, estimate)) / (np.atleast_2d(np.asarray(truth)).shape[1] * np.pi / 2))
