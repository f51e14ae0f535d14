"""`faultspace monitor`: streams and growing files, what it prints, and what it refuses.

plant       a folder with model.json, a healthy record and a stream with a fault from sample 150 on
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.cli.argument_names import as_options, of_file
from faultspace.numeric import StateSpaceModel
from tests.end_to_end.commands import ROOT, Run, call, command, environment
from tests.numeric.test_monitor import loop

MODEL = StateSpaceModel([[0.7]], [[1.0]], [[1.0], [0.5]], [[0.0], [0.0]])
OPTIONS = ("--window", "5", "--level", "0.001")


def table(seed: int, samples: int, fault: float = 0.0) -> str:
    """Return a table of time, y2, u, y1, in this order."""
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((samples, 1))
    y = MODEL.simulate(u) + 0.1 * draw.standard_normal((samples, 2))
    y[150:, 1] += fault
    lines = [f"{k},{two:.6g},{push:.6g},{one:.6g}" for k, ((push,), (one, two)) in enumerate(zip(u, y, strict=True))]
    return "\n".join(["time,level,valve,flow", *lines]) + "\n"


@pytest.fixture(scope="module")
def plant(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("plant")
    (folder / "model.json").write_text(json.dumps(MODEL.to_json() | {"inputs": ["valve"], "outputs": ["flow", "level"]}))
    (folder / "healthy.csv").write_text(table(1, 400))
    (folder / "short.csv").write_text(table(1, 40))
    (folder / "stream.csv").write_text(table(2, 250, fault=1.0))
    watch = fs.Monitor(MODEL, folder / "healthy.csv", inputs="valve", outputs=["flow", "level"], level=1e-3, window=5)
    watch.save(folder / "watch.json")
    return folder


def followed_run(plant: Path, file: Path, *more: str) -> Run:
    """Run on a file in this process, until nothing comes any more."""
    return call("monitor", str(plant), "--healthy", str(plant / "healthy.csv"), "--follow", str(file), "--idle", "0.1", *OPTIONS, *more)


def alarms(run: Run) -> list[dict[str, Any]]:
    """Return the alarms of a run with --json, whose last line is the summary."""
    lines = [json.loads(line) for line in run.out.splitlines()]
    assert run.code == 0 and [set(line) for line in lines] == [{"alarm"}] * (len(lines) - 1) + [{"summary"}]
    return [line["alarm"] for line in lines[:-1]]


def test_a_stream_and_a_file_give_the_same_alarms(plant: Path) -> None:
    streamed = command(
        "monitor", str(plant / "model.json"), "--healthy", str(plant / "healthy.csv"), *OPTIONS, stdin=(plant / "stream.csv").read_bytes()
    )
    from_file = followed_run(plant, plant / "stream.csv")
    assert streamed.code == from_file.code == 0 and streamed.out == from_file.out
    first = streamed.out.splitlines()[0]
    assert first.startswith("sample 15") and "outputs level, since about sample 1" in first
    assert "monitor of 2 outputs and 1 input" in streamed.out and "healthy samples cannot show 0.001 false alarms" in from_file.err


def test_a_model_with_monitoring_needs_nothing_beside_it_and_a_saved_monitor_goes_on(plant: Path, tmp_path: Path) -> None:
    learned = json.loads((plant / "watch.json").read_text())
    (tmp_path / "model.json").write_text(json.dumps(json.loads((plant / "model.json").read_text()) | {"monitoring": learned}))
    head, *lines = (plant / "stream.csv").read_text().splitlines()
    (tmp_path / "one.csv").write_text("\n".join([head, *lines[:152]]) + "\n")
    (tmp_path / "two.csv").write_text("\n".join([head, *lines[152:]]) + "\n")
    alone = call("monitor", str(tmp_path), "--follow", str(plant / "stream.csv"), "--idle", "0.1", "--level", "0.001", "--json")
    kept = str(tmp_path / "kept.json")
    parts = [
        call("monitor", model, "--follow", str(tmp_path / file), "--idle", "0.1", "--save", kept, "--json")
        for model, file in ((str(tmp_path), "one.csv"), (kept, "two.csv"))
    ]
    beside = followed_run(plant, plant / "stream.csv", "--json")
    assert alarms(alone) == alarms(beside) == alarms(parts[0]) + alarms(parts[1]) != []
    assert alone.out.splitlines()[-1] == parts[1].out.splitlines()[-1] and "healthy samples cannot show" in alone.err


def test_json_lines_end_with_the_summary(plant: Path) -> None:
    run = followed_run(plant, plant / "stream.csv", "--json")
    found = alarms(run)
    assert found[0]["outputs"] == ["level"] and 150 <= found[0]["sample"] <= 155
    summary = json.loads(run.out.splitlines()[-1])["summary"]
    assert summary["samples"] == 250 and sum(summary["alarms"].values()) == len(found)


def test_the_beginning_of_the_stream_can_be_the_healthy_record(plant: Path, tmp_path: Path) -> None:
    both = tmp_path / "both.csv"
    both.write_text(table(3, 400) + (plant / "stream.csv").read_text().partition("\n")[2])
    run = call("monitor", str(plant), "--healthy-until", "400", "--follow", str(both), "--idle", "0.1", *OPTIONS, "--json")
    assert 550 <= alarms(run)[0]["sample"] <= 556
    short = call("monitor", str(plant), "--healthy-until", "4000", "--follow", str(both), "--idle", "0.1")
    assert short.code == 2 and "--healthy-until: got 650 samples without a gap, expected 4000" in short.err


def test_an_empty_field_is_a_missing_sample(plant: Path, tmp_path: Path) -> None:
    lines = (plant / "stream.csv").read_text().splitlines()
    for k in range(20, 60):
        fields = lines[k].split(",")
        lines[k] = ",".join([fields[0], "", *fields[2:]])
    (tmp_path / "gaps.csv").write_text("\n".join(lines) + "\n")
    found = alarms(followed_run(plant, tmp_path / "gaps.csv", "--json"))
    assert [one["outputs"] for one in found if one["test"] == "missing"] == [["level"]]
    assert any(one["test"] == "cusum" and one["sample"] >= 150 for one in found)


@pytest.mark.parametrize(
    ("words", "parts"),
    [
        (["monitor", "{plant}"], 'model.json: the model has no "monitoring"'),
        (["monitor", "{plant}/watch.json", "--healthy", "x.csv"], "watch.json: got a saved monitor, which is calibrated"),
        (["monitor", "{plant}/watch.json", "--window", "7"], "--window: got 7, but the file is calibrated for windows of 5"),
        (["monitor", "{plant}/watch.json", "--outputs", "a"], "watch.json: got 'a' for 2 outputs"),
        (["monitor", "{plant}/watch.json", "--level", "0"], "--level: got '0', expected a positive number"),
        (["monitor", "{plant}/watch.json", "--save", "{plant}/stream.csv"], "stream.csv: is there, and no saved monitor"),
        (["monitor", "{plant}/watch.json", "--save", "{plant}/no/x.json", "--follow", "{plant}/stream.csv"], "x.json: cannot be written"),
        (["monitor", "{plant}", "--healthy", "x.csv", "--healthy-until", "9"], "got both, expected one at most"),
        (["monitor", "{plant}", "--healthy", "{plant}/healthy.csv", "--idle", "1"], "--idle: got no --follow"),
        (["monitor", "{plant}", "--healthy", "{plant}/healthy.csv", "--follow", "{plant}/none.csv"], "none.csv: is no file"),
        (["monitor", "{plant}", "--healthy", "{plant}/short.csv"], "short.csv: --healthy: 30 samples of errors are too few"),
        (["monitor", "{plant}", "--healthy", "none.csv"], "none.csv: cannot be read"),
        (["monitor", "{plant}/healthy.csv", "--healthy", "x.csv"], "expected JSON"),
        (["monitor", "{plant}", "--healthy", "{plant}/healthy.csv", "--outputs", "flow"], "got 'flow' for 2 outputs of the model"),
        (["monitor", "{plant}", "--healthy", "{plant}/healthy.csv", "--inputs", "pump"], "there is no column (separated by comma) 'pump'"),
        (["monitor", "{plant}", "--healthy", "{plant}/healthy.csv", "--window", "1"], "--window: got '1', expected a whole number from 2"),
        (["monitor", "{plant}", "--healthy", "{plant}/healthy.csv", "--level", "2"], "level: got 2.0; needed the false alarms a sample"),
    ],
)
def test_what_cannot_be_watched_is_refused_in_a_line(plant: Path, words: list[str], parts: str) -> None:
    run = call(*(word.format(plant=plant) for word in words))
    assert run.code == 2 and parts in run.err and run.err.count("\n") == 1 and run.out == ""


def test_lines_that_are_none_are_missing_samples_and_the_summary_counts_them(plant: Path, tmp_path: Path) -> None:
    head, *rows = (plant / "stream.csv").read_bytes().splitlines(keepends=True)
    lines = [head, *rows[:100], b"1,x,2,3\n", *rows[101:200], b"1,2\n", b"1,2,\xff,3\n", *rows[202:]]
    (tmp_path / "bad.csv").write_bytes(b"".join(lines))
    run = followed_run(plant, tmp_path / "bad.csv", "--json")
    assert "bad.csv: line 102, column 'level': got 'x', expected a number; it counts as a missing sample, 1 so far" in run.err
    assert alarms(run)[0]["sample"] in range(150, 156)
    summary = json.loads(run.out.splitlines()[-1])["summary"]
    assert (summary["bad_lines"], summary["samples"], summary["missing"]) == (3, 250, [3, 3])
    assert followed_run(plant, tmp_path / "bad.csv").out.endswith("\n3 lines that were no samples\n")


def test_a_gap_in_the_stream_of_an_unstable_plant(tmp_path: Path) -> None:
    y, u = loop(1.2, 1, 2000)
    fs.Monitor(StateSpaceModel([[1.2]], [[1.0]], [[1.0]], [[0.0]]), y, u).save(tmp_path / "watch.json")
    y, u = loop(1.2, 2, 800)
    y[500:] += 5.0
    rows = [f"{push},{'' if 100 <= k < 400 else out}" for k, ((push,), (out,)) in enumerate(zip(u, y, strict=True))]
    (tmp_path / "stream.csv").write_text("\n".join(["u1,y1", *rows]) + "\n")
    kept = tmp_path / "kept.json"
    stream = str(tmp_path / "stream.csv")
    run = call("monitor", str(tmp_path / "watch.json"), "--follow", stream, "--idle", "0.1", "--save", str(kept), "--json")
    assert {one["sample"] for one in alarms(run)} <= {119, 500, 501} and fs.Monitor.load(kept).samples == 800
    assert "too much was missing for an unstable model, whose state is as unknown as at the start (1 time so far)" in run.err
    assert f"goes on with sample 800 of the stream, counted from 0, line 802 of {tmp_path}" in run.err


def started(*words: str, stdin: int | None = None) -> subprocess.Popen[str]:
    """Start the command; a shell that starts the tests in the background may have told all its children to ignore interrupts."""
    heard = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); signal.signal(signal.SIGHUP, signal.SIG_DFL); "
    line = [sys.executable, "-c", f"{heard}from faultspace.cli.command_line import main; sys.exit(main(sys.argv[1:]))", "monitor", *words]
    return subprocess.Popen(line, stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT, env=environment(), text=True)


@pytest.mark.parametrize(("number", "said"), [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "terminated"), (signal.SIGHUP, "hung up")])
def test_a_signal_ends_with_the_summary_and_what_is_saved_goes_on(plant: Path, tmp_path: Path, number: int, said: str) -> None:
    head, *rows = (plant / "stream.csv").read_text().splitlines(keepends=True)
    file, kept = tmp_path / "log.csv", str(tmp_path / "kept.json")
    file.write_text("".join([head, *rows[:152]]))
    first = started(str(plant / "watch.json"), "--follow", str(file), "--save", kept, "--json")
    assert first.stdout is not None and "alarm" in json.loads(first.stdout.readline())
    os.kill(first.pid, number)
    out, err = first.communicate(timeout=100)
    assert first.returncode == 128 + number and "summary" in json.loads(out.splitlines()[-1]) and err.endswith(f"faultspace: {said}\n")
    with open(file, "a") as stream:
        stream.write("".join(rows[152:]))
    second = call("monitor", kept, "--follow", str(file), "--idle", "0.1", "--save", kept, "--json")
    assert "goes on behind line 15" in second.err
    whole = call("monitor", str(plant / "watch.json"), "--follow", str(plant / "stream.csv"), "--idle", "0.1", "--json")
    assert whole.out.splitlines()[-1] == second.out.splitlines()[-1]  # the summary counts every alarm once


def test_an_error_of_ours_ends_with_the_summary(plant: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    taken = fs.Monitor._sample

    def fails(watch: fs.Monitor, y: Any, u: Any) -> Any:
        if watch.samples == 200:
            raise RuntimeError("broken")
        return taken(watch, y, u)

    monkeypatch.setattr(fs.Monitor, "_sample", fails)
    run = call("monitor", str(plant / "watch.json"), "--follow", str(plant / "stream.csv"), "--idle", "0.1", "--json")
    assert run.code == 70 and json.loads(run.out.splitlines()[-1])["summary"]["samples"] == 200


def test_standard_input_that_is_closed_or_of_one_line(plant: Path) -> None:
    for words in (f"monitor {plant}/watch.json", "inspect -"):
        line = f"{sys.executable} -m faultspace {words} <&-"
        run = subprocess.run(line, shell=True, capture_output=True, cwd=ROOT, env=environment(), text=True)
        assert run.returncode == 2 and "standard input: is closed" in run.stderr and run.stderr.count("\n") == 1
    endless = "import sys, resource; from faultspace.cli import monitoring; from faultspace.cli.command_line import main; "
    endless += "held = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize(); "
    endless += "resource.setrlimit(resource.RLIMIT_AS, (held + (1 << 28),) * 2); sys.exit(main(['monitor', sys.argv[1]]))"
    source = "import os\nfor _ in range(128): os.write(1, b'7' * (1 << 22))"  # twice of what there is room for
    line = f'{sys.executable} -c "{source}" | {sys.executable} -c "{endless}" {plant}/watch.json'
    run = subprocess.run(line, shell=True, capture_output=True, cwd=ROOT, env=environment(), text=True)
    assert run.returncode == 0 and "the last line has no end, and is no sample" in run.stderr


def test_a_table_without_names_is_read_by_numbers(plant: Path, tmp_path: Path) -> None:
    (tmp_path / "plain.csv").write_text((plant / "stream.csv").read_text().partition("\n")[2])
    (tmp_path / "healthy.csv").write_text((plant / "healthy.csv").read_text().partition("\n")[2])
    channels = ("--inputs", "data[:,2]", "--outputs", "data[:,3],data[:,1]")
    run = call(
        *("monitor", str(plant), "--healthy", str(tmp_path / "healthy.csv"), "--follow", str(tmp_path / "plain.csv"), "--idle", "0.1"),
        *(*OPTIONS, "--json", *channels),
    )
    assert alarms(run)[0]["outputs"] == ["data[:,1]"]


def test_messages_name_the_option_that_was_used() -> None:
    message = "x.csv: healthy: got 3 samples; try order=2"
    assert as_options(message) == "x.csv: --healthy-until: got 3 samples; try --order 2"
    assert as_options(of_file(message)) == of_file(message) == "x.csv: --healthy: got 3 samples; try --order 2"
