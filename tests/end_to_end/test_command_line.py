"""These tests use the command line as a person and as a script meet it."""

from __future__ import annotations

import json
import os
import pty
import shlex
import signal
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import HealthCheck, given, settings
from typer.testing import CliRunner

import faultspace
from faultspace.cli import failures
from faultspace.cli.command_line import app
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import read_system
from faultspace.example_data import FILE_NAME
from faultspace.packaged_examples import CLAIMS, DESCRIPTIONS, EXPERIMENTS
from faultspace.proofs.trust import structure_certificates as certificates
from tests.end_to_end.commands import EXAMPLES, ROOT, Run, call, command, environment, example, validator
from tests.oracle.strategies import system_pairs, systems
from tests.thorough import examples

SCALAR = '{"A": [[x]], "F": [[1]], "C": [[1]], "G": [[0]]}'
PAPER = {
    "field": {"minimal_polynomial": ["1", "-3", "-1", "4"]},
    "n": 3,
    "p": 2,
    "m": 1,
    "normal_rank": 1,
    "left_minimal_indices": [2],
    "right_minimal_indices": [],
    "invariant_zero_polynomial": ["1"],
    "infinite_zero_orders": [1],
    "zeta": 1,
    "lag": 2,
    "observable": True,
    "controllable": False,
    "left_invertible": True,
    "delay_known_state": 1,
    "delay_unknown_state": 1,
    "window_ranks": [2, 4, 5, 6, 7, 8],
    "fault_space_dimensions": [5, 5, 2, 2, 2, 2],
    "fault_space_dimension": 2,
    "fault_space": [["1", ["0", "1", "0"], ["0", "0", "1"], "0", "0"], ["0", "0", "0", "1", ["0", "1", "0"]]],
}


def saved(folder: Path, name: str, document: object) -> str:
    """Return the path of a new file that holds the document."""
    path = folder / name
    path.write_text(document if isinstance(document, str) else json.dumps(document), "utf-8")
    return str(path)


# -- the front ---------------------------------------------------------------------------------------------------------


def test_the_version_is_printed() -> None:
    assert command("--version") == Run(0, f"faultspace {faultspace.__version__}\n", "")


def test_without_a_command_the_commands_are_listed_on_standard_error() -> None:
    run = command()
    assert (run.code, run.out) == (2, "")
    assert all(name in run.err for name in ("verify", "check", "inspect", "compare", "examples"))


@pytest.mark.parametrize("name", ["verify", "check", "inspect", "compare", "limit", "examples"])
def test_every_command_takes_json_and_has_help(name: str) -> None:
    run = CliRunner().invoke(app, [name, "--help"])
    assert run.exit_code == 0
    assert "--json" in run.output


@pytest.mark.parametrize("arguments", [["frobnicate"], ["inspect"], ["inspect", "--no-such-option", "x"], ["compare", "x"]])
def test_wrong_usage_is_one_line_and_2(arguments: list[str]) -> None:
    run = call(*arguments)
    assert (run.code, run.out, run.err.count("\n")) == (2, "", 1)
    assert run.err.startswith("faultspace: ") and run.err.endswith("--help)\n")


def test_wrong_choices_name_the_right_ones() -> None:
    run = call("compare", "x", "y", "--expect", "equal")
    assert run.code == 2 and "equivalent" in run.err and "different" in run.err
    run = call("verify", "--effort", "some")
    assert run.code == 2 and "quick" in run.err and "full" in run.err


# -- inspect -----------------------------------------------------------------------------------------------------------


