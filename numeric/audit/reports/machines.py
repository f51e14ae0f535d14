"""A result for machines: a badge to stand on a page of a project, and JUnit's XML, which continuous integration reads."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any
from xml.etree import ElementTree
from xml.sax.saxutils import escape

from ..records import CheckResult, Demand, Status, message
from .causes import NOT_PROVED

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
    """Return the picture: the label on grey, the count of musts that passed on green, or on red where one failed or none passed."""
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
    return GREEN if any(one.verdict == Status.PASS for one in results) and not any(one.failed for one in results) else RED


_NO_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML 1.0 has no way to write: control characters and halves of surrogate pairs, which a program may print before it dies."""


def junit_xml(adapter: str, results: Sequence[CheckResult]) -> str:
    """Return a test suite of the results, in XML that ends with a line feed: a failure for what was wrong, an error for what broke, skipped
    for what is free or expected."""
    cases = [_case(one, adapter) for one in results]
    count: Callable[[str], str] = lambda tag: str(sum(one.find(tag) is not None for one in cases))  # noqa: E731
    totals = {"tests": str(len(cases)), "failures": count("failure"), "errors": count("error"), "skipped": count("skipped")}
    seconds = f"{sum(one.seconds for one in results):.3f}"
    suite = ElementTree.Element("testsuite", {"name": _legal(f"faultspace audit {adapter}"), **totals, "time": seconds})
    properties = ElementTree.SubElement(suite, "properties")
    ElementTree.SubElement(properties, "property", {"name": "not proved", "value": NOT_PROVED})
    suite.extend(cases)
    root = ElementTree.Element("testsuites", {**totals, "time": seconds})
    root.append(suite)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _case(result: CheckResult, adapter: str) -> ElementTree.Element:
    case = ElementTree.Element("testcase", {"classname": result.function, "name": result.name, "time": f"{result.seconds:.3f}"})
    if result.failed:
        tag = "error" if result.verdict == Status.BROKEN else "failure"
        words = _legal(message(result, adapter))
        ElementTree.SubElement(case, tag, {"type": result.verdict, "message": words.split(" Effect: ")[0]}).text = words
    elif result.kind == Demand.FREE or result.verdict != Status.PASS:
        ElementTree.SubElement(
            case, "skipped", {"message": _legal(f"{result.verdict}: {result.detail}" if result.detail else result.verdict)}
        )
    return case


def _legal(text: str) -> str:
    return _NO_XML.sub("�", text)
