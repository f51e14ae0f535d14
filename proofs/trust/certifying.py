"""This makes certificates by the name of their kind: what `faultspace.certify` is.

MAKERS     kind of a certificate -> what it needs to know besides the system, and the function that makes it
certify    the certificate of a kind about a system, a pair of systems, or an experiment

Nothing here is trusted: `certify` may be wrong, and the checker then rejects what it made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from ...base.errors import InvalidInput, shorten
from ...exact.algebra.matrices import Matrix
from ...exact.limits.experiments import Experiment
from ...exact.limits.moesp import PopulationLimits, limit
from ...exact.structure.fault_columns import fault_space
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem, System, residual_of
from . import structure_certificates as structure
from .limit_certificates import Certified
from .structure_certificates import Certificate, Unprovable


class _Kind(NamedTuple):
    """What a kind needs to know beside its subject, what it may be given, and its maker, which gets subject and options."""

    needed: tuple[str, ...]
    optional: tuple[str, ...]
    make: Callable[..., Certificate]


def _left_invertible(system: ResidualSystem, kind: str) -> Certificate:
    certificate = structure.left_invertible(kernel_representation(system))
    if certificate["kind"] != kind:
        raise Unprovable("the system is left-invertible" if kind.startswith("not") else "the system is not left-invertible")
    return certificate


def _moesp_limit(found: PopulationLimits, instruments: str) -> Certificate:
    makers = {"past-inputs": Certified.past_input_limit, "past-inputs-and-outputs": Certified.past_input_and_output_limit}
    make: Callable[[Certified], Certificate] = _choose(makers, "instruments", instruments)
    return make(Certified(found))


def _input_limit(found: PopulationLimits, regression: str) -> Certificate:
    makers = {"true-AC": Certified.output_error_inputs, "moesp": Certified.moesp_inputs}
    make: Callable[[Certified], Certificate] = _choose(makers, "regression", regression)
    return make(Certified(found))


def _matrix_rank(system: ResidualSystem, matrix: str, window: int | None = None) -> Certificate:
    _choose(dict.fromkeys(("observability", "reachability", "toeplitz", "window")), "matrix", matrix)
    if matrix in ("toeplitz", "window") and window is None:
        raise InvalidInput(f"window: got none, expected the number of samples of the {matrix} matrix")
    return structure.matrix_rank(matrix, system, window=window)


def _inversion_delay(system: ResidualSystem, initial_state: str) -> Certificate:
    known = _choose({"known": True, "unknown": False}, "initial_state", initial_state)
    return structure.inversion_delay(kernel_representation(system), known_state=known)


def _fault_space(system: ResidualSystem, window: int | None = None) -> Certificate:
    kernel = kernel_representation(system)
    return structure.fault_space(kernel, fault_space(kernel, window))


def _first_column_only(system: ResidualSystem, window: int, column: Sequence[Any]) -> Certificate:
    if isinstance(column, str) or not isinstance(column, Sequence) or len(column) != system.n + system.p:
        raise InvalidInput(f"column: got {shorten(column)}, expected the n + p = {system.n + system.p} entries of [f; g], as a list")
    z = Matrix.of([[entry] for entry in column], system.field, where="column")
    return structure.first_column_only(kernel_representation(system), window, z)


def _window_equality(system: ResidualSystem, other: ResidualSystem, window: int) -> Certificate:
    return structure.window_equality(kernel_representation(system), kernel_representation(other), window)


MAKERS: dict[str, _Kind] = {
    "behaviour-difference": _Kind(("other",), (), lambda s, other: structure.behaviour_difference(s, kernel_representation(other))),
    "behaviour-equality": _Kind(
        ("other",), (), lambda s, other: structure.behaviour_equality(kernel_representation(s), kernel_representation(other))
    ),
    "behaviour-inclusion": _Kind(("other",), (), lambda s, other: structure.behaviour_inclusion(s, kernel_representation(other))),
    "fault-space": _Kind((), ("window",), _fault_space),
    "finite-zeros": _Kind((), (), structure.finite_zeros),
    "infinite-zeros": _Kind((), (), structure.infinite_zeros),
    "first-column-only": _Kind(("window", "column"), (), _first_column_only),
    "input-limit": _Kind(("regression",), (), _input_limit),
    "inversion-delay": _Kind(("initial_state",), (), _inversion_delay),
    "left-invertible": _Kind((), (), lambda s: _left_invertible(s, "left-invertible")),
    "left-invertible-line": _Kind(("other",), (), lambda s, other: structure.left_invertible_line(s, other)),
    "matrix-rank": _Kind(("matrix",), ("window",), _matrix_rank),
    "moesp-limit": _Kind(("instruments",), (), _moesp_limit),
    "not-left-invertible": _Kind((), (), lambda s: _left_invertible(s, "not-left-invertible")),
    "schur-stable": _Kind((), (), structure.schur_stable),
    "window-equality": _Kind(("other", "window"), (), _window_equality),
    "window-ranks": _Kind((), (), structure.window_ranks_of),
}  # fmt: skip
OF_LIMITS = ("input-limit", "moesp-limit")


def certify(subject: System | Experiment | Mapping[str, Any], kind: str, **options: Any) -> Certificate:
    """Make the certificate of this kind about a system: a statement with a witness, as a JSON-ready dict that `check` can decide.

    What each kind states is written in proofs/trust/FORMAT.md. The kinds "finite-zeros", "infinite-zeros", "left-invertible",
    "not-left-invertible", "schur-stable" and "window-ranks" take no options.

    Parameters
    ----------
    subject : System, Experiment or dict
        An exact system, whose inputs play no part; for "moesp-limit" and "input-limit" an Experiment or the dict of an experiment's file.
    kind : str
    other : System, optional
        A second system, for "behaviour-difference", "behaviour-equality", "behaviour-inclusion", "left-invertible-line" and
        "window-equality".
    window : int, optional
        A number of samples, for "window-equality", "fault-space" (none: the limit), "first-column-only" and "matrix-rank".
    column : list, optional
        The n + p entries of [f; g], for "first-column-only".
    matrix : {"observability", "reachability", "toeplitz", "window"}, optional
        For "matrix-rank".
    initial_state : {"known", "unknown"}, optional
        For "inversion-delay".
    instruments : {"past-inputs", "past-inputs-and-outputs"}, optional
        For "moesp-limit".
    regression : {"true-AC", "moesp"}, optional
        For "input-limit".

    Returns
    -------
    dict
        With "format", "kind", "statement" and "witness".

    Raises
    ------
    InvalidInput
        For an unknown kind (the message names the kinds), options that do not go with it and a subject of the wrong type.
    Unprovable
        Where the statement is not true, or has no witness: over a small prime field, or where an input excites too few samples.

    Examples
    --------
    >>> import faultspace as fs
    >>> system = fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]])
    >>> certificate = fs.certify(system, "inversion-delay", initial_state="known")
    >>> certificate["statement"]["delay"]
    1
    >>> fs.check(certificate).assumes
    []
    """
    if not isinstance(kind, str) or kind not in MAKERS:
        raise InvalidInput(f"kind: got {shorten(kind)}, expected one of {', '.join(MAKERS)}")
    needed, optional, make = MAKERS[kind]
    for name in options:
        if name not in (*needed, *optional):
            raise InvalidInput(f"{name}: {kind} takes no such option, expected {' and '.join((*needed, *optional)) or 'none'}")
    for name in needed:
        if name not in options:
            raise InvalidInput(f"{name}: got none, {kind} needs one")
    if "window" in options:
        window = options["window"]
        if not (window is None and "window" in optional) and (type(window) is not int or window < 0):
            raise InvalidInput(f"window: got {shorten(window)}, expected an integer >= 0, a number of samples")
    if "other" in options:
        options["other"] = _system(options["other"], "other")
    if kind in OF_LIMITS:
        if not isinstance(subject, (Experiment, Mapping)):
            raise InvalidInput(f"subject: got {shorten(subject)}, expected an experiment, which {kind} is about")
        return make(limit(subject), **options)
    try:
        return make(_system(subject, "subject"), **options)
    except ValueError as error:
        if isinstance(error, (InvalidInput, Unprovable)):
            raise
        raise InvalidInput(f"{kind}: {error}") from None


def _system(given: Any, name: str) -> ResidualSystem:
    return residual_of(given, name)


def _choose(known: Mapping[str, Any], name: str, given: object) -> Any:
    if not isinstance(given, str) or given not in known:
        raise InvalidInput(f"{name}: got {shorten(given)}, expected one of {', '.join(known)}")
    return known[given]
