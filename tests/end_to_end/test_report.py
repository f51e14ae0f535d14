"""`faultspace report`: the page of a small run in a Chromium without a window, and what is said where something is missing or wrong.

The page is made once; a browser is started once. Without playwright or a Chromium the tests that look at the page are skipped, and say so.
"""

from __future__ import annotations

import html
import json
import re
import shutil
import signal
import subprocess
import sys
import urllib.request
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.error import HTTPError

import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.review_points import review, source
from faultspace.review import printing, reporting
from faultspace.review.computed import controls
from faultspace.review.computed.texts import sources, withdrawn
from faultspace.review.gathering import gather
from faultspace.review.records import Records, read_run
from faultspace.review.reporting import made
from faultspace.review.serving import serving
from tests.end_to_end.commands import ROOT, call, environment
from tests.end_to_end.report_runs import PAIR, SMALL, small_run, spoil

pytest.importorskip("jinja2")
from faultspace.review.drawing import mathml
from faultspace.review.drawing.axes import Axis
from faultspace.review.page import render
from faultspace.review.view.alarms import alarms
from faultspace.review.view.claims import claims

LARGEST = 5_000_000  # bytes of a page
LIKE_OTHERS = (  # what axe would look at many times over, which the slow test has it do
    "#claims article:nth-of-type(n + 3), #hypotheses details:nth-of-type(n + 2), "
    "#withdrawn li:nth-child(n + 4), #appendix details li:nth-child(n + 4), #appendix tr:nth-child(n + 4)"
)
PHONE, SCREEN = {"width": 360, "height": 740}, {"width": 1280, "height": 900}


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> Records:
    return gather(read_run(small_run(tmp_path_factory.mktemp("report") / "run")), SMALL)


