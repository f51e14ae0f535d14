"""What the cache holds is what was compiled; and coqchk, the second checker, reads it and MathComp below it again: no axiom."""

from __future__ import annotations

import json
import os
import shutil
import stat
import subprocess
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path

import pytest

from faultspace.cli.consoles import answers
from faultspace.cli.verdict_tables import print_machine
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq import recheck as rocq_recheck
from faultspace.proofs.rocq.recheck import second_check
from faultspace.proofs.rocq.recompute import recomputed
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.theorems import check
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import ClaimResult, Report

COQCHK = shutil.which("coqchk")
TINY = {
    "First.v": "Lemma first : True. Proof. exact I. Qed.\n",
    "Second.v": "From faultspace Require Import First.\nLemma second : True. Proof. exact first. Qed.\n",
}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Provides a cache of its own, where MathComp is found."""
    try:
        rocq_build.installation()
    except rocq_build.NoRocq as reason:
        pytest.skip(str(reason))
    monkeypatch.setattr(rocq_build, "user_cache_path", lambda name: tmp_path / name)
    return tmp_path


@pytest.mark.programs
def test_what_was_changed_in_the_cache_is_compiled_again(cache: Path) -> None:
    compiled: list[int] = []
    place = rocq_build.compiled_theory(lambda name, done, total: compiled.append(done), texts=TINY)
    assert {"First.vo", "Second.vo"} <= {one.name for one in place.iterdir()} and compiled
    compiled.clear()
    assert rocq_build.compiled_theory(lambda name, done, total: compiled.append(done), texts=TINY) == place and not compiled
    for spoil in (lambda: (place / "First.vo").unlink(), lambda: (place / "Second.vo").write_bytes(b""), lambda: shutil.rmtree(place)):
        compiled.clear()
        spoil()
        assert rocq_build.compiled_theory(lambda name, done, total: compiled.append(done), texts=TINY) == place and compiled
        assert "True" in rocq_build.compile_file(place, "Asked.v", "From faultspace Require Import Second.\nCheck second.\n")


@pytest.mark.programs
def test_a_file_that_does_not_compile_leaves_nothing(cache: Path) -> None:
    wrong = TINY | {"Second.v": "From faultspace Require Import First.\nLemma second : False. Proof. exact first. Qed.\n"}
    with pytest.raises(rocq_build.BrokenTheory, match=r"Second\.v does not compile"):
        rocq_build.compiled_theory(texts=wrong)
    assert not [one for one in (cache / "faultspace" / "rocq").iterdir() if one.is_dir()]


@pytest.mark.programs
def test_other_sources_have_another_place(cache: Path) -> None:
    assert rocq_build.compiled_theory(texts=TINY) != rocq_build.compiled_theory(texts=TINY | {"First.v": TINY["First.v"] + "(* *)\n"})


def test_without_rocq_it_is_told_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rocq_build, "found", lambda: None)
    with pytest.raises(rocq_build.NoRocq, match="apt install coq"):
        rocq_build.compiled_theory()


@pytest.mark.programs
@pytest.mark.parametrize("question", ["PLACES", "PROBE"])
def test_a_mathcomp_that_is_not_there_is_no_broken_theory(cache: Path, monkeypatch: pytest.MonkeyPatch, question: str) -> None:
    """It is not there at all, or it is another one: both are said before anything is compiled."""
    monkeypatch.setattr(rocq_build, question, "From nowhere Require Import nothing.\n")
    with pytest.raises(rocq_build.NoRocq, match="does not find MathComp"):
        rocq_build.compiled_theory(texts=TINY)
    assert not list(cache.iterdir())


@pytest.mark.programs
def test_another_mathcomp_has_another_place(cache: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The bytes of both outermost files count; MathComp is not loaded for it, so that a look at what is there takes little."""
    ours = rocq_build.installation()
    compiler = rocq_build.found()
    assert compiler is not None
    said = rocq_build._probed(compiler, rocq_build.PLACES)
    places = [Path(line) for line in said.split() if line.endswith(".vo")]
    assert [one.name for one in places] == ["all_ssreflect.vo", "all_algebra.vo"]
    for place in places:
        other = tmp_path / place.name
        other.write_bytes(place.read_bytes() + b"\n")
        monkeypatch.setattr(rocq_build, "_probed", lambda compiler, probe, a=place, b=other: said.replace(str(a), str(b)))
        assert rocq_build.installation() != ours


@pytest.mark.skipif(rocq_build.found() is None or COQCHK is None, reason=rocq_build.INSTALL)
@pytest.mark.timeout(1500)
@pytest.mark.slow
def test_the_second_checker_finds_no_axiom() -> None:
    theory = rocq_build.compiled_theory()
    assert (theory / "Headlines.vo").is_file()
    second_check(theory, 1200)


