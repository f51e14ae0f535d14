"""Names, paths and texts of claims are text: on a terminal, in pages and Markdown, in tables and pictures, in refusals."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from faultspace.base.messages import say
from faultspace.base.others_text import as_label, as_markdown, printable, table_cell
from faultspace.base.page import page
from faultspace.numeric import StateSpaceModel
from faultspace.numeric.plant.report import result_pictures as pictures
from tests.end_to_end.commands import Run, call

ADDRESS = "http://evil.example"
FETCHING = (
    f"![x]({ADDRESS}/a.png)",
    f"[x]({ADDRESS})",
    f"<{ADDRESS}/>",
    f"<img src={ADDRESS}/i.png>",
    f'"><script src={ADDRESS}></script>',
)
CONTROLLING = ("red\x1b[31m", f"\x1b]8;;{ADDRESS}\x1b\\link", "c1\x9b31m", "turned\u202egnol", "apart\u2066x", "bell\x07", "del\x7f")
OTHERS = (
    "Var$a_$",
    "$\\frac{1}{0}$",
    "=cmd|' /C calc'!A0",
    "&lt;b&gt;",
    "**a**",
    "_e_",
    "`c`",
    "# h",
    "- i",
    "[red]r[/red]",
    "{0}",
    "y" * 300,
)
CONTROL = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u2028\u2029]")
PLANT = StateSpaceModel([[0.5]], [[1.0]], np.ones((24, 1)), np.zeros((24, 1)))


@pytest.fixture(scope="module")
def answered(tmp_path_factory: pytest.TempPathFactory) -> tuple[Run, Path]:
    """Identify a record whose outputs have all these names."""
    names = [*FETCHING, *CONTROLLING, *OTHERS]
    rng = np.random.default_rng(1)
    u = rng.standard_normal((300, 1))
    y = PLANT.simulate(u)[:, : len(names)] + 0.01 * rng.standard_normal((300, len(names)))
    y[150:, 0] += 0.3
    folder = tmp_path_factory.mktemp("names")
    with open(folder / "data.csv", "w", encoding="utf-8", newline="") as stream:
        csv.writer(stream).writerows([["u", *names], *np.hstack([u, y]).tolist()])
    quoted = ['"{}"'.format(name.replace('"', '""')) for name in names]
    options = [option for name in quoted for option in ("--outputs", name)]
    run = call("identify", str(folder / "data.csv"), "--inputs", "u", *options, "--order", "1", "--out", str(folder / "out"), "-v")
    return run, folder / "out"


def test_no_name_moves_the_terminal_or_ends_the_command(answered: tuple[Run, Path]) -> None:
    run, out = answered
    assert run.code == 0 and CONTROL.search(run.out + run.err) is None
    assert "red\\x1b[31m" in run.out and "[red]r[/red]" in run.out
    for file in out.glob("*.[cmhj]*"):
        assert CONTROL.search(file.read_text("utf-8")) is None, file.name
    head = next(csv.reader((out / "residual.csv").read_text("utf-8").splitlines()))
    assert "'=cmd|' /C calc'!A0" in head and "'- i" in head and "an apostrophe stands before" in run.err


def test_the_page_asks_for_nothing_and_shows_names_as_they_are(answered: tuple[Run, Path], browser: Any) -> None:
    asked: list[str] = []
    tab = browser.new_page()
    tab.on("request", lambda request: asked.append(request.url) if not request.url.startswith(("file:", "data:")) else None)
    tab.on("console", lambda message: asked.append(message.text))
    tab.goto((answered[1] / "report.html").as_uri())
    assert asked == [] and tab.evaluate("document.querySelectorAll('a, script, link, iframe').length") == 0
    assert all(name in tab.inner_text("main") for name in (*FETCHING, *OTHERS[:-1])), "a name is shown as it stands"
    assert tab.evaluate("getComputedStyle(document.querySelector('.tile')).borderLeftStyle") in ("solid", "dashed"), "the style is ours"
    tab.evaluate(f"document.body.append(Object.assign(new Image(), {{src: '{ADDRESS}/late.png'}}))")
    tab.wait_for_timeout(200)
    assert any("Content Security Policy" in one and "blocked" in one for one in asked), "whatever gets into the page fetches nothing"
    tab.close()


def test_names_are_text_where_a_page_reads_markdown_of_others() -> None:
    shown = page("t", "# t\n\n" + "\n\n".join(FETCHING) + f"\n\n[r]\n\n[r]: {ADDRESS}\n")
    assert "<a" not in shown and "<script" not in shown and shown.count("<img") == 0 and "default-src 'none'" in shown


@given(st.text(st.characters(codec="utf-8"), max_size=40))
def test_markdown_shows_any_text_as_it_stands(text: str) -> None:
    text = " ".join(printable(text).split())
    rendered = MarkdownIt("commonmark", {"html": True}).render(as_markdown(text, first=True))
    assert rendered == (f"<p>{escape(text, quote=False).replace(chr(34), '&quot;')}</p>\n" if text else "")


@pytest.mark.parametrize("begins", ["=", "+", "-", "@", "\t=", " =", "\r", "\uff1d"])
def test_a_cell_is_no_formula(begins: str) -> None:
    assert table_cell(f"{begins}1") == f"'{begins}1" and table_cell("level = 1") == "level = 1"


def test_refusals_and_tracebacks_are_text(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in CONTROLLING:
        say(f"got {name}")
        call("inspect", f"{tmp_path}/{name}")
    monkeypatch.setenv("FAULTSPACE_TRACEBACK", "1")

    def failing(*_: object, **__: object) -> None:
        raise ValueError("\x1b[31m")

    monkeypatch.setattr("faultspace.cli.inspecting.run", failing)
    assert call("inspect", "x").code == 70
    said = capsys.readouterr()
    assert CONTROL.search(said.err + said.out) is None and "\\x1b[31m" in said.err


def test_texts_of_claims_are_text(tmp_path: Path) -> None:
    file = tmp_path / "claims.toml"
    escapes = "a\\u001b[31m\\u202e\\u009b[bold]"
    file.write_text(f'[claim.one]\nstatement = "{escapes}"\nsource = "{escapes}"\nconclusion = "lag <= n"\nfields = ["GF(2)"]\n', "utf-8")
    run = call("claim", str(file), "--no-ablation")
    assert run.code == 0 and CONTROL.search(run.out + run.err) is None and "[bold]" in run.out


def test_a_picture_that_fails_is_a_remark(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")

    def failing() -> Any:
        raise RuntimeError("no such glyph")

    (remark,) = pictures.drawn(tmp_path / "one.png", failing)
    assert "one.png" in remark and "no such glyph" in remark and not (tmp_path / "one.png").exists()


def giving(value: Any) -> Callable[[], Any]:
    """Return the function that returns the value."""
    return lambda: value


def test_no_name_is_mathematics_in_a_picture(rendered: None, tmp_path: Path) -> None:
    figure = pytest.importorskip("matplotlib.figure")
    for name in (*OTHERS, "$$", "$x$ $", "\\$a\\$"):
        made = figure.Figure()
        made.add_subplot().set_title(as_label(name))
        assert pictures.drawn(tmp_path / f"{abs(hash(name))}.png", giving(made)) == [], name
        assert made.axes[0].title._preprocess_math(as_label(name))[1] is False, name
