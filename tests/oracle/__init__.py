"""This is the slow obvious oracle: every quantity and every statement of this project decided from its definition.

It knows none of the project's own algorithms and imports nothing of it: plain Python, Fractions, integers modulo a
prime, polynomials in a, textbook elimination on the matrices of a window, built entry by entry, and minors of the
pencil. It is meant for tiny systems (n + m + p up to about 8, windows up to about 12) and for being read: what it says
is what the fast code and the certificates are checked against.

    inspect_slowly(system)      SYSTEM -> what `faultspace inspect --json` prints
    same_report(a, b)           equality of two such objects
    truth(kind, statement)      whether the statement of a certificate is true
    premise_holds(kind, st)     whether Q(a) in it is a field
    first_difference(s1, s2)    of two SYSTEMs

    fields, polynomials, linear     arithmetic          systems, windows      the SYSTEM, O_s and T_s
    pencil, quantities              indices and zeros   behaviours            comparison of behaviours, Hankel matrices
    fault_space                     problem (11)        statements            the kinds of certificates
    lines                           a F + b F'          stability             the unit circle
    limits                          stationary covariances, regressions
    structured, families, strategies   systems to test with: of planted structure, named, drawn by hypothesis
"""

from __future__ import annotations

from . import behaviours
from .fields import Json
from .quantities import inspect_slowly, same_report
from .statements import premise_holds, truth
from .systems import parse_system


def first_difference(first: Json, second: Json) -> int | None:
    """The result is the least number of samples on which the restricted behaviours of two SYSTEMs differ, None when there is none.

    Raises ValueError when a system is malformed or their fields or outputs are not the same.
    """
    one, two = parse_system(first), parse_system(second)
    if one.field != two.field or one.p != two.p:
        raise ValueError("systems are compared that have the same field and the same number of outputs")
    return behaviours.first_difference(one, two)


__all__ = ["first_difference", "inspect_slowly", "premise_holds", "same_report", "truth"]
