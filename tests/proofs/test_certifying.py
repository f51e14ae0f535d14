"""`certify` makes every kind that the checker decides, but those that say here why not."""

from __future__ import annotations

import re

from faultspace.proofs.trust.certifying import MAKERS, certify
from faultspace.proofs.trust.checker import KINDS

UNMADE = {"first-column-only": "its column is a counterexample that a search must find; the check of problem-11 searches, and makes it"}


def test_every_kind_of_the_checker_can_be_made() -> None:
    assert {*MAKERS} | {*UNMADE} == {*KINDS} and not {*MAKERS} & {*UNMADE}


def test_the_words_of_certify_name_every_kind_and_option() -> None:
    quoted = set(re.findall(r'"([\w-]+)"', certify.__doc__ or ""))
    assert {*MAKERS} <= quoted
    named = set(re.findall(r"`(\w+)`", certify.__doc__ or ""))
    assert {name for maker in MAKERS.values() for name in (*maker.needed, *maker.optional)} <= named
