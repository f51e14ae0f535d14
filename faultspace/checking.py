"""`faultspace check`: certificates through the checker, which decides alone; here they are only opened and told about.

run          the command's body
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich.text import Text

from .consoles import answers, print_json, working
from .exact.input_rules import InvalidInput
from .failures import ANSWERED, BAD_INPUT, NOT_AS_EXPECTED, placed, printable, say
from .proofs import checker
from .reading_files import read_json

CODES = {"verified": ANSWERED, "rejected": NOT_AS_EXPECTED, "malformed": BAD_INPUT}
STYLES = {"verified": "green", "rejected": "red", "malformed": "red"}


def run(names: Sequence[str], *, systems: Sequence[str], as_json: bool) -> int:
    """Checks one file after the other; the largest exit code. As JSON: an array with one object a file, as the checker writes it.

    What does not parse is told on standard error alone, and in the JSON.
    """
    insisted = [_system(name) for name in systems]
    console = answers()
    results: list[dict[str, Any]] = []
    for name in names:
        with working(f"checking {printable(name)}"):
            result = _judge(name, insisted)
        results.append(result)
        if result["result"] == "malformed":
            say(f"{printable(name)}: {result['reason']}")
        elif not as_json:
            heading = Text.assemble((result["result"], STYLES[result["result"]]), f"  {printable(name)}")
            if "sha256" in result:
                heading.append(f"  {result['kind']}, SHA-256 {result['sha256'][:12]}")
            console.print(heading, soft_wrap=True)
            console.print(Text("    " + (result.get("statement") or result["reason"])), soft_wrap=True)
    if as_json:
        print_json(results)
    return max(CODES[result["result"]] for result in results)


def _judge(name: str, systems: Sequence[Any]) -> dict[str, Any]:
    try:
        certificate = checker.load(name)
        words = checker.verify(certificate, systems)
        return {"file": name, "result": "verified", "kind": certificate["kind"], "statement": words, "sha256": checker.sha256(certificate)}
    except checker.Malformed as error:
        return {"file": name, "result": "malformed", "reason": str(error)}
    except (checker.Rejected, MemoryError) as error:
        return {"file": name, "result": "rejected", "reason": str(error) or "not enough memory"}


def _system(name: str) -> Any:
    document = read_json(name)
    with placed(name):
        try:
            checker.subject(document)
        except (checker.Malformed, checker.Rejected) as error:
            raise InvalidInput(f"got no system: {error}") from None
    return document
