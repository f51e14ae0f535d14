"""This is what an implementation offers to be tested: a few functions, all optional; those that are there declare what is tested.

    identify(y, u, order, block_rows) -> A, B, C, D       from y (N, p), u (N, n_u); any state basis
    residual(y, u, A, B, C, D) -> r                       y less the model's response to u, (N, p); any initial state
    window_ranks(r, windows) -> ranks                     of the block Hankel matrices of 1, ..., windows block rows
    fault_dimension(r) -> n_v                             the number of independent faults
    fault_space(r, A, C, n_v, block_rows) -> Z            all columns [f; g] that explain r, (n + p, n_z); any basis
    reconstruct(r, A, F, C, G, x0) -> v                   the fault signal (N, m) from the known initial state
    structure(A, F, C, G) -> ZeroStructure                zeros and ranks of the system from v to r (or a mapping with some of its names)
    count_faults(y, u, order) -> n_v                      the number of faults in outputs and inputs, without a residual
    identified_fault_space(y, u, order, n_v) -> A, C, Z   a model and all columns [f; g] in its states

Arrays are time-major float64. The `block_rows` of `identify` are those of past and future, and bind: where that window is too short, to
refuse is right. The `block_rows` of `fault_space` is a window that suffices, longer than the lag (in `fault-space-at-the-lag`
it is not: that may be refused); whether it is used is the implementation's own affair. To refuse is to raise ValueError or
ArithmeticError, or to return None; any other exception is a crash. The last two functions ask what `identify` of the library answers from a
record; under noise a refusal stands for "undecided", and is no failure.

    ARGUMENTS, FUNCTIONS    the names above, with those of their arguments, and alone
    offered      the functions that an object or module has;   fitting: the same, each seen to take what the audit gives it
    not_promised what it says it never promised; excused: the reason for a check
    guarded      a function whose refusals raise Refused and whose crashes raise Broken
    load         the object that `module:object`, `file.py:object`, a module or a file names
"""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, TypeGuard

from ...base.errors import InvalidData, shorten
from ...base.sheets import counted
from .records import Broken, Check, Function, Refused

ARGUMENTS: dict[str, tuple[str, ...]] = {
    "identify": ("y", "u", "order", "block_rows"),
    "residual": ("y", "u", "A", "B", "C", "D"),
    "window_ranks": ("r", "windows"),
    "fault_dimension": ("r",),
    "fault_space": ("r", "A", "C", "n_v", "block_rows"),
    "reconstruct": ("r", "A", "F", "C", "G", "x0"),
    "structure": ("A", "F", "C", "G"),
    "count_faults": ("y", "u", "order"),
    "identified_fault_space": ("y", "u", "order", "n_v"),
}
FUNCTIONS = tuple(ARGUMENTS)


@dataclass(frozen=True)
class ZeroStructure:
    """The record holds of x(k+1) = A x + F v, r = C x + G v the normal rank of the transfer function, the finite invariant zeros, the
    orders of the infinite zeros (in any order, one per unit of normal rank, zeros included), and whether the system is left-invertible.

    The finite zeros are the roots of the invariant polynomials of the pencil [[qI - A, -F], [C, G]], with their multiplicities, also
    where the system is not left-invertible: where F = G = 0 they are the eigenvalues of A that C does not show.
    """

    normal_rank: int
    finite_zeros: Sequence[complex]
    infinite_zero_orders: Sequence[int]
    left_invertible: bool


def offered(implementation: object) -> dict[str, Function]:
    """Return name -> function for those of FUNCTIONS that the implementation has. Raises InvalidData where it has none."""
    found = {name: getattr(implementation, name) for name in FUNCTIONS if callable(getattr(implementation, name, None))}
    if not found:
        raise InvalidData(f"the adapter has none of the functions {', '.join(FUNCTIONS)}: define one at least")
    return found


