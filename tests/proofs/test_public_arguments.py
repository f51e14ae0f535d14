"""What a stranger may give to `check`, `verify`, `audit` and `monte_carlo`: one for a list of one, and for nonsense a line that helps."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import faultspace as fs
from faultspace.proofs import Malformed

SYSTEM = fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]])
OTHER = fs.System(A=[["1/3"]], F=[[1]], C=[[1]], G=[[0]])
CERTIFICATE = fs.certify(SYSTEM, "schur-stable")
anything: Any = fs


@pytest.mark.parametrize("form", ["system", "dict", "name", "path"])
def test_one_system_needs_no_list(form: str, tmp_path: Path) -> None:
    file = tmp_path / "system.json"
    for system in (SYSTEM, OTHER):
        file.write_text(json.dumps(system.to_json()))
        given: Any = {"system": system, "dict": system.to_json(), "name": str(file), "path": file}[form]
        if system is SYSTEM:
            assert fs.check(CERTIFICATE, given) == fs.check(CERTIFICATE, [given])
        else:
            with pytest.raises(fs.proofs.Rejected, match="not about"):
                fs.check(CERTIFICATE, given)


CONTENTS = {
    "a system": (json.dumps(SYSTEM.to_json()), "`faultspace inspect` takes systems"),
    "a list": ("[]", "got JSON that is no certificate"),
    "no JSON": ("a,b\n1,2\n", "expected the file of a certificate"),
    "no file": (None, "[Nn]o such file"),
}


@pytest.mark.parametrize("name", list(CONTENTS))
def test_a_file_that_is_no_certificate_is_named(name: str, tmp_path: Path) -> None:
    content, words = CONTENTS[name]
    path = tmp_path / "some.json"
    if content is not None:
        path.write_text(content)
    for error in (fs.errors.InvalidInput, Malformed):
        with pytest.raises(error, match=words) as caught:
            fs.check(path)
        assert str(caught.value).startswith(f"{path}: ") and "\n" not in str(caught.value)


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "a number to check": (lambda: anything.check(3), "^certificate: got 3, expected a dict"),
    "a number as systems": (lambda: anything.check(CERTIFICATE, 3), "^systems: got 3, expected a system or a list"),
    "a number as claims": (lambda: anything.verify(3), "^claims: got 3, expected a list"),
    "no claims": (lambda: fs.verify([]), r"^claims: got \[\], expected a list of one id or more"),
    "an unknown claim": (lambda: fs.verify("example-w"), "^claim: got 'example-w', expected one of"),
    "a claim that is no name": (lambda: anything.verify([["a"]]), r"^claim: got \['a'\], expected one of"),
    "no jobs": (lambda: fs.verify("example-v", jobs=0), "^jobs: got 0, expected an integer >= 1"),
    "too few jobs": (lambda: fs.verify("example-v", jobs=-2), "^jobs: got -2"),
    "a word for jobs": (lambda: anything.verify("example-v", jobs="a"), "^jobs: got 'a'"),
    "true jobs": (lambda: fs.verify("example-v", jobs=True), "^jobs: got True"),
    "an unknown effort": (lambda: anything.verify("example-v", effort=[1]), r"^effort: got \[1\], expected one of quick, full"),
    "negative seconds": (lambda: fs.audit(only="time-shift", seconds=-1), "^seconds: got -1, expected a positive number"),
    "no seconds": (lambda: fs.audit(only="time-shift", seconds=0), "^seconds: got 0"),
    "no memory": (lambda: fs.audit(only="time-shift", gibibytes=0), "^gibibytes: got 0"),
    "seconds that are no number": (lambda: fs.audit(only="time-shift", seconds=float("nan")), "^seconds: got nan"),
    "a check that there is not": (lambda: fs.audit(only="time-shif"), "^check time-shif: there is none"),
    "a number as checks": (lambda: anything.audit(only=3), "^only: got 3, expected a list"),
    "a number as a plan": (lambda: anything.monte_carlo(3), "^plan: got 3; one of published"),
}


@pytest.mark.parametrize("name", list(WRONG))
def test_nonsense_gets_one_line(name: str) -> None:
    call, words = WRONG[name]
    with pytest.raises(fs.errors.InvalidInput, match=words):
        call()


def test_a_name_is_one_name() -> None:
    (one,) = fs.verify("example-v", jobs=1).claims
    assert one.claim.id == "example-v"
    from faultspace.numeric.audit import reference

    found = fs.audit(reference, only="fault-dimension[one-fault]")
    assert [result.function for result in found] == ["fault_dimension"]
