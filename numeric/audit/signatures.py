"""Whether the functions of an adapter take what the audit gives them, seen before anything runs.

ARGUMENTS   function -> the names of its arguments, as the protocols of `adapter` have them
fitting     the functions that an implementation offers, each of which takes them
"""

from __future__ import annotations

import inspect
from typing import Any

from ...base.errors import InvalidData
from ...base.sheets import counted
from . import adapter
from .records import Function

_PROTOCOLS = (
    adapter.Identifies,
    adapter.Simulates,
    adapter.RanksWindows,
    adapter.CountsFaults,
    adapter.FindsFaults,
    adapter.Reconstructs,
    adapter.KnowsStructure,
    adapter.CountsFromRecords,
    adapter.FindsFromRecords,
)
ARGUMENTS: dict[str, tuple[str, ...]] = {
    name: tuple(inspect.signature(getattr(protocol, name)).parameters)[1:]
    for protocol in _PROTOCOLS
    for name in adapter.FUNCTIONS
    if hasattr(protocol, name)
}


def fitting(implementation: object) -> dict[str, Function]:
    """Return name -> function for what the implementation offers. Raises InvalidData where it offers nothing, and for a function that
    cannot be called with the arguments that the audit gives it, by position.
    """
    found = adapter.offered(implementation)
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
