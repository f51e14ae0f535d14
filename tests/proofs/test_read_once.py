"""A system that the checker has read is read once for the certificates about it; nothing that one of them left bears another."""

from __future__ import annotations

import pytest

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.trust import structure_certificates as make
from faultspace.proofs.trust.checker import Malformed, Rejected
from faultspace.proofs.trust.structure_certificates import accept

from .examples import LEADING, NORMAL, OUTPUTS, PROJECTED, SEVEN_B, SEVEN_D, Certificate, spoiled, written

SEVEN = written(make.left_invertible(kernel_representation(ResidualSystem.of([], [], [[]], [["7/3"]], n=0, m=1, p=1))))
SUMS = ResidualSystem.of([[1]], [[1]], [[1]], [[0]])
WALK = written(make.data_rank("residual-hankel", SUMS, Matrix.of([[1]]), Matrix.of([[0], [0], [0], [0]]), 2))
NINTH = ("witness.covariance.0.0", "1/9")


@pytest.mark.parametrize(
    ("good", "wrong", "reason"),
    [
        (SEVEN, spoiled(SEVEN, ("witness.prime", 7), ("witness.point", 1)), "smaller rank"),
        (LEADING, spoiled(LEADING, NINTH), "Lyapunov"),
        (LEADING, spoiled(NORMAL, NINTH), "Lyapunov"),
        (OUTPUTS, spoiled(OUTPUTS, NINTH), "Lyapunov"),
        (LEADING, OUTPUTS | {"witness": OUTPUTS["witness"] | {"covariance": LEADING["witness"]["covariance"]}}, "covariance"),
        (NORMAL, SEVEN_B, "correlated"),
        (NORMAL, SEVEN_D, "correlated"),
        (PROJECTED, spoiled(PROJECTED, ("statement.B", [["7"]])), "normal equations"),
    ],
)
def test_a_wrong_certificate_is_refused_after_a_right_one_about_the_same(good: Certificate, wrong: Certificate, reason: str) -> None:
    key = "experiment" if "experiment" in good["statement"] else "system"
    assert good["statement"][key] == wrong["statement"][key]
    for _ in range(2):
        accept(good)
        with pytest.raises((Rejected, Malformed), match=reason):
            accept(wrong)


def test_what_is_equal_in_python_and_not_in_json_is_read_again() -> None:
    """One and true are equal, and true is no number."""
    accept(SEVEN)
    one = spoiled(SEVEN, ("statement.system.G", [[1]]))
    accept(one)
    with pytest.raises(Malformed):
        accept(spoiled(SEVEN, ("statement.system.G", [[True]])))


def test_a_word_is_walked_again_where_another_is_stated() -> None:
    """The last word of a system is kept: it is not taken for another one, nor for one that is no word at all."""
    accept(WALK)
    with pytest.raises(Rejected, match="does not vanish"):
        accept(spoiled(WALK, ("statement.v.1", ["1"])))
    with pytest.raises(Rejected, match="does not vanish"):
        accept(spoiled(WALK, ("statement.x0.0", "5"), ("statement.v.0", ["1"])))
    accept(spoiled(WALK, ("statement.v.3", [1])))
    with pytest.raises(Malformed):
        accept(spoiled(WALK, ("statement.v.3", [True])))
