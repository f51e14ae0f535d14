"""What a claim is about, read from the document of a file.

read_case     a system as exact files hold it, or {"first": SYSTEM, "second": SYSTEM}
fitting       the case as one of the kind that a claim is about
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...exact.system.systems import ResidualSystem, read_system
from ..language.vocabularies import ONE_A_AND_C, PAIR, SYSTEM
from ..quantities.cases import Case, Pair


def is_pair(document: Any) -> bool:
    """Whether the document is meant as a pair of systems."""
    return isinstance(document, Mapping) and bool({"first", "second"} & set(document))


def read_case(document: Any) -> Case:
    """Return the case. Raises InvalidInput that names the place, for systems over two fields, and for unequal numbers of outputs."""
    if not is_pair(document):
        return read_system(document).residual
    if set(document) != {"first", "second"}:
        raise InvalidInput(f"got the keys {shorten(sorted(map(str, document)))}, expected first and second, a system each")
    first, second = (read_system(document[name], where=name).residual for name in ("first", "second"))
    if first.field != second.field:
        raise InvalidInput(f"got systems over {first.field} and {second.field}, expected one field")
    if first.p != second.p:
        raise InvalidInput(f"got systems with {first.p} and {second.p} outputs, expected as many in both")
    return Pair(first, second)


def fitting(case: Case, about: str) -> Case:
    """Return the case for claims about `about`. Raises InvalidInput where it is no such one."""
    if isinstance(case, ResidualSystem):
        if about != SYSTEM:
            raise InvalidInput(f'got a system, expected a {about}: {{"first": SYSTEM, "second": SYSTEM}}')
        return case
    if about not in (PAIR, ONE_A_AND_C):
        raise InvalidInput(f"got a pair of systems, expected a {about}")
    if about == ONE_A_AND_C and (case.first.A, case.first.C) != (case.second.A, case.second.C):
        raise InvalidInput("got a pair of systems with different A or C, expected the same in both")
    return Pair(case.first, case.second, about == ONE_A_AND_C)
