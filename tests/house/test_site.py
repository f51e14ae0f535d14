"""The site: every page is in its menu, words and drawings say what the code says, every block is run, and nothing warns when it is built.

blocks       the Python blocks of a page
run_cells    run the cells of a tutorial, one after the other, as the site does
resolved     what a dotted name of the glossary stands for
"""

from __future__ import annotations

import importlib.util
import json
import re
import runpy
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from pkgutil import resolve_name
from textwrap import dedent
from threading import Thread
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter

import faultspace as fs
from docs.tools.pages import PAGES as MADE
from faultspace.exact import read_system
from faultspace.packaged_examples import content
from faultspace.review.printing import NAMES

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
TUTORIALS = sorted((DOCS / "tutorials").glob("*.md"))
# The longest are run by `python -m pytest -m slow`, and whenever the site is built.
DAILY = ("read-a-certificate",)


def text(page: str) -> str:
    """The words of a page of docs/."""
    return (DOCS / page).read_text("utf-8")


def below(page: str) -> set[str]:
    """The pages that a page of docs/ has below it in the menu."""
    blocks = re.findall(r"```\{toctree\}\n(.*?)```", text(page), re.DOTALL)
    found = {re.sub(r".* <(.+)>$", r"\1", line.strip()) for block in blocks for line in block.splitlines()}
    return {name for name in found if name and not name.startswith(":")}


def test_every_page_is_in_the_menu_and_the_menu_is_short() -> None:
    first = below("index.md")
    assert len(first) <= 15
    menu = first | {one for name in first if not name.startswith("../") for one in below(f"{name}.md")}
    pages = {page.relative_to(DOCS).with_suffix("").as_posix() for page in DOCS.rglob("*.md")} - {"index"}
    assert {name for name in menu if not name.startswith("../")} == pages and len(pages) > 15
    made = {f"../build/pages/{name.removesuffix('.md')}" for name in MADE}
    assert made <= menu - first and [name for name in menu - made if name.startswith("../") and not (DOCS / f"{name}.md").exists()] == []


def without_a_part(page: str) -> list[str]:
    """The decisions of a page that do not say what was decided, what it cost and what was given up, in this order."""
    parts = r"\n\n\*What was decided, and why\.\* .+\n\n\*What it cost\.\* .+\n\n\*What was given up\.\* .+"
    return [one.partition("\n")[0] for one in page.split("\n## ")[1:] if not re.search(parts, one, re.DOTALL)]


def test_every_decision_says_what_it_cost_and_what_was_given_up() -> None:
    page = text("decisions.md")
    assert page.count("\n## ") > 10 and without_a_part(page) == []
    first = page.index("*What was given up.*")
    assert len(without_a_part(page[:first] + page[first + 20 :])) == 1


def resolved(name: str) -> Any:
    """Return the object, or the field of a record, that a dotted name stands for."""
    owner, _, last = name.rpartition(".")
    found = resolve_name(owner)
    if is_dataclass(found) and last in {field.name for field in fields(found)}:
        return last
    return resolve_name(name)


def entries() -> list[tuple[str, str]]:
    """Every word of the glossary with what stands below it."""
    return re.findall(r"^### (.+)\n\n((?:.+\n)+)", text("glossary.md"), re.MULTILINE)


def test_every_word_has_its_symbol_source_and_place_in_the_code() -> None:
    known = set(re.findall(r"^- \*\*\[(\w+)\]\*\*", (ROOT / "BIBLIOGRAPHY.md").read_text("utf-8"), re.MULTILINE))
    assert len(entries()) == text("glossary.md").count("\n### ") > 30
    for word, below in entries():
        found = re.fullmatch(r"Symbol: .+?\. .+\.\nSource: (?:\[(\w+)\]|the word is ours)\. Code: `([\w.]+)`\.\n", below)
        assert found, word
        assert found[1] is None or found[1] in known, word
        resolved(found[2])
    with pytest.raises(AttributeError):
        resolved("faultspace.exact.Structure.no_such_field")


def test_the_words_that_papers_use_are_there() -> None:
    words = {"lag", "left-invertible", "output-nulling subspace", "markov parameters", "persistency of excitation"}
    assert words <= {name.lower() for name, _ in entries()}


def test_every_link_of_the_site_finds_its_page_and_section() -> None:
    for page in DOCS.rglob("*.md"):
        for link, section in re.findall(r"\]\(([\w./-]*)(?:#([\w-]+))?\)", page.read_text("utf-8")):
            target = page.parent / link if link else page
            assert target.exists(), (page.name, link)
            if section and target.suffix == ".md":
                titles = re.findall(r"^#+ (.+)$", target.read_text("utf-8"), re.MULTILINE)
                assert section in {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}, (page.name, link, section)


