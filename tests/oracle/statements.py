"""This decides whether the statement of a certificate is true, kind by kind, whatever its witness says.

    truth(kind, statement)          True or False; raises ValueError when the kind is unknown or the statement malformed
    premise_holds(kind, statement)  whether the minimal polynomials in the statement are irreducible
    KINDS                           kind -> the function that decides it

Over Q(a) a statement is read as one about a field. With a reducible polynomial its premise fails and `truth` says
nothing: it answers for the ring or raises NotAField, a ValueError. "On every window" is decided on a conclusive window;
a comment says why it is one. Everything else is built as stated, so that windows of hundreds of samples take very long.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from . import behaviours, limits, lines, polynomials, stability
from .fault_space import annihilated_columns, fault_space
from .fields import Element, Field, Json, is_irreducible, parse_index
from .linear import Matrix, rank, rref
from .pencil import infinite_zero_orders_of_pencil, invariant_zero_polynomial, normal_rank
from .quantities import KNOWN, UNKNOWN, delay, is_left_invertible
from .systems import System, parse_keys, parse_matrix, parse_system, parse_vector
from .windows import observability, reachability, toeplitz, window_matrix, window_rank

MAX_WINDOW = 4096
SYSTEM_KEYS = ("system", "inner", "outer", "first", "second")


def truth(kind: str, statement: dict[str, Any]) -> bool:
    """This tells whether the statement of that kind is true; raises ValueError when it is malformed or the kind unknown."""
    if kind not in KINDS:
        raise ValueError(f"unknown kind: {kind!r}")
    return KINDS[kind](statement)


def premise_holds(kind: str, statement: dict[str, Any]) -> bool:
    """This tells whether every "field" in the statement is one; raises ValueError as `truth` does on malformed systems."""
    if kind not in KINDS or not isinstance(statement, dict):
        raise ValueError(f"not a statement of a known kind: {kind!r}")
    if "experiment" in statement:
        limits.parse_experiment(statement["experiment"])
    return all(is_irreducible(parse_system(statement[key]).field) for key in SYSTEM_KEYS if key in statement)


def window_ranks(statement: Json) -> bool:
    """It says that rank [O_s T_s] = s r + sum min(s, eta_i) for every s >= 1, with p - r indices eta_i, and the listed ranks."""
    parse_keys(statement, {"system", "normal_rank", "left_minimal_indices"}, frozenset({"window_ranks"}))
    system = parse_system(statement["system"])
    r = parse_index(statement["normal_rank"])
    indices = _ascending(statement["left_minimal_indices"])
    listed = _indices(statement.get("window_ranks", []))

    def formula(s: int) -> int:
        return s * r + sum(min(s, eta) for eta in indices)

    if len(indices) != system.p - r or max(indices, default=0) > system.n:
        # The formula's gap drops at k = eta_i; the true one never after k = n.
        return False
    conclusive = range(1, system.n + 4)
    if any(window_rank(system, s) != formula(s) for s in conclusive):
        return False
    return all(claimed == formula(s) for s, claimed in enumerate(listed, start=1))


def left_invertible(statement: Json) -> bool:
    """It says that x(0) = 0 and zero output for ever imply v = 0: n + 1 samples decide (see `quantities.is_left_invertible`)."""
    parse_keys(statement, {"system"})
    return is_left_invertible(parse_system(statement["system"]))


def not_left_invertible(statement: Json) -> bool:
    """It says the contrary of `left_invertible`."""
    return not left_invertible(statement)


def left_invertible_line(statement: Json) -> bool:
    """The system is left-invertible with the faults a F + b F' and a G + b G' for every (a : b) over every extension of the field."""
    first, second = _two_systems(statement, "first", "second")
    if (first.A, first.C, first.m) != (second.A, second.C, second.m):
        raise ValueError("first and second have the same A, C and number of faults")
    return lines.holds(first, second)


def inversion_delay(statement: Json) -> bool:
    """It says that this is the least l in 0..n such that r(0..l) determines v(0); null says that there is none."""
    parse_keys(statement, {"system", "initial_state", "delay"})
    if statement["initial_state"] not in (KNOWN, UNKNOWN):
        raise ValueError(f"not an initial state: {statement['initial_state']!r}")
    claimed = None if statement["delay"] is None else parse_index(statement["delay"])
    return delay(parse_system(statement["system"]), statement["initial_state"]) == claimed


def behaviour_inclusion(statement: Json) -> bool:
    """B(inner) is contained in B(outer) on every window: n1 + n2 + 1 samples decide (see `behaviours`)."""
    inner, outer = _two_systems(statement, "inner", "outer")
    return behaviours.included(inner, outer)


def behaviour_equality(statement: Json) -> bool:
    """It says that B(first) = B(second) on every window: n1 + n2 + 1 samples decide."""
    first, second = _two_systems(statement, "first", "second")
    return behaviours.equivalent(first, second)


def window_equality(statement: Json) -> bool:
    """It says that the restricted behaviours on that many samples are equal; a conclusive window stands for all longer ones."""
    first, second = _two_systems(statement, "first", "second", frozenset({"window"}))
    s = min(_window(statement["window"]), behaviours.conclusive_window(first, second))
    return behaviours.equal_on(first, second, s)


def behaviour_difference(statement: Json) -> bool:
    """It says that some word of that many samples of the first is not one of the second."""
    first, second = _two_systems(statement, "first", "second", frozenset({"window"}))
    s = min(_window(statement["window"]), behaviours.conclusive_window(first, second))
    return not behaviours.included_on(first, second, s)


def fault_space_basis(statement: Json) -> bool:
    """It says that the solutions of problem (11) at the window (null: in the limit) have this reduced row echelon basis."""
    parse_keys(statement, {"system", "window", "basis"})
    system = parse_system(statement["system"])
    s = system.n + 2
    if statement["window"] is not None:
        s = min(s, _window(statement["window"]))
    if not isinstance(statement["basis"], list):
        raise ValueError("a basis is a MATRIX")
    size = system.n + system.p
    basis = parse_matrix(system.field, statement["basis"], len(statement["basis"]), size)
    return basis == rref(basis)[0] and basis == fault_space(system, s)


def first_column_only(statement: Json) -> bool:
    """N_s annihilates the first block column of T_s(z) but not T_s(z)."""
    parse_keys(statement, {"system", "window", "column"})
    system = parse_system(statement["system"])
    z = parse_vector(system.field, statement["column"], system.n + system.p)
    annihilated = annihilated_columns(system, z, _window(statement["window"]))
    # On a window of no samples T_0(z) has no columns, and all of it is annihilated.
    return bool(annihilated) and annihilated[0] and not all(annihilated)


def matrix_rank(statement: Json) -> bool:
    """The named matrix has that rank."""
    if not isinstance(statement, dict) or not isinstance(statement.get("matrix"), str):
        raise ValueError("a statement on a rank names its matrix")
    name = statement["matrix"]
    if name not in MATRICES:
        raise ValueError(f"unknown matrix: {name!r}")
    more, build = MATRICES[name]
    parse_keys(statement, {"matrix", "rank", "system"} | set(more))
    return rank(build(parse_system(statement["system"]), statement)) == parse_index(statement["rank"])


def schur_stable(statement: Json) -> bool:
    """Say whether all eigenvalues of A lie inside the unit circle, over Q(a) for every root a."""
    parse_keys(statement, {"system"})
    return stability.is_stable(parse_system(statement["system"]))


def finite_zeros(statement: Json) -> bool:
    """The result is the normal rank and the monic product of the invariant polynomials of the pencil."""
    parse_keys(statement, {"system", "normal_rank", "invariant_zero_polynomial"})
    system = parse_system(statement["system"])
    r = parse_index(statement["normal_rank"])
    claimed = _polynomial(system.field, statement["invariant_zero_polynomial"])
    return r == normal_rank(system) and claimed == invariant_zero_polynomial(system)


def infinite_zeros(statement: Json) -> bool:
    """These are the infinite zero orders, one per unit of normal rank, from the minors of the reversed pencil."""
    parse_keys(statement, {"system", "infinite_zero_orders"})
    system = parse_system(statement["system"])
    return _ascending(statement["infinite_zero_orders"]) == infinite_zero_orders_of_pencil(system)


KINDS: dict[str, Callable[[Json], bool]] = {
    "window-ranks": window_ranks,
    "left-invertible": left_invertible,
    "left-invertible-line": left_invertible_line,
    "not-left-invertible": not_left_invertible,
    "inversion-delay": inversion_delay,
    "behaviour-inclusion": behaviour_inclusion,
    "behaviour-equality": behaviour_equality,
    "window-equality": window_equality,
    "behaviour-difference": behaviour_difference,
    "fault-space": fault_space_basis,
    "first-column-only": first_column_only,
    "matrix-rank": matrix_rank,
    "schur-stable": schur_stable,
    "moesp-limit": limits.moesp_limit,
    "input-limit": limits.input_limit,
    "finite-zeros": finite_zeros,
    "infinite-zeros": infinite_zeros,
}


def _residual_hankel(system: System, statement: Json) -> Matrix:
    return behaviours.residual_hankel(system, *_trajectory(system, statement), _window(statement["window"]))


def _excitation(system: System, statement: Json) -> Matrix:
    return behaviours.excitation(system, *_trajectory(system, statement), _window(statement["window"]))


# Name of the matrix -> the further keys of the statement, and how it is built.
MATRICES: dict[str, tuple[tuple[str, ...], Callable[[System, Json], Matrix]]] = {
    "observability": ((), lambda system, _: observability(system, system.n)),
    "reachability": ((), lambda system, _: reachability(system)),
    "toeplitz": (("window",), lambda system, statement: toeplitz(system, _window(statement["window"]))),
    "window": (("window",), lambda system, statement: window_matrix(system, _window(statement["window"]))),
    "residual-hankel": (("x0", "v", "window"), _residual_hankel),
    "excitation": (("x0", "v", "window"), _excitation),
}


def _two_systems(statement: Json, a: str, b: str, more: frozenset[str] = frozenset()) -> tuple[System, System]:
    parse_keys(statement, {a, b} | more)
    first, second = parse_system(statement[a]), parse_system(statement[b])
    if first.field != second.field or first.p != second.p:
        raise ValueError(f"{a} and {b} have the same field and the same number of outputs")
    return first, second


def _trajectory(system: System, statement: Json) -> tuple[list[Element], list[list[Element]]]:
    x0 = parse_vector(system.field, statement["x0"], system.n)
    if not isinstance(statement["v"], list):
        raise ValueError("v is a list of VECTORs")
    return x0, [parse_vector(system.field, sample, system.m) for sample in statement["v"]]


def _window(json: Json) -> int:
    window = parse_index(json)
    if window > MAX_WINDOW:
        raise ValueError(f"windows have at most {MAX_WINDOW} samples (got {window})")
    return window


def _indices(json: Json) -> list[int]:
    if not isinstance(json, list):
        raise ValueError(f"not a list of INDEXes: {json!r}")
    return [parse_index(x) for x in json]


def _ascending(json: Json) -> list[int]:
    indices = _indices(json)
    if indices != sorted(indices):
        raise ValueError(f"the indices do not ascend: {indices}")
    return indices


def _polynomial(field: Field, json: Json) -> polynomials.Polynomial:
    if not isinstance(json, list):
        raise ValueError(f"not a POLY: {json!r}")
    return polynomials.trimmed([field.parse(c) for c in json])
