"""Text of others, such as a channel's name, a path or what a claim says, is text wherever it is shown and never a command.

A name with characters that do not print is one that we give in its printable form everywhere, and take in it.
"""

from __future__ import annotations

import base64
import hashlib
import re
import unicodedata
from collections.abc import Iterable

LONGEST_LABEL = 60  # characters, as `errors.shorten` has
FORMULA = frozenset("=+-@\t\r\n")  # what begins one: https://owasp.org/www-community/attacks/CSV_Injection
# Within a word _ is no emphasis; all else here begins something, in CommonMark or where mathematics and addresses are read, too.
_ACTIVE = re.compile(r"[\\`*\[~$]|<(?=[a-z/!?])|(?<![^\W_])_|_(?![^\W_])|&(?=[#\w])|(?<=:)//|(?<=www)\.", re.IGNORECASE)
_FIRST = re.compile(r"[#>]|[-+](?=\s|$)|[-=]+\s*$|\d+(?=[.)])")


def printable(text: str) -> str:
    """Return the text on one line: of a character that does not print, as ESC, the end of a line or a mark that turns the direction of
    writing, Python's escape; a wide or narrow space prints.

    >>> printable("valve\\x1b[31m\\u202egnol")
    'valve\\\\x1b[31m\\\\u202egnol'
    """
    if text.isprintable():
        return text
    return "".join(one if one.isprintable() or unicodedata.category(one) == "Zs" else one.encode("unicode_escape").decode() for one in text)


def lines(text: str) -> str:
    """Return the text with every line of it printable."""
    return "\n".join(map(printable, text.split("\n")))


def as_markdown(text: str, *, first: bool = False) -> str:
    """Return the Markdown that shows this text as it stands; `first` where a line, or an entry of a list, begins with it.

    >>> as_markdown("![x](http://y)")
    '!\\\\[x](http:\\\\/\\\\/y)'
    """
    escaped = _ACTIVE.sub(lambda found: "".join(f"\\{one}" for one in found[0]), printable(text))
    if first and (found := _FIRST.match(escaped)):
        place = found.end() if found[0][0].isdigit() else 0
        escaped = f"{escaped[:place]}\\{escaped[place:]}"
    return escaped


def table_cell(text: str) -> str:
    """Return the text of a cell; an apostrophe stands before one that a spreadsheet would take for a formula.

    >>> table_cell("=cmd|' /C calc'!A0")
    "'=cmd|' /C calc'!A0"
    """
    begins = unicodedata.normalize("NFKC", text.lstrip(" ")[:1])  # some take full-width signs for formulas, too
    return f"'{text}" if begins in FORMULA else text


def as_label(text: str) -> str:
    """Return the text for a picture of matplotlib, in which a $ would begin mathematics.

    >>> as_label("Var$a_$")
    'Var\\\\$a_\\\\$'
    """
    shown = printable(text)
    shown = shown if len(shown) <= LONGEST_LABEL else f"{shown[: LONGEST_LABEL - 1]}…"
    return shown.replace("$", r"\$")


def policy(styles: Iterable[str], scripts: Iterable[str] = ()) -> str:
    """Return the tag for the head of a page that has these style sheets and scripts, by their digests, and no others.

    The page may show pictures that it holds itself. It fetches nothing, sends nothing, and has no other address than its own.
    """
    digests = {
        "style-src": [f"'sha256-{_digest(one)}'" for one in styles],
        "script-src": [f"'sha256-{_digest(one)}'" for one in scripts],
    }
    allowed = "".join(f" {source} {' '.join(held)};" for source, held in digests.items() if held)
    return (
        '<meta http-equiv="Content-Security-Policy" content="'
        f"default-src 'none';{allowed} img-src data:; base-uri 'none'; form-action 'none'\">"
    )


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")
