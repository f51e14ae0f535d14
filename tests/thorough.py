"""This says how much is tried by tests that draw or enumerate: a part; all of it where FAULTSPACE_THOROUGH is set, as in the monthly run.

THOROUGH    whether all of it is tried
examples    how many examples Hypothesis draws
every       one in how many of an enumeration is tried
sampled     things broken on purpose, of which the default run tries a few

The default run tries a third, and of drawn examples at least twenty: what one draw in seven shows is missed by twenty of them with the
probability (6/7)^20 = 0.046, what one in twenty shows by sixty with (19/20)^60 = 0.046. Whoever changes an algorithm runs its tests with
FAULTSPACE_THOROUGH=1, for examples are the same in every run of the same tests.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import pytest

THOROUGH = bool(os.environ.get("FAULTSPACE_THOROUGH"))
PART, LEAST = 3, 20


def examples(count: int) -> int:
    """Return how many examples to draw where `count` are drawn in a thorough run."""
    return count if THOROUGH else min(count, max(LEAST, count // PART))


def every(step: int = 1) -> int:
    """Return the step through an enumeration of which a thorough run tries one in `step`."""
    return step if THOROUGH else PART * step


def sampled(names: Iterable[str], step: int) -> list[Any]:
    """Return parameters of which one in `step` belongs to the default run, and the others are marked `mutants`."""
    return [name if k % step == 0 else pytest.param(name, marks=pytest.mark.mutants) for k, name in enumerate(names)]
