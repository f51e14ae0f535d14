"""Files of claims: TOML, several claims a file; what is wrong is told with the line.

read_claims    the claims of a text
FORMAT         what may stand under `format` at the top
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from typing import Any

from ...base.errors import InvalidInput, shorten
from .claims import Claim, make_claim, nearest

FORMAT = "faultspace-claims/1"
MOST_CHARACTERS, MOST_CLAIMS = 10**6, 1000
ID = re.compile(r"[A-Za-z0-9_-]{1,80}")
MOST_PARTS = 16  # of a key with dots; four are the most that a claim has
_QUOTED = re.compile(r"""'''.*?'''|\"{3}.*?\"{3}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|#[^\n]*""", re.DOTALL)
_PARTS = re.compile(rf"(?<![\w-])(?:[\w-]+[ \t]*\.[ \t]*){{{MOST_PARTS}}}")


def read_claims(text: str) -> list[Claim]:
    """Return the claims of a file, in its order. Raises InvalidInput that names the line, what was got and what is expected."""
    if len(text) > MOST_CHARACTERS:
        raise InvalidInput(f"got {len(text)} characters, expected at most {MOST_CHARACTERS}")
    # The reader takes the square of a key's parts, and all of them again for each.
    if (long := _PARTS.search(_QUOTED.sub("_", text))) is not None:
        raise InvalidInput(f"got the key {shorten(long[0])} of more than {MOST_PARTS} parts, expected [claim.NAME] with keys below it")
    try:
        document = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InvalidInput(f"got no TOML ({' '.join(str(error).split())}), expected [claim.NAME] with keys below it") from None
    for key in document:
        if key not in ("format", "claim"):
            raise InvalidInput(f"{_line(text, None, key)}got the key {shorten(key)} at the top; {nearest(key, ('format', 'claim'))}")
    if document.get("format", FORMAT) != FORMAT:
        raise InvalidInput(f"{_line(text, None, 'format')}got the format {shorten(document['format'])}, expected {FORMAT}")
    tables = document.get("claim", {})
    if not isinstance(tables, Mapping) or not 1 <= len(tables) <= MOST_CLAIMS:
        raise InvalidInput(f"got {'no claim' if not tables else shorten(tables)}, expected 1 to {MOST_CLAIMS} tables [claim.NAME]")
    return [_claim(text, id, table) for id, table in tables.items()]


def _claim(text: str, id: str, table: Any) -> Claim:
    if not ID.fullmatch(id):
        raise InvalidInput(f"{_line(text, id, None)}got the name {shorten(id)}, expected letters, digits, - and _, at most 80")
    if not isinstance(table, Mapping):
        raise InvalidInput(f"{_line(text, None, id)}claim.{id}: got {shorten(table)}, expected a table [claim.{id}]")
    try:
        return make_claim(id, table)
    except InvalidInput as error:
        where, _, _ = str(error).partition(":")
        raise InvalidInput(f"{_line(text, id, where, table)}claim.{id}.{error}") from None


def _line(text: str, id: str | None, key: str | None, table: Mapping[str, Any] | None = None) -> str:
    """Return "line 7: " where the key of the claim stands; TOML readers do not tell, so that the text is looked through."""
    lines = text.splitlines()
    start = 0
    if id is not None:
        heading = re.compile(rf"""\s*\[\s*claim\s*\.\s*["']?{re.escape(id)}["']?\s*[\].]""")
        start = next((i for i, one in enumerate(lines) if heading.match(one)), 0)
    if key is None:
        return f"line {start + 1}: "
    first, *rest = re.split(r"[.\[]", key)
    found = next((i for i in range(start, len(lines)) if re.match(rf"""\s*["']?{re.escape(first)}\b""", lines[i])), start)
    if key.startswith("hypotheses[") and table is not None:  # the line on which that entry begins
        entry = table["hypotheses"][int(rest[0].rstrip("]"))]
        wanted = entry.get("that") if isinstance(entry, Mapping) else entry
        if isinstance(wanted, str) and wanted:
            found = next((i for i in range(found, len(lines)) if wanted.splitlines()[0] in lines[i]), found)
    return f"line {found + 1}: "
