"""All kinds of trouble for a seed.

troubles     the default set as it comes with the package, any other drawn and computed now
"""

from __future__ import annotations

from functools import cache

from ..vectors.trouble import SEED, Trouble, default_troubles
from .kinds_of_trouble import KINDS
from .trouble_vectors import made


@cache
def troubles(seed: int) -> tuple[Trouble, ...]:
    """Return the vectors of every kind. Another seed than the default takes five seconds of computing."""
    return default_troubles() if seed == SEED else drawn_troubles(seed)


def drawn_troubles(seed: int) -> tuple[Trouble, ...]:
    """Return the vectors computed now, whatever the seed."""
    return tuple(made(kind, seed) for kind in KINDS)
