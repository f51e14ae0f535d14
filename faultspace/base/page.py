"""Make one self-contained HTML page from Markdown and pictures: nothing is fetched, no script runs, light and dark, on paper and phones.

Tile      one answer at the head of a page: what it is of, the answer, what it rests on; open where nothing is decided
Picture   a PNG with its caption and the words for those who cannot see it, under one heading of the text
page      the page as text
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

from .others_text import policy

# HTML, pictures and links in the text, such as a channel's name, are shown as they stand and never become part of the page.
LONG = 30  # letters of an answer, from which on it is set smaller
WIDE = 1.2  # times as wide as tall a picture is that a phone shows at a size at which it can be read, to be scrolled
PRESET, OPTIONS = "commonmark", {"html": False}
NO_RULES = ["image", "link", "autolink", "reference", "html_block", "html_inline", "entity"]  # for text of others

STYLE = """
:root { color-scheme: light dark; --ink: #1b1f24; --paper: #fff; --soft: #57606a; --line: #d0d7de; --card: #f6f8fa; --accent: #0550ae; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --paper: #0d1117; --soft: #9da7b3; --line: #30363d; --card: #161b22; --accent: #79c0ff; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem 1rem 4rem; max-width: 60rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.55 system-ui, sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .75rem; }
h2 { font-size: 1.25rem; margin: 2.25rem 0 .5rem; padding-top: .75rem; border-top: 1px solid var(--line); }
p, ul { margin: .5rem 0; }
a { color: var(--accent); }
pre { overflow-x: auto; padding: .75rem; background: var(--card); border: 1px solid var(--line); border-radius: 6px;
  font: .85rem/1.45 ui-monospace, monospace; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(13rem, 1fr)); gap: .75rem; margin: 1.25rem 0; padding: 0;
  list-style: none; }
.tile { background: var(--card); border: 1px solid var(--line); border-left: .35rem solid var(--accent); border-radius: 6px;
  padding: .6rem .8rem; }
.tile.open { border-left-style: dashed; border-left-color: var(--soft); }
.tile .of { color: var(--soft); font-size: .9rem; }
.tile .answer { display: block; font-size: 1.3rem; font-weight: 600; line-height: 1.3; }
.tile .answer.long { font-size: 1.05rem; }
.tile .rest { font-size: .9rem; }
figure { margin: 1rem 0; }
figure img { display: block; max-width: 100%; max-height: 30rem; height: auto; background: #fff;
  border: 1px solid var(--line); border-radius: 6px; }
.pane { overflow-x: auto; }
@media screen and (max-width: 36rem) { .pane.wide img { min-width: 38rem; } }
figcaption { color: var(--soft); font-size: .9rem; margin-top: .3rem; }
footer { margin-top: 3rem; color: var(--soft); font-size: .85rem; border-top: 1px solid var(--line); padding-top: .75rem; }
@media print { figure img { max-height: 17rem; } }
@media print { body { max-width: none; padding: 0; } h2 { break-after: avoid; } figure, .tile, pre { break-inside: avoid; } }
"""

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
{policy}
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<main>
{body}
</main>
<footer>{foot}</footer>
</body>
</html>
"""


@dataclass(frozen=True)
class Tile:
    """A tile says what it is `of`, the `answer`, and what that `rests` on; it is `decided` or left open, which its words say too."""

    of: str
    answer: str
    rests: str
    decided: bool = True


@dataclass(frozen=True)
class Picture:
    """The bytes `png` are shown below the heading `section` of the text, above `caption`; `words` are what a screen reader says."""

    png: bytes
    section: str
    caption: str
    words: str


def page(title: str, text: str, *, tiles: Sequence[Tile] = (), pictures: Iterable[Picture] = (), foot: str = "") -> str:
    """Return the page: the tiles, then the Markdown `text` with each picture at the end of its section.

    The text has one heading of the first level, below which the tiles stand. Pictures whose section it lacks come last.
    """
    from markdown_it import MarkdownIt  # not before a page is wanted: it takes a tenth of a second

    parser = MarkdownIt(PRESET, OPTIONS).disable(NO_RULES)
    head, *sections = f"\n{text}".split("\n## ")
    waiting = list(pictures)
    body = [parser.render(head), _tiles(tiles)]
    for section in sections:
        heading = section.split("\n", 1)[0].strip()
        here = [picture for picture in waiting if picture.section == heading]
        waiting = [picture for picture in waiting if picture.section != heading]
        body += [f"<section>{parser.render(f'## {section}')}", *map(_figure, here), "</section>"]
    if waiting:
        body += ["<section><h2>Pictures</h2>", *map(_figure, waiting), "</section>"]
    return PAGE.format(policy=policy([STYLE]), title=escape(title), style=STYLE, body="\n".join(body), foot=escape(foot))


def _tiles(tiles: Sequence[Tile]) -> str:
    items = "".join(map(_tile, tiles))
    return f'<ul class="tiles">{items}</ul>' if items else ""


def _tile(tile: Tile) -> str:
    kind, size = "tile" if tile.decided else "tile open", "answer long" if len(tile.answer) > LONG else "answer"
    return (
        f'<li class="{kind}"><span class="of">{escape(tile.of)}</span>'
        f'<span class="{size}">{escape(tile.answer)}</span><span class="rest">{escape(tile.rests)}</span></li>'
    )


def _figure(picture: Picture) -> str:
    data = b64encode(picture.png).decode("ascii")
    width, height = (int.from_bytes(picture.png[at : at + 4], "big") for at in (16, 20))  # of the PNG's header
    wide = " wide" if width > WIDE * height else ""
    return (
        f'<figure><div class="pane{wide}"><img src="data:image/png;base64,{data}" alt="{escape(picture.words)}"></div>'
        f"<figcaption>{escape(picture.caption)}</figcaption></figure>"
    )