def fitting(implementation: object) -> dict[str, Function]:
    """Return name -> function for what the implementation offers. Raises InvalidData where it offers nothing, and for a function that
    cannot be called with the arguments that the audit gives it, by position.
    """
    found = offered(implementation)
    for name, function in found.items():
        asked = ARGUMENTS[name]
        taken = _signature(function)
        try:
            if taken is not None:
                taken.bind(*asked)
        except TypeError:
            raise InvalidData(
                f"the adapter's {name}: got {name}{_shown(taken)}, expected a function that takes {counted(len(asked), 'argument')} by "
                f"position: {name}({', '.join(asked)})"
            ) from None
    return found


def _signature(function: Any) -> inspect.Signature | None:
    """Return None for a function that does not tell, as some that are written in C."""
    try:
        return inspect.signature(function)
    except (TypeError, ValueError):
        return None


def _shown(signature: Any) -> str:
    return str(signature.replace(return_annotation=inspect.Signature.empty))


def known(offered: object) -> TypeGuard[list[str]]:
    """Return whether this is a list of some of FUNCTIONS: of a process that says that it offers nothing, no check would fail."""
    return isinstance(offered, list) and bool(offered) and all(one in FUNCTIONS for one in offered)


def not_promised(implementation: object) -> dict[str, str]:
    """Return pattern -> reason for the checks that the implementation says it never promised to pass: its NOT_PROMISED.

    A pattern stands for SLUG/VECTOR, with * and ?, as in {"exact-recovery*/*": "fits a finite impulse response"}. Raises InvalidData for
    what is no such mapping, and for an empty reason.
    """
    found = getattr(implementation, "NOT_PROMISED", {})
    if not isinstance(found, Mapping) or not all(isinstance(one, str) and one.strip() for pair in found.items() for one in pair):
        raise InvalidData(f"NOT_PROMISED: got {shorten(found)}, expected patterns SLUG/VECTOR with the reason for each")
    return dict(found)


def excused(check: Check, patterns: Mapping[str, str]) -> str:
    """Return the reason of the first pattern that the check fits; empty where none does."""
    return next((reason for pattern, reason in patterns.items() if fnmatchcase(f"{check.slug}/{check.vector}", pattern)), "")


def guarded(function: Function) -> Function:
    """Return `function` with its refusals and crashes told apart."""

    def call(*arguments: Any) -> Any:
        try:
            answer = function(*arguments)
        except (Refused, Broken):
            raise
        except (ValueError, ArithmeticError) as error:
            raise Refused(f"{type(error).__name__}: {error}") from error
        except SystemExit as error:
            raise Broken(f"asked to end the program: SystemExit({error.code!r})") from error
        except Exception as error:
            raise Broken(f"crashed with {type(error).__name__}: {error}") from error
        if answer is None:
            raise Refused("gave no answer")
        return answer

    return call


def load(name: str) -> object:
    """Return the adapter of that name, an instance where it is a class. Raises InvalidData."""
    place, _, attribute = name.rpartition(":")
    if not place:
        place, attribute = name, ""
    try:
        module: Any = _from_file(Path(place)) if place.endswith(".py") else importlib.import_module(place)
    except ImportError as error:
        hint = "name its module instead: package.module" if "relative import" in str(error) else "needed is module:object or file.py:object"
        raise InvalidData(f"adapter {name}: {error}; {hint}") from None
    except Exception as error:
        raise InvalidData(f"adapter {name}: importing it failed with {type(error).__name__}: {error}") from None
    found: Any = module
    for part in attribute.split(".") if attribute else ():
        if not hasattr(found, part):
            raise InvalidData(f"adapter {name}: {place} has no {attribute}; it has {', '.join(n for n in vars(module) if n[0] != '_')}")
        found = getattr(found, part)
    if not isinstance(found, type):
        return found
    try:
        return found()
    except Exception as error:
        raise InvalidData(f"adapter {name}: {attribute}() failed with {type(error).__name__}: {error}") from None


def _from_file(path: Path) -> object:
    if not path.is_file():
        raise ImportError(f"there is no file {path}")
    spec = importlib.util.spec_from_file_location(f"audited_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is no Python file")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module