@pytest.fixture(scope="module")
def page(records: Records, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(render(records), tmp_path_factory.mktemp("page") / "report.html")


def written(text: str, path: Path) -> Path:
    path.write_text(text, "utf-8")
    return path


def changed(records: Records, change: Callable[[dict[str, Any]], None]) -> Records:
    """Return the records of a run whose verdicts are others."""
    verdicts = json.loads(json.dumps(records.run.verdicts))
    change(verdicts)
    return replace(records, run=replace(records.run, verdicts=verdicts))


def another_verdict(verdicts: dict[str, Any]) -> None:
    """The record says another verdict and still claims that all is as expected: a page does not believe it."""
    claim = next(one for one in verdicts["claims"] if one["id"] == PAIR)
    claim["readings"][1]["verdict"] = "CERTIFIED"
    assert claim["readings"][1]["as_expected"] and verdicts["as_expected"]


def opened(browser: Any, path: Path, said: list[str], **context: Any) -> Any:
    """Open the page; `said` gets whatever the console says and whatever is asked for but the page itself."""
    tab = browser.new_context(**{"viewport": SCREEN, **context}).new_page()
    tab.on("console", lambda message: said.append(f"console: {message.text}"))
    tab.on("pageerror", lambda error: said.append(f"error: {error}"))
    tab.on("request", lambda request: said.append(request.url) if not request.url.startswith(("file:", "data:")) else None)
    tab.goto(path.as_uri())
    return tab


def test_nothing_is_fetched_nothing_is_said_and_every_link_resolves(browser: Any, page: Path) -> None:
    said: list[str] = []
    tab = opened(browser, page, said)
    assert said == []
    broken = "[...document.links].map(a => a.getAttribute('href')).filter(h => h[0] === '#' && !document.getElementById(h.slice(1)))"
    assert tab.evaluate(broken) == []
    others = tab.evaluate("[...document.links].map(a => a.getAttribute('href')).filter(h => h[0] !== '#')")
    assert {one.partition(",")[0] for one in others} == {
        "https://arxiv.org/abs/2505.13294",
        source()["address"],
        "data:application/json;base64",
    }
    assert tab.evaluate("new Set([...document.querySelectorAll('[id]')].map(e => e.id)).size === document.querySelectorAll('[id]').length")
    tab.context.close()


@pytest.mark.programs
@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.slow)])
def test_axe_finds_nothing(browser: Any, page: Path, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    tab = opened(browser, page, [], color_scheme=scheme)
    tab.evaluate("document.querySelectorAll('details').forEach(one => one.open = true)")
    tab.evaluate(f"document.querySelectorAll('{LIKE_OTHERS}').forEach(one => one.remove())")
    assert [(one["id"], one["nodes"][0]["html"]) for one in axe.run(tab).response["violations"]] == []
    tab.evaluate(f"document.querySelector('h1').style.color = '{'#ddd' if scheme == 'light' else '#333'}'")
    assert [one["id"] for one in axe.run(tab, context="h1").response["violations"]] == ["color-contrast"]
    tab.context.close()


@pytest.mark.programs
def test_the_keyboard_reaches_everything(browser: Any, page: Path) -> None:
    tab = opened(browser, page, [])
    tab.keyboard.press("Tab")
    assert tab.evaluate("document.activeElement.className") == "skip"
    tab.keyboard.press("Enter")
    assert tab.evaluate("document.activeElement.id") == "content"
    tab.locator("#claims summary").first.focus()
    tab.keyboard.press("Enter")
    assert tab.evaluate("document.activeElement.parentElement.open")
    scrolled = (
        "[...document.querySelectorAll('*')].filter(e => e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX === 'auto')"
    )
    assert tab.evaluate(f"{scrolled}.filter(e => e.tabIndex < 0).map(e => e.outerHTML.slice(0, 80))") == []
    tab.context.close()


@pytest.mark.programs
def test_a_link_into_what_is_closed_opens_it(browser: Any, page: Path) -> None:
    tab = opened(browser, page, [])
    place = tab.get_attribute("#certificates ~ details li[id]", "id")
    assert not tab.is_visible(f"#{place}")
    tab.evaluate(f"location.hash = '{place}'")
    tab.wait_for_selector(f"#{place}", state="visible")
    tab.context.close()


@pytest.mark.programs
def test_a_phone_shows_it_without_scrolling_sideways(browser: Any, page: Path) -> None:
    tab = opened(browser, page, [], viewport=PHONE)
    tab.evaluate("document.querySelectorAll('details').forEach(one => one.open = true)")
    assert tab.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    tab.evaluate("document.body.append(Object.assign(document.createElement('pre'), {style: 'width: 500px'}))")
    assert tab.evaluate("document.documentElement.scrollWidth") > PHONE["width"]
    tab.context.close()


@pytest.mark.programs
def test_on_paper_everything_is_open(browser: Any, page: Path, tmp_path: Path) -> None:
    tab = opened(browser, page, [])
    tab.pdf(path=tmp_path / "page.pdf", tagged=True)
    tab.emulate_media(media="print")
    tab.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert tab.locator("details:not([open])").count() == 0
    assert not tab.is_visible("nav.contents") and tab.is_visible("#certificates ~ details li[id] >> nth=0")
    tab.evaluate("dispatchEvent(new Event('afterprint'))")
    assert tab.locator("details:not([open])").count() > 0
    assert (tmp_path / "page.pdf").read_bytes().startswith(b"%PDF")
    tab.context.close()
    pikepdf = pytest.importorskip("pikepdf")
    plain = (tmp_path / "page.pdf").stat().st_size
    printing.packed(tmp_path / "page.pdf")
    assert (tmp_path / "page.pdf").stat().st_size < 0.6 * plain
    with pikepdf.open(tmp_path / "page.pdf") as packed:
        assert len(packed.pages) > 5 and "/StructTreeRoot" in packed.Root, "it can still be read aloud"


@pytest.mark.programs
def test_what_is_not_as_expected_is_the_first_thing_seen(browser: Any, records: Records, tmp_path: Path) -> None:
    tab = opened(browser, written(render(changed(records, another_verdict)), tmp_path / "report.html"), [])
    assert tab.title().startswith("NOT as expected")
    first = tab.locator("main > *").first
    assert first.get_attribute("role") == "alert"
    assert f"{PAIR}, n-plus-1-samples: the verdict is CERTIFIED, PROVED was expected" in first.inner_text()
    assert first.bounding_box()["y"] < 100 and tab.locator("h1").count() == 1 and "not as expected" in tab.inner_text("h1")
    tab.context.close()


def test_the_page_is_small_and_complete(records: Records, page: Path) -> None:
    text = page.read_text("utf-8")
    assert len(text) < LARGEST
    parts = re.findall(r'<section id="(\w+)"', text)
    assert parts == ["claims", "review", "trust", "hypotheses", "measured", "withdrawn", "honest", "appendix"]
    assert text.index('class="facts"') < text.index('id="claims"')
    assert render(records) == text, "equal records give equal pages"
    assert "faultspace verify --effort quick --claim example-v --out RUN &amp;&amp; faultspace report --run RUN" in text
    for one in records.run.origin["checkers"]:
        assert one["sha256"] in text
    assert "whoever could write there could write them" in text[text.index('id="trust"') : text.index('id="controls"')]
    assert '<a class="word" href="#word-lag">' in text and '<dt id="word-lag">' in text
    assert "<math" in text and "F = (1, a, a^2)" not in text and "<msup><mi>a</mi><mn>2</mn></msup>" in text
    plain = html.unescape(re.sub(r"<[^>]*>", "", text))
    assert "A sentence on theorem-1." in plain and all(point.says in plain for point in review())


def test_nothing_of_a_record_becomes_markup(records: Records) -> None:
    attack = "<script>alert(1)</script>"

    def change(verdicts: dict[str, Any]) -> None:
        verdicts["claims"][0]["as_stated"] = verdicts["claims"][0]["readings"][0]["evidence"] = attack
        verdicts["claims"][0]["reference"] = f"[G25] {attack}"
        verdicts["hypotheses"][0]["evidence"] = verdicts["rocq"] = attack

    text = render(changed(records, change))
    assert attack not in text and "&lt;script&gt;" in text


def not_accepted(records: Records) -> Records:
    first = next(iter(records.checked))
    return replace(records, checked={**records.checked, first: {"accepted": False, "words": "a rank is wrong", "assumes": []}})


def spoiled_accepted(records: Records) -> Records:
    kinds = {kind: {**row, "accepted": ["0" * 64]} for kind, row in records.controls["spoiled"].items()}
    return replace(records, controls={**records.controls, "spoiled": kinds})


def another_checker(records: Records) -> Records:
    first, *others = records.run.origin["checkers"]
    return replace(records, run=replace(records.run, origin={**records.run.origin, "checkers": [{**first, "sha256": "0" * 64}, *others]}))


def claim_error(verdicts: dict[str, Any]) -> None:
    verdicts["claims"][0]["verdict"] = "ERROR"


def row_wrong(verdicts: dict[str, Any]) -> None:
    verdicts["hypotheses"][0]["verdict"] = "REFUTED"


def certificate_missing(verdicts: dict[str, Any]) -> None:
    verdicts["claims"][0]["readings"][0]["certificates"][0]["sha256"] = "f" * 64


def nothing_decided(verdicts: dict[str, Any]) -> None:
    verdicts["claims"] = []


ATTACKS: dict[str, tuple[Callable[[Records], Records], str]] = {
    "a reading": (lambda found: changed(found, another_verdict), "the verdict is CERTIFIED, PROVED was expected"),
    "a claim": (lambda found: changed(found, claim_error), "the verdict is ERROR"),
    "a hypothesis": (lambda found: changed(found, row_wrong), "CERTIFIED was expected"),
    "no claim": (lambda found: changed(found, nothing_decided), "no claim was decided"),
    "a certificate that is missing": (lambda found: changed(found, certificate_missing), "are not in its folder"),
    "a certificate that is refused": (not_accepted, "the checker refused it: a rank is wrong"),
    "a spoiled one that is accepted": (spoiled_accepted, "the checker accepted 1 of"),
    "a run by another checker": (another_checker, "this page was made with another checker.py than the run"),
}


@pytest.mark.parametrize("what", ATTACKS)
def test_everything_that_is_wrong_is_an_alarm(records: Records, what: str) -> None:
    change, words = ATTACKS[what]
    found = change(records)
    assert alarms(claims(records, ()), records) == []
    assert any(words in one.words for one in alarms(claims(found, ()), found))


def test_the_page_of_a_run_that_decided_nothing_says_so_first(records: Records) -> None:
    text = render(changed(records, nothing_decided))
    head = text[text.index("<main") : text.index("<header>")]
    assert 'role="alert"' in head and "no claim was decided" in head


def test_spoiled_certificates_are_false_and_refused(records: Records) -> None:
    rows = records.controls["spoiled"]
    assert {"window-ranks", "behaviour-difference", "fault-space"} <= set(rows) and all(
        row["tried"] and not row["accepted"] for row in rows.values()
    )
    assert all(one["refused"] for one in records.controls["statements"])
    certificate = next(one for one in records.run.certificates.values() if one["kind"] == "window-ranks")
    other = controls.spoiled(certificate)
    assert other is not None and other["statement"] != certificate["statement"] and other["witness"] == certificate["witness"]


def test_the_figures_are_those_of_exact_and_floats(records: Records) -> None:
    assert records.example["exact"] == [2, 4, 5, 6, 7, 8] == records.example["default_true"]
    assert [curve["right"] for curve in records.convergence["curves"]] == [False, True, False]


def test_what_was_withdrawn_is_read_from_the_changelog() -> None:
    entries = withdrawn()
    assert entries is not None and len(entries) > 10 and all(entries)
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    part = text.split("### Withdrawn")[1].split("\n### ")[0]
    assert len(entries) == len(re.findall(r"^- ", part, re.MULTILINE))
    assert "2505.13294" in sources()["G25"]


def test_numbers_become_mathml_and_what_is_none_stays_text() -> None:
    assert mathml.number("-3/4") == "<mrow><mo>&#x2212;</mo><mfrac><mn>3</mn><mn>4</mn></mfrac></mrow>"
    assert "<msup><mi>a</mi><mn>2</mn></msup>" in mathml.number("4 a^2 - a")
    assert mathml.number("1/2...<b>") == "<mtext>1/2...&lt;b&gt;</mtext>"
    assert "empty, 0 x 2" in mathml.matrix({"rows": 0, "columns": 2, "entries": []}, "F")
    assert mathml.typeset([["1", "2"]]) == {"rows": 1, "columns": 2, "entries": [["1", "2"]]}


def test_ticks_lie_on_the_axis() -> None:
    for axis in (Axis(0.1, 1000, True), Axis(-0.3, 8.4), Axis(0, 1e-3)):
        assert axis.ticks() and all(-1e-9 <= axis.at(one) <= 1 + 1e-9 for one in axis.ticks())


def test_the_server_shows_the_page_alone_and_to_this_machine_alone() -> None:
    with serving("<!doctype html>é") as address:
        assert address.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(address) as answer:
            assert answer.read().decode("utf-8") == "<!doctype html>é" and answer.headers["Content-Type"] == "text/html; charset=utf-8"
        with pytest.raises(HTTPError, match="404"):
            urllib.request.urlopen(f"{address}verdicts.json")


def test_the_command_writes_page_and_json(records: Records, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reporting, "gather", lambda run, sizes, on_progress: replace(records, run=run))
    folder = small_run(tmp_path / "run")
    done = call("report", "--run", str(folder), "--out", str(tmp_path / "a" / "b"), "--json")
    assert done.code == 0, done.err
    assert done.json == {"page": str(tmp_path / "a" / "b" / "report.html"), "as_expected": True, "alarms": [], "pdf": None}
    assert [path.name for path in (tmp_path / "a" / "b").iterdir()] == ["report.html"]
    spoil(folder, another_verdict)
    done = call("report", "--run", str(folder), "--out", str(tmp_path))
    assert done.code == 1 and "n-plus-1-samples" in done.out


@pytest.mark.parametrize(
    ("document", "words"),
    [
        (None, "is not there"),
        ("{", "cannot be read as JSON"),
        ("[]", "got no object"),
        ("{}", "key 'effort' is missing"),
        ('{"effort": "quick", "corpus": "", "rocq": "", "seconds": 1, "versions": {}, "claims": 3, "hypotheses": []}', "got 3 for claims"),
        ('{"effort": "quick", "corpus": "", "rocq": "", "seconds": 1, "versions": {}, "claims": [7], "hypotheses": []}', "in claims"),
    ],
)
def test_a_folder_that_is_no_run_is_refused_in_one_line(tmp_path: Path, document: str | None, words: str) -> None:
    (tmp_path / "origin.json").write_text('{"time": "", "commit": null, "changed": false, "checkers": [], "command": ""}', "utf-8")
    if document is not None:
        (tmp_path / "verdicts.json").write_text(document, "utf-8")
    done = call("report", "--run", str(tmp_path), "--out", str(tmp_path / "out"))
    assert done.code == 2 and words in done.err and len(done.err.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_without_a_chromium_the_pdf_is_refused_before_anything_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda name: None)
    done = call("report", "--run", str(tmp_path), "--out", str(tmp_path / "out"), "--pdf")
    assert done.code == 2 and "--pdf: got no Chromium" in done.err and not (tmp_path / "out").exists()


def test_a_run_of_its_own_takes_no_folder_that_has_files(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "mine-1.json").write_text("{}", "utf-8")
    with pytest.raises(InvalidInput, match="expected an empty folder or none"):
        made(None, tmp_path, "quick", 1, silent)
    assert (tmp_path / "run" / "mine-1.json").read_text("utf-8") == "{}"


def test_what_a_run_of_its_own_has_decided_is_kept_where_the_rest_is_broken_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken_off(*arguments: object, **options: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(reporting, "verify", lambda **options: fs.verify(["example-v"], jobs=1))
    monkeypatch.setattr(reporting, "gather", broken_off)
    with pytest.raises(KeyboardInterrupt):
        made(None, tmp_path, "quick", 1, silent)
    assert [one["id"] for one in read_run(tmp_path / "run").verdicts["claims"]] == ["example-v"]
    with pytest.raises(InvalidInput, match=r"its page is made by --run \S*run"):
        made(None, tmp_path, "quick", 1, silent)


@pytest.mark.slow
def test_the_page_of_a_whole_run(browser: Any, tmp_path: Path) -> None:
    """The command as README has it, with PDF and server: as expected, small, opened within seconds, clean in both colours."""
    heard = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "  # a shell in the background ignores it
    line = [sys.executable, "-c", f"{heard}from faultspace.cli.command_line import main; sys.exit(main(sys.argv[1:]))"]
    line += ["report", "--out", str(tmp_path), "--jobs", "2", "--pdf", "--serve"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT, env=environment()) as running:
        try:
            assert running.stderr is not None
            address = next((found.group() for said in running.stderr if (found := re.search(r"http://127\.0\.0\.1:\d+/", said))), None)
            assert address is not None
            with urllib.request.urlopen(address) as answer:
                text = answer.read()
            running.send_signal(signal.SIGINT)
            assert running.wait(60) == 0
        finally:
            running.kill()
    page = tmp_path / "report.html"
    assert page.read_bytes() == text and len(text) < LARGEST
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF") and (tmp_path / "report.pdf").stat().st_size > 100_000
    for scheme in ("light", "dark"):
        said: list[str] = []
        tab = opened(browser, page, said, color_scheme=scheme)
        assert said == [] and "NOT" not in tab.title()
        assert tab.locator("article[id^=claim-]").count() == len(load())
        assert tab.evaluate("performance.getEntriesByType('navigation')[0].loadEventEnd") < 5000  # a busy machine; alone it takes a fifth
        axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
        tab.evaluate("document.querySelectorAll('details').forEach(one => one.open = true)")
        assert [(one["id"], one["nodes"][0]["html"]) for one in axe.run(tab).response["violations"]] == []
        tab.context.close()
