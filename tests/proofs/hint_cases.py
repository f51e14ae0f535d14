"""These are certificates whose hints, or whose rows beside hints, were spoiled: name -> (part of the checker's reason, certificate).

REJECTED_HINTS     well formed, and they prove nothing
MALFORMED_HINTS    not of the format
"""

from __future__ import annotations

from faultspace.exact.system.systems import ResidualSystem
from tests.proofs.examples import EQUAL, GENERIC, GONE, HINTED, INVERTIBLE, SQRT2, Certificate, K, S, hinted, spoiled

LATE = ResidualSystem.of([[0]], [[1]], [[1]], [[0]])  # the fault comes one sample later: G = 0, and the normal rank is 1
HELD = hinted("window-ranks", system=ResidualSystem.of([[0]], [[1]], [[1], [1]], [[0], [0]]))
TIMES = [[0, 1], [-1, -1], [1, 0]]  # the row of `seen` times q - 1
NULLED = {"states": [[1]], "faults": [[0]], "motion": [[0]]}
REJECTED_HINTS: dict[str, tuple[str, Certificate]] = {
    "a row is missing with hints": ("there may be more rows", spoiled(HINTED, (K, []))),
    "a pivot whose minor is zero": ("at the pivots are dependent", spoiled(HINTED, (f"{K}.0.pivot", 1))),
    "a row times q - 1": ("may have a common factor", spoiled(HINTED, (f"{K}.0.coefficients", TIMES))),
    "infinity, where the rank of G is below the normal rank": ("there may be more rows", spoiled(HELD, ("witness.point", "infinity"))),
    "infinity, where G is zero": (
        "smaller rank at that point",
        spoiled(hinted("left-invertible", system=LATE), ("witness.point", "infinity")),
    ),
    "a row that annihilates nothing, modulo the prime": ("does not annihilate", spoiled(GENERIC, (f"{K}_modulo.0.coefficients.1.1", 1))),
    "windows that could be larger": ("that their shape allows", spoiled(GENERIC, (f"{K}_modulo.0.coefficients", TIMES))),
    "a state with an output": ("a state or fault of nulling has an output", spoiled(GENERIC, ("witness.nulling", NULLED))),
    "a state of zero": ("the states of nulling may be", spoiled(GENERIC, ("witness.nulling", {**NULLED, "states": [[0]]}))),
    "a fault of zero": (
        "the faults of nulling may be",
        spoiled(GENERIC, ("witness.nulling", {"states": [], "faults": [[0]], "motion": [[]]})),
    ),
    "a point at a zero": ("smaller rank at that point", spoiled(INVERTIBLE, (f"{S}.F", [[0]]), (f"{S}.G", [[0], [0]]))),
}
MALFORMED_HINTS: dict[str, tuple[str, Certificate]] = {
    "nulling beside exact rows": ("nulling goes with kernel_modulo", spoiled(HINTED, ("witness.nulling", NULLED))),
    "more states than faults": ("a fault for each of the states", spoiled(GENERIC, ("witness.nulling", {**NULLED, "faults": []}))),
    "nulling over Q(a)": ("nulling: over Q only", spoiled(hinted("generic", SQRT2), ("witness.nulling", NULLED))),
    "a mix alone": ("mix goes with a point", spoiled(EQUAL, ("witness.mix", 1))),
    "a point that is no number": ("point: expected an integer in 0..", spoiled(HINTED, ("witness.point", "at infinity"))),
    "rows twice": ("expected one of kernel and kernel_modulo", spoiled(HINTED, (f"{K}_modulo", []))),
    "no rows": ("expected one of kernel and kernel_modulo", spoiled(HINTED, (K, GONE))),
    "rows modulo, without hints": ("needs a point", spoiled(GENERIC, ("witness.point", GONE))),
    "a point outside the field": ("point: expected an integer in 0..", spoiled(HINTED, ("witness.point", 2**40))),
    "a mix outside the field": ("mix: expected an integer in 0..", spoiled(HINTED, ("witness.mix", 2**40))),
}
