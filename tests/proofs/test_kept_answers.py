"""A run of `verify` goes on where it was stopped, and says the same as one that was not."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.errors import InvalidData, InvalidInput
from faultspace.base.kept_lines import KeptLines, keeping_lines
from faultspace.proofs import deciding, kept_answers
from faultspace.proofs.adversary import attacking as of_adversary
from faultspace.proofs.kept_answers import FORMAT, KeptAnswers
from faultspace.proofs.verdict.verdicts import Report
from faultspace.proofs.verification import verify
from tests.clusters import Cluster
from tests.end_to_end.commands import ROOT, environment

FEW = ["example-v"]
MORE = ["example-v", "settle-1", "bad-set"]


def said(report: Report) -> str:
    """Return all that a run says, but how long it took."""

    def without(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: without(one) for key, one in value.items() if key != "seconds"}
        return [without(one) for one in value] if isinstance(value, list) else value

    return json.dumps(without(report.to_json()))


def test_what_was_stopped_goes_on_and_says_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, note, left = tmp_path / "kept.jsonl", KeptLines.note, [3]

    def stop(self: KeptLines, **entries: Any) -> None:
        if not left[0]:
            raise KeyboardInterrupt
        left[0] -= 1
        note(self, **entries)

    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(KeptLines, "note", stop)
        verify(FEW, jobs=1, resume=file)
    assert file.read_bytes().count(b"\n") == 3
    with file.open("ab") as stream:
        stream.write(b'{"format": "faultspace-deci')  # the stop cut a line short
    begun: list[str] = []
    real = deciding._tried

    def noted(task: Any, *more: Any) -> Any:
        begun.append(str(task))
        return real(task, *more)

    monkeypatch.setattr(deciding, "_tried", noted)
    whole = verify(FEW, jobs=1)
    every, begun[:] = len(set(begun)), []
    assert said(verify(FEW, jobs=1, resume=file)) == said(whole)
    assert len(set(begun)) == every - 3
    begun.clear()
    assert said(verify(FEW, jobs=1, resume=file)) == said(whole) and not begun


def test_answers_of_other_code_and_with_other_certificates_are_not_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "kept.jsonl"
    whole = said(verify(FEW, jobs=1, resume=file))
    lines = [json.loads(line) for line in file.read_text("utf-8").splitlines()]
    assert all(KeptAnswers("quick", KeptLines(file, FORMAT, lines)).found(line["task"]) for line in lines)
    assert KeptAnswers("full", KeptLines(file, FORMAT, lines)).count == 0
    with monkeypatch.context() as patch:
        patch.setattr(kept_answers, "made_by", lambda: {"files": "others"})
        assert KeptAnswers("quick", KeptLines(file, FORMAT, lines)).count == 0
    place = next(k for k, line in enumerate(lines) if line.get("outcome", {}).get("certificates"))
    statement = lines[place]["outcome"]["certificates"][0]["statement"]
    statement["system"]["C"][0][0] = "12345"
    file.write_text("".join(json.dumps(line) + "\n" for line in lines), "utf-8")
    assert KeptAnswers("quick", KeptLines(file, FORMAT, lines)).found(lines[place]["task"]) is None
    assert said(verify(FEW, jobs=1, resume=file)) == whole


def test_records_of_attacks_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[str] = []

    def run(attacks: Any, **_: Any) -> Any:
        for attack in attacks:
            ran.append(attack.id)
            yield {"attack": attack.id, "target": attack.target}

    monkeypatch.setattr(of_adversary, "run_attacks", run)
    kept: dict[str, Any] = {}
    first = of_adversary.attacking(
        {"theorem-1"}, "full", 1, lambda *_: None, known=kept.get, on_record=lambda one: kept.update({one["attack"]: one})
    )
    assert ran and first.records is not None and [one["attack"] for one in first.records] == ran == list(kept)
    lost = ran.pop(0)
    del kept[lost]
    before = len(ran)
    again = of_adversary.attacking({"theorem-1"}, "full", 1, lambda *_: None, known=kept.get, on_record=lambda one: None)
    assert ran[before:] == [lost] and again == first


@pytest.mark.parametrize(
    "content", [b"mine", b"n,m\n1,2\n", b'{"format": "another/1"}\n', b"[]\n", b'{"format": "x"', b"\xff\xfe", b"[" * 9000 + b"\n"]
)
def test_a_file_of_somebody_else_is_refused_and_left_as_it_is(content: bytes, tmp_path: Path) -> None:
    file = tmp_path / "mine"
    file.write_bytes(content)
    with pytest.raises(InvalidInput, match="expected a file that an earlier run kept"):
        verify(FEW, jobs=1, resume=file)
    assert file.read_bytes() == content


def test_files_that_cannot_be_had_are_told(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path, tmp_path / "nowhere" / "file", tmp_path / "pipe"):
        with pytest.raises(InvalidInput, match="--resume: got"):
            verify(FEW, jobs=1, resume=path)
    with (
        keeping_lines(tmp_path / "kept", FORMAT, bool, "--resume") as lines,
        pytest.raises(InvalidInput, match="another run works with"),
    ):
        assert not lines.lines
        verify(FEW, jobs=1, resume=tmp_path / "kept")
    for rest in (b"{", b'{"format": "' + FORMAT.encode() + b'", "att', bytes(50)):
        (tmp_path / "kept").write_bytes(rest)
        with keeping_lines(tmp_path / "kept", FORMAT, bool, "--resume") as lines:
            assert not lines.lines
        assert not (tmp_path / "kept").read_bytes()


@pytest.mark.slow
def test_a_run_that_is_killed_again_and_again_ends_with_the_same_verdicts(tmp_path: Path) -> None:
    """Ten kills; each run goes on from what those before it kept."""
    whole, file, chance = said(verify(MORE, jobs=2)), tmp_path / "kept.jsonl", random.Random()
    code = "import sys; from faultspace.proofs.verification import verify; verify(sys.argv[2:], jobs=2, resume=sys.argv[1])"
    for _ in range(10):
        process = subprocess.Popen([sys.executable, "-c", code, str(file), *MORE], cwd=ROOT, env=environment(), start_new_session=True)
        time.sleep(chance.uniform(0.5, 30.0))
        process.kill()
        process.wait()
    assert said(verify(MORE, jobs=2, resume=file)) == whole


@pytest.mark.slow
def test_killed_workers_and_a_lost_scheduler_lose_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, whole, noted, note = tmp_path / "kept.jsonl", said(verify(MORE, jobs=1)), [0], KeptLines.note
    with Cluster() as cluster:

        def noting(self: KeptLines, **entries: Any) -> None:
            noted[0] += 1
            if noted[0] == 2:
                cluster.processes[1].send_signal(signal.SIGKILL)
            if noted[0] == 6:
                cluster.processes[0].kill()
            note(self, **entries)

        monkeypatch.setattr(KeptLines, "note", noting)
        with pytest.raises(InvalidData, match="was lost"):
            verify(MORE, scheduler=cluster.address, resume=file)
    assert noted[0] >= 6
    assert said(verify(MORE, jobs=2, resume=file)) == whole
