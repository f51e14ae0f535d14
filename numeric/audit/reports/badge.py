"""A badge of a result, to stand on a page of a project.

endpoint   JSON that shields.io makes a picture of
svg        the picture itself, with nothing from anywhere else
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from xml.sax.saxutils import escape

from ..records import CheckResult, Demand, Status
from .words import NOT_PROVED

LABEL = "faultspace audit"
GREEN, RED = "#2a7d2a", "#b3261e"
LETTER, MARGIN, HEIGHT = 6.6, 6.0, 20  # of a letter in 11 pixels of a sans-serif face: its mean width; the picture's own, in pixels


def _message(results: Sequence[CheckResult]) -> str:
    musts = [one for one in results if one.kind != Demand.FREE and one.verdict != Status.NOT_OFFERED]
    passed = sum(one.verdict == Status.PASS for one in musts)
    return f"{passed} of {len(musts)} passed" if musts else "nothing asked"


def endpoint(results: Sequence[CheckResult]) -> dict[str, Any]:
    """Return what https://shields.io/badges/endpoint-badge describes."""
    return {
        "schemaVersion": 1,
        "label": LABEL,
        "message": _message(results),
        "color": _colour(results),
        "isError": any(one.failed for one in results),
    }


def svg(results: Sequence[CheckResult]) -> str:
    """Return the picture: the label on grey, the count of musts that passed on green, or on red where one failed."""
    message = _message(results)
    left, right = (2 * MARGIN + LETTER * len(text) for text in (LABEL, message))
    title = escape(f"{LABEL}: {message}")
    texts = "".join(
        f'<text x="{x:g}" y="14" textLength="{LETTER * len(text):g}" lengthAdjust="spacingAndGlyphs">{escape(text)}</text>'
        for x, text in ((MARGIN, LABEL), (left + MARGIN, message))
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + right:g}" height="{HEIGHT}" role="img" aria-label="{title}">'
        f'<title>{title}</title><desc>{escape(NOT_PROVED)}</desc><rect width="{left:g}" height="{HEIGHT}" fill="#555"/>'
        f'<rect x="{left:g}" width="{right:g}" height="{HEIGHT}" fill="{_colour(results)}"/>'
        f'<g fill="#fff" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11">{texts}</g></svg>\n'
    )


def _colour(results: Sequence[CheckResult]) -> str:
    return RED if any(one.failed for one in results) or not results else GREEN
