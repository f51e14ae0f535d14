"""How Sphinx builds the site: `sphinx-build -W -c docs . build/site`, with what the extra `site` installs; nothing is fetched.

The source folder is the root of the tree, so that README, CHANGELOG and the pages of the rooms stand where readers of the tree find them,
and their links lead to each other in the site as well. A link to a file that is no page gives the file itself; one to a folder, which has
no page, is text. Tutorials are notebooks in Markdown, which are run when the site is built.

build/pages     pages that are not in the tree are made anew, before any page is read
opened          index.html at the root of the site, which leads to the first page
inlined         drawings become part of their page, so that they have the colours of the theme, light or dark
whole           a long statement is one element
unlinked        links to folders become text
reachable       what scrolls can be scrolled by the keyboard, and what a screen reader announces has a name
as_written      docstrings are shown with their words as they stand, examples apart
"""

from __future__ import annotations

import re
import sys
from html import escape
from pathlib import Path
from typing import Any

from docutils import nodes

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

import faultspace  # noqa: E402  the tree that the pages belong to, not one that is installed
from docs.tools.pages import write  # noqa: E402

project = "faultspace"
author = "The faultspace authors"
version = release = faultspace.__version__
html_title = f"faultspace {version}"

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
root_doc = "docs/index"
# Pages, each named: the tree has links from room to room, by which a pattern would find files twice.
include_patterns = [
    *("docs/**.md", "README.md", "CHANGELOG.md", "CONTRIBUTING.md", "BIBLIOGRAPHY.md", "benchmarks/README.md"),
    *("proofs/trust/FORMAT.md", "proofs/trust/READING.md", "proofs/theory/README.md", "build/pages/*.md"),
    *("proofs/counterexamples/README.md", "numeric/audit/README.md", "numeric/audit/FINDINGS.md", "numeric/audit/RULES.md"),
    *("numeric/audit/PROTOCOL.md", "numeric/audit/peers/by_hand.md"),
    "numeric/audit/upstream/readers/README.md",
]
html_theme = "furo"
html_show_sourcelink = False
html_copy_source = False
html_show_copyright = False
html_static_path = ["site.css"]
html_css_files = ["site.css"]
pygments_style, pygments_dark_style = "a11y-light", "a11y-dark"

myst_heading_anchors = 4
nb_execution_mode = "force"
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_execution_show_tb = True
# Formulas of LaTeX would be drawn by a script that a browser fetches; what a cell shows has words for it as well.
nb_mime_priority_overrides = [("*", "text/latex", None)]
# A page is the same wherever it is built.
nb_number_source_lines = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
default_role = "code"
toc_object_entries = False


def opened(app: Any, problem: Exception | None) -> None:
    """Write index.html, by which a browser or a server finds the first page."""
    if problem is None and app.builder.name == "html":
        page = f'<!doctype html><meta charset="utf-8"><title>{project}</title><meta http-equiv="refresh" content="0; url={root_doc}.html">'
        (Path(app.outdir) / "index.html").write_text(f'{page}<a href="{root_doc}.html">{project}</a>\n', "utf-8")


# What the theme leaves out: levels of the menu's headings, names of the drawers at the sides, a place for the keyboard in what scrolls,
# the title of the search, and a cell at the corner of a table heads nothing.
MENDED = {
    '<p class="caption" role="heading">': '<p class="caption" role="heading" aria-level="2">',
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="All pages">',
    '<aside class="toc-drawer">': '<aside class="toc-drawer" aria-label="Parts of this page">',
    "<pre>": '<pre tabindex="0">',
    'colwidths-auto docutils container">': 'colwidths-auto docutils container" tabindex="0">',
    '<th class="head"><p></p></th>': "<td></td>",
    '</noscript>\n\n<div id="search-results">': '</noscript>\n<h1>Search</h1>\n<div id="search-results">',
}


def mended(page: str) -> str:
    """Return the HTML of a page with MENDED; one that has been mended stays as it is."""
    for as_made, better in MENDED.items():
        page = page.replace(as_made, better)
    return page


def reachable(app: Any, problem: Exception | None) -> None:
    """Mend every page that was written."""
    if problem is None and app.builder.name == "html":
        for path in Path(app.outdir).rglob("*.html"):
            page = path.read_text("utf-8")
            if (better := mended(page)) != page:
                path.write_text(better, "utf-8")


def inlined(app: Any, tree: nodes.document, name: str) -> None:
    """Put the text of each drawing of docs/drawings in place of its image, without the colours that it has where it stands alone."""
    for image in list(tree.findall(nodes.image)):
        if image["uri"].startswith("docs/drawings/"):
            drawing = re.sub(r"<style>.*?</style>", "", (ROOT / image["uri"]).read_text("utf-8"), flags=re.DOTALL)
            image.replace_self(nodes.raw("", drawing, format="html"))


def whole(app: Any, tree: nodes.document, name: str) -> None:
    """Make one element of a long statement, of which Sphinx makes an element a word: the page of all statements had 50 000 of them."""
    for literal in list(tree.findall(nodes.literal)):
        if len(literal.astext().split()) > 12:
            text = f'<code class="docutils literal notranslate">{escape(literal.astext())}</code>'
            literal.replace_self(nodes.raw("", text, format="html"))


def unlinked(app: Any, name: str, source: list[str]) -> None:
    """Leave the words alone of a link to a folder of the tree, which has no page; what leads nowhere stays, and is a warning."""
    here = (ROOT / app.env.doc2path(name)).parent
    source[0] = re.sub(r"\[([^\[\]]*)\]\(([\w./-]+)\)", lambda link: link[1] if (here / link[2]).is_dir() else link[0], source[0])


def as_written(app: Any, what: str, name: str, found: Any, options: Any, lines: list[str]) -> None:
    """Escape what a docstring does not mean as markup, outside its examples: stars, bars, and underscores at the end of a name."""
    for at, line in enumerate(lines):
        if not line.startswith((">>> ", "... ")):
            parts = re.split(r"(`[^`]*`)", line)
            parts[::2] = [re.sub(r"([*|\\_])", r"\\\1", part) for part in parts[::2]]
            lines[at] = "".join(parts)


def setup(app: Any) -> None:
    """Connect the functions above with the events of Sphinx that they answer."""
    app.connect("config-inited", lambda app, config: write(ROOT / "build" / "pages"))
    app.connect("build-finished", opened)
    app.connect("build-finished", reachable)
    app.connect("doctree-resolved", inlined)
    app.connect("doctree-resolved", whole)
    app.connect("source-read", unlinked)
    app.connect("autodoc-process-docstring", as_written)
