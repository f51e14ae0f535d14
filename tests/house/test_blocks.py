"""The blocks of code on the pages: each says what it is, and is run or says where it stands why not; commands have the options they name.

blocks    the Blocks of a page, with the reason where a comment before one, or one for the whole page, says that it is not run
given     what a page takes the reader to have: files in the folder where its commands are run
lines     the commands of a block, without their comments

Blocks of Python and the cells of tutorials are run by test_site.py, the examples of the audit's page by tests/numeric/audit/test_readme.py,
and what was found by hand by tests/numeric/audit/test_by_hand.py. Shell commands of DAILY take a few seconds together; all of them, page by
page and in the order of the page, are run by `python -m pytest -m slow`.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from typer.main import get_command

from faultspace.cli.command_line import app
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claiming import decide_claims
from tests.end_to_end.commands import call, environment

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
IN_ROOMS = "proofs/trust proofs/theory proofs/counterexamples numeric/audit numeric/audit/peers numeric/audit/upstream/readers benchmarks"
PAGES = [
    *sorted(ROOT.glob("*.md")),
    *(page for room in IN_ROOMS.split() for page in sorted((ROOT / room).glob("*.md"))),
    *sorted(DOCS.rglob("*.md")),
]
EXAMPLE = re.compile(r"<!-- example: (.+) -->\n\n\Z")  # which test_readme.py of the audit runs
BY_HAND = ("by_hand.md",)
RUN_ELSEWHERE = {"python", "{code-cell}"}
DATA = {"text", "toml", "{toctree}", "{eval-rst}"}
DAILY = ("faultspace examples", "faultspace inspect", "faultspace compare", "faultspace limit", "faultspace check")
FENCE = re.compile(r"^( *)```(\S*)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
ONE = re.compile(r"<!-- not run: (.{20,}) -->\n *\Z")
WHOLE = re.compile(r"^<!-- no block of this page is run: (.{20,}) -->$", re.MULTILINE)
# A check of the audit fails, or an alarm sounds, where the page says that it does: that is no mistake of the page.
MAY_FAIL = ("faultspace audit", "faultspace monitor")


@dataclass(frozen=True)
class Block:
    """The `text` of a block, what it is, and why it is not run, or "" where it is; `example`, where the audit's page has it run."""

    kind: str
    text: str
    reason: str
    example: bool


def blocks(page: str) -> Iterator[Block]:
    whole = WHOLE.search(page)
    for found in FENCE.finditer(page):
        before = ONE.search(page, 0, found.start())
        reason = before[1] if before else whole[1] if whole else ""
        text = "\n".join(line[len(found[1]) :] for line in found[3].splitlines())
        yield Block(found[2], text, reason, EXAMPLE.search(page, 0, found.start()) is not None)


def lines(block: Block) -> list[str]:
    found = [re.sub(r"(^|\s+)# .*", "", line).strip() for line in block.text.splitlines()]
    return [line for line in found if line]


def name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def test_every_block_says_what_it_is_and_is_run_or_says_why_not() -> None:
    for page in PAGES:
        runs_or_says_why_not(page, page.read_text("utf-8"))


def runs_or_says_why_not(page: Path, text: str) -> None:
    """Raise AssertionError where a block of the page is of no known kind, or is not run and does not say why."""
    for block in blocks(text):
        run = {"sh"} | DATA
        if page.name in BY_HAND:
            run |= {"octave", "python"}
        elif page in (ROOT / "README.md", *DOCS.rglob("*.md")) or block.example:
            run |= RUN_ELSEWHERE
        assert block.kind in run or block.reason, (block.kind, block.text)
    marks = text.count("<!-- not run: ")
    assert marks == len(re.findall(r"<!-- not run: .{20,} -->\n *```", text)), "a mark stands on the line before its block"
    left = FENCE.sub("", text)
    indented = [
        line
        for line in re.findall(r"\n\n {4,}(\S.*)", left)
        if not re.search(r"\n\n(?:\d+\.|-) .*(?:\n.*)*?\n\n {4,}" + re.escape(line), left)
    ]
    assert indented == [], "a block begins with ``` and the word for what it is"


def options(command: str) -> tuple[set[str], Path | None]:
    """Return the options that a command asks for, and the file of a script that is to have them, None for a command of ours."""
    script = next((ROOT / word for word in command.split() if word.endswith(".py") and (ROOT / word).exists()), None)
    module = re.search(r"python -m ((?:faultspace|tests)[\w.]*)", command)
    if module:
        found = find_spec(module[1])
        assert found is not None and found.origin is not None, command
        script = Path(found.origin)
    return set(re.findall(r"(?<![\w-])--[a-z][\w-]*", command)), script


@cache
def options_of_ours() -> dict[str, set[str]]:
    """Return the options of each command."""
    found = get_command(app).commands  # type: ignore[attr-defined]
    return {
        word: {"--help", *(option for one in command.params for option in (*one.opts, *one.secondary_opts))}
        for word, command in found.items()
    }


def understood(command: str) -> None:
    """Raise AssertionError where a command, a script or a module is not there or has not the options that it is given."""
    asked, script = options(command)
    if script is not None:
        folder = script.parent.rglob("*.py") if script.name == "__init__.py" else [script]
        text = "".join(one.read_text("utf-8") for one in folder)
        known = set(re.findall(r"\"(--[a-z][\w-]*)\"", text))
        if 'f"--{' in text:  # named in a loop
            known |= {f"--{word}" for word in re.findall(r"\"(\w+)\"", text)}
    else:
        word = command.partition("faultspace ")[2].split()[0]
        known = options_of_ours().get(word, set())
        assert known, command
    assert asked <= known, (command, asked - known)


