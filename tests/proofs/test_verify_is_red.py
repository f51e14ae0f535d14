"""`verify` fails, and says why, when a headline, a word or the cache is not what it was: each tried on a copy."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from faultspace.cli import verifying
from faultspace.proofs import verification
from faultspace.proofs.deciding import Answer, Check
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq import theorems as machine_checked
from faultspace.proofs.rocq.build import DIGESTS, compile_file, compiled_again
from faultspace.proofs.rocq.locks import held
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.statements import read
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import Outcome, Verdict

CLAIM = "proposition-3"
TEXTS = sources()


@pytest.fixture(autouse=True)
def _no_systems(monkeypatch: pytest.MonkeyPatch) -> None:
    """The systems say what the ledger expects, at once: what is tried here is Rocq's part."""

    expected = {reading.check: reading.expected for claim in load() for reading in claim.readings if claim.id == CLAIM}

    def agrees(bench: object, tasks: Sequence[Check], *, elsewhere: bool, kept: object) -> dict[Check, Answer]:
        return {task: Answer(Outcome(Verdict(expected[task.name]), "as expected"), 0.0) for task in tasks}

    monkeypatch.setattr(verification, "decided", agrees)
    monkeypatch.setattr(verification, "ablations", tuple)


def verify(capsys: pytest.CaptureFixture[str]) -> tuple[int, Any]:
    """Returns the exit code of `faultspace verify --claim ... --json`, and what it prints."""
    capsys.readouterr()
    code = verifying.run([CLAIM], effort="quick", jobs=1, out=None, rocq=True, recheck=False, as_json=True)
    return code, json.loads(capsys.readouterr().out)


def red(report: Any, why: str) -> None:
    """Asserts that every reading that has a theorem is an ERROR, for this reason, and that the run says it too."""
    readings = [one for claim in report["claims"] for one in claim["readings"]]
    named = {r.id for claim in load() if claim.id == CLAIM for r in claim.readings if r.theorems}
    assert named and {one["reading"] for one in readings if one["verdict"] == "ERROR"} == named
    assert all(re.search(why, one["evidence"]) for one in readings if one["verdict"] == "ERROR"), readings
    assert not any(one["locks"] or one["theorems"] for one in readings)


CHANGES = {
    "a headline weakened": ("Headlines.v", "(n <= s)%N -> \\rank (window S s.+1) = (\\rank (window S s) + m)%N <->", "(n < s)%N ->"),
    "a hypothesis added": ("Headlines.v", "(n <= s)%N -> \\rank (window S s.+1)", "observable S -> (n <= s)%N -> \\rank (window S s.+1)"),
    "a headline made trivial": ("HeadlinesMore.v", "\\rank (window S s) = (s * \\rank (transfer S)", "0 = (0 * \\rank (transfer S)"),
    "a definition changed": ("Vocabulary.v", "v k = 0) -> forall k, v k = 0", "v k = 0) -> forall k, v k = v k"),
    "a field changed": ("Vocabulary.v", "Variables (K : fieldType) (n m p : nat).", "Variables (K : realFieldType) (n m p : nat)."),
    "an axiom added": ("Gap.v", "Section Gap.", "Axiom absurd : False.\nSection Gap."),
    "a proof left open": ("Gap.v", "Qed.", "Admitted."),
    "a definition in a file of headlines": ("Headlines.v", "(** ** theorem-1 *)", "Definition left_invertible := True."),
    "a notation in a file of headlines": ("Headlines.v", "(** ** theorem-1 *)", 'Local Notation "a <-> b" := True.'),
}
WHY = {
    "a definition changed": r"the word Vocabulary\.left_invertible says .*forall k, v k = v k",
    "a field changed": r"the word Vocabulary\.\w+ says .*realFieldType",
    "an axiom added": r"Gap\.v has Axiom",
    "a proof left open": r"Gap\.v has Admitted",
    "a definition in a file of headlines": "holds theorems alone",
    "a notation in a file of headlines": "holds theorems alone",
}