def test_the_drawings_have_the_numbers_of_the_code() -> None:
    kernel = fs.analyze(read_system(json.loads(content("example:paper")))).kernel
    lag = text("drawings/lag.svg")
    assert f"= {', '.join(str(kernel.rank(s)) for s in range(1, 7))} for s" in lag and f"whose lag is {kernel.lag}." in lag
    zeros = fs.analyze(fs.System(A=[["1/2"]], F=[["-3/2"]], C=[[1]], G=[[1]]))
    assert zeros.invariant_zero_polynomial == (-2, 1) and "a zero at 2" in text("drawings/zeros.svg")


def test_nothing_is_fetched_by_the_drawings() -> None:
    for drawing in (DOCS / "drawings").glob("*.svg"):
        words = drawing.read_text("utf-8").replace("http://www.w3.org/2000/svg", "")
        assert "://" not in words and "<title" in words and "<desc" in words


def blocks(page: Path) -> Iterator[str]:
    """Yield the blocks of Python of a page that are no cells of a tutorial."""
    yield from map(dedent, re.findall(r"^ *```python\n(.*?)^ *```", page.read_text("utf-8"), re.MULTILINE | re.DOTALL))


LONG = ("your-claims.md", "your-data.md")  # one looks for bounds, and one identifies, for a quarter of a minute and more
PAGES_WITH_CODE = [page for page in (ROOT / "README.md", *sorted(DOCS.rglob("*.md"))) if list(blocks(page))]


@pytest.mark.parametrize(
    "page",
    [pytest.param(page, marks=[pytest.mark.slow] if page.name in LONG else [], id=page.name) for page in PAGES_WITH_CODE],
)
def test_the_blocks_of_python_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "page"}  # a block goes on where the one before it ended
    if page.name == "your-data.md":
        names |= data_of_the_reader()
    for block in blocks(page):
        exec(compile(block, str(page), "exec"), names)


def data_of_the_reader() -> dict[str, Any]:
    """The records and the model that the page on data takes the reader to have; a file data.csv is written where the test runs."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    records = []
    for seed in range(3):
        u, fault, noise = (np.random.default_rng((seed, k)).standard_normal(600) for k in range(3))
        level = lfilter([0, 1], [1, -0.7], u)
        records.append((np.column_stack([level + 0.01 * noise, 0.5 * level + fault]), u[:, None]))
    y, u = records[0]
    healthy = np.column_stack([y[:, 0], 0.5 * y[:, 0] + 0.01 * np.roll(y[:, 1], 7)])
    np.savetxt("data.csv", np.column_stack([u, y]), delimiter=",", header="valve,level,flow", comments="")
    return {
        **{f"y{k + 1}": one for k, (one, _) in enumerate(records)},
        **{f"u{k + 1}": one for k, (_, one) in enumerate(records)},
        **{"y": y, "u": u, "model": fs.identify(healthy, u).model, "y_healthy": healthy, "u_healthy": u, "y_now": y[0], "u_now": u[0]},
        "pieces": lambda: ((y[k : k + 200], u[k : k + 200]) for k in range(0, 600, 200)),
    }


def run_cells(tutorial: Path) -> int:
    """Run the cells of a tutorial and return how many there are; what one raises is raised."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    page = tutorial.read_text("utf-8")
    cells = re.findall(r"```\{code-cell\}\n(.*?)```", page, re.DOTALL)
    assert len(cells) == page.count("{code-cell}"), "a cell is not recognised"
    names: dict[str, Any] = {"__name__": "tutorial"}
    for cell in cells:
        exec(compile(cell, str(tutorial), "exec"), names)
    names["plt"].close("all")
    return len(cells)


@pytest.mark.parametrize("tutorial", [page for page in TUTORIALS if page.stem in DAILY], ids=lambda page: page.stem)
def test_a_tutorial_runs(tutorial: Path) -> None:
    assert run_cells(tutorial) >= 5


@pytest.mark.slow
@pytest.mark.parametrize("tutorial", [page for page in TUTORIALS if page.stem not in DAILY], ids=lambda page: page.stem)
def test_a_long_tutorial_runs(tutorial: Path) -> None:
    assert run_cells(tutorial) >= 4


def test_the_reference_has_every_public_name() -> None:
    told = set(re.findall(r"auto(?:class|function|module):: faultspace\.(\w+)", text("api.md")))
    assert told == set(dir(fs)) - {"exact", "numeric", "proofs", "__version__"}