def commands(page: str) -> list[str]:
    """The commands of a page that are ours: the lines of its blocks, and what stands within a sentence."""
    told = [line for block in blocks(page) if block.kind == "sh" for line in lines(block)]
    within = re.findall(r"`([^`\n]+)`", FENCE.sub("", page))
    ours = re.compile(
        r"(?:\w+=\S+ )*(?:nice -n 19 )?(?:faultspace [a-z-]+|python (?:benchmarks/\w+\.py|-m (?:faultspace|tests)[\w.]+))(?: |$)"
    )
    return [one for one in [*told, *within] if ours.match(one) and "NAME" not in one.split()[-1:]]


def test_commands_have_the_options_that_they_are_given() -> None:
    for page in PAGES:
        for command in commands(page.read_text("utf-8")):
            understood(command)


def test_what_is_no_command_or_no_option_is_noticed() -> None:
    understood("faultspace verify --claim theorem-1")
    understood("python benchmarks/ladder.py [--quick] [--limit SECONDS]")
    for wrong in ("faultspace verify --clam theorem-1", "faultspace verfy", "python benchmarks/ladder.py --quik"):
        with pytest.raises(AssertionError):
            understood(wrong)
    assert [one.reason for one in blocks("```sh\na\n```\n<!-- not run: it takes two long hours -->\n```sh\nb\n```\n")] == [
        "",
        "it takes two long hours",
    ]


def given(page: Path, folder: Path) -> None:
    """Write what the reader of a page has: the blocks of the page that are files, or records in the form that it tells of."""
    found = list(blocks(page.read_text("utf-8")))
    for block in found:
        if block.kind == "python" and (title := re.match(r"# (\w+\.py)\n", block.text)):
            (folder / title[1]).write_text(block.text, "utf-8")
    if claims := [block.text for block in found if block.kind == "toml"]:
        (folder / "claims.toml").write_text(claims[0], "utf-8")
    if page.name == "bring-a-claim.md":
        (folder / "claims.toml").write_text('[claim.mine]\nconclusion = "lag <= n"\n', "utf-8")
    if page.name == "your-claims.md":
        shutil.copy(ROOT / "faultspace" / "examples" / "paper.json", folder / "SYSTEM")
    if page.name == "your-code.md":
        (folder / "mine.py").write_text(
            "import numpy as np\n\n\ndef fault_dimension(r):\n    return int(np.linalg.matrix_rank(r))\n", "utf-8"
        )
    if page.name == "your-data.md":
        records(folder)


def claims() -> list[str]:
    """Return the blocks of claims of all pages."""
    return [block.text for page in PAGES for block in blocks(page.read_text("utf-8")) if block.kind == "toml"]


def test_claims_are_read() -> None:
    assert len(claims()) > 3 and all(map(read_claims, claims()))


@pytest.mark.slow
def test_claims_are_as_the_page_expects() -> None:
    assert [text for text in claims() if not decide_claims(read_claims(text)).as_expected] == []


def records(folder: Path) -> None:
    """Write records of a plant with one input and two outputs, all but one of them with a fault in the second output."""
    for seed, file in enumerate(("monday.csv", "tuesday.csv", "stream.csv", "healthy.csv")):
        draws = np.random.default_rng(seed)
        u, fault, noise = draws.standard_normal(600), draws.standard_normal(600), 0.01 * draws.standard_normal((600, 2))
        states = [0.0]
        for one in u[:-1]:
            states.append(0.7 * states[-1] + one)
        level = np.array(states)
        flow = 0.5 * level + (file != "healthy.csv") * fault
        np.savetxt(
            folder / file,
            np.column_stack([u, np.column_stack([level, flow]) + noise]),
            delimiter=",",
            header="valve,level,flow",
            comments="",
        )


WITH_COMMANDS = [page for page in PAGES if any(block.kind == "sh" and not block.reason for block in blocks(page.read_text("utf-8")))]


@pytest.mark.parametrize("page", WITH_COMMANDS, ids=name)
def test_quick_commands_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    given(page, tmp_path)
    (tmp_path / "proofs").symlink_to(ROOT / "proofs")
    for line in (line for block in blocks(page.read_text("utf-8")) if block.kind == "sh" and not block.reason for line in lines(block)):
        if line.startswith(DAILY):
            words = [str(one) for word in shlex.split(line)[1:] for one in (sorted(tmp_path.glob(word)) if "*" in word else [word])]
            done = call(*words)
            assert done.code == 0 and done.out, (line, done.err)


@pytest.mark.slow
@pytest.mark.parametrize("page", WITH_COMMANDS, ids=name)
def test_every_command_of_the_page_runs(page: Path, tmp_path: Path) -> None:
    """Each in the order of the page, in a folder that has the tree beside what the page tells the reader to have."""
    programs = tmp_path / "programs"
    programs.mkdir()
    for program, what in (("faultspace", "-m faultspace"), ("python", "")):
        (programs / program).write_text(f'#!/bin/sh\nexec "{sys.executable}" {what} "$@"\n', "utf-8")
        (programs / program).chmod(0o755)
    folder = tmp_path / "work"
    folder.mkdir()
    for part in ("proofs", "benchmarks", "numeric", "exact", "tests"):
        (folder / part).symlink_to(ROOT / part)
    given(page, folder)
    surroundings = environment(PATH=f"{programs}{os.pathsep}{os.environ['PATH']}")
    for line in (line for block in blocks(page.read_text("utf-8")) if block.kind == "sh" and not block.reason for line in lines(block)):
        done = subprocess.run(["bash", "-c", line], cwd=folder, env=surroundings, capture_output=True, text=True)
        assert done.returncode in ((0, 1) if line.startswith(MAY_FAIL) else (0,)), (line, done.stderr[-2000:])
        assert done.stdout and "Traceback" not in done.stderr, line
