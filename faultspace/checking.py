"""`faultspace check`: certificates through the checker, which decides alone; here they are only opened and told about.

run          the command's body
--rocq       besides, what Rocq's kernel makes of the certificates that parse, whatever the checker says of them
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from .consoles import answers, print_json, stages, working
from .exact.input_rules import InvalidInput
from .failures import ANSWERED, BAD_INPUT, NOT_AS_EXPECTED, placed, printable, say
from .proofs import checker
from .reading_files import read_json

CODES = {"verified": ANSWERED, "rejected": NOT_AS_EXPECTED, "malformed": BAD_INPUT}
STYLES = {"verified": "green", "rejected": "red", "malformed": "red", "accepted": "green", "not covered": "yellow", "undecided": "yellow"}


def run(names: Sequence[str], *, systems: Sequence[str], rocq: bool = False, as_json: bool) -> int:
    """Checks one file after the other; the largest exit code. As JSON: an array with one object a file, as the checker writes it.

    What does not parse is told on standard error alone, and in the JSON. With `rocq`, exit 1 also where Rocq accepts not all of them, and
    InvalidInput where there is no Rocq.
    """
    insisted = [_system(name) for name in systems]
    console = answers()
    results: list[dict[str, Any]] = []
    for name in names:
        with working(f"checking {printable(name)}"):
            result = _judge(name, insisted)
        results.append(result)
        if not rocq:
            _tell(console, result, as_json=as_json)
    if rocq:
        _add_rocq(results)
        for result in results:
            _tell(console, result, as_json=as_json)
    if as_json:
        print_json(results)
    doubted = any(result.get("rocq", {"result": "accepted"})["result"] != "accepted" for result in results)
    return max(NOT_AS_EXPECTED if doubted else ANSWERED, *(CODES[result["result"]] for result in results))


def _tell(console: Console, result: dict[str, Any], *, as_json: bool) -> None:
    name = printable(result["file"])
    if result["result"] == "malformed":
        say(f"{name}: {result['reason']}")
    elif not as_json:
        heading = Text.assemble((result["result"], STYLES[result["result"]]), f"  {name}")
        if "sha256" in result:
            heading.append(f"  {result['kind']}, SHA-256 {result['sha256'][:12]}")
        console.print(heading, soft_wrap=True)
        console.print(Text("    " + (result.get("statement") or result["reason"])), soft_wrap=True)
        if "rocq" in result:
            verdict = result["rocq"]["result"]
            console.print(Text.assemble("    Rocq: ", (verdict, STYLES[verdict]), f", {result['rocq']['reason']}"), soft_wrap=True)


def _add_rocq(results: list[dict[str, Any]]) -> None:
    """What Rocq says of each certificate that parses, under the key "rocq"."""
    from .proofs.rocq_build import BrokenTheory, NoRocq
    from .proofs.rocq_recompute import recomputed

    parsed = [result for result in results if result["result"] != "malformed"]
    try:
        with stages() as progress:
            said = recomputed([checker.load(result["file"]) for result in parsed], progress)
    except NoRocq as error:
        raise InvalidInput(f"--rocq: {error}") from None
    except BrokenTheory as error:
        raise InvalidInput(f"--rocq: this version of Rocq does not compile the theory ({error})") from None
    for result, one in zip(parsed, said, strict=True):
        result["rocq"] = {"result": one.result, "reason": one.reason}


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
