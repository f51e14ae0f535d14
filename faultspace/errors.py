"""Every error that a public function raises for what it was given: `fs.errors`.

InvalidInput    input that cannot be used: the text is one line, what was got and what is needed
InvalidData     the same of measured data
Malformed       a certificate that does not parse; Rejected: one that does not prove its statement; both are the checker's own
Unprovable      what `certify` was asked for is not so, or has no witness

    >>> import faultspace as fs
    >>> try:
    ...     fs.check({})
    ... except fs.errors.Malformed as error:
    ...     print(type(error).__name__)
    Malformed

The last three are loaded when they are first asked for. What errors are made of stands in `faultspace.base.errors`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .base.errors import InvalidData, InvalidInput

if TYPE_CHECKING:
    from .proofs import Malformed, Rejected, Unprovable

__all__ = ["InvalidData", "InvalidInput", "Malformed", "Rejected", "Unprovable"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    from . import proofs

    return getattr(proofs, name)


def __dir__() -> list[str]:
    return __all__.copy()
