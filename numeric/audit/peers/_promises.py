"""Which checks ask for what a package says that it does not do: they are asked, and counted apart.

models      the plants of the checks of `identify`, by the names of their vectors
systems     the systems of the checks of `structure`, by the names of their vectors
asked_of    the checks of a function on these vectors, as patterns for NOT_PROMISED
"""

from __future__ import annotations

from collections.abc import Collection

from faultspace.exact.system.systems import ResidualSystem

from ..checks.catalogue import all_checks
from ..records import Demand
from ..vectors.shipped_vectors import IdentificationVector, shipped
from ..vectors.trouble import default_troubles


def models() -> dict[str, IdentificationVector]:
    """Return the plants of the default set; those of another seed bear the same names, and are of the same kinds."""
    troubled = {trouble.kind: trouble.model for trouble in default_troubles() if trouble.model}
    return {vector.slug: vector for vector in shipped("identification")} | troubled


def systems() -> dict[str, ResidualSystem]:
    """Return the systems of the default set; as for the plants, another seed has others of the same kinds."""
    troubled = {trouble.kind: trouble.structure for trouble in default_troubles() if trouble.structure}
    return {name: vector.system for name, vector in ({vector.slug: vector for vector in shipped("structure")} | troubled).items()}


def asked_of(function: str, vectors: Collection[str], reason: str) -> dict[str, str]:
    """Return SLUG/VECTOR -> reason for the checks of this function on these vectors that have an answer."""
    asked = (check for check in all_checks() if check.function == function and check.kind == Demand.MUST_HOLD and check.vector in vectors)
    return {f"{check.slug}/{check.vector}": reason for check in asked}
