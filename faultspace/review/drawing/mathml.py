"""Numbers, polynomials and matrices, given as texts, in MathML, which browsers set by themselves.

typeset   the rows of a matrix as it takes them
number    the MathML of one entry, such as -3/4 or 4 a^3 - a + 1
matrix    a matrix of such entries, with a name before it where there is one
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from markupsafe import Markup

TOKENS = re.compile(r"(?P<fraction>\d+/\d+)|(?P<number>\d+(?:\.\d+)?)|(?P<power>[A-Za-z]\^\d+)|(?P<letter>[A-Za-z])|(?P<sign>[-+*()])|\s+")
SHAPES = {
    "fraction": lambda text: "<mfrac><mn>{}</mn><mn>{}</mn></mfrac>".format(*text.split("/")),
    "number": lambda text: f"<mn>{text}</mn>",
    "power": lambda text: "<msup><mi>{}</mi><mn>{}</mn></msup>".format(*text.split("^")),
    "letter": lambda text: f"<mi>{text}</mi>",
    "sign": lambda text: f"<mo>{'&#x2212;' if text == '-' else text}</mo>",
}


def number(text: str) -> Markup:
    """Return the MathML row of an entry; what is none, such as an entry that was cut, is shown as text."""
    parts, at = [], 0
    for found in TOKENS.finditer(text):
        if found.start() != at:
            break
        at = found.end()
        if found.lastgroup is not None:
            parts.append(SHAPES[found.lastgroup](found.group()))
    if at != len(text):
        return Markup("<mtext>{}</mtext>").format(text)
    return Markup("<mrow>{}</mrow>").format(Markup("".join(parts)))


def matrix(found: Mapping[str, Any], name: str = "") -> Markup:
    """Return `<math>` with the matrix; one without entries is told by its size."""
    head = Markup("<mi>{}</mi><mo>=</mo>").format(name) if name else Markup()
    if not (found["rows"] and found["columns"]):
        body = Markup("<mtext>empty, {} x {}</mtext>").format(found["rows"], found["columns"])
    else:
        rows = "".join(f"<mtr>{''.join(f'<mtd>{number(entry)}</mtd>' for entry in row)}</mtr>" for row in found["entries"])
        body = Markup('<mo stretchy="true">[</mo><mtable>{}</mtable><mo stretchy="true">]</mo>').format(Markup(rows))
    label = f"{name + ' = ' if name else ''}{words(found)}"
    return Markup('<math aria-label="{}"><mrow>{}{}</mrow></math>').format(label, head, body)


def words(found: Mapping[str, Any]) -> str:
    """Return the matrix on one line, as those hear it who do not see it."""
    return "[" + ", ".join("[" + ", ".join(row) + "]" for row in found["entries"]) + "]"


def typeset(rows: Sequence[Sequence[str]]) -> dict[str, Any]:
    """Return the matrix of these entries as `matrix` takes it."""
    return {"rows": len(rows), "columns": len(rows[0]) if rows else 0, "entries": rows}
