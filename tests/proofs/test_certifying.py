"""`certify` makes every kind that the checker decides, and refuses what is not true."""

from __future__ import annotations

import re
from itertools import product

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs import Unprovable
from faultspace.proofs.trust import checker
from faultspace.proofs.trust.certifying import MAKERS, certify
from faultspace.proofs.trust.checker import KINDS
from tests.oracle.statements import truth


def test_every_kind_of_the_checker_can_be_made() -> None:
    assert {*MAKERS} == {*KINDS}, "MAKERS of proofs/trust/certifying.py has a line for each kind of the checker"


def test_the_words_of_certify_name_every_kind_and_option() -> None:
    quoted = set(re.findall(r'"([\w-]+)"', certify.__doc__ or ""))
    assert {*MAKERS} <= quoted
    named = set(re.findall(r"`(\w+)`", certify.__doc__ or ""))
    assert {name for maker in MAKERS.values() for name in (*maker.needed, *maker.optional)} <= named


@pytest.mark.parametrize(
    "system",
    [
        ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]]),
        ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]]),
    ],
)
def test_columns_of_which_the_first_block_alone_is_annihilated(system: ResidualSystem) -> None:
    made = 0
    for window, column in product(range(4), product((-1, 0, 1), repeat=system.n + system.p)):
        statement = {"system": system.to_json(), "window": window, "column": list(column)}
        try:
            certificate = certify(system, "first-column-only", window=window, column=column)
        except Unprovable:
            assert not truth("first-column-only", statement)
        else:
            assert truth("first-column-only", statement)
            checker.verify(certificate)
            made += 1
    assert made


@pytest.mark.parametrize("column", [[1, 0], "100", 1, [1, 0, "x"], [1, 0, 0.5]])
def test_what_is_no_column_is_refused(column: object) -> None:
    with pytest.raises(InvalidInput, match=r"^column"):
        certify(ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]]), "first-column-only", window=2, column=column)