@pytest.mark.parametrize("what", CHANGES)
def test_a_change_of_the_sources_is_told(what: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """It is told before anything is compiled, so with and without Rocq."""
    file, old, new = CHANGES[what]
    assert old in TEXTS[file]
    monkeypatch.setattr(machine_checked, "sources", lambda: {**TEXTS, file: TEXTS[file].replace(old, new, 1)})
    code, report = verify(capsys)
    assert code == 1
    red(report, WHY.get(what, r"the headline \w+ says .* where its lock has "))


def test_the_locks_are_told_without_rocq_too(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(rocq_build, "found", lambda: None)
    code, report = verify(capsys)
    assert code == 0 and "coqc is not on the path" in report["rocq"]
    for one in report["claims"][0]["readings"]:
        named = next(r.theorems for claim in load() if claim.id == CLAIM for r in claim.readings if r.id == one["reading"])
        assert one["locks"] == {name: held(TEXTS).theorems[name].sha256 for name in named} and not one["theorems"]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, theory: Path) -> Path:
    """Provides a copy of the compiled theory, in a cache of its own."""
    monkeypatch.setattr(rocq_build, "user_cache_path", lambda name: tmp_path / name)
    copied = tmp_path / "faultspace" / "rocq" / theory.name
    rocq_build._made_private(copied.parent)
    shutil.copytree(theory, copied)
    return copied


def digests_computed_again(place: Path) -> None:
    """Writes the digests anew, as a careful forger does."""
    (place / DIGESTS).write_text(json.dumps(rocq_build._digests(place)), "utf-8")


def all_true(place: Path) -> str:
    """Compiles Headlines.v with `True` in the place of every statement into the folder."""
    names = read(TEXTS).headlines
    text = "\n".join(f"Theorem {name} : True. Proof. exact I. Qed." for name in names) + "\n"
    compile_into(place, "Headlines.v", text)
    return text


def compile_into(place: Path, name: str, text: str) -> None:
    """Compiles another source in the place of one of ours, whose text stays."""
    (place / name).write_text(text, "utf-8")
    rocq_build._coqc(place / name, rocq_build.OPTIONS, 300)
    (place / name).write_text(TEXTS[name], "utf-8")


def once(again: Callable[[Mapping[str, str]], dict[str, bytes]]) -> Callable[[Mapping[str, str]], dict[str, bytes]]:
    """Returns a function that compiles the same sources once only, and gives what that made."""
    kept: dict[str, dict[str, bytes]] = {}

    def compiled(texts: Mapping[str, str]) -> dict[str, bytes]:
        key = json.dumps(texts, sort_keys=True)
        if key not in kept:
            kept[key] = again(texts)
        return kept[key]

    return compiled


@pytest.mark.long
@pytest.mark.timeout(900)
@pytest.mark.slow
def test_a_poisoned_cache_is_told(place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """It is poisoned in four ways, one after the other, each with digests that are right; what was there before each is put back.
    What coqc makes of our vocabularies, to compare with, is made once."""
    monkeypatch.setattr(machine_checked, "compiled_again", once(compiled_again))
    code, report = verify(capsys)
    assert code == 0 and "all as locked" in report["rocq"]
    locks = {name: lock for claim in report["claims"] for one in claim["readings"] for name, lock in one["locks"].items()}
    assert locks and all(held(TEXTS).theorems[name].sha256 == lock for name, lock in locks.items())
    kept = shutil.copytree(place, place.parent / "kept")

    def put_back() -> None:
        shutil.rmtree(place)
        shutil.copytree(kept, place)

    (place / "Headlines.v").write_text(all_true(place), "utf-8")
    of_true = {one.name: one.read_bytes() for one in place.glob("Headlines.*") if one.suffix != ".v"}
    digests_computed_again(place)
    code, report = verify(capsys)
    assert code == 1
    red(report, r"its sources are not those of this package: Headlines\.v")

    put_back()
    for name, compiled in of_true.items():
        (place / name).write_bytes(compiled)
    digests_computed_again(place)
    code, report = verify(capsys)
    assert code == 1
    red(report, r"the compiled theorem \w+ does not say what our source says")

    put_back()
    compile_into(place, "Vocabulary.v", TEXTS["Vocabulary.v"].replace("-> forall k, v k = 0.", "-> forall k, v k = v k."))
    digests_computed_again(place)
    code, report = verify(capsys)
    assert code == 1
    red(report, r"its Vocabulary\.v was not compiled from ours")

    put_back()
    place.chmod(0o777)
    code, report = verify(capsys)
    assert code == 1
    red(report, "others than you can write into it")

    put_back()
    assert verify(capsys)[0] == 0
    damaged = (place / "Vocabulary.vo").read_bytes()
    (place / "Vocabulary.vo").write_bytes(damaged[:-1])
    assert not rocq_build._whole(place, TEXTS), "what is only damaged is compiled again"


@pytest.mark.timeout(900)
@pytest.mark.slow
def test_an_answer_is_kept_for_the_files_that_it_is_about(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert verify(capsys)[0] == 0
    (answer,) = place.parent.glob(f"{place.name}.*.json")
    said = json.loads(answer.read_text("utf-8"))
    asked: list[str] = []
    original = compile_file

    def counted(theory: Path, name: str, text: str, **more: Any) -> str:
        asked.append(name)
        return original(theory, name, text, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(machine_checked, "compile_file", counted)
        assert verify(capsys)[0] == 0 and not asked
        answer.write_text(json.dumps({**said, "files": "0" * 64, "said": "forged"}), "utf-8")
        assert verify(capsys)[0] == 0 and asked == ["Asked.v"]
        answer.write_text("not json", "utf-8")
        assert verify(capsys)[0] == 0 and asked == ["Asked.v"] * 2