def test_inspect_prints_what_is_known_of_the_paper_s_example() -> None:
    run = command("inspect", "example:paper", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json == PAPER
    assert list(run.json) == list(PAPER)
    validator("inspect").validate(run.json)


def test_inspect_reads_standard_input() -> None:
    run = command("inspect", "-", "--json", stdin=json.dumps(example("paper")).encode())
    assert (run.code, run.json) == (0, PAPER)


def test_inspect_prints_an_array_for_several_systems() -> None:
    run = call("inspect", "example:paper", "example:zeros", "--json")
    assert run.code == 0
    assert [document["file"] for document in run.json] == ["example:paper", "example:zeros"]
    assert run.json[0] == {"file": "example:paper", **PAPER}
    validator("inspect").validate(run.json)


def test_a_bad_file_does_not_keep_the_others_from_being_inspected(tmp_path: Path) -> None:
    run = call("inspect", "example:zeros", str(tmp_path / "none.json"), "example:paper", "--json")
    assert run.code == 2
    assert [document["file"] for document in run.json] == ["example:zeros", "example:paper"]
    assert run.err.count("\n") == 1 and "none.json" in run.err


def test_the_table_speaks_the_language_of_the_field() -> None:
    run = command("inspect", "example:zeros", "example:paper")
    assert (run.code, run.err) == (0, "")
    zeros, paper = run.out.split("example:paper")
    words = " ".join(zeros.split())
    assert "invariant zero polynomial q - 2" in words and "left minimal indices 1" in words
    assert "rank [O_s T_s] 2 3 4 5 6 7" in words and "zeros, finite + infinite = zeta 1 + 1 = 2" in words
    assert "4 a^3 - a^2 - 3 a + 1" in paper
    assert "[ a^2  0 ]" in paper and "[ 0  a ]" in paper
    assert "\x1b" not in run.out


def test_no_line_is_cut_or_wrapped_in_a_pipe(tmp_path: Path) -> None:
    size = 40
    entry = "1234567/7654321"
    wide = {"A": [[entry] * size] * size, "F": [["1"]] * size, "C": [["1"] + ["0"] * (size - 1)], "G": [["0"]]}
    run = command("inspect", saved(tmp_path, "wide.json", wide))
    assert run.code == 0
    # every line is a whole one: a name, a value, no continuation of the line before
    (ranks,) = [line for line in run.out.splitlines() if "rank [O_s T_s]" in line]
    assert ranks.endswith("(43 in all)") and len(ranks) > 100


def test_on_a_terminal_there_are_colours() -> None:
    master, slave = pty.openpty()
    line = [sys.executable, "-m", "faultspace", "inspect", "example:paper"]
    run = subprocess.Popen(line, stdout=slave, stderr=subprocess.DEVNULL, cwd=ROOT, env=environment(TERM="xterm"))
    os.close(slave)
    seen = b""
    while True:
        try:
            part = os.read(master, 4096)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        seen += part
    os.close(master)
    assert run.wait() == 0
    assert b"\x1b[" in seen and b"normal rank" in seen


def test_floats_are_refused_unless_they_are_to_be_taken_exactly(tmp_path: Path) -> None:
    name = saved(tmp_path, "floats.json", '{"A": [[0.5]], "F": [[1]], "C": [[1e0], [0.1]], "G": [[0], [-2.5E-1]]}')
    refused = call("inspect", name, "--json")
    assert (refused.code, refused.out) == (2, "")
    assert "A[0][0]" in refused.err and "0.5" in refused.err and "--floats-exactly" in refused.err
    tenth = str(Fraction(0.1))
    exact = saved(tmp_path, "exact.json", {"A": [["1/2"]], "F": [["1"]], "C": [["1"], [tenth]], "G": [["0"], ["-1/4"]]})
    assert call("inspect", name, "--json", "--floats-exactly").json == call("inspect", exact, "--json").json
    assert call("compare", name, exact, "--floats-exactly", "--json").json == {"equivalent": True, "first_difference": None}


@pytest.mark.parametrize("literal", ["1e400", "-1e999", "NaN", "Infinity"])
def test_no_flag_makes_a_number_of_what_is_none(tmp_path: Path, literal: str) -> None:
    name = saved(tmp_path, "floats.json", SCALAR.replace("x", literal))
    run = call("inspect", name, "--floats-exactly")
    assert (run.code, run.out, run.err.count("\n")) == (2, "", 1)
    assert "floats.json" in run.err
    assert "expected a finite float" in run.err or "expected a number that JSON has" in run.err


def test_integers_of_any_permitted_length_are_read(tmp_path: Path) -> None:
    digits = "1" + "0" * 6000  # beyond what Python reads by itself
    name = saved(tmp_path, "long.json", SCALAR.replace("x", digits))
    run = call("inspect", name, "--json")
    assert (run.code, run.json["observable"]) == (0, True)
    assert call("inspect", name).code == 0


@settings(max_examples=examples(60), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(system=systems())
def test_what_inspect_reads_and_prints_agrees_with_the_schemas(tmp_path: Path, system: Any) -> None:
    validator("system").validate(system)
    name = saved(tmp_path, "system.json", system)
    run = call("inspect", name, "--json")
    assert (run.code, run.err) == (0, "")
    validator("inspect").validate(run.json)
    assert call("inspect", name).code == 0


# -- compare -----------------------------------------------------------------------------------------------------------


def test_compare_prints_exactly_two_keys() -> None:
    run = command("compare", "example:theorem-1-first", "example:theorem-1-second", "--json")
    assert (run.code, run.json, run.err) == (0, {"equivalent": False, "first_difference": 2}, "")
    run = call("compare", "example:zeros", "example:same-behaviour", "--json")
    assert run.json == {"equivalent": True, "first_difference": None}


@pytest.mark.parametrize(
    ("second", "expected", "code"),
    [
        ("theorem-1-second", "different", 0),
        ("theorem-1-second", "equivalent", 1),
        ("theorem-1-first", "equivalent", 0),
        ("theorem-1-first", "different", 1),
    ],
)
def test_compare_exits_1_when_it_is_not_as_expected(second: str, expected: str, code: int) -> None:
    for extra in ([], ["--json"]):
        run = call("compare", "example:theorem-1-first", f"example:{second}", "--expect", expected, *extra)
        assert run.code == code
        assert run.err.count("\n") == code and (code == 0 or expected in run.err)


def test_the_table_shows_a_word_that_separates() -> None:
    run = call("compare", "example:theorem-1-first", "example:theorem-1-second")
    assert "different: first on 2 samples" in run.out
    rows = [line.split() for line in run.out.splitlines() if line.strip().startswith(("0 ", "1 "))]
    assert rows == [["0", "1", "0,", "1"], ["1", "0", "1,", "0"]]
    assert "N(q) = [ q,  -2 ]" in run.out


@settings(max_examples=examples(40), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(pair=system_pairs(field="Q"))
def test_the_word_is_one_of_its_system_and_violates_the_row(tmp_path: Path, pair: tuple[Any, Any]) -> None:
    names = [saved(tmp_path, f"{i}.json", system) for i, system in enumerate(pair)]
    run = call("compare", *names, "--json", "--word")
    assert (run.code, run.err) == (0, "")
    validator("compare").validate(run.json)
    assert call("compare", *names).code == 0
    word = run.json["word"]
    assert (word is None) == run.json["equivalent"]
    if word is None:
        return
    maker = pair[0 if word["of"] == "first" else 1]
    x = [Fraction(entry) for entry in word["x0"]]
    value = Fraction(0)
    assert len(word["v"]) == len(word["r"]) == len(word["row"]) == run.json["first_difference"]
    for v, r, c in zip(word["v"], word["r"], word["row"], strict=True):
        v = [Fraction(entry) for entry in v]
        outputs = _added(_times(maker["C"], x, maker["p"]), _times(maker["G"], v, maker["p"]))
        assert outputs == [Fraction(entry) for entry in r]
        value += sum((Fraction(a) * b for a, b in zip(c, outputs, strict=True)), Fraction(0))
        x = _added(_times(maker["A"], x, maker["n"]), _times(maker["F"], v, maker["n"]))
    assert value != 0


def _times(matrix: Any, vector: list[Fraction], rows: int) -> list[Fraction]:
    table = matrix or [[]] * rows
    return [sum((Fraction(a) * b for a, b in zip(row, vector, strict=False)), Fraction(0)) for row in table]


def _added(left: list[Fraction], right: list[Fraction]) -> list[Fraction]:
    return [a + b for a, b in zip(left, right, strict=True)]


def test_systems_that_cannot_be_compared_are_bad_input() -> None:
    run = call("compare", "example:zeros", "example:paper")
    assert (run.code, run.out, run.err.count("\n")) == (2, "", 1)
    assert "example:zeros and example:paper: field" in run.err


# -- check -------------------------------------------------------------------------------------------------------------


@pytest.fixture
def certificate() -> Any:
    """The certificate is about the paper's example."""
    return certificates.window_ranks(kernel_representation(read_system(example("paper")).residual))


def test_check_verifies_rejects_and_refuses(tmp_path: Path, certificate: Any) -> None:
    validator("certificate").validate(certificate)
    good = saved(tmp_path, "good.json", certificate)
    certificate["statement"]["normal_rank"] = 2
    false = saved(tmp_path, "false.json", certificate)
    foreign = saved(tmp_path, "foreign.json", {"kind": "of thing"})
    assert [call("check", name).code for name in (good, false, foreign)] == [0, 1, 2]
    run = call("check", good, false, "--json")
    assert (run.code, [result["result"] for result in run.json]) == (1, ["verified", "rejected"])
    run = command("check", false, foreign, good)
    assert run.code == 2
    assert run.err.count("\n") == 1 and "foreign.json" in run.err
    assert all(word in run.out for word in ("verified", "rejected", "rank [O_s T_s] = 1 s"))
    assert "foreign.json" not in run.out


def test_check_insists_on_a_system(tmp_path: Path, certificate: Any) -> None:
    name = saved(tmp_path, "good.json", certificate)
    own = saved(tmp_path, "own.json", certificate["statement"]["system"])
    assert call("check", name, "--system", own).code == 0
    assert call("check", name, "--system", "example:zeros").code == 1
    run = call("check", name, "--system", str(tmp_path / "none.json"))
    assert (run.code, run.out, run.err.count("\n")) == (2, "", 1)
    run = call("check", name, "--system", saved(tmp_path, "bad.json", {"A": []}))
    assert (run.code, run.out, run.err.count("\n")) == (2, "", 1)


# -- examples ----------------------------------------------------------------------------------------------------------


def test_every_packaged_file_is_described_and_no_other() -> None:
    files = sorted(path.name for path in EXAMPLES.iterdir())
    assert files == sorted([*(f"{name}.json" for name in (*DESCRIPTIONS, *EXPERIMENTS)), *(f"{name}.toml" for name in CLAIMS)])
    listed = [line.split()[0] for line in call("examples").out.splitlines()]
    assert listed == [f"example:{name}" for name in (*DESCRIPTIONS, *EXPERIMENTS, *CLAIMS)]


def test_packaged_systems_are_valid_and_copied_whole(tmp_path: Path) -> None:
    run = call("examples", str(tmp_path / "new" / "folder"))
    assert run.code == 0
    for name in DESCRIPTIONS:
        validator("system").validate(example(name))
        assert json.loads((tmp_path / "new" / "folder" / f"{name}.json").read_text("utf-8")) == example(name)
    copied = [FILE_NAME, *(f"{n}.json" for n in (*DESCRIPTIONS, *EXPERIMENTS)), *(f"{n}.toml" for n in CLAIMS)]
    assert sorted(path.name for path in (tmp_path / "new" / "folder").iterdir()) == sorted(copied)


def test_packaged_systems_are_what_their_descriptions_say() -> None:
    found = {name: call("inspect", f"example:{name}", "--json").json for name in DESCRIPTIONS}
    gaps = [b - a for a, b in zip([0, *found["proposition-3"]["window_ranks"]], found["proposition-3"]["window_ranks"], strict=False)]
    assert gaps[1:3] == [2, 1] and found["proposition-3"]["n"] == 2
    assert found["theorem-3"]["fault_space_dimension"] == 3
    pair = example("theorem-3-bad-pair")
    assert (pair["A"], pair["C"]) == (example("theorem-3")["A"], example("theorem-3")["C"])
    assert found["theorem-3-bad-pair"]["normal_rank"] == 1
    assert not call("compare", "example:theorem-3", "example:theorem-3-bad-pair", "--json").json["equivalent"]
    assert found["zeros"]["invariant_zero_polynomial"] == ["-2", "1"] and found["zeros"]["infinite_zero_orders"] == [1]


# -- streams -----------------------------------------------------------------------------------------------------------


def test_a_reader_that_goes_away_is_no_error() -> None:
    line = [sys.executable, "-m", "faultspace", "inspect", "example:paper"]
    run = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT, env=environment())
    assert run.stdout is not None and run.stderr is not None
    run.stdout.close()
    assert run.stderr.read() == b""
    assert run.wait() == failures.BROKEN_PIPE


def test_an_interrupt_is_one_line() -> None:
    # A shell that starts the tests in the background may have told all its children to ignore interrupts.
    heard = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
    source = heard + "from faultspace.cli.command_line import main; print('ready', flush=True); sys.exit(main(['inspect', '-']))"
    streams = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    run = subprocess.Popen([sys.executable, "-c", source], **streams, cwd=ROOT, env=environment())  # type: ignore[call-overload]
    assert run.stdout.readline() == b"ready\n"
    time.sleep(1)  # it loads its modules, then waits for standard input: anywhere in between will do
    run.send_signal(signal.SIGINT)
    out, err = run.communicate(timeout=60)
    assert (run.returncode, out, err) == (failures.INTERRUPTED, b"", b"faultspace: interrupted\n")


def test_output_that_cannot_be_written_is_one_line() -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    line = [sys.executable, "-m", "faultspace", "inspect", "example:paper"]
    for extra in ([], ["--json"]):
        with open("/dev/full", "w") as full:
            run = subprocess.run([*line, *extra], stdout=full, stderr=subprocess.PIPE, cwd=ROOT, env=environment())
        assert run.returncode == failures.BAD_INPUT
        assert run.stderr.startswith(b"faultspace: standard output") and run.stderr.count(b"\n") == 1


def test_closed_output_is_no_success() -> None:
    line = f"{shlex.quote(sys.executable)} -m faultspace inspect example:paper"
    run = subprocess.run(f"{line} >&-", shell=True, cwd=ROOT, env=environment(), stderr=subprocess.PIPE)
    assert run.returncode == failures.BAD_INPUT and run.stderr.startswith(b"faultspace: standard output: is closed")
    assert subprocess.run(f"{line} >&- 2>&-", shell=True, cwd=ROOT, env=environment()).returncode == failures.BAD_INPUT
    assert subprocess.run(f"{line} 2>&-", shell=True, cwd=ROOT, env=environment(), stdout=subprocess.PIPE).returncode == 0


def test_the_schemas_share_their_definition_of_a_system() -> None:
    system = validator("system").schema
    assert isinstance(system, dict)
    certificate = validator("certificate").schema
    assert isinstance(certificate, dict)
    for name, definition in system["$defs"].items():
        assert certificate["$defs"][name] == definition


REFUSED = [
    {"A": [["1.5"]]},
    {"A": [[0.5]]},
    {"extra": 1},
    {"B": [["1"]]},
    {"nu": 1},
    {"field": "R"},
    {"G": []},
    {"field": {"prime": 3}, "A": [["1/2"]]},
]


@pytest.mark.parametrize("change", REFUSED, ids=str)
def test_the_schema_of_a_system_refuses(change: dict[str, object]) -> None:
    sound = {"A": [["1"]], "F": [["1"]], "C": [["1"]], "G": [["1"]]}
    validator("system").validate(sound)
    with pytest.raises(jsonschema.ValidationError):
        validator("system").validate(sound | change)


def test_the_help_tells_every_exit_code() -> None:
    epilogue = call("--help").out.partition("Exit codes:")[2]
    assert [code for code in (0, 1, 2, 3, 70, 130) if f"{code} " not in " ".join(epilogue.split())] == []


@pytest.mark.parametrize("name", ["identify", "monte-carlo", "verify"])
def test_numbers_are_letters_in_the_help(name: str) -> None:
    assert "int range" not in call(name, "--help").out


def test_measured_data_for_a_system_are_told_where_to_go(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_text("a,b\n1,2\n")
    run = call("inspect", str(tmp_path / "x.csv"))
    assert run.code == 2 and run.err.endswith("measured data? `faultspace identify` takes it\n")


def test_a_piped_table_has_no_trailing_blanks() -> None:
    lines = call("audit", "--peers").out.splitlines()
    assert len(lines) > 5 and [one for one in lines if one != one.rstrip()] == []


@pytest.mark.parametrize(
    "name", ["verify", "check", "inspect", "compare", "limit", "identify", "monitor", "monte-carlo", "audit", "examples"]
)
def test_the_help_shows_arguments_as_they_are_typed(name: str) -> None:
    said = call(name, "--help").out
    usage = said.splitlines()[0]
    assert not set(usage) & set("{}<>") and "[[" not in usage and "list[str]" not in said and "<str>" not in said
    if name in ("inspect", "compare"):
        assert usage.split("[OPTIONS] ")[1] == {"inspect": "SYSTEM...", "compare": "SYSTEM SYSTEM"}[name]
        assert "  SYSTEM" in said.split("Arguments:")[1]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("monte-carlo --out x --systems 0", "--systems: got '0', expected a whole number from 1 on, try 100"),
        ("monte-carlo --out x --seed -1", "--seed: got '-1', expected a whole number from 0 on, try 1907"),
        ("verify --jobs 1.5", "--jobs: got '1.5', expected a whole number from 1 on, try 2"),
        ("verify --effort none", "--effort: got 'none', expected one of 'quick', 'full'"),
        ("audit --timeout nan", "--timeout: got 'nan', expected a number from 0.1 on, try 60"),
        ("audit --memory inf", "--memory: got 'inf', expected a number from 0.5 on, try 4"),
        ("identify x --inputs u --outputs y --out x --dt 0", "--dt: got '0', expected a positive number, try 0.1"),
        ("inspect", "SYSTEM...: got none, expected one on the command line"),
        ("report x", "got x, expected no argument there"),
    ],
)
def test_an_option_is_refused_as_all_input_is(line: str, words: str) -> None:
    run = call(*line.split())
    assert (run.code, run.out) == (2, "") and run.err.startswith(f"faultspace: {words} (see: faultspace {line.split()[0]} --help)")


def test_a_claim_without_its_option_gets_it() -> None:
    run = call("verify", "theorem1")
    assert (run.code, run.err) == (2, "faultspace: verify: got 'theorem1', expected options; try: faultspace verify --claim theorem-1\n")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("verfy", "verfy: there is no such command; did you mean 'verify'?"),
        ("verify --foo", "--foo: there is no such option"),
        ("verify --jobs", "--jobs: got none, expected a value behind it"),
    ],
)
def test_what_is_unknown_or_lacks_its_value_is_named_first(line: str, words: str) -> None:
    """Releases of typer differ in how they tell what is near, and of which command the help is."""
    run = call(*line.split())
    assert (run.code, run.out) == (2, "") and run.err.startswith(f"faultspace: {words}")
