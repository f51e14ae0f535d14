"""What a claim is about, read from the document of a file.

read_case     a system as exact files hold it, or what else the FORMS are
at_root       the case over a number field with a chosen root
fitting       the case as one of the kind that a claim is about
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...exact.algebra.embeddings import RealField
from ...exact.algebra.matrices import Matrix
from ...exact.algebra.validation import natural
from ...exact.structure.fault_columns import fault_space_dimension
from ...exact.system.systems import FaultySystem, ResidualSystem, read_system
from ..language.vocabularies import CHOICE, ONE_A_AND_C, PAIR, RECORD, SYSTEM
from ..quantities.cases import Case, Choice, Pair, Record

_TWO = '{"first": SYSTEM, "second": SYSTEM}'
FORMS = {
    SYSTEM: "SYSTEM",
    PAIR: _TWO,
    ONE_A_AND_C: _TWO,
    CHOICE: '{"system": SYSTEM, "P": [[...], ...]}',
    RECORD: '{"system": SYSTEM, "u": [[...], ...], "x0": [...]}',
}


def is_pair(document: Any) -> bool:
    """Return whether the document is meant as a pair of systems."""
    return isinstance(document, Mapping) and bool({"first", "second"} & set(document))


def is_choice(document: Any) -> bool:
    """Return whether the document is meant as a system and a P."""
    return isinstance(document, Mapping) and "P" in document


def is_record(document: Any) -> bool:
    """Return whether the document is meant as a system and what drove it."""
    return isinstance(document, Mapping) and bool({"u", "x0"} & set(document))


def read_case(document: Any) -> Case:
    """Return the case. Raises InvalidInput that names the place, for systems over two fields, and for shapes that do not fit."""
    if is_choice(document):
        return _choice(document)
    if is_record(document):
        return _record(document)
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


def _choice(document: Mapping[str, Any]) -> Choice:
    if not {"system", "P"} <= set(document) <= {"system", "P", "k"}:
        raise InvalidInput(f"got the keys {shorten(sorted(map(str, document)))}, expected system and P (and k, where P has no rows)")
    system = read_system(document["system"]).residual
    rows, n_z = document["P"], fault_space_dimension(system)
    if not isinstance(rows, list) or not all(isinstance(row, list) for row in rows) or len(rows) != n_z:
        raise InvalidInput(f"P: got {shorten(rows)}, expected {n_z} rows, as many as the fault space has dimensions")
    k = document.get("k", len(rows[0]) if rows else 0)
    return Choice(system, Matrix.of(rows, system.field, shape=(n_z, natural(k, "k")), where="P"))


def _record(document: Mapping[str, Any]) -> Record:
    if set(document) != {"system", "u", "x0"}:
        raise InvalidInput(f"got the keys {shorten(sorted(map(str, document)))}, expected system, u and x0")
    system = read_system(document["system"])
    if not isinstance(system, FaultySystem):
        raise InvalidInput("system: got one without B and D, expected one with inputs")
    u, x0 = document["u"], document["x0"]
    if not isinstance(u, list) or not all(isinstance(row, list) for row in u):
        raise InvalidInput(f"u: got {shorten(u)}, expected a list of rows, one a sample")
    if not isinstance(x0, list) or len(x0) != system.n:
        raise InvalidInput(f"x0: got {shorten(x0)}, expected a list of {system.n} numbers")
    signal = Matrix.of(u, system.field, shape=(len(u), system.nu), where="u")
    return Record(system, signal, Matrix.of([[x] for x in x0], system.field, shape=(system.n, 1), where="x0"))


def at_root(case: Case, field: RealField) -> Case:
    """Return the case over this field, where it is over the same one without a root; else as it is."""

    def moved(matrix: Matrix) -> Matrix:
        return Matrix(field, matrix.nrows, matrix.ncols, matrix.flint)

    def system(one: ResidualSystem) -> ResidualSystem:
        return ResidualSystem(*(moved(getattr(one, name)) for name in "AFCG"))

    if isinstance(case, ResidualSystem):
        return system(case) if case.field == field.without_root else case
    if isinstance(case, Pair):
        return replace(case, first=system(case.first), second=system(case.second)) if case.first.field == field.without_root else case
    if case.system.field != field.without_root:
        return case
    if isinstance(case, Choice):
        return Choice(system(case.system), moved(case.P))
    driven = case.system
    return Record(FaultySystem(system(driven.residual), moved(driven.B), moved(driven.D)), moved(case.u), moved(case.x0))


KINDS: tuple[tuple[type, str, tuple[str, ...]], ...] = (
    (ResidualSystem, "system", (SYSTEM,)),
    (Choice, "choice", (CHOICE,)),
    (Record, "record", (RECORD,)),
    (Pair, "pair of systems", (PAIR, ONE_A_AND_C)),
)


def fitting(case: Case, about: str) -> Case:
    """Return the case for claims about `about`. Raises InvalidInput where it is no such one."""
    given, fits = next((words, fits) for kind, words, fits in KINDS if isinstance(case, kind))
    if about not in fits:
        raise InvalidInput(f"got a {given}, expected a {about}: {FORMS[about]}")
    if not isinstance(case, Pair):
        return case
    if about == ONE_A_AND_C and (case.first.A, case.first.C) != (case.second.A, case.second.C):
        raise InvalidInput("got a pair of systems with different A or C, expected the same in both")
    return Pair(case.first, case.second, about == ONE_A_AND_C)
