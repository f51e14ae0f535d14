"""JUnit's XML, which continuous integration reads.

document   a test suite of the results: a failure for what was wrong, an error for what broke, skipped for what is free or expected
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from xml.etree import ElementTree

from ..records import CheckResult, Demand, Status, message
from .words import NOT_PROVED

_NO_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML 1.0 has no way to write: control characters and halves of surrogate pairs, which a program may print before it dies."""


def document(adapter: str, results: Sequence[CheckResult]) -> str:
    """Return the XML, which ends with a line feed."""
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