@pytest.mark.programs
@pytest.mark.skipif(rocq_build.found() is None or COQCHK is None, reason=rocq_build.INSTALL)
@pytest.mark.parametrize(
    "assumed, reason",
    [
        ("Axiom absurd : False.", "Axioms: .*absurd"),
        ("Lemma absurd : False. Admitted.", "Axioms: .*absurd"),
        ("#[bypass_check(guard)] Fixpoint absurd (n : nat) : False := absurd n.", "fixpoints: .*absurd"),
    ],
)
def test_the_second_checker_finds_what_is_assumed(cache: Path, assumed: str, reason: str) -> None:
    """It finds it also where no theorem of ours uses it."""
    theory = rocq_build.compiled_theory(texts={"First.v": f"{assumed}\n{TINY['First.v']}"})
    with pytest.raises(rocq_build.NotProved, match=reason):
        second_check(theory)


SUMMARY = """
CONTEXT SUMMARY
===============

* Theory: Set is predicative

* Axioms:{}

* Constants/Inductives relying on type-in-type:{}

* Constants/Inductives relying on unsafe (co)fixpoints: <none>

* Inductives whose positivity is assumed: <none>
"""
KERNELS_OWN = "\n    Coq.Numbers.Cyclic.Int63.PrimInt63.compares\n    Coq.Strings.PrimString.string\n  "


@pytest.mark.parametrize(
    ("axioms", "in_type", "reason"),
    [
        (" <none>", " <none>", ""),
        (KERNELS_OWN, " <none>", ""),
        (f"{KERNELS_OWN}  faultspace.First.absurd\n", " <none>", "Axioms: faultspace.First.absurd$"),
        ("\n    faultspace.Coq.Strings.PrimString.absurd\n", " <none>", r"Axioms: faultspace.Coq.Strings.PrimString.absurd$"),
        ("\n    Coq.Numbers.Cyclic.Int63.Uint63Axioms.absurd\n", " <none>", r"Axioms: Coq.Numbers.Cyclic.Int63.Uint63Axioms.absurd$"),
        (" <none>", KERNELS_OWN, "type-in-type: Coq.Numbers"),
        ("", " <none>", "Axioms: nothing was printed"),
    ],
)
def test_only_what_the_kernel_computes_with_may_be_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, axioms: str, in_type: str, reason: str
) -> None:
    """With MathComp 2, coqchk lists operations of the kernel with the axioms; it lists nothing else of a theory that rests on nothing."""
    checker = tmp_path / "coqchk"
    checker.write_text(f"#!/bin/sh\ncat >&2 <<'END'\n{SUMMARY.format(axioms, in_type)}END\n", "utf-8")
    checker.chmod(0o755)
    monkeypatch.setattr(shutil, "which", lambda name: str(checker))
    with pytest.raises(rocq_build.NotProved, match=reason) if reason else nullcontext():
        second_check(tmp_path)


