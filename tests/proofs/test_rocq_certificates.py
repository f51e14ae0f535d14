"""Rocq's kernel and the checker agree: on every shipped certificate of a covered kind, and on well-formed mutations of small ones."""

from __future__ import annotations

import json
import re
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

from faultspace.exact.fields import QQ
from faultspace.proofs import checker, rocq_build, rocq_export
from faultspace.proofs.rocq_build import NotProved
from faultspace.proofs.rocq_export import COVERED, NotCovered, Terms, exported
from faultspace.proofs.rocq_recompute import ACCEPTED, decided, proved, recomputed, theory
from tests.end_to_end.commands import call
from tests.proofs.examples import RANKS, ROOTED, certificates, spoiled, written
from tests.proofs.test_mutations import SYSTEMS, mutated, mutations, of_one_system, of_two_systems

needs_rocq = pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
SHIPPED = [json.loads(one.read_text("utf-8")) for one in resources.files("faultspace.proofs").joinpath("certificates").iterdir()]
EVERY = 101  # mutation is tried
FALSE = spoiled(RANKS, ("statement.normal_rank", 2))


def covered(certificate: dict[str, Any]) -> bool:
    """Whether it is of a covered kind, over the rational numbers."""
    return certificate["kind"] in COVERED and '"field"' not in json.dumps(certificate)


def small_ones() -> list[dict[str, Any]]:
    """Certificates of every covered kind, systems without states, faults or outputs among them."""
    made = [c for system in SYSTEMS.values() for c in of_one_system(system)]
    return [written(c) for c in [*made, *of_two_systems(), *certificates(QQ)] if covered(c)]


@needs_rocq
def test_the_kernel_proves_every_shipped_certificate_of_a_covered_kind() -> None:
    about = [c for c in SHIPPED if covered(c)]
    assert {c["kind"] for c in about} >= {*COVERED} - {"behaviour-inclusion"}
    assert recomputed(about) == [ACCEPTED] * len(about)


@needs_rocq
def test_the_kernel_proves_small_certificates_of_every_covered_kind() -> None:
    about = small_ones()
    assert {c["kind"] for c in about} == {*COVERED}
    assert recomputed(about) == [ACCEPTED] * len(about)


@needs_rocq
def test_rocq_and_the_checker_agree_on_mutations() -> None:
    every = [(c, path, value) for c in small_ones() for path, value in mutations(c)]
    candidates = [mutated(*one) for one in every[::EVERY]]
    terms, verdicts = list[Terms](), list[bool]()
    for candidate in candidates:
        try:
            checker.verify(candidate)
            verdict = True
        except checker.Malformed:
            continue
        except checker.Rejected:
            verdict = False
        try:
            terms.append(exported(candidate))
            verdicts.append(verdict)
        except NotCovered:
            continue
        except (checker.Rejected, checker.Malformed):
            assert not verdict, candidate
    assert decided(terms, theory()) == verdicts
    assert min(verdicts.count(True), verdicts.count(False)) > 20


@needs_rocq
def test_what_computes_to_false_is_no_theorem() -> None:
    terms = exported(FALSE)
    assert decided([terms], theory()) == [False]
    with pytest.raises(NotProved, match="does not compile"):
        proved([terms], theory())
    assert [one.result for one in recomputed([FALSE, RANKS])] == ["rejected", "accepted"]


@needs_rocq
def test_a_theorem_that_rests_on_an_axiom_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rocq_export, "HEAD", f"{rocq_export.HEAD}Axiom cheat : forall b, b = true -> false.\n")
    with pytest.raises(NotProved, match=r"rests on more than the kernel.*cheat"):
        proved([Terms((), "true", "false", "cheat _")], theory())


@needs_rocq
def test_what_takes_too_long_is_undecided() -> None:
    (one,) = recomputed([RANKS], seconds=0.01)
    assert one.result == "undecided"
    assert "took more than 0.01 s" in one.reason


def test_other_kinds_and_fields_are_not_covered() -> None:
    for certificate in ROOTED, next(c for c in SHIPPED if c["kind"] == "moesp-limit"):
        with pytest.raises(NotCovered):
            exported(certificate)


def test_the_format_tells_what_is_covered_and_by_which_theorem() -> None:
    room = resources.files("faultspace.proofs")
    _, _, section = room.joinpath("FORMAT.md").read_text("utf-8").partition("## What Rocq recomputes")
    rows = dict(re.findall(r"^\| `([\w-]+)` \| (.*) \|$", section, re.M))
    assert set(rows) == set(COVERED)
    for theorems in rows.values():
        module, *_ = re.findall(r"`(\w+)\.", theorems)
        text = room.joinpath(f"rocq/{module}.v").read_text("utf-8")
        assert all(f"Theorem {name} " in text for name in re.findall(r"`(?:\w+\.)?(\w+)`", theorems))


def test_what_is_no_prime_is_rejected_before() -> None:
    with pytest.raises(checker.Rejected, match="not a prime"):
        exported(spoiled(RANKS, ("witness.prime", 2**61)))


@needs_rocq
def test_the_command_tells_what_rocq_says(tmp_path: Path) -> None:
    files = []
    for name, certificate in {"true": RANKS, "false": FALSE, "rooted": ROOTED}.items():
        files.append(str(tmp_path / f"{name}.json"))
        Path(files[-1]).write_text(json.dumps(certificate), "utf-8")
    run = call("check", "--rocq", files[0])
    assert run.code == 0
    assert "Rocq: accepted" in run.out
    run = call("check", "--rocq", "--json", *files)
    assert run.code == 1
    assert [one["rocq"]["result"] for one in json.loads(run.out)] == ["accepted", "rejected", "not covered"]
    assert call("check", "--rocq", files[2]).code == 1


def test_without_rocq_the_command_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rocq_build, "found", lambda: None)
    (tmp_path / "true.json").write_text(json.dumps(RANKS), "utf-8")
    run = call("check", "--rocq", str(tmp_path / "true.json"))
    assert run.code == 2
    assert "apt install coq libcoq-mathcomp-algebra libcoq-mathcomp-zify" in run.err
    assert call("check", str(tmp_path / "true.json")).code == 0