def test_the_settings_can_be_read_without_sphinx() -> None:
    if importlib.util.find_spec("docutils") is None:
        pytest.skip("docutils is not installed: pip install '.[site]'")
    settings = runpy.run_path(str(DOCS / "conf.py"))
    assert settings["release"] == fs.__version__
    assert ("*", "text/latex", None) in settings["nb_mime_priority_overrides"], "a browser would fetch what draws it"
    assert [name for name in settings["include_patterns"] if "*" not in name and not (ROOT / name).exists()] == []


def test_pages_are_mended_once() -> None:
    if importlib.util.find_spec("docutils") is None:
        pytest.skip("docutils is not installed: pip install '.[site]'")
    settings = runpy.run_path(str(DOCS / "conf.py"))
    page = "".join(settings["MENDED"])
    assert settings["mended"](settings["mended"](page)) == settings["mended"](page) == "".join(settings["MENDED"].values())


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the site, made as README tells."""
    for package in ("sphinx", "furo", "myst_nb", "matplotlib"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"{package} is not installed: pip install '.[site]'")
    folder = tmp_path_factory.mktemp("built") / "site"
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-c", "docs", ".", str(folder)]
    made = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    return folder


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_fetches_nothing(built: Path) -> None:
    pages = list(built.rglob("*.html"))
    assert len(pages) > 30
    for page in pages:
        html = page.read_text("utf-8")
        assert re.findall(r"<(?:script|img|iframe|source)[^>]*\ssrc=\"(?:https?:)?//[^\"]*", html) == [], page
        assert re.findall(r"<link[^>]*rel=\"(?:stylesheet|preload|preconnect)\"[^>]*href=\"(?:https?:)?//[^\"]*", html) == [], page


# The time that axe takes grows with the square of what is on a page, so that a long page is looked at a part after the other: blocks of its
# text with at most 2000 elements together (or one with more), all headings, and everything around the text.
PARTS = """() => {
    const blocks = [...document.querySelectorAll('article section > :not(section, h1, h2, h3, h4, h5, h6)')];
    let part = 0, size = 0;
    return blocks.map(block => {
        const more = block.querySelectorAll('*').length + 1;
        if (size > 0 && size + more > 2000) { part += 1; size = 0; }
        size += more;
        return [block, part];
    });
}"""
NUMBER_OF_PARTS = f"() => Math.max(0, ...({PARTS})().map(([_, part]) => part)) + 1"
PART_ALONE = f"wanted => {{ for (const [block, part] of ({PARTS})()) if (part !== wanted) block.remove(); }}"


@pytest.mark.slow
def test_a_browser_finds_nothing_wrong_with_the_site(built: Path) -> None:
    """It is served, for a browser keeps files apart: every page in light colours, its colours in dark ones, the width of a phone."""
    chromium = next((path for name in NAMES if (path := shutil.which(name)) is not None), None)
    if chromium is None:
        pytest.skip("no Chromium is here to look at the site with")
    playwright = pytest.importorskip("playwright.sync_api")
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    # The page at the top leads to docs/index.html at once, and a browser has left it before it is looked at.
    seen = [page for page in built.rglob("*.html") if "_static" not in page.parts and 'http-equiv="refresh"' not in page.read_text("utf-8")]
    pages = sorted(page.relative_to(built).as_posix() for page in seen)
    assert len(pages) > 30
    handler = partial(Silent, directory=str(built))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server, playwright.sync_playwright() as started:
        Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/"
        browser = started.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        for scheme in ("light", "dark"):
            context = browser.new_context(viewport={"width": 1280, "height": 900}, color_scheme=scheme)
            for name in pages:
                said: list[str] = []
                tab = context.new_page()
                tab.on("pageerror", lambda error, said=said: said.append(str(error)))
                tab.on("request", lambda asked, said=said: said.append(asked.url) if not asked.url.startswith((address, "data:")) else None)
                tab.goto(f"{address}{name}")
                rules = {} if scheme == "light" else {"runOnly": ["color-contrast"]}
                for part in range(tab.evaluate(NUMBER_OF_PARTS)):
                    if part > 0:
                        tab.reload()
                    tab.evaluate(PART_ALONE, part)
                    found = axe.run(tab, options=rules).response["violations"]
                    assert [(one["id"], one["nodes"][0]["html"]) for one in found] == [], (scheme, name, part)
                assert said == [], name
                tab.reload()
                tab.set_viewport_size({"width": 360, "height": 740})
                assert tab.evaluate("document.documentElement.scrollWidth") == 360, name
                tab.close()
        browser.close()
        server.shutdown()


class Silent(SimpleHTTPRequestHandler):
    """It tells nobody what was asked for."""

    def log_message(self, format: str, *arguments: object) -> None:
        """Say nothing."""