@pytest.mark.programs
@pytest.mark.skipif(rocq_build.found() is None or COQCHK is None, reason=rocq_build.INSTALL)
def test_recheck_believes_nothing_that_was_compiled_before(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It does not believe even a forgery that nothing else notices: compiled files of another theory, with their digests, under our
    sources."""
    monkeypatch.setattr(rocq_recheck, "sources", lambda: TINY)
    monkeypatch.setattr(rocq_recheck, "held", lambda texts: None)
    place = rocq_build.compiled_theory(texts=TINY)
    true = (place / "Second.vo").read_bytes()
    forged = rocq_build.compiled_theory(texts=TINY | {"Second.v": TINY["Second.v"].replace("True", "0 = 0").replace("first", "eq_refl")})
    shutil.copyfile(forged / "Second.vo", place / "Second.vo")
    (place / rocq_build.DIGESTS).write_text(json.dumps(rocq_build._digests(place)), "utf-8")
    kept = place.with_suffix(".0123456789ab.json")
    kept.write_text("{}", "utf-8")
    assert rocq_build.compiled_theory(texts=TINY) == place and (place / "Second.vo").read_bytes() != true
    assert "compiled anew, and read again by coqchk" in rocq_recheck.recheck()
    assert (place / "Second.vo").read_bytes() == true and not kept.exists()


class _Judged(Exception):
    """Raised where sources are about to be compiled, with these."""


@pytest.mark.parametrize(
    "ask", [lambda: check(["lag_at_most_n"]), lambda: recomputed([]), lambda: rocq_recheck.recheck()], ids=["verify", "check", "recheck"]
)
def test_what_is_compiled_is_what_was_judged(monkeypatch: pytest.MonkeyPatch, ask: Callable[[], object]) -> None:
    """Whoever changes a source after the locks were compared has it compiled in no way."""
    true = sources()

    def stopped(texts: dict[str, str]) -> Path:
        raise _Judged(texts == true)

    monkeypatch.setattr(rocq_build, "_place", stopped)
    monkeypatch.setattr(rocq_build, "sources", lambda: TINY)
    with pytest.raises(_Judged, match="True"):
        ask()


@pytest.mark.programs
@pytest.mark.parametrize("spoil", ["source", "more", "folder", "above", "link"])
def test_a_cache_that_may_be_somebody_elses_is_not_believed(cache: Path, spoil: str) -> None:
    place = rocq_build.compiled_theory(texts=TINY)
    if spoil == "source":
        (place / "First.v").write_text("Lemma first : 0 = 0. Proof. reflexivity. Qed.\n", "utf-8")
    elif spoil == "more":
        shutil.copyfile(place / "First.vo", place / "Third.vo")
    elif spoil == "folder":
        place.chmod(0o770)
    elif spoil == "above":
        place.parent.chmod(0o777)
    else:
        shutil.move(place / "First.vo", cache / "First.vo")
        (place / "First.vo").symlink_to(cache / "First.vo")
    (place / rocq_build.DIGESTS).write_text(json.dumps(rocq_build._digests(place)), "utf-8")
    with pytest.raises(rocq_build.Poisoned, match=r"is not believed: .* verify --recheck"):
        rocq_build.compiled_theory(texts=TINY)


@pytest.mark.programs
def test_a_cache_of_another_user_is_not_believed(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rocq_build.compiled_theory(texts=TINY)
    me = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: me + 1)
    with pytest.raises(rocq_build.Poisoned, match="others than you"):
        rocq_build.compiled_theory(texts=TINY)
    with pytest.raises(rocq_build.NoRocq, match=r"belongs to another user; set XDG_CACHE_HOME"):
        rocq_build.compiled_theory(texts={"First.v": TINY["First.v"]})


@pytest.mark.programs
def test_what_is_compiled_is_for_the_user_alone(cache: Path) -> None:
    before = os.umask(0)
    try:
        place = rocq_build.compiled_theory(texts=TINY)
    finally:
        os.umask(before)
    assert [stat.S_IMODE(one.stat().st_mode) for one in (place, place.parent, place.parent.parent)] == [0o700] * 3


@pytest.mark.programs
def test_the_same_source_is_compiled_to_the_same_bytes(cache: Path) -> None:
    """By this a vocabulary in the cache is known to be ours."""
    place = rocq_build.compiled_theory(texts=TINY)
    assert rocq_build.compiled_again({"First.v": TINY["First.v"]}) == {"First.v": (place / "First.vo").read_bytes()}
    other = rocq_build.compiled_again({"First.v": TINY["First.v"].replace("True", "0 = 0").replace("exact I", "reflexivity")})
    assert other["First.v"] != (place / "First.vo").read_bytes()


@pytest.mark.programs
@pytest.mark.parametrize(
    "text, reason",
    [
        ("Fixpoint count n := match n with 0 => 0 | S m => count m + count m end.\nEval vm_compute in count 60.\n", "took more than 1 s"),
        ('Goal True. do 100000000 idtac "x". Abort.\n', "took more than|was stopped"),
        ('Redirect "stolen" Check True.\n', "says Redirect"),
        ('Extraction "stolen" nat.\n', "says Extraction"),
        ('Load "stolen".\n', "says Load"),
        ('Declare ML Module "stolen".\n', "says Declare ML"),
    ],
)
def test_coqc_runs_under_limits(cache: Path, text: str, reason: str) -> None:
    place = rocq_build.compiled_theory(texts=TINY)
    with pytest.raises(rocq_build.BrokenTheory, match=reason):
        rocq_build.compile_file(place, "Asked.v", text, seconds=1)


@pytest.mark.programs
@pytest.mark.parametrize(
    "limit, most, text",
    [
        ("MOST_MEMORY", 2**28, "From mathcomp Require Import all_ssreflect all_algebra.\n"),
        ("MOST_WRITTEN", 2**15, 'Goal True. do 5000 idtac "0123456789". Abort.\n'),
        ("MOST_PRINTED", 2**12, 'Goal True. do 5000 idtac "0123456789". Abort.\n'),
    ],
)
def test_memory_and_output_are_limited(cache: Path, monkeypatch: pytest.MonkeyPatch, limit: str, most: int, text: str) -> None:
    place = rocq_build.compiled_theory(texts=TINY)
    rocq_build.compile_file(place, "Asked.v", text)
    monkeypatch.setattr(rocq_build, limit, most)
    with pytest.raises(rocq_build.BrokenTheory, match="was stopped" if limit != "MOST_MEMORY" else "Rocq was stopped|does not compile"):
        rocq_build.compile_file(place, "Asked.v", text)


@pytest.mark.programs
def test_coqc_has_a_home_of_its_own(cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A compiler made for the test prints where it runs."""
    compiler = tmp_path / "coqc"
    compiler.write_text('#!/bin/sh\necho "$HOME"; echo "$TMPDIR"; pwd; ulimit -t\n', "utf-8")
    compiler.chmod(0o755)
    monkeypatch.setattr(rocq_build, "found", lambda: rocq_build.Rocq(str(compiler), "0"))
    home, scratch, folder, seconds = rocq_build.compile_file(tmp_path, "Asked.v", "Check True.\n", seconds=7).split()
    assert home == scratch and not Path(home).exists() and not Path(folder).exists() and int(seconds) == 8
    assert Path.home() not in (Path(home), Path(folder)) and Path.cwd() != Path(folder)


@pytest.mark.programs
def test_coqc_is_not_told_where_to_load_from(cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A compiler made for the test prints its environment: of the user's, what GIVEN names, and nothing that could load other files."""
    misleading = ("COQPATH", "ROCQPATH", "OCAMLPATH", "COQLIB", "ROCQLIB", "COQBIN", "COQCORELIB", "CAML_LD_LIBRARY_PATH", "OCAMLFIND_CONF",
                  "LD_PRELOAD", "LD_LIBRARY_PATH", "OCAMLRUNPARAM", "CAMLRUNPARAM", "COQEXTRAFLAGS", "DYLD_INSERT_LIBRARIES")  # fmt: skip
    for name in misleading:
        monkeypatch.setenv(name, str(tmp_path / "misled"))
    for program in ("coqc", "coqchk"):
        (tmp_path / program).write_text(f"#!/bin/sh\n/usr/bin/env > {tmp_path}/{program}.said; echo 9.9 9.9\n", "utf-8")
        (tmp_path / program).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    rocq_build.found.cache_clear()
    try:
        assert rocq_build.found() == rocq_build.Rocq(str(tmp_path / "coqc"), "9.9")
        rocq_build.compile_file(tmp_path, "Asked.v", "Check True.\n")
        with pytest.raises(rocq_build.NotProved):
            second_check(tmp_path)
    finally:
        rocq_build.found.cache_clear()
    for program in ("coqc", "coqchk"):
        said = (tmp_path / f"{program}.said").read_text("utf-8")
        names = {line.partition("=")[0] for line in said.splitlines()} - {"_", "PWD", "SHLVL", "OLDPWD"}
        assert names <= {*rocq_build.GIVEN, "HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "OCAMLRUNPARAM"} and "misled" not in said
        assert "HOME" in names, "else they load from .local/share/coq of the folder where they are started"


@pytest.mark.programs
@pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
def test_a_folder_mathcomp_on_coqpath_is_not_believed_and_what_is_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "mathcomp" / "ssreflect"
    other.mkdir(parents=True)
    (other / "all_ssreflect.v").write_text("Definition forged := tt.\n", "utf-8")
    subprocess.run(["coqc", "-q", "-R", str(tmp_path / "mathcomp"), "mathcomp", str(other / "all_ssreflect.v")], check=True)
    monkeypatch.setenv("COQPATH", str(tmp_path))
    (tmp_path / "coqc").write_text(f'#!/bin/sh\nexec {shutil.which("coqc")} "$@"\n', "utf-8")
    (tmp_path / "coqc").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    for kept in (rocq_build.found, rocq_build._probed):
        kept.cache_clear()
    try:
        believed = rocq_build.believed()
    finally:
        for kept in (rocq_build.found, rocq_build._probed):
            kept.cache_clear()
    assert believed["coqc"] == str(tmp_path / "coqc"), "a coqc that stands first on the path is told by its place"
    assert str(tmp_path) not in str(believed["mathcomp"]) and str(believed["mathcomp"]).endswith("mathcomp")
    words = rocq_build.told(believed)
    assert all(str(believed[name]) in words for name in ("coqc", "version", "mathcomp")) and "coqchk" in words
    claim = next(one for one in load() if one.id == "example-v")
    print_machine(answers(), Report("quick", (ClaimResult(claim, ()),), (), "", 0.0, "asked", believed))
    assert " ".join(words.split()) in " ".join(capsys.readouterr().out.split())
    assert Report("quick", (), (), "", 0.0, "asked", believed).to_json()["believed"] == believed


@pytest.mark.programs
def test_a_cache_that_cannot_be_written_is_no_broken_theory(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The verdicts then rest on certificates, and the run says why."""
    (cache / "file").write_text("", "utf-8")
    monkeypatch.setattr(rocq_build, "user_cache_path", lambda name: cache / "file" / name)
    with pytest.raises(rocq_build.NoRocq, match="XDG_CACHE_HOME"):
        rocq_build.compiled_theory(texts=TINY)
