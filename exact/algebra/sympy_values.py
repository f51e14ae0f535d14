"""Whether a value is sympy's, told without loading sympy, which takes longer than most answers do and which most answers never need.

    is_rational         a sympy Rational
    is_matrix           a sympy Matrix of any kind
    is_domain_matrix    a DomainMatrix
    is_expression       a polynomial or another expression

No value is sympy's before somebody has loaded sympy.
"""

from __future__ import annotations

import sys
from typing import Any, TypeGuard


def is_rational(value: object) -> TypeGuard[Any]:
    """Return whether it is a sympy Rational."""
    return _is(value, "sympy", "Rational")


def is_matrix(value: object) -> TypeGuard[Any]:
    """Return whether it is a sympy Matrix, mutable or not."""
    return _is(value, "sympy", "MatrixBase")


def is_domain_matrix(value: object) -> TypeGuard[Any]:
    """Return whether it is a sympy DomainMatrix."""
    return _is(value, "sympy.polys.matrices", "DomainMatrix")


def is_expression(value: object) -> TypeGuard[Any]:
    """Return whether it is a sympy Poly or Expr."""
    return _is(value, "sympy", "Poly") or _is(value, "sympy", "Expr")


def _is(value: object, module: str, name: str) -> bool:
    loaded = sys.modules.get(module)
    return loaded is not None and isinstance(value, getattr(loaded, name))
