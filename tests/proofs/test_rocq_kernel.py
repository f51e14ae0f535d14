"""What the cache holds is what was compiled; and coqchk, the second checker, reads it and MathComp below it again: no axiom."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from faultspace.proofs import rocq_build

COQCHK = shutil.which("coqchk")
TINY = {
    "First.v": "Lemma first : True. Proof. exact I. Qed.\n",
    "Second.v": "From faultspace Require Import First.\nLemma second : True. Proof. exact first. Qed.\n",
}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of its own, where MathComp is found."""
    try:
        rocq_build.installation()
    except rocq_build.NoRocq as reason:
        pytest.skip(str(reason))
    monkeypatch.setattr(rocq_build, "user_cache_path", lambda name: tmp_path / name)
    return tmp_path


def test_what_was_changed_in_the_cache_is_compiled_again(cache: Path) -> None:
    told: list[int] = []
    place = rocq_build.compiled_theory(lambda name, done, total: told.append(done), texts=TINY)
    assert {"First.vo", "Second.vo"} <= {one.name for one in place.iterdir()} and told
    told.clear()
    assert rocq_build.compiled_theory(lambda name, done, total: told.append(done), texts=TINY) == place and not told
    for spoil in (lambda: (place / "First.vo").unlink(), lambda: (place / "Second.vo").write_bytes(b""), lambda: shutil.rmtree(place)):
        told.clear()
        spoil()
        assert rocq_build.compiled_theory(lambda name, done, total: told.append(done), texts=TINY) == place and told
        assert "True" in rocq_build.compile_file(place, "Asked.v", "From faultspace Require Import Second.\nCheck second.\n")


def test_a_file_that_does_not_compile_leaves_nothing(cache: Path) -> None:
    wrong = TINY | {"Second.v": "From faultspace Require Import First.\nLemma second : False. Proof. exact first. Qed.\n"}
    with pytest.raises(rocq_build.BrokenTheory, match=r"Second\.v does not compile"):
        rocq_build.compiled_theory(texts=wrong)
    assert not [one for one in (cache / "faultspace" / "rocq").iterdir() if one.is_dir()]


def test_other_sources_have_another_place(cache: Path) -> None:
    assert rocq_build.compiled_theory(texts=TINY) != rocq_build.compiled_theory(texts=TINY | {"First.v": TINY["First.v"] + "(* *)\n"})


def test_without_rocq_it_is_told_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rocq_build, "found", lambda: None)
    with pytest.raises(rocq_build.NoRocq, match="apt install coq"):
        rocq_build.compiled_theory()


def test_a_mathcomp_that_is_not_there_is_no_broken_theory(monkeypatch: pytest.MonkeyPatch) -> None:
    if rocq_build.found() is None:
        pytest.skip(rocq_build.INSTALL)
    monkeypatch.setattr(rocq_build, "PROBE", "From nowhere Require Import nothing.\n")
    with pytest.raises(rocq_build.NoRocq, match="does not find MathComp"):
        rocq_build.installation()


@pytest.mark.skipif(rocq_build.found() is None or COQCHK is None, reason=rocq_build.INSTALL)
@pytest.mark.timeout(1500)
def test_the_second_checker_finds_no_axiom() -> None:
    theory = rocq_build.compiled_theory()
    names = [f"faultspace.{one.stem}" for one in sorted(theory.glob("*.vo"))]
    assert "faultspace.Headlines" in names
    command = [str(COQCHK), "-silent", "-o", "-Q", str(theory), "faultspace", *names]
    told = subprocess.run(command, capture_output=True, text=True, check=False, timeout=1200)
    assert told.returncode == 0, told.stderr[-2000:]
    for heading in ("Axioms", "Constants/Inductives relying on type-in-type", "Constants/Inductives relying on unsafe (co)fixpoints"):
        assert f"* {heading}: <none>" in told.stdout + told.stderr, told.stderr[-2000:]  # with -silent it tells them on standard error


def test_a_cache_that_cannot_be_written_is_no_broken_theory(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The verdicts then rest on certificates, and the run says why."""
    (cache / "file").write_text("", "utf-8")
    monkeypatch.setattr(rocq_build, "user_cache_path", lambda name: cache / "file" / name)
    with pytest.raises(rocq_build.NoRocq, match="XDG_CACHE_HOME"):
        rocq_build.compiled_theory(texts=TINY)
