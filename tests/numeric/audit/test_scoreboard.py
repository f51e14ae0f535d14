"""The board is of the checks that there are, its pages are made of it, tallies count, and the scripts beside it show what they say.

Scripts in Python are run by the interpreter at hand, or by the one that PEERS_PYTHON names, where the packages are.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric.audit import peers
from faultspace.numeric.audit.checks.catalogue import all_checks
from faultspace.numeric.audit.making.kinds_of_trouble import COUNT
from faultspace.numeric.audit.peers import JULIA, PEERS, Peer
from faultspace.numeric.audit.peers import peer as peer_named
from faultspace.numeric.audit.records import Demand
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.scoreboard import KEPT, Audited, Board, merged, path, tallies, text, write_pages
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from faultspace.numeric.audit.vectors.trouble import default_troubles
from tests.numeric.audit.test_peers import EXCLUDING, few_block_rows
from tests.thorough import every

ROOM = Path(__file__).resolve().parents[3] / "numeric" / "audit"
NUMBER = re.compile(r"-?\b\d+(?:\.\d+)?(?:e[-+]?\d+)?\b")
BOARD = Board.read((ROOM / "board.json").read_text("utf-8"))
AGAIN = "make it again: python -m faultspace.numeric.audit.scoreboard --out numeric/audit --pages"
PYTHON = os.environ.get("PEERS_PYTHON", sys.executable)
SECONDS = 60.0


def test_the_pages_are_made_of_the_file(tmp_path: Path) -> None:
    shutil.copy(ROOM / "README.md", tmp_path)
    write_pages(BOARD, tmp_path)
    for name in ("README.md", "FINDINGS.md"):
        assert (tmp_path / name).read_text("utf-8") == (ROOM / name).read_text("utf-8"), AGAIN
    assert Board.read(BOARD.text()) == BOARD
    (tmp_path / "README.md").write_text("no marks\n", "utf-8")
    write_pages(BOARD, tmp_path)
    assert (tmp_path / "README.md").read_text("utf-8") == "no marks\n"


def test_the_file_is_of_the_checks_that_there_are() -> None:
    """Of our own each function is asked as often as there are vectors, and every package is on the board."""
    asked = Counter(check.function for check in all_checks() if check.kind is not Demand.FREE)
    own, *others = BOARD.audited
    assert own.counts == {name: (count, count) for name, count in asked.items()}, "audit again: it was made by other checks"
    assert [one.name for one in others] == [one.name for one in PEERS]
    known = {(one.slug, one.function) for one in all_checks()}
    for audited in others:
        assert all(passed <= many <= asked[name] for name, (passed, many) in audited.counts.items()) and audited.version
        assert {(one.slug, one.function) for one in audited.failed} <= known
    found = {(one.name, tally.slug) for one in others for tally in one.failed}
    assert found >= {
        ("nfoursid", "memory-grows-with-N"),
        ("ctrlsys", "exact-recovery"),
        ("octave-control", "long-window"),
        ("fault_id", "fault-space-long-window"),
        ("fault_id", "fault-dimension-noisy"),
        ("fault_id-threshold", "window-ranks"),
    }


def test_nobody_is_accused_of_what_its_documents_exclude() -> None:
    """Exact recovery with as many states as block rows, by name and by number of checks; a coloured fault."""
    few = {name.partition("[")[2].partition("]")[0] for name in few_block_rows()}
    asked = sum((one.function, one.slug) == ("identify", "exact-recovery") for one in all_checks()) - len(few)
    for audited in BOARD.audited:
        failed = {one.slug: one for one in audited.failed if one.function == "identify"}
        if audited.name in (*EXCLUDING, "nfoursid"):
            assert "consistent-under-coloured-fault" not in failed, audited.name
        if audited.name in EXCLUDING and "exact-recovery" in failed:
            assert failed["exact-recovery"].asked <= asked and failed["exact-recovery"].vector not in few, audited.name


def test_tallies_count_and_show_the_first_failure() -> None:
    rows = {one.slug: one for one in tallies(audit(SimpleNamespace(fault_dimension=lambda r: 1), only=["fault-dimension", "as-many-*"]))}
    one = rows["fault-dimension"]
    counts = [vector.n_v for vector in shipped("faults")]
    counts += [trouble.faults.n_v for trouble in default_troubles() if trouble.faults and COUNT in trouble.asks]
    wrong = sum(count != 1 for count in counts)
    assert (one.asked, one.failed, one.verdict, one.got, one.bound) == (len(counts), wrong, "fail", 1.0, 0.0)
    assert one.vector == "two-faults" and rows["as-many-faults-as-outputs"].kind == Demand.FREE
    entry = Audited.of("mine", "", "1", "", 1.0, rows.values())
    assert entry.total == (sum(row.asked - row.failed for row in rows.values() if row.kind != Demand.FREE), entry.total[1])
    assert one in entry.failed and "as-many-faults-as-outputs" not in {row.slug for row in entry.failed}


def test_what_an_answer_lacks_is_not_asked() -> None:
    records = audit(SimpleNamespace(structure=lambda A, F, C, G: {"finite_zeros": []}), only=["normal-rank", "finite-zeros"])
    assert {one.verdict for one in records if one.slug == "normal-rank"} == {"not offered"}
    assert not any(one.failed for one in records if one.slug == "normal-rank")
    assert any(one.failed for one in records if one.slug == "finite-zeros")
    assert {one.slug for one in tallies(records)} == {"finite-zeros"}


def test_what_was_never_promised_is_not_counted() -> None:
    one_fault = SimpleNamespace(fault_dimension=lambda r: 1, NOT_PROMISED={"fault-dimension/two-faults": "one fault only"})
    whole, promised = (
        next(one for one in tallies(audit(mine, only=["fault-dimension"])) if one.slug == "fault-dimension")
        for mine in (SimpleNamespace(fault_dimension=one_fault.fault_dimension), one_fault)
    )
    assert (promised.asked, promised.failed) == (whole.asked - 1, whole.failed - 1)


def test_a_new_entry_takes_the_place_of_the_old_one() -> None:
    def entry(name: str, seconds: float) -> Audited:
        return Audited.of(name, "", "1", "", seconds, ())

    old = Board((entry("faultspace", 1.0), entry("slycot", 1.0), entry("ctrlsys", 1.0)))
    new = merged(Board((entry("faultspace", 2.0), entry("slycot", 2.0))), old)
    assert [(one.name, one.seconds) for one in new.audited] == [("faultspace", 2.0), ("ctrlsys", 1.0), ("slycot", 2.0)]


def test_a_package_that_is_not_here_says_what_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    absent = Peer("absent", "", "Python", "absent", None, "pip install absent", lambda: None)
    monkeypatch.setattr(peers, "PEERS", (absent,))
    with pytest.raises(InvalidData, match="pip install absent"):
        audit(peer="absent")


# -- scripts -----------------------------------------------------------------------------------------------------------------------------


def parted(script: str) -> tuple[list[str], Array]:
    """Return what stands between the numbers of a text, and the numbers."""
    return NUMBER.split(script), np.array([float(one) for one in NUMBER.findall(script)])


def test_the_scripts_are_those_that_the_command_prints_and_need_nothing_of_ours() -> None:
    kept = {path(*one): one for one in KEPT}
    assert set(kept) == {str(one.relative_to(ROOM)) for one in ROOM.glob("reproducers/*/*.*")}
    page = (ROOM / "FINDINGS.md").read_text("utf-8")
    for place in kept:
        there = (ROOM / place).read_text("utf-8")
        assert f"]({place})" in page
        assert not any(word in there for word in ("import faultspace", "from faultspace", "source(", "include(")), place
    for place, one in list(kept.items())[:: every()]:
        there = (ROOM / place).read_text("utf-8")
        (words, made), (others, numbers) = parted(text(*one)), parted(there)
        assert words == others, f"{place}: {AGAIN}"
        # Records that are mixed in floating point differ in their last digits from one processor to another.
        assert np.allclose(made, numbers, rtol=1e-12, atol=1e-12 * np.abs(numbers).max(initial=0.0)), f"{place}: {AGAIN}"


@pytest.mark.programs
@pytest.mark.parametrize(("name", "check"), KEPT)
def test_a_script_shows_its_failure(name: str, check: str) -> None:
    package = peer_named(name)
    if (package.language != "Python" or sys.executable == PYTHON) and package.version() is None:
        pytest.skip(package.needs)
    file = ROOM / path(name, check)
    interpreters = {".py": [PYTHON, "-W", "ignore"], ".m": ["octave-cli", "--no-gui", "--quiet", "--norc"], ".jl": list(JULIA)}
    command = [*interpreters[file.suffix], str(file), *(["1"] if name == "fault_id-threshold" else [])]
    try:
        ran = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:  # which is the failure of one
        assert (name, check) == ("octave-control", "refuses-nan-model[two-faults]-structure")
        return
    assert ran.returncode != 0, ran.stdout
    assert "WRONG" in ran.stdout + ran.stderr or "error" in ran.stderr.lower() or "invalid" in ran.stderr
