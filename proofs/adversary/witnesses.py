"""This is what an attack has found, once the checker has accepted it.

Found       a counterexample in words, with the certificates that show it
confirmed   the Witness of a counterexample at a point, once each of its certificates is accepted
"""

from __future__ import annotations

from collections.abc import Iterable

from ..evidence.attacks import Point, Witness
from ..trust.structure_certificates import Certificate, accept

Found = tuple[str, list[Certificate]]


def confirmed(words: str, point: Point, certificates: Iterable[Certificate]) -> Witness:
    """Return the counterexample at this point. The checker raises Rejected where it does not accept a certificate."""
    kept = tuple(certificates)
    for certificate in kept:
        accept(certificate)
    return Witness(words, point, kept)
