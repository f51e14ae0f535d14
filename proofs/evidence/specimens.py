"""One small certificate of each kind over GF(2) and GF(3); an inclusion over Q; stability over Q and Q(sqrt 2): no headline shows these.

    specimens    them, to be written beside the headlines, for whoever reads the format by example or tries another checker with it

The system has two states, a relation of degree 1 and one fault; over GF(2) and GF(3) the same numbers are read modulo 2 and 3.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from ...exact.algebra.fields import QQ, Field, NumberField, PrimeField
from ...exact.structure.fault_columns import fault_space
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate


def specimens() -> list[Certificate]:
    """Return the certificates, each of a true statement, so that none is refused."""
    inclusion = make.behaviour_inclusion(_system(QQ, 1), kernel_representation(_system(QQ, 1)))
    return [*over(PrimeField(2)), *over(PrimeField(3)), inclusion, *stable()]


def over(field: Field) -> Iterator[Certificate]:
    """Yield one certificate of each kind that has a meaning over a finite field."""
    x, other = _system(field, 1), _system(field, 0)
    kernel = kernel_representation(x)
    yield make.window_ranks(kernel)
    yield make.left_invertible(kernel)
    yield make.left_invertible(kernel_representation(ResidualSystem.of([[1]], [[1, 1]], [[1], [0]], [[0, 0], [1, 1]], field=field)))
    yield make.left_invertible_line(x, ResidualSystem.of(x.A.to_json(), [[1], [0]], x.C.to_json(), [[1], [0]], field=field))
    yield make.inversion_delay(kernel, known_state=True)
    yield make.behaviour_inclusion(x, kernel)
    yield make.behaviour_equality(kernel, kernel)
    yield make.window_equality(kernel, kernel, 2)
    yield make.behaviour_difference(other, kernel)
    yield make.fault_space(kernel, fault_space(kernel, None))
    yield make.matrix_rank("window", x, window=2)
    yield make.finite_zeros(x)
    yield make.infinite_zeros(x)


def stable() -> Iterator[Certificate]:
    """Yield certificates of stability with complex eigenvalues of modulus 1 / sqrt 2, and with sqrt(2) / 2 in both embeddings."""
    root = NumberField((Fraction(-2), Fraction(0), Fraction(1)))
    for A, field in (([["1/2", "-1/2"], ["1/2", "1/2"]], QQ), ([[["0", "1/2"], 1], [0, ["0", "-1/2"]]], root)):
        yield make.schur_stable(ResidualSystem.of(A, [[1], [0]], [[1, 0]], [[0]], field=field))


def _system(field: Field, feedback: int) -> ResidualSystem:
    return ResidualSystem.of([[0, feedback], [0, 1]], [[1], [1]], [[1, 0], [0, 1]], [[0], [1]], field=field)
