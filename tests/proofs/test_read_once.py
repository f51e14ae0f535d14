"""A system that the checker has read is read once for the certificates about it; nothing that one of them left bears another."""

from __future__ import annotations

import pytest

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.fault_columns import fault_space
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


HIDDEN = ResidualSystem.of([[0, 1], ["-1/4", 1]], [[1], [1]], [[1, 0], [0, 1]], [[0], [0]])
OF_HIDDEN = kernel_representation(HIDDEN)
AT_ONE = ("witness.point", 1)
RANKS = spoiled(written(make.window_ranks(OF_HIDDEN)), AT_ONE)
SPACES = [spoiled(written(make.fault_space(OF_HIDDEN, fault_space(OF_HIDDEN, s))), AT_ONE) for s in (1, 2, 3, None)]


@pytest.mark.parametrize(
    ("change", "error", "reason"),
    [
        (("witness.point", True), Malformed, "point"),
        (("witness.mix", True), Malformed, "mix"),
        (("witness.prime", 2), Rejected, "divides a denominator"),
        (("witness.prime", 4), Rejected, "not a prime"),
        (("witness.kernel.0.coefficients.0.0", "17"), Rejected, "annihilate"),
        (("witness.kernel.0.pivot", 2), Rejected, "out of range"),
    ],
)
def test_rows_are_looked_at_again_where_anything_about_them_differs(
    change: tuple[str, object], error: type[Exception], reason: str
) -> None:
    """Rows that were seen to span are kept with the prime and the point: not for other rows, another prime or no number."""
    for one in (*SPACES, RANKS):
        assert one["witness"]["kernel"] == RANKS["witness"]["kernel"]
        accept(one)
    with pytest.raises(error, match=reason):
        accept(spoiled(RANKS, change))
    accept(RANKS)


def test_rows_of_one_system_are_not_those_of_another() -> None:
    """Both systems of a comparison are looked at, also where one of them was seen to have these rows before."""
    other = ResidualSystem.of([[0, 1], ["-1/4", 1]], [[1], [2]], [[1, 0], [0, 1]], [[0], [0]])
    accept(SPACES[0])
    own = written(make.behaviour_equality(kernel_representation(HIDDEN), kernel_representation(HIDDEN)))
    accept(own)
    for place in ("first", "second"):
        with pytest.raises(Rejected):
            accept(spoiled(own, (f"statement.{place}", other.to_json())))


@pytest.mark.parametrize("order", [(1, 2, 3, 4), (4, 3, 2, 1), (2, 4, 1, 3)])
def test_windows_are_the_same_in_whatever_order_they_are_asked_for(order: tuple[int, ...]) -> None:
    """Powers of A are kept from one window to the next; observability needs none of the Markov parameters."""
    system = ResidualSystem.of([[0, 1], ["1/3", order[0]]], [[1], [1]], [[1, 0], [0, 1]], [[0], [1]])  # of each order another
    accept(written(make.matrix_rank("observability", system)))
    for s in order:
        for name in ("window", "toeplitz"):
            good = written(make.matrix_rank(name, system, window=s))
            accept(good)
            for wrong in (good["statement"]["rank"] - 1, good["statement"]["rank"] + 1):
                with pytest.raises(Rejected):
                    accept(spoiled(good, ("statement.rank", wrong)))
