"""The scoreboard's pages are what its file says, the file is of the checks that there are, and tallies count."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric.audit import peers
from faultspace.numeric.audit.checks.catalogue import all_checks
from faultspace.numeric.audit.making.kinds_of_trouble import COUNT
from faultspace.numeric.audit.peers import PEERS, Peer
from faultspace.numeric.audit.records import Demand
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.scoreboard.boards import main, merged, tallies
from faultspace.numeric.audit.scoreboard.pages import findings, table, write_pages
from faultspace.numeric.audit.scoreboard.records import Audited, Board
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from faultspace.numeric.audit.vectors.trouble import VERSION, default_troubles
from tests.numeric.audit.matrix import page
from tests.numeric.audit.unseen.table import kept

ROOM = Path(__file__).resolve().parents[3] / "numeric" / "audit"
NUMBER = re.compile(r"-?\b\d+(?:\.\d+)?(?:e[-+]?\d+)?\b")
BOARD = Board.from_json(json.loads((ROOM / "scoreboard.json").read_text("utf-8")))


def parted(text: str) -> tuple[list[str], Array]:
    """Return what stands between the numbers of a text, and the numbers."""
    return NUMBER.split(text), np.array([float(one) for one in NUMBER.findall(text)])


def test_the_pages_are_made_of_the_file(tmp_path: Path) -> None:
    for name in ("README.md", "scoreboard.json"):
        shutil.copy(ROOM / name, tmp_path / name)
    assert main(["--out", str(tmp_path), "--pages"]) == 0
    scripts = [str(one.relative_to(ROOM)) for one in sorted(ROOM.glob("reproducers/*/*.*"))]
    assert scripts == [str(one.relative_to(tmp_path)) for one in sorted(tmp_path.glob("reproducers/*/*.*"))]
    for name in ("README.md", "FINDINGS.md", *scripts):
        again = "python -m faultspace.numeric.audit.scoreboard --out numeric/audit --pages"
        (words, made), (kept, there) = (parted((room / name).read_text("utf-8")) for room in (tmp_path, ROOM))
        assert words == kept, f"make it again: {again}"
        # Records that are mixed in floating point differ in their last digits from one processor to another.
        assert np.allclose(made, there, rtol=1e-12, atol=1e-12 * np.abs(there).max(initial=0.0)), f"{name}: make it again: {again}"


def test_the_file_is_of_the_checks_that_there_are() -> None:
    """Each slug and function of our own is asked as often as there are vectors, and every package is on the board."""
    asked: dict[tuple[str, str], int] = {}
    for check in all_checks():
        asked[check.slug, check.function] = asked.get((check.slug, check.function), 0) + 1
    own = BOARD.audited[0]
    assert {(one.slug, one.function): one.asked for one in own.tallies} == asked, "audit again: it was made by other checks"
    assert [one.name for one in BOARD.audited] == ["faultspace", *(one.name for one in PEERS)]
    assert not any(one.failed for one in own.tallies)
    for audited in BOARD.audited[1:]:
        assert all(one.asked <= asked[one.slug, one.function] for one in audited.tallies) and audited.version


@pytest.mark.parametrize(
    ("name", "slug"),
    [
        ("sippy_unipi", "exact-recovery"),
        ("nfoursid", "memory-grows-with-N"),
        ("ctrlsys", "exact-recovery"),
        ("octave-control", "long-window"),
        ("fault_id", "exact-recovery"),
        ("fault_id", "fault-space-long-window"),
        ("fault_id", "fault-space-1e6"),
        ("fault_id", "fault-dimension-noisy"),
        ("fault_id-threshold", "window-ranks"),
    ],
)
def test_the_errors_known_before_are_on_it(name: str, slug: str) -> None:
    (found,) = (one for one in BOARD.audited if one.name == name)
    assert any(one.slug == slug and one.failed for one in found.tallies)
    assert re.search(rf"## {re.escape(name)}\n.*?\*\*{slug}\*\*|## {re.escape(name)}\n.*?{slug} \(", findings(BOARD, {}), re.S)


def test_tallies_count_and_show_the_first_failure() -> None:
    rows = {one.slug: one for one in tallies(audit(SimpleNamespace(fault_dimension=lambda r: 1)))}
    one = rows["fault-dimension"]
    counts = [vector.n_v for vector in shipped("faults")]
    counts += [trouble.faults.n_v for trouble in default_troubles() if trouble.faults and COUNT in trouble.asks]
    wrong = sum(count != 1 for count in counts)
    assert (one.asked, one.failed, one.verdict, one.got, one.bound) == (len(counts), wrong, "fail", 1.0, 0.0)
    assert one.vector == "two-faults" and rows["as-many-faults-as-outputs"].kind == Demand.FREE


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
        return Audited(name, "", "1", "", seconds, ())

    old = Board((entry("faultspace", 1.0), entry("slycot", 1.0), entry("ctrlsys", 1.0)))
    new = merged(Board((entry("faultspace", 2.0), entry("slycot", 2.0))), old)
    assert [(one.name, one.seconds) for one in new.audited] == [("faultspace", 2.0), ("ctrlsys", 1.0), ("slycot", 2.0)]


def test_a_package_that_is_not_here_says_what_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    absent = Peer("absent", "", "Python", "absent", None, "pip install absent", lambda: None)
    monkeypatch.setattr(peers, "PEERS", (absent,))
    with pytest.raises(InvalidData, match="pip install absent"):
        audit(peer="absent")


def test_pages_without_marks_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("no marks\n", "utf-8")
    write_pages(BOARD, tmp_path)
    assert (tmp_path / "README.md").read_text("utf-8") == "no marks\n"
    assert table(BOARD).count("\n") > 50


def test_the_page_of_mutants_is_of_these_mutants_and_vectors() -> None:
    """That each is caught where it is said are `test_mutants` and `unseen/test_caught`."""
    text = (ROOM / "MUTANTS.md").read_text("utf-8")
    assert text == page(kept()), "make it again: python -m tests.numeric.audit.matrix --out numeric/audit/MUTANTS.md"
    assert f"vectors of version {VERSION}" in text and "gets through" not in text
