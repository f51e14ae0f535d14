"""What `faultspace inspect --json` prints, from definitions, by ranks and null spaces of built matrices.

left_minimal_indices(system), right_minimal_indices(system), lag(system)
infinite_zero_orders(system)      one per unit of normal rank, zeros included
is_observable, is_controllable, is_left_invertible
determines_first_fault(system, last, initial_state)   whether r(0..last) determines v(0)
delay(system, initial_state)      the least such last in 0..n, or None; initial_state is KNOWN or UNKNOWN
inspect_slowly(json)              SYSTEM -> what `inspect --json` prints
same_report(first, second)        equality of two such objects, numbers compared as numbers
"""

from __future__ import annotations

from typing import Any

from .fault_space import fault_space, fault_space_limit
from .fields import Json, parse_field
from .linear import null_space, rank
from .pencil import invariant_zero_polynomial, normal_rank
from .systems import System, parse_system, transposed
from .windows import gap, observability, reachability, toeplitz, toeplitz_rank, window_matrix, window_rank

KNOWN = "known"
UNKNOWN = "unknown"

# The keys of a report whose values are not elements of the field.
PLAIN_KEYS = (
    "n",
    "p",
    "m",
    "normal_rank",
    "left_minimal_indices",
    "right_minimal_indices",
    "infinite_zero_orders",
    "zeta",
    "lag",
    "observable",
    "controllable",
    "left_invertible",
    "delay_known_state",
    "delay_unknown_state",
    "window_ranks",
    "fault_space_dimensions",
    "fault_space_dimension",
)


def left_minimal_indices(system: System) -> list[int]:
    """They are ascending: gap(k) = p - #{eta_i <= k}, so that each index equal to k makes the gap drop by one from k - 1 to k."""
    indices: list[int] = []
    before = system.p
    for k in range(system.n + 1):
        now = gap(system, k)
        indices += [k] * (before - now)
        before = now
    return indices


def right_minimal_indices(system: System) -> list[int]:
    """They are ascending: the left ones of the transposed system."""
    return left_minimal_indices(transposed(system))


def lag(system: System) -> int:
    """The result is the largest left minimal index, 0 when there is none."""
    return max(left_minimal_indices(system), default=0)


def infinite_zero_orders(system: System) -> list[int]:
    """They are ascending: rank T_(k+1) - rank T_k = #{delta_i <= k}, and none exceeds n."""
    orders: list[int] = []
    before = 0
    for k in range(system.n + 1):
        now = toeplitz_rank(system, k + 1) - toeplitz_rank(system, k)
        orders += [k] * (now - before)
        before = now
    return orders


def is_observable(system: System) -> bool:
    """This tells whether (A, C) is observable: rank O_n = n."""
    return rank(observability(system, system.n)) == system.n


def is_controllable(system: System) -> bool:
    """This tells whether (A, F) is controllable: rank [F, AF, ..., A^(n-1) F] = n."""
    return rank(reachability(system)) == system.n


def determines_first_fault(system: System, last: int, initial_state: str) -> bool:
    """This tells whether r(0..last) determines v(0), with x(0) = 0 (KNOWN) or whatever x(0) is (UNKNOWN).

    By linearity: whether v(0) is zero in every (x(0), v(0..last)) that makes the output zero.
    """
    if initial_state == KNOWN:
        start, silent = 0, null_space(toeplitz(system, last + 1))
    elif initial_state == UNKNOWN:
        start, silent = system.n, null_space(window_matrix(system, last + 1))
    else:
        raise ValueError(f"the initial state is {KNOWN!r} or {UNKNOWN!r} (got {initial_state!r})")
    return silent.columns(start, start + system.m).is_zero()


def delay(system: System, initial_state: str) -> int | None:
    """The result is the least l in 0..n such that r(0..l) determines v(0); None when there is none.

    Beyond n nothing new happens: the v(0) that go with zero output on 0..l are those that lead into the states from which the output can be
    kept zero for l samples, and these form a decreasing chain in K^n, constant from l = n on.
    """
    return next((last for last in range(system.n + 1) if determines_first_fault(system, last, initial_state)), None)


def is_left_invertible(system: System) -> bool:
    """This tells whether x(0) = 0 and zero output for ever imply v = 0.

    They imply v(0) = 0 iff r(0..n) determines v(0) (see `delay`); then x(1) = 0, and so on for v(1), v(2), ...
    """
    return determines_first_fault(system, system.n, KNOWN)


def inspect_slowly(json: Json) -> dict[str, Any]:
    """The result is the object that `faultspace inspect --json` prints for a SYSTEM. Raises ValueError when the system is malformed."""
    system = parse_system(json)
    write = system.field.write
    zero_polynomial = invariant_zero_polynomial(system)
    orders = infinite_zero_orders(system)
    limit = fault_space_limit(system)
    windows = range(1, system.n + 4)
    return {
        "field": json.get("field", "Q"),
        "n": system.n,
        "p": system.p,
        "m": system.m,
        "normal_rank": normal_rank(system),
        "left_minimal_indices": left_minimal_indices(system),
        "right_minimal_indices": right_minimal_indices(system),
        "invariant_zero_polynomial": [write(c) for c in zero_polynomial],
        "infinite_zero_orders": orders,
        "zeta": len(zero_polynomial) - 1 + sum(orders),
        "lag": lag(system),
        "observable": is_observable(system),
        "controllable": is_controllable(system),
        "left_invertible": is_left_invertible(system),
        "delay_known_state": delay(system, KNOWN),
        "delay_unknown_state": delay(system, UNKNOWN),
        "window_ranks": [window_rank(system, s) for s in windows],
        "fault_space_dimensions": [fault_space(system, s).height for s in windows],
        "fault_space_dimension": limit.height,
        "fault_space": [[write(x) for x in row] for row in limit.rows],
    }


def same_report(first: dict[str, Any], second: dict[str, Any]) -> bool:
    """This tells whether two such objects agree on all keys of `inspect_slowly`; either may have more.

    Numbers are compared as elements of the field: over Q(a), "1" and ["1", "0"] are the same.
    """
    field = parse_field(first["field"])
    if parse_field(second["field"]) != field:
        return False

    def numbers(report: dict[str, Any]) -> Any:
        polynomial = [field.parse(c) for c in report["invariant_zero_polynomial"]]
        return polynomial, [[field.parse(x) for x in row] for row in report["fault_space"]]

    return all(first[key] == second[key] for key in PLAIN_KEYS) and bool(numbers(first) == numbers(second))
